"""Fenders, ropes, springs of links and all that acts on bodies in one equation, as plain Python on made-up numbers."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

from hakobune.mooring.lines.system.bodies import rotation

contacts, links = plain("mooring.motion.contact_loads"), plain("mooring.motion.links")
equation, streams = plain("mooring.motion.equation"), plain("mooring.motion.streams")
POSES = np.array([[0.3, -0.2, 0.1, 0.02, -0.03, 0.2], [0.5, 0.1, -0.1, -0.04, 0.05, 0.15]])
PLACE = np.array([[1.0, 2.0, -1.0], [20.0, 1.0, -1.5]])
K, FRICTION, SHEAR = 2e4, 0.3, 5e4
NORMAL = np.array([0.0, 0.8, 0.6])


def along(poses, way, h):
    """Poses a step h along one of the motions: surge and sway go along the heading"""
    out = poses.copy()
    b, i = divmod(way, 6)
    cos, sin = np.cos(poses[b, 5]), np.sin(poses[b, 5])
    out[b] += h * np.array([cos, sin, 0, 0, 0, 0] if i == 0 else [-sin, cos, 0, 0, 0, 0] if i == 1 else np.eye(6)[i])
    return out


def loads(made, work, poses):
    R, v, f = np.zeros((2, 3, 3)), np.zeros(3), np.zeros(3)
    contacts.contact_loads(made, work, poses, R, v, f)
    return work.parts.copy()


def contact(monkeypatch, rope=False, other=-1, a=(4.0, 9.0, 1.0), offset=7.0, limit=0.0):
    """One fender or rope of K N/m on body 0, from `a` − x₀ in space, or in the axes of the other body"""
    monkeypatch.setattr(contacts, "reaction", lambda table, i, depth, state: K * max(depth, 0.0))
    marks = np.array([[0.1, 2.0, limit]])
    arm = (1.0, 2.0, 0.5) if rope else NORMAL
    numbers = np.array([[*a, *arm, offset, FRICTION, SHEAR, float(rope)]])
    ends = np.array([0]), np.array([other])
    made = contacts.Contacts(SimpleNamespace(marks=marks), numbers, *ends, PLACE, np.zeros((2, 1, 0, 3)))
    return made, contacts.contact_work(made)


def depth_of(made, poses):
    """Deflection or elongation by hand"""
    row, other = made.numbers[0], made.other[0]
    turns = [rotation(*pose[3:]) for pose in poses]
    a = PLACE[0] + row[:3] if other < 0 else PLACE[1] + poses[1, :3] + turns[1] @ row[:3]
    origin = PLACE[0] + poses[0, :3]
    if row[contacts.ROPE]:
        return np.linalg.norm(origin + turns[0] @ row[3:6] - a) - row[contacts.OFFSET]
    return row[contacts.OFFSET] - row[3:6] @ turns[0].T @ (a - origin)


@pytest.mark.parametrize("other", [-1, 1])
@pytest.mark.parametrize("rope", [True, False])
def test_a_contact_pushes_as_the_slope_of_its_energy_on_both_bodies(rope, other, monkeypatch):
    """−∂(½ K δ²), at first contact, where nothing has rubbed yet; of a rope into its own part"""
    a = (-17.0, 6.0, 2.0) if other == 1 else (4.0, 9.0, 1.0)
    made, work = contact(monkeypatch, rope, other, a, offset=1.0 if rope else 9.0)
    parts = loads(made, work, POSES)
    depth = depth_of(made, POSES)
    assert depth > 0 and work.now[0, contacts.DEPTH] == pytest.approx(depth)
    assert work.now[0, contacts.FORCE] == pytest.approx(K * depth)
    assert not parts[1 - int(rope)].any()
    for way in range(12):
        energy = [0.5 * K * depth_of(made, along(POSES, way, h)) ** 2 for h in (1e-6, -1e-6)]
        assert parts[int(rope)].ravel()[way] == pytest.approx(-(energy[0] - energy[1]) / 2e-6, abs=0.05), way
    assert parts[int(rope), 1].any() == (other == 1)


def test_a_contact_that_is_away_exerts_nothing_and_one_beyond_its_table_is_named(monkeypatch):
    made, work = contact(monkeypatch, offset=3.0)
    assert not loads(made, work, POSES).any() and work.now[0, contacts.DEPTH] < 0 and work.beyond[0] == -1
    for limit, offset, beyond in ((1.0, 10.0, 0), (0.0, 10.0, -1), (1.0, 8.5, -1)):
        made, work = contact(monkeypatch, offset=offset, limit=limit)
        loads(made, work, POSES)
        assert (work.now[0, contacts.DEPTH] > 2.0) == (offset == 10.0) and work.beyond[0] == beyond


@pytest.mark.parametrize("other", [-1, 1])
@pytest.mark.parametrize("slide, slips", [(0.01, False), (0.5, True)])
def test_a_fender_rubs_as_a_spring_up_to_its_friction_and_slips_beyond(slide, slips, other, monkeypatch):
    """Along x, in its face: k_t u below μ N, then μ N against the way; the other body feels the opposite"""
    still = np.zeros((2, 6))
    a = (-15.0, 10.0, 1.5) if other == 1 else (4.0, 9.0, 1.0)
    made, work = contact(monkeypatch, False, other, a, offset=9.0)
    loads(made, work, still)
    contacts.settle(work)
    moved = still.copy()
    moved[0, 0] = slide
    N = K * depth_of(made, moved)
    force = loads(made, work, moved)[0]
    rubs = min(SHEAR * slide, FRICTION * N)
    assert slips == (SHEAR * slide > FRICTION * N) and depth_of(made, moved) == pytest.approx(depth_of(made, still))
    assert force[0, :3] == pytest.approx(-N * NORMAL - [rubs, 0, 0])
    assert force[1, :3] == pytest.approx(-force[0, :3] if other == 1 else np.zeros(3))
    slid = rotation(0, 0, 0) @ work.now[0, contacts.SLIP : contacts.SLIP + 3]
    assert slid == pytest.approx([rubs / SHEAR, 0, 0])
    contacts.settle(work)
    moved[0, 0] += 0.004
    more = loads(made, work, moved)[0]
    assert more[0, 0] == pytest.approx(-min(rubs + SHEAR * 0.004, FRICTION * N))


def test_what_has_rubbed_between_two_bodies_turns_with_the_one_that_is_met(monkeypatch):
    """Both turned by 90° together: the same forces along the heading of each"""
    still, turned = np.zeros((2, 6)), np.zeros((2, 6))
    made, work = contact(monkeypatch, False, 1, (-15.0, 10.0, 1.5), offset=9.0)
    loads(made, work, still)
    contacts.settle(work)
    still[0, 0] = 0.01
    before = loads(made, work, still)[0]
    contacts.settle(work)
    turn = rotation(0, 0, np.pi / 2)
    for b in range(2):
        turned[b, 5] = np.pi / 2
        turned[b, :3] = turn @ (PLACE[b] + still[b, :3]) - PLACE[b]
    after = loads(made, work, turned)[0]
    assert after[:, :3] == pytest.approx(before[:, :3], abs=1e-6) and np.abs(before[0, 0]) > 100


def test_places_after_each_other_keep_what_was_pressed_before(monkeypatch):
    made, work = contact(monkeypatch, offset=9.0)
    positions = np.zeros((3, 2, 6))
    positions[1:, 0, 0] = 0.002, 0.004
    depth, force = np.zeros((3, 1)), np.zeros((3, 1))
    contacts.contacts_along(made, work, positions, np.zeros((2, 3, 3)), np.zeros(3), np.zeros(3), depth, force)
    assert depth[:, 0] == pytest.approx([depth_of(made, one) for one in positions])
    assert force == pytest.approx(K * depth) and work.start[0, contacts.SLIP] == pytest.approx(0.004)


# ------------------------------------------------------------------ springs and dampers of links

WAY = np.array([0.6, 0.0, 0.8])
POINTS = np.array([[[10.0, 0.5, 0.2], [-9.5, -0.5, 0.7]]])


def a_link(kind, second=1, stiffness=2e4, damping=0.0, rest=0.15):
    """A slider along WAY, or a hinge about it, of the first body, with a spring and a damper"""
    across = np.linalg.svd(WAY[None])[2][1:]
    slides = kind == links.ALONG
    slots, held = np.zeros((1, 3, 3)), np.zeros((1, 3, 3))
    slots[0, : 2 if slides else 3] = across if slides else np.eye(3)
    held[0, : 3 if slides else 2] = np.eye(3) if slides else across
    points = POINTS.copy()
    if second < 0:
        points[0, 1] = (10.3, 0.4, -0.8)
    turns = 2 if slides else 3
    return links.Links(np.array([[0, second]]), points, np.eye(3)[None], slots, held, np.array([0, 5]),
                       np.array([turns]), PLACE, np.eye(3)[None], WAY[None], np.array([[stiffness, damping, rest]]),
                       np.array([kind]))  # fmt: skip


def travel(link, poses):
    """m along the way of the first body, or rad about it"""
    turns, ends = [], []
    for b, point in zip(link.ends[0], link.points[0], strict=True):
        turns.append(np.eye(3) if b < 0 else rotation(*poses[b, 3:]))
        ends.append(turns[-1] @ point + (0.0 if b < 0 else PLACE[b] + poses[b, :3]))
    if link.travels[0] == links.ALONG:
        return (turns[0] @ WAY) @ (ends[1] - ends[0])
    Q = turns[0].T @ turns[1]
    sine = WAY @ [Q[2, 1] - Q[1, 2], Q[0, 2] - Q[2, 0], Q[1, 0] - Q[0, 1]]
    return np.arctan2(sine, np.trace(Q) - 1.0)


@pytest.mark.parametrize("second", [1, -1])
@pytest.mark.parametrize("kind", ["ALONG", "ABOUT"])
def test_a_spring_of_a_link_pulls_by_its_travel_from_rest_and_does_its_work(kind, second):
    """−k (s − s₀) with s of the first body's axes; generalized by the slope of s"""
    link = a_link(getattr(links, kind), second)
    poses = POSES.copy()
    if kind == "ABOUT":  # turned about the way alone, as the hinge lets it
        poses[:, 3:] = 0.0
        poses[0, 5], poses[1, 5] = 0.3, 0.3
    found = links.springs_at(link, poses)
    pull = -2e4 * (travel(link, poses) - 0.15)
    for way in range(12):
        slope = (travel(link, along(poses, way, 1e-6)) - travel(link, along(poses, way, -1e-6))) / 2e-6
        if kind == "ALONG" or way % 6 < 3:
            assert found[way] == pytest.approx(pull * slope, abs=0.05), way
    if kind == "ABOUT":
        assert np.hypot(*found[[3, 5]]) == pytest.approx(abs(pull), rel=1e-6)
    assert found[6:].any() == (second == 1)


