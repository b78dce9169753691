"""A body before a wall by its far field, beside panels with the wall and the laws of waves."""

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.wave_field import before_wall as module
from hakobune.bem.wave_field.before_wall import WallError, before_wall, given_back, neglected
from hakobune.bem.waves import wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box
from hakobune.pipelines.cli import main

WALL, DEPTH, OMEGA = 40.0, 20.0, 0.7
WANT = {"added_mass", "radiation_damping", "excitation_force"}


@pytest.fixture(scope="module")
def opened(tmp_path_factory):
    path = tmp_path_factory.mktemp("wall") / "box.h5"
    words = f"box --length 60 --beam 30 --draft 8 --depth {DEPTH:g} --omega 0.5:0.9:5 --heading 0:90:7 --tolerance 0.01"
    assert main([*words.split(), "--gyration", "9,17,19", "--output", str(path)]) == 0
    return open_database(path)


@pytest.fixture(scope="module")
def made(opened):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "FEWEST", 20)
        return before_wall(opened.reader, WALL)


def test_forces_added_mass_and_damping_are_those_of_panels_with_the_wall(made):
    """25 m from hull to wall, 1.25 depths: what is left out decays to 4e-4; panels err by a hundredth"""
    mesh = box(60, 30, 8, panels=600)
    beta = np.radians([90.0, 30.0, -60.0])
    panels = solve_frequency(prepare(PanelProblem(mesh, lid(mesh), depth=DEPTH, wall=WALL)), OMEGA, beta, WANT)
    A, B = made.coefficients([OMEGA])
    for ours, name in ((A[0], "added_mass"), (B[0], "radiation_damping")):
        size = np.sqrt(np.diag(np.abs(panels[name])))
        assert np.abs(ours - panels[name])[:3, :3].max() < 0.02 * (size[:3].max() ** 2), name
    force = made.forces([OMEGA], beta)[0]
    assert np.all(np.abs(force - panels["excitation_force"]) < 0.02 * np.abs(panels["excitation_force"]).max(axis=0))


def test_radiation_gives_no_energy_back(made):
    assert given_back(made) < 5e-3


def test_waves_towards_minus_beta_are_those_towards_beta_and_their_reflection(made):
    beta = np.radians([20.0, 65.0, 90.0])
    k = float(wavenumber(OMEGA, DEPTH))
    phase = np.exp(-2j * k * WALL * np.sin(beta))[:, None]
    here, there = made.forces([OMEGA], beta)[0], made.forces([OMEGA], -beta)[0]
    assert np.allclose(there, phase * here, rtol=0, atol=1e-6 * np.abs(here).max())


def test_waves_along_a_far_wall_have_twice_the_amplitude_and_four_times_the_drift(opened, monkeypatch):
    """Drift of sources against that of Kochin functions; what the image sends falls with the root of the distance"""
    monkeypatch.setattr(module, "FEWEST", 10)
    monkeypatch.setattr(module, "MOST", 10)
    body, far = opened.reader.floating(), before_wall(opened.reader, 1e7)
    along = np.zeros(1)
    force, drift = body.forces([OMEGA], along)[0, 0], body.drift([OMEGA], along)[0, 0]
    assert np.allclose(far.forces([OMEGA], along)[0, 0], 2 * force, rtol=0, atol=5e-3 * np.abs(force[:3]).max())
    assert far.drift([OMEGA], along)[0, 0, 0] == pytest.approx(4 * drift[0], rel=1e-2)


def test_what_is_left_out_grows_as_the_gap_closes(opened):
    shares = [neglected(opened.reader, y) for y in (40.0, 25.0, 18.0, -18.0)]
    assert shares[0] < 1e-3 < shares[1] < shares[2] == pytest.approx(shares[3])


@pytest.mark.parametrize("wall", [15.0, -14.0, 0.0, np.nan])
def test_a_wall_through_the_hull_is_refused(opened, wall):
    with pytest.raises(WallError, match="meets the hull"):
        before_wall(opened.reader, wall)


def test_a_body_beside_a_wall_already_is_refused(made):
    with pytest.raises(WallError, match="already"):
        before_wall(made, 50.0)
