"""Forces of pairs by the contour method: exact sums in the limit of no gap, its own coefficients, panels."""

from functools import lru_cache

import numpy as np
import pytest
from exact.second_order_cylinder import free_surface_force, long_wave_force, quadratic_force
from scipy.special import hankel1

from hakobune.bem import DOFS
from hakobune.bem.contour.hull.flow import HullPoints, SharedFrequency, radiated_flow, wave_flow
from hakobune.bem.contour.hull.long_waves import long_wave_forces
from hakobune.bem.contour.pressure_drift import refined
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.contour_waves import ContourWaves
from hakobune.bem.second_order.kinds import SUM
from hakobune.bem.second_order.quadratic_forces import quadratic_forces
from hakobune.bem.waves import wavenumber
from hakobune.meshing.shapes import box, buoy

RHO, G, RADIUS, DRAFT, DEPTH = 1025.0, 9.80665, 10.0, 10.0, 30.0
MASS = RHO * np.pi * RADIUS**2 * DRAFT
BODY = {
    "depth": DEPTH,
    "inertia_matrix": MASS * np.diag([1, 1, 1, 36, 36, 50.0]),
    "hydrostatic_stiffness": G * np.diag([0, 0, MASS / DRAFT, MASS, MASS, 0]),
}
SHAPES = {"buoy": (RADIUS, DRAFT), "box": (60.0, 30.0, 10.0)}


def problem(shape="buoy", tolerance=1e-4, **others):
    return ShapeProblem(method="contour", shape=shape, sizes=SHAPES[shape], tolerance=tolerance, **(BODY | others))


@lru_cache
def pairs(moving):
    return quadratic_forces(problem(), [0.6, 0.8], [0.4], 0.3, moving, surface=True)


@lru_cache
def hull(shape):
    body = refined(problem(shape).prepared().solver)
    points = HullPoints(body, float(wavenumber(0.9, DEPTH, G)))
    freq = SharedFrequency(points, 0.9, [0.3], RHO, G)
    return freq, points, points.surfaces(freq)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_potential_at_the_points_makes_the_forces_of_the_method(shape):
    freq, points, surfaces = hull(shape)
    run = problem(shape).prepared().run(0.9, [0.3], {"added_mass", "excitation_force"}, None, DOFS)
    area = surfaces.hull.weights[:, None] * surfaces.hull_modes
    radiated = radiated_flow(freq, points, surfaces).on_hull @ area
    waves = wave_flow(freq, points, surfaces, np.zeros((1, 6))).on_hull @ area
    known = range(5) if shape == "buoy" else (0, 1, 5)  # the bottom is among the points of the buoy only
    for i in known:
        assert -RHO * radiated[i, i] == pytest.approx(run.radiation[i, i], rel=1e-4)
        assert 1j * 0.9 * RHO * waves[0, i] == pytest.approx(-run.excitation[0, i], rel=1e-4)


@pytest.mark.parametrize("shape", SHAPES)
def test_a_long_wave_of_the_free_wavenumber_has_the_force_of_that_wave(shape):
    freq = hull(shape)[0]
    run = problem(shape).prepared().run(0.9, [0.3], {"excitation_force"}, None, DOFS)
    found = long_wave_forces(freq, freq.k * np.array([[np.cos(0.3), np.sin(0.3)]]))[0]
    scale = np.abs(run.excitation[0]).max()
    assert np.abs(found - run.excitation[0]).max() < 1e-5 * scale