def test_a_damper_of_a_slider_pulls_against_the_speed_along_it_and_is_told_on_the_second():
    link = a_link(links.ALONG, damping=3e3)
    work, force = links.link_work(link), np.zeros(12)
    work.speed[:] = np.random.default_rng(4).normal(size=12)
    links.fill_rows(link, work, POSES, True)
    links.drive(link, work, force)
    speed = work.pulled[0] @ work.speed
    numbers = [
        (travel(link, along(POSES, way, 1e-6)) - travel(link, along(POSES, way, -1e-6))) / 2e-6 for way in range(12)
    ]
    assert speed == pytest.approx(np.dot(numbers, work.speed), rel=1e-6)
    assert work.pull[0] == pytest.approx(-2e4 * (travel(link, POSES) - 0.15) - 3e3 * speed)
    assert force == pytest.approx(work.pull[0] * work.pulled[0])
    out = np.zeros(links.SHOWN)
    work.mu[:] = 0.0
    links.put_forces(link, work, POSES, out)
    assert out[:3] == pytest.approx(work.pull[0] * WAY) and not out[3:6].any()
    assert out[6] == pytest.approx(travel(link, POSES))
    assert links.held_by(link, POSES, np.zeros(5))[0, :3] == pytest.approx(-2e4 * (travel(link, POSES) - 0.15) * WAY)


