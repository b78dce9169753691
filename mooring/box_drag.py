"""Steady force of a stream, air or water, on a box, from coefficients for the first quadrant of directions.

    F_x = ± C_x q A_x,   F_y = ± C_y q A_y,   M_z = − sign(F_x F_y) (a/L) L √(F_x² + F_y²),   q = ½ ρ U²

A box looks the same from bow and stern and from both sides, so the angle between stream and x axis is reduced
to 0 … 90° and forces point downstream.  The force acts on the upstream half, which turns the box broadside.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class DragTable(NamedTuple):
    """Coefficients against the angle between stream and x axis, rad from 0 to π/2, each (n,)."""

    angle: np.ndarray
    x: np.ndarray
    y: np.ndarray
    lever: np.ndarray


def drag_table(angle, x, y, lever=None):
    """A checked DragTable; without `lever` the force acts amidships."""
    lever = np.zeros(np.shape(angle)) if lever is None else lever
    table = DragTable(*(np.asarray(v, float) for v in (angle, x, y, lever)))
    sizes = [v.shape for v in table]
    if len(set(sizes)) != 1 or len(sizes[0]) != 1 or sizes[0][0] < 2:
        raise ValueError(f"drag coefficients have shapes {sizes}; allowed: one list of at least two values each")
    if not (np.all(np.diff(table.angle) > 0) and abs(table.angle[0]) < 1e-9):
        raise ValueError("drag coefficient angles have to rise from 0 to π/2")
    if abs(table.angle[-1] - np.pi / 2) > 1e-9:
        raise ValueError(f"drag coefficient angles end at {np.rad2deg(table.angle[-1]):g}°; allowed: 90°")
    return table


def box_drag(direction, pressure, area_x, area_y, length, table):
    """(3,) F_x, F_y in N and M_z in N m about the middle of the box, for a stream towards `direction`.

    direction : rad, relative to the x axis of the box; pressure : ½ρU² in Pa
    area_x, area_y : m², of the ends and of the sides; length : m
    """
    along, across = np.cos(direction), np.sin(direction)
    acute = np.arctan2(abs(across), abs(along))
    x, y, lever = (np.interp(acute, table.angle, column) for column in table[1:])
    F_x = np.sign(along) * x * pressure * area_x
    F_y = np.sign(across) * y * pressure * area_y
    M_z = -np.sign(along) * np.sign(across) * lever * length * np.hypot(F_x, F_y)
    return np.array([F_x, F_y, M_z])


def about(load, middle, center):
    """The same F_x, F_y, M_z with the moment about `center` instead of `middle`, both (x, y, …) m."""
    arm = np.asarray(middle, float)[:2] - np.asarray(center, float)[:2]
    return load + np.array([0.0, 0.0, arm[0] * load[1] - arm[1] * load[0]])


def check_positive(**sizes):
    """Raises ValueError naming the first of the given sizes that is not a finite number above 0."""
    for name, value in sizes.items():
        if not 0 < value < np.inf:
            raise ValueError(f"{name} is {value:g}; allowed: above 0")
