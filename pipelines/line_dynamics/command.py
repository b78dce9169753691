"""`hakobune line-dynamics`: one line whose fairlead moves → tensions, slack, work, regime, statics beside them."""

from __future__ import annotations

import sys
import time
import warnings
from pathlib import Path

import msgspec
import numpy as np

from hakobune.mooring.lines.system.findings import LONGEST_STRAIN

from ..common.anchors import warn_of_anchors
from ..common.bounds import check_memory, check_seconds, told
from ..common.outputs import DATABASE, check_output
from ..common.picture import PLOTS, check_picture
from ..common.progress import duration as spoken
from ..common.quantities import StudyError
from ..common.units import KN
from ..printing.verdict import tell
from .figures import figures, judged_by_regime
from .in_air import warn_of_air
from .motion import course_of
from .parts import current_of, line_of, wave_of
from .report import findings, show
from .study import read_line_dynamics

EVERY = 2.0  # s between two lines of progress
FINEST = 1e-8  # tolerance; rounding of tensions is 1e-10 or so
STEPS = 2.0  # for each longest step that the motion allows, at a tolerance of 1e-3: 1 to 4 were counted
OF_ELEMENT, OF_STEP = 2e3, 600.0  # bytes
# s of a step, of each element in it, and of each wave at each element, with the checks of both
OF_CALL, OF_ELEMENT_STEP, OF_WAVE = 2.7e-5, 5.3e-6, 2e-7
FRAMES = 20  # of a cycle, or of a run without one at least 200


def line_dynamics(file, duration, tolerance, output, picture):
    """Run the line of a study.  Returns the exit status; raises ValueError, one line."""
    from hakobune.mooring.formats.results import is_channels

    if picture is not None:
        check_picture(picture, PLOTS)
    if output is not None:
        check_output(output, "a file of channels", is_channels, DATABASE)
    study, text = read_line_dynamics(file)
    given = {"duration": duration, "tolerance": tolerance}
    study = msgspec.structs.replace(study, **{key: value for key, value in given.items() if value is not None})
    try:
        return _run(study, text, Path(file).parent, output, picture)
    except KeyboardInterrupt:
        print("hakobune line-dynamics: interrupted; nothing was written", file=sys.stderr)
        return 130


def _run(study, text, folder, output, picture):
    from hakobune.mooring.lines.dynamics.simulation import simulate

    from ..printing.console import new_console

    console, left_out = new_console(), []
    if study.moordyn is not None:
        from .moordyn import with_moordyn

        with warnings.catch_warnings(record=True) as left_out:
            warnings.simplefilter("always")
            study = with_moordyn(study, folder)
    _check_finest(study)
    line, strength = line_of(study)
    course = course_of(study, folder)
    if not 0 < course.duration < np.inf:
        raise StudyError(f"duration is {course.duration:g} s; allowed: finite, above 0")
    window = course.window(study.measure_from)
    current, wave = current_of(study), wave_of(study, course.ramp or None)
    frames = frames_of(study, course)
    check_effort(study, line, course, wave, frames, len(strength.nodes(line)))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        check_reach(line, strength.weakest, course)
        warn_of_anchors({"anchor": study.anchor[2]}, study.water.depth)
        result = simulate(
            line,
            course.motion,
            course.duration,
            current=current,
            waves=wave,
            tolerance=study.tolerance,
            frames=frames,
            stations=strength.nodes(line),
            progress=Progress(console, course.duration),
            stops=window[:2],
        )
        warn_of_air(line, result)
    harmonics = 0 if study.sea else sum(any(part.amplitude) for part in study.fairlead.motions)
    found = figures(line, course, window, result, current, judged_by_regime(line, course, harmonics))
    written = _write(study, text, course, result, found, line, strength, output, picture)
    show(console, study.name, found, course, result, strength, line)
    noted = findings(found, result, strength, line)
    status = tell([*(str(w.message) for w in (*left_out, *said)), *noted], console)
    for path in written:
        console.print(f"written: {path}", highlight=False, soft_wrap=True)
    return status


def frames_of(study, course):
    """Number of frames asked for, or about 20 for each cycle"""
    if study.frames is not None:
        if not 2 <= study.frames <= 100_000:
            raise StudyError(f"frames is {study.frames}; allowed: 2 to 100000")
        return study.frames
    cycles = 0.0 if course.cycle is None else course.duration / course.cycle
    return int(min(max(200, FRAMES * cycles), 2000)) + 1


def _check_finest(study):
    """Raise a ValueError for a tolerance below rounding, or more elements than fit; before there is an array."""
    if not FINEST <= study.tolerance <= 0.1:
        raise StudyError(f"tolerance is {study.tolerance:g}; allowed: {FINEST:g} to 0.1")
    elements = sum(part.elements or 0 for part in study.segments)
    check_memory(f"{elements} elements need", OF_ELEMENT * elements, "give fewer elements")


