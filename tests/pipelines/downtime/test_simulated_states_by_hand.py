"""How simulated states of an hour are made, kept and put together, with bodies and runs that are made up."""

import math
import os
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import command, moored, one_state, passages, simulated, states_file
from hakobune.pipelines.downtime.study import _system
from hakobune.pipelines.downtime.tables import AlternativeTable, WavesColumns
from hakobune.pipelines.simulate.work import Task

TIME = np.datetime64("2001-01-01T00", "s") + np.timedelta64(3, "h") * np.arange(4)


def record(height=(2.0, 0.0, math.nan, 1.0), columns=(), planes=None, systems=1):
    wave = SimpleNamespace(height=np.array(height), period=np.array([8.0, 6.0, 4.0, 10.0]),
                           direction=np.radians([10.0, 20.0, 30.0, 40.0]))  # fmt: skip
    shape = SimpleNamespace(family="jonswap", kind="peak_period", gamma=3.3)
    hindcast = SimpleNamespace(time=TIME, waves=[wave] * systems, columns=dict(columns), said=("of ice",), hours=3.0)
    return SimpleNamespace(hindcast=hindcast, shapes=[shape] * systems, planes=planes)


def study(x_axis=30.0, waves=()):
    return SimpleNamespace(hindcast=SimpleNamespace(waves=list(waves), x_axis_compass_deg=x_axis))


# ------------------------------------------------------------------ weather of an hour


def test_the_sea_of_an_hour_is_that_of_its_numbers_and_a_calm_one_nearly_none():
    """A calm has the median period of all hours, 7 s; without columns of waves the spreading is cos⁴"""
    found = simulated._weather(study(), record(), 0)["waves"]
    assert found == {"height": 2.0, "spectrum": "jonswap", "peak_period": 8.0, "direction_deg": pytest.approx(10.0),
                     "gamma": 3.3, "spreading": "cosine:4"}  # fmt: skip
    calm = simulated._weather(study(), record(), 1)["waves"]
    assert (calm["height"], calm["peak_period"]) == (simulated.QUIET, 7.0)
    two = simulated._weather(
        study(waves=[WavesColumns("h", spreading="cosine:2"), WavesColumns("h")]), record(systems=2), 3
    )
    assert two["waves"]["spreading"] == "cosine:2" and "spreading" not in two["waves"]["swell"][0]
    assert two["waves"]["height"] == 1.0 and len(two["waves"]["swell"]) == 1


@pytest.mark.parametrize("stream, ends, way, towards", [
    ("wind", "from", 0.0, 210.0), ("wind", "from", 90.0, 120.0), ("current", "to", 90.0, 300.0),
    ("current", "to", 0.0, 30.0), ("current", "to", 40.0, 350.0),
])  # fmt: skip
def test_streams_go_in_axes_of_a_body_by_its_heading_and_compass(stream, ends, way, towards):
    """x axis to 30° of the compass, anticlockwise: what goes to 30° goes along x; wind from 30° goes to −x"""
    columns = {f"{stream} speed": np.array([5.0, math.nan, 7.0, 8.0]), f"{stream} {ends}": np.radians(np.full(4, way))}
    found = simulated._weather(study(), record(columns=columns), 0)
    assert found[stream] == {"speed": 5.0, "direction_deg": pytest.approx(towards)}
    assert simulated._weather(study(), record(columns=columns), 1)[stream]["speed"] == 0.0
    assert stream not in simulated._weather(study(), record(), 0)


def test_an_hour_of_a_plane_is_named_by_its_file_and_minute_but_for_a_calm(tmp_path):
    planes = SimpleNamespace(path=lambda row: tmp_path / f"{row}.nc", location=None)
    found = simulated._weather(study(), record(planes=planes), 3)["waves"]
    assert found == {"file": str((tmp_path / "3.nc").resolve()), "time": "2001-01-01T09:00", "location": 1,
                     "x_axis_compass_deg": 30.0}  # fmt: skip
    planes.location = 4
    assert simulated._weather(study(), record(planes=planes), 0)["waves"]["location"] == 4
    assert "file" not in simulated._weather(study(), record(planes=planes), 1)["waves"]


