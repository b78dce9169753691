"""A force over a deflection: piecewise cubics, integrated exactly.

    R(δ) = c₀ + c₁ t + c₂ t² + c₃ t³,    t = δ − knot,    E(δ) = ∫₀^δ R dδ

R is 0 below the first knot, which is at 0; beyond the last knot R continues along the straight line through its end.
 `smooth` uses the monotone cubics of Fritsch and Carlson (1980), which neither overshoot nor ripple: a peak of the
 table is a
peak of the curve.  `straight` uses straight lines; an integration in time has to step onto the corners between them.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Curve:
    """knots (n + 1,), ascending from 0; coefficients (n, 4) c₀ … c₃ of the module's equation, lowest order first"""

    knots: np.ndarray
    coefficients: np.ndarray

    @property
    def end(self):
        """Last knot"""
        return float(self.knots[-1])

    def _piece(self, x):
        x = np.asarray(x, float)
        piece = np.clip(np.searchsorted(self.knots, x, side="right") - 1, 0, len(self.coefficients) - 1)
        return piece, np.clip(x, 0.0, self.end) - self.knots[piece], np.maximum(x - self.end, 0.0)

    def __call__(self, x):
        """R at deflections of any shape"""
        piece, t, beyond = self._piece(x)
        a, b, c, d = np.moveaxis(self.coefficients[piece], -1, 0)
        value = a + t * (b + t * (c + t * d)) + beyond * (b + t * (2 * c + 3 * t * d))
        return np.where(np.asarray(x) < 0, 0.0, value)

    def slope(self, x):
        """dR/dδ at deflections of any shape; at a corner the right-hand value"""
        piece, t, _ = self._piece(x)
        _, b, c, d = np.moveaxis(self.coefficients[piece], -1, 0)
        return np.where(np.asarray(x) < 0, 0.0, b + t * (2 * c + 3 * t * d))

    def integral(self, x):
        """∫₀^δ R dδ at deflections of any shape"""
        h = np.diff(self.knots)[:, None]
        order = np.arange(1, 5)
        whole = np.sum(self.coefficients * h**order / order, axis=1)
        before = np.concatenate([[0.0], np.cumsum(whole)])
        piece, t, beyond = self._piece(x)
        a, b, c, d = np.moveaxis(self.coefficients[piece], -1, 0)
        inside = before[piece] + t * (a + t * (b / 2 + t * (c / 3 + t * d / 4)))
        return inside + beyond * self(self.end) + 0.5 * beyond**2 * self.slope(self.end)

    def scaled(self, along, up):
        """The curve with deflections times `along` and forces times `up`"""
        return Curve(self.knots * along, self.coefficients * up / along ** np.arange(4.0))

    def minus(self, other):
        """The difference of two curves on the same knots"""
        return Curve(self.knots, self.coefficients - other.coefficients)


def straight(x, y):
    """`Curve` of straight lines through points (n,), (n,), the first at 0, 0"""
    x, y = np.asarray(x, float), np.asarray(y, float)
    made = np.zeros((len(x) - 1, 4))
    made[:, 0], made[:, 1] = y[:-1], np.diff(y) / np.diff(x)
    return Curve(x, made)


def smooth(x, y):
    """`Curve` of monotone cubics through points (n,), (n,), the first at 0, 0; for two points a straight line"""
    if len(x) < 3:
        return straight(x, y)
    from scipy.interpolate import PchipInterpolator

    made = PchipInterpolator(np.asarray(x, float), np.asarray(y, float))
    return Curve(made.x, np.ascontiguousarray(made.c[::-1].T))
