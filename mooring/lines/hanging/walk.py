"""Kernels that find where a line of given horizontal tension touches the bed: a walk from the fairlead to the anchor.

For a given tension at the fairlead the walk has one way to go.  A free span falls lower the steeper it starts, so
the start at which it first touches something is a bracketed root; from there the line lies on the bed until a span
that leaves it, at a point or at the angle within a knuckle, would no longer clear the bed further down: again the
later or the steeper it leaves, the lower it hangs.  The length left over when the anchor is reached grows with the
tension, and has one root too.  SR179 report (1982), section 3.1.3, gives the same rules for nodes of a line.

The walk is recorded as steps; `newton` solves their equations together.
"""

from __future__ import annotations

import math

import numpy as np

from bem.jit import kernel

from .pieces import (
    PHI,
    SUBMERGED,
    H,
    S,
    V,
    X,
    Z,
    carried,
    crawl,
    free_knot,
    free_step,
    land,
    leave,
    next_stop,
    pin,
    rest_sinker,
    soft_weight,
    turn_knuckle,
)

# steps of a walk: a span to a facet, knuckle or the anchor; along a facet to its end or to a lift-off;
# over a knuckle onto the next facet or into the air; the anchor reached on the bed; a sinker between two spans
NONE, TO_FACET, TO_KNUCKLE, TO_ANCHOR, ALONG, LIFT, TURN, SPRING, REST, SINKER = range(10)
FROM_FAIRLEAD, FROM_FACET, FROM_KNUCKLE, FROM_SINKER = (
    0.0,
    1.0,
    2.0,
    3.0,
)  # numba compiles anew for literal integers
NOTHING = -1


@kernel()
def length_to(q, x, weight, factor, flexibility):
    """Length of a free piece down to the abscissa x: Newton on u = asinh(V₋/H), in which Δx is convex."""
    h = q[H]
    start = math.asinh(q[V] / h)
    target = (q[X] - x) * weight / h
    pull = flexibility * h
    u = start - target / (factor + pull * math.cosh(start)) if abs(start) < 300 else start - target / factor
    # a span that rises to e^100 times H before it gets to x stops short of it: it clears the bed by far
    low, high = max(start - target / factor, min(start, 0.0) - 100.0), start
    u = min(max(u, low), high)
    for _ in range(60):
        # sinh a − sinh b without cancellation
        rise = 2 * math.cosh(0.5 * (start + u)) * math.sinh(0.5 * (start - u))
        value = factor * (start - u) + pull * rise - target
        if value > 0:
            low = u
        else:
            high = u
        following = u + value / (factor + pull * math.cosh(u))
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - u) <= 1e-15 * max(abs(start), abs(u)):
            break
        u = following
    return h / weight * 2 * math.cosh(0.5 * (start + u)) * math.sinh(0.5 * (start - u))


@kernel()
def facet_under(line, x):
    """Facet over which the abscissa x lies; the last one goes on for ever."""
    facet = line.bed_x.size - 1
    while facet > 0 and line.bed_x[facet] >= x:
        facet -= 1
    return facet


@kernel()
def clears(line, q, at, facet):
    """Whether nothing further down can touch a line that is above `facet` now."""
    if at[1] >= line.lowest_buoy:
        return False
    if line.no_bed:
        return q[V] <= 0 and q[Z] >= line.bed_z[0]
    return q[V] <= q[H] * line.gentlest[facet]


