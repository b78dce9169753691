"""What holds of the second quantity, line, station and method of runs as of the first, of values that are made up."""

import math
import re
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.motion.simulation import Choice
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import findings, methods, over_runs, run, stations, study, work


def test_every_slow_motion_far_beyond_its_spectral_value_is_told(monkeypatch):
    """σ of surge at rest 1 m is 3 m in time, of yaw 1° is 4°; sway has no expectation"""
    values = {"surge": {"slow": 3.0, "wave": 1.0}, "sway": {"slow": 9.0, "wave": 0.0},
              "yaw": {"slow": math.radians(4.0), "wave": 0.0}}  # fmt: skip
    monkeypatch.setattr(findings, "summary_of", lambda file, name: values[name])
    file = SimpleNamespace(attrs={"hull": [100.0, 20.0, 8.0], "spectral_slow": [1.0, np.nan, math.radians(1.0)]})
    surge, yaw = findings.slow_findings(file)
    assert surge.startswith("slow surge has σ 3 m; slow forces on springs as stiff as the lines under the mean loads")
    assert "would give 1 m; first-order waves" in surge and yaw.startswith("slow yaw has σ 4 °") and "give 1 °" in yaw
    for slow, wave, told in ((2.01, 0.0, True), (1.99, 0.0, False), (2.01, 4.1, False), (2.06, 4.1, True)):
        values["surge"] = {"slow": slow, "wave": wave}
        assert ("surge" in "".join(findings.slow_findings(file))) is told, (slow, wave)
    file.attrs["spectral_slow"] = [1e-9, np.nan, 1e-9]
    values["surge"], values["yaw"] = {"slow": 1.01e-3, "wave": 0.0}, {"slow": 0.99e-5, "wave": 0.0}
    assert len(list(findings.slow_findings(file))) == 1
    values["surge"], values["yaw"] = {"slow": 0.99e-3, "wave": 0.0}, {"slow": 1.01e-5, "wave": 0.0}
    assert "yaw" in next(iter(findings.slow_findings(file)))
    del file.attrs["spectral_slow"]
    assert list(findings.slow_findings(file)) == []


@pytest.mark.parametrize(("low", "high"), [(0.6, 1.0), (0.1, 0.9), (1.1, 4.0)])
def test_a_sea_beyond_the_band_is_refused_with_a_band_that_runs_and_one_that_holds_it(low, high):
    sea = issc(1.0, mean_period=6.0)
    with pytest.raises(StudyError, match=r"allowed: 25 %; solve .* as well, or at least ") as refused:
        study._outside(sea, np.array([low, high]))
    bands = [list(map(float, pair)) for pair in re.findall(r"([\d.]+) to ([\d.]+) rad/s", str(refused.value))]
    for (first, last), most in zip(bands, (0.01, 0.25), strict=True):
        assert first <= low and last >= high
        outside = 1 - sea.moment(0, first, last) / sea.moment(0)
        assert outside < 1.02 * most and (most < 0.25 or outside > 0.9 * most)
    study._outside(sea, np.array(bands[1]))


def test_energy_outside_the_band_is_told_of_the_sea_and_of_each_swell():
    (told,) = study._outside(issc(1.0, mean_period=6.0), np.array([0.05, 1.6]), study._names(2, 1)[1])
    assert told.startswith("waves.swell[0]: ") and "of the wave energy lies outside" in told
    assert study._names(2, 1) == ("waves: ", "waves.swell[0]: ", "simulation.sea[0]: ")


class File(dict):
    """A file of runs with statistics (runs, q, largest alone) of named quantities"""

    def __init__(self, names, largest, **more):
        rows = np.zeros((len(largest), len(names), len(over_runs.STATISTICS)))
        rows[:, :, over_runs.STATISTICS.index("largest")] = largest
        super().__init__({"quantity": SimpleNamespace(asstr=lambda: np.array(names)), "statistics": rows} | more)
        self.attrs = {"allowable": 0.6, "seeds_differ": True}


