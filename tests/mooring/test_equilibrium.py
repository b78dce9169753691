"""Balance of lines and steady forces, and the stiffness of the whole mooring."""

import numpy as np
import pytest

from mooring.equilibrium import (
    EquilibriumError,
    displaced,
    find_equilibrium,
    line_forces,
    mooring_load,
    mooring_stiffness,
)
from mooring.layout import Layout, Line, corner_spread, pretensioned
from mooring.lines.catenary.solve import solve_lines
from mooring.lines.catenary.state import State

TONF = 9806.65


def spread(**changes):
    values = dict(
        hull_length=100.0,
        beam=50.0,
        headings=np.radians([30, 45, 60]),
        depth=20.0,
        length=260.0,
        weight=0.406 * TONF,
        pretension=40 * TONF,
        axial_stiffness=2.2e5 * TONF,
        breaking_load=1700 * TONF,
    )
    return corner_spread(**{**values, **changes})


def rotation(vector):
    """Matrix of a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    x, y, z = vector / angle
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def test_spread_at_rest_has_its_pretension_and_pulls_only_down():
    layout = spread()
    state = mooring_load(layout, (0, 0, 0), (0, 0, 0))
    assert np.allclose(state.lines.horizontal_fairlead, 40 * TONF, rtol=1e-9)
    total = state.lines.horizontal_fairlead.sum()
    assert np.abs(state.force[:2]).max() < 1e-9 * total
    assert np.abs(state.force[3:]).max() < 1e-9 * total * 50
    assert np.isclose(state.force[2], -state.lines.vertical_fairlead.sum())


@pytest.mark.parametrize("position", [(0.0, 0.0, 0.0), (1.2, -0.8, 0.03)])
def test_stiffness_is_the_derivative_of_force_and_moment(position):
    layout, center = spread(), np.array([3.0, -2.0, -4.0])
    moved = center + [position[0], position[1], 0]
    points = displaced(layout.fairleads, position, center)

    def load(motion):
        at = moved + motion[:3] + (points - moved) @ rotation(motion[3:]).T
        force = line_forces(*layout.solve(at))
        return np.concatenate([force.sum(axis=0), np.cross(at - moved - motion[:3], force).sum(axis=0)])

    def differences(h):
        return -np.array([(load(h * e) - load(-h * e)) / (2 * h) for e in np.diag(1 / arm)]).T * arm

    arm = np.array([1, 1, 1, 50, 50, 50])
    K = mooring_stiffness(layout, position, center)
    fine = (4 * differences(1e-3) - differences(2e-3)) / 3
    scaled = np.outer(arm, arm)
    assert np.abs((fine - K) / scaled).max() < 1e-7 * np.abs(K / scaled).max()


def test_plane_stiffness_equals_the_coefficients_of_the_report():
    """SR179 report (1982), eq. 3.5.1.2, with the line angle ψ from fairlead to anchor."""
    layout = spread(pretension=70 * TONF)
    position = np.array([1.0, 1.5, -0.02])
    state = mooring_load(layout, position, np.zeros(3))
    c, s = -state.outward.T
    f, fp = state.lines.horizontal_fairlead, state.lines.stiffness[:, 0, 0]
    f_l = f / np.hypot(*(state.points - layout.anchors)[:, :2].T)
    B, A = (state.points[:, :2] - position[:2]).T
    a11 = f_l * s**2 + fp * c**2
    a12 = (fp - f_l) * c * s
    a22 = f_l * c**2 + fp * s**2
    a13 = a12 * B - a11 * A
    a23 = a22 * B - a12 * A
    a33 = f * (A * s + B * c) + f_l * (A * s + B * c) ** 2 + fp * (A * c - B * s) ** 2
    expected = np.array([[a11, a12, a13], [a12, a22, a23], [a13, a23, a33]]).sum(axis=-1)
    plane = state.stiffness[np.ix_([0, 1, 5], [0, 1, 5])]
    arm = np.array([1, 1, 50])
    assert np.allclose(plane / np.outer(arm, arm), expected / np.outer(arm, arm), rtol=1e-9, atol=1e-9 * a22.sum())


def test_equilibrium_balances_the_steady_force():
    layout = spread()
    for force in ([1e6, 2e6, 1e8], [3e6, 8e6, 2e8], [2e7, 2e7, 3e8], [0, 0, 1e9], [0, 0, 0]):
        found = find_equilibrium(layout, force)
        scale = np.abs(force).max() + found.lines.horizontal_fairlead.sum()
        assert np.abs(found.residual).max() < 1e-9 * scale * 50
        again = mooring_load(layout, found.position, np.zeros(3)).force
        assert np.allclose(again[[0, 1, 5]] + force, 0, atol=1e-8 * scale * 50)


def test_each_line_pulls_towards_its_anchor_and_all_together_hold_the_steady_force():
    """Forces and moments summed line by line, about the rotation centre carried along."""
    layout, center, force = spread(), np.array([7.0, -3.0, -2.0]), np.array([-3e6, -8e6, 2e8])
    found = find_equilibrium(layout, force, center)
    x, y, turn = found.position
    total = force.copy()
    for line in layout.lines:
        arm = np.subtract(line.fairlead, center)[:2]
        arm = np.array([np.cos(turn) * arm[0] - np.sin(turn) * arm[1], np.sin(turn) * arm[0] + np.cos(turn) * arm[1]])
        away = np.array(line.anchor[:2]) - (center[:2] + [x, y] + arm)
        span = np.hypot(*away)
        H = solve_lines(span, 20.0, line.length, line.weight, line.axial_stiffness).horizontal_fairlead
        pull = H * away / span
        total += [*pull, arm[0] * pull[1] - arm[1] * pull[0]]
    assert np.all(np.abs(total) < 1e-9 * np.array([1, 1, 50]) * np.abs(force).max())


def test_head_load_on_a_symmetric_spread_gives_mirrored_tensions():
    found = find_equilibrium(spread(), [-5e6, 0.0, 0.0])
    assert found.position[0] < 0
    assert np.abs(found.position[1:]).max() < 1e-10
    # fore port, fore starboard, aft port, aft starboard, three lines each
    port_fore, starboard_fore, port_aft, starboard_aft = found.lines.tension_fairlead.reshape(4, 3)
    assert np.allclose(port_fore, starboard_fore, rtol=1e-9)
    assert np.allclose(port_aft, starboard_aft, rtol=1e-9)
    assert np.all(port_fore > port_aft)


def potential_energy(layout, position, force):
    """J: weight times height and ∫ T²/2EA of all lines, less the work of the steady force; flat bed, no friction."""
    lines, _ = layout.solve(displaced(layout.fairleads, position, np.zeros(3)))
    s, share = np.polynomial.legendre.leggauss(200)
    energy = -np.dot(force, position)
    for i, line in enumerate(layout.lines):
        H, V, lying = (v[i] for v in (lines.horizontal_fairlead, lines.vertical_fairlead, lines.grounded_length))
        w, EA, free = line.weight, line.axial_stiffness, line.length - lying
        at, step = 0.5 * free * (1 + s), 0.5 * free * share
        low = V - w * free
        tension = np.hypot(H, low + w * at)
        # height above the lower end, with stretch: ∫ (1 + T/EA) V/T ds
        height = (tension - np.hypot(H, low)) / w + (low * at + 0.5 * w * at**2) / EA
        energy += step @ (w * height + tension**2 / (2 * EA)) + lying * H**2 / (2 * EA)
    return energy


def test_potential_energy_is_stationary_at_equilibrium_and_curved_like_the_stiffness():
    layout, force = spread(), np.array([-3e6, -8e6, 2e8])
    found = find_equilibrium(layout, force)
    steps = np.diag([0.02, 0.02, 4e-4])

    def energy(shift):
        return potential_energy(layout, found.position + shift, force)

    here = energy(np.zeros(3))
    K = found.stiffness[np.ix_([0, 1, 5], [0, 1, 5])]
    for i, step in enumerate(steps):
        above, below = energy(step), energy(-step)
        # central differences: second order, and rounding of an energy of 1e8 J
        assert abs(above - below) / (2 * step[i]) < 1e-4 * abs(force[i])
        assert np.isclose((above - 2 * here + below) / step[i] ** 2, K[i, i], rtol=1e-3)


def test_equilibrium_is_the_same_from_far_away():
    layout, force = spread(), [3e6, 8e6, 2e8]
    near = find_equilibrium(layout, force).position
    for start in ([-60, -80, 0.5], [40, 30, -0.4], [0, -100, 0]):
        assert np.allclose(find_equilibrium(layout, force, start=start).position, near, atol=1e-7)


def test_equilibrium_is_found_through_slack():
    lines = [
        Line(str(i), (150 * np.cos(a), 150 * np.sin(a), -20.0), (50 * np.cos(a), 25 * np.sin(a), 0.0), 160.0, 4e3)
        for i, a in enumerate(np.radians([45, 135, 225, 315]))
    ]
    layout = Layout(lines)
    assert np.all(layout.solve(layout.fairleads)[0].status == State.SLACK)
    found = find_equilibrium(layout, [1e6, 0.0, 0.0])
    assert found.position[0] > 0
    assert np.abs(found.residual[:2]).max() < 1e-3
    assert abs(found.position[1]) < 1e-6


def test_mirrored_force_gives_the_mirrored_position():
    layout = spread()
    x, y, turn = find_equilibrium(layout, [2e6, 3e6, 5e7]).position
    assert np.allclose(find_equilibrium(layout, [-2e6, 3e6, -5e7]).position, [-x, y, -turn], atol=1e-9)
    assert np.allclose(find_equilibrium(layout, [2e6, -3e6, -5e7]).position, [x, -y, -turn], atol=1e-9)


def test_inextensible_lines_stop_the_body_short_of_their_reach():
    layout = spread(axial_stiffness=np.inf)
    found = find_equilibrium(layout, [5e7, 0, 0])
    assert np.all(found.lines.status != State.BEYOND_REACH)
    assert np.abs(found.residual[0]) < 1


def test_start_out_of_reach_is_an_error():
    with pytest.raises(EquilibriumError, match="cannot reach"):
        find_equilibrium(spread(axial_stiffness=np.inf), [0, 0, 0], start=[200, 0, 0])


def test_one_line_trails_in_the_direction_of_the_force():
    line = Line("hawser", (0.0, 0.0, -20.0), (0.0, 0.0, 0.0), 100.0, 1e3, 1e8)
    force = 2e5 * np.array([np.cos(0.7), np.sin(0.7), 0.0])
    found = find_equilibrium(Layout([line]), force, start=[30.0, 0.0, 0.0])
    assert np.isclose(np.arctan2(found.position[1], found.position[0]), 0.7, atol=1e-6)
    span = np.hypot(*found.position[:2])
    assert np.isclose(solve_lines(span, 20.0, 100.0, 1e3, 1e8).horizontal_fairlead, 2e5, rtol=1e-8)


def test_pretensioned_anchor_lies_along_its_heading_on_the_bed():
    line = pretensioned("a", (50.0, 25.0, 2.0), np.radians(120), 20.0, 260.0, 4e3, 4e5)
    away = np.subtract(line.anchor, line.fairlead)
    assert np.isclose(np.arctan2(away[1], away[0]), np.radians(120))
    assert line.anchor[2] == -20.0
    assert np.isclose(solve_lines(np.hypot(*away[:2]), 22.0, 260.0, 4e3).horizontal_fairlead, 4e5)


def test_layout_refuses_two_lines_of_one_name():
    line = Line("a", (0.0, 0.0, -20.0), (0.0, 0.0, 0.0), 100.0, 1e3)
    with pytest.raises(ValueError, match="'a' is used 2 times"):
        Layout([line, line])
    with pytest.raises(ValueError, match="at least one line"):
        Layout([])
