# SPDX-License-Identifier: Apache-2.0
"""Stacks of band files through osiotool and OpenImageIO, against numpy."""

import unittest

import numpy as np
import OpenImageIO as oiio

from osio_case import HALF, OsioCase, oracle_xyz

NM = list(range(400, 710, 10))

XMP = """<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description xmlns:Camera="http://pix4d.com/camera/1.0" Camera:BandName="Blue">
<Camera:CentralWavelength>{nm}</Camera:CentralWavelength><Camera:WavelengthFWHM>{width}</Camera:WavelengthFWHM>
</rdf:Description></rdf:RDF></x:xmpmeta>"""


class StackCase(OsioCase):
    def write_band(self, name, pixels, kind=oiio.UINT16, attributes=()):
        """One grey image by OpenImageIO; whole numbers bit for bit."""
        pixels = np.ascontiguousarray(pixels if pixels.ndim == 3 else pixels[..., None])
        channels = pixels.shape[2]
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], channels, kind)
        if channels == 1:
            spec.channelnames = ("Y",)
        for attribute in attributes:
            spec.attribute(*attribute)
        output = oiio.ImageOutput.create(self.path(name))
        self.assertIsNotNone(output, oiio.geterror())
        self.assertTrue(output.open(self.path(name), spec), output.geterror())
        self.assertTrue(output.write_image(pixels), output.geterror())
        self.assertTrue(output.close(), output.geterror())
        return name

    def numbers(self, most=65535, bands=len(NM), shape=(40, 33)):
        kind = np.uint8 if most == 255 else np.uint16
        return np.random.default_rng(9).integers(0, most + 1, (bands, *shape)).astype(kind)

    def cave(self, numbers, name="scene_ms_{:02d}.png", kind=oiio.UINT16):
        return [self.write_band(name.format(i + 1), band, kind) for i, band in enumerate(numbers)]

    def write_stack(self, *lines, name="scene.stack"):
        self.write_table(name, "#spectral-stack", *lines)
        return name


