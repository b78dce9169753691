"""A body on a buoy or turret: `hakobune single-point`, at rest and, if the study has [slewing], in time.

The lines are laid once, in the water of the study; at another level they end at the same anchors.  Properties of the
hull in wind, current and waves (coefficients, turning tests, drift) come from the study, the weather from the project.
"""

from copy import deepcopy
from pathlib import Path

import numpy as np
import tomli_w

from hakobune.meshing.whole_files import write_whole

from ...common.quantities import StudyError, force
from ...common.weather.streams import OF_HULL, with_hull
from ...single_point.reading import read_study
from ...single_point.tables import make_study
from .needs import EXCURSION, of_lines
from .numbers import Numbers
from .stored import numbers_of

NAME, DATABASE, MOVED = "single-point study", "allowed", False
GUSTS = ("gusts", "surface_drag", "gust_height", "gust_exponent", "gust_intensity")
BELONGING = {
    "wind": (*OF_HULL, *GUSTS),
    "current": (*OF_HULL, "turning", "yaw_rate", "yaw_drag", "sway_damping", "yaw_damping", "waves"),
    "waves": ("drift_tonf_per_m2", "spectrum", "gamma", "spreading"),
}
LEFT_OUT = ("wind", "current", "waves", "maps", "site")
STABLE, SLEWING = "stable headings", "slewing amplitude"  # number; degrees, at the end of the run
SOURCES = (
    "Tensions are the largest of the run in time if the study has one, with 20 % added if the run has no slow drift; "
    "otherwise they are tensions at rest. A line's pretension is its tension with the buoy alone. "
    "Offsets are those of the buoy."
)
METHOD = (
    "Of all equilibrium headings, the one whose motion decays fastest, or grows least, is used (SR179 report, 1982, "
    "3.6). Slow wave drift is not included in a two-scale run; the tensions include the 20 % that the report adds for "
    "it."
)
STRONGEST = 1e6  # kN, of lines without a known breaking load
CLOSE = 1e-10  # relative accuracy of the anchor distance in another water depth


def read(path):
    """Raw tables and text of a study.  Raises StudyError."""
    _, raw, text = read_study(Path(path))
    return raw, text


def check(project, raw):
    """Raises StudyError for a project with requirements that a project of a single-point mooring does not support."""
    if project.simulation is not None:
        raise StudyError(
            "[simulation] is given, but a single-point study is simulated by its own [slewing]; leave it out"
        )
    if project.database_with_levels:
        raise StudyError("levels need a database for each depth; give project.scene in place of project.database")


def base(raw, db):
    """Tables of a study with a heading for each line"""
    tables = {key: deepcopy(value) for key, value in raw.items() if key not in LEFT_OUT}
    of_hull = {
        key: {name: raw[key][name] for name in names if name in raw.get(key, {})} for key, names in BELONGING.items()
    }
    mooring = tables["mooring"]
    if "headings_deg" not in mooring:
        count, first = mooring.pop("count"), mooring.pop("first_deg", 0.0)
        mooring["headings_deg"] = [first + 360.0 * i / count for i in range(count)]
    return {**tables, "allowable": 1.0, "of_hull": of_hull}  # criteria of the project limit the tension


def at(base, depth, weather):
    """Tables of a load case in `depth` m of water, with the anchors of the layout"""
    study = deepcopy(base)
    of_hull, laid = study.pop("of_hull"), study["water"]["depth"]
    if depth != laid:
        study["mooring"] = _laid_again(study, depth)
        study["water"] = {**study["water"], "depth": depth}
    return {**study, **{key: with_hull(table, of_hull[key]) for key, table in weather.items()}}


def checked(study, body, folder):
    """Raises ValueError for an invalid load case."""
    from ...single_point.checked import checked as check_study

    if body is not None and body.bodies:
        names = ", ".join(one.name for one in body.bodies)
        raise StudyError(
            f"{body.name} has {len(body.bodies)} bodies, {names}; allowed with a single-point study: one body; "
            "hakobune simulate takes a ship at a buoy as two bodies, with its hawser as a line between them"
        )
    check_study(make_study(study), body)


def words(_, raw):
    """The command that repeats a case, the place of its numbers, and the effects that the method neglects"""
    return "hakobune single-point cases/NAME.toml", SOURCES, METHOD


def body(raw):
    """Words on the body"""
    h = raw["hull"]
    return f"A hull of {h['length']:g} × {h['beam']:g} m, draft {h['draft']:g} m; added mass and drift of the study."


def needs(raw):
    """[Need] of the lines of the buoy and of the hawser"""
    hawsers = [of_lines("a hawser (hawser)", True)] if raw.get("hawser") else []
    return [of_lines("lines at the buoy (mooring)", False), *hawsers]


def finds(raw):
    """Headings at rest, excursion of the buoy, and slewing if the study computes it"""
    return (STABLE, SLEWING, EXCURSION) if "slewing" in raw else (STABLE, EXCURSION)


def lost(study):
    """Names of the lines by their headings, since the command renumbers the lines when a line is lost"""
    return [f"line at {heading:g}°" for heading in study["mooring"]["headings_deg"]]


def without(study, name):
    """Tables without a line"""
    study = deepcopy(study)
    del study["mooring"]["headings_deg"][lost(study).index(name)]
    return study


