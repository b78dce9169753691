"""Fenders beside a body that turns and rolls, limits of strain, earthquakes on springs: each number by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.dolphins import at_quay
from hakobune.mooring.dolphins.design_spectrum import (
    Beam,
    DolphinError,
    Dolphins,
    at_fenders,
    beam_of,
    deflection_at,
    limit_height,
    springs,
    strains,
)
from hakobune.mooring.dolphins.earthquake import (
    EarthquakeError,
    Fenders,
    Floater,
    Ground,
    both_sides,
    by_spectrum,
    course,
    ground_of_record,
    response_spectrum,
)
from hakobune.mooring.dolphins.linearised import equivalent
from hakobune.mooring.dolphins.methods import Method, untouched
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.fenders.fender import fender_of_points

TWO = np.array([[-20.0, 25.0, 3.0], [40.0, 25.0, 3.0]])
CENTER = np.array([4.0, 0.0, -1.0])


def spring(k, end=1.0, **marks):
    return fender_of_points("spring", 1.0, [0.0, end], [0.0, k * end], **marks)


def test_springs_across_the_body_resist_its_motions_at_their_places():
    """A fender at (x, z) from the centre moves by sway + x yaw − z roll: K = Σ k v vᵀ"""
    K = springs(Dolphins(None, TWO), CENTER, 2.0)
    wanted = np.zeros((6, 6))
    for x in (-24.0, 36.0):
        v = np.array([0.0, 1.0, 0.0, -4.0, 0.0, x])
        wanted += 2.0 * np.outer(v, v)
    assert pytest.approx(wanted, abs=1e-12) == K


def free_body(**parts):
    omega = np.array([0.5, 1.0])
    inertia = np.diag([1.0, 2e7, 1.0, 3e9, 1.0, 2e10])
    given = {
        "omega": omega, "inertia": np.broadcast_to(inertia, (2, 6, 6)), "damping": np.zeros((2, 6, 6)),
        "stiffness": np.diag([7.0, 0, 7.0, 5e9, 7.0, 0]), "force": np.zeros((2, 6), complex), "drift": np.zeros(2),
        "center": CENTER,
    }  # fmt: skip
    return Beam(**given | parts)


def test_motion_at_the_fenders_is_that_of_their_middle():
    """Stiff against everything but one motion: a force alone moves the middle, at x = 6, z = 4 of the centre"""
    force = np.zeros((2, 6), complex)
    force[:, 1], force[:, 3], force[:, 5] = 1e6, -2e6j, 3e7
    body = free_body(force=force, damping=np.broadcast_to(np.diag([0, 4e6, 0, 1e8, 0, 2e9]), (2, 6, 6)))
    w = body.omega
    sway = 1e6 / (-(w**2) * 2e7 - 4e6j * w)
    roll = -2e6j / (5e9 - w**2 * 3e9 - 1e8j * w)
    yaw = 3e7 / (-(w**2) * 2e10 - 2e9j * w)
    assert at_fenders(body, Dolphins(None, TWO), 0.0, 0.0) == pytest.approx(np.abs(sway - 4 * roll + 6 * yaw), rel=1e-9)
    held = np.diag([1.0, 1e30, 1.0, 0.0, 1.0, 1e30])  # roll alone against springs and their loss
    body = free_body(force=force, stiffness=np.diag([7.0, 0, 7, 5e9, 7, 0]) + held)
    roll = -2e6j / (5e9 - w**2 * 3e9 + 2 * 16 * (7e6 - 1j * 3e6))
    assert at_fenders(body, Dolphins(None, TWO), 7e6, 3e6) == pytest.approx(4 * np.abs(roll), rel=1e-6)


def test_a_beam_is_what_its_database_knows_of_waves_across():
    class Stored:
        omega, inertia, damping, stiffness = np.array([0.4, 1.2]), np.eye(6), 7 * np.eye(6), 3 * np.eye(6)
        rotation_center, knows_drift = (1.0, 2.0, 3.0), True

        def coefficients(self, omega):
            return omega[:, None, None] * np.eye(6), 10 * omega[:, None, None] * np.eye(6)

        def forces(self, omega, headings):
            return (omega + 1j * headings[0])[:, None, None] * np.ones((1, 6))

        def drift(self, omega, headings):
            return omega[:, None, None] * np.array([5.0, 6.0, 7.0])

    made = beam_of(Stored())
    w = made.omega
    assert w[[0, -1]] == pytest.approx([0.4, 1.2]) and np.ptp(np.diff(w)) < 1e-9
    assert made.inertia[:, 1, 1] == pytest.approx(1 + w) and made.damping[:, 2, 2] == pytest.approx(7 + 10 * w)
    assert made.force[:, 4] == pytest.approx(w + 0.5j * math.pi) and made.drift == pytest.approx(6 * w)
    Stored.knows_drift = False
    assert not beam_of(Stored()).drift.any() and beam_of(Stored(), 0.3).force[0, 0].imag == 0.3


def test_a_fender_that_buckles_first_reacts_with_a_force_before_its_peak():
    fender = fender_of_points("b", 1.0, [0.0, 0.1, 0.3, 0.5], [0.0, 1e6, 4e5, 2e6], corners=True)
    assert deflection_at(fender, 5e5) == pytest.approx(0.05, rel=1e-9)
    assert deflection_at(fender, 1.2e6) == pytest.approx(0.3 + 0.2 * 0.5, rel=1e-9) and deflection_at(fender, 0.0) == 0
    with pytest.raises(DolphinError, match="b: 2001 kN act on it, but its table ends at 2000 kN"):
        deflection_at(fender, 2.001e6)


def stiff_sway(k, force, drift=0.0):
    """A body that only sways and that waves move by force/(n k): everything else is still"""
    omega = np.linspace(0.05, 3.0, 3000)
    eye = np.broadcast_to(np.diag([1.0, 1e-3, 1.0, 1.0, 1.0, 1.0]), (3000, 6, 6))
    still, hold = np.zeros((3000, 6, 6)), np.diag([1.0, 0.0, 1.0, 1e30, 1.0, 1e30])
    F = np.zeros((3000, 6), complex)
    F[:, 1] = force
    return Beam(omega, eye, still, hold, F, np.full(3000, drift), np.zeros(3))


SEA = issc(1.0, mean_period=8.0)  # m₀ = 1/16
LARGEST = 3.87  # σ, SR179 report (1982), eq. 3.7.1.3


def test_strain_is_the_static_one_and_three_point_eight_seven_deviations():
    """n = 2 springs of 10 MN/m: δ₀ = (F + 2 D m₀)/n k, σ = |F₁|/nk √m₀; a sea twice as high has four times the drift"""
    dolphins = Dolphins(spring(1e7, 2.0), TWO * [1, 1, 0], 1e7)
    for times in (1.0, 2.0):
        found = strains(stiff_sway(1e7, 4e6, 8e5), dolphins, -3e6, SEA, times)
        drift = 2 * 8e5 / 16 * times**2
        assert found.drift == pytest.approx(drift, rel=3e-3)  # the band ends at 3 rad/s
        assert found.static == pytest.approx((3e6 - drift) / 2e7, rel=2e-3)  # its size: fenders of the other side
        assert found.sigma == pytest.approx(times * 0.2 * 0.25, rel=2e-3)
        assert found.largest == pytest.approx(found.static + LARGEST * found.sigma, rel=1e-3)
        assert (found.strain, found.static_strain) == pytest.approx((found.largest, found.static))


@pytest.mark.parametrize("steady, height, stands", [(9.9e5, 1.0, True), (1.01e6, 1.0, False)])
def test_a_tenth_of_the_height_is_allowed_under_steady_loads(steady, height, stands):
    """1 m high, k = 10 MN/m: 0.099 m and 0.101 m"""
    dolphins = Dolphins(spring(1e7, 2.0), TWO[:1] * 0, 1e7)
    assert strains(stiff_sway(1e7, 1.0), dolphins, steady, SEA, height).stands is stands


@pytest.mark.parametrize("share, stands", [(0.99, True), (1.01, False)])
def test_thirty_five_hundredths_are_allowed_with_waves(share, stands):
    dolphins = Dolphins(spring(1e7, 2.0), TWO[:1] * 0, 1e7)
    force = share * 0.30 / LARGEST / 0.25 * 1e7  # δ₀ = 0.05 m
    found = strains(stiff_sway(1e7, force), dolphins, 5e5, SEA)
    assert found.strain == pytest.approx(0.05 + share * 0.30, rel=3e-3) and found.stands is stands


def test_the_limit_of_the_wave_height_is_where_the_strain_is_reached():
    """0.35 = δ₀ + 3.87 (F/k) H/4; 0 where the steady load is too much, the highest where nothing is"""
    dolphins, body = Dolphins(spring(1e7, 2.0), TWO[:1] * 0, 1e7), stiff_sway(1e7, 5e5)
    found = limit_height(body, dolphins, 5e5, issc, 8.0, highest=40.0)
    assert found == pytest.approx(0.30 * 4 / LARGEST / 0.05, rel=3e-3)
    assert limit_height(body, dolphins, 5e5, issc, 8.0, highest=3.0) == 3.0
    assert limit_height(body, dolphins, 1.1e6, issc, 8.0) == 0.0


def test_an_equivalent_spring_about_a_mean_has_the_mean_force():
    """(y₀ + A cos θ)³: mean y₀³ + 3/2 y₀ A², k = 3 y₀² + 3/4 A²; a force that lags has a loss"""
    found = equivalent(lambda y: y**3, 0.8, 0.5)
    assert found == pytest.approx((0.512 + 1.5 * 0.8 * 0.25, 3 * 0.64 + 0.75 * 0.25, 0.0), abs=1e-12)
    theta = 2 * np.pi * np.arange(4096) / 4096
    lossy = equivalent(lambda y: 2 * y - 0.7 * np.sin(theta), 0.0, 1.4)
    assert lossy == pytest.approx((0.0, 2.0, 0.5), abs=1e-9)


def test_a_base_line_brings_the_ground_to_rest_and_its_ends_are_told():
    """Acceleration 1 − 2s over 10 s leaves the ground displaced: the straight line taken off is itself"""
    t = np.linspace(0.0, 10.0, 201)
    ground = ground_of_record(t + 3.0, 1.0 - 2 * (t / 10) + 0.3 * np.sin(0.4 * math.pi * t), after=1.0)
    assert ground.time[0] == 3.0 and ground.time[-1] == pytest.approx(14.0) and len(ground.time) == 221
    assert not ground.acceleration[-20:].any() and not ground.displacement[-20:].any()
    pure = ground_of_record(t, 0.3 * np.sin(0.4 * math.pi * t))
    assert ground.acceleration[:201] == pytest.approx(pure.acceleration, abs=1e-9)
    assert np.subtract(pure.base_line, ground.base_line) == pytest.approx([1.0, -1.0], abs=1e-9)
    step = t[1] * (pure.acceleration[:1] + pure.acceleration[1:2]) / 2
    assert pure.velocity[1] == pytest.approx(step[0], rel=1e-12)


def test_a_constant_acceleration_moves_an_oscillator_by_twice_its_static_deflection():
    """a/ω² (1 − cos ωt): ω² max |u| = 2a; with 20 % of critical damping a (1 + e^(−πζ/√(1−ζ²)))"""
    t = np.arange(0.0, 40.0, 0.01)
    ground = Ground(t, np.full(len(t), 1.5), 0 * t, 0 * t)
    assert response_spectrum(ground, [2.0], 0.0)[0] == pytest.approx(3.0, rel=1e-4)
    peak = 1 + math.exp(-0.2 * math.pi / math.sqrt(1 - 0.04))
    assert response_spectrum(ground, [2.0, 5.0], 0.2) == pytest.approx([1.5 * peak] * 2, rel=1e-4)


def test_a_response_spectrum_on_springs_by_hand():
    """T = 2π √(m/k), ζ = B/2√(km), S(T) √((0.05 + ζ₀)/(0.05 + ζ)) of a spectrum at ζ₀, never below 0.55"""
    M, a, k = 2e6, 5e5, 4e7
    T = 2 * math.pi * math.sqrt((M + a) / k)
    for ratio, own, factor in (
        (0.08, 0.05, math.sqrt(0.1 / 0.13)),
        (0.08, 0.02, math.sqrt(0.07 / 0.13)),
        (0.6, 0.05, 0.55),
    ):
        floater = Floater(M, a, 2 * ratio * math.sqrt(k * (M + a)))
        found = by_spectrum(floater, Fenders(spring(2e7), 2), lambda period: 1.2 * period, own)
        assert (found.period, found.ratio) == pytest.approx((T, ratio), rel=1e-4)
        assert found.acceleration == pytest.approx(1.2 * T * factor, rel=1e-4)
        assert found.reaction == pytest.approx((M + a) * found.acceleration, rel=1e-4)
        assert found.deflection == pytest.approx(found.reaction / k, rel=1e-4)
    with pytest.raises(EarthquakeError, match="presses spring beyond its table, which ends at 1 m"):
        by_spectrum(floater, Fenders(spring(2e7), 2), lambda period: 40.0)


@pytest.mark.parametrize("displacement, touches", [(0.09, False), (0.11, True)])
def test_a_spectrum_that_does_not_bring_a_body_to_its_fenders_has_no_period(displacement, touches):
    """Clearance 0.1 m, S_a = ω² D at the damping of the body: it moves by D at any period, and touches from 0.1 m on"""
    floater, fenders = Floater(2e6, 5e5, 0.0), Fenders(spring(2e7), 2, 0.1)
    found = by_spectrum(floater, fenders, lambda T: (2 * math.pi / T) ** 2 * displacement, 0.0)
    assert bool(found.reaction > 0) == bool(found.deflection > 0) == touches
    assert bool(np.isnan([found.period, found.ratio, found.acceleration]).all()) != touches
    quake = SimpleNamespace(fenders=fenders)
    said = list(untouched(quake, [Method("spectrum", reaction=found.reaction), Method("no", reaction=np.nan)]))
    assert said == ([] if touches else ["spectrum: no fender is touched; the clearance is 0.1 m on each side"])


def test_a_gap_on_each_side_is_left_before_two_fenders_push():
    """Clearance 0.1 m: at 0.3 and −0.3 m fenders of 5 N/m, two on each side, push with 2 · 5 · 0.2"""
    force = both_sides(Fenders(spring(5.0), 2, 0.1))
    assert force(np.array([0.0, 0.05, 0.3, 0.1, -0.3, -0.05])) == pytest.approx([0, 0, 2.0, 0, -2.0, 0], abs=1e-12)


def test_a_memory_of_two_states_loads_as_its_transfer_function():
    """c (iω − a)⁻¹ b of a = diag(−1, −2), b = (1, 3), c = (4, 5): B = Re, A = Im/ω"""
    floater = Floater(1e6, 2e5, 30.0, np.diag([-1.0, -2.0]), np.array([1.0, 3.0]), np.array([4.0, 5.0]))
    A, B = floater.water(np.array([0.5, 2.0]))
    for i, w in enumerate((0.5, 2.0)):
        at = 4 / (1 + 1j * w) + 15 / (2 + 1j * w)
        assert B[i] == pytest.approx(30 + at.real, rel=1e-12) and A[i] == pytest.approx(2e5 + at.imag / w, rel=1e-12)


def test_a_body_between_springs_that_the_ground_drags_by_hand():
    """Ground at a steady speed v from rest: u = η − y_g = −(v/ω) sin ωt, reaction k u, of the springs of one side"""
    M, k, v = 1e6, 4e6, 0.05
    t = np.arange(0.0, 6.0, 0.02)
    found = course(Ground(t, 0 * t, np.full(len(t), v), v * t), Floater(M, 0.0, 0.0), Fenders(spring(2e6), 2))
    omega = math.sqrt(k / M)
    u = -v / omega * np.sin(omega * t)
    assert found.body == pytest.approx(v * t + u, abs=1e-6)
    assert found.reaction == pytest.approx(k * u, abs=1e-3 * k * v)
    assert found.deflection == pytest.approx(np.abs(u), abs=1e-6)


def test_a_loop_of_fenders_on_both_sides_goes_by_what_they_return():
    """2e6 N/m pressed, 1e6 released, from one to the other over 0.1 m; two of a side with 0.2 m of clearance

    Pressed to 0.5 m, back to 0.45 half way between, to 0.35 released; 0.05 m further half way back
    """
    fender = fender_of_points("f", 2.0, [0.0, 1.0], [0.0, 2e6], [0.0, 1e6], return_length=0.1)
    path = np.array([0.0, 0.3, 0.7, 0.65, 0.55, 0.6, 0.1, -0.3, -0.7, -0.65, -0.1])
    of_one = np.array([0.0, 2e5, 1e6, 6.75e5, 3.5e5, 6e5, 0.0, -2e5, -1e6, -6.75e5, 0.0])
    assert both_sides(Fenders(fender, 2, 0.2))(path) == pytest.approx(2 * of_one, abs=1.0)


class Pressed:
    """Fenders of a quay on either side of a body, and what the design spectrum method is given of them"""

    def __init__(self, monkeypatch, drift):
        self.seen = seen = {}
        beam = free_body(omega=np.array([0.5, 1.0, 1.5]), drift=np.array(drift))
        monkeypatch.setattr(at_quay, "in_sea", lambda body, sea: ((body, sea), ()))
        monkeypatch.setattr(at_quay, "beam_of", lambda body, way: seen.update(body=body, way=way) or beam)
        monkeypatch.setattr(
            at_quay,
            "strains",
            lambda *words: seen.update(zip(("beam", "dolphins", "steady", "spectrum"), words, strict=True)) or "s",
        )
        monkeypatch.setattr(at_quay, "limit_height", lambda *words: words)

    def __call__(self, across, sides=(1, -1, 1)):
        fenders = [SimpleNamespace(normal=(0.1, side * 0.9), face=(x, 2.0, 3.0), fender=f"fender {x}")
                   for x, side in zip((-5.0, 0.0, 5.0), sides, strict=True)]  # fmt: skip
        spectrum = SimpleNamespace(density=lambda omega: 2.0 * np.ones_like(omega))
        waves = SimpleNamespace(direction=1.2, period=7.0)
        conditions = SimpleNamespace(sea=SimpleNamespace(spectrum=spectrum), waves=waves)
        return at_quay.at_quay("body", fenders, across, conditions, "family"), conditions


@pytest.mark.parametrize(("across", "side"), [(5.1e3, 1.0), (4.9e3, -1.0), (5e3, 1.0)])
def test_the_side_that_wind_current_and_waves_press_decides_which_fenders_carry(monkeypatch, across, side):
    """2 ∫ D S dω = 2 · 2 · 0.5 {(−1 − 2)/2 + (−2 + 0)/2} = −5 kN by the trapezium rule; a tie goes to port"""
    pressed = Pressed(monkeypatch, [-1e3, -2e3, 0.0])
    (found, conditions) = pressed(across)
    seen = pressed.seen
    assert found.count == (2 if side > 0 else 1) and found.strains == "s"
    assert seen["body"] == ("body", conditions.sea) and seen["way"] == 1.2
    faces = [(-5.0, 2.0, 3.0), (5.0, 2.0, 3.0)] if side > 0 else [(0.0, 2.0, 3.0)]
    assert seen["dolphins"].fender == ("fender -5.0" if side > 0 else "fender 0.0")
    assert np.array_equal(seen["dolphins"][1], faces) and seen["steady"] == side * across
    assert seen["beam"].drift == pytest.approx(side * np.array([-1e3, -2e3, 0.0]))
    beam, dolphins, steady, family, period = found.limit
    assert beam is seen["beam"] and dolphins is seen["dolphins"] and (steady, family, period) == (
        side * across, "family", 7.0,
    )  # fmt: skip


def test_without_a_fender_on_the_side_that_is_pressed_there_is_none(monkeypatch):
    pressed = Pressed(monkeypatch, [0.0, 0.0, 0.0])
    assert pressed(-1.0, (1, 1, 1))[0] is None and pressed(1.0, (1, 1, 1))[0].count == 3
