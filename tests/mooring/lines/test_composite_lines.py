"""Lines of several segments in a system, against uniform lines, and against lines joined at free points."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.mooring.lines.catenary.state import State
from hakobune.mooring.lines.multi_segment.bed import Bed
from hakobune.mooring.lines.multi_segment.line import StaticLine
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.equilibrium import held_at, moved, rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import (
    Anchor,
    CompositeLine,
    EquilibriumError,
    Fairlead,
    FreePoint,
    LineSystemError,
    LineType,
    MooredBody,
    UniformLine,
)
from hakobune.mooring.lines.system.shapes import line_shapes, loads_on_lines
from hakobune.mooring.studies.system_at_rest import mooring_stiffness, one_line_broken

G, RHO = 9.80665, 1025.0
CHAIN, ROPE = LineType("chain", 1000.0, 5e8, breaking_load=4e6), LineType("rope", 60.0, 2e7, breaking_load=1.5e6)


def segment(kind, length):
    return Segment(length, kind.weight, kind.axial_stiffness, breaking_load=kind.breaking_load)


def composite(name, parts, a, b, loads=(), **more):
    """parts : (type, length) from end a on; loads : (position, weight)"""
    loads = tuple(PointLoad(*load) for load in loads)
    return CompositeLine(name, tuple(segment(*part) for part in parts), a, b, loads, **more)


def three_legs(first, joints=(), load=(2e5, 1e5, 0.0, 0.0, 0.0, 2e6), z=-4.0):
    """A body free in all motions on two chains and on what `first` makes of the ends "A0" and "F0"."""
    points, lines = list(joints), list(first("A0", "F0"))
    for i, a in enumerate(np.radians([10, 130, 250])):
        points += [
            Anchor(f"A{i}", (340 * np.cos(a), 340 * np.sin(a), -60.0)),
            Fairlead(f"F{i}", "hull", (30 * np.cos(a), 12 * np.sin(a), z)),
        ]
        if i:
            lines.append(UniformLine(f"L{i}", CHAIN, 325.0, f"A{i}", f"F{i}"))
    C = np.diag([0.0, 0.0, 3e7, 5e9, 3e10, 0.0])
    return System(60.0, lines, points, [MooredBody("hull", freedom=DOFS, hydrostatic_stiffness=C, load=load)], RHO, G)


def same_rest(one, other, tolerance):
    """Both at rest: position, stiffness of the body, and pull of the first legs on it, to a share"""
    a, b = rest(one), rest(other)
    scale = np.sqrt(np.abs(np.diag(mooring_stiffness(a, "hull"))))
    K = (mooring_stiffness(a, "hull") - mooring_stiffness(b, "hull")) / np.outer(scale, scale)
    assert np.abs(a.position - b.position).max() < tolerance * 340
    assert np.abs(K).max() < tolerance
    return a, b


@pytest.mark.parametrize("flipped", [False, True])
@pytest.mark.parametrize("friction", [0.0, 0.6])
def test_equal_segments_with_loads_of_no_weight_are_the_uniform_line(flipped, friction):
    def cut(a, b):
        ends = (b, a) if flipped else (a, b)
        loads = [(100.0, 0.0), (250.0, 0.0)]
        return [composite("L0", [(CHAIN, 100.0), (CHAIN, 150.0), (CHAIN, 75.0)], *ends, loads, bed_friction=friction)]

    def whole(a, b):
        return [UniformLine("L0", CHAIN, 325.0, *((b, a) if flipped else (a, b)), friction)]

    one, other = same_rest(three_legs(cut), three_legs(whole), 1e-10)
    for name in ("horizontal_a", "horizontal_b", "vertical_a", "vertical_b", "grounded_length", "utilisation"):
        value, expected = getattr(one.lines, name)[0], getattr(other.lines, name)[0]
        assert np.isclose(value, expected, rtol=1e-9, atol=1e-9 * np.abs(getattr(other.lines, name)).max()), name
    assert one.lines.status[0] == other.lines.status[0]
    drawn, fine = line_shapes(one, 200)[0], line_shapes(other, 5000)[0]
    away = [np.hypot(*(shape - shape[0])[:, :2].T) for shape in (drawn, fine)]
    assert np.abs(drawn[:, 2] - np.interp(*away, fine[:, 2])).max() < 1e-3


@pytest.mark.parametrize("z", [-4.0, 3.0])
def test_a_sinker_and_a_buoy_on_a_line_are_free_points_that_join_uniform_lines(z):
    """The joined lines come to rest by themselves; nothing between the free points lies on the bed."""
    mass, volume = 9e3, 30.0

    def one(a, b):
        loads = [(220.0, 2e4 * G), (260.0, (mass - RHO * volume) * G)]
        return [composite("L0", [(CHAIN, 220.0), (ROPE, 115.0)], a, b, loads)]

    def joined(a, b):
        return [
            UniformLine("chain", CHAIN, 220.0, a, "sinker"),
            UniformLine("rope", ROPE, 40.0, "sinker", "buoy"),
            UniformLine("upper rope", ROPE, 75.0, "buoy", b),
        ]

    joints = [FreePoint("sinker", (130.0, 30.0, -50.0), 2e4), FreePoint("buoy", (90.0, 20.0, -30.0), mass, volume)]
    on_line, apart = same_rest(three_legs(one, z=z), three_legs(joined, joints, z=z), 1e-7)
    assert on_line.lines.status[0] == State.GROUNDED
    places = apart.pose.free
    assert np.all(places[:, 2] > -59) and np.all(places[:, 2] < -3)
    assert np.allclose(loads_on_lines(on_line), places, atol=1e-5)
    # tension of each part over its own breaking load
    assert np.isclose(on_line.lines.utilisation[0], apart.lines.utilisation[:3].max(), rtol=1e-7)


def hung_between():
    """A line with a sinker between two bodies, and one between a body and a free buoy."""
    points = [
        Anchor("W", (-330.0, 20.0, -70.0)), Anchor("E", (330.0, 0.0, -70.0)), Anchor("N", (0.0, 240.0, -70.0)),
        Fairlead("west out", "west", (-20.0, 0.0, 0.0)), Fairlead("west in", "west", (20.0, 3.0, -2.0)),
        Fairlead("east out", "east", (20.0, 0.0, 0.0)), Fairlead("east in", "east", (-20.0, 0.0, 1.0)),
        Fairlead("north", "west", (0.0, 10.0, -1.0)), FreePoint("buoy", (-50.0, 90.0, -8.0), 1e3, 40.0),
    ]  # fmt: skip
    lines = [
        UniformLine("west", CHAIN, 275.0, "W", "west out"),
        UniformLine("east", CHAIN, 275.0, "east out", "E"),
        composite("between", [(ROPE, 30.0), (CHAIN, 15.0), (ROPE, 25.0)], "east in", "west in", [(37.0, 2e4)]),
        composite("chain of the buoy", [(ROPE, 20.0), (CHAIN, 170.0)], "buoy", "N", [(60.0, 5e3)]),
        composite("rope of the buoy", [(ROPE, 50.0), (CHAIN, 30.0)], "north", "buoy"),
    ]
    bodies = [MooredBody("west", (-50.0, 0, 0, 0, 0, 0)), MooredBody("east", (50.0, 0, 0, 0, 0, 0.05))]
    return System(70.0, lines, points, bodies)


@pytest.mark.parametrize("name", ["anchored", "between bodies"])
def test_stiffness_is_the_derivative_of_the_forces(name):
    def mixed(a, b):
        return [composite("L0", [(CHAIN, 220.0), (ROPE, 110.0)], b, a, [(60.0, -1e5), (130.0, 5e4)], bed_friction=0.4)]

    system = hung_between() if name == "between bodies" else three_legs(mixed)
    state = rest(system)
    bodies, K = 6 * len(system.bodies), state.stiffness
    scale = np.sqrt(np.abs(np.diag(K))) + 1.0
    for j in range(len(K)):
        h = 4e-5 if j < bodies and j % 6 > 2 else 2e-3
        forces = [
            system.total_load(moved(system, state.pose, np.eye(len(K))[j] * step)).force
            for step in (h, -h, 2 * h, -2 * h)
        ]
        column = -(8 * (forces[0] - forces[1]) - (forces[2] - forces[3])) / (12 * h)
        assert np.abs((column - K[:, j]) / scale / scale[j]).max() < 2e-6, j


def test_the_ends_of_a_line_of_segments_carry_what_of_its_weight_the_bed_does_not():
    state = rest(hung_between())
    assert np.abs(state.residual).max() < 1e-9 * state.tension.sum()
    for i, line in enumerate(state.system.lines):
        if isinstance(line, CompositeLine):
            weight = sum(s.weight * s.length for s in line.segments) + sum(load.weight for load in line.loads)
            lying = state.lines.grounded_length[i] * line.segments[-1].weight
            assert np.isclose(state.lines.vertical_a[i] + state.lines.vertical_b[i], weight - lying)


def test_losing_a_line_of_segments_is_losing_the_uniform_line_it_is():
    def cut(a, b):
        return [composite("L0", [(CHAIN, 100.0), (CHAIN, 225.0)], a, b)]

    losses = one_line_broken(rest(three_legs(cut)))
    others = one_line_broken(rest(three_legs(lambda a, b: [UniformLine("L0", CHAIN, 325.0, a, b)])))
    for name, left in losses.items():
        assert np.allclose(left.position, others[name].position, atol=1e-6)


def test_a_bed_of_its_own_lies_under_a_line_whichever_way_it_swings():
    bed = Bed([[0.0, 0.0], [60.0, -4.0], [200.0, 3.0], [600.0, 3.0]], 0.2)

    def first(a, b):
        return [composite("L0", [(CHAIN, 325.0)], a, b, bed=bed)]

    system = three_legs(first)
    one = system.composites[0]
    for x, y in ((0.0, 0.0), (-3.0, 5.0)):
        state = rest(held_at(system, {"hull": (x, y, 0, 0, 0, 0)}))
        A, B = state.points[system.arrays.ends[0]]
        alone = one.line.solve(np.hypot(*(B - A)[:2]), B[2] - A[2])
        pull = np.hypot(state.lines.horizontal_b[0], state.lines.vertical_b[0])
        assert np.isclose(pull, alone.tension_fairlead, rtol=1e-12)


@pytest.mark.parametrize("friction", [0.2, 0.4])
def test_a_slack_line_on_a_bed_that_falls_more_steeply_than_its_friction_holds_is_named(friction):
    def first(a, b):
        bed = Bed([[0.0, 0.0], [300.0, -90.0], [600.0, -90.0]], friction)
        return [composite("L0", [(CHAIN, 620.0)], a, b, bed=bed, bed_friction=friction)]

    system = held_at(three_legs(first, z=40.0), {"hull": (0, 0, 0, 0, 0, 0)})
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        rest(system)
    assert any("that is too steep for its friction: L0;" in str(text.message) for text in said) == (friction < 0.3)


def test_a_floating_buoy_holds_a_fairlead_above_the_water_as_one_as_far_below():
    """Between the buoy, in the surface, and the fairlead the line hangs as its mirror image: V + V' is its weight"""
    upper = Segment(30.0, 4000.0, 2e9)
    line = StaticLine((Segment(200.0, 4000.0, 2e9), upper), (PointLoad(200.0, -1e6, 1.5e5),), Bed.sloping(), 20.0)
    above, below = line.solve(226.0, 23.0), line.solve(226.0, 17.0)
    assert above.at(np.array([200.0]))[0, 1] == pytest.approx(20.0, abs=1e-9)
    assert above.horizontal_fairlead == pytest.approx(below.horizontal_fairlead, rel=1e-9)
    assert above.vertical_fairlead + below.vertical_fairlead == pytest.approx(30.0 * 4000.0, rel=1e-9)


