"""Cycles of tension and Miner's sum"""

import numpy as np
import pytest

from hakobune.mooring.criteria.fatigue import Curve, Cycles, curves, miner, rainflow_cycles

STRAIGHT = Curve("straight", "share", 3.0, 1000.0)


def test_cycles_of_the_standard_are_counted():
    """ASTM E1049-85, section 5.4.4: −2, 1, −3, 5, −1, 3, −4, 4, −2"""
    cycles = rainflow_cycles([-2, 1, -3, 5, -1, 3, -4, 4, -2])
    counted = {s: cycles.count[cycles.range == s].sum() for s in np.unique(cycles.range)}
    assert counted == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def test_equal_cycles_use_up_life_in_the_cycles_of_the_curve():
    wave = 500.0 + 50.0 * np.tile([1.0, -1.0], 400)
    cycles = rainflow_cycles(wave)
    assert miner(cycles, STRAIGHT, 0.0, 1000.0)[0] == pytest.approx(cycles.count.sum() / (1000.0 * 0.1**-3), rel=1e-12)


@pytest.mark.parametrize("curve", curves().values(), ids=lambda curve: curve.name)
def test_each_curve_is_stood_by_one_per_cent_fewer_cycles_and_not_by_one_per_cent_more(curve):
    """Equal cycles of a fifth of the breaking load about a tenth of it, N by hand from the row of the table"""
    diameter, breaking = 84.0, 6.4e6
    size = 0.2 * breaking
    area = np.pi / 4 * diameter**2 * (2 if "chain" in curve.name else 1)
    orq = 2.153 * 9.80665 * diameter**2 * (44 - 0.08 * diameter)
    over = area if curve.basis == "stress" else orq if curve.chain else breaking
    stood = curve.constant * 10 ** (0.1 * curve.mean_slope) * (size / over) ** -curve.exponent
    for share, lasts in ((0.99, True), (1.01, False)):
        cycles = Cycles(np.array([size]), np.array([0.1 * breaking]), np.array([share * stood]))
        damage, _ = miner(cycles, curve, diameter, breaking)
        assert damage == pytest.approx(share, rel=1e-9) and (damage <= 1) is lasts


def test_curves_of_the_table_refer_to_area_or_to_breaking_load():
    known = curves()
    assert known["DNV studless chain"].reference(100.0, 1.0) == pytest.approx(2 * np.pi / 4 * 1e4)
    orq = 2.153 * 9.80665 * 100**2 * (44 - 8)
    assert known["API studlink chain"].reference(100.0, 1.0) == pytest.approx(orq)
    rope = known["API spiral strand"]
    assert rope.reference(100.0, 7.0) == 7.0 and rope.strength(0.3) == pytest.approx(10 ** (3.25 - 3.43 * 0.3))


def test_a_record_with_gaps_is_refused():
    with pytest.raises(ValueError, match="gaps"):
        rainflow_cycles([1.0, np.nan, 2.0])
