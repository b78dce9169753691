"""`hakobune sweep`: its file, its executor, and what is said at the end."""

from __future__ import annotations

import sys

from hakobune.mooring.criteria.failing import fails

from ..common.outputs import DATABASE, check_output
from ..executors.choice import executor_of
from ..printing.verdict import tell
from . import run
from .file import is_sweep
from .study import read_sweep

SHOWN = 5  # cases that are named


def sweep(study, output, executor, fresh, main):
    """Run what is pending; 1 where a case has a status above 0.  main : the command line as a function of its words"""
    output = study.with_suffix(".h5") if output is None else output
    check_output(output, "the result of a sweep", is_sweep, DATABASE, [study])
    table, text = read_sweep(study)
    if fresh:
        output.unlink(missing_ok=True)
    workers = executor_of(executor)
    try:
        outcome = run.sweep(table, text, study.parent, output, workers, main, lambda line: print(line, file=sys.stderr))
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    failed, (lost, reason) = outcome.failed, outcome.lost
    print(f"{output}: {outcome.cases} cases, {len(failed)} of them with a status above 0")
    lines = [fails(f"case {number}: status {status}; {message}") for number, status, message in failed[:SHOWN]]
    if len(failed) > SHOWN:
        lines.append(fails(f"{len(failed) - SHOWN} more cases have a status above 0; {output} has their messages"))
    if lost:
        lines.append(fails(f"{lost} cases were not done, {reason}; run the same command to go on"))
    return tell(lines)
