"""Kernels that find the contacts of a line of given horizontal tension with the bed, from the fairlead to the anchor.

The tension determines the line's shape.  A free span ends at its first contact (`touchdown`). From there the line lies
on the bed to the last place from which a free span just clears the bed further down: inside a facet, at a sinker, or at
a vertex at an angle between those of its facets.  The excess length at the anchor grows with the tension and
has one root.  SR179 report (1982), section 3.1.3, gives the same rules for nodes of a line.

The end of the search is an option (`LineData.to_place`). It may be the anchor's place, where an excess length is
left. Or it may be the end of the line, somewhere on the first facet or on its continuation beyond the anchor, where
the excess of a slack line is laid out. The distance of this end beyond the anchor's place also grows with the
tension, on a plane bed for any segments and loads. Over hills the anchor's place is the better end; for slack lines
with buoys it is the end of the line.

The contacts are recorded as steps; `newton` solves the equations of all of them together.
"""

import math

from hakobune.bem.kernels.jit import kernel

from .friction import bend_at_vertex, leave_bed, place_on_vertex, slides_down
from .line_data import NOTHING, PHI, H, S, T, X, Z, add_step, add_unknown, copy_state, start_traverse
from .on_bed import is_at_sinker, leave_heap, length_on, march_on_facet, normal_force_on, touch_down
from .touchdown import (
    ALONG,
    BEND,
    FROM_FACET,
    FROM_FAIRLEAD,
    FROM_SINKER,
    FROM_VERTEX,
    GROUNDED_ANCHOR,
    HEAP_AT_VERTEX,
    MISSED,
    NONE,
    OFF_FACET,
    OFF_SINKER,
    OFF_VERTEX,
    ROUNDING,
    SLID,
    TO_ANCHOR,
    TO_FACET,
    TO_SINKER,
    first_contact,
    touching_start,
    try_span,
)

AT_FOOT = 1e-3  # distance from a sinker in a hollow at which the search leaves the hollow, over the length


@kernel()
def gap_of(line, w, origin, facet, amount):
    """Gap at the first contact of a span that would begin at the state w.q, w.at, which is not changed."""
    return try_span(
        line, origin, w.q, w.at, facet, amount, w.trial_q, w.g, w.trial_at, w.states, w.load_weights, w.rows
    )[0]


@kernel()
def touching_span(line, w, origin, facet, low, high):
    """Integrate down the span that just touches the bed, and record its start.  returns : step, index"""
    start, step, index = touching_start(
        line, origin, w.q, w.g, w.at, facet, low, high, w.states, w.load_weights, w.rows
    )
    add_unknown(w, start)
    return step, index


@kernel()
def first_span(line, w, facet):
    """The span from the fairlead, by a search over V between spans that clear the bed and spans that penetrate it.
    returns : step, index"""
    q = w.q
    slope = (q[Z] - line.bed[0, 1]) / (q[X] - line.bed[0, 0])
    for i in range(1, facet + 1):
        slope = min(slope, (q[Z] - line.bed[i, 1]) / (q[X] - line.bed[i, 0]))
    lift, heaviest = 0.0, 0.0
    for load in range(line.loads.shape[0]):
        lift -= min(line.loads[load, 1], 0.0)
    for segment in range(line.segments.shape[0]):
        heaviest = max(heaviest, line.segments[segment, 1])
    low = q[H] * slope - lift
    high = low + lift + q[H] + heaviest * (abs(q[Z] - line.bed[0, 1]) + 1e-3 * line.length)
    low -= 1e-9 * abs(low)
    return touching_span(line, w, FROM_FAIRLEAD, facet, low, high)


@kernel()
def after_touchdown(line, w, facet):
    """Touchdown on a facet.  returns : step, index of a span that begins at a sinker there, else NONE, facet"""
    if is_at_sinker(line, w.q, w.at):
        normal_force = normal_force_on(line, w.q, w.at, facet)
        if gap_of(line, w, FROM_SINKER, facet, normal_force) < -ROUNDING * line.length:
            add_step(w, OFF_SINKER, facet, NOTHING)
            return touching_span(line, w, FROM_SINKER, facet, 0.0, normal_force)
    touch_down(line, w.q, w.g, w.at, facet)
    return NONE, facet


@kernel()
def lift_off(line, w, facet, reached):
    """Leave a facet within the length `reached`, at a sinker that lies on the facet, or between two sinkers.

    returns : step, index
    """
    low, high, begin = 0.0, reached, w.q[S]
    angle = line.bed[facet, 2]
    for load in range(w.at[1], -1, -1):
        if line.loads[load, 1] < 0 or begin - line.loads[load, 0] >= reached:
            break
        q0, at0 = w.q.copy(), w.at.copy()
        march_on_facet(line, w.q, w.g, w.at, facet, length_on(line, w.q, w.at, facet), NOTHING, load, w.rows)
        leave_bed(line, w.q, w.g)
        normal_force = line.loads[load, 1] * math.cos(angle)
        if gap_of(line, w, FROM_SINKER, facet, normal_force) < -ROUNDING * line.length:
            if gap_of(line, w, FROM_SINKER, facet, 0.0) >= 0:
                add_step(w, TO_SINKER, facet, load)
                add_step(w, OFF_SINKER, facet, NOTHING)
                return touching_span(line, w, FROM_SINKER, facet, 0.0, normal_force)
            high = begin - line.loads[load, 0]
        else:
            low = begin - line.loads[load, 0]
        copy_state(w.q, w.at, q0, at0)
        if high < reached:
            break
    add_step(w, OFF_FACET, facet, NOTHING)
    return touching_span(line, w, FROM_FACET, facet, low, high)


