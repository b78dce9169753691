"""`hakobune.design`: all load cases of a project, judged, and the stored results."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.outputs import check_folder
from ..common.progress import duration as time_words
from ..executors.choice import executor_of
from ..results.given import File
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .advice import most_tried
from .kinds.changes import ways
from .project import read_project
from .report_tables import WORDS
from .report_words import advice_words, band, fatigue_words, method_words, percent, summary
from .verdict import FAILS

if TYPE_CHECKING:
    from rich.console import Console

CRITERIA, CASES = "criteria", "load cases"
LENGTHS = ("duration", "duration_hours", "seeds", "keep_series")  # of runs, which a project chooses for itself


def design(
    project: File, output: File, *, executor: str = "local", advice: bool = True, console: Console | None = None
) -> Result:
    """A mooring in all load cases of a site, judged by rule sets, as one page.

    project : path of a project; output : path of the folder of its page, load cases and databases
    executor : local or processes:N; advice : whether to try other sizes and pretensions if the mooring fails;
        console : console for progress
    returns : Result, in SI; its `detail` is the `verdict.Verdict` and the names of the written files
    raises : ValueError, with a message of one line, before anything is solved
    """
    read, output = read_project(project), Path(output)
    check_folder(output)
    workers = executor_of(executor)
    try:
        verdict, names, change = made(read, output, workers, console, advice)
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    told = tuple(unread_simulation(read.study, read.raw))
    return result_of(verdict, change, names, provenance(project=str(project), folder=str(output)), told)


def unread_simulation(study, project):
    """A remark on keys of a study's [simulation] that the project's [simulation] lacks; only the project's table is
    read

    study, project : tables as read
    """
    own, given = project.get("simulation"), study.get("simulation", {})
    lost = [] if own is None else [f"{key} = {given[key]}" for key in given if key not in own and key not in LENGTHS]
    if lost:
        yield (
            f"left out: {', '.join(lost)} in the study's [simulation]; a project reads only its own "
            "[simulation]; copy the keys that apply into it"
        )


def made(read, folder, workers, console, advice=True):
    """Verdict, names of the written files, and advice for a Read project; all files are written to `folder`.

    The advice is None if it is not requested.
    """
    from .advice import advise, after_lines_move
    from .report import write_report
    from .running import databases, of_databases, run_cases
    from .verdict import judged_project, project_quantities

    folder.mkdir(parents=True, exist_ok=True)
    paths = databases(read, folder, workers, console)
    with _Counting(console, folder / "log.txt") as step:
        began = perf_counter()
        verdict = judged_project(read, run_cases(read, paths, folder, workers, step), of_databases(read, paths))
        change = None
        if advice:
            if verdict.word == FAILS:
                write_report(read, verdict, None, paths, folder)
                step.search(_announced(read, verdict, perf_counter() - began, folder))
            cases = {one.case.name: one.case for one in verdict.ran}
            others = project_quantities(read)
            change = advise(read, verdict.judged, cases, others, paths, folder / "advice", step)
            change = after_lines_move(change, verdict.ran)
    return verdict, write_report(read, verdict, change, paths, folder), change


def _announced(read, verdict, seconds, folder):
    """The verdict, and what the search of advice then does; seconds : that the load cases took, little where kept"""
    each, most = seconds / max(len(verdict.ran), 1), most_tried(ways(read.study))
    text = f"the mooring {verdict.word}{summary(verdict)}\nwritten: {folder / 'report.html'}, without advice"
    if not most:
        return text
    took = f", each about {time_words(each)}" if each > 1 else ", which take as long as when they ran first"
    return (
        f"{text}\nsearching the smallest change that passes: at most {most} changes are tried, and each runs its "
        f"governing load cases again{took}; Ctrl-C ends the search, and --no-advice omits it"
    )


class _Counting:
    """Context whose value, called with the number done, the total number and a name, shows the progress of the cases,
    and writes it to the file `log` with the time of day"""

    def __init__(self, console, log):
        self.console, self.log, self.searching = console, log, False

    def __enter__(self):
        self.log.write_text("", encoding="utf-8")
        self.status = self.console.status("load cases") if self.console and self.console.is_terminal else None
        if self.status:
            self.status.start()
        return self

    def __call__(self, done, known, name):
        text = f"{done} of {known}: {name}"
        self._log(text)
        if self.status:
            self.status.update(text)
        elif self.searching:
            self._print(f"change {text}")

    def search(self, text):
        """Print what a search of advice begins with; each change that it tries is then a line too"""
        self.searching = True
        self._log(text)
        self._print(text)

    def _log(self, text):
        with self.log.open("a", encoding="utf-8") as log:
            print(datetime.now().strftime("%H:%M:%S"), text, file=log)

    def _print(self, text):
        if self.console:
            self.console.print(text, highlight=False, markup=False, soft_wrap=True)

    def __exit__(self, *_):
        if self.status:
            self.status.stop()


def result_of(verdict, change, names, origin, told=()):
    """Result of a Verdict; change : advice, or None; names : names of the files; origin : provenance of the Verdict
    told : lines that are printed before the verdict
    """
    judged, ran = verdict.judged, verdict.ran
    rules = [f"{k + 1} {one.criterion.rule}: {one.criterion.quantity}" for k, one in enumerate(judged)]
    made = {
        name: Quantity(_array([value(one) for one in judged]), ("criterion",), "", words, table, share=words == "used")
        for name, (value, words, table) in OF_CRITERIA.items()
    }
    largest = [_largest_tension(one) for one in ran]
    words = f"largest tension{method_words(verdict)}"
    made["load_case.largest_tension"] = Quantity(_array(largest), ("load_case",), "N", words, CASES)
    made["verdict"] = Quantity(verdict.word, (), "", "verdict")
    failed = [_fails(one) for one in judged if not one.met]
    failed += [fails(f"{one.case.name} could not be run: {one.fault}") for one in ran if one.numbers is None]
    notes = (f"the mooring {verdict.word}{summary(verdict)}", *fatigue_words(verdict), *advice_words(change, verdict))
    notes += (band(verdict),) if band(verdict) else ()
    axes = labels("criterion", rules) | labels("load_case", [one.case.name for one in ran])
    return Result("design", made, axes, (*failed, *verdict.broken), notes, told, origin, (verdict, names))


def _governing(name, unknown):
    """A function of a Judged: a value of its governing Use, or what stands for it where nothing was judged"""
    return lambda one: unknown if one.governing is None else getattr(one.governing, name)


OF_CRITERIA = {  # quantities of each criterion: value of a Judged, words, table
    "criterion.limit": (lambda one: one.criterion.limit, "limit", CRITERIA),
    "criterion.unit": (lambda one: one.criterion.unit.strip("-"), "unit", CRITERIA),
    "criterion.used": (_governing("utilisation", np.nan), "used", CRITERIA),
    "criterion.value": (_governing("value", np.nan), "value", ""),
    "criterion.verdict": (lambda one: WORDS[one.met], "verdict", CRITERIA),
    "criterion.item": (_governing("item", ""), "governing", CRITERIA),
    "criterion.case": (_governing("case", ""), "in load case", CRITERIA),
}


def _largest_tension(one):
    """N, the value that criteria use, nan for a case that was not run or has no lines"""
    return np.max(one.largest) if one.numbers is not None and np.size(one.numbers.largest) > 0 else np.nan


def _array(values):
    text = values and isinstance(values[0], str)
    return np.array(values, str if text else float)


def _fails(one):
    c, use = one.criterion, one.governing
    found = f"{percent(use.utilisation)}, {use.item}, {use.case}" if use else one.missing
    limit = f"{c.limit:.4g} {c.unit.strip('-')}".rstrip()
    return fails(f"{WORDS[one.met]}, {c.rule}: {c.quantity} {c.sense} {limit}: {found}")
