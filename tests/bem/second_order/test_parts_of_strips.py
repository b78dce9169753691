"""Strips of water beside a hull piece by piece: rules, derivatives, angles where they end, sides of a waterline."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.second_order.surface_near import _angles, _derivative, _known, _radau, _sides
from hakobune.meshing.shapes import box, buoy


@pytest.mark.parametrize("count", [2, 3, 6])
def test_a_rule_of_gauss_and_radau_has_an_end_and_integrates_2n_minus_2_powers(count):
    x, w = _radau(count)
    assert x[0] == -1.0 and np.all(np.diff(x) > 0) and x[-1] < 1.0
    for power in range(2 * count - 1):
        assert np.sum(w * x**power) == pytest.approx((1 - (-1) ** (power + 1)) / (power + 1), abs=1e-12)


def test_derivatives_at_points_are_those_of_the_polynomial_through_them():
    x = np.array([-1.0, -0.3, 0.2, 0.9])
    assert _derivative(x) @ (2 - x + 3 * x**3) == pytest.approx(-1 + 9 * x**2)


@pytest.mark.parametrize("spread", [0.0, 0.4, 1.0])
def test_strips_end_between_rays_from_the_middle_and_those_of_the_ellipse(spread):
    """Of half axes 4 and 2 m about (1, −1): atan2(y/2, x/4) for atan2(y, x), and how they turn along a side"""
    circle = SimpleNamespace(half=np.array([4.0, 2.0]), centre=np.array([1.0, -1.0]))
    points, slope = np.array([[3.0, 1.0], [-2.0, 0.5], [0.0, -2.5]]), np.array([[0.5, -1.0], [1.0, 1.0], [-1.0, 0.2]])

    def angle(p):
        x, y = p[:, 0] - 1.0, p[:, 1] + 1.0
        ray, other = np.arctan2(y, x), np.arctan2(y / 2, x / 4)
        return ray + spread * np.angle(np.exp(1j * (other - ray)))

    found, turn = _angles(points, slope, circle, spread)
    assert found == pytest.approx(angle(points))
    step = 1e-6
    assert turn == pytest.approx((angle(points + step * slope) - angle(points - step * slope)) / (2 * step), rel=1e-6)


BOX = box(10, 6, 2, panels=80)


@pytest.mark.parametrize("hull, around", [(BOX, 32.0), (BOX.whole(), 32.0), (buoy(4, 3, panels=60), 8 * np.pi)])
def test_sides_along_the_waterline_run_round_the_body(hull, around):
    panel, ends = _sides(hull)
    start, end = ends[:, 0], ends[:, 1]
    assert np.all(start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0] > 0)  # counter-clockwise
    assert np.linalg.norm(end - start, axis=1).sum() * hull.copies == pytest.approx(around, rel=0.02)
    assert np.all(np.abs(hull.vertices[panel][..., 2]).min(axis=1) == 0)
    with pytest.raises(
        ValueError, match="the free-surface forcing needs a hull with a waterline; allowed: --level body"
    ):
        _sides(hull.moved(0, 0, -1.0))


@pytest.mark.parametrize("kind, graded", [
    (0, lambda x: (1 + x) / 2), (-1, lambda x: ((1 + x) / 2) ** 3), (1, lambda x: 1 - ((1 - x) / 2) ** 3),
])  # fmt: skip
def test_points_of_a_waterline_are_known_by_their_side_and_where_they_are_dense(kind, graded):
    """Two rows on one panel, one of which lies on the side; in whichever order"""
    x = np.polynomial.legendre.leggauss(4)[0]
    order = np.array([2, 0, 3, 1])
    start, end = np.array([1.0, 2.0]), np.array([4.0, 6.0])
    on = (start + graded(x)[:, None] * (end - start))[order]
    other = on + [0.5, -0.3]
    line = SimpleNamespace(points=np.stack([other, on, on])[..., :2], panels=np.array([7, 7, 9]))
    known, dense = _known([7], [(start, end)], line)
    assert dense.tolist() == [kind] and known.tolist() == [(4 + np.argsort(order)).tolist()]


@pytest.mark.parametrize("above", [True, False])
def test_a_millionth_of_the_draft_below_the_surface_is_still_the_waterline(above):
    """5 m of draft: 4 µm below, and 6 µm"""
    hull = box(10, 6, 5, panels=40).moved(0, 0, -4e-6 if above else -6e-6)
    if above:
        assert len(_sides(hull)[0])
    else:
        with pytest.raises(ValueError, match="needs a hull with a waterline"):
            _sides(hull)
