"""Many cases of one study as a function."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

import tomli_w

from hakobune.bem.database.integrity import DatabaseError

from ..executors.choice import executor_of
from ..results.given import File, Tables
from ..results.result import Result
from . import run
from .file import result_of
from .study import SweepTable, read_sweep


def sweep(
    study: File | Tables,
    output: File | None = None,
    *,
    executor: str = "local",
    fresh: bool = False,
    say: Callable[[str], None] | None = None,
) -> Result:
    """Results of a study for many values of its keys, which are in the units of the study; the results are in SI.

    study : path of a sweep, or its tables as a dictionary; its `study` is the path of the varied study, or its tables
    output : path of the file of all cases, continued where it stopped; None for no file
    executor : executor as in the command; fresh : whether to replace an existing file
    say : function that is called with each line of progress
    returns : Result, in SI, with the axis "case", "keys.NAME" of each varied key, and "status", 0 where a case passes
    raises : ValueError, with a message of one line, also after the loss of a worker; finished cases are kept
    """
    with tempfile.TemporaryDirectory() as folder, in_files(study, Path(folder)) as path:
        place = Path(folder) / "sweep.h5" if output is None else Path(output)
        _, outcome = filled(path, place, executor, fresh, say or (lambda line: None))
        lost, reason = outcome.lost
        if lost:
            raise DatabaseError(f"{lost} cases were not run, {reason}; call the function again to continue")
        return result_of(place)


def filled(path: Path, output: Path, executor: str, fresh: bool, say) -> tuple[SweepTable, run.Outcome]:
    """Run the pending cases of the sweep in a file; returns the SweepTable and the outcome.  Raises StudyError."""
    table, text = read_sweep(path)
    workers = executor_of(executor)
    try:
        return table, run.sweep(table, text, path.parent, output, workers, say, fresh)
    finally:
        workers.shutdown(wait=False, cancel_futures=True)


@contextmanager
def in_files(study: File | Tables, folder: Path):
    """The path of a sweep: the given path, or a path in `folder`, to which the tables of sweep and study are
    written
    """
    if isinstance(study, str | os.PathLike):
        yield Path(study)
        return
    varied, path = study.get("study"), folder / "sweep.toml"
    if isinstance(varied, dict):
        place = folder / "study.toml"
        place.write_text(tomli_w.dumps(varied), encoding="utf-8")
    else:
        place = Path(str(varied)).absolute()
    path.write_text(tomli_w.dumps({**study, "study": str(place)}), encoding="utf-8")
    yield path
