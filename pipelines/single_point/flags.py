"""The flags of `hakobune single-point`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def single_point(
    study: Annotated[Path, Parameter(help="study of a body on a buoy or turret (TOML)")],
    /,
    *,
    database: Annotated[Path | None, Parameter(help="database of the body, for its masses and wave drift")] = None,
    output: Annotated[Path | None, Parameter(help="results, .h5 or .csv")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: plan of all equilibria, .png, .svg or .pdf")] = None,
):
    """Find all headings of rest of a body on a buoy or turret, whether it slews (fishtails), and its line loads.

    [[maps]] of the study draw the growth of slewing over its numbers; [slewing] runs it in time.
    """
    from .command import single_point_command

    return single_point_command(study, database, output, plot)
