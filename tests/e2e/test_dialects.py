# SPDX-License-Identifier: Apache-2.0
"""Files in other programs' dialects through every door, against the file of the layout with the same meaning."""

import os
import unittest

import numpy as np
from osio_case import FLOAT, HALF, OsioCase

NM = [410, 450, 490, 530, 570, 610, 650, 690]
EDGES = ";".join(str(nm) for nm in range(390, 711, 40))


def binned(nm):
    return f"{nm - 20}.00-{nm + 20}.00nm"


class Dialects(OsioCase):
    def setUp(self):
        super().setUp()
        self.values = list(self.bands(NM).values())
        self.write_exr("layout.exr", {f"S0.{nm}nm": v for nm, v in zip(NM, self.values)},
                       attributes=[("spectral:binEdges", EDGES)])

    def write(self, name, names, scale=1, types=FLOAT, attributes=(), more=()):
        self.write_exr(name, dict(zip(names, [v * scale for v in self.values]), **dict(more)), types=types,
                       attributes=attributes)

    def assertSamePixels(self, a, b, rtol=0):
        left, right = self.channels_of(a), self.channels_of(b)
        self.assertEqual(sorted(left), sorted(right))
        for name in left:
            np.testing.assert_allclose(left[name], right[name], rtol=rtol, atol=0, err_msg=name)

    def test_every_command_reads_mitsuba(self):
        self.write("m.exr", [binned(nm) for nm in NM], attributes=[("generatedBy", "Mitsuba version 0.5.0")])
        for name in ("m", "layout"):
            self.osiotool("collapse", f"{name}.exr", f"{name}_xyz.exr", "--to", "xyz")
            self.osiotool("photometry", f"{name}.exr", f"{name}_y.exr")
            self.osiotool("convert", f"{name}.exr", f"{name}.hdr")
            self.check("oiiotool", f"{name}.exr?to=xyz", "-o", f"{name}_query.exr")
        self.assertSamePixels("m_xyz.exr", "layout_xyz.exr")
        self.assertSamePixels("m_query.exr", "layout_xyz.exr")
        self.assertSamePixels("m_y.exr", "layout_y.exr")
        with open(self.path("m.img"), "rb") as a, open(self.path("layout.img"), "rb") as b:
            self.assertEqual(a.read(), b.read())
        self.assertEqual(self.osiotool("spectrum", "m.exr", "1", "2").stdout,
                         self.osiotool("spectrum", "layout.exr", "1", "2").stdout)
        self.assertEqual(self.osiotool("weights", "m.exr", "--to", "xyz").stdout,
                         self.osiotool("weights", "layout.exr", "--to", "xyz").stdout)
        difference = self.osiotool_json("difference", "m.exr", "layout.exr")
        self.assertEqual(difference["max"], 0)
        self.assertIn("  dialect Mitsuba 0.x bins: 8 names such as", self.osiotool("info", "m.exr").stdout)

    def test_a_converted_file_is_one_of_the_layout(self):
        self.write("m.exr", [binned(nm) for nm in NM])
        self.osiotool("convert", "m.exr", "c.exr")
        part = self.osiotool_json("info", "c.exr")["parts"][0]
        self.assertEqual(part["dialect"], "spectral EXR layout")
        self.assertEqual(part["sets"][0]["channels"], [f"S0.{nm}nm" for nm in NM])
        self.assertEqual(part["warnings"], [])
        self.osiotool("collapse", "c.exr", "c_xyz.exr", "--to", "xyz")
        self.osiotool("collapse", "m.exr", "m_xyz.exr", "--to", "xyz")
        self.assertSamePixels("c_xyz.exr", "m_xyz.exr")
        # So is what a host writes of the bands it was shown.
        self.check("oiiotool", "m.exr?to=raw", "-o", "h.spexr")
        self.osiotool("collapse", "h.spexr", "h_xyz.exr", "--to", "xyz")
        self.assertSamePixels("h_xyz.exr", "m_xyz.exr")

    def test_indigo_is_per_metre(self):
        self.write("i.exr", [f"wavelength{nm - 20}" for nm in NM], scale=1e9)
        self.osiotool("collapse", "i.exr", "i_xyz.exr", "--to", "xyz")
        self.osiotool("collapse", "layout.exr", "layout_xyz.exr", "--to", "xyz")
        self.assertSamePixels("i_xyz.exr", "layout_xyz.exr", rtol=1e-6)
        raw = self.channels_of("i.exr?to=raw")
        np.testing.assert_allclose(raw["S0.410nm"], self.values[0], rtol=1e-6)
        # The command of a stock oiiotool works on the stored numbers.
        self.check("sh", "-c", self.osiotool("weights", "i.exr", "--to", "xyz", "--oiiotool", "-o", "stock.exr").stdout)
        self.assertSamePixels("stock.exr", "i_xyz.exr", rtol=1e-5)
        self.write("half.exr", [f"wavelength{nm - 20}" for nm in NM], scale=1e4, types=HALF)
        refused = self.osiotool("collapse", "half.exr", "no.exr", "--to", "xyz", "--max-delta-e", "1", code=1).stderr
        self.assertIn("no bound counts how they were rounded", refused)
        self.assertIn("times 1e-9", self.osiotool("collapse", "i.exr", "again.exr", "--to", "xyz").stderr)

    def test_what_is_not_stated_is_said_or_asked(self):
        self.write("n.exr", [f"b_{nm}nm" for nm in NM], more={"A": np.ones((5, 7))}.items())
        assumed = self.osiotool("collapse", "n.exr", "o.exr", "--to", "xyz", "--illuminant", "A").stderr
        self.assertIn("taken as reflectance; quantity=radiance makes them radiance", assumed)
        self.osiotool("collapse", "n.exr", "o.exr", "--to", "xyz", code=1)
        said = self.osiotool("collapse", "n.exr", "o.exr", "--to", "xyz", "--quantity", "radiance").stderr
        self.assertNotIn("taken as reflectance", said)
        self.osiotool("collapse", "layout.exr", "o.exr", "--to", "xyz", "--quantity", "reflectance", code=1)
        self.osiotool("info", "n.exr", "--quantity", "light", code=2)
        self.assertIn("A", self.channels_of("n.exr?to=xyz&quantity=radiance"))

    def test_recipes_and_results_keep_the_words(self):
        self.write("cv.exr", [str(i) for i in range(len(NM))])
        with open(self.path("shot.spectral"), "w") as file:
            file.write("source = cv.exr\nto = xyz\nwavelengths = 410:40:690\nquantity = radiance\n")
        self.check("oiiotool", "shot.spectral", "-o", "recipe.exr")
        spec, _ = self.read("recipe.exr")
        recipe = spec.get_string_attribute("spectral:recipe")
        self.assertIn("&wavelengths=410:40:690&quantity=radiance&", recipe)
        self.check("oiiotool", f"cv.exr?{recipe}", "-o", "again.exr")
        self.assertSamePixels("recipe.exr", "again.exr")
        os.mkdir(self.path("sub"))
        self.write_table("sub/bands.csv", "channel,nm,fwhm", *(f"{i},{nm},20" for i, nm in enumerate(NM)))
        with open(self.path("sub/table.spectral"), "w") as file:
            file.write("source = ../cv.exr\nto = xyz\nwavelengths = bands.csv\nquantity = radiance\nbasis = bins-corrected\n")
        self.check("oiiotool", "sub/table.spectral", "-o", "table.exr")
        self.osiotool("collapse", "cv.exr", "same.exr", "--to", "xyz", "--wavelengths", "410:40:690", "--quantity",
                      "radiance", "--basis", "bins-corrected")
        self.assertSamePixels("table.exr", "same.exr")

    def test_numbers_of_channels_that_do_not_fit(self):
        self.write("cv.exr", [str(i) for i in range(len(NM))])
        plain = self.osiotool("collapse", "cv.exr", "o.exr", "--to", "xyz", code=4).stderr
        self.assertIn("OpenCV's numbered channels (names 0 to 7), which say no wavelengths; give them with "
                      "wavelengths=400:10:700", plain)
        wrong = self.osiotool("plan", "cv.exr", "--to", "xyz", "--wavelengths", "400:10:700", code=1).stderr
        self.assertIn("are 31 wavelengths, and there are 8 channels to give them to", wrong)
        self.osiotool("plan", "cv.exr", "--to", "xyz", "--wavelengths", "400-700", code=2)
        self.osiotool("plan", "cv.exr", "--to", "xyz", "--wavelengths", "none.csv", code=5)
        self.assertFalse(os.path.exists(self.path("o.exr")))

    def test_of_two_images_the_word_may_be_for_one(self):
        self.write("cv.exr", [str(i) for i in range(len(NM))])
        words = ("--wavelengths", "cv.csv", "--quantity", "radiance")
        self.write_table("cv.csv", *(f"{i},{nm}" for i, nm in enumerate(NM)))
        self.write_exr("rgb.exr", {c: self.values[0] for c in "RGB"})
        result = self.osiotool("difference", "cv.exr", "rgb.exr", *words)
        self.assertIn("read without the word", result.stderr)
        self.osiotool("difference", "rgb.exr", "rgb.exr", *words, code=1)


