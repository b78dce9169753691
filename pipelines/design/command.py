"""`hakobune design`: databases, load cases, verdict and report of a project, in a folder; again, only what is new."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from hakobune.mooring.criteria.failing import fails


def design(
    project: Annotated[Path, Parameter(help="project (TOML)")],
    /,
    *,
    output: Annotated[Path, Parameter(help="folder of the report, its load cases and databases")],
    executor: Annotated[str, Parameter(help="local or processes:N")] = "local",
    advice: Annotated[bool, Parameter(help="try other sizes, pretensions, numbers of lines where it fails")] = True,
):
    """A mooring through all load cases of a site, judged by rule sets, as one page.

    Status 1 where a criterion is not met or not judged, a line parts, or a case could not be run.
    """
    from ..common.outputs import check_folder
    from ..executors.choice import executor_of
    from ..printing.console import new_console
    from .project import read_project

    console, read = new_console(), read_project(project)
    check_folder(output)
    workers = executor_of(executor)
    try:
        verdict, names, change = made(read, output, workers, console, advice)
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    return _show(console, verdict, change, [output / name for name in names])


def made(read, folder, workers, console, advice=True):
    """Verdict, names of the written files and advice (`advise`, None without) of a Read project, all in `folder`."""
    from .advice import advise, after_lines_move
    from .report import write_report
    from .running import databases, of_databases, run_cases
    from .verdict import judged_project, project_quantities

    folder.mkdir(parents=True, exist_ok=True)
    paths = databases(read, folder, workers, console)
    with _Counting(console) as step:
        verdict = judged_project(read, run_cases(read, paths, folder, workers, step), of_databases(read, paths))
        change = None
        if advice:
            cases = {one.case.name: one.case for one in verdict.ran}
            others = project_quantities(read)
            change = advise(read, verdict.judged, cases, others, paths, folder / "advice", step)
            change = after_lines_move(change, verdict.ran)
    return verdict, write_report(read, verdict, change, paths, folder), change


class _Counting:
    """Context whose value, called with the number done, the number known and a name, shows how far the cases are"""

    def __init__(self, console):
        self.console = console

    def __enter__(self):
        self.status = self.console.status("load cases") if self.console and self.console.is_terminal else None
        if self.status:
            self.status.start()
        return self

    def __call__(self, done, known, name):
        if self.status:
            self.status.update(f"{done} of {known}: {name}")

    def __exit__(self, *_):
        if self.status:
            self.status.stop()


def _show(console, verdict, change, written):
    """Print a Verdict and what was written; returns the exit status"""
    from ..printing.verdict import tell
    from .report_tables import WORDS
    from .report_words import advice_words, percent, summary

    failed = []
    for one in verdict.judged:
        c, use = one.criterion, one.governing
        found = f"{percent(use.utilisation)}, {use.item}, {use.case}" if use else one.missing
        line = f"{c.rule}: {c.quantity} {c.sense} {c.limit:.4g} {c.unit.strip('-')}: {found}"
        if one.met:
            console.print(f"{WORDS[True]:>10}  {line}", highlight=False, markup=False, soft_wrap=True)
        else:
            failed.append(fails(f"{WORDS[one.met]}, {line}"))
    failed += [fails(f"{one.case.name} could not be run: {one.fault}") for one in verdict.ran if one.numbers is None]
    status = tell([*failed, *verdict.broken], console)
    console.print(f"the mooring {verdict.word}{summary(verdict)}", highlight=False, markup=False, soft_wrap=True)
    for line in advice_words(change, verdict):
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    words = ", ".join(map(str, written))
    console.print(f"written: {words}", highlight=False, markup=False, soft_wrap=True)
    return status
