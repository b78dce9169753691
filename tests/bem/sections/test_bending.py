"""A strip that bends: published amplitudes, energy, and the limit of a rigid one."""

import numpy as np
import pytest

from hakobune.bem.sections.bending import bending_strip

OMEGA = 2 * np.pi / 1.429
WATER = {"density": 1000.0, "gravity": 9.81}
PUBLISHED = 1.2204, 0.5177, 1.1523  # weather edge, middle, lee edge: Wu, Watanabe & Utsunomiya (1995)


def ends_and_middle(rigidity=471.0, **more):
    found = bending_strip(10.0, rigidity, 8.36, 1.1, OMEGA, count=3, **WATER, **more)
    return np.abs(found.deflection), abs(found.reflection) ** 2 + abs(found.transmission) ** 2


def test_the_strip_of_wu_watanabe_and_utsunomiya():
    """Eight shapes at the draft of its weight within 1 %; a plate without draft, as theirs, with all shapes to 3e-4"""
    eight, energy = ends_and_middle()
    assert eight == pytest.approx(PUBLISHED, rel=0.01)
    assert energy == pytest.approx(1.0, abs=1e-7)
    assert ends_and_middle(shapes=20, draft=2e-4)[0] == pytest.approx(PUBLISHED, rel=3e-4)


def test_a_strip_that_does_not_bend_is_rigid():
    stiff, _ = ends_and_middle(rigidity=1e13)
    assert stiff == pytest.approx(ends_and_middle(shapes=0)[0], rel=1e-6)
