"""Slowly varying drift: Newman's sum, Pinkster's spectrum, half waves."""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import issc, jonswap, tabulated
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.environment.wave_records import elevation
from hakobune.mooring.response import slow_drift
from hakobune.mooring.response.drift import mean_in_sea, mean_in_sea_beyond
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.response.slow_drift import (
    component_drift,
    force_spectrum,
    half_wave_drift,
    half_waves,
    held_beyond,
    newman,
    outside_band,
    signed_means,
)

THREE_HOURS = np.arange(0.0, 10800.0, 0.5)


class Waves(NamedTuple):
    omega: np.ndarray
    amplitude: np.ndarray
    phase: np.ndarray


def test_two_waves_give_their_mean_drift_and_one_beat():
    """F = a₁²D₁ + a₂²D₂ + 2a₁a₂√(D₁D₂) cos{(ω₁ − ω₂)t − (ε₁ − ε₂)}; opposite signs do not beat."""
    waves, t = Waves(np.array([0.6, 0.65]), np.array([1.0, 0.7]), np.array([0.3, -1.2])), np.linspace(0, 300, 1001)
    found = newman(waves, [[2.0, -2.0, 2.0], [3.0, -3.0, -3.0]], t)
    beat = 2 * 0.7 * np.sqrt(6.0) * np.cos((0.6 - 0.65) * t - 1.5)
    assert np.allclose(found[:, 0], 2.0 + 0.49 * 3.0 + beat)
    assert np.allclose(found[:, 1], -found[:, 0])
    assert np.allclose(found[:, 2], 2.0 - 0.49 * 3.0)


def test_equal_drift_makes_the_force_follow_the_envelope_of_the_waves():
    """D |Σ a exp(iε − iωt)|², the Hilbert envelope; and unequal steps of time give the numbers of equal ones."""
    waves = Sea(issc(4.5, mean_period=10.0)).components(200, 3)
    t = np.arange(1000) * 0.5
    direct = np.abs(np.exp(-1j * np.outer(t, waves.omega)) @ (waves.amplitude * np.exp(1j * waves.phase))) ** 2
    D = np.tile([5.0, -5.0, 0.0], (200, 1))
    assert np.allclose(newman(waves, D, t)[:, 0], 5.0 * direct)
    uneven = np.append(t[:-1], 777.7)
    assert np.allclose(newman(waves, D, uneven)[:-1], newman(waves, D, t)[:-1], atol=1e-9)


@pytest.mark.parametrize("spread", [None, CosinePower(4.0)])
def test_newmans_mean_over_three_hours_is_the_integral_within_five_per_cent(box_body, spread):
    """Between the seeds the mean of three hours scatters by about 1 %."""
    from hakobune.mooring.response.seas import directions

    spectrum, omega = issc(4.5, mean_period=10.0), frequencies(box_body)
    sea = Sea(spectrum, np.radians(60.0), spread)
    heading, weights = directions(sea, omega)
    drift = box_body.drift(omega, heading)
    integral = mean_in_sea(omega, drift, spectrum.density(omega), weights)
    ends = weights if weights.ndim == 1 else weights[[0, -1]]
    integral += mean_in_sea_beyond(box_body, spectrum, drift[[0, -1]], ends).sum(axis=0)
    waves = sea.components(500, 7)
    force = newman(waves, component_drift(box_body, waves, hold=True), THREE_HOURS)
    assert np.allclose(force.mean(axis=0)[:2], integral[:2], rtol=0.05)


