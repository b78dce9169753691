"""The TMA spectrum: a JONSWAP sea in water of finite depth (Kitaigorodskii et al. 1975, Bouws et al. 1985).

    S = S_JONSWAP(ω) Φ(ω),    Φ = k⁻³ ∂k/∂ω / {(ω²/g)⁻³ 2ω/g} = tanh²(kh) / 2n,    n = ½(1 + 2kh/sinh 2kh)

Φ tends to ω²h/2g in long waves, where the tail of S becomes ω⁻³, and to 1 in short waves.  The peak period is the peak
period of the JONSWAP form. The spectrum is scaled to a given height, or by fetch to the height that is possible in
this depth.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hakobune.bem.waves import wavenumber

from ..environment.allowed import positive, within
from ..environment.periods import KINDS, the_one_period
from ..environment.spectra import HEIGHTS, LARGEST_GAMMA, PERIODS, jonswap_fetch, warn_if_steep
from ..environment.spectrum import NODES, WEIGHTS, Peaked, Spectrum
from .breaking import GRAVITY

DEEP = 20.0  # ω²h/g above which Φ differs from 1 by less than 2e-16
STEPS = 40  # panels of Gauss's rule per unit of ln ω, as narrow as the flank of the peak


@dataclass(frozen=True, repr=False, eq=False)
class Shallow(Spectrum):
    """The spectrum `jonswap`, a Peaked, times `level` Φ in water of `depth` m"""

    jonswap: Peaked
    depth: float
    level: float = 1.0
    gravity: float = GRAVITY
    name: str = "tma"

    @property
    def peak_omega(self):
        """ω_p of the JONSWAP form, rad/s"""
        return self.jonswap.peak_omega

    def density(self, omega):
        omega = np.asarray(omega, float)
        return self.level * self.jonswap.density(omega) * limited(omega, self.depth, self.gravity)

    @cached_property
    def _edges(self):
        """Edges of panels from where S vanishes to where Φ is 1, rad/s; shape (e,)"""
        low = 0.3 * self.peak_omega
        high = max(np.sqrt(DEEP * self.gravity / self.depth), 2.0 * self.peak_omega)
        between = np.geomspace(low, high, 2 + int(STEPS * np.log(high / low)))
        return np.union1d(between, [self.peak_omega])  # σ of the spectrum changes at the peak

    def _moment(self, order, low, high):
        deep = self._edges[-1]
        beyond = [np.maximum(end, deep) for end in (low, high)]
        tail = self.level * self.jonswap._moment(order, *beyond)
        return self._up_to(order, high) - self._up_to(order, low) + tail

    def _up_to(self, order, omega):
        edges = self._edges
        whole = np.concatenate([[0.0], np.cumsum(self._between(order, edges[:-1], edges[1:]))])
        omega = np.clip(omega, edges[0], edges[-1])
        i = np.clip(np.searchsorted(edges, omega, side="right") - 1, 0, len(edges) - 2)
        return whole[i] + self._between(order, edges[i], omega)

    def _between(self, order, a, b):
        half = 0.5 * (b - a)
        omega = 0.5 * (a + b)[..., None] + half[..., None] * NODES
        return half * ((omega**order * self.density(omega)) @ WEIGHTS)

    def _grid(self):
        return self.peak_omega * np.geomspace(0.3, 100, 4000)


def limited(omega, depth, gravity=GRAVITY):
    """Factor Φ at omega (…,) rad/s; 0 at omega = 0"""
    omega = np.asarray(omega, float)
    if np.isinf(depth):
        return np.ones_like(omega)
    safe = np.maximum(omega, 1e-6 * np.sqrt(gravity / depth))
    x = wavenumber(safe.ravel(), depth, gravity).reshape(safe.shape) * depth
    n = 0.5 + x / np.sinh(np.minimum(2 * x, 700.0))
    return np.where(omega > 0, np.tanh(x) ** 2 / (2 * n), 0.0)


def tma(height, depth, *, gamma=3.3, gravity=GRAVITY, **period):
    """TMA spectrum scaled to 4√m₀ = height.

    height, depth : m; one period of `periods.KINDS`, s, where peak_period is that of the JONSWAP form; gamma : 1 to 10
    """
    from scipy.optimize import brentq

    within("gamma", gamma, 1, LARGEST_GAMMA)
    within("wave height", positive("wave height", height, "m"), *HEIGHTS, "m")
    kind, value = the_one_period("tma", period)
    within(kind.replace("_", " "), value, *PERIODS, "s")
    positive("water depth of tma", depth, "m")
    if kind == "significant_period":
        raise ValueError("tma: significant_period is not defined for a TMA spectrum; give peak_period or mean_period")

    def of_peak(Tp):
        return Shallow(Peaked("jonswap", 1.0, 2 * np.pi / Tp, gamma), depth, 1.0, gravity)

    peak = value
    if kind != "peak_period":
        peak = brentq(lambda Tp: getattr(of_peak(Tp), KINDS[kind]) / value - 1, 0.5 * value, 3 * value, xtol=1e-9)
    unit = of_peak(peak)
    found = Shallow(unit.jonswap, depth, height**2 / 16 / unit.moment(0), gravity)
    warn_if_steep(found)
    return found


def tma_fetch(wind_speed, fetch, depth, *, gamma=3.3, gravity=GRAVITY):
    """TMA spectrum of a wind (m/s, at 10 m) over a fetch of `fetch` m: its height is reduced by the depth."""
    positive("water depth of tma", depth, "m")
    return Shallow(jonswap_fetch(wind_speed, fetch, gamma=gamma, gravity=gravity), depth, 1.0, gravity)
