"""Databases of a design, what of them fails, its tables in files, its last line, and the lines of a breakwater."""

import csv
import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import database
from hakobune.mooring.criteria.failing import fails
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design import command, report_tables, running
from hakobune.pipelines.design import result as designs
from hakobune.pipelines.design.kinds import breakwater
from hakobune.pipelines.printing import console as consoles
from hakobune.pipelines.results import tables
from hakobune.pipelines.solve import report, run

MEAN = running.MEAN


def project(**own):
    known = SimpleNamespace(**{"database": None, "scene": None} | own)
    return SimpleNamespace(folder=Path("/p"), project=SimpleNamespace(project=known, levels={"high": 1.0, "low": -1.0}))


@pytest.mark.parametrize("own, found", [
    ({"database": "b.h5", "scene": "s.toml"}, {MEAN: Path("/p/b.h5")}),
    ({}, {MEAN: None, "high": None, "low": None}),
])  # fmt: skip
def test_a_database_that_is_given_is_taken_and_a_study_of_its_own_has_none(own, found):
    assert running.databases(project(**own), "folder", "executor", "console") == found


@pytest.fixture
def solved(monkeypatch, tmp_path):
    def call(**outcome):
        asked = []
        made = SimpleNamespace(**{"interrupted": False, "exit_status": 0, "failures": []} | outcome)
        monkeypatch.setattr(running, "scenes", lambda read: {MEAN: "scene", "high": "high scene"})
        monkeypatch.setattr(run, "solve", lambda *given, **more: asked.append((given, more)) or made)
        return running.databases(project(scene="s.toml"), tmp_path / "out", "executor", "console"), asked

    return call


def test_every_level_is_solved_into_a_database_of_its_own(solved, tmp_path):
    folder = tmp_path / "out" / "databases"
    for _ in range(2):  # also where the folder is there
        found, asked = solved()
        assert found == {MEAN: folder / f"{MEAN}.h5", "high": folder / "high.h5"} and folder.is_dir()
        more = {"executor": "executor", "console": "console"}
        assert asked == [(("scene", found[MEAN]), more), (("high scene", found["high"]), more)]


@pytest.mark.parametrize("outcome, says", [
    ({"exit_status": 1}, f"the database of level '{MEAN}' is incomplete:  not all frequencies are stored"),
    ({"exit_status": 1, "failures": [(0.5, "it diverges"), (0.6, "again")]},
     f"the database of level '{MEAN}' is incomplete: 0.5 it diverges"),
])  # fmt: skip
def test_a_design_needs_whole_databases(solved, outcome, says):
    with pytest.raises(StudyError) as refused:
        solved(**outcome)
    assert str(refused.value) == says
    with pytest.raises(KeyboardInterrupt):
        solved(interrupted=True)


def test_laws_of_every_database_are_told_and_the_tolerance_of_those_without_panels_of_their_own(monkeypatch):
    monkeypatch.setattr(database, "open_database", lambda path: f"open {path}")
    monkeypatch.setattr(running, "scenes", lambda read: {MEAN: True, "high": False})
    monkeypatch.setattr(report, "gives_panels", lambda scene: scene)
    monkeypatch.setattr(report, "failed_laws", lambda db, panels: "" if "low" in db else f"laws of {db} {panels}")
    monkeypatch.setattr(report, "missed_tolerance", lambda db: f"missed by {db}")
    paths = {MEAN: "a", "high": "b", "low": None}
    of_high = "database of level high: "
    assert list(running.of_databases(project(scene="s"), paths)) == [
        fails(f"database of level {MEAN}: laws of open a True"), fails(f"{of_high}laws of open b False"),
        fails(f"{of_high}missed by open b"),
    ]  # fmt: skip
    own = list(running.of_databases(project(database="b.h5"), {MEAN: "low", "high": "b"}))
    assert own == [fails(f"{of_high}laws of open b True")]


def test_a_table_has_its_title_its_head_and_ten_digits(tmp_path, monkeypatch):
    path = tmp_path / "t.csv"
    report_tables._write_table(path, "quay 3", ("a", "b"), [(1 / 3, "x, y"), (2, 1e-20)])
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    assert list(csv.reader(lines)) == [["a", "b"], ["0.3333333333", "x, y"], ["2", "1e-20"]]
    assert any("quay 3" in line for line in path.read_text().splitlines()[:2])


