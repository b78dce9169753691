"""Integration in time: the Runge–Kutta method of Dormand and Prince (1980), orders 5 and 4, with the step chosen by
its error.

The error of a step is the difference of the two orders.  The limit of this error is a fraction of the tolerance,
relative to the scale of each motion, times the step over the time in which an error decays. The errors of positions
and velocities count. Where a line becomes taut or a fender is touched, the force has a corner, and the error of a
step over the corner falls only like h². The limit for such a step is therefore computed from a fraction of the usual
step, which is the mean of steps over time.  Where no force has a corner (lines in their static shape, and neither
fenders, ropes, hawsers nor hinges) the error E of the fourth order is far above the error of the fifth order, whose
result is kept. The counted error is therefore E min(1, SMOOTH E/D), with D from the third divided difference of the
rates; D falls by one order less than E.  Steps end where a window of wave forces ends and where a line breaks, so
that no step contains a jump. Samples between steps are Hermite polynomials, of fifth degree for quantities with
known velocity and acceleration.

Dynamic lines (`moving_lines`) follow a step that is computed with their predicted pull. The step is then repeated
with their computed pull.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from .buoy import keep_pulls, open_water
from .contact_loads import settle
from .equation import BLOCK, OF_SHAPES, SAMPLED, SLOW, SLOW_RATE, rates
from .line_loads import fairlead_of, hold
from .links import put_forces
from .moving_lines.sea import sea_ahead
from .moving_lines.steps import advance_lines, foresee, keep_lines, project, put_tensions, sea_for_step
from .tables.wave_windows import fill_window, meet

SAFETY, LARGEST, SMALLEST = 0.85, 4.0, 0.2  # safety factor, largest and smallest change of step
WITH_LINES = 0.7  # SAFETY with moving lines: their response is predicted less well, and a rejected step is expensive
SHORTEST, OF_USUAL = 1e-5, 1e-4  # s, share of the usual step: a step below both ends the run,
AT_CORNER = 100  # largest number of consecutive steps below the first limit
FIRST_STEP = 0.05  # s
AT_ONCE = 1e-9  # s below which two instants are equal
ROUNDING = 2e-9  # uncertainty of sample times, over the step between samples
# step over the usual step, below which the error of a step over a corner counts in proportion; a corner takes six steps
CORNER = 0.1
# factor of the ratio of errors of smooth forces.  Chains at a tolerance of 1e-3: 1e-4 σ off with 26 % fewer steps than
# by the fourth order alone, 3e-5 σ off; of 120 random studies 7 in place of 5 are beyond their tolerance, 6 are told so
SMOOTH = 20.0
MEMORY = 20.0  # number of usual steps in their mean
TIME, STEP, WINDOW, USUAL = range(4)  # places in `Clock.now`
STEPS, REFUSED, SAMPLES, WINDOWS, SHORT = range(5)  # places in `Clock.counts`
DONE, RUNNING, TOO_SHORT, NO_LINE, NOT_FINITE, BEYOND, STUCK = range(7)

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
THIRD = np.array([-25 / 6, 0.0, 200 / 21, -25 / 2, 0.0, 0.0, 50 / 7]) / 24  # of rates at 0, 3/10, 4/5 and 1 of a step


@in_memory
class Clock(NamedTuple):
    """State of a run between calls; its arrays are changed in place.

    now : TIME, STEP, WINDOW (start of the window), USUAL step, all in s
    counts : number of STEPS, REFUSED steps, SAMPLES, WINDOWS, and SHORT steps in a row
    end, sample_step : s; fixed_step : s, 0 where the error chooses the step
    scale : allowed error per second of each position and velocity, (N, 12); float_scale : the same for a buoy, (6,)
    bent_scale : allowed error per second of groups of shapes, (G, 12)
    y, stages : state (n,), and its rates (7, n); pose : slow pose of a body predicted for the end of the window, (3,)
    smooth : SMOOTH for forces without corners, inf for all others
    """

    now: np.ndarray
    counts: np.ndarray
    end: float
    sample_step: float
    fixed_step: float
    scale: np.ndarray
    float_scale: np.ndarray
    bent_scale: np.ndarray
    y: np.ndarray
    trial: np.ndarray
    stages: np.ndarray
    pose: np.ndarray
    smooth: float


def clock_at_rest(y, end, sample_step, fixed_step, scale, groups=0, smooth=False):
    """Clock of a run from a state y (n,) at 0 s; scale : (N + groups, 12), first of bodies, then of groups of shapes

    smooth : whether no force has a corner
    """
    first = fixed_step or FIRST_STEP
    scale = np.asarray(scale, float).reshape(-1, 12)
    scale, bent = scale[: len(scale) - groups], scale[len(scale) - groups :]
    buoy = np.repeat([scale[0, :3].max(), scale[0, 6:9].max()], 3)
    return Clock(
        np.array([0.0, first, -np.inf, first]),
        np.zeros(5, np.int64),
        float(end),
        float(sample_step),
        float(fixed_step or 0.0),
        scale,
        buoy,
        bent,
        y,
        np.zeros_like(y),
        np.zeros((7, len(y))),
        np.zeros(3),
        SMOOTH if smooth else np.inf,
    )


@kernel(counted=False)
def stage(trial, y, k, h, s):
    """Trial state (n,) at stage s of a step of h s from y, in one pass along the states in memory order

    A rate with weight zero is replaced by the rate of the first stage, which is finite.
    """
    a, b, c, d, e = k[0], k[min(1, s - 1)], k[2 if s > 2 else 0], k[3 if s > 3 else 0], k[4 if s > 4 else 0]
    f = k[5 if s > 5 else 0]
    first, second, third = h * A[s, 0], h * A[s, 1], h * A[s, 2]
    fourth, fifth, sixth = h * A[s, 3], h * A[s, 4], h * A[s, 5]
    for i in range(trial.size):
        trial[i] = y[i] + first * a[i] + second * b[i] + third * c[i] + fourth * d[i] + fifth * e[i] + sixth * f[i]


@kernel(counted=False)
def take_step(scene, buoy, links, clock, t, h):
    """Compute the stages and the trial state after a step; returns its error over the limit, and whether all lines
    have a force.
    """
    k, trial, good = clock.stages, clock.trial, True
    for s in range(1, 7):
        stage(trial, clock.y, k, h, s)
        good = rates(scene, buoy, links, t + C[s] * h, trial, k[s]) and good
    worst, rough, count = 0.0, 0.0, clock.scale.shape[0]
    for b in range(count):
        worst, rough = worse(k, BLOCK * b, clock.scale[b], worst, rough)
    for g in range(clock.bent_scale.shape[0]):
        worst, rough = worse(k, BLOCK * count + 6 + OF_SHAPES * g, clock.bent_scale[g], worst, rough)
    if buoy is not None:
        worst, rough = worse(k, BLOCK * count, clock.float_scale, worst, rough)
    if clock.smooth * worst < rough:
        worst *= clock.smooth * worst / rough
    return worst, good


@kernel(counted=False)
def worse(k, first, scale, worst, rough):
    """Maxima of the errors of order 4 and of the third differences, so far and of the states from `first` on, over
    the limit.

    inf and 0 replace values that are not numbers
    """
    for i in range(scale.size):
        total = third = 0.0
        for j in range(7):
            total += E[j] * k[j, first + i]
            third += THIRD[j] * k[j, first + i]
        if not np.isfinite(total):
            return np.inf, 0.0  # `max` leaves out what is not a number
        worst, rough = max(worst, abs(total) / scale[i]), max(rough, abs(third) / scale[i])  # h·total over scale·h
    return worst, rough


@kernel(counted=False)
def take_step_with_lines(scene, buoy, links, clock, moving, t, h):
    """`take_step` with moving lines: with the predicted pull, then the lines along the resulting course, then with
    their pull.

    The error includes the deviation of the body from the predicted course that the lines followed.
    """
    lines, kept = moving
    work, trial = scene.line_work, clock.trial
    foresee(lines, kept, h, work.given)
    work.span[1], work.span[2] = t, h
    good = rates(scene, buoy, links, t, clock.y, clock.stages[0])
    error, held = take_step(scene, buoy, links, clock, t, h)
    if not (good and held and np.isfinite(error)):
        return error, good and held
    for b in range(clock.scale.shape[0]):
        for i in range(12):
            kept.foreseen[b, i] = trial[BLOCK * b + i]
        put_sample(clock, b, t, h, t + 0.5 * h, kept.pose[b])
    put_bent(clock, scene.body.bent, t, h, t + 0.5 * h, kept.bent[0])
    put_bent(clock, scene.body.bent, t, h, t + h, kept.bent[1])
    for i in range(lines.number.size):
        n, course = lines.number[i], kept.course[i]
        b = scene.lines.body[n]
        end = trial[BLOCK * b : BLOCK * b + 12]
        fairlead_of(scene.lines, n, kept.pose[b], kept.bent[0], kept.room, course[1, 0], course[1, 1])
        fairlead_of(scene.lines, n, end, kept.bent[1], kept.room, course[2, 0], course[2, 1])
    if not advance_lines(lines, kept, work.whole, t, h):
        return np.inf, True
    project(lines, kept, t, h, work.given)
    good = rates(scene, buoy, links, t, clock.y, clock.stages[0])
    error, held = take_step(scene, buoy, links, clock, t, h)
    return max(error, missed_course(scene, clock, moving, h)), good and held


@kernel(counted=False)
def missed_course(scene, clock, moving, h):
    """Error of a step of h s, over the limit, because lines followed the predicted course of the body.

    A wrong pull gives errors x = at²/2 and v = at at the end of the step. The pull of lines that only stretch is
    wrong by their part of Kx, each up to its tolerance. Together these lines change the velocity of the body by
    M⁻¹Kv h²/6 and its position by M⁻¹Kx h²/12.
    scene : `equation.Scene`; clock : `Clock` with the trial state at the end of the step; moving : (MovingLines,
        MovingWork)
    """
    lines, kept = moving
    worst, push, inverse, count = 0.0, kept.push, scene.body.mass_inverse, clock.scale.shape[0]
    shapes = scene.body.shapes.place
    for first, share in ((0, h / 12), (6, h / 6)):
        push[:] = 0.0
        for i in range(lines.number.size):
            n, pull = lines.number[i], 0.0
            if not scene.line_work.whole[n]:
                continue
            b = scene.lines.body[n]
            trial, foreseen = clock.trial[BLOCK * b + first :], kept.foreseen[b, first:]
            off = kept.room.push
            for j in range(6):
                off[j] = trial[j] - foreseen[j]
            if first == 0 and scene.body.heading[b] != 0.0:
                cos, sin = np.cos(scene.body.heading[b]), np.sin(scene.body.heading[b])
                off[0], off[1] = cos * off[0] + sin * off[1], cos * off[1] - sin * off[0]
            for j in range(6):
                pull += lines.spring[i] * lines.stretch[i, j] * off[j]
            for k in range(shapes.size):
                off_bent = clock.trial[shape_at(count, shapes[k]) + first] - kept.bent[1, first // 6, k]
                pull += lines.spring[i] * lines.stretch[i, 6 + k] * off_bent
            for j in range(6):
                push[6 * b + j] += pull * lines.stretch[i, j]
            for k in range(shapes.size):
                push[6 * count + shapes[k]] += pull * lines.stretch[i, 6 + k]
            if first == 0:
                x, y, z = scene.line_work.given[n, 0]
                tension = max(lines.tension[i], np.sqrt(x * x + y * y + z * z))
                worst = max(worst, abs(pull) / (lines.tolerance * tension))
        for i in range(push.size):
            total = 0.0
            for j in range(push.size):
                total += inverse[i, j] * push[j]
            scale = clock.scale[i // 6] if i < 6 * count else clock.bent_scale[i // 6 - count]
            worst = max(worst, share * abs(total) / scale[first + i % 6])
    return worst


@kernel(counted=False)
def put_sample(clock, b, t, h, at, out):
    """Fill out (SAMPLED,): position, velocity, slow pose and its rate of body b at a time within the step.

    Values are from Hermite polynomials; at : s
    """
    s, n = (at - t) / h, BLOCK * b
    y, z, k = clock.y[n : n + BLOCK], clock.trial[n : n + BLOCK], clock.stages[:, n : n + BLOCK]
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
    for i in range(6, SAMPLED):
        out[i] = hermite(s, y[i], z[i], h * k[0, i], h * k[6, i])


@kernel(counted=False)
def put_shapes(clock, t, h, at, out):
    """Fill out (12 G,): amplitudes of groups of shapes, and their rates, at a time within the step, s"""
    s, first = (at - t) / h, BLOCK * clock.scale.shape[0] + 6
    for i in range(out.size):
        n = first + i
        out[i] = hermite(s, clock.y[n], clock.trial[n], h * clock.stages[0, n], h * clock.stages[6, n])


@kernel(inline=True, counted=False)
def shape_at(bodies, place):
    """Index in the state of the amplitude of shape number `place` among the 6G; its rate stands six places later"""
    return BLOCK * bodies + 6 + OF_SHAPES * (place // 6) + place % 6


@kernel(counted=False)
def put_bent(clock, shapes, t, h, at, out):
    """Fill out (2, f): amplitudes of `equation.Shapes`, or None, and their rates, at a time within the step, s"""
    if shapes is None:
        return
    s = (at - t) / h
    for k in range(shapes.place.size):
        for j in range(2):
            n = shape_at(clock.scale.shape[0], shapes.place[k]) + 6 * j
            out[j, k] = hermite(s, clock.y[n], clock.trial[n], h * clock.stages[0, n], h * clock.stages[6, n])


@kernel(counted=False)
def put_buoy(clock, t, h, at, out):
    """Fill out (6,): position and velocity of a buoy at a time within the step, s"""
    s, first = (at - t) / h, BLOCK * clock.scale.shape[0]
    for i in range(out.size):
        n = first + i
        out[i] = hermite(s, clock.y[n], clock.trial[n], h * clock.stages[0, n], h * clock.stages[6, n])


@kernel(counted=False)
def hermite(s, y, z, dy, dz):
    """Cubic through values and slopes (times the step) at s = 0 and 1"""
    return y + s * (dy + s * (3 * (z - y) - 2 * dy - dz + s * (2 * (y - z) + dy + dz)))


@kernel(counted=False)
def next_break(lines, t):
    """Time of the next line break after t, s; inf for none"""
    first = np.inf
    for i in range(lines.lost.size):
        if t < lines.lost[i] < first:
            first = lines.lost[i]
    return first


@kernel(counted=False)
def open_window(waves, clock, work, owner):
    """Fill the wave forces of the next window, in which the slow pose passes from that predicted for its start to
    that for its end.

    owner : (G,), body of each group of shapes; a group meets the waves at the pose of its body
    """
    now, counts, length = clock.now, clock.counts, waves.table.window
    for b in range(clock.scale.shape[0] + owner.size):
        whose = b if b < clock.scale.shape[0] else owner[b - clock.scale.shape[0]]
        y = clock.y[BLOCK * whose : BLOCK * whose + BLOCK]
        if counts[WINDOWS] == 0:
            meet(waves, 0, y[SLOW : SLOW + 3], now[TIME], b)
        for j in range(3):
            clock.pose[j] = y[SLOW + j] + length * y[SLOW_RATE + j]
        fill_window(waves, work.window[b], counts[WINDOWS], clock.pose, now[TIME], b)
    work.span[0], work.span[1] = now[TIME], waves.table.step
    now[WINDOW] = now[TIME]
    counts[WINDOWS] += 1


@kernel(counted=False)
def advance(scene, waves, clock, samples, most, buoy, links, moving):
    """Integrate until the end, or for `most` steps; fills samples (n, SAMPLED N + 12 G, or 6 more). Returns the
    cause of its stop.

    scene : `equation.Scene`; waves : `wave_loads.Waves`; buoy, links : as in `rates`; moving : (MovingLines,
        MovingWork), or None without moving lines, whose code is then not compiled
    """
    now, counts, k, fixed = clock.now, clock.counts, clock.stages, clock.fixed_step
    lines, length = scene.lines, waves.table.window
    safety = SAFETY if moving is None else WITH_LINES
    order = 4 if clock.smooth == np.inf else 5  # in h, of the error over the limit
    again = False  # after a rejected step, as over a corner; a step cut short by a window is none
    for _ in range(most):
        t = now[TIME]
        if t >= clock.end - AT_ONCE:
            return DONE
        if t >= now[WINDOW] + length - AT_ONCE:
            open_window(waves, clock, scene.work, scene.body.shapes.owner)
            if buoy is not None:
                first = BLOCK * clock.scale.shape[0]
                open_water(waves.table, buoy[0], buoy[1], clock.y[first : first + 3], counts[WINDOWS] - 1, t)
            rates(scene, buoy, links, t, clock.y, k[0])
        limit = min(now[WINDOW] + length, clock.end, next_break(lines, t))
        h = fixed if fixed > 0.0 else now[STEP]
        cut = t + h >= limit - AT_ONCE
        if cut:
            h = limit - t
        elif t + 2.0 * h > limit and fixed == 0.0:
            h = 0.5 * (limit - t)
        if moving is None:
            error, good = take_step(scene, buoy, links, clock, t, h)
        else:
            ahead = sea_ahead(moving[0].sea)
            if h > ahead:
                h, cut = ahead, False
            sea_for_step(moving[0].sea, moving[0], moving[1], t, h)
            error, good = take_step_with_lines(scene, buoy, links, clock, moving, t, h)
        if again:
            error *= min(1.0, h / (CORNER * now[USUAL]))
        if not np.isfinite(error) or not good:
            if fixed > 0.0 or h < SHORTEST:
                if moving is not None:  # noqa: SIM102 - apart, so that nothing of it is compiled where there is none
                    if moving[1].stuck[0] >= 0:
                        return STUCK
                return NO_LINE if not good else NOT_FINITE
            counts[REFUSED] += 1
            now[STEP], again = SMALLEST * h, True
            continue
        if error > 1.0 and fixed == 0.0:
            counts[REFUSED] += 1
            again = True
            now[STEP] = h * max(SMALLEST, safety * error ** (-1 / order))
            if now[STEP] < min(SHORTEST, OF_USUAL * now[USUAL]):
                return TOO_SHORT
            continue
        later = limit if cut else t + h
        if scene.contact_work.beyond[0] >= 0:
            return BEYOND
        if links is not None:
            keep_links(scene, buoy, links, clock, t, h, later)
        settle(scene.contact_work)
        first = counts[SAMPLES]
        put_samples(clock, t, h, later, samples)
        if buoy is not None:
            keep_pulls(buoy[1], first, counts[SAMPLES])
        if moving is not None:
            for row in range(first, counts[SAMPLES]):
                put_tensions(moving[0], moving[1], row, row * clock.sample_step)
            keep_lines(moving[0], moving[1], h, scene.line_work.given)
        for i in range(clock.y.size):  # array assignment is slow to compile, see `contact_loads.settle`
            clock.y[i] = clock.trial[i]
        now[TIME] = later
        now[USUAL] += min(1.0, h / (MEMORY * now[USUAL])) * (h - now[USUAL])
        counts[STEPS] += 1
        again = False
        counts[SHORT] = counts[SHORT] + 1 if h < SHORTEST and not cut else 0
        if counts[SHORT] > AT_CORNER and fixed == 0.0:
            return TOO_SHORT
        if later == next_break(lines, t):
            hold(lines, scene.line_work, later)
            rates(scene, buoy, links, later, clock.y, k[0])
        else:
            for i in range(clock.y.size):
                k[0, i] = k[6, i]
        if not cut or error > 0.0:
            grown = h * min(LARGEST, max(SMALLEST, safety * max(error, 1e-8) ** (-1 / order)))
            now[STEP] = max(now[STEP], grown) if cut else grown
    return RUNNING


@kernel(counted=False)
def put_samples(clock, t, h, later, samples):
    """Write the samples of the step from t to `later`, s, into their rows; the last may lie beyond `later` by
    rounding.
    """
    counts = clock.counts
    while counts[SAMPLES] < samples.shape[0]:
        at = counts[SAMPLES] * clock.sample_step
        if at > later + ROUNDING * clock.sample_step:
            return
        row, bodies = samples[counts[SAMPLES]], clock.scale.shape[0]
        for b in range(bodies):
            put_sample(clock, b, t, h, at, row[SAMPLED * b : SAMPLED * b + SAMPLED])
        shapes = SAMPLED * bodies + OF_SHAPES * clock.bent_scale.shape[0]
        put_shapes(clock, t, h, at, row[SAMPLED * bodies : shapes])
        put_buoy(clock, t, h, at, row[shapes:])
        counts[SAMPLES] += 1


@kernel(counted=False)
def keep_links(scene, buoy, links, clock, t, h, later):
    """Store the forces of links at the samples of the step from t to `later`, s, which are those of `put_samples`.

    The history of fenders is restored to the end of the step.
    """
    held, kept = links
    row, k, n = clock.counts[SAMPLES], clock.stages, 0
    while row < kept.kept.shape[0] and row * clock.sample_step <= later + ROUNDING * clock.sample_step:
        s = (row * clock.sample_step - t) / h
        for i in range(kept.state.size):
            kept.state[i] = hermite(s, clock.y[i], clock.trial[i], h * k[0, i], h * k[6, i])
        rates(scene, buoy, links, t + s * h, kept.state, kept.rate)
        put_forces(held, kept, scene.work.place, kept.kept[row])
        row, n = row + 1, n + 1
    if n > 0:
        rates(scene, buoy, links, t + h, clock.trial, kept.rate)
