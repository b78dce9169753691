"""What a load case holds a rope with, and the words on how a mooring was computed."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.design.kinds import in_time, mooring


def test_a_rope_pulls_along_and_up_at_its_bollard_from_where_its_fairlead_is(monkeypatch):
    """Yawed by 90° about (10, 0, 0) and moved 1 m ahead: a fairlead at (10, 4, 6) m comes to (7, 0, 6) m

    From a bollard at (4, 4, −6) m: (3, −4, 12) m, 13 m long, 5 m of them level.
    """
    monkeypatch.setattr("hakobune.mooring.motion.contacts.contact_forces", lambda berth, place: [1.0, 2.0, 130.0, 7.0])
    rope = SimpleNamespace(fairlead=np.array([10.0, 4.0, 6.0]), bollard=np.array([4.0, 4.0, -6.0]))
    arrays = SimpleNamespace(place=np.array([[10.0, 0.0, 0.0]]), body=[0] * 4, other=[-1] * 4)
    berth = SimpleNamespace(fenders=[None, None], ropes=[rope, None], arrays=arrays, heading=np.zeros(1))
    place = np.array([1.0, 0.0, 0.0, 0.0, 0.0, np.pi / 2])
    assert in_time._held_rope(berth, 0, place) == pytest.approx((130.0, 50.0, 120.0))


def test_a_rope_between_two_hulls_pulls_along_the_way_between_its_ends(monkeypatch):
    """A barge at (0, −8) m that heads astern surges by 2 m, to (−2, −8); the ship at the origin sways by 1 m and yaws
    by 90°

    The fairlead, 3 m ahead of the barge and 1 m up, comes from (−3, −8, 1) to (−5, −8, 1) m; the bollard, 4 m ahead of
    the ship, from (4, 0, 1) to (0, 5, 1) m: 5 m along x and 13 m along y between them, all of it level.
    """
    asked = []
    monkeypatch.setattr("hakobune.mooring.motion.contacts.contact_forces",
                        lambda berth, place: asked.append(place) or [7.0])  # fmt: skip
    rope = SimpleNamespace(fairlead=np.array([-3.0, -8.0, 1.0]), bollard=np.array([4.0, 0.0, 1.0]))
    arrays = SimpleNamespace(place=np.array([[0.0, 0.0, 0.0], [0.0, -8.0, 0.0]]), body=[1], other=[0])
    berth = SimpleNamespace(fenders=[], ropes=[rope], arrays=arrays, heading=np.array([0.0, np.pi]))
    place = np.zeros(12)
    place[[1, 5, 6]] = 1.0, np.pi / 2, 2.0
    assert in_time._held_rope(berth, 0, place) == pytest.approx((7.0, 7.0, 0.0))
    moved = np.zeros(12)
    moved[[1, 5, 6]] = 1.0, np.pi / 2, -2.0  # along the axes of space
    assert asked[0] == pytest.approx(moved, abs=1e-12)


@pytest.mark.parametrize(
    ("at_berth", "simulation", "command"),
    [(True, None, "simulate cases/"), (False, None, "moor cases/"), (False, "given", "moor cases/")],
)
def test_the_command_and_the_method_are_those_of_the_study(monkeypatch, at_berth, simulation, command):
    monkeypatch.setattr(mooring, "make_study", lambda raw: SimpleNamespace(at_berth=at_berth))
    door, sources, method = mooring.words(SimpleNamespace(simulation=simulation), {})
    assert door.startswith(f"hakobune {command}")
    if at_berth:
        assert (sources, method) == (mooring.BERTH_SOURCES, mooring.AT_BERTH)
    elif simulation:
        assert (sources, method) == (mooring.IN_TIME_SOURCES, mooring.IN_TIME)
    else:
        assert (sources, method) == (mooring.SOURCES, mooring.SIMPLIFIED)
