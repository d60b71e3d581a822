# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Shared by the set-up scripts: where things are, how to talk, how to stop.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
deps="$root/.deps"
venv="$root/.venv"
stamps="$deps/stamps"

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
