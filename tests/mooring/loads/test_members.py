"""Members in wind and water: hand calculations and what drag and inertia have to be."""

import numpy as np
import pytest

from hakobune.mooring.environment.wind_profile import speed_at
from hakobune.mooring.loads.members import Member, wind_on_members
from hakobune.mooring.loads.morison import circular, force_per_metre, member_force, plate, square

PILE = circular(1.2, 0.9)
UP = (0.0, 0.0, 1.0)


def test_wind_on_a_derrick_is_the_hand_calculation():
    """80 m² at 40 m in 30 m/s from the side: C_H 1.095, C_d 1.25; it heels with the arm above the waterline."""
    force = wind_on_members([Member("derrick, each face", 80.0, (10.0, 0.0, 40.0))], 30.0, np.pi / 2)
    F = 0.5 * 1.226 * 1.25 * (1.095 * 30) ** 2 * 80
    assert np.allclose(force, [0, F, 0, -40 * F, 0, 10 * F], atol=1e-6 * F)


def test_members_add_up_each_at_the_wind_of_its_height():
    members = [Member("cylinder", 3.0, (0.0, 0.0, z)) for z in (5.0, 20.0, 70.0)]
    total = wind_on_members(members, 25.0, 0.0, exponent=1 / 7)
    speeds = speed_at(np.array([5.0, 20.0, 70.0]), 25.0, 1 / 7)
    assert np.isclose(total[0], 0.5 * 1.226 * 0.5 * 3.0 * np.sum(speeds**2))


@pytest.mark.parametrize(
    ("member", "message"),
    [
        (Member("cone", 1.0, (0, 0, 5)), "wind member 0: shape is 'cone'; allowed: sphere, cylinder"),
        (Member(-0.5, 1.0, (0, 0, 5)), "drag coefficient is -0.5"),
        (Member(1.0, 0.0, (0, 0, 5)), "area is 0 m²; allowed: above 0"),
        (Member(1.0, 1.0, (0, 0, -5)), "height above the sea is -5 m"),
    ],
)
def test_members_that_cannot_be_are_refused(member, message):
    with pytest.raises(ValueError, match=message):
        wind_on_members([member], 20.0, 0.0)


def test_steady_flow_past_a_slanted_pile_counts_only_across_it():
    """Cross-flow principle: ½ρ C_D D (U sin θ)², normal to the axis."""
    for theta in np.radians([10, 45, 90]):
        axis = [np.cos(theta), 0.0, np.sin(theta)]
        force = force_per_metre(PILE, axis, [2.0, 0, 0], np.zeros(3))
        assert abs(force @ axis) < 1e-9 * np.linalg.norm(force)
        assert np.isclose(np.linalg.norm(force), 0.5 * 1025 * 0.9 * 1.2 * (2 * np.sin(theta)) ** 2)


def test_waves_and_current_together_are_not_the_sum_of_their_drags():
    """Mean of (U + a cos ωt)² is U² + a²/2 while the current is the stronger."""
    phase = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    velocity = np.zeros((64, 3))
    velocity[:, 0] = 2.0 + 1.5 * np.cos(phase)
    mean = force_per_metre(PILE, UP, velocity, np.zeros((64, 3)))[:, 0].mean()
    assert np.isclose(mean, 0.5 * 1025 * 0.9 * 1.2 * (2.0**2 + 1.5**2 / 2))


@pytest.mark.parametrize("section", [PILE, square(0.8, 2.0), circular(0.3, 1.1, 1.7), plate(2.0, 1.9)])
def test_a_member_that_moves_with_the_water_feels_its_pressure_only(section):
    """Same velocity and acceleration: ρ V a, as the water whose place it takes."""
    u, a = np.array([0.7, -0.4, 0.0]), np.array([0.3, 0.9, 0.0])
    assert np.allclose(force_per_metre(section, UP, u, a, u, a), 1025 * section.displaced * a)


def test_a_member_pushed_through_still_water_carries_added_mass():
    a = np.array([0.5, 0.0, 0.0])
    force = force_per_metre(PILE, UP, np.zeros(3), np.zeros(3), np.zeros(3), a)
    assert np.allclose(force, -1025 * np.pi / 4 * 1.2**2 * a)  # C_M = 2: as much as the water displaced
    force = force_per_metre(plate(2.0, 1.9), UP, np.zeros(3), np.zeros(3), np.zeros(3), a)
    assert np.allclose(force, -1025 * np.pi * a)  # π a² of a plate of half width a = 1


def test_inertia_of_a_square_prism_is_that_of_potential_flow():
    """Added mass 4.754 ρ (D/2)² (Newman, Marine Hydrodynamics (1977), table 4.3: 4.754 a²), on D² besides D² itself."""
    section = square(2.0, 2.0)
    assert np.isclose(section.added, 4.754, atol=0.01) and section.displaced == 4.0


def test_force_and_moment_along_a_pile_are_the_integral():
    """u = 1 + z/20 on 20 m of pile: ∫u² = 20/3, ∫z u² = −100/3 from −20 to 0."""

    def flow(places):
        velocity = np.zeros_like(places)
        velocity[:, 0] = 1 + places[:, 2] / 20
        return velocity, np.zeros_like(places)

    unit = 0.5 * 1025 * 0.9 * 1.2
    force = member_force(PILE, (3.0, 4.0, -20.0), (3.0, 4.0, 0.0), flow)
    assert np.allclose(force / unit, [20 / 3, 0, 0, 0, -100 / 3, -4 * 20 / 3])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: circular(-1.0, 1.0), "width of a member is -1 m; allowed: above 0"),
        (lambda: circular(1.0, -1.0), "C_D of a member is -1; allowed: at least 0"),
        (lambda: circular(1.0, 1.0, 0.5), "C_M of a member is 0.5; allowed: at least 1"),
        (lambda: circular(np.nan, 1.0), "width of a member is nan"),
        (lambda: force_per_metre(PILE, (0, 0, 0), np.zeros(3), np.zeros(3)), "axis of a member"),
        (lambda: member_force(PILE, (0, 0, 0), (0, 0, 0), None), "0 m long; allowed: above 0"),
    ],
)
def test_sections_that_cannot_be_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
