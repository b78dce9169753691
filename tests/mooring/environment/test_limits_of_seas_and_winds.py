"""What is allowed is made up to its limit and refused, or told, just beyond."""

import math
import warnings

import numpy as np
import pytest

from hakobune.mooring.environment.current_profile import power_law, table, wind_drift
from hakobune.mooring.environment.gusts import MissingVariance, davenport, gust_components, hino, kaimal, npd
from hakobune.mooring.environment.logger_files import read_table
from hakobune.mooring.environment.scatter import Scatter
from hakobune.mooring.environment.sea import Sea, linear_weights
from hakobune.mooring.environment.spectra import issc, jonswap, jonswap_fetch, tabulated
from hakobune.mooring.environment.spectrum import Peaked
from hakobune.mooring.environment.spreading import CosinePower, HalfCosinePower, Mitsuyasu, WrappedNormal
from hakobune.mooring.environment.tables import TableError, column_of, unit_of
from hakobune.mooring.environment.wave_records import Record, components_of, read_record
from hakobune.mooring.environment.wind_profile import froya_speed_at, mean_over, speed_at
from hakobune.mooring.seas.breaking import BreakingError, too_high
from hakobune.mooring.seas.shallow import tma
from hakobune.mooring.seas.systems import Systems
from hakobune.mooring.seas.two_peaks import OneSystem, ochi_hubble, torsethaugen
from hakobune.mooring.site.extremes import fit_extremes
from hakobune.mooring.site.seismic import seismic_coefficient, seismic_force

NARROW = tabulated([0.5, 0.6, 0.7], [0.0, 1.0, 0.0])
WIND = davenport(20.0, 0.003)
FETCH = (3.5 / 0.13) ** (1 / 0.33) * 25 / 9.80665  # m, of 5 m/s, where f_p U/g = 3.5 x̃^−0.33 is 0.13


