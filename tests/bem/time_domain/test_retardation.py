"""Retardation functions against a memory known in closed form, K = (1 + αt − α²t²) exp(−αt)."""

import numpy as np
import pytest
from retardation import fourier_weights, retardation

from hakobune.bem.time_domain.whole_axis import kramers_kronig

ALPHA, INFINITY = 0.4, 5.0
OMEGA = np.linspace(0.01, 3.0, 1500)
TIMES = np.arange(0, 100.01, 0.08)
SOME = OMEGA[::50]


def transform(omega):
    """∫ K exp(iωt) dt: no damping at ω = 0, damping like ω⁻⁴ in short waves"""
    p = ALPHA - 1j * np.asarray(omega)
    return 1 / p + ALPHA / p**2 - 2 * ALPHA**2 / p**3


def coefficients():
    exact = transform(OMEGA)
    shape = np.eye(6) + 0.5 * np.eye(6, k=4) + 0.5 * np.eye(6, k=-4)
    return np.multiply.outer(INFINITY - exact.imag / OMEGA, shape), np.multiply.outer(exact.real, shape)


def made(limit=None):
    A, B = coefficients()
    return retardation(OMEGA, A, B, TIMES, limit)


def test_the_memory_is_that_of_the_damping_beyond_the_band_too():
    exact = (1 + ALPHA * TIMES - (ALPHA * TIMES) ** 2) * np.exp(-ALPHA * TIMES)
    assert np.abs(made().K[:, 0, 0] - exact).max() < 0.01  # of K(0) = 1


def limit():
    return INFINITY * (np.eye(6) + 0.5 * np.eye(6, k=4) + 0.5 * np.eye(6, k=-4))


def test_added_mass_at_infinity_follows_from_the_band():
    largest = np.abs(coefficients()[0] - limit()).max()
    assert np.abs(made().added_mass_infinity - limit()).max() < 0.005 * largest


@pytest.mark.parametrize("known", [None, limit()], ids=["limit unknown", "limit known"])
def test_transforms_return_added_mass_and_damping(known):
    result = made(known)
    A, B = coefficients()
    assert np.abs(result.damping(SOME) - B[::50]).max() < 0.005 * np.abs(B).max()
    assert np.abs(result.added_mass(SOME) - A[::50]).max() < 0.005 * np.abs(A).max()


def test_an_entry_without_damping_has_no_memory():
    assert np.all(made().K[:, 0, 1] == 0)


def test_fourier_weights_are_exact_for_straight_lines():
    points = np.array([0.0, 0.3, 1.0, 2.5])
    for w in (1e-6, 0.01, 1.0, 30.0):
        p = 1j * w
        exact = np.exp(p * 2.5) * (2.5 / p - 1 / p**2) + 1 / p**2 if w > 1e-3 else 2.5**2 / 2
        assert (fourier_weights(w, points) @ points)[0] == pytest.approx(exact, rel=1e-5)


def test_kramers_and_kronig_relate_the_exact_pair():
    x = np.concatenate([np.linspace(0, 4, 4001), np.geomspace(4, 4000, 2000)[1:]])
    omega = np.array([0.1005, 0.7005, 2.0005])
    found = (2 / np.pi) * kramers_kronig(omega, x) @ transform(x).real
    assert found == pytest.approx(-transform(omega).imag / omega, rel=1e-4)
