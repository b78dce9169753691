"""Six components of wind and current on a hull: heights, superstructures, coefficients of ships."""

import numpy as np
import pytest

from hakobune.mooring.loads.box_drag import drag_table
from hakobune.mooring.loads.on_hull import current_on, silhouettes, turning_drag, wind_on
from hakobune.mooring.loads.ship_wind import blendermann, ships
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Wind
from hakobune.mooring.studies.steady_loads import with_coefficients

BARE = ExposedBox(100.0, 50.0, 10.0, 10.0)
HOUSE = ExposedBox(100.0, 50.0, 10.0, 10.0, 200.0, 500.0, 18.0)


def test_moments_are_those_of_the_force_at_its_height():
    """E₄ = −E₂ Z, E₅ = E₁ Z (SR179 report, eq. 3.7.1.8), Z from the centre to half the freeboard"""
    q = 0.5 * 1.226
    for degrees, x, y in ((0, 1.0, 0.0), (90, 0.0, 1.0), (180, -1.0, 0.0), (270, 0.0, -1.0)):
        F = wind_on(Wind(1.0, 0.0), BARE).about(np.radians(degrees), (0.0, 0.0, -2.0))
        wanted = np.array([x * 500, y * 1000, 0.0, -7 * y * 1000, 7 * x * 500, 0.0]) * q
        assert pytest.approx(wanted, abs=1e-9) == F


def test_the_moment_about_any_centre_is_that_of_one_force_in_space():
    F = wind_on(Wind(1.0, 0.0), BARE)
    at_origin, elsewhere = F.about(1.0, (0, 0, 0)), F.about(1.0, (3.0, -2.0, 4.0))
    assert elsewhere[3:] == pytest.approx(at_origin[3:] - np.cross((3.0, -2.0, 4.0), at_origin[:3]), rel=1e-12)


def test_superstructures_add_their_area_where_they_are():
    (front, low), (side, high) = silhouettes(HOUSE)
    assert (front, side) == (700.0, 1500.0)
    assert low == pytest.approx((500 * 5 + 200 * 18) / 700) and high == pytest.approx((1000 * 5 + 500 * 18) / 1500)
    F = wind_on(Wind(1.0, 0.0), HOUSE).about(np.pi / 2, (0, 0, 0))
    assert F[3] / F[1] == pytest.approx(-high)
    on_deck = ExposedBox(100.0, 50.0, 10.0, 10.0, 0.0, 500.0)  # 5 m high all along the deck
    assert silhouettes(on_deck)[1][1] == pytest.approx((1000 * 5 + 500 * 12.5) / 1500)


def test_a_height_that_is_given_comes_before_all_others():
    F = wind_on(Wind(1.0, 0.0, height=30.0), HOUSE).about(np.pi / 2, (0, 0, 0))
    assert F[3] / F[1] == pytest.approx(-30.0)


def test_a_current_acts_at_half_the_draft():
    F = current_on(Current(1.0, 0.0), BARE, 1025.0, 20.0).about(np.pi / 2, (0, 0, 0))
    assert F[3] / F[1] == pytest.approx(5.0)


def test_turning_drag_is_the_cross_flow_of_slices_of_the_hull():
    """∫ ½ρ C_y d (r x)² |x| dx over the length, for r = 1"""
    water = current_on(None, BARE, 1025.0, 20.0)
    x = np.linspace(-50, 50, 20001)
    slices = np.trapezoid(float(water.unit(np.pi / 2)[1]) / 100.0 * np.abs(x) ** 3, x)
    assert turning_drag(water, 100.0) == pytest.approx(slices, rel=1e-6)