@kernel()
def span_down(line, q, at, facet, states):
    """Walk a free span to the first thing it would go through.

    returns : gap (m, across the line; negative where it goes through), step, index; q and at stand there
    """
    g = np.empty((7, 0))
    gds = np.empty(0)
    value = 1.0
    for _ in range(10_000):
        if clears(line, q, at, facet):
            return value, NONE, 0
        weight = line.weight[at[0]]
        row, knot = free_knot(line, q, at[0])
        factor, flexibility = line.knot_factor[row], line.knot_flexibility[row]
        stop, is_load = next_stop(line, at)
        tan = math.tan(line.bed_angle[facet]) if not line.no_bed else -math.inf
        steeper = q[V] - q[H] * tan
        # a span that has just left a facet is parallel to it but for rounding
        touch = steeper / weight if 1e-13 * math.hypot(q[H], q[V]) < steeper < math.inf else math.inf
        ds = min(q[S] - stop, touch, knot)
        x, z, v, s = q[X], q[Z], q[V], q[S]
        if math.isfinite(ds):
            free_step(q, g, ds, gds, weight, factor, flexibility)
        if not math.isfinite(ds) or q[X] <= line.bed_x[facet]:
            q[X], q[Z], q[V], q[S] = x, z, v, s
            ds = length_to(q, line.bed_x[facet], weight, factor, flexibility)
            free_step(q, g, ds, gds, weight, factor, flexibility)
            q[X] = line.bed_x[facet]
            value = (q[Z] - line.bed_z[facet]) * q[H] / math.hypot(q[H], q[V])
            if facet == 0:
                return value, TO_ANCHOR, 0
            if value < 0:
                return value, TO_KNUCKLE, facet
            facet -= 1
        elif ds == touch:
            q[V] = q[H] * tan
            value = (q[Z] - line.bed_z[facet] - (q[X] - line.bed_x[facet]) * tan) * math.cos(line.bed_angle[facet])
            if value < 0:
                return value, TO_FACET, facet
        elif ds == q[S] - stop or s - ds <= stop:
            q[S] = stop
            if not is_load:
                at[0] -= 1
                continue
            force, state = soft_weight(line, at[1], q[Z])
            states[at[1]] = state
            if not line.no_bed and q[V] > q[H] * tan >= q[V] - force:
                value = (q[Z] - line.bed_z[facet] - (q[X] - line.bed_x[facet]) * tan) * math.cos(line.bed_angle[facet])
                if value < 0:
                    return value, TO_FACET, facet
            q[V] -= force
            at[1] -= 1
    return value, NONE, 0


@kernel()
def start_span(line, origin, q, at, facet, amount):
    """Set a span off: V at the fairlead, length along a facet, angle at a knuckle, or how hard a sinker presses."""
    g, rows = np.empty((7, 0)), np.empty((0, 11))
    if origin == FROM_FAIRLEAD:
        q[V] = amount
        return facet
    if origin == FROM_FACET:
        crawl(line, q, g, at, facet, amount, NOTHING, rows)
        leave(line, q, g)
        return facet
    if origin == FROM_SINKER:
        rest_sinker(line, q, g, at, facet, amount, NOTHING)
        return facet
    turn_knuckle(line, q, g, amount, NOTHING)
    leave(line, q, g)
    return facet - 1


@kernel()
def try_span(line, origin, q0, at0, facet, amount, q, at, states):
    q[:] = q0
    at[:] = at0
    facet = start_span(line, origin, q, at, facet, amount)
    return span_down(line, q, at, facet, states)


@kernel()
def first_touch(line, origin, q, at, facet, low, high, states):
    """Start of the span that just touches; it is free at `low` and goes through something at `high`.

    q, at : left where it touches.  returns : start, step, index
    """
    q0, at0 = q.copy(), at.copy()
    f_low = try_span(line, origin, q0, at0, facet, low, q, at, states)[0]
    f_high, step, index = try_span(line, origin, q0, at0, facet, high, q, at, states)
    side = 0
    for trial in range(200):
        least = 4e-16 * (abs(high) + abs(low))
        if high - low <= 4 * least:
            break
        middle = 0.5 * (low + high)
        if trial % 4 != 3 and f_low > f_high:
            # a step towards the far end as soon as the near one stands on the root
            middle = min(max(low + (high - low) * f_low / (f_low - f_high), low + least), high - least)
        value, found, where = try_span(line, origin, q0, at0, facet, middle, q, at, states)
        if value < 0:
            high, f_high, step, index = middle, value, found, where
            f_low = 0.5 * f_low if side == 1 else f_low
            side = 1
        else:
            low, f_low = middle, value
            f_high = 0.5 * f_high if side == -1 else f_high
            side = -1
    try_span(line, origin, q0, at0, facet, high, q, at, states)
    return high, step, index


@kernel()
def start_range(line, q, facet, lift):
    """V at the fairlead between which the first span goes from clear of everything to through the bed."""
    slope = (q[Z] - line.bed_z[0]) / (q[X] - line.bed_x[0])
    for i in range(1, facet + 1):
        slope = min(slope, (q[Z] - line.bed_z[i]) / (q[X] - line.bed_x[i]))
    low = q[H] * slope - lift
    return low - 1e-9 * abs(low), low + lift + q[H] + line.weight.max() * (
        abs(q[Z] - line.bed_z[0]) + 1e-3 * line.joint[-1]
    )


