"""Static mooring lines: forces and stiffness of an elastic line for a given position of its fairlead.

The line is uniform, hangs in a vertical plane, and may lie on a straight bed through its anchor with Coulomb
friction pulling against the fairlead.  Bending, current on the line and history of friction are neglected.
Kernels in `uniform` solve the lines; here input and results are checked.
"""

from typing import NamedTuple

import numpy as np

from .state import BEYOND_REACH, LineError

TOLERANCE = 1e-10  # error of the recomputed fairlead position, over the line length
_LARGEST, _SMALLEST, _STEEPEST = np.finfo(float).max, np.nextafter(0.0, 1.0), np.nextafter(1.5, 0.0)
LIMITS = (  # least value, largest value and text of the allowed range, for each column of `_lines`
    ("x", 0.0, _LARGEST, "finite, at least 0 m"),
    ("z", -_LARGEST, _LARGEST, "finite"),
    ("length", _SMALLEST, _LARGEST, "finite, above 0 m"),
    ("weight", _SMALLEST, _LARGEST, "finite, above 0 N/m"),
    ("axial_stiffness", _SMALLEST, np.inf, "above 0 N, inf for an inextensible line"),
    ("bed_friction", 0.0, _LARGEST, "finite, at least 0"),
    ("bed_slope", -_STEEPEST, _STEEPEST, "between −1.5 and 1.5 rad"),
)
LEAST, MOST = (np.array([limit[i] for limit in LIMITS]) for i in (1, 2))


class LineSolution(NamedTuple):
    """Forces, N, and lengths, m, of solved lines; all arrays have one shape (...).

    horizontal_fairlead, vertical_fairlead : pull on the fairlead towards the anchor and down
    horizontal_anchor, vertical_anchor : pull on the anchor towards the fairlead and up
    grounded_length : unstretched length on the bed
    stiffness : (..., 2, 2) N/m, ∂(H, V at the fairlead)/∂(x, z)
    status : (...,) values of `State`; beyond reach forces are infinite and the stiffness is nan
    """

    horizontal_fairlead: np.ndarray
    vertical_fairlead: np.ndarray
    horizontal_anchor: np.ndarray
    vertical_anchor: np.ndarray
    grounded_length: np.ndarray
    stiffness: np.ndarray
    status: np.ndarray

    @property
    def tension_fairlead(self):
        """Tension at the fairlead, N; shape (...,)"""
        return np.hypot(self.horizontal_fairlead, self.vertical_fairlead)

    @property
    def tension_anchor(self):
        """Tension at the anchor, N; shape (...,)"""
        return np.hypot(self.horizontal_anchor, self.vertical_anchor)


def solve_lines(
    x,
    z,
    length,
    weight,
    axial_stiffness=np.inf,
    bed_friction=0.0,
    bed_slope=0.0,
    *,
    bed=True,
    beyond_reach="raise",
):
    """Forces and stiffness of lines from anchor (0, 0) to fairlead (x, z).

    x, z : horizontal distance ≥ 0 and height of the fairlead above the anchor, m
    length : unstretched length, m; weight : submerged weight, N/m; axial_stiffness : EA, N, may be inf
    bed_friction : friction coefficient, ≥ 0; bed_slope : rad, positive where the bed rises towards the fairlead
    bed : False for a line that may hang below its lower end
    beyond_reach : "raise", or "mark" to return infinite forces for inextensible lines that cannot reach
    returns : LineSolution; all arguments broadcast
    raises : LineError naming the first line without a solution; ValueError for impossible input
    """
    from .uniform import solve_uniform_lines

    if beyond_reach not in ("raise", "mark"):
        raise ValueError(f"beyond_reach is {beyond_reach!r}; allowed: 'raise', 'mark'")
    lines, shape = _lines(x, z, length, weight, axial_stiffness, bed_friction, bed_slope, bed)
    found = solve_uniform_lines(lines, bed)
    status, missed = found[:, 9].astype(int), found[:, 10]
    if not (missed <= TOLERANCE * np.maximum(lines[:, 2], np.hypot(lines[:, 0], lines[:, 1]))).all():
        bad = ~(missed <= TOLERANCE * np.maximum(lines[:, 2], np.hypot(lines[:, 0], lines[:, 1])))
        raise _failure(lines[bad], f"was missed by {missed[bad][0]:.3g} m")
    if beyond_reach == "raise" and (status == BEYOND_REACH).any():
        raise _failure(lines[status == BEYOND_REACH], "cannot be reached by an inextensible line")
    values = [column.reshape(shape) for column in found.T[:5]]
    return LineSolution(*values, found[:, 5:9].reshape(*shape, 2, 2), status.reshape(shape))


