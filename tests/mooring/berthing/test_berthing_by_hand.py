"""Berthing energy factor by factor, a ship on a spring and its time, speeds, and the field's comparison, by hand."""

import math

import numpy as np
import pytest

from hakobune.mooring.berthing import energy
from hakobune.mooring.berthing.energy import BerthingError
from hakobune.mooring.berthing.field import Contact, compared
from hakobune.mooring.berthing.memory import BerthingShip, berth, without_memory
from hakobune.mooring.berthing.speeds import Speeds, speeds_of_moments
from hakobune.mooring.berthing.two_springs import TwoSprings
from hakobune.mooring.fenders.fender import FenderError, fender_of_points

SHIP = energy.Ship(200.0, 32.0, 10.0, 4.5e7, 50.0, 1025.0)
NONE = np.zeros((2, 2))


def spring(k, end=2.0):
    return fender_of_points("spring", 1.0, [0.0, end], [0.0, k * end])


@pytest.mark.parametrize("depth, told", [
    (10.001, "the water under the keel is 0.001 m, 0.01 % of the draft; limit 10 %"),
                                         (10.99, "is 0.99 m"), (11.0, ""), (None, "")])  # fmt: skip
def test_a_ship_nearly_aground_is_told(depth, told):
    said = list(energy.shallow(SHIP, depth))
    assert len(said) == bool(told) and all(told in line for line in said)


def test_energy_is_half_of_six_factors():
    """½ · 1.6 · 4.5e7 kg · (0.15 m/s)² · 0.5 · 0.9 · 0.8"""
    found = energy.berthing_energy(SHIP, 0.15, 1.6, 0.5, 0.9, 0.8)
    assert found == pytest.approx(0.5 * 1.6 * 4.5e7 * 0.0225 * 0.5 * 0.9 * 0.8, rel=1e-12)
    assert energy.berthing_energy(SHIP, 0.15, 1.6, 0.5) == pytest.approx(found / 0.72, rel=1e-12)


def test_a_share_that_does_not_turn_the_ship_has_its_offset():
    """K = 50 m, R = 30 m: K²/(K² + R²)"""
    assert energy.offset_of(1 / (1 + 0.36), 50.0) == pytest.approx(30.0, rel=1e-12)


def test_a_ship_of_mass_or_of_block_coefficient():
    """C_B = m/(ρ L B d); a quarter of the length is the radius of gyration that is not given"""
    made = energy.ship(200.0, 32.0, 10.0, block=0.7)
    assert (made.mass, made.gyration) == pytest.approx((0.7 * 1025 * 64_000, 50.0))
    assert energy.ship(200.0, 32.0, 10.0, mass=4.5e7, gyration=44.0).block == pytest.approx(4.5e7 / (1025 * 64_000))
    assert energy.ship(200.0, 32.0, 10.0, mass=4.5e7, gyration=44.0).gyration == 44.0
    fresh = energy.ship(200.0, 32.0, 10.0, block=0.7, density=1000.0)
    assert fresh.mass == pytest.approx(4.48e7) and fresh.density == 1000.0


def test_keel_clearance_of_the_guideline_is_a_straight_line_between_its_ends():
    """1.8 to 0.1 d, 1.5 from 0.5 d on; at 0.2 d a quarter of the way"""
    found = [energy.virtual_mass_pianc(SHIP, 10.0 * (1 + share)) for share in (0.1, 0.2, 0.4, 0.5, 0.51)]
    assert found == pytest.approx([1.8, 1.725, 1.575, 1.5, 1.5], rel=1e-12)


