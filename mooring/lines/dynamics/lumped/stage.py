"""One implicit stage: accelerations a with  m a = F(q̂ + c_q a, v̂ + c_v a, t),  by Newton's method.

Every implicit scheme for second-order equations has this form; schemes differ only in q̂, v̂, c_q and c_v.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, load_vector, repeated, root, store_vector

from .band import factor_line, substitute_line
from .forces import node_forces
from .vectors import TINY, dot, largest, load_three, minus, more, total
from .workspace import SHORT, STIFFNESS, copy

ITERATIONS = 12
CONVERGED, NOT_FINITE, STALLED = range(3)


@kernel(inline=True, counted=False)
def changes(work, elements, scale):
    """Changes of tension (N) and position (m) due to displacements ± scale · work.x; used by `change` and `spread`.

    The tension of a slack element does not change until the element is taut.
    returns : largest change of tension, its root mean square, and the larger change at an end, N; largest
        change of position, m
    """
    w, q, x, known = work.q.shape[1], address(work.q), address(work.x), address(work.element)
    far, most, squares, changed = repeated(0.0), repeated(0.0), repeated(0.0), address(work.change)
    for e in range(0, elements, WIDTH):
        slot = e + 1
        d, away = minus(load_three(q, w, slot), load_three(q, w, e)), load_three(x, w, slot)
        length, short = root(dot(d, d) + TINY), load_vector(known, SHORT * w + slot)
        axial = dot(d, minus(away, load_three(x, w, e))) * scale / length
        slack = more(1.0 / short - length, repeated(0.0))
        tension = load_vector(known, STIFFNESS * w + slot) * short * more(more(axial, -axial) - slack, repeated(0.0))
        store_vector(changed, slot, tension)
        moved = dot(away, away)
        far, most, squares = more(far, moved), more(most, tension), squares + tension * tension + 0.0 * moved
    ends = max(work.change[1], work.change[elements])
    squared = total(squares)  # nan stays in a sum
    if not math.isfinite(squared):
        return np.nan, np.nan, np.nan, np.nan
    return largest(most), math.sqrt(squared / elements), ends, scale * math.sqrt(largest(far))


@kernel(counted=False)
def worst_element(work, elements):
    """Number of the element whose tension changes most"""
    worst = 0
    for e in range(elements):
        if not work.change[e + 1] <= work.change[worst + 1]:
            worst = e
    return worst


@kernel(counted=False)
def change(work, elements, scale):
    """Largest change of any element's tension (N) and of any node's position (m) by ± scale · work.x"""
    most, _, _, distance = changes(work, elements, scale)
    return most, distance


@kernel(counted=False)
def spread(work, elements):
    """As `change`, but with the change of tension at either end, or with the root mean square of all changes if
    larger.
    """
    _, mean, ends, distance = changes(work, elements, 1.0)
    return ends if mean <= ends else mean, distance  # nan stays


@kernel(counted=False)
def begin_stage(work, q, v, a, last, cq, cv):
    """Positions and velocities of the inner nodes from q̂ and v̂ (3, w) and a guess of a; end nodes are not moved"""
    copy(work.q, q)
    copy(work.v, v)
    for i in range(3):
        for j in range(1, last):
            work.q[i, j] += cq * a[i, j]
            work.v[i, j] += cv * a[i, j]


@kernel(counted=False)
def solve_stage(s, work, a, slip, since, cq, cv, tension_limit, distance_limit):
    """Accelerations of the inner nodes, into a; leaves positions, velocities, forces and powers in `work`.

    a : (3, w), the guess at which the stage began
    returns : status, Newton steps
    """
    before, last = np.inf, s.length.size
    node_forces(s, work, a, slip, since, cq, cv)
    for iteration in range(ITERATIONS):
        factor_line(work.D, work.B, work.bending, work.pivots, last)
        tension, distance = correction(work, last, cq)
        if not (math.isfinite(tension) and math.isfinite(distance)):
            return NOT_FINITE, iteration + 1
        correct(work, a, last, cq, cv)
        node_forces(s, work, a, slip, since, cq, cv)
        if tension <= tension_limit and distance <= distance_limit:
            return CONVERGED, iteration + 1
        # the residual with the present matrix shows whether a new matrix is needed
        left, astray = correction(work, last, cq)
        if left <= tension_limit and astray <= distance_limit:
            return CONVERGED, iteration + 1
        size = max(tension / tension_limit, distance / distance_limit)
        if iteration > 3 and size > 2.0 * before:
            return STALLED, iteration + 1
        before = size
    return STALLED, ITERATIONS


@kernel(counted=False)
def correction(work, last, cq):
    """Accelerations that remove the residual, into work.x; returns the largest changes of tension and position they
    cause.
    """
    substitute_line(work.pivots, work.bending, work.r, work.x, last)
    return change(work, last, cq)


@kernel(counted=False)
def correct(work, a, last, cq, cv):
    """Add work.x to the accelerations of the inner nodes, and the corresponding changes to velocities and
    positions.
    """
    for i in range(3):
        for j in range(1, last):
            x = work.x[i, j]
            a[i, j] += x
            work.v[i, j] += cv * x
            work.q[i, j] += cq * x
