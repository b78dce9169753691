"""What a motion of its own changes in the pull of a line, seen by driving it along the course of its fairlead.

The regimes of the simplified method (`mooring.lines.regimes`) were tried for this: of random chains, wires and ropes
that they call quasi-static, every second pulled more than a tenth otherwise in a run (`tests/bench/line_regimes.py`).
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np

from ...lines.catenary.state import LineError
from ...lines.dynamics.simulation import CurrentProfile, FairleadMotion, WaveTrain
from ...lines.dynamics.simulation import simulate as drive
from ...lines.system.parts import UniformLine
from ...on_current.waves import met_by_a_place
from .prepare import dynamic_line, ends_of

BEFORE, AFTER, SETTLE = 60.0, 20.0, 20.0  # s of the course about the largest static tension, and of its begin, in which
# the line, which starts at rest, takes up the motion


class Trial(NamedTuple):
    """off : {number of a line: largest difference of its pull from that of its static shape, over the largest of that}
    refused : why lines cannot move by themselves, one line each; every reason once
    """

    off: dict
    refused: tuple[str, ...]


def beside_static(system, run, courses, elements, components=None, current=None, carrier=None):
    """`Trial` of the uniform lines of a System along a `Realisation` with all lines in their static shape

    courses : for each line the places and velocities (2, n, 3) m, m/s of its fairlead
    components : of the waves (`mooring.environment.sea.Components`) and current : (2,) m/s, that move the water around
    the lines, None for still water; carrier : `mooring.on_current.waves.Carrier` of the waves, None for none
    """
    off, refused = {}, {}
    for number, line in enumerate(system.lines):
        if not isinstance(line, UniformLine):
            kind = type(line).__name__
            refused.setdefault(kind, f"dynamic_lines: line {line.name} has segments or is a hawser and keeps its shape")
            continue
        try:
            moving = dynamic_line(line, ends_of(line, system)[0].position, system, elements)
            off[number] = _difference(
                moving, run, courses[number], number, (components, current, carrier, system.depth)
            )
        except (LineError, ValueError) as error:
            refused.setdefault(line.type.name, str(error))
    return Trial(off, tuple(refused.values()))


def _difference(line, run, course, number, water):
    """Of a DynamicLine along the course of its fairlead in a run; largest, over the largest static tension"""
    middle = run.time[np.argmax(run.tension[:, number])]
    part = (run.time >= middle - BEFORE) & (run.time <= middle + AFTER)
    t, still = run.time[part] - run.time[part][0], run.tension[part, number]
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="the fairlead starts at")  # that blow is left out, see SETTLE
        motion, begin = FairleadMotion.table(t, *course[:, part]), run.time[part][0] - run.time[0]
        alone = drive(line, motion, float(t[-1]), check_mesh=False, **_water(*water, begin))
    late = t >= min(SETTLE, 0.5 * t[-1])
    pull = np.interp(t, alone.time, alone.tension_fairlead)
    return float(np.abs(pull - still)[late].max() / still.max())


def _water(components, current, carrier, depth, begin):
    """Keywords of a run of a line for waves and current, from `begin` s of the waves on"""
    made = {}
    if components is not None:
        omega, amplitude, phase, direction = components
        period, moves = 2 * np.pi / omega, (0.0, 0.0) if carrier is None else carrier.velocity
        later = phase - met_by_a_place(components, carrier, depth, 9.80665) * begin
        made["waves"] = WaveTrain(amplitude, period, direction, later, depth, SETTLE, moves)
    if current is not None:
        made["current"] = CurrentProfile([0.0], [current])
    return made
