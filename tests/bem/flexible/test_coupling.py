"""Mass and restoring: of rigid motions the classical matrices, of bending those by hand."""

import numpy as np
import pytest

from hakobune.bem.flexible.beams import KINDS, Beam, second
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


def restoring(beams, height):
    """Of a box whose mass lies along a line at z = height: of its six rigid motions and of beams"""
    points, areas = box_points()
    motions = [rigid(d) for d in range(6)] + [one.displacement for one in beams]
    line = np.stack([LENGTH / 2 * S, np.zeros_like(S), np.full_like(S, height)], axis=1)
    masses = RHO * BEAM * DRAFT * LENGTH / 2 * W
    (u, slopes, pairs), made = (
        (np.array([m(p) for m in motions]), np.array([gradients(m, p, LENGTH) for m in motions]),
         second(beams, p) if beams else None)
        for p in (points, line)
    )  # fmt: skip
    water = of_water(u, slopes, points[:, 2], areas, RHO, G, 6, pairs)
    return water + of_weight(*made[:2], masses, G, 6, made[2]), inertia(made[0], masses)


def rigid(d):
    unit = np.eye(3)[d % 3]
    return (lambda p: np.broadcast_to(unit, p.shape)) if d < 3 else (lambda p: np.cross(unit, p))


def test_rigid_motions_have_the_classical_restoring():
    C, _ = restoring([], -0.7)
    volume = LENGTH * BEAM * DRAFT
    heights = [side**2 / 12 / DRAFT - DRAFT / 2 + 0.7 for side in (BEAM, LENGTH)]  # GM of roll and pitch
    expected = np.diag([0, 0, RHO * G * LENGTH * BEAM, *(RHO * G * volume * GM for GM in heights), 0])
    assert np.abs(C - expected).max() < 1e-6 * expected.max()


def test_a_beam_that_bends_up_and_down_has_the_second_derivative_of_its_potential_energy():
    """−ρg ∫ z dV of sections that stay plane about an axis that keeps its length, to second order in w, s = z_B − z₀:

    C_ij = ρgB ∫ w_i w_j + ρgBd s {[w_i w_j′ + w_j w_i′] − ∫ w_i′ w_j′} − mg (z_G − z₀) ∫ w_i′ w_j′
    """
    beams = [Beam("vertical bending", n, -LENGTH / 2, LENGTH / 2, -1.1, 1.0, 1.0) for n in (1, 2, 3)]
    C, M = restoring(beams, -0.7)
    ends = np.array([-LENGTH / 2, LENGTH / 2])
    line = LENGTH / 2 * S
    w = [lambda x: np.ones_like(x), lambda x: -x, *(one.along for one in beams)]
    w1 = [
        lambda x: np.zeros_like(x),
        lambda x: -np.ones_like(x),
        *(lambda x, one=one: one.along(x, 1) for one in beams),
    ]

    def over(f, g):
        return LENGTH / 2 * W @ (f(line) * g(line))

    s, section = -DRAFT / 2 + 1.1, RHO * G * BEAM * DRAFT
    by_hand = np.zeros((5, 5))
    for i, j in np.ndindex(5, 5):
        edge = np.array([-1, 1]) @ (w[i](ends) * w1[j](ends) + w[j](ends) * w1[i](ends))
        by_hand[i, j] = RHO * G * BEAM * over(w[i], w[j]) + section * (s * edge - (s + 0.4) * over(w1[i], w1[j]))
    own = [2, 4, 6, 7, 8]  # heave, pitch and shapes
    by_hand[1, 1] = RHO * G * BEAM * LENGTH**3 / 12 + section * LENGTH * (-DRAFT / 2 + 0.7)  # about the origin
    assert C[np.ix_(own, own)] == pytest.approx(by_hand, rel=1e-6, abs=1e-6 * by_hand[2, 2])
    assert M[6, 6] == pytest.approx(RHO * BEAM * DRAFT * (over(w[2], w[2]) + 0.4**2 * over(w1[2], w1[2])))


def test_shapes_of_all_kinds_leave_a_symmetric_matrix():
    """u_ij makes the part of water symmetric: each half of it is not"""
    beams = [Beam(kind, n, -LENGTH / 2, LENGTH / 2, -1.1, 1.0, 1.0) for kind in KINDS for n in (1, 2)]
    points, areas = box_points()
    u = np.array([one.displacement(points) for one in beams])
    slopes = np.array([gradients(one.displacement, points, LENGTH) for one in beams])
    rise = u[:, :, 2] + points[:, 2] * np.einsum("iqaa->iq", slopes)
    newman = rise @ np.einsum("jqa,qa->qj", u, areas)
    pressed = points[:, 2:] * areas
    whole = newman + np.einsum("ijqa,qa->ij", second(beams, points), pressed)
    whole -= np.einsum("iqab,jqb,qa->ij", slopes, u, pressed)
    assert np.abs(whole - whole.T).max() < 1e-8 * np.abs(whole).max()
