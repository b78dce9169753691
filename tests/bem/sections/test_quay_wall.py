"""A body beside a vertical wall that reflects all waves, by its image."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.sections.coefficients import section
from hakobune.bem.sections.quay import Floating, floating, force_before_wall, magnification, motions_before_wall
from hakobune.bem.waves import group_factor
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

WANT = {"added_mass", "radiation_damping", "excitation_force"}
OMEGA, DEPTH, HEADING = 0.6, 20.0, 0.7
TABLE = 1e-5  # of the largest entry: the tables of the Green function, which depend on the extent of the mesh


def solved(mesh, lid_mesh=None, headings=(HEADING,), **options):
    return solve_frequency(prepare(PanelProblem(mesh, lid_mesh, depth=DEPTH, **options)), OMEGA, headings, WANT)


@pytest.fixture(scope="module")
def beside():
    mesh = box(60, 30, 8, counts=(5, 3, 3))
    return solved(mesh, lid(mesh), wall=-25.0)


def test_a_body_fastened_to_the_wall_is_half_of_one_that_straddles_it():
    whole = box(60, 30, 8, counts=(5, 3, 3), symmetry="xy")
    half = replace(replace(whole, symmetry="x").whole(), symmetry="")
    wall, both = solved(half, wall=0.0), solved(whole, headings=(HEADING, -HEADING))
    for d in (0, 2, 4):
        assert wall["added_mass"][d, d] == pytest.approx(0.5 * both["added_mass"][d, d], rel=TABLE)
        assert wall["radiation_damping"][d, d] == pytest.approx(0.5 * both["radiation_damping"][d, d], rel=TABLE)
        assert wall["excitation_force"][0, d] == pytest.approx(0.5 * both["excitation_force"][:, d].sum(), rel=TABLE)


def test_reciprocity_and_haskind_hold_beside_a_wall(beside):
    assert beside["checks"]["reciprocity"] < 0.01
    assert beside["checks"]["Haskind"] < 0.01


def test_a_mirror_plane_across_the_wall_changes_nothing(beside):
    mesh = box(60, 30, 8, counts=(5, 3, 3)).whole()
    other = solved(mesh, lid(box(60, 30, 8, counts=(5, 3, 3))).whole(), wall=-25.0)
    for name in ("added_mass", "radiation_damping", "excitation_force"):
        scale = np.abs(beside[name]).max(axis=0)
        assert np.all(np.abs(other[name] - beside[name]) <= TABLE * scale.max())


def test_wall_couples_sway_and_heave(beside):
    assert abs(beside["added_mass"][1, 2]) > 0.01 * beside["added_mass"][2, 2]


def test_walls_on_both_sides_are_mirror_images(beside):
    mesh = box(60, 30, 8, counts=(5, 3, 3))
    other = solved(mesh, lid(mesh), headings=(-HEADING,), wall=25.0)
    parity = np.array([1, -1, 1, -1, 1, -1])
    scale = np.abs(beside["added_mass"]).max()
    assert np.abs(other["added_mass"] * np.outer(parity, parity) - beside["added_mass"]).max() < TABLE * scale
    gap = other["excitation_force"] * parity - beside["excitation_force"]
    assert np.abs(gap).max() < TABLE * np.abs(beside["excitation_force"]).max()


def test_far_field_quantities_are_refused_beside_a_wall():
    mesh = box(60, 30, 8, counts=(2, 2, 2))
    with pytest.raises(ValueError, match="wall"):
        solve_frequency(prepare(PanelProblem(mesh, depth=DEPTH, wall=-25.0)), OMEGA, [0.0], {"drift_force_fixed"})


def test_a_long_box_before_the_wall_bears_what_its_section_does_with_repeated_reflection():
    """Ends let waves past: the gap closes as the box grows longer; the report's single reflection stays off."""
    beam, draft, wall, omega = 50.0, 10.0, 50.0, 0.65
    part = section(beam, draft, DEPTH, omega)
    dofs = ("Sway", "Heave", "Roll")
    gaps = []
    for length, panels in ((200.0, 400), (800.0, 800)):
        mesh = box(length, beam, draft, panels=panels)
        body = prepare(PanelProblem(mesh, lid(mesh, 12.0), depth=DEPTH, wall=wall))
        force = solve_frequency(body, omega, [np.pi / 2], {"excitation_force"}, None, dofs)["excitation_force"][0, 1:4]
        gaps.append(np.abs(force / length - force_before_wall(part, wall)) / np.abs(part.excitation))
    single = np.abs(force / length - force_before_wall(part, wall, repeated=False)) / np.abs(part.excitation)
    assert np.all(gaps[1] < 0.04), gaps
    assert np.all(gaps[1] < gaps[0] / 3), gaps
    assert np.all(single > 2 * gaps[1]), (single, gaps)


