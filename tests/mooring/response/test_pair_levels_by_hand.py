"""What pairs of waves have beside Newman's rule, of made-up quadratic transfer functions."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.response.bound_wave_drift import slow_share
from hakobune.mooring.response.pair_levels import (
    PairForces,
    SpreadPairForces,
    beside_newman,
    between_headings,
    newman,
    stored_pairs,
)

OMEGA = np.array([0.4, 1.2])
UNIT = np.array([1.0, -2.0, 3.0, 0.5, 0.2, 4.0])


class Between:
    """T = scale (ω₁ + 2 ω₂) UNIT, kept from 0.4 to 1.2 rad/s and to differences of 0.5"""

    omega, difference = OMEGA, np.array([0.0, 0.5])

    def __init__(self, scale=1.0):
        self.scale = scale

    def __call__(self, one, two):
        one, two = np.broadcast_arrays(one, two)
        return (self.scale * (one + 2 * two))[..., None] * UNIT.astype(complex)


def pair(scale=1.0, second=None):
    """Mean drift 4 ω² in surge, −9 ω² in sway, 1 in yaw at 0.4 and 1.2, straight between"""
    drift = np.stack([4 * OMEGA**2, -9 * OMEGA**2, np.ones(2)], axis=1)
    return PairForces(Between(scale), OMEGA, drift, "body", second)


def test_newmans_rule_has_the_sign_of_both_and_nothing_where_they_differ():
    one, two = np.array([4.0, -4.0, 4.0, -4.0, 0.0]), np.array([9.0, -9.0, -9.0, 9.0, 9.0])
    assert newman(one, two) == pytest.approx([6.0, -6.0, 0.0, 0.0, 0.0])


def test_of_a_pair_newmans_part_is_taken_off_the_horizontal_forces_alone():
    found = pair()(0.4, 0.4)
    assert found == pytest.approx(1.2 * UNIT - [0.64, -1.44, 0, 0, 0, 1.0])
    found = pair()(np.array([0.5]), 0.6)[0]
    one, two = (0.64 + (w - 0.4) / 0.8 * (5.76 - 0.64) for w in (0.5, 0.6))
    both = math.sqrt(one * two)
    assert found == pytest.approx((1.7 * UNIT - [both, -2.25 * both, 0, 0, 0, 1.0]) * slow_share(0.1 / 0.5))


@pytest.mark.parametrize(("one", "two", "taken"), [(0.4, 0.45, 1), (0.39, 0.4, 0), (1.2, 1.15, 1), (1.21, 1.2, 0),
                                                   (0.6, 1.1, 0), (0.6, 0.61, 1)])  # fmt: skip
def test_beyond_the_stored_pairs_there_is_nothing_beside_newman(one, two, taken):
    assert (abs(pair().share(one, two)) > 0) == bool(taken)
    assert pair().share(one, two) == pytest.approx(pair().share(two, one))
    assert pair().highest == 0.5


def test_of_two_directions_each_wave_has_its_own_drift():
    second = np.stack([np.full(2, 25.0), np.full(2, -16.0), np.full(2, -1.0)], axis=1)
    found = pair(second=second).newman(np.array([0.4]), np.array([0.4]))[0]
    assert found == pytest.approx([0.8 * 5, -1.2 * 4, 0.0])


def test_components_are_read_between_headings_and_beyond_them_at_the_nearest():
    """Headings 0 and 40°; scales 1, 2, 3, 4 of the pairs (0,0), (0,1), (1,0), (1,1); components towards 10°, −20°"""
    scales = {(0, 0): 1.0, (0, 1): 2.0, (1, 0): 3.0, (1, 1): 4.0}
    pairs = {key: pair(scale) for key, scale in scales.items()}
    spread = SpreadPairForces(pairs, np.radians([0.0, 40.0]), None, "body")
    components = SimpleNamespace(omega=np.array([0.5, 0.6]), direction=np.radians([10.0, -20.0]))
    drift = np.array([[4.0, -1.0, 2.0], [9.0, -4.0, -2.0]])
    found = spread.of_components(components, drift)
    w = np.array([[0.75, 0.25], [1.0, 0.0]])
    for i, one in enumerate((0.5, 0.6)):
        for j, two in enumerate((0.5, 0.6)):
            scale = sum(w[i, a] * w[j, b] * s for (a, b), s in scales.items())
            less = np.zeros(6)
            less[[0, 1, 5]] = newman(drift[i], drift[j])
            wanted = (scale * (one + 2 * two) * UNIT - less) * slow_share((one - two) / 0.5)
            assert found[i, j] == pytest.approx(wanted)
    assert spread.highest == 0.5


def test_weights_of_headings_are_straight_between_and_whole_beyond():
    found = between_headings(np.radians([0.0, 40.0]), np.radians([30.0, 40.0, 41.0, -1.0, 179.0, 360.0]))
    assert found == pytest.approx(np.array([[0.25, 0.75], [0, 1], [0, 1], [1, 0], [0, 1], [1, 0]]), abs=1e-12)


def test_the_spectrum_of_a_sea_of_two_headings_by_a_double_sum():
    """8 ∫ S(ω) S(ω + Ω) Σ w_a w_b |T_ab|² dω, T with Newman's part again"""
    sea = Sea(issc(2.0, mean_period=9.0), math.radians(20.0), CosinePower(400))
    headings = np.radians([-20.0, 20.0, 60.0])
    scales = {(a, b): 1.0 + a + 3 * b for a in range(3) for b in range(3)}
    spread = SpreadPairForces({key: pair(scale) for key, scale in scales.items()}, headings, sea, "body")
    omega, difference = np.linspace(0.45, 1.15, 15), np.array([0.0, 0.1])
    found = spread.spectrum(omega, difference)
    w = sea.directional(headings)
    for d, Omega in enumerate(difference):
        rows = []
        for two in omega:
            one, total = two + Omega, np.zeros(6)
            S = sea.spectrum.density(np.array([two, one]))
            for (a, b), scale in scales.items():
                beside = pair(scale)(one, two)
                beside[[0, 1, 5]] += pair(scale).newman(np.array([one]), np.array([two]))[0]
                total += w[a] * w[b] * np.abs(beside) ** 2
            rows.append(8 * S[0] * S[1] * total if one <= omega[-1] else np.zeros(6))
        assert found[d] == pytest.approx(np.trapezoid(rows, omega, axis=0), rel=1e-9)


