# SPDX-License-Identifier: Apache-2.0
"""osiotool convert: every format to every other and back, and what convert makes of bands on the way."""

import json
import os
import signal
import subprocess
import time
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import HALF, OSIOTOOL, OsioCase, format_comma

GRID = list(range(400, 701, 20))


class ConvertCase(OsioCase):
    def bits(self, name, **options):
        return {channel: np.ascontiguousarray(plane).view(np.uint32)
                for channel, plane in self.channels_of(name, **options).items()}

    def raw(self, name, **options):
        """Bits of the bands of any format, through the one reader that gives samples of all of them."""
        return self.bits(f"{self.path(name)}?to=raw", **options)

    def assert_same(self, a, b):
        self.assertEqual(sorted(a), sorted(b))
        for channel in a:
            np.testing.assert_array_equal(a[channel], b[channel], channel)

    def sets(self, name):
        return self.osiotool_json("info", name)["parts"][0]["sets"]


class Format:
    """A format of the matrix: `ending` of its files, `words` that convert takes for it, `bits` that it keeps of a
    float's significand, whether it holds `everything` or the bands of one set, and `most` bands."""

    def __init__(self, ending, *words, bits=24, everything=False):
        self.ending, self.words, self.bits, self.everything = ending, words, bits, everything

    def name(self, stem):
        return stem + self.ending


# Every format that is written, one a line.
FORMATS = [
    Format(".exr", everything=True),
    Format(".exr", "--tile", "16x8", "--compression", "piz", everything=True),
    Format(".exr", "--half", bits=11, everything=True),
    Format(".hdr", "--interleave", "bsq"),
    Format(".hdr", "--interleave", "bil"),
    Format(".hdr", "--interleave", "bip"),
    Format(".tif"),
]


class Matrix(ConvertCase):
    def rounded(self, planes, bits):
        if bits == 24:
            return planes
        return {name: plane.view(np.float32).astype(np.float16).astype(np.float32).view(np.uint32)
                for name, plane in planes.items()}

    def check_matrix(self, source, formats=FORMATS):
        """From the source to each, from there to each, and back: the bits that the narrowest of them keeps."""
        before = self.raw(source)
        sets = self.sets(source)
        for i, first in enumerate(formats):
            there = first.name(f"first{i}")
            report = self.osiotool_json("convert", source, there, *first.words)
            self.assertEqual(report["bands"], sets[0]["bands"])
            self.assertEqual("digits of floats beyond the 11 bits of a half" in report["lost"], first.bits == 11)
            self.assert_same(self.raw(there), self.rounded(before, first.bits))
            for j, second in enumerate(formats):
                words = (source, i, j, *first.words, *second.words)
                back = second.name(f"second{j}")
                self.osiotool("convert", there, back, *second.words)
                self.assert_same(self.raw(back), self.rounded(before, min(first.bits, second.bits)))
                found = self.sets(back)[0]
                for key in ("name", "quantity", "wavelengths_nm", "units"):
                    self.assertEqual(found[key], sets[0][key], words)
                for path in self.files():
                    if path.startswith("second"):
                        os.remove(self.path(path))

    def source(self, nm, prefix="T", shape=(19, 21), seed=1):
        self.write_exr("shot.exr", self.bands(nm, shape, seed, prefix), attributes=[
            ("spectralLayoutVersion", "1.0"), ("spectral:fwhm", "12"), ("take", 7), ("ISOSpeed", 125.5), ("note", "a, b")]
            + ([("emissiveUnits", "W.m^-2.sr^-1")] if prefix == "S0" else []))
        return "shot.exr"

    def test_reflectance_to_every_format_and_back(self):
        self.check_matrix(self.source([400.5, *range(410, 700, 10)]))

    def test_radiance_to_every_format_and_back(self):
        self.check_matrix(self.source(GRID, prefix="S0"))

    def test_beyond_1000_nm(self):
        self.check_matrix(self.source([395.3, 998.5, 1000, 1004.75, 1650, 2500.25]))

    def test_900_bands(self):
        self.check_matrix(self.source([350 + 2.5 * i for i in range(900)], shape=(3, 5)), FORMATS[1:4])

    def test_4098_bands(self):
        self.check_matrix(self.source([350 + 0.25 * i for i in range(4098)], shape=(2, 3)), [FORMATS[0], FORMATS[3]])

    def test_band_files_to_every_format_and_back(self):
        nm = [400, 450.5, 500, 1004.75]
        source = self.source(nm)
        before = self.raw(source)

        def steps(planes):
            """What 16 bits keep of shares from 0 to 1."""
            return {name: (np.rint(plane.view(np.float32).astype(float) * 65535) / 65535).astype(np.float32).view(np.uint32)
                    for name, plane in planes.items()}

        for kind, kept in ((".exr", dict), (".tif", dict), (".png", steps)):
            def stack_of(name, kind=kind):
                self.osiotool("convert", name, "b_{nm}" + kind, "--split", "bands")
                return self.write_table("b.stack", "#spectral-stack", *(f"b_{w}{kind}, {w}" for w in nm))

            stack_of(source)
            self.assert_same(self.raw("b.stack"), kept(before))
            for i, there in enumerate(FORMATS):
                name = there.name(f"there{i}")
                self.osiotool("convert", "b.stack", name, *there.words)
                self.assert_same(self.raw(name), self.rounded(kept(before), there.bits))
                self.assertEqual(self.sets(name)[0]["wavelengths_nm"], nm)
            for i, first in enumerate(FORMATS):
                stack_of(first.name(f"there{i}"))
                self.assert_same(self.raw("b.stack"), kept(self.rounded(kept(before), first.bits)))

    def test_attributes_come_back_from_every_format(self):
        source = self.source(GRID)
        expected = [line for line in self.check("exrheader", source).splitlines()
                    if line.split(" ")[0] in ("take", "ISOSpeed", "note", "spectralLayoutVersion")]
        self.assertEqual(len(expected), 4)
        for i, there in enumerate(FORMATS):
            name = there.name(f"there{i}")
            self.assertEqual([lost for lost in self.osiotool_json("convert", source, name, *there.words)["lost"]
                              if "attribute" in lost], [])
            self.osiotool("convert", name, "back.exr")
            back = self.check("exrheader", "back.exr").splitlines()
            for line in expected:
                self.assertIn(line, back, there.words)
            widths = oiio.ImageBuf(self.path("back.exr")).spec().get_string_attribute("spectral:fwhm")
            self.assertIn(widths, ("12", "".join(f"{nm}nm:12;" for nm in GRID)))


