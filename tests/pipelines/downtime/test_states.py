"""States of a record, simulated by a stand-in: chosen, kept line by line, taken up again after a kill anywhere."""

from contextlib import nullcontext
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.downtime.interpolant import Interpolant, fitted
from hakobune.mooring.motion.simulation import Overload
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import simulated as room
from hakobune.pipelines.downtime import states_file
from hakobune.pipelines.downtime.limits import limits_of
from hakobune.pipelines.downtime.study import make_downtime, record_of
from hakobune.pipelines.executors.choice import Here, in_order_until

WAVES = {"height": "hs", "peak_period": "tp", "direction_from": "dir"}
OPERATIONS = [
    {"name": "cranes", "limits": [{"quantity": "sway", "at_most": 1.0}, {"quantity": "wind speed", "at_most": 15.0}]},
    {"name": "arms", "limits": [{"quantity": "surge", "at_most": 0.8, "statistic": "peak to peak"}]},
]


def sway(height, seed):
    """m, of a body that follows the height with a scatter of 10 %"""
    return 0.6 * height * np.exp(0.1 * np.random.default_rng(seed).standard_normal())


@dataclass
class StandIn:
    """In the place of `one_state.state`; ends, fails, over : numbers of the calls that a kill ends, that fail, and
    whose fender is compressed beyond its table
    """

    ends: int = 0
    fails: int = 0
    over: int = 0
    calls: int = 0

    def __call__(self, task, raw, weather, seeds):
        self.calls += 1
        if self.calls == self.ends:
            raise KeyboardInterrupt
        if self.calls == self.fails:
            raise ValueError("no equilibrium")
        if self.calls == self.over:
            raise Overload("at 9 s fender F2 is compressed beyond its table")
        found = []
        for seed in seeds:
            value = sway(weather["waves"]["height"], seed)
            found.append({"sway": {"largest": value}, "surge": {"largest": 0.5 * value, "peak to peak": value}})
        return found


@pytest.fixture
def made(tmp_path):
    """(study, record, limits, ready) of 60 days of hours"""
    rng, lines = np.random.default_rng(6), ["time,hs [m],tp [s],dir [deg],w [m/s]"]
    time = np.datetime64("2020-01-01T00", "h") + np.arange(1440)
    height = np.exp(0.5 * np.sin(np.arange(1440) / 40) + 0.2 * rng.standard_normal(1440))
    lines += [f"{t},{h:.2f},{6 + 2 * h:.1f},{d:.0f},{4 + 5 * h:.1f}"
              for t, h, d in zip(time, height, rng.uniform(0, 360, 1440), strict=True)]  # fmt: skip
    (tmp_path / "h.csv").write_text("\n".join(lines))
    (tmp_path / "box.h5").write_bytes(b"a database")
    study = make_downtime({
        "hindcast": {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES], "columns": {"wind speed": "w"}},
        "simulation": {"study": "moor.toml", "states": 16, "most_states": 20, "batch": 4, "tolerance_hours": 1e-3},
        "operations": OPERATIONS,
    })  # fmt: skip
    ready = room.Prepared(SimpleNamespace(database=str(tmp_path / "box.h5")), {"simulation": {}}, ["surge", "sway"])
    return study, record_of(study.hindcast, tmp_path), limits_of(study, [], {}, {"surge": "m", "sway": "m"}), ready


class Straight:
    """In the place of a process: what a trend in the height leaves is nil, known to 5 %"""

    def predict(self, x, return_std):
        return np.zeros(len(x)), np.full(len(x), 0.05)

    def sample_y(self, x, count, random_state):
        return 0.05 * np.random.default_rng(random_state).standard_normal(count) * np.ones((len(x), 1))


def straight(x, height, used):
    return Interpolant(Straight(), np.polyfit(np.log(height), np.log(used).mean(axis=1), 1)[::-1], 0.1)


def run(made, path, monkeypatch, fit=straight, say=lambda line: None, **words):
    stand_in = StandIn(**words)
    monkeypatch.setattr(room, "state", stand_in)
    monkeypatch.setattr(room, "fitted", fit)
    study, record, limits, ready = made
    return room.simulated(study, record, limits, ready, path, Here(), say), stand_in.calls


def test_hours_of_states_are_those_of_every_hour(made, tmp_path, monkeypatch):
    found, calls = run(made, tmp_path / "s.jsonl", monkeypatch, fitted)
    assert calls == len(found.rows) == 20
    height, wind = made[1].hindcast.height, made[1].hindcast.columns["wind speed"]
    each = np.array([[sway(h, 10**6 + 7 * i + k) for k in range(20)] for i, h in enumerate(height)])
    for o, stopped in enumerate(((each > 1.0) | (wind > 15)[:, None], each > 0.8)):
        truth = 8766 * stopped.mean()
        half = 1.645 * found.error[o] + 8766 * 1.645 * np.sqrt(np.sum(stopped.var(axis=1)) / 20) / len(height)
        assert abs(found.hours[o] - truth) < half + 0.02 * truth
    assert np.all(found.verdicts.chance[wind > 15, 0] == 1) and found.verdicts.down[wind > 15, 0].all()
    assert "h; raise most_states" in found.said[0]


