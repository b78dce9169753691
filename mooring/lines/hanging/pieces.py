"""Kernels that walk down a line piece by piece: a free piece in closed form, a piece on a straight bed in closed form.

A walk starts at the fairlead and goes down.  Its state q holds H, V (the pull of the line above on the line below,
towards the fairlead and up), x, z, s (unstretched length from the anchor), T and the angle φ, the last two where the
line touches the bed.  Row i of g holds the derivatives of q[i] with respect to as many unknowns as it has columns.

Free (SR179 report, 1982, section 3.1.1, integrated), with the strain λ − 1 + T/EA of one piece of the tension table:

    Δx = H Δs/EA + λ (H/w) [asinh(V/H) − asinh(V₋/H)],    Δz = (V² − V₋²)/2wEA + λ (T − T₋)/w,    V₋ = V − w Δs

On a bed of slope β, going down: T₋ = T − w (sin β ± μ cos β) Δs; plus where the line is being pulled towards the
fairlead, minus where it gives way, and neither where the tension it was left with lies between the two.
Over a knuckle T changes by exp(∓μ × turning), the limit of the same law on a rounded bed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from bem.jit import kernel

H, V, X, Z, S, T, PHI = range(7)
SUBMERGED, FLOATING, EMERGED = 0, 1, 2


class LineData(NamedTuple):
    """What the kernels know of a line; lengths m, forces N, from the anchor up.

    joint : (n+1,) s of the segment ends; weight : (n,) N/m
    first_knot : (n+1,) rows of each segment in knot_tension, knot_factor (λ), knot_flexibility (1/EA)
    load_s, load_wet, load_dry : (m,) position and weight of point loads, under water and out of it
    lowest_buoy : index of the first load with negative weight, m if there is none
    surface : z of the sea; soft : height over which a buoy emerges while states are sought, m
    bed_x, bed_z : (k,) left ends of the facets, the first is the anchor; bed_angle : (k,) rad
    gentlest : (k,) the smallest tan β of a facet and those before it; no_bed : the anchor is all there is
    friction : μ; least : the smallest pull of a free span, N
    left : (j, 4) rows of s₀, s₁, T₀, T₁ left on the bed by an earlier position, downwards
    """

    joint: np.ndarray
    weight: np.ndarray
    first_knot: np.ndarray
    knot_tension: np.ndarray
    knot_factor: np.ndarray
    knot_flexibility: np.ndarray
    load_s: np.ndarray
    load_wet: np.ndarray
    load_dry: np.ndarray
    lowest_buoy: int
    surface: float
    soft: float
    bed_x: np.ndarray
    bed_z: np.ndarray
    bed_angle: np.ndarray
    gentlest: np.ndarray
    no_bed: bool
    friction: float
    least: float
    left: np.ndarray


@kernel()
def mix(g, row, a, i, b, j):
    """g[row] = a g[i] + b g[j]; loops, because array expressions cost seconds to compile."""
    for k in range(g.shape[1]):
        g[row, k] = a * g[i, k] + b * g[j, k]


@kernel()
def free_step(q, g, ds, gds, weight, factor, flexibility):
    """Go down a free piece of length ds; gds are its derivatives."""
    h, v = q[H], q[V]
    low = v - weight * ds
    upper, lower = math.hypot(h, v), math.hypot(h, low)
    mean = (v + low) / (upper + lower)
    # V₋ + T₋ without cancellation where the lower end points down
    base = low + lower if low >= 0 else h * (h / (lower - low))
    ratio = weight * ds * (1 + mean) / base
    bend = math.log1p(ratio) if ratio > -0.5 else math.log((v + upper) / base)
    q[X] -= h * (flexibility * ds + factor * bend / weight)
    q[Z] -= ds * (0.5 * flexibility * (v + low) + factor * mean)
    q[V] = low
    q[S] -= ds
    if g.shape[1] == 0:
        return
    if v * low > 0:
        turn = h * h * (v + low) * weight * ds / ((v * lower + low * upper) * upper * lower)
    else:
        turn = v / upper - low / lower
    x_h = flexibility * ds + factor * (bend - turn) / weight
    x_v = -factor * h * ds * mean / (upper * lower)
    z_v = flexibility * ds + factor * turn / weight
    stretch = factor / lower + flexibility
    for i in range(g.shape[1]):
        gh, gv = g[H, i], g[V, i]
        g[X, i] -= x_h * gh + x_v * gv + stretch * h * gds[i]
        g[Z, i] -= x_v * gh + z_v * gv + stretch * low * gds[i]
        g[V, i] -= weight * gds[i]
        g[S, i] -= gds[i]


@kernel()
def strain_piece(line, segment, tension, falling):
    """Row of the tension table that holds just below (falling) or just above `tension`."""
    row = line.first_knot[segment]
    tension *= 1 - 1e-12 if falling else 1 + 1e-12
    while row + 1 < line.first_knot[segment + 1] and line.knot_tension[row + 1] <= tension:
        row += 1
    return row


@kernel()
def free_knot(line, q, segment):
    """Row of the tension table of a free piece, and the length until it changes."""
    first, last = line.first_knot[segment], line.first_knot[segment + 1] - 1
    if first == last:
        return first, math.inf
    h, v = q[H], q[V]
    row = strain_piece(line, segment, math.hypot(h, v), v > 0)
    if v > 0 and line.knot_tension[row] > h:
        end = math.sqrt(line.knot_tension[row] ** 2 - h * h)
        return row, max(v - end, 0.0) / line.weight[segment]
    if row == last or line.knot_tension[row + 1] <= h:
        return row, math.inf
    end = -math.sqrt(line.knot_tension[row + 1] ** 2 - h * h)
    return row, max(v - end, 0.0) / line.weight[segment]


@kernel()
def next_stop(line, at):
    """s of the next load or joint below, and whether it is a load; the lowest segment goes on below the anchor."""
    stop, is_load = -math.inf, False
    if at[0] > 0:
        stop = line.joint[at[0]]
    if at[1] >= 0 and line.load_s[at[1]] >= stop:
        stop, is_load = line.load_s[at[1]], True
    return stop, is_load


@kernel()
def soft_weight(line, load, z):
    """Weight of a point load at the height z, a buoy losing its lift over a small height; and its state."""
    wet, dry = line.load_wet[load], line.load_dry[load]
    if wet >= 0 or z <= line.surface - line.soft:
        return wet, SUBMERGED
    if z >= line.surface:
        return dry, EMERGED
    share = (line.surface - z) / line.soft
    return share * wet + (1 - share) * dry, FLOATING


@kernel()
def kept_tension(line, s):
    """Tension left at s by an earlier position, its slope dT/ds, and the s down to which that holds.

    Without history the tension was as low as can be; where the line was off the bed it lands giving way.
    """
    if line.left.shape[0] == 0:
        return -math.inf, 0.0, -math.inf
    slack = 1e-12 * line.joint[-1]
    for j in range(line.left.shape[0]):
        s0, s1, t0, t1 = line.left[j]
        if s > s1 + slack:
            return math.inf, 0.0, s1
        if s > s0 + slack:
            slope = (t1 - t0) / (s1 - s0)
            return t1 + slope * (min(s, s1) - s1), slope, s0
    return math.inf, 0.0, -math.inf


@kernel()
def held(line, q, g, low, high, g_low, g_high):
    """Tension below a concentrated reaction: the one left there, kept between low and high; g_… in rows of g[T]."""
    kept, slope, _ = kept_tension(line, q[S] - 1e-9 * line.joint[-1])
    if low <= kept <= high:
        q[T] = kept
        mix(g, T, slope, S, 0.0, T)
        return
    q[T] = max(low if kept < low else high, 0.0)
    for i in range(g.shape[1]):
        slope = g_low[i] if kept < low else g_high[i]
        g[T, i] = slope if q[T] > 0 else 0.0


@kernel()
def drop_load(line, q, g, angle, weight, g_weight):
    """Pass a weight that rests on the bed; g_weight : its derivatives."""
    along, across = math.sin(angle), line.friction * math.cos(angle)
    pull, give = along + across, along - across
    g_low, g_high = np.empty(g.shape[1]), np.empty(g.shape[1])
    for i in range(g.shape[1]):
        g_low[i], g_high[i] = g[T, i] - pull * g_weight[i], g[T, i] - give * g_weight[i]
    held(line, q, g, q[T] - pull * weight, q[T] - give * weight, g_low, g_high)


@kernel()
def turn_knuckle(line, q, g, angle, unknown):
    """Pass a knuckle from the angle φ to `angle`, which is the given unknown or, below 0, none.

    The tension may change by exp(∓μ × turning).
    """
    grip = math.exp(-line.friction * (angle - q[PHI]))
    if line.friction > 0:
        g_low, g_high = np.empty(g.shape[1]), np.empty(g.shape[1])
        for i in range(g.shape[1]):
            slope = q[T] * line.friction * ((1.0 if i == unknown else 0.0) - g[PHI, i])
            g_low[i], g_high[i] = grip * (g[T, i] - slope), (g[T, i] + slope) / grip
        held(line, q, g, grip * q[T], q[T] / grip, g_low, g_high)
    q[PHI] = angle
    mix(g, PHI, 0.0, T, 0.0, T)
    if unknown >= 0:
        g[PHI, unknown] = 1.0


@kernel()
def friction_rate(line, q, weight, angle):
    """dT/ds on the bed, the length for which it holds, and the tension met at its end (nan: no meeting)."""
    along, across = weight * math.sin(angle), weight * line.friction * math.cos(angle)
    kept, slope, until = kept_tension(line, q[S])
    room = q[S] - until
    t = q[T]
    if abs(t - kept) <= 1e-13 * (abs(t) + weight * line.joint[-1]):
        return slope, room, math.nan
    rate = along + across if t > kept else along - across
    closing = (t - kept) / (rate - slope) if math.isfinite(kept) else math.inf
    if 0 < closing < room:
        return rate, closing, kept - slope * closing
    return rate, room, math.nan


@kernel()
def bed_step(q, g, ds, gds, rate, factor, flexibility, angle):
    """Go down a piece on the bed of length ds."""
    t = q[T]
    moved = ds * (factor + flexibility * (t - 0.5 * rate * ds))
    cos, sin = math.cos(angle), math.sin(angle)
    q[X] -= moved * cos
    q[Z] -= moved * sin
    q[T] = t - rate * ds
    q[S] -= ds
    for i in range(g.shape[1]):
        slid = (factor + flexibility * q[T]) * gds[i] + flexibility * ds * g[T, i]
        g[X, i] -= slid * cos
        g[Z, i] -= slid * sin
        g[T, i] -= rate * gds[i]
        g[S, i] -= gds[i]


@kernel()
def length_for(distance, t, rate, factor, flexibility):
    """Unstretched length of a piece on the bed that covers a distance, inf where it cannot."""
    a = factor + flexibility * t
    inside = a * a - 2 * flexibility * rate * distance
    return 2 * distance / (a + math.sqrt(inside)) if inside > 0 else math.inf


@kernel()
def bed_piece(line, q, g, at, angle):
    """dT/ds, λ, 1/EA of the line on the bed here; how far they hold; why no further; the tension met there."""
    segment = at[0]
    rate, ds, meeting = friction_rate(line, q, line.weight[segment], angle)
    if q[T] <= 0 and rate > 0:
        q[T], rate = 0.0, 0.0
        mix(g, T, 0.0, T, 0.0, T)
    row = strain_piece(line, segment, q[T], rate > 0)
    why = 0 if math.isnan(meeting) else 1
    if rate > 0:
        room = (q[T] - line.knot_tension[row]) / rate
        if room < ds:
            ds, why = room, 0 if line.knot_tension[row] > 0 else 2
    elif rate < 0 and row + 1 < line.first_knot[segment + 1]:
        room = (q[T] - line.knot_tension[row + 1]) / rate
        if room < ds:
            ds, why = room, 0
    return rate, line.knot_factor[row], line.knot_flexibility[row], ds, why, meeting


@kernel()
def crawl(line, q, g, at, facet, amount, unknown, rows):
    """Go down along a facet by a length, or to its lower end where `amount` is infinite.  Stops at a buoy.

    unknown : which unknown the length is, below 0 for none; rows : see `record`
    """
    angle = line.bed_angle[facet]
    cos = math.cos(angle)
    target = q[S] - amount
    gds, g_target = np.empty(g.shape[1]), np.empty(g.shape[1])
    for i in range(g.shape[1]):
        g_target[i] = g[S, i] - (1.0 if i == unknown else 0.0)
    for _ in range(10_000):
        rate, factor, flexibility, ds, why, meeting = bed_piece(line, q, g, at, angle)
        stop, is_load = next_stop(line, at)
        if q[S] - stop <= ds:
            ds, why = q[S] - stop, 3
        end = q[S] - target
        if math.isinf(amount):
            end = length_for((q[X] - line.bed_x[facet]) / cos, q[T], rate, factor, flexibility)
        if end <= ds:
            ds, why = end, 4
        low_stretch = factor + flexibility * (q[T] - rate * ds)
        for i in range(g.shape[1]):
            gds[i] = 0.0
            if why == 3:
                gds[i] = g[S, i]
            elif why == 4 and math.isinf(amount):
                gds[i] = (g[X, i] / cos - flexibility * ds * g[T, i]) / low_stretch
            elif why == 4:
                gds[i] = g[S, i] - g_target[i]
        record(rows, at, 1.0, q, ds, rate, line.weight[at[0]], factor, flexibility, angle)
        bed_step(q, g, ds, gds, rate, factor, flexibility, angle)
        if why == 1:
            q[T] = meeting
            mix(g, T, kept_tension(line, q[S])[1], S, 0.0, T)
        elif why == 2:
            q[T] = 0.0
            mix(g, T, 0.0, T, 0.0, T)
        elif why == 3:
            q[S] = stop
            if not is_load:
                at[0] -= 1
            elif line.load_wet[at[1]] < 0:
                return
            else:
                at[1] -= 1
                gds[:] = 0.0
                drop_load(line, q, g, angle, line.load_wet[at[1] + 1], gds)
        elif why == 4:
            return


@kernel()
def record(rows, at, kind, q, ds, rate, weight, factor, flexibility, angle):
    """Keep a piece: kind (0 free, 1 on the bed), s, ds, x, z, H or T, V or rate, w, λ, 1/EA, β."""
    if at[2] < rows.shape[0]:
        row = rows[at[2]]
        row[0], row[1], row[2], row[3], row[4] = kind, q[S], ds, q[X], q[Z]
        row[5], row[6] = (q[T], rate) if kind == 1.0 else (q[H], q[V])
        row[7], row[8], row[9], row[10] = weight, factor, flexibility, angle
        at[2] += 1


@kernel()
def land(line, q, g, at, facet):
    """Put a line that arrives tangentially, or with a sinker partly carried by the bed, on a facet."""
    angle = line.bed_angle[facet]
    cos, tan = math.cos(angle), math.tan(angle)
    q[T], q[PHI] = q[H] / cos, angle
    mix(g, T, 1 / cos, H, 0.0, H)
    mix(g, PHI, 0.0, H, 0.0, H)
    load = at[1]
    if load >= 0 and q[S] == line.load_s[load] and line.load_wet[load] > 0:
        at[1] -= 1
        g_carried = np.empty(g.shape[1])
        for i in range(g.shape[1]):
            g_carried[i] = tan * g[H, i] - g[V, i]
        drop_load(line, q, g, angle, q[H] * tan - (q[V] - line.load_wet[load]), g_carried)
    q[Z] = line.bed_z[facet] + (q[X] - line.bed_x[facet]) * tan
    mix(g, Z, tan, X, 0.0, X)


@kernel()
def carried(line, q, facet):
    """How hard a sinker that a span ends in presses on a facet if the line below lies on it; N across the facet."""
    angle = line.bed_angle[facet]
    return (q[H] * math.tan(angle) - q[V] + line.load_wet[line_load(line, q)]) * math.cos(angle)


@kernel()
def line_load(line, q):
    """Index of the point load at s."""
    for load in range(line.load_s.size):
        if line.load_s[load] == q[S]:
            return load
    return 0


@kernel()
def rest_sinker(line, q, g, at, facet, pressure, unknown):
    """Pass a sinker that only touches a facet, with a free span on either side: N on the bed is the given unknown."""
    angle = line.bed_angle[facet]
    along = math.sin(angle) + line.friction * math.cos(angle)
    across = math.cos(angle) - line.friction * math.sin(angle)
    q[H] -= pressure * along
    q[V] += pressure * across - line.load_wet[at[1]]
    if unknown >= 0:
        g[H, unknown] -= along
        g[V, unknown] += across
    at[1] -= 1
    q[Z] = line.bed_z[facet] + (q[X] - line.bed_x[facet]) * math.tan(angle)
    mix(g, Z, math.tan(angle), X, 0.0, X)


@kernel()
def pin(line, q, g, vertex):
    """Put the line on a point of the bed; T and φ from H and V."""
    q[X], q[Z] = line.bed_x[vertex], line.bed_z[vertex]
    mix(g, X, 0.0, H, 0.0, H)
    mix(g, Z, 0.0, H, 0.0, H)
    q[T], q[PHI] = math.hypot(q[H], q[V]), math.atan2(q[V], q[H])
    mix(g, T, q[H] / q[T], H, q[V] / q[T], V)
    mix(g, PHI, -q[V] / q[T] ** 2, H, q[H] / q[T] ** 2, V)


@kernel()
def leave(line, q, g):
    """Leave the bed with tension T at the angle φ; T is kept above 0, for spans that stand plumb on a buoy."""
    if q[T] < line.least:
        q[T] = line.least
        mix(g, T, 0.0, T, 0.0, T)
    cos, sin = math.cos(q[PHI]), math.sin(q[PHI])
    q[H], q[V] = q[T] * cos, q[T] * sin
    mix(g, H, cos, T, -q[V], PHI)
    mix(g, V, sin, T, q[H], PHI)
