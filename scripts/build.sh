#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages that are missing, builds the release preset and stages it in
# build/stage. Afterwards:  . build/stage/env.sh
set -eu
cd "$(dirname "$0")/.."
. scripts/packages.sh
ensure_packages $OSIO_PACKAGES

log=build/release.log
mkdir -p build
{
    [ -f build/release/build.ninja ] || cmake --preset release
    cmake --build --preset release
    cmake --install build/release
} >"$log" 2>&1 || {
    tail -n 40 "$log" >&2
    echo "the build failed; all of its output is in $log" >&2
    exit 1
}
