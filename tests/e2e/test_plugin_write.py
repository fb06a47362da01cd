# SPDX-License-Identifier: Apache-2.0
"""The writer inside stock OpenImageIO."""

import os
import shutil
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import FLOAT, HALF, UINT, OsioCase, format_comma, oracle_xyz

GRID = list(range(400, 701, 20))
REC709 = np.array([[3.2409699419, -1.5373831776, -0.4986107603], [-0.9692436363, 1.8759675015, 0.0415550574],
                   [0.0556300797, -0.2039769589, 1.0569715142]])


class RoundTrip(OsioCase):
    """Nothing lost on the way through oiiotool and Python."""

    def expect_same(self, source, result):
        before, after = self.channels_of(f"{source}?names=layout"), self.channels_of(f"{result}?names=layout")
        self.assertEqual({self.canonical(n) for n in before}, set(after))
        for name, pixels in before.items():
            self.assertTrue(np.array_equal(pixels, after[self.canonical(name)], equal_nan=True), name)

    @staticmethod
    def canonical(name):
        return name.replace(",000000nm", "nm").replace(",500000nm", ",5nm")

    def source(self, **more):
        channels = dict({n.replace("nm", ",000000nm"): v for n, v in self.bands(GRID, shape=(33, 21)).items()},
                        A=np.full((33, 21), 0.5), Z=np.full((33, 21), 9))
        channels["T.410,500000nm"] = channels["T.400,000000nm"] * 2
        self.write_exr("in.exr", channels, **more)
        shutil.copy(self.path("in.exr"), self.path("in.spexr"))

    def test_the_three_ways_to_write(self):
        self.source()
        self.check("oiiotool", "in.spexr", "-o", "out.spexr")
        self.check("oiiotool", "in.spexr", "-o:fileformatname=spectralexr", "out.exr")
        buffer = oiio.ImageBuf(self.path("in.spexr"))
        self.assertTrue(buffer.write(self.path("python.exr"), "unknown", "spectralexr"), buffer.geterror())
        for name in ("out.spexr", "out.exr", "python.exr"):
            self.expect_same("in.spexr", name)
            channels = self.exr_channels(name)
            self.assertIn("T.410,5nm", channels)
            self.assertIn("T.400nm", channels)
            self.assertIn("Z", channels)

    def test_the_built_in_readers_channels_are_taken_too(self):
        self.source()
        self.check("oiiotool", "in.exr", "-o", "out.spexr")
        self.expect_same("in.spexr", "out.spexr")

    def test_types_a_channel(self):
        words = {HALF: "16-bit floating-point", FLOAT: "32-bit floating-point",
                 UINT: "32-bit unsigned integer"}
        channels = dict(self.bands(GRID), A=np.ones((5, 7)), id=np.ones((5, 7)))
        types = {n: (HALF if i % 2 else FLOAT) for i, n in enumerate(channels)}
        types["id"] = UINT
        self.write_exr("in.spexr", channels, types=types)
        # A copy through the API keeps a type a channel; oiiotool 2.4 itself makes them one type.
        source = oiio.ImageInput.open(self.path("in.spexr"))
        output = oiio.ImageOutput.create("spectralexr")
        self.assertTrue(output.open(self.path("out.spexr"), source.spec()), output.geterror())
        self.assertTrue(output.copy_image(source), output.geterror())
        self.assertTrue(output.close())
        self.assertEqual(self.exr_channels("out.spexr"), {n: words[t] for n, t in types.items()})
        self.expect_same("in.spexr", "out.spexr")
        self.check("oiiotool", "in.spexr", "-d", "half", "-o", "half.spexr")
        self.assertEqual(set(self.exr_channels("half.spexr").values()), {words[HALF]})
        self.check("oiiotool", "in.spexr", "-d", "half", "-d", "T.420nm=float", "-o", "d.spexr")
        named = self.exr_channels("d.spexr")
        self.assertEqual((named["T.400nm"], named["T.420nm"]), (words[HALF], words[FLOAT]))

    def test_every_compression(self):
        self.source()
        for compression in ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"):
            self.check("oiiotool", "in.spexr", "--compression", compression, "-o", "out.spexr")
            self.assertEqual(self.read("out.spexr")[0].get_string_attribute("compression"), compression)
            if compression in ("none", "rle", "zips", "zip", "piz"):
                self.expect_same("in.spexr", "out.spexr")

    def test_windows_and_attributes(self):
        attributes = [("smpte:TimeCode", oiio.TypeTimeCode, (18356486, 4294967295)), ("owner", "me"),
                      ("PixelAspectRatio", 1.5), ("count", 7), ("spectralLayoutVersion", "1.0"),
                      ("worldToCamera", oiio.TypeMatrix, tuple(range(16))), ("lensTransmission", "400nm:1;400nm:1"),
                      ("words", oiio.TypeDesc("string[2]"), ("a", "b")), ("EV", 1.25),
                      ("weights", oiio.TypeDesc("float[3]"), (1, 2, 3)), ("rate", oiio.TypeRational,
                      (24000, 1001)), ("T.400,000000nm", "390nm:0;400nm:1;")]
        self.source(origin=(-4, 9), full=(0, 0, 100, 50), attributes=attributes)
        self.check("oiiotool", "in.spexr", "-o", "out.spexr")
        before, after = self.read("in.spexr")[0], self.read("out.spexr")[0]
        for field in ("x", "y", "width", "height", "full_x", "full_y", "full_width", "full_height"):
            self.assertEqual(getattr(before, field), getattr(after, field))
        kept = {a.name: str(a.value) for a in after.extra_attribs}
        for attribute in before.extra_attribs:
            if attribute.name in ("T.400,000000nm", "Software", "Exif:ImageHistory", "DateTime"):
                continue
            self.assertEqual(kept.get(attribute.name), str(attribute.value), attribute.name)
        self.assertEqual(kept["T.400nm"], "390nm:0;400nm:1;400nm:1")  # follows its band's name
        self.assertNotIn("T.400,000000nm", kept)

    def test_layout_attributes_are_there_where_they_belong(self):
        plain = {"T.500nm": np.ones((2, 2))}
        for channels, expected in ((plain, {"spectralLayoutVersion": "1.0"}),
                                   ({"S0.500nm": np.ones((2, 2))}, {"emissiveUnits": "W.m^-2.sr^-1"}),
                                   ({"S0.500nm": np.ones((2, 2)), "S1.500nm": np.ones((2, 2))},
                                    {"emissiveUnits": "W.m^-2.sr^-1", "polarisationHandedness": "right"})):
            self.write_exr("out.spexr", channels, writer="spectralexr")
            spec = self.read("out.spexr")[0]
            names = ("spectralLayoutVersion", "emissiveUnits", "polarisationHandedness")
            found = {n: spec.get_string_attribute(n) for n in names if spec.get_string_attribute(n)}
            self.assertEqual(found, dict({"spectralLayoutVersion": "1.0"}, **expected))
        self.write_exr("out.spexr", {"S0.500nm": np.ones((2, 2))}, writer="spectralexr",
                       attributes=[("emissiveUnits", "W.m^-2.sr^-1.nm^-1")])
        self.assertEqual(self.read("out.spexr")[0].get_string_attribute("emissiveUnits"),
                         "W.m^-2.sr^-1.nm^-1")

    def test_names_are_canonical(self):
        channels = {n: np.full((2, 2), i) for i, n in enumerate(
            ("left.T.0,55um", "T.400.5nm", "T.400,25nm", "T.500nm.600.5nm", "S0.545THz", "depth.Z"))}
        self.write_exr("out.spexr", channels, writer="spectralexr")
        self.assertEqual(set(self.exr_channels("out.spexr")),
                         {"left.T.550nm", "T.400,5nm", "T.400,25nm", "T.500nm.600,5nm",
                          f"S0.{format_comma(299792458e9 / 545e12)}nm", "depth.Z"})

    def test_duplicate_wavelengths_survive(self):
        channels = {n: np.full((2, 2), i) for i, n in enumerate(("T.400nm", "T.400,0nm", "T.4e2nm"))}
        self.write_exr("in.spexr", channels)
        self.check("oiiotool", "in.spexr", "-o", "out.spexr")
        values = sorted(float(v[0, 0]) for v in self.channels_of("out.spexr").values())
        self.assertEqual(values, [0, 1, 2])

    def test_unknown_attribute_types_are_carried(self):
        # A type that nobody knows, patched into a header over one of the same length.
        self.write_exr("in.spexr", self.bands(GRID), attributes=[("mystery", "four")])
        with open(self.path("in.spexr"), "rb") as file:
            data = file.read()
        with open(self.path("in.spexr"), "wb") as file:
            file.write(data.replace(b"mystery\0string\0", b"mystery\0riddle\0"))
        self.check("oiiotool", "in.spexr", "-o", "out.spexr")
        with open(self.path("out.spexr"), "rb") as file:
            self.assertIn(b"mystery\0riddle\0\x04\0\0\0four", file.read())


