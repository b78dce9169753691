"""Load cases of a project, each a mooring study of its own that `hakobune moor` runs too.

The lines are laid once, in the water of the study.  Where the water is higher, or a line is lost, anchors and lengths
stay: every case names its lines by fairlead and anchor.
"""

from __future__ import annotations

import re
from copy import deepcopy
from itertools import product
from typing import NamedTuple

import numpy as np

from mooring.lines.system.hawser import Hawser

from ..moor.study import make_study
from .project import MEAN

LAYING = (
    "corner_headings_deg", "pretension_tonf", "pretension_kN", "fairlead_z", "heading_deg", "anchor", "bollard", "name",
)  # fmt: skip


class LoadCase(NamedTuple):
    """study : raw tables of a mooring study; lost : name of the line that is gone, "" for none; factor : of motions"""

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

    @property
    def lines(self):
        """intact or one lost, as criteria say it"""
        return "one lost" if self.lost else "intact"


def laid_lines(study, db):
    """Raw tables of the lines of a study, each with name, fairlead and anchor; `db` : of the water they are laid in"""
    typed = make_study(study).without_berth("design")
    hull = typed.hull_of(db.dimensions)
    system = typed.system(hull, db.rotation_center, db.density, db.gravity)
    points = {point.name: point for point in system.points}
    given = [spread for spread in study.get("spreads", []) for _ in range(4 * len(spread["corner_headings_deg"]))]
    given += study.get("lines", [])
    center = np.asarray(db.rotation_center, float)
    laid = []
    for line, table in zip(system.lines, given, strict=True):
        fairlead = center + points[line.b].position
        rest = {key: value for key, value in table.items() if key not in LAYING and key != "fairlead"}
        end = "bollard" if "bollard" in table else "anchor"
        place = [float(x) for x in points[line.a].position[: 3 if end == "bollard" else 2]]
        length = {"length": line.length} if isinstance(line, Hawser) else {}
        laid.append({"name": line.name, "fairlead": fairlead.tolist(), end: place, **rest, **length})
    return laid


def intact_cases(read, lines, factors):
    """LoadCases of all states, directions and levels with every line in place.

    lines : of `laid_lines`; factors : of the largest motions that the criteria ask for
    """
    for state, raw in zip(read.project.states, read.raw["states"], strict=True):
        asked = product(state.levels, state.incidence_deg, state.wind_off_deg, state.current_off_deg, factors)
        for level, incidence, wind_off, current_off, factor in asked:
            place = level, float(incidence), float(wind_off), float(current_off)
            study = _study(read, lines, state, raw, *place, factor)
            name = _name(state.name, *place, "", factor)
            yield LoadCase(name, state.name, state.state, *place, "", factor, study)


def without_line(case, line):
    """The LoadCase without one line"""
    study = deepcopy(case.study)
    study["lines"] = [table for table in study["lines"] if table["name"] != line]
    place = case.level, case.incidence, case.wind_off, case.current_off
    return case._replace(name=_name(case.state, *place, line, case.factor), lost=line, study=study)


def _study(read, lines, state, raw, level, incidence, wind_off, current_off, factor):
    tables = {key: deepcopy(value) for key, value in read.study.items() if key in ("hull", "types", "allowable")}
    tables["water"] = {"depth": read.study["water"]["depth"] + read.project.level(level)}
    tables["lines"] = deepcopy(lines)
    if read.project.simulation is not None:
        tables["simulation"] = deepcopy(read.raw["simulation"])
    for key, off in (("wind", wind_off), ("current", current_off), ("waves", 0.0)):
        if getattr(state, key) is not None:
            tables[key] = {**raw[key], "incidence_deg": _turned(incidence + off)}
    if "waves" in tables and factor != 1:
        tables["waves"]["motion_factor"] = factor
    return tables


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
    """A name for the files of a case, without what file systems do not take"""
    return re.sub(r"[^A-Za-z0-9.+-]+", "_", case.name).strip("_")
