"""`hakobune design`: databases, load cases, verdict and report of a project, in a folder; completes an earlier run."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def design(
    project: Annotated[Path, Parameter(help="project (TOML)")],
    /,
    *,
    output: Annotated[Path, Parameter(help="folder for the report, its load cases and databases")],
    executor: Annotated[str, Parameter(help="local or processes:N")] = "local",
    advice: Annotated[
        bool, Parameter(help="try other sizes, pretensions and numbers of lines where the design fails")
    ] = True,
):
    """Run a mooring through all load cases of a site, judge the mooring by rule sets, and write one page.

    Status 1 if a criterion is not met or not judged, a line parts, or a case could not be run.
    """
    from ..printing.console import new_console
    from ..results.tables import printed
    from .result import design as found

    console = new_console()
    result = found(project, output, executor=executor, advice=advice, console=console)
    status = printed(result, console)
    words = ", ".join(str(output / name) for name in result.detail[1])
    console.print(f"written: {words}", highlight=False, markup=False, soft_wrap=True)
    return status
