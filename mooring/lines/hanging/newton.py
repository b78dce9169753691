"""Kernels that solve the equations of a walk together, by Newton's method with exact derivatives.

The steps found by `walk` fix which equations hold: a span ends on a facet, at a knuckle or at the anchor, a floating
buoy lies in the surface, and the anchor is reached with no length left over.  The unknowns are H and V at the fairlead,
the lengths and angles with which spans end and begin, and the lift of floating buoys.  The same derivatives with
respect to the fairlead's position give the stiffness.
"""

from __future__ import annotations

import math

import numpy as np

from bem.jit import kernel

from .pieces import (
    EMERGED,
    FLOATING,
    H,
    S,
    V,
    X,
    Z,
    crawl,
    free_knot,
    free_step,
    land,
    leave,
    mix,
    next_stop,
    pin,
    record,
    rest_sinker,
    turn_knuckle,
)
from .walk import LIFT, REST, SINKER, SPRING, TO_ANCHOR, TO_FACET, TO_KNUCKLE, TURN, walk

SOLVED, BEYOND_REACH, SLACK, LOST = 0, 1, 2, 3


@kernel()
def solve_small(A, b):
    """A x = b by elimination with pivoting; A (n, n) and b (n, m) are overwritten, b with x.  False where singular."""
    n = A.shape[0]
    for i in range(n):
        best = i
        for j in range(i + 1, n):
            if abs(A[j, i]) > abs(A[best, i]):
                best = j
        if A[best, i] == 0 or not math.isfinite(A[best, i]):
            return False
        if best != i:
            for j in range(n):
                A[i, j], A[best, j] = A[best, j], A[i, j]
            for j in range(b.shape[1]):
                b[i, j], b[best, j] = b[best, j], b[i, j]
        for j in range(i + 1, n):
            share = A[j, i] / A[i, i]
            for k in range(i, n):
                A[j, k] -= share * A[i, k]
            for k in range(b.shape[1]):
                b[j, k] -= share * b[i, k]
    for i in range(n - 1, -1, -1):
        for k in range(b.shape[1]):
            for j in range(i + 1, n):
                b[i, k] -= A[i, j] * b[j, k]
            b[i, k] /= A[i, i]
    return True


@kernel()
def pass_load(line, q, g, at, states, u, r, J, done):
    """Hang a point load on a free span; a floating buoy brings an unknown and the equation of the surface."""
    load = at[1]
    if states[load] == FLOATING:
        write(q[Z] - line.surface, g, 1.0, Z, 0.0, Z, r, J, done)
        q[V] -= u[done[1]]
        g[V, done[1]] -= 1.0
        done[1] += 1
    else:
        q[V] -= line.load_dry[load] if states[load] == EMERGED else line.load_wet[load]
    at[1] -= 1


@kernel()
def write(value, g, a, i, b, j, r, J, done):
    """Write an equation: value = 0 with the derivatives a g[i] + b g[j]."""
    r[done[0]] = value
    for k in range(g.shape[1]):
        J[done[0], k] = a * g[i, k] + b * g[j, k]
    done[0] += 1


