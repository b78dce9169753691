"""Waves sent far away, of one point of a hull and its images, by hand."""

import numpy as np
import pytest

from hakobune.bem.kochin import far_field_integrals


@pytest.mark.parametrize("images, signs", [
    ([(1, 1), (1, -1)], [1, -1]), ([(1, 1), (-1, 1)], [1, 1]), ([(1, 1), (-1, 1), (1, -1), (-1, -1)], [1, -1, 1, -1]),
])  # fmt: skip
def test_waves_of_a_point_and_its_images_and_their_slopes_are_those_of_the_definition(images, signs):
    """∬ (φ ∂ψ/∂n − ψ ∂φ/∂n) dS with ψ = Z exp(−ik(x cos θ + y sin θ)); of its slope, ∂ψ/∂θ = ik(x sin θ − y cos θ) ψ"""
    k, area, theta = 0.3, 2.0, np.array([0.4, 2.9, 5.0])
    x, n, Z, images = np.array([3.0, -2.0, -1.0]), np.array([0.6, 0.3, -0.7]), (0.8, 0.2), np.array(images)
    signs, phi, velocity = np.array(signs), 0.7 - 0.2j, 0.3 + 0.9j
    value, slope = 0, 0
    for (sx, sy), sign in zip(images, signs, strict=True):
        cos, sin = sx * np.cos(theta), sy * np.sin(theta)
        wave = np.exp(-1j * k * (x[0] * cos + x[1] * sin))
        turned = 1j * k * (x[0] * sx * np.sin(theta) - x[1] * sy * np.cos(theta))
        normal = n[2] * Z[1] - 1j * k * (n[0] * cos + n[1] * sin) * Z[0]
        turned_normal = -1j * k * (-n[0] * sx * np.sin(theta) + n[1] * sy * np.cos(theta)) * Z[0]
        flow = phi * normal - Z[0] * velocity
        value = value + sign * area * wave * flow
        slope = slope + sign * area * wave * (turned * flow + phi * turned_normal)
    one = x[None], np.array([area]), n[None], np.array([Z])
    found = far_field_integrals(theta, k, *one, images, signs, np.array([[phi]]), np.array([[velocity]]))
    assert found[0][0] == pytest.approx(value, rel=1e-12) and found[1][0] == pytest.approx(slope, rel=1e-12)
