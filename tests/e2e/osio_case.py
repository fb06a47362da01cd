# SPDX-License-Identifier: Apache-2.0
"""What the end-to-end tests share: the product under test, other people's tools, small images, and an
evaluation of the colour integrals of its own, in numpy."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO as oiio

HOME = os.environ["OSIO_TEST_HOME"]
SOURCE = os.environ["OSIO_TEST_SOURCE"]
OSIOTOOL = os.path.join(HOME, "bin", "osiotool")
COLORCHECKER = os.environ["OSIO_TEST_COLORCHECKER"]
CONFIG = os.path.join(SOURCE, "configs", "osio.ocio")

os.environ.pop("OCIO", None)  # a test says which config it means

FLOAT, HALF, UINT = oiio.FLOAT, oiio.HALF, oiio.UINT32


def table(path):
    """A CSV of data/ as {column: array}."""
    with open(os.path.join(SOURCE, "data", path)) as file:
        rows = list(csv.reader(file))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def oracle_xyz(wavelengths, light=None, observer="cie1931", hold=True):
    """3xN weights of the CIE sum at 1 nm: the obvious evaluation, by other code than the product's."""
    cmf = table(f"observers/{observer}.csv")
    nm = cmf["wavelength_nm"]
    power = np.ones_like(nm) if light is None else table("illuminants/cie_1nm.csv")[light]
    bars = np.stack([cmf[c] for c in ("x_bar", "y_bar", "z_bar")])
    order = np.argsort(wavelengths, kind="stable")
    sorted_nm = np.asarray(wavelengths, float)[order]
    weights = np.zeros((3, len(wavelengths)))
    for i, band in enumerate(order):
        unit = np.zeros(len(wavelengths))
        unit[i] = 1
        phi = np.interp(nm, sorted_nm, unit)
        if not hold:
            phi[(nm < sorted_nm[0]) | (nm > sorted_nm[-1])] = 0
        weights[:, band] = bars @ (power * phi)
    return weights / (power @ bars[1])


def light_table(light):
    """(nm, power) of a light of data/, ultraviolet included, over what its table speaks of."""
    visible = table("illuminants/cie_1nm.csv")
    nm, power = visible["wavelength_nm"], visible[light]
    stated = np.flatnonzero(power)
    nm, power = nm[stated[0]:stated[-1] + 1], power[stated[0]:stated[-1] + 1]
    below = table("illuminants/cie_uv.csv")
    if light in below:
        nm, power = np.append(below["wavelength_nm"], nm), np.append(below[light], power)
    return nm, power


def oracle_pairs(pairs, light, observer="cie1931"):
    """3xN weights of pairs (in, out): elements of the Donaldson matrix. Each exciting band sees the mean of
    the light under the triangle up to its neighbours, each emitting band sends out such a triangle."""
    cmf = table(f"observers/{observer}.csv")
    nm = cmf["wavelength_nm"]
    bars = np.stack([cmf[c] for c in ("x_bar", "y_bar", "z_bar")])
    light_nm, power = light_table(light)
    fine = np.arange(150, 900, 0.01) + 0.005
    fine_power = np.interp(fine, light_nm, power, left=0, right=0)
    known = (fine >= light_nm[0]) & (fine <= light_nm[-1])

    def triangles(axis, at):
        ends = np.concatenate([[2 * axis[0] - axis[1]], axis, [2 * axis[-1] - axis[-2]]])
        return np.stack([np.interp(at, ends[i:i + 3], [0, 1, 0], left=0, right=0) for i in range(len(axis))])

    incoming = np.array(sorted({i for i, _ in pairs}))
    outgoing = np.array(sorted({o for _, o in pairs}))
    weight = triangles(incoming, fine) * known
    mean = (weight @ fine_power) / np.maximum(weight.sum(axis=1), 1e-300)
    mean[(incoming < light_nm[0]) | (incoming > light_nm[-1])] = 0
    seen = bars @ triangles(outgoing, nm).T
    k = 1 / (np.interp(nm, light_nm, power, left=0, right=0) @ bars[1])
    of_in = {nm: i for i, nm in enumerate(incoming)}
    of_out = {nm: i for i, nm in enumerate(outgoing)}
    return np.stack([k * mean[of_in[i]] * seen[:, of_out[o]] for i, o in pairs], axis=1)


