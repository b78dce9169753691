"""Blocks of low rank of a kernel that is made up, 1/r of points far apart, as plain Python."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

TARGETS, SOURCES, APART = 24, 30, np.array([4.0, 1.0, 0.5])
POINTS = np.random.default_rng(3).uniform(0, 1, (TARGETS + SOURCES, 3)) * [1, 1, -1]


def point_sources(points):
    """Nodes of a hull that are one source each"""
    return SimpleNamespace(first=np.arange(len(points) + 1), points=points, hull=np.ones(len(points), bool))


SOURCES_OF = point_sources(POINTS[TARGETS:] + APART)


@pytest.fixture
def block(monkeypatch):
    """block(factor, tolerance, of_single) : U V of factor/r, U V_S of of_single/r³ and the rank"""
    far = plain("bem.panels.compressed.far_blocks")

    def call(factor, tolerance, of_single=0.0, single=1.0):
        def line(i, next_point, q, next_source, count, sx, sy, nodes, at_depth, sources, water, view, pieces, values):
            for e in range(count):
                at, source = nodes[i + e * next_point], sources.points[q + e * next_source]
                r = np.linalg.norm(at * [sx, sy, 1] - source)
                values[e, :2] = of_single / r**3, factor / r

        monkeypatch.setattr(far, "_line", line)
        monkeypatch.setattr(far, "table_view", lambda table: None)
        blocks = np.array([[0, TARGETS, 0, SOURCES, 1, 1]])
        water = SimpleNamespace(table=SimpleNamespace(K=0.0))
        ((U, V, V_S),) = far.low_rank_blocks(
            blocks, POINTS[:TARGETS], np.ones(TARGETS), SOURCES_OF, water, single, tolerance
        )
        return U @ V, U.shape[1], U @ V_S

    return call


EXACT = 1 / np.linalg.norm(POINTS[:TARGETS, None] - POINTS[TARGETS:] - APART, axis=2)


@pytest.mark.parametrize("factor", [1.0, 1e-4, 1e4, -1.0, -1e3])
def test_terms_are_as_many_as_the_error_asks_whatever_the_unit_and_sign(block, factor):
    """Root mean square within the tolerance, by at most three terms more than singular values need (Eckart, Young)"""
    for share in (1e-3, 1e-6):
        found, rank, _ = block(factor, share * abs(factor))
        error = np.sqrt(np.mean(np.abs(found - factor * EXACT) ** 2))
        assert error < share * abs(factor)
        left = np.sqrt(np.cumsum(np.linalg.svd(EXACT, compute_uv=False)[::-1] ** 2)[::-1])
        fewest = np.sum(left > share * np.sqrt(EXACT.size))
        assert fewest <= rank <= fewest + 3
        assert rank == block(1.0, share)[1]


@pytest.mark.parametrize("factor", [1.0, 1e-4, 0.0, -30.0])
def test_both_layers_of_a_block_are_as_accurate_as_asked_each(block, factor):
    """1/r³ beside factor/r from the same rows and columns, also where the second has nothing at all"""
    for double, single in ((1e-5, 1e-3), (1e-3, 1e-7), (1e-6, 1e-6)):
        found, _, other = block(factor, double, of_single=1.0, single=single)
        assert np.sqrt(np.mean(np.abs(found - factor * EXACT) ** 2)) < double
        assert np.sqrt(np.mean(np.abs(other - EXACT**3) ** 2)) < single


def test_blocks_larger_than_the_buffers_are_made_in_larger_ones(block, monkeypatch):
    """The same terms from buffers of ten numbers to begin with"""
    whole, rank, _ = block(1.0, 1e-4)
    far = plain("bem.panels.compressed.far_blocks")
    monkeypatch.setattr(far, "CAPACITY", 10)
    monkeypatch.setattr(far, "ROOM", 1)
    again, same, _ = block(1.0, 1e-4)
    assert same == rank and np.array_equal(again, whole)


@pytest.mark.parametrize("capacity", [150, 5000])
def test_several_blocks_are_made_one_after_the_other_each_with_its_image(monkeypatch, capacity):
    """Parts of the targets, mirrored in x and y, beside each other in buffers that hold one or two of them, or all"""
    far = plain("bem.panels.compressed.far_blocks")
    sources = POINTS[TARGETS:] + APART

    def line(i, next_point, q, next_source, count, sx, sy, nodes, *rest):
        for e in range(count):
            values = rest[-1]
            r = np.linalg.norm(nodes[i + e * next_point] * [sx, sy, 1] - sources[q + e * next_source])
            values[e, :2] = 0.0, 1 / r

    monkeypatch.setattr(far, "_line", line)
    monkeypatch.setattr(far, "table_view", lambda table: None)
    monkeypatch.setattr(far, "CAPACITY", capacity)
    monkeypatch.setattr(far, "ROOM", 2)
    blocks = np.array([[0, 10, 0, 30, 1, 1], [10, 24, 5, 20, -1, 1], [3, 20, 20, 30, 1, -1]])
    water = SimpleNamespace(table=SimpleNamespace(K=0.0))
    given = POINTS[:TARGETS], np.ones(TARGETS), point_sources(sources), water, 1.0, 1e-7
    made = far.low_rank_blocks(blocks, *given)
    for (low, high, start, end, sx, sy), (U, V, _) in zip(blocks, made, strict=True):
        at = POINTS[low:high] * [sx, sy, 1]
        exact = 1 / np.linalg.norm(at[:, None] - sources[start:end], axis=2)
        assert np.sqrt(np.mean(np.abs(U @ V - exact) ** 2)) < 1e-7
    assert list(far.low_rank_blocks(blocks[:0], *given)) == []


def test_a_pivot_of_the_size_of_the_tolerance_ends_a_block():
    """‖u v‖ over √(mn) at or below the tolerance eight rows long; rows without anything count too"""
    far = plain("bem.panels.compressed.far_blocks")
    used, values = np.zeros(4, bool), np.array([9, 9, 2**0.5, -3.0, 2.0, 0.0])
    assert far._largest(values, 2, 4, used) == (1, 9.0, pytest.approx(2 + 9 + 4))
    used[1] = True
    assert far._largest(values, 2, 4, used)[0] == 2 and far._unused(used, 4, 1) == 2 and far._unused(used, 4, 3) == 3
    assert far._largest(np.zeros(4), 0, 4, np.zeros(4, bool)) == (-1, 0.0, 0.0)
    assert far._unused(np.ones(4, bool), 4, 1) == -1
    buffer, factors = np.arange(12.0), np.array([0.0, 2.0, 0.0, 3.0])
    far._subtract(buffer, 3, 3, 2, factors, 1, 2)
    assert buffer[9:].tolist() == [9 - 2 * 3 - 3 * 6, 10 - 2 * 4 - 3 * 7, 11 - 2 * 5 - 3 * 8]


@pytest.mark.parametrize("factor, single, ranks", [(1.0, 0.0, [1, 0]), (0.0, 1.0, [1, 0]), (-1.0, 1.0, [1, 0])])
def test_a_row_of_the_size_of_the_tolerance_is_nothing(monkeypatch, factor, single, ranks):
    """Root mean square of a constant block 4 % above what is allowed of either layer, and 4 % below"""
    far = plain("bem.panels.compressed.far_blocks")

    def line(i, next_point, q, next_source, count, *rest):
        rest[-1][:count, 0], rest[-1][:count, 1] = single, factor

    monkeypatch.setattr(far, "_line", line)
    monkeypatch.setattr(far, "table_view", lambda table: None)
    water = SimpleNamespace(table=SimpleNamespace(K=0.0))
    for share, rank in zip((1 / 1.04, 1 / 0.96), ranks, strict=True):
        given = np.array([[0, TARGETS, 0, SOURCES, 1, 1]]), POINTS[:TARGETS], np.ones(TARGETS), SOURCES_OF, water
        ((U, V, V_S),) = far.low_rank_blocks(*given, share, share)
        assert U.shape[1] == rank
        if rank:
            assert np.allclose(U @ V, factor, rtol=1e-9) and np.allclose(U @ V_S, single, rtol=1e-9)


def test_a_node_of_several_sources_has_the_sum_of_what_they_send(monkeypatch):
    """Thirty sources of 1/r at twenty nodes, the lid's times K in the double layer"""
    far = plain("bem.panels.compressed.far_blocks")
    sources = POINTS[TARGETS:] + APART
    first = np.cumsum([0, *([1, 2] * 10)])
    hull = np.arange(20) % 3 > 0

    water = SimpleNamespace(table=SimpleNamespace(K=0.7))
    given, depths = SimpleNamespace(first=first, points=sources, hull=hull), np.ones(TARGETS)

    def line(i, next_point, q, next_source, count, sx, sy, nodes, *rest):
        assert rest[0] is depths and rest[1:4] == (given, water, "view of the table") and (sx, sy) == (1.0, 1.0)
        assert rest[4].shape == (len(rest[5]), 3) and rest[5].shape[1] == 5
        for e in range(count):
            r = np.linalg.norm(nodes[i + e * next_point] - sources[q + e * next_source])
            rest[5][e, :2] = 1 / r, 1 / r**3

    monkeypatch.setattr(far, "_line", line)
    monkeypatch.setattr(far, "table_view", lambda table: "view of the table")
    blocks = np.array([[0, TARGETS, 0, 20, 1, 1], [4, 20, 3, 17, 1, 1]])
    made = far.low_rank_blocks(blocks, POINTS[:TARGETS], depths, given, water, 1e-6, 1e-6)
    r = np.linalg.norm(POINTS[:TARGETS, None] - sources, axis=2)
    single, double = (np.add.reduceat(part, first[:-1], axis=1) for part in (1 / r, 1 / r**3))
    double = np.where(hull, double, 0.7 * single)
    for (low, high, start, end, _, _), (U, V, V_S) in zip(blocks, made, strict=True):
        assert np.sqrt(np.mean(np.abs(U @ V - double[low:high, start:end]) ** 2)) < 1e-6
        assert np.sqrt(np.mean(np.abs(U @ V_S - single[low:high, start:end]) ** 2)) < 1e-6
