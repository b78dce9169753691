"""Return periods, and the double exponential distribution of yearly maxima.

    R = 1 / (1 − q^(1/T))    for a value that is not exceeded in T years with probability q
    P(x) = exp(−exp(−y)),    y = a (x − b),    x_R = b − (1/a) ln(−ln(1 − 1/R))

SR179 report (1982), design guideline 3.2 and 3.3.  Location b and scale 1/a are fitted by maximum likelihood.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

FEWEST = 5  # years; fewer fix no scale


def return_period(life, probability):
    """R in years of the value that is not exceeded in `life` years with `probability`; both broadcast."""
    life, q = np.asarray(life, float), np.asarray(probability, float)
    _check(np.all(life > 0), f"service life is {life} years; allowed: above 0")
    _check(np.all((q > 0) & (q < 1)), f"probability is {q}; allowed: between 0 and 1")
    return -1 / np.expm1(np.log(q) / life)


def probability_not_exceeded(life, period):
    """q with which the value of return period `period` years is not exceeded in `life` years."""
    life, R = np.asarray(life, float), np.asarray(period, float)
    _check(np.all(life > 0), f"service life is {life} years; allowed: above 0")
    _check(np.all(R > 1), f"return period is {R} years; allowed: above 1")
    return np.exp(life * np.log1p(-1 / R))


class Gumbel(NamedTuple):
    """location b and scale 1/a of yearly maxima; covariance (2, 2) of both; count : years fitted"""

    location: float
    scale: float
    covariance: np.ndarray
    count: int

    def not_exceeded(self, x):
        """(…,) probability that the maximum of one year stays below x"""
        return np.exp(-np.exp(-(np.asarray(x, float) - self.location) / self.scale))

    def value(self, period):
        """x_R of a return period in years, above 1; broadcasts"""
        return self.location + self.scale * _reduced(period)

    def interval(self, period, confidence=0.9):
        """(low, high) of x_R by the scatter of the fit: normal, from the curvature of the likelihood."""
        from scipy.special import ndtri

        _check(0 < confidence < 1, f"confidence is {confidence:g}; allowed: between 0 and 1")
        y = _reduced(period)
        variance = self.covariance[0, 0] + 2 * y * self.covariance[0, 1] + y**2 * self.covariance[1, 1]
        half = ndtri(0.5 + 0.5 * confidence) * np.sqrt(variance)
        return self.value(period) - half, self.value(period) + half


def fit_gumbel(maxima) -> Gumbel:
    """Gumbel's distribution of maxima (n,), one per year, by maximum likelihood.

    The scale s is the one root of  s = x̄ − Σ x e^(−x/s) / Σ e^(−x/s).
    Raises ValueError with fewer than 5 years, or where all maxima are equal.
    """
    from scipy.optimize import brentq

    x = np.asarray(maxima, float)
    _check(x.ndim == 1 and np.all(np.isfinite(x)), "yearly maxima are one row of finite numbers")
    _check(len(x) >= FEWEST, f"{len(x)} yearly maxima; allowed: at least {FEWEST}")
    width = x.std()
    _check(width > 1e-9 * np.abs(x).max(), "all yearly maxima are equal; there is no distribution to fit")
    u = x - x.min()

    def balance(scale):
        weight = np.exp(-u / scale)
        return u.mean() - weight @ u / weight.sum() - scale

    scale = brentq(balance, 1e-3 * width, 1e2 * width, xtol=1e-14 * width)
    location = x.min() - scale * np.log(np.mean(np.exp(-u / scale)))
    return Gumbel(float(location), float(scale), _covariance(u, location - x.min(), scale), len(x))


def _covariance(u, location, scale):
    """Inverse of the observed information: second derivatives of −ln likelihood at its minimum"""
    y = (u - location) / scale
    e, n = np.exp(-y), len(u)
    information = np.array(
        [
            [e.sum(), (y * e).sum() - e.sum() + n],
            [(y * e).sum() - e.sum() + n, (y * y * e).sum() - 2 * (y * e).sum() + 2 * y.sum() - n],
        ]
    )
    return scale**2 * np.linalg.inv(information)


def _reduced(period):
    R = np.asarray(period, float)
    _check(np.all(R > 1), f"return period is {R} years; allowed: above 1")
    return -np.log(-np.log1p(-1 / R))


def _check(good, message):
    if not good:
        raise ValueError(message)
