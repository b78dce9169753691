"""Loads on a body at a single point and what is read off its motion, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import signal

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import tabulated
from hakobune.mooring.environment.spreading import WrappedNormal
from hakobune.mooring.loads.turning import turning_coefficients
from hakobune.mooring.motion.tables.wave_windows import HEADINGS
from hakobune.mooring.motion.wave_loads import WaveForces
from hakobune.mooring.on_current.waves import Carrier
from hakobune.mooring.single_point import runs
from hakobune.mooring.single_point.body import Hold, SinglePoint
from hakobune.mooring.single_point.criterion import Lateral, moored_quartic, proportions, slewing
from hakobune.mooring.single_point.history import cycle, settled_after, watch_circle, wave_deviations
from hakobune.mooring.single_point.in_time import of_contact
from hakobune.mooring.single_point.loads import (
    DriftLoad,
    Loads,
    WaterLoad,
    WindLoad,
    isotropic_drift,
    still_table,
    turning_table,
)
from hakobune.mooring.single_point.rings import Ring, angles
from hakobune.mooring.single_point.scope import highest_third, length_without_uplift, peak, significant
from hakobune.mooring.single_point.slewing import _record as slow_record
from hakobune.mooring.single_point.slewing import accelerations, at_rest_state, turned_state
from hakobune.mooring.single_point.waves import (
    RING,
    at_heading,
    headings,
    mean_drift,
    mean_frequency,
    share_of_height,
    slow_part,
    split_frequency,
)
from hakobune.mooring.single_point.yaw_criteria import straight_line, yaw_stability

COUNT = 360
BETA = angles(COUNT)


def drag(a, b, c):
    """(COUNT, 3) a cos β, b sin β along and across, c sin 2β about z, of a unit stream towards β"""
    return np.stack([a * np.cos(BETA), b * np.sin(BETA), c * np.sin(2 * BETA)], axis=1)


def test_water_pushes_a_moving_body_back_and_its_turn_has_its_powers():
    """V² Σ cₖ r'ᵏ of the angle that the water flows to, less N₂ r|r| and a linear part

    V = 1 m/s at 3:4, r' = r L/V = 0.2; beyond |r'| = 0.5 it is that of 0.5
    """
    table = np.stack([drag(2.0, 3.0, 4.0) * k for k in (1.0, 0.5, 0.25, 10.0, 100.0)], axis=1)
    load = WaterLoad(table, 20.0, False, quadratic=7.0, linear=np.diag([0.1, 0.2, 0.3]))
    r = 0.01
    unit = np.array([-2.0 * 0.6, -3.0 * 0.8, 4.0 * 2 * 0.6 * 0.8])
    turn = 0.2
    powers = 1 + 0.5 * turn + 0.25 * turn**2 + 10 * turn**3 + 100 * turn**4
    wanted = unit * powers - [0.06, 0.16, 0.003 + 7 * r * r]
    assert load.force(0.6, 0.8, r) == pytest.approx(wanted, rel=1e-6)
    most = 1 + 0.25 + 0.0625 + 1.25 + 6.25
    assert load.force(0.6, 0.8, 1.0)[:2] == pytest.approx(unit[:2] * most - [0.06, 0.16], rel=1e-6)
    less = 1 - 0.25 + 0.0625 - 1.25 + 6.25
    assert load.force(1.2, 1.6, -9.0) == pytest.approx(4 * unit * less - [0.12, 0.32, -2.7 - 7 * 81], rel=1e-6)
    assert load.force(0.0, 0.0, -0.5) == pytest.approx([0, 0, 7 * 0.25 + 0.15])


def test_loads_at_rest_are_those_of_each_stream_at_its_angle_from_the_bow():
    """Current of 2 m/s towards 40°, wind of 10 m/s towards 100°, heading 10°; drift by the heading"""
    water = WaterLoad(
        still_table(drag(2.0, 3.0, 4.0)), 20.0, False, 2.0, math.radians(40), linear=np.diag([5.0, 6.0, 7.0])
    )
    wind = WindLoad(drag(0.2, 0.3, 0.4), 10.0, math.radians(100))
    loads = Loads(water, wind, DriftLoad(drag(50.0, 60.0, 70.0)))
    (found,) = loads.at_rest(np.radians([10.0]))
    c, s = math.cos(math.radians(30)), 0.5
    current = 4 * np.array([2 * c, 3 * s, 4 * 2 * s * c]) + 2 * np.array([5 * c, 6 * s, 0])
    air = 100 * np.array([0.0, 0.3, 0.0])
    ten = math.radians(10)
    drift = np.array([50 * math.cos(ten), 60 * math.sin(ten), 70 * math.sin(2 * ten)])
    assert found == pytest.approx(current + air + drift, rel=1e-6)
    # at rest over ground the body moves through the water against the current
    u, v = -2 * c, -2 * s
    assert loads.moving(ten, (u, v, 0.0)) == pytest.approx(found, rel=1e-6)
    # going with the water nothing of it is felt, and the wind is that over the moving water: 10 − 2 cos 60° …
    w = np.array([10 * math.cos(math.pi / 2) - 2 * c, 10 * math.sin(math.pi / 2) - 2 * s])
    speed, at = np.hypot(*w), math.atan2(w[1], w[0])
    carried = speed**2 * np.array([0.2 * math.cos(at), 0.3 * math.sin(at), 0.4 * math.sin(2 * at)])
    assert loads.moving(ten, (0.0, 0.0, 0.0)) == pytest.approx(carried + drift, rel=1e-6)
    gust = loads.moving(ten, (u, v, 0.0), wind_speed=12.0)
    assert gust - found == pytest.approx([0, (144 - 100) * 0.3, 0], abs=1e-6)


def test_tables_of_turning_and_of_drift_by_hand():
    """Water that flows towards π − β passes a body of drift angle β; ½ρLd, and L more of the moment

    A force along the waves at the middle, 3 m ahead of the centre, turns by 3 times its part across
    """
    c = turning_coefficients(2.0, 10.0, 1.5)
    table = turning_table(c, 100.0, 5.0, 1000.0, COUNT)
    beta = 0.4
    at = Ring(table)(math.pi - beta)
    half = 0.5 * 1000 * 500
    for turn in (-0.3, 0.2):
        total = sum(at[k] * turn**k for k in range(5))
        wanted = half * np.array([-c.C_x(beta, turn), c.C_y(beta, turn), 100 * c.C_m(beta, turn)])
        assert total == pytest.approx(wanted, rel=1e-6)
    made = Ring(isotropic_drift(6.0, 0.5, (-3.0, 1.0), count=COUNT).table)(0.2)
    along = np.array([6 * math.cos(0.3), 6 * math.sin(0.3)])
    assert made == pytest.approx([*along, 3.0 * along[1] + 1.0 * along[0]], rel=1e-6)


def body_in(speed, towards, turning=False):
    water = WaterLoad(still_table(np.zeros((COUNT, 3))), 20.0, turning, speed, towards)
    mass = np.array([[2.0, 0.0, 0.0], [0.0, 5.0, 0.5], [0.0, 0.5, 9.0]])
    return SimpleNamespace(loads=Loads(water), mass=mass, inverse=np.linalg.inv(mass), apex=np.array([8.0, 1.0]))


def test_axes_that_turn_have_their_inertia_unless_the_tests_hold_it():
    """(m_y v + m_yr r) r along and −m_x u r across; no moment, Munk's is in the coefficients"""
    u, v, r = 0.7, -0.4, 0.1
    pull = np.array([1.0, 2.0, 3.0])
    body = body_in(0.0, 0.0)
    across = 5 * v + 0.5 * r
    wanted = np.linalg.solve(body.mass, pull + [across * r, -2 * u * r, 0.0])
    assert accelerations(body, 0.3, (u, v, r), pull) == pytest.approx(wanted, rel=1e-12)
    assert accelerations(body_in(0.0, 0.0, True), 0.3, (u, v, r), pull) == pytest.approx(
        np.linalg.solve(body.mass, pull)
    )


