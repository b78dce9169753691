"""Kihara, Kitatani & Todoroki (1975), Rep. PHRI 14(2), 79-110: the paper's theory and its printed numbers.

Printed values are in tonnes-force per metre, w = 1 t/m³, g = 9.8 m/s²; slips of the print are named where they occur.
"""

from contextlib import nullcontext

import numpy as np
import pytest
from scipy.optimize import root

from hakobune.bem.waves import wavenumber
from hakobune.mooring.breakwater import anchors
from hakobune.mooring.breakwater.long_waves import equal_area, fixed_body, line_tensions, long_wave, moment_factor
from hakobune.mooring.breakwater.taut import TautRectangle, added_inertia, taut_long_wave
from hakobune.mooring.breakwater.transmission import equal_cells
from hakobune.mooring.environment.spectra import bretschneider

G, DEPTH, DIAMETER, HEIGHT, FRICTION = 9.8, 10.0, 10.0, 3.0, 0.3
TONNES = {"density": 1 / G, "gravity": G}  # weights of water in t/m³
RIGHT = np.pi / 4
OMEGA = 2 * np.pi / np.arange(3.5, 12.001, 0.05)
# wavelengths of Table 3.1 by period, m; at 9 s it prints 81.3 for 81.7
LENGTHS = {4: 24.7, 5: 36.6, 6: 48.4, 7: 59.8, 8: 70.9, 10: 92.4, 11: 102.9, 12: 113.3, 13: 123.6, 14: 133.9, 15: 144.1}
# the body of the experiments in kgf, cm; the attachment and length of its lines are lost
TESTED = {
    "half": 30.0, "draft": 30.0, "free_draft": 20.2, "depth": 60.0, "z0": -9.5, "inertia": 0.86,
    "attachment": 30.0, "line": 50.0, "density": 1e-3 / 980, "gravity": 980.0,
}  # fmt: skip


def circle(omega, tide=0.0):
    return fixed_body(*equal_area(DIAMETER, DIAMETER / 2 + tide), DEPTH + tide, omega, **TONNES)


def test_wavelengths_are_those_of_table_3_1():
    for period, length in LENGTHS.items():
        assert 2 * np.pi / wavenumber(2 * np.pi / period, DEPTH, G) == pytest.approx(length, rel=2e-3)


def test_circle_transmits_068_of_waves_of_7_s_and_keeps_their_energy():
    at_7 = circle(2 * np.pi / 7)
    assert abs(at_7.transmission) == pytest.approx(0.676, rel=2e-3)
    body = circle(OMEGA)
    assert abs(body.transmission) ** 2 + abs(body.reflection) ** 2 == pytest.approx(1.0, abs=1e-14)


def test_irregular_waves_of_2_m_and_7_s_leave_116_m():
    sea = bretschneider(2.0, significant_period=7.0)
    parts = equal_cells(sea, 2000)
    assert parts.height == pytest.approx(2.0, rel=2e-3)
    for cells in (parts, equal_cells(sea, 16)):  # m₀ = 0.06239 H² of its constants
        assert cells.height == pytest.approx(4 * np.sqrt(0.06239) * 2.0, rel=1e-4)
    assert 4 * parts.deviation(circle(parts.omega).transmission) == pytest.approx(1.160, rel=2e-3)


# Table 6.1, 3 m waves of up to 12 s: read from a chart, within 5 % seaward and 10 % leeward of its own equations
@pytest.mark.parametrize(("tide", "front", "back"), [(-0.5, 11.1, 6.9), (0.0, 11.7, 7.2), (0.5, 12.3, 7.2)])
def test_tensions_over_the_tide_are_those_of_table_6_1(tide, front, back):
    body = circle(OMEGA, tide)
    greatest = [abs(P).max() * HEIGHT / 2 for P in line_tensions(body.horizontal, body.vertical, RIGHT)]
    assert greatest[0] == pytest.approx(front, rel=0.05)
    assert greatest[1] == pytest.approx(back, rel=0.10)


def test_pretension_sinkers_and_piles_are_those_of_chapter_6():
    needed = anchors.pretension_needed(11.1, 3.5)
    assert needed == pytest.approx(14.6)
    front, back = (needed + 3.5 + P for P in (12.3, 7.2))
    assert (front, back) == pytest.approx((30.4, 25.3))
    assert anchors.goes_slack(needed - 0.1, 3.5, 11.1)
    assert not anchors.goes_slack(needed + 0.1, 3.5, 11.1)
    # from here on the print has 24.3, where its own sum is 25.3
    weights = [anchors.sinker(P, RIGHT, FRICTION) for P in (30.4, 24.3)]
    assert weights == pytest.approx([71.7, 57.3], rel=2e-3)
    assert [anchors.sinker_height(W, 10.0, 6.85) for W in weights] == pytest.approx([1.05, 0.84], abs=0.005)
    assert anchors.sinker_height(50.0, 20.0, 6.85) == pytest.approx(0.365, rel=2e-3)
    pile = anchors.pile_capacity(np.pi, 30.0, 3.5)
    assert pile == pytest.approx(109.96, rel=2e-3)
    assert [anchors.pile_spacing(pile, P, RIGHT) for P in (30.4, 24.3)] == pytest.approx([5.1, 6.4], abs=0.05)


def test_one_sinker_under_both_lines_weighs_395_tonnes_per_metre():
    body = circle(OMEGA, 0.5)
    weight = anchors.common_sinker(body.horizontal, body.vertical, FRICTION) * HEIGHT / 2
    assert weight.max() == pytest.approx(39.5, rel=2e-3)


