"""`hakobune.breakwater`: transmission of a floating breakwater, tensions of its lines, sizes of its anchors."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from msgspec.structs import asdict

from hakobune.mooring.studies.breakwater.breakwater import Breakwater
from hakobune.mooring.studies.breakwater.results import Results, results

from ..common.quantities import StudyError
from ..results.given import File, Tables, database_of, given
from ..results.provenance import provenance
from ..results.result import Result
from .build import anchors_of as asked_anchors
from .build import breakwater_of, changing, ranges_of
from .findings import failures, jumps, wanted
from .measured import read_measured
from .quantities import (
    anchors_of,
    behind_in_words,
    behind_of,
    checks_of,
    curves_of,
    front_of,
    lee_of,
    natural_of,
    pretension_of,
    snapping_of,
)
from .study import BreakwaterStudy, make_breakwater, read_breakwater

if TYPE_CHECKING:
    from hakobune.bem.database import Database


class Found(NamedTuple):
    """study : BreakwaterStudy; asked : `Breakwater`; results : Results; measured : columns of `measured`, or None"""

    study: BreakwaterStudy
    asked: Breakwater
    results: Results
    measured: dict | None


def breakwater(study: File | Tables | BreakwaterStudy, database: File | Database | None = None) -> Result:
    """Waves behind a floating breakwater, the tensions and pretension of its lines over the tide, and its anchors.

    study : path of a study, its tables as a dictionary, or a `pipelines.breakwater.study.BreakwaterStudy`
    database : path of the database of a unit of finite length along x, or an open database; needed for [map]
    returns : Result, in SI; its `detail` is a Found
    raises : ValueError, with a message of one line
    """
    read, text = given(study, BreakwaterStudy, read_breakwater, make_breakwater)
    if read.map is not None and database is None:
        raise StudyError("the study has a [map]; give --database of a unit of finite length, or leave out the table")
    if read.map is None and database is not None:
        raise StudyError("the study has no [map]; add one, or leave out --database and --map-plot")
    folder = Path(study).parent if isinstance(study, str | os.PathLike) else Path()
    measured = None if read.measured is None else read_measured(folder / read.measured)
    asked = breakwater_of(read)
    db = None if database is None else database_of(database)
    return result_of(Found(read, asked, _results(read, asked, db), measured), text, db)


def _results(study, asked, db):
    found, wanted = results(asked, asked_anchors(study)), study.optimisation
    if wanted is not None:
        from hakobune.mooring.studies.breakwater.pareto import beside_resonances, front

        changed = changing(asked)
        best = front(changed, ranges_of(wanted), wanted.samples, wanted.limits)
        found = found._replace(front=best, warned=[*found.warned, *beside_resonances(changed, best)])
    if db is not None:
        from hakobune.mooring.studies.breakwater.lee import Row, lee

        around = lee(asked, Row(**asdict(study.map)), db)
        found = found._replace(lee=around, warned=[*found.warned, *around.warned])
    return found


def result_of(found, text, db=None):
    """Result of a Found; text : text of its study"""
    quantities, axes = {}, {}
    for part in (curves_of, natural_of, pretension_of, anchors_of, behind_of, snapping_of, front_of, lee_of, checks_of):
        made, labels = part(found.asked, found.results)
        quantities, axes = quantities | made, axes | labels
    optimisation, front = found.study.optimisation, found.results.front
    return Result(
        "breakwater", quantities, axes,
        (*found.results.warned, *jumps(found.asked, found.results), *failures(optimisation, found.results)),
        (
            *behind_in_words(found.results.sea, getattr(found.study.sea, "height", None)),
            *(() if front is None else wanted(optimisation, front)),
        ),
        provenance=provenance(text, db), detail=found,
    )  # fmt: skip
