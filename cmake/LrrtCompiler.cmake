# SPDX-License-Identifier: BSD-3-Clause
# Build type, C++ standard, warnings, sanitizers and ccache for every target of the project.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(LRRT_CCACHE ccache)
if(LRRT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${LRRT_CCACHE}")
endif()

# lrrt_target_options(target): our own warnings and sanitizers; never passed on to users of the library.
function(lrrt_target_options target)
  # nobody reads errno after a square root, and without it they are taken four at a time
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -fno-math-errno)
  if(LRRT_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(LRRT_SANITIZE)
    # a report of the undefined-behaviour sanitizer ends the program, as one of the others does
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
  endif()
  if(LRRT_BUILD_FUZZERS)  # every target tells libFuzzer which branches an input takes, and the first error ends the run
    set(checks address,undefined,float-cast-overflow)
    target_compile_options(${target} PRIVATE
      -fsanitize=fuzzer-no-link,${checks} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${checks})
  endif()
  if(LRRT_SANITIZE_THREADS)
    target_compile_options(${target} PRIVATE -fsanitize=thread -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=thread)
  endif()
  if(LRRT_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage -fprofile-update=atomic)
    target_link_options(${target} PRIVATE --coverage)
  endif()
endfunction()