class Preview(OsioCase):
    """R, G, B beside bands stay while they show the bands, and only then."""

    def setUp(self):
        super().setUp()
        bands = self.bands(GRID, shape=(40, 50))
        values = np.stack(list(bands.values()), axis=-1)
        rgb = np.maximum(values @ oracle_xyz(GRID, "D65").T @ REC709.T, 0)
        channels = dict(bands, **{c: rgb[..., i] for i, c in enumerate("RGB")}, A=np.ones((40, 50)))
        self.write_exr("in.spexr", channels, attributes=[("chromaticities", oiio.TypeDesc("float[8]"),
                       (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329))])
        shutil.copy(self.path("in.spexr"), self.path("in.exr"))

    def write(self, *commands, source="in.spexr"):
        result = self.run_program("oiiotool", source, *commands, "-o", "out.spexr")
        self.assertEqual(result.returncode, 0, result.stderr)
        kept = "R" in self.exr_channels("out.spexr")
        warned = "R, G, B no longer match the bands" in result.stderr
        self.assertNotEqual(kept, warned, result.stderr)
        self.assertEqual(self.exr_channels("out.spexr").get("A") is not None, True)
        self.assertEqual(bool(self.read("out.spexr")[0].getattribute("chromaticities")), kept)
        return kept

    def mulc(self, rgb, bands, one=None):
        factors = [rgb] * 3 + [1] + [bands] * len(GRID)
        if one is not None:
            factors[4 + one] *= 3
        return "--mulc", ",".join(map(str, factors))

    def test_untouched_cropped_resized_and_brighter_images_keep_it(self):
        self.assertTrue(self.write())
        self.assertTrue(self.write("--cut", "20x20+5+5"))
        self.assertTrue(self.write("--resize", "25x20"))
        self.assertTrue(self.write("--blur", "3x3"))
        self.assertTrue(self.write(*self.mulc(2, 2)))
        self.assertTrue(self.write("-d", "half"))
        self.assertTrue(self.write(source="in.exr"))

    def test_edited_bands_or_pictures_lose_it(self):
        self.assertFalse(self.write(*self.mulc(1, 0.5)))
        self.assertFalse(self.write(*self.mulc(0.5, 1)))
        self.assertFalse(self.write(*self.mulc(1, 1, one=8)))
        self.assertFalse(self.write("--powc", "2"))
        self.assertFalse(self.write("--invert"))

    def test_dropped_bands_lose_it(self):
        kept = ",".join(["R", "G", "B", "A"] + [f"T.{nm}nm" for nm in GRID[:8]])
        self.assertFalse(self.write("--ch", kept))

    def test_a_painted_region_loses_it(self):
        buffer = oiio.ImageBuf(self.path("in.spexr"))
        buffer.read(force=True)
        pixels = buffer.get_pixels(FLOAT)
        pixels[10:14, 10:14, 4:] = 0
        buffer.set_pixels(buffer.roi, pixels)
        self.assertTrue(buffer.write(self.path("out.spexr")))
        self.assertNotIn("R", self.exr_channels("out.spexr"))

    def test_the_file_may_replace_its_own_source(self):
        buffer = oiio.ImageBuf(self.path("in.spexr"))
        buffer.read(force=True)
        self.assertTrue(buffer.write(self.path("in.spexr")))
        self.assertIn("R", self.exr_channels("in.spexr"))
        self.check("oiiotool", "in.spexr", "-o", "in.spexr")
        self.assertIn("R", self.exr_channels("in.spexr"))


