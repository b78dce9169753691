"""The interpolant beside its formulas, written as they stand in text-books: one member after the other."""

import numpy as np
import pytest
from exact.water_waves import wavenumber
from scipy.linalg import solve_triangular

from hakobune.bem.database.interpolant import (
    FAMILY,
    LEADS,
    NUGGET,
    SPREAD,
    Abscissa,
    Interpolant,
    Joined,
    Nodes,
    abscissa,
    chosen,
    unknown,
    windows,
)

G = 9.80665
REACHES = [(1.2, 4.8), (1.8, 7.2), (2.5, 10.0), (3.5, 14.0)]
ECHOES = [(1.0, 0.0, 0.0), (1.0, 0.05, 2.0), (1.0, 0.1, 2.0), (1.0, 0.2, 2.0), (0.5, 0.2, 2.0), (0.5, 0.4, 2.0),
          (0.1, np.exp(-1.0), 2.5), (0.1, np.exp(-0.5), 2.5)]  # fmt: skip


def places(omega, depth=20.0, length=80.0):
    return abscissa(omega, depth, G, length)


def test_the_arguments_are_frequency_and_wavenumber_made_dimensionless_by_the_length():
    """s = ½ (ω √(L/g) + √(kL)), and kL"""
    omega = np.array([0.3, 1.7])
    found = places(omega)
    kL = 80 * np.array([wavenumber(w, 20.0) for w in omega])
    assert found.phase == pytest.approx(kL)
    assert found.smooth == pytest.approx(0.5 * (omega * np.sqrt(80 / G) + np.sqrt(kL)))


def test_the_family_has_every_reach_with_every_row_of_echoes_and_both_leads():
    """Delays 0, d, 2d … D; weights 1, r, r² … over their sum"""
    assert len(FAMILY) == 4 * 8 * 2 and LEADS == (1.0, 0.7)
    members = iter(FAMILY)
    for reach, nodes in REACHES:
        for step, ratio, last in ECHOES:
            for lead in (1.0, 0.7):
                one = next(members)
                delays = np.arange(round(last / step) + 1) * step
                weights = np.array([ratio**i for i in range(len(delays))])
                assert (one.reach, one.nodes, one.lead) == (reach, nodes, lead)
                np.testing.assert_allclose(one.delays, delays, atol=1e-12)
                np.testing.assert_allclose(one.weights, weights / weights.sum())
    np.testing.assert_allclose(SPREAD.delays, np.arange(26) * 0.1, atol=1e-12)
    np.testing.assert_allclose(SPREAD.weights[1:] / SPREAD.weights[:-1], np.exp(-1 / 1.2))
    assert SPREAD.weights.sum() == pytest.approx(1.0) and (SPREAD.reach, SPREAD.nodes, SPREAD.lead) == (1.2, np.inf, 1)


def kernel(member, x, y, reach):
    """exp(−(s − t)²/2ℓ²) Σ aⱼ exp(i(k − q) dⱼ)"""
    out = np.zeros((len(x.smooth), len(y.smooth)), complex)
    for i, (s, k) in enumerate(zip(*x, strict=True)):
        for j, (t, q) in enumerate(zip(*y, strict=True)):
            out[i, j] = np.exp(-((s - t) ** 2) / (2 * reach**2)) * np.sum(
                member.weights * np.exp(1j * (k - q) * member.delays)
            )
    return out


