# SPDX-License-Identifier: Apache-2.0
"""ENVI files through osiotool and OpenImageIO, against numpy reading the same bytes."""

import os

import numpy as np
import OpenImageIO as oiio

from osio_case import OsioCase, oracle_xyz, stack

TYPES = {1: "u1", 2: "i2", 3: "i4", 4: "f4", 5: "f8", 12: "u2", 13: "u4", 14: "i8", 15: "u8"}
ORDER = {"bsq": (2, 0, 1), "bil": (0, 2, 1), "bip": (0, 1, 2)}  # of axes y, x, band
NM = np.arange(400, 710, 10)


class EnviCase(OsioCase):
    def write_envi(self, name, cube, code=4, interleave="bil", big=False, offset=0, keys=()):
        """A cube of [y, x, band] as name.hdr and name.img."""
        stored = np.ascontiguousarray(np.transpose(cube, ORDER[interleave])).astype((">" if big else "<") + TYPES[code])
        with open(self.path(name + ".img"), "wb") as file:
            file.write(b"\0" * offset + stored.tobytes())
        lines, samples, bands = cube.shape
        self.write_table(name + ".hdr", "ENVI", f"samples = {samples}", f"lines = {lines}", f"bands = {bands}",
                         f"header offset = {offset}", f"data type = {code}", f"interleave = {interleave}",
                         f"byte order = {int(big)}", *keys)
        return name + ".hdr"

    def wavelengths(self, nm=NM):
        return ["wavelength units = Nanometers", "wavelength = {" + ",\n ".join(map(str, nm)) + "}"]

    def cube(self, shape=(6, 9), bands=len(NM), most=1.0):
        return np.random.default_rng(5).random((*shape, bands)).astype(np.float32) * np.float32(most)


class Collapse(EnviCase):
    def test_a_scaled_cube_is_the_sum_of_its_bands(self):
        counts = np.round(self.cube() * 10000)
        for interleave in ORDER:
            source = self.write_envi("cube", counts, 12, interleave, big=True, offset=7,
                                     keys=[*self.wavelengths(), "reflectance scale factor = 10000"])
            found, report, _ = self.both(source, to="xyz", illuminant="D65", names="xyz", basis="linear")
            expected = (counts / 10000).astype(np.float32).astype(float) @ oracle_xyz(NM, "D65").T
            self.expect(found, expected)
            self.assertEqual(report["input"], source)

    def test_radiance_needs_no_light(self):
        cube = self.cube()
        source = self.write_envi("cube", cube, keys=[*self.wavelengths(), "data units = Radiance"])
        found, _, _ = self.both(source, to="xyz", names="xyz", basis="linear")
        self.expect(found, cube.astype(float) @ oracle_xyz(NM).T)
        photometry = self.osiotool_json("photometry", source)
        self.assertEqual(photometry["pixels"], 54)

    def test_bad_bands_take_no_part(self):
        cube = self.cube()
        cube[..., 7] = 1e6
        good = [int(band != 7) for band in range(len(NM))]
        source = self.write_envi("cube", cube, keys=[*self.wavelengths(), f"bbl = {{{','.join(map(str, good))}}}"])
        found, _, stderr = self.both(source, to="xyz", illuminant="D65", names="xyz", basis="linear")
        keep = np.array(good, bool)
        self.expect(found, cube[..., keep].astype(float) @ oracle_xyz(NM[keep], "D65").T)
        self.assertIn('1 of 31 bands are bad by "bbl"', stderr)

    def test_ignored_numbers_are_nan(self):
        cube = self.cube()
        cube[2, 3, 4] = -9999
        source = self.write_envi("cube", cube, keys=[*self.wavelengths(), "data ignore value = -9999"])
        found, report, _ = self.both(source, to="xyz", illuminant="D65")
        self.assertEqual(np.argwhere(np.isnan(found).all(axis=-1)).tolist(), [[2, 3]])
        self.assertEqual(report["nan_pixels"], 1)

    def test_an_envi_cube_and_an_exr_of_it_do_not_differ(self):
        cube = self.cube()
        source = self.write_envi("cube", cube, keys=self.wavelengths())
        self.write_exr("same.exr", {f"T.{nm}nm": cube[..., i] for i, nm in enumerate(NM)})
        outcome = self.osiotool_json("difference", source, "same.exr", "--illuminant", "D65")
        self.assertEqual(outcome["max"], 0)


class Info(EnviCase):
    def test_info_tells_what_was_assumed(self):
        source = self.write_envi("cube", self.cube(), 5, "bip",
                                 keys=["wavelengths = {" + ",".join(str(nm / 1000) for nm in NM) + "}"])
        info = self.osiotool_json("info", source)
        self.assertEqual(info["format"], "ENVI")
        part = info["parts"][0]
        self.assertEqual(part["storage"], "bip of double, little-endian")
        self.assertEqual(part["sets"][0]["channels"][0], "T.400nm")
        self.assertEqual(part["sets"][0]["wavelengths_nm"], [float(nm) for nm in NM])
        text = self.osiotool("info", source).stdout
        for words in ("bip of double, little-endian", '"wavelengths" is taken as "wavelength"',
                      "taken as micrometres", "taken as reflectance", "rounded to float"):
            self.assertIn(words, text)

    def test_refusals_have_the_documented_codes(self):
        source = self.write_envi("cube", self.cube(), keys=self.wavelengths())
        os.truncate(self.path("cube.img"), 100)
        stderr = self.osiotool("collapse", source, "out.exr", "--to", "xyz", "--illuminant", "D65", code=4).stderr
        self.assertIn("cube.img: has 100 bytes, the header promises 6696", stderr)
        self.assertEqual(self.files(), ["cube.hdr", "cube.img"])
        os.remove(self.path("cube.img"))
        self.assertIn("no data file beside the header", self.osiotool("info", source, code=4).stderr)
        self.write_table("radiance.hdr", "#?RADIANCE", "FORMAT=32-bit_rle_rgbe", "", "-Y 1 +X 1")
        self.assertIn("radiance.hdr", self.osiotool("info", "radiance.hdr", code=4).stderr)
        self.write_envi("complex", self.cube(), keys=self.wavelengths())
        with open(self.path("complex.hdr")) as file:
            text = file.read()
        with open(self.path("complex.hdr"), "w") as file:
            file.write(text.replace("data type = 4", "data type = 6"))
        self.assertIn("complex", self.osiotool("info", "complex.hdr", code=1).stderr)


