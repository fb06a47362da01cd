# SPDX-License-Identifier: Apache-2.0
"""The same pixels by every way, and the right ones."""

import csv
import os
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import CONFIG, HALF, SOURCE, UINT, OsioCase, oracle_xyz, stack

GRID = list(range(400, 701, 10))
REC709 = np.linalg.inv(np.array([[0.41239079926595948, 0.35758433938387796, 0.18048078840183429],
                                 [0.21263900587151036, 0.71516867876775593, 0.07219231536073371],
                                 [0.01933081871559185, 0.11919477979462599, 0.95053215224966058]]))


class Ways(OsioCase):
    """osiotool, a query, a recipe, our extension with a hint, Python: one answer."""

    def pixels_by_every_way(self, source, to, illuminant=None, **more):
        options = {"to": to, **({"illuminant": illuminant} if illuminant else {}), **more}
        query = "&".join(f"{k}={v}" for k, v in options.items())
        os.link(self.path(source), self.path("own.spexr"))
        with open(self.path("shot.spectral"), "w") as recipe:
            recipe.write(f"# a recipe\nsource = {source}\n" +
                         "".join(f"{k} = {v}\n" for k, v in options.items()))
        config = oiio.ImageSpec()
        hints = []
        for key, value in options.items():
            config.attribute(f"spectral:{key}", value)
            hints += ["--iconfig", f"spectral:{key}", value]

        self.osiotool("collapse", source, "tool.exr", *(w for k, v in options.items()
                                                        for w in (f"--{k}", v)), "--quiet")
        self.check("oiiotool", f"{source}?{query}", "-o", "query.exr")
        self.check("oiiotool", "shot.spectral", "-o", "recipe.exr")
        self.check("oiiotool", *hints, "own.spexr", "-o", "hint.exr")
        ways = {name: self.read(f"{name}.exr")[1] for name in ("tool", "query", "recipe", "hint")}
        ways["python query"] = self.read(f"{self.path(source)}?{query}")[1]
        ways["python config"] = self.read("own.spexr", config=config)[1]
        ways["python recipe"] = self.read("shot.spectral")[1]
        buffer = oiio.ImageBuf(f"{self.path(source)}?{query}")
        ways["python ImageBuf"] = buffer.get_pixels(oiio.FLOAT)
        for name, pixels in ways.items():
            self.assertTrue(np.array_equal(pixels, ways["tool"], equal_nan=True), name)
        for name in ("own.spexr", "shot.spectral"):
            os.remove(self.path(name))
        return ways["tool"]

    def test_reflectance_to_rec709(self):
        bands = self.bands(GRID)
        self.write_exr("a.exr", bands)
        for light in ("D65", "A", "FL11"):
            pixels = self.pixels_by_every_way("a.exr", "lin_rec709", light)
            self.assertEqual(pixels.shape, (5, 7, 3))

    def test_radiance_to_acescg(self):
        self.write_exr("a.exr", self.bands(GRID, prefix="S0", high=50))
        self.pixels_by_every_way("a.exr", "acescg")
        self.pixels_by_every_way("a.exr", "acescg", white="A", exposure="-1.5")

    def test_mixed_types_alpha_and_other_channels(self):
        channels = dict(self.bands(GRID), A=np.full((5, 7), 0.25), Z=np.ones((5, 7)))
        types = {name: (HALF, oiio.FLOAT)[i % 2] for i, name in enumerate(channels)}
        self.write_exr("a.exr", channels, types=types)
        pixels = self.pixels_by_every_way("a.exr", "srgb", "D50")
        self.assertEqual(pixels.shape, (5, 7, 4))
        self.assertTrue((pixels[..., 3] == 0.25).all())

    def test_maketx_sees_the_same_pixels(self):
        self.write_exr("a.exr", self.bands(GRID, shape=(32, 64)))
        with open(self.path("a.spectral"), "w") as recipe:
            recipe.write("source = a.exr\nto = lin_rec709\nilluminant = D65\n")
        self.check("maketx", "a.spectral", "-d", "float", "-o", "recipe.tx")
        self.osiotool("collapse", "a.exr", "tool.exr", "--to", "lin_rec709", "--illuminant", "D65")
        self.check("maketx", "tool.exr", "-d", "float", "-o", "tool.tx")
        self.assertTrue(np.array_equal(self.read("recipe.tx")[1], self.read("tool.tx")[1]))
        os.link(self.path("a.exr"), self.path("a.spexr"))
        self.check("maketx", "a.spexr", "-d", "float", "-o", "bands.tx")
        spec, pixels = self.read("bands.tx")
        self.assertTrue(np.array_equal(pixels, self.read("a.spexr")[1]))

    def test_idiff_and_iinfo_take_our_names(self):
        self.write_exr("a.exr", self.bands(GRID))
        self.osiotool("collapse", "a.exr", "tool.exr", "--to", "xyz", "--illuminant", "A")
        self.assertIn("PASS", self.check("idiff", "a.exr?to=xyz&illuminant=A", "tool.exr"))
        different = self.run_program("idiff", "a.exr?to=xyz&illuminant=D65", "tool.exr")
        self.assertEqual(different.returncode, 2)
        listing = self.check("iinfo", "-v", "a.exr?to=xyz&illuminant=A")
        self.assertIn("spectralexr", listing)
        self.assertIn("channel list: R, G, B", listing)
        self.assertNotIn("oiio:ColorSpace", listing)


