"""One run of a dynamic line: its input, the loop over the kernels' steps, and the history of results."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .line import DynamicLine
from .lumped.system import Control, State, Water, elastic_tension
from .surroundings import FairleadMotion

ROWS = 1000  # rows of history that are computed at a time
SHORTEST = 1e-8  # shortest step, over the longest
FIRST = 0.02  # first step, over the longest
FINER = 4  # divisor of the longest step where friction acts: its work is proportional to the cube of a pull
FREE = 0.01  # largest error of a node's place in a step, over the line's length times the tolerance


class DynamicLineError(ValueError):
    """A run that cannot continue; the message names time, node and step."""


class Energies(NamedTuple):
    """Energies since the start, J, each (n,): work done on the line at its ends, work lost to each cause, and stored
    energy.

    work : integral of force times velocity, whose error is of first order in the force; see `supplied`
    """

    work: np.ndarray
    drag: np.ndarray
    water_inertia: np.ndarray
    structural: np.ndarray
    bed: np.ndarray
    friction: np.ndarray
    kinetic: np.ndarray
    elastic: np.ndarray
    potential: np.ndarray
    bed_elastic: np.ndarray

    @property
    def lost(self):
        """Energy lost since the start, J; shape (n,)"""
        return self.drag + self.water_inertia + self.structural + self.bed + self.friction

    @property
    def supplied(self):
        """Work done at the ends, computed as losses plus stored energy, J; shape (n,)

        In slow motion a line exchanges a thousand times the energy that it loses. The losses are all positive, and
        the stored energy has its minimum in equilibrium. The error of this sum is therefore of second order in the
        error of the state.
        """
        return self.lost + self.stored

    @property
    def stored(self):
        """Energy stored, J; shape (n,); negative if less than at the start"""
        total = self.kinetic + self.elastic + self.potential + self.bed_elastic
        return total - total[0]


@dataclass(frozen=True)
class Result:
    """History of a line at the ends of its n steps.

    time : (n,) s; force_fairlead, force_anchor : (n, 3) N, of the line on its ends, including the inertia of the end
        nodes
    station_tension : (n, k) N at the requested nodes; least_tension, largest_tension : (n,) N of all elements
    energies : Energies; frame_time (f,) s and frames (f, N + 1, 3) m
    steps, rejected, newton : number of steps, of rejected steps and of Newton steps
    mesh_error, step_error : estimated relative errors of the largest tensions, at the fairlead and inside, from the
    elements and from the steps; nan if not requested
    end : State from which a further run can continue
    """

    time: np.ndarray
    force_fairlead: np.ndarray
    force_anchor: np.ndarray
    station_tension: np.ndarray
    least_tension: np.ndarray
    largest_tension: np.ndarray
    energies: Energies
    frame_time: np.ndarray
    frames: np.ndarray
    steps: int
    rejected: int
    newton: int
    end: State
    mesh_error: float = np.nan
    step_error: float = np.nan

    def __repr__(self):
        return (
            f"<Result {self.time[0]:g} to {self.time[-1]:g} s in {self.steps} steps, "
            f"largest tension {self.tension_fairlead.max():.6g} N>"
        )

    @cached_property
    def tension_fairlead(self):
        """Tension at the fairlead, N; shape (n,)"""
        return np.linalg.norm(self.force_fairlead, axis=1)

    @cached_property
    def tension_anchor(self):
        """Tension at the anchor, N; shape (n,)"""
        return np.linalg.norm(self.force_anchor, axis=1)


class Case(NamedTuple):
    """Checked input of a run; times in s; stations are node numbers; progress : function called with the time
    reached, s.

    stops : ascending times at which a step must end; coarser : factor on the length of steps, to estimate their error
    """

    line: DynamicLine
    motion: FairleadMotion
    water: Water | None
    duration: float
    tolerance: float
    longest_step: float
    frames: int
    stations: tuple
    progress: object = None
    stops: tuple = ()
    coarser: float = 1.0


class _Pictures(NamedTuple):
    time: np.ndarray
    nodes: np.ndarray
    stations: np.ndarray


def _pictures(case, state):
    return _Pictures(
        np.linspace(state.time, state.time + case.duration, case.frames),
        np.zeros((case.frames, case.line.elements + 1, 3)),
        np.asarray(case.stations, np.int64).reshape(-1),
    )


def control_of(line, state, tolerance, longest):
    """Control of the steps from `state`; no step is longer than `longest` s"""
    system = line.system
    tension = elastic_tension(system, state.position).max()
    least = np.abs(system.weight).max()
    return Control(tolerance, max(tension, least), FREE * line.length, longest, SHORTEST * longest)


def finer(line):
    """Divisor of the longest step that the motion of the fairlead allows: FINER with friction on the bed, else 1"""
    return FINER if line.bed is not None and line.bed.friction > 0 else 1


def _control(case, state):
    longest = min(case.longest_step, case.motion.longest_step / finer(case.line))
    return control_of(case.line, state, case.coarser**3 * case.tolerance, case.coarser * longest)


def stopped(line, time, step, shortest, node):
    """DynamicLineError of a run whose step became too short near a node"""
    return DynamicLineError(
        f"{line}: at t = {time:.6g} s the time step fell to {step:.3g} s, limit {shortest:.3g} s, near node {node} of "
        f"{line.elements}; give a larger tolerance, more damping or a softer bed"
    )


def run_esdirk(case, state):
    """Result of steps chosen by their error. The kernel returns after each piece of history, so that Ctrl-C takes
    effect.
    """
    from .lumped.esdirk import COLUMNS, DONE, TOO_SHORT, follow
    from .lumped.workspace import workspace

    control, pictures, end = _control(case, state), _pictures(case, state), state.time + case.duration
    stops = [t for t in case.stops if state.time < t < end] + [end]
    first = state.step if np.isfinite(state.step) else FIRST * control.longest
    state = State(state.time, *(np.array(x) for x in state[1:5]), first)
    motion, counts, drawn = case.motion.arrays, np.zeros(3, int), 0
    parts, marks, energy, room = [], [], np.zeros(6), workspace(case.line.system)
    while stops:
        rows, station_rows = np.zeros((ROWS, COLUMNS)), np.zeros((ROWS, pictures.stations.size))
        rows[0, 7:13] = energy
        why, used, n, time, step, rejected, newton, worst = follow(
            case.line.system,
            room,
            case.water,
            motion,
            control,
            state,
            stops[0],
            rows,
            pictures.time[drawn:],
            pictures.nodes[drawn:],
            pictures.stations,
            station_rows,
        )
        if why == TOO_SHORT:
            raise stopped(case.line, time, step, control.shortest, worst)
        stops = stops[1:] if why == DONE else stops
        drawn, counts, energy = drawn + n, counts + (used - 1, rejected, newton), rows[used - 1, 7:13]
        again = 1 if parts else 0  # each piece begins with the last row of the one before
        parts.append(rows[again:used])
        marks.append(station_rows[again:used])
        state = state._replace(time=time, step=step)
        control = control._replace(tension=max(control.tension, rows[:used, 18].max()))
        if case.progress is not None:
            case.progress(float(time))
    pictures.nodes[drawn:] = state.position
    return _result(np.concatenate(parts), np.concatenate(marks), pictures, counts, state)


def _result(rows, marks, pictures, counts, state):
    return Result(
        rows[:, 0],
        rows[:, 1:4],
        rows[:, 4:7],
        marks,
        rows[:, 17],
        rows[:, 18],
        Energies(*rows[:, 7:17].T),
        pictures.time,
        pictures.nodes,
        *map(int, counts),
        state,
    )
