"""Drift on a current against the cylinder on the bed, walls that meet waves in a stream, and plain kinematics."""

import numpy as np
import pytest
from exact import maccamy_fuchs
from exact.water_waves import group_factor as exact_group_factor
from exact.water_waves import wavenumber as exact_wavenumber
from scipy.optimize import brentq

from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.waves import group_factor, wavenumber
from hakobune.meshing.shapes import buoy
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.on_current.body import on_current
from hakobune.mooring.on_current.waves import (
    Carrier,
    absolute_frequency,
    carrier_of,
    check_blocked,
    in_water,
    intrinsic_frequency,
    met_by_a_place,
)
from hakobune.mooring.response.linear import _apart
from hakobune.mooring.response.wave_drift_damping import drift_and_damping, from_slopes, of_current
from hakobune.mooring.studies.conditions import Current

G = 9.80665
A, H = 10.0, 20.0  # m, radius and depth of the cylinder
# ∂F/∂V over F of a cylinder on the bed by Taylor's transformation, per m/s, to four digits
TAYLOR = {0.5: 0.4463, 1.0: 0.3598, 1.5: 0.4769}


def omega_of(k, depth=H):
    return np.sqrt(G * k * np.tanh(k * depth))


def cylinder_drift(omega):
    return maccamy_fuchs.drift(A, H, omega, gravity=G)[0]


@pytest.mark.parametrize("ka", TAYLOR)
def test_drift_of_a_cylinder_on_the_bed_grows_with_a_current_as_taylors_transformation_says(ka):
    omega, dw = omega_of(ka / A), 1e-5
    D = np.array([[[cylinder_drift(omega), 0.0, 0.0]]])
    slope = (cylinder_drift(omega + dw) - cylinder_drift(omega - dw)) / (2 * dw) * np.array([[[1.0, 0.0, 0.0]]])
    k = np.array([ka / A])
    B = from_slopes(np.array([omega]), [0.0], k, H, D, slope, 0 * D)
    assert B[0, 0, 0, 0] / D[0, 0, 0] == pytest.approx(TAYLOR[ka], rel=1e-3)


@pytest.fixture(scope="module")
def solved_cylinder():
    """`Reader` of the cylinder on the bed, solved by panels at ten frequencies"""
    mesh = buoy(A, H, counts=(6, 1, 8), bottom=False)
    body = prepare(PanelProblem(mesh, None, depth=H))
    omega, headings = np.linspace(0.5, 1.35, 10), np.array([0.0])
    theta = np.arange(64) * 2 * np.pi / 64
    want = frozenset({"drift_force_fixed", "kochin_diffraction", "kochin_radiation"})
    rows = [solve_frequency(body, w, headings, want, theta=theta) for w in omega]
    stored = {name: np.array([row[name] for row in rows]) for name in want}
    between = Between(omega, stored, H, G, headings, theta, mesh.points[:, :2])
    return Reader(between, 1025.0, np.zeros(3), None, None, np.zeros((6, 6)), "xy", is_round=True)


@pytest.mark.parametrize("ka", TAYLOR)
def test_a_database_of_that_cylinder_says_the_same(solved_cylinder, ka):
    omega = omega_of(ka / A) + 2e-3 * np.arange(-2, 3)
    body = on_current(solved_cylinder, Carrier((1.0, 0.0)))
    D, B = drift_and_damping(body, omega, [0.0], fixed=True)
    assert of_current(body, B)[2, 0, 0] / D[2, 0, 0] == pytest.approx(TAYLOR[ka], rel=1e-2)


def wall_force(omega, depth, V):
    """Force per ρg of waves of unit amplitude and intrinsic frequency on a reflecting wall at rest in a stream V.

    The wall meets them at ω + kV, and sends back waves that it meets at the same; action E(C_g + V)/σ is kept and
    carries the momentum k.
    """
    k = exact_wavenumber(omega, depth, G)
    C_g = exact_group_factor(k, depth) * omega / k
    met = omega + k * V
    back = brentq(lambda w: w - exact_wavenumber(w, depth, G) * V - met, 0.3 * omega, 3 * omega, xtol=1e-14)
    return 0.5 * (C_g + V) / omega * (k + exact_wavenumber(back, depth, G))


@pytest.mark.parametrize("depth", [5.0, 20.0, 200.0])
@pytest.mark.parametrize("absolute", [False, True])
def test_drift_of_a_wall_is_the_slope_of_its_force_with_the_frequency_held_that_is_given(depth, absolute):
    """The wall is made known as a database would: its drift D(σ) at rest, read in the frequencies that are given"""
    given, v = np.linspace(0.55, 0.65, 41), 1e-3

    class Wall:
        gravity = G

        def __init__(self, carrier):
            self.carrier, self.depth = carrier, depth

        def intrinsic(self, omega, heading):
            return self.carrier.own(omega[:, None], heading, depth, G)

        def drift(self, omega, heading, fixed=False):
            own = self.carrier.own(omega[:, None], np.zeros(len(heading)), depth, G)
            rest = np.array([[wall_force(w, depth, 0.0) for w in row] for row in own])
            return rest[..., None] * np.array([1.0, 0.0, 0.0])

    def force(V):
        own = intrinsic_frequency(given[20:21], V, depth, G)[0] if absolute else given[20]
        return wall_force(own, depth, V)

    body = Wall(Carrier((v, 0.0), absolute))
    D, B = drift_and_damping(body, given, np.array([0.0]))
    on = (D + of_current(body, B))[20, 0, 0]
    assert on - force(0.0) == pytest.approx(force(v) - force(0.0), rel=5e-3)


