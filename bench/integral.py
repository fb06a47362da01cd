#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What the rules of integration cost: the tables of docs/design/0002-the-integral.md.

    bench/integral.py

The truth is the sum at 1 nm of the 24 ColorChecker reflectances of tests/golden (Sprague, 360-830 nm). Each
rule sees them only at its bands. Distances are CIE 1976 dE*ab against the light's own white; the largest and the
mean over the patches. Needs numpy."""

import numpy as np

from tables import BARS, COLORCHECKER as PATCHES, LIGHTS, NM


def lab(xyz, white):
    t = xyz / white
    f = np.where(t > (6 / 29) ** 3, np.cbrt(np.maximum(t, 0)), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def at_1nm(curves, light):
    """XYZ of curves at 1 nm; the perfect diffuser has Y = 1."""
    return curves * light @ BARS.T / (light @ BARS[1])


def at_bands(curves, light, bands):
    """The sum over the bands themselves."""
    at = np.searchsorted(NM, bands)
    return curves[:, at] * light[at] @ BARS[:, at].T / (light[at] @ BARS[1][at])


def joined(curves, bands, beyond=None):
    """Straight lines between the bands; beyond them the last value, or `beyond`."""
    at = np.searchsorted(NM, bands)
    return np.stack([np.interp(NM, bands, c[at], left=beyond, right=beyond) for c in curves])


def cell(found, truth, white):
    distance = np.linalg.norm(lab(found, white) - lab(truth, white), axis=-1)
    return f"{distance.max():.2f} / {distance.mean():.2f}"


def main():
    print("| light | step | sum at the bands | lines, 1 nm (ours) |\n|---|---|---|---|")
    for name in ("D65", "A", "FL2", "FL11", "LED-B3"):
        light = LIGHTS[name]
        truth, white = at_1nm(PATCHES, light), at_1nm(np.ones_like(NM)[None], light)[0]
        for step in (5, 10, 20):
            bands = np.arange(380, 781, step)
            print(f"| {name} | {step} nm | {cell(at_bands(PATCHES, light, bands), truth, white)} "
                  f"| {cell(at_1nm(joined(PATCHES, bands), light), truth, white)} |")

    print("\n| radiance under | bands | zero | hold (ours) |\n|---|---|---|---|")
    even = np.ones_like(NM)
    for name in ("D65", "A"):
        radiance = PATCHES * LIGHTS[name] / 100
        truth, white = at_1nm(radiance, even), at_1nm(LIGHTS[name][None] / 100, even)[0]
        for first, last in ((400, 700), (380, 730)):
            bands = np.arange(first, last + 1, 10)
            zero, hold = joined(radiance, bands, 0), joined(radiance, bands)
            print(f"| {name} | {first}-{last} nm, every 10 | {cell(at_1nm(zero, even), truth, white)} "
                  f"| {cell(at_1nm(hold, even), truth, white)} |")


if __name__ == "__main__":
    main()