def afloat(beam, draft, omega, damping=0.0):
    """A box of uniform section with its centre of gravity in the waterline, and its `Floating`"""
    part = section(beam, draft, DEPTH, omega)
    mass = part.density * beam * draft
    inertia = np.diag([mass, mass, mass * 15.55**2])
    roll = mass * part.gravity * (beam**2 / (12 * draft) - draft / 2)
    stiffness = np.diag([0.0, part.density * part.gravity * beam, roll])
    return part, floating(part, inertia, stiffness, damping)


@pytest.mark.parametrize("omega", [0.3, 0.5, 0.65, 0.8, 1.0])
def test_waves_of_a_floating_body_carry_the_energy_of_the_incident_one(omega):
    """and follow from the phases of its heave and of its sway, which roll shares"""
    _, body = afloat(50.0, 10.0, omega)
    assert abs(body.transmission) ** 2 + abs(body.reflection) ** 2 == pytest.approx(1, abs=1e-10)
    turn = np.angle(body.motions[1]) - np.angle(body.motions[0])
    assert abs(body.transmission) == pytest.approx(abs(np.sin(turn)), abs=1e-7)
    assert abs(body.reflection) == pytest.approx(abs(np.cos(turn)), abs=1e-7)


def test_a_lossy_body_keeps_less_than_the_energy_of_the_incident_wave():
    part, body = afloat(50.0, 10.0, 0.5, np.diag([1e4, 1e5, 1e7]))
    lost = 1 - abs(body.transmission) ** 2 - abs(body.reflection) ** 2
    speed = part.omega * np.abs(body.motions)
    power = part.density * part.gravity * 0.5 * part.omega / part.k * float(group_factor(part.k, DEPTH))
    assert lost == pytest.approx(0.5 * (speed**2) @ [1e4, 1e5, 1e7] / power, rel=1e-9)


def test_the_reports_factor_is_that_of_a_single_reflection_on_heave():
    _, body = afloat(50.0, 10.0, 0.5)
    for distance in np.linspace(30.0, 150.0, 25):
        single = motions_before_wall(body, distance, repeated=False)
        assert magnification(body, distance) == pytest.approx(abs(single[1] / body.motions[1]), rel=1e-12)
        assert magnification(body, distance) <= 1 + abs(body.transmission) + 1e-12


def transparent(k=0.05):
    """A body so small and light that waves pass it whole, and that goes with the water: heave η, sway iη of its
    particles in deep water, roll ∂η/∂y = ikη"""
    return Floating(k, np.array([1j, 1.0, 1j * k]), 1.0, 0.0)


def test_what_goes_with_the_water_before_a_wall_has_its_motions_in_a_standing_wave():
    """η = e^{iky} + e^{2ikP} e^{−iky}: at a crest of it (kP = π) heave is twice that of the wave and nothing sways or
    rolls; at a node (kP = π/2) nothing heaves, and slope and sway are twice those of the wave."""
    body = transparent()
    at_crest = motions_before_wall(body, np.pi / body.k)
    assert at_crest == pytest.approx([0.0, 2.0, 0.0], abs=1e-12)
    at_node = motions_before_wall(body, 0.5 * np.pi / body.k)
    assert at_node == pytest.approx([2j, 0.0, 2j * body.k], abs=1e-12)


@pytest.mark.parametrize("distance", [40.0, 77.0])
def test_forces_before_a_wall_are_of_waves_from_both_sides_of_which_one_is_mirrored(distance):
    """Waves from the wall press a symmetric section as its mirror image: sway and roll change their sign.

    Its own far field gives both forces: F = ±2iρg (n/k) η of what it radiates towards either side (Haskind)."""
    part = section(50.0, 10.0, DEPTH, 0.5)
    turn = np.exp(2j * part.k * distance)
    returned = part.transmission * turn
    for _ in range(400):  # every reflection, one after the other
        returned = turn * (part.transmission + part.reflection * returned)
    size = 2j * part.density * part.gravity * float(group_factor(part.k, DEPTH)) / part.k
    of_waves_ahead, of_waves_back = -size * part.radiated_back, -size * part.radiated
    assert of_waves_ahead == pytest.approx(part.excitation, rel=1e-4)
    both = of_waves_ahead + returned * of_waves_back
    assert force_before_wall(part, distance) == pytest.approx(both, rel=1e-4)
