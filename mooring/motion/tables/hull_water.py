"""Forces of water and mean drift on a hull that slews in a current, from its velocity through the water, compiled.

    F = C Σₖ cₖ(β) V^(2−k) (rL)ᵏ − D ν′ + drift(ψ) + carried,    k = 0 … 4,  |rL| ≤ V/2      (`single_point.loads`)

C : fraction of the coefficients that applies for a round hull (`loads.on_hull`), otherwise 1
β, V : angle and speed of the water at the hull; ν′ = (u, v, r) through the water.  `carried` is the current's
    addition to the inertia terms of the equation of motion, whose velocities are over the ground. Seen from axes
    that turn, a current with components U, W changes at the rate r (W, −U). With the inertia T of the body and the
    added mass a of slow motion,

    turning tests           r (T₁₁ W, −T₂₂ U, −T₆₂ U)     they hold the inertia of the turn, and C(ν) is left out
    current coefficients    r ((a₁₁ − a₂₂) W, (a₁₁ − a₂₂) U, −a₆₂ U)

so that a body drifting with the current moves as in water at rest.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from ...loads.on_hull import STEADY
from .interpolation import on_ring, ring_table


@in_memory
class HullWater(NamedTuple):
    """water : (n + 3, 15), N …, rows of a `ring_table`: five powers of three forces; length : m

    largest : rL/V; velocity : (2,) m/s of the current; linear : (3, 3) D; carried : (3,) kg, kg, kg m
    drift : (m + 3, 3), N, N, N m, over headings; lever : height of the centre of motion over the water's centre of
        pressure, m
    at_rest : fraction of the coefficients that applies in water at rest
    """

    water: np.ndarray
    length: float
    largest: float
    velocity: np.ndarray
    linear: np.ndarray
    carried: np.ndarray
    drift: np.ndarray
    lever: float
    at_rest: float


class OnHull(NamedTuple):
    """Coefficients of a hull for all directions, about the centre of its motion, in place of the coefficients of a
    box.

    wind : (n, 6), N s²/m² and N s², force at unit speed over the direction towards which the wind blows, None
        without wind
    water : HullWater; turning : whether HullWater comes from turning tests, which include the inertia of the turn
    quadratic : N₂ of yaw, N m s²
    """

    wind: np.ndarray | None
    water: HullWater
    turning: bool
    quadratic: float


def hull_water(table, length, largest, velocity, linear, mass, turning, drift=None, lever=0.0, at_rest=1.0):
    """HullWater of a table (n, 5, 3), N …, over the direction of flow.

    mass : (3, 3) kg …, with turning tests T of slow surge, sway and yaw, otherwise the added mass; linear : (3, 3)
        or None
    drift : (m, 3), N, N, N m, over the heading, None without drift; at_rest : as in HullWater
    """
    carried = np.array([mass[0, 0], -mass[1, 1], -mass[2, 1]])
    if not turning:
        carried[:2] = mass[0, 0] - mass[1, 1]
    return HullWater(
        ring_table(np.reshape(table, (len(table), 15))), float(length), float(largest), np.asarray(velocity, float),
        np.zeros((3, 3)) if linear is None else np.asarray(linear, float), carried,
        np.zeros((4, 3)) if drift is None else ring_table(drift), float(lever),
        float(at_rest),
    )  # fmt: skip


@kernel(counted=False)
def drag_share(still, flow, own):
    """Fraction of C_D that applies in a stream of `flow` m/s for a hull that moves at `own` m/s, as in
    `loads.on_hull.drag_share`.

    In water at rest it is `still`.
    """
    if flow >= STEADY * own:
        return 1.0
    ratio = flow / (STEADY * own)
    return still + (1.0 - still) * ratio * ratio * (3.0 - 2.0 * ratio)


@kernel(counted=False)
def hull_water_force(hull, share, moving, weights, room, out, drift):
    """Fill out (3,), force of the water in the body's axes, N, N, N m, and drift (3,), force of the waves.

    Loads are multiplied by `share`.

    moving : (4,), heading of the body, its velocities along and across this heading, and yaw rate, over the ground
    weights, room : work arrays (6,) and (15,)
    """
    heading, r = moving[0], moving[3]
    cos, sin = np.cos(heading), np.sin(heading)
    x, y = share * hull.velocity[0], share * hull.velocity[1]
    U, W = cos * x + sin * y, -sin * x + cos * y
    u, v = moving[1] - U, moving[2] - W
    out[0], out[1], out[2] = hull.carried[0] * r * W, hull.carried[1] * r * U, hull.carried[2] * r * U
    V = np.sqrt(u * u + v * v)
    if V > 0.0:
        on_ring(hull.water, np.arctan2(-v, -u), weights, room)
        square = V * V * drag_share(hull.at_rest, np.hypot(x, y), np.hypot(moving[1], moving[2]))
        s = min(max(r * hull.length, -hull.largest * V), hull.largest * V) / V
        for j in range(3):
            out[j] += square * (room[j] + s * (room[3 + j] + s * (room[6 + j] + s * (room[9 + j] + s * room[12 + j]))))
    for j in range(3):
        out[j] -= hull.linear[j, 0] * u + hull.linear[j, 1] * v + hull.linear[j, 2] * r
    on_ring(hull.drift, heading, weights, drift)
    for j in range(3):
        drift[j] *= share * share
