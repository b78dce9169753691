"""Wind and current on a box: directions, symmetry, hand calculations, a continuous slope all the way round."""

from functools import partial

import numpy as np
import pytest
from kinks import assert_slope_is_continuous

from hakobune.mooring.loads.box_current import box_table, current_force
from hakobune.mooring.loads.box_drag import about, drag_table, stream_pressure
from hakobune.mooring.loads.box_wind import BOX as WIND
from hakobune.mooring.loads.box_wind import wind_force

BOX = dict(length=100.0, beam=50.0)


def wind(direction, speed=50.0):
    return wind_force(speed, np.radians(direction), freeboard=10.0, **BOX)


def current(direction, **changes):
    return current_force(
        **{**dict(speed=1.5, direction=np.radians(direction), draft=10.0, depth=20.0), **BOX, **changes}
    )


@pytest.mark.parametrize("force", [wind, current])
def test_stream_pushes_the_way_it_goes(force):
    assert force(0)[0] > 0 and np.allclose(force(0)[1:], 0, atol=1e-9 * force(0)[0])
    assert force(90)[1] > 0 and np.allclose(force(90)[[0, 2]], 0, atol=1e-7 * force(90)[1])
    for direction in range(0, 360, 7):
        F_x, F_y, _ = force(direction)
        assert F_x * np.cos(np.radians(direction)) + F_y * np.sin(np.radians(direction)) > 0


@pytest.mark.parametrize("force", [wind, current])
def test_box_has_no_bow_stern_port_or_starboard(force):
    for direction in (10, 30, 60, 77):
        F_x, F_y, M_z = force(direction)
        assert np.allclose(force(-direction), [F_x, -F_y, -M_z])
        assert np.allclose(force(180 - direction), [-F_x, F_y, -M_z])
        assert np.allclose(force(180 + direction), [-F_x, -F_y, M_z])


@pytest.mark.parametrize("force", [wind, current])
def test_moment_turns_the_box_broadside(force):
    # the angle between stream and x axis is direction − heading; it grows where the heading falls, M_z < 0
    assert force(30)[2] < 0
    assert force(-30)[2] > 0
    assert force(150)[2] > 0


def test_wind_equals_the_hand_calculation_of_the_report_table():
    """χ = 60° ahead is wind towards 240°: C_x 0.54 on 50 m × 10 m, C_y 0.81 on 100 m × 10 m, lever 0.076 L."""
    F_x, F_y, M_z = wind(240)
    q = 0.5 * 1.226 * 50**2
    assert np.isclose(F_x, -0.54 * q * 500)
    assert np.isclose(F_y, -0.81 * q * 1000)
    assert np.isclose(M_z, -0.076 * 100 * np.hypot(F_x, F_y))


def test_current_equals_the_hand_calculation_of_the_report_tables():
    """B/d = 10, H/d = 1.6, 45°: C_x 1.63 on B d, C_y 1.19 on L d."""
    F_x, F_y, _ = current(45, draft=5.0, depth=8.0, density=1000.0)
    assert np.isclose(F_x, 1.63 * 500 * 1.5**2 * 50 * 5)
    assert np.isclose(F_y, 1.19 * 500 * 1.5**2 * 100 * 5)


def test_forces_grow_with_the_square_of_the_speed():
    assert np.allclose(wind(33, speed=40.0), 4 * wind(33, speed=20.0))
    assert np.allclose(wind(33, speed=0.0), 0)


def test_current_table_lies_between_its_neighbours():
    shallow, deep = box_table(100, 50, 5.0, 8.0), box_table(100, 50, 5.0, 90.0)
    between = box_table(100, 50, 5.0, 20.0)
    assert np.all((between.x - shallow.x) * (between.x - deep.x) <= 0)
    assert np.all((between.y - shallow.y) * (between.y - deep.y) <= 0)


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ((100, 5, 1, 20), "L/B = 20 .* give current coefficients"),
        ((100, 50, 50, 100), "B/d = 1 .*give current coefficients"),
        ((100, 50, 0.5, 10), "B/d = 100 .*give current coefficients"),
        ((100, 50, 10, 10.1), "H/d = 1.01"),
    ],
)
def test_current_far_outside_the_tests_is_refused(sizes, message):
    with pytest.raises(ValueError, match=message):
        box_table(*sizes)


