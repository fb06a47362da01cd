#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What `osiotool reduce` saves and loses: makes the tables of docs/accuracy.md that are marked `reduce`.

    . build/stage/env.sh && bench/reduce.py [--size 1920x1080] [--small 480x270] [--rounds 5] [--images FOLDER] [--write]

Scenes are made here, from seeds, and chose nothing in the product. Beside the reduction stand plain bands at equal steps
(`convert --resample --half`) and the principal components of all pixels, as many as the reduction has bands, in halves; what
is lost is the largest `osiotool difference` under any of the four lights. Times are medians of whole commands in alternating rounds.
--images adds the spectral files of a folder. Without --write the tables are printed only. Needs numpy and OpenImageIO's
Python module."""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import OpenImageIO as oiio

from accuracy import PAGE, replaced
from tables import COLORCHECKER, NM

LIGHTS = ("D65", "A", "FL11", "LED-B3")
ANOTHER = "FL2"  # that nobody named
TOLERANCE = "0.5"
GRID = np.arange(380, 781, 5.0)
COLLAPSE = ("--to", "lin_rec709", "--illuminant", "D65", "--quiet")
NOISE = 0.02  # of a sample


def humps(width, height, row, random):
    """Reflectances of four wide humps each, which move over the image."""
    x = np.linspace(0, 1, width)[:, None]
    y = row / height
    out = np.full((width, len(GRID)), 0.06)
    for phase, spread in ((0.1, 55), (0.35, 40), (0.6, 70), (0.85, 48)):
        centre = 400 + 300 * (0.5 + 0.5 * np.sin(2 * np.pi * (phase + 0.8 * x + 0.5 * y * (1 + phase))))
        height_of = 0.21 * (0.5 + 0.5 * np.cos(2 * np.pi * (1.3 * phase + y - 0.6 * x)))
        out = out + height_of * np.exp(-((GRID - centre) / spread) ** 2)
    return out


def noisy(width, height, row, random):
    smooth = humps(width, height, row, random)
    return np.clip(smooth * (1 + random.normal(0, NOISE, smooth.shape)), 0, None)


def colorchecker(width, height, row, random):
    """The 24 patches, each shaded from a fifth to the whole, with noise of a hundredth."""
    patches = np.stack([np.interp(GRID, NM, curve) for curve in COLORCHECKER])
    across = np.minimum(np.arange(width) * 6 // width, 5)
    shade = 0.2 + 0.8 * (np.arange(width) * 6 % width / width)
    spectra = patches[across + 6 * min(row * 4 // height, 3)] * shade[:, None]
    return spectra * (1 + random.normal(0, NOISE / 2, spectra.shape))


def dichroics(width, height, row, random):
    """Cells of filters with edges of 1 to 8 nm: long pass, short pass, band pass and notch, over a grey."""
    cells = np.random.default_rng([7, row * 9 // height])
    low, wide, soft = cells.uniform(410, 640, 16), cells.uniform(12, 120, 16), cells.uniform(1, 8, 16)
    kind, floor = cells.integers(0, 4, 16), cells.uniform(0.01, 0.1, 16)
    cell = np.minimum(np.arange(width) * 16 // width, 15)
    shade = 0.25 + 0.75 * (np.arange(width) * 16 % width / width)

    def edge(at):
        return 1 / (1 + np.exp(np.clip(-(GRID - at[:, None]) / soft[:, None], -60, 60)))

    up, down = edge(low), 1 - edge(low + wide)
    shape = np.where(kind[:, None] == 0, up, np.where(kind[:, None] == 1, 1 - up,
                     np.where(kind[:, None] == 2, up * down, 1 - up * down)))
    return (floor[:, None] + (0.95 - floor[:, None]) * shape)[cell] * shade[:, None]


SCENES = {"smooth": humps, "noisy": noisy, "ColorChecker": colorchecker, "dichroics": dichroics}


def write(path, rows, width, height, samples=oiio.FLOAT):
    """Rows of spectra as zip-compressed bands of GRID."""
    spec = oiio.ImageSpec(width, height, len(GRID), samples)
    spec.channelnames = tuple(f"T.{nm:g}nm" for nm in GRID)
    spec.attribute("compression", "zip")
    sink = oiio.ImageOutput.create("openexr")
    assert sink.open(path, spec), sink.geterror()
    for number, row in enumerate(rows):
        sink.write_scanline(number, 0, row.astype(np.float32))
    assert sink.close(), sink.geterror()


def make(path, scene, width, height):
    random = np.random.default_rng(20261128)
    write(path, (SCENES[scene](width, height, row, random) for row in range(height)), width, height)


def osiotool(*words):
    result = subprocess.run(["osiotool", *words], capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"osiotool {' '.join(words)}\n{result.stderr}")
    return result.stdout


def lost(source, other, lights):
    """(mean, largest) CIEDE2000, the worst light of each."""
    found = [json.loads(osiotool("difference", source, other, "--illuminant", light, "--json")) for light in lights]
    return max(f["mean"] for f in found), max(f["max"] for f in found)


def seconds(commands, rounds):
    """Times of commands in alternating rounds: a list for each."""
    taken = [[] for _ in commands]
    for _ in range(rounds):
        for times, command in zip(taken, commands):
            started = time.perf_counter()
            osiotool(*command)
            times.append(time.perf_counter() - started)
    return taken


def ratio(of, against):
    """The median ratio of two commands' times in the same rounds."""
    return statistics.median(b / a for a, b in zip(of, against))


