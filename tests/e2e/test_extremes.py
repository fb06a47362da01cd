# SPDX-License-Identifier: Apache-2.0
"""Spectra at the edge of what numbers can say, through the tool and the plugin: the same bits by both,
numpy's or the golden row's values, and every doubtful pixel reported as a number."""

import csv
import os
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import HALF, OSIOTOOL, SOURCE, OsioCase, format_comma, oracle_xyz, table

SEVEN = list(range(400, 701, 50))
QUANTUM = 1.401298464324817e-45  # the smallest float above zero


def oracle_exact(wavelengths, values, hold=True):
    """XYZ of a radiance of straight lines: the exact integral, by Simpson's rule between all knots, where
    each product of two straight lines is a parabola."""
    cmf = table("observers/cie1931.csv")
    nm = cmf["wavelength_nm"]
    order = np.argsort(wavelengths, kind="stable")
    bands, samples = np.asarray(wavelengths, float)[order], np.asarray(values, float)[order]
    knots = np.union1d(nm, bands[(bands > 360) & (bands < 830)])
    lo, hi = knots[:-1], knots[1:]

    def curve(at, inside):
        found = np.interp(at, bands, samples)
        return found if hold else np.where((inside >= bands[0]) & (inside <= bands[-1]), found, 0)

    middle = (lo + hi) / 2
    out = []
    for bar in (cmf["x_bar"], cmf["y_bar"], cmf["z_bar"]):
        parts = [np.interp(at, nm, bar) * curve(at, middle) for at in (lo, middle, hi)]
        out.append(np.sum((hi - lo) / 6 * (parts[0] + 4 * parts[1] + parts[2])))
    even = np.sum((nm[1:] - nm[:-1]) * (cmf["y_bar"][1:] + cmf["y_bar"][:-1]) / 2)
    return np.array(out) / even


