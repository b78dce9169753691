"""Reading of the result of any study from its file."""

from __future__ import annotations

from pathlib import Path

from .results.given import File
from .results.result import Result


def read(path: File) -> Result:
    """The Result in a file, also for simulations and sweeps, whose files are filled step by step.  Raises
    DatabaseError."""
    from .results import file
    from .simulate.file import is_run
    from .sweep.file import is_sweep, result_of

    if is_run(path):
        from .simulate.result import read_run

        return read_run(path)
    if is_sweep(Path(path)):
        return result_of(path)
    return file.read(path)
