"""A body in a sea state and in a climate, and what is said about it."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_up_body import made_up_body, thinned

from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.mooring.environment.scatter import Scatter
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.environment.wave_records import real_sum
from hakobune.mooring.response.climate import climate
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.response.long_term import YEAR
from hakobune.mooring.response.points import KeelPoint, Point
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.slow_drift import component_drift, force_spectrum, held_beyond, newman
from hakobune.pipelines.cli import main

HOUR = 3600.0
PUBLISHED = Path(__file__).parents[2] / "published" / "model_irregular_waves.csv"
SCENE = Path(pipelines.__file__).parent / "scenes" / "model_M3B_d194.toml"


def test_standard_deviations_are_those_of_records_made_with_the_same_transfer_functions(box_body):
    """Heave of twelve hours of components: the scatter of its deviation is about 1 %, four of it allowed."""
    sea = Sea(issc(3.0, mean_period=11.0), np.radians(30.0))
    low, high = box_body.omega[0], box_body.omega[-1]
    with pytest.warns(UserWarning, match="of the energy"):
        waves = sea.components(1500, 1, low=low, high=high)
    x = box_body.motions(waves.omega, [sea.direction])[:, 0]
    result = sea_state(box_body, sea, 3 * HOUR)
    t = np.arange(0, 12 * HOUR, 1.0)
    for mode in (2, 3, 4):
        record = real_sum(x[:, mode] * waves.amplitude * np.exp(1j * waves.phase), waves.omega, t)
        assert np.isclose(record.std(), result.sigma[mode], rtol=0.04)
        crossings = np.count_nonzero((record[:-1] < 0) & (record[1:] >= 0))
        assert np.isclose(12 * HOUR / crossings, result.zero_period[mode], rtol=0.04)


def test_responses_that_symmetry_makes_zero_are_zero_and_have_no_extreme(box_body):
    result = sea_state(box_body, Sea(issc(3.0, mean_period=10.0), 0.0), 3 * HOUR)
    assert np.all(result.sigma[[1, 3, 5]] == 0) and np.all(result.expected_maximum[[1, 3, 5]] == 0)
    assert np.all(result.sigma[[0, 2, 4]] > 0)


def test_extremes_grow_with_the_duration_and_statistics_with_the_height(box_body):
    sea = Sea(issc(3.0, mean_period=10.0), 0.0)
    short, long = (sea_state(box_body, sea, hours * HOUR) for hours in (1, 10))
    assert np.all(long.expected_maximum[[0, 2, 4]] > short.expected_maximum[[0, 2, 4]])
    assert np.all(short.not_exceeded(0.9)[[0, 2, 4]] > short.expected_maximum[[0, 2, 4]])
    double = sea_state(box_body, Sea(issc(6.0, mean_period=10.0), 0.0), HOUR)
    assert np.allclose(double.sigma, 2 * short.sigma)
    assert np.allclose(double.slow.drift, 4 * short.slow.drift)
    assert np.allclose(double.slow.spectrum, 16 * short.slow.spectrum)


def test_slow_drift_of_a_sea_state_is_that_of_records_with_waves_beyond_the_database(box_body):
    """Deviation of four records of three hours, beats of all frequencies, against ∫S_F.

    One record of 600 components of given amplitude scatters by 2.5 %; four standard errors are allowed.
    """
    sea = Sea(issc(3.0, mean_period=8.0), np.radians(60.0))
    omega = frequencies(box_body, sea.spectrum.density)
    D = box_body.drift(omega, [sea.direction])[:, 0]
    difference = np.linspace(0, 1.6, 1601)
    theory = force_spectrum(sea.spectrum, *held_beyond(omega, D, sea.spectrum), difference)
    sigma = []
    for seed in range(4):
        waves = sea.components(600, seed)
        sigma.append(
            newman(waves, component_drift(box_body, waves, hold=True), np.arange(0, 3 * HOUR, 1.0)).std(axis=0)
        )
    expected = np.sqrt(np.trapezoid(theory, difference, axis=0))
    assert np.allclose(np.mean(sigma, axis=0)[:2], expected[:2], rtol=0.05)
    shown = sea_state(box_body, sea, HOUR).slow
    assert np.allclose(shown.spectrum[::20], theory[:201:50], rtol=1e-6)


def test_air_gap_is_clearance_less_the_largest_rise(box_body):
    points = [Point("bow", (50.0, 0.0, 10.0), 8.0), Point("deck", (0.0, 0.0, 10.0))]
    result = sea_state(box_body, Sea(issc(4.5, mean_period=10.0), np.pi), 3 * HOUR, points)
    ((name, (clearance, left, reached)),) = result.air_gaps().items()
    rise = result.names.index("bow relative elevation")
    assert name == "bow" and np.isclose(left, clearance - result.expected_maximum[rise])
    # the level not exceeded with 1 − p is the clearance
    assert np.isclose(result.not_exceeded(1 - reached)[rise], clearance)


def test_waves_beyond_the_database_are_named_with_their_share(box_body):
    result = sea_state(box_body, Sea(issc(2.0, mean_period=6.0), 0.0), HOUR, [Point("bow", (50.0, 0.0, 5.0))])
    share = 100 * result.sea.spectrum.moment(0, box_body.omega[-1], np.inf) / result.sea.spectrum.moment(0)
    said = "\n".join(result.warnings)
    assert f"{share:.1f} % of the wave energy is in waves shorter than the stored 5.98 s" in said
    assert "bow relative elevation" in said and "% of the mean drift force is due to waves beyond" in said


def test_a_sea_mostly_outside_the_database_is_refused(box_body):
    with pytest.raises(
        BetweenError, match=r"of mean period 60.* is outside the stored 5.984 to 25.13 s; allowed: 50 %"
    ):
        sea_state(box_body, Sea(issc(2.0, mean_period=60.0), 0.0), HOUR)


def test_waves_longer_than_the_database_are_named_too(box_body):
    result = sea_state(box_body, Sea(issc(2.0, mean_period=20.0), 0.0), HOUR)
    assert any("waves longer than the stored 25.1 s" in w for w in result.warnings)
    assert any(
        "responses do not include energy beyond the stored frequencies" in w and "heave" in w for w in result.warnings
    )


def test_a_coarse_database_says_that_its_results_are_not_sure(box_body):
    """Drift without Kochin functions may have missed a resonance between its frequencies"""
    sea, coarse = Sea(issc(2.0, mean_period=8.0), np.pi / 2), thinned(thinned(box_body))
    left = {name: v for name, v in coarse.between.quantities.items() if not name.startswith("kochin")}
    alone = replace(coarse, between=replace(coarse.between, quantities=left))
    said = [w for w in sea_state(alone, sea, HOUR).warnings if "uncertain between stored waves" in w]
    assert len(said) == 1 and "mean drift" in said[0] and "Kochin functions" in said[0]
    assert not any("uncertain between stored waves" in w for w in sea_state(box_body, sea, HOUR).warnings)
    with pytest.raises(BetweenError, match="interpolation needs at least 4 stored frequencies, and 3 are stored"):
        sea_state(thinned(thinned(thinned(box_body))), sea, HOUR)


def test_short_waves_between_headings_far_apart_are_said_to_be_uncertain():
    between = sea_state(made_up_body(), Sea(issc(1.0, mean_period=8.0), np.radians(45.0)), HOUR)
    assert any("uncertain between stored waves" in w for w in between.warnings)
    stored = sea_state(made_up_body(), Sea(issc(1.0, mean_period=8.0), np.radians(60.0)), HOUR)
    assert not any("uncertain" in w for w in stored.warnings)


def test_a_database_without_drift_gives_the_linear_part():
    result = sea_state(made_up_body(), Sea(issc(1.0, mean_period=9.0), 0.0), HOUR)
    assert result.slow is None and result.sigma[2] > 0
    with pytest.raises(ValueError, match="duration is 0 s"):
        sea_state(made_up_body(), Sea(issc(1.0, mean_period=9.0), 0.0), 0.0)


@pytest.mark.parametrize("spread", [None, CosinePower(4.0)])
def test_every_cell_of_a_climate_is_its_sea_state(box_body, spread):
    scatter = Scatter([1.0, 3.0], [8.0, 11.0], [[3.0, 2.0], [0.0, 1.0]], "mean_period")
    if spread:  # short crests take ten times as long
        scatter = Scatter([3.0], [11.0], [[1.0]], "mean_period")
    towards = [(0.0, 0.75), (np.pi / 2, 0.25)]
    found = climate(box_body, scatter, issc, towards, spread and (lambda spectrum: spread))
    assert len(found.height) == (2 if spread else 6) and np.isclose(found.probability.sum(), 1.0)
    for i in range(len(found.height)):
        alone = sea_state(
            box_body, Sea(issc(found.height[i], mean_period=found.period[i]), found.direction[i], spread), HOUR
        )
        kept = alone.sigma > 0
        assert np.allclose(found.m0[i][kept], alone.moments.m0[kept], rtol=1e-9)
        assert np.allclose(found.drift[i], alone.slow.drift, rtol=1e-9, atol=1e-9 * np.abs(alone.slow.drift).max())


def test_climate_of_one_state_has_the_extremes_of_that_state(box_body):
    scatter = Scatter([2.0], [10.0], [[1.0]], "mean_period")
    found = climate(box_body, scatter, issc, [(np.pi / 2, 1.0)])
    state = sea_state(box_body, Sea(issc(2.0, mean_period=10.0), np.pi / 2), YEAR)
    roll = found.long_term("roll")
    assert np.isclose(roll.level(YEAR), state.not_exceeded(np.exp(-1))[3], rtol=1e-9)
    with pytest.raises(ValueError, match="there is no response named 'rol'"):
        found.long_term("rol")
    with pytest.raises(ValueError, match=r"shares of the directions sum to 0.9"):
        climate(box_body, scatter, issc, [(0.0, 0.9)])


def measured(incidence, column):
    """Mean over six runs of the measured deviation per deviation of the waves"""
    with PUBLISHED.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return np.mean([float(r[column]) / float(r["wave_cm"]) for r in rows if r["incidence_deg"] == incidence])


def test_model_in_irregular_waves_responds_as_measured(tmp_path):
    """Standard deviations per that of the waves, M3B of the SR179 report (1982), appendix 1.

    Pitch is within 8 % ahead and 15 % at 45°, roll 20 % and heave 30 % too large: the calculation has no viscous
    damping, and the waves of the tank lack the long ones of the ISSC spectrum.  Both make the calculation exceed.
    """
    path = tmp_path / "model.h5"
    words = ["--panels", "100", "--omega", "0.9:6.5:15", "--heading", "0,45", "--only", "radiation,excitation_force"]
    assert main(["solve", str(SCENE), *words, "--output", str(path)]) == 0
    body = open_database(path).reader.floating()
    wave = np.sqrt(issc(0.113, mean_period=2.19).moment(0))
    for incidence, limits in (("0", {"heave": 0.3, "pitch": 0.08}), ("45", {"heave": 0.3, "roll": 0.2, "pitch": 0.15})):
        sea = Sea(issc(0.113, mean_period=2.19), np.radians(180 + float(incidence)))
        result = sea_state(body, sea, 600.0)
        for name, limit in limits.items():
            unit, factor = ("cm", 1.0) if name == "heave" else ("deg", np.degrees(0.01))
            ratio = result.sigma[result.names.index(name)] / wave * factor
            excess = ratio / measured(incidence, f"{name}_{unit}") - 1
            assert 0 < excess < limit, (incidence, name, excess)
    damped = np.zeros((6, 6))
    damped[3, 3] = 0.02 * body.critical_damping(3)
    less = sea_state(body.restrained(damping=damped), sea, 600.0)
    assert less.sigma[3] < 0.95 * result.sigma[3] and np.isclose(less.sigma[2], result.sigma[2], rtol=1e-6)


@pytest.mark.parametrize("level", [3.6, 4.0])
def test_the_bed_is_touched_as_often_as_in_simulated_half_hours(box_body, level):
    """A corner of the bottom above a bed `level` deviations away, in 400 half hours of 500 random waves

    The share of the half hours is binomial: three of its standard deviations are allowed.
    """
    sea, corner = Sea(issc(3.0, mean_period=11.0), np.radians(60.0)), (50.0, 25.0, -10.0)
    sigma = sea_state(box_body, sea, HOUR, [KeelPoint("keel", corner, 1.0)]).sigma[-1]
    state = sea_state(box_body, sea, HOUR / 2, [KeelPoint("keel", corner, level * sigma)])
    ((gap, left, touched),) = state.under_keel().values()
    assert np.isclose(left, gap - state.expected_maximum[-1])
    omega = np.linspace(box_body.omega[0], box_body.omega[-1], 500)  # a record repeats after 3900 s
    X = box_body.motions(omega, [sea.direction])[:, 0]
    vertical = X[:, 2] + corner[1] * X[:, 3] - corner[0] * X[:, 4]
    amplitude = vertical * np.sqrt(sea.spectrum.density(omega) * (omega[1] - omega[0]))
    waves = np.exp(-1j * np.outer(omega, np.arange(0, HOUR / 2, 0.5)))
    rng, hours = np.random.default_rng(2), 400
    records = ((rng.standard_normal((hours, 500)) + 1j * rng.standard_normal((hours, 500))) * amplitude @ waves).real
    share, scatter = np.mean(records.min(axis=1) < -gap), np.sqrt(touched * (1 - touched) / hours)
    assert 0.02 < touched < 0.98 and abs(share - touched) < 3 * scatter, (share, touched)
