"""Forces of long waves that are bound: Haskind's relation, the cylinder on the bed, published difference forces."""

from dataclasses import replace

import numpy as np
import pytest
from exact import maccamy_fuchs
from exact.second_order_cylinder import free_surface_force, long_wave_force, quadratic_force

from hakobune.bem import DOFS
from hakobune.bem.kernels.progress import LONG, progress_callback
from hakobune.bem.methods import panel_problem
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.panels.compressed.one_frequency import CompressedRun
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.long_wave_forces import LongWaveBody, kept_forces
from hakobune.bem.time_domain import kept_fits
from hakobune.bem.waves import wavenumber
from hakobune.meshing.shapes import box, buoy

RHO, G = 1025.0, 9.80665
RADIUS, DEPTH = 10.0, 20.0


def frequency(ka):
    return np.sqrt(G * ka / RADIUS * np.tanh(ka / RADIUS * DEPTH))


@pytest.fixture(scope="module")
def pile():
    return LongWaveBody(PanelProblem(buoy(RADIUS, DEPTH, counts=(8, 1, 8), bottom=False), depth=DEPTH))


def test_with_the_wavenumber_of_a_free_wave_it_is_the_excitation_by_haskind():
    problem = PanelProblem(box(100, 50, 10, panels=100), depth=DEPTH, rotation_center=(0.0, 0.0, -3.0))
    omega, beta = 0.3, np.array([0.0, 0.5, np.pi / 2, 4.0])
    run = problem.prepared().run(omega, beta, {"excitation_force", "added_mass"}, None, DOFS)
    k = wavenumber(omega, DEPTH)
    found = LongWaveBody(problem).forces(omega, k * np.stack([np.cos(beta), np.sin(beta)], axis=1))
    scale = np.abs(run.haskind).max(axis=0)
    assert np.abs(found - run.haskind @ problem.transform.T)[:, scale > 0] == pytest.approx(0, abs=1e-11 * scale.max())


@pytest.mark.parametrize("omega, kappa", [(0.1, 0.02), (0.35, 0.05), (0.2, 0.15), (0.01, 0.001)])
def test_on_a_cylinder_on_the_bed_it_is_the_sum_of_eigenfunctions(pile, omega, kappa):
    exact = long_wave_force(RADIUS, DEPTH, omega, kappa)
    found = pile.forces(omega, [[kappa, 0.0]])[0]
    assert abs(found[0] - exact) < 5e-3 * abs(exact) and abs(found[1]) < 1e-9 * abs(exact)


def test_the_sum_of_eigenfunctions_is_that_of_maccamy_and_fuchs_for_free_waves():
    omega = 0.4
    k = wavenumber(omega, DEPTH)
    exact = maccamy_fuchs.excitation(RADIUS, DEPTH, omega)[0]
    assert long_wave_force(RADIUS, DEPTH, omega, k * (1 + 1e-7)) == pytest.approx(exact, rel=1e-6)
    assert quadratic_force(RADIUS, DEPTH, omega, omega) == pytest.approx(
        maccamy_fuchs.drift(RADIUS, DEPTH, omega)[0], rel=1e-9
    )


def test_the_sums_on_the_cylinder_are_whole_with_the_forcing_of_the_surface():
    """T over ρga of ka 0.2 and 0.4, 2.880, by another's sums; what the surface does is 0.2 % of it here"""
    one, two = frequency(0.4), frequency(0.2)
    bound = bound_waves((one, 0.0), (two, 0.0), DEPTH)
    squares = quadratic_force(RADIUS, DEPTH, one, two)
    squares += bound.amplitude * long_wave_force(RADIUS, DEPTH, bound.omega, bound.number[0])
    whole = squares + free_surface_force(RADIUS, DEPTH, one, two)
    assert abs(whole) / (RHO * G * RADIUS) == pytest.approx(2.880, abs=5e-4)
    assert abs(squares) / (RHO * G * RADIUS) == pytest.approx(2.886, abs=5e-4)


def test_equations_by_blocks_of_low_rank_give_the_forces_of_full_ones(monkeypatch):
    problem, number = PanelProblem(box(100, 50, 10, panels=400), depth=DEPTH), np.array([[0.03, 0.02], [0.0, 0.05]])
    exact = LongWaveBody(problem).forces(0.2, number)
    monkeypatch.setattr(panel_problem, "WORTH_COMPRESSING", 0)
    body = LongWaveBody(problem)
    assert isinstance(body.run(0.2), CompressedRun)
    found = body.forces(0.2, number)
    for part in (slice(0, 3), slice(3, 6)):
        assert np.abs(found - exact)[:, part].max() < 1e-4 * np.abs(exact)[:, part].max()


def test_forces_that_are_kept_are_those_of_the_body_in_its_own_water(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_fits, "cache_folder", lambda *_: tmp_path)
    problem = PanelProblem(box(100, 50, 10, panels=40), depth=DEPTH)
    omega, number = np.array([0.2, 0.35]), np.array([[[0.03, 0.01]], [[0.05, 0.0]]])
    for asked in (problem, replace(problem, density=1.5 * problem.density), replace(problem, depth=1.2 * DEPTH)):
        made = [LongWaveBody(asked).forces(*one) for one in zip(omega, number, strict=True)]
        heard = []
        for _ in range(2):
            with progress_callback(lambda *one: heard.append(one)):  # noqa: B023
                assert np.array_equal(kept_forces(asked, omega, number), made)
        assert [(stage, *what[1:]) for stage, what in heard if stage == LONG] == [(LONG, 0.2, 0, 2), (LONG, 0.35, 1, 2)]
    assert len([*(tmp_path / "fits").iterdir()]) == 3
