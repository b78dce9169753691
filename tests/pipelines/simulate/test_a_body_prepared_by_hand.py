"""A moored body prepared for runs, with the physics replaced: which parts it is made of, what it is refused for, and
what is told of effects that are left out; and statics of lines where they pull most."""

from dataclasses import dataclass
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import work

MOORING = "hakobune.mooring.motion"


class Study(msgspec.Struct):
    """A study whose parts are words"""

    name: str = "study"
    hull: str | None = None
    hulls: dict = {}
    hinges: str = "hinges"
    quay: str | None = None

    def hulls_of(self, db):
        return db.hulls

    def remarks(self, hull, db):
        return ("remark",)

    def system_of(self, db, hull, in_time=False):
        assert (hull, in_time) == (db.hulls, True)
        return SimpleNamespace(line_names=("a", "b"))

    def anchors_on(self, names):
        ASKED.append(("anchors", names))

    def berth_of(self, db, hull):
        return "berth"


@dataclass(frozen=True)
class Settings:
    memory: str = "auto"
    slow_drift: str = "newman"
    dynamic_lines: object = "auto"


@dataclass(frozen=True)
class Plan:
    weather: object
    settings: Settings = Settings()
    sides: object = None
    stations: object = None
    pace: object = None
    told: tuple = ()


ASKED = []
WITH_PAIRS = work.with_pairs


class Moored(SimpleNamespace):
    @property
    def dynamic_stiffness(self):
        ASKED.append("stiffness")


@pytest.fixture
def prepare(monkeypatch):
    def call(
        settings=None,
        weather=None,
        study=None,
        of_quay=(),
        viscous=None,
        modes=(),
        waves=None,
        memory=None,
        free=(0, 1),
        links=(),
        hulls="hull",
    ):
        ASKED.clear()
        given = SimpleNamespace(**{"seas": ["sea"], "waves": "waves", "components": None, "wind": None, "current": None}
                                | (weather or {}))  # fmt: skip
        plan = Plan(given, Settings(**settings or {}))
        reader = SimpleNamespace(viscous=viscous, floating=lambda: "floating", links=links, rigid=12,
                                 ring=None, bodies=(),
                                 between=SimpleNamespace(forget=lambda: ASKED.append("forgotten")))  # fmt: skip
        water = SimpleNamespace(words=("surge", "sway"), omega="omega")
        db = SimpleNamespace(bodies_reader=water, modes=modes, reader="own",
                             path="b.h5", wall=None, hulls=hulls)  # fmt: skip
        body = Moored(free=free, reader=reader, start=np.arange(14.0))  # 12 of bodies, 2 of shapes
        choice = SimpleNamespace(settings="chosen", left_out=("lines",), words=("trial",), pace=(1.0, 2.0))

        def moored(*parts, **more):
            ASKED.append(("moored", parts, more))
            return body

        def note(name, answer):
            return lambda *of: ASKED.append((name, *of)) or answer

        monkeypatch.setattr(work, "_prepared", {})
        monkeypatch.setattr(work, "database_of", lambda path: db if path in ("b.h5", db) else None)
        monkeypatch.setattr(work, "plan_of", lambda *of: ASKED.append(("plan", *of)) or plan)
        monkeypatch.setattr(work, "units_of_shapes", lambda db: "shapes")
        monkeypatch.setattr(work, "stations_of", lambda study, db: "stations")
        monkeypatch.setattr(work, "check_names", note("names", None))
        monkeypatch.setattr(work, "body_of", lambda study, db: (reader, of_quay))
        monkeypatch.setattr(
            work, "linked", lambda of, hinges, db: reader if (of, hinges) == (reader, "hinges") else None
        )
        monkeypatch.setattr(work, "damping", lambda study, body: 5.0 if body == "floating" else None)
        monkeypatch.setattr(work, "quadratic", lambda study, words: 7.0)
        monkeypatch.setattr(work, "spring", lambda study, words: "spring")
        monkeypatch.setattr(work, "motions_of", lambda study, words: "motions")
        monkeypatch.setattr(work, "level_of_pairs", lambda study, seas, drift: ("level", seas, drift))
        monkeypatch.setattr(work, "_without_pairs", lambda *of: ASKED.append(("without", *of[1:])) or ("no pairs",))
        monkeypatch.setattr(work, "with_pairs", lambda *of: WITH_PAIRS(*of) if modes else (plan, ("pairs",)))
        monkeypatch.setattr(work, "_lines_chosen", lambda task, body, plan: choice)
        monkeypatch.setattr(work, "_remembering", note("remembering", body))
        monkeypatch.setattr(work, "sides_of", lambda db: "sides")
        monkeypatch.setattr(
            work, "check_floats", lambda boxes, rises: ASKED.append(("floats", list(boxes), rises.tolist()))
        )
        monkeypatch.setattr(work, "_check_start", note("start", None))
        monkeypatch.setattr(work, "_placed", lambda *of: ())
        monkeypatch.setattr(f"{MOORING}.simulation.moored", moored)
        monkeypatch.setattr(f"{MOORING}.moving_lines.prepare.moving_of", note("moving", None))
        monkeypatch.setattr(f"{MOORING}.wave_loads.no_wave_forces", lambda reader: "no waves")
        monkeypatch.setattr("hakobune.bem.time_domain.memory.no_memory", lambda reader: "no memory")
        monkeypatch.setattr("hakobune.mooring.response.viscous.in_time", lambda own, waves: SimpleNamespace(
            damping=100.0, quadratic=200.0) if (own, waves) == ("own", "waves") else None)  # fmt: skip
        task = work.Task(study or Study(), "b.h5", 600.0, memory, "folder")
        found = work.prepared(task, waves=waves)
        return found, body, reader, plan, task

    return call