def test_numbers_of_hours_have_both_streams_where_they_are_whole():
    columns = {"wind speed": np.array([5.0, math.nan, 7.0, 8.0]), "wind from": np.array([0.1, 0.2, math.nan, 0.4]),
               "current speed": np.ones(4)}  # fmt: skip
    numbers, angles = simulated.columns_of(record(columns=columns).hindcast, np.array([0, 1, 3]))
    assert [one.tolist() for one in numbers] == [
        [2.0, simulated.QUIET, 1.0], [8.0, 7.0, 10.0], [5.0, 0.0, 8.0],
    ]  # fmt: skip
    assert angles[0] == pytest.approx(np.radians([10, 20, 40])) and angles[1].tolist() == [0.1, 0.2, 0.4]


def test_the_body_of_states_is_prepared_once_for_an_hour_of_its_study(monkeypatch, tmp_path):
    (tmp_path / "still.toml").write_text("name = 'x'\n")
    (tmp_path / "s.toml").write_text("[simulation]\nseeds = 3\n")
    asked, plan = [], SimpleNamespace(dynamic_lines=None)

    def prepared(task, db):
        asked.append(task)
        return SimpleNamespace(memory="memory"), SimpleNamespace(settings=plan), None

    monkeypatch.setattr(simulated, "make_study", lambda raw: raw["simulation"]["seeds"])
    monkeypatch.setattr(simulated, "prepared", prepared)
    monkeypatch.setattr(simulated, "names_of", lambda body: ["surge"])
    db = SimpleNamespace(path="db.h5", require_rigid=lambda: None)
    for moving, kept in ((("a", "b"), ("a", "b")), (False, None), (True, None)):
        plan.dynamic_lines = moving
        ready = simulated.prepared_of(SimpleNamespace(study="s.toml", duration_hours=0.5), tmp_path, db)
        assert vars(ready.task) == vars(Task(3, "db.h5", 1800.0, "memory", str(tmp_path), kept))
        assert vars(asked[-1]) == vars(Task(3, "db.h5", 1800.0, None, str(tmp_path)))
        assert ready.names == ["surge"] and ready.raw == {"simulation": {"seeds": 3}}
    with pytest.raises(StudyError, match=r"still.toml has no \[simulation\]"):
        simulated.prepared_of(SimpleNamespace(study="still.toml", duration_hours=0.5), tmp_path, db)


# ------------------------------------------------------------------ one state


def test_the_weather_of_a_state_stands_for_that_of_the_study(monkeypatch):
    """Waves whole, wind and current key by key; an incidence that the study gives would turn them again"""
    made = []
    monkeypatch.setattr(one_state, "make_study", lambda tables: made.append(tables) or "study")
    monkeypatch.setattr(one_state, "replace", lambda task, study: (task, study))
    monkeypatch.setattr(one_state, "_prepared", lambda task, weather: ("body", task))
    monkeypatch.setattr(one_state, "simulate_seed", lambda task, seed, keep: {"statistics": (task, seed, keep)})
    monkeypatch.setattr(one_state, "_values", lambda body, statistics: (body, statistics))
    raw = {"waves": {"height": 9.0, "gamma": 2.0}, "wind": {"speed": 1.0, "height": 10.0, "incidence_deg": 3.0},
           "name": "x"}  # fmt: skip
    weather = {"waves": {"height": 2.0}, "wind": {"speed": 5.0, "direction_deg": 20.0}, "current": {"speed": 1.0}}
    found = one_state.state("task", raw, weather, [4, 5])
    task = ("task", "study")
    assert found == [(("body", task), (task, seed, False)) for seed in (4, 5)]
    assert made == [{"waves": {"height": 2.0}, "wind": {"speed": 5.0, "height": 10.0, "direction_deg": 20.0},
                     "current": {"speed": 1.0}, "name": "x"}]  # fmt: skip
    assert raw["wind"]["incidence_deg"] == 3.0 and raw["waves"]["height"] == 9.0


@pytest.mark.parametrize("viscous, current, kept", [(False, False, 1), (True, False, 0), (False, True, 0)])
def test_wave_forces_are_kept_from_state_to_state_of_one_body(viscous, current, kept, monkeypatch):
    """Not where each sea has its own damping, and not on a current; a database is opened again only then"""
    opened, given = [], []
    db = SimpleNamespace(has_viscous_motions=viscous)
    monkeypatch.setattr(one_state, "_kept", {})
    monkeypatch.setattr(one_state, "database_of", lambda path: opened.append(path) or db)
    monkeypatch.setattr(
        one_state,
        "prepared",
        lambda task, db, waves: given.append(waves) or [SimpleNamespace(waves=f"of {len(given)}")],
    )
    monkeypatch.setattr(one_state, "_without", lambda study, weather: study)
    task = SimpleNamespace(database="db.h5", folder="f", duration=60.0, study="s")
    weather = {"waves": {}} | ({"current": {}} if current else {})
    one_state._prepared(task, weather)
    one_state._prepared(task, weather)
    assert given == [None, "of 1" if kept else None] and len(opened) == 2 - kept and len(one_state._kept) == kept
    task.duration = 120.0
    one_state._prepared(task, weather)
    assert given[-1] is None and len(one_state._kept) == kept


