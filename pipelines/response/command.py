"""`hakobune response`: a body of a database in a sea or a climate → tables, CSV or HDF5, picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def response(
    study: Annotated[Path, Parameter(help="study of a sea and a body (TOML)")],
    /,
    *,
    database: Annotated[Path, Parameter(help="database of the body, .h5")],
    moored: Annotated[
        Path | None, Parameter(help="mooring study (TOML) whose lines hold the body in its wind and current")
    ] = None,
    output: Annotated[Path | None, Parameter(help=".csv or .h5")] = None,
    plot: Annotated[Path | None, Parameter(help=".png, .svg or .pdf")] = None,
):
    """Compute motions, accelerations, air gap and drift of a body in a sea state, or extremes in a climate.

    The study (TOML) has the sea or scatter diagram, and points of the body.
    """
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, write_result
    from ..results.tables import printed
    from .result import KIND
    from .result import response as found
    from .study import files_of, read_response_study

    inputs = [study, database, *([moored] if moored else [])]
    if output is not None:
        check_result(output, KIND, [*inputs, *files_of(read_response_study(study)[0], study.parent)])
    check_picture(plot, PLOTS)
    result = found(study, database, moored)
    if output is not None:
        write_result(result, output)
    if plot is not None:
        from .plot import draw

        draw(result.detail, plot)
    status = printed(result)
    written = [str(path) for path in (output, plot) if path]
    if written:
        print(f"written: {', '.join(written)}")
    return status
