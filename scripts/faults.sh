#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Damages files in many ways and counts what goes unnoticed:  scripts/faults.sh [copies]
# Without a number, the full campaign, which writes docs/damage.md.
set -eu
cd "$(dirname "$0")/.."
[ -x build/dev/tests/fault_campaign ] || { echo "build first: scripts/test.sh" >&2; exit 1; }
OIIO_LIBRARY_PATH=$(echo build/dev/lib/osio/oiio-*) \
    exec /usr/bin/python3 tests/faults/campaign.py build/dev/tests/fault_campaign . "$@"
