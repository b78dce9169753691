"""Patches of B-splines: flat ones of known corners, a parabola, their panels and what is refused."""

import numpy as np
import pytest

from hakobune.meshing.curved import splines
from hakobune.meshing.curved.splines import panelled


def plane(length, width, place=(0.0, 0.0, 0.0)):
    """Numbers of one span of order 2 each way: a rectangle `length` along u (x), `width` along v (y)"""
    x, y, z = place
    corners = [(x, y, z), (x + length, y, z), (x, y + width, z), (x + length, y + width, z)]  # u first
    return [1, 1, 2, 2, 0, 0, 1, 1, 0, 0, 1, 1, *np.ravel(corners)]


def test_panels_are_as_long_as_wide_and_as_many_as_asked_for(monkeypatch):
    """Two rectangles, 8 × 2 and 2 × 1 m, of 18 m² and 72 panels in all: 0.5 m each"""
    monkeypatch.setattr(splines, "PANELS", 72)
    numbers = np.array(plane(8.0, 2.0) + plane(2.0, 1.0, (0.0, 5.0, -1.0)))
    points, corners = panelled(numbers, 2)
    assert len(corners) == 16 * 4 + 4 * 2 and len(points) == 17 * 5 + 5 * 3
    sides = np.linalg.norm(np.diff(points[corners], axis=1), axis=2)
    assert sides == pytest.approx(np.full(sides.shape, 0.5))
    assert points[:3, 1].tolist() == [0.0, 0.5, 1.0] and points[5].tolist() == [0.5, 0.0, 0.0]
    assert points[17 * 5].tolist() == [0.0, 5.0, -1.0] and corners.max() == len(points) - 1
    a, b, _, d = points[corners[0]]
    assert np.cross(b - a, d - a)[2] < 0  # v × u: out of the body where u × v goes into it


def test_one_patch_is_cut_into_whole_panels(monkeypatch):
    """7 × 2 m with 10 panels: 1.183 m, six and two of them"""
    monkeypatch.setattr(splines, "PANELS", 10)
    points, corners = panelled(np.array(plane(7.0, 2.0)), 1)
    assert len(corners) == 12 and np.unique(points[:, 0]) == pytest.approx(np.linspace(0, 7, 7))


def test_a_narrow_patch_beside_a_wide_one_has_one_panel_across(monkeypatch):
    monkeypatch.setattr(splines, "PANELS", 4)
    numbers = np.array(plane(8.0, 8.0) + plane(0.5, 0.1, (9.0, 0.0, 0.0)))
    assert len(panelled(numbers, 2)[1]) == 2 * 2 + 1


def test_a_spline_of_order_three_is_a_parabola_evenly_cut_in_its_parameter():
    """z = u² of Bézier points 0, 0, 1 and x = 2u, over the knots of WAMIT, KUG of each end"""
    points = [(0, 0, 0), (1, 0, 0), (2, 0, 1), (0, 3, 0), (1, 3, 0), (2, 3, 1)]
    spline, end = splines._patch(np.array([1, 1, 3, 2, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1, *np.ravel(points), 99.0]), 0)
    assert end == 4 + 6 + 4 + 18
    grid = splines._grid(spline, 4, 2)
    u = np.linspace(0, 1, 5)
    assert grid.shape == (5, 3, 3) and grid[:, 1] == pytest.approx(np.stack([2 * u, np.full(5, 1.5), u**2], axis=1))
    chords = np.linalg.norm(np.diff(np.stack([2 * u, u**2], axis=1), axis=0), axis=1).sum()
    assert splines._sides(grid) == pytest.approx([chords, 3.0])


def test_two_spans_have_a_knot_between_and_the_longest_line_counts():
    """Of order 2, knots 0 0 1 3 3: the second span is twice as long in its parameter; a trapezium, 4 m at its foot"""
    points = [(0, 0, 0), (1, 0, 0), (4, 0, 0), (0, 2, 0), (1, 2, 0), (2, 2, 0)]
    spline, _ = splines._patch(np.array([2, 1, 2, 2, 0, 0, 1, 3, 3, 0, 0, 1, 1, *np.ravel(points)]), 0)
    grid = splines._grid(spline, 3, 1)
    assert grid[:, 0, 0].tolist() == [0, 1, 2.5, 4] and grid[:, 1, 0].tolist() == [0, 1, 1.5, 2]
    assert splines._sides(grid) == pytest.approx([4.0, np.hypot(2.0, 2.0)])


@pytest.mark.parametrize("numbers, patches, says", [
    (plane(1, 1), 0, "0 patches; allowed: 1 or more"), (plane(1, 1)[:-1], 1, "it ends within a patch"),
    (plane(1, 1), 2, "it ends within a patch"), (plane(0, 0), 1, "its patches have no size"),
    ([0, *plane(1, 1)[1:]], 1, "a patch has [0, 1] spans and order [2, 2]; allowed: 1 or more of each"),
    ([1, 1, 2, 0, *plane(1, 1)[4:]], 1, "a patch has [1, 1] spans and order [2, 0]; allowed: 1 or more of each"),
])  # fmt: skip
def test_what_is_no_patch_is_refused(numbers, patches, says):
    panelled(np.array(plane(1, 1)), 1)
    with pytest.raises(ValueError) as refused:
        panelled(np.array(numbers, float), patches)
    assert says in str(refused.value)
