# SPDX-License-Identifier: Apache-2.0
"""The reader inside stock OpenImageIO."""

import os
import shutil
import subprocess
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import FLOAT, HALF, UINT, OsioCase

GRID = list(range(400, 701, 20))


class Raw(OsioCase):
    """Bands as channels."""

    def test_order_is_rgba_then_wavelengths_then_the_rest(self):
        channels = {name: np.ones((3, 4)) for name in
                    ("A", "B", "G", "R", "S0.1000,0nm", "S0.400,000000nm", "S0.500,5nm", "Z", "id.x")}
        self.write_exr("a.spexr", channels)
        spec, _ = self.read("a.spexr")
        self.assertEqual(list(spec.channelnames), ["R", "G", "B", "A", "S0.400nm", "S0.500.5nm",
                                                   "S0.1000nm", "Z", "id.x"])
        self.assertEqual(spec.alpha_channel, 3)
        self.assertEqual(spec.z_channel, 7)
        spec, _ = self.read(f"{self.path('a.spexr')}?names=layout")
        self.assertEqual(list(spec.channelnames)[4:7], ["S0.400,000000nm", "S0.500,5nm", "S0.1000,0nm"])

    def test_every_way_to_say_raw(self):
        self.write_exr("a.exr", self.bands(GRID))
        shutil.copy(self.path("a.exr"), self.path("a.spexr"))
        with open(self.path("a.spectral"), "w") as recipe:
            recipe.write("source = a.exr\n")
        names = [self.read(self.path(n))[0].channelnames
                 for n in ("a.exr?to=raw", "a.spexr", "a.spexr?to=raw", "a.spectral", "a.exr?part=0")]
        for other in names[1:]:
            self.assertEqual(other, names[0])
        self.assertEqual(names[0][0], "T.400nm")

    def test_channels_can_be_chosen_by_name(self):
        bands = self.bands([450, 550, 650.5])
        self.write_exr("a.spexr", bands)
        self.check("oiiotool", "a.spexr", "--ch", "T.650.5nm,T.450nm", "-o", "two.exr")
        two = self.channels_of("two.exr")
        self.assertTrue(np.array_equal(two["T.650.5nm"], bands["T.650,5nm"]))
        self.assertTrue(np.array_equal(two["T.450nm"], bands["T.450nm"]))

    def test_pixels_and_types_are_those_of_the_built_in_reader(self):
        channels = dict(self.bands(GRID, shape=(40, 23)), R=np.zeros((40, 23)), A=np.ones((40, 23)),
                        id=np.arange(920).reshape(40, 23))
        types = {"R": HALF, "T.400nm": HALF, "T.420nm": FLOAT, "id": UINT}
        for tile in (0, 16):
            for compression in ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa",
                                "dwab"):
                with self.subTest(tile=tile, compression=compression):
                    self.write_exr("a.exr", channels, types=types, tile=tile, compression=compression,
                                   origin=(-3, 7), full=(0, 0, 100, 90))
                    shutil.copy(self.path("a.exr"), self.path("a.spexr"))
                    built_in, ours = self.read("a.exr")[0], self.read("a.spexr?names=layout")[0]
                    theirs = self.channels_of("a.exr")
                    for name, pixels in self.channels_of("a.spexr?names=layout").items():
                        self.assertTrue(np.array_equal(pixels, theirs[name]), name)
                    formats = [dict(zip(s.channelnames, s.channelformats)) for s in (built_in, ours)]
                    self.assertEqual(formats[0], formats[1])
                    for attribute in ("x", "y", "width", "height", "full_x", "full_y", "full_width",
                                      "full_height"):
                        self.assertEqual(getattr(built_in, attribute), getattr(ours, attribute))
                    self.assertEqual(ours.get_string_attribute("compression"), compression)

    def test_metadata_is_that_of_the_built_in_reader(self):
        attributes = [("owner", "me"), ("comments", "a picture"), ("smpte:TimeCode",
                      oiio.TypeTimeCode, (18356486, 4294967295)), ("smpte:KeyCode", oiio.TypeKeyCode,
                      (1, 2, 3, 4, 5, 6, 60)), ("PixelAspectRatio", 1.5), ("XResolution", 72.0),
                      ("expTime", 0.5), ("count", 7), ("ratio", 0.25), ("chromaticities",
                      oiio.TypeDesc("float[8]"), (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)),
                      ("worldToCamera", oiio.TypeMatrix, tuple(range(16))), ("direction",
                      oiio.TypeVector, (1, 2, 3)), ("weights", oiio.TypeDesc("float[3]"), (1, 2, 3)),
                      ("words", oiio.TypeDesc("string[2]"), ("a", "b")), ("rate", oiio.TypeRational,
                      (24000, 1001)), ("S0.400,0nm", "390nm:0;400nm:1;"), ("layer", "x,y;z")]
        self.write_exr("a.exr", self.bands(GRID), attributes=attributes)
        shutil.copy(self.path("a.exr"), self.path("a.spexr"))

        def metadata(name):
            spec = self.read(name)[0]
            return {a.name: a.value for a in spec.extra_attribs}
        theirs, ours = metadata("a.exr"), metadata("a.spexr")
        self.assertGreater(len(theirs), 20)
        for name, value in theirs.items():
            self.assertIn(name, ours)
            self.assertEqual(str(ours[name]), str(value), name)
        self.assertEqual(set(ours) - set(theirs), set())

    def test_duplicate_wavelengths_keep_names_of_their_own(self):
        channels = {n: np.full((2, 2), i) for i, n in enumerate(("T.400nm", "T.400,0nm", "T.4e2nm"))}
        self.write_exr("a.spexr", channels)
        names = self.read("a.spexr")[0].channelnames
        self.assertEqual(sorted(names), ["T.400.00nm", "T.400.0nm", "T.400nm"])

    def test_parts_are_subimages_and_can_be_chosen(self):
        specs, arrays = [], []
        for name, channels in (("beauty", ("R", "G", "B")), ("bands", ("T.400nm", "T.500,5nm")),
                               ("more", ("S0.600nm",))):
            spec = oiio.ImageSpec(6, 4, len(channels), FLOAT)
            spec.channelnames = channels
            spec.attribute("oiio:subimagename", name)
            specs.append(spec)
            arrays.append(np.random.default_rng(len(specs)).random((4, 6, len(channels)), np.float32))
        output = oiio.ImageOutput.create("openexr")
        self.assertTrue(output.open(self.path("a.spexr"), tuple(specs)))
        for i, (spec, array) in enumerate(zip(specs, arrays)):
            if i:
                self.assertTrue(output.open(self.path("a.spexr"), spec, "AppendSubimage"))
            output.write_image(array)
        output.close()
        for i, array in enumerate(arrays):
            spec, pixels = self.read("a.spexr", subimage=i)
            self.assertEqual(set(spec.channelnames), {c.replace(",", ".") for c in specs[i].channelnames})
            self.assertTrue(np.array_equal(np.sort(pixels, axis=-1), np.sort(array, axis=-1)))
            self.assertEqual(spec.get_string_attribute("oiio:subimagename"),
                             ("beauty", "bands", "more")[i])
        self.assertIn("3 subimages", self.check("iinfo", "a.spexr"))
        for part in ("1", "bands"):
            spec, _ = self.read(f"{self.path('a.spexr')}?part={part}")
            self.assertEqual(spec.channelnames, ("T.400nm", "T.500.5nm"))
            self.assertEqual(spec.get_int_attribute("oiio:subimages"), 1)
        image = oiio.ImageInput.open(self.path("a.spexr"))
        self.assertFalse(image.seek_subimage(3, 0))
        self.assertFalse(image.seek_subimage(0, 1))
        _, pixels = self.read(f"{self.path('a.spexr')}?to=xyz&part=more")
        self.assertEqual(pixels.shape, (4, 6, 3))


