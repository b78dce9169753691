"""What `hakobune check` prints of a database that is made up: its order, and each line on both sides of its limit."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.integrity import DamagedError
from hakobune.pipelines.solve import checking, report

SCENE = '[water]\ndepth = 20.0\n[[bodies]]\nshape = "box"\nlength = 50.0\nbeam = 10.0\ndraft = 4.0\n[waves]\n'
SCENE += "omegas = [0.5]\nheadings_deg = [0]\n"


@pytest.mark.parametrize("force, motion, says", [
    ("heave", "heave", ": that of heave, which makes few waves there"),
    ("surge", "pitch", ": that of pitch on surge, which makes few waves there"),
])  # fmt: skip
def test_damping_that_breaks_its_law_is_named_with_its_motion_and_force(monkeypatch, force, motion, says):
    monkeypatch.setattr(checking, "worst_damping", lambda db: (force, motion))
    assert checking._weak(SimpleNamespace(name="damping"), "db") == says
    assert checking._weak(SimpleNamespace(name="energy"), "db") == ""


def stored(depth=20.0, density=1025.0, gravity=9.80665, scene=SCENE):
    return SimpleNamespace(water_depth=depth, density=density, gravity=gravity, header=SimpleNamespace(scene=scene))


@pytest.mark.parametrize("change, says", [
    ({}, None), ({"scene": ""}, None),
    ({"depth": 21.0}, "water.depth is 20 in its scene, but its results are for 21; solve it again with --fresh"),
    ({"density": 1000.0}, "water.density is 1025 in its scene, but its results are for 1000; solve it"),
    ({"gravity": 9.8}, "water.gravity is 9.80665 in its scene, but its results are for 9.8;"),
    ({"scene": "[water]\ndeep = 3"}, "the text of its scene cannot be read: "),
])  # fmt: skip
def test_the_scene_of_a_database_is_that_of_its_water(change, says):
    found = list(checking._scene_findings(stored(**change)))
    assert len(found) == (says is not None)
    assert all(one.severity == "error" and says in one.text for one in found)


def test_every_difference_of_water_is_told():
    found = list(checking._scene_findings(stored(1.0, 2.0, 3.0)))
    assert [one.text.split(" is ")[0] for one in found] == ["water.depth", "water.density", "water.gravity"]


class Read(dict):
    """A database that notes which of its numbers are read"""

    def __init__(self, complete=True, omega=(0.5,), **attributes):
        super().__init__(added_mass=1, infinite_added_mass=2)
        self.read, self.complete, self.omega, self.attributes = [], complete, omega, attributes
        self.names = ("added_mass", "limit")

    def __getitem__(self, name):
        self.read.append(name)


def test_numbers_are_read_against_their_checksums_and_laws_are_held_to_the_tolerance(monkeypatch):
    asked = []

    def laws(db, tolerance):
        asked.append(tolerance)
        return [("reciprocity", 0.0234, 0.56789, 0.05)]

    monkeypatch.setattr(checking, "LIMITS", ("limit",))
    monkeypatch.setattr(checking, "broken_laws", laws)
    whole, begun = Read(tolerance=0.02), Read(complete=False)
    (one,) = checking._broken(whole)
    assert (one.severity, one.text) == (
        "error", "stored numbers: reciprocity is broken by 0.023 at ω = 0.5679 rad/s; allowed: 0.05; solve it again "
        "with --fresh",
    )  # fmt: skip
    assert checking._broken(begun)[0] == one and asked == [0.02, 0.01]
    assert whole.read == ["added_mass", "limit"] and begun.read == ["added_mass"]
    assert checking._broken(Read(omega=())) == [] and len(asked) == 2


@pytest.fixture
def checked(monkeypatch):
    def call(complete=True, passed=True, repair=False, omega=(0.4, 0.5), damaged=False):
        printed, told = [], []
        one = SimpleNamespace(name="energy", largest=0.034, omega=0.51234, exceeding=1, limit=0.02, passed=passed)
        db = SimpleNamespace(omega=omega, complete=complete, attributes={}, rows=np.array([True, True, complete]))

        def opened(path):
            if damaged:
                raise DamagedError("the numbers are damaged")
            return db

        def finding(text, severity):
            return SimpleNamespace(text=text, severity=severity)

        monkeypatch.setattr(checking, "open_database", opened)
        monkeypatch.setattr(checking, "_repaired", lambda path: f"repaired {path}")
        monkeypatch.setattr(checking, "_of_pairs", lambda db: ())
        monkeypatch.setattr(checking, "_findings", lambda db: [finding("coarse", "warning"), finding("open", "error")])
        monkeypatch.setattr(checking, "_scene_findings", lambda db: [finding("other water", "error")])
        monkeypatch.setattr(checking, "checked", lambda db: [one])
        monkeypatch.setattr(checking, "checks_table", lambda found: ("table", found))
        monkeypatch.setattr(checking, "_broken", lambda db: [finding("law", "error")])
        monkeypatch.setattr(checking, "gaps_of", lambda db: SimpleNamespace(not_known=lambda: ["not known"]))
        monkeypatch.setattr(checking, "resonances_of", lambda db: ["resonance"])
        monkeypatch.setattr(checking, "CHECKED", {"energy": "waves carried away"})
        monkeypatch.setattr(checking, "_weak", lambda one, db: ": weak")
        monkeypatch.setattr(checking, "tell", lambda lines, console, *more: told.append((list(lines), more)) or 7)
        console = SimpleNamespace(print=lambda what, **more: printed.append(what))
        assert checking.check("d.h5", console, repair) == 7
        return printed, told[0][0], one

    return call


COMMON = ["warning: coarse", "FAILS: open", "FAILS: other water", "FAILS: law", "FAILS: not known", "note: resonance"]


def test_a_database_that_holds_tells_its_table_and_lines_in_their_order(checked):
    printed, lines, one = checked()
    assert printed == [("table", [one])] and lines == COMMON


def test_checks_that_fail_frequencies_that_lack_and_repairs_are_told(checked):
    printed, lines, one = checked(complete=False, passed=False, repair=True)
    assert printed == ["repaired d.h5", ("table", [one])]
    assert lines == [
        *COMMON,
        "FAILS: energy, waves carried away, is 0.034 at ω = 0.5123 rad/s, 1 of 2 frequencies above 0.02: weak; solve "
        "with more panels, or a coarser --tolerance",
        "FAILS: 2 of 3 frequencies are stored; run the command again to continue",
    ]


def test_nothing_is_checked_where_nothing_is_solved_and_damage_is_all_that_is_told(checked):
    printed, lines, _ = checked(omega=())
    assert printed == [] and lines == COMMON
    printed, lines, _ = checked(damaged=True)
    assert printed == [] and lines == ["FAILS: the numbers are damaged"]


def test_checks_that_were_not_applied_to_an_imported_set_have_their_reason():
    checks = [SimpleNamespace(name=name, largest=largest) for name, largest in (("energy", np.nan), ("damping", 0.1))]
    (said,) = report.not_applied(checks, SimpleNamespace(attributes={"imported": "wamit: a.1"}))
    assert said.startswith("note: not applied: energy: ") and "`hakobune import` compared it with" in said
    assert report.not_applied(checks[1:], SimpleNamespace(attributes={"imported": "wamit: a.1"})) == ()
    assert report.not_applied(checks, SimpleNamespace(attributes={})) == ()


def test_an_imported_set_has_the_checks_that_it_tells_by_itself(monkeypatch):
    """Reciprocity and energy in place of none; a database of hakobune keeps what it stored"""
    none = {name: np.full(2, np.nan) for name in ("reciprocity", "Haskind", "energy")}
    db = SimpleNamespace(omega=np.array([0.5, 1.0]), attributes={"imported": "a.1"}, checks=lambda: none)
    told = {"reciprocity": np.array([1e-3, 2e-3]), "energy": np.array([0.2, np.nan])}
    monkeypatch.setattr(report, "damping_errors", lambda db: np.full(2, np.nan))
    monkeypatch.setattr(report, "laws_of_imported", lambda db: told)
    found = {one.name: one for one in report.checked(db)}
    assert (found["reciprocity"].largest, found["reciprocity"].omega, found["reciprocity"].passed) == (2e-3, 1.0, True)
    assert (found["energy"].largest, found["energy"].exceeding) == (0.2, 1) and np.isnan(found["Haskind"].largest)
    monkeypatch.setattr(report, "laws_of_imported", lambda db: {})
    assert all(np.isnan(one.largest) for one in report.checked(db))


def test_energy_of_an_imported_set_names_what_it_compares():
    energy, other = SimpleNamespace(name="energy"), SimpleNamespace(name="reciprocity")
    of = SimpleNamespace(attributes={"imported": "a.1"})
    assert checking._unfit(energy, of).startswith("its damping does not follow from its forces: check the depth")
    assert checking._unfit(other, of) == checking._unfit(energy, SimpleNamespace(attributes={})) == ""


def test_the_table_of_checks_has_a_name_and_a_side_for_each_column():
    """Numbers stand on the right"""
    table = report.checks_table([])
    assert [(column.header, column.justify) for column in table.columns] == [
        ("check", "left"), ("what", "left"), ("largest", "right"), ("at ω rad/s", "right"), ("limit", "right"),
        ("", "left"),
    ]  # fmt: skip
