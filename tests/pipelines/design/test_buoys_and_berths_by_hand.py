"""What a case of a buoy and one of a berth take from where, with lines, files and pictures that are made up."""

import math
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds import berth, single_point

# ------------------------------------------------------------------ a buoy in other water


def laid(weakest=1e9):
    """Stand-in of `_laid`: anchors lie 100 + 10 ln P − h m away, of a pretension P kN and a depth h m"""

    def made(study, mooring, depth):
        away = 100 + 10 * math.log(mooring.get("pretension_kN", 50.0)) - depth
        point = SimpleNamespace(position=(0.6 * away, -0.8 * away, -depth))
        return SimpleNamespace(points=[point], breaking_load=np.array([2e9, weakest]))

    return made


STUDY = {
    "water": {"depth": 20.0, "density": 1025.0},
    "mooring": {"length": 150.0, "type": "chain", "top_tension_tonf": 5.0, "headings_deg": [0.0, 120.0, 240.0]},
}


def test_lines_in_deeper_water_have_the_pretension_that_reaches_the_same_anchors(monkeypatch):
    """2 m more are made up by ln P that is 0.2 more: P = 50 e^0.2 kN; what else was given for the tension is left"""
    monkeypatch.setattr(single_point, "_laid", laid())
    made = single_point._laid_again(STUDY, 22.0)
    assert made == {"length": 150.0, "type": "chain", "headings_deg": [0.0, 120.0, 240.0],
                    "pretension_kN": pytest.approx(50 * math.exp(0.2), rel=1e-8)}  # fmt: skip


@pytest.mark.parametrize(("weakest", "reached"), [(62e3, True), (61e3, False)])
def test_a_pretension_is_at_most_the_weakest_breaking_load(monkeypatch, weakest, reached):
    """61.07 kN are needed"""
    monkeypatch.setattr(single_point, "_laid", laid(weakest))
    if reached:
        assert single_point._laid_again(STUDY, 22.0)["pretension_kN"] == pytest.approx(61.07, rel=1e-3)
    else:
        away = 100 + 10 * math.log(50) - 20
        says = rf"lines of 150 m do not reach their anchors {away:.4g} m away in 22 m of water; lengthen them"
        with pytest.raises(StudyError, match=says):
            single_point._laid_again(STUDY, 22.0)


def test_a_case_is_laid_again_in_other_water_alone_and_has_its_hull_in_every_stream(monkeypatch):
    monkeypatch.setattr(single_point, "_laid_again", lambda study, depth: {"laid": (study["water"]["depth"], depth)})
    base = STUDY | {"of_hull": {"wind": {"ship": "tanker"}, "current": {"turning": 1.0}, "waves": {"spectrum": "issc"}}}
    same = single_point.at(base, 20.0, {"wind": {"speed": 10.0}})
    assert same["mooring"] == STUDY["mooring"] and same["wind"] == {"ship": "tanker", "speed": 10.0}
    assert "of_hull" not in same and "current" not in same and "of_hull" in base
    other = single_point.at(base, 22.0, {"current": {"speed": 1.0}, "waves": {"height": 2.0}})
    assert other["mooring"] == {"laid": (20.0, 22.0)} and other["water"] == {"depth": 22.0, "density": 1025.0}
    assert other["current"] == {"turning": 1.0, "speed": 1.0} and other["waves"] == {"spectrum": "issc", "height": 2.0}


def test_lines_of_a_count_have_headings_all_around_from_the_first():
    raw = STUDY | {"mooring": {"count": 4, "first_deg": 15.0}, "wind": {"speed": 9.0, "gusts": "kaimal"}, "maps": {},
                   "waves": {"height": 3.0, "drift_tonf_per_m2": 0.2}, "slewing": {"duration": 9.0}}  # fmt: skip
    base = single_point.base(raw, None)
    assert base["mooring"] == {"headings_deg": [15.0, 105.0, 195.0, 285.0]} and base["allowable"] == 1.0
    assert base["of_hull"] == {"wind": {"gusts": "kaimal"}, "current": {}, "waves": {"drift_tonf_per_m2": 0.2}}
    assert not {"wind", "waves", "maps"} & set(base) and "slewing" in base
    raw["mooring"] = {"count": 2}
    assert single_point.base(raw, None)["mooring"]["headings_deg"] == [0.0, 180.0]
    assert single_point.lost(base) == ["line at 15°", "line at 105°", "line at 195°", "line at 285°"]
    assert single_point.without(base, "line at 195°")["mooring"]["headings_deg"] == [15.0, 105.0, 285.0]
    assert len(base["mooring"]["headings_deg"]) == 4
    assert single_point.finds({"slewing": {}}) == (single_point.STABLE, single_point.SLEWING, "excursion")
    assert single_point.finds({}) == (single_point.STABLE, "excursion")


