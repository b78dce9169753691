"""Where there are two or more of a thing: the second one's hour, hull, record, motion or table, each by hand."""

import hashlib
import math
import warnings
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.mooring.response.points import KeelPoint, Point, keel_name
from hakobune.pipelines.breakwater.tables import SeaTable
from hakobune.pipelines.common.gaps import Gaps
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.design import report_words
from hakobune.pipelines.design.kinds import in_time
from hakobune.pipelines.design.kinds.needs import GAP, HINGE_FORCE
from hakobune.pipelines.downtime import result as downtime
from hakobune.pipelines.keys import command as keys
from hakobune.pipelines.response import findings, solved
from hakobune.pipelines.scene import identity
from hakobune.pipelines.simulate import file as stored
from hakobune.pipelines.simulate import run as runs
from hakobune.pipelines.simulate.work import farthest

ROOT = "hakobune.pipelines"


@pytest.mark.parametrize("solved_rows, spans", [
    ([1, 0, 0, 1, 1], [(0.1, 0.4)]), ([1, 0, 1, 0, 1], [(0.1, 0.3), (0.3, 0.5)]),
    ([0, 1, 1, 1, 0], [(0.1, 0.2), (0.4, 0.5)]),
    ([0, 0, 0, 0, 0], [(0.1, 0.5)]), ([1, 1, 1, 1, 1], []), ([0, 0, 1, 0, 0], [(0.1, 0.3), (0.3, 0.5)]),
])  # fmt: skip
def test_a_span_without_numbers_lies_between_the_frequencies_on_either_side_that_are_solved(solved_rows, spans):
    asked = np.array([0.1, 0.2, 0.3, 0.4, 0.5])
    gaps = Gaps("d.h5", asked, np.array(solved_rows, bool), {})
    found = gaps.spans() if callable(gaps.spans) else gaps.spans
    assert [tuple(map(float, one)) for one in found] == spans


class Inner(msgspec.Struct):
    size: float
    kind: str = "a"


class Part(msgspec.Struct):
    inner: Inner
    others: list[Inner] = []


class Whole(msgspec.Struct):
    parts: dict[str, Part]
    first: Inner | None = None
    both: list[Inner] | None = None


@pytest.mark.parametrize("raw, says", [
    ({"parts": {"x": {}}}, "parts[...].inner is missing; allowed: inner, others"),
    ({"parts": {"x": {"inner": {}}}}, "parts[...].inner.size is missing; allowed: size, kind"),
    ({"parts": {"x": {"inner": {"size": 1}, "others": [{"kind": "b"}]}}},
     "parts[...].others[0].size is missing; allowed: size, kind"),
    ({"parts": {}, "first": {"kind": "b"}}, "first.size is missing; allowed: size, kind"),
    ({"first": {"size": 1.0}}, "parts is missing; allowed: parts, first, both"),
])  # fmt: skip
def test_a_key_that_is_missing_is_told_with_those_of_its_own_table(raw, says):
    with pytest.raises(ValueError) as refused:
        typed(raw, Whole, ValueError)
    assert str(refused.value).startswith(says)


@pytest.mark.parametrize("number", [0, 1])
def test_the_least_water_under_the_keel_is_told_of_the_point_that_has_it(number):
    """Of two points the one with less left, although the other touches more often"""
    left = [2.5, 3.5] if number == 0 else [3.5, 2.5]
    found = {"fore": (6.0, left[0], 0.001), "aft": (5.0, left[1], 0.02)}
    result = SimpleNamespace(under_keel=lambda: found, duration=7200.0)
    (line,) = findings._keel_lines(result)
    name, gap, touched = (("fore", 6, "0.001"), ("aft", 5, "0.02"))[number]
    assert line == (
        f"under keel: the largest drop leaves 2.5 of {gap} m at {name}, the least of all points; the hull "
        f"touches the bed "
        f"with probability {touched} in 2 h; this includes waves only, not squat"
    )
    assert list(findings._keel_lines(SimpleNamespace(under_keel=dict, duration=1.0))) == []


