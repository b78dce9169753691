"""Circle, strips and waves on the water beside a hull by hand: sizes, points, and what is sent on from its panels."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.second_order import surface_near, surface_waves
from hakobune.bem.second_order.surface_forces import _intervals
from hakobune.bem.second_order.surface_near import SurfaceInfluence, _sides, circle_about, strips_about
from hakobune.bem.second_order.surface_waves import Field, SurfaceWaves, Wave
from hakobune.bem.waves import incident_wave
from hakobune.meshing.shapes import box

RNG = np.random.default_rng(6)


def test_tails_begin_beyond_the_local_part_of_each_wave():
    """At the edge where its orders have become small, or behind its rings, one at least"""
    k, edges = np.array([0.5, 0.5, 0.5]), [10.0, 14.0, 20.0, 29.0, 40.0, 60.0, 90.0]
    waves = [SimpleNamespace(k=one, local=np.zeros(n)) for one, n in zip(k, (0, 2, 6), strict=True)]
    held = SimpleNamespace(waves=waves, rings=SimpleNamespace(edges=edges), circle=SimpleNamespace(radius=4.0))
    needed = (1.2 * int(2.0 + 4 * 2.0 ** (1 / 3) + 1) + 4) / 0.5  # 27.2 m
    assert 20.0 < needed < 29.0
    made, ends = _intervals(held)
    assert made.tolist() == edges and ends.tolist() == [3, 3, 6]
    held.circle.radius, k = 0.01, 5.0
    held.waves = [SimpleNamespace(k=5.0, local=np.zeros(0))]  # all orders are small at the first edge
    assert _intervals(held)[1].tolist() == [1]


@pytest.mark.parametrize("counts, symmetry", [((30, 15, 1), "xy"), ((8, 4, 1), "xy"), ((2, 1, 1), "")])
def test_a_circle_leaves_a_twelfth_of_its_radius_or_two_sides_around_the_hull(counts, symmetry):
    """1.08 times the half diagonal of the waterline, or two of the longest sides of panels beyond it"""
    mesh = box(40.0, 20.0, 5.0, counts=counts, symmetry=symmetry, grading=False)
    circle = circle_about(mesh)
    half = np.hypot(20.0, 10.0)
    _, sides = _sides(mesh)
    longest = np.linalg.norm(sides[:, 1] - sides[:, 0], axis=1).max()
    assert circle.radius == pytest.approx(max(1.08 * half, half + 2 * longest))
    assert circle.half == pytest.approx([20.0, 10.0]) and circle.centre == pytest.approx([0.0, 0.0])
    if not symmetry:
        moved = circle_about(mesh.moved(30.0, -7.0, 0.0))
        assert moved.centre == pytest.approx([30.0, -7.0]) and moved.radius == pytest.approx(circle.radius)


@pytest.mark.parametrize("k", [0.02, 0.3, 1.2])
def test_points_outwards_are_for_the_wave_between_and_keep_off_the_hull(k):
    """8 and 0.4 k w, but √(19 w/l) at most, and 5 and 0.4 k w at least: w from the side's middle to the circle"""
    mesh = box(40.0, 20.0, 5.0, counts=(5, 3, 1), symmetry="")
    panels, sides = _sides(mesh)
    x = (1 + np.polynomial.legendre.leggauss(4)[0]) / 2
    line = SimpleNamespace(points=sides[:, :1] + x[:, None] * (sides[:, 1] - sides[:, 0])[:, None], panels=panels)
    circle = circle_about(mesh)
    wide = circle.radius - np.linalg.norm(sides.mean(axis=1), axis=1)
    length = np.linalg.norm(sides[:, 1] - sides[:, 0], axis=1)
    waves = 0.4 * k * wide
    wanted = np.ceil(np.maximum(np.minimum(8 + waves, np.sqrt(19.0 * wide / length)), 5 + waves)).astype(int)
    found = [s.weights.shape[2] for s in strips_about(mesh, line, circle, k) for _ in range(len(s.weights))]
    assert sorted(found) == sorted(wanted.tolist())


