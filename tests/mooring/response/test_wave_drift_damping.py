"""Wave drift damping against bodies whose drift in slow motion is known from action and momentum along rays."""

import numpy as np
import pytest
from made_up_body import with_every_second_heading
from scipy.optimize import brentq

from hakobune.bem.waves import group_factor, wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.drift import drift_slopes
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.wave_drift_damping import drift_and_damping, from_slopes, mean_damping

G = 9.80665


def speeds(omega, depth):
    k = wavenumber(omega, depth)
    return k, group_factor(k, depth) * omega / k


def wall_force(omega, depth, speed):
    """Force per ρg on a totally reflecting wall that moves at `speed` with the waves of unit amplitude, exactly.

    The reflected wave has the encounter frequency of the incident one; wave action E(C_g ∓ U)/ω is kept, and each
    unit of it carries the momentum k.
    """
    k, C_g = speeds(omega, depth)

    def mismatch(w):
        return w + wavenumber(w, depth) * speed - (omega - k * speed)

    k_back = wavenumber(brentq(mismatch, 0.5 * omega, 1.5 * omega, xtol=1e-14), depth)
    action = 0.5 * (C_g - speed) / omega
    return float(action * (k + k_back))


def scatterer_force(omega, depth, U, rays=720):
    """(2,) force per ρg of a small body of unit cross section that sends rays evenly all round, moving at U (2,) m/s.

    Waves of unit amplitude along +x.  To first order in U a ray that leaves in direction φ as seen from the body has
    its crests turned by U·φ⊥/C_g and its wavenumber changed by U·(θ − x)/C_g.
    """
    k, C_g = speeds(omega, depth)
    phi = np.arange(rays) * (2 * np.pi / rays)
    theta = phi + (-U[0] * np.sin(phi) + U[1] * np.cos(phi)) / C_g
    out = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    k_out = k * (1 + (out - [1.0, 0.0]) @ U / C_g)
    action = 0.5 * np.hypot(C_g - U[0], U[1]) / omega
    return action * (np.array([k, 0.0]) - (k_out[:, None] * out).mean(axis=0))


@pytest.mark.parametrize("depth", [5.0, 20.0, np.inf])
@pytest.mark.parametrize("omega", [0.3, 0.8, 1.5])
def test_damping_of_a_reflecting_wall_is_the_slope_of_its_exact_force(omega, depth):
    def rest(w):
        k, C_g = speeds(w, depth)
        return 0.5 * C_g / w * 2 * k

    u, dw = 1e-4, 1e-5
    exact = -(wall_force(omega, depth, u) - wall_force(omega, depth, -u)) / (2 * u)
    slope = (rest(omega + dw) - rest(omega - dw)) / (2 * dw)
    value, by_omega = (np.array([[[v, 0.0, 0.0]]]) for v in (rest(omega), slope))
    found = from_slopes(np.array([omega]), [0.0], speeds(omega, depth)[0][None], depth, value, by_omega, 0 * value)
    assert np.isclose(found[0, 0, 0, 0], exact, rtol=1e-5)


@pytest.mark.parametrize("depth", [8.0, np.inf])
def test_damping_of_an_even_scatterer_is_the_slope_of_its_force_along_and_across(depth):
    """At rest D = n along the waves for a unit cross section; turned waves turn it: ∂D/∂β = (0, n)."""
    omega, u, dw = 0.7, 1e-4, 1e-5

    def rest(w):
        k, C_g = speeds(w, depth)
        return 0.5 * C_g * k / w

    exact = np.stack(
        [
            -(scatterer_force(omega, depth, u * e) - scatterer_force(omega, depth, -u * e)) / (2 * u)
            for e in np.eye(2)
        ],
        axis=-1,
    )  # fmt: skip
    slope = (rest(omega + dw) - rest(omega - dw)) / (2 * dw)
    value, by_omega = (np.array([[[v, 0.0]]]) for v in (rest(omega), slope))
    by_heading = np.array([[[0.0, rest(omega)]]])
    found = from_slopes(np.array([omega]), [0.0], speeds(omega, depth)[0][None], depth, value, by_omega, by_heading)
    assert np.allclose(found[0, 0], exact, rtol=1e-4, atol=1e-7)


def test_deep_water_is_aranhas_formula():
    """ω²/g ∂D/∂ω + 4ω/g D along the waves, 2ω/g ∂D/∂β across them (Aranha 1994)."""
    omega, k = np.array([0.6]), wavenumber(np.array([0.6]), np.inf)
    value, slope, turn = (np.array([[[v, 0.0, 0.0]]]) for v in (3.0, 5.0, 7.0))
    found = from_slopes(omega, [0.0], k, np.inf, value, slope, turn)[0, 0, 0]
    assert np.allclose(found, [0.36 / G * 5.0 + 2.4 / G * 3.0, 1.2 / G * 7.0])
    # very deep finite water is deep water
    assert np.allclose(from_slopes(omega, [0.0], k, 2000.0, value, slope, turn)[0, 0, 0], found, rtol=1e-9)


def test_damping_turns_with_the_waves(box_body):
    """A body with two planes of symmetry in waves from 30° and from 150°: mirrored in x = 0."""
    omega = np.linspace(0.3, 1.0, 57)
    one, other = drift_and_damping(box_body, omega, np.radians([30.0, 150.0]))[1].swapaxes(0, 1)
    mirror = np.array([[-1], [1], [-1]]) * np.array([-1, 1])
    assert np.allclose(other, mirror * one, rtol=1e-9, atol=1e-9 * np.abs(one).max(axis=(0, 2), keepdims=True))


def test_mean_damping_of_a_box_takes_energy_out_of_slow_surge_in_head_seas(box_body):
    omega = frequencies(box_body)
    found = mean_damping(
        omega, drift_and_damping(box_body, omega, [np.pi])[1], issc(4.5, mean_period=10.0).density(omega)
    )
    assert found.shape == (3, 2) and found[0, 0] > 0
    assert abs(found[1, 0]) < 1e-6 * found[0, 0]


def test_damping_between_headings_far_apart_has_an_error_that_is_said(box_body):
    """Every second of headings 22.5° apart: the error of the damping is within the one estimated, which is warned of"""
    sea = Sea(issc(3.0, mean_period=8.0), np.radians(67.5))
    near, far = (sea_state(body, sea, 3600.0) for body in (box_body, with_every_second_heading(box_body)))
    size = np.abs(near.slow.damping[:2]).max()
    wrong = np.abs(far.slow.damping - near.slow.damping)[:2].max() / size
    assert 0.05 < wrong < far.errors.damping + near.errors.damping, (wrong, far.errors)
    assert any("wave drift damping" in said and "limit 5 %" in said for said in far.warnings)


def test_slopes_round_the_circle_are_those_of_differences(box_body):
    omega, circle = np.linspace(0.41, 0.89, 4), np.radians(np.arange(20.0, 110.0, 2.5))
    _, _, found = drift_slopes(box_body, omega, circle)
    _, _, one_by_one = drift_slopes(box_body, omega, circle[::7][::-1])
    assert np.allclose(found[:, ::7][:, ::-1], one_by_one, atol=2e-3 * np.abs(found).max(axis=(0, 1)))
