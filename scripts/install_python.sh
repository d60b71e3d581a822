#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# install_python.sh [PRESET]: installs the lrrt package into .venv, from what build.sh built; nothing is compiled twice.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

preset="${1:-release}"
mapfile -t inputs < <(find "$root/python/lrrt" "$root/build/$preset/python/stage" -type f -not -name '*.pyc' | sort)
want="$(fingerprint "${inputs[@]}" "${inputs[*]}" "$root/pyproject.toml" "$root/models/default.onnx")"
is_current lrrt "$want" && exit 0

say "Installing the lrrt package into .venv"
SKBUILD_BUILD_DIR="$root/build/$preset" pip_install --no-build-isolation "$root"
mark_current lrrt "$want"
