"""Water levels of a site, and the current of a long wave that rises by a:  a √(g/h)."""

import numpy as np

GRAVITY = 9.80665  # m/s²
LONG = 20  # depths in a wavelength, from which a wave is long


def levels(spring_high, spring_low, surge, tsunami, depth):
    """{name: m above mean water}; surge, tsunami : m, or None.  Raises ValueError."""
    for key, value, side, wrong in (
        ("spring_low", spring_low, "most", spring_low > 0),
        ("spring_high", spring_high, "least", spring_high < 0),
    ):
        if wrong:
            raise ValueError(
                f"levels.{key} is {value:g}; allowed: at {side} 0, since levels are heights above mean water"
            )
    for key, value in (("surge", surge), ("tsunami", tsunami)):
        if value is not None and not 0 <= value < depth:
            raise ValueError(f"levels.{key} is {value:g}; allowed: 0 to the depth, {depth:g} m")
    made = {"high": spring_high + (surge or 0.0), "low": spring_low}
    if tsunami is not None:
        made |= {"tsunami high": spring_high + tsunami, "tsunami low": spring_low - tsunami}
    lowest = min(made.values())
    if not depth + lowest > 0:
        raise ValueError(f"levels: the lowest is {lowest:g} m in {depth:g} m of water; allowed: above the bed")
    return made


def tsunami_current(rise, period, depth):
    """Current, m/s, under a long wave that rises by `rise`, m. Raises ValueError if a wave of this period, s, is not
    long.
    """
    length = period * np.sqrt(GRAVITY * depth)
    if length < LONG * depth:
        raise ValueError(
            f"levels.tsunami_period is {period:g} s; allowed: above {LONG * depth / length * period:.3g} s, so that "
            f"the tsunami is a long wave"
        )
    return float(rise * np.sqrt(GRAVITY / depth))
