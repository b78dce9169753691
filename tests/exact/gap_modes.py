"""Depth modes of a vertical-sided body and the functions that carry the flow through its keel gap.

ζ is measured from the bed, the gap is 0 < ζ < s = h − d.  Outside the modes are Z₀ = cosh kζ / cosh kh and
Zₙ = cos kₙζ, under the body cos l_qζ with l_q = qπ/s.  At the keel corner the horizontal velocity u(ζ) is
singular like distance^(−1/3), then ^(+1/3), then regular, so it is expanded in

    (s² − ζ²)^(ν−1/2) C₂ₚ^(ν)(ζ/s),   ν = 1/6, 5/6, 1/2   (Gegenbauer),

of which only the moments are needed (scaled here so that the mean of the function p = 0 is one):

    ∫ u cos lζ dζ = s 2^ν Γ(1+ν) (−1)^p J_{2p+ν}(ls) / (ls)^ν.

Sums over the modes end in a smooth cut-off, which removes the oscillating part of the tail faster than
any power; the monotone part is a series of known powers of the cut-off and is extrapolated away.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.special import gamma, ive, jv

from bem.waves import depth_factor, group_factor, wavenumber

NU = (1 / 6, 5 / 6, 1 / 2)
CUTOFFS = 0.8 ** np.arange(5)  # error 1e-8 at 100 modes; cut-offs that halve, four of them: 4e-7


def evanescent_wavenumbers(omega, depth, count, gravity):
    """kₙ of kₙ tan kₙh = −ω²/g in increasing order, (count,) rad/m."""
    y = omega**2 / gravity * depth
    turns = np.arange(1, count + 1) * np.pi
    x = turns - np.arctan(y / turns)
    for _ in range(6):  # Newton; the slope lies between 1 − 1/π and 1
        x -= (x - turns + np.arctan(y / x)) / (1 - y / (x**2 + y**2))
    return x / depth


@lru_cache(maxsize=64)
def tail_weights(count, power):
    """(count,) weights that turn Σ f(n), n = 1…count, into the sum to infinity.

    power : f(n) ~ n^(−power) (c₀ + c₁/n + …) plus oscillating terms
    """
    n = np.arange(1, count + 1)
    orders = power - 1 + np.arange(len(CUTOFFS) - 1)
    conditions = np.vstack([np.ones(len(CUTOFFS)), CUTOFFS[None] ** -orders[:, None]])
    combination = np.linalg.solve(conditions, np.eye(len(CUTOFFS))[0])
    return combination @ np.array([smooth_cutoff(n / (end * count)) for end in CUTOFFS])


def smooth_cutoff(x, start=0.1):
    """1 below `start`, 0 above 1, infinitely smooth between."""
    t = np.clip((np.asarray(x, float) - start) / (1 - start), 1e-3, 1 - 1e-3)
    return 1 / (1 + np.exp(np.clip(1 / (1 - t) - 1 / t, -700, 700)))


def mode_sum(rows, decay, factors):
    """Σₙ factorsₙ rowsᵢₙ rowsⱼₙ to infinity, (r, r).

    rows : (r, n), falling like n^(−decayᵢ); factors : (n,), falling like 1/n
    """
    total = np.zeros((len(rows), len(rows)), np.result_type(rows, factors))
    kinds = np.unique(decay)
    for a in kinds:
        left = np.flatnonzero(decay == a)
        for b in kinds[kinds >= a]:
            right = np.flatnonzero(decay == b)
            weights = factors * tail_weights(rows.shape[1], round(1 + a + b, 12))
            block = (rows[left] * weights) @ rows[right].T
            total[np.ix_(left, right)] = block
            total[np.ix_(right, left)] = block.T
    return total


@dataclass(frozen=True)
class Gap:
    """Depth modes and their moments for one frequency.

    draft, depth : m; omega : rad/s; width : smallest horizontal length of the body, m
    terms : functions per family; modes : evanescent modes per smallest length of the geometry
    """

    draft: float
    depth: float
    omega: float
    width: float
    gravity: float = 9.80665
    terms: int = 4
    modes: int = 100

    def __post_init__(self):
        if not 0 < self.draft < self.depth < np.inf:
            raise ValueError(f"draft {self.draft} m, depth {self.depth} m: need 0 < draft < depth < inf")
        if not 0 < self.omega < np.inf:
            raise ValueError(f"omega {self.omega} rad/s: must be positive and finite")

    @property
    def height(self):
        """s, m"""
        return self.depth - self.draft

    @cached_property
    def k(self):
        """rad/m"""
        return float(wavenumber(self.omega, self.depth, self.gravity))

    @cached_property
    def wave_norm(self):
        """∫ Z₀² dz, m"""
        return float(group_factor(self.k, self.depth)) * np.tanh(self.k * self.depth) / self.k

    @cached_property
    def outer_wavenumbers(self):
        """kₙ, (n,) rad/m"""
        shortest = min(self.height, self.draft, self.width)
        count = int(np.ceil(self.modes * self.depth / shortest + 4 * self.k * self.depth))
        return evanescent_wavenumbers(self.omega, self.depth, count, self.gravity)

    @cached_property
    def inner_wavenumbers(self):
        """l_q, q ≥ 1, (q,) rad/m"""
        count = int(np.ceil(2 * self.modes * max(1.0, self.height / self.width)))
        return np.arange(1, count + 1) * np.pi / self.height

    @cached_property
    def families(self):
        """ν and p of every function, two (f,) arrays"""
        return np.repeat(NU, self.terms), np.tile(np.arange(self.terms), len(NU))

    @cached_property
    def mean(self):
        """∫ u dζ of every function, (f,) m"""
        return self.height * (self.families[1] == 0)

    @cached_property
    def second_moment(self):
        """∫ ζ² u dζ of every function, (f,) m³"""
        nu, p = self.families
        value = np.where(p == 0, 1.0, np.where(p == 1, 1 / (2 + nu), 0.0))
        return self.height**3 * value / (2 * (1 + nu))

    def _moments(self, l):
        nu, p = (a[:, None] for a in self.families)
        x = l[None] * self.height
        return self.height * 2**nu * gamma(1 + nu) * (-1.0) ** p * jv(2 * p + nu, x) / x**nu

    @cached_property
    def wave_rows(self):
        """⟨·, Z₀⟩ of the functions and of the side velocities 1 and z, (f + 2,)"""
        (nu, p), k, s, d, h = self.families, self.k, self.height, self.draft, self.depth
        grow = 2 * np.exp(-k * d) / (1 + np.exp(-2 * k * h))  # e^{ks} / cosh kh
        functions = s * 2**nu * gamma(1 + nu) * ive(2 * p + nu, k * s) / (k * s) ** nu * grow
        sinh_s = -grow * np.expm1(-2 * k * s) / 2  # sinh ks / cosh kh
        one = (np.tanh(k * h) - sinh_s) / k
        z = d * sinh_s / k - (1 - depth_factor(-d, k, h)) / k**2
        return np.concatenate([functions, [one, z]])

    @cached_property
    def outer_rows(self):
        """⟨·, cos kₙζ⟩ of the functions and of the side velocities 1 and z, (f + 2, n)"""
        k, s, d, h = self.outer_wavenumbers, self.height, self.draft, self.depth
        one = (np.sin(k * h) - np.sin(k * s)) / k
        z = d * np.sin(k * s) / k + (np.cos(k * h) - np.cos(k * s)) / k**2
        return np.vstack([self._moments(k), one, z])

    @cached_property
    def inner_rows(self):
        """⟨·, cos l_qζ⟩, q ≥ 1, of the functions and of 1 and ζ², (f + 2, q)"""
        l = self.inner_wavenumbers
        signs = (-1.0) ** np.arange(1, len(l) + 1)
        return np.vstack([self._moments(l), 0 * l, 2 * self.height * signs / l**2])

    @cached_property
    def mean_rows(self):
        """⟨·, 1⟩ of the functions and of 1 and ζ², (f + 2,)"""
        s = self.height
        return np.concatenate([self.mean, [s, s**3 / 3]])

    def outside(self, wave_ratio, ratios):
        """Potential outside tested with every row, (f + 2, f + 2) complex.

        wave_ratio, ratios : R₀ and Rₙ, m
        """
        k, h = self.outer_wavenumbers, self.depth
        norms = h / 2 * (1 + np.sin(2 * k * h) / (2 * k * h))
        decay = np.append(self.families[0] + 0.5, [1.0, 1.0])
        wave = wave_ratio / self.wave_norm * np.outer(self.wave_rows, self.wave_rows)
        return wave + mode_sum(self.outer_rows, np.round(decay, 12), ratios / norms)

    def beneath(self, mean_ratio, ratios):
        """Potential under the body tested with every row, (f + 2, f + 2).

        mean_ratio, ratios : T₀ (zero where a constant is free instead) and T_q, m
        """
        decay = np.append(self.families[0] + 0.5, [2.0, 2.0])
        mean = mean_ratio / self.height * np.outer(self.mean_rows, self.mean_rows)
        return mean + mode_sum(self.inner_rows, np.round(decay, 12), 2 / self.height * ratios)
