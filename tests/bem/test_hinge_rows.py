"""Rows, springs and dampers of links between two bodies of a made-up reader, by the geometry of rigid bodies."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.hinges import (
    ALONE,
    SHOWN,
    SPACE,
    Link,
    driven,
    end_of,
    forces_of,
    free_of,
    pulls_of,
    rows_of,
    told_of,
    travel_of,
)
from hakobune.bem.modes import Body, Mode

ONE, TWO = Body("one", (1.0, 0.0, -2.0)), Body("two", (0.0, 0.5, -1.0), place=(10.0, 3.0), heading=np.pi / 2)


class Water:
    """A reader of two bodies"""

    bodies, words = (ONE, TWO), ("",) * 12
    damping, stiffness = np.zeros((12, 12)), np.zeros((12, 12))
    rotation_center = (1.0, 2.0, 3.0)
    modes, rigid = (), 12

    def __init__(self, *links):
        self.links = links

    def body_named(self, name):
        return {"one": ONE, "two": TWO}[name]

    def columns_of(self, body):
        return slice(0, 6) if body is ONE else slice(6, 12)

    def restrained(self, damping, stiffness):
        return SimpleNamespace(damping=damping, stiffness=stiffness)


def link(kind="ball", bodies=("one", "two"), position=(4.0, 1.0, 0.5), **more):
    return Link("joint", bodies, position, kind=kind, **more)


def moved(motions):
    """Of both: how far the point of the joint moves in the scene and by what it turns, two (3,) each"""
    u, v = motions[:6], motions[6:]
    at = np.array([4.0, 1.0, 0.5])
    first = u[:3] + np.cross(u[3:], at - [1.0, 0.0, -2.0]), u[3:]
    turn = TWO.axes
    arm = turn.T @ (at - [0.0, 0.5, -1.0])
    second = turn @ (v[:3] + np.cross(v[3:], arm)), turn @ v[3:]
    return [second[i] - first[i] for i in (0, 1)]


MOTIONS = np.random.default_rng(5).normal(size=12)


def test_a_ball_holds_how_far_its_points_are_apart_along_the_axes_of_the_first():
    rows = rows_of(Water(), link())
    assert rows.shape == (3, 12) and rows @ MOTIONS == pytest.approx(moved(MOTIONS)[0])
    still = rows_of(Water(), link(bodies=("one", SPACE)))
    assert still[:, 6:] == pytest.approx(0.0) and still[:, :6] == pytest.approx(rows[:, :6])


def test_a_rigid_link_holds_turns_too_a_hinge_two_of_them_a_slider_two_ways():
    assert rows_of(Water(), link("rigid")) @ MOTIONS == pytest.approx(np.concatenate(moved(MOTIONS)))
    way = np.array([3.0, 0.0, 4.0])
    for kind, part in (("hinge", 1), ("slider", 0)):
        one = link(kind, axis=tuple(way))
        rows = rows_of(Water(), one)
        assert rows.shape == (5, 12)
        across = one.held if kind == "hinge" else one.along
        assert across @ across.T == pytest.approx(np.eye(2), abs=1e-12) and across @ way == pytest.approx(
            0.0, abs=1e-12
        )
        held = rows[3:] if kind == "hinge" else rows[:2]
        assert held @ MOTIONS == pytest.approx(across @ moved(MOTIONS)[part])
        assert travel_of(Water(), one) @ MOTIONS == pytest.approx(way @ moved(MOTIONS)[part] / 5)


def test_springs_and_dampers_act_along_the_axis_whatever_its_length():
    one, other = link("slider", axis=(0.0, 3.0, 0.0), damping=5.0), link("hinge", axis=(0.0, 0.0, 2.0), stiffness=7.0)
    found = driven(Water(one, other, link("slider", axis=(1.0, 0.0, 0.0))))
    rows = [travel_of(Water(), each) for each in (one, other)]
    assert found.damping == pytest.approx(5 * np.outer(rows[0], rows[0]))
    assert found.stiffness == pytest.approx(7 * np.outer(rows[1], rows[1]))
    omega = np.array([0.5, 2.0])
    motions = np.stack([[MOTIONS], [2j * MOTIONS]])
    pulls = pulls_of(Water(one, other), omega, motions)
    assert pulls.shape == (2, 1, 2, 6)
    y, z = (row @ MOTIONS for row in rows)
    assert pulls[0, 0, 0] == pytest.approx([0, 2.5j * y, 0, 0, 0, 0])
    assert pulls[1, 0, 0] == pytest.approx([0, 10j * 2j * y, 0, 0, 0, 0])
    assert pulls[1, 0, 1] == pytest.approx([0, 0, 0, 0, 0, -7 * 2j * z])


def test_results_of_links_are_six_loads_and_the_travel_of_those_that_have_one():
    told = told_of([link(), link("slider", axis=(1, 0, 0)), link("hinge", axis=(1, 0, 0))])
    names = [name for name, _, _ in told]
    assert names[:6] == [f"joint {word} {axis}" for word in ("force", "moment") for axis in "xyz"]
    assert len(told) == 20 and told[12] == ("joint travel", "m", SHOWN + 6) and told[19] == (
        "joint travel", "rad", 2 * SHOWN + 6
    )  # fmt: skip
    assert [unit for _, unit, _ in told[:6]] == ["N"] * 3 + ["N m"] * 3
    assert [column for *_, column in told[6:9]] == [SHOWN, SHOWN + 1, SHOWN + 2]


def test_ends_are_named_bodies_the_one_there_is_or_space():
    assert end_of(Water(), SPACE)[1] is None and end_of(Water(), SPACE)[0].fixed
    assert end_of(Water(), "two") == (TWO, slice(6, 12))
    body, own = end_of(SimpleNamespace(bodies=(), rotation_center=np.array([1.0, 2, 3])), ALONE)
    assert body.rotation_center == (1.0, 2.0, 3.0) and own == slice(0, 6)


def test_what_rows_leave_free_is_orthonormal_and_repeated_rows_are_refused():
    rows = rows_of(Water(), link("hinge", axis=(0, 0, 1)))
    free = free_of(rows)
    assert free.shape == (12, 7) and free.T @ free == pytest.approx(np.eye(7), abs=1e-12)
    assert np.abs(rows @ free).max() < 1e-12
    with pytest.raises(
        ValueError, match="fix 5 motions with 10 constraints: some constraints repeat others; leave out one hinge,"
    ):
        free_of(np.vstack([rows, 2 * rows]))
    with pytest.raises(ValueError, match="fix 12 motions with 15 constraints"):
        free_of(np.random.default_rng(1).normal(size=(15, 12)))


def test_loads_of_links_hold_what_is_left():
    """Gᵀ μ of each link along its held directions: D X − F = Gᵀ μ"""
    links = [link("hinge", axis=(0.0, 3.0, 4.0)), link("rigid", bodies=("one", SPACE), position=(0.0, 0.0, 0.0))]
    rows = np.vstack([rows_of(Water(), one) for one in links])
    mu = np.random.default_rng(2).normal(size=(2, 11))
    found = forces_of(links, rows, mu @ rows)
    assert found.shape == (2, 2, 6)
    assert found[:, 0, :3] == pytest.approx(mu[:, :3]) and found[:, 0, 3:] == pytest.approx(mu[:, 3:5] @ links[0].held)
    assert found[:, 1] == pytest.approx(mu[:, 5:])


class Bent(Water):
    """The same of bodies that bend: the second one's bow rises by its distance ahead, squared; a shape of both"""

    words, rigid = ("",) * 14, 12

    class Bow:
        def displacement(self, points):
            points = np.asarray(points, float)
            none = np.zeros_like(points[..., 0])
            return np.stack([none, none, points[..., 0] ** 2], axis=-1)

    class Both:
        def displacement(self, points):
            points = np.asarray(points, float)
            return np.stack([0 * points[..., 0], 2 * points[..., 0], 0 * points[..., 0]], axis=-1)

    modes = (
        Mode("bow", shape=Bow(), body=1, place=TWO.place, heading=TWO.heading),
        Mode("both", shape=Both(), body=0, on=(0, 1)),
    )
    rotation_center = (0.0, 0.0, 0.0)