def test_every_place_of_rest_has_its_buoy_checked_and_all_are_in_the_plan(monkeypatch):
    place, drawn, checked = "hakobune.pipelines.single_point", [], []
    monkeypatch.setattr(single_point, "make_study", lambda raw: ("study", raw))
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: f"open {path}")
    monkeypatch.setattr(f"{place}.study.make", lambda study, db: SimpleNamespace(point=(study, db)))
    monkeypatch.setattr("hakobune.mooring.single_point.equilibria.equilibria", lambda point: ["ahead", "abeam"])
    monkeypatch.setattr(f"{place}.study.check_buoy", lambda made, one: checked.append(one))
    monkeypatch.setattr(f"{place}.pictures.draw_plan", lambda *given: drawn.append(given))
    single_point.draw("raw", "a.h5", None, "p.png")
    study = ("study", "raw")
    assert drawn == [(study, (study, "open a.h5"), ["ahead", "abeam"], "p.png")] and checked == ["ahead", "abeam"]
    single_point.draw("raw", None, None, "p.png")
    assert drawn[1][1] == (study, None)


# ------------------------------------------------------------------ a berth


class Column:
    """Texts of a dataset"""

    def __init__(self, *names):
        self.names = names

    def asstr(self):
        return np.array(self.names)

    def __len__(self):
        return len(self.names)


def file_of(**attributes):
    names = "surge", "sway", "yaw"
    return {"line": Column("chain", "rope"), "anchor": np.full((2, 3), 1.0), "fairlead": np.full((2, 3), 2.0),
            "deflection": np.zeros((1, 9, 1)), "seed": np.arange(3), "names": names}, attributes  # fmt: skip


@pytest.fixture
def case(monkeypatch):
    """Parts of a case at a berth with one chain and one rope: what it asked for"""
    asked = {}
    of_file, attributes = file_of(place_at_rest=np.array([0.5, -1.0, 0, 0, 0, 0.1]),
                                  natural_period=[60.0, np.nan, 45.67], design_spectrum="by the spectrum")  # fmt: skip

    class File(dict):
        attrs = attributes

    db = SimpleNamespace(sizes="sizes", rotation_center="center", density=1025.0, gravity=9.8)
    chain, rope = SimpleNamespace(length=200.0), SimpleNamespace(length=40.0, breaking_load=5e5)
    there = SimpleNamespace(fenders=["f"], ropes=[rope])
    made = SimpleNamespace(hulls_of=lambda db: ("hull", db.sizes), berth_of=lambda db, hull: there)
    held = SimpleNamespace(system=SimpleNamespace(lines=[chain]), lines=SimpleNamespace(tension_b=np.array([7e4])))
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: db)
    monkeypatch.setattr(berth, "make_study_of", lambda path: asked.update(study=path) or made)
    monkeypatch.setattr("hakobune.pipelines.simulate.file.opened", lambda path: nullcontext(File(of_file)))
    means = {"surge": 1.0, "sway": 2.0, "yaw": 0.3}
    monkeypatch.setattr("hakobune.pipelines.simulate.file.summary_of",
                        lambda file, name: {"mean": means[name], "largest": 9.0, "sigma": 8.0})  # fmt: skip
    monkeypatch.setattr(berth, "_of_fenders", lambda file, study, berth: {"strain": {"f": 0.2}})
    monkeypatch.setattr("hakobune.pipelines.simulate.berth.findings_on_periods", lambda file: ["slow"])
    monkeypatch.setattr("hakobune.pipelines.simulate.berth.findings_on_fenders", lambda file: ["soft", "seen"])
    pulls = np.array([1e3, 2e3])  # of the fender, then of the rope
    monkeypatch.setattr("hakobune.mooring.motion.contacts.contact_forces",
                        lambda berth, place: asked.update(place=place) or pulls)  # fmt: skip
    monkeypatch.setattr("hakobune.pipelines.simulate.file.bodies_of", lambda file: ())
    monkeypatch.setattr(berth, "_at_rest", lambda *given: asked.update(rest=given) or held)
    return SimpleNamespace(asked=asked, made=made, db=db)


def runs():
    both = {name: np.array([value, value + 1.0]) for name, value in
            (("mean", 10.0), ("breaking", 20.0), ("horizontal", 30.0), ("uplift", 40.0))}  # fmt: skip
    largest = {1.0: np.array([50.0, 51.0]), 1.5: np.array([99.0, 99.0])}
    return both | {"largest": largest, "motions": np.arange(6.0), "parts": {}, "findings": ("seen", "waves")}


