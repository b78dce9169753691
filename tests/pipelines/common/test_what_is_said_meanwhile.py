"""What long work says meanwhile, memory of containers, weather from passages and lees, files of commands, by hand."""

import inspect
import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines import checking
from hakobune.pipelines.breakwater.quantities import front_of
from hakobune.pipelines.common import bounds, progress
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import lee, passages
from hakobune.pipelines.passing import result as of_passing
from hakobune.pipelines.scene.identity import SAME, _same_hull
from hakobune.pipelines.sea import report as of_sea
from hakobune.pipelines.simulate import run as of_runs
from hakobune.pipelines.simulate import work as of_work
from hakobune.pipelines.single_point import running
from hakobune.pipelines.site import states


def test_how_far_a_large_body_is_prepared_is_told_every_ten_seconds(monkeypatch):
    """Stages of 4 · 10 s and 2 · 30 s: the first done, half of the second, 70 %; what came before is guessed whole"""
    clock, said = [0.0], []
    monkeypatch.setattr(progress.time, "perf_counter", lambda: clock[0])
    console = SimpleNamespace(print=lambda text, **_: said.append(text))
    one = progress.Preparing(console, SimpleNamespace(stages={"a": (4, 10.0), "b": (2, 30.0)}, seconds=100.0))
    one("a", 1)
    assert one.share == pytest.approx(0.1)
    clock[0] = 9.9
    one("b", 0.5)
    assert one.share == pytest.approx(0.4 + 0.15) and not said
    clock[0] = 54.0
    one("b", 0.5)
    trusted = progress.TRUST * 100.0
    pace = (54.0 + trusted) / (70.0 + trusted)
    assert said == [f"preparing:  70 %  {progress.duration(30.0 * pace):>8} left"]
    clock[0] = 60.0
    one("b", 0.1)
    clock[0] = 70.0
    one("b", 9.0)
    assert len(said) == 1 and one.share == 1.0


@pytest.mark.parametrize("limit, free", [("1000", 1000 - 600 + 70 + 30), ("max", math.inf), (None, math.inf)])
def test_memory_of_a_container_is_what_is_left_below_its_limit_with_its_files(limit, free, tmp_path):
    if limit:
        (tmp_path / "memory.max").write_text(f"{limit}\n")
        (tmp_path / "memory.current").write_text("600\n")
        (tmp_path / "memory.stat").write_text("anon 500\ninactive_file 70\nactive_file 30\n")
    assert bounds._left_to_container(tmp_path) == free


@pytest.mark.parametrize("pace, moves, words", [
    ((0.01, np.nan), False, ["told", "one seed takes about 1 s, and all 5 seeds 3 s"]),
    ((0.01, 0.1), True, ["told", 'one seed takes about 10 s (dynamic_lines = "none": 1 s), and all 5 seeds 30 s']),
    ((np.nan, np.nan), False, ["told"]),
    ((np.nan, 0.1), True, ["told", "one seed takes about 10 s, and all 5 seeds 30 s"]),
])  # fmt: skip
def test_how_long_seeds_take_is_told_before_in_rounds_of_the_workers(pace, moves, words, monkeypatch):
    """Runs of 100 s at 0.01 and 0.1 s of work each, 5 of them on two workers in three rounds"""
    said = []
    monkeypatch.setattr(of_runs, "words_of", lambda seconds: f"{seconds:g} s")
    settings = SimpleNamespace(ramp=20.0, duration=80.0, dynamic_lines=("a",) if moves else ())
    plan = SimpleNamespace(settings=settings, told=("told",), pace=pace)
    console = SimpleNamespace(print=lambda text, **_: said.append(text))
    name = next(name for name in ("_say_before", "_told_before") if hasattr(of_runs, name))
    given = {"console": console, "plan": plan, "seeds": 5, "executor": SimpleNamespace(count=2)}
    function = getattr(of_runs, name)
    function(*(given[one] for one in inspect.signature(function).parameters))
    assert said == words


class Lines:
    """Two lines at rest in a motion, of which the first is of segments"""

    def __init__(self, monkeypatch):
        self.seen = []
        found = SimpleNamespace(utilisation=np.array([0.9, 0.9]), tension_b=np.array([100.0, 400.0]),
                                horizontal_a=np.array([60.0, 70.0]), vertical_a=np.array([-8.0, 9.0]))  # fmt: skip
        monkeypatch.setattr(of_work, "_at_rest_in", lambda body, motion: self.seen.append(motion[0]) or found)