def test_a_longer_pontoon_has_the_coefficients_of_the_longest_tested_and_says_so():
    longer, tested = box_table(150, 50, 5.0, 20.0), box_table(100, 50, 5.0, 20.0)
    assert np.allclose(longer.x, tested.x) and np.allclose(longer.y, tested.y)
    assert np.allclose(longer.lever, tested.lever)  # no more than that of L/B = 2
    assert any(
        note.startswith("current force: L/B = 3 is outside the tests; the value for 2 is used") for note in longer.notes
    )
    assert any("current moment for L/B = 3 is a guess (lever 0.09 L" in note for note in longer.notes)


@pytest.mark.parametrize("relative", [1.2, 1.3, 1.6, 3.0, 10.0, 17.9])
def test_coefficients_go_on_without_a_jump_where_the_tests_end(relative):
    """Across the ends of L/B, B/d and H/d, and where a broad box leaves B/d = 10 for the trend of L/B = 2"""
    near = 1e-7
    for name, at in (("wide", 5.0), ("wide", 20.0), ("slender", 2.0), ("slender", 1.2)):
        for other in (1.2, 1.6, 2.0) if name == "wide" else (5.0, 10.0, 20.0):
            sizes = [
                (at * (1 + s * near), other) if name == "slender" else (other, at * (1 + s * near)) for s in (-1, 1)
            ]
            low, high = (box_table(slender * wide * 5, wide * 5, 5.0, relative * 5) for slender, wide in sizes)
            assert np.allclose(low.x, high.x, atol=1e-5) and np.allclose(low.y, high.y, atol=1e-5)


def test_shallower_than_the_tests_the_side_force_grows_to_that_of_a_ship_that_grounds():
    """UFC 4-159-03 (2005), eq. 11, through the shallowest test: between it and 3.2 in (d/H)²"""
    edge, shallow = box_table(100, 50, 5.0, 6.0), box_table(100, 50, 5.0, 5.5)
    wanted = edge.y[-1] + (3.2 - edge.y[-1]) * (1 / 1.1**2 - 1 / 1.2**2) / (1 - 1 / 1.2**2)
    assert shallow.y[-1] == pytest.approx(wanted) and np.allclose(shallow.x, edge.x)
    assert np.allclose(shallow.y / shallow.y[-1], edge.y / edge.y[-1])
    assert any("H/d = 1.1 is below the tests of L/B = 2 (1.2)" in note for note in shallow.notes)


def test_a_box_across_is_the_same_box_turned():
    """Length and beam change places: forces along and across too, and the moment turns the longer side broadside"""
    way = np.radians(np.arange(0.0, 360.0, 10.0))
    along = current_force(1.0, way, 100.0, 50.0, 5.0, table=box_table(100.0, 50.0, 5.0, 20.0))
    across = current_force(1.0, way + np.pi / 2, 50.0, 100.0, 5.0, table=box_table(50.0, 100.0, 5.0, 20.0))
    turned = np.column_stack([-along[:, 1], along[:, 0], along[:, 2]])
    assert np.allclose(across, turned, atol=1e-9 * np.abs(along).max())


def test_given_coefficients_are_used_instead():
    table = drag_table(np.radians([0, 90]), [1.0, 0.0], [0.0, 2.0])
    F_x, F_y, M_z = current(90, table=table, beam=80.0)
    assert np.isclose(F_y, 2.0 * 0.5 * 1025 * 1.5**2 * 1000)
    assert abs(F_x) < 1e-9 * F_y and abs(M_z) < 1e-9 * F_y
    with pytest.raises(ValueError, match="end at 80°"):
        drag_table(np.radians([0, 80]), [1, 0], [0, 1])


