"""Slow motion in time, the two scales of the report, and what is said of a run."""

from dataclasses import replace

import numpy as np
import pytest
from boxes import floater_A, turning_water

from hakobune.mooring.single_point.body import SinglePointError
from hakobune.mooring.single_point.equilibria import equilibria
from hakobune.mooring.single_point.history import Record, cycle, line_tensions, settled_after, wave_deviations
from hakobune.mooring.single_point.loads import Loads, WaterLoad
from hakobune.mooring.single_point.scope import highest_third, peak, significant
from hakobune.mooring.single_point.slewing import slew, turned_state
from hakobune.mooring.single_point.two_scale import RING, Steps, WaveBody, two_scale
from hakobune.mooring.single_point.waves import slow_part, split_frequency

FREE = 1e4  # m of hawser: nothing holds the body


def loose(water):
    """Floater A in water alone, on a hawser that never becomes taut"""
    point = floater_A()
    return replace(point, loads=Loads(water), lengths=[FREE])


@pytest.mark.parametrize("turning", [True, False])
def test_motion_in_a_current_is_that_in_still_water_seen_from_the_bank(turning):
    still = turning_water(100.0, 10.0, 2.0)
    if not turning:
        still = WaterLoad(still.table * (np.arange(5) == 0)[:, None], 100.0, False, quadratic=1e9)
    flowing = replace(still, speed=1.3, direction=2.1)
    start = np.array([3.0, -2.0, 0.4, 1.5, 0.3, 0.004])
    one, other = (slew(loose(water), start, 400.0, 20.0, tolerance=1e-9) for water in (still, flowing))
    carried = np.outer(one.time, flowing.velocity)
    assert np.allclose(other.place - carried, one.place, atol=1e-5)
    assert np.allclose(other.heading, one.heading, atol=1e-7)


def test_a_body_without_water_forces_keeps_its_momentum():
    """T differs along and across: with the inertia of turning axes the momentum in space is that at the start"""
    point = loose(WaterLoad(np.zeros((720, 5, 3)), 100.0, False))
    found = slew(point, np.array([0, 0, 0.3, 1.0, 0.5, 0.02]), 300.0, 5.0, tolerance=1e-10)
    own = found.velocity * np.diag(point.mass)
    cos, sin = np.cos(found.heading), np.sin(found.heading)
    in_space = np.stack([cos * own[:, 0] - sin * own[:, 1], sin * own[:, 0] + cos * own[:, 1]])
    assert np.abs(in_space - in_space[:, :1]).max() < 1e-7 * np.abs(in_space).max()


def test_waves_on_a_slow_motion_two_hundred_times_as_large_are_told_apart_without_delay():
    """10 cm in waves of 8 s on a swing of 20 m in 300 s that decays: σ of the waves is 10/√2 cm within 1 %"""
    t, heading = np.arange(0.0, 1500.0, 0.5), 0.4
    slow = 20 * np.exp(-t / 900) * np.cos(2 * np.pi * t / 300)
    motion = np.stack([slow, 0.5 * slow, 0.01 * slow], axis=1)
    surge = 0.1 * np.cos(2 * np.pi * t / 8)
    motion[:, 0] += np.cos(heading) * surge
    motion[:, 1] += np.sin(heading) * surge
    omega = 2 * np.pi / np.linspace(6.0, 12.0, 50)
    split = split_frequency(omega, np.ones(50))
    assert split == pytest.approx(2 * np.pi / 12.0)
    found = slow_part(motion, 0.5, split)
    wave = np.zeros((len(t), 6))
    wave[:, [0, 1, 5]] = motion - found
    nothing = np.zeros((len(t), 1))
    record = Record(t, found[:, :2], np.full(len(t), heading), wave, nothing, nothing, nothing, t)
    sigma = wave_deviations(record, 100.0)
    assert sigma[0] == pytest.approx(0.1 / np.sqrt(2), rel=0.01)
    assert sigma[1] < 1e-3 and sigma[5] < 1e-5  # m, rad
    assert np.all(np.isnan(wave_deviations(record, np.inf)))


