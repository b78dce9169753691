"""Wind sea and swell in one spectrum: six parameters (Ochi & Hubble 1976, Proc. 15th ICCE, eq. 11 and table 2b).

    S = ¼ Σ_j (b_j ω_j⁴)^λ_j / Γ(λ_j)  H_j² ω^−(4λ_j+1) exp(−b_j ω_j⁴/ω⁴),    b_j = λ_j + ¼

and its most probable member by significant height alone.  λ = 1 is Bretschneider's shape.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import gammainc, gammaincc, gammaln

from ..environment.allowed import positive, within
from ..environment.spectrum import Spectrum
from .systems import Sum


@dataclass(frozen=True, repr=False)
class OneSystem(Spectrum):
    """One term: height m, significant; peak_omega rad/s; shape λ"""

    height: float
    peak_omega: float
    shape: float
    name: str = "ochi_hubble"

    def __post_init__(self):
        positive("height of a system of waves", self.height, "m")
        positive("peak frequency", self.peak_omega, "rad/s")
        within("shape of a system of waves", self.shape, 0.3, 50)

    def density(self, omega):
        omega = np.asarray(omega, float)
        x = np.maximum(omega / self.peak_omega, 0.05)  # there the exponential is 0
        u = (self.shape + 0.25) * x**-4.0
        logarithm = self.shape * np.log(u) - gammaln(self.shape) - u
        return 0.25 * self.height**2 / (self.peak_omega * x) * np.exp(logarithm)

    def _moment(self, order, low, high):
        a, b = self.shape - order / 4, self.shape + 0.25
        if a <= 0:
            if np.any(np.isinf(high)):
                raise ValueError(f"{self.name}: moment {order} has no end at shape {self.shape:g}; give a high")
            return self._by_rule(order, low, high)
        with np.errstate(divide="ignore"):
            u, v = b * (low / self.peak_omega) ** -4.0, b * (high / self.peak_omega) ** -4.0
        part = np.where(u < a, gammainc(a, u) - gammainc(a, v), gammaincc(a, v) - gammaincc(a, u))
        level = self.height**2 / 16 * np.exp(gammaln(a) - gammaln(self.shape))
        return level * (b**0.25 * self.peak_omega) ** order * part

    def _by_rule(self, order, low, high):
        edges = np.geomspace(0.05 * self.peak_omega, np.max(high), 4001)
        values = edges**order * self.density(edges)
        whole = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(edges) * (values[1:] + values[:-1]))])
        return np.interp(high, edges, whole) - np.interp(low, edges, whole)

    def _grid(self):
        return self.peak_omega * np.geomspace(0.2, 100, 4000)


def six_parameters(swell, sea):
    """The sum of two systems, each (height m, peak_omega rad/s, shape)"""
    return Sum((OneSystem(*swell), OneSystem(*sea)), "ochi_hubble")


def ochi_hubble(height, **period):
    """The most probable sea of a significant height (m): the first row of the eleven of table 2b.

    Periods follow from it: ValueError for one that is given.  The print's heights, 0.84 and 0.54 of it, have 0.9972 of
    its energy; they are scaled to all of it.
    """
    given = [kind for kind, value in period.items() if value is not None]
    if given:
        raise ValueError(f"ochi_hubble: {' and '.join(given)} is given; allowed: none, periods follow from the height")
    H = within("wave height", positive("wave height", height, "m"), 0.1, 30.0, "m")
    whole = H / np.hypot(0.84, 0.54)
    swell = (0.84 * whole, 0.70 * np.exp(-0.046 * H), 3.00)
    return six_parameters(swell, (0.54 * whole, 1.15 * np.exp(-0.039 * H), 1.54 * np.exp(-0.062 * H)))