def test_shapes_move_and_turn_the_point_of_a_joint_with_half_their_curl():
    """At (4, 1, 0.5) of the scene, (−2, 6, 0.5) of the second, whose x runs along y of the scene: it rises by x² = 4
    and turns about its own y by −x = 2, which is −x of the scene; both move together by 2x along y and turn by 1"""
    rows = rows_of(Bent(), link("rigid"))
    assert rows.shape == (6, 14) and rows[:, :12] == pytest.approx(rows_of(Water(), link("rigid")))
    assert rows[:, 12] == pytest.approx([0, 0, 4.0, -2.0, 0, 0], abs=1e-6)
    assert rows[:, 13] == pytest.approx(np.zeros(6), abs=1e-6)  # the same of both
    alone = rows_of(Bent(), link("rigid", bodies=(SPACE, "one")))
    assert alone[:, 12] == pytest.approx(np.zeros(6)) and alone[:, 13] == pytest.approx(
        [0, 8.0, 0, 0, 0, 1.0], abs=1e-6
    )


@pytest.mark.parametrize("unit", [1e-12, 1.0, 1e12])
def test_rows_repeat_each_other_whatever_their_unit(unit):
    """Singular values of 1e-9 of the largest: a row that deviates from the sum of two by twice or half as much"""
    rows = np.eye(4)[:3] * unit
    for share, repeats in ((2e-9, False), (0.5e-9, True)):
        rows[2] = rows[0] + rows[1]
        across = np.linalg.svd(rows)[1][0] * np.array([0, 0, 0, 1.0])
        rows[2] += share * 3**0.5 * across  # the smallest singular value is 1/√3 of it
        if repeats:
            with pytest.raises(ValueError, match="hinges and links fix 2 motions with 3 constraints"):
                free_of(rows)
        else:
            assert free_of(rows).shape == (4, 1)