def span_at_tension(
    horizontal_tension,
    z,
    length,
    weight,
    axial_stiffness=np.inf,
    bed_friction=0.0,
    bed_slope=0.0,
):
    """Span x (m) at which a line on a bed has a given horizontal tension, and its remaining length on the bed (m).

    horizontal_tension : N, > 0; the other arguments as in `solve_lines`
    returns : x, grounded length
    raises : LineError where the bed rises above the fairlead; ValueError for impossible input
    """
    from .uniform import spans_at_tension

    H = np.asarray(horizontal_tension, float)
    falls = np.asarray(bed_slope, float) < 0  # then the bed is below any fairlead, far enough from the anchor
    over = bool(np.all(falls)) or np.where(falls, np.inf, z).min() >= 0
    lines, shape = _lines(np.zeros_like(H), z, length, weight, axial_stiffness, bed_friction, bed_slope, not over)
    H = np.broadcast_to(H, shape).flatten()
    bad = ~((H > 0) & np.isfinite(H))
    if bad.any():
        raise ValueError(f"horizontal_tension is {H[bad][0]:g} N; allowed: finite values above 0")
    x, lying = spans_at_tension(lines, H).T
    for wrong, error, what in (
        (
            np.isnan(lying),
            LineError,
            "would be below the upper end of the bed under the line; give less horizontal tension",
        ),
        (np.isnan(x), ValueError, "is higher than an inextensible line is long; give a longer line, or its stiffness"),
    ):
        if wrong.any():
            i = int(np.argmax(wrong))
            where = f"a fairlead {lines[i, 1]:g} m above the anchor on a line of {lines[i, 2]:g} m with {H[i]:g} N"
            raise error(f"{where} {what}")
    return x.reshape(shape), lying.reshape(shape)


def profile(x, z, length, weight, axial_stiffness=np.inf, bed_friction=0.0, bed_slope=0.0, *, bed=True, points=101):
    """Points along one line for drawing: (points, 2) m, x and z from the anchor at (0, 0) to the fairlead."""
    from .uniform import points_along

    line = solve_lines(x, z, length, weight, axial_stiffness, bed_friction, bed_slope, bed=bed)
    if line.horizontal_fairlead.shape:
        raise ValueError(
            f"profile is for one line, not for an array of lines of shape {line.horizontal_fairlead.shape}"
        )
    row = np.array([*map(float, line[:5]), *line.stiffness.ravel(), float(line.status)])
    given = (x, z, length, weight, 1 / axial_stiffness, bed_friction, bed_slope)
    return points_along(row, tuple(map(float, given)), np.linspace(0.0, length, points))


def _lines(x, z, length, weight, axial_stiffness, friction, slope, bed):
    """Checked input, (n, 7) in the order of `uniform`, and its original shape."""
    given = [np.asarray(v, float) for v in (x, z, length, weight, axial_stiffness, friction, slope)]
    shapes = {v.shape for v in given}
    shape = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
    lines = np.empty((*shape, 7))
    for i, value in enumerate(given):
        lines[..., i] = value
    lines = lines.reshape(-1, 7)
    good = (lines >= LEAST) & (lines <= MOST)
    if not good.all():
        column = int(np.argmin(good.all(axis=0)))
        name, _, _, allowed = LIMITS[column]
        raise ValueError(f"line {name} is {lines[~good[:, column], column][0]:g}; allowed: {allowed}")
    if bed:
        below = lines[:, 1] - lines[:, 0] * np.tan(lines[:, 6]) < 0
        if below.any():
            allowed = "at or above the bed (use bed=False where there is none)"
            raise ValueError(f"line z is {lines[below, 1][0]:g}; allowed: {allowed}")
    lines[:, 4] = 1.0 / lines[:, 4]
    return lines, shape


def _failure(lines, what):
    x, z, length, weight, flexibility = lines[0, :5]
    return LineError(
        f"{len(lines)} line(s): fairlead at x = {x:.6g} m, z = {z:.6g} m {what}: "
        f"length {length:.6g} m, weight {weight:.6g} N/m, "
        f"EA {1 / flexibility if flexibility > 0 else np.inf:.6g} N"
    )
