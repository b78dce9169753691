"""Forces of waves at a slow position: against direct sums over the components."""

import numpy as np

from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.motion.tables.interpolation import EDGE
from hakobune.mooring.motion.tables.wave_windows import ROWS, fill_window, meet, waves_of
from hakobune.mooring.motion.wave_loads import wave_table
from hakobune.mooring.response.slow_drift import component_drift, newman

ROUNDING = 1e-12  # of phases of a few hundred rad and of sums


def window_of(moored, components, pose, start, mean=False):
    """(ROWS, m) forces and their times (m,) s of a body that stays in a slow pose"""
    reader = moored.reader
    table = wave_table(moored.waves, components, reader.depth, reader.rotation_center, reader.gravity)
    window, waves = np.zeros((ROWS, table.steps)), waves_of(table, mean)
    meet(waves, 0, pose, start)
    fill_window(waves, window, 0, pose, start)
    return window, start + table.step * (np.arange(window.shape[1]) - EDGE)


def sea(direction, spreading=None):
    return Sea(jonswap(3.0, peak_period=9.0), direction, spreading).components(40, seed=3, low=0.35, high=1.6)


def test_forces_at_a_turned_and_shifted_body_are_the_sum_over_its_waves(on_springs):
    parts, pose, reader = sea(0.4, CosinePower(4.0)), np.array([7.0, -3.0, 0.3]), on_springs.reader
    window, t = window_of(on_springs, parts, pose, 123.0)
    k = wavenumber(parts.omega, reader.depth, reader.gravity)
    phase = k * (pose[0] * np.cos(parts.direction) + pose[1] * np.sin(parts.direction)) + parts.phase
    waves = parts.amplitude * np.exp(1j * (phase - np.multiply.outer(t, parts.omega)))
    X = np.array([reader.forces([w], [b - pose[2]])[0, 0] for w, b in zip(parts.omega, parts.direction, strict=True)])
    wanted = (waves @ X).real.T
    assert np.abs(window[:6] - wanted).max() <= 1e-3 * np.abs(wanted).max()
    assert np.abs(window[9] - waves.sum(axis=1).real).max() <= ROUNDING * parts.amplitude.sum()


def test_slow_drift_is_newmans_at_rest(on_springs):
    parts, reader = sea(0.4), on_springs.reader
    window, t = window_of(on_springs, parts, np.zeros(3), 0.0)
    wanted = newman(parts, component_drift(reader, parts), t).T
    assert np.abs(window[6:9] - wanted).max() <= 5e-3 * np.abs(wanted).max()
    alone, _ = window_of(on_springs, parts, np.zeros(3), 0.0, mean=True)
    mean = parts.amplitude**2 @ component_drift(reader, parts)
    assert np.allclose(alone[6:9], mean[:, None], rtol=0, atol=5e-3 * np.abs(mean).max())


def test_forces_pass_from_one_pose_to_the_next_without_a_jump(on_springs):
    parts, reader = sea(0.4), on_springs.reader
    table = wave_table(on_springs.waves, parts, reader.depth, reader.rotation_center, reader.gravity)
    poses = np.array([[0.0, 0, 0], [1.0, 0.5, 0.02], [3.0, 0.0, 0.05]])
    windows, waves = np.zeros((2, ROWS, table.steps)), waves_of(table)
    meet(waves, 0, poses[0], 0.0)
    for i in range(2):
        fill_window(waves, windows[i], i, poses[i + 1], i * table.window)
    end, begin = windows[0, :, -1 - EDGE], windows[1, :, EDGE]
    assert np.allclose(end, begin, rtol=0, atol=ROUNDING * np.abs(windows).max())


def test_forces_of_poses_that_are_close_are_close(on_springs):
    """Their difference is that of their phases: rounding anew at every pose would feed motions that forget little"""
    parts, pose = sea(0.4), np.array([2.0, 1.0, 0.1])
    here, there, beyond = (window_of(on_springs, parts, pose + [d, 0, 0], 0.0)[0] for d in (0.0, 1e-6, 2e-6))
    largest = np.abs(here).max(axis=1)
    assert np.all(np.abs(beyond - 2 * there + here).max(axis=1) <= 10 * ROUNDING * largest)
    assert np.all(np.abs(there - here).max(axis=1) <= 1e-6 * largest)
