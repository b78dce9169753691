"""Shapes of flexible bodies, in groups of six as the kernels read them, and displacements of points by these shapes.

Each group belongs to one body, has its shapes and forces along the axes of this body, and is filled up with empty
motions. A shape of several bodies belongs to the first of them.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...lines.system.parts import Fairlead


class Groups(NamedTuple):
    """owner : (G,), number of each group's body among the moving bodies; place : (f,), place of each shape among the
    6G
    """

    owner: np.ndarray
    place: np.ndarray

    @property
    def count(self):
        """Number of groups G"""
        return len(self.owner)

    def padded(self, values, axes=1):
        """Values of motions (bodies before shapes) along the first `axes` axes, spread over 6N + 6G places; unused
        places are 0
        """
        rigid = len(values) - len(self.place)
        at = np.append(np.arange(rigid), rigid + self.place)
        for axis in range(axes):
            out = np.zeros((*values.shape[:axis], rigid + 6 * self.count, *values.shape[axis + 1 :]))
            out[(slice(None),) * axis + (at,)] = values
            values = out
        return values


def groups_of(reader):
    """`Groups` of a `bem.database.reader.Reader`"""
    modes = getattr(reader, "modes", ())
    if not modes:
        return Groups(np.zeros(0, np.int64), np.zeros(0, np.int64))
    owners = [_moving(reader).index(mode.moves[0]) for mode in modes]
    owner, place = [], np.zeros(len(modes), np.int64)
    for body in sorted(set(owners)):
        for i, k in enumerate(k for k, one in enumerate(owners) if one == body):
            if i % 6 == 0:
                owner.append(body)
            place[k] = 6 * (len(owner) - 1) + i % 6
    return Groups(np.array(owner, np.int64), place)


def moved_by_shapes(reader, body, points):
    """Displacement, m, per unit of each shape of a Reader at points (n, 3) m of one moving body; shape (n, f, 3)

    body : number among the moving bodies; points and displacements are along its axes, from its rotation centre
    """
    points = np.asarray(points, float).reshape(-1, 3)
    out, number = np.zeros((len(points), len(reader.modes), 3)), _moving(reader)[body]
    one = reader.bodies[number] if reader.bodies else None
    places = points + (reader.rotation_center if one is None else one.own_center)
    for k, mode in enumerate(reader.modes):
        if number in mode.moves and len(points):
            out[:, k] = mode.in_body(one, places)
    return out


def with_bent_fairleads(system, reader, amplitudes):
    """A System whose fairleads are displaced by the shapes of a Reader with amplitudes (f,)"""
    if not reader.modes:
        return system
    names = [one.name for one in system.bodies]

    def moved(point):
        if not isinstance(point, Fairlead):
            return point
        (shapes,) = moved_by_shapes(reader, names.index(point.body), point.position)
        return replace(point, position=tuple(map(float, point.position + amplitudes @ shapes)))

    return replace(system, points=tuple(map(moved, system.points)))


def _moving(reader):
    """Numbers of the bodies that move, among all"""
    return [i for i, one in enumerate(reader.bodies) if not one.fixed] or [0]
