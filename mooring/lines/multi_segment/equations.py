"""Kernels for the residuals of a line's equilibrium, and their exact derivatives.

The contacts with the bed, found by `traverse` as a list of steps, determine the equations. A span ends on a facet,
at a bed vertex or at the anchor. A floating buoy lies in the surface. At a vertex where the line slides into a heap,
its tension is zero or a sinker lies there. The line ends at the anchor with no excess length. The unknowns are, in
this order: H and V at the fairlead; the place, angle or normal force with which each span begins; s at bed vertices;
the length of a heap above a vertex; and the weights of floating buoys. The last two columns of the derivatives are
the derivatives by x and z of the fairlead.
"""

import math
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .free_span import free_step, free_table_row, level_in_sea, tangent_beyond
from .friction import bend_at_vertex, leave_bed, place_on_vertex, slides_down
from .line_data import (
    DERIVATIVE_ROWS,
    EMERGED,
    END,
    FLOATING,
    HEAP_AT_ANCHOR,
    HEAP_AT_TOUCHDOWN,
    LENGTH,
    NOTHING,
    STATE_ROWS,
    H,
    S,
    T,
    V,
    X,
    Z,
    mix,
    next_stop,
    record,
)
from .on_bed import leave_heap, march_on_facet, pass_grounded_sinker, put_on_facet, touch_down
from .touchdown import (
    BEND,
    GROUNDED_ANCHOR,
    HEAP_AT_VERTEX,
    OFF_FACET,
    OFF_SINKER,
    OFF_VERTEX,
    TO_ANCHOR,
    TO_FACET,
    TO_SINKER,
    TO_VERTEX,
)

CORNER = 1e-12  # distance within which a sinker is at a vertex, over the length


class Equations(NamedTuple):
    """n equations: u (n,) unknowns, r (n,) residuals, J (n, n+2) derivatives, states of the point loads.

    done : equations written, next unknown of a step, next unknown of a floating buoy
    q, g, at : state of the traversal, see `line_data`
    """

    u: np.ndarray
    r: np.ndarray
    J: np.ndarray
    states: np.ndarray
    done: np.ndarray
    q: np.ndarray
    g: np.ndarray
    at: np.ndarray


@kernel()
def empty_equations(n, states):
    done, at = np.zeros(3, np.int64), np.zeros(3, np.int64)
    q, g = np.zeros(STATE_ROWS), np.zeros((DERIVATIVE_ROWS, n + 2))
    return Equations(np.zeros(n), np.zeros(n), np.zeros((n, n + 2)), states, done, q, g, at)


@kernel()
def write_equation(e, value, a, i, b, j):
    """Append the equation value = 0 with the derivatives a g[i] + b g[j]; surplus equations are counted."""
    row = e.done[0]
    e.done[0] += 1
    if row >= e.r.size:
        return
    e.r[row] = value
    for k in range(e.g.shape[1]):
        e.J[row, k] = a * e.g[i, k] + b * e.g[j, k]


@kernel()
def next_unknown(e):
    """Index of the next unknown of a step; the last one is repeated for a trial with more steps than unknowns."""
    e.done[1] += 1
    return min(e.done[1], e.u.size) - 1


@kernel()
def pass_load(line, e):
    """Pass a point load on a free span; a floating buoy adds its weight as an unknown and the equation z = surface."""
    load = e.at[1]
    if e.states[load] == FLOATING:
        above = level_in_sea(line, e.q) - line.surface
        write_equation(e, above, 1.0, Z, -tangent_beyond(line, e.q), X)
        unknown = min(e.done[2], e.u.size - 1)
        e.q[V] -= e.u[unknown]
        e.g[V, unknown] -= 1.0
        e.done[2] += 1
    else:
        e.q[V] -= line.loads[load, 2 if e.states[load] == EMERGED else 1]
    e.at[1] -= 1


