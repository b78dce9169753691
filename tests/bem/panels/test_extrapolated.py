"""What two meshes have is carried on to panels without size: less error, estimated, and every law as before."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.checks import at_least_haskind, check, damping_error, largest_error
from hakobune.bem.methods.panel_problem import prepare
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.panels.extrapolated import LEFT, TRUSTED, ExtrapolatedRun, left_over
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.plan import planned

BOX = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15, 28, 30]}
WANT = ("added_mass", "radiation_damping", "excitation_force", "rao", "drift_force", "drift_force_fixed")
OMEGAS, HEADINGS = (0.4, 0.7, 0.9), np.radians([0.0, 40.0])


@pytest.fixture(scope="module")
def runs():
    """[(on panels, exact)] of the series box"""
    waves = {"omegas": [*OMEGAS, 1.2], "headings_deg": [0.0, 40.0]}
    raw = {"water": {"depth": 20.0}, "bodies": [BOX], "waves": waves, "method": "panel"}
    panels = prepare(planned(make_scene(raw)).problem)
    still = {name: getattr(panels.problem, name) for name in ("inertia_matrix", "hydrostatic_stiffness")}
    shape = ShapeProblem(
        method="contour", shape="box", sizes=(100.0, 50.0, 10.0), depth=20.0, tolerance=1e-5, **still
    )  # fmt: skip
    exact = prepare(shape)
    return [tuple(p.run(omega, HEADINGS, WANT, None, DOFS) for p in (panels, exact)) for omega in OMEGAS]


def errors(run, exact):
    """The largest of coefficients and forces, and of damping by its own size"""
    radiation, excitation = run.radiation - exact.radiation, run.excitation - exact.excitation
    return np.array([largest_error(run, radiation, excitation), damping_error(run, radiation)])


def test_less_than_a_third_of_every_error_is_left(runs):
    """Nine of ten random bodies in long waves keep that; the box's panels, a fifth of a wave long, in all of these"""
    for run, exact in runs:
        assert np.all(errors(run.extrapolated, exact) < errors(run, exact) / 3), run.omega


def test_drift_is_nearer_too(runs):
    for run, exact in runs:
        far, near = (np.abs(r.drift(False) - exact.drift(False)).max() for r in (run, run.extrapolated))
        assert near < far, run.omega


def test_laws_hold_within_the_errors_that_are_told(runs):
    """Reciprocity, Haskind's relation and the energy of waves join two quantities, each with its error"""
    for run, _ in runs:
        checks, told = check(run.extrapolated), run.extrapolated.estimated_error()
        assert checks["residual"] < 1e-10 and told < 0.003
        for name in ("reciprocity", "Haskind", "energy"):
            assert checks[name] < 2 * told, (run.omega, name)


def test_estimates_are_a_share_of_those_of_the_mesh_and_the_larger_the_fewer_panels_a_wave_has(runs):
    shares = []
    for run, _ in runs:
        after = run.extrapolated
        shares.append(after.left_over)
        for one, other in zip(after.differences, run.differences, strict=True):
            np.testing.assert_allclose(one, after.left_over * other)
        assert after.tolerances == pytest.approx(after.left_over * run.tolerances / TRUSTED, rel=0.2)
        assert set(after.estimated_errors()) == set(run.estimated_errors()) == set(WANT)
    assert LEFT < shares[0] < shares[1] < shares[2] < 1
    assert left_over(0.0) == LEFT and left_over(1.0) == 1.0


def test_a_frequency_beyond_its_tolerance_is_extrapolated_before_it_takes_more_panels(runs):
    run, _ = runs[1]
    kept = run.within_tolerance()
    assert runs[0][0].within_tolerance() is runs[0][0] and run.tolerances > 1
    assert isinstance(kept, ExtrapolatedRun) and kept.tolerances <= 1 and kept.run is run
    assert set(kept.result()) == set(run.result())


def test_what_is_left_of_an_error_grows_with_the_square_of_panels_in_waves():
    """0.12 + 4 (edge / wave)², at most all of it"""
    for edge, left in ((0.0, 0.12), (0.2, 0.28), (0.4, 0.76), (0.5, 1.0)):
        assert left_over(edge) == pytest.approx(left)


def test_a_third_of_the_tolerance_is_trusted(runs):
    run, _ = runs[0]
    radiation, excitation = run.extrapolated.differences
    errors = [largest_error(run.extrapolated, radiation, at_least_haskind(
        excitation, run.extrapolated.excitation, run.extrapolated.haskind, run.dofs)),
        damping_error(run.extrapolated, radiation) / 0.6]  # fmt: skip
    assert run.extrapolated.tolerances == pytest.approx(3 * max(errors) / 0.01)
