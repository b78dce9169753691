"""Seams: places where panels lie side by side without common corners. Water cannot pass, although every edge is free.

Free edges, directed as in their panels, form rings.  Each ring encloses an open area,

    a = ½ Σ x × Δx        with a straight line that closes a ring which ends at the surface

whose mean width is 2|a| over the length of the ring.  At a missing panel the width is half an edge, at edges that
coincide it is zero, and between chords of unequal length on a curved side it is the difference of their sagittas.
Two rims that lie along each other without a common corner, such as polygons of 12 and 16 sides, are one seam. The
area of this seam is the sum of the areas of the two rings.
"""

from collections import defaultdict
from typing import NamedTuple

import numpy as np

SAME = 1e-6  # ends of edges closer than this share of the mesh size are one point
NEAR = 0.5  # largest distance of two rims that close each other, over the longer mean edge
SLIT = 0.1  # mean width of a ring over the mean edge, below which it is a seam; a missing square has 0.5


class Rings(NamedTuple):
    """number : index of the ring of each free edge, (f,); seam : whether each ring is a closed seam, (r,)
    joint : common number of two rings that close each other, (r,); length : length of each ring, m, (r,)
    area : open area of each ring, m², (r,); widest : greatest width of the seams, m
    Lengths and areas exclude images.
    """

    number: np.ndarray
    seam: np.ndarray
    joint: np.ndarray
    length: np.ndarray
    area: np.ndarray
    widest: float


class _Ring(NamedTuple):
    """own : its edges in the mesh, without images; share : their share; corners : (n, 3); area : (3,) m²"""

    own: list
    share: float
    corners: np.ndarray
    area: np.ndarray
    length: float

    @property
    def edge(self):
        """m, mean"""
        return self.length / len(self.corners)


def rings(points, start, end, symmetry=""):
    """`Rings` that directed free edges from point `start` (f,) to point `end` (f,) form

    symmetry : mirror planes, "", "x", "y" or "xy", whose images close rings that end on them
    """
    if not len(start):
        return Rings(np.zeros(0, int), np.zeros(0, bool), np.zeros(0, int), np.zeros(0), np.zeros(0), 0.0)
    x, a, b = _whole(points, start, end, symmetry)
    found = [_ring(x, a, b, ring, len(start)) for ring in _divided(x, a, b)]
    width = np.array([2 * np.linalg.norm(ring.area) / ring.length for ring in found])
    seam = width <= SLIT * np.array([ring.edge for ring in found])
    joint = np.arange(len(found))
    for one, other in _pairs(found, np.flatnonzero(~seam)):
        pair, p, q = [one, other], found[one], found[other]
        width[pair] = 2 * np.linalg.norm(p.area + q.area) / (p.length + q.length)
        seam[pair], joint[pair] = width[one] <= SLIT * max(p.edge, q.edge), one
    here = [i for i, ring in enumerate(found) if ring.own]
    number = np.zeros(len(start), int)
    for place, i in enumerate(here):
        number[found[i].own] = place
    length = np.array([found[i].length * found[i].share for i in here])
    return Rings(
        number, seam[here], joint[here], length, 0.5 * width[here] * length, float(width[seam].max(initial=0.0))
    )


def _ring(x, a, b, edges, count):
    own = [edge for edge in edges if edge < count]
    ends = b[edges[-1:]] if a[edges[0]] != b[edges[-1]] else a[:0]
    corners = np.concatenate([x[a[edges]], x[ends]])
    middle = corners.mean(axis=0)
    area = 0.5 * np.cross(corners - middle, np.roll(corners, -1, axis=0) - middle).sum(axis=0)
    length = float(np.linalg.norm(x[b[edges]] - x[a[edges]], axis=1).sum())
    return _Ring(own, len(own) / len(edges), corners, area, length)


def _pairs(found, open_):
    """Find pairs (one, other) of open rings along each other without a common corner: rims of unequal panels"""
    for k, one in enumerate(open_):
        for other in open_[k + 1 :]:
            p, q = found[one], found[other]
            if p.area @ q.area < 0 and _apart(p.corners, q.corners) <= NEAR * max(p.edge, q.edge):
                yield one, other


def _apart(corners, others):
    """m, largest distance of corners (n, 3) from the sides of a polygon (m, 3)"""
    start = others[None]
    side = np.roll(others, -1, axis=0)[None] - start
    from_start = corners[:, None] - start
    along = np.clip(np.sum(from_start * side, -1) / np.sum(side * side, -1), 0, 1)
    return float(np.linalg.norm(from_start - along[..., None] * side, axis=-1).min(axis=1).max())


def _whole(points, start, end, symmetry):
    """Points (p, 3), starts and ends of the edges and of their images, which run in the opposite direction"""
    ends = np.stack([points[start], points[end]])  # (2, f, 3)
    for axis in symmetry:
        image = ends[::-1].copy()
        image[..., "xy".index(axis)] *= -1
        ends = np.concatenate([ends, image], axis=1)
    cells = np.rint(ends.reshape(-1, 3) / (SAME * np.ptp(points, axis=0).max()))
    _, first, places = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    return ends.reshape(-1, 3)[first], *places.reshape(2, -1)


def _divided(x, a, b):
    """Lists of edges: each a ring that meets no point twice, or a border between two free ends

    Where edges meet, the edge of the sharpest turn back is followed: along a seam this gives the smallest rings.
    """
    leaving = defaultdict(list)
    for edge, point in enumerate(a.tolist()):
        leaving[point].append(edge)
    balance = np.bincount(b, minlength=len(x)) - np.bincount(a, minlength=len(x))
    along = (x[b] - x[a]) / np.linalg.norm(x[b] - x[a], axis=1)[:, None]
    for point in [*np.flatnonzero(balance < 0).tolist(), *list(leaving)]:
        while leaving[point]:
            yield from _walk(point, leaving, along, b)


def _walk(point, leaving, along, b):
    path, passed = [], [point]
    while leaving[point]:
        ways = leaving[point]
        back = min(ways, key=lambda edge: along[edge] @ along[path[-1]]) if path else ways[0]
        ways.remove(back)
        path.append(back)
        point = int(b[back])
        if point in passed:
            place = passed.index(point)
            yield path[place:]
            del path[place:], passed[place + 1 :]
        else:
            passed.append(point)
    if path:
        yield path
