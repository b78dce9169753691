"""What is said of a body at a single point, from numbers that are made up."""

from types import SimpleNamespace

import numpy as np

from hakobune.pipelines.single_point.report import bow, cycle_of, words


def at_rest(growth=-0.01, period=200.0):
    slewing = SimpleNamespace(growth=growth, period=period, stable=growth < 0)
    return SimpleNamespace(
        place=(11.0, -22.0), heading=np.radians(-30.0), buoy=np.array([3.5, 4.25]), pull=123.4e3, slewing=slewing,
        quartic=None, lines=SimpleNamespace(tension=np.array([1e5, 2e5]), position=np.zeros((2, 3))),
    )  # fmt: skip


MADE = SimpleNamespace(point=SimpleNamespace(system=SimpleNamespace(lines=(None, None), depth=20.0)))


def test_place_pull_and_growth_of_an_equilibrium_are_told_in_metres_kilonewtons_and_seconds():
    """Growth of −0.01 1/s is a factor e in 100 s"""
    first, second = words(None, MADE, at_rest())
    assert first == (
        "heading 330.00° (bow from +x), centre of mass at x 11.00 m, y -22.00 m, buoy 3.50, 4.25 m; "
        "steady pull 123.4 kN"
    )
    assert second == "slewing: stable; it decays by a factor e in 100 s at a period of 200 s"
    _, second = words(None, MADE, at_rest(0.02, np.inf))
    assert second == "slewing: unstable; it grows by a factor e in 50 s without oscillation"


def test_a_bow_is_told_from_0_to_below_360_degrees():
    for degrees, told in ((0.0, 0.0), (-0.001, 0.0), (359.999, 0.0), (-90.0, 270.0), (725.0, 5.0)):
        assert bow(SimpleNamespace(heading=np.radians(degrees))) == told


def test_what_does_not_slew_has_no_limit_cycle():
    assert cycle_of(at_rest()) == (None, None)
