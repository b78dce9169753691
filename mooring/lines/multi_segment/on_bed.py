"""Kernels that integrate a line downwards along a facet of the bed, and that put a line or a sinker on the facet.

On a facet too steep for friction (`friction.slides_down`), a line needs tension down to the facet's lower end. If
the tension becomes zero above this end, T continues below zero, and the position is no equilibrium. The first facet
continues below the anchor, where a sliding line lies in a bight. The bight turns where T = 0; its other leg lies up
the slope to the anchor, which holds this leg with w (sin β − μ cos β) per length. On this leg β is larger by π.
"""

import math

from hakobune.bem.kernels.jit import kernel

from ..catenary.state import HEAP
from .friction import bed_step, friction_rate, kept_tension, pass_weight_on_bed, slides_down
from .line_data import END, LENGTH, PHI, H, S, T, V, X, Z, mix, next_stop, record, strain_row

# causes that end a piece on the bed: a row of the tension table, the tension kept from an earlier position, tension 0,
# a joint or point load, the requested length, the anchor's place
TABLE_ROW, KEPT_TENSION, NO_TENSION, STOP, DONE, ORIGIN = 0, 1, 2, 3, 4, 5


@kernel()
def length_for(distance, t, rate, factor, flexibility):
    """Unstretched length of a piece on the bed that covers a distance, inf if impossible."""
    a = factor + flexibility * t
    inside = a * a - 2 * flexibility * rate * distance
    return 2 * distance / (a + math.sqrt(inside)) if inside > 0 else math.inf


@kernel()
def length_on(line, q, at, facet):
    """Length to march on a facet: inf for the way to its lower end; on the first facet the whole remaining length of
    line.
    """
    return q[S] if facet == 0 and (not line.to_place or slides_down(line, at, facet, q[T])) else math.inf


@kernel()
def bed_piece(line, q, g, at, angle, slides, folds):
    """Rate dT/ds and row of the tension table from this place down; length over which they apply; cause of its end;
    kept tension reached.
    """
    segment = at[0]
    rate, ds, kept = friction_rate(line, q, line.segments[segment, 1], angle)
    if rate < 0 and q[X] <= line.bed[0, 0] and not folds:  # a line in a heap at the anchor does not pull there
        rate = 0.0
    if q[T] <= 0 and rate > 0 and not slides:
        q[T], rate = 0.0, 0.0
        mix(g, T, 0.0, T, 0.0, T)
    row = strain_row(line, segment, q[T], rate > 0)
    why = TABLE_ROW if math.isnan(kept) else KEPT_TENSION
    if rate > 0 and not (slides and not folds and row == line.first_row[segment]):
        available = (q[T] - line.strain_table[row, 0]) / rate
        if available < ds:
            ds, why = available, TABLE_ROW if line.strain_table[row, 0] > 0 else NO_TENSION
    elif rate < 0 and row + 1 < line.first_row[segment + 1]:
        available = (q[T] - line.strain_table[row + 1, 0]) / rate
        if available < ds:
            ds, why = available, TABLE_ROW
    return rate, row, ds, why, kept


