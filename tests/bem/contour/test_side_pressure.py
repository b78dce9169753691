"""Mean drift by the pressure on the sides: its parts by hand, and of a cylinder and a box that of the far field."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.contour import pressure_drift
from hakobune.bem.contour.pressure_drift import _displacements, _form, _square, pressure_error, refined
from hakobune.bem.methods.near_field import near_field_drift
from hakobune.bem.methods.shape_problem import ShapeProblem

WANT = {"excitation_force", "drift_force_fixed", "drift_force", "rao"}


def body(shape, sizes, depth, tolerance=1e-3, **options):
    return ShapeProblem(
        method="contour", shape=shape, sizes=sizes, depth=depth, tolerance=tolerance, **options
    ).prepared()


def test_the_square_of_a_linear_function_is_integrated_over_the_draft():
    a, b, z = np.array([1 + 2j, -3.0]), np.array([0.5j, 2.0]), np.linspace(-4.0, 0.0, 20001)
    exact = np.trapezoid(np.abs(a[:, None] + b[:, None] * z) ** 2, z)
    assert _square(a, b, 4.0) == pytest.approx(exact, rel=1e-6)


def test_a_form_is_of_real_and_imaginary_parts():
    rng = np.random.default_rng(1)
    M, g = rng.normal(size=(3, 3)), rng.normal(size=(3, 2)) + 1j * rng.normal(size=(3, 2))
    M = M + M.T
    assert _form(M, g) == pytest.approx([(g[:, m].conj() @ M @ g[:, m]).real for m in (0, 1)])


def test_points_of_a_side_move_with_the_body():
    """X = u + α × r along the normal, along the contour, and upwards; at z = −2 m"""
    rng = np.random.default_rng(2)
    motion = rng.normal(size=6) + 1j * rng.normal(size=6)
    x, y, normal, along = np.array([3.0]), np.array([-1.0]), np.array([0.6, 0.8]), np.array([-0.8, 0.6])
    a, b, up = _displacements(motion, x, y, normal, along)
    X = motion[:3] + np.cross(motion[3:], [3.0, -1.0, -2.0])
    assert a[0] - 2 * a[1] == pytest.approx(X[:2] @ normal) and b[0] - 2 * b[1] == pytest.approx(X[:2] @ along)
    assert up == pytest.approx(X[2])


def test_a_body_whose_pressure_is_asked_for_is_finer_than_that_of_its_forces():
    one = body("box", (20.0, 10.0, 3.0), 8.0).solver
    ours, finer = one.accuracy, refined(one).accuracy
    assert refined(one) is refined(one)
    assert finer.terms > ours.terms and finer.modes > ours.modes and finer.smallest <= ours.smallest
    assert finer.plan == ours.plan + pressure_drift.DIGIT and finer.extra == ours.extra + 4
    assert finer.kappa == pytest.approx(ours.kappa + 3 * pressure_drift.DIGIT / pressure_drift.KAPPA)


def afloat(volume, plane, roll, pitch, depth=1.5):
    """Of a body whose weight is at the origin, (Ix − V d_B) ρg in roll"""
    C = 1025 * 9.80665 * np.diag([0, 0, plane, roll - volume * depth, pitch - volume * depth, 0])
    return {"inertia_matrix": 1025 * volume * np.diag([1, 1, 1, 9, 36, 36]), "hydrostatic_stiffness": C}


CYLINDER = afloat(np.pi * 108, np.pi * 36, np.pi * 324, np.pi * 324)
BOX = afloat(600.0, 200.0, 20 * 10**3 / 12, 10 * 20**3 / 12)


@pytest.mark.parametrize("shape, sizes, free", [("buoy", (6.0, 3.0), CYLINDER), ("box", (20.0, 10.0, 3.0), BOX)])
@pytest.mark.parametrize("point", [None, (2.0, -1.0, -1.0)])
def test_pressure_on_the_sides_drifts_a_body_as_its_far_field(shape, sizes, free, point):
    """Surge, sway and yaw, held about any point and free about the origin, as near as the parts are solved"""
    one = body(shape, sizes, 8.0, **({"rotation_center": point} if point else free))
    run = one.run(1.1, np.radians([0.0, 35.0, 250.0]), WANT, None, DOFS)
    for moving in (False,) if point else (False, True):
        near, far = near_field_drift(run, moving), run.drift(moving)
        assert np.abs(near[:, :2] - far[:, :2]).max() < 3e-3 * np.abs(far[:, :2]).max()
        assert np.abs(near[:, 2] - far[:, 2]).max() < 3e-3 * 10 * np.abs(far[:, :2]).max()
    assert pressure_error(run) >= run.estimated_error() and pressure_error(run) >= 2e-5
