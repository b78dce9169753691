"""Forces of a passing ship: theory by slender bodies, tests in tanks, and panels, held to others' numbers and laws."""

import math

import numpy as np
import pytest

from hakobune.meshing.panels import structured
from hakobune.meshing.shapes import box
from hakobune.mooring.passing.by_tests import QUAY, beyond, depth_factors, kriebel, scale
from hakobune.mooring.passing.double_body import double_body, largest_section
from hakobune.mooring.passing.passage import Passage, Track, along_track
from hakobune.mooring.passing.slender import Slender, wang

FOOT, POUND, SLUG = 0.3048, 4.4482216, 515.37882  # m, N, kg/m³
TANKER, COASTER = Slender(243.5, 39.0 * 15.3 * 0.98), Slender(185.4, 25.8 * 6.8 * 0.98)
KINDS = [0, 1, 5]


def test_sway_abeam_is_that_of_a_worked_example():
    """Ships of 950 and 475 ft, sections of 3192 and 6413 ft², 190 ft apart in 95 ft at 11.2 ft/s: 76 440 lbf of sway
    abeam, no surge and no yaw, in a public worksheet of Wang's theory, whose sum of images is cut off"""
    ships = Slender(950 * FOOT, 3192 * FOOT**2), Slender(475 * FOOT, 6413 * FOOT**2)
    track = Track(190 * FOOT, 11.2 * FOOT)
    found = wang(*ships, track, [0.0], 95 * FOOT, 1.9905 * SLUG).force[0]
    assert found[1] / POUND == pytest.approx(76440, rel=1e-3)
    assert np.abs(found[[0, 5]]).max() < 1e-9 * found[1]


@pytest.mark.parametrize(
    ("distance", "share", "peaks"), [(0.1, 1.0, (4.73, 24.9, 5.33)), (0.2, 2.0, (5.25, 15.6, 3.295))]
)
def test_peaks_in_deep_water_are_those_of_the_published_curves(distance, share, peaks):
    """Read off Wang's figures to 2 % (yaw 5 %): over ρU²S₁S₂/L₂², and times L₁, as public worksheets tabulate them"""
    ships, track = (Slender(1.0, 1.0), Slender(share, 1.0)), Track(distance, 1.0)
    found = wang(*ships, track, along_track(track, 1.0, share, 1.0), density=1.0).force[:, KINDS]
    assert np.abs(found).max(axis=0) * share**2 == pytest.approx(peaks, rel=0.05)
    assert np.abs(found[:, 1]).max() * share**2 == pytest.approx(peaks[1], rel=0.02)


def test_images_in_the_bed_are_the_same_by_either_sum():
    """Poisson's sum in shallow water, image by image in deeper: equal where one gives way to the other"""
    track, ships = Track(40.0, 3.0), (Slender(100.0, 200.0), Slender(80.0, 150.0))
    at = math.pi * 40.0  # m of depth, abeam
    below, above = (wang(*ships, track, [0.0], at * (1 + side), 1025.0).force[0, 1] for side in (-1e-9, 1e-9))
    assert below == pytest.approx(above, rel=1e-7)
    deep = [wang(*ships, track, [25.0], depth).force[0, KINDS] for depth in (4000.0, math.inf)]
    assert deep[0] == pytest.approx(deep[1], rel=1e-4)


def test_sway_that_changes_in_time_has_no_impulse():
    """It is d/dt of a momentum that is zero before and after the passage"""
    track = Track(50.0, 4.0)
    found = wang(Slender(100.0, 200.0), Slender(120.0, 300.0), track, np.linspace(-4e3, 4e3, 401))
    peak = np.abs(found.force[:, 1]).max()
    impulse = np.trapezoid(found.in_time.force[:, 1], found.in_time.times)
    assert abs(impulse) < 1e-6 * peak * found.in_time.times[-1]


