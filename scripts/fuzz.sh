#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# fuzz.sh SECONDS [NAME...]: builds the fuzz targets of fuzz/ and runs each (or those named) so long; prints a table.
# Inputs that reach something new go to build/fuzz/corpus/NAME, and are gone on with; findings to build/fuzz/findings.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

seconds="${1:?fuzz.sh SECONDS [NAME...]}"
shift
folder="$root/build/fuzz"
findings="$folder/findings"
names=("$@")
if [ ${#names[@]} = 0 ]; then
  for source in "$root"/fuzz/fuzz_*.cpp; do
    name="$(basename "$source" .cpp)"
    names+=("${name#fuzz_}")
  done
fi

command -v clang++ >/dev/null || "$root/scripts/setup_apt.sh" clang
# Debian keeps libFuzzer and the sanitizers in a package of its own, where clang does not bring them.
links_fuzzer() { clang++ -fsanitize=fuzzer,address -x c++ -o /dev/null - 2>/dev/null <<<"$probe"; }
probe='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'
links_fuzzer || "$root/scripts/setup_apt.sh" "libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev"
links_fuzzer || die "clang++ finds no libFuzzer: install the compiler-rt of your Clang."
say "Building build/fuzz"
[ -f "$folder/build.ninja" ] || (cd "$root" && cmake --preset fuzz)
cmake --build "$folder" --parallel "${JOBS:-$(nproc)}" --target lrrt_fuzzers

# stat_of NAME LOG: a number of libFuzzer's final statistics.
stat_of() { awk -v key="stat::$1:" '$1 == key {print $2}' "$2"; }

failed=()
table="$(printf '%-12s %8s %12s %8s %9s %8s' target seconds executions per\ s branches inputs)"
for name in "${names[@]}"; do
  corpus="$folder/corpus/$name"
  log="$folder/fuzz_$name.log"
  mkdir -p "$corpus" "$findings"
  # ONNX Runtime keeps so much that looking through it takes most of the time; OMPL's LazyPRM loses some states.
  leaks=1
  [[ "$name" != @(onnx|plan) ]] || leaks=0
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -max_len=16384 -print_final_stats=1
    -detect_leaks=$leaks)
  [ ! -f "$root/fuzz/dictionaries/$name" ] || options+=(-dict="$root/fuzz/dictionaries/$name")
  say "fuzz_$name, $seconds s"
  began=$SECONDS
  outcome=
  if ! ASAN_OPTIONS="detect_leaks=$leaks" "$folder/fuzz/fuzz_$name" "${options[@]}" \
    -artifact_prefix="$findings/$name-" "$corpus" "$root/fuzz/corpus/$name" >"$log" 2>&1; then
    failed+=("$name")
    outcome="  FINDING, see $log"
  fi
  table+="$(printf '\n%-12s %8d %12s %8s %9s %8s%s' "$name" $((SECONDS - began)) \
    "$(stat_of number_of_executed_units "$log")" "$(stat_of average_exec_per_sec "$log")" \
    "$(grep -o ' cov: [0-9]*' "$log" | tail -1 | tr -dc 0-9)" "$(find "$corpus" -type f | wc -l)" "$outcome")"
done
printf '%s\n' "$table"
[ ${#failed[@]} = 0 ] || die "findings in: ${failed[*]}" \
  "Each lies in build/fuzz/findings; 'build/fuzz/fuzz/fuzz_NAME FILE' runs it again."