def test_lines_of_segments_use_what_their_worst_segment_does(monkeypatch):
    """Largest 200 and 300 N of 1000 and of an unknown load"""
    held = Lines(monkeypatch)
    system = SimpleNamespace(breaking_load=[1000.0, math.inf], composites=[SimpleNamespace(number=0)], lines=[1, 2])
    ropes = [SimpleNamespace(breaking_load=500.0)]
    body = SimpleNamespace(system=system, berth=SimpleNamespace(ropes=ropes))
    motion = np.arange(3.0)[:, None] * np.ones(6)
    tension = np.array([[100.0, 300.0, 50.0], [200.0, 200.0, 400.0], [150.0, 100.0, 10.0]])
    used = of_work.largest_use(body, motion, tension)
    assert used[0] == 0.9 and np.isnan(used[1]) and used[2] == 0.8 and held.seen == [1.0]
    body.system = None
    assert np.isnan(of_work.anchor_pulls(body, motion, tension)).all()
    assert of_work.largest_use(body, motion, tension[:, 2:]).tolist() == [0.8]


@pytest.mark.parametrize("lengths, waves, given_drift, drift", [
    ((30.0,), True, None, True), ((30.0,), True, 0.3, False), ((0.0,), False, None, False),
])  # fmt: skip
def test_a_body_in_one_equation_has_slow_drift_where_its_waves_are_of_a_database(lengths, waves, given_drift, drift,
                                                                                  monkeypatch):  # fmt: skip
    from typing import NamedTuple

    class Run(NamedTuple):
        findings: tuple

    asked = {}
    monkeypatch.setattr(running, "_buoy_and_rope", lambda study, point: ("buoy", "rope"))
    monkeypatch.setattr(running, "_sea", lambda study, db: "sea")
    monkeypatch.setattr(running, "_components", lambda study, db: "components")
    monkeypatch.setattr(running, "waves_carrier", lambda study: "carrier")
    monkeypatch.setattr(running, "body_at", lambda *given, **more: asked.update(more) or "moved")
    monkeypatch.setattr(running, "full_run", lambda *given: asked.update(given=given) or Run(("a", "a")))
    times = SimpleNamespace(begin=lambda steady: "begin")
    study = SimpleNamespace(attachment=SimpleNamespace(z=3.0), waves=SimpleNamespace(drift_tonf_per_m2=given_drift))
    steady = SimpleNamespace(point=SimpleNamespace(lengths=np.array(lengths)))
    found = running._in_one(study, times, steady, "db", waves)
    assert asked["given"][2:] == ("moved", "components" if waves else None, drift, "carrier")
    assert (asked["buoy"], asked["rope"]) == (("buoy", "rope") if lengths[0] else (None, None))
    assert (asked["end_z"], asked["sea"]) == (3.0, "sea" if waves else None)
    left = "waves act by their mean drift only; give --database for first-order motions"
    assert found.findings == (("a",) if waves else (left, "a"))


# ------------------------------------------------------------------ sites, hulls, seas, designs


def test_an_extreme_state_takes_the_current_over_the_draft_and_the_period_of_its_law(monkeypatch):
    profile = SimpleNamespace(velocity=lambda z: np.array([1.5, 0, 0]), over_draft=lambda draft: (1.2, 0.0))
    monkeypatch.setattr(states, "_mean_period", lambda study, climate, height: height + 1.0)
    study = SimpleNamespace(current=SimpleNamespace(draft=None), waves=SimpleNamespace(period=None),
                            site=SimpleNamespace(depth=20.0))  # fmt: skip
    climate, waves = SimpleNamespace(top=(8.0, 12.0)), SimpleNamespace(value=6.0)
    made = states.extreme_state(study, 30.0, waves, climate, profile)
    assert made == {"wind": {"speed": 30.0}, "current": {"speed": 1.5}, "waves": {"height": 6.0, "period": 7.0}}
    study.current.draft, study.waves.period = 5.0, 9.5
    made = states.extreme_state(study, None, waves, None, profile)
    assert made == {"current": {"speed": 1.2}, "waves": {"height": 6.0, "period": 9.5}}
    assert states.extreme_state(study, None, None, climate, None) == {"waves": {"height": 8.0, "period": 9.0}}
    study.waves.period = None
    with pytest.raises(StudyError, match=r"waves.period is missing"):
        states.extreme_state(study, None, waves, None, None)
    study.current.draft = 20.1
    with pytest.raises(ValueError, match=r"current.draft"):
        states.extreme_state(study, None, None, None, profile)


