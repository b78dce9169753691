"""Layers of logarithms and dipoles on panels, against adaptive integration of the same polynomial densities."""

import warnings

import numpy as np
import pytest
from scipy.integrate import quad

from hakobune.bem.sections.outline import Edge
from hakobune.bem.sections.product_integration import NODES, T, layers, panels_of

EDGES = [Edge(-1 + 0j, 2 + 0.5j), Edge(2 + 0.5j, 3 + 2j, np.tan(np.pi / 10)), Edge(3 + 2j, 2 + 4j, -0.3)]
DENSITY = np.polynomial.Polynomial([0.7, -1.1, 0.4, 0.9])  # of t, −1 … 1 along each panel
FAR = [5 - 3j, -4 + 1j]
NEAR = [0.5 + 0.3j, 0.5 + 0.2501j, 2.6 + 1.2j, 2.9 + 3.0j, -1.05 - 0.02j]


def by_quad(edge, p, density=DENSITY):
    def point(t):
        return complex(edge.at((t + 1) / 2)), complex(edge.slope((t + 1) / 2)) / 2

    def single(t):
        x, slope = point(t)
        return density(t) * np.log(abs(x - p)) * abs(slope)

    def double(t):
        x, slope = point(t)
        return density(t) * -(slope / (x - p)).imag

    nearest = 2 * min(np.linspace(0, 1, 2001), key=lambda u: abs(complex(edge.at(u)) - p)) - 1
    options = {"points": [nearest], "limit": 400, "epsabs": 1e-13, "epsrel": 1e-13}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of 1e-13, where p lies on the panel
        return quad(single, -1, 1, **options)[0], quad(double, -1, 1, **options)[0]


def test_panels_are_straight_or_arcs_with_gauss_points():
    panels = panels_of(EDGES)
    assert panels.points[0] == pytest.approx(0.5 + 0.25j + (1.5 + 0.25j) * T)
    assert panels.speed == pytest.approx([edge.length / 2 for edge in EDGES])
    assert panels.weights.sum(axis=1) == pytest.approx([edge.length for edge in EDGES])
    assert np.abs(panels.points[1] - panels.center[1]) == pytest.approx(abs(EDGES[1].start - EDGES[1].center))
    assert panels.angle == pytest.approx([0, 4 * np.pi / 10, -4 * np.arctan(0.3)])


@pytest.mark.parametrize("p", [*FAR, *NEAR])
def test_layers_are_their_integrals_from_afar_and_near_by(p):
    single, double = layers(panels_of(EDGES), np.array([p]))
    values = np.tile(DENSITY(T), 3).reshape(3, NODES)
    for m, edge in enumerate(EDGES):
        row = slice(m * NODES, (m + 1) * NODES)
        exact = by_quad(edge, p)
        assert single[0, row] @ values[m] == pytest.approx(exact[0], abs=2e-9)
        assert double[0, row] @ values[m] == pytest.approx(exact[1], abs=2e-9)


def test_on_a_panel_the_dipole_is_that_of_its_curvature_alone():
    """∂/∂n ln|τ − p| of two points of an arc is ½ of its curvature, of n to its left −½; of a straight line nothing"""
    panels = panels_of(EDGES)
    targets = panels.points.reshape(-1)
    own = np.repeat(np.arange(3), NODES)
    single, double = layers(panels, targets, own)
    for m, edge in enumerate(EDGES):
        row = slice(m * NODES, (m + 1) * NODES)
        whole = double[row, row].sum(axis=1)
        assert whole == pytest.approx(-edge.angle / 2, abs=1e-12)  # −½ (1/R) of R φ
        for i in (0, 4):
            exact = by_quad(edge, targets[m * NODES + i])[0]
            assert single[m * NODES + i, row] @ DENSITY(T) == pytest.approx(exact, abs=1e-7)
    # and of the neighbours as from any other point
    exact = by_quad(EDGES[1], targets[3])
    assert single[3, NODES : 2 * NODES] @ DENSITY(T) == pytest.approx(exact[0], abs=2e-9)
    assert double[3, NODES : 2 * NODES] @ DENSITY(T) == pytest.approx(exact[1], abs=2e-9)


def test_a_closed_curve_is_seen_under_the_whole_circle_from_inside_and_under_none_from_outside():
    """∮ ∂/∂n ln r dl = −2π, n to the left, into the curve"""
    circle = panels_of([Edge(-2 + 0j, 2 + 0j, 1.0), Edge(2 + 0j, -2 + 0j, 1.0)])
    double = layers(circle, np.array([0.3 + 0.4j, 1.9 + 0.1j, 2.2 + 0.3j]))[1].sum(axis=1)
    assert double == pytest.approx([-2 * np.pi, -2 * np.pi, 0.0], abs=1e-7)  # 2.6^(−20) is 5e-9


def test_beyond_an_ellipse_of_half_axes_of_2_6_half_lengths_in_all_the_rule_of_gauss_is_used():
    """Both rules agree to 1e-8 there; within it, the polynomial's is another number"""
    panel, weights = panels_of([Edge(-1 + 0j, 1 + 0j)]), np.polynomial.legendre.leggauss(NODES)[1]
    for total, same in ((2.55, False), (2.65, True), (2.8, True)):
        p = 1j * (total - 1 / total) / 2
        single, double = layers(panel, np.array([p]))
        gauss = weights * np.log(np.abs(T - p)), -weights * np.imag(1 / (T - p))
        for found, known in zip((single[0], double[0]), gauss, strict=True):
            assert bool(np.abs(found - known).max() < 1e-14) is same
            assert found.sum() == pytest.approx(known.sum(), abs=2e-8)
