#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run.sh static|shared WORK_FOLDER [BUILD_TREE]: installs the library, moves the installation elsewhere, and checks it
# there. Without BUILD_TREE the library is built first, in WORK_FOLDER.
set -euo pipefail

kind=$1
work=$2
source="$(cd "$(dirname "$0")/../.." && pwd)"
tree="${3:-$work/library}"

if [ $# -lt 3 ]; then
  shared=OFF
  [ "$kind" = static ] || shared=ON
  cmake -S "$source" -B "$tree" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=$shared \
    -DLRRT_RELOCATABLE=ON -DLRRT_BUILD_TESTS=OFF -DLRRT_BUILD_EXAMPLES=OFF
  cmake --build "$tree" --parallel "${JOBS:-2}"
fi

rm -rf "$work/first" "$work/prefix"
cmake --install "$tree" --prefix "$work/first"
mv "$work/first" "$work/prefix"
case "$kind" in
  static) test -f "$(find "$work/prefix" -name liblrrt.a)" ;;
  shared) test -L "$(find "$work/prefix" -name liblrrt.so)" ;;
esac
"$source/tests/install/check.sh" "$work/prefix" "$work/consumers"
