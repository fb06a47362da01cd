# SPDX-License-Identifier: Apache-2.0
"""Baked matrices: computed again in numpy, and applied by OpenColorIO's and OpenImageIO's own tools."""

import re
import unittest

import numpy as np

from osio_case import CONFIG, OsioCase, oracle_xyz, table

COLORCHECKER_TABLE = "reflectances/colorchecker_n_ohta.csv"
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
PROBES = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0.25, 0.5, 0.75), (0.9, 0.1, 0.4))


def samples():
    """(wavelengths, 24 reflectances)."""
    columns = table(COLORCHECKER_TABLE)
    nm = columns.pop("wavelength_nm")
    return nm, np.stack(list(columns.values()))


class Bake(OsioCase):
    def bake(self, what, name, *words, code=0):
        return self.osiotool("bake", what, name, *words, code=code)

    def matrix(self, what, *words, name="m.clf"):
        return np.array(self.osiotool_json("bake", what, name, *words)["matrix"])

    def seen_by_ocio(self, name, colour):
        said = self.check("ociochecklut", name, *colour)
        return np.array([float(x) for x in re.findall(r"[-+.\de]+", said.strip().splitlines()[-1])[:3]])

    def fit(self, source, target):
        return np.linalg.lstsq(source, target, rcond=None)[0].T


class Matrices(Bake):
    def test_adaptation(self):
        nm = table("observers/cie1931.csv")["wavelength_nm"]
        a, d65 = (oracle_xyz(nm, light).sum(axis=1) for light in ("A", "D65"))
        expected = np.linalg.inv(BRADFORD) @ np.diag(BRADFORD @ d65 / (BRADFORD @ a)) @ BRADFORD
        found = self.matrix("adaptation", "--from", "A", "--to", "D65")
        self.assertLess(np.abs(found - expected).max(), 1e-12)
        self.assertLess(np.abs(found @ a - d65).max(), 1e-12)
        scaled = self.matrix("adaptation", "--from", "A", "--to", "D65", "--adapt", "xyz-scaling")
        self.assertLess(np.abs(scaled - np.diag(d65 / a)).max(), 1e-12)

    def test_primaries(self):
        there = self.matrix("primaries", "--from", "acescg", "--to", "lin_rec709")
        back = self.matrix("primaries", "--from", "lin_rec709", "--to", "acescg")
        self.assertLess(np.abs(there @ back - np.eye(3)).max(), 1e-14)
        self.assertLess(np.abs(there.sum(axis=1) - 1).max(), 1e-14)
        same = self.matrix("primaries", "--from", "rgb:0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329", "--to", "lin_rec709")
        self.assertLess(np.abs(same - np.eye(3)).max(), 1e-15)

    def test_relight_is_the_least_squares_fit(self):
        nm, spectra = samples()
        source, target = (spectra @ oracle_xyz(nm, light).T for light in ("D65", "A"))
        report = self.osiotool_json("bake", "relight", "m.clf", "--from", "D65", "--to", "A")
        self.assertLess(np.abs(np.array(report["matrix"]) - self.fit(source, target)).max(), 1e-9)
        self.assertEqual(report["fitted_spectra"], 24)
        self.assertLess(report["residual_mean"], report["residual_max"])
        self.assertEqual([t["name"] for t in report["tables"]], ["D65", "A", "cie1931", "colorchecker"])

    def test_relight_of_a_table_of_ones_own(self):
        # Three spectra: a matrix says them exactly.
        nm, spectra = samples()
        chosen = spectra[[13, 14, 12]]
        with open(self.path("three.csv"), "w", encoding="utf-8") as file:
            file.write("nm,green,red,blue\n")
            for i, wavelength in enumerate(nm):
                file.write(",".join(repr(float(x)) for x in (wavelength, *chosen[:, i])) + "\n")
        report = self.osiotool_json("bake", "relight", "m.clf", "--from", "D65", "--to", "FL11", "--reflectances",
                                    "three.csv")
        self.assertEqual(report["fitted_spectra"], 3)
        self.assertLess(report["residual_max"], 1e-9)
        source, target = (chosen @ oracle_xyz(nm, light).T for light in ("D65", "FL11"))
        self.assertLess(np.abs(source @ np.array(report["matrix"]).T - target).max(), 1e-12)

    def test_white_is_kept_where_asked(self):
        nm = table("observers/cie1931.csv")["wavelength_nm"]
        a, d65 = (oracle_xyz(nm, light).sum(axis=1) for light in ("A", "D65"))
        words = ("relight", "--from", "D65", "--to", "A")
        self.assertLess(np.abs(self.matrix(*words, "--keep-white") @ d65 - a).max(), 1e-12)
        self.assertGreater(np.abs(self.matrix(*words) @ d65 - a).max(), 1e-3)

    def test_observer(self):
        nm, spectra = samples()
        source, target = (spectra @ oracle_xyz(nm, "D65", observer).T for observer in ("cie1931", "cie1964"))
        found = self.matrix("observer", "--from", "cie1931", "--to", "cie1964")
        self.assertLess(np.abs(found - self.fit(source, target)).max(), 1e-9)

    def test_a_camera_that_is_the_observer_is_fitted_without_rest(self):
        observer = table("observers/cie1931.csv")
        mix = np.array([[0.8, 0.3, -0.05], [-0.2, 1.1, 0.1], [0.02, 0.05, 0.9]])
        curves = mix @ np.stack([observer[c] for c in ("x_bar", "y_bar", "z_bar")])
        with open(self.path("camera.csv"), "w", encoding="utf-8") as file:
            for i, nm in enumerate(observer["wavelength_nm"]):
                file.write(",".join(repr(float(x)) for x in (nm, *curves[:, i])) + "\n")
        report = self.osiotool_json("bake", "camera", "m.clf", "--from", "camera.csv", "--to", "aces2065_1",
                                    "--illuminant", "D55")
        self.assertLess(report["residual_max"], 1e-6)
        # The matrix makes of the camera's picture the collapse to that space.
        self.colorchecker("shot.exr")
        words = ("--illuminant", "D55", "--basis", "linear", "--quiet")
        self.osiotool("collapse", "shot.exr", "camera.exr", "--to", "camera", "--observer", "camera.csv", *words)
        self.osiotool("collapse", "shot.exr", "aces.exr", "--to", "aces2065_1", *words)
        self.check("oiiotool", "--colorconfig", CONFIG, "camera.exr", "--ociofiletransform", self.path("m.clf"), "-o", "baked.exr")
        self.assertLess(np.abs(self.read("baked.exr")[1] - self.read("aces.exr")[1]).max(), 1e-6)


