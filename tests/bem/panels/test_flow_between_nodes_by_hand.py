"""Flow between the nodes of a box: uniform flows are met everywhere, and what waves and motions do at edges is not
interpolated."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels.influence import Geometry
from hakobune.bem.panels.pressure_drift.hull_flow import _flow, hull_surfaces, unit_displacements
from hakobune.bem.waves import incident_wave
from hakobune.meshing.shapes import box

DEPTH, OMEGA, K = 12.0, 0.9, 0.11
RUN = SimpleNamespace(omega=OMEGA, k=K, problem=SimpleNamespace(depth=DEPTH, gravity=9.81))
NONE = np.zeros(3)
# the first image is the meshed part itself


@pytest.fixture(scope="module")
def surfaces():
    return hull_surfaces(Geometry(box(20.0, 12.0, 4.0, panels=90), None, DEPTH))


@pytest.mark.parametrize("where", ["hull", "waterline"])
def test_a_body_that_moves_through_water_as_fast_as_it_leaves_a_uniform_flow(surfaces, where):
    """φ = −iω ξ·x at the nodes of all images: relative to the edges nothing moves, and elsewhere it is linear"""
    one, rng = getattr(surfaces, where), np.random.default_rng(3)
    shift = rng.normal(size=(3, 3)) + 1j * rng.normal(size=(3, 3))
    phi = -1j * OMEGA * np.einsum("fc,inc->fin", shift, one.nodes)
    value, slope = one.value(RUN, phi, NONE, np.hstack([shift, np.zeros((3, 3))]), NONE)
    assert one.sharp.any() and (where == "waterline" or not one.sharp.all())
    assert value == pytest.approx(-1j * OMEGA * shift @ one.points.T, abs=1e-9)
    along = -1j * OMEGA * (shift[:, None] - (shift @ one.normals.T)[..., None] * one.normals)
    assert slope == pytest.approx(along, abs=1e-9)


def bent(x):
    """Two shapes and none"""
    return np.stack([np.stack([0 * x[..., 0], x[..., 0] * x[..., 2], x[..., 0] ** 2], axis=-1), 1j * x, 0 * x])


@pytest.mark.parametrize("bends", [None, bent])
def test_what_waves_and_motions_do_at_an_edge_is_no_part_of_what_is_interpolated(surfaces, bends):
    """I[φ + u·x] − u·x + φ_I, u the waves' velocity at the edge less that of the edge, 0 without one; panel by panel"""
    one, rng = surfaces.hull, np.random.default_rng(4)
    phi = rng.normal(size=(3, *one.nodes.shape[:2])) + 1j * rng.normal(size=(3, *one.nodes.shape[:2]))
    motion = rng.normal(size=(3, 6)) + 1j * rng.normal(size=(3, 6))
    waves, headings = np.array([1.0, 0.5j, 0.0]), np.array([0.3, 2.0, 0.0])
    value, slope = one.value(RUN, phi, waves, motion, headings, bends)
    panels, q = len(one.sharp), one.flow.points.shape[1]
    chosen = [*np.flatnonzero(one.sharp)[[0, 3, -1]], np.flatnonzero(~one.sharp)[0]]
    for image in range(one.copies):
        for panel in chosen:
            at = slice((image * panels + panel) * q, (image * panels + panel + 1) * q)
            x, n = one.points[at], one.normals[at]
            u = np.zeros((3, 3), complex)
            if one.sharp[panel]:
                edge = one.flow.edge[panel] * one.mirrors[image]
                speed = motion @ unit_displacements(edge[None])[:, 0] + (0 if bends is None else bends(edge))
                u = 1j * OMEGA * speed
                for f, beta in enumerate(headings):
                    u[f] += waves[f] * incident_wave(edge, beta, OMEGA, K, DEPTH, 9.81)[1]
            with_it = phi + np.einsum("fc,inc->fin", u, one.nodes)
            held = one.value(RUN, with_it, NONE, np.zeros((3, 6)), NONE)
            known = [incident_wave(x, beta, OMEGA, K, DEPTH, 9.81) for beta in headings]
            wave, velocity = (np.array([a * part[i] for a, part in zip(waves, known, strict=True)]) for i in range(2))
            assert value[:, at] == pytest.approx(held[0][:, at] - u @ x.T + wave, abs=1e-9)
            rest = velocity - u[:, None]
            rest = rest - np.sum(rest * n, axis=-1, keepdims=True) * n
            assert slope[:, at] == pytest.approx(held[1][:, at] + rest, abs=1e-9)


@pytest.mark.parametrize("bends", [None, bent])
def test_water_at_the_hull_moves_along_its_normal_as_the_hull_does(surfaces, bends):
    """−iω times displacement; along the hull it is what it was, and its potential is told at hull and waterline"""
    rng, hull = np.random.default_rng(5), surfaces.hull
    phi, motion = rng.normal(size=(3, *hull.nodes.shape[:2])) + 0j, rng.normal(size=(3, 6))
    waves, headings = np.ones(3), np.array([0.3, 2.0, 0.0])
    flow = _flow(RUN, surfaces, phi, waves, motion, headings, bends)
    moved = np.einsum("fm,mpc->fpc", motion, unit_displacements(hull.points)) + 0j
    if bends is not None:
        moved = moved + bends(hull.points)
    assert np.sum(flow.velocity * hull.normals, axis=-1) == pytest.approx(
        -1j * OMEGA * np.sum(moved * hull.normals, axis=-1)
    )
    value, slope = hull.value(RUN, phi, waves, motion, headings, bends)
    tangent = flow.velocity - np.sum(flow.velocity * hull.normals, axis=-1, keepdims=True) * hull.normals
    assert tangent == pytest.approx(slope, abs=1e-9) and np.array_equal(flow.on_hull, value)
    assert np.array_equal(flow.potential, surfaces.waterline.value(RUN, phi, waves, motion, headings, bends)[0])
    assert flow.omega.tolist() == [OMEGA] * 3 and np.array_equal(flow.motion, motion + 0j) and flow.hull is hull


def test_surfaces_are_of_all_panels_and_of_sides_in_the_surface(surfaces):
    """Area 20·12 + 2·4·32 m² and 64 m, over the images; the waterline's normals lie in the surface"""
    hull, line = surfaces.hull, surfaces.waterline
    assert hull.weights.sum() == pytest.approx(240.0 + 256.0) and line.weights.sum() == pytest.approx(64.0)
    assert not line.points[:, 2].any() and not line.normals[:, 2].any()
    assert np.linalg.norm(line.normals, axis=1) == pytest.approx(np.ones(len(line.normals)))
    outwards = np.sum(line.points * line.normals, axis=1)
    assert outwards == pytest.approx(np.where(np.abs(line.normals[:, 0]) > 0.5, 10.0, 6.0))
    volume = np.sum(hull.points * hull.normals, axis=1) @ hull.weights / 3
    assert volume == pytest.approx(960.0 * (1.0), rel=1e-9)


@pytest.mark.parametrize("below, length", [(3e-6, 64.0), (5e-6, 0.0)])
def test_a_millionth_of_the_draft_below_the_surface_is_still_the_waterline(below, length):
    """4e-6 m of 4 m"""
    sunk = box(20.0, 12.0, 4.0, panels=24).moved(0.0, 0.0, -below)
    found = hull_surfaces(Geometry(sunk, None, DEPTH))
    assert found.waterline.weights.sum() == pytest.approx(length)