def check_effort(study, line, course, wave, frames, stations=0):
    """Raise TooMuchError for a run that nobody can wait for or store, and say what a long one takes.

    Steps are as many as the tolerance asks for, a guess within a factor of three: most in snapping lines.
    """
    from hakobune.mooring.lines.dynamics.run import finer
    from hakobune.mooring.lines.dynamics.surroundings import PARTS_OF_PERIOD

    periods = np.zeros(0) if wave is None else wave.period
    fastest = min(course.motion.longest_step, periods.min(initial=np.inf) / PARTS_OF_PERIOD)
    fastest = min(fastest, course.duration / 100) / finer(line)
    steps = STEPS * (1e-3 / study.tolerance) ** 0.38 * course.duration / fastest
    what = f"{course.duration:g} s of {line.elements} elements"
    way_out = "give a shorter duration (--duration), fewer elements or slower motions"
    memory = (OF_STEP + 8.0 * stations) * steps + 3 * 24.0 * frames * (line.elements + 1)
    check_memory(f"{what} need", memory, way_out)
    seconds = (OF_CALL + (OF_ELEMENT_STEP + OF_WAVE * len(periods)) * line.elements) * steps
    check_seconds(f"{what} take", seconds, way_out)
    told(f"{what} take", seconds)


def check_reach(line, breaking, course):
    """Raise StudyError where the fairlead goes farther from the anchor than the line at its breaking load reaches."""
    from scipy.optimize import brentq

    times = np.linspace(0.0, min(course.duration, course.motion.end), 1001)
    places = np.array([course.motion.at(t)[0] for t in times])
    away = np.linalg.norm(places - np.array(line.anchor), axis=1)
    far = int(np.argmax(away))
    longest = LONGEST_STRAIN * line.length

    def stretch(tension):
        return sum(float(segment.length * segment.strain_at(tension)) for segment in line.segments)

    at_break = stretch(breaking) if np.isfinite(breaking) else np.inf
    reach = line.length + min(at_break, longest)
    if away[far] > reach:
        parts = at_break <= longest
        how = f"breaks at {breaking / KN:.0f} kN" if parts else f"is {LONGEST_STRAIN:.0%} longer, where any rope parts"
        raise StudyError(
            f"the fairlead is {away[far]:.2f} m from the anchor at t = {times[far]:.2f} s; allowed: up to "
            f"{reach:.2f} m, where the line of {line.length:g} m {how}"
        )
    if away[far] > line.length:
        over, most = away[far] - line.length, min(breaking, sum(segment.stiffness for segment in line.segments))
        pull = brentq(lambda tension: stretch(tension) - over, 0.0, most)
        warnings.warn(
            f"the fairlead goes {away[far] - line.length:.2f} m farther from the anchor than the line is long, at "
            f"t = {times[far]:.2f} s: stretching it so takes {pull / KN:.0f} kN",
            stacklevel=2,
        )


class Progress:
    """Prints how far a run is, every two seconds of waiting; runs over the same time after it are its checks."""

    CHECKS = "", "with fewer elements: ", "with longer steps: "

    def __init__(self, console, until):
        self.console, self.until, self.reached, self.run = console, until, np.inf, -1
        self.begin, self.started = 0.0, time.perf_counter()
        self.printed = self.started

    def __call__(self, reached):
        now = time.perf_counter()
        if reached < self.reached:  # the clock starts here, when kernels are compiled
            self.run += 1
            self.begin, self.started = reached, now
        elif now - self.printed >= EVERY and reached < self.until:
            left = spoken((now - self.started) * (self.until - reached) / (reached - self.begin))
            self.console.print(
                f"{self.CHECKS[self.run]}{reached:.4g} of {self.until:g} s, {left} left", highlight=False
            )
            self.printed = now
        self.reached = reached


def _write(study, text, course, result, found, line, strength, output, picture):
    written = []
    if output is not None:
        from hakobune.mooring.formats.results import channels_of_line, write_channels

        places = np.array([course.motion.at(t)[0] for t in result.time])
        channels = channels_of_line(result)
        channels |= {f"Point2P{axis}": (values, "m") for axis, values in zip("XYZ", places.T, strict=True)}
        channels |= {
            f"Point1P{axis}": (np.full(len(places), x), "m") for axis, x in zip("XYZ", line.anchor, strict=True)
        }
        names = {"lines": [study.name], "points": ["anchor", "fairlead"]}
        frames = result.frame_time, result.frames
        attributes = {"study": text, "duration": course.duration, "tolerance": study.tolerance, **found.attributes()}
        write_channels(output, result.time, channels, names, frames, attributes)
        written.append(output)
    if picture is not None:
        from .picture import draw_run

        draw_run(picture, study.name, line, course, result, found, strength)
        written.append(picture)
    return written
