"""Forces on a pile over a wave, in closed form."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.waves import wavenumber
from hakobune.mooring.loads.morison import circular
from hakobune.mooring.loads.over_wave import Member, over_wave, wet_part
from hakobune.mooring.loads.regular_wave import RegularWave

PHASES = np.linspace(0, 2 * np.pi, 180, endpoint=False)


def pile(C_D, C_M=2.0, width=1.2, top=3.0):
    return Member("pile", circular(width, C_D, C_M), np.array([0.0, 0.0, -12.0]), np.array([0.0, 0.0, top]))


def test_inertia_of_a_pile_in_a_low_wave_is_the_closed_form():
    """F = ρ g a C_M π/4 D² tanh kh, ahead of the crest by a quarter; M about the foot from ∫ (z + h) cosh k(z + h)"""
    wave, h = RegularWave(1e-4, 0.8, 0.0, 12.0), 12.0
    force, k = over_wave(pile(0.0), wave, PHASES, 1025.0), float(wavenumber(0.8, 12.0))
    unit = 1025 * 9.80665 * 1e-4 * 2 * np.pi / 4 * 1.2**2
    assert force[:, 0].max() == pytest.approx(unit * np.tanh(k * h), rel=1e-4)
    assert np.degrees(PHASES[force[:, 0].argmax()]) == 270
    arm = h * np.sinh(k * h) / k - (np.cosh(k * h) - 1) / k**2
    assert force[:, 4].max() == pytest.approx(unit * k * arm / np.cosh(k * h), rel=1e-4)


def test_drag_of_a_pile_in_a_current_is_the_hand_calculation():
    from hakobune.mooring.environment.current_profile import uniform

    wave = RegularWave(0.0, 1.0, 0.0, 12.0, uniform(1.5, np.pi / 2))
    force = over_wave(pile(0.9), wave, PHASES[:2], 1025.0)
    assert np.allclose(force[:, :3], [0, 0.5 * 1025 * 0.9 * 1.2 * 12 * 1.5**2, 0], atol=1e-6)


def test_a_pile_is_wet_up_to_the_surface():
    wave = RegularWave(1.5, 0.8, 0.0, 12.0)
    for phase in (0.0, 1.0, np.pi):
        start, end = wet_part(*pile(1.0)[2:], wave, phase)
        assert start[2] == -12.0 and end[2] == pytest.approx(1.5 * np.cos(phase), abs=1e-9)
    assert wet_part(np.array([0, 0, 2.0]), np.array([0, 0, 5.0]), wave, 0.0) is None


@pytest.mark.parametrize("level", [0.0, 1.5])
def test_a_member_is_wet_below_the_surface_from_whichever_end_it_is_given(level):
    wave = SimpleNamespace(elevation=lambda place, phase: np.full(len(place), level))
    low, high = np.array([1.0, 2.0, -6.0]), np.array([5.0, 2.0, 2.0])
    cut = low + (level + 6.0) / 8.0 * (high - low)
    assert wet_part(low, high, wave, 0.0) == (pytest.approx(low), pytest.approx(cut))
    assert wet_part(high, low, wave, 0.0) == (pytest.approx(cut), pytest.approx(low))
    assert wet_part(low, low - 1.0, wave, 0.0) == (pytest.approx(low), pytest.approx(low - 1.0))
    assert wet_part(high + 1.0, high, wave, 0.0) is None
