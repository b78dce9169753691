"""Waves too high for their water depth and period.

H_b = 0.142 λ tanh kh     highest single wave of period Tp (Miche 1944); 0.89 h in long waves
H_s = 0.6 h               a sea saturated with breakers, from H_rms = 0.42 h (Thornton & Guza 1983)
H_max = 1.86 H_s          expected highest of 1000 waves (Rayleigh)
"""

import numpy as np

from hakobune.bem.waves import wavenumber

MICHE = 0.142
SATURATED = 0.6
HIGHEST_OF_1000 = 1.86
GRAVITY = 9.80665


class BreakingError(ValueError):
    """Waves higher than possible in their water; the message names the height, the limit and a remedy"""


def breaking_height(period, depth, gravity=GRAVITY):
    """H_b, m, of a wave of `period` s in water of `depth` m; both broadcast, depth may be inf"""
    k = wavenumber(2 * np.pi / np.asarray(period, float), depth, gravity)
    return MICHE * 2 * np.pi / k * np.tanh(k * depth)


def largest_height(period, depth, gravity=GRAVITY):
    """Largest significant height, m, in water of `depth` m: 0.6 h, or H_b of the period if H_b is less"""
    return np.minimum(SATURATED * depth, breaking_height(period, depth, gravity))


def too_high(spectrum, depth, gravity=GRAVITY):
    """Messages on a sea whose waves break in water of `depth` m.  Raises BreakingError for an impossible sea."""
    return too_high_waves(spectrum.significant_height, spectrum.Tp, depth, gravity)


def too_high_waves(height, Tp, depth, gravity=GRAVITY):
    """Messages on waves of a significant height, m, and a peak period, s (inf if unknown), that break in water of
    `depth` m
    """
    single = 2 * np.pi * MICHE * depth if np.isinf(Tp) else float(breaking_height(Tp, depth, gravity))
    if height > single:
        period = "" if np.isinf(Tp) else f" at a peak period of {Tp:.4g} s"
        raise BreakingError(
            f"significant height is {height:.4g} m{period}, but single waves break at {single:.4g} m in {depth:g} m of "
            f"water; give at most {min(single, SATURATED * depth):.3g} m"
        )
    if height > SATURATED * depth:
        yield (
            f"significant height {height:.4g} m is {height / depth:.2g} of the water depth {depth:g} m; "
            f"breaking limits it to {SATURATED:g} of the depth; give at most {SATURATED * depth:.3g} m"
        )
    elif HIGHEST_OF_1000 * height > single:
        yield (
            f"the highest of 1000 waves, {HIGHEST_OF_1000 * height:.3g} m, breaks at {single:.3g} m in {depth:g} m of "
            "water: extremes by Rayleigh's distribution are too high"
        )
