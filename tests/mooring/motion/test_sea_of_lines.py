"""The sea around moving lines: its table against the direct sum of waves, lines in it against lines driven alone."""

import re
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.lines.dynamics.lumped.surroundings import water_at
from hakobune.mooring.lines.dynamics.simulation import CurrentProfile, FairleadMotion, WaveTrain
from hakobune.mooring.lines.dynamics.simulation import simulate as drive
from hakobune.mooring.lines.dynamics.surroundings import water_arrays
from hakobune.mooring.motion.line_loads import body_lines, fairlead_course
from hakobune.mooring.motion.moving_lines.prepare import dynamic_line
from hakobune.mooring.motion.moving_lines.sea import line_sea, line_water, open_sea, sea_ahead, water_of
from hakobune.mooring.motion.simulation import simulate, wave_components, with_lines_chosen
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Current, ExposedBox, Waves

G, N = 9.80665, 8
IN_SEA = Settings(40.0, ramp=40.0, step=0.1, dynamic_lines=("fore port 1",), dynamic_water="sea")


def components(height, period, spreading=None, count=200):
    return Sea(jonswap(height, peak_period=period), 0.4, spreading).components(count, 1, low=0.3, high=2.2)


def off(parts, depth, amplitude):
    """rms differences of velocities and of accelerations from the direct sum, over their rms, at moving nodes

    The nodes of a line of 200 m swing by up to `amplitude` m, most at the fairlead, on a slow drift.
    """
    k, share = wavenumber(parts.omega, depth, G), np.linspace(0, 1, N)
    number = k * np.stack([np.cos(parts.direction), np.sin(parts.direction)])
    sea = line_sea(parts, number, depth, None, (0.0, 20.0), 20.0)
    water, *room = water_of(sea, N, N)
    waves = WaveTrain(parts.amplitude, 2 * np.pi / parts.omega, parts.direction, parts.phase, depth, 20.0)
    direct, rng = water_arrays(None, waves, G), np.random.default_rng(2)
    rest = np.column_stack([-200 * (1 - share), 30 * share, -depth * (1 - share) ** 2 - 0.5])

    def place(t):
        swing = np.array([np.cos(0.7 * t), 0.6 * np.sin(0.7 * t), 0.8 * np.sin(0.75 * t)])
        return rest + share[:, None] * (np.array([0.25 * t, 0, 0]) + amplitude * swing)

    wrong, whole = np.zeros(2), np.zeros(2)
    for begin in sea_ahead(sea) * np.arange(60):
        speed = (place(begin + 1e-3) - place(begin - 1e-3)) / 2e-3
        open_sea(sea, water, np.array([0, N]), place(begin), speed, tuple(room), begin)
        for t in begin + sea_ahead(sea) * rng.random(4):
            q, found, exact = np.zeros((3, 16)), np.zeros((2, 3, 16)), np.zeros((2, 3, 16))
            q[:, :N] = place(t).T
            water_at(line_water(water, 0, N), q, N, t, *found)
            water_at(direct, q, N, t, *exact)
            wrong += np.sum((found - exact) ** 2, axis=(1, 2))
            whole += np.sum(exact**2, axis=(1, 2))
    return np.sqrt(wrong / whole)


@pytest.mark.filterwarnings("ignore:components from")
@pytest.mark.parametrize(
    ("height", "period", "depth", "amplitude", "spreading"),
    [(2.0, 8.0, 20.0, 0.5, None), (4.5, 10.0, 20.0, 1.5, CosinePower(4)), (6.0, 12.0, 100.0, 2.0, None)],
)
def test_the_table_is_the_direct_sum_of_waves(height, period, depth, amplitude, spreading):
    velocity, acceleration = off(components(height, period, spreading), depth, amplitude)
    assert velocity < 5e-3 and acceleration < 1e-2


