"""What a cylinder sends is what is on its side less the incident wave, order by order; what decays, by its rings."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import hankel1, jv, kv

from hakobune.bem.second_order import contour_surface
from hakobune.bem.second_order.contour_surface import CylinderSurface, _decaying

K, RADIUS, MOST = 0.4, 3.0, 4
FREQ = SimpleNamespace(amplitude=2.0 - 1.0j, omega=1.7, k=K, headings=np.array([0.0, 0.7]))


def surface(monkeypatch, whole, local):
    made = object.__new__(CylinderSurface)
    made.most, made.radius, made.waves = MOST, RADIUS, []
    made._of = lambda freq, columns, count: (whole[:count], local[:count])
    monkeypatch.setattr(contour_surface, "in_waves", lambda freq, motions: "columns of waves")
    monkeypatch.setattr(contour_surface, "of_motions", lambda freq: "columns of motions")
    return made


def test_what_is_sent_is_the_rest_of_the_potential_on_the_side(monkeypatch):
    """Σ a iᵐ J_m(kR) e^{im(θ−β)} + c_m H_m(kR) e^{imθ}"""
    rng, m = np.random.default_rng(1), np.arange(-MOST, MOST + 1)
    sent = rng.normal(size=(2, 9)) + 1j * rng.normal(size=(2, 9))
    coming = [
        FREQ.amplitude * np.exp(0.5j * np.pi * m) * np.exp(-1j * m * b) * jv(m, K * RADIUS) for b in FREQ.headings
    ]
    whole, local = np.array(coming) + sent * hankel1(m, K * RADIUS), rng.normal(size=(2, 3, 2, 5))
    made = surface(monkeypatch, whole, local)
    made.add(FREQ, np.zeros((2, 6)))
    assert len(made.waves) == 2
    for wave, own, near, beta in zip(made.waves, sent, local, FREQ.headings, strict=True):
        assert wave.sent == pytest.approx(own) and np.array_equal(wave.local, near)
        assert (wave.omega, wave.k, wave.direction, wave.incident) == (1.7, K, beta, 2.0 - 1.0j) and wave.most == MOST
        theta = 1.1  # the incident wave on the side at this angle, by its orders and as a plane wave
        orders = wave.incident_orders(30)
        plane = np.sum(orders * jv(np.arange(-30, 31), K * RADIUS) * np.exp(1j * np.arange(-30, 31) * theta))
        assert plane == pytest.approx((2 - 1j) * np.exp(1j * K * RADIUS * np.cos(theta - beta)))
    for field in made.joined():
        assert field.value.shape == (2, 0) and field.slope.shape == (2, 2, 0)


def test_motions_send_all_that_is_on_the_side(monkeypatch):
    rng, m = np.random.default_rng(2), np.arange(-MOST, MOST + 1)
    sent = rng.normal(size=(6, 9)) + 1j
    made = surface(monkeypatch, sent * hankel1(m, K * RADIUS), rng.normal(size=(6, 3, 2, 5)))
    field, waves = made.radiated(FREQ, None)
    assert field.value.shape == (6, 0) and len(waves) == 6
    assert np.array([wave.sent for wave in waves]) == pytest.approx(sent)
    assert {(wave.direction, wave.incident, wave.omega) for wave in waves} == {(0.0, 0.0, 1.7)}


@pytest.mark.parametrize("last", [0, 1, 5])
def test_what_decays_is_scaled_by_its_exponential(last):
    x = np.array([0.3, 2.0, 40.0])
    assert _decaying(last, x) == pytest.approx(np.exp(x) * kv(np.arange(last + 1)[:, None], x), rel=1e-12)


def test_rings_reach_to_where_the_slowest_mode_is_a_millionth(monkeypatch):
    """From the side on in intervals half as long again each, the first a fiftieth of the depth; orders and 6 more"""
    from hakobune.bem.depth_modes.gap import evanescent_wavenumbers
    from hakobune.bem.second_order.surface_far import orders_sent
    from hakobune.bem.waves import wavenumber

    problem = SimpleNamespace(depth=2.0, gravity=9.81)
    points = SimpleNamespace(body=SimpleNamespace(plan=SimpleNamespace(radius=RADIUS)))
    made = CylinderSurface(
        problem, points, SimpleNamespace(waterline="line"), np.array([0.5, 1.5]), np.array([0.1, 2.5])
    )
    edges = made.rings.edges
    assert edges[0] == RADIUS and np.diff(edges) == pytest.approx(0.04 * 1.5 ** np.arange(len(edges) - 1))
    slowest = evanescent_wavenumbers(2.5, 2.0, 1, 9.81)[0]
    assert edges[-2] < RADIUS + 14.0 / slowest <= edges[-1]
    assert made.most == orders_sent(float(wavenumber(2.5, 2.0, 9.81)) * RADIUS) + 6
    assert made.rings.count == 4 * (made.most // 2 + 1) and made.line == "line"
