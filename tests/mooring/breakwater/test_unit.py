"""A unit of finite length on taut lines beside its section, and what its lines are worth."""

import numpy as np
import pytest

from bem.frequency import solve_frequency
from bem.methods.shape_problem import ShapeProblem
from bem.sections.coefficients import section
from mooring.breakwater import unit
from mooring.breakwater.elastic import stiffness_of
from mooring.breakwater.exact import taut_exact
from mooring.breakwater.taut import TautRectangle

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