def made_of():
    return next(one for one in ASKED if one[0] == "moored")[1:]


def test_a_body_is_made_of_its_lines_berth_damping_and_waves_once_for_all_seeds(prepare):
    (found, plan, said), body, reader, given, task = prepare()
    assert found is body and said == ("remark",)
    assert ("plan", task.study, "omega", None, 600.0, "folder", ("surge", "sway"), "shapes") in ASKED
    parts, more = made_of()
    assert parts[0] is reader and parts[1].line_names == ("a", "b") and parts[2] is None
    assert more == {"memory": None, "damping": 5.0, "quadratic": 7.0, "berth": "berth", "spring": "spring",
                    "motions": "motions", "waves": None, "linearised_in": "waves", "turned": False}  # fmt: skip
    assert ("names", given.settings, ("a", "b")) in ASKED and ("anchors", ("a", "b")) in ASKED
    assert ("moving", body, "chosen") in ASKED and not any(one[0] == "floats" for one in ASKED)
    assert ("start", "sides", body, given.settings) in ASKED and ASKED[-2:] == ["stiffness", "forgotten"]
    assert (plan.sides, plan.stations, plan.settings, plan.pace) == ("sides", "stations", "chosen", (1.0, 2.0))
    assert plan.told == work.first_what_is_left_out(("lines", "pairs", "trial"))
    before = len(ASKED)
    assert work.prepared(task)[0] is body and len(ASKED) == before
    assert work.prepared(work.Task(Study("other"), "b.h5", 600.0, None, "folder"))[0] is body and len(ASKED) > before


@pytest.mark.parametrize("hulls, boxes", [
    ("hull", [(work.ALONE, "hull")]), ({"ship": "s", "barge": "b"}, [("ship", "s"), ("barge", "b")]),
])  # fmt: skip
def test_bodies_on_hinges_rise_at_rest_by_their_heaves_and_one_body_is_named_as_one(prepare, hulls, boxes):
    prepare(links=("hinge",), hulls=hulls)
    assert ("floats", boxes, [2.0, 8.0]) in ASKED


@pytest.mark.parametrize("weather, study, exposed", [
    ({}, {}, False), ({"wind": "wind"}, {}, True), ({"current": "current"}, {}, True), ({}, {"hull": "h"}, True),
    ({}, {"hulls": {"a": 1}}, True),
])  # fmt: skip
def test_a_hull_is_exposed_to_wind_and_current_or_where_it_is_given(prepare, weather, study, exposed):
    prepare(weather=weather, study=Study(**study))
    assert made_of()[0][2] == ("hull" if exposed else None)


@pytest.mark.parametrize("weather, waves, found", [
    ({"seas": [], "waves": None}, None, "no waves"), ({"seas": [], "waves": None}, "given", "no waves"),
    ({"seas": []}, None, None), ({}, "given", "given"), ({"seas": [], "components": "c"}, "given", "given"),
])  # fmt: skip
def test_calm_water_has_no_wave_forces_and_those_of_another_sea_are_taken(prepare, weather, waves, found):
    prepare(weather=weather, waves=waves)
    assert made_of()[1]["waves"] == found and ("forgotten" in ASKED) == (waves is None)


@pytest.mark.parametrize("settings, of_quay, memory, found, remembers", [
    ({}, (), None, None, False), ({"memory": "constant"}, (), None, "no memory", False),
    ({}, ("q",), None, "no memory", True),
    ({"memory": "constant"}, ("q",), None, "no memory", False), ({"memory": "constant"}, (), "kept", "kept", False),
    ({}, ("q",), "kept", "kept", False),
])  # fmt: skip
def test_memory_is_fitted_except_before_a_quay_or_where_none_is_wanted(
    prepare, settings, of_quay, memory, found, remembers
):
    (_, _, said), *_ = prepare(settings, of_quay=of_quay, memory=memory)
    assert made_of()[1]["memory"] == found and said == ("remark", *of_quay)
    assert any(one[0] == "remembering" for one in ASKED) is remembers


