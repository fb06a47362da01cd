# SPDX-License-Identifier: Apache-2.0
"""The command line: what it says, what it refuses, what it leaves behind."""

import json
import os
import pty
import re
import resource
import select
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import COLORCHECKER, FLOAT, HALF, HOME, OSIOTOOL, OsioCase, oracle_xyz

GRID = list(range(400, 701, 10))
TO_RGB = ("--to", "lin_rec709", "--illuminant", "D65")


class Info(OsioCase):
    def test_json_has_the_documented_keys(self):
        channels = dict(self.bands(GRID), **self.bands([450, 550], prefix="S0", seed=2),
                        **{"T.400nm.500nm": np.ones((5, 7)), "R": np.ones((5, 7)), "A": np.ones((5, 7))})
        self.write_exr("a.exr", channels, types={n: HALF for n in channels}, origin=(1, 2),
                       full=(0, 0, 20, 30), attributes=[("spectralLayoutVersion", "1.0"),
                                                        ("emissiveUnits", "W.m^-2.sr^-1")])
        report = self.osiotool_json("info", "a.exr")
        self.assertEqual(report["file"], "a.exr")
        part, = report["parts"]
        self.assertEqual((part["width"], part["height"]), (7, 5))
        self.assertEqual(part["data_window"], [1, 2, 7, 6])
        self.assertEqual(part["display_window"], [0, 0, 19, 29])
        self.assertEqual(part["compression"], "zip")
        self.assertEqual(part["layout_version"], "1.0")
        self.assertEqual(part["channels"], len(channels))
        s0, t = part["sets"]
        self.assertEqual((s0["name"], s0["bands"], s0["quantity"], s0["wavelengths_nm"], s0["units"]),
                         ("S0", 2, "radiance", [450, 550], "W.m^-2.sr^-1"))
        self.assertEqual((t["name"], t["bands"], t["quantity"], t["wavelengths_nm"]),
                         ("T", 31, "reflectance", GRID))
        self.assertEqual((t["reradiation"], s0["reradiation"], t["units"]), (1, 0, None))
        self.assertEqual(t["spacing"], "400-700 nm every 10 nm")
        self.assertEqual(set(t["types"]), {"half"})
        self.assertEqual([c["name"] for c in part["other_channels"]], ["A", "R"])
        self.assertEqual(part["warnings"], [])

    def test_text_says_it_in_plain_words(self):
        self.write_exr("a.exr", dict(self.bands([400, 410, 430]), Z=np.ones((5, 7))))
        text = self.osiotool("info", "a.exr").stdout
        self.assertIn("set T: reflectance, 3 bands, 400-430 nm spaced 10 to 20 nm, float", text)
        self.assertIn("other channels: Z (float)", text)
        self.assertIn("warning: no spectralLayoutVersion", text)

    def test_files_without_bands_are_no_failure(self):
        self.write_exr("rgb.exr", {c: np.ones((2, 2)) for c in "RGB"})
        self.assertIn("no spectral bands", self.osiotool("info", "rgb.exr").stdout)
        self.assertEqual(self.osiotool_json("info", "rgb.exr")["parts"][0]["sets"], [])

    def test_several_parts_and_deep_ones(self):
        flat = oiio.ImageSpec(4, 4, 3, FLOAT)
        flat.channelnames = ("T.400nm", "T.500nm", "T.600nm")
        flat.attribute("oiio:subimagename", "bands")
        rgb = oiio.ImageSpec(4, 4, 3, FLOAT)
        rgb.attribute("oiio:subimagename", "beauty")
        output = oiio.ImageOutput.create("openexr")
        output.open(self.path("a.exr"), (rgb, flat))
        output.write_image(np.ones((4, 4, 3), np.float32))
        output.open(self.path("a.exr"), flat, "AppendSubimage")
        output.write_image(np.ones((4, 4, 3), np.float32))
        output.close()
        parts = self.osiotool_json("info", "a.exr")["parts"]
        self.assertEqual([p["name"] for p in parts], ["beauty", "bands"])
        self.assertEqual([len(p["sets"]) for p in parts], [0, 1])

        deep = oiio.ImageSpec(4, 4, 1, FLOAT)
        deep.deep = True
        deep.channelnames = ("T.500nm",)
        data = oiio.DeepData()
        data.init(16, 1, (oiio.TypeDesc(FLOAT),), ("T.500nm",))
        output = oiio.ImageOutput.create("openexr")
        output.open(self.path("deep.exr"), deep)
        self.assertTrue(output.write_deep_image(data), output.geterror())
        output.close()
        self.assertTrue(self.osiotool_json("info", "deep.exr")["parts"][0]["deep"])
        refused = self.osiotool("collapse", "deep.exr", "o.exr", "--to", "xyz", "--illuminant", "A", code=1)
        self.assertIn("is deep (several samples a pixel)", refused.stderr)

    def test_strange_names_are_told(self):
        names = ("S0.R", "S0.550.5nm", "T.400", "s0.400nm", "S4.500nm", "T.500nm")
        self.write_exr("a.exr", {n: np.ones((2, 2)) for n in names})
        part, = self.osiotool_json("info", "a.exr")["parts"]
        self.assertEqual([(s["name"], s["bands"]) for s in part["sets"]], [("T", 1)])
        self.assertIn('"S0.550.5nm", "T.400" are no band', " ".join(part["warnings"]))


