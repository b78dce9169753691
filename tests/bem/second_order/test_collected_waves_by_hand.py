"""First-order waves as they are collected for pairs: what is asked of a frequency, which run serves twice, who shares;
and around a cylinder what decays from its side."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import kv, kvp

from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.depth_modes.gap import smooth_cutoff
from hakobune.bem.second_order import contour_surface, contour_waves, first_order_waves
from hakobune.bem.second_order.contour_surface import CylinderSurface
from hakobune.bem.second_order.contour_waves import ContourWaves
from hakobune.bem.second_order.first_order_waves import FirstOrderWaves, PanelWaves, WavesOfBodies
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM

RNG = np.random.default_rng(9)


def collected(made_of=FirstOrderWaves, **held):
    made = object.__new__(made_of)
    made.parts, made.loads, made.rao, made.far, made.in_swayed = [], [], [], [], []
    vars(made).update({"moving": True, "kind": DIFFERENCE, "swayed": None} | held)
    return made


@pytest.mark.parametrize("moving, kind, wanted", [
    (False, SUM, {"excitation_force"}), (True, SUM, {"excitation_force", "rao", "added_mass"}),
    (False, DIFFERENCE, {"excitation_force", "drift_force_fixed"}),
    (True, DIFFERENCE, {"excitation_force", "rao", "added_mass", "drift_force"}),
])  # fmt: skip
def test_quantities_of_a_frequency_are_those_that_pairs_need(moving, kind, wanted):
    assert collected(moving=moving, kind=kind).wanted == wanted


def test_a_run_leaves_its_flow_its_loads_and_its_far_field(monkeypatch):
    """Motions about the rotation centre become those about the origin; those of another resolution beside them"""
    T, rao = RNG.normal(size=(6, 6)), RNG.normal(size=(2, 6)) + 1j
    monkeypatch.setattr(first_order_waves, "first_order_loads", lambda run, problem, motions: ("loads", motions))
    asked = []
    run = SimpleNamespace(rao=rao, drift_of_two=lambda moving: asked.append(moving) or "far")
    problem, swayed = SimpleNamespace(transform=T), RNG.normal(size=(2, 2, 6))
    made = collected(problem=problem, headings=np.zeros(2), swayed=swayed)
    assert made.take(run, lambda motions: ("flow", motions)) == pytest.approx(rao @ T)
    assert made.parts[0][1] == pytest.approx(rao @ T) and made.loads[0][1] is rao and made.rao[0] is rao
    assert made.far == ["far"] and asked == [True]
    made.take(run, lambda motions: ("flow", motions))
    for n, (flow, loads, other) in enumerate(made.in_swayed):
        assert other is not rao and np.array_equal(other, swayed[n])
        assert flow[1] == pytest.approx(swayed[n] @ T) and np.array_equal(loads[1], swayed[n])
    held = collected(problem=problem, headings=np.zeros(2), moving=False, kind=SUM)
    assert not held.take(run, lambda motions: motions).any() and not held.loads[0].any() and not held.rao[0].any()
    assert held.loads[0].shape == (2, 6) and held.far == [] and held.in_swayed == []


def test_a_frequency_of_the_force_among_those_of_the_waves_is_solved_once(monkeypatch):
    """Within a millionth of a step; others by themselves, from the lowest on"""
    monkeypatch.setattr(first_order_waves, "wave_flow", lambda run, surfaces, motions: ("flow", run.omega, motions))
    monkeypatch.setattr(first_order_waves, "lowest", lambda problem: 0.15)
    asked, added = [], []

    def run(omega, headings, want, theta, dofs):
        asked.append((omega, list(headings), set(want), dofs))
        return SimpleNamespace(omega=omega)

    made = collected(PanelWaves, of_force=np.array([0.0, 0.1, 0.2]), near=1e-7, radiating=[], moving=False, kind=SUM,
                     headings=np.array([0.3]), surfaces="surfaces",
                     prepared=SimpleNamespace(run=run), problem=SimpleNamespace(dofs="all"))  # fmt: skip
    made.around = SimpleNamespace(add=lambda *them: added.append(them))

    def take(run, flow_of):
        made.parts.append(flow_of("motions"))
        return "motions"

    made.take = take
    made.solve(0.2 + 0.9e-7)
    made.solve(0.3)
    assert asked == [(0.2 + 0.9e-7, [0.3], {"excitation_force", "added_mass"}, "all"),
                     (0.3, [0.3], {"excitation_force"}, "all")]  # fmt: skip
    assert [one.omega for one in made.radiating] == [0.2 + 0.9e-7]
    assert [(run.omega, flow, motions) for run, flow, motions in added] == [
        (0.2 + 0.9e-7, ("flow", 0.2 + 0.9e-7, "motions"), "motions"), (0.3, ("flow", 0.3, "motions"), "motions"),
    ]  # fmt: skip
    assert made.radiation(0.2) is made.radiating[0] and len(asked) == 2
    assert made.radiation(0.1).omega == 0.15 and made.radiation(0.2 + 3e-7).omega == 0.2 + 3e-7
    assert asked[2:] == [(0.15, [0.0], {"added_mass"}, "all"), (0.2 + 3e-7, [0.0], {"added_mass"}, "all")]


@dataclass(frozen=True)
class Problem:
    sectors: object = None
    damping_lids: tuple = ()
    band: object = "given"
    coarse: object = "given"
    finer: object = "given"

    def prepared(self):
        return SimpleNamespace(problem=self, axisymmetric_geometry=SimpleNamespace(sectors=self.sectors))


@pytest.mark.parametrize("count, more, shares", [
    (12, {}, True), (11, {}, False), (40, {"damping_lids": ("lid",)}, False), (40, {"sectors": "some"}, False),
])  # fmt: skip
def test_many_frequencies_share_their_work_unless_the_body_is_round_or_has_lids(count, more, shares):
    made = first_order_waves._sharing(Problem(**more), 0.2, 1.4, count).problem
    assert made.band == ((0.2, 1.4) if shares else None) and made.coarse is None and made.finer is None


def test_loads_of_a_box_that_needs_the_flow_under_it_are_unknown(monkeypatch):
    squares = RNG.normal(size=(1, 1, 1, 1, 6)) + 0j
    monkeypatch.setattr(FirstOrderWaves, "joined", lambda self: ("flow", squares.copy()))
    made = collected(ContourWaves, points=SimpleNamespace(whole=False))
    flow, found = made.joined()
    assert flow == "flow" and np.isnan(found[..., 2:5]).all() and np.array_equal(found[..., [0, 1, 5]],
                                                                                 squares[..., [0, 1, 5]])  # fmt: skip
    made.points.whole = True
    assert np.array_equal(made.joined()[1], squares)


def test_waves_of_the_contour_method_are_of_its_points_and_from_the_lowest_frequency_on(monkeypatch):
    asked = []
    monkeypatch.setattr(contour_waves, "SharedFrequency", lambda *them: asked.append(them) or "shared")
    monkeypatch.setattr(contour_waves, "wave_flow", lambda *them: them)
    monkeypatch.setattr(contour_waves, "radiated_flow", lambda *them: them)
    monkeypatch.setattr(contour_waves, "long_wave_forces", lambda *them: them)
    monkeypatch.setattr(first_order_waves, "lowest", lambda problem: 0.15)
    problem, runs, added = SimpleNamespace(density=1025.0, gravity=9.8), [], []
    made = collected(ContourWaves, problem=problem, points="points", surfaces="surfaces", headings=[0.4], kind=SUM)
    made.prepared = SimpleNamespace(run=lambda *them: runs.append(them) or "run")
    made.around = SimpleNamespace(add=lambda *them: added.append(them))
    made.take = lambda run, flow_of: (run, flow_of("motions"))
    made.solve(0.7)
    assert runs[0][:3] == (0.7, [0.4], {"excitation_force", "rao", "added_mass"})
    assert added == [("shared", ("run", ("shared", "points", "surfaces", "motions")))]
    for omega in (0.1, 0.2):
        assert made.radiation(omega) == "shared"
    assert asked == [("points", omega, headings, 1025.0, 9.8)
                     for omega, headings in ((0.7, [0.4]), (0.15, []), (0.2, []))]  # fmt: skip
    assert made.radiated("freq") == ("freq", "points", "surfaces") and made.long_waves("freq", "k") == ("freq", "k")
    made.around = None
    made.solve(0.7)
    assert len(added) == 1


def around(radius=2.0, most=3):
    made = object.__new__(CylinderSurface)
    made.radius, made.most = radius, most
    return made


@pytest.mark.parametrize("cls", CLASSES)
def test_orders_of_a_class_are_halves_of_both_signs(cls):
    """Σ e^{imθ} of both signs is cos mθ, or sin mθ of classes odd in y; orders beyond the highest are left out"""
    made, plan = around(), Circle(2.0)
    made.points = SimpleNamespace(body=SimpleNamespace(plan=plan))
    orders = plan.orders(cls, 5)
    tables, velocity = RNG.normal(size=(6, 4, 3)), RNG.normal(size=(2, 3, len(orders)))
    local = np.zeros((2, 4, 8), complex)
    made._add_local(local, cls, 5, tables, velocity)
    theta = np.array([0.3, 1.9, 4.0])
    found = np.einsum("fpm,tm->fpt", local, np.exp(1j * np.outer(theta, np.fft.fftfreq(8, 1 / 8))))
    wanted = np.zeros((2, 4, 3))
    for n, m in enumerate(orders):
        if m <= 3:
            shape = np.cos(m * theta) if cls[1] == 1 else np.sin(m * theta)
            part = np.einsum("pr,fr->fp", tables[m], velocity[:, :, n])
            wanted += part[..., None] * shape / np.sqrt(np.pi * 2.0 * (1 if m else 2))
    assert found == pytest.approx(wanted, abs=1e-12)


def test_what_decays_from_the_side_is_a_sum_over_modes_cut_where_it_has_decayed():
    """Σ Zₙ(0) Kₘ(kₙr)/kₙKₘ'(kₙR) ⟨u, Zₙ⟩/⟨Zₙ, Zₙ⟩ of 14 h/π(r − R) modes, eight at least; near the side cut smoothly"""
    made, h, asked = around(), 5.0, []
    made.rings = SimpleNamespace(radii=np.array([[2.004, 2.3], [4.0, 30.0]]))
    combinations = RNG.normal(size=(3, 2))

    def outer_modes(omega, count, gravity):
        asked.append((omega, count, gravity))
        n = np.arange(1, count + 1)
        return SimpleNamespace(wavenumbers=(n - 0.1) * np.pi / h, norms=1.0 + 1 / n,
                               rows=np.stack([1.0 / n, (-1.0) ** n / n]))  # fmt: skip

    gap = SimpleNamespace(outer_modes=outer_modes, depth=h)
    made.points = SimpleNamespace(body=SimpleNamespace(profiles=SimpleNamespace(gap=gap, combinations=combinations)))
    found = made._tables(SimpleNamespace(omega=0.9, gravity=9.8, degree=3))
    most = int(np.ceil(14.0 / (np.pi * 2e-3)))
    assert asked == [(0.9, most, 9.8)] and found.shape == (4, 4, 3)
    for p, r in enumerate((2.004, 2.3, 4.0, 30.0)):
        count = min(most, max(8, int(np.ceil(14.0 * h / (np.pi * (r - 2.0))))))
        n = np.arange(1, count + 1)
        k = (n - 0.1) * np.pi / h
        few = n[k * r < 600]  # where K is a number; the rest has decayed, but for the first radius
        k, cut = k[: len(few)], (smooth_cutoff(n / count) if count == most else np.ones(count))[: len(few)]
        rows = combinations @ np.stack([1.0 / few, (-1.0) ** few / few]) * np.cos(k * h) / (1 + 1 / few) / k
        for m in range(4):
            true = rows @ (kv(m, k * r) / kvp(m, k * 2.0) * cut)
            assert found[m, p] == pytest.approx(true, abs=1e-7 if p else 2e-2 * np.abs(true).max())
    assert contour_surface.NEAREST == 2e-3