def test_newman_has_nothing_beside_itself_and_a_spread_sea_no_pairs_of_one_direction():
    assert beside_newman(None, None, "newman") == (None, ())
    spread = Sea(issc(2.0, mean_period=9.0), 0.0, CosinePower(4))
    with pytest.raises(
        ValueError, match=r'qtf = "full" in a sea of several directions; it needs one long-crested system'
    ):
        stored_pairs(None, spread, "full")


def test_the_mean_drift_of_a_pair_is_that_of_the_first_wave_and_of_the_second_in_its_own_direction():
    """4 ω² at 0.4 of the first; of the second 9 at 0.4 and 25 at 1.2, at 0.45 straight between: √(D₁ D₂)"""
    one = pair()
    two = pair(second=np.array([[9.0, -9.0, 4.0], [25.0, -25.0, 4.0]]))
    first, second = 0.64, 9 + 0.05 / 0.8 * 16
    found = two(np.array([0.4]), 0.45)[0]
    surge, sway = math.sqrt(first * second), -math.sqrt(9 / 4 * first * second)
    assert found == pytest.approx((1.3 * UNIT - [surge, sway, 0, 0, 0, 2.0]) * slow_share(0.05 / 0.5))
    assert two.newman(np.array([0.4]), np.array([0.45]))[0] == pytest.approx([surge, sway, 2.0])
    assert one.newman(np.array([0.4]), np.array([0.4]))[0] == pytest.approx([0.64, -1.44, 1.0])
