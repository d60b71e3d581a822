#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# lint.sh check|fix: clang-format, ruff and mypy, at the versions that requirements-dev.txt allows.
# lint.sh tidy PRESET: clang-tidy on the library, with the compile commands of build/PRESET.
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

if [ "$mode" = tidy ]; then
  say clang-tidy
  git ls-files 'src/*.cpp' | grep -v '/torch_' |
    xargs -P "${JOBS:-$(nproc)}" -n 1 clang-tidy --quiet -p "build/${2:-release}" 2>/dev/null ||
    die "clang-tidy has complaints, see above."
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
