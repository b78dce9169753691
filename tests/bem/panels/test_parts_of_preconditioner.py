"""The reduced equations of a preconditioner beside the product of whole matrices, image by image."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.sparse import csr_matrix

from hakobune.bem.panels.compressed import preconditioner
from hakobune.bem.panels.compressed.preconditioner import Preconditioner, _cell_functions

CELLS, STARTS = [slice(0, 3), slice(3, 5), slice(5, 9)], [0, 2, 3, 6]  # of nine nodes, six functions
N, F, IMAGES = 9, 6, 2


def by_cells(rng):
    """P (n, f) and R (f, n), each function on its own cell alone"""
    P = np.zeros((N, F))
    for span, low, high in zip(CELLS, STARTS[:-1], STARTS[1:], strict=True):
        P[span, low:high] = rng.normal(size=(span.stop - span.start, high - low))
    return csr_matrix(P), csr_matrix(np.where(P.T != 0, rng.normal(size=(F, N)), 0.0))


@pytest.mark.parametrize("far", [False, True])
def test_blocks_near_and_far_are_reduced_to_the_functions_of_their_cells(far):
    """R M P of each image: near blocks of single nodes, far ones U V of three sources with 2, 1 and 3 columns"""
    rng = np.random.default_rng(5)
    draw = lambda *shape: rng.normal(size=shape)  # noqa: E731
    P, R = by_cells(rng)
    M = np.zeros((IMAGES, N, N))
    near = []
    for span, places in ((CELLS[0], [0, 1, 2, N + 4, N + 8]), (CELLS[2], [5, 8, 3]), (CELLS[1], [N + 3, N + 0])):
        matrix = draw(span.stop - span.start, len(places))
        near.append((span, np.array(places), matrix))
        for column, place in zip(matrix.T, places, strict=True):
            M[place // N, span, place % N] += column
    sources = [(0, CELLS[2], draw(2, 4)), (1, CELLS[0], draw(1, 3)), (1, slice(3, 9), draw(3, 6))]
    targets = [(CELLS[0], draw(3, 3), np.array([0, 1, 5])), (slice(0, 5), draw(5, 4), np.array([2, 3, 4, 5]))]
    first = np.cumsum([0, *(len(V) for *_, V in sources)])
    if far:
        for span, U, places in targets:
            for (image, own, V), at in zip(sources, first, strict=False):
                for column, place in zip(U.T, places, strict=True):
                    if at <= place < at + len(V):
                        M[image, span, own] += np.outer(column, V[place - at])
    tree = SimpleNamespace(nodes=np.arange(N), geometry=SimpleNamespace(images=np.ones((IMAGES, 2))))
    parts = SimpleNamespace(rank=int(first[-1]), targets=targets if far else [], sources=sources)
    held = SimpleNamespace(P=P, R=R)
    found = Preconditioner._reduced(held, SimpleNamespace(tree=tree, near=near, far=parts), CELLS, np.array(STARTS))
    wanted = np.array([R.toarray() @ one @ P.toarray() for one in M])
    assert found == pytest.approx(wanted, abs=1e-5 * np.abs(wanted).max())


def test_what_is_smooth_is_solved_by_the_class_of_its_signs_and_the_rest_leaf_by_leaf():
    """P Â⁻¹ R v + B (v − P R v); Â = side (Σ ± reduced + i waves) and the diagonal, by the signs of each column"""
    rng = np.random.default_rng(7)
    P, R = by_cells(rng)
    one = object.__new__(Preconditioner)
    one.P, one.R, one.factors = P, R, {}
    one.by_image = rng.normal(size=(IMAGES, F, F)).astype(np.float32)
    one.standing = {key: (rng.normal(size=(F, 4)), rng.normal(size=(4, F))) for key in ((1, 1), (1, -1))}
    one.side, one.diagonal = rng.uniform(1, 2, (F, 1)), rng.uniform(20, 30, F)
    one.inverses = [(span, rng.normal(size=(span.stop - span.start,) * 2)) for span in CELLS]
    signs = np.array([[1, 1, 1], [1, -1, 1]])
    v = rng.normal(size=(N, 3)) + 1j * rng.normal(size=(N, 3))
    found = one(v, signs)
    for p in range(3):
        reduced = sum(sign * part for sign, part in zip(signs[:, p], one.by_image, strict=True))
        waves, double = one.standing[tuple(signs[:, p].tolist())]
        matrix = one.side * (reduced + 1j * waves @ double)
        smooth = R @ v[:, p]
        rest = v[:, p] - P @ smooth
        leaves = np.concatenate([inverse @ rest[span] for span, inverse in one.inverses])
        wanted = P @ np.linalg.solve(matrix + np.diag(one.diagonal), smooth) + leaves
        assert found[:, p] == pytest.approx(wanted, rel=1e-4, abs=1e-5 * np.abs(wanted).max())
    assert len(one.factors) == 2


@pytest.mark.parametrize("width, functions", [(0.9e-3, 2), (1.1e-3, 3)])
def test_a_cell_a_thousandth_as_wide_as_long_varies_along_its_length_alone(width, functions):
    """1, x and y at the corners of a rectangle are orthogonal, of sizes as 1, 1 and its width over its length; of
    a second cell, a square, there are three.  R P = 1, and P R keeps what is linear on a cell."""
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
    nodes = np.concatenate([corners * [20.0, 20.0 * width, 1.0] + [3.0, 5.0, -2.0], corners + [50.0, 0.0, -2.0]])
    tree = SimpleNamespace(nodes=nodes, cells=lambda most: [slice(0, 4), slice(4, 8)],
                           elements=SimpleNamespace(nodes=nodes, weights=np.repeat([2.0, 0.5], 4)))  # fmt: skip
    P, R, spans, starts = _cell_functions(tree)
    assert starts.tolist() == [0, functions, functions + 3] and len(spans) == 2
    assert (R @ P).toarray() == pytest.approx(np.eye(functions + 3), abs=1e-6)
    linear = np.column_stack([np.ones(8), nodes[:, 0]])
    assert P @ (R @ linear) == pytest.approx(linear, rel=1e-5)
    assert (P @ (R @ nodes[:, 1]))[4:] == pytest.approx(nodes[4:, 1], abs=1e-5)


def test_every_function_has_the_side_and_the_diagonal_of_its_own_cell(monkeypatch):
    """Of the hull −1 and of the lid 1, and a diagonal that differs from cell to cell"""
    P, R = by_cells(np.random.default_rng(3))
    monkeypatch.setattr(preconditioner, "_cell_functions", lambda tree: (P, R, CELLS, np.array(STARTS)))
    monkeypatch.setattr(preconditioner, "_leaf_inverses", lambda equations: "inverses")
    monkeypatch.setattr(Preconditioner, "_reduced", lambda self, equations, spans, starts: "reduced")
    side, diagonal = np.ones((N, 1)), np.repeat([0.1, 0.2, 0.3], [3, 2, 4])[:, None]
    side[:5] = -1.0
    made = Preconditioner(SimpleNamespace(tree=None, standing={}, side=side, diagonal=diagonal))
    assert made.side.ravel().tolist() == [-1, -1, -1, 1, 1, 1]
    assert made.diagonal.tolist() == [0.1, 0.1, 0.2, 0.3, 0.3, 0.3]
    assert (made.by_image, made.inverses, made.factors) == ("reduced", "inverses", {})


@pytest.mark.parametrize("width, functions", [(0.95e-3, 2), (1.05e-3, 3)])
def test_the_size_of_a_cell_is_that_of_its_farthest_node(width, functions):
    """Of two nodes at the ends and two near the middle: x counts as 0.71 beside 1, y as its width"""
    x, y = np.array([-1.0, -0.1, 0.1, 1.0]), np.array([1.0, -1.0, -1.0, 1.0])
    nodes = np.stack([20.0 * x + 7.0, 20.0 * width * y, np.full(4, -3.0)], axis=1)
    tree = SimpleNamespace(nodes=nodes, cells=lambda most: [slice(0, 4)],
                           elements=SimpleNamespace(nodes=nodes, weights=np.ones(4)))  # fmt: skip
    assert _cell_functions(tree)[3].tolist() == [0, functions]
