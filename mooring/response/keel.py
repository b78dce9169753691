"""Corners of the bottom of a hull, under which the water is least."""

from __future__ import annotations

import numpy as np

FLAT = 0.05  # of the draft: what is deeper than the rest of the hull by less belongs to the bottom
MOST = 12


def corners_of_bottom(points):
    """(n, 3) m from points (p, 3) of a hull: corners of the convex hull of its deepest part in plan, at most 12.

    The vertical displacement of a rigid body is linear in x and y, so that it is largest at one of them.
    """
    points = np.asarray(points, float)
    draft = -points[:, 2].min()
    bottom = points[points[:, 2] <= -(1 - FLAT) * draft]
    corners = _turning_left(np.unique(np.round(bottom, 6), axis=0))
    if len(corners) > MOST:  # round in plan
        corners = corners[np.unique(np.linspace(0, len(corners), MOST, endpoint=False).astype(int))]
    return corners


def _turning_left(points):
    """Corners of the convex hull in plan (Andrew's monotone chain), the deepest point at each place"""
    order = np.lexsort((points[:, 2], points[:, 1], points[:, 0]))
    points = points[order]
    points = points[np.concatenate([[True], np.any(np.diff(points[:, :2], axis=0) != 0, axis=1)])]
    if len(points) < 3:
        return points
    chains = [_chain(points), _chain(points[::-1])]
    return np.concatenate([chain[:-1] for chain in chains])


def _chain(points):
    chain = []
    for point in points:
        while len(chain) > 1:
            a, b = chain[-1][:2] - chain[-2][:2], point[:2] - chain[-2][:2]
            if a[0] * b[1] - a[1] * b[0] > 1e-6:
                break
            chain.pop()
        chain.append(point)
    return np.array(chain)
