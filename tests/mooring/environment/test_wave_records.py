"""Records of waves: the sum itself, its statistics against theory, files."""

import numpy as np
import pytest
from scipy.stats import kstest

from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import issc, jonswap
from hakobune.mooring.environment.spectrum_estimate import estimate
from hakobune.mooring.environment.spreading import HalfCosinePower
from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.environment.wave_records import Record, components_of, elevation, read_record, write_record

WIND_SEA, SWELL = issc(3.0, mean_period=8.0), jonswap(2.0, peak_period=12.0)
THREE_HOURS = 0.5 * np.arange(21600)


def one_wave(omega, amplitude=1.0, phase=0.0, direction=0.0):
    return Components(*(np.array([value]) for value in (omega, amplitude, phase, direction)))


def test_a_record_is_the_sum_of_its_cosines():
    components = Sea(WIND_SEA, 0.4, HalfCosinePower(5)).components(60, 1)
    k = components.omega**2 / 9.80665
    x, y = 31.0, -12.0
    lag = components.phase + k * (x * np.cos(components.direction) + y * np.sin(components.direction))
    uneven = np.sort(np.random.default_rng(2).uniform(-500, 9000, 300))
    for t in (1e4 + 0.37 * np.arange(1001), np.array([3.0]), -5.0 + 0.1 * np.arange(7), uneven):
        found = elevation(components, t, x, y)
        cosines = np.cos(lag - np.outer(t, components.omega)) @ components.amplitude
        assert np.abs(found - cosines).max() < 1e-11


def test_a_wave_reaches_its_crest_by_its_phase_lag_and_travels_towards_its_direction():
    omega, depth, direction = 0.6, 20.0, np.deg2rad(120)
    t = np.linspace(0, 10, 2001)
    assert abs(t[np.argmax(elevation(one_wave(omega, 1.0, 0.9), t))] - 0.9 / omega) < 0.005
    k = omega  # from the dispersion equation, by halving
    low, high = 0.0, 1.0
    for _ in range(60):
        k = 0.5 * (low + high)
        low, high = (k, high) if 9.80665 * k * np.tanh(k * depth) < omega**2 else (low, k)
    start = elevation(one_wave(omega, 1.0, 0.9, direction), t, depth=depth)
    r = 50.0
    there = elevation(
        one_wave(omega, 1.0, 0.9, direction), t + r * k / omega, r * np.cos(direction), r * np.sin(direction), depth
    )
    np.testing.assert_allclose(there, start, atol=1e-12)


@pytest.mark.parametrize("spectrum", [WIND_SEA, SWELL], ids=str)
@pytest.mark.parametrize("spreading", [None, HalfCosinePower(10)], ids=["long crests", "short crests"])
def test_three_hours_hold_the_energy_of_the_spectrum_at_every_point(spectrum, spreading):
    sea = Sea(spectrum, 0.3, spreading)
    for seed in range(10):
        components = sea.components(500, seed)
        for x, y in ((0.0, 0.0), (170.0, -60.0), (3000.0, 2000.0)):
            record = elevation(components, THREE_HOURS, x, y, depth=30.0)
            assert abs(np.var(record) / spectrum.moment(0) - 1) < 0.02


def share_inside(spectrum, record):
    """Share of the frequencies that hold the energy at which the spectrum is inside the 95 % band; their number"""
    estimated = estimate(record, 0.5)
    low, high = estimated.confidence(0.95)
    ends = spectrum.quantile([0.02, 0.95])
    held = (estimated.omega > ends[0]) & (estimated.omega < ends[1])
    true = spectrum.density(estimated.omega[held])
    return np.mean((low[held] < true) & (true < high[held])), np.count_nonzero(held)


@pytest.mark.parametrize("spectrum", [WIND_SEA, SWELL], ids=str)
@pytest.mark.parametrize("frequencies", ["equal_step", "equal_energy"])
def test_more_than_95_per_cent_of_the_spectrum_lie_in_the_confidence_band_of_its_records(spectrum, frequencies):
    """Amplitudes that are not random scatter less than χ²."""
    found = [
        share_inside(spectrum, elevation(Sea(spectrum).components(500, seed, frequencies=frequencies), THREE_HOURS))
        for seed in range(6)
    ]
    assert np.mean([share for share, _ in found]) > 0.95


