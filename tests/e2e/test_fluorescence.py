# SPDX-License-Identifier: Apache-2.0
"""Fluorescent sets: pairs T.in.out from a file to colour, by the tool and the plugin, against numpy."""

import csv
import io
import json
import time
import unittest

import numpy as np

from osio_case import HALF, OsioCase, format_comma, oracle_pairs, oracle_xyz, stack

GRID = [380 + 20 * i for i in range(21)]
PAIRS = [(i, o) for i in GRID for o in GRID if i < o]
ULTRAVIOLET = [(i, o) for i in range(300, 380, 20) for o in GRID]


def pair_name(pair):
    return "T." + ".".join(format_comma(nm) + "nm" for nm in pair)


class Fluorescence(OsioCase):
    def fluorescent(self, name="f.exr", grid=GRID, pairs=PAIRS, seed=2, **options):
        """Writes random bands and pairs; ([y, x, band], [y, x, pair])."""
        bands = self.bands(grid, high=0.5)
        random = np.random.default_rng(seed)
        shape = next(iter(bands.values())).shape
        channels = {pair_name(p): random.uniform(0, 0.03, shape).astype(np.float32) for p in pairs}
        self.write_exr(name, dict(bands, **channels), **options)
        stored = self.channels_of(name)
        return stack(stored, list(bands)), stack(stored, list(channels))

    def oracle(self, reflected, emitted, light, grid=GRID, pairs=PAIRS):
        return reflected @ oracle_xyz(grid, light).T + emitted @ oracle_pairs(pairs, light).T

    def test_against_the_donaldson_matrix(self):
        reflected, emitted = self.fluorescent()
        for light in ("D65", "A", "FL2", "E"):
            pixels, _, said = self.both("f.exr", to="xyz", illuminant=light, basis="linear")
            self.expect(pixels, self.oracle(reflected, emitted, light))
            self.assertNotIn("reradiation", said)

    def test_ultraviolet_bands_glow_under_light_that_has_some(self):
        reflected, emitted = self.fluorescent(pairs=ULTRAVIOLET)
        pixels, _, said = self.both("f.exr", to="xyz", illuminant="D65", basis="linear")
        self.expect(pixels, self.oracle(reflected, emitted, "D65", pairs=ULTRAVIOLET))
        self.assertNotIn("no light is assumed", said)
        dark, _, said = self.both("f.exr", to="xyz", illuminant="FL2", basis="linear")
        self.expect(dark, reflected @ oracle_xyz(GRID, "FL2").T)
        self.assertRegex(said, r"warning: the light FL2 is known from 380 to 780 nm, .* no light is assumed at "
                               r"4 of 4 exciting bands \(300-360 nm\), which would have 100.00 % of the weight")

    def test_half_samples_and_tiles(self):
        reflected, emitted = self.fluorescent(types=HALF, tile=16)
        pixels, _, _ = self.both("f.exr", to="xyz", illuminant="D65", basis="linear")
        self.expect(pixels, self.oracle(reflected, emitted, "D65"))

    def test_several_lights_are_each_light_alone(self):
        self.fluorescent()
        self.osiotool("collapse", "f.exr", "all_{illuminant}.exr", "--to", "lin_rec709", "--illuminant", "A,D65")
        for light in ("A", "D65"):
            pixels, _, _ = self.both("f.exr", to="lin_rec709", illuminant=light)
            self.assertTrue(np.array_equal(self.in_order(f"all_{light}.exr", "RGB"), pixels.astype(np.float32)))

    def test_lab_is_of_the_total(self):
        reflected, emitted = self.fluorescent()
        pixels, _, _ = self.both("f.exr", to="lab", illuminant="D65", basis="linear")
        xyz = self.oracle(reflected, emitted, "D65")
        white = oracle_xyz(range(360, 831), "D65").sum(axis=1)
        self.expect(pixels[..., 0], 116 * np.cbrt(xyz[..., 1] / white[1]) - 16)

    def test_plan_and_weights_have_the_pairs(self):
        self.fluorescent()
        words = ("f.exr", "--to", "xyz", "--illuminant", "D65", "--basis", "linear")
        plan = self.osiotool_json("plan", *words)
        self.assertEqual(plan["wavelengths_nm"], GRID)
        self.assertEqual(plan["reradiation"]["pairs_nm"], [list(p) for p in PAIRS])
        self.assertEqual(plan["reradiation"]["unlit_share"], 0)
        self.assertEqual(plan["channels"][len(GRID):], [pair_name(p) for p in PAIRS])
        weights = np.array(plan["weights"])
        self.assertEqual(weights.shape, (3, len(GRID) + len(PAIRS)))
        self.expect(weights[:, len(GRID):], oracle_pairs(PAIRS, "D65"))
        rows = list(csv.reader(io.StringIO(self.osiotool("weights", *words).stdout)))
        self.assertEqual(rows[0], ["nm", "emitted_nm", "X", "Y", "Z"])
        self.assertEqual([row[1] for row in rows[1:]], [""] * len(GRID) + [str(o) for _, o in PAIRS])
        self.assertTrue(np.array_equal(np.array([[float(n) for n in row[2:]] for row in rows[1:]]).T, weights))
        text = self.osiotool("plan", *words).stdout
        self.assertIn("reradiation  210 pairs, excited at 380-760 nm every 20 nm", text)
        self.assertRegex(text, r"210 pairs, sum +\d")
        self.assertIn("fluorescent: 210 pairs T.in.out, 380-760 nm to 400-780 nm",
                      self.osiotool("info", "f.exr").stdout)

    def test_a_stock_oiiotool_does_the_same(self):
        self.fluorescent()
        command = self.osiotool("weights", "f.exr", "--to", "xyz", "--illuminant", "D65", "--oiiotool", "-o",
                                "stock.exr").stdout
        self.check("sh", "-c", command)
        pixels, _, _ = self.both("f.exr", to="xyz", illuminant="D65")
        self.expect(stack(self.channels_of("stock.exr"), "RGB"), pixels, 1e-5)

    def test_conversion_keeps_the_pairs_and_cuts_them(self):
        self.fluorescent()
        self.osiotool("convert", "f.exr", "same.exr")
        before, after = self.channels_of("f.exr"), self.channels_of("same.exr")
        self.assertEqual(sorted(before), sorted(after))
        for channel in before:
            self.assertTrue(np.array_equal(before[channel], after[channel]), channel)
        self.osiotool("convert", "f.exr", "cut.exr", "--bands", "400-600nm")
        inside = [p for p in PAIRS if 400 <= p[0] and p[1] <= 600]
        self.assertEqual({c for c in self.channels_of("cut.exr") if c.count("nm") == 2},
                         {pair_name(p) for p in inside})

    def test_the_plugin_writes_what_it_reads(self):
        self.fluorescent()
        self.check("oiiotool", "f.exr?to=raw", "-o:fileformatname=spectralexr", "o.exr")
        before, after = self.channels_of("f.exr"), self.channels_of("o.exr")
        self.assertEqual(sorted(before), sorted(after))
        for channel in before:
            self.assertTrue(np.array_equal(before[channel], after[channel]), channel)

    def test_a_certificate_bounds_pairs_as_bands(self):
        self.fluorescent(types=HALF)
        self.osiotool("collapse", "f.exr", "o.exr", "--to", "xyz", "--illuminant", "D65", "--certificate", "c.json")
        with open(self.path("c.json")) as file:
            certificate = json.load(file)
        self.assertEqual(certificate["not_proved"]["indicator_over"],
                         "the 24 patches of the ColorChecker, which do not fluoresce")
        # Half samples of pairs count too: with more of them the same image is known less well.
        self.write_exr("dark.exr", {c: plane for c, plane in self.channels_of("f.exr").items() if c.count("nm") == 1},
                       types=HALF)
        self.osiotool("collapse", "dark.exr", "d.exr", "--to", "xyz", "--illuminant", "D65", "--certificate", "d.json")
        with open(self.path("d.json")) as file:
            dark = json.load(file)
        self.assertTrue(np.all(np.array(certificate["proved"]["total"]["xyz"]) > dark["proved"]["total"]["xyz"]))
        self.osiotool("collapse", "f.exr", "o.exr", "--to", "xyz", "--illuminant", "D65", "--max-delta-e", "50")

    def test_a_preview_shows_the_total(self):
        reflected, emitted = self.fluorescent("f.exr")
        channels = self.channels_of("f.exr")
        # Any 3x3 matrix on XYZ is a preview's recipe, the identity too.
        xyz = self.oracle(reflected, emitted, "D65")
        self.write_exr("p.spexr", dict({c: xyz[..., i] for i, c in enumerate("RGB")}, **channels))
        self.check("oiiotool", "p.spexr", "-o", "same.spexr")
        self.assertIn("R", self.exr_channels("same.spexr"))
        dark = ",".join(["1"] * (3 + len(GRID)) + ["0"] * len(PAIRS))
        self.check("oiiotool", "p.spexr", "--mulc", dark, "-o", "dark.spexr")
        self.assertNotIn("R", self.exr_channels("dark.spexr"))

    def test_ninety_bands_and_all_their_pairs(self):
        grid = [335 + 5 * i for i in range(90)]
        pairs = [(i, o) for i in grid for o in grid if i < o]
        reflected, emitted = self.fluorescent(grid=grid, pairs=pairs)
        self.assertEqual(len(pairs), 4005)
        begin = time.monotonic()
        self.osiotool("plan", "f.exr", "--to", "xyz", "--illuminant", "D65", "--json")
        print(f"{self.id()}: plan of 4095 channels in {time.monotonic() - begin:.2f} s")
        self.osiotool("collapse", "f.exr", "o.exr", "--to", "xyz", "--names", "xyz", "--illuminant", "D65",
                      "--basis", "linear")
        self.expect(stack(self.channels_of("o.exr"), "XYZ"),
                    self.oracle(reflected, emitted, "D65", grid, pairs))

    def test_pairs_without_bands_are_refused(self):
        self.write_exr("p.exr", {pair_name(p): np.ones((2, 2)) for p in PAIRS[:3]})
        result = self.osiotool("collapse", "p.exr", "o.exr", "--to", "xyz", "--illuminant", "D65", code=1)
        self.assertIn("holds no band, only 3 pairs of reradiation", result.stderr)

    def test_a_spectrum_is_of_what_is_reflected_and_says_so(self):
        self.fluorescent()
        said = self.osiotool("spectrum", "f.exr", "0", "0")
        self.assertIn("set T is fluorescent: this is what it reflects; what its 210 pairs send out", said.stderr)
        self.assertEqual(len(said.stdout.splitlines()), 1 + len(GRID))

    def test_differences_are_of_the_total(self):
        self.fluorescent()
        dark = dict(self.bands(GRID, high=0.5))
        self.write_exr("dark.exr", dark)
        words = ("--illuminant", "D65")
        same = self.osiotool_json("difference", "f.exr", "f.exr", *words)
        other = self.osiotool_json("difference", "f.exr", "dark.exr", *words)
        self.assertEqual(same["max"], 0)
        self.assertGreater(other["mean"], 1)


if __name__ == "__main__":
    unittest.main()