def test_spectrum_of_newmans_force_is_pinksters_within_its_scatter(box_body):
    """Variance of five seas within four standard errors, and the spectrum in bands of 0.02 rad/s within 30 %.

    A band of 0.02 rad/s of 5 × 3 h holds about 340 degrees of freedom: a standard error of 8 %.
    """
    spectrum, omega = jonswap(4.5, peak_period=11.0), frequencies(box_body)
    D = box_body.drift(omega, [0.0])[:, 0]
    limits = dict(low=box_body.omega[0], high=box_body.omega[-1])
    periodograms, variances = [], []
    with pytest.warns(UserWarning, match="of the energy"):
        for seed in range(5):
            waves = Sea(spectrum).components(600, seed, amplitudes="random", **limits)
            force = newman(waves, component_drift(box_body, waves), THREE_HOURS)[:, 0]
            periodograms.append(np.abs(np.fft.rfft(force - force.mean())) ** 2 * 0.5 / (np.pi * len(force)))
            variances.append(force.var())
    difference = 2 * np.pi * np.fft.rfftfreq(len(THREE_HOURS), 0.5)
    measured = np.mean(periodograms, axis=0)
    fine = np.linspace(0.0, 0.8, 801)
    theory = force_spectrum(spectrum, omega, D, fine)[:, 0]
    error = np.std(variances, ddof=1) / np.sqrt(len(variances))
    assert abs(np.mean(variances) - np.trapezoid(theory, fine)) < 4 * error
    for low in np.arange(0.01, 0.15, 0.02):
        band = (difference >= low) & (difference < low + 0.02)
        expected = np.interp(difference[band], fine, theory).mean()
        assert abs(measured[band].mean() / expected - 1) < 0.3, low


def test_pinksters_spectrum_of_equal_drift_holds_the_variance_of_the_envelope():
    """Gaussian waves: var |envelope|² = (2m₀)², so ∫ 8∫SS D² = 4 m₀² D²."""
    spectrum = issc(4.5, mean_period=10.0)
    omega, difference = np.linspace(0.2, 8.0, 4001), np.linspace(0, 7.8, 1561)
    found = force_spectrum(spectrum, omega, np.full((4001, 1), 3.0), difference)[:, 0]
    assert np.isclose(np.trapezoid(found, difference), 4 * spectrum.moment(0) ** 2 * 9.0, rtol=2e-3)


def test_energy_outside_the_database_is_an_error_unless_drift_is_held(box_body):
    waves = Sea(issc(4.5, mean_period=8.0)).components(300, 1)
    share = outside_band(box_body, waves)
    assert share > 0.01
    with pytest.raises(BetweenError, match=f"{100 * share:.1f} % of the wave energy is outside the database"):
        component_drift(box_body, waves)
    held = component_drift(box_body, waves, hold=True)
    beyond = waves.omega > box_body.omega[-1]
    assert np.allclose(held[beyond, 0], box_body.drift(box_body.omega[-1:], [0.0])[0, 0, 0])


def test_every_component_takes_drift_at_its_own_frequency_and_direction(box_body):
    waves = Components(np.array([0.9, 0.5]), np.ones(2), np.zeros(2), np.radians([20.0, 75.0]))
    found = component_drift(box_body, waves)
    for i, degrees in enumerate((20.0, 75.0)):
        assert np.allclose(found[i], box_body.drift(waves.omega[i : i + 1], np.radians([degrees]))[0, 0])


def test_a_regular_wave_is_cut_into_its_half_waves():
    step = 2 * np.pi / 0.6 / 40
    t = np.arange(2000) * step  # whole periods, so that the mean is zero
    waves = half_waves(1.5 * np.cos(0.6 * t - 0.4), step)
    assert len(waves.omega) == 99
    assert np.allclose(waves.omega, 0.6, rtol=1e-4) and np.allclose(waves.amplitude, 1.5, rtol=1e-4)
    force = half_wave_drift(waves, np.array([0.3, 0.9]), np.array([[3.0], [9.0]]), t)
    inside = (t > waves.start[0]) & (t < waves.end)
    assert np.allclose(force[inside, 0], 6.0 * 1.5**2, rtol=5e-4)
    assert np.all(force[~inside] == 0)


def test_half_waves_of_equal_energy_keep_the_mean_of_a_constant_drift():
    """Σ ζ²Δt / T = 2 m₀ when ζ²/2 is the mean square of the half wave."""
    eta = elevation(Sea(issc(4.5, mean_period=10.0)).components(500, 2), np.arange(0, 10800, 0.25))
    waves = half_waves(eta, 0.25, amplitude="energy")
    force = half_wave_drift(waves, np.array([0.1, 5.0]), np.ones((2, 1)), THREE_HOURS)
    assert np.isclose(force.mean(), 2 * eta.var(), rtol=5e-3)


