"""Which way a response goes: free or on lines, one body or several, a sea or a climate; and what is told of each."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.response import result

FREE, SHARP, BROAD = SimpleNamespace(stiffness="free K", radius=50.0, bodies=("own",), words="words"), "sharp", "broad"
FLOATING = SimpleNamespace(radius=40.0, bodies=(), words="words")


@pytest.fixture
def way(monkeypatch):
    """What each part was asked, and answers in words"""
    asked = {}
    read = SimpleNamespace(sea="sea", climate=None, current=None, hinges=["hinge"], keel=None,
                           restrained=lambda body: asked.update(restrained=body) or "restrained")  # fmt: skip
    moving = [SimpleNamespace(name="a", fixed=False), SimpleNamespace(name="quay", fixed=True)]
    db = SimpleNamespace(bodies=[], bodies_reader=SimpleNamespace(floating=lambda: FLOATING), moving=moving)
    found = SimpleNamespace(warnings=["found warns"])
    fast = SimpleNamespace(warnings=["fast warns"])
    motion = SimpleNamespace(fast=fast, warnings=["held warns"], omega=np.array([0.1, 0.2]))
    held = SimpleNamespace(motion=motion, stiffness="held K", failures=["held fails"], notes=["on lines"], body=None)

    def answer(name, value):
        monkeypatch.setattr(result, name, lambda *given: asked.update({name: given}) or value)

    for name, value in (
        ("given", (read, "text")), ("check_effort", None), ("database_of", db), ("places_of", "points"),
        ("linked", "linked"), ("driven", "driven"), ("solved_in_sea", (found, FREE)), ("turned", ["turned"]),
        ("solved_in_climate", (found, FREE)), ("solved_moored", held),
        ("resonances", [SHARP, BROAD]), ("of_sea", ({}, {})), ("of_climate", ({}, {})), ("of_moored", {}),
        ("failures", ["fails"]), ("notes", ["noted"]), ("provenance", {}), ("_of_depth", ["deep"]),
    ):  # fmt: skip
        answer(name, value)
    monkeypatch.setattr(result, "underdamped", lambda one: one is SHARP)
    monkeypatch.setattr(result, "resonance_lines", lambda peaks: [f"peak {one}" for one in peaks])
    monkeypatch.setattr(result, "Result", lambda *given: given)
    return SimpleNamespace(asked=asked, read=read, db=db, found=found, fast=fast, held=held)


def test_a_free_body_in_a_sea_has_its_hinges_and_sharp_peaks_are_warned_of(way):
    kind, _, axes, told, noted, *_, detail = result.response("s.toml", "a.h5")
    assert way.asked["restrained"] is FLOATING and way.asked["linked"] == ("restrained", ["hinge"], way.db)
    study, body, db, points, place = way.asked["solved_in_sea"]
    assert (study, body, db, points, str(place)) == (way.read, "driven", way.db, "points", "s.toml")
    assert told == ("found warns", "deep", "peak sharp", "fails", "turned") and noted == ("noted", "peak broad")
    assert way.asked["of_sea"] == (way.found, 50.0, ("own",))
    assert way.asked["failures"] == (way.found, "free K", None, "words")
    assert detail is way.found and axes == {} and way.asked["check_effort"] == (way.read,) and kind == result.KIND
    assert not {"solved_in_climate", "solved_moored"} & set(way.asked)
    result.response({"a": "dictionary"}, "a.h5")
    assert str(way.asked["solved_in_sea"][-1]) == "study"


def test_a_climate_is_solved_for_its_years(way):
    way.read.sea, way.read.climate = None, SimpleNamespace(years=50.0)
    _, _, _, _, noted, *_ = result.response("s.toml", "a.h5")
    assert way.asked["of_climate"] == (way.found, 50.0, 50.0, ("own",)) and way.asked["failures"][2] == 50.0
    assert way.asked["notes"] == (way.found, 50.0) and "solved_in_sea" not in way.asked
    assert "check_effort" not in way.asked and noted == ("noted", "peak broad")


@pytest.mark.parametrize(("current", "moored", "says"), [
    ("current", None, r"\[current\]"), (None, "m.toml", "--moored"),
])  # fmt: skip
def test_a_climate_has_neither_current_nor_moorings(way, current, moored, says):
    way.read.climate, way.read.current = SimpleNamespace(years=50.0), current
    with pytest.raises(StudyError, match=rf"{says} is given with \[climate\], but it is for \[sea\] only"):
        result.response("s.toml", "a.h5", moored)


def test_a_body_on_lines_has_its_slow_motion_and_what_is_said_of_the_lines(way):
    _, _, axes, told, noted, *_, detail = result.response("s.toml", "a.h5", "m.toml")
    assert way.asked["solved_moored"] == (way.read, way.db, "points", "m.toml") and detail is way.fast
    assert told == ("held warns", "deep", "peak sharp", "held fails", "fails", "turned")
    assert noted == ("noted", "peak broad", "on lines") and way.asked["failures"][1] == "held K"
    assert axes["plane"].values.tolist() == axes["with_plane"].values.tolist() == ["surge", "sway", "yaw"]
    assert axes["moored_omega"].values.tolist() == [0.1, 0.2] and axes["moored_omega"].unit == "rad/s"
    assert "restrained" not in way.asked and "solved_in_sea" not in way.asked


def test_several_bodies_on_lines_have_the_places_of_those_that_move(way):
    way.db.bodies, way.held.body = way.db.moving, FREE
    _, _, axes, _, noted, *_ = result.response("s.toml", "a.h5", "m.toml")
    assert way.asked["resonances"] == (FREE,) and way.asked["of_moored"] == (way.held.motion, "horizontal")
    assert axes["horizontal"].values.tolist() == axes["with_horizontal"].values.tolist()
    assert axes["horizontal"].values.tolist() == ["a surge", "a sway", "a yaw"] and "plane" not in axes
    assert noted[-1] == "on lines" and "solved_in_sea" not in way.asked
