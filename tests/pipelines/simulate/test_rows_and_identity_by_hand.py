"""What a file of runs depends on, a row of a seed, pairs of waves, what runs use and how they are read: by hand."""

import hashlib
import json
from dataclasses import dataclass
from types import SimpleNamespace

import h5py
import msgspec
import numpy as np
import pytest

from hakobune.bem.database.integrity import DatabaseError
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate import beside, over_runs, result, run, work

# ------------------------------------------------------------------ identity

WATER = {"water": {"depth": 20.0}}
LINES = {"lines": [{"name": "a", "type": "chain", "fairlead": [1.0, 0.0, 0.0], "anchor": [90.0, 0.0], "length": 100.0}]}


def asked(*tables, **simulation):
    """The study of tables, with a [simulation] of these words"""
    raw = WATER | {key: value for table in tables for key, value in table.items()}
    return make_study(raw | ({"simulation": simulation} if simulation else {}))


@pytest.mark.parametrize(
    ("study", "wanted"),
    [
        (asked(), {}),
        (asked(seeds=99, duration_hours=3.0, keep_series=0), {"simulation": {}}),
        (asked(tolerance=1e-4, dynamic_lines="all", dynamic_elements=7), {"simulation": {"tolerance": 1e-4}}),
        (asked({"harbour": {"periods": [60.0]}}, seeds=4), {"simulation": {}}),
        (asked({"hull": {"freeboard": 5.0}, "hinges": []}), {"hull": {"freeboard": 5.0}}),
    ],
)
def test_results_depend_on_what_a_study_gives_and_a_key_at_its_default_changes_no_hash(tmp_path, study, wanted):
    (tmp_path / "a.csv").write_bytes(b"forces")
    by_hand = hashlib.sha256(json.dumps([WATER | wanted, 60.0], sort_keys=True).encode())
    by_hand.update(hashlib.sha256(b"forces").digest())
    assert run._identity(study, [tmp_path / "a.csv"], 60.0) == f"{run.IDENTITY} {by_hand.hexdigest()}"


def test_lines_that_move_are_part_of_what_runs_are_where_there_are_lines():
    still, ten, twenty, trial = (
        run._identity(asked(LINES, dynamic_lines=which, dynamic_elements=count), [], 60.0)
        for which, count in (("none", 10), ("all", 10), ("all", 20), ("auto", 20))
    )
    fewer = run._identity(asked(LINES, dynamic_lines="none", dynamic_elements=20), [], 60.0)
    assert still == fewer and len({still, ten, twenty, trial}) == 4


def test_runs_of_an_earlier_version_are_not_continued_and_the_line_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(run, "opened", h5py.File)
    with h5py.File(tmp_path / "run.h5", "w") as file:
        file.attrs["identity"] = "0" * 64
    with pytest.raises(DatabaseError, match=r"run\.h5 was made by an earlier version, .* --fresh to run them again"):
        run._missing(tmp_path / "run.h5", run._identity(asked(), [], 60.0), SimpleNamespace(seeds=(1,)), False)


# ------------------------------------------------------------------ pairs of waves beside Newman's rule


@dataclass(frozen=True)
class Weather:
    seas: tuple = ("first", "second")
    beside_newman: tuple = ()


@dataclass(frozen=True)
class Plan:
    settings: SimpleNamespace
    weather: Weather = Weather()


@pytest.fixture
def pairs(monkeypatch):
    where = "hakobune.mooring.response."
    monkeypatch.setattr(f"{where}bound_wave_drift.left_out", lambda body, sea, *way: [f"{sea} lacks", *way])
    known = {"first": (None, ("left out: said",)), "second": ("forces", ("told",))}
    monkeypatch.setattr(f"{where}pair_levels.beside_newman", lambda db, sea, level, spread: known[sea])

    def call(level, drift="newman", bodies=(), quay=None, seas=("first", "second")):
        monkeypatch.setattr(work, "level_of_pairs", lambda study, there, slow: level)
        db, reader = SimpleNamespace(bodies=bodies, modes=(), path="a.h5"), SimpleNamespace(floating=lambda: None)
        plan = Plan(SimpleNamespace(slow_drift=drift), Weather(seas))
        made, said = work.with_pairs(plan, SimpleNamespace(quay=quay), db, reader)
        return made.weather.beside_newman, tuple(said)

    return call


