"""`hakobune moor`: a study on a database → results file, tables on the terminal, plan of the lines."""

from hakobune.bem.database import open_database

from ..results.output import check_result, write_result
from ..results.tables import printed
from .result import moor as found


def moor(study, database, output=None):
    """Run the study of a TOML file on a database, print it, write it; returns the exit status.

    With `output` the results are written there (HDF5 or CSV), with a plan of the lines beside it (…_plan.png).
    raises : ValueError, one line, before anything is written
    """
    check_result(output, "moor", [study, database])
    db = open_database(database)
    result = found(study, db)
    written = [] if output is None else _written(result, db, output)
    status = printed(result)
    if written:
        print(f"written: {', '.join(written)}")
    return status


def _written(result, db, output):
    """Names of the files"""
    from .plan_picture import draw_plan

    made, _ = result.detail
    plan = output.with_name(output.stem + "_plan.png")
    write_result(result, output)
    draw_plan(made, db, plan)
    return str(output), plan.name
