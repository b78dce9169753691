"""Static mooring lines: forces and stiffness of an elastic line for a given position of its fairlead.

The line is uniform, hangs in a vertical plane, and may lie on a straight bed through its anchor with Coulomb
friction pulling against the fairlead.  Bending, current on the line and history of friction are neglected.
Each line is sorted into one of four states, solved in closed form up to one monotone scalar equation
(kernels in `lines.hanging.uniform`), and its geometry is recomputed from its forces before it is returned.
"""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from . import grounded, suspended
from .grounded import Bed, free_span

TOLERANCE = 1e-10  # of the line length, on the recomputed fairlead position


class LineError(ValueError):
    """A line that has no equilibrium, or whose equilibrium was not found."""


class State(IntEnum):
    """What a line does: hang plumb with H = 0, lie partly on the bed, touch nothing, or fail to reach."""

    SLACK = 0
    GROUNDED = 1
    SUSPENDED = 2
    BEYOND_REACH = 3


class LineSolution(NamedTuple):
    """Forces of solved lines, N, and lengths, m; all of one shape (...).

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
        """(...,) N"""
        return np.hypot(self.horizontal_fairlead, self.vertical_fairlead)

    @property
    def tension_anchor(self):
        """(...,) N"""
        return np.hypot(self.horizontal_anchor, self.vertical_anchor)


class _Lines(NamedTuple):
    x: np.ndarray
    z: np.ndarray
    length: np.ndarray
    weight: np.ndarray
    flexibility: np.ndarray
    friction: np.ndarray
    slope: np.ndarray

    def some(self, chosen):
        return _Lines(*(value[chosen] for value in self))

    @property
    def properties(self):
        return self.length, self.weight, self.flexibility

    @property
    def bed(self):
        return Bed(self.slope, self.friction)


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
    length : unstretched, m; weight : submerged, N/m; axial_stiffness : EA in N, may be inf
    bed_friction : ≥ 0; bed_slope : rad, positive where the bed rises towards the fairlead
    bed : False for a line that may hang below its lower end
    beyond_reach : "raise", or "mark" to return infinite forces for inextensible lines that cannot reach
    All broadcast.  returns : LineSolution
    raises : LineError naming the first line without a solution; ValueError for impossible input
    """
    from .uniform import solve_uniform_lines

    if beyond_reach not in ("raise", "mark"):
        raise ValueError(f"beyond_reach is {beyond_reach!r}; allowed: 'raise', 'mark'")
    lines, shape = _lines(x, z, length, weight, axial_stiffness, bed_friction, bed_slope, bed)
    found = solve_uniform_lines(np.stack(lines, axis=-1), bed)
    H, V, H_anchor, V_anchor, lying = found[:, :5].T
    status = found[:, 9].astype(int)
    lost = status == State.BEYOND_REACH
    if np.any(lost) and beyond_reach == "raise":
        raise _failure(lines.some(lost), "cannot be reached by an inextensible line")
    _check(lines.some(~lost), H[~lost], V[~lost], lying[~lost], status[~lost])
    values = (H, V, H_anchor, V_anchor, lying)
    k = found[:, 5:9].reshape(*shape, 2, 2)
    return LineSolution(*(v.reshape(shape) for v in values), k, status.reshape(shape))


def span_at_tension(
    horizontal_tension,
    z,
    length,
    weight,
    axial_stiffness=np.inf,
    bed_friction=0.0,
    bed_slope=0.0,
):
    """Span x (m) at which lines on a bed carry a given horizontal tension, and the length left on the bed (m).

    horizontal_tension : N, > 0; the other arguments as in `solve_lines`
    returns : x, grounded length
    """
    H = np.asarray(horizontal_tension, float)
    lines, shape = _lines(0.0 * H, z, length, weight, axial_stiffness, bed_friction, 0.0 * H, True)
    H, slope = np.broadcast_to(H, shape).ravel(), np.broadcast_to(bed_slope, shape).ravel().astype(float)
    if not np.all((H > 0) & np.isfinite(H)):
        raise ValueError(f"horizontal_tension is {H.min():g} N; allowed: finite values above 0")
    bed = Bed(slope, lines.friction)
    S = _free_length_at(H, lines, bed)
    x, _ = free_span(H, H * np.tan(slope), np.minimum(S, lines.length), lines.weight, lines.flexibility)
    x = x + np.cos(slope) * grounded.lying_span(
        H, np.maximum(lines.length - S, 0), lines.weight, lines.flexibility, bed
    )
    lifted = lines.length < S
    if np.any(lifted):
        some = lines.some(lifted)
        form = suspended.shape_at_tension(H[lifted], some.z, *some.properties)
        kappa = 0.5 * some.flexibility * some.weight * some.length
        x[lifted] = some.length * form.sine * form.t * (np.arcsinh(1 / form.t) + kappa)
    return x.reshape(shape), np.maximum(lines.length - S, 0.0).reshape(shape)


