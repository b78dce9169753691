"""Depth modes of a vertical-sided body, and basis functions of the velocity in the gap under its keel.

ζ is measured from the bed, the gap under the keel is 0 < ζ < s = h − d.  Modes over the depth, K = ω²/g:

    outside   Z₀ = cosh kζ / cosh kh,  k tanh kh = K;    Zₙ = cos kₙζ,  kₙ tan kₙh = −K
    beneath   cos l_qζ,  l_q = qπ/s

At the keel's edge, where the water has an angle of 270°, the horizontal velocity u(ζ) is a sum of terms like
distance^(−1/3), distance^(+1/3), and regular terms. u(ζ) is expanded in three Gegenbauer families

    U = (s² − ζ²)^(ν−½) C₂ₚ^(ν)(ζ/s),   ν = 1/6, 5/6, 1/2,   p = 0 … terms − 1,

scaled so that the mean of p = 0 is one and, by Gegenbauer's integral (DLMF 18.17.17),

    ∫₀ˢ U cos lζ dζ = s (−1)^p 2^ν Γ(1+ν) J_{2p+ν}(ls) / (ls)^ν,     I in place of (−1)^p J for cosh.

Arrays over functions are ordered family by family, with f = 3 · terms functions.  "Rows" are test functions of ζ or
z: the f functions of the gap, followed by additional functions (`outer_rows`, `inner_rows`).
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import gamma, ive

from ..froude_krylov import side_integrals
from ..waves import depth_factor, depth_factor_slope, group_factor, wavenumber
from .bessel import scaled_bessel

ORDERS = np.array([1 / 6, 5 / 6, 1 / 2])
CUTOFFS = 0.8 ** np.arange(5)


class OuterModes(NamedTuple):
    """Modes of the water outside the body at one frequency; rows are those of `Gap.outer_rows`.

    k : rad/m; wave_norm : ∫Z₀² dz, m; wave_rows : ⟨·, Z₀⟩, (f + 2,)
    wavenumbers : kₙ, rad/m, (n,); norms : ∫Zₙ² dz, m, (n,); rows : ⟨·, Zₙ⟩, (f + 2, n)
    """

    k: float
    wave_norm: float
    wave_rows: np.ndarray
    wavenumbers: np.ndarray
    norms: np.ndarray
    rows: np.ndarray


class InnerModes(NamedTuple):
    """Modes q = 1 … beneath the keel: wavenumbers l_q, rad/m, (q,), and the rows (f + 2, q) of `Gap.inner_rows`."""

    wavenumbers: np.ndarray
    rows: np.ndarray


@dataclass(frozen=True)
class Gap:
    """The water under a keel: draft and depth in m, `terms` functions in each of the three families."""

    draft: float
    depth: float
    terms: int

    @property
    def height(self):
        """Height s of the gap, m"""
        return self.depth - self.draft

    @cached_property
    def families(self):
        """ν and p of every function; two arrays (f,)"""
        return np.repeat(ORDERS, self.terms), np.tile(np.arange(self.terms), len(ORDERS))

    @cached_property
    def decays(self):
        """Exponent of each function, whose moments fall like l^(−decay); shape (f,)"""
        return self.families[0] + 0.5

    @cached_property
    def mean(self):
        """∫ U dζ of each function, m; shape (f,)"""
        return self.height * (self.families[1] == 0)

    @cached_property
    def second_moment(self):
        """∫ ζ² U dζ of each function, m³; shape (f,)"""
        nu, p = self.families
        value = np.where(p == 0, 1.0, np.where(p == 1, 1 / (2 + nu), 0.0))
        return self.height**3 * value / (2 * (1 + nu))

    def cosine_moments(self, l):
        """∫ U cos lζ dζ, m; shape (f, l); l : wavenumbers above 0, rad/m, (l,)"""
        sign = (-1.0) ** np.arange(self.terms)
        moments = scaled_bessel(ORDERS, l * self.height, self.terms)
        moments *= (self.height * sign)[:, None]
        return moments.reshape(-1, len(l))

    def wave_moments(self, k):
        """∫ U cosh kζ / cosh kh dζ of each function, m; shape (f,)"""
        (nu, p), x = self.families, k * self.height
        scale = self.height * 2**nu * gamma(1 + nu) / x**nu
        return scale * ive(2 * p + nu, x) * 2 * np.exp(-k * self.draft) / (1 + np.exp(-2 * k * self.depth))

    def outer_rows(self, l):
        """⟨·, cos lζ⟩ of the f functions, and of 1 and z on the side −d < z < 0; shape (f + 2, l)"""
        s, d, h = self.height, self.draft, self.depth
        one = 2 / l * np.sin(l * d / 2) * np.cos(l * (h + s) / 2)
        z = d * np.sin(l * s) / l - 2 / l**2 * np.sin(l * d / 2) * np.sin(l * (h + s) / 2)
        return np.vstack([self.cosine_moments(l), one, z])

    def wave_rows(self, k):
        """⟨·, Z₀⟩ of the f functions, and of 1 and z on the side; shape (f + 2,)"""
        return np.concatenate([self.wave_moments(k), side_integrals(self.draft, self.depth, k)])

    def side_wave_moments(self, k, l):
        """Integrals over the side of Z₀², a number, and of Z₀ cos lζ, (l,), m"""
        s, d, h = self.height, self.draft, self.depth
        edge, slope = depth_factor(-d, k, h), depth_factor_slope(-d, k, h) / k
        top = l * np.sin(l * h) + k * np.tanh(k * h) * np.cos(l * h)
        with_cosines = (top - l * edge * np.sin(l * s) - k * slope * np.cos(l * s)) / (k**2 + l**2)
        sech2 = 1 - np.tanh(k * h) ** 2
        return (np.tanh(k * h) - edge * slope) / (2 * k) + d / 2 * sech2, with_cosines

    def inner_rows(self, l):
        """⟨·, cos l_qζ⟩ of the f functions, and of 1 and ζ² in the gap; shape (f + 2, q); l : l_q, with l_q s a
        multiple of π"""
        sign = np.cos(l * self.height)
        return np.vstack([self.cosine_moments(l), 0 * l, 2 * self.height * sign / l**2])

    def mean_rows(self):
        """⟨·, 1⟩ of the f functions, and of 1 and ζ² in the gap; shape (f + 2,)"""
        s = self.height
        return np.concatenate([self.mean, [s, s**3 / 3]])

    @property
    def outer_decays(self):
        return np.append(self.decays, [1.0, 1.0])

    @property
    def inner_decays(self):
        return np.append(self.decays, [2.0, 2.0])

    def mode_count(self, k, modes, shortest=np.inf, further=8):
        """Number of evanescent modes outside, `modes` for each smallest length of gap, side and `shortest` (m).

        The sums need the asymptotic form of moments and modes: the moments of function p reach it at kₙs ≈ (2p)², the
        modes at n = kh. `further` is the number for functions p > 0, because sums of combinations that nearly vanish
        need more modes.
        Counts are rounded up in steps of a fifth, so that few tail weights are memoised.
        """
        s, h = self.height, self.depth
        least = 8 + further * (self.terms**2 - 1)
        count = max(modes * h / min(s, self.draft, shortest), least * h / s) + 4 * k * h
        return rounded(count)

    def inner_count(self, modes, shortest):
        """Number of modes beneath the keel, for a plan with the smallest half breadth or radius `shortest` (m)."""
        return rounded(max(modes * max(1.0, self.height / shortest), 32 * self.terms**2))

    def outer_modes(self, omega, count, gravity):
        """`OuterModes` at ω with `count` evanescent modes."""
        h, k = self.depth, float(wavenumber(omega, self.depth, gravity))
        wave_norm = float(group_factor(k, h)) * np.tanh(k * h) / k
        kn = evanescent_wavenumbers(omega, h, count, gravity)
        norms = h / 2 * (1 + np.sin(2 * kn * h) / (2 * kn * h))
        return OuterModes(k, wave_norm, self.wave_rows(k), kn, norms, self.outer_rows(kn))

    def inner_modes(self, count):
        """`InnerModes` q = 1 … count; they are independent of the frequency."""
        l = np.arange(1, count + 1) * np.pi / self.height
        return InnerModes(l, self.inner_rows(l))


def evanescent_wavenumbers(omega, depth, count, gravity):
    """Roots kₙ of kₙ tan kₙh = −ω²/g in increasing order, rad/m; shape (count,)."""
    y = omega**2 / gravity * depth
    turns = np.arange(1, count + 1) * np.pi
    x = turns - np.arctan(y / turns)
    for _ in range(4):  # Newton; the slope lies between 1 − 1/π and 1, the error after three is below 1e-15
        x -= (x - turns + np.arctan(y / x)) / (1 - y / (x**2 + y**2))
    return x / depth


def rounded(count):
    """A number of modes rounded up in steps of a fifth"""
    return int(np.ceil(1.2 ** np.ceil(np.log(count) / np.log(1.2))))


@lru_cache(maxsize=512)
def tail_weights(count, power):
    """Weights that extend Σ f(n), n = 1 … count, to infinity; shape (count,)

    power : f(n) ~ n^(−power) (c₀ + c₁/n + …) plus oscillating terms

    A smooth cut-off removes the oscillations faster than any power of the count.  The truncation error of the monotone
    part is a series of known powers of the cut-off; extrapolation from five cut-offs removes four of these powers.
    """
    orders = power - 1 + np.arange(len(CUTOFFS) - 1)
    conditions = np.vstack([np.ones(len(CUTOFFS)), CUTOFFS[None] ** -orders[:, None]])
    weights = np.linalg.solve(conditions, np.eye(len(CUTOFFS))[0]) @ _cut_off(count)
    weights.setflags(write=False)
    return weights


@lru_cache(maxsize=64)
def _cut_off(count):
    """Smooth cut-offs of n = 1 … count; shape (cut-offs, count)"""
    return smooth_cutoff(np.arange(1, count + 1) / (CUTOFFS[:, None] * count))


def smooth_cutoff(x):
    """A function that is 1 below 0.1, 0 above 1, and infinitely smooth between."""
    t = np.clip((np.asarray(x, float) - 0.1) / 0.9, 1e-3, 1 - 1e-3)
    return 1 / (1 + np.exp(np.minimum(1 / (1 - t) - 1 / t, 700.0)))


def mode_sum(rows, decays, factors):
    """Σₙ factorsₙ rowsᵢₙ rowsⱼₙ to infinity; shape (r, r).

    rows : terms that fall like n^(−decayᵢ) times oscillations, (r, n); decays : (r,)
    factors : terms that fall like 1/n, (n,)
    """
    total = np.zeros((len(rows), len(rows)), np.result_type(rows, factors))
    decays = np.round(decays, 12)
    kinds = np.unique(decays)
    for a in kinds:
        left = decays == a
        for b in kinds[kinds >= a]:
            right = decays == b
            weights = factors * tail_weights(rows.shape[1], float(np.round(1 + a + b, 12)))
            block = (rows[left] * weights) @ rows[right].T
            total[np.ix_(left, right)] = block
            total[np.ix_(right, left)] = block.T
    return total