def test_snaps_of_lines_and_hits_of_fenders_in_few_runs_are_both_told(monkeypatch):
    """Beyond twice the median of five runs: bow in two, D1 in one"""
    monkeypatch.setattr(over_runs, "whole_rows", lambda file: np.array([True] * 5 + [False]))
    monkeypatch.setattr(over_runs, "told", lambda file: [])
    names = ["surge", "tension bow", "tension stern", "deflection D1"]
    runs = [[9, 1, 1, 1], [0, 1, 1.9, 1], [0, 1, 1, 1], [0, 2.1, 1, 2.1], [0, 3, 1, 1], [0, 99, 99, 99]]
    snap, hit = over_runs.rare_findings(File(names, runs))
    assert snap == (
        "lines that snap taut in few runs: in some (bow in 2 of 5) the largest tension exceeds 2 times its median over "
        "all runs, and the next run may far exceed the simulated values; use longer lines or more pretension"
    )
    monkeypatch.setattr(over_runs, "told", lambda file: ["left out: inertia and drag of lines bow"])
    moved, _ = over_runs.rare_findings(File(names, runs))  # static lines: no size or pretension is advised for a snap
    assert moved == snap.rpartition("; ")[0] + "; " + over_runs.MOVE
    assert hit.startswith(
        "fenders that are hit in few runs: in some (D1 in 1 of 5) the largest deflection exceeds 2 times its"
    )
    assert "(D1 in 1 of 5)" in hit and hit.endswith("; run more seeds to see how often")
    largest, parts = over_runs.largest_in_runs(File(names, runs), "tension")
    assert parts == ["bow", "stern"] and largest.tolist() == [row[1:3] for row in runs[:5]]


def test_the_line_with_the_largest_share_of_its_load_is_told_not_that_with_the_largest_tension(monkeypatch):
    monkeypatch.setattr(over_runs, "whole_rows", lambda file: np.array([True, True, False]))
    runs, line = [[3e5, 2e5], [4e5, 1e5], [9e6, 9e6]], SimpleNamespace(asstr=lambda: np.array(["bow", "stern"]))
    names = ["tension bow", "tension stern"]
    for used, says in (
        ([[0.1, 0.2], [0.15, 0.5], [9, 9]], "200 kN in stern, 50 % of its breaking load (allowable 60 %)"),
        ([[np.nan] * 2] * 3, "400 kN in bow, its utilisation is unknown, since no breaking load is given"),
    ):
        (said,) = over_runs.most_loaded(File(names, runs, used=np.array(used), line=line))
        assert said == f"largest tension: {says}"
    composite = File(names, runs, used=np.array([[0.1, 0.5]] * 3), line=line)
    composite.attrs["weakest_segments"] = '{"stern": ["chain", 4e5]}'
    assert next(iter(over_runs.most_loaded(composite))).endswith("60 %), that of its weakest segment, chain, 400 kN")
    assert not list(over_runs.most_loaded(File(["surge"], [[1.0]] * 3)))


@pytest.mark.parametrize(
    ("runs", "differ", "says"),
    [
        (
            1,
            True,
            "the largest is the largest value in 1 run; "
            "with 90 % confidence, no more than 90 % of further runs exceed it; "
            "run 5 seeds for",
        ),
        (
            4,
            True,
            "the largest is the largest value in 4 runs; "
            "with 90 % confidence, no more than 44 % of further runs exceed it",
        ),
        (
            5,
            True,
            "the median extreme is exceeded by half of such runs, and its interval holds for any distribution "
            "of the largest",
        ),
        (5, False, "seeds do not differ, since there are no random waves or gusts: every run has the same largest and"),
    ],
)
def test_what_the_largest_of_runs_means_is_told_with_how_many_exceed_it(monkeypatch, runs, differ, says):
    """1 − 0.1^(1/n): 90 % of one run, 44 % of four, 37 % of five"""
    monkeypatch.setattr(over_runs, "whole_rows", lambda file: np.ones(runs, bool))
    file = File([], [[]])
    file.attrs["seeds_differ"] = differ
    (said,) = over_runs.notes(file)
    assert said.startswith(says)
    if runs == 5 and differ:
        assert said.endswith(
            "the largest value in 5 runs; with 90 % confidence, no more than 37 % of further runs exceed it"
        )


