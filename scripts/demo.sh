#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds, makes a spectral sample, shows it under three lights through stock oiiotool, and says where
# the results are.
set -eu
cd "$(dirname "$0")/.."
scripts/build.sh
. build/stage/env.sh

out=build/demo
mkdir -p "$out"
build/release/examples/colorchecker "$out/colorchecker.exr"

echo "The sample, as osiotool sees it:"
osiotool info "$out/colorchecker.exr"
echo

for light in D65 A FL11; do
    oiiotool "$out/colorchecker.exr?to=lin_rec709&illuminant=$light" -o "$out/lin_rec709_$light.exr"
done

# Three columns, one a light: above adapted to the light as an eye is, below not adapted.
set --
for row in adapted "not adapted"; do
    for light in D65 A FL11; do
        white=""
        [ "$row" = adapted ] || white="&white=D65"
        set -- "$@" --create 603x540 3 --fill:color=0.12,0.12,0.12 603x540 \
            "$out/colorchecker.exr?to=srgb&illuminant=$light$white" --swap --paste +0+36 \
            "--text:x=12:y=26:size=20:font=DejaVuSans" "$light, $row"
    done
done
oiiotool "$@" --mosaic:pad=6 3x2 --resize 1216x0 -d uint8 -o "$out/contact_sheet.png"

echo "In $out:"
echo "  colorchecker.exr            the spectral sample: 24 measured patches, 81 bands"
echo "  lin_rec709_{D65,A,FL11}.exr linear Rec.709 under daylight, tungsten and fluorescent light"
echo "  contact_sheet.png           all of it to look at; the greys of the last row match under D65 only"
