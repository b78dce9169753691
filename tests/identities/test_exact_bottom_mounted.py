"""The cylinder standing on the bed: pressure against far field, Haskind, long waves."""

import numpy as np
import pytest
from exact.maccamy_fuchs import drift, excitation, harmonics, surge_radiation
from exact.water_waves import group_factor, wavenumber
from scipy.special import h1vp

RHO, G = 1025.0, 9.80665
CASES = [(5.0, 10.0, 0.3), (5.0, 10.0, 1.0), (5.0, 10.0, 3.0), (20.0, 4.0, 1.0), (3.0, 60.0, 1.2)]


def potential_on_the_side(k, radius, omega, theta):
    """Surface value of the potential and of its derivative along the side, per unit amplitude"""
    x = k * radius
    m = np.arange(int(x + 6 * np.cbrt(x) + 10))
    terms = np.where(m, 2, 1) * 1j**m * 2j / (np.pi * x * h1vp(m, x)) * -1j * G / omega
    turns = np.multiply.outer(theta, m)
    return np.cos(turns) @ terms, np.sin(turns) @ (-m * terms) / radius


@pytest.mark.parametrize("radius, depth, omega", CASES)
def test_drift_by_the_far_field_is_the_mean_pressure_on_the_side(radius, depth, omega):
    k = wavenumber(omega, depth)
    theta = np.arange(512) * 2 * np.pi / 512
    phi, along = potential_on_the_side(k, radius, omega, theta)
    square = group_factor(k, depth) * np.tanh(k * depth) / k  # ∫ cosh² k(z+h) dz / cosh² kh
    slope_square = k**2 * (square - depth / np.cosh(k * depth) ** 2)
    crest = -RHO * G / 4 * np.abs(omega / G * phi) ** 2
    speed = RHO / 4 * (np.abs(along) ** 2 * square + np.abs(phi) ** 2 * slope_square)
    force = np.mean((crest + speed) * np.cos(theta)) * 2 * np.pi * radius
    assert drift(radius, depth, omega)[0] == pytest.approx(force, rel=1e-9)


@pytest.mark.parametrize("radius, depth, omega", CASES)
def test_forces_are_the_pressure_on_the_side(radius, depth, omega):
    k = wavenumber(omega, depth)
    theta = np.arange(256) * 2 * np.pi / 256
    phi, _ = potential_on_the_side(k, radius, omega, theta)
    x, w = np.polynomial.legendre.leggauss(40)
    z = depth * (x - 1) / 2
    profile = w * depth / 2 * np.cosh(k * (z + depth)) / np.cosh(k * depth)
    around = -1j * RHO * omega * radius * 2 * np.pi * np.mean(phi * np.cos(theta))
    force = excitation(radius, depth, omega)
    assert force[0] == pytest.approx(around * profile.sum(), rel=1e-10)
    assert force[4] == pytest.approx(around * (profile @ z), rel=1e-10)


@pytest.mark.parametrize("x", [0.01, 0.5, 2.0, 15.0])
def test_diffracted_waves_take_their_energy_from_the_incident_one(x):
    h = harmonics(x)
    energy = np.abs(h[0]) ** 2 + 2 * np.sum(np.abs(h[1:]) ** 2)
    assert energy == pytest.approx(-(h[0] + 2 * h[1:].sum()).real, rel=1e-12)


@pytest.mark.parametrize("radius, depth, omega", CASES)
def test_damping_is_the_exciting_force_by_haskind(radius, depth, omega):
    """B = k/(8π ρ g C_g) ∫ |F(β)|² dβ, and F(β) = F(0) cos β"""
    k = wavenumber(omega, depth)
    group = group_factor(k, depth) * omega / k
    force = excitation(radius, depth, omega)[0]
    damping = k * abs(force) ** 2 / (8 * RHO * G * group)
    assert surge_radiation(radius, depth, omega)[1] == pytest.approx(damping, rel=1e-10)


def test_long_waves_push_with_twice_the_displaced_mass():
    """Inertia coefficient 2: F = 2 ρ π a² h · (acceleration g k i) and added mass ρ π a² h, for ka → 0."""
    radius, depth, omega = 1e-3, 1.0, 0.3
    k = wavenumber(omega, depth)
    mass = RHO * np.pi * radius**2 * depth
    force = excitation(radius, depth, omega)[0]
    acceleration = -1j * G * np.tanh(k * depth) / depth
    assert force == pytest.approx(2 * mass * acceleration, rel=1e-3)
    assert surge_radiation(radius, depth, omega)[0] == pytest.approx(mass, rel=1e-2)


def test_short_waves_drift_like_light_reflected_from_a_cylinder():
    """In deep water (2/3) ρ g a; the approach is of order (ka)^(−2/3)."""
    errors = []
    for x in (50.0, 400.0):
        radius = 10.0
        force = drift(radius, 1000.0, np.sqrt(G * x / radius))[0]
        errors.append(abs(force / (2 / 3 * RHO * G * radius) - 1))
    assert errors[0] < 50 ** (-2 / 3)
    assert errors[1] < 0.5 * errors[0]