@pytest.mark.parametrize("breaking, fenders, more", [
    ([math.nan, 1e6], 0, ["tension / breaking load", "breaking load / tension"]), ([math.inf], 0, []),
    ([math.inf], 2, ["fender deflection", "fender reaction"]),
])  # fmt: skip
def test_a_body_has_motions_and_what_is_known_of_its_lines_and_fenders(breaking, fenders, more):
    berth = SimpleNamespace(ropes=[SimpleNamespace(breaking_load=one) for one in breaking], fenders=[1] * fenders)
    found = one_state.names_of(SimpleNamespace(system=None, berth=berth))
    assert found == ["surge", "sway", "heave", "roll", "pitch", "yaw", *more]
    assert set(found) <= set(one_state.UNITS)


# ------------------------------------------------------------------ the file of states


def test_a_file_of_states_begins_with_its_mark_and_is_read_back(tmp_path):
    path = tmp_path / "s.jsonl"
    assert states_file.read(path, "me") == {}
    assert path.read_text() == f"{states_file.MARK}me\n"
    states_file.append(path, {"hour": 7, "used": [0.5]})
    states_file.append(path, {"hour": 9, "used": [0.25]})
    assert states_file.read(path, "me") == {7: {"hour": 7, "used": [0.5]}, 9: {"hour": 9, "used": [0.25]}}
    whole = path.read_bytes()
    path.write_bytes(whole + b'{"hour": 11')
    assert set(states_file.read(path, "me")) == {7, 9} and path.read_bytes() == whole
    path.write_bytes(whole[:5])
    assert states_file.read(path, "me") == {} and path.read_text() == f"{states_file.MARK}me\n"
    other = tmp_path / "other"
    other.write_bytes(b"# hakobune downtime statistics\n")
    for content, says in (
        (whole.replace(b"0.25", b"0.26"), "line 3, is damaged"),
        (b"notes\n", "is not a file of simul"),
    ):
        path.write_bytes(content)
        with pytest.raises(StudyError, match=says):
            states_file.read(path, "me")
    path.write_bytes(whole)
    with pytest.raises(StudyError, match="belongs to another hindcast"):
        states_file.read(path, "you")


# ------------------------------------------------------------------ all together


class Workers:
    ended = 0

    def shutdown(self, wait, cancel_futures):
        assert cancel_futures and not wait
        self.ended += 1


def found_states(hours=(100.0, 20.0), failed=()):
    return SimpleNamespace(rows=np.array([0, 3]), hours=np.array(hours), error=np.array([3.0, 4.0]),
                           sea=np.array([1.0, 2.0]), used=np.zeros((2, 3, 1)), failed=failed, said=("uncertain",),
                           verdicts="verdicts")  # fmt: skip


def of_simulation(**more):
    empty = dict.fromkeys(("points", "keel", "lee"))
    table = SimpleNamespace(duration_hours=0.5, seeds=3, study="s.toml", alternatives=[])
    return SimpleNamespace(**empty | {"simulation": table} | more)


