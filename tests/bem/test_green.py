"""The finite-depth Green function against the equations that define it."""

import numpy as np
import pytest
from scipy import special

from bem.green import green_function, pair
from bem.green_tables import limit_table, wave_table
from bem.waves import wavenumber

G = 9.80665
DEPTHS = [10.05, 12.0, 30.0, 200.0, np.inf]
SOURCE = np.array([0.0, 0.0, -6.0])


def scattered_points(n=60, draft=10.0, reach=90.0, seed=1):
    rng = np.random.default_rng(seed)
    R = reach * rng.random(n) ** 2 + 0.5
    angle = 2 * np.pi * rng.random(n)
    return np.stack([R * np.cos(angle), R * np.sin(angle), -draft * rng.random(n)], axis=-1)


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("omega", [0.02, 0.3, 1.0, 2.5])
def test_gradient_is_the_derivative_of_the_value(depth, omega):
    points = scattered_points()
    points[:, 2] = np.clip(points[:, 2], -9.9, -0.1)
    step = 1e-3
    _, gradient = green_function(points, SOURCE, omega, depth)
    for axis in range(3):
        shift = step * np.eye(3)[axis]
        up, down = (green_function(points + s, SOURCE, omega, depth)[0] for s in (shift, -shift))
        r = np.linalg.norm(points - SOURCE, axis=1)
        # cubic interpolation: 1e-5 of the singular part, and of the wave that decays more slowly
        scale = 1 / np.minimum(r, 30) ** 2
        assert np.max(np.abs((up - down) / (2 * step) - gradient[:, axis]) / scale) < 2e-3


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("omega", [0.02, 0.3, 1.0, 2.5])
def test_surface_condition_holds(depth, omega):
    points = scattered_points()
    points[:, 2] = 0.0
    K = omega**2 / G
    value, gradient = green_function(points, SOURCE, omega, depth)
    r = np.linalg.norm(points - SOURCE, axis=1)
    assert np.max(np.abs(gradient[:, 2] - K * value) * r**2) < 2e-4 * (1 + (K * 30) ** 2)


@pytest.mark.parametrize("omega", [0.02, 0.3, 1.0])
def test_no_water_passes_the_bed(omega):
    points = scattered_points()
    points[:, 2] = -10.05
    _, gradient = green_function(points, SOURCE, omega, 10.05)
    r = np.linalg.norm(points - SOURCE, axis=1)
    assert np.max(np.abs(gradient[:, 2]) * r**2) < 1e-4


@pytest.mark.parametrize("depth", [12.0, 40.0])
@pytest.mark.parametrize("omega", [0.1, 0.6, 1.5])
def test_far_from_the_source_only_the_outgoing_wave_is_left(depth, omega):
    k = float(wavenumber(omega, depth))
    R = np.linspace(6, 8, 5) * depth
    points = np.stack([R, 0 * R, -3.0 + 0 * R], axis=-1)
    K = omega**2 / G
    C = 2 * np.pi * k**2 / ((k**2 - K**2) * depth + K)

    def Z(z):
        return np.cosh(k * (z + depth)) / np.cosh(k * depth)

    wave = 1j * C * Z(-3.0) * Z(-6.0) * special.hankel1(0, k * R)
    value, _ = green_function(points, SOURCE, omega, depth)
    # the slowest evanescent mode is exp(−πR/2h) at most, below 1e-4; the rest is interpolation
    assert np.max(np.abs(value - wave)) < 3e-4 * np.abs(wave).max()


@pytest.mark.parametrize("omega", [0.5, 1.0, 2.0])
def test_deep_water_is_the_limit_of_growing_depth(omega):
    points = scattered_points()
    infinite, _ = green_function(points, SOURCE, omega, np.inf)
    errors = []
    for depth in (200.0, 400.0, 800.0):
        finite, _ = green_function(points, SOURCE, omega, depth)
        errors.append(np.abs(finite - infinite).max())
    # the bed image is 1/2h away and its own image in the surface cancels it to higher order
    assert errors[2] < errors[0] / 3 or errors[2] < 1e-5
    assert errors[2] < 2e-3


def test_direct_quadrature_of_the_principal_value_agrees():
    omega, depth, R, z, zeta = 0.6, 12.0, 4.0, -3.0, -5.0
    K, k = omega**2 / G, float(wavenumber(omega, depth))
    node, weight = np.polynomial.legendre.leggauss(60)
    breaks = np.concatenate([[0, 2 * k], 2 * k * 1.15 ** np.arange(1, 60)])
    mu = (0.5 * (breaks[1:] + breaks[:-1])[:, None] + 0.5 * np.diff(breaks)[:, None] * node).ravel()
    w = (0.5 * np.diff(breaks)[:, None] * weight).ravel()
    e = np.exp
    numerator = (mu + K) * e(mu * (z + zeta)) * (1 + e(-2 * mu * (z + depth))) * (1 + e(-2 * mu * (zeta + depth)))
    integrand = numerator / ((mu - K) - (mu + K) * e(-2 * mu * depth)) * special.j0(mu * R)
    table = wave_table(omega, depth, G, 50.0, 10.0)
    g = pair(R, z, zeta, table)[0] + 1 / np.hypot(R, z + zeta)
    assert g == pytest.approx(w @ integrand, abs=2e-6)  # of 1/r = 0.1


@pytest.mark.parametrize("which, sign", [("zero", 1), ("infinity", -1)])
def test_limits_are_sums_of_images(which, sign):
    depth, R, z, zeta = 12.0, 7.0, -3.0, -5.0
    table = limit_table(which, depth, 40.0, 10.0)
    ours = pair(R, z, zeta, table)[0]
    n = np.arange(1, 20001)
    total = 0.0
    for height, parity in ((z - zeta, 1), (-(z + zeta), sign)):
        # images repeat every 2h, at infinite frequency with alternating sign
        factor = parity * (sign**n if sign < 0 else 1)
        both = factor * (1 / np.hypot(R, height + 2 * n * depth) + 1 / np.hypot(R, height - 2 * n * depth))
        total += np.sum(both - (1 / (n * depth) if which == "zero" else 0))
    total -= 1 / np.hypot(R, z + zeta + 2 * depth)  # the bed image is counted apart
    if which == "infinity":
        assert ours == pytest.approx(total, abs=1e-5)
    else:  # up to the constant: compare the change with R
        other = pair(2 * R, z, zeta, table)[0]
        again = 0.0
        for height in (z - zeta, -(z + zeta)):
            again += np.sum(
                1 / np.hypot(2 * R, height + 2 * n * depth)
                + 1 / np.hypot(2 * R, height - 2 * n * depth)
                - 1 / (n * depth)
            )
        again -= 1 / np.hypot(2 * R, z + zeta + 2 * depth)
        assert ours - other == pytest.approx(total - again, abs=1e-5)
