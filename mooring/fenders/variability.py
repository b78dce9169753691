"""Deviation of a fender from its catalogue: bands of factors on its reaction, and their combination.

    R = f(δ) Π factors;    softest Π smallest,  stiffest Π largest

(1 − γ of the SR179 report (1982), eq. 3.7.1.11; bands of its chapter 3.4, `tables/variation.csv`.)  `drawn` draws each
factor from its band at random, uniformly and independently: the share of softer or stiffer fenders follows.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from .families import table_rows
from .fender import FenderError


@cache
def bands():
    """{cause: (smallest, largest) factor on the reaction}"""
    return {row["cause"]: (float(row["smallest"]), float(row["largest"])) for row in table_rows("variation")}


def chosen(causes=None, **own):
    """Bands of the named causes, all if None, with those in `own` instead of the table's.  Raises FenderError."""
    table = bands() | own
    unknown = [cause for cause in causes or () if cause not in table]
    if unknown:
        raise FenderError(f"variation by {unknown[0]!r} is unknown; allowed: {', '.join(table)}")
    out = {cause: table[cause] for cause in (causes or table)}
    for cause, (low, high) in out.items():
        if not 0 < low <= high < np.inf:
            raise FenderError(
                f"variation by {cause} goes from {low:g} to {high:g}; allowed: above 0, increasing, finite"
            )
    return out


def extremes(table):
    """Factors of the softest and of the stiffest fender of bands {cause: (smallest, largest)}"""
    low, high = np.array(list(table.values())).T
    return float(low.prod()), float(high.prod())


def drawn(table, count, seed):
    """(count,) factors of fenders whose causes are drawn uniformly from their bands"""
    low, high = np.array(list(table.values())).T
    return np.prod(np.random.default_rng(seed).uniform(low, high, (count, len(low))), axis=1)


def velocity_factor(period):
    """Factor on the reaction of a cycle of `period` s: 1.1 at 1 s and below, 1 at 10 s and above, linear in log T.

    SR179 report (1982), chapter 3.4: +10 % at 1 s, notable below 5 s, none above 10 s.
    """
    return 1.1 - 0.1 * np.clip(np.log10(np.asarray(period, float)), 0.0, 1.0)