@kernel()
def march_span(line, e, facet, load, target, unknown, rows):
    """Integrate down a free span to s = target; if target is nan, to where the span is parallel to a facet.

    load : index of the next point load at the end, or of the sinker at which the line's slope passes the facet's slope
    unknown : index of the unknown that is the target, below 0 for none
    """
    q, g, at = e.q, e.g, e.at
    to_facet = math.isnan(target)
    tan = math.tan(line.bed[facet, 2]) if to_facet else 0.0
    mix(g, END, 0.0, S, 0.0, S)
    if unknown >= 0:
        g[END, unknown] = 1.0
    for _ in range(rows.shape[0]):  # a bounded number of rounds, for a trial with NaN
        weight = line.segments[at[0], 1]
        row, ds = free_table_row(line, q, at[0])
        stop, is_load = next_stop(line, at)
        to_stop = q[S] - stop <= ds
        if to_stop:
            ds = q[S] - stop
        last = q[S] - target
        if to_facet:
            last = (q[V] - q[H] * tan) / weight if at[1] == load else math.inf
        ends = last < ds or (not to_facet and last == ds and not is_load)
        if ends and to_facet:
            mix(g, LENGTH, 1 / weight, V, -tan / weight, H)
        elif ends:
            mix(g, LENGTH, 1.0, S, -1.0, END)
        else:
            mix(g, LENGTH, 1.0 if to_stop else 0.0, S, 0.0, S)
        if ends:
            ds = last
        record(rows, at, q, ds, 0.0, weight, row, 0.0, False, line.strain_table)
        free_step(q, g, ds, weight, line.strain_table[row, 1], line.strain_table[row, 2])
        if ends:
            return
        if to_stop:
            q[S] = stop
            if not is_load and at[0] == 0:  # a trial without numbers
                return
            if not is_load:
                at[0] -= 1
            elif to_facet and at[1] == load and line.loads[load, 1] > 0:
                return
            else:
                pass_load(line, e)


@kernel()
def span_step(line, e, step, index, load, next_step, slack, rows):
    """A free span and the equations at its end; if a slack line ends there, only the height and H count."""
    q, g = e.q, e.g
    target, unknown = math.nan, NOTHING
    if step == TO_VERTEX:
        unknown = next_unknown(e)
        target = e.u[unknown]
    elif step == TO_ANCHOR:
        target = 0.0
    march_span(line, e, index, load, target, unknown, rows)
    if step == TO_FACET:
        tan = math.tan(line.bed[index, 2])
        write_equation(e, q[Z] - line.bed[index, 1] - (q[X] - line.bed[index, 0]) * tan, 1.0, Z, -tan, X)
        if next_step == OFF_SINKER:
            put_on_facet(line, q, g, index)
        else:
            touch_down(line, q, g, e.at, index)
        return
    if step == TO_ANCHOR and slack:
        tan = 0.0 if line.no_bed else math.tan(line.bed[0, 2])
        write_equation(e, q[Z] - line.bed[0, 1] - (q[X] - line.bed[0, 0]) * tan, 1.0, Z, -tan, X)
        return
    vertex = 0 if step == TO_ANCHOR else index
    write_equation(e, q[X] - line.bed[vertex, 0], 1.0, X, 0.0, X)
    write_equation(e, q[Z] - line.bed[vertex, 1], 1.0, Z, 0.0, Z)
    place_on_vertex(line, q, g, vertex)


