"""Current over the depth: ends, mean, sums, tables."""

import numpy as np
import pytest

from hakobune.mooring.environment.current_profile import power_law, table, uniform, wind_drift

Z = np.linspace(-30.0, 0.0, 20001)


def test_a_power_law_is_whole_at_the_surface_and_nothing_at_the_bed():
    profile = power_law(1.5, np.radians(30), 30.0, 1 / 7)
    assert np.allclose(profile.velocity(0.0), [1.5 * np.cos(np.pi / 6), 0.75, 0.0])
    assert np.allclose(profile.velocity([-30.0, -31.0]), 0.0)
    assert np.allclose(profile.velocity(3.0), profile.velocity(0.0))


@pytest.mark.parametrize("exponent", [1 / 7, 1 / 2, 1.0])
def test_mean_of_a_power_law_over_the_depth_is_its_closed_form(exponent):
    """∫(1 + z/h)^α dz = h / (1 + α)"""
    speed = power_law(2.0, 0.0, 30.0, exponent).velocity(Z)[:, 0]
    assert np.isclose(np.trapezoid(speed, Z) / 30.0, 2.0 / (1 + exponent), rtol=1e-4)


def test_currents_add_up():
    tide, drift = power_law(1.0, 0.3, 30.0, 1 / 7), wind_drift(25.0, 2.0, 30.0)
    assert np.allclose((tide + drift).velocity(Z), tide.velocity(Z) + drift.velocity(Z))
    assert np.isclose(np.linalg.norm(drift.velocity(0.0)), 0.25)  # 0.01 of the wind


def test_velocity_has_the_shape_of_the_heights():
    assert uniform(1.0, 0.0).velocity(0.0).shape == (3,)
    assert uniform(1.0, 0.0).velocity(np.zeros((4, 5))).shape == (4, 5, 3)
    assert np.allclose(uniform(1.0, 0.0).velocity(-1e6), [1, 0, 0])
    assert np.allclose(uniform(1.0, 0.0, 50.0).velocity([-50.0, -51.0]), [[1, 0, 0], [0, 0, 0]])


def test_a_table_returns_its_points_and_stays_between_them():
    z, speed = np.array([-40.0, -25.0, -10.0, 0.0]), np.array([0.1, 0.5, 0.5, 1.4])
    profile = table(z, speed, 0.0)
    assert np.allclose(profile.velocity(z)[:, 0], speed)
    between = profile.velocity(np.linspace(-40, 0, 500))[:, 0]
    assert np.all(np.diff(between) >= -1e-12) and between.max() <= 1.4
    assert np.allclose(profile.velocity([5.0, -40.5])[:, 0], [1.4, 0.0])


def test_a_table_may_turn_over_the_depth():
    profile = table([-20.0, 0.0], [1.0, 1.0], [np.pi / 2, 0.0])
    assert np.allclose(profile.velocity([-20.0, 0.0]), [[0, 1, 0], [1, 0, 0]])


def test_the_uniform_current_over_a_draft_has_the_same_pressure():
    """Linear from 2 to 1 m/s: mean of the square (4 + 2 + 1)/3."""
    speed, direction = power_law(2.0, 0.7, 20.0, 1.0).over_draft(10.0)
    assert np.isclose(speed**2, 7 / 3) and np.isclose(direction, 0.7)
    assert np.isclose(uniform(1.3, -2.0).over_draft(5.0), [1.3, -2.0]).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: power_law(-1.0, 0.0, 30.0, 0.1), "current speed is -1 m/s; allowed: 0 to 20"),
        (lambda: power_law(1.0, 0.0, -30.0, 0.1), "depth of the current profile is -30 m; allowed: above 0"),
        (lambda: power_law(1.0, 0.0, np.inf, 0.1), "depth of the current profile is inf m"),
        (lambda: power_law(1.0, 0.0, 30.0, -0.1), "exponent of the current profile is -0.1"),
        (lambda: power_law(1.0, np.nan, 30.0, 0.1), "current direction is nan rad"),
        (lambda: table([0.0, -10.0], [1.0, 1.0], 0.0), "runs from 0 to -10 m; allowed: increasing, at most 0"),
        (
            lambda: table([-10.0, 0.0], [1.0, -1.0], 0.0),
            "current speed is -1 m/s; allowed: 0 to 20 m/s; give the direction separately",
        ),
        (lambda: table([-10.0, 0.0], [1.0, 1.0, 1.0], 0.0), "has 2 heights and 3 speeds"),
    ],
)
def test_currents_that_cannot_be_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
