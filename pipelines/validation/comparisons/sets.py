"""The sets of comparisons by name, and how one is made."""

from __future__ import annotations

from hakobune.mooring.criteria.failing import fails

from ...common.bounds import told
from ...common.outputs import check_folder, check_output
from ...printing.verdict import tell
from ...scene.scene import SceneError, numbers
from .databases import is_scene, solved
from .models import Models
from .series import DepthSeries, LengthSeries, Motions, Sections
from .tables import is_table

SECONDS = {"contour": 0.1, "panel": 1.0, "strip": 0.02, "inverse-strip": 0.02, "pressure": 1.0}  # of a frequency, about
SETS = {one.name: one for one in (DepthSeries(), LengthSeries(), Sections(), Motions(), Models())}


def make(one, folder, console, xi=None, fresh=False):
    """Databases, tables and pictures of a set in `folder`; returns 0, or 1 without tables if a frequency failed.

    one : of `SETS`; console : rich console; xi : frequencies as text, left out: those of the set
    raises : SceneError for frequencies that are none; ValueError for a folder that holds something else
    """
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"output is {folder}, which is a file; allowed: a folder, or a new name")
    cases = one.cases(None if xi is None else numbers("--xi", xi))
    check_places(one, cases, folder)
    told(
        f"{len(cases)} databases of {sum(len(case.scene.omegas()) for case in cases)} frequencies take", _seconds(cases)
    )
    found = solved(cases, folder / "databases", console, fresh)
    if found.failures:
        no_tables = "no tables and pictures are made; the same command tries again, --xi leaves frequencies out"
        return tell(map(fails, [*found.failures, no_tables]), console)
    for line in one.summary(found.results):
        _say(console, line)
    for path in one.write(found.results, folder):
        _say(console, path)
    return 0


def _seconds(cases):
    return sum(SECONDS.get(case.scene.method, SECONDS["contour"]) * len(case.scene.omegas()) for case in cases)


def check_places(one, cases, folder):
    """Raise ValueError where a folder cannot be written to, or a table or a scene would replace something else."""
    databases = folder / "databases"
    for place in (folder, databases):
        check_folder(place)
    for name in one.tables if folder.is_dir() else ():
        check_output(folder / name, "a table of a comparison", is_table, (".csv",))
    for case in cases if databases.is_dir() else ():
        check_output(databases / f"{case.name}.toml", "a scene of a comparison", is_scene, (".toml",))


def _say(console, line):
    console.print(f"{line}", highlight=False, markup=False, soft_wrap=True)
