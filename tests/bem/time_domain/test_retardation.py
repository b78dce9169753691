"""Retardation functions against a memory known in closed form, K = (1 + αt − α²t²) exp(−αt)."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.time_domain import retardation as module
from hakobune.bem.time_domain.retardation import fourier_weights, retardation
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
    assert result.error.max() < 0.005


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


def test_times_that_cannot_hold_the_band_are_refused():
    A, B = coefficients()
    with pytest.raises(ValueError, match=r"time step is 0.5 s; allowed: above 0, at most 0.0833 s"):
        retardation(OMEGA, A, B, np.arange(0, 50, 0.5))
    with pytest.raises(ValueError, match=r"times start at 1 s"):
        retardation(OMEGA, A, B, TIMES + 1)
    with pytest.raises(ValueError, match=r"start at 0 s with steps from 1 to 2 s; allowed: from 0 s in equal steps"):
        retardation(OMEGA, A, B, [0, 1, 3])
    for times in ([], [0.0], [0.0, np.nan]):
        with pytest.raises(ValueError, match="allowed: at least two, finite"):
            retardation(OMEGA, A, B, times)
    with pytest.raises(ValueError, match="10 frequencies are given; allowed: at least 20"):
        retardation(OMEGA[:10], A[:10], B[:10], TIMES)


def test_limits_of_steps_frequencies_and_errors_from_both_sides(monkeypatch):
    """A quarter over the highest frequency, twenty frequencies, and two per cent of what transforms return"""
    A, B = coefficients()
    step = 0.25 / OMEGA[-1]
    retardation(OMEGA, A, B, step * np.arange(1200))
    with pytest.raises(ValueError, match=r"time step is 0.0835 s; allowed: above 0, at most 0.0833 s"):
        retardation(OMEGA, A, B, 1.002 * step * np.arange(1200))
    some = slice(0, 1500, 75)
    assert len(OMEGA[some]) == 20
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        retardation(OMEGA[some], A[some], B[some], step * np.arange(1200))
    with pytest.raises(ValueError, match="19 frequencies are given; allowed: at least 20"):
        retardation(OMEGA[some][1:], A[some][1:], B[some][1:], step * np.arange(1200))
    for error, told in ((0.019, False), (0.021, True)):
        monkeypatch.setattr(module, "_error", lambda *_, e=error: np.full((6, 6), e))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            assert retardation(OMEGA, A, B, step * np.arange(1200)).error[0, 0] == error
        assert len(caught) == told and (not told or "to 0.021 only; good: below 0.02" in str(caught[0].message))


def test_the_error_is_of_added_mass_or_damping_over_the_largest_of_both_motions():
    A, B = (np.stack([np.diag([4.0, 9, 1, 1, 1, 0])] * 3) * np.array([0.5, 1.0, 0.8])[:, None, None] for _ in range(2))
    made = SimpleNamespace(added_mass=lambda w: A, damping=lambda w: B)
    given_A, given_B = A.copy(), B.copy()
    given_A[1, 0, 1], given_B[2, 2, 2] = 0.3, 0.83
    found = module._error(made, np.array([0.1, 0.2, 0.3]), given_A, given_B)
    assert found[0, 1] == pytest.approx(0.3 / np.sqrt(4 * 9)) and found[2, 2] == pytest.approx(0.03)
    assert found.sum() == pytest.approx(0.05 + 0.03)
