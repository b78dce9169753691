"""Moving lines of a body in the form that the kernels read: the arrays of all lines one after another.

Lines have different numbers of nodes; one kernel steps them all, so that all lines share one array of each kind and a
line is a slice of it (`line_system`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import kernel

from ...lines.dynamics.lumped.system import System, Water
from ...lines.dynamics.run import control_of
from ...lines.dynamics.start import start
from ...lines.dynamics.surroundings import water_arrays
from .sea import LineSea, line_sea, water_of

ROWS = 256  # largest number of line steps in one step of the body; more mean that the body's step is too long
OF_BED = ("bed_level", "bed_friction", "bed_slip", "bed_normal", "bed_course")


class MovingLines(NamedTuple):
    """m moving lines.

    number : (m,) of each among the lines of its system; system : `System` of them all, bed_normal (m, 3), level,
    friction, slip (m,) and course (m, 4) of the bed, a plane; elements, nodes, bodies, rows : (m + 1,) where the
    parts of each begin
    tension, distance : (m,) N, m, scales of their errors; tolerance : of a step
    water : `Water` at all nodes, with a table of `sea` that is refilled; room_of_sea : of its sums
    stretch : (m, 6) m/m and m/rad, of each chord from anchor to fairlead by motions of its body along its axes at rest
    spring : (m,) N/m, EA/L
    """

    number: np.ndarray
    system: System
    elements: np.ndarray
    nodes: np.ndarray
    bodies: np.ndarray
    rows: np.ndarray
    tension: np.ndarray
    distance: np.ndarray
    tolerance: float
    water: Water
    sea: LineSea
    room_of_sea: tuple
    stretch: np.ndarray
    spring: np.ndarray


class Room(NamedTuple):
    """For the place and velocity of a fairlead"""

    R: np.ndarray
    unit: np.ndarray
    arm: np.ndarray
    push: np.ndarray


class MovingWork(NamedTuple):
    """State of m moving lines with n nodes in all during a run; arrays are changed in place.

    position, velocity, acceleration, slip : (2, n, 3), [0] at the end of the last step of the body, [1] of a trial step
    step : (2, m) s, their next own steps; course : (m, 3, 2, 3) position and velocity of each fairlead at begin, middle
    and end of a step; time : (m, ROWS) s, pull, slope : (m, ROWS, 3) N, N/s at the ends of own steps, of which used
    (m,) are filled
    before : (m, 4) time and pull before the first of them; foreseen : (N, 12) poses and velocities with the predicted
        pull
    last : (lines, TERMS, 3) N, pull of every line of the system, moving or not, in the last step of the body,
    length : (1,) s of that step; pose : (N, 18), push : (6N,), room : `Room` work arrays
    tension : (samples, m) N; steps : (m,) own steps; stuck : (1,) a line that stopped, or −1
    """

    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    slip: np.ndarray
    step: np.ndarray
    course: np.ndarray
    time: np.ndarray
    pull: np.ndarray
    slope: np.ndarray
    used: np.ndarray
    before: np.ndarray
    foreseen: np.ndarray
    last: np.ndarray
    length: np.ndarray
    pose: np.ndarray
    push: np.ndarray
    room: Room
    tension: np.ndarray
    steps: np.ndarray
    stuck: np.ndarray


def moving_lines(lines, fairleads, tolerance, as_spring, sea=None):
    """`MovingLines` and their States at rest.

    lines : {number: DynamicLine}; fairleads : (m, 3) m in space, of these with the body at rest
    as_spring : `MovingLines.stretch` and `spring`; sea : LineSea that grows from still water, None for still water
    raises : LineError for a line without a shape at rest
    """
    still = water_arrays(None, None, 9.80665)
    states = [start(line, place, still) for line, place in zip(lines.values(), fairleads, strict=True)]
    systems = [line.system for line in lines.values()]
    controls = [control_of(line, state, 1.0, 1.0) for line, state in zip(lines.values(), states, strict=True)]
    together = {name: [getattr(one, name) for one in systems] for name in System._fields}
    elements, nodes, bodies, rows = (
        np.concatenate([[0], np.cumsum([len(value) for value in together[name]])]).astype(np.int64)
        for name in ("length", "mass", "body_nodes", "elongation")
    )
    sea = line_sea(None, None, np.inf, None, (0.0, 0.0), 0.0) if sea is None else sea
    water, *room = water_of(sea, int(nodes[-1]), int(np.diff(nodes).max()))
    flexure = together.pop("flexure")
    made = {name: np.array(values, float) for name, values in together.items() if name in OF_BED}
    made |= {name: np.concatenate(values) for name, values in together.items() if name not in made}
    return MovingLines(
        np.array(list(lines), np.int64),
        System(**made, flexure=_flexure(flexure, systems)),
        elements,
        nodes,
        bodies,
        rows,
        np.array([one.tension for one in controls]),
        np.array([one.distance for one in controls]),
        float(tolerance),
        water,
        sea,
        tuple(room),
        *as_spring,
    ), tuple(states)


def _flexure(parts, systems):
    """(n,) of all nodes, 0 in lines without bending stiffness; (0,) if no line has any"""
    if not any(one.size for one in parts):
        return np.zeros(0)
    pairs = zip(parts, systems, strict=True)
    return np.concatenate([one if one.size else np.zeros(len(system.mass)) for one, system in pairs])


@kernel()
def line_system(moving, i):
    """`System` of line i: slices of the arrays of all"""
    s = moving.system
    e, f = moving.elements[i], moving.elements[i + 1]
    n, m = moving.nodes[i], moving.nodes[i + 1]
    return System(
        s.length[e:f],
        s.stiffness[e:f],
        s.elongation_rows[e:f],
        s.elongation[moving.rows[i] : moving.rows[i + 1]],
        s.damping[e:f],
        s.soft_strain[e:f],
        s.half_mass[e:f],
        s.half_drag_normal[e:f],
        s.half_drag_tangential[e:f],
        s.half_added_normal[e:f],
        s.half_added_tangential[e:f],
        s.half_displaced[e:f],
        s.buoyancy[e:f],
        s.waterline[e:f],
        s.weight[n:m],
        s.flexure[n:m],
        s.mass[n:m],
        s.inertia[n:m],
        s.body_nodes[moving.bodies[i] : moving.bodies[i + 1]],
        s.body_buoyancy[n:m],
        s.body_radius[n:m],
        s.body_drag[n:m],
        s.body_added[n:m],
        s.body_displaced[n:m],
        s.bed_stiffness[n:m],
        s.bed_damping[n:m],
        s.bed_thickness[n:m],
        s.bed_normal[i],
        s.bed_level[i],
        s.bed_friction[i],
        s.bed_slip[i],
        s.bed_course[i],
        s.bed_profile,
    )
