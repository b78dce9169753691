"""What a run and `hakobune check` judge of stored numbers: the largest, where it is, and both sides of each limit."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.stored_laws import Broken
from hakobune.pipelines.scene.places import in_scene
from hakobune.pipelines.solve import adaptive, checking, report

OMEGA = np.array([0.4, 0.5, 0.6])


def database(tolerance=0.01, scene="", **checks):
    return SimpleNamespace(checks=lambda: {name: np.array(values) for name, values in checks.items()}, omega=OMEGA,
                           attributes={"tolerance": tolerance}, names=(),
                           header=SimpleNamespace(scene=scene))  # fmt: skip


def test_a_check_tells_its_largest_value_and_how_many_lie_above_its_limit():
    one = report._check("energy", np.array([0.01, np.nan, 0.03]), OMEGA, 0.02)
    assert (one.largest, one.omega, one.exceeding, one.passed) == (0.03, 0.6, 1, False)
    none = report._check("energy", np.full(3, np.nan), OMEGA, 0.02)
    assert np.isnan(none.largest) and none.passed
    rows = list(zip(*(column.cells for column in report.checks_table([one, none]).columns), strict=True))
    assert rows[0] == ("energy", "waves carried away", "3.0e-02", "0.6", "2e-02", "[red]1 above")
    assert rows[1][2:] == ("", "", "2e-02", "not applied")


@pytest.mark.parametrize("share, told", [(0.99, False), (1.01, True)])
def test_laws_are_held_to_the_tolerance_and_linear_systems_to_a_millionth(share, told):
    for name, limit in (("reciprocity", 0.01), ("residual", 1e-6)):
        said = report.failed_laws(database(**{name: [0.0, limit * share, 0.0]}), False)
        assert bool(said) is told
        assert not told or said.startswith(
            f"checks failed: {name} is broken by {limit * share:.2g} at ω = 0.5 rad/s, limit"
        )


@pytest.mark.parametrize("value, told", [(0.249, False), (0.251, True)])
def test_laws_of_own_panels_are_held_to_a_quarter(value, told):
    said = report.failed_laws(database(energy=[value, 0.0, 0.0]), True)
    assert bool(said) is told and (not told or "energy is broken by 0.25 at ω = 0.4 rad/s, limit 0.25" in said)


@pytest.mark.parametrize("value, told", [(0.0099, False), (0.0101, True)])
def test_an_estimated_error_is_held_to_the_tolerance_that_was_asked_for(value, told):
    said = report.missed_tolerance(database(estimated_error=[0.001, value, value]))
    assert bool(said) is told
    assert not told or said.startswith(
        "the estimated error is 0.01 at ω = 0.5 rad/s, above the tolerance 0.01 at 2 of 3"
    )
    assert report.missed_tolerance(database(energy=[9.0])) == ""
    assert report.failed_laws(database(estimated_error=[9.0, 9.0, 9.0]), False) == ""  # an estimate is no law


@pytest.mark.parametrize(("scene", "told"), [
    ("wall = 17.0", True), ("[[bodies]]\n[[bodies]]", True), ("[[bodies]]", False),
    ("wall = 17.0\n[[damping_lids]]", False),
])  # fmt: skip
def test_an_error_beside_water_that_may_resonate_names_damping_lids(scene, told):
    said = report.missed_tolerance(database(scene=scene, estimated_error=[0.0, 0.15, 0.0]))
    assert ("[[damping_lids]]" in said) is told and "coarser --tolerance" in said


def test_what_fails_of_a_run_has_frequencies_laws_and_tolerance():
    outcome = SimpleNamespace(failures=[(0.5, "it diverges"), ("limits", "no mesh")], stored=2)
    said = list(report.failures(outcome, database(energy=[0.5, 0, 0], estimated_error=[0.5, 0, 0]), False))
    assert said[:2] == ["FAILS: ω = 0.5 rad/s is not solved: it diverges", "FAILS: limits is not solved: no mesh"]
    assert len(said) == 4 and "energy is broken by 0.5" in said[2] and "the estimated error is 0.5" in said[3]
    said = list(report.failures(outcome, database(energy=[0.5, 0, 0], estimated_error=[0.5, 0, 0]), True))
    assert len(said) == 3  # of own panels no tolerance is promised
    nothing = SimpleNamespace(failures=[], stored=0)
    assert list(report.failures(nothing, database(energy=[0.5, 0, 0]), False)) == []


def test_the_table_of_a_body_is_in_tonnes_metres_and_seconds():
    db = SimpleNamespace(
        bodies=(),
        modes=(), dimensions={"length": 100.0}, water_depth=np.inf, density=1025.0, displaced_volume=50_000.0,
        mass=4.9e7,
        center_of_mass=(0.0, -0.0, 1.5), center_of_buoyancy=(0.0, 0.0, -5.0), rotation_center=(1.0, 2.0, -3.0),
        waterplane_area=5000.0, transverse_metacentric_height=16.25, longitudinal_metacentric_height=78.5,
        reader=SimpleNamespace(inertia=None), names=(), omega=OMEGA,
    )  # fmt: skip
    rows = {name: (value, unit) for name, value, unit in report._body_rows(db)}
    assert rows == {
        "length": ("100", "m"), "water depth": ("inf", "m"), "displaced mass": ("51250", "t"), "mass": ("49000", "t"),
        "center of gravity": ("0, 0, 1.5", "m"), "center of buoyancy": ("0, 0, -5", "m"),
        "rotation center": ("1, 2, -3", "m"), "waterplane": ("5000", "m²"), "GM transverse": ("16.25", "m"),
        "GM longitudinal": ("78.5", "m"),
    }  # fmt: skip


def stored(names=(), rows=(True, True), about=(0, 0, 0), **values):
    class Stored(dict):
        pass

    db = Stored(values)
    db.rows, db.names, db.path, db.complete = np.array(rows), tuple(names), "box.h5", all(rows)
    return db, SimpleNamespace(rotation_center=np.array(about, float))


def test_drift_of_bodies_that_does_not_add_up_is_told_by_both_commands_with_more_panels_as_the_way_out(monkeypatch):
    """The same numbers would come of the same panels: --fresh is no way out"""
    sums = [Broken("drift_force is the sum over the bodies", 0.17, 1.0, 0.1)]
    monkeypatch.setattr(report, "unequal_drift", lambda db: sums)
    said = report.uncertain_drift(None)
    assert said.startswith("checks failed: drift_force is the sum over the bodies is broken by 0.17 at ω = 1 rad/s; ")
    assert said.endswith("solve with more panels") and "--fresh" not in said
    assert report.way_out("reciprocity") == "solve it again with --fresh"
    monkeypatch.setattr(report, "unequal_drift", lambda db: [])
    assert report.uncertain_drift(None) == ""


def test_every_stored_number_is_read_for_its_checksum_and_a_broken_law_is_told(monkeypatch):
    read = []

    class Stored(dict):
        omega, names, complete, attributes = OMEGA, ("added_mass", "rao", "mesh"), True, {"tolerance": 0.02}

        def __getitem__(self, name):
            read.append(name)

    def broken(db, tolerance):
        return [("energy", 0.3, 0.5, 10 * tolerance)]

    monkeypatch.setattr(checking, "broken_laws", broken)
    (said,) = checking._broken(Stored())
    assert read == ["added_mass", "rao", "mesh"]
    assert "energy is broken by 0.3 at ω = 0.5 rad/s; allowed: 0.2" in str(said)


def test_a_point_of_a_body_is_turned_with_it_and_moved():
    """30° to the left at (1, 2): 2 m ahead are √3 and 1 m, 4 m to the left −2 and 2√3 m"""
    found = in_scene(SimpleNamespace(place=(1.0, 2.0, 30.0)), (2.0, 4.0, 0.5))
    assert found == pytest.approx([1 + np.sqrt(3) - 2, 2 + 1 + 2 * np.sqrt(3), 0.5])


def test_frequencies_are_looked_for_as_long_as_the_band_has_fewer_than_the_most(monkeypatch):
    """Of the ends a billionth is rounding"""
    scene = SimpleNamespace(waves=SimpleNamespace(band=SimpleNamespace(first=0.4, last=1.0)), accuracy=0.01)
    monkeypatch.setattr(adaptive, "between", lambda db: None)
    monkeypatch.setattr(adaptive, "_estimated", lambda scene, known: ("places", error))
    monkeypatch.setattr(adaptive, "_next", lambda *_: np.array([0.7]))
    monkeypatch.setattr(adaptive, "_unseen", lambda *_: np.array([0.8]))
    few = np.linspace(0.4 * (1 - 1e-10), 1.0 + 1e-10, adaptive.MOST - 1)
    outside = np.append(few, [0.3, 1.1])
    for error, wanted in ((0.011, [0.7]), (0.009, [0.8])):
        assert adaptive._missing(scene, SimpleNamespace(omega=outside))[1].tolist() == wanted
        full = adaptive._missing(scene, SimpleNamespace(omega=np.linspace(0.4, 1.0, adaptive.MOST)))
        assert full[0] == error and not len(full[1])


@dataclass(frozen=True)
class Filled:
    exit_status: int = 0
    solved: int = 3
    jobs: int = 2
    remarks: tuple = ("one",)


@pytest.mark.parametrize(
    ("statuses", "error", "wanted"),
    [
        ((0, 0), 0.009, (0, 6, 4, ("one", "text"))), ((0, 0), 0.011, (0, 6, 4, ("one", "text; the tolerance is not"))),
        ((1,), 0.0, (1, 3, 2, ("one",))), ((0, 130), 0.0, (130, 6, 4, ("one",))),
    ],
)  # fmt: skip
def test_a_band_is_filled_until_nothing_is_missing_or_a_run_ends(monkeypatch, statuses, error, wanted):
    """A run that ends early is told as it is; of more runs what they solved adds up"""
    left, missing, files = list(statuses), [np.array([0.7]), np.zeros(0)], []
    monkeypatch.setattr(adaptive, "open_database", lambda file: SimpleNamespace(omega=OMEGA))
    monkeypatch.setattr(adaptive, "_missing", lambda scene, db: (error, missing.pop(0)))
    monkeypatch.setattr(adaptive, "_text", lambda scene, db, error: "text")

    def fill(file):
        files.append(file)
        return Filled(left.pop(0))

    made = adaptive.filled_band(SimpleNamespace(accuracy=0.01), "a", fill, lambda file, omega: file + "b", None)
    assert (made.exit_status, made.solved, made.jobs) == wanted[:3] and files == ["a", "ab"][: len(statuses)]
    assert len(made.remarks) == len(wanted[3]) and wanted[3][-1] in str(made.remarks[-1])
