"""Derivatives of a ship from its proportions: the regressions of Clarke, Gedling and Hine (1983) term by term."""

import math

import numpy as np
import pytest

from hakobune.mooring.loads.ship_derivatives import by_yaw_rate, clarke

L, B, T, BLOCK = 200.0, 30.0, 12.0, 0.75  # T/L 0.06, B/T 2.5, B/L 0.15


def test_derivatives_of_a_ship_by_hand():
    scale = -math.pi * 0.0036
    found = clarke(L, B, T, BLOCK)
    assert found.Y_v == pytest.approx(scale * 1.75)
    assert found.Y_r == pytest.approx(scale * (-0.5 + 0.33 - 0.2))
    assert found.N_v == pytest.approx(scale * 0.644)
    assert found.N_r == pytest.approx(scale * (0.25 + 0.0975 - 0.084))
    assert found.Y_vdot == pytest.approx(scale * (1 + 0.3 - 0.11475))
    assert found.N_rdot == pytest.approx(scale * (1 / 12 + 0.031875 - 0.0495))


def test_force_by_the_yaw_rate_of_a_ship_ahead_abeam_and_astern():
    """Water to π is a ship that goes ahead: Y = ½ρL²V·L Y'_r r and the part −m_x u r taken out again; N brakes"""
    found, rho, added = clarke(L, B, T, BLOCK), 1000.0, 2e6
    force = by_yaw_rate(found, L, rho, added, np.array([math.pi, math.pi / 2, 0.0]))
    speed, rate = 3.0, 0.002
    unit = speed * rate * L  # V (rL)
    sideways = 0.5 * rho * L**3 * speed * rate * found.Y_r + added * speed * rate
    assert force[:, 1] * unit == pytest.approx([sideways, 0.0, -sideways], abs=1e-6 * sideways)
    assert force[:, 2] * unit == pytest.approx(np.full(3, 0.5 * rho * L**4 * speed * rate * found.N_r))
    assert not force[:, 0].any()


@pytest.mark.parametrize(
    ("fine", "wrong", "says"),
    [
        ((L, B, T, 1.0), (L, B, T, 1.001), "block coefficient is 1.001"),
        ((L, B, T, 0.01), (L, B, T, 0.0), "block"),
        ((L, B, 0.1, 0.7), (L, B, 0.0, 0.7), "draft"),
        ((L, 0.1, T, 0.7), (L, 0.0, T, 0.7), "beam"),
        ((0.1, B, T, 0.7), (0.0, B, T, 0.7), "length"),
    ],
)
def test_proportions_at_either_side_of_what_is_a_ship(fine, wrong, says):
    clarke(*fine)
    with pytest.raises(ValueError, match=says):
        clarke(*wrong)
