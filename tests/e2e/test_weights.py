# SPDX-License-Identifier: Apache-2.0
"""A collapse as a table and as a command that a stock oiiotool takes."""

import os
import unittest

import numpy as np
from osio_case import HALF, OsioCase

GRID = [400, 450, 500, 555.5, 600, 700]
WORDS = ("--to", "acescg", "--illuminant", "FL11")
WITHOUT_US = {name: "" for name in ("OPENIMAGEIO_PLUGIN_PATH", "OIIO_LIBRARY_PATH")}


class Weights(OsioCase):
    def setUp(self):
        super().setUp()
        self.values = dict(self.bands(GRID, seed=4), A=np.ones((5, 7)), Z=np.full((5, 7), 9.0), B=np.full((5, 7), 3.0))
        self.write_exr("a.exr", self.values, types={n: HALF for n in list(self.values)[:2]})

    def stock(self, name, *words):
        """Pixels of the command that is printed, run where nobody knows our plugins."""
        command = self.osiotool("weights", name, *words, "--oiiotool", "-o", "it's.exr").stdout
        self.check("sh", "-c", command, env=WITHOUT_US)
        return self.channels_of("it's.exr")

    def ours(self, name, *words):
        self.osiotool("collapse", name, "o.exr", *words, "--quiet")
        return self.channels_of("o.exr")

    def test_the_table_is_the_plan(self):
        lines = self.osiotool("weights", "a.exr", *WORDS).stdout.splitlines()
        plan = self.osiotool_json("plan", "a.exr", *WORDS)
        self.assertEqual(lines[0], "nm,R,G,B")
        rows = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
        self.assertEqual(list(rows[:, 0]), plan["wavelengths_nm"])
        self.assertTrue(np.array_equal(rows[:, 1:].T, np.array(plan["weights"])))

    def test_a_stock_oiiotool_makes_the_same_pixels(self):
        for words in (WORDS, ("--to", "xyz", "--illuminant", "D65"), ("--to", "luminance", "--illuminant", "A")):
            stock, ours = self.stock("a.exr", *words), self.ours("a.exr", *words)
            self.assertEqual(sorted(stock), sorted(set(ours) - {"A"}))
            for channel, pixels in stock.items():
                self.expect(pixels, ours[channel].astype(float))

    def test_a_part_of_several(self):
        self.osiotool("collapse", "a.exr", "parts.exr", "--to", "xyz", "--illuminant", "A,D65", "--quiet")
        self.check("oiiotool", "parts.exr", "a.exr", "--siappendall", "-o", "several.exr", env=WITHOUT_US)
        part = str(len(self.osiotool_json("info", "several.exr")["parts"]) - 1)
        stock, ours = self.stock("several.exr", *WORDS, "--part", part), self.ours("a.exr", *WORDS)
        for channel in "RGB":
            self.expect(stock[channel], ours[channel].astype(float))

    def test_what_is_no_sum_is_refused(self):
        for to in ("srgb", "lab"):
            words = ("a.exr", "--to", to, "--illuminant", "A")
            self.assertIn("more than sums", self.osiotool("weights", *words, "--oiiotool", code=2).stderr)
            self.assertIn("sums that", self.osiotool("weights", *words).stderr)
        self.osiotool("weights", "a.exr", "--to", "xyz", code=1)
        self.assertIn("--oiiotool", self.osiotool("weights", "a.exr", *WORDS, "-o", "o.exr", code=2).stderr)
        self.osiotool("convert", "a.exr", "cube.hdr", "--quiet")
        self.assertIn("ENVI", self.osiotool("weights", "cube.hdr", *WORDS, "--oiiotool", code=1).stderr)
        for name in ("cube.hdr", "cube.img"):
            os.remove(self.path(name))
        self.assertEqual(os.listdir(self.folder), ["a.exr"])


if __name__ == "__main__":
    unittest.main()
