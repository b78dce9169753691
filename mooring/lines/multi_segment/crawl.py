"""Kernels that go down along a facet of the bed, and that put a line or a sinker on it."""

from __future__ import annotations

import math

from bem.kernels.jit import kernel

from .friction import bed_step, drop_load, friction_rate, kept_tension
from .line_data import END, LENGTH, PHI, H, S, T, V, X, Z, mix, next_stop, record, strain_piece

# what ends a piece on the bed
ROW, MEETING, NO_PULL, STOP, DONE = 0, 1, 2, 3, 4


@kernel()
def length_for(distance, t, rate, factor, flexibility):
    """Unstretched length of a piece on the bed that covers a distance, inf where it cannot."""
    a = factor + flexibility * t
    inside = a * a - 2 * flexibility * rate * distance
    return 2 * distance / (a + math.sqrt(inside)) if inside > 0 else math.inf


@kernel()
def bed_piece(line, q, g, at, angle):
    """dT/ds and row of the tension table here; how far they hold; why no further; the tension met there."""
    segment = at[0]
    rate, ds, meeting = friction_rate(line, q, line.segments[segment, 1], angle)
    if q[T] <= 0 and rate > 0:
        q[T], rate = 0.0, 0.0
        mix(g, T, 0.0, T, 0.0, T)
    row = strain_piece(line, segment, q[T], rate > 0)
    why = ROW if math.isnan(meeting) else MEETING
    if rate > 0:
        room = (q[T] - line.knots[row, 0]) / rate
        if room < ds:
            ds, why = room, ROW if line.knots[row, 0] > 0 else NO_PULL
    elif rate < 0 and row + 1 < line.first_knot[segment + 1]:
        room = (q[T] - line.knots[row + 1, 0]) / rate
        if room < ds:
            ds, why = room, ROW
    return rate, row, ds, why, meeting


@kernel()
def crawl(line, q, g, at, facet, amount, unknown, halt, rows):
    """Go down along a facet by a length, or to its lower end where `amount` is infinite.

    Stops at a buoy and at the point load `halt`.
    unknown : which unknown the length is, below 0 for none; rows : see `record`
    """
    angle = line.bed[facet, 2]
    cos = math.cos(angle)
    target = q[S] - amount
    mix(g, END, 1.0, S, 0.0, S)
    if unknown >= 0:
        g[END, unknown] -= 1.0
    for _ in range(10_000):
        rate, row, ds, why, meeting = bed_piece(line, q, g, at, angle)
        factor, flexibility = line.knots[row, 1], line.knots[row, 2]
        stop, is_load = next_stop(line, at)
        if q[S] - stop <= ds:
            ds, why = q[S] - stop, STOP
        end = q[S] - target
        if math.isinf(amount):
            end = length_for((q[X] - line.bed[facet, 0]) / cos, q[T], rate, factor, flexibility)
        if end <= ds and not (end == ds and why == STOP and is_load and at[1] == halt):
            ds, why = end, DONE
        if why == STOP:
            mix(g, LENGTH, 1.0, S, 0.0, S)
        elif why == DONE and math.isinf(amount):
            low_stretch = factor + flexibility * (q[T] - rate * ds)
            mix(g, LENGTH, 1 / cos / low_stretch, X, -flexibility * ds / low_stretch, T)
        elif why == DONE:
            mix(g, LENGTH, 1.0, S, -1.0, END)
        else:
            mix(g, LENGTH, 0.0, S, 0.0, S)
        record(rows, at, q, ds, rate, line.segments[at[0], 1], row, angle, True, line.knots)
        bed_step(q, g, ds, rate, factor, flexibility, angle)
        if why == MEETING:
            q[T] = meeting
            mix(g, T, kept_tension(line, q[S])[1], S, 0.0, T)
        elif why == NO_PULL:
            q[T] = 0.0
            mix(g, T, 0.0, T, 0.0, T)
        elif why == STOP:
            q[S] = stop
            if is_load and (line.loads[at[1], 1] < 0 or at[1] == halt):
                return
            pass_on_bed(line, q, g, at, angle, is_load)
        elif why == DONE:
            return


@kernel()
def pass_on_bed(line, q, g, at, angle, is_load):
    """Pass a joint, or a sinker that lies on the bed."""
    if not is_load:
        at[0] -= 1
        return
    at[1] -= 1
    mix(g, LENGTH, 0.0, T, 0.0, T)
    drop_load(line, q, g, angle, line.loads[at[1] + 1, 1])


@kernel()
def at_sinker(line, q, at):
    """Whether the walk stands at a sinker."""
    return at[1] >= 0 and q[S] == line.loads[at[1], 0] and line.loads[at[1], 1] > 0


@kernel()
def put_on_facet(line, q, g, facet):
    """z from x, where a span ends on a facet."""
    tan = math.tan(line.bed[facet, 2])
    q[Z] = line.bed[facet, 1] + (q[X] - line.bed[facet, 0]) * tan
    mix(g, Z, tan, X, 0.0, X)


@kernel()
def land(line, q, g, at, facet):
    """Put a line that arrives tangentially, or with a sinker partly carried by the bed, on a facet."""
    angle = line.bed[facet, 2]
    cos, tan = math.cos(angle), math.tan(angle)
    q[T], q[PHI] = q[H] / cos, angle
    mix(g, T, 1 / cos, H, 0.0, H)
    mix(g, PHI, 0.0, H, 0.0, H)
    if at_sinker(line, q, at):
        at[1] -= 1
        mix(g, LENGTH, tan, H, -1.0, V)
        drop_load(line, q, g, angle, q[H] * tan - (q[V] - line.loads[at[1] + 1, 1]))
    put_on_facet(line, q, g, facet)


@kernel()
def carried(line, q, at, facet):
    """How hard the sinker here presses on a facet if the line below it lies on it; N across the facet."""
    angle = line.bed[facet, 2]
    return (q[H] * math.tan(angle) - q[V] + line.loads[at[1], 1]) * math.cos(angle)


@kernel()
def rest_sinker(line, q, g, at, facet, pressure, unknown):
    """Pass a sinker that presses with `pressure` (N, the given unknown) on a facet, to a free span below it.

    It is being pulled towards the fairlead; friction takes no more than leaves the span below the least pull.
    """
    angle = line.bed[facet, 2]
    along = math.sin(angle) + line.friction * math.cos(angle)
    across = math.cos(angle) - line.friction * math.sin(angle)
    by_pressure = across
    if q[H] - pressure * along >= line.least:
        q[H] -= pressure * along
        q[V] += pressure * across - line.loads[at[1], 1]
        if unknown >= 0:
            g[H, unknown] -= along
    else:
        tan = math.tan(angle)
        by_pressure = 1 / math.cos(angle)
        q[V] += pressure * by_pressure - (q[H] - line.least) * tan - line.loads[at[1], 1]
        q[H] = line.least
        mix(g, V, 1.0, V, -tan, H)
        mix(g, H, 0.0, H, 0.0, H)
    if unknown >= 0:
        g[V, unknown] += by_pressure
    at[1] -= 1
    put_on_facet(line, q, g, facet)