@pytest.mark.parametrize("number", [0, 1])
def test_the_least_water_of_many_years_is_that_of_the_point_with_least_left(number):
    """Of gaps of 9 and 5 m and drops of 6 and 1 m 3 and 4 m are left, or with a drop of 3 m 3 and 2 m; the other point
    drops more"""
    drops = {"fore": 6.0, "aft": (1.0, 3.0)[number]}
    points = [KeelPoint(name, (0.0, 0.0, -10.0), gap) for name, gap in (("fore", 9.0), ("aft", 5.0))]
    deck = Point("deck", (0.0, 0.0, 5.0), 4.0)

    def term(name):
        drop = next(drop for point, drop in drops.items() if name == keel_name(points[point == "aft"]))
        return SimpleNamespace(level=lambda time: drop, crossing_rate=lambda level: 1e-20)

    result = SimpleNamespace(points=[deck, *points], long_term=term)
    (line,) = findings._keel_in_years(result, 100.0)
    assert line.startswith(("under keel: the drop reached once in 100 years leaves 3 of 9 m at fore, the least "
                            "of all points; ",
                            "under keel: the drop reached once in 100 years leaves 2 of 5 m at "
                            "aft")[number])  # fmt: skip
    assert list(findings._keel_in_years(SimpleNamespace(points=[deck]), 100.0)) == []


@pytest.mark.parametrize("spreading, angle, normal", [(None, 0.0, True), ("cosine:4", 0.0, False), (None, 5.0, False),
                                                      ("cosine:4", 5.0, False)])  # fmt: skip
def test_a_sea_is_normal_to_a_breakwater_where_it_neither_spreads_nor_comes_at_an_angle(spreading, angle, normal):
    sea = SeaTable(height=2.0, mean_period=6.0, spreading=spreading, obliquity_deg=angle)
    assert sea.is_normal is normal


@pytest.mark.parametrize(
    "factor, name", [(1, "storm"), (1.0, "storm"), (1.5, "storm, motions x 1.5"), (2, "storm, motions x 2")]
)
def test_a_case_with_other_motions_has_a_name_of_its_own(factor, name):
    assert report_words.with_factor("storm", factor) == name


@pytest.mark.parametrize("json, markdown", [(True, False), (False, True), (False, False)])
def test_kinds_and_tables_are_written_as_they_are_asked_for(monkeypatch, capsys, json, markdown):
    from hakobune.pipelines.keys import shown

    monkeypatch.setattr(shown, "kinds_text", lambda *given: f"kinds {given}")
    for name in ("as_json", "as_markdown", "as_text"):
        monkeypatch.setattr(shown, name, lambda tables, name=name: f"{name} of {tables[0].asked}")
    monkeypatch.setattr(keys, "_tables", lambda kind, words: [SimpleNamespace(keys=(), asked=(kind, words))])
    assert keys.keys(json=json, markdown=markdown) == 0
    assert capsys.readouterr().out == f"kinds ({json}, {markdown})\n"
    assert keys.keys("study", "waves", json=json, markdown=markdown) == 0
    way = "as_json" if json else "as_markdown" if markdown else "as_text"
    assert capsys.readouterr().out == f"{way} of ('study', ('waves',))\n"
    with pytest.raises(ValueError, match="--json and --markdown are given; allowed: one of the two"):
        keys.keys("study", json=True, markdown=True)


@pytest.mark.parametrize("file, name", [(None, "study.toml"), ("own.toml", "own.toml")])
def test_a_new_file_is_told_with_what_was_written_and_the_steps_that_run_it(monkeypatch, capsys, file, name):
    from hakobune.pipelines.keys import beginning, shown

    monkeypatch.setattr(shown, "kinds_text", lambda *given: f"kinds {given}")
    monkeypatch.setattr(beginning, "write", lambda kind, path: ([path, f"fender of {kind}"], ["run it", "look"]))
    assert keys.new() == 0 and capsys.readouterr().out == "kinds (False, False)\n"
    assert keys.new("study", file and Path(file)) == 0
    assert capsys.readouterr().out == f"{name}\nfender of study\n    run it\n    look\n"


def test_mesh_files_of_bodies_come_before_those_of_shapes_and_without_files_there_is_nothing(tmp_path):
    """The first sixteen figures of the SHA-256 of their bytes"""
    hashes = {}
    for name in ("hull", "shape"):
        (tmp_path / name).write_bytes(name.encode())
        hashes[name] = f"sha256 {hashlib.sha256(name.encode()).hexdigest()[:16]}"
    none = SimpleNamespace(file=None)
    hull, shape = (SimpleNamespace(file=tmp_path / name) for name in ("hull", "shape"))
    found = identity.contents(SimpleNamespace(bodies=[none, hull], modes=[shape, none]))
    assert found == f"{hashes['hull']}; {hashes['shape']}"
    assert identity.contents(SimpleNamespace(bodies=[hull], modes=None)) == hashes["hull"]
    assert identity.contents(SimpleNamespace(bodies=[none], modes=None)) is None


