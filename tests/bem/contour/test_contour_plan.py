"""Plane problems on a contour: manufactured solutions, closed forms and what a table keeps of them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import hankel1, k0, k1

from hakobune.bem.contour.modal_sums import ChebyshevNodes, contracted
from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.layers import decaying, laplace, radiating
from hakobune.bem.contour.plan.maps import CLASSES, area_moment
from hakobune.bem.contour.plan.panels import is_far, near_points, quarter_panels
from hakobune.bem.contour.plan.plane_waves import plane_wave_values, plane_waves
from hakobune.bem.contour.plan.rectangle import Rectangle

LENGTH, BEAM = 100.0, 50.0
DEGREE = (12, 16)
DIGITS = 6
PLANS = [Rectangle.to_digits(LENGTH, BEAM, DIGITS), Circle(20.0)]


def images(cls, x, y):
    """Four sources of strength ±1 that make a field of the symmetry `cls`"""
    for ix, iy in CLASSES:
        yield (cls[0] if ix < 0 else 1) * (cls[1] if iy < 0 else 1), ix * x, iy * y


def field_of_sources(contour, cls, x, y, radial):
    """Potential and normal velocity on the contour; radial : function of R for both φ and R dφ/dR"""
    value, flux = 0.0, 0.0
    for sign, sx, sy in images(cls, x, y):
        dx, dy = contour.x - sx, contour.y - sy
        R2 = dx**2 + dy**2
        f, slope = radial(np.sqrt(R2))
        value = value + sign * f
        flux = flux + sign * slope * (dx * contour.nx + dy * contour.ny) / R2
    return value, flux


def worst(digits, kappa, interior):
    """Largest relative error of the potential that answers the normal velocity of sources across the contour"""
    plan = Rectangle.to_digits(LENGTH, BEAM, digits)
    panels = plan.panels(0.0, DEGREE)
    contour, on_contour = panels.contour, plan.layers(panels, 3 / kappa)
    source = (70.0, 40.0) if interior else (30.0, 12.0)
    errors = []
    for cls, S, D in zip(CLASSES, *on_contour.matrices(decaying(kappa), CLASSES), strict=True):
        value, flux = field_of_sources(contour, cls, *source, lambda R: (k0(kappa * R), -kappa * R * k1(kappa * R)))
        sign = 1 if interior else -1
        answer = np.linalg.solve(np.eye(len(value)) / 2 + sign * D, sign * S @ flux)
        errors.append(np.abs(answer - value).max() / np.abs(value).max())
    return max(errors)


@pytest.mark.parametrize("interior", [True, False])
@pytest.mark.parametrize("kappa", [0.002, 0.05])
def test_sources_across_the_contour_are_answered_better_with_every_digit(kappa, interior):
    errors = [worst(digits, kappa, interior) for digits in (3, 5, 7)]
    assert errors[0] < 1e-3 and errors[1] < 1e-5 and errors[2] < 1e-7, errors


def test_double_layer_of_one_is_minus_half_inside():
    """Gauss: ∮ ∂G/∂n ds = −½ on the contour for Laplace's equation"""
    plan = Rectangle.to_digits(LENGTH, BEAM, 6)
    _, D = plan.layers(plan.panels(0.0, DEGREE), np.inf).matrices(laplace, [(1, 1)])
    assert np.abs(D[0].sum(axis=1) + 0.5).max() < 1e-9


@pytest.mark.parametrize("smallest", [1.0, 1e-9, 1e-300])
def test_pieces_near_a_target_make_up_their_panels(smallest):
    """Halving ends where two ends are neighbours among the numbers, however small a piece is asked for"""
    panels = quarter_panels(2.0, 1.0, (0.5, 0.5), (1.0, 1.0), 4)
    c, p = panels.contour, len(panels.start)
    far = is_far(panels, c.x, c.y)
    points = near_points(panels, c.x, c.y, np.arange(len(c.x)), far, 4, smallest)
    lengths = np.zeros(far.shape)
    np.add.at(lengths, (points.target, points.image, points.panel), points.weights)
    assert lengths == pytest.approx(np.where(far, 0.0, panels.length), rel=1e-13)
    assert np.any(far) and len(np.unique(points.panel)) == p


