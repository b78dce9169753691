"""`hakobune moor`: a study on a database → results file, tables on the terminal, plan of the lines."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def moor(
    study: Annotated[Path, Parameter(help="mooring study (TOML)")],
    /,
    *,
    database: Annotated[Path, Parameter(help="database of the body, .h5")],
    output: Annotated[Path | None, Parameter(help="results, .h5 or .csv, with a picture of the plan beside")] = None,
):
    """Compute equilibrium, natural periods and line tensions of a moored body, by the simplified method."""
    from hakobune.bem.database import open_database

    from ..results.output import check_result
    from ..results.tables import printed
    from .result import moor

    check_result(output, "moor", [study, database])
    db = open_database(database)
    result = moor(study, db)
    written = [] if output is None else _written(result, db, output)
    status = printed(result)
    if written:
        print(f"written: {', '.join(written)}")
    return status


def _written(result, db, output):
    """Names of the files"""
    from ..results.output import write_result
    from .plan_picture import draw_plan

    made, _ = result.detail
    plan = output.with_name(output.stem + "_plan.png")
    write_result(result, output)
    draw_plan(made, db, plan)
    return str(output), plan.name
