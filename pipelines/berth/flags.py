"""The flags of `hakobune berth`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def berth(
    study: Annotated[Path | None, Parameter(help="ship, approach and fenders (TOML)")] = None,
    /,
    *,
    database: Annotated[Path | None, Parameter(help="database of the ship, for the memory of the water")] = None,
    output: Annotated[Path | None, Parameter(help="time series, .csv, or all results, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
    measured: Annotated[
        bool,
        Parameter(negative=(), help="instead of a study: compare with the fifty measured berthings of Ueda (1981)"),
    ] = False,
):
    """Compute the energy of a berthing ship, the reaction of its fenders, and its course in time.

    hakobune berth berth_tanker.toml --plot berth.png
    """
    from .command import berth, show_measured

    if measured == (study is not None):
        raise ValueError(f"a study and --measured: {'both are' if measured else 'neither is'} given; give one of them")
    if measured:
        given = [name for name, value in (("database", database), ("output", output), ("plot", plot)) if value]
        if given:
            raise ValueError(f"--{given[0]} is given with --measured; it needs a study")
        return show_measured()
    return berth(study, database, output, plot)
