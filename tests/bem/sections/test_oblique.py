"""Waves at an angle with a rectangle: the laws of waves and forces, the normal ones as their limit, shallow water."""

import numpy as np
import pytest

from hakobune.bem.sections.coefficients import section
from hakobune.bem.waves import group_factor

RHO, G = 1025.0, 9.80665
SIZES = np.array([1.0, 1.0, 5.0])


@pytest.mark.parametrize("degrees", [0.05, 30, 60, 85])
@pytest.mark.parametrize(("depth", "omega"), [(6.0, 0.9), (30.0, 1.2)])
def test_energy_reciprocity_haskind_and_radiated_power_hold_at_every_angle(depth, omega, degrees):
    found = section(10.0, 5.0, depth, omega, tolerance=1e-8, obliquity=np.radians(degrees))
    assert abs(found.transmission) ** 2 + abs(found.reflection) ** 2 == pytest.approx(1, abs=1e-10)
    assert found.haskind == pytest.approx(found.excitation, rel=1e-8)
    n = group_factor(found.k, depth) * np.cos(np.radians(degrees))
    assert found.damping.diagonal() == pytest.approx(2 * RHO * G * n / (found.k * omega) * abs(found.radiated) ** 2)
    impedance = (found.added_mass + 1j * found.damping / omega) / np.outer(SIZES, SIZES)
    assert abs(impedance - impedance.T).max() < 1e-10 * abs(impedance).max()


def test_normal_waves_are_the_limit_at_second_order_in_the_angle():
    normal, misses = section(10.0, 5.0, 10.0, 0.9, tolerance=1e-8), []
    for angle in (0.04, 0.02, 0.01):
        found = section(10.0, 5.0, 10.0, 0.9, tolerance=1e-8, obliquity=angle)
        misses.append([abs(found.transmission - normal.transmission), abs(found.added_mass - normal.added_mass)[1, 1]])
    orders = np.log2(np.divide(misses[:-1], misses[1:]))
    assert np.all(abs(orders - 2) < 0.1), orders


def test_long_waves_pass_under_as_depth_averaged_flow_does():
    """φ_yy = κ²φ under the keel, φ_yy + (k² − κ²)φ = 0 beside it, φ and the flow through the depth continuous"""
    depth, draft, angle, misses = 1.0, 0.5, np.radians(50), []
    for b in (16.0, 32.0, 64.0):  # kb the same, so that only the ends of the gap become less
        omega = 0.8 / b * np.sqrt(G * depth)
        found = section(2 * b, draft, depth, omega, tolerance=1e-8, obliquity=angle)
        across, along = found.k * np.cos(angle), found.k * np.sin(angle)
        under = (depth - draft) * along * np.array([np.tanh(along * b), 1 / np.tanh(along * b)])
        even, odd = (1j * across * depth + under) / (1j * across * depth - under)
        misses.append(abs(abs(found.transmission) - abs(even - odd) / 2))
    orders = np.log2(np.divide(misses[:-1], misses[1:]))
    assert misses[0] < 0.02 and orders == pytest.approx([1, 1], abs=0.15), (misses, orders)


def test_waves_that_run_along_are_refused():
    with pytest.raises(ValueError, match=r"obliquity is 90°; allowed: up to ±89\.9"):
        section(10.0, 5.0, 10.0, 0.9, obliquity=np.pi / 2)
    with pytest.raises(ValueError, match="in deep water; allowed: obliquity 0, or a finite depth"):
        section(10.0, 5.0, np.inf, 0.9, obliquity=0.5)
