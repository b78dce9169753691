"""`hakobune.earthquake`: reactions of dolphins by each method, the normalised reaction, the course in time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hakobune.mooring.dolphins.methods import GRAVITY, failures, methods, stiffnesses, untouched

from ..results.given import File, Tables, given
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels
from .study import EarthquakeStudy, make_study, quake_of, read_study

if TYPE_CHECKING:
    from hakobune.bem.database import Database

PERIODS = (0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0)  # s, of the normalised reactions


def earthquake(study: File | Tables | EarthquakeStudy, database: File | Database | None = None) -> Result:
    """Reaction of the fenders of a floating body when the ground under its dolphins moves.

    study : path of an earthquake study, its tables as a dictionary, or a `study.EarthquakeStudy`
    database : path of the body's database, or an open one, in place of [body]
    returns : Result, in SI; its `detail` is the `mooring.dolphins.methods.Quake`
    raises : ValueError, with a message of one line
    """
    study, text = given(study, EarthquakeStudy, read_study, make_study)
    quake = quake_of(study, database=database)
    rows, run = methods(quake)
    springs = stiffnesses(quake, rows)
    axes = labels("method", [row.name for row in rows]) | labels("stiffness", list(springs))
    axes |= labels("ground_period", PERIODS, "s")
    found = {**_of_body(quake), **_by_method(quake, rows), **_springs(quake, springs)}
    if run is not None:
        found |= _in_time(quake, run)
        axes |= labels("time", run.time, "s")
    note = (
        "normalised reaction: reaction of the springs over ω² y M, with ω and displacement y of the ground; it is 1 "
        "for the seismic coefficient"
    )
    return Result(
        "earthquake", found, axes, tuple(failures(quake, rows)), (note, *untouched(quake, rows)),
        provenance=provenance(text, database), detail=quake,
    )  # fmt: skip


def _of_body(quake):
    fenders = quake.fenders
    return quantities(f"body between {fenders.fender.name} on each side", {
        "motion": (quake.motion, "", "motion"),
        "body.mass": (quake.floater.mass, "kg", "mass of the body"),
        "fenders.count": (fenders.count, "", "fenders on each side"),
        "fenders.clearance": (fenders.clearance, "m", "clearance on each side"),
    })  # fmt: skip


def _by_method(quake, rows):
    fender, column = quake.fenders.fender, {key: np.array([getattr(row, key) for row in rows]) for key in
                                            ("period", "ratio", "acceleration", "reaction", "deflection")}  # fmt: skip
    strain = [fender.own(x) / fender.height if np.isfinite(x) else np.nan for x in column["deflection"]]
    return quantities("largest reaction of the dolphins of one side", {
        "method.period": (column["period"], "s", "period"),
        "method.damping": (column["ratio"], "%", "damping"),
        "method.acceleration": (column["acceleration"], "m/s2", "acceleration"),
        "method.reaction": (column["reaction"], "N", "reaction"),
        "method.over_weight": (column["reaction"] / (quake.floater.mass * GRAVITY), "", "over weight"),
        "method.deflection": (column["deflection"], "m", "deflection"),
        "method.strain": (strain, "%", "strain"),
    }, "method")  # fmt: skip


def _springs(quake, springs):
    stiffness, periods = map(np.array, zip(*springs.values(), strict=True))
    found = quantities("stiffness of the fenders of one side", {
        "stiffness.value": (stiffness, "N/m", "stiffness"),
        "stiffness.period": (periods, "s", "natural period"),
    }, "stiffness")  # fmt: skip
    ratios = np.stack([quake.normalised(PERIODS, k) for k in stiffness], axis=1)
    return found | quantities("normalised reaction", {"normalised": (ratios, "", "")}, "ground_period", "stiffness")


def _in_time(quake, run):
    ground, (first, last) = quake.ground, quake.ground.base_line
    found = quantities("record, largest", {
        "ground.largest_acceleration": (np.abs(ground.acceleration).max(), "m/s2", "acceleration of the ground"),
        "ground.largest_displacement": (np.abs(ground.displacement).max(), "m", "displacement of the ground"),
        "course.largest_displacement": (np.abs(run.body).max(), "m", "absolute displacement of the body"),
        "ground.added_first": (first, "m/s2", "correction of the first acceleration, so that the ground ends at rest"),
        "ground.added_last": (last, "m/s2", "correction of the last acceleration"),
    })  # fmt: skip
    return found | quantities("", {
        "course.ground": (ground.displacement, "m", "displacement of the ground"),
        "course.ground_acceleration": (ground.acceleration, "m/s2", "acceleration of the ground"),
        "course.body": (run.body, "m", "displacement of the body"),
        "course.deflection": (run.deflection, "m", "deflection of the fenders pressed"),
        "course.reaction": (run.reaction, "N", "reaction on the dolphins on the + side"),
    }, "time", record=True)  # fmt: skip