def test_the_flow_under_the_keel_continues_that_on_the_side():
    freq, points, surfaces = hull("buoy")
    flow = wave_flow(freq, points, surfaces, np.full((1, 6), 0.1 + 0.2j))
    z, r = surfaces.hull.points[:, 2], np.hypot(*surfaces.hull.points[:, :2].T)
    quarter = np.arange(len(z) // 4)
    side, below = quarter[z[quarter] > -DRAFT], quarter[z[quarter] == -DRAFT]
    m = len(points.contour.x)
    edge = side[np.argsort(z[side])[:m]], below[np.argsort(-r[below])[:m]]
    one, two = (flow.on_hull[0, np.sort(part)] for part in edge)
    assert np.abs(one - two).max() < 2e-3 * np.abs(one).max()


def test_the_waterline_has_the_potential_of_the_surface_beside_it_where_the_wall_moves_in_short_waves():
    """At Kh = 9 in surge of unit velocity, which is that of the water along a first ring 7 mm off the side"""
    body = ShapeProblem(method="contour", shape="buoy", sizes=(RADIUS, 18.0), depth=20.0)
    waves = ContourWaves(body, np.array([1.0, 1.1]), [0.0], False, np.array([2.1]), True, kind=SUM)
    freq = waves.radiation(2.1)
    line, (surge, *_) = waves.radiated(freq), waves.around.radiated(freq, None)[1]
    r, m = waves.around.rings.radii[0, 0], surge.most
    beside = 2 * (surge.sent[m + 1] * hankel1(1, surge.k * r) + surge.local[0, 0, 1])
    points = waves.surfaces.waterline.points
    on_line = line.potential[0] * RADIUS / points[:, 0]
    assert r - RADIUS < 0.01 and np.abs(on_line - beside + (r - RADIUS)).max() < 1e-4 * abs(beside)


def test_without_a_gap_it_is_the_cylinder_on_the_bed():
    """What a gap of s changes is of first order in it: extrapolated from three, of order s³ ln s"""
    radius, depth = 10.0, 20.0
    two, one = (np.sqrt(G * ka / radius * np.tanh(ka / radius * depth)) for ka in (0.6, 0.8))
    bound = bound_waves((one, 0.0), (two, 0.0), depth)
    exact = bound.amplitude * long_wave_force(radius, depth, bound.omega, bound.number[0])
    exact += sum(force(radius, depth, one, two) for force in (quadratic_force, free_surface_force))
    found = []
    for gap in (0.4, 0.2, 0.1):
        cylinder = ShapeProblem(method="contour", shape="buoy", sizes=(radius, depth - gap), depth=depth)
        forces = quadratic_forces(cylinder, [two, one], [0.0], 1.0, False, surface=True)
        found.append(forces.total[1, 0, 0, 0, 0])
    first = 2 * found[1] - found[0], 2 * found[2] - found[1]
    assert abs(found[2] - exact) > 5e-3 * abs(exact)
    assert abs((4 * first[1] - first[0]) / 3 - exact) < 5e-4 * abs(exact)


@pytest.mark.parametrize("moving", [False, True])
def test_panels_approach_it_in_every_part(moving):
    off = []
    for panels in (200, 800):
        mesh = PanelProblem(buoy(RADIUS, DRAFT, panels=panels), **BODY)
        found, known = quadratic_forces(mesh, [0.6, 0.8], [0.4], 0.3, moving, surface=True), pairs(moving)
        scale = np.abs(known.total[1, 0, 0, 0, :5])
        parts = ("squares", "bound_wave", "body", "surface")
        gaps = [np.abs(getattr(found, p)[1, 0, 0, 0, :5] - getattr(known, p)[1, 0, 0, 0, :5]) / scale for p in parts]
        off.append(np.array(gaps))
    assert off[1].max() < 0.03 and np.all(off[1].max(axis=1) < 0.7 * off[0].max(axis=1) + 1e-12)


def test_on_the_diagonal_the_far_field_adds_little():
    for shape, moving in (("buoy", True), ("box", False)):
        found = quadratic_forces(problem(shape), [0.6, 0.8], [0.4], 0.1, moving)
        drift = np.abs(found.squares[0, :, 0, 0, :2]).max()
        assert np.abs(found.added[..., :2]).max() < 2e-4 * drift


def test_held_boxes_have_surge_sway_and_yaw():
    found = quadratic_forces(problem("box"), [0.6, 0.8], [0.4], 0.3, False).total[1, 0, 0, 0]
    panels = PanelProblem(box(*SHAPES["box"], panels=400), **BODY)
    known = quadratic_forces(panels, [0.6, 0.8], [0.4], 0.3, False).total[1, 0, 0, 0]
    scale = np.array([1, 1, 30.0]) * np.abs(known[:2]).max()
    assert np.all(np.abs(found - known)[[0, 1, 5]] < 0.01 * scale) and np.isnan(found[2:5]).all()


@pytest.mark.parametrize("moving, surface", [(True, False), (False, True)])
def test_what_needs_the_flow_under_a_box_is_refused(moving, surface):
    with pytest.raises(
        ValueError,
        match="computes wave pairs of a box only if the box is fixed, and",
    ):
        quadratic_forces(problem("box"), [0.6, 0.8], [0.4], 0.3, moving, surface=surface)


def test_deep_water_is_refused():
    with pytest.raises(ValueError, match="contour in finite depth"):
        quadratic_forces(problem(depth=np.inf), [0.6, 0.8], [0.4], 0.3, False)