def test_numbers_of_a_berth_are_of_its_lines_and_then_of_its_ropes(case):
    found = berth.berth_numbers({"lines": [{"type": "R3"}]}, "a.h5", Path("cases/storm_runs.h5"), runs())
    assert case.asked["study"] == Path("cases/storm.toml")
    assert found.names == ("chain", "rope") and found.types == (("R3",), ("rope",))
    assert found.length.tolist() == [200.0, 40.0] and found.pretension.tolist() == [7e4, 2e3]
    assert found.static.tolist() == [10.0, 11.0] and found.largest.tolist() == [50.0, 51.0]
    assert found.breaking.tolist() == [20.0, 21.0] and found.horizontal.tolist() == [30.0, 31.0]
    assert found.uplift.tolist() == [40.0, 41.0] and found.motions.tolist() == [0, 1, 2, 3, 4, 5]
    assert found.place.tolist() == [1.0, 2.0, 0.3] and found.parts == {"strain": {"f": 0.2}}
    assert found.anchor[0].tolist() == [1.0] * 3 and found.fairlead[0].tolist() == [2.0] * 3
    start = [0.5, -1.0, 0, 0, 0, 0.1]
    assert case.asked["place"].tolist() == start and found.bodies == ()
    study, db, hull, at = case.asked["rest"]
    assert (study, db, hull) == (case.made, case.db, ("hull", "sizes")) and at.tolist() == start
    periods = "natural periods of small motions at the berth: surge 60 s, yaw 45.7 s"
    few = found.warnings[3]
    assert few.startswith("steady strains come from 1 of 3 runs") and few.endswith("simulation.keep_series = 3")
    assert found.warnings == ("seen", "waves", periods, few, "slow", "soft", "by the spectrum")


def test_a_berth_of_ropes_alone_has_their_lengths_and_pulls(case, monkeypatch):
    monkeypatch.setattr(berth, "_at_rest", lambda *given: None)
    found = berth.berth_numbers({"lines": []}, "a.h5", Path("cases/storm_runs.h5"), runs())
    assert found.length.tolist() == [40.0] and found.pretension.tolist() == [2e3] and found.types == (("rope",),)


@pytest.mark.parametrize(("kept", "count", "said"), [(3, 3, 0), (2, 3, 1)])
def test_steady_strains_of_all_runs_need_no_remark(kept, count, said):
    assert len(list(berth._steady_of_few({"deflection": np.zeros(kept), "seed": np.zeros(count)}))) == said


def test_a_body_that_nothing_holds_has_no_period():
    file = SimpleNamespace(attrs={"natural_period": [np.nan] * 3})
    (line,) = berth._periods(file)
    assert line.endswith("at the berth: none, since nothing holds the body at rest")
    assert not list(berth._periods(SimpleNamespace(attrs={})))  # several bodies


def test_lines_at_a_berth_are_held_where_the_body_rests_there(monkeypatch):
    """At its place in the study and the displacement at the berth together"""
    held = []
    body = SimpleNamespace(name="ship", position=(1.0, 2.0, 3.0, 0.0, 0.0, 0.5))
    system = SimpleNamespace(bodies=[body])
    made = SimpleNamespace(system_of=lambda *given: held.append(given) or system)
    equilibrium = "hakobune.mooring.lines.system.equilibrium"
    monkeypatch.setattr(f"{equilibrium}.held_at", lambda system, poses: held.append(poses) or system)
    monkeypatch.setattr(f"{equilibrium}.rest", lambda system: ("rest", system))
    db = "db"
    start = np.array([0.5, -1.0, 0.25, 0.0, 0.0, 0.1])
    assert berth._at_rest(made, db, "hull", start) == ("rest", system)
    asked, poses = held
    assert asked == ("db", "hull") and poses["ship"] == pytest.approx((1.5, 1.0, 3.25, 0, 0, 0.6))
    made.system_of = lambda *given: None
    assert berth._at_rest(made, db, "hull", start) is None


def test_a_case_of_a_buoy_is_checked_with_its_body(monkeypatch):
    asked = []
    monkeypatch.setattr(single_point, "make_study", lambda study: f"made {study}")
    monkeypatch.setattr("hakobune.pipelines.single_point.checked.checked", lambda *given: asked.append(given))
    body = SimpleNamespace(name="two.h5", bodies=())
    single_point.checked("study", body, "folder")
    single_point.checked("study", None, "folder")
    assert asked == [("made study", body), ("made study", None)]
    body.bodies = SimpleNamespace(name="tanker"), SimpleNamespace(name="buoy")
    with pytest.raises(StudyError, match=r"two.h5 has 2 bodies, tanker, buoy; allowed with a single-point study: one "):
        single_point.checked("study", body, "folder")
