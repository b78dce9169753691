"""Kernels for a free piece of line in closed form, and the weight of point loads on the piece.

SR179 report (1982), section 3.1.1, integrated, with the strain λ − 1 + T/EA of one row of the tension table:

    Δx = H Δs/EA + λ (H/w) [asinh(V/H) − asinh(V₋/H)],    Δz = (V² − V₋²)/2wEA + λ (T − T₋)/w,    V₋ = V − w Δs
"""

import math

from hakobune.bem.kernels.jit import kernel

from .line_data import EMERGED, FLOATING, LENGTH, SUBMERGED, H, S, V, X, Z, slides_on, strain_row


@kernel(inline=True)
def free_step(q, g, ds, weight, factor, flexibility):
    """Advance the state down a free piece of length ds, whose derivatives are g[LENGTH]."""
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
        gh, gv, slid = g[H, i], g[V, i], g[LENGTH, i]
        g[X, i] -= x_h * gh + x_v * gv + stretch * h * slid
        g[Z, i] -= x_v * gh + z_v * gv + stretch * low * slid
        g[V, i] -= weight * slid
        g[S, i] -= slid


@kernel(inline=True)
def free_table_row(line, q, segment):
    """Row of the tension table that applies to a free piece from the present place down, and the length for which it
    applies.
    """
    first, last = line.first_row[segment], line.first_row[segment + 1] - 1
    if first == last:
        return first, math.inf
    h, v = q[H], q[V]
    row = strain_row(line, segment, math.hypot(h, v), v > 0)
    if v > 0 and line.strain_table[row, 0] > h:
        end = math.sqrt(line.strain_table[row, 0] ** 2 - h * h)
        return row, max(v - end, 0.0) / line.segments[segment, 1]
    if row == last or line.strain_table[row + 1, 0] <= h:
        return row, math.inf
    end = -math.sqrt(line.strain_table[row + 1, 0] ** 2 - h * h)
    return row, max(v - end, 0.0) / line.segments[segment, 1]


@kernel(inline=True)
def tangent_beyond(line, q):
    """Slope of the bed at x m beyond the anchor; 0 between anchor and fairlead.

    The excess of a slack line lies in a heap at its anchor.  The heap is laid out along the first facet, past the
    anchor, and the sea surface over it is moved with the facet. A part lifted by a buoy then has the same height as
    over the anchor. On a slope on which the line slides under tension, the part is at its true place.
    """
    if q[X] >= line.bed[0, 0] or line.no_bed or (slides_on(line, 0) and q[H] > 2 * line.least):
        return 0.0
    return math.tan(line.bed[0, 2])


@kernel(inline=True)
def level_in_sea(line, q):
    """Height of the line at the present place; a place beyond the anchor is moved with the bed to the anchor."""
    return q[Z] - (q[X] - line.bed[0, 0]) * tangent_beyond(line, q)


@kernel(inline=True)
def smoothed_weight(line, load, z):
    """Weight (N) and state of a point load at z; a buoy loses its lift linearly over the height `line.soft`."""
    wet, dry = line.loads[load, 1], line.loads[load, 2]
    if wet >= 0 or z <= line.surface - line.soft:
        return wet, SUBMERGED
    if z >= line.surface:
        return dry, EMERGED
    share = (line.surface - z) / line.soft
    return share * wet + (1 - share) * dry, FLOATING


@kernel()
def length_to(q, x, weight, factor, flexibility):
    """Length of a free piece down to the abscissa x: Newton on u = asinh(V₋/H), in which Δx is convex."""
    h = q[H]
    start = math.asinh(q[V] / h)
    target = (q[X] - x) * weight / h
    pull = flexibility * h
    u = start - target / (factor + pull * math.cosh(start)) if abs(start) < 300 else start - target / factor
    # a span whose tension rises to e^100 H before it gets to x ends short of x; it is far above the bed
    low, high = max(start - target / factor, min(start, 0.0) - 100.0), start
    u = min(max(u, low), high)
    rise = 0.0
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
    return h / weight * rise
