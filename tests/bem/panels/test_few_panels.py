"""Influence matrices of three panels and one of a lid, as plain Python, against sums over images one by one.

G of a pair and its gradient are those of `green`, which other tests hold against integrals; panels near their image in
the surface take finer points, the others their nodes.
"""

import numpy as np
import pytest
from plain import plain

from hakobune.bem.green.finite_depth import green
from hakobune.bem.green.tables import wave_table
from hakobune.bem.waves import depth_values
from hakobune.meshing.panels import PanelMesh

GRAVITY = 9.80665
influence, pairs, blocks, far, memory = (
    plain(f"bem.{name}")
    for name in (
        "panels.influence", "panels.reciprocal_pairs", "panels.wave_influence", "panels.compressed.far_blocks",
        "time_domain.memory_kernels",
    )
)  # fmt: skip
POINTS = np.array([[1, 0.2, -2], [3, 0.2, -2], [3, 1, -2], [1, 1, -2], [3, 0.2, -0.1], [3, 1, -0.1], [1, 0.2, -6],
                   [1, 1, -6]], float)  # fmt: skip
LID = PanelMesh(np.array([[0.5, 0.2, 0], [1.5, 0.2, 0], [1.5, 1, 0], [0.5, 1, 0]], float), [[0, 1, 2, 3]], "x")


def geometry(depth, symmetry="x", lid=None, count=3):
    corners = np.array([[0, 3, 2, 1], [1, 2, 5, 4], [0, 6, 7, 3]])[:count]
    return influence.Geometry(PanelMesh(POINTS, corners, symmetry), lid, depth)


def waves(at, source, normal, omega, depth):
    """G less 1/r, 1/r₁ and 1/r₂, and its derivative along the normal at the source: the mean of two places beside it"""
    beside = [_waves(at, source + side * np.array([1e-4, 0, 0]), normal, omega, depth) for side in (-1, 1)]
    return (0.5 * (one + other) for one, other in zip(*beside, strict=True))


def _waves(at, source, normal, omega, depth):
    d = source - at
    R = np.hypot(d[..., 0], d[..., 1])
    value, radial, vertical = green(R, source[..., 2], np.broadcast_to(at[..., 2], R.shape), omega, depth, GRAVITY)
    slope = (normal[..., 0] * d[..., 0] + normal[..., 1] * d[..., 1]) / np.maximum(R, 1e-300)
    derivative = radial * slope + vertical * normal[..., 2]
    for mirror, shift in ((1, 0), (-1, 0)) + (((-1, -2 * depth),) if np.isfinite(depth) else ()):
        own = d.copy()
        own[..., 2] = source[..., 2] - mirror * at[..., 2] - shift
        r = np.linalg.norm(own, axis=-1)
        value = value - 1 / r
        derivative = derivative + np.sum(own * normal, axis=-1) / r**3
    return value, derivative


def summed(g, omega, table):
    """S and D (classes, n, n): the close panels by their fine points, of whose waves the imaginary part is at nodes"""
    e, n = g.elements, len(g.elements.nodes)
    S, D = np.zeros((2, len(g.classes), n, n), complex)
    length = min(1 / table.k, g.depth)

    def at_points(at, sources, normal):
        return waves(at[:, None], sources[None], np.broadcast_to(normal, (1, len(sources), 3)), omega, g.depth)

    for b, center in enumerate(e.origins):
        own, short = slice(4 * b, 4 * b + 4), e.sizes[b] > 2.2 * length
        points, weights, shape = (part[b][4:] for part in g.quadrature)
        for m, image in enumerate(g.images):
            mirror = np.array([*image, 1])
            near = short | (np.linalg.norm(e.nodes * [1, 1, -1] - center * mirror, axis=1) < e.sizes[b])
            s, d = (e.weights[own] * one for one in at_points(e.nodes, e.nodes[own] * mirror, e.axes[b, 2] * mirror))
            if near.any():
                fine = at_points(e.nodes[near], points * mirror, e.axes[b, 2] * mirror)
                for whole, part in zip((s, d), ((weights * one) @ shape for one in fine), strict=True):
                    whole[near] = part if short else part.real + 1j * whole[near].imag
            for c in range(len(g.classes)):
                S[c, :, own] += g.all_signs[c, m] * s
                D[c, :, own] += g.all_signs[c, m] * d
    return S, D


CASES = [(20.0, "x", 0.6, LID, 2), (np.inf, "xy", 1.1, None, 3), (7.0, "", 2.6, None, 3), (9.0, "y", 0.9, None, 2)]


