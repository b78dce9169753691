"""What a reader of a response is told, by hand on either side of each limit."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.modes import words_of
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc, tabulated
from hakobune.mooring.on_current.waves import Carrier
from hakobune.mooring.response.findings import (
    Errors,
    between_waves,
    current_along_waves,
    drift_outside,
    errors_between,
    large_rotations,
    named_shares,
    some,
    waves_missed,
)
from hakobune.mooring.response.linear import Moments, moments, moments_met, over_headings, response_spectrum, subdivided
from hakobune.mooring.response.points import Point, acceleration, displacement, felt_acceleration, velocity
from hakobune.mooring.response.sea_state import SeaState


def test_a_list_ends_with_the_number_of_what_it_leaves_out():
    assert some(list("abcdefg")) == "a, b, c, d, e, f and 1 more"
    assert some(list("abcdef")) == "a, b, c, d, e, f" and some(list("abc"), 2) == "a, b and 1 more"


def test_shares_above_a_hundredth_are_named_the_largest_first():
    assert named_shares(("a", "b", "c"), np.array([0.0101, 0.0099, 0.5])) == "c 50.0 %, a 1.0 %"


@pytest.mark.parametrize("missed, told", [(None, False), (0.0499, False), (0.0501, True)])
def test_a_twentieth_of_the_far_field_may_be_missing(missed, told):
    said = list(waves_missed(SimpleNamespace(missed=missed)))
    assert len(said) == told and (
        not told
        or "the representation of scattered and radiated waves misses up to 5.0 % of the far field; limit 5 %"
        in said[0]
    )


def test_errors_have_the_names_of_what_they_are_of():
    found = Errors(np.array([0.01, 0.2, 0, 0, 0, 0.06]), np.array([0.07, 0.4]), 0.08)
    assert found.named(0.05) == [
        "sway 20 %",
        "yaw 6 %",
        "mean drift 7 %",
        "moment of drift 40 %",
        "wave drift damping 8 %",
    ]
    assert Errors(np.zeros(6), None, None).named(-1)[:1] == ["surge 0 %"]


@pytest.mark.parametrize("error, told", [(0.0499, False), (0.0501, True)])
@pytest.mark.parametrize("rebuilds", [True, False])
def test_a_twentieth_of_a_result_between_waves_is_told(error, told, rebuilds):
    errors = Errors(np.zeros(6), np.array([error, 0.0]), None)
    said = list(between_waves(SimpleNamespace(rebuilds_drift=rebuilds), errors))
    assert len(said) == told
    if told:
        assert "mean drift 5.01 %; limit 5 %" in said[0] and ("Kochin" in said[0]) is not rebuilds


def test_an_error_between_waves_is_told_with_the_frequency_and_headings_it_is_largest_at():
    errors = Errors(np.zeros(6), np.array([0.01, 0.0]), 0.47, at=(0.5, 0.6, 0.712), gap=np.radians(30.0))
    (said,) = between_waves(SimpleNamespace(rebuilds_drift=True), errors)
    assert "wave drift damping 47 %" in said and "add frequencies near 0.712 rad/s, headings closer than 30°" in said


@pytest.mark.parametrize("beyond, told", [(0.98, False), (1.03, True)])
def test_a_hundredth_of_the_drift_force_from_waves_beyond_is_told(beyond, told):
    """Inside 99 kN of surge, of both bands together `beyond`: a hundredth of all of it at 1; moments do not count"""
    spectrum = issc(2.0, mean_period=6.0)
    body = SimpleNamespace(omega=np.array([0.3, 1.25]))
    parts = np.array([[0.3 * beyond, 0.0, 50.0], [-0.7 * beyond, 0.0, 50.0]])
    said = list(drift_outside(body, spectrum, np.array([-99.0, 10.0, 1.0]), parts))
    assert len(said) == told and (
        not told or (said[0].startswith("1.0 % of the mean drift force") and "1.25 rad/s" in said[0])
    )
    if told:  # nearly all of what is beyond: half of the limit, for short waves drift a body more than those at the end
        to = float(said[0].split("solve to ")[1].split(" ")[0])
        kept = beyond / (99 + beyond)
        assert spectrum.moment(0, to, np.inf) == pytest.approx(
            0.005 / kept * spectrum.moment(0, 1.25, np.inf), rel=0.02
        )


@pytest.mark.parametrize("degrees, told", [(1.1, False), (1.2, True)])
def test_a_fiftieth_of_a_current_across_the_waves_is_told(degrees, told):
    """sin 1.146° = 0.02; nothing where the slope over the headings is known, and without a current"""
    carrier = Carrier(np.array([1.5, 0.0]), False)
    heading = np.radians([degrees])
    said = list(current_along_waves(carrier, heading, np.ones(1), None))
    assert len(said) == told and (not told or "the current has a component of 0.031 m/s across" in said[0])
    assert not list(current_along_waves(carrier, heading, np.ones(1), np.ones((3, 2))))
    assert not list(current_along_waves(None, heading, np.ones(1), None))
    across = Carrier(np.array([0.0, 2.0]), False)
    (said,) = current_along_waves(across, np.radians([0.0, 60.0]), np.array([0.2, 0.8]), None)
    assert "a component of 1.2 m/s across" in said  # 0.2 · 2 + 0.8 · 2 cos 60°


def test_rotations_above_fifteen_degrees_are_told():
    assert not list(large_rotations({"Roll": 15.0}))
    (said,) = large_rotations({"Roll": 15.1, "Pitch": 3.0, "Yaw": 20.0})
    assert said.startswith("the motion has an amplitude of roll 15.1°, yaw 20°; ")


class Guessed:
    """A reader whose motions, drift and estimated errors are numbers, alike at every frequency"""

    words = words_of(())

    depth, gravity, radius, rebuilds_drift = 1e4, 9.81, 50.0, True

    def __init__(self, gap):
        self.gap = gap

    def at(self, omega, name, heading):
        shape = (len(omega), len(heading))
        if name == "rao":
            return np.broadcast_to(np.arange(1.0, 7.0), (*shape, 6)), np.broadcast_to(0.01 * np.ones(6), (*shape, 6))
        return np.zeros((*shape, 3)), np.broadcast_to(np.array([20.0, 5.0, 300.0]), (*shape, 3))

    def ring_of(self, name):
        return SimpleNamespace(gap=lambda beta: self.gap)


def test_estimated_errors_of_a_sea_are_sums_over_its_spectrum():
    """m₀ = 0.1 m² about 0.7 rad/s: σ errs by 4 ∫|X|δX S/∫|X|² S = 4 · 0.01/|X|, the force by 2 δD m₀ over itself, its
    moment by half as much again over at least 0.05 R F; damping by 2 (2 + 2π/γ) δD ∫S/C_g over itself, C_g = g/2ω"""
    omega = np.linspace(0.69, 0.71, 41)
    sea = Sea(tabulated([0.69, 0.7, 0.71], [0.0, 10.0, 0.0]))
    drift, damping = np.array([100.0, 3.0, 7.0]), np.array([[500.0, 0.0], [0.0, 20.0], [9e9, 0.0]])
    found = errors_between(Guessed(math.radians(45)), sea, omega, np.array([1.0, 1, 1, 1, 1, 0]), drift, damping)
    assert found.motions == pytest.approx([*(0.04 / np.arange(1.0, 6.0)), 0.0], rel=1e-6)
    assert found.drift == pytest.approx([2 * 20 * 0.1 / 100, 1.5 * 2 * 300 * 0.1 / (0.05 * 50 * 100)], rel=1e-3)
    slow = 0.1 * 2 * 0.7 / 9.81
    assert found.damping == pytest.approx(2 * (2 + 8) * 20 * slow / 500, rel=2e-3)
    large = errors_between(Guessed(0.0), sea, omega, np.ones(6), np.array([100.0, 3.0, 1000.0]), damping)
    assert large.drift[1] == pytest.approx(1.5 * 2 * 300 * 0.1 / 1000, rel=1e-3)
    assert large.damping == pytest.approx(2 * 2 * 20 * slow / 500, rel=2e-3)
    bare = errors_between(Guessed(0.5), sea, omega, np.ones(6), None, None)
    assert bare.drift is None and bare.damping is None
    assert errors_between(Guessed(0.5), sea, omega, np.ones(6), drift, None).damping is None


def test_spectra_and_moments_of_responses_by_hand():
    """Two headings of a quarter and three quarters, |X| of 2 and 4: ⟨|X|²⟩ = 13; S = 5 from 1 to 3 rad/s"""
    transfer = np.array([[[2.0], [4.0j]]] * 2001)
    omega = np.linspace(1.0, 3.0, 2001)
    spectrum = response_spectrum(transfer, np.full(2001, 5.0), (0.25, 0.75))
    assert spectrum[:, 0] == pytest.approx(65.0)
    found = moments(omega, spectrum)
    assert [float(m[0]) for m in found] == pytest.approx([130.0, 65 * 4, 65 * 26 / 3, 65 * 242 / 5], rel=1e-6)
    met = np.stack([2 * omega, omega - 0.5], axis=1)  # of the first twice the frequency, of the other half a rad/s less
    found = moments_met(omega, met, transfer, np.full(2001, 5.0), (0.25, 0.75))
    first, second = (np.array([np.trapezoid(m**n, omega) for n in (0, 1, 2, 4)]) for m in met.T)
    assert [float(m[0]) for m in found] == pytest.approx(5 * (0.25 * 4 * first + 0.75 * 16 * second), rel=1e-9)
    assert over_headings(np.array([[1.0, 3.0], [5.0, 9.0]]), np.array([[0.5, 0.5], [0.0, 1.0]])) == pytest.approx(
        [2.0, 9.0]
    )
    assert subdivided(np.array([1.0, 3.0, 4.0]), 2) == pytest.approx([1.0, 2.0, 3.0, 3.5, 4.0])


def test_a_point_moves_with_the_body_and_feels_gravity_where_it_leans():
    """Place (3, 4, 5) from the centre: surge + 5 pitch − 4 yaw, sway − 5 roll + 3 yaw, heave + 4 roll − 3 pitch

    With exp(−iωt) v = −iω d, a = −ω² d; along the deck g is felt −g pitch along x, g roll along y
    """
    X = np.array([[[1.0, 2.0, 3.0, 0.1, 0.2, 0.3]]], complex)
    d = displacement(X, (5.0, 6.0, 7.0), (2.0, 2.0, 2.0))
    assert d[0, 0] == pytest.approx([1 + 1.0 - 1.2, 2 - 0.5 + 0.9, 3 + 0.4 - 0.6])
    omega = np.array([2.0])
    assert velocity(omega, d)[0, 0] == pytest.approx(-2j * d[0, 0]) and acceleration(omega, d) == pytest.approx(-4 * d)
    felt = felt_acceleration(omega, d, X, 10.0)[0, 0]
    assert felt == pytest.approx([-4 * d[0, 0, 0] - 2.0, -4 * d[0, 0, 1] + 1.0])


def state_of(m0, m2, m4, points=()):
    names = ("relative", "still")
    parts = np.array([m0, 0.0]), np.array([0.5 * m0, 0.0]), np.array([m2, 0.0]), np.array([m4, 0.0])
    named = tuple(f"{point.name} relative elevation" for point in points) or names[:1]
    return SeaState(
        None,
        3600.0,
        tuple(points),
        (*named, "still"),
        ("m", "m"),
        np.zeros(1),
        np.zeros((1, 2)),
        Moments(*parts),
        None,
        None,
        (),
    )


def test_periods_and_extremes_of_a_sea_state_are_those_of_its_moments():
    """m₀ = 4, m₂ = 1, m₄ = 1/2: T_zero = 4π, between maxima 2π√2, ε² = 1 − 1/2; N = 3600/4π"""
    state = state_of(4.0, 1.0, 0.5)
    assert state.sigma.tolist() == [2.0, 0.0]
    assert state.zero_period[0] == pytest.approx(4 * math.pi) and math.isnan(state.zero_period[1])
    assert state.peak_period[0] == pytest.approx(2 * math.pi * math.sqrt(2))
    assert state.bandwidth[0] == pytest.approx(math.sqrt(0.5))
    s = math.sqrt(2 * math.log(3600 / (4 * math.pi)))
    assert state.expected_maximum == pytest.approx([2 * (s + 0.5772 / s), 0.0], rel=1e-4)
    # exp(−N exp(−x²/2σ²)) = 0.9
    x = 2 * math.sqrt(2 * math.log(3600 / (4 * math.pi) / -math.log(0.9)))
    assert state.not_exceeded(0.9) == pytest.approx([x, 0.0], rel=1e-9)


def test_a_level_is_reached_with_the_probability_of_crossings_that_know_nothing_of_each_other():
    """1 − exp(−N exp(−x²/2σ²)); a clearance of 9 m keeps 9 less the expected maximum"""
    deck = Point("deck", (1.0, 2.0, 3.0), clearance=9.0)
    state = state_of(4.0, 1.0, 0.5, (deck,))
    cycles = 3600 / (4 * math.pi)
    p = 1 - math.exp(-cycles * math.exp(-81 / 8))
    assert state.reached("deck relative elevation", 9.0) == pytest.approx(p, rel=1e-9)
    assert state.reached("still", 1.0) == 0.0 and state.reached("deck relative elevation", 0.0) == 1.0
    clearance, left, probability = state.air_gaps()["deck"]
    assert (clearance, probability) == (9.0, pytest.approx(p, rel=1e-9))
    assert left == pytest.approx(9.0 - state.expected_maximum[0])