def test_parts_on_the_side_are_integrals_around_it_of_all_images(monkeypatch):
    """∮ φ e^{−imθ} ds / 2πR of the propagating mode, whose potential of a class is even or odd"""
    made, R = around(most=3), 2.0
    plan = Circle(R)
    contour = plan.contour(0.0, 9, 1e-6)
    theta = np.arctan2(contour.y, contour.x)
    parts = {cls: RNG.normal(size=(len(plan.orders(cls, 3)), 2)) for cls in CLASSES}
    shape = {cls: np.cos if cls[1] == 1 else np.sin for cls in CLASSES}

    def amplitudes(freq, values, cls):
        turn = shape[cls](np.outer(theta, plan.orders(cls, 3)))
        return [[turn @ parts[cls]]]

    seen = {}
    monkeypatch.setattr(contour_surface, "plan_values", lambda freq: dict.fromkeys(CLASSES, "values"))
    monkeypatch.setattr(contour_surface, "amplitudes", amplitudes)
    made.rings = SimpleNamespace(radii=np.zeros((2, 3)), count=8)
    made._tables = lambda freq: "tables"
    made._add_local = lambda local, cls, degree, tables, velocity: seen.setdefault(cls, (degree, tables, velocity))
    sides = RNG.normal(size=(1, 2, 4))
    flow = SimpleNamespace(velocity=RNG.normal(size=(3, 4, 2)))
    freq = SimpleNamespace(contour=contour, degree=3, flows=dict.fromkeys(CLASSES, ([0], None, sides, flow)))
    columns = {cls: RNG.normal(size=(5, 2)) for cls in CLASSES}
    whole, local = made._of(freq, columns, 5)
    assert whole.shape == (5, 7) and local.shape == (5, 2, 3, 8)
    around_it = 2 * np.pi * np.arange(64) / 64
    for f in range(5):
        value = sum(shape[cls](np.outer(around_it, plan.orders(cls, 3))) @ parts[cls] @ columns[cls][f]
                    for cls in CLASSES)  # fmt: skip
        for m in range(-3, 4):
            assert whole[f, m + 3] == pytest.approx(np.mean(value * np.exp(-1j * m * around_it)), abs=1e-9)
    degree, tables, velocity = seen[1, 1]
    both = np.concatenate([flow.velocity, np.zeros((2, 4, 2))])
    both[-2:, :, 0] = sides[0]
    assert (degree, tables) == (3, "tables")
    assert velocity == pytest.approx(np.einsum("fc,rnc->frn", columns[1, 1], both))


