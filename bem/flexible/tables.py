"""Interpolation, to the whole hull, of a shape that is given at points, for example by a finite-element program.

    u(x) = Σ c_k |x − x_k|³ + a + Bx        (polyharmonic spline; it reproduces rigid motions to rounding)

Points in a plane or on a line do not determine the shape normal to it; the shape is assumed constant in that direction.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

FLAT = 1e-6  # extent, relative to the largest, below which points lie in a plane or on a line
MOST = 1500  # points in one system of equations; with more points each place uses the nearest ones
NEAREST = 60
FEWEST = 5


@dataclass(frozen=True, eq=False)
class Table:
    """points : points of the body, m, (n, 3); displacements : displacements of the points per unit amplitude, m, (n, 3)
    masses : masses at the points, kg, (n,), or None"""

    points: np.ndarray
    displacements: np.ndarray
    masses: np.ndarray | None = None

    turns = False

    def displacement(self, points):
        """Displacement at points (…, 3), m; shape (…, 3)"""
        points = np.asarray(points, float)
        return self._spline(self._own(points.reshape(-1, 3))).reshape(points.shape)

    def error(self, points):
        """Difference from a spline of |x − x_k| at points (n, 3) m of a hull, as a share of the largest displacement

        For shapes of a beam this is three to ten times the true error. It does not contain the error that arises if
        all points lie in one plane.
        """
        rough = _spline(self._own(self.points), self.displacements, "linear")(self._own(points))
        gap = np.linalg.norm(rough - self.displacement(points), axis=1).max()
        return float(gap / np.linalg.norm(self.displacements, axis=1).max())

    @property
    def dimensions(self):
        """Number of directions in which the points extend: 3, or 2 in a plane, or 1 on a line"""
        return self._axes.shape[1]

    @cached_property
    def _axes(self):
        """Directions in which the points extend; shape (3, d)"""
        _, sizes, axes = np.linalg.svd(self.points - self.points.mean(axis=0), full_matrices=False)
        return axes[sizes > FLAT * sizes[0]].T

    def _own(self, points):
        return (points - self.points.mean(axis=0)) @ self._axes

    @cached_property
    def _spline(self):
        return _spline(self._own(self.points), self.displacements)


def _spline(points, values, kernel="cubic"):
    from scipy.interpolate import RBFInterpolator

    near = NEAREST if len(points) > MOST else None
    return RBFInterpolator(points, values, neighbors=near, kernel=kernel, degree=1)
