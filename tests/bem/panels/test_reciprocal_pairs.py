"""Influence matrices from one evaluation of G for both ends of a pair, and of few standing waves, against all pairs."""

from dataclasses import replace

import numpy as np
import pytest
from plain import plain

from hakobune.bem.green.finite_depth import green
from hakobune.bem.green.tables import limit_table, wave_table
from hakobune.bem.panels.influence import Geometry
from hakobune.bem.panels.reciprocal_pairs import add_wave_part
from hakobune.bem.panels.standing_waves import directions, standing_waves
from hakobune.bem.panels.wave_influence import wave_blocks
from hakobune.bem.waves import depth_values
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box


def bodies():
    """Two mirror planes with a lid, one, none in deep water, and before a wall"""
    mesh = box(60, 30, 8, panels=160)
    unfolded = replace(replace(mesh, symmetry="y").whole(), symmetry="x")
    yield Geometry(mesh, lid(mesh, 8.0), 20.0)
    yield Geometry(unfolded, None, 20.0)
    yield Geometry(mesh.whole(), None, np.inf)
    yield Geometry(mesh, None, 12.0, wall=40.0)


@pytest.mark.parametrize("geometry", list(bodies()), ids=["two planes and lid", "one plane", "none, deep", "wall"])
@pytest.mark.parametrize("omega", [0.15, 0.9, 2.5])
def test_real_part_equals_that_of_all_pairs(geometry, omega):
    g, n = geometry, len(geometry.elements.nodes)
    table = wave_table(omega, g.depth, 9.80665, g.reach, g.draft)
    Z, S, D = depth_values(table.k, g.depth), *np.zeros((2, len(g.classes), n, n))
    add_wave_part(g, g.classes, table, Z, S, D)
    single, double = wave_blocks(g, np.arange(n), np.arange(n), table, Z)
    assert np.abs(S - single.real).max() < 1e-12 * np.abs(single).max()
    assert np.abs(D - double.real).max() < 1e-12 * np.abs(double).max()


@pytest.mark.parametrize("which", ["zero", "infinity"])
def test_limits_have_no_waves(which):
    mesh = box(60, 30, 8, panels=160)
    g = Geometry(mesh, None, 20.0)
    table = limit_table(which, g.depth, g.reach, g.draft)
    assert standing_waves(g, g.classes, table, depth_values(0.0, 20.0)).shape[-1] == 0


@pytest.mark.parametrize("geometry", list(bodies()), ids=["two planes and lid", "one plane", "none, deep", "wall"])
@pytest.mark.parametrize("omega", [0.15, 0.9])
def test_standing_waves_are_the_imaginary_part_of_the_green_function(geometry, omega):
    g, e = geometry, geometry.elements
    table = wave_table(omega, g.depth, 9.80665, g.reach, g.draft)
    waves, single, double = standing_waves(g, g.classes, table, depth_values(table.k, g.depth))
    rng = np.random.default_rng(5)
    points, sources = rng.choice(g.hull, 20), rng.choice(len(e.nodes), 20)
    for c in range(len(g.classes)):
        S, D = np.zeros((2, 20))
        for image, sign in zip(g.images, g.all_signs[c], strict=True):
            there = e.nodes[sources] * [*image, 1]
            d = e.nodes[points] - there
            R = np.maximum(np.hypot(d[:, 0], d[:, 1]), 1e-6)
            # ∂/∂ζ by the symmetry of G
            G, by_R, by_zeta = green(R, e.nodes[sources, 2], e.nodes[points, 2], omega, g.depth)
            normals = e.normals[sources] * [*image, 1]
            S += sign * G.imag
            D += sign * (-by_R.imag * np.sum(d[:, :2] * normals[:, :2], axis=1) / R + by_zeta.imag * normals[:, 2])
        ours = [np.sum(waves[c, points] * part[c, sources], axis=1) / e.weights[sources] for part in (single, double)]
        size = table.C * len(g.images)
        assert np.abs(ours[0] - S).max() < 1e-8 * size
        assert np.abs(ours[1] - D).max() < 1e-8 * size * max(table.k, 1.0)


@pytest.mark.parametrize("phase", [0.01, 1.0, 10.0, 300.0])
def test_directions_leave_nothing_of_the_bessel_function(phase):
    from scipy.special import j0

    count = directions(phase)
    theta = (np.arange(count) + 0.5) * (np.pi / 2 / count)
    for x in phase * np.linspace(0, 1, 7):
        for turn in (0.0, 0.7, 1.5):
            found = np.mean(np.cos(x * np.cos(turn) * np.cos(theta)) * np.cos(x * np.sin(turn) * np.sin(theta)))
            assert abs(found - j0(x)) < 1e-12


