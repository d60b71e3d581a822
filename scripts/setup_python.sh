#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the virtual environment .venv with the tools of requirements-dev.lock: every file that pip takes must have one of
# the checksums there. LOCKED=no takes what requirements-dev.txt allows instead.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

python="$(find_python)" || die "no Python 3.10 or newer with venv and headers was found." \
  "Install python3, python3-dev and python3-venv, or set PYTHON to an interpreter that has them."

want="$(fingerprint "$venv" "$("$python" -VV)")"
if [ ! -x "$venv/bin/python" ] || ! is_current venv "$want"; then
  say "Making .venv with $("$python" -V)"
  rm -f "$stamps"/{python,training,tests,lrrt,docs}
  "$python" -m venv --clear "$venv"
  mark_current venv "$want"
fi

tools=(--require-hashes -r "$root/requirements-dev.lock")
is_locked || tools=(--upgrade -r "$root/requirements-dev.txt")
want="$(fingerprint "${tools[*]}" "${tools[-1]}")"
if ! is_current python "$want"; then
  say "Installing the Python tools of $(basename "${tools[-1]}")"
  pip_install "${tools[@]}"
  mark_current python "$want"
fi