def test_a_moment_about_a_hinge_is_told_behind_its_forces():
    link = a_link(links.ABOUT)
    poses = np.zeros((2, 6))
    poses[1, 5] = 0.1
    told = links.held_by(link, poses, np.zeros(5))[0]
    assert not told[:3].any() and told[3:] == pytest.approx(-2e4 * (travel(link, poses) - 0.15) * WAY)


# ------------------------------------------------------------------ one equation


def scene(bodies=2, window=1, given=1, hull=None):
    numbers = SimpleNamespace
    rigid = numbers(owner=np.zeros(0, np.int64), place=np.zeros(0, np.int64))
    body = numbers(heading=np.zeros(bodies), wave_ramp=np.array([2.0, 10.0]), ramp=20.0, drift_damping=["d"] * bodies,
                   given=np.zeros((6 * bodies, given)), given_step=0.5, mass_inverse="W",
                   shapes=rigid, bent=None)  # fmt: skip
    work = numbers(window=np.zeros((bodies, 9, window)), span=np.array([0.0, 0.5]), weights="w", waves=np.zeros(9),
                   part=np.zeros(6), drag=np.zeros(6), moving=np.zeros(4), powers=None, stream=np.zeros(3), value=None,
                   arm=np.zeros(3), place=np.zeros((bodies, 6)), force=np.zeros(6 * bodies), R=None,
                   pull=np.zeros((bodies, 6)))  # fmt: skip
    return numbers(
        body=body,
        work=work,
        hull=hull,
        wind="wind",
        current="current",
        lines="lines",
        line_work="line work",
        contacts=numbers(numbers=np.zeros(0)),
        contact_work=None,
    )


