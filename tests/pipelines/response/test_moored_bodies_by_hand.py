"""What a response on a mooring is made of, with the physics replaced: which parts go where, and what is told."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.response import viscous as of_viscous
from hakobune.mooring.studies import long_period as of_period
from hakobune.mooring.studies import multi_point as of_mooring
from hakobune.mooring.studies import slow_motion as of_motion
from hakobune.mooring.studies.conditions import Waves
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor import study as of_study
from hakobune.pipelines.response import moored
from hakobune.pipelines.response import study as of_response

DEEP = SimpleNamespace(peak_omega=0.5)


@dataclass(frozen=True)
class Conditions:
    waves: object = None
    sea: object = None
    method: str = "regular_wave"
    duration: float = 0.0
    current: object = None


class Body:
    """A reader that notes what is done to it"""

    depth = 20.0

    def __init__(self, name, stiffness=None):
        self.name, self.stiffness = name, stiffness

    def floating(self):
        return Body(f"floating {self.name}", self.stiffness)

    def restrained(self, damping=None, stiffness=None):
        return Body(f"{self.name} on lines", stiffness)


SEA = SimpleNamespace(spectrum=SimpleNamespace(significant_height=3.0, T01=8.0, peak_omega=0.5), direction=0.3)
K = np.diag([4e5, 9e5, 1.0, 2.0, 3.0, 5e8])


@pytest.fixture
def house(monkeypatch):
    asked = {}
    statics = SimpleNamespace(
        equilibrium=SimpleNamespace(stiffness=K),
        displacement=np.arange(6.0),
        steady_force=np.array([1e4, -2e4, 0, 0, 0, 5e6]),
        loads={"wind": np.array([1.0, 2, 3, 4, 5, 6])},
        warnings=["FAILS: bow", "note: stern"],
    )
    given = Conditions(waves="own waves", current="stream")
    study = SimpleNamespace(
        without_berth=lambda what: asked.update(berth=what) or study, hull_of=lambda sizes: f"hull of {sizes}",
        system=lambda *all: asked.update(system=all) or SimpleNamespace(lines=[1, 2, 3]), conditions=lambda: given,
        wind="wind", allowable=0.5,
    )  # fmt: skip

    def note(name, value):
        def call(*all, **more):
            asked[name] = (*all, more) if more else all
            return value(*all) if callable(value) else value

        return call

    monkeypatch.setattr(of_study, "read_study", lambda path: (study, "text"))
    monkeypatch.setattr(of_mooring, "multi_point", note("multi_point", statics))
    monkeypatch.setattr(of_period, "long_period", note("long_period", SimpleNamespace(
        damping=np.array([0.1, 0.2, 0.05]), period=np.array([100.0, np.nan, 50.0]))))  # fmt: skip
    monkeypatch.setattr(of_motion, "slow_motion", note("slow_motion", "slow"))
    monkeypatch.setattr(of_response, "viscous_laws", lambda *of: "laws" if of == (read, db) else of)
    monkeypatch.setattr(of_response, "viscous_words", lambda held, laws, damping: (f"{held.name} {laws} {damping}",))
    monkeypatch.setattr(of_viscous, "in_sea", lambda body, sea, laws, *held: (held[0] if held else body, "damped"))
    monkeypatch.setattr("hakobune.mooring.on_current.body.on_current",
                        lambda body, carrier: Body(f"{body.name}, {carrier}", body.stiffness))  # fmt: skip
    monkeypatch.setattr("hakobune.mooring.on_current.waves.carrier_of", lambda current: f"carried by {current}")
    monkeypatch.setattr(moored, "gusts_of", lambda wind: asked.get("gusts"))
    reader = Body("body")
    db = SimpleNamespace(
        reader=reader, sizes="sizes", rotation_center="center", density=1025.0, gravity=9.8, water_depth=np.inf
    )
    read = SimpleNamespace(current=None, restrained=lambda body: Body(f"read {body.name}", body.stiffness))
    return SimpleNamespace(asked=asked, statics=statics, study=study, db=db, read=read, given=given)


def test_a_body_on_its_mooring_moves_on_the_stiffness_of_its_lines_under_the_steady_forces(house):
    """Damping ν of a period T is ν K T/2π a mode; a mode without a period has none"""
    found = moored.moored("m.toml", house.read, house.db, SEA, 3600.0, "points")
    asked = house.asked
    assert asked["berth"] == "response --moored" and asked["system"] == ("hull of sizes", "center", 1025.0, 9.8)
    db, _, hull, conditions, allowable = asked["multi_point"]
    assert (db, hull, allowable) == (house.db, "hull of sizes", 0.5) and conditions.method == "irregular"
    assert conditions.waves == Waves(3.0, 8.0, 0.3)
    assert (conditions.sea, conditions.duration, conditions.current) == (SEA, 3600.0, "stream")
    free, held, sea, duration, loads, points = asked["slow_motion"]
    assert free.name == "body, carried by stream" and (sea, duration, points) == (SEA, 3600.0, "points")
    assert held.name == "read floating body on lines, carried by stream"
    offset, gust, water, _ = loads
    assert offset is house.statics.displacement and gust is None
    assert water == pytest.approx([0.1 * 4e5 * 100 / (2 * math.pi), 0.0, 0.05 * 5e8 * 50 / (2 * math.pi)])
    assert asked["long_period"] == (house.db, "hull of sizes", house.statics, None)
    assert found.motion == "slow" and found.failures == ("FAILS: bow",) and found.stiffness is K
    assert found.notes == (
        "moored by 3 lines of m.toml: steady forces Fx 10, Fy -20 kN, Mz 5000 kN m; slow drift by Newman's rule; the "
        "drag of the hull is linearised; give the drag of the lines by body.damping_ratio",
        "the waves of m.toml are not used; the waves are those of the response study",
        "read floating body on lines, carried by stream laws damped",
    )


def test_gusts_push_with_the_wind_of_the_plane_and_bound_waves_are_told_in_shallow_water(house, monkeypatch):
    house.asked["gusts"] = gusts = SimpleNamespace(name="NPD")
    house.db.water_depth = 20.0
    object.__setattr__(house.given, "waves", None)
    monkeypatch.setattr(moored, "_of_bound_waves", lambda spectrum, db: [f"bound {db.water_depth:g}"])
    found = moored.moored("m.toml", house.read, house.db, SEA, 3600.0, "points")
    loads = house.asked["slow_motion"][4]
    _, gust, *_ = loads
    assert gust[0] is gusts and gust[1].tolist() == [1, 2, 6] and house.asked["long_period"][3] is gusts
    assert "; slow drift by Newman's rule, gusts of NPD; the drag" in found.notes[0] and found.notes[1] == "bound 20"
    house.read.current = "given"
    with pytest.raises(StudyError, match=r"current is given with --moored; leave it out: m\.toml gives the current"):
        moored.moored("m.toml", house.read, house.db, SEA, 3600.0, "points")


@pytest.mark.parametrize(("depth", "told"), [(11.0, True), (13.0, False)])
def test_bound_waves_are_told_where_kh_is_below_1_at_the_peak(depth, told):
    """ω² h/g = kh tanh kh: at kh = 1, h = g tanh 1/ω² = 0.7616 · 9.81/0.625² = 19.13 m; here ω = 0.79 gives 11.97 m"""
    spectrum, db = SimpleNamespace(peak_omega=0.79), SimpleNamespace(water_depth=depth, gravity=9.81)
    said = list(moored._of_bound_waves(spectrum, db))
    assert bool(said) is told
    if told:
        kh = 0.5
        for _ in range(60):
            kh = 0.5 * (kh + 0.79**2 * depth / 9.81 / math.tanh(kh))
        assert said == [f"kh is {kh:.2g} at the spectral peak: bound long waves, which are not included, may move the "
                        "body more than slow drift"]  # fmt: skip


def statics(fenders=(), ropes=(), hinges=(), force=()):
    berth = SimpleNamespace(fenders=fenders, ropes=ropes, names=[*fenders, *ropes])
    contact = np.zeros((2, 2, len(force)))
    contact[1, 1] = force
    return SimpleNamespace(system=SimpleNamespace(lines=[1, 2]), hinges=hinges, berth=berth, contact=contact)


@pytest.mark.parametrize(("parts", "held", "idle"), [
    ({}, "2 lines", None), ({"hinges": ("h",)}, "2 lines, hinge h", None),
    ({"fenders": ("f",), "force": (3.0,)}, "2 lines, 1 fender", ""),
    ({"fenders": ("f", "g"), "ropes": ("r",), "force": (0.0, 2.0, 0.0)}, "2 lines, 2 fenders, 1 rope", "f, r"),
    ({"ropes": ("r", "s"), "force": (1.0, 2.0)}, "2 lines, 2 ropes", ""),
])  # fmt: skip
def test_what_holds_several_bodies_is_told_with_what_lies_idle(parts, held, idle):
    said = list(moored._of_stiffness("m.toml", statics(**parts), None))
    assert said[0].startswith(f"moored by {held} of m.toml, with the stiffness that they have under the steady forces")
    assert len(said) == 1 + (idle is not None) + bool(idle)
    if idle is not None:
        assert said[1].startswith("fenders and ropes are linear here; where motions exceed their deflection at rest")
    if idle:
        assert said[2] == f"fenders and ropes without force under the steady forces have no stiffness here: {idle}"


def test_several_bodies_move_on_the_damping_of_what_drives_them_and_the_stiffness_of_all(monkeypatch):
    asked = {}
    linked = SimpleNamespace(damping=2.0, restrained=lambda damping, stiffness: ("held", damping, stiffness))
    made, system_given = statics(), SimpleNamespace(depth=33.0)
    made.displacement, made.stiffness, made.warnings = np.arange(6.0), "K", ["FAILS: bow", "stern"]
    astern = np.diag([-1.0, -1.0, 1.0])
    made.hulls, made.loads = [SimpleNamespace(axes=np.eye(3)), SimpleNamespace(axes=astern)], {"wind": np.arange(12.0)}
    study = SimpleNamespace(
        hulls_of=lambda db: "hulls", system_of=lambda db, hulls: system_given, berth_of=lambda db, hulls: "berth",
        conditions=Conditions, hinges="hinges", allowable=0.5, wind="wind",
    )  # fmt: skip
    driven, gusts = SimpleNamespace(damping=5.0), SimpleNamespace(name="NPD")
    monkeypatch.setattr(of_study, "read_study", lambda path: (study, ""))
    monkeypatch.setattr("hakobune.bem.hinges.driven", lambda alone: driven)
    monkeypatch.setattr(moored, "gusts_of", lambda wind: gusts)
    monkeypatch.setattr("hakobune.pipelines.response.study.viscous_laws", lambda *of: "laws" if of == (read, db) else 0)
    monkeypatch.setattr("hakobune.pipelines.response.study.viscous_words", lambda held, laws, damping: [damping])

    def in_sea(body, laws, where):
        same = where == (db.bodies_reader, SEA)
        return SimpleNamespace(of=body, stiffness="K"), f"damped by {laws}" if same else where

    monkeypatch.setattr(
        "hakobune.mooring.response.viscous.in_sea",
        lambda reader, sea, laws, body: in_sea(body, laws, (reader, sea)),
    )
    monkeypatch.setattr("hakobune.mooring.studies.long_period.drag_of_each", lambda conditions, hulls, depth: depth)
    monkeypatch.setattr(
        "hakobune.mooring.studies.slow_motion.slow_motion", lambda *given: asked.update(slow=given) or "slow"
    )
    monkeypatch.setattr(moored, "_of_bound_waves", lambda spectrum, db: [f"bound {db.water_depth:g}"])
    monkeypatch.setattr(
        "hakobune.pipelines.common.quay_tables.linked",
        lambda body, hinges, db: asked.update(linked=(body, hinges)) or linked,
    )
    monkeypatch.setattr(of_mooring, "multi_point", lambda *given: asked.update(given=given) or made)
    read = SimpleNamespace(current=None, hinges=(), restrained=lambda body: (*body, "read"))
    db = SimpleNamespace(water_depth=20.0, bodies_reader=SimpleNamespace(floating=lambda: "floating"),
                         require_rigid=lambda: asked.update(rigid=True))  # fmt: skip
    given = "m.toml", read, db, SEA, 7200.0, "points"
    found = moored.moored_together(*given)
    assert found.body.of == ("held", 3.0, "K", "read") and asked["linked"] == ("floating", "hinges") and asked["rigid"]
    free, held, sea, duration, loads, points = asked["slow"]
    assert (free.of, held, sea, duration, points) == (driven, found.body, SEA, 7200.0, "points")
    assert loads.offset.tolist() == [0, 1, 2, -3, -4, 5] and loads.drag == 33.0
    assert loads.gust[0] is gusts and loads.gust[1].tolist() == [0, 1, 5, -6, -7, 11]
    assert (found.motion, found.failures, found.stiffness) == ("slow", ("FAILS: bow",), "K")
    of, system, hulls, conditions, allowable, berth, alone = asked["given"]
    assert (of, system, hulls, allowable, berth, alone) == (db, system_given, "hulls", 0.5, "berth", linked)
    assert (conditions.sea, conditions.method, conditions.duration) == (SEA, "irregular", 7200.0)
    assert found.notes[0].startswith("moored by 2 lines of m.toml") and found.notes[0].endswith(", gusts of NPD")
    assert found.notes[1:] == ("bound 20", "damped by laws")
    study.system_of = lambda db, hulls: None
    with pytest.raises(StudyError, match=r"m\.toml has no lines; give at least one \[\[spreads\]\] or \[\[lines\]\]"):
        moored.moored_together(*given)
    for key, value, says in (("hinges", ("h",), "hinges are"), ("current", "c", "current is")):
        setattr(read, key, value)
        with pytest.raises(StudyError, match=rf"{says} given with --moored; leave the key out: m\.toml gives it"):
            moored.moored_together(*given)