class Resample(ConvertCase):
    def values(self, name, nm, prefix="T"):
        channels = self.channels_of(name)
        return np.stack([channels[f"{prefix}.{format_comma(w)}nm"] for w in nm], axis=-1)

    def test_straight_lines_against_numpy(self):
        nm = [400, 410, 425, 470, 520, 600]
        bands = self.bands(nm, (33, 20))
        self.write_exr("shot.exr", bands)
        for words, hold in (((), True), (("--extrapolate", "zero"), False)):
            report = self.osiotool_json("convert", "shot.exr", "out.exr", "--resample", "380:15:620", "--basis", "linear", *words)
            new = list(range(380, 621, 15))
            old = np.stack(list(bands.values()), axis=-1).astype(float)
            outside = {} if hold else {"left": 0, "right": 0}
            expected = np.apply_along_axis(lambda v: np.interp(new, nm, v, **outside), -1, old)
            self.expect(self.values("out.exr", new), expected, 1e-7)
            self.assertEqual(report["bands"], len(new))
            beyond = "they hold the value of the end band" if hold else "they are zero"
            self.assertIn(f"4 of 17 new bands lie beyond 400-600 nm: {beyond}", report["warnings"])

    def test_bins_average(self):
        bands = self.bands(range(405, 700, 10), prefix="S0")
        self.write_exr("shot.exr", bands, attributes=[("spectral:binEdges", ";".join(map(str, range(400, 701, 10))))])
        report = self.osiotool_json("convert", "shot.exr", "out.exr", "--resample", "410:20:690")
        old = np.stack(list(bands.values()), axis=-1).astype(float)
        self.expect(self.values("out.exr", range(410, 691, 20), "S0"), (old[..., ::2] + old[..., 1::2]) / 2, 1e-7)
        self.assertIn(";".join(map(str, range(400, 701, 20))), self.check("exrheader", "out.exr"))
        self.assertEqual(report["lost"], [])

    def test_the_own_grid_is_the_identity(self):
        bands = self.bands(GRID)
        first = next(iter(bands.values()))
        first.reshape(-1)[:5] = [0.0, -0.0, np.inf, -np.inf, np.nan]
        self.write_exr("shot.exr", dict(bands, R=first, G=first, B=first, A=first), types=HALF,
                       attributes=[("spectral:fwhm", "12"), ("T.400nm", "390nm:0;400nm:1;")])
        for basis in ("auto", "linear", "bins", "bins-corrected", "sprague", "e2022"):
            report = self.osiotool_json("convert", "shot.exr", "out.exr", "--resample", "400:20:700", "--basis", basis)
            self.assertEqual(report["lost"], [])
            self.assertEqual(report["types"], ["half"])
            self.assert_same(self.bits("out.exr"), self.bits("shot.exr"))
            self.assertIn("390nm:0", self.check("exrheader", "out.exr"))

    def test_what_described_the_old_bands_goes_aloud(self):
        bands = self.bands(GRID)
        first = next(iter(bands.values()))
        self.write_exr("shot.exr", dict(bands, R=first, G=first, B=first, A=first, **{"T.450nm.500nm": first}), attributes=[
            ("spectral:fwhm", "12"), ("T.400nm", "390nm:0;400nm:1;"), ("owner", "Ada")])
        report = self.osiotool_json("convert", "shot.exr", "out.exr", "--resample", "400:10:700")
        self.assertEqual(report["lost"], [
            "reradiation of set T", "attributes T.400nm, spectral:fwhm, of the bands before",
            "channel B, a preview of the bands before", "channel G, a preview of the bands before",
            "channel R, a preview of the bands before"])
        self.assertIn("the bands' own responses are not used for resampling", report["warnings"])
        self.assertIn("Ada", self.check("exrheader", "out.exr"))
        self.assertEqual(sorted(set(self.channels_of("out.exr")) - {f"T.{nm}nm" for nm in range(400, 701, 10)}), ["A"])

    def test_every_set_is_resampled(self):
        both = dict(self.bands(GRID, prefix="left.S0"), **self.bands(GRID, prefix="right.S0", seed=2))
        self.write_exr("shot.exr", both)
        report = self.osiotool_json("convert", "shot.exr", "out.exr", "--set", "left.S0", "--resample", "400:50:700")
        self.assertEqual([s["wavelengths_nm"] for s in self.sets("out.exr")], [list(range(400, 701, 50))] * 2)
        self.assertEqual(report["bands"], 14)
        self.osiotool("convert", "shot.exr", "cube.hdr", "--set", "right.S0", "--resample", "400:50:700")
        cube, exr = self.raw("cube.hdr"), self.bits("out.exr")
        for nm in range(400, 701, 50):
            np.testing.assert_array_equal(cube[f"S0.{nm}nm"], exr[f"right.S0.{nm}nm"])

    def test_bands_are_cut_after_resampling(self):
        self.write_exr("shot.exr", self.bands(GRID))
        self.osiotool("convert", "shot.exr", "all.exr", "--resample", "400:10:700")
        self.osiotool("convert", "shot.exr", "cut.exr", "--resample", "400:10:700", "--bands", "450-500nm")
        every, cut = self.bits("all.exr"), self.bits("cut.exr")
        self.assertEqual(sorted(cut), [f"T.{nm}nm" for nm in range(450, 501, 10)])
        self.assert_same(cut, {name: every[name] for name in cut})

    def test_words_that_mean_nothing(self):
        self.write_exr("shot.exr", self.bands(GRID))
        for words, code, said in (
                (("--resample", "400"), 2, "first:step:last"), (("--resample", "700:10:400"), 2, "not below the first"),
                (("--basis", "linear"), 2, "are for --resample"), (("--resample", "1400:10:1700"), 1, "nothing in common"),
                (("--resample", "400:10:700", "--basis", "response"), 1, "basis=response is for collapsing"),
                (("--resample", "400:10:700", "--basis", "x"), 2, "basis")):
            self.assertIn(said, self.osiotool("convert", "shot.exr", "out.exr", *words, code=code).stderr)
        self.assertEqual(self.files(), ["shot.exr"])


