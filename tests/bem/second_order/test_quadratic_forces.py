"""Difference forces of pairs: exact sums on a cylinder, the far field on the diagonal, Stokes's theorem."""

from dataclasses import replace
from functools import lru_cache
from types import SimpleNamespace

import numpy as np
import pytest
from exact.second_order_cylinder import free_surface_force, long_wave_force, quadratic_force
from scipy.spatial.transform import Rotation

from hakobune.bem import DOFS
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.panels.influence import Geometry
from hakobune.bem.panels.pressure_drift import hull_interpolation
from hakobune.bem.panels.pressure_drift.hull_flow import HullFlow, hull_surfaces, unit_displacements
from hakobune.bem.panels.pressure_drift.mean_drift import pressure_pairs
from hakobune.bem.panels.pressure_drift.turned_loads import products, rotated_pairs
from hakobune.bem.second_order import quadratic_forces as module
from hakobune.bem.second_order import surface_near
from hakobune.bem.second_order.body_forces import body_forces
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.first_order_waves import PanelWaves
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.quadratic_forces import (
    HORIZONTAL,
    ORDER,
    SIZES,
    QuadraticForces,
    QuadraticRun,
    _by_far_field,
    frequencies_of,
    panel_errors,
    quadratic_forces,
    resolution_errors,
    share_of,
)
from hakobune.bem.second_order.rotations import still_water_pairs, turned_twice
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import joined
from hakobune.meshing.shapes import box, buoy

RHO, G = 1025.0, 9.80665
LENGTH, BEAM, DRAFT = 100.0, 50.0, 10.0
VOLUME = LENGTH * BEAM * DRAFT
INERTIA = RHO * VOLUME * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
STIFFNESS = RHO * G * np.diag([0, 0, LENGTH * BEAM, 15.83 * VOLUME, 78.33 * VOLUME, 0])
CENTRE = np.array([3.0, -2.0, 1.5])


@lru_cache
def floating(depth=20.0, panels=200):
    mesh = box(LENGTH, BEAM, DRAFT, panels=panels)
    return PanelProblem(mesh, depth=depth, inertia_matrix=INERTIA, hydrostatic_stiffness=STIFFNESS)


@lru_cache
def of_box():
    return quadratic_forces(floating(), np.linspace(0.5, 0.65, 4), np.radians([0, 40]), 0.1, True)


def test_the_cylinder_on_the_bed_has_the_force_of_its_eigenfunctions():
    radius, depth = 10.0, 20.0
    omega = [np.sqrt(G * ka / radius * np.tanh(ka / radius * depth)) for ka in (0.6, 0.8)]
    problem = PanelProblem(buoy(radius, depth, counts=(8, 1, 8), bottom=False), depth=depth)
    found = quadratic_forces(problem, omega, [0.0], 1.0, False, surface=True)
    bound = bound_waves((omega[1], 0.0), (omega[0], 0.0), depth)
    squares = quadratic_force(radius, depth, omega[1], omega[0])
    exact = squares + bound.amplitude * long_wave_force(radius, depth, bound.omega, bound.number[0])
    assert abs(found.squares[1, 0, 0, 0, 0] - squares) < 0.01 * abs(squares)
    surface = free_surface_force(radius, depth, omega[1], omega[0])
    assert abs(found.surface[1, 0, 0, 0, 0] - surface) < 0.02 * abs(surface)
    assert abs(found.total[1, 0, 0, 0, 0] - exact - surface) < 0.01 * abs(exact + surface)


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_the_forcing_of_the_surface_is_the_same_wherever_the_sums_of_hankel_functions_begin(monkeypatch, depth):
    found = []
    for beyond in (1.0, 2.0):
        monkeypatch.setattr(surface_near, "SIDES_BEYOND", beyond)
        forces = quadratic_forces(floating(depth), [0.6, 0.75], [0.6], 1.0, True, surface=True)
        found.append(forces.surface[1, 0, 0, 0])
    assert np.abs(found[1] - found[0])[:5].max() < 5e-3 * np.abs(found[0])[:5].max()
    assert abs(found[1] - found[0])[5] < 0.02 * LENGTH / 2 * np.abs(found[0])[:2].max()


def test_deep_water_has_the_forces_of_very_deep_water():
    very, deep = (quadratic_forces(floating(depth), [0.6, 0.75], [0.6], 1.0, True) for depth in (3000.0, np.inf))
    for part in ("squares", "bound_wave", "body"):
        found, known = (getattr(forces, part)[1, 0, 0, 0, [0, 1, 5]] for forces in (very, deep))
        assert np.abs(found - known).max() < 1e-3 * np.abs(known).max()