def by_hand(x, y, values, lead, real=False):
    """Value and deviation (q, c) of one group (n, c) with leads (c,), by all members"""
    mean_gap = np.ptp(x.smooth) / (len(x.smooth) - 1)
    guesses, errors, scales, lefts = [], [], [], []
    for member in FAMILY:
        reach = min(member.reach, member.nodes * mean_gap)
        part = (lambda a: a.real) if real else (lambda a: a)
        K = part(kernel(member, x, x, reach)) + NUGGET * np.eye(len(x.smooth))
        row, inverse = part(kernel(member, y, x, reach)), np.linalg.inv(K)
        whitened = solve_triangular(np.linalg.cholesky(K), row.conj().T, lower=True)  # the inverse errs by 1e-7
        f = values * np.exp(1j * member.lead * x.phase[:, None] * lead)
        a = inverse @ f
        guess = (row @ a) * np.exp(-1j * member.lead * y.phase[:, None] * lead)
        left_out = a / np.diag(inverse)[:, None]  # Rippa (1999): the error at each node of a fit without it
        errors.append(np.sum(np.abs(left_out) ** 2))
        scales.append(np.mean(np.sum(f.conj() * a, axis=0).real / len(f)))
        lefts.append(np.maximum(1 - np.sum(np.abs(whitened) ** 2, axis=0) - 2 * NUGGET, 0))
        guesses.append(guess)
    weights = np.array(errors) ** -2.0
    weights /= weights.sum()
    guesses = np.array(guesses)
    mean = np.einsum("m,mqc->qc", weights, guesses)
    left = weights @ np.sqrt(np.array(lefts) * np.array(scales)[:, None])
    spread = np.einsum("m,mqc->qc", weights, np.abs(guesses - mean) ** 2).mean(axis=1)
    return mean, np.sqrt(left**2 + spread)


def echoing(omega):
    k = np.array([wavenumber(w, 20.0) for w in omega])
    smooth = 1 / (0.9 - 0.3j - omega)
    ahead = np.exp(-1j * np.outer(k, [40.0, 25.0]))
    return np.stack([smooth, smooth * (1 + 0.2 * np.exp(80j * k))], axis=1) * ahead


def test_values_and_deviations_are_those_of_all_members_weighted_by_their_errors_at_nodes_left_out():
    """Inverse fourth powers; deviations of what is left open, and of what the members differ by"""
    omega, between = np.linspace(0.3, 1.5, 9), np.array([0.37, 0.83, 1.38])
    x, y, lead = places(omega), places(between), np.array([0.5, 0.3125])
    fit = Interpolant(Nodes(x), echoing(omega)[:, None], lead[None])
    value, deviation = by_hand(x, y, echoing(omega), lead)
    np.testing.assert_allclose(fit.value(y)[:, 0], value, rtol=1e-6)
    np.testing.assert_allclose(fit.deviation(y)[:, 0], deviation, rtol=1e-3)  # entries of inverses are 1e9


def test_real_functions_take_the_real_part_of_the_kernel():
    omega, between = np.linspace(0.3, 1.5, 9), np.array([0.37, 0.83, 1.38])
    x, y, values = places(omega), places(between), np.cos(3 * omega)[:, None] + 0.1 * omega[:, None]
    fit = Interpolant(Nodes(x, real=True), values[:, None], np.zeros((1, 1)))
    value, deviation = by_hand(x, y, values, np.zeros(1), real=True)
    np.testing.assert_allclose(fit.value(y)[:, 0], value.real, rtol=1e-6)
    np.testing.assert_allclose(fit.deviation(y)[:, 0], deviation, rtol=1e-3)  # entries of inverses are 1e9


def test_what_a_fit_lacks_at_its_nodes_is_put_back_by_straight_lines():
    omega = np.linspace(0.3, 1.5, 9)
    x, values = places(omega), echoing(omega)
    alone = Interpolant(Nodes(x), values[:, None], np.zeros((1, 2)))
    both = Joined(x, windows(x), values[:, None], np.zeros((1, 2)))
    np.testing.assert_allclose(both.value(x)[:, 0], values, rtol=1e-13)
    assert both.deviation(x).max() < 1e-6 * np.abs(values).max()
    share = np.array([0.25, 0.8])
    y = Abscissa(*(part[[2, 6]] + share * (part[[3, 7]] - part[[2, 6]]) for part in x))
    lack = values - alone.value(x)[:, 0]
    expected = alone.value(y)[:, 0] + (1 - share)[:, None] * lack[[2, 6]] + share[:, None] * lack[[3, 7]]
    np.testing.assert_allclose(both.value(y)[:, 0], expected, rtol=1e-13)
    at_nodes = alone.deviation(x)[:, 0] ** 2
    known = ((1 - share) * at_nodes[[2, 6]] + share * at_nodes[[3, 7]]) * (1 - 2 * share) ** 2
    np.testing.assert_allclose(both.deviation(y)[:, 0] ** 2, alone.deviation(y)[:, 0] ** 2 - known, rtol=1e-9)


