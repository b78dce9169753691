"""One step of the body for all moving lines: they follow their fairleads and exert forces on the body.

A fairlead moves from its position at the line's end to its position on the body, along two cubics through positions
and velocities at start, middle and end of the step. A line takes as many own steps as its tolerance requires
(`lines.dynamics.lumped.esdirk`).  Its pull F(t) is a cubic between the ends of its steps. The slope at the end of a
line's step is the slope of the parabola through this end and the two neighbouring ends. The force on the body is the
polynomial of third degree

    F(s) = Σ_k c_k P_k(2s − 1),   c_k = (2k + 1) ∫₀¹ F P_k(2s − 1) ds,   s = (t − t₀)/h

with Legendre's P_k.  The series keeps the impulse of F and its first three moments. Jerks of a line that are shorter
than the body's step then have their full effect on the body, but the force is smooth for the body's error estimate.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel

from ...lines.dynamics.lumped.esdirk import COLUMNS, DONE, SCHEME, run
from ...lines.dynamics.lumped.system import Control, Motion, State
from ...lines.dynamics.run import SHORTEST
from .at_rest import moving_work
from .packed import ROWS, moving_lines
from .polynomial import TERMS, legendre
from .sea import open_sea, sea_ahead

GAUSS = np.polynomial.legendre.leggauss(4)  # exact for a cubic times P₃
NODES, WEIGHTS = 0.5 * (GAUSS[0] + 1), 0.5 * GAUSS[1]
ROUNDING = 1e-9  # rounding of the time covered by a table of the sea


@kernel(counted=False)
def sea_for_step(sea, moving, work, t, h):
    """Fill a table of the sea around all lines that is valid for a step of the body of h s from t s

    sea : `moving.sea`; for None (still water) the code that fills tables is not compiled
    """
    if sea is not None:
        water, room = moving.water, moving.room_of_sea
        if t + h > water.clock[0] + sea_ahead(sea) * (1 + ROUNDING):
            open_sea(sea, water, moving.nodes, work.position[0], work.velocity[0], room, t)


@kernel(counted=False)
def piece(p, v, q, w, length, out):
    """Fill out (4, 3), coefficients of 1, τ, τ², τ³ of the cubic from p with velocity v to q with velocity w in
    `length` s
    """
    for j in range(3):
        rise = (q[j] - p[j]) / length
        out[0, j], out[1, j] = p[j], v[j]
        out[2, j] = (3 * rise - 2 * v[j] - w[j]) / length
        out[3, j] = (v[j] + w[j] - 2 * rise) / (length * length)


@kernel(inline=True, counted=False)
def water_of_line(waters, i):
    """`Water` of line i, None for still water"""
    if waters is None:
        return None
    return waters[i]


@kernel()
def advance_lines(moving, work, whole, t, h):
    """Advance all lines that are `whole` over a step of the body of h s from t s, as a trial.

    work.course, except at the start, is given; work.time, pull, slope and used are filled.
    returns : whether all lines succeeded; work.stuck is the number of a line that did not
    """
    rows, knots, cubics = np.zeros((ROWS, COLUMNS)), np.zeros(3), np.zeros((2, 4, 3))
    none, triples, table = np.zeros(0), np.zeros((0, 3)), np.zeros((0, 0, 3))
    stations, marks = np.zeros(0, np.int64), np.zeros((ROWS, 0))
    knots[0], knots[1], knots[2] = t, t + 0.5 * h, t + h
    for i in range(moving.number.size):
        if not whole[moving.number[i]]:
            work.used[i] = 0
            continue
        first, last = moving.nodes[i], moving.nodes[i + 1]
        q, v = work.position[1, first:last], work.velocity[1, first:last]
        a, slip = work.acceleration[1, first:last], work.slip[1, first:last]
        put(q, work.position[0, first:last])
        put(v, work.velocity[0, first:last])
        put(a, work.acceleration[0, first:last])
        put(slip, work.slip[0, first:last])
        c, end = work.course[i], last - first - 1
        piece(q[end], v[end], c[1, 0], c[1, 1], 0.5 * h, cubics[0])
        piece(c[1, 0], c[1, 1], c[2, 0], c[2, 1], 0.5 * h, cubics[1])
        rows[0, 7:13] = 0.0
        found = run(
            moving.systems[i],
            moving.rooms[i],
            water_of_line(moving.waters, i),
            Motion(knots, cubics, none, triples, triples, 0.0),
            Control(moving.tolerance, moving.tension[i], moving.distance[i], h, SHORTEST * h),
            SCHEME,
            State(t, q, v, a, slip, work.step[0, i]),
            t + h,
            rows,
            none,
            table,
            stations,
            marks,
        )
        if found[0] != DONE:
            work.stuck[0] = moving.number[i]
            return False
        work.step[1, i], work.used[i] = found[4], found[1]
        for j in range(found[1]):
            work.time[i, j] = rows[j, 0]
            for k in range(3):
                work.pull[i, j, k] = rows[j, 1 + k]
        slopes(work, i)
    work.stuck[0] = -1
    return True


@kernel(counted=False)
def put(y, x):
    """y = x for (n, 3) arrays: a direct array assignment takes three seconds to compile"""
    for i in range(y.shape[0]):
        for j in range(3):
            y[i, j] = x[i, j]


@kernel(counted=False)
def slopes(work, i):
    """Fill work.slope of line i at the end of each of its steps, by a parabola through this end and the two
    neighbouring ends.
    """
    time, pull, last = work.time[i], work.pull[i], work.used[i] - 1
    for j in range(last + 1):
        for k in range(3):
            before, at = (work.before[i, 0], work.before[i, 1 + k]) if j == 0 else (time[j - 1], pull[j - 1, k])
            if j == last:
                before, at = (work.before[i, 0], work.before[i, 1 + k]) if j < 2 else (time[j - 2], pull[j - 2, k])
                work.slope[i, j, k] = end_slope(before, at, time[j - 1], pull[j - 1, k], time[j], pull[j, k])
                continue
            left, right = time[j] - before, time[j + 1] - time[j]
            work.slope[i, j, k] = ((pull[j, k] - at) / left * right + (pull[j + 1, k] - pull[j, k]) / right * left) / (
                left + right
            )


@kernel(counted=False)
def end_slope(t0, f0, t1, f1, t2, f2):
    """Slope at t2 of the parabola through three points"""
    a, b = (f1 - f0) / (t1 - t0), (f2 - f1) / (t2 - t1)
    return b + (b - a) / (t2 - t0) * (t2 - t1)


@kernel(counted=False)
def between(work, i, j, t, k):
    """Component k of the pull of line i, N, at t s within the line's step from end j to the next end"""
    length = work.time[i, j + 1] - work.time[i, j]
    s = (t - work.time[i, j]) / length
    y, z = work.pull[i, j, k], work.pull[i, j + 1, k]
    dy, dz = length * work.slope[i, j, k], length * work.slope[i, j + 1, k]
    return y + s * (dy + s * (3 * (z - y) - 2 * dy - dz + s * (2 * (y - z) + dy + dz)))


