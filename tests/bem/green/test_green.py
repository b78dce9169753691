"""The finite-depth Green function against the equations that define it."""

import numpy as np
import pytest
from published.green_reference import by_frequency, by_table, errors, reference, wave_errors
from scipy import special

from hakobune.bem.green.deep_water import bessel, universal
from hakobune.bem.green.finite_depth import BLOCK, decay, green, green_function, table_pairs
from hakobune.bem.green.piecewise_polynomials import evaluate_piece, fit_pieces, sample_points
from hakobune.bem.green.tables import limit_table, wave_table
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import address
from hakobune.bem.waves import wavenumber

G = 9.80665
DEPTHS = [10.05, 12.0, 30.0, 200.0, np.inf]
SOURCE = np.array([0.0, 0.0, -6.0])


def scattered_points(n=60, draft=10.0, reach=90.0, seed=1):
    rng = np.random.default_rng(seed)
    R = reach * rng.random(n) ** 2 + 0.5
    angle = 2 * np.pi * rng.random(n)
    return np.stack([R * np.cos(angle), R * np.sin(angle), -draft * rng.random(n)], axis=-1)


def without_images(R, z, zeta, table, depth):
    """Real part of G through a table less 1/r and the images in surface and bed; R, z, zeta : m, numbers"""
    found = table_pairs(table, *(np.array([one]) for one in (R, z, zeta)))[0, 0].real
    return found - sum(1 / np.hypot(R, height) for height in (z - zeta, z + zeta, z + zeta + 2 * depth))


def with_gravity_one(R, z, zeta, omega, depth):
    return green(R, z, zeta, omega, depth, 1.0)


def test_forty_digit_values_are_met_to_a_hundred_millionth():
    rows = reference()
    assert len(rows) >= 500
    found = by_frequency(with_gravity_one, rows)
    # down to a ten-thousandth of 1/r and 1/r², below which G is what is left of cancelling images
    value, gradient = errors(found, rows, 1e-4)
    assert value.max() <= 1e-8 and gradient.max() <= 1e-8, (value.max(), gradient.max())
    assert wave_errors(found, rows).max() <= 1e-8


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8])
def test_tables_are_as_accurate_as_asked(accuracy):
    rows = reference()
    value, gradient = errors(by_frequency(by_table(accuracy), rows), rows, 1.0)
    assert value.max() <= accuracy and gradient.max() <= accuracy, (value.max(), gradient.max())


def test_tables_of_a_shallow_body_are_as_accurate_as_asked():
    rows = reference()
    rows = rows[(np.minimum(rows["z"], rows["zeta"]) >= -0.4) & np.isfinite(rows["depth"])]
    value, gradient = errors(by_frequency(by_table(1e-5, draft=0.4), rows), rows, 1.0)
    assert value.max() <= 1e-5 and gradient.max() <= 1e-5


def test_an_accuracy_that_tables_do_not_have_is_refused():
    with pytest.raises(ValueError, match=r"accuracy is 1e-12; allowed: 1e-08 to 0\.001"):
        wave_table(0.5, 20.0, G, 100.0, 10.0, 1e-12)


@pytest.mark.parametrize("kh", [1e-4, 0.3, 3.0, 15.0, 70.0, 200.0])
def test_forms_meet_where_one_takes_over_from_the_other(kh):
    omega = float(np.sqrt(kh * np.tanh(kh)))
    seams = np.repeat(0.5 * 2.0 ** np.arange(8), 5)
    z, zeta = np.random.default_rng(3).random((2, len(seams))) - 1
    step = 1e-10
    left, right = (green(seams * (1 + s), z, zeta, omega, 1.0, 1.0) for s in (-step, step))
    r = np.hypot(seams, z - zeta)
    change = np.abs(right[0] - left[0] - 2 * step * seams * left[1])
    assert np.max(change / np.maximum(np.abs(left[0]), 1e-4 / r)) < 2e-8  # either may be 1e-8 off


