"""Wind, current and drift: directions, symmetry, units, limits of the tables."""

import numpy as np
import pytest

from mooring.box_drag import about, drag_table
from mooring.current import box_table, current_force
from mooring.sea import RangeError, at_wave, mean_drift
from mooring.wind import wind_force

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
        ((100, 80, 10, 20), "L/B = 1.25 .* give current coefficients"),
        ((100, 50, 20, 40), "B/d = 2.5"),
        ((100, 50, 10, 11), "H/d = 1.1"),
    ],
)
def test_current_outside_the_tests_is_refused(sizes, message):
    with pytest.raises(ValueError, match=message):
        box_table(*sizes)


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


class Waves:
    """Stand-in of a database with drift linear in frequency and heading."""

    omega = np.linspace(0.4, 1.2, 5)
    wave_direction = np.radians([0.0, 30.0, 60.0, 330.0])

    def require(self, *names):
        pass

    def __getitem__(self, name):
        heading = np.degrees((self.wave_direction + np.pi) % (2 * np.pi) - np.pi)
        return np.array([[[w, b, w + b] for b in heading] for w in self.omega])


def test_waves_between_stored_ones_are_linear_and_headings_go_round():
    for omega, direction in ((0.4, 0), (0.47, 12), (1.2, 60), (0.9, -20), (0.9, 340)):
        found = at_wave(Waves(), "drift_force", 2 * np.pi / omega, np.radians(direction))
        wrapped = (direction + 180) % 360 - 180
        assert np.allclose(found, [omega, wrapped, omega + wrapped])


def test_drift_grows_with_the_square_of_the_height():
    one = mean_drift(Waves(), 2.0, 10.0, 0.1)
    assert np.allclose(mean_drift(Waves(), 6.0, 10.0, 0.1), 9 * one)
    assert np.allclose(one, at_wave(Waves(), "drift_force", 10.0, 0.1))


def test_waves_outside_the_database_are_refused_with_its_range():
    with pytest.raises(RangeError, match=r"period 20 s .* 5.236 to 15.71 s"):
        mean_drift(Waves(), 2.0, 20.0, 0.0)
    with pytest.raises(RangeError, match="240° is not between stored headings"):
        mean_drift(Waves(), 2.0, 10.0, np.radians(240))
