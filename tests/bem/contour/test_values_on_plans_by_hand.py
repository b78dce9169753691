"""Potentials and slopes at the nodes of a contour: polynomials carried from panels to panels, harmonics on a circle."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.contour.plan import potentials
from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.plan.panels import quarter_panels
from hakobune.bem.contour.plan.potentials import _differentiation, _panel_slope, _resampling, _trigonometric_slope

A, B = 4.0, 2.5
COARSE = quarter_panels(A, B, (0.5, 0.7), (1.5, 2.0), 6)
FINE = quarter_panels(A, B, (0.3, 0.2), (0.6, 0.5), 5)


def field(x, y):
    """Of third degree along either side, and not the same on both"""
    end = np.isclose(x, A)
    return np.where(end, 1.0 - y + 0.3 * y**3, 2.0 + 0.5 * x - 0.1 * x**2)


def slope(x, y):
    """∂/∂s along (−n₂, n₁): up the end, back along the side"""
    return np.where(np.isclose(x, A), -1.0 + 0.9 * y**2, -(0.5 - 0.2 * x))


def test_derivatives_at_nodes_are_those_of_the_polynomial_through_them():
    t = np.array([0.05, 0.3, 0.62, 0.9])
    assert _differentiation(t) @ (2 - t + 3 * t**3) == pytest.approx(-1 + 9 * t**2)
    assert _differentiation(t) @ np.ones(4) == pytest.approx(np.zeros(4), abs=1e-12)


def test_values_are_carried_from_one_set_of_panels_to_another():
    c, there = COARSE.contour, FINE.contour
    found = _resampling(COARSE, there)
    beyond = np.hypot(there.x - A, there.y - B) > 0.7  # the panels at the corner, which are cubic in t
    assert (found @ field(c.x, c.y))[beyond] == pytest.approx(field(there.x, there.y)[beyond], rel=1e-9)
    line = lambda x, y: 2.0 + 3.0 * x - 5.0 * y  # noqa: E731
    assert found @ line(c.x, c.y) == pytest.approx(line(there.x, there.y))
    assert found.sum(axis=1) == pytest.approx(np.ones(len(there.x)))
    t, wanted = (np.cbrt(np.where(part.nx > 0.5, B - part.y, A - part.x)) for part in (c, there))
    first = np.hypot(there.x - A, there.y - B) < np.where(there.nx > 0.5, 0.5, 0.7)  # t of the panels at the corner
    assert (found @ t)[first] == pytest.approx(wanted[first])


def test_slopes_on_panels_run_round_the_contour():
    c = FINE.contour
    away = np.hypot(c.x - A, c.y - B) > 0.3
    found = _panel_slope(FINE) @ field(c.x, c.y)
    assert found[away] == pytest.approx(slope(c.x, c.y)[away], rel=1e-6, abs=1e-8)
    line = _panel_slope(FINE) @ (2.0 + 3.0 * c.x - 5.0 * c.y)
    assert line == pytest.approx(np.where(c.nx > 0.5, -5.0, -3.0))
    own = _panel_slope(FINE)
    blocks = np.arange(len(c.x)) // 5
    assert not own[blocks[:, None] != blocks].any()  # each panel by itself


@pytest.mark.parametrize("cls", CLASSES)
def test_slopes_on_a_circle_are_those_of_its_harmonics(cls):
    plan = Circle(3.0)
    contour = plan.contour(0.0, 6, 1e-3)
    theta = np.arctan2(contour.y, contour.x)
    found = _trigonometric_slope(plan, cls, contour)
    for m in plan.orders(cls, 6):
        wave = (np.cos(m * theta), -m / 3.0 * np.sin(m * theta)) if cls[1] == 1 else (
            np.sin(m * theta), m / 3.0 * np.cos(m * theta))  # fmt: skip
        assert found @ wave[0] == pytest.approx(wave[1], abs=1e-9)


@pytest.mark.parametrize("cls", CLASSES)
def test_maps_at_the_nodes_of_a_circle_are_functions_times_their_numbers(cls):
    plan = Circle(3.0)
    contour = plan.contour(0.0, 6, 1e-3)
    numbers = np.random.default_rng(1).normal(size=(4, len(plan.orders(cls, 5)), len(plan.orders(cls, 5))))
    body = SimpleNamespace(plan=plan, outer_maps=lambda own, degree, top: numbers if own == cls else np.zeros(
        (4, len(plan.orders(own, 5)), len(plan.orders(own, 5)))))  # fmt: skip
    freq = SimpleNamespace(body=body, contour=contour, degree=5, top=9)
    found = potentials.plan_values(freq)
    assert set(found) == set(CLASSES)
    assert found[cls].maps == pytest.approx(plan.basis(cls, 5, contour) @ numbers)
    assert np.array_equal(found[cls].slope, _trigonometric_slope(plan, cls, contour))
