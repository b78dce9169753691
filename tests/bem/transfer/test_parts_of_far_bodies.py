"""Pieces of bodies coupled by partial waves by hand: momentum around a circle, orders and modes that arrive, cost."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, iv, ivp, jv, jvp, kv, kvp

from hakobune.bem.contour.body import MARGIN
from hakobune.bem.contour.several.exterior import Place
from hakobune.bem.contour.solver import prepare_cylinder
from hakobune.bem.transfer.cost import cost
from hakobune.bem.transfer.drift import mean_force
from hakobune.bem.transfer.far_bodies import Coupled, FarBodies, prepare_far
from hakobune.bem.transfer.partial_waves import PartialWaves, highest_order, to_complex, to_real

RADIUS, THETA = 2.0, 2 * np.pi * np.arange(64) / 64


def profile(one, r):
    """R and S of all orders at a distance with their slopes, four (2M + 1,), by definition"""
    m, k, a = np.abs(one.orders), one.k, RADIUS
    if one.kind == "radiating":
        size = np.abs(hankel1(m, k * a))
        return jv(m, k * r) * size, k * jvp(m, k * r) * size, hankel1(m, k * r) / size, k * h1vp(m, k * r) / size
    size = iv(m, k * a)
    return iv(m, k * r) / size, k * ivp(m, k * r) / size, kv(m, k * r) * size, k * kvp(m, k * r) * size


def momentum(one, regular, sent, r):
    """∮ (g ∂f*/∂n − f* ∂g/∂n) ds at distance r, of g = ∂f/∂x, ∂f/∂y, ∂f/∂θ, by the trapezoidal rule; shape (3,)"""
    R, dR, S, dS = profile(one, r)
    wave, m = np.exp(1j * np.outer(THETA, one.orders)), one.orders
    value, slope = R * regular + S * sent, dR * regular + dS * sent
    sign = -1 if one.kind == "radiating" else 1  # ∇²f = sign k² f
    f, f_r = wave @ value, wave @ slope
    f_t, f_rt, f_tt = wave @ (1j * m * value), wave @ (1j * m * slope), wave @ (-(m**2) * value)
    f_rr = sign * one.k**2 * f - f_r / r - f_tt / r**2
    c, s = np.cos(THETA), np.sin(THETA)
    g = [c * f_r - s * f_t / r, s * f_r + c * f_t / r, f_t]
    around = f_rt / r - f_t / r**2
    g_t = [c * f_rr - s * around, s * f_rr + c * around, f_rt]
    ds = 2 * np.pi * r / len(THETA)
    return np.array([np.sum(p * f_r.conj() - f.conj() * q) * ds for p, q in zip(g, g_t, strict=True)])


@pytest.mark.parametrize("r", [2.0, 3.1])
def test_the_mean_force_is_the_momentum_that_crosses_a_circle_of_any_size(r):
    """Waves and two modes that decay, each with its ∫Zₙ² dz; two flows of made-up coefficients"""
    waves = [PartialWaves("radiating", 0.7, 3), PartialWaves("decaying", 0.4, 2), PartialWaves("decaying", 1.1, 1)]
    norms, rng = [5.0, 4.0, 3.0], np.random.default_rng(1)
    regular, sent = (rng.normal(size=(7 + 5 + 3, 2)) + 1j * rng.normal(size=(15, 2)) for _ in range(2))
    found = mean_force(waves, norms, RADIUS, regular, sent, 1025.0)
    for flow in range(2):
        parts = zip(waves, norms, (slice(0, 7), slice(7, 12), slice(12, 15)), strict=True)
        Q = sum(n * momentum(one, regular[own, flow], sent[own, flow], r) for one, n, own in parts)
        assert found[flow] == pytest.approx(-0.25 * 1025.0 * Q.real, rel=1e-9)


def first(left, most=60):
    """The first order m from 1 on of which so little is left, or the last"""
    return next((m for m in range(1, most + 1) if left(m)), most)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-9])
@pytest.mark.parametrize("a, R, gap", [(2.0, 5.0, 1.0), (3.0, 7.0, 0.2), (1.0, 40.0, 30.0)])
def test_orders_are_as_high_as_what_arrives_of_them_is_above_the_tolerance(a, R, gap, tolerance):
    """(a/R)ᵐ; |Hₘ(kR)/Hₘ(ka)| or Jₘ(ka), above ka; {Kₘ(κ(a + g))/Kₘ(κa)}², to the hull and back"""

    def wave(m, k):
        return m > k * a and max(abs(hankel1(m, k * R) / hankel1(m, k * a)), abs(jv(m, k * a))) < tolerance

    def local(m, k):
        return min((a / R) ** m, (kv(m, k * (a + gap)) / kv(m, k * a)) ** 2) < tolerance

    assert highest_order("laplace", 0.0, a, R, gap, tolerance, 60) == first(lambda m: (a / R) ** m < tolerance)
    for k in (0.3, 1.1, 2.6):
        assert highest_order("radiating", k, a, R, gap, tolerance, 60) == first(partial(wave, k=k))
        assert highest_order("decaying", k, a, R, gap, tolerance, 60) == first(partial(local, k=k))


def test_orders_stay_below_what_a_number_holds():
    """1e150 of |Hₘ(ka)| and |H₂ₘ(kR)|, of 1/Iₘ(κa) e^{κa} and K₂ₘ(κR) e^{κR}: asked for what nothing meets"""
    a, R, k = 1.0, 3.0, 1e-3
    wave = max(m for m in range(1, 61) if max(abs(hankel1(m, k * a)), abs(hankel1(2 * m, k * R))) < 1e150)
    assert highest_order("radiating", k, a, R, 1.0, 0.0, 60) == wave < 40
    decays = max(m for m in range(1, 61) if max(np.exp(k * a) / iv(m, k * a), kv(2 * m, k * R) * np.exp(k * R)) < 1e150)
    assert highest_order("decaying", k, a, R, 1.0, 0.0, 60) == decays < 40
    assert highest_order("laplace", 0.0, a, R, 1.0, 0.0, 60) == 60
    assert highest_order("radiating", 1e-200, a, R, 1.0, 1e-3, 60) == 1


def bodies_of(tolerance=1e-3):
    """Two circles of 2 m and one of 3 m"""
    axes = np.array([0.0, 7.0, 15.0 + 3.0j])
    apart = np.where(np.eye(3, dtype=bool), np.inf, np.abs(axes[:, None] - axes))
    return SimpleNamespace(tolerance=tolerance, apart=apart, axes=axes, radii=np.array([2.0, 2.0, 3.0]),
                           gaps=(3.0, 3.0, 4.0))  # fmt: skip


def test_modes_are_as_many_as_get_across_the_narrowest_gap_and_back():
    """e^(−2κg) above a tenth of the tolerance, at least one; orders of the body that needs most, two at least"""
    bodies, kappa = bodies_of(), np.array([0.3, 1.5, 1.54, 2.0])
    edge = -np.log(1e-4) / 6.0  # 1.535
    assert kappa[1] < edge < kappa[2]
    modes = SimpleNamespace(k=0.8, wavenumbers=kappa)
    found = FarBodies.waves(bodies, "radiating", modes)
    assert [(one.kind, one.k) for one in found] == [("radiating", 0.8), ("decaying", 0.3), ("decaying", 1.5)]
    nearest = bodies.apart.min(axis=1)
    for one in found:
        each = zip(bodies.radii, nearest, bodies.gaps, strict=True)
        assert one.last == max(2, *(highest_order(one.kind, one.k, *body, 1e-4, 60) for body in each))
    assert [one.kind for one in FarBodies.waves(bodies, "decaying", modes)] == ["decaying"] * 2
    assert [one.kind for one in FarBodies.waves(bodies, "laplace", SimpleNamespace(k=0.0, wavenumbers=kappa + 9))] == [
        "laplace", "decaying",
    ]  # fmt: skip
    bodies.gaps = (90.0,) * 3
    assert [one.last for one in FarBodies.waves(bodies, "decaying", modes)] == [2]


@pytest.mark.parametrize("kind", ["radiating", "decaying", "laplace"])
def test_what_is_kept_of_a_body_is_weighed_as_the_edge_of_the_nearest_circle_sends_it(kind):
    """|H_q(k(a + c))| / |H_q(ka)|, or a plane wave's 1/|H_q(ka)|; K_q(κ(a + c)) I_q(κa); (a/(a + c))^q; over the
    largest, and c the least water beside any of the equal bodies"""
    k, a, c, q = 0.6, 2.0, 3.0, np.arange(4)
    body, other = (SimpleNamespace(plan=SimpleNamespace(reach=r)) for r in (2.0, 3.0))
    bodies = SimpleNamespace(bodies=[other, body, body], clear=np.array([0.1, 3.4, 3.0]))
    held = SimpleNamespace(bodies=bodies, waves=[PartialWaves(kind, k, 3)])
    size = np.abs(hankel1(q, k * a))
    one = np.maximum(np.abs(hankel1(q, k * (a + c))) / size, 1 / size)
    if kind == "decaying":
        one = kv(q, k * (a + c)) * iv(q, k * a)
    if kind == "laplace":
        one = (a / (a + c)) ** q
    assert Coupled._size(held, body) == pytest.approx(np.concatenate([one, one[1:]]) / one.max(), rel=1e-9)
    held.waves = [PartialWaves("decaying", 80.0, 1)]  # e^(−240)
    assert Coupled._size(held, body).tolist() == [1.0] * 3
    held.waves = [PartialWaves("radiating", k, 0), PartialWaves("decaying", 12.0, 0)]  # e^(−36)
    assert Coupled._size(held, body).tolist() == [1.0, 1e-12]


def test_the_water_beside_a_circle_is_counted_to_the_edge_of_the_nearest():
    """Circles of 2, 2 and 3 m at 0, 7 and 15 + 3i"""
    bodies = bodies_of()
    far = abs(8.0 + 3.0j) - 5.0
    assert far > 3.0
    assert FarBodies.clear.func(bodies) == pytest.approx([3.0, 3.0, far])
    bodies.radii = np.array([2.0, 2.0, 4.5])
    assert FarBodies.clear.func(bodies) == pytest.approx([3.0, far - 1.5, far - 1.5])


def test_what_has_decayed_by_forty_between_two_circles_arrives_nowhere():
    """κ (R − a − b) of 39.9 and of 40.1; pairs of one distance, one direction and the same circles share a matrix"""
    held = SimpleNamespace(each=range(3), bodies=bodies_of())
    held.waves = [PartialWaves("radiating", 9.0, 1), PartialWaves("decaying", 39.9 / 3, 1),
                  PartialWaves("decaying", 40.1 / 3, 1)]  # fmt: skip
    found = dict(Coupled.pairs(held))
    assert set(found) == {(i, j) for i in range(3) for j in range(3) if i != j}
    assert [part is None for part in found[0, 1]] == [False, False, True]
    wave = held.waves[0].seen_from(-7.0, 2.0, 2.0)
    assert found[0, 1][0] == pytest.approx(wave) and found[1, 0][0] == pytest.approx(
        held.waves[0].seen_from(7.0, 2.0, 2.0)
    )
    assert found[2, 1][0] == pytest.approx(held.waves[0].seen_from(8.0 + 3.0j, 2.0, 3.0))
    held.bodies.axes, held.bodies.radii = np.array([0.0, 7.0, 14.0]), np.full(3, 2.0)
    found = dict(Coupled.pairs(held))
    assert found[0, 1] is found[1, 2] and found[1, 0] is found[2, 1] and found[0, 1] is not found[0, 2]


def test_the_cost_is_of_the_answers_of_each_shape_and_of_the_equations_of_all():
    """s (4e-4 q + 5e-10 q³) + 1e-4 N² + 4e-10 (Nq/4)³ s and 64 s q² + 48 (Nq/4)² bytes, and those of the finer ones"""

    def bodies(waves, shapes, count):
        asked = []
        at = lambda omega, gravity: asked.append((omega, gravity)) or SimpleNamespace(orders=range(waves))  # noqa: E731
        return SimpleNamespace(at=at, alone=range(shapes), bodies=range(count), asked=asked)

    one = bodies(120, 3, 20)
    one.finer = bodies(160, 2, 20)
    found = cost(one, 0.8, 9.81)
    expected = np.zeros(2)
    for q, s in ((120, 3), (160, 2)):
        seconds = s * (4e-4 * q + 5e-10 * q**3) + 1e-4 * 400 + 4e-10 * (5 * q) ** 3
        expected += [seconds, 64 * s * q**2 + 48 * (5 * q) ** 2]
    assert (found.table, found.each, found.memory) == pytest.approx((0.0, *expected))
    assert one.asked == one.finer.asked == [(0.8, 9.81)]


def test_shapes_that_are_the_same_are_made_once_and_refined_once():
    shapes = [("buoy", (2.0, 3.0)), ("buoy", (1.0, 3.0)), ("buoy", (2.0, 3.0))]
    far = prepare_far(shapes, [Place(x, 0.0, 0.0) for x in (0.0, 9.0, 20.0)], 10.0)
    assert far.bodies[0] is far.bodies[2] and len(far.alone) == 2
    assert far.resolution(0.9) == tuple(body.resolution(0.9) for body in far.alone)
    finer, sharper = far.finer, far.sharper
    assert type(finer) is type(sharper) is FarBodies and finer.bodies[0] is finer.bodies[2]
    for made, alone in ((finer.bodies[0], far.bodies[0].finer), (sharper.bodies[1], far.bodies[1].sharper)):
        more = prepare_cylinder(alone.plan.radius, alone.draft, alone.depth, 0.1 * alone.tolerance * 10**MARGIN)
        terms = max(alone.accuracy.terms, more.accuracy.terms)
        assert made.accuracy == alone.accuracy._replace(terms=terms)
    assert (sharper.places, sharper.gaps) == (far.places, far.gaps)
    assert far.tolerance == pytest.approx(10 * sharper.tolerance)


def test_a_body_answers_to_what_is_three_hundredths_of_the_tolerance_of_its_largest_answer():
    """Of singular values 1, 3.05e-5 and 2.95e-5 of what is scattered two count, with forces of the same size"""
    held = SimpleNamespace(bodies=SimpleNamespace(tolerance=1e-3), waves=[PartialWaves("decaying", 0.5, 1)],
                           _size=lambda body: np.ones(3))  # fmt: skip
    body = SimpleNamespace(plan=SimpleNamespace(reach=2.0))
    one = SimpleNamespace(members=[np.arange(3)], scattered=np.diag([1.0, 3.05e-5, 2.95e-5]) + 0j,
                          pressed=np.zeros((6, 3), complex), sent=np.zeros((3, 6), complex))  # fmt: skip
    found = Coupled._response(held, body, one)
    assert found.few.shape == (2, 3) and found.scattered.shape == (3, 2)
    # in real coefficients and back: what comes in is answered as by the whole matrix
    into, out = to_real(np.arange(-1, 2)), to_complex(np.arange(-1, 2))
    whole = out @ one.scattered @ into
    assert found.scattered @ found.few == pytest.approx(whole, abs=3e-5)
    one.pressed[2] = [0.0, 0.0, 7.0]  # a force is weighed as the largest answer
    assert len(Coupled._response(held, body, one).few) == 3
