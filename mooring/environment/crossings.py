"""Waves of a record between zero crossings, and the distribution of their heights in a narrow spectrum.

A wave lasts from one crossing to the next crossing in this direction; its height is its crest minus its trough.
Crossing times are interpolated linearly; crests and troughs are the tops of parabolas through the highest values.
Without parabolas, heights of waves with 16 values per period would be 1 % too low.

    Rayleigh: P(H > h) = exp(−h²/8m₀);  mean of the highest part p = √8m₀ {√L + √π/(2p) erfc √L},  L = ln 1/p
    width of the spectrum  ε² = 1 − m₂²/(m₀m₄) = 1 − (zero crossings / maxima)²   (Cartwright & Longuet-Higgins 1956)
"""

import math
from dataclasses import dataclass

import numpy as np

from .allowed import positive, row_of_numbers

FEWEST = 3  # waves
EULER = 0.5772156649015329


@dataclass(frozen=True, eq=False)
class Crossings:
    """Waves in the order of the record.

    heights, periods : (n,), m and s; crests, troughs : (n,) m from the mean level; troughs are negative
    maxima_per_wave : local maxima of the record per wave
    """

    heights: np.ndarray
    periods: np.ndarray
    crests: np.ndarray
    troughs: np.ndarray
    maxima_per_wave: float

    def __len__(self):
        return len(self.heights)

    def __repr__(self):
        return f"<{len(self)} waves, H1/3 {self.significant_height:.4g} m, T1/3 {self.significant_period:.4g} s>"

    def highest(self, part):
        """Mean height (m) and period (s) of the highest `part` of the waves (0 < part ≤ 1, at least one wave)"""
        if not 0 < part <= 1:
            raise ValueError(f"the fraction of the highest waves to average is {part:g}; allowed: above 0, at most 1")
        chosen = np.argsort(self.heights)[-max(1, round(part * len(self))) :]
        return float(self.heights[chosen].mean()), float(self.periods[chosen].mean())

    @property
    def significant_height(self):
        """H1/3, m"""
        return self.highest(1 / 3)[0]

    @property
    def significant_period(self):
        """T1/3, s"""
        return self.highest(1 / 3)[1]

    @property
    def tenth_height(self):
        """H1/10, m"""
        return self.highest(1 / 10)[0]

    @property
    def maximum_height(self):
        """Hmax, m"""
        return float(self.heights.max())

    @property
    def mean_height(self):
        """m"""
        return float(self.heights.mean())

    @property
    def mean_period(self):
        """Mean period between crossings in one direction, s; for a spectrum this is T02"""
        return float(self.periods.mean())


def zero_crossings(record, step, direction="up"):
    """Crossings of a record.

    record : (n,) m, from which the mean is subtracted; step : s; direction : "up" or "down". Raises ValueError for a
        record of fewer than 3 waves.
    """
    record, step = row_of_numbers("record", record, 3), positive("step", step, "s")
    if direction not in ("up", "down"):
        raise ValueError(f"direction of the crossings is {direction!r}; allowed: up, down")
    eta = record - record.mean()
    up = eta if direction == "up" else -eta
    at = np.flatnonzero((up[:-1] < 0) & (up[1:] >= 0))
    if len(at) < FEWEST + 1:
        raise ValueError(
            f"the record has {max(0, len(at) - 1)} complete waves; allowed: at least {FEWEST}; give a longer record"
        )
    times = step * (at + up[at] / (up[at] - up[at + 1]))
    high, highs = local_maxima(eta)
    low, _ = local_maxima(-eta)
    crests = np.maximum.reduceat(high, at + 1)[:-1]
    troughs = -np.maximum.reduceat(low, at + 1)[:-1]
    maxima = np.count_nonzero((highs > at[0]) & (highs <= at[-1])) / (len(at) - 1)
    return Crossings(crests - troughs, np.diff(times), crests, troughs, maxima)


def rayleigh_height(m0, part):
    """Mean height (m) of the highest `part` of the waves of a narrow spectrum with variance m0 (m²); 0 < part ≤ 1."""
    if not 0 < part <= 1:
        raise ValueError(f"the fraction of the highest waves to average is {part:g}; allowed: above 0, at most 1")
    root = math.sqrt(-math.log(part))
    return math.sqrt(8 * m0) * (root + 0.5 * math.sqrt(math.pi) / part * math.erfc(root))


def expected_maximum_height(m0, waves):
    """Mean height (m) of the highest of `waves` waves (at least 10) of a narrow spectrum with variance m0 (m²)."""
    if not waves >= 10:
        raise ValueError(f"number of waves is {waves:g}; allowed: at least 10")
    root = math.sqrt(2 * math.log(waves))
    return 2 * math.sqrt(m0) * (root + EULER / root)


def local_maxima(eta):
    """A copy of values with every local maximum raised to the top of its parabola, and the places of the maxima"""
    top = eta.copy()
    at = 1 + np.flatnonzero((eta[1:-1] > eta[:-2]) & (eta[1:-1] >= eta[2:]))
    slope, bend = eta[at + 1] - eta[at - 1], eta[at + 1] - 2 * eta[at] + eta[at - 1]
    top[at] -= slope**2 / (8 * bend)
    return top, at
