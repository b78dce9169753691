"""Rigid-body modes: velocities of points, mirror images, another centre, what moves no water."""

import numpy as np
import pytest

from hakobune.bem.modes import PARITY, Mode, class_of, displacing, normal_velocities, reference_change, with_net_flux
from hakobune.bem.problem import Problem, check_gap
from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.shapes import box, buoy

CORNERS = (-2, 4), (2, 4), (2, 2), (-2, 2)  # along a plate and below the water, m


def test_the_velocity_of_a_point_is_that_of_translation_and_of_rotation_across_its_arm():
    """v = v₀ + ω × r along the normal"""
    rng = np.random.default_rng(1)
    r, n = rng.normal(size=(2, 5, 3))
    expected = [[float(v @ one) for v in np.eye(3)] + [float(np.cross(w, arm) @ one) for w in np.eye(3)]
                for arm, one in zip(r, n, strict=True)]  # fmt: skip
    assert normal_velocities(r, n) == pytest.approx(np.array(expected))


def test_modes_are_even_or_odd_as_their_normal_velocities_are():
    r, n = np.array([[1.0, 2.0, -3.0]]), np.array([[0.3, -0.5, 0.7]])
    own = normal_velocities(r, n)[0]
    for axis, mirror in enumerate(([-1, 1, 1], [1, -1, 1])):
        assert normal_velocities(r * mirror, n * mirror)[0] == pytest.approx([s[axis] for s in PARITY] * own)


def test_symmetry_classes_have_the_signs_of_the_planes_there_are():
    """Surge is odd in x, pitch too; sway, roll odd in y; yaw in both"""
    assert [class_of(dof, "xy") for dof in range(6)] == [(-1, 1), (1, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)]
    assert [class_of(dof, "x") for dof in range(6)] == [(-1, 1), (1, 1), (1, 1), (1, 1), (-1, 1), (-1, 1)]
    assert [class_of(dof, "y") for dof in range(6)] == [(1, 1), (1, -1), (1, 1), (1, -1), (1, 1), (1, -1)]
    assert all(class_of(dof, "") == (1, 1) for dof in range(6))


def test_normals_about_another_centre_are_those_of_arms_from_there():
    rng = np.random.default_rng(2)
    r, n = rng.normal(size=(2, 4, 3))
    center = np.array([0.5, -1.5, 2.0])
    expected = normal_velocities(r - center, n)
    assert normal_velocities(r, n) @ reference_change(center).T == pytest.approx(expected)
    assert Problem(rotation_center=tuple(center)).transform == pytest.approx(reference_change(center))


@pytest.mark.parametrize("shift", [0.0, 300.0])
def test_yaw_of_a_round_buoy_and_heave_of_a_pile_move_no_water(shift):
    assert displacing(buoy(10, 5, panels=300).moved(dx=shift)).tolist() == [True] * 5 + [False]
    pile = displacing(buoy(10, 20, panels=300, bottom=False).moved(dx=shift))
    assert pile.tolist() == [True, True, False, True, True, False]
    assert displacing(box(40, 20, 5, panels=100).moved(dx=shift)).all()


@pytest.mark.parametrize("share, moves", [(0.13, False), (0.16, True)])
def test_a_rotation_counts_from_two_per_cent_of_the_squares_of_its_arms(share, moves):
    """Four upright plates 10 m off the axis, moved by a share s along themselves: s²/(1 + s²), 0.017 and 0.025"""
    angle = np.pi / 2 * np.arange(4)
    normals = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    along = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    feet = 10 * normals + 10 * share * along
    corners = [m + s * a - [0, 0, z] for m, a in zip(feet, along, strict=True) for s, z in CORNERS]
    assert displacing(PanelMesh(corners, np.arange(16).reshape(4, 4))).tolist()[5] == moves


def test_net_flux_makes_added_mass_between_modes_infinite_with_its_sign():
    A = np.arange(36.0).reshape(6, 6)
    found = with_net_flux(A, np.array([0, 0, 20.0, -5.0, 1e-8, 0]), 100.0)
    assert found[2, 2] == np.inf and found[2, 3] == -np.inf and found[3, 3] == np.inf
    assert found[0, 0] == A[0, 0] and found[2, 4] == A[2, 4]


def test_water_thinner_than_three_hundred_thousandths_of_the_draft_is_refused():
    check_gap(10.0, 10.0 + 3.05e-4)
    with pytest.raises(
        ValueError,
        match=r"\(depth − draft\) is 0.000295 m; allowed: 0.0003 m or more \(3e-05 "
        r"of the draft\)",
    ):
        check_gap(10.0, 10.0 + 2.95e-4)


@pytest.mark.parametrize("hull, moves", [
    (buoy(10, 5, panels=300), [True] * 5 + [False]),
    (buoy(10, 20, panels=300, bottom=False), [True, True, False, True, True, False]),
])  # fmt: skip
def test_shapes_that_bend_move_water_after_the_motions_of_a_rigid_hull(hull, moves):
    assert displacing(hull, ("bending", "twist")).tolist() == [*moves, True, True]


@pytest.mark.parametrize("off, sign", [(0.95e-4, 1), (1.05e-4, 0)])
def test_a_shape_is_even_within_one_part_in_ten_thousand_of_its_largest_displacement(off, sign):
    """1 m upwards at x = 1 m and that much less at x = −1 m"""

    class Lopsided:
        def displacement(self, points):
            return np.stack([0 * points[:, 0], 0 * points[:, 0], np.where(points[:, 0] < 0, 1 - off, 1.0)], axis=1)

    assert Mode("bent", shape=Lopsided()).parity(np.array([[1.0, 2.0, -1.0], [-1.0, 2.0, -1.0]])) == (sign, 1)
