"""Spectra of shallow water and of two peaks, and their limits."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.spectra import issc, jonswap, jonswap_fetch
from hakobune.mooring.environment.spectrum import Peaked
from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.seas.breaking import BreakingError, breaking_height, too_high
from hakobune.mooring.seas.record_faults import faults
from hakobune.mooring.seas.shallow import limited, tma, tma_fetch
from hakobune.mooring.seas.spectra_files import read_sea
from hakobune.mooring.seas.two_peaks import OneSystem, ochi_hubble, torsethaugen

G = 9.80665


def test_depth_limits_a_spectrum_by_the_ratio_of_its_wavenumber_forms():
    """k⁻³ ∂k/∂ω over its deep-water form, the derivative by differences; ω²h/2g in long waves"""
    omega, h, step = np.array([0.3, 0.7, 1.2]), 15.0, 1e-5
    k = wavenumber(omega, h, G)
    slope = (wavenumber(omega + step, h, G) - wavenumber(omega - step, h, G)) / (2 * step)
    assert np.allclose(limited(omega, h, G), k**-3 * slope / ((omega**2 / G) ** -3 * 2 * omega / G), rtol=1e-8)
    assert np.isclose(limited(1e-2, h, G), 1e-4 * h / (2 * G), rtol=1e-3)


@pytest.mark.parametrize("order", [-1, 0, 1, 2, 3])
def test_moments_are_those_of_a_quadrature_of_the_density(order):
    for spectrum in (tma(3.0, 12.0, peak_period=9.0), ochi_hubble(4.0)):
        pieces = [0.0, 0.3, 0.5, 0.7, 0.8, 1.0, 1.5, 3.0, 8.0]
        whole = sum(
            quad(lambda w: w**order * spectrum.density(w), a, b, epsabs=1e-11, limit=200)[0]  # noqa: B023
            for a, b in pairwise(pieces)
        )
        assert np.isclose(spectrum.moment(order, 0.0, 8.0), whole, rtol=1e-7)


def test_a_sea_of_given_height_has_it_and_in_deep_water_is_jonswap():
    shallow, deep = tma(3.0, 12.0, mean_period=7.0), tma(3.0, 5000.0, peak_period=9.0)
    assert np.isclose(shallow.significant_height, 3.0) and np.isclose(shallow.T01, 7.0, rtol=1e-8)
    omega = np.linspace(0.3, 3, 40)
    assert np.allclose(deep.density(omega), jonswap(3.0, peak_period=9.0).density(omega), rtol=1e-9)


def test_wind_over_shallow_water_raises_less_of_a_sea():
    heights = [tma_fetch(20.0, 2e5, depth).significant_height for depth in (5.0, 10.0, 40.0, 1e4)]
    assert np.all(np.diff(heights) > 0)
    assert np.isclose(heights[-1], jonswap_fetch(20.0, 2e5).significant_height)


def test_a_wind_raises_no_more_than_a_fully_developed_sea():
    x = 5.497e4  # m, f_p U/g = 0.13 at 5 m/s
    assert np.isclose(5.0 / jonswap_fetch(5.0, x).Tp / G, 0.13, rtol=1e-3)
    with pytest.raises(ValueError, match=r"beyond 5\.497e\+04 m the sea of a wind of 5 m/s is fully developed"):
        jonswap_fetch(5.0, 1e7)


def test_a_system_of_shape_one_is_bretschneiders():
    one, omega = OneSystem(3.0, 0.6, 1.0), np.linspace(0.2, 3.0, 30)
    level = 5 / 16 * 3.0**2 * 0.6**4
    assert np.allclose(one.density(omega), Peaked("same", level, 0.6).density(omega), rtol=1e-10)
    for order in (-1, 0, 1, 2, 3):
        assert np.isclose(one.moment(order, 0.3, 2.0), Peaked("same", level, 0.6).moment(order, 0.3, 2.0), rtol=1e-9)


def test_the_most_probable_sea_has_its_height_and_the_printed_periods():
    sea = ochi_hubble(4.0)
    assert np.isclose(sea.significant_height, 4.0)
    swell, wind = sea.parts
    assert np.isclose(swell.height / wind.height, 0.84 / 0.54)
    assert np.isclose(swell.peak_omega, 0.5824, rtol=1e-3) and np.isclose(wind.peak_omega, 0.9839, rtol=1e-3)
    with pytest.raises(ValueError, match="ochi_hubble: peak_period is given; leave out the period"):
        ochi_hubble(4.0, peak_period=9.0, mean_period=None)


def test_wind_sea_and_swell_by_height_and_period_keep_the_height_and_change_places_at_a_full_sea():
    """T_f = 6.6 H^(1/3) parts them; with it all waves are one system; moments are those of a quadrature"""
    H, full = 4.0, 6.6 * 4.0 ** (1 / 3)
    for Tp in (7.0, full, 13.0, 18.0):
        sea = torsethaugen(H, peak_period=Tp)
        assert np.isclose(sea.significant_height, H, rtol=1e-9) and np.isclose(sea.Tp, Tp, rtol=1e-9)
        omega = np.geomspace(0.05, 40, 200_001)
        assert np.isclose(sea.moment(1, 0.05, 40.0), np.trapezoid(omega * sea.density(omega), omega), rtol=1e-6)
    swell = torsethaugen(H, peak_period=7.0).parts[1]
    assert np.isclose(2 * np.pi / swell.peak_omega, full + 2)
    assert len(torsethaugen(H, peak_period=full).parts) == 1
    wind = torsethaugen(H, peak_period=18.0).parts[1]
    assert np.isclose(2 * np.pi / wind.peak_omega, 6.6 * wind.height ** (1 / 3)) and wind.height < 0.81 * H
    tail = torsethaugen(H, peak_period=10.0).density(np.array([20.0, 40.0]))
    assert np.isclose(tail[0] / tail[1], 16.0, rtol=1e-3)
    with pytest.raises(ValueError, match="torsethaugen: mean_period is given; give peak_period"):
        torsethaugen(H, mean_period=8.0)


def test_waves_break_at_miches_height():
    """0.142 λ in deep water, 0.142 · 2π h = 0.89 h in long waves"""
    assert np.isclose(breaking_height(8.0, np.inf), 0.142 * G * 64 / (2 * np.pi))
    assert np.isclose(breaking_height(300.0, 10.0), 0.892 * 10.0, rtol=1e-3)
    with pytest.raises(
        BreakingError, match=r"25 m at .* single waves break at 16.66 m in 20 m of water; give at most 12"
    ):
        list(too_high(jonswap(25.0, peak_period=20.0), 20.0))
    (said,) = too_high(issc(13.0, peak_period=20.0), 20.0)
    assert "13 m is 0.65 of the water depth 20 m" in said
    (said,) = too_high(issc(4.0, peak_period=12.0), 8.0)
    assert "the highest of 1000 waves, 7.44 m, breaks at" in said
    assert not list(too_high(issc(4.5, mean_period=10.0), 20.0))


@pytest.mark.parametrize(
    "spoilt, said",
    [
        (lambda y, t: y + 1e-4 * t, "the mean level moves by 0.3"),
        (lambda y, t: y + 0.5 * np.sin(2 * np.pi * t / 44714.0), "the mean level moves by"),
        (lambda y, t: np.where(t == 1800.0, 99.0, y), "1 values exceed 8 standard deviations"),
    ],
    ids=["trend", "tide", "spike"],
)
def test_what_is_no_wave_in_a_record_is_named(spoilt, said):
    from hakobune.mooring.environment.sea import Sea
    from hakobune.mooring.environment.wave_records import elevation

    t = np.arange(0, 3600.0, 0.5)
    record = elevation(Sea(issc(1.0, mean_period=6.0)).components(500, 1), t)
    assert not list(faults(record, 0.5, 5.5))
    (line,) = faults(spoilt(record, t), 0.5, 5.5)
    assert said in line


SWAN = """\
SWAN   1                                Swan standard spectral file, version
LOCATIONS                               locations in x-y-space
     1                                  number of locations
      0.00      0.00