def test_pairs_are_of_each_sea_and_what_is_left_out_is_told_once_with_the_way_out(pairs):
    assert pairs("auto") == ([None, "forces"], ("left out: said", "told"))
    way = ("first lacks", "second lacks")
    assert pairs("newman") == ([None, None], way)
    assert pairs("newman", quay=1) == (
        [None, None], ("first lacks", "in front of a quay only Newman's approximation is available", "second lacks"),
    )  # fmt: skip
    assert pairs("newman", drift="none") == ([None, None], ())
    assert (
        "'hakobune qtf a.h5' stores them"
        in work._way(SimpleNamespace(quay=None), SimpleNamespace(path="a.h5"), "auto")[0]
    )


def test_pairs_of_several_bodies_are_of_each_or_left_out(pairs, monkeypatch):
    known = {"first": (("of a", "of b"), ("told",)), "second": (None, ())}
    where = "hakobune.mooring.response.pair_levels.beside_newman_of_bodies"
    monkeypatch.setattr(where, lambda db, sea, level: known[sea])
    found, said = pairs("auto", bodies=("a", "b"))
    assert found == [("of a", "of b"), None] and said[0] == "told" and said[1].startswith("left out: the slow force")
    assert pairs("auto", drift="none", bodies=("a", "b"))[1] == () == pairs("auto", seas=(), bodies=("a", "b"))[1]
    with pytest.raises(StudyError, match=r"simulation\.qtf is 'squares' with several bodies"):
        pairs("squares", bodies=("a", "b"))


# ------------------------------------------------------------------ what runs use


@pytest.fixture
def file(monkeypatch):
    """Three lines in four whole runs and a broken one; allowed is half of the breaking load"""
    used = np.array([[0.2, 0.51, 1.2], [0.3, 0.7, 0.4], [9.0, 9.0, 9.0], [0.4, 0.3, 1.1], [0.1, np.nan, 0.2]])
    made = {"used": {(): used}, "line": SimpleNamespace(asstr=lambda: {(): np.array(["a", "b", "c"])})}
    file = type("File", (dict,), {"attrs": {"allowable": 0.5}})(made)
    monkeypatch.setattr(over_runs, "whole_rows", lambda file: np.array([True, True, False, True, True]))
    monkeypatch.setattr(over_runs, "told", lambda file: ())
    return file


def test_lines_that_part_and_lines_beyond_what_is_allowable_are_told_with_the_runs_they_do_it_in(file, monkeypatch):
    used = file["used"][()]
    used[4, 1] = 0.45
    parts, over = map(str, over_runs.overloads(file))
    assert (
        "1 of 3 lines in the runs beyond the breaking load, limit 100 %, at which they break: c 120 % in 2 of 4 runs"
        in parts
    )
    assert "1 more of 3 lines in the runs above the allowable 50 % of the breaking load: b 70 % in 2 of 4 runs" in over
    assert len(list(over_runs.overloads(file, 1.0))) == 1 and over_runs.MOVE not in parts
    monkeypatch.setattr(over_runs, "told", lambda file: (f"{over_runs.OF_LINES} of the lines",))
    assert all(over_runs.MOVE in str(line) for line in over_runs.overloads(file))
    assert over_runs.used_in_runs(file)[:, 0].tolist() == [0.2, 0.3, 0.4, 0.1]


def test_advice_on_a_rope_is_not_that_on_a_chain(file):
    file["used"][()][4, 1] = 0.45
    file.attrs = {"allowable": 0.5, "study": '[[rope]]\nname = "c"\n'}
    rope, chain = map(str, over_runs.overloads(file))
    assert "c 120 %" in rope and over_runs.SOFTER in rope and "longer line" not in rope
    assert "b 70 %" in chain and over_runs.HELP in chain


# ------------------------------------------------------------------ the simplified method beside


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ({"at_berth": True}, ""), ({"quay": 1}, "does not cover quay"),
        ({"lines": ()}, "does not cover body without lines"),
        ({"fault": "it\n drifts"}, "method does not work here: it drifts"),
    ],
)  # fmt: skip
def test_where_the_simplified_method_has_no_answer_it_says_so(monkeypatch, more, says):
    def refused(*_):
        raise ValueError(more["fault"])

    monkeypatch.setattr(beside, "multi_point", refused)
    found = beside.simplified(study_of(**more), SimpleNamespace(bodies=()))
    assert (
        (says in found.findings[0] if says else found.findings == ())
        and not found.tension.size
        and not found.utilisation.size
    )
    assert np.isnan([*found.period, *found.slow]).all() and found.period.shape == found.slow.shape == (3,)