def share(t, length):
    """Ramp of the loads as the module has it"""
    return equation.ramp(t, length)


def acted(made, monkeypatch, b=1, t=7.0, stream=lambda name: np.zeros(6)):
    """Force and works of body b with sixth velocities 1 … 6, heading 0.3 slow and moving slowly"""
    y, rate, force = np.zeros(equation.BLOCK), np.zeros(equation.BLOCK), np.zeros(6)
    y[6:12] = np.arange(1.0, 7.0)
    y[14], y[15], y[16] = 0.3, 0.5, -0.2

    def stream_force(name, number, time, grown, angles, weights, part, value):
        assert (number, time) == (b, t)
        part[:] = grown * stream(name)

    monkeypatch.setattr(equation, "stream_force", stream_force)
    equation.load(made, made.hull, b, t, y, rate, force, made.work)
    return force, rate[equation.FIRST_WORK :], y


def test_waves_and_drift_grow_with_their_ramp_and_drift_falls_with_the_way_through_them(monkeypatch):
    """Waves by the ramp, drift by its square; D − B V with V of the slow pose along the heading"""
    made = scene(window=3)
    waves, B = np.arange(1.0, 10.0), np.arange(1.0, 7.0) / 10

    def samples(table, place, weights, out):
        assert place == pytest.approx(7.0 / 0.5 + equation.EDGE)
        out[:] = waves

    monkeypatch.setattr(equation, "between_samples", samples)
    monkeypatch.setattr(equation, "on_ring", lambda ring, angle, weights, out: np.copyto(out, B) or None)
    force, works, y = acted(made, monkeypatch)
    grown = share(7.0 - 2.0, 10.0)
    u, v = np.cos(0.3) * 0.5 - np.sin(0.3) * 0.2, -np.sin(0.3) * 0.5 - np.cos(0.3) * 0.2
    drift = grown**2 * (waves[6:] - B.reshape(3, 2) @ [u, v])
    wanted = grown * waves[:6]
    assert works[equation.BY_WAVES] == pytest.approx(wanted @ y[6:12])
    assert works[equation.BY_DRIFT] == pytest.approx(drift @ y[[6, 7, 11]])
    wanted[[0, 1, 5]] += drift
    assert force == pytest.approx(wanted) and 0 < grown < 1