@pytest.mark.filterwarnings("ignore:components from")
def test_what_the_table_leaves_out_goes_with_the_square_of_a_node_s_way():
    """Of nodes that move slowly enough for the polynomial in time not to count"""
    parts = components(4.5, 10.0)
    errors = [off(parts, 20.0, amplitude)[0] for amplitude in (1.0, 2.0)]
    assert 1.6 < np.log2(errors[1] / errors[0]) < 2.4, errors


def alone(body, run, number, settings, **water):
    """Pull of a line driven alone along its course in a run, and that in the run, after half of the time"""
    place, velocity = fairlead_course(body_lines(body.system), number, np.hstack([run.motion, run.velocity]))
    anchor = body_lines(body.system).anchor[number]
    line = dynamic_line(body.system.lines[number], anchor, body.system, settings.dynamic_elements)
    t = run.time - run.time[0]
    driven = drive(line, FairleadMotion.table(t, place, velocity), t[-1], tolerance=1e-4, check_mesh=False, **water)
    late = run.time > 0
    return np.interp(t, driven.time, driven.tension_fairlead)[late], run.tension[late, number]


@pytest.mark.filterwarnings("ignore:components from")
def test_a_line_in_a_sea_pulls_as_the_same_line_driven_alone_in_the_same_waves(on_lines):
    weather = Weather((Sea(jonswap(4.0, peak_period=9.0), np.pi),))
    settings = replace(IN_SEA, components=60)
    run = simulate(on_lines, weather, settings, seed=1)
    parts = wave_components(on_lines, weather, settings, 1)
    waves = WaveTrain(
        parts.amplitude, 2 * np.pi / parts.omega, parts.direction, parts.phase, on_lines.reader.depth, settings.ramp
    )
    number = on_lines.system.line_names.index("fore port 1")
    pull, found = alone(on_lines, run, number, settings, waves=waves)
    still, _ = alone(on_lines, run, number, settings)
    rms = np.sqrt(np.mean((found - pull) ** 2))
    assert rms <= 1e-3 * pull.max()
    assert np.sqrt(np.mean((still - pull) ** 2)) > 10 * rms  # the waves do something
    assert any("lines of dynamic_lines move in the incident waves" in line for line in run.findings)


def test_a_line_in_a_regular_wave_on_a_current_pulls_as_the_same_line_driven_alone(on_lines):
    weather = Weather(regular=Waves(3.0, 8.0, 0.5), current=Current(0.8, 0.5 * np.pi))
    settings = replace(IN_SEA, dynamic_lines="all")
    run = simulate(replace(on_lines, hull=ExposedBox(100.0, 50.0, 10.0, 10.0)), weather, settings)
    waves = WaveTrain(1.5, 8.0, 0.5, depth=on_lines.reader.depth, ramp=settings.ramp, carried=(0.0, 0.8))
    current = CurrentProfile([0.0], [[0.0, 0.8]])
    for number in (0, 3):
        pull, found = alone(on_lines, run, number, settings, waves=waves, current=current)
        assert np.sqrt(np.mean((found - pull) ** 2)) <= 1e-3 * pull.max()


def test_a_trial_sees_the_sea_too(on_lines):
    """In ripples the fairleads hardly move: only a current pulls at a line otherwise than its static shape says"""
    ripples = Sea(jonswap(0.1, peak_period=9.0), np.pi)
    weather = Weather((ripples,), current=Current(2.0, 0.5 * np.pi))
    exposed = replace(on_lines, hull=ExposedBox(100.0, 50.0, 10.0, 10.0))
    still, moved = (
        with_lines_chosen(exposed, weather, replace(IN_SEA, dynamic_lines="auto", dynamic_water=water)).words[0]
        for water in ("still", "sea")
    )
    assert "fore port 1 pulls" in moved and "fore port 1 pulls" not in still
    static, moving = (
        float(x) for x in re.search("to (.+) kN in its static shape and (.+) kN in motion", moved).groups()
    )
    assert moving > 1.3 * static
