"""Through irregular frequencies: no jump above the stored estimated error, in all ten by tests/bench/irregular.py."""

import numpy as np
import pytest
from bench.irregular import contour, jump, panels
from scipy.special import jn_zeros

from hakobune.bem import DOFS
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.irregular_frequencies import SHARE, extent, lid_needed_from, lowest_irregular
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.validation.stress.scenes import irregular

BOX = 100.0, 50.0, 10.0
DEFAULT = 0.01  # relative error that a run asks for by default
KAPPA, (HULL, PLAN) = irregular("box", {"length": BOX[0], "beam": BOX[1]}, BOX[2], 12.0)


def test_the_water_inside_the_hull_resonates_at_these_frequencies():
    """sin sin sinh κ(z + d) is nothing on the hull and keeps ω²φ = g ∂φ/∂z at the surface, by finite differences"""
    z, step = np.array([-1e-4, 0.0, 1e-4]), 1e-4
    for m, n, i in ((1, 1, 0), (2, 1, 1), (3, 1, 2)):
        kappa = np.pi * np.hypot(m / BOX[0], n / BOX[1])
        assert KAPPA[i] == pytest.approx(kappa, rel=1e-12)
        below, here, above = np.sinh(kappa * (z + BOX[2]))
        assert HULL[i] ** 2 * here == pytest.approx(9.80665 * (above - below) / (2 * step), rel=1e-7)


@pytest.fixture(scope="module")
def with_lid():
    return panels(BOX, 12.0, 104)


@pytest.mark.parametrize("omega", HULL[:2])
def test_panels_with_a_lid_are_smooth_through_an_irregular_frequency(with_lid, omega):
    left, estimate = jump(with_lid, omega)
    assert left < min(estimate, DEFAULT), (left, estimate)


def test_the_sweep_sees_what_a_missing_lid_does():
    assert jump(panels(BOX, 12.0, 104, with_lid=False), HULL[0])[0] > 0.5


@pytest.mark.parametrize("omega", [HULL[0], PLAN[0], PLAN[1], PLAN[4]])
def test_the_contour_method_is_smooth_through_irregular_frequencies_of_hull_and_plan(omega):
    left, estimate = jump(contour(BOX, 12.0), omega)
    assert left < min(estimate, DEFAULT / 100), (left, estimate)


def test_the_lowest_irregular_frequency_of_a_box_is_its_own_and_a_bound_for_what_is_inside_it():
    assert lowest_irregular(*BOX) == pytest.approx(HULL[0] ** 2 / 9.80665, rel=1e-12)
    for radius, draft in ((10.0, 10.0), (3.0, 20.0), (50.0, 1.0)):
        kappa = jn_zeros(0, 1)[0] / radius
        assert lowest_irregular(2 * radius, 2 * radius, draft) < kappa / np.tanh(kappa * draft)


BORDER = np.sqrt(9.80665 * lid_needed_from(box(*BOX, panels=104)))


@pytest.mark.parametrize("symmetry", ["quarter", "whole", "beside a wall"])
def test_low_frequencies_do_without_the_lid_and_high_ones_do_not(symmetry):
    mesh = box(*BOX, panels=104)
    mesh = mesh.whole() if symmetry == "whole" else mesh
    prepared = prepare(PanelProblem(mesh, lid(mesh), depth=20.0, wall=-30.0 if "wall" in symmetry else None))
    below, above = (prepared.run(BORDER * (1 + s), [0.0], {"added_mass"}, None, DOFS) for s in (-1e-6, 1e-6))
    assert len(below.geometry.elements.nodes) == below.geometry.hull == above.geometry.hull
    assert len(above.geometry.elements.nodes) > above.geometry.hull


def test_a_round_hull_is_taken_for_the_box_around_it():
    mesh = buoy(RADIUS, 10, panels=96)
    kappa = jn_zeros(0, 1)[0] / RADIUS
    below, exact = lowest_irregular(2.1 * RADIUS, 2.1 * RADIUS, 10.0), kappa / np.tanh(kappa * 10.0)
    assert SHARE * below < lid_needed_from(mesh) < SHARE * exact


RADIUS = 10.0


@pytest.mark.parametrize("mesh", [box(40.0, 2.0, 3.0, panels=60), buoy(10.0, 10.0, panels=60)])
def test_the_bound_turns_with_the_hull(mesh):
    rotated_hull = mesh.whole().rotated(0.7).moved(3.0, -8.0, 0.0)
    assert lid_needed_from(rotated_hull) == pytest.approx(lid_needed_from(mesh), rel=1e-12)


@pytest.mark.parametrize("depth", [12.0, 100.0])
def test_where_the_lid_is_left_out_the_step_is_below_the_estimate(depth):
    left, estimate = jump(panels(BOX, depth, 104), BORDER)
    assert left < min(estimate, DEFAULT), (left, estimate)


def test_no_lid_is_needed_up_to_six_tenths_of_the_lowest_irregular_frequency():
    """κ coth κd, κ = π √(1/L² + 1/B²)"""
    kappa = np.pi * np.sqrt(1 / 100**2 + 1 / 50**2)
    assert lid_needed_from(box(100, 50, 10, panels=104)) == pytest.approx(0.6 * kappa / np.tanh(10 * kappa))
    assert extent(box(100, 50, 10, panels=104)) == pytest.approx([100, 50])
    shifted = box(100, 50, 10, panels=104, symmetry="y").moved(dx=7.0)
    assert extent(shifted) == pytest.approx([100, 50]) and extent(shifted.whole()) == pytest.approx([100, 50])
