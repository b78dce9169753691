"""Shapes of a free-free beam: ends without load, orthogonality, the integrals that are given in closed form."""

import numpy as np
import pytest

from hakobune.bem.flexible.beams import BENDING, KINDS, Beam, half_turns, second

S, W = np.polynomial.legendre.leggauss(60)
X, W = 2 + 5 * S, 5 * W


def beam(kind, number):
    return Beam(kind, number, -3.0, 7.0, 0.5, 2.0, 3.0)


def test_wavenumbers_are_those_of_textbooks():
    """βL of free-free beams: 4.73004, 7.85320, 10.99561"""
    assert [2 * half_turns(n) for n in (1, 2, 3)] == pytest.approx([4.730041, 7.853205, 10.995608], rel=1e-6)


@pytest.mark.parametrize("number", [1, 2, 7, 30])
def test_ends_bear_nothing_and_shapes_carry_no_rigid_motion(number):
    one = beam("vertical bending", number)
    moment, shear = one.loads(np.array([-3.0, 7.0]))
    assert moment == pytest.approx(0, abs=1e-9 * one.stiffness) and shear == pytest.approx(0, abs=1e-9 * one.stiffness)
    if number < 30:
        assert one.along(X) @ W == pytest.approx(0, abs=1e-10) and (X * one.along(X)) @ W == pytest.approx(0, abs=1e-10)
    assert one.along(7.0) == pytest.approx(1.0)


@pytest.mark.parametrize("kind", KINDS)
def test_mass_and_stiffness_are_the_integrals(kind):
    first, other = beam(kind, 1), beam(kind, 4)
    bent = 2 if kind in BENDING else 1
    for one in (first, other):
        assert one.mass == pytest.approx(3 * one.along(X) ** 2 @ W)
        assert one.stiffness == pytest.approx(2 * one.along(X, bent) ** 2 @ W)
    assert first.along(X) * other.along(X) @ W == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_slopes_are_derivatives(kind):
    one, h = beam(kind, 3), 1e-5
    for slope in (0, 1, 2):
        rough = (one.along(X + h, slope) - one.along(X - h, slope)) / (2 * h)
        assert one.along(X, slope + 1) == pytest.approx(rough, abs=1e-8)


@pytest.mark.parametrize("kind, way, axis", [
    ("vertical bending", (0, 0, 1), (0, -1, 0)), ("horizontal bending", (0, 1, 0), (0, 0, 1)),
    ("torsion", (0, 0, 0), (1, 0, 0)),
])  # fmt: skip
def test_sections_stay_plane_and_turn_with_the_slope_of_their_axis(kind, way, axis):
    """u = w ê + ω × (p − p₀), ω = w′ about the axis across, in torsion the twist itself; w′ by differences"""
    beam, h = Beam(kind, 2, -3.0, 7.0, 0.5, 2.0, 3.0), 1e-5
    points = np.array([[1.2, 0.8, -2.0], [-2.5, -0.7, 0.9], [6.1, 1.9, 0.5], [0.4, 0.0, 3.0]])
    x = points[:, 0]
    w = beam.along(x)
    turn = w if kind == "torsion" else (beam.along(x + h) - beam.along(x - h)) / (2 * h)
    arm = points * [0, 1, 1] - [0, 0, 0.5]
    wanted = np.outer(w, way) + np.cross(np.outer(turn, axis), arm)
    assert beam.displacement(points) == pytest.approx(wanted, rel=1e-6, abs=1e-8)
    assert beam.turn(x) == pytest.approx(np.outer(turn, axis), rel=1e-6, abs=1e-8)
    assert beam.displacement(points.reshape(2, 2, 3)) == pytest.approx(beam.displacement(points).reshape(2, 2, 3))


@pytest.mark.parametrize("kind", KINDS)
def test_one_shape_by_itself_shortens_the_axis_and_turns_its_sections(kind):
    """ω (ω·a) − ω² a, of bending and the axis less by ∫ w′² dx from its middle; w′ by differences, a from the axis"""
    one, h = Beam(kind, 2, -3.0, 7.0, 0.5, 2.0, 3.0), 1e-5
    points = np.array([[1.2, 0.8, -2.0], [-2.5, -0.7, 0.9], [6.1, 1.9, 0.5]])
    x, arm = points[:, 0], points * [0, 1, 1] - [0, 0, 0.5]
    slope = (one.along(x + h) - one.along(x - h)) / (2 * h)
    turn = {"vertical bending": np.outer(slope, [0, -1, 0]), "horizontal bending": np.outer(slope, [0, 0, 1]),
            "torsion": np.outer(one.along(x), [1, 0, 0])}[kind]  # fmt: skip
    wanted = turn * np.sum(turn * arm, axis=1)[:, None] - np.sum(turn**2, axis=1)[:, None] * arm
    if kind in BENDING:
        for i, end in enumerate(x):
            s, w = np.polynomial.legendre.leggauss(40)
            at = 0.5 * (2.0 + end) + 0.5 * (end - 2.0) * s
            steep = (one.along(at + h) - one.along(at - h)) / (2 * h)
            wanted[i, 0] -= 0.5 * (end - 2.0) * (w @ steep**2)
    found = second([one], points)
    assert found.shape == (1, 1, 3, 3) and found[0, 0] == pytest.approx(wanted, rel=1e-5, abs=1e-7)


def test_products_of_two_shapes_are_what_their_sum_has_beyond_each():
    """U(a + b) = U_aa + 2 U_ab + U_bb, of turns that add up"""
    a, b = Beam("vertical bending", 1, -3.0, 7.0, 0.5, 2.0, 3.0), Beam("torsion", 2, -3.0, 7.0, 0.5, 2.0, 3.0)
    points = np.array([[1.2, 0.8, -2.0], [-2.5, -0.7, 0.9]])
    U = second([a, b], points)
    assert U[0, 1] == pytest.approx(U[1, 0])
    turn = a.turn(points[:, 0]) + b.turn(points[:, 0])
    arm = points * [0, 1, 1] - [0, 0, 0.5]
    whole = turn * np.sum(turn * arm, axis=1)[:, None] - np.sum(turn**2, axis=1)[:, None] * arm
    assert (U[0, 0] + 2 * U[0, 1] + U[1, 1])[:, 1:] == pytest.approx(whole[:, 1:], abs=1e-12)