@pytest.mark.parametrize(
    "make, good, bad, says",
    [
        (lambda v: power_law(v, 0, 30, 0.1), 20.0, 20.1, "current speed is 20.1 m/s; allowed: 0 to 20"),
        (lambda v: power_law(1, 0, 30, v), 3.0, 3.01, "exponent of the current profile is 3.01"),
        (lambda v: table([-9, 0], [1, v], 0.0), 20.0, 20.1, "current speed is 20.1 m/s; allowed: 0 to 20 m/s"),
        (lambda v: table([-9, v], [1, 1], 0.0), 0.0, 0.1, "runs from -9 to 0.1 m; allowed: increasing, at most 0"),
        (lambda v: wind_drift(v, 0, 30), 200.0, 201.0, "wind speed at 10 m is 201"),
        (lambda v: davenport(20, v), 1e-4, 0.99e-4, "surface drag K is 9.9e-05"),
        (lambda v: davenport(20, v), 0.1, 0.101, "surface drag K is 0.101"),
        (lambda v: hino(20, v, 10, 0.1), 0.1, 0.101, "surface drag K is 0.101"),
        (lambda v: hino(20, 0.003, 10, v), 0.5, 0.51, "exponent of the wind profile is 0.51"),
        (lambda v: hino(20, 0.003, 10, v), 1e-3, 0.9e-3, "exponent of the wind profile is 0.0009"),
        (lambda v: hino(v, 0.003, 10, 0.1), 0.1, 0.0, "wind speed is 0 m/s"),
        (lambda v: hino(20, 0.003, 10, 0.1, v), 0.1, 0.0, "stability m is 0"),
        (lambda v: npd(v), 0.1, 0.0, "one-hour wind speed at 10 m is 0"),
        (lambda v: npd(20, v), 0.1, 0.0, "height is 0 m"),
        (lambda v: kaimal(20, 10, v), 1.0, 1.01, "turbulence intensity is 1.01"),
        (lambda v: kaimal(20, 10, v), 1e-4, 0.9e-4, "turbulence intensity is 9e-05"),
        (lambda v: kaimal(20, v, 0.1), 0.1, 0.0, "height is 0 m"),
        (lambda v: kaimal(v, 10, 0.1), 0.1, 0.0, "wind speed is 0 m/s"),
        (lambda v: gust_components(WIND, 1, v, 300, 9), 1e-5, 0.0, "lowest frequency of the gusts is 0"),
        (lambda v: gust_components(WIND, 1, 1e-5, v, 9), 300, math.inf, "highest frequency of the gusts is inf"),
        (lambda v: gust_components(WIND, 1, 1e-5, v, 9), 300, 0.0, "highest frequency of the gusts is 0"),
        (lambda v: gust_components(WIND, 1, 1e-5, 300, v), 1, 1.5, "number of gust components is 1.5"),
        (lambda v: gust_components(WIND, v, 1e-5, 300, 9), 0, -1, "seed is -1"),
        (lambda v: speed_at(10, v), 200.0, 201.0, "wind speed at 10 m is 201"),
        (lambda v: speed_at(10, 20, v), 0.5, 0.51, "exponent of the wind profile is 0.51"),
        (lambda v: froya_speed_at(10, v), 200.0, 201.0, "one-hour wind speed at 10 m is 201"),
        (lambda v: froya_speed_at(10, 20, v), 1.0, 0.99, "averaging time is 0.99 s"),
        (lambda v: froya_speed_at(10, 20, v), 3600.0, 3601.0, "averaging time is 3601 s"),
        (lambda v: mean_over(v, 600, 3600), 0.0, -0.1, "wind speed is -0.1"),
        (lambda v: mean_over(20, v, 3600), 1.0, 0.99, "averaging time is 0.99"),
        (lambda v: jonswap(1, peak_period=9, gamma=v), 1.0, 0.99, "gamma is 0.99; allowed: 1 to 10"),
        (lambda v: jonswap(1, peak_period=9, gamma=v), 10.0, 10.01, "gamma is 10.01"),
        (lambda v: jonswap_fetch(20, 1e5, gamma=v), 10.0, 10.01, "gamma is 10.01"),
        (lambda v: jonswap_fetch(v, 0.2), 0.1, 0.0999, "wind speed is 0.0999 m/s; allowed: 0.1 to 200"),
        (lambda v: jonswap_fetch(v, 1e5), 200.0, 201.0, "wind speed is 201 m/s"),
        (lambda v: jonswap_fetch(20, v), 0.1, 0.0999, "fetch is 0.0999 m"),
        (lambda v: jonswap_fetch(5, v), 0.999 * FETCH, 1.001 * FETCH, "beyond 5.497e+04 m the sea of a wind of 5 m/s"),
        (lambda v: issc(v, mean_period=1e5), 1e3, 1001.0, "wave height is 1001 m"),
        (lambda v: issc(v, mean_period=9), 1e-6, 0.99e-6, "wave height is 9.9e-07 m"),
        (lambda v: issc(1e-6, mean_period=v), 1e-3, 0.99e-3, "mean period is 0.00099 s; allowed: 0.001 to 1e+06"),
        (lambda v: issc(1, mean_period=v), 1e6, 1.01e6, "mean period is 1.01e+06 s"),
        (lambda v: tma(1, 9, peak_period=9, gamma=v), 1.0, 0.99, "gamma is 0.99"),
        (lambda v: tma(v, 9, peak_period=9), 1.0, 0.0, "wave height is 0 m"),
        (lambda v: tma(1, v, peak_period=9), 3.0, 0.0, "water depth of tma is 0 m"),
        (lambda v: OneSystem(1, 0.6, v), 0.3, 0.29, "shape of a system of waves is 0.29; allowed: 0.3 to 50"),
        (lambda v: OneSystem(1, 0.6, v), 50.0, 50.1, "shape of a system of waves is 50.1"),
        (lambda v: ochi_hubble(v), 0.1, 0.099, "wave height is 0.099 m; allowed: 0.1 to 26"),
        (lambda v: ochi_hubble(v), 26.0, 26.1, "wave height is 26.1 m; allowed: 0.1 to 26"),
        (lambda v: torsethaugen(v, peak_period=20), 30.0, 30.1, "wave height is 30.1"),
        (
            lambda v: torsethaugen(4, peak_period=v),
            4.0,
            3.99,
            "peak period of torsethaugen is 3.99 s; allowed: 4 to 25",
        ),
        (lambda v: torsethaugen(4, peak_period=v), 25.0, 25.1, "peak period of torsethaugen is 25.1"),
        (lambda v: CosinePower(v), 0.0, -0.1, "exponent of the spreading is -0.1"),
        (lambda v: CosinePower(v), 1e4, 1.01e4, "exponent of the spreading is 10100"),
        (lambda v: CosinePower(2, v, 1.0), -math.pi / 2, -1.58, "the spreading extends from -1.58 to 1 rad"),
        (lambda v: CosinePower(2, 0.5, v), 0.51, 0.5, "spreading extends from 0.5 to 0.5 rad"),
        (lambda v: HalfCosinePower(v), 1e5, 1.01e5, "s of the spreading is 101000"),
        (lambda v: Mitsuyasu(v, 0.6), 1e5, 1.01e5, "s_max of the spreading is 101000"),
        (lambda v: Mitsuyasu(10, v), 0.1, 0.0, "peak frequency of the spreading is 0"),
        (lambda v: WrappedNormal(v), 1e-3, 0.99e-3, "sigma of the spreading is 0.00099 rad"),
        (lambda v: WrappedNormal(v), math.pi, 3.15, "sigma of the spreading is 3.15"),
        (lambda v: Peaked("p", v, 0.6), 1.0, 0.0, "level of the spectrum is 0"),
        (lambda v: Peaked("p", 1.0, v), 1.0, 0.0, "peak frequency is 0 rad/s"),
        (lambda v: Peaked("p", 1.0, 1.0).density(v), 0.0, -0.1, "frequency is -0.1 rad/s"),
        (
            lambda v: NARROW.moment(0, v, 0.6),
            0.6,
            0.61,
            "the moment is requested from 0.61 to 0.6 rad/s; allowed: 0 ≤ low ≤ high",
        ),
        (lambda v: NARROW.moment(0, v, 0.6), 0.0, -0.1, "the moment is requested from -0.1 to 0.6"),
        (lambda v: NARROW.moment(v), 4, 5, "order of the moment is 5"),
        (lambda v: tabulated([0.0, 1.0], [v, 1.0]).moment(-1), 0.0, 1.0, "density at frequency 0 is 1 m² s"),
        (lambda v: tabulated([0.0, 1.0], [v, 1.0]), 0.0, -0.1, "density of the spectrum is -0.1 to 1"),
        (lambda v: tabulated([0.0, 1.0], [0.0, v]), 0.1, 0.0, "density of the spectrum is 0 to 0"),
        (lambda v: Sea(NARROW, v), 7.0, math.inf, "direction of the sea is inf"),
        (lambda v: Sea(NARROW).components(v, 1), 1, 0, "count is 0; allowed: a whole number, at least 1"),
        (lambda v: Sea(NARROW).components(9, v), 0, -1, "seed is -1; allowed: a whole number, at least 0"),
        (
            lambda v: Sea(NARROW).components(9, 1, low=0.5, high=v),
            0.7,
            0.5,
            "components are requested from 0.5 to 0.5 rad/s",
        ),
        (
            lambda v: Sea(NARROW, math.radians(v)).directional([0, math.pi / 4]),
            44.0,
            46.0,
            "46° does not lie between two headings",
        ),
        (lambda v: linear_weights(np.array([0.0, v]), np.zeros(1)), 1e-8, 1e-10, "0° is given twice"),
        (
            lambda v: Scatter([v], [5.0], [[1.0]], "peak_period"),
            0.1,
            0.0,
            "the first classes of the scatter diagram are 0 m and 5 s",
        ),
        (
            lambda v: Scatter([1.0], [v], [[1.0]], "peak_period"),
            0.1,
            0.0,
            "the first classes of the scatter diagram are 1 m and 0 s",
        ),
        (
            lambda v: seismic_coefficient("A", coefficient=v),
            0.3,
            0.301,
            "coefficient of rule A is 0.301; allowed: 0 to 0.3",
        ),
        (lambda v: seismic_force(v, 100.0), 2.0, 2.01, "seismic coefficient is 2.01; allowed: 0 to 2"),
        (lambda v: seismic_force(0.2, 100.0, v), 0.0, -1.0, "surcharge is -1"),
        (lambda v: fit_extremes([1, 2, 3, 4, 6]).value(v), 1.01, 1.0, "return period is 1.0 years; allowed: above 1"),
        (
            lambda v: fit_extremes([1, 2, 3, 4, 6]).interval(9, v, 9),
            0.99,
            0.991,
            "confidence is 0.991; allowed: 0.5 to",
        ),
        (lambda v: fit_extremes([1, 2, 3, 4, 6]).interval(9, v, 9), 0.5, 0.49, "confidence is 0.49"),
        (lambda v: fit_extremes([1, 2, 3, 4, 6][:v]), 5, 4, "there are 4 yearly maxima; allowed: at least 5"),
        (lambda v: fit_extremes([v, 2, 3, 4, 6], "weibull"), 0.1, 0.0, "smallest yearly maximum is 0"),
    ],
)
def test_a_quantity_is_taken_up_to_its_limit_and_refused_beyond(make, good, bad, says):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        make(good)
        with pytest.raises(ValueError) as refused:
            make(bad)
    assert says in str(refused.value) and "\n" not in str(refused.value)


