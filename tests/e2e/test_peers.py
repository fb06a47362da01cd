# SPDX-License-Identifier: Apache-2.0
"""What we write, read as strictly as the two other readers of the layout read it: afichet/spectral-exr (the reference
library) and colour-science. Their rules are those of their sources, lib/SpectrumAttribute.cpp and
colour/io/fichet2021.py, in words of our own."""

import re
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import OsioCase

UNIT = r"(?:Y|Z|E|P|T|G|M|k|h|da|d|c|m|u|n|p)?(?:m|Hz)"
NUMBER = r"\d*\.?\d*(?:[Ee][+-]?\d+)?"


def in_nm(number, unit):
    scale = {"nm": 1, "um": 1e3, "mm": 1e6, "m": 1e9}
    return float(number) * scale[unit]


def reference_reads(text):
    """{nm: value}. A sample is digits, unit, colon, digits without a sign, and a semicolon; text that is not so is passed
    over without a word."""
    found = re.findall(rf"({NUMBER})({UNIT}):({NUMBER});", text)
    return {in_nm(number, unit): float(value) for number, unit, value in found}


def colour_reads(text):
    """{nm: value}. Samples between semicolons, each with one colon; an empty one, as behind a last semicolon, raises."""
    out = {}
    for piece in text.split(";"):
        domain, value = piece.split(":")
        match = re.match(rf"(\d*,?\d*(?:[eE][-+]?\d+)?)({UNIT})", domain.replace(".", ","))
        if match:
            out[in_nm(match.group(1).replace(",", "."), match.group(2))] = float(value)
    return out


class Peers(OsioCase):
    CURVES = {
        "lensTransmission": ("400nm:0.1;500,5nm:0.25;600nm:1e-05", {400: 0.1, 500.5: 0.25, 600: 1e-05}),
        "cameraResponse": (" 0.6um : 0.3 ; 400nm:0.1;", {400: 0.1, 600: 0.3}),
        "S0.450,000000nm": ("440nm:0;450nm:1;460nm:0;", {440: 0, 450: 1, 460: 0}),
    }

    def test_both_read_every_curve_whole(self):
        bands = {"S0.450,000000nm": np.ones((2, 3)), "S0.550,500000nm": np.ones((2, 3))}
        self.write_exr("in.exr", bands, attributes=[(name, text) for name, (text, _) in self.CURVES.items()])
        self.osiotool("convert", "in.exr", "tool.exr")
        self.check("oiiotool", "in.exr", "-o:fileformatname=spectralexr", "plugin.exr")
        self.osiotool("convert", "in.exr", "two.exr", "--preview", "none", "--multi-part", "--tile", "8x8")
        for name, subimage in (("tool.exr", 0), ("plugin.exr", 0), ("two.exr", 1)):
            spec = oiio.ImageBuf(self.path(name), subimage, 0).spec()
            for attribute, (_, curve) in self.CURVES.items():
                text = spec.get_string_attribute(attribute.replace(",000000", ""))
                self.assertEqual(reference_reads(text), curve, (name, attribute, text))
                self.assertEqual(colour_reads(text), curve, (name, attribute, text))

    def test_the_readers_of_this_test_are_as_strict_as_theirs(self):
        self.assertEqual(reference_reads("400nm:0.1;500nm:0.2;600nm:0.3"), {400: 0.1, 500: 0.2})
        self.assertEqual(reference_reads("400nm:0.1;500nm:-0.2;600nm:0.3;"), {400: 0.1, 600: 0.3})
        self.assertEqual(reference_reads("400 nm : 0.5 ;"), {})
        self.assertEqual(colour_reads("400nm:0.1;500nm:0.2"), {400: 0.1, 500: 0.2})
        with self.assertRaises(ValueError):
            colour_reads("400nm:0.1;500nm:0.2;")

    def test_names_are_those_that_both_parse(self):
        self.write_exr("in.exr", {"S0.0,55um": np.ones((2, 2)), "S0.1000,5nm": np.ones((2, 2))})
        self.osiotool("convert", "in.exr", "out.exr")
        for name in self.exr_channels("out.exr"):
            self.assertRegex(name, rf"^S[0-3]\.\d*,?\d*(?:[Ee][+-]?\d+)?{UNIT}$")

    def test_text_that_is_no_curve_stays_as_it_is(self):
        self.write_exr("in.exr", {"S0.450nm": np.ones((2, 2))}, attributes=[("lensTransmission", "uncoated, 400nm:1"),
                                                                            ("S0.450nm", "")])
        self.osiotool("convert", "in.exr", "out.exr")
        self.assertEqual(oiio.ImageBuf(self.path("out.exr")).spec().get_string_attribute("lensTransmission"), "uncoated, 400nm:1")


if __name__ == "__main__":
    unittest.main()
