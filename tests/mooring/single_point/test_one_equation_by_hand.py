"""What one equation of a body at a single point is given: masses of the plane, places of lines, lengths of hawsers."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, Fairlead, LineType, MooredBody, UniformLine
from hakobune.mooring.single_point.body import SinglePointError
from hakobune.mooring.single_point.one_equation import PLANE, _at_the_bow, _stretch, body_at, planar

KIND = LineType("wire", 10.0, 1e6, 1.0, 0.01, breaking_load=1e6)


def legs():
    """Two lines of a buoy at (3, 4, −2), from points 1.5 m before and 0.5 m beside its middle, 0.7 m below"""
    points = [Anchor("far", (90.0, 0, -20.0)), Fairlead("p", "buoy", (1.5, 0.0, -0.7)),
              Anchor("off", (0, 90.0, -20.0)), Fairlead("q", "buoy", (0.0, 0.5, -0.7))]  # fmt: skip
    lines = [UniformLine("one", KIND, 95.0, "far", "p"), UniformLine("two", KIND, 95.0, "off", "q")]
    return System(20.0, lines, points, [MooredBody("buoy", (3.0, 4.0, -2.0, 0, 0, 0))])


@pytest.mark.parametrize(("afloat", "height"), [(True, -2.0 - 0.25), (False, -2.0)])
def test_lines_of_a_contact_buoy_end_on_the_body_where_they_ended_on_the_buoy(afloat, height):
    """The attachment at (60, −1) of the body and from it the places on the buoy; heights from the body's centre"""
    found = _at_the_bow(SimpleNamespace(system=legs()), np.array([1.0, 2.0, 0.25]), np.array([60.0, -1.0, 0.3]), afloat)
    (body,) = found.bodies
    assert body.position == pytest.approx((1.0, 2.0, 0.25 if afloat else 0.0, 0, 0, 0))
    places = {point.name: point.position for point in found.points}
    assert places["p"] == pytest.approx((61.5, -1.0, height - 0.7))
    assert places["q"] == pytest.approx((60.0, -0.5, height - 0.7))
    assert places["far"] == pytest.approx((90.0, 0, -20.0)) and places["off"] == pytest.approx((0, 90.0, -20.0))


def test_a_hawser_that_pulls_is_longer_and_leads_the_body_away_from_its_buoy():
    """30 m at 3 % and a buoy that yields 0.4 m: 1.3 m along the way from buoy to bow, here (3, 4)/5"""
    heading = math.radians(90)
    point = SimpleNamespace(apex=np.array([50.0, 7.0]), lengths=np.array([30.0, 29.0]), system="lines")
    steady = SimpleNamespace(point=point, hawser=np.array([4e4, 5e4]), buoy=np.array([10.0, 20.0]))
    rope = SimpleNamespace(strain_at=lambda T: 0.03 * T / 5e4)
    buoy = SimpleNamespace(yields=lambda T, system: 0.4 * T / 9e4)
    state = np.array([10.0 + 18.0, 20.0 + 24.0 - 50.0, heading])
    state[0] += 7.0  # bow at buoy + (18, 24): (50, 7) of the body lie at (−7, 50)
    assert _stretch(steady, state, rope, buoy) == pytest.approx([0.6 * 1.3, 0.8 * 1.3, 0.0])
    steady.hawser = np.zeros(2)
    assert not _stretch(steady, state, rope, buoy).any()


def test_a_body_in_the_plane_has_the_masses_of_its_point_however_they_are_shared():
    T = np.array([[5e6, 0, 0], [0, 8e6, 3e7], [0, 3e7, 4e9]])
    found = planar(SimpleNamespace(mass=T, system=SimpleNamespace(depth=30.0, density=1025.0, gravity=9.8)))
    rigid = found.reader.inertia
    whole = (rigid + found.memory.added_mass_infinity)[np.ix_(PLANE, PLANE)]
    assert whole == pytest.approx(T)
    assert np.diag(rigid) == pytest.approx([5e6] * 3 + [5e6 * 500] * 3)
    assert found.free == PLANE and not found.stiffness.any()
    assert (found.reader.depth, found.reader.density, found.reader.gravity) == (30.0, 1025.0, 9.8)


@pytest.mark.parametrize(
    ("length", "buoy", "says"),
    [(0.0, "a buoy", "a contact buoy moves with the body"), (30.0, None, "a hawser needs the buoy's mass")],
)
def test_a_buoy_is_given_with_a_hawser_and_only_then(length, buoy, says):
    steady = SimpleNamespace(point=SimpleNamespace(lengths=np.array([length])))
    with pytest.raises(SinglePointError, match=says):
        body_at(steady, np.zeros(6), buoy=buoy, rope=None)
