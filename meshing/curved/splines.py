"""WAMIT's patches of B-splines (IGDEF = 1 of a GDF file; user manual, version 7.4, section 7.5), cut into flat panels.

    x(u, v) = Σᵢⱼ xᵢⱼ Uᵢ(u) Vⱼ(v),    u over NUG spans by splines of order KUG, v over NVG of order KVG

The file has for each patch NUG NVG, KUG KVG, NUG + 2 KUG − 1 and NVG + 2 KVG − 1 knots, then the (NUG + KUG − 1)(NVG
+ KVG − 1) points xᵢⱼ, with i changing fastest.  Each patch is cut evenly in u and v, so that its panels are nearly
square and of equal size.  WAMIT's normals u × v point into the body, normals of a PanelMesh into the water.
"""

import numpy as np

PANELS = 2000  # approximate number of panels for all patches of a file
TRIED = 8  # points along a side of a patch, used to measure its length


def panelled(numbers, patches):
    """Points (p, 3) and corners (n, 4) of the panels on several patches.  Raises ValueError.

    numbers : numbers of the patches in the file, one patch after another; patches : number of patches"""
    if patches < 1:
        raise ValueError(f"the file has {patches} patches; allowed: 1 or more")
    splines, at = [], 0
    for _ in range(patches):
        spline, at = _patch(numbers, at)
        splines.append(spline)
    sides = [_sides(_grid(spline, TRIED, TRIED)) for spline in splines]
    size = np.sqrt(sum(along * across for along, across in sides) / PANELS)
    if not size > 0:
        raise ValueError("its patches have no size")
    points, corners, first = [], [], 0
    for spline, (along, across) in zip(splines, sides, strict=True):
        m, n = (int(np.clip(np.ceil(length / size), 1, PANELS)) for length in (along, across))
        place = first + np.arange((m + 1) * (n + 1)).reshape(m + 1, n + 1)
        points.append(_grid(spline, m, n).reshape(-1, 3))
        around = place[:-1, :-1], place[:-1, 1:], place[1:, 1:], place[1:, :-1]
        corners.append(np.stack(around, axis=-1).reshape(-1, 4))
        first += place.size
    return np.concatenate(points), np.concatenate(corners)


def _patch(numbers, at):
    """Read the patch at index `at`: its knots and orders in u and v, its points (nu, nv, 3), and the index after it"""

    def taken(count):
        nonlocal at
        at += int(count)
        if at > len(numbers):
            raise ValueError("it ends within a patch")
        return numbers[at - int(count) : at]

    spans, orders = taken(2).astype(int), taken(2).astype(int)
    if min(*spans, *orders) < 1:
        raise ValueError(f"a patch has {spans.tolist()} spans and order {orders.tolist()}; allowed: 1 or more of each")
    knots = [taken(n + 2 * k - 1) for n, k in zip(spans, orders, strict=True)]
    counts = spans + orders - 1
    points = taken(3 * counts.prod()).reshape(counts[1], counts[0], 3).swapaxes(0, 1)
    return (knots, orders, points), at


def _grid(spline, m, n):
    """Points, evenly in u and v; shape (m + 1, n + 1, 3)"""
    from scipy.interpolate import BSpline

    knots, orders, points = spline
    for axis, count in enumerate((m, n)):
        low, high = knots[axis][orders[axis] - 1], knots[axis][-orders[axis]]
        at = np.linspace(low, high, count + 1)
        points = BSpline(knots[axis], points, orders[axis] - 1, axis=axis)(at)
    return points


def _sides(points):
    """m, the longest line along u and along v"""
    return [float(np.linalg.norm(np.diff(points, axis=axis), axis=-1).sum(axis=axis).max()) for axis in (0, 1)]
