# SPDX-License-Identifier: BSD-3-Clause
# Defines LrrtOnnxRuntime::headers. The library itself is opened at run time, never linked, so only its
# path matters: LrrtOnnxRuntime_LIBRARY (may be empty). LrrtOnnxRuntime_IS_OURS: it is the one in .deps.
#
# Looked for in this order: ONNXRUNTIME_ROOT (variable or environment), find_package(onnxruntime CONFIG),
# .deps/onnxruntime (scripts/setup_onnxruntime.sh puts it there), the default paths.

set(_lrrt_suffixes include include/onnxruntime include/onnxruntime/core/session)
set(_lrrt_bundle "${PROJECT_SOURCE_DIR}/.deps/onnxruntime")
set(_lrrt_root "${ONNXRUNTIME_ROOT}")
if(NOT _lrrt_root)
  set(_lrrt_root "$ENV{ONNXRUNTIME_ROOT}")
endif()

# The search is repeated at every configure, so that a changed ONNXRUNTIME_ROOT is never missed.
set(LrrtOnnxRuntime_INCLUDE_DIR "LrrtOnnxRuntime_INCLUDE_DIR-NOTFOUND")
set(LrrtOnnxRuntime_LIBRARY "LrrtOnnxRuntime_LIBRARY-NOTFOUND")
macro(_lrrt_look_in)
  find_path(LrrtOnnxRuntime_INCLUDE_DIR onnxruntime_cxx_api.h PATH_SUFFIXES ${_lrrt_suffixes} NO_CACHE ${ARGN})
  find_library(LrrtOnnxRuntime_LIBRARY NAMES onnxruntime libonnxruntime.so.1 PATH_SUFFIXES lib lib64 NO_CACHE ${ARGN})
endmacro()

if(_lrrt_root)
  _lrrt_look_in(PATHS "${_lrrt_root}" NO_DEFAULT_PATH)
else()
  find_package(onnxruntime CONFIG QUIET)
  if(TARGET onnxruntime::onnxruntime)
    get_target_property(_lrrt_dirs onnxruntime::onnxruntime INTERFACE_INCLUDE_DIRECTORIES)
    get_target_property(_lrrt_file onnxruntime::onnxruntime LOCATION)
    get_filename_component(_lrrt_dir "${_lrrt_file}" DIRECTORY)
    _lrrt_look_in(HINTS ${_lrrt_dirs} "${_lrrt_dir}")
  endif()
  _lrrt_look_in(PATHS "${_lrrt_bundle}" NO_DEFAULT_PATH)
  _lrrt_look_in()
  if(NOT LrrtOnnxRuntime_INCLUDE_DIR AND LRRT_FETCH_ONNXRUNTIME)
    # under pip the build's own Python has pip, which downloads; the system's may have none
    execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PYTHON=${Python_EXECUTABLE}"
      "${PROJECT_SOURCE_DIR}/scripts/setup_onnxruntime.sh")
    _lrrt_look_in(PATHS "${_lrrt_bundle}" NO_DEFAULT_PATH)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LrrtOnnxRuntime
  REQUIRED_VARS LrrtOnnxRuntime_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Run scripts/setup_onnxruntime.sh, or set ONNXRUNTIME_ROOT to the folder of an ONNX Runtime installation.")

if(NOT LrrtOnnxRuntime_LIBRARY)
  set(LrrtOnnxRuntime_LIBRARY "")
endif()
string(FIND "${LrrtOnnxRuntime_LIBRARY}" "${_lrrt_bundle}/" _lrrt_position)
set(LrrtOnnxRuntime_IS_OURS OFF)
if(_lrrt_position EQUAL 0)
  set(LrrtOnnxRuntime_IS_OURS ON)
endif()

if(LrrtOnnxRuntime_FOUND AND NOT TARGET LrrtOnnxRuntime::headers)
  add_library(LrrtOnnxRuntime::headers INTERFACE IMPORTED)
  target_include_directories(LrrtOnnxRuntime::headers SYSTEM INTERFACE "${LrrtOnnxRuntime_INCLUDE_DIR}")
  message(STATUS "ONNX Runtime library, opened at run time: ${LrrtOnnxRuntime_LIBRARY}")
endif()

# lrrt_install_onnxruntime(folder licenses install-options...): installs the library, with its licences, where it is the
# one in .deps. One that the user installed stays where it is.
function(lrrt_install_onnxruntime folder licenses)
  set(bundle "${PROJECT_SOURCE_DIR}/.deps/onnxruntime")
  if(LrrtOnnxRuntime_IS_OURS)
    file(REAL_PATH "${LrrtOnnxRuntime_LIBRARY}" file)
    install(FILES "${file}" DESTINATION "${folder}" RENAME libonnxruntime.so.1 ${ARGN})
    install(FILES "${bundle}/LICENSE" DESTINATION "${licenses}" RENAME onnxruntime-LICENSE ${ARGN})
    install(FILES "${bundle}/ThirdPartyNotices.txt" DESTINATION "${licenses}"
      RENAME onnxruntime-ThirdPartyNotices.txt ${ARGN})
  endif()
endfunction()
