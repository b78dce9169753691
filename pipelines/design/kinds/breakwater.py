"""A floating breakwater: `hakobune breakwater`, each state of the project as the incident sea.

The waves of a state are the incident sea. Anchors and pretension are sized with regular waves of the largest height
in the duration, H₁/₃ √(½ ln N) for N waves of a Rayleigh distribution.  Incidence is the angle to the normal; the
water levels are those of the tide in the study.
"""

from copy import deepcopy
from pathlib import Path

import numpy as np
import tomli_w

from hakobune.meshing.whole_files import write_whole

from ...breakwater.study import read_breakwater
from ...common.quantities import StudyError
from ...common.weather.seas import SpectrumTable, spectrum_of
from .needs import Need
from .numbers import Numbers
from .stored import numbers_of

NAME, DATABASE, MOVED = "study of a breakwater", "none", False
BEHIND, SHARE = "transmitted wave height", "transmission of the sea"
ALLOWABLE, SLACK, ANCHOR = "tension / allowable tension", "slack share of the cycles", "anchor needed / provided"
LEFT_OUT = ("sea", "waves", "map", "optimisation", "measured")
SIDES = (-1, 1)  # signs of the front and the back line; waves travel to +y
PROVIDED = {"capacity_kN", "weight_kN_per_m", "spacing"}  # keys of an anchor with given capacity
HOURS = 3.0  # default duration of a sea, h
SOURCES = (
    "A tension is the pretension plus the expected largest amplitude in the sea, or the largest in time where a line "
    "goes slack. NAME.h5 contains the curves."
)
METHOD = (
    "Motions are linear and two-dimensional. A line that goes slack snaps: its tension is then the largest in "
    "time in the regular waves of the study, if that is larger. Anchors are sized for regular waves as high as "
    "the highest wave of the sea."
)


def read(path):
    """Raw tables and text of a study.  Raises StudyError."""
    import tomllib

    _, text = read_breakwater(Path(path))
    return tomllib.loads(text), text


def check(project, raw):
    """Raises StudyError for a project with requirements that a project of a breakwater does not support."""
    if project.simulation is not None:
        raise StudyError("simulation is given; a breakwater is not simulated in time")
    if project.levels:
        raise StudyError("levels are given; a breakwater takes its water levels from water.tide of its study")
    for i, state in enumerate(project.states):
        for key in ("wind", "current"):
            if getattr(state, key) is not None:
                raise StudyError(f"states[{i}].{key} is given; a breakwater is loaded by waves only")
        if state.waves is None:
            raise StudyError(f"states[{i}].waves is missing; give height and period of the sea")
        if state.waves.swell:
            raise StudyError(f"states[{i}].waves.swell is given; a breakwater is computed for one wave system only")
        if state.lines != ["intact"]:
            raise StudyError(f"states[{i}].lines is {state.lines}; allowed: intact")


def base(raw, db):
    """Tables of a study without its sea"""
    kept = {key: deepcopy(value) for key, value in raw.items() if key not in LEFT_OUT}
    return {
        **kept,
        "periods": deepcopy(raw["waves"]["periods"]),
        "duration_hours": raw.get("sea", {}).get("duration_hours", HOURS),
    }


def at(base, depth, weather):
    """Tables of a load case"""
    study, given = deepcopy(base), dict(weather["waves"])
    periods, hours = study.pop("periods"), study.pop("duration_hours")
    angle = given.pop("incidence_deg")
    if "period" in given:
        given["mean_period"] = given.pop("period")
    own = {key: value for key, value in given.items() if key in SpectrumTable.__struct_fields__}
    period = given.get("mean_period") or float(spectrum_of("waves", SpectrumTable(**own), depth).T01)
    count = max(3600.0 * hours / period, 2.0)
    highest = given["height"] * float(np.sqrt(0.5 * np.log(count)))
    sea = {"spectrum": "issc", **given, "obliquity_deg": angle, "duration_hours": hours}
    waves = {"height": highest, "periods": periods, "obliquity_deg": angle}
    return {**study, "sea": sea, "waves": waves}


def checked(study, body, folder):
    """Raises ValueError for an invalid load case."""
    from ...breakwater.build import breakwater_of
    from ...breakwater.study import make_breakwater

    breakwater_of(make_breakwater(study))


def words(_, raw):
    """The command that repeats a case, the place of its numbers, and the effects that the method neglects"""
    return "hakobune breakwater cases/NAME.toml", SOURCES, METHOD