@kernel()
def span(line, q, g, at, states, u, r, J, done, facet, load, amount, unknown, rows):
    """Go down a free span: by a length, or, where that is infinite, until it is parallel to a facet.

    load : the point load that is next when that happens, or that makes it happen, if it is a sinker
    unknown : which unknown the length is, below 0 for none; done : equations written, next unknown of a floating buoy
    """
    to_facet = math.isinf(amount)
    tan = math.tan(line.bed_angle[facet]) if to_facet else 0.0
    target = q[S] - amount
    gds, g_target = np.zeros(g.shape[1]), np.zeros(g.shape[1])
    if unknown >= 0:
        for i in range(g.shape[1]):
            g_target[i] = g[S, i] - (1.0 if i == unknown else 0.0)
    for _ in range(10_000):
        weight = line.weight[at[0]]
        row, ds = free_knot(line, q, at[0])
        factor, flexibility = line.knot_factor[row], line.knot_flexibility[row]
        stop, is_load = next_stop(line, at)
        why = 0
        if q[S] - stop <= ds:
            ds, why = q[S] - stop, 1
        last = q[S] - target
        if to_facet:
            last = (q[V] - q[H] * tan) / weight if at[1] == load else math.inf
        if last < ds or (not to_facet and last == ds and not is_load):
            ds, why = last, 2
        for i in range(g.shape[1]):
            gds[i] = 0.0
            if why == 1:
                gds[i] = g[S, i]
            elif why == 2:
                gds[i] = (g[V, i] - tan * g[H, i]) / weight if to_facet else g[S, i] - g_target[i]
        record(rows, at, 0.0, q, ds, 0.0, weight, factor, flexibility, 0.0)
        free_step(q, g, ds, gds, weight, factor, flexibility)
        if why == 2:
            return
        if why == 1:
            q[S] = stop
            if not is_load:
                at[0] -= 1
            elif to_facet and at[1] == load and line.load_wet[load] > 0:
                return
            else:
                pass_load(line, q, g, at, states, u, r, J, done)


@kernel()
def equations(line, x, z, steps, states, u, slack, r, J, rows, at_anchor):
    """Residuals r (n,) of a walk and their derivatives J (n, n+2) with respect to u, x and z.

    rows : room for the pieces, see `pieces.record`; at_anchor : (3,) H, V and s there.  returns : rows recorded
    """
    n = u.size
    q, g = np.zeros(7), np.zeros((7, n + 2))
    at = np.array([line.weight.size - 1, line.load_s.size - 1, 0])
    done = np.array([0, n])
    for load in range(states.size):
        if states[load] == FLOATING:
            done[1] -= 1
    q[H], q[V], q[X], q[Z], q[S] = u[0], u[1], x, z, line.joint[-1]
    g[H, 0], g[V, 1], g[X, n], g[Z, n + 1] = 1.0, 1.0, 1.0, 1.0
    known, on_bed = 2, False
    for i in range(steps.shape[0]):
        step, index = steps[i, 0], steps[i, 1]
        if step <= TO_ANCHOR:
            amount, unknown = math.inf, -1
            if step == TO_KNUCKLE:
                amount, unknown, known = u[known], known, known + 1
            elif step == TO_ANCHOR:
                amount = q[S]
            span(line, q, g, at, states, u, r, J, done, index, steps[i, 2], amount, unknown, rows)
            on_bed = step == TO_FACET
            if on_bed:
                tan = math.tan(line.bed_angle[index])
                gap = q[Z] - line.bed_z[index] - (q[X] - line.bed_x[index]) * tan
                write(gap, g, 1.0, Z, -tan, X, r, J, done)
                if i + 1 == steps.shape[0] or steps[i + 1, 0] != SINKER:
                    land(line, q, g, at, index)
            else:
                write(q[X] - line.bed_x[index], g, 1.0, X, 0.0, X, r, J, done)
                write(q[Z] - line.bed_z[index], g, 1.0, Z, 0.0, Z, r, J, done)
                pin(line, q, g, index)
        elif step == SINKER:
            rest_sinker(line, q, g, at, index, u[known], known)
            known, on_bed = known + 1, False
        elif step == TURN or step == SPRING:  # noqa: SIM109
            unknown, angle = -1, line.bed_angle[index - 1]
            if step == SPRING:
                angle, unknown, known = u[known], known, known + 1
            turn_knuckle(line, q, g, angle, unknown)
        else:
            amount, unknown = math.inf, -1
            if step == LIFT:
                amount, unknown, known = u[known], known, known + 1
            crawl(line, q, g, at, index, amount, unknown, rows)
            on_bed = True
            if step != LIFT:
                q[X], q[Z] = line.bed_x[index], line.bed_z[index]
                mix(g, X, 0.0, X, 0.0, X)
                mix(g, Z, 0.0, Z, 0.0, Z)
        if step == LIFT or step == SPRING:  # noqa: SIM109
            leave(line, q, g)
            on_bed = False
    if on_bed:
        write(q[S], g, 1.0, S, 0.0, S, r, J, done)
        if slack:
            r[n - 1] = 0.0
            for k in range(n + 2):
                J[n - 1, k] = 1.0 if k == 0 else 0.0
        leave(line, q, g)
    at_anchor[0], at_anchor[1], at_anchor[2] = q[H], q[V], q[S]
    return at[2]


