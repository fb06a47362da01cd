# SPDX-License-Identifier: Apache-2.0
"""ENVI files through osiotool and OpenImageIO, against numpy reading the same bytes."""

import collections
import os
import unittest

import numpy as np
import OpenImageIO as oiio

from osio_case import HALF, OSIOTOOL, OsioCase, oracle_xyz

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

    def test_the_doctor_misses_it(self):
        self.assertNotIn("envi", self.osiotool("doctor").stdout)
        folder = os.environ["OIIO_LIBRARY_PATH"]
        os.mkdir(self.path("alone"))
        os.symlink(os.path.join(folder, "spectralexr.imageio.so"), self.path("alone/spectralexr.imageio.so"))
        said = self.osiotool("doctor", env={"OIIO_LIBRARY_PATH": self.path("alone")}).stdout
        self.assertIn("OpenImageIO does not see envi.imageio.so", said)

    def test_samples_come_by_a_query(self):
        counts = np.round(self.cube() * 10000)
        source = self.write_envi("cube", counts, 12, keys=[*self.wavelengths(), "reflectance scale factor = 10000"])
        spec, found = self.read(f"{self.path(source)}?to=raw")
        self.assertEqual(spec.channelnames[0], "T.400nm")
        np.testing.assert_array_equal(found, (counts / 10000).astype(np.float32))


