"""Cost of a run of a dynamic line, and whether its line reaches all positions of its fairlead."""

import warnings

import numpy as np

from hakobune.mooring.lines.system.findings import LONGEST_STRAIN

from ..common.bounds import check_memory, check_seconds, told
from ..common.quantities import StudyError
from ..common.units import KN
from ..printing.number import significant

FINEST = 1e-8  # smallest tolerance; rounding of tensions is about 1e-10
STEPS = 2.0  # steps per longest step allowed by the motion, at a tolerance of 1e-3; 1 to 4 were counted
OF_ELEMENT, OF_STEP = 2e3, 600.0  # bytes
# s for a step, for each element in it, and for each wave at each element, including the checks of both
OF_CALL, OF_ELEMENT_STEP, OF_WAVE = 2.7e-5, 5.3e-6, 2e-7
FRAMES = 20  # frames per cycle; a run without cycles has at least 200


def frames_of(study, course):
    """Requested number of frames, or about 20 for each cycle"""
    if study.frames is not None:
        if not 2 <= study.frames <= 100_000:
            raise StudyError(f"frames is {study.frames}; allowed: 2 to 100000")
        return study.frames
    cycles = 0.0 if course.cycle is None else course.duration / course.cycle
    return int(min(max(200, FRAMES * cycles), 2000)) + 1


def check_finest(study):
    """Raise a ValueError for a tolerance below rounding, or too many elements; before arrays are allocated."""
    if not FINEST <= study.tolerance <= 0.1:
        raise StudyError(f"tolerance is {study.tolerance:g}; allowed: {FINEST:g} to 0.1")
    elements = sum(part.elements or 0 for part in study.segments)
    check_memory(f"{elements} elements need", OF_ELEMENT * elements, "give fewer elements")


def check_effort(study, line, course, wave, frames, stations=0):
    """Raise TooMuchError for a run that is too long or too large to store; announce the time of a long run.

    The number of steps is estimated from the tolerance within a factor of three; snapping lines need the most steps.
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
    """Raise StudyError if the fairlead moves beyond the reach of the line at its breaking load."""
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
        how = (
            f"breaks at {significant(breaking / KN)} kN"
            if parts
            else f"is stretched by {LONGEST_STRAIN:.0%}, at which any rope parts"
        )
        raise StudyError(
            f"the fairlead is {away[far]:.2f} m from the anchor at t = {times[far]:.2f} s; allowed: up to "
            f"{reach:.2f} m, where the line of {line.length:g} m {how}"
        )
    if away[far] > line.length:
        from scipy.optimize import brentq  # 0.3 s, only for lines that are stretched

        over, most = away[far] - line.length, min(breaking, sum(segment.stiffness for segment in line.segments))
        pull = brentq(lambda tension: stretch(tension) - over, 0.0, most)
        warnings.warn(
            f"the fairlead moves {away[far] - line.length:.2f} m farther from the anchor than the line is long, at t "
            f"= {times[far]:.2f} s, which needs {significant(pull / KN)} kN",
            stacklevel=2,
        )
