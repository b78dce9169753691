"""Panels as elements: bilinear functions are met everywhere on them, integrals of polynomials by their rules."""

import numpy as np
import pytest

from hakobune.bem.panels.elements import elements, quadrature
from hakobune.meshing.panels import PanelMesh

QUAD = PanelMesh([[1, 2, -3], [4, 2.5, -3], [4.5, 5, -3], [0.5, 4, -3]], [[3, 2, 1, 0]])


def test_axes_are_a_right_handed_set_with_the_normal_last():
    e = elements(QUAD)
    x, y, n = e.axes[0]
    assert n == pytest.approx([0, 0, -1]) and np.cross(x, y) == pytest.approx(n)
    v = QUAD.vertices[0]
    along = v[1] + v[2] - v[0] - v[3]
    assert x == pytest.approx(along / np.linalg.norm(along))
    assert e.origins[0] == pytest.approx(QUAD.centroids[0])
    back = e.origins[0] + e.corners[0] @ e.axes[0, :2]
    assert back == pytest.approx(v)
    assert e.normals == pytest.approx(np.tile(n, (4, 1))) and e.sizes == pytest.approx(QUAD.sizes)


@pytest.mark.parametrize("per_panel", [4, 1])
def test_weights_add_up_to_the_area(per_panel):
    e = elements(QUAD, per_panel)
    assert e.weights.sum() == pytest.approx(QUAD.areas[0]) and len(e.nodes) == per_panel
    if per_panel == 1:
        assert e.nodes[0] == pytest.approx(QUAD.centroids[0])
    assert e.weights @ e.nodes == pytest.approx(QUAD.areas[0] * QUAD.centroids[0], rel=1e-9)


def bilinear(e, points):
    """1 + 2x − 3y + xy/2 in the axes of the panel"""
    x, y = ((points - e.origins[0]) @ e.axes[0, :2].T).T
    return 1 + 2 * x - 3 * y + 0.5 * x * y


def test_a_bilinear_function_given_at_the_nodes_is_met_at_every_point():
    e = elements(QUAD)
    assert e.inverse[0] @ bilinear(e, e.nodes) == pytest.approx([1, 2, -3, 0.5])
    q = quadrature(QUAD, e, 2, 5)
    assert q.points.shape == (1, 4 + 25, 3)
    assert q.shape[0] @ bilinear(e, e.nodes) == pytest.approx(bilinear(e, q.points[0]))
    for part in (slice(0, 4), slice(4, None)):
        assert q.weights[0, part].sum() == pytest.approx(QUAD.areas[0])


def test_integrals_of_polynomials_over_a_quadrilateral_are_those_of_its_triangles():
    """∬ x² y of 5 x 5 points, by the exact rule of seven points of degree five on both triangles"""
    e = elements(QUAD)
    q = quadrature(QUAD, e, 5)
    a, b = (6 - np.sqrt(15)) / 21, (6 + np.sqrt(15)) / 21
    rule = [(1 / 3, 1 / 3, 9 / 40)]
    for t, w in ((a, (155 - np.sqrt(15)) / 1200), (b, (155 + np.sqrt(15)) / 1200)):
        rule += [(t, t, w), (1 - 2 * t, t, w), (t, 1 - 2 * t, w)]
    total, v = 0.0, QUAD.vertices[0]
    for i, j, k in ((0, 1, 2), (0, 2, 3)):
        area = 0.5 * np.linalg.norm(np.cross(v[j] - v[i], v[k] - v[i]))
        for s, t, w in rule:
            p = v[i] + s * (v[j] - v[i]) + t * (v[k] - v[i])
            total += area * w * p[0] ** 2 * p[1]
    assert q.weights[0] @ (q.points[0, :, 0] ** 2 * q.points[0, :, 1]) == pytest.approx(total, rel=1e-12)
