"""Generic current coefficients of a loaded tanker beside OCIMF's curves, and their form."""

import numpy as np
import pytest

from hakobune.mooring.loads.ship_derivatives import tanker_current

LENGTH, BEAM, DRAFT = 329.3, 51.8, 19.2  # m, 250 000 dwt

# OCIMF, Mooring Equipment Guidelines (2nd edition, 1997), figures 2.5 and 2.6, depth 1.1 drafts, as read in its
# appendix D (170°) and by a public spreadsheet: angle, C_ya, C_yf
READ = [(170, 0.175, 0.45), (160, 0.35, 0.94), (100, 1.35, 1.415), (80, 1.57, 1.26), (60, 1.41, 0.88), (40, 1.1, 0.45)]


def test_forces_are_near_those_of_ocimf_in_shallow_water():
    found = tanker_current(LENGTH, BEAM, DRAFT, 1.1 * DRAFT)
    assert found.curve(np.pi)[0] == pytest.approx(-0.035, rel=0.05)
    for angle, aft, forward in READ:
        _, side, turn = found.curve(np.radians(angle))
        assert side == pytest.approx(aft + forward, rel=0.05 if angle in (80, 100, 60) else 0.3), angle
        if angle not in (80, 100):  # the lever passes 0 there
            assert turn == pytest.approx(0.5 * (forward - aft), rel=0.3), angle


def test_shallow_water_multiplies_the_side_force_and_leaves_the_force_along():
    """Abeam 0.22 √(L² A_m/(B V)) in deep water, 3.2 aground; A_m = 0.99 B T, V = 0.83 L B T"""
    deep, ground = tanker_current(200.0, 32.0, 12.0, np.inf), tanker_current(200.0, 32.0, 12.0, 12.0)
    abeam = 0.5 * np.pi
    assert deep.curve(abeam)[1] == pytest.approx(0.22 * np.sqrt(0.99 * 200.0 / (0.83 * 32.0)))
    assert ground.curve(abeam)[1] == pytest.approx(3.2)
    assert ground.curve(0.7)[0] == pytest.approx(deep.curve(0.7)[0])
    assert "in deep water" in deep.notes[0] and "in water of 1 drafts" in ground.notes[0]
    with pytest.raises(ValueError, match="depth is 11 m; allowed: at least the draft 12 m"):
        tanker_current(200.0, 32.0, 12.0, 11.0)