@pytest.mark.parametrize("call", [1, 5, 17, 20])
def test_states_go_on_after_a_kill_and_the_file_is_the_same(call, made, tmp_path, monkeypatch):
    whole, broken = tmp_path / "whole.jsonl", tmp_path / "broken.jsonl"
    first, _ = run(made, whole, monkeypatch)
    with pytest.raises(KeyboardInterrupt, match=rf"{call - 1} of \d+ states are stored in .*broken\.jsonl"):
        run(made, broken, monkeypatch, ends=call)
    with broken.open("ab") as file:  # a line that was being written
        file.write(whole.read_bytes().splitlines()[call][:40])
    second, calls = run(made, broken, monkeypatch)
    assert calls == 20 - (call - 1)
    assert broken.read_bytes() == whole.read_bytes()
    np.testing.assert_array_equal(second.hours, first.hours)
    assert run(made, whole, monkeypatch)[1] == 0


def test_a_state_without_an_answer_is_told_and_left_out(made, tmp_path, monkeypatch):
    found, _ = run(made, tmp_path / "s.jsonl", monkeypatch, fails=3)
    left_out = "no equilibrium; left out, its hour follows from other states"
    assert [reason for _, reason in found.failed] == [left_out] and len(found.rows) == 19


def test_a_state_whose_fender_is_beyond_its_table_is_beyond_all_limits(made, tmp_path, monkeypatch):
    """As far as the worst of the others, 1.5 of the limit at least; the highest hour is simulated first"""
    found, _ = run(made, tmp_path / "s.jsonl", monkeypatch, over=3)
    ((row, reason),) = found.failed
    assert reason.startswith("at 9 s fender F2 is compressed beyond its table; counted as beyond all limits")
    assert len(found.rows) == 20 and row in found.rows
    own, others = found.rows == row, found.rows != row
    for i in (0, 2):
        largest = max(1.5, found.used[others, :, i].max())
        assert found.used[own, :, i] == pytest.approx(np.full((1, found.used.shape[1]), largest))
    assert np.isnan(found.used[own, :, 1]).all()  # of the wind, which is no matter of the run


def test_a_file_of_other_states_or_a_damaged_one_is_refused(made, tmp_path, monkeypatch):
    path = tmp_path / "s.jsonl"
    run(made, path, monkeypatch)
    content = path.read_text()
    path.write_text(content.replace('"hour"', '"houR"', 1))
    with pytest.raises(StudyError, match="line 2, is damaged: it does not match its checksum"):
        run(made, path, monkeypatch)
    path.write_text(content.replace("states ", "states 0", 1))
    with pytest.raises(
        StudyError, match="belongs to another hindcast, mooring study, database, seeds or duration; give another name"
    ):
        run(made, path, monkeypatch)
    path.write_text("something else\n")
    with pytest.raises(StudyError, match="is not a file of simulated states, so it is not replaced; give another name"):
        states_file.read(path, "")


def test_states_are_taken_up_for_the_same_weather_study_and_database_alone(tmp_path):
    """One number of any of them is another case"""

    def identity(height=1.5, wind=12.0, seeds=2, mass=1.0, data=b"a"):
        (tmp_path / "box.h5").write_bytes(data)
        ready = SimpleNamespace(raw={"mass": mass}, task=SimpleNamespace(database=tmp_path / "box.h5"))
        waves = [(np.array([1.0, height]), np.array([8.0, 9.0]), np.zeros(2))]
        hindcast = SimpleNamespace(waves=waves, columns={"wind speed": np.array([3.0, wind])})
        return room._identity(SimpleNamespace(seeds=seeds, duration_hours=1.0), hindcast, ready)

    assert identity() == identity()
    others = identity(height=1.6), identity(wind=12.5), identity(seeds=3), identity(mass=2.0), identity(data=b"b")
    assert len({identity(), *others}) == 6


def test_a_result_is_asked_for_once_it_is_there_and_without_a_time_limit():
    """A limit that passes while dask fetches a result takes the fetching of all others with it"""
    looks = iter([False, False, True, True])
    future = SimpleNamespace(done=lambda: next(looks), result=lambda: 7)
    executor = SimpleNamespace(submit=lambda function: future)
    assert list(in_order_until(SimpleNamespace(asked=False), executor, [(len,)])) == [(0, 7)]


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"states": 8, "seeds": 2}, ""),
        (
            {"states": 7, "seeds": 1},
            "simulation.states is 7; allowed: 8 to 10000; simulation.seeds is 1; allowed: 2 to",
        ),
    ],
)
def test_too_few_states_and_seeds_are_refused_together(keys, says):
    tables = {
        "hindcast": {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES]},
        "simulation": {"study": "moor.toml", **keys}, "operations": OPERATIONS[1:],
    }  # fmt: skip
    with pytest.raises(StudyError, match=says) if says else nullcontext():
        make_downtime(tables)


@pytest.mark.parametrize(("after", "counts"), [(0.0, [*range(1, 17), *range(1, 5)]), (1e6, [10, 16, 4])])
def test_states_are_told_at_intervals_with_the_time_left(after, counts, made, tmp_path, monkeypatch):
    """16 states and 4 more: each one, or every tenth and the last"""
    said = []
    monkeypatch.setattr(room, "AFTER", after)
    run(made, tmp_path / "s.jsonl", monkeypatch, say=said.append)
    told = [line for line in said if " of " in line]
    assert [int(line.split()[0]) for line in told] == counts
    assert all(line.endswith(" left") != (line in ("16 of 16 states", "4 of 4 states")) for line in told)
