"""`hakobune sweep`: its file, its executor, its table and picture, and its last lines."""

import sys
from dataclasses import replace

from hakobune.mooring.criteria.failing import fails

from ..common.outputs import DATABASE, check_output
from ..common.picture import PLOTS, check_picture
from ..results.tables import printed
from .file import is_sweep, result_of
from .result import filled

SHOWN = 5  # cases that are named
PRINTED = 8  # quantities of a printed table by default


def sweep(study, output, executor, fresh, plot=None):
    """Run the pending cases, print a table of all; 1 if a case has a status above 0 or was not run.

    plot : picture of the quantities over the first key
    """
    output = study.with_suffix(".h5") if output is None else output
    check_output(output, "the result of a sweep", is_sweep, DATABASE, [study])
    check_picture(plot, PLOTS)
    table, outcome = filled(study, output, executor, fresh, _say)
    result = _shown(result_of(output), table.keep)
    if plot is not None:
        from .picture import draw

        draw(result, plot)
    status = printed(replace(result, findings=tuple(_findings(outcome, output))))
    print(f"{output}: {outcome.cases} cases, of which {len(outcome.failed)} have a status above 0", file=sys.stderr)
    return status


def _say(line):
    print(line, file=sys.stderr)


def _findings(outcome, output):
    for number, status, message in outcome.failed[:SHOWN]:
        yield fails(f"case {number}: status {status}; {message}")
    if len(outcome.failed) > SHOWN:
        yield fails(f"{len(outcome.failed) - SHOWN} more cases have a status above 0; {output} has their messages")
    lost, reason = outcome.lost
    if lost:
        yield fails(f"{lost} cases were not run, {reason}; run the same command to continue")


def _shown(result, keep):
    """A Result whose printed table has the keys, and the requested quantities or the first single numbers"""
    single = [name for name, one in result.quantities.items() if one.axes == ("case",) and one.numeric]
    keys = [name for name in result.quantities if name.startswith("keys.")]
    asked = [name.replace("[*]", "") for name in keep] or [n for n in single if n not in (*keys, "status")][:PRINTED]
    made = {
        name: replace(one, table="cases" if name in (*keys, *asked) else "") for name, one in result.quantities.items()
    }
    return replace(result, quantities=made)