REC709 = (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)


class Parts(ConvertCase):
    """Every part of an EXR goes into another, with its own window, types and attributes."""

    def parts(self):
        self.write_exr("a.exr", self.bands(GRID, (19, 21)), attributes=[("note", "left")], origin=(3, -2), full=(0, 0, 40, 40))
        self.write_exr("b.exr", self.bands([450, 550], (40, 11), seed=2, prefix="S0"), types=HALF, full=(0, 0, 40, 40), attributes=[
            ("emissiveUnits", "W.m^-2.sr^-1")])
        self.write_exr("c.exr", {name: np.full((5, 6), value) for name, value in zip("RGB", (0.1, 0.2, 0.3))}, full=(0, 0, 40, 40))
        self.check("oiiotool", "a.exr", "b.exr", "--siappend", "c.exr", "--siappend", "-o", "parts.exr")
        return self.osiotool_json("info", "parts.exr")["parts"]

    def test_all_parts_go_over(self):
        before = self.parts()
        self.assertEqual(len(before), 3)
        for words in ((), ("--tile", "16x8"), ("--compression", "piz"), ("--tile", "8x16", "--compression", "zips", "--threads", "3")):
            report = self.osiotool_json("convert", "parts.exr", "out.exr", *words)
            self.assertEqual((report["lost"], report["bands"]), ([], len(GRID) + 2))
            after = self.osiotool_json("info", "out.exr")["parts"]
            for i, (old, new) in enumerate(zip(before, after, strict=True)):
                for key in ("name", "data_window", "display_window", "sets", "other_channels"):
                    self.assertEqual(new[key], old[key], (words, i, key))
                self.assert_same(self.bits("out.exr", subimage=i), self.bits("parts.exr", subimage=i))
            self.assertIn("note", self.check("exrheader", "out.exr"))
            self.assertIn("sound", self.osiotool("verify", "out.exr").stdout)
        report = self.osiotool_json("convert", "parts.exr", "half.exr", "--half")
        self.assertEqual(report["types"], ["half"])
        for i in range(3):
            for name, plane in self.channels_of("parts.exr", subimage=i).items():
                np.testing.assert_array_equal(self.channels_of("half.exr", subimage=i)[name], plane.astype(np.float16))

    def test_words_that_choose_or_change_bands_take_one_part(self):
        self.parts()
        report = self.osiotool_json("convert", "parts.exr", "one.exr", "--part", "1")
        self.assertIn("2 other parts", report["lost"])
        self.assertEqual(len(self.osiotool_json("info", "one.exr")["parts"]), 1)
        self.osiotool("convert", "parts.exr", "one.exr", "--bands", "400-500nm", code=1)
        report = self.osiotool_json("convert", "parts.exr", "one.hdr", "--set", "S0")
        self.assertIn("2 other parts", report["lost"])


