"""The flags of `hakobune simulate` and `animate`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def simulate(
    study: Path,
    /,
    *,
    database: Path,
    output: Annotated[Path, Parameter(help="the file of all runs, .h5, with pictures beside it")],
    seeds: Annotated[int | None, Parameter(help="how many runs, from seed 1 on, in place of the study's")] = None,
    duration: Annotated[float | None, Parameter(help="s of a run, in place of the study's")] = None,
    fresh: Annotated[bool, Parameter(help="replace a file that is there", negative="")] = False,
    executor: Annotated[str, Parameter(help="local, processes:N, dask:N, dask://host:port, slurm:N")] = "local",
    windows: Annotated[float | None, Parameter(help="s: significant motions of the first record, one by one")] = None,
):
    """A mooring study in time: motions and tensions over seeds, beside the simplified method of `moor`.

    A second call with the same output takes up where the first stopped, or adds more seeds.
    """
    from .command import simulate

    return simulate(study, database, output, seeds, duration, fresh, executor, windows)


def animate(
    run: Path,
    /,
    *,
    output: Annotated[Path, Parameter(help="film, .gif")],
    seed: Annotated[int | None, Parameter(help="whose record is stored; the first if not given")] = None,
    start: Annotated[float | None, Parameter(help="s after the ramp; around the largest tension if not given")] = None,
    length: Annotated[float, Parameter(help="s of the run")] = 60.0,
    step: Annotated[float, Parameter(help="s between frames, of which ten are shown a second")] = 1.0,
):
    """A film of body, lines and waves from the file of a simulation."""
    from .film import animate

    frames = animate(run, output, seed, start, length, step)
    print(f"{output}: {frames} frames")
    return 0
