"""Shares of hours with their scatter over years: the range for other years of the same climate.

    p = Σ_y d_y / Σ_y n_y,   p₍y₎ the same without year y,   s² = (Y − 1)/Y Σ_y (p₍y₎ − p̄₍·₎)²,   p ± t s

d_y are the down hours and n_y the known hours of year y; t is from Student's distribution with Y − 1 degrees of freedom
(delete-one jackknife with years as blocks, Tukey 1958).  Hours of one storm are not independent of each other; years
nearly are.
"""

import numpy as np

CONFIDENCE = 0.9
FEWEST = 5  # years with an interval


def by_group(down, known, group, groups):
    """Sums of `down` and of `known` (n, …) over each of `groups` (g,): two arrays (g, …).

    down : (n, …) truths, or chances; group : (n,) of each row, sorted or not
    """
    place = np.searchsorted(groups, group)
    return tuple(_sums(values, place, len(groups)) for values in (down * known, known))


def _sums(values, place, count):
    flat = values.reshape(len(values), -1)
    found = [np.bincount(place, column, count) for column in flat.T.astype(float)]
    return np.stack(found, axis=-1).reshape(count, *values.shape[1:])


def share_with_interval(down, known, confidence=CONFIDENCE, most=1.0):
    """p, low, high, each (…), from sums (Y, …) by year; low and high are nan with fewer than FEWEST years, p is nan
    without hours

    most : upper limit of p; inf for a mean, such as a waiting time
    """
    from scipy.special import stdtrit

    years = len(down)
    share = _ratio(down.sum(axis=0), known.sum(axis=0))
    if years < FEWEST:
        return share, np.full_like(share, np.nan), np.full_like(share, np.nan)
    without = _ratio(down.sum(axis=0) - down, known.sum(axis=0) - known)
    spread = np.sqrt((years - 1) / years * np.sum((without - without.mean(axis=0)) ** 2, axis=0))
    t = stdtrit(years - 1, 0.5 + 0.5 * confidence)
    return share, np.clip(share - t * spread, 0.0, most), np.clip(share + t * spread, 0.0, most)


def _ratio(above, below):
    return np.divide(above, below, out=np.full(np.shape(above), np.nan), where=np.asarray(below) > 0)
