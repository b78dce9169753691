"""Turning coefficients of a box: the report's polynomials where they were fitted, the symmetry of a box elsewhere."""

import numpy as np
import pytest
from kinks import assert_slope_is_continuous

from hakobune.mooring.loads.turning import TurningCoefficients, turning_coefficients, turning_force

TESTS = [(2.0, b, h) for b in (10.0, 20.0) for h in (1.2, 1.5, 3.0, 8.0)] + [
    (s, 10.0, 20.0) for s in (1.0, 1.5, 2.25, 3.0)
]
TURNS = (-0.5, -0.2, 0.0, 0.3, 0.5)
CIRCLE = np.radians(np.arange(-180.0, 180.0, 3.0))


def all_three(c, beta, turn):
    return np.array([c.C_x(beta, turn), c.C_y(beta, turn), c.C_m(beta, turn)])


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("degrees", [-60, -35, 0, 20, 60])
def test_printed_polynomials_stand_where_they_were_fitted(degrees, turn):
    """Tables 2.3.4.1 and 2.3.4.2, L/B = 2, B/d = 10, H/d = 1.5, without A₀ of C_y (0.0013) and C_m (−0.0001)."""
    b, r = np.radians(degrees), turn
    C_x = 0.6430 - 0.0522 * b**2 + 0.9659 * r**2 + 0.7215 * b * r - 0.2878 * b**3 * r + 0.6951 * b * r**3
    C_x += -0.1675 * b**4 - 3.1651 * r**4
    C_y = 2.1813 * b - 0.4124 * r + 0.1433 * b**2 * r + 1.1298 * b * r**2 - 0.7754 * b**3 - 0.1215 * r**3
    C_m = 0.3130 * b - 0.2266 * r - 0.0191 * b**2 * r - 0.0144 * b * r**2 - 0.1844 * b**3 + 0.2413 * r**3
    assert np.allclose(all_three(turning_coefficients(2.0, 10.0, 1.5), b, r), [C_x, C_y, C_m], rtol=0, atol=1e-12)


@pytest.mark.parametrize("sizes", TESTS)
def test_a_box_has_no_bow_stern_port_or_starboard(sizes):
    c = turning_coefficients(*sizes)
    for turn in TURNS:
        here = all_three(c, CIRCLE, turn)
        x, y, m = here
        assert np.allclose(all_three(c, CIRCLE + np.pi, turn), [-x, -y, m], atol=1e-12)
        assert np.allclose(all_three(c, -CIRCLE, -turn), [x, -y, -m], atol=1e-12)
        assert np.allclose(all_three(c, np.pi - CIRCLE, -turn), [-x, y, -m], atol=1e-12)


@pytest.mark.parametrize("sizes", TESTS)
def test_nothing_jumps_at_right_angles(sizes):
    """The difference across ±90° is at most the largest slope times the step, down to a step of 1e-8."""
    c = turning_coefficients(*sizes)
    for turn in TURNS:
        around = all_three(c, np.append(CIRCLE, np.pi), turn)
        steepest = 1.1 * np.abs(np.diff(around)).max(axis=1) / np.radians(3.0)
        for side in (-np.pi / 2, np.pi / 2):
            for s in (1e-2, 1e-4, 1e-6, 1e-8):
                jump = np.abs(all_three(c, side + s, turn) - all_three(c, side - s, turn))
                assert np.all(jump <= 2 * s * steepest + 1e-14)


def test_folding_the_polynomial_as_the_report_does_would_jump():
    """At r' = 0 C_x of B/d = 10, H/d = 8 is 0.4786 − 0.1690 β² − 0.0470 β⁴ = −0.22 at 90°, folded 0.22 beyond it."""
    b = np.pi / 2
    assert 2 * abs(0.4786 - 0.1690 * b**2 - 0.0470 * b**4) > 0.4
    assert abs(turning_coefficients(2.0, 10.0, 8.0).C_x(b, 0.0)) < 1e-12


@pytest.mark.parametrize("name", ["C_x", "C_y", "C_m"])
def test_slopes_are_continuous_all_the_way_round(name):
    for sizes in TESTS:
        curve = getattr(turning_coefficients(*sizes), name)
        for turn in TURNS:
            assert_slope_is_continuous(lambda b, f=curve, r=turn: f(b, r), np.radians(np.arange(-180, 180, 15.0)), 1e-2)


@pytest.mark.parametrize("sizes", TESTS)
def test_water_takes_energy_from_a_box_that_does_not_turn(sizes):
    c, L, d = turning_coefficients(*sizes), 100.0, 5.0
    u, v = 0.7 * np.cos(CIRCLE), 0.7 * np.sin(CIRCLE)
    force = turning_force(c, u, v, 0.0, L, d, 1e7, 1e7)
    assert np.all(force[:, 0] * u + force[:, 1] * v < 0)
    assert np.allclose(np.hypot(u, v), 0.7)


@pytest.mark.parametrize("sizes", [t for t in TESTS if t[0] != 1.0])
def test_water_turns_a_drifting_box_broadside_and_brakes_its_turn(sizes):
    c = turning_coefficients(*sizes)
    drifting, turning = (turning_force(c, 1.0, v, r, 100.0, 5.0, 1e7, 1e7) for v, r in ((-0.1, 0.0), (0.0, 0.004)))
    assert drifting[1] > 0 and drifting[2] > 0  # moving to starboard: pushed to port, bow first
    assert turning[2] < 0