@kernel()
def walk(line, horizontal, x, z, steps, unknowns, states):
    """Walk from the fairlead (x, z) with the pull `horizontal` to the anchor.

    steps : (…, 3) room for step, facet or knuckle, next load; unknowns : (…,) room for their starts, H and V first
    returns : number of steps, number of unknowns, length left over at the anchor (m; negative: length missing),
              V at the fairlead; no steps where the bed is not met
    """
    q = np.zeros(7)
    at = np.array([line.weight.size - 1, line.load_s.size - 1, 0])
    q[H], q[X], q[Z], q[S] = horizontal, x, z, line.joint[-1]
    g, none = np.empty((7, 0)), np.empty((0, 11))
    lift = -np.minimum(line.load_wet, 0.0).sum()
    facet = facet_under(line, x)
    low, high = start_range(line, q, facet, lift)
    states[:] = SUBMERGED
    trial, tried = q.copy(), at.copy()
    for _ in range(200):
        if try_span(line, FROM_FAIRLEAD, q, at, facet, high, trial, tried, states)[0] < 0:
            break
        high = low + 4 * (high - low)
    V_top, step, index = first_touch(line, FROM_FAIRLEAD, q, at, facet, low, high, states)
    unknowns[0], unknowns[1] = horizontal, V_top
    count, known, before = 0, 2, line.joint[-1]
    while count + 3 < steps.shape[0] and known + 2 < unknowns.size:
        if step == NONE:
            return 0, 0, math.nan, V_top
        steps[count] = step, index, at[1]
        count += 1
        if step == TO_ANCHOR:
            return count, known, q[S], V_top
        if step == TO_FACET:
            facet, on_facet = index, True
            if at[1] >= 0 and q[S] == line.load_s[at[1]] and line.load_wet[at[1]] > 0:
                press = carried(line, q, facet)
                if try_span(line, FROM_SINKER, q, at, facet, press, trial, tried, states)[0] < 0:
                    before = q[S]
                    press, step, index = first_touch(line, FROM_SINKER, q, at, facet, 0.0, press, states)
                    steps[count] = SINKER, facet, 0
                    unknowns[known] = press
                    count += 1
                    known += 1
                    continue
            land(line, q, g, at, facet)
        else:
            pin(line, q, g, index)
            unknowns[known] = before - q[S]
            known += 1
            facet, on_facet = index, False
        leaving = False
        while not leaving and count + 3 < steps.shape[0]:
            if on_facet:
                q0, at0 = q.copy(), at.copy()
                crawl(line, q, g, at, facet, math.inf, NOTHING, none)
                reached = q0[S] - q[S]
                at_buoy = at[1] >= 0 and line.load_wet[at[1]] < 0 and q[S] == line.load_s[at[1]]
                if facet == 0 and not at_buoy:
                    steps[count] = REST, 0, 0
                    return count + 1, known, q[S], V_top
                q[X] = line.bed_x[facet] if not at_buoy else q[X]
                gap = -1.0
                if not at_buoy:
                    q[Z] = line.bed_z[facet]
                    trial[:] = q
                    tried[:] = at
                    leave(line, trial, g)
                    gap = span_down(line, trial, tried, facet - 1, states)[0]
                if gap < 0:
                    q[:] = q0
                    at[:] = at0
                    before = q[S]
                    length, step, index = first_touch(line, FROM_FACET, q, at, facet, 0.0, reached, states)
                    steps[count] = LIFT, facet, 0
                    unknowns[known] = length
                    known += 1
                    before -= length
                    leaving = True
                else:
                    steps[count] = ALONG, facet, 0
                    on_facet = False
            else:
                lower = line.bed_angle[facet - 1]
                before = q[S]
                gap = try_span(line, FROM_KNUCKLE, q, at, facet, lower, trial, tried, states)[0]
                if gap < 0:
                    low_angle = q[PHI]
                    angle, step, index = first_touch(line, FROM_KNUCKLE, q, at, facet, low_angle, lower, states)
                    steps[count] = SPRING, facet, 0
                    unknowns[known] = angle
                    known += 1
                    leaving = True
                else:
                    steps[count] = TURN, facet, 0
                    turn_knuckle(line, q, g, lower, NOTHING)
                    facet -= 1
                    on_facet = True
            count += 1
    return 0, 0, math.nan, V_top
