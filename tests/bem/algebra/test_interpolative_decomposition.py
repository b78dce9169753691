"""Row interpolative decomposition: exact at the selected rows, to the tolerance at the others."""

import numpy as np
import pytest

from hakobune.bem.algebra import interpolative_decomposition as interpolation
from hakobune.bem.algebra.interpolative_decomposition import (
    Sketch,
    interpolative_decomposition,
    truncated_least_squares,
)


def smooth_matrix(n=300, m=500):
    """1/distance between two separated clouds: singular values fall exponentially"""
    generator = np.random.default_rng(5)
    x, y = generator.random((n, 3)), generator.random((m, 3)) + [0, 0, 1.5]
    return 1 / np.linalg.norm(x[:, None] - y, axis=-1)


def sketched(A, width=256):
    sketch = Sketch(np.ones(len(A)), width)
    for block in np.array_split(A, 3, axis=1):
        sketch.add(block)
    return sketch.matrix


def test_a_sketch_keeps_the_norms_of_combinations_of_rows():
    A = smooth_matrix()
    x = np.random.default_rng(1).standard_normal((len(A), 20))
    sizes, kept = (np.linalg.norm(x.T @ M, axis=1) for M in (A, sketched(A, 1024)))
    # a sum of m squares of random signs: the relative deviation is about √(2/width)
    np.testing.assert_allclose(kept, sizes, rtol=5 * np.sqrt(2 / 1024))


def test_complex_columns_count_as_two_real_ones():
    A = smooth_matrix(40, 60)
    whole = np.concatenate([A, 2 * A], axis=1)
    x = np.random.default_rng(2).standard_normal(40)
    sketch = Sketch(np.ones(40), 2048)
    sketch.add(A + 2j * A)
    assert np.linalg.norm(x @ sketch.matrix) == pytest.approx(np.linalg.norm(x @ whole), rel=0.15)


def test_weights_parts_and_blocks_of_a_sketch_are_those_of_the_matrix_itself():
    A = smooth_matrix(40, 60)
    rows, columns = np.random.default_rng(3).random((2, 40)) + 0.5
    plain, weighted, parted = Sketch(np.ones(40), 256), Sketch(rows, 256), Sketch(np.ones(40), 256)
    B = np.stack([A[:, :40], 2j * A[:, 20:]])  # two blocks, one of them with imaginary parts alone
    plain.add(rows[:, None] * B * columns)
    weighted.add(B, scale=columns)
    parted.add(*np.split(rows[:, None] * B, [13], axis=1), scale=columns)
    for other in (weighted, parted):
        other.add(B[..., :0])  # as of a block that has nodes of the lid alone
        np.testing.assert_allclose(other.matrix, plain.matrix, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-7])
def test_selected_rows_reproduce_the_others_to_the_tolerance(tolerance):
    A = smooth_matrix()
    rows, X = interpolative_decomposition(sketched(A), tolerance)
    np.testing.assert_allclose(X[rows], np.eye(len(rows)), atol=1e-12)
    assert np.all(np.diff(rows) > 0)
    # Gu & Eisenstat: within √(1 + r(n − r)) of the next singular value, in practice a few times the last pivot
    assert np.linalg.norm(A - X @ A[rows], axis=1).max() < 10 * tolerance


def test_a_smaller_tolerance_selects_more_rows_but_never_more_than_the_rank():
    A = smooth_matrix()
    counts = [len(interpolative_decomposition(sketched(A), tolerance)[0]) for tolerance in (1e-2, 1e-4, 1e-6)]
    assert counts == sorted(counts) and counts[0] < counts[2]
    low = A[:, :7] @ np.random.default_rng(3).standard_normal((7, 500))
    assert len(interpolative_decomposition(sketched(low), 1e-8)[0]) == 7


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_cholesky_and_qr_select_as_many_rows_and_leave_as_little(tolerance):
    A = smooth_matrix()
    found = [select(A, tolerance) for select in (interpolation._by_cholesky, interpolation._by_qr)]
    (one, _, rank), (other, _, same) = found
    assert rank == same
    np.testing.assert_allclose(*(np.abs(np.diag(R)[:rank]) for R in (one, other)), rtol=1e-3)
    assert interpolation._by_cholesky(A, 1e-8) is None  # whose square is lost in rounding


@pytest.mark.parametrize("cutoff", [1e-10, 1e-5])
def test_least_squares_leave_out_vanishing_singular_values(cutoff):
    A = np.outer(np.arange(1.0, 5.0), [1.0, 1.0])
    x = truncated_least_squares(A, 2 * A[:, :1], cutoff)
    np.testing.assert_allclose(x, [[1.0], [1.0]], rtol=1e-12)


def test_least_squares_by_eigenvalues_are_those_by_singular_values():
    A, cutoff = smooth_matrix(300, 60), 1e-5
    b = np.random.default_rng(4).standard_normal((len(A), 3))
    U, size, Vh = np.linalg.svd(A, full_matrices=False)
    kept = size > cutoff * size[0]
    assert 5 < np.count_nonzero(kept) < 60
    expected = Vh[kept].T @ ((U[:, kept].T @ b) / size[kept][:, None])
    # rounding of Aᵀ A, over the square of the cutoff
    np.testing.assert_allclose(
        truncated_least_squares(A, b, cutoff), expected, atol=10 * 2.2e-16 / cutoff**2 * np.abs(expected).max()
    )


def test_a_column_goes_into_four_places_with_random_signs():
    """± a/√4 each"""
    sketch = interpolation.Sketch(np.ones(1), 100_000)
    sketch.add(np.full((1, 50), 3.0))
    found = sketch.matrix[sketch.matrix != 0]
    assert np.abs(found) == pytest.approx(np.full(len(found), 1.5)) and 150 < len(found) <= 200
    assert 0.3 < np.mean(found > 0) < 0.7
