"""Kernels that find where a line of given horizontal tension touches the bed: a walk from the fairlead to the anchor.

For a given tension at the fairlead the walk has one way to go.  A free span goes on until it touches something
(`touch`); from there the line lies on the bed until a span that leaves it, at a point, at a sinker or at the angle
within a knuckle, would no longer clear the bed further down.  The length left over when the anchor is reached grows
with the tension, and has one root too.  SR179 report (1982), section 3.1.3, gives the same rules for nodes of a line.

The walk is recorded as steps; `newton` solves their equations together.
"""

from __future__ import annotations

import math

from bem.kernels.jit import kernel

from .crawl import at_sinker, carried, crawl, land
from .friction import leave, pin, turn_knuckle
from .line_data import NOTHING, PHI, H, S, X, Z, copy_state
from .touch import (
    ALONG,
    FROM_FACET,
    FROM_FAIRLEAD,
    FROM_KNUCKLE,
    FROM_SINKER,
    HALT,
    LIFT,
    NONE,
    REST,
    SINKER,
    SPRING,
    TO_ANCHOR,
    TO_FACET,
    TURN,
    first_touch,
    span_down,
    try_span,
)
from .walk_storage import note_step, note_unknown, start_walk


@kernel()
def gap_of(line, w, origin, facet, amount):
    """Gap of a span set off from where the walk stands, which stays there."""
    return try_span(line, origin, w.q, w.at, facet, amount, w.trial, w.g, w.tried, w.states, w.hung, w.rows)[0]


@kernel()
def touching(line, w, origin, facet, low, high):
    """Go down the span that just touches, and note its start.  returns : step, index"""
    near = w.near[w.count[1]]
    start, step, index = first_touch(line, origin, w.q, w.g, w.at, facet, low, high, near, w.states, w.hung, w.rows)
    note_unknown(w, start)
    return step, index


@kernel()
def first_span(line, w, facet):
    """The span from the fairlead, between V with which it clears everything and V with which it goes through."""
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
    for _ in range(200):
        if low < w.near[1] < high or gap_of(line, w, FROM_FAIRLEAD, facet, high) < 0:
            break
        high = low + 4 * (high - low)
    return touching(line, w, FROM_FAIRLEAD, facet, low, high)


@kernel()
def from_landing(line, w, facet):
    """Land on a facet.  returns : step and index of the span that a sinker there holds up, NONE where it lies."""
    if at_sinker(line, w.q, w.at):
        press = carried(line, w.q, w.at, facet)
        if gap_of(line, w, FROM_SINKER, facet, press) < 0:
            note_step(w, SINKER, facet, NOTHING)
            return touching(line, w, FROM_SINKER, facet, 0.0, press)
    land(line, w.q, w.g, w.at, facet)
    return NONE, facet


@kernel()
def lift_off(line, w, facet, reached):
    """Leave a facet within the length `reached`, at a sinker that still lies there or between two of them.

    returns : step, index
    """
    low, high, begin = 0.0, reached, w.q[S]
    angle = line.bed[facet, 2]
    for load in range(w.at[1], -1, -1):
        if line.loads[load, 1] < 0 or begin - line.loads[load, 0] >= reached:
            break
        q0, at0 = w.q.copy(), w.at.copy()
        crawl(line, w.q, w.g, w.at, facet, math.inf, NOTHING, load, w.rows)
        leave(line, w.q, w.g)
        press = line.loads[load, 1] * math.cos(angle)
        if gap_of(line, w, FROM_SINKER, facet, press) < 0:
            if gap_of(line, w, FROM_SINKER, facet, 0.0) >= 0:
                note_step(w, HALT, facet, load)
                note_step(w, SINKER, facet, NOTHING)
                return touching(line, w, FROM_SINKER, facet, 0.0, press)
            high = begin - line.loads[load, 0]
        else:
            low = begin - line.loads[load, 0]
        copy_state(w.q, w.at, q0, at0)
        if high < reached:
            break
    note_step(w, LIFT, facet, NOTHING)
    return touching(line, w, FROM_FACET, facet, low, high)


@kernel()
def pierced(line, w, facet, reached):
    """A length after which a span that leaves the facet goes through something, 0 where none of 32 does.

    A line that could lie down as far as the anchor with a buoy still to come has to leave the bed for it.
    """
    for i in range(1, 33):
        if gap_of(line, w, FROM_FACET, facet, reached * i / 32) < 0:
            return reached * i / 32
    return 0.0


@kernel()
def along_facet(line, w, facet):
    """Go down a facet.  returns : step and index of the span that leaves it, NONE at its end, REST at the anchor"""
    q, at = w.q, w.at
    q0, at0 = q.copy(), at.copy()
    crawl(line, q, w.g, at, facet, math.inf, NOTHING, NOTHING, w.rows)
    reached = q0[S] - q[S]
    at_buoy = at[1] >= 0 and line.loads[at[1], 1] < 0 and q[S] == line.loads[at[1], 0]
    if not at_buoy:
        q[X], q[Z] = line.bed[facet, 0], line.bed[facet, 1]
        if facet == 0:
            copy_state(w.trial, w.tried, q, at)
            copy_state(q, at, q0, at0)
            through = pierced(line, w, facet, reached) if w.tried[1] >= line.lowest_buoy else 0.0
            if through > 0:
                return lift_off(line, w, facet, through)
            crawl(line, q, w.g, at, facet, math.inf, NOTHING, NOTHING, w.rows)
            note_step(w, REST, facet, NOTHING)
            return REST, facet
        copy_state(w.trial, w.tried, q, at)
        leave(line, w.trial, w.g)
        if span_down(line, w.trial, w.g, w.tried, facet - 1, w.states, w.hung)[0] >= 0:
            note_step(w, ALONG, facet, NOTHING)
            return NONE, facet
    copy_state(q, at, q0, at0)
    return lift_off(line, w, facet, reached)


@kernel()
def over_knuckle(line, w, facet):
    """Turn from a facet onto the one below, or spring off.  returns : step and index of the span, NONE on the bed"""
    lower = line.bed[facet - 1, 2]
    if gap_of(line, w, FROM_KNUCKLE, facet, lower) < 0:
        note_step(w, SPRING, facet, NOTHING)
        return touching(line, w, FROM_KNUCKLE, facet, w.q[PHI], lower)
    note_step(w, TURN, facet, NOTHING)
    turn_knuckle(line, w.q, w.g, lower, NOTHING)
    return NONE, facet


@kernel()
def walk(line, w, horizontal, x, z):
    """Walk from the fairlead (x, z) with the pull `horizontal` to the anchor.

    returns : length left over there (m; negative: length missing); nan and no steps where the bed is not met
    """
    facet = start_walk(line, w, horizontal, x, z)
    step, index = first_span(line, w, facet)
    while step != NONE and w.count[0] + 4 < w.steps.shape[0]:
        note_step(w, step, index, w.at[1])
        if step == TO_ANCHOR:
            return w.q[S]
        facet, on_facet = index, step == TO_FACET
        if on_facet:
            step, index = from_landing(line, w, facet)
        else:
            note_unknown(w, w.q[S])
            pin(line, w.q, w.g, facet)
            step = NONE
        while step == NONE and w.count[0] + 4 < w.steps.shape[0]:
            if on_facet:
                step, index = along_facet(line, w, facet)
            else:
                step, index = over_knuckle(line, w, facet)
                facet -= 1
            on_facet = not on_facet
        if step == REST:
            return w.q[S]
    w.count[0] = 0
    return math.nan
