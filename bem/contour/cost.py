"""Cost of the contour method: seconds of one thread, and memory.

The formulas are right within a factor of two on 6 boxes (L/B 3 … 10 000, 2 to 100 waves along them). p is the sum of
the highest degrees on end and side in the table, p' the sum of the highest degrees for the waves, c the number of
values of κ in the table

    table        4e-9 c p³ s,  65 c p² bytes           frequency    2e-8 p'³ s,  1000 p'² bytes
"""

from typing import NamedTuple

from .one_frequency import degrees
from .plan.rectangle import Rectangle

TABLE, FREQUENCY = (4e-9, 65.0), (2e-8, 1000.0)  # s, bytes
CIRCLE = 8e-8  # s


class Cost(NamedTuple):
    """table : time before the first frequency, s; each : time of one frequency, s; memory : bytes"""

    table: float
    each: float
    memory: float


def cost(body, k):
    """`Cost` of a `ContourBody` together with the finer body of the error estimate, for waves of up to k rad/m.

    A circle needs no table; the body and the finer body together take 8e-8 (ka)³ s within a factor of two, for ka of
    280 … 1100.
    """
    if not isinstance(body.plan, Rectangle):
        return Cost(0.0, CIRCLE * (k * body.plan.radius) ** 3, 0.0)
    return Cost(*map(sum, zip(*(_alone(one, k) for one in (body, body.finer)), strict=True)))


def _alone(body, k):
    waves, table = degrees(body, k)
    count, p, q = len(body.nodes(table).kappa), float(sum(table)), float(sum(waves))
    return TABLE[0] * count * p * p * p, FREQUENCY[0] * q * q * q, TABLE[1] * count * p * p + FREQUENCY[1] * q * q
