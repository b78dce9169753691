"""Findings on lines that break, or that exceed the allowable share of their breaking load, with names and shares."""

import numpy as np

from ..response.findings import LINES_NAMED, some
from .failing import fails

HELP = "give a stronger type, a longer line or less pretension"
OF_STUDY = "; the limit is the study's own key allowable, not that of a rule set"


def overused(names, used, allowable, where, help=HELP):
    """Findings on lines that fail.

    names : names of the lines; used : (n,) tension over breaking load, NaN where unknown; allowable : share, at most 1
    where : words that name the tension, such as "at the largest tension"; help : words that name the remedy
    """
    used = np.asarray(used, float)
    parted = used > 1
    kinds = (
        (parted, "beyond the breaking load, limit 100 %, at which they break"),
        ((used > allowable) & ~parted, f"above the allowable {100 * allowable:g} % of the breaking load"),
    )
    for chosen, text in kinds:
        if np.any(chosen):
            named = shares(names, np.where(chosen, used, np.nan))
            more = "more " if chosen is not parted and np.any(parted) else ""
            whose = "" if chosen is parted else OF_STUDY
            yield fails(f"{chosen.sum()} {more}of {len(used)} lines {where} {text}: {named}; {help}{whose}")


def shares(names, values):
    """Words such as "fore 3 119 %, …", with the largest first; NaN is omitted"""
    values = np.asarray(values, float)
    order = [i for i in np.argsort(-values, kind="stable") if not np.isnan(values[i])]
    return some([f"{names[i]} {_percent(values[i])}" for i in order], LINES_NAMED)


def _percent(share):
    """A share in per cent, never rounded to "100 %" or "40 %" when it exceeds such a limit"""
    return f"{100 * share:.4g} %" if np.isfinite(share) else "infinitely"