def profile(x, z, length, weight, axial_stiffness=np.inf, bed_friction=0.0, bed_slope=0.0, *, bed=True, points=101):
    """Points along one line for drawing: (points, 2) m, x and z from the anchor at (0, 0) to the fairlead."""
    line = solve_lines(x, z, length, weight, axial_stiffness, bed_friction, bed_slope, bed=bed)
    if line.horizontal_fairlead.shape:
        raise ValueError(f"profile draws one line, not an array of shape {line.horizontal_fairlead.shape}")
    H, lying = float(line.horizontal_fairlead), float(line.grounded_length)
    flexibility = 1.0 / axial_stiffness
    low = float(line.vertical_fairlead) - weight * (length - lying)
    s = np.linspace(0.0, length, points)
    on_bed = np.minimum(s, lying)
    if line.status == State.SLACK:
        reach = x / np.cos(bed_slope)
        distance = on_bed * (reach / lying if lying > 0 else 0.0)
    else:
        ground = Bed(np.full_like(s, bed_slope), np.full_like(s, bed_friction))
        whole = grounded.lying_span(H, np.full_like(s, lying), weight, flexibility, ground)
        # tension is used up from the lift-off point downwards, so measure from there
        distance = whole - grounded.lying_span(H, lying - on_bed, weight, flexibility, ground)
    dx, dz = free_span(H, low, np.maximum(s - lying, 0.0), weight, flexibility)
    return np.stack([distance * np.cos(bed_slope) + dx, distance * np.sin(bed_slope) + dz], axis=-1)


def _lines(x, z, length, weight, axial_stiffness, friction, slope, bed):
    """Checked, broadcast, flattened input."""
    given = np.broadcast_arrays(
        *(np.asarray(v, float) for v in (x, z, length, weight, axial_stiffness, friction, slope))
    )
    names = ("x", "z", "length", "weight", "axial_stiffness", "bed_friction", "bed_slope")
    x, z, length, weight, axial_stiffness, friction, slope = given
    with np.errstate(invalid="ignore"):
        rules = (
            ("x", np.isfinite(x) & (x >= 0), "finite, at least 0 m"),
            ("z", np.isfinite(z), "finite"),
            ("length", np.isfinite(length) & (length > 0), "finite, above 0 m"),
            ("weight", np.isfinite(weight) & (weight > 0), "finite, above 0 N/m"),
            ("axial_stiffness", axial_stiffness > 0, "above 0 N, inf for an inextensible line"),
            ("bed_friction", np.isfinite(friction) & (friction >= 0), "finite, at least 0"),
            ("bed_slope", np.abs(slope) < 1.5, "between −1.5 and 1.5 rad"),
        )
        if bed:
            above = z - x * np.tan(np.where(np.abs(slope) < 1.5, slope, 0.0))
            rules += (("z", above >= 0, "at or above the bed (use bed=False where there is none)"),)
    for name, good, allowed in rules:
        if not np.all(good):
            value = given[names.index(name)][~good].flat[0]
            raise ValueError(f"line {name} is {value:g}; allowed: {allowed}")
    flat = [v.ravel() for v in (x, z, length, weight, 1.0 / axial_stiffness, friction, slope)]
    return _Lines(*flat), x.shape


def _free_length_at(H, lines, bed):
    """Free length for a given H where only the height of the fairlead is fixed: a root in S on a slope."""
    S = grounded.free_length_on_flat_bed(H, lines.z, lines.weight, lines.flexibility)
    if not np.any(bed.slope):
        return S
    tan, sin = np.tan(bed.slope), np.sin(bed.slope)

    def height(S):
        _, rise = free_span(H, H * tan, S, lines.weight, lines.flexibility)
        lying = grounded.lying_span(H, np.maximum(lines.length - S, 0.0), lines.weight, lines.flexibility, bed)
        return lying * sin + rise - lines.z

    if np.any(height(np.zeros_like(S)) > 0):
        raise LineError("the fairlead lies below the upper end of the bed under the line")
    low, high = np.zeros_like(S), lines.length * 1.0
    whole = height(high) < 0
    for _ in range(200):
        middle = 0.5 * (low + high)
        rising = height(middle) < 0
        low, high = np.where(rising, middle, low), np.where(rising, high, middle)
        if np.all(high - low <= 4 * np.finfo(float).eps * lines.length):
            break
    return np.where(bed.slope == 0, S, np.where(whole, np.inf, high))


def _check(lines, H, V, lying, status):
    """Recompute the fairlead from the forces; raise where it is not where it was asked for."""
    free = lines.length - lying
    x, z = free_span(H, V - lines.weight * free, free, lines.weight, lines.flexibility)
    along = grounded.lying_span(H, lying, lines.weight, lines.flexibility, lines.bed)
    x, z = x + along * np.cos(lines.slope), z + along * np.sin(lines.slope)
    wrong = np.hypot(x - lines.x, z - lines.z)
    # the part on the bed of a slack line lies in a heap, only its height counts
    heap = np.abs(z - along * np.sin(lines.slope) - _clearance(lines))
    wrong = np.where(status == State.SLACK, heap, wrong)
    bad = ~(wrong <= TOLERANCE * np.maximum(lines.length, np.hypot(lines.x, lines.z)))
    if np.any(bad):
        raise _failure(lines.some(bad), f"was missed by {wrong[bad][0]:.3g} m")


def _clearance(lines):
    return lines.z - lines.x * np.tan(lines.slope)


def _failure(lines, what):
    return LineError(
        f"{lines.x.size} line(s): fairlead at x = {lines.x[0]:.6g} m, z = {lines.z[0]:.6g} m {what}: "
        f"length {lines.length[0]:.6g} m, weight {lines.weight[0]:.6g} N/m, "
        f"EA {1 / lines.flexibility[0] if lines.flexibility[0] > 0 else np.inf:.6g} N"
    )
