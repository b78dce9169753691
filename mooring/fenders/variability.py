"""Deviation of a fender from its catalogue: bands of factors on its reaction, and the combination of bands.

    R = f(δ) Π factors;    softest Π smallest,  stiffest Π largest

(1 − γ of the SR179 report (1982), eq. 3.7.1.11; bands of its chapter 3.4, `tables/variation.csv`.)
"""

from functools import cache

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from .fender import FenderError


@cache
def bands():
    """{cause: (smallest, largest) factor on the reaction}"""
    return {
        row["cause"]: (float(row["smallest"]), float(row["largest"])) for row in packaged_rows(__package__, "variation")
    }


def chosen(causes=None, **own):
    """Bands of the named causes, or of all causes if None; a band in `own` replaces the band in the table.  Raises
    FenderError.
    """
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
