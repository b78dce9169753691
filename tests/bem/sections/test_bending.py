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
    """A plate without draft, as theirs: nine shapes within 1 %, as many as the waves ask for to 1e-3; eight at the
    draft of its weight"""
    found, energy = ends_and_middle()
    assert found == pytest.approx(PUBLISHED, rel=3e-4) and energy == pytest.approx(1.0, abs=1e-7)
    errors = [np.abs(ends_and_middle(shapes=n)[0] / PUBLISHED - 1).max() for n in (6, 9, 14)]
    assert errors[0] > 2 * errors[1] and errors[1] < 0.01 and errors[2] < 1.5e-3
    assert ends_and_middle(shapes=8, draft=None)[0] == pytest.approx(PUBLISHED, rel=0.01)


@pytest.mark.parametrize("period", [0.8, 2.875])
def test_more_shapes_than_waves_ask_for_change_little(period):
    """Twelve waves along the strip, or one and a half"""
    omega = 2 * np.pi / period
    few, more = (bending_strip(10.0, 471.0, 8.36, 1.1, omega, count=3, shapes=n, **WATER) for n in (None, 70))
    assert np.abs(few.deflection) == pytest.approx(np.abs(more.deflection), abs=3e-3)


def test_a_strip_that_does_not_bend_is_rigid():
    stiff, _ = ends_and_middle(rigidity=1e13)
    assert stiff == pytest.approx(ends_and_middle(shapes=0)[0], rel=1e-6)