def test_differences_of_irregular_frequencies_are_solved_with_a_lid():
    problem = replace(floating(), lid=lid(floating().mesh))
    waves = PanelWaves(problem, np.array([1.2, 1.4]), [0.0], False, np.array([0.0, 0.5, 1.0]))
    parts = [waves.radiation(difference).geometry.panels for difference in (0.5, 1.0)]
    assert len(parts[0]) == len(problem.mesh) and len(parts[1]) == len(problem.mesh) + len(problem.lid)


def test_around_two_waterlines_or_none_the_forcing_of_the_surface_is_refused():
    two = joined([box(20, 6, 3, panels=60).moved(dy=20), box(20, 6, 3, panels=60).moved(dy=-20)])
    for mesh in (two, floating().mesh.moved(dz=-5.0)):
        with pytest.raises(ValueError, match="free-surface forcing"):
            quadratic_forces(PanelProblem(mesh, depth=40.0), [0.5, 0.6], [0.0], 0.1, False, surface=True)


def test_on_the_diagonal_it_is_the_mean_drift_of_the_far_field_and_by_pressure_nearly():
    found, prepared = of_box(), floating().prepared()
    for i in (0, 3):
        run = prepared.run(found.omega[i], found.headings, {"drift_force", "rao"}, None, DOFS)
        diagonal = found.squares[0, i, [0, 1], [0, 1]][:, [0, 1, 5]]
        scale = np.abs(run.drift(False)[:, :2]).max() * np.array([1, 1, LENGTH / 2])
        assert np.abs(diagonal.imag).max() < 1e-9 * scale[0]
        assert np.all(np.abs(diagonal - run.drift(True)) < 1e-9 * scale)
        assert np.all(np.abs(found.added[i]) < 0.02 * scale) and np.all(np.abs(found.added[i, 1, 1]) > 1e-6 * scale)


def test_off_the_diagonal_of_headings_the_far_field_of_two_waves_is_the_pressures():
    """Interference of two directions, by momentum far away and by the pressure on the hull"""
    found = of_box()
    by_pressure = found.squares[0][:, 0, 1][:, [0, 1, 5]] - found.added[:, 0, 1]
    scale = np.abs(by_pressure[:, :2]).max() * np.array([1, 1, LENGTH / 2])
    assert np.all(np.abs(found.added[:, 0, 1]) < 0.02 * scale)
    swapped = found.added.swapaxes(1, 2).conj()
    assert np.abs(found.added - swapped).max() < 1e-12 * np.abs(found.squares[0]).max()


def test_of_flows_that_are_multiples_of_each_other_all_pairs_take_what_the_diagonal_tells_and_of_others_none():
    """Two frequencies and headings, T of any form of first degree in both flows; flows at right angles share nothing"""
    rng = np.random.default_rng(3)
    hull = SimpleNamespace(weights=rng.uniform(1, 2, 5))
    waves, size = (rng.normal(size=(*shape, 2)) @ [1, 1j] for shape in ((2, 5, 3), (2,)))
    form = rng.normal(size=(15, 15, 3, 2)) @ [1, 1j]
    form = form + form.swapaxes(0, 1).conj()
    flow = SimpleNamespace(velocity=np.concatenate([size[0] * waves, size[1] * waves]), hull=hull)
    u = flow.velocity.reshape(2, 2, 15)
    exact = np.einsum("iap,pqc,jbq->iajbc", u, form, u.conj())
    each, found = np.arange(2), np.zeros((2, 2, 2, 2, 6), complex)
    more = _by_far_field(found, exact[each, :, each], flow)
    np.testing.assert_allclose(found[..., HORIZONTAL], exact, rtol=1e-12)
    np.testing.assert_allclose(more, exact[each, :, each])
    flow.velocity[2:] = 0.0
    flow.velocity[:2, :, 2], flow.velocity[2:, :, 2] = 0.0, 1.0
    found = np.zeros((2, 2, 2, 2, 6), complex)
    _by_far_field(found, more, flow)
    assert np.all(found[0, :, 1] == 0) and np.all(found[1, :, 0] == 0)
    np.testing.assert_allclose(found[each, :, each][..., HORIZONTAL], more)


def test_without_differences_the_diagonal_is_the_same():
    alone = quadratic_forces(floating(), of_box().omega, of_box().headings, 0.01, True)
    assert alone.squares[0] == pytest.approx(of_box().squares[0], rel=1e-6) and len(alone.frequency) == 1