def test_a_body_at_rest_moves_through_the_water_and_turns_about_where_it_is_held():
    """A current of 2 m/s towards 90°, heading 30°: u = −2 sin 30°, v = −2 cos 30°; the point (8, 1) stays in place"""
    body = body_in(2.0, math.pi / 2)
    state = at_rest_state(body, (3.0, 4.0), math.radians(30))
    assert state == pytest.approx([3, 4, math.radians(30), -1.0, -math.sqrt(3), 0.0])
    turned = turned_state(body, state, math.radians(60))

    def held(one):
        c, s = math.cos(one[2]), math.sin(one[2])
        return [one[0] + 8 * c - s, one[1] + 8 * s + c]

    assert held(turned) == pytest.approx(held(state)) and turned[2] == pytest.approx(math.pi / 2)
    assert turned[3:] == pytest.approx([-2.0, 0.0, 0.0], abs=1e-12)


def test_a_spline_round_the_circle_has_the_slopes_and_values_of_its_function():
    ring = Ring(np.stack([np.sin(3 * BETA), np.cos(BETA)], axis=1))
    for at in (-0.3, 0.01, 3.2, 6.28, 12.0):
        assert ring(at) == pytest.approx([math.sin(3 * at), math.cos(at)], abs=1e-7)
    places = np.array([-7.0, 0.5, 9.0])
    assert ring.along(places) == pytest.approx(np.stack([np.sin(3 * places), np.cos(places)], axis=1), abs=1e-7)
    assert ring.part(1)(0.7) == pytest.approx(math.cos(0.7), abs=1e-7)
    assert Ring(np.sin(3 * BETA - 0.1)).crests() == pytest.approx(
        (np.arange(6) + 0.5) * math.pi / 3 + 0.1 / 3, abs=1e-4
    )


