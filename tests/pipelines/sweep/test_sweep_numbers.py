"""Grids, ranges, files and messages of a sweep by hand, and its limits from both sides."""

import itertools

import h5py
import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.sweep import file, run
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
    ({"vary": [vary("a", first=0.0, last=1.0)]}, "give values, or from, to and count"),
    ({"vary": [vary("a", values=[1.0], first=0.0, last=1.0, count=3)]}, "give values, or from, to and count"),
    ({"vary": [vary("a", values=[1.0])], "samples": 3}, 'samples is given; it needs sampling = "latin-hypercube"'),
    ({"vary": [vary("a", first=1.0, last=1.0)], "sampling": "latin-hypercube", "samples": 3},
     "a Latin hypercube needs the keys from and to in place of values, where from is the smaller number"),
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


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({}, None),
        ({"study": "b = 2"}, "belongs to another study; give --fresh"),
        ({"schema": "hakobune sweep 1"}, "s.h5"),
    ],
)
def test_a_file_of_a_sweep_is_taken_up_by_the_same_study_and_version(tmp_path, change, says):
    texts = {"study": "a = 1", "sweep": "c = 3"}
    with h5py.File(tmp_path / "s.h5", "w") as made:
        made.attrs.update({"schema": file.SCHEMA} | texts | change)
    if says is None:
        run._check_same(tmp_path / "s.h5", texts)
        return
    with pytest.raises(ValueError, match=says):
        run._check_same(tmp_path / "s.h5", texts)
