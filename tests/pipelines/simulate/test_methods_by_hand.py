"""Four methods beside each other, and whether a file of runs is whole, from numbers that are made up."""

from contextlib import nullcontext
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.integrity import DatabaseError
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import checking, methods


@dataclass(frozen=True)
class Made:
    quantities: dict
    labels: dict = field(default_factory=dict)
    findings: tuple = ("one",)


@pytest.fixture
def compared(monkeypatch):
    """(result, cases) of methods on a berth of so many seconds in waves of a mean period of 9 s"""

    def call(periods, division=None, mean=9.0, bodies=()):
        cases = []

        def row(body, plan, changed, seed):
            cases.append((body, changed, seed))
            if len(cases) == 2:
                raise ValueError("it\ncapsizes")
            return np.array([[1.0, 2.0, 0.3], [50.0, 60.0, 70.0]]) * len(cases)

        plan = SimpleNamespace(mean_period=mean, seeds=[7, 8])
        monkeypatch.setattr(methods, "input_of", lambda study: SimpleNamespace(study=None, folder=""))
        monkeypatch.setattr(methods, "database_of", lambda db: SimpleNamespace(path="a.h5", bodies=bodies))
        monkeypatch.setattr(methods.work, "prepared", lambda task, db: ("body", plan, None))
        monkeypatch.setattr(methods, "periods_at_berth", lambda body: np.array(periods))
        monkeypatch.setattr(methods, "_divided", lambda study, body, path: "divided")
        monkeypatch.setattr(methods, "_row", row)
        return methods.compared(Made({"kept": 1}), None, None, division=division), cases

    return call


def test_methods_are_at_the_significant_period_and_the_first_of_the_berth(compared):
    """Mean over 0.9 is the significant period, 10 s; nothing restores surge, sway has 80 s"""
    made, cases = compared([np.nan, 80.0, 40.0], "box.h5")
    memory = {"memory": "states", "constant_period": None}
    assert cases == [
        ("divided", memory, 7), ("body", memory, 7),
        ("body", {"memory": "constant", "constant_period": 10.0}, 7),
        ("body", {"memory": "constant", "constant_period": 80.0}, 7),
    ]  # fmt: skip
    assert made.labels["method"].values.tolist() == [
        "1 memory, divided box", "2 memory", "3 constant, 10 s", "4 constant, 80 s",
    ]  # fmt: skip
    nan = np.nan
    assert made.quantities["method.sway"].values == pytest.approx([2.0, nan, 6.0, 8.0], nan_ok=True)
    assert made.quantities["method.yaw_period"].values == pytest.approx([70.0, nan, 210.0, 280.0], nan_ok=True)
    assert made.quantities["method.yaw"].unit == "rad" and made.quantities["kept"] == 1
    assert made.findings == ("one", "2 memory: it capsizes")


def test_a_berth_without_periods_has_three_methods_at_most_and_needs_waves_and_one_body(compared):
    made, _ = compared([np.nan] * 3)
    assert len(made.labels["method"].values) == 2
    with pytest.raises(StudyError, match="--methods compares motions in waves, and the study has no waves; give"):
        compared([80.0], mean=None)
    with pytest.raises(StudyError, match="several bodies; --methods is for one"):
        compared([80.0], bodies=("a", "b"))


@pytest.mark.parametrize(
    ("stored", "whole", "summed", "status", "says"),
    [
        ([1, 1, 1], [1, 1, 1], True, 0, []),
        ([1, 1, 1], [1, 0, 1], True, 1, ["damaged: seeds 12"]),
        ([1, 0, 0], [1, 0, 0], True, 1, ["missing: seeds 12, 13"]),
        ([1, 1, 1], [1, 1, 1], False, 1, ["damaged: the statistics over all seeds"]),
        ([1, 1, 0], [1, 0, 0], True, 1, ["damaged: seeds 12", "missing: seeds 13"]),
        ([0, 0, 0], [0, 0, 0], False, 1, ["missing: seeds 11, 12, 13"]),
    ],
)
def test_a_file_of_runs_is_whole_where_seeds_and_statistics_are(monkeypatch, stored, whole, summed, status, says):
    file = {name: {(): np.array(values)} for name, values in (("stored", stored), ("seed", [11, 12, 13]))}
    monkeypatch.setattr(checking, "opened", lambda path: nullcontext(file))
    monkeypatch.setattr(checking, "whole_rows", lambda file: np.array(whole, bool))
    monkeypatch.setattr(checking, "summary_is_whole", lambda file: summed)
    said = []
    assert checking.check_run("a.h5", said.append) == status
    assert str(said[0]).startswith(f"a.h5: {sum(whole)} of 3 seeds are stored")
    assert len(said) == 1 + len(says) and all(word in str(line) for word, line in zip(says, said[1:], strict=True))


def test_ten_seeds_are_named_and_a_file_that_cannot_be_read_fails(monkeypatch):
    for count, more in ((10, False), (11, True)):
        file = {"stored": {(): np.zeros(count)}, "seed": {(): np.arange(count)}}
        monkeypatch.setattr(checking, "opened", lambda path, file=file: nullcontext(file))
        monkeypatch.setattr(checking, "whole_rows", lambda file, count=count: np.zeros(count, bool))
        monkeypatch.setattr(checking, "summary_is_whole", lambda file: False)
        said = []
        checking.check_run("a.h5", said.append)
        assert ("8, 9 …" in str(said[1])) is more and "8, 9" in str(said[1])

    def broken(path):
        raise DatabaseError("a.h5 is no file")

    monkeypatch.setattr(checking, "opened", broken)
    said = []
    assert checking.check_run("a.h5", said.append) == 1 and "a.h5 is no file" in str(said[0])