class Pictures(ConvertCase):
    """Tiles, R, G, B made of the bands, and the picture in a part of its own."""

    def shot(self, prefix="T", shape=(70, 45), **more):
        bands = self.bands(GRID, shape, prefix=prefix)
        self.write_exr("shot.exr", dict(bands, A=np.full(shape, 0.5), **more))
        return bands

    def test_tiles_of_every_compression(self):
        self.shot()
        for tile in ("16x16", "64x8", "100x100"):
            for compression in ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"):
                self.osiotool("convert", "shot.exr", "tiled.exr", "--tile", tile, "--compression", compression, "--threads", "3")
                spec = self.read("tiled.exr")[0]
                self.assertEqual(f"{spec.tile_width}x{spec.tile_height}", tile)
                self.assertIn("sound", self.osiotool("verify", "tiled.exr").stdout)
                self.assertIn("with a checksum", self.osiotool("verify", "tiled.exr").stdout)
                if compression in ("none", "rle", "zips", "zip", "piz"):
                    self.assert_same(self.bits("tiled.exr"), self.bits("shot.exr"))
        for words in ("64", "0x16", "16x-1", "axb", "16x16x16"):
            self.assertIn("expected width and height", self.osiotool("convert", "shot.exr", "no.exr", "--tile", words, code=2).stderr)

    def test_one_and_many_threads_write_the_same_tiles(self):
        self.shot(shape=(150, 40))
        for threads in ("1", "4"):
            self.osiotool("convert", "shot.exr", f"{threads}.exr", "--tile", "16x24", "--threads", threads)
        with open(self.path("1.exr"), "rb") as one, open(self.path("4.exr"), "rb") as four:
            self.assertEqual(one.read(), four.read())

    def test_the_picture_is_the_collapse_of_the_file(self):
        for prefix, light, words in (("T", "D65", ("--illuminant", "D65")), ("T", "FL11", ("--illuminant", "FL11")),
                                     ("S0", "none", ()), ("left.T", "A", ("--illuminant", "A"))):
            self.shot(prefix)
            for more in ((), ("--resample", "405:15:690"), ("--bands", "450-650nm"), ("--tile", "32x32", "--half")):
                self.osiotool("convert", "shot.exr", "out.exr", "--preview", light, *more)
                self.osiotool("collapse", "out.exr", "rgb.exr", "--to", "lin_rec709", *words)
                root = prefix[:-1].replace("S", "")
                picture, expected = self.channels_of("out.exr"), self.channels_of("rgb.exr")
                for channel in "RGB":
                    found = picture[root + channel]
                    if "--half" in more:
                        np.testing.assert_allclose(found, expected[channel], rtol=0, atol=2e-3)
                    else:
                        np.testing.assert_array_equal(found.view(np.uint32), expected[channel].view(np.uint32))
                spec = self.read("out.exr")[0]
                np.testing.assert_allclose(spec.getattribute("chromaticities", oiio.TypeDesc("float[8]")), REC709, atol=1e-4)
                recipe = spec.get_string_attribute("spectral:previewRecipe")
                self.check("oiiotool", f"out.exr?{recipe}", "-o", "again.exr")
                self.check("idiff", "rgb.exr", "again.exr")

    def test_a_picture_that_was_there_is_replaced(self):
        self.shot(**{c: np.full((70, 45), 9) for c in "RGB"})
        self.osiotool("convert", "shot.exr", "out.exr", "--preview", "D65")
        self.assertLess(self.channels_of("out.exr")["R"].max(), 9)
        report = self.osiotool_json("convert", "out.exr", "cut.exr", "--bands", "500-600nm")
        self.assertIn("channel R, a preview of all bands", report["lost"])
        self.assertFalse(self.read("cut.exr")[0].get_string_attribute("spectral:previewRecipe"))

    def test_the_picture_in_a_part_of_its_own(self):
        for more in ((), ("--compression", "piz"), ("--tile", "16x16"), ("--tile", "32x64", "--compression", "dwaa")):
            self.shot()
            self.osiotool("convert", "shot.exr", "two.exr", "--preview", "D65", "--multi-part", *more)
            self.osiotool("convert", "shot.exr", "one.exr", "--preview", "D65", *more)
            info = self.osiotool_json("info", "two.exr")["parts"]
            self.assertEqual([p["name"] for p in info], ["rgb", "spectral"])
            self.assertEqual(sorted(c["name"] for c in info[0]["other_channels"]), ["A", "B", "G", "R"])
            # Stock readers open the first part: a picture.
            spec = self.read("two.exr")[0]
            self.assertEqual(sorted(spec.channelnames), ["A", "B", "G", "R"])
            self.assertIn("R, 32-bit floating-point", self.check("exrheader", "two.exr"))
            if "dwaa" not in more:
                both = {**self.bits("two.exr", subimage=0), **self.bits("two.exr", subimage=1)}
                self.assert_same(both, self.bits("one.exr"))
            self.osiotool("collapse", "two.exr", "a.exr", "--to", "xyz", "--illuminant", "FL2")
            self.osiotool("collapse", "one.exr", "b.exr", "--to", "xyz", "--illuminant", "FL2")
            self.assert_same(self.bits("a.exr"), self.bits("b.exr"))
            self.osiotool("verify", "two.exr")
        self.assertIn("add --preview LIGHT", self.osiotool("convert", "shot.exr", "no.exr", "--multi-part", code=2).stderr)

    def test_words_that_do_not_fit(self):
        self.shot()
        for words, code, said in ((("no.exr", "--preview", "none"), 1, "illuminant"), (("no.exr", "--preview", "D66"), 2, "D66"),
                                  (("no.hdr", "--preview", "D65"), 2, "for .exr output"), (("no.hdr", "--tile", "8x8"), 2, "for .exr output"),
                                  (("no.hdr", "--multi-part"), 2, "for .exr output"),
                                  (("no.exr", "--half", "-d", "float"), 2, "contradict")):
            self.assertIn(said, self.osiotool("convert", "shot.exr", *words, code=code).stderr)
        self.assertEqual(self.files(), ["shot.exr"])

    def test_damaged_tiles_are_seen(self):
        self.shot()
        self.osiotool("convert", "shot.exr", "tiled.exr", "--tile", "16x16", "--compression", "none")
        with open(self.path("tiled.exr"), "rb") as file:
            whole = file.read()
        for at in np.random.default_rng(3).integers(len(whole) // 2, len(whole), 20):
            with open(self.path("tiled.exr"), "wb") as file:
                file.write(whole[:at] + bytes([whole[at] ^ 4]) + whole[at + 1:])
            self.osiotool("verify", "tiled.exr", code=4)
            self.osiotool("convert", "tiled.exr", "out.hdr", code=4)
        self.assertEqual(self.files(), ["shot.exr", "tiled.exr"])


class Frames(ConvertCase):
    def shots(self, frames, folder="in"):
        os.makedirs(self.path(folder), exist_ok=True)
        for frame in frames:
            self.write_exr(f"{folder}/shot.{frame:04d}.exr", self.bands(GRID, seed=frame))

    def test_every_way_to_write_a_sequence(self):
        self.shots(range(1, 16))
        for frames, expected in (("3", [3]), ("1-4", [1, 2, 3, 4]), ("1-10x3,15", [1, 4, 7, 10, 15]), ("5-3", [5, 4, 3]),
                                 ("1-5y2", [2, 4]), ("2,2,1-2", [2, 1])):
            for place, text in (("%04d", "{:04d}"), ("####", "{:04d}"), ("#", "{:04d}"), ("@@", "{:02d}"), ("%d", "{}")):
                os.mkdir(self.path("out"))
                report = self.osiotool_json("convert", "in/shot.%04d.exr", f"out/cube.{place}.hdr", "--frames", frames)
                self.assertEqual([f["frame"] for f in report["frames"]], expected)
                self.assertEqual({f["report"]["output"] for f in report["frames"]},
                                 {f"out/cube.{text.format(f)}.hdr" for f in expected})
                self.assertEqual(len(os.listdir(self.path("out"))), 2 * len(expected))
                for name in os.listdir(self.path("out")):
                    os.remove(self.path("out/" + name))
                os.rmdir(self.path("out"))

    def test_a_frame_that_fails_does_not_stop_the_others(self):
        self.shots([1, 2, 4, 5])
        os.truncate(self.path("in/shot.0004.exr"), 600)
        for command in (("convert", "in/shot.####.exr", "out.####.exr"),
                        ("collapse", "in/shot.####.exr", "out.####.exr", "--to", "xyz", "--illuminant", "D65")):
            result = self.osiotool(*command, "--frames", "1-5", "--json", code=5)
            self.assertIn("osiotool: frame 3: in/shot.0003.exr: ", result.stderr)
            self.assertIn("osiotool: frame 4: in/shot.0004.exr: ", result.stderr)
            self.assertIn("osiotool: 2 of 5 frames did not go well: 3, 4", result.stderr)
            self.assertEqual(self.files(), ["in", "out.0001.exr", "out.0002.exr", "out.0005.exr"])
            codes = [f["exit_code"] for f in json.loads(result.stdout)["frames"]]
            self.assertEqual(codes, [0, 0, 5, 4, 0])
            for name in self.files()[1:]:
                os.remove(self.path(name))

    def test_frames_of_a_collapse_are_those_of_one_file_each(self):
        self.shots([7, 8])
        self.osiotool("collapse", "in/shot.%04d.exr", "out.%04d.exr", "--frames", "7-8", "--to", "xyz", "--illuminant", "D65")
        self.osiotool("collapse", "in/shot.0008.exr", "one.exr", "--to", "xyz", "--illuminant", "D65")
        self.assert_same(self.bits("out.0008.exr"), self.bits("one.exr"))

    def test_words_that_mean_nothing(self):
        self.shots([1])
        for frames in ("", "a", "1-", "1-2x", "1-2x0", "1-2z2", "1,,2", "1-2000001", "1.5"):
            if frames:
                self.assertIn("expected numbers and ranges", self.osiotool(
                    "convert", "in/shot.%04d.exr", "out.%04d.exr", "--frames", frames, code=2).stderr)
        self.assertIn("out.exr: with --frames a name needs a place", self.osiotool(
            "convert", "in/shot.%04d.exr", "out.exr", "--frames", "1", code=2).stderr)
        self.assertEqual(self.files(), ["in"])

    def test_an_interruption_ends_all_and_leaves_nothing(self):
        os.mkdir(self.path("in"))
        pixels = self.bands(range(400, 701, 5), (600, 600))
        for frame in range(1, 4):
            self.write_exr(f"in/shot.{frame}.exr", pixels, compression="none")
        process = subprocess.Popen([OSIOTOOL, "convert", "in/shot.%d.exr", "out.%d.exr", "--frames", "1-3", "--threads", "1"],
                                   cwd=self.folder, stderr=subprocess.PIPE, text=True)
        while not any(name.startswith(".") or "out" in name for name in self.files()):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        stderr = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, stderr)
        self.assertEqual(self.files(), ["in"])


