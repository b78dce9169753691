"""Frequencies that need a finer mesh share their work on it, whichever is solved first."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.checks import damping_error, largest_error
from hakobune.bem.methods.panel_problem import PROBES, prepare
from hakobune.bem.panels.band.one_frequency import BandRun
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.plan import planned

RADIATION = {"added_mass", "radiation_damping"}
BOX = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 30.0}
WAVES = {"omegas": {"from": 0.3, "to": 0.8, "count": 65}}
RAW = {"water": {"depth": 100.0}, "bodies": [BOX], "waves": WAVES, "method": "panel", "lid": False}


def tolerances(prepared):
    """Errors over the tolerance at the frequencies of a problem, by its own mesh or extrapolated"""
    runs = [at(prepared, omega) for omega in prepared.problem.finer.omegas]
    return np.array([min(run.tolerances, run.extrapolated.tolerances) for run in runs])


def at(prepared, omega):
    return prepared.run(omega, [], RADIATION, None, DOFS)


@pytest.fixture(scope="module")
def prepared():
    return prepare(planned(make_scene(RAW)).problem)


def test_the_band_of_the_finer_mesh_holds_every_frequency_that_needs_it_and_few_others(prepared):
    omegas, beyond = prepared.problem.finer.omegas, tolerances(prepared) > 1
    low, high = prepared.finer.problem.band
    shared = (omegas >= low) & (omegas <= high)
    assert 4 < beyond.sum() < len(omegas) - 2
    assert np.all(shared[beyond]) and np.sum(shared & ~beyond) <= 2 * len(omegas) / (PROBES - 1)
    again = prepare(planned(make_scene(RAW)).problem)
    assert at(again, omegas[beyond][-1]).within_tolerance().prepared.problem.band == (low, high)


def test_a_frequency_shares_its_work_to_a_tenth_of_the_tolerance():
    series = {**RAW, "water": {"depth": 20.0}, "bodies": [{**BOX, "draft": 10.0}]}
    finer = prepare(planned(make_scene(series)).problem).finer.problem
    run, alone = (at(prepare(replace(finer, band=band)), 0.8) for band in ((0.6, 1.0), None))
    assert isinstance(run, BandRun) and run.solution is not None
    off = run.radiation - alone.radiation
    assert max(damping_error(run, off), largest_error(run, off, 0 * run.excitation)) < 0.1 * run.problem.tolerance


def test_few_frequencies_and_those_within_the_tolerance_share_nothing():
    few = {**RAW, "waves": {"omegas": [0.8, 0.9, 1.0]}}
    assert prepare(planned(make_scene(few)).problem).finer.problem.band is None
    low = {**RAW, "waves": {"omegas": {"from": 0.3, "to": 0.36, "count": 60}}}
    quiet = prepare(planned(make_scene(low)).problem)
    assert np.all(tolerances(quiet) <= 1) and quiet.finer.problem.band is None
