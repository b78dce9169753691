"""Pieces of compressed equations by hand: sources of far blocks, groups, columns, products of near and far blocks."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels.compressed import operator
from hakobune.bem.panels.compressed.operator import Columns, CompressedEquations, LowRankPart, Tree


def tree_of(sizes, lengths=4):
    """Panels of two nodes: their elements, a coarse rule of four points and a fine one of `lengths`"""
    rng = np.random.default_rng(1)
    n = len(sizes)
    elements = SimpleNamespace(sizes=np.array(sizes), nodes=rng.normal(size=(2 * n, 3)) - [0, 0, 5],
                               weights=rng.uniform(1, 2, 2 * n), normals=rng.normal(size=(2 * n, 3)))  # fmt: skip
    count = 4 + lengths
    points, weights, shape = (
        rng.normal(size=(n, count, 3)),
        rng.uniform(size=(n, count)),
        rng.normal(size=(n, count, 2)),
    )
    quadrature = SimpleNamespace(points=points - [0, 0, 5], weights=weights, shape=shape)
    return SimpleNamespace(elements=elements, quadrature=quadrature, per_panel=2, hull=np.arange(2 * n) < 2 * n - 2,
                           geometry=SimpleNamespace(depth=3.0))  # fmt: skip


def depth_values(z):
    return np.stack([np.exp(z), z], axis=-1)


@pytest.mark.parametrize("k, long", [(2.0, 1.1), (0.1, 6.6), (0.0, 6.6)])
def test_panels_longer_than_two_point_two_of_the_wave_or_the_depth_have_fine_points(k, long):
    """1/k of 0.5 m, or the depth of 3 m: longer than 1.1 or 6.6 m; weights are those of the shape functions"""
    tree = tree_of([0.99 * long, 1.01 * long, 0.5 * long])
    equations = SimpleNamespace(tree=tree, arguments=(SimpleNamespace(k=k), 1.0, depth_values))
    found, e, q = CompressedEquations.sources.func(equations), tree.elements, tree.quadrature
    assert found.first.tolist() == [0, 1, 2, 6, 10, 11, 12] and np.array_equal(found.hull, tree.hull)
    node = np.repeat(np.arange(6), np.diff(found.first))
    assert np.array_equal(found.normals, e.normals[node]) and np.array_equal(
        found.depth_z, depth_values(found.points[:, 2])
    )
    for i in (0, 1, 4, 5):
        at = found.first[i]
        assert np.array_equal(found.points[at], e.nodes[i]) and found.weights[at] == e.weights[i]
    for i, corner in ((2, 0), (3, 1)):
        own = slice(found.first[i], found.first[i + 1])
        assert np.array_equal(found.points[own], q.points[1, 4:])
        assert found.weights[own] == pytest.approx(q.weights[1, 4:] * q.shape[1, 4:, corner])


def test_columns_of_a_class_have_its_signs_on_the_images():
    columns = Columns(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[1, 1], [1, -1]]))
    assert columns.images.tolist() == [[[1, 2], [3, 4]], [[1, -2], [3, -4]]]


def test_numbers_of_equal_keys_are_together_in_the_order_of_the_keys():
    assert operator._groups([(1, 0), (0, 2), (1, 0), (0, 1)]) == [[3], [1], [0, 2]]
    arrays = [np.ones((1, 2)), np.zeros((1, 2)), 2 * np.ones((1, 2))]
    one = operator._stacked(arrays, [2, 0], 0)
    assert one.tolist() == [[2, 2], [1, 1]] and arrays[0] is None and arrays[2] is None and arrays[1] is not None


def blocks(rng, sizes, keys):
    """[(target, source, image, U, V)] of clusters of these sizes, of ranks one, two, …"""
    return [
        (t, s, m, rng.normal(size=(sizes[t], rank)), rng.normal(size=(rank, sizes[s])))
        for rank, (t, s, m) in enumerate(keys, 1)
    ]


KEYS = [(0, 1, 0), (1, 0, 0), (2, 1, 1), (0, 2, 0), (0, 1, 1)]


@pytest.fixture
def far():
    """Far blocks among three clusters of 2, 3 and 4 nodes and two images, as they are and as parts"""
    rng, sizes = np.random.default_rng(2), [2, 3, 4]
    ends = np.cumsum([0, *sizes])
    made = blocks(rng, sizes, KEYS)
    dense = np.zeros((9, 2, 9))
    spans = [slice(ends[i], ends[i + 1]) for i in range(3)]
    for t, s, m, U, V in made:
        dense[spans[t], m, spans[s]] += U @ V
    tree = SimpleNamespace(span=lambda cluster: spans[cluster])
    return LowRankPart.of(made, tree), dense, made, spans


def test_far_blocks_are_kept_by_source_and_by_target(far):
    part, dense, emptied, _ = far
    assert emptied == [] and part.rank == 1 + 2 + 3 + 4 + 5
    x = np.random.default_rng(3).normal(size=(2, 9))
    T = np.concatenate([V @ x[m, span] for m, span, V in part.sources])
    y = np.zeros(9)
    for span, U, places in part.targets:
        y[span] += U @ T[places]
    assert y == pytest.approx(np.einsum("imj,mj->i", dense, x))
    assert [(m, span.start) for m, span, _ in part.sources] == [(0, 0), (0, 2), (0, 5), (1, 2)]
    assert [span.start for span, *_ in part.targets] == [0, 2, 5]


@pytest.mark.parametrize("exactly", [True, False])
def test_products_are_of_near_blocks_far_blocks_and_the_diagonal(far, exactly):
    """side · (near + far + i U Vᵀ) x + diagonal · x, images, U and V of the class of each column"""
    part, dense, _, spans = far
    rng = np.random.default_rng(4)
    near = [(spans[1], np.array([0, 4, 9 + 7]), rng.normal(size=(3, 3)))]
    for span, places, matrix in near:
        for column, place in enumerate(places):
            dense[span, place // 9, place % 9] += matrix[:, column]
    equations = object.__new__(CompressedEquations)
    equations.far, equations.near = part, near
    equations.tree = SimpleNamespace(cells=lambda most: [slice(0, 2), slice(2, 9)])
    equations.of_cells, equations.of_more = equations._by_cells()
    assert [(len(n), len(t)) for n, t in equations.of_cells] == [(0, 1), (1, 2)] and equations.of_more == []
    equations.side, equations.diagonal = np.where(np.arange(9) < 6, -1.0, 1.0)[:, None], rng.uniform(6, 12, (9, 1))
    x, signs = rng.normal(size=(9, 2)) + 1j, np.array([[1, 1], [1, -1]])
    equations.standing = {(1, 1): rng.normal(size=(2, 9, 3)), (1, -1): rng.normal(size=(2, 9, 2))}
    found = equations.apply(Columns(x, signs), exactly)
    for c in range(2):
        images = x[:, c] * signs[:, c][:, None]
        U, V = equations.standing[tuple(signs[:, c])]
        sums = np.einsum("imj,mj->i", dense, images) + 1j * U @ (V.T @ x[:, c])
        true = equations.side[:, 0] * sums + equations.diagonal[:, 0] * x[:, c]
        assert found[:, c] == pytest.approx(true, rel=1e-12 if exactly else 1e-5)
    assert equations.bytes == near[0][2].nbytes + sum(V.nbytes for *_, V in part.sources) + sum(
        U.nbytes for _, U, _ in part.targets
    )
    equations.tree = SimpleNamespace(cells=lambda most: [slice(0, 2), slice(2, 4), slice(4, 9)])
    cells, more = equations._by_cells()  # the second cluster reaches over two of them
    assert [(len(n), len(t)) for n, t in cells] == [(0, 1), (0, 0), (0, 1)] and [b[0].start for b in more] == [2, 2]


def test_cells_are_clusters_that_cover_all_nodes_once():
    """A tree of eight panels halved three times, four nodes a panel: at most so many, the smallest there are"""
    first, end, children = [0], [8], [(-1, -1)]
    for k in range(7):
        low, high = first[k], end[k]
        if high - low > 2:
            children[k] = (len(first), len(first) + 1)
            first += [low, (low + high) // 2]
            end += [(low + high) // 2, high]
            children += [(-1, -1)] * 2
    tree = SimpleNamespace(
        clusters=SimpleNamespace(first=np.array(first), end=np.array(end), children=np.array(children)), per_panel=4
    )
    tree.span = lambda cluster: Tree.span(tree, cluster)
    for most, count in ((4, 4), (3, 2), (2, 2), (1, 1), (99, 4)):
        cells = Tree.cells(tree, most)
        assert len(cells) == count
        assert np.concatenate([np.arange(32)[cell] for cell in cells]).tolist() == list(range(32))


def test_far_blocks_are_divided_so_that_every_part_has_large_and_small_ones():
    equations = SimpleNamespace(tree=SimpleNamespace(far=np.arange(40).reshape(-1, 1)))
    parts = CompressedEquations._parts(equations)
    assert len(parts) == 16 and parts[3].ravel().tolist() == [3, 19, 35]
    assert sorted(np.concatenate(parts).ravel().tolist()) == list(range(40))