def told(make):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        make()
    return [str(one.message) for one in caught]


@pytest.mark.parametrize("share, warned", [(0.9905, False), (0.9895, True)])
def test_a_gust_band_that_leaves_out_more_than_a_hundredth_is_told(share, warned):
    """Kaimal's share below X = f L/U is 1 − (1 + 6X)^(−2/3); nearly all of it lies above the lower end"""
    spectrum = kaimal(20.0, 100.0, 0.1)
    X = ((1 - share) ** -1.5 - 1) / 6
    said = told(lambda: gust_components(spectrum, 1, 1e-12, 2 * math.pi * X / spectrum.time_scale, 10))
    assert bool(said) is warned
    if warned:
        with pytest.warns(
            MissingVariance, match=r"contains 98\.9 % of the variance of Kaimal at 20 m/s; at least 99 %"
        ):
            gust_components(spectrum, 1, 1e-12, 2 * math.pi * X / spectrum.time_scale, 10)


@pytest.mark.parametrize("steep, warned", [(0.0995, False), (0.1005, True)])
def test_a_sea_steeper_than_a_tenth_is_told(steep, warned):
    """2πH/gT02²; every family says it"""
    H, g = 3.0, 9.80665
    T = math.sqrt(2 * math.pi * H / (g * steep))
    seas = [lambda: issc(H, zero_crossing_period=T), lambda: jonswap(H, zero_crossing_period=T),
            lambda: tma(H, 500.0, zero_crossing_period=T)]  # fmt: skip
    for make in seas:
        said = told(make)
        assert len(said) == warned and (not warned or "seas break above 0.1" in said[0])