def test_the_quartic_by_hand():
    """M 2, I 3, F 5, a 7, ℓ 11, Y_v −13, Y_r −17, Y_ψ 19, N_v −23, N_r −29, N_ψ 31: eq. after 3.6.18 term by term"""
    m = Lateral(2.0, 3.0, 5.0, 7.0, 11.0, -13.0, -17.0, 19.0, -23.0, -29.0, 31.0)
    A = 13 / 2 + 29 / 3
    B = (13 * 29 - 17 * 23) / 6 + 5 / 33 * (1.5 + 49 + 77) - 31 / 3
    C = 5 / 6 * (18 / 11 * (-23 + 91) - (-29 + 119) / 11) - (19 * -23 - 31 * -13) / 6
    D = 5 / 66 * (7 * 19 - 31)
    assert moored_quartic(m) == pytest.approx([1, A, B, C, D], rel=1e-12)
    assert straight_line(m, 0.5) == pytest.approx(13 * 29 + 23 * (-17 - 1.0))
    found = yaw_stability(m, 0.5, [5.0, 10.0])
    assert found.lever == pytest.approx(31 / 19) and found.static and found.straight_line == straight_line(m, 0.5)
    assert not yaw_stability(m._replace(arm=1.6), 0.5, [5.0, 10.0]).static
    assert math.isnan(yaw_stability(m._replace(Y_psi=0.0), 0.5, [5.0, 10.0]).lever)


def test_proportions_by_hand():
    """½ρL²d = 1000 · 100² · 5/2 of masses, L² of it of inertia; ½ρLdV² of forces, L of it of moments"""
    p = proportions(Lateral(5e7, 5e10, 1e6, 30.0, 60.0, 0, 0, 2e6, 0, 0, 4e7), 100.0, 5.0, 2.0, 1000.0)
    assert p == pytest.approx((5e7 / 2.5e7, 5e10 / 2.5e11, 0.6, 0.3, 1.0, 2.0, 0.4))


def test_what_the_roots_say():
    """The largest real part decides; 2π over its imaginary part"""
    found = slewing([-0.5, 0.01 + 0.2j, 0.01 - 0.2j, -0.3])
    assert (found.stable, found.growth, found.period) == (False, 0.01, pytest.approx(10 * math.pi))
    assert slewing([-0.5, -0.1]) == (True, -0.1, math.inf)


def test_a_line_that_just_does_not_lift_its_anchor():
    """S₀² = V (2T/w − V): V = 20 m, T = 50 kN, w = 1 kN/m: 1600 m²; at T = wV it hangs straight down"""
    assert float(length_without_uplift(5e4, 1e3, 20.0)) == pytest.approx(40.0)
    assert float(length_without_uplift(2e4, 1e3, 20.0)) == pytest.approx(20.0)
    with pytest.raises(ValueError, match=r"a tension of 1\.999e\+04 N cannot carry the weight of 20 m"):
        length_without_uplift(1.999e4, 1e3, 20.0)
    assert length_without_uplift([5e4, 2e4], 1e3, 20.0) == pytest.approx([40.0, 20.0])
    with pytest.raises(ValueError, match=r"a tension of 1\.9e\+04 N .* allowed: at least 2e\+04 N"):
        length_without_uplift([5e4, 1.9e4], 1e3, 20.0)


