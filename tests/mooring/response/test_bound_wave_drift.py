"""Slow force of bound long waves: from solved frequencies, in spectra and records, and by estimate."""

import numpy as np
import pytest

from hakobune.bem.kernels.progress import progress_callback
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.long_wave_forces import LongWaveBody
from hakobune.bem.time_domain import kept_fits
from hakobune.meshing.shapes import box
from hakobune.mooring.environment.sea import Components
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.response.bound_wave_drift import bound_wave_forces, record, slow_share
from hakobune.mooring.response.slow_drift import force_spectrum, force_spectrum_with

DEPTH, HEADING, BAND, MEAN = 20.0, np.radians(150.0), (0.45, 1.2), 0.7

HORIZONTAL = [0, 1]


@pytest.fixture(scope="module")
def problem():
    return PanelProblem(box(100, 50, 10, panels=60), depth=DEPTH)


@pytest.fixture(scope="module")
def forces(problem):
    return bound_wave_forces(problem, BAND, MEAN, HEADING)


@pytest.mark.parametrize("one, two", [(0.75, 0.72), (0.55, 0.45), (0.5, 0.6), (1.2, 1.0)])
def test_between_solved_frequencies_it_is_the_force_of_the_pair(problem, forces, one, two):
    bound = bound_waves((one, HEADING), (two, HEADING), DEPTH)
    sign = np.sign(bound.omega)
    exact = LongWaveBody(problem).forces(abs(bound.omega), sign * bound.number)[0] * bound.amplitude
    found = forces(one, two) / slow_share(bound.omega / forces.highest)
    exact = exact if sign > 0 else exact.conj()
    for part in (slice(0, 3), slice(3, 6)):
        assert np.abs(found - exact)[part].max() < 3e-3 * np.abs(exact[part]).max()


def test_seas_of_other_periods_and_directions_share_the_solutions_of_a_body(problem, tmp_path, monkeypatch):
    """Highest differences of 0.36 and 0.4 rad/s end at 1.25⁻⁴ = 0.4096, one of 0.42 at 0.512; each is right"""
    monkeypatch.setattr(kept_fits, "cache_folder", lambda *_: tmp_path)
    solved = []
    with progress_callback(lambda stage, what: solved.append(what[1])):
        for mean, heading, count in ((0.6, 0.3, 10), (2 / 3, 2.0, 10), (0.7, 0.3, 20)):
            found = bound_wave_forces(problem, (0.5 * mean, 2 * mean), mean, heading)
            assert len(solved) == count
            assert found.highest == pytest.approx(0.6 * mean) and found.end == pytest.approx(
                1.25 ** (-4 + (mean == 0.7))
            )
            bound = bound_waves((1.1 * mean, heading), (mean, heading), DEPTH)
            exact = LongWaveBody(problem).forces(bound.omega, bound.number)[0] * bound.amplitude
            assert np.abs(found(1.1 * mean, mean) - exact)[:2].max() < 3e-3 * np.abs(exact[:2]).max()


def test_the_force_of_a_pair_is_hermitian_and_none_beyond_the_highest_difference(forces):
    omega = np.linspace(*BAND, 7)
    T = forces(omega[:, None], omega)
    np.testing.assert_allclose(T, T.swapaxes(0, 1).conj(), atol=1e-9 * np.abs(T).max())
    assert not forces(BAND[1], BAND[0]).any() and forces(0.7, 0.6).any()


def test_a_record_is_the_sum_over_pairs(forces):
    rng = np.random.default_rng(4)
    omega = np.sort(rng.uniform(*BAND, 12))
    parts = Components(omega, rng.uniform(0.1, 0.5, 12), rng.uniform(0, 2 * np.pi, 12), np.full(12, HEADING))
    t, found = record(forces, parts, 300.0)
    assert (t[0], t[-1]) == (0.0, 300.0) and np.diff(t).max() <= 2 * np.pi / forces.highest / 12
    wave = parts.amplitude * np.exp(1j * (parts.phase - np.multiply.outer(t, omega)))
    T = forces(omega[:, None], omega)
    T[np.arange(12), np.arange(12)] = 0.0
    exact = np.einsum("ti,ijd,tj->td", wave, T, wave.conj())
    assert np.abs(exact.imag).max() < 1e-9 * np.abs(exact).max()
    assert found[:, HORIZONTAL] == pytest.approx(exact.real[:, HORIZONTAL], abs=1e-3 * np.abs(exact.real[:, 0]).max())


def test_variance_of_records_is_that_of_the_spectrum(forces):
    """12 records with random amplitudes; 95 % of their mean variances lie within 1.96 standard errors"""
    spectrum = jonswap(2.0, peak_period=9.0)
    omega = np.linspace(*BAND, 40)
    step, rng, found = omega[1] - omega[0], np.random.default_rng(5), []
    for _ in range(12):
        size = np.sqrt(spectrum.density(omega) * step) * rng.rayleigh(size=len(omega))
        parts = Components(omega, size, rng.uniform(0, 2 * np.pi, len(omega)), np.full(len(omega), HEADING))
        found.append(record(forces, parts, 2 * np.pi / step)[1][:, HORIZONTAL].var(axis=0))
    difference = step * np.arange(1, 22)
    exact = force_spectrum_with(forces, spectrum, omega, np.zeros((len(omega), 3)), difference)
    variance = step * exact[:, HORIZONTAL].sum(axis=0)
    error = np.std(found, axis=0, ddof=1) / np.sqrt(12)
    assert np.all(np.abs(np.mean(found, axis=0) - variance) < 1.96 * error)


def test_without_bound_waves_the_spectrum_is_that_of_newman():
    spectrum, omega, difference = jonswap(2.0, peak_period=9.0), np.linspace(*BAND, 80), np.array([0.0, 0.05, 0.2])
    drift = np.stack([np.sin(9 * omega), omega, -omega], axis=1)
    none = force_spectrum_with(lambda a, b: np.zeros((len(a), 6), complex), spectrum, omega, drift, difference)
    expected = force_spectrum(spectrum, omega, drift, difference)
    np.testing.assert_allclose(none[:, [0, 1, 5]], expected, rtol=1e-2, atol=2e-3 * expected.max())


def test_deep_water_has_the_bound_waves_of_very_deep_water():
    one, two = np.linspace(0.5, 1.1, 7), np.linspace(0.45, 1.0, 7)
    very, deep = (
        bound_wave_forces(PanelProblem(box(50, 25, 10, panels=20), depth=depth), BAND, MEAN, HEADING)(one, two)
        for depth in (3000.0, np.inf)
    )
    for part in (slice(0, 3), slice(3, 6)):
        assert np.abs(very - deep)[:, part].max() < 1e-2 * np.abs(deep[:, part]).max()
