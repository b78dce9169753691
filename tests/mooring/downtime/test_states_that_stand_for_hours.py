"""Representative states by hand, and the interpolant against a sea whose law is known."""

import numpy as np
import pytest
from scipy.special import ndtr

from hakobune.mooring.downtime.interpolant import fitted, where_it_may_change
from hakobune.mooring.downtime.representative import features, most_dissimilar

NORMAL = 1.645


def test_the_corners_of_a_square_come_first_then_its_middle():
    x = np.array([(a, b) for a in (0.0, 0.5, 1.0) for b in (0.0, 0.5, 1.0)])
    found = most_dissimilar(x, 9, 0)
    assert found[:2].tolist() == [0, 8] and set(found[2:4]) == {2, 6} and found[4] == 4
    assert sorted(found) == list(range(9))


def test_hours_that_are_alike_are_taken_once():
    assert len(most_dissimilar(np.array([[0.0], [0.0], [1.0]]), 3, 0)) == 2


def test_a_direction_of_a_turn_is_that_of_none_and_half_a_turn_is_as_far_as_the_whole_range_of_a_number():
    x = features([np.array([2.0, 2.0, 6.0])], [np.array([0.0, 2 * np.pi, np.pi])])
    np.testing.assert_allclose(x[0], x[1], atol=1e-12)
    np.testing.assert_allclose([x[2, 0] - x[0, 0], np.hypot(*(x[2, 1:] - x[0, 1:]))], 1.0)


def known_law(rng, hours):
    """Features, heights and ln used of hours: 1.3 ln H − 1 + 0.4 cos(β) + 0.3 sin(2π t)"""
    height, t, beta = rng.lognormal(0.2, 0.5, hours), rng.uniform(size=hours), rng.uniform(0, 2 * np.pi, hours)
    return (
        features([height, t], [beta]),
        height,
        1.3 * np.log(height) - 1 + 0.4 * np.cos(beta) + 0.3 * np.sin(2 * np.pi * t),
    )


def test_hours_by_the_interpolant_are_those_of_the_law_within_its_own_error():
    """Used is lognormal with σ = 0.12 about the law: an hour is beyond the limit with Φ(y/0.12)"""
    rng = np.random.default_rng(4)
    x, height, y = known_law(rng, 4000)
    rows = most_dissimilar(x, 60, np.argmax(height))
    fit = fitted(x[rows], height[rows], np.exp(y[rows, None] + 0.12 * rng.standard_normal((60, 3))))
    assert fit.scatter == pytest.approx(0.12, rel=0.15)
    mean, error = fit.predict(x, height)
    free = np.ones(len(x), bool)
    spread, sea = fit.spread_of_sum(x, height, mean, error, free)
    truth = ndtr(y / 0.12)
    assert sea == pytest.approx(np.sqrt(np.sum(truth * (1 - truth))), rel=0.1)
    assert abs(fit.chance(mean, error).sum() - truth.sum()) < NORMAL * spread < 0.05 * truth.sum()
    assert np.mean(np.abs(mean - y) < NORMAL * error) > 0.85


def test_states_are_added_where_verdicts_are_open_and_apart_from_each_other():
    x = np.linspace(0, 1, 101)[:, None]
    mean, error = 4 * (x[:, 0] - 0.5), np.full(101, 0.3)
    more = where_it_may_change(x, mean, error, 0.1, np.ones(101, bool), 3, np.array([[0.0]]))
    assert 45 <= more[0] <= 58 and np.diff(np.sort(more)).min() > 3
    stopped = np.zeros(101, bool)
    assert not len(where_it_may_change(x, mean, error, 0.1, stopped, 3, np.array([[0.0]])))
