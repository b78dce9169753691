"""A uniform line lighter than water: a heavy line upside down, with the sea surface as its bed.

Measured downwards from the surface, its weight is −w and its ends are at the depths a (anchor) and b (fairlead) over a
flat bed without friction: parts that would rise out of the sea float in its surface.  `flat_bed` solves the line; a
downward pull in `flat_bed` is an upward pull here.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .flat_bed import ROW, solve_line
from .free_piece import free_piece
from .solve import LineSolution
from .state import LineError, State


@kernel()
def solve_rows(rows, x, a, b, length, lift, flexibility):
    """`flat_bed.solve_line` of (n,) lines upside down into rows (n, ROW)."""
    for i in range(x.size):
        solve_line(rows[i], x[i], a[i], b[i], length[i], lift[i], flexibility[i], 0.0, True)


def solve_buoyant_lines(x, z, length, weight, axial_stiffness, surface):
    """Forces and stiffness of lines lighter than water from anchor (0, 0) to fairlead (x, z), both under water.

    x : span, m, ≥ 0; z : height, m; length : unstretched length, m; weight : submerged weight, N/m, below 0
    axial_stiffness : EA, N, may be inf
    surface : height of the sea surface above the anchor, m. All arguments broadcast.
    returns : LineSolution, whose grounded length floats in the surface
    raises : LineError if a line is too short; ValueError if the input is impossible
    """
    x, z, length, weight, EA, surface = np.broadcast_arrays(
        *(np.asarray(v, float) for v in (x, z, length, weight, axial_stiffness, surface))
    )
    for name, value, good, allowed in (
        ("x", x, np.isfinite(x) & (x >= 0), "finite, at least 0 m"),
        ("length", length, np.isfinite(length) & (length > 0), "finite, above 0 m"),
        (
            "weight",
            weight,
            np.isfinite(weight) & (weight < 0),
            "finite and below 0 N/m; use `solve_lines` for lines heavier than water",
        ),
        ("axial_stiffness", EA, EA > 0, "above 0 N, inf for an inextensible line"),
        ("surface", surface, np.isfinite(surface) & (surface >= 0), "finite, at least 0 m above the anchor"),
        ("z", z, np.isfinite(z) & (z <= surface), "at most the height of the surface above the anchor"),
    ):
        if not np.all(good):
            raise ValueError(f"line {name} is {value[~good].flat[0]:g}; allowed: {allowed}")
    rows, flat = np.zeros((x.size, ROW)), [np.ascontiguousarray(v.ravel()) for v in (x, surface, surface - z, length)]
    solve_rows(rows, *flat, -weight.ravel(), 1 / EA.ravel())
    status = rows[:, 0].astype(int)
    lost = status == State.BEYOND_REACH
    if np.any(lost):
        i = int(np.argmax(lost))
        raise LineError(
            f"{np.count_nonzero(lost)} line(s): fairlead at x = {x.flat[i]:.6g} m, z = {z.flat[i]:.6g} m cannot be "
            f"reached by an inextensible line of {length.flat[i]:.6g} m"
        )
    stiffness = np.stack([rows[:, 9], -rows[:, 11], -rows[:, 15], rows[:, 17]], axis=-1).reshape(*x.shape, 2, 2)
    columns = (rows[:, 2], 0.0 - rows[:, 4], rows[:, 1], rows[:, 3], rows[:, 5])
    return LineSolution(*(v.reshape(x.shape) for v in columns), stiffness, status.reshape(x.shape))


def buoyant_profile(x, z, length, weight, axial_stiffness, surface, points=101):
    """Points along one line for drawing: (points, 2) m from the anchor; idle floating parts are drawn stretched out."""
    found = solve_buoyant_lines(x, z, length, weight, axial_stiffness, surface)
    lift, flexibility, H = -float(weight), 1 / axial_stiffness, float(found.horizontal_fairlead)
    floating, first = float(found.grounded_length), float(found.vertical_anchor)
    touches = found.status != State.SUSPENDED
    rising = first / lift if touches else length
    along = 1 + flexibility * H
    if found.status == State.SLACK and floating > 0:
        along = x / floating
    out = []
    for s in np.linspace(0.0, length, points):
        dx, up = free_piece(H, -first, min(s, rising), lift, flexibility)
        level = -up
        if s > rising:
            dx += along * min(s - rising, floating)
            more, down = free_piece(H, 0.0, max(s - rising - floating, 0.0), lift, flexibility)
            dx, level = dx + more, level - down
        out.append((dx, level))
    return np.array(out)