def test_the_mean_period_of_a_state_is_that_of_the_median_of_its_law(monkeypatch):
    class Family:
        def __call__(self, height, **period):
            return SimpleNamespace(T01=period["peak_period"] / 1.28)

    asked = []
    monkeypatch.setattr(
        "hakobune.pipelines.common.weather.seas.family_of", lambda *given: asked.append(given) or Family()
    )
    law = SimpleNamespace(log_period=lambda height: (math.log(2 * height), 0.1), period_kind="peak_period")
    study = SimpleNamespace(climate=SimpleNamespace(spectrum="jonswap"), site=SimpleNamespace(depth=20.0))
    assert states._mean_period(study, SimpleNamespace(law=law), 6.4) == pytest.approx(10.0)
    assert asked[0][1].spectrum == "jonswap" and asked[0][2] == 20.0


class Hull:
    def __init__(self, count, draft=5.0):
        self.count, self.draft, self.points = count, draft, np.array([[10.0, -4.0, 0], [30.0, 8.0, 0]])

    def __len__(self):
        return self.count

    def whole(self):
        return self

    def moved(self, dx, dy):
        return "moved", dx, dy


def test_a_hull_of_a_passage_is_drawn_about_the_middle_of_its_waterline(monkeypatch):
    """From (10, −4) to (30, 8): its middle (20, 2)"""
    moored, asked = SimpleNamespace(shape="mesh", file="m"), []
    study = SimpleNamespace(panels=100, water=SimpleNamespace(depth=20.0), moored=moored)
    monkeypatch.setattr(of_passing, "read_mesh", lambda file: None)
    monkeypatch.setattr(of_passing, "folded", lambda mesh: asked[-1])
    asked.append(Hull(of_passing.MOST * 100, 19.9))
    (kind, dx, dy), middle = of_passing._hull(study, "moored")
    assert (kind, dx, dy) == ("moved", -20.0, -2.0) and middle.tolist() == [20.0, 2.0, 0.0]
    for hull, says in ((Hull(of_passing.MOST * 100 + 1), f"allowed: up to {of_passing.MOST * 100}"),
                       (Hull(10, 20.0), "m has a draft of 20 m in water of 20 m; allowed: less")):  # fmt: skip
        asked.append(hull)
        with pytest.raises(StudyError, match=says):
            of_passing._hull(study, "moored")


class Mesh(SimpleNamespace):
    def __len__(self):
        return len(self.centroids)

    def whole(self):
        return self


def mesh(centroids, areas=((0.0, 0, 1), (0.0, 1, 0))):
    vectors, points = np.array(areas), np.array([[0.0, 0, 0], [100.0, 0, 0]])
    sizes = np.linalg.norm(vectors, axis=1)
    return Mesh(centroids=np.array(centroids, float), area_vectors=vectors, areas=sizes, points=points)


@pytest.mark.parametrize("other, same", [
    (mesh([[5.0, 0, 0], [0.0, 0, 0]], ((0.0, 1, 0), (0.0, 0, 1))), True),
    (mesh([[50 * SAME, 0, 0], [5.0, 0, 0]]), True), (mesh([[200 * SAME, 0, 0], [5.0, 0, 0]]), False),
    (mesh([[0.0, 0, 0], [5.0, 0, 0]], ((0.0, 0, 1 + 0.5 * SAME), (0.0, 1, 0))), True),
    (mesh([[0.0, 0, 0], [5.0, 0, 0]], ((0.0, 0, -1), (0.0, 1, 0))), False),
    (mesh([[0.0, 0, 0]], ((0.0, 0, 1),)), False),
])  # fmt: skip
def test_two_hulls_are_the_same_in_whatever_order_their_panels_stand(other, same):
    """Within a share of 100 m, and of the largest panel"""
    assert _same_hull(mesh([[0.0, 0, 0], [5.0, 0, 0]]), other) is same


