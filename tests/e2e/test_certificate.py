# SPDX-License-Identifier: Apache-2.0
"""Certificates: what they claim against the truth in double, and that nothing uncertified is ever answered."""

import json
import os
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import HALF, OsioCase, oracle_xyz, stack

GRID = list(range(400, 701, 10))
SHAPE = (37, 41)
BUCKETS = [360 + 29.375 * (i + 0.5) for i in range(16)]  # a renderer's 16 over 360-830 nm


class Certificate(OsioCase):
    def certificate(self, source, *options, output="out.exr"):
        self.osiotool("collapse", source, output, "--certificate", "c.json", "--quiet", *options)
        with open(self.path("c.json"), encoding="utf-8") as file:
            return json.load(file)

    def terms(self, certificate):
        return {term["name"]: term for term in certificate["proved"]["terms"]}

    def attribute(self, name):
        spec, _ = self.read(name)
        return json.loads(spec.get_string_attribute("spectral:certificate"))

    def test_the_claim_holds_for_every_pixel(self):
        bands = self.bands(GRID, SHAPE)
        self.write_exr("a.exr", bands)
        weights = oracle_xyz(GRID, "FL11")
        exact = stack(bands, list(bands)) @ weights.T
        white = oracle_xyz(GRID, "FL11") @ np.ones(len(GRID))
        for depth in ("half", "float"):
            claim = self.certificate("a.exr", "--to", "xyz", "--illuminant", "FL11", "--basis", "linear", "-d", depth)
            found = self.in_order("out.exr", ["R", "G", "B"]).astype(np.float64)
            error = np.abs(found - exact).reshape(-1, 3).max(axis=0) / white
            for c in range(3):  # the oracle is another evaluation in double: 1e-12
                self.assertLessEqual(error[c], claim["proved"]["total"]["xyz"][c] + 1e-12)
                self.assertGreater(error[c], claim["proved"]["total"]["xyz"][c] / 100, "a bound of no use")
            self.assertEqual(claim["pixels"], SHAPE[0] * SHAPE[1])
            self.assertEqual(claim["type"], depth)

    def test_halves_of_the_input_have_their_term(self):
        bands = self.bands(GRID, SHAPE)
        self.write_exr("float.exr", bands)
        self.write_exr("half.exr", bands, types=HALF)
        options = ("--to", "xyz", "--illuminant", "D65")
        exact = self.terms(self.certificate("float.exr", *options))
        self.assertEqual(exact["input storage"]["delta_e_2000"], 0)
        self.assertEqual(exact["output storage"]["delta_e_2000"], 0)
        rounded = self.certificate("half.exr", *options, output="half_out.exr")
        self.certificate("float.exr", *options)
        difference = self.osiotool_json("difference", "out.exr", "half_out.exr")["max"]
        self.assertGreater(difference, 0)
        self.assertLessEqual(difference, rounded["proved"]["total"]["delta_e_2000"])

    def test_the_total_is_not_below_a_term(self):
        self.write_exr("a.exr", self.bands(GRID, SHAPE), types=HALF)
        claim = self.certificate("a.exr", "--to", "acescg", "--illuminant", "A", "-d", "half")
        for term in claim["proved"]["terms"]:
            self.assertLessEqual(term["delta_e_2000"], claim["proved"]["total"]["delta_e_2000"])
        self.assertGreaterEqual(claim["not_proved"]["total_with_indicator"], claim["proved"]["total"]["delta_e_2000"])

    def test_it_goes_into_the_file_and_the_file_is_sound(self):
        self.write_exr("a.exr", self.bands(GRID, SHAPE))
        beside = self.certificate("a.exr", "--to", "lin_rec709", "--illuminant", "D65")
        self.assertEqual(self.attribute("out.exr"), beside)
        self.osiotool("verify", "out.exr")
        self.assertEqual([t["role"] for t in beside["tables"]], ["observer", "illuminant"])
        self.assertEqual(beside["plan"], self.osiotool_json("plan", "a.exr", "--to", "lin_rec709", "--illuminant",
                                                            "D65")["id"])

    def test_the_pixels_are_those_without_a_certificate(self):
        self.write_exr("a.exr", self.bands(GRID, SHAPE))
        self.osiotool("collapse", "a.exr", "plain.exr", "--to", "srgb", "--illuminant", "D50", "--quiet")
        self.certificate("a.exr", "--to", "srgb", "--illuminant", "D50")
        self.check("idiff", "-q", "plain.exr", "out.exr")

    def test_several_lights_have_one_each(self):
        self.write_exr("a.exr", self.bands(GRID, SHAPE))
        claims = self.certificate("a.exr", "--to", "xyz", "--illuminant", "A,FL11")
        self.assertEqual([c["tables"][1]["name"] for c in claims], ["A", "FL11"])
        spec = oiio.ImageInput.open(self.path("out.exr"))
        for i, claim in enumerate(claims):
            self.assertTrue(spec.seek_subimage(i, 0))
            self.assertEqual(json.loads(spec.spec().get_string_attribute("spectral:certificate")), claim)
        spec.close()

    def test_clamped_and_undefined_pixels_are_counted(self):
        bands = self.bands(GRID, SHAPE, prefix="S0")
        for plane in bands.values():
            plane[3, 4] = 1e7
        bands["S0.550nm"][5, 6] = np.nan
        self.write_exr("a.exr", bands)
        claim = self.certificate("a.exr", "--to", "xyz", "-d", "half")
        self.assertEqual(claim["clamped_pixels"], 1)
        self.assertEqual((claim["undefined_pixels"], claim["nan_pixels"]), (1, 1))
        self.assertGreater(self.terms(claim)["output storage"]["xyz"][1], 1)

    def test_the_white_of_radiance(self):
        bands = self.bands(GRID, SHAPE, prefix="S0", high=0.9)
        self.write_exr("a.exr", bands)
        claim = self.certificate("a.exr", "--to", "lin_rec709")
        luminance = self.osiotool_json("photometry", "a.exr")["luminance_percentiles"]["99"]
        self.assertEqual(claim["white_luminance_from"], "the 99th percentile of Y")
        plan = self.osiotool_json("plan", "a.exr", "--to", "luminance", "--scale", "photometric")
        relative = self.osiotool_json("plan", "a.exr", "--to", "luminance")
        gain = plan["weights"][0][10] / relative["weights"][0][10]
        self.assertAlmostEqual(claim["white_luminance"] * gain / luminance, 1, delta=1e-3)
        half = self.certificate("a.exr", "--to", "lin_rec709", "--white-luminance", "0.5", "-d", "half")
        self.assertEqual((half["white_luminance"], half["white_luminance_from"]), (0.5, "as requested"))