def test_moment_moves_with_its_reference_point():
    # a force along +y through (10, 0) turns counter-clockwise about the origin
    assert np.allclose(about(np.array([0.0, 2.0, 0.0]), (10.0, 0.0), (0.0, 0.0)), [0, 2, 20])


@pytest.mark.parametrize("force", [wind, current])
def test_forces_have_a_continuous_slope_all_the_way_round(force):
    degrees = np.arange(0.0, 360.0, 7.5)  # tabulated angles and those between
    if force is current:
        force = partial(current, table=box_table(100.0, 50.0, 10.0, 20.0))
    for i in range(2):
        assert_slope_is_continuous(lambda d: force(d)[i], degrees, step=0.5)  # noqa: B023


def test_the_slope_test_sees_a_kink():
    with pytest.raises(AssertionError):
        assert_slope_is_continuous(abs, np.array([-1.0, 0.0, 1.0]))


def test_wind_table_returns_its_values_and_stays_between_them():
    values = np.column_stack([WIND.x, WIND.y, WIND.lever])
    assert np.allclose(WIND.curve(WIND.angle), values, atol=1e-14)
    for low, high, a, b in zip(WIND.angle[:-1], WIND.angle[1:], values[:-1], values[1:], strict=True):
        between = WIND.curve(np.linspace(low, high, 50))
        assert np.all(between >= np.minimum(a, b) - 1e-12) and np.all(between <= np.maximum(a, b) + 1e-12)


def test_wind_lever_is_the_law_its_values_follow():
    """a/L = 0.09 (sin 2χ)^1.2, the report's law for current, to the three decimals of the wind table."""
    assert np.allclose(WIND.lever, 0.09 * np.abs(np.sin(2 * WIND.angle)) ** 1.2, atol=5.1e-4)


def test_directions_and_speeds_go_in_rows():
    speeds, directions = np.array([3.0, 5.0, 8.0]), np.array([10.0, 130.0, 275.0])
    rows = wind(directions, speed=speeds)
    assert np.allclose(rows, [wind(d, speed=v) for d, v in zip(directions, speeds, strict=True)])


def test_superstructures_add_their_areas():
    """A deck house as long and as broad as the hull and as high as its freeboard doubles the force."""
    twice = wind_force(20.0, 0.4, freeboard=10.0, front_area=500.0, side_area=1000.0, **BOX)
    assert np.allclose(twice, 2 * wind_force(20.0, 0.4, freeboard=10.0, **BOX))
    with pytest.raises(ValueError, match="side area of superstructures is -1 m²; allowed: at least 0"):
        wind_force(20.0, 0.4, freeboard=10.0, side_area=-1.0, **BOX)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (dict(x=[1.0, 0.1]), "x is 0.1 at 90°; allowed: 0"),
        (dict(y=[0.2, 1.0]), "y is 0.2 at 0°"),
        (dict(lever=[0.0, 0.05]), "lever is 0.05 at 90°"),
        (dict(x=[np.nan, 0.0]), "not all finite"),
    ],
)
def test_coefficients_that_break_the_symmetry_of_a_box_are_refused(change, message):
    good = dict(angle=np.radians([0, 90]), x=[1.0, 0.0], y=[0.0, 1.0])
    with pytest.raises(ValueError, match=message):
        drag_table(**{**good, **change})


@pytest.mark.parametrize("speed", [-1.0, np.nan, np.inf])
def test_speeds_that_cannot_be_are_refused(speed):
    for force in (wind, current):
        with pytest.raises(ValueError, match=f"speed is {speed:g} m/s; allowed: at least 0"):
            force(0, speed=speed)


@pytest.mark.parametrize("density", [-1.0, 0.0, np.nan, np.inf])
def test_a_fluid_without_a_density_presses_nothing(density):
    """½ρU² asks for ρ above 0"""
    with pytest.raises(ValueError, match=f"density is {density:g}; allowed: above 0"):
        stream_pressure("wind", 10.0, density)
    assert stream_pressure("wind", 10.0, 1.2) == pytest.approx(60.0)
