"""Blocks of low rank of a kernel that is made up, 1/r of points far apart, as plain Python."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

TARGETS, SOURCES, APART = 24, 30, np.array([4.0, 1.0, 0.5])
POINTS = np.random.default_rng(3).uniform(0, 1, (TARGETS + SOURCES, 3)) * [1, 1, -1]


@pytest.fixture
def block(monkeypatch):
    """block(factor, tolerance) : U V and its rank, of factor/r"""
    far = plain("bem.panels.compressed.far_blocks")

    def call(factor, tolerance):
        def entry(x, y, z, at_depth, j, sources, *_):
            return complex(factor / np.linalg.norm(np.array([x, y, z]) - sources[j]))

        monkeypatch.setattr(far, "_entry", entry)
        monkeypatch.setattr(far, "table_view", lambda table: None)
        blocks = np.array([[0, TARGETS, 0, SOURCES, 1, 1]])
        nodes, sources = POINTS[:TARGETS], POINTS[TARGETS:] + APART
        ((U, V),) = far.low_rank_blocks(
            blocks, nodes, np.ones(TARGETS), sources, SimpleNamespace(table=None), 0, tolerance
        )
        return U @ V, U.shape[1]

    return call


EXACT = 1 / np.linalg.norm(POINTS[:TARGETS, None] - POINTS[TARGETS:] - APART, axis=2)


@pytest.mark.parametrize("factor", [1.0, 1e-4, 1e4, 1e-4j, 1e4j, 3 - 4j])
def test_terms_are_as_many_as_the_error_asks_whatever_the_unit_and_phase(block, factor):
    """Root mean square within the tolerance, by at most three terms more than singular values need (Eckart, Young)"""
    for share in (1e-3, 1e-6):
        found, rank = block(factor, share * abs(factor))
        error = np.sqrt(np.mean(np.abs(found - factor * EXACT) ** 2))
        assert error < share * abs(factor)
        left = np.sqrt(np.cumsum(np.linalg.svd(EXACT, compute_uv=False)[::-1] ** 2)[::-1])
        fewest = np.sum(left > share * np.sqrt(EXACT.size))
        assert fewest <= rank <= fewest + 3
        assert rank == block(1.0, share)[1]