def test_many_nodes_are_fitted_by_windows_with_neighbours_on_both_sides():
    """Up to 64 in one; of 65 three windows, each with 16 neighbours, whose gaps follow one another"""
    assert [(w.first, w.last, w.low, w.high) for w in windows(places(np.linspace(0.2, 2, 64)))] == [(0, 64, 0, 63)]
    found = windows(places(np.linspace(0.2, 2, 65)))
    assert [(w.first, w.last, w.low, w.high) for w in found] == [(0, 38, 0, 21), (5, 59, 21, 42), (26, 65, 42, 64)]
    omega = np.linspace(0.2, 2, 65)
    x, values = places(omega), echoing(omega)[:, None]
    joined = Joined(x, found, values, np.zeros((1, 2)))
    middle = 0.5 * (omega[1:] + omega[:-1])
    np.testing.assert_allclose(joined.value(places(middle))[:, 0], echoing(middle), atol=2e-4)


def test_the_next_node_is_where_most_is_left_open_and_then_the_farthest():
    x, y = places(np.array([0.3, 1.5])), places(np.linspace(0.3, 1.5, 25))
    K = kernel(SPREAD, x, x, 1.2) + NUGGET * np.eye(2)
    row = kernel(SPREAD, y, x, 1.2)
    left = 1 - np.einsum("qi,ij,qj->q", row, np.linalg.inv(K), row.conj()).real
    np.testing.assert_allclose(unknown(x, y), left, atol=1e-9)
    assert chosen(x, y, 1) == [int(np.argmax(left))]
    short = places(np.array([0.5, 0.5004])), places(np.array([0.5001, 0.50022, 0.5003]))
    assert unknown(*short).max() < 2 * NUGGET and chosen(*short, 1) == [1]


def test_the_next_place_is_where_most_is_unknown_or_else_the_farthest(monkeypatch):
    """Twice the nugget of the kernel, 2e-9 of its variance, cannot be told from nothing"""
    from hakobune.bem.database import interpolant

    def at(*s):
        return interpolant.Abscissa(*(np.array(s, float) for _ in interpolant.Abscissa._fields))

    places, known = at(1.0, 2.0, 6.0), at(0.0, 10.0)
    for most, first in ((2.1e-9, 0), (1.9e-9, 2)):
        monkeypatch.setattr(interpolant, "unknown", lambda x, y, most=most: np.array([most, 1e-9, 0.0]))
        assert interpolant.chosen(known, places, 1) == [first]
    monkeypatch.setattr(interpolant, "unknown", lambda x, y: np.zeros(3))
    assert interpolant.chosen(known, places, 3) == [2, 1, 0]


