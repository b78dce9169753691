"""Scatter diagrams: probability of each height and period, from a table of counts, percentages or probabilities.

    # comment
    significant_period, 3.5, 4.5, 5.5
    0.25,               12,  30,   4
    0.75,                0,  18,  22

The first word names the kind of period. The first row contains the middles of the period classes (s), the first
column the middles of the height classes (m).  Empty fields count as 0.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .allowed import rising
from .logger_files import read_table
from .periods import KINDS
from .tables import TableError


@dataclass(frozen=True, eq=False)
class Scatter:
    """heights : (n,) m; periods : (m,) s; probability : (n, m), sum 1; period_kind : one of `periods.KINDS`."""

    heights: np.ndarray
    periods: np.ndarray
    probability: np.ndarray
    period_kind: str

    def __post_init__(self):
        heights, periods = rising("height of a class", self.heights, 1), rising("period of a class", self.periods, 1)
        probability = np.asarray(self.probability, float)
        if self.period_kind not in KINDS:
            raise ValueError(f"period kind is {self.period_kind!r}; allowed: {', '.join(KINDS)}")
        if not (heights[0] > 0 and periods[0] > 0):
            raise ValueError(
                f"the first classes of the scatter diagram are {heights[0]:g} m and {periods[0]:g} s; allowed: above 0"
            )
        if probability.shape != (len(heights), len(periods)):
            shape = f"{len(heights)} heights and {len(periods)} periods"
            raise ValueError(f"probability has the shape {probability.shape}; allowed: {shape}")
        if not (np.all(probability >= 0) and 0 < probability.sum() < np.inf):
            raise ValueError(
                f"smallest probability is {probability.min():g}; allowed: at least 0, and above 0 somewhere"
            )
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "periods", periods)
        object.__setattr__(self, "probability", probability / probability.sum())

    def __repr__(self):
        h, t = self.heights, self.periods
        kind = self.period_kind.replace("_", " ")
        return f"<Scatter {len(h)} heights {h[0]:g} to {h[-1]:g} m, {len(t)} {kind}s {t[0]:g} to {t[-1]:g} s>"

    def states(self):
        """Return (height, period, probability) of every class that occurs"""
        for i, j in np.argwhere(self.probability > 0):
            yield float(self.heights[i]), float(self.periods[j]), float(self.probability[i, j])


def read_scatter(path):
    """Scatter of a CSV file.  Raises TableError."""
    names, values, _ = read_table(Path(path), blank=0.0)
    if names is None:
        raise TableError(f"{path} begins with a number; allowed: {', '.join(KINDS)}, then periods in s")
    kind, *periods = names
    try:
        return Scatter(values[:, 0], [float(word) for word in periods], values[:, 1:], kind)
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None
