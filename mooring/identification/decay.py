"""Damping of a body in free decay: extinction by half cycles, and the equation of motion itself.

    Xₙ − Xₙ₊₁ = a X_m + b X_m²,    X_m = (Xₙ + Xₙ₊₁)/2                     of successive extremes (half cycles)
    ẍ + β₁ ẋ + β₂ ẋ|ẋ| + Ω² (x − x₀) = 0,    β = B/M_v,    a ≈ (π/2) β₁/ω,  b ≈ (4/3) β₂
    ẍ + β₁ ẋ + β₃ ẋ³ + Ω² (x − x₀) = 0                                      the same with a cube in place of the square

(Shiraishi et al., eq. 3, whose δX is negative as printed; the sizes of its swings show that they are half cycles.) β
and Ω are chosen so that the solution fits the record best.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .record import RecordError, checked

FEWEST = 3  # extremes
ACCURATE = 1e-10  # steps of the solution
FAR = 1e6  # residual instead of a value that is not finite
DIFFERENCE = 1e-5  # finite-difference step of a parameter, over its unit


class Decay(NamedTuple):
    """a : 1, b : 1/m, linear_only : a with b = 0; linear, quadratic : β₁ 1/s, β₂ 1/m; omega : Ω rad/s; mean : x₀ m

    with_cubic : β₁ 1/s, β₃ s/m², and the remaining deviation with both
    extremes : absolute values, (n,) m; fitted : the solution, (q,) m; off : deviation from the record over the
        record's standard deviation
    """

    a: float
    b: float
    linear_only: float
    linear: float
    quadratic: float
    omega: float
    mean: float
    extremes: np.ndarray
    fitted: np.ndarray
    off: float
    with_cubic: tuple


def decay(time, motion):
    """`Decay` of a record, s, m.  Raises RecordError for fewer than three extremes, or a motion that does not decay."""
    t, x = checked(time, motion)
    mean, omega, X = _extremes(t, x)
    a, b, alone = _extinction(X)
    start = [x[0], _slope(t, x), mean, omega, max(2 * alone * omega / np.pi, 1e-4 * omega), 0.0]
    found, fitted = _fitted(t, x, np.array(start), X[0])
    cubed, other = _fitted(t, x, np.array(start), X[0], 3)
    left, with_cubic = (float(np.std(x - made) / np.std(x)) for made in (fitted, other))
    third = float(cubed[4]), float(cubed[5]), with_cubic
    return Decay(a, b, alone, *map(float, found[[4, 5, 3, 2]]), X, fitted, left, third)


def _slope(t, x):
    """m/s at the start, of a parabola through the first tenth of a cycle or eight values"""
    n = min(8, len(t))
    return float(np.polyfit(t[:n], x[:n], 2)[1])


def _extremes(t, x):
    """Mean, frequency, and the extremes between crossings of the mean, each from a parabola about it"""
    mean = x[len(x) // 2 :].mean()
    for _ in range(2):
        y = x - mean
        smooth = np.convolve(y, np.ones(5) / 5, mode="same")
        ends = np.flatnonzero(np.diff(np.sign(smooth)) != 0)
        least = 0.25 * np.median(np.diff(ends)) if len(ends) > 2 else 0
        ends = [e for i, e in enumerate(ends) if i == 0 or e - ends[i - 1] > least]
        if len(ends) <= FEWEST:
            raise RecordError(f"the record crosses its mean {len(ends)} times; allowed: {FEWEST + 1} or more")
        X = []
        for i, j in pairwise(ends):
            part = slice(i + 1 + (j - i) // 4, max(i + 4 + (j - i) // 4, j + 1 - (j - i) // 4))
            count = len(y[part])  # fewer than requested at the end of the record
            c = np.polyfit(t[part] - t[i], y[part], 4 if count > 8 else min(2, count - 1))
            fine = np.linspace(t[part][0] - t[i], t[part][-1] - t[i], 400)
            value = np.polyval(c, fine)
            X.append(value[np.abs(value).argmax()])
        X = np.array(X)
        if len(X) >= 4:
            mean += float(np.mean(0.25 * (X[:-2] + 2 * X[1:-1] + X[2:])))
    return mean, float(np.pi * (len(ends) - 1) / (t[ends[-1]] - t[ends[0]])), np.abs(X)


def _extinction(X):
    """a, b and a with b = 0, by least squares over extremes (n,)"""
    lost, middle = X[:-1] - X[1:], 0.5 * (X[:-1] + X[1:])
    a, b = np.linalg.lstsq(np.stack([middle, middle**2], axis=1), lost, rcond=None)[0]
    alone = float(lost @ middle / (middle @ middle))
    if not alone > 0:
        raise RecordError(f"the motion grows by {-100 * alone:.3g} % in half a cycle; allowed: a motion that decays")
    return float(a), float(b), alone


def _fitted(t, x, start, size, power=2):
    """Start, speed, mean, Ω, β₁, β₂ or β₃ of the solution that fits the record best, and this solution (q,)"""
    from scipy.optimize import least_squares

    rate = start[3]
    unit = np.array([size, size * rate, size, rate, rate, rate / (size * rate) ** (power - 1)])
    shift = DIFFERENCE * np.eye(6)

    def off(p):
        with np.errstate(over="ignore", invalid="ignore"):  # a trial with damping that makes the motion diverge
            y = _solutions((p * unit)[:, None], t, power)[:, 0]
        return np.nan_to_num((y - x) / size, nan=FAR, posinf=FAR, neginf=-FAR)

    def slope(p):
        both = np.concatenate([p + shift, p - shift]) * unit
        with np.errstate(over="ignore", invalid="ignore"):
            y = _solutions(both.T, t, power) / size
            return np.nan_to_num((y[:, :6] - y[:, 6:]) / (2 * DIFFERENCE), nan=0.0, posinf=FAR, neginf=-FAR)

    found = least_squares(off, start / unit, jac=slope, xtol=1e-13, ftol=1e-15, gtol=1e-15, max_nfev=25)
    return found.x * unit, x + size * found.fun


def _solutions(parameters, time, power=2):
    """Solutions, m, at times (q,), s, of m sets of parameters (6, m), by `scipy`; shape (q, m); nan for a divergent
    one"""
    from scipy.integrate import solve_ivp

    x, v, mean, omega, first, second = parameters
    small = np.repeat([1.0, omega.max()], len(x)) * ACCURATE * np.abs(x).max()

    def rates(_, y):
        x, v = y.reshape(2, -1)
        return np.concatenate([v, -v * (first + second * np.abs(v) ** (power - 1)) - omega**2 * (x - mean)])

    found = solve_ivp(rates, time[[0, -1]], np.concatenate([x, v]), "DOP853", time, rtol=ACCURATE, atol=small)
    out = np.full((len(time), len(x)), np.nan)
    out[: len(found.t)] = found.y[: len(x)].T
    return out
