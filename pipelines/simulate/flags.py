"""The flags of `hakobune simulate`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def simulate(
    study: Annotated[Path, Parameter(help="mooring study with [simulation] (TOML)")],
    /,
    *,
    database: Annotated[Path, Parameter(help="database of the body, .h5")],
    output: Annotated[Path, Parameter(help="the file of all runs, .h5, with pictures beside it")],
    seeds: Annotated[int | None, Parameter(help="how many runs, from seed 1 on, in place of the study's")] = None,
    duration: Annotated[float | None, Parameter(help="s of a run, in place of the study's")] = None,
    fresh: Annotated[bool, Parameter(help="replace a file that is there", negative="")] = False,
    executor: Annotated[str, Parameter(help="local, processes:N, dask:N, dask://host:port, slurm:N")] = "local",
    windows: Annotated[float | None, Parameter(help="s: significant motions of the first record, one by one")] = None,
    methods: Annotated[
        bool, Parameter(help="the first seed with memory and with constant coefficients beside each other", negative="")
    ] = False,
    division: Annotated[
        Path | None, Parameter(help="--methods: also on the water of a box of the ship's sizes, --method contour, .h5")
    ] = None,
):
    """Run a mooring study in time: motions and tensions over seeds, beside the simplified method of `moor`.

    A second call with the same output continues where the first stopped, or adds seeds.
    """
    from .command import simulate

    return simulate(study, database, output, seeds, duration, fresh, executor, windows, methods, division)