def test_potentials_off_the_hull_are_those_of_its_sources_and_dipoles_in_portions(monkeypatch):
    """4πφ = ∬ φ ∂G/∂n − V G: Rankine and wave parts of the class; panels count as 2.2 wave lengths or depths at most"""
    monkeypatch.setattr(surface_near, "ROWS", 2)
    sizes, asked = np.array([1.0, 9.0, 30.0]), []
    S, D = RNG.normal(size=(2, 2, 5, 4)) + 1j

    class Pairs(SimpleNamespace):
        def _replace(self, **more):
            return Pairs(**(vars(self) | more))

        def blocks(self, table, Z):
            asked.append((self.sizes.tolist(), self.quadrature, table))
            rows = self.at[:, 0].astype(int)
            return S[:, rows].copy(), D[:, rows].copy()

    monkeypatch.setattr(surface_near, "Pairs", SimpleNamespace(of=lambda *them: Pairs(sizes=sizes, them=them)))
    monkeypatch.setattr(surface_near, "wave_table", lambda *them: them)
    made = object.__new__(SurfaceInfluence)
    made.geometry = SimpleNamespace(hull=4, classes=((1, 1), (-1, 1)))
    made.points, made.close, made.reach, made.deepest = np.arange(15.0).reshape(5, 3), "close", 90.0, 7.0
    made.points[:, 0] = np.arange(5)
    made.S, made.D = RNG.normal(size=(2, 2, 5, 4))
    flows = {cls: (RNG.normal(size=(2, 4)) + 1j, RNG.normal(size=(2, 4))) for cls in made.geometry.classes}
    for depth, k, longest in ((12.0, 0.4, 5.5), (2.0, 0.4, 4.4)):
        run = SimpleNamespace(omega=0.8, k=k, problem=SimpleNamespace(depth=depth, gravity=9.81))
        asked.clear()
        for count in (None, 3):
            found = made.values(run, flows, count)
            n = count or 5
            for i, (cls, (phi, V)) in enumerate(flows.items()):
                whole = phi @ (D[i] + made.D[i]).T - V @ (S[i] + made.S[i]).T
                assert found[cls] == pytest.approx(whole[:, :n] / (4 * np.pi))
        assert len(asked) == 5 and asked[0] == ([1.0, longest, longest], "close", (0.8, depth, 9.81, 90.0, 7.0))
    one = {(-1, 1): flows[-1, 1]}
    S, D = S[1:], D[1:]
    phi, V = flows[-1, 1]
    assert made.values(run, one)[-1, 1] == pytest.approx(
        (phi @ (D[0] + made.D[1]).T - V @ (S[0] + made.S[1]).T) / (4 * np.pi)
    )


