#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the training package, editable, with PyTorch and all else it needs. Needs the lrrt package in .venv.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

# Versions alone, no checksums: PyTorch comes in builds of several makers.
constraints=(-c "$root/constraints-training.txt")
is_locked || constraints=()

want="$(fingerprint "$root/requirements-test.txt" "${constraints[@]}")"
if ! is_current tests "$want"; then
  say "Installing Ray and OMPL's own Python package, for tests"
  (pip_install "${constraints[@]}" -r "$root/requirements-test.txt") || say "one of them is not to be had here: its tests will be skipped"
  mark_current tests "$want"
fi

want="$(fingerprint "$root/training/pyproject.toml" "$root/training/setup.py" "${constraints[@]}")"
is_current training "$want" && exit 0
say "Installing the training package; PyTorch brings about 3 GB of downloads"
pip_install "${constraints[@]}" -e "$root/training[test]"
mark_current training "$want"
