#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What bands lose, basis by basis: makes the tables of docs/accuracy.md from built programs.

    bench/accuracy.py [--check] [BUILD]

BUILD is a build folder with tests (default: build/dev). Weights are those of `osiotool plan --json`,
distances those of `osiotool difference`; the truth is the sum at 1 nm over 360-830 nm, in numpy. --check
writes nothing and fails where a table of differences is no longer what the programs give. Needs numpy and
OpenImageIO's Python module, which writes the files that osiotool reads."""

import json
import os
import re
import subprocess
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio

from tables import BARS, COLORCHECKER, LIGHTS, NM, ROOT, reflectances

PAGE = os.path.join(ROOT, "docs", "accuracy.md")

NAMED = {"continuous (A, D65)": ["A", "D65"], "fluorescent (FL2, FL11)": ["FL2", "FL11"],
         "sodium (HP1)": ["HP1"], "LED (LED-B3)": ["LED-B3"]}
WHOLE = {"continuous (A, C, D50, D55, D65, D75, E)": ["A", "C", "D50", "D55", "D65", "D75", "E"],
         "fluorescent (FL1-12)": [f"FL{i}" for i in range(1, 13)],
         "discharge (HP1-5)": [f"HP{i}" for i in range(1, 6)],
         "LED (B1-5, BH1, RGB1, V1, V2)": [f"LED-{n}" for n in ("B1", "B2", "B3", "B4", "B5", "BH1", "RGB1",
                                                               "V1", "V2")]}
BASES = ("linear", "sprague", "e2022", "bins", "bins-corrected")

# Goal, what, must, aim, and how the lines of the tests begin that print it.
GOALS = (
    ("G1", "XYZ from 1 nm tables, doubles, relative", "1e-12", "3.8e-15", ["G1 relative"]),
    ("G1b", "the same, float pixels of 471 bands, relative", "2e-6", "7e-7", ["G1b relative"]),
    ("G1b", "the same, ΔE2000", "5e-4", "1.3e-4", ["G1b dE2000"]),
    ("G2", "weights of ASTM E2022, absolute, Y sums to 100", "1e-12", "1.4e-14", ["G2 absolute"]),
    ("G2", "against three printed tables of E308, in units of their third decimal", "0.5", "0.5",
     ["G2 E2022 weights"]),
    ("G3", "Sprague interpolation, absolute", "1e-13", "9e-16", ["G3"]),
    ("G4", "reflectance at 5 nm, light known, mean ΔE2000", "0.001", "0.0004", ["G4 reflectance every 5 nm", "mean"]),
    ("G4", "… largest", "0.005", "0.004", ["G4 reflectance every 5 nm", "largest"]),
    ("G4", "at 10 nm, mean", "0.02", "0.013", ["G4 reflectance every 10 nm", "mean"]),
    ("G4", "… largest", "0.15", "0.10", ["G4 reflectance every 10 nm", "largest"]),
    ("G4", "… mean under FL2 and FL11 alone; no goal of its own, the test allows half more", "0.03", "",
     ["G4 under lines every 10 nm"]),
    ("G4", "at 20 nm, mean", "0.09", "0.074", ["G4 reflectance every 20 nm", "mean"]),
    ("G4", "… largest", "0.9", "0.67", ["G4 reflectance every 20 nm", "largest"]),
    ("G5", "radiance in 31 bins of 380-780 nm, continuous light, mean ΔE2000", "0.15", "0.012",
     ["G5 radiance in 31 bins, smooth", "mean"]),
    ("G5", "… largest", "0.40", "0.056", ["G5 radiance in 31 bins, smooth", "largest"]),
    ("G5", "fluorescent light, mean", "0.35", "0.33", ["G5 radiance in 31 bins, fluorescent", "mean"]),
    ("G5", "… largest", "2.1", "1.4", ["G5 radiance in 31 bins, fluorescent", "largest"]),
    ("G5", "LED light, mean", "0.33", "0.033", ["G5 radiance in 31 bins, LED", "mean"]),
    ("G5", "… largest", "1.2", "0.21", ["G5 radiance in 31 bins, LED", "largest"]),
    ("G6", "white points: sums at 1 nm, absolute", "1e-12", "", ["G6 absolute xy error"]),
    ("G6", "against published, rounded ones", "3e-4", "2.7e-4", ["G6 absolute xy distance"]),
    ("G7", "matrices of RGB spaces and adaptation, absolute", "4e-15", "3e-16", ["G7"]),
    ("G8", "CIEDE2000, Sharma's 34 pairs, 4 decimals", "5e-5", "5e-5", ["G8 CIEDE2000 of Sharma"]),
    ("G8", "elsewhere", "1e-12", "1e-13", ["G8 CIEDE2000 against"]),
    ("G9", "Planck's law, as a share of 1e-15 + 2.5e-16 hc/λkT", "1", "", ["G9"]),
    ("G10", "luminance, relative", "1e-12", "", ["G10"]),
    ("G14", "spectral lines in bins, relative to the method's own number", "1e-9", "", ["G14"]),
    ("G15", "degenerate spectra, relative", "1e-12", "", ["G15"]),
)


