# SPDX-License-Identifier: Apache-2.0
"""TIFF files through osiotool and OpenImageIO: those of GDAL read, ours read by GDAL and by stock OpenImageIO."""

import collections
import os
import unittest

import numpy as np
import OpenImageIO as oiio
from osgeo import gdal

from osio_case import HALF, OSIOTOOL, OsioCase, oracle_xyz

gdal.UseExceptions()

NM = np.arange(400, 710, 10)
TYPES = {"u1": gdal.GDT_Byte, "u2": gdal.GDT_UInt16, "i2": gdal.GDT_Int16, "u4": gdal.GDT_UInt32,
         "i4": gdal.GDT_Int32, "f4": gdal.GDT_Float32, "f8": gdal.GDT_Float64}


class TiffCase(OsioCase):
    def cube(self, shape=(6, 9), bands=len(NM)):
        return np.random.default_rng(5).random((*shape, bands)).astype(np.float32)

    def write_tiff(self, name, cube, kind="f4", options=(), items=None, image=None, no_data=None):
        """A cube of [y, x, band] by GDAL; `items(dataset_band, index)` states what a band is."""
        lines, samples, bands = cube.shape
        data = gdal.GetDriverByName("GTiff").Create(self.path(name), samples, lines, bands, TYPES[kind], list(options))
        for i in range(bands):
            band = data.GetRasterBand(i + 1)
            band.WriteArray(np.ascontiguousarray(cube[..., i]).astype(kind))
            (items or self.wavelength)(band, i)
            if no_data is not None:
                band.SetNoDataValue(no_data)
        for key, value in (image or {}).items():
            data.SetMetadataItem(key, value)
        data = None
        return name

    @staticmethod
    def wavelength(band, i):
        band.SetMetadataItem("wavelength", str(NM[i]))
        band.SetMetadataItem("wavelength_units", "Nanometers")

    def bits(self, name):
        return {n: p.view(np.uint32) for n, p in self.channels_of(name).items()}

    def assert_same_bits(self, found, expected):
        self.assertEqual(sorted(found), sorted(expected))
        for name in expected:
            self.assertTrue(np.array_equal(found[name], expected[name]), name)

    def warnings_of(self, name, *words):
        return self.osiotool_json("info", name, *words)["parts"][0]["warnings"]