def test_largest_forces_at_an_open_jetty_are_those_of_a_worked_example():
    """Kriebel (2005): a ship of 243.5 m, one of 185.4 m at 10 knots 110 m off, in 20 m: 389.3 kN, 1274.4 kN and
    40 010 kN m with the coefficients 0.299, 1.064, 0.204 read off Wang's curves (worksheet of a public program)"""
    track = Track(110.0, 10 * 0.5144)
    factors = depth_factors(15.3, 20.0, 110.0 - 0.5 * (39.0 + 25.8), 0.5 * (39.0 + 25.8))
    assert factors == pytest.approx([16.4120894, 15.0980661, 10.1531211], rel=1e-8)
    assert scale(TANKER, COASTER, track)[:2] == pytest.approx(79331.0374, rel=1e-8)
    places = along_track(track, 243.5, 185.4, 2.0, 4)
    found = kriebel(TANKER, COASTER, track, places, factors, peaks=(0.299, 1.064, 0.204)).force
    assert np.abs(found[:, KINDS]).max(axis=0) == pytest.approx([389294.4348, 1274400.9411, 40010302.24], rel=1e-8)


def test_largest_forces_at_a_vertical_quay_are_those_of_a_worked_example():
    """Two ships of 360 × 48.2 × 13.6 m, 248.2 m apart in 21.1 m, 7.8 knots, 0.48, 1.55, 0.25: 383.6 kN, 219.7 kN,
    11 673 kN m (Swiegers 2011 on Kriebel 2005, the same worksheet)"""
    ship, track = Slender(360.0, 48.2 * 13.6 * 0.972), Track(248.2, 7.8 * 0.5144)
    factors = depth_factors(13.6, 21.1, 200.0, 48.2)
    places = along_track(track, 360.0, 360.0, 2.0, 2)
    found = kriebel(ship, ship, track, places, factors, quay=True, peaks=(0.48, 1.55, 0.25)).force
    assert np.abs(found[:, KINDS]).max(axis=0) == pytest.approx([383646.166, 219708.935, 11672968.29], rel=1e-8)
    without = kriebel(ship, ship, track, places, factors, peaks=(0.48, 1.55, 0.25)).force
    assert found[:, KINDS] == pytest.approx(without[:, KINDS] * QUAY)


def hemisphere(radius, along, around):
    u, turn = np.cos(np.linspace(0, math.pi, along + 1)), np.linspace(-math.pi / 2, math.pi / 2, around + 1)
    r = np.sqrt(1 - u**2)[:, None]
    points = np.stack([-u[:, None] * np.ones(around + 1), r * np.sin(turn), -r * np.cos(turn)], axis=-1)
    return structured(radius * points[::-1])


def test_force_between_hemispheres_is_that_of_their_dipoles():
    """Lamb, art. 138, of two spheres a long way apart, half of it under a lid: a_ms = −(πρ/2) a³b³ (3 r̂r̂ − 1)/c³ and
    a_ss = (πρ/3) a³ (1 + 3 a³b³ (cos² + ¼ sin²)/c⁶); forces are −U² ∂a_ms/∂ξ and ½ U² of −∂a_ss/∂ξ, −∂a_ss/∂η"""
    hull, speed, away, rho = hemisphere(1.0, 8, 8), 2.0, 8.0, 1000.0
    size = hull.volume / (2 * math.pi / 3)  # m³, a³ of the sphere with the volume of the panels
    track = Track(away, speed)
    places = np.linspace(-16.0, 16.0, 17)
    found = double_body((hull, hull), track, places, math.inf, density=rho)
    dipoles = math.pi * rho / 2 * size**2

    def coupled(x):
        c2 = x**2 + away**2
        return -dipoles * np.array([3 * x**2 / c2 - 1, 3 * x * away / c2]) / c2**1.5

    d = 1e-4
    for k in range(10, len(found.stagger) - 10, 10):
        x = found.stagger[k]
        wanted = -(speed**2) * (coupled(x + d) - coupled(x - d)) / (2 * d)
        assert found.changing[k, :2] == pytest.approx(wanted, abs=0.03 * 3 * dipoles * speed**2 / away**4)

    def energy(x, y):
        c2 = x**2 + y**2
        return math.pi * rho * size**3 * (x**2 + 0.25 * y**2) / c2**4

    k, x = int(np.argmin(np.abs(found.stagger - 4.0))), 4.0
    wanted = -0.5 * speed**2 * np.array(
        [energy(x + d, away) - energy(x - d, away), energy(x, away + d) - energy(x, away - d)]
    ) / (2 * d)  # fmt: skip
    assert found.steady[k, :2] == pytest.approx(wanted, rel=0.2)  # next in (a/c)²


