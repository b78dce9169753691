"""The convex hull of points in the plane, against the library's."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from hakobune.bem.algebra.convex_hull import convex_hull


def clouds():
    random = np.random.default_rng(3)
    angle = 2 * np.pi * np.arange(48) / 48
    side = np.linspace(-1, 1, 21)
    grid = np.stack(np.meshgrid(50 * side, 25 * side), axis=-1).reshape(-1, 2)
    yield "square", random.random((300, 2))
    yield "normal", random.normal(size=(2000, 2)) * [100, 3]
    yield "circle", 10 * np.stack([np.cos(angle), np.sin(angle)], axis=1) + [1e3, -400]
    yield "grid with points along its sides, each twice", np.concatenate([grid, grid])
    yield "turned grid", grid @ [[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]]
    yield "three points", np.array([[0.0, 0.0], [0.0, 2.0], [1.0, 0.0]])


@pytest.mark.parametrize("points", [pytest.param(p, id=name) for name, p in clouds()])
def test_corners_are_those_of_qhull_in_its_order(points):
    found, theirs = convex_hull(points), points[ConvexHull(points).vertices]
    first = np.argmin(np.linalg.norm(theirs - found[0], axis=1))
    np.testing.assert_allclose(found, np.roll(theirs, -first, axis=0), rtol=0, atol=1e-12 * np.ptp(points))


@pytest.mark.parametrize("size", [1.0, 1e-6, 1e6])
def test_points_that_rounding_keeps_apart_are_one_corner_whatever_the_unit(size):
    square = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])
    nearly = np.concatenate([square, square * (1 + 1e-15), square * [1, 1 - 1e-15]])
    assert len(convex_hull(size * nearly)) == 4
    flat = [[0.5, -1 - 1e-9]]  # which is a corner: a thousand times as far as rounding leaves it
    assert len(convex_hull(size * np.concatenate([square, flat]))) == 5


def test_points_on_one_line_are_refused():
    with pytest.raises(ValueError, match="5 points on one line"):
        convex_hull(np.outer(np.arange(5), [1.0, 2.0]))
