"""Dynamic mooring line: lumped mass in three dimensions with implicit steps chosen by their error.

Forces and signs: `lumped.forces`; steps: `lumped.esdirk`.  The iteration on tensions with lagged angles of the SR179
report (1982), section 2.2, has a limit c Δt/ℓ of about 0.45. Here a step solves for the nodes with the tangent of
tension, geometry and bed, and has no such limit.

Energy balance: work at the fairlead = energy stored in the line + work lost to drag, inertia of the water, structural
damping, and damping and friction of the bed.
"""

import warnings
from dataclasses import replace

import numpy as np

from .estimates import mesh_error, step_error
from .line import AttachedBody, DynamicLine, DynamicSegment, ElasticBed
from .lumped.system import above_bed
from .run import Case, DynamicLineError, Energies, Result, run_esdirk
from .start import start as at_rest
from .surroundings import CurrentProfile, FairleadMotion, WaveTrain, water_arrays

__all__ = [
    "AttachedBody",
    "CurrentProfile",
    "DynamicLine",
    "DynamicLineError",
    "DynamicSegment",
    "ElasticBed",
    "Energies",
    "FairleadMotion",
    "Result",
    "WaveTrain",
    "simulate",
]

JOINT, JERK = 1e-6, 1e-3  # m, gap allowed between a run and the next; m/s, fairlead speed allowed for a line at rest


def simulate(
    line,
    motion,
    duration,
    *,
    current=None,
    waves=None,
    tolerance=1e-3,
    longest_step=np.inf,
    frames=0,
    stations=(),
    start=None,
    check_mesh=True,
    mesh_tolerance=0.02,
    progress=None,
    stops=(),
):
    """Motion and tension of `line` while its fairlead follows `motion`, from rest or from the end of another run.

    line : DynamicLine; motion : FairleadMotion; duration : s; current : CurrentProfile; waves : WaveTrain
    tolerance : allowed error of a step in the end tensions and in the mean of all tensions, over the largest tension
        so far
    longest_step : s, an upper bound; frames : number of stored shapes, evenly in time; stations : node numbers
    start : State at the `end` of an earlier run, whose motion the fairlead continues; the elements are then not
        checked
    check_mesh : whether to estimate the errors of the largest tensions, at the fairlead and inside, by runs with
        half as many elements and with steps twice as long; warns above `mesh_tolerance` (see `estimates`)
    progress : function called with the time reached (s) after every thousand steps
    stops : times (s) at which a step ends, so that the history is exact there
    returns : Result
    raises : ValueError for impossible input; LineError if there is no static shape; DynamicLineError if the run
        stops early
    """
    _check(line, motion, duration, tolerance, longest_step, frames, stations, start)
    water = water_arrays(current, waves, line.gravity)
    rest = at_rest(line, motion.at(0.0)[0], water) if start is None else start
    _check_joint(motion, rest, start is None)
    _check_above_bed(line, motion, rest.time, duration)
    stops = tuple(sorted(set(map(float, stops))))
    case = Case(line, motion, water, duration, tolerance, longest_step, frames, stations, progress, stops)
    result = run_esdirk(case, rest)
    if check_mesh and start is None:
        result = replace(result, mesh_error=mesh_error(case, result, mesh_tolerance))
    if check_mesh:
        result = replace(result, step_error=step_error(case, result, rest, mesh_tolerance))
    return result


def _check(line, motion, duration, tolerance, longest_step, frames, stations, start):
    begin = 0.0 if start is None else start.time
    rounding = 1e-9 * (1.0 + begin + duration)
    for name, value, good, allowed in (
        ("duration", duration, 0 < duration < np.inf, "finite, above 0 s"),
        ("tolerance", tolerance, 0 < tolerance <= 0.1, "above 0, at most 0.1"),
        ("longest_step", longest_step, longest_step > 0, "above 0 s"),
        ("frames", frames, frames >= 0, "0 or more"),
        (
            "end of the run",
            begin + duration,
            begin + duration <= motion.end + rounding,
            f"up to {motion.end:g} s, motion's end",
        ),
        ("start of the run", begin, begin >= motion.begin - rounding, f"from {motion.begin:g} s, the motion's begin"),
        ("start", "another line's", start is None or start.position.shape[0] == line.elements + 1, "of this line"),
        ("stations", stations, all(0 <= j <= line.elements for j in stations), f"0 to {line.elements}"),
    ):
        if not good:
            raise ValueError(f"{name} is {value}; allowed: {allowed}")


def _check_joint(motion, state, from_rest):
    """Raise ValueError unless the fairlead starts at the line's end; warn if it starts with a velocity from rest."""
    position, velocity, _ = motion.at(state.time)
    gap = np.linalg.norm(position - state.position[-1])
    if not gap <= JOINT * (1 + np.abs(position).max()):
        raise ValueError(
            f"the motion starts {gap:.3g} m from the place where the previous run ended; start it at that place"
        )
    jerk = np.linalg.norm(velocity - state.velocity[-1])
    if from_rest and jerk > JERK:
        warnings.warn(
            f"the fairlead starts at {jerk:.3g} m/s while the line is at rest: the first tensions are those of an "
            "impact; give the motion a ramp",
            stacklevel=3,
        )


def _check_above_bed(line, motion, begin, duration):
    """Warn of a fairlead that moves below the bed: contact acts on the line alone."""
    if line.bed is None:
        return
    times = np.linspace(begin, begin + duration, 201)
    height = above_bed(line.system, np.array([motion.at(t)[0] for t in times])).min()
    if height < 0:
        warnings.warn(f"the fairlead goes {-height:.3g} m below the bed; allowed: at or above it", stacklevel=3)