class Regenerated(OsioCase):
    """The hint spectral:preview makes R, G, B of the bands."""

    def same_as_collapse(self, name, *words):
        self.osiotool("collapse", name, "rgb.exr", "--to", "lin_rec709", *words)
        picture, expected = self.channels_of(name), self.channels_of("rgb.exr")
        for channel in "RGB":
            np.testing.assert_array_equal(picture[channel].view(np.uint32), expected[channel].view(np.uint32))

    def test_edited_bands_have_a_picture_of_their_own(self):
        bands = self.bands(GRID, (40, 50))
        self.write_exr("in.spexr", dict(bands, **{c: bands["T.400nm"] for c in "RGB"}, A=np.ones((40, 50))))
        for words in ((), ("--tile", "16", "16"), ("--compression", "dwaa"), ("-d", "half")):
            result = self.run_program("oiiotool", "in.spexr", "--mulc", "0.5", "--powc", "2", "--attrib", "spectral:preview",
                                      "D50", *words, "-o", "out.spexr")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            spec = self.read("out.spexr")[0]
            self.assertEqual(spec.get_string_attribute("spectral:preview"), "")
            self.assertIn("illuminant=D50", spec.get_string_attribute("spectral:previewRecipe"))
            if "dwaa" not in words and "half" not in words:
                self.same_as_collapse("out.spexr", "--illuminant", "D50")
        # It is a preview as any other: kept where nothing changed, left out where something did.
        self.check("oiiotool", "out.spexr", "-o", "kept.spexr")
        self.assertIn("R", self.exr_channels("kept.spexr"))
        result = self.run_program("oiiotool", "out.spexr", "--powc", "2", "-o", "dropped.spexr")
        self.assertIn("no longer match", result.stderr)
        self.assertEqual(self.read("dropped.spexr")[0].get_string_attribute("spectral:previewRecipe"), "")

    def test_bands_that_had_none(self):
        self.write_exr("in.spexr", self.bands(GRID, prefix="S0"))
        self.check("oiiotool", "in.spexr", "--attrib", "spectral:preview", "none", "-o", "out.spexr")
        self.same_as_collapse("out.spexr")
        result = self.run_program("oiiotool", "in.spexr", "--attrib", "spectral:preview", "D65", "-o", "no.spexr")
        self.assertNotEqual(result.returncode, 0)
        self.assertNotIn("no.spexr", self.files())


