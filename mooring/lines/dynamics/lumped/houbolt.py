"""Houbolt's scheme with a fixed step, as in the SR179 report (1982), section 2.2, eqs. 3.2.21 and 3.2.22.

    s̈ₙ₊₁ = (2sₙ₊₁ − 5sₙ + 4sₙ₋₁ − sₙ₋₂)/Δt²,    ṡₙ₊₁ = (11sₙ₊₁ − 18sₙ + 9sₙ₋₁ − 2sₙ₋₂)/6Δt

The report iterates on tensions, in a tridiagonal matrix at fixed angles; here the nodes themselves are the unknowns
and the tangent holds tension, geometry and bed.  A run starts from rest: sₙ₋₁ = sₙ₋₂ = sₙ.
The scheme damps (ratio 0.012 at 20 steps a period) and is not checked by itself: `dynamics.simulation.simulate` halves
the step until the tension stays the same.
"""

from __future__ import annotations

import numpy as np

from hakobune.bem.kernels.borrowed import borrowed
from hakobune.bem.kernels.jit import kernel

from .bed import keep_slip
from .books import FRICTION
from .esdirk import frame, lead, load_state, mark, record, store_state
from .forces import node_forces
from .stage import CONVERGED, begin_stage, solve_stage, worst_element
from .surroundings import water_at
from .workspace import copy, workspace


@kernel()
def run_fixed(system, sea, course, control, state, step, rows, frame_times, frames, stations, station_rows):
    """rows.shape[0] − 1 steps from a state of rest; fills rows and frames.

    returns : steps made, Newton steps, element at fault
    """
    s, water, motion = borrowed((system, sea, course))
    last, room = state.position.shape[0] - 1, workspace(s)
    work, memory, still = borrowed(room), np.zeros((8, 3, room.q.shape[1])), np.zeros((3, 3))
    q, v, a, slip = borrowed((memory[0], memory[1], memory[2], memory[3]))
    p1, p2, qh, vh = borrowed((memory[4], memory[5], memory[6], memory[7]))  # p1 and p2: one and two steps before q
    energy, before = np.zeros(6), np.zeros(6)
    load_state(state, q, v, a, slip)
    copy(p1, q)
    copy(p2, q)
    copy(work.q, q)
    water_at(water, q, last + 1, state.time, work.u, work.du)
    node_forces(s, work, a, slip, q, 0.0, 0.0)
    before[:] = work.power
    record(rows[0], state.time, step, s, work, energy)
    mark(station_rows[0], stations, work.T, last)
    done, drawn, iterations, cq, cv, limit = 0, 0, 0, 0.5 * step * step, 11.0 / 12.0 * step, 1e-2 * control.tolerance
    for k in range(1, rows.shape[0]):
        t = state.time + k * step
        for i in range(3):
            for j in range(last + 1):
                qh[i, j] = 2.5 * q[i, j] - 2.0 * p1[i, j] + 0.5 * p2[i, j]
                vh[i, j] = (11.0 * qh[i, j] - 18.0 * q[i, j] + 9.0 * p1[i, j] - 2.0 * p2[i, j]) / (6.0 * step)
        lead(motion, t, still, qh, vh, a, last)
        begin_stage(work, qh, vh, a, last, cq, cv)
        water_at(water, work.q, last + 1, t, work.u, work.du)
        status, count = solve_stage(
            s, work, a, slip, q, cq, cv, limit * max(control.tension, work.T.max()), limit * control.distance
        )
        iterations += count
        if status != CONVERGED:
            break
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
        record(rows[k], t, step, s, work, energy)
        mark(station_rows[k], stations, work.T, last)
        done = k
    store_state(state, q, v, a, slip)
    worst = worst_element(work, last) if done + 1 < rows.shape[0] else 0
    room.power[0], memory[0, 0, 0] = 0.0, 0.0  # kept until here, see `borrowed`
    return done, iterations, worst