class OsioCase(unittest.TestCase):
    """A test in a folder of its own."""

    maxDiff = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="osio-e2e-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def files(self):
        return sorted(os.listdir(self.folder))

    # Running programs

    def run_program(self, *command, env=None, timeout=180, **options):
        environment = dict(os.environ, **(env or {}))
        return subprocess.run([str(c) for c in command], cwd=self.folder, env=environment, timeout=timeout,
                              capture_output=True, text=True, **options)

    def check(self, *command, **options):
        """Runs a program that must succeed; its stdout."""
        result = self.run_program(*command, **options)
        self.assertEqual(result.returncode, 0,
                         f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
        return result.stdout

    def peak_mb(self, *command):
        """Peak resident memory of a program that must succeed. A process starts with the peak of the one that
        forked it: a small one in between."""
        launcher = ("import resource, subprocess, sys; status = subprocess.call(sys.argv[1:]); "
                    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000); sys.exit(status)")
        return float(self.check(sys.executable, "-c", launcher, *command).splitlines()[-1])

    def osiotool(self, *arguments, code=0, **options):
        result = self.run_program(OSIOTOOL, *arguments, **options)
        self.assertEqual(result.returncode, code,
                         f"osiotool {' '.join(map(str, arguments))}\n{result.stdout}{result.stderr}")
        return result

    def osiotool_json(self, *arguments):
        return json.loads(self.osiotool(*arguments, "--json").stdout)

    def both(self, source, depth="float", **words):
        """(pixels, report, stderr) of a collapse by the tool, which must be the plugin's bit for bit, in
        Python and in oiiotool. A word that is True is a switch of the tool."""
        options = [w for key, value in words.items() for w in ([f"--{key}"] if value is True else [f"--{key}", value])]
        result = self.osiotool("collapse", source, "tool.exr", *options, "-d", depth, "--json")
        query = "&".join(f"{key}={1 if value is True else value}" for key, value in words.items())
        report = json.loads(result.stdout)
        tool = self.in_order("tool.exr", report["channel_names"])
        if depth == "float":
            plugin = self.in_order(f"{self.path(source)}?{query}", report["channel_names"])
            self.assertTrue(np.array_equal(tool.view(np.uint32), plugin.view(np.uint32)), f"{tool}\n{plugin}")
            self.check("oiiotool", f"{source}?{query}", "-d", depth, "-o", "plugin.exr")
            stored = self.in_order("plugin.exr", report["channel_names"])
            self.assertTrue(np.array_equal(tool, stored, equal_nan=True))
        return tool.astype(np.float64), report, result.stderr

    def in_order(self, name, channel_names):
        """Pixels with the channels in this order, whatever order a file keeps them in."""
        channels = self.channels_of(name)
        self.assertEqual(sorted(channels), sorted(channel_names))
        return np.stack([channels[n] for n in channel_names], axis=-1)

    def expect(self, actual, expected, allowed=2e-6, scale=None):
        """The largest error as a share of the largest value, or of `scale`, against what is allowed."""
        scale = np.abs(expected).max() if scale is None else scale
        error = np.abs(np.asarray(actual) - expected).max() / scale
        print(f"{self.id()}: max seen {error:.2g} / max allowed {allowed:g}")
        self.assertLessEqual(error, allowed)

    def write_table(self, name, *lines):
        with open(self.path(name), "w") as file:
            file.write("\n".join(lines) + "\n")
        return self.path(name)

    # Images

    def write_exr(self, name, channels, types=FLOAT, writer="openexr", attributes=(), origin=(0, 0),
                  full=None, tile=0, compression="zip"):
        """Writes {channel: 2-D array} by a writer of OpenImageIO; `types` is one or one a channel."""
        names = list(channels)
        pixels = np.stack([np.asarray(channels[n], np.float32) for n in names], axis=-1)
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], len(names), FLOAT)
        spec.channelnames = tuple(names)
        if isinstance(types, dict):
            spec.channelformats = tuple(oiio.TypeDesc(types.get(n, FLOAT)) for n in names)
        else:
            spec.set_format(types)
        spec.x, spec.y = origin
        spec.full_x, spec.full_y, spec.full_width, spec.full_height = full or (
            origin + (spec.width, spec.height))
        if tile:
            spec.tile_width = spec.tile_height = tile
        spec.attribute("compression", compression)
        for attribute in attributes:
            spec.attribute(*attribute)
        output = oiio.ImageOutput.create(writer)
        self.assertIsNotNone(output, oiio.geterror())
        self.assertTrue(output.open(self.path(name), spec), output.geterror())
        ok = output.write_tiles(spec.x, spec.x + spec.width, spec.y, spec.y + spec.height, 0, 1, pixels) \
            if tile else output.write_image(pixels)
        self.assertTrue(ok, output.geterror())
        self.assertTrue(output.close(), output.geterror())
        return self.path(name)

    def read(self, name, config=None, subimage=0):
        """(spec, float pixels) through whichever reader OpenImageIO chooses."""
        image = oiio.ImageInput.open(name if os.path.isabs(name) else self.path(name),
                                     config or oiio.ImageSpec())
        self.assertIsNotNone(image, oiio.geterror())
        self.assertTrue(image.seek_subimage(subimage, 0))
        spec = image.spec()
        pixels = image.read_image(subimage, 0, 0, spec.nchannels, FLOAT)
        self.assertIsNotNone(pixels, image.geterror())
        image.close()
        return spec, pixels

    def format_of(self, name):
        image = oiio.ImageInput.open(self.path(name))
        self.assertIsNotNone(image, oiio.geterror())
        return image.format_name()

    def channels_of(self, name, **options):
        """{channel: 2-D array} of a file."""
        spec, pixels = self.read(name, **options)
        return {channel: pixels[..., i] for i, channel in enumerate(spec.channelnames)}

    def exr_channels(self, name):
        """{channel: type} as OpenEXR's own tool lists them."""
        listing = self.check("exrheader", self.path(name))
        return dict(re.findall(r"^    (\S+), (.+), sampling", listing, re.M))

    def bands(self, wavelengths, shape=(5, 7), seed=1, prefix="T", low=0.05, high=0.95):
        """Random bands as {layout name: array}."""
        random = np.random.default_rng(seed)
        return {f"{prefix}.{format_comma(nm)}nm": random.uniform(low, high, shape).astype(np.float32)
                for nm in wavelengths}

    def colorchecker(self, name="cc.exr", patch=10):
        self.check(COLORCHECKER, self.path(name), patch)
        return self.path(name)


def format_comma(nm):
    text = repr(float(nm))
    return text[:-2] if text.endswith(".0") else text.replace(".", ",")


def stack(channels, names):
    return np.stack([channels[n] for n in names], axis=-1).astype(np.float64)