@pytest.mark.parametrize("depth, symmetry, omega, lid, count", CASES)
def test_waves_of_panels_are_sums_over_nodes_or_fine_points_of_all_images(depth, symmetry, omega, lid, count):
    g = geometry(depth, symmetry, lid, count)
    table = wave_table(omega, depth, GRAVITY, g.reach, g.draft)
    Z, n = depth_values(table.k, depth), len(g.elements.nodes)
    S, D = summed(g, omega, table)
    single, double = blocks.wave_blocks(g, np.arange(n), np.arange(n), table, Z)
    for ours, true in ((single, S), (double, D)):
        assert np.abs(ours - true).max() < 1e-6 * np.abs(true).max()
    real = np.zeros((2, *S.shape))
    pairs.add_wave_part(g, g.classes, table, Z, *real)
    for ours, true in zip(real, (S, D), strict=True):
        assert np.abs(ours - true.real).max() < 1e-6 * np.abs(true).max()
    some = np.array([1, 2, 7]), np.array([0, 3, 4, 6, 7])  # a part of the panels' nodes
    for ours, true in zip(blocks.wave_blocks(g, *some, table, Z, g.classes[-1:]), (S, D), strict=True):
        assert np.abs(ours[0] - true[-1][np.ix_(*some)]).max() < 1e-6 * np.abs(true).max()


@pytest.mark.parametrize("depth", [7.0, np.inf])
def test_rankine_integrals_are_those_of_fine_quadrature(depth):
    """∬ N/r and ∬ N ∂(1/r)/∂n of the shape functions N, of 1/r and its image in the bed, and of that in the surface"""
    from hakobune.bem.panels.elements import quadrature

    g = geometry(depth, "x")
    e = g.elements
    at = np.array([[2.0, 0.6, -2.9], [-2.0, 3.0, -1.0], [14.0, -2.0, -3.0], [2.0, 40.0, -5.0], [0.3, 0.5, -4.0]])
    whole = g.rankine_rows(at)
    rule = quadrature(g.panels, e, 60)
    true = np.zeros_like(np.array(whole))
    for m, image in enumerate(g.images):
        mirror = np.array([*image, 1])
        points, normals = rule.points * mirror, (e.axes[:, 2] * mirror)[:, None]
        for kind, (flip, shift) in enumerate(((1, 0.0), (-1, -2 * depth), (-1, 0.0))):
            if np.isfinite(shift):
                from_ = at * [1, 1, flip] + [0, 0, shift]
                d = from_[:, None, None] - points
                r = np.linalg.norm(d, axis=-1)
                parts = [1 / r, np.sum(d * normals, axis=-1) / r**3]
                for row, part in enumerate(parts):
                    own = np.einsum("iaq,aq,aqp->iap", part, rule.weights, rule.shape).reshape(len(at), -1)
                    for c in range(len(g.classes)):
                        true[row, c] += g.all_signs[c, m] * own
                        true[row + 2, c] += g.all_signs[c, m] * own * (kind == 2)
    for ours, exact in zip(whole, true, strict=True):
        assert np.abs(ours - exact).max() < 1e-5 * np.abs(true[:2]).max()


def test_far_panels_are_sums_over_their_nodes_and_near_ones_exact():
    """Beyond five sizes the four nodes stand for a panel: 1e-6 off, and so it is told apart"""
    g = geometry(np.inf, "")
    e = g.elements
    for share, by_nodes in ((4.9, False), (5.1, True)):
        at = (e.origins[0] + share * e.sizes[0] * np.array([0.6, 0.64, -0.48]))[None]
        s = g.rankine_rows(at)[0][0, 0, :4] - g.rankine_rows(at)[2][0, 0, :4]
        nodes = e.weights[:4] / np.linalg.norm(at - e.nodes[:4], axis=1)
        assert bool(np.abs(s - nodes).max() < 1e-13) is by_nodes