def test_random_amplitudes_scatter_as_the_confidence_band_says():
    """Components as close as three hours resolve; windowed neighbours share two thirds, so a third count as one."""
    shares, counts = [], []
    for seed in range(6):
        components = Sea(WIND_SEA).components(6500, seed, amplitudes="random")
        share, count = share_inside(WIND_SEA, elevation(components, THREE_HOURS))
        shares.append(share)
        counts.append(count / 3)
    assert abs(np.mean(shares) - 0.95) < 3 * np.sqrt(0.95 * 0.05 / np.sum(counts))


@pytest.mark.parametrize("amplitudes", ["deterministic", "random"])
def test_elevations_are_normally_distributed(amplitudes):
    """One value of each of many seas is independent of the others: Kolmogorov-Smirnov at the level 0.1 %."""
    sea = Sea(WIND_SEA, 0.0, HalfCosinePower(10))
    t, values = np.array([0.0, 1000.0, 2000.0, 3000.0]), []
    for seed in range(400):
        values.append(elevation(sea.components(100, seed, amplitudes=amplitudes), t, 20.0, 5.0))
    z = np.concatenate(values) / np.sqrt(WIND_SEA.moment(0))
    assert kstest(z, "norm").pvalue > 1e-3
    n = len(z)
    assert abs(np.mean(z**3)) < 4 * np.sqrt(15 / n)
    assert abs(np.mean(z**4) - 3) < 4 * np.sqrt(96 / n)


@pytest.mark.parametrize("frequencies", ["equal_step", "equal_energy"])
def test_no_record_repeats(frequencies):
    """A lag at which it did would have correlation 1.

    Chance gives one of variance π∫S²dω/(T m₀²) from the length of the record, and Σeᵢ²/2m₀² from n cosines of energy
    eᵢ; 0.09 here, five times that at most.  Cosines of exactly equal spacing Δω repeat after 2π/Δω, 970 s here.
    """
    components = Sea(WIND_SEA).components(500, 3, frequencies=frequencies)
    record = elevation(components, THREE_HOURS)
    record = record - record.mean()
    n, lags = len(record), np.arange(600, 14400, dtype=int)
    power = np.abs(np.fft.rfft(record, 2 * n)) ** 2
    correlation = np.fft.irfft(power)[:n] / (np.arange(n, 0, -1) * record.var())
    omega = np.linspace(0.01, 4, 4000)
    roughness = np.sum(WIND_SEA.density(omega) ** 2) * (omega[1] - omega[0]) / WIND_SEA.moment(0) ** 2
    few = 0.5 * np.sum((0.5 * components.amplitude**2) ** 2) / WIND_SEA.moment(0) ** 2
    chance = np.sqrt(np.pi * roughness / (0.5 * (n - lags)) + few)
    assert chance.max() < 0.1
    assert np.all(np.abs(correlation[lags]) < 5 * chance)


def test_a_record_comes_back_from_its_file(tmp_path):
    made = Record(elevation(Sea(SWELL).components(50, 1), 5 + 0.25 * np.arange(200)), 0.25, 5.0)
    write_record(tmp_path / "waves.csv", made, "of a swell\nsecond line")
    read = read_record(tmp_path / "waves.csv")
    assert (read.step, read.start) == (0.25, 5.0)
    np.testing.assert_allclose(read.elevation, made.elevation, rtol=1e-5)
    np.testing.assert_allclose(read.time, made.time)


@pytest.mark.parametrize("text", ["t;eta\n0;1\n2;3\n4;1\n", "0 1\n2 3\n4 1", "# x\n0\t1\n2\t3\n4\t1\n\n"])
def test_columns_may_be_parted_by_any_usual_mark(tmp_path, text):
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    read = read_record(tmp_path / "a.txt")
    assert read.step == 2.0 and read.elevation.tolist() == [1, 3, 1]


