"""Grids, ranges, files and messages of a sweep by hand, and its limits from both sides."""

import itertools
import math
import shutil

import h5py
import numpy as np
import pytest

from hakobune.pipelines import cli
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.sweep import file
from hakobune.pipelines.sweep.study import SweepTable, VaryTable, cases


def vary(key, **more):
    return VaryTable(key=key, **more)


def test_a_grid_has_every_combination_the_last_key_first():
    made = cases(SweepTable("berth", "s.toml", [vary("a", values=[1.0, 2.0]), vary("b", first=0.0, last=1.0, count=3)]))
    assert made == list(itertools.product([1.0, 2.0], [0.0, 0.5, 1.0]))


def test_a_hypercube_has_a_sample_in_each_part_of_every_range_and_its_seed_makes_it_again():
    ranges = [vary("a", first=10.0, last=20.0), vary("b", first=-1.0, last=0.0)]
    made, again, other = (
        np.array(cases(SweepTable("berth", "s.toml", ranges, sampling="latin-hypercube", samples=8, seed=seed)))
        for seed in (1, 1, 2)
    )
    assert np.sort(((made[:, 0] - 10) / 10 * 8).astype(int)).tolist() == list(range(8))
    assert np.sort(((made[:, 1] + 1) * 8).astype(int)).tolist() == list(range(8))
    assert np.array_equal(made, again) and not np.array_equal(made, other)


@pytest.mark.parametrize("table, says", [
    ({"vary": [vary("a", values=[1.0] * 1000), vary("b", first=0.0, last=1.0, count=100)]}, None),
    ({"vary": [vary("a", values=[1.0] * 1000), vary("b", first=0.0, last=1.0, count=101)]},
     "has 101000 numbers; allowed: 1"),
    ({"vary": [vary("a", first=0.0, last=1.0, count=2)]}, None),
    ({"vary": [vary("a", first=0.0, last=1.0, count=1)]}, r"vary\[0\].count has 1 numbers; allowed: 2 to 100000"),
    ({"vary": [vary("a", values=[])]}, r"vary\[0\].values has 0 numbers"),
    ({"vary": [vary("a", first=0.0, last=1.0)]}, "allowed: values, or from, to and count"),
    ({"vary": [vary("a", values=[1.0], first=0.0, last=1.0, count=3)]}, "allowed: values, or from, to and count"),
    ({"vary": [vary("a", values=[1.0])], "samples": 3}, 'samples is given; allowed: with sampling = "latin-hypercube"'),
    ({"vary": [vary("a", first=1.0, last=1.0)], "sampling": "latin-hypercube", "samples": 3},
     "needs from and to, rising"),
    ({"vary": [vary("a", first=0.0, last=1.0)], "sampling": "latin-hypercube", "samples": 1}, None),
    ({"vary": [vary("a", first=0.0, last=1.0)], "sampling": "latin-hypercube", "samples": 0}, "samples has 0 numbers"),
])  # fmt: skip
def test_a_sweep_has_up_to_a_hundred_thousand_cases(table, says):
    sweep = SweepTable("berth", "s.toml", **table)
    if says is None:
        cases(sweep)
        return
    with pytest.raises(StudyError, match=says):
        cases(sweep)


def test_tables_of_cases_lie_in_columns_and_another_shape_is_left_out(tmp_path):
    """Numbers with a minus of typography, none as NaN; the table of the first case says how many rows there are"""
    path = tmp_path / "s.h5"
    file.create(path, ["a", "kind"], [(1.0, "x"), (2.0, "y"), (3.0, "z")], {"sweep": "text"})
    assert file.pending(path) == [0, 1, 2]
    first = {"title": "t", "rows": [{"": "one", "kN/m": "−1.5", "s": "–"}, {"": "two", "kN/m": 2.5, "s": None}]}
    short = {"title": "t", "rows": first["rows"][:1]}
    file.store(path, [(1, 0, "", [first], {"A": (("omega", "influenced_dof"), "kg", np.arange(12.0).reshape(2, 6))})])
    file.store(path, [(2, 1, "why", [short], {"A": (("omega", "influenced_dof"), "kg", np.zeros((3, 6)))})])
    assert file.pending(path) == [0]
    with h5py.File(path) as stored:
        group = stored["tables/0"]
        assert group.attrs["title"] == "t" and list(group["row"].asstr()[()]) == ["one", "two"]
        assert group["kN per m"][1].tolist() == [-1.5, 2.5] and np.all(np.isnan(group["kN per m"][[0, 2]]))
        assert np.all(np.isnan(group["s"][()]))
        assert stored["status"][()].tolist() == [-1, 0, 1] and stored["keys/a"][()].tolist() == [1.0, 2.0, 3.0]
        assert stored["keys/kind"].asstr()[()].tolist() == ["x", "y", "z"]
        A = stored["results/A"]
        assert A.attrs["units"] == "kg" and A[1].tolist() == np.arange(12.0).reshape(2, 6).tolist()
        assert np.all(np.isnan(A[2])) and stored["results/influenced_dof"].asstr()[2] == "Heave"
        said = stored["message"].asstr()[2]
    assert said == "A has the shape (3, 6), (2, 6) in the first case; it is left out"


def test_failing_cases_are_told_up_to_five_of_them(tmp_path, monkeypatch, capsys):
    """Seven speeds from 0.15 m/s of the tanker on a fender that is too small: ½ m v² grows by the square"""
    shutil.copy(SCENES / "berth_tanker.toml", tmp_path)
    speeds = ", ".join(f"{0.4 + 0.1 * i}" for i in range(7))
    (tmp_path / "sweep.toml").write_text(
        f'command = "berth"\nstudy = "berth_tanker.toml"\n[[vary]]\nkey = "approach.speed"\nvalues = [0.1, {speeds}]\n'
    )
    monkeypatch.chdir(tmp_path)
    assert cli.main(["sweep", "sweep.toml"]) == 1
    told = capsys.readouterr().out
    assert "sweep.h5: 8 cases, 7 of them with a status above 0" in told
    assert told.count("FAILS: case ") == 5 and "FAILS: case 1: status 1; " in told
    assert "FAILS: 2 more cases have a status above 0; sweep.h5 has their messages" in told
    with h5py.File("sweep.h5") as stored:
        energy, speed = stored["tables/0/energy kJ"][:, 0], stored["keys/approach.speed"][()]
        assert stored["status"][()].tolist() == [0] + [1] * 7
    assert energy == pytest.approx(energy[0] * (speed / 0.1) ** 2, rel=1e-3)
    assert not math.isnan(energy[-1])
