"""The flags of `hakobune earthquake`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def earthquake(
    study: Annotated[Path, Parameter(help="body, fenders and the earthquake (TOML)")],
    /,
    *,
    database: Annotated[
        Path | None, Parameter(help="database of the body, for its mass and the memory of the water")
    ] = None,
    output: Annotated[Path | None, Parameter(help="time series, .csv, or all results, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute the reaction of the fenders of a floating body when the ground under its dolphins moves.

    It compares the seismic coefficient of a rule, a response spectrum and a record in time, and shows the normalised
    reaction over frequency.  hakobune earthquake earthquake_box.toml --plot earthquake.png
    """
    from .command import earthquake

    return earthquake(study, database, output, plot)
