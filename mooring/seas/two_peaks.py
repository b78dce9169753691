"""Wind sea and swell in one spectrum: six parameters (Ochi & Hubble 1976, 15th ICCE, eq. 11 and table 2b).

    S = ¼ Σ_j (b_j ω_j⁴)^λ_j / Γ(λ_j)  H_j² ω^−(4λ_j+1) exp(−b_j ω_j⁴/ω⁴),    b_j = λ_j + ¼

The most probable spectrum of this family for a given significant height is `ochi_hubble`. λ = 1 is Bretschneider's
shape.

For a given height and peak period: Torsethaugen & Haver (2004, ISOPE), in the simplified form (DNV-RP-C205, appendix
A), with T_f = 6.6 H^(1/3) the peak period of a fully developed sea at a fetch of 370 km.  Both systems have λ = ¾, a
tail ω⁻⁴:

    T_p ≤ T_f   wind sea  r H, T_p, γ = 35 (2π r H/gT_p²)^0.857,   r = 0.7 + 0.3 exp{−[2(T_f − T_p)/(T_f − 2√H)]²}
                swell     √(1 − r²) H, T_f + 2
    T_p > T_f   swell     r H, T_p, γ = 35 (2πH/gT_f²)^0.857 (1 + 6 t),  r = 0.6 + 0.4 exp{−(t/0.3)²},
                wind sea  √(1 − r²) H, 6.6 (√(1 − r²) H)^(1/3),          t = (T_p − T_f)/(25 − T_f)

γ is at least 1; integration preserves the height of the enhanced system.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import gammainc, gammaincc, gammaln

from ..environment.allowed import positive, within
from ..environment.spectra import warn_if_steep
from ..environment.spectrum import NODES, PANELS, WEIGHTS, Spectrum, nearness
from .breaking import GRAVITY
from .systems import Sum

HIGHEST = 26.0  # m, of the most probable sea: the shape of its wind sea is 0.3 there
LEAST = 1e-3  # height of the second system over the total, below which it is omitted


@dataclass(frozen=True, repr=False)
class OneSystem(Spectrum):
    """One term of the sum; height : significant height, m; peak_omega : rad/s; shape : λ"""

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
                raise ValueError(
                    f"{self.name}: the moment of order {order} is infinite at the shape parameter "
                    f"{self.shape:g}; give high, the highest frequency"
                )
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


@dataclass(frozen=True, repr=False)
class Enhanced(Spectrum):
    """The spectrum `system` times level γ^r; its peak is raised as in JONSWAP"""

    system: OneSystem
    gamma: float
    level: float = 1.0
    name: str = "torsethaugen"

    @property
    def peak_omega(self):
        """rad/s"""
        return self.system.peak_omega

    def density(self, omega):
        x = np.asarray(omega, float) / self.peak_omega
        return self.level * self.system.density(omega) * self.gamma ** nearness(x)

    def _moment(self, order, low, high):
        excess = self._excess(order, high / self.peak_omega) - self._excess(order, low / self.peak_omega)
        return self.level * (self.system._moment(order, low, high) + excess)

    def _excess(self, order, x):
        """∫ ωⁿ S (γ^r − 1) dω from the first panel to x"""
        x = np.clip(x, PANELS[0], PANELS[-1])
        whole = np.concatenate([[0.0], np.cumsum(self._between(order, PANELS[:-1], PANELS[1:]))])
        i = np.clip(np.searchsorted(PANELS, x, side="right") - 1, 0, len(PANELS) - 2)
        return whole[i] + self._between(order, PANELS[i], x)

    def _between(self, order, a, b):
        half = 0.5 * (b - a) * self.peak_omega
        x = 0.5 * (a + b)[..., None] + 0.5 * (b - a)[..., None] * NODES
        omega, peak = self.peak_omega * x, np.expm1(np.log(self.gamma) * nearness(x))
        return half * ((omega**order * self.system.density(omega) * peak) @ WEIGHTS)

    def _grid(self):
        return self.system._grid()


def torsethaugen(height, *, peak_period=None, gravity=GRAVITY, **period):
    """Swell and wind sea for a significant height (m) and the period (s) of the higher peak.

    raises : ValueError for a period of any other kind, a period above 25 s, or waves too steep for wind waves
    """
    given = [kind for kind, value in period.items() if value is not None]
    if peak_period is None or given:
        state = f"{' and '.join(given)} is given" if given else "no period is given"
        raise ValueError(f"torsethaugen: {state}; give peak_period, which defines its two systems")
    H = within("wave height", positive("wave height", height, "m"), 0.1, 30.0, "m")
    full = 6.6 * H ** (1 / 3)
    Tp = within("peak period of torsethaugen", peak_period, 2 * np.sqrt(H), 25.0, "s")
    if Tp <= full:
        share = 0.7 + 0.3 * np.exp(-((2 * (full - Tp) / (full - 2 * np.sqrt(H))) ** 2))
        gamma = 35 * (2 * np.pi * share * H / (gravity * Tp**2)) ** 0.857
        other = full + 2.0
    else:
        t = (Tp - full) / (25.0 - full)
        share = 0.6 + 0.4 * np.exp(-((t / 0.3) ** 2))
        gamma = 35 * (2 * np.pi * H / (gravity * full**2)) ** 0.857 * (1 + 6 * t)
        other = None
    left = np.sqrt(1 - share**2) * H
    plain = Enhanced(OneSystem(share * H, 2 * np.pi / Tp, 0.75, "torsethaugen"), max(gamma, 1.0))
    parts = [Enhanced(plain.system, plain.gamma, (share * H) ** 2 / 16 / plain.moment(0))]
    if left > LEAST * H:
        other = 6.6 * left ** (1 / 3) if other is None else other
        parts.append(OneSystem(left, 2 * np.pi / other, 0.75, "torsethaugen"))
    found = Sum(tuple(parts), "torsethaugen")
    warn_if_steep(found)
    return found


def six_parameters(swell, sea):
    """The sum of two systems, each (height m, peak_omega rad/s, shape)"""
    return Sum((OneSystem(*swell), OneSystem(*sea)), "ochi_hubble")


def ochi_hubble(height, **period):
    """The most probable sea of a significant height (m): the first of the eleven rows of table 2b.

    The periods follow from the height, so a given period raises ValueError. The printed heights, 0.84 and 0.54 of
    the significant height, contain 0.9972 of the energy; both heights are scaled up to the full energy.
    """
    given = [kind for kind, value in period.items() if value is not None]
    if given:
        raise ValueError(
            f"ochi_hubble: {' and '.join(given)} is given; leave out the period, since periods follow from the height"
        )
    H = within("wave height", positive("wave height", height, "m"), 0.1, HIGHEST, "m")
    whole = H / np.hypot(0.84, 0.54)
    swell = (0.84 * whole, 0.70 * np.exp(-0.046 * H), 3.00)
    return six_parameters(swell, (0.54 * whole, 1.15 * np.exp(-0.039 * H), 1.54 * np.exp(-0.062 * H)))