def test_significant_values_and_peaks_of_a_record():
    """Steady 3 and largest 9: 3 + ⅔ · 6 = 7, and back; tops of 2, 5, 4, 9, 3, 6 between upcrossings: 9 and 6"""
    assert significant(np.array([3.0, 9.0, 1.0]), 3.0) == pytest.approx(7.0) and peak(3.0, 7.0) == pytest.approx(9.0)
    record = np.array([-1.0, 2, -1, 5, -1, 4, -1, 9, -1, 3, -1, 6, -1, 2, -30.0])
    record = record - record.mean()
    level = np.array([-1.0, 2, -1, 5, -1, 4, -1, 9, -1, 3, -1, 6, -1, 2, -30.0]).mean()
    assert highest_third(record + level) == pytest.approx(7.5)
    assert highest_third(np.array([0.0, 1.0, 0.0])) == 1.0


def test_waves_grow_over_two_periods_and_are_read_between_headings():
    omega = 0.5
    T = 2 * math.pi / omega
    assert share_of_height(np.array([4.9, 5.0, 5.0 + T, 5.0 + 2 * T, 99.0]), 5.0, omega) == pytest.approx(
        [0, 0, 0.5, 1, 1]
    )
    assert headings()[1] == pytest.approx(2 * math.pi / RING)
    ring = np.stack([np.arange(RING, dtype=float), 2.0 * np.arange(RING)], axis=1)
    step = 2 * math.pi / RING
    assert at_heading(ring, np.array([2.25 * step, -0.5 * step])) == pytest.approx(
        np.array([[2.25, 4.5], [35.5, 71.0]])
    )
    each = np.stack([ring, 10 * ring])
    assert at_heading(each, np.array([0.5 * step, 3.0 * step])) == pytest.approx(np.array([[0.5, 1.0], [30.0, 60.0]]))
    w, a = np.array([0.9, 0.3, 0.6]), np.array([10.0, 0.2, 0.4])
    assert mean_frequency(w, a) == pytest.approx((90 + 0.3 * 0.04 + 0.6 * 0.16) / 100.2)
    assert split_frequency(w, a) == 0.6  # 0.04 below, 0.2 with the next, of 100.2: a thousandth is 0.1


def test_mean_drift_of_a_sea_at_each_heading_and_on_a_current():
    """2 ∫ S D dω, m₀ = 0.1 m²; on a current D + B V at the waves' own frequency: deep water, D = 100 ω cos β along x"""
    ring = np.arange(HEADINGS) * (2 * math.pi / HEADINGS)
    omega = np.linspace(0.5, 0.9, 81)
    drift = np.zeros((81, HEADINGS, 3))
    drift[:, :, 0] = 100 * omega[:, None] * np.cos(ring)
    forces = WaveForces(omega, np.zeros((81, HEADINGS, 12)), drift)
    spectrum = tabulated([0.69, 0.7, 0.71], [0.0, 10.0, 0.0])
    found = mean_drift(forces, Sea(spectrum, math.radians(60), WrappedNormal(0.05)))
    i = HEADINGS // 12  # a heading of 30°
    spread = math.exp(-0.5 * 0.05**2)
    assert found[0, 0] == pytest.approx(2 * 0.1 * 70 * 0.5 * spread, rel=2e-3)
    assert found[i, 0] == pytest.approx(2 * 0.1 * 70 * math.cos(math.radians(30)) * spread, rel=2e-3)
    carrier = Carrier((0.6, 0.0))
    along = mean_drift(forces, Sea(spectrum, 0.0, WrappedNormal(0.05)), carrier)[0, 0]
    still = mean_drift(forces, Sea(spectrum, 0.0, WrappedNormal(0.05)))[0, 0]
    assert along - still == pytest.approx(0.6 * 2 * 0.1 * 5 * 100 * 0.49 / 9.80665, rel=1e-2)  # 4ω/g D + ω²/g D'


