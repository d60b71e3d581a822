#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run.sh static|shared WORK_FOLDER [BUILD_TREE]: installs the library into a fresh prefix, then builds and runs the
# consumer project against it. Without BUILD_TREE the library is built first, in WORK_FOLDER.
set -euo pipefail

kind=$1
work=$2
source="$(cd "$(dirname "$0")/../.." && pwd)"
tree="${3:-$work/library}"
prefix="$work/prefix"

if [ $# -lt 3 ]; then
  shared=OFF
  [ "$kind" = static ] || shared=ON
  cmake -S "$source" -B "$tree" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=$shared \
    -DLRRT_BUILD_TESTS=OFF -DLRRT_BUILD_EXAMPLES=OFF
  cmake --build "$tree" --parallel "${JOBS:-2}"
fi

rm -rf "$prefix" "$work/consumer" "$work"/loaded.*
cmake --install "$tree" --prefix "$prefix"
case "$kind" in
  static) test -f "$(find "$prefix" -name liblrrt.a)" ;;
  shared) test -L "$(find "$prefix" -name liblrrt.so)" ;;
esac

cmake -S "$source/tests/install" -B "$work/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix"
grep -q "^lrrt_DIR:PATH=$prefix" "$work/consumer/CMakeCache.txt"
cmake --build "$work/consumer"
LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" \
  "$work/consumer/consumer" "$source/tests/data/room.yaml" "$prefix/share/lrrt/models/default.onnx"

# The shared library takes the ONNX Runtime that was installed beside it, where there is one.
if [ "$kind" = shared ] && [ -e "$prefix/lib/libonnxruntime.so.1" ]; then
  grep -q "$prefix/lib/libonnxruntime.so.1" "$work"/loaded.*
fi