def components(source, path, count):
    """The image from its first principal components in halves; their bytes."""
    image = oiio.ImageInput.open(source)
    spec = image.spec()
    pixels = image.read_image(0, 0, 0, spec.nchannels, oiio.FLOAT).reshape(-1, spec.nchannels).astype(np.float64)
    image.close()
    order = [spec.channelnames.index(f"T.{nm:g}nm") for nm in GRID]
    pixels = pixels[:, order]
    mean = pixels.mean(axis=0)
    _, vectors = np.linalg.eigh(np.cov((pixels - mean).T))
    basis = vectors[:, ::-1][:, :count]
    coefficients = ((pixels - mean) @ basis).astype(np.float16)
    again = (coefficients.astype(np.float64) @ basis.T + mean).reshape(spec.height, spec.width, -1)
    write(path, again, spec.width, spec.height)
    return coefficients.nbytes + 4 * (basis.size + mean.size)


def plain_steps(first, last, count):
    step = (last - first) / (count - 1)
    return f"{first:g}:{step:.4f}:{last + 0.01:g}"


def reduced(source, small, *words, radiance=False):
    """A reduction's report, with (mean, largest) of its worst demands."""
    lights = [] if radiance else ["--lights", ",".join(LIGHTS)]
    report = json.loads(osiotool("reduce", source, small, "--max-delta-e", TOLERANCE, *lights, *words, "--quiet", "--json"))
    return report, [max(d[key] for d in report["demands"]) for key in ("delta_e_mean", "delta_e_max")]


def line(name, title, bands, size, before, taken, first, mean, largest, another):
    times = f"{statistics.median(taken):.3f} | {ratio(taken, first):.1f}" if taken else " | "
    return (f"| {name} | {title} | {bands} | {size / 1e6:.2f} | {before / size:.1f} | {times} | {mean:.3f} | "
            f"{largest:.3f} |{another}")


def scene_rows(name, source, folder, rounds):
    """Lines of the table for one scene."""
    small, packed, out = (os.path.join(folder, f) for f in ("small.spexr", "packed.spexr", "out.exr"))
    report, off = reduced(source, small)
    files = [("all bands, float, zip", report["source_bands"], source, (0, 0)),
             (f"**reduce**, {report['samples']}, {report['compression']}", report["bands"], small, off)]
    if report["compression"] != "zip":
        reduced(source, packed, "--compression", "zip")
        files.append((f"**reduce** `--compression zip`, {report['samples']}", report["bands"], packed, off))
    path = os.path.join(folder, "scene.spexr")
    own, off = reduced(source, path, "--per-scene-basis")
    files.append((f"**reduce** `--per-scene-basis`, {own['samples']}, {own['compression']}", own["coefficients"], path, off))
    for count in (10, 12, 16):
        path = os.path.join(folder, f"plain{count}.exr")
        osiotool("convert", source, path, "--resample", plain_steps(380, 780, count), "--half", "--quiet")
        files.append(("plain, half, zip", count, path, lost(source, path, LIGHTS)))
    times = seconds([("collapse", path, out, *COLLAPSE) for _, _, path, _ in files], rounds)
    before = os.path.getsize(source)

    def another(path):
        return f" {0 if path == source else lost(source, path, (ANOTHER,))[1]:.2f} |"

    lines = [line(name, title, bands, os.path.getsize(path), before, taken, times[0], *off, another(path))
             for (title, bands, path, off), taken in zip(files, times)]
    path = os.path.join(folder, "pca.exr")
    size = components(source, path, report["bands"])
    return lines + [line(name, "principal components, half, none", report["bands"], size, before, None, None,
                         *lost(source, path, LIGHTS), another(path))]


