"""`hakobune moor`: a study on a database → results file, tables on the terminal, plan of the lines."""

from __future__ import annotations

from dataclasses import replace

from hakobune.bem.database import open_database
from hakobune.mooring.studies.multi_point import multi_point

from ..results.output import check_result, write_result
from ..results.tables import printed


def moor(study, database, output=None):
    """Run the study of a TOML file on a database, print it, write it; returns the exit status.

    With `output` the results are written there (HDF5 or CSV), with a plan of the lines beside it (…_plan.png).
    raises : ValueError, one line, before anything is written
    """
    from .result import moor as found

    if output is not None:
        check_result(output, "moor", [study, database])
    result = found(study, open_database(database))
    written = [] if output is None else _written(result, output)
    status = printed(result)
    if written:
        print(f"written: {', '.join(written)}")
    return status


def studied(study, db):
    """The MultiPoint result of a Study on an open database, and its hull.  Raises ValueError, one line."""
    hull = study.without_berth("moor").hull_of(db.dimensions)
    system = study.system(hull, db.rotation_center, db.density, db.gravity)
    result = multi_point(db, system, hull, study.conditions(), study.allowable)
    return replace(result, warnings=(*study.remarks(hull, db), *result.warnings)), hull


def _written(result, output):
    """Names of the files"""
    from .plan_picture import draw_plan

    made, hull = result.detail
    plan = output.with_name(output.stem + "_plan.png")
    write_result(result, output)
    draw_plan(made, hull, plan)
    return str(output), plan.name