@pytest.mark.parametrize(
    ("head", "time", "height"),
    [("Time (s),eta (mm)", 1.0, 1e-3), ("Time (ms),eta [cm]", 1e-3, 1e-2), ("t [min],probe_ft", 60.0, 0.3048),
     ("time_s,elevation_m", 1.0, 1.0), ("t,eta", 1.0, 1.0), ("t, WP1 mm", 1.0, 1e-3)],
)  # fmt: skip
def test_units_in_the_head_of_a_record_count(tmp_path, head, time, height):
    (tmp_path / "a.csv").write_text(f"{head}\n0,10\n2,30\n4,10\n", encoding="utf-8")
    read = read_record(tmp_path / "a.csv")
    assert read.step == pytest.approx(2 * time)
    assert read.elevation == pytest.approx([10 * height, 30 * height, 10 * height])


def test_a_unit_that_is_not_known_is_named_with_its_column(tmp_path):
    (tmp_path / "a.csv").write_text("t (s),eta (furlong)\n0,1\n1,2\n", encoding="utf-8")
    with pytest.raises(TableError, match=r"column 'eta \(furlong\)' has the unit 'furlong'; allowed: m, mm"):
        read_record(tmp_path / "a.csv")


def test_a_comma_is_a_decimal_mark_where_semicolons_separate_columns(tmp_path):
    (tmp_path / "a.csv").write_text("Zeit [s];WP1 [m]\n0,0000;-0,0452\n0,0500;-0,0551\n", encoding="utf-8")
    read = read_record(tmp_path / "a.csv")
    assert read.step == pytest.approx(0.05) and read.elevation == pytest.approx([-0.0452, -0.0551])


WAYS = {
    "a preamble, units in a line of their own, a foot, as of OpenFAST": (
        "Made on 19-Oct-2018 at 10:15\n\n   Time     Wave1Elev\n  (sec)       (mm)\n 0.0  1.0e+03\n 2.0 -1.0E3\n"
        "Closed on 19-Oct\n", 2.0, [1.0, -1.0]),
    "names with blanks, tabs": ("Time (ms)\tprobe 1 (cm)\n0\t100\n250\t-100\n", 0.25, [1.0, -1.0]),
    "colons": ("0 : -0\n0.5 : 1\n", 0.5, [0.0, 1.0]),
    "dates": ("time;eta\n2026-01-02 23:59:59,5;1\n2026-01-03 00:00:00;2\n", 0.5, [1.0, 2.0]),
    "dates of the south, blanks": ("02.01.2026 03:04:05 1.0\n02.01.2026 03:05:05 2.0\n", 60.0, [1.0, 2.0]),
    "dates as one word": ("UTC,eta (ft)\n2026-01-02T03:04:05Z,1\n2026-01-02T03:04:05.25Z,2\n", 0.25, [0.3048, 0.6096]),
    "decimal commas between blanks": ("0,00  0,10\n0,50  -0,10\n", 0.5, [0.1, -0.1]),
    "points of thousands": ("Zeit [s];WP [mm]\n999,5;1.234,5\n1.000,0;-2.000\n", 0.5, [1.2345, -2.0]),
    "gaps in a column that is not used": ("t,eta,other\n0,1,\n1,2,nan\n", 1.0, [1.0, 2.0]),
}  # fmt: skip


@pytest.mark.parametrize("way", WAYS)
def test_records_are_read_as_loggers_and_programs_write_them(tmp_path, way):
    text, step, wanted = WAYS[way]
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    read = read_record(tmp_path / "a.txt")
    assert read.step == pytest.approx(step)
    assert read.elevation == pytest.approx(wanted)