def test_waves_are_kept_with_their_amplitude_at_the_centre_of_the_circle():
    """−ig/ω of unit amplitude times the phase there; near the hull with and without the incident wave"""
    line, points = RNG.normal(size=(3, 3)) * [1, 1, 0], RNG.normal(size=(4, 2))
    made = object.__new__(SurfaceWaves)
    made.problem = SimpleNamespace(depth=9.0, gravity=9.81)
    made.circle, made.line = SimpleNamespace(centre=np.array([2.0, -1.0])), SimpleNamespace(points=line)
    made.points, made.waves, made.near, asked = points, [], [], []
    near, sent, local = Field(RNG.normal(size=(2, 4)), RNG.normal(size=(2, 2, 4))), RNG.normal(size=(2, 5)), ["a", "b"]

    def of(run, flows, on_line):
        asked.append((flows, on_line))
        return near, (sent, local)

    made._of = of
    disturbance = [
        {(1, 1): (np.array([1.0 + i]), np.array([2.0])), (-1, 1): (np.zeros(1), np.zeros(1))} for i in (0, 1)
    ]
    run = SimpleNamespace(omega=0.8, k=0.1, headings=np.array([0.3, 1.2]), disturbance=lambda j, motion: disturbance[j],
                          geometry=SimpleNamespace(classes=((1, 1), (-1, 1))))  # fmt: skip
    flow = SimpleNamespace(potential=RNG.normal(size=(2, 3)) + 1j)
    made.add(run, flow, np.zeros((2, 6)))
    ((flows, on_line),) = asked
    assert list(flows) == [(1, 1)] and flows[1, 1][0].tolist() == [[1.0], [2.0]]  # nothing odd, nothing to do
    for n, beta in enumerate(run.headings):
        coming = incident_wave(line, beta, 0.8, 0.1, 9.0, 9.81)[0]
        assert on_line[n] == pytest.approx(flow.potential[n] - coming)
        wave, start = made.waves[n], -1j * 9.81 / 0.8
        phase = np.exp(0.1j * (2.0 * np.cos(beta) - np.sin(beta)))
        assert (wave.omega, wave.k, wave.direction, wave.local) == (0.8, 0.1, beta, local[n])
        assert wave.incident == pytest.approx(start * phase) and wave.sent == pytest.approx(start * sent[n])
    whole, alone = made.joined()
    for n, beta in enumerate(run.headings):
        value, velocity = incident_wave(np.column_stack([points, np.zeros(4)]), beta, 0.8, 0.1, 9.0, 9.81)
        assert alone.value[n] == pytest.approx(value) and whole.value[n] == pytest.approx(value + near.value[n])
        assert alone.slope[:, n] == pytest.approx(velocity[:, :2].T)
        assert whole.slope[:, n] == pytest.approx(velocity[:, :2].T + near.slope[:, n])


def test_motions_send_their_potential_and_normal_velocity_class_by_class():
    made, modes, asked = object.__new__(SurfaceWaves), RNG.normal(size=(3, 6)), []
    made.problem = SimpleNamespace(gravity=9.81)
    sent = RNG.normal(size=(6, 5))

    def of(run, flows, on_line):
        asked.append((flows, on_line))
        return "near", (sent, list("abcdef"))

    made._of = of
    potentials = {(1, 1): RNG.normal(size=(3, 3)), (-1, 1): RNG.normal(size=(2, 3))}
    run = SimpleNamespace(omega=0.8, k=0.1, geometry=SimpleNamespace(hull=3), prepared=SimpleNamespace(modes=modes),
                          columns={(1, 1): ([2], [0, 1]), (-1, 1): ([0, 4], [])}, potentials=potentials)  # fmt: skip
    near, waves = made.radiated(run, SimpleNamespace(potential="line"))
    ((flows, on_line),) = asked
    assert near == "near" and on_line == "line"
    for cls, moving in (((1, 1), [2]), ((-1, 1), [0, 4])):
        phi, V = flows[cls]
        assert phi[moving] == pytest.approx(potentials[cls][: len(moving)])
        assert V[moving] == pytest.approx(modes[:, moving].T)
        others = [d for d in range(6) if d not in moving]
        assert not phi[others].any() and not V[others].any()
    for i, wave in enumerate(waves):
        assert wave == Wave(0.8, 0.1, 0.0, 0.0, wave.sent, "abcdef"[i])
        assert wave.sent == pytest.approx(-1j * 9.81 / 0.8 * sent[i])


def test_second_factors_and_orders_of_waves_are_those_of_their_kind():
    from hakobune.bem.second_order.kinds import DIFFERENCE, SUM

    field = Field(RNG.normal(size=(2, 3)) + 1j, RNG.normal(size=(2, 2, 3)) - 2j)
    assert np.array_equal(field.second(DIFFERENCE).slope, field.slope.conj())
    assert np.array_equal(field.second(SUM).value, field.value) and field[1].slope.shape == (2, 3)
    assert (field + field).value == pytest.approx(2 * field.value)
    assert (field + field).slope == pytest.approx(2 * field.slope)
    wave = Wave(0.8, 0.1, 0.7, 2.0 - 1j, np.zeros(7), None)
    assert wave.most == 3
    m = np.arange(-2, 3)
    assert wave.incident_orders(2) == pytest.approx((2.0 - 1j) * 1j**m * np.exp(-0.7j * m))


