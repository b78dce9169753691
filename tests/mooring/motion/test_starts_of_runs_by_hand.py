"""States from which runs begin, by hand: places, speeds, shapes, a buoy; how a run goes on to its end; rest of bodies
between lines and water."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.motion import contacts, integrator
from hakobune.mooring.motion.equation import BLOCK, OF_SHAPES, SAMPLED, SLOW
from hakobune.mooring.motion.simulation import loads, moored_body, run, trial
from hakobune.mooring.motion.simulation.failures import SimulationError
from hakobune.mooring.motion.simulation.moored_body import with_memory
from hakobune.mooring.motion.tables.groups import Groups

OFFSET, VELOCITY = np.arange(1.0, 13.0), 0.1 * np.arange(1.0, 13.0)
START = np.arange(12.0) / 100
STATES = 5  # of the memory


class Scene(SimpleNamespace):
    def _replace(self, **given):
        return Scene(**vars(self) | given)


@pytest.fixture
def followed(monkeypatch):
    """(function that follows two made-up bodies, what the integrator was given); the second heads along y"""
    seen = SimpleNamespace(calls=[], shares=[])

    def advance(scene, waves, clock, samples, most, hung, links, pair):
        seen.calls.append((clock, samples, most, hung, pair))
        seen.scene, seen.y = scene, clock.y.copy()
        clock.now[integrator.TIME] += 75.0
        samples[:] = np.arange(samples.size).reshape(samples.shape)
        return integrator.RUNNING if clock.now[integrator.TIME] < 150 else seen.last

    monkeypatch.setattr(run, "line_work", lambda lines: ("work of", lines))
    monkeypatch.setattr(run, "without_corners", lambda scene: True)
    monkeypatch.setattr(run, "contact_work", lambda contacts: ("work of", contacts))
    monkeypatch.setattr(run, "links_of", lambda reader: None)
    monkeypatch.setattr(run, "buoy_of", lambda buoy, table, rows: ("arrays", SimpleNamespace(kept=(table, rows))))
    monkeypatch.setattr(integrator, "advance", advance)
    monkeypatch.setattr(run, "stopped", lambda *reasons: SimulationError(reasons[0]))

    def follow(groups=((), ()), buoy=None, last=integrator.DONE, offset=OFFSET, velocity=VELOCITY, start=START,
               more_scales=0, moving=None, inverse=None):  # fmt: skip
        seen.last = last
        monkeypatch.setattr(run, "groups_of", lambda reader: Groups(*(np.array(part, np.int64) for part in groups)))
        reader = SimpleNamespace(rigid=12, words=[""] * len(start), axes_at_rest=np.zeros((2, 6)))
        reader.axes_at_rest[1] = [7.0, 8.0, 9.0, 0.0, 0.0, np.pi / 2]
        moored = SimpleNamespace(reader=reader, start=start, buoy=buoy)
        settings = SimpleNamespace(ramp=30.0, duration=100.0, step=0.5, fixed_step=0.0, tolerance=1e-3,
                                   velocity=velocity, offset=offset)  # fmt: skip
        memory = SimpleNamespace(decay=np.zeros(STATES))
        scene = Scene(
            body=SimpleNamespace(memory=memory, mass_inverse=inverse),
            lines=SimpleNamespace(lost=np.zeros(3)),
            contacts="contacts",
        )
        begun = SimpleNamespace(
            scene=scene, waves=SimpleNamespace(table="table"), moving=moving, expected=np.ones((2 + more_scales, 12))
        )
        return run._followed(moored, settings, begun, seen.shares.append)

    return follow, seen


def test_a_run_begins_at_rest_with_its_offset_along_the_axes_and_its_velocity(followed):
    """Of the second body, x along its axes is y in space; slow motion begins in surge, sway and yaw as they are."""
    follow, seen = followed
    course = follow()
    places = START.reshape(2, 6) + OFFSET.reshape(2, 6)
    places[1, :2] = START[6:8] + [-OFFSET[7], OFFSET[6]]
    places[1, 5] += np.pi / 2
    states = seen.y[: 2 * BLOCK].reshape(2, BLOCK)
    assert states[:, :6] == pytest.approx(places) and states[:, 6:12] == pytest.approx(VELOCITY.reshape(2, 6))
    assert states[:, SLOW : SLOW + 3] == pytest.approx(places[:, [0, 1, 5]])
    rest = np.delete(seen.y, [*range(12), *range(SLOW, SLOW + 3), *(BLOCK + np.r_[0:12, SLOW : SLOW + 3])])
    assert len(seen.y) == 2 * BLOCK + 6 + STATES and not rest.any()
    clock, samples, most, hung, pair = seen.calls[0]
    assert (clock.end, clock.sample_step, clock.fixed_step) == (130.0, 0.5, 0.0)
    assert clock.smooth == integrator.SMOOTH  # static lines alone
    assert clock.scale == pytest.approx(np.full((2, 12), 0.3 * 1e-3 / 20.0))
    assert samples.shape == (261, 2 * SAMPLED) and most == 5000 and hung is None and pair is None
    assert seen.scene.line_work == ("work of", seen.scene.lines) and seen.scene.contact_work == ("work of", "contacts")
    assert seen.shares == [pytest.approx(75 / 130), 1.0] and len(seen.calls) == 2
    assert course.samples.shape == (261, 2, SAMPLED) and course.samples[1, 1, 0] == 3 * SAMPLED
    assert course.buoy.shape == (261, 0) and course.bent.shape == (261, 0) and course.pulls == {}
    assert course.hung is None and course.held is None and course.clock is clock


def test_a_buoy_begins_after_the_bodies_and_its_place_and_speed_are_sampled(followed):
    follow, seen = followed
    course = follow(buoy=SimpleNamespace(start=np.arange(20.0, 23.0)))
    assert seen.y[2 * BLOCK : 2 * BLOCK + 6] == pytest.approx([20.0, 21.0, 22.0, 0.0, 0.0, 0.0])
    assert seen.calls[0][1].shape == (261, 2 * SAMPLED + 6)
    assert course.buoy[1] == pytest.approx(2 * SAMPLED + 6 + 2 * SAMPLED + np.arange(6.0))
    assert course.hung == ("table", 261) and seen.calls[0][0].smooth == np.inf


@pytest.mark.parametrize("fenders, hawser, table, smooth", [
    (0, [-1, -1], [-1, -1], True), (1, [-1, -1], [-1, -1], False), (0, [-1, 0], [-1, -1], False),
    (0, [-1, -1], [0, -1], False),
])  # fmt: skip
def test_fenders_hawsers_and_lines_of_tables_have_corners(fenders, hawser, table, smooth):
    lines = SimpleNamespace(hawser=np.array(hawser), table=np.array(table))
    scene = SimpleNamespace(lines=lines, contacts=SimpleNamespace(numbers=np.zeros((fenders, 3))))
    assert run.without_corners(scene) == smooth


def test_shapes_begin_bent_as_at_rest_and_as_far_as_their_offset(followed):
    """Seven shapes of the second body in two groups of six: amplitudes of a group, then their rates"""
    follow, seen = followed
    place = [0, 1, 2, 3, 4, 5, 6]
    more = np.arange(7.0)
    course = follow(
        ((1, 1), place), offset=np.append(OFFSET, 10 + more), velocity=np.append(VELOCITY, 20 + more),
        start=np.append(START, more / 10), more_scales=2,
    )  # fmt: skip
    bent = seen.y[2 * BLOCK + 6 :][: 2 * OF_SHAPES].reshape(2, 2, 6)
    assert bent[0, 0] == pytest.approx(more[:6] * 1.1 + 10) and bent[0, 1] == pytest.approx(20 + more[:6])
    assert bent[1, 0] == pytest.approx([16.6, 0, 0, 0, 0, 0]) and bent[1, 1] == pytest.approx([26.0, 0, 0, 0, 0, 0])
    assert len(seen.y) == 2 * BLOCK + 6 + 2 * OF_SHAPES + STATES
    width = 2 * SAMPLED + 2 * OF_SHAPES
    first = width + 2 * SAMPLED  # of the second row
    assert course.bent.shape == course.bending.shape == (261, 7)
    assert course.bent[1] == pytest.approx(first + np.array([0, 1, 2, 3, 4, 5, 12]))
    assert course.bending[1] == pytest.approx(first + np.array([6, 7, 8, 9, 10, 11, 18]))
    assert seen.calls[0][0].bent_scale.shape == (2, 12)


def test_lines_with_a_motion_of_their_own_go_on_in_shorter_turns_and_have_their_pulls_by_number(followed, monkeypatch):
    """Of every row, of the line of each number: numbers 2 and 0 of three"""
    follow, seen = followed
    asked = []

    def moving_work(lines, states, rows, count, sampled, shapes):
        asked.append((lines.number.tolist(), states, rows, count, sampled, shapes))
        return SimpleNamespace(tension=np.array([[1.0, 2.0], [3.0, 4.0]]), stuck=np.array([7]))

    monkeypatch.setattr(run, "moving_work", moving_work)
    course = follow(moving=(SimpleNamespace(number=np.array([2, 0])), "states"))
    assert asked == [([2, 0], "states", 261, 3, (2, SAMPLED), (0, 0))] and seen.calls[0][2] == 200
    assert {name: pull.tolist() for name, pull in course.pulls.items()} == {2: [1.0, 3.0], 0: [2.0, 4.0]}
    monkeypatch.setattr(run, "stopped", lambda *reasons: SimulationError(f"line {reasons[-1]}"))
    with pytest.raises(SimulationError, match="line 7"):
        follow(moving=(SimpleNamespace(number=np.array([2, 0])), "states"), last=integrator.STUCK)


def test_hinged_bodies_begin_together_and_what_their_links_hold_is_kept_for_each_sample(followed, monkeypatch):
    """By the inverse of the mass of all that moves, the last of which are shapes"""
    follow, seen = followed
    held = SimpleNamespace(shapes=np.array([12, 14]))
    asked = []
    monkeypatch.setattr(run, "links_of", lambda reader: held)
    monkeypatch.setattr(
        run,
        "link_work",
        lambda held, size, rows, groups: asked.append((size, rows, groups)) or SimpleNamespace(kept="kept"),
    )

    def begin_together(links, inverse, poses, speed, shapes):
        asked.append((links, inverse.shape, inverse[12:, 0].tolist(), poses.shape, speed.shape, shapes.tolist()))
        return poses + 1.0, speed + 2.0, shapes + 3.0

    monkeypatch.setattr(run, "begin_together", begin_together)
    inverse = np.arange(324.0).reshape(18, 18)
    course = follow(((1,), [0, 2]), offset=np.append(OFFSET, [5.0, 6.0]), velocity=np.append(VELOCITY, [7.0, 8.0]),
                    start=np.append(START, [0.1, 0.2]), more_scales=1, inverse=inverse)  # fmt: skip
    size = 2 * BLOCK + 6 + OF_SHAPES + STATES
    assert asked[0] == (size, 261, 1) and course.held == "kept"
    assert asked[1] == (held, (14, 14), [216.0, 252.0], (2, 6), (2, 6), [[5.1, 6.2], [7.0, 8.0]])
    states = seen.y[: 2 * BLOCK].reshape(2, BLOCK)
    assert states[0, :6] == pytest.approx(START[:6] + OFFSET[:6] + 1.0) and states[0, 6:12] == pytest.approx(
        VELOCITY[:6] + 2
    )
    assert states[:, SLOW : SLOW + 3] == pytest.approx(states[:, [0, 1, 5]])
    bent = seen.y[2 * BLOCK + 6 :][:OF_SHAPES].reshape(2, 6)
    assert bent[0] == pytest.approx([8.1, 0, 9.2, 0, 0, 0]) and bent[1] == pytest.approx([10.0, 0, 11.0, 0, 0, 0])


def test_a_run_that_cannot_go_on_ends_with_its_reason(followed):
    follow, _ = followed
    with pytest.raises(SimulationError, match=str(integrator.TOO_SHORT)):
        follow(last=integrator.TOO_SHORT)


@pytest.mark.parametrize(("offset", "count"), [(np.ones(6), 6), (np.ones(13), 13)])
def test_an_offset_has_a_number_for_each_motion(followed, offset, count):
    with pytest.raises(SimulationError, match=f"has {count} numbers for 12 motions"):
        followed[0](offset=offset)
    assert followed[0](offset=np.zeros(6)) is not None  # none at all


def test_a_trial_begins_off_its_place_by_a_share_of_the_longest_arm_but_not_at_a_quay(monkeypatch):
    """Fairleads 5 m and 13 m off the axis: NUDGE of 13 m in surge and sway, NUDGE in yaw, of each body"""
    fairlead = np.array([[3.0, 4.0, 50.0], [-5.0, 12.0, -1.0]])
    monkeypatch.setattr(trial, "body_lines", lambda system: SimpleNamespace(fairlead=fairlead))
    monkeypatch.setattr(trial, "replace", lambda moored, start: start)
    one = SimpleNamespace(berth=SimpleNamespace(names=()), system=None, start=START, reader=SimpleNamespace(rigid=12))
    far = 13 * trial.NUDGE
    assert trial._nudged(one) - START == pytest.approx([far, far, 0, 0, 0, trial.NUDGE] * 2)
    quay = SimpleNamespace(**vars(one) | dict(berth=SimpleNamespace(names=("fender",))))
    assert trial._nudged(quay) is quay


def test_seconds_of_a_trial_are_over_what_was_run_between_its_first_and_last_report(monkeypatch):
    now = iter([100.0, 103.0, 109.0])
    monkeypatch.setattr(trial.time, "perf_counter", lambda: next(now))
    pace = trial._Pace(SimpleNamespace(ramp=30.0, duration=90.0))
    pace(0.25)
    assert np.isnan(pace.seconds)
    pace(0.25)
    assert np.isnan(pace.seconds)
    pace(0.75)
    assert pace.seconds == pytest.approx(9 / 60)


def test_a_memory_is_fitted_to_the_motions_that_are_free_and_what_is_said_of_it_is_added(monkeypatch):
    monkeypatch.setattr(moored_body, "fitted_memory", lambda reader, free: ((reader, free), ("poor",)))
    monkeypatch.setattr(moored_body, "replace", lambda moored, **new: new)
    found = with_memory(SimpleNamespace(reader="reader", free="free", findings=("a", "b")))
    assert found == dict(memory=("reader", "free"), findings=("a", "b", "poor"))


class Springs:
    """A system of lines that pull two bodies, each by its own springs in space, N/m, towards where they were put"""

    stiffness = np.array([[2e5, 3e5, 4e5], [5e5, 1e5, 7e5]])

    def __init__(self, headings):
        self.bodies = [SimpleNamespace(position=(10.0 * i, 20.0, -1.0, 0.0, 0.0, h)) for i, h in enumerate(headings)]
        self.arrays = SimpleNamespace(position=np.array([[30.0, 0.0, 0.0], [0.0, 50.0, 0.0]]), owner=np.array([0, 1]))

    def load(self, pose):
        off = pose.place - np.array([one.position[:3] for one in self.bodies])
        out = np.zeros((2, 6))
        out[:, :3] = -self.stiffness * off
        return SimpleNamespace(force=out.ravel())


def test_bodies_rest_where_lines_water_fenders_and_loads_balance(monkeypatch):
    """A load in space is carried by lines in space and by water and fenders along the axes of each body.

    The second body heads along y: what holds its sway holds it along −x.  Roll, pitch and yaw are held by the water.
    """
    system = Springs((0.0, np.pi / 2))
    water = np.diag([1e5, 2e5, 3e5, 4e7, 5e7, 6e7, 1.5e5, 2.5e5, 3.5e5, 4.5e7, 5.5e7, 6.5e7])
    load = 1e4 * np.array([2.0, -3.0, 4.0, 0.0, 0.0, 5e-6, -6.0, 7.0, 8.0, 0.0, 0.0, 9e-6])
    monkeypatch.setattr(contacts, "contact_forces", lambda berth, place: np.array([3.0]))
    monkeypatch.setattr(contacts, "berth_force", lambda berth, place: 1e5 * np.array([0, -place[1], *[0] * 10]))
    place, held = contacts.rest_between(system, None, None, water, load)
    k = Springs.stiffness
    first = [2e4 / (k[0, 0] + 1e5), -3e4 / (k[0, 1] + 3e5), 4e4 / (k[0, 2] + 3e5)]
    second = [-6e4 / (k[1, 0] + 2.5e5), 7e4 / (k[1, 1] + 1.5e5), 8e4 / (k[1, 2] + 3.5e5)]
    assert place[:3] == pytest.approx(first) and place[6:9] == pytest.approx(second) and not held.size
    assert (
        place[[5, 11]] == pytest.approx([0.05 / 6e7, 0.09 / 6.5e7], rel=1e-4)
        and np.abs(place[[3, 4, 9, 10]]).max() < 1e-9
    )


@pytest.mark.parametrize("names", [(), ("fender",)])
def test_linked_bodies_rest_by_the_same_forces_and_those_of_fenders_where_there_are_any(names, monkeypatch):
    """As far as a farthest fairlead turns by 1/arm it moves 1 m: 30 and 50 m here, 1 m for a body without any"""
    seen = {}

    def together(links, forces, start, unit, headings):
        seen.update(links=links, start=start, unit=unit, headings=headings, forces=forces(np.full(12, 0.01)))
        return "place", "held"

    monkeypatch.setattr(contacts, "rest_together", together)
    monkeypatch.setattr(contacts, "berth_force", lambda berth, place: 1e3 * np.arange(12.0))
    system = Springs((0.0, 0.0))
    berth = SimpleNamespace(names=names)
    assert contacts.rest_between(system, berth, "links", np.zeros((12, 12)), np.zeros(12)) == ("place", "held")
    assert seen["links"] == "links" and not seen["start"].any() and seen["headings"].tolist() == [0.0, 0.0]
    assert seen["unit"] == pytest.approx([1, 1, 1, *[1 / 30] * 3, 1, 1, 1, *[1 / 50] * 3])
    pulls = np.zeros((2, 6))
    pulls[:, :3] = -0.01 * Springs.stiffness
    away = np.array([np.cos(0.01), np.sin(0.01)])  # along the axes as they are turned
    wanted = pulls.copy()
    wanted[:, 0] = pulls[:, :2] @ away
    wanted[:, 1] = pulls[:, :2] @ [-away[1], away[0]]
    assert seen["forces"] == pytest.approx(wanted.ravel() + (1e3 * np.arange(12.0) if names else 0.0))
    system.arrays.owner[:] = 0
    contacts.rest_between(system, berth, "links", np.zeros((12, 12)), np.zeros(12))
    assert seen["unit"][3:] == pytest.approx([1 / 50] * 3 + [1] * 6)


def test_wind_and_current_need_a_hull_and_without_them_nothing_blows():
    moored = SimpleNamespace(reader=SimpleNamespace(axes_at_rest=np.zeros((2, 6))), hulls=())
    for wind, current in ((None, None), ("wind", None), (None, "current"), ("wind", "current")):
        weather = SimpleNamespace(on_hull=None, wind=wind, current=current)
        if wind or current:
            with pytest.raises(SimulationError, match="wind and current need the dimensions of the hull"):
                loads.streams(moored, weather, 3, 50.0)
            continue
        blown, water, drag, said = loads.streams(moored, weather, 3, 50.0)
        assert blown.table.shape[0] == 2 and not blown.table.any() and (water, drag, said) == (None, 0.0, ())


def test_each_hull_has_its_own_wind_current_and_drag_of_a_turn(monkeypatch):
    """Gusts begin with the run, of their own seed; notes of the water are told once, and with a current alone"""
    hulls = [
        SimpleNamespace(box=SimpleNamespace(length=length), rotation_center=length / 10) for length in (80.0, 50.0)
    ]
    monkeypatch.setattr(loads, "wind_stream", lambda *given: ("wind", *given))
    monkeypatch.setattr(loads, "current_stream", lambda *given: ("current", *given))
    monkeypatch.setattr(loads, "on_all", lambda streams: streams)
    water = lambda *given: SimpleNamespace(notes=("a", "b"), given=given)  # noqa: E731
    monkeypatch.setattr(loads, "current_on", water)
    monkeypatch.setattr(loads, "turning_drag", lambda water, length: length * (water.given[1] is hulls[0].box) + 1.0)
    moored = SimpleNamespace(
        reader=SimpleNamespace(axes_at_rest=np.zeros((2, 6)), density=1e3, depth=30.0), hulls=hulls
    )
    weather = SimpleNamespace(on_hull=None, wind="wind", current="current", gusts="gusts")
    wind, current, drag, said = loads.streams(moored, weather, 3, 50.0)
    assert wind == [
        ("wind", "wind", one.box, one.rotation_center, "gusts", 3 + loads.GUSTS, 0.0, 50.0) for one in hulls
    ]
    assert current == [("current", "current", one.box, one.rotation_center, 1e3, 30.0) for one in hulls]
    assert drag.tolist() == [81.0, 1.0] and said == ("a", "b")
    still = loads.streams(moored, SimpleNamespace(on_hull=None, wind=None, current=None), 3, 50.0)
    assert still[3] == () and not still[0].table.any()

    def unknown(*_):
        raise ValueError("no coefficients")

    monkeypatch.setattr(loads, "current_on", unknown)
    with pytest.raises(SimulationError, match="no coefficients"):
        loads.streams(moored, weather, 3, 50.0)
    *rest, said = loads.streams(moored, SimpleNamespace(on_hull=None, wind="wind", current=None, gusts=None), 3, 50.0)
    assert rest[1:] == [None, 0.0] and said == ("slow motion has no drag of the water: no coefficients",)


def test_a_body_of_which_nothing_is_said_is_free_in_all_motions():
    parts = [None] * 13
    parts[4] = np.zeros(7)
    assert moored_body.Moored(*parts).free == tuple(range(7))
    assert moored_body.Moored(*parts, free=(0, 5)).free == (0, 5)


def quay(headings=(0.0, 0.5)):
    return SimpleNamespace(heading=np.array(headings), names=("fender",), arrays="arrays")


def test_the_stiffness_of_a_berth_is_less_the_slope_of_its_forces_along_the_axes_of_the_bodies(monkeypatch):
    """Of forces −K p of the places in space, columns are K times the ways along the axes; two shapes at the end"""
    K = np.random.default_rng(5).normal(size=(14, 14)) * 1e5
    monkeypatch.setattr(contacts, "berth_force", lambda berth, place: -K @ place)
    along = np.eye(14)
    c, s = np.cos(0.5), np.sin(0.5)
    along[6:8, 6:8] = [[c, -s], [s, c]]
    found = contacts.berth_stiffness(quay(), np.linspace(0.0, 1.0, 14))
    assert found == pytest.approx(K @ along, rel=1e-6, abs=1.0)


def test_forces_of_contacts_are_those_of_the_poses_about_the_headings_at_rest(monkeypatch):
    seen = []
    monkeypatch.setattr(
        contacts, "courses", lambda berth, poses, bent: seen.append((poses.copy(), bent)) or ("depth", ["forces"])
    )
    assert contacts.contact_forces(quay(), np.arange(14.0)) == "forces"
    wanted = np.arange(12.0).reshape(1, 2, 6)
    wanted[0, 1, 5] += 0.5
    assert seen[0][0] == pytest.approx(wanted) and seen[0][1].tolist() == [[12.0, 13.0]]


def test_a_body_rests_by_contacts_and_others_and_what_has_no_balance_is_told(monkeypatch):
    """A fender of 3e5 N/m against a push of 6 kN, in units of a metre and of 1/50 rad; a push alone has none"""
    monkeypatch.setattr(contacts, "contact_forces", lambda berth, place: np.array([-2e3, 1e3]))
    monkeypatch.setattr(contacts, "berth_force", lambda berth, place: -np.array([3e5, 4e9]) * place)
    unit = np.array([1.0, 1 / 50])
    found = contacts.at_rest(quay(), lambda place: np.array([6e3, 2e6]), np.zeros(2), unit)
    assert found == pytest.approx([0.02, 5e-4])
    monkeypatch.setattr(contacts, "berth_force", lambda berth, place: np.zeros(2))
    with pytest.raises(
        ValueError, match="no equilibrium of the body between its fenders and ropes was found: 20 of the"
    ):
        contacts.at_rest(quay(), lambda place: np.array([6e3, 2e6]), np.zeros(2), unit)


@pytest.mark.parametrize("failing", [(), ((),), (("a",),), ((), ("a",))])
def test_a_trial_runs_with_static_and_with_moving_lines_and_keeps_what_fails(monkeypatch, failing):
    monkeypatch.setattr(trial, "_nudged", lambda moored: ("nudged", moored))
    monkeypatch.setattr(trial, "replace", lambda settings, dynamic_lines: (settings, dynamic_lines))
    asked = []

    def run_of(body, weather, settings, seed, clock):
        asked.append((body, weather, settings, seed))
        clock.seen = [(0.0, 0.0), (0.5, 3.0)]
        if settings[1] in failing:
            raise SimulationError(f"failed {settings[1]}")
        return settings[1]

    settings = SimpleNamespace(ramp=10.0, duration=50.0)
    found, pace, failed = trial._both(run_of, "moored", "weather", settings, ("a",))
    assert found == [None if names in failing else names for names in ((), ("a",))]
    assert asked == [(("nudged", "moored"), "weather", (settings, names), 0) for names in ((), ("a",))]
    assert pace == pytest.approx([0.1, 0.1]) and [str(one) for one in failed] == [
        f"failed {names}" for names in failing
    ]


@pytest.mark.parametrize("given, drives", [
    (dict(), False), (dict(seas=("sea",)), True), (dict(forces=("force",)), True), (dict(regular="wave"), True),
    (dict(components="waves"), True), (dict(gusts="gusts"), True),
])  # fmt: skip
def test_what_drives_a_trial_varies_in_time(given, drives):
    weather = SimpleNamespace(**dict(seas=(), forces=(), regular=None, components=None, gusts=None, wind="w") | given)
    assert trial._drives(weather) == drives


@pytest.mark.parametrize("owners", [(), (1, 1, 0)])
def test_without_waves_there_is_room_for_each_body_and_each_group_of_shapes(owners, monkeypatch):
    """Of two bodies and their groups, each a row of every table, all empty, and calm water"""
    groups = Groups(np.array(owners, np.int64), np.zeros(0, np.int64))
    stand_ins = dict(
        wave_components=lambda *given: None, groups_of=lambda reader: groups, moving_of=lambda *given: None,
        streams=lambda *given: ("wind", None, "drag", ("said",)), _coarse=lambda *given: (), _of_lost=lambda given: (),
        body_lines=lambda *given: "lines", with_shapes=lambda lines, reader: lines, line_work=lambda lines: "pulls",
        body_of=lambda *given: "body", contact_work=lambda arrays: "pressed", expected_motion=lambda *given: "expected",
    )  # fmt: skip
    for name, stand_in in stand_ins.items():
        monkeypatch.setattr(run, name, stand_in)
    moored = SimpleNamespace(reader=SimpleNamespace(axes_at_rest=np.zeros((2, 6))), system=None, tables=None,
                             berth=SimpleNamespace(arrays="contacts"))  # fmt: skip
    settings = SimpleNamespace(ramp=1.0, duration=2.0, dynamic_water="still", lines_lost=(), slow_drift="newman")
    begun = run._begun(moored, SimpleNamespace(on_hull=None), settings, 0)
    table, count = begun.waves.table, 2 + len(owners)
    assert (len(table.force), len(table.omega), begun.waves.mean_drift) == (count, 0, False)
    assert begun.scene.work.window.shape[0] == count and begun.scene.work.force.shape == (6 * count,)
    assert (begun.scene.body, begun.scene.lines, begun.scene.contacts) == ("body", "lines", "contacts")
    assert begun.findings == ("said",) and begun.expected == "expected" and begun.moving is None
