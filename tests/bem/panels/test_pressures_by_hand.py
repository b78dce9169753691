"""Mean loads by the pressure on a hull, piece by piece: sums over points, several bodies, bodies that bend, edges."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.modes import class_of
from hakobune.bem.panels.pressure_drift import hull_interpolation, mean_drift, of_each_body
from hakobune.bem.panels.pressure_drift.edges import coarsest_at_gap, sharp_sides
from hakobune.bem.panels.pressure_drift.hull_flow import HullFlow, HullSurfaces, Points
from hakobune.bem.panels.pressure_drift.mean_drift import carried_flow, pressure_pairs
from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.shapes import box

RNG = np.random.default_rng(8)
CLASSES = ((1, 1), (-1, 1), (1, -1), (-1, -1))
IMAGES = np.array([(1, 1), (-1, 1), (1, -1), (-1, -1)])
SIGNS = np.array([[(x if a < 0 else 1) * (y if b < 0 else 1) for a, b in IMAGES] for x, y in CLASSES], float)
MEMBERS = [[d for d in range(6) if class_of(d, "xy") == cls] for cls in CLASSES]


def points(count, height):
    """Points of a quarter and their images"""
    at = RNG.uniform(0.5, 2, size=(count, 3)) * [1, 1, height]
    return Points(IMAGES, SIGNS, MEMBERS, at, RNG.normal(size=(count, 3)), RNG.uniform(1, 2, count))


def complex_numbers(*shape):
    return RNG.normal(size=shape) + 1j * RNG.normal(size=shape)


@pytest.mark.parametrize("second", [np.conj, np.positive])
def test_pairs_of_waves_have_the_mean_of_their_products_over_hull_and_waterline(second):
    """−¼ρg ∮ ζᵢζ̄ⱼ n dl + ¼ρ ∬ {∇φᵢ·∇φ̄ⱼ + Xᵢ·∇∂φ̄ⱼ/∂t + X̄ⱼ·∇∂φᵢ/∂t} n dS and its moments, point by point"""
    hull, line = points(4, -1), points(3, 0)
    surfaces, rho, g = HullSurfaces(hull, line), 1025.0, 9.81
    omega, motion = np.array([0.6, 0.9]), complex_numbers(2, 6)
    v, on_line = complex_numbers(2, 16, 3), complex_numbers(2, 12)
    flow = HullFlow(omega, motion, v, on_line, v[..., 0], hull)
    found = pressure_pairs(surfaces, flow, SimpleNamespace(density=rho, gravity=g), second)

    def moved(at):
        return motion[:, None, :3] + np.cross(motion[:, None, 3:], at)

    X, rise = moved(hull.points), 1j * omega[:, None] / g * on_line - moved(line.points)[..., 2]
    for i in range(2):
        for j in range(2):
            slope = [-1j * w * part for w, part in zip(omega, v, strict=True)]
            square = np.sum(v[i] * second(v[j]), axis=1)
            square = square + np.sum(X[i] * second(slope[j]), axis=1) + np.sum(second(X[j]) * slope[i], axis=1)
            load = 0.25 * rho * (square * hull.weights)[:, None] * hull.normals
            crest = -0.25 * rho * g * (rise[i] * second(rise[j]) * line.weights)[:, None] * line.normals
            force = load.sum(axis=0) + crest.sum(axis=0)
            moment = np.cross(hull.points, load).sum(axis=0) + np.cross(line.points, crest).sum(axis=0)
            assert found[i, j] == pytest.approx(np.concatenate([force, moment]))
    carried = carried_flow(surfaces, flow)
    for m in range(6):
        unit = np.eye(6)[m]
        along = unit[:3] + np.cross(unit[3:], hull.points)
        modes = np.hstack([hull.normals, np.cross(hull.points, hull.normals)])
        wanted = np.einsum("fpd,pd,pc->fc", v, along * hull.weights[:, None], modes)
        assert carried[:, m] == pytest.approx(wanted)


def test_loads_of_first_order_are_those_of_water_and_weight_in_the_axes_of_each_body():
    """X Tᵀ + ω² T Z Tᵀ x − C x, with motions only where a body is free"""
    T, Z, C = RNG.normal(size=(12, 12)), complex_numbers(12, 12), RNG.normal(size=(12, 8))
    free = [0, 1, 2, 3, 4, 5, 6, 8]
    run = SimpleNamespace(headings=[0.1, 0.2], count=12, omega=0.8, radiation=Z, excitation=complex_numbers(2, 12),
                          rao=complex_numbers(2, 8),
                          problem=SimpleNamespace(transform=T, moving=free, hydrostatic_stiffness=C))  # fmt: skip
    own = of_each_body.own_motions(run, True)
    assert own[:, free] == pytest.approx(run.rao) and not own[:, [7, 9, 10, 11]].any()
    assert not of_each_body.own_motions(run, False).any()
    found = of_each_body.first_order_loads(run, own)
    for heading in range(2):
        wanted = T @ run.excitation[heading] + 0.64 * T @ Z @ T.T @ own[heading] - C @ run.rao[heading]
        assert found[heading] == pytest.approx(wanted)
    still = of_each_body.first_order_loads(run, 0 * own)
    assert still == pytest.approx(run.excitation @ T.T)


def test_a_surface_of_one_body_has_weights_on_its_panels_alone():
    whole = SimpleNamespace(flow=SimpleNamespace(points=np.zeros((3, 2, 3)), panels=np.array([0, 2, 1])), copies=2,
                            weights=np.arange(1.0, 13.0))  # fmt: skip
    body = np.array([0, 1, 0])
    one, two = (of_each_body._of_body(whole, body, n) for n in (0, 1))
    assert one.weights.tolist() == [1, 2, 3, 4, 0, 0, 7, 8, 9, 10, 0, 0]
    assert (one.weights + two.weights).tolist() == whole.weights.tolist() and one.copies == 2


def test_a_body_that_bends_is_pressed_on_its_moved_and_stretched_surface(monkeypatch):
    """−½ρg ∮ (½|ζ|² − Re ζu̅_z) n dl + ¼ρ ∬ |∇φ|² n − ½ Re ∬ (u̅·∇p) n + p {n ∇·u − (∇u)ᵀn}* dS, and moments
    with −½ Re u* × pn; of a shape u_z = x² beside the rigid motions"""
    hull, line = points(4, -1), points(3, 0)
    surface = HullSurfaces(hull, line)
    omega, rho, g = 0.7, 1025.0, 9.81
    shape = SimpleNamespace(moves=(1,), displacement=lambda p: np.stack([0 * p[..., 0]] * 2 + [p[..., 0] ** 2], -1))
    other = SimpleNamespace(moves=(0,), displacement=lambda p: 1e9 + 0 * p)
    motions = complex_numbers(2, 14)  # of two bodies and two shapes
    own = complex_numbers(2, 6)
    v, phi, top = complex_numbers(2, 16, 3), complex_numbers(2, 16), complex_numbers(2, 12)
    asked = []

    def flow(run, surface, motions, six, bent):
        asked.append((six, bent(hull.points)))
        return HullFlow(np.full(2, omega), six, v, top, phi, hull)

    monkeypatch.setattr(of_each_body, "disturbed_flow", flow)
    run = SimpleNamespace(
        omega=omega, problem=SimpleNamespace(bodies=(1, 2), modes=(other, shape), density=rho, gravity=g)
    )
    found = of_each_body._bent_load(run, surface, motions, own, 1)
    x = hull.points
    assert asked[0][0] is own
    assert asked[0][1][..., 2] == pytest.approx(np.outer(motions[:, 13], x[:, 0] ** 2))
    for f in range(2):
        bend, turn = motions[f, 13], own[f, 3:]
        u = own[f, :3] + np.cross(turn, x) + bend * np.stack([0 * x[:, 0]] * 2 + [x[:, 0] ** 2], -1)
        p, slope = 1j * rho * omega * phi[f], 1j * rho * omega * v[f]
        force, moment = np.zeros(3), np.zeros(3)
        for q in range(16):
            n, w = hull.normals[q], hull.weights[q]
            gradient = np.array([np.cross(turn, e) for e in np.eye(3)]).T.astype(complex)  # ∂u_a/∂x_b
            gradient[2, 0] += 2 * bend * x[q, 0]
            area = np.trace(gradient) * n - gradient.T @ n
            along = 0.25 * rho * np.sum(np.abs(v[f, q]) ** 2) - 0.5 * np.sum(u[q].conj() * slope[q]).real
            part = along * n - 0.5 * (p[q] * area.conj()).real
            force = force + w * part
            moment = moment + w * (np.cross(x[q], part) - 0.5 * (p[q] * np.cross(u[q], n).conj()).real)
        z = line.points
        lift = own[f, 2] + own[f, 3] * z[:, 1] - own[f, 4] * z[:, 0] + bend * z[:, 0] ** 2
        rise = 1j * omega / g * top[f]
        crest = -0.25 * rho * g * (np.abs(rise) ** 2 - 2 * (rise * lift.conj()).real) * line.weights
        force = force + crest @ line.normals
        moment = moment + np.cross(z, crest[:, None] * line.normals).sum(axis=0)
        assert found[f] == pytest.approx(np.concatenate([force, moment]), rel=1e-5, abs=1e-3)


def folded(turn, convex=True):
    """Two squares of 1 m that meet at the y axis, the second turned down by an angle, or up"""
    c, s = np.cos(turn), np.sin(turn) * (1 if convex else -1)
    at = np.array([[-1, 0, 0], [0, 0, 0], [0, 1, 0], [-1, 1, 0], [c, 0, s], [c, 1, s]], float)
    return PanelMesh(at, np.array([[0, 3, 2, 1], [1, 2, 5, 4]]), "")


@pytest.mark.parametrize("degrees, convex, sharp", [(59, True, False), (61, True, True), (90, True, True),
                                                    (61, False, False)])  # fmt: skip
def test_an_edge_is_sharp_from_sixty_degrees_on_where_it_stands_out(degrees, convex, sharp):
    """π/(π + α); an edge that is hollow is none"""
    turn = np.radians(degrees)
    mesh = folded(turn, convex)
    assert np.all(mesh.normals[0] == [0, 0, -1])
    found = sharp_sides(mesh)
    wanted = np.pi / (np.pi + turn) if sharp else 1.0
    assert found[0, 2] == found[1, 0] == pytest.approx(wanted)
    others = found[[0, 0, 0, 1, 1, 1], [0, 1, 3, 1, 2, 3]]
    assert np.all(others == 1.0)


@pytest.mark.parametrize("depth, gap", [(2.5, 0.5), (4.0, 2.0)])
def test_the_coarsest_panel_at_a_gap_is_the_longer_of_both_faces_of_the_keel(depth, gap):
    """Panels of 2 m along and 0.5 m across the bottom, and 1 m down the sides; deep water has no gap"""
    mesh = box(8.0, 4.0, 2.0, counts=(2, 4, 2), grading=False)
    assert coarsest_at_gap(mesh, depth) == pytest.approx((2.0, gap))
    tall = box(8.0, 4.0, 6.0, counts=(4, 4, 2), grading=False)
    assert coarsest_at_gap(tall, 6.0 + gap) == pytest.approx((3.0, gap))
    length, none = coarsest_at_gap(mesh, np.inf)
    assert length == 0.0 and np.isinf(none)


def test_stencils_that_magnify_errors_or_have_slivers_are_not_used(monkeypatch):
    """25 times between nodes, 0.3 at the first node beside an edge"""
    growth, missed = np.array([24.9, 25.1, 1.0, 1.0]), np.array([0.0, 0.0, 0.29, 0.31])
    shape = np.zeros((4, 3, 6))
    shape[:, 1, :2] = np.stack([growth / 2, -growth / 2], axis=1)
    monkeypatch.setattr(hull_interpolation, "_line_rule", lambda stencil: SimpleNamespace(shape=shape))
    monkeypatch.setattr(hull_interpolation, "_missed", lambda stencil: np.outer(missed, [1.0, 0.5]))
    assert hull_interpolation._steady(None).tolist() == [True, False, True, False]


@pytest.mark.parametrize("length, told", [(2.95, False), (3.05, True)])
def test_panels_half_as_long_again_as_the_gap_are_told(monkeypatch, length, told):
    """Of 2 m: up to 3 m"""
    monkeypatch.setattr(mean_drift, "coarsest_at_gap", lambda mesh, depth: (length, 2.0))
    problem = SimpleNamespace(nodes_per_panel=4, zero_draft=False, depth=9.0)
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        mean_drift.check_panels(problem, None)
    assert [("reliable: up to 3 m" in str(one.message)) for one in seen] == [True] * told
