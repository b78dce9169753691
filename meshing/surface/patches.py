"""Panels on the water surface outside a hull: in a gap between bodies, in a moonpool."""

import numpy as np

from ..lid import AT_SURFACE, panelled, rings_of
from ..panels import PanelMesh, joined

SAME = 1e-6  # corners closer than this share of the polygon size are one


def moonpools(mesh):
    """Corners, m, counter-clockwise, of each closed water area inside the waterline of a hull; list of (k, 2)"""
    return [ring[::-1, :2] for ring, area in rings_of(mesh.whole()) if area < 0]


def patch(corners, size, symmetry=""):
    """Panels inside a convex polygon, normals up; with mirror planes "x", "y" only the part in x > 0, y > 0 has panels.

    corners : corners of the polygon, counter-clockwise, m, (k, 2); size : edge length of the panels, m
    returns : PanelMesh in z = 0; None if no part of the polygon has panels
    """
    part = _clipped(np.asarray(corners, float), symmetry)
    if part is None:
        return None
    return panelled(np.column_stack([part, np.zeros(len(part))]), size, symmetry)


def patches(polygons, size, symmetry=""):
    """The `patch` of each of several polygons in one mesh, and the number of panels of each polygon, (k,)"""
    made = [patch(corners, size, symmetry) for corners in polygons]
    counts = np.array([0 if one is None else len(one) for one in made])
    whole = joined([one for one in made if one is not None])
    return PanelMesh(whole.points, whole.corners, symmetry, "damping lids"), counts


def counter_clockwise(corners):
    """The corners (k, 2) in counter-clockwise order.  Raises ValueError if the polygon is not convex or has no area."""
    corners = np.asarray(corners, float)
    ahead = np.roll(corners, -1, axis=0) - corners
    turn = ahead[:, 0] * np.roll(ahead, -1, axis=0)[:, 1] - ahead[:, 1] * np.roll(ahead, -1, axis=0)[:, 0]
    least = SAME * np.ptp(corners, axis=0).max() ** 2
    if len(corners) < 3 or not (np.all(turn > -least) or np.all(turn < least)) or np.abs(turn).max() <= least:
        raise ValueError(
            "is not a convex polygon; allowed: three or more corners in order round it; divide a bent gap into "
            "several convex parts"
        )
    return corners if turn.sum() > 0 else corners[::-1]


def mirrored_in(polygons, symmetry):
    """The mirror planes of `symmetry` that map every polygon to itself or to another polygon"""
    return "".join(axis for axis in symmetry if all(_found(_image(p, axis), polygons) for p in polygons))


def covered(points, mesh):
    """Whether each of the points (n, 2), m, lies in the waterplane of a hull; shape (n,)"""
    return sum(np.sign(area) * _inside(points, ring[:, :2]) for ring, area in rings_of(mesh.whole())) > 0


def _clipped(corners, symmetry):
    for axis in symmetry:
        i = "xy".index(axis)
        kept = []
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            if a[i] >= 0:
                kept.append(a)
            if a[i] * b[i] < 0:
                kept.append(a + a[i] / (a[i] - b[i]) * (b - a))
        corners = np.array(kept)
        if len(corners) < 3 or np.ptp(corners[:, i]) <= AT_SURFACE:
            return None
    return corners


def _image(corners, axis):
    out = corners.copy()
    out[:, "xy".index(axis)] *= -1
    return out


def _found(corners, polygons):
    reach = SAME * np.ptp(corners, axis=0).max()
    alike = (p for p in polygons if len(p) == len(corners))
    return any(np.abs(corners[:, None] - p).max(axis=2).min(axis=1).max() <= reach for p in alike)


def _inside(points, ring):
    """Whether points lie inside: the number of crossings to the right is odd"""
    a, b = ring, np.roll(ring, -1, axis=0)
    x, y = points[:, :1], points[:, 1:]
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return np.count_nonzero(crosses & (at > x), axis=1) % 2
