"""`hakobune.line_dynamics`: tensions, slack, work and statics of one line with a moving fairlead."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import msgspec
import numpy as np

from hakobune.mooring.lines.dynamics.figures import LOSSES, Figures, figures, judged_by_regime
from hakobune.mooring.studies.moving_in_air import warn_of_air

from ..common.anchors import warn_of_anchors
from ..common.quantities import StudyError
from ..results.given import File, Tables, given, words_of
from ..results.heard import heard
from ..results.provenance import provenance
from ..results.quantity import Quantity, quantities
from ..results.result import Result, labels, records
from .effort import check_effort, check_finest, check_reach, frames_of
from .findings import findings
from .motion import course_of
from .parts import current_of, line_of, wave_of
from .study import LineDynamicsStudy, make_line_dynamics, read_line_dynamics

REGIMES = {1: "quasi-static", 2: "harmonic", 3: "slack and taut", 4: "free fall"}
END = {  # name: (unit, description, of an End)
    "tension.largest": ("N", "largest", lambda end: end.largest),
    "tension.time": ("s", "at t", lambda end: end.time),
    "tension.mean": ("N", "mean", lambda end: end.mean),
    "tension.least": ("N", "least", lambda end: end.least),
    "tension.at_rest": ("N", "at rest", lambda end: end.rest),
    "tension.quasi_static": ("N", "largest, quasi-static", lambda end: end.quasi_static),
    "tension.over_quasi_static": ("", "largest over quasi-static", lambda end: end.over_quasi_static),
    "slack": ("s", "slack", lambda end: end.slack),
}


class Run(NamedTuple):
    """name : name of the line; line : DynamicLine; course : Course; result : `mooring.lines.dynamics.run.Result`

    found : Figures; strength : Strength
    """

    name: str
    line: object
    course: object
    result: object
    found: Figures
    strength: object


def line_dynamics(
    study: File | Tables | LineDynamicsStudy,
    *,
    duration: float | None = None,
    tolerance: float | None = None,
    progress: Callable[[float], Callable[[float], None]] | None = None,
) -> Result:
    """Tensions, slack and work of one mooring line whose fairlead moves.

    study : path of a study, its tables as a dictionary, or a `pipelines.line_dynamics.study.LineDynamicsStudy`
    duration : s, tolerance : values in place of those in the study
    progress : function of the duration, s, that returns a function called with the time reached
    returns : Result, in SI; its `detail` is a Run
    raises : ValueError, with a message of one line
    """
    read, text = given(study, LineDynamicsStudy, read_line_dynamics, make_line_dynamics)
    changed = {"duration": duration, "tolerance": tolerance}
    read = msgspec.structs.replace(read, **{key: value for key, value in changed.items() if value is not None})
    folder = Path(study).parent if isinstance(study, str | os.PathLike) else Path()
    with heard() as left_out:
        if read.moordyn is not None:
            from .moordyn import with_moordyn

            read = with_moordyn(read, folder)
    run, said = _run(read, folder, progress)
    made, axes = _quantities(run)
    return Result(
        "line-dynamics", made, axes, (*said, *findings(run.found, run.result, run.strength, run.line)),
        _notes(run.found), tuple(left_out), provenance(text, asked=words_of(**changed)), run,
    )  # fmt: skip


def _run(study, folder, progress):
    """Run of a study, and its warnings"""
    from hakobune.mooring.lines.dynamics.simulation import simulate

    check_finest(study)
    line, strength = line_of(study)
    course = course_of(study, folder)
    if not 0 < course.duration < np.inf:
        raise StudyError(f"duration is {course.duration:g} s; allowed: finite, above 0")
    window = course.window(study.measure_from)
    current, wave = current_of(study), wave_of(study, course.ramp or None)
    frames = frames_of(study, course)
    check_effort(study, line, course, wave, frames, len(strength.nodes(line)))
    with heard() as said:
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
            progress=None if progress is None else progress(course.duration),
            stops=window[:2],
        )
        warn_of_air(line, result)
    harmonics = 0 if study.sea else sum(any(part.amplitude) for part in study.fairlead.motions)
    found = figures(line, course, window, result, current, judged_by_regime(line, course, harmonics))
    return Run(study.name, line, course, result, found, strength), said


def _quantities(run):
    """Quantities and the labels of their axes"""
    found, course = run.found, run.course
    cycles = "" if found.cycles is None else f", {found.cycles} cycles of {course.cycle:g} s"
    made = _ends(run, f"{run.name}: tension from {found.begin:g} to {found.end:g} s{cycles}")
    made |= _work(found) | _regime(found.regime) | _nearest(run) | _steps(run)
    records, axes = _records(run)
    rows = ["done on the line", *(name.replace("_", " ") for name in LOSSES), "stored", "as force times velocity"]
    return made | records, axes | labels("end", ["fairlead", "anchor"]) | labels("work", rows)


def _ends(run, title):
    found, ends = run.found, (run.found.fairlead, run.found.anchor)
    made = {
        name: Quantity([float(of(end)) for end in ends], ("end",), unit, words, title)
        for name, (unit, words, of) in END.items()
    }
    if found.cycles is not None:
        made["slack.in_cycle"] = Quantity(made["slack"].values / found.cycles, ("end",), "s", "slack in a cycle", title)
    own = np.array([run.strength.breaking[-1], run.strength.breaking[0]])
    whole = np.array([run.result.tension_fairlead.max(), run.result.tension_anchor.max()])  # also before the cycles
    used = np.where(np.isfinite(own), whole / own, np.nan)
    table = title if np.isfinite(run.strength.weakest) else ""
    made["tension.used"] = Quantity(used, ("end",), "", "breaking load used", table, share=True)
    made["breaking_load"] = Quantity(own, ("end",), "N", "breaking load")
    window = {"begin": (found.begin, "s"), "end": (found.end, "s"), "cycles": (found.cycles or 0, "")}
    made |= {f"window.{name}": Quantity(value, (), unit, f"window, {name}") for name, (value, unit) in window.items()}
    return made


def _work(found):
    title = "work per cycle" if found.cycles else f"work in {found.end - found.begin:g} s"
    values = np.array([found.work, *(found.losses[name] for name in LOSSES), found.stored, found.of_forces])
    share = [found.share_of_work(value) for value in values]
    return {
        "work.energy": Quantity(values, ("work",), "J", "work in the window", "" if found.cycles else title),
        "work.per_cycle": Quantity(
            values / (found.cycles or 1), ("work",), "J", "work", title if found.cycles else ""
        ),
        "work.share": Quantity(share, ("work",), "", "of the work", title, share=True),
        "work.exchanged": Quantity(found.exchanged, (), "J", "work at the ends"),
    }  # fmt: skip


def _regime(found):
    if isinstance(found, str):
        return {"regime": Quantity(f"not judged, {found}", (), "", "regime")}
    given = {
        "regime": (REGIMES[int(found.regime)], "", "regime"),
        "regime.acceleration": (found.acceleration, "", "acceleration α, of g"),
        "regime.harmonic": (found.harmonic, "", "harmonic from α"),
        "regime.slack": (found.slack, "", "slack and taut from α"),
        "regime.fall": (found.fall, "", "free fall from α"),
    }
    if found.regime <= 2:
        given["regime.largest"] = (found.largest, "N", "largest tension")
    return quantities("simplified method, SR179 (1982) 3.2.1", given)


def _notes(found):
    return (f"regime: not judged, {found.regime}",) if isinstance(found.regime, str) else ()


def _nearest(run):
    """Place where the line is closest to parting"""
    used = run.strength.most_used(run.line, run.result)
    if used is None:
        return {}
    title = "utilisation where the line is nearest to breaking" if len(run.strength.breaking) > 1 else ""
    return quantities(title, {
        "nearest.used": (used.share, "%", "breaking load used"),
        "nearest.tension": (used.tension, "N", "tension"),
        "nearest.breaking_load": (used.breaking, "N", "breaking load"),
        "nearest.time": (used.time, "s", "at t"),
        "nearest.segment": (used.segment + 1, "", "segment"),
        "nearest.type": (run.strength.names[used.segment], "", "type"),
    })  # fmt: skip


def _steps(run):
    r = run.result
    known = {
        "error.elements": (r.mesh_error, "%", "of the elements"),
        "error.steps": (r.step_error, "%", "of the steps"),
    }
    counts = {"steps": (r.steps, "", "steps"), "steps.repeated": (r.rejected, "", "steps repeated")}
    return quantities("error of the largest tensions", known) | quantities("", counts)


def _records(run):
    result, line = run.result, run.line
    places = np.array([run.course.motion.at(t)[0] for t in result.time])
    made = records({
        "history.fairlead": (result.tension_fairlead, ("time",), "N", "tension at the fairlead"),
        "history.anchor": (result.tension_anchor, ("time",), "N", "tension at the anchor"),
        "history.largest": (result.largest_tension, ("time",), "N", "largest tension anywhere"),
        "fairlead.place": (places, ("time", "xyz"), "m", "place of the fairlead"),
        "line.place": (result.frames, ("frame", "node", "xyz"), "m", "places of the line"),
    })  # fmt: skip
    axes = labels("time", result.time, "s") | labels("frame", result.frame_time, "s", "time of a frame")
    axes |= labels("node", line.nodes, "m", "length from the anchor") | labels("xyz", ["x", "y", "z"])
    return made, axes
