"""Houbolt's scheme with a fixed step, as in the SR179 report (1982), section 2.2, eqs. 3.2.21 and 3.2.22.

    s̈ₙ₊₁ = (2sₙ₊₁ − 5sₙ + 4sₙ₋₁ − sₙ₋₂)/Δt²,    ṡₙ₊₁ = (11sₙ₊₁ − 18sₙ + 9sₙ₋₁ − 2sₙ₋₂)/6Δt

The report iterates on tensions, in a tridiagonal matrix at fixed angles; here the nodes themselves are the unknowns
and the tangent holds tension, geometry and bed.  A run starts from rest: sₙ₋₁ = sₙ₋₂ = sₙ.
The scheme damps (ratio 0.012 at 20 steps a period) and is not checked by itself: `dynamics.simulation.simulate` halves
the step until the tension stays the same.
"""

from __future__ import annotations

import numpy as np

from bem.kernels.jit import kernel

from .bed import keep_slip
from .books import FRICTION
from .esdirk import frame, mark, record
from .forces import node_forces
from .stage import CONVERGED, copy, move, solve_stage, workspace
from .surroundings import fairlead_at, water_at


@kernel()
def run_fixed(s, water, motion, control, state, step, rows, frame_times, frames, stations, station_rows):
    """rows.shape[0] − 1 steps from a state of rest; fills rows and frames.

    returns : steps made, Newton steps, element at fault
    """
    last = state.position.shape[0] - 1
    q, v, a, slip = state.position, state.velocity, state.acceleration, state.slip
    work = workspace(last + 1)
    p1, p2 = q.copy(), q.copy()  # one and two steps before q
    qh, vh, energy, before = np.zeros_like(q), np.zeros_like(q), np.zeros(6), np.zeros(6)
    copy(work.q, q)
    water_at(water, q, state.time, work.u, work.du)
    node_forces(s, work, a, slip, q, 0.0, 0.0)
    before[:] = work.power
    record(rows[0], state.time, step, s, work, energy, a)
    mark(station_rows[0], stations, work.T)
    drawn, iterations, cq, cv, limit = 0, 0, 0.5 * step * step, 11.0 / 12.0 * step, 1e-2 * control.tolerance
    for k in range(1, rows.shape[0]):
        t = state.time + k * step
        for j in range(last + 1):
            for i in range(3):
                qh[j, i] = 2.5 * q[j, i] - 2.0 * p1[j, i] + 0.5 * p2[j, i]
                vh[j, i] = (11.0 * qh[j, i] - 18.0 * q[j, i] + 9.0 * p1[j, i] - 2.0 * p2[j, i]) / (6.0 * step)
        fairlead_at(motion, t, qh[last], vh[last], a[last])
        copy(work.q, qh)
        move(work.q, work.v, a, cq, cv)
        water_at(water, work.q, t, work.u, work.du)
        status, worst, count = solve_stage(
            s, work, qh, vh, a, slip, q, cq, cv, limit * max(control.tension, work.T.max()), limit * control.distance
        )
        iterations += count
        if status != CONVERGED:
            return k - 1, iterations, worst
        for i in range(FRICTION):
            energy[i] += 0.5 * step * (before[i] + work.power[i])
            before[i] = work.power[i]
        while drawn < frame_times.size and (frame_times[drawn] <= t or k == rows.shape[0] - 1):
            frame(frames[drawn], 1.0 + min(0.0, (frame_times[drawn] - t) / step), step, q, v, work.q, work.v)
            drawn += 1
        energy[FRICTION] += keep_slip(s, work.q, work.v, slip, q, v)
        copy(p2, p1)
        copy(p1, q)
        copy(q, work.q)
        copy(v, work.v)
        record(rows[k], t, step, s, work, energy, a)
        mark(station_rows[k], stations, work.T)
    return rows.shape[0] - 1, iterations, 0
