"""The flags of `hakobune passing`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def passing(
    study: Annotated[Path, Parameter(help="water, moored and passing ship, track (TOML)")],
    /,
    *,
    forces: Annotated[Path | None, Parameter(help="force over time for [[simulation.force]]: .csv")] = None,
    output: Annotated[Path | None, Parameter(help="result: .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="forces along the track: .png, .svg or .pdf")] = None,
):
    """Forces on a moored ship while another ship passes it on a parallel track.

    By panels of both hulls in water of any depth, before a wall or not; by Wang (1975) and Kriebel (2005) on request.
    hakobune passing passing_tanker.toml --plot passing.png --forces passing.csv
    """
    from .command import passing

    return passing(study, forces, output, plot)