class Rows(OsioCase):
    """Any rows in any order."""

    def test_lines_one_by_one_backwards_and_at_random(self):
        self.write_exr("a.exr", self.bands(GRID, shape=(53, 11)), origin=(2, -20))
        for name in ("a.exr?to=lin_rec709&illuminant=D65", "a.exr?to=raw"):
            spec, whole = self.read(self.path(name))
            image = oiio.ImageInput.open(self.path(name))
            rows = list(range(53))
            for order in (rows, rows[::-1], np.random.default_rng(1).permutation(rows)):
                for row in order:
                    line = image.read_scanline(int(row) - 20, 0, FLOAT)
                    self.assertTrue(np.array_equal(line.reshape(11, -1), whole[row]), row)
            for first, end in ((0, 1), (3, 40), (15, 17), (16, 32), (50, 53)):
                some = image.read_scanlines(first - 20, end - 20, 0, 0, spec.nchannels, FLOAT)
                self.assertTrue(np.array_equal(some, whole[first:end]))

    def test_a_part_of_the_channels(self):
        self.write_exr("a.spexr", self.bands(GRID, shape=(20, 9)))
        _, whole = self.read("a.spexr")
        image = oiio.ImageInput.open(self.path("a.spexr"))
        self.assertTrue(np.array_equal(image.read_scanlines(3, 11, 0, 2, 5, FLOAT), whole[3:11, :, 2:5]))

    def test_through_the_image_cache(self):
        self.write_exr("a.exr", self.bands(GRID, shape=(200, 300)))
        name = f"{self.path('a.exr')}?to=acescg&illuminant=A"
        _, whole = self.read(name)
        cached = oiio.ImageBuf(name)
        self.assertTrue(np.array_equal(cached.get_pixels(FLOAT), whole))
        for threads in (1, 2, 5):
            oiio.attribute("threads", threads)
            self.assertTrue(np.array_equal(self.read(name)[1], whole))


