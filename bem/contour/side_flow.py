"""Flow of the contour method over the depth of a side, down to the edge of the keel, and integrals of its squares.

    φ = Σ fₙ Zₙ(z)    and at a small distance r from the keel    φ = c + wr + (2b/3π) r² ln r + Σ cₚ r^(2p/3)

The sum over modes, with a smooth cut-off at N modes, converges fast for r ≫ 1/k_N. Nearer to the keel the expansion
in r replaces this sum: w, the vertical speed of the keel's edge, and b, the rate at which the side turns about the
edge, are known from the motion of the hull, and the powers are those of water at a fixed edge of 270°. c₁, c₂ and c₃
follow from ∂φ/∂z a little farther up. |∇φ|², singular like r^(−2/3), is integrated without error down to the edge.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import xlogy

from ..depth_modes.gap import Gap, OuterModes, smooth_cutoff
from ..waves import depth_factor, depth_factor_slope
from .plan.panels import gauss_rule

CUT = 60.0  # distance in units of 1/k_N, where the truncation error of a sum is 2e-5 of its singular part
START, END = 0.01, 4.0  # c₁, c₂, c₃ are fitted between START of draft or gap and END times that
# fraction of the draft: sums at the surface converge as those at this distance from the keel.  At a wall that moves
# through the surface they have terms K/kₙ³: with the modes that the keel needs, φ at Kh = 9 was 1.5 % off
SURFACE = 0.02
LATEST, MODES = 0.03, 20000  # START may be increased up to LATEST, so that this number of modes suffices
POWERS = np.array([2, 4, 6]) / 3


class DepthSums(NamedTuple):
    """Integrals over the depth of a side for amplitudes g (a,) of φ = Σ g φ_g(z): wave, nodes and rows of the table,
    w, b.

    slopes, values : quadratic forms of ∫ φ_s² dz and ∫ φ_z² dz, (a, a); top, keel : φ at z = 0 and z = −d, (a,)
    one, z : ∫ φ dz and ∫ z φ dz, (a,)
    """

    slopes: np.ndarray
    values: np.ndarray
    top: np.ndarray
    keel: np.ndarray
    one: np.ndarray
    z: np.ndarray


class DepthFlow(NamedTuple):
    """Flow at distances r (q,) m from the keel, with weights (q,) m of an integral over depth.

    value, slope : φ_g and ∂φ_g/∂z of `DepthSums`, (q, a); top, keel : φ_g at z = 0 and z = −d, (a,)
    """

    r: np.ndarray
    weights: np.ndarray
    value: np.ndarray
    slope: np.ndarray
    top: np.ndarray
    keel: np.ndarray


def depth_flow(freq, surface):
    """`DepthFlow` of a solved `ContourFrequency`; surface : length over which the flow changes near z = 0, m

    The points depend on the body and `surface`, not on the frequency.
    """
    modes = _DepthModes.of(freq)
    draft = modes.gap.draft
    start = CUT * modes.gap.depth / (np.pi * len(modes.outer.wavenumbers))
    end = END * start
    near, keel = _at_keel(modes, start, end)
    r, weights = _distances(end, draft, surface)
    parts = zip(near, (r, weights, *modes.flow(r)), strict=True)
    top = modes.flow(np.array([draft]))[0][0]
    return DepthFlow(*(np.concatenate(both) for both in parts), top, keel)


def depth_sums(freq):
    """`DepthSums` of a solved `ContourFrequency`"""
    r, weights, value, slope, top, keel = depth_flow(freq, 1 / freq.k)
    forms = (part.T @ (weights[:, None] * part) for part in (value, slope))
    return DepthSums(*forms, top, keel, weights @ value, (weights * (r - freq.body.draft)) @ value)


class _DepthModes(NamedTuple):
    """table : (n, c) from the nodes of the table to amplitudes of the n modes; rows : (n, r)"""

    gap: Gap
    outer: OuterModes
    table: np.ndarray
    rows: np.ndarray

    @classmethod
    def of(cls, freq):
        body, gap = freq.body, freq.body.profiles.gap
        most, least = (_count(gap, part * min(gap.draft, gap.height)) for part in (START, LATEST))
        outer = gap.outer_modes(freq.omega, min(most, max(least, MODES)), freq.gravity)
        k = outer.wavenumbers
        table = body.nodes(freq.top).weights(k) / (outer.norms * k)[:, None]
        return cls(gap, outer, table, (body.profiles.combinations @ outer.rows).T)

    def flow(self, r):
        """φ_g and ∂φ_g/∂z at distances r (q,), m, from the keel; shape (2, q, a). Each is a sum of as many modes as
        needed."""
        k, h, z = self.outer.k, self.gap.depth, r - self.gap.draft
        out = np.zeros((2, len(r), 3 + self.table.shape[1] * self.rows.shape[1]))
        out[:, :, 0] = depth_factor(z, k, h), depth_factor_slope(z, k, h)
        for q, distance in enumerate(r):
            beside = min(distance, max(-z[q], SURFACE * self.gap.draft))
            n = min(len(self.rows), _count(self.gap, beside))
            kn, cut = self.outer.wavenumbers[:n], smooth_cutoff(np.arange(1, n + 1) / n)
            turn = kn * (z[q] + h)
            for part, mode in zip(out, (np.cos(turn), -kn * np.sin(turn)), strict=True):
                part[q, 1:-2] = (self.table[:n].T @ ((cut * mode)[:, None] * self.rows[:n])).ravel()
        return out


def _count(gap, distance):
    """Number of modes with which sums have converged at a distance from the keel"""
    return int(np.ceil(CUT * gap.depth / (np.pi * distance)))


def _at_keel(modes, start, end):
    """r < `end`, weights (q,), φ_g and ∂φ_g/∂z (q, a); and φ_g (a,) at the edge"""
    a, b = np.array([start, end]) ** (2 / 3)
    angles = np.pi * (np.arange(len(POWERS)) + 0.5) / len(POWERS)
    found = ((a + b) / 2 + (b - a) / 2 * np.cos(angles)) ** 1.5  # Chebyshev's points in r^(2/3)
    value, slope = modes.flow(np.append(found, end))
    c = np.zeros((len(POWERS) + 2, value.shape[1]))
    c[-2:, -2:] = np.eye(2)
    known = _edge_functions(found)[1]
    c[:-2] = np.linalg.solve(known[:, :-2], slope[:-1] - known @ c)
    keel = value[-1] - (_edge_functions(np.array([end]))[0] @ c)[0]
    t, w = gauss_rule(10)  # points in t = (r / end)^(1/3); all terms except the logarithm are polynomials in t
    value, slope = (part @ c for part in _edge_functions(end * t**3))
    return (end * t**3, 3 * end * t**2 * w, keel + value, slope), keel


def _edge_functions(r):
    """r^(2/3), r^(4/3), r², r and (2/3π) r² ln r, and their derivatives, two (q, 5)"""
    r = r[:, None]
    turning = xlogy(r, r) * r, 2 * xlogy(r, r) + r
    value, slope = (np.full_like(r, 2 / (3 * np.pi)) * part for part in turning)
    return np.hstack([r**POWERS, r, value]), np.hstack([POWERS * r ** (POWERS - 1), np.ones_like(r), slope])


def _distances(start, draft, surface):
    """Points start < r < draft and their weights, m; panels double away from the keel and from `surface` at the top"""
    middle = draft / 2
    up = start * 2.0 ** np.arange(max(0, int(np.ceil(np.log2(middle / start)))))
    shortest = max(0, int(np.ceil(np.log2((draft - middle) / surface))))
    down = draft - (draft - middle) / 2.0 ** np.arange(shortest + 1)
    edges = np.concatenate([up, down, [draft]])
    t, w = gauss_rule(10)
    length = np.diff(edges)[:, None]
    return (edges[:-1, None] + length * t).ravel(), (length * w).ravel()
