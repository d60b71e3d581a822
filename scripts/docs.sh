#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# docs.sh: builds the documentation's site into build/docs/html. Warnings are errors: a public symbol without a comment,
# a link that leads nowhere. Needs doxygen, and the lrrt package in .venv.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

want="$(fingerprint "$root/docs/requirements.txt" "$venv")"
if ! is_current docs "$want"; then
  say "Installing the tools of docs/requirements.txt"
  pip_install -r "$root/docs/requirements.txt"
  mark_current docs "$want"
fi

say "Reading the comments of the C++ headers"
rm -rf build/docs # neither Doxygen nor Sphinx notices all that has changed or is gone
mkdir -p build/docs
doxygen docs/Doxyfile || die "the comments of include/lrrt have faults, see above."

say "Building the site"
"$venv/bin/sphinx-build" -q -W --keep-going -b html -c docs -d build/docs/doctrees . build/docs/html
say "Open build/docs/html/index.html"
