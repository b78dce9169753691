"""Wave part of near blocks beside the rows of `bem.panels.wave_influence`, which evaluate each direction by itself."""

import numpy as np
import pytest

from hakobune.bem.green.tables import wave_table
from hakobune.bem.panels.compressed.near_blocks import Panels, near_waves, shares
from hakobune.bem.panels.compressed.operator import Tree
from hakobune.bem.panels.influence import Geometry
from hakobune.bem.panels.wave_influence import Pairs, Sources
from hakobune.bem.waves import depth_values, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

G = 9.80665
HULL = box(40, 20, 6, panels=200)


def whole(tree, evaluate):
    """Blocks of all leaves in one array (targets, images, sources) of both layers, NaN where nothing was put"""
    n, images = len(tree.nodes), len(tree.geometry.images)
    out = np.full((2, n, images, n), np.nan)
    for (leaf, _), share in zip(tree.neighbours, tree.shares, strict=True):
        own = tree.span(leaf)
        S, D, S_back, D_back = evaluate(own, share)
        for other, columns, *_ in share.blocks:
            its, m = tree.span(tree.neighbours[other][0]), share.images[columns.start]
            assert np.isnan(out[:, own, m, its]).all()  # nothing is put twice
            out[:, own, m, its] = S[:, columns], D[:, columns]
            if columns.stop <= share.both:
                assert np.isnan(out[:, its, m, own]).all()
                out[:, its, m, own] = S_back[:, columns].T, D_back[:, columns].T
    return out


@pytest.mark.parametrize("omega, depth", [(0.8, 12.0), (0.8, np.inf), (3.0, 12.0)])
def test_blocks_are_those_of_each_direction_by_itself(omega, depth):
    """With a lid, close images in the surface and, at 3 rad/s, panels longer than the waves, in deep water too"""
    g = Geometry(HULL, lid(HULL), depth)
    tree, k = Tree(g), wavenumber(omega, depth, G)
    table, of_depth = wave_table(omega, depth, G, g.reach, g.draft), depth_values(k, depth)
    panels = Panels.of(tree.elements, tree.quadrature, tree.hull, table, depth, of_depth)
    found = whole(tree, lambda own, share: near_waves(own, share, g.images, panels, table))
    e, n = tree.elements, len(tree.nodes)
    sources, one = Sources.of(np.arange(n), 4), np.ones((1, 1))
    for m, image in enumerate(g.images):
        rest = e.axes[:, 2].copy(), e.origins, e.sizes, tree.quadrature, image[None], one, depth
        S, D = (part[0].real for part in Pairs(e.nodes, sources, *rest).blocks(table, of_depth))
        D = np.where(tree.hull, D, table.K * S)
        for own, part in zip(found[:, :, m], (S, D), strict=True):
            near = np.isfinite(own)
            assert near.any() and np.abs(own - part)[near].max() < 1e-11 * np.abs(part[near]).max()
    count = tree.per_panel * (tree.clusters.end - tree.clusters.first)
    assert np.isfinite(found[0]).sum() == count[tree.near[:, 0]] @ count[tree.near[:, 1]]


def test_the_first_leaf_of_a_pair_evaluates_both_directions_and_each_its_own_of_a_block_without_transpose():
    spans = {5: slice(0, 4), 2: slice(4, 12), 3: slice(12, 16)}
    near = np.array([[5, 2, 0], [2, 5, 0], [5, 5, 0], [3, 5, 1], [2, 2, 1], [5, 5, 1], [5, 3, 0], [3, 5, 0]])
    first, second, third = shares(spans, near)
    assert first.nodes.tolist() == [*range(4, 12), *range(12, 16), *range(4), *range(4)]
    assert first.images.tolist() == [0] * 16 + [1] * 4 and first.both == 12
    # of leaf 5 the columns are those of 2, 3 and 5 with image 0, then of 5 with image 1
    assert first.blocks == [
        (1, slice(0, 8), 0, 0), (2, slice(8, 12), 8, 0), (0, slice(12, 16), 12, 12), (0, slice(16, 20), 16, 16),
    ]  # fmt: skip
    assert second.both == 0 and second.blocks == [(1, slice(0, 8), 4, 4)]
    assert third.both == 0 and third.blocks == [(0, slice(0, 4), 4, None)] and third.nodes.tolist() == [0, 1, 2, 3]
