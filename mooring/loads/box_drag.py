"""Steady force of a stream of air or water on a box, from coefficients for the first quadrant of directions.

    F_x = ± C_x q A_x,   F_y = ± C_y q A_y,   M_z = − sign(F_x F_y) (a/L) L √(F_x² + F_y²),   q = ½ ρ U²

A box is symmetric fore and aft and port to starboard, so the angle between stream and x axis is reduced to 0 … 90° and
forces point downstream.  The force acts on the upstream half and turns the box broadside. Between the angles of a
table coefficients are monotone cubics with slopes that have the same symmetry, so that forces have a continuous slope
at all angles.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .smooth import smooth


@dataclass(frozen=True, eq=False)
class DragTable:
    """Coefficients against the angle between stream and x axis, rad from 0 to π/2, each (n,).

    notes : remarks on the origin of the coefficients, one line each
    """

    angle: np.ndarray
    x: np.ndarray
    y: np.ndarray
    lever: np.ndarray
    notes: tuple[str, ...] = ()

    @cached_property
    def curve(self):
        """Callable: (…) rad from 0 to π/2 → (…, 3) C_x, C_y, a/L"""
        first = np.column_stack([self.x, self.y, self.lever])
        before = (first * (1, -1, -1))[:0:-1]  # the angle −χ: C_x as at χ, C_y and the lever of opposite sign
        after = (first * (-1, 1, -1))[-2::-1]  # the angle π − χ
        angles = [-self.angle[:0:-1], self.angle, np.pi - self.angle[-2::-1]]
        return smooth(np.concatenate(angles), np.concatenate([before, first, after]))


def drag_table(angle, x, y, lever=None):
    """A checked DragTable; without `lever` the force acts amidships.  Raises ValueError."""
    lever = np.zeros(np.shape(angle)) if lever is None else lever
    columns = [np.asarray(v, float) for v in (angle, x, y, lever)]
    sizes = [v.shape for v in columns]
    if len(set(sizes)) != 1 or len(sizes[0]) != 1 or sizes[0][0] < 2:
        raise ValueError(
            f"drag coefficients have shapes {sizes}; allowed: lists of the same length, at least two values"
        )
    if not np.all(np.isfinite(columns)):
        raise ValueError("drag coefficients are not all finite numbers")
    table = DragTable(*columns)
    if not (np.all(np.diff(table.angle) > 0) and abs(table.angle[0]) < 1e-9):
        raise ValueError("drag coefficient angles have to rise from 0 to π/2")
    if abs(table.angle[-1] - np.pi / 2) > 1e-9:
        raise ValueError(f"drag coefficient angles end at {np.rad2deg(table.angle[-1]):g}°; allowed: 90°")
    for name, value, where in (
        ("x", table.x[-1], "90°"),
        ("y", table.y[0], "0°"),
        ("lever", table.lever[0], "0°"),
        ("lever", table.lever[-1], "90°"),
    ):
        if value != 0:
            raise ValueError(f"drag coefficient {name} is {value:g} at {where}; allowed: 0, since a box is symmetric")
    return table


def box_drag(direction, pressure, area_x, area_y, length, table):
    """Forces F_x, F_y, N, and moment M_z, N m, about the middle of the box, for a stream towards `direction`; shape (…,
    3).

    direction : (…) rad, relative to the x axis of the box; pressure : (…) ½ρU² in Pa
    area_x, area_y : areas of an end and of a side, m²; length : m
    """
    along, across = np.cos(direction), np.sin(direction)
    x, y, lever = np.moveaxis(table.curve(np.arctan2(abs(across), abs(along))), -1, 0)
    F_x = np.sign(along) * x * pressure * area_x
    F_y = np.sign(across) * y * pressure * area_y
    M_z = -np.sign(along) * np.sign(across) * lever * length * np.hypot(F_x, F_y)
    return np.stack(np.broadcast_arrays(F_x, F_y, M_z), axis=-1)


def about(load, middle, center):
    """Forces F_x, F_y, M_z (…, 3) with the moment about `center` in place of `middle`, both (x, y, …) m."""
    arm = np.asarray(middle, float)[:2] - np.asarray(center, float)[:2]
    moment = arm[0] * load[..., 1] - arm[1] * load[..., 0]
    return load + moment[..., None] * np.array([0.0, 0.0, 1.0])


def check_positive(**sizes):
    """Raises ValueError for the first of the given sizes that is not a finite number above 0."""
    for name, value in sizes.items():
        if not 0 < value < np.inf:
            raise ValueError(f"{name} is {value:g}; allowed: above 0")


def stream_pressure(stream, speed, density):
    """Pressure ½ρU², Pa, in the shape of `speed`, m/s. Raises ValueError for a negative speed; stream : its name in
    the message.
    """
    check_positive(density=density)
    speed = np.asarray(speed, float)
    wrong = ~((speed >= 0) & (speed < np.inf))
    if np.any(wrong):
        raise ValueError(f"{stream} speed is {speed[wrong].flat[0]:g} m/s; allowed: at least 0")
    return 0.5 * density * speed**2