def test_a_spectrum_is_written_with_its_confidence_where_it_is_an_estimate(monkeypatch):
    written = {}
    monkeypatch.setattr(of_sea, "write_sealed", lambda path, text: written.update({path: text}))
    monkeypatch.setattr(of_sea, "curve", lambda spectrum: (np.array([0.5, 0.6]), np.array([1.0, 2.0])))
    estimate = SimpleNamespace(degrees_of_freedom=32.0, confidence=lambda share: ([share, 0.8], [3.0, 4.0]))
    found = SimpleNamespace(spectrum=SimpleNamespace(significant_height=3.0, Tp=9.0), title="T", analysed=True,
                            estimate=estimate)  # fmt: skip
    of_sea.write_spectrum("a", found)
    assert written["a"].splitlines() == [
        "# T; 4 sqrt(m0) 3 m, Tp 9 s", "# 95 % confidence band, 32 degrees of freedom",
        "omega_rad_s,density_m2_s_rad,low_m2_s_rad,high_m2_s_rad", "0.5,1,0.95,3", "0.6,2,0.8,4",
    ]  # fmt: skip
    found.analysed = False
    of_sea.write_spectrum("b", found)
    assert written["b"].splitlines()[1:] == ["omega_rad_s,density_m2_s_rad", "0.5,1", "0.6,2"]


@pytest.mark.parametrize("sea, unit", [("sea", "m"), (None, "")])
def test_best_designs_are_told_in_si(sea, unit):
    front = SimpleNamespace(tension=np.array([5.0, 6.0]), behind=np.array([0.5, 0.4]), trials=77, names=("angle_deg",),
                            designs=np.array([[30.0], [90.0]]))  # fmt: skip
    made, axes = front_of(SimpleNamespace(sea=sea), SimpleNamespace(front=front))
    assert made["design.behind"].unit == unit and made["design.tension"].values.tolist() == [5.0, 6.0]
    assert made["design.angle"].values == pytest.approx(np.radians([30, 90])) and axes["design"].values.tolist() == [
        1,
        2,
    ]
    assert front_of(None, SimpleNamespace(front=None)) == ({}, {})


@pytest.mark.parametrize("missing, status, lines", [([], 0, 1), ([1, 2], 1, 2)])
def test_a_sweep_is_checked_by_the_cases_it_has(missing, status, lines, monkeypatch):
    monkeypatch.setattr(checking, "case_count", lambda path: 5)
    monkeypatch.setattr(checking, "pending", lambda path: missing)
    said = []
    assert checking._check_sweep("x.h5", said.append) == status and len(said) == lines
    assert said[0] == f"x.h5: a file of a sweep; {5 - len(missing)} of 5 cases are stored; a sweep has no checksums"
    if missing:
        assert said[1].startswith("FAILS: 2 cases are missing; 'hakobune sweep SWEEP --output x.h5' runs them")


# ------------------------------------------------------------------ hours


def test_an_hour_has_the_largest_force_of_the_ships_that_pass_in_it(monkeypatch):
    """Force by the square of the speed; the third passage falls into an hour that the record has not"""
    start = np.datetime64("2001-01-01T00", "s")

    class Hindcast(SimpleNamespace):
        def __init__(self, time, step, waves, columns, said):
            super().__init__(time=time, step=step, waves=waves, columns=columns, said=said, slot=np.array([0, 1, 3]))

    time = start + np.timedelta64(1, "h") * np.array([0, 1, 3])
    hindcast = Hindcast(time, 3600.0, "waves", {"old": 1}, ("said",))
    record = SimpleNamespace(hindcast=hindcast)
    record._replace = lambda hindcast: hindcast
    monkeypatch.setattr(passages, "record_of", lambda *given: record)
    study = SimpleNamespace(track=SimpleNamespace(current=0.0, speed=2.0))
    monkeypatch.setattr(passages, "read_study", lambda path: (study, ""))
    moments = start + np.timedelta64(1, "m") * np.array([10, 50, 130, 200])
    columns = {"d": np.array([50.0, 60.0, 70.0, 80.0]), "v": np.array([2.0, 4.0, 2.0, 1.0])}
    monkeypatch.setattr(passages, "read_columns", lambda *given: (moments, columns, None))
    monkeypatch.setattr(
        passages, "_forces", lambda study, distance: 1e5 / distance[:, None] * np.array([1.0, 2.0, 3.0])
    )
    table = SimpleNamespace(study="s", file="p.csv", time="t", distance="d", speed="v")
    read = SimpleNamespace(hindcast=SimpleNamespace(zone="UTC"), passages=table)
    found = passages.record_with_passages(read, Path(), 20.0)
    first, _, third = passages.PASSING
    surge = found.columns[first]
    assert surge == pytest.approx([max(2.0, 4 * 1e2 / 60), 0.0, 0.25 * 1e2 / 80])
    assert found.columns[third] == pytest.approx(3 * surge) and found.columns["old"] == 1
    assert found.said == ("said", "3 of 4 passages in p.csv fall within the hours of the record")
    study.track.current = 0.5
    with pytest.raises(StudyError, match=r"track.current = 0.5; allowed: 0"):
        passages.record_with_passages(read, Path(), 20.0)
    study.track.current, columns["v"][1] = 0.0, 0.0
    with pytest.raises(StudyError, match="a distance or a speed is missing or 0"):
        passages.record_with_passages(read, Path(), 20.0)
    read.passages = None
    assert passages.record_with_passages(read, Path(), 20.0) is record