def test_wind_current_and_given_forces_grow_with_the_ramp_and_do_their_own_work(monkeypatch):
    made, given = scene(given=4), np.array([1.0, 2, 3, 4, 5, 6])
    made.body.given[6:] = given[:, None]

    def samples(table, place, weights, out):
        assert table.shape == (6, 4) and place == 7.0 / 0.5
        out[:6] = table[:, 0]

    monkeypatch.setattr(equation, "between_samples", samples)
    force, works, y = acted(made, monkeypatch, stream=lambda name: given * (10 if name == "wind" else 100))
    grown = share(7.0, 20.0)
    assert force == pytest.approx(grown * 111 * given)
    power = grown * given @ y[6:12]
    assert works[equation.BY_GIVEN] == pytest.approx(power) and works[equation.BY_WIND] == pytest.approx(10 * power)
    assert works[equation.BY_CURRENT] == pytest.approx(100 * power) and not works[equation.BY_WAVES]


def test_water_on_a_hull_that_slews_acts_at_its_lever_and_drift_beside_it(monkeypatch):
    """X, Y at 5 m below the axes: moments 5 Y about x and −5 X about y"""
    made = scene(hull=SimpleNamespace(lever=5.0))

    def water(hull, grown, moving, weights, powers, stream, arm):
        assert moving.tolist() == [0.0, 1.0, 2.0, 6.0] and grown == share(7.0, 20.0)
        stream[:], arm[:] = (2.0, 3.0, 4.0), (10.0, 20.0, 30.0)

    monkeypatch.setattr(equation, "hull_water_force", water)
    force, works, _ = acted(made, monkeypatch)
    assert force.tolist() == [12.0, 23.0, 0.0, 15.0, -10.0, 34.0]
    assert works[equation.BY_CURRENT] == 2 * 1 + 3 * 2 + 15 * 4 - 10 * 5 + 4 * 6
    assert works[equation.BY_DRIFT] == 10 * 1 + 20 * 2 + 30 * 6


@pytest.mark.parametrize("met", [True, False])
def test_lines_fenders_and_ropes_act_on_each_body_with_works_of_their_own(met, monkeypatch):
    made, n = scene(), equation.BLOCK
    y, rate = np.zeros(2 * n), np.zeros(2 * n)
    y[:6], y[n : n + 6], y[6:12], y[n + 6 : n + 12] = 1.0, 2.0, np.arange(6.0), 1.0
    made.contacts.numbers = np.zeros(int(met))
    made.contact_work = SimpleNamespace(parts=np.arange(24.0).reshape(2, 2, 6))

    def lines(lines, work, place, R, pull):
        assert place[:, 0].tolist() == [1.0, 2.0]
        pull[:] = np.arange(100.0, 112.0).reshape(2, 6)
        return False

    monkeypatch.setattr(equation, "line_loads", lines)
    monkeypatch.setattr(equation, "contact_loads", lambda *_: None)
    assert equation.of_moorings(made, y, rate) is False
    parts = made.contact_work.parts * met
    assert made.work.force == pytest.approx(np.arange(100.0, 112.0) + parts.sum(axis=0).ravel())
    for b, speed in enumerate((np.arange(6.0), np.ones(6))):
        works = rate[n * b + equation.FIRST_WORK :][: len(equation.WORKS)]
        assert works[equation.BY_LINES] == pytest.approx(np.arange(100.0, 112.0).reshape(2, 6)[b] @ speed)
        assert works[equation.BY_FENDERS] == pytest.approx(parts[0, b] @ speed)
        assert works[equation.BY_ROPES] == pytest.approx(parts[1, b] @ speed)


def test_dampers_and_springs_of_links_work_on_both_bodies(monkeypatch):
    made, n = scene(), equation.BLOCK
    y, rate = np.zeros(2 * n), np.zeros(2 * n)
    y[6:12], y[n + 6 : n + 12] = np.arange(6.0), np.arange(10.0, 16.0)
    kept = SimpleNamespace(speed=np.zeros(12), pull=np.array([2.0, 3.0]),
                           pulled=np.arange(24.0).reshape(2, 12))  # fmt: skip
    asked = []
    monkeypatch.setattr(equation, "hold_together", lambda *given: asked.append(given))
    held = SimpleNamespace(ends=np.array([[0, 1], [1, -1]]), shapes=np.zeros(0, int))
    equation.of_links(made, (held, kept), y, rate)
    assert kept.speed.tolist() == [*range(6), *range(10, 16)]
    assert asked[0][0] is held and asked[0][2] is made.work.place and asked[0][3] == "W"
    first = 2.0 * kept.pulled[0, :6] @ y[6:12]
    second = 2.0 * kept.pulled[0, 6:] @ y[n + 6 : n + 12] + 3.0 * kept.pulled[1, :6] @ y[n + 6 : n + 12]
    at = equation.FIRST_WORK + equation.BY_DAMPING
    assert (rate[at], rate[n + at]) == pytest.approx((first, second)) and np.count_nonzero(rate) == 2


