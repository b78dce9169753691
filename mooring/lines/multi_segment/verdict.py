"""Kernels that judge a solved line by its pieces alone, regardless of the way in which its contacts were found.

No piece has a negative length or lies below the bed. A piece on the bed has tension T ≥ 0 and a friction that the bed
can give. Each piece ends where the next piece begins, the last piece ends at the anchor, and forces balance where
two pieces meet:

    R = (H₋ − H₊, V₋ − V₊ + f),   + above the place, − below it, f the weight of the point load there,

is zero off the bed. On the bed R is the force of the bed and lies in its cone of friction. A sinker on a slope
therefore pulls with the force in excess of friction, and on a facet T jumps only at loads. Over a vertex T changes
no more than the tension of a rope over a bollard. Parts without tension are exempt; `StaticSolution.slides` reports
them. A buoy is under water, out of the water, or in the surface with a weight between its weights in and out of water.
"""

import math

from hakobune.bem.kernels.jit import kernel

from .free_span import free_step, length_to, level_in_sea
from .friction import bed_step
from .line_data import EMERGED, FLOATING, H, S, T, V, X, Z, slides_on

FAR = 1e-8  # largest penetration, and distance of a buoy from the place of its state, over the line's length
STRAY = 1e-7  # largest imbalance of forces, over the largest tension


@kernel()
def height_over_bed(line, x, z):
    """Height of a point over the bed, m; the first and the last facet are extended."""
    facet = line.bed.shape[0] - 1
    while facet > 0 and line.bed[facet, 0] > x:
        facet -= 1
    return z - line.bed[facet, 1] - (x - line.bed[facet, 0]) * math.tan(line.bed[facet, 2])


@kernel()
def put_top(piece, q):
    """State at the upper end of a piece."""
    q[S], q[X], q[Z] = piece[1], piece[3], piece[4]
    if piece[0] == 1:
        q[H], q[V] = piece[5] * math.cos(piece[10]), piece[5] * math.sin(piece[10])
    else:
        q[H], q[V] = piece[5], piece[6]


@kernel()
def go_down(piece, q, g):
    """State at the lower end of a piece."""
    put_top(piece, q)
    if piece[0] == 1:
        q[T] = piece[5]
        bed_step(q, g, piece[2], piece[6], piece[8], piece[9], piece[10])
        q[H], q[V] = q[T] * math.cos(piece[10]), q[T] * math.sin(piece[10])
    else:
        free_step(q, g, piece[2], piece[7], piece[8], piece[9])


@kernel()
def clears_bed(line, piece, q, g, far):
    """Whether a free piece is nowhere more than `far` below the bed; checked at its end, where it is parallel to a
    facet, and at vertices.
    """
    top, h, v = piece[3], piece[5], piece[6]
    go_down(piece, q, g)
    bottom = q[X]
    if height_over_bed(line, bottom, q[Z]) < -far:  # also for the heap beyond the anchor's place, laid out there
        return False
    for facet in range(line.bed.shape[0]):
        right = line.bed[facet + 1, 0] if facet + 1 < line.bed.shape[0] else math.inf
        left = line.bed[facet, 0] if facet > 0 else -math.inf
        down = (v - h * math.tan(line.bed[facet, 2])) / piece[7]
        if 0 < down < piece[2]:
            put_top(piece, q)
            free_step(q, g, down, piece[7], piece[8], piece[9])
            if left <= q[X] <= right and height_over_bed(line, q[X], q[Z]) < -far:
                return False
        if facet > 0 and min(bottom, top) < left < max(bottom, top):
            put_top(piece, q)
            if h < 0:  # the same with x reversed
                q[H], q[X], left = -h, -top, -left
            free_step(q, g, length_to(q, left, piece[7], piece[8], piece[9]), piece[7], piece[8], piece[9])
            if q[Z] - line.bed[facet, 1] < -far:
                return False
    return True


@kernel()
def lies_well(line, piece, far, stray):
    """Whether a piece on the bed has a tension that is never negative, and a friction within the limit μN."""
    if line.no_bed:
        return False
    end = piece[5] - piece[6] * piece[2]
    if not (piece[5] >= -stray and end >= -stray and abs(height_over_bed(line, piece[3], piece[4])) <= far):
        return False
    if piece[3] <= line.bed[0, 0]:
        return True
    grip = abs(piece[6] - piece[7] * math.sin(piece[10])) * piece[2]
    most = piece[7] * line.friction * abs(math.cos(piece[10])) * piece[2]
    return grip <= most + stray or max(piece[5], end) <= stray


@kernel()
def is_idle(piece, stray):
    """Whether a piece lies on the bed without tension."""
    return piece[0] == 1 and max(piece[5], piece[5] - piece[6] * piece[2]) <= stray


