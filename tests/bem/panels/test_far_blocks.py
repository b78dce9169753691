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


@pytest.mark.parametrize("factor", [1.0, 1e-4, 1e4, -1.0, -1e3, 1e-4j, 1e4j, 3 - 4j])
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


def test_blocks_larger_than_the_buffers_are_made_in_larger_ones(block, monkeypatch):
    """The same terms from buffers of ten numbers to begin with"""
    whole, rank = block(1.0, 1e-4)
    far = plain("bem.panels.compressed.far_blocks")
    monkeypatch.setattr(far, "CAPACITY", 10)
    monkeypatch.setattr(far, "ROOM", 1)
    again, same = block(1.0, 1e-4)
    assert same == rank and np.array_equal(again, whole)


@pytest.mark.parametrize("capacity", [150, 5000])
def test_several_blocks_are_made_one_after_the_other_each_with_its_image(monkeypatch, capacity):
    """Parts of the targets, mirrored in x and y, beside each other in buffers that hold one or two of them, or all"""
    far = plain("bem.panels.compressed.far_blocks")
    sources = POINTS[TARGETS:] + APART
    monkeypatch.setattr(far, "_entry", lambda x, y, z, *rest: complex(1 / np.linalg.norm([x, y, z] - sources[rest[1]])))
    monkeypatch.setattr(far, "table_view", lambda table: None)
    monkeypatch.setattr(far, "CAPACITY", capacity)
    monkeypatch.setattr(far, "ROOM", 2)
    blocks = np.array([[0, 10, 0, 30, 1, 1], [10, 24, 5, 20, -1, 1], [3, 20, 20, 30, 1, -1]])
    made = far.low_rank_blocks(
        blocks, POINTS[:TARGETS], np.ones(TARGETS), sources, SimpleNamespace(table=None), 0, 1e-7
    )
    for (low, high, start, end, sx, sy), (U, V) in zip(blocks, made, strict=True):
        at = POINTS[low:high] * [sx, sy, 1]
        exact = 1 / np.linalg.norm(at[:, None] - sources[start:end], axis=2)
        assert np.sqrt(np.mean(np.abs(U @ V - exact) ** 2)) < 1e-7
    assert list(far.low_rank_blocks(blocks[:0], POINTS, None, sources, None, 0, 1e-7)) == []


def test_a_pivot_of_the_size_of_the_tolerance_ends_a_block():
    """‖u v‖ over √(mn) at or below the tolerance eight rows long; rows without anything count too"""
    far = plain("bem.panels.compressed.far_blocks")
    used, values = np.zeros(4, bool), np.array([9, 9, 1 + 1j, -3.0, 2j, 0.0])
    assert far._largest(values, 2, 4, used) == (1, pytest.approx(2 + 9 + 4))
    used[1] = True
    assert far._largest(values, 2, 4, used)[0] == 2 and far._unused(used, 4, 1) == 2 and far._unused(used, 4, 3) == 3
    assert far._largest(np.zeros(4, complex), 0, 4, np.zeros(4, bool)) == (-1, 0.0)
    assert far._unused(np.ones(4, bool), 4, 1) == -1
    buffer, factors = np.arange(12.0) + 0j, np.array([0.0, 2.0, 0.0, 3.0])
    far._subtract(buffer, 3, 3, 2, factors, 1, 2)
    assert buffer[9:].tolist() == [9 - 2 * 3 - 3 * 6, 10 - 2 * 4 - 3 * 7, 11 - 2 * 5 - 3 * 8]