def test_every_station_of_a_beam_has_its_deflection_and_loads_beside_each_other(monkeypatch):
    def of_station(reader, motion, one):
        still = np.ndim(motion) == 1
        return [(f"{word} {reader.name}", unit, None if still else one.x * motion[:, 0] + i)
                for i, (word, unit) in enumerate((("sag", "m"), ("moment", "N m")))]  # fmt: skip

    monkeypatch.setattr(stations, "of_station", of_station)
    reader, motion = SimpleNamespace(name="r", words=["a", "b"]), np.array([[1.0, 9.0], [2.0, 9.0], [3.0, 9.0]])
    two = [SimpleNamespace(name="fore", x=10.0), SimpleNamespace(name="aft", x=-1.0)]
    found = stations.loads_along(reader, two, motion)
    assert found.tolist() == [[10, 11, -1, 0], [20, 21, -2, -1], [30, 31, -3, -2]]
    assert stations.told_of_stations(reader, two) == [
        ("fore sag r", "m"), ("fore moment r", "N m"), ("aft sag r", "m"), ("aft moment r", "N m")]  # fmt: skip
    assert stations.loads_along(reader, [], motion).shape == (3, 0) and stations.told_of_stations(reader, []) == []


def test_stations_are_those_of_the_study_or_the_middle_of_every_beam():
    from hakobune.bem.flexible.beams import Beam

    def beam(start, end):
        return Beam("vertical", 1, start, end, 0.0, 1e9, 1e3)

    modes = [
        SimpleNamespace(body=0, shape=beam(-50.0, 60.0), turns=False),
        SimpleNamespace(body=0, shape=None, turns=True),
        SimpleNamespace(body=1, shape=beam(-20.0, 20.0), turns=False),
    ]
    db = SimpleNamespace(modes=modes, bodies=[SimpleNamespace(name="ship"), SimpleNamespace(name="barge")])
    study = SimpleNamespace(simulation=None)
    found = stations.stations_of(study, db)
    assert [tuple(one)[:3] for one in found] == [("ship x 5", 5.0, "ship"), ("barge x 0", 0.0, "barge")]
    db.bodies = ()
    db.modes = modes[:2]
    assert [tuple(one)[:3] for one in stations.stations_of(study, db)] == [("x 5", 5.0, "")]
    assert stations.units_of_shapes(db) == ("m", "rad")
    asked = []
    table = SimpleNamespace(stations=lambda where, db: asked.append(where) or [where])
    study.simulation = SimpleNamespace(stations=[table, table])
    assert stations.stations_of(study, db) == asked == ["simulation.stations[0]", "simulation.stations[1]"]


@pytest.mark.parametrize(("fresh", "seeds", "today", "made"), [
    (False, [1, 2], True, None), (False, [1, 3, 5], True, [1, 2, 3, 5]), (False, [2], False, [1, 2]),
    (True, [7], True, "new"), (None, [7], True, "new"),
])  # fmt: skip
def test_a_file_of_runs_is_widened_for_further_seeds_and_kept_as_it_is_for_those_it_has(
    monkeypatch, tmp_path, fresh, seeds, today, made
):
    from contextlib import contextmanager

    old, created = {"seed": {(): np.array([1, 2])}, "kept_seed": np.zeros(3)}, []  # as h5py, whose [()] is all

    @contextmanager
    def opened(path):
        yield old

    monkeypatch.setattr(run, "opened", opened)
    monkeypatch.setattr(run, "create", lambda *given: created.append(given))
    monkeypatch.setattr(run, "summary_is_of_today", lambda path: today)
    path = tmp_path / "r.h5"
    if fresh is not None:
        path.touch()
    plan = SimpleNamespace(seeds=seeds, keep_series=1)
    run._make_room(path, "header", plan, bool(fresh))
    if made is None:
        assert created == []
    elif made == "new":
        assert created == [(path, "header", [7], 1)]
    else:
        more = [1, 2, *[seed for seed in seeds if seed not in (1, 2)]]
        assert created == [(path, "header", more, 3, old)]


@dataclass(frozen=True)
class Settings:
    dynamic_lines: object = ()
    memory: str = "states"
    constant_period: float | None = None
    step: float = 0.5


