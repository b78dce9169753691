"""Bodies that bend, before a run: whether their shapes can be followed in time, and how lines and fenders bend them."""

from dataclasses import replace

import numpy as np

from ...lines.system.bodies import places_along
from ...lines.system.parts import Fairlead
from ..contacts import RESTS, STEP, balanced, berth_force
from ..tables.groups import moved_by_shapes

FASTEST = 300.0  # rad/s of a shape: explicit steps are 3 over that, 10 ms
SMALL = 1e-9  # of the weight, forces that are rounding
STATIC = (
    "left out: inertia and drag of the lines of bodies that bend, which have their static shape; move the fairlead as "
    "in the run by hakobune line-dynamics"
)


def check_bending(body, free):
    """Raise ValueError for a Reader whose shapes cannot be followed; free : numbers of the motions that are not held"""
    held = [body.words[i] for i in range(body.rigid, len(body.words)) if i not in free]
    if held and body.links:
        raise ValueError(
            f"simulation.motions holds {', '.join(held)}, and hinges {', '.join(one.name for one in body.links)} are "
            "given; allowed with hinges: all shapes free; solve fewer shapes (count)"
        )
    added = body.held_added_mass(np.inf)[0]
    for i in range(body.rigid, len(body.words)):
        omega = np.sqrt(max(body.stiffness[i, i], 0.0) / (body.inertia[i, i] + added[i, i]))
        if i in free and omega > FASTEST:
            raise ValueError(
                f"{body.words[i]} has a natural frequency of {omega:.3g} rad/s, limit {FASTEST:g}: steps of a run "
                "would be far below those of waves; solve fewer shapes (count), or hold it by simulation.motions"
            )


def rest_bent(body, berth, others, start, unit, free):
    """Places in space and amplitudes of shapes at rest, shape (n,), and stiffness there along the axes of the bodies,
    shape (n, n)

    berth : `contacts.Berth`; others : function of the place, (n,) N of lines, water and springs; unit : (n,) m, rad
    free : numbers of the motions that are not held; bodies come to rest in all of theirs
    raises : ValueError where there is no balance
    """
    moves = np.array([*range(body.rigid), *(i for i in free if i >= body.rigid)])

    def forces(place):
        return others(place) + (berth_force(berth, place) if berth.names else 0.0)

    def at(x):
        place = np.array(start)
        place[moves] = x * unit[moves]
        return place

    size = max(np.abs(forces(start) * unit).max(), SMALL * body.inertia[0, 0] * body.gravity)
    found = balanced(lambda x: (forces(at(x)) * unit)[moves] / size, (start / unit)[moves])
    if not np.abs(found.fun).max() <= RESTS:
        raise ValueError(
            f"no equilibrium of the body that bends was found: {np.abs(found.fun).max():.2g} of the largest force "
            "remains; check for lines that are too tight for its stiffness"
        )
    place = at(found.x)
    along = np.eye(len(place))
    along[: body.rigid, : body.rigid] = places_along(body.axes_at_rest[:, 5])
    steps = np.append(np.tile(STEP, body.rigid // 6), np.full(len(body.modes), STEP[0]))
    pairs = ((place - h * way, place + h * way) for h, way in zip(steps, along.T, strict=True))
    columns = [(forces(behind) - forces(ahead)) for behind, ahead in pairs]
    return place, np.array(columns).T / (2 * steps)


def with_bent_fairleads(system, reader, amplitudes):
    """A System with its fairleads moved by the shapes of a Reader with amplitudes (f,)"""
    if not reader.modes:
        return system
    names = [one.name for one in system.bodies]

    def moved(point):
        if not isinstance(point, Fairlead):
            return point
        (shapes,) = moved_by_shapes(reader, names.index(point.body), point.position)
        return replace(point, position=tuple(map(float, point.position + amplitudes @ shapes)))

    return replace(system, points=tuple(map(moved, system.points)))