class Extremes(OsioCase):
    def write(self, wavelengths, values, prefix="S0", types=None, name="a.exr", attributes=(), width=3):
        """One spectrum in the middle of a row of flat 1. Bands beyond half's range are float; a wavelength
        that is there again gets one more zero in its name."""
        channels = {}
        for nm, value in zip(wavelengths, values):
            spelled = format_comma(nm)
            while f"{prefix}.{spelled}nm" in channels:
                spelled = "0" + spelled
            row = np.ones((1, width), np.float32)
            row[0, width // 2] = value
            channels[f"{prefix}.{spelled}nm"] = row
        return self.write_exr(name, channels, types=types or oiio.FLOAT, attributes=attributes)

    def middle(self, **words):
        """The middle pixel; its neighbours are flat 1, whatever stands between them."""
        pixels, report, said = self.both("a.exr", **words)
        self.assertTrue(np.array_equal(pixels[0, 0], pixels[0, 2]))
        self.assertTrue(np.isfinite(pixels[0, 0]).all())
        return pixels[0, pixels.shape[1] // 2], report, said

    def refuse(self, words, code=1, **options):
        """The tool refuses with the words, and so does the plugin, before a pixel is read."""
        arguments = [w for key, value in options.items() for w in (f"--{key}", value)]
        before = self.files()
        result = self.osiotool("collapse", "a.exr", "no.exr", *arguments, code=code)
        self.assertIn(words, result.stderr)
        self.assertEqual(self.files(), before)
        with open(self.path("a.spectral"), "w") as recipe:
            recipe.write("source = a.exr\n" + "".join(f"{k} = {v}\n" for k, v in options.items()))
        self.assertIsNone(oiio.ImageInput.open(self.path("a.spectral")))
        self.assertIn(words, oiio.geterror())
        os.remove(self.path("a.spectral"))

    # Every row of the golden file

    def golden_rows(self):
        with open(os.path.join(SOURCE, "tests/golden/extremes.csv")) as file:
            for row in csv.DictReader(file):
                if row["case"] == "5000_bands":
                    nm = np.linspace(380, 780, 5000)
                    yield row, list(nm), 0.5 + 0.4 * np.sin(nm / 17)
                else:
                    yield (row, [float(v) for v in row["wavelengths_nm"].split(";")],
                           [float(v) for v in row["values"].split(";")])

    def expected_of(self, row, extrapolate):
        plan = self.osiotool_json("plan", "a.exr", "--to", "xyz", "--basis", "linear", "--extrapolate", extrapolate)
        column = f"_{plan['quadrature']}_{'constext' if extrapolate == 'hold' else 'zeroext'}"
        return np.array([float(row[c + column]) for c in "XYZ"])

    def test_golden_rows(self):
        seen = 0
        for row, nm, values in self.golden_rows():
            self.write(nm, values)
            for extrapolate in ("hold", "zero"):
                words = {"to": "xyz", "basis": "linear", "extrapolate": extrapolate}
                with self.subTest(case=row["case"], extrapolate=extrapolate):
                    seen += 1
                    if row["case"] == "uv_only":
                        self.refuse("cover 200-350 nm, nothing of the 360-830 nm that an observer sees", **words)
                        continue
                    if row["case"] == "one_band_550" and extrapolate == "zero":
                        self.refuse("has one wavelength, 550 nm: with extrapolate=zero its spectrum has no width; "
                                    "use extrapolate=hold", **words)
                        continue
                    xyz, report, said = self.middle(**words)
                    doubtful = (report["nan_pixels"], report["infinite_pixels"])
                    if row["case"] == "nan_mid":
                        self.assertTrue(np.isnan(xyz).all())
                        self.assertEqual(doubtful, (1, 0))
                        self.assertIn("note: 1 of 3 pixels hold NaN", said)
                    elif row["case"] == "inf_mid":  # the text: XYZ = +Inf
                        self.assertTrue((xyz == np.inf).all())
                        self.assertEqual(doubtful, (0, 1))
                        self.assertIn("note: 1 of 3 pixels are infinite", said)
                    else:
                        self.assertEqual(doubtful, (0, 0))
                        expected = self.expected_of(row, extrapolate)
                        # A float sample and a float pixel are each rounded to half a quantum.
                        slack = 2e-6 * np.abs(expected).max() + QUANTUM
                        self.expect(xyz, expected, allowed=1, scale=slack)
        self.assertEqual(seen, 44)

    # What the golden file leaves to words

    def test_two_bands_and_fewer_than_a_rule_needs(self):
        for nm, basis, rule in (([450, 650], "e2022", "basis=e2022 needs 3 bands and there are 2"),
                                ([450, 500, 550, 600, 650], "sprague", "basis=sprague needs 6 bands and there are 5"),
                                ([550], "bins-corrected", "basis=bins-corrected needs 3 bands and there are 1")):
            self.write(nm, np.linspace(1, 2, len(nm)))
            xyz, report, _ = self.middle(to="xyz", basis=basis)
            self.assertIn(f"{rule}: straight lines are used", report["warnings"])
            self.expect(xyz, oracle_xyz(nm) @ np.linspace(1, 2, len(nm)))

    def test_one_bin_with_stated_edges(self):
        self.write([550], [2], attributes=[("spectral:binEdges", "540;560")])
        xyz, _, _ = self.middle(to="xyz", extrapolate="zero")
        self.expect(xyz, 2 * oracle_exact([540, 560], [1, 1], hold=False))

    def test_twenty_thousand_bands(self):
        nm = np.linspace(380, 780, 20001)
        values = (0.5 + 0.4 * np.sin(nm / 17)).astype(np.float32)
        self.write(list(nm), values)
        xyz, _, _ = self.middle(to="xyz", basis="linear")
        self.expect(xyz, oracle_exact(nm, values))

    def test_unsorted_is_sorted_to_the_bit(self):
        random = np.random.default_rng(5)
        nm = np.array([380, 381, 385, 400, 430, 500, 620, 700, 780, 1000])
        values = random.uniform(0, 1, nm.size)
        sorted_pixels = None
        for order in (np.arange(nm.size), random.permutation(nm.size), np.arange(nm.size)[::-1]):
            self.write(nm[order], values[order])
            xyz, _, _ = self.middle(to="lin_rec709", basis="linear")
            sorted_pixels = xyz if sorted_pixels is None else sorted_pixels
            self.assertTrue(np.array_equal(xyz, sorted_pixels))

    def test_duplicates_are_told_and_count_as_their_mean(self):
        self.write([450, 550, 550, 650], [1, 1, 3, 1])
        conflicting, report, said = self.middle(to="xyz", basis="linear")
        self.assertIn("550 nm", " ".join(report["warnings"]))
        self.assertIn("550 nm", said)
        self.write([450, 550, 650], [1, 2, 1])
        mean, _, _ = self.middle(to="xyz", basis="linear")
        self.expect(conflicting, mean)

    def test_gaps_are_bridged(self):
        gap = [400, 410, 420, 430, 600, 610, 620, 630]
        values = [0.2] * 4 + [0.8] * 4
        self.write(gap, values)
        xyz, _, _ = self.middle(to="xyz", basis="linear")
        self.expect(xyz, oracle_xyz(gap) @ values)
        bins, _, _ = self.middle(to="xyz", basis="bins")
        self.expect(bins, oracle_exact([400, 515, 515.0000001, 630], [0.2, 0.2, 0.8, 0.8]))

    def test_partly_outside_is_clipped_and_told(self):
        self.write([300, 350, 400], [1, 1, 1])
        xyz, report, _ = self.middle(to="xyz", basis="linear", extrapolate="zero")
        self.expect(xyz, oracle_xyz([300, 350, 400], hold=False).sum(axis=1))
        self.assertIn("430 nm above the bands are extrapolated (zero): much of the weight rests on it",
                      " ".join(report["warnings"]))

    def test_denormals(self):
        for value in (1e-40, 1e-44):
            self.write(SEVEN, [value] * 7)
            xyz, report, _ = self.middle(to="xyz", basis="linear")
            expected = oracle_xyz(SEVEN) @ np.full(7, float(np.float32(value)))
            self.expect(xyz, expected, allowed=1, scale=QUANTUM)
            self.assertEqual(report["nan_pixels"], 0)

    def test_huge_radiance(self):
        for value in (1e38, 3e38):
            self.write(SEVEN, [value] * 7)
            xyz, report, _ = self.middle(to="xyz", basis="linear")
            self.expect(xyz, oracle_xyz(SEVEN) @ np.full(7, float(np.float32(value))))
            self.assertEqual((report["nan_pixels"], report["infinite_pixels"]), (0, 0))
        # Red above the range of a float is infinite, never NaN, and is counted.
        self.write(SEVEN, [0, 0, 0, 0, 3e38, 3e38, 3e38])
        rgb, report, said = self.middle(to="lin_rec709", basis="linear", exposure="3")
        self.assertEqual(rgb[0], np.inf)
        self.assertFalse(np.isnan(rgb).any())
        self.assertEqual((report["nan_pixels"], report["infinite_pixels"]), (0, 1))
        self.assertIn("are infinite", said)

    def test_half_maximum_and_what_half_rounds_to_infinity(self):
        self.write(SEVEN, [65504] * 7, types=HALF)
        xyz, report, _ = self.middle(to="xyz", basis="linear")
        self.expect(xyz, oracle_xyz(SEVEN) @ np.full(7, 65504.0))
        half, report, said = self.both("a.exr", depth="half", to="xyz", basis="linear")
        self.assertTrue((half[0, 1] == 65504).all())
        self.assertEqual(report["clamped_samples"], 2)  # X 65509 and Z 65525; Y is 65504 itself
        self.assertIn("note: 2 samples beyond +-65504 were written as +-65504", said)
        self.write(SEVEN, [1, 1, 65520, 1, 1, 1, 1], types=HALF)  # arrives as infinity
        xyz, report, _ = self.middle(to="xyz", basis="linear")
        self.assertTrue((xyz == np.inf).all())
        self.assertEqual(report["infinite_pixels"], 1)

    def test_infinity_in_every_band(self):
        self.write(SEVEN, [np.inf] * 7)
        xyz, report, _ = self.middle(to="xyz", basis="linear")
        self.assertTrue((xyz == np.inf).all())
        rgb, report, said = self.middle(to="lin_rec709", basis="linear")
        self.assertTrue(np.isnan(rgb).any())  # infinity minus infinity
        self.assertEqual(report["nan_pixels"], 1)
        self.assertIn("hold NaN", said)

    def test_nan_and_infinity_without_weight_do_no_harm(self):
        grid = [400, 500, 600, 700, 831, 900]
        for harm in (np.nan, np.inf):
            self.write(grid, [1, 1, 1, 1, 1, harm])
            xyz, report, _ = self.middle(to="xyz", basis="linear")
            self.expect(xyz, oracle_xyz(grid).sum(axis=1))
            self.assertEqual((report["nan_pixels"], report["infinite_pixels"]), (0, 0))
        # The light of a reflectance takes weight away too: HP1 ends at 780 nm.
        grid = [400, 500, 600, 700, 781, 800]
        self.write(grid, [1, 1, 1, 1, 1, np.nan], prefix="T")
        xyz, _, _ = self.middle(to="xyz", basis="linear", illuminant="HP1")
        self.assertTrue(np.isfinite(xyz).all())

    def test_lights_that_shine_nowhere_or_elsewhere(self):
        self.write([600, 650, 700], [1, 1, 1], prefix="T")
        self.write_table("none.csv", "380,0", "780,0")
        self.write_table("blue.csv", "380,1", "500,1")
        self.write_table("uv.csv", "360,1", "380,1")
        for extrapolate in ("hold", "zero"):
            words = {"to": "xyz", "basis": "linear", "extrapolate": extrapolate}
            self.refuse("none.csv: no power at any whole nanometre of 360-830 nm", code=2, illuminant="none.csv",
                        **words)
            self.refuse("blue.csv: the light has no power over 600-700 nm", illuminant="blue.csv", **words)
        self.write([360, 500, 700], [1, 1, 1], prefix="T")
        self.refuse("uv.csv: the light has no luminance (sum of S y-bar is 0), so no white can be", illuminant="uv.csv", to="xyz",
                    observer="cie2015_2deg")

    def test_black_pixels(self):
        self.write(SEVEN, [0] * 7)
        for to in ("xyz", "lin_rec709", "acescg", "srgb", "lab", "luv", "luminance"):
            out, report, _ = self.middle(to=to, basis="linear")
            self.assertTrue((out == 0).all(), to)
            self.assertEqual(report["nan_pixels"], 0)
        self.write(SEVEN, [0] * 7, prefix="T")
        xyy, _, _ = self.middle(to="xyY", basis="linear", illuminant="D65")
        self.expect(xyy, [0.312727, 0.329023, 0], allowed=2e-6)

    def test_negative_bands_pass_and_are_counted(self):
        self.write(SEVEN, [-1, -0.1, -1, -0.2, -1, -0.05, -1])
        values = -np.array([1, 0.1, 1, 0.2, 1, 0.05, 1], np.float32).astype(float)
        xyz, report, said = self.middle(to="xyz", basis="linear")
        self.expect(xyz, oracle_xyz(SEVEN) @ values)
        self.assertEqual(report["negative_pixels"], 1)
        self.assertIn("note: 1 of 3 pixels have a negative channel, outside the gamut", said)
        lab, _, _ = self.middle(to="lab", basis="linear")
        self.assertTrue(np.isfinite(lab).all())

    def test_saturated_colours_cancel_to_a_share_of_the_largest_channel(self):
        grid = list(range(380, 781, 5))
        values = np.zeros(len(grid))
        values[grid.index(605)], values[grid.index(610)] = 0.4, 0.6
        self.write(grid, values)
        rgb, report, _ = self.middle(to="lin_rec709", basis="linear")
        rec709 = np.linalg.inv(np.array([[0.41239079926595948, 0.35758433938387796, 0.18048078840183429],
                                         [0.21263900587151036, 0.71516867876775593, 0.07219231536073371],
                                         [0.01933081871559185, 0.11919477979462599, 0.95053215224966058]]))
        self.expect(rgb, rec709 @ (oracle_xyz(grid) @ values.astype(np.float32).astype(float)), allowed=1e-6)
        self.assertLess(np.abs(rgb[1]), 0.05 * rgb[0])
        self.assertEqual(report["negative_pixels"], 1)

    def test_plans_say_what_is_doubtful_too(self):
        self.write([300, 350, 400], [1, 1, 1])
        text = self.check(OSIOTOOL, "plan", "a.exr", "--to", "xyz")
        self.assertIn("extrapolated", text)


if __name__ == "__main__":
    unittest.main()
