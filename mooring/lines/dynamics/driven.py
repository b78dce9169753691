"""A dynamic line in the loop of a host that moves its end step by step: a simulation of bodies, or another program.

    driven = DrivenLine(line)
    state = driven.rest(fairlead)
    state, pull = driven.advance(state, step, position, velocity)

Between two times of the host the fairlead follows the cubic through both positions and velocities; inside, the line
takes as many steps of its own as its tolerance asks for (`lumped.esdirk`).  `advance` leaves the state that it is given
as it was: a host whose step failed, or that iterates, goes on from the same state again.  A state is what a run is
saved as; `state_of` makes one of stored arrays.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .line import DynamicLine
from .lumped.system import Motion, State, Water
from .run import FIRST, control_of, stopped
from .start import start
from .surroundings import water_arrays

ROWS = 64  # of history at a time
ROUNDING = 1e-9  # of the host's step, which the sum of times may exceed it by
LEAPT = 2.0  # of the line's length: no fairlead moves farther in one step of its host


class Pull(NamedTuple):
    """What a line did in one step of its host.

    force_fairlead, force_anchor : (3,) N at the end of the step, of the line on its ends
    largest_tension : N, of any element at the ends of the line's own steps; steps : how many
    work : J, done on the line at its ends
    """

    force_fairlead: np.ndarray
    force_anchor: np.ndarray
    largest_tension: float
    steps: int
    work: float

    @property
    def tension(self):
        """N, at the fairlead"""
        return float(np.linalg.norm(self.force_fairlead))


@dataclass(frozen=True)
class DrivenLine:
    """A line whose fairlead a host moves, in a current and in waves.

    line : DynamicLine; current : CurrentProfile or None; waves : WaveTrain or None, of the host's time
    tolerance : error of a step in the tensions at the ends, and in the mean of all, of the largest tension so far
    """

    line: DynamicLine
    current: object = None
    waves: object = None
    tolerance: float = 1e-3

    def __post_init__(self):
        if not 0 < self.tolerance <= 0.1:
            raise ValueError(f"tolerance is {self.tolerance:g}; allowed: above 0, at most 0.1")

    @cached_property
    def water(self) -> Water:
        """Current and waves for the kernels."""
        return water_arrays(self.current, self.waves, self.line.gravity)

    def rest(self, fairlead, time=0.0):
        """State of the line at rest with its fairlead at (3,) m.  Raises LineError where there is none."""
        return start(self.line, fairlead, self.water)._replace(time=float(time))

    def state_of(self, time, position, velocity, acceleration, slip, step):
        """State of its stored fields.  Raises ValueError where they are not of this line."""
        shape = (self.line.elements + 1, 3)
        arrays = [np.array(x, float) for x in (position, velocity, acceleration, slip)]
        if any(x.shape != shape or not np.all(np.isfinite(x)) for x in arrays):
            raise ValueError(f"a state has arrays {arrays[0].shape}; allowed: {shape}, finite, of {self.line!r}")
        return State(float(time), *arrays, float(step))

    def pull(self, state):
        """Pull of the line at `state`, without a step"""
        row = self._row(state)
        return Pull(row[1:4].copy(), row[4:7].copy(), float(row[18]), 0, 0.0)

    def advance(self, state, step, position, velocity):
        """State and Pull after `step` s, at whose end the fairlead is at `position` (3,) m with `velocity` (3,) m/s.

        raises : ValueError for a motion that cannot be, DynamicLineError where the line's own steps became too short
        """
        from .lumped.esdirk import DONE, TOO_SHORT, run, tableau

        motion, end = self._motion(state, step, position, velocity), state.time + step
        control = control_of(self.line, state, self.tolerance, (1 + ROUNDING) * step)
        first = state.step if np.isfinite(state.step) else FIRST * step
        state, scheme, rows = State(state.time, *(np.array(x) for x in state[1:5]), first), tableau(), _rows()
        largest, steps, why = 0.0, 0, None
        while why != DONE:
            why, used, _, time, h, _, _, worst = run(
                self.line.system, self.water, motion, control, scheme, state, end, rows, *_NO_PICTURES
            )
            if why == TOO_SHORT:
                raise stopped(self.line, time, h, control.shortest, worst)
            largest, steps = max(largest, rows[:used, 18].max()), steps + used - 1
            state, last = state._replace(time=time, step=h), rows[used - 1].copy()
            rows[0, 7:13] = last[7:13]
        return state, Pull(last[1:4], last[4:7], float(largest), steps, float(last[7]))

    def _row(self, state):
        from .lumped.esdirk import run, tableau

        here, none = state.position[-1], np.zeros(3)
        motion = Motion(np.array([0.0, 1.0]), np.array([[here, none, none, none]]), *_STILL)
        rows, held = _rows(), State(state.time, *(np.array(x) for x in state[1:5]), 1.0)
        control = control_of(self.line, state, self.tolerance, 1.0)
        run(self.line.system, self.water, motion, control, tableau(), held, state.time, rows, *_NO_PICTURES)
        return rows[0]

    def _motion(self, state, step, position, velocity):
        """The cubic from where the fairlead is to where it has to be."""
        p, v = np.asarray(position, float), np.asarray(velocity, float)
        if not 0 < step < np.inf:
            raise ValueError(f"step is {step:g} s; allowed: finite, above 0")
        if p.shape != (3,) or v.shape != (3,) or not (np.all(np.isfinite(p)) and np.all(np.isfinite(v))):
            raise ValueError(f"fairlead is at {position} m with {velocity} m/s; allowed: three finite numbers each")
        p0, v0 = state.position[-1], state.velocity[-1]
        leap = np.linalg.norm(p - p0)
        if leap > LEAPT * self.line.length:
            raise ValueError(f"the fairlead moves {leap:.4g} m in {step:g} s; allowed: {LEAPT:g} lengths of its line")
        rise = (p - p0) / step
        cubic = np.array([[p0, v0, (3 * rise - 2 * v0 - v) / step, (v0 + v - 2 * rise) / step**2]])
        return Motion(np.array([state.time, state.time + step]), cubic, *_STILL)


_STILL = np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), 0.0
_NO_PICTURES = np.zeros(0), np.zeros((0, 0, 3)), np.zeros(0, np.int64), np.zeros((ROWS, 0))


def _rows():
    from .lumped.esdirk import COLUMNS

    return np.zeros((ROWS, COLUMNS))
