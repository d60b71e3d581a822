#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# lint.sh check|fix: clang-format, ruff and mypy, at the versions that requirements-dev.txt allows.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

mode="${1:-check}"
bin="$venv/bin"
mapfile -t cpp < <(git ls-files --cached --others --exclude-standard '*.cpp' '*.hpp')

if [ "$mode" = fix ]; then
  [ ${#cpp[@]} = 0 ] || "$bin/clang-format" -i "${cpp[@]}"
  "$bin/ruff" check --fix .
  "$bin/ruff" format .
  exit 0
fi

failed=()
check() {
  local name="$1"
  shift
  say "$name"
  "$@" || failed+=("$name")
}
[ ${#cpp[@]} = 0 ] || check clang-format "$bin/clang-format" --dry-run --Werror "${cpp[@]}"
check "ruff check" "$bin/ruff" check .
check "ruff format" "$bin/ruff" format --check .
check mypy "$bin/mypy"
[ ${#failed[@]} = 0 ] || die "failed: ${failed[*]}" "'make format' mends what can be mended by itself."