@pytest.mark.parametrize(
    "place, message",
    [
        ((1.0, 0.1, -1.0), "z is 0.1 m at pair 0; allowed: -12 to 0"),
        ((1.0, -1.0, -12.5), "zeta is -12.5 m at pair 0"),
        ((-1.0, -1.0, -2.0), "R is -1.0 m at pair 0; allowed: 0 or more"),
        ((np.nan, -1.0, -2.0), "R is nan m at pair 0"),
        (([1.0, 0.0], -2.0, -2.0), "pair 1: R is 0 and z is zeta"),
    ],
)
def test_impossible_points_are_refused(place, message):
    with pytest.raises(ValueError, match=message):
        green(*place, 0.5, 12.0)


@pytest.mark.parametrize("omega, depth", [(0.0, 12.0), (0.5, 0.0), (np.nan, 12.0)])
def test_impossible_water_is_refused(omega, depth):
    with pytest.raises(ValueError, match="allowed: above 0"):
        green(1.0, -1.0, -2.0, omega, depth)


def test_nothing_is_made_up_beyond_the_reach_of_a_table():
    table = wave_table(0.5, 100.0, G, 40.0, 10.0)
    near, far = table_pairs(table, np.array([40.0, 80.0]), np.full(2, -1.0), np.full(2, -2.0))[0]
    assert np.isfinite(near) and np.isnan(far)


def test_a_table_holds_at_any_distance_if_its_reach_does():
    depth, omega, z, zeta = 5.0, 0.4, -1.0, -2.0
    table = wave_table(omega, depth, G, 1e4, 5.0, 1e-8)
    for R in (100.0, 1000.0, 9000.0):
        value = green(R, z, zeta, omega, depth)[0].real
        images = sum(1 / np.hypot(R, height) for height in (z - zeta, z + zeta, z + zeta + 2 * depth))
        assert without_images(R, z, zeta, table, depth) == pytest.approx(value - images, rel=1e-7, abs=1e-10)


@kernel()
def bessel_of(x, lines):
    return bessel(x, address(lines))


@kernel()
def decay_of(x, found):
    for n in range(len(x)):
        found[n] = decay(x[n])


def test_the_exponential_of_many_is_that_of_numpy():
    x = np.concatenate([[0.0, 1e-300], np.linspace(0, 1, 10_001), np.linspace(0, 700, 1_000_001)])
    found = np.full(len(x), np.nan)
    decay_of(x, found)
    assert found[0] == 1.0
    # 14 terms of the series leave 0.35¹⁴/14! = 5e-18; the rest is rounding
    assert np.max(np.abs(found / np.exp(-x) - 1)) < 4 * np.finfo(float).eps
    few = np.array([np.nan, 800.0, 1e300, np.inf, 1e-20])
    decay_of(few, found)
    assert np.isnan(found[0]) and np.all(found[1:4] < 1e-303) and found[4] == 1.0


def test_bessel_functions_agree_with_scipy():
    x = np.concatenate([10 ** np.linspace(-12, 5, 400), np.linspace(0.01, 40, 400)])
    found = np.array([bessel_of(value, universal().bessel) for value in x]).T
    wanted = np.array([special.j0(x), special.y0(x), -special.j1(x), -special.y1(x)])
    modulus = np.hypot(wanted[::2], wanted[1::2]).repeat(2, axis=0)
    # pieces of half-width 1/4 from x = 2 on, where 0 is 2.25 from the middle of one: (2 · 2.25 / 0.25)⁻⁸ = 1e-10
    assert np.max(np.abs(found - wanted) / modulus) < 2e-10


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_a_pair_has_the_same_bits_alone_and_among_others(depth):
    R, z, zeta = np.random.default_rng(5).random((3, 2 * BLOCK + 45)) * [[50.0], [-20.0], [-20.0]]
    together = green(R, z, zeta, 0.8, depth)
    for n in (*range(40), *range(2 * BLOCK - 5, len(R))):
        assert all(one == many[n] for one, many in zip(green(R[n], z[n], zeta[n], 0.8, depth), together, strict=True))


@kernel()
def look_at(pieces, n, x, y):
    return evaluate_piece(address(pieces), n, x, y)


