"""Long-period motion by quick rule and spectrum: oscillators and drag whose answers are known."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.loads.box_current import current_force
from hakobune.mooring.studies.conditions import Current, ExposedBox
from hakobune.mooring.studies.long_period import _drag_of, _one

HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
WATER = SimpleNamespace(density=1025.0, water_depth=20.0)


def body(mass, damping):
    """Surge alone, with constant coefficients"""
    return SimpleNamespace(
        inertia=np.full((6, 6), mass), omega=np.array([0.01, 2.0]), held_added_mass=lambda w: np.zeros((1, 6, 6)),
        coefficients=lambda w: (np.zeros((1, 6, 6)), np.full((1, 6, 6), damping)),
    )  # fmt: skip


def test_a_flat_spectrum_moves_an_oscillator_by_pi_S_over_2NK():
    m, K, N, S = 5e7, 8e5, 4e5, 1e10
    omega = np.linspace(0.0, 3.0, 60_001)[1:]
    period, nu, sigma = _one(body(m, N), K, 0, omega, np.full(len(omega), S), 0.0, lambda s: 0.0, 0.0)
    assert period == pytest.approx(2 * np.pi * np.sqrt(m / K))
    assert nu == pytest.approx(N / np.sqrt(m * K))
    assert sigma**2 == pytest.approx(np.pi * S / (2 * N * K), rel=2e-3)


def test_damping_of_the_drag_is_that_of_its_square_in_still_water_and_its_slope_in_a_current():
    sizes = HULL.length, HULL.beam, HULL.draft
    c = float(current_force(1.0, 0.0, *sizes, 1025.0, None, 20.0)[0])
    still, stream = _drag_of(None, HULL, WATER), _drag_of(Current(1.5, 0.0), HULL, WATER)
    assert still(0, 0.4) == pytest.approx(np.sqrt(8 / np.pi) * c * 0.4, rel=2e-2)  # |v|v has a corner, 24 nodes
    assert stream(0, 0.05) == pytest.approx(2 * c * 1.5, rel=1e-6)
    assert stream(1, 0.05) > 0 and stream(0, 1.0) > stream(0, 0.05)


def test_what_nothing_holds_has_no_period():
    assert np.isnan(_one(body(1.0, 1.0), 0.0, 0, np.ones(3), np.ones(3), 0.0, lambda s: 1.0, 0.0)).all()