class Hull(tuple):
    """A body by name, whether it is fixed, and its centre"""

    fixed = property(lambda self: self[1])
    rotation_center = property(lambda self: self[2])

    def _replace(self, fixed):
        return Hull((self[0], fixed, self[2]))


ONE, TWO = Hull(("one", False, (1.0, 2.0, 3.0))), Hull(("two", True, (4.0, 5.0, 6.0)))


def of_bodies(**held):
    made = collected(WavesOfBodies, each=["on one", "on two"], radiating=[], again=([], []), **held)
    return made


def test_the_flows_of_several_bodies_are_of_each_hull_with_its_own_motions(monkeypatch):
    """One run serves twice only where all bodies radiate; motions of another resolution are kept apart"""
    monkeypatch.setattr(first_order_waves, "disturbed_flow", lambda run, surface, motions, six: (surface, motions, six))
    monkeypatch.setattr(first_order_waves.of_each_body, "own_motions", lambda run, moving: rao[(len(runs) - 1) % 2])
    monkeypatch.setattr(first_order_waves.of_each_body, "first_order_loads", lambda run, own: ("loads", own))
    T, rao, swayed, runs = RNG.normal(size=(12, 12)), RNG.normal(size=(2, 3, 12)), RNG.normal(size=(2, 3, 12)), []
    prepared = SimpleNamespace(run=lambda omega, headings, want, theta, dofs: runs.append((omega, want, dofs)) or omega)
    problem = SimpleNamespace(transform=T, bodies=(ONE, TWO), dofs="all")
    made = of_bodies(prepared=prepared, free=prepared, problem=problem, headings=[0.1], swayed=swayed,
                     of_force=np.array([0.0, 0.3]), near=1e-7)  # fmt: skip
    assert made.wanted == {"excitation_force", "added_mass", "rao"}
    made.solve(0.3)
    made.solve(0.4)
    assert runs == [(0.3, made.wanted, "all"), (0.4, made.wanted, "all")] and made.radiating == [0.3]
    assert made.rao[1] is not rao and np.array_equal(made.rao[1], rao[1])
    for (parts, loads), own in (((made.parts, made.loads), rao), (made.again, swayed)):
        assert len(parts) == len(loads) == 2
        for n in range(2):
            motions = own[n] @ T
            for (surface, whole, six), name, at in zip(parts[n], made.each, (slice(6), slice(6, 12)), strict=True):
                assert surface == name and whole == pytest.approx(motions) and six == pytest.approx(motions[:, at])
            assert np.array_equal(loads[n][1], own[n])
    joined = []
    made._joined = lambda parts, loads, rao: joined.append((parts, loads, rao)) or ("flows", "squares")
    assert made.joined() == ("flows", "squares") and made.squares_in_swayed() == "squares"
    monkeypatch.setattr(PanelWaves, "radiation", lambda self, omega: ("as of one body", omega))
    assert made.radiation(0.3) == ("as of one body", 0.3) and len(runs) == 2
    assert joined[0] == (made.parts, made.loads, made.rao) and joined[1] == (*made.again, made.in_swayed)
    made.free, made.radiating, made.swayed, made.moving = "others", [], None, False
    made.solve(0.3)
    assert made.radiating == [] and made.wanted == {"excitation_force", "added_mass"} and len(made.in_swayed) == 2


