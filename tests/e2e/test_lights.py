# SPDX-License-Identifier: Apache-2.0
"""Several lights at once: the files, subimages and plans that each of them alone would give."""

import os
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import FLOAT, OsioCase

GRID = list(range(400, 701, 20))
LIGHTS = ("A", "D65", "FL11")


class Lights(OsioCase):
    def setUp(self):
        super().setUp()
        self.write_exr("a.exr", dict(self.bands(GRID, shape=(40, 23), seed=1),
                                     A=np.full((40, 23), 0.5, np.float32)))

    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_each_file_is_the_one_of_its_light_alone(self):
        for space, ending, options in (("lin_rec709", "exr", ("-d", "half")), ("srgb", "png", ()),
                                       ("lab", "exr", ("--compression", "piz")), ("luminance", "exr", ())):
            for light in LIGHTS:
                self.osiotool("collapse", "a.exr", f"{light}.{ending}", "--to", space, "--illuminant", light, *options,
                              "--quiet")
            for threads in ("1", "3"):
                reports = self.osiotool_json("collapse", "a.exr", "all_{illuminant}." + ending, "--to", space,
                                             "--illuminant", ",".join(LIGHTS), *options, "--threads", threads,
                                             "--quiet")["outputs"]
                self.assertEqual([r["output"] for r in reports], [f"all_{light}.{ending}" for light in LIGHTS])
                for light in LIGHTS:
                    if ending == "png":
                        self.check("idiff", "-q", f"{light}.png", f"all_{light}.png")
                    else:
                        self.assertEqual(self.content(f"{light}.exr"), self.content(f"all_{light}.exr"))
                self.assertEqual(len({r["id"] for r in reports}), len(LIGHTS))

    def test_subimages_in_stock_programs(self):
        name = self.path("a.exr") + "?to=acescg&illuminant=A,D65,FL11"
        image = oiio.ImageInput.open(name)
        for i, light in enumerate(LIGHTS):
            self.assertTrue(image.seek_subimage(i, 0))
            self.assertEqual(image.spec().get_string_attribute("oiio:subimagename"), light)
            self.assertEqual(image.spec().get_int_attribute("oiio:subimages"), 3)
            alone = self.read(self.path("a.exr") + f"?to=acescg&illuminant={light}")[1]
            self.assertTrue(np.array_equal(image.read_image(i, 0, 0, 4, FLOAT), alone), light)
        self.assertFalse(image.seek_subimage(3, 0))
        image.close()
        self.assertIn("3 subimages", self.check("oiiotool", "--info", "-a", "-v", name))
        self.check("oiiotool", "-a", name, "-o", "parts.exr")
        self.check("idiff", "-q", "-a", name, "parts.exr")

    def test_parts_of_one_exr(self):
        for compression in ("zip", "zips", "piz", "none"):
            for threads in ("1", "3"):
                self.osiotool("collapse", "a.exr", "parts.exr", "--to", "acescg", "--illuminant", "A,D65,FL11",
                              "-d", "half", "--compression", compression, "--threads", threads, "--quiet")
                if threads == "1":
                    first = self.content("parts.exr")
            self.assertEqual(first, self.content("parts.exr"))
            self.assertIn("with a checksum", self.osiotool("verify", "parts.exr").stdout)
            for i, light in enumerate(LIGHTS):
                self.osiotool("collapse", "a.exr", "one.exr", "--to", "acescg", "--illuminant", light, "-d", "half",
                              "--compression", compression, "--quiet")
                spec, pixels = self.read("parts.exr", subimage=i)
                alone, expected = self.read("one.exr")
                self.assertTrue(np.array_equal(pixels, expected), light)
                self.assertEqual(spec.get_string_attribute("oiio:subimagename"), light)
                for name in ("spectral:recipe", "spectral:plan", "oiio:ColorSpace", "chromaticities"):
                    self.assertEqual(spec.getattribute(name), alone.getattribute(name), name)
            # Every byte behind the header is under a checksum.
            damaged = bytearray(first)
            for at in range(len(first) - 1, len(first) - 2000, -97):
                damaged[at] ^= 4
                with open(self.path("damaged.exr"), "wb") as file:
                    file.write(damaged)
                self.osiotool("verify", "damaged.exr", code=4)
                damaged[at] ^= 4

    def test_tables_and_recipes(self):
        for lamp in ("warm", "cold"):
            with open(self.path(f"{lamp}.csv"), "w") as file:
                file.write("400,0.2\n700,1\n" if lamp == "warm" else "400,1\n700,0.3\n")
        self.osiotool("collapse", "a.exr", "o_{illuminant}.exr", "--to", "xyz", "--illuminant",
                      "warm.csv, cold.csv,D(6200)", "--quiet")
        self.assertEqual([f for f in self.files() if f.startswith("o_")], ["o_D(6200).exr", "o_cold.exr", "o_warm.exr"])
        with open(self.path("two.spectral"), "w") as file:
            file.write("source = a.exr\nto = xyz\nilluminant = warm.csv,cold.csv\n")
        for i, lamp in enumerate(("warm", "cold")):
            self.assertTrue(np.array_equal(self.read("two.spectral", subimage=i)[1], self.read(f"o_{lamp}.exr")[1]))

    def test_plans(self):
        plans = self.osiotool_json("plan", "a.exr", "--to", "xyz", "--illuminant", "A,FL11")["plans"]
        for plan, light in zip(plans, ("A", "FL11"), strict=True):
            self.assertEqual(plan, self.osiotool_json("plan", "a.exr", "--to", "xyz", "--illuminant", light))
        self.assertEqual(self.osiotool("plan", "a.exr", "--to", "xyz", "--illuminant", "A,FL11").stdout.count("recipe"), 2)

    def test_one_light_has_its_name_too(self):
        self.osiotool("collapse", "a.exr", "x_{illuminant}.exr", "--to", "xyz", "--illuminant", "d65", "--quiet")
        self.assertIn("x_D65.exr", self.files())
        os.mkdir(self.path("A"))
        self.osiotool("collapse", "a.exr", "{illuminant}/x_{illuminant}.exr", "--to", "xyz", "--illuminant", "A", "--quiet")
        self.assertEqual(os.listdir(self.path("A")), ["x_A.exr"])

    def test_refusals_leave_nothing(self):
        self.write_exr("s.exr", self.bands(GRID, shape=(4, 4), prefix="S0", seed=2))
        before = self.files()
        for words, code, said in ((("a.exr", "o.png", "--illuminant", "A,D65"), 2, "{illuminant}"),
                                  (("a.exr", "o_{illuminant}.exr", "--illuminant", "A,,D65"), 2, "nothing between"),
                                  (("a.exr", "o_{illuminant}.exr", "--illuminant", "A,a"), 2, "twice"),
                                  (("a.exr", "o_{illuminant}.exr", "--illuminant", "A,D66"), 2, "did you mean"),
                                  (("s.exr", "o_{illuminant}.exr"), 2, "radiance"),
                                  (("s.exr", "o_{illuminant}.exr", "--illuminant", "A,D65"), 1, "illuminant")):
            result = self.osiotool("collapse", *words, "--to", "xyz", "-d", "float", code=code)
            self.assertIn(said, result.stderr, words)
            self.assertEqual(self.files(), before)
        self.assertIn("one is expected", self.osiotool("difference", "a.exr", "a.exr", "--illuminant", "A,D65", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
