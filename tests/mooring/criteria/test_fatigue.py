"""Cycles of tension and Miner's sum"""

import numpy as np
import pytest

from hakobune.mooring.criteria.fatigue import Curve, Cycles, curves, dirlik, miner, narrow_band, rainflow_cycles

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


def test_narrow_band_is_the_integral_over_rayleigh_amplitudes():
    sigma, omega = 30.0, 0.7
    moments = [sigma**2 * omega**n for n in (0, 1, 2, 4)]
    x = np.linspace(0, 14 * sigma, 200_001)
    density = x / sigma**2 * np.exp(-0.5 * (x / sigma) ** 2)
    direct = omega / (2 * np.pi) * np.trapezoid(density * (2 * x / 1000.0) ** 3, x) / 1000.0
    assert narrow_band(moments, STRAIGHT, 1000.0) == pytest.approx(direct, rel=1e-6)
    assert dirlik(moments, STRAIGHT, 1000.0) == pytest.approx(direct, rel=1e-6)


@pytest.mark.parametrize("exponent", [3.0, 4.09])
def test_dirlik_agrees_with_rainflow_of_a_simulated_tension(exponent):
    """A slow part and waves, 60 h; a tenth"""
    curve = Curve("straight", "share", exponent, 1000.0)
    omega = np.linspace(0.01, 2.0, 4000)
    spectrum = np.exp(-0.5 * ((omega - 0.06) / 0.02) ** 2) * 4e4 + np.exp(-0.5 * ((omega - 0.7) / 0.12) ** 2) * 1.5e4
    step = omega[1] - omega[0]
    moments = [np.sum(omega**n * spectrum) * step for n in (0, 1, 2, 4)]
    rng = np.random.default_rng(3)
    count, dt = 2**18, 0.8
    grid = 2 * np.pi * np.fft.rfftfreq(count, dt)
    level = np.interp(grid, omega, spectrum, left=0.0, right=0.0) * (grid[1] - grid[0])
    phases = rng.normal(size=(2, len(grid))) * np.sqrt(level)
    record = np.fft.irfft((phases[0] + 1j * phases[1]) / 2, count) * count * 1.0
    assert record.var() == pytest.approx(moments[0], rel=0.05)
    damage = miner(rainflow_cycles(record), curve, 0.0, 1e4)[0] / (count * dt)
    assert dirlik(moments, curve, 1e4) == pytest.approx(damage, rel=0.1)
    assert narrow_band(moments, curve, 1e4) > damage


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
