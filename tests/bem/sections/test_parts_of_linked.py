"""Rest, rows and loads of linked sections by hand, and the balance of each with what hinges hold."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.sections import linked
from hakobune.bem.sections.linked import Floating, Hinge, linked_sections
from hakobune.bem.sections.outline import rectangle

WETTED = SimpleNamespace(area=12.0, left=-1.0, right=5.0, waterline=6.0, center=1.5 - 0.8j)


def test_a_section_at_rest_has_its_waterplane_and_weight():
    """Waterplane 6 m about 0.5 m to the right of the centre, ρ = 1000, g = 10; lever of weight −0.8 − (−0.3) m"""
    M, C = linked._at_rest(Floating(WETTED, 3.0, None, -0.3, 2.0), 1000.0, 10.0)
    assert pytest.approx(np.diag([12e3, 12e3, 48e3])) == M
    roll = 1e4 * (6**3 / 12 + 6 * 0.25) + 12e4 * (-0.5)
    assert pytest.approx(np.array([[0, 0, 0], [0, 6e4, 3e4], [0, 3e4, roll]])) == C
    M, C = linked._at_rest(Floating(WETTED, 3.0, 9e3, -0.3, 2.0), 1000.0, 10.0)
    assert pytest.approx(np.diag([9e3, 9e3, 36e3])) == M and C[2, 2] == pytest.approx(roll)  # buoyancy is as before


def test_a_hinge_holds_its_point_and_a_rigid_one_the_turn():
    points = [-4.0 + 0.5j, 1.0 - 1.0j, 9.0 + 0j]
    motions = np.array([0.1, 0.2, 0.3, 1, 2, 3, -0.5, 0.7, 0.11])

    def at(i, y, z):
        u, w, turn = motions[3 * i : 3 * i + 3]
        return np.array([u - turn * (z - points[i].imag), w + turn * (y - points[i].real), turn])

    for kind, count in (("hinge", 2), ("rigid", 3)):
        rows = linked._rows(Hinge((0, 2), 2.0, -3.0, kind), points)
        assert rows.shape == (count, 9) and rows @ motions == pytest.approx((at(2, 2, -3) - at(0, 2, -3))[:count])
    for pair in ((0, 3), (-1, 0), (3, 1), (0, -1), (2, 2)):
        with pytest.raises(
            ValueError,
            match=rf"a hinge joins sections {pair[0]} and {pair[1]}; allowed: two different sections from 0 to 2",
        ):
            linked._rows(Hinge(pair, 0.0, 0.0), points)


def test_what_rows_leave_free_is_at_right_angles_to_them():
    rows = np.array([[1.0, 0, 0, -1], [2.0, 0, 0, -2], [0, 1, 1, 0]])
    free = linked._null_space(rows)
    assert free.shape == (4, 2) and rows @ free == pytest.approx(0.0, abs=1e-12)
    for much in (1e-12, 1e12):  # whatever the unit
        assert linked._null_space(much * rows).shape == (4, 2)
    assert free.T @ free == pytest.approx(np.eye(2)) and linked._null_space(np.zeros((0, 3))).shape == (3, 3)
    assert linked._scale(np.diag([4.0, -9.0])) == pytest.approx(np.array([[4.0, 6.0], [6.0, 9.0]]))


def test_a_plain_hinge_has_two_forces_and_a_rigid_one_a_moment_too():
    hinges = [Hinge((0, 1), 0, 0), Hinge((1, 2), 0, 0, "rigid")]
    assert linked._each(hinges, np.array([1.0, 2, 3, 4, 5])).tolist() == [[1, 2, 0], [3, 4, 5]]


def test_two_barges_of_other_shapes_balance_their_hinge():
    """Of a fixed pair the wave pushes F; of the left one held by a hinge to the right, which is fixed, D ξ = F + Gᵀμ"""
    rho, omega, depth = 1000.0, 0.9, 9.0
    left, right = rectangle(10.0, 4.0).wetted(2.0), rectangle(6.0, 4.0).wetted(3.0)
    pair = [Floating(left, -8.0, None, 0.4, 3.0), Floating(right, 4.0, None, 0.0, 2.0, True)]
    alone = linked_sections(pair, depth, omega, density=rho)
    hinged = linked_sections(pair, depth, omega, [Hinge((0, 1), 0.0, 1.0)], density=rho)
    xi = hinged.motions[0]
    assert xi[0] - xi[2] * (1.0 - 0.4) == pytest.approx(0.0, abs=1e-9)
    assert xi[1] + xi[2] * (0.0 + 8.0) == pytest.approx(0.0, abs=1e-9)
    assert np.abs(hinged.motions[1]).max() == 0.0 == np.abs(alone.motions[1]).max()
    energy = abs(hinged.reflection) ** 2 + abs(hinged.transmission) ** 2
    assert energy == pytest.approx(1.0, abs=1e-5) and hinged.taken == pytest.approx(0.0, abs=1e-9)
    # power of what holds: a hinge does no work on what it holds, so that the wave's power goes into waves alone
    assert np.abs(hinged.held[0, :2]).min() > 1.0 and hinged.held[0, 2] == 0.0 and hinged.gains.shape == (1,)


def test_a_hinge_pushes_the_second_section_as_the_equations_of_motion_and_of_the_hinges_together_say(monkeypatch):
    """Three sections with made-up water, the third fixed: {D, −Gᵀ; G, 0} {ξ, μ} = {F, 0}, with the force on the second
    section of each hinge, which for a section held by a fixed one alone is minus that of the wave"""
    rng, rho, omega = np.random.default_rng(3), 1000.0, 0.8
    Z, f = 1e4 * (rng.normal(size=(9, 9)) + 1j * rng.normal(size=(9, 9))), rng.normal(size=9) + 1j * rng.normal(size=9)
    flow = SimpleNamespace(
        potentials=np.zeros((4, 10)), forces=lambda part: -Z / rho if part.ndim == 2 else f, incident_forces=2 * f,
        waves=np.zeros((2, 10)), scattered=lambda way: (0.3, 0.4),
    )  # fmt: skip
    monkeypatch.setattr(linked, "flow_of", lambda *given: flow)
    monkeypatch.setattr(linked, "in_gaps", lambda *given: [])
    monkeypatch.setattr(linked, "taken_of", lambda *given: 0.0)
    sections = [Floating(WETTED, y, None, -0.3, 2.0, y == 20.0) for y in (0.0, 8.0, 20.0)]
    hinges = [Hinge((0, 1), 5.0, 0.5, "rigid"), Hinge((1, 2), 16.0, -1.0)]
    found = linked_sections(sections, 9.0, omega, hinges, density=rho, gravity=10.0)
    M = np.diag([12e3, 12e3, 48e3] * 2)
    C = np.kron(np.eye(2), [[0, 0, 0], [0, 6e4, 3e4], [0, 3e4, 1e4 * 19.5 - 6e4]])
    D, F = C - omega**2 * (M + Z[:6, :6]), -3j * rho * omega * f[:6]
    # a point (y, z) from a centre at (1.5, −0.3) of the section moves by (sway − z roll, heave + y roll)
    at = lambda y, z: np.array([[1, 0, -(z + 0.3)], [0, 1, y - 1.5], [0, 0, 1]])  # noqa: E731
    G = np.block([[-at(5.0, 0.5), at(-3.0, 0.5)], [np.zeros((2, 3)), -at(8.0, -1.0)[:2]]])
    both = np.linalg.solve(np.block([[D, -G.T], [G, np.zeros((5, 5))]]), np.concatenate([F, np.zeros(5)]))
    assert found.motions[:2].ravel() == pytest.approx(both[:6], abs=1e-9) and not found.motions[2].any()
    assert found.held[0] == pytest.approx(both[6:9], rel=1e-6) and found.held[1] == pytest.approx([*both[9:], 0.0])
    sections = [sections[0]._replace(fixed=True), sections[1]]
    Z, f, flow.potentials = Z[:6, :6], f[:6], np.zeros((4, 7))
    flow.waves, flow.incident_forces = np.zeros((2, 7)), 2 * f
    found = linked_sections(sections, 9.0, omega, [Hinge((0, 1), 9.5, -0.3, "rigid")], density=rho, gravity=10.0)
    assert found.held[0] == pytest.approx(3j * rho * omega * f[3:])