def test_half_wave_method_has_the_mean_of_the_integral_in_a_narrow_spectrum(box_body):
    """Six per cent wide.  Both means per energy: that of one record, some 30 groups, scatters by 15 %."""
    omega = frequencies(box_body)
    D = box_body.drift(omega, [0.0])[:, 0]
    for peak in (0.5, 0.7):
        narrow = tabulated([0.97 * peak, peak, 1.03 * peak], [0.0, 1.0 / (0.03 * peak), 0.0])
        eta = elevation(Sea(narrow).components(500, 5), np.arange(0, 10800, 0.25))
        force = half_wave_drift(half_waves(eta, 0.25), omega, D, THREE_HOURS)
        fine = np.linspace(0.97 * peak, 1.03 * peak, 201)
        integral = mean_in_sea(fine, box_body.drift(fine, [0.0]), narrow.density(fine))
        assert np.isclose(force[:, 0].mean() / eta.var(), integral[0] / narrow.moment(0), rtol=0.05), peak


def test_half_wave_method_exceeds_the_integral_in_a_broad_spectrum(box_body):
    """Extremes of half waves hold more than their energy: 12 % for constant drift in an ISSC spectrum."""
    eta = elevation(Sea(issc(4.5, mean_period=10.0)).components(500, 2), np.arange(0, 10800, 0.25))
    waves = half_waves(eta, 0.25)
    force = half_wave_drift(waves, np.array([0.1, 5.0]), np.ones((2, 1)), THREE_HOURS)
    assert 1.08 < force.mean() / (2 * eta.var()) < 1.16


def test_a_matched_half_wave_record_has_the_integrals_mean_and_newmans_slow_variation(box_body):
    """Slow: means over two minutes, longer than any group of waves; their spread is that of Newman's force."""
    sea = Sea(issc(3.0, mean_period=12.0))
    waves = sea.components(500, 3)
    D = component_drift(box_body, waves, hold=True)
    integral = (waves.amplitude**2) @ D
    eta = elevation(waves, np.arange(0, 10800, 0.25))
    omega = frequencies(box_body)
    raw = half_wave_drift(half_waves(eta, 0.25), omega, box_body.drift(omega, [0.0])[:, 0], THREE_HOURS)
    factor = integral[0] / raw[:, 0].mean()
    assert 0.7 < factor < 1.1
    slow = [record[:, 0].reshape(-1, 240).mean(axis=1) for record in (factor * raw, newman(waves, D, THREE_HOURS))]
    assert np.isclose(slow[0].std(), slow[1].std(), rtol=0.3)
    assert np.corrcoef(slow)[0, 1] > 0.5


@pytest.mark.parametrize(
    ("record", "words"),
    [
        (np.ones(100), "0 zero crossings"),
        (np.cos(np.arange(100.0)), "half waves have 3.14 samples on average; allowed: at least 8"),
    ],
)
def test_records_that_hold_no_half_waves_are_refused(record, words):
    with pytest.raises(ValueError, match=words):
        half_waves(record, 1.0)


def pairs_of_headings(omega, D, share, density, difference):
    """8 ∫ SS′ ΣΣ w_a w_b T² dω with T² = D_a D′_b where both have one sign, pair by pair; D (q, p) at equal steps"""
    step, out = omega[1] - omega[0], []
    for shift in np.rint(difference / step).astype(int):
        last = len(omega) - shift
        pairs = np.maximum(D[:last, :, None] * D[shift:, None, :], 0.0)
        both = np.einsum("qab,a,b->q", pairs, share, share) * density[:last] * density[shift:]
        out.append(8 * np.trapezoid(both, omega[:last]))
    return np.array(out)


