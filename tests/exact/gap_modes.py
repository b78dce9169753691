"""Eigenfunctions over the depth, and the velocity through the gap under a vertical-sided body.

ζ is measured from the bed, the gap is 0 < ζ < s = h − d.  Outside the modes are Z₀ = cosh kζ / cosh kh and
Zₙ = cos kₙζ, under the body cos l_qζ with l_q = qπ/s (Garrett, J. Fluid Mech. 46, 1971; Yeung, Appl. Ocean Res. 3,
1981).  At the keel's edge, of 270° in water, the horizontal velocity is a series of thirds of the distance s τ³ that
begins with −1/3, so it is expanded in Legendre polynomials of τ:

    u(ζ) = Σ cₚ Pₚ(2τ − 1) √(2p + 1) / τ,     ζ = s (1 − τ³),     ∫ u f dζ = 3s ∫₀¹ Σ cₚ Pₚ √(2p + 1) f τ dτ,

with all moments by Gauss quadrature.  A sum over modes falls like n^(−7/3) only.  The leading terms −1/kₙ + c/kₙ² and
1/l_q + c/l_q² of the ratios of potential to velocity are therefore summed in closed form, with x, y = πζ/H, πζ'/H:

    Σ cos qx cos qy / q  = −½ ln |2 cos x − 2 cos y|
    Σ cos qx cos qy / q² = ½ [b(x + y) + b(|x − y|)],     b(t) = π²/6 − πt/2 + t²/4

and only what is left, n^(−10/3) with a changing sign and n^(−13/3), term by term.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import ceil

import numpy as np

from .water_waves import cosh_ratio, evanescent_wavenumbers, sinh_ratio, wave_norm, wavenumber

PANEL = 24.0  # rad that the phase of the last mode turns in one panel of NODES Gauss points
NODES = 32
BLOCK = 100  # modes that share their Gauss points
FAR, POINTS = 200.0, 48  # rad from which moments are found by steepest descent, with so many points
FEWEST = 8  # functions; ζ² in the gap is one of degree seven in τ


def legendre(tau, terms):
    """Pₚ(2τ − 1) √(2p + 1), orthonormal on 0 < τ < 1, (…, terms)"""
    return np.polynomial.legendre.legvander(2 * tau - 1, terms - 1) * np.sqrt(2 * np.arange(terms) + 1)


@lru_cache(maxsize=64)
def gauss_points(count):
    """τ and weights of `count` panels between which the phase of a mode is shared equally"""
    edges = np.cbrt(np.arange(count + 1) / count)
    edges = np.concatenate([[0.0, 0.4 * edges[1], 0.75 * edges[1]], edges[1:]])
    x, w = np.polynomial.legendre.leggauss(NODES)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (x + 1)).ravel(), (half * w).ravel()


def moments(x, terms):
    """∫ u cos lζ dζ / s of every function at ls = x in increasing order, (terms, x)"""
    near = np.searchsorted(x, FAR)
    parts = []
    for part in np.array_split(x[:near], 1 + near // BLOCK):
        tau, weight = gauss_points(ceil(max(part, default=0.0) / PANEL) or 1)
        parts.append(np.cos(np.multiply.outer(part, 1 - tau**3)) @ (legendre(tau, terms) * (3 * tau * weight)[:, None]))
    parts.append(far_moments(x[near:], terms))
    return np.concatenate(parts).T


def far_moments(x, terms):
    """The same, (x, terms), by steepest descent: Re[exp(ix) F(x)] with the path of F turned into two

    from the edge, τ = w exp(−iπ/6) x^(−1/3), and back to the bed, τ³ = 1 − iv/x.
    """
    edge, bed = descents(terms)
    inverse = FAR / x
    from_edge = (np.polynomial.chebyshev.chebvander(2 * np.cbrt(inverse) - 1, POINTS - 1) @ edge) * np.exp(1j * x)[
        :, None
    ]
    to_bed = np.polynomial.chebyshev.chebvander(2 * inverse - 1, POINTS - 1) @ bed
    return from_edge.real / np.cbrt(x * x)[:, None] - to_bed.real / x[:, None]


@lru_cache(maxsize=8)
def descents(terms):
    """Chebyshev coefficients of the two integrals in (FAR/x)^(1/3) and FAR/x, (POINTS, terms) each"""
    chebyshev = np.cos(np.pi * (np.arange(POINTS) + 0.5) / POINTS)
    inverse = (chebyshev + 1) / 2
    w, weight = np.polynomial.legendre.leggauss(POINTS)
    w, weight = 1.8 * (w + 1), 1.8 * weight  # exp(−3.6³) is 1e-20
    tau = np.multiply.outer(inverse, w) * np.exp(-1j * np.pi / 6) / np.cbrt(FAR)
    edge = np.exp(-1j * np.pi / 3) * np.einsum("xwt,w->xt", legendre(tau, terms), 3 * w * np.exp(-(w**3)) * weight)
    v, weight = np.polynomial.laguerre.laggauss(POINTS)
    tau = (1 - 1j * np.multiply.outer(inverse, v) / FAR) ** (1 / 3)
    bed = -1j * np.einsum("xv,xvt->xt", weight / tau, legendre(tau, terms))
    matrix = np.polynomial.chebyshev.chebvander(chebyshev, POINTS - 1)
    return np.linalg.solve(matrix, edge), np.linalg.solve(matrix, bed)


@lru_cache(maxsize=2)
def tanh_sinh(step=0.07, last=3.4):
    """Points, distances to 1 and weights on (0, 1) for integrands with logarithms at both ends"""
    t = np.arange(-last, last + step / 2, step)
    u = np.pi / 2 * np.sinh(t)
    weight = step * np.pi / 4 * np.cosh(t) / np.cosh(u) ** 2
    return 1 / (1 + np.exp(-2 * u)), 1 / (1 + np.exp(2 * u)), weight


@lru_cache(maxsize=64)
def closed_sums(share, terms):
    """Σ mᵢmⱼ / q and Σ mᵢmⱼ / q², q = 1 … ∞, of the moments at ls = qπ share, two (terms, terms) arrays.

    share : s / H, at most one.  On the half τ' = τy, y < 1, of the square; the other is its mirror image.
    """
    tau, left, w = tanh_sinh()
    y, lack, v = tanh_sinh()
    cube, cube_y = tau**3, lack * (1 + y + y * y)  # 1 − y³
    bed = left * (1 + tau + tau * tau)  # 1 − τ³
    apart = cube[:, None] * cube_y  # (ζ' − ζ) / s
    both = 2 * bed[:, None] + apart  # (ζ + ζ') / s
    edge = cube[:, None] * (2 - cube_y)  # 2 − (ζ + ζ') / s
    sine = np.sin(np.pi / 2 * edge) if share == 1 else np.sin(np.pi / 2 * share * both)
    log = -0.5 * np.log(4 * sine * np.sin(np.pi / 2 * share * apart))
    x_plus, x_minus = np.pi * share * both, np.pi * share * apart
    square = 0.5 * sum(np.pi**2 / 6 - np.pi * t / 2 + t * t / 4 for t in (x_plus, x_minus))
    first = legendre(tau, terms) * (9 * tau**3 * w)[:, None]
    second = legendre(np.multiply.outer(tau, y), terms) * (y * v)[:, None]
    halves = (first.T @ np.einsum("ty,tyj->tj", kernel, second) for kernel in (log, square))
    return tuple(half + half.T for half in halves)


@lru_cache(maxsize=16)
def beyond(count, share, terms):
    """`moments` at nπ share, n = 1 … count, and Σ mᵢmⱼ / n and Σ mᵢmⱼ / n² of all n above"""
    n = np.arange(1, count + 1)
    rows = moments(n * np.pi * share, terms)
    first, second = closed_sums(share, terms)
    return rows, first - (rows / n) @ rows.T, second - (rows / n**2) @ rows.T


@dataclass(frozen=True)
class Gap:
    """Depth modes and the velocities through the gap for one frequency.

    draft, depth : m; omega : rad/s; width : smallest horizontal length of the body, m
    terms : functions of the gap, f of them; modes : evanescent modes per smallest length of the geometry

    Rows are the f functions and two that are given: outside the velocities 1 and z of the side, beneath 1 and ζ².
    """

    draft: float
    depth: float
    omega: float
    width: float
    gravity: float = 9.80665
    terms: int = 20
    modes: int = 60

    def __post_init__(self):
        if not 0 < self.draft < self.depth < np.inf:
            raise ValueError(f"draft {self.draft} m, depth {self.depth} m: need 0 < draft < depth < inf")
        if not 0 < self.omega < np.inf:
            raise ValueError(f"omega {self.omega} rad/s: must be positive and finite")
        if self.terms < FEWEST:
            raise ValueError(f"terms {self.terms}: must be at least {FEWEST}")

    @property
    def height(self):
        """s, m"""
        return self.depth - self.draft

    @cached_property
    def k(self):
        """rad/m"""
        return wavenumber(self.omega, self.depth, self.gravity)

    @cached_property
    def wave_norm(self):
        """∫ Z₀² dz, m"""
        return wave_norm(self.k, self.depth)

    @cached_property
    def outer_wavenumbers(self):
        """kₙ, (n,) rad/m"""
        count = ceil(self.modes * self.depth / min(self.height, self.draft, self.width))
        return evanescent_wavenumbers(self.omega, self.depth, count, self.gravity)

    @cached_property
    def inner_wavenumbers(self):
        """l_q, q ≥ 1, (q,) rad/m"""
        count = ceil(2 * self.modes * max(1.0, self.height / self.width))
        return np.arange(1, count + 1) * np.pi / self.height

    @cached_property
    def _points(self):
        """τ and, with the functions, their weights (τ, f) of ∫ … dζ / s, for what does not oscillate"""
        tau, weight = gauss_points(4)
        return tau, legendre(tau, self.terms) * (3 * tau * weight)[:, None]

    def _integral(self, values):
        """∫ u values dζ, (f,)"""
        return self.height * values @ self._points[1]

    @cached_property
    def _zeta(self):
        return self.height * (1 - self._points[0] ** 3)

    @cached_property
    def mean(self):
        """∫ u dζ of every function, (f,) m"""
        return self._integral(np.ones_like(self._zeta))

    @cached_property
    def second_moment(self):
        """∫ ζ² u dζ of every function, (f,) m³"""
        return self._integral(self._zeta**2)

    @cached_property
    def _polynomials(self):
        """1 and ζ² as functions of the gap, (2, f): polynomials in τ of degree one and seven"""
        tau, weight = gauss_points(4)
        return np.array([tau, tau * self._zeta**2]) * weight @ legendre(tau, self.terms)

    @cached_property
    def mean_rows(self):
        """⟨·, 1⟩ of the functions and of 1 and ζ², (f + 2,)"""
        return np.concatenate([self.mean, self._polynomials @ self.mean])

    @cached_property
    def _continued(self):
        """1 and z of the side, continued into the gap as 1 and −d − s/2 + ζ²/2s, whose slope does not jump, (2, f)"""
        one, square = self._polynomials
        s = self.height
        return np.array([one, square / (2 * s) - (self.draft + s / 2) * one])

    @cached_property
    def wave_rows(self):
        """⟨·, Z₀⟩ of the functions and of the side velocities 1 and z, (f + 2,)"""
        k, s, h = self.k, self.height, self.depth
        functions = self._integral(cosh_ratio(self._zeta, k, h))
        whole = [np.tanh(k * h) / k, sinh_ratio(s, k, h) / (s * k**3) - 1 / k**2]
        return np.concatenate([functions, whole - self._continued @ functions])

    def outside(self, wave_ratio, ratios, curvature):
        """Potential outside tested with every row, (f + 2, f + 2) complex.

        wave_ratio, ratios : R₀ and Rₙ, m; curvature : c of Rₙ → −1/kₙ + c/kₙ², 1/m
        """
        k, s, h = self.outer_wavenumbers, self.height, self.depth
        own = s * moments(k * s, self.terms)
        whole = np.array([np.sin(k * h) / k, np.cos(k * h) / k**2 - np.sin(k * s) / (s * k**3)])
        rows, weight = np.vstack([own, whole]), ratios / (h / 2 * (1 + np.sin(2 * k * h) / (2 * k * h)))
        total = (rows * weight) @ rows.T
        total[: self.terms, : self.terms] -= self._rest(h, len(k), -curvature)
        change = np.eye(self.terms + 2)
        change[self.terms :, : self.terms] = -self._continued
        wave = wave_ratio / self.wave_norm * np.outer(self.wave_rows, self.wave_rows)
        return wave + change @ total @ change.T

    def beneath(self, mean_ratio, ratios, curvature):
        """Potential under the body tested with every row, (f + 2, f + 2).

        mean_ratio, ratios : T₀ (zero where a constant is free instead) and T_q, m
        curvature : c of T_q → 1/l_q + c/l_q², 1/m
        """
        l, s = self.inner_wavenumbers, self.height
        own = s * beyond(len(l), 1.0, self.terms)[0]
        total = (own * (2 / s * ratios)) @ own.T + self._rest(s, len(l), curvature)
        mean = mean_ratio / s * np.outer(self.mean_rows, self.mean_rows)
        change = np.vstack([np.eye(self.terms), self._polynomials])
        return mean + change @ total @ change.T

    def _rest(self, height, count, curvature):
        """(2/H) Σ (1/ν + c/ν²) ⟨·, cos νζ⟩⟨·, cos νζ⟩, ν = nπ/H with n above `count`, in closed form, (f, f) m²"""
        _, first, second = beyond(count, self.height / height, self.terms)
        return 2 * self.height**2 / np.pi * (first + curvature * height / np.pi * second)
