"""A hawser, rope or spring: a straight line without weight with a tension T(e) over its elongation.

    e = d − L,   d² = x² + z²,   H = T x/d,   V = T z/d,   T = 0 for e ≤ 0,
    −∂(force)/∂(place) = T′ n n' + (T/d)(1 − n n'),   n = (x, z)/d

T(e) follows a table of load against elongation as monotone cubics (`mooring.fenders.curves`): T′ jumps only where the
line becomes taut.
"""

from dataclasses import dataclass

import numpy as np

from ...fenders.fender import Fender, FenderError, fender_of_points
from ..catenary.state import State
from .parts import LineSystemError


@dataclass(frozen=True)
class Hawser:
    """A hawser between two points, given by their names.

    pull : tension T, N, over elongation e, m, as a Fender without hysteresis (`pull_of_points`); length : m, without
        tension
    most : tension at the end of its table, N; beyond it the tension is extrapolated linearly
    """

    name: str
    pull: Fender
    length: float
    a: str
    b: str
    breaking_load: float = np.inf
    most: float = np.inf

    def __post_init__(self):
        if not 0 < self.length < np.inf:
            raise LineSystemError(f"line {self.name}: length is {self.length:g}; allowed: finite, above 0 m")
        if not self.breaking_load > 0:
            raise LineSystemError(f"line {self.name}: breaking_load is {self.breaking_load:g} N; allowed: above 0")

    @property
    def bed_friction(self):
        """Friction coefficient 0: a hawser does not lie on the bed"""
        return 0.0


def pull_of_points(name, elongation, tension):
    """Fender T(e) through points (n,) m and (n,) N, ascending from (0, 0).  raises : LineSystemError"""
    e, T = np.asarray(elongation, float), np.asarray(tension, float)
    if e.ndim != 1 or e.shape != T.shape or len(e) < 2:
        raise LineSystemError(
            f"line {name}: {e.size} elongations and {T.size} tensions; allowed: the same number of both, at least 2"
        )
    for what, unit, values in (("elongation", "m", e), ("tension", "N", T)):
        falling = np.flatnonzero(~(np.diff(values) > 0))
        if values[0] != 0 or len(falling):
            i = 0 if values[0] != 0 else falling[0] + 1
            raise LineSystemError(
                f"line {name}: its {what} number {i + 1} is {values[i]:g} {unit}; allowed: rising from 0"
            )
    try:
        made = fender_of_points(name, e[-1], e, T)
        return fender_of_points(name, e[-1], e, T, overload=float(made.loading.slope(made.limit)))
    except FenderError as error:
        raise LineSystemError(f"line {error}") from None


def elongation_at(pull, tension):
    """Elongation, m, at which a pull has a given tension, N, at least 0"""
    from scipy.optimize import brentq

    high = pull.limit
    while pull.loading(high) < tension:
        high *= 2
    return float(brentq(lambda e: float(pull.loading(e)) - tension, 0.0, high, xtol=1e-15 * high, rtol=1e-15))


def fill_hawser(row, line, A, B):
    """Fill the row (`catenary.flat_bed.ROW`) of a Hawser between its ends A and B, (3,) m."""
    x, z = float(np.hypot(*(B - A)[:2])), float(B[2] - A[2])
    d = float(np.hypot(x, z))
    e = d - line.length
    row[:] = 0.0
    row[0] = State.SLACK
    if e <= 0.0:
        return
    T, along, c, s = float(line.pull.loading(e)), float(line.pull.loading.slope(e)), x / d, z / d
    across = T / d
    xx, xz, zz = along * c * c + across * s * s, (along - across) * c * s, along * s * s + across * c * c
    row[0], row[1], row[2], row[3], row[4] = State.SUSPENDED, T * c, T * c, -T * s, T * s
    row[6:9] = row[9:12] = xx, -xz, xz
    row[12:15], row[15:18] = (-xz, zz, -zz), (xz, -zz, zz)
