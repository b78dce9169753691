"""Which pairs of frequencies make a force at which frequency, by counting them."""

from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels.pressure_drift.turned_loads import products
from hakobune.bem.second_order.first_order_waves import FirstOrderWaves
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.rotations import turned_twice


@pytest.mark.parametrize("kind, sign", [(DIFFERENCE, -1), (SUM, 1)])
def test_rows_hold_every_pair_once_with_the_higher_frequency_first(kind, sign):
    omega = np.array([0.5, 0.6, 0.7, 0.8])
    rows, found = kind.rows(omega, 9.0), set()
    for m, frequency in enumerate(rows):
        for higher, lower in zip(*kind.pairs(m, 4), strict=True):
            assert omega[higher] + sign * omega[lower] == pytest.approx(frequency)
            found.add((higher, lower))
    assert found == {(i, j) for i, j in product(range(4), range(4)) if i >= j}
    assert kind.of(0.8, 0.6) == pytest.approx(0.8 + sign * 0.6) and kind.negative(0.6) == -sign * 0.6
    few = kind.rows(omega, rows[2] + 1e-9)
    assert few == pytest.approx(rows[:3]) and kind.rows(omega, rows[2] - 1e-3) == pytest.approx(rows[:2])


def test_the_second_wave_of_a_difference_is_conjugate_and_that_of_a_sum_itself():
    z = np.array([1 + 2j])
    assert DIFFERENCE.second(z) == z.conj() and np.all(SUM.second(z) == z)


@pytest.mark.parametrize("second", [np.conj, np.positive])
def test_products_of_two_waves_are_those_of_real_motions(second):
    """Re a e^{−iω₁t} + Re b e^{−iω₂t}: the part of x² at their difference or sum is that of both orders"""
    w, t = np.array([1.0, 0.7]), np.linspace(0, 20 * np.pi, 20001)[:-1]
    a = np.array([0.8 + 0.3j, -0.2 + 0.9j])
    x = np.real(a[:, None] * np.exp(-1j * np.outer(w, t))).sum(axis=0)
    of = w[0] - w[1] if second is np.conj else w[0] + w[1]
    amplitude = 2 * np.mean(x * x * np.exp(1j * of * t))
    T = products(a[:, None], a[:, None], second)[..., 0, 0]
    assert T[0, 1] + (T[1, 0].conj() if second is np.conj else T[1, 0]) == pytest.approx(amplitude, rel=1e-3)


def test_a_rotation_of_second_order_is_half_its_outer_product_less_its_square():
    """exp([α]) = I + [α] + ½[α]² + …, [α]² = αα' − α²I; of one wave the mean"""
    alpha = np.array([0.3, -0.2j, 0.1 + 0.4j])
    motion = np.concatenate([np.zeros(3), alpha])[None]
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    turn = np.real(alpha * np.exp(-1j * t)[:, None])
    cross = np.array([[[0, -z, y], [z, 0, -x], [-y, x, 0]] for x, y, z in turn])
    assert turned_twice(motion)[0, 0] == pytest.approx(0.5 * np.mean(cross @ cross, axis=0), abs=1e-12)


@pytest.mark.parametrize("moving, wanted", [
    (True, {"excitation_force", "rao", "added_mass", "drift_force"}),
    (False, {"excitation_force", "drift_force_fixed"}),
])  # fmt: skip
def test_the_drift_of_single_waves_is_wanted_where_forces_are_of_differences(moving, wanted):
    """It is the force of a wave with itself; a moving body needs its motions and added mass for either kind"""
    for kind, more in ((DIFFERENCE, wanted), (SUM, {name for name in wanted if "drift" not in name})):
        held = SimpleNamespace(moving=moving, kind=kind)
        assert FirstOrderWaves.wanted.fget(held) == more
