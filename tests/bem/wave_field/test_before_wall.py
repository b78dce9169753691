"""A body before a wall by its far field, beside panels with the wall and the laws of waves."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.drift import drift_of_two
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.wave_field import before_wall as module
from hakobune.bem.wave_field.before_wall import WallError, before_wall, given_back, least_gap, neglected
from hakobune.bem.waves import group_factor, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box
from hakobune.pipelines.cli import main

WALL, DEPTH, OMEGA = 40.0, 20.0, 0.7
RHO, G = 1025.0, 9.80665
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
    with pytest.raises(WallError, match="intersects the hull"):
        before_wall(opened.reader, wall)


def test_a_body_beside_a_wall_already_is_refused(made):
    with pytest.raises(WallError, match="already"):
        before_wall(made, 50.0)


def test_what_is_left_out_decays_over_the_depth_or_the_breadth_to_the_image_and_back():
    """exp(−2πg/b): 3.9e-4, 0.043 and 0.39 of 25, 10 and 3 m in 20 m of water by a box 50 m wide, 0.043 and 0.28 of 25
    and 10 m in 100 m"""
    mesh = box(200, 50, 10, panels=60).moved(dy=5.0)
    for depth, gap, share in ((20.0, 25.0, 3.88e-4), (20.0, 10.0, 0.0432), (20.0, 3.0, 0.390), (100.0, 25.0, 0.0432),
                              (100.0, 10.0, 0.285)):  # fmt: skip
        for wall in (30.0 + gap, -20.0 - gap):
            assert neglected(SimpleNamespace(mesh=mesh, depth=depth), wall) == pytest.approx(share, rel=3e-3)
        assert least_gap(share, depth, 50.0) == pytest.approx(gap, rel=3e-3)


def test_energy_given_back_is_the_lowest_eigenvalue_of_damping_over_the_largest_of_each_motion():
    B = np.zeros((2, 6, 6))
    B[0] = np.diag([4.0, 1, 1, 1, 1, 0])
    B[1] = np.diag([1.0, 9, 1, 1, 1, 0])
    B[1, 0, 1] = B[1, 1, 0] = 3.9  # [[1/4, 3.9/6], [3.9/6, 1]]
    body = SimpleNamespace(between=SimpleNamespace(quantities={"radiation_damping": B}))
    lowest = 0.625 - np.sqrt(0.375**2 + 0.65**2)
    assert lowest < 0 and given_back(body) == pytest.approx(-lowest)
    B[1, 0, 1] = B[1, 1, 0] = 2.9
    assert given_back(body) == 0.0


def test_frequencies_are_close_enough_for_waves_to_the_wall_and_back(opened):
    """One for each quarter of a radian that 2kw turns, between 100 and 400, and the stored ones among them"""
    body = opened.reader
    turns = np.ptp(wavenumber(body.omega, DEPTH)) * 2 / 0.25
    for wall, count in ((300.0, 300 * turns), (1e5, 400), (20.0, 100)):
        omega = module._frequencies(body, wall)
        assert np.all(np.isin(body.omega, omega)) and np.all(np.diff(omega) > 0)
        assert abs(len(omega) - count) <= 6
        # most where waves are long and turn fast with frequency: not evenly, nor by the turn alone
        phase = wavenumber(omega, DEPTH) * 2 * wall / 0.25 + 100 * (omega - omega[0]) / np.ptp(omega)
        low, middle, high = np.quantile(np.diff(phase), (0.12, 0.5, 0.95))  # but beside the stored ones
        assert 0.99 * middle < low and high < 1.01 * middle


def test_more_frequencies_go_where_radiation_changes_by_more_than_a_seventh_of_its_largest():
    omega = np.array([0.5, 0.6, 0.7, 0.7001])
    rows = [
        {"added_mass": np.zeros((6, 6)), "radiation_damping": np.diag([b] * 5 + [0.0])} for b in (1, 0.86, 0.7, 0.4)
    ]
    assert module._between(omega, rows) == pytest.approx([0.65])  # 0.16; 0.14 is less, and the last is close enough
    for last, asked in ((0.50012, [0.50006]), (0.50009, [])):  # close enough is 2e-4 of the frequency, 1e-4 rad/s here
        assert module._between(np.array([0.5, last]), rows[::3]) == pytest.approx(asked)
    for much in (1e-3, 1e3):  # whatever the unit: of the largest of each motion, couplings by the root of both
        scaled = [row | {"radiation_damping": much * row["radiation_damping"]} for row in rows]
        assert module._between(omega, scaled) == pytest.approx([0.65])
    coupled = [{"added_mass": np.zeros((6, 6)), "radiation_damping": np.diag([4.0, 9.0, 1, 1, 1, 1])} for _ in range(2)]
    for change, asked in ((0.91, [0.55]), (0.89, [])):  # 0.15 · √(4 · 9)
        coupled[1]["radiation_damping"][0, 1] = change
        assert module._between(omega[:2], coupled) == pytest.approx(asked)
    mass = [{"added_mass": np.diag([a] * 6), "radiation_damping": np.zeros((6, 6))} for a in (2.0, 1.0, 1.0, 1.0)]
    assert module._between(omega, mass) == pytest.approx([0.55])


@pytest.mark.parametrize("lost", [{"inertia": None}, {"stiffness": None}])
def test_drift_before_a_wall_is_of_bodies_with_inertia_and_stiffness(opened, lost):
    beta = np.radians([0.0, 90.0])
    (whole,) = module._at(opened.reader, WALL, np.array([OMEGA]), beta)
    (row,) = module._at(replace(opened.reader, **lost), WALL, np.array([OMEGA]), beta)
    assert row["drift_force"] is None and whole["drift_force"].shape == (2, 3)
    assert row["excitation_force"] == pytest.approx(whole["excitation_force"])


@pytest.mark.parametrize("degrees", [35.0, 90.0, 120.0])
def test_a_far_wall_sends_a_second_wave_whose_drift_is_that_of_both_waves(opened, degrees, monkeypatch):
    """D of the far field of two waves, β and −β with exp(2ikw sin β), each with its own motion; the moment, too"""
    monkeypatch.setattr(module, "FEWEST", 10)
    monkeypatch.setattr(module, "MOST", 10)
    wall, k, n = 1e7, float(wavenumber(OMEGA, DEPTH)), float(group_factor(wavenumber(OMEGA, DEPTH), DEPTH))
    body, beta = opened.reader.floating(), np.radians([degrees, -degrees])
    radiated, scattered = body.far_field([OMEGA], beta)
    H = scattered[0] + body.motions([OMEGA], beta)[0] @ radiated[0]
    theta = body.between.theta
    order = np.arange(len(theta)) - len(theta) // 2
    series = np.mean(H[:, None] * np.exp(-1j * order[:, None] * theta), axis=-1)
    series[:, 0] = 0
    to = np.exp(1j * np.outer(order, beta))
    slope = 1j * (series * order) @ np.exp(1j * np.outer(order, theta))
    D = drift_of_two(H, slope, series @ to, 1j * (series * order) @ to, theta, beta, k, n, RHO, G)
    at = np.argmin(np.abs(np.degrees(np.arange(72) * np.pi / 36) - degrees))
    row = module._at(body, wall, np.array([OMEGA]), np.arange(72) * np.pi / 36)[0]
    a = np.array([1.0, np.exp(2j * k * wall * np.sin(beta[0]))])
    both = np.einsum("i,j,ijk->k", a, a.conj(), D).real
    assert row["drift_force"][at] == pytest.approx(both, rel=0.02, abs=0.02 * np.abs(both).max())
    force = body.forces([OMEGA], beta)[0]
    assert row["excitation_force"][at] == pytest.approx(a @ force, abs=0.01 * np.abs(force).max())


def test_a_wall_needs_what_sends_waves(opened):
    body = opened.reader
    less = {name: value for name, value in body.between.quantities.items() if name != "kochin_radiation"}
    with pytest.raises(WallError, match="a wall needs kochin_radiation in the database"):
        before_wall(replace(body, between=replace(body.between, quantities=less)), WALL)
    with pytest.raises(WallError, match="needs the mesh of the body"):
        before_wall(replace(body, mesh=None), WALL)
    with pytest.raises(WallError, match=r"a wall at y = 15 m intersects the hull; allowed: below -15 or above 15 m"):
        before_wall(body, 15.0)


def test_where_there_is_no_room_for_all_the_largest_changes_go_first(monkeypatch):
    """Up to 400 in all, here 5 and 6"""
    omega = np.array([0.5, 0.6, 0.7, 0.8])
    rows = [{"added_mass": np.zeros((6, 6)), "radiation_damping": b * np.eye(6)} for b in (1.0, 0.8, 0.3, 0.0)]
    assert module.MOST == 400 and module._between(omega, rows) == pytest.approx([0.55, 0.65, 0.75])
    for most, asked in ((6, [0.65, 0.75]), (5, [0.65]), (4, []), (3, [])):
        monkeypatch.setattr(module, "MOST", most)
        assert module._between(omega, rows) == pytest.approx(asked)


@pytest.mark.parametrize("low, high", [(0.5, 4.5), (0.3, 0.5)])
def test_a_frequency_within_a_thousandth_of_the_band_of_a_stored_one_is_left_out(low, high):
    def asked(*stored):
        body = SimpleNamespace(between=SimpleNamespace(span=(low, high)), depth=30.0, gravity=G,
                               omega=np.array([low, *stored, high]))  # fmt: skip
        return module._frequencies(body, 25.0)

    bare = asked()
    one = bare[40]
    for share, kept in ((0.97e-3, False), (1.03e-3, True)):
        for sign in (1, -1):
            near = one + sign * share * (high - low)
            found = asked(near)
            assert near in found and (one in found) is kept and len(found) == len(bare) + kept
