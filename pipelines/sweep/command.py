"""The flags of `hakobune sweep`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def sweep(
    study: Path,
    /,
    *,
    output: Annotated[Path | None, Parameter(help="one file of all cases, .h5 [beside the sweep]")] = None,
    executor: Annotated[str, Parameter(help="local or processes:N")] = "local",
    fresh: Annotated[bool, Parameter(help="replace what is there", negative="")] = False,
):
    """Run many cases of a study over its keys; a second call takes up where the first stopped.

    hakobune new sweep
    """
    import sys

    from ..common.outputs import DATABASE, check_output
    from ..solve.work import executor_of
    from .file import is_sweep
    from .run import sweep
    from .study import read_sweep

    output = study.with_suffix(".h5") if output is None else output
    check_output(output, "the result of a sweep", is_sweep, DATABASE, [study])
    table, text = read_sweep(study)
    if fresh:
        output.unlink(missing_ok=True)
    workers = executor_of(executor)
    try:
        count, failed = sweep(table, text, study.parent, output, workers, lambda line: print(line, file=sys.stderr))
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    print(f"{output}: {count} cases, {len(failed)} of them with a status above 0")
    for number, status, message in failed[:5]:
        print(f"  case {number}: status {status}; {message}")
    return int(bool(failed))