class Convert(EnviCase):
    """OpenEXR to ENVI and back."""

    def bits(self, name):
        return {channel: np.ascontiguousarray(plane).view(np.uint32) for channel, plane in self.channels_of(name).items()}

    def assert_same_bits(self, a, b):
        self.assertEqual(sorted(a), sorted(b))
        for channel in a:
            np.testing.assert_array_equal(a[channel], b[channel], channel)

    def shot(self, name="shot.exr", shape=(37, 23), prefix="T", **options):
        """Bands of any float at all: tiny, huge, infinite and NaN among them."""
        bands = self.bands([400.5, *range(410, 700, 10)], shape, prefix=prefix)
        first = next(iter(bands.values()))
        first.reshape(-1)[:6] = [0.0, -0.0, np.inf, -np.inf, 1e-42, 3.4028235e38]
        first.view(np.uint32).reshape(-1)[6] = 0x7FC12345
        self.write_exr(name, bands, **options)
        return bands

    def test_floats_come_back_bit_for_bit(self):
        self.shot()
        for interleave in ORDER:
            report = self.osiotool_json("convert", "shot.exr", "cube.hdr", "--interleave", interleave)
            self.assertEqual(report["lost"], [])
            self.assertEqual(report["data"], "cube.img")
            self.osiotool("convert", "cube.hdr", "back.exr")
            self.assert_same_bits(self.bits("back.exr"), self.bits("shot.exr"))

    def test_the_data_file_is_what_numpy_would_write(self):
        bands = self.shot()
        cube = np.stack(list(bands.values()), axis=-1)
        for interleave, order in ORDER.items():
            self.osiotool("convert", "shot.exr", "cube.hdr", "--interleave", interleave, "--threads", "3")
            with open(self.path("cube.img"), "rb") as file:
                self.assertEqual(file.read(), np.ascontiguousarray(cube.transpose(order)).astype("<f4").tobytes())

    def test_one_and_many_threads_write_the_same(self):
        self.shot(shape=(150, 40))
        for threads in ("1", "4"):
            self.osiotool("convert", "shot.exr", f"{threads}.hdr", "--threads", threads)
            self.osiotool("convert", f"{threads}.hdr", f"{threads}.exr", "--threads", threads, "--compression", "piz")
        for ending in (".img", ".exr"):
            with open(self.path("1" + ending), "rb") as one, open(self.path("4" + ending), "rb") as four:
                self.assertEqual(one.read(), four.read(), ending)

    def test_halves_come_back(self):
        self.write_exr("half.exr", self.bands(range(400, 700, 20)), types=HALF)
        self.osiotool("convert", "half.exr", "cube.hdr")
        report = self.osiotool_json("convert", "cube.hdr", "back.exr", "-d", "half")
        self.assert_same_bits(self.bits("back.exr"), self.bits("half.exr"))
        self.assertEqual(set(self.exr_channels("back.exr").values()), {"16-bit floating-point"})
        self.assertEqual(report["lost"], ["digits of floats beyond the 11 bits of a half"])

    def test_what_does_not_fit_a_half_is_counted(self):
        bands = self.bands([400, 500])
        bands["T.400nm"][1, 2:4] = [70000, -1e9]
        self.write_exr("shot.exr", bands)
        report = self.osiotool_json("convert", "shot.exr", "half.exr", "-d", "half")
        self.assertEqual(report["clamped_samples"], 2)
        self.assertEqual(self.channels_of("half.exr")["T.400nm"][1, 2:4].tolist(), [65504, -65504])

    def test_attributes_go_there_and_back(self):
        attributes = [("owner", "Ada"), ("Copyright", "1843, {all} = mine"), ("ISOSpeed", 125.5), ("take", 7),
                      ("note", "two\nlines"), ("emissiveUnits", "W.m^-2.sr^-1"), ("spectral:fwhm", "5"), ("bad", "a } b")]
        self.shot(prefix="S0", attributes=attributes)
        report = self.osiotool_json("convert", "shot.exr", "cube.hdr")
        self.assertEqual(report["lost"], ["attributes bad, owner"])
        self.osiotool("convert", "cube.hdr", "back.exr")
        there = self.check("exrheader", "shot.exr").splitlines()
        back = self.check("exrheader", "back.exr").splitlines()
        for word in ("ISOSpeed", "take", "note"):
            lines = [line for line in there if line.startswith(word + " ")]
            self.assertEqual(len(lines), 1, word)
            self.assertIn(lines[0], back)
        info = self.osiotool_json("info", "cube.hdr")["parts"][0]
        self.assertEqual(info["sets"][0]["quantity"], "radiance")
        self.assertEqual(info["warnings"], [])
        with open(self.path("cube.hdr")) as file:
            self.assertIn("fwhm = {\n5,\n5,", file.read())

    def test_keys_that_count_bands_do_not_go_over(self):
        source = self.write_envi("cube", self.cube(), keys=[*self.wavelengths(), "default bands = {3, 2, 1}",
                                                            "sensor type = AVIRIS"])
        self.osiotool("convert", source, "cube.exr")
        report = self.osiotool_json("convert", "cube.exr", "cut.hdr", "--bands", "500-600nm")
        self.assertEqual(report["lost"], ["attribute envi:default bands"])
        with open(self.path("cut.hdr")) as file:
            self.assertIn("\nsensor type = AVIRIS\n", file.read())

    def test_attributes_of_one_key(self):
        self.shot(attributes=[("take one", 7), ("take_one", 8)])
        self.assertEqual(self.osiotool_json("convert", "shot.exr", "cube.hdr")["lost"], ["attribute take_one"])

    def test_what_is_lost_is_said(self):
        bands = self.bands([400, 500, 600])
        bands.update({c: bands["T.400nm"] for c in ("R", "G", "B", "A", "Z")})
        self.write_exr("shot.exr", bands, origin=(3, 4), full=(0, 0, 30, 40))
        report = self.osiotool_json("convert", "shot.exr", "cube.hdr")
        self.assertEqual(report["lost"], ["channels A, B, G, R, Z", "the place of the data window in the display window"])
        stderr = self.osiotool("convert", "shot.exr", "cube.hdr").stderr
        self.assertIn("note: not in the output: channels A, B, G, R, Z", stderr)
        report = self.osiotool_json("convert", "shot.exr", "same.spexr")
        self.assertEqual(report["lost"], [])
        self.assert_same_bits(self.bits("same.spexr"), {n.replace(",", "."): p for n, p in self.bits("shot.exr").items()})

    def test_bands_in_a_range(self):
        bands = self.bands(range(400, 701, 100))
        bands.update({c: bands["T.400nm"] for c in "RGB"})
        self.write_exr("shot.exr", bands, attributes=[("spectral:binEdges", "350;450;550;650;750")])
        for words in ("500-600nm", "0.5-0.6um", "500-600", "450.5nm-650nm"):
            for out in ("cut.exr", "cut.hdr"):
                report = self.osiotool_json("convert", "shot.exr", out, "--bands", words)
                self.assertEqual(report["bands"], 2)
                info = self.osiotool_json("info", out)["parts"][0]
                self.assertEqual(info["sets"][0]["wavelengths_nm"], [500, 600], words)
        report = self.osiotool_json("convert", "shot.exr", "cut.exr", "--bands", "500-600nm")
        self.assertEqual(sorted(self.channels_of("cut.exr")), ["T.500nm", "T.600nm"])
        self.assertEqual(report["lost"], [f"channel {c}, a preview of all bands" for c in "RGB"])
        self.assertIn("450;550;650", self.check("exrheader", "cut.exr"))
        stderr = self.osiotool("convert", "shot.exr", "no.exr", "--bands", "800-900nm", code=1).stderr
        self.assertIn("no band of set T lies in 800-900 nm; it has 400-700 nm", stderr)
        for words in ("400", "700-400nm", "a-b", "", "400nm-"):
            if words:
                self.assertIn("expected a range", self.osiotool("convert", "shot.exr", "no.exr", "--bands", words, code=2).stderr)

    def test_words_that_do_not_fit(self):
        self.shot()
        for words, said in ((("cube.jpg",), "ends in .exr, .spexr, .hdr, .tif, .tiff or .png"), (("cube.hdr", "-d", "half"), "for .exr"),
                            (("cube.hdr", "--compression", "zip"), "for .exr"), (("o.exr", "--interleave", "bil"), "for .hdr"),
                            (("o.exr", "-d", "uint8"), "half or float"), (("cube.hdr", "--interleave", "x"), "bsq, bil or bip"),
                            (("o.exr", "--compression", "x"), "no compression")):
            self.assertIn(said, self.osiotool("convert", "shot.exr", *words, code=2).stderr)
        self.assertIn("no set", self.osiotool("convert", "shot.exr", "o.exr", "--set", "S0", code=1).stderr)
        self.assertEqual(self.files(), ["shot.exr"])

    def test_a_file_that_is_not_ours_to_replace_stays(self):
        self.shot()
        self.write_table("cube.raw", "a camera's picture")
        self.assertIn("cube.raw: would be taken for the data", self.osiotool("convert", "shot.exr", "cube.hdr", code=2).stderr)
        self.assertEqual(self.files(), ["cube.raw", "shot.exr"])
        self.osiotool("convert", "shot.exr", "cube.dat.hdr")
        self.assertEqual(self.files(), ["cube.dat", "cube.dat.hdr", "cube.raw", "shot.exr"])

    def test_a_cube_may_be_replaced_by_itself(self):
        self.shot()
        self.osiotool("convert", "shot.exr", "cube.hdr")
        os.rename(self.path("cube.img"), self.path("cube.dat"))
        self.osiotool("convert", "cube.hdr", "cube.hdr", "--interleave", "bip")
        self.assertEqual(self.files(), ["cube.dat", "cube.hdr", "shot.exr"])
        self.osiotool("convert", "cube.hdr", "back.exr")
        self.assert_same_bits(self.bits("back.exr"), self.bits("shot.exr"))

    def test_whatever_call_fails_the_old_cube_stays(self):
        self.shot()
        os.mkdir(self.path("out"))
        old = {"cube.hdr": b"ENVI\nold", "cube.img": b"old numbers"}

        def convert(call="", at=-1):
            for name, content in old.items():
                with open(self.path("out/" + name), "wb") as file:
                    file.write(content)
            folder = os.path.realpath(self.path("out"))
            env = {"OSIO_FAULT_UNDER": folder, "OSIO_FAULT_LOG": self.path("log"), "OSIO_FAULT_CALL": call,
                   "OSIO_FAULT_AT": str(at), "OSIO_FAULT_ERRNO": "EIO", "LD_PRELOAD": ":".join(filter(None, (
                       os.environ.get("LD_PRELOAD", "").replace(" ", ":"), os.environ["OSIO_TEST_FAILING_CALLS"])))}
            return self.run_program(OSIOTOOL, "convert", "shot.exr", folder + "/cube.hdr", env=env)

        self.assertEqual(convert().returncode, 0)
        with open(self.path("log")) as file:
            counts = collections.Counter(file.read().split())
        self.assertEqual(counts["rename"], 2)
        for call in ("write", "close", "rename"):
            self.assertGreater(counts[call], 1, call)
            for at in range(counts[call]):
                result = convert(call, at)
                self.assertEqual(result.returncode, 5, (call, at, result.stderr))
                found = {}
                for name in os.listdir(self.path("out")):
                    with open(self.path("out/" + name), "rb") as file:
                        found[name] = file.read()
                self.assertEqual(found, old, (call, at))

    def test_damaged_input_leaves_nothing_behind(self):
        source = self.write_envi("cube", self.cube(), keys=self.wavelengths())
        os.truncate(self.path("cube.img"), 100)
        self.osiotool("convert", source, "out.exr", code=4)
        self.assertEqual(self.files(), ["cube.hdr", "cube.img"])

    def test_900_bands_and_beyond_1000_nm(self):
        nm = [350 + 2.5 * i for i in range(900)]
        cube = np.random.default_rng(2).random((3, 5, 900)).astype(np.float32)
        source = self.write_envi("cube", cube, keys=self.wavelengths(nm))
        self.osiotool("convert", source, "cube.exr")
        self.osiotool("convert", "cube.exr", "back.hdr", "--interleave", "bil")
        info = self.osiotool_json("info", "back.hdr")["parts"][0]
        self.assertEqual(info["sets"][0]["wavelengths_nm"], nm)
        with open(self.path("back.img"), "rb") as back, open(self.path("cube.img"), "rb") as first:
            self.assertEqual(back.read(), first.read())


if __name__ == "__main__":
    unittest.main()
