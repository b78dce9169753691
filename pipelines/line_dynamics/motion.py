"""Motion, cycle and duration of the fairlead of a dynamic line: from a study or a table of positions."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import read_text

from ..common.quantities import StudyError, positive
from ..common.weather.seas import mean_period

LARGEST = 64  # MB of a table of positions
CYCLES = 12  # cycles of a harmonic run without a duration
TOGETHER = 1e-6  # largest relative deviation of the longest period from a multiple of another


@dataclass(frozen=True)
class Course:
    """motion : FairleadMotion; ramp, duration : s; cycle : time after which everything repeats, s, or None"""

    motion: object
    ramp: float
    duration: float
    cycle: float | None

    def window(self, begin=None):
        """Start and end (s) of the statistics, and the number of full cycles between them, counted back from the end.

        begin : earliest start, s, by default the end of the ramp.  Raises StudyError where no cycle remains.
        """
        begin = self.ramp if begin is None else begin
        least = 0.0 if self.cycle is None else self.cycle
        if not 0 <= begin <= self.duration - least * (1 - 1e-9) or begin == self.duration:
            one = "" if self.cycle is None else f", one cycle of {least:g} s before the end"
            raise StudyError(
                f"the evaluation begins at {begin:g} s of {self.duration:g} s; allowed: 0 to "
                f"{max(self.duration - least, 0.0):g} s{one}; give a longer duration, or an earlier measure_from"
            )
        if self.cycle is None:
            return begin, self.duration, None
        count = int((self.duration - begin) / self.cycle + 1e-9)
        return self.duration - count * self.cycle, self.duration, count


def course_of(study, folder):
    """The Course of a LineDynamicsStudy whose table lies in `folder`.  Raises ValueError."""
    from hakobune.mooring.lines.dynamics.simulation import FairleadMotion

    given = study.fairlead
    if (given.table is None) == (given.position is None):
        state = "neither is given" if given.table is None else "both are given"
        raise StudyError(f"fairlead: position and table: {state}; give one of them")
    if given.ramp is not None and not 0 <= given.ramp < np.inf:
        raise StudyError(f"fairlead.ramp is {given.ramp:g} s; allowed: finite, at least 0")
    if given.table is not None:
        if given.motions:
            raise StudyError("fairlead: motions and a table are both given; give one of them")
        time, position = read_positions(Path(folder) / given.table)
        ramp = 0.0 if given.ramp is None else given.ramp
        motion = FairleadMotion.table(time, faded(time, position, ramp))
        duration = float(time[-1]) if study.duration is None else study.duration
        return Course(motion, ramp, duration, None)
    return _harmonic(study, FairleadMotion)


def _harmonic(study, kind):
    given = study.fairlead
    moving = [part for part in given.motions if any(part.amplitude)]
    for i, part in enumerate(given.motions):
        positive(f"fairlead.motions[{i}].period", part.period)
    periods = [part.period for part in moving] + (
        [] if study.wave is None else [positive("wave.period", study.wave.period)]
    )
    sea = [] if study.sea is None else [mean_period("sea", study.sea, study.water.depth)]
    if sea and study.duration is None:
        raise StudyError("duration is missing; a sea does not repeat and needs one, above 0 s")
    longest = max(periods + sea, default=0.0)
    ramp = longest if given.ramp is None else given.ramp
    if study.duration is None and not periods:
        raise StudyError(
            "duration is missing, and nothing moves that has a period; give a duration above 0 s, or a motion or a wave"
        )
    duration = ramp + CYCLES * longest if study.duration is None else study.duration
    if not moving:
        return Course(kind.still(given.position), ramp, duration, None if sea else longest or None)
    X = [np.multiply(part.amplitude, np.exp(1j * np.radians(part.phase_deg))) for part in moving]
    motion = kind.harmonic(given.position, X, [part.period for part in moving], ramp)
    whole = not sea and all(abs(longest / T - round(longest / T)) <= TOGETHER * longest / T for T in periods)
    return Course(motion, ramp, duration, longest if whole else None)


def read_positions(path):
    """Times (k,), s, and positions (k, 3), m, of a CSV of t,x,y,z; lines with `#`, and one line of names, are skipped.

    raises : StudyError
    """
    text = read_text(path, lambda line: StudyError(f"fairlead.table: {line}"), largest=LARGEST)
    rows = [(n, line) for n, line in enumerate(text.splitlines(), 1) if line.strip() and line.lstrip()[0] != "#"]
    if rows and [cell.strip().lower()[:1] for cell in rows[0][1].split(",")] == ["t", "x", "y", "z"]:
        rows = rows[1:]
    values = np.array([_row(path, number, line) for number, line in rows]).reshape(-1, 4)
    time = values[:, 0]
    if len(time) < 4:
        raise StudyError(f"fairlead.table: {path} has {len(time)} rows; allowed: 4 or more of t,x,y,z")
    if not np.all(np.diff(time) > 0):
        at = rows[int(np.argmin(np.diff(time) > 0)) + 1][0]
        raise StudyError(
            f"fairlead.table: {path}, line {at}: the time does not increase; allowed: later than the line before"
        )
    if time[0] > 0:
        raise StudyError(f"fairlead.table: {path} begins at {time[0]:g} s; allowed: at 0 s or before")
    return time, values[:, 1:]


def _row(path, number, line):
    try:
        row = [float(cell) for cell in line.split(",")]
    except ValueError:
        row = []
    if len(row) != 4 or not np.all(np.isfinite(row)):
        raise StudyError(f"fairlead.table: {path}, line {number} is {line.strip()!r}; allowed: four numbers t,x,y,z")
    return row


def faded(time, position, ramp):
    """A table (k, 3) m whose motion about its mean grows over `ramp` s from 0, as harmonic motions do."""
    if ramp == 0:
        return position
    x = np.clip(time / ramp, 0.0, 1.0)
    mean = position[time >= 0].mean(axis=0)
    return mean + (x**3 * (10 - 15 * x + 6 * x * x))[:, None] * (position - mean)
