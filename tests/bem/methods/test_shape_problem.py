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
    assert whole["wall_time"]["solve"] > 0
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


def test_several_shapes_reach_and_draw_as_the_farthest_and_the_deepest():
    """Half diagonals 5 and 6.5 m of boxes, 13 m away, and a buoy of 2 m at 15 m; yaw of a buoy moves no water"""
    from types import SimpleNamespace

    from hakobune.bem.methods.shape_problem import PreparedShapeProblem

    bodies = [SimpleNamespace(place=place) for place in ((0.0, 0.0), (5.0, 12.0), (-9.0, 12.0))]
    shapes = (("box", (8.0, 6.0, 2.0)), ("box", (12.0, 5.0, 3.0)), ("buoy", (2.0, 7.0)))
    several = PreparedShapeProblem(SimpleNamespace(shapes=shapes, bodies=bodies))
    assert several.radius == pytest.approx(6.5 + 13.0) and several.draft == 7.0
    assert several.displacing.tolist() == [True] * 12 + [True] * 5 + [False]
    one = PreparedShapeProblem(SimpleNamespace(shapes=(), shape="buoy", sizes=(4.0, 9.0), bodies=()))
    assert (one.radius, one.draft) == (4.0, 9.0) and one.displacing.tolist() == [True] * 5 + [False]
    assert PreparedShapeProblem(SimpleNamespace(shapes=(), shape="box", sizes=(6.0, 8.0, 1.0))).radius == 5.0


@pytest.mark.parametrize("method, count, few", [("contour", 4, True), ("contour", 3, False), ("strip", 9, False)])
def test_four_frequencies_of_the_contour_method_share_their_estimates(method, count, few):
    body = ShapeProblem(method=method, shape="buoy", sizes=(3.0, 2.0), depth=20.0, omegas=np.linspace(0.5, 1.0, count))
    assert (body.prepared().few_estimates is not None) is few


def test_added_mass_limits_of_several_have_columns_of_what_moves():
    """ρ T A Tᵀ, infinite where both motions have a flux, of the sign of their product"""
    from types import SimpleNamespace

    from hakobune.bem.methods.shape_problem import PreparedShapeProblem

    rng = np.random.default_rng(1)
    A, T, flux = rng.normal(size=(12, 12)), np.eye(12), np.zeros(12)
    T[0, 1], flux[[2, 8]] = 0.5, (4.0, -6.0)
    problem = SimpleNamespace(shapes=("some",), density=1000.0, transform=T, moving=[0, 1, 2, 3, 4, 5])
    body = PreparedShapeProblem(problem)
    vars(body)["solver"] = SimpleNamespace(limit=lambda which: (A, flux))
    found = body.added_mass_limit("zero")
    assert found.shape == (12, 6) and found[2, 2] == np.inf and found[8, 2] == -np.inf
    there = np.isfinite(found)
    assert np.count_nonzero(~there) == 2 and found[there] == pytest.approx((1000 * T @ A @ T.T)[:, :6][there])