AFREQ                                   absolute frequencies in Hz
     4                                  number of frequencies
    0.0800
    0.1000
    0.1250
    0.1600
QUANT
     1                                  number of quantities in table
VaDens                                  variance densities in m2/Hz
m2/Hz                                   unit
   -0.9900E+02                          exception value
LOCATION     1
    0.50
    4.00
    2.00
    0.60
"""


def test_a_file_of_swan_has_remarks_behind_its_numbers(tmp_path):
    """m₀ by the trapezoidal rule over the four frequencies by hand; straight lines beyond their ends add nothing"""
    (tmp_path / "a.sp1").write_text(SWAN)
    m0 = 0.5 * (0.02 * (0.5 + 4) + 0.025 * (4 + 2) + 0.035 * (2 + 0.6))
    assert read_sea(tmp_path / "a.sp1").spectrum.significant_height == pytest.approx(4 * m0**0.5, rel=0.01)


def test_a_file_of_the_last_days_of_ndbc_has_pairs(tmp_path):
    head = "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >\n"
    rows = (
        "2018 04 18 20 00 0.172 0.5 (0.080) 4.0 (0.100) 2.0 (0.125) 0.6 (0.160)",
        "2018 04 18 19 00 9.999 0.1 (0.080) 1.0 (0.100) 999.0 (0.125) 0.6 (0.160)",
    )
    (tmp_path / "a.data_spec").write_text(head + "\n".join(rows) + "\n \n")
    (tmp_path / "a.sp1").write_text(SWAN)
    found = read_sea(tmp_path / "a.data_spec", time="2018 04 18 20 00")
    assert found.spectrum.significant_height == pytest.approx(
        read_sea(tmp_path / "a.sp1").spectrum.significant_height, rel=1e-12
    )
    with pytest.raises(TableError, match="has 2 rows; choose one with time"):
        read_sea(tmp_path / "a.data_spec")


def test_a_record_steeper_than_any_wave_is_asked_for_its_unit():
    """H/L = 1/7 is the steepest wave; 0.395 m at 1.1 s is H/L = 0.21, 395 m is 1000 times that"""
    t = np.arange(0, 110, 0.05)
    wave = 0.395 / 4 * np.sqrt(2) * np.sin(2 * np.pi * t / 1.1)
    gentle = list(faults(0.5 * wave, 0.05, 1.1))
    (said,) = faults(1000 * wave, 0.05, 1.1)
    assert not gentle and "significant height 395 m at 1.1 s: waves of 1.89 m are at most 0.27 m high" in said


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("low, high", [(1.1, 1.7), (0.5, 0.8), (0.8, 1.4)])
def test_moments_of_a_part_of_one_system_are_integrals_of_its_spectrum(order, low, high):
    """∫ ω^n S dω above, below and around the peak, by quadrature"""
    one = OneSystem(2.0, 0.9, 1.8)
    value = quad(
        lambda omega: omega**order * float(one.density(np.array([omega]))[0]), 0.9 * low, 0.9 * high, epsabs=0
    )[0]
    assert float(one.moment(order, 0.9 * low, 0.9 * high)) == pytest.approx(value, rel=1e-8)