D65 = np.array([0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290])  # what `difference` takes X, Y, Z for


def sprague_1nm(values):
    """Samples every 5 nm to 1 nm: the quintics of CIE 167, ends by its two rows of coefficients."""
    ends = np.array([[884, -1960, 3033, -2648, 1080, -180], [508, -540, 488, -367, 144, -24]]) / 209
    r = np.concatenate([ends @ values[:6], values, (ends @ values[:-7:-1])[::-1]])
    c = np.array([[0, 0, 24, 0, 0, 0], [2, -16, 0, 16, -2, 0], [-1, 16, -30, 16, -1, 0], [-9, 39, -70, 66, -33, 7],
                  [13, -64, 126, -124, 61, -12], [-5, 25, -50, 50, -25, 5]]) / 24
    out = []
    for i in range(len(values) - 1):
        out += [(c @ r[i:i + 6]) @ (k / 5) ** np.arange(6) for k in range(5)]
    return np.array(out + [values[-1]])


# The ColorChecker and CIE 224's 99 samples at 1 nm, ends held: 123 x 471.
CURVES = np.concatenate([COLORCHECKER, [np.interp(NM, np.arange(380, 781), sprague_1nm(values))
                                        for values in reflectances("tests/golden/ces99_cie224_5nm.csv")]])


class Grid:
    """Bands as centres, and the two ways in which they see a curve that is straight between nanometres."""

    def __init__(self, words, first, step, count):
        self.words, self.count = words, count
        self.nm = first + step * np.arange(count)
        edges = np.append(self.nm - step / 2, self.nm[-1] + step / 2)
        fine = np.stack([np.interp(self.nm, NM, row) for row in np.eye(NM.size)], axis=1)
        self.samples = fine
        self.averages = np.stack([self.average(lo, hi) for lo, hi in zip(edges[:-1], edges[1:])])

    @staticmethod
    def average(lo, hi):
        """Weights of the 1 nm samples in the average over [lo, hi]: trapezoids between all knots."""
        knots = np.unique(np.concatenate([[lo, hi], NM[(NM > lo) & (NM < hi)]]))
        width = np.diff(knots)
        at = np.stack([np.interp(knots, NM, row) for row in np.eye(NM.size)])
        return (at[:, :-1] + at[:, 1:]) @ width / 2 / (hi - lo)


def spaced(first, step, last):
    count = round((last - first) / step) + 1
    return Grid(f"{count} every {step} nm, {first}-{last}", first, step, count)


def buckets(count, lo, hi):
    step = (hi - lo) / count
    return Grid(f"{count} buckets of {lo}-{hi}", lo + step / 2, step, count)


GRIDS = [spaced(400, 5, 700), spaced(400, 10, 700), spaced(400, 20, 700), spaced(380, 10, 780),
         buckets(31, 380, 780), buckets(16, 380, 780)]


