"""The head of a file of runs, of parts that are made up, what is said before a run and while it goes on."""

import json
from dataclasses import fields
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.motion import line_loads
from hakobune.pipelines.simulate import run as runs


def parts(head):
    """Values of a Header in the order of its fields"""
    return [getattr(head, field.name) for field in fields(head)]


def named(*names, **more):
    return [SimpleNamespace(name=name, **more) for name in names]


@pytest.fixture
def head(monkeypatch):
    def call(bodies=(), system=True, ropes=(), fenders=(), moving="none", anchors=(), mean_period=8.0, berth=()):
        axes = np.array([[1.0, 2, 3, 0, 0, 0.5], [4, 5, 6, 0, 0, 0.7]])
        held = (
            SimpleNamespace(line_names=("a", "b"), lines=(), breaking_load=np.array([1e6, np.inf])) if system else None
        )
        links = ("link",)
        reader = SimpleNamespace(axes_at_rest=axes, links=links, words=("surge",), names=("Surge",))
        on_berth = SimpleNamespace(ropes=ropes, fenders=fenders, names=berth)
        memory = SimpleNamespace(states=12)
        body = SimpleNamespace(berth=on_berth, system=held, reader=reader, memory=memory, start="start")
        hulls = {name: SimpleNamespace(length=length, beam=10.0, draft=5.0, freeboard=3.0)
                 for name, length in (("ship", 90.0), ("barge", 120.0))}  # fmt: skip
        hull = SimpleNamespace(length=100.0, beam=20.0, draft=6.0, freeboard=4.0)
        asked = []
        study = SimpleNamespace(
            allowable=0.6, anchors=anchors, hulls_of=lambda db: hulls if bodies else hull,
            anchors_on=lambda names: asked.append(names) or [f"of {name}" for name in names],
        )  # fmt: skip
        task = SimpleNamespace(study=study, database="b.h5")
        settings = SimpleNamespace(duration=600.0, dynamic_lines=moving, lines_lost=())
        plan = SimpleNamespace(settings=settings, split=0.3, mean_period=mean_period, stations="stations",
                               told=("left out", "told"), sides="sides", shapes="units")  # fmt: skip
        water = {"density": 1025.0, "gravity": 9.8, "water_depth": 30.0}
        db = SimpleNamespace(bodies=bodies, rotation_center=(7.0, 8.0, 9.0), **water)
        lines = [("lines", held)]
        ends = (np.array([[0.0, 0, -30], [1, 1, -30]]), np.array([[5.0, 0, 0], [6, 1, 0]])) if system else ((), ())
        monkeypatch.setattr(line_loads, "body_lines", lambda of: lines if of is held else None)
        monkeypatch.setattr(line_loads, "ends_at_rest", lambda of, at: ends if of is lines and at is axes else None)
        stations, hinges = [("station x", "m")], [("hinge x", "N", 0), ("hinge y", "N", 1)]
        monkeypatch.setattr(
            runs, "told_of_stations", lambda of, at: stations if (of, at) == (reader, "stations") else 0
        )
        monkeypatch.setattr(runs, "told_of", lambda of: hinges if of is links else 0)
        monkeypatch.setattr(runs, "differ", lambda of: True)
        monkeypatch.setattr(runs, "on_bed", lambda body, place: [20.0, 0.0] if place == "start" else None)
        monkeypatch.setattr(runs, "fibre_lines", lambda of: ())
        monkeypatch.setattr(runs, "of_berth", lambda study, db, body: {"fender_height": [2.0]})
        monkeypatch.setattr(runs, "sample_times", lambda of: ("times", of is settings))
        monkeypatch.setattr(runs, "quantities_of", lambda *of: (("quantities", *of), "units"))
        beside = SimpleNamespace(attributes=lambda: {"moored_period": "period"})
        found = runs._header(task, "text", db, body, "identity", plan, beside, ("one", "two", "one"))
        return found, asked

    return call


def test_a_head_has_the_numbers_of_the_study_its_database_and_its_lines(head):
    found, asked = head()
    identity, text, names, load, anchor, fairlead, time, quantities, units, attributes, *rest = parts(found)
    assert (identity, text, names, time, units) == ("identity", "text", ("a", "b"), ("times", True), "units")
    assert load.tolist() == [1e6, np.inf] and asked == []
    assert anchor.tolist() == [[0, 0, -30], [1, 1, -30]] and fairlead.tolist() == [[5, 0, 0], [6, 1, 0]]
    assert quantities == ("quantities", ("a", "b"), (), ("surge",), "sides", ("link",), "units", [("station x", "m")])
    assert rest == [(), ("Surge",), ("hinge x", "hinge y"), ("station x",)]
    assert attributes.pop("rotation_center").tolist() == [7, 8, 9]
    assert attributes == {
        "lost_at": np.inf,
        "database": "b.h5", "duration": 600.0, "split_frequency": 0.3, "mean_period": 8.0, "allowable": 0.6,
        "density": 1025.0, "gravity": 9.8, "water_depth": 30.0, "hull": [100.0, 20.0, 6.0, 4.0], "memory_states": 12,
        "place_at_rest": "start", "told": "left out\ntold", "findings_of_all": "one\ntwo", "seeds_differ": True,
        "moored_period": "period", "on_bed_at_rest": [20.0, 0.0],
    }  # fmt: skip
    assert np.isnan(head(mean_period=None)[0].attributes["mean_period"])