@kernel()
def step_on_bed(line, e, step, index, load, rows):
    """A step that starts on the bed."""
    q, g = e.q, e.g
    amount, unknown, last_load = math.inf, NOTHING, NOTHING
    if step == HEAP_AT_VERTEX:
        unknown = next_unknown(e)
        if load >= 0:
            write_equation(e, q[S] - line.loads[load, 0], 1.0, S, 0.0, S)
            # the piece between the sinker and the vertex is rounding and has no tension
            last = min(e.at[2], rows.shape[0]) - 1
            if last >= 0 and rows[last, 2] <= CORNER * line.length:
                rows[last, 5], rows[last, 6] = 0.0, 0.0
        else:
            write_equation(e, q[T] / line.weight * line.length, line.length / line.weight, T, 0.0, T)
        q[T] = 0.0
        mix(g, T, 0.0, T, 0.0, T)
        leave_heap(line, q, g, e.at, e.u[unknown], 0.0, unknown, rows)
        return
    if step == OFF_FACET or step == OFF_VERTEX or step == OFF_SINKER:  # noqa: SIM109
        unknown = next_unknown(e)
        amount = e.u[unknown]
    if step == OFF_SINKER:
        if e.at[1] < 0:  # a trial in which the heap includes the sinker: no solution
            e.done[0] += e.u.size + 1
            return
        pass_grounded_sinker(line, q, g, e.at, index, amount, unknown)
        return
    if step == BEND or step == OFF_VERTEX:  # noqa: SIM109
        if step == BEND:
            amount = line.bed[index - 1, 2]
        bend_at_vertex(line, q, g, amount, unknown)
    else:
        if step == TO_SINKER:
            last_load = load
        # place beyond the anchor, where a buoy has lifted part of the heap
        if index == 0 and (step == TO_SINKER or q[X] <= line.bed[0, 0] or slides_down(line, e.at, 0, q[T])):
            amount = amount if step == OFF_FACET else q[S]
        march_on_facet(line, q, g, e.at, index, amount, unknown, last_load, rows)
        if math.isinf(amount) and step != TO_SINKER:
            q[X], q[Z] = line.bed[index, 0], line.bed[index, 1]
            mix(g, X, 0.0, X, 0.0, X)
            mix(g, Z, 0.0, Z, 0.0, Z)
    if step == OFF_FACET or step == OFF_VERTEX or step == TO_SINKER:  # noqa: SIM109
        leave_bed(line, q, g)


@kernel()
def start_equations(line, e, x, z, left):
    """Set the state to that at the fairlead."""
    q, g, n = e.q, e.g, e.u.size
    for i in range(g.shape[0]):
        mix(g, i, 0.0, i, 0.0, i)
    q[H], q[V], q[X], q[Z], q[S] = line.least if left == HEAP_AT_TOUCHDOWN else e.u[0], e.u[1], x, z, line.length
    g[H, 0], g[V, 1], g[X, n], g[Z, n + 1] = 0.0 if left == HEAP_AT_TOUCHDOWN else 1.0, 1.0, 1.0, 1.0
    e.at[0], e.at[1], e.at[2] = line.segments.shape[0] - 1, line.loads.shape[0] - 1, 0
    e.done[0], e.done[1], e.done[2] = 0, 2, n
    for load in range(e.states.size):
        if e.states[load] == FLOATING:
            e.done[2] -= 1


@kernel()
def equations(line, e, x, z, steps, left, rows):
    """Residuals of the steps (k, 3) with the fairlead at (x, z), and their derivatives; the state is left at the
    anchor.

    left : excess length of the line. With a heap at the anchor, H at its lower limit replaces the last equation.
        With a heap where the line touches the bed, the length of the heap is the first unknown, in place of H
    rows : pieces are stored there, see `record`
    """
    start_equations(line, e, x, z, left)
    last, slides = steps.shape[0] - 1, False
    for i in range(last + 1):
        step, index, load = steps[i, 0], steps[i, 1], steps[i, 2]
        if step <= TO_ANCHOR:
            span_step(line, e, step, index, load, steps[min(i + 1, last), 0], left == HEAP_AT_ANCHOR, rows)
            if i == 0 and left == HEAP_AT_TOUCHDOWN:
                leave_heap(line, e.q, e.g, e.at, e.u[0], line.bed[index, 2] if step == TO_FACET else 0.0, 0, rows)
        else:
            slides = step == GROUNDED_ANCHOR and slides_down(line, e.at, 0, e.q[T])
            step_on_bed(line, e, step, index, load, rows)
    if steps[last, 0] > TO_ANCHOR:
        if slides:
            write_equation(e, e.q[X] - line.bed[0, 0], 1.0, X, 0.0, X)
        else:
            write_equation(e, e.q[S], 1.0, S, 0.0, S)
        leave_bed(line, e.q, e.g)
    if left == HEAP_AT_ANCHOR:
        row = e.u.size - 1
        e.done[0] += 1 if steps[last, 0] <= TO_ANCHOR else 0
        e.r[row] = 0.0
        for k in range(e.J.shape[1]):
            e.J[row, k] = 1.0 if k == 0 else 0.0
    if e.done[0] != e.u.size:
        e.r[0] = math.inf