@pytest.mark.parametrize("missed, warned", [(0.0095, False), (0.0105, True)])
def test_components_that_miss_more_than_a_hundredth_of_the_energy_are_told(missed, warned):
    """A triangle from 0.5 to 0.7 rad/s: what lies below ω is ½ ((ω − 0.5)/0.1)²"""
    said = told(lambda: Sea(NARROW).components(20, 1, low=0.5 + 0.1 * math.sqrt(2 * missed), high=0.7))
    assert len(said) == warned and (not warned or "miss 1.0 % of the energy; allowed: 1 %" in said[0])


@pytest.mark.parametrize("missed, refused", [(0.0095, False), (0.0105, True)])
def test_energy_that_travels_outside_the_headings_is_refused_above_a_hundredth(missed, refused):
    """A narrow sea with its mean at a quarter of the normal law: P(x > z σ) = missed beyond the last heading"""
    z = {0.0095: 2.3455, 0.0105: 2.3080}[missed]
    sigma = math.radians(5.0)
    sea = Sea(NARROW, -z * sigma, WrappedNormal(sigma))
    headings = np.radians([-80.0, -40.0, 0.0])
    if refused:
        with pytest.raises(ValueError, match=r"1\.\d % of the energy travels outside the headings -80, -40, 0°"):
            sea.directional(headings)
    else:
        assert sea.directional(headings).sum() == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("wide, refused", [(1.0099, False), (1.0103, True)])
def test_a_spreading_that_the_cells_miss_by_more_than_a_hundredth_is_refused(wide, refused):
    """Even over a sector as wide as 20.2 cells of 0.1°, of which 20 have their middles in it: they hold 1/1.01 of it"""
    sector = CosinePower(0.0, -math.radians(wide), math.radians(wide))
    if refused:
        with pytest.raises(ValueError, match=r"the sum over cells of 0\.1° differs from 1 by 0\.01; allowed: 0\.01"):
            sector.shares()
    else:
        assert sector.shares().sum() == pytest.approx(1.0)