@kernel()
def penetrating_length(line, w, facet, reached):
    """A length along the facet from which a span that leaves the facet would penetrate the bed; 0 if none of 32 lengths
    does.

    A line that could lie on the bed up to the anchor must leave the bed where a lower buoy lifts it.
    """
    for i in range(1, 33):
        if gap_of(line, w, FROM_FACET, facet, reached * i / 32) < 0:
            return reached * i / 32
    return 0.0


@kernel()
def sinker_at_foot(line, q, at):
    """Index of the sinker, just passed, that made the tension zero at this place; NOTHING if there is none."""
    load = at[1] + 1
    if q[T] < 0 and load < line.loads.shape[0] and line.loads[load, 0] - q[S] < AT_FOOT * line.length:
        return load
    return NOTHING


@kernel()
def along_facet(line, w, facet):
    """Integrate along a facet.

    returns : step, index of the span that leaves it; NONE at its end, GROUNDED_ANCHOR at the anchor, SLID where no
        tension is left to hold the line
    """
    q, at = w.q, w.at
    q0, at0 = q.copy(), at.copy()
    march_on_facet(line, q, w.g, at, facet, length_on(line, q, at, facet), NOTHING, NOTHING, w.rows)
    reached = q0[S] - q[S]
    at_buoy = at[1] >= 0 and line.loads[at[1], 1] < 0 and q[S] == line.loads[at[1], 0]
    if not at_buoy:
        if facet == 0:
            if at[1] >= line.lowest_buoy:
                copy_state(q, at, q0, at0)
                through = penetrating_length(line, w, facet, reached)
                if through > 0:
                    return lift_off(line, w, facet, through)
                march_on_facet(line, q, w.g, at, facet, math.inf, NOTHING, NOTHING, w.rows)
            add_step(w, GROUNDED_ANCHOR, facet, NOTHING)
            return GROUNDED_ANCHOR, facet
        q[X], q[Z] = line.bed[facet, 0], line.bed[facet, 1]
        sinker = sinker_at_foot(line, q, at)
        if line.foot == facet and leave_heap(line, q, w.g, at, line.heap, 0.0, NOTHING, w.rows):
            q[T] = 0.0
            add_step(w, ALONG, facet, NOTHING)
            add_step(w, HEAP_AT_VERTEX, facet, sinker)
            add_unknown(w, line.heap)
            return NONE, facet
        if q[T] < 0:
            w.count[2] = 0 if slides_down(line, at, facet - 1, math.inf) else facet
            return SLID, facet
        copy_state(w.trial_q, w.trial_at, q, at)
        leave_bed(line, w.trial_q, w.g)
        if first_contact(line, w.trial_q, w.g, w.trial_at, facet - 1, w.states, w.load_weights)[0] >= 0:
            add_step(w, ALONG, facet, NOTHING)
            return NONE, facet
    copy_state(q, at, q0, at0)
    return lift_off(line, w, facet, reached)


@kernel()
def over_vertex(line, w, facet):
    """Bend over a vertex onto the facet below, or leave the bed.  returns : step, index of the span, NONE on the bed"""
    lower = line.bed[facet - 1, 2]
    if facet != line.foot and gap_of(line, w, FROM_VERTEX, facet, lower) < 0:
        add_step(w, OFF_VERTEX, facet, NOTHING)
        return touching_span(line, w, FROM_VERTEX, facet, w.q[PHI], lower)
    add_step(w, BEND, facet, NOTHING)
    bend_at_vertex(line, w.q, w.g, lower, NOTHING)
    return NONE, facet


@kernel()
def left_over(line, w):
    """Excess length at the anchor's place, m; in a search up to the line's end, the distance of this end beyond that
    place.
    """
    return w.q[S] if line.to_place and w.q[S] != 0.0 else line.bed[0, 0] - w.q[X]


@kernel()
def traverse(line, w, horizontal, x, z):
    """Traverse a line from its fairlead (x, z) to its end with the horizontal tension `horizontal`, N.

    returns : excess length at the anchor's place, or distance of the line's end beyond it (`LineData.to_place`), m,
        negative for a line that is too short. For a part that slides down the bed: a negative measure of its missing
        tension, and no steps. nan and no steps where a span that must touch the bed does not
    """
    facet = start_traverse(line, w, horizontal, x, z)
    step, index = first_span(line, w, facet)
    first = True
    while step != MISSED and w.count[0] + 4 < w.steps.shape[0]:
        add_step(w, step, index, w.at[1])
        if step == TO_ANCHOR:
            return left_over(line, w)
        facet, on_facet = index, step == TO_FACET
        if on_facet:
            step, index = after_touchdown(line, w, facet)
        else:
            add_unknown(w, w.q[S])
            place_on_vertex(line, w.q, w.g, facet)
            step = NONE
        heap = line.heap if first and line.foot == 0 else 0.0
        if heap > 0 and (step != NONE or not leave_heap(line, w.q, w.g, w.at, heap, 0.0, NOTHING, w.rows)):
            break
        first = False
        while step == NONE and w.count[0] + 4 < w.steps.shape[0]:
            if on_facet:
                step, index = along_facet(line, w, facet)
            else:
                step, index = over_vertex(line, w, facet)
                facet -= 1
            on_facet = not on_facet
        if step == GROUNDED_ANCHOR:
            return left_over(line, w)
        if step == SLID:
            w.count[0] = 0
            return w.q[T] / line.weight * line.length
    w.count[0] = 0
    return math.nan