def study_of(at_berth=False, quay=None, lines=("a",), **_):
    return SimpleNamespace(
        at_berth=at_berth, quay=quay, lines=lines, spreads=(), hinges=(), allowable=0.5, wind=None,
        hulls_of=lambda db: "hull", system_of=lambda db, hull: (db, hull), conditions=lambda: None,
    )  # fmt: skip


def test_the_simplified_method_has_periods_of_the_plane_and_slow_motion_of_one_body(monkeypatch):
    state = SimpleNamespace(names=("Sway", "Yaw", "Heave", "Surge"), period=np.array([60.0, 40.0, 8.0, 90.0]))
    found = SimpleNamespace(tension=np.array([1.0]), utilisation=np.array([0.3]), at_equilibrium=state)
    monkeypatch.setattr(beside, "multi_point", lambda *_: found)
    monkeypatch.setattr(beside, "_slow", lambda *_: np.array([1.0, 2.0, 3.0]))
    made = beside.simplified(study_of(), SimpleNamespace(bodies=()))
    assert made.period.tolist() == [90.0, 60.0, 40.0] and made.slow.tolist() == [1.0, 2.0, 3.0]
    state.names = ("Sway", "Pitch", "Heave", "Surge")
    assert np.isnan(beside.simplified(study_of(), SimpleNamespace(bodies=())).period[2])
    several = beside.simplified(study_of(), SimpleNamespace(bodies=("a", "b")))
    assert several.utilisation.tolist() == [0.3] and np.isnan([*several.period, *several.slow]).all()


def test_a_berth_of_several_bodies_has_its_fenders_alone(monkeypatch):
    for name in ("periods_at_berth", "by_design_spectrum", "body_of"):
        monkeypatch.setattr(beside, name, lambda *_: [60.0])
    monkeypatch.setattr(beside, "check_harbour", lambda periods: periods)
    fender = SimpleNamespace(fender=SimpleNamespace(height=2.0, own_allowable=0.5, rated_reaction=7e5))
    body = SimpleNamespace(berth=SimpleNamespace(fenders=[fender]), hull=None)
    study = SimpleNamespace(harbour=SimpleNamespace(periods=[90.0]))
    alone = beside.of_berth(study, SimpleNamespace(bodies=()), body)
    assert alone["natural_period"] == [60.0] and alone["harbour_period"] == [90.0]
    both = beside.of_berth(study, SimpleNamespace(bodies=("a", "b")), body)
    strains, own = both.pop("fender_strains"), {"fender_height": [2.0], "fender_allowable": [0.5]}
    assert both == own | {"fender_rated_reaction": [7e5]} and strains == "[[[0.0, 1.0], [0.0, 1.0]]]"


# ------------------------------------------------------------------ a row of a seed


