"""Mean drift by pressure on the hull: equal to that of the far field, and to what is known without either."""

from functools import lru_cache

import numpy as np
import pytest
from exact.truncated_cylinder import TruncatedCylinder

from bem import DOFS
from bem.near_field import near_field_drift
from bem.panel_edges import samples, sharp_sides
from bem.setup import Setup
from bem.shape_setup import ShapeSetup
from bem.viscous import Quadratic, Viscous
from bem.waves import wavenumber
from meshing.lid import lid
from meshing.panels import structured
from meshing.shapes import box, buoy

RHO, G = 1025.0, 9.80665
LENGTH, BEAM, DRAFT = SIZES = (100.0, 50.0, 10.0)
VOLUME = LENGTH * BEAM * DRAFT
INERTIA = RHO * VOLUME * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
STIFFNESS = RHO * G * np.diag([0, 0, LENGTH * BEAM, 15.83 * VOLUME, 78.33 * VOLUME, 0])
FLOATING = {"inertia_matrix": INERTIA, "hydrostatic_stiffness": STIFFNESS}
WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed", "drift_force", "rao"}
HEADINGS = np.radians([0, 15, 30, 45, 60, 75, 90, 200])
ARMS = np.array([1, 1, LENGTH / 2])


@lru_cache
def series_box(depth, tolerance):
    """The floating box of the contour method"""
    return contour_body(SIZES, depth, tolerance, **FLOATING)


# of the far field of a free box that the near field misses at any tolerance: 1.5e-3 was measured at 0.6 rad/s
LEFT = 4e-3


def contour_body(sizes, depth, tolerance, **options):
    shape = "box" if len(sizes) == 3 else "buoy"
    return ShapeSetup(
        method="contour", shape=shape, sizes=sizes, depth=depth, tolerance=tolerance, **options
    ).prepared()


def panel_body(panels, depth, **options):
    mesh = box(*SIZES, panels=panels)
    return Setup(mesh, lid(mesh), depth=depth, **options).prepared()


def solved(body, omega, headings=HEADINGS):
    return body.run(omega, headings, WANT, None, DOFS)


def both(run, moving):
    """Near and far, moments as forces at half the length"""
    return near_field_drift(run, moving) / ARMS, run.drift(moving) / ARMS


def gap(run, moving):
    """Largest difference over the headings, of the largest force on the fixed body"""
    near, far = both(run, moving)
    return np.abs(near - far).max() / np.abs(run.drift(False)[:, :2]).max()


def floating_cylinder(radius, draft):
    mass = RHO * np.pi * radius**2 * draft
    inertia = mass * np.diag([1, 1, 1, radius**2 / 3, radius**2 / 3, radius**2 / 2])
    stiffness = RHO * G * np.pi * radius**2 * np.diag([0, 0, 1, radius**2 / 4, radius**2 / 4, 0])
    return inertia, stiffness


@pytest.mark.parametrize("radius, draft, depth", [(10, 10, 12), (10, 10, 30), (10, 10, 100), (50, 10, 12)])
def test_pressure_on_a_cylinder_drifts_it_as_the_exact_far_field(radius, draft, depth):
    inertia, stiffness = floating_cylinder(radius, draft)
    body = contour_body((radius, draft), float(depth), 1e-3, inertia_matrix=inertia, hydrostatic_stiffness=stiffness)
    for kr in (0.5, 1.0, 3.0):
        k = kr / radius
        omega = np.sqrt(G * k * np.tanh(k * depth))
        exact = TruncatedCylinder(radius, draft, depth, omega, RHO, G)
        run = solved(body, omega, [0.6])
        fixed, free = exact.drift_fixed(0.6), exact.drift_free(0.6, inertia, stiffness)
        scale = np.abs(fixed).max()
        assert np.abs(near_field_drift(run, False)[0, :2] - fixed).max() < 0.01 * scale
        assert np.abs(near_field_drift(run, True)[0, :2] - free).max() < 0.01 * scale
        assert np.abs(run.drift(False)[0, :2] - fixed).max() < 0.001 * scale


