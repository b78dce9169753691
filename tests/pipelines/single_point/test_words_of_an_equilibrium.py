"""What is kept of a body at a single point, from numbers that are made up."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.single_point.body import NotFollowedError, SinglePointError
from hakobune.mooring.single_point.equilibria import bow
from hakobune.pipelines.single_point import result
from hakobune.pipelines.single_point.quantities import state_of, turned
from hakobune.pipelines.single_point.result import _cycle_of


def at_rest(growth=-0.01, period=200.0):
    slewing = SimpleNamespace(growth=growth, period=period, stable=growth < 0)
    return SimpleNamespace(
        place=(11.0, -22.0), heading=np.radians(-30.0), buoy=np.array([3.5, 4.25]), pull=123.4e3, slewing=slewing,
        quartic=None, slews=True, lines=SimpleNamespace(tension=np.array([1e5, 2e5]), position=np.zeros((2, 3))),
    )  # fmt: skip


def state(one):
    point = SimpleNamespace(system=SimpleNamespace(lines=(None, None), depth=20.0))
    return state_of(
        SimpleNamespace(
            best=one, point=point, study=SimpleNamespace(hawser=None, buoy=SimpleNamespace(mass=None, diameter=None))
        )
    )[0]


def test_growth_of_an_equilibrium_is_told_as_the_time_of_a_factor_e():
    """Growth of −0.01 1/s is a factor e in 100 s"""
    found = state(at_rest())
    assert found["heading"].values == pytest.approx(np.radians(330)) and found["pull"].values == 123.4e3
    assert found["slewing"].values == "stable" and found["slewing.time"].values == pytest.approx(100)
    assert found["slewing.time"].description.startswith("decays") and found["slewing.period"].values == 200
    found = state(at_rest(0.02, np.inf))
    assert found["slewing"].values == "unstable" and found["slewing.time"].values == pytest.approx(50)
    assert found["slewing.time"].description.startswith("grows")


def test_a_bow_is_told_from_0_to_below_360_degrees():
    for degrees, told in ((0.0, 0.0), (-0.001, 0.0), (359.999, 0.0), (-90.0, 270.0), (725.0, 5.0)):
        assert bow(SimpleNamespace(heading=np.radians(degrees))) == told
    assert np.degrees(turned([0.0, -1e-9, np.radians(-90.0)])) == pytest.approx([0, 0, 270])


def test_what_does_not_slew_has_no_limit_cycle():
    assert _cycle_of(at_rest()) == (None, None)


@pytest.mark.parametrize("error, said", [
    (NotFollowedError("the motion cannot be followed: line 1 cannot span 330 m"), "FAILS: limit cycle: the motion"),
    (SinglePointError("the slewing dies out at a heading of 3.0°"), "limit cycle: the slewing dies out"),
])  # fmt: skip
def test_a_body_that_slews_beyond_its_mooring_fails_and_says_what_it_takes_before(error, said, monkeypatch, capsys):
    def refused(one):
        raise error

    monkeypatch.setattr(result, "limit_cycle", refused)
    cycle, why = _cycle_of(at_rest(0.02))
    assert cycle is None and why.startswith(said)
    assert "the body slews; its limit cycle takes minutes" in capsys.readouterr().err
