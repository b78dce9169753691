"""Sections side by side that float: hinged barges, energy, and one section by hand."""

import numpy as np
import pytest

from hakobune.bem.sections.any_section import any_section
from hakobune.bem.sections.linked import Floating, Hinge, linked_sections
from hakobune.bem.sections.outline import rectangle

BARGE = rectangle(30.0, 12.0).wetted(6.0)
GYRATION = np.hypot(30.0, 6.0) / np.sqrt(12)
PAIR = [Floating(BARGE, y, gyration=GYRATION) for y in (-16.5, 16.5)]
HELD = {"free": (), "hinged": (Hinge((0, 1), 0.0, 0.0),), "rigid": (Hinge((0, 1), 0.0, 0.0, "rigid"),)}


@pytest.fixture(scope="module")
def found():
    return {name: linked_sections(PAIR, 12.0, 0.5, hinges) for name, hinges in HELD.items()}


@pytest.mark.parametrize(("held", "transmission"), [("free", 0.998), ("hinged", 0.832), ("rigid", 0.953)])
def test_two_barges_let_so_much_of_a_wave_through(found, held, transmission):
    """Each 30 × 6 m, 3 m apart in 12 m of water, ω = 0.5: known to three digits, the mass that of a solid"""
    assert abs(found[held].transmission) == pytest.approx(transmission, rel=2e-3)


@pytest.mark.parametrize("held", HELD)
def test_waves_carry_away_what_comes_but_for_what_the_gap_takes(found, held):
    damped = linked_sections(PAIR, 12.0, 0.5, HELD[held], 0.05)
    for one, takes in ((found[held], False), (damped, True)):
        energy = abs(one.reflection) ** 2 + abs(one.transmission) ** 2
        assert energy + one.taken == pytest.approx(1, abs=1e-6)
        assert (one.taken > 1e-4) == takes


def test_hinges_hold_the_point_and_rigid_ones_the_turn(found):
    """At the hinge, ±16.5 m from either centre, 0 m above it"""
    for held in ("hinged", "rigid"):
        left, right = found[held].motions
        assert left[0] == pytest.approx(right[0], abs=1e-9)
        assert left[1] + 16.5 * left[2] == pytest.approx(right[1] - 16.5 * right[2], abs=1e-9)
    left, right = found["rigid"].motions
    assert left[2] == pytest.approx(right[2], abs=1e-12)
    assert abs(found["hinged"].motions[0, 2] - found["hinged"].motions[1, 2]) > 0.01


def test_what_a_rigid_link_holds_is_what_a_section_beside_a_fixed_one_needs():
    """Of a section linked to one that is fixed: the whole force of the wave on it, which then moves nothing"""
    linked = linked_sections([PAIR[0]._replace(fixed=True), PAIR[1]], 12.0, 0.5, HELD["rigid"])
    fixed = linked_sections([one._replace(fixed=True) for one in PAIR], 12.0, 0.5)
    assert np.abs(linked.motions).max() < 1e-12
    assert linked.transmission == pytest.approx(fixed.transmission, abs=1e-9)
    assert np.abs(linked.held[0, :2]).min() > 1e3


def test_one_section_moves_as_by_hand():
    """M + A, C and F of a section alone about its centre of gravity, 0.5 m above the waterline"""
    wetted, rho, g, omega, center = rectangle(8.0, 4.0).wetted(2.0), 1025.0, 9.80665, 1.2, 0.5
    one = linked_sections([Floating(wetted, 0.0, None, center, 2.5)], 6.0, omega)
    known = any_section(wetted, 6.0, omega)
    T = np.array([[1, 0, 0], [0, 1, 0], [center, 0, 1]])
    mass = rho * 16.0
    C = g * np.diag([0, rho * 8.0, rho * 8.0**3 / 12 + mass * (-1.0 - center)])
    Z = T @ (known.added_mass + 1j * known.damping / omega) @ T.T
    by_hand = np.linalg.solve(C - omega**2 * (np.diag([mass, mass, mass * 2.5**2]) + Z), T @ known.excitation)
    assert one.motions[0] == pytest.approx(by_hand, rel=1e-4)


def test_hinges_of_one_section_are_refused():
    with pytest.raises(ValueError, match="a hinge joins sections 1 and 1"):
        linked_sections(PAIR, 12.0, 0.5, [Hinge((1, 1), 0.0, 0.0)])