class Read(StackCase):
    def test_png_numbers_are_shares_of_the_largest(self):
        for most, kind in ((65535, oiio.UINT16), (255, oiio.UINT8)):
            numbers = self.numbers(most)
            source = self.write_stack(*(f"{f}, {nm}" for f, nm in zip(self.cave(numbers, kind=kind), NM)))
            self.osiotool("convert", source, "cube.exr")
            found = self.channels_of("cube.exr")
            for i, nm in enumerate(NM):
                expected = (numbers[i].astype(np.float64) / most).astype(np.float32)
                self.assertTrue(np.array_equal(found[f"T.{nm}nm"], expected), nm)
            warnings = self.osiotool_json("info", source)["parts"][0]["warnings"]
            self.assertTrue(any(f"divided by {most}" in w for w in warnings), warnings)

    def test_a_scale_of_the_list(self):
        numbers = self.numbers()
        source = self.write_stack("scale = 10000", *(f"{f}, {nm}" for f, nm in zip(self.cave(numbers), NM)))
        self.osiotool("convert", source, "cube.exr")
        found = self.channels_of("cube.exr")
        self.assertTrue(np.array_equal(found["T.450nm"], (numbers[5].astype(np.float64) / 10000).astype(np.float32)))

    def test_a_collapse_is_the_sum_of_its_bands(self):
        numbers = self.numbers()
        files = self.cave(numbers)
        source = self.write_stack(*reversed(files))
        found, report, _ = self.both(source, to="xyz", illuminant="D65", names="xyz", basis="linear", wavelengths="400:10:700")
        cube = np.moveaxis((numbers / 65535).astype(np.float32), 0, -1)
        self.expect(found, cube.astype(float) @ oracle_xyz(NM, "D65").T)

    def test_wavelengths_of_names_lists_and_units(self):
        numbers = self.numbers(bands=3)
        files = [self.write_band(f"leaf_{nm}nm.png", band) for nm, band in zip((450, 550, 1050), numbers)]
        info = self.osiotool_json("info", self.write_stack("# a comment", "", *files))
        self.assertEqual(info["parts"][0]["sets"][0]["wavelengths_nm"], [450, 550, 1050])
        self.assertEqual(info["format"], "band files")
        info = self.osiotool_json("info", self.write_stack(f"{files[0]}, 0.46um, 10", f'"{files[1]}", 560 nm, 10 nm', files[2]))
        self.assertEqual(info["parts"][0]["sets"][0]["wavelengths_nm"], [460, 560, 1050])

    def test_wavelengths_of_cameras(self):
        files = []
        numbers = self.numbers(bands=3)
        for pixels, nm, width in zip(numbers, (475, 560, 668), (32, 27, 14)):
            files.append(self.write_band(f"IMG_0001_{len(files) + 1}.tif", pixels))
            self.add_xmp(files[-1], XMP.format(nm=nm, width=width))
        source = self.write_stack(*files)
        self.osiotool("convert", source, "cube.exr")
        found = self.channels_of("cube.exr")
        self.assertEqual(sorted(found), ["T.475nm", "T.560nm", "T.668nm"])
        self.assertTrue(np.array_equal(found["T.475nm"], numbers[0].astype(np.float32)))
        self.assertIn("475nm:32;560nm:27;668nm:14;", self.check("exrheader", "cube.exr"))

    def add_xmp(self, name, packet):
        """Rewrites a TIFF by GDAL with an XMP packet."""
        from osgeo import gdal
        gdal.UseExceptions()
        source = gdal.Open(self.path(name))
        copy = gdal.GetDriverByName("MEM").CreateCopy("", source)
        source = None
        copy.SetMetadata([packet], "xml:XMP")
        gdal.GetDriverByName("GTiff").CreateCopy(self.path(name), copy)

    def test_openexr_files_keep_their_bits_and_window(self):
        bands = self.bands([500, 600])
        for i, (name, pixels) in enumerate(bands.items()):
            self.write_exr(f"b{i}.exr", {name: pixels}, types=HALF if i else oiio.FLOAT, origin=(3, 4), full=(0, 0, 30, 40))
        self.osiotool("convert", self.write_stack("b0.exr", "b1.exr"), "cube.exr")
        self.assertEqual(self.exr_channels("cube.exr"), {"T.500nm": "32-bit floating-point", "T.600nm": "16-bit floating-point"})
        spec, _ = self.read("cube.exr")
        self.assertEqual((spec.x, spec.y, spec.full_width, spec.full_height), (3, 4, 30, 40))
        self.assertTrue(np.array_equal(self.channels_of("cube.exr")["T.500nm"], bands["T.500nm"]))

    def test_grey_in_rgb_is_a_band_and_colour_is_not(self):
        band = self.numbers(bands=1)[0]
        self.write_band("grey_450nm.png", np.stack([band] * 3, axis=-1))
        self.write_band("plain_550nm.png", band)
        self.osiotool("convert", self.write_stack("grey_450nm.png", "plain_550nm.png"), "cube.exr")
        found = self.channels_of("cube.exr")
        self.assertTrue(np.array_equal(found["T.450nm"], found["T.550nm"]))
        self.write_band("grey_450nm.png", np.stack([band, band, band[::-1]], axis=-1))
        self.assertIn("R, G and B that differ", self.osiotool("convert", "scene.stack", "no.exr", code=1).stderr)

    def test_frames_of_900_bands(self):
        numbers = self.numbers(bands=900, shape=(3, 5))
        source = self.write_stack(*self.cave(numbers))
        info = self.osiotool_json("info", source, "--wavelengths", "400:0.5:849.5")
        self.assertEqual(info["parts"][0]["sets"][0]["wavelengths_nm"], [400 + 0.5 * i for i in range(900)])

    def test_a_split_cube_comes_back(self):
        self.write_exr("shot.exr", self.bands([450, 550, 650]))
        for ending in ("exr", "tif"):
            self.osiotool("convert", "shot.exr", "b_{nm}." + ending, "--split", "bands")
            self.osiotool("convert", self.write_stack(*(f"b_{nm}.{ending}" for nm in (450, 550, 650))), "back.exr")
            for name, pixels in self.channels_of("shot.exr").items():
                self.assertTrue(np.array_equal(self.channels_of("back.exr")[name], pixels))

    def test_a_cube_as_png_files_keeps_16_bits(self):
        numbers = self.numbers(bands=3, shape=(70, 33))
        channels = {f"T.{nm}nm": (band / 65535).astype(np.float32) for nm, band in zip((450, 550.5, 650), numbers)}
        self.write_exr("shot.exr", {name.replace("550.5", "550,5"): band for name, band in channels.items()})
        report = self.osiotool_json("convert", "shot.exr", "b_{nm}.png", "--split", "bands")
        names = [f"b_{nm}.png" for nm in ("450", "550.5", "650")]
        self.assertEqual(report["outputs"], names)
        self.assertEqual((report["types"], report["clipped_samples"]), (["uint16"], 0))
        self.assertTrue(any("1/65535" in words for words in report["lost"]), report["lost"])
        for name, band in zip(names, numbers):
            image = oiio.ImageInput.open(self.path(name))
            self.assertEqual((image.format_name(), image.spec().nchannels, image.spec().format), ("png", 1, oiio.UINT16))
            self.assertTrue(np.array_equal(image.read_image(oiio.UINT16)[..., 0], band))
        self.osiotool("convert", "--assemble", *names, "back.exr", "--wavelengths", self.write_table(
            "nm.csv", "b_450,450", "b_550.5,550.5", "b_650,650"))
        for name, band in self.channels_of("back.exr").items():
            self.assertTrue(np.array_equal(band, channels[name.replace(",", ".")]))

    def test_what_a_png_file_cannot_hold_is_said(self):
        band = np.array([[-0.5, 0, 0.25], [1, 1.5, np.nan]], np.float32)
        self.write_exr("s.exr", {"S0.500nm": band}, attributes=[("note", "kept elsewhere")])
        report = self.osiotool_json("convert", "s.exr", "s.png")
        self.assertEqual(report["clipped_samples"], 3)
        for words in ("radiance", "note", "1/65535"):
            self.assertTrue(any(words in lost for lost in report["lost"]), report["lost"])
        pixels = oiio.ImageInput.open(self.path("s.png")).read_image(oiio.UINT16)[..., 0]
        self.assertEqual(pixels.tolist(), [[0, 0, 16384], [65535, 65535, 0]])
        self.write_exr("a.exr", self.bands([450, 550]))
        for options, words in (((), "--split bands"), (("-d", "half", "--split", "bands"), "PNG 16 bits"),
                               (("--compression", "zip", "--split", "bands"), "PNG has"),
                               (("--tile", "16x16", "--split", "bands"), ".exr output")):
            self.assertIn(words, self.osiotool("convert", "a.exr", "b_{nm}.png", *options, code=2).stderr)
        self.osiotool("convert", "a.exr", "missing/b_{nm}.png", "--split", "bands", code=5)
        self.assertEqual(self.files(), ["a.exr", "s.exr", "s.png"])

    def test_files_without_a_list_are_assembled(self):
        numbers = self.numbers(bands=12)
        files = self.cave(numbers)
        self.osiotool("convert", "--assemble", *reversed(files), "cube.exr", "--wavelengths", "400:10:510")
        found = self.channels_of("cube.exr")
        for i in range(12):
            expected = (numbers[i].astype(np.float64) / 65535).astype(np.float32)
            self.assertTrue(np.array_equal(found[f"T.{400 + 10 * i}nm"], expected), i)
        self.assertIn("#spectral-stack", self.osiotool("info", files[0], code=4).stderr)