@pytest.mark.parametrize("degrees", [0, 17, 45, 120, 300])
def test_streams_pull_a_round_hull_along_themselves_alike_from_all_sides(degrees):
    """½ρ C_D D d U², C_D 1.05 in a current and 0.5 in air; a house of 3 and 7 m² has C_D 1 from ahead and from abeam"""
    angle = np.radians(degrees)
    along, at = np.array([np.cos(angle), np.sin(angle), 0.0]), np.array([np.cos(angle), np.sin(angle)])
    hull = ExposedBox(16.0, 16.0, 6.0, 4.0, is_round=True)
    water = current_on(Current(1.0, 0.0), hull, 1000.0, 24.0)
    assert water.unit(angle) == pytest.approx(500.0 * 1.05 * 16 * 6 * along, rel=1e-12)
    assert (
        len(water.notes) == 1
        and "1.05" in water.notes[0]
        and "has 0.65;" in water.notes[0]
        and water.height == (-3.0, -3.0)
    )
    for none in (None, Current(0.0, 0.0)):  # water at rest: KC below 2
        C_pi = 1.5 - 0.024 * (12 / 1.05 - 10)  # DNV-RP-C205, section 6.7: wake factor C_π − 1
        rest = current_on(none, hull, 1000.0, 24.0)
        still = rest.unit(angle)
        assert "C_D 0.5 " in rest.notes[0] and "smooth one has 0.2;" in rest.notes[0]
        assert still == pytest.approx(500.0 * 1.05 * (C_pi - 1) * 16 * 6 * along, rel=0.03)
    air = wind_on(Wind(1.0, 0.0, density=1.2), hull)
    assert air.unit(angle) == pytest.approx(0.6 * 0.5 * 16 * 4 * along, rel=1e-12) and air.height == (2.0, 2.0)
    house = wind_on(Wind(1.0, 0.0, density=1.2), ExposedBox(16.0, 16.0, 6.0, 4.0, 3.0, 7.0, is_round=True))
    assert house.unit(angle)[:2] == pytest.approx(0.6 * (np.array([3.0, 7.0]) + 32.0) * at, rel=1e-12)


ROUND = ExposedBox(16.0, 16.0, 6.0, 4.0, is_round=True)


@pytest.mark.parametrize(("ratio", "C"), [(1e-9, 0.5), (0.1, 0.5859375), (0.2, 0.775), (0.3999, 1.05), (0.41, 1.05)])
def test_a_round_hull_in_a_slow_current_keeps_the_drag_of_still_water(ratio, C):
    """C_D 0.5 + 0.55 x² (3 − 2x), x the current over 0.4 of the hull's speed: x = 1/4, 1/2 and 1 from 0.4 on"""
    water = current_on(Current(0.3, 0.0), ROUND, 1000.0, 24.0)
    assert 1.05 * water.share(0.3, 0.3 / ratio) == pytest.approx(C, rel=1e-6)
    assert 1.05 * water.share(0.3, np.array([0.0, 0.1])) == pytest.approx([1.05, 1.05])
    assert "motion above 2.5 times the current is damped by less, down to 0.5;" in water.notes[0]


def test_all_other_drag_is_the_same_at_any_speed_of_the_hull():
    given = drag_table([0.0, 0.5 * np.pi], [1.0, 0.0], [0.0, 1.0])
    for water in (current_on(Current(0.3, 0.0), BARE, 1000.0, 24.0), current_on(None, ROUND, 1000.0, 24.0),
                  current_on(Current(0.3, 0.0, given), ROUND, 1000.0, 24.0)):  # fmt: skip
        assert water.share(0.01, np.array([0.0, 1.0, 50.0])) == pytest.approx([1.0] * 3)


def test_a_round_hull_turns_in_a_current_as_in_water_at_rest():
    rest, stream = (current_on(one, ROUND, 1000.0, 24.0) for one in (None, Current(1.0, 0.0)))
    assert turning_drag(stream, 16.0) == pytest.approx(turning_drag(rest, 16.0), rel=1e-12)
    assert turning_drag(rest, 16.0) == pytest.approx(0.5 * 500.0 * 0.5 * 6 * 8.0**4, rel=1e-12)