def test_moments_about_another_place_are_by_lever():
    """Of 2 N of surge and 3 N of sway 4 m ahead of, 5 m to port of and 6 m above the place, by hand"""
    force = np.array([[2.0, 3.0, 0, 0, 0, 7.0]])
    found = Passage(Track(40.0, 3.0), np.zeros(1), force, 0 * force).about([-4.0, -5.0, -6.0]).force
    assert found[0] == pytest.approx([2, 3, 0, -18, 12, 7 + 4 * 3 - 5 * 2])


def test_the_end_that_is_nearer_to_the_passing_ship_is_drawn_to_it():
    """Squares of the flow: the bow of a long body towards a hemisphere off the bow, the stern to one off the stern"""
    hulls, track = (box(8.0, 1.0, 0.5, panels=40).whole(), hemisphere(0.7, 4, 4)), Track(2.5, 1.0)
    found = double_body(hulls, track, np.linspace(-6.0, 6.0, 9), math.inf)
    at = [int(np.argmin(np.abs(found.stagger - x))) for x in (3.0, -3.0)]
    assert found.steady[at[0], 5] > 0 > found.steady[at[1], 5]
    assert found.steady[at, 1].min() > 0


def test_a_mirrored_passage_gives_mirrored_forces():
    """To starboard sway and yaw change sign; on the opposite course time runs the other way along the track"""
    ships = Slender(100.0, 200.0), Slender(80.0, 150.0)
    places = np.linspace(-200.0, 200.0, 41)
    port, starboard = (wang(*ships, Track(side * 40.0, 3.0), places, 12.0).force for side in (1, -1))
    assert starboard == pytest.approx(port * (1, -1, 1, 1, 1, -1))
    back = wang(*ships, Track(40.0, 3.0, opposite=True), places, 12.0)
    assert back.in_time.force == pytest.approx(port[::-1])
    assert back.in_time.times[-1] == pytest.approx(400.0 / 3.0)


def test_forces_go_with_the_square_of_the_speed_through_the_water():
    ships, places = (Slender(100.0, 200.0), Slender(80.0, 150.0)), [10.0]
    against = wang(*ships, Track(40.0, 3.0, current=-1.0), places).force
    assert against == pytest.approx(wang(*ships, Track(40.0, 4.0), places).force)
    with_it = wang(*ships, Track(40.0, 3.0, opposite=True, current=-1.0), places).force
    assert with_it == pytest.approx(wang(*ships, Track(40.0, 2.0), places).force)


def test_what_lies_beyond_the_curves_is_told():
    assert not list(beyond(TANKER, COASTER, Track(110.0, 5.0)))
    assert "0.0411" in next(beyond(TANKER, COASTER, Track(10.0, 5.0)))
    assert "0.41" in next(beyond(TANKER, Slender(100.0, 50.0), Track(110.0, 5.0)))


@pytest.mark.parametrize("change", [{"distance": 0.0}, {"speed": 0.0}, {"current": 3.0}, {"distance": math.nan}])
def test_a_track_that_is_none_is_refused(change):
    with pytest.raises(ValueError, match="allowed"):
        Track(**{"distance": 40.0, "speed": 3.0} | change)


def test_largest_section_of_a_box_is_beam_times_draft():
    assert largest_section(box(20.0, 6.0, 2.0, panels=60).whole()) == pytest.approx(12.0)


def test_what_lies_beyond_the_last_image_is_summed_too():
    """G = Σ (R² + 4n²h²)^(−1/2) over 400 000 images and the integral of what is left: slopes to eight digits"""
    from hakobune.mooring.passing.slender import _by_images

    R, depth = np.array([[0.7, 1.2]]), 4.0
    r = np.sqrt(R[..., None] ** 2 + (2 * depth * np.arange(1, 400_001)) ** 2)
    slope, second = _by_images(R, depth)
    assert slope == pytest.approx(-1 / R**3 - 2 * (r**-3.0).sum(axis=-1), rel=2e-8)
    assert second == pytest.approx(3 / R**5 + 6 * (r**-5.0).sum(axis=-1), rel=2e-8)
