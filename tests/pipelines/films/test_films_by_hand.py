"""What films show, by hand: heights of waves, stored pressures, several bodies and their ropes, runs at a buoy."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.films import of_database, of_several, of_single_point

# ------------------------------------------------------------------ regular waves of a database


def around(turn=0.0, **more):
    """A wave of 60 m whose body turns by `turn` rad a metre"""
    motion = None if turn is None else np.array([9.0, 9.0, 9.0, 0.0, 1j * turn, 0.5 * turn])
    return SimpleNamespace(k=2 * np.pi / 60, motion=motion, omega=1.0, beta=np.pi, **more)


@pytest.mark.parametrize(("turn", "height", "amplitude"), [
    (0.0, None, 1.0), (None, None, 1.0), (0.4, None, 1.0), (1.0, None, 0.5), (0.4, 2.4, 1.2), (None, 30.0, 15.0),
])  # fmt: skip
def test_waves_are_a_thirtieth_of_their_length_high_unless_the_body_turns_by_more_than_half_a_radian(
    turn, height, amplitude
):
    assert of_database._amplitude(around(turn), height) == pytest.approx(amplitude)


def test_a_height_in_which_the_body_turns_over_is_refused_with_the_largest_that_it_takes():
    """0.4 rad a metre: 2.5 m high is half a radian, 2.6 m is 29.8°"""
    assert of_database._amplitude(around(0.4), 2.5) == pytest.approx(1.25)
    with pytest.raises(ValueError, match=r"--height is 2\.6 m, .* turns by 30°; allowed here: up to 2\.5 m"):
        of_database._amplitude(around(0.4), 2.6)


class Database(SimpleNamespace):
    def __getitem__(self, name):
        assert name == "pressure"
        return self.pressure


def database(inertia=True):
    return Database(
        pressure=np.arange(12.0).reshape(2, 2, 3) * 1j, wave_direction=np.radians([0.0, 180.0]),
        omega=np.array([0.5, 1.0]), require=lambda name: None, inertia_matrix=1.0 if inertia else None,
    )  # fmt: skip


def test_the_pressure_is_that_of_the_stored_wave():
    """At 1 rad/s towards 180°, or −180°: 9i, 10i, 11i"""
    for beta in (np.pi, -np.pi, 3 * np.pi):
        wave = around()
        wave.beta = beta
        found = of_database._pressure(database(), "a.h5", wave)
        assert found.pressure.tolist() == [9j, 10j, 11j] and found.most == 11.0


@pytest.mark.parametrize(("omega", "beta"), [(1.001, np.pi), (1.0, np.pi - 0.01), (1.0, np.pi + 0.01), (0.99, np.pi)])
def test_the_pressure_of_another_wave_is_refused(omega, beta):
    wave = around()
    wave.omega, wave.beta = omega, beta
    with pytest.raises(ValueError, match=r"stored at 1 rad/s towards 180° and for other waves in a\.h5"):
        of_database._pressure(database(), "a.h5", wave)


@pytest.mark.parametrize(("inertia", "turn", "good"), [(True, 0.1, True), (False, None, True), (True, None, False),
                                                        (False, 0.1, False)])  # fmt: skip
def test_a_pressure_is_of_the_body_as_it_is_shown(inertia, turn, good):
    if good:
        of_database._pressure(database(inertia), "a.h5", around(turn))
        return
    with pytest.raises(ValueError, match="leave out --fixed"):
        of_database._pressure(database(inertia), "a.h5", around(turn))


@pytest.mark.parametrize(("given", "says"), [
    ({"field": "speed"}, "--field is 'speed'; allowed: pressure"), ({"height": 0.0}, "--height is 0 m"),
    ({"height": np.inf}, "--height is inf m"),
])  # fmt: skip
def test_flags_of_a_film_are_looked_at_before_the_database(monkeypatch, given, says):
    monkeypatch.setattr(of_database, "check_film", lambda *_: None)
    monkeypatch.setattr(of_database, "open_database", None)
    with pytest.raises(ValueError, match=says):
        of_database.film_of_database("a.h5", "a.gif", **given)


def test_a_film_is_of_the_amplitude_that_is_half_the_height(monkeypatch):
    asked = {}
    monkeypatch.setattr(of_database, "check_film", lambda *given: asked.update(checked=given))
    monkeypatch.setattr(of_database, "open_database", lambda path: f"db {path}")
    monkeypatch.setattr(of_database, "frequency", lambda period, omega: (period, omega))
    monkeypatch.setattr(of_database, "around_body", lambda *given: asked.update(around=given) or around())
    monkeypatch.setattr(of_database, "_frames", lambda *given: asked.update(frames=given) or "frames")
    monkeypatch.setattr(of_database, "write_film", lambda *given: asked.update(film=given))
    monkeypatch.setattr(of_database, "remarks", lambda wave, db, given: [f"remark {given}"])
    found = of_database.film_of_database("a.h5", "a.gif", period=8.0, heading=90.0, height=3.0, fixed=True)
    assert found == (30, ["remark 1.5"]) and asked["checked"] == ("a.gif", ("a.h5",))
    assert asked["around"] == ("db a.h5", (8.0, None), pytest.approx(math.pi / 2), True, 1.5)
    assert asked["frames"][2:] == (1.5, None) and asked["film"] == ("a.gif", "frames", 30)


# ------------------------------------------------------------------ several bodies


REST = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [100.0, 10.0, 0.0, 0.0, 0.0, np.pi / 2]])


def test_ends_of_ropes_go_with_the_body_that_carries_them_and_stay_where_none_does():
    """The second heads along y and turns by another quarter: what lay 5 m ahead of it at y + 5 is 5 m to −x"""
    moored = of_several.Moored(["a", "b"], REST, None, [])
    poses = REST + [[1.0, 2.0, 3.0, 0, 0, 0], [0.0, 0.0, 4.0, 0, 0, np.pi / 2]]
    points = np.array([[7.0, 0.0, 1.0], [100.0, 15.0, 2.0], [50.0, 0.0, 5.0]])
    found = moored._carried(points, [0, 1, -1], poses)
    assert found == pytest.approx(np.array([[8.0, 2.0, 4.0], [95.0, 10.0, 6.0], [50.0, 0.0, 5.0]]))
    assert points[0].tolist() == [7.0, 0.0, 1.0]


def test_bodies_that_are_fixed_stay_where_they_are():
    still = np.zeros((3, 6))
    still[1, 0] = 5.0
    moored = SimpleNamespace(poses=lambda motion: np.stack([motion[:6], motion[6:]]))
    motion = np.arange(24.0).reshape(2, 12)
    out = of_several._placed(moored, still, [0, 2], motion)
    assert out.shape == (2, 3, 6) and out[:, 1].tolist() == [still[1].tolist()] * 2
    assert out[1, 0].tolist() == [12, 13, 14, 15, 16, 17] and out[0, 2].tolist() == [6, 7, 8, 9, 10, 11]


def test_a_fixed_hull_is_as_high_as_the_highest_of_the_others(monkeypatch):
    monkeypatch.setattr(of_several, "box_of", lambda db, body: {"length": 60.0, "beam": 12.0, "draft": 4.0})
    hulls = {"a": SimpleNamespace(freeboard=3.0), "b": SimpleNamespace(freeboard=5.0)}
    own = of_several._box(None, SimpleNamespace(name="a", own_center="center"), hulls)
    assert tuple(own.box) == (-30.0, 30.0, -6.0, 6.0, -4.0, 3.0)
    fixed = of_several._box(None, SimpleNamespace(name="quay", own_center="center"), hulls)
    assert fixed.box[-1] == 5.0


# ------------------------------------------------------------------ a body at a single point


def test_a_record_is_read_between_its_times_in_its_own_shape():
    time, values = np.array([0.0, 2.0, 4.0]), np.arange(12.0).reshape(3, 2, 2)
    found = of_single_point._at(values, time, np.array([1.0, 4.0]))
    assert found.tolist() == [[[2.0, 3.0], [4.0, 5.0]], [[8.0, 9.0], [10.0, 11.0]]]


def test_the_stage_holds_the_hull_about_its_middle_and_all_lines():
    """A hull of 40 × 10 × 6 m whose middle is 2 m ahead; lines reach from −100 to 200 m"""
    found = {"hull.size": (40.0, 10.0, 6.0, 3.0), "hull.middle": (2.0, 1.0), "water.depth": 25.0}
    lines = [np.array([[-100.0, 0.0, -25.0], [0.0, 0.0, 0.0]]), np.array([[200.0, 20.0, -25.0], [0.0, 0.0, 0.0]])]
    stage = of_single_point._stage(found, lines)
    (hull,) = stage.hulls
    assert tuple(hull.box) == (-18.0, 22.0, -4.0, 6.0, -6.0, 3.0)
    assert stage.span == 300.0 and stage.depth == 25.0
    short = of_single_point._stage(found, [line / 10 for line in lines])
    assert short.span == 120.0  # three lengths of the hull