class Values(OsioCase):
    """Against numpy and against golden vectors."""

    def collapse(self, source, *options):
        self.osiotool("collapse", source, "out.exr", "--quiet", "--basis", "linear", *options)
        return self.read("out.exr")[1].astype(np.float64)

    def test_reflectance_under_many_lights(self):
        bands = self.bands(GRID, shape=(16, 16))
        self.write_exr("a.exr", bands)
        values = stack(bands, list(bands))
        for light in ("E", "A", "C", "D50", "D55", "D65", "D75", "FL2", "FL11", "LED-B3"):
            for observer in ("cie1931", "cie1964"):
                with self.subTest(light=light, observer=observer):
                    actual = self.collapse("a.exr", "--to", "xyz", "--illuminant", light,
                                           "--observer", observer)
                    self.expect(actual, values @ oracle_xyz(GRID, light, observer).T)

    def test_radiance_and_both_extrapolations(self):
        bands = self.bands(GRID, prefix="S0", high=900)
        self.write_exr("a.exr", bands)
        values = stack(bands, list(bands))
        for hold in (True, False):
            actual = self.collapse("a.exr", "--to", "xyz", "--extrapolate", "hold" if hold else "zero")
            self.expect(actual, values @ oracle_xyz(GRID, hold=hold).T)

    def test_radiance_to_rec709_is_the_d65_matrix(self):
        bands = self.bands(GRID, prefix="S0")
        self.write_exr("a.exr", bands)
        xyz = stack(bands, list(bands)) @ oracle_xyz(GRID).T
        self.expect(self.collapse("a.exr", "--to", "lin_rec709"), xyz @ REC709.T)

    def test_every_sample_type(self):
        values = {f"T.{nm}nm": np.round(v * 8) / 8 for nm, v in
                  ((nm, self.bands([nm])[f"T.{nm}nm"]) for nm in GRID)}
        self.write_exr("half.exr", values, types=HALF)
        self.write_exr("float.exr", values)
        self.write_exr("uint.exr", {n: v * 8 / 4294967295.0 for n, v in values.items()}, types=UINT)
        whole = self.channels_of("uint.exr")
        expected = stack(values, list(values)) @ oracle_xyz(GRID, "D65").T
        options = ("--to", "xyz", "--illuminant", "D65")
        half, single = self.collapse("half.exr", *options), self.collapse("float.exr", *options)
        self.assertTrue(np.array_equal(half, single))
        self.expect(single, expected)
        stored = self.collapse("uint.exr", *options)
        self.expect(stored / 8, expected * 1.0)
        self.assertTrue(whole)

    def test_unsorted_and_non_uniform_bands(self):
        grid = [1000, 380, 381, 385, 700, 400, 430, 500, 620, 780]
        bands = self.bands(grid)
        self.write_exr("a.exr", bands)
        actual = self.collapse("a.exr", "--to", "xyz", "--illuminant", "D65")
        self.expect(actual, stack(bands, list(bands)) @ oracle_xyz(grid, "D65").T)

    def test_negative_and_huge_values_pass(self):
        bands = self.bands(GRID, prefix="S0", low=-1, high=1)
        bands = {name: value * 1e38 for name, value in bands.items()}
        self.write_exr("a.exr", bands)
        expected = stack(bands, list(bands)) @ oracle_xyz(GRID).T
        self.expect(self.collapse("a.exr", "--to", "xyz"), expected)

    def test_colorchecker_against_the_golden_vectors(self):
        self.colorchecker(patch=10)
        with open(os.path.join(SOURCE, "tests/golden/xyz_colorchecker.csv")) as file:
            rows = [r for r in csv.DictReader(file) if r["method"] == "sum1nm_linear"]
        worst = 0
        for light in sorted({r["illuminant"] for r in rows}):
            for observer, name in (("2", "cie1931"), ("10", "cie1964")):
                query = f"{self.path('cc.exr')}?to=xyz&basis=linear&illuminant={light}&observer={name}"
                _, plugin = self.read(query)
                self.osiotool("collapse", "cc.exr", "cc_xyz.exr", "--to", "xyz", "--illuminant", light,
                              "--observer", name, "--basis", "linear", "--quiet")
                _, tool = self.read("cc_xyz.exr")
                self.assertTrue(np.array_equal(plugin, tool))
                for row in rows:
                    if row["illuminant"] != light or row["observer"] != observer:
                        continue
                    patch = int(row["patch"]) - 1
                    pixel = plugin[patch // 6 * 11 + 5, patch % 6 * 11 + 5].astype(np.float64)
                    golden = np.array([float(row[c]) for c in "XYZ"]) / 100
                    worst = max(worst, np.abs(pixel - golden).max() / golden.max())
        print(f"{self.id()}: max seen {worst:.2g} / max allowed 2e-06")
        self.assertLessEqual(worst, 2e-6)

    def test_a_metameric_pair_matches_under_its_light_only(self):
        self.colorchecker(patch=10)
        distance = {}
        for light in ("D65", "A", "FL11"):
            _, xyz = self.read(f"{self.path('cc.exr')}?to=xyz&illuminant={light}")
            distance[light] = np.abs(xyz[49, 5] - xyz[49, 60]).max()
        self.assertLess(distance["D65"], 1e-6)
        self.assertGreater(distance["A"], 0.005)
        self.assertGreater(distance["FL11"], 0.02)

    def test_nan_stays_in_its_pixel_and_zero_weights_stop_infinities(self):
        bands = self.bands([400, 500, 600, 700, 831, 900], prefix="S0")
        bands["S0.500nm"][1, 2] = np.nan
        bands["S0.900nm"][:] = np.inf
        self.write_exr("a.exr", bands)
        pixels = self.collapse("a.exr", "--to", "xyz")
        expected_nan = np.zeros((5, 7), bool)
        expected_nan[1, 2] = True
        for c in range(3):
            self.assertTrue(np.array_equal(np.isnan(pixels[..., c]), expected_nan))
        self.assertFalse(np.isinf(pixels).any())


class Ocio(OsioCase):
    """The config and our own spaces say the same."""

    SPACES = {"acescg": "ACEScg", "aces2065_1": "ACES2065-1", "lin_rec709": "lin_rec709",
              "lin_p3d65": "lin_p3d65", "lin_rec2020": "lin_rec2020", "lin_adobergb": "lin_adobergb_scene",
              "lin_prophoto": "lin_prophoto"}

    def expect_equal(self, source, query):
        for ours, theirs in self.SPACES.items():
            self.check("oiiotool", "--colorconfig", CONFIG, f"{source}?to=xyz_d65{query}",
                       "--tocolorspace", theirs, "-o", "ocio.exr")
            self.check("oiiotool", f"{source}?to={ours}{query}", "-o", "ours.exr")
            _, a = self.read("ocio.exr")
            _, b = self.read("ours.exr")
            self.assertLessEqual(np.abs(a - b).max() / np.abs(b).max(), 2e-6, ours)

    def test_reflectance(self):
        self.write_exr("a.exr", self.bands(GRID))
        for light in ("D65", "A", "FL11"):
            self.expect_equal("a.exr", f"&illuminant={light}")

    def test_radiance(self):
        self.write_exr("a.exr", self.bands(GRID, prefix="S0", high=20))
        self.expect_equal("a.exr", "")

    def test_srgb_of_positive_values_is_the_texture_space(self):
        flat = {f"T.{nm}nm": np.linspace(0.001, 1, 35).reshape(5, 7) for nm in GRID}
        self.write_exr("a.exr", flat)
        self.check("oiiotool", "--colorconfig", CONFIG, "a.exr?to=xyz_d65&illuminant=D65",
                   "--tocolorspace", "srgb_tx", "-o", "ocio.exr")
        self.check("oiiotool", "a.exr?to=srgb&illuminant=D65", "-o", "ours.exr")
        # OCIO joins the curve's two pieces with a slope of 12.9232, IEC 61966-2-1 with 12.92.
        self.assertLess(np.abs(self.read("ocio.exr")[1] - self.read("ours.exr")[1]).max(), 2e-5)

    def test_the_config_is_valid(self):
        self.check("ociocheck", "--iconfig", CONFIG)

    def test_the_tagged_names_are_in_the_config(self):
        names = self.check("ociocheck", "--iconfig", CONFIG)
        with open(CONFIG) as file:
            config = file.read()
        for tag in ("lin_ciexyzd65_scene", "lin_rec709", "lin_p3d65", "lin_rec2020", "ACEScg", "lin_adobergb_scene",
                    "ACES2065-1", "sRGB"):
            self.assertRegex(config, rf"(name: |[\[ ]){tag}[\],\n]", tag)
        self.assertTrue(names)


if __name__ == "__main__":
    unittest.main()