def test_lines_as_stiff_as_rock_hold_the_body_and_lines_without_stiffness_leave_it_free():
    omega, rock = [0.6, 0.7], 1e14 * np.diag([1, 1, 1, 1e3, 1e3, 1e3])
    fixed, free, held, loose = (
        quadratic_forces(floating(), omega, [0.5], 1.0, moving).total[1, 0, 0, 0]
        for moving in (False, True, rock, np.zeros((6, 6)))
    )
    assert np.abs(held - fixed).max() < 1e-4 * np.abs(fixed).max() < 1e-4 * np.abs(free - fixed).max() * 1e4
    np.testing.assert_allclose(loose, free, rtol=1e-9, atol=1e-6 * np.abs(free).max())


def test_the_error_of_two_meshes_is_a_mean_of_what_they_differ_by_the_squares_and_the_whole():
    part = np.zeros((1, 3, 1, 1, 6), complex)
    more = np.full((3, 1, 1, 3), 0.2)
    fine, rough = (
        QuadraticForces(np.arange(1.0, 4), np.zeros(1), np.zeros(1), part + x, part + 15, part, added=more)
        for x in (1.0, 1.5)
    )
    off = 0.5 / (2**ORDER - 1)
    known = panel_errors(fine, rough.total, 2.0)
    assert known[..., [2, 3, 4]] == pytest.approx(2 * SIZES[0] * np.sqrt(off))
    assert known[..., [0, 1, 5]] == pytest.approx(SIZES[1] * 0.2**0.25 * off**0.5)
    assert np.all(panel_errors(fine, fine.total, 2.0) == 0)
    swayed = panel_errors(fine, fine.total, 2.0, 0.3 + part)
    assert swayed[..., [2, 3, 4]] == pytest.approx(SIZES[2] * 0.3 / (2**ORDER - 1))
    assert np.all(swayed[..., [0, 1, 5]] == 0)


def test_squares_in_other_motions_are_those_of_a_body_that_moves_so():
    given = [0.6, 0.7], [0.5], 0.1
    lines = 0.3 * STIFFNESS
    held = QuadraticRun(floating(), *given, lines)
    own, changed = (QuadraticRun(floating(), *given, True, swayed=swayed) for swayed in (None, held.motions))
    assert own.by_motions is None
    by_pressure = [run.waves.joined()[1] for run in (held, own)]
    # the load that turns with the body is here without that of the lines, as there
    np.testing.assert_allclose(
        changed.by_motions[0][:, 0, 0],
        [(by_pressure[0] - by_pressure[1])[i, 0, i, 0] for i in (0, 1)],
        rtol=1e-9,
        atol=1e-9 * np.abs(by_pressure[0]).max(),
    )


def test_two_headings_in_the_other_order_give_the_conjugate():
    found = of_box()
    swapped = found.total[0].swapaxes(1, 2).conj()
    assert np.abs(found.squares[0] - found.squares[0].swapaxes(1, 2).conj()).max() < 1e-12 * np.abs(swapped).max()
    assert np.isnan(found.total[2, 2:]).all() and np.isfinite(found.total[2, :2]).all()


