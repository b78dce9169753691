"""Frequencies chosen by the solver are read by the interpolant they were chosen for."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from hakobune.bem.database import open_database
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.sea_state import sea_state
from hakobune.pipelines.cli import main

WORDS = "box --length 100 --beam 50 --draft 10 --depth 20 --gyration 15.55,29.44,32.28 --heading 60"
SEA = Sea(issc(4.5, mean_period=10.0), np.radians(60.0))
ROLL = 3


def solved(path, omega):
    assert main([*WORDS.split(), "--omega", omega, "--output", str(path)]) == 0
    return open_database(path)


@pytest.mark.filterwarnings("ignore")
def test_a_dozen_chosen_frequencies_give_the_sea_state_of_forty_fixed_ones(tmp_path):
    """Motions, mean and slow drift and their moments to 0.1 %, where 0.4 % is asked for; cubics miss them by 3 %."""
    chosen, fixed = solved(tmp_path / "a.h5", "auto:0.25:1.3"), solved(tmp_path / "f.h5", "0.25:1.3:40")
    assert len(chosen.omega) < 20
    found, wanted = (sea_state(db.reader.floating(), SEA, 10800.0) for db in (chosen, fixed))
    assert np.allclose(found.sigma, wanted.sigma, rtol=1e-3)
    assert np.allclose(found.slow.drift, wanted.slow.drift, rtol=1e-3)
    assert np.allclose(found.slow.sigma, wanted.slow.sigma, rtol=1e-3)
    omega, density = wanted.omega, SEA.spectrum.density(wanted.omega)
    roll = np.abs(CubicSpline(chosen.omega, chosen["rao"][:, 0, ROLL])(omega)) ** 2
    assert abs(np.sqrt(np.trapezoid(roll * density, omega)) / wanted.sigma[ROLL] - 1) > 0.03
    yaw = CubicSpline(chosen.omega, chosen["drift_force"][:, 0, 2])(omega)
    inside = wanted.slow.drift - wanted.slow.beyond.sum(axis=0)
    assert abs(2 * np.trapezoid(yaw * density, omega) / inside[2] - 1) > 0.02
