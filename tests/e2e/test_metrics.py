# SPDX-License-Identifier: Apache-2.0
"""Colour difference, photometry, and the spaces of a colour scientist, against numpy."""

import unittest

import numpy as np
from osio_case import HALF, OsioCase, oracle_xyz, stack, table

GRID = list(range(400, 701, 10))
D65 = np.array([0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290])
REC709 = np.array([[0.41239079926595948, 0.35758433938387796, 0.18048078840183429],
                   [0.21263900587151036, 0.71516867876775593, 0.07219231536073371],
                   [0.01933081871559185, 0.11919477979462599, 0.95053215224966058]])


def lab(xyz, white):
    t = xyz / white
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t * 841 / 108 + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def ciede2000(p, q):
    (l1, a1, b1), (l2, a2, b2) = np.moveaxis(p, -1, 0), np.moveaxis(q, -1, 0)
    c7 = ((np.hypot(a1, b1) + np.hypot(a2, b2)) / 2) ** 7
    g = (1 - np.sqrt(c7 / (c7 + 25.0 ** 7))) / 2
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = np.degrees(np.arctan2(b1, a1)) % 360, np.degrees(np.arctan2(b2, a2)) % 360
    grey = c1 * c2 == 0
    dh = np.where(grey, 0, (h2 - h1 + 180) % 360 - 180)
    hm = np.where(grey, h1 + h2, np.where(abs(h1 - h2) <= 180, (h1 + h2) / 2, ((h1 + h2) / 2 + 180) % 360))
    lm, cm = (l1 + l2) / 2, (c1 + c2) / 2
    cos = lambda degrees: np.cos(np.radians(degrees))
    t = 1 - 0.17 * cos(hm - 30) + 0.24 * cos(2 * hm) + 0.32 * cos(3 * hm + 6) - 0.2 * cos(4 * hm - 63)
    sl = 1 + 0.015 * (lm - 50) ** 2 / np.sqrt(20 + (lm - 50) ** 2)
    sc, sh = 1 + 0.045 * cm, 1 + 0.015 * cm * t
    rt = -2 * np.sqrt(cm ** 7 / (cm ** 7 + 25.0 ** 7)) * np.sin(np.radians(60 * np.exp(-((hm - 275) / 25) ** 2)))
    x, y, z = (l2 - l1) / sl, (c2 - c1) / sc, 2 * np.sqrt(c1 * c2) * np.sin(np.radians(dh / 2)) / sh
    return np.sqrt(x * x + y * y + z * z + rt * y * z)


def white_of(light, observer="cie1931"):
    cmf = table(f"observers/{observer}.csv")
    power = table("illuminants/cie_1nm.csv")[light]
    xyz = np.array([(cmf[c] * power).sum() for c in ("x_bar", "y_bar", "z_bar")])
    return xyz / xyz[1]


class Metrics(OsioCase):
    def spectral(self, name, seed, **options):
        bands = self.bands(GRID, shape=(40, 23), seed=seed)
        self.write_exr(name, bands, **options)
        return stack(bands, list(bands))


