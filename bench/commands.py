#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Whole commands, as a user types them, against what reaches the same pixels without this project.

    . build/stage/env.sh && bench/commands.py [--bands 81] [--size 1920x1080] [--rounds 5]
        [--samples half|float] [--depth float|half] [--peer "TITLE=COMMAND {image} {out}"]...

Makes a noisy spectral image, runs every command once in each round, and prints Markdown tables: the
median wall time, its ratio to the first command in the same rounds, the peak memory, and the largest
difference from numpy in double precision. Needs Debian's Python with OpenImageIO and numpy. Peers are
other programs that make RGB of a spectral image, whichever are at hand; their pixels are not compared."""

import argparse
import json
import os
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import OpenImageIO as oiio

NUMPY_SCRIPT = """
import sys, json, numpy as np, OpenImageIO as oiio
plan = json.load(open(sys.argv[2]))
source = oiio.ImageInput.open(sys.argv[1])
pixels = source.read_image(0, 0, 0, source.spec().nchannels, oiio.FLOAT)
out = np.ascontiguousarray(pixels @ np.array(plan["weights"], np.float32).T)
spec = oiio.ImageSpec(out.shape[1], out.shape[0], 3, oiio.FLOAT)
spec.attribute("compression", "zip")
sink = oiio.ImageOutput.create(sys.argv[3])
sink.open(sys.argv[3], spec)
sink.write_image(out)
sink.close()
"""


def make_image(path, wavelengths, width, height, samples=oiio.HALF):
    """A noisy picture of smooth spectra, zip: what a camera or a path tracer leaves."""
    random = np.random.default_rng(1)
    spec = oiio.ImageSpec(width, height, len(wavelengths), samples)
    spec.channelnames = tuple("T." + f"{nm:g}".replace(".", ",") + "nm" for nm in wavelengths)
    spec.attribute("compression", "zip")
    sink = oiio.ImageOutput.create(path)
    assert sink.open(path, spec), sink.geterror()
    x = np.linspace(0, 1, width)[:, None]
    band = np.linspace(0, 1, len(wavelengths))[None, :]
    for row in range(height):
        y = row / height
        smooth = 0.45 + 0.3 * np.sin(6 * (band + x)) * np.cos(5 * (y - band))
        noisy = np.clip(smooth * (1 + random.normal(0, 0.02, smooth.shape)), 0, 1)
        sink.write_scanline(row, 0, noisy.astype(np.float32))
    assert sink.close(), sink.geterror()


# A process starts with the peak memory of the one that forked it: a small one in between.
LAUNCHER = """
import json, os, resource, subprocess, sys, time
started = time.perf_counter()
status = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL)
seconds = time.perf_counter() - started
print(json.dumps([status, seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024]))
"""


def run(command):
    """(seconds, peak MB) of a command that must succeed."""
    result = subprocess.run([sys.executable, "-c", LAUNCHER, *command], capture_output=True, text=True)
    status, seconds, megabytes = json.loads(result.stdout)
    if status != 0:
        sys.exit(f"{' '.join(command)}\n{result.stderr}")
    return seconds, megabytes


def measure(commands, rounds):
    """{name: "title | median seconds | ratio to the first | peak MB"}, every command once in each round."""
    seconds = {name: [] for name in commands}
    megabytes = {}
    for _ in range(rounds):
        for name, (_, command) in commands.items():
            taken, megabytes[name] = run(command)
            seconds[name].append(taken)
    first = next(iter(seconds.values()))
    return {name: f"{title} | {statistics.median(seconds[name]):.2f} | "
                  f"{statistics.median(a / b for a, b in zip(seconds[name], first)):.2f} | {megabytes[name]:.0f}"
            for name, (title, _) in commands.items()}


def pixels_of(path):
    source = oiio.ImageInput.open(path)
    return source.read_image(0, 0, 0, 3, oiio.FLOAT).astype(np.float64)


def opening_ms(name, times=201):
    """Median time to open an image by a plugin that is loaded."""
    taken = []
    for _ in range(times):
        started = time.perf_counter()
        source = oiio.ImageInput.open(name)
        taken.append(1000 * (time.perf_counter() - started))
        assert source, oiio.geterror()
        source.close()
    return statistics.median(taken)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--bands", type=int, default=81)
    arguments.add_argument("--size", default="1920x1080")
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--samples", choices=("half", "float"), default="half")
    arguments.add_argument("--depth", choices=("float", "half"), default="float")
    arguments.add_argument("--peer", action="append", default=[])
    options = arguments.parse_args()
    width, height = map(int, options.size.split("x"))

    with tempfile.TemporaryDirectory() as folder:
        shot = os.path.join(folder, "shot.exr")
        plan_file = os.path.join(folder, "plan.json")
        script = os.path.join(folder, "by_numpy.py")
        make_image(shot, np.linspace(380, 780, options.bands), width, height, getattr(oiio, options.samples.upper()))
        with open(script, "w") as file:
            file.write(NUMPY_SCRIPT)
        words = ["--to", "lin_rec709", "--illuminant", "D65"]
        plan_text = subprocess.run(["osiotool", "plan", shot, *words, "--json"], check=True,
                                   capture_output=True, text=True).stdout
        with open(plan_file, "w") as file:
            file.write(plan_text)
        weights = np.array(json.loads(plan_text)["weights"])
        expected = np.empty((height, width, 3))
        source = oiio.ImageInput.open(shot)
        for row in range(height):
            expected[row] = source.read_scanline(row, 0, oiio.FLOAT).astype(np.float64) @ weights.T
        source.close()

        by_hand = ["oiiotool", shot]
        for row in weights:
            by_hand += ["--dup", "--chsum:weight=" + ",".join(map(repr, map(float, row))), "--swap"]
        by_hand += ["--pop", "--chappend:n=3"]
        out = {name: os.path.join(folder, f"{name}.exr") for name in ("tool", "plugin", "hand", "numpy")}
        query = f"{shot}?to=lin_rec709&illuminant=D65"
        float_zip = ["-d", options.depth, "--compression", "zip", "-o"]
        words += ["-d", options.depth]
        commands = {
            "tool": ("`osiotool collapse`", ["osiotool", "collapse", shot, out["tool"], *words, "--quiet"]),
            "plugin": ("`oiiotool \"shot.exr?to=…\"`, this plugin", ["oiiotool", query, *float_zip, out["plugin"]]),
            "hand": ("`oiiotool --chsum` three times, weights typed", [*by_hand, *float_zip, out["hand"]]),
            "numpy": ("Python: read, matrix product, write", ["/usr/bin/python3", script, shot, plan_file, out["numpy"]]),
        }
        if options.depth != "float":
            del commands["numpy"]
        for i, peer in enumerate(options.peer):
            title, command = peer.split("=", 1)
            made = os.path.join(folder, f"peer{i}.exr")
            commands[made] = (title, shlex.split(command.format(image=shot, out=made)))
        measured = measure(commands, options.rounds)
        print(f"{options.bands} bands, {options.size}, {options.samples}, zip, output {options.depth}, "
              f"{os.path.getsize(shot) / 1e6:.0f} MB; {os.cpu_count()} cores; medians of {options.rounds}:\n")
        print("| command | s | ratio | peak MB | largest error |")
        print("|---|---|---|---|---|")
        for name, row in measured.items():
            error = f"{np.abs(pixels_of(out[name]) - expected).max():.1e}" if name in out else "-"
            print(f"| {row} | {error} |")

        print("\n| command | s | ratio | peak MB |")
        print("|---|---|---|---|")
        aces, second, view = (os.path.join(folder, f"{name}.exr") for name in ("aces", "second", "view"))
        collapse = ["osiotool", "collapse", shot]
        under = ["--illuminant", "D65", "--quiet"]
        display = ("sRGB - Display", "ACES 1.0 - SDR Video")
        configs = {
            "aces": ("`osiotool collapse --to aces2065_1`, without OCIO", [*collapse, aces, "--to", "aces2065_1", *under]),
            "log": ("`--to ACEScct`, in one pass", [*collapse, second, "--to", "ACEScct", *under]),
            "second": ("`oiiotool --colorconvert` of the first's output: a second pass",
                       ["oiiotool", aces, "--colorconvert", "ACES2065-1", "ACEScct", *float_zip, second]),
            "view": ("`--to` the ACES SDR view, in one pass", [*collapse, view, "--to", "/".join(display), *under]),
            "shown": ("`oiiotool --ociodisplay` of the first's output: a second pass",
                      ["oiiotool", aces, "--ociodisplay:from=ACES2065-1", *display, *float_zip, view]),
        }
        for row in measure(configs, options.rounds).values():
            print(f"| {row} |")

        print("\n| command | s | ratio | peak MB |")
        print("|---|---|---|---|")
        headers = {"info": ("`osiotool info`", ["osiotool", "info", shot]),
                   "iinfo": ("`iinfo`", ["iinfo", shot])}
        for row in measure(headers, options.rounds).values():
            print(f"| {row} |")

        small = os.path.join(folder, "small.exr")
        make_image(small, np.linspace(380, 780, options.bands), 8, 8)
        print("\n| open() in a host, plugin loaded | ms |")
        print("|---|---|")
        for title, name in (("8x8, collapsed", f"{small}?to=lin_rec709&illuminant=D65"), ("8x8, bands", f"{small}?to=raw"),
                            ("8x8, OpenImageIO's own reader", small), (f"{options.size}, collapsed", query)):
            print(f"| {title} | {opening_ms(name):.2f} |")


if __name__ == "__main__":
    main()