@pytest.mark.parametrize("of_force", [[0.3, 0.6], [0.9, 1.9]])
def test_points_of_the_water_are_for_the_shortest_wave_and_rings_for_the_longest_too(of_force, monkeypatch):
    """Of waves and forces together; weights on all images, points of strips off the hull and of rings"""
    from hakobune.bem.second_order.kinds import DIFFERENCE
    from hakobune.bem.second_order.surface_far import orders_sent
    from hakobune.bem.waves import wavenumber

    asked, omega = {}, [0.5, 1.1]
    circle = SimpleNamespace(radius=7.0)
    strips = [
        SimpleNamespace(points=RNG.normal(size=(s, 2, 3, 2)), weights=RNG.uniform(size=(s, 2, 3))) for s in (1, 2)
    ]
    monkeypatch.setattr(surface_waves, "circle_about", lambda mesh: circle)
    monkeypatch.setattr(surface_waves, "strips_about", lambda *them: asked.update(strips=them) or strips)
    monkeypatch.setattr(surface_waves, "rings_about", lambda *them: asked.update(rings=them) or "rings")
    monkeypatch.setattr(surface_waves, "SurfaceInfluence", lambda g, at: asked.update(at=at) or "influence")
    at_rings = RNG.normal(size=(5, 2))
    monkeypatch.setattr(SurfaceWaves, "_quadrant", lambda self: ("around", "image", at_rings))
    g = SimpleNamespace(mesh="mesh", copies=2, images=[(1, 1), (-1, 1)])
    prepared = SimpleNamespace(
        problem=SimpleNamespace(depth=9.0, gravity=9.81), geometry=SimpleNamespace(without_lid=g)
    )
    surfaces = SimpleNamespace(waterline=SimpleNamespace(flow="line"))
    made = SurfaceWaves(prepared, surfaces, omega, of_force, DIFFERENCE)
    low, high = (float(wavenumber(f([*omega, *of_force]), 9.0, 9.81)) for f in (min, max))
    assert asked["strips"] == ("mesh", "line", circle, pytest.approx(high))
    about, depth, k, most, kind = asked["rings"]
    assert (about, depth, kind) == (circle, 9.0, DIFFERENCE) and k == pytest.approx([low, high])
    assert most == orders_sent(high * 7.0)
    beside = np.concatenate([s.points[:, :, 1:].reshape(-1, 2) for s in strips])
    assert asked["at"] == pytest.approx(np.column_stack([np.concatenate([beside, at_rings]), np.zeros(12 + 5)]))
    assert (made.inside, made.beside) == (18, 12) and made.rings == "rings" and made.line is surfaces.waterline
    weights = np.concatenate([s.weights.ravel() for s in strips])
    assert made.weights == pytest.approx(np.tile(weights, 2))
    inside = np.concatenate([s.points.reshape(-1, 2) for s in strips])
    assert made.points == pytest.approx(np.concatenate([inside, inside * [-1, 1]]))


def test_fields_beside_the_hull_are_put_together_strip_by_strip_and_image_by_image():
    """Slopes of an image have its signs"""
    made = object.__new__(SurfaceWaves)
    made.images = np.array([(1.0, 1.0), (-1.0, 1.0)])

    def strip(count):
        return SimpleNamespace(
            weights=np.zeros((count, 2, 3)),
            values=lambda line, beside: np.concatenate(
                [np.broadcast_to(line[..., :1, None, None], (*beside.shape[:2], count, 2, 1)),
                 beside.reshape(*beside.shape[:2], count, 2, 2)], axis=-1),
            gradient=lambda value: np.stack([2 * value, 3 * value], axis=-1),
        )  # fmt: skip

    made.strips = [strip(1), strip(2)]
    line, beside = RNG.normal(size=(4, 2, 5)), RNG.normal(size=(4, 2, 12))
    field = made._near(line, beside)
    assert field.value.shape == (4, 36) and field.slope.shape == (2, 4, 36)
    for c in range(4):
        for image in range(2):
            own = field.value[c].reshape(2, 18)[image].reshape(3, 2, 3)
            assert own[..., 0] == pytest.approx(np.full((3, 2), line[c, image, 0]))
            assert own[..., 1:] == pytest.approx(beside[c, image].reshape(3, 2, 2))
            slope = field.slope[:, c].reshape(2, 2, 18)[:, image]
            assert slope[0] == pytest.approx(2 * own.ravel() * made.images[image, 0])
            assert slope[1] == pytest.approx(3 * own.ravel())