def test_hours_of_states_have_errors_of_ninety_per_cent_and_states_that_failed_are_told(monkeypatch):
    """1.645 σ; an alternative gains what it has less, of an error √(3² + 4²)"""
    workers, asked, others = Workers(), [], []
    failed = tuple((k % 2, f"reason {k}") for k in range(6))
    monkeypatch.setattr(moored, "executor_of", lambda name: workers)
    monkeypatch.setattr(
        moored, "_states", lambda *given: asked.append(given[3]) or (record(), "limits", found_states(failed=failed))
    )
    other = found_states((40.0, 5.0))
    other.error = np.array([4.0, 3.0])
    monkeypatch.setattr(moored, "_others", lambda *given: others.append(given[1:]) or [("longer ropes", other)])
    monkeypatch.setattr(moored, "_returned", lambda *_: ({"r": 1}, {"r axis": 1}))
    monkeypatch.setattr(moored, "_limiting", lambda *_: ({"l": 1}, {}))
    said = moored.moored(of_simulation(), "folder", "db", "kept.jsonl", "local", print)
    assert asked == [Path("kept.jsonl")] and workers.ended == 1
    assert others == [("folder", "db", Path("kept.jsonl"), workers, print)]
    made = said.quantities
    assert made["simulated.hours"].values.tolist() == [100.0, 20.0]
    assert made["simulated.interpolant"].values == pytest.approx(1.645 * np.array([3.0, 4.0]), rel=1e-3)
    assert made["simulated.sea"].values == pytest.approx(1.645 * np.array([1.0, 2.0]), rel=1e-3)
    assert made["alternative.hours"].values.tolist() == [[40.0, 5.0]]
    assert made["alternative.gain"].values.tolist() == [[60.0, 15.0]]
    assert made["alternative.error"].values == pytest.approx(np.full((1, 2), 1.645 * 5), rel=1e-3)
    assert made["state.hour"].values.tolist() == [0, 3] and {"r", "l"} <= set(made) and "r axis" in said.axes
    assert said.axes["state"].values.tolist() == [0, 1] and said.axes["seed"].values.tolist() == [0, 1, 2]
    assert list(said.findings[:2]) == ["of ice", "uncertain"] and len(said.findings) == 7
    assert said.findings[2].endswith("hour 2001-01-01T00:00:00: reason 0")
    assert said.notes[0].startswith(
        "simulated: 2 states of 30 min with 3 seeds each; a state has the waves of its hour, and al"
    )
    assert len(said.notes) == 1
    moored.moored(of_simulation(), "folder", "db", None, "local", print)
    assert asked[1].name == "states.jsonl" and not asked[1].parent.exists()


@pytest.mark.parametrize("key", ["points", "keel", "lee"])
def test_what_is_of_linear_responses_is_refused_with_simulation(key):
    with pytest.raises(
        StudyError,
        match=rf"{key} is given with \[simulation\], but it applies to linear responses "
        rf"only;",
    ):
        moored.moored(of_simulation(**{key: [1]}), None, None, None, "local", print)


def test_alternatives_and_headings_are_whole_studies_with_files_of_their_own(monkeypatch):
    """A berth turned by 15° has its x axis at 45° of the compass"""

    class Hindcast(msgspec.Struct):
        x_axis_compass_deg: float

    class Simulation(msgspec.Struct):
        study: str
        alternatives: list

    class Read(msgspec.Struct):
        hindcast: Hindcast
        simulation: Simulation
        turned_deg: list

    read = Read(Hindcast(30.0), Simulation("s.toml", [AlternativeTable("longer ropes", "long.toml")]), [15.0])
    asked, said = [], []
    monkeypatch.setattr(moored, "_states", lambda *given: asked.append(given) or (0, 0, "found"))
    found = list(moored._others(read, "folder", "db", Path("a/kept.jsonl"), "workers", said.append))
    assert found == [("longer ropes", "found"), ("turned 15°", "found")] and said == ["longer ropes:", "turned 15°:"]
    (one, *_, first, _, _), (two, *_, second, _, _) = asked
    assert (one.simulation.study, one.hindcast.x_axis_compass_deg) == ("long.toml", 30.0)
    assert (two.simulation.study, two.hindcast.x_axis_compass_deg) == ("s.toml", 45.0)
    assert [str(path) for path in (first, second)] == ["a/kept.longer_ropes.jsonl", "a/kept.turned_15_.jsonl"]


def test_states_take_limits_of_what_their_body_gives(monkeypatch):
    monkeypatch.setattr(
        moored, "record_with_passages", lambda *given: asked.append(given[:2]) or f"record at {given[2]}"
    )
    ready = SimpleNamespace(names=["surge", "yaw"])
    monkeypatch.setattr(simulated, "prepared_of", lambda *given: asked.append(given) or ready)
    monkeypatch.setattr(
        simulated, "simulated", lambda read, record, limits, *more: asked.append(more) or (record, limits)
    )
    monkeypatch.setattr(moored, "limits_of", lambda read, points, gaps, units: units)
    read, db, asked = of_simulation(), SimpleNamespace(water_depth=20.0), []
    found = moored._states(read, "f", db, "p", "w", print)
    assert asked == [(read, "f"), (read.simulation, "f", db), (ready, "p", "w", print)]
    assert found == ("record at 20.0", {"surge": "m", "yaw": "deg"}, ("record at 20.0", {"surge": "m", "yaw": "deg"}))


