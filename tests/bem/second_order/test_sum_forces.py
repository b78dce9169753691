"""Forces of pairs at the sum of their frequencies: exact sums on a cylinder, long waves on a slender one, symmetry."""

from functools import lru_cache

import numpy as np
import pytest
from exact.second_order_cylinder import free_surface_force, long_wave_force, quadratic_force
from exact.water_waves import wavenumber

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.kinds import SUM
from hakobune.bem.second_order.quadratic_forces import quadratic_forces
from hakobune.meshing.shapes import box, buoy

RHO, G = 1025.0, 9.80665
RADIUS, DEPTH = 10.0, 20.0
OMEGA = [np.sqrt(G * ka / RADIUS * np.tanh(ka / RADIUS * DEPTH)) for ka in (0.4, 0.6)]
ROWS = (0, 0), (1, 0), (1, 1)  # pairs, in the order of their sums


def exact(one, two, part, moment, radius=RADIUS, depth=DEPTH):
    """T of a part, N/m², N m/m²"""
    if part == "bound_wave":
        bound = bound_waves((one, 0.0), (-two, 0.0), depth)
        return bound.amplitude * long_wave_force(radius, depth, bound.omega, bound.number[0], moment=moment)
    return {"squares": quadratic_force, "surface": free_surface_force}[part](
        radius, depth, one, two, sums=True, moment=moment
    )


def on_the_bed(side):
    problem = PanelProblem(buoy(RADIUS, DEPTH, counts=(side, 1, side), bottom=False), depth=DEPTH)
    return quadratic_forces(problem, OMEGA, [0.0], 9.0, False, kind=SUM, surface=True)


def test_the_cylinder_on_the_bed_has_the_force_and_moment_of_its_eigenfunctions():
    """Squares of panels converge with their length, as those of difference frequencies do before the far field helps"""
    errors, parts = [], ("squares", "bound_wave", "surface")
    for forces in (on_the_bed(4), on_the_bed(8)):
        for row, (i, j) in enumerate(ROWS):
            assert forces.frequency[row] == pytest.approx(OMEGA[i] + OMEGA[j])
            for mode in (0, 4):
                known = np.array([exact(OMEGA[i], OMEGA[j], part, mode == 4) for part in parts])
                found = np.array([getattr(forces, part)[row, j, 0, 0, mode] for part in parts])
                whole = abs(found.sum() - known.sum()) / abs(known.sum())
                errors.append([*np.abs(found - known) / np.abs(known), whole])
    coarse, fine = np.array(errors).reshape(2, 6, 4)
    assert np.all(fine[:, 0] < 0.04) and np.all(fine[:, 0] < 0.65 * coarse[:, 0])
    assert np.all(fine[:, 1] < 3e-4) and np.all(fine[:, 1] < 0.35 * coarse[:, 1])
    assert np.all(fine[:, 2] < 3e-3)
    assert np.all(fine[:, 3] < 0.02) and np.all(fine[:, 3] < 0.55 * coarse[:, 3])


def test_the_contour_method_has_that_force_without_the_gap_under_the_keel():
    """What a gap of s changes is of first order in it: of two the rest is of order s² ln s"""
    known = [sum(exact(OMEGA[i], OMEGA[j], p, False) for p in ("squares", "bound_wave", "surface")) for i, j in ROWS]
    found = []
    for gap in (0.2, 0.1):
        cylinder = ShapeProblem(method="contour", shape="buoy", sizes=(RADIUS, DEPTH - gap), depth=DEPTH)
        forces = quadratic_forces(cylinder, OMEGA, [0.0], 9.0, False, kind=SUM, surface=True)
        found.append(np.array([forces.total[row, j, 0, 0, 0] for row, (_, j) in enumerate(ROWS)]))
    off = [np.abs(T - known) / np.abs(known) for T in (found[1], 2 * found[1] - found[0])]
    assert np.all(off[0] > 5e-4) and np.all(off[1] < 3e-4)


@pytest.mark.parametrize("moment", [False, True])
def test_where_the_exact_integral_leaves_the_real_axis_does_not_matter(moment):
    one, two = OMEGA[1], OMEGA[0]
    near, far = (free_surface_force(RADIUS, DEPTH, one, two, sums=True, moment=moment, further=x) for x in (0.0, 37.0))
    assert abs(near - far) < 1e-10 * abs(near)


def test_long_waves_push_a_slender_cylinder_in_deep_water_at_second_order_as_published():
    """5/4 π ρ g k a² A² sin 2ωt (Faltinsen, Newman and Vinje 1995), what is left of the order of ka: all three parts"""
    off = []
    for ka, depth in ((0.05, 120.0), (0.025, 240.0)):
        omega = np.sqrt(G * ka * np.tanh(ka * depth))
        whole = sum(exact(omega, omega, part, False, 1.0, depth) for part in ("squares", "bound_wave", "surface"))
        off.append(abs(whole / (np.pi * RHO * G * float(wavenumber(omega, depth))) + 1.25j))
    assert off[1] < 0.03 and off[1] < 0.5 * off[0]


@lru_cache
def floating():
    length, beam, draft = 100.0, 50.0, 10.0
    volume = length * beam * draft
    inertia = RHO * volume * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
    stiffness = RHO * G * np.diag([0, 0, length * beam, 15.83 * volume, 78.33 * volume, 0])
    mesh = box(length, beam, draft, panels=120)
    return PanelProblem(mesh, depth=DEPTH, inertia_matrix=inertia, hydrostatic_stiffness=stiffness)


def test_two_headings_in_the_other_order_give_the_same():
    omega, headings = np.linspace(0.4, 0.6, 3), np.radians([0, 40])
    found = quadratic_forces(floating(), omega, headings, 2.0, True, surface=True, kind=SUM)
    assert found.frequency == pytest.approx(np.linspace(0.8, 1.2, 5))
    for part in (found.squares, found.bound_wave, found.body, found.surface):
        for n in range(3):
            own = part[2 * n, n]
            assert np.abs(own - own.swapaxes(0, 1)).max() < 1e-12 * np.abs(own).max()
    there = [[0], [0], [0, 1], [1], [2]]
    for row, lower in enumerate(there):
        assert np.flatnonzero(np.isfinite(found.total[row, :, 0, 0, 0])).tolist() == lower


def test_sums_below_the_lowest_are_refused():
    with pytest.raises(ValueError, match=r"sums of frequencies are requested up to 0.7 rad/s; allowed: 0.8 or above"):
        quadratic_forces(floating(), [0.4, 0.5], [0.0], 0.7, False, kind=SUM)
