#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check.sh PREFIX WORK_FOLDER: what an installation has to offer to a project that knows nothing but PREFIX. Builds and
# runs consumer and plain, by CMake and by pkg-config, and lrrt_bench's smoke suite where the program is installed.
set -euo pipefail

prefix="$(cd "$1" && pwd -P)"
mkdir -p "$2"
work="$(cd "$2" && pwd)"
here="$(cd "$(dirname "$0")" && pwd)"
source="$(cd "$here/../.." && pwd)"
version="$(sed -n 's/^project(lrrt VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")"
unset LRRT_MODEL LRRT_ONNXRUNTIME

fail() { printf 'failed: %s\n' "$*" >&2; exit 1; }

rm -rf "$work"/{cmake,by-pkg-config,loaded.*}
config="$(find "$prefix" -name lrrtConfig.cmake)"
libraries="$(cd "$(dirname "$config")/../.." && pwd)"
runtime="$libraries/lrrt/libonnxruntime.so.1"

cmake -S "$here" -B "$work/cmake" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
  -DEXPECTED_VERSION="$version"
grep -q "^lrrt_DIR:PATH=$(dirname "$config")$" "$work/cmake/CMakeCache.txt" || fail "another lrrt than $prefix was found"
cmake --build "$work/cmake"

# A program that holds liblrrt.a looks around itself, so it has to lie where programs are installed.
programs="$work/cmake"
if [ -e "$libraries/liblrrt.a" ]; then
  programs="$prefix/bin"
  mkdir -p "$programs"
  cp "$work/cmake/consumer" "$programs/"
  trap 'rm -f "$programs/consumer"' EXIT
else
  readelf -d "$libraries/liblrrt.so" | grep "soname: \[liblrrt.so.${version%.*}\]" >/dev/null ||
    fail "the soname of liblrrt.so is not liblrrt.so.${version%.*}"
fi
# Called by its name alone, from elsewhere, as programs are.
(cd "$work" && LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" PATH="$programs:$PATH" \
  consumer "$source/tests/data/room.yaml" "$prefix")
# Where an ONNX Runtime was installed, that one was taken.
[ ! -e "$runtime" ] || grep -q "$runtime" "$work"/loaded.* || fail "ONNX Runtime was not taken from $runtime"

"$work/cmake/plain"
if readelf -d "$work/cmake/plain" | grep imgcodecs; then fail "lrrt without io links the picture decoders"; fi

static=()
[ ! -e "$libraries/liblrrt.a" ] || static=(--static)
export PKG_CONFIG_PATH="$libraries/pkgconfig"
[ "$(pkg-config --modversion lrrt)" = "$version" ] || fail "pkg-config names another version than $version"
mkdir "$work/by-pkg-config"
read -ra flags <<<"$(pkg-config --cflags --libs "${static[@]}" lrrt)"
"${CXX:-c++}" -std=c++17 "$here/plain.cpp" -o "$work/by-pkg-config/plain" -Wl,-rpath,"$libraries" "${flags[@]}"
"$work/by-pkg-config/plain"
read -ra flags <<<"$(pkg-config --cflags --libs "${static[@]}" lrrt-io)"
"${CXX:-c++}" -std=c++17 -DLRRT_EXPECTED_VERSION="\"$version\"" "$here/consumer.cpp" \
  -o "$work/by-pkg-config/consumer" -Wl,-rpath,"$libraries" "${flags[@]}"

if [ -x "$prefix/bin/lrrt_bench" ]; then
  [ "$("$prefix/bin/lrrt_bench" --version)" = "lrrt_bench $version" ] || fail "lrrt_bench tells another version"
  (cd "$work" && "$prefix/bin/lrrt_bench" --suite smoke --runs 1)
fi
