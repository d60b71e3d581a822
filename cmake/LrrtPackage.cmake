# SPDX-License-Identifier: BSD-3-Clause
# Packages by CPack, made by 'make package': lrrt_VERSION_ARCH.deb (libraries, model, lrrt_bench, our own ONNX Runtime),
# lrrt-dev_VERSION_ARCH.deb (headers, CMake package, pkg-config) and one archive with both, which may lie anywhere.
if(NOT TARGET lrrt)
  return()
endif()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME lrrt)
set(CPACK_PACKAGE_VENDOR "the lrrt authors")
set(CPACK_PACKAGE_CONTACT "the lrrt authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_FILE_NAME "lrrt-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME lrrt)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME lrrt-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libompl-dev")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    ", libopencv-core-dev, libopencv-imgproc-dev, libopencv-imgcodecs-dev, libyaml-cpp-dev")
endif()
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Libraries, the default model and the program lrrt_bench.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, and what CMake and pkg-config ask for.")

# The linker's cache learns of the libraries, and packages that link them of this one.
set(control "${PROJECT_BINARY_DIR}/debian")
set(so_version "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
file(WRITE "${control}/triggers" "activate-noawait ldconfig\n")
file(WRITE "${control}/shlibs"
  "liblrrt ${so_version} lrrt (>= ${PROJECT_VERSION})\nliblrrt_io ${so_version} lrrt (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${control}/triggers" "${control}/shlibs")
include(CPack)