def test_a_cycle_is_read_off_the_end_of_a_record():
    """A slow swing of 20 s that grows; half of its range, the ratio of both halves, the time between upward zeros"""
    t = np.arange(0.0, 400.0, 0.25)
    found = cycle(t, 1.0 + 0.2 * np.sin(2 * math.pi * t / 20))
    assert (found.amplitude, found.period, found.growing) == pytest.approx((0.2, 20.0, 1.0), rel=2e-3) and found.stays
    dying = cycle(t, np.exp(-t / 40) * np.sin(2 * math.pi * t / 20))
    assert dying.growing < 1 and not dying.stays
    assert math.isnan(cycle(t, 0.01 * t).period) and not cycle(t, 0.01 * t).stays


def test_deviations_in_waves_are_along_and_across_the_hull():
    """A hull at 90° that moves along y of space surges; before the start nothing counts"""
    wave = np.zeros((6, 6))
    wave[:, 1], wave[:, 5] = [99, 1, -1, 1, -1, 0], [99, 0.5, -0.5, 0.5, -0.5, 0]
    record = SimpleNamespace(time=np.arange(6.0), wave=wave, heading=np.full(6, math.pi / 2))
    found = wave_deviations(record, 1.0)
    assert found == pytest.approx([math.sqrt(0.8), 0, 0, 0, 0, 0.5 * math.sqrt(0.8)], abs=1e-12)
    assert np.isnan(wave_deviations(record, 9.0)).all()


def test_a_heading_has_settled_after_it_was_last_away():
    t, x = np.arange(5.0), np.array([1.0, 0.0, 0.5, 0.0, 0.0])
    assert settled_after(t, x, 0.0) == 3.0 and settled_after(t, 0 * x, 0.0) == 0.0
    assert math.isnan(settled_after(t, x[::-1], 0.0))
    assert watch_circle(np.array([[3.0, 4.0], [1.0, 1.0]]), np.array([0.0, 0.0])) == pytest.approx(5.0)


def test_a_contact_buoy_is_at_the_bow_and_pulled_by_its_moorings():
    """Bow 50 m ahead and 2 m to port of the centre, which is at (10, 20) and moves by (3, 4); heading 90° − 36.87°"""
    heading = math.atan2(0.8, 0.6)
    motion = np.zeros((2, 6))
    motion[1, :2], motion[1, 5] = (3.0, 4.0), heading
    point = SimpleNamespace(
        ends=np.array([[50.0, 2.0]]), pull=lambda at: SimpleNamespace(force=(0.6 * at[0], 0.8 * at[0]))
    )
    tension = np.arange(4.0).reshape(2, 2)
    at, pull, kept = of_contact(point, SimpleNamespace(motion=motion, tension=tension), np.array([10.0, 20.0]))
    assert at == pytest.approx(np.array([[60.0, 22.0], [13 + 30 - 1.6, 24 + 40 + 1.2]]))
    assert pull == pytest.approx(at[:, :1])
    assert kept is tension


def test_components_of_a_sea_lie_between_the_stored_frequencies_and_no_more_than_a_twentieth_is_left_out(monkeypatch):
    """All energy between 0.5 and 1.0 rad/s, evenly: 4 % is beyond 0.98, 6 % beyond 0.97"""
    kept = []
    spectrum = SimpleNamespace(
        quantile=lambda shares: 0.5 + 0.5 * np.array(shares),
        moment=lambda n, a=0.0, b=np.inf: np.diff(np.clip([a, b], 0.5, 1.0))[0],
    )
    sea = SimpleNamespace(spectrum=spectrum, components=lambda *given, **words: kept.append((given, words)) or "waves")
    monkeypatch.setattr(runs, "in_water", lambda *given: given)
    reader = SimpleNamespace(omega=np.array([0.3, 0.6, 0.98]), depth=20.0)
    assert runs.sea_components(sea, 7, 3, reader, "current", 9.8) == ("waves", "current", 20.0, 9.8)
    assert kept == [((7, 3), {"low": pytest.approx(0.5, abs=1e-4), "high": 0.98})]
    for ends, band in (([0.3, 0.97], "0.3 to 0.975"), ([0.53, 2.0], "0.525 to 2")):  # beyond 0.975 lie 5 %, no more
        with pytest.raises(ValueError, match=f"^6 % of the waves' energy .* 5 %; solve {band} rad/s as well"):
            runs.sea_components(sea, 7, 3, SimpleNamespace(omega=np.array(ends), depth=20.0))