@kernel()
def polish(line, x, z, steps, states, u, slack, rows, at_anchor, stiffness):
    """Newton's method from the start u, which is overwritten.  returns : residual over the length, rows recorded"""
    n = u.size
    r, J = np.empty(n), np.empty((n, n + 2))
    trial_r, trial_J = np.empty(n), np.empty((n, n + 2))
    length = line.joint[-1]
    count = equations(line, x, z, steps, states, u, slack, r, J, rows, at_anchor)
    size = np.abs(r).max()
    for _ in range(40):
        A, b = J[:, :n].copy(), r.copy().reshape(n, 1)
        if not solve_small(A, b):
            return math.inf, count
        step = b[:, 0]
        share = min(1.0, 0.7 * u[0] / step[0]) if step[0] > 0 else 1.0
        better = False
        for _ in range(12):
            trial = u - share * step
            count = equations(line, x, z, steps, states, trial, slack, trial_r, trial_J, rows, at_anchor)
            new = np.abs(trial_r).max()
            if new < size or (new <= 1e-14 * length and share == 1.0):
                better = True
                break
            share *= 0.5
        if not better:
            break
        settled = size <= 1e-13 * length and new >= 0.5 * size
        u[:] = trial
        r[:] = trial_r
        J[:] = trial_J
        size = new
        if settled or new == 0:
            break
    count = equations(line, x, z, steps, states, u, slack, r, J, rows, at_anchor)
    A, b = J[:, :n].copy(), J[:, n:].copy()
    if not solve_small(A, b):
        return math.inf, count
    stiffness[:] = -b[:2]
    return np.abs(r).max() / length, count


@kernel()
def horizontal_pull(line, x, z, guess, tolerance, steps, unknowns, states):
    """H at which nothing is left over, bracketed on ln H.  returns : H, what `walk` returned there, state"""
    length, least = line.joint[-1], line.least
    found = walk(line, least, x, z, steps, unknowns, states)
    if found[2] > 0:
        return least, found, SLACK
    low, high, H_now = math.log(least), math.inf, guess
    f_low, f_high, side = found[2], math.nan, 0
    q = math.log(guess)
    for trial in range(200):
        H_now = math.exp(q)
        found = walk(line, H_now, x, z, steps, unknowns, states)
        value = found[2]
        if abs(value) <= tolerance * length:
            return H_now, found, SOLVED
        if value > 0:
            high, f_high = q, value
            f_low = 0.5 * f_low if side == 1 else f_low
            side = 1
        else:
            low, f_low = q, value
            f_high = 0.5 * f_high if side == -1 else f_high
            side = -1
        if math.isinf(high):
            q += 2.0
            if q > math.log(guess) + 25:
                return H_now, found, BEYOND_REACH
        elif low == math.log(least):
            # the left-over length moves with ln H only near the root: come down from above
            q -= 2.0 if q - 2.0 > low else 0.5 * (q - low)
        elif trial % 3 == 2 or math.isnan(f_low + f_high):
            q = 0.5 * (low + high)
        else:
            q = low + (high - low) * f_low / (f_low - f_high)
        if high - low <= 1e-15 * max(1.0, abs(q)):
            return H_now, found, SOLVED
    return H_now, found, LOST