@pytest.mark.parametrize("layer", [0, 1])
@pytest.mark.parametrize("mirror, depth", [(1.0, 9.0), (1.0, np.inf), (-0.5, 9.0)])
def test_an_entry_of_a_far_block_is_the_real_layer_of_the_points_of_a_node(layer, mirror, depth):
    """ΣG and Σ∂G/∂n of two points of one node and one of the next; a node of the lid has K times the single layer"""
    omega = 0.8
    table = wave_table(omega, depth, GRAVITY, 30.0, 6.0)
    Z = depth_values(table.k, depth)
    points = np.array([[4.0, 1.0, -2.0], [5.0, 2.0, -1.0], [6.0, -1.0, -4.0]])
    normals = np.array([[0.6, 0.0, -0.8], [0.0, 1.0, 0.0], [0.48, 0.64, 0.6]])
    weights, at = np.array([0.5, 2.0, 3.0]), np.array([-3.0, 2.0, -3.0])
    for hull in (True, False):
        sources = far.Sources(np.array([0, 2, 3]), points, normals, weights, Z(points[:, 2]), np.array([hull, True]))
        bed = bool(np.isfinite(depth))
        water = far.Water(table, mirror, bed, -2 * depth if bed else 0.0)
        value, slope = waves(at, points, normals, omega, depth)
        for flip, shift, factor in ((1, 0.0, 1.0), (-1, 0.0, mirror), (-1, -2 * depth, 1.0)):
            if np.isfinite(shift):
                d = points - (at * [1, 1, flip] + [0, 0, shift])
                r = np.linalg.norm(d, axis=1)
                value, slope = value + factor / r, slope - factor * np.sum(d * normals, axis=1) / r**3
        view = plain("bem.green.finite_depth").table_view(table)
        nodes, workspace = np.array([[0, 0, -9.0], at * [-1, 1, 1]]), (np.zeros((3, 3), int), np.zeros((3, 5)))
        given = -1.0, 1.0, nodes, Z(nodes[:, 2])[:, 0], sources, water, view, *workspace
        for j, own in ((0, slice(0, 2)), (1, slice(2, 3))):
            on_hull = hull or j
            part = slope if layer and on_hull else value
            whole = np.sum(weights[own] * part[own]) * (table.K if layer and not on_hull else 1.0)
            true = pytest.approx(whole.real, abs=1e-6 * abs(whole))
            far._line(1, 0, 0, 1, 3, *given)  # the point and all sources
            assert far._summed(j, 0, sources, table.K, workspace[1])[1 - layer] == true
            ours = 0.0
            for q in range(*sources.first[j : j + 2]):  # each source and the point
                far._line(1, 1, q, 0, 1, *given)
                ours += far._layer(0, not layer, on_hull, table.K, workspace[1])
            assert ours == true


@pytest.mark.parametrize("body", [0, 1])
def test_rate_and_force_of_the_memory_of_several_bodies(body):
    """ẋ = a x + Σ b v over the bodies, of which the first writes; y = c x of one"""
    from types import SimpleNamespace

    rng = np.random.default_rng(4)
    decay, turn = np.array([0.3, 0.5, 0.7, 0.2, 0.4, 0.2, 0.4]), np.array([1.1, 1.7])
    into, out = rng.normal(size=(2, 12, 7))
    arrays = SimpleNamespace(decay=decay, turn=turn, input=into, output=out)
    states, velocity, rate, force = rng.normal(size=7), rng.normal(size=12), np.full(7, 9.0), np.zeros(6)
    for b in range(body + 1):
        memory.memory_rate(arrays, states, velocity[6 * b : 6 * b + 6], rate, b)
    memory.memory_force(arrays, states, force, body)
    expected = -decay * states + into[: 6 * body + 6].T @ velocity[: 6 * body + 6]
    expected[3:5] += turn * states[5:]
    expected[5:] -= turn * states[3:5]
    assert rate == pytest.approx(expected) and force == pytest.approx(out[6 * body : 6 * body + 6] @ states)


