"""One body on its legs: how they are laid, and where they balance steady forces."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.state import State
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.equilibrium import held_at, rest
from hakobune.mooring.lines.system.moored_body import Leg, corner_legs, leg_at_tension, moored_body
from hakobune.mooring.lines.system.parts import CompositeLine, LineType, UniformLine

TONF, PLANE = 9806.65, [0, 1, 5]
CHAIN = LineType("chain", 0.406 * TONF, 2.2e5 * TONF)


def uniform(kind, length):
    return UniformLine("line", kind, length, "anchor", "fairlead")


def spread(pretension=40 * TONF, center=(0.0, 0.0, 0.0), kind=CHAIN):
    legs = corner_legs(uniform(kind, 260.0), 100.0, 50.0, np.radians([30, 45, 60]), 20.0, pretension)
    return moored_body(legs, 20.0, center)


def under(system, force, displacement=None):
    """At rest under (F_x, F_y, M_z), sought from a displacement (x, y, yaw) of the body"""
    x, y, turn = force
    body = system.bodies[0]
    start = None
    if displacement is not None:
        shift = np.zeros(6)
        shift[PLANE] = displacement
        start = held_at(system, {body.name: np.add(body.position, shift)}).pose
    return rest(system.with_loads({body.name: (x, y, 0.0, 0.0, 0.0, turn)}), start)


def test_spread_at_rest_has_its_pretension_and_pulls_only_down():
    load, lines = spread().load(), rest(spread()).lines
    assert np.allclose(lines.horizontal_b, 40 * TONF, rtol=1e-9)
    total = lines.horizontal_b.sum()
    assert np.abs(load.force[:2]).max() < 1e-9 * total
    assert np.abs(load.force[3:]).max() < 1e-9 * total * 50
    assert np.isclose(load.force[2], -lines.vertical_b.sum())


def test_legs_of_a_rope_that_floats_have_their_pretension():
    rope = LineType("rope", -6.4, 3e8)
    lines = rest(spread(kind=rope)).lines
    assert np.allclose(lines.horizontal_b, 40 * TONF, rtol=1e-7)
    assert np.allclose(lines.vertical_a + lines.vertical_b, -6.4 * 260.0, rtol=1e-9)  # down on both ends


def test_plane_stiffness_equals_the_coefficients_of_the_report():
    """SR179 report (1982), eq. 3.5.1.2, with the line angle ψ from fairlead to anchor."""
    system = spread(70 * TONF)
    displaced = held_at(system, {"body": (1.0, 1.5, 0.0, 0.0, 0.0, -0.02)})
    load, ends = displaced.load(), system.arrays.ends
    anchors, fairleads = load.points[ends[:, 0]], load.points[ends[:, 1]]
    away = (fairleads - anchors)[:, :2]
    span = np.hypot(*away.T)
    c, s = -away.T / span
    line = solve_lines(span, 20.0, 260.0, CHAIN.weight, CHAIN.axial_stiffness)
    f, fp = line.horizontal_fairlead, line.stiffness[:, 0, 0]
    f_l = f / span
    B, A = (fairleads[:, :2] - [1.0, 1.5]).T
    a11 = f_l * s**2 + fp * c**2
    a12 = (fp - f_l) * c * s
    a22 = f_l * c**2 + fp * s**2
    a13 = a12 * B - a11 * A
    a23 = a22 * B - a12 * A
    a33 = f * (A * s + B * c) + f_l * (A * s + B * c) ** 2 + fp * (A * c - B * s) ** 2
    expected = np.array([[a11, a12, a13], [a12, a22, a23], [a13, a23, a33]]).sum(axis=-1)
    arm = np.outer([1, 1, 50], [1, 1, 50])
    plane = load.stiffness[np.ix_(PLANE, PLANE)]
    assert np.allclose(plane / arm, expected / arm, rtol=1e-9, atol=1e-9 * a22.sum())


@pytest.mark.parametrize("force", [(-3e6, -8e6, 2e8), (2e7, 2e7, 3e8), (0.0, 0.0, 1e9)])
def test_each_line_pulls_towards_its_anchor_and_all_together_hold_the_steady_force(force):
    """Forces and moments summed line by line, about the rotation centre carried along."""
    center = np.array([7.0, -3.0, -2.0])
    system = spread(center=center)
    found = under(system, force)
    x, y, _, _, _, turn = found.position[0]
    total = np.array(force)
    points = {point.name: np.array(point.position) for point in system.points}
    for line in system.lines:
        a, b = points[line.b][:2]
        arm = np.array([np.cos(turn) * a - np.sin(turn) * b, np.sin(turn) * a + np.cos(turn) * b])
        away = points[line.a][:2] - ([x, y] + arm)
        span = np.hypot(*away)
        H = solve_lines(span, 20.0, line.length, CHAIN.weight, CHAIN.axial_stiffness).horizontal_fairlead
        pull = H * away / span
        total += [*pull, arm[0] * pull[1] - arm[1] * pull[0]]
    assert np.all(np.abs(total) < 1e-9 * np.array([1, 1, 50]) * np.abs(force).max())


def potential_energy(system, displacement, force):
    """J: weight times height and ∫ T²/2EA of all lines, less the work of the steady force; flat bed, no friction."""
    lines = rest(held_at(system, {"body": np.insert(displacement, 2, [0.0, 0.0, 0.0])})).lines
    s, share = np.polynomial.legendre.leggauss(200)
    energy = -np.dot(force, displacement)
    for i, line in enumerate(system.lines):
        H, V, lying = (v[i] for v in (lines.horizontal_b, lines.vertical_b, lines.grounded_length))
        w, EA, free = line.type.weight, line.type.axial_stiffness, line.length - lying
        at, step = 0.5 * free * (1 + s), 0.5 * free * share
        low = V - w * free
        tension = np.hypot(H, low + w * at)
        # height above the lower end, with stretch: ∫ (1 + T/EA) V/T ds
        height = (tension - np.hypot(H, low)) / w + (low * at + 0.5 * w * at**2) / EA
        energy += step @ (w * height + tension**2 / (2 * EA)) + lying * H**2 / (2 * EA)
    return energy


def test_potential_energy_is_stationary_at_equilibrium_and_curved_like_the_stiffness():
    system, force = spread(), np.array([-3e6, -8e6, 2e8])
    found = under(system, force)
    at_rest = found.position[0, PLANE]

    def energy(shift):
        return potential_energy(system, at_rest + shift, force)

    here = energy(np.zeros(3))
    for i, step in enumerate(np.diag([0.02, 0.02, 4e-4])):
        above, below, k = energy(step), energy(-step), found.stiffness[PLANE[i], PLANE[i]]
        # central differences: second order, and rounding of an energy of 1e8 J
        assert abs(above - below) / (2 * step[i]) < 1e-4 * abs(force[i])
        assert np.isclose((above - 2 * here + below) / step[i] ** 2, k, rtol=1e-3)


def test_equilibrium_is_the_same_from_far_away():
    system, force = spread(), (3e6, 8e6, 2e8)
    near = under(system, force).position
    for start in ([-60, -80, 0.5], [40, 30, -0.4], [0, -100, 0]):
        assert np.allclose(under(system, force, start).position, near, atol=1e-7)


def test_equilibrium_is_found_through_slack():
    chain = uniform(LineType("chain", 4e3), 160.0)
    legs = [
        Leg(
            replace(chain, name=str(i)),
            (150 * np.cos(a), 150 * np.sin(a), -20.0),
            (50 * np.cos(a), 25 * np.sin(a), 0.0),
        )
        for i, a in enumerate(np.radians([45, 135, 225, 315]))
    ]
    system = moored_body(legs, 20.0)
    assert np.all(rest(system).lines.status == State.SLACK)
    found = under(system, (1e6, 0.0, 0.0))
    assert found.position[0, 0] > 0
    assert np.abs(found.residual[:2]).max() < 1e-3
    assert abs(found.position[0, 1]) < 1e-6


def test_mirrored_force_gives_the_mirrored_position():
    system = spread()
    x, y, turn = under(system, (2e6, 3e6, 5e7)).position[0, PLANE]
    assert np.allclose(under(system, (-2e6, 3e6, -5e7)).position[0, PLANE], [-x, y, -turn], atol=1e-9)
    assert np.allclose(under(system, (2e6, -3e6, -5e7)).position[0, PLANE], [x, -y, -turn], atol=1e-9)


def test_inextensible_lines_stop_the_body_short_of_their_reach():
    found = under(spread(kind=replace(CHAIN, axial_stiffness=np.inf)), (5e7, 0, 0))
    assert np.all(found.lines.status != State.BEYOND_REACH)
    assert np.abs(found.residual[0]) < 1


def test_one_line_trails_in_the_direction_of_the_force():
    leg = Leg(uniform(LineType("hawser", 1e3, 1e8), 100.0), (0.0, 0.0, -20.0), (0.0, 0.0, 0.0))
    force = 2e5 * np.array([np.cos(0.7), np.sin(0.7), 0.0])
    x, y, _ = under(moored_body([leg], 20.0), force, [30.0, 0.0, 0.0]).position[0, PLANE]
    assert np.isclose(np.arctan2(y, x), 0.7, atol=1e-6)
    assert np.isclose(solve_lines(np.hypot(x, y), 20.0, 100.0, 1e3, 1e8).horizontal_fairlead, 2e5, rtol=1e-8)


@pytest.mark.parametrize(
    "line",
    [
        uniform(LineType("chain", 4e3), 260.0),
        CompositeLine(
            "line", (Segment(200.0, 4e3), Segment(60.0, 800.0, 5e8)), "a", "b", (PointLoad(200.0, 5e4),), 0.3
        ),
    ],
    ids=["uniform", "segments"],
)
def test_a_leg_at_a_tension_has_its_anchor_along_its_heading_on_the_bed_and_that_tension(line):
    leg = leg_at_tension(line, (50.0, 25.0, 2.0), np.radians(120), 20.0, 4e5)
    away = np.subtract(leg.anchor, leg.fairlead)
    assert np.isclose(np.arctan2(away[1], away[0]), np.radians(120))
    assert leg.anchor[2] == -20.0
    system = moored_body([leg], 20.0)
    assert np.isclose(rest(held_at(system, {"body": system.bodies[0].position})).lines.horizontal_b[0], 4e5)
