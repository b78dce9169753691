"""Pieces of the contour method of several bodies by hand: places, distances, what a circle sends, cost, folding."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import hankel1, kv

from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.layers import decaying, laplace, radiating
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.plan.rectangle import Rectangle
from hakobune.bem.contour.several import bodies as several
from hakobune.bem.contour.several.bodies import SeveralBodies, prepare_several
from hakobune.bem.contour.several.cost import cost
from hakobune.bem.contour.several.exterior import Exterior, Place, _folded
from hakobune.bem.contour.several.fixed import Fixed
from hakobune.bem.contour.several.senders import Kernel, _on_circle, _scattered, sender

RECTANGLE, CIRCLE = Rectangle(4.0, 2.0, 4, 4, 6), Circle(1.5)


def test_a_place_turns_about_its_middle_and_back():
    place = Place(3.0, -1.0, np.pi / 2)
    assert place.in_scene(np.array([2 + 1j])) == pytest.approx([3 - 1j + (2j - 1)])
    assert place.own(place.in_scene(np.array([2 + 1j, -4j]))) == pytest.approx([2 + 1j, -4j])


def test_outlines_are_corners_in_pieces_or_points_round():
    assert several._outline(RECTANGLE).tolist() == [2 + 1j, -2 + 1j, -2 - 1j, 2 - 1j]
    assert several._outline(RECTANGLE, 2).tolist() == [2 + 1j, 1j, -2 + 1j, -2, -2 - 1j, -1j, 2 - 1j, 2]
    circle = several._outline(CIRCLE)
    assert len(circle) == 180 and np.abs(circle) == pytest.approx(1.5) and circle[45] == pytest.approx(1.5j)


@pytest.mark.parametrize("place, distance", [
    (Place(7.0, 0.5, 0.0), 3.0), (Place(0.0, 5.0, np.pi / 2), 2.0), (Place(7.0, 6.0, 0.0), 5.0),
    (Place(0.0, 1.0 + 5**0.5 + 0.25, np.arctan(2)), 0.25 + 5**0.5 - 4 / 5**0.5),
])  # fmt: skip
def test_rectangles_are_as_far_apart_as_sides_and_corners(place, distance):
    """Beside each other, one across the other, corner to corner, (3, 4) m, and a corner above a side"""
    one = several._outline(RECTANGLE)
    other = place.in_scene(one)
    expected = distance
    if place.heading not in (0.0, np.pi / 2):
        expected = other.imag.min() - 1.0
    assert several._distance(one, other) == several._distance(other, one) == pytest.approx(expected)


def test_the_nearest_of_three_is_taken():
    plans, places = [CIRCLE] * 3, [Place(0, 0, 0), Place(5, 0, 0), Place(0, 20, 0)]
    assert several.nearest(plans, places) == pytest.approx([2.0, 2.0, 17.0], abs=2e-3)


@pytest.mark.parametrize("places, meet", [
    ([Place(0, 0, 0), Place(3.51, 0, 0)], False), ([Place(0, 0, 0), Place(3.49, 0, 0)], True),
    ([Place(0, 0, 0), Place(0, 2.51, 0)], False), ([Place(0, 0, 0), Place(0, 2.49, 0)], True),
    ([Place(0, 0, 0), Place(0.0, 0.1, 0)], True),
])  # fmt: skip
def test_plans_that_meet_are_refused(places, meet):
    """4 × 2 m and a radius of 1.5 m: 3.5 m ahead and 2.5 m beside"""
    for plans, order in (([RECTANGLE, CIRCLE], (0, 1)), ([CIRCLE, RECTANGLE], (1, 0))):
        own = [places[i] for i in order]
        if meet:
            with pytest.raises(ValueError, match=r"bodies [12] and [12] overlap or touch; allowed: water"):
                several._check_apart(plans, own)
        else:
            several._check_apart(plans, own)
    with pytest.raises(ValueError, match="bodies 2 and 3 overlap"):
        several._check_apart([RECTANGLE] * 3, [Place(0, 9, 0), Place(0, 0, 0), Place(0, 0.5, 1.0)])


def test_a_plan_has_functions_for_flows_as_short_as_the_gap():
    """Of a circle orders of e^(−m arccosh(1 + g/2R)) = 10^(−digits); of a side √(B/g) as many polynomials"""
    body = SimpleNamespace(plan=CIRCLE, accuracy=SimpleNamespace(digits=4.0))
    orders = 4 * np.log(10) / np.arccosh(1 + 0.3 / 3.0)
    assert several.near(body, 0.3).lowest == int(np.ceil(orders)) and several.near(body, 300.0).lowest == CIRCLE.lowest
    body = SimpleNamespace(plan=RECTANGLE, accuracy=SimpleNamespace(digits=4.0))
    for gap in (RECTANGLE.scale / 4.0, RECTANGLE.scale / 5.0, RECTANGLE.scale * 3):
        assert several.near(body, gap).extra == int(np.ceil(6 * max(1.0, RECTANGLE.scale / gap) ** 0.5))


LAYERS = {
    "laplace": (Kernel("laplace"), laplace, lambda R: -np.log(R) / (2 * np.pi)),
    "decaying": (Kernel("decaying", 1.7), decaying(1.7), lambda R: kv(0, 1.7 * R) / (2 * np.pi)),
    "radiating": (Kernel("radiating", 2.3), radiating(2.3), lambda R: 0.25j * hankel1(0, 2.3 * R)),
}


@pytest.mark.parametrize("name", LAYERS)
@pytest.mark.parametrize("share", [1.4, 0.6])
def test_a_circle_sends_what_its_points_send_together(name, share):
    """∮ G cos mθ ds and ∮ ∂G/∂n cos mθ ds by the trapezoidal rule, at r = 1.4 R and, of waves, within"""
    kernel, layer, G = LAYERS[name]
    if share < 1 and name != "radiating":
        return
    R, count = 1.5, 400
    theta = 2 * np.pi * np.arange(count) / count
    S, D = _on_circle(kernel, R, np.array([share * R]), 4)
    d = share * R - R * np.exp(1j * theta)  # seen from θ = 0
    step = 1e-5
    beside = [G(np.abs(share * R - (R + side * step) * np.exp(1j * theta))) for side in (1, -1)]
    out = (beside[0] - beside[1]) / (2 * step)
    for m in range(5):
        weight = np.cos(m * theta) * 2 * np.pi * R / count
        assert S[0, m] == pytest.approx(np.sum(G(np.abs(d)) * weight), rel=1e-9, abs=1e-12)
        assert D[0, m] == pytest.approx(np.sum(out * weight), rel=1e-7, abs=1e-9)
    value, slope = layer(np.array([0.8]))
    assert value[0] == pytest.approx(G(0.8), rel=1e-9)
    assert slope[0] == pytest.approx(0.8 * (G(0.8 + 1e-5) - G(0.8 - 1e-5)) / 2e-5, rel=1e-6)
    assert kernel.layer(np.array([0.8]))[0][0] == pytest.approx(value[0])


@pytest.mark.parametrize("name", LAYERS)
def test_on_a_circle_and_off_it_densities_of_every_class_are_sent(name):
    """½ − D + jump: the layers of cos mθ and sin mθ on the quarter are those of each order on the whole circle"""
    kernel = LAYERS[name][0]
    one = sender(CIRCLE, 3, 2.3, 4.0, 5.0, 1.0)
    theta = np.arctan2(one.contour.y, one.contour.x)
    x, y = np.array([2.0, -1.0]), np.array([1.0, 2.5])
    there = one.at(x, y)(kernel)
    S_on, D_on = _on_circle(kernel, 1.5, np.array([1.5]), 9)
    r, turn = np.hypot(x, y), np.arctan2(y, x)
    S_off, D_off = _on_circle(kernel, 1.5, r, 9)
    for cls, m, shape in (((1, 1), 2, np.cos), ((-1, 1), 1, np.cos), ((1, -1), 1, np.sin), ((-1, -1), 2, np.sin)):
        half, single = one.own(kernel)[cls]
        density = shape(m * theta)
        assert half @ density == pytest.approx((1 - D_on[0, m]) * density) and single @ density == pytest.approx(
            S_on[0, m] * density
        )
        single, double = there[cls]
        assert single @ density == pytest.approx(S_off[:, m] * shape(m * turn))
        assert double @ density == pytest.approx(D_off[:, m] * shape(m * turn))


def test_orders_that_underflow_go_with_the_power_of_the_distance():
    S, D = _on_circle(Kernel("decaying", 1e-3), 1.5, np.array([3.0]), 120)
    assert S[0, 120] == pytest.approx(1.5 / 240 * 0.5**120) and D[0, 120] == pytest.approx(0.5 * 0.5**120)
    S, D = _on_circle(Kernel("radiating", 1e-3), 1.5, np.array([0.5]), 120)
    assert S[0, 120] == pytest.approx(1.5 / 240 * (1 / 3) ** 120) and D[0, 120] == pytest.approx(-0.5 * (1 / 3) ** 120)


@pytest.mark.parametrize("far", [150.0, 800.0, 5000.0])
def test_a_wave_that_has_decayed_sends_nothing(far):
    """κ(r − R) of 150 is a factor of e^(−150), one of 800 is below the smallest number: no order goes with a power"""
    S, D = _on_circle(Kernel("decaying", 8.0), 10.0, np.array([10.0 + far / 8.0]), 60)
    assert np.abs(S).max() < 1e-60 and np.abs(D).max() < 1e-60


def test_a_sender_has_nodes_for_its_orders_and_points_inside_for_its_waves():
    """Of a circle the larger of degree + 4 and digits ln 10/arccosh(1 + g/2R); 8 points and k times size over 2 or 4"""
    far, close = sender(CIRCLE, 3, 0.0, 40.0, 3.0, 1.0), sender(CIRCLE, 3, 0.0, 0.1, 3.0, 1.0)
    assert len(far.contour.x) == len(CIRCLE.contour(0.0, 7, 1e-3).x)
    orders = int(np.ceil(3 * np.log(10) / np.arccosh(1 + 0.1 / 3)))
    assert len(close.contour.x) == len(CIRCLE.contour(0.0, orders, 1e-3).x) > len(far.contour.x)
    assert len(sender(CIRCLE, 3, 8.0, 40.0, 3.0, 1.0).inside.x) == 8 + 6 and len(far.inside.x) == 8
    counts = [len(sender(CIRCLE, 3, 8.0, 40.0, digits, 1.0).contour.x) for digits in (3.0, 6.0)]
    assert counts == [len(CIRCLE.contour(8.0, 7, small).x) for small in (1e-3, 1e-6)] and counts[1] > counts[0]
    box = sender(RECTANGLE, (2, 2), 8.0, 40.0, 3.0, 1.0)
    assert len(box.inside.x) == int(8 + 2 * np.hypot(4, 2)) and box.smallest == 3.0
    assert np.all(np.abs(box.inside.x) < 2) and np.all(np.abs(box.inside.y) < 1)
    assert np.all(np.hypot(far.inside.x, far.inside.y) < 1.5)
    along, across = _scattered(0.0)
    assert along[:2] == pytest.approx([0.6180339887, 0.2360679775]) and across[:2] == pytest.approx(
        [0.4142135624, 0.8284271247]
    )


def test_panels_of_a_rectangle_are_up_to_two_gaps_long():
    box = sender(RECTANGLE, (2, 2), 0.0, 0.1, 3.0, 1.0)
    free = sender(RECTANGLE, (2, 2), 0.0, 9.0, 3.0, 1.0)
    assert box.panels.length.max() <= 0.2 * (1 + 1e-9) < free.panels.length.max()
    assert np.sum(box.contour.weights) == pytest.approx(3.0)  # of a quarter


def test_values_at_images_are_folded_into_classes():
    """f = Σ parts with signs (sx, sy): each class gets its own back"""
    rng = np.random.default_rng(1)
    parts = {cls: rng.normal(size=(3, 1)) for cls in CLASSES}
    whole = np.concatenate([sum((c[0] if x < 0 else 1) * (c[1] if y < 0 else 1) * parts[c] for c in CLASSES)
                            for x, y in CLASSES])  # fmt: skip
    (found,) = zip(*[[one] for one in _folded({"only": (whole,)})], strict=True)
    assert found[0] == pytest.approx(np.concatenate([parts[cls] for cls in CLASSES]))


def test_cost_is_of_nodes_and_functions_of_these_bodies_and_the_finer_ones():
    def bodies(N, M, n, coupled, kappa):
        return SimpleNamespace(
            degrees=lambda k: ("waves", "table"), coupled=lambda tops: coupled,
            nodes=lambda tops: SimpleNamespace(kappa=np.zeros(kappa)),
            exterior=lambda k, degrees: SimpleNamespace(size=N if k == 0 else M, basis=np.zeros((2, n))),
        )  # fmt: skip

    own = bodies(100, 200, 7, 3, 5)
    own.finer = bodies(300, 150, 11, 4, 6)
    found = cost(own, 0.5)
    assert found.table == pytest.approx(3 * (1.1e-7 * 1e4 + 3e-11 * 1e6) + 4 * (1.1e-7 * 9e4 + 3e-11 * 27e6))
    assert found.each == pytest.approx(4e-7 * 4e4 + 4e-10 * 8e6 + 4e-7 * 2.25e4 + 4e-10 * 3.375e6)
    assert found.memory == pytest.approx(16 * 5 * 49 + 150 * 4e4 + 16 * 6 * 121 + 150 * 9e4)


def test_forces_turn_with_a_body_and_have_the_arm_of_its_middle():
    """F = R F′, M = R M′ + r × F"""
    both = SeveralBodies((None, None), (Place(3.0, -2.0, np.pi / 2), Place(0.0, 0.0, 0.0)), (1.0, 1.0))
    force = both.to_scene @ np.array([1.0, 0, 2.0, 0.5, 0, 0, *[0.0] * 6])
    r = np.array([3.0, -2.0, 0.0])
    F = np.array([0.0, 1.0, 2.0])
    assert force[:3] == pytest.approx(F, abs=1e-12) and force[3:6] == pytest.approx(
        np.array([0, 0.5, 0]) + np.cross(r, F)
    )


@pytest.fixture(scope="module")
def pair():
    shapes, places = [("buoy", (3.0, 2.0)), ("buoy", (2.0, 4.0))], [Place(0, 0, 0), Place(9.0, 0, 0.3)]
    return prepare_several(shapes, places, 10.0, 1e-2)


def test_the_undisturbed_wave_pushes_each_with_its_own_phase(pair):
    """Heave of the second one, by its sides and bottom alone: as of one at the origin times exp(ikx)"""
    from hakobune.bem.waves import wavenumber

    k = float(wavenumber(1.2, 10.0, 9.80665))
    whole = pair.froude_krylov(1.2, [0.0, 0.7], None, 1000.0)
    alone = pair.bodies[1].froude_krylov(1.2, [0.0, 0.7], range(6), 1000.0)
    phase = np.exp(1j * k * 9.0 * np.cos([0.0, 0.7]))
    assert whole[:, 8] == pytest.approx(phase * alone[:, 2], rel=1e-9)
    assert whole[:, 10] == pytest.approx(phase * alone[:, 4] - 9.0 * whole[:, 8], rel=1e-6)


def test_limits_and_frequencies_are_told_what_they_may_be(pair):
    for omega in (0.0, np.inf):
        with pytest.raises(ValueError, match="allowed: positive and finite"):
            pair.first_order(omega)
    with pytest.raises(ValueError, match="limit is 'nought'; allowed: 'zero', 'infinity'"):
        pair.limit("nought")
    _, flux = pair.limit("zero")
    assert flux[[2, 8]] == pytest.approx([np.pi * 9, np.pi * 4]) and flux[10] == pytest.approx(-9 * np.pi * 4)
    assert not pair.limit("infinity")[1].any()


def test_bodies_of_one_draft_share_the_functions_of_their_gap(pair):
    assert [kind for _, kind in pair.of_kinds] == [0, 1]
    shapes, places = [("buoy", (3.0, 2.0))] * 2, [Place(0, 0, 0), Place(9.0, 0, 0)]
    alike = prepare_several(shapes, places, 10.0, 1e-2)
    assert [kind for _, kind in alike.of_kinds] == [0, 0] and alike.gaps == pytest.approx((3.0, 3.0), abs=1e-2)
    one, two = pair.bodies
    assert pair.depth == 10.0 and pair.tolerance == max(one.tolerance, two.tolerance)
    assert pair.digits == max(one.accuracy.digits, two.accuracy.digits)


def test_loads_and_equations_of_two_bodies_are_those_of_one_written_out():
    """By blocks with made-up terms: two unknowns of one gap, one function and two velocities on the side of each"""
    rng = np.random.default_rng(2)
    fixed = object.__new__(Fixed)
    sizes = {"beneath": (2, 2), "net": (2, 1), "driven": (2, 6), "side": (6, 2), "volume": (6, 1), "carried": (6, 2),
             "own": (6, 6)}  # fmt: skip
    for name, size in sizes.items():
        setattr(fixed, name, rng.normal(size=size))
    fixed.gaps = 2
    outside, incident = rng.normal(size=(4, 4)), rng.normal(size=(4, 3))
    velocity, constant, left = fixed.solved(outside, incident)
    driven = fixed.driven + outside[:2, 2:] @ fixed.side.T
    assert (fixed.beneath - outside[:2, :2]) @ velocity[:, :6] + fixed.net @ constant[:, :6] == pytest.approx(driven)
    assert fixed.net.T @ velocity == pytest.approx(np.hstack([fixed.volume.T, np.zeros((1, 3))]), abs=1e-12)
    assert (fixed.beneath - outside[:2, :2]) @ velocity[:, 6:] + fixed.net @ constant[:, 6:] == pytest.approx(
        incident[:2]
    )
    assert left < 1e-12
    loads = fixed.loads(outside, velocity, constant, incident)
    common = (fixed.side @ outside[2:, :2] + fixed.carried) @ velocity + fixed.volume @ constant
    assert loads[:, :6] == pytest.approx(common[:, :6] + fixed.side @ outside[2:, 2:] @ fixed.side.T + fixed.own)
    assert loads[:, 6:] == pytest.approx(common[:, 6:] + fixed.side @ incident[2:])


def test_plane_waves_at_nodes_have_the_phase_of_their_places():
    """Summed over classes they are exp(ik·x) at the first image, the node itself"""
    one, two = (sender(CIRCLE, 2, 0.8, 3.0, 3.0, 1.0) for _ in range(2))
    places = [Place(0.0, 0.0, 0.0), Place(6.0, 1.0, 0.5)]
    exterior = Exterior([one, two], places)
    beta, m = np.array([0.4]), len(one.contour.x)
    rows = exterior.incident(0.8, beta)[: exterior.size, 0].reshape(2, 4, m)
    for row, place in zip(rows, places, strict=True):
        at = place.in_scene(one.contour.x + 1j * one.contour.y)
        assert row.sum(axis=0) == pytest.approx(np.exp(0.8j * (at.real * np.cos(0.4) + at.imag * np.sin(0.4))))
    assert exterior.weak @ exterior.basis == pytest.approx(np.eye(exterior.basis.shape[1]), abs=1e-9)