@pytest.mark.parametrize("slender", [1.0, 1.5, 2.0, 3.0])
def test_side_force_of_a_turn_is_mostly_the_inertia_of_the_model(slender):
    """M / (½ρ L² d) = 2B/L; added mass of surge and lift change it by less than half."""
    c = turning_coefficients(slender, 10.0, 20.0)
    assert 0.5 < -(c.C_y(0.0, 0.01) / 0.01) / (2 / slender) < 1.5


def test_tests_that_show_nothing_but_inertia_give_no_force():
    """With C_x = m_y/(½ρL²d) β r', C_y = −m_x/(½ρL²d) r' the terms of eq. 3.6.8 cancel for small β."""
    L, d, rho, m_x, m_y = 120.0, 6.0, 1025.0, 4e7, 6e7
    unit = 0.5 * rho * L**2 * d
    c = TurningCoefficients(m_y / unit * np.eye(8)[3], -m_x / unit * np.eye(6)[1], np.zeros(6))
    u, r = 0.8, 0.002
    for beta in (1e-2, 1e-3):
        force = turning_force(c, u * np.cos(beta), -u * np.sin(beta), r, L, d, m_x, m_y, rho)
        assert np.all(np.abs(force[:2]) <= beta**2 * np.array([m_y, m_x]) * u * r)


def test_two_campaigns_agree_in_deep_water():
    """Towed (section 2.3) and fixed in a current (section 2.2): end-on drag 0.93 on B d within a tenth, lever 0.09."""
    c = turning_coefficients(2.0, 10.0, 8.0)
    assert np.isclose(2.0 * c.C_x(0.0, 0.0), 0.93, rtol=0.1)
    x, y, m = all_three(c, np.pi / 4, 0.0)
    assert np.isclose(m / np.hypot(x, y), 0.09, rtol=0.1)


def test_proportions_between_the_tests_give_values_between():
    low, middle, high = (all_three(turning_coefficients(2.0, b, 1.5), 0.5, 0.2) for b in (10.0, 15.0, 20.0))
    assert np.allclose(middle, (low + high) / 2)
    assert np.allclose(turning_coefficients(2.0, 10.0, 50.0).x, turning_coefficients(2.0, 10.0, 8.0).x)
    for name in "xym":
        curve = lambda x, n=name: getattr(turning_coefficients(2.0, 12.0, 1 / x), n)[0]  # noqa: E731
        assert_slope_is_continuous(curve, np.array([1 / 8, 1 / 3, 1 / 1.5]))


def test_beyond_the_tested_turn_the_force_is_that_at_its_end():
    c = turning_coefficients(2.0, 10.0, 3.0)
    end, beyond = (turning_force(c, 0.5, 0.1, r, 100.0, 5.0, 1e7, 2e7) for r in (0.5 * np.hypot(0.5, 0.1) / 100, 1.0))
    assert np.allclose(end, beyond)
    assert c.tested(0.3, 0.5) and not c.tested(0.3, 0.51) and not c.tested(1.2, 0.0) and c.tested(3.0, 0.0)


def test_a_box_at_rest_feels_nothing():
    assert np.all(turning_force(turning_coefficients(2.0, 10.0, 3.0), 0.0, 0.0, 0.1, 100.0, 5.0, 1e7, 2e7) == 0)


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ((2.0, 5.0, 3.0), "B/d = 5 is outside the turning tests .9.75 to 20.5"),
        ((2.0, 10.0, 1.1), "H/d = 1.1 is outside"),
        ((4.0, 5.0, 3.0), "L/B = 4 .*, B/d = 5 .*, H/d = 3 is outside"),
        ((1.5, 10.0, 3.0), "H/d = 3 is outside the turning tests of L/B other than 2"),
        ((3.5, 10.0, 20.0), "L/B = 3.5 .* give a TurningCoefficients of your own"),
        ((np.nan, 10.0, 20.0), "L/B = nan"),
    ],
)
def test_boxes_outside_the_tests_are_refused(sizes, message):
    with pytest.raises(ValueError, match=message):
        turning_coefficients(*sizes)


def test_printed_values_out_of_line_are_named():
    assert "2.25" in turning_coefficients(2.25, 10.0, 20.0).notes[0]
    assert turning_coefficients(2.0, 10.0, 3.0).notes == ()


@pytest.mark.parametrize(
    "slender, deep, low, high", [(2.0, 1.3, 9.75, 20.5), (3.0, 8.1, 9.75, 10.25), (1.0, 8.1, 9.75, 10.25)]
)
def test_boxes_up_to_the_tested_breadths_are_taken(slender, deep, low, high):
    """A fortieth beyond B/d = 10 and, for L/B = 2, 20"""
    for wide in (low, high):
        turning_coefficients(slender, wide, deep)
    for wide in (0.999 * low, 1.001 * high):
        with pytest.raises(ValueError, match=f"B/d = {wide:.4g} is outside the turning tests.* .9.75 to {high:g}"):
            turning_coefficients(slender, wide, deep)
