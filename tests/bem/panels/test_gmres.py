"""Iteration for several right-hand sides beside a direct solution, and which headings a class of symmetry has."""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest

from hakobune.bem.panels.compressed import iteration
from hakobune.bem.panels.compressed.iteration import _cycle, gmres
from hakobune.bem.panels.one_frequency import PanelRun

SIZE, SIDES = 30, 2


class Columns(NamedTuple):
    values: np.ndarray
    signs: int


@pytest.fixture
def equations():
    """A matrix with three eigenvalues, for which a space of three is enough (Saad & Schultz 1986)"""
    rng = np.random.default_rng(3)
    turn = np.linalg.qr(rng.normal(size=(SIZE, SIZE)) + 1j * rng.normal(size=(SIZE, SIZE)))[0]
    matrix = (turn * np.resize([1.0, 2.0, 1.5j], SIZE)) @ turn.conj().T
    sides = rng.normal(size=(SIZE, SIDES)) + 1j * rng.normal(size=(SIZE, SIDES))
    return SimpleNamespace(matrix=matrix, sides=sides, apply=lambda c, exactly=False: matrix @ c.values)


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_a_space_of_as_many_as_there_are_eigenvalues_has_the_solution(equations, scale):
    def divided(values, signs):
        return values / scale

    columns = Columns(np.zeros((SIZE, SIDES)), 1)
    found, count = _cycle(equations, divided, columns, equations.sides, np.full(SIDES, 1e-3))
    exact = np.linalg.solve(equations.matrix, equations.sides)
    assert count == 3
    assert found == pytest.approx(exact, abs=2e-4 * np.abs(exact).max())
    found, left = gmres(equations, divided, columns, 1e-12, 40)
    assert left < 1e-12
    assert found == pytest.approx(exact, rel=1e-10)


def test_no_more_iterations_are_begun_than_allowed(equations):
    columns = Columns(np.zeros((SIZE, SIDES)), 1)
    _, left = gmres(equations, lambda values, signs: values, columns, 1e-12, 3)
    assert 1e-12 < left < 1e-3  # one cycle, in single precision
    found, left = gmres(equations, lambda values, signs: values, columns, 1e-12, 0)
    assert left == 1.0
    assert np.all(found == 0)


def test_a_class_has_the_headings_whose_waves_have_a_part_of_its_symmetry():
    """Even about x: both, by the larger of two nodes, in whatever phase; odd: the second alone but for rounding"""
    parts = {(1, 1): np.array([[-3.0, -2.0j], [-1.0, 0.0]]), (1, -1): np.array([[1e-13, -1e-13], [0.0, -1j]])}
    run = SimpleNamespace(incident=[{cls: (None, velocity) for cls, velocity in parts.items()}])
    assert PanelRun.incident_headings.fget(run) == {(1, 1): [0, 1], (1, -1): [1]}


def test_a_motion_that_drives_no_water_has_no_flow(equations):
    """Heave of a body on the bed beside others: a side of zeros stays zero, and the others have their solutions"""
    equations.sides[:, 1] = 0.0
    columns = Columns(np.zeros((SIZE, SIDES)), 1)
    found, left = gmres(equations, lambda values, signs: values, columns, 1e-10, 40)
    assert left < 1e-10 and not found[:, 1].any()
    assert found[:, 0] == pytest.approx(np.linalg.solve(equations.matrix, equations.sides[:, 0]), rel=1e-8)


def test_the_space_is_orthogonal_to_single_precision_where_its_vectors_are_nearly_parallel():
    """I + 1e-4 N: the first image has all but a ten-thousandth along the first vector; what is told to be left is"""
    rng = np.random.default_rng(8)
    N = rng.normal(size=(SIZE, SIZE)) + 1j * rng.normal(size=(SIZE, SIZE))
    matrix, seen = np.eye(SIZE) + 1e-4 * N, []

    def kept(values, signs):
        seen.append(values[:, 0].copy())
        return values

    equations = SimpleNamespace(apply=lambda c, exactly=False: matrix @ c.values)
    sides = rng.normal(size=(SIZE, 1)) + 1j * rng.normal(size=(SIZE, 1))
    _cycle(equations, kept, Columns(np.zeros((SIZE, 1)), 1), sides, np.full(1, 1e-4))
    basis = np.array(seen[:-1])
    assert len(basis) > 1
    assert np.abs(basis.conj() @ basis.T - np.eye(len(basis))).max() < 2e-6


@pytest.mark.parametrize("tolerance, fall", [(0.9, 0.1), (0.02, 0.01), (1e-10, 1e-4)])
def test_a_cycle_falls_to_half_the_tolerance_as_far_as_single_precision_goes(equations, monkeypatch, tolerance, fall):
    """Of the largest entry, over the scale of each column: a tenth at most, and a ten-thousandth at least"""
    seen = []
    monkeypatch.setattr(iteration, "_cycle", lambda *given: seen.append(given[-1]) or (np.zeros((SIZE, SIDES)), 1))
    gmres(equations, lambda values, signs: values, Columns(np.zeros((SIZE, SIDES)), 1), tolerance, 40)
    assert seen[0] == pytest.approx(np.full(SIDES, fall))


@pytest.mark.parametrize("apart, count", [(1.9e-4, 1), (2.1e-4, 2)])
def test_a_cycle_ends_where_as_little_is_left_as_asked(apart, count):
    """Of eigenvalues 1 and 1 + δ and a side with half of each, one iteration leaves δ/2"""
    matrix = np.diag([1.0, 1.0 + apart])
    equations = SimpleNamespace(apply=lambda c, exactly=False: matrix @ c.values)
    sides = np.ones((2, 1), complex)
    found = _cycle(equations, lambda values, signs: values, Columns(np.zeros((2, 1)), 1), sides, np.full(1, 1e-4))
    assert found[1] == count
