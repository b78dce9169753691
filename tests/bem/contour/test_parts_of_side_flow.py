"""Flow over the depth of a side piece by piece: the edge's functions, radii, and what is found beside the keel."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.contour import side_flow
from hakobune.bem.contour.plan.panels import gauss_rule
from hakobune.bem.contour.side_flow import DepthFlow, _at_keel, _count, _distances, _edge_functions


def test_functions_of_the_edge_and_their_slopes():
    r, step = np.array([0.01, 0.5, 2.0]), 1e-6
    value, slope = _edge_functions(r)
    true = np.stack([r ** (2 / 3), r ** (4 / 3), r**2, r, 2 / (3 * np.pi) * r**2 * np.log(r)], axis=1)
    assert value == pytest.approx(true)
    assert slope == pytest.approx((_edge_functions(r + step)[0] - _edge_functions(r - step)[0]) / (2 * step), rel=1e-6)


@pytest.mark.parametrize("start, surface, panels", [(0.1, 0.3, 4 + 4), (0.1, 5.0, 4 + 1), (1.0, 1.0, 0 + 2)])
def test_distances_double_away_from_the_keel_and_from_the_surface(start, surface, panels):
    """From `start` to the draft of 2 m: weights of 1, r and r⁴; ten points on each panel"""
    r, w = _distances(start, 2.0, surface)
    n = np.arange(5)
    assert np.array([np.sum(w * r**k) for k in n]) == pytest.approx((2.0 ** (n + 1) - start ** (n + 1)) / (n + 1))
    assert np.all(np.diff(r) > 0) and start < r[0] and r[-1] < 2.0
    edges = np.cumsum(np.concatenate([[start], w.reshape(-1, 10).sum(axis=1)]))
    if start < 1.0:
        assert edges[1] / edges[0] == pytest.approx(2.0)
    assert edges[-1] - edges[-2] <= max(surface, 1.0)


def test_sums_have_as_many_modes_as_sixty_lengths_of_the_last():
    """CUT h/π distance, upwards"""
    gap = SimpleNamespace(depth=10.0)
    assert _count(gap, 0.5) == int(np.ceil(60 * 10 / (np.pi * 0.5))) and _count(gap, 600 / np.pi) == 1


def test_what_the_flow_is_beside_the_keel_follows_from_its_slopes_farther_up():
    """φ = c + Σ cₚ r^(2p/3) of each amplitude, with w and b of the last two, is found and followed to the edge"""
    rng = np.random.default_rng(1)
    c, constant = np.zeros((5, 6)), rng.normal(size=6)
    c[:3], c[3:, 4:] = rng.normal(size=(3, 6)), np.eye(2)

    class Modes:
        def flow(self, r):
            value, slope = _edge_functions(r)
            return constant * (r[:, None] == 0.04) + value @ c * (r[:, None] == 0.04), slope @ c

    (r, w, value, slope), keel = _at_keel(Modes(), 0.01, 0.04)
    assert keel == pytest.approx(constant)
    assert value == pytest.approx(constant + _edge_functions(r)[0] @ c) and slope == pytest.approx(
        _edge_functions(r)[1] @ c
    )
    assert (
        len(r) == 10
        and np.all(r < 0.04)
        and [np.sum(w), np.sum(w * r), np.sum(w * r ** (-2 / 3))] == pytest.approx([0.04, 0.0008, 3 * 0.04 ** (1 / 3)])
    )


def test_sums_over_the_depth_are_squares_and_moments(monkeypatch):
    """∫ φ² and ∫ φ_z², φ at both ends, ∫ φ and ∫ z φ with z = r − d"""
    rng = np.random.default_rng(2)
    flow = DepthFlow(rng.uniform(0, 2, 5), rng.uniform(size=5), *rng.normal(size=(2, 5, 3)), *rng.normal(size=(2, 3)))
    asked = []
    monkeypatch.setattr(side_flow, "depth_flow", lambda freq, surface: asked.append(surface) or flow)
    found = side_flow.depth_sums(SimpleNamespace(k=0.25, body=SimpleNamespace(draft=2.0)))
    assert asked == [4.0]
    assert found.slopes == pytest.approx(np.einsum("q,qa,qb->ab", flow.weights, flow.value, flow.value))
    assert found.values == pytest.approx(np.einsum("q,qa,qb->ab", flow.weights, flow.slope, flow.slope))
    assert found.one == pytest.approx(flow.weights @ flow.value) and found.top is flow.top and found.keel is flow.keel
    assert found.z == pytest.approx((flow.weights * (flow.r - 2.0)) @ flow.value)


def test_the_outside_is_the_sum_of_decaying_modes_and_one_wave_over_its_norm(monkeypatch):
    """rᵢ rⱼ/∫Z₀² of the wave with its own map, of profiles in the order of the equations"""
    from hakobune.bem.contour import one_frequency

    seen = {}
    rows, weak = np.array([2.0, 3.0]), np.arange(9.0).reshape(3, 3)
    modes = SimpleNamespace(wave_norm=4.0)
    body = SimpleNamespace(outer_maps=lambda cls, degree, top: np.full((7, 3, 3), 10 * degree + top))
    one = SimpleNamespace(wave_rows=rows, modes=modes, body=body, degree=1, top=2, outer_weights="weights")

    def combined(weights, maps, products, single):
        seen.update(weights=weights, maps=maps, products=products, single=single)
        return np.arange(36.0).reshape(2, 3, 2, 3)

    monkeypatch.setattr(one_frequency, "combined", combined)
    found = one_frequency.ContourFrequency.outside(one, "cls", SimpleNamespace(weak=weak))
    assert found.tolist() == np.arange(36.0).reshape(6, 6).tolist() and seen["weights"] == "weights"
    assert seen["products"] == pytest.approx(np.array([[1.0, 1.5], [1.5, 2.25]])) and seen["single"] is weak
    assert np.all(seen["maps"] == 12)


@pytest.mark.parametrize("count", [1, 4, 9])
def test_a_rule_of_gauss_on_a_unit_length_is_kept_and_cannot_be_written(count):
    """Exact for powers up to 2 n − 1: ∫ x^m dx = 1/(m + 1)"""
    x, w = gauss_rule(count)
    for power in range(2 * count):
        assert w @ x**power == pytest.approx(1 / (power + 1), rel=1e-12)
    assert gauss_rule(count)[0] is x and not x.flags.writeable and not w.flags.writeable
