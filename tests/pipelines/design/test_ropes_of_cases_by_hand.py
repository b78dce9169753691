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
    berth = SimpleNamespace(fenders=[None, None], ropes=[rope, None])
    place = np.array([1.0, 0.0, 0.0, 0.0, 0.0, np.pi / 2])
    found = in_time._held_rope(berth, SimpleNamespace(rotation_center=(10.0, 0.0, 0.0)), 0, place)
    assert found == pytest.approx((130.0, 50.0, 120.0))


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
