"""What a point of the body feels: displacement, velocity, acceleration, and the water below it.

    d = X₁₋₃ + X₄₋₆ × (p − p₀),    v = −iωd,    a = −ω²d,    r = ζ exp(ik(x cosβ + y sinβ)) − d_z

All per unit wave amplitude, in axes that do not turn with the body; a has no part of gravity.  r is the height of the
undisturbed incident wave above its mark on the body; the waves that the body scatters and makes are not in it, at a
wall that reflects short waves they double ζ.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem import DOFS
from bem.waves import wavenumber


class Point(NamedTuple):
    """name; position (3,) m at rest; clearance m, height of what must stay dry above still water, or None"""

    name: str
    position: tuple[float, float, float]
    clearance: float | None = None


class Transfer(NamedTuple):
    """Transfer functions per m of wave amplitude.

    names, units : (c,); omega : (q,) rad/s; heading : (p,) rad; value : (q, p, c) complex
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    omega: np.ndarray
    heading: np.ndarray
    value: np.ndarray


def transfer_functions(body, omega, heading, points=()) -> Transfer:
    """All responses of a body: its six motions, and for every Point displacement, velocity, acceleration along x, y, z
    and the relative elevation of the water.

    omega : (q,) rad/s; heading : (p,) rad.  Raises BetweenError outside the database.
    """
    heading = np.atleast_1d(heading)
    motion = body.motions(omega, heading)
    names, units, values = [name.lower() for name in DOFS], ["m"] * 3 + ["rad"] * 3, [motion]
    for point in points:
        d = displacement(motion, point.position, body.rotation_center)
        for word, unit, part in (
            ("displacement", "m", d),
            ("velocity", "m/s", velocity(omega, d)),
            ("acceleration", "m/s²", acceleration(omega, d)),
        ):
            names += [f"{point.name} {word} {axis}" for axis in "xyz"]
            units += [unit] * 3
            values.append(part)
        names.append(relative_name(point))
        units.append("m")
        values.append(relative_elevation(omega, heading, d, point.position, body.depth, body.gravity)[..., None])
    return Transfer(tuple(names), tuple(units), np.asarray(omega, float), heading, np.concatenate(values, axis=-1))


def relative_name(point):
    """Name of the relative elevation of the water at a Point"""
    return f"{point.name} relative elevation"


def displacement(motion, position, rotation_center):
    """(q, p, 3) of the point at `position` (3,) m from motions (q, p, 6) about `rotation_center`."""
    arm = np.asarray(position, float) - np.asarray(rotation_center, float)
    return motion[..., :3] + np.cross(motion[..., 3:], arm)


def velocity(omega, displaced):
    """(q, p, …) m/s per m"""
    return -1j * _column(omega, displaced) * displaced


def acceleration(omega, displaced):
    """(q, p, …) m/s² per m"""
    return -(_column(omega, displaced) ** 2) * displaced


def incident_elevation(omega, heading, position, depth, gravity):
    """(q, p) undisturbed wave at x, y of `position` per unit amplitude at the origin"""
    k = wavenumber(np.asarray(omega, float), depth, gravity)
    along = position[0] * np.cos(heading) + position[1] * np.sin(heading)
    return np.exp(1j * np.outer(k, along))


def relative_elevation(omega, heading, displaced, position, depth, gravity):
    """(q, p) rise of the incident wave above its still-water mark on the body at `position`"""
    return incident_elevation(omega, heading, position, depth, gravity) - displaced[..., 2]


def _column(omega, values):
    return np.reshape(omega, (-1,) + (1,) * (np.ndim(values) - 1))
