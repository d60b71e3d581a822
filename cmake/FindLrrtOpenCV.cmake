# SPDX-License-Identifier: BSD-3-Clause
# Defines LrrtOpenCV::core, LrrtOpenCV::imgproc and LrrtOpenCV::imgcodecs.
# OpenCVConfig.cmake ships only with the complete OpenCV (Debian, Ubuntu: libopencv-dev, 690 MB);
# where it is missing, the headers and libraries of the single modules are looked up by name.

set(_lrrt_modules core imgproc imgcodecs)
find_package(OpenCV 4 QUIET CONFIG COMPONENTS ${_lrrt_modules})

if(OpenCV_FOUND)
  foreach(_module IN LISTS _lrrt_modules)
    set(LrrtOpenCV_${_module}_LIBRARY opencv_${_module})
  endforeach()
  set(LrrtOpenCV_INCLUDE_DIR "${OpenCV_INCLUDE_DIRS}")
else()
  find_path(LrrtOpenCV_INCLUDE_DIR opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
  foreach(_module IN LISTS _lrrt_modules)
    find_library(LrrtOpenCV_${_module}_LIBRARY opencv_${_module})
    mark_as_advanced(LrrtOpenCV_${_module}_LIBRARY)
  endforeach()
  mark_as_advanced(LrrtOpenCV_INCLUDE_DIR)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LrrtOpenCV
  REQUIRED_VARS LrrtOpenCV_core_LIBRARY LrrtOpenCV_imgproc_LIBRARY LrrtOpenCV_imgcodecs_LIBRARY LrrtOpenCV_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Install OpenCV 4 (Debian, Ubuntu: libopencv-{core,imgproc,imgcodecs}-dev) or set OpenCV_DIR.")

if(LrrtOpenCV_FOUND)
  foreach(_module IN LISTS _lrrt_modules)
    if(NOT TARGET LrrtOpenCV::${_module})
      add_library(LrrtOpenCV::${_module} INTERFACE IMPORTED)
      target_link_libraries(LrrtOpenCV::${_module} INTERFACE ${LrrtOpenCV_${_module}_LIBRARY})
      target_include_directories(LrrtOpenCV::${_module} SYSTEM INTERFACE ${LrrtOpenCV_INCLUDE_DIR})
    endif()
  endforeach()
endif()
unset(_lrrt_modules)
