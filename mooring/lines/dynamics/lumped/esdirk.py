"""Steps of a singly diagonally implicit Runge–Kutta scheme whose size follows from its embedded error estimate.

    v_i = v + h Σ a_ij k_j,   q_i = q + h Σ a_ij v_j,   m k_i = F(q_i, v_i, t + c_i h),   a_11 = 0, a_ii = d

The scheme is stiffly accurate and L-stable: elastic waves shorter than the step die out instead of ringing, and
there is no limit on the step from the length of the elements.  The difference e of the embedded solution is passed
through the iteration matrix, S e* = m (e_q + h d e_v) (Hosea & Shampine 1996), because its raw axial part is not an
error: the elements' stiffness takes it away.  Accepted are steps in which e* changes the tensions at the ends, and
the root mean square of all, by no more than `tolerance` of the largest tension so far, and moves no node by more than
`tolerance` of the control's distance.  Where a line snaps, elements fall slack and are taut again one by one: the
largest of all errors is then that of one element at its kink, which no other feels.
Work and losses are integrated with the weights of the scheme.
"""

from __future__ import annotations

import numpy as np

from bem.kernels.jit import kernel

from .bed import keep_slip
from .block_tridiagonal import substitute
from .books import FRICTION
from .forces import node_forces, stored_energy
from .stage import CONVERGED, add, copy, move, solve_stage, spread, workspace
from .surroundings import fairlead_at, water_at

DONE, FULL, TOO_SHORT = range(3)
NEWTON = 0.02  # of the step's tolerance, left by Newton's method
COLUMNS = 20  # time, fairlead force, anchor force, six works, four energies, least and largest tension, step
SAFETY, LEAST, MOST = 0.8, 0.2, 1.6


def tableau():
    """a (s, s), b − b̂ (s,) and c (s,) of TR-BDF2 (Bank et al. 1985, Hosea & Shampine 1996), order 2 with 3."""
    d, w = 1 - np.sqrt(0.5), np.sqrt(0.125)
    a = np.array([[0, 0, 0], [d, d, 0], [w, w, d]])
    third = np.array([(1 - w) / 3, (3 * w + 1) / 3, d / 3])
    return a, a[-1] - third, a.sum(axis=1)


@kernel()
def record(row, t, step, s, work, energy, a):
    """One line of the history: see COLUMNS."""
    last = a.shape[0] - 1
    row[0] = t
    for i in range(3):
        row[1 + i], row[4 + i] = work.r[last, i], work.r[0, i]
    for i in range(6):
        row[7 + i] = energy[i]
    row[13], row[14], row[15], row[16] = stored_energy(s, work.q, work.v)
    row[17], row[18], row[19] = work.T.min(), work.T.max(), step


@kernel()
def frame(row, x, h, q0, v0, q1, v1):
    """Positions at the share x of a step, by the cubic through both ends and their velocities, into row (n, 3)."""
    y = 1.0 - x
    for j in range(q0.shape[0]):
        for i in range(3):
            start, end = (1 + 2 * x) * q0[j, i] + x * h * v0[j, i], (1 + 2 * y) * q1[j, i] - y * h * v1[j, i]
            row[j, i] = y * y * start + x * x * end


@kernel()
def keep(i, K, V, power, a, v, p):
    """Accelerations, velocities and powers of stage i."""
    copy(K[i], a)
    copy(V[i], v)
    for k in range(p.size):
        power[i, k] = p[k]


@kernel()
def mark(row, stations, T):
    """Tensions at the nodes `stations`: the mean of the elements on both sides."""
    for k in range(stations.size):
        j = stations[k]
        row[k] = 0.5 * (T[max(j - 1, 0)] + T[min(j, T.size - 1)])


@kernel()
def error(s, work, eq, ev, hd):
    """Filtered error of tensions (N) and positions (m), see `spread`, and its element, with the last stage's matrix."""
    last = eq.shape[0] - 1
    for j in range(1, last):
        for i in range(3):
            work.x[j, i] = s.inertia[j] * (eq[j, i] + hd * ev[j, i])
    substitute(work.pivots, work.couplings, work.x, work.x, 1, last - 1)
    return spread(s, work.q, work.x)


