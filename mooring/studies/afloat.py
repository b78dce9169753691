"""The hulls of a study: that of a database of one body, or each of several in coordinates of its own."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..lines.system.bodies import rotation
from .conditions import ExposedBox


class Afloat(NamedTuple):
    """A hull that moves.

    name : of its body in the System; box : ExposedBox about the origin of its coordinates
    rotation_center : (3,) m in these; place : (2,) m, their origin in space; heading : rad, of their x axis
    density : kg/m³ of the water
    """

    name: str
    box: ExposedBox
    rotation_center: np.ndarray
    place: np.ndarray
    heading: float
    density: float

    @property
    def axes(self):
        """(3, 3) whose columns are its axes in space"""
        return rotation(0.0, 0.0, self.heading)

    @property
    def position(self):
        """(6,) m and rad, of its `MooredBody` at rest"""
        return np.array([*(self.axes @ self.rotation_center + (*self.place, 0.0)), 0.0, 0.0, self.heading])

    def own(self, point):
        """(3,) m in its coordinates of a point in space"""
        return (np.asarray(point, float) - (*self.place, 0.0)) @ self.axes


def afloat(db, hull, name="body"):
    """(`Afloat`, …) of the bodies of a database that move, in its order.

    hull : ExposedBox of one body, called `name`; of several {name: ExposedBox}
    """
    if not db.bodies:
        return (alone(db, hull, name),)
    return tuple(
        Afloat(body.name, hull[body.name], body.own_center, np.asarray(body.place), body.heading, db.density)
        for body in db.bodies
        if not body.fixed
    )


def alone(body, hull, name="body"):
    """`Afloat` of one body, which has rotation_center and density"""
    return Afloat(name, hull, np.asarray(body.rotation_center, float), np.zeros(2), 0.0, body.density)


def in_motions(stiffness, hulls):
    """(n, n) about the axes that motions are along, of one (n, n) about those of space, of hulls one after another"""
    if len(hulls) == 1 and not hulls[0].heading:
        return stiffness
    turn = np.zeros_like(stiffness)
    for i, one in enumerate(hulls):
        own = slice(6 * i, 6 * i + 6)
        turn[own, own] = np.kron(np.eye(2), one.axes)
    return turn.T @ stiffness @ turn
