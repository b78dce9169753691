"""Return periods.

    R = 1 / (1 − q^(1/T))    for a value that is not exceeded in T years with probability q

SR179 report (1982), design guideline 3.2 and 3.3.  Laws of yearly maxima are in `mooring.site.extremes`.
"""

import numpy as np


def return_period(life, probability):
    """Return period R, years, of the value that is not exceeded in `life` years with `probability`; both broadcast."""
    life, q = np.asarray(life, float), np.asarray(probability, float)
    _check(np.all(life > 0), f"service life is {life} years; allowed: above 0")
    _check(np.all((q > 0) & (q < 1)), f"probability is {q}; allowed: between 0 and 1")
    return -1 / np.expm1(np.log(q) / life)


def probability_not_exceeded(life, period):
    """Probability q that the value with a return period of `period` years is not exceeded in `life` years."""
    life, R = np.asarray(life, float), np.asarray(period, float)
    _check(np.all(life > 0), f"service life is {life} years; allowed: above 0")
    _check(np.all(R > 1), f"return period is {R} years; allowed: above 1")
    return np.exp(life * np.log1p(-1 / R))


def _check(good, message):
    if not good:
        raise ValueError(message)