def test_gaps_and_odd_words_have_their_lines(tmp_path):
    for text, says in (
        (
            "t,eta\n# a remark\n0,1\n1,\n2,-\n3,1\n",
            "line 4 has no finite number, the first of 2 gaps; fill in the value",
        ),
        ("t,eta\n0,1\n1,abc\n2,1\n", "line 3 has 'abc'; allowed: numbers"),
        ("head\nt,eta\n0,1\n1,1,1\n", "line 4 has 3 columns; allowed: 2"),
        ("head\nt,eta\n\n0,1\n1,1\n2,1\n4,1\n", "line 7: the time goes from 2 to 4 s,"),
        ("t,eta\n", "no rows of numbers"),
        ("t;eta\n0,5;1.25\n1,0;2\n", "line 2 has '1.25'; allowed: numbers with the same decimal mark"),
    ):
        (tmp_path / "a.txt").write_text(text, encoding="utf-8")
        with pytest.raises(TableError, match=says):
            read_record(tmp_path / "a.txt")


def test_a_column_is_found_by_its_name_and_a_lone_one_needs_its_step(tmp_path):
    (tmp_path / "a.csv").write_text("t,heave,eta\n0,9,1\n1,9,3\n2,9,1\n", encoding="utf-8")
    assert read_record(tmp_path / "a.csv", column="eta").elevation.tolist() == [1, 3, 1]
    (tmp_path / "b.csv").write_text("1\n3\n1\n", encoding="utf-8")
    assert read_record(tmp_path / "b.csv", step=0.2).time.tolist() == pytest.approx([0, 0.2, 0.4])


@pytest.mark.parametrize(
    ("text", "step", "words"),
    [
        (
            "t,eta\n0,1\n1,2\n3,1\n4,2\n",
            None,
            "line 4: the time goes from 1 to 3 s, and the step elsewhere is 1 s: 1 row is missing",
        ),
        ("t,eta\n0,1\n1,2\n2.4,1\n3.1,2\n4,1\n", None, "from 0.7 to 1.4 s in the file; allowed: equal steps; interp"),
        ("t,eta\n0,1\n1,\n2,1\n", None, "line 3 has no finite number"),
        ("t,eta\n0,1\n1,nan\n", None, "line 3 has no finite number"),
        ("t,eta\n0,1\n1,2,3\n", None, "line 3 has 3 columns; allowed: 2"),
        ("t,eta\n0,1\n1,2\n", 0.5, "has a time column, but a step of 0.5 s is given as well; leave out the step"),
        ("1\n2\n", None, "give the step"),
        ("t,eta\n", None, "no rows of numbers"),
        ("", None, "has no rows"),
        ("t,eta\n1,2\n", None, "has one row"),
        ("t,eta\n2,2\n1,2\n0,1\n", None, "allowed: increasing times at equal steps"),
    ],
)
def test_what_is_no_record_is_refused(tmp_path, text, step, words):
    (tmp_path / "bad.csv").write_text(text, encoding="utf-8")
    with pytest.raises(TableError, match=words):
        read_record(tmp_path / "bad.csv", step)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(TableError, match=r"none\.csv does not exist"):
        read_record(tmp_path / "none.csv")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([0.0, np.nan],), "time is nan at index 1"),
        (([0.0, 1.0], np.inf), "point is"),
        (([0.0, 1.0], 0.0, 0.0, -5.0), "water depth is -5 m"),
        (([0.0, 1.0], 0.0, 0.0, 5.0, 0.0), "gravity is 0"),
    ],
)
def test_what_cannot_be_is_refused_by_name(arguments, words):
    with pytest.raises(ValueError, match=words):
        elevation(one_wave(0.5), *arguments)


def test_components_of_a_record_make_it_again_and_leave_short_waves_out():
    rng = np.random.default_rng(5)
    record = Record(rng.standard_normal(601), 0.5, 3.0)
    made = components_of(record, 0.7)
    again = elevation(made, 0.5 * np.arange(601))
    assert np.abs(again - (record.elevation - record.elevation.mean())).max() < 1e-4
    assert np.all(made.direction == 0.7) and made.amplitude.min() > 0
    long = components_of(record, 0.7, shortest=5.0)
    assert len(long.omega) == 60 and long.omega.max() <= 2 * np.pi / 5
