"""Reading the result of any study from its file."""

from __future__ import annotations

from .results.given import File
from .results.result import Result


def read(path: File) -> Result:
    """The Result in a file, also of a simulation, whose file fills run by run.  Raises DatabaseError."""
    from .results import file
    from .simulate.file import is_run

    if is_run(path):
        from .simulate.result import read_run

        return read_run(path)
    return file.read(path)
