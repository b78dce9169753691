"""Waves that a current carries, in deep water where everything is a quadratic: frequencies, blocking, what is told."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.reader import Reader
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import tabulated
from hakobune.mooring.on_current import waves as of_waves
from hakobune.mooring.on_current.body import OnCurrent
from hakobune.mooring.on_current.waves import (
    Carrier,
    absolute_frequency,
    carrier_of,
    check_blocked,
    group_speed,
    in_water,
    intrinsic_frequency,
    met_by_a_place,
)
from hakobune.mooring.seas.systems import Systems
from hakobune.mooring.studies.conditions import Current, Waves

G, DEEP = 9.81, np.inf


def test_energy_travels_with_half_the_speed_of_crests_in_deep_water_and_all_of_it_in_shallow():
    """g/2ω; √(gh)"""
    assert group_speed(np.array([0.5, 2.0]), DEEP, G) == pytest.approx([G, G / 4], rel=1e-12)
    assert float(group_speed(np.array([0.01]), 10.0, G)[0]) == pytest.approx(math.sqrt(10 * G), rel=1e-4)


@pytest.mark.parametrize("V", [-1.2, -0.3, 0.0, 0.4, 2.5])
def test_frequencies_at_rest_and_in_the_water_are_a_quadratic(V):
    """ω = σ + σ² V/g, and back by σ = 2ω/(1 + √(1 + 4ωV/g)); a fast current with the waves too"""
    omega = np.array([0.3, 0.7, 1.5])
    assert absolute_frequency(omega, V, DEEP, G) == pytest.approx(omega + omega**2 * V / G, rel=1e-12)
    under = 1 + 4 * omega * V / G
    assert np.all(under > 0.2)
    assert intrinsic_frequency(omega, V, DEEP, G) == pytest.approx(2 * omega / (1 + np.sqrt(under)), rel=1e-9)
    each = intrinsic_frequency(np.array([0.7, 0.7]), np.array([V, 0.1]), DEEP, G)
    assert each == pytest.approx([2 * 0.7 / (1 + math.sqrt(1 + 2.8 * v / G)) for v in (V, 0.1)], rel=1e-9)


def test_what_a_current_blocks_has_the_frequency_of_the_shortest_wave_that_passes():
    """Against V the most that a place can meet is g/4V, of waves with σ = g/2V whose energy stands still"""
    found = intrinsic_frequency(np.array([1.2]), -2.5, DEEP, G)  # g/4V = 0.98
    assert found == pytest.approx([G / 5], rel=1e-3)


def test_a_carrier_turns_frequencies_that_are_given_at_a_place_alone():
    """V of 1 m/s towards 60°: along waves towards 0 it is ½"""
    own, absolute = (Carrier((0.5, math.sqrt(0.75)), way) for way in (False, True))
    assert own.along(np.array([0.0, math.pi / 3, math.pi])) == pytest.approx([0.5, 1.0, -0.5])
    there, sigma = 0.7 + 0.49 * 0.5 / G, 1.4 / (1 + math.sqrt(1 + 1.4 / G))
    assert float(own.met(0.7, 0.0, DEEP, G)) == pytest.approx(there) and float(own.own(0.7, 0.0, DEEP, G)) == 0.7
    assert float(absolute.own(0.7, 0.0, DEEP, G)[0]) == pytest.approx(sigma)
    assert float(absolute.met(0.7, 0.0, DEEP, G)) == 0.7
    waves = Components(np.array([0.7]), np.ones(1), np.zeros(1), np.zeros(1))
    assert in_water(waves, absolute, DEEP, G).omega == pytest.approx([sigma])
    assert in_water(waves, own, DEEP, G) is waves and in_water(waves, None, DEEP, G) is waves
    assert met_by_a_place(waves, own, DEEP, G) == pytest.approx([there]) and met_by_a_place(waves, None, DEEP, G) == [
        0.7
    ]
    made = carrier_of(Current(2.0, math.pi / 6, waves="absolute"))
    assert made.velocity == pytest.approx((math.sqrt(3), 1.0)) and made.absolute
    assert not carrier_of(Current(2.0, 0.0)).absolute
    assert carrier_of(None) is carrier_of(Current(0.0, 0.0)) is carrier_of(Current(2.0, 0.0, waves="still")) is None


def sea_with(share, V):
    """Two narrow systems, of which that beyond the blocking of a current V against it has `share` of the energy

    Energy stands still at σ = g/2V: at a tenth less and a tenth more
    """
    edge = G / (2 * V)
    one, other = (tabulated([0.999 * w, w, 1.001 * w], [0.0, m0 / (1e-3 * w), 0.0]) for w, m0 in
                  ((0.4 * edge, 1 - share), (1.1 * edge, share)))  # fmt: skip
    return Systems((Sea(one, 0.0), Sea(other, 0.0)))


@pytest.mark.parametrize("share, told", [(0.9e-3, False), (1.1e-3, True)])
def test_a_thousandth_of_the_energy_that_a_current_blocks_is_told(share, told):
    said = [line for line in check_blocked(Carrier((-2.0, 0.0)), sea_with(share, 2.0), DEEP, G) if "blocks" in line]
    assert len(said) == told and (not told or "the current of 2 m/s blocks 0.11 % of the wave energy" in said[0])


@pytest.mark.parametrize("share, refused", [(0.049, False), (0.051, True)])
def test_a_twentieth_of_the_energy_that_a_current_blocks_is_refused(share, refused):
    carrier = Carrier((-2.0, 0.0))
    if refused:
        with pytest.raises(ValueError, match=r"blocks 5\.1 % of the wave energy, .* allowed: 5 %"):
            list(check_blocked(carrier, sea_with(share, 2.0), DEEP, G))
    else:
        assert len(list(check_blocked(carrier, sea_with(share, 2.0), DEEP, G))) > 0
    assert not list(check_blocked(None, sea_with(share, 2.0), DEEP, G))
    with_the_waves = [
        line for line in check_blocked(Carrier((2.0, 0.0)), sea_with(share, 2.0), DEEP, G) if "blocks" in line
    ]
    assert not with_the_waves


@pytest.mark.parametrize("speed, told", [(0.99, False), (1.01, True)])
def test_a_current_beyond_a_quarter_of_the_group_speed_is_told(speed, told):
    """C_g = g/2ω: a regular wave of 2π s has 4.905 m/s, a quarter of it 1.226; either way along or across"""
    V = speed * G / 8
    for way in ((V, 0.0), (-V, 0.0), (0.0, V)):
        said = list(check_blocked(Carrier(way), Waves(1.0, 2 * math.pi, 0.0), DEEP, G))
        assert len(said) == told
        if told:
            assert (
                "up to 0.25; V/C_g is 0.25 at the mean frequency, and above the limit for 100 % of the wave "
                "energy; treat drift"
            ) in said[0]


@pytest.mark.parametrize("share, told", [(0.099, False), (0.101, True)])
def test_a_tenth_of_the_energy_beyond_first_order_is_told(share, told):
    """Two systems, C_g of 10 and of 2 m/s in a current of 1 m/s"""
    parts = [
        Sea(tabulated([0.999 * w, w, 1.001 * w], [0.0, m0 / (1e-3 * w), 0.0]), 0.0)
        for w, m0 in ((G / 20, 1 - share), (G / 4, share))
    ]
    said = list(check_blocked(Carrier((1.0, 0.0)), Systems(tuple(parts)), DEEP, G))
    assert len(said) == told
    mean = (1 - share) * 0.1 + share * 0.5
    assert not told or f"V/C_g is {mean:.2g} at the mean frequency, and above the limit for 10.1 %" in said[0]


@pytest.mark.parametrize("absolute", [True, False])
def test_forces_are_those_of_waves_as_long_in_still_water(absolute):
    """ω + σ²V/g on the current for σ = 0.6 and 0.9 towards 0, π/2 and π: k·V has the signs +, 0 and −"""
    V, headings = 0.8, np.array([0.0, math.pi / 2, math.pi])
    own = np.array([0.6, 0.9])
    met = own[:, None] + own[:, None] ** 2 * V / G * np.cos(headings)

    def forces(omega, headings, scale=1.0):
        return scale * np.exp(np.asarray(omega)[:, None, None] + 1j * np.asarray(headings)[None, :, None]) * np.ones(6)

    carrier = Carrier((V, 0.0), absolute=absolute)
    body = SimpleNamespace(
        still=SimpleNamespace(forces=forces),
        carrier=carrier,
        headings=headings,
        depth=DEEP,
        gravity=G,
        between=SimpleNamespace(span=(0.1, 3.0)),
    )
    body._pairs = lambda omega, headings: OnCurrent._pairs(body, omega, headings)
    body.intrinsic = lambda omega, headings: OnCurrent.intrinsic(body, omega, headings)
    expected = forces(own, headings, 2.0)
    if not absolute:
        assert OnCurrent.waves_of(body, "forces", own, headings, scale=2.0) == pytest.approx(expected, rel=1e-9)
        return
    for p in range(3):
        found = OnCurrent.waves_of(body, "forces", met[:, p], None, scale=2.0)
        assert found.shape == (2, 3, 6)
        assert found[:, p] == pytest.approx(expected[:, p], rel=1e-9)


def test_motions_on_a_current_are_refused_without_the_inertia_that_they_follow_from():
    body = SimpleNamespace(lacks_motions=False, inertia=None, stiffness=np.eye(6))
    body._check_inertia = lambda: Reader._check_inertia(body)
    with pytest.raises(BetweenError, match="no inertia of the body; give --gyration"):
        OnCurrent.motions(body, [0.5])


def test_coefficients_beyond_the_stored_frequencies_are_their_limits_and_inside_a_curve_through_them():
    """Added mass 1 + ω², damping 2 ω between 0.5 and 1.5; beyond, the limits of added mass and the last damping"""
    span = np.linspace(0.5, 1.5, 9)
    square = lambda omega: np.asarray(omega)[:, None, None] * np.ones((1, 6, 6))  # noqa: E731
    still = SimpleNamespace(coefficients=lambda omega: (1 + square(omega) ** 2, 2 * square(omega)))
    limits = lambda omega: -1.0 - square(omega)  # noqa: E731
    body = SimpleNamespace(omega=span, still=still, between=SimpleNamespace(span=(0.5, 1.5)), held_added_mass=limits)
    body._splines = OnCurrent._splines.func(body)
    A, B = OnCurrent._coefficients(body, np.array([0.7, 1.6, 0.2, -0.3, 1.1]))
    assert A[:, 2, 3] == pytest.approx([1.49, -2.6, -1.2, -1.0, 2.21], abs=1e-6)
    assert B[:, 0, 5] == pytest.approx([1.4, 3.0, 1.0, 1.0, 2.2], abs=1e-9)
    assert OnCurrent._coefficients(body, np.array([0.7]))[0][0, 0, 0] == pytest.approx(1.49, abs=1e-6)


def test_values_at_a_frequency_are_those_of_still_water_but_for_the_motions_on_the_current():
    body = SimpleNamespace(
        still=SimpleNamespace(at=lambda omega, name, headings: ((name, omega, headings), "error")),
        motions=lambda omega, headings: ("moved", omega, headings),
    )
    assert OnCurrent.at(body, 0.7, "rao", [0.1]) == (("moved", 0.7, [0.1]), "error")
    assert OnCurrent.at(body, 0.7, "drift_force", [0.1]) == (("drift_force", 0.7, [0.1]), "error")


@pytest.mark.parametrize("absolute", [False, True])
def test_resonances_are_resolved_in_waves_that_are_met_at_their_frequencies(monkeypatch, absolute):
    """Met at 0.6 and 1.2 rad/s in waves against and with a current of 0.8 m/s: σ by their quadratic, within the band"""
    from hakobune.mooring.on_current import body as module

    monkeypatch.setattr(module, "resonances", lambda still: ("of", still))
    monkeypatch.setattr(module, "about", lambda still, found: np.array([0.6, 1.2]) if found == ("of", still) else None)
    V = 0.8
    one = SimpleNamespace(still="still", between=SimpleNamespace(span=(0.5, 1.25)), depth=DEEP, gravity=G,
                          carrier=Carrier((V, 0.0), absolute=absolute))  # fmt: skip
    found = OnCurrent.resonant(one, [0.0, math.pi])
    met = np.array([0.6, 1.2])
    each = [2 * met / (1 + np.sqrt(1 + 4 * met * way / G)) for way in (V, -V)]
    wanted = met if absolute else np.sort([one for one in np.concatenate(each) if 0.5 < one < 1.25])
    assert found == pytest.approx(wanted, rel=1e-6) and len(found) == (2 if absolute else 3)


@pytest.mark.parametrize("V, share", [(2.0, 0.0), (1e-3, 0.0), (-2.0, (2.0 - G / 8) / 1.5)])
def test_frequencies_of_a_fixed_place_are_blocked_beyond_g_over_4v(V, share):
    """Of absolute frequencies none are highest but G/4|V|, where σ = g/2|V|; a following current blocks nothing"""
    spectrum = SimpleNamespace(quantile=lambda p: 0.5 + 1.5 * p, moment=lambda n: 1.0)
    sea = SimpleNamespace(spectrum=spectrum, direction=0.0)
    blocked, _, _ = of_waves._shares(Carrier((V, 0.0), True), sea, DEEP, G, abs(V))
    assert blocked == pytest.approx(share, abs=2e-3 if share else 0.0)


def test_shares_beyond_first_order_and_the_speed_over_that_of_energy_are_of_energy():
    """C_g = g/2ω: V/C_g > ¼ beyond ω = g/8V; two systems of a quarter and three quarters of the energy"""
    one = SimpleNamespace(quantile=lambda p: 0.5 + 1.0 * p, moment=lambda n: 1.0)
    two = SimpleNamespace(quantile=lambda p: np.full(len(p), 0.6), moment=lambda n: 3.0)
    sea = SimpleNamespace(systems=(SimpleNamespace(spectrum=one, direction=0.0),
                                   SimpleNamespace(spectrum=two, direction=1.0)))  # fmt: skip
    blocked, steep, mean = of_waves._shares(Carrier((1.5, 0.0)), sea, DEEP, G, 1.5)
    assert blocked == 0.0 and steep == pytest.approx(0.25 * (1.5 - G / 12), abs=1e-3)
    assert mean == pytest.approx(0.25 * 1.5 * 2 * 1.0 / G + 0.75 * 1.5 * 2 * 0.6 / G, rel=1e-3)
