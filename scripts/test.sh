#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds everything, warnings as errors, and runs all tests; closes with ctest's summary. Arguments go
# to ctest:  scripts/test.sh -R Plan
set -eu
cd "$(dirname "$0")/.."
. scripts/packages.sh
ensure_packages $OSIO_TEST_PACKAGES
scripts/build.sh
cmake --preset dev >build/dev.log 2>&1 && cmake --build --preset dev >>build/dev.log 2>&1 || {
    tail -n 40 build/dev.log >&2
    echo "the build failed; all of its output is in build/dev.log" >&2
    exit 1
}
ctest --preset dev -j "$(nproc)" "$@"
