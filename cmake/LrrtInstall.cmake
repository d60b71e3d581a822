# SPDX-License-Identifier: BSD-3-Clause
# Installs the libraries, headers, default model, the CMake package "lrrt" and pkg-config's lrrt and lrrt-io.
# Component runtime: what a program needs to run; development: what it needs to be built.
if(NOT TARGET lrrt)
  return()
endif()

include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/lrrt")
set(runtime COMPONENT runtime)
set(development COMPONENT development)
set(lrrt_libraries lrrt)
if(TARGET lrrt_io)
  list(APPEND lrrt_libraries lrrt_io)
endif()

install(TARGETS ${lrrt_libraries} EXPORT lrrtTargets
  LIBRARY ${runtime} NAMELINK_COMPONENT development
  ARCHIVE ${development})
set(left_out)
if(NOT LRRT_WITH_TORCH)
  set(left_out PATTERN "torch_*" EXCLUDE)
endif()
install(DIRECTORY include/lrrt "${PROJECT_BINARY_DIR}/include/lrrt" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  ${development} FILES_MATCHING PATTERN "*.hpp" ${left_out})
install(FILES models/default.onnx DESTINATION "${CMAKE_INSTALL_DATADIR}/lrrt/models" ${runtime})
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/lrrt" RENAME copyright ${runtime})
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/lrrt-dev" RENAME copyright ${development})
# In a folder of its own: nothing but lrrt finds it, and a system's ONNX Runtime is not hidden by it.
lrrt_install_onnxruntime("${CMAKE_INSTALL_LIBDIR}/lrrt" "${CMAKE_INSTALL_DATADIR}/doc/lrrt" ${runtime})

# Users of static libraries link what these link, too.
set(LRRT_NEEDS_PRIVATE ON)
set(find_modules cmake/FindLrrtOmpl.cmake cmake/FindLrrtOpenCV.cmake cmake/FindLrrtYamlCpp.cmake)
if(BUILD_SHARED_LIBS)
  set(LRRT_NEEDS_PRIVATE OFF)
  set(find_modules cmake/FindLrrtOmpl.cmake)
endif()
set(LRRT_NEEDS_TORCH OFF)
if(LRRT_WITH_TORCH AND NOT BUILD_SHARED_LIBS)
  set(LRRT_NEEDS_TORCH ON)
endif()
set(LRRT_MODEL "${CMAKE_INSTALL_DATADIR}/lrrt/models/default.onnx")
set(LRRT_RUNTIME "${CMAKE_INSTALL_LIBDIR}/lrrt/libonnxruntime.so.1")
configure_package_config_file(cmake/lrrtConfig.cmake.in "${PROJECT_BINARY_DIR}/lrrtConfig.cmake"
  INSTALL_DESTINATION "${package_dir}" PATH_VARS LRRT_MODEL LRRT_RUNTIME)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lrrtConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/lrrtConfig.cmake"
  "${PROJECT_BINARY_DIR}/lrrtConfigVersion.cmake"
  ${find_modules}
  DESTINATION "${package_dir}" ${development})
install(EXPORT lrrtTargets NAMESPACE lrrt:: DESTINATION "${package_dir}" ${development})

# pkg-config. OMPL's own ompl.pc is not asked: Debian's sets -std=c++14.
file(RELATIVE_PATH LRRT_PREFIX_FROM_PC
  "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" LRRT_PREFIX_FROM_PC "${LRRT_PREFIX_FROM_PC}")
get_target_property(ompl_includes LrrtOmpl::ompl INTERFACE_INCLUDE_DIRECTORIES)
if(TARGET ompl::ompl)
  get_target_property(ompl_includes ompl::ompl INTERFACE_INCLUDE_DIRECTORIES)
endif()
list(TRANSFORM ompl_includes PREPEND "-I")
list(JOIN ompl_includes " " LRRT_OMPL_CFLAGS)
foreach(name lrrt lrrt-io)
  configure_file("cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" ${development})
endforeach()