@pytest.mark.parametrize("mirror, per_panel, rows", [(1.0, 4, 256), (-1.0, 4, 256), (1.0, 1, 256), (1.0, 1, 2)])
def test_equations_are_those_of_hull_and_lid(mirror, per_panel, rows, monkeypatch):
    """hull 2πφ − Dφ − K S φ' = −S V, lid 4πφ' + K S φ' + Dφ = S V, with 1/r₁ times `mirror`; A + iUVᵀ and b; in
    whatever number of rows at once"""
    omega, depth = 0.6, 20.0
    monkeypatch.setattr(influence, "ROWS", rows)
    corners = [[0, 3, 2, 1], [1, 2, 5, 4]]
    g = influence.Geometry(PanelMesh(POINTS, corners, "x"), LID, depth, per_panel)
    table = wave_table(omega, depth, GRAVITY, g.reach, g.draft)
    Z, n = depth_values(table.k, depth), len(g.elements.nodes)
    rng = np.random.default_rng(6)
    velocities = [rng.normal(size=(2, g.hull)), rng.normal(size=(1, g.hull))]
    found = influence.assembled(g, g.classes, mirror, table, Z, velocities)
    S, D = influence.layers(g, np.arange(n), g.classes, mirror, table, Z)
    on_hull = np.arange(n) < g.hull
    assert g.hull == 2 * per_panel and n == 3 * per_panel
    for c, V in enumerate(velocities):
        A = np.where(on_hull, D[c], table.K * S[c])
        A[on_hull] *= -1
        A += np.diag(np.where(on_hull, 2 * np.pi, 4 * np.pi))
        b = np.where(on_hull, -1.0, 1.0)[:, None] * (S[c][:, on_hull] @ V.T)
        ours = found.matrices[c] + 1j * found.from_waves[c] @ found.to_waves[c].T
        assert np.abs(ours - A).max() < 1e-6 * np.abs(A).max()
        assert np.abs(found.sides[c][:, : len(V)] - b).max() < 1e-6 * np.abs(b).max()
    assert not found.sides[1][:, 1].any()
    whole, one = influence.rankine_of_panels(g.elements.nodes, g.elements, g.images, g.all_signs, depth), g.rankine
    assert all(np.array_equal(a, b) for a, b in zip(whole, one, strict=True))
    assert np.array_equal(g.rankine_of(np.array([1, 0]))[0], g.rankine[0][:, [1, 0]])
    bare = g.without_lid
    assert bare.larger is g and bare.without_lid is bare and len(bare.elements.nodes) == g.hull
    assert np.array_equal(bare.rankine[3], g.rankine[3][:, : g.hull, : g.hull])
    assert np.shares_memory(bare.rankine[0], g.rankine[0])  # nothing is computed twice


def test_motions_belong_to_the_class_of_their_parity_and_shapes_to_that_of_theirs():
    """Even and odd in x: surge, pitch and yaw are odd; a shape u_z = x² even, x odd, x² + x neither"""
    from types import SimpleNamespace

    from hakobune.bem.modes import Mode

    def shape(f):
        return SimpleNamespace(displacement=lambda p: np.stack([0 * p[..., 0], 0 * p[..., 0], f(p[..., 0])], axis=-1))

    even, odd = Mode("even", shape=shape(lambda x: x**2)), Mode("odd", shape=shape(lambda x: x))
    mesh = PanelMesh(POINTS, [[0, 3, 2, 1], [1, 2, 5, 4]], "x")
    g = influence.Geometry(mesh, None, 20.0, modes=(even, odd))
    assert g.classes == ((1, 1), (-1, 1))
    assert g.members((1, 1)) == [1, 2, 3, 6] and g.members((-1, 1)) == [0, 4, 5, 7]
    points, normals = g.elements.nodes, g.elements.normals
    assert g.modes.shape == (8, 8)
    assert g.modes[:, 6] == pytest.approx(points[:, 0] ** 2 * normals[:, 2]) and g.modes[:, :3] == pytest.approx(
        normals
    )
    assert g.modes[:, 3:6] == pytest.approx(np.cross(points, normals))
    both = influence.Geometry(mesh, None, 20.0, modes=(Mode("bent", shape=shape(lambda x: x**2 + x)),))
    with pytest.raises(ValueError, match="bent is not symmetric about x; allowed: a mesh without that plane"):
        both.members((1, 1))
    walled = influence.Geometry(mesh, None, 20.0, wall=4.0)
    assert walled.origin.tolist() == [0.0, -4.0, 0.0] and walled.classes == ((1, 1), (-1, 1))
    assert walled.members((1, 1)) == [1, 2, 3] and walled.copies == 2 and len(walled.images) == 4
    assert walled.modes[:, 3:] == pytest.approx(g.modes[:, 3:6])  # about its own origin, not the wall's
    assert walled.radius == pytest.approx(np.hypot(3.0, 1.0))


def test_a_lid_is_needed_from_the_first_irregular_frequency_on():
    mesh = PanelMesh(POINTS, [[0, 3, 2, 1], [1, 2, 5, 4]], "x")
    g = influence.Geometry(mesh, LID, 20.0)
    assert g.at(1.001 * g.lid_from) is g and g.at(0.999 * g.lid_from) is g.without_lid
    assert influence.Geometry(mesh, None, 20.0).lid_from == np.inf
