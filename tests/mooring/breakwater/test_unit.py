"""A unit of finite length on taut lines beside its section, and what its lines are worth."""

import numpy as np
import pytest

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.sections.coefficients import section
from hakobune.mooring.breakwater import unit
from hakobune.mooring.breakwater.elastic import stiffness_of
from hakobune.mooring.breakwater.exact import taut_exact
from hakobune.mooring.breakwater.taut import TautRectangle, added_inertia

BODY = TautRectangle(
    half=5.0, draft=5.0, free_draft=3.4, depth=10.0, z0=-1.6, inertia=6e5, angle=np.radians(60), attachment=5.0,
    line=5.0 / np.sin(np.radians(60)),
)  # fmt: skip
OMEGA = 0.9


def test_lines_and_water_of_a_unit_are_those_of_its_section_per_metre():
    length, EA = 60.0, 2e7
    ours = unit.buoyancy(BODY, length, BODY.z0) + unit.line_matrix(BODY, length, BODY.z0, 5.0, EA)
    theirs, _ = stiffness_of(BODY, EA)
    assert ours[1:4, 1:4] == pytest.approx(length * theirs, rel=1e-12, abs=1e-3)
    assert abs(ours - ours.T).max() < 1e-9 * abs(ours).max()
    turned = unit.line_matrix(BODY, length, BODY.z0, 1e-2, EA)[4, 4]
    assert turned > length**3 / 12 * theirs[1, 1] * 0.5  # heave of the ends


def test_what_the_lines_pull_on_a_long_unit_comes_to_the_section_like_one_over_its_length():
    misses, there = [], section(10.0, 5.0, 10.0, OMEGA)
    taut = taut_exact(BODY, there)
    for length in (100.0, 200.0, 400.0):
        sizes = (length, 10.0, 5.0)
        body = ShapeProblem(method="contour", shape="box", sizes=sizes, depth=10.0, tolerance=1e-4).prepared()
        made = solve_frequency(body, OMEGA, [np.pi / 2], {"added_mass", "radiation_damping", "excitation_force"})
        stiffness = unit.buoyancy(BODY, length, 0.0) + unit.line_matrix(BODY, length, 0.0, 5.0)
        mass = unit.inertia(BODY, length, 0.0) + made["added_mass"] + 1j * made["radiation_damping"] / OMEGA
        motion = np.linalg.solve(stiffness - OMEGA**2 * mass, made["excitation_force"][0])
        front, back = unit.tensions(BODY, length, 0.0, 5.0, None, motion)
        assert abs(front - front[0]).max() < 1e-6 * abs(front[0])  # in beam seas all lines alike
        misses.append([abs(front[0] - taut.front), abs(back[0] - taut.back)])
    orders = np.log2(np.divide(misses[:-1], misses[1:]))
    assert np.all(abs(orders - 1) < 0.1), orders


def test_the_inertia_of_a_unit_is_that_of_its_section_drawn_out_along_it():
    """M = Σ m [[1, −R], [R, −R R]] of points at r, R r× : four in each section that have its mass, its centre of mass
    and the same radius of gyration about both axes, spread over the length by Gauss's rule.

    Breadth and height of the four are equal, so each axis in the plane has half of the polar moment."""
    length, center = 60.0, -3.0
    arm = np.sqrt(BODY.inertia / BODY.mass / 2)  # of points at (±a, z₀ ± a): polar moment 2 a² m
    x, w = np.polynomial.legendre.leggauss(4)
    M = np.zeros((6, 6))
    for place, share in zip(0.5 * length * x, 0.5 * length * w, strict=True):
        for y, z in ((arm, arm), (arm, -arm), (-arm, arm), (-arm, -arm)):
            r = np.array([place, y, BODY.z0 + z - center])
            R = np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
            M += BODY.mass * share / 4 * np.block([[np.eye(3), -R], [R, -R @ R]])
    assert unit.inertia(BODY, length, center) == pytest.approx(M, rel=1e-12, abs=1e-6 * M[0, 0])


def test_water_under_a_rolling_keel_has_the_inertia_of_its_flow():
    """Long waves: under a keel that rolls with θ̇ the water flows with q(y) = θ̇ (l²/6 − y²/2), continuity with
    the same pressure at both edges, and rises with θ̇ y ζ/s over the gap s: twice the kinetic energy over θ̇²."""
    l, s, rho = BODY.half, BODY.depth - BODY.draft, BODY.density
    y, w = np.polynomial.legendre.leggauss(20)
    y, w = l * y, l * w
    along = w @ (l**2 / 6 - y**2 / 2) ** 2 / s
    upright = w @ y**2 * s / 3
    assert added_inertia(BODY) == pytest.approx(rho * (along + upright), rel=1e-12)
