"""Reads green_finite_depth.csv and measures a Green function against it."""

from pathlib import Path

import numpy as np

from hakobune.bem.green.finite_depth import table_pairs
from hakobune.bem.green.tables import wave_table
from hakobune.bem.waves import wavenumber


def reference():
    """Structured array of the reference points, gravity 1."""
    with open(Path(__file__).with_name("green_finite_depth.csv")) as file:
        return np.genfromtxt((line for line in file if line[0] != "#"), delimiter=",", names=True)


def exact(rows):
    """G, ∂G/∂R and ∂G/∂z; complex (3, n)"""
    return np.array([rows[f"{name}_real"] + 1j * rows[f"{name}_imag"] for name in ("G", "G_R", "G_z")])


def by_frequency(function, rows):
    """`function(R, z, zeta, omega, depth)` → (G, ∂G/∂R, ∂G/∂z) at all rows"""
    out = np.empty((3, len(rows)), complex)
    for depth, omega in np.unique(rows[["depth", "omega"]]):
        here = (rows["depth"] == depth) & (rows["omega"] == omega)
        part = rows[here]
        out[:, here] = function(part["R"], part["z"], part["zeta"], omega, depth)
    return out


def by_table(accuracy, draft=1.0):
    """The function of `by_frequency` through a table of that accuracy."""

    def function(R, z, zeta, omega, depth):
        deepest = draft if np.isfinite(depth) else -min(z.min(), zeta.min())
        return table_pairs(wave_table(omega, depth, 1.0, 2000.0, deepest, accuracy), R, z, zeta)

    return function


def errors(found, rows, floor):
    """Error of G relative to |G|, of ∇G relative to |∇G|, or to `floor` times 1/r and 1/r² where these are larger."""
    wanted = exact(rows)
    r = np.hypot(rows["R"], rows["z"] - rows["zeta"])
    value = np.abs(found[0] - wanted[0]) / np.maximum(np.abs(wanted[0]), floor / r)
    size = np.hypot(np.abs(wanted[1]), np.abs(wanted[2]))
    off = np.hypot(*np.abs(found[1:] - wanted[1:]))
    return value, off / np.maximum(size, floor / r**2)


def wave_errors(found, rows):
    """Error of G without 1/r, 1/r₁ and 1/r₂ relative to the larger of its size and k."""
    wanted = exact(rows)[0]
    R, z, zeta, h = (rows[name] for name in ("R", "z", "zeta", "depth"))
    images = sum(1 / np.hypot(R, height) for height in (z - zeta, z + zeta, z + zeta + 2 * h))
    k = np.where(np.isfinite(h), wavenumber(rows["omega"], 1.0, 1.0), rows["omega"] ** 2)
    return np.abs(found[0] - wanted) / np.maximum(np.abs(wanted - images), k)