def test_pairs_approach_the_diagonal_at_the_rate_of_their_difference():
    """T(ω + Ω/2, ω − Ω/2) − T(ω, ω) is odd in Ω but for what is of second order"""
    found = quadratic_forces(floating(), 0.6 + np.linspace(-0.04, 0.04, 9), [0.0], 0.08, True).squares[..., 0, 0, 0]
    real = [found[m, 4 - m // 2].real - found[0, 4].real for m in (4, 8)]
    assert abs(real[1] / real[0]) == pytest.approx(4, rel=0.4)


@pytest.fixture(scope="module")
def surfaces():
    return hull_surfaces(Geometry(box(LENGTH, BEAM, DRAFT, panels=200), None, 20.0))


@pytest.mark.parametrize("points, error, kind", [(4, 2e-6, DIFFERENCE), (6, 1e-10, DIFFERENCE), (6, 1e-10, SUM)])
def test_water_that_moves_with_the_body_needs_no_second_derivatives(monkeypatch, points, error, kind):
    """u = V of rigid motions: ∂φ₂/∂n = −n·(∂α/∂t × X) + ∂(Hx)/∂t·n, for polynomials in the place of ψ

    What four points of the rule at edges, made for powers of r^(2/3), leave in ψ of third degree is gone with six.
    """
    monkeypatch.setattr(hull_interpolation, "POINTS", points)
    whole = box(LENGTH, BEAM, DRAFT, panels=200).whole()  # ψ has none of the symmetries
    surfaces = hull_surfaces(Geometry(whole, None, 20.0))
    rng = np.random.default_rng(1)
    X, omega = rng.normal(size=(2, 6)) + 1j * rng.normal(size=(2, 6)), np.array([0.9, 0.6])
    X[:, 3:] *= 0.1
    hull, line = surfaces.hull, surfaces.waterline
    V = -1j * omega[:, None] * X
    u, rise = np.einsum("fm,mpd->fpd", V, unit_displacements(hull.points)), V @ unit_displacements(line.points)[..., 2]
    flow = HullFlow(omega, X, u, G / omega[:, None] ** 2 * rise, np.zeros(u.shape[:2]), hull)
    powers = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 2, 1], [1, 0, 2], [2, 1, 0]])

    def psi(x):
        return np.prod(x[None] ** powers[:, None], axis=-1)

    def slope(x):
        lower = np.maximum(powers - np.eye(3, dtype=int)[:, None], 0)
        return np.moveaxis(powers.T[..., None] * np.prod(x[None, None] ** lower[:, :, None], axis=-1), 0, -1)

    of_force = np.full(6, kind.of(*omega))
    ends = psi(line.points) + 0j, psi(hull.points) + 0j
    made = HullFlow(of_force, np.eye(6), slope(hull.points) + 0j, *ends, hull)
    found = body_forces(surfaces, flow, np.array([0]), np.array([1]), made, floating(), kind)[0]
    field = np.einsum("fm,mpd->fpd", X, unit_displacements(hull.points))
    turning, second = -1j * omega[:, None] * X[:, 3:], kind.second
    normal = (
        0.25 * -(np.cross(second(turning[1]), field[0]) + np.cross(turning[0], second(field[1])))
        - 1j * of_force[0] * hull.points @ turned_twice(X, second)[0, 1].T
    )
    normal = np.sum(normal * hull.normals, axis=1)
    expected = -1j * RHO * of_force[0] * psi(hull.points) @ (hull.weights * normal)
    off = np.abs(found / expected - 1)
    assert off[:3].max() < 1e-12 and off[3:].max() < error


def hydrostatic_load(motion, weight):
    """(6,) of a tall box about the fixed point CENTRE, by integration over its plan; weight : N and its place"""
    R, (x, w) = Rotation.from_rotvec(motion[3:]).as_matrix(), np.polynomial.legendre.leggauss(6)
    X, Y = np.meshgrid(x * LENGTH / 2 - CENTRE[0], x * BEAM / 2 - CENTRE[1])
    area = np.outer(w, w) * LENGTH * BEAM / 4
    top = -(CENTRE[2] + motion[2] + R[2, 0] * X + R[2, 1] * Y) / R[2, 2]  # from CENTRE, along the body's axis
    low = -DRAFT - CENTRE[2]
    volume = np.sum(area * (top - low))
    at = np.array(
        [np.sum(area * (top - low) * X), np.sum(area * (top - low) * Y), np.sum(area * (top**2 - low**2) / 2)]
    )
    moved = motion[:3] + R @ (at / volume), motion[:3] + R @ (weight[1] - CENTRE)
    forces = RHO * G * volume * np.array([0, 0, 1.0]), np.array([0, 0, -weight[0]])
    return np.concatenate([sum(forces), sum(np.cross(r, F) for r, F in zip(moved, forces, strict=True))])


def test_a_body_turned_and_moved_in_still_water_has_its_hydrostatic_load(surfaces):
    weight = RHO * G * VOLUME, np.array([0.0, 0.0, -3.0])
    problem = floating().__class__(floating().mesh, depth=20.0, rotation_center=tuple(CENTRE))
    e, rng = 1e-3, np.random.default_rng(4)
    motion = rng.normal(size=6) * [1, 1, 1, 0.1, 0.1, 0.1]
    slopes = [hydrostatic_load(e * d, weight) - hydrostatic_load(-e * d, weight) for d in np.eye(6)]
    stiffness = -np.array(slopes).T / (2 * e)
    second = (hydrostatic_load(e * motion, weight) + hydrostatic_load(-e * motion, weight)) / e**2  # of which 0 at rest
    problem = PanelProblem(problem.mesh, depth=20.0, rotation_center=tuple(CENTRE), hydrostatic_stiffness=stiffness)
    about_origin = motion[None] @ problem.transform
    line = np.zeros((1, len(surfaces.waterline.points)), complex)
    velocity = np.zeros((1, len(surfaces.hull.points), 3), complex)
    still = HullFlow(np.array([1e-9]), about_origin + 0j, velocity, line, 0, surfaces.hull)
    found = pressure_pairs(surfaces, still, problem)[0, 0] @ problem.transform.T
    found = found + rotated_pairs(-motion[None] @ stiffness.T, motion[None])[0, 0]
    found = found + still_water_pairs(motion[None], surfaces.hull, CENTRE, stiffness[3, 3], RHO * G)[0, 0]
    assert found.real == pytest.approx(second / 4, abs=1e-5 * np.abs(second).max())