@pytest.mark.parametrize(("moving", "asked", "able", "wanted"), [
    (("a",), "auto", True, Choice(Settings(("a",)))), ((), "auto", True, Choice(Settings(()))),
    (None, "auto", True, "chosen"), (None, (), True, ("static", "left")), (None, (), False, ("left",)),
])  # fmt: skip
def test_lines_in_motion_are_those_of_the_task_or_of_a_trial_or_none_with_the_reason(
    monkeypatch, moving, asked, able, wanted
):
    from hakobune.mooring.motion import simulation

    given = []
    monkeypatch.setattr(simulation, "with_lines_chosen", lambda *all: given.append(all) or "chosen")
    monkeypatch.setattr(simulation, "able_to_move", lambda *all: given.append(all) or (able, ("left",)))
    monkeypatch.setattr(work, "STATIC", "static")
    body = SimpleNamespace(system="system", reader=SimpleNamespace(modes=[1]))
    plan = SimpleNamespace(settings=Settings(asked), weather="weather")
    found = work._lines_chosen(SimpleNamespace(moving=moving), body, plan)
    if isinstance(wanted, tuple) and not isinstance(wanted, Choice):
        assert found == Choice(plan.settings, (), wanted) and given == [("system", plan.settings)]
    else:
        assert found == wanted and given == ([(body, "weather", plan.settings)] if wanted == "chosen" else [])


def test_methods_side_by_side_have_amplitudes_and_periods_in_their_columns(monkeypatch):
    """A method that is refused has blanks and a line; the natural period of the berth is the first that is known"""
    body = SimpleNamespace()
    plan = SimpleNamespace(mean_period=9.0, seeds=[4, 5])
    monkeypatch.setattr(methods, "input_of", lambda study: SimpleNamespace(study=study, folder="f"))
    monkeypatch.setattr(methods, "database_of", lambda db: SimpleNamespace(path="b.h5", bodies=()))
    monkeypatch.setattr(methods.work, "Task", lambda *given: given)
    monkeypatch.setattr(methods.work, "prepared", lambda task, db: (body, plan, ()))
    monkeypatch.setattr(methods, "periods_at_berth", lambda body: np.array([np.nan, 80.0, 60.0]))
    monkeypatch.setattr(methods, "_divided", lambda study, body, path: ("divided", path))
    asked = []

    def row(one, plan, changed, seed):
        asked.append((one, changed, seed))
        if len(asked) == 3:
            raise ValueError("it  has\nno memory")
        return np.array([[1.0, 2.0, 3.0], [10.0, 20.0, 30.0]]) * len(asked)

    monkeypatch.setattr(methods, "_row", row)

    @dataclass
    class Made:
        quantities: dict
        labels: dict
        findings: tuple

    made = methods.compared(Made({"a": 1}, {"b": 2}, ("c",)), "study", "db", division="d.h5")
    names = ["1 memory, divided box", "2 memory", "3 constant, 10 s", "4 constant, 80 s"]
    assert made.labels["method"].values.tolist() == names and made.labels["b"] == 2
    assert made.findings == ("c", "3 constant, 10 s: it has no memory")
    nan, title = np.nan, "seed 4 by four methods, significant amplitudes"
    for k, (name, unit) in enumerate((("surge", "m"), ("sway", "m"), ("yaw", "rad")), 1):
        one, period = made.quantities[f"method.{name}"], made.quantities[f"method.{name}_period"]
        assert one.values == pytest.approx(np.array([1, 2, nan, 4]) * k, nan_ok=True)
        assert period.values == pytest.approx(np.array([10, 20, nan, 40]) * k, nan_ok=True)
        assert (one.unit, one.description, one.table) == (unit, name, title)
        assert (period.unit, period.description, period.table) == ("s", f"period of {name}", title)
    states = {"memory": "states", "constant_period": None}
    assert [(one, changed) for one, changed, _ in asked] == [
        (("divided", "d.h5"), states), (body, states), (body, {"memory": "constant", "constant_period": 10.0}),
        (body, {"memory": "constant", "constant_period": 80.0}),
    ]  # fmt: skip
    assert {seed for *_, seed in asked} == {4}


