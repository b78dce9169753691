"""Viscous roll damping in irregular waves."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.viscous import Quadratic, Tabulated, Viscous, yamashita_roll
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.spreading import WrappedNormal
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.viscous import in_regular_waves, in_sea, in_time, linearised
from hakobune.mooring.studies.conditions import Conditions, Waves
from hakobune.mooring.studies.wave_effects import wave_effects
from hakobune.pipelines.cli import main
from hakobune.pipelines.response.result import response

BEAM = np.pi / 2  # seas on the side
ROLL = 3
SCENE = """[water]
depth = 30.0
[[bodies]]
shape = "box"
length = 60.0
beam = 20.0
draft = 4.0
gyration = [6.5, 16.0, 17.0]
[waves]
omegas = {{ from = 0.3, to = 1.8, count = 24 }}
headings_deg = [0, 90]
[viscous]
wave_height = 1.0
roll = {{ drag = {drag} }}
"""


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


def roll_in(body, height, laws):
    sea = Sea(issc(height, mean_period=10.0), BEAM)
    damped, damping = linearised(body, sea, laws)
    state = sea_state(damped, sea, 3600.0)
    return state.moments.m0[ROLL], state.moments.m2[ROLL], damping[ROLL, ROLL]


@pytest.mark.filterwarnings("ignore")
def test_damping_is_that_of_the_motion_it_leaves(box_body):
    """N = √(8/π) σ_v N₂ for quadratic drag, whatever the spectrum"""
    drag = 5e9
    _, m2, damping = roll_in(box_body, 4.0, {"Roll": Quadratic(drag)})
    assert damping == pytest.approx(np.sqrt(8 / np.pi) * np.sqrt(m2) * drag, rel=1e-4)


def test_damping_in_regular_waves_takes_as_much_out_of_a_cycle_as_the_drag(box_database):
    """∮ N₂ |v| v dx = (8/3) N₂ ω² a³ of the drag, π N ω a² of the damping, a the amplitude of roll that it leaves"""
    drag, omega, amplitude = 2e10, 0.7, 1.7
    reader = replace(box_database.reader, viscous=Viscous({"Roll": Quadratic(drag)}, 0.3))
    body, damping = in_regular_waves(reader, omega, amplitude, BEAM)
    a = amplitude * abs(body.motions([omega], [BEAM])[0, 0, ROLL])
    assert np.pi * damping[ROLL, ROLL] * omega * a**2 == pytest.approx(8 / 3 * drag * omega**2 * a**3, rel=1e-8)
    assert np.count_nonzero(damping) == 1


@pytest.mark.filterwarnings("ignore")
def test_every_study_takes_the_viscous_damping_of_a_scene(tmp_path):
    """Roll of `response` and `moor` in one sea is that of √(8/π) σ_v N₂ with the σ_v of the roll it leaves; the laws in
    time are drag, or what is not one linearised, and the drift is that of the damped body"""
    drag = 2e9
    (tmp_path / "box.toml").write_text(SCENE.format(drag=drag))
    assert main(["solve", str(tmp_path / "box.toml"), "--output", str(tmp_path / "box.h5")]) == 0
    db, sea = open_database(tmp_path / "box.h5"), Sea(issc(3.0, mean_period=7.0), BEAM)
    body, damping = in_sea(db.reader, sea)
    state = sea_state(body, sea, 3600.0)
    assert damping[ROLL, ROLL] == pytest.approx(np.sqrt(8 / np.pi * state.moments.m2[ROLL]) * drag, rel=1e-4)
    conditions = Conditions(waves=Waves(3.0, 7.0, BEAM), sea=sea, duration=3600.0)
    statics = wave_effects(db, conditions)
    assert statics["irregular"].amplitudes[ROLL] == pytest.approx(state.expected_maximum[ROLL], rel=1e-6)
    (tmp_path / "sea.toml").write_text(
        "[sea]\nheight = 3.0\nmean_period = 7.0\ndirection_deg = 90.0\nduration_hours = 1.0\n"
    )
    found = response(tmp_path / "sea.toml", tmp_path / "box.h5")
    assert found["roll.sigma"] == pytest.approx(state.sigma[ROLL], rel=1e-9)
    time = in_time(db.reader, sea)
    assert time.quadratic.tolist() == [0, 0, 0, drag, 0, 0] and not time.damping.any()
    omega = np.array([0.8])
    assert np.allclose(time.body.drift(omega, [BEAM]), body.drift(omega, [BEAM]), rtol=1e-6)
    given = in_time(replace(db.reader, viscous=None), sea, quadratic=[0, 0, 0, drag, 0, 0])  # by a study, not the scene
    assert np.allclose(given.body.drift(omega, [BEAM]), time.body.drift(omega, [BEAM]), rtol=1e-9)
    held = in_time(db.reader, None, damping=np.diag([0, 0, 0, 1e9, 0, 0])).body.drift(omega, [BEAM])
    own = db.reader.floating().restrained(damping=np.diag([0, 0, 0, 1e9, 0, 0])).drift(omega, [BEAM])
    assert np.array_equal(held, own)
    table = replace(db.reader, viscous=Viscous({"Roll": Tabulated(1e9, (0.1,), (0.2,))}, 1.0))
    assert not in_time(table, sea).quadratic.any()
    assert np.array_equal(in_time(table, sea).damping, in_sea(table, sea)[1])


@pytest.mark.filterwarnings("ignore")
def test_roll_grows_slower_than_the_waves(box_body):
    laws = {"Roll": yamashita_roll(100.0, 50.0, 10.0, 1025.0)}
    small, large = (np.sqrt(roll_in(box_body, height, laws)[0]) for height in (2.0, 6.0))
    assert np.sqrt(3.0) < large / small < 3.0  # quadratic drag alone would give √3, none 3


@pytest.mark.filterwarnings("ignore")
def test_without_drag_nothing_changes(box_body):
    sea = Sea(issc(4.0, mean_period=10.0), BEAM)
    damped, damping = linearised(box_body, sea, {"Roll": Quadratic(0.0)})
    assert not damping.any()
    assert np.array_equal(damped.damping, box_body.damping)
