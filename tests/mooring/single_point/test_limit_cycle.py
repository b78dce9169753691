"""Cycles of a slender box in a current alone, which slews at rates from slow to fast by a yaw damping that is added."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from boxes import KNOT, TONF, buoy, floater_A, turning_water

from hakobune.mooring.single_point.body import SinglePointError
from hakobune.mooring.single_point.criterion import routh_hurwitz
from hakobune.mooring.single_point.equilibria import equilibria
from hakobune.mooring.single_point.limit_cycle import limit_cycle
from hakobune.mooring.single_point.loads import Loads
from hakobune.mooring.single_point.slewing import rates, slew, turned_state


@cache
def slender(yaw_damping):
    """Equilibrium head on, which is the only one that holds in part; N m s"""
    length, draft = 300.0, 10.0
    water = turning_water(length, draft, 8.0, slender=3.0, speed=4 * KNOT)
    loads = Loads(replace(water, linear=np.diag([0.0, 0.0, yaw_damping])))
    mass = floater_A().mass * np.diag([1.0, 1.0, 4.0])
    lines = buoy(depth=80.0, weight=0.1 * TONF, tension=100 * TONF, length=600.0)
    point = replace(floater_A(hawser=150.0), loads=loads, mass=mass, ends=[(length / 2, 0)], system=lines)
    return min(equilibria(point), key=lambda one: abs(np.sin(one.heading / 2)))


def test_a_cycle_forgets_its_start_keeps_the_equation_and_is_where_a_run_ends():
    steady = slender(4e9)
    assert not steady.slewing.stable and not routh_hurwitz(steady.quartic)
    one, other = (limit_cycle(steady, np.radians(turn)) for turn in (20.0, -6.0))
    assert one.amplitude == pytest.approx(other.amplitude, rel=2e-4) and one.amplitude > 0.2
    assert one.period == pytest.approx(other.period, rel=2e-5)
    assert np.allclose(one.hawser.max(), other.hawser.max(), rtol=1e-3)
    states, n = one.states[:-1], len(one.states) - 1
    by_time = 2j * np.pi / one.period * np.fft.fftfreq(n, 1 / n)  # balance of harmonics of the period
    slopes = np.fft.ifft(by_time[:, None] * np.fft.fft(states, axis=0), axis=0).real
    exact = np.array([rates(steady.point, state)[0] for state in states])
    assert np.all(np.abs(slopes - exact).max(axis=0) < 2e-3 * np.abs(exact).max(axis=0))
    run = slew(steady.point, turned_state(steady.point, steady.state, np.radians(17)), 1400.0, 5.0, tolerance=1e-4)
    assert 0.5 * np.ptp(run.heading[-130:]) == pytest.approx(one.amplitude, rel=0.01)


def test_near_its_onset_the_period_is_that_of_the_root_and_the_square_of_the_amplitude_goes_with_the_growth():
    """Hopf: both are linear in the growth of a period, 0.15 and 0.26 here; the next term is its square"""
    rates_of_growth, squares, slower = [], [], []
    for damping, start in ((2.92e10, 8.0), (2.7e10, 10.0)):
        steady = slender(damping)
        found = limit_cycle(steady, np.radians(start))
        rates_of_growth.append(steady.slewing.growth * steady.slewing.period)
        squares.append(found.amplitude**2)
        slower.append(1 - found.period / steady.slewing.period)
    ratio = rates_of_growth[1] / rates_of_growth[0]
    assert all(gain < 0.3 for gain in rates_of_growth)
    assert squares[1] / squares[0] == pytest.approx(ratio, rel=rates_of_growth[1])
    assert slower[1] / slower[0] == pytest.approx(ratio, rel=rates_of_growth[1])
    assert all(0 < late < gain for late, gain in zip(slower, rates_of_growth, strict=True))


def test_a_body_that_does_not_slew_has_none():
    stable = next(one for one in equilibria(floater_A()) if one.slewing.stable)
    with pytest.raises(SinglePointError, match="is stable"):
        limit_cycle(stable)