class Split(ConvertCase):
    def test_a_file_a_band(self):
        bands = self.bands([400.5, 450, 1000])
        self.write_exr("shot.exr", dict(bands, A=bands["T.450nm"]), attributes=[("spectral:binEdges", "375;425;800;1200")])
        report = self.osiotool_json("convert", "shot.exr", "out.exr", "--split", "bands")
        self.assertEqual(report["outputs"], ["out_400.5nm.exr", "out_450nm.exr", "out_1000nm.exr"])
        self.assertEqual(report["lost"], ["channel A"])
        for nm, name in ((400.5, "T.400,5nm"), (450, "T.450nm"), (1000, "T.1000nm")):
            self.assertEqual(list(self.exr_channels(f"out_{nm:g}nm.exr")), [name])
            np.testing.assert_array_equal(self.bits(f"out_{nm:g}nm.exr")[name], bands[name].view(np.uint32))
        self.assertIn("425;800", self.check("exrheader", "out_450nm.exr"))
        self.osiotool("convert", "shot.exr", "{nm}/cube.hdr", "--split", "bands", code=5)
        os.mkdir(self.path("cubes"))
        self.osiotool("convert", "shot.exr", "cubes/b{nm}.hdr", "--split", "bands")
        self.assertEqual(len(os.listdir(self.path("cubes"))), 6)

    def test_many_bands_in_passes(self):
        nm = [400 + i for i in range(200)]
        bands = self.bands(nm, (20, 5))
        self.write_exr("shot.exr", bands)
        self.osiotool("convert", "shot.exr", "b.exr", "--split", "bands", "--half", "--threads", "3")
        self.assertEqual(len(self.files()), 201)
        self.osiotool("convert", "--assemble", *[f"b_{w}nm.exr" for w in nm], "back.exr")
        half = {n: p.astype(np.float16).astype(np.float32).view(np.uint32) for n, p in bands.items()}
        self.assert_same(self.bits("back.exr"), half)

    def test_a_file_a_set(self):
        parts = dict(self.bands(GRID, prefix="left.T"), **self.bands(GRID, prefix="S0", seed=2))
        self.write_exr("shot.exr", dict(parts, A=parts["S0.400nm"]))
        report = self.osiotool_json("convert", "shot.exr", "out.exr", "--split", "sets")
        self.assertEqual(sorted(report["outputs"]), ["out_S0.exr", "out_left.T.exr"])
        self.assertEqual(set(self.exr_channels("out_S0.exr")), {f"S0.{nm}nm" for nm in GRID} | {"A"})
        self.assertEqual(set(self.exr_channels("out_left.T.exr")), {f"left.T.{nm}nm" for nm in GRID} | {"A"})
        self.osiotool("convert", "--assemble", "out_S0.exr", "out_left.T.exr", "back.exr")
        self.assert_same(self.bits("back.exr"), self.bits("shot.exr"))

    def test_words_that_mean_nothing(self):
        self.write_exr("shot.exr", self.bands(GRID))
        for words, said in ((("--split", "x"), "expected bands or sets"), (("--split", "sets", "--set", "T"), "--set chooses one"),
                            (("--split", "bands", "--preview", "D65"), "all bands in one file")):
            self.assertIn(said, self.osiotool("convert", "shot.exr", "out.exr", *words, code=2).stderr)
        self.write_exr("twice.exr", {"T.400nm": np.ones((2, 2)), "T.0,4um": np.ones((2, 2))})
        self.assertIn("two bands or sets would be written to one file", self.osiotool(
            "convert", "twice.exr", "out.exr", "--split", "bands", code=2).stderr)
        self.assertEqual(self.files(), ["shot.exr", "twice.exr"])