def test_a_ship_on_one_spring_is_half_a_swing_in_contact():
    """M ẍ = −k x: δ = V/ω sin ωt; the default duration is three halves of a half period, C_M is 1 + a/M"""
    M, a, k, V = 4.5e7, 3e7, 6e6, 0.12
    ship = without_memory(M, 50.0, np.diag([a, 0.0]))
    made = berth(ship, [(spring(k), 0.0, 0.0)], V, steps=600)
    omega = math.sqrt(k / (M + a))
    assert made.time[-1] == pytest.approx(1.5 * math.pi / omega, rel=1e-9)
    inside = made.time < math.pi / omega - 0.1
    assert made.deflection[inside, 0] == pytest.approx(V / omega * np.sin(omega * made.time[inside]), rel=1e-6)
    assert made.reaction.max() == pytest.approx(V * math.sqrt(k * (M + a)), rel=1e-5)
    assert made.energy == pytest.approx(0.5 * (M + a) * V**2, rel=1e-5)
    assert made.virtual_mass == pytest.approx((M + a) / M, rel=1e-5)
    assert made.velocity[-1, 0] == pytest.approx(-V, rel=1e-4) and made.position[-1, 0] < 0


def test_the_softest_fender_decides_how_long_a_berthing_is_followed():
    """2 E/δ² of its rated energy: of k and 4 k that of k"""
    ship = without_memory(4.5e7, 50.0, NONE)
    made = berth(ship, [(spring(2.4e7), 10.0, 0.0), (spring(6e6), -10.0, 0.0)], 0.1, steps=50)
    assert made.time[-1] == pytest.approx(1.5 * math.pi * math.sqrt(4.5e7 / 6e6), rel=1e-9)


@pytest.mark.parametrize("center", [0.0, 8.0])
def test_a_contact_off_the_centre_of_gravity_keeps_the_share_of_its_eccentricity(center):
    """A stiff fender at x stops its own point: E = ½ M V² r²/(r² + l²), l from the centre of gravity, C_M = 1"""
    M, r, x = 4.5e7, 50.0, 35.0
    inertia = M * np.array([[1.0, center], [center, r**2 + center**2]])
    none = np.zeros((0, 0))
    ship = BerthingShip(inertia, NONE, none, np.zeros((0, 2)), np.zeros((2, 0)), none, np.zeros((0, 0)), center)
    made = berth(ship, [(spring(5e7), x, 0.0)], 0.15, steps=3000)
    kept = r**2 / (r**2 + (x - center) ** 2)
    assert made.energy == pytest.approx(0.5 * M * 0.15**2 * kept, rel=1e-4)
    assert made.virtual_mass == pytest.approx(1.0, rel=1e-4) and made.ledger < 1e-5


def test_a_ship_that_turns_meets_the_fender_with_the_speed_of_its_point():
    """V + x r at the fender; the ship's energy is ½ M V² + ½ M k² r², of which the point's share is taken"""
    M, k, x, V, r = 4.5e7, 50.0, 40.0, 0.1, 0.001
    made = berth(without_memory(M, k, NONE), [(spring(5e7), x, 0.0)], V, steps=3000, yaw_rate=r)
    point = V + x * r
    assert made.energy == pytest.approx(0.5 * M * point**2 * k**2 / (k**2 + x**2), rel=1e-4)
    assert made.virtual_mass == pytest.approx(1.0, rel=1e-4)
    assert made.velocity[0] == pytest.approx([V, r])


def test_a_second_fender_is_met_after_its_gap():
    """Deflections are those of points of the ship, less the gap, counted from the first contact"""
    made = berth(without_memory(4.5e7, 50.0, NONE), [(spring(6e6), 0.0, 0.3), (spring(6e6), 0.0, 0.4)], 0.15, steps=800)
    first, second = made.deflection.T
    assert made.position[:, 0] == pytest.approx(np.where(first > 0, first, made.position[:, 0]), abs=1e-12)
    both = second > 0
    assert both.any() and second[both] == pytest.approx(first[both] - 0.1, abs=1e-12)


