"""Lines whose parts above the water weigh what they do in air."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, FreePoint, LineSystemError, LineType, UniformLine
from hakobune.mooring.lines.system.shapes import line_shapes

CHAIN = LineType("chain", 940.0, 5e7, 110.0, 0.13)
AIR = 110.0 * 9.80665
PLACES = {
    "from the bed to a deck": ((0.0, 0.0, -30.0), (60.0, 20.0, 12.0), 85.0),
    "taut from the bed": ((0.0, 0.0, -30.0), (60.0, 20.0, 12.0), 74.0),
    "between decks through the water": ((0.0, 0.0, 6.0), (40.0, 0.0, 9.0), 55.0),
    "from under water": ((0.0, 0.0, -10.0), (30.0, -20.0, 8.0), 45.0),
    "between decks above the water": ((0.0, 0.0, 16.0), (40.0, 0.0, 9.0), 43.0),
}


def span(place, air=AIR, friction=0.0):
    a, b, length = PLACES[place]
    line = UniformLine("L", CHAIN, length, "a", "b", friction, weight_in_air=air)
    return System(30.0, [line], [Anchor("a", a), Anchor("b", b)])


@pytest.mark.parametrize("place", PLACES)
def test_a_line_that_weighs_in_air_what_it_does_in_water_is_uniform(place):
    friction = 0.3 if place == "from the bed to a deck" else 0.0
    same, plain = (span(place, air, friction).load() for air in (CHAIN.weight, None))
    assert np.allclose(same.rows[0, :6], plain.rows[0, :6], rtol=1e-8, atol=1e-6)
    wanted = plain.rows[0, 6:].copy()
    if PLACES[place][0][2] == -30:
        wanted[[1, 4, 7, 10]] = 0  # by the height of an anchor, which does not move
    assert np.allclose(same.rows[0, 6:], wanted, rtol=1e-6, atol=1e-6 * np.abs(wanted).max())


@pytest.mark.parametrize("place", PLACES)
def test_each_part_of_a_line_weighs_by_where_it_is(place):
    """From end b on, small steps with the weight of the place lead to end a, or down to the bed."""
    system = span(place)
    state, (a, b, length) = rest(system), PLACES[place]
    H, V = state.lines.horizontal_b[0], state.lines.vertical_b[0]
    n = 40000
    ds, x, z = length / n, 0.0, b[2]
    lying = round(n * state.lines.grounded_length[0] / length)
    for _ in range(n - lying):
        V -= 0.5 * ds * (AIR if z > 0 else CHAIN.weight)
        T = np.hypot(H, V)
        x, z = x + ds * (1 + T / 5e7) * H / T, z - ds * (1 + T / 5e7) * V / T
        V -= 0.5 * ds * (AIR if z > 0 else CHAIN.weight)
    x += lying * ds * (1 + H / 5e7)
    assert x == pytest.approx(np.hypot(b[0] - a[0], b[1] - a[1]), abs=2e-3)
    assert z == pytest.approx(a[2], abs=2e-3)
    assert state.lines.vertical_a[0] == pytest.approx(-V, abs=2 * ds * AIR)
    shape = line_shapes(state)[0]
    assert np.allclose(shape[[0, -1]], [a, b], atol=1e-6)


def test_its_forces_have_a_potential_and_a_buoy_comes_to_rest_between_two():
    row = span("between decks through the water").load().rows[0]
    scale = np.abs(row[6:]).max()
    assert row[11] == pytest.approx(row[15], abs=1e-5 * scale)  # by z_b of H_b, by x of V_b
    assert row[14] == pytest.approx(row[16], abs=1e-5 * scale)  # by z_b of V_a, by z_a of V_b
    lines = [UniformLine(n, CHAIN, 40.0, n, "buoy", weight_in_air=AIR) for n in ("east", "west")]
    points = [Anchor("east", (30.0, 0, 8.0)), Anchor("west", (-30.0, 5, 10.0)), FreePoint("buoy", (0, 0, -3.0), 3e3)]
    state = rest(System(30.0, lines, points))
    held = state.lines.vertical_a.sum()
    light = rest(System(30.0, [replace(line, weight_in_air=None) for line in lines], points)).lines.vertical_a.sum()
    assert np.abs(state.residual).max() < 1e-7 * state.tension.sum()
    assert light < held < light + 80 * (AIR - CHAIN.weight)


def test_a_weight_in_air_below_that_in_water_is_refused():
    told = "weight_in_air is 900; allowed: finite, at least the weight in water, which must be above 0"
    with pytest.raises(LineSystemError, match=told):
        UniformLine("L", CHAIN, 10.0, "a", "b", weight_in_air=900.0)


def test_a_line_that_floats_out_of_the_water_by_its_end_is_told():
    float_, rope = LineType("float", -4e3, 1e9, 130.0, 0.8), LineType("rope", 1.0, 1e6)
    lines = [UniformLine("tether", rope, 20.0, "anchor", "foot"), UniformLine("buoy", float_, 0.6, "foot", "head")]
    points = [Anchor("anchor", (0, 0, -19.8)), FreePoint("foot", (0, 0, -0.5)), FreePoint("head", (0, 0, 0.1))]
    with pytest.warns(UserWarning, match=r"line buoy floats and its end would be 0\.848 m above the water"):
        rest(System(30.0, lines, points))
