"""Strips: what they must share with sections and with the whole box, and the long box they are right for."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.sections.coefficients import diffraction, section, section_flow
from hakobune.bem.sections.strips import Strips
from hakobune.bem.waves import incident_wave, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, box_counts

G, RHO = 9.80665, 1025.0
HEADINGS = np.radians([0.0, 30.0, 90.0, 200.0, 270.0])
SURGE, SWAY, HEAVE, ROLL, PITCH, YAW = range(6)


def strips(length=60.0, beam=20.0, draft=5.0, depth=9.0, **kind):
    return Strips(length, beam, draft, depth, 1e-5, **kind)


def test_in_beam_waves_every_metre_has_the_force_of_its_section():
    one = section(20.0, 5.0, 9.0, 0.8)
    whole = strips().first_order(0.8, [np.pi / 2])
    force = (whole.froude_krylov + whole.diffraction)[0]
    assert force[[SWAY, HEAVE, ROLL]] == pytest.approx(60.0 * one.excitation, rel=1e-6)
    assert np.abs(force[[SURGE, PITCH, YAW]]).max() < 1e-9 * np.abs(force).max()
    assert whole.radiation[1:4, 1:4].real == pytest.approx(60.0 * one.added_mass, rel=1e-4)


def test_inverse_strips_are_strips_of_the_box_turned_by_a_right_angle():
    turn = np.zeros((6, 6))
    turn[[0, 1, 2, 3, 4, 5], [1, 0, 2, 4, 3, 5]] = -1, 1, 1, -1, 1, 1
    along = strips(60.0, 20.0).first_order(0.8, HEADINGS)
    across = strips(20.0, 60.0, inverse=True).first_order(0.8, HEADINGS + np.pi / 2)
    scale = np.abs(along.radiation).max()
    assert turn @ along.radiation @ turn.T == pytest.approx(across.radiation, abs=1e-12 * scale)
    for name in ("froude_krylov", "diffraction"):
        force = getattr(along, name) @ turn.T
        assert force == pytest.approx(getattr(across, name), abs=1e-12 * np.abs(force).max())


def test_froude_krylov_forces_are_the_pressure_of_the_wave_over_the_whole_box():
    """∬ −iρω φ_I (n, r × n) dS by Gauss points on the five faces."""
    length, beam, draft, depth, omega = 60.0, 20.0, 5.0, 9.0, 0.8
    ours = strips(length, beam, draft, depth).first_order(omega, HEADINGS, density=RHO, gravity=G).froude_krylov
    x, w = np.polynomial.legendre.leggauss(24)
    faces = []
    for axis in (0, 1):
        for sign in (1, -1):
            normal = np.eye(3)[axis] * sign
            size = np.array([length / 2, beam / 2, draft / 2])
            faces.append((normal, normal * size - [0, 0, draft / 2], np.delete(np.diag(size), axis, axis=0)))
    faces.append((np.array([0, 0, -1.0]), np.array([0, 0, -draft]), np.diag([length / 2, beam / 2, 0])[:2]))
    k = float(wavenumber(omega, depth, G))
    for heading, force in zip(HEADINGS, ours, strict=True):
        total = np.zeros(6, complex)
        for normal, middle, (first, second) in faces:
            points = middle + x[:, None, None] * first + x[None, :, None] * second
            weights = np.outer(w, w) * np.linalg.norm(first) * np.linalg.norm(second)
            pressure = weights * incident_wave(points, heading, omega, k, depth, G)[0] * -1j * RHO * omega
            total[:3] += pressure.sum() * normal
            total[3:] += np.tensordot(pressure, np.cross(points, normal), 2)
        assert force == pytest.approx(total, abs=1e-10 * np.abs(ours).max())


@pytest.mark.parametrize("inverse", [False, True])
def test_damping_absorbs_no_energy(inverse):
    for omega in (0.4, 0.8, 1.2):
        damping = strips(inverse=inverse).first_order(omega, [0.0]).radiation.imag
        assert np.linalg.eigvalsh((damping + damping.T) / 2).min() > -1e-9 * np.abs(damping).max()


def test_a_wave_from_the_other_side_gives_the_mirrored_force():
    mirror = np.array([1, -1, 1, -1, 1, -1])
    for inverse in (False, True):
        one = strips(inverse=inverse).first_order(0.8, HEADINGS)
        other = strips(inverse=inverse).first_order(0.8, -HEADINGS)
        for name in ("froude_krylov", "diffraction"):
            force = getattr(one, name)
            assert getattr(other, name) == pytest.approx(force * mirror, abs=1e-10 * np.abs(force).max())


def test_only_what_is_asked_for_is_filled():
    some = strips().first_order(0.8, [0.5], dofs=[HEAVE, PITCH])
    every = strips().first_order(0.8, [0.5])
    assert some.radiation[PITCH, PITCH] == every.radiation[PITCH, PITCH]
    assert np.flatnonzero(np.abs(some.radiation).sum(0)).tolist() == [HEAVE, PITCH]
    assert np.flatnonzero(some.diffraction[0]).tolist() == [HEAVE, PITCH]


def test_deep_water_is_solved_too_but_its_limits_are_refused():
    deep, finite = (strips(depth=depth).first_order(1.2, [1.0]) for depth in (np.inf, 200.0))
    # at kh = 29 the bed is felt through the local flow only, like (beam / depth)²
    assert np.abs(deep.radiation - finite.radiation).max() < 0.01 * np.abs(deep.radiation).max()
    with pytest.raises(ValueError, match="depth is inf"):
        strips(depth=np.inf).added_mass_limit("zero")


def test_limits_are_those_of_the_sections():
    limit, near = strips().added_mass_limit("infinity"), strips().first_order(20.0, [0.0]).radiation.real
    assert near == pytest.approx(limit, rel=0.05, abs=1e-9 * np.abs(limit).max())


def test_strips_approach_the_panel_method_as_the_box_grows_longer():
    """Per metre the ends matter like B/L: the difference falls with every doubling of the length."""
    beam, draft, depth, omega = 20.0, 4.0, 8.0, 1.0
    missed = []
    for length in (40.0, 80.0, 160.0):
        mesh = box(length, beam, draft, counts=box_counts(length, beam, draft, 500), symmetry="xy")
        want = {"added_mass", "radiation_damping", "excitation_force"}
        panels = solve_frequency(prepare(PanelProblem(mesh, lid(mesh), depth=depth)), omega, [np.pi / 2], want)
        ours = strips(length, beam, draft, depth).first_order(omega, [np.pi / 2])
        force = (ours.froude_krylov + ours.diffraction)[0]
        row = []
        for dof in (SWAY, HEAVE, ROLL):
            assert DOFS[dof] in ("Sway", "Heave", "Roll")
            theirs = panels["excitation_force"][0, dof]
            impedance = panels["added_mass"][dof, dof] + 1j * panels["radiation_damping"][dof, dof] / omega
            row.append([abs(force[dof] / theirs - 1), abs(ours.radiation[dof, dof] / impedance - 1)])
        missed.append(np.ravel(row))
    assert np.all(missed[1] < 0.75 * missed[0] + 0.01), missed
    assert np.all(missed[2] < 0.75 * missed[1] + 0.01), missed
    assert np.all(missed[2] < 0.07), missed


def test_pitch_and_yaw_of_strips_are_heave_and_sway_with_the_square_of_their_arms():
    """∫ x² Z dx = L³/12 Z of sections along, B³/12 of those across; surge is the sway of the others"""
    along, across = section(20.0, 5.0, 9.0, 0.8), section(60.0, 5.0, 9.0, 0.8)
    plain, turned = strips().first_order(0.8, [0.0]).radiation, strips(inverse=True).first_order(0.8, [0.0]).radiation
    Z, Y = (one.added_mass + 1j * one.damping / 0.8 for one in (along, across))
    assert plain[PITCH, PITCH] == pytest.approx(60.0**3 / 12 * Z[1, 1], rel=1e-4)
    assert plain[YAW, YAW] == pytest.approx(60.0**3 / 12 * Z[0, 0], rel=1e-4)
    assert plain[SURGE, SURGE] == pytest.approx(20.0 * Y[0, 0], rel=1e-4)
    assert plain[SURGE, PITCH] == 0.0
    assert turned[ROLL, ROLL] == pytest.approx(20.0**3 / 12 * Y[1, 1], rel=1e-4)
    assert turned[YAW, YAW] == pytest.approx(20.0**3 / 12 * Y[0, 0], rel=1e-4)
    assert turned[PITCH, PITCH] == pytest.approx(20.0 * Y[2, 2], rel=1e-4)
    # sway–roll of the frame x′ = −y, y′ = x is surge–pitch of the box with the other sign: M_y′ = −x … of r × n
    assert turned[SURGE, PITCH] == pytest.approx(-20.0 * Y[0, 2], rel=1e-4)
    assert turned[SWAY, SWAY] == pytest.approx(60.0 * Z[0, 0], rel=1e-4)


def test_diffraction_of_an_oblique_wave_is_the_integral_of_its_sections():
    """Fⱼ = ∫ fⱼ exp(ikx cosβ) dx by Gauss's rule, pitch −∫ x f₃, yaw ∫ x f₂; fⱼ by Haskind's relation of a section"""
    omega, beta = 0.8, np.array([0.4, 2.0])
    flow = section_flow(20.0, 5.0, 9.0, omega, tolerance=1e-5)
    f = diffraction(flow, RHO, np.sin(beta))
    x, w = np.polynomial.legendre.leggauss(40)
    x, w = 30 * x, 30 * w
    wave = np.exp(1j * flow.k * np.outer(np.cos(beta), x))
    even, odd = wave @ w, wave @ (w * x)
    found = strips().first_order(omega, beta, density=RHO).diffraction
    expected = np.stack([f[:, 0] * even, f[:, 1] * even, f[:, 2] * even, -f[:, 1] * odd, f[:, 0] * odd], axis=1)
    assert found[:, 1:] == pytest.approx(expected, rel=1e-9)
