"""`hakobune design`: databases, load cases, verdict and report of a project, in a folder; again, only what is new."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


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
    from ..printing.console import new_console
    from ..results.tables import printed
    from .result import design as found

    console = new_console()
    result = found(project, output, executor=executor, advice=advice, console=console)
    status = printed(result, console)
    words = ", ".join(str(output / name) for name in result.detail[1])
    console.print(f"written: {words}", highlight=False, markup=False, soft_wrap=True)
    return status


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