class Programs:
    """The built programs, and what they were asked already."""

    def __init__(self, build, folder):
        self.build, self.folder = build, folder
        self.osiotool = os.path.join(build, "bin", "osiotool")
        self.plans = {}

    def write(self, name, channels):
        names = list(channels)
        pixels = np.stack([channels[n] for n in names], -1).astype(np.float32)[None]
        spec = oiio.ImageSpec(pixels.shape[1], 1, len(names), oiio.FLOAT)
        spec.channelnames = tuple(names)
        path = os.path.join(self.folder, name)
        out = oiio.ImageOutput.create("openexr")
        if not (out.open(path, spec) and out.write_image(pixels) and out.close()):
            raise RuntimeError(out.geterror())
        return path

    def run(self, *words):
        return json.loads(subprocess.run([self.osiotool, *words, "--json"], check=True, capture_output=True,
                                         text=True).stdout)

    def plan(self, grid, basis, light=None):
        """(weights, basis used) of the tool for a reflectance under a light, or for radiance."""
        key = (grid.words, basis, light)
        if key not in self.plans:
            family = "T" if light else "S0"
            path = self.write("bands.exr", {f"{family}.{str(float(nm)).replace('.', ',')}nm": np.ones(1)
                                            for nm in grid.nm})
            plan = self.run("plan", path, "--to", "xyz", "--basis", basis, *(["--illuminant", light] if light else []))
            self.plans[key] = (np.array(plan["weights"]), plan["basis"])
        return self.plans[key]

    def differences(self, pairs):
        """[(mean, max)] of CIEDE2000 of pairs (found, truth), each n x 3 shares of their white."""
        paths = [self.write(name, dict(zip("XYZ", (np.concatenate(xyz) * D65).T)))
                 for name, xyz in zip(("a.exr", "b.exr"), zip(*pairs))]
        self.run("difference", *paths, "--map", os.path.join(self.folder, "map.exr"))
        values = oiio.ImageInput.open(os.path.join(self.folder, "map.exr")).read_image(oiio.FLOAT).ravel()
        ends = np.cumsum([len(found) for found, _ in pairs])
        return [(part.mean(), part.max()) for part in np.split(values, ends[:-1])]

    def goals(self):
        """{beginning of a line: largest value seen} of the tests that print "max seen"."""
        test = os.path.join(self.build, "tests", "golden_tests")
        said = subprocess.run([test], capture_output=True, text=True, check=True).stdout
        return re.findall(r"^(G\d+b? .*): max seen (\S+) / max allowed (\S+) over", said, re.M)


def white_of(light):
    return BARS @ LIGHTS[light] / (BARS[1] @ LIGHTS[light])


def truth_of(light):
    """XYZ of the reflectances as shares of the white."""
    return (CURVES * LIGHTS[light]) @ BARS.T / (BARS @ LIGHTS[light])


def found_of(programs, grid, seen, basis, light, radiance):
    """The same as the tool sees it through bands."""
    see = grid.samples if seen == "samples" else grid.averages
    if radiance:
        weights = programs.plan(grid, basis)[0]
        power = LIGHTS[light] / (BARS[1] @ LIGHTS[light]) * BARS[1].sum()
        return (CURVES * power) @ see.T @ weights.T / white_of(light)
    return CURVES @ see.T @ programs.plan(grid, basis, light)[0].T / white_of(light)


def figure(value):
    return "0" if value < 5e-5 else f"{value:#.2g}".rstrip(".")


class Rows:
    """Rows of a table whose cells are pairs until all of them are compared at once."""

    def __init__(self, *head):
        self.head, self.rows, self.pairs, self.bold = head, [], [], set()

    def cell(self, found, truth, bold=False):
        if bold:
            self.bold.add(len(self.pairs))
        self.pairs.append((np.concatenate(found), np.concatenate(truth)))

    def end(self, *words):
        self.rows.append((words, len(self.pairs)))

    def lines(self, programs):
        cells = [f"{figure(mean)} / {figure(most)}" for mean, most in programs.differences(self.pairs)]
        cells = [f"**{text}**" if i in self.bold else text for i, text in enumerate(cells)]
        out, first = ["| " + " | ".join(self.head) + " |", "|---" * len(self.head) + "|"], 0
        for words, end in self.rows:
            out.append("| " + " | ".join([*words, *cells[first:end]]) + " |")
            first = end
        return out


def by_basis(programs, seen, radiance):
    out = Rows("light", "bands", *(f"`{b}`" for b in BASES))
    for name, lights in NAMED.items():
        for grid in GRIDS:
            chosen = programs.plan(grid, "auto", None if radiance else lights[0])[1]
            for basis in BASES:
                out.cell([found_of(programs, grid, seen, basis, light, radiance) for light in lights],
                         [truth_of(light) for light in lights], basis == chosen)
            out.end(name, grid.words)
    return out.lines(programs)


def fewest(programs):
    """Bins against corrected bins of radiance by their number."""
    counts = (4, 5, 6, 7, 8, 9, 10, 12, 16, 20)
    out = Rows("light", "bins of", "basis", *map(str, counts))
    every = [light for members in WHOLE.values() for light in members]
    for name, lights in [(f"all {len(every)}", every), *WHOLE.items()]:
        for lo, hi in ((380, 780), (400, 700)):
            for basis in ("bins", "bins-corrected"):
                for count in counts:
                    grid = buckets(count, lo, hi)
                    out.cell([found_of(programs, grid, "averages", basis, light, True) for light in lights],
                             [truth_of(light) for light in lights])
                out.end(name, f"{lo}-{hi} nm", f"`{basis}`")
    return out.lines(programs)


