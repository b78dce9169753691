"""Kernels that find what a free span touches first.

A span hangs lower the steeper it starts, the later it leaves a facet and the harder its sinker presses on the bed, so
the start at which it just touches something is a bracketed root.
"""

from __future__ import annotations

import math

import numpy as np

from bem.kernels.jit import kernel

from .crawl import crawl, rest_sinker
from .free_span import free_knot, free_step, length_to, soft_weight
from .friction import leave, turn_knuckle
from .line_data import NOTHING, H, S, V, X, Z, copy_state, next_stop

# steps of a walk: a span to a facet, knuckle or the anchor; along a facet to its end, to a lift-off or to a sinker;
# over a knuckle onto the next facet or into the air; the anchor reached on the bed; a sinker with a span below it
NONE, TO_FACET, TO_KNUCKLE, TO_ANCHOR, ALONG, LIFT, TURN, SPRING, REST, SINKER, HALT = np.arange(11)
FROM_FAIRLEAD, FROM_FACET, FROM_KNUCKLE, FROM_SINKER = np.arange(4)


@kernel()
def clears(line, q, at, facet):
    """Whether nothing further down can touch a line that is above `facet` now."""
    if at[1] >= line.lowest_buoy:
        return False
    if line.no_bed:
        return q[V] <= 0 and q[Z] >= line.bed[0, 1]
    return q[V] <= q[H] * line.bed[facet, 3]


@kernel()
def height_over(line, q, facet):
    """Height of the line above a facet, across the facet."""
    angle = line.bed[facet, 2]
    return (q[Z] - line.bed[facet, 1]) * math.cos(angle) - (q[X] - line.bed[facet, 0]) * math.sin(angle)


@kernel()
def span_to_edge(q, g, weight, factor, flexibility, x, z):
    """Go down a free span to the abscissa of a knuckle or the anchor; height above it, across the line."""
    ds = length_to(q, x, weight, factor, flexibility)
    free_step(q, g, ds, weight, factor, flexibility)
    q[X] = x
    return (q[Z] - z) * q[H] / math.hypot(q[H], q[V])


@kernel()
def span_down(line, q, g, at, facet, states, hung):
    """Walk a free span to the first thing it would go through; g has no columns.

    states, hung : states and weights of the point loads that it passes
    returns : gap (m, across the line; negative where it goes through), step, index; q and at stand there
    """
    value = 1.0
    for _ in range(10_000):
        if clears(line, q, at, facet):
            break
        weight = line.segments[at[0], 1]
        row, knot = free_knot(line, q, at[0])
        factor, flexibility = line.knots[row, 1], line.knots[row, 2]
        stop, is_load = next_stop(line, at)
        tan = -math.inf if line.no_bed else math.tan(line.bed[facet, 2])
        steeper = q[V] - q[H] * tan
        # a span that has just left a facet is parallel to it but for rounding
        touch = steeper / weight if 1e-13 * math.hypot(q[H], q[V]) < steeper < math.inf else math.inf
        ds = min(q[S] - stop, min(touch, knot))
        x, z, v, s = q[X], q[Z], q[V], q[S]
        if math.isfinite(ds):
            free_step(q, g, ds, weight, factor, flexibility)
        if not math.isfinite(ds) or q[X] <= line.bed[facet, 0]:
            q[X], q[Z], q[V], q[S] = x, z, v, s
            value = span_to_edge(q, g, weight, factor, flexibility, line.bed[facet, 0], line.bed[facet, 1])
            if facet == 0:
                return value, TO_ANCHOR, facet
            if value < 0:
                return value, TO_KNUCKLE, facet
            facet -= 1
        elif ds == touch:
            q[V] = q[H] * tan
            value = height_over(line, q, facet)
            if value < 0:
                return value, TO_FACET, facet
        elif ds == s - stop or s - ds <= stop:
            q[S] = stop
            if not is_load:
                at[0] -= 1
                continue
            force, states[at[1]] = soft_weight(line, at[1], q[Z])
            hung[at[1]] = force
            if not line.no_bed and q[V] > q[H] * tan >= q[V] - force:
                value = height_over(line, q, facet)
                if value < 0:
                    return value, TO_FACET, facet
            q[V] -= force
            at[1] -= 1
    return value, NONE, facet


@kernel()
def start_span(line, origin, q, g, at, facet, amount, rows):
    """Set a span off: V at the fairlead, length along a facet, angle at a knuckle, or how hard a sinker presses."""
    if origin == FROM_FAIRLEAD:
        q[V] = amount
        return facet
    if origin == FROM_FACET:
        crawl(line, q, g, at, facet, amount, NOTHING, NOTHING, rows)
        leave(line, q, g)
        return facet
    if origin == FROM_SINKER:
        rest_sinker(line, q, g, at, facet, amount, NOTHING)
        return facet
    turn_knuckle(line, q, g, amount, NOTHING)
    leave(line, q, g)
    return facet - 1


@kernel()
def try_span(line, origin, q0, at0, facet, amount, q, g, at, states, hung, rows):
    """Gap, step and index of a span set off at (q0, at0), where q and at are left."""
    copy_state(q, at, q0, at0)
    facet = start_span(line, origin, q, g, at, facet, amount, rows)
    return span_down(line, q, g, at, facet, states, hung)


@kernel()
def first_touch(line, origin, q, g, at, facet, low, high, near, states, hung, rows):
    """Start of the span that just touches; it is free at `low` and goes through something at `high`.

    near : a guess, tried first with the smallest steps to either side; nan for none
    q, at : left where it touches.  returns : start, step, index
    """
    q0, at0 = q.copy(), at.copy()
    f_low, f_high, step, index, side = math.nan, math.nan, NONE, NONE, 0
    width = 1e-9 * abs(near) + 1e-13 * (high - low)
    for trial in range(200):
        least = 4e-16 * (abs(high) + abs(low))
        # the first four trials: below and above the guess, then the ends where these did not do
        if trial == 0:
            amount = near - width
        elif trial == 1:
            amount = near + width
        elif trial == 2:
            amount = low
        elif trial == 3:
            amount = high
        else:
            if high - low <= 4 * least:
                break
            amount = 0.5 * (low + high)
            if trial % 4 != 3 and f_low > f_high:
                # a step towards the far end as soon as the near one stands on the root
                amount = min(max(low + (high - low) * f_low / (f_low - f_high), low + least), high - least)
        if trial < 2 and not low < amount < high:
            continue
        if (trial == 2 and not math.isnan(f_low)) or (trial == 3 and not math.isnan(f_high)):
            continue
        value, found, where = try_span(line, origin, q0, at0, facet, amount, q, g, at, states, hung, rows)
        if trial == 2:
            # a span that starts free may touch its own start by rounding
            low, f_low = amount, max(value, 0.0)
        elif value < 0 or trial == 3:
            high, f_high, step, index = amount, value, found, where
            f_low = 0.5 * f_low if side == 1 else f_low
            side = 1
        else:
            low, f_low = amount, value
            f_high = 0.5 * f_high if side == -1 else f_high
            side = -1
    try_span(line, origin, q0, at0, facet, high, q, g, at, states, hung, rows)
    return high, step, index
