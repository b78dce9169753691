"""Bending of a line: relative rotation of the elements on both sides of a node.

    V = Σ ½ k |c|²,   c = d₊/ℓ₊ − d₋/ℓ₋,   1/k = ½ (ℓ₋/EI₋ + ℓ₊/EI₊),   d = q[j+1] − q[j]

over the inner nodes j.  The ends are hinges, and so is a node beside an element without EI.  With the unstretched ℓ
the forces are linear in the node positions: the tangent is exact and constant, and energy is conserved. The tangent
has one number for each pair of nodes at most two apart, the same for all three coordinates.  A line stretched by ε
bends as if EI were (1 + ε)² times as large. The error of second differences is of second order in ℓ: ω² of mode n of
a hinged beam is too small by the fraction (nπ/N)²/6.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel

# rows of Work.bending, per node: k, N m; 1/ℓ₋ and 1/ℓ₊, 1/m; tangent of nodes one and two apart, see `band`
FLEXURE, BEFORE, AFTER, NEXT, OVERNEXT = range(5)
OF_BENDING = 5


def joints(flexure, length, w):
    """Array `Work.bending` of a System; it has no columns where the System has no bending stiffness"""
    if flexure.size == 0:
        return np.zeros((OF_BENDING, 0))
    bending, n = np.zeros((OF_BENDING, w)), length.size
    bending[FLEXURE, 1:n], bending[BEFORE, 1:n], bending[AFTER, 1:n] = flexure[1:n], 1.0 / length[:-1], 1.0 / length[1:]
    return bending


@kernel(inline=True, counted=False)
def bends(bending):
    """Whether a line has bending stiffness.

    One compiled version of the kernels serves both cases; compiling a second would take twenty seconds.
    """
    return bending.shape[1] > 0


@kernel(counted=False)
def bend(bending, q, r, D, last, cq):
    """Add bending forces to r, and the tangent of these forces to D and `bending`, arrays of `Work`."""
    if bends(bending):
        for j in range(last + 1):
            bending[NEXT, j], bending[OVERNEXT, j] = 0.0, 0.0
        for j in range(1, last):
            k, a, b = bending[FLEXURE, j], bending[BEFORE, j], bending[AFTER, j]
            c = -(a + b)
            for i in range(3):
                moment = k * (b * (q[i, j + 1] - q[i, j]) - a * (q[i, j] - q[i, j - 1]))
                r[i, j - 1] -= a * moment
                r[i, j] -= c * moment
                r[i, j + 1] -= b * moment
                D[4 * i, j - 1] += cq * k * a * a
                D[4 * i, j] += cq * k * c * c
                D[4 * i, j + 1] += cq * k * b * b
            bending[NEXT, j - 1] += cq * k * a * c
            bending[NEXT, j] += cq * k * c * b
            bending[OVERNEXT, j - 1] += cq * k * a * b


@kernel(counted=False)
def bending_energy(flexure, length, q):
    """J"""
    total = 0.0
    if flexure.size > 0:
        for j in range(1, length.size):
            for i in range(3):
                c = (q[i, j + 1] - q[i, j]) / length[j] - (q[i, j] - q[i, j - 1]) / length[j - 1]
                total += 0.5 * flexure[j] * c * c
    return total