@pytest.mark.parametrize("depth", [8.0, 40.0, np.inf])
@pytest.mark.parametrize("speed", [-0.8, 0.4, 3.0])
def test_a_place_at_rest_meets_the_crests_that_the_stream_carries_past_it(depth, speed):
    """Crests of a wave of length λ pass with C + V: f = (C + V)/λ"""
    omega = np.array([0.3, 0.7, 1.1])
    k = np.array([brentq(lambda q, w=w: G * q * np.tanh(q * min(depth, 1e4)) - w * w, 1e-6, 5) for w in omega])
    met = absolute_frequency(omega, speed, depth, G)
    assert met == pytest.approx(2 * np.pi * (omega / k + speed) / (2 * np.pi / k), rel=1e-9)
    assert intrinsic_frequency(met, speed, depth, G) == pytest.approx(omega, rel=1e-9)


def test_a_current_across_long_crests_does_not_change_when_they_pass():
    waves = Components(np.array([0.8]), np.ones(1), np.zeros(1), np.zeros(1))
    assert met_by_a_place(waves, Carrier((0.0, 2.0)), 30.0, G) == pytest.approx(0.8)
    assert in_water(waves, Carrier((0.0, 2.0), True), 30.0, G).omega == pytest.approx(0.8)


def test_waves_measured_at_a_place_come_back_there_after_a_way_through_the_water():
    waves = Components(np.array([0.5, 0.9]), np.ones(2), np.zeros(2), np.array([0.3, 2.0]))
    carrier = Carrier((1.2, -0.5), absolute=True)
    assert met_by_a_place(in_water(waves, carrier, 25.0, G), carrier, 25.0, G) == pytest.approx(waves.omega, rel=1e-9)


def test_blocked_waves_are_refused_and_strong_currents_told_with_the_number_and_the_way_out():
    """In deep water C_g = g/2σ: waves of 4 s travel with 3.1 m/s"""
    sea = Sea(jonswap(1.0, peak_period=4.0), 0.0)
    with pytest.raises(ValueError, match=r'blocks .* % .*allowed: 5 %.*current.waves = "still"'):
        list(check_blocked(Carrier((-4.0, 0.0)), sea, np.inf, G))
    (line,) = check_blocked(Carrier((1.0, 0.0)), sea, np.inf, G)
    assert "up to 0.25" in line and 'current.waves = "still"' in line
    assert not list(check_blocked(Carrier((0.3, 0.0)), sea, np.inf, G))
    assert not list(check_blocked(None, sea, np.inf, G))


def test_waves_of_still_water_are_asked_for_by_name():
    assert carrier_of(Current(1.5, 0.0, waves="still")) is None
    assert carrier_of(Current(1.5, np.pi / 2)).velocity == pytest.approx((0.0, 1.5))
    with pytest.raises(ValueError, match="intrinsic, absolute, still"):
        Current(1.5, 0.0, waves="moving")


def test_crests_pass_a_member_at_rest_with_their_speed_and_that_of_the_surface():
    from hakobune.mooring.environment.current_profile import power_law
    from hakobune.mooring.loads.regular_wave import RegularWave

    wave = RegularWave(1.0, 2 * np.pi / 8.0, 0.4, 25.0, power_law(1.3, 0.4 + np.pi / 3, 25.0, 1 / 7))
    length = 2 * np.pi / exact_wavenumber(2 * np.pi / 8.0, 25.0, G)
    assert wave.met_period == pytest.approx(length / (length / 8.0 + 0.65), rel=1e-6)


def test_places_of_the_resonances_of_many_headings_are_far_enough_apart_to_differentiate_between():
    """Mirrored headings shift a resonance alike to rounding, which gave slopes of 0/0"""
    steps = np.linspace(0.2, 1.5, 20)
    places = np.array([0.5, 0.5 + 1e-15, 0.7, 0.7 + 1e-6, 0.9, steps[5] + 1e-12])
    for count in (1, 12):
        kept = np.union1d(steps, _apart(np.sort(places), steps, count))
        assert np.diff(kept).min() > 1e-4 and {0.5, 0.7, 0.9} <= set(kept)


def test_groups_travel_past_with_the_speed_of_energy_and_of_the_stream():
    """What beats at σ₁ − σ₂ in the water passes at (σ₁ − σ₂)(1 + V/C_g) for neighbours"""
    sigma, V, depth = 0.7, 0.9, 15.0
    k = wavenumber(sigma, depth, G)
    C_g = group_factor(k, depth) * sigma / k
    pair = absolute_frequency(np.array([sigma - 1e-5, sigma + 1e-5]), V, depth, G)
    assert np.diff(pair)[0] / 2e-5 == pytest.approx(1 + V / C_g, rel=1e-6)
