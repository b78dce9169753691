"""`hakobune simulate`: runs into the file, tables on the terminal, pictures beside the file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.quantities import StudyError
from ..common.weather.gusts import gusts_of
from ..executors.choice import executor_of
from ..moor.quay import body_of
from ..moor.study import read_study
from ..printing.verdict import tell
from . import berth, report
from .file import is_run, opened, whole_rows
from .methods import methods_table
from .pictures import draw
from .run import simulate as fill
from .work import Task

NOTHING = "interrupted before a seed was finished; nothing is stored yet, the same command begins with the first"


def simulate(study, database, output, seeds=None, duration=None, fresh=False, executor="local", windows=None,
             methods=False, division=None):  # fmt: skip
    """Exit status: 0, 1 where a seed, a line or a fender fails, 130 interrupted.  Raises ValueError before anything.

    windows : s, of which the first record is told one by one
    methods, division : of `methods.methods_table`
    """
    from ..printing.console import new_console

    console, workers = new_console(), executor_of(executor)
    if division is not None and not methods:
        raise StudyError("--division is given without --methods; allowed: with it")
    if seeds is not None and seeds < 1:
        raise StudyError(f"--seeds is {seeds}; allowed: a whole number from 1")
    try:
        outcome = fill(study, database, output, console, workers, seeds, duration, fresh, windows)
        if outcome.interrupted:
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        raise KeyboardInterrupt(*(() if _has_seeds(output) else (NOTHING,))) from None
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    if not outcome.made and not outcome.failures:
        console.print("nothing was left to do", highlight=False)
    status = 0
    with opened(output) as file:
        if whole_rows(file).any():
            drawn = draw(file, Path(output))
            status = _show(console, file, study, database, outcome.findings)
            if windows is not None:
                console.print(berth.windows_table(file, windows))
            if methods:
                console.print(_methods(file, study, database, division))
            words = ", ".join([str(output), *drawn])
            console.print(f"written: {words}", highlight=False, soft_wrap=True, markup=False)
    return tell((fails(f"seed {seed}: {reason}") for seed, reason in outcome.failures), console) or status


def _has_seeds(output):
    if not is_run(Path(output)):
        return False
    with opened(output) as file:
        return bool(whole_rows(file).any())


def _methods(file, study, database, division):
    """Table of the methods on the first seed of an open file"""
    task = Task(
        read_study(study)[1], str(database), float(file.attrs["duration"]), None, str(Path(study).resolve().parent)
    )
    return methods_table(task, int(file["seed"][0]), division)


def _show(console, file, study, database, findings):
    from hakobune.bem.database import open_database

    beside, more = beside_of(study, database)
    if "natural_period" in file.attrs:
        read = read_study(study)[0]
        harbour = [] if read.harbour is None else berth.check_harbour(read.harbour.periods)
        db = open_database(database)
        hull = read.hull_of(db.dimensions)
        fenders = read.berth(hull, db.rotation_center).fenders
        for told, findings_of_it in (
            berth.lines_on_periods(file.attrs["natural_period"], harbour),
            berth.lines_on_fenders(file, fenders),
            (berth.by_design_spectrum(read, db, body_of(read, db)[0], hull, fenders), ()),
        ):
            if told:
                console.print(told, highlight=False, soft_wrap=True, markup=False)
            more = (*more, *findings_of_it)
    periods, wave_period = {}, float(file.attrs["mean_period"])
    if beside is not None:
        state = beside.at_equilibrium
        periods = {n: v for n, v in zip(state.names, state.period, strict=True) if n in ("Surge", "Sway", "Yaw")}
    whole = [*report.findings(file, periods, wave_period if np.isfinite(wave_period) else None)]
    whole += _of_slow_motion(file, beside, study, database)
    return report.show(console, file, beside, [*findings, *more, *whole])


def _of_slow_motion(file, beside, study, database):
    """Findings on slow motion beside its linear spectral answer, where there is one"""
    if beside is None or beside.conditions.sea is None or beside.conditions.method == "regular_wave":
        return ()
    from hakobune.bem.database import open_database
    from hakobune.mooring.studies.long_period import long_period

    read, db = read_study(study)[0], open_database(database)
    try:
        linear = long_period(db, read.hull_of(db.dimensions), beside, gusts_of(read.wind))
    except ValueError:  # of a database without drift or a spectrum it does not reach
        return ()
    return tuple(report.slow_findings(file, linear.by_spectrum))


def beside_of(study, database):
    """MultiPoint of the same study by the simplified method, or None and the reason."""
    from hakobune.bem.database import open_database
    from hakobune.mooring.studies.multi_point import multi_point

    db, read = open_database(database), read_study(study)[0]
    if read.at_berth:
        return None, ("the simplified method knows no fenders and ropes and is left out",)
    if read.quay is not None:
        return None, ("the simplified method knows no quay and is left out",)
    hull = read.hull_of(db.dimensions)
    system = read.system(hull, db.rotation_center, db.density, db.gravity)
    try:
        return multi_point(db, system, hull, read.conditions(), read.allowable), ()
    except ValueError as error:
        return None, (f"the simplified method has no answer here: {' '.join(str(error).split())}",)
