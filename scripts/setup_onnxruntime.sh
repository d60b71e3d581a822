#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Puts ONNX Runtime into .deps/onnxruntime/{include,lib}: pinned versions, checked by sha256.
# Headers: the libonnxruntime-dev package of a newer Debian suite, unpacked, never installed.
# Library: the Python wheel. Where the headers cannot be had: an npm package that holds both.
# Nothing is done when ONNXRUNTIME_ROOT names an installation of the user's own.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

deb_path=pool/main/o/onnxruntime/libonnxruntime-dev_1.21.0+dfsg-1_amd64.deb
deb_sha256=14f7d959d5deacbcf1504830d4189f91fc67382b399ed9ae9d3aa9c4050ced08

wheel_version=1.31.1
arch="$(uname -m)"
case "$arch" in
  x86_64) wheel_sha256=5752bd508126ae7c49894d3b9d2e83f0c3d487319246d04c444b393308d7ad7f ;;
  aarch64) wheel_sha256=da05378364c44d4407e463982d2bf8d5e4cfea873283757e48beeb41df97b7f3 ;;
  *) wheel_sha256= ;;
esac

npm_name=com.github.asus4.onnxruntime
npm_version=0.4.9
npm_sha256=e59788788818fdde1b2e522e766a21ba0f7d8391de55737abf81e32cc801785d

target="$deps/onnxruntime"
cache="$deps/downloads"
log="$cache/download.log"

# fetch_checked FILE SHA256 COMMAND...: COMMAND must write FILE.part; it becomes FILE only if its checksum holds.
fetch_checked() {
  local file=$1 sha256=$2
  shift 2
  checksum_is "$file" "$sha256" && return
  rm -f "$file" "$file.part"
  "$@" >>"$log" 2>&1 || return 1
  checksum_is "$file.part" "$sha256" ||
    die "$(basename "$file") was downloaded, but its sha256 is not $sha256." \
      "A proxy or mirror may have changed it. Try again, or set ONNXRUNTIME_ROOT to an installation of your own."
  mv "$file.part" "$file"
}

# The roots of the Debian archive in this machine's own apt configuration.
debian_mirrors() {
  # shellcheck disable=SC2016  # apt-get expands this itself
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 2>/dev/null | sort -u
}

download_deb() {
  local mirror
  for mirror in $(debian_mirrors); do
    /usr/lib/apt/apt-helper download-file "${mirror%/}/$deb_path" "$cache/headers.deb.part" && return
  done
  return 1
}

# Prints a Python that has pip: PYTHON (CMake names its own), else the one in .venv, else the system's.
python_with_pip() {
  local python
  for python in "${PYTHON:-}" "$venv/bin/python" python3; do
    if [ -n "$python" ] && "$python" -m pip --version >/dev/null 2>&1; then printf '%s\n' "$python"; return; fi
  done
  echo "no Python with pip was found: install python3-pip, or name one with PYTHON" >>"$log"
  return 1
}

download_wheel() {
  local folder
  folder="$(mktemp -d -p "$cache")"
  "$python" -m pip download --quiet --no-deps --only-binary=:all: --implementation cp --python-version 3.11 --abi cp311 \
    --platform "manylinux_2_28_$arch" --dest "$folder" "onnxruntime==$wheel_version" || { rm -rf "$folder"; return 1; }
  mv "$folder"/*.whl "$cache/library.whl.part"
  rm -rf "$folder"
}

download_npm() {
  local folder
  command -v npm >/dev/null || as_root apt-get install -y --no-install-recommends npm
  folder="$(mktemp -d -p "$cache")"
  (cd "$folder" && npm pack --silent "$npm_name@$npm_version") || { rm -rf "$folder"; return 1; }
  mv "$folder"/*.tgz "$cache/both.tgz.part"
  rm -rf "$folder"
}

# Each writes into $new/include.
headers_from_deb() {
  [ -n "$(debian_mirrors)" ] || return 1
  say "ONNX Runtime headers: from Debian's libonnxruntime-dev (85 KB)"
  fetch_checked "$cache/headers.deb" "$deb_sha256" download_deb || return 1
  dpkg-deb -x "$cache/headers.deb" "$new/deb"
  mv "$new/deb/usr/include/onnxruntime" "$new/include"
  rm -rf "$new/deb"
}

headers_from_npm() {
  say "ONNX Runtime headers: no Debian mirror offers them here; from the npm package $npm_name (150 MB)"
  fetch_checked "$cache/both.tgz" "$npm_sha256" download_npm || return 1
  mkdir "$new/npm"
  tar -xzf "$cache/both.tgz" -C "$new/npm" --wildcards '*/ios-arm64/*/Headers/*'
  mv "$(dirname "$(find "$new/npm" -name onnxruntime_cxx_api.h -print -quit)")" "$new/include"
  rm -rf "$new/npm"
}

library_from_wheel() {
  local python
  python="$(python_with_pip)" || return 1
  say "ONNX Runtime library $wheel_version: from its Python wheel (24 MB)"
  fetch_checked "$cache/library.whl" "$wheel_sha256" download_wheel || return 1
  "$python" -m zipfile -e "$cache/library.whl" "$new/wheel"
  mkdir "$new/lib"
  mv "$new/wheel/onnxruntime/capi/libonnxruntime.so.$wheel_version" "$new/lib/"
  mv "$new/wheel/onnxruntime/LICENSE" "$new/wheel/onnxruntime/ThirdPartyNotices.txt" "$new/"
  rm -rf "$new/wheel"
  ln -s "libonnxruntime.so.$wheel_version" "$new/lib/libonnxruntime.so.1"
  ln -s libonnxruntime.so.1 "$new/lib/libonnxruntime.so"
}

give_up() {
  tail -n 5 "$log" >&2 || true
  die "the ONNX Runtime $1 could not be downloaded." \
    "Is the network up? Behind a proxy, set http_proxy and https_proxy; pip, apt and npm each honour a mirror of their own." \
    "Or install ONNX Runtime 1.21 or newer yourself and set ONNXRUNTIME_ROOT to the folder with its include/ and lib/." \
    "The full log is $log. What was downloaded stays; run the command again to go on."
}

if [ -n "${ONNXRUNTIME_ROOT:-}" ]; then
  [ -d "$ONNXRUNTIME_ROOT" ] || die "ONNXRUNTIME_ROOT=$ONNXRUNTIME_ROOT is not a folder."
  exit 0
fi

want="$(fingerprint "$deb_sha256" "$wheel_version" "$npm_sha256" "$arch")"
[ -e "$target/lib/libonnxruntime.so" ] && is_current onnxruntime "$want" && exit 0

[ -n "$wheel_sha256" ] || die "no ONNX Runtime is pinned for the processor type $arch." \
  "Install ONNX Runtime 1.21 or newer and set ONNXRUNTIME_ROOT to the folder with its include/ and lib/."
mkdir -p "$cache"
rm -rf "$deps"/tmp.* "$cache"/tmp.*  # left by an interrupted run
: >"$log"
new="$(mktemp -d -p "$deps")"
trap 'rm -rf "$new"' EXIT
headers_from_deb || headers_from_npm || give_up headers
library_from_wheel || give_up library
chmod 755 "$new"
rm -rf "$target"
mv "$new" "$target"
mark_current onnxruntime "$want"
rm -rf "$cache"
say "ONNX Runtime is in .deps/onnxruntime"