class Files(Bake):
    WORDS = ("--from", "D65", "--to", "A")

    def test_ocios_own_tool_reads_every_kind(self):
        matrix = self.matrix("relight", *self.WORDS)
        for name, words in (("m.clf", ()), ("m.spimtx", ()), ("m.cube", ()), ("n.cube", ("--size", "33")),
                            ("w.cube", ("--domain", "-1,4"))):
            self.bake("relight", name, *self.WORDS, *words)
            for colour in PROBES:
                found = self.seen_by_ocio(name, colour)
                self.assertLess(np.abs(found - matrix @ colour).max(), 1e-6, (name, colour))

    def test_a_cube_clips_beyond_its_domain(self):
        matrix = self.matrix("relight", *self.WORDS)
        self.bake("relight", "m.cube", *self.WORDS)
        self.assertLess(np.abs(self.seen_by_ocio("m.cube", (2, 2, 2)) - matrix @ (1, 1, 1)).max(), 1e-6)

    def test_images_go_through_oiiotool(self):
        self.colorchecker("shot.exr")
        for light, name in (("D65", "from.exr"), ("A", "to.exr")):
            self.osiotool("collapse", "shot.exr", name, "--to", "xyz", "--illuminant", light, "--quiet")
        source, target = (self.read(name)[1].astype(float) for name in ("from.exr", "to.exr"))
        matrix = self.matrix("relight", *self.WORDS)
        for name in ("m.clf", "m.spimtx", "m.cube"):
            self.bake("relight", name, *self.WORDS, "--domain", "0,2")
            self.check("oiiotool", "--colorconfig", CONFIG, "from.exr", "--ociofiletransform", self.path(name), "-o", "out.exr")
            found = self.read("out.exr")[1]
            self.assertLess(np.abs(found - source @ matrix.T).max(), 2e-6, name)
        self.assertLess(np.abs(found - target).max(), 0.05)  # what a matrix cannot say

    def test_the_words_are_inside(self):
        report = self.osiotool_json("bake", "relight", "m.clf", *self.WORDS)
        self.bake("relight", "m.cube", *self.WORDS)
        for name, opening in (("m.clf", "<Description>"), ("m.cube", "# ")):
            with open(self.path(name), encoding="utf-8") as file:
                lines = [line.strip() for line in file if line.strip().startswith(opening)]
            text = "\n".join(lines)
            self.assertIn(f"mean {report['residual_mean']:.4f}, max {report['residual_max']:.4f}", text)
            for used in report["tables"]:
                self.assertIn(f"{used['role']} {used['name']}, digest {used['digest']}", text)

    def test_names_that_xml_cannot_hold_are_escaped(self):
        with open(self.path("a&<b>.csv"), "w", encoding="utf-8") as file:
            file.write("400,1\n700,2\n")
        self.bake("adaptation", "m.clf", "--from", "a&<b>.csv", "--to", "D65")
        self.check("ociochecklut", "m.clf", 1, 1, 1)


