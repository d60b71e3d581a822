#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes the lock files from the ranges, for every Python from 3.10 on and every platform:
#   requirements-dev.lock     tools and what lrrt needs to run, with the sha256 of every file of a release
#   constraints-training.txt  training and its tests, versions alone: PyTorch comes in builds of several makers
# LOCK_UPGRADE=yes takes the newest versions; otherwise what is locked stays where the ranges still allow it.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

tool="$deps/uv"
[ -x "$tool/bin/uv" ] || { "$venv/bin/python" -m venv "$tool" && "$tool/bin/python" -m pip install --quiet 'uv>=0.9,<1'; }
export UV_CUSTOM_COMPILE_COMMAND="make lock"
options=(--quiet --universal --python-version 3.10 --no-annotate)
[ "${LOCK_UPGRADE:-no}" = no ] || options+=(--upgrade)

say "Locking requirements-dev.lock"
"$tool/bin/uv" pip compile "${options[@]}" --generate-hashes requirements-dev.txt pyproject.toml -o requirements-dev.lock
say "Locking constraints-training.txt"
# lrrt itself is installed from this tree and has no release to lock
"$tool/bin/uv" pip compile "${options[@]}" --overrides <(echo 'lrrt; python_version < "3"') \
  --constraints requirements-dev.lock requirements-test.txt training/pyproject.toml --extra test \
  -o constraints-training.txt
sed -i -E '/^(nvidia-|cuda-|triton==)/d' constraints-training.txt  # each build of torch names its own, exactly
