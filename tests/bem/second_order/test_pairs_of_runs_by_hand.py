"""Forces of pairs put together by hand: which waves make a pair, in which order and block, and from which parts."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.second_order import quadratic_forces as module
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.quadratic_forces import QuadraticForces, QuadraticRun, _Pairs

RNG = np.random.default_rng(2)
OMEGA, HEADINGS, N, M = np.array([0.5, 0.6, 0.7]), np.array([0.2, 1.1]), 3, 2
KINDS = {"difference": DIFFERENCE, "sum": SUM}


def pairs_of(kind, row):
    """[(higher, lower)] numbers of frequencies whose difference or sum of numbers is the row"""
    if kind is DIFFERENCE:
        return [(low + row, low) for low in range(N - row)]
    return [(row - low, low) for low in range(N) if low <= row - low < N]


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("row", [0, 1, 2])
def test_a_pair_is_a_higher_and_a_lower_frequency_of_two_headings_each(name, row):
    """Waves frequency by frequency, each with its headings; of sums the lower frequency has the other sign"""
    kind = KINDS[name]
    found, wanted = _Pairs(OMEGA, HEADINGS, row, kind), []
    for high, low in pairs_of(kind, row):
        wanted += [(high, a, low, b) for a in range(M) for b in range(M)]
    high, a, low, b = np.array(wanted).T
    assert found.one.tolist() == (high * M + a).tolist() and found.two.tolist() == (low * M + b).tolist()
    (one, beta), (two, gamma) = found.waves
    assert one == pytest.approx(OMEGA[high]) and beta == pytest.approx(HEADINGS[a])
    assert two == pytest.approx(OMEGA[low] * (1 if kind is DIFFERENCE else -1)) and gamma == pytest.approx(HEADINGS[b])
    values = np.arange(6.0 * len(wanted)).reshape(-1, 6)
    assert found.shaped(values)[-1, 1, 0].tolist() == values[-2].tolist()


class Water:
    """Stand-in of first-order waves: what is radiated, bound and carried is made up, and remembered"""

    def __init__(self, transform):
        self.problem = SimpleNamespace(transform=transform, depth=12.0, gravity=9.81)
        self.asked = []

    def radiation(self, omega):
        self.asked.append(omega)
        return omega

    def radiated(self, run):
        return ("waves of", run)

    def long_waves(self, run, number):
        return np.arange(1.0, 7.0) * (1 + run) * np.sum(number, axis=1)[:, None]

    def of_moving_hull(self, flow, one, two, made):
        assert flow == "flow" and made[0] == "waves of"
        return np.arange(6.0) * made[1] + (10 * one + two)[:, None]


def a_run(kind, surface, moving=True):
    run = object.__new__(QuadraticRun)
    run.omega, run.headings, run.kind, run.moving, run.surface = OMEGA, HEADINGS, kind, moving, surface
    run.waves = Water(RNG.normal(size=(6, 6)))
    run.problem, run.flow, run.told = run.waves.problem, "flow", []
    run.frequency = kind.of(OMEGA[0], OMEGA[0]) + 0.1 * np.arange(3)
    run.squares = RNG.normal(size=(N, M, N, M, 6)) + 1j * RNG.normal(size=(N, M, N, M, 6))
    run.added, run.report = None, lambda part, done, of: run.told.append((part, done, of))
    run.of_surface = lambda several: [np.full((len(d.one), 6), d.omega) for d in several]
    return run


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("surface", [False, True])
@pytest.mark.parametrize("moving", [False, True])
def test_each_row_has_its_squares_its_bound_waves_the_moving_hull_and_the_surface(name, surface, moving, monkeypatch):
    """NaN where a row has no pair; nothing on the hull or surface of a force without frequency"""
    kind, block = KINDS[name], range(0, 3)
    run = a_run(kind, surface, moving)
    monkeypatch.setattr(module, "_on_surface", lambda waves, flow, pairs, radiated, made, omega: SimpleNamespace(
        one=pairs.one, omega=omega))  # fmt: skip
    found, T = run.solve(block), run.problem.transform
    assert run.waves.asked == pytest.approx(run.frequency) and found.frequency == pytest.approx(run.frequency)
    for row in block:
        omega = run.frequency[row]
        known = {low: high for high, low in pairs_of(kind, row)}
        for low in range(N):
            if low not in known:
                assert np.isnan(found.squares[row, low]).all() and np.isnan(found.total[row, low]).all()
                continue
            high = known[low]
            for a in range(M):
                for b in range(M):
                    assert found.squares[row, low, a, b] == pytest.approx(run.squares[high, a, low, b])
                    two = OMEGA[low] * (1 if kind is DIFFERENCE else -1)
                    bound = bound_waves((OMEGA[high], HEADINGS[a]), (two, HEADINGS[b]), 12.0, 9.81)
                    force = np.arange(1.0, 7.0) * (1 + omega) * np.sum(bound.number)
                    assert found.bound_wave[row, low, a, b] == pytest.approx(bound.amplitude * T @ force)
                    body = np.arange(6.0) * omega + 10 * (high * M + a) + low * M + b
                    assert found.body[row, low, a, b] == pytest.approx(body if moving and omega > 0 else np.zeros(6))
                    if surface:
                        assert found.surface[row, low, a, b] == pytest.approx(T @ np.full(6, omega))
    assert (found.surface is None) is not surface
    sizes = np.cumsum([4 * len(pairs_of(kind, row)) for row in range(3)])
    wanted = [("pairs", size, sizes[-1]) for size in (sizes[-1:] if surface else sizes)]
    assert run.told == wanted


def test_forces_are_solved_by_blocks_that_can_be_taken_up_and_cut(monkeypatch):
    monkeypatch.setattr(module, "BLOCK", 2)
    run = a_run(DIFFERENCE, False)
    assert run.blocks() == [range(0, 2), range(2, 3)] and run.blocks(2) == [range(2, 3)]
    whole = run.all()
    assert whole.frequency == pytest.approx([0.0, 0.1, 0.2]) and whole.squares.shape == (3, N, M, M, 6)
    some = whole.first(2)
    assert some.frequency == pytest.approx([0.0, 0.1]) and some.surface is None and some.omega is whole.omega
    for part in ("squares", "bound_wave", "body"):
        assert np.array_equal(getattr(some, part), getattr(whole, part)[:2], equal_nan=True)
    again = QuadraticForces.joined([some, run.solve(range(2, 3))])
    assert np.array_equal(again.total, whole.total, equal_nan=True)
