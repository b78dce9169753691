"""The pull of a uniform line on a moving end, starting from its solution a moment earlier; for simulations in time.

The equations are those of `flat_bed` and `suspended`.  The unknown of these equations is H of a line on the bed, or
the parameter t of a free line. It is kept between calls, with the tangent of H. The error at the start of Newton's
method is the square of the change in a step, and each iteration squares the error. After a relative change of H by
3e-6 the error is 1e-11. With T = H + rise at the fairlead and asinh(wS/H) = ln[(wS + T)/H] an iteration on the bed
takes one logarithm and two roots; where it does not converge, the safe search of `flat_bed` is used.

Lines that were on the bed at the previous moment are solved eight at a time, in vectors, by three iterations. A line
whose last change exceeds CLOSE is then solved alone, like lines in other states.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import (
    WIDTH,
    address,
    choose_less,
    exponents_and_fractions,
    load_vector,
    root,
    store_vector,
)

from .flat_bed import ROW, bed_stretch, free_length, grounded_tension, leaves_bed, solve_line
from .state import BEYOND_REACH, GROUNDED, SLACK, SUSPENDED
from .suspended import ellipse_parameter

CLOSE, CLOSE_FREE = (
    3e-6,
    1e-7,
)  # relative change of H and of ln t in the last step of Newton's method, whose error is the square of it
ROOT_2, LN_2, LN_2_REST = math.sqrt(2.0), 6.93147180369123816490e-01, 1.90821492927058770002e-10
WIDEST = 2.0  # factor by which H is allowed to change in the prediction
KEPT = 6  # numbers kept of each line: its State, H or t, and for a line on the bed span, height, ∂H/∂x, ∂H/∂h there


@kernel(inline=True)
def tension_near(kept, x, height, length, weight, flexibility, friction):
    """Return (H, wS) of a line that lies partly on the bed, from the kept tangent at a nearby position, and update
    this tangent.

    nan if Newton's method does not converge within its fixed number of iterations

    x = (H/w) asinh(wS/H) + H S/EA + (L − S) + stretch of the part on the bed
    """
    last, load = kept[1], weight * height
    H = last + kept[4] * (x - kept[2]) + kept[5] * (height - kept[3])
    H = min(max(H, last / WIDEST), last * WIDEST)
    for _ in range(6):
        s = 1.0 + flexibility * H
        rise = 2.0 * load / (s + math.sqrt(s * s + 2.0 * flexibility * load))
        held, T = math.sqrt(rise * (rise + 2.0 * H)), H + rise
        S, bend = held / weight, math.log((held + T) / H)
        lying = length - S
        if lying <= 0.0:
            return math.nan, math.nan
        stretch, by_tension, by_length, _ = bed_stretch(H, lying, weight, flexibility, friction)
        missed = x - (H * (bend / weight + flexibility * S) + lying + stretch)
        turn = flexibility * H - by_length - rise / T
        by_H = S / ((T + H) * (1.0 + flexibility * T))
        rate = by_tension + flexibility * S + (bend - held / T) / weight + turn * by_H
        step = missed / rate
        H += step
        if not H > 0.0:
            return math.nan, math.nan
        if abs(step) <= CLOSE * H:
            held += weight * by_H * step
            if held >= weight * length:
                return math.nan, math.nan
            kept[1], kept[2], kept[3], kept[4] = H, x, height, 1.0 / rate
            kept[5] = -turn * T / (held * (1.0 + flexibility * T) * rate) if held > 0.0 else 0.0
            return H, held
    return math.nan, math.nan


@kernel(inline=True, counted=False)
def logarithm(x):
    """ln of a vector of normal positive numbers, to rounding; after fdlibm (Sun Microsystems 1993)"""
    k, m = exponents_and_fractions(x)
    k, f = choose_less(m, ROOT_2, k, k + 1.0), choose_less(m, ROOT_2, m, 0.5 * m) - 1.0
    s, half = f / (2.0 + f), 0.5 * f * f
    z = s * s
    R = 1.818357216161805012e-01 + z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01)
    R = 2.857142874366239149e-01 + z * (2.222219843214978396e-01 + z * R)
    R = z * (6.666666666666735130e-01 + z * (3.999999999940941908e-01 + z * R))
    return k * LN_2 - ((half - (s * (half + R) + k * LN_2_REST)) - f)


@kernel(inline=True, counted=False)
def tensions_near(kept, lines, ends, n):
    """`pull` of lines n … n + 7 that lie partly on the bed, from the tangents kept of nearby positions

    kept : (KEPT, m) of `workspace`, updated for the lines that are solved here
    lines : (4, m) length, weight, 1/EA, friction
    ends : (4, m) given x and height, and computed H and V, which are nan for a line that must be solved alone
    """
    k, of, at, m = address(kept), address(lines), address(ends), ends.shape[1]
    length, weight, flexibility = load_vector(of, n), load_vector(of, m + n), load_vector(of, 2 * m + n)
    rough = weight * load_vector(of, 3 * m + n)
    by_weight, by_rough = 1.0 / weight, 1.0 / rough  # few divisions: each takes as long as several products
    x, height, last = load_vector(at, n), load_vector(at, m + n), load_vector(k, m + n)
    load = weight * height
    H = last + load_vector(k, 4 * m + n) * (x - load_vector(k, 2 * m + n))
    H = H + load_vector(k, 5 * m + n) * (height - load_vector(k, 3 * m + n))
    H = choose_less(H, last / WIDEST, last / WIDEST, choose_less(last * WIDEST, H, last * WIDEST, H))
    held = step = by_rate = turn = grown = by_H = lying = H
    for _ in range(3):  # two are not enough from one sample of a record to the next
        s = 1.0 + flexibility * H
        rise = 2.0 * load / (s + root(s * s + 2.0 * flexibility * load))
        held, T = root(rise * (rise + 2.0 * H)), H + rise
        S, bend = held * by_weight, logarithm((held + T) / H)
        lying = length - S
        most = rough * lying
        pulled = choose_less(H, most, H * by_rough, lying)
        stretch = flexibility * pulled * (H - 0.5 * rough * pulled)
        missed = x - (H * (bend * by_weight + flexibility * S) + lying + stretch)
        grown = 1.0 + flexibility * T
        sum_grown = (T + H) * grown
        both = 1.0 / (T * sum_grown)
        by_T, by_H = sum_grown * both, S * T * both
        turn = flexibility * (H - choose_less(H, most, 0.0, H - most)) - rise * by_T
        by_rate = 1.0 / (flexibility * (pulled + S) + (bend - held * by_T) * by_weight + turn * by_H)
        step = missed * by_rate
        H = H + step
    by_height = choose_less(0.0, held, -turn * T / (held * grown) * by_rate, 0.0)
    held = held + weight * by_H * step
    hanging = 2.0 * height / (1.0 + root(1.0 + 2.0 * flexibility * load))
    good = choose_less(choose_less(step, 0.0, -step, step), CLOSE * H, 1.0, 0.0 * H)
    good = choose_less(0.0, lying, choose_less(held, weight * length, good, 0.0), 0.0)
    good = choose_less(length - hanging, x, choose_less(height, 0.0, 0.0, good), 0.0)
    for row, value in ((1, H), (2, x), (3, height), (4, by_rate), (5, by_height)):
        store_vector(k, row * m + n, choose_less(0.0, good, value, load_vector(k, row * m + n)))
    store_vector(at, 2 * m + n, choose_less(0.0, good, H, math.nan))
    store_vector(at, 3 * m + n, choose_less(0.0, good, held, math.nan))


@kernel(inline=True)
def pull_anew(before, near, x, height, length, weight, flexibility, friction):
    """Return (State, H, V, H or t) of a line that is not slack: partly on the bed, or free; near : earlier t of a
    free line, or 0
    """
    if before == GROUNDED or not leaves_bed(x, height, length, weight, flexibility):
        H = grounded_tension(x, 0.0, height, length, weight, flexibility, friction)
        hanging = free_length(H, height, weight, flexibility)
        if hanging < length:
            return GROUNDED, H, weight * hanging, H
    X, Z, kappa = x / length, height / length, 0.5 * flexibility * weight * length
    t = ellipse_parameter(X, Z, kappa, near, CLOSE_FREE)
    if math.isinf(t):
        return BEYOND_REACH, math.nan, math.nan, t
    root, half = math.sqrt(1.0 + t * t), 0.5 * weight * length
    cosine = min(max(Z / (1.0 + kappa * root), -1.0), 1.0)
    sine = min(X / (t * (math.asinh(1.0 / t) + kappa)), 1.0) if X > 0.0 else 0.0
    return SUSPENDED, half * t * sine, half * (1.0 + root * cosine), t


@kernel(inline=True)
def pull(kept, x, height, length, weight, flexibility, friction):
    """Forces (H, V), N, towards the anchor and down, on an end `height` above the anchor on the bed and x away from it.

    kept : (KEPT,) from an earlier call for this line, zeros before the first; updated for the next call

    The forces are nan if the end is beyond the reach of the line or below the bed.
    """
    H = V = math.nan
    before, state = kept[0], BEYOND_REACH
    if height >= 0.0:
        V = 2.0 * weight * height / (1.0 + math.sqrt(1.0 + 2.0 * flexibility * weight * height))
        if length - V / weight >= x:
            state, H = SLACK, 0.0
        else:
            if before == GROUNDED:
                H, V = tension_near(kept, x, height, length, weight, flexibility, friction)
            state = GROUNDED
            if math.isnan(H):
                near = kept[1] if before == SUSPENDED else 0.0
                state, H, V, kept[1] = pull_anew(before, near, x, height, length, weight, flexibility, friction)
                kept[2], kept[3], kept[4], kept[5] = x, height, 0.0, 0.0
    kept[0] = state
    return H, V


@kernel(inline=True)
def pull_of_any(kept, row, x, low, high, bed, length, weight, flexibility, friction):
    """Forces (H, V) on the end at z = `high` of a line whose other end, at z = `low`, is fixed on the bed or above it.

    row : (ROW,) memory for results. `pull` solves a line heavier than water with its anchor on the bed
    """
    if weight > 0.0 and low == bed:
        H, V = pull(kept, x, high - bed, length, weight, flexibility, friction)
        row[0] = kept[0]
    else:
        sinks = weight > 0.0
        a, b = (low - bed, high - bed) if sinks else (-low, -high)
        solve_line(row, x, a, b, length, abs(weight), flexibility, 0.0, sinks)
        H, V = row[2], row[4] if sinks else -row[4]
    kept[0] = row[0]
    return (H, V) if kept[0] < BEYOND_REACH else (math.nan, math.nan)


@kernel()
def pulls(kept, rows, x, low, high, bed, lines, out):
    """`pull_of_any` of lines (n, 4), each with length, weight, 1/EA and friction; the results fill out (n, 2)"""
    for i in range(x.size):
        length, weight, flexibility, friction = lines[i]
        out[i, 0], out[i, 1] = pull_of_any(
            kept[:, i], rows[i], x[i], low[i], high[i], bed, length, weight, flexibility, friction
        )


def workspace(count):
    """kept (KEPT, m ≥ n), whole vectors of lines, and rows (n, ROW) for lines without earlier results"""
    return np.zeros((KEPT, -(-count // WIDTH) * WIDTH)), np.zeros((count, ROW))
