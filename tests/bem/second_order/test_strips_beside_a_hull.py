"""Strips of the free surface between a hull and the circle about it: their area, and where the hull is."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.second_order.surface_near import _sides, circle_about, strips_about
from hakobune.meshing.shapes import box

HULL = box(40.0, 20.0, 5.0, panels=80).whole()


def strips(mesh, k):
    """Strips of a mesh whose waterline is known at four Gauss points of each side"""
    panels, sides = _sides(mesh)
    x = (1 + np.polynomial.legendre.leggauss(4)[0]) / 2
    line = SimpleNamespace(points=sides[:, :1] + x[:, None] * (sides[:, 1] - sides[:, 0])[:, None], panels=panels)
    circle = circle_about(mesh)
    return circle, strips_about(mesh, line, circle, k)


@pytest.mark.parametrize("k", [0.05, 0.4])
def test_they_cover_what_lies_between_the_hull_and_the_circle(k):
    """πR² − L B, with points enough for waves of k"""
    circle, found = strips(HULL, k)
    area = sum(part.weights.sum() for part in found)
    assert area == pytest.approx(np.pi * circle.radius**2 - 40.0 * 20.0, rel=1e-6)


def test_a_hull_elsewhere_has_the_same_strips_there():
    """As many points along and across, with the same weights: sides are as long wherever they are"""
    (_, here), (_, there) = strips(HULL, 0.2), strips(HULL.moved(300.0, -200.0, 0.0), 0.2)
    assert len(here) == len(there)
    for one, other in zip(here, there, strict=True):
        assert one.weights.shape == other.weights.shape
        assert other.weights == pytest.approx(one.weights, rel=1e-9)
        assert other.points - [300.0, -200.0] == pytest.approx(one.points, abs=1e-8)


def test_a_side_has_two_points_and_one_for_each_radian_of_the_wave_along_it():
    """2 + kl rounded up, l the side or the arc of the circle behind it, from 3 to 9"""
    _, sides = _sides(HULL)
    circle = circle_about(HULL)
    length = np.hypot(*(sides[:, 1] - sides[:, 0]).T)
    start, end = (np.arctan2(*sides[:, i, ::-1].T) for i in range(2))
    arc = circle.radius * np.abs(np.angle(np.exp(1j * (end - start))))
    for k in (0.01, 0.3, 3.0):
        wanted = sorted(min(max(int(np.ceil(2 + k * max(pair))), 3), 9) for pair in zip(arc, length, strict=True))
        found = [s.weights.shape[1] for s in strips(HULL, k)[1] for _ in range(len(s.weights))]
        assert sorted(found) == wanted