def test_fixed_bodies_radiate_for_the_forces_on_them(monkeypatch):
    """Without their restraint, band and coarser mesh; from the lowest frequency on"""
    monkeypatch.setattr(first_order_waves, "lowest", lambda problem: 0.15)

    @dataclass(frozen=True)
    class Held:
        bodies: tuple
        inertia_matrix: object = "given"
        hydrostatic_stiffness: object = "given"
        viscous: object = "given"
        band: object = "given"
        dofs: object = "all"

    @dataclass(frozen=True)
    class Prepared:
        problem: object
        coarse: object = "given"

        def run(self, *question):
            return question

    prepared = Prepared(Held((ONE, TWO)))
    made = of_bodies(prepared=prepared, problem=prepared.problem)
    made.free = made._all_free()
    assert made.free == Prepared(Held((ONE, TWO._replace(False)), None, None, None, None), None)
    assert made.radiation(0.1) == (0.15, [0.0], {"added_mass"}, None, "all") and made.radiation(0.2)[0] == 0.2
    free = Prepared(Held((ONE,)))
    made = of_bodies(prepared=free, problem=free.problem)
    assert made._all_free() is free


def test_moving_hulls_push_all_bodies_and_fixed_ones_none(monkeypatch):
    """Σ_b of the potential that moves with hull b, on each body a by the waves that a radiates"""
    monkeypatch.setattr(first_order_waves, "radiated_flow", lambda *them: them)

    @dataclass(frozen=True)
    class Whole:
        bodies: tuple
        transform: object
        rotation_center: tuple = ()

    def forces(surface, flow, one, two, made, about, kind):
        assert about.bodies == () and about.rotation_center == (1.0, 2.0, 3.0) and kind is SUM
        assert (surface, flow) == ("on one", "flow one")
        return np.outer(one + 10 * two, np.arange(6.0)) + made

    monkeypatch.setattr(first_order_waves, "body_forces", forces)
    T = RNG.normal(size=(12, 12))
    made = of_bodies(problem=Whole((ONE, TWO), T), kind=SUM)
    assert made.radiated("run") == [[("run", "on one", 0, True), ("run", "on two", 0, False)],
                                    [("run", "on one", 1, False), ("run", "on two", 1, True)]]  # fmt: skip
    one, two = np.array([1, 2]), np.array([0, 1])
    found = made.of_moving_hull(["flow one", "flow two"], one, two, [[0.5, "none"], [7.0, "none"]])
    own = np.outer(one + 10 * two, np.arange(6.0))
    assert found == pytest.approx(np.hstack([own + 0.5, own + 7.0]) @ T.T)


@pytest.mark.parametrize("depth, scale", [(16.0, 16.0), (np.inf, 5.0)])
def test_the_lowest_frequency_is_a_thousandth_of_that_of_the_depth_or_draft(depth, scale):
    from hakobune.bem.second_order.long_wave_forces import lowest

    problem = SimpleNamespace(depth=depth, gravity=9.0, mesh=SimpleNamespace(draft=5.0))
    assert lowest(problem) == pytest.approx(1e-3 * np.sqrt(9.0 / scale))
