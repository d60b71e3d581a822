#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# make_packages.sh: lrrt and lrrt-dev as Debian packages and both in one archive, into dist/.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"
cd "$root"

say "Building build/package"
cmake --preset package
cmake --build build/package --parallel "${JOBS:-$(nproc)}"
rm -rf build/package/dist
(cd build/package && cpack -B dist)
mkdir -p dist
rm -f dist/lrrt*.deb* dist/lrrt-*-Linux-*.tar.gz*
cp build/package/dist/lrrt*.{deb,tar.gz}{,.sha256} dist/
say "Made $(cd dist && echo lrrt*.deb lrrt-*-Linux-*.tar.gz)"