def test_a_line_too_short_for_its_ends_is_marked():
    stiff = three_legs(lambda a, b: [composite("x", [(replace(CHAIN, axial_stiffness=np.inf), 320.0)], a, b)])
    starts, ends = stiff.load().points[stiff.arrays.ends].swapaxes(0, 1).copy()
    far = starts[0] + [400.0, 0.0, 60.0]
    found = stiff.forces_between(starts, np.concatenate([far[None], ends[1:]]))
    assert found.status[0] == State.BEYOND_REACH and np.isinf(found.tension_b[0]) and np.isinf(found.utilisation[0])
    assert np.all(np.isfinite(found.tension_b[1:]))


FAULTS = [
    (lambda a, b: [composite("x", [(CHAIN, 300.0)], "A1", "A0")], LineSystemError, "both ends on the bed"),
    (lambda a, b: [composite("x", [(CHAIN, 100.0)], "F1", b, bed=Bed.sloping())], LineSystemError, "no anchor"),
    (lambda a, b: [composite("x", [(CHAIN, 300.0)], a, b, [(400.0, 1.0)])], LineSystemError, "below 300 m"),
    (lambda a, b: [composite("x", [(CHAIN, 200.0)], "F1", b)], LineSystemError, "m below the bed"),
    (
        lambda a, b: [composite("x", [(ROPE, 60.0)], "F1", b, [(30.0, -3e5)])],
        LineSystemError,
        "buoy .* above the water",
    ),
    (
        lambda a, b: [composite("x", [(replace(CHAIN, axial_stiffness=np.inf), 200.0)], a, b)],
        EquilibriumError,
        "line x, .* cannot be reached",
    ),
]


@pytest.mark.parametrize(("first", "error", "message"), FAULTS)
def test_a_line_that_cannot_be_is_refused_in_one_line(first, error, message):
    with pytest.raises(error, match=message) as caught:
        rest(three_legs(first))
    assert "\n" not in str(caught.value)
