"""Scaled Bessel functions of the keel gap against those of scipy, below and above where the recurrence turns round."""

import numpy as np
import pytest
from plain import plain
from scipy.special import gamma, jv

bessel = plain("bem.depth_modes.bessel")


@pytest.mark.parametrize("terms", [1, 3, 40])
@pytest.mark.parametrize("nu", [1 / 6, 0.5, 5 / 6])
def test_scaled_functions_are_those_of_half_their_argument(nu, terms):
    """2^ν Γ(1+ν) J_{ν+2p}(x)/x^ν; x = 0.01 with 40 terms goes beyond 1e200 on the way down"""
    turn = 25 + 2 * terms
    x = np.array([0.01, 1.0, 7.3, turn - 0.1, turn + 0.1, 3 * turn])
    found = bessel.scaled_bessel(np.array([0.9, nu]), x, terms)
    for own, order in zip(found, (0.9, nu), strict=True):
        p = np.arange(terms)[:, None]
        true = 2**order * gamma(1 + order) * jv(order + 2 * p, x) / x**order
        assert np.abs(own - true).max() < 1e-12
        assert own[:, :2] == pytest.approx(true[:, :2], rel=1e-10)


def test_factors_of_the_sum_over_orders_are_those_of_gegenbauer():
    """(ν+2k) Γ(ν+k)/(k! Γ(1+ν)), DLMF 10.23.15"""
    for k in (0, 1, 5):
        true = (0.7 + 2 * k) * gamma(0.7 + k) / (gamma(k + 1) * gamma(1.7))
        assert bessel._normalisation(0.7, k) == pytest.approx(true)
