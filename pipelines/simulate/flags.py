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
    pictures: Annotated[bool, Parameter(help="draw pictures beside the file")] = True,
    seeds: Annotated[int | None, Parameter(help="number of runs, from seed 1 on, in place of the study's")] = None,
    duration: Annotated[float | None, Parameter(help="duration of a run, s, in place of the study's")] = None,
    fresh: Annotated[bool, Parameter(help="replace an existing file", negative="")] = False,
    executor: Annotated[
        str, Parameter(help="where seeds run: local, processes:N, dask:N, dask://host:port, slurm:N")
    ] = "local",
    windows: Annotated[
        float | None, Parameter(help="length of windows, s: significant motions in each window of the first record")
    ] = None,
    methods: Annotated[
        bool, Parameter(help="compare the first seed with memory and with constant coefficients", negative="")
    ] = False,
    division: Annotated[
        Path | None,
        Parameter(help="with --methods: database of a box of the ship's dimensions, solved with --method contour, .h5"),
    ] = None,
):
    """Run a mooring study in time: motions and tensions over seeds, compared with the simplified method of `moor`.

    A second call with the same output continues where the first stopped, or adds seeds.
    """
    from ..executors.beside import begin_beside

    begin_beside("simulate", "mooring/motion/integrator.py", study, database)
    from .command import simulate

    return simulate(study, database, output, seeds, duration, fresh, executor, windows, methods, division, pictures)