@kernel()
def balanced(line, q, below, load, states, slack, idle, far, stray):
    """Whether forces balance where two pieces meet; q : lower end of the upper piece; below : upper end of the lower
    piece.

    slack : whether the part beyond the anchor's place is a heap at the anchor (`free_span.tangent_beyond`)
    idle : whether both pieces lie on the bed without tension or in the heap at the anchor
    """
    weight = 0.0
    if load >= 0:
        level = (level_in_sea(line, q) if slack else q[Z]) - line.surface
        weight = line.loads[load, 2 if states[load] == EMERGED else 1]
        if states[load] == FLOATING:
            weight = min(max(q[V] - below[V], line.loads[load, 1]), line.loads[load, 2])
            if abs(level) > far:
                return False
        elif line.loads[load, 1] < 0 and (level < -far if states[load] == EMERGED else level > far):
            return False
    across, up = below[H] - q[H], below[V] - q[V] + weight
    if math.hypot(across, up) <= stray:
        return True
    if line.no_bed or abs(height_over_bed(line, q[X], q[Z])) > far:
        return False
    if idle:
        return True
    if load < 0:  # line over a vertex
        upper, lower = math.hypot(q[H], q[V]), math.hypot(below[H], below[V])
        turn = math.atan2(abs(q[H] * below[V] - q[V] * below[H]), q[H] * below[H] + q[V] * below[V])
        if abs(upper - lower) > math.expm1(line.friction * turn) * min(upper, lower) + stray:
            return False
    return pushed(line, q[X], across, up, far, stray)


@kernel()
def pushed(line, x, across, up, far, stray):
    """Whether the bed at x, m, can push with a given force, which must lie between the facet normals at x, widened
    by friction.
    """
    low, high = math.inf, -math.inf
    for facet in range(line.bed.shape[0]):
        right = line.bed[facet + 1, 0] if facet + 1 < line.bed.shape[0] else math.inf
        left = line.bed[facet, 0] if facet > 0 else -math.inf
        if left - far <= x <= right + far:
            low, high = min(low, line.bed[facet, 2]), max(high, line.bed[facet, 2])
    away = abs(math.atan2(-across, up) - 0.5 * (low + high))
    beyond = min(away, 2 * math.pi - away) - 0.5 * (high - low) - math.atan(line.friction)
    return math.hypot(across, up) * math.sin(min(max(beyond, 0.0), 0.5 * math.pi)) <= stray


@kernel()
def heaps(line, rows, count, far, stray):
    """Whether a slack line is longer than the distance to its anchor requires and nothing pulls on the excess
    length.
    """
    for i in range(count):
        piece = rows[i]
        bottom = rows[i + 1, 3] if i + 1 < count else piece[3]
        if piece[0] == 0 and bottom < line.bed[0, 0] - far and (piece[3] > line.bed[0, 0] or piece[5] > stray):
            return False
        if piece[0] == 1 and piece[3] <= line.bed[0, 0] and piece[5] > stray:
            return False
    last = rows[count - 1]
    if slides_on(line, 0) and last[0] == 1 and last[5] - last[6] * last[2] > stray:  # a pulled end is no heap
        return False
    return last[3] <= line.bed[0, 0] + far or last[0] == 1


@kernel()
def stands(line, rows, count, states, slack, q, below, g):
    """Whether the pieces of a line are in equilibrium; q, below : memory for two states; g : array without columns."""
    far, stray = FAR * line.length, 100 * line.least
    for i in range(count):
        stray = max(stray, STRAY * (abs(rows[i, 5]) + (abs(rows[i, 6]) if rows[i, 0] == 0 else 0.0)))
    load = line.loads.shape[0] - 1
    for i in range(count):
        piece = rows[i]
        if not piece[2] >= -far:
            return False
        if piece[0] == 1:
            if not lies_well(line, piece, far, stray):
                return False
        elif not (line.no_bed or clears_bed(line, piece, q, g, far)):
            return False
        go_down(piece, q, g)
        if piece[0] == 1 and q[X] > line.bed[0, 0] and abs(height_over_bed(line, q[X], q[Z])) > far:
            return False
        if i + 1 < count:
            put_top(rows[i + 1], below)
            if not math.hypot(q[X] - below[X], q[Z] - below[Z]) <= far:
                return False
            q[X], q[Z] = below[X], below[Z]
            at_load = load >= 0 and abs(line.loads[load, 0] - below[S]) <= 1e-14 * line.length
            idle = is_idle(piece, stray) and is_idle(rows[i + 1], stray)
            idle = idle or (slack and q[X] <= line.bed[0, 0] + far)
            if not balanced(line, q, below, load if at_load else -1, states, slack, idle, far, stray):
                return False
            load -= 1 if at_load else 0
    if slack:
        return heaps(line, rows, count, far, stray)
    return math.hypot(q[X] - line.bed[0, 0], q[Z] - line.bed[0, 1]) <= far
