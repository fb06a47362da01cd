#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the fuzz targets with clang and runs each from its seeds:  scripts/fuzz.sh [seconds [target ...]]
# Five seconds each by default. What it finds new goes to build/fuzz-corpus, crashes to build/fuzz-crashes.
set -eu
cd "$(dirname "$0")/.."
. scripts/packages.sh
ensure_packages $OSIO_PACKAGES $OSIO_FUZZ_PACKAGES
seconds=${1:-5}
[ $# -eq 0 ] || shift
mkdir -p build
{ cmake --preset fuzz && cmake --build --preset fuzz; } >build/fuzz.log 2>&1 || {
    tail -n 40 build/fuzz.log >&2
    echo "the build failed; all of its output is in build/fuzz.log" >&2
    exit 1
}
[ $# -gt 0 ] || set -- $(ls fuzz/seeds)
for target in "$@"; do
    mkdir -p "build/fuzz-corpus/$target" build/fuzz-crashes
    log=build/fuzz-crashes/$target.log
    UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 ASAN_OPTIONS=detect_leaks=0 \
        "build/fuzz/fuzz/fuzz_$target" -seed=1 -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=65536 \
        -artifact_prefix="build/fuzz-crashes/$target-" "build/fuzz-corpus/$target" "fuzz/seeds/$target" \
        >"$log" 2>&1 || {
        tail -n 60 "$log" >&2
        echo "$target: failed; its input is in build/fuzz-crashes" >&2
        exit 1
    }
    echo "$target: $(grep -o '^Done.*' "$log")"
done
