"""Curves through tabulated points: cubic between them, slope continuous.

`smooth` does not overshoot: its slopes are those of Fritsch and Butland (1984), the weighted harmonic mean of the
neighbouring secants, 0 where these differ in sign.  `parabolic` takes the slope of the parabola through a point and its
neighbours; it may overshoot, but is linear in the values, so that a surface joined by it has no kinks where the order
of neighbouring values changes.
"""

from __future__ import annotations

import numpy as np


def smooth(x, y, flat=()):
    """Callable curve through x (n,) rising and y (n, …); `flat` are places in x where its slope is set to 0."""
    from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

    x, y = np.asarray(x, float), np.asarray(y, float)
    if len(x) == 1:
        return lambda at: np.broadcast_to(y[0], np.shape(at) + y.shape[1:])
    slope = PchipInterpolator(x, y).derivative()(x)
    slope[list(flat)] = 0.0
    return CubicHermiteSpline(x, y, slope)


def parabolic(x, y, flat=()):
    """As `smooth`, for at least two points."""
    from scipy.interpolate import CubicHermiteSpline

    x, y = np.asarray(x, float), np.asarray(y, float)
    slope = np.gradient(y, x, axis=0)
    slope[list(flat)] = 0.0
    return CubicHermiteSpline(x, y, slope)
