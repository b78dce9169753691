"""Bound long waves in a simulation: superposition on linear springs, and where they are refused."""

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.motion.given_forces import GivenForce
from hakobune.mooring.motion.simulation import simulate, wave_components
from hakobune.mooring.motion.simulation.loads import pairs
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.response.bound_wave_drift import bound_to_newman, depth_in_waves, left_out, of_sea, record
from hakobune.mooring.response.slow_drift import differences, force_spectrum, force_spectrum_with, held_beyond

SWELL = Sea(jonswap(0.5, peak_period=14.0), 0.4)


def test_on_linear_springs_they_add_what_their_force_does_alone(database, on_springs):
    """To the first order in what they add: waves are felt where the body slowly is, 16 µm beside with them"""
    low = Sea(jonswap(0.02, peak_period=14.0), 0.4)
    settings = Settings(duration=200.0, ramp=100.0, tolerance=1e-6, components=30, slow_drift="none")
    with_them = Weather(seas=(low,), beside_newman=(of_sea(database, low),))
    both, waves = (simulate(on_springs, weather, settings, 3) for weather in (with_them, Weather(seas=(low,))))
    parts = wave_components(on_springs, with_them, settings, 3)
    t, force = record(with_them.beside_newman[0], parts, 300.0)
    alone = simulate(on_springs, Weather(forces=(GivenForce(t - 100.0, force),)), settings)
    added = both.motion - waves.motion
    largest = np.abs(alone.motion).max(axis=0)[:3]
    assert largest[:2].min() > 3e-6
    assert np.all(np.abs(added - alone.motion).max(axis=0)[:3] < 1e-2 * largest)


def test_what_is_left_out_is_said_of_swell_and_not_of_short_waves(database):
    body = database.reader.floating()
    said = list(left_out(body, SWELL))
    assert (
        len(said) == 1
        and said[0].startswith("left out: bound long waves; at the mean wave period (kh = 0.8")
        and 'qtf = "auto"' in said[0]
    )
    assert not list(left_out(body, Sea(jonswap(0.5, peak_period=6.0), 0.4)))


@pytest.mark.filterwarnings("ignore")
def test_beside_next_to_no_drift_a_force_is_told_and_no_ratio_and_of_waves_beyond_second_order_nothing(database):
    """Waves of 36 s: the drift vanishes like ω⁴ and more, the slope of the long waves stays.  On either side of
    Hλ²/h³ = 40, λ = 2πh/kh, one line or the other; a sea of a tenth of a millimetre has no line at all"""
    body = database.reader.floating()
    kh = depth_in_waves(body, Sea(jonswap(1.0, peak_period=36.0)))
    limit = 40 * 20.0 * (kh / (2 * np.pi)) ** 2
    (below,) = left_out(body, Sea(jonswap(0.95 * limit, peak_period=36.0)))
    (above,) = left_out(body, Sea(jonswap(1.05 * limit, peak_period=36.0)))
    assert "σ " in below and "kN by Newman's approximation" in below and "times" not in below
    assert above.startswith("left out: ") and "the second-order expansion is not valid" in above
    ratio = bound_to_newman(body, Sea(jonswap(0.95 * limit, peak_period=36.0)))
    assert ratio > 10
    assert not list(left_out(body, Sea(jonswap(1e-4, peak_period=36.0))))


@pytest.mark.parametrize("period", [6.0, 12.0])
def test_their_size_is_estimated_within_a_factor_of_two(database, period):
    body, sea = database.reader.floating(), Sea(jonswap(0.5, peak_period=period), 0.4)
    omega = np.linspace(body.omega[0], body.omega[-1], 200)
    omega, D = held_beyond(omega, body.drift(omega, [0.4])[:, 0], sea.spectrum)
    step = differences(body)[::4]
    solved = force_spectrum_with(of_sea(database, sea), sea.spectrum, omega, np.zeros_like(D), step)
    newman = force_spectrum(sea.spectrum, omega, D, step)
    part, whole = (np.trapezoid(one[:, :2].sum(axis=1), step) for one in (solved, newman))
    assert 0.5 < bound_to_newman(body, sea) / np.sqrt(part / whole) < 2


def test_each_of_several_seas_has_its_own_bound_waves_and_short_crests_have_none(database, on_springs):
    with pytest.raises(ValueError, match="allowed: one force for each sea"):
        Weather(seas=(SWELL, SWELL), beside_newman=(object(),))
    settings, ripples = Settings(100.0, ramp=50.0, components=30), Sea(jonswap(0.2, peak_period=7.0), 0.4)
    bound = of_sea(database, SWELL)
    both = Weather(seas=(ripples, SWELL), beside_newman=(None, bound))
    components = wave_components(on_springs, both, settings, 3)
    (found,) = pairs(on_springs, both, settings, components)
    t, force = record(bound, Components(*(part[30:] for part in components)), 150.0)
    assert np.array_equal(found.force, force) and np.array_equal(found.times, t - 50.0)
    from hakobune.mooring.seas.systems import Systems

    with pytest.raises(ValueError, match="several directions"):
        of_sea(database, Systems((SWELL, Sea(jonswap(0.5, peak_period=8.0), 1.0))))