def test_the_last_line_of_a_design_names_its_files_in_their_folder(monkeypatch):
    said, asked = [], []
    console = SimpleNamespace(print=lambda words, **more: said.append((words, more)))
    result = SimpleNamespace(detail=(None, ["report.html", "cases.csv"]))
    monkeypatch.setattr(consoles, "new_console", lambda: console)
    monkeypatch.setattr(designs, "design", lambda *given, **more: asked.append((given, more)) or result)
    monkeypatch.setattr(tables, "printed", lambda *given: 1 if given == (result, console) else 0)
    assert command.design(Path("p.toml"), output=Path("out"), advice=True) == 1
    ((given, more),) = asked
    assert given == (Path("p.toml"), Path("out")) and more["advice"] is True and more["console"] is console
    ((words, how),) = said
    assert words == f"written: {Path('out/report.html')}, {Path('out/cases.csv')}" and how["soft_wrap"] is True


# ------------------------------------------------------------------ a floating breakwater


def asked(lines=True, allowable=4e5):
    held = SimpleNamespace(spacing=10.0, allowable=allowable, attachment=6.0, attachment_height=1.0)
    return SimpleNamespace(
        design=("both", "theory"), lines=held if lines else None, angle=math.radians(120), line=20.0,
        section=SimpleNamespace(draft=5.0),
    )  # fmt: skip


def found(held=True, snaps=None, anchors=()):
    sea = SimpleNamespace(
        heights={"both theory": 0.6, "free": 0.9}, cells=SimpleNamespace(height=1.5), tension=np.array([2e4, 3e4]),
        slack=np.array([0.01, 0.02]),
    )  # fmt: skip
    return SimpleNamespace(
        pretension=SimpleNamespace(used=1.5e4) if held else None, sea=sea, anchors=anchors, warned=("warned",),
        snapping=None if snaps is None else SimpleNamespace(found=SimpleNamespace(largest=snaps)),
    )  # fmt: skip


@pytest.fixture
def told(monkeypatch):
    from hakobune.pipelines.breakwater import findings

    monkeypatch.setattr(findings, "failures", lambda measured, results: ["failed"])


def test_lines_of_a_breakwater_pull_for_the_length_they_hold_and_end_below_their_attachment(told):
    """10 m of 15 kN/m at rest and of 20 and 30 kN/m at most, 25 where it snaps; at 120° outwards and down, 20 m"""
    anchors = [SimpleNamespace(name="front", utilisation=np.float64(0.5)), SimpleNamespace(name="b", utilisation=None)]
    made = breakwater._numbers(asked(), found(snaps=(2.5e4, 1e4), anchors=anchors))
    assert made.names == ("front", "back") and made.types == (("taut line",), ("taut line",))
    assert made.largest.tolist() == [2.5e5, 3e5] and made.pretension.tolist() == made.static.tolist() == [1.5e5] * 2
    assert made.breaking.tolist() == [np.inf] * 2 and made.length.tolist() == [20.0] * 2
    half, root = 10.0, 10.0 * math.sqrt(3)
    assert made.fairlead == pytest.approx(np.array([[0, -6, -4], [0, 6, -4]]))
    assert made.anchor == pytest.approx(np.array([[0, -6 + half, -4 - root], [0, 6 - half, -4 - root]]))
    assert made.horizontal == pytest.approx([1.25e5, 1.5e5])
    assert made.uplift == pytest.approx(np.array([2.5e5, 3e5]) * math.sqrt(0.75))
    assert made.parts == {
        breakwater.BEHIND: {"both theory": 0.6}, breakwater.SHARE: {"both theory": pytest.approx(0.4)},
        breakwater.ANCHOR: {"front": 0.5}, breakwater.SLACK: {"front": 0.01, "back": 0.02},
        breakwater.ALLOWABLE: {"front": 0.625, "back": 0.75},
    }  # fmt: skip
    assert made.warnings == ("warned", "failed") and np.isnan(made.place).all() and len(made.motions) == 0
    plain = breakwater._numbers(asked(allowable=None), found())
    assert plain.largest.tolist() == [2e5, 3e5] and breakwater.ALLOWABLE not in plain.parts


def test_a_breakwater_that_is_not_held_has_no_lines(told):
    made = breakwater._numbers(asked(lines=False), found(held=False))
    assert made.names == made.types == () and set(made.parts) == {breakwater.BEHIND, breakwater.SHARE}
    assert made.fairlead.shape == made.anchor.shape == (0, 3) and len(made.length) == len(made.largest) == 0


@pytest.mark.parametrize("chosen, name", [
    (("free", "theory"), "free"), (("both", "theory"), "both theory"), (("both", "other"), "first other"),
])  # fmt: skip
def test_the_curve_is_that_of_the_holding_and_theory_or_the_first(chosen, name):
    heights = {"first other": 1.0, "both theory": 0.6, "free": 0.9}
    assert breakwater._curve(chosen, heights) == name