def test_waves_of_a_hull_are_known_on_its_rings_less_what_travels(monkeypatch):
    """c_m iᵐ of the Kochin function, and −ig/ω c_m H_m(kr) taken from what the panels give there, class by class"""
    from scipy.special import hankel1

    from hakobune.bem.second_order.kinds import DIFFERENCE
    from hakobune.bem.second_order.surface_far import Rings, orders_sent

    made, k, omega, g = object.__new__(SurfaceWaves), 0.3, 0.8, 9.81
    rings = Rings(np.array([4.0, 6.0, 9.0, 14.0]), 24, np.zeros(2))
    made.rings, made.kind, made.images = rings, DIFFERENCE, np.array([(1.0, 1.0), (-1.0, 1.0)])
    made.circle, made.problem = SimpleNamespace(radius=4.0, centre="centre"), SimpleNamespace(depth=9.0, gravity=g)
    signs = {(1, 1): np.array([1.0, 1.0]), (-1, 1): np.array([1.0, -1.0])}
    made.geometry = SimpleNamespace(signs=signs.get)
    monkeypatch.setattr(surface_waves, "reach_of_local", lambda *them: 8.9)  # m: two intervals
    most = orders_sent(k * 4.0)
    m = np.arange(-most, most + 1)
    kochin = RNG.normal(size=(2, len(m))) + 1j * RNG.normal(size=(2, len(m)))
    monkeypatch.setattr(surface_waves, "sent_orders", lambda run, flows, orders, centre: kochin)
    theta = rings.directions
    made._around, made._of_image = np.minimum(np.arange(24), 23 - np.arange(24)), (np.arange(24) >= 12).astype(int)
    made.beside, own = 3, 12
    made.influence, asked = SimpleNamespace(points=np.zeros((3 + 3 * 6 * own, 3))), []
    found = {cls: RNG.normal(size=(2, 3 + 2 * 6 * own)) + 1j for cls in signs}
    made.influence.values = lambda run, flows, count: asked.append(count) or found
    made._near = lambda line, beside: (line, beside)
    on_line = RNG.normal(size=(2, 8))
    (line, beside), (sent, local) = made._of(SimpleNamespace(k=k, omega=omega), "flows", on_line)
    assert asked == [3 + 2 * 6 * own] and line.shape == (2, 2, 4)
    for image in range(2):
        assert beside[:, image] == pytest.approx(sum(signs[cls][image] * found[cls][:, :3] for cls in signs))
    c = kochin * 1j ** (m % 4)
    assert sent == pytest.approx(c) and local.shape == (2, 2, 6, 24)
    turn = np.exp(1j * np.outer(rings.orders, theta))
    for w in range(2):
        for r in range(6):
            values = sum(signs[cls][made._of_image] * found[cls][:, 3:].reshape(2, 2, 6, own)[:, w, r][:, made._around]
                         for cls in signs)  # fmt: skip
            travels = -1j * g / omega * (c * hankel1(m, k * rings.radii[w, r])) @ np.exp(1j * np.outer(m, theta))
            assert local[:, w, r] @ turn == pytest.approx(values - travels)


