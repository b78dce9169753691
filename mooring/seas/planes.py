"""A sea given as densities over frequency and direction, interpolated linearly."""

from dataclasses import dataclass

import numpy as np

from ..environment.sea import Sea
from ..environment.spectra import tabulated
from ..environment.spreading import Spreading

SAME = 1e-6  # rad, between two directions that are one
EQUAL = 1e-3  # of the largest density, difference of the densities of one direction that is there twice


@dataclass(frozen=True, eq=False, repr=False)
class TabulatedSpreading(Spreading):
    """Spreading of a two-dimensional spectrum, linear between its frequencies omega (n,) rad/s and directions angle
    (m,) rad.

    values : (n, m) 1/rad, with integral 1 in each row; angle : ascending over at most one turn, closed at its end
    """

    omega: np.ndarray
    angle: np.ndarray
    values: np.ndarray
    depends_on_frequency = True

    def __repr__(self):
        return f"<spreading of {len(self.omega)} frequencies and {len(self.angle)} directions>"

    def __str__(self):
        return f"spread over directions as {len(self.omega)} × {len(self.angle)} values of a file"

    def density(self, angle, omega=None):
        if omega is None:
            raise ValueError("the spreading of a two-dimensional spectrum depends on frequency; give omega")
        angle, omega = np.broadcast_arrays(np.asarray(angle, float), np.asarray(omega, float))
        i, s = _place(self.omega, omega)
        turned = np.mod(angle - self.angle[0], 2 * np.pi) + self.angle[0]
        closed = np.append(self.angle, self.angle[0] + 2 * np.pi)
        values = np.concatenate([self.values, self.values[:, :1]], axis=1)
        j, t = _place(closed, turned)
        low = (1 - t) * values[i, j] + t * values[i, j + 1]
        return (1 - s) * low + s * ((1 - t) * values[i + 1, j] + t * values[i + 1, j + 1])


def two_dimensional(omega, angle, density, name):
    """Sea of S(ω, θ) (n, m), m² s/rad²; omega : (n,) rad/s, ascending; angle : (m,) directions of travel, rad, in
    any order.

    A direction given twice, such as −180° and 180°, is used once if the densities agree.
    """
    turned = np.mod(angle, 2 * np.pi)
    turned = np.where(turned > 2 * np.pi - SAME, 0.0, turned)
    order = np.argsort(turned, kind="stable")
    angle, density = turned[order], np.asarray(density, float)[:, order]
    again = np.flatnonzero(np.diff(angle) < SAME)
    if np.abs(density[:, again + 1] - density[:, again]).max(initial=0.0) <= EQUAL * density.max(initial=0.0):
        angle, density = np.delete(angle, again + 1), np.delete(density, again + 1, axis=1)
    if len(angle) < 3 or np.diff(angle).min(initial=1.0) < SAME:
        raise ValueError(f"{name} has {len(angle)} directions; allowed: at least 3, all different")
    gaps = np.diff(angle, append=angle[0] + 2 * np.pi)
    if np.count_nonzero(gaps > 1.5 * np.median(gaps)):  # a sector: no waves travel outside it
        k = int(np.argmax(gaps))
        ends = angle[k] + 1e-4, angle[(k + 1) % len(angle)] - 1e-4 + 2 * np.pi * (k == len(angle) - 1)
        angle = np.mod(np.concatenate([angle, ends]), 2 * np.pi)
        density = np.concatenate([density, np.zeros((len(density), 2))], axis=1)
        order = np.argsort(angle)
        angle, density = angle[order], density[:, order]
        gaps = np.diff(angle, append=angle[0] + 2 * np.pi)
    weight = 0.5 * (gaps + np.roll(gaps, 1))  # weights of the trapezoidal rule
    total = density @ weight
    even = np.where(total[:, None] > 0, density / np.maximum(total, 1e-300)[:, None], 1 / (2 * np.pi))
    return Sea(tabulated(omega, total, name), 0.0, TabulatedSpreading(np.asarray(omega, float), angle, even))


def _place(rows, values):
    """Index of the place below (…,) and relative position up to the next; the end values outside"""
    i = np.clip(np.searchsorted(rows, values, side="right") - 1, 0, len(rows) - 2)
    return i, np.clip((values - rows[i]) / (rows[i + 1] - rows[i]), 0.0, 1.0)