def test_a_difference_names_two_keys_and_counts_the_rest():
    old = {"a": "1", "b": "2", "c": "3", "same": "4"}
    assert identity.difference(old, dict(old)) == ""
    one = identity.difference(old, old | {"b": "5"})
    assert "b" in one and "2" in one and "5" in one and "more" not in one and "same" not in one
    many = identity.difference(old, {"same": "4", "a": "9", "d": "7"})
    assert many.endswith(" and 2 more") and many.count("; ") == 1


# ------------------------------------------------------------------ runs in time


class Names(list):
    def asstr(self):
        return {(): self}


def of_runs(monkeypatch, rows, hinges=()):
    monkeypatch.setattr(stored, "summary_of", lambda file, name: rows[name])
    file = {"quantity": Names(rows)}
    return file | ({"hinge": Names(hinges)} if hinges else {})


def test_gaps_have_their_smallest_and_hinges_their_largest_either_way(monkeypatch):
    rows = {"surge": {}, "gap a b": {"smallest": 2.5}, "gap a c": {"smallest": -0.5},
            "bow force x": {"largest": 3e3, "smallest": -5e3},
            "bow force y": {"largest": 4e3, "smallest": 1e3}}  # fmt: skip
    found = in_time._between(of_runs(monkeypatch, rows, ("bow force x", "bow force y")))
    assert found == {GAP: {"a b": 2.5, "a c": -0.5}, HINGE_FORCE: {"bow force x": 5.0, "bow force y": 4.0}}
    assert in_time._between(of_runs(monkeypatch, {"surge": {}})) == {}


def test_motions_of_runs_are_the_larger_side_and_the_way_is_the_farthest_of_all_bodies_from_rest(
    monkeypatch,
):
    rows = {
        "a surge": {"largest": 3.0, "mean": 1.0, "smallest": -2.0},
        "a sway": {"largest": 4.0, "mean": 1.0, "smallest": 0.5},
        "a heave": {"largest": 99.0, "mean": 0.0, "smallest": -99.0},
    }
    monkeypatch.setattr(stored, "words_of", lambda file: list(rows))
    file = of_runs(monkeypatch, rows)
    assert in_time._largest_motions(file).tolist() == [3.0, 3.0, 99.0]
    motion = np.zeros((3, 12))
    body = SimpleNamespace(start=np.zeros(12), reader=SimpleNamespace(rigid=12))
    motion[2, 6:8] = -3.0, 4.0  # the second body, 5 m away
    assert farthest(motion, body) == 5.0
    body.start[6] = 9.0  # where it rests
    assert farthest(motion, body) == pytest.approx(np.hypot(12.0, 4.0))


@pytest.mark.parametrize("bodies", [(), ("ship",)])
def test_windows_are_checked_against_the_plan_before_a_run(monkeypatch, tmp_path, bodies):
    asked = []
    plan = SimpleNamespace(settings=SimpleNamespace(duration=600.0))
    db = SimpleNamespace(path="b.h5", bodies_reader=SimpleNamespace(omega="omega", words="words"), bodies=bodies)

    class Stop(Exception):
        pass

    def planned(*given):
        asked.append(given)
        return plan

    def checked(*given):
        asked.append(given)
        raise Stop

    monkeypatch.setattr(runs, "force_files", lambda study, folder: [f"{folder}/f.csv"])
    monkeypatch.setattr(runs, "check_output", lambda *given: asked.append((given[0], given[4])))
    monkeypatch.setattr(runs, "plan_of", planned)
    monkeypatch.setattr(runs, "units_of_shapes", lambda db: "units")
    monkeypatch.setattr(runs, "check_windows", checked)
    given = runs.Input("study", "text", "folder", tmp_path / "s.toml")
    with pytest.raises(Stop):
        runs.simulate(given, db, tmp_path / "r.h5", None, None, seeds=3, duration=9.0, windows=60.0)
    assert asked == [
        (tmp_path / "r.h5", (tmp_path / "s.toml", "b.h5", "folder/f.csv")),
        ("study", "omega", 3, 9.0, "folder", "words", "units"), (60.0, plan, bodies),
    ]  # fmt: skip


# ------------------------------------------------------------------ hours and seas


