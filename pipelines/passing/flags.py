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
    """Compute the forces on a moored ship while another ship passes on a parallel track.

    Both hulls are solved by panels in water of any depth, with or without a wall.  The study may select the faster
    methods of Wang (1975) or Kriebel (2005).
    hakobune passing passing_tanker.toml --plot passing.png --forces passing.csv
    """
    from .command import passing

    return passing(study, forces, output, plot)