def test_streams_on_several_bodies_have_the_table_of_each():
    one, two = streams.calm(), streams.calm(2)
    one.table[:], two.table[:] = 1.0, 2.0
    both = streams.on_all([one, two])
    assert both.table.shape == (3, streams.RING + 3, 6) and both.table[:, 0, 0].tolist() == [1.0, 2.0, 2.0]


@pytest.mark.parametrize("order", [(-1, 1), (1, -1)])
def test_several_contacts_are_those_of_each_alone_one_on_the_quay_and_one_between_bodies(order, monkeypatch):
    """Pressed, rubbed, then all turned: what has rubbed on the other body turns with it, on the quay it does not"""
    at = {-1: (4.0, 9.0, 1.0), 1: (-15.0, 10.0, 1.5)}
    each = [contact(monkeypatch, False, other, at[other], offset=9.0) for other in order]
    rows, bent = np.concatenate([made.numbers for made, _ in each]), np.zeros((2, 2, 0, 3))
    table = SimpleNamespace(marks=np.tile(each[0][0].table.marks, (2, 1)))
    both = contacts.Contacts(table, rows, np.zeros(2, int), np.array(order), PLACE, bent)
    each.append((both, contacts.contact_work(both)))
    places = np.zeros((3, 2, 6))
    places[1:, 0, 0], places[1:, 1, 1], places[2, :, 5] = 0.01, 0.003, (0.3, 0.25)
    for poses in places:
        one, other, together = (loads(*pair, poses) for pair in each)
        assert together == pytest.approx(one + other, rel=1e-9, abs=1e-6) and one.any() and other.any()
        for _, work in each:
            contacts.settle(work)


@pytest.mark.parametrize("met", [True, False])
def test_lines_fenders_and_ropes_push_each_shape_and_do_their_work_on_its_body(met):
    """Shapes 1 and 3 of two groups, the first of body 1, the second of body 0: force times rate of the shape"""
    y, shapes = np.random.default_rng(8).normal(size=2 * equation.BLOCK + 6 + 2 * equation.OF_SHAPES), [1, 9]
    push = np.array([[2.0, -3.0], [5.0, 7.0], [11.0, 13.0]])  # of lines, fenders, ropes
    bent = SimpleNamespace(place=np.array(shapes), owner=np.array([1, 0]))
    body = SimpleNamespace(heading=np.zeros(2))
    made = SimpleNamespace(body=body, line_work=SimpleNamespace(push=push[0]), work=SimpleNamespace(force=np.zeros(24)),
                           contact_work=SimpleNamespace(push=push[1:]))  # fmt: skip
    rate = np.zeros(len(y))
    equation.of_moorings_on_shapes(bent, made, y, rate, met)
    own = y[2 * equation.BLOCK + 6 :].reshape(2, 2, 6)[:, 1]  # rates of the amplitudes
    wanted, works = np.zeros(24), np.zeros((2, len(equation.WORKS)))
    kinds = [equation.BY_LINES, equation.BY_FENDERS, equation.BY_ROPES]
    for k, (shape, owner) in enumerate(zip(shapes, (1, 0), strict=True)):
        for kind, pushed in zip(kinds[: 3 if met else 1], push[:, k], strict=False):
            wanted[12 + shape] += pushed
            works[owner, kind] += pushed * own.ravel()[shape]
    assert made.work.force == pytest.approx(wanted)
    assert equation.blocks(rate, 2)[:, equation.FIRST_WORK :] == pytest.approx(works)
