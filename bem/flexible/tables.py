"""A shape known at points, as a finite-element program gives it, everywhere on the hull.

    u(x) = Σ c_k |x − x_k|³ + a + Bx        (polyharmonic spline, which rigid motions are reproduced by to rounding)

Points that lie in a plane, or on a line, say nothing across it: there the shape is taken as constant.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

FLAT = 1e-6  # of the extent of the points: they lie in a plane or on a line
MOST = 1500  # points of one system of equations; of more each place takes the nearest of them
NEAREST = 60
FEWEST = 5


@dataclass(frozen=True, eq=False)
class Table:
    """points : (n, 3) m, of the body; displacements : (n, 3) m per unit of the shape; masses : (n,) kg, or None"""

    points: np.ndarray
    displacements: np.ndarray
    masses: np.ndarray | None = None

    turns = False

    def displacement(self, points):
        """(…, 3) at points (…, 3) m"""
        points = np.asarray(points, float)
        return self._spline(self._own(points.reshape(-1, 3))).reshape(points.shape)

    @cached_property
    def error(self):
        """Of the largest displacement: what the points miss by that are foretold from every second one, an upper bound
        of what all of them are off between each other"""
        order = np.lexsort(np.round(self.points / max(np.ptp(self.points, axis=0).max(), 1e-300), 6).T)
        half, left = order[::2], order[1::2]
        if len(half) < FEWEST:
            return np.inf
        few = _spline(self._own(self.points)[half], self.displacements[half])
        gap = few(self._own(self.points)[left]) - self.displacements[left]
        return float(np.linalg.norm(gap, axis=1).max() / np.linalg.norm(self.displacements, axis=1).max())

    @cached_property
    def spacing(self):
        """m, the largest distance of a point from the nearest other one"""
        from scipy.spatial import KDTree

        return float(KDTree(self.points).query(self.points, k=2)[0][:, 1].max())

    def beyond(self, points):
        """m, the largest distance of points (n, 3) of a hull from the nearest one of the table"""
        from scipy.spatial import KDTree

        return float(KDTree(self._own(self.points)).query(self._own(points))[0].max())

    @cached_property
    def _axes(self):
        """(3, d) directions that the points extend in"""
        _, sizes, axes = np.linalg.svd(self.points - self.points.mean(axis=0), full_matrices=False)
        return axes[sizes > FLAT * sizes[0]].T

    def _own(self, points):
        return (points - self.points.mean(axis=0)) @ self._axes

    @cached_property
    def _spline(self):
        return _spline(self._own(self.points), self.displacements)


def _spline(points, values):
    from scipy.interpolate import RBFInterpolator

    near = NEAREST if len(points) > MOST else None
    return RBFInterpolator(points, values, neighbors=near, kernel="cubic", degree=1)
