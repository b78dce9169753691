"""The convex hull of points in the plane.

scipy.spatial has this function too, but in every study its import would take 0.09 s of processor time.
"""

from itertools import groupby
from operator import itemgetter

import numpy as np

STRAIGHT = 1e-12  # twice the area of three points, over the size squared, below which they lie on one line


def convex_hull(points):
    """Corners, anticlockwise, of the convex hull of points (n, 2); shape (m, 2); points within a side are no corners.

    The monotone chain of Andrew (Information Processing Letters 9, 1979), in n log n.
    raises : ValueError if all points lie on one line
    """
    points = np.asarray(points, float)
    least = STRAIGHT * float(np.max(np.ptp(points, axis=0))) ** 2
    ordered = points[np.lexsort(points.T[::-1])].tolist()
    ends = []  # lowest and highest point of each x
    for _, column in groupby(ordered, key=itemgetter(0)):
        column = list(column)
        ends += [column[0], column[-1]] if len(column) > 1 else column
    corners = _chain(ends, least)[:-1] + _chain(ends[::-1], least)[:-1]
    if len(corners) < 3:
        raise ValueError(f"{len(points)} points on one line have no convex hull with an area")
    return np.array(corners)


def _chain(points, least):
    """Those of points in order along one axis that turn to the left, by more than `least` as twice an area"""
    chain = []
    for x, y in points:
        while len(chain) > 1:
            (x0, y0), (x1, y1) = chain[-2:]
            if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > least:
                break
            chain.pop()
        chain.append([x, y])
    return chain
