"""Short waves around a rectangle: reflection by its walls and diffraction by its corners (geometrical theory).

A wave of k rad/m meets flat walls and the corners of the plan, wedges of the exterior angle 3π/2.  It comes from θ₀,
measured at a corner from one of its walls; s is the distance from the corner along that wall.  On the wall

    φ = 2 exp(−iks cosθ₀) [θ₀ < π] + v(s),    v ~ cylindrical wave of the corner

From Sommerfeld's series of the whole field with ∫₀^∞ Jₙ(ks) ds = 1/k, in the sense of Abel and with u = (θ₀ − π/2)/3,

    k ∫₀^∞ φ ds = C(θ₀) = i / [√3 sin(π/3 + u) sin u]

and v(s) is that of Kouyoumjian and Pathak, Proc. IEEE 62 (1974), for rigid walls, right also where θ₀ = π.  It
travels along the wall to the next corner, where it is diffracted like a wave from θ₀ = 0, and so on.  A wall that moves
with unit velocity radiates (1 − φ/2)/ik, φ of the wave from 3π/2: exp(iky)/ik has the velocity of the wall and travels
along the other one, and its diffraction by a corner at rest is subtracted.

Neglected are that v is not a plane wave at the next corner, and the variation of ψ within 1/k of a corner: both are of
relative order 1/(k side) of the corners' contribution.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import spherical_jn, wofz

from .maps import CLASSES

OPEN = 1.5 * np.pi  # exterior angle of a corner
GRAZING = 1e-9  # rad; a wave along a wall is one that turns from it by as much
ROOT = np.sqrt(3)


class AsymptoticWaveMap(NamedTuple):
    """Waves outside a plan, in one symmetry class of n functions ψ.

    weak : (n, n) m, ∮ ψᵢ N ψⱼ ds as of `bem.contour.plan.maps.WaveMap`; tested : (n, b) √m, ∮ ψᵢ φ ds in front of a
        rigid wall
    """

    weak: np.ndarray
    projected: np.ndarray


def wall_integral(angle):
    """C(θ₀), the whole field"""
    u = (angle - np.pi / 2) / 3
    return 1j / (ROOT * np.sin(np.pi / 3 + u) * np.sin(u))


def edge_integral(angle):
    """C(θ₀) + 2i / cosθ₀ for θ₀ < π: without the wave and its reflection, in a form without their pole"""
    u = (angle - np.pi / 2) / 3
    return -1j * (1 + ROOT * np.tan(u / 2)) / (2 * ROOT * np.sin(np.pi / 3 - u) * np.sin(np.pi / 3 + u))


def edge_wave(angle, x):
    """v at ks = x"""
    near = 1 / np.tan((np.pi - angle) / 3) * _transition(np.sqrt(2 * x) * np.abs(np.cos(angle / 2)))
    return -2 * np.exp(1j * (x + np.pi / 4)) / (3 * np.sqrt(2 * np.pi * x)) * (near + 1 / np.tan((np.pi + angle) / 3))


def _transition(x):
    """−2ix exp(−ix²) ∫ₓ^∞ exp(it²) dt, 1 where x is large"""
    return np.sqrt(np.pi) * x * np.exp(-0.25j * np.pi) * wofz(np.exp(0.25j * np.pi) * x)


def asymptotic_map(rectangle, cls, degree, k, beta):
    """`AsymptoticWaveMap` of a `bem.contour.plan.rectangle.Rectangle` for waves of `k` rad/m and incident ones towards
    `beta` (b,)

    degree : (end, side) highest polynomials
    """
    return _Corner(rectangle, cls, degree, k).map(np.atleast_1d(np.asarray(beta, float)))


class _Corner:
    """The corner x, y > 0 in a symmetry class.  Index 0 is the end, 1 the side, whose images are the other walls."""

    def __init__(self, rectangle, cls, degree, k):
        self.cls, self.k, self.extents = cls, k, np.array([rectangle.beam, rectangle.length])
        self.parity = np.array([cls[1], cls[0]])  # along end and side
        self.orders = [np.arange(0 if p == 1 else 1, d + 1, 2) for p, d in zip(self.parity, degree, strict=True)]
        self.heights = [np.sqrt((2 * m + 1) / (2 * e)) for m, e in zip(self.orders, self.extents, strict=True)]
        x = k * self.extents
        # wave of unit amplitude along one wall (rows: on which it is received or sent, columns: on which it came)
        same, other = edge_wave(0.0, x) / 2, edge_wave(OPEN, x) / 2
        self.sent = np.array([[same[0], other[0]], [other[1], same[1]]])
        same, other = wall_integral(0.0) / 2, wall_integral(OPEN) / 2
        self.received = np.array([[same, other], [other, same]]) / k

    @property
    def values(self):
        """(n, 2) ψ at the corner"""
        out = np.zeros((sum(map(len, self.heights)), 2))
        out[: len(self.heights[0]), 0], out[len(self.heights[0]) :, 1] = self.heights
        return out

    @property
    def around(self):
        """(2, 2) ∫ φ ds of waves that are sent along the walls, arrive at the next corner, are sent on, and so on"""
        arriving = np.linalg.solve(np.eye(2) - self.parity[:, None] * self.sent, np.diag(self.parity))
        return self.received @ arriving

    @property
    def moving(self):
        """(2, 2) ∫ φ − 1/ik ds of walls with unit velocity, on this corner's walls"""
        own, across = -2 / (3 * ROOT), 2 / ROOT - 1
        sent = -self.sent[:, ::-1] / (1j * self.k)
        return np.array([[own, across], [across, own]]) / self.k**2 + self.around @ sent

    def map(self, beta):
        edges, waves = np.zeros((2, 2, len(beta)), complex)
        flat = np.zeros((len(self.values), len(beta)), complex)
        for ix, iy in CLASSES:
            share = (self.cls[0] if ix < 0 else 1) * (self.cls[1] if iy < 0 else 1) / 4
            direction = np.array([ix * np.cos(beta), iy * np.sin(beta)])
            for total, part in zip((flat, edges, waves), self._incident(direction), strict=True):
                total += share * part
        n = len(self.values)
        weak = np.eye(n) / (1j * self.k) + 4 * self.values @ self.moving @ self.values.T
        return AsymptoticWaveMap(weak, flat + 4 * self.values @ (edges + self.around @ waves))

    def _incident(self, direction):
        """Of waves towards `direction` (2, b): ∮ψφ of the waves on walls that they reach, ∫v ds and v that is sent"""
        c, s = direction = np.where(np.abs(direction) < GRAZING, GRAZING, direction)
        from_end = (np.arctan2(-s, -c) + np.pi / 2) % (2 * np.pi)
        phase = np.exp(0.5j * self.k * (self.extents[1] * c + self.extents[0] * s)) * (from_end <= OPEN)
        flat, edges, waves = [], [], []
        for wall, angle in enumerate((from_end, OPEN - from_end)):
            angle, lit = np.clip(angle, 0, OPEN), direction[wall] < 0
            whole, edge = wall_integral(np.maximum(angle, np.pi)), edge_integral(np.minimum(angle, np.pi))
            edges.append(phase * np.where(lit, edge, whole) / self.k)
            waves.append(phase * edge_wave(angle, self.k * self.extents[wall]))
            flat.append(np.where(lit, self._plane(wall, direction), 0))
        return np.concatenate(flat), np.array(edges), np.array(waves)

    def _plane(self, wall, direction):
        """∮ψφ of the incident wave and its reflection on both images of a wall: ∫ Pₘ(t) exp(ixt) dt = 2iᵐ jₘ(x)"""
        m, extent = self.orders[wall][:, None], self.extents[wall]
        x = self.k * direction[1 - wall] * extent / 2
        along = extent * 1j**m * np.sign(x) ** m * spherical_jn(m, np.abs(x))
        across = np.exp(0.5j * self.k * self.extents[1 - wall] * direction[wall])
        return 4 * self.heights[wall][:, None] * along * across
