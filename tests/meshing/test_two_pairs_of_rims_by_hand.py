"""Free edges of panels as rings: which of them lie along another, of squares with unequal edges."""

import math
from itertools import pairwise

import numpy as np
import pytest

from hakobune.meshing.drawing import drawing_of
from hakobune.meshing.quality.seams import rings
from hakobune.meshing.shapes import box, buoy


def square(x, side, parts, level=0.0, turned=False):
    """Points of a square of `parts` edges a side, and its directed edges"""
    share = np.arange(parts) / parts
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    ways = [corners[k] + share[:, None] * (corners[(k + 1) % 4] - corners[k]) for k in range(4)]
    points = np.column_stack([side * np.concatenate(ways) + [x, 0.0], np.full(4 * parts, level)])
    count = len(points)
    edges = np.stack([np.arange(count), (np.arange(count) + 1) % count])
    return points, edges[::-1] if turned else edges


def joined(*parts):
    """Rings of squares beside each other"""
    points, starts, ends, before = [], [], [], 0
    for corners, (start, end) in parts:
        points.append(corners), starts.append(start + before), ends.append(end + before)
        before += len(corners)
    return rings(np.concatenate(points), np.concatenate(starts), np.concatenate(ends))


def of_ring(made, sizes):
    """The numbers of the rings of squares of so many edges, each of which is one"""
    ends = np.cumsum([0, *sizes])
    numbers = [set(made.number[a:b].tolist()) for a, b in pairwise(ends)]
    assert all(len(one) == 1 for one in numbers)
    return [one.pop() for one in numbers]


def test_each_of_two_pairs_of_rims_closes_a_slit_and_a_hole_stays_open():
    """Two rims of 2 and 3 edges a side around the same square run the opposite way: between them lies no water"""
    pairs = [square(0.0, 3.0, 2), square(0.0, 3.0, 3, 1e-4, True), square(9.0, 3.0, 2), square(9.0, 3.0, 3, 1e-4, True)]
    hole = square(20.0, 2.0, 2)
    made = joined(*pairs, hole)
    first, second, third, fourth, alone = of_ring(made, [8, 12, 8, 12, 8])
    assert sorted((first, second, third, fourth, alone)) == [0, 1, 2, 3, 4]
    assert made.seam[[first, second, third, fourth]].all() and not made.seam[alone]
    assert made.joint[first] == made.joint[second] and made.joint[third] == made.joint[fourth]
    assert len({made.joint[first], made.joint[third], made.joint[alone]}) == 3
    assert made.length[[first, fourth, alone]] == pytest.approx([12, 12, 8])
    same = joined(square(0.0, 3.0, 2), square(0.0, 3.0, 3, 1e-4))  # that run the same way are two holes
    assert not same.seam.any()


def test_copies_of_a_part_stand_in_equal_steps_about_the_vertical():
    ball = {"shape": "sphere", "center": [5.0, 0.0, -1.0], "radius": 1.0}
    made = drawing_of({"size": 1.0, "parts": [ball | {"turns": 4}, ball]})
    assert [turn for _, turn in made.parts] == pytest.approx([0, math.pi / 2, math.pi, 1.5 * math.pi, 0])
    assert (made.size, made.symmetry, made.around) == (1.0, "", 24)


@pytest.mark.parametrize("symmetry", ["z", "yx", "xx", "xyz"])
def test_shapes_have_mirror_planes_that_exist(symmetry):
    for make in (
        lambda: box(4.0, 2.0, 1.0, panels=50, symmetry=symmetry),
        lambda: buoy(4.0, 2.0, panels=50, symmetry=symmetry),
    ):
        with pytest.raises(ValueError, match="symmetry"):
            make()
    for good in ("", "x", "y", "xy"):
        assert box(4.0, 2.0, 1.0, counts=(1, 1, 1), symmetry=good).symmetry == good
        assert buoy(4.0, 2.0, counts=(4, 2, 1), symmetry=good).symmetry == good