@pytest.mark.parametrize("hawser", [0.0, 25.0])
def test_the_heading_of_a_box_decays_from_two_degrees(hawser):
    """Section 3.6.5 of the report: to nothing by 400 s; here to a twentieth"""
    stable = next(one for one in equilibria(floater_A(0.0, hawser)) if one.slewing.stable)
    found = slew(stable.point, turned_state(stable.point, stable.state, np.radians(2)), 600.0, 2.0)
    assert np.degrees(found.heading[0] - stable.heading) == pytest.approx(2.0)
    assert np.abs(np.degrees(found.heading[200:])).max() < 0.1
    tension = line_tensions(stable.point, found.buoy)
    assert np.all(tension.min(axis=0) < stable.lines.tension) and np.all(tension.max(axis=0) > stable.lines.tension)


def wave_body(omega, rng):
    scale = np.diag(floater_A().mass)[[0, 1, 0, 2, 2, 2]]
    added, damping = np.diag(scale), 0.2 * np.diag(scale)
    stiffness = np.diag(scale * np.array([0, 0, 1.2, 0.8, 0.9, 0]))
    force = np.tile(scale * (rng.normal(size=6) + 1j * rng.normal(size=6)), (1, RING, 1))
    one = np.ones(1)
    return WaveBody(
        added, damping, stiffness, force, omega * one, one, 0 * one, 0 * one, 0 * one, 0.0, np.zeros(2), omega
    )


def test_wave_motion_on_a_slack_hawser_is_that_of_the_frequency_domain_to_second_order():
    rng, omega = np.random.default_rng(5), 0.7
    body, point = wave_body(omega, rng), loose(WaterLoad(np.zeros((720, 5, 3)), 100.0, False))
    H = np.linalg.solve(body.stiffness - omega**2 * body.added - 1j * omega * body.damping, body.force[0, 0])
    errors = []
    for fast in (0.5, 0.25):
        found = two_scale(point, np.zeros(6), Steps(200.0, 10.0, fast, 0.0), body)
        late = found.time > 150
        exact = np.real(H * np.exp(-1j * omega * found.time[late, None]))
        errors.append(np.abs(found.wave[late] - exact)[:, 2:5].max() / np.abs(H).max())
    assert errors[0] < 0.05 and np.log2(errors[0] / errors[1]) > 1.8, errors


def test_the_slow_scale_comes_to_the_motion_in_one_equation():
    stable = next(one for one in equilibria(floater_A(30.0)) if one.slewing.stable)
    start = turned_state(stable.point, stable.state, np.radians(2))
    exact = slew(stable.point, start, 200.0, 10.0, tolerance=1e-8)
    found = two_scale(stable.point, start, Steps(200.0, 10.0, 10.0, 0.0, parts=8))
    n = len(found.time)
    assert np.abs(found.heading - exact.heading[:n]).max() < 2e-4
    assert np.allclose(found.lines, line_tensions(stable.point, exact.buoy[:n]), rtol=0.02)


def test_a_motion_that_tears_its_lines_names_the_line():
    point = floater_A()
    with pytest.raises(SinglePointError, match="cannot span"):
        slew(point, np.array([-50.0, 0, 0, 8.0, 0, 0]), 100.0, 1.0)


def test_words_of_a_run_are_those_of_its_numbers():
    t = np.arange(0.0, 900.0, 1.0)
    dying, staying = 0.1 * np.exp(-t / 100) * np.cos(0.1 * t), 0.2 * np.sin(0.05 * t)
    assert not cycle(t, dying).stays and cycle(t, staying).stays
    assert cycle(t, staying).amplitude == pytest.approx(0.2, rel=1e-3)
    assert cycle(t, staying).period == pytest.approx(2 * np.pi / 0.05, rel=1e-3)
    assert np.isnan(settled_after(t, staying, 0.0)) and 250 < settled_after(t, dying, 0.0) < 400
    assert peak(30.0, significant(np.array([10.0, 60.0]), 30.0)) == pytest.approx(60.0)


def test_the_highest_third_of_crests_of_a_record_is_their_mean():
    """Twelve waves with crests of 1 to 12: the mean of 9 to 12; a record that never crosses its mean has its largest"""
    t = np.arange(0, 12, 1e-3)
    record = (1 + np.floor(t)) * np.sin(2 * np.pi * t)
    assert highest_third(np.concatenate([record, record[:300]])) == pytest.approx(10.5, rel=1e-4)
    assert highest_third(np.array([2.0, 2.0, 2.0])) == 2.0