@pytest.mark.parametrize("systems, columns, told", [
    (1, {}, ["the waves of its"]), (2, {}, ["the waves of its", "limiting seas are defined for one wave system"]),
    (1, {"wind speed": 1, "wind from": 1, "current speed": 1, "current to": 1}, ["the waves, wind, current of"]),
])  # fmt: skip
def test_notes_say_what_each_state_has_of_its_hour(systems, columns, told):
    said = list(moored._notes(of_simulation(), record(columns=columns, systems=systems).hindcast, found_states()))
    assert len(said) == len(told) and all(words in line for words, line in zip(told, said, strict=True))


# ------------------------------------------------------------------ command, passages, periods


@pytest.mark.parametrize("simulation, given, wanted", [
    (None, None, None), ("simulation", None, Path("d.states.jsonl")), ("simulation", Path("o.jsonl"), Path("o.jsonl")),
])  # fmt: skip
def test_the_command_keeps_states_beside_its_study_and_names_what_it_wrote(simulation, given, wanted, monkeypatch,
                                                                            tmp_path, capsys):  # fmt: skip
    monkeypatch.chdir(tmp_path)
    Path("d.toml").write_text("x")
    read = SimpleNamespace(hindcast=None, simulation=simulation)
    asked, files = [], []

    def found(study, database, **more):
        asked.append(more)
        more["say"]("state 1")
        return "result"

    where = "hakobune.pipelines"
    monkeypatch.setattr(f"{where}.downtime.study.read_downtime", lambda path: (read, "text"))
    monkeypatch.setattr(f"{where}.downtime.study.files_of", lambda *_: [])
    monkeypatch.setattr(f"{where}.downtime.result.downtime", found)
    monkeypatch.setattr(f"{where}.downtime.pictures.draw", lambda result, plot: files.append(plot))
    monkeypatch.setattr(f"{where}.downtime.report.page_of", lambda result, text: f"{result} of {text}")
    monkeypatch.setattr(f"{where}.results.output.write_result", lambda result, path: files.append(path))
    monkeypatch.setattr(f"{where}.results.tables.printed", lambda result: 7)
    names = Path("f.h5"), Path("p.png"), Path("page.html")
    status = command.downtime(Path("d.toml"), output=names[0], plot=names[1], page=names[2], states=given)
    assert status == 7 and asked[0]["states"] == wanted and asked[0]["executor"] == "local"
    assert files == [names[0], names[1]] and names[2].read_text() == "result of text"
    out, err = capsys.readouterr()
    assert out.splitlines()[-1] == "written: f.h5, p.png, page.html" and "state 1" in err
    assert command.downtime(Path("d.toml")) == 7 and "written" not in capsys.readouterr().out


def test_forces_of_many_passages_are_read_between_some_distances(monkeypatch):
    """Of F ~ d⁻² between 40 and 400 m exactly by logarithms, from as few as are computed; the side is kept"""

    class Track(msgspec.Struct):
        distance: float

    class Study(msgspec.Struct):
        track: Track

    asked = []

    def passing(study):
        d = study.track.distance
        asked.append(d)
        return {"largest.force": np.array([-1e6, 2e6, 3e7]) / d**2}

    monkeypatch.setattr(passages, "passing", passing)
    distance = np.linspace(40.0, 400.0, passages.DISTANCES + 5)
    found = passages._forces(Study(Track(-1.0)), distance)
    assert found == pytest.approx(np.outer(distance**-2.0, [1e6, 2e6, 3e7]), rel=1e-9)
    assert len(asked) == passages.DISTANCES and max(asked) == pytest.approx(-40.0) and min(asked) == pytest.approx(-400)
    asked.clear()
    passages._forces(Study(Track(1.0)), np.array([50.0, 70.0, 50.0]))
    assert asked == [50.0, 70.0]


@pytest.mark.parametrize("given, says", [
    ({}, "h: no period is given; give one of"), ({"peak_period": "T", "mean_period": "T"}, "are given; give one of"),
])  # fmt: skip
def test_a_sea_of_a_hindcast_has_one_period(given, says):
    with pytest.raises(StudyError) as refused:
        _system("h", WavesColumns("H", **given, direction_from="d"), 20.0)
    assert says in str(refused.value)


def test_a_state_is_on_the_disk_before_the_next_is_simulated(tmp_path, monkeypatch):
    """The file is whole at the moment when the system is asked to write it out"""
    synced = []
    monkeypatch.setattr(states_file.os, "fsync", lambda number: synced.append(os.fstat(number).st_size))
    for count, hour in enumerate((7, 9), 1):
        states_file.append(tmp_path / "s.jsonl", {"hour": hour})
        assert synced[-1] == (tmp_path / "s.jsonl").stat().st_size and len(synced) == count
