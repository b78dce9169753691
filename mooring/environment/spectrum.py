"""Functions common to all wave spectra, and two kinds of spectrum: peaked with a tail ω⁻⁵, and tabulated.

    S(ω) = A ω⁻⁵ exp{−5/4 (ω/ω_p)⁻⁴} γ^r,    r = exp{−(ω/ω_p − 1)²/2σ²},    σ = 0.07 for ω ≤ ω_p, 0.09 above

With x = ω/ω_p and u = 5/4 x⁻⁴ the spectrum for γ = 1 has m_n = A ω_pⁿ⁻⁴ (4/5)^(1−n/4) Γ(1 − n/4, u) / 4 (n = 4:
E₁(u)/4). The part added by γ > 1 is confined to 0.3 < x < 2 and is integrated by Gauss's rule.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import exp1, gamma, gammainc, gammaincc

from .allowed import positive, rising, row_of_numbers

SIGMA = (0.07, 0.09)
ORDERS = (-1, 0, 1, 2, 3, 4)
# panels over the range where γ^r differs from 1 by more than 1e-23, as narrow as σ, with an end where σ changes
PANELS = np.concatenate([np.linspace(0.3, 1, 11), np.linspace(1, 2, 15)[1:]])
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


class Spectrum:
    """A one-sided spectrum of wave elevation.  Periods in s, heights in m."""

    name: str
    T_significant: float | None = None

    def density(self, omega):
        """Spectral density, m² s/rad, at omega (...,), rad/s; shape (...,)"""
        raise NotImplementedError

    def moment(self, order, low=0.0, high=np.inf):
        """m_n = ∫ ωⁿ S dω between `low` and `high`, m² (rad/s)ⁿ.

        order : −1, 0, … 4; low, high : rad/s, numbers or arrays. The relative error is below 1e-8. Raises ValueError
        for any other order, for low ≥ high, and where the integral diverges.
        """
        if order not in ORDERS:
            raise ValueError(f"order of the moment is {order}; allowed: {', '.join(map(str, ORDERS))}")
        low, high = np.asarray(low, float), np.asarray(high, float)
        if not (np.all(low >= 0) and np.all(low <= high)):
            raise ValueError(
                f"the moment is requested from {np.min(low):g} to {np.max(high):g} rad/s; allowed: 0 ≤ low ≤ high"
            )
        value = self._moment(order, low, high)
        return value if value.ndim else float(value)

    def quantile(self, share):
        """Frequency ω (rad/s) below which a share of the energy lies, accurate to 1e-5 of the energy; share (...,) 0
        to 1 → (...,)
        """
        omega = self._grid()
        energy = self.moment(0, 0.0, omega)
        return np.interp(np.asarray(share) * self.moment(0), energy, omega)

    @property
    def significant_height(self):
        """4√m₀"""
        return 4 * np.sqrt(self.moment(0))

    @property
    def T01(self):
        """Mean period 2π m₀/m₁"""
        return 2 * np.pi * self.moment(0) / self.moment(1)

    @property
    def T02(self):
        """Mean period of zero crossings 2π √(m₀/m₂)"""
        return 2 * np.pi * np.sqrt(self.moment(0) / self.moment(2))

    @property
    def Te(self):
        """Energy period 2π m₋₁/m₀"""
        return 2 * np.pi * self.moment(-1) / self.moment(0)

    @property
    def Tp(self):
        """Peak period 2π/ω_p"""
        return 2 * np.pi / self.peak_omega

    def __repr__(self):
        return f"<{self.name} spectrum, 4√m₀ {self.significant_height:.4g} m, Tp {self.Tp:.4g} s>"


@dataclass(frozen=True, repr=False)
class Peaked(Spectrum):
    """A peaked spectrum; created by functions of `spectra`.

    level : A, m² (rad/s)⁴; peak_omega : rad/s; gamma : 1 or more
    significant_per_peak : T1/3 / Tp of the family, or None
    """

    name: str
    level: float
    peak_omega: float
    gamma: float = 1.0
    significant_per_peak: float | None = None

    def __post_init__(self):
        positive("level of the spectrum", self.level, "m² (rad/s)⁴")
        positive("peak frequency", self.peak_omega, "rad/s")

    @property
    def T_significant(self):
        """Significant period T1/3 by the relation of the family, or None"""
        return None if self.significant_per_peak is None else self.significant_per_peak * self.Tp

    def density(self, omega):
        omega = np.asarray(omega, float)
        if np.any(omega < 0):
            raise ValueError(f"frequency is {np.min(omega):g} rad/s; allowed: at least 0")
        x = np.maximum(omega / self.peak_omega, 0.1)  # there the exponential is 0, below it ω⁻⁵ would overflow
        return self.level * self.peak_omega**-5 * x**-5.0 * np.exp(-1.25 * x**-4.0) * self.gamma ** nearness(x)

    def _moment(self, order, low, high):
        low, high = low / self.peak_omega, high / self.peak_omega
        if order == 4 and np.any(np.isinf(high)):
            raise ValueError(
                f"{self.name} spectrum: its tail is ω⁻⁵, so its fourth moment is infinite; give high, "
                f"the highest frequency"
            )
        value = _moment_without_peak(order, low, high)
        if self.gamma > 1:
            value = value + self._excess(order, high) - self._excess(order, low)
        return self.level * self.peak_omega ** (order - 4.0) * value

    def _excess(self, order, x):
        """∫ xⁿ⁻⁵ exp(−5/4 x⁻⁴) (γ^r − 1) dx from the first panel to x"""
        x = np.clip(x, PANELS[0], PANELS[-1])
        whole = np.concatenate([[0.0], np.cumsum(self._excess_between(order, PANELS[:-1], PANELS[1:]))])
        i = np.clip(np.searchsorted(PANELS, x, side="right") - 1, 0, len(PANELS) - 2)
        return whole[i] + self._excess_between(order, PANELS[i], x)

    def _excess_between(self, order, a, b):
        half = 0.5 * (b - a)
        x = 0.5 * (a + b)[..., None] + half[..., None] * NODES
        peak = np.expm1(np.log(self.gamma) * nearness(x))
        return half * ((x ** (order - 5.0) * np.exp(-1.25 * x**-4.0) * peak) @ WEIGHTS)

    def _grid(self):
        return self.peak_omega * np.geomspace(0.3, 100, 4000)


@dataclass(frozen=True, eq=False, repr=False)
class Tabulated(Spectrum):
    """A tabulated spectrum: linear between its rows, zero outside; created by `spectra.tabulated`.

    omega : (n,) rad/s, rising; values : (n,) m² s/rad
    """

    name: str
    omega: np.ndarray
    values: np.ndarray

    def __post_init__(self):
        omega = rising("frequency of the spectrum", self.omega)
        values = row_of_numbers("density of the spectrum", self.values, 2)
        if len(omega) != len(values):
            raise ValueError(
                f"spectrum has {len(omega)} frequencies and {len(values)} densities; allowed: the same number"
            )
        if np.any(values < 0) or not np.any(values > 0):
            span = f"{values.min():g} to {values.max():g}"
            raise ValueError(f"density of the spectrum is {span} m² s; allowed: at least 0, and above 0 somewhere")
        object.__setattr__(self, "omega", omega)
        object.__setattr__(self, "values", values)

    @property
    def peak_omega(self):
        """Frequency of the largest row, rad/s"""
        return float(self.omega[np.argmax(self.values)])

    def density(self, omega):
        return np.interp(np.asarray(omega, float), self.omega, self.values, left=0.0, right=0.0)

    def _moment(self, order, low, high):
        if order == -1 and self.omega[0] == 0 and self.values[0] > 0 and np.any(low == 0):
            raise ValueError(
                f"{self.name} spectrum: moment −1 is infinite, since the density at frequency 0 is {self.values[0]:g} "
                f"m² s; give low, the lowest frequency, above 0"
            )
        return self._up_to(order, high) - self._up_to(order, low)

    def _up_to(self, order, omega):
        """∫ ωⁿ S dω from the first row; S = p + qω between rows"""
        a, b = self.omega[:-1], self.omega[1:]
        q = np.diff(self.values) / (b - a)
        whole = np.concatenate([[0.0], np.cumsum(_of_straight(order, self.values[:-1], q, a, b))])
        omega = np.clip(omega, a[0], b[-1])
        i = np.clip(np.searchsorted(self.omega, omega, side="right") - 1, 0, len(a) - 1)
        return whole[i] + _of_straight(order, self.values[i], q[i], a[i], omega)

    def _grid(self):
        count = max(8, 20_000 // len(self.omega))
        parts = np.linspace(self.omega[:-1], self.omega[1:], count, endpoint=False, axis=-1)
        return np.append(parts.ravel(), self.omega[-1])


def nearness(x):
    """Exponent r of the peak enhancement γ^r at ω/ω_p; shape (…,)"""
    return np.exp(-0.5 * ((x - 1) / np.where(x <= 1, *SIGMA)) ** 2)


def _moment_without_peak(order, low, high):
    """∫ xⁿ⁻⁵ exp(−5/4 x⁻⁴) dx"""
    with np.errstate(divide="ignore"):
        u, v = 1.25 * low**-4.0, 1.25 * high**-4.0
    if order == 4:
        return 0.25 * (exp1(v) - exp1(u))
    a = 1 - order / 4
    # the smaller of two complementary functions, so that a thin tail loses no digits
    part = np.where(u < 1, gammainc(a, u) - gammainc(a, v), gammaincc(a, v) - gammaincc(a, u))
    return 0.25 * 1.25**-a * gamma(a) * part


def _of_straight(order, value, slope, a, b):
    """∫ ωⁿ (value + slope (ω − a)) dω from a to b"""
    if order == -1:
        level = value - slope * a
        logarithm = np.log(np.where(a > 0, b, 1.0) / np.where(a > 0, a, 1.0))
        return level * logarithm + slope * (b - a)
    half = 0.5 * (b - a)
    nodes, weights = np.polynomial.legendre.leggauss(3)  # exact to degree 5 = 4 + 1
    omega = 0.5 * (a + b)[..., None] + half[..., None] * nodes
    return half * ((omega**order * (value[..., None] + slope[..., None] * (omega - a[..., None]))) @ weights)