def test_waves_break_just_above_what_water_holds_and_are_told_before():
    """Miche: 0.142 L tanh kh; a significant height of 0.6 h; the highest of 1000 at 1.86 of the height"""
    deep = 0.142 * 9.80665 * 64 / (2 * math.pi)  # Tp 8 s
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert not list(too_high(jonswap(0.999 * deep / 1.86, peak_period=8.0), 1e4))
        (said,) = too_high(jonswap(1.001 * deep / 1.86, peak_period=8.0), 1e4)
        assert said.startswith(f"the highest of 1000 waves, {1.001 * deep:.3g} m, breaks at {deep:.3g} m")
        (said,) = too_high(jonswap(0.999 * deep, peak_period=8.0), 1e4)
        with pytest.raises(BreakingError, match="single waves break at"):
            list(too_high(jonswap(1.001 * deep, peak_period=8.0), 1e4))
        below, above = (list(too_high(jonswap(height, peak_period=25.0), 10.0)) for height in (5.99, 6.01))
    assert "the highest of 1000" in below[0] and "6.01 m is 0.6 of the water depth 10 m" in above[0]


def written(tmp_path, text):
    path = tmp_path / "record.csv"
    path.write_text(text)
    return path


@pytest.mark.parametrize("off, refused", [(0.0099, False), (0.0101, True)])
def test_times_of_a_record_are_even_to_a_hundredth_of_a_step(tmp_path, off, refused):
    rows = [(0.0, 1.0), (0.5, 2.0), (1.0 + 0.5 * off, 3.0), (1.5, 4.0), (2.0, 5.0)]
    path = written(tmp_path, "time_s,eta_m\n" + "".join(f"{t!r},{y}\n" for t, y in rows))
    if refused:
        with pytest.raises(TableError, match=r"line 4: the time goes from 0\.5 to 1\.00505 s,"):
            read_record(path)
    else:
        found = read_record(path)
        assert found.step == pytest.approx(0.5) and found.time == pytest.approx([0.0, 0.5, 1.0, 1.5, 2.0])


def test_columns_of_a_record_are_in_the_units_of_their_names(tmp_path):
    """Milliseconds, centimetres and feet; the column that is asked for"""
    path = tmp_path / "two.csv"
    path.write_text("Time [ms],gauge 1 (cm),gauge 2 (ft)\n100,50,1\n300,70,2\n500,-20,3\n")
    first, second = read_record(path), read_record(path, column="gauge 2 (ft)")
    assert (first.start, first.step) == pytest.approx((0.1, 0.2))
    assert first.elevation == pytest.approx([0.5, 0.7, -0.2])
    assert second.elevation == pytest.approx([0.3048, 0.6096, 0.9144])
    alone = written(tmp_path, "eta_mm\n5\n7\n")
    assert read_record(alone, 0.25).elevation == pytest.approx([5e-3, 7e-3]) and read_record(alone, 0.25).start == 0.0
    assert read_record(alone, 0.25).step == 0.25
    with pytest.raises(TableError, match="give the step"):
        read_record(alone)
    with pytest.raises(
        TableError,
        match=r"has a time column, but a step of 0\.2 s is given as well; leave out "
        r"the step",
    ):
        read_record(path, 0.2)


@pytest.mark.parametrize(
    "name, kind, factor",
    [("eta (mm)", "length", 1e-3), ("x_dm", "length", 0.1), ("x [km]", "length", 1e3), ("x/in", "length", 0.0254),
     ("t (min)", "time", 60.0), ("t hours", "time", 3600.0), ("t_ms", "time", 1e-3), ("eta", "length", 1.0),
     ("t, sec", "time", 1.0)],
)  # fmt: skip
def test_a_unit_in_a_name_is_what_it_is(name, kind, factor):
    assert unit_of("file", name, kind) == pytest.approx(factor, rel=1e-12)
    with pytest.raises(TableError, match="has the unit 'furlong'"):
        unit_of("file", "x (furlong)", "length")