def test_a_polynomial_of_degree_seven_is_its_own_piece():
    c = np.random.default_rng(4).normal(size=(8, 8))
    p = np.polynomial.Polynomial
    x, y = sample_points([0, 2, 4]), sample_points([0, 1, 2, 3])
    pieces = fit_pieces(np.polynomial.polynomial.polyval2d(*np.meshgrid(x / 4, y / 3, indexing="ij"), c))
    # second piece of x, third of y: their local variables −0.2 and 0.6
    u, v = 2.8 / 4, 2.8 / 3
    f, fx, fy = look_at(pieces, 2 * 2 + 1, -0.2, 0.6)
    in_x, in_y = p([p(row)(v) for row in c]), p([p(column)(u) for column in c.T])
    assert f == pytest.approx(in_x(u), rel=1e-12)
    assert fx == pytest.approx(in_x.deriv()(u) / 4, rel=1e-11)
    assert fy == pytest.approx(in_y.deriv()(v) / 3 / 2, rel=1e-11)


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("omega", [0.02, 0.3, 1.0, 2.5])
def test_gradient_is_the_derivative_of_the_value(depth, omega):
    points = scattered_points()
    points[:, 2] = np.clip(points[:, 2], -9.9, -0.1)
    step, k = 1e-3, float(wavenumber(omega, depth))
    _, gradient = green_function(points, SOURCE, omega, depth)
    for axis in range(3):
        shift = step * np.eye(3)[axis]
        up, down = (green_function(points + s, SOURCE, omega, depth)[0] for s in (shift, -shift))
        r = np.linalg.norm(points - SOURCE, axis=1)
        r = np.minimum(r, np.linalg.norm(points - SOURCE * [1, 1, -1], axis=1))
        # third derivatives of 1/r and its images, of the wave, and the values' own error
        allowed = step**2 * (6 / r**4 + 2 * np.pi * k**4) + 1e-8 * (1 / r + 2 * np.pi * k) / step
        assert np.max(np.abs((up - down) / (2 * step) - gradient[:, axis]) / allowed) < 1


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("omega", [0.02, 0.3, 1.0, 2.5])
def test_surface_condition_holds(depth, omega):
    points = scattered_points()
    points[:, 2] = 0.0
    K = omega**2 / G
    value, gradient = green_function(points, SOURCE, omega, depth)
    size = np.linalg.norm(gradient, axis=1) + K * np.abs(value)
    assert np.max(np.abs(gradient[:, 2] - K * value) / size) < 2e-8


@pytest.mark.parametrize("omega", [0.02, 0.3, 1.0])
def test_no_water_passes_the_bed(omega):
    points = scattered_points()
    points[:, 2] = -10.05
    _, gradient = green_function(points, SOURCE, omega, 10.05)
    assert np.max(np.abs(gradient[:, 2]) / np.linalg.norm(gradient, axis=1)) < 1e-8


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
    # the slowest evanescent mode is exp(−πR/2h) at most, below 1e-4
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
    g = without_images(R, z, zeta, table, depth) + 1 / np.hypot(R, z + zeta)
    assert g == pytest.approx(w @ integrand, abs=2e-6)  # of 1/r = 0.1


@pytest.mark.parametrize("which, sign", [("zero", 1), ("infinity", -1)])
def test_limits_are_sums_of_images(which, sign):
    depth, R, z, zeta = 12.0, 7.0, -3.0, -5.0
    table = limit_table(which, depth, 40.0, 10.0)
    ours = without_images(R, z, zeta, table, depth)
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
        other = without_images(2 * R, z, zeta, table, depth)
        again = 0.0
        for height in (z - zeta, -(z + zeta)):
            again += np.sum(
                1 / np.hypot(2 * R, height + 2 * n * depth)
                + 1 / np.hypot(2 * R, height - 2 * n * depth)
                - 1 / (n * depth)
            )
        again -= 1 / np.hypot(2 * R, z + zeta + 2 * depth)
        assert ours - other == pytest.approx(total - again, abs=1e-5)


def test_a_source_elsewhere_has_the_same_flow_about_it():
    points, away = scattered_points(12), np.array([13.0, -21.0, 0.0])
    here, there = (green_function(points + move, SOURCE + move, 0.6, 12.0) for move in (0.0 * away, away))
    for one, other in zip(here, there, strict=True):
        assert other == pytest.approx(one, rel=1e-9)