class Read(TiffCase):
    def test_every_type_and_layout_is_the_sum_of_its_bands(self):
        for kind in TYPES:
            cube = self.cube() if kind[0] == "f" else np.round(self.cube() * 100)
            for options in ((), ("INTERLEAVE=BAND",), ("TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=LZW"),
                            ("BIGTIFF=YES", "ENDIANNESS=BIG", "COMPRESS=DEFLATE", "INTERLEAVE=BAND"),
                            ("COMPRESS=ZSTD", "PREDICTOR=2") if kind != "f8" else ("COMPRESS=DEFLATE", "PREDICTOR=3")):
                source = self.write_tiff("cube.tif", cube, kind, options)
                self.osiotool("convert", source, "cube.exr")
                found = self.channels_of("cube.exr")
                for i, nm in enumerate(NM):
                    self.assertTrue(np.array_equal(found[f"T.{nm}nm"], cube[..., i]), (kind, options, nm))
        found, report, _ = self.both(source, to="xyz", illuminant="D65", names="xyz", basis="linear")
        self.expect(found, cube.astype(float) @ oracle_xyz(NM, "D65").T)

    def test_a_collapse_is_that_of_the_same_exr_bit_for_bit(self):
        cube = self.cube((70, 50))
        self.write_exr("same.exr", {f"T.{nm}nm": cube[..., i] for i, nm in enumerate(NM)})
        for options in ((), ("INTERLEAVE=BAND", "COMPRESS=DEFLATE", "PREDICTOR=3")):
            source = self.write_tiff("cube.tif", cube, options=options)
            self.osiotool("collapse", source, "a.exr", "--to", "xyz", "--illuminant", "D65", "-d", "float")
            self.osiotool("collapse", "same.exr", "b.exr", "--to", "xyz", "--illuminant", "D65", "-d", "float")
            self.assert_same_bits(self.bits("a.exr"), self.bits("b.exr"))

    def test_scaled_whole_numbers_and_no_data(self):
        counts = np.round(self.cube() * 10000)
        counts[2, 3, 4] = 65535

        def items(band, i):
            self.wavelength(band, i)
            band.SetScale(0.0001)
            band.SetOffset(0.25)
        source = self.write_tiff("cube.tif", counts, "u2", items=items, no_data=65535)
        self.osiotool("convert", source, "cube.exr")
        found = self.channels_of("cube.exr")
        for i, nm in enumerate(NM):
            expected = (counts[..., i].astype(np.float64) * 0.0001 + 0.25).astype(np.float32)
            expected[counts[..., i] == 65535] = np.nan
            self.assertTrue(np.array_equal(found[f"T.{nm}nm"], expected, equal_nan=True), nm)
        self.assertTrue(any("65535, the no-data value, are NaN" in w for w in self.warnings_of(source)))

    def test_wavelengths_by_every_means(self):
        def by_imagery(band, i):
            band.SetMetadataItem("CENTRAL_WAVELENGTH_UM", repr(NM[i] / 1000), "IMAGERY")
            band.SetMetadataItem("FWHM_UM", "0.0125", "IMAGERY")

        def by_description(band, i):
            band.SetDescription(f"band {i + 1} ({NM[i]} Nanometers)")

        def by_micrometres(band, i):
            band.SetMetadataItem("wavelength", repr(NM[i] / 1000))

        def not_at_all(band, i):
            pass
        listed = {"wavelength": "{" + ", ".join(map(str, NM)) + "}", "wavelength_units": "Nanometers"}
        named = {f"Band_{i + 1}": f"{nm} nm" for i, nm in enumerate(NM)}
        for items, image in ((self.wavelength, {}), (by_imagery, {}), (by_description, {}), (by_micrometres, {}),
                             (not_at_all, listed), (not_at_all, named)):
            source = self.write_tiff("cube.tif", self.cube(), items=items, image=image)
            info = self.osiotool_json("info", source)
            self.assertEqual(info["format"], "TIFF")
            self.assertEqual(info["parts"][0]["sets"][0]["wavelengths_nm"], [float(nm) for nm in NM], items)
        source = self.write_tiff("cube.tif", self.cube(), items=by_micrometres)
        self.assertTrue(any("taken as micrometres" in w for w in self.warnings_of(source)))

    def test_bad_bands_and_radiance(self):
        cube = self.cube()
        cube[..., 7] = 1e6

        def items(band, i):
            self.wavelength(band, i)
            band.SetMetadataItem("bbl", str(int(i != 7)))
        source = self.write_tiff("cube.tif", cube, items=items, image={"data_units": "Radiance"})
        found, _, stderr = self.both(source, to="xyz", names="xyz", basis="linear")
        keep = np.arange(len(NM)) != 7
        self.expect(found, cube[..., keep].astype(float) @ oracle_xyz(NM[keep]).T)
        self.assertIn('1 of 31 bands are bad by "bbl"', stderr)

    def test_words_say_what_a_file_does_not(self):
        def items(band, i):
            pass
        source = self.write_tiff("cube.tif", self.cube(), items=items)
        stderr = self.osiotool("info", source, code=4).stderr
        self.assertIn("1 page with 31 samples a pixel, none of which has a wavelength", stderr)
        info = self.osiotool_json("info", source, "--wavelengths", "400:10:700", "--quantity", "radiance")
        self.assertEqual(info["parts"][0]["sets"][0]["wavelengths_nm"], [float(nm) for nm in NM])
        self.assertEqual(info["parts"][0]["sets"][0]["quantity"], "radiance")
        self.osiotool("info", source, "--wavelengths", "400:10:690", code=1)
        stated = self.write_tiff("stated.tif", self.cube(), image={"data_units": "Radiance"})
        self.osiotool("info", stated, "--quantity", "reflectance", code=1)

    def test_a_photograph_is_not_ours(self):
        self.check("oiiotool", "--create", "8x8", 3, "-d", "uint8", "-o", "photo.tif")
        self.assertIn("none of which has a wavelength", self.osiotool("info", "photo.tif", code=4).stderr)
        self.check("oiiotool", "photo.tif", "-o", "same.tif")

    def test_overviews_are_left_out(self):
        source = self.write_tiff("cube.tif", self.cube((64, 64)))
        data = gdal.Open(self.path(source), gdal.GA_Update)
        data.BuildOverviews("NEAREST", [2, 4])
        data = None
        info = self.osiotool_json("info", source)
        self.assertEqual(len(info["parts"]), 1)

    def test_truncated_files_end_in_an_error_and_nothing_is_left(self):
        for options in ((), ("COMPRESS=DEFLATE",)):
            source = self.write_tiff("cube.tif", self.cube((40, 40)), options=options)
            with open(self.path(source), "rb") as file:
                whole = file.read()
            for share in np.linspace(0.01, 0.99, 12):
                with open(self.path("cut.tif"), "wb") as file:
                    file.write(whole[:int(len(whole) * share)])
                self.osiotool("convert", "cut.tif", "out.exr", code=4)
                self.assertEqual(self.files(), ["cube.tif", "cut.tif"])