class Parts(OsioCase):
    """Tiles and several subimages, in and out."""

    def pixels(self, name, **options):
        return {n: np.ascontiguousarray(p).view(np.uint32) for n, p in self.channels_of(name, **options).items()}

    def assert_same(self, a, b):
        self.assertEqual(sorted(a), sorted(b))
        for name in a:
            np.testing.assert_array_equal(a[name], b[name], name)

    def test_tiles_go_out_and_come_in(self):
        self.write_exr("in.spexr", dict(self.bands(GRID, (70, 45)), A=np.full((70, 45), 0.5)), origin=(-4, 9))
        for tile in ((16, 16), (64, 8), (128, 128)):
            for compression in ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"):
                self.check("oiiotool", "in.spexr", "--compression", compression, "--tile", *tile, "-o", "out.spexr")
                self.assertEqual(self.format_of("out.spexr"), "spectralexr")
                spec = self.read("out.spexr")[0]
                self.assertEqual((spec.tile_width, spec.tile_height), tile)
                if compression in ("none", "rle", "zips", "zip", "piz"):
                    self.assert_same(self.pixels("out.spexr"), self.pixels("in.spexr"))
                    shutil.copy(self.path("out.spexr"), self.path("out.exr"))
                    layout = {n.replace(".5nm", ",5nm"): p for n, p in self.pixels("in.spexr").items()}
                    self.assert_same(self.pixels("out.exr"), layout)
        self.assertIn("with a checksum", self.osiotool("verify", "out.spexr").stdout)
        image = oiio.ImageInput.open(self.path("out.spexr"))
        tile = image.read_tile(-4, 9, 0)
        self.assertEqual(tile.shape[:2], (128, 128))
        self.assertIsNone(image.read_tile(-3, 9, 0))

    def test_a_tiled_file_of_openexr_is_tiled_here_too(self):
        self.write_exr("in.exr", self.bands(GRID, (50, 41)), tile=32, types=HALF)
        shutil.copy(self.path("in.exr"), self.path("in.spexr"))
        self.assertEqual(self.read("in.spexr")[0].tile_width, 32)
        self.assert_same(self.pixels("in.spexr"), self.pixels("in.exr"))
        self.check("oiiotool", "in.spexr", "--resize", "20x20", "-o", "small.spexr")
        self.check("oiiotool", "in.spexr", "--scanline", "-o", "lines.spexr")
        self.assertEqual(self.read("lines.spexr")[0].tile_width, 0)
        self.assert_same(self.pixels("lines.spexr"), self.pixels("in.exr"))

    def test_subimages_become_parts(self):
        first = dict(self.bands(GRID, (20, 30)), A=np.ones((20, 30)))
        second = self.bands([500.5, 600], (20, 30), prefix="S0")
        self.write_exr("a.spexr", first, attributes=[("oiio:subimagename", "left")])
        self.write_exr("b.spexr", second, types=HALF)
        self.write_exr("c.exr", {c: np.ones((20, 30)) for c in "RGB"})
        for words in ((), ("--compression", "piz"), ("--tile", "8", "8")):
            self.check("oiiotool", "c.exr", "a.spexr", "--siappend", "b.spexr", "--siappend", *words, "-o", "out.spexr")
            info = self.osiotool_json("info", "out.spexr")["parts"]
            self.assertEqual([len(p["sets"]) for p in info], [0, 1, 1])
            self.assert_same(self.pixels("out.spexr", subimage=1), self.pixels("a.spexr"))
            self.assert_same(self.pixels("out.spexr", subimage=2), self.pixels("b.spexr"))
            self.assertEqual(set(self.exr_channels("out.spexr")), {"R", "G", "B", "A", "S0.500,5nm", "S0.600nm"}
                             | {f"T.{nm}nm" for nm in GRID})
            self.assertIn("with a checksum", self.osiotool("verify", "out.spexr").stdout)
        self.check("oiiotool", "out.spexr", "-a", "-o", "again.spexr")
        self.assertEqual(len(self.osiotool_json("info", "again.spexr")["parts"]), 3)

    def test_a_stale_preview_goes_from_one_of_several(self):
        bands = self.bands(GRID, (20, 30))
        self.write_exr("a.spexr", dict(bands, **{c: np.random.default_rng(4).random((20, 30)) for c in "RGB"}))
        self.write_exr("b.spexr", bands)
        result = self.run_program("oiiotool", "a.spexr", "--powc", "2", "b.spexr", "--siappend", "-o", "out.spexr")
        self.assertIn("no longer match", result.stderr)
        self.assertNotIn("R", self.exr_channels("out.spexr"))
        self.assert_same(self.pixels("out.spexr", subimage=1), self.pixels("b.spexr"))


