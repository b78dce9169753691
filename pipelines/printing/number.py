"""A number in a table: printed with significant digits, with full precision for --csv, --json and a sweep."""

import math
from functools import cache

DIGITS = 4
NOTHING = "–"
LEAST = 1e-9  # size below which a number with fixed decimals is 0


def number(value, factor=1.0, digits=DIGITS):
    """A cell of a table with `digits` significant digits of value / factor; its `value`, a float, is not rounded.

    factor : factor of the unit named in the column, such as 1e3 for kN; a value that is not finite is a dash, and
    null in JSON
    """
    kept = float(value) / factor
    made = _cell()(significant(kept, digits))
    made.value = kept
    return made


@cache
def _cell():
    from rich.text import Text

    class Number(Text):
        value = math.nan

    return Number


def significant(value, digits=DIGITS):
    """A number as text: 0.01323, 13.2, 13230; never a power of ten between 1e-4 and 1e15"""
    if not math.isfinite(value):
        return NOTHING
    whole = 10**digits - 0.5 <= abs(value) < 1e15  # the format g would print a power of ten here
    return f"{value + 0.0:.0f}" if whole else f"{value + 0.0:.{digits}g}"


def fixed(value, decimals=2):
    """A number as text with the given decimals, or with more decimals for three significant digits: 12.35, 0.0123"""
    small = LEAST < abs(value) < 10.0 ** (2 - decimals)
    return (
        significant(value, 3) if small or not math.isfinite(value) else f"{round(value, decimals) + 0.0:.{decimals}f}"
    )
