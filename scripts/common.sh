# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Shared by the set-up scripts: where things are, how to talk, how to stop.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
deps="$root/.deps"
venv="$root/.venv"
stamps="$deps/stamps"

# The version, which CMakeLists.txt states.
version="$(sed -n 's/^project(lrrt VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")"

say() { printf '==> %s\n' "$*"; }

die() {
  printf 'error: %s\n' "$1" >&2
  shift
  for line in "$@"; do printf '       %s\n' "$line" >&2; done
  exit 1
}

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; return; fi
  command -v sudo >/dev/null || die "root rights are needed to run: $*" \
    "Run make as root, or install sudo."
  sudo "$@"
}

# checksum_is FILE SHA256: true when FILE exists and has that checksum.
checksum_is() { [ -f "$1" ] && [ "$(sha256sum "$1" | cut -d' ' -f1)" = "$2" ]; }

# fingerprint TEXT_OR_FILES...: one hash over the contents of files (and over words that are no files).
fingerprint() {
  for item in "$@"; do
    if [ -f "$item" ]; then cat "$item"; else printf '%s\n' "$item"; fi
  done | sha256sum | cut -d' ' -f1
}

# is_current NAME FINGERPRINT / mark_current NAME FINGERPRINT: stamps, written only after success.
is_current() { [ "$(cat "$stamps/$1" 2>/dev/null)" = "$2" ]; }
mark_current() {
  mkdir -p "$stamps"
  printf '%s\n' "$2" >"$stamps/$1.tmp"
  mv "$stamps/$1.tmp" "$stamps/$1"
}

# Prints a Python (PYTHON, else python3, else the system's) that is new enough and can make a venv and build modules.
find_python() {
  local python
  for python in "${PYTHON:-python3}" /usr/bin/python3; do
    if "$python" - 2>/dev/null <<'PY'; then command -v "$python"; return; fi
import ensurepip, os, sys, sysconfig, venv
assert sys.version_info >= (3, 10) and os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h"))
PY
  done
  return 1
}

# True unless LOCKED=no: the versions of the lock files (scripts/lock.sh writes them) are installed.
is_locked() { [ "${LOCKED:-yes}" != no ]; }

# pip install into .venv, with advice when it fails.
pip_install() {
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --retries 5 "$@" ||
    die "pip install failed: $*" \
      "Is the network up? Behind a proxy set https_proxy; for a mirror set PIP_INDEX_URL." \
      "Where a checksum or a version of a lock file cannot be met (another Python, a mirror's own builds): LOCKED=no" \
      "installs what the ranges allow." \
      "Wheels that were downloaded stay in pip's cache; run the command again to go on."
}