@pytest.mark.parametrize("turns", [(1, 1), (2, 1), (1, 2), (4, 3)])
def test_waves_have_one_answer_at_the_resonances_of_the_inside(turns):
    """k = π√((m/L)² + (n/B)²), where the integral equation alone has many"""
    k = np.pi * np.hypot(turns[0] / LENGTH, turns[1] / BEAM)
    plan = Rectangle.to_digits(LENGTH, BEAM, 6)
    contour = plan.contour(k, DEGREE, 1e-6)
    at = plan.wave_layout(k, DEGREE)
    _, D = at.on_contour.matrices(radiating(k), CLASSES)
    waves = plan.waves(CLASSES, DEGREE, k, contour, [0.4])
    alone = []
    for c, cls in enumerate(CLASSES):
        value, flux = field_of_sources(
            contour, cls, 30.0, 12.0, lambda R: (hankel1(0, k * R), -k * R * hankel1(1, k * R))
        )
        # Green with the total field in front of a wall: ∮ wall ∂φ/∂n = ∮ (wave ∂φ/∂n − φ ∂wave/∂n), φ outgoing
        wave = plane_waves(cls, contour, k, np.array([0.4]))
        left = np.sum(contour.weights * waves[cls].wall[:, 0] * flux)
        right = np.sum(contour.weights * (wave.value[:, 0] * flux - value * wave.flux[:, 0]))
        assert abs(left - right) < 1e-7 * np.abs(contour.weights * flux).sum()
        alone.append(np.linalg.cond(np.eye(len(value)) / 2 - D[c]))
    assert max(alone) > 1e4  # that there was something to treat


def test_inner_map_of_a_cosine_is_a_hyperbolic_cotangent():
    """cos(2πx/L) cosh μy, μ² = κ² + (2π/L)²: no flow through the ends, ratio coth(μB/2)/μ on the sides"""
    plan, kappa = Rectangle.to_digits(LENGTH, BEAM, 7), 0.05
    degree = (4, 24)
    contour = plan.polynomial_contour(degree)
    basis = plan.basis((1, 1), degree, contour)
    inner = plan.maps(degree, np.array([kappa]))[(1, 1)][1][0] / kappa
    mu = np.hypot(kappa, 2 * np.pi / LENGTH)
    side = contour.ny > 0.5
    velocity = np.where(side, mu * np.sinh(mu * BEAM / 2) * np.cos(2 * np.pi * contour.x / LENGTH), 0.0)
    value = np.cos(2 * np.pi * contour.x / LENGTH) * np.cosh(mu * contour.y)
    weigh = 4 * (basis * contour.weights[:, None]).T
    assert np.abs(inner @ (weigh @ velocity) - weigh @ value).max() < 1e-7 * np.abs(weigh @ value).max()


@pytest.mark.parametrize("plan", [Rectangle.to_digits(LENGTH, BEAM, 6), Circle(20.0)])
def test_maps_are_symmetric_and_tend_to_their_limits(plan):
    degree = plan.degree(0.0, 1e-6)
    for outer, inner in plan.maps(degree, np.array([0.05, 1e4])).values():
        one = np.eye(outer.shape[1])
        for matrix in (outer[0], inner[0]):
            assert np.abs(matrix - matrix.T).max() < 1e-7
        assert np.abs(outer[1] + one).max() < 2e-3 and np.abs(inner[1] - one).max() < 2e-3


@pytest.mark.parametrize("plan", [Rectangle.to_digits(LENGTH, BEAM, 5), Circle(20.0)])
def test_functions_of_the_contour_are_orthonormal(plan):
    degree = plan.degree(0.1, 1e-5)
    contour = plan.polynomial_contour(degree)
    for cls in CLASSES:
        basis = plan.basis(cls, degree, contour)
        gram = 4 * (basis * contour.weights[:, None]).T @ basis
        assert np.abs(gram - np.eye(len(gram))).max() < 1e-12


