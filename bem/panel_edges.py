"""Sharp edges of a hull, and which panels lie behind one another next to them.

Where the hull turns by α, water of the angle π + α flows round an edge, and at a distance r from it the potential is
a series of powers of r^μ, μ = π / (π + α): 2/3 at the edges of a box.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

SHARP = np.pi / 3  # rad that the hull has to turn by: less is how panels draw a round hull
SIDES = (3, 1), (0, 2)  # of a panel, where s is −1 and 1, where t is


def sharp_sides(mesh):
    """(n, 4) exponent μ of the flow at the side from corner i to i + 1 of every panel, 1 where it is not sharp"""
    hull = mesh.whole()
    out, (one, other) = np.ones(4 * len(hull)), _neighbours(hull)
    a, b = one // 4, other // 4
    turn = np.arccos(np.clip(np.sum(hull.normals[a] * hull.normals[b], axis=1), -1, 1))
    convex = np.sum((hull.centroids[b] - hull.centroids[a]) * hull.normals[a], axis=1) < 0
    out[one] = out[other] = np.where(convex & (turn > SHARP), np.pi / (np.pi + turn), 1.0)
    return out.reshape(-1, 4)[: len(mesh)]


class Strips(NamedTuple):
    """Where n panels lie across an edge, in one of their two directions.

    Behind a panel with an edge at one end lie others; those without edges of their own make a strip with it.
    """

    place: np.ndarray  # (n,) 0 next to the edge, 1 behind, −1 farther away or without an edge
    end: np.ndarray  # (n,) −1 or 1, the end towards the edge; −1 without
    mu: np.ndarray  # (n,) exponent of the flow, 1 without an edge
    chain: np.ndarray  # (n, 3) panels of the strip from the edge; the panel itself three times without an edge
    count: np.ndarray  # (n,) of panels in the strip that are known, up to three
    lengths: np.ndarray  # (n, 3) of the chain, m

    def alone(self, where):
        """The same without the panels behind those that are marked (n,)"""
        own = np.arange(len(where))
        far = where & (self.place != 0)
        return Strips(
            np.where(far, -1, self.place), np.where(far, -1, self.end), np.where(far, 1.0, self.mu),
            np.where(where[:, None], own[:, None], self.chain), np.where(where, 1, self.count), self.lengths,
        )  # fmt: skip


def strips(mesh, exponents):
    """`Strips` along s and t; exponents : (n, 4) as of `sharp_sides`

    Panels that are not alike in the one direction do not make a strip in the other.
    """
    beside = _beside(mesh)
    s, t = (_in_direction(mesh, exponents, beside, *sides) for sides in SIDES)
    return s.alone(~_alike(s, t)), t.alone(~_alike(t, s))


def _in_direction(mesh, exponents, beside, minus, plus):
    one, two = exponents[:, minus], exponents[:, plus]
    own, free = np.arange(len(mesh)), (one == 1) & (two == 1)
    sharp = (one < 1) ^ (two < 1)  # between two edges straight lines are all that is left
    end, mu = np.where(sharp & (two < 1), 1, -1), np.where(sharp, np.minimum(one, two), 1.0)
    place, count, chain = np.where(sharp, 0, -1), np.ones(len(own), int), np.repeat(own[:, None], 3, axis=1)
    known = sharp
    for k in (1, 2):
        after = np.where(end < 0, beside[chain[:, k - 1], plus], beside[chain[:, k - 1], minus])
        known = known & (after >= 0) & free[after]
        chain[known, k:] = after[known, None]
        count[known] = k + 1
    first = np.flatnonzero(count > 1)
    second = chain[first, 1]
    place[second] = 1
    for part in (end, mu, chain, count):
        part[second] = part[first]
    middles = mesh.flat_vertices + np.roll(mesh.flat_vertices, -1, axis=1)
    size = np.linalg.norm(middles[:, plus] - middles[:, minus], axis=1) / 2
    return Strips(place, end, mu, chain, count, size[chain])


def _alike(mine, across):
    """(n,) whether the panels of each strip have the same places across it, in strips that run side by side"""
    out = np.ones(len(mine.place), bool)
    for panel in mine.chain.T:
        for part in (across.place, across.end, across.mu, across.count):
            out &= part == part[panel]
    beside = mine.chain[across.chain]
    return out & np.all(beside == across.chain[mine.chain].transpose(0, 2, 1), axis=(1, 2))


def _beside(mesh):
    """(n, 4) panel that continues a panel beyond each side, numbered alike and not round an edge; −1 where none"""
    one, other = _neighbours(mesh)
    smooth = np.sum(mesh.normals[one // 4] * mesh.normals[other // 4], axis=1) > np.cos(SHARP)
    alike = smooth & (one % 4 == (other + 2) % 4)
    out = np.full(4 * len(mesh), -1)
    for a, b in ((one, other), (other, one)):
        out[a[alike]] = b[alike] // 4
    return out.reshape(-1, 4)


def _neighbours(mesh):
    """Sides (4 · panel + side) that two panels share, two arrays"""
    v = mesh.vertices
    place = np.round(v.reshape(-1, 3) / (1e-6 * mesh.sizes.max())).astype(np.int64)
    number = np.unique(place, axis=0, return_inverse=True)[1].reshape(-1, 4)
    ends = np.sort(np.stack([number, np.roll(number, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    _, side, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    first = np.argsort(side.ravel(), kind="stable")[np.repeat(count, count) == 2]
    return first[::2], first[1::2]