@pytest.mark.parametrize("depth", [12.0, 20.0, 100.0])
def test_near_field_of_a_box_meets_the_far_field_as_the_tolerance_falls(depth):
    for omega in (0.5, 0.8, 1.1):
        runs = [solved(series_box(depth, tolerance), omega) for tolerance in (1e-2, 1e-3, 1e-5)]
        for moving in (False, True):
            gaps = [gap(run, moving) for run in runs]
            assert gaps[1] < 0.01 and gaps[2] < 0.001, (omega, moving, gaps)
            assert moving or gaps[2] < 0.1 * gaps[0], (omega, gaps)


@pytest.mark.parametrize("depth", [12.0, 20.0, 100.0])
def test_near_and_far_field_differ_by_no_more_than_their_errors(depth):
    """The error of each is what a hundredth of the tolerance changes"""
    for omega in (0.4, 0.6, 1.0):
        rough, fine = (solved(series_box(depth, tolerance), omega) for tolerance in (1e-3, 1e-5))
        for moving in (False, True):
            (near, far), (better_near, better_far) = both(rough, moving), both(fine, moving)
            left = LEFT * np.abs(better_far).max() if moving else 0.0
            error = np.abs(near - better_near).max() + np.abs(far - better_far).max() + left
            assert np.abs(near - far).max() < 1.5 * error
            assert np.abs(better_near - better_far).max() < 0.5 * error


def test_near_field_holds_about_any_rotation_centre():
    """Rotations about a point beside the middle, held by the same water"""
    centre = (7.0, -3.0, 2.0)
    T = ShapeSetup(method="contour", shape="box", sizes=SIZES, rotation_center=centre).transform
    options = {"inertia_matrix": INERTIA, "hydrostatic_stiffness": T @ STIFFNESS @ T.T, "rotation_center": centre}
    run = solved(contour_body(SIZES, 20.0, 1e-4, **options), 0.7)
    assert gap(run, True) < 0.005
    assert gap(solved(panel_body(400, 20.0, **options), 0.9), True) < 0.03
    assert np.abs(run.drift(True) - solved(series_box(20.0, 1e-4), 0.7).drift(True)).max() > 1000


def test_viscous_damping_of_the_motions_leaves_near_and_far_field_equal():
    drag = Viscous({"Roll": Quadratic(1e11)}, 1.0)
    run = solved(contour_body(SIZES, 20.0, 1e-4, viscous=drag, **FLOATING), 0.7)
    plain = solved(series_box(20.0, 1e-4), 0.7)
    assert np.abs(run.rao[:, 3]).max() < 0.9 * np.abs(plain.rao[:, 3]).max()
    assert gap(run, True) < 0.005


@pytest.mark.parametrize("angle", [0.0, 40.0, 90.0])
def test_short_waves_are_reflected_by_the_walls_they_meet(angle):
    """½ρg ∫ cos² of the angle to the normal, over the lit sides of a fixed box in deep water"""
    beta, limit = np.radians(angle), 0.5 * RHO * G * np.array([BEAM, LENGTH])
    limit = limit * np.array([np.cos(beta), np.sin(beta)]) ** 2
    for depth, omega, loss in ((100.0, 2.0, 0.03), (100.0, 4.0, 0.015)):
        k = float(wavenumber(omega, depth))
        run = solved(series_box(depth, 1e-3), omega, [beta])
        near, far = near_field_drift(run, False)[0, :2], run.drift(False)[0, :2]
        assert np.abs(far - limit).max() < loss * limit.max(), k
        assert np.abs(near - limit).max() < (loss + 0.01) * limit.max(), k


def test_a_floating_box_does_not_drift_in_long_waves():
    """It scatters nothing: what is left of ½ρgL is the error of the pressures"""
    scale = 0.5 * RHO * G * LENGTH
    omega = 0.1
    for tolerance in (1e-3, 1e-5):
        run = solved(series_box(20.0, tolerance), omega)
        assert np.abs(run.drift(True)[:, :2]).max() < 1e-4 * scale
        assert np.abs(near_field_drift(run, True)[:, :2]).max() < 1e-4 * scale, tolerance


@pytest.mark.parametrize("depth", [12.0, 20.0, 100.0, np.inf])
def test_near_field_of_panels_approaches_the_far_field(depth):
    bodies = [panel_body(n, depth, **FLOATING) for n in (100, 400)]
    for omega in (0.5, 0.9):
        runs = [solved(body, omega) for body in bodies]
        fixed, free = ([gap(run, moving) for run in runs] for moving in (False, True))
        assert fixed[1] < 0.025, (omega, fixed)
        assert free[1] < 0.75 * free[0], (omega, free)