@kernel()
def march_on_facet(line, q, g, at, facet, amount, unknown, last_load, rows):
    """Integrate down along a facet by the length `amount`, or to the lower end of the facet where `amount` is infinite.

    Stops at a buoy and at the point load `last_load`.  On the first facet a line that slides is folded where T = 0.
    unknown : index of the length among the unknowns, below 0 if it is none; rows : see `record`
    """
    angle = line.bed[facet, 2]
    cos = math.cos(angle)
    target = q[S] - amount
    mix(g, END, 1.0, S, 0.0, S)
    if unknown >= 0:
        g[END, unknown] -= 1.0
    slides = slides_down(line, at, facet, q[T])
    folds, folded = slides and facet == 0 and amount == q[S], False
    if folds:
        mix(g, END, 0.0, S, 0.0, S)
    for _ in range(10_000):
        if 0 < rows.shape[0] <= at[2]:  # a trial without numbers
            return
        rate, row, ds, why, kept = bed_piece(line, q, g, at, angle, slides, folds)
        factor, flexibility = line.strain_table[row, 1], line.strain_table[row, 2]
        stop, is_load = next_stop(line, at)
        if q[S] - stop <= ds:
            ds, why = q[S] - stop, STOP
        end = q[S] - target
        if math.isinf(amount):
            end = length_for((q[X] - line.bed[facet, 0]) / cos, q[T], rate, factor, flexibility)
        elif q[X] > line.bed[0, 0] and not folds:
            to_origin = length_for((q[X] - line.bed[0, 0]) / cos, q[T], rate, factor, flexibility)
            if facet == 0 and to_origin < ds:
                ds, why = to_origin, ORIGIN
        if end <= ds and not (end == ds and why == STOP and is_load and at[1] == last_load):
            ds, why = end, DONE
        if why == STOP:
            mix(g, LENGTH, 1.0, S, 0.0, S)
        elif why == ORIGIN or (why == DONE and math.isinf(amount)):
            low_stretch = factor + flexibility * (q[T] - rate * ds)
            mix(g, LENGTH, 1 / cos / low_stretch, X, -flexibility * ds / low_stretch, T)
        elif why == DONE:
            mix(g, LENGTH, 1.0, S, -1.0, END)
        elif why == NO_TENSION and folds:
            mix(g, LENGTH, 1 / rate, T, 0.0, T)
        else:
            mix(g, LENGTH, 0.0, S, 0.0, S)
        record(rows, at, q, ds, rate, line.segments[at[0], 1], row, angle, True, line.strain_table)
        bed_step(q, g, ds, rate, factor, flexibility, angle)
        if why == KEPT_TENSION:
            q[T] = kept
            mix(g, T, kept_tension(line, q[S])[1], S, 0.0, T)
        elif why == NO_TENSION:
            q[T] = 0.0
            mix(g, T, 0.0, T, 0.0, T)
            if folds:
                folded, angle, cos = True, angle + math.pi, -cos
        elif why == ORIGIN:
            q[X], q[Z] = line.bed[0, 0], line.bed[0, 1]
            if rate < 0:
                q[T] = 0.0
                mix(g, T, 0.0, T, 0.0, T)
        elif why == STOP:
            q[S] = stop
            if is_load and (line.loads[at[1], 1] < 0 or at[1] == last_load):
                return
            if is_load and slides and not folded:
                if pass_sliding_sinker(line, q, g, at, angle, folds):
                    folded, angle, cos = True, angle + math.pi, -cos
            else:
                pass_on_bed(line, q, g, at, angle, is_load)
        elif why == DONE:
            if folds:
                q[S] = 0.0
            break
    if folded:
        q[PHI] = angle


@kernel()
def pass_on_bed(line, q, g, at, angle, is_load):
    """Pass a joint, or a sinker that lies on the bed."""
    if not is_load:
        at[0] = max(at[0] - 1, 0)
        return
    at[1] -= 1
    mix(g, LENGTH, 0.0, T, 0.0, T)
    pass_weight_on_bed(line, q, g, angle, line.loads[at[1] + 1, 1])


@kernel()
def pass_sliding_sinker(line, q, g, at, angle, folds):
    """Pass a sinker where the line slides.  returns : whether the line is folded there

    A sinker that the line above does not pull up the slope hangs between both legs of the fold. The lower leg
    carries the part of its weight that friction and the upper leg do not carry.
    """
    weight = line.loads[at[1], 1]
    along, across = math.sin(angle), line.friction * math.cos(angle)
    at[1] -= 1
    rest = q[T] - (along + across) * weight
    if rest >= 0 or not folds:
        q[T] = rest
        return False
    rest = (along - across) * weight - q[T]
    q[T] = max(rest, 0.0)
    mix(g, T, -1.0 if rest > 0 else 0.0, T, 0.0, T)
    return True


