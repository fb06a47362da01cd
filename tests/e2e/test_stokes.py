# SPDX-License-Identifier: Apache-2.0
"""Polarised light: Stokes components, degrees and angles from a file, by the tool and the plugin, against numpy."""

import unittest

import numpy as np

from osio_case import HALF, OsioCase, oracle_xyz, stack

GRID = [400 + 20 * i for i in range(16)]
WORDS = {"basis": "linear"}


class Stokes(OsioCase):
    def polarised(self, name="p.exr", families=("S0", "S1", "S2", "S3"), shape=(6, 8), alpha=None,
                  handedness="left", **options):
        """Writes light of random ellipses; {family: Y of every pixel}."""
        random = np.random.default_rng(5)
        degree, psi, chi = random.uniform(0, 1, shape), random.uniform(-1.5, 1.5, shape), random.uniform(-0.7, 0.7, shape)
        parts = {"S0": np.ones(shape), "S1": degree * np.cos(2 * psi) * np.cos(2 * chi),
                 "S2": degree * np.sin(2 * psi) * np.cos(2 * chi), "S3": degree * np.sin(2 * chi)}
        light = {nm: random.uniform(0.5, 1.5, shape) for nm in GRID}
        channels = {f"{family}.{nm}nm": parts[family] * light[nm] for family in families for nm in GRID}
        if alpha is not None:
            channels = {c: plane * alpha for c, plane in channels.items()}
            channels["A"] = alpha
        attributes = (("polarisationHandedness", handedness),) if handedness else ()
        self.write_exr(name, channels, attributes=attributes, **options)
        stored = self.channels_of(name)
        y = oracle_xyz(GRID)[1]
        return {f: stack(stored, [f"{f}.{nm}nm" for nm in GRID]) @ y for f in families}

    def test_components_keep_their_sign(self):
        y = self.polarised()
        for family in ("S0", "S1", "S2", "S3"):
            pixels, report, said = self.both("p.exr", to=family.lower(), **WORDS)
            self.assertEqual(report["channel_names"], [family])
            self.expect(pixels[..., 0], y[family], scale=np.abs(y["S0"]).max())
            self.assertEqual(report["negative_pixels"], 0)
            self.assertNotIn("gamut", said)
            if family != "S0":
                self.assertLess(pixels.min(), 0)

    def test_degrees_and_angle(self):
        s = self.polarised(types=HALF, tile=16)
        linear = np.hypot(s["S1"], s["S2"])
        expected = {"dolp": linear / s["S0"], "docp": np.abs(s["S3"]) / s["S0"],
                    "dop": np.sqrt(linear ** 2 + s["S3"] ** 2) / s["S0"],
                    "aolp": np.degrees(np.arctan2(s["S2"], s["S1"])) / 2}
        names = {"dolp": "DoLP", "docp": "DoCP", "dop": "DoP", "aolp": "AoLP"}
        for to, values in expected.items():
            pixels, report, _ = self.both("p.exr", to=to, **WORDS)
            self.assertEqual(report["channel_names"], [names[to]])
            self.assertEqual((report["undefined_pixels"], report["overpolarised_pixels"]), (0, 0))
            self.expect(pixels[..., 0], values, 1e-5)

    def test_colour_of_a_component_is_signed_and_linear(self):
        self.polarised()
        stored = self.channels_of("p.exr")
        flipped = {c: -plane if c.startswith("S1") else plane for c, plane in stored.items()}
        self.write_exr("flipped.exr", flipped)
        one, report, said = self.both("p.exr", to="lin_rec709", set="S1", white="A")
        other, _, _ = self.both("flipped.exr", to="lin_rec709", set="S1", white="A")
        self.assertTrue(np.array_equal(one, -other))
        self.assertLess(one.min(), 0)
        self.assertEqual(report["negative_pixels"], 0)
        self.assertNotIn("gamut", said)
        as_intensity = {c.replace("S1", "S0"): plane for c, plane in stored.items() if c.startswith("S1")}
        self.write_exr("as_s0.exr", as_intensity)
        same, _, _ = self.both("as_s0.exr", to="lin_rec709", white="A")
        self.assertTrue(np.array_equal(one, same))

    def test_alpha_stays_associated(self):
        alpha = np.linspace(0.1, 1, 48).reshape(6, 8).astype(np.float32)
        s = self.polarised(alpha=alpha)
        pixels, report, _ = self.both("p.exr", to="dolp", **WORDS)
        self.assertEqual(report["channel_names"], ["DoLP", "A"])
        self.expect(pixels[..., 0], alpha * np.hypot(s["S1"], s["S2"]) / s["S0"], 1e-5)
        self.assertTrue(np.array_equal(pixels[..., 1], alpha))

    def test_handedness_is_kept(self):
        self.polarised()
        for words in (("--to", "s3"), ("--to", "docp"), ("--to", "xyz", "--set", "S3")):
            self.osiotool("collapse", "p.exr", "o.exr", *words)
            self.assertEqual(self.read("o.exr")[0].get_string_attribute("polarisationHandedness"), "left")
        spec, _ = self.read(self.path("p.exr") + "?to=s3")
        self.assertEqual(spec.get_string_attribute("polarisationHandedness"), "left")
        self.osiotool("collapse", "p.exr", "o.exr", "--to", "xyz", "--set", "S0")
        self.assertEqual(self.read("o.exr")[0].get_string_attribute("polarisationHandedness"), "")
        self.check("oiiotool", "p.exr?to=raw", "-o:fileformatname=spectralexr", "w.exr")
        self.osiotool("convert", "p.exr", "c.exr")
        for name in ("w.exr", "c.exr"):
            self.assertEqual(self.read(name)[0].get_string_attribute("polarisationHandedness"), "left")
            before, after = self.channels_of("p.exr"), self.channels_of(name)
            for channel in before:
                self.assertTrue(np.array_equal(before[channel], after[channel]), channel)

    def test_black_and_impossible_light(self):
        self.polarised(shape=(2, 4))
        channels = self.channels_of("p.exr")
        for channel, plane in channels.items():
            plane[0, 0] = 0                                          # no light
            plane[0, 1] = 1 if channel.startswith("S0") else 0       # not polarised
            plane[0, 2] = 1 if channel.startswith("S0") else 2       # more than light can be
            plane[0, 3] = -1 if channel.startswith("S0") else 1      # less than no light
        self.write_exr("odd.exr", channels)
        pixels, report, _ = self.both_bits("odd.exr", "dolp")
        self.assertEqual((report["undefined_pixels"], report["overpolarised_pixels"], report["nan_pixels"]), (1, 1, 1))
        self.assertEqual(list(pixels[0, :2]), [0, 0])
        self.assertAlmostEqual(float(pixels[0, 2]), 2 * 2 ** 0.5, 5)
        self.assertTrue(np.isnan(pixels[0, 3]))
        angle, report, _ = self.both_bits("odd.exr", "aolp")
        self.assertEqual((report["undefined_pixels"], report["nan_pixels"]), (2, 0))
        said = self.osiotool("collapse", "odd.exr", "o.exr", "--to", "dolp").stderr
        self.assertIn("note: 1 of 8 pixels have no light, so no degree: 0 was written", said)
        self.assertIn("note: 1 of 8 pixels are polarised by more than 1, as no light is", said)
        self.assertIn("2 of 8 pixels have no linear polarisation, so no angle",
                      self.osiotool("collapse", "odd.exr", "o.exr", "--to", "aolp").stderr)

    def both_bits(self, source, to):
        """As both(), where NaN are equal."""
        result = self.osiotool_json("collapse", source, "tool.exr", "--to", to)
        tool = self.in_order("tool.exr", result["channel_names"])
        plugin = self.in_order(f"{self.path(source)}?to={to}", result["channel_names"])
        self.assertTrue(np.array_equal(tool, plugin, equal_nan=True))
        return tool[..., 0], result, None

    def test_threads_and_regions_give_the_same_bits(self):
        self.polarised(shape=(70, 40))
        self.osiotool("collapse", "p.exr", "one.exr", "--to", "dolp", "--threads", "1")
        self.osiotool("collapse", "p.exr", "many.exr", "--to", "dolp", "--threads", "4")
        one = self.channels_of("one.exr")["DoLP"]
        self.assertTrue(np.array_equal(one, self.channels_of("many.exr")["DoLP"]))
        self.check("oiiotool", "p.exr?to=dolp", "--cut", "40x9+0+17", "-o", "cut.exr")
        self.assertTrue(np.array_equal(one[17:26], self.channels_of("cut.exr")["DoLP"]))

    def test_plan_names_the_components(self):
        self.polarised()
        plan = self.osiotool_json("plan", "p.exr", "--to", "dolp", "--basis", "linear")
        self.assertEqual((plan["outputs"], plan["weighed"], plan["curve"]), (["DoLP"], ["S0", "S1", "S2"], "dolp"))
        self.assertEqual(plan["channels"], [f"{f}.{nm}nm" for f in ("S0", "S1", "S2") for nm in GRID])
        weights = np.array(plan["weights"])
        self.expect(weights[0, :len(GRID)], oracle_xyz(GRID)[1])
        self.assertEqual(np.count_nonzero(weights[0, len(GRID):]), 0)
        self.assertRegex(self.osiotool("plan", "p.exr", "--to", "dolp").stdout, r"channel +nm +S0 +S1 +S2")
        table = self.osiotool("weights", "p.exr", "--to", "aolp").stdout.splitlines()
        self.assertEqual((table[0], len(table)), ("nm,S1,S2", 1 + 2 * len(GRID)))

    def test_integers_hold_degrees_and_no_angles(self):
        s = self.polarised()
        self.osiotool("collapse", "p.exr", "o.png", "--to", "dolp", "-d", "uint16", "--basis", "linear")
        _, pixels = self.read("o.png")
        self.expect(pixels[..., 0], np.hypot(s["S1"], s["S2"]) / s["S0"], 2e-5)
        self.osiotool("collapse", "p.exr", "o.png", "--to", "aolp", "-d", "uint8", code=2)

    def test_what_has_no_colour_difference_is_not_certified(self):
        self.polarised()
        for to in ("dolp", "aolp", "s0", "s1"):
            result = self.osiotool("collapse", "p.exr", "o.exr", "--to", to, "--certificate", "c.json", code=2)
            self.assertIn(f"the error of to={to} is not bounded", result.stderr)
        self.assertEqual(self.files(), ["p.exr"])

    def test_what_is_missing_is_named(self):
        self.polarised(families=("S0", "S1"))
        result = self.osiotool("collapse", "p.exr", "o.exr", "--to", "dolp", code=1)
        self.assertIn("there is no set S2, which to=dolp is made of; found S0, S1", result.stderr)
        self.osiotool("collapse", "p.exr", "o.exr", "--to", "s1")
        self.write_exr("t.exr", self.bands(GRID))
        result = self.osiotool("collapse", "t.exr", "no.exr", "--to", "aolp", code=1)
        self.assertIn("to=aolp is made of Stokes components, and there is none; found T", result.stderr)
        self.assertNotIn("no.exr", self.files())


if __name__ == "__main__":
    unittest.main()
