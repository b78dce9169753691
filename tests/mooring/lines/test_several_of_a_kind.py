"""What a system makes of several lines or bodies of a kind is, line by line, what it makes of each alone."""

import numpy as np
import pytest
from plain import plain

from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.parts import Anchor, CompositeLine, LineType, UniformLine

CHAIN = LineType("chain", 940.0, 5e7, 110.0, 0.13)
PULL = pull_of_points("rope", [0.0, 4.0], [0.0, 4e5])
PARTS = (Segment(60.0, 900.0, 5e7, name="low"), Segment(25.0, 300.0, 2e7, name="high"))
KINDS = {
    "segments": lambda name, a, b: CompositeLine(name, PARTS, a, b),
    "sinker": lambda name, a, b: CompositeLine(name, PARTS, a, b, loads=(PointLoad(60.0, 2e4, name="s"),)),
    "hawser": lambda name, a, b: Hawser(name, PULL, 70.0, a, b),
    "out of the water": lambda name, a, b: UniformLine(name, CHAIN, 85.0, a, b, weight_in_air=1078.0),
    "uniform": lambda name, a, b: UniformLine(name, CHAIN, 85.0, a, b),
}
PLACES = ((60.0, 20.0, 12.0), (55.0, -30.0, 9.0), (-50.0, 40.0, 6.0))


def system(kind, which, turned=False):
    """Lines of some of the PLACES to anchors below, from the other end where `turned`"""
    points, lines = [], []
    for i in which:
        points += [Anchor(f"low {i}", (0.0, 0.0, -30.0)), Anchor(f"high {i}", PLACES[i])]
        ends = (f"high {i}", f"low {i}") if turned else (f"low {i}", f"high {i}")
        lines.append(KINDS[kind](f"line {i}", *ends))
    return System(30.0, lines, points)


@pytest.mark.parametrize("kind", KINDS)
def test_rows_of_several_lines_are_those_of_each_alone(kind):
    together = system(kind, range(3)).load().rows
    for i in range(3):
        alone = system(kind, [i]).load().rows[0]
        assert together[i] == pytest.approx(alone, rel=1e-9, abs=1e-6), i
    assert not np.allclose(together[0, :5], together[1, :5])


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in ("segments", "sinker")])
def test_a_line_pulls_alike_whichever_end_is_named_first(kind):
    one, other = (system(kind, [0, 1], turned).load().rows for turned in (False, True))
    size = np.hypot(one[:, 2], one[:, 4])
    assert np.maximum(np.hypot(one[:, 1], one[:, 3]), size) == pytest.approx(
        np.maximum(np.hypot(other[:, 1], other[:, 3]), np.hypot(other[:, 2], other[:, 4])), rel=1e-9
    )  # fmt: skip


def test_hydrostatics_of_a_second_body_are_those_of_the_first_in_its_own_rows():
    """Of one body at six freedoms from the first: each part of force and stiffness there, and none elsewhere"""
    hydrostatics, bodies = plain("mooring.lines.system.hydrostatics"), plain("mooring.lines.system.bodies")
    rng = np.random.default_rng(3)
    springs = rng.normal(size=(2, 6, 6)) * 1e6
    turn = np.array([bodies.rotation(0.1, -0.2, 1.1), bodies.rotation(-0.05, 0.15, -2.0)])
    loads, height = rng.normal(size=(2, 6)), np.array([0.5, -0.3])
    place = np.array([[1.0, 2.0, 0.9], [3.0, 4.0, -0.8]])
    force, K = np.zeros(12), np.zeros((12, 12))
    hydrostatics.add_loads(force, K, loads, springs, height, place, turn)
    for i in range(2):
        own = slice(6 * i, 6 * i + 6)
        one, stiffness = hydrostatics.hydrostatic_load(springs[i], place[i, 2] - height[i], turn[i])
        assert force[own] == pytest.approx(one + loads[i]) and K[own, own] == pytest.approx(stiffness)
        assert np.abs(one[2:5]).min() > 0 and np.abs(stiffness[2:5, 2:5]).min() > 0
    assert not K[:6, 6:].any() and not K[6:, :6].any()
