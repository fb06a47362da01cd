#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Damages generated files of every compression and writes docs/damage.md:

    scripts/faults.sh            10 000 truncations and 10 000 bit flips of each of 20 files
    scripts/faults.sh 200        as many as are named; prints, and leaves docs/damage.md alone

Files by OpenImageIO's own OpenEXR writer carry no checksum ("foreign"); those by ours do ("own"). The
process fails where what is asked is not kept: no silent damage by truncation, in deflated bytes, and
in our own files anywhere."""

import collections
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import OpenImageIO as oiio

COMPRESSIONS = ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab")
REGIONS = ("header", "table", "chunkheader", "deflated", "collision", "stored", "packed")
FULL = 10000


def pictures(folder):
    """A file of each compression by both writers: 8 bands, 48x40, half, smooth with a little noise."""
    random = np.random.default_rng(1)
    y, x = np.mgrid[0:40, 0:48]
    bands = [0.5 + 0.3 * np.sin(0.1 * x + 0.5 * b) * np.cos(0.13 * y) + random.normal(0, 0.002, x.shape)
             for b in range(8)]
    bands[0][:20] = random.uniform(0, 1, (20, 48))
    pixels = np.stack(bands, -1).astype(np.float32)
    for compression in COMPRESSIONS:
        for writer in ("openexr", "spectralexr"):
            spec = oiio.ImageSpec(48, 40, 8, oiio.HALF)
            spec.channelnames = tuple(f"T.{400 + 40 * b}nm" for b in range(8))
            spec.attribute("compression", compression)
            output = oiio.ImageOutput.create(writer)
            path = os.path.join(folder, f"{'own' if writer == 'spectralexr' else 'foreign'}-{compression}")
            if not (output.open(path, spec) and output.write_image(pixels) and output.close()):
                sys.exit(output.geterror())
            yield path


def run(program, kind, count, path):
    text = subprocess.run([program, kind, str(count), "1", path], capture_output=True, text=True, check=False)
    if text.returncode != 0:
        sys.exit(f"{path}: the campaign ended with {text.returncode}: {text.stderr}")
    out = {}
    for line in text.stdout.splitlines():
        _, region, *numbers = line.split()
        out[region] = [int(n) for n in numbers]
    return out


def main():
    program, source = sys.argv[1:3]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else FULL
    with tempfile.TemporaryDirectory() as folder:
        paths = list(pictures(folder))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            cuts = dict(zip(paths, pool.map(lambda p: run(program, "truncate", count, p), paths)))
            flips = dict(zip(paths, pool.map(lambda p: run(program, "flip", count, p), paths)))
    lines, broken = [], []
    totals = collections.defaultdict(lambda: [0, 0])
    for owner in ("foreign", "own"):
        lines += ["", f"| {owner} | truncated | " + " | ".join(REGIONS) + " |", "|---" * (2 + len(REGIONS)) + "|"]
        for compression in COMPRESSIONS:
            path = next(p for p in paths if p.endswith(f"/{owner}-{compression}"))
            cut = sum(n[3] for n in cuts[path].values())
            cells = [f"{cut} of {count}"]
            totals[owner, "cut"][0] += cut
            totals[owner, "cut"][1] += count
            if cut:
                broken.append(f"{owner} {compression}: {cut} silent truncations")
            for region in REGIONS:
                copies, _, _, silent = flips[path].get(region, (0, 0, 0, 0))
                cells.append(f"{silent} of {copies}" if copies else "")
                totals[owner, "flip"][0] += silent
                totals[owner, "flip"][1] += copies
                if silent and (owner == "own" or region == "deflated"):
                    broken.append(f"{owner} {compression}: {silent} silent flips in {region}")
            lines.append(f"| {compression} | " + " | ".join(cells) + " |")
    summary = "; ".join(f"{owner} files: {totals[owner, 'cut'][0]} of {totals[owner, 'cut'][1]} truncations and "
                        f"{totals[owner, 'flip'][0]} of {totals[owner, 'flip'][1]} bit flips silent"
                        for owner in ("own", "foreign"))
    text = HEAD.format(count=f"{count:,}".replace(",", " "), summary=summary) + "\n".join(lines) + "\n"
    print(summary)
    if count >= FULL:
        with open(os.path.join(source, "docs", "damage.md"), "w", encoding="utf-8") as file:
            file.write(text)
    else:
        print("\n".join(lines))
    if broken:
        sys.exit("\n".join(broken))


HEAD = """# What damage goes unnoticed

Made by `scripts/faults.sh`, which writes this page. Of each file, {count} copies were cut at a random byte and {count} had
one random bit flipped; each was collapsed. *Silent*: no error, and colour unlike the undamaged file's. Other
copies were refused, or gave the same colour to the bit. Files: 8 bands, 48x40, half, some of it noise.

{summary}.

Foreign files are written by OpenImageIO's own OpenEXR writer and hold no checksum. Deflated bytes carry one by their
nature (Adler-32). It is weak where bytes repeat: one bit that changes the distance of a match can move bytes about so
that both of its sums stay, and then every reader of zlib streams takes them for sound; such flips have a column of their
own. All other payload, and the header, carry none, and what a flipped bit does there is the colour of a few pixels or of
a band. Files of our own hold a checksum of every chunk and of the header
([decision](design/0009-damage.md)).

Columns: truncations; then bit flips by where they were: header, table of chunks, the chunks' own headers, deflated
payload (refused, or the same colour); deflated payload whose Adler-32 the flip left as it was; chunks stored as they are;
payload of other compressions.
"""


if __name__ == "__main__":
    main()
