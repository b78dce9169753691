"""Equations of a chain of nodes as plain Python: block elimination beside the dense solution of numpy."""

import numpy as np
import pytest
from plain import plain

band = plain("mooring.lines.dynamics.lumped.band")
blocks = plain("mooring.lines.dynamics.lumped.block_tridiagonal")
WIDTH = 16


def equations(first, last, bending):
    """D, B (9, w), e and f (w,), r (3, w), and the dense solution (3, last − first + 1)"""
    rng = np.random.default_rng(7)
    D, B = np.full((9, WIDTH), np.nan), np.full((9, WIDTH), np.nan)
    e, f, r = np.zeros(WIDTH), np.zeros(WIDTH), rng.normal(size=(3, WIDTH))
    count = last - first + 1
    whole = np.zeros((3 * count, 3 * count))
    at = lambda j: slice(3 * (j - first), 3 * (j - first) + 3)  # noqa: E731
    for j in range(first, last + 1):
        block = rng.normal(size=(3, 3)) + 12 * np.eye(3)
        D[:, j], whole[at(j), at(j)] = block.ravel(), block
    for j in range(first, last):  # column j + 1 of B joins j and j + 1
        joined = rng.normal(size=(3, 3))
        B[:, j + 1] = joined.ravel()
        e[j] = bending * rng.normal()
        whole[at(j), at(j + 1)] = whole[at(j + 1), at(j)] = e[j] * np.eye(3) - joined
    B[:, last + 1] = 0.0
    for j in range(first, last - 1):
        f[j] = bending * rng.normal()
        whole[at(j), at(j + 2)] = whole[at(j + 2), at(j)] = f[j] * np.eye(3)
    dense = np.linalg.solve(whole, r[:, first : last + 1].T.ravel())
    return D, B, e, f, r, dense.reshape(-1, 3).T


def rows_of(e, f):
    rows = np.zeros((max(band.NEXT, band.OVERNEXT) + 1, WIDTH))
    rows[band.NEXT], rows[band.OVERNEXT] = e, f
    return rows


@pytest.mark.parametrize("first, last", [(1, 1), (1, 2), (1, 3), (2, 9), (0, 12)])
@pytest.mark.parametrize("in_place", [True, False])
def test_a_chain_of_nodes_is_solved_as_its_dense_equations(first, last, in_place):
    D, B, _, _, r, wanted = equations(first, last, 0.0)
    pivots, x = np.zeros((WIDTH, 27)), np.zeros((3, WIDTH))
    blocks.factor(D, B, pivots, first, last)
    out = r if in_place else x
    blocks.substitute(pivots, r, out, first, last)
    assert out[:, first : last + 1] == pytest.approx(wanted, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("first, last", [(1, 1), (1, 2), (1, 3), (1, 4), (2, 9), (0, 12)])
@pytest.mark.parametrize("in_place", [True, False])
def test_a_chain_that_bends_is_solved_as_its_dense_equations(first, last, in_place):
    """Joined to the next and to the next but one"""
    D, B, e, f, r, wanted = equations(first, last, 1.0)
    pivots, x, rows = np.zeros((WIDTH, band.OF_BAND)), np.zeros((3, WIDTH)), rows_of(e, f)
    band.factor_band(D, B, rows, pivots, first, last)
    out = r if in_place else x
    band.substitute_band(pivots, rows, r, out, first, last)
    assert out[:, first : last + 1] == pytest.approx(wanted, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("bends", [True, False])
def test_inner_nodes_of_a_line_are_solved_with_or_without_bending(bends, monkeypatch):
    """From node 1 to the last but one"""
    monkeypatch.setattr(band, "bends", lambda rows: bends)
    D, B, e, f, r, wanted = equations(1, 7, float(bends))
    pivots, rows = np.zeros((WIDTH, band.OF_BAND if bends else 27)), rows_of(e, f)
    band.factor_line(D, B, rows, pivots, 8)
    band.substitute_line(pivots, rows, r, r, 8)
    assert r[:, 1:8] == pytest.approx(wanted, rel=1e-9, abs=1e-12)


def test_blocks_of_nine_numbers_are_matrices():
    rng = np.random.default_rng(3)
    a, b = rng.normal(size=(2, 3, 3))
    a += 4 * np.eye(3)
    nine = tuple(a.ravel()), tuple(b.ravel())
    assert blocks.inverse(nine[0]) == pytest.approx(tuple(np.linalg.inv(a).ravel()))
    assert blocks.product(*nine) == pytest.approx(tuple((a @ b).ravel()))
    assert blocks.difference(*nine) == pytest.approx(tuple((a - b).ravel()))
    assert band.times(2.5, nine[0]) == pytest.approx(tuple(2.5 * a.ravel()))
    assert band.beside(2.5, nine[1]) == pytest.approx(tuple((2.5 * np.eye(3) - b).ravel()))
    assert band.applied(np.append(7.0, a.ravel()), 1, 1.0, -2.0, 3.0) == pytest.approx(tuple(a @ [1.0, -2.0, 3.0]))