class MaxDeltaE(OsioCase):
    def setUp(self):
        super().setUp()
        self.write_exr("fine.exr", self.bands(list(range(380, 781, 5)), SHAPE, low=0.2))

    def test_the_cheapest_that_holds(self):
        options = ("--to", "xyz", "--illuminant", "D65", "--basis", "bins", "--quiet")
        reach = {}
        for depth in ("half", "float"):
            self.osiotool("collapse", "fine.exr", "out.exr", *options, "-d", depth, "--max-delta-e", "100",
                          "--certificate", "c.json")
            with open(self.path("c.json"), encoding="utf-8") as file:
                reach[depth] = json.load(file)["not_proved"]["total_with_indicator"]
        self.assertLess(reach["float"], reach["half"])
        for limit, expected in ((1.001 * reach["half"], "half"), ((reach["half"] + reach["float"]) / 2, "float")):
            report = self.osiotool_json("collapse", "fine.exr", "out.exr", *options, "--max-delta-e", str(limit))
            self.assertEqual(report["type"], expected, limit)
        self.osiotool("collapse", "fine.exr", "out.exr", *options, "--max-delta-e", str(reach["float"] / 1.001), code=3)

    def test_16_buckets_do_not_carry_fl11(self):
        # A radiance with the lines of a fluorescent lamp, averaged over a renderer's buckets.
        random = np.random.default_rng(3)
        bands = {f"S0.{nm:.3f}nm".replace(".", ",").replace("S0,", "S0."):
                 (random.uniform(0.05, 1, SHAPE) * (8 if i in (2, 6, 8) else 1)).astype(np.float32)
                 for i, nm in enumerate(BUCKETS)}
        self.write_exr("buckets.exr", bands)
        before = self.files()
        result = self.osiotool("collapse", "buckets.exr", "out.exr", "--to", "xyz", "--max-delta-e", "1",
                               "--certificate", "c.json", code=3)
        self.assertIn("the indicator fails: 16 bands of 29.4 nm", result.stderr)
        self.assertEqual(self.files(), before)
        image = oiio.ImageInput.open(self.path("buckets.exr") + "?to=xyz&max-delta-e=1")
        self.assertIsNone(image)

    def test_an_old_file_stays(self):
        self.osiotool("collapse", "fine.exr", "out.exr", "--to", "xyz", "--illuminant", "D65", "--quiet")
        with open(self.path("out.exr"), "rb") as file:
            before = file.read()
        self.osiotool("collapse", "fine.exr", "out.exr", "--to", "xyz", "--illuminant", "FL11", "--max-delta-e",
                      "0.000001", code=3)
        with open(self.path("out.exr"), "rb") as file:
            self.assertEqual(file.read(), before)

    def test_the_term_that_fails_is_named(self):
        options = ("--to", "xyz", "--illuminant", "D65", "--basis", "bins", "--max-delta-e", "0.01", "-d", "half")
        self.write_exr("flat.exr", {name: np.full(SHAPE, 0.5, np.float32) for name in self.bands(GRID)})
        result = self.osiotool("collapse", "flat.exr", "out.exr", *options, code=3)
        self.assertIn("the term that fails is output storage", result.stderr)
        self.assertIn("-d float", result.stderr)
        self.osiotool("collapse", "flat.exr", "out.exr", *options[:-2], "-d", "float")

    def test_nan_is_not_certified(self):
        bands = self.bands(GRID)
        bands["T.500nm"][1, 1] = np.nan
        self.write_exr("nan.exr", bands)
        result = self.osiotool("collapse", "nan.exr", "out.exr", "--to", "xyz", "--illuminant", "D65",
                               "--max-delta-e", "100", code=3)
        self.assertIn("1 of 35 pixels are NaN", result.stderr)

    def test_a_query_is_certified_or_refused(self):
        query = self.path("fine.exr") + "?to=xyz&illuminant=D65&max-delta-e="
        self.assertIsNone(oiio.ImageInput.open(query + "0.0001"))
        spec, pixels = self.read(query + "1")
        claim = json.loads(spec.get_string_attribute("spectral:certificate"))
        self.assertTrue(claim["holds"])
        self.assertIsNone(claim["output"])
        self.osiotool("collapse", "fine.exr", "out.exr", "--to", "xyz", "--illuminant", "D65", "--quiet")
        self.assertTrue(np.array_equal(pixels, self.in_order("out.exr", ["R", "G", "B"])))
        self.check("oiiotool", query + "1", "-o", "stock.exr")
        result = self.run_program("oiiotool", query + "0.0001", "-o", "none.exr")
        self.assertNotEqual(result.returncode, 0)
        self.assertFalse(os.path.exists(self.path("none.exr")))

    def test_words_that_do_not_fit(self):
        for code, options in ((2, ("--to", "lab", "--certificate", "c.json")),
                              (2, ("--to", "xyz", "--white-luminance", "3")),
                              (2, ("--to", "xyz", "--max-delta-e", "-1")),
                              (2, ("--to", "xyz", "--max-delta-e", "much")),
                              (2, ("--to", "xyz", "--certificate", "c.json", "--allow-partial"))):
            self.osiotool("collapse", "fine.exr", "out.exr", "--illuminant", "D65", *options, code=code)
            self.assertNotIn("out.exr", self.files())


if __name__ == "__main__":
    unittest.main()