@kernel()
def leave_heap(line, q, g, at, amount, angle, unknown, rows):
    """Put the next length of line, unstretched, in a heap at the present point, with the sinkers on this length.

    unknown : index of this length among the unknowns; angle : slope of the bed at the heap.  returns : False where a
        buoy would lift the heap
    """
    end = q[S] - amount
    for _ in range(10_000):
        stop, is_load = next_stop(line, at)
        down = q[S] - max(stop, end)
        record(rows, at, q, down, 0.0, line.segments[at[0], 1], line.first_row[at[0]], angle, True, line.strain_table)
        if 0 < at[2] <= rows.shape[0]:
            rows[at[2] - 1, 5], rows[at[2] - 1, 8], rows[at[2] - 1, 9] = 0.0, HEAP, 0.0
        q[S] = max(stop, end)
        if stop <= end:
            break
        if not is_load and at[0] == 0:  # a trial without numbers
            return False
        if not is_load:
            at[0] -= 1
        elif line.loads[at[1], 1] < 0:
            return False
        else:
            at[1] -= 1
    if unknown >= 0:
        g[S, unknown] -= 1.0
    return True


@kernel()
def is_at_sinker(line, q, at):
    """Whether the state is at a sinker."""
    return at[1] >= 0 and q[S] == line.loads[at[1], 0] and line.loads[at[1], 1] > 0


@kernel()
def put_on_facet(line, q, g, facet):
    """Set z to the height of the facet at x, where a span ends on the facet."""
    tan = math.tan(line.bed[facet, 2])
    q[Z] = line.bed[facet, 1] + (q[X] - line.bed[facet, 0]) * tan
    mix(g, Z, tan, X, 0.0, X)


@kernel()
def touch_down(line, q, g, at, facet):
    """Touchdown on a facet: the line arrives tangentially, or with a sinker that the bed carries in part."""
    angle = line.bed[facet, 2]
    cos, tan = math.cos(angle), math.tan(angle)
    q[T], q[PHI] = q[H] / cos, angle
    mix(g, T, 1 / cos, H, 0.0, H)
    mix(g, PHI, 0.0, H, 0.0, H)
    if is_at_sinker(line, q, at):
        at[1] -= 1
        mix(g, LENGTH, tan, H, -1.0, V)
        pass_weight_on_bed(line, q, g, angle, q[H] * tan - (q[V] - line.loads[at[1] + 1, 1]))
    put_on_facet(line, q, g, facet)


@kernel()
def normal_force_on(line, q, at, facet):
    """Normal force of the sinker at this place on a facet, N, if the line below the sinker lies on the facet."""
    angle = line.bed[facet, 2]
    return (q[H] * math.tan(angle) - q[V] + line.loads[at[1], 1]) * math.cos(angle)


@kernel()
def pass_grounded_sinker(line, q, g, at, facet, normal_force, unknown):
    """Pass a sinker with a normal force (N, the unknown of the given index) on a facet; a free span begins below the
    sinker.

    Friction acts on the sinker as if it slid towards the fairlead, but the span keeps at least the tension
    `line.least`.
    """
    angle = line.bed[facet, 2]
    along = math.sin(angle) + line.friction * math.cos(angle)
    across = math.cos(angle) - line.friction * math.sin(angle)
    by_normal_force = across
    if q[H] - normal_force * along >= line.least:
        q[H] -= normal_force * along
        q[V] += normal_force * across - line.loads[at[1], 1]
        if unknown >= 0:
            g[H, unknown] -= along
    else:
        tan = math.tan(angle)
        by_normal_force = 1 / math.cos(angle)
        q[V] += normal_force * by_normal_force - (q[H] - line.least) * tan - line.loads[at[1], 1]
        q[H] = line.least
        mix(g, V, 1.0, V, -tan, H)
        mix(g, H, 0.0, H, 0.0, H)
    if unknown >= 0:
        g[V, unknown] += by_normal_force
    at[1] -= 1
    put_on_facet(line, q, g, facet)