class Difference(Metrics):
    def test_two_spectral_images_under_a_light(self):
        a, b = self.spectral("a.exr", 1), self.spectral("b.exr", 2, compression="piz", tile=16)
        for light in ("D65", "A", "FL11"):
            weights, white = oracle_xyz(GRID, light), white_of(light)
            expected = ciede2000(lab(a @ weights.T, white), lab(b @ weights.T, white))
            report = self.osiotool_json("difference", "a.exr", "b.exr", "--illuminant", light,
                                        "--basis", "linear", "--map", "map.exr")
            self.assertEqual((report["pixels"], report["undefined_pixels"]), (920, 0))
            self.assertAlmostEqual(report["mean"], expected.mean(), delta=2e-5)
            self.assertAlmostEqual(report["max"], expected.max(), delta=5e-5)
            y, x = np.unravel_index(expected.argmax(), expected.shape)
            self.assertEqual(report["max_pixel"], [x, y])
            ordered = np.sort(expected.ravel())
            for percent in (95, 99):
                self.assertAlmostEqual(report[f"percentile_{percent}"],
                                       ordered[int(np.ceil(percent / 100 * 920)) - 1], delta=1e-2)
            spec, delta = self.read("map.exr")
            self.assertEqual(spec.channelnames, ("deltaE",))
            self.assertLessEqual(np.abs(delta[..., 0] - expected).max(), 5e-5)

    def test_the_number_of_threads_does_not_matter(self):
        self.spectral("a.exr", 1, compression="zips")
        self.spectral("b.exr", 2)
        reports = {self.osiotool("difference", "a.exr", "b.exr", "--illuminant", "A", "--json",
                                 "--threads", n).stdout for n in (1, 2, 7)}
        self.assertEqual(len(reports), 1)

    def test_colour_images_by_what_they_state(self):
        self.spectral("a.exr", 3)
        self.osiotool("collapse", "a.exr", "xyz.exr", "--to", "xyz_d65", "--illuminant", "D65", "--quiet")
        for space in ("lin_rec709", "srgb", "lin_rec2020", "rgb:0.7,0.3,0.2,0.7,0.1,0.1,0.3127,0.329"):
            self.osiotool("collapse", "a.exr", "c.exr", "--to", space, "--illuminant", "D65", "--quiet")
            report = self.osiotool_json("difference", "xyz.exr", "c.exr")
            self.assertLessEqual(report["max"], 2e-3, space)
        # Lab refers to each space's own white: ACEScg by name and by its chromaticities are the same.
        ap1 = "rgb:0.713,0.293,0.165,0.83,0.128,0.044,0.32168,0.33767"
        for space, name in (("acescg", "c.exr"), (ap1, "d.exr")):
            self.osiotool("collapse", "a.exr", name, "--to", space, "--illuminant", "D65", "--quiet")
        self.assertLessEqual(self.osiotool_json("difference", "c.exr", "d.exr")["max"], 2e-3)

    def test_unstated_rgb_is_rec709_aloud(self):
        random = np.random.default_rng(4)
        pixels = {n: {c: random.uniform(0, 1, (9, 8)).astype(np.float32) for c in "RGB"} for n in "ab"}
        for name, channels in pixels.items():
            self.write_exr(f"{name}.exr", channels)
        said = self.osiotool("difference", "a.exr", "b.exr")
        self.assertIn("taken as linear Rec.709", said.stderr)
        p, q = (lab(stack(pixels[n], "RGB") @ REC709.T, D65) for n in "ab")
        report = self.osiotool_json("difference", "a.exr", "b.exr")
        self.assertAlmostEqual(report["mean"], ciede2000(p, q).mean(), delta=2e-5)
        self.assertEqual(len(report["warnings"]), 2)

    def test_thresholds_are_idiffs(self):
        base = np.full((10, 10), 0.5, np.float32)
        spot = base.copy()
        spot[2, 3] = 0.6
        self.write_exr("a.exr", {c: base for c in "RGB"})
        self.write_exr("b.exr", {c: spot for c in "RGB"})
        for options, code, word in (((), 0, "max"), (("--fail", "1"), 1, "FAILURE"), (("--fail", "90"), 0, "PASS"),
                                    (("--fail", "1", "--failpercent", "1"), 0, "PASS"),
                                    (("--fail", "1", "--failpercent", "0.9"), 1, "FAILURE"),
                                    (("--hardfail", "1"), 1, "FAILURE"), (("--warn", "1"), 0, "WARNING"),
                                    (("--fail", "1", "--failpercent", "5", "--hardfail", "2"), 1, "FAILURE")):
            said = self.osiotool("difference", "a.exr", "b.exr", *options, code=code)
            self.assertIn(word, said.stdout, options)
        self.assertEqual(self.osiotool_json("difference", "a.exr", "b.exr")["max_pixel"], [3, 2])

    def test_an_image_does_not_differ_from_itself(self):
        self.spectral("a.exr", 5, types=HALF)
        report = self.osiotool_json("difference", "a.exr", "a.exr", "--illuminant", "A", "--fail", "0")
        self.assertEqual((report["mean"], report["max"], report["verdict"]), (0, 0, "PASS"))

    def test_nan_is_counted_and_fails(self):
        bad = np.full((4, 4), 0.5, np.float32)
        bad[1, 1] = np.nan
        self.write_exr("a.exr", {c: bad for c in "RGB"})
        self.write_exr("b.exr", {c: np.full((4, 4), 0.5, np.float32) for c in "RGB"})
        said = self.osiotool("difference", "a.exr", "b.exr", "--fail", "1", code=1)
        self.assertIn("undefined    1", said.stdout)
        self.assertEqual(self.osiotool_json("difference", "a.exr", "b.exr")["undefined_pixels"], 1)

    def test_refusals(self):
        self.write_exr("a.exr", {c: np.ones((4, 4)) for c in "RGB"})
        self.write_exr("b.exr", {c: np.ones((4, 5)) for c in "RGB"})
        self.write_exr("n.exr", {"N": np.ones((4, 4))})
        self.assertIn("5x4", self.osiotool("difference", "a.exr", "b.exr", code=1).stderr)
        self.assertIn("neither bands nor channels", self.osiotool("difference", "a.exr", "n.exr", code=4).stderr)
        self.assertIn("neither image holds bands",
                      self.osiotool("difference", "a.exr", "a.exr", "--illuminant", "A", code=1).stderr)
        self.osiotool("difference", "a.exr", "missing.exr", code=5)


