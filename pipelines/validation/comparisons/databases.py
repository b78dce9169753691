"""Databases of cases: solved where they are not, read in the report's units."""

from __future__ import annotations

import time
from typing import NamedTuple

import numpy as np

from hakobune.bem.database import open_database

from ...common.progress import duration
from ...scene.scene import make_scene, read_scene
from ...scene.text import to_toml
from ...solve import run
from .report_units import in_report_units


class Solved(NamedTuple):
    """results : [`Results`] in the order of the cases, without those in which a frequency failed

    failures : one line for each frequency that failed
    """

    results: list
    failures: tuple


def solved(cases, folder, console, fresh=False):
    """`Solved` of cases, each in a database of its own with its scene beside it; one line is printed for each.

    folder : Path, made if it is not there; fresh : replace databases that are there
    raises : KeyboardInterrupt with everything stored that was solved; ValueError for a database of another scene
    """
    folder.mkdir(parents=True, exist_ok=True)
    results, failures, started = [], [], time.perf_counter()
    for count, case in enumerate(cases, 1):
        path = folder / f"{case.name}.h5"
        outcome = run.solve(case.scene, path, fresh=fresh)
        path.with_suffix(".toml").write_text(to_toml(case.scene), encoding="utf-8")
        if outcome.interrupted:
            raise KeyboardInterrupt
        left = (time.perf_counter() - started) / count * (len(cases) - count)
        db = open_database(path)
        failures += [f"{case.name}: ω = {where:.6g} rad/s: {reason}" for where, reason in outcome.failures]
        if not outcome.failures:
            results.append(in_report_units(case, db))
        line = f"{count:{len(str(len(cases)))}}/{len(cases)}  {case.name:28}  {_told(outcome, db)}"
        console.print(f"{line}  {duration(left):>8} left", highlight=False, markup=False, soft_wrap=True)
    return Solved(results, tuple(failures))


def is_scene(path):
    """Whether a file is a scene in which nobody left a word: what is lost with it can be written again"""
    try:
        make_scene(read_scene(path))
        return "#" not in path.read_text(encoding="utf-8")
    except ValueError:
        return False


def _told(outcome, db):
    done = f"{outcome.stored} of {outcome.total} frequencies, {outcome.solved or 'none'} by this run"
    errors = db.checks()["estimated_error"]
    return f"{done}, estimated error {np.nanmax(errors):.0e}" if np.isfinite(errors).any() else done