def test_far_waves_of_a_cylinder_are_hankel_functions_of_any_order():
    """1 / Hₘ for orders whose Hankel functions overflow"""
    waves = Circle(1.0).waves(CLASSES, 60, 1e-4, Circle(1.0).contour(1e-4, 60, 1e-3), [0.0])
    assert all(np.all(np.isfinite(w.weak)) and np.all(np.isfinite(w.wall)) for w in waves.values())
    ratio = waves[(1, 1)].weak[2, 2]  # order 4 of a small circle: −R/m
    assert ratio == pytest.approx(-1 / 4, rel=1e-6)


def test_a_table_keeps_a_function_of_log_kappa_and_its_tail():
    def f(kappa):
        return k0(kappa) / k1(kappa) * -1.0

    errors = []
    for count in (10, 20, 40):
        nodes = ChebyshevNodes(0.05, 60.0, count)
        kappa = np.geomspace(0.05, 1e5, 400)
        cache = nodes.weights(kappa) @ np.append(f(nodes.kappa), -1.0)
        errors.append(np.abs(cache - np.where(kappa < 300, f(np.minimum(kappa, 300)), -1 + 0.5 / kappa)).max())
    assert errors[1] < errors[0] / 10 and errors[2] < 1e-5, errors


def test_collapsed_sum_is_the_sum():
    """Σ 1/n² · M(n) with M = 1 + 1/n: ζ(3)-like sums to infinity from forty modes"""
    from scipy.special import zeta

    n = np.arange(1.0, 201)
    rows, nodes = (n**-0.5)[None], ChebyshevNodes(0.5, 100.0, 25)
    total = contracted(rows, np.array([0.5]), 1 / n, nodes.weights(n))[0, 0]
    values = np.append(1 + 1 / nodes.kappa, 1.0)
    assert total @ values == pytest.approx(zeta(2) + zeta(3), rel=1e-8)


def test_area_moments_are_those_of_the_figure():
    box = Rectangle.to_digits(LENGTH, BEAM, 3).polynomial_contour((8, 8))
    assert area_moment(box, 2, 2) == pytest.approx(LENGTH**3 * BEAM**3 / 144, rel=1e-13)
    circle = Circle(3.0).polynomial_contour(6)
    assert area_moment(circle, 4, 0) == pytest.approx(np.pi * 3**6 / 8, rel=1e-13)


@pytest.mark.parametrize("k", [0.01, 0.2, 0.8])
@pytest.mark.parametrize("plan", PLANS)
def test_forces_of_the_undisturbed_wave_are_integrals_around_the_contour(plan, k):
    """Over the bottom ∬ f dA = −∮ ∂f/∂n ds / k² and ∬ x f dA = −∮ (x ∂f/∂n − f n₁) ds / k²"""
    beta, draft, depth = np.array([0.0, 0.7, np.pi / 2]), 3.0, 8.0
    c, Z = plan.contour(k, plan.degree(k, 1e-9), 1e-9), np.cosh(k * depth)
    one = (np.sinh(k * depth) - np.sinh(k * (depth - draft))) / k / Z
    z = (draft * np.sinh(k * (depth - draft)) - (np.cosh(k * depth) - np.cosh(k * (depth - draft))) / k) / k / Z
    keel = np.cosh(k * (depth - draft)) / Z / k**2
    even, odd, across = (plane_waves(cls, c, k, beta) for cls in ((1, 1), (-1, 1), (1, -1)))
    w = 4 * c.weights
    expected = np.zeros((3, 6), complex)
    expected[:, 0], expected[:, 1] = -one * (w * c.nx) @ odd.value, -one * (w * c.ny) @ across.value
    expected[:, 2] = -keel * w @ even.flux
    expected[:, 3] = z * (w * c.ny) @ across.value + keel * ((w * -c.y) @ across.flux + (w * c.ny) @ across.value)
    expected[:, 4] = -z * (w * c.nx) @ odd.value - keel * ((w * -c.x) @ odd.flux + (w * c.nx) @ odd.value)
    expected[:, 5] = -one * (w * (c.x * c.ny - c.y * c.nx)) @ plane_wave_values((-1, -1), c, k, beta)
    force = plan.incident_force(draft, depth, k, beta)
    np.testing.assert_allclose(force, expected, rtol=0, atol=1e-8 * np.abs(expected).max())


