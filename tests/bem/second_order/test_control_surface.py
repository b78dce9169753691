"""The quadratic part of forces of pairs by momentum through a surface around the body, without its pressure."""

from dataclasses import replace

import numpy as np
import pytest
from bench.control_surface import by_momentum
from exact.second_order_cylinder import quadratic_force

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.second_order import surface_near
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

LENGTH, BEAM, DRAFT, DEPTH = 100.0, 50.0, 10.0, 20.0
RHO, G, VOLUME = 1025.0, 9.80665, LENGTH * BEAM * DRAFT
OMEGA = [0.5, 0.65, 0.8]
ARMS = np.array([1, 1, LENGTH / 2])


def floating(panels):
    inertia = RHO * VOLUME * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
    stiffness = RHO * G * np.diag([0, 0, LENGTH * BEAM, 15.83 * VOLUME, 78.33 * VOLUME, 0])
    mesh = box(LENGTH, BEAM, DRAFT, panels=panels)
    return PanelProblem(mesh, depth=DEPTH, inertia_matrix=inertia, hydrostatic_stiffness=stiffness)


def apart(found, right):
    return np.abs(found - right).max() / np.abs(right).max()


def test_on_the_cylinder_on_the_bed_it_is_the_exact_force_of_its_eigenfunctions():
    radius, errors = 10.0, []
    exact = np.array([[quadratic_force(radius, DEPTH, one, two) for two in OMEGA] for one in OMEGA])
    for side in (4, 8):
        problem = PanelProblem(buoy(radius, DEPTH, counts=(side, 1, side), bottom=False), depth=DEPTH)
        errors.append(apart(by_momentum(problem, OMEGA, 0.0, False)[0][..., 0], exact))
    assert errors[1] < 5e-3 and errors[1] < 0.5 * errors[0]


@pytest.mark.parametrize("moving", [False, True])
def test_pressure_on_the_hull_approaches_it_with_more_panels(moving):
    errors = []
    for panels in (120, 500):
        control, pressure, _ = by_momentum(floating(panels), OMEGA, np.radians(150), moving)
        errors.append(apart(pressure / ARMS, control / ARMS))
    assert errors[1] < 0.01 and errors[1] < 0.5 * errors[0]


def test_at_resonance_what_the_far_field_adds_to_pairs_brings_them_nearer_to_it():
    """Afloat in deep water, pitch and roll resonant between the frequencies: all pairs, as far apart as there are"""
    problem = floating(380)
    problem = replace(problem, lid=lid(problem.mesh), depth=100.0)
    control, *found = by_momentum(problem, np.linspace(0.4, 1.2, 7), np.radians(150), True)
    pressure, stored = (apart(values / ARMS, control / ARMS) for values in found)
    assert stored < 0.01 and stored < 0.5 * pressure


def test_it_is_hermitian_the_far_fields_drift_at_equal_frequencies_and_the_same_on_a_wider_surface(monkeypatch):
    found = []
    for beyond in (2.0, 4.0):
        monkeypatch.setattr(surface_near, "SIDES_BEYOND", beyond)
        control, _, with_far_field = by_momentum(floating(300), OMEGA, np.radians(150), True)
        each = np.arange(len(OMEGA))
        assert apart(control[each, each] / ARMS, with_far_field[each, each] / ARMS) < 2e-3
        assert apart(control.swapaxes(0, 1).conj(), control) < 1e-12
        found.append(control / ARMS)
    assert apart(found[1], found[0]) < 0.01
