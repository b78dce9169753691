"""Systems whose imaginary part has few columns, by a real factorisation."""

import numpy as np
import pytest

from hakobune.bem.algebra.systems import WORTH_REFINING, _refined, solved_beside_few, solved_systems


def systems(singular):
    rng = np.random.default_rng(3)
    A = rng.standard_normal((3, 40, 40)) + 8 * np.eye(40)
    U, V = rng.standard_normal((2, 3, 40, 5))
    if singular:  # where the other is not
        left, size, right = np.linalg.svd(A[1])
        A[1] -= size[-1] * np.outer(left[:, -1], right[-1])
    return A, U, V, rng.standard_normal((3, 40, 4)) + 1j * rng.standard_normal((3, 40, 4))


@pytest.mark.parametrize("singular", [False, True])
def test_solution_is_that_of_the_complex_system(singular):
    A, U, V, b = systems(singular)
    found, left = solved_beside_few((A, U, V, b), (4, 2, 3))
    assert left < 1e-10
    for x, whole, side in zip(found, A + 1j * (U @ V.swapaxes(1, 2)), b, strict=True):
        exact = np.linalg.solve(whole, side[:, : x.shape[1]])
        assert np.abs(x - exact).max() < 1e-10 * np.abs(exact).max()


def test_only_where_the_real_matrix_is_singular_a_complex_one_of_its_size_is_solved(monkeypatch):
    for singular, wanted in ((False, 0), (True, 1)):
        factored = []

        def solve(matrix, side, _factored=factored):
            _factored.append(len(matrix) if np.iscomplexobj(matrix) else 0)
            return np.linalg.solve(matrix, side)

        monkeypatch.setattr("hakobune.bem.algebra.systems._solved", solve)
        solved_beside_few(systems(singular), (4, 4, 4))
        assert factored.count(40) == wanted and factored.count(5) == 3


def test_singular_system_has_no_finite_solution():
    A, U, V, b = systems(False)
    A[2, 0] = U[2, 0] = 0.0
    found, left = solved_beside_few((A, U, V, b), (4, 4, 4))
    assert np.all(np.isfinite(found[0])) and not np.all(np.isfinite(found[2])) and not left < 1.0


@pytest.mark.parametrize("size", [WORTH_REFINING, WORTH_REFINING + 41])
def test_factors_in_single_precision_leave_no_more_than_rounding(size):
    rng = np.random.default_rng(5)
    A = rng.standard_normal((2, size, size)) / size**0.5 + 2 * np.eye(size)
    A[1] *= 1e30  # units do not count
    U, V = rng.standard_normal((2, 2, size, 7)) / size**0.5
    b = rng.standard_normal((2, size, 3)) + 1j * rng.standard_normal((2, size, 3))
    found, left = solved_beside_few((A, U, V, b), (3, 3))
    assert left < 1e-11
    for x, whole, side in zip(found, A + 1j * (U @ V.swapaxes(1, 2)), b, strict=True):
        exact = np.linalg.solve(whole, side)
        assert np.abs(x - exact).max() < 1e-10 * np.abs(exact).max()
    real = solved_systems(A, list(b.real))
    assert np.isrealobj(real[0]) and np.abs(A[0] @ real[0] - b[0].real).max() < 1e-10


def test_matrices_that_single_precision_takes_for_singular_are_factored_in_double():
    rng = np.random.default_rng(6)
    A = np.eye(WORTH_REFINING)[None] + 1e-9 * rng.standard_normal((1, WORTH_REFINING, WORTH_REFINING))
    A[0, 0] = A[0, 1] + 1e-9 * rng.standard_normal(WORTH_REFINING)
    b = rng.standard_normal((1, WORTH_REFINING, 2)) + 0j
    (x,), _ = solved_beside_few((A, np.zeros((1, WORTH_REFINING, 0)), np.zeros((1, WORTH_REFINING, 0)), b), (2,))
    exact = np.linalg.solve(A[0], b[0])
    assert np.abs(x - exact).max() < 1e-6 * np.abs(exact).max()


def test_steps_in_single_precision_go_on_until_rounding_is_left():
    """A step leaves 1e-6 of what was there: two or three to 1e-12; what cannot be solved so keeps what is left"""
    rng, size = np.random.default_rng(6), 60
    A = rng.standard_normal((size, size)) / size**0.5 + 2 * np.eye(size)
    U, V = rng.standard_normal((2, size, 5)) / size**0.5
    b = rng.standard_normal((size, 3)) + 1j * rng.standard_normal((size, 3))
    x, left = _refined(A, U, V, b)
    whole = A + 1j * (U @ V.T)
    assert left < 1e-12 and np.abs(whole @ x - b).max() < 1e-11 * np.abs(b).max()
    values = np.linalg.svd(A)
    nearly = A - values[1][-1] * (1 - 1e-9) * np.outer(values[0][:, -1], values[2][-1])
    assert not _refined(nearly, U, V, b)[1] < 1e-10


def test_a_matrix_that_single_precision_refines_is_not_factored_once_more(monkeypatch):
    rng, sizes = np.random.default_rng(7), []
    A = rng.standard_normal((1, WORTH_REFINING, WORTH_REFINING)) / WORTH_REFINING**0.5 + 2 * np.eye(WORTH_REFINING)
    U, V = rng.standard_normal((2, 1, WORTH_REFINING, 3)) / WORTH_REFINING**0.5

    def solve(matrix, side):
        sizes.append(len(matrix))
        return np.linalg.solve(matrix, side)

    monkeypatch.setattr("hakobune.bem.algebra.systems._solved", solve)
    _, left = solved_beside_few((A, U, V, np.ones((1, WORTH_REFINING, 1), complex)), (1,))
    assert left < 1e-11 and set(sizes) == {3}
