"""The sea bed under a line: a polyline in the vertical plane through anchor and fairlead."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

STEEPER = 1e-12  # excess of the slope over the friction that makes a line slide; less counts as rounding


@dataclass(frozen=True)
class Bed:
    """Straight facets between the vertices `points`, the first and the last one of infinite length; Coulomb friction.

    points : (k, 2) m, x from the anchor towards the fairlead, strictly ascending, and z; the anchor lies on the
        first point, and the points are shifted so that it is at (0, 0)
    friction : friction coefficient, ≥ 0
    """

    points: np.ndarray
    friction: float = 0.0

    def __post_init__(self):
        points = np.asarray(self.points, float)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2 or not np.all(np.isfinite(points)):
            raise ValueError(f"bed points have the shape {points.shape}; allowed: (k, 2) finite numbers, k at least 2")
        if not np.all(np.diff(points[:, 0]) > 0):
            step = np.diff(points[:, 0]).min()
            raise ValueError(
                f"x of the bed points changes by {step:g} m from one to the next; allowed: above 0, "
                f"without vertical walls or overhangs"
            )
        if not (np.isfinite(self.friction) and self.friction >= 0):
            raise ValueError(f"bed friction is {self.friction:g}; allowed: finite, at least 0")
        object.__setattr__(self, "points", points - points[0])

    @classmethod
    def sloping(cls, slope=0.0, friction=0.0):
        """A plane bed; slope in rad, positive for a bed that rises towards the fairlead."""
        if not abs(slope) < 1.5:
            raise ValueError(f"bed slope is {slope:g} rad; allowed: between −1.5 and 1.5")
        return cls(np.array([[0.0, 0.0], [1.0, np.tan(slope)]]), friction)

    @classmethod
    def under(cls, x, y, z, anchor, fairlead, friction=0.0):
        """The section of a gridded bed under a line, with a vertex wherever the line crosses a line of the grid.

            x : (n,) and y : (m,), ascending, m; z : (n, m) m, bilinear in between; anchor, fairlead : (x, y) m.
        The section ends at the edge of the grid beyond the fairlead. The grid must contain both ends of the line.
        """
        x, y, z = (np.asarray(v, float) for v in (x, y, z))
        if z.shape != (len(x), len(y)) or np.any(np.diff(x) <= 0) or np.any(np.diff(y) <= 0):
            raise ValueError(f"bed grid z has the shape {z.shape}; allowed: {(len(x), len(y))}, x and y rising")
        anchor, fairlead = np.asarray(anchor, float)[:2], np.asarray(fairlead, float)[:2]
        span = np.hypot(*(fairlead - anchor))
        if span == 0:
            raise ValueError(
                "the fairlead is vertically above the anchor, so the section of the bed has no "
                "direction; move one of them"
            )
        for name, point in (("anchor", anchor), ("fairlead", fairlead)):
            if not (x[0] <= point[0] <= x[-1] and y[0] <= point[1] <= y[-1]):
                raise ValueError(f"{name} at ({point[0]:g}, {point[1]:g}) m lies outside the bed grid; extend the grid")
        way = (fairlead - anchor) / span
        crossings = [np.array([0.0, span])]
        for axis, lines in enumerate((x, y)):
            if way[axis] != 0:
                crossings.append((lines - anchor[axis]) / way[axis])
        d = np.unique(np.concatenate(crossings))
        d = d[(d >= 0) & np.append(np.diff(d) > 1e-9 * span, True)]
        at = anchor + d[:, None] * way
        inside = np.all(
            (at >= [x[0] - 1e-9 * span, y[0] - 1e-9 * span]) & (at <= [x[-1] + 1e-9 * span, y[-1] + 1e-9 * span]),
            axis=1,
        )
        return cls(np.column_stack([d, _bilinear(x, y, z, at)])[inside], friction)

    def depth_below(self, x, z):
        """Height of points (x, z) above the bed, m; negative under the bed."""
        slope = self.slopes
        if len(slope) == 1:
            return z - slope[0] * x
        px, pz = self.points.T
        beyond = slope[0] * np.minimum(x, 0.0) + slope[-1] * np.maximum(x - px[-1], 0.0)
        return z - np.interp(x, px, pz) - beyond

    @cached_property
    def slopes(self):
        """Slopes of the facets of the bed; shape (k − 1,)"""
        return np.diff(self.points[:, 1]) / np.diff(self.points[:, 0])

    @property
    def slides_beyond(self):
        """Whether a line without tension slides down the first facet, away from its anchor"""
        return float(self.slopes[0]) < -(self.friction + STEEPER)

    @property
    def first_facet(self):
        """End of the first facet, m"""
        return np.inf if len(self.points) == 2 else float(self.points[1, 0])


def _bilinear(x, y, z, at):
    i = np.clip(np.searchsorted(x, at[:, 0]) - 1, 0, len(x) - 2)
    j = np.clip(np.searchsorted(y, at[:, 1]) - 1, 0, len(y) - 2)
    a, b = (at[:, 0] - x[i]) / (x[i + 1] - x[i]), (at[:, 1] - y[j]) / (y[j + 1] - y[j])
    return (1 - a) * ((1 - b) * z[i, j] + b * z[i, j + 1]) + a * ((1 - b) * z[i + 1, j] + b * z[i + 1, j + 1])