class Plan(OsioCase):
    def test_json_reproduces_the_collapse(self):
        bands = self.bands([700, 400, 1000, 550.5, 450])
        self.write_exr("a.exr", bands)
        plan = self.osiotool_json("plan", "a.exr", "--to", "acescg", "--illuminant", "FL11",
                                  "--exposure", "1.5")
        self.assertEqual(plan["wavelengths_nm"], [400, 450, 550.5, 700, 1000])
        self.assertEqual(plan["channels"], ["T.400nm", "T.450nm", "T.550,5nm", "T.700nm", "T.1000nm"])
        self.assertEqual(plan["outputs"], ["R", "G", "B"])
        values = np.stack([bands[c] for c in plan["channels"]], -1).astype(np.float64)
        self.osiotool("collapse", "a.exr", "o.exr", "--to", "acescg", "--illuminant", "FL11",
                      "--exposure", "1.5", "--quiet")
        pixels = self.read("o.exr")[1]
        expected = values @ np.array(plan["weights"]).T
        self.assertLessEqual(np.abs(pixels - expected).max(), 6e-8 * np.abs(expected).max())
        self.assertEqual((plan["to"], plan["illuminant"], plan["observer"], plan["basis"]),
                         ("acescg", "FL11", "cie1931", "linear"))
        spec, _ = self.read("o.exr")
        self.assertEqual(spec.get_string_attribute("spectral:plan"), plan["id"])
        self.assertEqual(spec.get_string_attribute("spectral:recipe"), plan["recipe"])

    def test_weights_are_those_of_numpy(self):
        for prefix, light in (("T", "A"), ("S0", None)):
            self.write_exr("a.exr", self.bands(GRID, prefix=prefix))
            words = ("--illuminant", light) if light else ()
            for observer in ("cie1931", "cie1964"):
                for hold in (True, False):
                    plan = self.osiotool_json("plan", "a.exr", "--to", "xyz", *words, "--observer", observer, "--basis", "linear",
                                              "--extrapolate", "hold" if hold else "zero")
                    error = np.abs(np.array(plan["weights"]) - oracle_xyz(GRID, light, observer, hold)).max()
                    self.assertLessEqual(error, 1e-15)
                    self.assertEqual(plan["outputs"], ["X", "Y", "Z"])

    def test_text_names_every_source_and_share(self):
        self.write_exr("a.exr", self.bands(range(420, 661, 10)))
        text = self.osiotool("plan", "a.exr", *TO_RGB).stdout
        for words in ("recipe       to=lin_rec709&illuminant=D65", "CIE 15:2018 D65 table",
                      "CIE 1931 2 degree standard colorimetric observer", "sprague basis, CIE 15 sum at 1 nm",
                      "reflectance counts as samples",
                      "extrapolated R", "T.420nm", "bradford from XYZ"):
            self.assertIn(words, text)

    def test_much_extrapolation_is_a_warning_by_output(self):
        self.write_exr("a.exr", self.bands(range(480, 601, 10), prefix="S0"))
        plan = self.osiotool_json("plan", "a.exr", "--to", "xyz")
        self.assertGreater(max(plan["extrapolated_share"]), 0.05)
        self.assertIn("much of the weight rests on it, X ", plan["warnings"][0])
        self.write_exr("b.exr", self.bands(range(360, 831, 10), prefix="S0"))
        self.assertEqual(self.osiotool_json("plan", "b.exr", "--to", "xyz")["warnings"], [])