@pytest.mark.parametrize(
    ("memory", "states", "anew"), [("states", [1], False), ("states", [], True), ("constant", [], False)]
)
def test_a_method_is_run_after_the_ramp_and_rounding_is_no_motion(monkeypatch, memory, states, anew):
    from hakobune.mooring.motion import simulation

    asked = []
    time = np.arange(-2.0, 3.0, 0.5)
    motion = np.column_stack([time, 2 * time])

    def simulate(body, weather, settings, seed):
        asked.append((body, weather, settings, seed))
        return SimpleNamespace(time=time, motion=motion)

    def windows(late, step, length):
        asked.append((late, step, length))
        return SimpleNamespace(
            amplitude=np.array([[2e-6, 0.9e-6, math.radians(0.9e-6)]]), period=np.array([[1.0, 2.0, 3.0]])
        )

    monkeypatch.setattr(simulation, "simulate", simulate)
    monkeypatch.setattr(simulation, "with_memory", lambda body: "with memory")
    monkeypatch.setattr(methods, "windows", windows)
    body = SimpleNamespace(memory=SimpleNamespace(states=states))
    plan = SimpleNamespace(settings=Settings(), weather="weather")
    found = methods._row(body, plan, {"memory": memory, "constant_period": 8.0}, 3)
    assert found.tolist() == [[2e-6, 0, 0], [1, 2, 3]]
    (given, weather, settings, seed), (late, step, length) = asked
    assert given == ("with memory" if anew else body) and (weather, seed) == ("weather", 3)
    assert settings == replace(Settings(), memory=memory, constant_period=8.0)
    assert late[:, 0].tolist() == time[time >= 0].tolist() and (step, length) == (0.5, 2.5)


@pytest.mark.parametrize(
    ("method", "centre", "depth", "says"),
    [
        ("contour", (0, 0, 1), 20.0, None),
        ("panel", (0, 0, 1), 20.0, "--division is d.h5, solved by the panel method; allowed: contour"),
        ("contour", (0, 0, 1.1), 20.0, "--division is d.h5, whose depth or rotation centre differs"),
        ("contour", (0, 0, 1), 21.0, "--division is d.h5, whose depth or rotation centre differs"),
    ],
)
def test_the_divided_box_has_the_mass_and_springs_of_the_ship(monkeypatch, method, centre, depth, says):
    from hakobune.bem import database
    from hakobune.mooring.motion import simulation

    @dataclass(frozen=True)
    class Water:
        rotation_center: tuple = (0, 0, 1)
        depth: float = 20.0
        inertia: str = "box"
        stiffness: str = "box"
        viscous: str | None = "box"
        own: bool = True

    sizes = []
    db = SimpleNamespace(attributes={"method": method}, sizes="sizes", reader=Water(centre, depth))
    monkeypatch.setattr(database, "open_database", lambda path: db)
    monkeypatch.setattr(simulation, "moored", lambda *given, **more: (given, more))
    here = Water(inertia="ship", stiffness="ship")
    body = SimpleNamespace(reader=here, system="lines", hull="hull", spring=1, damping=2, quadratic=3, berth=4)
    study = SimpleNamespace(hull_of=sizes.append)
    if says:
        with pytest.raises(StudyError, match=says.replace(".", r"\.")):
            methods._divided(study, body, "d.h5")
        return
    (water, *given), more = methods._divided(study, body, "d.h5")
    assert water == Water((0, 0, 1), 20.0, "ship", "ship", None, False) and given == ["lines", "hull"]
    assert more == {"spring": 1, "damping": 2, "quadratic": 3, "berth": 4} and sizes == ["sizes"]


@pytest.mark.parametrize(("seed", "kept", "known", "place"), [
    (5, 0, {"a": 1}, 1), (5, 1, {"a": 1}, 1), (5, 2, {"a": 1}, None), (5, 2, {"motion": 1}, 1), (4, 1, {"a": 1}, None),
    (9, 0, {"a": 1}, None),
])  # fmt: skip
def test_a_row_of_a_seed_is_taken_over_unless_its_record_is_wanted_and_lacking(monkeypatch, seed, kept, known, place):
    from hakobune.pipelines.simulate import file

    written = []
    monkeypatch.setattr(file, "row_values", lambda old, row: known)
    monkeypatch.setattr(file, "put", lambda *given: written.append(given))
    old, new = {"seed": [3, seed]}, {"seed": {(): np.array([4, 5, 6])}, "kept_seed": np.zeros(kept)}
    file._take_over(old, new, 1)
    assert written == ([] if place is None else [(new, place, known)])