@pytest.mark.parametrize("wind, gusts, wanted", [
    (None, None, [0.0, 0.0]), (20.0, None, [20.0, 20.0]), (20.0, lambda t: 20.0 + t, [20.0, 25.0]),
])  # fmt: skip
def test_a_record_of_slow_motion_has_its_wind_and_what_holds_the_body(wind, gusts, wanted):
    """Each hold is sought from where the buoy was before"""
    seen = []

    def hold(place, heading, near):
        seen.append(near)
        return SimpleNamespace(buoy=place + 1.0, tension=np.array([10 * heading]))

    of_wind = None if wind is None else SimpleNamespace(speed=wind)
    point = SimpleNamespace(hold=hold, ends=np.zeros((1, 2)), loads=SimpleNamespace(wind=of_wind))
    states = np.array([[1.0, 2.0, 0.3, 4.0, 5.0, 6.0], [7.0, 8.0, 0.9, 10.0, 11.0, 12.0]])
    record = slow_record(point, np.array([0.0, 5.0]), states, gusts)
    assert record.wind_speed.tolist() == wanted and record.time.tolist() == [0.0, 5.0]
    assert record.place.tolist() == [[1, 2], [7, 8]] and record.heading.tolist() == [0.3, 0.9]
    assert record.buoy.tolist() == [[2, 3], [8, 9]] and record.hawser[:, 0] == pytest.approx([3.0, 9.0])
    assert seen[0] is None and seen[1].tolist() == [2.0, 3.0]


def test_hawsers_that_are_slack_hold_nothing():
    """Where both have fallen slack no lines are asked for their stiffness"""
    slack = Hold(np.zeros(3), np.zeros(2), np.zeros(2))
    assert np.array_equal(SinglePoint.stiffness(None, 0.3, slack), np.zeros((3, 3)))


@pytest.mark.parametrize("taut, which", [(25.0, 0), (40.0, 1)])
def test_of_two_unequal_hawsers_the_one_in_hand_reaches_to_its_own_length_and_the_other_to_that_of_its(taut, which):
    """Bow ends at (50, ±6), hawsers of 25 and 40 m, a buoy at rest at (100, 0) that yields freely: it lies where the
    taut hawser ends, in line with its rest"""
    ends, lengths = np.array([[50.0, 6.0], [50.0, -6.0]]), np.array([25.0, 40.0])
    asked = []

    def on_circle(bow, length, near):
        asked.append((bow.tolist(), length, near))
        return np.array([bow[0] + length, bow[1]]), (3.0, 4.0)

    point = SimpleNamespace(ends=ends, lengths=lengths, origin=np.array([100.0, 0.0]), _on_circle=on_circle)
    beyond, held = SinglePoint._one(point, np.zeros(2), np.eye(2), which, "near")
    assert asked == [(ends[which].tolist(), taut, "near")]
    x = 50.0 + taut
    assert held.buoy == pytest.approx([x, ends[which, 1]])
    assert held.tension == pytest.approx(5.0 * np.eye(2)[which])
    assert held.force == pytest.approx([3.0, 4.0, 50.0 * 4.0 - ends[which, 1] * 3.0])
    assert beyond == pytest.approx(max(0.0, math.hypot(taut, 12.0) - lengths[1 - which]))
    point.origin = np.array([80.0, 0.0])  # 30.6 m from both ends: beyond the shorter one, within the longer
    beyond, held = SinglePoint._one(point, np.zeros(2), np.eye(2), which, None)
    assert (len(asked) == 2) == (which == 0) and (held.tension.max() > 0) == (which == 0)
    if which == 1:
        assert beyond == pytest.approx(math.hypot(30.0, 6.0) - 25.0) and np.all(held.buoy == point.origin)


@pytest.mark.parametrize("count, before", [(400, 75), (60, 59)])
def test_a_record_goes_on_for_three_periods_of_the_split_turned_about_its_ends(count, before):
    """0.5 rad/s in steps of 0.5 s: 3 · 2π/0.25 = 75.4 samples, or all that there are"""
    record = np.random.default_rng(5).normal(size=(count, 2)).cumsum(axis=0)
    head, tail = 2 * record[0] - record[before:0:-1], 2 * record[-1] - record[-2 : -2 - before : -1]
    sections = signal.butter(8, 0.25 / math.pi, output="sos")
    whole = signal.sosfiltfilt(sections, np.concatenate([head, record, tail]), axis=0, padlen=0)
    assert slow_part(record, 0.5, 0.5) == pytest.approx(whole[before:-before], abs=1e-8)
