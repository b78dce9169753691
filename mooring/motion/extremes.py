"""The largest value of a run, from runs that differ only in their seed, without an assumed distribution.

For n independent runs let x₁ ≤ … ≤ xₙ be their largest values, and m the median of the largest value of a run: half of
all runs exceed m.

    P(x_d ≤ m ≤ x_{n+1−d}) = 1 − 2 P(B < d),   B binomial (n, ½)                                   (1) at most a
    share 1 − (1−c)^(1/n) of such runs exceeds the largest of n, with confidence c (2)

The interval with probability CONFIDENCE is interpolated between the intervals of two neighbouring d (Hettmansperger
and Sheather 1986, Statistics & Probability Letters 4, 75-79).  No distribution is fitted, for two reasons: the
largest values of lines that snap in few runs come from two populations, and peaks of slow motion come in clusters.
`tests/bench/extremes_coverage.py` shows the effect on fitted distributions.
"""

from typing import NamedTuple

import numpy as np

CONFIDENCE = 0.9
FEWEST = 5  # runs: an interval of CONFIDENCE lies within the largest and smallest of them, 1 − 2^(1−n)
RARE = 2.0  # factor on the median of the largest values of runs; a larger one comes from few runs


class Extreme(NamedTuple):
    """Median of the largest (or smallest) value of a run, its confidence interval (CONFIDENCE), and the number of
    runs.

    nan with fewer than FEWEST runs, for which no such interval exists
    """

    median: float
    low: float
    high: float
    runs: int


def median_extreme(largest):
    """`Extreme` of the largest values (n,) of independent runs.

    For smallest values, change the sign of the values and of the result.
    """
    x = np.sort(np.asarray(largest, float))
    n = len(x)
    if n < FEWEST:
        return Extreme(np.nan, np.nan, np.nan, n)
    d, share = _order(n)
    low = (1 - share) * x[d - 1] + share * x[d]
    high = (1 - share) * x[n - d] + share * x[n - d - 1]
    return Extreme(float(np.median(x)), float(low), float(high), n)


def _order(n):
    """d of eq. (1) with at least CONFIDENCE, and the share of the way to the next order statistic inwards"""
    from scipy.special import bdtr

    d = 1
    while 1 - 2 * bdtr(d, n, 0.5) >= CONFIDENCE:
        d += 1
    at, inside = (1 - 2 * bdtr(k, n, 0.5) for k in (d - 1, d))
    given = (at - CONFIDENCE) / (at - inside)
    return d, (n - d) * given / (d + (n - 2 * d) * given)


def share_beyond(runs):
    """Upper bound, with confidence CONFIDENCE, of the share of runs that exceed the largest of `runs` runs: eq. (2)"""
    return -np.expm1(np.log1p(-CONFIDENCE) / runs)


def rare(largest):
    """Number of runs whose largest value is beyond RARE times their median; shape (q,); largest : (runs, q), above 0

    0 with fewer than FEWEST runs. If a line snaps or a fender is touched in only a few runs, a further run may have
    a value far beyond all others.
    """
    largest = np.asarray(largest, float)
    if len(largest) < FEWEST:
        return np.zeros(largest.shape[1], int)
    return np.sum(largest > RARE * np.median(largest, axis=0), axis=0)


def beyond(used, limit):
    """Number of runs in which a utilisation (runs, q) exceeds its limit; shape (q,); nan does not count"""
    return np.sum(np.asarray(used, float) > limit, axis=0)
