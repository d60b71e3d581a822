#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# build.sh [PRESET]: configures where needed and builds library, programs, tests and Python module into build/PRESET.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

preset="${1:-release}"
folder="$root/build/$preset"
python="$venv/bin/python"

want="$(fingerprint "$root/CMakePresets.json" "$venv" "$("$python" -VV)" "$(cmake --version)" "${ONNXRUNTIME_ROOT:-}")"
if [ ! -f "$folder/build.ninja" ] || ! is_current "configure-$preset" "$want"; then
  say "Configuring build/$preset"
  (cd "$root" && cmake --preset "$preset" -DLRRT_BUILD_PYTHON=ON -DPython_EXECUTABLE="$python" \
    -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)")
  mark_current "configure-$preset" "$want"
fi

say "Building build/$preset"
cmake --build "$folder" --parallel "${JOBS:-$(nproc)}"