def test_the_edges_of_a_box_are_sharp_and_only_they():
    mesh = box(*SIZES, counts=(4, 3, 2))
    exponents, v = sharp_sides(mesh), mesh.vertices
    middles = (v + np.roll(v, -1, axis=1)) / 2
    faces = [np.isclose(middles[..., 0], 50), np.isclose(middles[..., 1], 25), np.isclose(middles[..., 2], -10)]
    on_edge = sum(face.astype(int) for face in faces) > 1
    np.testing.assert_allclose(exponents, np.where(on_edge, 2 / 3, 1))
    barrel = buoy(10, 10, counts=(8, 3, 3))
    v = barrel.vertices
    reach = np.hypot(v[..., 0], v[..., 1])
    keel = np.isclose(v[..., 2], -10) & (reach > 0.99 * reach.max())
    np.testing.assert_allclose(sharp_sides(barrel), np.where(keel & np.roll(keel, -1, axis=1), 2 / 3, 1), atol=1e-12)


@pytest.mark.parametrize("side", range(4))
def test_flow_round_an_edge_is_integrated_exactly(side):
    """φ = r^(2/3) across a panel 2 m by 3 m: ∬ |∇φ|² = (4/9) ∫ r^(−2/3) dr · breadth"""
    mesh = structured(np.array([[[0.0, 0, 0], [0, 3, 0]], [[2, 0, 0], [2, 3, 0]]]))
    exponents = np.ones((1, 4))
    exponents[0, side] = 2 / 3
    s = samples(mesh, exponents)
    v = mesh.vertices[0]
    a, b, inwards = v[side], v[(side + 1) % 4], v[(side + 2) % 4] - v[(side + 1) % 4]
    depth, breadth = np.linalg.norm(inwards), np.linalg.norm(b - a)
    inwards = inwards / depth
    nodes = np.array([[i, j] for i in (-1, 1) for j in (-1, 1)]) / np.sqrt(3)
    across, up = nodes.T[:, :, None] * [[[-1, 1, 1, -1]], [[-1, -1, 1, 1]]]
    shape = (1 + across) * (1 + up) / 4
    phi = ((shape @ v - a) @ inwards) ** (2 / 3)
    np.testing.assert_allclose(s.weights.sum(), 6)
    np.testing.assert_allclose(s.shape[0] @ phi, ((s.points[0] - a) @ inwards) ** (2 / 3))
    gradient = s.gradient[0] @ phi
    np.testing.assert_allclose(gradient - (gradient @ inwards)[:, None] * inwards, 0, atol=1e-12)
    square = s.weights[0] @ np.sum(gradient**2, axis=1)
    np.testing.assert_allclose(square, 4 / 3 * depth ** (1 / 3) * breadth)


def test_what_has_no_pressure_on_its_sides_is_refused():
    strip = ShapeSetup(method="strip", shape="box", sizes=SIZES, depth=20.0).prepared()
    with pytest.raises(ValueError, match="near-field drift by method strip; allowed: panel, contour"):
        near_field_drift(strip.run(0.7, [0.0], {"drift_force_fixed"}, None, DOFS), False)
    for options, message in (
        ({"nodes_per_panel": 1}, "1 node a panel; allowed: 4"),
        ({"zero_draft": True}, "zero draft"),
    ):
        run = panel_body(60, 20.0, **options).run(0.7, [0.0], {"drift_force_fixed"}, None, DOFS)
        with pytest.raises(ValueError, match=message):
            near_field_drift(run, False)


def test_a_run_that_wants_too_little_is_refused():
    still, floating = contour_body(SIZES, 20.0, 1e-2), series_box(20.0, 1e-2)
    for body, want, moving in (
        (still, {"drift_force_fixed", "drift_force"}, True),
        (floating, {"drift_force_fixed"}, True),
        (floating, {"excitation_force", "rao"}, False),
    ):
        with pytest.raises(ValueError, match="it has to want drift_force"):
            near_field_drift(body.run(0.7, [0.0], want, None, DOFS), moving)