class Spaces(Metrics):
    def test_lab_and_chromaticities_against_numpy(self):
        bands = self.spectral("a.exr", 6)
        xyz = bands @ oracle_xyz(GRID, "A").T
        white = white_of("A")
        total = xyz.sum(-1, keepdims=True)
        below = (xyz @ [1, 15, 3])[..., None]
        expected = {"lab": lab(xyz, white),
                    "xyY": np.concatenate([(xyz / total)[..., :2], xyz[..., 1:2]], -1),
                    "uv": np.concatenate([4 * xyz[..., :1] / below, 9 * xyz[..., 1:2] / below, xyz[..., 1:2]], -1)}
        neutral = np.array([4 * white[0], 9 * white[1]]) / (white @ [1, 15, 3])
        lightness = expected["lab"][..., :1]
        expected["luv"] = np.concatenate([lightness, 13 * lightness * (expected["uv"][..., :2] - neutral)], -1)
        for space, values in expected.items():
            spec, pixels = self.read(f"{self.path('a.exr')}?to={space}&illuminant=A&basis=linear")
            self.assertLessEqual(np.abs(pixels - values).max(), 1e-4 if space[0] == "l" else 1e-6, space)
            self.assertFalse(any(a.name == "chromaticities" for a in spec.extra_attribs), space)
            self.osiotool("collapse", "a.exr", "o.exr", "--to", space, "--illuminant", "A",
                          "--basis", "linear", "--quiet")
            channels = self.channels_of("o.exr")
            for i, name in enumerate(spec.channelnames):
                self.assertTrue(np.array_equal(channels[name], pixels[..., i]), name)
            self.osiotool("collapse", "a.exr", "o.png", "--to", space, "--illuminant", "A", code=2)

    def test_black_has_the_whites_chromaticity(self):
        self.write_exr("a.exr", {f"T.{nm}nm": np.zeros((2, 2)) for nm in GRID})
        white = white_of("A")
        pixels = self.read(f"{self.path('a.exr')}?to=xyY&illuminant=A")[1]
        self.assertLessEqual(np.abs(pixels[..., :2] - (white / white.sum())[:2]).max(), 1e-7)
        self.assertTrue((pixels[..., 2] == 0).all())

    def test_adaptation_by_name(self):
        bands = self.spectral("a.exr", 7)
        xyz = bands @ oracle_xyz(GRID, "A").T
        for name, expected in (("none", xyz), ("xyz-scaling", xyz / white_of("A") * D65)):
            pixels = self.read(f"{self.path('a.exr')}?to=xyz_d65&illuminant=A&adapt={name}&basis=linear")[1]
            self.assertLessEqual(np.abs(pixels - expected).max(), 1e-6, name)


class Photometry(Metrics):
    def test_luminance_of_radiance(self):
        bands = self.bands(GRID, shape=(40, 23), prefix="S0", high=3, seed=8)
        self.write_exr("a.exr", bands)
        cmf = table("observers/cie1931.csv")
        luminance = 683 * cmf["y_bar"].sum() * (stack(bands, list(bands)) @ oracle_xyz(GRID, None)[1])
        report = self.osiotool_json("photometry", "a.exr", "y.exr", "--basis", "linear")
        self.assertAlmostEqual(report["luminance_mean"] / luminance.mean(), 1, delta=1e-6)
        self.assertAlmostEqual(report["luminance_min"] / luminance.min(), 1, delta=1e-6)
        self.assertAlmostEqual(report["luminance_max"] / luminance.max(), 1, delta=1e-6)
        self.assertAlmostEqual(report["luminance_percentiles"]["50"],
                               np.sort(luminance.ravel())[459], delta=0.001 * luminance.mean())
        scotopic = table("observers/scotopic.csv")
        phi = [np.interp(scotopic["wavelength_nm"], GRID, unit) for unit in np.eye(len(GRID))]
        dark = 1700 * stack(bands, list(bands)) @ (np.array(phi) @ scotopic["V"])
        self.assertAlmostEqual(report["scotopic_mean"] / dark.mean(), 1, delta=1e-6)
        self.assertAlmostEqual(report["sp_ratio"], dark.mean() / luminance.mean(), delta=1e-5)
        channels = self.channels_of("y.exr")
        self.assertEqual(set(channels), {"Y", "Yscotopic"})
        self.assertLessEqual(np.abs(channels["Y"] / luminance - 1).max(), 1e-6)
        self.assertLessEqual(np.abs(channels["Yscotopic"] / dark - 1).max(), 1e-6)

    def test_lights(self):
        report = self.osiotool_json("photometry", "--illuminant", "A")
        self.assertAlmostEqual(report["efficacy"], 122.66500618387673, delta=1e-9)
        self.assertAlmostEqual(report["sp_ratio"], 1.4122181355623926, delta=1e-12)
        self.assertAlmostEqual(report["cct"], 2855.5, delta=1)
        with open(self.path("green.csv"), "w") as file:
            file.write("510,0\n520,1\n530,0\n")
        self.assertIsNone(self.osiotool_json("photometry", "--illuminant", "green.csv")["cct"])

    def test_refusals(self):
        self.spectral("t.exr", 9)
        self.assertIn("is a reflectance", self.osiotool("photometry", "t.exr", code=1).stderr)
        self.assertIn("a ratio", self.osiotool("photometry", "t.exr", "--illuminant", "A", code=1).stderr)
        self.assertIn("name a spectral file", self.osiotool("photometry", code=2).stderr)
        self.write_exr("s.exr", {f"S0.{nm}nm": np.ones((2, 2)) for nm in GRID})
        self.osiotool("photometry", "s.exr", "y.png", code=2)


if __name__ == "__main__":
    unittest.main()