def lab_slopes(share):
    """d(L*, a*, b*) / d(share of white), n x 3 x 3."""
    slope = np.where(share > (6 / 29) ** 3, np.cbrt(np.maximum(share, 1e-12)) ** -2 / 3, 841 / 108)
    out = np.zeros(share.shape + (3,))
    for row, column, factor in ((0, 1, 116), (1, 0, 500), (1, 1, -500), (2, 1, 200), (2, 2, -200)):
        out[:, row, column] = factor * slope[:, column]
    return out


def best_weights(bins, truth, whites):
    """The weights with the least sum of squared dE*ab (linearised) over all colours: bins n x N, truth and
    whites n x 3."""
    slopes = lab_slopes(truth) / whites[:, None, :]
    rows = np.einsum("nrc,nb->nrcb", slopes, bins).reshape(-1, 3 * bins.shape[1])
    aims = np.einsum("nrc,nc->nr", slopes, truth * whites).reshape(-1)
    return np.linalg.lstsq(rows, aims, rcond=None)[0].reshape(3, -1)


def limits(programs):
    """Renderer buckets: what the tool makes of them, and what the best of all weights would."""
    out = Rows("light", "buckets of 380-780 nm", "record", "`auto`", "best for all lights", "best for this light")
    lights = [light for members in WHOLE.values() for light in members]

    def best(members, data):
        return best_weights(np.concatenate([data[light] for light in members]),
                            np.concatenate([truth_of(light) for light in members]),
                            np.repeat([white_of(light) for light in members], len(CURVES), axis=0))

    for count in (16, 31):
        grid = buckets(count, 380, 780)
        for record in ("light × reflectance, averaged", "averages of both, multiplied"):
            data = {}
            for light in lights:
                power = LIGHTS[light] / (BARS[1] @ LIGHTS[light]) * BARS[1].sum()
                data[light] = (CURVES * power) @ grid.averages.T if record.startswith("light") else \
                    (CURVES @ grid.averages.T) * (grid.averages @ power)
            for name, members in WHOLE.items():
                for weights in (programs.plan(grid, "auto")[0], best(lights, data), best(members, data)):
                    out.cell([data[light] @ weights.T / white_of(light) for light in members],
                             [truth_of(light) for light in members])
                out.end(name, str(count), record)
    return out.lines(programs)


def goals(programs):
    seen = programs.goals()
    out = ["| goal | what | must | aim | seen |", "|---|---|---|---|---|"]
    for goal, what, must, aim, words in GOALS:
        found = [float(value) for line, value, _ in seen if line.startswith(words[0]) and
                 (len(words) == 1 or words[1] in line)]
        if not found:
            raise RuntimeError(f"no test prints {words}")
        out.append(f"| {goal} | {what} | {must} | {aim} | {max(found):.2g} |")
    return out


TABLES = {
    "goals": goals,
    "reflectance as samples": lambda p: by_basis(p, "samples", False),
    "reflectance as averages": lambda p: by_basis(p, "averages", False),
    "radiance as averages": lambda p: by_basis(p, "averages", True),
    "radiance as samples": lambda p: by_basis(p, "samples", True),
    "fewest bins": fewest,
    "limits": limits,
}


def replaced(page, name, lines):
    pattern = re.compile(rf"(<!-- table: {re.escape(name)} -->\n)(.*?)(<!-- end -->)", re.S)
    if not pattern.search(page):
        raise RuntimeError(f"docs/accuracy.md has no place for the table \"{name}\"")
    return pattern.sub(lambda m: m[1] + "\n".join(lines) + "\n" + m[3], page)


def apart(old, new):
    """Whether two pages differ by more than a rounded digit: other words, or a figure 11 % and 1e-4 away."""
    number = re.compile(r"\d+\.?\d*(?:e-?\d+)?")
    if number.sub("#", old) != number.sub("#", new):
        return True
    pairs = zip(map(float, number.findall(old)), map(float, number.findall(new)))
    return any(abs(a - b) > 0.11 * max(a, b) + 1e-4 for a, b in pairs)


def main():
    words = sys.argv[1:]
    check = "--check" in words
    build = next((w for w in words if not w.startswith("-")), os.path.join(ROOT, "build", "dev"))
    with open(PAGE, encoding="utf-8") as file:
        page = old = file.read()
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(build, folder)
        for name, make in TABLES.items():
            if not (check and name == "goals"):  # last bits are the machine's; the tests bound them
                page = replaced(page, name, make(programs))
    if check:
        sys.exit("docs/accuracy.md is not what bench/accuracy.py makes; run it" if apart(old, page) else 0)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    main()
