"""Fatigue of a line: cycles of tension, the number of cycles to failure, Miner's sum.

    N(s) = a s^(−m)                  cycles to failure at range s (of stress, or of tension over the breaking load)
    D = Σ nᵢ / N(sᵢ)                 Miner's sum; failure is expected at 1

Cycles are counted in a record by rainflow (ASTM E1049-85, the library `rainflow`). Curves come from a table or from
the user. The SR179 report (1982), chapter 4, 2.1 and 2.2, states what curves depend on: corrosion, preload,
terminations, bending over a fairlead. The report's own curves are lost.
"""

from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from ..lines.catalogue import CHAIN
from .strength import chain_factor

BASES = ("stress", "share")
YEAR = 365.25 * 86400.0  # s


class Curve(NamedTuple):
    """Cycles to failure N = constant · s^(−exponent) · 10^(mean_slope · mean tension / breaking load)

    basis : "stress", s in MPa, or "share", s is the tension range over a breaking load; chain : whether the curve is
        for chain
    """

    name: str
    basis: str
    exponent: float
    constant: float
    mean_slope: float = 0.0
    chain: bool = False
    source: str = "the user's own"

    def reference(self, diameter, breaking_load):
        """Divisor that converts a tension range in N to s.

        diameter : nominal diameter, mm; breaking_load : breaking load of the line, N; a chain's share refers to
        grade ORQ of this diameter
        """
        if self.basis == "stress":
            legs = 2 if self.chain else 1
            return legs * np.pi / 4 * diameter**2  # N/mm² is MPa
        return CHAIN["orq"].breaking * 1e3 * chain_factor(diameter) if self.chain else breaking_load

    def strength(self, mean_share=0.0):
        """Constant a of N = a s^(−m) at a given ratio of mean tension to breaking load"""
        return self.constant * 10.0 ** (self.mean_slope * mean_share)


class Cycles(NamedTuple):
    """Cycles of tension from one or many records. range, mean : (n,) N; count : (n,), 0.5 or 1"""

    range: np.ndarray
    mean: np.ndarray
    count: np.ndarray


def curves():
    """{name: Curve} of the table"""
    return {
        row["name"]: Curve(
            row["name"],
            row["basis"],
            float(row["exponent"]),
            float(row["constant"]),
            float(row["mean_slope"]),
            row["chain"] == "yes",
            row["source"],
        )
        for row in packaged_rows(__package__, "fatigue_curves")
    }


def rainflow_cycles(tension) -> Cycles:
    """Cycles of a record (n,) N by rainflow counting; unclosed cycles count as halves.

    raises : ValueError for a record with gaps
    """
    import rainflow

    tension = np.asarray(tension, float)
    if tension.ndim != 1 or len(tension) < 2 or not np.all(np.isfinite(tension)):
        raise ValueError("the tension record has gaps or fewer than two samples; allowed: a row of finite numbers")
    found = np.array([cycle[:3] for cycle in rainflow.extract_cycles(tension)], float).reshape(-1, 3)
    return Cycles(*found.T)


def miner(cycles, curve, diameter, breaking_load):
    """Miner's sum D of Cycles, and Q, the sum of the squared damages of all cycles; diameter : mm; breaking_load : N

    The sum has one random term for each cycle. D²/Q is the effective number of terms, and √Q is the standard error of
    the sum.
    """
    each = damages(cycles, curve, diameter, breaking_load)
    return float(cycles.count @ each), float(cycles.count @ each**2)


def damages(cycles, curve, diameter, breaking_load):
    """Damage 1/N(s) by one full cycle of each range in Cycles; shape (n,); diameter : mm; breaking_load : N"""
    s = cycles.range / curve.reference(diameter, breaking_load)
    return s**curve.exponent / curve.strength(cycles.mean / breaking_load)
