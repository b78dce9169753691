"""Mean drift by pressure on the hull: equal to that of the far field, and to what is known without either."""

import warnings
from dataclasses import replace
from functools import lru_cache
from types import SimpleNamespace

import numpy as np
import pytest
from exact.truncated_cylinder import TruncatedCylinder

from hakobune.bem import DOFS
from hakobune.bem.contour.side_flow import _at_keel, _edge_functions
from hakobune.bem.drift import energy_defect
from hakobune.bem.methods.near_field import near_field_drift, near_field_error
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.panels.pressure_drift.edges import coarsest_at_gap
from hakobune.bem.panels.pressure_drift.mean_drift import check_panels
from hakobune.bem.viscous import Quadratic, Viscous
from hakobune.bem.waves import wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

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


def contour_body(sizes, depth, tolerance, **options):
    shape = "box" if len(sizes) == 3 else "buoy"
    return ShapeProblem(
        method="contour", shape=shape, sizes=sizes, depth=depth, tolerance=tolerance, **options
    ).prepared()


def panel_body(panels, depth, **options):
    mesh, half = box(*SIZES, panels=panels), box(*SIZES, panels=panels // 2)
    return PanelProblem(mesh, lid(mesh), coarse=(half, lid(half)), depth=depth, **options).prepared()


def solved(body, omega, headings=HEADINGS):
    return body.run(omega, headings, WANT, None, DOFS)


def both(run, moving):
    """Near and far, moments as forces at half the length"""
    return near_field_drift(run, moving) / ARMS, run.drift(moving) / ARMS


@lru_cache(maxsize=2)
def compared(run, moving):
    return both(run, moving)


def gap(run, moving):
    """Largest difference over the headings, of the largest force on the fixed body"""
    near, far = compared(run, moving)
    return np.abs(near - far).max() / np.abs(run.drift(False)[:, :2]).max()


def within_error(run, moving):
    """Whether near and far field differ by no more than is estimated, each heading and component by itself"""
    near, far = compared(run, moving)
    return np.all(np.abs(near - far) <= near_field_error(run, moving) / ARMS)


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


@pytest.mark.parametrize("depth, finest", [(12.0, 1e-5), (20.0, 1e-3), (100.0, 1e-3)])
def test_near_field_of_a_box_meets_the_far_field_at_any_tolerance(depth, finest):
    """From waves in which it hardly drifts to short ones"""
    for tolerance in [t for t in (1e-2, 1e-3, 1e-5) if t >= finest]:
        for omega in (0.5, 1.1) if tolerance == 1e-5 else (0.05, 0.8, 1.5):
            run = solved(series_box(depth, tolerance), omega)
            for moving in (False, True):
                assert within_error(run, moving), (omega, tolerance, moving)
                if omega in (0.5, 0.8, 1.1):
                    allowed = {1e-2: 1e-3, 1e-3: 3e-4, 1e-5: 1e-4}[tolerance]
                    assert gap(run, moving) < allowed, (omega, tolerance, moving)


@pytest.mark.parametrize("depth, omegas", [(12.0, (0.425,)), (20.0, (0.6,)), (100.0, (0.6, 0.615))])
def test_a_box_in_resonant_roll_has_the_same_drift_near_and_far(depth, omegas):
    """Pressures are tens of times as large as the drift that they leave"""
    for omega in omegas:
        for tolerance in (1e-2, 1e-3, 1e-5):
            run = solved(series_box(depth, tolerance), omega, np.radians([45, 90]))
            assert BEAM / 2 * np.abs(run.rao[:, 3]).max() > 5
            assert within_error(run, True) and gap(run, True) < 0.005, (omega, tolerance)
            assert omega != 0.6 or tolerance > 1e-5 or gap(run, True) < 3e-4


def test_a_gap_of_many_drafts_is_left_no_error_of_first_order():
    """What functions of the gap lack stands in the pressures as it is, in the far field squared"""
    run = solved(series_box(100.0, 1e-3), 0.625)
    assert BEAM / 2 * np.abs(run.rao[:, 3]).max() > 5
    assert gap(run, False) < 0.001 and gap(run, True) < 0.002
    high = solved(series_box(600.0, 1e-3), 0.9)
    assert within_error(high, True)


def test_near_and_far_field_are_equal_in_motions_that_take_power_from_the_waves_or_give_it():
    """Momentum is conserved whatever moves the box"""
    rng = np.random.default_rng(1)
    levers = np.array([1, 1, 1, BEAM / 2, LENGTH / 2, LENGTH / 2])
    for depth, omega in ((12.0, 0.5), (20.0, 0.7)):
        run = solved(series_box(depth, 1e-5), omega)
        for _ in range(3):
            run.rao = (rng.normal(size=run.rao.shape) + 1j * rng.normal(size=run.rao.shape)) / levers
            near, far = both(run, True)
            assert np.abs(near - far).max() < 1e-4 * np.abs(far).max()
            radiated, scattered = (H[0] for H in run.kochin)
            H, t = scattered + run.rao @ radiated, len(run.theta)
            assert energy_defect(H[:, :t], np.diag(H[:, t:])).max() > 0.1


@pytest.mark.parametrize("depth", [12.0, 20.0, 100.0])
def test_neither_near_nor_far_field_is_more_wrong_than_estimated(depth):
    """Of the fixed box, as a hundredth of the tolerance changes it"""
    for omega in (0.2, 1.0):
        rough, fine = (solved(series_box(depth, tolerance), omega) for tolerance in (1e-2, 1e-4))
        error = near_field_error(rough, False) / ARMS
        for ours, better in zip(both(rough, False), both(fine, False), strict=True):
            assert np.all(np.abs(ours - better) <= error), omega


@pytest.mark.parametrize("depth, resonance", [(12.0, 0.425), (20.0, 0.575), (100.0, 0.62), (np.inf, 0.62)])
def test_near_and_far_field_of_panels_differ_by_no_more_than_estimated(depth, resonance):
    body = panel_body(400, depth, **FLOATING)
    for omega in (0.1, resonance, 0.7):
        run = solved(body, omega)
        assert within_error(run, False) and within_error(run, True), omega


def test_the_estimate_needs_one_of_the_pressures():
    alone = solved(replace(panel_body(60, 20.0).problem, coarse=None).prepared(), 0.7)
    with pytest.raises(ValueError, match="estimated only in a run that also has a coarse mesh"):
        near_field_error(alone, False)


@pytest.mark.parametrize("centre", [(0.0, 0.0, 0.0), (500.0, 300.0, 0.0)])
def test_the_estimate_holds_whichever_point_moments_are_about(centre):
    assert within_error(solved(panel_body(60, 20.0, rotation_center=centre), 0.7), False)


def test_a_box_that_goes_with_long_waves_is_estimated_as_in_short_ones():
    """Surge of many metres moves hull and water alike: of ½ρgL, the most that waves can exert, as in short ones"""
    run = solved(series_box(12.0, 1e-3), 0.05)
    assert np.abs(run.rao[:, 0]).max() > 10
    assert (near_field_error(run, True) / ARMS).max() < 0.02 * 0.5 * RHO * G * LENGTH


class KeelFlow:
    """In place of the depth modes c + c₁ r^(2/3) + c₂ r^(4/3) + c₃ r² + wr + b (2/3π) r² ln r, and none of w and b"""

    c, w, b = (0.7, 1.3, -0.4, 0.2), 0.9, -1.1

    def flow(self, r):
        out = np.zeros((2, len(r), 3))
        out[:, :, 0] = self.exact(r)
        return out

    def exact(self, r):
        c0, c1, c2, c3 = self.c
        turn = 2 * self.b / (3 * np.pi)
        value = c0 + c1 * r ** (2 / 3) + c2 * r ** (4 / 3) + (c3 + turn * np.log(r)) * r**2 + self.w * r
        slope = c1 * 2 / 3 * r ** (-1 / 3) + c2 * 4 / 3 * r ** (1 / 3) + (2 * c3 + turn * (2 * np.log(r) + 1)) * r
        return value, slope + self.w


def test_flow_round_a_moving_keel_is_continued_exactly_to_its_edge():
    edge = KeelFlow()
    (r, weights, value, slope), keel = _at_keel(edge, 0.1, 0.5)
    g = np.array([1, edge.w, edge.b])
    np.testing.assert_allclose(weights.sum(), 0.5)
    np.testing.assert_allclose(keel @ g, edge.c[0], rtol=1e-12)
    np.testing.assert_allclose([value @ g, slope @ g], edge.exact(r), rtol=1e-10)


def test_a_side_that_turns_about_its_keel_moves_the_water_by_the_logarithm():
    """Harmonic, and on both faces of the edge ∂φ/∂θ / r = b r: the side swings out, the bottom goes up"""
    b = 1.3

    def phi(r, theta):
        turn = np.log(r) * np.cos(2 * theta) - theta * np.sin(2 * theta)
        return b * r**2 * (2 / (3 * np.pi) * turn + np.sin(2 * theta) / 2)

    r, h = np.array([0.3, 0.8]), 1e-4
    for theta in (0.0, 3 * np.pi / 2):
        np.testing.assert_allclose((phi(r, theta + h) - phi(r, theta - h)) / (2 * h * r), b * r, rtol=1e-6)
    x, y = 0.4, -0.3
    square = [(x + h, y), (x - h, y), (x, y + h), (x, y - h), (x, y)]
    values = [phi(np.hypot(*p), np.arctan2(p[1], p[0]) % (2 * np.pi)) for p in square]
    assert abs(sum(values[:4]) - 4 * values[4]) / h**2 < 1e-5
    value, slope = (part[:, -1] for part in _edge_functions(r))
    np.testing.assert_allclose(b * value, phi(r, 0.0))
    np.testing.assert_allclose(b * slope, (phi(r + h, 0.0) - phi(r - h, 0.0)) / (2 * h), rtol=1e-6)


def test_near_field_holds_about_any_rotation_centre():
    """Rotations about a point beside the middle, held by the same water"""
    centre = (7.0, -3.0, 2.0)
    T = ShapeProblem(method="contour", shape="box", sizes=SIZES, rotation_center=centre).transform
    options = {"inertia_matrix": INERTIA, "hydrostatic_stiffness": T @ STIFFNESS @ T.T, "rotation_center": centre}
    run = solved(contour_body(SIZES, 20.0, 1e-4, **options), 0.7)
    assert gap(run, True) < 0.005
    assert gap(solved(panel_body(400, 20.0, **options), 0.9), True) < 0.005
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
@pytest.mark.filterwarnings("ignore:near-field drift")
def test_near_field_of_panels_approaches_the_far_field(depth):
    """At second order in the size of the panels or better, floating as well as fixed, in short waves as in long ones"""
    bodies = [panel_body(n, depth, **FLOATING) for n in (100, 400)]
    for omega in (0.5, 0.9, 1.5):
        runs = [solved(body, omega) for body in bodies]
        fixed, free = ([gap(run, moving) for run in runs] for moving in (False, True))
        assert fixed[1] < 0.005 and free[1] < 0.02, (omega, fixed, free)
        assert fixed[1] < 0.25 * fixed[0] and free[1] < 0.25 * free[0], (omega, fixed, free)


@pytest.mark.parametrize("depth, omega", [(12.0, 0.4), (20.0, 0.6), (100.0, 0.625)])
@pytest.mark.filterwarnings("ignore:near-field drift")
def test_near_field_of_panels_approaches_the_far_field_in_resonant_roll(depth, omega):
    """At second order, where squares of the motion are tens of times the drift"""
    runs = [solved(panel_body(n, depth, **FLOATING), omega, np.radians([45, 90])) for n in (200, 800)]
    assert BEAM / 2 * np.abs(runs[1].rao[:, 3]).max() > 4
    gaps = [gap(run, True) for run in runs]
    assert gaps[1] < 0.02 and gaps[1] < 0.25 * gaps[0], gaps


def test_panels_that_are_long_beside_the_gap_are_warned_of():
    run = panel_body(100, 12.0).run(0.7, [0.0], {"drift_force_fixed"}, None, DOFS)
    with pytest.warns(UserWarning, match="7.32 m long over a gap of 2 m; reliable: up to 3 m"):
        near_field_drift(run, False)


def test_what_has_no_pressure_on_its_sides_is_refused():
    strip = ShapeProblem(method="strip", shape="box", sizes=SIZES, depth=20.0).prepared()
    with pytest.raises(ValueError, match="the method is strip; near-field drift needs panel or contour"):
        near_field_drift(strip.run(0.7, [0.0], {"drift_force_fixed"}, None, DOFS), False)
    for options, message in (
        ({"nodes_per_panel": 1}, "nodes_per_panel is 1; near-field drift needs 4"),
        ({"zero_draft": True}, "the draft is 0"),
    ):
        run = panel_body(60, 20.0, **options).run(0.7, [0.0], {"drift_force_fixed"}, None, DOFS)
        for question in (near_field_drift, near_field_error):
            with pytest.raises(ValueError, match=message):
                question(run, False)


def test_a_run_that_wants_too_little_is_refused():
    still, floating = contour_body(SIZES, 20.0, 1e-2), series_box(20.0, 1e-2)
    for body, want, moving in (
        (still, {"drift_force_fixed", "drift_force"}, True),
        (floating, {"drift_force_fixed"}, True),
        (floating, {"excitation_force", "rao"}, False),
    ):
        for question in (near_field_drift, near_field_error):
            with pytest.raises(ValueError, match="near-field drift also needs drift_force"):
                question(body.run(0.7, [0.0], want, None, DOFS), moving)


@pytest.mark.parametrize("gap, told", [(3.4, False), (3.2, True)])
def test_panels_half_as_long_again_as_the_gap_is_high_are_too_long(gap, told):
    """Bottom panels of 5 m and side panels of 2 m next to the keel; 5/1.5 = 3.33"""
    mesh = box(100, 50, 10, counts=(10, 5, 5), grading=False)
    problem = SimpleNamespace(nodes_per_panel=4, zero_draft=False, depth=10 + gap)
    assert coarsest_at_gap(mesh, 10 + gap) == pytest.approx((5.0, gap))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        check_panels(problem, mesh)
    assert len(caught) == told
    if told:
        assert "are 5 m long over a gap of 3.2 m; reliable: up to 4.8 m" in str(caught[0].message)
    for wrong, words in (
        ({"nodes_per_panel": 1}, "nodes_per_panel is 1; near-field drift needs 4"),
        ({"zero_draft": True}, "needs a hull with sides, and the draft is 0"),
    ):
        with pytest.raises(ValueError, match=words):
            check_panels(SimpleNamespace(**(vars(problem) | wrong)), mesh)
