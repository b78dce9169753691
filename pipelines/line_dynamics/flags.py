"""The flags of `hakobune line-dynamics`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def line_dynamics(
    study: Annotated[Path, Parameter(help="a line in motion (TOML)")],
    /,
    *,
    duration: Annotated[float | None, Parameter(help="s, in place of the study's")] = None,
    tolerance: Annotated[float | None, Parameter(help="error of a time step over the largest tension")] = None,
    output: Annotated[Path | None, Parameter(help="time series and frames, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="tensions and shapes: .png, .svg or .pdf")] = None,
):
    """Compute tension, slack and work of one mooring line whose fairlead moves, beside its quasi-static tension."""
    from .command import line_dynamics_command

    return line_dynamics_command(study, duration, tolerance, output, plot)
