"""Equations of the flow under vertical-sided bodies with made-up potentials: every term written out."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.contour.matching import FixedTerms, fixed_terms, loads, solved
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.rigid_motions import Motion
from hakobune.bem.contour.several.bodies import REACH, SeveralBodies
from hakobune.bem.contour.several.fixed import Fixed
from hakobune.bem.modes import class_of

E, N, D, WAVES = 2, 3, 2, 4  # profiles, functions of the plan, motions, waves
M = E * N


@pytest.fixture
def rng():
    return np.random.default_rng(61)


@pytest.mark.parametrize("flux", [True, False])
def test_terms_of_motions_are_potentials_less_what_the_integral_over_the_bottom_becomes(rng, flux):
    """∫ψ u over the gap, ∬ψ w dA of the bottom, ∫ of 1, ζ² and ζ⁴ over the height"""
    s = 1.7
    profiles = SimpleNamespace(height=s, mean=rng.normal(size=E), second_moment=rng.normal(size=E),
                               mean_rows=rng.normal(size=E + 2))  # fmt: skip
    beneath = rng.normal(size=(E + 2, N, E + 2, N))
    value, slope, side = rng.normal(size=(3, D, 2, N))
    unit, bottom = rng.normal(size=N), rng.normal(size=D)
    found = fixed_terms(profiles, beneath, unit if flux else None, Motion(side=side, value=value, slope=slope), bottom)
    own, psi = slice(0, E), slice(E, E + 2)
    assert found.functions == N and np.array_equal(found.side.reshape(D, 2, N), side)
    assert found.beneath.reshape(E, N, E, N) == pytest.approx(beneath[own, :, own])
    both = np.stack([profiles.mean, profiles.second_moment])
    projected = np.einsum("daj,ap->dpj", value, both)
    driven = np.einsum("pjai,dai->dpj", beneath[own, :, psi], slope) - projected
    assert found.driven.T.reshape(D, E, N) == pytest.approx(driven)
    carried = np.einsum("dai,aipj->dpj", slope, beneath[psi, :, own]) - projected
    assert found.carried.reshape(D, E, N) == pytest.approx(carried)
    power = np.array([[s ** (2 * (a + b) + 1) / (2 * (a + b) + 1) for b in range(2)] for a in range(2)])
    within = np.einsum("daj,ab,cbj->dc", slope, power, value) - np.einsum(
        "dai,aibj,cbj->dc", slope, beneath[psi, :, psi], slope
    )
    assert found.own == pytest.approx(within - np.diag(bottom))
    if not flux:
        assert found.net is None and found.volume.tolist() == [0.0] * D
        return
    assert found.net.reshape(E, N) == pytest.approx(np.outer(profiles.mean, unit))
    assert found.volume == pytest.approx(np.einsum("a,daj,j->d", profiles.mean_rows[psi], slope, unit))


def terms(rng, flux):
    net, volume = (rng.normal(size=M), rng.normal(size=D)) if flux else (None, np.zeros(D))
    return FixedTerms(rng.normal(size=(M, M)), net, rng.normal(size=(D, 2 * N)), rng.normal(size=(M, D)),
                      rng.normal(size=(D, M)), volume, rng.normal(size=(D, D)))  # fmt: skip


@pytest.mark.parametrize("flux", [True, False])
def test_the_velocity_in_the_gap_makes_both_potentials_equal_and_keeps_the_volume(rng, flux):
    """Motions and waves; a wave of 1e9 m leaves no more than one of a metre, and one that drives nothing leaves 0"""
    fixed, outside = terms(rng, flux), rng.normal(size=(M + 2 * N,) * 2) + 1j * rng.normal(size=(M + 2 * N,) * 2)
    incident = rng.normal(size=(M + 2 * N, WAVES)) * [1.0, 1e9, 0.0, 1e-6]
    found = solved(fixed, outside, incident)
    assert found.velocity.shape == (E, N, D + WAVES) and found.constant.shape == (D + WAVES,)
    assert found.residual < 1e-12
    u = found.velocity.reshape(M, -1)
    left = (fixed.beneath - outside[:M, :M]) @ u
    if flux:
        left = left + np.outer(fixed.net, found.constant)
        assert fixed.net @ u == pytest.approx(np.array([*fixed.volume, 0, 0, 0, 0]), abs=1e-6)
    else:
        assert not found.constant.any()
    assert left[:, :D] == pytest.approx(fixed.driven + outside[:M, M:] @ fixed.side.T)
    for n, size in enumerate([1.0, 1e9, 1e-300, 1e-6]):
        assert left[:, D + n] == pytest.approx(incident[:M, n], abs=1e-11 * size)


def test_what_the_equations_leave_is_told_relative_to_each_side(rng, monkeypatch):
    """A solution a thousandth too large leaves a thousandth of the largest entry, whichever column"""
    true = np.linalg.solve
    monkeypatch.setattr(np.linalg, "solve", lambda A, b: 1.001 * true(A, b))
    for incident in (rng.normal(size=(M + 2 * N, WAVES)), 1e9 * rng.normal(size=(M + 2 * N, 1))):
        found = solved(terms(rng, False), rng.normal(size=(M + 2 * N,) * 2), incident)
        assert found.residual == pytest.approx(1e-3)


@pytest.mark.parametrize("flux", [True, False])
def test_loads_are_of_the_flow_on_the_side_and_under_the_keel(rng, flux):
    fixed, outside = terms(rng, flux), rng.normal(size=(M + 2 * N,) * 2)
    incident = rng.normal(size=(M + 2 * N, WAVES))
    flow = solved(fixed, outside, incident)
    found, u = loads(fixed, outside, flow, incident), flow.velocity.reshape(M, -1)
    assert found.shape == (D, D + WAVES)
    v = np.hstack([fixed.side.T, np.zeros((2 * N, WAVES))])
    potential = outside[M:, :M] @ u + outside[M:, M:] @ v + np.hstack([np.zeros((2 * N, D)), incident[M:]])
    under = fixed.carried @ u + np.outer(fixed.volume, flow.constant) + np.hstack([fixed.own, np.zeros((D, WAVES))])
    assert found == pytest.approx(fixed.side @ potential + under)


class Alone:
    """A body of e profiles, whose classes have as many functions as told; its terms are made up"""

    def __init__(self, rng, e, counts):
        self.profiles, self.plan = SimpleNamespace(mean=np.ones(e)), self
        self.counts, self.asked, self.made = dict(zip(CLASSES, counts, strict=True)), [], {}
        for cls, n in self.counts.items():
            d = sum(class_of(dof, "xy") == cls for dof in range(6))
            shapes = [(e * n, e * n), (e * n,), (d, 2 * n), (e * n, d), (d, e * n), (d,), (d, d)]
            parts = [rng.normal(size=shape) for shape in shapes]
            if cls != (1, 1) or not e:
                parts[1], parts[5] = None, np.zeros(d)
            self.made[cls] = FixedTerms(*parts)

    def subset(self, cls, degree, top):
        self.asked.append((degree, top))
        return np.arange(self.counts[cls])

    def fixed_terms(self, cls, degree, top, dofs):
        assert dofs == tuple(d for d in range(6) if class_of(d, "xy") == cls)
        self.asked.append((degree, top))
        return self.made[cls]


def test_bodies_stand_one_after_another_with_their_classes_within_each_profile(rng):
    one, bed = Alone(rng, 2, (3, 2, 1, 2)), Alone(rng, 0, (1, 2, 1, 1))
    whole = Fixed(SimpleNamespace(bodies=[one, bed]), (4, 5), (7, 8))
    assert set(one.asked) == {(4, 7)} and set(bed.asked) == {(5, 8)}
    n, n_bed = 8, 5
    gaps, sides = whole.layout
    assert gaps == [slice(0, 2 * n), slice(2 * n, 2 * n)] and whole.functions == [slice(0, n), slice(n, n + n_bed)]
    assert sides == [slice(2 * n, 4 * n), slice(4 * n, 4 * n + 2 * n_bed)] and whole.size == 4 * n + 2 * n_bed
    assert (whole.gaps, whole.net.shape, whole.volume.shape) == (2 * n, (2 * n, 1), (12, 1))
    seen = {name: np.zeros_like(getattr(whole, name)) for name in ("beneath", "side", "driven", "carried", "own")}
    net, volume, start = np.zeros(2 * n), np.zeros(12), 0
    for cls in CLASSES:
        c, made, dofs = one.counts[cls], one.made[cls], [d for d in range(6) if class_of(d, "xy") == cls]
        at = np.concatenate([p * n + start + np.arange(c) for p in range(2)])
        seen["beneath"][np.ix_(at, at)], seen["driven"][np.ix_(at, dofs)] = made.beneath, made.driven
        seen["side"][np.ix_(dofs, at)], seen["carried"][np.ix_(dofs, at)] = made.side, made.carried
        seen["own"][np.ix_(dofs, dofs)] = made.own
        if cls == (1, 1):
            net[at], volume[dofs] = made.net, made.volume
        start += c
    start = 0
    for cls in CLASSES:
        c, made, dofs = bed.counts[cls], bed.made[cls], [6 + d for d in range(6) if class_of(d, "xy") == cls]
        at = np.concatenate([2 * n + p * n_bed + start + np.arange(c) for p in range(2)])
        seen["side"][np.ix_(dofs, at)], seen["own"][np.ix_(dofs, dofs)] = made.side, made.own
        start += c
    for name, expected in seen.items():
        assert np.array_equal(getattr(whole, name), expected), name
    assert np.array_equal(whole.net[:, 0], net) and np.array_equal(whole.volume[:, 0], volume)


def test_what_one_body_sends_to_another_is_tested_with_the_rows_of_both(rng):
    """Σ weights κN / κ and one separate mode, row by row and function by function"""
    whole = Fixed(SimpleNamespace(bodies=[Alone(rng, 2, (1, 1, 0, 1)), Alone(rng, 1, (1, 0, 1, 0))]), (1, 2), (3, 4))
    es, ns, c = (2, 1), (3, 2), 4
    weights = {(a, b): rng.normal(size=(es[a] + 2, es[b] + 2, c)) for a in range(2) for b in range(2)}
    maps, single = rng.normal(size=(c, 5, 5)), rng.normal(size=(5, 5)) + 1j * rng.normal(size=(5, 5))
    rows = [rng.normal(size=e + 2) for e in es]
    found = whole.outside(weights, maps, rows, single)
    gaps, sides = whole.layout

    def place(body, row, function):
        if row < es[body]:
            return gaps[body].start + row * ns[body] + function
        return sides[body].start + (row - es[body]) * ns[body] + function

    seen = set()
    for (a, b), weight in weights.items():
        for p in range(es[a] + 2):
            for q in range(es[b] + 2):
                for i in range(ns[a]):
                    for j in range(ns[b]):
                        I, J = 3 * a + i, 3 * b + j
                        wanted = weight[p, q] @ maps[:, I, J] + rows[a][p] * rows[b][q] * single[I, J]
                        at = place(a, p, i), place(b, q, j)
                        assert found[at] == pytest.approx(wanted)
                        seen.add(at)
    assert len(seen) == found.size


def test_an_exterior_is_for_a_digit_more_and_for_what_decays_across_the_narrowest_gap(monkeypatch):
    from hakobune.bem.contour.several import bodies as module

    asked = []
    monkeypatch.setattr(module, "sender", lambda *them: asked.append(them) or len(asked))
    monkeypatch.setattr(module, "Exterior", lambda made, places: (made, places))
    held = SimpleNamespace(bodies=[SimpleNamespace(plan="one"), SimpleNamespace(plan="two")], gaps=(3.0, 7.0),
                           places="places", digits=2.5, cache={})  # fmt: skip
    for k, shortest in ((0.0, 3.0 / REACH), (50.0, min(1 / 50.0, 3.0 / REACH)), (0.01, 3.0 / REACH)):
        asked.clear()
        assert SeveralBodies._exterior(held, k, (4, 5)) == ([1, 2], "places")
        assert asked == [("one", 4, k, 3.0, 3.5, shortest), ("two", 5, k, 7.0, 3.5, shortest)]
