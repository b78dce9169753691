"""What surrounds a run in time, by hand: scales, trials, findings, streams, given forces, statistics of its records."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain
from scipy.interpolate import PchipInterpolator

from hakobune.bem.modes import words_of
from hakobune.bem.time_domain.fewest_states import FitError
from hakobune.mooring.environment.gusts import davenport, gust_components
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.loads.box_drag import drag_table
from hakobune.mooring.motion import integrator, slow_damping
from hakobune.mooring.motion.contact_loads import DEPTH
from hakobune.mooring.motion.equation import BLOCK
from hakobune.mooring.motion.extremes import beyond, median_extreme, rare, share_beyond
from hakobune.mooring.motion.given_forces import GivenForce, faded, read_force, sampled
from hakobune.mooring.motion.line_loads import REACH
from hakobune.mooring.motion.simulation.expected import expected_motion
from hakobune.mooring.motion.simulation.failures import Overload, stopped
from hakobune.mooring.motion.simulation.loads import frequency_of_coefficients, mean_frequency, wave_components
from hakobune.mooring.motion.simulation.memory import fitted_memory
from hakobune.mooring.motion.simulation.realisation import Doubt, doubt_of, with_error
from hakobune.mooring.motion.simulation.run import _around, _current_at_lines, _of_lost
from hakobune.mooring.motion.simulation.trial import _drives, _named, _of_slow_motion, _of_tension, _Pace
from hakobune.mooring.motion.statistics import (
    RecordStatistics,
    highest_mean,
    parts,
    periods,
    record_statistics,
    stillness,
    without_rounding,
)
from hakobune.mooring.motion.streams import GUST_BAND, GUSTS, gust_at, wind_stream
from hakobune.mooring.motion.tables.wave_windows import HEADINGS
from hakobune.mooring.motion.wave_loads import WaveForces, drift_damping, drift_of, forces_towards
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Current, ExposedBox, Waves, Wind

WORDS = words_of(())


def components(omega, amplitude, direction=0.0):
    n = len(omega)
    return Components(np.array(omega, float), np.array(amplitude, float), np.zeros(n), np.full(n, direction))


# ------------------------------------------------------------------ records


def test_periods_of_two_waves_are_those_of_their_moments():
    """cos ωt of 2 and 1 m at 0.5 and 1 rad/s: m₀ = 2.5, m₂ = 0.5 + 0.5, m₄ = 1/8 + 1/2"""
    t = 0.2 * np.arange(62_832)  # 2000 and 4000 π seconds: whole periods
    record = 2 * np.cos(0.5 * t) + np.cos(t + 0.4)
    zero, peak, epsilon = periods(record, 0.2)
    assert zero == pytest.approx(2 * math.pi * math.sqrt(2.5), rel=1e-4)
    assert peak == pytest.approx(2 * math.pi * math.sqrt(1 / 0.625), rel=1e-4)
    assert epsilon == pytest.approx(math.sqrt(1 - 1 / (2.5 * 0.625)), rel=1e-3)


def test_differences_of_a_cubic_and_a_quartic_are_exact():
    """27/24 and 1/24 of four values have the slope of a cubic in their middle, 16, 30 and 1/12 of five the bend"""
    x = np.arange(8.0) - 1.0
    zero, _, _ = periods(x**3 / 6, 1.0)
    slope = 0.5 * (np.arange(5) + 0.5) ** 2
    assert zero == pytest.approx(2 * math.pi * math.sqrt(np.mean((x**3 / 6) ** 2) / np.mean(slope**2)), rel=1e-12)
    _, peak, _ = periods(x**4 / 12, 1.0)
    slope, bend = (np.arange(5) + 0.5) ** 3 / 3 + (np.arange(5) + 0.5) * (1 / 12 - 1 / 12), np.arange(1.0, 5.0) ** 2
    assert peak == pytest.approx(2 * math.pi * math.sqrt(np.mean(slope**2) / np.mean(bend**2)), rel=5e-3)


@pytest.mark.parametrize("count", [64, 65])
def test_the_last_frequency_of_an_even_record_is_single(count):
    """Parseval: σ² = Σ over both parts, of a record that turns at every step, and of one that does not"""
    rng = np.random.default_rng(3)
    record = rng.normal(size=count)
    record -= record.mean()
    slow, wave = parts(record, 0.5, 1.0)
    assert slow**2 + wave**2 == pytest.approx(np.mean(record**2), rel=1e-12)
    turns = np.where(np.arange(64) % 2, 1.0, -1.0)
    assert parts(turns, 0.5, 1.0) == pytest.approx((0.0, 1.0), abs=1e-12)


def test_the_highest_third_of_ten_maxima_are_three_and_a_tenth_one():
    falling = np.arange(10.0, 0.0, -1.0)
    assert (
        highest_mean(falling, 1 / 3) == 9.0
        and highest_mean(falling, 0.1) == 10.0
        and highest_mean(falling, 0.01) == 10.0
    )
    assert math.isnan(highest_mean(falling[:0], 0.5))


def test_the_expected_extreme_is_that_of_the_duration_asked_for():
    """σ (s + γ/s), s = √(2 ln n): a sine of 10 s and σ = 1/√2, 100 waves in 1000 s; none in fewer than three"""
    t = 0.5 * np.arange(1200)
    record = np.sin(0.2 * math.pi * t)
    s = math.sqrt(2 * math.log(100))
    found = record_statistics(record, 0.5, 0.1, 1000.0)
    assert found.extreme == pytest.approx(math.sqrt(0.5) * (s + 0.5772 / s), rel=1e-3)
    own = math.sqrt(2 * math.log(60))
    assert record_statistics(record, 0.5, 0.1).extreme == pytest.approx(math.sqrt(0.5) * (own + 0.5772 / own), rel=1e-3)
    assert math.isnan(record_statistics(record, 0.5, 0.1, 29.9).extreme)
    assert record_statistics(record, 0.5, 0.1, 30.1).extreme > 0


def test_a_record_that_does_not_vary_has_its_level_and_no_maxima():
    found = record_statistics(np.full(50, 7.0), 0.5, 0.1)
    assert (found.mean, found.largest, found.smallest, found.slow, found.wave) == (7.0, 7.0, 7.0, 0.0, 0.0)
    assert all(math.isnan(value) for value in found[4:9]) and math.isnan(found.extreme)
    for wrong in (np.zeros(7), np.full(9, np.nan), np.zeros((3, 9))):
        with pytest.raises(ValueError, match="at least 8 finite numbers"):
            record_statistics(wrong, 0.5, 0.1)


def test_what_is_rounding_beside_the_others_does_not_vary():
    """Of motions a millionth of the largest, an angle by half of a hull of 100 m; of forces alike; never below 1e-9 of

    the length or the weight.  A unit of another kind has no such limit"""
    found = stillness([2.0, 0.0, 0.01, 3e6, 0.0, 5.0], ["m", "m", "rad", "N", "N", "s"], 100.0, 1e9)
    assert found == pytest.approx([2e-6, 2e-6, 4e-8, 3.0, 3.0, 0.0])
    assert stillness([0.0, 0.0], ["rad", "N"], 100.0, 1e9) == pytest.approx([1e-7 / 50, 1.0])
    assert stillness([0.1], ["rad"], 100.0, 1.0) == pytest.approx([5e-6 / 50])
    one = RecordStatistics(5.0, 1e-3, 1e-3, 1e-3, 9.0, 8.0, 0.1, 0.2, 0.3, 2.9e-3, -3.1e-3, 1.0)
    still = without_rounding(one, 1e-3)
    assert still[:4] == (5.0, 0.0, 0.0, 0.0) and still.largest == 0.0 and still.smallest == -3.1e-3
    assert without_rounding(one, 0.99e-3) is one


def test_the_interval_of_ten_runs_by_hand():
    """Binomial (10, ½): 1 − 2·11/1024 = 0.9785 for d = 2, 1 − 2·56/1024 = 0.8906 for d = 3; 8 δ/(2 + 6 δ) inwards"""
    at, inside = 1 - 22 / 1024, 1 - 112 / 1024
    given = (at - 0.9) / (at - inside)
    inwards = 8 * given / (2 + 6 * given)
    x = np.array([1.0, 2, 4, 8, 16, 32, 64, 128, 256, 512])
    found = median_extreme(x[::-1])
    assert found == pytest.approx((24.0, 2 + 2 * inwards, 256 - 128 * inwards, 10), rel=1e-12)
    assert all(math.isnan(v) for v in median_extreme(x[:4])[:3]) and median_extreme(x[:4]).runs == 4


def test_shares_of_runs_beyond_all_of_them_and_beyond_a_limit():
    """0.1 = (1 − p)^n: of ten runs 20.6 %"""
    assert share_beyond(10) == pytest.approx(1 - 0.1**0.1, rel=1e-12)
    largest = np.array([[1.0, 1.0], [1.0, 1.1], [1.0, 0.9], [2.01, 1.99], [1.0, 1.0]])
    assert rare(largest).tolist() == [1, 0] and rare(largest[:4]).tolist() == [0, 0]
    assert beyond([[0.9, np.nan], [1.0, 1.0], [1.1, 2.0]], 1.0).tolist() == [1, 1]


# ------------------------------------------------------------------ scales, trials, doubts


def spring_waves(force):
    """Alike at all frequencies and headings: X = F/K of six motions, of a body of 4 kg and radii 2, 3, 5 m"""
    omega = np.linspace(0.4, 1.2, 9)
    parts = np.concatenate([np.real(force), np.imag(force)])
    waves = WaveForces(omega, np.broadcast_to(parts, (9, HEADINGS, 12)).copy(), None)
    stiffness = np.broadcast_to(np.diag([10.0, 20, 30, 40, 50, 60]).astype(complex), (9, 6, 6))
    inertia = np.diag([4.0, 4, 4, 16, 36, 100])
    reader = SimpleNamespace(inertia=inertia, axes_at_rest=np.zeros((1, 6)), free=None, rigid=6, modes=())
    return SimpleNamespace(reader=reader, waves=waves, dynamic_stiffness=stiffness)


def test_the_scale_of_errors_is_the_linear_motion_in_the_same_waves():
    """½ Σ a² |X|² of 2 and 1 m at 0.5 and 1 rad/s, velocities ω times that; a hundredth of the largest at least"""
    force = np.array([10.0, 10.0j, 0.0, 4.0, 0.0, 0.0])
    (found,) = expected_motion(spring_waves(force), components([0.5, 1.0], [2.0, 1.0]))
    sigma, speed = math.sqrt(2.5), math.sqrt(0.5 * (4 * 0.25 + 1))
    least = 0.01 * 1.0
    assert found[:6] == pytest.approx(sigma * np.array([1.0, 0.5, least, 0.1, least / 3, least / 5]), rel=1e-6)
    assert found[6:] == pytest.approx(speed * np.array([1.0, 0.5, least, 0.1, least / 3, least / 5]), rel=1e-6)
    (huge,) = expected_motion(spring_waves(1e6 * force), components([0.5], [2.0]))
    assert huge[0] == pytest.approx(20 * math.sqrt(2)) and huge[3] == pytest.approx(20 / 2 * math.sqrt(2))
    (calm,) = expected_motion(spring_waves(force), None)
    assert calm == pytest.approx([0.1, 0.1, 0.1, 0.05, 0.1 / 3, 0.02, 0.05, 0.05, 0.05, 0.025, 0.05 / 3, 0.01])
    (beyond_the_band,) = expected_motion(spring_waves(force), components([3.0], [2.0]))
    assert beyond_the_band[6] == pytest.approx(1.2 * math.sqrt(2))


def test_forces_and_drift_between_headings_of_the_ring_are_those_of_the_angle():
    """cos β and sin 2β, of which polynomials of fifth degree through samples 3° apart miss 1e-9"""
    ring = np.arange(HEADINGS) * (2 * math.pi / HEADINGS)
    omega = np.array([0.4, 0.8, 1.2, 1.6])
    force = np.zeros((4, HEADINGS, 12))
    force[:, :, 1], force[:, :, 6] = np.cos(ring), omega[:, None] * np.sin(2 * ring)
    drift = np.zeros((4, HEADINGS, 3))
    drift[:, :, 0] = omega[:, None] * np.cos(ring)
    waves = WaveForces(omega, force, drift)
    for beta in (0.5, -2.0):
        found = forces_towards(waves, beta)
        assert found[:, 1] == pytest.approx(np.full(4, math.cos(beta)), abs=1e-7)
        assert found[:, 0] == pytest.approx(1j * omega * math.sin(2 * beta), abs=1e-6)
    found = drift_of(waves, components([0.6, 5.0], [1.0, 1.0], 0.5), 0.2)
    assert found[:, 0] == pytest.approx([0.6 * math.cos(0.3), 1.6 * math.cos(0.3)], abs=1e-7)
    value, B = drift_damping(waves, omega, np.inf, 9.81)
    # along the waves, β = 0, Aranha (1994): B = 4ω/g D + ω²/g ∂D/∂ω = 5 ω²/g of D = ω
    assert value[1, :, 0] == pytest.approx(0.8 * np.cos(ring))
    assert B[:, 0, 0, 0] == pytest.approx(5 * omega**2 / 9.81, rel=1e-3)


def run_of(motion, time=(-1.0, 0.0, 1.0, 2.0), **more):
    return SimpleNamespace(time=np.array(time), motion=np.array(motion, float), findings=("before",), **more)


def test_a_doubt_is_the_root_mean_square_after_the_ramp_and_a_series_of_three_runs():
    """Differences of 3 and 4 on two of three samples: √(25/3); the ramp does not count

    Three runs: d₀₁ = 1, d₁₂ = 0.5, d₀₂ = 1.5: 1.5 + 0.5 · 0.5/(1 − 0.5); q is at most 0.9
    """
    base = np.zeros((4, 6))
    other = base.copy()
    other[0, 0], other[1, 0], other[2, 0] = 99.0, 3.0, 4.0
    found = run_of(base + np.array([[9.0], [0.0], [1.0], [2.0]]))
    doubt = doubt_of(found, found.motion + other)
    assert doubt.error[0] == pytest.approx(math.sqrt(25 / 3)) and doubt.bound[0] == doubt.error[0]
    assert doubt.spread[0] == pytest.approx(math.sqrt(2 / 3)) and doubt.error[1] == 0.0
    one = np.ones((4, 6))
    doubt = doubt_of(found, found.motion + one, found.motion + 1.5 * one)
    assert doubt.error == pytest.approx(np.full(6, 1.5)) and doubt.bound == pytest.approx(np.full(6, 2.0))
    slow = doubt_of(found, found.motion + one, found.motion + 2 * one)
    assert slow.bound == pytest.approx(np.full(6, 2 + 1 * 0.9 / 0.1))


@pytest.mark.parametrize(
    "off, error, told, chance", [(0.099, 0.0, False, False), (0.101, 0.099, True, False), (0.101, 0.101, True, True)]
)
def test_a_path_beyond_its_tolerance_is_told_and_one_that_is_chance_too(off, error, told, chance):
    doubt = Doubt(
        np.array([0.0, 2 * error, 0, 0, 0, 0]),
        np.array([0.0, 2 * off, 0, 0, 0, 9.0]),
        np.array([1.0, 2, 1, 1, 1, 0.9e-9]),
    )

    class Found(SimpleNamespace):
        def _replace(self, **words):
            return Found(**(self.__dict__ | words))

    made = with_error(Found(findings=("before",)), doubt, 0.1, WORDS, "two runs")
    assert made.findings[0] == "before" and len(made.findings) == 1 + told and made.estimated_error is doubt.error
    if told:
        assert "the error of sway may be 0.1 of its standard deviation, as two runs show" in made.findings[1]
        assert (
            "this motion is chaotic; use statistics over seeds, not a single time series" in made.findings[1]
        ) is chance
    assert doubt.worst == pytest.approx(off)


def pulled(largest, slow=None):
    """Runs of two lines whose largest tensions after the ramp are these"""
    tension = np.array([[9e9, 9e9], [1.0, 1.0], largest, [2.0, 2.0]])
    return SimpleNamespace(time=np.array([-1.0, 0.0, 1.0, 2.0]), tension=tension, slow=slow)


def test_a_trial_compares_the_line_that_changes_most_with_the_largest_pull():
    moored = SimpleNamespace(system=SimpleNamespace(line_names=("bow", "aft")))
    found = _of_tension(moored, pulled([8e5, 2e5]), pulled([7.8e5, 3e5]))
    assert found.share == pytest.approx(1e5 / 8e5)
    assert found.words == "aft pulls up to 200 kN in its static shape and 300 kN in motion"


def test_a_trial_compares_slow_motions_that_are_not_small(monkeypatch):
    """σ of surge 2 and 1 m; sway of a twentieth does not count; yaw counts with the arm to the fairleads, 50 m"""
    monkeypatch.setattr("hakobune.mooring.motion.simulation.trial._arm", lambda moored: 50.0)
    swing, body = (
        np.array([5.0, 1.0, -1.0, 1.0, -1.0])[:, None],
        SimpleNamespace(reader=SimpleNamespace(words=WORDS, rigid=6)),
    )
    time = np.array([-1.0, 0.0, 1.0, 2.0, 3.0])
    one, other = (
        SimpleNamespace(time=time, slow=swing * np.array(s)) for s in ([2.0, 0.05, 0.01], [1.0, 0.001, 0.012])
    )
    found = _of_slow_motion(body, one, other)
    assert (
        found.share == pytest.approx(0.5)
        and found.words == "slow surge has σ 2 m with static lines and 1 m with moving lines"
    )
    one, other = (SimpleNamespace(time=time, slow=swing * np.array(s)) for s in ([2.0, 0.0, 0.01], [2.0, 0.0, 0.02]))
    found = _of_slow_motion(body, one, other)
    assert (
        found.share == pytest.approx(0.5)
        and "slow yaw has σ 0.573 ° with static lines and 1.15 ° with moving" in found.words
    )
    one, other = (SimpleNamespace(time=time, slow=swing * np.array(s)) for s in ([0.099, 0.0, 0.0], [0.05, 0.0, 0.0]))
    assert _of_slow_motion(body, one, other).share == 0.0  # below 2e-3 of the arm, by which both were nudged


def test_the_pace_of_a_trial_is_seconds_a_simulated_second():
    pace = _Pace(Settings(duration=300.0, ramp=100.0))
    assert math.isnan(pace.seconds)
    pace.seen = [(0.1, 5.0), (0.2, 6.0), (0.6, 15.0)]
    assert pace.seconds == pytest.approx(10.0 / (0.5 * 400))
    pace.seen = [(0.5, 5.0), (0.5, 6.0)]
    assert math.isnan(pace.seconds)


def test_what_drives_a_run_changes_with_time():
    sea, wave = Sea(issc(1.0, mean_period=8.0)), Waves(1.0, 8.0, 0.0)
    wind = Wind(10.0, 0.0)
    assert not _drives(Weather()) and not _drives(Weather(wind=wind))
    for weather in (
        Weather(seas=(sea,)),
        Weather(regular=wave),
        Weather(wind=wind, gusts=davenport(10.0, 0.003)),
        Weather(forces=(GivenForce([0.0, 1.0], np.zeros((2, 6))),)),
        Weather(components=components([1.0], [1.0])),
    ):
        assert _drives(weather)
    assert _named(["a"]) == "line a" and _named(list("abcd")) == "lines a, b, c and 1 more"


# ------------------------------------------------------------------ loads


def moored_in(low, high):
    reader = SimpleNamespace(omega=np.array([low, high]), depth=np.inf, gravity=9.81)
    return SimpleNamespace(reader=reader)


def test_regular_waves_are_one_component_of_half_their_height():
    found = wave_components(moored_in(0.3, 2.0), Weather(regular=Waves(3.0, 8.0, 0.7)), Settings(duration=100.0), 1)
    assert [float(part[0]) for part in found] == pytest.approx([math.pi / 4, 1.5, 0.0, 0.7])
    assert wave_components(moored_in(0.3, 2.0), Weather(), Settings(duration=100.0), 1) is None


@pytest.mark.parametrize("duration, count", [(100.0, 200), (3600.0, 286), (10800.0, 600)])
@pytest.mark.filterwarnings("ignore:components from")
def test_components_of_a_sea_are_half_as_many_as_a_record_has_frequencies(duration, count):
    """Band times duration over 4π, from 200 to 600, within the stored band of 1 rad/s"""
    sea = Sea(issc(2.0, mean_period=6.0))
    found = wave_components(moored_in(0.8, 1.8), Weather(seas=(sea,)), Settings(duration=duration), 1)
    assert len(found.omega) == count and found.omega.min() >= 0.8 and found.omega.max() <= 1.8
    both = wave_components(moored_in(0.8, 1.8), Weather(seas=(sea, sea)), Settings(duration=duration, components=50), 1)
    assert len(both.omega) == 100 and not np.array_equal(both.phase[:50], both.phase[50:])


def test_coefficients_are_taken_at_the_mean_frequency_of_the_energy():
    """4 · 0.5 + 1 · 1 over 5"""
    two = components([0.5, 1.0], [2.0, 1.0])
    assert mean_frequency(two) == pytest.approx(0.6)
    assert frequency_of_coefficients(Settings(duration=9.0), two) == pytest.approx(0.6)
    given = Settings(duration=9.0, memory="constant", constant_period=5.0)
    assert frequency_of_coefficients(given, two) == pytest.approx(0.4 * math.pi)
    assert frequency_of_coefficients(Settings(duration=9.0), None) is None


def test_waves_of_a_record_are_the_sea_of_their_energy_mean_frequency_and_direction():
    """½ (4 + 1) m² at 0.6 rad/s; directions of 0 and 90° weigh 4 to 1"""
    parts = components([0.5, 1.0], [2.0, 1.0])._replace(direction=np.array([0.0, math.pi / 2]))
    sea = Weather(components=parts).waves
    assert sea.spectrum.significant_height == pytest.approx(4 * math.sqrt(2.5), rel=1e-9)
    assert pytest.approx(1.0020 * 2 * math.pi / 0.6, rel=1e-4) == sea.spectrum.T01
    assert sea.direction == pytest.approx(math.atan2(1, 4))


def test_gusts_of_a_run_are_their_components_at_its_times():
    """From 0.8 s before the start in steps of 0.2 s; straight between them where they are told"""
    hull, flat = ExposedBox(100.0, 40.0, 10.0, 6.0), drag_table([0.0, np.pi / 2], [1.0, 0.0], [0.0, 1.0])
    gusts = davenport(20.0, 0.003)
    stream = wind_stream(Wind(20.0, 0.3, 1.2, flat), hull, np.zeros(3), gusts, 7, 50.0, 60.0)
    with pytest.warns(UserWarning, match="contains"):
        omega, amplitude, phase = gust_components(gusts, 7, *GUST_BAND, GUSTS)
    assert stream.first == pytest.approx(49.2) and stream.velocity == pytest.approx(
        [20 * math.cos(0.3), 20 * math.sin(0.3)]
    )
    t = np.array([50.0, 55.0, 60.0])
    wanted = np.cos(np.outer(t, omega) + phase) @ amplitude
    assert gust_at(stream, t) == pytest.approx(wanted, abs=1e-9)
    assert gust_at(stream, np.array([50.1])) == pytest.approx(
        [0.5 * gust_at(stream, np.array([50.0, 50.2])).sum()], abs=1e-9
    )
    assert not gust_at(wind_stream(Wind(20.0, 0.3, 1.2, flat), hull, np.zeros(3)), t).any()


def test_given_forces_add_up_at_a_quarter_of_their_shortest_step():
    """Monotone cubics between rows; before the first row and after the last they stay"""
    one = GivenForce([-5.0, 0.0, 4.0, 10.0], np.outer([0.0, 1.0, 3.0, 2.0], np.arange(6.0)))
    two = GivenForce([0.0, 12.0], np.outer([1.0, 1.0], np.ones(6)))
    total, step = sampled([one, two], 8.0, 10.0)
    assert step == pytest.approx(1.0) and total.shape[1] == 18 + 4
    t = np.arange(22.0) - 8.0
    own = PchipInterpolator([-5.0, 0.0, 4.0, 10.0], [0.0, 1.0, 3.0, 2.0])(np.clip(t, -5.0, 10.0))
    assert total == pytest.approx(np.outer(np.arange(6.0), own) + 1.0, abs=1e-12)
    assert sampled([], 8.0, 10.0)[0].tolist() == [[0.0]] * 6
    for wrong, says in (
        (GivenForce([0.1, 12.0], np.eye(6)[:2]), "given from 0.1 to 12 s"),
        (GivenForce([0.0, 9.9], np.eye(6)[:2]), "from 0 to 9.9 s; allowed: from 0 or before to 10 s"),
    ):
        with pytest.raises(ValueError, match=says):
            sampled([wrong], 8.0, 10.0)
    assert sampled([GivenForce([0.0, 100.0], np.zeros((2, 6)))], 0.0, 100.0)[1] == pytest.approx(12.5)


def test_a_passage_acts_within_its_table_alone_and_begins_and_ends_smoothly():
    """A row at either end that is not zero is refused there only; half a cosine leads to zero on both sides"""
    force = np.outer([0.0, 2.0, 0.0], np.arange(6.0))
    total, step = sampled([GivenForce([3.0, 5.0, 7.0], force)], 8.0, 20.0)
    t = step * np.arange(total.shape[1]) - 8.0
    assert total[5].max() == pytest.approx(10.0, abs=1e-9) and not total[:, (t <= 3.0) | (t >= 7.0)].any()
    for row, where in ((0, [3.0, 5.0, 30.0]), (2, [-10.0, 5.0, 7.0])):
        force[row, 4] = 1e-3
        with pytest.raises(ValueError, match="a table that begins and ends with zeros"):
            sampled([GivenForce(where, force)], 8.0, 20.0)
        force[row, 4] = 0.0
    made = faded(GivenForce([2.0, 3.0, 4.0], np.outer([1.0, 5.0, -2.0], np.ones(6))), 2.0)
    assert made.times == pytest.approx([0, 2 / 3, 4 / 3, 2, 3, 4, 4 + 2 / 3, 4 + 4 / 3, 6])
    assert made.force[:, 3] == pytest.approx([0, 0.25, 0.75, 1, 5, -2, -1.5, -0.5, 0])


@pytest.mark.parametrize("gap, told", [(9.9, False), (10.1, True)])
def test_columns_of_a_force_are_found_by_name_and_a_gap_of_ten_steps_is_told(tmp_path, gap, told):
    path = tmp_path / "force.csv"
    rows = [(t, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0) for t in (0.0, 1.0, 2.0, 2.0 + gap)]
    path.write_text("Mz,My,Mx,Fz,Fy,Fx,t\n" + "\n".join(",".join(map(repr, row[::-1])) for row in rows) + "\n")
    if told:
        with pytest.warns(
            UserWarning,
            match=r"line 5: no force is given from 2 to 12\.1 s, and the step "
            r"elsewhere is 1 s",
        ):
            found = read_force(path)
    else:
        found = read_force(path)
    assert found.force[0].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0] and found.times.tolist() == [
        0.0,
        1.0,
        2.0,
        2.0 + gap,
    ]
    path.write_text("t,Fx,Fy,Fz,Mx,My,Mz\n0,1,2,3,4,5,6\n0,1,2,3,4,5,6\n")
    with pytest.raises(TableError, match="line 3: the time stays at 0 s"):
        read_force(path)


@pytest.mark.parametrize(
    "make, good, bad, says",
    [
        (lambda v: Settings(duration=v), 1.0, 0.0, "duration is 0; allowed: above 0"),
        (lambda v: Settings(duration=9.0, step=v), 0.1, math.inf, "step is inf"),
        (lambda v: Settings(duration=9.0, tolerance=v), 0.1, 0.101, "tolerance is 0.101; allowed: above 0, at"),
        (lambda v: Settings(duration=9.0, tolerance=v), 1e-6, 0.0, "tolerance is 0"),
        (lambda v: Settings(duration=9.0, ramp=v), 0.0, -1.0, "ramp is -1 s; allowed: at least 0"),
        (lambda v: Settings(duration=9.0, dynamic_elements=v), 2, 1, "dynamic_elements is 1; allowed: 2 to 1000"),
        (lambda v: Settings(duration=9.0, dynamic_elements=v), 1000, 1001, "dynamic_elements is 1001"),
        (lambda v: Settings(duration=9.0, components=v), 1, 0, "components is 0; allowed: a whole number from 1"),
        (lambda v: Settings(duration=9.0, slow_drift=v), "mean", "some", "slow_drift is 'some'; allowed: newman"),
        (lambda v: Settings(duration=9.0, memory="constant", constant_period=v), 1.0, 0.0, "constant_period is 0 s"),
        (lambda v: Settings(duration=9.0, memory=v, constant_period=5.0), "constant", "states", "memory = .states."),
        (lambda v: GivenForce([0.0, v], np.zeros((2, 6))), 0.1, 0.0, "times that do not increase"),
        (lambda v: GivenForce([0.0, 1.0], np.zeros((2, v))), 6, 5, "allowed: .n,. and .n, 6."),
        (lambda v: Weather(gusts=davenport(9.0, 0.003), wind=v), Wind(9.0, 0.0), None, "gusts but no wind"),
        (lambda v: Weather(regular=Waves(1, 9, 0), seas=v), (), (Sea(issc(1.0, mean_period=8.0)),), "weather "
        "has more than one of seas, a regular wave and a record; give one of them"),
    ],
)  # fmt: skip
def test_settings_of_a_run_are_taken_up_to_their_limits(make, good, bad, says):
    make(good)
    with pytest.raises(ValueError, match=says):
        make(bad)


def test_what_lines_feel_and_what_breaks_is_told():
    still, sea = (
        Settings(duration=100.0, dynamic_water=way, lines_lost=(("a", 99.0), ("b", 100.0))) for way in ("still", "sea")
    )
    assert "move in still water" in _around(Weather(), still)
    assert "in the incident waves, without disturbance" in _around(Weather(), sea)
    current = Weather(current=Current(2.0, math.pi / 6))
    assert "and the current, uniform over the depth, without disturbance" in _around(current, sea)
    assert _current_at_lines(current) == pytest.approx([math.sqrt(3), 1.0]) and _current_at_lines(Weather()) is None
    broken, whole = _of_lost(still)
    assert broken.startswith("line a breaks 99 s after the ramp") and whole.startswith(
        "line b does not break, since its break time is 100 s"
    )


# ------------------------------------------------------------------ slow damping


def damped(memory_states=0, **changes):
    """Surge, sway and yaw with stiffness 4, 9, 100 and mass 1, 1, 4: ω = 2, 3, 5, critical 4, 6, 40"""
    stiffness = np.diag([4.0, 9, 0, 0, 0, 100])
    reader = SimpleNamespace(
        words=WORDS, rigid=6, inertia=np.diag([0.75, 0.5, 1, 1, 1, 3.0]), between=SimpleNamespace(span=(2.5, 9.0)),
        coefficients=lambda omega: (None, np.array([np.diag([omega[0], 1.2, 0, 0, 0, 8.0])])),
    )  # fmt: skip
    memory = SimpleNamespace(states=memory_states, transform=lambda omega: np.array([(omega[0] + 9j) * np.eye(6)]))
    given = {
        "stiffness": stiffness,
        "reader": reader,
        "slow_added_mass": np.diag([0.25, 0.5, 0, 0, 0, 1.0]),
        "memory": memory,
        "damping": np.diag([0.4, 0.3, 0, 0, 0, 4.0]),
    }
    return SimpleNamespace(**(given | changes))


def test_shares_of_critical_of_what_damps_slow_motion():
    """B/2√(CM): given, radiated at the nearest stored frequency or by the memory, and wave drift"""
    drift = np.array([[0.8, 7.0], [7.0, 0.6], [7.0, 7.0]])
    found = slow_damping.shares(damped(), damped().damping, drift[None])
    assert found["surge"] == pytest.approx((2.0, 0.1, 2.5 / 4, 0.2))  # 2 rad/s is held at 2.5
    assert found["sway"] == pytest.approx((3.0, 0.05, 0.2, 0.1)) and found["yaw"] == pytest.approx((5.0, 0.1, 0.2, 0.0))
    by_memory = slow_damping.shares(damped(4), damped().damping, drift[None])
    assert [one[2] for one in by_memory.values()] == pytest.approx([2 / 4, 3 / 6, 5 / 40])
    assert list(slow_damping.shares(damped(stiffness=np.diag([0.0, 9, 0, 0, 0, 0])), np.eye(6), drift[None])) == [
        "sway"
    ]


def body_of(surge, quadratic=0.0, drift=0.0):
    return SimpleNamespace(
        damping=np.diag([surge, 0, 0, 0, 0, 0]), quadratic=np.array([quadratic, 0, 0, 0, 0, 0.0]),
        drift_damping=np.array([[np.zeros(6), [drift, 0, 0, 0, 0, 0], np.zeros(6)]]),
    )  # fmt: skip


@pytest.mark.parametrize("given, light", [(0.0801, False), (0.0799, True)])
def test_a_fiftieth_of_critical_is_light_of_slow_motion(given, light):
    """Surge at 2 rad/s, slow beside waves of 4.1; critical 4: 0.08; not where the water drags, nor beside 3.9 rad/s"""
    memory = SimpleNamespace(states=1, transform=lambda omega: np.zeros((1, 6, 6)))
    moored = damped(damping=np.diag([given, 9, 0, 0, 0, 99.0]), memory=memory)
    said = list(slow_damping.findings(moored, body_of(0.0), 4.1, False, False))
    assert len(said) == light and (not light or "lightly damped: surge 2 % of critical at 3.14 s" in said[0])
    assert not list(slow_damping.findings(moored, body_of(0.0), 3.9, False, False))
    assert not list(slow_damping.findings(moored, body_of(0.0), 4.1, False, True))
    assert not list(slow_damping.findings(moored, body_of(0.0, quadratic=1.0), 4.1, False, False))


@pytest.mark.parametrize("constant, told", [(0.99, False), (1.01, True)])
def test_coefficients_of_waves_that_damp_slow_motion_twice_too_much_are_told(constant, told):
    """Its own 0.4 + 0.08 of drift over 4 make 12 %; with coefficients of waves 2 · 0.48 − 0.08 is the limit"""
    memory = SimpleNamespace(states=1, transform=lambda omega: np.zeros((1, 6, 6)))
    moored = damped(memory=memory)
    body = body_of(constant * (0.96 - 0.08), drift=0.08)
    said = list(slow_damping.findings(moored, body, 4.1, True, True))
    assert len(said) == told
    if told:
        assert "gives slow motion the damping at 4.1 rad/s: surge 24.2 for 12 % of critical at 3.14 s, in" in said[0]


def test_a_body_that_turns_is_pressed_by_the_momentum_of_its_mass_wherever_its_centre_is():
    """P = m (u − y r, v + x r) of a mass at (x, y) m and of the water's; force r (P₂, −P₁), moment v P₁ − u P₂

    The slow velocity of P is in space: at a heading of 90° it is (v, −u) there in axes of the body.
    """
    equation = plain("mooring.motion.equation")
    m, x, y, water = 2.0, 5.0, 3.0, np.diag([0.5, 1.5, 0, 0, 0, 0.0])
    rigid, none = np.zeros((6, 6)), np.zeros((1, 6, 6))
    rigid[0, 0] = rigid[1, 1] = m
    rigid[0, 5], rigid[1, 5] = -m * y, m * x
    body = SimpleNamespace(
        stiffness=none, spring=none, heading=np.zeros(1), rigid=rigid[None], slow=water[None], munk=1.0
    )
    state, rate, force = np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(6)
    state[5], state[6:12], state[15:18] = np.pi / 2, [0.7, -0.4, 9.0, 9.0, 9.0, 0.2], [-0.3, 0.6, 0.1]
    equation.restore(body, 0, state, rate, force, SimpleNamespace(drag=np.zeros(6), part=np.zeros(6)))
    u, v, r = 0.6, 0.3, 0.1
    P = np.array([m * (u - y * r) + 0.5 * u, m * (v + x * r) + 1.5 * v])
    assert force == pytest.approx([0.2 * P[1], -0.2 * P[0], 0, 0, 0, -0.4 * P[0] - 0.7 * P[1]])
    assert rate == pytest.approx(np.zeros(BLOCK), abs=1e-15)  # it does no work


def test_a_memory_is_fitted_to_the_smallest_tolerance_it_allows(monkeypatch):
    """Tried from 3e-4 on, a body without planes of symmetry from 3e-3 on; beyond 1e-3 it is told"""
    tried = []

    def fit(body, tolerance, motions, goal):
        assert goal == ("of", body, motions)
        tried.append(tolerance)
        if tolerance < body.allows:
            raise ValueError(f"not to {tolerance:g}")
        return SimpleNamespace(error=np.array([0.5, 0.9]) * tolerance)

    room = "hakobune.mooring.motion.simulation.memory"
    monkeypatch.setattr(f"{room}.memory_of_database", fit)
    monkeypatch.setattr(f"{room}.goal_of_database", lambda body, motions: ("of", body, motions))
    plain = SimpleNamespace(held_added_mass=lambda omega: np.eye(6)[None], allows=1e-3)
    assert fitted_memory(plain)[1] == () and tried == [3e-4, 1e-3]
    plain.allows = 2.5e-3
    (said,) = fitted_memory(plain)[1]
    assert ("the memory of the water is fitted to 0.0027 of its largest value, required 0.001") in said and tried[
        2:
    ] == [3e-4, 1e-3, 3e-3]
    plain.allows = 1.0
    with pytest.raises(ValueError, match=r"not to 0\.03"):
        fitted_memory(plain)
    coupled = np.eye(6)
    coupled[0, 1:] = coupled[1:, 0] = 1.1e-6
    coupled[1, 2] = coupled[2, 1] = 1.1e-6  # twelve entries: one plane of symmetry
    body = SimpleNamespace(held_added_mass=lambda omega: coupled[None], allows=1e-9)
    tried.clear()
    fitted_memory(body)
    assert tried == [3e-4]
    coupled[1, 3] = 1.1e-6
    tried.clear()
    fitted_memory(body)
    assert tried == [3e-3]


def test_tolerances_that_the_best_system_is_far_from_are_not_tried(monkeypatch):
    """Of a band that contradicts itself each would take a search of its own; one is tried that may be met"""
    tried = []
    plain = SimpleNamespace(held_added_mass=lambda omega: np.eye(6)[None])

    def fit(body, tolerance, motions, goal):
        tried.append(tolerance)
        if tolerance < 0.02:
            raise FitError(f"not to {tolerance:g}", min(0.01, 7 * tolerance))
        return SimpleNamespace(error=np.array([0.02]))

    room = "hakobune.mooring.motion.simulation.memory"
    monkeypatch.setattr(f"{room}.memory_of_database", fit)
    monkeypatch.setattr(f"{room}.goal_of_database", lambda body, motions: ("of", body, motions))
    (said,) = fitted_memory(plain)[1]
    assert tried == [3e-4, 3e-3, 1e-2, 3e-2] and "fitted to 0.02 of its largest value" in said


@pytest.mark.parametrize(
    ("state", "changes", "words"),
    [
        ("NO_LINE", {"load": 2.5e5}, "line bow pulls 5e+05 N, 2 times its breaking load, and would part"),
        ("NO_LINE", {}, f"beyond the table of its forces, {REACH[1]:g} of the depth up or down"),
        ("TOO_SHORT", {"flexibility": 0.0}, "line bow pulls 5e+05 N; give it an axial stiffness"),
        ("TOO_SHORT", {}, "line bow pulls 5e+05 N; raise the tolerance or use a softer line"),
        ("TOO_SHORT", {"count": 0}, "check inertia, damping and stiffness"),
        ("NOT_FINITE", {}, "the motion is not finite; check inertia, damping and stiffness"),
        ("STUCK", {}, "line stern: the motion of this line cannot be integrated"),
        ("BEYOND", {}, "fender F2 is compressed by 0.31 m, beyond its table, which ends at 0.3 m"),
    ],
)
def test_a_run_that_ends_names_time_place_part_and_the_way_out(state, changes, words):
    """130 s with a ramp of 30 s, 3 and 4 m off; the bow line pulls 3 and 4 hundred kN"""
    given = {"load": np.inf, "flexibility": 1e-6, "count": 2} | changes
    names = ["bow", "stern"][: given["count"]]
    marks, now = np.array([[0.0, 0.2], [0.0, 0.3]]), np.zeros((2, DEPTH + 1))
    now[:, DEPTH] = 0.1, 0.31
    scene = SimpleNamespace(
        line_work=SimpleNamespace(whole=np.ones(len(names)), tension=np.array([[3e5, 4e5], [0.0, 1e5]])[: len(names)]),
        lines=SimpleNamespace(lines=np.full((2, 4), given["flexibility"])),
        contact_work=SimpleNamespace(beyond=[1], now=now), contacts=SimpleNamespace(table=SimpleNamespace(marks=marks)),
    )  # fmt: skip
    system = SimpleNamespace(line_names=names, breaking_load=np.full(2, given["load"]))
    berth, reader = SimpleNamespace(names=["F1", "F2"]), SimpleNamespace()
    moored = SimpleNamespace(system=system, buoy=None, berth=berth, reader=reader)
    state_of_body = np.concatenate([[3.0, 4.0], np.zeros(BLOCK - 2)])
    clock = SimpleNamespace(now=np.array([130.0]), y=state_of_body, scale=np.ones((1, 12)))
    error = stopped(getattr(integrator, state), clock, SimpleNamespace(ramp=30.0), scene, moored, None, 1)
    said = str(error)
    assert isinstance(error, Overload) == ("beyond its table, which ends at 0.3" in said or "would part" in said)
    assert said.startswith("at 100 s after the ramp, the body 5 m from its place: ") and words in said


def test_a_run_of_several_bodies_that_ends_names_the_place_of_each_that_moves():
    """Of a ship 5 m and a barge 13 m from their places beside a quay that is fixed"""
    bodies = [SimpleNamespace(name=name, fixed=name == "quay") for name in ("ship", "quay", "barge")]
    moored = SimpleNamespace(system=SimpleNamespace(line_names=[]), buoy=None, reader=SimpleNamespace(bodies=bodies))
    scene = SimpleNamespace(line_work=SimpleNamespace(whole=np.ones(0), tension=np.zeros((0, 2))))
    places = np.zeros((2, BLOCK))
    places[:, :2] = (3.0, -4.0), (5.0, 12.0)
    clock = SimpleNamespace(now=np.array([25.0]), y=places.ravel(), scale=np.ones((2, 12)))
    said = str(stopped(integrator.NOT_FINITE, clock, SimpleNamespace(ramp=30.0), scene, moored, None, None))
    assert said.startswith(
        "at -5 s after the ramp, ship 5 m from its place, barge 13 m from its place: the motion is not finite"
    )
