"""Wave part of near blocks beside the rows of `bem.panels.wave_influence`, which evaluate each direction by itself."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

from hakobune.bem.green.tables import wave_table
from hakobune.bem.panels.compressed.near_blocks import Panels, near_waves, shares
from hakobune.bem.panels.compressed.operator import Tree
from hakobune.bem.panels.influence import Geometry
from hakobune.bem.panels.wave_influence import Pairs, Sources
from hakobune.bem.waves import depth_values, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import PanelMesh
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


@pytest.mark.parametrize("k, depth", [(0.3, 9.0), (3.0, np.inf)])
def test_pairs_are_at_the_nodes_or_at_the_fine_points_of_a_panel_whose_image_is_close(k, depth, monkeypatch):
    """Of a made-up G = (1 + R) (1 + Z Z′): ΣwG and Σw ∂G/∂n of either direction, K G on the lid; as plain Python

    Panels longer than 2.2/k are fine everywhere, others where their surface image is within their size."""
    near, op, influence = (plain(f"bem.panels.{name}") for name in (
        "compressed.near_blocks", "compressed.operator", "influence"))  # fmt: skip
    monkeypatch.setattr(near, "table_view", lambda table: None)
    monkeypatch.setattr(near, "table_position", lambda R, depths, view: (0, 0, 0, 0.0, 0.0, 0.0))

    def standing(position, R, depths, wave, slope, slope_back, view):
        return (1 + R) * (1 + wave), 1 + wave, (1 + R) * slope, (1 + R) * slope_back

    monkeypatch.setattr(near, "standing_part_at", standing)
    top = PanelMesh(np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], float), [[0, 1, 2, 3]], "x")
    g = influence.Geometry(box(4, 2, 1.0, counts=(1, 1, 1), symmetry="x"), top, depth)
    tree, table = op.Tree(g), SimpleNamespace(C=0.7, K=0.4, k=k)
    e, rule, n = tree.elements, tree.quadrature, len(tree.nodes)
    values = lambda z: np.stack([np.exp(0.3 * z), 0.3 * np.exp(0.3 * z)], axis=-1)  # noqa: E731
    panels = near.Panels.of(e, rule, tree.hull, table, depth, values)
    found = whole(tree, lambda own, share: near.near_waves(own, share, g.images, panels, table))
    assert np.isfinite(found).all() and not tree.hull.all()

    def pair(at, points, normal):
        """G and ∂G/∂n of points (q, 3) seen from one"""
        d = points - at
        R = np.hypot(d[:, 0], d[:, 1])
        wave, slope = 0.7 * values(at[2])[0] * values(points[:, 2]).T
        along = (normal[0] * d[:, 0] + normal[1] * d[:, 1]) / np.maximum(R, 1e-300)
        return (1 + R) * (1 + wave), (1 + wave) * along + (1 + R) * slope * normal[2]

    seen, kinds = 4, set()  # points of the coarse rule come first
    for m, image in enumerate(g.images):
        mirror = np.array([*image, 1.0])
        for b in range(n // 4):
            own, normal = slice(4 * b, 4 * b + 4), e.axes[b, 2] * mirror
            for i in range(n):
                apart = np.linalg.norm(e.nodes[i] * [1, 1, -1] - e.origins[b] * mirror)
                fine = e.sizes[b] > 2.2 / k or apart < e.sizes[b]
                kinds.add(bool(fine))
                if fine:
                    G, slope = pair(e.nodes[i], rule.points[b, seen:] * mirror, normal)
                    parts = [(rule.weights[b, seen:] * part) @ rule.shape[b, seen:] for part in (G, slope)]
                else:
                    parts = [e.weights[own] * part for part in pair(e.nodes[i], e.nodes[own] * mirror, normal)]
                if not tree.hull[4 * b]:
                    parts[1] = 0.4 * parts[0]
                assert found[0, i, m, own] == pytest.approx(parts[0], rel=1e-10)
                assert found[1, i, m, own] == pytest.approx(parts[1], rel=1e-10, abs=1e-12)
    assert kinds == ({True, False} if k < 1 else {True})
