"""A project checked on its load cases before one is solved: what no study of them could take is refused as it is read.

Cases in which wind and current alone come from elsewhere stand for one another.  Whether lines reach their anchors at
another level of the water is a result, and told of the case.
"""

from __future__ import annotations

import math
from pathlib import Path

from msgspec.structs import replace

from hakobune.mooring.criteria.strength import worn_breaking_load

from ..common.quantities import StudyError, positive
from .cases import file_name, intact_cases
from .tables import MEAN

ONE = ("wind_off_deg", "current_off_deg")  # of which one value stands for all


def check_project(project):
    """Raises StudyError for numbers that no project could have, whatever its study."""
    own = project.project
    if own.service_life is not None:
        positive("project.service_life", own.service_life)
    if own.probability is not None and not 0 < own.probability < 1:
        raise StudyError(f"project.probability is {own.probability:g}; allowed: above 0, below 1")
    for name, rise in project.levels.items():
        if not math.isfinite(rise):
            raise StudyError(f"levels.{name} is {rise:g} m; allowed: finite")
    if project.anchors is not None:
        positive("anchors.holding_kN", project.anchors.holding_kN)
        for name, holding in project.anchors.lines.items():
            positive(f"anchors.lines.{name}", holding)


def check_worn(worn):
    """Raises StudyError for wear that leaves too little of a type; worn : of `project.worn_diameters`"""
    for name, (diameter, loss) in worn.items():
        try:
            worn_breaking_load(1.0, diameter, loss, 1.0)
        except ValueError as error:
            raise StudyError(f"wear of type {name!r}: {error}") from None


def check_cases(read, scenes):
    """Raises StudyError for a load case that could not be run; scenes : {level: Scene}, {} without a scene"""
    bodies = _bodies(read, scenes)
    base = read.kind.base(read.study, bodies[MEAN])
    names = read.kind.lost(base)
    if read.project.anchors is not None:
        for name in read.project.anchors.lines:
            if name not in names:
                raise StudyError(f"anchors.lines: there is no line {name!r}; allowed: {', '.join(names)}")
    states = [replace(state, **{key: getattr(state, key)[:1] for key in ONE}) for state in read.project.states]
    files = {}
    for case in intact_cases(replace(read, project=replace(read.project, states=states)), base, (1.0,)):
        other = files.setdefault(file_name(case).lower(), case.state)
        if other != case.state:
            raise StudyError(f"states {other!r} and {case.state!r} have files of one name; allowed: each its own")
        try:
            read.kind.checked(case.study, bodies[case.level], read.folder)
        except ValueError as error:
            raise StudyError(f"{case.name}: {error}") from None


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
