"""What points of the body feel."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_body import made_up_body

from hakobune.bem.waves import wavenumber
from hakobune.mooring.response import points
from hakobune.mooring.response.points import (
    Point,
    acceleration,
    corners_of_bottom,
    displacement,
    elevations,
    felt_acceleration,
    of_point,
    transfer_functions,
    velocity,
)


def test_displacement_is_that_of_the_rotation_matrix_to_first_order():
    """Re[X e^(−iωt)] at one instant, as a small rigid motion of the point; the second order is below 1e-6."""
    from scipy.spatial.transform import Rotation

    motion = np.array([[[0.1, -0.2, 0.3, 2e-4, -3e-4, 4e-4]]])
    center, position = np.array([1.0, 2.0, -3.0]), np.array([50.0, -25.0, 10.0])
    turned = Rotation.from_rotvec(motion[0, 0, 3:]).apply(position - center) + center - position
    assert np.allclose(displacement(motion, position, center)[0, 0], motion[0, 0, :3] + turned, atol=2e-5)


def test_velocity_and_acceleration_are_time_derivatives():
    w, X, t, dt = 0.7, 0.4 - 0.3j, 1.3, 1e-4
    x = [np.real(X * np.exp(-1j * w * (t + s * dt))) for s in (-1, 0, 1)]
    v, a = velocity(np.array([w]), np.array([[X]])), acceleration(np.array([w]), np.array([[X]]))
    assert np.isclose(np.real(v[0, 0] * np.exp(-1j * w * t)), (x[2] - x[0]) / (2 * dt), rtol=1e-6)
    assert np.isclose(np.real(a[0, 0] * np.exp(-1j * w * t)), (x[2] - 2 * x[1] + x[0]) / dt**2, rtol=1e-5)


def test_water_stays_at_its_mark_on_a_body_that_follows_it():
    """Incident waves alone, of a body without far field, have amplitude 1 and the phase of their place"""
    body, omega, heading = made_up_body(), np.array([0.5, 0.7]), np.radians([20.0, 200.0])
    water, missed = elevations(body, omega, heading, body.motions(omega, heading), [(40.0, -20.0)])
    along = 40.0 * np.cos(heading) - 20.0 * np.sin(heading)
    assert missed is None and np.allclose(water[..., 0], np.exp(1j * np.outer(wavenumber(omega, 20.0), along)))


def test_water_stands_high_before_a_wall_and_low_behind_it(box_database):
    """A held box, 10 m deep in 20 m, in beam waves of 57 m: it reflects most of them"""
    body, omega, heading = box_database.reader.floating(), np.array([1.0]), np.radians([90.0])
    held, half = np.zeros((1, 1, 6)), np.pi / wavenumber(omega, body.depth)[0]
    water, missed = elevations(body, omega, heading, held, [(0.0, -25.0 - half), (0.0, 25.0 + half), (0.0, -20.0)])
    before, behind, on_deck = np.abs(water[0, 0])
    assert missed < 0.05 and before > 1.7 and behind < 0.5
    assert on_deck == pytest.approx(abs(elevations(body, omega, heading, held, [(0.0, -25.0)])[0][0, 0, 0]))


def test_beside_a_wall_waves_stand():
    """At the wall twice the height from any direction, a node a quarter of a wave before it in beam waves"""
    body, omega, wall = made_up_body(), np.array([0.5, 0.7]), -60.0
    beside = replace(body, between=replace(body.between, wall=wall))
    heading = np.radians([-90.0, -40.0])
    water, missed = elevations(beside, omega, heading, body.motions(omega, heading), [(0.0, wall), (35.0, wall)])
    assert missed is None and np.allclose(np.abs(water), 2.0)
    for w, k in zip(omega, wavenumber(omega, 20.0), strict=True):
        node = elevations(beside, np.array([w]), heading[:1], None, [(3.0, wall + np.pi / 2 / k)])[0]
        assert np.abs(node).max() < 1e-12


def test_table_of_transfer_functions_holds_motions_first_and_names_every_point():
    body, omega, heading = made_up_body(), np.array([0.5, 0.7]), np.radians([10.0, 200.0])
    table = transfer_functions(body, omega, heading, [Point("bow", (50.0, 0.0, 10.0))])
    assert table.value.shape == (2, 2, 18) and len(table.names) == len(table.units) == 18
    assert np.array_equal(table.value[..., :6], body.motions(omega, heading))
    x = table.value[..., table.names.index("bow displacement z")]
    assert np.allclose(x, table.value[..., 2] - 50.0 * table.value[..., 4])
    a = table.value[..., table.names.index("bow acceleration z")]
    assert np.allclose(a, -(omega[:, None] ** 2) * x)


def test_a_pendulum_feels_nothing_across_its_rope():
    """Rolling about a centre l above at ω² = g/l, and pitching: what swings freely feels no force across"""
    length, g = 9.0, 9.80665
    omega = np.array([np.sqrt(g / length)])
    for mode in (3, 4):
        motion = np.zeros((1, 1, 6), complex)
        motion[..., mode] = 0.1j
        d = displacement(motion, (0.0, 0.0, -length), np.zeros(3))
        assert np.allclose(felt_acceleration(omega, d, motion, g), 0, atol=1e-14)
        assert np.abs(acceleration(omega, d)[..., :2]).max() > 0.9


def test_corners_of_the_bottom_are_those_of_its_convex_hull():
    """A box with a raised bow: four corners of the flat bottom; a round bottom: points of its rim"""
    x, y = np.meshgrid(np.linspace(-50, 40, 10), np.linspace(-20, 20, 5))
    flat = np.stack([x.ravel(), y.ravel(), np.full(x.size, -10.0)], axis=1)
    bow = np.array([[50.0, 20.0, -5.0], [50.0, -20.0, -5.0], [50.0, 20.0, 0.0]])
    found = corners_of_bottom(np.concatenate([bow, flat]))
    assert sorted(map(tuple, found.tolist())) == [(-50, -20, -10), (-50, 20, -10), (40, -20, -10), (40, 20, -10)]
    angle = np.radians(np.arange(0, 360, 5))
    rim = corners_of_bottom(np.stack([8 * np.cos(angle), 8 * np.sin(angle), np.full(72, -3.0)], axis=1))
    assert len(rim) == 12 and np.allclose(np.hypot(rim[:, 0], rim[:, 1]), 8)


def test_a_point_of_a_body_that_bends_is_moved_and_turned_by_its_shapes_too(monkeypatch):
    """d = x + θ × r + Σ ξ u, θ and half the curl of u added; surge, sway and heave stay those of the body"""
    rng = np.random.default_rng(3)
    shifts, turns, motion = rng.normal(size=(3, 2)), rng.normal(size=(3, 2)), rng.normal(size=(4, 1, 8))
    monkeypatch.setattr(points, "of_shapes", lambda body, one, place: (shifts, turns))
    body = SimpleNamespace(bodies=(), modes=("first", "second"), rigid=6, rotation_center=np.array([1.0, 0.0, -2.0]))
    moved, own = of_point(body, motion, Point("P", (11.0, 3.0, 4.0)))
    arm = np.array([10.0, 3.0, 6.0])
    for found, turned, X in zip(moved[:, 0], own[:, 0], motion[:, 0], strict=True):
        assert found == pytest.approx(X[:3] + np.cross(X[3:6], arm) + shifts @ X[6:])
        assert turned == pytest.approx([*X[:3], *(X[3:6] + turns @ X[6:])])