@pytest.mark.parametrize("good, tried", [(0, [0.3]), (1, [0.3, 0.15]), (9, [0.3, 0.15, 0.0])])
def test_strips_lean_towards_those_of_an_ellipse_as_far_as_none_folds(good, tried, monkeypatch):
    seen = []

    def strips(sides, known, circle, count, outwards, spread):
        if spread not in seen:
            seen.append(spread)
        return SimpleNamespace(even=len(seen) > good)

    monkeypatch.setattr(surface_near, "_strips", strips)
    mesh = box(40.0, 20.0, 5.0, counts=(5, 3, 1), symmetry="")
    panels, sides = _sides(mesh)
    x = (1 + np.polynomial.legendre.leggauss(4)[0]) / 2
    line = SimpleNamespace(points=sides[:, :1] + x[:, None] * (sides[:, 1] - sides[:, 0])[:, None], panels=panels)
    strips_about(mesh, line, circle_about(mesh), 0.1)
    assert seen == tried


@pytest.mark.parametrize("share, even", [(1.05e-8, True), (0.95e-8, False), (-1.0, False)])
def test_a_strip_is_even_where_no_weight_is_a_hundred_millionth_of_its_largest(share, even):
    """Those on the hull, which may be small, are not looked at but for their sign"""
    weights = np.ones((2, 2, 3))
    weights[1, 0, 1], weights[0, 0, 0] = 3.0 * share, 1e-12
    weights[1, 1, 2] = 3.0
    none = np.zeros(0)
    assert surface_near.Strips(none, weights, none, none, none, none, none, none).even == even


@pytest.mark.parametrize("degrees, images, whole", [
    ([0, 90, 180, 270, 360], 1, True), ([0, 90, 180], 2, True), ([0, 90], 4, True),
    ([0, 90, 60, 180, 270, 360], 1, False),  # a side that runs back
    ([0, 90, 180], 1, False), ([0, 90, 180, 270, 360], 2, False), ([0, 90, 180, 269.9], 1, False),
])  # fmt: skip
def test_a_waterline_runs_once_around_the_middle_and_never_back(degrees, images, whole, monkeypatch):
    turn = np.radians(degrees)
    corners = 5.0 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    sides = np.stack([corners[:-1], corners[1:]], axis=1)
    monkeypatch.setattr(surface_near, "_sides", lambda mesh: (np.arange(len(sides)), sides))
    monkeypatch.setattr(surface_near, "_known", lambda panels, sides, line: (panels, panels))
    monkeypatch.setattr(surface_near, "_strips", lambda *them: SimpleNamespace(even=True))
    mesh = SimpleNamespace(reflections=lambda: range(images))
    circle = surface_near.Circle(np.zeros(2), 8.0, np.full(2, 5.0))
    if whole:
        assert len(strips_about(mesh, None, circle, 0.1)) == 1
        return
    with pytest.raises(ValueError, match="one closed curve, with each point visible from its middle"):
        strips_about(mesh, None, circle, 0.1)


@pytest.mark.parametrize("folds, tried", [({}, 1), ({3}, 2), ({5}, 2), ({3, 5}, 2)])
def test_strips_of_every_number_of_points_are_even_before_they_are_taken(folds, tried, monkeypatch):
    """Sides of 1 m and of 9 m have 3 and 5 points; one kind that folds is enough to lean less"""
    corners = np.array([[4.5, 0.5], [-4.5, 0.5], [-4.5, -0.5], [4.5, -0.5], [4.5, 0.5]])
    sides, seen = np.stack([corners[:-1], corners[1:]], axis=1), []

    def strips(sides, known, circle, count, outwards, spread):
        seen.append((count, spread))
        return SimpleNamespace(even=spread < 0.3 or count not in folds)

    monkeypatch.setattr(surface_near, "_sides", lambda mesh: (np.arange(4), sides))
    monkeypatch.setattr(surface_near, "_known", lambda panels, sides, line: (panels, panels))
    monkeypatch.setattr(surface_near, "_strips", strips)
    found = strips_about(SimpleNamespace(reflections=lambda: [0]), None,
                         surface_near.Circle(np.zeros(2), 9.0, np.array([4.5, 0.5])), 0.1)  # fmt: skip
    assert {count for count, _ in seen} == {3, 5} and len(found) == 2
    assert [spread for _, spread in seen] == [spread for spread in (0.3, 0.15)[:tried] for _ in range(2)]