def test_several_bodies_have_their_axes_and_the_sizes_of_the_longest(head):
    attributes = head(bodies=("ship", "barge"))[0].attributes
    assert attributes["hull"] == [120.0, 10.0, 5.0, 3.0] and attributes["heading"].tolist() == [0.5, 0.7]
    assert attributes["rotation_center"].tolist() == [[1, 2, 3], [4, 5, 6]]


def test_ropes_follow_lines_and_have_no_anchors(head):
    rope = {"bollard": (9.0, 9, 2), "fairlead": (8.0, 8, 3), "breaking_load": 5e5}
    found, asked = head(ropes=named("r", **rope), fenders=named("F", "G"), anchors=("table",), berth=("F", "G", "r"))
    attributes, found = found.attributes, parts(found)
    assert found[2] == ("a", "b", "r") and found[3].tolist() == [1e6, np.inf, 5e5] and found[10] == ("F", "G")
    assert found[4].tolist()[2] == [9, 9, 2] and found[5].tolist()[2] == [8, 8, 3]
    assert json.loads(attributes["anchors"]) == ["of a", "of b", None] and asked == [("a", "b")]
    assert attributes["fender_height"] == [2.0]
    alone, asked = head(system=False, ropes=named("r", **rope), anchors=("table",))
    attributes, alone = alone.attributes, parts(alone)
    assert alone[2] == ("r",) and alone[3].tolist() == [5e5] and alone[4].tolist() == [[9, 9, 2]] and asked == [()]
    assert json.loads(attributes["anchors"]) == [None] and "fender_height" not in attributes
    none = parts(head(system=False)[0])
    assert none[2] == () and none[4].shape == none[5].shape == (0, 3)


@pytest.mark.parametrize("moving, kept", [(("a", "b"), "a\nb"), ((), ""), ("all", None), ("auto", None)])
def test_lines_that_move_are_kept_by_name_once_they_are_known(head, moving, kept):
    assert head(moving=moving)[0].attributes.get("moving_lines") == kept


@pytest.mark.parametrize("pace, moves, count, seeds, line", [
    ((0.01, 0.1), ("a",), 1, 3, 'one seed takes about {m} (dynamic_lines = "none": {s}), and all 3 seeds {m3}'),
    ((0.01, 0.1), ("a",), 2, 3, 'one seed takes about {m} (dynamic_lines = "none": {s}), and all 3 seeds {m2}'),
    ((0.01, 0.1), (), 1, 3, "one seed takes about {s}, and all 3 seeds {s3}"),
    ((np.nan, 0.1), ("a",), 4, 4, "one seed takes about {m}, and all 4 seeds {m}"),
    ((0.01, np.nan), ("a",), 1, 3, None),
    ((np.nan, 0.1), (), 1, 3, None),
])  # fmt: skip
def test_the_time_of_seeds_is_that_of_a_trial_for_the_rounds_of_the_workers(pace, moves, count, seeds, line):
    """1100 s at 0.01 s/s and 0.1 s/s: 11 and 110 s"""
    said = []
    out = SimpleNamespace(print=lambda words, **more: said.append(words))
    settings = SimpleNamespace(ramp=100.0, duration=1000.0, dynamic_lines=moves)
    plan = SimpleNamespace(settings=settings, told=("left out",), pace=pace)
    runs._say_before(out, plan, seeds, SimpleNamespace(count=count))
    words = {"s": 11, "m": 110, "s3": 33, "m2": 220, "m3": 330}
    words = {name: runs.words_of(float(value)) for name, value in words.items()}
    assert said == ["left out", *([line.format(**words)] if line else [])]
    runs._say_before(None, plan, seeds, SimpleNamespace())


def test_progress_tells_seeds_their_pace_and_what_is_left(monkeypatch):
    """Each of ten seeds lasts 1100 s; the first takes 2 s: 550 s/s, 18 s are left; 12 s later 45 % of the second"""
    now, said = [100.0], []
    monkeypatch.setattr(runs.time, "perf_counter", lambda: now[0])
    out = SimpleNamespace(print=lambda words, **more: said.append(words))
    plan = SimpleNamespace(settings=SimpleNamespace(ramp=100.0, duration=1000.0))
    stop = SimpleNamespace(asked=False)
    told = runs._Progress(out, 10, plan, stop)
    now[0] = 102.0
    told.step(7, "row")
    told.inside(0.3)  # too soon
    now[0] = 112.1
    for share in (0.0, 1.0):
        told.inside(share)
    told.inside(0.45)
    now[0] = 113.0
    told.step(8, ValueError("no"))
    words = [" ".join(line.split()) for line in said]
    assert words == [
        f"1/10 seed 7 550 s/s {runs.words_of(18.0)} left", f"1/10 45 % of a seed {1.45 * 1100 / 12.1:.0f} s/s "
        f"{runs.words_of(12.1 / 1.45 * 8.55)} left",
        f"2/10 seed 8 failed {2 * 1100 / 13:.0f} s/s {runs.words_of(52.0)} left",
    ]  # fmt: skip
    stop.asked = True
    with pytest.raises(KeyboardInterrupt):
        told.inside(0.5)
    runs._Progress(None, 1, plan, stop).step(1, "row")
