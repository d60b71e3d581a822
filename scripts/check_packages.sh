#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_packages.sh [debs] [wheel] [sdist]: makes the packages and tries each as its user would, away from this tree:
#   debs   both .deb files unpacked into an empty folder and the archive into another; tests/install/check.sh on each
#   wheel  installed into a new environment with nothing else; examples, tests/install/consumer.py, mypy --strict
#   sdist  pip install of the source archive into a new environment, where no ONNX Runtime lies about
# Without words: all three.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

work="$root/build/package-check"
unset PYTHONPATH LRRT_MODEL LRRT_ONNXRUNTIME

# holds FOLDER TEXT: where TEXT stands in any file of FOLDER.
holds() { grep -rlF -e "$2" "$1" || true; }

check_prefix() {
  local found
  found="$(holds "$1" "$root")"
  [ -z "$found" ] || die "these files name the folder that they were built in:" "$found"
  say "Using $(basename "$(dirname "$1")"), away from this tree"
  tests/install/check.sh "$1" "$2"
}

check_debs() {
  scripts/make_packages.sh
  local runtime development field
  runtime="$(echo dist/lrrt_*.deb)"
  development="$(echo dist/lrrt-dev_*.deb)"
  field="$(dpkg-deb -f "$runtime" Depends)"
  for library in libc6 libompl libopencv-core libopencv-imgcodecs libyaml-cpp; do
    grep -q "$library" <<<"$field" || die "$runtime does not depend on $library" "Depends: $field"
  done
  dpkg-deb -f "$development" Depends | grep "lrrt (= $version)" >/dev/null || die "$development must depend on lrrt (= $version)"
  if [ -n "$(apt-cache policy libompl-dev 2>/dev/null)" ]; then
    apt-get install --simulate --no-install-recommends "./$runtime" "./$development" >/dev/null ||
      die "apt cannot satisfy what $runtime and $development depend on"
  fi
  rm -rf "$work/debs" "$work/archive"
  mkdir -p "$work/debs" "$work/archive/usr"
  dpkg-deb -x "$runtime" "$work/debs"
  dpkg-deb -x "$development" "$work/debs"
  check_prefix "$work/debs/usr" "$work/with-debs"
  tar -xzf dist/lrrt-"$version"-Linux-*.tar.gz -C "$work/archive/usr" --strip-components 1
  check_prefix "$work/archive/usr" "$work/with-archive"
}

# new_venv NAME: an environment with pip and nothing else, made anew.
new_venv() {
  rm -rf "${work:?}/$1"
  "$venv/bin/python" -m venv "$work/$1"
}

pip_into() {
  local name=$1
  shift
  "$work/$name/bin/python" -m pip install --quiet --disable-pip-version-check --retries 5 "$@" ||
    die "pip install failed: $*"
}

# use_python NAME: the package of an environment, used from an empty folder.
use_python() {
  local python="$work/$1/bin/python" folder="$work/$1-use" said
  rm -rf "$folder"
  mkdir -p "$folder"
  "$python" -m pip check
  said="$(cd "$folder" && "$work/$1/bin/lrrt" --version)"
  [ "$said" = "lrrt $version" ] || die "lrrt --version says '$said', expected 'lrrt $version'"
  (cd "$folder" && "$python" "$root/tests/install/consumer.py")
}

check_wheel() {
  scripts/make_wheel.sh
  local wheel size
  wheel="$(echo dist/lrrt-*.whl)"
  size="$(stat -c %s "$wheel")"
  [ "$size" -lt 80000000 ] || die "$wheel has $size bytes, expected less than 80 million: what was bundled?"
  new_venv wheel
  pip_into wheel "$wheel"
  say "Using the wheel, away from this tree"
  use_python wheel
  (cd "$work/wheel-use" && for example in "$root"/examples/0*.py; do "$work/wheel/bin/python" "$example"; done)
  "$work/wheel/bin/python" - <<'PY'
import lrrt
lrrt.OnnxPredictor()
with open("/proc/self/maps") as maps:
    mapped = {line.split()[-1] for line in maps if ".so" in line}
ours = ("libompl", "libopencv", "libyaml-cpp", "libboost", "libonnxruntime", "libGL", "libX11")
foreign = sorted(path for path in mapped if any(name in path for name in ours) and "/site-packages/lrrt" not in path)
assert not foreign, f"the wheel does not hold, but loads: {foreign}"
PY
  say "mypy --strict on a program that uses the wheel"
  (cd "$work/wheel-use" &&
    "$venv/bin/mypy" --strict --python-executable "$work/wheel/bin/python" "$root/tests/install/consumer.py")
}

check_sdist() {
  local archive="$work/sources/lrrt-$version.tar.gz"
  rm -rf "$work/sources"
  "$venv/bin/python" -m build --quiet --sdist --no-isolation --outdir "$work/sources" .
  tar -tzf "$archive" | grep -E '^[^/]*/(tests|bench|training|docs|examples|\.[a-z])' &&
    die "$archive holds what no build needs, see above."
  new_venv sdist
  say "Installing from $(basename "$archive") with pip: it builds, and downloads ONNX Runtime"
  env -u ONNXRUNTIME_ROOT CMAKE_BUILD_PARALLEL_LEVEL="${JOBS:-$(nproc)}" \
    "$work/sdist/bin/python" -m pip install --quiet --disable-pip-version-check --retries 5 "$archive" ||
    die "pip install $archive failed"
  find "$work/sdist" -path '*/lrrt/libonnxruntime.so.1' | grep . >/dev/null || die "no ONNX Runtime was put into the package"
  use_python sdist
}

mkdir -p "$work"
[ $# -gt 0 ] || set -- debs wheel sdist
for part in "$@"; do
  case "$part" in
    debs | wheel | sdist) time "check_$part" ;;
    *) die "'$part' is no part of this check: expected debs, wheel or sdist" ;;
  esac
done
say "The packages work: $*"