@pytest.mark.parametrize("pole, residue, errors, kept", [
    (1.2 - 0.29j, 1.0, {0: 1.0, 1: 0.09}, 1), (1.2 - 0.31j, 1.0, {0: 1.0, 1: 0.0}, 0),
    (0.49 - 0.1j, 1.0, {0: 1.0, 1: 0.0}, 0), (0.51 - 0.1j, 1.0, {0: 1.0, 1: 0.0}, 1),
    (1.99 - 0.1j, 1.0, {0: 1.0, 1: 0.0}, 1), (2.01 - 0.1j, 1.0, {0: 1.0, 1: 0.0}, 0),
    (1.2 - 0.1j, 1.0, {0: 1.0, 1: 0.11}, 0), (1.25 - 0.05j, 0.0101 * np.hypot(0.05, 0.05), {0: 1.0, 1: 0.0}, 1),
    (1.25 - 0.05j, 0.0099 * np.hypot(0.05, 0.05), {0: 1.0, 1: 0.0}, 0),
])  # fmt: skip
def test_a_pole_is_believed_that_is_sharp_inside_seen_and_foretells_nodes_left_out(
    monkeypatch, pole, residue, errors, kept
):
    """Imaginary part below 0.3, between the nodes, a hundredth at the nearest of them, ten times less squared error"""
    from hakobune.bem.database import interpolant

    x = Abscissa(*[np.array([0.5, 1.0, 1.2, 1.6, 2.0])] * 2)
    monkeypatch.setattr(interpolant, "poles", lambda s, f: (np.array([pole]), np.array([[residue, 0.1 * residue]])))
    monkeypatch.setattr(interpolant, "_left_out", lambda x, f, more: np.array([5.0, errors[len(more)]]))
    found = interpolant.ringing_of(x, np.ones((5, 2)))
    assert len(found) == kept and (not kept or found[0] == pole)


def test_poles_are_tried_from_the_one_that_shows_most_each_beside_those_that_are_believed(monkeypatch):
    """Their width is on one side, whatever the sign found; eight at most"""
    from hakobune.bem.database import interpolant

    x, tried = Abscissa(*[np.linspace(0.0, 10.0, 11)] * 2), []
    found = np.arange(1.0, 10.0) + 0.1j
    sizes = np.array([5, 9, 1, 8, 2, 7, 3, 6, 4.0])

    def left_out(x, f, more):
        tried.append(list(more))
        return np.array([0.05 ** len(more) if 4.0 - 0.1j not in more else 9.0])

    monkeypatch.setattr(interpolant, "poles", lambda s, f: (found, sizes[:, None] * np.ones((1, 2))))
    monkeypatch.setattr(interpolant, "_left_out", left_out)
    kept = interpolant.ringing_of(x, np.ones((11, 2)))
    order = [2, 4, 6, 8, 1, 9, 7, 5]
    assert [one[-1] for one in tried[1:]] == [k - 0.1j for k in order] and tried[0] == []
    assert kept.tolist() == [k - 0.1j for k in order if k != 4]
    assert tried[3] == [2 - 0.1j, 6 - 0.1j]


def test_between_nodes_of_a_later_window_the_deviation_is_that_of_its_own_fit():
    """σ² less what its fit leaves at its two nodes, by straight lines and (1 − 2t)²; values likewise"""
    omega = np.linspace(0.2, 2, 65)
    x, values = places(omega), echoing(omega)[:, None]
    found = windows(x)
    joined = Joined(x, found, values, np.zeros((1, 2)))
    for window, node in zip(found, (10, 30, 60), strict=True):
        y = Abscissa(*(0.7 * part[[node]] + 0.3 * part[[node + 1]] for part in x))
        t = (y.smooth[0] - x.smooth[node]) / (x.smooth[node + 1] - x.smooth[node])
        own = slice(window.first, window.last)
        nodes = Abscissa(*(part[own] for part in x))
        fit = Interpolant(Nodes(nodes), values[own], np.zeros((1, 2)))
        i = node - window.first
        at_nodes, lack = fit.deviation(nodes)[:, 0], values[own] - fit.value(nodes)
        known = ((1 - t) * at_nodes[i] ** 2 + t * at_nodes[i + 1] ** 2) * (1 - 2 * t) ** 2
        expected = np.sqrt(max(fit.deviation(y)[0, 0] ** 2 - known, 0.0))
        assert joined.deviation(y)[0, 0] == pytest.approx(expected, rel=1e-9) and expected > 0
        assert joined.value(y)[0] == pytest.approx(fit.value(y)[0] + (1 - t) * lack[i] + t * lack[i + 1], rel=1e-9)
