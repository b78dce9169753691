"""Largest values of a linear response: in every hour, in every year, and for a return period.

    hour    x̄ = σ (s + γ_E/s),  s = √(2 ln n),  n = duration / T_zero                     (`response.extremes`)
    year    P(x_y < x) = exp(−Σ_h n_h exp(−x²/2σ_h²)),  h over the hours of the year

As in a measurement, each year has one largest value; it is drawn from the distribution of that year. The yearly
maxima, and the interval of the return value (`site.extremes`), then include the randomness of the sea.
"""

import numpy as np

from ..response.extremes import EULER
from ..site.extremes import fit_extremes

SEED = 1982
# hours with σ below this fraction of the largest of a year are skipped; they add exp(−4 · 16) of the crossings
LOW = 0.5
WHOLE = 0.9  # fraction of the hours of a year needed for a yearly maximum


def largest_of_hours(m0, m2, duration):
    """Mean largest amplitude in `duration` s from moments (…,); shape (…,); 0 without motion, nan where unknown"""
    sigma = np.sqrt(m0)
    with np.errstate(invalid="ignore", divide="ignore"):
        count = duration / (2 * np.pi) * np.sqrt(m2 / m0)
        s = np.sqrt(2 * np.log(np.maximum(count, np.e)))
        return np.where(m0 > 0, sigma * (s + EULER / s), sigma)


def drawn_of_years(m0, m2, year, step):
    """Complete years (Y,), and one largest value for each of them (Y, c); m0, m2 : (n, c); year : (n,); step : s"""
    kept, out = whole_years(np.isfinite(m0[:, 0]), year, step), []
    share = np.random.default_rng(SEED).uniform(size=(len(kept), m0.shape[1]))
    for one, u in zip(kept, share, strict=True):
        rows = year == one
        out.append([_drawn(a, b, step, p) for a, b, p in zip(m0[rows].T, m2[rows].T, u, strict=True)])
    return kept, np.array(out).reshape(len(kept), m0.shape[1])


def whole_years(known, year, step):
    """Years with enough known rows (n,) of `step` s; shape (Y,)"""
    years = np.unique(year)
    return years[[known[year == one].sum() * step >= WHOLE * 365.25 * 86400 for one in years]]


def _drawn(m0, m2, step, share):
    """x with exp(−N(x)) = share"""
    from scipy.optimize import brentq

    m2, m0 = m2[m0 > 0], m0[m0 > 0]
    if not len(m0):
        return 0.0
    chosen = m0 >= LOW**2 * m0.max()
    count = step / (2 * np.pi) * np.sqrt(m2[chosen] / m0[chosen])
    m0 = m0[chosen]

    def over(x):
        return np.log(np.sum(count * np.exp(-0.5 * x * x / m0))) - np.log(-np.log(share))

    sigma = np.sqrt(m0.max())
    return brentq(over, 0.0, 12 * sigma) if over(0.0) > 0 else 0.0


def return_values(maxima, period):
    """Return value and its interval: value, low, high, each (c,), from yearly maxima (Y, c) by Gumbel's law.

    nan for fewer than 5 years, or without motion
    """
    out = np.full((3, maxima.shape[1]), np.nan)
    for i, column in enumerate(maxima.T):
        if len(column) >= 5 and np.ptp(column) > 1e-9 * np.abs(column).max():
            fit = fit_extremes(column)
            out[:, i] = fit.value(period), *fit.interval(period)
    return out
