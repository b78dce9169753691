"""Shapes given at points: what a spline has to reproduce, and the directions in which points say something."""

import numpy as np
import pytest
import scipy.interpolate
from scipy.interpolate import RBFInterpolator

from hakobune.bem.flexible.tables import Table

RNG = np.random.default_rng(3)
CORNERS = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])


def at(points, function=lambda p: p):
    return Table(points, function(points))


@pytest.mark.parametrize("thick, width, directions", [
    (1.0, 1.0, 3), (1.1e-6, 1.0, 3), (0.9e-6, 1.0, 2), (0.0, 1.0, 2), (0.0, 1.1e-6, 2), (0.0, 0.9e-6, 1),
    (0.0, 0.0, 1),
])  # fmt: skip
def test_points_extend_in_directions_of_more_than_a_millionth_of_the_largest_wherever_they_lie(
    thick, width, directions
):
    for middle in ([0.0, 0, 0], [3.0, -50.0, 7.0]):
        assert at(CORNERS * [1.0, width, thick] + middle).dimensions == directions


def test_a_straight_field_is_reproduced_everywhere_and_kept_in_the_shape_of_the_points():
    """Rigid motions and strain: u = a + Bx"""
    B, a, points = RNG.normal(size=(3, 3)), RNG.normal(size=3), RNG.normal(size=(20, 3)) + [5.0, 0, 0]
    one = at(points, lambda p: a + p @ B.T)
    asked = RNG.normal(size=(2, 3, 3)) * 4
    assert one.displacement(asked) == pytest.approx(a + asked @ B.T) and one.dimensions == 3


def test_across_a_plane_or_a_line_a_shape_stays_the_same():
    plane = np.array([[x, y, -2.0] for x in np.linspace(0, 9, 7) for y in (-1.0, 0.0, 1.5)])
    one = at(plane, lambda p: np.stack([0 * p[:, 0], 0 * p[:, 0], p[:, 0] ** 2 + p[:, 1]], axis=1))
    assert one.displacement(plane + [0, 0, 5.0]) == pytest.approx(one.displacements)
    line = np.array([[x, 4.0, -2.0] for x in np.linspace(0, 9, 7)])
    beam = at(line, lambda p: np.stack([0 * p[:, 0], 0 * p[:, 0], p[:, 0] ** 2], axis=1))
    assert beam.displacement(line + [0, 3.0, 5.0]) == pytest.approx(beam.displacements)
    between = beam.displacement([[0.75, 4.0, -2.0]])[0, 2]
    exact = RBFInterpolator(line[:, :1], line[:, 0] ** 2, kernel="cubic", degree=1)(np.array([[0.75]]))[0]
    assert between == pytest.approx(exact)


def test_the_error_is_the_largest_difference_from_a_spline_of_first_powers_over_the_largest_displacement():
    points = RNG.uniform(-1, 1, size=(30, 3)) + [2.0, 0, 0]
    u = np.stack([np.sin(points[:, 0]), points[:, 1] ** 2, 3 * np.cos(points[:, 0])], axis=1)
    asked = RNG.uniform(-1, 1, size=(8, 3)) + [2.0, 0, 0]
    both = [RBFInterpolator(points, u, kernel=kernel, degree=1)(asked) for kernel in ("linear", "cubic")]
    gap = np.linalg.norm(both[0] - both[1], axis=1).max() / np.linalg.norm(u, axis=1).max()
    assert Table(points, u).error(asked) == pytest.approx(gap, rel=1e-6)


@pytest.mark.parametrize("count, nearest", [(1500, None), (1501, 60)])
def test_more_than_fifteen_hundred_points_count_where_they_are_near(monkeypatch, count, nearest):
    seen = []

    class Spline:
        def __init__(self, points, values, neighbors, kernel, degree):
            seen.append((len(points), neighbors, kernel, degree))

        def __call__(self, points):
            return np.zeros((len(points), 3))

    monkeypatch.setattr(scipy.interpolate, "RBFInterpolator", Spline)
    one = at(RNG.normal(size=(count, 3)))
    one.displacement(np.zeros((1, 3)))
    one.error(np.zeros((1, 3)))
    assert seen == [(count, nearest, "cubic", 1), (count, nearest, "linear", 1)] or seen == [
        (count, nearest, kernel, 1) for kernel in ("cubic", "linear")
    ]
