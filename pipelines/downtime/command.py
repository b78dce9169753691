"""`hakobune downtime`: a multi-year record → hours of downtime, weather windows; a file, pictures, a page."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def downtime(
    study: Annotated[Path, Parameter(help="downtime study (TOML); its hindcast file lies beside it")],
    /,
    *,
    database: Annotated[Path | None, Parameter(help="database of the body, .h5; not with [lee]")] = None,
    output: Annotated[Path | None, Parameter(help=".csv or .h5")] = None,
    plot: Annotated[Path | None, Parameter(help=".png, .svg or .pdf")] = None,
    states: Annotated[
        Path | None, Parameter(help="file for simulated states, .jsonl [beside the study, with [simulation]]")
    ] = None,
    executor: Annotated[
        str, Parameter(help="where states run: local, processes:N, dask:N, dask://host:port, slurm:N")
    ] = "local",
    page: Annotated[Path | None, Parameter(help=".html: tables and pictures of all results")] = None,
):
    """Compute the hours of years in which operations at a berth stop, and weather windows, from a hindcast.

    Each hour is computed by linear responses of the body. Or a moored body is simulated in states that represent
    all hours; a second call then continues where the first stopped.
    hakobune new downtime
    """
    from hakobune.meshing.whole_files import write_whole

    from ..common.outputs import check_output
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, write_result
    from ..results.tables import printed
    from .report import page_of, written_by_downtime
    from .result import KIND
    from .result import downtime as found
    from .study import files_of, read_downtime

    read, text = read_downtime(study)
    inputs = [study, *files_of(read.hindcast, study.parent), *([database] if database else [])]
    if output is not None:
        check_result(output, KIND, inputs)
    if plot is not None:
        check_picture(plot, PLOTS)
    if page is not None:
        check_output(page, "a page of downtime", written_by_downtime, (".html",), inputs)
    if states is None and read.simulation is not None:
        states = study.with_suffix(".states.jsonl")
    result = found(study, database, states=states, executor=executor, say=lambda line: print(line, file=sys.stderr))
    if output is not None:
        write_result(result, output)
    if plot is not None:
        from .pictures import draw

        draw(result, plot)
    if page is not None:
        write_whole(page, page_of(result, text).encode())
    status = printed(result)
    written = [str(path) for path in (output, plot, page) if path]
    if written:
        print(f"written: {', '.join(written)}")
    return status