@pytest.mark.parametrize("plan", PLANS)
def test_functions_up_to_a_degree_are_among_those_up_to_a_higher_one(plan):
    low, high = plan.degree(0.1, 1e-3), plan.degree(0.9, 1e-3)
    contour = plan.polynomial_contour(high)
    for cls in CLASSES:
        own = plan.subset(cls, low, high)
        assert np.array_equal(plan.basis(cls, low, contour), plan.basis(cls, high, contour)[:, own])
        assert 0 < len(own) < plan.basis(cls, high, contour).shape[1]


@pytest.mark.parametrize("plan", PLANS)
def test_tables_of_a_higher_degree_hold_those_of_a_lower_one(plan):
    low, high, kappa = plan.degree(0.1, 1e-3), plan.degree(0.9, 1e-3), np.array([0.05, 0.4, 5.0])
    whole, part = plan.maps(high, kappa), plan.maps(low, kappa)
    for cls in CLASSES:
        own = plan.subset(cls, low, high)
        tables = ((*each[cls], plan.laplace(d)[cls][1]) for each, d in ((whole, high), (part, low)))
        for larger, smaller in zip(*tables, strict=True):
            cut = larger[..., own[:, None], own]
            np.testing.assert_allclose(cut, smaller, rtol=0, atol=10**-DIGITS * np.abs(smaller).max())


@pytest.mark.parametrize("plan", PLANS)
def test_waves_that_share_tables_are_shorter_by_half_at_most(plan):
    k = np.geomspace(1e-4, 100.0, 400)
    table_wavenumber = np.array([plan.table_wavenumber(each) for each in k])
    long = table_wavenumber == table_wavenumber[0]
    assert np.all(table_wavenumber >= k * (1 - 1e-12)) and np.all(table_wavenumber[~long] <= 1.5 * k[~long])
    assert table_wavenumber[0] == plan.table_wavenumber(0.0) and len(set(table_wavenumber)) < 20


@pytest.mark.parametrize("waves", [30, 60, 100])
def test_waves_in_front_of_walls_are_no_worse_where_they_are_many(waves):
    plan, k = Rectangle.to_digits(100.0, 20.0, 3), 2 * np.pi * waves / 100
    degree = plan.degree(k, 1e-2)
    walls = []
    for each in (plan, replace(plan, nodes=14, count=14)):
        contour = each.contour(k, degree, 1e-2)
        wall = each.waves([(1, 1)], degree, k, contour, np.radians([20.0]))[1, 1].wall
        walls.append((each.basis((1, 1), degree, contour) * contour.weights[:, None]).T @ wall)
    assert np.abs(walls[0] - walls[1]).max() < 3e-3 * np.abs(walls[1]).max()


def test_panels_of_end_and_side_have_their_own_lengths():
    """From the corner on each at most twice as long as the one before, and as long as allowed on its own side"""
    panels = quarter_panels(40.0, 9.0, (0.5, 1.5), (2.0, 5.0), 4)
    for side, extent, first, longest in ((0, 9.0, 0.5, 2.0), (1, 40.0, 1.5, 5.0)):
        own = panels.normal[:, side] == 1.0
        length, start = panels.length[own], panels.start[own]
        assert length.sum() == pytest.approx(extent) and start == pytest.approx(np.cumsum(length) - length)
        assert (
            length[0] == first
            and 0.8 * longest < length.max() <= longest
            and np.all(length[1:] <= 2.0001 * length[:-1])
        )
        assert panels.power[own].tolist() == [3.0] + [1.0] * (own.sum() - 1)
    assert np.all(np.sum(panels.direction * panels.normal, axis=1) == 0) and np.all(panels.direction.sum(axis=1) == -1)
