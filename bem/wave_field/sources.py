"""The waves a body scatters and radiates, anywhere around it, from its Kochin function.

    η(p) = Σ_j s_j H₀(k|p − p_j|),      H(θ) = Σ_j s_j exp(−ik(x_j cosθ + y_j sinθ))

H₀ Hankel's function of the first kind, sources on a convex curve inside the plan of the body.  The far field determines
the propagating wave everywhere outside; the sources are its least-squares fit, without combinations of sources whose
far field is below `SMALLEST`, which would magnify errors of H.  Beyond the circle about the body the fit is as accurate
as H; within it, beside a long body, detail finer than half a wave length is smoothed.  Local waves, which decay like
exp(−πr/h), are neglected.  Unit of H: m per m of wave amplitude or of motion (`bem.kochin`).
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from scipy.special import j0, j1, y0, y1

SMALLEST = 1e-3
INSET = 0.1  # inset of sources from the plan contour, over half its smaller breadth
PER_WAVE = 8  # sources in a wave length of the contour
FEWEST = 24
AT_ONCE = 2_000_000


class Sources:
    """Sources inside a convex plan (n, 2), m, corners anticlockwise, at wavenumber k, rad/m; theta : (t,) rad of H"""

    def __init__(self, plan, k, theta):
        self.plan, self.k = np.asarray(plan, float), float(k)
        inner = shrunk(self.plan)
        self.points = contour(inner, max(FEWEST, PER_WAVE * perimeter(inner) * k / 2 / np.pi))
        self.sent = np.exp(-1j * k * (directions(theta) @ self.points.T))

    @cached_property
    def of_far_field(self):
        """(s, t) strengths of H (t,)"""
        return regular_inverse(self.sent, SMALLEST)

    def strengths(self, H):
        """(…, s) of Kochin functions H (…, t), and the share of H that the sources do not reproduce"""
        found = H @ self.of_far_field.T
        size = np.linalg.norm(H)
        return found, float(np.linalg.norm(H - found @ self.sent.T) / size) if size > 0 else 0.0

    def elevation(self, strengths, places):
        """(…, p) at places (p, 2), m, of strengths (…, s)"""
        step = max(1, AT_ONCE // len(self.points))
        parts = [
            strengths @ waves(self.k, places[i : i + step], self.points).T for i in range(0, max(len(places), 1), step)
        ]
        return np.concatenate(parts, axis=-1)

    def covers(self, places):
        """(p,) whether places (p, 2) lie in the plan, where no wave is defined"""
        return covers(self.plan, places)


def waves(k, places, points):
    """H₀(k|p − p_j|), (p, s)"""
    r = k * np.hypot(*(places[:, None] - points).transpose(2, 0, 1))
    return j0(r) + 1j * y0(r)


def slopes(k, places, points):
    """∇H₀(k|p − p_j|) at p, (p, s, 2); of a source at p itself the regular part, 0"""
    away = places[:, None] - points
    r = np.hypot(*away.transpose(2, 0, 1))
    apart = np.where(r > 0, r, 1.0)
    return (-k * (j1(k * r) + 1j * np.where(r > 0, y1(k * apart), 0.0)) / apart)[..., None] * away


def covers(plan, places):
    """(p,) whether places (p, 2) lie within a convex plan (n, 2), corners anticlockwise"""
    side = np.roll(plan, -1, axis=0) - plan
    away = places[:, None] - plan
    return np.all(side[:, 0] * away[..., 1] > side[:, 1] * away[..., 0], axis=1)


def incident(k, beta, places):
    """exp(ik(x cosβ + y sinβ)) (b, p) of waves towards beta (b,) rad at places (p, 2)"""
    return np.exp(1j * k * (directions(beta) @ places.T))


def directions(angle):
    """(a, 2)"""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def rectangle(half):
    """(4, 2) corners of a rectangle about the origin of `half` length and breadth (2,)"""
    return np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * half


def shrunk(plan):
    """A plan (n, 2) with its edges moved inwards along x and y by INSET of half its smaller breadth"""
    low, high = plan.min(axis=0), plan.max(axis=0)
    half = (high - low) / 2
    return (low + high) / 2 + (plan - (low + high) / 2) * (1 - INSET * half.min() / half)


def perimeter(plan):
    """m, of a polygon (n, 2)"""
    return float(np.linalg.norm(np.roll(plan, -1, axis=0) - plan, axis=1).sum())


def contour(plan, count):
    """(n, 2) points on a polygon (n, 2), about `count`, two on each side at the least, evenly spaced"""
    side = np.roll(plan, -1, axis=0) - plan
    step = perimeter(plan) / count
    each = np.maximum(2, np.ceil(np.linalg.norm(side, axis=1) / step).astype(int))
    parts = [
        start + (np.arange(n)[:, None] + 0.5) / n * along for start, along, n in zip(plan, side, each, strict=True)
    ]
    return np.concatenate(parts)


def regular_inverse(matrix, smallest):
    """Pseudo-inverse (n, m) without singular values below `smallest` of the largest

    By eigenvalues of the smaller square, a fifth of the time of singular values; `smallest` of 1e-3 keeps 10 digits.
    """
    square, right = np.linalg.eigh(matrix.conj().T @ matrix)
    kept = square > smallest**2 * square[-1]
    return (right[:, kept] / square[kept]) @ (right[:, kept].conj().T @ matrix.conj().T)
