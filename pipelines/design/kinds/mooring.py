"""A body on lines or at a berth, or several bodies moored to each other: `hakobune moor`, and `hakobune simulate` where
the project has [simulation].

The layout of the lines is determined once, in the water of the study.  At a higher water level, or with a lost line,
anchors, bollards and lengths are unchanged: every case gives its lines by fairlead and anchor.  Ropes of a berth are
adjusted to their pretension; a berth has no simplified method and is simulated.
"""

import hashlib
from contextlib import suppress
from copy import deepcopy
from pathlib import Path

import numpy as np
import tomli_w

from hakobune.bem import DOFS
from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.lines.system.hawser import Hawser
from hakobune.mooring.studies.conditions import afloat
from hakobune.mooring.studies.multi_point_findings import IN_TIME as FINDINGS_IN_TIME
from hakobune.mooring.studies.places import check_places

from ...common.quantities import StudyError
from ...common.weather.streams import OF_HULL, STREAMS, with_hull
from ...moor.checked import check_weather
from ...moor.study import make_study, read_raw
from .needs import COEFFICIENT, DOLPHIN, EXCURSION, GAP, HINGE_FORCE, HINGE_MOMENT, OF_FENDERS, Need, of_lines
from .numbers import Numbers, held_by_hinges, strength, types_of
from .stored import numbers_of

NAME, DATABASE, MOVED = "mooring study", "needed", True
HELD = ("lines", "rope")  # parts of the study that may be lost
STILL = ("lines", "bollard"), ("rope", "bollard"), ("fender", "position")  # places that do not rise with the water
LAYING = (
    "corner_headings_deg", "pretension_tonf", "pretension_kN", "fairlead_z", "heading_deg", "anchor", "bollard", "name",
)  # fmt: skip
SIMPLIFIED = (
    "The largest motions are those of the free body, and the lines follow them statically (SR179 report, 1982, "
    "5.1.1). Slow drift is not included. Where a natural period lies near the wave periods, give the project "
    "[simulation]."
)
BESIDE = "simplified method: "  # before findings of that method beside runs in time
IN_TIME = (
    "Tensions and motions come from simulations in time, with lines in motion of their own where dynamic_lines or "
    "its trial requires it. The simplified method gives the place under steady forces only; its findings "
    "concern that method alone."
)
AT_BERTH = (
    "Tensions, strains and motions are the largest of all simulations in time. Forces at anchors and bollards are "
    "static, at the place of the body with the largest tension. A steady strain is the largest ten-minute mean. Ropes "
    "have their pretension at every water level with the body where it is drawn. Their tension at rest differs, since "
    "at rest the ropes have moved and heeled the body against the fenders."
)
SOURCES = (
    "In its file, tensions are tension.largest, offsets are pose.x, pose.y, pose.yaw, and motions are motion.amplitude."
)
IN_TIME_SOURCES = (
    "Tensions, motions and forces at the anchor are the largest of its runs (NAME_runs.h5), kept as values.largest, "
    "motions, horizontal and uplift of NAME_runs_extremes.json; offset and yaw are under steady forces, in NAME.h5."
)
BERTH_SOURCES = "Tensions, strains and motions are in the summary of its run file; offsets are the means."
KEPT = ("hull", "hulls", "types", "anchors", "fender", "dolphin", "rope", "hinges", "harbour", "quay")


def read(path):
    """Raw tables and text of a study.  Raises StudyError."""
    raw, text = read_raw(path)
    make_study(raw)
    return raw, text


def check(project, raw):
    """Raises StudyError for a project with requirements that a project of a mooring does not support."""
    if project.database_with_levels:
        raise StudyError("levels need a database for each depth; give project.scene in place of project.database")
    made = make_study(raw)
    if made.quay is not None and not made.at_berth:
        raise StudyError(
            "the study has a quay but neither fenders nor ropes; a project allows a quay only with fenders or ropes"
        )
    if project.simulation is None and made.at_berth:
        raise StudyError(
            "the study has fenders or ropes, which are judged by simulations only; give the project [simulation] "
            "(the [simulation] of the study is not read)"
        )


def base(raw, db):
    """Tables of a study with its lines by fairlead and anchor; db : database of the water in which they are laid

    The allowable tension is part of the project's criteria; the study gives the breaking loads.
    """
    kept = {key: deepcopy(value) for key, value in raw.items() if key in KEPT}
    of_hull = {where: {key: raw[where][key] for key in OF_HULL if key in raw.get(where, {})} for where in STREAMS}
    lines = laid_lines(raw, db)
    return {**kept, "allowable": 1.0, "water": deepcopy(raw["water"]), "lines": lines, "of_hull": of_hull}