def test_speeds_by_hand():
    """Exponential for m = 1: mean and deviation η, once in 1000 contacts η ln 1000; of m = 2 the square"""
    assert (Speeds(0.05, 1.0).mean, Speeds(0.05, 1.0).deviation) == pytest.approx((0.05, 0.05))
    assert Speeds(0.05, 1.0).speed_of(1000) == pytest.approx(0.05 * math.log(1000))
    assert Speeds(0.05, 2.0).deviation == pytest.approx(0.05 * math.sqrt(1 - math.pi / 4))
    assert Speeds(0.05, 2.0).exceeded(0.1) == pytest.approx(math.exp(-4)) and Speeds(0.05, 2.0).exceeded(-0.1) == 1.0
    one = speeds_of_moments(0.05, 0.05)
    assert one == pytest.approx((0.05, 1.0), rel=1e-9)


def test_the_closed_form_has_its_times_by_hand():
    """K₁ = 3, K₂ = 6, K_d = 2 MN/m, m = 2e8 kg: β = 0.1; V = 0.2: 4 MN at most; a plateau of 2 MN is reached at 30°"""
    plain, flat = TwoSprings(2e8, 0.2, 3e6, 6e6), TwoSprings(2e8, 0.2, 3e6, 6e6, 2e6)
    assert (plain.stiffness, plain.beta) == pytest.approx((2e6, 0.1))
    assert plain.rest_time == pytest.approx(5 * math.pi) and plain.plateau_time == math.inf
    assert plain.reaction == pytest.approx(4e6) and flat.reaction == 2e6
    assert plain.deflections(5 * math.pi) == pytest.approx((4 / 3, 2 / 3))
    assert flat.plateau_time == pytest.approx(10 * math.pi / 6)
    assert flat.rest_time == pytest.approx(10 * math.pi / 6 + 2e8 * 0.2 * math.cos(math.pi / 6) / 2e6)
    y1, y2 = flat.deflections(flat.plateau_time + 2.0)
    assert y1 == pytest.approx(2 / 3)
    assert y2 == pytest.approx(1 / 3 + 0.2 * math.cos(math.pi / 6) * 2.0 - 0.5 * 2e6 / 2e8 * 4.0)
    assert plain.kinetic == pytest.approx(4e6)


def test_the_field_is_compared_by_quartiles_and_by_what_a_centimetre_allows():
    """Four contacts of one ship amidships, 10 cm/s, with 0.9, 1.0, 1.1 and 1.3 of the energy by Ueda's method

    Between V and V + 1 cm/s lie ratios of 1 to 1.21: of 1.05 and 1.1, half of them; doubtful ones do not count
    """
    one = Contact("T", 1, 100.0, 250.0, 40.0, 15.0, 10.0, 60.0, 0.0, 1.0, 150.0, 1.0, 1.0, ())
    ship = energy.Ship(250.0, 40.0, 15.0, 1e8, 60.0, 1030.0)
    mass = 1 + math.pi / 2 * 1030 * 225 * 250 / 1e8
    whole = 0.5 * mass * ship.mass * 0.01 / 9800
    table = [one._replace(absorbed=ratio * whole) for ratio in (0.9, 1.05, 1.1, 1.3)]
    found = compared(
        "Ueda 1981", [*table, one._replace(absorbed=9 * whole, doubt=("speed",)), one._replace(absorbed=0.0)]
    )
    assert found == pytest.approx((4, 1.075, 1.0125, 1.15, 0.5), rel=1e-9)


