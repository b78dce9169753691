"""Systems of lines: equilibrium, supports, loss of a line, friction, natural periods and faults."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mooring_systems import CHAIN, OC3, ROPE, SYSTEMS, eight_lines

from hakobune.bem import DOFS
from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader
from hakobune.mooring.lines.system.bodies import angles, axes_in_space, places_along, rotated, rotation
from hakobune.mooring.lines.system.equilibrium import _Indefinite, rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.hydrostatics import heading, hydrostatic_load
from hakobune.mooring.lines.system.parts import (
    Anchor,
    EquilibriumError,
    Fairlead,
    FreePoint,
    LineSystemError,
    LineType,
    MooredBody,
    UniformLine,
)
from hakobune.mooring.lines.system.shapes import line_shapes
from hakobune.mooring.studies.natural_periods import moored_periods
from hakobune.mooring.studies.system_at_rest import (
    mooring_stiffness,
    one_line_broken,
)

ROOT = Path(__file__).parents[3]


def test_a_step_without_a_force_is_none_where_a_stiffness_is_none():
    with np.errstate(all="raise"):
        stays = _Indefinite(np.diag([1.0, -1.0, 0.0]), np.zeros(3), np.ones(3), np.ones(3, bool)).within(1.0)
    assert np.array_equal(stays, np.zeros(3))


def test_a_sinker_too_light_is_lifted_and_one_too_heavy_rests_on_the_bed():
    def chain_with(mass, ship):
        return System(
            50.0,
            [
                UniformLine("ground", CHAIN, 100.0, "anchor", "sinker"),
                UniformLine("riser", CHAIN, 70.0, "sinker", "ship"),
            ],
            [
                Anchor("anchor", (0.0, 0.0, -50.0)),
                FreePoint("sinker", (100.0, 0.0, -49.0), mass=mass),
                Fairlead("ship", "ship", (0.0, 0.0, 0.0)),
            ],
            [MooredBody("ship", (ship, 0, 0, 0, 0, 0), freedom=())],
        )

    light, heavy = rest(chain_with(1e3, 158.0)), rest(chain_with(2e5, 145.0))
    assert not light.on_bed[0] and light.pose.free[0, 2] > -50.0 and light.bed_reaction[0] == 0
    assert heavy.on_bed[0] and heavy.pose.free[0, 2] == -50.0
    weight, pulled = 2e5 * 9.80665, -heavy.lines.vertical_a[1]
    assert heavy.bed_reaction[0] == pytest.approx(weight - pulled, rel=1e-9) and pulled > 0
    assert heavy.lines.horizontal_b[0] == pytest.approx(heavy.lines.horizontal_a[1], rel=1e-9)


def test_a_buoy_floats_where_its_volume_carries_its_weight_and_its_chain():
    mooring = System(
        40.0,
        [UniformLine("chain", CHAIN, 45.0, "anchor", "buoy")],
        [Anchor("anchor", (0.0, 0.0, -40.0)), FreePoint("buoy", (1.0, 0.0, 0.0), mass=2e3, volume=20.0, height=2.0)],
    )
    found = rest(mooring)
    z = found.pose.free[0, 2]
    under = 20.0 * (0.5 - z / 2.0) * 1025 * 9.80665
    assert -1 < z < 1
    assert under == pytest.approx(2e3 * 9.80665 + found.lines.vertical_b[0], rel=1e-9)
    assert 40 + z == pytest.approx(
        found.lines.vertical_b[0] / 1000 + found.lines.vertical_b[0] ** 2 / 2000 / 5e8, rel=1e-9
    )


def test_a_deep_buoy_on_a_short_chain_stays_under_water():
    mooring = System(
        40.0,
        [UniformLine("chain", CHAIN, 25.0, "anchor", "buoy")],
        [Anchor("anchor", (0.0, 0.0, -40.0)), FreePoint("buoy", (3.0, 0.0, -20.0), mass=2e3, volume=20.0)],
    )
    found = rest(mooring)
    assert np.allclose(found.pose.free[0, :2], 0, atol=1e-6)
    net = 20.0 * 1025 * 9.80665 - 2e3 * 9.80665
    assert found.lines.vertical_b[0] == pytest.approx(net, rel=1e-10)
    # stretched by its own weight and by what is left of the buoyancy below it
    assert found.pose.free[0, 2] == pytest.approx(-40 + 25 * (1 + (net - 0.5 * 25e3) / 5e8), abs=1e-8)


def test_every_line_can_break_and_the_rest_holds():
    state = rest(SYSTEMS["eight lines"])
    broken = one_line_broken(state)
    assert list(broken) == state.system.line_names
    for name, left in broken.items():
        assert len(left.system.lines) == 7 and name not in left.system.line_names
        assert np.abs(left.residual).max() < 1e-9 * left.tension.sum()
        # the system gives way to where the lost line did not pull
        lost = state.system.line_names.index(name)
        anchor, fairlead = state.points[state.system.arrays[4][lost]]
        pull = (anchor - fairlead) * [1, 1, 0] / np.hypot(*(anchor - fairlead)[:2]) * state.lines.horizontal_b[lost]
        pull[2] = -state.lines.vertical_b[lost]
        arm = fairlead - state.pose.place[0]
        given = left.position[0] - state.position[0]
        assert given[:3] @ pull + given[5] * np.cross(arm, pull)[2] < 0


def test_the_loss_of_a_line_takes_what_hangs_loose_with_it():
    left = SYSTEMS["bridle"].without("chain")
    assert {line.name for line in left.lines} == {"port", "starboard", "stern"}
    left = SYSTEMS["two bodies"].without("down")
    assert "guy" not in left.line_names and all(p.name != "sinker" for p in left.points)


def test_no_line_left_to_hold_a_load_is_an_error_that_names_what_is_left():
    hawser = System(
        20.0,
        [UniformLine("bow", ROPE, 30.0, "pile", "bow")],
        [Anchor("pile", (0.0, 0.0, 2.0)), Fairlead("bow", "ship", (0.0, 0.0, 1.0))],
        [MooredBody("ship", (20.0, 0, 0, 0, 0, 0), freedom=("Surge",), load=(-1e30, 0, 0, 0, 0, 0))],
    )
    with pytest.raises(EquilibriumError, match="ship surge"):
        rest(hawser, steps=5)


def test_rotations_compose_and_come_back():
    rng = np.random.default_rng(2)
    for roll, pitch, yaw in rng.uniform(-1.2, 1.2, (20, 3)):
        R = rotation(roll, pitch, yaw)
        assert np.allclose(R @ R.T, np.eye(3)) and np.linalg.det(R) == pytest.approx(1)
        assert np.allclose(angles(R), (roll, pitch, yaw))
        assert np.allclose(rotated(rotated(R, np.array([0, 0, 0.7])), np.array([0, 0, -0.7])), R)
    assert np.allclose(rotated(np.eye(3), np.array([0.0, 0.0, 1.1])), rotation(0, 0, 1.1))
    assert heading(rotation(0.0, 0.0, 2.5)) == pytest.approx(2.5)


def test_hydrostatics_turn_with_the_heading_and_their_stiffness_is_exact():
    C = np.zeros((6, 6))
    C[2:5, 2:5] = [[3e7, 1e6, 1e7], [1e6, 5e9, 2e8], [1e7, 2e8, 3e10]]
    R = rotated(rotation(0, 0, 2.0), np.array([0.05, -0.08, 0.0]))
    force, K = hydrostatic_load(C, 0.7, R)
    for j in range(6):
        h, columns = 1e-4, []
        for s in (1, -1, 2, -2):
            step = np.zeros(6)
            step[j] = s * h
            columns.append(hydrostatic_load(C, 0.7 + step[2], rotated(R, step[3:]))[0])
        difference = -(8 * (columns[0] - columns[1]) - (columns[2] - columns[3])) / (12 * h)
        assert np.abs(difference - K[:, j]).max() < 1e-8 * np.abs(K).max()
    turn = np.kron(np.eye(2), rotation(0, 0, 2.0))
    upright, _ = hydrostatic_load(C, 0.7, rotated(np.eye(3), rotation(0, 0, -2.0) @ np.array([0.05, -0.08, 0.0])))
    assert np.allclose(force, turn @ upright)


WRONG = [
    (lambda: UniformLine("x", CHAIN, -3.0, "a", "b"), "line x: length is -3; allowed: finite, above 0 m"),
    (lambda: LineType("t", 0.0), "line type t: weight is 0; allowed: finite, not 0 N/m"),
    (lambda: MooredBody("b", freedom=("Jump",)), "body b: freedom 'Jump' is unknown"),
    (lambda: FreePoint("p", (0, 0, 0), mass=-1.0), "point p: mass is -1; allowed: finite, at least 0 kg"),
    (lambda: replace(OC3, depth=0.0), "depth is 0 m; allowed: above 0, finite"),
    (lambda: replace(OC3, lines=()), "the system has no lines"),
    (lambda: replace(OC3, bodies=()), "body 'platform' is unknown; allowed: none"),
    (lambda: replace(OC3, depth=100.0), "allowed: at or above the bed, -100 m"),
    (
        lambda: replace(OC3, lines=[replace(OC3.lines[0], a="nowhere")]),
        "its end 'nowhere' is not a point of the system",
    ),
    (lambda: OC3.without("L9"), "line 'L9' is unknown; allowed: L0, L1, L2"),
    (lambda: OC3.with_loads({"hull": (0,) * 6}), "body 'hull' is unknown; allowed: platform"),
    (lambda: mooring_stiffness(rest(SYSTEMS["bridle"]), "ship"), "body 'ship' is unknown; allowed: barge"),
]


@pytest.mark.parametrize(("make", "message"), WRONG)
def test_what_cannot_be_is_named_in_one_line(make, message):
    with pytest.raises(LineSystemError) as fault:
        make()
    assert message in str(fault.value) and "\n" not in str(fault.value)


def test_an_inextensible_line_that_cannot_reach_is_named():
    lines = [replace(line, type=LineType("stiff", 700.0)) for line in OC3.lines]
    with pytest.raises(EquilibriumError, match="line L0, inextensible"):
        rest(replace(OC3, lines=tuple(lines), bodies=(replace(OC3.bodies[0], position=(500.0, 0, 0, 0, 0, 0)),)))


@pytest.mark.parametrize("name", SYSTEMS)
def test_shapes_of_lines_join_their_points_and_stay_above_the_bed(name):
    state = rest(SYSTEMS[name])
    for ends, line, shape in zip(state.system.arrays[4], state.system.lines, line_shapes(state), strict=True):
        assert np.allclose(shape[[0, -1]], state.points[ends], atol=1e-8 * line.length)
        assert shape[:, 2].min() > -state.system.depth - 1e-8 * line.length
        steps = np.linalg.norm(np.diff(shape, axis=0), axis=1).sum()
        assert steps < line.length * (1 + state.tension.max() / line.type.axial_stiffness) * (1 + 1e-9)


def test_a_light_line_that_would_float_is_warned_of():
    light = LineType("light", -40.0, 5e6)
    hung = System(
        50.0, [UniformLine("x", light, 90.0, "a", "b")], [Anchor("a", (0, 0, -2.0)), Anchor("b", (80.0, 0, -2.0))]
    )
    with pytest.warns(UserWarning, match="line x floats and its middle would be .* m above the water"):
        rest(hung)


def ground_chain(friction, flipped=False):
    """A ship on two chains; flipped: the lines named from the ship to the anchor"""
    ends = [("A1", "bow"), ("A2", "stern")]
    lines = [
        UniformLine(f"L{i}", CHAIN, 240.0, *(pair[::-1] if flipped else pair), friction) for i, pair in enumerate(ends)
    ]
    return System(
        40.0,
        lines,
        [
            Anchor("A1", (270.0, 0.0, -40.0)),
            Anchor("A2", (-270.0, 0.0, -40.0)),
            Fairlead("bow", "ship", (50.0, 0.0, 0.0)),
            Fairlead("stern", "ship", (-50.0, 0.0, 0.0)),
        ],
        [MooredBody("ship", load=(2e5, 0, 0, 0, 0, 0))],
    )


def test_friction_takes_tension_from_the_fairlead_to_the_anchor_whichever_end_is_named_first():
    one, other = rest(ground_chain(0.4)), rest(ground_chain(0.4, flipped=True))
    assert np.allclose(one.position, other.position, atol=1e-9)
    lost = one.lines.horizontal_b - one.lines.horizontal_a
    assert np.allclose(lost, np.minimum(0.4 * 1000 * one.lines.grounded_length, one.lines.horizontal_b))
    assert np.allclose(other.lines.horizontal_a - other.lines.horizontal_b, lost) and lost.min() > 0


def test_friction_between_free_points_is_not_counted_and_that_is_said():
    leg = System(
        50.0,
        [
            UniformLine("ground", CHAIN, 100.0, "anchor", "sinker", 0.5),
            UniformLine("riser", CHAIN, 120.0, "sinker", "ship", 0.5),
        ],
        [
            Anchor("anchor", (0.0, 0.0, -50.0)),
            FreePoint("sinker", (100.0, 0.0, -50.0), mass=1e5),
            Fairlead("ship", "ship", (0.0, 0.0, 0.0)),
        ],
        [MooredBody("ship", (200.0, 0, 0, 0, 0, 0), freedom=())],
    )
    with pytest.warns(UserWarning, match="bed friction is not included on riser"):
        assert rest(leg).lines.grounded_length[1] > 1.0


@pytest.mark.parametrize("seed", range(6))
def test_legs_of_many_pieces_come_to_rest_from_a_rough_start(seed):
    """Joints, sinkers and buoys strewn about the straight line from anchor to fairlead."""
    rng = np.random.default_rng(seed)
    depth, points, lines = rng.uniform(30, 300), [], []
    for i in range(rng.integers(3, 5)):
        angle, radius = 2 * np.pi * i / 4 + rng.uniform(-0.3, 0.3), depth * rng.uniform(1.2, 6)
        start = np.array([radius * np.cos(angle), radius * np.sin(angle), -depth])
        end = np.array([20 * np.cos(angle), 20 * np.sin(angle), -3.0])
        points += [Anchor(f"A{i}", tuple(start)), Fairlead(f"F{i}", "hull", tuple(end))]
        pieces, names = rng.integers(1, 5), [f"A{i}"]
        for j in range(1, pieces):
            place = start + (end - start) * j / pieces + rng.normal(size=3) * 4
            place[2] = max(place[2], -depth + 0.5)
            mass, volume = [(0.0, 0.0), (rng.uniform(1e3, 3e4), 0.0), (500.0, rng.uniform(2, 15))][rng.integers(0, 3)]
            points.append(FreePoint(f"P{i}{j}", tuple(place), mass, volume))
            names.append(f"P{i}{j}")
        names.append(f"F{i}")
        length = np.linalg.norm(end - start) * rng.uniform(1.0, 1.15) / pieces
        for j in range(pieces):
            kind = LineType(f"T{i}{j}", 10 ** rng.uniform(1.5, 3.7), 10 ** rng.uniform(7, 9.3))
            lines.append(UniformLine(f"L{i}{j}", kind, length, names[j], names[j + 1]))
    state = rest(System(depth, lines, points, [MooredBody("hull", load=(*rng.normal(size=2) * 2e5, 0, 0, 0, 1e5))]))
    assert np.abs(state.residual).max() < 1e-8 * state.tension.sum()
    assert np.all(state.pose.free[:, 2] >= -depth) and np.all(state.bed_reaction >= 0)


class SmallDatabase:
    """Just enough of an opened database: constant added mass."""

    rotation_center = (0.0, 0.0, 0.0)

    @property
    def reader(self):
        added = np.broadcast_to(np.diag([2e6, 1e7, 3e7, 3e9, 1e10, 1e10]), (4, 6, 6))
        omega, plan = np.array([0.1, 1.0, 2.0, 3.0]), np.array([[50.0, 10.0], [-50.0, -10.0]])
        between = Between(omega, {"added_mass": added}, 50.0, 9.80665, np.zeros(1), np.zeros(1), plan)
        inertia = np.diag([3e7, 3e7, 3e7, 1e10, 3e10, 3e10])
        stiffness = np.diag([0.0, 0.0, 4e7, 6e9, 3e10, 0.0])
        return Reader(between, 1025.0, np.zeros(3), inertia, stiffness, np.zeros((6, 6)))


def test_natural_periods_are_those_of_the_stiffness_in_the_axes_of_the_body():
    """A system rotated as a whole about the vertical has the same periods."""
    system, db = eight_lines(load=(0.0,) * 6), SmallDatabase()
    periods = moored_periods(rest(system), "ship", db)
    angle = 0.8
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    points = [replace(p, position=tuple(R @ p.position)) if isinstance(p, Anchor) else p for p in system.points]
    turned_body = replace(system.bodies[0], position=(0, 0, 0, 0, 0, angle))
    again = moored_periods(rest(replace(system, points=tuple(points), bodies=(turned_body,))), "ship", db)
    assert np.allclose(again.period, periods.period, rtol=1e-7)
    K = mooring_stiffness(rest(system), "ship")
    single = 2 * np.pi * np.sqrt((3e7 + 3e7) / (4e7 + K[2, 2]))
    assert periods.period[2] == pytest.approx(single, rel=1e-3)


def test_systems_and_files_load_no_compiler_before_something_is_solved():
    names = "studies.system_at_rest", "lines.catalogue", "formats.moorpy"
    modules = ", ".join(f"hakobune.mooring.{name}" for name in names)
    code = f"import sys, {modules}; print('numba' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.strip() == "False"


def test_a_body_hung_at_its_center_turns_freely_and_passes_on_what_a_point_of_its_weight_does():
    def stiffness(joint, *bodies):
        hull = MooredBody("hull", position=(300.0, 0, 0, 0, 0, 0), freedom=())
        points = Anchor("A", (0.0, 0.0, -80.0)), joint, Fairlead("F", "hull", (0.0, 0.0, 0.0))
        parts = UniformLine("low", CHAIN, 160.0, "A", "J"), UniformLine("high", ROPE, 160.0, "J", "F")
        return mooring_stiffness(rest(System(80.0, parts, points, (hull, *bodies))), "hull")

    place, weight = (150.0, 0.0, -60.0), 5e3
    body = MooredBody("clump", position=(*place, 0, 0, 0), freedom=DOFS, load=(0, 0, -weight, 0, 0, 0))
    K = stiffness(Fairlead("J", "clump", (0.0, 0.0, 0.0)), body)
    expected = stiffness(FreePoint("J", place, mass=weight / 9.80665))
    assert np.abs(K - expected).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("skew", [0.0, 0.2])
def test_a_step_solves_the_stiffness_or_is_as_long_as_allowed(skew):
    """(K + m) s = r with m = 0 where that is short enough; a matrix that gives way is refused."""
    from hakobune.mooring.lines.system.steps import FOUND, INDEFINITE, step_within

    rng, n = np.random.default_rng(4), 9
    band = np.tril(rng.normal(size=(n, n))) * (np.abs(np.subtract.outer(range(n), range(n))) < 3)
    K = band @ band.T + 0.1 * np.eye(n) + skew * (band - band.T)
    unit, moving, r, step = rng.uniform(0.5, 2, n), np.arange(n) != 5, rng.normal(size=n), np.ones(n)
    inner = (K / np.outer(unit, unit))[np.ix_(moving, moving)]
    newton = np.linalg.solve(inner, r[moving])
    assert step_within(K, r, unit, moving, 1e9, step) == FOUND
    assert np.allclose(step[moving], newton) and step[5] == 0
    radius = 0.1 * np.linalg.norm(newton)
    assert step_within(K, r, unit, moving, radius, step) == FOUND
    assert radius <= np.linalg.norm(step) <= 1.02 * radius
    raised = r[moving] - 0.5 * (inner + inner.T) @ step[moving]
    assert np.allclose(raised / step[moving], (raised @ step[moving]) / (step @ step), rtol=1e-8)  # m s
    assert step_within(K - 2 * np.trace(K) * np.eye(n), r, unit, moving, radius, step) == INDEFINITE


@pytest.mark.parametrize("name", SYSTEMS)
def test_a_system_that_is_at_rest_takes_no_step_and_others_few(name):
    """Newton's steps at least halve what is left once they are near: to 1e-12 of it in some tens of them"""
    found = rest(SYSTEMS[name])
    assert 0 < found.iterations < 60 and rest(SYSTEMS[name], found.pose).iterations <= 1


def test_axes_of_bodies_are_turned_by_the_heading_of_each():
    """Forces and moments of the first by 0.3, of the second by −1.1; places leave roll and pitch along the body"""
    whole, places = axes_in_space((0.3, -1.1)), places_along((0.3, -1.1))
    wanted, along = np.zeros((12, 12)), np.zeros((12, 12))
    for i, psi in enumerate((0.3, -1.1)):
        c, s = np.cos(psi), np.sin(psi)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        for j in (0, 3):
            first = 6 * i + j
            wanted[first : first + 3, first : first + 3] = turn
            along[first : first + 3, first : first + 3] = turn if j == 0 else np.eye(3)
    assert whole == pytest.approx(wanted) and places == pytest.approx(along)