def test_a_table_has_decimal_commas_between_semicolons_and_a_fault_has_its_line(tmp_path):
    path = written(tmp_path, "# of a logger\nt;eta\n0,5;1,25\n1;-3\n")
    names, values, _ = read_table(path)
    assert names == ["t", "eta"] and values.tolist() == [[0.5, 1.25], [1.0, -3.0]]
    assert column_of(path, names, "eta") == 1
    with pytest.raises(TableError, match="line 4 has 3 columns; allowed: 2"):
        read_table(written(tmp_path, "# remark\nt,eta\n0,1\n1,2,3\n"))
    with pytest.raises(TableError, match="line 3 has ''; allowed"):
        read_table(written(tmp_path, "t,eta\n0,1\n1,\n"))
    assert read_table(written(tmp_path, "t,eta\n0,1\n1,\n"), blank=7.0)[1][1, 1] == 7.0


@pytest.mark.parametrize("count", [16, 17])
def test_components_of_a_record_are_its_fourier_terms_but_half_the_sampling_rate(count):
    """½ cos(2ωt) + 0.2 sin(3ωt) on a level of 7, and of an even record ±0.1, whose phase is not known

    The last frequency of an odd record is below half the rate and counts.
    """
    t = 0.5 * np.arange(count)
    omega = 2 * np.pi / (0.5 * count)
    last = count // 2
    extra = 0.1 * np.cos(np.pi * np.arange(16)) if count == 16 else 0.3 * np.cos(last * omega * t)
    record = Record(7.0 + 0.5 * np.cos(2 * omega * t) + 0.2 * np.sin(3 * omega * t) + extra, 0.5, 4.0)
    found = components_of(record, 0.7)
    kept = [2, 3] if count == 16 else [2, 3, last]
    assert found.omega == pytest.approx(omega * np.array(kept))
    assert found.amplitude == pytest.approx([0.5, 0.2, 0.3][: len(kept)])
    assert np.exp(1j * found.phase[:2]) == pytest.approx([1.0, 1j], abs=1e-9) and np.all(found.direction == 0.7)
    shorter = components_of(record, 0.7, shortest=2 * np.pi / (2.5 * omega))
    assert shorter.omega == pytest.approx([2 * omega])


def test_shares_of_a_sea_whose_spread_goes_by_frequency_are_those_of_its_energy():
    """∫ S(ω) shares(ω) dω / m₀, by a sum over the whole spectrum; 200 bands of equal energy are within 2e-3"""
    sea = Sea(issc(3.0, mean_period=8.0), 0.4, Mitsuyasu(10.0, 0.7))
    headings, omega = np.deg2rad(np.arange(0, 360, 30.0)), np.linspace(0.1, 6.0, 3000)
    density = sea.spectrum.density(omega)
    expected = density @ sea.directional(headings, omega) / density.sum()
    assert sea.directional(headings) == pytest.approx(expected, abs=2e-3)


def test_shares_of_seas_together_are_theirs_by_energy():
    """Energies 1 to 4; at a frequency by the densities there, one sea along 0° and the other along 90°"""
    first, second = Sea(issc(1.0, mean_period=6.0), 0.0), Sea(issc(2.0, mean_period=11.0), math.pi / 2)
    both, headings = Systems((first, second)), np.deg2rad([0, 45, 90, 135])
    assert both.directional(headings) == pytest.approx([0.2, 0, 0.8, 0])
    omega = np.array([0.5, 0.9, 1.6])
    one, two = first.spectrum.density(omega), second.spectrum.density(omega)
    assert both.directional(headings, omega)[:, 0] == pytest.approx(one / (one + two))
    assert both.directional(headings, omega)[:, 2] == pytest.approx(two / (one + two))
    assert both.direction == pytest.approx(math.atan2(4, 1))


def test_a_wind_that_the_froya_formula_does_not_reach_near_the_sea_is_refused():
    """u (1 + 0.0573 √(1 + 0.15u) ln(z/10)) at z = 0.2 m has its greatest, 13.4 m/s, where its derivative is nothing"""
    u = np.linspace(0.0, 200.0, 200001)
    top = np.max(u * (1 + 0.0573 * np.sqrt(1 + 0.15 * u) * math.log(0.02)))
    assert mean_over(0.99 * top, 3600, 600, 0.2) > 0.99 * top
    with pytest.raises(ValueError, match=r"of 0\.2 m; the Frøya formula reaches at most .* give the wind at 10 m"):
        mean_over(1.01 * top, 3600, 600, 0.2)
    assert mean_over(1.01 * top, 3600, 3600, 0.2) == 1.01 * top
