"""A line with bending stiffness against tensioned beams with hinged ends, and its books of energy."""

from dataclasses import replace

import numpy as np
import pytest
from node_loads import loads

from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.dynamics.lumped.band import OF_BAND, factor_band, substitute_band
from hakobune.mooring.lines.dynamics.lumped.bending import NEXT, OVERNEXT
from hakobune.mooring.lines.dynamics.lumped.workspace import to_rows
from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, FairleadMotion, simulate
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays

STILL = water_arrays(None, None, 9.80665)
L, T, MASS, EA = 100.0, 1e5, 50.0, 2e10
END = (L, 0.0, -50.0)


def beam(elements, stiffness, weight=1.0, **changes):
    """Taut between hinges on a level, in no water, pulled by about T"""
    given = dict(mass=MASS, weight=weight, diameter=0.1, axial_stiffness=EA, bending_stiffness=stiffness)
    given |= dict(damping_ratio=0.0, drag_normal=0.0, drag_tangential=0.0) | changes
    part = DynamicSegment(L / (1 + T / given["axial_stiffness"]), elements=elements, **given)
    return DynamicLine(part, (0.0, 0.0, END[2]), bed=None, density=0.0)


def residual(line, q, cq=0.0):
    """(n, 3) N, of nodes at rest at q, and the Loads it is from"""
    work = loads(line.system, q, cq=cq)
    return work.r[:, : len(q)].T.copy(), work


def frequencies(line):
    """(3,) rad/s, the lowest ones across, by differences of the forces"""
    q, n, h = start(line, END, STILL).position, line.elements + 1, 1e-4
    K = np.zeros((n - 2, n - 2))
    for j in range(1, n - 1):
        ahead, back = q.copy(), q.copy()
        ahead[j, 1] += h
        back[j, 1] -= h
        K[:, j - 1] = -(residual(line, ahead)[0] - residual(line, back)[0])[1:-1, 1] / (2 * h)
    return np.sqrt(np.linalg.eigvalsh(K / (MASS * line.segments[0].size))[:3])


@pytest.mark.parametrize("share", [0.1, 1.0, 10.0])
def test_tensioned_beams_with_hinged_ends_swing_as_they_should_at_second_order(share):
    """share : of bending in the stiffness of the first mode"""
    number = np.arange(1, 4) * np.pi / L
    EI = min(share * T / number[0] ** 2, 0.24 * T * L**2)
    errors = []
    for N in (10, 20, 40):
        line = beam(N, EI, axial_stiffness=2e8)
        pull = np.linalg.norm(residual(line, start(line, END, STILL).position)[0][-1])
        exact = number * np.sqrt((pull + EI * number**2) / MASS)
        errors.append(np.abs(frequencies(line) / exact - 1))
        assert np.all(errors[-1] < 1.2 * (number * L / N) ** 2 / 8 + 2e-3), errors[-1]
    assert np.all(np.log2(np.divide(errors[0], errors[1])) > 1.8), errors


def sagging(x, w, H, bend, edge):
    """m, of a hinged beam under w N/m pulled by H N: y = w/H (x (L − x)/2 − λ² (1 − cosh((x − L/2)/λ)/cosh(L/2λ)))

    bend : λ = √(EI/H), m; edge : that of the cosines
    """
    return w / H * (x * (L - x) / 2 - bend**2 * (1 - np.cosh((x - L / 2) / edge) / np.cosh(L / 2 / edge)))


@pytest.mark.parametrize("length", [0.05, 0.1, 0.2])
def test_a_heavy_tensioned_beam_sags_as_it_should(length):
    """length : λ/L.  Differences are exact but for the λ of the cosines, which is 1 + (ℓ/λ)²/24 times as long."""
    errors, w = [], 2.0
    for N in (16, 32, 64):
        line = beam(N, (length * L) ** 2 * T, w)
        q = start(line, END, STILL).position
        H = abs(residual(line, q)[0][-1, 0])
        x, deep = q[:, 0], END[2] - q[:, 2]
        bend, size = np.sqrt(line.segments[0].bending_stiffness / H), L / N
        load = w / (1 + H / EA)  # of what is stretched
        exact = sagging(x, load, H, bend, bend)
        errors.append(np.abs(deep - exact).max() / exact.max())
        if size < 1.5 * bend:
            known = sagging(x, load, H, bend, bend * (1 + (size / bend) ** 2 / 24)) - exact
            assert np.abs(deep - exact - known).max() < 0.1 * np.abs(known).max()
    assert errors[0] < 8e-4 and np.log2(errors[1] / errors[2]) > 1.8, errors


