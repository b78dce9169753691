"""Poles and residues of rational functions from few values, and systems that are solved side by side or in turn."""

import numpy as np
import pytest

from hakobune.bem.algebra import poles as module
from hakobune.bem.algebra import systems
from hakobune.bem.algebra.interpolative_decomposition import truncated_least_squares
from hakobune.bem.algebra.poles import poles

X = np.linspace(0.2, 2.0, 25)
POLES, RESIDUES = np.array([0.8 - 0.05j, 1.4 - 0.1j]), np.array([[1.0 + 0.5j, -0.3j], [0.2, 2.0 - 1.0j]])


def rational(x, poles=POLES, residues=RESIDUES, constant=(0.3, -1.0)):
    return (1 / (x[:, None] - poles)) @ residues + np.array(constant)


def nearest(found, wanted):
    return np.abs(found[:, None] - wanted).argmin(axis=0)


def test_two_poles_of_two_functions_are_found_with_their_residues():
    """Relative to the largest value of each function"""
    values = rational(X)
    found, residues = poles(X, values)
    own = nearest(found, POLES)
    assert found[own] == pytest.approx(POLES, abs=1e-8)
    assert residues[own] == pytest.approx(RESIDUES / np.abs(values).max(axis=0), abs=1e-7)
    again, scaled = poles(X, values * [1e6, 1e-3])
    assert again[nearest(again, POLES)] == pytest.approx(POLES, abs=1e-8)
    assert scaled[nearest(again, POLES)] == pytest.approx(residues[own], abs=1e-6)


def test_a_constant_and_what_no_rational_function_meets_have_no_poles(monkeypatch):
    found, residues = poles(X, np.ones((25, 3)))
    assert found.shape == (0,) and residues.shape == (0, 3)
    rough = np.random.default_rng(1).normal(size=(25, 1))
    assert len(poles(X, rough)[0]) == 0
    monkeypatch.setattr(module, "MOST", 1)  # one place is no pole
    assert len(poles(X, rational(X))[0]) == 0


def test_places_are_taken_until_a_thousandth_is_missed_and_no_more(monkeypatch):
    """The second pole, of a residue of a millionth beside 1, is below what is asked for"""
    asked, through = [], module._through

    def noted(x, values, taken):
        asked.append(list(taken))
        return through(x, values, taken)

    monkeypatch.setattr(module, "_through", noted)
    values = rational(X, POLES, np.array([[1.0], [1e-6]]), (0.0,))
    found, _ = poles(X, values)
    assert len(asked[-1]) == 2 and len(found) == 1 and found[0] == pytest.approx(POLES[0], abs=1e-4)
    first = np.abs(values / np.abs(values).max() - (values / np.abs(values).max()).mean()).argmax()
    assert asked[0] == [first] and all(len(set(taken)) == len(taken) for taken in asked)


@pytest.mark.parametrize("n, together", [(4, True), (6, False)])
def test_small_systems_are_solved_side_by_side_and_large_ones_in_turn(n, together, monkeypatch):
    """Above the limit by one thread after another, with all of BLAS"""
    monkeypatch.setattr(systems, "SIDE_BY_SIDE", 5)
    asked = []

    def parallel(work, rows, pairs):
        asked.append((rows, pairs))
        work(0, rows)

    monkeypatch.setattr(systems, "parallel_rows", parallel)
    rng = np.random.default_rng(2)
    A, b = rng.normal(size=(3, n, n)) + 5 * np.eye(n), rng.normal(size=(3, n, 2))
    for matrices in (A, A + 1j * np.eye(n)):
        found = systems.solved_systems(matrices, list(b))
        for matrix, side, x in zip(matrices, b, found, strict=True):
            assert matrix @ x == pytest.approx(side)
            assert np.iscomplexobj(x) == np.iscomplexobj(matrices)
    assert asked == ([(3, 3 * n * n)] * 2 if together else [])
    assert systems.solved_systems(A[:0], []) == []


def test_a_singular_matrix_has_no_numbers_and_the_others_have_theirs():
    A = np.array([np.eye(2), np.ones((2, 2))])
    one, none = systems.solved_systems(A + 0j, [np.ones((2, 1)), np.ones((2, 1))])
    assert one == pytest.approx(np.ones((2, 1))) and np.isnan(none).all() and none.dtype == complex


def test_what_is_left_is_relative_to_the_largest_entry_of_each_side():
    rest, b = np.array([[1e-3, 0.0], [0.0, 2e-2]]), np.array([[1.0, 4.0], [0.5, -10.0]])
    assert systems._relative(rest, b) == pytest.approx(2e-3)
    assert systems._relative(np.array([[1e-3j], [0.0]]), np.array([[0.0], [0.1]])) == pytest.approx(1e-2)
    A, U, V = np.diag([2.0, 3.0]), np.array([[1.0], [0.0]]), np.array([[0.0], [1.0]])
    x = np.array([[1.0], [1j]])
    b = A @ x + 1j * U @ (V.T @ x) + np.array([[0.3], [0.0]])
    assert systems._left(A, U, V, b, x) == pytest.approx(0.3 / np.abs(b).max())


@pytest.mark.parametrize("cutoff", [1e-3, 1e-8])
def test_singular_values_below_the_cutoff_are_left_out(cutoff):
    """By eigenvalues of AᵀA, or by singular values where their squares are rounding; 10 % above and below"""
    rng = np.random.default_rng(5)
    left = np.linalg.qr(rng.normal(size=(9, 3)))[0]
    right = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    size = np.array([2.0, 2.0 * 1.1 * cutoff, 2.0 * 0.9 * cutoff])
    b = left @ np.array([[2.0], [3.0 * cutoff], [5.0 * cutoff]])
    found = truncated_least_squares((left * size) @ right.T, b, cutoff)
    wanted = right[:, :2] @ (np.array([[2.0], [3.0 * cutoff]]) / size[:2, None])
    assert found == pytest.approx(wanted, rel=1e-5)


@pytest.mark.parametrize("off, looked", [(0.97e-3, False), (1.05e-3, True)])
def test_what_a_constant_misses_by_a_thousandth_has_no_poles(off, looked, monkeypatch):
    asked = []
    monkeypatch.setattr(module, "_through", lambda x, values, taken: asked.append(taken) or (values, None))
    monkeypatch.setattr(module, "_zeros", lambda *them: ("poles", "residues"))
    values = np.ones((24, 1))
    values[::2] -= 2 * off  # as far below their mean as the others are above it
    poles(X[:24], values)
    assert bool(asked) == looked