def at(base, depth, weather):
    """Tables of a load case in `depth` m of water, in which the body rises relative to bollards and fenders"""
    study, rise = {**deepcopy(base), "water": {"depth": depth}, **weather}, depth - base["water"]["depth"]
    of_hull = study.pop("of_hull")
    study |= {where: with_hull(study[where], of_hull[where]) for where in STREAMS if where in study}
    for key, place in STILL:
        for table in study.get(key, ()) if rise else ():
            if place in table and "to" not in table:  # on another body it rises with the water
                x, y, z = table[place]
                table[place] = [x, y, z - rise]
    return study


def checked(study, body, folder):
    """Raises ValueError for an invalid load case, except for lines that do not reach at its level."""
    made = make_study(study)
    hull = check_weather(made, body)
    made.berth_of(body, hull)
    for i, one in enumerate(made.hinges):
        one.link(f"hinges[{i}]", body)
    if made.simulation is not None:
        from ...simulate.study import check_run

        check_run(made, body.omega, lost({"lines": study["lines"]}), folder, body.words)


def words(project, raw):
    """The command that repeats a case, the place of its numbers, and the effects that the method neglects"""
    if make_study(raw).at_berth:
        return "hakobune simulate cases/NAME.toml --database … --output …", BERTH_SOURCES, AT_BERTH
    sources = (SOURCES, SIMPLIFIED) if project.simulation is None else (IN_TIME_SOURCES, IN_TIME)
    return "hakobune moor cases/NAME.toml --database …", *sources


def needs(raw):
    """[Need] of lines, ropes, fenders and yielding dolphins"""
    found = [of_lines(f"{what} ({table})") for what, table in (("lines", "types"), ("ropes", "rope")) if raw.get(table)]
    fenders = raw.get("fender", ())
    yielding = [one for one in (*fenders, *raw.get("dolphin", ())) if {"yield_force", "dolphin_yield"} & set(one)]
    found += [Need("fenders (fender)", OF_FENDERS)] if fenders else []
    found += [Need("hinges (hinges)", (HINGE_FORCE, HINGE_MOMENT))] if raw.get("hinges") else []
    return found + ([Need("dolphins that yield (dolphin)", (DOLPHIN,))] if fenders and yielding else [])


def finds(raw):
    """Motions, excursion, and quantities of fenders, earthquakes, hinges and hulls side by side"""
    found = *(dof.lower() for dof in DOFS), EXCURSION
    found += (*OF_FENDERS, DOLPHIN, COEFFICIENT) if raw.get("fender") else ()
    found += (HINGE_FORCE, HINGE_MOMENT) if raw.get("hinges") else ()
    named = any(table.get("body") for key in (*HELD, "spreads", "fender") for table in raw.get(key, ()))
    return (*found, GAP) if named or raw.get("hulls") else found


def lost(study):
    """Names of lines and ropes"""
    return [table["name"] for key in HELD for table in study.get(key, ())]


def without(study, name):
    """Tables without a line or rope, and without the anchor of that line alone"""
    left = deepcopy(study)
    left |= {key: [table for table in study[key] if table["name"] != name] for key in HELD if key in study}
    if "anchors" in left:
        kept = [one for one in left["anchors"] if one.get("lines") != [name]]
        left["anchors"] = [
            one | ({"lines": [line for line in one["lines"] if line != name]} if "lines" in one else {}) for one in kept
        ]
    return left


def laid_lines(raw, db):
    """Raw tables of the lines of a study, each with name, fairlead and anchor"""
    typed = make_study(raw)
    hull = typed.hulls_of(db)
    system = typed.system_of(db, hull)
    if system is None:
        return []
    hulls = afloat(db, hull, system.bodies[0].name)
    check_places(system, hulls)
    points, centers = {point.name: point for point in system.points}, {one.name: one.rotation_center for one in hulls}
    laid = []
    for line, table in zip(system.lines, line_tables(raw), strict=True):
        fairlead = centers[points[line.b].body] + points[line.b].position
        rest = {key: value for key, value in table.items() if key not in LAYING and key != "fairlead"}
        end = "bollard" if "bollard" in table else "anchor"
        place = [float(x) for x in table.get("bollard", points[line.a].position[:2])]
        length = {"length": line.length} if isinstance(line, Hawser) else {}
        laid.append({"name": line.name, "fairlead": fairlead.tolist(), end: place, **rest, **length})
    return laid