def test_a_bent_line_swings_without_loss_of_energy():
    """Of a hinged beam that is moved at its end and then left alone, the steps' own damping aside"""
    line = beam(16, 2e6, 20.0)
    t = np.linspace(0.0, 6.0, 601)
    lift = np.where(t < 1.0, 0.5 * np.sin(np.pi * np.minimum(t, 1.0)) ** 4, 0.0)
    motion = FairleadMotion.table(t, END + np.outer(lift, [0.0, 0.0, 1.0]))
    run = simulate(line, motion, 6.0, tolerance=1e-6, check_mesh=False)
    books, late = run.energies, run.time > 1.1
    swing = books.stored[late]
    assert books.supplied[-1] == pytest.approx(books.work[-1], rel=1e-3)
    assert np.ptp(swing) < 1e-3 * swing.mean()


def test_the_tangent_of_a_bent_line_is_that_of_its_forces_and_solved_as_a_matrix():
    parts = [beam(3, 4e5).segments[0], beam(4, 0.0).segments[0], beam(5, 9e5).segments[0]]
    line = DynamicLine(tuple(replace(p, length=p.length / 3) for p in parts), (0.0, 0.0, END[2]), bed=None, density=0.0)
    rng, n = np.random.default_rng(1), 13
    q = np.linspace((0, 0, END[2]), END, n) * (1 + 1e-3) + 0.05 * rng.standard_normal((n, 3))
    _, work = residual(line, q, 1.0)
    S, unit = np.zeros((n, 3, n, 3)), np.eye(3)
    for j in range(n):
        S[j, :, j] = work.D[:, j].reshape(3, 3)
        if j + 1 < n:
            beside = work.bending[NEXT, j] * unit - work.B[:, j + 1].reshape(3, 3)
            S[j, :, j + 1], S[j + 1, :, j] = beside, beside
        if j + 2 < n:
            S[j, :, j + 2] = S[j + 2, :, j] = work.bending[OVERNEXT, j] * unit
    S, way = S.reshape(3 * n, 3 * n), 1e-4 * rng.standard_normal((n, 3))
    change = (residual(line, q - way)[0] - residual(line, q + way)[0]) / 2
    found = (S @ way.ravel()).reshape(n, 3) - line.system.mass[:, None] * way
    assert np.allclose(found, change, atol=2e-6 * np.abs(change).max())
    right, x = to_rows(rng.standard_normal((n, 3))), np.zeros_like(work.r)
    pivots = np.zeros((n, OF_BAND))
    factor_band(work.D, work.B, work.bending, pivots, 1, n - 2)
    substitute_band(pivots, work.bending, right, x, 1, n - 2)
    inner = slice(3, 3 * n - 3)
    exact = np.linalg.solve(S[inner, inner], right[:, 1 : n - 1].T.ravel())
    assert np.allclose(x[:, 1 : n - 1].T.ravel(), exact, rtol=1e-9, atol=1e-12)


def test_a_beam_that_would_not_hang_is_refused_with_the_largest_stiffness():
    line = DynamicLine(DynamicSegment(110.0, MASS, 200.0, 0.1, EA, bending_stiffness=1e9), (0.0, 0.0, END[2]), bed=None)
    with pytest.raises(
        LineError, match=r"bending stiffness EI of 1e\+06 kN m².* at most .* kN \(at rest.*allowed: up to"
    ):
        start(line, END, STILL)


def test_little_stiffness_changes_little_and_none_nothing():
    """The pull of a chain at rest is of first order in EI"""

    def pull(stiffness):
        line = beam(20, stiffness, 500.0, damping_ratio=1.0)
        return np.linalg.norm(residual(line, start(line, END, STILL).position)[0][-1])

    none, less, more = pull(0.0), pull(1e2), pull(1e3)
    assert beam(20, 0.0).system.flexure.size == 0
    assert (more - none) == pytest.approx(10 * (less - none), rel=0.1)
