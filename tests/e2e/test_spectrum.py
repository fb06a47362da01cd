# SPDX-License-Identifier: Apache-2.0
"""Spectra of pixels and regions, against numpy; a plot that says what the table says."""

import unittest
import xml.etree.ElementTree

import numpy as np
from osio_case import HALF, OsioCase

GRID = [400, 450, 500, 555.5, 600, 700]
SVG = "{http://www.w3.org/2000/svg}"


class Spectrum(OsioCase):
    def setUp(self):
        super().setUp()
        self.values = self.bands(GRID, shape=(90, 40), seed=7)
        self.write_exr("a.exr", self.values, origin=(-5, 100))
        self.stack = np.stack([np.asarray(self.values[name], np.float32) for name in self.values])

    def table(self, *words):
        lines = self.osiotool("spectrum", "a.exr", *words).stdout.splitlines()
        return lines[0], np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])

    def test_a_pixel_is_the_files_samples(self):
        for x, y in ((-5, 100), (34, 189), (0, 131)):
            header, rows = self.table(x, y)
            self.assertEqual(header, "nm,value")
            self.assertEqual(list(rows[:, 0]), GRID)
            self.assertTrue(np.array_equal(rows[:, 1], self.stack[:, y - 100, x + 5].astype(float)))

    def test_a_region_is_its_mean_and_range(self):
        for place, area in (("7x50-3+120", np.s_[:, 20:70, 2:9]), ("40x90-5+100", np.s_[:]), (None, np.s_[:])):
            header, rows = self.table(*([place] if place else []), "--range")
            self.assertEqual(header, "nm,mean,minimum,maximum")
            pixels = self.stack[area].astype(float)
            self.expect(rows[:, 1], pixels.mean(axis=(1, 2)), allowed=1e-14)
            self.assertTrue(np.array_equal(rows[:, 2], pixels.min(axis=(1, 2))))
            self.assertTrue(np.array_equal(rows[:, 3], pixels.max(axis=(1, 2))))

    def test_nan_is_left_out_and_told(self):
        name = list(self.values)[2]
        self.values[name][3, 4] = np.nan
        self.values[name][5, 6] = np.inf
        self.write_exr("n.exr", self.values)
        result = self.osiotool("spectrum", "n.exr")
        self.assertIn("2 of the samples at 500 nm are NaN or infinite", result.stderr)
        kept = np.asarray(self.values[name], np.float32).astype(float)
        mean = float(result.stdout.splitlines()[3].split(",")[1])
        self.expect(mean, kept[np.isfinite(kept)].mean(), allowed=1e-14)

    def test_a_set_of_several(self):
        self.write_exr("s.exr", dict(self.bands([450, 550], prefix="S0"), **self.bands([450, 550], prefix="S1", seed=3)))
        first = self.osiotool("spectrum", "s.exr", "1", "1").stdout
        self.assertNotEqual(self.osiotool("spectrum", "s.exr", "1", "1", "--set", "S1").stdout, first)

    def test_a_table_is_a_light(self):
        self.osiotool("spectrum", "a.exr", "5", "110", "-o", "light.csv")
        self.osiotool("collapse", "a.exr", "o.exr", "--to", "xyz", "--illuminant", "light.csv", "--quiet")

    def test_the_plot_has_what_the_table_has(self):
        _, rows = self.table("7x50-3+120", "--range")
        self.osiotool("spectrum", "a.exr", "7x50-3+120", "-o", "a.svg")
        root = xml.etree.ElementTree.parse(self.path("a.svg")).getroot()
        marks = root.findall(f".//{SVG}circle")
        self.assertEqual([mark.find(f"{SVG}title").text for mark in marks],
                         [f"{row[0]:g} nm: {row[1]:.6g}" for row in rows])
        x = np.array([float(mark.get("cx")) for mark in marks])
        y = np.array([float(mark.get("cy")) for mark in marks])
        for places, values in ((x, rows[:, 0]), (y, rows[:, 1])):
            scale, offset = np.polyfit(values, places, 1)
            self.assertLess(np.abs(scale * values + offset - places).max(), 0.011)
        self.assertTrue((np.diff(x) > 0).all())
        self.assertLess(np.polyfit(rows[:, 1], y, 1)[0], 0)  # up is more
        line = root.find(f".//{SVG}polyline").get("points").split()
        self.assertEqual(line, [f"{a:.2f},{b:.2f}" for a, b in zip(x, y)])
        self.assertEqual(len(root.find(f".//{SVG}polygon").get("points").split()), 2 * len(GRID))
        self.assertIn("mean of 7x50-3+120", "".join(root.itertext()))

    def test_names_with_markup_stay_text(self):
        self.write_exr("a<b>&.exr", self.values, types={n: HALF for n in self.values})
        self.osiotool("spectrum", "a<b>&.exr", "1", "1", "-o", "a.svg")
        root = xml.etree.ElementTree.parse(self.path("a.svg")).getroot()
        self.assertIn("a<b>&.exr, T, pixel 1,1", "".join(root.itertext()))

    def test_refusals_leave_nothing(self):
        before = self.files()
        for words, code, said in ((["35", "100"], 2, "-5,100 to 34,189"), (["0", "99"], 2, "not all inside"),
                                  (["41x1-5+100"], 2, "not all inside"), (["0x5+1+100"], 2, "no place"),
                                  (["left"], 2, "no place"), (["1", "up"], 2, "no place"), (["5x5"], 2, "no place"),
                                  (["9999999999", "1"], 2, "no place"), (["1", "2", "3"], 2, ""),
                                  (["0", "110", "-o", "a.txt"], 2, ".csv nor a .svg"),
                                  (["0", "110", "--range", "-o", "a.svg"], 2, "--range"),
                                  (["0", "110", "--set", "S0"], 1, "S0"),
                                  (["0", "110", "-o", "none/a.csv"], 5, "none/a.csv")):
            self.assertIn(said, self.osiotool("spectrum", "a.exr", *words, code=code).stderr)
        self.osiotool("spectrum", "missing.exr", code=5)
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    unittest.main()
