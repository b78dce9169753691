"""Clusters far enough apart for a block of low rank, and the iteration, by hand."""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest

from hakobune.bem.panels.compressed.clusters import Clusters
from hakobune.bem.panels.compressed.iteration import gmres


def plate(count, x, z, size):
    """`count` square panels side by side along x, looking down"""
    places = x + size * np.arange(count)
    square = size * np.array([[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]])
    return square + np.stack([places, 0 * places, 0 * places + z], axis=1)[:, None]


def two(gap, size=1.0, z=-50.0, count=4):
    """Two rows of four panels of 1 m that far apart: boxes of 4 x 1 m, of √17 = 4.123 m diagonal"""
    corners = np.concatenate([plate(count, 0.0, z, size), plate(count, count * size + gap, z, size)])
    normals = np.tile([0, 0, -1.0], (2 * count, 1))
    normals[count:, 2] = 1.0  # roots of their own
    return Clusters.of(corners, normals, np.full(2 * count, size), 2 * count)


def test_clusters_are_apart_by_seven_tenths_of_the_larger_diagonal_and_five_panels():
    image = np.ones((1, 2))
    for count, gap, apart in ((4, 4.9, False), (4, 5.1, True), (8, 5.55, False), (8, 5.75, True)):
        found = two(gap, count=count)  # of eight 0.7 √65 = 5.64
        assert bool(found._apart(np.array([0]), np.array([1]), image)[0]) == apart, (count, gap)


def test_a_mirrored_source_is_as_far_as_its_image():
    found = two(20.0)
    low, high = found.low.copy(), found.high.copy()
    low[1, :2], high[1, :2] = [-14.0, -3.0], [-10.0, -2.0]
    other = Clusters(found.order, found.first, found.end, found.children, low, high, found.size, found.roots)
    assert other._apart(np.array([0]), np.array([1]), np.array([[1.0, 1.0]]))[0]
    assert other._apart(np.array([0]), np.array([1]), np.array([[-1.0, -1.0]]))[0]  # 6 m on the other side
    low[1, 0], high[1, 0] = -12.8, -8.8
    near = Clusters(found.order, found.first, found.end, found.children, low, high, found.size, found.roots)
    assert near._apart(np.array([0]), np.array([1]), np.array([[1.0, -1.0]]))[0]
    assert not near._apart(np.array([0]), np.array([1]), np.array([[-1.0, -1.0]]))[0]  # 4.8 m


def test_trees_hold_every_panel_once_in_leaves_of_sixteen_and_have_roots_by_what_they_look_at():
    corners = np.concatenate([plate(40, 0.0, -5.0, 1.0), plate(20, 0.0, -1.0, 1.0), plate(10, 0.0, 0.0, 1.0)])
    normals = np.concatenate(
        [np.tile([0, 0, -1.0], (40, 1)), np.tile([0.1, -1.0, 0], (20, 1)), np.tile([0, 0, 1.0], (10, 1))]
    )
    sizes = np.arange(1.0, 71.0)
    made = Clusters.of(corners, normals, sizes, 60)
    assert len(made.roots) == 3 and sorted(made.order) == list(range(70))
    assert [made.end[r] - made.first[r] for r in made.roots] == [20, 40, 10]  # −y, −z, lid
    leaves = made.leaves
    assert (made.end[leaves] - made.first[leaves]).max() <= 16 and (made.end[leaves] - made.first[leaves]).sum() == 70
    assert np.all(made.first[leaves][1:] == made.end[leaves][:-1])
    for c in range(len(made.first)):
        own = made.order[made.first[c] : made.end[c]]
        assert made.size[c] == sizes[own].max()
        assert made.low[c] == pytest.approx(corners[own].min(axis=(0, 1)))
        assert made.high[c] == pytest.approx(corners[own].max(axis=(0, 1)))
    far, near = made.pairs(np.array([[1, 1], [-1, 1]]))
    count = np.zeros((70, 70, 2), int)
    for t, s, m in np.concatenate([far, near]):
        count[np.ix_(made.order[made.first[t] : made.end[t]], made.order[made.first[s] : made.end[s]], [m])] += 1
    assert np.all(count == 1)


def test_no_cluster_holds_panels_of_two_bodies():
    """Two plates that both look down, 1 m apart in height: seen edge on by one of them, not by the other"""
    corners = np.concatenate([plate(24, 0.0, -5.0, 1.0), plate(24, 0.0, -4.0, 1.0), plate(8, 0.0, 0.0, 1.0)])
    normals = np.tile([0, 0, -1.0], (56, 1))
    body = np.repeat([0, 1], 24)
    made = Clusters.of(corners, normals, np.ones(56), 48, body)
    assert sorted(made.end[r] - made.first[r] for r in made.roots) == [8, 24, 24]
    for first, end in zip(made.first, made.end, strict=True):
        own = made.order[first:end]
        assert len(set(np.append(body, [2] * 8)[own])) == 1


class OfMatrix(NamedTuple):
    values: np.ndarray
    signs: np.ndarray


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_an_iteration_ends_where_its_residual_is_within_the_tolerance(tolerance):
    rng = np.random.default_rng(6)
    A = np.eye(60) + 0.08 * (rng.normal(size=(60, 60)) + 1j * rng.normal(size=(60, 60)))
    b = (rng.normal(size=(60, 3)) + 1j * rng.normal(size=(60, 3))) * [1.0, 1e-3, 1e4]
    asked = []

    def apply(columns, exactly=False):
        asked.append(exactly)
        assert columns.signs.tolist() == [1, -1, 1]
        return A @ columns.values

    rough = np.linalg.inv(A + 0.3 * np.eye(60))
    equations = SimpleNamespace(sides=b, apply=apply)
    x, left = gmres(equations, lambda v, signs: rough @ v, OfMatrix(b, np.array([1, -1, 1])), tolerance, 400)
    residual = (np.abs(A @ x - b).max(axis=0) / np.abs(b).max(axis=0)).max()
    assert left == pytest.approx(residual, rel=1e-6) and residual <= tolerance and asked[-1]
    assert np.abs(x - np.linalg.solve(A, b)).max(axis=0) / np.abs(b).max(axis=0) == pytest.approx(0, abs=30 * tolerance)
    few = gmres(equations, lambda v, signs: v, OfMatrix(b, np.array([1, -1, 1])), 1e-12, 5)[1]
    assert few > 1e-12  # so many iterations were not enough, and it says so