def printed_system(body, omega):
    """Eq. 4.5 and 4.6 of the paper, exp(+iσt), for θ, a − a_T, P_B and P_F of unit waves"""
    wave, alpha = long_wave(body.half, body.draft, body.depth, omega, body.gravity), body.angle
    l, d, l1, S, z0 = body.half, body.draft, body.attachment, body.line, body.z0
    GQ, w, dz = l1 * np.tan(alpha) - (d + z0), 2 * body.density * body.gravity, d + z0
    f_M, GM = moment_factor(wave, l, d, body.depth, z0), l**2 / (3 * d) - d / 2 - z0
    P0, c, s, cot = body.pretension, np.cos(alpha), np.sin(alpha), 1 / np.tan(alpha)
    turning = body.inertia + added_inertia(body)
    sway = -(omega**2) * body.mass * GQ + 2 * P0 * l1 * GQ / (S * (l1 - dz * cot))
    roll = -(omega**2) * turning + w * d * l * GM + 2 * P0 * s * (l1 * cot + dz) * (l1 / (S * c) + 1)
    ikd = 1j * wave.k * d / wave.n
    matrix = [
        [sway, -w * d * wave.f_H, -c, c],
        [0, 0, s, s],
        [roll, w * d * l * f_M, c * GQ, -c * GQ],
        [ikd * (wave.f_H * GQ - f_M * l), 1 - 1j * wave.y_B, 0, 0],
    ]
    return np.linalg.solve(matrix, [0, w * l * wave.f_B, 0, 1])


@pytest.mark.filterwarnings("ignore:.*unstable")
@pytest.mark.parametrize("angle", [20, 44, 60, 89, 91, 120, 158, 170])
def test_closed_form_solves_the_linear_system_of_the_paper(angle):
    body = TautRectangle(angle=np.radians(angle), **TESTED)
    for omega in 2 * np.pi / np.array([1.2, 1.6, 2.4, 3.2]):
        theta, difference, back, front = np.conj(printed_system(body, omega))
        ours = taut_long_wave(body, omega)
        got, asked = [ours.roll, ours.reflection, ours.back, ours.front], [theta, difference, back, front]
        assert got == pytest.approx(asked, rel=1e-10)


def test_vertical_lines_have_the_printed_limit_and_are_met_from_both_sides():
    body = TautRectangle(angle=np.pi / 2, **TESTED)
    omega = 2 * np.pi / np.array([1.6, 2.4, 3.2])
    ours = taut_long_wave(body, omega)
    wave = long_wave(30.0, 30.0, 60.0, omega, 980.0)
    omega_D2 = (30.0 / 20.2 - 1) * 980.0 / 50.0
    lever = (30.0 - 9.5) * wave.f_H / (30.0 * (1 - omega**2 / omega_D2))
    ratio = moment_factor(wave, 30.0, 30.0, 60.0, -9.5) + lever  # K_Q / cos α, text below eq. 4.10
    weight = 1e-3 * 30.0
    # eq. 4.9: (P_F − P_B)/2 = ρgda K_Q / ((1 − iy) cos α), and 1/(1 + iy) is the reflection
    assert (ours.front - ours.back) / 2 == pytest.approx(weight * ratio * ours.reflection, rel=1e-10)
    for side in (-1, 1):
        near = taut_long_wave(TautRectangle(angle=np.pi / 2 + side * 1e-7, **TESTED), omega)
        assert near.front == pytest.approx(ours.front, rel=1e-5)


def rise(body, theta):
    """Height that the centre of gravity gains when the body turns by theta on lines that keep their length"""
    l1, c, s, below = body.attachment, np.cos(body.angle), np.sin(body.angle), -body.draft - body.z0
    ends = np.array([[-l1, below], [l1, below]])
    anchored = ends + body.line * np.array([[-c, -s], [c, -s]])
    turn = np.array([[np.cos(theta), np.sin(theta)], [-np.sin(theta), np.cos(theta)]])
    start = np.array([body.mode[0] / body.mode[1] * theta, 0.0])
    return root(lambda x: np.sum((ends @ turn + x - anchored) ** 2, 1) - body.line**2, start, tol=1e-14).x[1]


@pytest.mark.parametrize(("angle", "z0", "stable"), [(44, -9.5, True), (70, -9.5, True), (158, 0.0, False)])
def test_stiffness_is_the_curvature_of_the_energy_of_the_linkage(angle, z0, stable):
    body = TautRectangle(angle=np.radians(angle), **(TESTED | {"z0": z0}))
    weight, step = 2 * body.density * body.gravity * body.half, 2e-3
    hydrostatic = weight * body.draft * (body.half**2 / (3 * body.draft) - body.draft / 2 - z0)
    curvature = (rise(body, step) + rise(body, -step)) / step**2
    energy = hydrostatic - weight * (body.draft - body.free_draft) * curvature
    assert body.stiffness == pytest.approx(energy * np.cos(body.angle) ** 2, rel=1e-4)
    assert (body.stiffness > 0) == stable
    with nullcontext() if stable else pytest.warns(UserWarning, match="upright position is unstable"):
        taut_long_wave(body, 3.0)


def test_what_cannot_be_moored_is_refused():
    with pytest.raises(ValueError, match="pretension is negative"):
        TautRectangle(angle=1.0, **(TESTED | {"free_draft": 31.0}))
    with pytest.raises(ValueError, match="allowed: above 0 and below 180"):
        TautRectangle(angle=np.pi, **TESTED)
    with pytest.raises(ValueError, match="above the draft"):
        TautRectangle(angle=1.0, **(TESTED | {"depth": 30.0}))
    with pytest.raises(ValueError, match="crossed lines let the body move"):
        line_tensions(1.0, 1.0, np.pi / 2)
