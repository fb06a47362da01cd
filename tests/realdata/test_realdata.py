# SPDX-License-Identifier: Apache-2.0
"""Files that other software wrote, when they are at hand: OSIO_TEST_IMAGES names their folder. They are
not part of this project; where they are absent these tests are skipped, and ctest says so."""

import os
import re
import unittest

import numpy as np
import OpenImageIO as oiio

from osio_case import OsioCase, oracle_pairs, oracle_xyz, stack, table

IMAGES = os.environ.get("OSIO_TEST_IMAGES", "")


def wavelength_of(channel):
    """nm of a diagonal band such as T.380,000000nm or S0.300,0nm; None for other channels."""
    match = re.fullmatch(r"(?:T|S0)\.(\d+(?:,\d+)?)nm", channel)
    return float(match.group(1).replace(",", ".")) if match else None


class RealFiles(OsioCase):
    def setUp(self):
        super().setUp()
        if not os.path.isdir(IMAGES):
            self.skipTest(f"no real images in \"{IMAGES}\"")

    def file(self, name):
        return os.path.join(IMAGES, name)

    def check_collapse(self, name, bands, light=None, to="xyz"):
        """The tool and the plugin against numpy on what OpenImageIO's own reader sees."""
        source = self.file(name)
        spec, pixels = self.read(source)
        nm = {channel: wavelength_of(channel) for channel in spec.channelnames}
        spectral = [channel for channel in spec.channelnames if nm[channel] is not None]
        self.assertEqual(len(spectral), bands)
        planes = stack({c: pixels[..., i] for i, c in enumerate(spec.channelnames)}, spectral)
        expected = planes @ oracle_xyz([nm[c] for c in spectral], light).T
        options = ["--basis", "linear"] + (["--illuminant", light] if light else [])
        result = self.osiotool("collapse", source, "tool.exr", "--to", to, "--names", "xyz", *options)
        query = f"{source}?to={to}&names=xyz&basis=linear" + (f"&illuminant={light}" if light else "")
        scale = np.abs(expected).max()
        for way in (self.path("tool.exr"), query):
            found = stack(self.channels_of(way), "XYZ")
            self.assertLess(np.abs(found - expected).max(), 2e-6 * scale, way)
        return result.stderr

    def test_mitsuba_bins(self):
        # The obvious evaluation: the spectrum is constant in each bin, the end bins are held.
        source = self.file("mitsuba06_TestSphere.exr")
        spec, pixels = self.read(source)
        low = np.array([float(name.split("-")[0]) for name in spec.channelnames])
        self.assertEqual(len(low), 31)
        cmf = table("observers/cie1931.csv")
        nm = cmf["wavelength_nm"]
        weights = np.zeros((3, len(low)))
        for row, bar in enumerate(("x_bar", "y_bar", "z_bar")):
            # A sample of the table stands for the nanometre about it, its halves to both sides where an edge cuts it.
            fine = np.linspace(359.5, 830.5, 471 * 200 + 1)
            middle = (fine[1:] + fine[:-1]) / 2
            curve = np.interp(middle, nm, cmf[bar]) / 200
            bins = np.clip(np.searchsorted(low, middle, side="right") - 1, 0, len(low) - 1)
            weights[row] = np.bincount(bins, curve, len(low))
        expected = pixels @ (weights / cmf["y_bar"].sum()).T
        self.osiotool("collapse", source, "tool.exr", "--to", "xyz", "--names", "xyz")
        scale = np.abs(expected).max()
        for way in (self.path("tool.exr"), f"{source}?to=xyz&names=xyz"):
            found = stack(self.channels_of(way), "XYZ")
            self.assertLess(np.abs(found - expected).max(), 2e-5 * scale, way)
        info = self.osiotool_json("info", source)["parts"][0]
        self.assertEqual(info["dialect"], "Mitsuba 0.x bins")
        self.assertIn("Mitsuba version 0.4.1", info["dialect_evidence"])
        audit = self.osiotool_json("audit", source)["files"][0]["parts"][0]
        self.assertEqual(audit["writer"], "Mitsuba 0.x")
        self.assertEqual(audit["sets"][0]["basis"], "bins")

    def test_writers_are_told(self):
        found = {}
        for name in ("colour_D65.exr", "spectralexr_Macbeth.exr", "spectralexr_D65.exr", "BiSpectral.exr"):
            part = self.osiotool_json("audit", self.file(name))["files"][0]["parts"][0]
            found[name] = part["writer"], " ".join(quirk["what"] for quirk in part["quirks"])
        self.assertEqual(found["colour_D65.exr"][0], "colour-science")
        self.assertIn("EV is 15.7", found["colour_D65.exr"][1])
        self.assertIn("end without ';'", found["colour_D65.exr"][1])
        self.assertEqual(found["spectralexr_Macbeth.exr"][0], "the layout's reference library")
        self.assertEqual(found["spectralexr_D65.exr"][0], "the layout's reference library")
        self.assertIn("mirrored", found["BiSpectral.exr"][1])

    def test_spectralexr_macbeth(self):
        self.check_collapse("spectralexr_Macbeth.exr", 36, "D65")

    def test_macbeth_is_the_picture_its_writer_stored(self):
        # Its R,G,B are other software's collapse under D65: the same means, single patches within 0.03.
        source = self.file("spectralexr_Macbeth.exr")
        stored = stack(self.channels_of(source), "RGB")
        ours = stack(self.channels_of(f"{source}?to=lin_rec709&illuminant=D65"), "RGB")
        np.testing.assert_allclose(ours.mean(axis=(0, 1)), stored.mean(axis=(0, 1)), rtol=0.005)
        self.assertLess(np.abs(ours - stored).max(), 0.03)

    def test_ohta_in_half(self):
        self.check_collapse("Ohta1997.exr", 16, "FL11")

    def test_daylight_as_emission(self):
        self.check_collapse("spectralexr_D65.exr", 90)
        white = stack(self.channels_of(self.file("spectralexr_D65.exr") + "?to=xyz&names=xyz"), "XYZ")[0, 0]
        np.testing.assert_allclose(white[:2] / white.sum(), [0.31272, 0.32903], atol=2e-4)

    def test_daylight_beyond_the_visible(self):
        self.check_collapse("colour_D65.exr", 97)
        white = stack(self.channels_of(self.file("colour_D65.exr") + "?to=xyz&names=xyz"), "XYZ")[0, 0]
        np.testing.assert_allclose(white[:2] / white.sum(), [0.31272, 0.32903], atol=2e-4)

    def donaldson(self):
        """(bands, [y, x, band], pairs, [y, x, pair]) of BiSpectral.exr by OpenImageIO's own reader."""
        planes = self.channels_of(self.file("BiSpectral.exr"))
        bands = [c for c in planes if wavelength_of(c) is not None]
        pairs = [c for c in planes if re.fullmatch(r"T\.[\d,]+nm\.[\d,]+nm", c)]
        nm = [tuple(float(n.replace(",", ".")) for n in re.findall(r"([\d,]+)nm", c)) for c in pairs]
        return [wavelength_of(c) for c in bands], stack(planes, bands), nm, stack(planes, pairs)

    def test_a_fluorescent_sample_is_the_donaldson_matrix(self):
        bands, reflected, pairs, emitted = self.donaldson()
        self.assertEqual((len(bands), len(pairs)), (41, 820))
        for light in ("D65", "A", "FL11", "E"):
            expected = reflected @ oracle_xyz(bands, light).T + emitted @ oracle_pairs(pairs, light).T
            pixels, _, said = self.both(self.file("BiSpectral.exr"), to="xyz", illuminant=light, basis="linear")
            self.expect(pixels, expected)
            share = (emitted @ oracle_pairs(pairs, light).T)[..., 1] / expected[..., 1]
            print(f"{light}: reradiation is {100 * share.min():.1f} to {100 * share.max():.1f} % of Y")
            self.assertNotIn("fluorescent", said)

    def test_its_samples_are_shares_of_a_band_and_no_densities(self):
        # Measured on real paper: no exciting band may send out more power, or more photons, than it got.
        bands, reflected, pairs, emitted = self.donaldson()
        power, photons = reflected.copy(), reflected.copy()
        for i, (into, out) in enumerate(pairs):
            at = bands.index(into)
            power[..., at] += emitted[..., i]
            photons[..., at] += emitted[..., i] * out / into
        step = bands[1] - bands[0]
        print(f"largest share of power {power.max():.3f}, of photons {photons.max():.3f}; "
              f"as densities per nm {(reflected + step * (power - reflected)).max():.2f}")
        self.assertLess(photons.max(), 1)
        self.assertGreater((reflected + step * (power - reflected)).max(), 3)

    def test_bands_survive_a_round_trip_through_oiiotool(self):
        for name in ("spectralexr_Macbeth.exr", "Ohta1997.exr", "colour_D65.exr", "BiSpectral.exr"):
            source = self.file(name)
            self.check("oiiotool", f"{source}?to=raw", "-o:fileformatname=spectralexr", "o.exr")
            before, after = self.channels_of(source), self.channels_of("o.exr")
            spectral = [c for c in before if wavelength_of(c) is not None]
            by_wavelength = {wavelength_of(c): plane for c, plane in after.items()}
            for channel in spectral:
                self.assertTrue(np.array_equal(before[channel], by_wavelength[wavelength_of(channel)]), channel)
            for channel in "RGB":  # still what was made of these bands
                self.assertTrue(np.array_equal(before[channel], after[channel]), channel)


