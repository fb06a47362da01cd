# SPDX-License-Identifier: Apache-2.0
"""Filters, cameras, displays, luminance and scales through the tool and the plugin, against the same sums
written down in numpy."""

import unittest

import numpy as np
from osio_case import OsioCase, stack, table

GRID = list(range(400, 701, 10))
CMF = table("observers/cie1931.csv")
NM = CMF["wavelength_nm"]
BARS = np.stack([CMF[c] for c in ("x_bar", "y_bar", "z_bar")])
LIGHTS = table("illuminants/cie_1nm.csv")
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])

CAMERA = [[400, 0, 0, 1], [450, 0.05, 0.1, 0.8], [500, 0, 1, 0.2], [600, 1, 0.2, 0], [700, 0.1, 0, 0]]
DISPLAY = [[380, 0, 0, 0.1], [450, 0.01, 0.05, 1], [530, 0.05, 0.9, 0.1], [610, 1, 0.1, 0], [720, 0.05, 0, 0]]


def at_1nm(rows, column, beyond=0.0):
    """A table by straight lines at 1 nm; beyond it `beyond`, or its end values where that is None."""
    nm, values = np.array(rows, float)[:, 0], np.array(rows, float)[:, column]
    return np.interp(NM, nm, values, left=beyond, right=beyond)


class Observers(OsioCase):
    def setUp(self):
        super().setUp()
        reflectance, radiance = self.bands(GRID), self.bands(GRID, prefix="S0", high=40)
        self.write_exr("t.exr", reflectance)
        self.write_exr("s.exr", radiance)
        # Straight lines between bands, held beyond them: the spectra at 1 nm.
        curves = np.stack([np.interp(NM, GRID, row) for row in np.eye(len(GRID))])
        self.t = stack(reflectance, list(reflectance)) @ curves
        self.s = stack(radiance, list(radiance)) @ curves

    def csv(self, name, rows):
        return self.write_table(name, *(",".join(map(str, row)) for row in rows))

    def linear(self, source, **words):
        pixels, report, said = self.both(source, basis="linear", **words)
        return pixels, report, said

    def test_luminance_is_y_alone(self):
        light = LIGHTS["D65"]
        for scale in ("relative", "integral"):
            y, report, _ = self.linear("t.exr", to="luminance", illuminant="D65", scale=scale)
            k = 1 / (light @ BARS[1]) if scale == "relative" else 1
            self.assertEqual(report["channel_names"], ["Y"])
            self.expect(y[..., 0], k * self.t @ (light * BARS[1]))

    def test_scales_of_a_radiance(self):
        for scale, k in (("relative", 1 / BARS[1].sum()), ("photometric", 683.0), ("integral", 1.0)):
            xyz, _, _ = self.linear("s.exr", to="xyz", scale=scale)
            self.expect(xyz, k * self.s @ BARS.T)
            y, _, _ = self.linear("s.exr", to="luminance", scale=scale)
            self.expect(y[..., 0], k * self.s @ BARS[1])

    def test_scotopic_luminance(self):
        scotopic = table("observers/scotopic.csv")
        dark = np.interp(NM, scotopic["wavelength_nm"], list(scotopic.values())[1], left=0, right=0)
        y, _, _ = self.linear("s.exr", to="luminance", observer="scotopic", scale="photometric")
        self.expect(y[..., 0], 1700 * self.s @ dark)

    def test_a_camera_is_balanced_or_raw(self):
        camera = self.csv("camera.csv", CAMERA)
        curves = np.stack([at_1nm(CAMERA, c) for c in (1, 2, 3)])
        for light in ("A", "FL11"):
            power = LIGHTS[light]
            raw = self.t @ (power * curves).T
            balanced, report, _ = self.linear("t.exr", to="camera", observer=camera, illuminant=light)
            self.assertEqual(report["channel_names"], ["R", "G", "B"])
            self.expect(balanced, raw / (curves @ power))
            unscaled, _, _ = self.linear("t.exr", to="camera", observer=camera, illuminant=light, scale="integral")
            self.expect(unscaled, raw)
        radiance, _, _ = self.linear("s.exr", to="camera", observer=camera)
        self.expect(radiance, self.s @ curves.T / curves.sum(axis=1))

    def test_filters_darken_unless_normalised(self):
        amber, grey = [[400, 0.1], [500, 0.2], [600, 0.9], [700, 0.8]], [[300, 0.5], [900, 0.25]]
        paths = [self.csv("amber.csv", amber), self.csv("grey.csv", grey)]
        power, gel = LIGHTS["D65"], at_1nm(amber, 1, None)
        both = gel * at_1nm(grey, 1, None)
        one, _, _ = self.linear("t.exr", to="xyz", illuminant="D65", filter=paths[0])
        self.expect(one, self.t @ (power * gel * BARS).T / (power @ BARS[1]))
        two, _, _ = self.linear("t.exr", to="xyz", illuminant="D65", filter=",".join(paths))
        self.expect(two, self.t @ (power * both * BARS).T / (power @ BARS[1]))
        normal, _, _ = self.linear("t.exr", to="xyz", illuminant="D65", filter=paths[0],
                                   **{"filter-normalise": True})
        self.expect(normal, self.t @ (power * gel * BARS).T / (power * gel @ BARS[1]))
        radiance, _, _ = self.linear("s.exr", to="xyz", filter=paths[0])
        self.expect(radiance, self.s @ (gel * BARS).T / BARS[1].sum())

    def test_a_display_shows_the_colour(self):
        display = self.csv("display.csv", DISPLAY)
        primaries = BARS @ np.stack([at_1nm(DISPLAY, c) for c in (1, 2, 3)]).T
        primaries /= primaries[1].sum()
        shown, _, _ = self.linear("s.exr", to="display", display=display)
        self.expect(shown, self.s @ BARS.T / BARS[1].sum() @ np.linalg.inv(primaries).T)
        # A reflectance is adapted from its light's white to the display's.
        power = LIGHTS["A"]
        white, own = BARS @ power / (BARS[1] @ power), primaries.sum(axis=1)
        adapt = np.linalg.inv(BRADFORD) @ np.diag((BRADFORD @ own) / (BRADFORD @ white)) @ BRADFORD
        xyz = self.t @ (power * BARS).T / (power @ BARS[1])
        adapted, _, _ = self.linear("t.exr", to="display", display=display, illuminant="A")
        self.expect(adapted, xyz @ (np.linalg.inv(primaries) @ adapt).T)


if __name__ == "__main__":
    unittest.main()