def test_products_of_real_records_have_a_mean_and_a_part_at_twice_their_frequency():
    a, b = np.array([[1 + 2j]]), np.array([[0.5 - 1j]])
    t = np.linspace(0, 2 * np.pi, 65)[:-1]
    record = (a[0, 0] * np.exp(-1j * t)).real * (b[0, 0] * np.exp(-1j * t)).real
    assert products(a, b)[0, 0, 0, 0] == pytest.approx(np.mean(record))
    assert products(a, b, SUM.second)[0, 0, 0, 0] == pytest.approx(2 * np.mean(record * np.exp(2j * t)))


def test_uneven_frequencies_and_a_body_without_inertia_are_refused():
    with pytest.raises(ValueError, match="equal steps"):
        quadratic_forces(floating(), [0.5, 0.6, 0.8], [0.0], 0.1, False)
    with pytest.raises(ValueError, match="on a floating body need its inertia"):
        quadratic_forces(PanelProblem(floating().mesh, depth=20.0), [0.5, 0.6], [0.0], 0.1, True)


def test_estimated_errors_have_the_order_and_the_factors_that_were_fitted():
    """1/(r^1.4 − 1) of the difference of two meshes; 0.08 in heave, roll and pitch, 1.9 times that of sums, 0.33 in
    surge, sway and yaw, 1.3 of what motions make (`tests/bench/pair_errors.py`, `sum_errors.py`)"""
    part = np.zeros((1, 3, 1, 1, 6), complex)
    less = 1 / (3.0**1.4 - 1)
    for kind, factor in ((DIFFERENCE, 0.08), (SUM, 0.08 * 1.9)):
        fine = QuadraticForces(
            np.arange(1.0, 4), np.zeros(1), np.zeros(1), part + 4.0, part, part + 5.0,
            added=np.full((3, 1, 1, 3), 0.2) if kind is DIFFERENCE else None, kind=kind,
        )  # fmt: skip
        known = panel_errors(fine, fine.total + 0.7, 3.0, 0.5 + part)
        steady = factor * np.sqrt(0.7 * less) * (4.0 * 9.0) ** 0.25
        assert known[..., 2:5] == pytest.approx(np.hypot(steady, 1.3 * 0.5 * less))
        if kind is DIFFERENCE:
            assert known[..., [0, 1, 5]] == pytest.approx(0.33 * (0.7 * less * 4.0 * 0.2 * 0.7 * less) ** 0.25)
    rough = resolution_errors(fine, fine.total + 0.7)
    assert rough == pytest.approx(0.7)


def test_errors_of_a_pair_are_means_with_its_neighbours_in_both_frequencies():
    """Of squares, over those that are known: (1 + 0 + …)/n"""
    total = np.zeros((3, 4, 1, 1, 6), complex)
    total[2, 2:], total[1, 3:] = np.nan, np.nan
    forces = QuadraticForces(np.arange(1.0, 5), np.arange(3.0), np.zeros(1), total, total, total)
    other = total.copy()
    other[1, 1] = 6.0
    found = resolution_errors(forces, other)[:, :, 0, 0, 0]
    # of neighbours 3 x 3, less what is beyond the ends or not known
    counts = np.array([[4, 6, 6, 3], [6, 8, 6, 0], [4, 5, 0, 0]], float)
    near = np.array([[1, 1, 1, 0], [1, 1, 1, 0], [1, 1, 0, 0]])
    known = np.isfinite(total[:, :, 0, 0, 0])
    for m in range(3):
        for n in range(4):
            if known[m, n]:
                box_ = known[max(m - 1, 0) : m + 2, max(n - 1, 0) : n + 2]
                counts[m, n] = box_.sum()
    np.testing.assert_allclose(found[known], (6 * np.sqrt(near / np.maximum(counts, 1)))[known])


