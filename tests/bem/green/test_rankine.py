"""Exact panel integrals against quadrature, the area and the solid angle."""

import numpy as np
import pytest

from hakobune.bem.green.rankine import panel_moments
from hakobune.bem.panels.elements import elements, quadrature
from hakobune.meshing.panels import PanelMesh, joined, structured

QUAD = np.array([[-1.0, -0.5], [1.2, -0.6], [0.9, 0.7], [-1.1, 0.4]])
TRIANGLE = np.array([[0.0, 0.0], [1.0, 0.1], [0.2, 0.9], [0.2, 0.9]])


def moments(point, corners):
    S, D = np.empty(4), np.empty(4)
    panel_moments(*point, corners, S, D)
    return S, D


@pytest.mark.parametrize("corners", [QUAD, TRIANGLE, QUAD * [10, 0.5]])
@pytest.mark.parametrize("point", [(0.3, 0.2, 0.5), (3.0, 1.0, -0.8), (10.0, -4.0, 3.0), (-2.0, 0.1, 0.3)])
def test_moments_agree_with_quadrature(corners, point):
    scale = np.ptp(corners, axis=0)
    point = np.array(point) * [*scale / 2, min(scale) / 2]
    mesh = PanelMesh(np.c_[corners, np.zeros(4)], [[0, 1, 2, 3]])
    element = elements(mesh)
    q = quadrature(mesh, element, 400)
    points = q.points[0]
    r = np.linalg.norm(point - points, axis=1)
    m = np.stack([np.ones_like(r), points[:, 0], points[:, 1], points[:, 0] * points[:, 1]])
    S, D = moments(point, corners)
    np.testing.assert_allclose(S, m @ (q.weights[0] / r), rtol=1e-6, atol=1e-9 * scale.max() ** 3)
    np.testing.assert_allclose(D, m @ (q.weights[0] * point[2] / r**3), rtol=1e-5, atol=1e-7 * scale.max() ** 2)


def test_far_away_the_source_integral_is_area_over_distance():
    S, _ = moments((3e4, 1e4, 2e4), QUAD)
    area = 2.33  # half the cross product of the diagonals
    assert S[0] * np.linalg.norm([3e4, 1e4, 2e4]) == pytest.approx(area, rel=4e-5)  # size over distance


@pytest.mark.parametrize("point, sides", [((0.0, 0.0), [(1.0, 1.0)]), ((0.5, 0.0), [(0.5, 1.0)] * 2),
                                          ((0.0, 0.25), [(1.0, 0.25), (1.0, 0.75)])])  # fmt: skip
@pytest.mark.parametrize("size", [1.0, 1e3, 1e-3])
def test_on_a_corner_and_on_an_edge_the_source_integral_is_that_of_the_rectangles_beside_it(point, sides, size):
    """∬ 1/r over a × b from a corner: a asinh(b/a) + b asinh(a/b); the solid angle of a point in its plane is 0"""
    S, D = moments((size * point[0], size * point[1], 0.0), size * np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]))
    assert S[0] == pytest.approx(size * sum(a * np.arcsinh(b / a) + b * np.arcsinh(a / b) for a, b in sides), rel=1e-12)
    assert np.all(np.isfinite(S)) and D[0] == 0.0


def cube(n):
    g = np.linspace(-1, 1, n + 1)
    a, b = np.meshgrid(g, g, indexing="ij")
    one = np.ones_like(a)
    faces = [(a, b, one), (b, a, -one), (one, a, b), (-one, b, a), (b, one, a), (a, -one, b)]
    return joined([structured(np.stack(f, axis=-1)) for f in faces])


@pytest.mark.parametrize("point, turns", [((0.2, 0.3, -0.1), -4), ((3.0, 1.0, 2.0), 0), ((1.0, 0.37, 0.21), -2)])
def test_closed_surface_subtends_the_whole_solid_angle_or_nothing(point, turns):
    mesh = cube(3)
    e = elements(mesh)
    total = 0.0
    for j in range(len(mesh)):
        S, D = np.empty(1), np.empty(1)
        panel_moments(*(e.axes[j] @ (np.array(point) - e.origins[j])), e.corners[j], S, D)
        total += D[0]
    assert total == pytest.approx(turns * np.pi, abs=1e-9)


def test_bilinear_functions_are_reproduced_by_the_nodes():
    mesh = PanelMesh(np.c_[QUAD, np.zeros(4)], [[0, 1, 2, 3]])
    e = elements(mesh)
    local = (e.nodes - e.origins[0]) @ e.axes[0].T
    f = 1 + 2 * local[:, 0] - local[:, 1] + 0.5 * local[:, 0] * local[:, 1]
    np.testing.assert_allclose(e.inverse[0] @ f, [1, 2, -1, 0.5], atol=1e-12)
