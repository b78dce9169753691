"""Methods without panels through the same door as the panel method: what is asked alone is what is asked together."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.shape_problem import ShapeProblem

HEADINGS = np.radians([0.0, 40.0])
EVERYTHING = {"added_mass", "radiation_damping", "Froude_Krylov_force", "diffraction_force", "excitation_force"}
FAR_FIELD = {"kochin_radiation", "kochin_diffraction", "drift_force_fixed"}
BODIES = {
    "contour box": ("contour", "box", (100.0, 50.0, 10.0)),
    "contour buoy": ("contour", "buoy", (10.0, 10.0)),
    "strip": ("strip", "box", (100.0, 50.0, 10.0)),
    "inverse-strip": ("inverse-strip", "box", (100.0, 50.0, 10.0)),
}


@pytest.fixture(scope="module", params=BODIES)
def solved(request):
    """A body, what it gives, and all of it asked for at once"""
    method, shape, sizes = BODIES[request.param]
    body = ShapeProblem(method=method, shape=shape, sizes=sizes, depth=20.0, rotation_center=(0, 0, -4.0)).prepared()
    names = EVERYTHING | (FAR_FIELD if method == "contour" else set())
    return body, names, solve_frequency(body, 0.6, HEADINGS, names)


def test_every_quantity_alone_is_what_it_is_among_the_others(solved):
    body, names, whole = solved
    for name in sorted(names):
        alone = solve_frequency(body, 0.6, HEADINGS, {name}, theta=None)[name]
        assert np.abs(alone).max() > 0
        assert np.abs(alone - whole[name]).max() <= 1e-12 * np.abs(whole[name]).max(), name


@pytest.mark.parametrize("dof", DOFS)
def test_one_degree_of_freedom_is_what_it_is_among_the_others(solved, dof):
    body, _, whole = solved
    i = DOFS.index(dof)
    alone = solve_frequency(body, 0.6, HEADINGS, EVERYTHING, dofs=(dof,))
    assert alone["added_mass"][i, i] == pytest.approx(whole["added_mass"][i, i], rel=1e-12, abs=1e-6)
    for name in ("Froude_Krylov_force", "excitation_force"):
        scale = np.abs(whole[name]).max()
        assert np.abs(alone[name][:, i] - whole[name][:, i]).max() <= 1e-12 * scale, name
    assert np.all(np.isnan(np.delete(alone["excitation_force"], i, axis=1)))


def test_the_force_of_the_undisturbed_wave_needs_no_solution(solved, monkeypatch):
    body, _, _ = solved
    run = body.run(0.6, HEADINGS, {"Froude_Krylov_force"}, None, DOFS)
    monkeypatch.setattr(type(run), "first_order", property(lambda _: pytest.fail("it was solved")))
    assert np.abs(run.result()["Froude_Krylov_force"]).max() > 0
