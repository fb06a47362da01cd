#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The same bits from g++ and clang++:  scripts/one_answer.sh [preset of g++'s build, dev]
# Each runs 1 to 8 threads on every instruction set of this machine; see tests/kernel/one_answer.cpp.
set -eu
cd "$(dirname "$0")/.."
. scripts/packages.sh
ensure_packages $OSIO_PACKAGES $OSIO_TEST_PACKAGES $OSIO_FUZZ_PACKAGES
preset=${1:-dev}
mkdir -p build
for p in "$preset" fuzz; do
    { cmake --preset "$p" && cmake --build --preset "$p" --target one_answer; } >"build/one_answer-$p.log" 2>&1 || {
        tail -n 40 "build/one_answer-$p.log" >&2
        echo "the build failed; all of its output is in build/one_answer-$p.log" >&2
        exit 1
    }
done
gcc=$("build/$preset/tests/kernel/one_answer" | tail -n 1)
clang=$(build/fuzz/tests/kernel/one_answer | tail -n 1)
echo "g++: $gcc, clang++: $clang"
[ "$gcc" = "$clang" ] || { echo "the two compilers give different pixels" >&2; exit 1; }