@pytest.mark.parametrize(("is_round", "note"), [(True, "C_D 1.05 of a rough cylinder"), (False, "")])
def test_the_coefficients_of_a_study_are_those_of_its_hull(is_round, note):
    """`moor` had those of a box of the same length and beam for a round hull, `simulate` those of a cylinder"""
    hull = ExposedBox(16.0, 16.0, 6.0, 4.0, is_round=is_round)
    alone = current_on(Current(1.0, 0.3), hull, 1000.0, 24.0)
    given = with_coefficients(Conditions(None, Current(1.0, 0.3)), hull, 24.0).current
    assert current_on(given, hull, 1000.0, 24.0).unit(0.3) == pytest.approx(alone.unit(0.3), rel=1e-12)
    assert given.table.notes == alone.notes and note in "".join(given.table.notes)


def test_coefficients_that_are_given_count_on_a_round_hull_too():
    hull = ExposedBox(16.0, 16.0, 6.0, 4.0, is_round=True)
    given = drag_table([0.0, 0.25 * np.pi, 0.5 * np.pi], [2.0, 1.0, 0.0], [0.0, 1.0, 3.0])
    assert current_on(Current(1.0, 0.0, given), hull, 1000.0, 24.0).unit(0.0)[0] == pytest.approx(500 * 2 * 96)
    assert wind_on(Wind(1.0, 0.0, 1.2, given), hull).unit(0.5 * np.pi)[1] == pytest.approx(0.6 * 3 * 64)


@pytest.mark.parametrize("degrees", [0, 20, 45, 70])
def test_a_square_box_has_no_side_of_its_own_and_boxes_near_it_nearly_none(degrees):
    angle = np.radians(degrees)
    x, y = (
        current_on(None, ExposedBox(40.0, 40.0, 6.0, 4.0), 1000.0, 24.0).unit(a)[:2] for a in (angle, np.pi / 2 - angle)
    )
    assert x == pytest.approx(y[::-1], rel=1e-9, abs=1e-9)
    long = current_on(None, ExposedBox(40.0, 39.996, 6.0, 4.0), 1000.0, 24.0).unit(angle)
    wide = current_on(None, ExposedBox(39.996, 40.0, 6.0, 4.0), 1000.0, 24.0).unit(angle)
    assert long[:2] == pytest.approx(x, rel=2e-3, abs=1e-9) and wide[:2] == pytest.approx(x, rel=2e-3, abs=1e-9)


@pytest.mark.parametrize(
    ("ship", "across", "ahead", "astern"),
    [("tanker, loaded", 0.70, 0.90, 0.55), ("car carrier", 0.95, 0.55, 0.60), ("gas tanker", 0.70, 0.60, 0.65)],
)
def test_ships_have_the_printed_coefficients_ahead_abeam_and_astern(ship, across, ahead, astern):
    """Blendermann (1994), as in Fossen (2021), table of section 10.1.2"""
    c = blendermann(ship, 200.0, 600.0, 2500.0, 6.0)
    from_ahead, abeam, from_astern = c.curve(np.array([np.pi, np.pi / 2, 0.0]))
    assert from_ahead == pytest.approx([-ahead, 0, 0], abs=1e-9)
    assert from_astern == pytest.approx([astern, 0, 0], abs=1e-9)
    assert abeam == pytest.approx([0, across, 0], abs=1e-9)


def test_quartering_wind_on_a_ship_follows_the_formula():
    """By hand: loaded cargo vessel, wind from 45° off the bow: C_l = 0.65·600/2500, N = 1 − 0.2 (1 − C_l/0.85)"""
    c = blendermann("cargo vessel, loaded", 200.0, 600.0, 2500.0, 6.0)
    below = 1 - 0.5 * 0.40 * (1 - 0.65 * 600 / 2500 / 0.85)
    y = 0.85 * np.sqrt(0.5) / below
    wanted = [-0.65 * np.sqrt(0.5) / below, y, 0.18 * np.pi / 4 * y]
    assert c.curve(np.radians(135.0)) == pytest.approx(wanted, rel=1e-9)  # blown to 135°, from ahead and starboard
    assert c.height == pytest.approx(1.7 * 6.0)


def test_a_ship_there_is_no_curve_of_is_refused_with_those_there_are():
    with pytest.raises(ValueError, match="no wind coefficients for a ship of type 'VLCC'; allowed: car carrier; "):
        blendermann("VLCC", 200.0, 600.0, 2500.0, 6.0)
    assert len(ships()) == 17
