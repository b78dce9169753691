"""The sets of comparisons by name, and the making of a set.

A set has `cases(xi)`, `tables(results)`, which are {axis: rows} of `beside.result`, `summary(results)`, lines, and
`pictures(results)`, {name: arguments of `picture.draw`}.
"""

import sys

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.criteria.failing import fails

from ...common.bounds import told
from ...common.outputs import check_folder
from ...printing.verdict import tell
from ...results.output import check_result, write_result
from ...results.tables import printed
from ...scene.scene import SceneError, numbers
from ...solve import run
from .. import beside
from ..picture import draw
from . import models, series
from .report_units import in_report_units

SOURCE = "SR179 report (1982), chapter 2; boxes of length L, beam B, draft d in water of depth H"
SECONDS = {"contour": 0.1, "panel": 1.0, "strip": 0.02, "inverse-strip": 0.02, "pressure": 1.0}  # s, for a frequency
SETS = {"depth-series": series.DepthSeries(), "length-series": series.LengthSeries(), "sections": series.Sections(),
        "motions": series.Motions(), "models": models.Models()}  # fmt: skip


def make(name, one, folder, xi=None, fresh=False):
    """Databases, result and pictures of a set in `folder`; returns 0, or 1 without a result if a frequency failed.

    one : one of `SETS`; xi : frequencies as text, by default those of the set
    raises : SceneError for invalid frequencies; ValueError for a folder with different content
    """
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"output is {folder}, which is a file; allowed: a folder, or a new name")
    cases = one.cases(None if xi is None else numbers("--xi", xi))
    for place in (folder, folder / "databases"):
        check_folder(place)
    table = folder / f"{name}.csv"
    if folder.is_dir():
        check_result(table, f"compare {name}")
    counts = [len(case.scene.omegas()) for case in cases]
    seconds = sum(SECONDS.get(c.scene.method, SECONDS["contour"]) * n for c, n in zip(cases, counts, strict=True))
    told(f"{len(cases)} databases of {sum(counts)} frequencies take", seconds)
    results, failures = solved(cases, folder / "databases", fresh)
    if failures:
        no_tables = "no table and pictures are made; the same command tries again, --xi leaves frequencies out"
        return tell(map(fails, [*failures, no_tables]))
    folder.mkdir(parents=True, exist_ok=True)
    made = beside.result(f"compare {name}", SOURCE, one.tables(results), one.summary(results))
    write_result(made, table)
    paths = [table, *(draw(folder / f"{name}_{end}.png", *words) for end, words in one.pictures(results).items())]
    status = printed(made)
    print(*paths, sep="\n")
    return status


def solved(cases, folder, fresh=False):
    """Return the `Results` of cases, without those in which a frequency failed; a line for each of these; and a
    database for each.

    folder : Path, made if it is missing; fresh : whether to replace existing databases
    raises : KeyboardInterrupt with everything stored that was solved; ValueError for a database of another scene
    """
    folder.mkdir(parents=True, exist_ok=True)
    results, failures = [], []
    for case in beside.one_by_one(cases, lambda case: case.name):
        outcome = run.solve(case.scene, folder / f"{case.name}.h5", fresh=fresh)
        if outcome.interrupted:
            raise KeyboardInterrupt
        db = open_database(folder / f"{case.name}.h5")
        failures += [f"{case.name}: ω = {where:.6g} rad/s: {reason}" for where, reason in outcome.failures]
        if not outcome.failures:
            results.append(in_report_units(case, db))
        error = np.nanmax([0.0, *db.checks()["estimated_error"]])
        done = f"{outcome.solved or 'none'} of {outcome.total} frequencies by this run"
        print(f"  {done}, estimated error {error:.0e}", file=sys.stderr)
    return results, failures
