"""Several buoys that float in the surface: each part of the line is a catenary of its own, of one horizontal force."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.mooring.lines.multi_segment.line import PointLoad, Segment, StaticLine

WEIGHT, HIGH = 200.0, 40.0  # N/m; m of the surface above the anchor
LEG = 60.0


def spans(parts, d):
    """H, N, and the span of parts (m each) between buoys, of a leg of LEG that rises HIGH over d

    √(l² − h²) = 2a sinh(d/2a), and 2a sinh⁻¹(l/2a) of a part between points of one height, a = H/w
    """
    chord = math.sqrt(LEG**2 - HIGH**2)
    a = brentq(lambda a: 2 * a * math.sinh(d / (2 * a)) - chord, 0.05 * d, 1e6)
    return a * WEIGHT, [2 * a * math.asinh(part / (2 * a)) for part in parts]


@pytest.mark.parametrize("d", [38.0, 42.0, 44.0])
@pytest.mark.parametrize("parts", [(20.0,), (20.0, 30.0), (15.0, 25.0, 20.0)])
def test_every_part_between_buoys_is_a_catenary_of_its_own(parts, d):
    H, over = spans(parts, d)
    places = LEG + np.concatenate([[0.0], np.cumsum(parts)[:-1]])
    buoys = [PointLoad(place, -4e4, name=f"buoy {place}") for place in places]
    line = StaticLine([Segment(LEG + sum(parts), WEIGHT)], buoys, None, surface=HIGH)
    found = line.solve(d + sum(over), HIGH)
    assert found.loads == ("floating",) * len(parts)
    assert found.horizontal_fairlead == pytest.approx(H, rel=1e-6)
    assert found.horizontal_anchor == pytest.approx(H, rel=1e-6)
    assert found.vertical_fairlead == pytest.approx(WEIGHT * parts[-1] / 2, rel=1e-6)
    top = WEIGHT / 2 * (HIGH / math.tanh(d * WEIGHT / (2 * H)) + LEG)  # V at the upper end of the leg
    assert found.vertical_anchor == pytest.approx(top - WEIGHT * LEG, rel=1e-5)


def test_a_buoy_floats_up_to_its_lift_and_is_drawn_under_beyond():
    """What it carries: V of the leg's upper end and half of the part beyond it"""
    d, parts = 42.0, (20.0, 30.0)
    H, over = spans(parts, d)
    top = WEIGHT / 2 * (HIGH / math.tanh(d * WEIGHT / (2 * H)) + LEG)
    carried = top + WEIGHT * parts[0] / 2
    for lift, state in ((1.002 * carried, "floating"), (0.998 * carried, "submerged")):
        buoys = [PointLoad(LEG, -lift), PointLoad(LEG + parts[0], -4e4)]
        line = StaticLine([Segment(LEG + sum(parts), WEIGHT)], buoys, None, surface=HIGH)
        assert line.solve(d + sum(over), HIGH).loads == (state, "floating")


@pytest.mark.parametrize("x", [180.0, 200.0, 220.0])
@pytest.mark.parametrize("parts", [(35.0, 60.0), (25.0, 30.0, 60.0)])
def test_slack_light_rope_hangs_plumb_between_its_buoys(parts, x):
    """Half of each part hangs from either buoy; the first buoy also carries the rope down to the bed"""
    depth, rope = 100.0, 18.0
    places = 380.0 + np.concatenate([[0.0], np.cumsum(parts)[:-1]])
    buoys = [PointLoad(place, -1.5e5, 3e4) for place in places]
    segments = [Segment(180.0, 1740.0), Segment(200.0 + sum(parts), rope)]
    found = StaticLine(segments, buoys, surface=depth).solve(x, depth)
    assert found.slack and found.loads == ("floating",) * len(parts)
    assert found.vertical_fairlead == pytest.approx(rope * parts[-1] / 2, rel=1e-6)
    below = next(piece for piece in found.pieces if abs(piece[1] - places[0]) < 1e-6 and piece[0] == 0)
    assert below[6] == pytest.approx(rope * depth, rel=1e-6)