class Collapse(OsioCase):
    def setUp(self):
        super().setUp()
        self.values = dict(self.bands(GRID), A=np.full((5, 7), 0.5))
        self.write_exr("a.exr", self.values, origin=(3, -2), full=(0, 0, 64, 48),
                       attributes=[("smpte:TimeCode", oiio.TypeTimeCode, (1, 2)), ("PixelAspectRatio", 2.0),
                                   ("owner", "me"), ("spectralLayoutVersion", "1.0")])

    def test_exr_output_is_float_zip_with_all_that_is_known(self):
        self.osiotool("collapse", "a.exr", "o.exr", *TO_RGB)
        self.assertEqual(set(self.exr_channels("o.exr").values()), {"32-bit floating-point"})
        spec, pixels = self.read("o.exr")
        self.assertEqual(spec.channelnames, ("R", "G", "B", "A"))
        self.assertTrue((pixels[..., 3] == 0.5).all())
        self.assertEqual((spec.x, spec.y, spec.full_width, spec.full_height), (3, -2, 64, 48))
        self.assertEqual(spec.get_string_attribute("compression"), "zip")
        self.assertEqual(spec.get_string_attribute("Copyright"), "me")
        self.assertEqual(spec.get_float_attribute("PixelAspectRatio"), 2.0)
        self.assertEqual(spec.getattribute("smpte:TimeCode"), self.read("a.exr")[0].getattribute("smpte:TimeCode"))
        self.assertEqual(spec.get_string_attribute("oiio:ColorSpace"), "lin_rec709")
        self.assertAlmostEqual(spec.getattribute("chromaticities")[0], 0.64, 6)
        self.assertFalse(spec.get_string_attribute("spectralLayoutVersion"))

    def test_options_of_the_output(self):
        self.osiotool("collapse", "a.exr", "o.exr", *TO_RGB, "-d", "half", "--compression", "piz")
        self.assertEqual(set(self.exr_channels("o.exr").values()), {"16-bit floating-point"})
        self.assertEqual(self.read("o.exr")[0].get_string_attribute("compression"), "piz")
        self.osiotool("collapse", "a.exr", "o.exr", "--to", "xyz", "--illuminant", "A", "--names", "xyz")
        self.assertEqual(set(self.exr_channels("o.exr")), {"X", "Y", "Z", "A"})

    def test_any_number_of_threads_gives_the_same_bytes(self):
        self.write_exr("big.exr", self.bands(GRID, shape=(200, 100)))
        outputs = []
        for threads in (1, 2, 3, 8):
            self.osiotool("collapse", "big.exr", "o.exr", *TO_RGB, "--threads", threads)
            with open(self.path("o.exr"), "rb") as file:
                outputs.append(file.read())
        self.assertEqual(len(set(outputs)), 1)

    def test_integers_need_a_curve(self):
        for depth in ("uint8", "uint16"):
            refused = self.osiotool("collapse", "a.exr", "o.tif", *TO_RGB, "-d", depth, code=2)
            self.assertIn("has too few steps for it in the shadows; use --to srgb, -d half, or --raw",
                          refused.stderr)
            self.osiotool("collapse", "a.exr", "o.tif", *TO_RGB, "-d", depth, "--raw")
            self.assertEqual(str(self.read("o.tif")[0].format), depth)
        refused = self.osiotool("collapse", "a.exr", "o.png", *TO_RGB, code=2)
        self.assertIn("png stores uint8, not float", refused.stderr)
        self.osiotool("collapse", "a.exr", "o.png", "--to", "srgb", "--illuminant", "D65")
        self.assertEqual(self.files(), ["a.exr", "o.png", "o.tif"])

    def test_png_is_the_encoded_colour(self):
        os.remove(self.path("a.exr"))
        del self.values["A"]
        self.write_exr("a.exr", self.values)
        self.osiotool("collapse", "a.exr", "o.exr", "--to", "srgb", "--illuminant", "D65")
        self.osiotool("collapse", "a.exr", "o.png", "--to", "srgb", "--illuminant", "D65")
        exact = np.clip(self.read("o.exr")[1], 0, 1)
        self.assertLessEqual(np.abs(self.read("o.png")[1] - exact).max(), 0.5 / 255 + 1e-6)
        self.osiotool("collapse", "a.exr", "o16.png", "--to", "srgb", "--illuminant", "D65", "-d", "uint16")
        self.assertLessEqual(np.abs(self.read("o16.png")[1] - exact).max(), 0.5 / 65535 + 1e-7)

    def test_windows_are_placed_as_oiiotool_places_them(self):
        srgb = ("--to", "srgb", "--illuminant", "D65", "-d", "uint8")
        for origin, full in (((1, 2), (0, 0, 20, 30)), ((-3, -1), (0, 0, 4, 3)), ((0, 0), (2, 1, 3, 3))):
            self.write_exr("w.exr", self.bands(GRID), origin=origin, full=full)
            self.osiotool("collapse", "w.exr", "w_srgb.exr", "--to", "srgb", "--illuminant", "D65")
            for ending in ("png", "tif", "jpg"):
                self.osiotool("collapse", "w.exr", f"ours.{ending}", *srgb)
                self.check("oiiotool", "w_srgb.exr", "-d", "uint8", "-o", f"theirs.{ending}")
                ours, theirs = self.read(f"ours.{ending}"), self.read(f"theirs.{ending}")
                case = (origin, full, ending)
                self.assertEqual((ours[0].width, ours[0].height), (theirs[0].width, theirs[0].height), case)
                self.assertLessEqual(np.abs(ours[1] - theirs[1]).max(), 1.01 / 255, case)

    def test_every_kind_of_file_is_whole_or_refused(self):
        self.write_exr("a.exr", self.values)
        for ending in ("png", "tif", "tga", "bmp", "ppm", "jpg", "webp", "dpx", "hdr", "sgi", "jp2", "gif",
                       "rla", "zfile", "iff", "fits", "psd", "ico", "heic"):
            name = f"o.{ending}"
            result = self.run_program(OSIOTOOL, "collapse", "a.exr", name, "--to", "srgb", "--illuminant", "D65",
                                      "-d", "float" if ending == "hdr" else "uint8", "--quiet")
            if result.returncode == 0:
                self.assertEqual(self.read(name)[1].shape[:2], (5, 7), ending)
            else:
                self.assertIn(result.returncode, (2, 5), ending + result.stderr)
                self.assertIn(name, result.stderr)
                self.assertNotIn(name, self.files())

    def test_clipped_clamped_nan_and_negative_pixels_are_counted(self):
        bands = self.bands(GRID, prefix="S0")
        for name in bands:
            bands[name][0, 0] = 1e6
            bands[name][1, 1] = -1
        bands["S0.500nm"][2, 2] = np.nan
        self.write_exr("s.exr", bands)
        half = self.osiotool_json("collapse", "s.exr", "o.exr", "--to", "xyz", "-d", "half")
        self.assertEqual((half["nan_pixels"], half["negative_pixels"], half["clamped_samples"]), (1, 1, 3))
        _, pixels = self.read("o.exr")
        self.assertTrue((pixels[0, 0] == 65504).all())
        self.assertTrue(np.isnan(pixels[2, 2]).all())
        png = self.osiotool_json("collapse", "s.exr", "o.png", "--to", "srgb")
        self.assertGreaterEqual(png["clipped_pixels"], 2)
        text = self.osiotool("collapse", "s.exr", "o.exr", "--to", "xyz", "-d", "half").stderr
        self.assertIn("note: 1 of 35 pixels hold NaN", text)
        self.assertIn("note: 3 samples beyond +-65504 were written as +-65504", text)

    def test_memory_does_not_grow_with_the_image(self):
        if "san" in os.environ.get("LD_PRELOAD", ""):
            self.skipTest("a sanitizer has memory of its own")
        width, workers = 480, 2
        for compression, lines, types in (("zip", 16, HALF), ("none", 1, FLOAT), ("piz", 32, HALF)):
            chunk_mb = width * lines * len(GRID) * (2 if types == HALF else 4) / 1e6
            bound = 24 + workers * 3 * chunk_mb
            for rows in (64, 3072):
                spectra = np.linspace(0, 1, rows * width, dtype=np.float32).reshape(rows, width)
                self.write_exr("big.exr", {f"T.{nm}nm": spectra for nm in GRID}, types=types, compression=compression)
                peak = self.peak_mb(OSIOTOOL, "collapse", "big.exr", "o.exr", *TO_RGB, "-d", "half", "--threads", workers)
                print(f"{compression}, {rows} rows: {peak:.1f} MB, at most {bound:.1f}")
                self.assertLess(peak, bound, (compression, rows))

    def test_quiet_is_quiet_and_json_is_json(self):
        quiet = self.osiotool("collapse", "a.exr", "o.exr", *TO_RGB, "--quiet")
        self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))
        report = self.osiotool_json("collapse", "a.exr", "o.exr", *TO_RGB, "--quiet")
        self.assertEqual((report["output"], report["type"], report["pixels"]), ("o.exr", "float", 35))
        self.assertEqual(report["channel_names"], ["R", "G", "B", "A"])

    def test_input_and_output_may_be_the_same_file(self):
        self.osiotool("collapse", "a.exr", "o.exr", *TO_RGB)
        self.osiotool("collapse", "a.exr", "a.exr", *TO_RGB)
        self.assertTrue(np.array_equal(self.read("a.exr")[1], self.read("o.exr")[1]))

    def test_every_output_space_and_white(self):
        _, xyz = self.collapse("--to", "xyz", "--illuminant", "D65")
        for to in ("xyz_d65", "lin_p3d65", "lin_rec2020", "acescg", "aces2065_1", "srgb", "ACES2065-1"):
            self.collapse("--to", to, "--illuminant", "D65")
        _, named = self.collapse("--to", "xyz_d65", "--illuminant", "A", "--white", "A")
        _, own = self.collapse("--to", "xyz_d65", "--illuminant", "A")
        self.assertTrue(np.array_equal(named, own))
        _, kept = self.collapse("--to", "xyz_d65", "--illuminant", "A", "--white", "0.3127,0.3290")
        _, plain = self.collapse("--to", "xyz", "--illuminant", "A")
        self.assertTrue(np.array_equal(kept, plain))
        self.assertTrue(xyz.any())

    def collapse(self, *words):
        self.osiotool("collapse", "a.exr", "o.exr", "--quiet", *words)
        return self.read("o.exr")

    def test_a_light_of_the_user(self):
        with open(self.path("flat.csv"), "w") as table:
            table.write("# equal energy\nnm,value\n360,7\n830,7\n")
        _, mine = self.collapse("--to", "xyz", "--illuminant", "flat.csv")
        _, theirs = self.collapse("--to", "xyz", "--illuminant", "E")
        self.assertTrue(np.array_equal(mine, theirs))


