"""Parts of slow and slewing motions that only long runs go through, with what they call made up."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Components
from hakobune.mooring.motion import given_forces
from hakobune.mooring.motion.simulation import loads
from hakobune.mooring.single_point import in_time, limit_cycle, slewing
from hakobune.mooring.single_point.body import SinglePointError
from hakobune.mooring.studies import long_period, multi_point, slow_spectrum
from hakobune.mooring.studies.breakwater import lee

# ------------------------------------------------------------------ slewing


def test_a_body_is_followed_until_it_turns_back_to_the_side_asked_for(monkeypatch):
    """Heading −cos t about 0, whose rate sin t falls through 0 at π and rises at 2π"""
    monkeypatch.setattr(slewing, "_followed", lambda point: (lambda t, y: np.array([0, 0, y[5], 0, 0, -y[2]]), [""]))
    start = np.array([0.0, 0.0, -1.0, 0.0, 0.0, 0.0])
    down = slewing.until_turn(None, start + [0, 0, 0, 0, 0, 1e-9], -1.0, 50.0, 1e-10)
    assert down.t[-1] == pytest.approx(math.pi, abs=1e-6) and down.y[2, -1] == pytest.approx(1.0)
    assert down.sol(1.0)[2] == pytest.approx(-math.cos(1.0), abs=1e-8)
    up = slewing.until_turn(None, down.y[:, -1], +1.0, 50.0, 1e-10)
    assert up.t[-1] == pytest.approx(math.pi, abs=1e-4)
    with pytest.raises(SinglePointError, match=r"the heading does not turn back within 1.5 s and is then at 355"):
        slewing.until_turn(None, start, -1.0, 1.5, 1e-10)


def test_a_body_that_cannot_be_followed_says_why(monkeypatch):
    monkeypatch.setattr(slewing, "_followed", lambda point: (lambda t, y: np.full(6, np.nan), [": no line"]))
    with pytest.raises(slewing.NotFollowedError, match=r"cannot be followed: no|to follow the motion: no"):
        slewing.until_turn(None, np.ones(6), 1.0, 5.0, 1e-8)
    monkeypatch.setattr(slewing, "_followed", lambda point: (lambda t, y: 0 * y, [": it stands"]))
    monkeypatch.setattr(slewing, "MOST", 5)
    with pytest.raises(
        slewing.NotFollowedError, match=r"after .* s each step is too short to follow the motion: it st"
    ):
        slewing.until_turn(None, np.ones(6), 1.0, 1e9, 1e-12)


def period(amplitude, change, end=0.0):
    return limit_cycle._Period(amplitude, change, 60.0, None, np.full(6, end))


def steady(stable=False):
    return SimpleNamespace(slewing=SimpleNamespace(stable=stable), heading=math.pi / 2, point="point", state="state",
                           roots=np.array([0.01 + 0.1j]))  # fmt: skip


@pytest.fixture
def periods(monkeypatch):
    """Periods that follow one another, whatever they begin from; said : shares by which states were scaled"""
    given, said = [], []
    monkeypatch.setattr(limit_cycle, "turned_state", lambda point, state, turn: (state, turn))
    monkeypatch.setattr(limit_cycle, "until_turn", lambda *given: SimpleNamespace(y=np.zeros((6, 2))))
    monkeypatch.setattr(limit_cycle, "_period", lambda *_: given.pop(0))
    monkeypatch.setattr(limit_cycle, "_sampled", lambda point, now: now)
    monkeypatch.setattr(limit_cycle, "_scaled", lambda point, now, share, longest: said.append(share) or "scaled")
    return given, said


def test_a_cycle_is_where_a_period_changes_nothing(periods):
    """Changes 0.3 at 1 and 0.1 at 2 rad: linear in a², 0 at √(4 + 1.5) rad; a step to it by no more than is allowed"""
    given, said = periods
    last = period(0.5**0.5 * 11**0.5, 1e-9)
    given += [period(1.0, 0.3), period(2.0, 0.1), last]
    assert limit_cycle.limit_cycle(steady()) is last
    assert said == pytest.approx([min(math.sqrt(5.5) / 2, limit_cycle.SCALED)])
    given += [period(1.0, 0.3), period(1.001, 0.2999), last]
    limit_cycle.limit_cycle(steady())
    assert said[-1] == pytest.approx(
        min(math.sqrt(1.001**2 + 0.2999 * (1.001**2 - 1) / 1e-4) / 1.001, limit_cycle.SCALED)
    )


def test_slewing_that_does_not_stay_is_told(periods, monkeypatch):
    given, _ = periods
    with pytest.raises(SinglePointError, match=r"the heading of 90.0° is stable, so slewing does not start from it"):
        limit_cycle.limit_cycle(steady(True))
    given += [period(0.5 * limit_cycle.LEAST, 0.0, math.radians(370))]
    with pytest.raises(SinglePointError, match=r"the slewing dies out at a heading of 10.0°"):
        limit_cycle.limit_cycle(steady())
    given += [period(1.0 + 0.01 * k, 0.1 + 0.001 * k) for k in range(limit_cycle.MOST)]
    with pytest.raises(
        SinglePointError, match=rf"no cycle within {limit_cycle.MOST} periods: the heading still swings"
    ):
        limit_cycle.limit_cycle(steady())


def test_a_period_is_from_one_turn_to_the_next_on_the_same_side(monkeypatch):
    """Down in 20 s to −0.4 rad and up in 30 s: from 0.6 to 0.5, amplitude ½ (0.55 + 0.4), change −0.1 of it"""
    ends = {1.0: (20.0, -0.4), -1.0: (30.0, 0.5)}

    def until(point, state, direction, longest, tolerance):
        time, heading = ends[direction]
        y = np.zeros((6, 2))
        y[2, -1] = heading
        return SimpleNamespace(t=np.array([0.0, time]), y=y, sol=lambda t: np.array([direction + 0 * t, t]))

    monkeypatch.setattr(limit_cycle, "until_turn", until)
    start = np.zeros(6)
    start[2] = 0.6
    found = limit_cycle._period("point", start, 99.0)
    assert found.length == 50.0 and found.amplitude == pytest.approx(0.475) and found.end[2] == 0.5
    assert found.change == pytest.approx(-0.1 / 0.475)
    assert found.samples(np.array([5.0, 19.9, 20.0, 30.0])).tolist() == [[1, 5], [1, 19.9], [-1, 0], [-1, 10]]


@pytest.mark.parametrize("gusts", [None, "gusts"])
def test_a_gusty_wind_is_its_mean_and_its_gusts_to_beyond_the_end(gusts, monkeypatch):
    asked = []
    monkeypatch.setattr(in_time, "gust_record", lambda spectrum, t, seed, low, high, count: (
        asked.append((spectrum, t[-1], seed, low, high, count)) or 0.1 * t))  # fmt: skip
    point = SimpleNamespace(loads=SimpleNamespace(wind=SimpleNamespace(speed=20.0, gusts=gusts)))
    found = in_time.gusty(point, 100.0, 3)
    if gusts is None:
        assert found is None
        point.loads.wind = None
        assert in_time.gusty(point, 100.0, 3) is None
    else:
        assert found(0.0) == 20.0 and found(0.75) == pytest.approx(20.075) and found(100.0) == pytest.approx(30.0)
        spectrum, last, seed, low, high, count = asked[0]
        assert (spectrum, last, seed) == ("gusts", 101.5, 3 + in_time.ALOFT) and count == in_time.GUSTS[2]
        assert (low, high) == pytest.approx((2 * np.pi * in_time.GUSTS[0], 2 * np.pi * in_time.GUSTS[1]))


# ------------------------------------------------------------------ slow forces


def test_gusts_push_by_twice_the_mean_force_over_the_mean_speed():
    spectrum = SimpleNamespace(speed=20.0, density=lambda omega: omega)
    found = slow_spectrum.gust_spectrum(spectrum, [10.0, 20.0, 0.0], np.array([1.0, 3.0]))
    slope = np.array([1.0, 2.0, 0.0])
    assert found == pytest.approx(np.multiply.outer([1.0, 3.0], np.outer(slope, slope)))


def test_slow_forces_of_waves_are_their_squares_within_what_is_stored(monkeypatch):
    """|F|² S of 2, 3 and 4 N/m in surge, sway and yaw over headings of a third and two thirds; none below 0.4 rad/s"""
    monkeypatch.setattr(slow_spectrum, "directions", lambda sea, omega: (np.zeros(2), "weights"))
    monkeypatch.setattr(slow_spectrum, "over_headings", lambda values, weights: values[:, 0] / 3 + 2 * values[:, 1] / 3)
    asked = []

    def forces(omega, heading):
        asked.append((omega[0], omega[-1], len(omega)))
        made = np.zeros((len(omega), 2, 6), complex)
        made[:, :, [0, 1, 5]] = [2j, -3.0, 4.0]
        made[:, 1] *= 2
        return made

    body = SimpleNamespace(omega=[0.4, 2.0], forces=forces)
    sea = SimpleNamespace(spectrum=SimpleNamespace(density=lambda omega: 10 * omega))
    found = slow_spectrum.wave_spectrum(body, sea, np.array([0.3, 0.4, 0.5, 0.8]))
    size = (1 / 3 + 4 * 2 / 3) * np.array([4.0, 9.0, 16.0])
    assert found == pytest.approx(np.outer([0.0, 4.0, 5.0, 8.0], size)) and asked == [(0.4, 0.8, 61)]
    slow_spectrum.wave_spectrum(body, sea, np.array([0.1, 0.2]))
    assert asked[-1] == pytest.approx((0.4, 0.4004, 61))


def test_one_slow_motion_is_that_of_its_stiffness_mass_and_damping():
    """White force S on K, M with N: σ² = π S/2 N K; ν = N/√(M K), T = 2π √(M/K)"""
    K, mass, other = 1e5, 4e7, 2e5
    body = SimpleNamespace(inertia=np.diag([3e7] * 6), held_added_mass=lambda w: np.diag([1e7] * 6)[None],
                           omega=np.array([0.3, 1.0]),
                           coefficients=lambda w: (None, np.diag([6e4] * 6)[None]))  # fmt: skip
    natural = math.sqrt(K / mass)
    omega = np.linspace(0, 8 * natural, 40_001)[1:]
    radiated = 6e4 * natural / 0.3
    period, nu, sigma = long_period._one(body, K, 0, omega, np.full(len(omega), 1e6), 0.1, lambda s: 1e5, other)
    N = 1e5 + other + radiated
    assert period == pytest.approx(2 * np.pi / natural) and nu == pytest.approx(N / math.sqrt(mass * K))
    assert sigma == pytest.approx(math.sqrt(math.pi * 1e6 / (2 * N * K)), rel=2e-3)
    assert all(map(math.isnan, long_period._one(body, 0.0, 0, omega, omega, 0.1, lambda s: 1.0, 0.0)))


@pytest.mark.parametrize("knows, kind, bodies, made", [
    (True, "half-waves", [], True), (False, "half-waves", [], False), (True, "newman", [], False),
    (True, "half-waves", [1], "refused"),
])  # fmt: skip
def test_drift_by_half_waves_is_of_a_body_whose_drift_is_known(knows, kind, bodies, made, monkeypatch):
    """A current (3, 4) is (4, −3) in axes headed to 90°"""
    monkeypatch.setattr(loads, "on_current", lambda reader, carrier: carrier and carrier.velocity)
    monkeypatch.setattr(loads, "drift_of_half_waves", lambda *given: given)
    moored = SimpleNamespace(reader=SimpleNamespace(knows_drift=knows, bodies=bodies), start=np.full(6, np.pi / 2))
    settings = SimpleNamespace(slow_drift=kind, ramp=10.0, duration=100.0)
    weather = SimpleNamespace(carrier=loads.Carrier((3.0, 4.0)))
    if made == "refused":
        with pytest.raises(ValueError, match='slow_drift is "half-waves" with several bodies; allowed: "newman"'):
            loads.half_waves(moored, weather, settings, "waves")
        return
    found = loads.half_waves(moored, weather, settings, "waves")
    if made:
        ((velocity, *rest),) = found
        assert velocity == pytest.approx((4.0, -3.0)) and rest == ["waves", np.pi / 2, 10.0, 100.0]
        weather.carrier = None
        assert loads.half_waves(moored, weather, settings, "waves")[0][0] is None
    else:
        assert found == ()
    assert loads.half_waves(moored, weather, settings, None) == ()


def test_half_waves_on_a_current_drift_by_the_frequencies_that_are_met(monkeypatch):
    """Their mean direction, by energy, less the heading; without waves that the current does not let pass"""
    asked = {}
    monkeypatch.setattr(given_forces, "carrier_of_body", lambda reader: carrier)
    monkeypatch.setattr(given_forces, "absolute_frequency", lambda own, along, depth, g: own - 0.3 * own**2)
    monkeypatch.setattr(given_forces, "drift_on_current", lambda reader, omega, heading: (
        asked.update(heading=heading) or (np.tile(omega[:, None, None], (1, 1, 3)),)))  # fmt: skip
    monkeypatch.setattr(given_forces, "real_sum", lambda amplitude, met, t: asked.update(met=met) or np.cos(t))
    carrier = SimpleNamespace(along=lambda headings: 0 * headings)
    reader = SimpleNamespace(omega=np.array([0.5, 3.0]), depth=30.0, gravity=9.81,
                             drift=lambda omega, headings: np.ones((len(omega), 1, 3)))  # fmt: skip
    waves = Components(np.array([0.8, 1.0]), np.array([1.0, 2.0]), np.zeros(2), np.array([0.0, np.pi / 2]))
    given_forces.drift_of_half_waves(reader, waves, 0.1, 5.0, 60.0)
    assert asked["heading"] == pytest.approx([math.atan2(4.0, 1.0) - 0.1])
    assert asked["met"] == pytest.approx([0.8 - 0.3 * 0.64, 0.7])
    carrier = None
    given_forces.drift_of_half_waves(reader, waves, 0.1, 5.0, 60.0)
    assert asked["met"] == pytest.approx([0.8, 1.0])


# ------------------------------------------------------------------ bodies between fenders, units of breakwaters


@pytest.mark.parametrize("names, links", [((), None), (("f",), None), ((), "links"), (("f",), "links")])
def test_what_holds_several_bodies_beside_their_lines_adds_its_stiffness(names, links, monkeypatch):
    """The rest under the load less what the lines pull down or heel, which links carry a part of; poses relative to
    those given, headings kept"""
    body = SimpleNamespace(name="p", position=(1.0, 2.0, 3.0, 0.0, 0.0, 0.5))
    asked = {}
    monkeypatch.setattr(
        multi_point,
        "rest_between",
        lambda system, berth, links, water, load: asked.update(load=load) or (np.full(6, 0.1), "mu"),
    )
    monkeypatch.setattr(multi_point, "held_at", lambda system, poses: asked.update(poses=poses))
    monkeypatch.setattr(multi_point, "rest", lambda held: "lines")
    monkeypatch.setattr(multi_point, "berth_stiffness", lambda berth, place: 2 * np.eye(6))
    monkeypatch.setattr(multi_point, "stiffness_together", lambda *given: 3 * np.eye(6))
    monkeypatch.setattr(multi_point, "courses", lambda berth, poses: (
        asked.update(at=poses) or (np.array([[5.0]]), np.array([[6.0]]))))  # fmt: skip
    monkeypatch.setattr(multi_point, "held_by", lambda links, poses, mu: np.full((1, 6), 7.0))
    system, stays = SimpleNamespace(bodies=[body]), SimpleNamespace(force=np.arange(1.0, 9.0))
    berth = SimpleNamespace(names=names)
    lines, others, contact, held = multi_point._between(system, stays, berth, links, "water", np.full(6, 100.0))
    assert lines == "lines" and asked["load"].tolist() == ([100.0] * 6 if links else [100, 100, 97, 96, 95, 100])
    assert asked["poses"]["p"] == pytest.approx([1.1, 2.1, 3.1, 0.1, 0.1, 0.6])
    assert others == pytest.approx(np.eye(6) * (2 * bool(names) + 3 * bool(links)))
    assert contact.tolist() == ([[5.0], [6.0]] if names else [[], []])
    assert held.shape == ((1, 6) if links else (0, 6))
    if names:
        assert asked["at"][0, 0] == pytest.approx([0.1, 0.1, 0.1, 0.1, 0.1, 0.6])


@dataclass
class Unit:
    depth: float = 20.0
    gravity: float = 9.81
    between: object = None


def test_units_of_a_row_send_what_one_sends_with_its_own_motions(monkeypatch):
    """Of one unit no waves between units are needed; of several those at the angles around it"""
    reader, asked = Unit(between=SimpleNamespace(theta=np.arange(4.0))), []
    moved = SimpleNamespace(motions=lambda omega, betas: [f"motions at {omega} {np.asarray(betas).tolist()}"])
    monkeypatch.setattr(lee, "far_field", lambda reader, motions, omega, betas: (motions, omega, list(betas)))
    monkeypatch.setattr(lee, "angles", lambda k, radius: asked.append((k, radius)) or np.array([0.1, 0.2]))
    monkeypatch.setattr(lee, "rectangle", lambda half: "plan")
    monkeypatch.setattr(lee, "field", lambda *given: given)
    k = lee.wavenumber(0.8, 20.0, 9.81)
    plan, number, theta, own, ring, around, betas, middles = lee._field(
        reader, moved, 0.8, np.array([0.5]), np.array([3.0, 4.0]), np.zeros((2, 2))
    )
    assert (plan, number) == ("plan", pytest.approx(float(k))) and theta is reader.between.theta
    assert own == ("motions at [0.8] [0.5]", 0.8, [0.5]) and ring.tolist() == [0.1, 0.2]
    assert around == ("motions at [0.8] [0.1, 0.2]", 0.8, [0.1, 0.2]) and asked == [(pytest.approx(float(k)), 5.0)]
    assert betas.tolist() == [0.5] and middles.shape == (2, 2)
    *_, own, ring, around, _, _ = lee._field(reader, None, 0.8, np.array([0.5]), np.array([3.0, 4.0]), np.zeros((1, 2)))
    assert own[0] is None and not len(ring) and around.shape == (0, 4) and len(asked) == 1
