"""Kernels of one uniform line between an anchor at (0, 0) and a fairlead, one line at a time.

The line is sorted into its `State` and solved by the closed form of that state (`suspended`, `sloping_bed`). The
position of its fairlead is recomputed from the forces, so that a wrong answer is noticed.  Functions of `solve`
check input and result.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .free_piece import free_piece
from .sloping_bed import (
    free_length_at_height,
    grounded_stiffness,
    hanging_length,
    lying_end,
    lying_reach,
    slides,
    solve_grounded,
)
from .state import BEYOND_REACH, GROUNDED, SLACK, SUSPENDED
from .suspended import suspended_shape, suspended_span, suspended_stiffness

# H and V at the fairlead and at the anchor, length on the bed, ∂(H, V)/∂(x, z) row by row, state, distance missed
COLUMNS = 11


@kernel()
def solve_uniform(row, line, bed):
    """Fill a row of `COLUMNS` for a line (x, z, length, weight, 1/EA, friction, slope).

    A line whose free shape would leave its anchor below the slope of the bed lies on the bed. If it can lie up to the
    point below its fairlead and hang vertically from there, it is slack.
    On a bed that falls from the anchor too steeply for friction to hold the line, the excess length lies in a bight
    further down. Seen from the bight, the bed rises.
    """
    x, z, length, weight, flexibility, friction, slope = line
    tan = math.tan(slope)
    if bed:
        plumb = hanging_length(z - x * tan, weight, flexibility)
        if length >= plumb:
            lying = length - plumb
            if lying_reach(0.0, lying, weight, flexibility, slope, friction) >= x / math.cos(slope):
                if slides(-slope, friction):
                    put_mirrored(row, line)
                else:
                    put_slack(row, plumb, lying, weight, flexibility, slope, friction)
                return
    t, sine, cosine = suspended_shape(x, z, length, weight, flexibility)
    if math.isinf(t):
        row[:4], row[5:9] = math.inf, math.nan
        row[4], row[9] = 0.0, BEYOND_REACH
        return
    half = 0.5 * weight * length
    H, V = half * t * sine, half * (1 + math.sqrt(1 + t * t) * cosine)
    if not bed or V - weight * length >= H * tan:
        xx, xz, zz = suspended_stiffness(t, sine, cosine, length, weight, flexibility)
        row[0], row[1], row[2], row[3], row[4] = H, V, H, V - weight * length, 0.0
        row[5], row[6], row[7], row[8], row[9] = xx, xz, xz, zz, SUSPENDED
        return
    put_grounded(row, line)


@kernel()
def put_grounded(row, line):
    """A line that lies on the bed from its anchor to the lift-off point, or hangs from its anchor in a bight."""
    x, z, length, weight, flexibility, friction, slope = line
    tan = math.tan(slope)
    H, S = solve_grounded(x, z, length, weight, flexibility, slope, friction)
    end, _ = lying_end(H, length - S, weight, slope, friction)
    row[0], row[1], row[2], row[3] = H, H * tan + weight * S, end * math.cos(slope), end * math.sin(slope)
    row[4], row[9] = length - S, GROUNDED
    row[5], row[6], row[7], row[8] = grounded_stiffness(H, S, length, weight, flexibility, slope, friction)


@kernel()
def put_mirrored(row, line):
    """A line whose bight lies beyond its fairlead; such a line pulls the fairlead away from the anchor."""
    x, z, length, weight, flexibility, friction, slope = line
    put_grounded(row, (-x, z, length, weight, flexibility, friction, -slope))
    row[0], row[2], row[6], row[7] = -row[0], -row[2], -row[6], -row[7]


@kernel()
def put_slack(row, plumb, lying, weight, flexibility, slope, friction):
    """A line that hangs plumb above a heap on the bed; on a slope the part on the bed may pull at its anchor."""
    end, _ = lying_end(0.0, lying, weight, slope, friction)
    rate = weight / (1 + flexibility * weight * plumb)
    row[0], row[1], row[2], row[3] = 0.0, weight * plumb, end * math.cos(slope), end * math.sin(slope)
    row[4], row[5], row[6], row[7], row[8], row[9] = lying, 0.0, 0.0, -math.tan(slope) * rate, rate, SLACK


@kernel()
def distance_missed(row, line):
    """Distance, m, between the fairlead and the end of the solved line, which its forces determine; for a slack line
    only the height counts."""
    x, z, length, weight, flexibility, friction, slope = line
    H = row[0]
    if H < 0:
        x, slope, H = -x, -slope, -H
    free = length - row[4]
    dx, dz = free_piece(H, row[1] - weight * free, free, weight, flexibility)
    if row[9] == SLACK:
        return abs(dz - (z - x * math.tan(slope)))
    along = lying_reach(H, row[4], weight, flexibility, slope, friction)
    return math.hypot(dx + along * math.cos(slope) - x, dz + along * math.sin(slope) - z)


@kernel()
def solve_uniform_lines(lines, bed):
    """lines : (n, 7) as in `solve_uniform`; returns (n, COLUMNS)"""
    found = np.empty((lines.shape[0], COLUMNS))
    for i in range(lines.shape[0]):
        given = lines[i]
        line = (given[0], given[1], given[2], given[3], given[4], given[5], given[6])
        solve_uniform(found[i], line, bed)
        found[i, 10] = 0.0 if found[i, 9] == BEYOND_REACH else distance_missed(found[i], line)
    return found


@kernel()
def spans_at_tension(lines, H):
    """Span and length on the bed of lines whose H is given instead of x; shape (n, 2).

    The span is nan where a line is too short to hang; the length is nan where the bed rises above the fairlead.
    """
    found = np.empty((lines.shape[0], 2))
    for i in range(lines.shape[0]):
        _, z, length, weight, flexibility, friction, slope = lines[i]
        S = free_length_at_height(H[i], z, length, weight, flexibility, slope, friction)
        if length < S:
            found[i, 0], found[i, 1] = suspended_span(H[i], z, length, weight, flexibility), 0.0
        else:
            x, _ = free_piece(H[i], H[i] * math.tan(slope), S, weight, flexibility)
            along = lying_reach(H[i], length - S, weight, flexibility, slope, friction)
            found[i, 0], found[i, 1] = x + along * math.cos(slope), length - S
    return found


@kernel()
def points_along(row, line, s):
    """Points x and z from the anchor at unstretched lengths s (m,) of a solved line; shape (m, 2)."""
    x, _, length, weight, flexibility, friction, slope = line
    H, lying, side = row[0], row[4], 1.0
    if H < 0:
        H, slope, side = -H, -slope, -1.0
    low = row[1] - weight * (length - lying)
    whole = lying_reach(H, lying, weight, flexibility, slope, friction)
    points = np.empty((s.size, 2))
    for i in range(s.size):
        on_bed = min(s[i], lying)
        if row[9] == SLACK:  # the heap is drawn stretched out
            distance = on_bed * (x / math.cos(slope) / lying) if lying > 0 else 0.0
        else:
            # tension falls to zero from the lift-off point downwards, so measure from there
            distance = whole - lying_reach(H, lying - on_bed, weight, flexibility, slope, friction)
        dx, dz = free_piece(H, low, max(s[i] - lying, 0.0), weight, flexibility)
        points[i, 0], points[i, 1] = side * (distance * math.cos(slope) + dx), distance * math.sin(slope) + dz
    return points
