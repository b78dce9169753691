"""`hakobune.moor`: a mooring study on a database by the simplified method, and the study's results."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from hakobune.mooring.criteria.anchors import anchor_findings
from hakobune.mooring.response.points import middles, of_station
from hakobune.mooring.studies.multi_point import PLANE, line_ends, multi_point

from ..common.quantities import StudyError
from ..common.quay_tables import linked
from ..results.given import File, Tables, database_of, given
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .anchors import quantities_of_anchors
from .notes import notes, resonant
from .study import Study, make_study, read_study

if TYPE_CHECKING:
    from hakobune.bem.database import Database

LOADS, PERIODS, LINES = "steady forces", "natural periods", "lines, tension at the fairlead"
CONTACTS, HINGES = (
    "fenders and ropes, deflection or elongation",
    ("forces and moments of hinges, in the axes of their first body"),
)
BENT = "bodies that bend: shapes, and beams in the middle, without waves"
FREE, DRIFT, PLACE = "free motions, largest expected amplitude", "mean drift of the waves", "equilibrium"
FORCE_UNITS = ("N", "N", "N", "N m", "N m", "N m")
MOTION_UNITS = ("m", "m", "m", "rad", "rad", "rad")
WORDS = {"irregular": "irregular waves", "regular_wave": "regular wave of significant height"}
UNUSED = "not used: "
OF_RUNS = (
    "not used: simulation.damping_ratio and linear_damping, which damp runs of simulate alone; [viscous] of the scene "
    "damps both"
)
FORCES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
LINE = {  # name: (unit, description, table, of a MultiPoint)
    "tension.at_rest": ("N", "at rest", LINES, lambda r: r.rest.lines.tension_b),
    "tension.steady": ("N", "steady", LINES, lambda r: r.equilibrium.lines.tension_b),
    "tension.largest": ("N", "largest", LINES, lambda r: r.tension),
    "tension.used": ("", "used", LINES, lambda r: r.utilisation),
    "tension.horizontal_at_rest": ("N", "horizontal tension at rest", "", lambda r: r.rest.lines.horizontal_b),
    "anchor.largest_vertical": ("N", "largest lift", "anchors and bed", lambda r: -r.extreme.vertical_a),
    "anchor.largest_horizontal": (
        "N", "largest horizontal", "anchors and bed", lambda r: r.extreme.horizontal_a
    ),
    "grounded.at_rest": ("m", "on the bed at rest", "anchors and bed", lambda r: r.rest.lines.grounded_length),
    "grounded.at_largest": ("m", "on the bed at the largest", "anchors and bed", lambda r: r.extreme.grounded_length),
    "fairlead.outward": ("m", "fairlead outward", "", lambda r: r.outward),
    "fairlead.upward": ("m", "fairlead upward", "", lambda r: r.upward),
    "line.breaking_load": ("N", "breaking load", "", lambda r: r.system.breaking_load),
    "line.length": ("m", "length", "", lambda r: [line.length for line in r.system.lines]),
}  # fmt: skip


def moor(study: File | Tables | Study, database: File | Database) -> Result:
    """Equilibrium, natural periods and line tensions of a moored body, or of several bodies that are moored together.

    study : path of a mooring study, its tables as a dictionary, or a `pipelines.moor.study.Study`
    database : path of the body's database, or an open one
    returns : Result, in SI; its `detail` is a `mooring.studies.multi_point.MultiPoint` and the hull
    raises : ValueError, with a message of one line
    """
    read, text = given(study, Study, read_study, make_study)
    db = database_of(database)
    made, hull = studied(read, db)
    return result_of(made, hull, text, db, read.remarks(hull, db), read.anchors_on(made.system.line_names))


def studied(study, db):
    """The MultiPoint result of a Study on an open database, and its hull.  Raises ValueError, with a message of one
    line."""
    if not db.bodies or study.quay is not None:
        study.without_berth("moor of one body")
    hull = study.hulls_of(db)
    system = study.system_of(db, hull)
    if system is None:
        raise StudyError("the study has no lines; give at least one [[spreads]] or [[lines]], or use hakobune simulate")
    anchors = study.anchors_on(system.line_names)
    berth, body = study.berth_of(db, hull) if db.bodies else None, linked(db.bodies_reader, study.hinges, db)
    conditions, of_seas = study.conditions_and_warnings()
    damped = study.simulation is not None and (study.simulation.damping_ratio or study.simulation.linear_damping)
    of_seas = (*of_seas, *((OF_RUNS,) if damped else ()))
    result = multi_point(db, system, hull, conditions, study.allowable, berth, body)
    found = anchor_findings(system.line_names, anchors, *_at_anchors(result))
    return replace(result, warnings=(*study.remarks(hull, db), *of_seas, *result.warnings, *found)), hull


def _at_anchors(made):
    """Largest pulls along the bed and up, N; shape (n,)"""
    return made.extreme.horizontal_a, -made.extreme.vertical_a


def result_of(made, hull, text, db, first=(), anchors=()):
    """Result of a MultiPoint and its hull or hulls

    text : text of its study; db : database of the body; first : findings printed first
    anchors : anchors of its lines, from `Study.anchors_on`
    """
    names = [body.name for body in db.bodies if not body.fixed]
    of_each = partial(_of_each, names)
    reader, shapes = db.bodies_reader, tuple("rad" if mode.turns else "m" for mode in db.modes)
    waves = _waves(made, shapes)
    quantities = {**_steady(made), **_periods(made), **_lines(made), **_held(made), **waves, **_place(made)}
    quantities |= quantities_of_anchors(anchors, *_at_anchors(made))
    bending, told = _bent(made, reader, shapes)
    quantities |= bending
    words = dict(zip(db.bodies_reader.names, db.bodies_reader.words, strict=True))
    axes = labels("mode", [words[name] for name in made.at_rest.names]) | labels("line", made.system.line_names)
    axes |= labels("load", of_each([*made.loads, "sum"])) | labels("motion", db.bodies_reader.words)
    axes |= labels("force", of_each(FORCES)) | labels("plane", of_each(["x", "y", "yaw"]))
    axes |= labels("xyz", ["x", "y", "z"]) | labels("body", names) | labels("contact", made.berth.names)
    forces = [f"{word} {axis}" for word in ("force", "moment") for axis in "xyz"]
    axes |= labels("bend", told)
    axes |= labels("hinge", [f"{hinge} {force}" for hinge in made.hinges for force in forces])
    used = {axis for one in quantities.values() for axis in one.axes}
    return Result(
        "moor",
        quantities,
        {axis: one for axis, one in axes.items() if axis in used},
        tuple(line for line in made.warnings if line not in first),
        (*notes(made), *resonant(made, db)),
        tuple(first),
        provenance(text, db),
        (made, hull),
    )


def _of_each(bodies, words):
    """Words; with several bodies those of each after its name"""
    return [f"{body} {word}" for body in bodies for word in words] or list(words)


def _steady(made):
    """Rows of loads; with several bodies one body after another"""
    loads = np.array([*made.loads.values(), made.steady_force])
    loads = loads.reshape(len(loads), -1, 6).swapaxes(0, 1).reshape(-1, 6)
    return {
        f"load.{name}": Quantity(loads[:, k], ("load",), unit, name, LOADS if name != "Fz" else "")
        for k, (name, unit) in enumerate(zip(FORCES, FORCE_UNITS, strict=True))
    }


def _periods(made):
    found = {}
    for name, words, state in (
        ("at_rest", "at rest", made.at_rest), ("under_loads", "under steady forces", made.at_equilibrium)
    ):  # fmt: skip
        found[f"period.{name}"] = Quantity(state.period, ("mode",), "s", words, PERIODS)
        found[f"mode_shape.{name}"] = Quantity(
            state.shapes, ("mode", "motion"), "", f"rotations times {state.scale:.6g} m, {words}"
        )
    return found


def _lines(made):
    found = {
        name: Quantity(np.asarray(of(made), float), ("line",), unit, words, table, name == "tension.used")
        for name, (unit, words, table, of) in LINE.items()
    }
    for name, ends in zip(("anchor", "fairlead"), line_ends(made.rest), strict=True):
        found[f"{name}.place"] = Quantity(ends, ("line", "xyz"), "m", f"position of the {name} at rest")
    return found


def _bent(made, reader, shapes):
    """Amplitudes of shapes, deflections and loads in the middle of beams, at rest and under the steady forces, and
    their names"""
    if made.bent is None:
        return {}, ()
    motions = np.concatenate([np.zeros((2, reader.rigid)), made.bent], axis=1)
    rows = [(f"{one.name} {word}", unit, part) for one in middles(reader) for word, unit, part in of_station(
        reader, motions, one)]  # fmt: skip
    names = (*reader.words[reader.rigid :], *(name for name, _, _ in rows))
    units = (*shapes, *(unit for _, unit, _ in rows))
    values = np.column_stack([made.bent, *(part for _, _, part in rows)])
    states = zip(("at_rest", "steady"), ("at rest", "steady"), values, strict=True)
    return {f"bend.{name}": Quantity(row, ("bend",), units, words, BENT) for name, words, row in states}, names


def _held(made):
    """Forces of fenders, ropes and hinges, at rest and under the steady forces"""
    found = {}
    for i, (name, words) in enumerate((("at_rest", "at rest"), ("steady", "steady"))):
        if made.berth.names:
            depth, force = made.contact[i]
            found[f"contact.{name}"] = Quantity(np.maximum(depth, 0.0), ("contact",), "m", words, CONTACTS)
            found[f"contact.force_{name}"] = Quantity(force, ("contact",), "N", f"force {words}", CONTACTS)
    for i, (name, words) in enumerate((("at_rest", "at rest"), ("steady", "steady"), ("largest", "largest"))):
        if len(made.held[i]):
            units = ("N", "N", "N", "N m", "N m", "N m") * len(made.held[i])
            found[f"hinge.{name}"] = Quantity(made.held[i].ravel(), ("hinge",), units, words, HINGES)
    return found


def _waves(made, shapes=()):
    """Motions and drift in waves; shapes : units of the shapes of bodies that bend, whose motions come last"""
    count = (len(made.amplitudes) - len(shapes)) // 6
    units = (*MOTION_UNITS * count, *shapes)
    found = {"motion.amplitude": Quantity(made.amplitudes, ("motion",), units, "amplitude applied to the lines")}
    for method, effects in made.waves.items():
        words = ("" if method == made.conditions.method else UNUSED) + WORDS[method]
        found[f"free_motion.{method}"] = Quantity(effects.amplitudes, ("motion",), units, words, FREE)
        drift = (("plane",), ("N", "N", "N m") * count)
        found[f"drift.{method}"] = Quantity(effects.drift, *drift, words, DRIFT)
        if effects.by_current is not None:
            found[f"drift_by_current.{method}"] = Quantity(
                effects.by_current, *drift, f"part of it due to the current, {WORDS[method]}", DRIFT
            )
    return found


def _place(made):
    count = len(made.displacement) // 3
    x, y, yaw = made.displacement.reshape(count, 3).T
    roll, pitch = made.heel.reshape(count, 2).T
    rows = {
        "pose.x": (x, "m", "x of the rotation centre"),
        "pose.y": (y, "m", "y of the rotation centre"),
        "pose.yaw": (yaw, "rad", "yaw"),
        "pose.roll": (roll, "rad", "roll"),
        "pose.pitch": (pitch, "rad", "pitch"),
    }
    found = {
        name: Quantity(values if count > 1 else float(values[0]), ("body",) * (count > 1), unit, words, PLACE)
        for name, (values, unit, words) in rows.items()
    }
    found["allowable"] = Quantity(float(made.allowable), (), "", "allowable share of the breaking load", PLACE, True)
    found["motion_factor"] = Quantity(float(made.conditions.motion_factor), (), "", "factor on the motions")
    if made.bent is None:
        found["stiffness"] = Quantity(
            made.equilibrium.stiffness, ("force", "motion"), "N/m, N/rad; N m/m, N m/rad", "stiffness of the lines"
        )
    found["residual"] = Quantity(
        made.equilibrium.residual[: 6 * count].reshape(count, 6)[:, PLANE].ravel(), ("plane",),
        ("N", "N", "N m") * count, "of the equilibrium",
    )  # fmt: skip
    return found
