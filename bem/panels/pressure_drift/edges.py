"""Sharp edges of a hull, and the panels in line with one another: across mirror planes, to an edge and beyond it.

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
    """Up to three panels in line with each of n, in one of its two directions: φ is drawn through their nodes.

    At an edge and on the panel behind they are counted from the edge, elsewhere they are the panel and its
    neighbours.  Distances grow from the beginning of the first.  A line goes on through a mirror plane.
    """

    near: np.ndarray  # (n,) whether the line begins at an edge
    own: np.ndarray  # (n,) which of the three is the panel itself
    end: np.ndarray  # (n,) −1 or 1, the end of the panel from which distances grow
    mu: np.ndarray  # (n,) exponent of the flow, 1 without an edge
    panels: np.ndarray  # (n, 3); where there are fewer any
    images: np.ndarray  # (n, 3) of `mesh.reflections()` on which they lie, seen from the panel
    forward: np.ndarray  # (n, 3) whether distances grow with s or t
    lengths: np.ndarray  # (n, 3) m; at an edge the last there is stands for those that are missing
    across: np.ndarray  # (n, 3) m, of the panels on the other face of the edge
    gap: np.ndarray  # (n,) m of water under that face where it is a flat bottom and this one a side, else infinite
    count: np.ndarray  # (n,) how many φ is drawn through

    @property
    def first(self):
        """(n,) the panel at the edge, the panel itself without one"""
        return np.where(self.near, self.panels[:, 0], np.arange(len(self.near)))

    def but(self, where, others):
        """The same with those of others where (n,) says so"""
        return Strips(
            *(np.where(where.reshape(-1, *[1] * (a.ndim - 1)), b, a) for a, b in zip(self, others, strict=True))
        )

    def alike(self, panel):
        """(n,) whether the lines of other panels (n,) have the same places, except for the panels themselves"""
        parts = self._replace(panels=self.near, lengths=self.near, across=self.near, gap=self.near)
        return np.all([np.all((a == a[panel]).reshape(len(panel), -1), axis=1) for a in parts], axis=0)


def strips(mesh, exponents, depth=np.inf):
    """`Strips` along s and t; exponents : (n, 4) as of `sharp_sides`; depth : m

    Panels that are not alike in the one direction do not make a strip in the other.
    """
    ways = _Ways(_beside(mesh), _planes(mesh))
    (s, single_s), (t, single_t) = (_in_direction(mesh, exponents, ways, *sides) for sides in SIDES)
    s, t = (_with_other_face(mesh, strip, sides, (s, t), depth) for strip, sides in zip((s, t), SIDES, strict=True))
    return s.but(~_alike(s, t), single_s), t.but(~_alike(t, s), single_t)


def coarsest_at_gap(mesh, depth):
    """(m, m) length of the panels next to a keel, of those that are longest beside the gap under it, and that gap

    Without keels over a bed 0 and infinite.
    """
    length, gap = 0.0, np.inf
    for strip in strips(mesh, sharp_sides(mesh), depth):
        for size, under in zip(np.maximum(strip.lengths, strip.across)[:, 0], strip.gap, strict=True):
            if size / under > length / gap:
                length, gap = size, under
    return length, gap


class _Ways(NamedTuple):
    """beside : (n, 4) panel that continues a panel beyond each side, numbered alike and not round an edge, or −1

    plane : (n, 4) image on which the panel itself goes on beyond the side, 0 where no mirror plane is
    """

    beside: np.ndarray
    plane: np.ndarray

    def beyond(self, panel, image, side):
        """What lies beyond a side of panels of images: panel (−1 for nothing), image, and the side to leave by"""
        after, plane = self.beside[panel, side], self.plane[panel, side]
        mirrored = (after < 0) & (plane > 0)
        return np.where(mirrored, panel, after), image ^ np.where(mirrored, plane, 0), (side + 2 * mirrored) % 4


def _in_direction(mesh, exponents, ways, minus, plus):
    """`Strips`, and those of every panel for itself"""
    one, two = exponents[:, minus], exponents[:, plus]
    own, zero, open_ = np.arange(len(mesh)), np.zeros(len(mesh), int), np.full(len(mesh), np.inf)
    sharp, free = (one < 1) ^ (two < 1), (one == 1) & (two == 1)  # between two edges straight lines are all there is
    end, mu = np.where(sharp & (two < 1), 1, -1), np.where(sharp, np.minimum(one, two), 1.0)
    middles = mesh.flat_vertices + np.roll(mesh.flat_vertices, -1, axis=1)
    size = np.linalg.norm(middles[:, plus] - middles[:, minus], axis=1) / 2

    def line(parts, count, place):
        panels, images, sides = (np.stack(part, axis=1) for part in zip(*parts, strict=True))
        lengths = size[panels]
        return Strips(sharp, place, end, mu, panels, images, sides == plus, lengths, lengths, open_, count)

    here = own, zero, np.where(end < 0, plus, minus)
    single = line([here] * 3, zero + 1, zero)
    first, second = _from_edges(line, ways, here, sharp, free)
    out = single.but(free, _between(line, ways, own, minus, plus)).but(sharp, first)
    has = np.flatnonzero(second.count > 1)
    for part, values in zip(out, second, strict=True):
        part[second.panels[has, 1]] = values[has]
    return out, single


def _from_edges(line, ways, here, sharp, free):
    """`Strips` of the panels at the edges, and what those behind them have instead, in the same places"""
    parts, known, count = [here], sharp, np.ones(len(sharp), int)
    for _ in range(2):
        after = ways.beyond(*parts[-1])
        known = known & (after[0] >= 0) & free[after[0]]
        parts.append(_where(known, after, here))
        count = count + known
    out, last = line(parts, count, 0 * count), np.minimum(np.arange(3), count[:, None] - 1)
    out = out._replace(lengths=np.take_along_axis(out.lengths, last, axis=1))
    return out._replace(count=np.minimum(count, 2)), out._replace(own=0 * count + 1)


def _between(line, ways, own, minus, plus):
    """`Strips` of panels without an edge and their neighbours"""
    zero = 0 * own
    panel, image, side = ways.beyond(own, zero, zero + minus)
    here, before = (own, zero, zero + plus), (panel, image, (side + 2) % 4)
    after = ways.beyond(*here)
    behind, ahead = panel >= 0, after[0] >= 0
    after = _where(ahead, after, here)
    parts = _where(behind, before, here), _where(behind, here, after), _where(behind, after, here)
    return line(parts, 1 + behind + ahead, behind.astype(int))


def _where(condition, parts, others):
    return tuple(np.where(condition, a, b) for a, b in zip(parts, others, strict=True))


def _with_other_face(mesh, strip, sides, both, depth):
    """`Strips` with what is on the other face of the edge; where that is the mirror image it is alike"""
    other = np.arange(4 * len(mesh))
    one, two = _neighbours(mesh)
    other[one], other[two] = two, one
    panel, side = divmod(other[4 * strip.first + np.take(sides, (strip.end + 1) // 2)], 4)
    lengths = strip.lengths
    for facing, ends in zip(both, SIDES, strict=True):
        begins = facing.near & (facing.own == 0)
        here = strip.near & begins[panel] & (side == np.take(ends, (facing.end[panel] + 1) // 2))
        lengths = np.where(here[:, None], facing.lengths[panel], lengths)
    upright, flat = np.abs(mesh.normals[:, 2]) < 1e-6, mesh.normals[panel, 2] < -1 + 1e-6
    gap = depth + mesh.vertices[panel, :, 2].mean(axis=1)
    gap = np.where(strip.near & upright & flat & (gap > 0), gap, np.inf)
    return strip._replace(across=lengths, gap=gap)


def _alike(mine, across):
    """(n,) whether the panels of each strip have the same places across it, in strips that run side by side"""
    out = np.all([across.alike(panel) for panel in mine.panels.T], axis=0)
    beside = mine.panels[across.panels]
    return out & np.all(beside == across.panels[mine.panels].transpose(0, 2, 1), axis=(1, 2))


def _planes(mesh):
    """(n, 4) image on which a panel goes on beyond each side, 0 where that is not in a mirror plane or bends there"""
    v, out = mesh.vertices, np.zeros((len(mesh), 4), int)
    for image, (x, y) in enumerate(mesh.reflections()):
        if x * y < 0:
            axis = 0 if x < 0 else 1
            on = np.abs(v[..., axis]) < 1e-6 * mesh.sizes.max()
            smooth = np.abs(mesh.normals[:, axis]) < np.sin(SHARP / 2)
            out[on & np.roll(on, -1, axis=1) & smooth[:, None]] = image
    return out


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