@pytest.mark.parametrize("of_quay, viscous, added", [((), None, 0), (("q",), None, 1), (("q",), "own", 0)])
def test_a_quay_by_the_far_field_has_the_viscous_damping_of_open_water(prepare, of_quay, viscous, added):
    prepare(of_quay=of_quay, viscous=viscous)
    more = made_of()[1]
    assert (more["damping"], more["quadratic"]) == (5.0 + 100 * added, 7.0 + 200 * added)


@pytest.mark.parametrize("settings, weather, bends", [
    ({}, {}, True), ({"slow_drift": "none"}, {}, False), ({}, {"seas": [], "waves": None}, False),
])  # fmt: skip
def test_bodies_that_bend_have_newmans_rule_and_say_so(prepare, settings, weather, bends):
    (_, plan, _), *_ = prepare(settings, weather, modes=("bending",))
    seas = bool({"seas": ["sea"]} | weather == {"seas": ["sea"]}) if not weather else bool(weather["seas"])
    drift = settings.get("slow_drift", "newman")
    assert ("without", ("level", seas, drift), "bodies that bend") in ASKED
    assert (work.OF_SHAPES in plan.told) is bends and "no pairs" in plan.told and "pairs" not in plan.told


@pytest.mark.parametrize("free, held", [((0, 1), None), ((1,), "surge"), ((), "surge, sway")])
def test_motions_that_are_held_are_told(prepare, free, held):
    (_, plan, _), *_ = prepare(free=free)
    line = f"{work.LEFT_OUT} {held}: fixed at rest, as set by simulation.motions"
    assert (line in plan.told) == (held is not None) and plan.told[0].startswith(work.LEFT_OUT) == (held is not None)


# ------------------------------------------------------------------ statics where lines pull most


def test_the_largest_use_counts_segments_and_leaves_out_lines_of_unknown_strength(monkeypatch):
    monkeypatch.setattr(
        work, "_at_rest_in", lambda body, motion: SimpleNamespace(utilisation=np.array([0.1, motion[0], 0.3]))
    )
    system = SimpleNamespace(breaking_load=np.array([1e6, 2e6, np.inf]), composites=[SimpleNamespace(number=1)])
    ropes = [SimpleNamespace(breaking_load=5e5)]
    tension = np.array([[2e5, 3e5, 9e9, 1e5], [1e5, 4e5, 8e9, 4e5]])
    body = SimpleNamespace(system=system, berth=SimpleNamespace(ropes=ropes))
    found = work.largest_use(body, np.array([[0.15], [0.95]]), tension)
    assert found == pytest.approx([0.2, 0.95, np.nan, 0.8], nan_ok=True)
    low = work.largest_use(body, np.array([[0.15], [0.05]]), tension)
    assert low[1] == pytest.approx(0.2)
    alone = SimpleNamespace(system=None, berth=SimpleNamespace(ropes=ropes))
    assert work.largest_use(alone, None, tension[:, 3:]) == pytest.approx([0.8])


@pytest.mark.parametrize("level, drift, seas, told", [
    ("newman", "newman", ["s"], 1), ("auto", "newman", ["s"], 1), ("auto", "none", ["s"], 0), ("auto", "newman", [], 0),
    ("body", "newman", ["s"], None), ("full", "none", [], None),
])  # fmt: skip
def test_bodies_without_pairs_say_what_is_left_out_and_refuse_more(level, drift, seas, told):
    plan = SimpleNamespace(weather=SimpleNamespace(seas=seas), settings=SimpleNamespace(slow_drift=drift))
    if told is None:
        with pytest.raises(StudyError, match=f'simulation.qtf is \'{level}\' with a quay; allowed: "newman", "auto"'):
            work._without_pairs(plan, level, "a quay")
        return
    line = f"{work.LEFT_OUT} the slow force of wave pairs beyond Newman's approximation, for a quay"
    assert work._without_pairs(plan, level, "a quay") == (line,) * told


@pytest.mark.parametrize("quay, level, way", [
    ("q", "auto", ("in front of a quay only Newman's approximation is available",)),
    (None, "auto", ("'hakobune qtf b.h5' stores them, for several directions with --heading",)), (None, "body", ()),
])  # fmt: skip
def test_the_way_to_pairs_is_the_command_that_stores_them(quay, level, way):
    assert work._way(SimpleNamespace(quay=quay), SimpleNamespace(path="b.h5"), level) == way


@pytest.mark.parametrize("ramp, duration, step, first, last, count", [
    (0.0, 1.0, 0.25, 0.0, 1.0, 5), (0.5, 1.0, 0.25, 0.0, 1.0, 5), (0.6, 1.0, 0.25, 0.15, 0.9, 4),
    (0.1, 0.3, 0.1, 0.0, 0.3, 4),
])  # fmt: skip
def test_samples_that_are_kept_begin_after_the_ramp(ramp, duration, step, first, last, count):
    time = work.sample_times(SimpleNamespace(ramp=ramp, duration=duration, step=step))
    assert len(time) == count and time[[0, -1]] == pytest.approx([first, last], abs=1e-12)
    assert np.diff(time) == pytest.approx(np.full(count - 1, step))
