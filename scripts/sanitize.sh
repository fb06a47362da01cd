#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds a sanitizer preset and runs the tests under it:  scripts/sanitize.sh asan|tsan [ctest options]
set -eu
cd "$(dirname "$0")/.."
preset=${1:?"usage: scripts/sanitize.sh asan|tsan [ctest options]"}
shift
. scripts/packages.sh
ensure_packages $OSIO_PACKAGES $OSIO_TEST_PACKAGES
mkdir -p build
{ cmake --preset "$preset" && cmake --build --preset "$preset"; } >"build/$preset.log" 2>&1 || {
    tail -n 40 "build/$preset.log" >&2
    echo "the build failed; all of its output is in build/$preset.log" >&2
    exit 1
}
ctest --preset "$preset" -j "$(nproc)" "$@"
