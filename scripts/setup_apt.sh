#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# setup_apt.sh [PACKAGE...]: installs what is missing of scripts/apt-packages.txt and of the packages named, and Python
# where python3 cannot do the job.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

mapfile -t packages <"$root/scripts/apt-packages.txt"
packages+=("$@")
find_python >/dev/null || packages+=(python3 python3-dev python3-venv)

if ! command -v apt-get >/dev/null; then
  say "No apt-get here: CMake will name whatever is missing of: ${packages[*]}"
  exit 0
fi

installed="$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)"
missing=()
for package in "${packages[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

say "Installing with apt: ${missing[*]}"
as_root dpkg --configure -a
as_root apt-get update -qq || say "apt-get update reported problems; going on with what it has"
as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -qq -y --no-install-recommends -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "${missing[@]}" ||
  die "apt could not install: ${missing[*]}" \
    "Is the network up, and is the proxy or mirror in /etc/apt right? On Ubuntu the 'universe' component must be enabled." \
    "Run the command again to go on."
