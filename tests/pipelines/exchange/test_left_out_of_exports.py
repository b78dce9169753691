"""What `hakobune export` tells of what the files of other programs have no place for."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.formats.wamit import stands_for
from hakobune.pipelines.exchange import command
from hakobune.pipelines.exchange.command import FORMATS


@pytest.fixture
def left_out(monkeypatch):
    gaps = SimpleNamespace(unknown={}, not_known=list)
    gaps._replace = lambda **_: gaps
    monkeypatch.setattr(command, "gaps_of", lambda db: gaps)

    def call(to, names=(), rows=(True, True), about=(0, 0, 0), **values):
        db = type("Stored", (dict,), {})(values)
        db.rows, db.names, db.path, db.complete, db.bodies = np.array(rows), tuple(names), "box.h5", all(rows), ()
        known = dict.fromkeys(("added_mass_zero", "added_mass_infinity"), np.ones(1)) | values
        omega = np.array([0.25, 2.0])  # rad/s
        exported = SimpleNamespace(rotation_center=np.array(about, float), get=known.get, bodies=(), omega=omega)
        return list(command._left_out(db, exported, to))

    return call


@pytest.mark.parametrize("to, names, says", [
    ("bemio", ("rao", "drift_force", "drift_force_fixed"), "the format of bemio cannot hold rao, drift_force_fixed"),
    ("capytaine", ("rao", "drift_force"), "the format of capytaine cannot hold rao"),
    ("orcaflex", ("rao", "drift_force", "added_mass_zero"),
     "the format of orcaflex cannot hold drift_force, added_mass_zero"),
    ("wamit", ("rao", "drift_force", "drift_force_fixed"), "the format of wamit cannot hold drift_force_fixed"),
    ("hams", ("rao", "drift_force"), None),
])  # fmt: skip
def test_what_a_format_has_no_place_for_is_named(left_out, to, names, says):
    limits = {name: np.ones(1) for name in names if name == "added_mass_zero"}
    assert left_out(to, names, **limits) == ([] if says is None else [says]) and to in FORMATS


def test_frequencies_that_are_not_solved_and_axes_that_are_not_said_are_told(left_out):
    first, about = left_out("wamit", rows=(True, False), about=(1.0, 0.0, -2.5))
    assert (
        "only 1 of 2 frequencies of box.h5 are solved, and only these are written; to write all, run the"
    ) in first and first.startswith("FAILS: ")
    assert about.startswith(
        "moments and rotations are about (1, 0, -2.5) m, which these files do not contain; "
        "give --about when they are imported"
    )
    assert left_out("bemio", about=(1.0, 0.0, 0.0)) == []
    endless = left_out("bemio", ("added_mass_infinity",), added_mass_infinity=np.array([1.0, np.inf]))
    assert endless == ["added_mass_infinity is not finite and is not written"]


def test_entries_of_limits_that_stand_for_the_frequency_next_to_them_are_told(left_out):
    zero = np.ones((12, 12))
    zero[2, 2], zero[2, 10] = np.inf, -np.inf  # heave, and heave with pitch of the second body
    (endless,) = left_out("wamit", ("added_mass_zero",), added_mass_zero=zero)
    assert endless == (
        "added_mass_zero is not finite for heave–heave, heave–pitch 2 (over a flat bed that of a motion that moves "
        "volume grows without limit), that at 0.25 rad/s is in its place, as HydroDyn needs a number there; "
        "responses to waves do not use it"
    )
    (said,) = left_out("hams", added_mass_infinity=None)
    assert said == (
        "added_mass_infinity is not stored, that at 2 rad/s is in its place, as HydroDyn needs a number there; "
        "solve the scene with 'limits' in want to have it"
    )
    assert left_out("wamit", rows=(True, False), added_mass_zero=zero)[0].startswith("FAILS: only 1 of 2")


def test_a_limit_of_wamit_keeps_its_finite_entries():
    """The row of period −1: the entry that is infinite is that of the lowest frequency, the others are the limit's"""
    A, zero = np.arange(72.0).reshape(2, 6, 6), 100.0 + np.arange(36.0).reshape(6, 6)
    known = {"added_mass": A, "added_mass_zero": np.where(np.eye(6)[2][:, None] * np.eye(6)[2], np.inf, zero)}
    stood = stands_for(SimpleNamespace(get=known.get), "added_mass_zero")
    assert stood[2, 2] == 14.0 and (np.delete(stood.ravel(), 14) == np.delete(zero.ravel(), 14)).all()
    assert (stands_for(SimpleNamespace(get=known.get), "added_mass_infinity") == A[1]).all()


@pytest.mark.parametrize(
    ("to", "mesh", "files"),
    [("wamit", "hull", ["a.1", "a.gdf", "a.12d"]), ("wamit", None, ["a.1", "a.12d"]), ("capytaine", "hull", ["a.1"])],
)
def test_an_export_to_wamit_has_its_hull_where_it_is_known_and_pairs(monkeypatch, tmp_path, capsys, to, mesh, files):
    db, written = SimpleNamespace(bodies=(), path="a.h5"), []
    module = SimpleNamespace(write=lambda values, output: [tmp_path / "a.1"])
    monkeypatch.setattr(command, "open_database", lambda path: db)
    monkeypatch.setattr(command, "values_of", lambda db, several: SimpleNamespace(mesh=mesh, bodies=()))
    monkeypatch.setattr(command, "import_module", lambda name: module)
    monkeypatch.setattr("hakobune.meshing.files.write_mesh", lambda mesh, path: written.append((mesh, path.name)))
    monkeypatch.setattr(command, "_pairs_written", lambda db, values, output: [tmp_path / "a.12d"])
    monkeypatch.setattr(command, "_left_out", lambda *_: [])
    assert command.export(tmp_path / "a.h5", to, tmp_path / f"a{FORMATS[to].ending}", True) == 0
    assert [line.rpartition("/")[2] for line in capsys.readouterr().out.split()] == files
    assert written == ([("hull", "a.gdf")] if "a.gdf" in files else [])
    db.bodies = ("one", "two")
    if to == "wamit":
        command.export(tmp_path / "a.h5", to, tmp_path / "a", True)
    with pytest.raises(ValueError, match=r"a.h5 contains 2 bodies, which --to orcaflex cannot write; allowed: --to"):
        command.export(tmp_path / "a.h5", "orcaflex", tmp_path / "new.yml", True)