class Failure(OsioCase):
    """Clear words, and the old file stays."""

    def test_an_image_without_bands_is_refused(self):
        result = self.run_program("oiiotool", "--create", "4x4", "3", "-o", "out.spexr")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("none of 3 channels is a band; expected names such as T.450nm",
                      result.stdout + result.stderr)
        self.assertEqual(self.files(), [])

    def test_rows_out_of_order_and_missing_rows(self):
        spec = oiio.ImageSpec(4, 4, 1, FLOAT)
        spec.channelnames = ("T.500nm",)
        with open(self.path("out.spexr"), "w") as file:
            file.write("old")
        output = oiio.ImageOutput.create("spectralexr")
        self.assertTrue(output.open(self.path("out.spexr"), spec))
        row = np.ones((4, 1), np.float32)
        self.assertTrue(output.write_scanline(0, 0, row))
        self.assertFalse(output.write_scanline(3, 0, row))
        self.assertIn("expected row 1 next", output.geterror())
        self.assertFalse(output.close())
        self.assertIn("3 rows were never written", output.geterror())
        with open(self.path("out.spexr")) as file:
            self.assertEqual(file.read(), "old")
        self.assertEqual(self.files(), ["out.spexr"])

    def test_what_is_not_supported_is_not_claimed(self):
        output = oiio.ImageOutput.create("spectralexr")
        for feature in ("mipmap", "appendsubimage", "volumes", "rectangles", "random_access", "deepdata",
                        "rewrite", "procedural", "ioproxy"):
            self.assertFalse(output.supports(feature), feature)
        for feature in ("alpha", "nchannels", "channelformats", "displaywindow", "origin",
                        "negativeorigin", "arbitrary_metadata", "tiles", "multiimage"):
            self.assertTrue(output.supports(feature), feature)

    def test_subimages_without_bands_are_refused(self):
        for name in ("a.exr", "b.exr"):
            self.write_exr(name, {c: np.ones((2, 2)) for c in "RGB"})
        result = self.run_program("oiiotool", "a.exr", "b.exr", "--siappend", "-o", "out.spexr")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("none of 2 subimages has a band", result.stdout + result.stderr)
        self.assertEqual(self.files(), ["a.exr", "b.exr"])

    def test_subimages_that_never_come(self):
        spec = oiio.ImageSpec(4, 4, 1, FLOAT)
        spec.channelnames = ("T.500nm",)
        output = oiio.ImageOutput.create("spectralexr")
        self.assertTrue(output.open(self.path("out.spexr"), (spec, spec)), output.geterror())
        self.assertTrue(output.write_image(np.ones((4, 4, 1), np.float32)))
        self.assertFalse(output.close())
        self.assertIn("4 rows were never written", output.geterror())
        self.assertEqual(self.files(), [])

    def test_tiles_out_of_order(self):
        spec = oiio.ImageSpec(8, 8, 1, FLOAT)
        spec.channelnames = ("T.500nm",)
        spec.tile_width = spec.tile_height = 4
        output = oiio.ImageOutput.create("spectralexr")
        self.assertTrue(output.open(self.path("out.spexr"), spec))
        tile = np.ones((4, 4, 1), np.float32)
        self.assertTrue(output.write_tile(0, 0, 0, tile))
        self.assertFalse(output.write_tile(0, 4, 0, tile))
        self.assertIn("expected the one at 4, 0 next", output.geterror())
        self.assertFalse(output.close())
        self.assertEqual(self.files(), [])

    def test_a_folder_that_cannot_be_written(self):
        buffer = oiio.ImageBuf(oiio.ImageSpec(4, 4, 1, FLOAT))
        buffer.specmod().channelnames = ("T.500nm",)
        self.assertFalse(buffer.write(self.path("no/such/folder/out.spexr")))
        self.assertIn("cannot be written", buffer.geterror())


if __name__ == "__main__":
    unittest.main()