def real_rows(path, folder, rounds):
    """Lines of the table for a file that other software wrote."""
    small, out = os.path.join(folder, "small.spexr"), os.path.join(folder, "out.exr")
    name = os.path.basename(path)
    try:
        report, off = reduced(path, small)
        words = COLLAPSE
    except RuntimeError as error:
        if "holds its light already" not in str(error):
            raise
        report, off = reduced(path, small, radiance=True)
        words = ("--to", "lin_rec709", "--quiet")
    times = seconds([("collapse", source, out, *words) for source in (path, small)], rounds)
    before = os.path.getsize(path)
    return [line(name, f"all bands, {report['source_samples']}", report["source_bands"], before, before, times[0], times[0], 0, 0, ""),
            line(name, f"**reduce**, {report['samples']}, {report['compression']}", report["bands"],
                 os.path.getsize(small), before, times[1], times[0], *off, "")]


def scenes(options, folder):
    out = [f"| scene | bands | how many | MB | smaller | collapse, s | faster | mean ΔE | largest ΔE | largest under {ANOTHER} |",
           "|---|---|---|---|---|---|---|---|---|---|"]
    width, height = map(int, options.small.split("x"))
    for name in SCENES:
        path = os.path.join(folder, "scene.exr")
        make(path, name, width, height)
        out += scene_rows(name, path, folder, options.rounds)
        print("\n".join(out[-8:]), flush=True)
    return out


def real_images(options, folder):
    out = ["| file | bands | how many | MB | smaller | collapse, s | faster | mean ΔE | largest ΔE |", "|---|---|---|---|---|---|---|---|---|"]
    found = sorted(os.path.join(where, name) for where, _, names in os.walk(options.images or "") for name in names
                   if name.endswith((".exr", ".spexr")))
    if not found:
        print("skipped: no --images, so no real files", file=sys.stderr)
    for path in found:
        try:
            out += real_rows(path, folder, options.rounds)
        except RuntimeError as error:
            print(f"skipped: {os.path.basename(path)}: {str(error).splitlines()[-1]}", file=sys.stderr)
    return out


def headline(options, folder):
    """The targets: a scene of 81 float bands at the size of a film frame."""
    out = ["| scene | MB before | MB after | smaller | target | command | s before | s after | faster | target |",
           "|---|---|---|---|---|---|---|---|---|---|"]
    width, height = map(int, options.size.split("x"))
    for name, target in (("noisy", "8"), ("smooth", "12")):
        path, small, result = (os.path.join(folder, f) for f in ("scene.exr", "small.spexr", "out.exr"))
        make(path, name, width, height)
        osiotool("reduce", path, small, "--max-delta-e", TOLERANCE, "--lights", ",".join(LIGHTS), "--quiet")
        before, after = os.path.getsize(path), os.path.getsize(small)
        for words in ((), ("--compression", "none")):
            times = seconds([("collapse", source, result, *COLLAPSE, *words) for source in (path, small)], options.rounds)
            out.append(f"| {name} | {before / 1e6:.1f} | {after / 1e6:.1f} | {before / after:.1f} | {target} | "
                       f"`collapse{' ' if words else ''}{' '.join(words)}` | {statistics.median(times[0]):.2f} | "
                       f"{statistics.median(times[1]):.2f} | {ratio(times[1], times[0]):.2f} | 4 |")
            print(out[-1], flush=True)
        os.remove(path)
    return out


def compressions(options, folder):
    """The noisy reduction in every compression that keeps its samples, against the original."""
    out = ["| compression | MB | collapse, s | of the original's |", "|---|---|---|---|"]
    path, result = os.path.join(folder, "scene.exr"), os.path.join(folder, "out.exr")
    make(path, "noisy", *map(int, options.size.split("x")))
    files = [("the original, zip", path)]
    for name in ("none", "rle", "zips", "zip", "piz"):
        files.append((name, os.path.join(folder, f"{name}.spexr")))
        reduced(path, files[-1][1], "--compression", name)
    times = seconds([("collapse", source, result, *COLLAPSE, "--compression", "none") for _, source in files], options.rounds)
    out += [f"| {name} | {os.path.getsize(source) / 1e6:.1f} | {statistics.median(taken):.3f} | {1 / ratio(taken, times[0]):.3f} |"
            for (name, source), taken in zip(files, times)]
    os.remove(path)
    return out


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--size", default="1920x1080")
    arguments.add_argument("--small", default="480x270")
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--images")
    arguments.add_argument("--write", action="store_true")
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tables = {"reduce, targets": headline(options, folder), "reduce, compressions": compressions(options, folder),
                  "reduce, scenes": scenes(options, folder)}
        real = real_images(options, folder)
        if len(real) > 2:
            tables["reduce, real files"] = real
    for name, lines in tables.items():
        print(f"\n{name}\n" + "\n".join(lines))
    if options.write:
        with open(PAGE, encoding="utf-8") as file:
            page = file.read()
        for name, lines in tables.items():
            page = replaced(page, name, lines)
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write(page)


if __name__ == "__main__":
    main()
