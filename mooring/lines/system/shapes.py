"""The shape of every line of a system at rest, for pictures and checks.

From end a, with s the unstretched length, the vertical part of the tension is N(s) = −v_a + w s where the line
hangs and 0 on the bed, and  dx/ds = H/T (1 + T/EA),  dz/ds = N/T (1 + T/EA):

    x = (H/w) [asinh N/H] + H s/EA,    z = [T]/w + [N²]/2wEA.
"""

import numpy as np

from ..catenary.state import State
from .composite import points_along
from .hawser import Hawser
from .surfacing import surfacing_shape


def line_shapes(state, points=80):
    """One (points, 3) m array for each line, from end a to end b of a SystemEquilibrium."""
    return [_shape(state, i, points) for i in range(len(state.system.lines))]


def composite_points(state, number, s):
    """Points in space, m, at unstretched lengths s (k,) m from end a of a multi-segment line; shape (k, 3)."""
    one = next(one for one in state.system.composites if one.number == number)
    ends = state.points[state.system.arrays.ends[number]]
    return points_along(one, state.lines.solutions[number], *(ends[::-1] if one.flipped else ends), s)


def loads_on_lines(state):
    """Positions in space of the sinkers and buoys on multi-segment lines, m; shape (k, 3)"""
    return _places(state, lambda line: [load.position for load in line.loads])


def joints_of_lines(state):
    """Places in space where the segments of lines meet, m; shape (k, 3)"""
    return _places(state, lambda line: np.cumsum([segment.length for segment in line.segments])[:-1])


def beds_of_lines(state):
    """Beds of the lines with their own bed, [(k, 3) m in space], from the anchor to below the line's other end"""
    found = []
    for one in state.system.composites:
        if state.system.lines[one.number].bed is None:
            continue
        A, B = state.points[state.system.arrays.ends[one.number]][:: -1 if one.flipped else 1]
        span, bed = np.hypot(*(B - A)[:2]), one.line.bed.points
        slope = (bed[-1, 1] - bed[-2, 1]) / (bed[-1, 0] - bed[-2, 0])  # the last facet has no end
        x = np.unique([*bed[bed[:, 0] < span, 0], span])
        z = np.interp(x, *bed.T) + slope * np.maximum(0.0, x - bed[-1, 0])
        outward = (B - A)[:2] / span if span > 0 else np.array([1.0, 0.0])
        found.append(np.column_stack([A[:2] + x[:, None] * outward, A[2] + z]))
    return found


def _places(state, lengths):
    lines = {i: state.system.lines[i] for i in state.lines.solutions}
    found = [composite_points(state, i, np.asarray(lengths(line), float)) for i, line in lines.items()]
    return np.concatenate([np.empty((0, 3)), *found])


def _shape(state, i, count):
    system, forces, line = state.system, state.lines, state.system.lines[i]
    a, b = state.points[system.arrays.ends[i]]
    if isinstance(line, Hawser):
        return a + np.linspace(0, 1, count)[:, None] * (b - a)
    one = next((one for one in system.surfacing if one.number == i), None)
    if one is not None:
        return surfacing_shape(one, *((b, a) if one.flipped else (a, b)), count)
    away = (b - a)[:2]
    span = np.hypot(*away)
    outward = away / span if span > 0 else np.array([1.0, 0.0])
    if i in forces.solutions:
        one = next(one for one in system.composites if one.number == i)
        s = forces.solutions[i].places(count)
        return composite_points(state, i, line.length - s[::-1] if one.flipped else s)
    w, flexibility = line.type.weight, 1 / line.type.axial_stiffness
    if forces.status[i] == State.SUSPENDED:
        s = np.linspace(0, line.length, count)
        x, z = _hung(forces.horizontal_b[i], -forces.vertical_a[i], s, w, flexibility)
    else:
        # a free piece at each end and the bed between their lift-off points
        Sa, Sb = forces.vertical_a[i] / w, forces.vertical_b[i] / w
        low = max(int(0.3 * count), 2)
        xa, za = _hung(forces.horizontal_a[i], -forces.vertical_a[i], np.linspace(0, Sa, low), w, flexibility)
        xb, zb = _hung(forces.horizontal_b[i], 0.0, np.linspace(0, Sb, count - low), w, flexibility)
        x = np.concatenate([xa, span - xb[-1] + xb])
        z = np.concatenate([za, b[2] - a[2] - zb[-1] + zb])
    return np.column_stack([a[:2] + x[:, None] * outward, a[2] + z])


def _hung(H, N0, s, weight, flexibility):
    """x and z from the start of a free piece whose vertical tension starts at N0."""
    N = N0 + weight * s
    z = (np.hypot(H, N) - np.hypot(H, N0)) / weight + 0.5 * flexibility * (N * N - N0 * N0) / weight
    if H <= 0:
        return np.zeros_like(s), z
    return H / weight * (np.arcsinh(N / H) - np.arcsinh(N0 / H)) + flexibility * H * s, z
