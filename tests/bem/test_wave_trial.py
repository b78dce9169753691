"""Every frequency of a band is tested: what few nodes do not carry is seen, with samples in place of all nodes."""

from functools import cache

import numpy as np
import pytest

from bem import reduced_run, wave_space
from bem.reduced import reduced
from bem.reduced_run import ReducedRun
from bem.setup import Setup, prepare
from bem.wave_trial import Samples, Trial
from meshing.lid import lid
from meshing.shapes import box, buoy

DOFS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
WANT = {"added_mass", "radiation_damping", "excitation_force"}
BAND = (0.2, 1.6)


@cache
def body():
    """A buoy with and without its lid, as many nodes as make samples fewer than all"""
    mesh = buoy(10, 10, panels=700)
    return prepare(Setup(mesh, lid(mesh), depth=30.0, band=BAND))


def run_at(omega, want=WANT):
    return ReducedRun(body(), omega, np.radians([25.0, 110.0]), want, None, DOFS)


@pytest.mark.parametrize("omega", [0.3, 1.5])
def test_forces_are_integrals_of_the_potentials(omega):
    run = run_at(omega)
    assert run.flow is not None
    areas = run.hull[1] * run.geometry.copies
    for cls, (moving, _) in run.columns.items():
        phi, flux = run.potentials[cls], run.incident[0][cls][1]
        pushing = phi @ run.weighted_modes[:, run.geometry.members(cls)]
        np.testing.assert_allclose(run.pushing[cls], pushing, rtol=0, atol=1e-12 * np.abs(pushing).max())
        met = (flux * areas) @ phi[: len(moving)].T
        # the flux at few nodes stands for all, to a fifth of the accuracy of a row each (`bem.wave_space`)
        scale = np.sqrt((np.abs(flux) ** 2 @ areas)[:, None] * (np.abs(phi[: len(moving)]) ** 2 @ areas))
        assert np.all(np.abs(run.meeting_waves[cls] - met) < run.reduced.accuracy * scale)


def test_what_one_heading_gives_does_not_depend_on_the_others():
    both = run_at(0.7).result()
    alone = ReducedRun(body(), 0.7, np.radians([110.0]), WANT, None, DOFS).result()
    np.testing.assert_allclose(alone["excitation_force"][0], both["excitation_force"][1], rtol=1e-9)


def trial_of(rng, nodes, samples):
    """A random space of four functions for `nodes` nodes of equal size, and a trial of it"""
    X, Y = rng.normal(size=(nodes, 4)), rng.normal(size=(3, nodes))
    return X, Y, Trial.of(np.array([0, 5]), samples, X, Y, rng.normal(size=(nodes, 2)), np.ones(nodes))


def test_waves_that_the_space_holds_are_not_lost_and_others_are():
    rng, nodes = np.random.default_rng(0), 40
    X, Y, trial = trial_of(rng, nodes, Samples(np.arange(nodes), np.ones(nodes), nodes))
    W = rng.normal(size=(2, 4, 3)) + 1j * rng.normal(size=(2, 4, 3))
    phi = rng.normal(size=(2, nodes, 2)) + 1j * rng.normal(size=(2, nodes, 2))
    whole = X[trial.points] @ W @ Y
    assert trial.lost_waves(whole, W, phi) < 1e-12
    other = 0.01 * rng.normal(size=whole.shape)
    expected = np.abs(other @ phi) / (2 * np.pi * np.abs(phi).max(axis=1, keepdims=True))
    assert trial.lost_waves(whole + other, W, phi) == pytest.approx(expected.max())
    assert np.isnan(trial.lost_waves(whole * np.nan, W, phi))


def test_samples_stand_for_all_nodes_in_the_mean():
    rng, nodes, part = np.random.default_rng(1), 400, 0.25
    missed, phi = rng.normal(size=(1, 1, nodes)) + 3, np.ones((1, nodes, 1), complex)
    found = []
    for _ in range(400):
        chosen = np.flatnonzero(rng.random(nodes) < part)
        _, _, trial = trial_of(rng, nodes, Samples(chosen, np.full(len(chosen), 1 / part), len(chosen)))
        silent = np.zeros((1, 4, 3), complex)
        found.append(trial.lost_waves(missed[..., chosen], silent, phi[:, chosen]))
    exact = missed.sum() / (2 * np.pi)
    # of 400 trials, each with a deviation of √((1 − part)/part Σ missed²): three of the mean's
    deviation = np.sqrt((1 - part) / part * np.sum(missed**2)) / (2 * np.pi)
    assert abs(np.mean(found) - exact) < 3 * deviation / np.sqrt(len(found))


def test_flux_that_the_crests_carry_is_not_lost():
    rng, nodes = np.random.default_rng(2), 40
    _, _, trial = trial_of(rng, nodes, Samples(np.arange(nodes), np.ones(nodes), nodes))
    crests = rng.normal(size=(3, 2)) + 1j * rng.normal(size=(3, 2))
    flux = crests @ trial.Z.T
    assert trial.lost_flux(flux, crests) < 1e-12
    assert trial.lost_flux(flux * 1.02, crests) == pytest.approx(0.02 / 1.02)
    assert trial.lost_flux(flux[:0], crests[:0]) == 0.0


def test_a_band_without_waves_from_the_side_is_noticed(monkeypatch):
    """Waves from two quarters were once forgotten in bodies without mirror planes"""

    def head_waves(geometry, beta, *rest):
        return whole(geometry, 0.0, *rest)

    whole = wave_space.class_waves
    mesh = box(60, 30, 8, panels=100).whole().rotated(0.4)
    prepared = prepare(Setup(mesh, None, depth=25.0, band=(0.3, 0.9)))
    monkeypatch.setattr(wave_space, "class_waves", head_waves)
    prepared.__dict__["reduced"] = reduced(prepared.geometry, (0.3, 0.9), 9.80665, 1e-4)
    lost = []
    monkeypatch.setattr(ReducedRun, "in_full", lambda self, part: lost.append(part))
    for heading, noticed in ((0.0, 0), (70.0, 1)):
        _ = ReducedRun(prepared, 0.6, np.radians([heading]), {"excitation_force"}, None, DOFS).flow
        assert len(lost) == noticed
    assert lost[0] > reduced_run.ALLOWED * 1e-4