def body(raw):
    """Words on the section"""
    section = raw["section"]
    sizes = ", ".join(f"{key} {section[key]:g} m" for key in ("beam", "height", "diameter", "draft") if key in section)
    return f"A {section['shape']}: {sizes}; per metre of its length."


def needs(raw):
    """[Need] of lines, and of anchors whose capacity is in the study"""
    lines = [Need("lines (lines)", (ALLOWABLE,))] if raw.get("lines") else []
    provided = any(PROVIDED & set(table) for table in raw.get("anchors", {}).values())
    return lines + ([Need("anchors of a known capacity (anchors)", (ANCHOR,))] if provided else [])


def finds(raw):
    """Transmitted waves, and utilisations of lines and anchors"""
    return BEHIND, SHARE, ALLOWABLE, SLACK, ANCHOR


def lost(study):
    """No line may be lost: a two-dimensional breakwater has two lines"""
    return []


def without(study, name):
    """Never called, since a breakwater has no case with a lost line"""
    raise StudyError(f"{name}: the loss of a line is not a load case of a breakwater")


def run(study, database, path, _):
    """(`Numbers`, None) of a case, computed if its file is missing or belongs to a different study"""
    return numbers_of(path, tomli_w.dumps(study), None, lambda: _found(study, path)), None


def draw(study, database, numbers, path):
    """Transmission, tensions, section and sea"""
    from ...breakwater.picture import draw as picture

    picture(path, *_solved(study).detail[:3], None)


def _solved(raw):
    from ...breakwater.result import breakwater

    return breakwater({key: value for key, value in raw.items() if key not in ("map", "measured", "optimisation")})


def _found(raw, path):
    """`Numbers`, and next to them the files of the command"""
    result = _solved(raw)
    write_whole(path.with_suffix(".toml"), tomli_w.dumps(raw))
    result.write(path)
    return _numbers(*result.detail[1:3])


def _numbers(asked, found):
    from ...breakwater.findings import failures

    held, sea = found.pretension, found.sea
    name = _curve(asked.design, sea.heights)
    parts = {BEHIND: {name: sea.heights[name]}, SHARE: {name: sea.heights[name] / sea.cells.height}}
    provided = {one.name: float(one.utilisation) for one in found.anchors if one.utilisation is not None}
    if provided:
        parts[ANCHOR] = provided
    names = () if held is None else ("front", "back")
    count, lines = len(names), asked.lines
    spacing = 0.0 if lines is None else lines.spacing
    snaps = (0.0, 0.0) if found.snapping is None else found.snapping.found.largest
    largest = np.array([] if held is None else spacing * np.maximum(sea.tension, snaps))
    if count:
        parts[SLACK] = dict(zip(names, map(float, sea.slack), strict=True))
        if lines.allowable is not None:
            parts[ALLOWABLE] = {end: float(pull / lines.allowable) for end, pull in zip(names, largest, strict=True)}
    ends = np.array([_ends(asked, side) for side in SIDES[:count]]).reshape(count, 2, 3)
    along, up = (np.cos(asked.angle), np.sin(asked.angle)) if count else (0.0, 0.0)
    rest = np.full(count, 0.0 if held is None else spacing * held.used)
    return Numbers(
        names=names,
        types=(("taut line",),) * count,
        fairlead=ends[:, 0],
        anchor=ends[:, 1],
        length=np.full(count, asked.line if count else 0.0),
        pretension=rest,
        static=rest,
        largest=largest,
        breaking=np.full(count, np.inf),
        horizontal=largest * abs(along),
        uplift=largest * up,
        place=np.full(3, np.nan),
        motions=np.zeros(0),
        parts=parts,
        warnings=(*found.warned, *failures(None, found)),
    )


def _curve(chosen, heights):
    """Name of the curve of (holding, theory) for the tensions, the first if no sea is given"""
    holding, theory = chosen
    known = [name for name in heights if name == holding or (holding in name and theory in name)]
    return (known or list(heights))[0]


def _ends(asked, side):
    """Upper and lower end, (x, y, z) m, of the line of one side"""
    lines = asked.lines
    y, z = side * lines.attachment, lines.attachment_height - asked.section.draft
    way = asked.line * np.array([side * np.cos(asked.angle), -np.sin(asked.angle)])
    return [[0.0, y, z], [0.0, y + way[0], z + way[1]]]