def test_planes_of_a_spectrum_turn_with_the_waves(monkeypatch):
    """A body turned by 90° meets what went to 0.5 rad at 0.5 + π/2"""

    class Planes(SimpleNamespace):
        def _replace(self, **more):
            return Planes(**vars(self) | more)

    asked = []
    monkeypatch.setattr(downtime, "replace", lambda hindcast, waves: ("turned", waves))
    monkeypatch.setattr(downtime, "hours_of", lambda response, record: asked.append(record) or "hours")
    monkeypatch.setattr(downtime, "used_of", lambda limits, hours, hindcast: (limits, hours, hindcast))
    verdicts = SimpleNamespace(down=np.array([[1, 0], [1, 0], [0, 0]]), known=np.array([[1, 0], [1, 0], [1, 0]]))
    monkeypatch.setattr(downtime, "judged", lambda used, limits, count: verdicts if count == 2 else None)
    record = SimpleNamespace(
        hindcast=SimpleNamespace(waves=()), shapes="shapes", planes=Planes(angle=np.array([0.5, 6.0]))
    )
    read = SimpleNamespace(turned_deg=[90.0], operations=["a", "b"])
    made, axes = downtime._turned(read, record, "response", "limits")
    assert (
        asked[0].planes.angle == pytest.approx([0.5 + math.pi / 2, 6.0 + math.pi / 2]) and asked[0].shapes == "shapes"
    )
    assert made["turned.hours"].values == pytest.approx(np.array([[downtime.YEAR * 2 / 3, 0.0]]))
    assert axes["turned"].unit == "deg" and record.planes.angle.tolist() == [0.5, 6.0]
    assert downtime._turned(SimpleNamespace(turned_deg=[]), record, "response", "limits") == ({}, {})


@pytest.fixture
def sea_of(monkeypatch):
    def call(qtf="newman", bodies=(), hours=2.0):
        given = {}

        def note(name, answer):
            return lambda *of, **more: given.update({name: of + tuple(more.values())}) or answer

        monkeypatch.setattr(f"{ROOT}.common.weather.seas.sea_with_swell", note("sea", "sea"))
        monkeypatch.setattr(f"{ROOT}.response.study.viscous_laws", note("laws", "laws"))
        monkeypatch.setattr(f"{ROOT}.response.study.viscous_words", note("words", ["viscous", "weak"]))
        monkeypatch.setattr("hakobune.mooring.on_current.waves.carrier_of", note("carrier", "carrier"))
        monkeypatch.setattr("hakobune.mooring.on_current.body.on_current", note("current", "on current"))
        monkeypatch.setattr("hakobune.mooring.response.viscous.in_sea", note("in sea", ("body in sea", "damping")))
        monkeypatch.setattr(
            "hakobune.mooring.response.pair_levels.beside_newman", note("pairs", ("bound", ["left out", "too"]))
        )
        monkeypatch.setattr("hakobune.mooring.response.sea_state.sea_state", note("state", "state"))
        read = SimpleNamespace(sea=SimpleNamespace(qtf=qtf, duration_hours=hours), stream=lambda: "stream")
        db = SimpleNamespace(path="b.h5", bodies=bodies, water_depth=20.0, bodies_reader="reader")
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            found = solved.solved_in_sea(read, "body", db, "points", None)
        return found, given, [str(one.message) for one in said], read, db

    return call


def test_a_body_in_a_sea_is_carried_damped_and_pushed_by_pairs_and_both_are_told(sea_of):
    found, given, said, read, db = sea_of()
    assert found == ("state", "body in sea") and said == ["viscous", "weak", "left out", "too"]
    assert given == {
        "sea": ("sea", read.sea, 20.0), "laws": (read, db), "carrier": ("stream",), "current": ("body", "carrier"),
        "in sea": ("reader", "sea", "laws", "on current"), "words": ("body in sea", "laws", "damping"),
        "pairs": (db, "sea", "newman", True), "state": ("body in sea", "sea", 7200.0, "points", "bound"),
    }  # fmt: skip


@pytest.mark.parametrize("qtf, bodies, hours, says", [
    ("body", ("a", "b"), 2.0, 'sea.qtf is "body", but b.h5 contains 2 bodies; allowed: "newman"'),
    ("newman", (), 0.0, "sea.duration_hours is 0"), ("guess", (), 2.0, "sea.qtf is 'guess'"),
])  # fmt: skip
def test_what_a_sea_may_not_be_asked_for(sea_of, qtf, bodies, hours, says):
    with pytest.raises(StudyError) as refused:
        sea_of(qtf, bodies, hours)
    assert says in str(refused.value)
