# SPDX-License-Identifier: Apache-2.0
"""osiotool reduce: what it says of the smaller file is what other code finds there, and what it cannot say it refuses."""

import json
import os
import re
import shutil
import unittest

import numpy as np
from osio_case import FLOAT, HALF, OsioCase, format_comma
from test_metrics import ciede2000, lab

GRID = list(range(380, 781, 5))
SHAPE = (48, 64)
LIGHTS = ("D65", "A", "FL11", "LED-B3")
FOUR = ("--lights", ",".join(LIGHTS))


def smooth(nm=GRID, shape=SHAPE, noise=0, prefix="T"):
    """{channel: plane} of spectra that change smoothly, with noise as a share of them."""
    random = np.random.default_rng(5)
    x = np.linspace(0, 1, shape[1])[None, :, None]
    y = np.linspace(0, 1, shape[0])[:, None, None]
    band = np.linspace(0, 1, len(nm))[None, None, :]
    cube = 0.45 + 0.3 * np.sin(6 * (band + x)) * np.cos(5 * (y - band))
    cube = np.clip(cube * (1 + random.normal(0, noise, cube.shape)), 0, None)
    return {f"{prefix}.{format_comma(n)}nm": cube[..., i].astype(np.float32) for i, n in enumerate(nm)}


class Reduce(OsioCase):
    def reduce(self, source, *options, out="r.spexr"):
        return self.osiotool_json("reduce", source, out, "--quiet", *options)

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def attribute(self, name="r.spexr"):
        spec, _ = self.read(name)
        return json.loads(spec.getattribute("spectral:reduction"))

    def pixels(self, name):
        """Bands in order of wavelength, doubles."""
        channels = self.channels_of(name)
        bands = sorted((float(re.sub(r"^\w+\.|nm$", "", n).replace(",", ".")), n) for n in channels if n.endswith("nm"))
        return np.stack([channels[n] for _, n in bands], axis=-1).astype(np.float64)

    def differences(self, a, b, *words):
        """CIEDE2000 of every pixel, by other code: sums in double, a formula of the tests'."""
        xyz, white = [], None
        for name in (a, b):
            plan = self.osiotool_json("plan", name, "--to", "xyz", *words)
            xyz.append(self.pixels(name) @ np.array(plan["weights"]).T)
            white = np.array(plan["white"]) if white is None else white
        return ciede2000(lab(xyz[0], white), lab(xyz[1], white))

    def holds(self, source, report, out="r.spexr"):
        """Every demand of a report, measured by `difference` and by other code."""
        for demand in report["demands"]:
            words = ("--observer", demand["observer"]) + (("--illuminant", demand["light"]) if demand["light"] else ())
            self.assertLessEqual(demand["delta_e_max"], report["max_delta_e"])
            if demand["light"]:
                told = self.osiotool_json("difference", source, out, *words)
                self.assertAlmostEqual(demand["delta_e_max"], told["max"], delta=1e-6)
                self.assertAlmostEqual(demand["delta_e_mean"], told["mean"], delta=1e-6)
                found = self.differences(source, out, *words)
                self.assertAlmostEqual(demand["delta_e_max"], found.max(), delta=1e-4)

    def test_what_it_says_is_what_is_there(self):
        for noise in (0, 0.02):
            self.write_exr("a.exr", smooth(noise=noise))
            report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5")
            self.assertEqual([d["light"] for d in report["demands"]], list(LIGHTS))
            self.assertLess(report["bands"], 14)
            self.assertEqual((report["samples"], report["pixels"]), ("half", SHAPE[0] * SHAPE[1]))
            self.assertEqual(report["bytes"], os.path.getsize(self.path("r.spexr")))
            self.assertEqual(report["source_bytes"], os.path.getsize(self.path("a.exr")))
            self.holds("a.exr", report)

    def test_the_attribute_is_the_report(self):
        self.write_exr("a.exr", smooth())
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "1")
        attribute = self.attribute()
        self.assertEqual(attribute, {key: value for key, value in report.items() if key in attribute})
        self.assertEqual(set(report) - set(attribute),
                         {"output", "bytes", "width", "height", "passes", "seconds", "warnings"})
        spec, _ = self.read("r.spexr")
        edges = [float(e) for e in spec.getattribute("spectral:binEdges").split(";")]
        self.assertEqual(edges, report["edges_nm"])
        self.assertEqual(spec.getattribute("spectral:basis"), "bins")
        self.assertEqual(report["wavelengths_nm"], [(a + b) / 2 for a, b in zip(edges, edges[1:])])
        self.assertEqual(report["not_for"],
                         [o["light"] for o in report["others"] if o["delta_e_max"] > report["max_delta_e"]])
        plan = self.osiotool_json("plan", "r.spexr", "--to", "xyz", "--illuminant", "A")
        self.assertEqual(plan["basis"], "bins")

    def test_other_lights_are_warned_of(self):
        self.write_exr("a.exr", smooth())
        report = self.reduce("a.exr", "--lights", "D65", "--max-delta-e", "0.5")
        self.assertLess(report["bands"], self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5", out="four.exr")["bands"] + 1)
        self.assertIn("FL11", report["not_for"])
        told = self.osiotool_json("difference", "a.exr", "r.spexr", "--illuminant", "FL11")
        other = next(o for o in report["others"] if o["light"] == "FL11")
        self.assertGreater(told["max"], 0.5)
        self.assertLessEqual(other["delta_e_max"], told["max"] + 1e-6)
        text = self.osiotool("reduce", "a.exr", "r.spexr", "--lights", "D65", "--max-delta-e", "0.5").stderr
        self.assertRegex(text, r"must not be used under .*FL11")

    def test_standard_readers_open_it(self):
        self.write_exr("a.exr", smooth())
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5", out="r.exr")
        self.assertIn(f"{report['bands']} channel, half openexr", self.check("iinfo", "r.exr"))
        self.check("oiiotool", "r.exr", "--stats", env={"OIIO_LIBRARY_PATH": ""})
        self.assertEqual(set(self.exr_channels("r.exr").values()), {"16-bit floating-point"})
        self.assertIn("reflectance", self.osiotool("info", "r.exr").stdout)
        self.osiotool("verify", "r.exr")
        self.both("r.exr", to="lin_rec709", illuminant="FL11")

    def test_workers_and_compressions_change_no_sample(self):
        self.write_exr("a.exr", smooth(noise=0.02))
        words = ("reduce", "a.exr")
        for name, options in (("1.exr", ("--threads", "1")), ("2.exr", ("--threads", "3"))):
            self.osiotool(*words, name, *FOUR, "--max-delta-e", "0.3", "--quiet", *options)
        one, two = (self.bytes_of(name) for name in ("1.exr", "2.exr"))
        self.assertEqual(one, two)
        for compression in ("none", "rle", "zips", "zip", "piz"):
            report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.3", "--compression", compression)
            self.assertEqual(report["compression"], compression)
            self.assertTrue(np.array_equal(self.pixels("r.spexr"), self.pixels("1.exr")))
        self.osiotool(*words, "r.spexr", *FOUR, "--max-delta-e", "0.3", "--compression", "dwaa", code=1)
        self.osiotool(*words, "r.spexr", *FOUR, "--max-delta-e", "0.3", "--compression", "best", code=2)

    def test_a_rare_pixel_counts(self):
        image = smooth(shape=(64, 64))
        for name, plane in image.items():
            nm = float(name[2:-2].replace(",", "."))
            plane[37, 21] = 0.02 + 0.9 * (488 < nm < 503)
        self.write_exr("a.exr", image, compression="zips")
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5")
        self.assertGreater(report["passes"], 1)
        self.holds("a.exr", report)

    def test_what_is_not_negative_stays_so(self):
        image = smooth(noise=0.02)
        for i, plane in enumerate(image.values()):
            plane[10:20] = 0.9 * (20 < i < 24)  # a sharp line on black
        self.write_exr("a.exr", image)
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "1")
        self.assertGreaterEqual(self.pixels("r.spexr").min(), 0)
        self.assertGreater(report["changed_pixels"], 0)
        self.assertEqual(report["negative_samples"], 0)
        self.holds("a.exr", report)
        for plane in image.values():
            plane[0, :4] -= 0.6
        self.write_exr("b.exr", image)
        report = self.reduce("b.exr", *FOUR, "--max-delta-e", "1")
        self.assertEqual(report["negative_samples"], np.count_nonzero(self.pixels("r.spexr") < 0))
        self.assertGreater(report["negative_samples"], 0)
        self.holds("b.exr", report)

    def test_pixels_without_colour_are_counted_and_stay_so(self):
        image = smooth()
        image["T.500nm"][3, 5] = np.nan
        image["T.550nm"][40, 60] = np.inf
        self.write_exr("a.exr", image)
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5")
        self.assertEqual({d["undefined_pixels"] for d in report["demands"]}, {2})
        undefined = ~np.isfinite(self.pixels("r.spexr")).all(axis=-1)
        self.assertEqual([tuple(p) for p in np.argwhere(undefined)], [(3, 5), (40, 60)])

    def test_radiance_for_observers(self):
        self.write_exr("s.exr", {name: 30 * plane for name, plane in smooth(prefix="S0").items()})
        both = ("--observers", "cie1931,cie1964")
        report = self.reduce("s.exr", *both, "--max-delta-e", "0.5")
        self.assertEqual([(d["light"], d["observer"]) for d in report["demands"]], [("", "cie1931"), ("", "cie1964")])
        self.assertEqual(report["white_luminance_from"], "the 99th percentile of Y")
        spec, _ = self.read("r.spexr")
        self.assertEqual(spec.getattribute("emissiveUnits"), "W.m^-2.sr^-1")
        self.assertTrue(all(n.startswith("S0.") for n in spec.channelnames))
        self.assertLessEqual(report["bands"], 8)
        # White at the 99th percentile of Y: the differences of colours that are scaled by it.
        for demand in report["demands"]:
            words = ("--to", "xyz", "--observer", demand["observer"])
            sums = [self.pixels(n) @ np.array(self.osiotool_json("plan", n, *words)["weights"]).T for n in ("s.exr", "r.spexr")]
            white = np.array(self.osiotool_json("plan", "s.exr", *words)["white"])
            at = np.sort(sums[0][..., 1].ravel())[int(np.ceil(0.99 * sums[0][..., 1].size)) - 1]
            self.assertLess(ciede2000(*(lab(s / at, white) for s in sums)).max(), 0.5 + 1e-3)

    def test_alpha_passes_and_the_rest_is_lost_aloud(self):
        image = smooth()
        random = np.random.default_rng(2)
        alpha = random.uniform(0, 1, SHAPE).astype(np.float32)
        self.write_exr("a.exr", dict(image, A=alpha, R=alpha, G=alpha, B=alpha, Z=alpha),
                       attributes=[("studio", "somewhere"), ("spectral:fwhm", "5")])
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5")
        self.assertTrue(np.array_equal(self.channels_of("r.spexr")["A"], alpha))
        self.assertEqual(len(self.channels_of("r.spexr")), report["bands"] + 1)
        self.assertRegex(" ".join(report["lost"]), "channels .*Z.*spectral:fwhm")
        spec, _ = self.read("r.spexr")
        self.assertEqual(spec.getattribute("studio"), "somewhere")
        self.assertIsNone(spec.getattribute("spectral:fwhm"))

    def test_its_words_go_where_they_are_no_longer_true(self):
        self.write_exr("a.exr", smooth())
        self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5")
        for name, options, kept in (("same.exr", (), True), ("zip.exr", ("--compression", "piz"), True),
                                    ("fewer.exr", ("--bands", "450-700nm"), False),
                                    ("other.exr", ("--resample", "400:50:700"), False),
                                    ("float.exr", ("-d", "float"), False)):
            self.osiotool("convert", "r.spexr", name, *options, "--quiet")
            spec, _ = self.read(name)
            self.assertEqual(spec.getattribute("spectral:reduction") is not None, kept, name)
        self.osiotool("collapse", "r.spexr", "c.exr", "--to", "xyz", "--illuminant", "A", "--quiet")
        spec, _ = self.read("c.exr")
        self.assertIsNone(spec.getattribute("spectral:reduction"))
        self.osiotool("reduce", "r.spexr", "again.exr", "--lights", "A", "--max-delta-e", "2", "--quiet")
        self.assertEqual(self.attribute("again.exr")["source"], "r.spexr")

    def test_envi_and_a_table_as_light(self):
        self.write_exr("a.exr", smooth())
        self.osiotool("convert", "a.exr", "a.hdr", "--quiet")
        self.write_table("lamp.csv", "nm,power", "380,1", "500,3", "780,2")
        report = self.reduce("a.hdr", "--quantity", "reflectance", "--lights", "lamp.csv,D65", "--max-delta-e", "0.5")
        told = self.osiotool_json("difference", "a.exr", "r.spexr", "--illuminant", "lamp.csv")
        self.assertAlmostEqual(report["demands"][0]["delta_e_max"], told["max"], delta=1e-6)

    def test_coefficients_of_the_scene(self):
        self.write_exr("a.exr", dict(smooth(noise=0.02), A=np.full(SHAPE, 0.5, np.float32)))
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5", "--per-scene-basis")
        self.assertLess(report["coefficients"], 14)
        self.assertEqual((report["bands"], report["wavelengths_nm"], report["edges_nm"]), (81, GRID, []))
        types = self.exr_channels("r.spexr")
        self.assertEqual(sorted(types), ["A"] + [f"coefficient.{k:03}" for k in range(report["coefficients"])])
        self.assertEqual(types["coefficient.000"], "16-bit floating-point")
        self.osiotool("convert", "r.spexr", "bands.exr", "--quiet")
        shutil.copy(self.path("r.spexr"), self.path("raw.exr"))
        # What the attribute says, by other code.
        spec, stored = self.read("bands.exr")
        self.assertIsNone(spec.getattribute("spectral:sceneBasis"))
        header = self.check("exrheader", "r.spexr")
        text = re.search(r'spectral:sceneBasis \(type string\): "([^"]*)"', header)[1].split("\n")
        self.assertEqual(text[0], ";".join(f"T.{nm}nm" for nm in GRID))
        curves = np.array([[float(v) for v in line.split(";")] for line in text[1:]])
        raw = self.channels_of("raw.exr")  # by OpenImageIO's own reader
        coefficients = np.stack([raw[f"coefficient.{k:03}"] for k in range(len(curves))], axis=-1).astype(np.float64)
        self.expect(self.pixels("bands.exr"), coefficients @ curves, allowed=1e-7)
        self.assertEqual(report["negative_samples"], np.count_nonzero(self.pixels("bands.exr") < 0))
        self.holds("a.exr", report, out="bands.exr")
        for light in LIGHTS:
            told = self.osiotool_json("difference", "bands.exr", "r.spexr", "--illuminant", light)
            self.assertEqual(told["max"], 0)
        self.both("r.spexr", to="lin_rec709", illuminant="FL11")
        words = ("--to", "xyz", "--illuminant", "A", "--oiiotool")
        self.assertRegex(self.osiotool("weights", "r.spexr", *words, code=1).stderr, "expected bands")
        self.assertIn("81 bands", self.osiotool("info", "r.spexr").stdout)
        self.assertEqual(self.attribute("bands.exr"), {k: v for k, v in report.items() if k in self.attribute("bands.exr")})

    def test_a_scene_basis_that_is_none_is_damage(self):
        planes = {f"coefficient.{k:03}": np.full((2, 3), 0.5, np.float32) for k in range(2)}
        for text, said in (("T.500nm;T.600nm\n1;0\n0;1", None),
                           ("T.500nm;T.600nm\n1;0\n0", "line of 1 numbers, expected 2"),
                           ("T.500nm;T.600nm\n1;0\n0;nan", "is no number"),
                           ("T.500nm;T.500nm\n1;0\n0;1", "comes twice"),
                           ("T.500nm;blue\n1;0\n0;1", "no name of a band"),
                           ("T.500nm;T.600nm", "found 0 coefficients"),
                           ("", "no name of a band"),
                           (";".join(f"T.{nm}nm" for nm in range(400, 2449)) + "\n" + ";".join(["1"] * 2049), "1 to 2048"),
                           ("T.500nm;T.600nm\n1;0\n0;1\n1;1", "no channel coefficient.002")):
            self.write_exr("c.exr", planes, attributes=[("spectral:sceneBasis", text or " ")])
            result = self.osiotool("info", "c.exr", code=4 if said else 0)
            self.assertRegex(result.stderr if said else result.stdout, said or "2 bands")

    def test_refusals_leave_nothing(self):
        self.write_exr("t.exr", smooth(shape=(4, 6)))
        self.write_exr("s.exr", smooth(shape=(4, 6), prefix="S0"))
        stokes = dict(smooth(shape=(4, 6), prefix="S0"), **smooth(shape=(4, 6), prefix="S1"))
        self.write_exr("polarised.exr", stokes)
        self.write_exr("fluorescent.exr", dict(smooth(shape=(4, 6)), **{"T.400nm.500nm": np.zeros((4, 6))}))
        self.write_exr("rgb.exr", {"R": np.zeros((4, 6)), "G": np.zeros((4, 6)), "B": np.zeros((4, 6))})
        half = ("--max-delta-e", "0.5")
        before = self.files()
        original = self.bytes_of("t.exr")
        for code, said, words in (
                (2, "holds its light already", ("s.exr", "o.exr", "--lights", "D65", *half)),
                (1, "expected --lights", ("t.exr", "o.exr", *half)),
                (1, "S1.*--set S0", ("polarised.exr", "o.exr", *half)),
                (1, "Stokes component", ("polarised.exr", "o.exr", "--set", "S1", *half)),
                (1, "fluorescent", ("fluorescent.exr", "o.exr", "--lights", "A", *half)),
                (4, "", ("rgb.exr", "o.exr", "--lights", "A", *half)),
                (2, "above 0", ("t.exr", "o.exr", "--lights", "A", "--max-delta-e", "0")),
                (2, "above 0", ("t.exr", "o.exr", "--lights", "A", "--max-delta-e", "-1")),
                (2, "is the input", ("t.exr", "t.exr", "--lights", "A", *half)),
                (2, "is the input", ("t.exr", "./t.exr", "--lights", "A", *half)),
                (2, "D66", ("t.exr", "o.exr", "--lights", "A,D66", *half)),
                (2, "cie1932", ("t.exr", "o.exr", "--lights", "A", "--observers", "cie1932", *half)),
                (2, "", ("t.exr", "o.exr", "--lights", "A", "--observers", "photopic", *half)),
                (2, "twice", ("t.exr", "o.exr", "--lights", "A,A", *half)),
                (2, "empty name", ("t.exr", "o.exr", "--lights", "A,", *half)),
                (2, "ends in", ("t.exr", "o.png", "--lights", "A", *half)),
                (3, "Nothing was written", ("t.exr", "o.exr", *FOUR, "--max-delta-e", "1e-9")),
                (5, "", ("none.exr", "o.exr", "--lights", "A", *half))):
            result = self.osiotool("reduce", *words, code=code)
            self.assertRegex(result.stderr, said or "osiotool: ")
            self.assertEqual(self.files(), before, words)
        self.assertEqual(self.bytes_of("t.exr"), original)
        self.osiotool("reduce", "polarised.exr", "o.exr", "--set", "S0", *half, "--quiet")
        self.assertIn("set S1", self.attribute("o.exr")["lost"])

    def test_a_failure_keeps_the_old_file(self):
        self.write_exr("a.exr", smooth())
        self.reduce("a.exr", *FOUR, "--max-delta-e", "0.5")
        old = self.bytes_of("r.spexr")
        self.osiotool("reduce", "a.exr", "r.spexr", *FOUR, "--max-delta-e", "1e-9", code=3)
        with open(self.path("a.exr"), "r+b") as file:
            file.seek(os.path.getsize(self.path("a.exr")) // 2)
            file.write(b"\xff" * 20000)
        self.osiotool("reduce", "a.exr", "r.spexr", *FOUR, "--max-delta-e", "0.5", code=4)
        self.assertEqual(self.bytes_of("r.spexr"), old)
        self.assertEqual(self.files(), ["a.exr", "r.spexr"])

    def test_few_bands_as_halves_when_no_bins_do(self):
        nm = [420, 480, 540, 600, 660]
        self.write_exr("a.exr", self.bands(nm, SHAPE), types=FLOAT)
        report = self.reduce("a.exr", *FOUR, "--max-delta-e", "0.2")
        self.assertEqual((report["bands"], report["edges_nm"], report["samples"]), (5, [], "half"))
        self.assertEqual(report["wavelengths_nm"], nm)
        self.holds("a.exr", report)
        self.write_exr("h.exr", self.bands(nm, SHAPE), types=HALF)
        self.osiotool("reduce", "h.exr", "o.exr", *FOUR, "--max-delta-e", "0.2", code=3)


if __name__ == "__main__":
    unittest.main()
