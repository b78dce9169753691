"""Cost of bodies far from each other: seconds of one thread, and memory.

There are q partial waves, and N bodies of s shapes, each of which responds to q/4 combinations of the waves. On 2, 20
and 50 bodies with 32 to 790 waves the cost is within a factor of three of

    frequency    s (4e-4 q + 5e-10 q³) + 1e-4 N² + 4e-10 (Nq/4)³ s,    64 s q² + 48 (Nq/4)² bytes
"""

from ..contour.cost import Cost


def cost(bodies, omega, gravity):
    """`Cost` of `far_bodies.FarBodies` together with the finer bodies of the error estimate, at omega rad/s"""
    return Cost(0.0, *map(sum, zip(*(_alone(one, omega, gravity) for one in (bodies, bodies.finer)), strict=True)))


def _alone(bodies, omega, gravity):
    waves, shapes, count = len(bodies.at(omega, gravity).orders), len(bodies.alone), len(bodies.bodies)
    unknown = count * waves / 4
    each = shapes * (4e-4 * waves + 5e-10 * waves**3) + 1e-4 * count**2 + 4e-10 * unknown**3
    return each, 64 * shapes * waves**2 + 48 * unknown**2
