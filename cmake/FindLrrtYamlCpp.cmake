# SPDX-License-Identifier: BSD-3-Clause
# Defines LrrtYamlCpp::yaml-cpp. The target is called yaml-cpp before release 0.8, yaml-cpp::yaml-cpp since.

find_package(yaml-cpp CONFIG QUIET)
foreach(_name yaml-cpp::yaml-cpp yaml-cpp)
  if(TARGET ${_name} AND NOT LrrtYamlCpp_LIBRARY)
    set(LrrtYamlCpp_LIBRARY ${_name})
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LrrtYamlCpp
  REQUIRED_VARS LrrtYamlCpp_LIBRARY
  REASON_FAILURE_MESSAGE "Install yaml-cpp (Debian, Ubuntu: libyaml-cpp-dev) or set yaml-cpp_DIR.")

if(LrrtYamlCpp_FOUND AND NOT TARGET LrrtYamlCpp::yaml-cpp)
  add_library(LrrtYamlCpp::yaml-cpp INTERFACE IMPORTED)
  target_link_libraries(LrrtYamlCpp::yaml-cpp INTERFACE ${LrrtYamlCpp_LIBRARY})
  target_include_directories(LrrtYamlCpp::yaml-cpp SYSTEM INTERFACE ${YAML_CPP_INCLUDE_DIR})
endif()