def test_the_share_of_the_surface_is_of_root_mean_squares_in_surge_and_sway_of_equal_headings():
    """Without the mean drift, which has none"""
    part = np.zeros((2, 2, 2, 2, 6), complex)
    surface = part.copy()
    surface[1, 0, 0, 0, 0], surface[1, 0, 1, 1, 1], surface[1, 0, 0, 1, 0], surface[1, 0, 0, 0, 2] = 3.0, 4j, 50, 60
    squares = part.copy()
    squares[1, 0, 0, 0, 0], squares[0, 0, 0, 0, 0], squares[1, 0, 1, 1, 1] = 5.0, 99.0, 11j
    forces = QuadraticForces(np.array([0.5, 0.6]), np.array([0, 0.1]), np.zeros(2), squares, part, part, surface)
    assert share_of(forces) == pytest.approx(np.hypot(3, 4) / np.hypot(8, 15))


def test_frequencies_of_the_force_are_those_of_even_steps_up_to_the_highest():
    omega = np.array([0.5, 0.6, 0.7])
    assert frequencies_of(omega, 0.15, DIFFERENCE) == pytest.approx([0.0, 0.1])
    assert frequencies_of(omega, 9.0, DIFFERENCE) == pytest.approx([0.0, 0.1, 0.2])
    assert frequencies_of(omega, 1.2, SUM) == pytest.approx([1.0, 1.1, 1.2])
    assert frequencies_of(omega, 9.0, SUM) == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])
    with pytest.raises(ValueError, match=r"sums of frequencies are requested up to 0.99 rad/s; allowed: 1 or above"):
        frequencies_of(omega, 0.99, SUM)
    frequencies_of(np.array([0.5, 0.6, 0.7 + 0.9e-7]), 0.1, DIFFERENCE)
    for uneven in ([0.5, 0.6, 0.7 + 1.2e-7], [0.5], [0.7, 0.6, 0.5]):
        with pytest.raises(
            ValueError,
            match="forces of wave pairs need two or more",
        ):
            frequencies_of(np.array(uneven), 0.1, DIFFERENCE)


def test_pairs_that_tell_the_part_of_the_surface_lie_at_a_fifth_a_half_and_four_fifths_of_the_band(monkeypatch):
    """Half the largest difference apart, in waves of the first heading"""
    asked = []

    def made(problem, omega, headings, highest, moving, surface):
        asked.append((*omega, *headings, highest, surface))
        part = np.ones((2, 2, 1, 1, 6), complex)
        return QuadraticForces(np.array(omega), np.array([0, 0.1]), np.zeros(1), 3 * part, 0 * part, 0 * part, part)

    monkeypatch.setattr(module, "quadratic_forces", made)
    assert module.surface_share(None, [0.5, 1.0, 1.5], [0.3, 0.9], 0.4, False) == pytest.approx(0.25)
    centres = 0.5 + 0.1 + np.array([0.2, 0.5, 0.8]) * 0.8
    expected = [[c - 0.1, c + 0.1, 0.3, 0.3, True] for c in centres]
    assert np.array(asked, float) == pytest.approx(np.array(expected, float))
    asked.clear()
    module.surface_share(None, [0.5, 1.5], 0.3, 9.0, False)  # not more than the band
    assert asked[0][1] - asked[0][0] == pytest.approx(0.5)


@pytest.mark.parametrize("kind", [DIFFERENCE, SUM])
def test_mirror_planes_change_no_part_of_the_force(kind):
    """A quarter, a half and the whole of a box; of first order they are alike to 1e-9, of second order but for stencils
    that end at a mirror plane, which change them by less than the panels err, the less the finer these are"""
    mesh = box(LENGTH, BEAM, DRAFT, counts=(3, 2, 2))
    half = replace(replace(mesh, symmetry="x").whole(), symmetry="y")
    found = []
    for one in (mesh, half, mesh.whole()):
        problem = PanelProblem(one, depth=20.0, inertia_matrix=INERTIA, hydrostatic_stiffness=STIFFNESS)
        found.append(quadratic_forces(problem, [0.6, 0.75], [0.6], 9.0, True, kind=kind))
    for part in ("squares", "bound_wave", "body"):
        quarter, *others = (getattr(forces, part)[1, 0, 0, 0] for forces in found)
        size = np.repeat([np.abs(quarter[:3]).max(), np.abs(quarter[3:]).max()], 3)
        for other in others:
            assert np.all(np.abs(other - quarter) < 1e-2 * size), part
