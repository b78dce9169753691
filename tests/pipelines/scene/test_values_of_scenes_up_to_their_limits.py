"""Frequencies and headings apart, panels and tolerances, walls and arrangements of a scene: each limit from both sides,
of scenes that are made up."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.scene import checks
from hakobune.pipelines.scene.scene import SceneError


def refused(call, says):
    """The call is refused by these words, or taken for None"""
    if says is None:
        call()
        return
    with pytest.raises(SceneError) as error:
        call()
    assert says in str(error.value)


@pytest.mark.parametrize("omega", [0.01, 1.0, 100.0])
@pytest.mark.parametrize("share, good", [(1.9e-9, False), (2.1e-9, True)])
def test_frequencies_are_two_thousand_millionths_of_themselves_apart(omega, share, good):
    values = [0.5 * omega, omega, omega * (1 + share), 2 * omega]
    says = None if good else f"waves.omegas has {omega:.9g} twice"
    refused(lambda: checks._check_apart("waves.omegas", values, np.array(values)), says)


@pytest.mark.parametrize("degrees, apart, good", [
    (30.0, 1.9e-9, False), (30.0, 2.1e-9, True), (0.0, 1.9e-9, False), (350.0, 2.1e-9, True),
])  # fmt: skip
def test_headings_are_two_thousand_millionths_of_a_radian_apart_also_across_a_turn(degrees, apart, good):
    given = [degrees, 90.0, degrees + math.degrees(apart)]
    radians = np.sort(np.radians(given))
    says = None if good else f"waves.headings_deg has {degrees:g} twice"
    refused(lambda: checks._check_apart("waves.headings_deg", given, radians, turn=2 * math.pi), says)
    twice = np.radians([0.0, 120.0, 360.0])
    refused(
        lambda: checks._check_apart("h", [0.0, 120.0, 360.0], twice, turn=2 * math.pi), "h has 0 twice, once as 360;"
    )
    refused(lambda: checks._check_apart("h", [0.0, 120.0], twice[:2], turn=2 * math.pi), None)


def scene(**more):
    body = SimpleNamespace(shape="box", file=None)
    known = {"tolerance": None, "panels": None, "accuracy": 0.01, "rotation_center": (0.0, 0.0, 0.0), "wall": None,
             "body": body, "several": False, "beam": 20.0, "names": lambda: ("rao",)}  # fmt: skip
    return SimpleNamespace(**known | more)


@pytest.fixture
def rest(monkeypatch):
    monkeypatch.setattr(checks, "check_method", lambda scene: None)
    monkeypatch.setattr(checks, "viscous_of", lambda scene: None)


def unknown():
    raise ValueError("nothing makes 'drfit'")


@pytest.mark.parametrize("more, says", [
    ({}, None), ({"accuracy": 1e-5, "tolerance": 1e-5}, None), ({"accuracy": 0.2, "tolerance": 0.2}, None),
    ({"accuracy": 0.9e-5, "tolerance": 0.9e-5}, "tolerance is 9e-06; allowed: 1e-5 to 0.2"),
    ({"accuracy": 0.21, "tolerance": 0.21}, "tolerance is 0.21; allowed"),
    ({"tolerance": 0.01, "panels": 500}, None),
    ({"panels": 1}, None), ({"panels": 100_000}, None), ({"panels": 0}, "panels is 0; allowed: 1 to 100000"),
    ({"panels": 100_001}, "panels is 100001; allowed: 1 to 100000"),
    ({"panels": 500, "body": SimpleNamespace(shape="mesh", file="h.gdf")}, "panels is 500, but h.gdf has its own"),
    ({"rotation_center": (0.0, 2e6, 0.0)}, "rotation_center is [0.0, 2000000.0, 0.0]; allowed: three numbers from"),
    ({"rotation_center": (0.0, 0.0, math.nan)}, "rotation_center is"), ({"wall": 5.0}, "wall is 5 m from the middle"),
    ({"names": unknown}, "nothing makes 'drfit'"),
])  # fmt: skip
def test_panels_tolerance_and_what_is_wanted(rest, more, says):
    refused(lambda: checks._check_rest(scene(**more)), says)


@pytest.mark.parametrize("which", ["check_method", "viscous_of"])
def test_a_method_and_its_viscous_damping_are_looked_at(rest, monkeypatch, which):
    monkeypatch.setattr(checks, which, lambda scene: unknown())
    refused(lambda: checks._check_rest(scene()), "nothing makes")


@pytest.mark.parametrize("wall, more, says", [
    (10.1, {}, None), (-10.1, {}, None),
    (10.0, {}, "wall is 10 m from the middle of the body; allowed: more than half its"),
    (-9.0, {}, "wall is -9 m from the middle of the body; allowed: more than half its beam, 10"),
    (0.0, {"several": True}, None),
    (0.1, {"body": SimpleNamespace(shape="mesh", file="h")}, None), (2e6, {}, "wall is 2e+06; allowed: a number from"),
    (0.0, {"body": SimpleNamespace(shape="mesh", file="h")}, "more than half its beam, 0"),
    (-2e6, {"several": True}, "wall is"),
])  # fmt: skip
def test_a_wall_is_beside_the_body(wall, more, says):
    refused(lambda: checks._check_wall(scene(wall=wall, **more)), says)


@pytest.mark.parametrize("count, good", [(0, False), (1, True), (checks.MOST, True), (checks.MOST + 1, False)])
def test_a_list_of_a_scene_has_one_value_to_the_most_and_each_is_looked_at(count, good):
    seen = []
    says = None if good else f"w has {count} values; allowed: 1 to {checks.MOST}"
    refused(lambda: checks._check_list("w", [float(i) for i in range(count)], lambda key, one: seen.append(one)), says)
    assert len(seen) == (count if good else 0)


@pytest.mark.parametrize("value, good", [(360, True), (-360, True), (360.1, False), (-360.1, False)])
def test_a_heading_is_within_a_turn_either_way(value, good):
    refused(lambda: checks._check_heading("h", value), None if good else f"h has {value}; allowed: -360 to 360")


def several(*bodies, **more):
    known = {"rotation_center": (0.0, 0.0, 0.0), "viscous": None, "panels": None}
    return SimpleNamespace(bodies=bodies, **known | more)


def a_body(name="a", shape="box", viscous=None, file=None):
    return SimpleNamespace(name=name, shape=shape, viscous=viscous, file=file)


@pytest.mark.parametrize("made, says", [
    (several(a_body(), a_body("b")), None),
    (several(a_body(), a_body("b"), a_body()), "bodies has two bodies named 'a'"),
    (several(a_body(), a_body("b"), rotation_center=(0.0, 1.0, 0.0)), "rotation_center is [0.0, 1.0, 0.0]"),
    (several(a_body(), a_body("b", viscous="t")), "b has viscous damping, which needs a wave height; give wave_height"),
    (several(a_body(), a_body("b", viscous="t"), viscous="table"), None),
    (several(a_body(), a_body("b", "mesh", file="h.gdf"), panels=500), "panels is 500, but h.gdf has its own panels;"),
    (several(a_body(), a_body("b", "mesh", file="h.gdf")), None), (several(a_body(), a_body("b"), panels=500), None),
])  # fmt: skip
def test_an_arrangement_of_bodies(made, says):
    refused(lambda: checks._check_arrangement(made), says)