@pytest.mark.parametrize("towards", [180.0, 120.0])
def test_slow_drift_of_short_crests_is_the_sum_over_pairs_of_headings(box_body, towards):
    """In waves towards 180° sway and yaw drift have no mean, but they beat; of cos⁴ in steps of 5°."""
    spectrum, beta = jonswap(4.5, peak_period=11.0), np.radians(towards)
    away = np.radians(np.arange(-85.0, 90.0, 5.0))
    share = np.cos(away) ** 4 / np.sum(np.cos(away) ** 4)
    omega, difference = np.linspace(box_body.omega[0], box_body.omega[-1], 321), np.arange(0.0, 0.2, 0.02)
    D, density = box_body.drift(omega, beta + away), spectrum.density(omega)
    by_pairs = np.stack([pairs_of_headings(omega, D[:, :, j], share, density, difference) for j in range(3)], axis=-1)
    found = force_spectrum(spectrum, omega, signed_means(D, share), difference)
    assert np.allclose(found, by_pairs, rtol=1e-3, atol=1e-3 * by_pairs.max(axis=0))
    # pairs of the mean drift, by which sway would not vary at all in waves from ahead
    of_mean = force_spectrum(spectrum, omega, np.einsum("qpj,p->qj", D, share), difference)
    missing = 1 - np.sqrt(of_mean[0] / found[0])
    assert np.all(missing[1:] > 0.999) if towards == 180.0 else missing[2] > 0.2


def test_short_crests_vary_as_the_record_of_their_own_components_does(box_body):
    """Deviation of sway force and yaw moment in waves towards 180°: six records of three hours, four standard errors.

    Nothing of this has a mean, so that a sum over the headings before the product would leave nothing.
    """
    sea = Sea(jonswap(4.5, peak_period=11.0), np.pi, CosinePower(4))
    records = []
    for seed in range(6):
        waves = sea.components(600, seed)
        records.append(newman(waves, component_drift(box_body, waves, hold=True), THREE_HOURS[::4]).std(axis=0))
    omega = frequencies(box_body, sea.spectrum.density)
    heading = np.radians(np.arange(0.0, 360.0, 5.0))
    parts = signed_means(box_body.drift(omega, heading), sea.directional(heading))
    difference = np.linspace(0, 1.6, 801)
    theory = force_spectrum(sea.spectrum, *held_beyond(omega, parts, sea.spectrum), difference)
    expected, mean = np.sqrt(np.trapezoid(theory, difference, axis=0)), np.mean(records, axis=0)
    error = np.std(records, axis=0, ddof=1) / np.sqrt(len(records))
    assert np.all(np.abs(mean - expected)[1:] < 4 * error[1:])


@pytest.mark.parametrize("spread", [False, True])
def test_drift_of_components_beyond_the_band_is_that_of_its_ends_where_it_may_be_held(spread):
    """Stored from 0.4 to 1.0 rad/s; 10 ω and the direction, of components of which two lie beyond"""
    drift = lambda omega, heading: 10 * omega[:, None, None] + np.asarray(heading)[None, :, None] * np.ones((1, 1, 3))  # noqa: E731
    body = SimpleNamespace(omega=np.array([0.4, 0.6, 1.0]), drift=drift)
    omega, amplitude = np.array([0.3, 0.5, 0.45, 1.2]), np.array([0.01, 1.0, 1.0, 0.02])
    direction = np.array([0.1, 0.2, 0.3, 0.4]) if spread else np.full(4, 0.2)
    waves = SimpleNamespace(omega=omega, amplitude=amplitude, direction=direction)
    assert outside_band(body, waves) == pytest.approx(0.0005 / 2.0005)
    with pytest.MonkeyPatch.context() as patch:
        own = lambda body, omega, direction: 10 * omega[:, None] + direction[:, None] * np.ones(3)  # noqa: E731
        patch.setattr(slow_drift, "_own", own)
        found = component_drift(body, waves)
    assert found == pytest.approx((10 * np.array([0.4, 0.5, 0.45, 1.0]) + direction)[:, None] * np.ones(3))
    waves.amplitude = np.array([0.2, 1.0, 1.0, 0.02])
    with pytest.raises(BetweenError, match=r"2\.0 % of the wave energy is outside the database's 0\.4 to 1 rad/s"):
        component_drift(body, waves)