class Found(SimpleNamespace):
    def __getitem__(self, name):
        return {"transmission": np.array([[0.9, 0.2], [0.9, 0.8]])}[name]


def test_behind_a_breakwater_twice_the_crest_height_passes_between_its_periods(monkeypatch):
    """K_T 0.2 at 4 s and 0.8 at 8 s, of the holding that is wanted, straight over ω and constant beyond"""
    monkeypatch.setattr(lee, "limits_of", lambda read, points, units: units)
    design = SimpleNamespace(holding="taut", theory="exact")
    found = Found(labels={"holding": SimpleNamespace(values=np.array(["fixed", "taut, exact"])),
                          "period": SimpleNamespace(values=np.array([4.0, 8.0]))},
                  detail=SimpleNamespace(study=SimpleNamespace(design=design)))  # fmt: skip
    monkeypatch.setattr(lee, "breakwater", lambda path: found)
    read = SimpleNamespace(points=[], keel=None, turned_deg=[], lee=SimpleNamespace(study="b.toml", holding=None))
    limits, response, (note,) = lee.lee(read, Path())
    omega, power = response.omega, response.power
    low, high = 2 * np.pi / 8, 2 * np.pi / 4
    wanted = np.interp(omega, [low, high], [0.8, 0.2])
    assert power[:, 0, 0] == pytest.approx((2 * wanted) ** 2) and list(limits.values()) == ["m"]
    assert note.startswith("behind taut, exact of b.toml: K_T for waves along its normal with periods of 4 to 8 s")
    read.lee.holding = "fixed"
    assert np.unique(lee.lee(read, Path())[1].power) == pytest.approx([(2 * 0.9) ** 2])
    read.lee.holding = "loose"
    with pytest.raises(StudyError, match=r"lee.holding is 'loose'; allowed: fixed, taut, exact"):
        lee.lee(read, Path())
    read.keel = 1
    with pytest.raises(StudyError, match=r"keel is given together with \[lee\]; keel needs a floating body"):
        lee.lee(read, Path())


@pytest.mark.parametrize("names", [(), ("p", "q", "r")])
def test_every_quantity_of_every_body_stands_in_the_table(names, monkeypatch):
    from hakobune.pipelines.solve import report

    rows = {
        name: [("mass", f"1{name}", "t"), ("draft", f"2{name}", "m"), ("GM", f"3{name}", "m")] for name in names or "x"
    }
    monkeypatch.setattr(report, "each_body", lambda db: [SimpleNamespace(name=name) for name in names or "x"])
    monkeypatch.setattr(report, "_body_rows", lambda body: rows[body.name])
    table = report.body_table(SimpleNamespace(bodies=names))
    assert [column.header for column in table.columns] == ["quantity", *(names or ["value"]), "unit"]
    cells = [list(column.cells) for column in table.columns]
    assert cells[0] == ["mass", "draft", "GM"] and cells[-1] == ["t", "m", "m"]
    assert cells[1:-1] == [[value for _, value, _ in rows[name]] for name in names or "x"]