class Written(TiffCase):
    def shot(self, name="shot.exr", shape=(70, 33), **options):
        bands = self.bands(NM, shape, **options)
        first = next(iter(bands.values()))
        first.view(np.uint32)[0, :4] = [0x7FC00001, 0xFFC12345, 0x7F800000, 0x80000000]
        self.write_exr(name, bands)
        return bands

    def test_exr_to_tiff_and_back_bit_for_bit(self):
        self.shot()
        for words in ((), ("--compression", "none"), ("--compression", "zip")):
            self.osiotool("convert", "shot.exr", "cube.tif", *words)
            self.osiotool("convert", "cube.tif", "back.exr")
            self.assert_same_bits(self.bits("back.exr"), self.bits("shot.exr"))

    def test_others_read_the_same_numbers(self):
        bands = self.shot()
        expected = np.stack(list(bands.values()), axis=-1)
        for words in ((), ("--compression", "none")):
            self.osiotool("convert", "shot.exr", "cube.tif", *words)
            data = gdal.Open(self.path("cube.tif"))
            found = np.moveaxis(data.ReadAsArray(), 0, -1)
            self.assertEqual(found.tobytes(), expected.tobytes())
            band = data.GetRasterBand(6)
            self.assertEqual(band.GetMetadata(), {"wavelength": "450", "wavelength_units": "Nanometers"})
            self.assertEqual(band.GetMetadata("IMAGERY"), {"CENTRAL_WAVELENGTH_UM": "0.45"})
            self.assertEqual(band.GetDescription(), "450 nm")
            self.assertTrue(np.isnan(band.GetNoDataValue()))
            _, pixels = self.read("cube.tif")
            self.assertEqual(pixels.tobytes(), expected.tobytes())

    def test_attributes_and_radiance_come_back(self):
        bands = self.bands(NM, prefix="S0")
        attributes = [("owner", 'A & B < "C" {d}\nsecond line'), ("ISOSpeed", 125.5), ("take", 7),
                      ("emissiveUnits", "W.m^-2.sr^-1"), ("spectral:fwhm", "400nm:5;700nm:8;")]
        self.write_exr("shot.exr", bands, attributes=attributes)
        report = self.osiotool_json("convert", "shot.exr", "cube.tif")
        self.assertEqual(report["lost"], [])
        self.osiotool("convert", "cube.tif", "back.exr")
        there = self.check("exrheader", "shot.exr").splitlines()
        back = self.check("exrheader", "back.exr").splitlines()
        for word in ("ISOSpeed", "take", "owner"):
            lines = [line for line in there if line.startswith(word + " ")]
            self.assertEqual(len(lines), 1, word)
            self.assertIn(lines[0], back)
        part = self.osiotool_json("info", "cube.tif")["parts"][0]
        self.assertEqual(part["sets"][0]["quantity"], "radiance")
        self.assertEqual(part["warnings"], [])
        data = gdal.Open(self.path("cube.tif"))  # a band does not keep its file open
        self.assertEqual(data.GetRasterBand(1).GetMetadataItem("fwhm"), "5")

    def test_what_gdal_rewrites_comes_back_too(self):
        self.write_exr("shot.exr", self.bands(NM), attributes=[("take", 7)])
        self.osiotool("convert", "shot.exr", "cube.tif")
        gdal.Translate(self.path("again.tif"), self.path("cube.tif"), creationOptions=["TILED=YES", "COMPRESS=LZW"])
        self.osiotool("convert", "again.tif", "back.exr")
        self.assert_same_bits(self.bits("back.exr"), self.bits("shot.exr"))

    def test_what_is_lost_is_said(self):
        bands = self.bands([400, 500, 600])
        bands.update({c: bands["T.400nm"] for c in ("R", "G", "B", "A")})
        self.write_exr("shot.exr", bands, origin=(3, 4), full=(0, 0, 30, 40))
        report = self.osiotool_json("convert", "shot.exr", "cube.tif")
        self.assertEqual(report["lost"], ["channels A, B, G, R", "the place of the data window in the display window"])

    def test_ranges_halves_and_words(self):
        self.write_exr("shot.exr", self.bands(NM), types=HALF)
        report = self.osiotool_json("convert", "shot.exr", "cut.tif", "--bands", "500-600nm")
        self.assertEqual(report["bands"], 11)
        self.assertEqual(report["types"], ["float"])
        self.assertIn("none or zip", self.osiotool("convert", "shot.exr", "x.tif", "--compression", "piz", code=2).stderr)
        self.osiotool("convert", "shot.exr", "x.tif", "--interleave", "bil", code=2)
        self.osiotool("convert", "shot.exr", "x.tif", "-d", "half", code=2)
        self.assertEqual(self.files(), ["cut.tif", "shot.exr"])

    def test_many_bands_and_beyond_1000_nm(self):
        for count in (900, 4098):
            nm = [350 + 0.5 * i for i in range(count)]
            self.write_exr("shot.exr", self.bands(nm, (3, 5)), compression="none")
            self.osiotool("convert", "shot.exr", "cube.tif")
            self.osiotool("convert", "cube.tif", "back.exr")
            self.assertEqual(self.osiotool_json("info", "cube.tif")["parts"][0]["sets"][0]["wavelengths_nm"], nm)
            there, back = self.exr_bytes("shot.exr"), self.exr_bytes("back.exr")
            self.assertEqual(there, back)

    def exr_bytes(self, name):
        """{channel: bytes} through the plugin, which has no limit on channels as OpenImageIO's own reader has."""
        spec, pixels = self.read(f"{self.path(name)}?to=raw")
        return {n: pixels[..., i].tobytes() for i, n in enumerate(spec.channelnames)}

    def test_whatever_call_fails_the_old_file_stays(self):
        self.shot()
        os.mkdir(self.path("out"))

        def convert(call="", at=-1):
            with open(self.path("out/cube.tif"), "wb") as file:
                file.write(b"old")
            folder = os.path.realpath(self.path("out"))
            env = {"OSIO_FAULT_UNDER": folder, "OSIO_FAULT_LOG": self.path("log"), "OSIO_FAULT_CALL": call,
                   "OSIO_FAULT_AT": str(at), "OSIO_FAULT_ERRNO": "EIO", "LD_PRELOAD": ":".join(filter(None, (
                       os.environ.get("LD_PRELOAD", "").replace(" ", ":"), os.environ["OSIO_TEST_FAILING_CALLS"])))}
            return self.run_program(OSIOTOOL, "convert", "shot.exr", folder + "/cube.tif", env=env)

        self.assertEqual(convert().returncode, 0)
        with open(self.path("log")) as file:
            counts = collections.Counter(file.read().split())
        self.assertEqual(counts["rename"], 1)
        for call in ("write", "close", "rename"):
            self.assertGreater(counts[call], 0, call)
            for at in range(counts[call]):
                result = convert(call, at)
                self.assertEqual(result.returncode, 5, (call, at, result.stderr))
                with open(self.path("out/cube.tif"), "rb") as file:
                    self.assertEqual(file.read(), b"old", (call, at))
                self.assertEqual(os.listdir(self.path("out")), ["cube.tif"])


class Host(TiffCase):
    def test_queries_read_tiff_and_its_own_reader_keeps_plain_names(self):
        cube = self.cube()
        source = self.write_tiff("cube.tif", cube)
        spec, _ = self.read(source)
        self.assertEqual(self.format_of(source), "tiff")
        spec, pixels = self.read(f"{self.path(source)}?to=raw")
        self.assertEqual(list(spec.channelnames)[:2], ["T.400nm", "T.410nm"])
        self.assertTrue(np.array_equal(pixels, cube))
        image = oiio.ImageInput.open(f"{self.path(source)}?to=srgb&illuminant=D65")
        self.assertIsNotNone(image, oiio.geterror())


if __name__ == "__main__":
    unittest.main()
