"""Ropes above the water, without weight: main rope and tail in series, T(e) up to the breaking load.

    T/B = h (ε/ε_B)ⁿ in each part, e(T) = L ε(T) + L_t ε_t(T)

B is the breaking load, ε_B the strain at which a new rope breaks, and n the exponent (1: linear; larger for nylon,
which stiffens). h is the hardening by use: a used rope carries the load at a smaller strain, (T/hB).  The pull over
elongation is a `mooring.fenders.fender.Fender` without return.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..fenders.fender import Fender, fender_of_points
from .system.parts import LineSystemError

POINTS = 41


class RopePart(NamedTuple):
    """breaking_load : N; strain : ε_B; exponent : n"""

    breaking_load: float
    strain: float
    exponent: float = 1.0

    def strain_at(self, tension, hardening=1.0):
        """Strain ε at tensions, N, of any shape"""
        return self.strain * (np.asarray(tension, float) / (hardening * self.breaking_load)) ** (1 / self.exponent)


@dataclass(frozen=True, eq=False)
class Rope:
    """pull : tension, N, over elongation, m; length : unstretched length with the tail, m
    breaking_load : breaking load of the weakest part, N

    bollard, fairlead : positions in space with the body at rest, (3,) m
    """

    name: str
    pull: Fender
    length: float
    breaking_load: float
    bollard: np.ndarray
    fairlead: np.ndarray


def rope(name, bollard, fairlead, main, pretension, *, tail=None, tail_length=0.0, hardening=1.0):
    """`Rope` that pulls with `pretension`, N, between two points (3,) m; main, tail : RopePart.

    raises : LineSystemError
    """
    weakest = min(part.breaking_load for part in (main, tail) if part is not None)
    for part in (main, tail):
        if part is not None and not (part.breaking_load > 0 and 0 < part.strain < 2 and 0.2 <= part.exponent <= 5):
            raise LineSystemError(
                f"rope {name} has breaking load {part.breaking_load:g} N, strain {part.strain:g} and exponent "
                f"{part.exponent:g}; allowed: above 0 N, strain 0 to 2, exponent 0.2 to 5"
            )
    if not 0 <= pretension < weakest:
        raise LineSystemError(
            f"rope {name}: its pretension is {pretension / 1e3:.4g} kN; allowed: below its breaking load of "
            f"{weakest / 1e3:.4g} kN"
        )
    if not 0.2 <= hardening <= 20:
        raise LineSystemError(f"rope {name}: its hardening is {hardening:g}; allowed: 0.2 to 20")
    away = float(np.linalg.norm(np.subtract(bollard, fairlead)))
    of_tail = tail.strain_at(pretension, hardening) if tail else 0.0
    length = (away + tail_length * float(main.strain_at(pretension, hardening) - of_tail)) / float(
        1 + main.strain_at(pretension, hardening)
    )
    if (tail is None) != (tail_length == 0) or not 0 <= tail_length < length:
        raise LineSystemError(
            f"rope {name} is {length:.4g} m long and its tail {tail_length:g} m; allowed: a tail shorter than the rope"
        )
    tension = weakest * np.linspace(0.0, 1.0, POINTS) ** 2
    e = (length - tail_length) * main.strain_at(tension, hardening)
    if tail:
        e = e + tail_length * tail.strain_at(tension, hardening)
    slope = float((tension[-1] - tension[-2]) / (e[-1] - e[-2]))
    pull = fender_of_points(name, length, e, tension, overload=slope)
    return Rope(name, pull, length, weakest, np.asarray(bollard, float), np.asarray(fairlead, float))