def run(study, database, path, factors):
    """`Numbers` of a case, computed if its file is missing or of another study or database, and those of its runs in
    time, or None.

    database : path of the database; path : that of the result; factors : factors of motions in time
    """
    from .in_time import simulated

    runs_path = path.with_name(f"{path.stem}_runs.h5")
    if make_study(study).at_berth:
        from .berth import berth_numbers

        text = tomli_w.dumps(study)
        write_study(path, text)
        runs = simulated(path.with_suffix(".toml"), database, runs_path, factors)
        made = lambda: berth_numbers(study, database, runs_path, runs)  # noqa: E731
        return numbers_of(runs_path, f"{text}# reactions", database, made), runs
    stored = _solved(study, database, path)
    if "simulation" not in study:
        return stored, None
    runs = simulated(path.with_suffix(".toml"), database, runs_path, factors)
    beside = (f"{BESIDE}{text}" for text in stored.warnings if FINDINGS_IN_TIME not in text)
    found = {"breaking": runs["breaking"], "warnings": (*runs["findings"], *beside)}
    return stored._replace(**found, parts=stored.parts | runs["parts"]), runs


def write_study(path, text):
    """Write the study of a case next to its result, unless it exists."""
    place = path.with_suffix(".toml")
    if not place.is_file() or place.read_text(encoding="utf-8") != text:
        write_whole(place, text)


def draw(study, database, numbers, path):
    """Plan of the body on its lines, or of its berth"""
    from hakobune.bem.database import open_database

    db, made = open_database(database), make_study(study)
    if made.at_berth:
        from .berth_plan import draw_berth
        from .side_plan import draw_between

        (draw_between if db.bodies else draw_berth)(made, db, numbers, path)
        return
    from ...moor.plan_picture import draw_plan
    from ...moor.result import studied

    known = np.isfinite(numbers.breaking)
    used = np.where(known, numbers.largest / numbers.breaking, np.nan)
    draw_plan(studied(made, db)[0], db, path, used)


def line_tables(raw):
    """The raw table of each line of a study"""
    given = [spread for spread in raw.get("spreads", []) for _ in range(4 * len(spread["corner_headings_deg"]))]
    return given + raw.get("lines", [])


def _solved(study, database, path):
    from hakobune.bem.database import open_database

    from ...moor.result import moor

    text = tomli_w.dumps(study)
    found = _stored(path, study, text, database)
    if found is None:
        result = moor(study, open_database(database))
        write_study(path, text)
        result.write(path)
        found = _stored(path, study, text, database)
    return found


def _stored(path, study, text, database):
    """Numbers of the result in a file for this study and database, else None"""
    from hakobune.bem.database.results import DatabaseError

    from ...results.file import read

    with suppress(DatabaseError, OSError, KeyError):
        found = read(path, "moor")
        seal = hashlib.sha256(Path(database).read_bytes()).hexdigest()
        if found.provenance["study"] != text or found.provenance["database_sha256"] != seal:
            return None
        return Numbers(
            names=tuple(found.labels["line"].values.tolist()),
            types=tuple(types_of(table) for table in line_tables(study)),
            fairlead=found["fairlead.place"],
            anchor=found["anchor.place"],
            length=found["line.length"],
            pretension=found["tension.at_rest"],
            static=found["tension.steady"],
            largest=found["tension.largest"],
            breaking=strength(found["line.breaking_load"], found["tension.largest"], found["tension.used"]),
            horizontal=found["anchor.largest_horizontal"],
            uplift=found["anchor.largest_vertical"],
            place=np.transpose([found[f"pose.{name}"] for name in ("x", "y", "yaw")]),
            motions=found["motion.amplitude"],
            parts=_of_hinges(found),
            warnings=found.told,
            bodies=tuple(found.labels["body"].values.tolist()) if "body" in found.labels else (),
        )
    return None


def _of_hinges(found):
    """{quantity: {hinge and axis: kN or kN m}} of the result of a mooring with hinges, else empty"""
    if "hinge.largest" not in found:
        return {}
    return held_by_hinges(found.labels["hinge"].values.tolist(), found["hinge.largest"])
