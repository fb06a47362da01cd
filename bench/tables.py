# SPDX-License-Identifier: Apache-2.0
"""The project's tables, as the programs of this folder that compute a truth of their own read them."""

import csv
import os

import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")


def table(path):
    """A CSV of the repository as {column: array}."""
    with open(os.path.join(ROOT, path)) as file:
        rows = list(csv.reader(file))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def reflectances(path):
    """Every curve of a table: n x wavelengths."""
    return np.stack([values for name, values in table(path).items() if name != "wavelength_nm"])


CMF = table("data/observers/cie1931.csv")
NM = CMF["wavelength_nm"]
BARS = np.stack([CMF[c] for c in ("x_bar", "y_bar", "z_bar")])
LIGHTS = table("data/illuminants/cie_1nm.csv")
# At 1 nm, 360-830 nm: 24 x 471.
COLORCHECKER = reflectances("tests/golden/colorchecker_n_ohta_1nm_sprague.csv")