@kernel()
def confirmed(line, x, z, u, slack, steps, unknowns, states):
    """Whether a walk with the pull found ends at the anchor too, and starts as Newton's method says."""
    kept = states.copy()
    check = walk(line, u[0], x, z, steps, unknowns, states)
    same = np.all(states == kept) or abs(check[2]) <= line.soft
    states[:] = kept
    close = abs(check[2]) <= 1e-7 * line.joint[-1] + line.soft or slack
    return same and close and abs(check[3] - u[1]) <= 1e-5 * (abs(u[1]) + u[0])


@kernel()
def solve_position(line, x, z, guess, rows, stiffness, at_anchor, states, steps, last, before):
    """One line at one position; see `solve_positions`.

    The equations of the position before are tried first.  Where they do not hold, the walk is made coarsely, its
    equations are solved exactly, and a walk with the H found must end at the anchor too; else the walk is made finer.
    steps, last, before : steps and unknowns of the position before, and how many.
    returns : H, V, rows recorded, state, residual
    """
    room = steps.shape[0]
    trial, unknowns = np.empty((room, 3), np.int64), np.empty(room)
    tolerance, pull, top = 1e-3, guess, 0.0
    for attempt in range(6):
        if attempt == 0:
            if before[0] == 0:
                continue
            u, slack = last[: before[1]].copy(), False
        else:
            pull, found, state = horizontal_pull(line, x, z, guess, tolerance, trial, unknowns, states)
            if state in (BEYOND_REACH, LOST) or found[0] == 0:
                return pull, found[3], 0, BEYOND_REACH if state == BEYOND_REACH else LOST, math.inf
            u = start_values(line, unknowns[: found[1]], states)
            steps[:] = trial
            before[0], before[1] = found[0], u.size
            slack = state == SLACK and steps[found[0] - 1, 0] == REST
            guess, tolerance = pull, 1e-3 * tolerance
        residual, count = polish(line, x, z, steps[: before[0]], states, u, slack, rows, at_anchor, stiffness)
        top = u[1]
        if residual <= 1e-10 and u[0] > 0 and confirmed(line, x, z, u, slack, trial, unknowns, states):
            last[: u.size] = u
            if slack:
                before[0] = 0
            return u[0], u[1], count, SLACK if slack else SOLVED, residual
    before[0] = 0
    return pull, top, 0, LOST, math.inf


@kernel()
def start_values(line, unknowns, states):
    """Start of all unknowns: those of the walk, then the weights of floating buoys from the fairlead down."""
    floating = np.flatnonzero(states == FLOATING)[::-1]
    middle = 0.5 * (line.load_wet[floating] + line.load_dry[floating])
    return np.concatenate((unknowns, middle))


@kernel()
def solve_positions(line, x, z, guess, rows, result):
    """Positions (n,) one after another; each starts from the solution of the one before.

    rows : (…, 11) the pieces of the last position; result : (n, 12) H, V, H and V at the anchor, s left over,
    stiffness (4), state, residual, rows recorded.  returns : states of the loads in the last position
    """
    stiffness, at_anchor = np.empty((2, 2)), np.empty(3)
    states = np.zeros(line.load_s.size, np.int64)
    room = 8 * line.bed_x.size + 4 * line.load_s.size + 16
    steps, last, before = np.zeros((room, 3), np.int64), np.zeros(room), np.zeros(2, np.int64)
    for i in range(x.size):
        pull, top, count, state, residual = solve_position(
            line, x[i], z[i], guess, rows, stiffness, at_anchor, states, steps, last, before
        )
        result[i, 0], result[i, 1] = pull, top
        result[i, 2], result[i, 3], result[i, 4] = at_anchor
        result[i, 5], result[i, 6] = stiffness[0]
        result[i, 7], result[i, 8] = stiffness[1]
        result[i, 9], result[i, 10], result[i, 11] = state, residual, count
        if state == SOLVED:
            guess = pull
    return states