@pytest.mark.parametrize(
    "make, good, bad, says",
    [
        (lambda v: energy.ship(200, 32, 10, block=v), 0.1, 0.099, "block coefficient is 0.099"),
        (lambda v: energy.ship(200, 32, 10, block=v), 1.0, 1.01, "block coefficient is 1.01"),
        (lambda v: energy.ship(200, 32, 10, block=0.7, mass=v), None, 4e7, "both are given"),
        (lambda v: energy.ship(200, 32, 10, block=0.7, gyration=v), 1.0, 0.0, "gyration is 0"),
        (lambda v: energy.ship(v, 32, 10, block=0.7), 200.0, -200.0, "length is -200; allowed: above 0"),
        (lambda v: energy.ship(200, v, 10, block=0.7), 32.0, 0.0, "beam is 0; allowed: above 0"),
        (lambda v: energy.ship(200, 32, v, block=0.7), 10.0, math.inf, "draft is inf; allowed: above 0"),
        (lambda v: energy.ship(200, 32, 10, block=0.7, density=v), 1000.0, -1.0, "density is -1; allowed: above 0"),
        (lambda v: energy.virtual_masses(SHIP, v), 10.01, 10.0, "depth is 10 m with a draft of 10 m"),
        (lambda v: energy.offset_of(v, 50.0), 1.0, 1.01, "eccentricity coefficient is 1.01"),
        (lambda v: energy.offset_of(v, 50.0), 0.01, 0.0, "eccentricity coefficient is 0"),
        (lambda v: energy.berthing_energy(SHIP, 0.1, 1.5, v), 1.0, 1.01, "coefficient of eccentricity is 1.01"),
        (lambda v: energy.berthing_energy(SHIP, 0.1, 1.5, 0.5, v), 1.0, 0.0, "coefficient of softness is 0"),
        (lambda v: energy.berthing_energy(SHIP, 0.1, 1.5, 0.5, 1, v), 1.0, 1.01, "coefficient of configuration"),
        (lambda v: energy.berthing_energy(SHIP, 0.1, v, 0.5), 1.0, 0.99, "virtual mass is 0.99; allowed: at least 1"),
        (lambda v: energy.berthing_energy(SHIP, v, 1.5, 0.5), 0.01, math.inf, "speed of the berthing is inf"),
        (lambda v: Speeds(0.1, 1.0).speed_of(v), 1.01, 1.0, "once in 1 contacts is requested; allowed: above 1"),
        (lambda v: speeds_of_moments(v, 0.1), 0.1, 0.0, "mean of the speeds is 0"),
        (lambda v: speeds_of_moments(1.0, v), 0.0128, 0.0126, "deviation of the speeds over their mean is 0.0126"),
        (lambda v: speeds_of_moments(1.0, v), 15.8, 16.0, "deviation of the speeds over their mean is 16"),
        (lambda v: TwoSprings(1e8, 0.1, v, 1e7), math.inf, 0.0, "dolphin of the two springs is 0"),
        (lambda v: berth(without_memory(1e8, 50.0, NONE), [(spring(1e8), 0, 0)], v, steps=9), 0.1, 0.0, "speed of the"),
    ],
)  # fmt: skip
def test_a_berthing_is_made_up_to_its_limits_and_refused_beyond(make, good, bad, says):
    make(good)
    with pytest.raises(BerthingError) as refused:
        make(bad)
    assert says in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize("first, second, told", [(1.0, 1.0, None), (0.3, 1.0, "a"), (1.0, 0.3, "b")])
def test_each_fender_is_held_to_the_end_of_its_table(first, second, told):
    """Both are pressed by V √(M/2k) = 0.41 m"""
    fenders = [fender_of_points(name, 1.0, [0.0, end], [0.0, 3e6 * end]) for name, end in (("a", first), ("b", second))]
    pressed = [(one, x, 0.0) for one, x in zip(fenders, (10.0, -10.0), strict=True)]
    ship = without_memory(4.5e7, 50.0, NONE)
    if told is None:
        made = berth(ship, pressed, 0.15, steps=200)
        assert made.deflection.max(axis=0) == pytest.approx(0.15 * math.sqrt(4.5e7 / 6e6), rel=1e-3)
        assert made.energy == pytest.approx(0.5 * 4.5e7 * 0.15**2, rel=1e-4) and made.ledger < 1e-5
    else:
        with pytest.raises(FenderError, match=told):
            berth(ship, pressed, 0.15, steps=200)