class Collapsed(OsioCase):
    """What a host is told of a collapse."""

    def spec_of(self, query, name="a.exr"):
        return self.read(f"{self.path(name)}?{query}")[0]

    def test_windows_and_foreign_attributes_are_kept_and_band_attributes_are_not(self):
        attributes = [("smpte:TimeCode", oiio.TypeTimeCode, (18356486, 4294967295)), ("owner", "me"),
                      ("PixelAspectRatio", 2.0), ("spectralLayoutVersion", "1.0"), ("EV", 1.5),
                      ("cameraResponse", "400nm:1;"), ("T.400nm", "390nm:0;400nm:1;"), ("show", "dune")]
        self.write_exr("a.exr", self.bands(GRID), origin=(10, 20), full=(0, 0, 640, 480),
                       attributes=attributes)
        spec = self.spec_of("to=lin_rec709&illuminant=D65")
        self.assertEqual((spec.x, spec.y, spec.width, spec.height), (10, 20, 7, 5))
        self.assertEqual((spec.full_x, spec.full_y, spec.full_width, spec.full_height), (0, 0, 640, 480))
        self.assertEqual(spec.get_float_attribute("PixelAspectRatio"), 2.0)
        self.assertEqual(spec.getattribute("smpte:TimeCode"), self.read("a.exr")[0].getattribute("smpte:TimeCode"))
        self.assertEqual(spec.get_string_attribute("show"), "dune")
        names = {a.name for a in spec.extra_attribs}
        self.assertFalse(names & {"spectralLayoutVersion", "EV", "cameraResponse", "T.400nm"})

    def test_colour_spaces_are_named_where_one_is_true(self):
        self.write_exr("a.exr", self.bands(GRID))
        for to, tag, white in (("xyz", "", 1 / 3), ("xyz_d65", "lin_ciexyzd65_scene", 1 / 3),
                               ("lin_rec709", "lin_rec709", 0.3127), ("lin_p3d65", "lin_p3d65", 0.3127),
                               ("lin_rec2020", "lin_rec2020", 0.3127), ("acescg", "ACEScg", 0.32168),
                               ("aces2065_1", "ACES2065-1", 0.32168), ("srgb", "sRGB", 0.3127)):
            spec = self.spec_of(f"to={to}&illuminant=D65")
            self.assertEqual(spec.get_string_attribute("oiio:ColorSpace"), tag)
            self.assertAlmostEqual(spec.getattribute("chromaticities")[6], white, 6)
            self.assertEqual(spec.channelnames, ("R", "G", "B"))
            self.assertEqual(spec.format, oiio.TypeDesc(FLOAT))

    def test_the_recipe_says_how_it_was_made_and_repeats_it(self):
        self.write_exr("a.exr", self.bands(GRID))
        query = "to=acescg&illuminant=fl11&exposure=0.5"
        spec, pixels = self.read(f"{self.path('a.exr')}?{query}")
        recipe = spec.get_string_attribute("spectral:recipe")
        self.assertEqual(recipe, "to=acescg&illuminant=FL11&observer=cie1931&set=T&basis=auto"
                                 "&extrapolate=hold&scale=relative&adapt=bradford&exposure=0.5")
        again, same = self.read(f"{self.path('a.exr')}?{recipe}")
        self.assertTrue(np.array_equal(pixels, same))
        self.assertEqual(again.get_string_attribute("spectral:plan"),
                         spec.get_string_attribute("spectral:plan"))
        self.assertIn("extrapolated", spec.get_string_attribute("spectral:warnings"))

    def test_names_of_tristimulus_channels(self):
        self.write_exr("a.exr", dict(self.bands(GRID), A=np.ones((5, 7))))
        self.assertEqual(self.spec_of("to=xyz&illuminant=A").channelnames, ("R", "G", "B", "A"))
        spec = self.spec_of("to=xyz&illuminant=A&names=xyz")
        self.assertEqual(spec.channelnames, ("X", "Y", "Z", "A"))
        self.assertEqual(spec.alpha_channel, 3)

    def test_roots_have_their_own_alpha(self):
        channels = dict(self.bands(GRID, prefix="left.T"), **self.bands(GRID, prefix="right.T", seed=2))
        channels.update({"A": np.full((5, 7), 0.5), "left.A": np.full((5, 7), 0.25)})
        self.write_exr("a.exr", channels)
        for root, alpha in (("left", 0.25), ("right", 0.5)):
            _, pixels = self.read(f"{self.path('a.exr')}?to=xyz&illuminant=A&set={root}.T")
            self.assertTrue((pixels[..., 3] == alpha).all())


