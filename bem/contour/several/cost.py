"""Cost of several bodies by the contour method: seconds of one thread, and memory.

The formulas are right within a factor of two on two boxes 1 and 4 m apart, with 430 to 1 300 nodes. N and N' are the
numbers of nodes around all plans for the table and for the waves, n is the number of functions, and c the number of
values of κ in the table at which the plans interact

    table        c (1.1e-7 N² + 3e-11 N³) s,  16 c n² bytes      frequency    4e-7 N'² + 4e-10 N'³ s,  150 N'² bytes
"""

from ..cost import Cost


def cost(bodies, k):
    """`Cost` of `SeveralBodies` together with the finer bodies of the error estimate, for waves of up to k rad/m"""
    return Cost(*map(sum, zip(*(_alone(one, k) for one in (bodies, bodies.finer)), strict=True)))


def _alone(bodies, k):
    degrees, tops = bodies.degrees(k)
    table = bodies.exterior(0.0, tops)
    N, M, n = float(table.size), float(bodies.exterior(k, degrees).size), float(table.basis.shape[1])
    seconds = bodies.coupled(tops) * (1.1e-7 * N**2 + 3e-11 * N**3), 4e-7 * M**2 + 4e-10 * M**3
    return *seconds, 16 * len(bodies.nodes(tops).kappa) * n**2 + 150 * max(M, N) ** 2
