# SPDX-License-Identifier: BSD-3-Clause
# Installs the libraries, headers, default model and the CMake package "lrrt".
if(NOT TARGET lrrt)
  return()
endif()

include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/lrrt")
set(lrrt_libraries lrrt)
if(TARGET lrrt_io)
  list(APPEND lrrt_libraries lrrt_io)
endif()

install(TARGETS ${lrrt_libraries} EXPORT lrrtTargets)
set(left_out)
if(NOT LRRT_WITH_TORCH)
  set(left_out PATTERN "torch_*" EXCLUDE)
endif()
install(DIRECTORY include/lrrt "${PROJECT_BINARY_DIR}/include/lrrt" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.hpp" ${left_out})
install(FILES models/default.onnx DESTINATION "${CMAKE_INSTALL_DATADIR}/lrrt/models")
lrrt_install_onnxruntime("${CMAKE_INSTALL_LIBDIR}" "${CMAKE_INSTALL_DATADIR}/lrrt/licenses")

set(LRRT_NEEDS_TORCH OFF)
if(LRRT_WITH_TORCH AND NOT BUILD_SHARED_LIBS)
  set(LRRT_NEEDS_TORCH ON)
endif()
set(LRRT_MODEL "${CMAKE_INSTALL_DATADIR}/lrrt/models/default.onnx")
configure_package_config_file(cmake/lrrtConfig.cmake.in "${PROJECT_BINARY_DIR}/lrrtConfig.cmake"
  INSTALL_DESTINATION "${package_dir}" PATH_VARS LRRT_MODEL)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lrrtConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/lrrtConfig.cmake"
  "${PROJECT_BINARY_DIR}/lrrtConfigVersion.cmake"
  cmake/FindLrrtOmpl.cmake cmake/FindLrrtOpenCV.cmake cmake/FindLrrtYamlCpp.cmake
  DESTINATION "${package_dir}")
install(EXPORT lrrtTargets NAMESPACE lrrt:: DESTINATION "${package_dir}")
