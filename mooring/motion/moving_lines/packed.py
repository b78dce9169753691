"""Moving lines of a body as the kernels read them, and the state that the kernels keep.

Lines have different numbers of nodes. Each array that a kernel advances contains the data of all lines, one after
another.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory

from ...lines.dynamics.lumped.system import Water
from ...lines.dynamics.lumped.workspace import workspace
from ...lines.dynamics.run import control_of
from ...lines.dynamics.start import start
from .sea import LineSea, line_water, water_of

ROWS = 256  # largest number of line steps in one step of the body; more mean that the body's step is too long


@in_memory
class MovingLines(NamedTuple):
    """m moving lines.

    number : (m,), number of each line in its system; systems, rooms : m `System`s and `workspace`s
    nodes : (m + 1,), index at which the nodes of each line begin in joint arrays
    tension, distance : scales of the errors of each line, (m,), N and m; tolerance : tolerance of a step
    water : `Water` at all nodes, with a table of `sea` that is refilled during the run; waters : its m parts, one
        for each line
    room_of_sea : memory for the sums of waves. Without waves and current all four are None
    stretch : (m, 6 + f), m/m and m/rad, lengthening of each chord (anchor to fairlead) by the body's motions and by
        shapes
    spring : (m,) N/m, EA/L
    """

    number: np.ndarray
    systems: list
    rooms: list
    nodes: np.ndarray
    tension: np.ndarray
    distance: np.ndarray
    tolerance: float
    water: Water | None
    waters: list | None
    sea: LineSea | None
    room_of_sea: tuple | None
    stretch: np.ndarray
    spring: np.ndarray


@in_memory
class Room(NamedTuple):
    """Room for the place and velocity of a fairlead"""

    R: np.ndarray
    unit: np.ndarray
    arm: np.ndarray
    push: np.ndarray


@in_memory
class MovingWork(NamedTuple):
    """State of m moving lines with n nodes in total during a run; arrays are changed in place.

    position, velocity, acceleration, slip : (2, n, 3), [0] at the end of the body's last step, [1] at the end of a
        trial step
    step : next steps of the lines, (2, m) s; course : (m, 3, 2, 3), position and velocity of each fairlead at start,
        middle and end of a step
    time, pull, slope : (m, ROWS) s, (m, ROWS, 3) N and N/s, at the ends of the lines' own steps; `used` (m,) rows
        are filled
    before : (m, 4), time and pull before the first of these ends; foreseen : (N, 12), poses and velocities with the
        predicted pull
    last : (lines, TERMS, 3) N, pull of every line of the system in the body's last step; length : length of this
        step, (1,) s
    pose : (N, 18), push : (6N + 6G,), room : `Room`, work arrays
    bent : (2, 2, f), amplitudes of shapes and their rates in the middle and at the end of a step with the predicted
        pull
    tension : (samples, m) N; steps : number of steps of each line, (m,); stuck : number of a line that stopped, or
        −1, (1,)
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
    bent: np.ndarray
    room: Room
    tension: np.ndarray
    steps: np.ndarray
    stuck: np.ndarray


def moving_lines(lines, fairleads, tolerance, as_spring, sea=None):
    """`MovingLines` and their States at rest.

    lines : {number: DynamicLine}; fairleads : (m, 3) m in space, with the body at rest
    as_spring : `MovingLines.stretch` and `spring`; sea : LineSea that grows from still water, None for still water
    raises : LineError for a line without a shape at rest
    """
    states = [start(line, place, None) for line, place in zip(lines.values(), fairleads, strict=True)]
    systems = [line.system for line in lines.values()]
    controls = [control_of(line, state, 1.0, 1.0) for line, state in zip(lines.values(), states, strict=True)]
    nodes = np.concatenate([[0], np.cumsum([len(one.mass) for one in systems])]).astype(np.int64)
    water, *room = (None,) if sea is None else water_of(sea, int(nodes[-1]), int(np.diff(nodes).max()))
    return MovingLines(
        np.array(list(lines), np.int64),
        systems,
        [workspace(one) for one in systems],
        nodes,
        np.array([one.tension for one in controls]),
        np.array([one.distance for one in controls]),
        float(tolerance),
        water,
        None if sea is None else [line_water(water, *ends) for ends in pairwise(nodes.tolist())],
        sea,
        tuple(room) or None,
        *as_spring,
    ), tuple(states)