class Envi(OsioCase):
    """Cubes of real cameras, by the plugin against numpy, and to colour."""

    def cube(self, name, kind, shape):
        """The path of a header, and its numbers as [y, x, band]: both files are bil."""
        header = os.path.join(IMAGES, "..", "envi", name + ".hdr")
        if not os.path.exists(header):
            self.skipTest(f"no {header}")
        data = next(header[:-4] + ending for ending in (".raw", ".dat") if os.path.exists(header[:-4] + ending))
        return header, np.fromfile(data, kind).reshape(shape).transpose(0, 2, 1)

    def check_cube(self, name, kind, shape, illuminant):
        source, numbers = self.cube(name, kind, shape)
        image = oiio.ImageInput.open(source)
        self.assertIsNotNone(image, oiio.geterror())
        self.assertEqual(image.format_name(), "envi")
        spec = image.spec()
        found = image.read_image(0, 0, 0, spec.nchannels, spec.format)
        self.assertEqual(found.tobytes(), np.ascontiguousarray(numbers).tobytes())
        nm = [float(channel[2:-2]) for channel in spec.channelnames]
        self.assertEqual(nm, sorted(nm))
        expected = numbers.astype(float) @ oracle_xyz(nm, illuminant).T
        pixels, _, _ = self.both(source, to="xyz", illuminant=illuminant, names="xyz", basis="linear")
        self.expect(pixels, expected)

    def test_corn_kernels(self):
        self.check_cube("corn-kernel-hyperspectral", "<u2", (31, 580, 43), "A")

    def test_fenix(self):
        self.check_cube("fenix_Radiometric_8x2_1x1", "<f4", (1, 363, 384), "D65")


if __name__ == "__main__":
    unittest.main()