@kernel()
def run(s, water, motion, control, scheme, state, until, rows, frame_times, frames, stations, station_rows):
    """Step from `state` to `until`; fills rows and frames.

    returns : why it stopped, rows used, frames used, time, step, rejected steps, Newton steps, element at fault
    """
    A, db, c = scheme
    stages, n = c.size, state.position.shape[0]
    d, last = A[1, 1], n - 1
    q, v, a, slip = state.position, state.velocity, state.acceleration, state.slip
    work = workspace(n)
    K, V, power = np.zeros((stages, n, 3)), np.zeros((stages, n, 3)), np.zeros((stages, 6))
    qh, vh, eq, ev, none = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3))
    energy, used, drawn = rows[0, 7:13].copy(), 1, 0
    t, h, rejected, iterations, worst = state.time, min(state.step, control.longest), 0, 0, 0
    copy(work.q, q)
    copy(work.v, v)
    water_at(water, q, t, work.u, work.du)
    node_forces(s, work, a, slip, q, 0.0, 0.0)
    record(rows[0], t, h, s, work, energy, a)
    mark(station_rows[0], stations, work.T)
    keep(0, K, V, power, a, v, work.power)
    scale, again = max(control.tension, work.T.max()), False
    while t < until * (1 - 1e-14) - 1e-14:
        if used == rows.shape[0]:
            return FULL, used, drawn, t, h, rejected, iterations, worst
        remaining = until - t
        step = remaining if h >= remaining else (0.5 * remaining if 2 * h > remaining else h)
        cq, cv, good, moved, stretched = (step * d) ** 2, step * d, True, np.inf, np.inf
        for i in range(1, stages):
            now = t + c[i] * step
            copy(qh, q)
            copy(vh, v)
            for j in range(i):
                add(vh, step * A[i, j], K[j])
                add(qh, step * A[i, j], V[j])
            add(qh, cv, vh)
            copy(K[i], K[i - 1])
            fairlead_at(motion, now, qh[last], vh[last], K[i, last])
            # the water is taken where the nodes are expected: an error of order h³
            copy(work.q, qh)
            move(work.q, work.v, K[i], cq, cv)
            water_at(water, work.q, now, work.u, work.du)
            limit = NEWTON * control.tolerance
            status, worst, count = solve_stage(
                s, work, qh, vh, K[i], slip, q, cq, cv, limit * scale, limit * control.distance
            )
            iterations += count
            if status != CONVERGED:
                good = False
                break
            keep(i, K, V, power, K[i], work.v, work.power)
        if good:
            copy(eq, none)
            copy(ev, none)
            for j in range(stages):
                add(ev, step * db[j], K[j])
                add(eq, step * db[j], V[j])
            largest = max(scale, work.T.max())
            stretched, moved, worst = error(s, work, eq, ev, cv)
            size = max(stretched / (control.tolerance * largest), moved / (control.tolerance * control.distance))
            factor_h = min(MOST, max(LEAST, SAFETY * size ** (-1.0 / 3.0))) if size > 0 else MOST
        else:
            size, factor_h = np.inf, 0.25
        if not size <= 1.0:
            rejected, again = rejected + 1, True
            h = step * factor_h
            if h < control.shortest:
                return TOO_SHORT, used, drawn, t, h, rejected, iterations, worst
            continue
        scale = largest
        for j in range(stages):
            for i in range(FRICTION):
                energy[i] += step * A[stages - 1, j] * power[j, i]
        while drawn < frame_times.size and frame_times[drawn] <= t + step:
            frame(frames[drawn], (frame_times[drawn] - t) / step, step, q, v, work.q, work.v)
            drawn += 1
        energy[FRICTION] += keep_slip(s, work.q, work.v, slip, q, v)
        t = until if step == remaining else t + step
        copy(q, work.q)
        copy(v, work.v)
        copy(a, K[stages - 1])
        record(rows[used], t, step, s, work, energy, a)
        mark(station_rows[used], stations, work.T)
        used += 1
        keep(0, K, V, power, a, v, work.power)
        if again:  # what has just been refused would be again
            factor_h, again = min(factor_h, 1.0), False
        h = max(h, step * factor_h) if step < h else step * factor_h
        h = min(h, control.longest)
    return DONE, used, drawn, t, h, rejected, iterations, worst
