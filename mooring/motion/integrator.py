"""Integration in time: Runge and Kutta's method of Dormand and Prince (1980), orders 5 and 4, step by its own error.

The error of a step is the difference of the two orders.  It is held below a share of the tolerance, of the scale of
each motion, times the step over the time in which an error dies out; positions and velocities count.  Steps end where
a window of wave forces ends and where a line breaks, so that no jump lies within one.  Samples between steps are
Hermite polynomials, of fifth degree in what has a known velocity and acceleration.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from .equation import rates
from .wave_loads import fill_window

SAFETY, LARGEST, SMALLEST = 0.9, 4.0, 0.2  # of the change of step
SHORTEST = 1e-5  # s; a step below it says that the motion cannot be followed
DONE, RUNNING, TOO_SHORT, NO_LINE, NOT_FINITE = range(5)

A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
C = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
E = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])


class Clock(NamedTuple):
    """What a run keeps between calls, changed in place.

    now : t, step, next sample, start of the window, end of the run, step between samples, fixed step or 0, all s
    counts : steps, steps refused, samples; scale : (12,) allowed error a second of each position and velocity
    y, stages : state (n,), its rates (7, n); poses : (2, 3) slow poses at the ends of the window
    """

    now: np.ndarray
    counts: np.ndarray
    scale: np.ndarray
    y: np.ndarray
    trial: np.ndarray
    stages: np.ndarray
    poses: np.ndarray


@kernel()
def take_step(body, lines, line_work, wind, current, clock, work, t, h):
    """Stages and the trial state after a step; returns its error over what is allowed, and whether all lines hold."""
    y, k, trial = clock.y, clock.stages, clock.trial
    n, good = y.size, True
    for s in range(1, 7):
        for i in range(n):
            total = 0.0
            for j in range(s):
                total += A[s, j] * k[j, i]
            trial[i] = y[i] + h * total
        good = rates(body, lines, line_work, wind, current, t + C[s] * h, trial, k[s], work) and good
    worst = 0.0
    for i in range(12):
        total = 0.0
        for j in range(7):
            total += E[j] * k[j, i]
        worst = max(worst, abs(total) / clock.scale[i])  # h·total over scale·h
    return worst, good


@kernel()
def put_sample(clock, t, h, at, out):
    """out (18,): position, velocity, slow pose and its rate at a time `at` within the step, by Hermite polynomials"""
    s = (at - t) / h
    y, z, k = clock.y, clock.trial, clock.stages
    s2, s3 = s * s, s * s * s
    a, b = 1 - s3 * (10 - 15 * s + 6 * s2), s3 * (10 - 15 * s + 6 * s2)
    c, d = s - s3 * (6 - 8 * s + 3 * s2), -s3 * (4 - 7 * s + 3 * s2)
    e, f = 0.5 * s2 - s3 * (1.5 - 1.5 * s + 0.5 * s2), s3 * (0.5 - s + 0.5 * s2)
    for i in range(6):
        if i < 2:  # velocities and accelerations of x and y are in turning axes
            out[i] = hermite(s, y[i], z[i], h * k[0, i], h * k[6, i])
        else:
            out[i] = (
                a * y[i] + b * z[i] + h * (c * y[6 + i] + d * z[6 + i]) + h * h * (e * k[0, 6 + i] + f * k[6, 6 + i])
            )
    for i in range(6, 18):
        out[i] = hermite(s, y[i], z[i], h * k[0, i], h * k[6, i])


@kernel()
def hermite(s, y, z, dy, dz):
    """Cubic through values and slopes (times the step) at s = 0 and 1"""
    return y + s * (dy + s * (3 * (z - y) - 2 * dy - dz + s * (2 * (y - z) + dy + dz)))


@kernel()
def next_break(lines, t):
    """s of the first line that breaks after t, inf for none"""
    first = np.inf
    for i in range(lines.lost.size):
        if t < lines.lost[i] < first:
            first = lines.lost[i]
    return first


@kernel()
def open_window(table, clock, work, rows, sums, mean_drift):
    """Forces of the next window: from the pose foreseen for now to the one foreseen for its end."""
    now, y, length = clock.now, clock.y, table.times[1]
    clock.poses[0] = clock.poses[1]
    for j in range(3):
        clock.poses[1, j] = y[12 + j] + length * y[15 + j]
    work.span[0], work.span[1] = now[0], table.times[0]
    now[3] = now[0]
    fill_window(table, work.window, rows, sums, clock.poses[0], clock.poses[1], now[0], mean_drift)


@kernel()
def advance(body, lines, line_work, wind, current, table, clock, work, rows, sums, mean_drift, samples, most):
    """Integrate until the end, or for `most` steps; samples (n, 18) is filled row by row.  Returns why it stopped."""
    now, counts, y = clock.now, clock.counts, clock.y
    k = clock.stages
    for _ in range(most):
        t = now[0]
        if t >= now[4] - 1e-9:
            return DONE
        if t >= now[3] + table.times[1] - 1e-9:
            open_window(table, clock, work, rows, sums, mean_drift)
            rates(body, lines, line_work, wind, current, t, y, k[0], work)
        limit = min(now[3] + table.times[1], now[4], next_break(lines, t))
        h = now[6] if now[6] > 0.0 else now[1]
        cut = t + h >= limit - 1e-9
        if cut:
            h = limit - t
        elif t + 2.0 * h > limit and now[6] == 0.0:
            h = 0.5 * (limit - t)
        error, good = take_step(body, lines, line_work, wind, current, clock, work, t, h)
        if not np.isfinite(error) or not good:
            if now[6] > 0.0 or h < SHORTEST:
                return NO_LINE if not good else NOT_FINITE
            counts[1] += 1
            now[1] = SMALLEST * h
            continue
        if error > 1.0 and now[6] == 0.0:
            counts[1] += 1
            now[1] = h * max(SMALLEST, SAFETY * error**-0.25)
            if now[1] < SHORTEST:
                return TOO_SHORT
            continue
        later = limit if cut else t + h
        while now[2] <= later and counts[2] < samples.shape[0]:
            put_sample(clock, t, h, now[2], samples[counts[2]])
            counts[2] += 1
            now[2] = counts[2] * now[5]
        y[:] = clock.trial
        now[0] = later
        counts[0] += 1
        if later == next_break(lines, t):
            for i in range(lines.lost.size):
                line_work.whole[i] = lines.lost[i] > later
            rates(body, lines, line_work, wind, current, later, y, k[0], work)
        else:
            k[0] = k[6]
        if not cut or error > 0.0:
            grown = h * min(LARGEST, max(SMALLEST, SAFETY * max(error, 1e-8) ** -0.25))
            now[1] = max(now[1], grown) if cut else grown
    return RUNNING