class Assemble(ConvertCase):
    def test_formats_and_block_sizes_are_joined(self):
        shape = (101, 33)
        a, b, c = (self.bands(nm, shape, seed) for seed, nm in ((1, [400, 450]), (2, [500, 550]), (3, [600, 1000])))
        self.write_exr("a.exr", dict(a, A=a["T.400nm"]), tile=24)
        self.write_exr("b.exr", dict(b, A=b["T.500nm"]), types=HALF)
        self.write_exr("c.exr", c, compression="none")
        self.osiotool("convert", "c.exr", "c.hdr", "--interleave", "bil")
        report = self.osiotool_json("convert", "--assemble", "a.exr", "b.exr", "c.hdr", "out.exr", "--threads", "3")
        self.assertEqual(report["lost"], ["channel A of b.exr"])
        self.assertEqual(report["bands"], 6)
        found = self.bits("out.exr")
        expected = {**self.bits("a.exr"), **{n: p for n, p in self.bits("b.exr").items() if n != "A"}, **self.bits("c.exr")}
        self.assert_same(found, expected)
        self.assertEqual(set(self.exr_channels("out.exr").values()), {"16-bit floating-point", "32-bit floating-point"})
        self.osiotool("convert", "--assemble", "a.exr", "b.exr", "c.hdr", "out.hdr")
        self.assert_same(self.raw("out.hdr"), {n: p for n, p in expected.items() if n != "A"})

    def test_attributes(self):
        self.write_exr("a.exr", self.bands([400, 450]), attributes=[("owner", "Ada"), ("take", 1), ("spectral:fwhm", "10")])
        self.write_exr("b.exr", self.bands([500]), attributes=[("owner", "Bob"), ("take", 1), ("more", 2), ("spectral:fwhm", "20"),
                                                               ("T.500nm", "490nm:0;500nm:1;")])
        report = self.osiotool_json("convert", "--assemble", "a.exr", "b.exr", "out.exr")
        self.assertEqual(report["lost"], ["attribute owner of b.exr, where the first file says something else"])
        header = self.check("exrheader", "out.exr")
        for text in ("400nm:10;450nm:10;500nm:20;", "Ada", "490nm:0;500nm:1;", "more"):
            self.assertIn(text, header)

    def test_what_does_not_fit(self):
        self.write_exr("a.exr", self.bands([400, 450]))
        self.write_exr("twice.exr", self.bands([450, 500]))
        self.write_exr("small.exr", self.bands([500], (4, 4)))
        self.write_exr("rgb.exr", {c: np.ones((5, 7)) for c in "RGB"})
        for name, code, said in (("twice.exr", 2, "twice.exr: band T.450nm is in a.exr too"),
                                 ("small.exr", 1, "small.exr: has 4x4 pixels from 0,0, and a.exr has 7x5"),
                                 ("rgb.exr", 4, "rgb.exr: "), ("none.exr", 5, "none.exr: ")):
            self.assertIn(said, self.osiotool("convert", "--assemble", "a.exr", name, "out.exr", code=code).stderr)
        self.assertIn("found 2 inputs, expected one; --assemble", self.osiotool(
            "convert", "a.exr", "twice.exr", "out.exr", code=2).stderr)
        self.assertNotIn("out.exr", self.files())

    def test_sequences_are_joined_frame_by_frame(self):
        for frame in (1, 2):
            self.write_exr(f"a.{frame}.exr", self.bands([400], seed=frame))
            self.write_exr(f"b.{frame}.exr", self.bands([500], seed=10 + frame))
        self.osiotool("convert", "--assemble", "a.@.exr", "b.@.exr", "c.@.exr", "--frames", "1-2")
        self.assert_same(self.bits("c.2.exr"), {**self.bits("a.2.exr"), **self.bits("b.2.exr")})


if __name__ == "__main__":
    unittest.main()
