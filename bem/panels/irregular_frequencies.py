"""Lowest irregular frequency, above which a lid is needed.

The direct equation of the outer flow has a false resonance wherever a flow inside the hull, with φ = 0 on the hull,
resonates:

    K = min ∭ |∇φ|² dV / ∬ φ² dS    over flows that are zero on the hull, dS on the water surface inside.

Continued by zero, a flow inside the hull is also a flow inside a box around the hull, whose minimum can only be lower:

    K ≥ κ coth κd,    κ² = π² (1/L² + 1/B²),    equal for a box of length L, beam B, draft d.

For a hull that stands on the bed, where ∂φ/∂z = 0, κ tanh κd replaces κ coth κd.  Of all boxes with a side along an
edge of the convex hull of the plan, the box with the largest κ is used. A rotation of the hull does not change this
box.
"""

import numpy as np

from ..algebra.convex_hull import convex_hull

# fraction of the lower bound up to which a lid improves nothing.  250 panels on the box 100 × 50 × 10 m in 12, 20 and
# 100 m of water: coefficients 0.94, 0.81 and 0.80 % off with and without lid, forces 0.34, 0.47 and 0.54 %.  In 12 m
# the errors of forces double from 0.8 on, for bodies outside this fit not before 0.9 (tests/bench/fit_lid_share.py)
SHARE = 0.6


def lowest_irregular(length, beam, draft, bottom=True):
    """K = ω²/g, 1/m, below which no hull inside a box of these dimensions (m) has an irregular frequency

    bottom : whether the box has a bottom; False for walls that end on the bed
    """
    kappa = np.pi * np.hypot(1 / length, 1 / beam)
    return float(kappa * np.tanh(kappa * draft) ** (-1 if bottom else 1))


def lid_needed_from(mesh):
    """K = ω²/g, 1/m, below which a hull is solved without a lid; mesh : PanelMesh, with or without mirror planes"""
    if mesh.body is not None:
        return min(lid_needed_from(mesh.of_body(i)) for i in range(mesh.bodies))
    return SHARE * lowest_irregular(*rectangle_around(mesh), mesh.draft, mesh.foot is None)


def rectangle_around(mesh):
    """Sides, m, of the rectangle with the largest κ among the rectangles at any angle around the plan of the whole
    hull;
    shape (2,)"""
    copies = [mesh.points[:, :2] * image for image in mesh.reflections()]
    corners = convex_hull(np.concatenate(copies))
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    sides = np.stack([np.ptp(corners @ direction.T, axis=0) for direction in (along, across)], axis=1)
    return sides[np.argmax(np.hypot(*(1 / sides.T)))]


def extent(mesh):
    """Length along x and along y of the whole hull, m; shape (2,)"""
    xy = mesh.points[:, :2]
    low, high = xy.min(axis=0), xy.max(axis=0)
    mirrored = np.array([axis in mesh.symmetry for axis in "xy"])
    return np.where(mirrored, 2 * np.maximum(high, -low), high - low)