@kernel()
def project(moving, work, t, h, given):
    """Fill given (n, TERMS, 3) N, coefficients c_k of the pull of every moving line, by line number, in a step of h
    s from t s
    """
    p = np.zeros(TERMS)
    for i in range(moving.number.size):
        c = given[moving.number[i]]
        c[:] = 0.0
        for j in range(work.used[i] - 1):
            length = work.time[i, j + 1] - work.time[i, j]
            for g in range(NODES.size):
                at = work.time[i, j] + NODES[g] * length
                legendre(2 * (at - t) / h - 1, p)
                for m in range(3):
                    F = between(work, i, j, at, m) * WEIGHTS[g] * length / h
                    for k in range(TERMS):
                        c[k, m] += (2 * k + 1) * p[k] * F


@kernel(counted=False)
def foresee(moving, work, h, given):
    """Fill given (n, TERMS, 3) N for a step of h s with the linear part of each pull in the last step, extrapolated"""
    ratio = h / work.length[0]
    for i in range(moving.number.size):
        c, last = given[moving.number[i]], work.last[moving.number[i]]
        c[:] = 0.0
        for m in range(3):
            c[0, m] = last[0, m] + (1 + ratio) * last[1, m]
            c[1, m] = ratio * last[1, m]


@kernel(counted=False)
def keep_lines(moving, work, h, given):
    """Accept the body's step of h seconds: the trial state becomes the state of the lines."""
    put(work.position[0], work.position[1])
    put(work.velocity[0], work.velocity[1])
    put(work.acceleration[0], work.acceleration[1])
    put(work.slip[0], work.slip[1])
    for i in range(given.shape[0]):
        put(work.last[i], given[i])
    work.length[0] = h
    for i in range(moving.number.size):
        work.step[0, i] = work.step[1, i]
        last = work.used[i] - 1
        if last < 1:
            continue
        work.steps[i] += last
        work.before[i, 0] = work.time[i, last - 1]
        for k in range(3):
            work.before[i, 1 + k] = work.pull[i, last - 1, k]


@kernel(counted=False)
def put_tensions(moving, work, row, t):
    """Write the tension of every line, t s after the start of the step just taken, into a row of work.tension"""
    for i in range(moving.number.size):
        last = work.used[i] - 1
        if last < 1:
            continue
        j = 0
        while j < last - 1 and t > work.time[i, j + 1]:
            j += 1
        x, y, z = (between(work, i, j, t, 0), between(work, i, j, t, 1), between(work, i, j, t, 2))
        work.tension[row, i] = np.sqrt(x * x + y * y + z * z)


def compile_moving(line, fairlead):
    """Compile the code that a DynamicLine in still water, with its fairlead at (3,) m, adds to the steps of a rigid
    body
    """
    moving, states = moving_lines({0: line}, [fairlead], 1e-3, (np.zeros((1, 6)), np.ones(1)))
    work = moving_work(moving, states, 1, 1, (1, 1))
    advance_lines.compile_for(moving, work, work.used > 0, 0.0, 1.0)
    foresee.compile_for(moving, work, 1.0, work.last)
    project.compile_for(moving, work, 0.0, 1.0, work.last)
    put_tensions.compile_for(moving, work, 0, 0.0)
    keep_lines.compile_for(moving, work, 1.0, work.last)
