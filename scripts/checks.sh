#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# checks.sh sanitize: every C++ test under the address and undefined-behaviour sanitizers, those of threads under the
#   thread sanitizer.
# checks.sh valgrind: the C++ examples under memcheck.
# checks.sh coverage: how many lines of src/ the C++ tests run; fails below LEAST_COVERAGE percent.
# The builds of each stay in build/PRESET.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

jobs="${JOBS:-$(nproc)}"

# build PRESET TARGETS...
build() {
  local preset="$1"
  shift
  say "Building build/$preset"
  cmake --preset "$preset" >/dev/null
  cmake --build "build/$preset" --parallel "$jobs" ${1:+--target "$@"}
}

sanitize() {
  build asan
  say "C++ tests under the address and undefined-behaviour sanitizers"
  ctest --preset asan --no-tests=error --parallel "$jobs"
  build tsan lrrt_thread_tests lrrt_load
  say "Tests of threads under the thread sanitizer"
  ctest --preset tsan --no-tests=error --parallel "$jobs"
}

run_valgrind() {
  build debug examples
  local example
  for example in build/debug/examples/example_*; do
    [ -x "$example" ] && [ -f "$example" ] || continue
    say "valgrind $(basename "$example")"
    valgrind --quiet --error-exitcode=1 --leak-check=full --errors-for-leak-kinds=definite \
      --suppressions=tests/sanitize/valgrind.supp "$example"
  done
}

forget_counts() { [ ! -d build/coverage ] || find build/coverage -name '*.gcda' -delete; }

coverage() {
  forget_counts  # of code that has changed since
  build coverage lrrt_tests lrrt_property_tests lrrt_thread_tests
  forget_counts  # of the listing of tests
  say "C++ tests, counted"
  ctest --preset coverage --no-tests=error --parallel "$jobs"
  mkdir -p build/coverage/report
  gcovr --root . --filter 'src/' --object-directory build/coverage/src --exclude-unreachable-branches \
    --html-details build/coverage/report/index.html --print-summary --fail-under-line "${LEAST_COVERAGE:-90}" \
    build/coverage/src
  say "Line by line: build/coverage/report/index.html"
}

case "${1:-}" in
  sanitize) sanitize ;;
  valgrind) run_valgrind ;;
  coverage) coverage ;;
  *) die "checks.sh: expected sanitize, valgrind or coverage" ;;
esac
