"""Spreading of the energy of a sea over directions:  S(ω, θ) = S(ω) D(θ),  ∫ D dθ = 1,  θ from the mean direction.

    cosine power        D = a cosⁿθ between two angles, 0 outside   (SR179 report, 1982, guideline 2.5: cos⁴, ±π/2)
    half cosine power   D = a cos²ˢ(θ/2),  a = Γ(s+1) / {2√π Γ(s+½)}   (Longuet-Higgins, Cartwright & Smith 1963)
    Mitsuyasu           the same with s = s_max (ω/ω_p)⁵ up to ω_p, s_max (ω/ω_p)^−2.5 above
                        (Mitsuyasu et al. 1975, Goda & Suzuki 1975; s_max 10 wind waves, 25 and 75 swell)
    wrapped normal      D = Σ exp{−(θ + 2πk)²/2σ²} / √(2π)σ

The circle is divided into 3600 cells. Every integral over directions is a sum over these cells, scaled to a total of
1.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import betainc, betaln, gammaln

from .allowed import positive, within

CELLS = 3600
ANGLES = (np.arange(CELLS) + 0.5) * (2 * np.pi / CELLS) - np.pi  # (3600,) rad, centres of the cells
EDGES = np.arange(CELLS + 1) * (2 * np.pi / CELLS) - np.pi
AT_ONCE = 256  # frequencies whose 3600 cells are kept in memory
COARSE = 1e-2  # largest error of the sum over cells before scaling


class Spreading:
    """A spreading function; angles in rad from the mean direction, −π to π."""

    depends_on_frequency = False

    def density(self, angle, omega=None):
        """Density over direction, 1/rad, at angles (...,), rad; shape (...,); omega, rad/s, broadcast with angle, only
        if the spreading depends on frequency"""
        raise NotImplementedError

    def shares(self, omega=None):
        """Share of the energy in each cell of the circle, shape (3600,) or (n, 3600); each row sums to 1.

        omega : (n,) rad/s, needed if the spreading depends on frequency.
        Raises ValueError if the spreading is too narrow for the cells.
        """
        row = None if omega is None else np.atleast_1d(omega)[:, None]
        share = self.density(ANGLES, row) * (2 * np.pi / CELLS)
        total = share.sum(axis=-1, keepdims=True)
        error = np.abs(total - 1).max()
        if not error <= COARSE:
            raise ValueError(
                f"{self!r}: the sum over cells of 0.1° differs from 1 by {error:.2g}; allowed: {COARSE:g}; give a "
                "long-crested sea (spreading None) for a spreading this narrow"
            )
        return share / total

    def quantile(self, share, omega=None):
        """Angles, rad, below which the shares (n,) of the energy lie; shape (n,); omega : (n,) rad/s, if the
        spreading depends on it
        """
        share = np.asarray(share, float)
        if not self.depends_on_frequency:
            return np.interp(share, np.concatenate([[0.0], np.cumsum(self.shares())]), EDGES)
        parts = range(0, len(share), AT_ONCE)
        return np.concatenate([self._quantile(share[i : i + AT_ONCE], omega[i : i + AT_ONCE]) for i in parts])

    def _quantile(self, share, omega):
        cells = self.shares(omega)
        below, rows = np.cumsum(cells, axis=1), np.arange(len(share))
        i = np.argmax(below >= share[:, None] * below[:, -1:], axis=1)
        inside = np.where(cells[rows, i] > 0, cells[rows, i], 1.0)
        return EDGES[i + 1] - (below[rows, i] - share) / inside * (2 * np.pi / CELLS)


@dataclass(frozen=True)
class CosinePower(Spreading):
    """Spreading a cosⁿθ between `low` and `high` (rad, within ±π/2), 0 outside; exponent n ≥ 0."""

    exponent: float
    low: float = -0.5 * np.pi
    high: float = 0.5 * np.pi

    def __post_init__(self):
        within("exponent of the spreading", self.exponent, 0, 1e4)
        if not -np.pi / 2 <= self.low < self.high <= np.pi / 2:
            raise ValueError(
                f"the spreading extends from {self.low:g} to {self.high:g} rad; allowed: −π/2 ≤ low < high ≤ π/2"
            )

    def __str__(self):
        sector = (
            ""
            if (self.low, self.high) == (-np.pi / 2, np.pi / 2)
            else (f" between {np.degrees(self.low):.4g}° and {np.degrees(self.high):.4g}°")
        )
        return f"spread over directions by cosine to the power of {self.exponent:g}{sector}"

    def density(self, angle, omega=None):
        inside = (angle >= self.low) & (angle <= self.high)
        return np.where(inside, np.maximum(np.cos(angle), 0.0) ** self.exponent, 0.0) / self._integral()

    def _integral(self):
        """∫ cosⁿ; from 0 to θ it is ½ B(½, (n+1)/2) I(sin²θ)"""
        p, q = 0.5, 0.5 * (self.exponent + 1)
        ends = np.array([self.low, self.high])
        parts = np.sign(ends) * betainc(p, q, np.sin(ends) ** 2)
        return 0.5 * np.exp(betaln(p, q)) * (parts[1] - parts[0])


@dataclass(frozen=True)
class HalfCosinePower(Spreading):
    """Spreading a cos²ˢ(θ/2); s ≥ 0."""

    s: float

    def __post_init__(self):
        within("s of the spreading", self.s, 0, 1e5)

    def __str__(self):
        return f"spread over directions by cosine of half the angle to the power of {2 * self.s:g}"

    def density(self, angle, omega=None):
        return _half_cosine(angle, self.s)


@dataclass(frozen=True)
class Mitsuyasu(Spreading):
    """Spreading a cos²ˢ(θ/2), where s has its largest value `s_max` at the peak frequency (rad/s) of the spectrum."""

    s_max: float
    peak_omega: float
    depends_on_frequency = True

    def __post_init__(self):
        within("s_max of the spreading", self.s_max, 0, 1e5)
        positive("peak frequency of the spreading", self.peak_omega, "rad/s")

    def __str__(self):
        return f"spread over directions after Mitsuyasu, s_max {self.s_max:g}"

    def density(self, angle, omega=None):
        if omega is None:
            raise ValueError("Mitsuyasu's spreading depends on the frequency; give the frequency omega")
        return _half_cosine(angle, self.exponent(omega))

    def exponent(self, omega):
        """Exponent s at omega (…,) rad/s"""
        x = np.asarray(omega, float) / self.peak_omega
        with np.errstate(divide="ignore"):
            return self.s_max * np.where(x <= 1, x**5.0, x**-2.5)


@dataclass(frozen=True)
class WrappedNormal(Spreading):
    """Normal distribution of standard deviation `sigma` (rad), wound round the circle."""

    sigma: float

    def __post_init__(self):
        within("sigma of the spreading", self.sigma, 1e-3, np.pi, "rad")

    def __str__(self):
        return f"spread over directions normally, {np.degrees(self.sigma):.4g}° of deviation"

    def density(self, angle, omega=None):
        turns = 2 * np.pi * np.arange(-6, 7)  # the sixth turn adds e⁻⁵⁰ at σ = π
        distance = (np.asarray(angle)[..., None] + turns) / self.sigma
        return np.exp(-0.5 * distance**2).sum(axis=-1) / (np.sqrt(2 * np.pi) * self.sigma)


def _half_cosine(angle, s):
    level = np.exp(gammaln(s + 1) - gammaln(s + 0.5)) / (2 * np.sqrt(np.pi))
    return level * np.abs(np.cos(0.5 * angle)) ** (2 * s)