class Refusals(OsioCase):
    """Exit codes, words, and nothing left behind."""

    def setUp(self):
        super().setUp()
        self.write_exr("t.exr", self.bands(GRID))
        self.write_exr("s.exr", self.bands(GRID, prefix="S0"))
        self.write_exr("both.exr", dict(self.bands(GRID), **self.bands(GRID, prefix="S0")))
        self.write_exr("rgb.exr", {c: np.ones((2, 2)) for c in "RGB"})
        self.write_exr("uv.exr", self.bands([200, 300, 350], prefix="S0"))
        self.before = self.files()

    def refuse(self, code, words, *arguments):
        result = self.osiotool(*arguments, code=code)
        self.assertIn(words, result.stderr)
        self.assertEqual(result.stdout, "")
        # Other people's libraries may have their say first.
        self.assertTrue(result.stderr.splitlines()[-1].startswith("osiotool: "), result.stderr)
        self.assertEqual(self.files(), self.before)

    def test_requests_that_do_not_fit_the_file(self):
        for words, arguments in (
                ("t.exr: set T is a reflectance, which has no colour without a light; name one with "
                 "illuminant=D65", ("t.exr", "--to", "xyz")),
                ("s.exr: set S0 is a radiance, which already holds its light",
                 ("s.exr", "--to", "xyz", "--illuminant", "D65")),
                ("several sets of bands fit: S0, T", ("both.exr", "--to", "xyz")),
                ("there is no set \"S1\"; found S0, T", ("both.exr", "--to", "xyz", "--set", "S1")),
                ("there is no part \"3\"; the file has part 0", ("t.exr", *TO_RGB, "--part", "3")),
                ("nothing of the 360-830 nm that an observer sees", ("uv.exr", "--to", "xyz"))):
            self.refuse(1, words, "collapse", arguments[0], "o.exr", *arguments[1:])
            self.refuse(1, words, "plan", *arguments)

    def test_usage_and_unknown_names(self):
        for words, arguments in (
                ("no illuminant is called \"D66\"", ("t.exr", "--to", "xyz", "--illuminant", "D66")),
                ("did you mean \"lin_rec709\"?", ("t.exr", "--to", "lin_rec790", "--illuminant", "A")),
                ("no space to collapse to was named", ("t.exr", "--illuminant", "A")),
                ("names=xyz does not fit to=lin_rec709", ("t.exr", *TO_RGB, "--names", "xyz")),
                ("observer is called \"cie1932\"; did you mean \"cie1931\"?",
                 ("t.exr", *TO_RGB, "--observer", "cie1932"))):
            self.refuse(2, words, "collapse", arguments[0], "o.exr", *arguments[1:])
        self.refuse(2, "did you mean \"collapse\"?", "colapse", "t.exr", "o.exr")
        self.refuse(2, "did you mean \"--illuminant\"?", "collapse", "t.exr", "o.exr", "--iluminant=A")
        self.refuse(2, "there is no list of \"lights\"", "list", "lights")
        self.refuse(2, "no compression is called \"zpi\"; did you mean \"zip\"?", "collapse", "t.exr", "o.exr",
                    *TO_RGB, "--compression", "zpi")
        self.refuse(2, "there is no depth \"flaot\"; did you mean \"float\"?", "collapse", "t.exr", "o.exr",
                    *TO_RGB, "-d", "flaot")
        self.refuse(2, "an .exr stores half or float, not uint8", "collapse", "t.exr", "o.exr", *TO_RGB,
                    "-d", "uint8")
        self.refuse(2, "no file format is known by the ending", "collapse", "t.exr", "o.nonsense", *TO_RGB)
        self.refuse(2, "", "collapse", "t.exr")
        self.refuse(2, "", "info")

    def test_damaged_or_not_spectral(self):
        with open(self.path("text.exr"), "w") as file:
            file.write("no image")
        with open(self.path("t.exr"), "rb") as file:
            data = file.read()
        with open(self.path("cut.exr"), "wb") as file:
            file.write(data[:len(data) * 2 // 3])
        self.before = self.files()
        self.refuse(4, "no spectral band among 3 channels", "collapse", "rgb.exr", "o.exr", "--to", "xyz")
        self.refuse(4, "is no OpenEXR file", "collapse", "text.exr", "o.exr", "--to", "xyz")
        self.refuse(4, "cut.exr", "collapse", "cut.exr", "o.exr", *TO_RGB)
        self.refuse(4, "cut.exr", "collapse", "cut.exr", "o.png", "--to", "srgb", "--illuminant", "A")

    def test_the_system_refuses(self):
        self.refuse(5, "No such file or directory", "info", "none.exr")
        self.refuse(5, "is a folder", "info", ".")
        self.refuse(5, "lamp.csv: No such file or directory", "collapse", "t.exr", "o.exr", "--to", "xyz",
                    "--illuminant", "lamp.csv")
        self.refuse(5, "cannot be written", "collapse", "t.exr", "no/such/o.exr", *TO_RGB)
        self.refuse(5, "cannot be written", "collapse", "t.exr", "no/such/o.png", "--to", "srgb",
                    "--illuminant", "A")
        os.mkfifo(self.path("pipe.exr"))
        self.before = self.files()
        self.refuse(5, "is not an ordinary file and is left alone", "collapse", "t.exr", "pipe.exr", *TO_RGB)

    def test_bad_tables_of_the_user(self):
        for text, words in (("400,1\n500,x\n", "lamp.csv: line 2: found \"500,x\", expected two numbers"),
                            ("500,1\n400,1\n", "line 2: 400 nm follows 500 nm"),
                            ("0.4,1\n0.7,1\n", "look like micrometres"), ("", "no line with a wavelength"),
                            ("400,1\n500,-2\n", "is negative"), ("900,1\n950,1\n", "no power at any")):
            with open(self.path("lamp.csv"), "w") as table:
                table.write(text)
            self.before = self.files()
            self.refuse(2, words, "collapse", "t.exr", "o.exr", "--to", "xyz", "--illuminant", "lamp.csv")


class Process(OsioCase):
    """Signals, disks, terminals, libraries."""

    def big(self):
        self.write_exr("big.exr", self.bands(GRID, shape=(1500, 1500)), compression="zips")

    def test_interrupts_leave_nothing(self):
        self.big()
        with open(self.path("o.exr"), "w") as file:
            file.write("old")
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([OSIOTOOL, "collapse", "big.exr", "o.exr", "--to", "srgb",
                                        "--illuminant", "A", "--threads", "1"], cwd=self.folder,
                                       stderr=subprocess.PIPE, text=True)
            deadline = time.time() + 20
            while len(self.files()) < 3 and time.time() < deadline:  # until the temporary appears
                time.sleep(0.002)
            process.send_signal(number)
            _, stderr = process.communicate(timeout=30)
            self.assertEqual(process.returncode, 130, stderr)
            self.assertIn("interrupted", stderr)
            self.assertEqual(self.files(), ["big.exr", "o.exr"])
            with open(self.path("o.exr")) as file:
                self.assertEqual(file.read(), "old")

    def test_a_full_disk_is_an_error_and_leaves_the_old_file(self):
        self.write_exr("a.exr", self.bands(GRID, shape=(64, 64)))
        with open(self.path("o.exr"), "w") as file:
            file.write("old")

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        for output in ("o.exr", "o.png", "o.tif", "o.jpg", "o.tga"):
            to = "lin_rec709" if output == "o.exr" else "srgb"
            result = self.osiotool("collapse", "a.exr", output, "--to", to, "--illuminant", "A", code=5,
                                   preexec_fn=limit)
            self.assertIn("cannot be written", result.stderr, output)
            self.assertEqual(self.files(), ["a.exr", "o.exr"])
        with open(self.path("o.exr")) as file:
            self.assertEqual(file.read(), "old")

    def test_a_bar_on_a_terminal_only(self):
        self.big()
        command = [OSIOTOOL, "collapse", "big.exr", "o.exr", "--to", "srgb", "--illuminant", "A", "--threads",
                   "1"]
        piped = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertNotIn("\r", piped.stderr)
        for quiet in (False, True):
            main, terminal = pty.openpty()
            process = subprocess.Popen(command + (["--quiet"] if quiet else []), cwd=self.folder,
                                       stderr=terminal, stdout=terminal)
            os.close(terminal)
            shown = b""
            while True:
                if select.select([main], [], [], 30)[0]:
                    try:
                        piece = os.read(main, 4096)
                    except OSError:
                        break
                    if not piece:
                        break
                    shown += piece
            os.close(main)
            self.assertEqual(process.wait(), 0)
            self.assertEqual(b"%" in shown and b"[##" in shown, not quiet, shown)

    def test_openimageio_is_not_linked(self):
        libraries = self.check("ldd", OSIOTOOL)
        self.assertIn("libOpenEXR", libraries)
        self.assertNotIn("OpenImageIO", libraries)
        self.assertNotIn("opencv", libraries)

    def test_exr_work_opens_no_openimageio(self):
        self.write_exr("a.exr", self.bands(GRID))
        if not shutil.which("strace"):
            env = {"LD_DEBUG": "files"}
            trace = self.osiotool("collapse", "a.exr", "o.exr", *TO_RGB, env=env).stderr
            self.assertIn("libOpenEXR", trace)
            self.assertNotIn("libOpenImageIO", trace)

    def test_without_the_module_exr_still_works_and_the_rest_says_why(self):
        os.makedirs(self.path("alone/bin"))
        shutil.copy(OSIOTOOL, self.path("alone/bin/osiotool"))
        self.write_exr("a.exr", self.bands(GRID))
        tool = self.path("alone/bin/osiotool")
        self.check(tool, "collapse", "a.exr", "o.exr", *TO_RGB)
        for arguments in (("collapse", "a.exr", "o.png", "--to", "srgb", "--illuminant", "A"), ("doctor",)):
            result = self.run_program(tool, *arguments)
            self.assertEqual(result.returncode, 5)
            self.assertIn("OpenImageIO cannot be used", result.stderr)

    def test_version_help_and_lists(self):
        self.assertRegex(self.osiotool("--version").stdout, r"^osiotool \d+\.\d+\.\d+ \(OpenEXR 3\.")
        self.assertIn("collapse", self.osiotool("--help").stdout)
        self.assertIn("--illuminant", self.osiotool("collapse", "--help").stdout)
        for what, name in (("illuminants", "LED-B3"), ("observers", "cie1964"), ("spaces", "lin_rec709"),
                           ("bases", "linear")):
            self.assertIn(name, self.osiotool("list", what).stdout)
        lights = self.osiotool("list", "illuminants").stdout
        for light in ("E", "A", "C", "D50", "D55", "D65", "D75", "FL2", "FL11", "LED-B3"):
            self.assertRegex(lights, rf"(?m)^{re.escape(light)} ")
        self.assertEqual(self.run_program(OSIOTOOL).returncode, 2)


class Doctor(OsioCase):
    FOLDER = os.environ["OIIO_LIBRARY_PATH"].split(":")[0]

    def doctor(self, code, **env):
        return self.osiotool("doctor", code=code, env=dict({"OPENIMAGEIO_PLUGIN_PATH": ""}, **env)).stdout

    def test_a_healthy_installation(self):
        text = self.doctor(0)
        self.assertRegex(text, r"ok: +OpenImageIO 2\.4")
        self.assertIn("OpenImageIO sees the plugin", text)
        self.assertIn("(OpenSpectralIO ", text)

    def test_no_path_set(self):
        text = self.doctor(1, OIIO_LIBRARY_PATH="")
        self.assertIn("OpenImageIO does not see the plugin", text)
        self.assertIn("OIIO_LIBRARY_PATH is not set", text)
        self.assertIn("to use it: export OIIO_LIBRARY_PATH=", text)

    def test_a_path_without_the_plugin(self):
        self.assertIn("no spectralexr.imageio.so that it can load in " + self.folder,
                      self.doctor(1, OIIO_LIBRARY_PATH=self.folder))

    def test_a_file_that_is_no_library(self):
        with open(self.path("spectralexr.imageio.so"), "w") as file:
            file.write("not a library")
        text = self.doctor(1, OIIO_LIBRARY_PATH=self.folder)
        self.assertIn("spectralexr.imageio.so is passed over: the system cannot load it", text)

    def test_a_plugin_of_another_version_is_passed_over(self):
        source = self.path("old.c")
        with open(source, "w") as file:
            file.write("int spectralexr_imageio_version = 7;\n")
        self.check("cc", "-shared", "-fPIC", source, "-o", self.path("spectralexr.imageio.so"))
        words = "is passed over: it was built for plugin version 7 of OpenImageIO"
        self.assertIn(words, self.doctor(1, OIIO_LIBRARY_PATH=self.folder))
        text = self.doctor(0, OIIO_LIBRARY_PATH=self.folder + ":" + self.FOLDER)
        self.assertIn(words, text)
        self.assertIn("sees the plugin " + self.FOLDER, text)

    def test_readers_are_not_tried_on_queries(self):
        text = self.doctor(1, OPENIMAGEIO_OPTIONS="try_all_readers=0")
        self.assertIn("try_all_readers is 0", text)


if __name__ == "__main__":
    unittest.main()
