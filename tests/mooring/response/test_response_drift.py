"""Mean drift: coefficients, rebuilding between frequencies, irregular waves."""

from dataclasses import replace

import numpy as np
import pytest
from made_up_body import HEADINGS, OMEGA, made_up_body, thinned, with_every_second_heading

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.mooring.environment.spectra import issc, tabulated
from hakobune.mooring.response.drift import (
    drift_slopes,
    mean_in_sea,
    mean_in_sea_beyond,
)
from hakobune.mooring.response.linear import frequencies


def with_drift(headings=HEADINGS):
    """Drift of a wall, N/m² towards the waves' side, that grows with frequency"""
    force = 1e4 * OMEGA[:, None, None] * np.stack([np.cos(headings), np.sin(headings), 0 * headings], axis=-1)
    return made_up_body(headings, drift_force=force)


def test_stored_drift_comes_back_at_stored_frequencies(box_database, box_body):
    stored = box_database["drift_force"]
    assert box_body.rebuilds_drift
    found = box_body.drift(box_body.omega)
    assert np.allclose(found, stored, rtol=1e-9, atol=1e-9 * np.abs(stored).max(axis=(0, 1)))


def test_rebuilt_drift_follows_a_resonance_that_a_mean_of_its_neighbours_misses(box_body):
    """Every second frequency left out: at the ones left out the rebuilt drift is five times nearer in beam seas."""
    coarse, left_out = thinned(box_body), slice(1, -1, 2)
    wanted, beam = box_body.omega[left_out], [np.pi / 2]
    true = box_body.drift(wanted, beam)[:, 0, 1]
    rebuilt = coarse.drift(wanted, beam)[:, 0, 1]
    mean = np.interp(wanted, coarse.omega, coarse.between.quantities["drift_force"][:, -1, 1])
    scale = np.abs(true).max()
    assert np.abs(rebuilt - true).max() < 0.1 * scale
    assert np.abs(rebuilt - true).max() < 0.2 * np.abs(mean - true).max()


def test_rebuilt_drift_between_headings_is_nearer_than_drift_interpolated(box_body):
    """Two of five headings left out, gaps of 45°, up to 0.6 rad/s; drift has twice the harmonics of the far field."""
    coarse = with_every_second_heading(box_body)
    quantities = {name: v for name, v in coarse.between.quantities.items() if not name.startswith("kochin")}
    alone = replace(coarse, between=replace(coarse.between, quantities=quantities))
    omega = box_body.omega[box_body.omega < 0.62]
    true = box_body.drift(omega, box_body.headings[1::2])
    scale = np.abs(true).max(axis=(0, 1))
    rebuilt = np.abs(coarse.drift(omega, box_body.headings[1::2]) - true).max(axis=(0, 1)) / scale
    direct = np.abs(alone.drift(omega, box_body.headings[1::2]) - true).max(axis=(0, 1)) / scale
    assert np.all(rebuilt[:2] < 0.1) and np.all(rebuilt < 0.25 * direct), (rebuilt, direct)


def test_drift_has_the_symmetry_of_the_body(box_body):
    omega = box_body.omega[::4]
    one = box_body.drift(omega, np.radians([40.0]))[:, 0]
    for degrees, signs in ((-40, [1, -1, -1]), (140, [-1, 1, -1]), (220, [-1, -1, 1])):
        assert np.allclose(box_body.drift(omega, np.radians([degrees]))[:, 0], signs * one, rtol=1e-9)


def test_damping_takes_energy_out_of_waves_and_so_changes_drift_of_the_free_body_only(box_body):
    omega, beam = np.array([0.55, 0.6]), [np.pi / 2]
    extra = np.zeros((6, 6))
    extra[3, 3] = 0.1 * box_body.critical_damping(3)
    damped = box_body.restrained(damping=extra).drift(omega, beam)
    assert np.all(np.abs(damped - box_body.drift(omega, beam))[:, 0, 1] > 0)
    heavy = box_body.restrained(damping=np.diag([1e15, 1e15, 1e15, 1e18, 1e18, 1e18]))
    held = heavy.drift(box_body.omega, beam)[:, 0]
    fixed = box_body.between.quantities["drift_force_fixed"][:, -1]
    assert np.allclose(held, fixed, rtol=1e-3, atol=1e-3 * np.abs(fixed).max())


def test_drift_of_a_damped_body_is_not_guessed():
    with pytest.raises(
        ValueError,
        match="drift of a body with added damping or stiffness is computed from Kochin functions, which the database",
    ):
        with_drift().restrained(damping=np.eye(6)).drift([0.5], [0.0])
    with pytest.raises(ValueError, match="must be stored for drift_force"):
        made_up_body().drift([0.5], [0.0])


def test_mean_drift_in_a_narrow_spectrum_is_that_of_a_wave_of_its_energy():
    """2∫SD dω → D ζ² with ζ²/2 = m₀."""
    narrow = tabulated([0.599, 0.6, 0.601], [0.0, 2000.0, 0.0])
    omega = np.linspace(0.59, 0.61, 2001)
    found = mean_in_sea(omega, with_drift().drift(omega, [0.0]), narrow.density(omega))
    assert np.isclose(found[0], 1e4 * 0.6 * 2 * narrow.moment(0), rtol=1e-4)


def test_mean_drift_is_that_of_the_moments_where_drift_is_straight_in_frequency():
    """D = 1e4 ω: 2∫SD dω = 2e4 m₁ within the band, and D held at its ends beyond."""
    body, spectrum = with_drift(), issc(3.0, mean_period=9.0)
    omega = frequencies(body)
    found = mean_in_sea(omega, body.drift(omega, [0.0]), spectrum.density(omega))
    assert np.isclose(found[0], 2e4 * spectrum.moment(1, 0.3, 1.0), rtol=1e-3)
    beyond = mean_in_sea_beyond(body, spectrum, body.drift(body.omega[[0, -1]], [0.0]))
    assert np.isclose(beyond[1, 0], 2e4 * spectrum.moment(0, 1.0, np.inf), rtol=1e-9)
    assert np.isclose(beyond[0, 0], 2e4 * 0.3 * spectrum.moment(0, 0.0, 0.3), rtol=1e-9)


def test_slopes_are_derivatives_over_frequency_and_heading():
    body, omega = with_drift(np.radians(np.arange(0, 91, 15.0))), np.linspace(0.4, 0.6, 41)
    value, by_omega, _ = drift_slopes(body, omega, [0.0])
    assert np.allclose(by_omega[:, 0, 0], value[:, 0, 0] / omega, rtol=1e-4)
    value, _, by_heading = drift_slopes(body, omega, np.radians([40.0]))
    turned = value[:, 0, [1, 0]] * [-1, 1]
    assert np.allclose(by_heading[:, 0, :2], turned, rtol=0.01)  # from 24 headings


def test_drift_outside_the_database_is_refused():
    with pytest.raises(BetweenError, match=r"omega is 1\.2 rad/s"):
        with_drift().drift([1.2], [0.0])
    with pytest.raises(BetweenError, match="wave direction 180°"):
        replace(with_drift(), symmetry="").drift([0.5], [np.pi])
