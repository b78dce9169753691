"""Slow motion that waves alone drive, without drift, wind and current: of lines that stiffen, not of linear springs."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import mitsuyasu_bretschneider
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.statistics import parts
from hakobune.mooring.motion.weather import Settings, Weather

HELD = 1e14  # N m/rad, of yaw
SPECTRUM = mitsuyasu_bretschneider(4.5, mean_period=10.0)


def slow_surge(body):
    """m, σ of surge below the waves' frequencies"""
    weather = Weather((Sea(SPECTRUM, np.radians(240.0)),))
    run = simulate(body, weather, Settings(duration=2400.0, slow_drift="none"), seed=1)
    surge = run.motion[run.time >= 0, 0]
    return parts(surge - surge.mean(), 0.5, float(SPECTRUM.quantile(1e-3)))[0]


@pytest.fixture(scope="module")
def on_chains_alone(without_hull):
    return slow_surge(without_hull)


def test_springs_as_stiff_as_the_chains_at_rest_have_no_slow_motion_like_that_of_chains(
    database, without_hull, on_chains_alone
):
    spring = without_hull.stiffness - database.reader.stiffness
    linear = moored(database, spring=np.diag(np.diag(spring)), memory=without_hull.memory)
    assert slow_surge(linear) < 0.3 * on_chains_alone


def test_chains_that_cannot_yaw_have_less_slow_surge(without_hull, on_chains_alone):
    """Surge, sway and yaw are coupled by the chains' stiffening; without yaw there is little left"""
    held = replace(without_hull, spring=np.diag([0.0, 0.0, 0.0, 0.0, 0.0, HELD]))
    assert slow_surge(held) < 0.6 * on_chains_alone
