"""Parts of the slow motion of one and of several bodies: resonances, rules, phases of waves at two places, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.studies import slow_motion as study
from hakobune.mooring.studies import slow_spectrum

EULER = 0.5772156649015329


def modes(period, stiffness=1e5, damping=1e4, ratio=0.1):
    return study._Modes(*(np.broadcast_to(np.array(row, float), len(period)) for row in
                          (period, stiffness, damping, ratio)))  # fmt: skip


# ------------------------------------------------------------------ one body


def test_a_period_of_crossing_is_of_two_moments_and_none_without_motion():
    found = study._crossing(np.array([4.0, 1.0, 0.0]), np.array([1.0, 0.25, 0.0]))
    assert found == pytest.approx([4 * math.pi, 4 * math.pi, math.inf])


@pytest.mark.parametrize("period, wanted", [
    (100.0, math.sqrt(2 * math.log(36)) + EULER / math.sqrt(2 * math.log(36))),
    (3600 / 2.72, math.sqrt(2 * math.log(2.72)) + EULER / math.sqrt(2 * math.log(2.72))), (3600 / 2.71, 2.0),
    (math.inf, 2.0),
])  # fmt: skip
def test_the_largest_of_few_periods_is_the_significant_amplitude(period, wanted):
    """√(2 ln N) + γ/√(2 ln N) of N = T/period from e periods on, else 2σ"""
    found = study._largest(np.array([3.0, 0.0]), np.array([period, period]), 3600.0)
    assert found == pytest.approx([3 * wanted, 0.0], rel=1e-9)


@pytest.mark.parametrize("slow, fast", [(1.0, 3.0), (3.0, 1.0)])
def test_the_rule_takes_the_larger_of_two_sums(slow, fast):
    """DNV-OS-E301, chapter 2, section 2: 2σ of the one with the largest of the other"""

    def largest(sigma, count):
        return sigma * (math.sqrt(2 * math.log(count)) + EULER / math.sqrt(2 * math.log(count)))

    found = study._rule(*(np.array([x]) for x in (slow, 120.0, fast, 9.0)), 3600.0)
    wanted = max(2 * slow + largest(fast, 400), largest(slow, 30) + 2 * fast)
    assert found == pytest.approx([wanted])


def test_estimates_are_of_a_flat_spectrum_and_of_a_force_that_beats():
    """S = a ω for surge: √(π a ω_n/2NC), and √(a ω²/2) over C at 1/2ν"""
    omega = np.linspace(0.0, 0.4, 401)
    force = np.multiply.outer(omega, np.diag([2e8, 4e8, 0.0]))
    given = modes([2 * math.pi / 0.1, 2 * math.pi / 0.2, 2 * math.pi / 0.3], 2e5, 5e4, [0.1, 0.2, 0.3])
    found = study._estimates(force, omega, given)
    flat = [math.sqrt(math.pi * a * w / (2 * 5e4 * 2e5)) for a, w in ((2e8, 0.1), (4e8, 0.2), (0.0, 0.3))]
    beats = [math.sqrt(a * 0.4**2 / 2) / 2e5 / (2 * nu) for a, nu in ((2e8, 0.1), (4e8, 0.2), (0.0, 0.3))]
    assert found[:, 0] == pytest.approx(flat, rel=1e-6) and found[:, 1] == pytest.approx(beats, rel=1e-4)


@pytest.mark.parametrize("period, near", [(6.66, ""), (6.67, "surge"), (14.9, "surge"), (15.1, "")])
def test_a_natural_period_within_one_and_a_half_of_the_peak_is_told(period, near):
    sea = SimpleNamespace(spectrum=SimpleNamespace(Tp=10.0))
    said = list(study._flags(modes([period, 100.0, 90.0]), sea))
    assert [line.split(" is within")[0] for line in said] == (
        [f"natural period of {near} {period:.4g} s"] if near else [])  # fmt: skip
    two = SimpleNamespace(systems=(sea, SimpleNamespace(spectrum=SimpleNamespace(Tp=100.0))), spectrum=None)
    said = list(study._flags(modes([period, 100.0, 90.0]), two))
    assert len(said) == 1 + bool(near) and "natural period of sway 100 s, yaw 90 s is within" in said[-1]
    assert "of the waves, 100 s" in said[-1]


@pytest.mark.parametrize("ratio, told", [(0.0199, True), (0.0201, False)])
def test_damping_below_two_per_cent_of_critical_is_told(ratio, told):
    sea = SimpleNamespace(spectrum=SimpleNamespace(Tp=10.0))
    said = list(study._flags(modes([80.0, 100.0, 90.0], ratio=[0.1, ratio, 0.1]), sea, ("a", "b", "c")))
    assert said == ([f"slow motion is lightly damped: b {100 * ratio:.3g} % of critical; give the drag of lines and "
                     "hull as body.damping_ratio"] if told else [])  # fmt: skip


@pytest.mark.parametrize("several", [False, True])
def test_frequencies_are_close_about_each_slow_resonance(several, monkeypatch):
    """To three times the highest of them; within a few of its half widths ν ω_n the steps are a twentieth of that

    Of several bodies modes from half of the mean frequency of the waves on, held by fenders, are not slow.
    """
    monkeypatch.setattr(study, "differences", lambda held: np.array([0.0, 0.2]))
    held = SimpleNamespace(bodies=("a", "b") if several else ())
    sea = SimpleNamespace(spectrum=SimpleNamespace(T01=2 * math.pi))
    given = modes([2 * math.pi / 0.1, 2 * math.pi / 0.49, 2 * math.pi / 0.6], ratio=[0.1, 0.05, 0.01])
    omega = study._places(held, given, sea)
    assert omega[0] == 0.0 and np.all(np.diff(omega) > 0)
    assert omega[-1] == pytest.approx(3 * 0.49 if several else 3 * 0.6)
    for natural, nu, slow in ((0.1, 0.1, True), (0.49, 0.05, True), (0.6, 0.01, not several)):
        beside = omega[np.abs(omega - natural) <= 2 * nu * natural]
        assert (len(beside) > 30) == slow and (np.abs(omega - natural).min() < 1e-12) == slow
        if slow:
            assert np.diff(beside).max() < 0.3 * nu * natural
    still = study._places(SimpleNamespace(bodies=()), modes([1e4, 1e4, 1e4]), sea)
    assert still[-1] == 0.2 and len(still) >= 121


def test_a_body_answers_a_force_by_its_stiffness_mass_and_damping():
    """1/(K − ω² M − iω N), of surge, sway and yaw; what holds nothing but a coupling follows"""
    M, N, K = (np.diag(np.arange(1.0, 7.0)) * size for size in (2.0, 0.5, 30.0))
    found = study._response(np.array([0.0, 1.5]), M, N, K)
    for d, w in enumerate((0.0, 1.5)):
        wanted = [1 / (n * (30.0 - 2.0 * w * w - 0.5j * w)) for n in (1, 2, 6)]
        assert found[d] == pytest.approx(np.diag(wanted))
    K[0, 4] = K[4, 0] = 20.0  # pitch follows: K_11 − K_15²/K_55
    assert study._response(np.zeros(1), M, N, K)[0, 0, 0] == pytest.approx(1 / (30.0 - 400.0 / 150.0))


def test_bodies_whose_surge_a_hinge_holds_together_answer_as_one():
    M, N, K = (np.diag(np.r_[np.full(6, 1.0), np.full(6, 3.0)]) * size for size in (2.0, 0.5, 30.0))
    free = np.delete(np.eye(12), 6, axis=1)
    free[6, 0] = 1.0
    found = study._response(np.array([1.5]), M, N, K, free)[0]
    assert found.shape == (6, 6)
    one = 1 / (4 * (30.0 - 2.0 * 2.25 - 0.75j))
    assert found[np.ix_([0, 3], [0, 3])] == pytest.approx(np.full((2, 2), one))
    assert found[4, 4] == pytest.approx(4 / 3 * one) and found[1, 1] == pytest.approx(4 * one)


@pytest.mark.parametrize("sign, wanted", [(0, [0.0, 0.0, 0.4 * 14]), (1, [-0.4 * 14, 0.0, 0.0])])
def test_a_form_of_one_answer_at_all_differences_has_one_eigenvalue(sign, wanted):
    """Q_il = c r_i r_l with r = (1, 2, 3): c Σ r², of negative drift its negative"""
    root = np.zeros((3, 2, 3))
    root[:, sign, 0] = [1.0, 2.0, 3.0]
    respond = np.zeros((3, 3), complex)
    respond[:, 0] = 0.4
    assert study._eigenvalues(respond, root) == pytest.approx(wanted, abs=1e-12)


def test_a_form_of_two_waves_has_the_answer_at_their_difference_and_its_conjugate():
    """[[h₀, h₁*], [h₁, h₀]]: h₀ ± |h₁|; of forces along two motions they add"""
    root, respond = np.ones((2, 2, 3)), np.zeros((2, 3), complex)
    root[:, 1] = 0.0
    respond[:, 0], respond[:, 2] = [2.0, 0.3 + 0.4j], [1.0, 0.0]
    assert study._eigenvalues(respond, root) == pytest.approx([2.5, 3.5])


def single(stiffness, damping, monkeypatch, period=(80.0, 0, 0, 0, 0, 60.0)):
    periods = np.array(period, float)
    periods[1] = 70.0
    monkeypatch.setattr(study, "natural_periods", lambda held: SimpleNamespace(names=held.names, period=periods))
    held = SimpleNamespace(stiffness=np.diag([stiffness, 2e5, 0, 0, 0, 3e8]), bodies=(), names=tuple("XYZKMN"),
                           words=("surge", "sway", "heave", "roll", "pitch", "yaw"))  # fmt: skip
    return study._modes(held, np.diag([4e7, 5e7, 1, 1, 1, 6e10]), np.diag([damping, 2e5, 0, 0, 0, 3e8]))


def test_modes_of_one_body_have_its_stiffness_damping_and_share_of_critical(monkeypatch):
    found = single(1e5, 4e5, monkeypatch)
    assert found.period.tolist() == [80.0, 70.0, 60.0] and found.stiffness.tolist() == [1e5, 2e5, 3e8]
    assert found.damping.tolist() == [4e5, 2e5, 3e8]
    assert found.ratio == pytest.approx([4e5 / (2 * math.sqrt(4e12)), 2e5 / (2 * math.sqrt(1e13)),
                                         3e8 / (2 * math.sqrt(1.8e19))])  # fmt: skip
    for K, N, period, says in ((0.0, 4e5, 80.0, "surge has no restoring"), (1e5, 4e5, np.inf, "surge has no restoring"),
                               (1e5, 0.0, 80.0, "slow surge has damping 0 ")):  # fmt: skip
        with pytest.raises(ValueError, match=says):
            single(K, N, monkeypatch, (period, 0, 0, 0, 0, 60.0))


# ------------------------------------------------------------------ several bodies


@pytest.mark.parametrize("bodies", [1, 2])
def test_wave_drift_damping_acts_on_velocities_of_its_own_body(bodies):
    rows = np.arange(1.0, 1 + 6 * bodies).reshape(-1, 2)
    full = study._drift_damping(rows, bodies)
    assert full.shape == (6 * bodies, 6 * bodies) and np.count_nonzero(full) == 6 * bodies
    for i in range(bodies):
        for row, motion in zip(rows[3 * i : 3 * i + 3], (0, 1, 5), strict=True):
            assert full[6 * i + motion, [6 * i, 6 * i + 1]].tolist() == row.tolist()
    assert not study._drift_damping(None, bodies).any() and study._drift_damping(None, bodies).shape == full.shape
    assert study._plane(full) == [6 * i + k for i in range(bodies) for k in (0, 1, 5)]


def test_slow_motions_radiate_by_their_own_frequency_or_less_below_what_is_stored():
    """√(K/M) of 0.1, 0.5 and 3 rad/s: B at 0.2 rad/s by half, B(0.5), B at the last stored, 2 rad/s"""
    natural = np.array([0.1, 0.5, 1.0, 1.0, 1.0, 3.0])
    mass = np.array([2.0, 3.0, 1.0, 1.0, 1.0, 5.0])
    held = SimpleNamespace(
        stiffness=np.diag(natural**2 * (mass + 1.0)), inertia=np.diag(mass), held_added_mass=lambda w: [np.eye(6)],
        between=SimpleNamespace(span=(0.2, 2.0)),
        coefficients=lambda omega: (None, np.multiply.outer(omega, np.diag(np.arange(10.0, 16.0)))),
    )  # fmt: skip
    assert study._radiated(held) == pytest.approx([10 * 0.2 * 0.5, 11 * 0.5, 15 * 2.0])


WORDS = tuple(f"{motion} of {body}" for body in "ab" for motion in ("surge", "sway", "heave", "roll", "pitch", "yaw"))


def together(monkeypatch, period=62.0, damping=1.0):
    """Surge of both as one mode, (1, 1), named after a, and against each other, (1, −½), named after b; others alone"""
    names = tuple(f"n{i}" for i in range(12))
    shapes = np.eye(12)
    shapes[0, 6], shapes[6, 0], shapes[6, 6] = 1.0, -0.5, 1.0
    shapes[5] *= 0.25  # yaw over the scale of 4 m
    periods = np.r_[period, np.arange(70.0, 81.0)]
    found = SimpleNamespace(names=names[:11], period=periods[:11], shapes=shapes[:11], scale=4.0)
    monkeypatch.setattr(study, "natural_periods", lambda held: found)
    held = SimpleNamespace(bodies=("a", "b"), names=names, words=WORDS, turning=np.arange(12) % 6 > 2,
                           stiffness=np.diag(np.r_[np.full(6, 2.0), np.full(6, 3.0)]))  # fmt: skip
    return study._modes(held, np.diag(np.r_[np.full(6, 5.0), np.full(6, 7.0)]), damping * np.eye(12))


def test_coupled_modes_have_the_stiffness_that_their_motion_feels(monkeypatch):
    """Mode (1, 1): C = 5, N = 2, M = 12; mode (−½, 1), by the surge of b: C = 3.5, N = 1.25, M = 8.25; a mode that a
    hinge takes has no values"""
    found = together(monkeypatch)
    assert found.period[:4].tolist() == [62.0, 70.0, 74.0, 75.0] and np.isnan(found.period[5])
    assert found.stiffness[:4] == pytest.approx([5.0, 2.0, 2.0, 3.5]) and np.isnan(found.stiffness[5])
    assert found.damping[:4] == pytest.approx([2.0, 1.0, 1.0, 1.25])
    assert found.ratio[:4] == pytest.approx([2 / (2 * math.sqrt(60)), 1 / (2 * math.sqrt(10)), 1 / (2 * math.sqrt(10)),
                                             1.25 / (2 * math.sqrt(3.5 * 8.25))])  # fmt: skip
    with pytest.raises(ValueError, match="surge of a has no restoring by the lines"):
        together(monkeypatch, math.inf)
    with pytest.raises(ValueError, match=r"slow surge of a has damping 0 .*\"surge of a\" = 0.05"):
        together(monkeypatch, damping=0.0)


class TwoBodies:
    """One 30 m ahead and 40 m to the left of the origin, turned by 90°, and one at the origin; deep water"""

    bodies = (SimpleNamespace(fixed=False), SimpleNamespace(fixed=True), SimpleNamespace(fixed=False))
    depth, gravity, omega = math.inf, 10.0, np.array([1.0, 2.0])
    axes_at_rest = np.array([[30.0, 40.0, 0.0, 0.0, 0.0, math.pi / 2], [0.0, 0, 0, 0, 0, 0]])

    def drift_of_each(self, omega, headings, fixed):
        return np.arange(2 * 1 * 3 * 3.0).reshape(2, 1, 3, 3)


def sea_of(drift=None, weights=(1.0,), heading=(0.0,), omega=(1.0, 2.0), body=None, spectrum=None):
    body = slow_spectrum.OfEach(TwoBodies()) if body is None else body
    return slow_spectrum.DriftOfSea(spectrum, np.array(omega), drift, np.array(weights), body, np.array(heading))


def test_the_drift_of_each_is_that_of_bodies_that_move():
    body = slow_spectrum.OfEach(TwoBodies())
    assert body.drift(None, None).tolist() == [[[0, 1, 2, 6, 7, 8]], [[9, 10, 11, 15, 16, 17]]]
    assert body.depth == math.inf and body.gravity == 10.0


def test_waves_meet_each_body_at_its_own_place():
    """k = ω²/g: 0.1 and 0.4 rad/m; towards x by 30 m, towards y by 40 m, against them by the negative"""
    turn = sea_of().phases(np.array([0.0, math.pi / 2, math.pi]))
    assert turn.shape == (2, 3, 6)
    for q, k in enumerate((0.1, 0.4)):
        for p, way in enumerate((30.0, 40.0, -30.0)):
            assert turn[q, p] == pytest.approx(np.r_[np.full(3, np.exp(1j * k * way)), np.ones(3)], rel=1e-9)
    other = sea_of().phases(np.array([0.0]), np.array([3.0]))
    assert other[0, 0, 0] == pytest.approx(np.exp(0.9j * 30))
    assert sea_of(body=SimpleNamespace(bodies=())).phases(np.zeros(1)) is None


@pytest.mark.parametrize("weights", [(0.5, 0.5), ((0.4, 0.6), (0.6, 0.4))])
def test_waves_of_many_directions_travel_to_their_mean(weights):
    """Half towards x and half towards y: towards 45°, by 70/√2 m"""
    turn = sea_of(weights=weights, heading=(0.0, math.pi / 2)).main_phases(np.array([1.0]))
    assert turn.shape == (1, 1, 6) and turn[0, 0, 1] == pytest.approx(np.exp(0.1j * 70 / math.sqrt(2)))


def test_forces_of_a_wave_group_reach_two_bodies_one_after_the_other(monkeypatch):
    """S = 1 from 1 to 2 rad/s, D = 3 and −2 N/m²: 8 D² (1 − Δ) on the diagonal; between the bodies the phase of
    k(ω + Δ) − k(ω) = (2ωΔ + Δ²)/g over 30 m, against each other where one drifts backward: 8 D_a D_b (1 − Δ)"""
    monkeypatch.setattr(slow_spectrum, "held_beyond", lambda omega, parts, spectrum: (omega, parts))
    omega = np.linspace(1.0, 2.0, 1001)
    drift = np.tile([3.0, -2.0, 0.0, 3.0, 3.0, 0.0], (1001, 1, 1))
    spectrum = SimpleNamespace(density=lambda w: np.ones(np.shape(w)))
    given = sea_of(drift, omega=omega, spectrum=spectrum)
    places, found = given.coarse(0.2)
    assert len(places) == slow_spectrum.COARSE and places[[0, -1]].tolist() == [0.0, 0.2]
    assert found[0].diagonal().real == pytest.approx([72.0, 32.0, 0.0, 72.0, 72.0, 0.0], rel=1e-6)
    assert found[60].diagonal().real == pytest.approx(0.9 * np.array([72.0, 32.0, 0, 72.0, 72.0, 0]), rel=2e-3)
    step, at = 0.1, np.linspace(1.0, 1.9, 20001)
    phase = np.trapezoid(np.exp(1j * (2 * at * step + step**2) / 10 * 30), at)
    assert found[60, 0, 3] == pytest.approx(72 * phase, rel=3e-3)
    assert found[60, 3, 0] == pytest.approx(found[60, 0, 3].conj(), rel=1e-9)
    assert found[60, 1, 3] == pytest.approx(-48 * phase, rel=3e-3)
    assert given.slow_spectrum(np.array([0.0, 0.1]))[1] == pytest.approx(found[60], rel=1e-9)


def test_wave_drift_damping_of_each_is_along_its_own_axes(monkeypatch):
    """A velocity u ahead of a body turned by 90° is along y in space, a velocity to its left against x"""
    rows = np.arange(1.0, 13.0).reshape(6, 2)
    monkeypatch.setattr(slow_spectrum, "drift_on_current", lambda body, omega, heading: (None, "B", True))
    monkeypatch.setattr(slow_spectrum, "mean_damping", lambda omega, B, density, weights: rows)
    spectrum = SimpleNamespace(density=lambda omega: omega)
    found = sea_of(spectrum=spectrum).damping()
    assert found[3:] == pytest.approx(rows[3:])
    assert found[:3] == pytest.approx(np.stack([rows[:3, 1], -rows[:3, 0]], axis=1))
    monkeypatch.setattr(slow_spectrum, "drift_on_current", lambda body, omega, heading: (None, None, False))
    assert sea_of(spectrum=spectrum).damping() is None


def test_a_spectrum_between_the_places_that_were_summed_is_straight():
    known = np.array([0.0, 1.0, 3.0]), np.array([[[0.0, 1j]], [[2.0, 3j]], [[4.0, -1j]]])
    found = slow_spectrum.between(known, np.array([0.5, 2.0]))
    assert found == pytest.approx(np.array([[[1.0, 2j]], [[3.0, 1j]]])) and found.shape == (2, 1, 2)
