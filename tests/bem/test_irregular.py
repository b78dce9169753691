"""Through irregular frequencies: no jump above the stored estimated error, in all ten by tests/bench/irregular.py."""

import numpy as np
import pytest
from bench.irregular import contour, jump, panels

from pipelines.stress.scenes import irregular

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
