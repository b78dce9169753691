"""Natural periods of a body beside water in a gap, an oscillator of its own: the root below or above its resonance."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.bem import DOFS
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.pipelines.solve.report import beyond_gap_water

WATER, DAMPING = 0.5, 0.1  # rad/s, and its ratio


def added(w):
    """Added mass of water that moves with the body, over the mass of the body: that of a damped oscillator"""
    return WATER**2 * (WATER**2 - w**2) / ((WATER**2 - w**2) ** 2 + (2 * DAMPING * WATER * w) ** 2)


def beside_water(stiffness):
    """Of mass 1 in all motions, and with that water in heave"""
    mass = np.diag([0.0, 0, 1, 0, 0, 0])
    return SimpleNamespace(
        omega=np.linspace(0.05, 3.0, 120), inertia=np.eye(6), stiffness=np.diag([0, 0, stiffness, 4.0, 9.0, 0]),
        turning=np.arange(6) > 2, free=None, names=DOFS, knows_added_mass=lambda w: np.ones(len(w), bool),
        held_added_mass=lambda w: added(np.asarray(w))[:, None, None] * mass,
    )  # fmt: skip


@pytest.mark.parametrize(("stiffness", "low", "high", "told"), [(0.5, 0.05, 0.45, False), (1.2, 0.6, 3.0, True)])
def test_a_period_beyond_the_resonance_of_gap_water_is_told(stiffness, low, high, told):
    """A spring stiffer than ω²(1 + A) anywhere below that resonance has its root beyond it; roll and pitch, which the
    water leaves alone, are not told
    """
    below = np.linspace(0.0, WATER, 5001)
    assert bool(stiffness > (below**2 * (1 + added(below))).max()) is told
    root = brentq(lambda w: stiffness - w**2 * (1 + added(w)), low, high)
    body = beside_water(stiffness)
    found = natural_periods(body)
    assert 2 * np.pi / found.period[2] == pytest.approx(root, rel=1e-6)
    negative = body.omega[added(body.omega) < -1][0]
    assert found.water[2] == negative and np.isnan(found.water[[0, 1, 3, 4, 5]]).all()
    said = beyond_gap_water(SimpleNamespace(bodies=(), modes=(), reader=body))
    assert len(said) == told
    if told:
        assert said[0].startswith(f"natural periods of heave {2 * np.pi / root:.4g} s lie beyond")
        assert f"negative from {negative:.3g} rad/s" in said[0]


def test_without_such_water_nothing_is_told():
    body = beside_water(1.2)
    body.held_added_mass = lambda w: np.zeros((len(w), 6, 6))
    assert np.isnan(natural_periods(body).water).all()
    assert beyond_gap_water(SimpleNamespace(bodies=(), modes=(), reader=body)) == ()
