"""Sections of any outline by panels, held to laws, to rectangles by eigenfunctions and to a printed circle."""

import numpy as np
import pytest

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.sections.any_section import any_section, section_flow
from hakobune.bem.sections.coefficients import section
from hakobune.bem.sections.outline import circle, closed, rectangle

# a hull with a bilge of an arc on one side, a knuckle and a flaring side on the other
SKEW = closed(np.array([-6 + 4j, -5, -3 - 3j, 3 - 3j, 5 - 1j, 5 + 4j]), (0, 0, 0, np.tan(np.pi / 8), 0, 0))


def relative(difference, whole):
    """The largest of a matrix of sway, heave and roll over the roots of its diagonal's products"""
    size = np.sqrt(np.abs(np.diag(whole)))
    return np.max(np.abs(difference) / np.outer(size, size))


def test_the_circle_transmits_and_is_pulled_as_the_exact_theory_of_1975_prints_it():
    """Fixed circle, h = D = 10 m, centre at the surface, T = 7.02 s: K_T 0.609, P/wHD 0.456 and 0.159 at 45°"""
    there = any_section(circle(10.0).wetted(5.0), 10.0, 2 * np.pi / 7.02, density=1000.0, gravity=9.8)
    sway, heave = there.excitation[:2] / np.sqrt(2) / (2 * 1000 * 9.8 * 10)
    got = [abs(there.transmission), abs(heave + sway), abs(heave - sway)]
    assert got == pytest.approx([0.609, 0.456, 0.159], abs=1e-3)


@pytest.mark.parametrize(("beam", "draft", "depth", "kd"), [(10, 5, 10, 0.5), (20, 2, 2.3, 0.4), (3, 4, 14, 1.5)])
def test_rectangles_are_those_of_eigenfunctions_within_the_tolerance(beam, draft, depth, kd):
    omega = np.sqrt(9.80665 * kd / draft * np.tanh(kd / draft * depth))
    other = section(beam, draft, depth, omega, tolerance=1e-7)
    for tolerance in (1e-3, 1e-5):
        mine = any_section(rectangle(beam, 2 * draft).wetted(draft), depth, omega, tolerance=tolerance)
        whole = other.added_mass + 1j * other.damping / omega
        assert relative(mine.added_mass + 1j * mine.damping / omega - whole, whole) < tolerance
        assert abs(mine.excitation - other.excitation) == pytest.approx(0, abs=tolerance * abs(other.excitation).max())
        for name in ("transmission", "reflection"):
            assert abs(getattr(mine, name) - getattr(other, name)) < tolerance
        # ρ g n |R|² on each metre, n = C_g/C
        n = 0.5 * (1 + 2 * mine.k * depth / np.sinh(2 * mine.k * depth))
        assert mine.drift == pytest.approx(1025 * 9.80665 * n * abs(other.reflection) ** 2, rel=20 * tolerance)
        assert mine.drift == pytest.approx(other.drift, rel=20 * tolerance)


def test_energy_haskind_and_reciprocity_hold_for_a_skew_section():
    wet = SKEW.wetted(3.0)
    for omega in (0.5, 1.1, 1.9):
        there, flow = any_section(wet, 9.0, omega), section_flow(wet, 9.0, omega)
        (R, T), (back, through) = flow.scattered(+1), flow.scattered(-1)
        assert abs(R) ** 2 + abs(T) ** 2 == pytest.approx(1, abs=1e-6)
        assert through == pytest.approx(T, abs=1e-6) and abs(back) == pytest.approx(abs(R), abs=1e-6)
        assert abs(there.haskind - there.excitation).max() < 1e-6 * abs(there.excitation).max()
        impedance = there.added_mass + 1j * there.damping / omega
        assert relative(impedance - impedance.T, impedance) < 1e-6
        # what a motion radiates to both sides is the power that damps it
        power = 1025 * 9.80665 * flow.omega / flow.k * (abs(there.radiated) ** 2 + abs(there.radiated_back) ** 2)
        n = 0.5 * (1 + 2 * flow.k * 9 / np.sinh(2 * flow.k * 9))
        assert there.damping.diagonal() * omega**2 == pytest.approx(n * power, rel=1e-5)


def test_errors_fall_faster_than_the_second_order_of_the_points():
    wet, errors, points = rectangle(10, 7).wetted(5.0), [], []
    other = section(10, 5, 10, 0.9, tolerance=1e-8).excitation
    for tolerance in (1e-2, 1e-3, 1e-4, 1e-5):
        errors.append(abs(any_section(wet, 10.0, 0.9, tolerance=tolerance).excitation - other).max())
        points.append(len(section_flow(wet, 10.0, 0.9, tolerance=tolerance).shape.points))
    orders = -np.diff(np.log(errors)) / np.diff(np.log(points))
    assert np.all(orders > 1.8), (errors, points)


def test_there_is_no_irregular_frequency_where_the_water_inside_would_resonate():
    omega = np.sqrt(9.80665 * np.pi / 10 / np.tanh(np.pi / 2))
    other = section(10, 5, 10, omega)
    mine = any_section(rectangle(10, 7).wetted(5.0), 10.0, omega)
    assert mine.added_mass.diagonal() == pytest.approx(other.added_mass.diagonal(), rel=1e-5)


def test_what_it_cannot_solve_is_refused():
    wet = circle(10.0).wetted(5.0)
    for depth, omega, words in ((5.0, 1.0, "above the draft"), (10.0, 0.0, "above 0"), (500.0, 9.0, "panels at this")):
        with pytest.raises(ValueError, match=words):
            any_section(wet, depth, omega)


def test_a_long_box_comes_to_its_section_per_metre_as_one_over_its_length():
    wet, misses = rectangle(10, 7).wetted(5.0), []
    there = any_section(wet, 10.0, 0.9)
    for length in (100.0, 200.0, 400.0):
        body = ShapeProblem(method="contour", shape="box", sizes=(length, 10.0, 5.0), depth=10.0).prepared()
        made = solve_frequency(body, 0.9, [np.pi / 2], {"added_mass", "radiation_damping", "excitation_force"})
        sway = made["added_mass"][1, 1] + 1j * made["radiation_damping"][1, 1] / 0.9
        section_sway = there.added_mass[0, 0] + 1j * there.damping[0, 0] / 0.9
        force = made["excitation_force"][0][1]
        misses.append([abs(sway / length - section_sway), abs(force / length - there.excitation[0])])
    orders = -np.diff(np.log2(misses), axis=0)
    assert np.all(abs(orders - 1) < 0.15), orders
