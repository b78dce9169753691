"""Waves that a current carries past a body in time: the same as a body that moves through water at rest."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.motion.simulation import simulate
from hakobune.mooring.motion.slow_damping import drift_damping_ring
from hakobune.mooring.motion.tables.interpolation import EDGE
from hakobune.mooring.motion.tables.wave_windows import HEADINGS, ROWS, fill_window, meet, waves_of
from hakobune.mooring.motion.wave_loads import wave_table
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.on_current.body import on_current
from hakobune.mooring.on_current.waves import Carrier
from hakobune.mooring.response.sea_state import sea_state

TOWARDS = np.radians(40.0)
V = 1.2 * np.array([np.cos(0.9), np.sin(0.9)])
SEA = Sea(jonswap(3.0, peak_period=9.0), TOWARDS)


def window(moored, components, carrier, pose, start, mean=False):
    """(ROWS, m) forces of a window that begins at `start` s, a pose (3,) held"""
    reader = moored.reader
    table = wave_table(moored.waves, components, reader.depth, reader.rotation_center, reader.gravity, carrier=carrier)
    out, waves = np.zeros((ROWS, table.steps)), waves_of(table, mean)
    meet(waves, 0, pose, start)
    fill_window(waves, out, 0, pose, start)
    return table, out


@pytest.mark.filterwarnings("ignore:components from")
def test_forces_at_rest_in_a_stream_are_those_on_a_body_that_moves_the_other_way(on_springs):
    """In still water a body at −Vt meets at t = 40 s what one at rest meets in the stream"""
    parts, t = SEA.components(30, seed=2, low=0.4, high=1.5), 40.0
    _, at_rest = window(on_springs, parts, Carrier(tuple(V)), np.zeros(3), t)
    table, moved = window(on_springs, parts, None, np.array([*(-V * t), 0.0]), t)
    begin = at_rest[:6, EDGE], moved[:6, EDGE]
    assert np.allclose(*begin, rtol=1e-9, atol=1e-9 * np.abs(moved[:6]).max(axis=1))
    assert np.array_equal(table.omega, table.own)


@pytest.mark.filterwarnings("ignore:components from")
@pytest.mark.parametrize("heading", [0.0, 0.7, 2.5])
def test_mean_drift_in_a_stream_is_that_at_rest_less_the_damping_of_the_way_through_the_water(on_springs, heading):
    """And counted once: the damping of the slow velocity over ground is that of still water"""
    parts, pose = SEA.components(400, seed=5, low=0.3, high=on_springs.reader.omega[-1]), np.array([0.0, 0.0, heading])
    cos, sin, carrier = np.cos(heading), np.sin(heading), Carrier(tuple(V))
    flow = np.array([cos * V[0] + sin * V[1], cos * V[1] - sin * V[0]])
    of = [window(on_springs, parts, one, pose, 0.0, True)[1][6:9].mean(axis=1) for one in (None, carrier)]
    weather = Weather((SEA,), carrier=carrier)
    still = replace(weather, carrier=None)
    unit = on_springs.waves.omega, *on_springs.drift_slopes
    rings = [drift_damping_ring(*unit, one) for one in (weather, still)]
    assert np.array_equal(*rings)
    place = heading * HEADINGS / (2 * np.pi) + (len(rings[0]) - HEADINGS) // 2
    B = np.array([np.interp(place, np.arange(len(rings[0])), column) for column in rings[0].T]).reshape(3, 2)
    size = np.hypot(*(B @ flow)[:2]) * np.array([1.0, 1.0, 50.0])
    assert np.all(np.abs(of[1] - of[0] - B @ flow) < 0.01 * size)


@pytest.mark.filterwarnings("ignore:components from")
def test_waves_in_a_run_pass_with_the_frequency_of_encounter(on_springs):
    """Zero crossings of swell of one frequency"""
    from hakobune.mooring.studies.conditions import Waves

    weather = Weather(regular=Waves(1.0, 9.0, TOWARDS), carrier=Carrier(tuple(V)))
    run = simulate(on_springs, weather, Settings(600.0, 100.0), 1)
    late = run.time > 0
    k = float(wavenumber(2 * np.pi / 9.0, on_springs.reader.depth))
    expected = 2 * np.pi / 9.0 + k * (V @ [np.cos(TOWARDS), np.sin(TOWARDS)])
    up = np.flatnonzero((run.wave[late][:-1] < 0) & (run.wave[late][1:] >= 0))
    assert 2 * np.pi * (len(up) - 1) / (0.5 * (up[-1] - up[0])) == pytest.approx(expected, rel=2e-3)


@pytest.mark.filterwarnings("ignore:components from")
def test_mean_offset_over_seeds_is_that_of_the_mean_drift_in_the_frequency_domain(on_springs):
    """Ten runs of ten minutes on linear springs; the band is that of the mean of ten with 95 %"""
    carrier = Carrier(tuple(V))
    state = sea_state(on_current(on_springs.reader, carrier), SEA, 3600.0)
    means = []
    for seed in range(1, 11):
        run = simulate(on_springs, Weather((SEA,), carrier=carrier), Settings(600.0, 150.0, tolerance=1e-2), seed)
        place = run.motion[run.time >= 0][:, :2].mean(axis=0)
        means.append(on_springs.spring[[0, 1], [0, 1]] * place)
    means = np.array(means)
    half = 2.26 * means.std(axis=0, ddof=1) / np.sqrt(len(means))
    assert np.all(np.abs(means.mean(axis=0) - state.slow.drift[:2]) <= half)
    still = state.slow.drift - state.slow.by_current
    assert np.abs(means.mean(axis=0) - still[:2]).max() > 2 * half.max()  # the current is seen
