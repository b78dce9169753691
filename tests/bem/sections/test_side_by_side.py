"""Sections side by side: the resonance of the water in their gap."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from hakobune.bem.sections.any_section import any_section
from hakobune.bem.sections.outline import rectangle
from hakobune.bem.sections.side_by_side import side_by_side

G, DEPTH = 9.81, 0.5
SECTION = rectangle(0.5, 0.5).wetted(0.252)


def at(kh, damping, apart=0.55):
    omega = np.sqrt(G * kh / DEPTH * np.tanh(kh))
    return side_by_side([(SECTION, -apart / 2), (SECTION, apart / 2)], DEPTH, omega, damping, gravity=G)


@pytest.mark.parametrize(("damping", "gain"), [(0.0, 18.0), (0.02, 10.0), (0.05, 6.0)])
def test_gain_of_a_gap_of_five_centimetres(damping, gain):
    """Sections 0.5 m wide and 0.252 m deep in 0.5 m of water, those of Saitoh's tests: resonance at kh 1.571"""
    found = minimize_scalar(lambda kh: -at(kh, damping).gains[0], bounds=(1.5, 1.65), method="bounded",
                            options={"xatol": 1e-4})  # fmt: skip
    assert -found.fun == pytest.approx(gain, rel=0.01)
    assert found.x == pytest.approx(1.571, rel=1e-3 if damping == 0 else 0.01)


def test_what_is_not_reflected_or_transmitted_the_gap_takes():
    """|R|² + |T|² + taken = 1, the loss by the work that the lid's pressure does on the water below it"""
    for damping in (0.0, 0.05, 0.5):
        one = at(1.56, damping)
        assert abs(one.reflection) ** 2 + abs(one.transmission) ** 2 + one.taken == pytest.approx(1, abs=1e-6)
        assert (one.taken > 0.05) == (damping > 0)


def test_a_section_alone_is_that_of_one_section():
    omega = 4.0
    one, alone = side_by_side([(SECTION, 0.3)], DEPTH, omega, gravity=G), any_section(SECTION, DEPTH, omega, gravity=G)
    assert abs(one.transmission) == pytest.approx(abs(alone.transmission), rel=1e-5) and len(one.gains) == 0


def test_sections_that_touch_and_negative_damping_are_refused():
    with pytest.raises(ValueError, match="m; leave a gap between them"):
        at(1.5, 0.0, apart=0.5)
    with pytest.raises(ValueError, match=r"damping is -0\.1; allowed: 0 or more"):
        at(1.5, -0.1)
