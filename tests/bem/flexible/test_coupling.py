"""Mass and restoring: of rigid motions the classical matrices, of bending those by hand."""

import numpy as np
import pytest

from hakobune.bem.flexible.beams import Beam
from hakobune.bem.flexible.coupling import gradients, inertia, of_water, of_weight

LENGTH, BEAM, DRAFT, RHO, G = 40.0, 8.0, 3.0, 1000.0, 9.81
S, W = np.polynomial.legendre.leggauss(24)


def box_points():
    """Points and area vectors of the wetted sides of a box"""
    points, areas = [], []
    half = np.array([LENGTH / 2, BEAM / 2, DRAFT / 2])
    for axis, side in ((0, -1), (0, 1), (1, -1), (1, 1), (2, -1)):
        a, b = (i for i in range(3) if i != axis)
        p = np.zeros((len(S), len(S), 3))
        p[..., axis], p[..., a], p[..., b] = side * half[axis], half[a] * S[:, None], half[b] * S
        points.append(p.reshape(-1, 3) - (0, 0, DRAFT / 2))
        n = np.zeros((len(S) ** 2, 3))
        n[:, axis] = side * half[a] * half[b] * np.outer(W, W).ravel()
        areas.append(n)
    return np.concatenate(points), np.concatenate(areas)


def restoring(motions, height):
    """Of a box whose mass lies along a line at z = height"""
    points, areas = box_points()
    line = np.stack([LENGTH / 2 * S, np.zeros_like(S), np.full_like(S, height)], axis=1)
    masses = RHO * BEAM * DRAFT * LENGTH / 2 * W
    made = [(np.array([m(p) for m in motions]), np.array([gradients(m, p, LENGTH) for m in motions]))
            for p in (points, line)]  # fmt: skip
    water = of_water(*made[0], points[:, 2], areas, RHO, G)
    return water + of_weight(*made[1], masses, G), inertia(made[1][0], masses)


def rigid(d):
    unit = np.eye(3)[d % 3]
    return (lambda p: np.broadcast_to(unit, p.shape)) if d < 3 else (lambda p: np.cross(unit, p))


def test_rigid_motions_have_the_classical_restoring():
    C, _ = restoring([rigid(d) for d in range(6)], -0.7)
    volume = LENGTH * BEAM * DRAFT
    heights = [side**2 / 12 / DRAFT - DRAFT / 2 + 0.7 for side in (BEAM, LENGTH)]  # GM of roll and pitch
    expected = np.diag([0, 0, RHO * G * LENGTH * BEAM, *(RHO * G * volume * GM for GM in heights), 0])
    assert np.abs(C - expected).max() < 1e-6 * expected.max()


def test_bending_is_held_by_the_waterplane_and_by_weight_and_buoyancy_about_the_axis():
    """C = ρgB ∫ w² + ρgBd (z_B − z₀ − (z_G − z₀)) ∫ w′², closed under pressure alone for w″ terms and ends together

    By Gauss's theorem over the body ∬ (w + z ∇·u) u·n dS = ∫ ∇·((w + z ∇·u) u) dV less the waterplane.
    """
    one = Beam("vertical bending", 2, -LENGTH / 2, LENGTH / 2, -1.1, 1.0, 1.0)
    C, M = restoring([rigid(2), rigid(4), one.displacement], -0.7)
    x, w = LENGTH / 2 * S, LENGTH / 2 * W
    z, wz = DRAFT / 2 * (S - 1), DRAFT / 2 * W
    f, f1, f2, f3 = (one.along(x, k)[:, None] for k in range(4))
    arm = z + 1.1
    # (w + zD) u with D = −arm w″ and u = (−arm w′, 0, w): divergence term by term
    inside = -arm * f1 * (f1 - z * arm * f3) + f * (-arm * f2 - z * f2) + (f - z * arm * f2) * (-arm * f2)
    top = (f * f)[:, 0] @ w
    by_hand = RHO * G * BEAM * (top - w @ inside @ wz) - RHO * BEAM * DRAFT * G * 0.4 * (f1[:, 0] ** 2 @ w)
    assert C[2, 2] == pytest.approx(by_hand, rel=1e-8)
    assert C[0, 2] == pytest.approx(0, abs=1e-8 * C[2, 2])
    assert M[2, 2] == pytest.approx(RHO * BEAM * DRAFT * ((f[:, 0] ** 2 + (0.4 * f1[:, 0]) ** 2) @ w))