class Refusals(Bake):
    def refused(self, code, piece, what, name, *words):
        self.assertIn(piece, self.bake(what, name, *words, code=code).stderr)
        self.assertNotIn(name, self.files())

    def test_words_that_mean_nothing(self):
        self.refused(2, 'did you mean "relight"?', "religt", "m.clf", "--from", "A", "--to", "D65")
        self.refused(2, "written as .clf, .spimtx or .cube", "relight", "m.lut", "--from", "A", "--to", "D65")
        self.refused(2, "did you mean", "relight", "m.clf", "--from", "D66", "--to", "A")
        self.refused(2, "is no linear space", "primaries", "m.clf", "--from", "srgb", "--to", "acescg")
        self.refused(2, "is no linear space", "primaries", "m.clf", "--from", "lab", "--to", "acescg")
        self.refused(2, "has no colour", "observer", "m.clf", "--from", "photopic", "--to", "cie1931")
        self.refused(2, "no set of reflectances", "relight", "m.clf", "--from", "A", "--to", "D65",
                     "--reflectances", "munsell")
        for what, names, words in (("primaries", ("acescg", "lin_rec709"), ("--reflectances", "colorchecker")),
                                   ("primaries", ("acescg", "lin_rec709"), ("--observer", "cie1931")),
                                   ("adaptation", ("A", "D65"), ("--keep-white",)),
                                   ("relight", ("A", "D65"), ("--illuminant", "D50")),
                                   ("relight", ("A", "D65"), ("--adapt", "cat02"))):
            self.refused(2, "has no use for", what, "m.clf", "--from", names[0], "--to", names[1], *words)
        self.refused(5, "No such file", "relight", "m.clf", "--from", "A", "--to", "D65", "--reflectances", "no.csv")
        for words in (("--size", "1"), ("--size", "1000"), ("--domain", "1,0"), ("--domain", "1")):
            self.refused(2, "expected", "relight", "m.cube", "--from", "A", "--to", "D65", *words)

    def test_spectra_that_span_no_colours(self):
        with open(self.path("greys.csv"), "w", encoding="utf-8") as file:
            file.write("400,0.1,0.2,0.3,0.4\n700,0.1,0.2,0.3,0.4\n")
        self.refused(1, "4 spectra do not span", "relight", "m.clf", "--from", "A", "--to", "D65", "--reflectances",
                     "greys.csv")


if __name__ == "__main__":
    unittest.main()
