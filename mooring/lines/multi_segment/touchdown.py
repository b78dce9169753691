"""Kernels that find the first contact of a free span with the bed.

A span hangs lower the steeper it starts, the later it leaves a facet, and the larger the normal force of its sinker
on the bed. The start for which the span just touches a facet, a vertex or the anchor is therefore a bracketed root.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .free_span import free_step, free_table_row, length_to, level_in_sea, smoothed_weight
from .friction import bend_at_vertex, leave_bed
from .line_data import NOTHING, H, S, V, X, Z, copy_state, next_stop
from .on_bed import march_on_facet, pass_grounded_sinker

# steps of a traversal
# TO_FACET, TO_VERTEX, TO_ANCHOR: a free span that ends there; ALONG: on a facet to its lower end; BEND: from a facet
# over its lower vertex onto the next; OFF_FACET, OFF_VERTEX, OFF_SINKER: a free span begins inside a facet, at a
# vertex, below a sinker on the bed; TO_SINKER: on a facet to a sinker; GROUNDED_ANCHOR: on the bed to the anchor;
# NONE: the line stays on the bed; MISSED: a free span from which no start touches the bed; HEAP_AT_VERTEX: a heap
# above a vertex, to which the line slides; SLID: a line without tension slides down to a vertex
NONE, TO_FACET, TO_VERTEX, TO_ANCHOR, ALONG, OFF_FACET = np.arange(6)
BEND, OFF_VERTEX, GROUNDED_ANCHOR, OFF_SINKER, TO_SINKER, MISSED, HEAP_AT_VERTEX, SLID = np.arange(6, 14)
FROM_FAIRLEAD, FROM_FACET, FROM_VERTEX, FROM_SINKER = np.arange(4)
ROUNDING = 1e-12  # apparent initial penetration of a span by rounding, over the length
WALK = 10_000  # pieces of one span, far more than a line can have: an upper bound


@kernel(inline=True)
def clears(line, q, at, facet):
    """Whether the line, now above `facet`, cannot touch the bed further down."""
    if at[1] >= line.lowest_buoy:
        return False
    if line.no_bed:
        return q[V] <= 0 and q[Z] >= line.bed[0, 1]
    return q[V] <= q[H] * line.bed[facet, 3] and (line.to_place or q[Z] >= line.bed[0, 1])


@kernel(inline=True)
def height_over(line, q, facet):
    """Distance of the line from a facet, normal to the facet, m; negative under the facet."""
    angle = line.bed[facet, 2]
    return (q[Z] - line.bed[facet, 1]) * math.cos(angle) - (q[X] - line.bed[facet, 0]) * math.sin(angle)


@kernel(inline=True)
def height_at_end(line, q, facet):
    """Height of the line's end over the bed; a hollow between the anchor and the fairlead does not count."""
    value = height_over(line, q, facet)
    return min(value, q[Z] - line.bed[0, 1]) if facet > 0 else value


@kernel()
def span_to_vertex(q, g, weight, factor, flexibility, x, z):
    """Integrate down a free span to the x of a bed vertex.  returns : distance normal to the line, m"""
    ds = length_to(q, x, weight, factor, flexibility)
    free_step(q, g, ds, weight, factor, flexibility)
    q[X] = x
    return (q[Z] - z) * q[H] / math.hypot(q[H], q[V])


@kernel(inline=True)
def first_contact(line, q, g, at, facet, states, load_weights):
    """Integrate down a free span to its first contact: a facet or vertex, the end of the line or the anchor.

    g : array without columns; the first facet continues beyond the anchor's place, so that the line always ends on it
    states, load_weights : set to states and weights (N) of the point loads on the way
    returns : gap (m, normal to the bed; negative for penetration, else the smallest on the way), step, index; q and
        at are left at the contact
    """
    # an immediate contact is the start itself, within rounding
    least, begin, rounding = math.inf, q[S] - 1e-6 * line.length, ROUNDING * line.length
    for _ in range(WALK):
        if clears(line, q, at, facet):
            break
        weight = line.segments[at[0], 1]
        row, row_length = free_table_row(line, q, at[0])
        factor, flexibility = line.strain_table[row, 1], line.strain_table[row, 2]
        stop, is_load = next_stop(line, at)
        tan = -math.inf if line.no_bed else math.tan(line.bed[facet, 2])
        steeper = q[V] - q[H] * tan
        # a span that has just left a facet is parallel to it but for rounding
        touch = steeper / weight if 1e-13 * math.hypot(q[H], q[V]) < steeper < math.inf else math.inf
        ds = min(min(q[S] - stop, math.inf if line.to_place else q[S]), min(touch, row_length))
        x, z, v, s = q[X], q[Z], q[V], q[S]
        if math.isfinite(ds):
            free_step(q, g, ds, weight, factor, flexibility)
        if math.isinf(ds) or ((facet > 0 or line.to_place) and q[X] <= line.bed[facet, 0]):
            q[X], q[Z], q[V], q[S] = x, z, v, s
            value = span_to_vertex(q, g, weight, factor, flexibility, line.bed[facet, 0], line.bed[facet, 1])
            if facet == 0:
                return min(value, least), TO_ANCHOR, facet
            if value < 0:
                return value, TO_VERTEX, facet
            least = min(least, value) if q[S] < begin else least
            facet -= 1
        elif ds == touch:
            q[V] = q[H] * tan
            value = height_over(line, q, facet)
            if value < (0.0 if q[S] < begin else -rounding):
                return value, TO_FACET, facet
            least = min(least, value) if q[S] < begin else least
        elif ds == s and not line.to_place:
            q[S] = 0.0
            return min(height_at_end(line, q, facet), least), TO_ANCHOR, facet
        elif ds == s - stop or s - ds <= stop:
            q[S] = stop
            if not is_load:
                at[0] -= 1
                continue
            force, states[at[1]] = smoothed_weight(line, at[1], level_in_sea(line, q))
            load_weights[at[1]] = force
            if not line.no_bed and q[V] > q[H] * tan >= q[V] - force:
                value = height_over(line, q, facet)
                if value < 0:
                    return value, TO_FACET, facet
                least = min(least, value) if q[S] < begin else least
            q[V] -= force
            at[1] -= 1
    return least, NONE, facet


