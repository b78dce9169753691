"""One implicit stage: accelerations a with  m a = F(q̂ + c_q a, v̂ + c_v a, t),  by Newton's method.

Every implicit scheme of second-order equations has this form; it differs by q̂, v̂, c_q and c_v only.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from .block_tridiagonal import factor, substitute
from .forces import node_forces

ITERATIONS = 12
CONVERGED, NOT_FINITE, STALLED = range(3)


class Work(NamedTuple):
    """Arrays used over and over; n nodes."""

    q: np.ndarray  # (n, 3)
    v: np.ndarray
    r: np.ndarray
    x: np.ndarray
    u: np.ndarray
    du: np.ndarray
    D: np.ndarray  # (n, 3, 3)
    B: np.ndarray  # (n, 3, 3)
    T: np.ndarray  # (n − 1,)
    tangent: np.ndarray  # (n − 1, 3)
    power: np.ndarray  # (6,)
    pivots: np.ndarray  # (n, 3, 3) of the last tangent that was factored
    couplings: np.ndarray  # (n, 3, 3)


@kernel()
def workspace(n):
    """Work for n nodes."""
    return Work(
        np.zeros((n, 3)),
        np.zeros((n, 3)),
        np.zeros((n, 3)),
        np.zeros((n, 3)),
        np.zeros((n, 3)),
        np.zeros((n, 3)),
        np.zeros((n, 3, 3)),
        np.zeros((n, 3, 3)),
        np.zeros(n - 1),
        np.zeros((n - 1, 3)),
        np.zeros(6),
        np.zeros((n, 3, 3)),
        np.zeros((n, 3, 3)),
    )


@kernel()
def copy(y, x):
    """y = x for (n, 3) arrays: a loop compiles in a fraction of the time of the array expression, as does `add`."""
    for j in range(y.shape[0]):
        for i in range(3):
            y[j, i] = x[j, i]


@kernel()
def add(y, f, x):
    """y += f x for (n, 3) arrays."""
    for j in range(y.shape[0]):
        for i in range(3):
            y[j, i] += f * x[j, i]


@kernel(inline=True)
def element_change(s, q, x, scale, e):
    """Change of the tension of element e (N) and of the position of its upper node (m) by displacements ± scale · x.

    A slack element has no tension to change until it is taut.
    """
    axial, length, moved = 0.0, 0.0, 0.0
    for i in range(3):
        d = q[e + 1, i] - q[e, i]
        axial += d * (x[e + 1, i] - x[e, i])
        length += d * d
        moved += x[e + 1, i] ** 2
    length = math.sqrt(length)
    slack = max(0.0, s.length[e] - length)
    tension = s.stiffness[e] / s.length[e] * max(0.0, abs(axial) * scale / length - slack)
    return tension, scale * math.sqrt(moved)


@kernel()
def change(s, q, x, scale):
    """Largest change of any element's tension (N) and of any node's position (m), and the element of the one."""
    tension, distance, worst = 0.0, 0.0, 0
    for e in range(s.length.size):
        here, moved = element_change(s, q, x, scale, e)
        if not here <= tension:
            tension, worst = here, e
        distance = max(distance, moved)
    return tension, distance, worst


@kernel()
def spread(s, q, x):
    """The same with the change of tension at either end, or the root mean square of all where that is larger."""
    total, ends, distance, largest, worst, last = 0.0, 0.0, 0.0, 0.0, 0, s.length.size - 1
    for e in range(last + 1):
        here, moved = element_change(s, q, x, 1.0, e)
        total += here * here
        if not here <= largest:
            largest, worst = here, e
        if e == 0 or e == last:
            ends = max(ends, here)
        distance = max(distance, moved)
    mean = math.sqrt(total / (last + 1))
    return ends if mean <= ends else mean, distance, worst  # nan stays


@kernel()
def solve_stage(s, work, guess_q, guess_v, a, slip, since, cq, cv, tension_limit, distance_limit):
    """Accelerations of the inner nodes, into a; leaves positions, velocities, forces and powers in `work`.

    guess_q, guess_v : q̂ and v̂ (n, 3), with the end nodes where they are; a : guess, with those of the end nodes
    returns : status, the node at fault, Newton steps
    """
    before = np.inf
    q, v = work.q, work.v
    copy(q, guess_q)
    copy(v, guess_v)
    move(q, v, a, cq, cv)
    node_forces(s, work, a, slip, since, cq, cv)
    for iteration in range(ITERATIONS):
        refactor(work)
        tension, distance, worst = correction(s, work, cq)
        if not (math.isfinite(tension) and math.isfinite(distance)):
            return NOT_FINITE, worst, iteration + 1
        move(a, a, work.x, 1.0, 0.0)
        move(q, v, work.x, cq, cv)
        node_forces(s, work, a, slip, since, cq, cv)
        if tension <= tension_limit and distance <= distance_limit:
            return CONVERGED, worst, iteration + 1
        # what is left of the equations, by the matrix at hand, shows whether another one is needed
        left, astray, _ = correction(s, work, cq)
        if left <= tension_limit and astray <= distance_limit:
            return CONVERGED, worst, iteration + 1
        size = max(tension / tension_limit, distance / distance_limit)
        if iteration > 3 and size > 2.0 * before:
            return STALLED, worst, iteration + 1
        before = size
    return STALLED, worst, ITERATIONS


@kernel()
def refactor(work):
    """Pivots and couplings of the tangent at hand, which `node_forces` overwrites"""
    for j in range(work.D.shape[0]):
        for i in range(3):
            for m in range(3):
                work.pivots[j, i, m] = work.D[j, i, m]
                work.couplings[j, i, m] = work.B[j, i, m]
    factor(work.pivots, work.couplings, 1, work.D.shape[0] - 2)


@kernel()
def correction(s, work, cq):
    """Accelerations that take away the residual, into work.x, and the largest change of tension and place by them."""
    copy(work.x, work.r)
    substitute(work.pivots, work.couplings, work.x, work.x, 1, work.x.shape[0] - 2)
    for i in range(3):
        work.x[0, i], work.x[-1, i] = 0.0, 0.0
    return change(s, work.q, work.x, cq)


@kernel()
def move(q, v, a, cq, cv):
    """Add c_q a and c_v a to the inner nodes."""
    for j in range(1, q.shape[0] - 1):
        for i in range(3):
            q[j, i] += cq * a[j, i]
            v[j, i] += cv * a[j, i]