class Refusals(OsioCase):
    """Clear words on our own extensions; on queries by OSIO_DEBUG."""

    def error_of(self, name, **hints):
        config = oiio.ImageSpec()
        for key, value in hints.items():
            config.attribute(f"spectral:{key}", value)
        self.assertIsNone(oiio.ImageInput.open(self.path(name), config))
        return oiio.geterror()

    def test_words_on_our_own_extension(self):
        self.write_exr("t.spexr", self.bands(GRID))
        self.write_exr("s.spexr", self.bands(GRID, prefix="S0"))
        self.write_exr("rgb.spexr", {c: np.ones((2, 2)) for c in "RGB"})
        self.assertIn("is a reflectance, which has no colour without a light",
                      self.error_of("t.spexr", to="xyz"))
        self.assertIn("is a radiance, which already holds its light",
                      self.error_of("s.spexr", to="xyz", illuminant="A"))
        self.assertIn("no illuminant is called \"D66\"; did you mean", self.error_of("t.spexr", to="xyz",
                                                                             illuminant="D66"))
        self.assertIn("no output space is called \"lin_rec799\"; did you mean \"lin_rec709\"?",
                      self.error_of("t.spexr", to="lin_rec799"))
        self.assertIn("no option is called \"illumnant\"", self.error_of("t.spexr", illumnant="A"))
        self.assertIn("no spectral band among 3 channels", self.error_of("rgb.spexr", to="xyz"))
        self.assertIn("was given without a space to collapse to", self.error_of("t.spexr", illuminant="A"))

    def test_words_on_recipes(self):
        self.write_exr("t.exr", self.bands(GRID))
        for text, words in (("to = xyz\n", "a recipe needs a line source = FILE.exr"),
                            ("source = t.exr\nto xyz\n", "line 2: found \"to xyz\", expected key = value"),
                            ("source = t.exr\nillumnant = A\n", "line 2: no option is called"),
                            ("source = none.exr\n", "none.exr: No such file or directory"),
                            ("source = t.exr\nto = xyz\nilluminant = lamp.csv\n",
                             "lamp.csv: No such file or directory")):
            with open(self.path("a.spectral"), "w") as recipe:
                recipe.write(text)
            self.assertIn(words, self.error_of("a.spectral"))
            result = self.run_program("oiiotool", "a.spectral", "-o", "x.exr")
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(words, result.stdout + result.stderr)

    def test_queries_speak_through_osio_debug(self):
        self.write_exr("t.exr", self.bands(GRID))
        quiet = self.run_program("oiiotool", "t.exr?to=xyz", "-o", "x.exr")
        loud = self.run_program("oiiotool", "t.exr?to=xyz", "-o", "x.exr", env={"OSIO_DEBUG": "1"})
        for result in (quiet, loud):
            self.assertNotEqual(result.returncode, 0)
            self.assertNotIn("x.exr", self.files())
        self.assertNotIn("reflectance", quiet.stderr)
        self.assertIn("is a reflectance, which has no colour without a light", loud.stderr)

    def test_damaged_pixels_are_a_failed_read_with_words(self):
        whole = self.write_exr("t.exr", self.bands(GRID, shape=(100, 100)), compression="zip")
        with open(whole, "rb") as file:
            data = bytearray(file.read())
        data[len(data) // 2:len(data) // 2 + 64] = bytes(64)
        with open(self.path("bad.spexr"), "wb") as file:
            file.write(data)
        image = oiio.ImageInput.open(self.path("bad.spexr"))
        self.assertIsNone(image.read_image(FLOAT))
        self.assertTrue(image.geterror())
        for name in ("bad.spexr", "bad.spexr?to=xyz&illuminant=A"):
            self.assertNotEqual(self.run_program("oiiotool", name, "-o", "x.tif").returncode, 0)


class Door(OsioCase):
    """What is ours, what is not, and no waiting."""

    def test_a_plain_exr_stays_with_the_built_in_reader(self):
        self.write_exr("a.exr", self.bands(GRID))
        self.assertEqual(self.format_of("a.exr"), "openexr")
        self.assertEqual(self.format_of("a.exr?to=raw"), "spectralexr")
        spec, _ = self.read("a.exr", config=self.config_with_to())
        self.assertEqual(spec.nchannels, len(GRID))  # hints do not reach us on .exr

    def config_with_to(self):
        config = oiio.ImageSpec()
        config.attribute("spectral:to", "xyz")
        return config

    def test_other_files_are_not_ours(self):
        with open(self.path("a.spexr"), "w") as file:
            file.write("not an image")
        self.assertIsNone(oiio.ImageInput.open(self.path("a.spexr")))
        self.assertIn("is no OpenEXR file", oiio.geterror())
        self.check("oiiotool", "--create", "4x4", "3", "-o", "a.png")
        os.rename(self.path("a.png"), self.path("b.spexr"))
        self.assertEqual(self.format_of("b.spexr"), "png")  # a PNG by another name

    def test_a_file_may_have_a_question_mark_in_its_name(self):
        self.write_exr("odd?to=xyz.spexr", self.bands(GRID))
        self.assertEqual(self.read("odd?to=xyz.spexr")[0].nchannels, len(GRID))

    def test_the_try_all_path_never_hangs(self):
        # OpenImageIO 2.4 holds its registry's lock there: a reader that asks it anything waits forever.
        self.write_exr("a.exr", self.bands(GRID))
        for name in ("a.exr?to=xyz&illuminant=A", "a.exr?to=nonsense", "missing.exr?to=xyz", "a.exr?x=y",
                     "a.exr?to=xyz"):
            self.run_program("oiiotool", name, "-o", "x.exr", timeout=20)
        script = ("import OpenImageIO as o, threading\n"
                  "def go():\n"
                  "  for _ in range(10):\n"
                  f"    i = o.ImageInput.open({self.path('a.exr')!r} + '?to=xyz&illuminant=A')\n"
                  "    assert i.read_image(o.FLOAT) is not None\n"
                  "go()  # the binding's first array, made by two threads at once, deadlocks in pybind11\n"
                  "t = [threading.Thread(target=go) for _ in range(8)]\n"
                  "[x.start() for x in t]; [x.join() for x in t]\n")
        self.check("/usr/bin/python3", "-c", script, timeout=60)

    def test_hints_are_read_by_value_whatever_their_type(self):
        self.write_exr("a.spexr", self.bands(GRID))
        self.write_exr("b.spexr", {"R": np.ones((2, 2))})
        config = oiio.ImageSpec()
        config.attribute("spectral:to", "lin_rec709")
        config.attribute("spectral:illuminant", "D65")
        pixels = {}
        for value in (1, 1.0, "1"):
            config.attribute("spectral:exposure", value)
            pixels[str(type(value))] = self.read("a.spexr", config=config)[1]
        first, *others = pixels.values()
        for other in others:
            self.assertTrue(np.array_equal(first, other))

    def test_precedence_is_query_then_hint_then_recipe(self):
        self.write_exr("a.exr", self.bands(GRID))
        with open(self.path("a.spectral"), "w") as recipe:
            recipe.write("source = a.exr\nto = xyz\nilluminant = A\nexposure = 1\n")
        config = oiio.ImageSpec()
        config.attribute("spectral:illuminant", "D65")
        spec, _ = self.read("a.spectral", config=config)
        self.assertIn("illuminant=D65", spec.get_string_attribute("spectral:recipe"))
        self.assertIn("exposure=1", spec.get_string_attribute("spectral:recipe"))
        spec, _ = self.read(f"{self.path('a.spectral')}?illuminant=FL11&to=acescg", config=config)
        self.assertIn("to=acescg&illuminant=FL11", spec.get_string_attribute("spectral:recipe"))

    def test_tables_of_the_user_are_seen_from_the_recipe(self):
        os.mkdir(self.path("shots"))
        self.write_exr("shots/a.exr", self.bands(GRID))
        with open(self.path("shots/lamp.csv"), "w") as table:
            table.write("nm,power\n380,1\n780,3\n")
        with open(self.path("shots/a.spectral"), "w") as recipe:
            recipe.write("source = a.exr   # beside this file\nto = xyz\nilluminant = lamp.csv\n")
        _, from_recipe = self.read("shots/a.spectral")
        _, from_query = self.read(f"{self.path('shots/a.exr')}?to=xyz"
                                  f"&illuminant={self.path('shots/lamp.csv')}")
        self.assertTrue(np.array_equal(from_recipe, from_query))

    def test_sequences_of_recipes(self):
        for frame in (1, 2, 3):
            self.write_exr(f"shot.{frame:04d}.exr", self.bands(GRID, seed=frame))
            with open(self.path(f"shot.{frame:04d}.spectral"), "w") as recipe:
                recipe.write(f"source = shot.{frame:04d}.exr\nto = acescg\nilluminant = D65\n")
        self.check("oiiotool", "shot.#.spectral", "-o", "out.#.exr")
        self.check("oiiotool", "--frames", "1-3", "shot.#.exr?to=acescg&illuminant=D65", "-o",
                   "query.#.exr")
        for frame in (1, 2, 3):
            self.assertIn("PASS", self.check("idiff", f"out.{frame:04d}.exr", f"query.{frame:04d}.exr"))

    def test_only_the_six_names_are_exported(self):
        folder = os.environ["OIIO_LIBRARY_PATH"].split(":")[0]
        symbols = subprocess.run(["nm", "-D", "--defined-only", f"{folder}/spectralexr.imageio.so"],
                                 capture_output=True, text=True, check=True).stdout
        names = {line.split()[-1] for line in symbols.splitlines()}
        self.assertEqual(names, {"spectralexr_imageio_version", "spectralexr_imageio_library_version",
                                 "spectralexr_input_imageio_create", "spectralexr_input_extensions",
                                 "spectralexr_output_imageio_create", "spectralexr_output_extensions"})


if __name__ == "__main__":
    unittest.main()