def run(study, database, path, _):
    """(`Numbers`, None) of a case, computed if its file is missing or belongs to a different study or database"""
    return numbers_of(path, tomli_w.dumps(study), database, lambda: _found(study, database, path)), None


def draw(study, database, numbers, path):
    """Plan of the body on its buoy"""
    from ...single_point.pictures import draw_plan

    made, point, found = _made(study, database)
    draw_plan(made, point, found, path)


def _made(raw, database):
    from hakobune.bem.database import open_database
    from hakobune.mooring.single_point.equilibria import equilibria

    from ...single_point.study import check_buoy, make

    study = make_study(raw)
    made = make(study, None if database is None else open_database(database))
    found = equilibria(made.point)
    for one in found:
        check_buoy(made, one)
    return study, made.point, found


def _found(raw, database, path):
    """`Numbers`, and next to them the files of the command"""
    from ...single_point.result import single_point

    result = single_point({key: value for key, value in raw.items() if key != "maps"}, database)
    found = result.detail
    write_whole(path.with_suffix(".toml"), tomli_w.dumps(raw))
    result.write(path)
    names = [] if found.study.hawser is None else [*(f"hawser {i + 1}" for i in range(len(found.best.hawser)))]
    stable = sum(one.slewing.stable for one in found.rest)
    parts = found.study, found.best, stable, found.cycle, found.run
    return _numbers(*parts, names, lost(raw), (*result.told, *result.notes))


def _numbers(study, best, stable, cycle, ran, hawsers, line_names, warnings):
    from hakobune.mooring.single_point.in_time import pulls

    lines, system = best.lines, best.lines.system
    anchors, tops = lines.points[system.arrays.ends].swapaxes(0, 1)
    count, own = len(hawsers), ("hawser",) if hawsers else ()
    places = pulls(best, cycle, ran, study.waves is not None).values()
    hawser, largest = (np.max(part, axis=0) for part in zip(*places, strict=True))
    share = largest / np.maximum(lines.tension, 1e-300)
    load = None if study.hawser is None else force("hawser", study.hawser, "breaking_load")
    none = np.zeros(count)
    types = (study.mooring.type,) if study.mooring.type else tuple(one.type for one in study.mooring.segments)
    return Numbers(
        names=(*hawsers, *line_names),
        types=(*(own for _ in hawsers), *(types for _ in line_names)),
        fairlead=np.concatenate([np.tile([*best.buoy, 0.0], (count, 1)), tops]),
        anchor=np.concatenate([np.tile([*best.place, 0.0], (count, 1)), anchors]),
        length=np.array([*np.full(count, best.point.lengths[0]), *(line.length for line in system.lines)]),
        pretension=np.concatenate([none, _alone(best)]),
        static=np.concatenate([best.hawser[:count], lines.tension]),
        largest=np.concatenate([hawser[:count], largest]),
        breaking=np.concatenate([np.full(count, np.inf if load is None else load), system.breaking_load]),
        horizontal=np.concatenate([none, share * lines.lines.horizontal_a]),
        uplift=np.concatenate([none, share * -lines.lines.vertical_a]),
        place=np.array([*(best.buoy - best.point.origin), np.arctan2(np.sin(best.heading), np.cos(best.heading))]),
        motions=np.zeros(0),
        parts={STABLE: {"at rest": float(stable)}, EXCURSION: {"buoy": _farthest(best, ran)}}
        | ({} if ran is None else {SLEWING: {"heading": float(np.degrees(ran.cycle.amplitude))}}),
        hawsers=tuple(hawsers),
        warnings=warnings,
    )


def _farthest(best, ran):
    """m, of the buoy from its place without the hull: under steady loads, and in the run"""
    from hakobune.mooring.single_point.history import watch_circle

    places = [best.buoy[None, :2], *([] if ran is None else [ran.record.buoy])]
    return watch_circle(np.concatenate(places), best.point.origin)


def _alone(best):
    """Tensions without a pull on the buoy, N; shape (n,)"""
    from hakobune.mooring.lines.system.equilibrium import rest

    return rest(best.point.system).lines.tension_b


def _laid_again(study, depth):
    """The table of the lines with the pretension for which they end at the same anchors in other water"""
    from scipy.optimize import brentq

    own = study["mooring"]
    keep = {key: value for key, value in own.items() if not key.startswith(("pretension", "top_tension"))}
    laid = _laid(study, own, study["water"]["depth"])
    wanted, strength = _away(laid), min(float(laid.breaking_load.min()) / 1e3, STRONGEST)

    def table(kN):
        return {**keep, "pretension_kN": kN}

    def missed(log):
        return _away(_laid(study, table(float(np.exp(log))), depth)) / wanted - 1

    try:
        found = brentq(missed, np.log(1e-6 * strength), np.log(strength), xtol=CLOSE)
    except ValueError:
        raise StudyError(
            f"mooring: lines of {own.get('length', 0.0):g} m do not reach their anchors {wanted:.4g} m away in "
            f"{depth:g} m of water; lengthen them"
        ) from None
    return table(float(np.exp(found)))


def _laid(study, mooring, depth):
    """System of the buoy with the lines of a table"""
    from ...single_point.study import DENSITY, system_of

    return system_of(make_study({**study, "mooring": mooring}), depth, DENSITY)[0]


def _away(system):
    """m from the buoy at rest to its first anchor"""
    return float(np.hypot(*system.points[0].position[:2]))
