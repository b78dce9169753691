"""Intervals and nodes by which the tables of the Green function are integrated: how many, and where they end."""

import numpy as np
import pytest

from hakobune.bem.green import exact_forms
from hakobune.bem.green.exact_forms import InfiniteFrequency, PositiveFrequency, ZeroFrequency


@pytest.mark.parametrize("digits, count", [(4.3, 2), (4.5, 4), (8.7, 4), (8.9, 6), (17.0, 8), (22.1, 12)])
def test_an_interval_has_twice_as_many_nodes_as_there_are_4_4_in_the_digits(digits, count):
    x, w = exact_forms._gauss_intervals([1.0, 3.0, 4.0], digits)
    assert len(x) == 2 * count and np.sum(w) == pytest.approx(3.0)
    power = 2 * count - 1
    first = x < 3.0
    assert np.sum((w * x**power)[first]) == pytest.approx((3.0 ** (power + 1) - 1) / (power + 1))
    assert np.sum((w * x)[~first]) == pytest.approx(3.5) and first.sum() == count


def test_intervals_grow_twofold_to_the_widest():
    assert exact_forms._graded(0.0, 10.0, 1.0, 3.0) == [0.0, 1.0, 3.0, 6.0, 9.0, 10.0]
    assert exact_forms._graded(2.0, 2.0, 1.0, 3.0) == [2.0]


@pytest.mark.parametrize("pole, end, widest", [(1.0, 2.0, 4.0), (5.0, 11.0, 1.0), (0.3, 5.0, 1.0)])
def test_a_principal_value_has_nodes_on_both_sides_of_its_pole(pole, end, widest):
    """∫ dμ/(μ − p) from 0 to e is ln((e − p)/p); nodes are graded away from the pole and symmetric beside it"""
    x, w = exact_forms._principal_value_nodes(pole, end, widest, 20.0)
    assert np.sum(w / (x - pole)) == pytest.approx(np.log((end - pole) / pole), abs=1e-8)
    assert np.sum(w) == pytest.approx(end) and np.abs(x - pole).min() > 1e-3 * min(pole, widest)
    assert x.min() > 0 and np.sum(w * x) == pytest.approx(end**2 / 2)


@pytest.mark.parametrize("form", [ZeroFrequency, InfiniteFrequency])
def test_limits_are_integrated_from_the_bed_on_to_where_they_have_decayed(form, monkeypatch):
    asked = []
    monkeypatch.setattr(exact_forms, "_graded", lambda *them: asked.append(them) or [0.0, 1.0])
    form(20.0, 16.0)
    assert asked == [(0.0, pytest.approx(0.8), pytest.approx(0.05), pytest.approx(0.1))]


def test_waves_that_have_decayed_over_the_depth_have_no_pole(monkeypatch):
    """Below digits/h both poles within twice the larger; beyond it only what the bed changes"""
    graded, poles = [], []
    monkeypatch.setattr(exact_forms, "_graded", lambda *them: graded.append(them) or [0.0, 1.0])
    monkeypatch.setattr(exact_forms, "_principal_value_nodes", lambda *them: poles.append(them) or "nodes")
    short = PositiveFrequency(0.9, 0.9, 20.0, 16.0)
    assert short.whole is short.deep is None and poles == []
    assert graded == [(0.0, pytest.approx(0.8), pytest.approx(0.1), pytest.approx(0.1))]
    graded.clear()
    long = PositiveFrequency(0.05, 0.07, 20.0, 16.0)
    assert long.whole == long.deep == "nodes"
    assert poles == [(0.07, pytest.approx(0.14), 0.1, 16.0), (0.05, pytest.approx(0.14), 0.1, 16.0)]
    assert graded == [(pytest.approx(0.14), pytest.approx(0.8), pytest.approx(0.1), 0.1)]
    assert PositiveFrequency(0.45, 0.45, 20.0, 16.0).tail is None  # both poles and their surroundings reach beyond
    assert PositiveFrequency(0.01, 0.02, 20.0, 16.0).tail is not None and graded[-1][2] == pytest.approx(0.04)


@pytest.mark.parametrize("K", [1e-4, 0.05, 3.0])
def test_modes_keep_the_surface_condition_and_their_norms(K):
    """km tan km h = −K, between (m − ½)π/h and mπ/h; 2 (km² + K²)/((km² + K²) h − K)"""
    h = 12.0
    km, factor = PositiveFrequency(K, max(K, 0.05), h, 20.0).modes(9)
    m = np.arange(1, 10)
    assert np.all((km * h > (m - 0.5) * np.pi) & (km * h < m * np.pi))
    assert km * np.sin(km * h) == pytest.approx(-K * np.cos(km * h), abs=1e-13)
    norm = h / 2 * (1 + np.sin(2 * km * h) / (2 * km * h))  # ∫ cos² km(z + h) dz
    assert factor == pytest.approx(1 / norm, rel=1e-9)
    assert ZeroFrequency(h, 20.0).modes(3)[0] == pytest.approx(np.arange(1, 4) * np.pi / h)
    assert InfiniteFrequency(h, 20.0).modes(3)[0] == pytest.approx((np.arange(3) + 0.5) * np.pi / h)
    for form in (ZeroFrequency(h, 20.0), InfiniteFrequency(h, 20.0)):
        assert form.modes(3)[1] == pytest.approx(np.full(3, 2 / h))
    assert (ZeroFrequency(h, 20.0).net, InfiniteFrequency(h, 20.0).net) == (1 / h, 0.0)