class Plugin(EnviCase):
    """Stock OpenImageIO finds the reader by the file's content."""

    def native(self, name):
        """(spec, pixels in the file's own type)."""
        image = oiio.ImageInput.open(self.path(name))
        self.assertIsNotNone(image, oiio.geterror())
        spec = image.spec()
        pixels = image.read_image(0, 0, 0, spec.nchannels, spec.format)
        self.assertIsNotNone(pixels, image.geterror())
        return spec, pixels

    def test_numbers_are_those_of_numpy_bit_for_bit(self):
        random = np.random.default_rng(3)
        for code, kind in TYPES.items():
            if code in (14, 15):
                continue  # OpenImageIO's Python has no such arrays: test_64_bit_integers
            for interleave in ORDER:
                for big in (False, True):
                    cube = random.integers(0, 256, (5, 7, 4, np.dtype(kind).itemsize), np.uint8).view(kind)[..., 0]
                    source = self.write_envi("cube", cube, code, interleave, big, 3, self.wavelengths(NM[:4]))
                    spec, found = self.native(source)
                    self.assertEqual(found.tobytes(), cube.tobytes(), (code, interleave, big))
                    self.assertEqual(list(spec.channelnames), ["T.400nm", "T.410nm", "T.420nm", "T.430nm"])
                    self.assertEqual(self.format_of(source), "envi")

    def test_64_bit_integers(self):
        for code in (14, 15):
            cube = np.arange(5 * 7 * 2).reshape(5, 7, 2) * 2**20
            source = self.write_envi("cube", cube, code, keys=self.wavelengths(NM[:2]))
            self.check("oiiotool", source, "-d", "double", "-o", "cube.tif")
            _, found = self.read("cube.tif")
            most = 2.0**63 - 1 if code == 14 else 2.0**64 - 1
            np.testing.assert_allclose(found, cube / most, rtol=1e-6)

    def test_every_door_of_the_host(self):
        cube = self.cube() * 4000
        source = self.write_envi("cube", cube, 12, keys=[*self.wavelengths([450.5, *NM[1:]]),
                                                        "reflectance scale factor = 4000", "sensor type = {AVIRIS}"])
        for name in (source, "cube.img"):
            self.assertIn("31 channel, uint16 envi", self.check("iinfo", name))
        listing = self.check("oiiotool", "--info", "-v", source)
        self.assertIn("T.450.5nm", listing)
        self.assertIn('envi:sensor type: "AVIRIS"', listing)
        self.assertIn('envi:reflectance scale factor: "4000"', listing)
        self.check("oiiotool", source, "--ch", "T.450.5nm,T.550nm", "-o", "two.tif")
        self.assertEqual(self.read("two.tif")[0].nchannels, 2)

    def test_bands_come_in_order_of_wavelength(self):
        cube = self.cube(bands=3)
        source = self.write_envi("cube", cube, keys=self.wavelengths([650, 450, 550]))
        spec, found = self.native(source)
        self.assertEqual(list(spec.channelnames), ["T.450nm", "T.550nm", "T.650nm"])
        np.testing.assert_array_equal(found, cube[..., [1, 2, 0]])

    def test_other_files_called_hdr_keep_their_reader(self):
        self.check("oiiotool", "--create", "8x6", "3", "-o", "radiance.hdr")
        self.assertEqual(self.format_of("radiance.hdr"), "hdr")
        self.write_table("esri.hdr", "NROWS 6", "NCOLS 8")
        self.assertNotEqual(self.run_program("iinfo", "esri.hdr").returncode, 0)
        self.write_envi("short", self.cube(), keys=self.wavelengths())
        os.truncate(self.path("short.img"), 100)
        self.assertNotEqual(self.run_program("oiiotool", "short.hdr", "-o", "out.tif").returncode, 0)

    def test_a_damaged_cube_says_so_under_its_own_ending(self):
        self.write_envi("cube", self.cube(), keys=self.wavelengths())
        os.rename(self.path("cube.img"), self.path("cube.bil"))
        self.assertIn("31 channel, float envi", self.check("iinfo", "cube.bil"))
        os.truncate(self.path("cube.bil"), 100)
        result = self.run_program("oiiotool", "cube.bil", "-o", "out.tif")
        self.assertIn("has 100 bytes, the header promises 6696", result.stdout + result.stderr)

    def test_samples_come_by_a_query(self):
        counts = np.round(self.cube() * 10000)
        source = self.write_envi("cube", counts, 12, keys=[*self.wavelengths(), "reflectance scale factor = 10000"])
        spec, found = self.read(f"{self.path(source)}?to=raw")
        self.assertEqual(spec.channelnames[0], "T.400nm")
        np.testing.assert_array_equal(found, (counts / 10000).astype(np.float32))
