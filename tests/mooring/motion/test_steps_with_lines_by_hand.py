"""Kernels of a step beside lines that move, as plain Python: what a wrong course costs, ends, samples, contacts."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

integrator, line_loads = plain("mooring.motion.integrator"), plain("mooring.motion.line_loads")
contact_loads, stage = plain("mooring.motion.contact_loads"), plain("mooring.lines.dynamics.lumped.stage")
surroundings, steps = plain("mooring.lines.dynamics.lumped.surroundings"), plain("mooring.lines.system.steps")
buoys, links, equation = (plain(f"mooring.motion.{name}") for name in ("buoy", "links", "equation"))
BLOCK = integrator.BLOCK

# ------------------------------------------------------------------ a wrong course


class Course:
    """One line of spring k along its stretch on each of two bodies; masses of 4 kg, coupled or not"""

    def __init__(
        self, off, speed, number=(1,), heading=0.0, whole=True, given=(3.0, 4.0, 0.0), stretch=(1.0, 0, 0, 0, 0, 0),
        coupled=0.0,
    ):  # fmt: skip
        inverse = np.eye(12) / 4.0
        inverse[0, 6] = inverse[6, 0] = coupled
        work = SimpleNamespace(whole=np.array([True, whole]), given=np.array([[(9.0, 9, 9)], [given]]))
        shapes = SimpleNamespace(place=np.zeros(0, int))
        body = SimpleNamespace(mass_inverse=inverse, heading=np.array([0.0, heading]), shapes=shapes)
        self.scene = SimpleNamespace(line_work=work, lines=SimpleNamespace(body=np.array([0, 1])), body=body)
        trial = np.zeros(2 * BLOCK)
        foreseen = np.zeros((2, 12))
        foreseen[1] = 7.0
        trial[BLOCK : BLOCK + 6] = 7.0 + np.array(off)
        trial[BLOCK + 6 : BLOCK + 12] = 7.0 + np.array(speed)
        self.clock = SimpleNamespace(trial=trial, scale=np.full((2, 12), 1e-3))
        self.clock.scale[0], self.clock.scale[1, 6:] = 1e-1, 1e-2
        count, way = len(number), np.array(stretch, float)
        lines = SimpleNamespace(number=np.array(number), spring=np.full(count, 50.0), tolerance=0.01,
                                stretch=np.tile(way, (count, 1)), tension=np.full(count, 2.0))  # fmt: skip
        kept = SimpleNamespace(push=np.zeros(12), foreseen=foreseen, room=SimpleNamespace(push=np.zeros(6)))
        self.moving = lines, kept

    def __call__(self, h=0.6):
        return integrator.missed_course(self.scene, self.clock, self.moving, h)


NONE = np.zeros(6)


@pytest.mark.parametrize("given, tension", [((3.0, 4.0, 0.0), 5.0), ((0.0, 0.0, 1.0), 2.0), ((2.0, 3.0, 6.0), 7.0)])
def test_a_pull_is_wrong_by_what_the_place_missed_stretches_over_its_tension(given, tension):
    """k x = 50 · 1e-4 N of the larger of the tension now and that of the line, over a tolerance of 1 %"""
    off = NONE.copy()
    off[0] = -1e-4
    assert Course(off, NONE, given=given)(1e-9) == pytest.approx(5e-3 / (0.01 * tension))


def test_a_place_missed_moves_the_body_by_its_acceleration_over_a_step():
    """h/12 k x/m over the scale of the place: 0.6/12 · 50 · 0.1/4 over 1e-3"""
    off = NONE.copy()
    off[0] = 0.1
    made = Course(off, NONE, given=(0.0, 0.0, 1e9))
    assert made() == pytest.approx(0.6 / 12 * 50 * 0.1 / 4 / 1e-3)
    made.moving[0].spring[:] = 100.0
    assert made(0.3) == pytest.approx(0.3 / 12 * 100 * 0.1 / 4 / 1e-3)


def test_a_velocity_missed_changes_that_of_the_body_twice_as_much():
    """h/6 k v/m over the scale of the velocity"""
    speed = NONE.copy()
    speed[0] = 0.1
    assert Course(NONE, speed, given=(0.0, 0.0, 1e9))() == pytest.approx(0.6 / 6 * 50 * 0.1 / 4 / 1e-2)


def test_a_coupled_body_is_moved_too_by_its_own_scale():
    """1/M₀₆ = 2: h/12 · 2 k x over 1e-1 of the other, beside 1/4 over 1e-3 of its own"""
    off = NONE.copy()
    off[0] = 0.1
    found = Course(off, NONE, given=(0.0, 0.0, 1e9), coupled=200.0)()
    assert found == pytest.approx(0.6 / 12 * 200 * 50 * 0.1 / 1e-1)


def test_places_in_space_are_missed_along_the_axes_at_rest_and_velocities_as_they_are():
    """At 90° a metre along y is one ahead"""
    off = NONE.copy()
    off[1] = 0.1
    straight, turned = (Course(off, NONE, heading=angle, given=(0.0, 0.0, 1e9))() for angle in (0.0, math.pi / 2))
    assert straight == 0.0 and turned == pytest.approx(0.6 / 12 * 50 * 0.1 / 4 / 1e-3)
    off[:2] = 0.1, 0.0
    side = Course(off, NONE, heading=math.pi / 2, given=(0.0, 0.0, 1e9), stretch=(0, 1.0, 0, 0, 0, 0))
    assert side() == pytest.approx(0.6 / 12 * 50 * 0.1 / 4 / 1e-3)
    speed = NONE.copy()
    speed[1] = 0.1
    assert Course(NONE, speed, heading=math.pi / 2, given=(0.0, 0.0, 1e9))() == 0.0


def test_lines_that_are_lost_miss_nothing_and_others_add_up():
    off = NONE.copy()
    off[0] = 0.1
    assert Course(off, NONE, whole=False)() == 0.0
    assert Course(off, NONE, number=(1, 1), given=(0.0, 0.0, 1e9))() == pytest.approx(
        2 * 0.6 / 12 * 50 * 0.1 / 4 / 1e-3
    )


# ------------------------------------------------------------------ ends, samples


def test_a_fairlead_moves_with_its_body_and_turns_about_its_centre():
    """Heading ψ alone: place r + R p, velocity R (u, v) + ṙ × …, as a difference of places over 2 µs"""
    p = np.array([20.0, -5.0, 3.0])
    lines = SimpleNamespace(
        fairlead=np.array([p]), body=np.array([1]), place=np.array([[0.0, 0, 0], [100.0, 50.0, -2.0]])
    )
    room = SimpleNamespace(R=np.zeros((3, 3)), arm=np.zeros(3), unit=np.zeros(3), push=np.zeros(6))

    def at(t):
        """Surge ahead at 2 m/s and sway at 1 m/s along the heading 0.5 + 0.1 t, heave at 0.3 m/s"""
        psi = 0.5 + 0.1 * t
        c, s = math.cos(psi), math.sin(psi)
        state = np.zeros(12)
        state[:6] = (
            7.0 + (2 * math.cos(0.5) - math.sin(0.5)) * t,
            8.0 + (2 * math.sin(0.5) + math.cos(0.5)) * t,
            0.3 * t,
            0,
            0,
            psi,
        )
        state[6:] = 2.0, 1.0, 0.3, 0.0, 0.0, 0.1
        place, velocity = np.zeros(3), np.zeros(3)
        line_loads.fairlead_of(lines, 0, state, np.zeros((2, 0)), room, place, velocity)
        wanted = [100 + state[0] + c * p[0] - s * p[1], 50 + state[1] + s * p[0] + c * p[1], -2 + state[2] + p[2]]
        assert place == pytest.approx(wanted)
        return place, velocity

    (before, _), (_, velocity), (after, _) = at(-1e-6), at(0.0), at(1e-6)
    assert velocity == pytest.approx((after - before) / 2e-6, rel=1e-6)


@pytest.mark.parametrize("s", [0.0, 0.25, 0.7, 1.0])
def test_samples_of_a_buoy_and_of_shapes_are_cubics_through_values_and_rates(s):
    """1 − 2t + 3t² − t³ from t = 10 to 12, exactly"""
    value = lambda t: 1 - 2 * (t - 10) + 3 * (t - 10) ** 2 - (t - 10) ** 3  # noqa: E731
    rate = lambda t: -2 + 6 * (t - 10) - 3 * (t - 10) ** 2  # noqa: E731
    size = BLOCK + 6 + 12
    clock = SimpleNamespace(y=np.full(size, value(10.0)), trial=np.full(size, value(12.0)), scale=np.zeros((1, 12)),
                            stages=np.full((7, size), np.nan))  # fmt: skip
    clock.stages[0], clock.stages[6] = rate(10.0), rate(12.0)
    for put, first, count in ((integrator.put_buoy, BLOCK, 6), (integrator.put_shapes, BLOCK + 6, 12)):
        clock.y[first + 1] += 5.0
        clock.trial[first + 1] += 5.0
        out = np.zeros(count)
        put(clock, 10.0, 2.0, 10.0 + 2.0 * s, out)
        wanted = np.full(count, value(10.0 + 2.0 * s))
        wanted[1] += 5.0
        assert out == pytest.approx(wanted)


@pytest.mark.parametrize("t, after", [(0.0, 3.0), (3.0, 8.0), (2.999, 3.0), (9.0, math.inf)])
def test_the_next_line_to_break_is_the_first_after_now(t, after):
    assert integrator.next_break(SimpleNamespace(lost=np.array([8.0, np.inf, 3.0, -1.0])), t) == after


def test_contacts_along_a_run_are_those_of_each_of_its_places(monkeypatch):
    """Depths and forces of two fenders at three places; shapes as they are bent there"""
    seen = []

    def loads(contacts, work, positions, R, v, f):
        seen.append((positions.tolist(), work.bent.tolist()))
        work.now[:, contact_loads.DEPTH] = positions[0, 0] + np.arange(2)
        work.now[:, contact_loads.FORCE] = 10 * positions[0, 0] + np.arange(2)

    monkeypatch.setattr(contact_loads, "contact_loads", loads)
    monkeypatch.setattr(contact_loads, "settle", lambda work: seen.append("settled"))
    work = SimpleNamespace(bent=np.zeros(2), now=np.zeros((2, 9)))
    positions, bent = np.arange(3.0).reshape(3, 1, 1), np.arange(6.0).reshape(3, 2)
    contacts = SimpleNamespace(numbers=np.zeros((2, 3)))
    depth, force = np.zeros((3, 2)), np.zeros((3, 2))
    contact_loads.contacts_along(contacts, work, positions, None, None, None, depth, force, bent)
    assert depth.tolist() == [[0, 1], [1, 2], [2, 3]] and force.tolist() == [[0, 1], [10, 11], [20, 21]]
    assert seen[::2] == [([[k]], bent[k].tolist()) for k in range(3)] and seen[1::2] == ["settled"] * 3
    contact_loads.contacts_along(contacts, work, positions, None, None, None, depth, force)
    assert seen[-2][1] == [4.0, 5.0]  # as they were


# ------------------------------------------------------------------ lines


@pytest.mark.parametrize("change, worst", [
    ([9.0, 1, 5, 2], 1), ([0.0, 7, 5, 2], 0), ([0.0, 1, 5, 8], 2), ([0.0, 1, np.nan, 8], 1), ([0.0, 3, 3, 3], 0),
])  # fmt: skip
def test_the_worst_element_is_that_whose_tension_changes_most_or_is_no_number(change, worst):
    """Element e at place e + 1; of several that are no number the last"""
    work = SimpleNamespace(change=np.array(change, float))
    found = stage.worst_element(work, 3)
    assert found == worst or (np.isnan(change).any() and found >= worst)


@pytest.mark.parametrize("z, speed", [(-60.0, 0.2), (-50.0, 0.2), (-40.0, 0.4), (-30.0, 0.6), (-15.0, 0.9), (0.0, 1.2),
                                      (5.0, 1.2)])  # fmt: skip
def test_a_current_is_straight_between_its_levels_and_constant_beyond(z, speed):
    """0.2 m/s at −50 m, 0.6 at −30 m and 1.2 at the surface, which holds above it too; the ramp and its rate"""
    water = SimpleNamespace(level=np.array([-50.0, -30.0, 0.0]),
                            current=np.array([[0.2, -2.0], [0.6, -6.0], [1.2, -12.0]]))  # fmt: skip
    q, u, du = np.zeros((3, 8)), np.ones((3, 8)), np.ones((3, 8))
    q[2] = z
    surroundings.add_current(water, q, 2, 0.5, 0.25, u, du)
    assert u[:, :2] == pytest.approx(np.tile([[1 + 0.5 * speed], [1 - 5 * speed], [1.0]], 2))
    assert du[:, :2] == pytest.approx(np.tile([[1 + 0.25 * speed], [1 - 2.5 * speed], [1.0]], 2))
    assert np.all(u[:, 2:] == 1.0)


# ------------------------------------------------------------------ steps to rest


def step(K, force, radius, unit=None, moving=None):
    n = len(force)
    out = np.full(n, 9.0)
    found = steps.step_within(np.array(K, float), np.array(force, float), np.ones(n) if unit is None else unit,
                              np.ones(n, bool) if moving is None else moving, radius, out)  # fmt: skip
    return found, out


def test_a_step_within_its_radius_is_newton_s_in_the_given_units():
    """K s = f of what moves; over units: K/(u uᵀ)"""
    found, out = step([[4.0, 1, 7], [1, 3, 7], [7, 7, 7]], [1.0, 2.0, 5.0], 10.0, moving=np.array([True, True, False]))
    assert found == steps.FOUND and out == pytest.approx([1 / 11, 7 / 11, 0.0])
    found, out = step([[4.0, 0], [0, 300.0]], [1.0, 2.0], 10.0, np.array([1.0, 10.0]))
    assert out == pytest.approx([0.25, 2 / 3])
    found, out = step([[4.0, 1], [0, 3]], [1.0, 2.0], 10.0)  # not symmetric, as with friction
    assert found == steps.FOUND and out == pytest.approx([1 / 12, 2 / 3])


@pytest.mark.parametrize("radius", [0.01, 0.3])
def test_a_longer_step_is_shortened_by_an_evenly_greater_stiffness(radius):
    """(K + m) s = f of the length asked for, within 2 %"""
    K, f = np.array([[4.0, 1.0], [1.0, 3.0]]), np.array([1.0, 2.0])
    found, out = step(K, f, radius)
    size = np.linalg.norm(out)
    assert found == steps.FOUND and radius * (1 - 1e-12) <= size <= 1.02 * radius
    left = f - K @ out
    assert left / out == pytest.approx(np.full(2, left[0] / out[0])) and left[0] / out[0] > 0


def test_an_indefinite_stiffness_has_no_step():
    found, out = step([[1.0, 2.0], [2.0, 1.0]], [1.0, 2.0], 10.0)
    assert found == steps.INDEFINITE and out.tolist() == [9.0, 9.0]
    assert step([[-1.0]], [1.0], 10.0)[0] == steps.INDEFINITE


BED = -50.0
FREE = np.array([[0.0, 0.0, -50.0], [1.0, 1.0, -20.0]])


@pytest.mark.parametrize("index, force, held", [
    (8, -1.0, True), (8, 0.0, True), (8, 1.0, False), (7, -1.0, False), (11, -1.0, False), (2, -1.0, False),
])  # fmt: skip
def test_a_free_point_on_the_bed_is_held_where_it_is_pressed_down(index, force, held):
    """Freedoms of a body first, then x, y, z of two points of which the first lies on the bed"""
    given = np.zeros(12)
    given[index] = force
    assert steps.held_by_bed(given, FREE, BED, 6, index) == held


def test_what_is_left_over_is_the_largest_force_that_moves_something():
    """In units; not of what is held, by the study or by the bed; and the pulls of both ends of all lines"""
    force = np.array([1.0, -2, 30, 40, 5, 6, 7, 8, -99.0, 9, 10, 11])
    unit = np.ones(12)
    unit[3] = 10.0
    may = np.ones(12, bool)
    may[2] = False
    rows = np.array([[0, 3.0, -4.0, 5.0, -6.0, 100.0], [0, 1.0, 1.0, 1.0, 1.0, 100.0]])
    moving, residual = np.zeros(12, bool), np.zeros(12)
    worst, total = steps.left_over(force, rows, FREE, BED, may, unit, moving, residual)
    assert (worst, total) == (11.0, 22.0) and moving.tolist() == [
        True,
        True,
        False,
        *[True] * 5,
        False,
        True,
        True,
        True,
    ]
    assert residual.tolist() == [1, -2, 0, 4, 5, 6, 7, 8, 0, 9, 10, 11]
    force[4] = np.nan
    assert np.isnan(steps.left_over(force, rows, FREE, BED, may, unit, moving, residual)[0])


def test_work_ahead_of_a_step_is_of_what_is_not_held_there():
    """Σ s f/u after it, Σ s r before it, and its length"""
    force = np.array([1.0, 2, 3, 4, 5, 6, 7, 8, -99.0, 9, 10, 11])
    s, residual, unit = np.full(12, 0.5), np.arange(12.0), np.ones(12)
    unit[3] = 8.0
    forth, here, size = steps.ahead_of(s, residual, force, FREE, BED, unit)
    assert forth == pytest.approx(0.5 * (1 + 2 + 3 + 0.5 + 5 + 6 + 7 + 8 + 9 + 10 + 11))
    assert here == pytest.approx(33.0) and size == pytest.approx(math.sqrt(3.0))


# ------------------------------------------------------------------ buoys, links, ramps


@pytest.mark.parametrize("reach", [(0.4, 0.9), (0.9, 0.9), (-1.0, 0.5), (2.5, -1.0)])
@pytest.mark.parametrize("before", [0.0, 3e5, 1e9])
def test_a_buoy_tilts_until_its_hawsers_pull_by_what_the_tilt_leaves_of_their_reach(reach, before):
    """S = Σ T(e − x(S)), T = B (e/L ε)², x = l s/√(1 + s²) with s = S/W; whatever the pull was a moment before"""
    lever, upright, load = 2.0, 8e5, 1e6
    ropes = np.array([[30.0, load, 0.1, 2.0, 0.0, 1.0]] * 2)
    made = SimpleNamespace(ropes=ropes, lever=lever, upright=upright)
    work = SimpleNamespace(reach=np.zeros((2, 5)), rope=np.full(2, before / 2))
    work.reach[:, 3] = reach
    shift, slope = buoys.yielded(made, work)

    def pulled(x):
        return sum(load * max(e - x, 0.0) ** 2 / 9.0 for e in reach)

    def tilted(S):
        return lever * (S / upright) / math.sqrt(1 + (S / upright) ** 2)

    low, high = 0.0, pulled(0.0)
    for _ in range(200):
        S = 0.5 * (low + high)
        low, high = (S, high) if pulled(tilted(S)) > S else (low, S)
    assert shift == pytest.approx(tilted(S), rel=1e-9, abs=1e-12)
    steep = sum(2 * load * max(e - shift, 0.0) / 9.0 for e in reach)
    assert slope == pytest.approx(steep * lever / upright / (1 + (S / upright) ** 2) ** 1.5, rel=1e-8)


def test_a_buoy_without_a_lever_or_a_pull_does_not_yield():
    ropes = np.array([[30.0, 1e6, 0.1, 2.0, 0.0, 1.0]])
    work = SimpleNamespace(reach=np.array([[0, 0, 0, 0.5, 0]]), rope=np.zeros(1))
    assert buoys.yielded(SimpleNamespace(ropes=ropes, lever=0.0, upright=1.0), work) == (0.0, 0.0)
    work.reach[0, 3] = -0.5
    assert buoys.yielded(SimpleNamespace(ropes=ropes, lever=2.0, upright=1.0), work) == (0.0, 0.0)


def test_lines_that_lay_on_the_bed_are_followed_together_by_their_span_and_height_over_it(monkeypatch):
    """Span √(x² + y²) and height above the bed at −50 m; the others, and eight of which none lay, are not"""
    asked = []
    monkeypatch.setattr(line_loads, "tensions_near", lambda kept, uniform, ends, n: asked.append(n))
    wide = line_loads.WIDTH
    count = 3 * wide
    work = SimpleNamespace(
        on_bed=np.zeros(count, bool),
        kept=np.full((6, count), float(line_loads.GROUNDED)),
        ends=np.ones((4, count)),
        away=np.tile([30.0, 40.0, -50.0, -8.0], (count, 1)),
        together=np.full(3, -1),
        uniform=None,
    )
    work.on_bed[[1, 2, 2 * wide]] = True
    work.kept[0, 2] += 1.0
    work.away[2 * wide] = [6.0, 8.0, -50.0, 2.0]
    line_loads.follow_on_bed(SimpleNamespace(bed=-50.0), work)
    assert asked == [0, 2 * wide] and np.isnan(work.ends[2]).all()
    assert work.ends[:2, 1].tolist() == [50.0, 42.0] and work.ends[:2, 2 * wide].tolist() == [10.0, 52.0]
    others = np.setdiff1d(np.arange(count), [1, 2 * wide])
    assert np.isnan(work.ends[:2, others]).all()


@pytest.mark.parametrize("first", [-1, 0])
def test_forces_of_a_link_are_shown_along_its_axes_on_the_first_body_or_in_space(first):
    """A force of 10 N along x and 4 along y, a moment of 3 along z and a pull of 5 along z, seen from a body at 90°"""
    made = SimpleNamespace(ends=np.array([[first, 1]]), first=np.array([0, 3]), turns=np.array([2]),
                           travels=np.array([1]), shown=np.array([np.eye(3)]))  # fmt: skip
    work = SimpleNamespace(turn=np.zeros((1, 3, 3)), arm=np.zeros(3), mu=np.array([10.0, 4.0, 3.0]),
                           axis=np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]), pull=np.array([5.0]),
                           toward=np.array([[0.0, 0, 1]]), travel=np.array([0.25]))  # fmt: skip
    poses, out = np.zeros((2, 6)), np.zeros(links.SHOWN)
    poses[0, 5] = math.pi / 2
    links.put_forces(made, work, poses, out)
    force = [10.0, 4.0, 5.0] if first < 0 else [4.0, -10.0, 5.0]
    assert out[:7] == pytest.approx([*force, 0.0, 0.0, 3.0, 0.25], abs=1e-12)


@pytest.mark.parametrize("t, length, share", [
    (-1.0, 10.0, 0.0), (0.0, 10.0, 0.0), (5.0, 10.0, 0.5), (2.5, 10.0, 0.103515625), (10.0, 10.0, 1.0),
    (12.0, 10.0, 1.0), (3.0, 0.0, 1.0), (-3.0, 0.0, 1.0),
])  # fmt: skip
def test_a_ramp_goes_from_nothing_to_all_by_its_fifth_degree(t, length, share):
    """10 s³ − 15 s⁴ + 6 s⁵: at a quarter 0.15625 − 0.05859375 + 0.005859375"""
    assert equation.ramp(t, length) == pytest.approx(share)


@pytest.mark.parametrize("s", [0.0, 0.3, 0.8, 1.0])
def test_samples_of_a_body_are_quintics_of_its_motions_and_cubics_of_all_else(s):
    """Heave to yaw exactly a polynomial of fifth degree by value, speed and acceleration; x, y and the rest of third,
    by value and rate; each of its own size"""
    t0, h, size = 5.0, 2.0, np.arange(1.0, 1 + integrator.SAMPLED)
    fifth = np.polynomial.Polynomial([1.0, -2, 3, -1, 0.5, 0.25])
    third = np.polynomial.Polynomial([1.0, -2, 3, -1])
    n = BLOCK  # of the second body
    clock = SimpleNamespace(y=np.full(2 * BLOCK, np.nan), trial=np.full(2 * BLOCK, np.nan),
                            stages=np.full((7, 2 * BLOCK), np.nan))  # fmt: skip
    for values, row, at in ((clock.y, 0, 0.0), (clock.trial, 6, h)):
        for i in range(integrator.SAMPLED):
            p = third if i < 2 else fifth
            if i < 6:
                values[n + i], clock.stages[row, n + i] = size[i] * p(at), size[i] * p.deriv()(at)
            elif 8 <= i < 12:  # speeds of motions
                values[n + i], clock.stages[row, n + i] = (
                    size[i - 6] * fifth.deriv()(at),
                    size[i - 6] * fifth.deriv(2)(at),
                )
            else:
                values[n + i], clock.stages[row, n + i] = size[i] * third(at), size[i] * third.deriv()(at)
    out = np.zeros(integrator.SAMPLED)
    integrator.put_sample(clock, 1, t0, h, t0 + s * h, out)
    assert out[:2] == pytest.approx(size[:2] * third(s * h)) and out[2:6] == pytest.approx(size[2:6] * fifth(s * h))
    assert out[[6, 7, *range(12, 18)]] == pytest.approx(size[[6, 7, *range(12, 18)]] * third(s * h))


def test_rows_of_links_stand_at_their_bodies_and_shapes(monkeypatch):
    """Two links: of two rows between the ground and body 0, and of one between bodies 0 and 1; two shapes"""
    rows = np.arange(36.0).reshape(3, 12)
    work = SimpleNamespace(amplitude=np.zeros(2), gap=np.array([0.1, 0.2, 0.3]), rows=rows,
                           by_shapes=100 + np.arange(6.0).reshape(3, 2))  # fmt: skip
    told = []
    monkeypatch.setattr(links, "link_work", lambda made: work)
    monkeypatch.setattr(links, "fill_rows", lambda made, work, poses, pulls: told.append((poses.shape, pulls)))
    made = SimpleNamespace(ends=np.array([[-1, 0], [0, 1]]), first=np.array([0, 2, 3]), shapes=np.zeros(2, int))
    G, gap = links.rows_at(made, np.zeros((2, 6)), [7.0, 8.0])
    wanted = np.zeros((3, 14))
    wanted[:2, :6], wanted[2, :6], wanted[2, 6:12] = rows[:2, 6:], rows[2, :6], rows[2, 6:]
    wanted[:, 12:] = work.by_shapes
    assert G.tolist() == wanted.tolist() and gap.tolist() == [0.1, 0.2, 0.3]
    assert work.amplitude.tolist() == [7.0, 8.0] and told == [((2, 6), False)]


@pytest.mark.parametrize("later, kept", [(3.99, [2, 3]), (4.0, [2, 3, 4]), (1.99, []), (9.0, [2, 3, 4, 5])])
def test_forces_of_links_are_kept_at_the_samples_of_a_step_from_the_next_one_on(later, kept, monkeypatch):
    """Steps of 1 s from the second sample on, six in all; the state there is a cubic, 2t here"""
    asked, put = [], []
    monkeypatch.setattr(integrator, "rates", lambda scene, buoy, links, t, state, rate: asked.append((t, state[0])))
    monkeypatch.setattr(integrator, "put_forces", lambda held, work, poses, out: put.append(poses) or out.fill(1.0))
    size = 3
    counts = np.zeros(1 + max(integrator.SAMPLES, integrator.STEPS, integrator.WINDOWS), int)
    counts[integrator.SAMPLES] = 2
    clock = SimpleNamespace(counts=counts, sample_step=1.0, y=np.full(size, 3.0), trial=np.full(size, 13.0),
                            stages=np.full((7, size), 2.0))  # fmt: skip
    work = SimpleNamespace(kept=np.zeros((6, 4)), state=np.zeros(size), rate=np.zeros(size))
    scene = SimpleNamespace(work=SimpleNamespace(place="poses"))
    integrator.keep_links(scene, None, ("held", work), clock, 1.5, 5.0, later)
    at = [row for row in kept if row < 6]
    assert [t for t, _ in asked][: len(at)] == pytest.approx(at)
    assert [value for _, value in asked][: len(at)] == pytest.approx([2.0 * t for t in at])
    assert np.flatnonzero(work.kept[:, 0]).tolist() == at and put == ["poses"] * len(at)


@pytest.mark.parametrize("lost", [None, 1, 3])
def test_lines_pull_by_their_table_their_curve_or_their_catenary_and_hawsers_at_both_ends(lost, monkeypatch):
    """Four lines 3 m along x and 4 m along y: of a table, 10 N and 1 N; a hawser to body 1, 20 N and 2 N; a chain, 30 N
    and 3 N; one with a motion of its own, whose pull is given, (3, 4, −12); without a force, or lost, none"""
    pushed, moments, chain = [], [], (5.0, -8.0, 1.0, -50.0, 70.0, 800.0, 1e-8, 0.5)
    monkeypatch.setattr(line_loads, "place_end", lambda *_: None)
    monkeypatch.setattr(line_loads, "follow_on_bed", lambda *_: None)
    monkeypatch.setattr(line_loads, "rotation_of", lambda turn, R: None)
    monkeypatch.setattr(line_loads, "legendre", lambda x, terms: terms.fill(0.5))
    monkeypatch.setattr(
        line_loads, "packed_pull", lambda tables, row, span, up: (10.0, 1.0) if row == 7 else (-1.0, -1.0)
    )
    monkeypatch.setattr(line_loads, "straight_pull", lambda curves, row, length, span, up: (
        (20.0, 2.0) if (row, length, span, up) == (5, 60.0, 5.0, 9.0) else (-1.0, -1.0)))  # fmt: skip
    monkeypatch.setattr(line_loads, "pull_of_any", lambda kept, row, span, low, high, bed, *line: (
        (30.0, 3.0) if (span, low, high, bed, *line) == chain else (0.0, 0.0)))  # fmt: skip
    monkeypatch.setattr(line_loads, "push_shapes", lambda bent, R, x, y, z, push: pushed.append((x, y, z)))
    monkeypatch.setattr(line_loads, "add_moment", lambda sums, b, ax, ay, az, x, y, z: moments.append((b, ax, x, y, z)))
    monkeypatch.setattr(line_loads, "generalized", lambda *given: None)
    lines = SimpleNamespace(
        lost=np.full(4, np.inf), body=np.array([0, 0, 0, 1]), other=np.array([-1, 1, -1, -1]), bed=-50.0,
        moves=np.array([False, False, False, True]), table=np.array([7, -1, -1, -1]), hawser=np.array([-1, 5, -1, -1]),
        lines=np.array([[50.0, 0, 0, 0], [60.0, 0, 0, 0], [70.0, 800.0, 1e-8, 0.5], [80.0, 0, 0, 0]]), tables=None,
        curves=None, bent=np.zeros((2, 4, 0)),
    )  # fmt: skip
    terms = line_loads.TERMS
    given = np.zeros((4, terms, 3))
    given[3, :2] = [2.0, 8.0, -20.0], [4.0, 0.0, -4.0]
    work = SimpleNamespace(
        sums=np.ones((2, 6)), push=np.ones(0), span=np.array([1.0, 0.0, 2.0]), terms=np.zeros(terms), given=given,
        whole=np.array([i != lost for i in range(4)]), away=np.tile([3.0, 4.0, -8.0, 1.0], (4, 1)),
        ends=np.full((4, 8), np.nan), kept=np.zeros((6, 4)), rows=np.zeros((4, 18)), tension=np.zeros((4, 2)),
        arm=np.zeros((4, 2, 3)), together=np.array([-1]),
    )  # fmt: skip
    work.arm[:, 0, 0], work.arm[:, 1, 0] = np.arange(4.0), 10 + np.arange(4.0)
    good = line_loads.line_loads(lines, work, np.zeros((2, 6)), np.zeros((2, 3, 3)), np.ones((2, 6)))
    pulls = [(10.0, 1.0), (20.0, 2.0), (30.0, 3.0), (5.0, 12.0)]
    if lost is not None:
        pulls[lost] = (0.0, 0.0)
    assert good and work.tension.tolist() == [list(pull) for pull in pulls]
    wanted = []
    for i, (H, down) in enumerate(pulls):
        if i == 3:
            wanted.append((1, 3.0, 3.0, 4.0, -12.0) if lost != 3 else (1, 3.0, 0.0, 0.0, 0.0))
            continue
        wanted.append((0, float(i), -0.6 * H, -0.8 * H, -down))
        if i == 1:
            wanted.append((1, 11.0, 0.6 * H, 0.8 * H, down))
    assert np.array(moments) == pytest.approx(np.array(wanted)) and np.array(pushed) == pytest.approx(
        np.array([row[2:] for row in wanted])
    )


def test_hawsers_of_a_buoy_push_the_first_body_and_their_power_is_its_work(monkeypatch):
    """Force (1 … 6) at speeds (1 … 6): 91 W; loads by half of a ramp of 20 s, waves by all of 4 s"""
    told = []
    for name in ("of_one", "move"):
        monkeypatch.setattr(equation, name, lambda *_: None)
    monkeypatch.setattr(equation, "of_moorings", lambda scene, y, rate: True)
    monkeypatch.setattr(equation, "buoy_rates", lambda floating, kept, y, place, R, at, share, grown, rate: (
        told.append((floating, place.tolist(), R, at, share, grown)), rate.fill(7.0))[0] is None)  # fmt: skip
    body = SimpleNamespace(heading=np.zeros(1), wave_ramp=np.array([2.0, 4.0]), ramp=20.0, bent=None)
    work = SimpleNamespace(force=np.full(6, 9.0), span=np.array([6.0, 0.5]), R=["first", "second"])
    scene = SimpleNamespace(body=body, work=work, line_work=SimpleNamespace(span=np.zeros(1)))
    y, rate = np.zeros(BLOCK + 6), np.full(BLOCK + 6, 5.0)
    y[6:12], y[BLOCK:] = np.arange(1.0, 7.0), np.arange(6.0)
    kept = SimpleNamespace(part=np.arange(1.0, 7.0))
    equation.rates(scene, ("buoy", kept), None, 10.0, y, rate)
    assert told == [("buoy", [0, 1, 2, 3, 4, 5], "first", 8.0 + equation.EDGE, 0.5, 1.0)]
    assert work.force.tolist() == [1, 2, 3, 4, 5, 6] and scene.line_work.span[0] == 10.0
    wanted = np.zeros(BLOCK + 6)
    wanted[equation.FIRST_WORK + equation.BY_HAWSERS], wanted[BLOCK:] = 91.0, 7.0
    assert rate.tolist() == wanted.tolist()


def test_a_stiffness_is_symmetric_if_every_pair_of_its_entries_is():
    K = np.random.default_rng(4).normal(size=(5, 5))
    K += K.T + 9 * np.eye(5)
    assert steps.symmetric(K) and steps.symmetric(np.zeros((0, 0)))
    for i, j in zip(*np.tril_indices(5, -1), strict=True):
        other = K.copy()
        other[i, j] += 2e-14 * (K[i, i] + K[j, j])
        assert not steps.symmetric(other), (i, j)