def test_a_row_has_statistics_after_the_ramp_in_the_order_of_its_quantities(monkeypatch):
    """Two samples of ramp and two after it; ropes behind lines, each fender's depth beside its push"""
    time = np.array([-2.0, -1.0, 0.0, 1.0])

    def ramped(*last):
        return np.array([[9e9] * len(last)] * 2 + [list(last), list(last)])

    class Run(msgspec.Struct):
        time: object
        motion: object
        wave: object
        wind_speed: object
        tension: object
        pull: object
        deflection: object
        reaction: object
        poses: object
        estimated_error: float = 0.5
        steps: int = 7
        findings: tuple = ("found",)
        links: object = None

        def _replace(self, **more):
            return msgspec.structs.replace(self, **more)

    made = Run(time, ramped(1, 2, 3, 4, 5, 6), ramped(7)[:, 0], ramped(8)[:, 0], ramped(10), ramped(11),
               ramped(12, 14), ramped(13, 15), None)  # fmt: skip
    seen, task = [], SimpleNamespace(study=SimpleNamespace(anchors=None))

    def statistics(columns, step, split, duration):
        seen.extend((column.tolist(), step, split, duration) for column in columns)
        return [SimpleNamespace(sigma=column[0]) for column in columns]

    reader = SimpleNamespace(words=("surge",) * 6, links=(), rigid=6, radius=50.0, inertia=np.diag([2.0]), gravity=10.0)
    settings = SimpleNamespace(step=0.5, lines_lost=())
    plan = SimpleNamespace(weather=SimpleNamespace(regular=None), settings=settings, split=0.3,
                           mean_period=8.0, sides=(), shapes=(), stations=())  # fmt: skip
    monkeypatch.setattr("hakobune.mooring.motion.simulation.simulate", lambda *_: made)
    body = SimpleNamespace(reader=reader, system=None, start=np.zeros(6))
    monkeypatch.setattr(work, "prepared", lambda task: (body, plan, None))
    monkeypatch.setattr(work, "statistics_of_records", statistics)
    monkeypatch.setattr(work, "gaps", lambda sides, poses: ramped(9))
    monkeypatch.setattr(work, "_of_gaps", lambda sides, apart: (f"{len(apart)} samples",))
    monkeypatch.setattr(work, "stillness", lambda sigma, units, length, weight: [length, weight] + [0.0] * 13)
    monkeypatch.setattr(work, "without_rounding", lambda one, still: [one.sigma, still])
    monkeypatch.setattr(work, "largest_use", lambda body, motion, tension: [len(motion), *tension[0]])
    row = work.simulate_seed(task, 1, False)
    assert [one[0] for one in seen] == [[k, k] for k in range(1, 16)] and seen[0][1:] == (0.5, 0.3, 8000.0)
    assert row["statistics"][:3].tolist() == [[1, 100.0], [2, 20.0], [3, 0.0]]
    assert row["used"] == [2, 10, 11] and row["steps"] == 7.0 and row["findings"] == b"found\n2 samples"
    plan.weather.regular = 1
    work.simulate_seed(task, 1, False)
    assert seen[-1][3] == 0.0
    plan.weather.regular, plan.mean_period = None, None
    work.simulate_seed(task, 1, False)
    assert seen[-1][3] is None
    made.motion[3, 2] = np.nan
    with pytest.raises(ValueError, match="not finite"):
        work.simulate_seed(task, 1, False)


@pytest.mark.parametrize("error", [None, ValueError])
def test_workers_are_let_go_without_waiting_whether_runs_are_made_or_not(monkeypatch, tmp_path, error):
    said, outcome = [], SimpleNamespace(interrupted=False, failures=[(7, "the line is too short")])

    def made(*_):
        if error:
            raise error("no")
        return outcome

    workers = SimpleNamespace(shutdown=lambda **words: said.append(words))
    monkeypatch.setattr(result, "executor_of", lambda name: workers)
    monkeypatch.setattr(result, "fill", made)
    monkeypatch.setattr(result, "input_of", str)
    monkeypatch.setattr(result, "database_of", str)
    monkeypatch.setattr(result, "read_run", lambda *given: given)
    if error:
        with pytest.raises(error):
            result.simulate("a.toml", "a.h5", tmp_path / "run.h5")
    else:
        path, window, failed = result.simulate("a.toml", "a.h5", tmp_path / "run.h5", window=3.0)
        assert (path, window, len(failed)) == (tmp_path / "run.h5", 3.0, 1)
        assert "7" in str(failed[0]) and "too short" in str(failed[0])
        outcome.interrupted = True
        with pytest.raises(KeyboardInterrupt):
            result.simulate("a.toml", "a.h5", tmp_path / "run.h5")
    assert said == [{"wait": False, "cancel_futures": True}] * (1 if error else 2)


@pytest.mark.parametrize("known", [[1.0, 2.0], [np.nan, 2.0], [np.nan, np.nan]])
def test_extremes_are_printed_where_one_of_them_is_known(known):
    """Of the end that is further from 0, upper where both are as far; units of each record, of periods always s"""
    low, high = [-9.0, 1.0], [3.0, 4.0]
    rows = []
    for a, b, one in zip(low, high, known, strict=True):
        ends = {f"{end}_{part}": size * one for end, size in (("lower", a), ("upper", b)) for part in result.END}
        rows.append(dict.fromkeys(result.WORDS, 1.0) | ends)
    made = result._statistics("record", "table", "record", rows, ["m", "rad"])
    wanted = [a if abs(a * one) > abs(b * one) else b for a, b, one in zip(low, high, known, strict=True)]
    for part, words in result.END.items():
        one = made[f"record.extreme_{part}"]
        assert one.values == pytest.approx(np.multiply(wanted, known), nan_ok=True) and one.description == words
        assert bool(one.table) != bool(np.isnan(known).all()) and one.unit == ("m", "rad")
    assert made["record.T_zero"].unit == "s" and made["record.mean"].unit == ("m", "rad")
    assert [bool(made[f"record.{name}"].table) for name in result.WORDS] == [
        shown for _, _, shown in result.WORDS.values()
    ]
