"""Load cases of a project. Each load case is a separate study that the command of its kind can also run (`kinds`)."""

import re
from copy import deepcopy
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from hakobune.bem import DOFS
from hakobune.bem.hinges import SPACE
from hakobune.mooring.criteria.verdict import HAWSER

from ..common.quantities import StudyError
from .tables import MEAN

WEATHER = ("wind", "current", "waves")
OFF = ("wind_off_deg", "current_off_deg")
MOTIONS = tuple(dof.lower() for dof in DOFS)


class LoadCase(NamedTuple):
    """study : raw tables of a study; lost : name of the lost line, "" for none; factor : factor on motions

    apart : whether the case is a different kind of study than the project's: an earthquake
    """

    name: str
    state: str
    kind: str
    level: str
    incidence: float
    wind_off: float
    current_off: float
    lost: str
    factor: float
    study: dict
    apart: bool = False

    @property
    def lines(self):
        """ "intact" or "one lost", as in criteria"""
        return "one lost" if self.lost else "intact"


def intact_cases(read, base, factors):
    """LoadCases of all states, directions and levels with every line in place.

    base : tables of the study with its layout, in the form of its kind; factors : factors on the largest motions, as
        required by criteria
    """
    for state, raw in zip(read.project.states, read.raw["states"], strict=True):
        asked = product(state.levels, state.incidence_deg, state.wind_off_deg, state.current_off_deg, factors)
        for level, incidence, wind_off, current_off, factor in asked:
            place = level, float(incidence), float(wind_off), float(current_off)
            study = _study(read, base, state, raw, *place, factor)
            name = _name(state.name, *place, "", factor)
            yield LoadCase(name, state.name, state.state, *place, "", factor, study)


def without_line(read, case, line):
    """The LoadCase without one line"""
    study = read.kind.without(case.study, line)
    place = case.level, case.incidence, case.wind_off, case.current_off
    return case._replace(name=_name(case.state, *place, line, case.factor), lost=line, study=study)


def _study(read, base, state, raw, level, incidence, wind_off, current_off, factor):
    weather = {}
    for key, off in zip(WEATHER, (wind_off, current_off, 0.0), strict=True):
        if getattr(state, key) is not None:
            weather[key] = {**raw[key], "incidence_deg": _turned(incidence + off)}
    if "waves" in weather and factor != 1:
        weather["waves"]["motion_factor"] = factor
    if read.project.simulation is not None:
        weather["simulation"] = deepcopy(read.raw["simulation"])
    return read.kind.at(base, read.study["water"]["depth"] + read.project.level(level), weather)


def _turned(degrees):
    """Within −180 and 360"""
    return degrees - 360.0 * np.ceil((degrees - 360.0) / 360.0) if degrees > 360 else degrees


def _name(state, level, incidence, wind_off, current_off, lost, factor):
    parts = [state, *([level] if level != MEAN else []), f"{incidence:g} deg"]
    parts += [f"wind {wind_off:+g}"] if wind_off else []
    parts += [f"current {current_off:+g}"] if current_off else []
    parts += [f"without {lost}"] if lost else []
    parts += [f"motions x {factor:g}"] if factor != 1 else []
    return ", ".join(parts)


def file_name(case):
    """File name of a case, without characters that file systems refuse"""
    return re.sub(r"[^A-Za-z0-9.+-]+", "_", case.name).strip("_")


def check_cases(read, scenes):
    """Raises StudyError for an invalid load case; scenes : {level: Scene}, {} without a scene

    One case is checked for all cases that differ only in the direction of wind and current.  Whether lines reach their
    anchors at another water level is a result of the case, not an error.
    """
    bodies = _bodies(read, scenes)
    _check_several(read, bodies[MEAN])
    base = read.kind.base(read.study, bodies[MEAN])
    names = read.kind.lost(base)
    if read.project.anchors is not None:
        if read.study.get("anchors"):
            raise StudyError(
                "[anchors] of the project and [[anchors]] of its study are both given; allowed: one of them"
            )
        for name in read.project.anchors.lines:
            if name not in names:
                raise StudyError(f"anchors.lines: there is no line {name!r}; allowed: {', '.join(names)}")
    states = [replace(state, **{key: getattr(state, key)[:1] for key in OFF}) for state in read.project.states]
    files = {}
    for case in intact_cases(replace(read, project=replace(read.project, states=states)), base, (1.0,)):
        other = files.setdefault(file_name(case).lower(), case.state)
        if other != case.state:
            raise StudyError(
                f"states {other!r} and {case.state!r} would write files of the same name; give each state its own name"
            )
        try:
            read.kind.checked(case.study, bodies[case.level], read.folder)
        except ValueError as error:
            raise StudyError(f"{case.name}: {error}") from None


def _check_several(read, body):
    """Raises StudyError for limits on a body that does not exist, and for water levels beside a structure that does not
    float"""
    several = () if body is None else body.bodies
    moving = [one.name for one in several if not one.fixed]
    for i, one in enumerate(read.project.limits):
        if one.subject not in ("", HAWSER, *moving):
            raise StudyError(
                f"limits[{i}].subject is {one.subject!r}; allowed: {', '.join((HAWSER, *moving))}, or left out for all "
                "others"
            )
        if one.subject in moving and one.quantity not in MOTIONS:
            raise StudyError(
                f"limits[{i}].subject is {one.subject}, a body, and quantity is {one.quantity!r}; allowed with a body: "
                f"{', '.join(MOTIONS)}"
            )
    still = [one.name for one in several if one.fixed]
    still += [table["name"] for table in read.study.get("hinges", ()) if SPACE in table.get("bodies", ())]
    if read.project.levels and still:
        raise StudyError(
            f"levels are given, but {still[0]} does not rise with the water, so that its place differs at each level; "
            "give a project for each level"
        )


def _bodies(read, scenes):
    """{level: `moor.checked.Body`}, None where the study has its own"""
    from ..moor.checked import body_of_database, body_of_scene

    own = read.project.project
    if own.database is not None:
        from hakobune.bem.database import open_database

        return {MEAN: body_of_database(open_database(Path(read.folder) / own.database))}
    if not scenes:
        return dict.fromkeys((MEAN, *read.project.levels))
    return {level: body_of_scene(own.scene, scene) for level, scene in scenes.items()}
