"""Functions of the keel gap and sums over depth modes, against independent quadrature and closed forms."""

import numpy as np
import pytest
from scipy.special import eval_gegenbauer, gamma, jv, roots_gegenbauer

from hakobune.bem.depth_modes.bessel import scaled_bessel
from hakobune.bem.depth_modes.gap import ORDERS, Gap, evanescent_wavenumbers, mode_sum, tail_weights


def test_scaled_bessel_functions_agree_with_those_of_scipy():
    x = np.concatenate([np.geomspace(1e-5, 40, 200), np.linspace(25, 60, 200), np.geomspace(60, 400, 50)])
    ours = scaled_bessel(ORDERS, x, 6)
    for nu, rows in zip(ORDERS, ours, strict=True):
        for p, row in enumerate(rows):
            theirs = 2**nu * gamma(1 + nu) * jv(nu + 2 * p, x) / x**nu
            assert row == pytest.approx(theirs, abs=2e-14)


def test_moments_are_the_integrals_of_the_functions():
    """Gauss–Gegenbauer quadrature is exact for a polynomial times the weight (1 − t²)^(ν−½)."""
    gap, l = Gap(2.0, 5.0, 4), np.array([1.5, 2.5, 4.0])
    s = gap.height
    for i, (nu, p) in enumerate(zip(*gap.families, strict=True)):
        t, w = roots_gegenbauer(60, nu)
        values = w / 2 * eval_gegenbauer(2 * p, nu, t)  # half of the even integral
        # the scale is the functions' own; it is the same for every integral of one of them
        cosines, second = np.cos(np.outer(l * s, t)) @ values, np.sum(values * t**2)
        unit = gap.cosine_moments(l)[i] / cosines
        assert unit == pytest.approx(np.full(3, unit[0]), rel=1e-10)
        if p < 2:
            assert gap.second_moment[i] == pytest.approx(unit[0] * s**2 * second, rel=1e-10)
        if p == 0:
            assert gap.mean[i] == pytest.approx(unit[0] * values.sum(), rel=1e-12)
        hyperbolic = np.cosh(np.outer([0.7 * s], t)) @ values / np.cosh(0.7 * 5.0)
        assert gap.wave_moments(0.7)[i] == pytest.approx(unit[0] * hyperbolic[0], rel=1e-10)


def test_side_rows_are_the_integrals_over_the_side():
    gap, l, k = Gap(2.0, 5.0, 1), np.array([0.3, 1.1, 4.0]), 0.7
    x, w = np.polynomial.legendre.leggauss(40)
    z, w = x - 1, w  # side from −2 to 0
    with_cosine = np.cos(np.outer(l, z + 5.0))
    wave = np.cosh(k * (z + 5)) / np.cosh(k * 5)
    assert gap.outer_rows(l)[-2:] == pytest.approx(np.array([with_cosine @ w, with_cosine @ (w * z)]), abs=1e-13)
    assert gap.wave_rows(k)[-2:] == pytest.approx(np.array([wave @ w, wave @ (w * z)]), abs=1e-13)
    itself, others = gap.side_wave_moments(k, l)
    assert itself == pytest.approx(wave**2 @ w, abs=1e-13)
    assert others == pytest.approx(with_cosine @ (w * wave), abs=1e-13)


@pytest.mark.parametrize("y", [1e-8, 0.3, 5.0, 800.0])
def test_evanescent_wavenumbers_solve_their_equation_in_order(y):
    x = evanescent_wavenumbers(np.sqrt(y * 9.8), 1.0, 500, 9.8)
    n = np.arange(1, 501)
    assert np.all((x > (n - 0.5) * np.pi) & (x < n * np.pi))
    assert x * np.sin(x) + y * np.cos(x) == pytest.approx(np.zeros(500), abs=1e-11 * (y + 500))


def test_tail_weights_sum_series_to_infinity():
    n = np.arange(1, 201)
    # ζ(2), and Σ n⁻² cos(nx) = x²/4 − πx/2 + π²/6
    assert tail_weights(200, 2.0) @ (1 / n**2) == pytest.approx(np.pi**2 / 6, abs=1e-10)
    x = 2.0
    assert tail_weights(200, 2.0) @ (np.cos(n * x) / n**2) == pytest.approx(
        x**2 / 4 - np.pi * x / 2 + np.pi**2 / 6, abs=1e-8
    )


def test_sums_over_modes_converge_far_beyond_their_last_mode():
    """In a flow without corners the parts of z on the side have ∫z² dz as the sum of squares (Parseval)."""
    gap = Gap(2.0, 5.0, 2)
    l = np.pi / 5.0 * np.arange(1, 401)
    rows = gap.outer_rows(l)[-2:]
    whole = mode_sum(rows * np.sqrt(l), np.array([0.5, 0.5]), 2 / 5.0 / l)
    mean = np.array([2.0, -2.0])
    exact = np.array([[2.0, -2.0], [-2.0, 8 / 3]])
    assert whole + np.outer(mean, mean) / 5.0 == pytest.approx(exact, abs=1e-6)
