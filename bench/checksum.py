#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What the checksum costs a reader:  bench/checksum.py [bands]   (default 31; 1920x1080, half, zip and none)

The same file twice; a byte behind the last chunk makes the checksum another file's, which is not looked at.
Medians of 15 of whole commands, one after the other in turn."""

import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import OpenImageIO as oiio

OSIOTOOL = os.path.join(os.path.dirname(__file__), "..", "build", "stage", "bin", "osiotool")
RUNS = 15


def write(path, bands, compression):
    random = np.random.default_rng(1)
    y, x = np.mgrid[0:1080, 0:1920]
    spec = oiio.ImageSpec(1920, 1080, bands, oiio.HALF)
    spec.channelnames = tuple(f"T.{400 + i * 300 // max(1, bands - 1)}nm" for i in range(bands))
    spec.attribute("compression", compression)
    pixels = np.stack([0.5 + 0.3 * np.sin(0.01 * x + 0.2 * b) * np.cos(0.013 * y) +
                       random.normal(0, 0.003, x.shape) for b in range(bands)], -1).astype(np.float16)
    output = oiio.ImageOutput.create("spectralexr")
    if not (output.open(path, spec) and output.write_image(pixels) and output.close()):
        sys.exit(output.geterror())


def seconds(path, folder):
    began = time.perf_counter()
    subprocess.run([OSIOTOOL, "collapse", path, os.path.join(folder, "o.exr"), "--to", "lin_rec709", "--illuminant",
                    "D65", "-d", "half", "--quiet"], check=True)
    return time.perf_counter() - began


def main():
    bands = int(sys.argv[1]) if len(sys.argv) > 1 else 31
    with tempfile.TemporaryDirectory() as folder:
        for compression in ("zip", "none"):
            with_sum, without = (os.path.join(folder, name) for name in ("with.exr", "without.exr"))
            write(with_sum, bands, compression)
            with open(with_sum, "rb") as file:
                data = file.read()
            with open(without, "wb") as file:
                file.write(data + b"\0")
            times = {with_sum: [], without: []}
            for _ in range(RUNS):
                for path, list_ in times.items():
                    list_.append(seconds(path, folder))
            a, b = (statistics.median(times[p]) for p in (with_sum, without))
            print(f"{bands} bands {compression}, {len(data) / 1e6:.0f} MB: {a * 1e3:.0f} ms with the checksum, "
                  f"{b * 1e3:.0f} ms without, {100 * (a / b - 1):+.1f} %")


if __name__ == "__main__":
    main()