class Audit(OsioCase):
    def part(self, name, *words):
        return self.osiotool_json("audit", name, *words)["files"][0]["parts"][0]

    def test_writers_by_what_their_headers_hold(self):
        bands = self.bands([400, 410, 420], prefix="S0")
        self.write_exr("pbrt.exr", bands, types=HALF, attributes=[
            ("spectralLayoutVersion", "1.0"), ("emissiveUnits", "W.m^-2.sr^-1"), ("renderTimeSeconds", 3.5),
            ("samplesPerPixel", 16)])
        pbrt = self.part("pbrt.exr")
        self.assertEqual(pbrt["writer"], "pbrt-v4")
        self.assertTrue(any("106.856895" in quirk["what"] for quirk in pbrt["quirks"]))
        self.assertTrue(any("65504" in quirk["what"] for quirk in pbrt["quirks"]))
        self.write_exr("art.exr", bands, attributes=[("fileCreatedBy", "ART 2.1"), ("commandLine", "artist x")])
        self.assertEqual(self.part("art.exr")["writer"], "ART")
        self.write_exr("plain.exr", bands)
        self.assertIsNone(self.part("plain.exr")["writer"])
        self.osiotool("convert", "plain.exr", "ours.exr")
        self.assertEqual(self.part("ours.exr")["writer"], "OpenSpectralIO")

    def test_the_exposure_that_divides_pbrts_constant_out(self):
        self.assertAlmostEqual(2 ** -6.7395, 1 / 106.856895, delta=2e-6)

    def test_problems_are_told_and_no_failure(self):
        self.write_exr("odd.exr", dict(self.bands([400, 410], prefix="S1"), **{"S0.550.5nm": np.zeros((5, 7))}))
        text = self.osiotool("audit", "odd.exr").stdout
        self.assertIn("problem: S1, S2 or S3 without S0: the intensity is missing", text)
        self.assertIn('problem: "S0.550.5nm" is no band', text)
        with open(self.path("no.exr"), "wb") as file:
            file.write(b"no image")
        result = self.osiotool("audit", "odd.exr", "no.exr", "--json", code=4)
        self.assertIn('"failure": "is no OpenEXR file', result.stdout)
        self.osiotool("audit", "none.exr", code=5)


if __name__ == "__main__":
    unittest.main()
