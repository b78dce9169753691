"""Shapes of a free-free beam: ends without load, orthogonality, the integrals that are given in closed form."""

import numpy as np
import pytest

from hakobune.bem.flexible.beams import BENDING, KINDS, Beam, half_turns

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
    first, second = beam(kind, 1), beam(kind, 4)
    bent = 2 if kind in BENDING else 1
    for one in (first, second):
        assert one.mass == pytest.approx(3 * one.along(X) ** 2 @ W)
        assert one.stiffness == pytest.approx(2 * one.along(X, bent) ** 2 @ W)
    assert first.along(X) * second.along(X) @ W == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_slopes_are_derivatives(kind):
    one, h = beam(kind, 3), 1e-5
    for slope in (0, 1, 2):
        rough = (one.along(X + h, slope) - one.along(X - h, slope)) / (2 * h)
        assert one.along(X, slope + 1) == pytest.approx(rough, abs=1e-8)
