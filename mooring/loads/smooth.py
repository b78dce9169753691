"""Curves through tabulated points: cubic between the points, slope continuous.

`smooth` does not overshoot: its slopes are those of Fritsch and Butland (1984): the weighted harmonic mean of the
neighbouring secants, or 0 where the secants differ in sign. `parabolic` uses the slope of the parabola through a
point and its neighbours. `parabolic` may overshoot but is linear in the values, so a surface of such curves has no
kinks where the order of neighbouring values changes.
"""

import numpy as np


def smooth(x, y, flat=()):
    """Callable curve through x (n,) rising and y (n, …); `flat` : places in x where the slope of the curve is set to
    0."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    if len(x) == 1:
        return lambda at: np.broadcast_to(y[0], np.shape(at) + y.shape[1:])
    return _through(x, y, _harmonic_slopes(x, y), flat)


def parabolic(x, y, flat=()):
    """Like `smooth`, for at least two points."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    return _through(x, y, np.gradient(y, x, axis=0), flat)


def _through(x, y, slope, flat):
    """Cubic Hermite interpolation; the end pieces continue beyond the ends.

    Written out here, as the slopes are: the import of scipy.interpolate takes 0.15 s, a tenth of a mooring study.
    """
    slope[list(flat)] = 0.0

    def curve(at):
        at = np.asarray(at, float)
        i = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
        shape = (*at.shape, *(1,) * (y.ndim - 1))
        step = np.reshape(x[i + 1] - x[i], shape)
        t = np.reshape(at - x[i], shape) / step
        rise = y[i + 1] - y[i]
        bend = step * (slope[i] * (1 - t) - slope[i + 1] * t) + rise * (2 * t - 1)
        return y[i] + t * (rise + (1 - t) * bend)

    return curve


def _harmonic_slopes(x, y):
    """Slopes of Fritsch and Butland (1984); shape (n, …); at the ends of the parabola through three points, limited in
    sign and size

    (Moler, Numerical Computing with MATLAB, 2004, section 3.6)
    """
    step = np.diff(x).reshape(-1, *(1,) * (y.ndim - 1))
    secant = np.diff(y, axis=0) / step
    if len(x) == 2:
        return np.repeat(secant, 2, axis=0)
    left, right = 2 * step[1:] + step[:-1], step[1:] + 2 * step[:-1]
    same = secant[:-1] * secant[1:] > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.where(same, (left + right) / (left / secant[:-1] + right / secant[1:]), 0.0)
    first, last = (_end_slope(step[i], step[j], secant[i], secant[j]) for i, j in ((0, 1), (-1, -2)))
    return np.concatenate([first[None], inner, last[None]])


def _end_slope(step, next_step, secant, next_secant):
    slope = ((2 * step + next_step) * secant - step * next_secant) / (step + next_step)
    turned, steep = slope * secant <= 0, (secant * next_secant <= 0) & (np.abs(slope) > 3 * np.abs(secant))
    return np.where(turned, 0.0, np.where(steep, 3 * secant, slope))
