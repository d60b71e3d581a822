# SPDX-License-Identifier: BSD-3-Clause
# Defines LrrtOmpl::ompl. Newer OMPL exports the target ompl::ompl, older ones only variables, whose
# OMPL_LIBRARIES names boost libraries that need not be installed: there we link libompl alone.

find_package(ompl CONFIG QUIET)
set(LrrtOmpl_VERSION "${ompl_VERSION}")
if(NOT LrrtOmpl_VERSION)
  set(LrrtOmpl_VERSION "${OMPL_MAJOR_VERSION}.${OMPL_MINOR_VERSION}.${OMPL_PATCH_VERSION}")
endif()

if(TARGET ompl::ompl)
  set(LrrtOmpl_LIBRARY ompl::ompl)
else()
  find_path(LrrtOmpl_INCLUDE_DIR ompl/config.h HINTS ${OMPL_INCLUDE_DIR} ${OMPL_INCLUDE_DIRS})
  find_library(LrrtOmpl_LIBRARY ompl HINTS ${OMPL_LIBRARY_DIR} ${OMPL_LIBRARY_DIRS})
  mark_as_advanced(LrrtOmpl_INCLUDE_DIR LrrtOmpl_LIBRARY)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LrrtOmpl
  REQUIRED_VARS LrrtOmpl_LIBRARY
  VERSION_VAR LrrtOmpl_VERSION
  REASON_FAILURE_MESSAGE "Install OMPL 1.5 or newer (Debian, Ubuntu: libompl-dev) or set CMAKE_PREFIX_PATH.")

if(LrrtOmpl_FOUND AND NOT TARGET LrrtOmpl::ompl)
  find_package(Eigen3 REQUIRED NO_MODULE)
  add_library(LrrtOmpl::ompl INTERFACE IMPORTED)
  target_link_libraries(LrrtOmpl::ompl INTERFACE ${LrrtOmpl_LIBRARY} Eigen3::Eigen)
  if(LrrtOmpl_INCLUDE_DIR)
    target_include_directories(LrrtOmpl::ompl SYSTEM INTERFACE "${LrrtOmpl_INCLUDE_DIR}")
  endif()
endif()
