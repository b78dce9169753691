"""The plate on the water surface: its own laws, and the limit of the panel method."""

import numpy as np
import pytest

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"}
HEADINGS = np.radians([0.0, 40.0])
L, B = 60.0, 40.0
MOVING = [2, 3, 4]


def plate(panels=160, depth=20.0, omega=0.6, mesh=None):
    mesh = box(L, B, 1.0, panels=panels) if mesh is None else mesh
    return solve_frequency(prepare(PanelProblem(mesh, depth=depth, zero_draft=True)), omega, HEADINGS, WANT)


@pytest.mark.parametrize("depth", [12.0, np.inf])
def test_energy_and_haskind_hold_and_improve_with_panels(depth):
    coarse, fine = (plate(n, depth)["checks"] for n in (60, 240))
    for law in ("energy", "Haskind"):
        assert fine[law] < 1e-3
        assert fine[law] < 0.5 * coarse[law]


def test_modes_along_the_plate_move_no_water():
    result = plate()
    for d in (0, 1, 5):
        assert np.all(result["added_mass"][d] == 0)
        assert np.all(result["excitation_force"][:, d] == 0)


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_panel_method_approaches_the_plate_with_the_first_power_of_draft(depth):
    """d/B = 0.05, 0.02, 0.01; the depth under the keel is kept."""
    flat = plate(400, depth)
    errors = {"added_mass": [], "radiation_damping": []}
    for draft in (0.05 * B, 0.02 * B, 0.01 * B):
        mesh = box(L, B, draft, panels=500)
        body = prepare(PanelProblem(mesh, lid(mesh, 8.0), depth=depth + draft))
        solved = solve_frequency(body, 0.6, HEADINGS, set(errors))
        for name, values in errors.items():
            values.append(np.abs([solved[name][d, d] / flat[name][d, d] - 1 for d in MOVING]).max())
    mass, damping = (np.array(e) for e in errors.values())
    orders = np.log(mass[:-1] / mass[1:]) / np.log([2.5, 2.0])
    assert np.all(orders > 0.8), (mass, orders)
    assert mass[-1] < 0.02 and damping[-1] < 0.03, (mass, damping)  # of damping terms of either sign are left


def test_a_round_plate_has_the_damping_of_its_waves_in_long_waves():
    """B₃₃ → ρ g² K k A²/(…): the excitation of a small plate is ρgA_w, and Haskind's relation gives the damping."""
    R, depth, omega, rho, g = 5.0, 30.0, 0.15, 1025.0, 9.80665
    mesh = buoy(R, 0.5, panels=200)
    result = plate(mesh=mesh, depth=depth, omega=omega)
    assert abs(result["excitation_force"][0, 2]) == pytest.approx(rho * g * np.pi * R**2, rel=0.02)


def test_a_hull_without_upright_sides_is_refused():
    mesh = box(L, B, 5.0, panels=60)
    tapered = type(mesh)(
        np.column_stack([mesh.points[:, :2] * (1 + 0.02 * mesh.points[:, 2:]), mesh.points[:, 2]]),
        mesh.corners,
        mesh.symmetry,
    )
    with pytest.raises(ValueError, match="vertical sides"):
        prepare(PanelProblem(tapered, zero_draft=True))


def test_the_limit_of_long_waves_is_continuous():
    body = prepare(PanelProblem(box(L, B, 1.0, panels=160), depth=20.0, zero_draft=True))
    limit = body.added_mass_limit("zero")
    slow = solve_frequency(body, 0.002, [0.0], {"added_mass"})["added_mass"]
    for d in (3, 4):
        assert slow[d, d] == pytest.approx(limit[d, d], rel=1e-4)
    assert np.isinf(limit[2, 2])
    with pytest.raises(ValueError, match="panel method"):
        body.added_mass_limit("infinity")
