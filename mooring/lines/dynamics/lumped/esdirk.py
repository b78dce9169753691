"""Steps of a singly diagonally implicit Runge–Kutta scheme whose size follows from its embedded error estimate. v_i
= v + h Σ a_ij k_j,   q_i = q + h Σ a_ij v_j,   m k_i = F(q_i, v_i, t + c_i h),   a_11 = 0, a_ii = d

The scheme is stiffly accurate and L-stable. Elastic waves shorter than the step are damped instead of ringing, and the
length of the elements does not limit the step.  The difference e of the embedded solution is passed through the
iteration matrix, S e* = m (e_q + h d e_v) (Hosea & Shampine 1996), because its raw axial part is not an error: the
elements' stiffness removes it.  A step is accepted if e* meets two conditions. It changes the end tensions, and the
root mean square of all tensions, by at most `tolerance` of the largest tension so far. It moves no node by more than
`tolerance` of the control's distance. Where a line snaps, elements become slack and taut one by one. The largest
error is then the error of a single element at the corner of its stiffness; no other element is affected. Work and
losses are integrated with the weights of the scheme.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .band import factor_line, substitute_line
from .bed import keep_slip
from .books import FRICTION
from .forces import node_forces, stored_energy
from .stage import CONVERGED, begin_stage, correction, solve_stage, spread, worst_element
from .surroundings import fairlead_at, water_at
from .workspace import INERTIA, STAGES, copy, largest_of, read, workspace, write

DONE, FULL, TOO_SHORT = range(3)
NEWTON = 0.02  # residual of Newton's method, as a share of the step's tolerance
COLUMNS = 20  # time, fairlead force, anchor force, six works, four energies, least and largest tension, step
SAFETY, LEAST, MOST = 0.8, 0.2, 1.6


def tableau():
    """a (s, s), b − b̂ (s,) and c (s,) of TR-BDF2 (Bank et al. 1985, Hosea & Shampine 1996), order 2 with an
    embedded order 3.
    """
    d, w = 1 - np.sqrt(0.5), np.sqrt(0.125)
    a = np.array([[0, 0, 0], [d, d, 0], [w, w, d]])
    third = np.array([(1 - w) / 3, (3 * w + 1) / 3, d / 3])
    made = a, a[-1] - third, a.sum(axis=1)
    for array in made:
        array.flags.writeable = False  # kernels use these as constants; writeable, each kernel would be compiled again
    return made


@kernel(counted=False)
def record(row, t, step, s, work, energy):
    """One line of the history: see COLUMNS."""
    last = s.length.size
    row[0] = t
    for i in range(3):
        row[1 + i], row[4 + i] = work.r[i, last], work.r[i, 0]
    for i in range(6):
        row[7 + i] = energy[i]
    row[13], row[14], row[15], row[16] = stored_energy(s, work.q, work.v)
    least, most = work.T[1], work.T[1]
    for e in range(2, last + 1):
        least, most = min(least, work.T[e]), max(most, work.T[e])
    row[17], row[18], row[19] = least, most, step


@kernel(counted=False)
def frame(row, x, h, q0, v0, q1, v1):
    """Write positions at the fraction x of a step into row (n, 3), from the cubic through positions and velocities at
    both ends."""
    y = 1.0 - x
    for j in range(row.shape[0]):
        for i in range(3):
            start, end = (1 + 2 * x) * q0[i, j] + x * h * v0[i, j], (1 + 2 * y) * q1[i, j] - y * h * v1[i, j]
            row[j, i] = y * y * start + x * x * end


@kernel(counted=False)
def keep(i, K, V, power, a, v, p):
    """Accelerations, velocities and powers of stage i."""
    copy(K[i], a)
    copy(V[i], v)
    for k in range(p.size):
        power[i, k] = p[k]


@kernel(counted=False)
def mark(row, stations, T, elements):
    """Tensions at the nodes `stations`: the mean of the elements on both sides."""
    for k in range(stations.size):
        j = stations[k]
        row[k] = 0.5 * (T[max(j, 1)] + T[min(j + 1, elements)])


@kernel(counted=False)
def lead(motion, t, room, q, v, a, last):
    """Place the last node at the fairlead at time t; room : (3, 3)"""
    fairlead_at(motion, t, room[0], room[1], room[2])
    for i in range(3):
        q[i, last], v[i, last], a[i, last] = room[0, i], room[1, i], room[2, i]


@kernel(counted=False)
def load_state(state, q, v, a, slip):
    """Copy the arrays (n, 3) of a State into rows (3, w)"""
    read(q, state.position)
    read(v, state.velocity)
    read(a, state.acceleration)
    read(slip, state.slip)


@kernel(counted=False)
def store_state(state, q, v, a, slip):
    """Rows (3, w) into the arrays (n, 3) of a State"""
    write(state.position, q)
    write(state.velocity, v)
    write(state.acceleration, a)
    write(state.slip, slip)


@kernel(counted=False)
def error(s, work, K, V, db, step, hd):
    """Error of tensions (N) and positions (m), filtered with the matrix of the last stage; see `spread`."""
    last = s.length.size
    for i in range(3):
        for j in range(1, last):
            total = 0.0
            for k in range(db.size):
                total += db[k] * (V[k, i, j] + hd * K[k, i, j])
            work.x[i, j] = work.node[INERTIA, j] * step * total
    substitute_line(work.pivots, work.bending, work.x, work.x, last)
    return spread(work, last)


@kernel(counted=False)
def predict(q, v, qh, vh, K, V, A, i, step, cv):
    """q̂ and v̂ of stage i, predicted from the earlier stages"""
    for m in range(3):
        for j in range(q.shape[1]):
            along, speed = q[m, j], v[m, j]
            for k in range(i):
                along += step * A[i, k] * V[k, m, j]
                speed += step * A[i, k] * K[k, m, j]
            qh[m, j], vh[m, j] = along + cv * speed, speed


@kernel(counted=False)
def run(s, work, water, motion, control, scheme, state, until, rows, frame_times, frames, stations, station_rows):
    """Step from `state` to the time `until`; fills rows and frames, and leaves the final state in `state`.

    s, work : `System` of the line, and its `workspace`; water : None for still water
    returns : cause of the stop, rows used, frames used, time, step, rejected steps, Newton steps, element at fault
    """
    A, db, c = scheme
    stages, last, d = c.size, s.length.size, A[1, 1]
    kept, power, energy, used, drawn = work.kept, work.powers, work.energy, 1, 0
    q, v, a, slip, qh, vh = kept[0], kept[1], kept[2], kept[3], kept[4], kept[5]
    K, V = kept[6 : 6 + stages], kept[6 + stages :]
    for i in range(6):
        energy[i] = rows[0, 7 + i]
    t, h, rejected, iterations, why = state.time, min(state.step, control.longest), 0, 0, DONE
    load_state(state, q, v, a, slip)
    copy(work.q, q)
    copy(work.v, v)
    if water is not None:
        water_at(water, q, last + 1, t, work.u, work.du)
    node_forces(s, work, a, slip, q, 0.0, 0.0)
    record(rows[0], t, h, s, work, energy)
    mark(station_rows[0], stations, work.T, last)
    keep(0, K, V, power, a, v, work.power)
    scale, again = max(control.tension, rows[0, 18]), False
    while t < until * (1 - 1e-14) - 1e-14:
        if used == rows.shape[0]:
            why = FULL
            break
        remaining = until - t
        step = remaining if h >= remaining else (0.5 * remaining if 2 * h > remaining else h)
        cq, cv, good, moved, stretched = (step * d) ** 2, step * d, True, np.inf, np.inf
        limit = NEWTON * control.tolerance
        for i in range(1, stages):
            now = t + c[i] * step
            predict(q, v, qh, vh, K, V, A, i, step, cv)
            k = K[i]
            copy(k, K[i - 1])
            lead(motion, now, work.fairlead, qh, vh, k, last)
            begin_stage(work, qh, vh, k, last, cq, cv)
            # the water is that at the expected positions of the nodes: an error of order h³
            if water is not None:
                water_at(water, work.q, last + 1, now, work.u, work.du)
            status, count = solve_stage(s, work, k, slip, q, cq, cv, limit * scale, limit * control.distance)
            iterations += count
            if status != CONVERGED:
                good = False
                break
            keep(i, K, V, power, k, work.v, work.power)
        if good:
            largest = max(scale, largest_of(work.T))
            stretched, moved = error(s, work, K, V, db, step, cv)
            size = max(stretched / (control.tolerance * largest), moved / (control.tolerance * control.distance))
            factor_h = min(MOST, max(LEAST, SAFETY * size ** (-1.0 / 3.0))) if size > 0 else MOST
        else:
            size, factor_h = np.inf, 0.25
        if not size <= 1.0:
            rejected, again = rejected + 1, True
            h = step * factor_h
            if h < control.shortest:
                why = TOO_SHORT
                break
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
        record(rows[used], t, step, s, work, energy)
        mark(station_rows[used], stations, work.T, last)
        used += 1
        keep(0, K, V, power, a, v, work.power)
        if again:  # the same step would be rejected again
            factor_h, again = min(factor_h, 1.0), False
        h = max(h, step * factor_h) if step < h else step * factor_h
        h = min(h, control.longest)
    store_state(state, q, v, a, slip)
    worst = worst_element(work, last) if why == TOO_SHORT else 0
    return why, used, drawn, t, h, rejected, iterations, worst


SCHEME = tableau()


@kernel(counted=False)
def follow(s, work, water, motion, control, state, until, rows, frame_times, frames, stations, station_rows):
    """`run` for calls from Python: its slowest parts are compiled once, both for single lines and for lines of
    bodies
    """
    return run(s, work, water, motion, control, SCHEME, state, until, rows, frame_times, frames, stations, station_rows)


def compile_steps(s):
    """Compile the kernels that steps of a `System` need besides the forces on its nodes"""
    work = workspace(s)
    q, K, V = work.kept[0], work.kept[6 : 6 + STAGES], work.kept[6 + STAGES :]
    A, db, _ = SCHEME
    factor_line.compile_for(work.D, work.B, work.bending, work.pivots, 1)
    correction.compile_for(work, 1, 1.0)
    error.compile_for(s, work, K, V, db, 1.0, 1.0)
    record.compile_for(work.powers[0], 0.0, 1.0, s, work, work.energy)
    keep_slip.compile_for(s, q, q, q, q, q)
    predict.compile_for(q, q, q, q, K, V, A, 1, 1.0, 1.0)
