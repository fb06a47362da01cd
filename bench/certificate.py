#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What proof costs: a collapse with a certificate, with a tolerance, and a trade, against the collapse alone.

    . build/stage/env.sh && bench/certificate.py [--size 1920x1080] [--rounds 7]

Makes noisy images of 31 and 81 bands, half and float, zip, runs every command once in each round, and prints a
Markdown table: median seconds, the median of the ratios to the collapse of the same round, peak memory. Then the
seconds of one `osiotool trade` of the float image of 31 bands."""

import argparse
import os
import tempfile

import numpy as np
import OpenImageIO as oiio
from commands import make_image, measure, run


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--size", default="1920x1080")
    arguments.add_argument("--rounds", type=int, default=7)
    options = arguments.parse_args()
    width, height = map(int, options.size.split("x"))
    with tempfile.TemporaryDirectory() as folder:
        image, out = os.path.join(folder, "shot.exr"), os.path.join(folder, "out.exr")
        print("| image | | s | ratio | MB |\n|---|---|--:|--:|--:|")
        for bands in (31, 81):
            for samples in ("half", "float"):
                make_image(image, np.linspace(400, 700, bands), width, height, getattr(oiio, samples.upper()))
                collapse = ["osiotool", "collapse", image, out, "--to", "lin_rec709", "--illuminant", "D65", "--quiet"]
                proof = os.path.join(folder, "proof.json")
                rows = measure({"plain": ("collapse", collapse),
                                "certificate": ("`--certificate`", [*collapse, "--certificate", proof]),
                                "tolerance": ("`--max-delta-e 1`", [*collapse, "--max-delta-e", "1"])}, options.rounds)
                for row in rows.values():
                    print(f"| {options.size}, {bands} bands, {samples} | {row} |", flush=True)
                if (bands, samples) == (31, "float"):
                    seconds, megabytes = run(["osiotool", "trade", image, "--illuminant", "FL11", "--quiet"])
                    print(f"| the same | `osiotool trade`, once | {seconds:.1f} | | {megabytes:.0f} |", flush=True)


if __name__ == "__main__":
    main()