def test_a_pair_of_nodes_has_both_normal_derivatives_of_one_evaluation(monkeypatch):
    """G, and ∂G/∂n at b and at a: gr ∂R/∂n + ∂ζ n_z, with Z(z) Z(ζ), Z(z) Z′(ζ) and Z′(z) Z(ζ) of the two depths"""
    pairs = plain("bem.panels.reciprocal_pairs")
    rng = np.random.default_rng(8)
    nodes, normals, at = rng.normal(size=(12, 3)), rng.normal(size=(3, 3)), rng.normal(size=(12, 2))
    nodes[:, 2] = -np.arange(1.0, 13.0)
    values, pieces = rng.normal(size=(32, 8)), np.arange(96).reshape(32, 3)
    values[:, 6:] = rng.integers(0, 2, (32, 2))
    asked = []

    def standing_part_at(position, R, depths, wave, slope, slope_back, view):
        asked.append((position, depths))
        return (R + wave, 2 * R, slope, slope_back)

    monkeypatch.setattr(pairs, "standing_part_at", standing_part_at)
    monkeypatch.setattr(pairs, "depth_variables", lambda z, zeta: (z, zeta))
    found, a, b, C, count = np.full((16, 8), 77.0), 2, 1, 3.0, 2
    pairs._evaluate(a, b, nodes, normals, count, at, C, "view", pieces, values, found)
    seen = 0
    for p in range(4):
        for q in range(4):
            i, j = 4 * a + p, 4 * b + q
            for m in range(count):
                e, row, column = (4 * p + q) * count + m, (2 * p + q // 2) * count + m, 4 * (q % 2)
                R, by_b, by_a, *place, there, back = values[e]
                wanted = np.zeros(4)
                if there + back > 0:
                    assert asked[seen] == ((*pieces[e], *place), (nodes[i, 2], nodes[j, 2]))
                    seen += 1
                    g = R + C * at[i, 0] * at[j, 0]
                    flux = 2 * R * by_b + C * at[i, 0] * at[j, 1] * normals[b, 2]
                    flux_back = 2 * R * by_a + C * at[i, 1] * at[j, 0] * normals[a, 2]
                    wanted = np.array([there * g, back * g, there * flux, back * flux_back])
                assert found[row, column : column + 4] == pytest.approx(wanted)
    assert seen == len(asked) > 10


def test_pairs_of_nodes_are_located_for_each_image_and_seen_from_both(monkeypatch):
    """R, ∂R/∂n at either end, the place in the table, and whether the other panel is far enough for its nodes"""
    pairs = plain("bem.panels.reciprocal_pairs")
    rng = np.random.default_rng(9)
    nodes, normals, centers = rng.normal(size=(12, 3)), rng.normal(size=(3, 3)), rng.normal(size=(3, 3))
    nodes[:, 2], centers[:, 2] = -np.arange(0.1, 1.3, 0.1), [-0.2, -0.6, -1.1]
    images, squares = np.array([[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]), np.array([3.0, 6.0, 5.0])
    asked = []

    def table_position(R, depths, view):
        asked.append((R, depths, view))
        return tuple(100 * len(asked) + n for n in range(6))

    monkeypatch.setattr(pairs, "table_position", table_position)
    monkeypatch.setattr(pairs, "depth_variables", lambda z, zeta: (z, zeta))
    for a, b in ((0, 2), (1, 1)):
        asked.clear()
        pieces, values = np.full((64, 3), -1), np.full((64, 8), np.nan)
        pairs._locate(a, b, nodes, normals, centers, squares, images, "view", pieces, values)
        for e in range(64):
            i, j, mirror = nodes[4 * a + e // 16], nodes[4 * b + e // 4 % 4], [*images[e % 4], 1.0]
            there = (j * mirror - i)[:2]
            R = np.hypot(*there)
            assert asked[e] == (pytest.approx(R), (i[2], j[2]), "view")
            assert pieces[e].tolist() == [100 * (e + 1) + n for n in range(3)]
            assert values[e, 3:6].tolist() == [100 * (e + 1) + n for n in range(3, 6)] and values[e, 0] == asked[e][0]
            assert values[e, 1] == pytest.approx((normals[b] * mirror)[:2] @ there / R if R else 0.0)
            assert values[e, 2] == pytest.approx(-normals[a, :2] @ there / R if R else 0.0)
            # the image in the surface of the other panel's middle
            apart = np.array([*(i - centers[b] * mirror)[:2], i[2] + centers[b, 2]])
            back = np.array([*(j - centers[a] * mirror)[:2], j[2] + centers[a, 2]])
            assert values[e, 6] == (apart @ apart >= squares[b])
            assert values[e, 7] == (a != b and back @ back >= squares[a])
        assert 0 < values[:, 6].sum() < 64 and (a == b or 0 < values[:, 7].sum() < 64)
