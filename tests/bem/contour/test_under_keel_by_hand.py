"""Flow under the keel of a cylinder piece by piece: harmonics, the flow of the edge, Bessel functions, radii."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import iv, ivp

from hakobune.bem.contour.hull import under_keel
from hakobune.bem.contour.hull.under_keel import UnderKeel, _bessel, _doubling, _edge, _graded
from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.maps import CLASSES

R, DEGREE = 3.0, 4
THETA = np.array([0.2, 0.9, 1.4])


def keel(rho):
    made = object.__new__(UnderKeel)
    made.theta, made.radius, made.rho, made.degree = THETA, R, np.array(rho), DEGREE
    made.body = SimpleNamespace(plan=Circle(R))
    return made


@pytest.mark.parametrize("cls", CLASSES)
def test_orders_of_a_class_are_put_together_with_their_gradient(cls):
    """φ = rᵐ cos mθ or rᵐ sin mθ of each order: ∇φ by differences, ψ normalised on the circle"""
    made, m = keel([0.5, 2.0]), Circle(R).orders(cls, DEGREE)
    r = R - made.rho
    value = r[:, None] ** m * np.ones((2, len(m)))
    slope = m * r[:, None] ** np.maximum(m - 1.0, 0)
    made._radial = lambda freq, cls: (value[..., None] * [1.0, 2j], slope[..., None] * [1.0, 2j])
    out, gradient = made.flow(None, cls)
    shape = np.cos if cls[1] == 1 else np.sin
    scale = 1 / np.sqrt(np.pi * R * np.where(m, 1, 2))

    def at(x, y):
        return np.sum(scale * np.hypot(x, y) ** m * shape(m * np.arctan2(y, x)))

    points = [(a * np.cos(t), a * np.sin(t)) for a in r for t in THETA]
    assert out[0] == pytest.approx([at(*p) for p in points]) and out[1] == pytest.approx(2j * out[0])
    step = 1e-6
    for (x, y), g in zip(points, gradient[0], strict=True):
        numeric = [(at(x + step, y) - at(x - step, y)), (at(x, y + step) - at(x, y - step))]
        assert g[:2] == pytest.approx(np.array(numeric) / (2 * step), rel=1e-6, abs=1e-7) and g[2] == 0.0


def test_near_the_keel_the_flow_is_that_of_the_edge():
    """c₀ − Uρ − (2b/3π) ρ² ln ρ + c₁ ρ^(2/3) + c₂ ρ^(4/3) + c₃ ρ² found at four distances is the same nearer"""
    made = keel([])
    made.near, made.found = np.array([0.001, 0.01, 0.02]), np.array([0.011, 0.02, 0.03, 0.04])
    rng = np.random.default_rng(1)
    edge, c = rng.normal(size=(2, 2, 3)), rng.normal(size=(4, 2, 3))
    far = rng.normal(size=(2, 5, 2, 3))

    def flow(rho):
        powers = rho[:, None] ** (np.array([0, 2, 4, 6]) / 3)
        b = np.stack([-rho, -2 / (3 * np.pi) * rho**2 * np.log(rho)], axis=1)
        return np.tensordot(powers, c, 1) + np.tensordot(b, edge, 1)

    parts = [np.concatenate([flow(made.found), far[0]]), np.concatenate([np.zeros((4, 2, 3)), far[1]])]
    value, slope = made._with_edge(parts, edge)
    assert value == pytest.approx(np.concatenate([flow(made.near), far[0]]))
    step = 1e-7
    numeric = -(flow(made.near + step) - flow(made.near - step)) / (2 * step)  # ∂/∂r
    assert slope == pytest.approx(np.concatenate([numeric, far[1]]), rel=1e-5, abs=1e-6)


def test_the_edge_s_own_flow_and_its_slope():
    rho, step = np.array([0.01, 0.5, 2.0]), 1e-6
    value, slope = _edge(rho)
    assert value == pytest.approx(np.stack([-rho, -2 / (3 * np.pi) * rho**2 * np.log(rho)], axis=1))
    assert slope == pytest.approx((_edge(rho + step)[0] - _edge(rho - step)[0]) / (2 * step), rel=1e-6)
    assert _edge(np.zeros(1))[0].tolist() == [[0.0, 0.0]]


def test_bessel_functions_are_scaled_by_their_exponential():
    x, decay = np.array([0.3, 5.0, 50.0]), np.array([0.0, 1.0, 2.0])
    value, slope = _bessel(3, x, decay)
    m = np.arange(4)[:, None]
    assert value == pytest.approx(iv(m, x) * np.exp(-x - decay), rel=1e-10)
    assert slope == pytest.approx(ivp(m, x) * np.exp(-x - decay), rel=1e-10)
    assert _bessel(0, x)[1].shape == (1, 3)


def test_radii_are_graded_towards_the_keel_and_double_away_from_it():
    """Weights are those of dρ: of 1, ρ and ρ^(2/3) below 0.7 m, of ρ² from 0.2 to 3 m"""
    rho, w = _graded(0.7)
    assert len(rho) == 10 and [np.sum(w), np.sum(w * rho), np.sum(w * rho ** (2 / 3))] == pytest.approx(
        [0.7, 0.245, 0.6 * 0.7 ** (5 / 3)]
    )
    rho, w = _doubling(0.2, 3.0)
    assert len(rho) == 40 and np.sum(w * rho**2) == pytest.approx((27 - 0.008) / 3) and rho.min() > 0.2
    assert len(_doubling(0.2, 1.6)[0]) == 30 and len(_doubling(2.9, 3.0)[0]) == 10


@pytest.mark.parametrize("dof, sign", [(2, 1.0), (3, 1.0), (4, -1.0), (0, 0.0)])
def test_particular_solutions_on_the_bottom(dof, sign):
    """Heave (s² − r²/2)/2s; roll r sin θ and pitch −r cos θ times (s² − r²/4)/2s, whose ∂/∂ζ is 1 and r at ζ = s"""
    made, s, r = keel([]), 2.0, np.array([0.5, 2.5])
    made.body = SimpleNamespace(profiles=SimpleNamespace(height=s))
    value, slope = made._particular(dof, r, 3)
    if not sign:
        assert not value.any() and not slope.any()
        return
    unit = np.sqrt(np.pi * R * (2 if dof == 2 else 1))

    def psi(r):
        return sign * unit * ((s * s - r * r / 2) if dof == 2 else (s * s * r - r**3 / 4)) / (2 * s)

    assert value[:, 0] == pytest.approx(psi(r)) and not value[:, 1:].any()
    assert slope[:, 0] == pytest.approx((psi(r + 1e-6) - psi(r - 1e-6)) / 2e-6, rel=1e-7)


def test_points_lie_on_the_bottom_with_the_area_of_a_quarter():
    gap = SimpleNamespace(draft=2.0, height=1.5)
    body = SimpleNamespace(plan=Circle(R), profiles=SimpleNamespace(gap=gap))
    contour = Circle(R).contour(0.0, 8, 1e-6)
    made = UnderKeel(body, DEGREE, contour)
    assert made.start == pytest.approx(0.015) and np.sum(made.weights) == pytest.approx(np.pi * R * R / 4)
    assert np.sum(made.weights * made.points[:, 0] ** 2) == pytest.approx(np.pi * R**4 / 16)
    assert np.all(made.points[:, 2] == -2.0) and np.all(made.normals == [0, 0, -1])
    assert np.all(made.found > made.start) and np.all(made.found < 4 * made.start) and len(made.found) == 4
    assert made.near.max() < 4 * made.start < made.rho[len(made.near) :].min()
    middle = np.mean(made.found ** (2 / 3))
    assert middle == pytest.approx(0.5 * (0.015 ** (2 / 3) + 0.06 ** (2 / 3)))
    for other, small in ((SimpleNamespace(draft=0.5, height=1.5), 0.5), (SimpleNamespace(draft=9.0, height=9.0), R)):
        body = SimpleNamespace(plan=Circle(R), profiles=SimpleNamespace(gap=other))
        assert UnderKeel(body, DEGREE, contour).start == pytest.approx(0.01 * small)
    assert under_keel.END == 4.0


def test_velocities_in_the_gap_make_the_sum_of_their_cosines_and_the_net_flow():
    """Σ (2/s) cos(l s) Iₘ(lr)/l Iₘ'(lR) ⟨u, cos⟩ of as many modes as have not decayed, and rᵐ/mRᵐ⁻¹ ⟨u, 1⟩/s"""
    rng, s, asked = np.random.default_rng(5), 0.4, []
    combinations, mean_rows = rng.normal(size=(3, 2)), rng.normal(size=3)

    def inner_modes(count):
        asked.append(count)
        n = np.arange(1, count + 1)
        return SimpleNamespace(wavenumbers=n * np.pi / s, rows=np.stack([1.0 / n, (-1.0) ** n / n**2]))

    made = keel([])
    made.radius, made.near, made.found, made.rho = 0.9, np.zeros(1), np.array([0.05]), np.array([9.0, 0.3, 0.7])
    gap = SimpleNamespace(inner_modes=inner_modes)
    profiles = SimpleNamespace(gap=gap, height=s, combinations=combinations, mean_rows=mean_rows)
    made.body = SimpleNamespace(profiles=profiles)
    found = made._all_maps
    assert asked == [int(np.ceil(36 * s / (np.pi * 0.05)))]
    n = np.arange(1, asked[0] + 1)
    l = n * np.pi / s
    rows = combinations @ np.stack([1.0 / n, (-1.0) ** n / n**2]) * (2 / s * np.cos(l * s))
    for q, rho in enumerate((0.05, 0.3, 0.7)):
        r = 0.9 - rho
        for m in range(DEGREE + 1):
            wall = ivp(m, l * 0.9)
            flow = rows @ (iv(m, l * r) / (l * wall)), rows @ (ivp(m, l * r) / wall)
            net = (0.9 / m * (r / 0.9) ** m, (r / 0.9) ** (m - 1)) if m else (0.0, 0.0)
            for own, one, part in zip(found, flow, net, strict=True):
                assert own[q, m] == pytest.approx(one + part * mean_rows / s, rel=1e-9, abs=1e-12)
