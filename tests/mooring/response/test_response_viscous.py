"""Viscous roll damping in irregular waves."""

import numpy as np
import pytest

from bem.viscous import Quadratic, yamashita_roll
from mooring.environment.sea import Sea
from mooring.environment.spectra import issc
from mooring.environment.spreading import WrappedNormal
from mooring.response.linear import frequencies
from mooring.response.sea_state import sea_state
from mooring.response.viscous import linearised

BEAM = np.pi / 2  # seas on the side
ROLL = 3


@pytest.mark.filterwarnings("ignore")
def test_damping_in_a_narrow_short_crested_sea_is_that_of_a_sum_over_directions_of_a_degree(box_body):
    """√(8/π) σ_v N₂ with σ_v summed here; steps of 10° have 2 % of it wrong"""
    drag, spectrum, spread = 5e9, issc(4.0, mean_period=10.0), np.radians(4.0)
    sea = Sea(spectrum, np.radians(75.0), WrappedNormal(spread))
    damped, damping = linearised(box_body, sea, {"Roll": Quadratic(drag)})
    omega = frequencies(damped, spectrum.density)
    away = np.radians(np.arange(-30.0, 30.5))
    share = np.exp(-0.5 * (away / spread) ** 2)
    roll = np.abs(damped.motions(omega, sea.direction + away)[..., ROLL]) ** 2 @ (share / share.sum())
    velocity = np.sqrt(np.trapezoid(omega**2 * roll * spectrum.density(omega), omega))
    assert damping[ROLL, ROLL] == pytest.approx(np.sqrt(8 / np.pi) * velocity * drag, rel=1e-3)


def in_sea(body, height, laws):
    sea = Sea(issc(height, mean_period=10.0), BEAM)
    damped, damping = linearised(body, sea, laws)
    state = sea_state(damped, sea, 3600.0)
    return state.moments.m0[ROLL], state.moments.m2[ROLL], damping[ROLL, ROLL]


@pytest.mark.filterwarnings("ignore")
def test_damping_is_that_of_the_motion_it_leaves(box_body):
    """N = √(8/π) σ_v N₂ for quadratic drag, whatever the spectrum"""
    drag = 5e9
    _, m2, damping = in_sea(box_body, 4.0, {"Roll": Quadratic(drag)})
    assert damping == pytest.approx(np.sqrt(8 / np.pi) * np.sqrt(m2) * drag, rel=1e-4)


@pytest.mark.filterwarnings("ignore")
def test_roll_grows_slower_than_the_waves(box_body):
    laws = {"Roll": yamashita_roll(100.0, 50.0, 10.0, 1025.0)}
    small, large = (np.sqrt(in_sea(box_body, height, laws)[0]) for height in (2.0, 6.0))
    assert np.sqrt(3.0) < large / small < 3.0  # quadratic drag alone would give √3, none 3


@pytest.mark.filterwarnings("ignore")
def test_without_drag_nothing_changes(box_body):
    sea = Sea(issc(4.0, mean_period=10.0), BEAM)
    damped, damping = linearised(box_body, sea, {"Roll": Quadratic(0.0)})
    assert not damping.any()
    assert np.array_equal(damped.damping, box_body.damping)
