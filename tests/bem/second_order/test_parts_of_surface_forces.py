"""Products of waves on the surface and waves on a grid of radii and directions, against plain sums."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, jv, jvp

from hakobune.bem.second_order import surface_forces
from hakobune.bem.second_order.surface_far import Rings
from hakobune.bem.second_order.surface_forces import Products, integrated
from hakobune.bem.second_order.surface_waves import Field, Wave

RNG = np.random.default_rng(5)


def field(*shape):
    def some():
        return RNG.normal(size=shape) + 1j * RNG.normal(size=shape)

    return Field(some(), np.stack([some(), some()]))


def test_factors_of_products_are_those_of_both_frequencies():
    """ωᵢ − ωⱼ;  2(ωᵢ − ωⱼ) KᵢKⱼ + ωᵢKⱼ² − ωⱼKᵢ²"""
    found = Products.of(np.array([0.9]), np.array([0.6]), 10.0)
    K, L = 0.081, 0.036
    assert found.steep[0] == pytest.approx(0.3) and (found.one[0], found.two[0]) == (0.9, 0.6)
    assert found.level[0] == pytest.approx(0.6 * K * L + 0.9 * L**2 - 0.6 * K**2)


@pytest.mark.parametrize("shared", [True, False])
def test_products_of_three_waves_are_summed_over_the_points(shared):
    """ψ {s ∇φᵢ·∇φⱼ + l φᵢφⱼ} + ∇ψ·(ωⱼ φⱼ∇φᵢ − ωᵢ φᵢ∇φⱼ) of each term"""
    q, p = 3, 5
    weights, products = RNG.uniform(size=p), Products(*RNG.normal(size=(4, q)))
    terms = [(field(q, p), field(q, p)) for _ in range(2)]
    psi = field(1 if shared else q, 6, p)
    true = np.zeros((q, 6), complex)
    for n in range(q):
        third = 0 if shared else n
        for f, g in terms:
            steep = np.sum(f.slope[:, n] * g.slope[:, n], axis=0)
            plain = products.steep[n] * steep + products.level[n] * f.value[n] * g.value[n]
            ways = products.two[n] * g.value[n] * f.slope[:, n] - products.one[n] * f.value[n] * g.slope[:, n]
            for d in range(6):
                true[n, d] += np.sum(weights * (psi.value[third, d] * plain
                                                + np.sum(psi.slope[:, third, d] * ways, axis=0)))  # fmt: skip
    assert integrated(products, terms, psi, weights) == pytest.approx(true)


@pytest.mark.parametrize("count, points, sizes", [(5, 400_000, [2, 2, 1]), (3, 0, [3]), (2, 3_000_000, [1, 1])])
def test_pairs_are_taken_a_million_products_at_a_time(count, points, sizes):
    chunks = surface_forces._chunks(count, points)
    assert [chunk.stop - chunk.start for chunk in chunks] == sizes and chunks[0].start == 0 and chunks[-1].stop == count


def test_waves_on_a_grid_are_sums_over_their_orders_with_what_is_local():
    """Value, ∂/∂r and ∂/r∂θ of c_m H_m(kr) e^{imθ}, of a local part of first degree in r, and of the incident wave"""
    rings, count = Rings(np.array([3.0, 4.0, 6.0]), 16, np.zeros(2)), 32
    x = np.array([-0.5, 0.1, 0.8])
    r, k, m = 3.5 + 0.5 * x, 0.7, np.arange(-2, 3)
    sent = RNG.normal(size=5) + 1j * RNG.normal(size=5)
    a, b = RNG.normal(size=16), RNG.normal(size=16)
    a[8] = b[8] = 0.0  # the last of an even count is left out
    local = a + b * rings.radii[0][:, None] + 0j
    waves = [
        Wave(0.9, k, 0.4, 1.0 - 2j, sent, np.array([local])),
        Wave(0.9, k, 0.4, 0.0, 0 * sent, np.zeros((0, 6, 16))),
    ]
    grid = surface_forces._Grid(r, count, rings, 0, x)
    theta = 2 * np.pi * (np.arange(count) + 0.5) / count
    both, coming = grid.fields(waves)
    turn = np.exp(1j * np.outer(m, theta))
    beside = np.exp(1j * np.outer(rings.orders, theta))
    z = k * r[:, None]
    value = (sent * hankel1(m, z)) @ turn + (a + b * r[:, None]) @ beside
    slope = (sent * k * h1vp(m, z)) @ turn + (b + 0 * r[:, None]) @ beside
    across = ((sent * hankel1(m, z) * 1j * m) @ turn + ((a + b * r[:, None]) * 1j * rings.orders) @ beside) / r[:, None]
    assert both.value[0] == pytest.approx(value.ravel()) and both.slope[0, 0] == pytest.approx(slope.ravel())
    assert both.slope[1, 0] == pytest.approx(across.ravel()) and not both.value[1].any()
    n = np.arange(-14, 15)
    orders = waves[0].incident_orders(14)
    value, slope = (
        (orders * jv(n, z)) @ np.exp(1j * np.outer(n, theta)),
        (orders * k * jvp(n, z)) @ np.exp(1j * np.outer(n, theta)),
    )
    assert coming.value[0] == pytest.approx(value.ravel(), abs=1e-8) and coming.slope[0, 0] == pytest.approx(
        slope.ravel(), abs=1e-8
    )
    assert not coming.value[1].any() and not coming.slope[:, 1].any()
    plane = (1 - 2j) * np.exp(1j * k * r[:, None] * np.cos(theta - 0.4))
    assert coming.value[0] == pytest.approx(plane.ravel(), abs=1e-6)
    beyond = surface_forces._Grid(r + 2, count, rings, 1, x).fields(waves[:1])[0]  # of an interval without local parts
    assert beyond.value[0] == pytest.approx(((sent * hankel1(m, k * (r[:, None] + 2))) @ turn).ravel())


def test_a_line_integral_is_that_of_the_flow_less_that_of_the_incident_wave():
    """−∮ ψ (ωᵢφᵢ ∂φⱼ/∂n − ωⱼφⱼ ∂φᵢ/∂n) dl with ∂φ/∂n = V − Kφ n_z of a side that moves"""
    from hakobune.bem.second_order.kinds import SUM
    from hakobune.bem.waves import incident_wave

    points, normals = RNG.normal(size=(4, 3)) * [1, 1, 0], RNG.normal(size=(4, 3))
    line = SimpleNamespace(points=points, normals=normals, weights=RNG.uniform(size=4))
    surfaces = SimpleNamespace(waterline=line, waterline_modes=RNG.normal(size=(4, 6)))
    omega, g = np.array([0.6, 0.9]), 10.0
    flow = SimpleNamespace(omega=omega, motion=RNG.normal(size=(2, 6)) + 1j, potential=RNG.normal(size=(2, 4)) - 2j)
    radiated = SimpleNamespace(potential=RNG.normal(size=(6, 4)) + 0.5j)
    waves = SimpleNamespace(problem=SimpleNamespace(gravity=g, depth=8.0), waves=[
        SimpleNamespace(direction=b, omega=w, k=k) for b, w, k in ((0.3, 0.6, 0.07), (1.0, 0.9, 0.11))])  # fmt: skip
    found = surface_forces.line_integral(surfaces, flow, radiated, waves, np.array([1]), np.array([0]), SUM)
    V = -1j * omega[:, None] * (flow.motion @ surfaces.waterline_modes.T)
    across = V - omega[:, None] ** 2 / g * flow.potential * normals[:, 2]
    alone = [incident_wave(points, w.direction, w.omega, w.k, 8.0, g) for w in waves.waves]
    true, incoming = 0.0, [np.sum(v[:, :2] * normals[:, :2], axis=1) for _, v in alone]
    for phi, normal, sign in ((flow.potential, across, -1), ([a for a, _ in alone], incoming, 1)):
        # of sums the second frequency is negative and its wave itself
        one = omega[1] * phi[1] * normal[0] + omega[0] * phi[0] * normal[1]
        true = true + sign * (radiated.potential * line.weights) @ one
    assert found[0] == pytest.approx(true)


@pytest.mark.parametrize("kind", ["difference", "sum"])
@pytest.mark.parametrize("at_once", [1_000_000, 14])
def test_forces_near_the_body_are_those_of_all_waves_less_those_of_the_incident_ones(kind, at_once, monkeypatch):
    """iΩρ/g · ¼i (waterline + ∬ of the whole − ∬ of the incident waves), pair by pair or two pairs at a time"""
    from hakobune.bem.second_order.kinds import DIFFERENCE, SUM

    monkeypatch.setattr(surface_forces, "AT_ONCE", at_once)
    kind = DIFFERENCE if kind == "difference" else SUM
    p, omega, rho, g = 7, np.array([0.5, 0.7, 1.1]), 1025.0, 9.81
    whole, incident, weights = field(3, p), field(3, p), RNG.uniform(size=p)
    several = []
    for force, pairs in ((0.2, [(1, 0), (2, 1), (2, 2), (0, 1), (2, 0)]), (0.6, [(2, 0), (1, 1)])):
        one, two = np.array(pairs).T
        near = Field(RNG.normal(size=(6, p)) + 1j, RNG.normal(size=(2, 6, p)) - 1j)
        several.append(surface_forces.PairsOfOne(force, one, two, near, [], RNG.normal(size=(len(one), 6)) + 0j))
    made = object.__new__(surface_forces.SurfaceForces)
    made.kind, made.omega, made.whole, made.incident, made.begin = kind, omega, whole, incident, np.zeros(3, int)
    made.tails = SimpleNamespace(add=lambda d, out: out.__iadd__(d.omega))  # as if it were all that is far away
    made.waves = SimpleNamespace(weights=weights, rings=SimpleNamespace(edges=[3.0]),
                                 problem=SimpleNamespace(density=rho, gravity=g))  # fmt: skip
    assert len(surface_forces._chunks(5, p)) == (1 if at_once > 14 else 3)
    for d, found in zip(several, made(several), strict=True):
        for n, (i, j) in enumerate(zip(d.one, d.two, strict=True)):
            a, b = omega[i], omega[j] if kind is DIFFERENCE else -omega[j]
            K, L, total = a**2 / g, b**2 / g, d.line[n] + d.omega
            for part, sign in ((whole, 1), (incident, -1)):
                bar = np.conj if kind is DIFFERENCE else np.array
                f, df, h, dh = part.value[i], part.slope[:, i], bar(part.value[j]), bar(part.slope[:, j])
                steep = (a - b) * np.sum(df * dh, axis=0) + (2 * (a - b) * K * L + a * L**2 - b * K**2) * f * h
                ways = b * h * df - a * f * dh
                psi = d.near.value * steep + np.sum(d.near.slope * ways[:, None], axis=0)
                total = total + sign * psi @ weights
            assert found[n] == pytest.approx(0.25j * 1j * d.omega * rho / g * total)


@pytest.mark.parametrize("at_once", [1_000_000, 1])
def test_on_an_interval_of_the_rings_a_pair_is_summed_that_has_no_tail_there(at_once, monkeypatch):
    """∬ ψQ from 4 to 6 m of what is sent with all, and of the incident wave with what is sent; by a fine rule in polar
    coordinates, ∂/∂x as ∂/∂r and ∂/r∂θ; a pair whose tail has begun is left out"""
    from hakobune.bem.second_order.kinds import DIFFERENCE

    monkeypatch.setattr(surface_forces, "AT_ONCE", at_once)
    rings, omega, k, beta, g = Rings(np.array([3.0, 4.0, 6.0]), 16, np.zeros(2)), [0.6, 0.9], [0.5, 0.8], 0.4, 9.81

    def wave(w, k, start):
        sent = RNG.normal(size=5) + 1j * RNG.normal(size=5)
        return Wave(w, k, beta, start, sent, np.zeros((0, 6, 16)))

    waves = [wave(w, own, 0.7 - 0.2j) for w, own in zip(omega, k, strict=True)]
    far = [wave(0.3, 0.3, 0.0) for _ in range(6)]
    held = SimpleNamespace(rings=rings, waves=waves, circle=SimpleNamespace(radius=2.0))
    d = surface_forces.PairsOfOne(0.3, np.array([1, 1, 0]), np.array([0, 1, 0]), None, far, None)
    factors = Products.of(np.array(omega)[d.one], np.array(omega)[d.two], g)
    total = [np.zeros((3, 6), complex)]
    surface_forces._add_interval(held, [d], [factors], 1, np.array([1, 2]), total, DIFFERENCE)
    assert not total[0][2].any()  # both of wave 0: its tail begins where the interval does
    x, v = np.polynomial.legendre.leggauss(40)
    theta = 2 * np.pi * np.arange(96) / 96
    r, turn = 5.0 + x, np.exp(1j * np.outer(np.arange(-2, 3), theta))
    area = (v * r)[:, None] * 2 * np.pi / 96

    def sent(one):
        m, z = np.arange(-2, 3), one.k * r[:, None]
        value = hankel1(m, z)
        return np.array([(one.sent * value) @ turn, (one.sent * one.k * h1vp(m, z)) @ turn,
                         (one.sent * 1j * m * value / r[:, None]) @ turn])  # fmt: skip

    def coming(one):
        ahead = np.cos(theta - beta)
        value = one.incident * np.exp(1j * one.k * r[:, None] * ahead)
        return np.array([value, 1j * one.k * ahead * value, -1j * one.k * np.sin(theta - beta) * value])

    for n, (i, j) in enumerate(zip(d.one[:2], d.two[:2], strict=True)):
        for mode, third in enumerate(far):
            psi, own = sent(third), 0.0
            mine, others = sent(waves[i]), sent(waves[j]).conj()
            for f, h in ((mine + coming(waves[i]), others), (mine, coming(waves[j]).conj())):
                plain = factors.steep[n] * np.sum(f[1:] * h[1:], axis=0) + factors.level[n] * f[0] * h[0]
                ways = factors.two[n] * h[0] * f[1:] - factors.one[n] * f[0] * h[1:]
                own = own + np.sum((psi[0] * plain + np.sum(psi[1:] * ways, axis=0)) * area)
            assert total[0][n, mode] == pytest.approx(own, rel=1e-7)