@kernel()
def start_span(line, origin, q, g, at, facet, amount, rows):
    """Start a free span. returns : the facet below the start

    amount : depends on `origin`: V at the fairlead, length along the facet, angle at the vertex or normal force of
        the sinker
    """
    if origin == FROM_FAIRLEAD:
        q[V] = amount
        return facet
    if origin == FROM_FACET:
        march_on_facet(line, q, g, at, facet, amount, NOTHING, NOTHING, rows)
        leave_bed(line, q, g)
        return facet
    if origin == FROM_SINKER:
        pass_grounded_sinker(line, q, g, at, facet, amount, NOTHING)
        return facet
    bend_at_vertex(line, q, g, amount, NOTHING)
    leave_bed(line, q, g)
    return facet - 1


@kernel()
def try_span(line, origin, q0, at0, facet, amount, q, g, at, states, load_weights, rows):
    """Gap, step and index of the first contact of a span from (q0, at0); q and at then hold the contact."""
    copy_state(q, at, q0, at0)
    facet = start_span(line, origin, q, g, at, facet, amount, rows)
    return first_contact(line, q, g, at, facet, states, load_weights)


@kernel()
def between(low, high, f_low, f_high, wide, room, least):
    """Next trial for the root between low, with f ≥ 0, and high, with f < 0: the regula falsi.

    The trial is shifted towards the middle, to approach the root from both sides. The shift keeps the interval no
    larger than bisection would make it one step earlier, which helps where f jumps. I. F. D. Oliveira and R. H. C.
    Takahashi, ACM Trans.  Mathematical Software 47 (2020) 5, the ITP method.

    wide : initial high − low; room : twice that, halved at every step; least : the smallest step
    """
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    if not 0 < f_low - f_high < math.inf:
        return middle
    amount = low + (high - low) * f_low / (f_low - f_high)
    push = max(0.8 * half * half / wide, least)
    if push > abs(middle - amount):
        return middle
    amount += push if amount < middle else -push
    reach = max(0.5 * room - half, 0.0)
    return min(max(amount, middle - reach), middle + reach)


@kernel()
def touching_start(line, origin, q, g, at, facet, low, high, states, load_weights, rows):
    """Start of the span that just touches the bed; a start at `low` stays clear, a start at `high` penetrates.

    At the fairlead, `low` and `high` are first guesses, which are moved apart until they bracket the start.
    q, at : the state where the span touches.  returns : start, step, index; the step is MISSED where none penetrated
    """
    q0, at0 = q.copy(), at.copy()
    step, index, wide = MISSED, facet, high - low
    widenings = 200 if origin == FROM_FAIRLEAD else 0
    f_low = try_span(line, origin, q0, at0, facet, low, q, g, at, states, load_weights, rows)[0]
    for _ in range(widenings):
        if f_low >= 0:
            break
        low, wide = low - wide, 2 * wide
        f_low = try_span(line, origin, q0, at0, facet, low, q, g, at, states, load_weights, rows)[0]
    f_low = max(f_low, 0.0)  # a span that starts free may touch its own start by rounding
    f_high, found, where = try_span(line, origin, q0, at0, facet, high, q, g, at, states, load_weights, rows)
    for _ in range(widenings):
        if f_high < 0:
            break
        high = low + 4 * (high - low)
        f_high, found, where = try_span(line, origin, q0, at0, facet, high, q, g, at, states, load_weights, rows)
    if found != NONE:
        step, index = found, where
    wide, at_high = high - low, True
    room = 2 * wide
    for _ in range(200):
        least = 4e-16 * (abs(high) + abs(low))
        if high - low <= max(4 * least, line.close * (abs(high) + abs(low))):
            break
        amount = between(low, high, f_low, f_high, wide, room, least)
        room *= 0.5
        value, found, where = try_span(line, origin, q0, at0, facet, amount, q, g, at, states, load_weights, rows)
        at_high = value < 0
        if at_high:
            high, f_high, step, index = amount, value, found, where
        else:
            low, f_low = amount, value
    if not at_high:
        try_span(line, origin, q0, at0, facet, high, q, g, at, states, load_weights, rows)
    return high, step, index
