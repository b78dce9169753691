"""Forces of all lines on a displaced body, their stiffness, and the position where they balance steady forces.

A body is displaced by X, Y and a turn φ about the vertical through its rotation centre.  A line whose fairlead
is at arm a from that centre, with force f and stiffness k = −∂f/∂r, adds to the 6×6 stiffness (force and moment
about the moving centre, small rotations about space axes)

    K = [ k        −k S(a)                ]      S(a) v = a × v
        [ S(a) k   −S(a) k S(a) − S(f) S(a) ]

Rows and columns surge, sway and yaw of K are the coefficients a11 … a33 of the SR179 report (1982), eq. 3.5.1.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .layout import Layout
from .lines.catenary.solve import LineSolution

PLANE = [0, 1, 5]


class EquilibriumError(ValueError):
    """No position was found in which the lines balance the steady forces."""


@dataclass(frozen=True)
class Equilibrium:
    """A moored body at rest under steady forces.

    position : (3,) m, m, rad; force : (3,) N, N, N m, the steady forces it balances
    residual : (3,) the same units, what is left unbalanced; iterations : steps taken
    points : (n, 3) m, fairleads in space; outward : (n, 2) unit vectors anchor → fairlead
    lines : LineSolution; stiffness : (6, 6) about the rotation centre
    """

    position: np.ndarray
    force: np.ndarray
    residual: np.ndarray
    iterations: int
    points: np.ndarray
    outward: np.ndarray
    lines: LineSolution
    stiffness: np.ndarray

    def __repr__(self):
        x, y, turn = self.position
        return f"<Equilibrium x {x:.4g} m, y {y:.4g} m, yaw {turn:.4g} rad, {self.iterations} steps>"


class MooringLoad(NamedTuple):
    """What all lines do to a body.

    force : (6,) N and N m; stiffness : (6, 6); lines : LineSolution
    outward : (n, 2) unit vectors anchor → fairlead; points : (n, 3) m, fairleads in space
    """

    force: np.ndarray
    stiffness: np.ndarray
    lines: LineSolution
    outward: np.ndarray
    points: np.ndarray


def displaced(points, position, center):
    """Body points moved by (X, Y, φ) about `center`: (n, 3) m in space."""
    x, y, turn = position
    c, s = np.cos(turn), np.sin(turn)
    arm = np.asarray(points, float) - center
    return center + arm @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + np.array([x, y, 0.0])


def line_forces(lines, outward):
    """(n, 3) N on the body: H towards the anchor, V down."""
    return np.column_stack([-lines.horizontal_fairlead[:, None] * outward, -lines.vertical_fairlead])


def line_stiffness(lines, outward, span):
    """(n, 3, 3) N/m, −∂(force on the body)/∂(fairlead position) in space axes.

    Across its plane a line has H/span; above its anchor that is the slope ∂H/∂x.
    """
    k = lines.stiffness
    across = np.where(span > 0, lines.horizontal_fairlead / np.where(span > 0, span, 1.0), k[:, 0, 0])
    radial = np.column_stack([outward, np.zeros(len(span))])
    lateral = np.column_stack([-outward[:, 1], outward[:, 0], np.zeros(len(span))])
    up = np.broadcast_to([0.0, 0.0, 1.0], radial.shape)
    axes = np.stack([radial, lateral, up], axis=1)
    local = np.zeros((len(span), 3, 3))
    local[:, 0, 0], local[:, 0, 2] = k[:, 0, 0], k[:, 0, 1]
    local[:, 2, 0], local[:, 2, 2] = k[:, 1, 0], k[:, 1, 1]
    local[:, 1, 1] = across
    return np.einsum("nai,nab,nbj->nij", axes, local, axes)


def _cross_matrix(a):
    x, y, z = np.moveaxis(np.asarray(a, float), -1, 0)
    o = np.zeros_like(x)
    return np.stack([o, -z, y, z, o, -x, -y, x, o], axis=-1).reshape(*x.shape, 3, 3)


def mooring_load(layout: Layout, position, center, beyond_reach="mark") -> MooringLoad:
    """Force and stiffness of all lines on the body at (X, Y, φ).

    returns : MooringLoad, its force and stiffness about the moved centre; nan where an inextensible line cannot reach.
    """
    points = displaced(layout.fairleads, position, center)
    lines, outward = layout.solve(points, beyond_reach)
    force = line_forces(lines, outward)
    moved = np.asarray(center, float) + np.array([position[0], position[1], 0.0])
    arm = points - moved
    if not np.all(np.isfinite(force)):
        return MooringLoad(np.full(6, np.nan), np.full((6, 6), np.nan), lines, outward, points)
    k = line_stiffness(lines, outward, np.hypot(*(points - layout.anchors)[:, :2].T))
    A, F = _cross_matrix(arm), _cross_matrix(force)
    K = np.zeros((6, 6))
    K[:3, :3] = k.sum(axis=0)
    K[:3, 3:] = -(k @ A).sum(axis=0)
    K[3:, :3] = (A @ k).sum(axis=0)
    K[3:, 3:] = -(A @ k @ A + F @ A).sum(axis=0)
    load = np.concatenate([force.sum(axis=0), np.cross(arm, force).sum(axis=0)])
    return MooringLoad(load, K, lines, outward, points)


def mooring_stiffness(layout: Layout, position=(0.0, 0.0, 0.0), center=(0.0, 0.0, 0.0)):
    """(6, 6) −∂(force, moment)/∂(displacement, rotation) of all lines about `center`, N/m … N m/rad."""
    return mooring_load(layout, position, center, "raise").stiffness


def find_equilibrium(layout: Layout, force, center=(0.0, 0.0, 0.0), start=(0.0, 0.0, 0.0), steps=500):
    """Position in which the lines balance a steady force (F_x, F_y, M_z), N, N and N m about `center`.

    Newton's method, damped so that no step overshoots: lines stiffen, so a step is halved while the force
    left behind it points back.  Where the lines are slack and give no direction, the damping turns
    the step into a drift along the force.  returns : Equilibrium
    raises : EquilibriumError with the residual where none is found
    """
    force = np.asarray(force, float)
    center = np.asarray(center, float)
    if force.shape != (3,) or not np.all(np.isfinite(force)):
        raise ValueError(f"force is {force}; allowed: three finite numbers")
    radius = max(np.hypot(*(layout.fairleads - center)[:, :2].T).max(), 1.0)
    unit = np.array([1.0, 1.0, radius])  # moments are compared as forces at the outermost fairlead
    position = np.asarray(start, float)
    longest = 0.02 * layout.length.min()

    state = mooring_load(layout, position, center)
    if not np.all(np.isfinite(state.force)):
        raise EquilibriumError(f"a line cannot reach the body at its start position {position}")
    count = 0
    while _unbalanced(state, force, unit) > 1e-11 and count < steps:
        residual = (force + state.force[PLANE]) / unit
        step = _damped_step(state.stiffness[np.ix_(PLANE, PLANE)] / np.outer(unit, unit), residual, longest)
        position, state = _advance(layout, position, center, force, unit, residual, step)
        count += 1
    residual = force + state.force[PLANE]
    if not _unbalanced(state, force, unit) <= 1e-9:
        raise EquilibriumError(
            f"no equilibrium within {steps} steps: at x = {position[0]:.5g} m, y = {position[1]:.5g} m, "
            f"yaw = {position[2]:.4g} rad the force left is {residual[0]:.4g} N, {residual[1]:.4g} N, "
            f"{residual[2]:.4g} N m of {force[0]:.4g} N, {force[1]:.4g} N, {force[2]:.4g} N m"
        )
    return Equilibrium(position, force, residual, count, state.points, state.outward, state.lines, state.stiffness)


def _unbalanced(state, force, unit):
    """Largest force left, as a share of all forces at work."""
    left = np.abs((force + state.force[PLANE]) / unit).max()
    scale = np.abs(force / unit).sum() + state.lines.horizontal_fairlead.sum()
    return left / scale if scale > 0 else 0.0


def _damped_step(K, residual, longest):
    """(3,) step of at most `longest` m: Newton's where the stiffness is positive, else along the softest way."""
    values, vectors = np.linalg.eigh(0.5 * (K + K.T))
    floor = np.linalg.norm(residual) / longest
    if values[0] > 0:
        newton = np.linalg.solve(K, residual)
        if np.linalg.norm(newton) <= longest:
            return newton
    along = vectors.T @ residual
    step = vectors @ (along / np.maximum(values, 1e-9 * floor))
    size = np.linalg.norm(step)
    return step * min(1.0, longest / size) if size > 0 else step


def _advance(layout, position, center, force, unit, residual, step):
    """The next position and the lines there: the whole step, or the part of it that does not overshoot."""
    for _ in range(60):
        following = position + step / unit
        state = mooring_load(layout, following, center)
        # false for nan: out of reach
        if step @ ((force + state.force[PLANE]) / unit) >= -0.5 * abs(step @ residual):
            break
        step = 0.5 * step
    return following, state
