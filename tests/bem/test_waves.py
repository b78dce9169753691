"""Regular waves by the formulas of the text-book, with cosh and sinh, and the dispersion relation by bisection."""

import numpy as np
import pytest
from exact.water_waves import wavenumber as by_bisection

from hakobune.bem.waves import (
    depth_factor,
    depth_factor_slope,
    depth_values,
    exponential_part,
    group_factor,
    incident_wave,
    propagating_factor,
    real_part,
    wavenumber,
)

G = 9.80665


@pytest.mark.parametrize("depth", [0.5, 20.0, 300.0])
def test_wavenumbers_are_those_of_bisection(depth):
    omega = np.array([1e-3, 0.1, 0.7, 3.0, 12.0])
    assert wavenumber(omega, depth) == pytest.approx([by_bisection(w, depth) for w in omega], rel=1e-13)
    assert wavenumber(0.0, depth) == 0.0 and wavenumber(0.7, np.inf, 9.0) == pytest.approx(0.49 / 9.0)
    assert wavenumber(0.7, depth, 9.0) == pytest.approx(by_bisection(0.7, depth, 9.0), rel=1e-13)


@pytest.mark.parametrize("depth", [12.0, np.inf])
def test_the_decay_over_the_depth_and_its_slope(depth):
    k, z = 0.13, np.array([0.0, -3.0, -11.5])
    h = depth if np.isfinite(depth) else 400.0
    value, slope = np.cosh(k * (z + h)) / np.cosh(k * h), k * np.sinh(k * (z + h)) / np.cosh(k * h)
    assert depth_factor(z, k, depth) == pytest.approx(value, rel=1e-12)
    assert depth_factor_slope(z, k, depth) == pytest.approx(slope, rel=1e-12)
    assert depth_values(k, depth)(z) == pytest.approx(np.stack([value, slope], axis=-1), rel=1e-12)


def test_waves_carry_energy_at_half_their_speed_in_deep_and_at_their_speed_in_shallow_water():
    """C_g = dω/dk, by a difference quotient"""
    omega, step = 0.8, 1e-5
    for depth in (3.0, 15.0, 100.0):
        k = [by_bisection(omega + s, depth) for s in (-step, 0, step)]
        assert group_factor(k[1], depth) == pytest.approx(2 * step / (k[2] - k[0]) / (omega / k[1]), rel=1e-8)
    assert group_factor(0.2, np.inf) == 0.5 and group_factor(0.0, 10.0) == 1.0
    assert group_factor(0.3, 10.0) == pytest.approx(0.5 * (1 + 6 / np.sinh(6)))


@pytest.mark.parametrize("depth", [12.0, np.inf])
def test_the_potential_of_a_wave_and_its_velocity(depth):
    """−(ig/ω) Z exp(ik(x cosβ + y sinβ)), the velocity by difference quotients"""
    omega, beta, point, step = 0.9, 0.6, np.array([3.0, -2.0, -4.0]), 1e-5
    k = wavenumber(omega, depth)
    h = depth if np.isfinite(depth) else 200.0

    def potential(x, y, z):
        return (
            -1j
            * G
            / omega
            * np.cosh(k * (z + h))
            / np.cosh(k * h)
            * np.exp(1j * k * (x * np.cos(beta) + y * np.sin(beta)))
        )

    phi, velocity = incident_wave(point, beta, omega, k, depth)
    assert phi == pytest.approx(potential(*point), rel=1e-10)
    for axis in range(3):
        move = step * np.eye(3)[axis]
        slope = (potential(*(point + move)) - potential(*(point - move))) / (2 * step)
        assert velocity[axis] == pytest.approx(slope, rel=1e-7)


def test_even_and_odd_parts_make_the_whole_wave():
    phase = np.array([0.3, -1.2])
    for sign, value, slope in ((1, np.cos(phase), -np.sin(phase)), (-1, 1j * np.sin(phase), 1j * np.cos(phase)),
                               (0, np.exp(1j * phase), 1j * np.exp(1j * phase))):  # fmt: skip
        found = exponential_part(sign, phase)
        assert found[0] == pytest.approx(value) and found[1] == pytest.approx(slope)
        factor, plain, plain_slope = real_part(sign, phase)
        assert factor * plain == pytest.approx(value) and factor * plain_slope == pytest.approx(slope)
        assert sign == 0 or (np.isrealobj(plain) and np.isrealobj(plain_slope))


def test_the_wave_of_a_source_has_the_amplitude_of_john():
    """2πk² / ((k² − K²) h + K), of cosh·cosh over cosh² kh (John 1950), and 2πK in deep water"""
    omega, depth = 0.7, 9.0
    k, K = wavenumber(omega, depth), omega**2 / G
    assert propagating_factor(omega, k, depth) == pytest.approx(2 * np.pi * k**2 / ((k**2 - K**2) * depth + K))
    assert propagating_factor(omega, K, np.inf) == pytest.approx(2 * np.pi * K)