class Refused(StackCase):
    def test_what_is_no_stack(self):
        files = self.cave(self.numbers(bands=2))
        other = self.write_band("small.png", self.numbers(bands=1, shape=(4, 4))[0])
        self.write_table("words.txt", "no picture")
        for lines, code, said in (((files[0], other), 1, "40 pixels"), ((files[0],), 4, "has no wavelength"),
                                  ((f"{files[0]}, blue",), 2, "line 2: found \"blue\""), ((files[0], files[0]), 2, "for a second time"),
                                  ((), 2, "names no file"), (("scale = 0", files[0]), 2, "line 2: found scale"),
                                  (("light = D65", files[0]), 2, "no key \"light\""), (("gone.png, 450",), 5, "gone.png"),
                                  (("words.txt, 450",), 4, "no PNG, TIFF or OpenEXR"), (('"a.png, 450',), 2, "never closed")):
            source = self.write_stack(*lines)
            self.assertIn(said, self.osiotool("info", source, code=code).stderr)
        self.write_exr("rgb.exr", {c: np.zeros((40, 33), np.float32) for c in "RGB"})
        self.assertIn("3 channels", self.osiotool("info", self.write_stack("rgb.exr, 450"), code=1).stderr)
        self.assertIn("is for whole numbers", self.osiotool("info", self.write_stack("scale = 2", "rgb.exr, 450"), code=2).stderr)

    def test_a_damaged_file_is_an_error_and_nothing_is_left(self):
        files = self.cave(self.numbers(bands=2))
        source = self.write_stack(*(f"{f}, {nm}" for f, nm in zip(files, NM)))
        with open(self.path(files[1]), "rb") as file:
            whole = file.read()
        for damaged in (whole[:200], whole[:-20], whole[:100] + bytes([whole[100] ^ 1]) + whole[101:]):
            with open(self.path(files[1]), "wb") as file:
                file.write(damaged)
            stderr = self.osiotool("convert", source, "cube.exr", code=4).stderr
            self.assertIn(files[1], stderr)
            self.assertEqual(self.files(), sorted([*files, source]))


if __name__ == "__main__":
    unittest.main()
