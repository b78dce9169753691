"""Estimates of spectra: Parseval, χ² statistics on white noise, energies of known waves."""

import numpy as np
import pytest

from hakobune.mooring.environment.spectrum_estimate import estimate


def test_periodogram_of_the_whole_record_holds_its_variance():
    """Parseval; with an odd number of values no half frequency is left out."""
    record = np.random.default_rng(1).standard_normal(1001) + 5.0
    found = estimate(record, 0.2, segment=1001 * 0.2, window="none")
    spacing = found.omega[1] - found.omega[0]
    assert abs(found.density.sum() * spacing / record.var() - 1) < 1e-12
    assert abs(spacing - 2 * np.pi / (1001 * 0.2)) < 1e-12
    assert found.degrees_of_freedom == 2


@pytest.mark.parametrize("window", ["hann", "none"])
def test_energy_of_a_wave_is_found_round_its_frequency(window):
    """Half the amplitude squared; between frequencies, 0.4 % of it leaks beyond ten lines of no window."""
    step, omega = 0.5, 0.7
    record = 2.0 * np.cos(omega * step * np.arange(8192) + 0.3)
    found = estimate(record, step, segment=512.0, window=window)
    near = np.abs(found.omega - omega) < 10.5 * (found.omega[1] - found.omega[0])
    energy = found.density[near].sum() * (found.omega[1] - found.omega[0])
    assert abs(energy / 2.0 - 1) < (0.02 if window == "none" else 1e-3)


@pytest.mark.parametrize(("window", "overlap"), [("hann", 0.5), ("hann", 0.75), ("none", 0.0)])
def test_white_noise_scatters_with_the_degrees_of_freedom_and_lies_in_its_band(window, overlap):
    """χ²: the variance of an estimate is 2/ν of its mean squared; the truth is inside 90 % of the bands."""
    rng, densities, inside = np.random.default_rng(3), [], []
    for _ in range(300):
        found = estimate(rng.standard_normal(2048), 1.0, segment=128.0, window=window, overlap=overlap)
        low, high = found.confidence(0.9)
        densities.append(found.density)
        inside.append(np.mean((low < 1 / np.pi) & (1 / np.pi < high)))
    scatter = np.var(densities, axis=0) / np.mean(densities, axis=0) ** 2
    # 300 records of 63 frequencies: means to 0.3 %, variances to 2 %
    assert abs(np.mean(densities) * np.pi - 1) < 0.005
    assert abs(np.mean(scatter[1:]) * found.degrees_of_freedom / 2 - 1) < 0.06
    assert abs(np.mean(inside) - 0.9) < 0.01


def test_segments_that_do_not_overlap_have_two_degrees_each():
    found = estimate(np.random.default_rng(3).standard_normal(1024), 1.0, segment=128.0, overlap=0.0)
    assert found.degrees_of_freedom == 16


def test_the_mean_level_changes_nothing():
    record = np.random.default_rng(5).standard_normal(500)
    np.testing.assert_allclose(estimate(record, 0.5).density, estimate(record + 100, 0.5).density, rtol=1e-9)


def test_an_estimate_is_a_spectrum():
    record = np.random.default_rng(5).standard_normal(65536)
    spectrum = estimate(record, 0.5).spectrum()
    # white up to π/0.5 has T01 = 2 s; n values scatter it by (1/√3)/√(n/2), 0.3 %; two lines of 512 are left out
    assert abs(spectrum.moment(0) / record.var() - 1) < 2 / 512 + 0.01
    assert abs(spectrum.T01 / 2.0 - 1) < 0.01


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"record": np.zeros(100)}, "record is 0 m throughout"),
        ({"record": np.ones(5)}, "allowed: a one-dimensional array of at least 16"),
        ({"record": np.array([1.0] * 20 + [np.nan])}, "record is nan at index 20"),
        ({"segment": 1.0}, "segment is 1 s, 2 values; allowed: 8 to 50 s"),
        ({"segment": 100.0}, "allowed: 8 to 50 s, the length of the record"),
        ({"window": "square"}, "window is 'square'; allowed: hann, none"),
        ({"overlap": 1.0}, "overlap is 1"),
        ({"step": -1.0}, "step is -1 s"),
    ],
)
def test_what_cannot_be_is_refused(arguments, words):
    with pytest.raises(ValueError, match=words):
        estimate(**{"record": np.arange(100.0), "step": 0.5} | arguments)


def test_a_confidence_level_is_a_probability():
    with pytest.raises(ValueError, match="confidence level is 95"):
        estimate(np.arange(100.0), 0.5).confidence(95)
