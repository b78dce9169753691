"""Fenders, dolphins and ropes of a berth as a study gives them: which side they stand before, of which of two hulls."""

from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.pipelines.common import quay_tables
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.quay_tables import DolphinTable, QuayFenderTable, RopeTable

HULL = SimpleNamespace(length=100.0, beam=40.0, draft=8.0, freeboard=6.0, is_round=False)


@pytest.mark.parametrize(
    ("face", "normal", "half"),
    [
        ((30.0, 20.5, 2.0), (0, 1, 0), 20.0), ((30.0, -30.0, -8.0), (0, -1, 0), 20.0),
        ((-55.0, 3.0, 6.0), (-1, 0, 0), 50.0), ((60.0, -20.0, 0.0), (1, 0, 0), 50.0),
        ((50.0, 19.0, 0.0), (1, 0, 0), 50.0),
    ],
)  # fmt: skip
def test_a_fender_is_met_by_the_side_that_it_stands_before(face, normal, half):
    found = quay_tables._side("fender", np.array(face), HULL)
    assert (found[0].tolist(), found[1]) == (list(normal), half)


@pytest.mark.parametrize("face", [(30.0, 30.1, 2.0), (30.0, 21.0, 6.1), (30.0, 21.0, -8.1), (51.0, 21.0, 0.0)])
def test_a_fender_that_no_side_reaches_is_refused(face):
    with pytest.raises(StudyError, match=r"cannot reach .* 100 × 40 m, at most 10 m from it, with z from -8 to 6 m"):
        quay_tables._side("fender", np.array(face), HULL)


@pytest.mark.parametrize(
    ("point", "inside"),
    [((49.9, 19.9, 5.9), True), ((-49.9, -19.9, -7.9), True), ((50.1, 0, 0), False), ((0, -20.1, 0), False),
     ((0, 0, 6.1), False), ((0, 0, -8.1), False)],
)  # fmt: skip
def test_a_point_lies_inside_the_box_of_a_hull(point, inside):
    assert quay_tables._inside(np.array(point), HULL) == inside


def placed(name, x, y, heading=0.0):
    """A hull that moves, in its place"""
    angle = np.radians(heading)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    away = np.array([x, y, 0.0])
    hull = SimpleNamespace(name=name, box=HULL, own=lambda point: turn.T @ (np.asarray(point) - away))
    return hull, SimpleNamespace(name=name, in_scene=lambda point: turn @ np.asarray(point) + away)


FENDER = QuayFenderTable(name="F", position=(10.0, 20.5, 1.0), height=1.0, table="t", body="ship", to="barge")
ROPE = SimpleNamespace(name="R")


@pytest.fixture
def between(monkeypatch):
    """Numbers that `berth_of` is given of a ship at the origin and a barge that heads astern abeam of it"""
    (ship, one), (barge, other) = placed("ship", 0.0, 0.0), placed("barge", 5.0, 41.0, 180.0)
    pier = SimpleNamespace(name="pier", in_scene=lambda point: np.asarray(point) + (0.0, -30.0, 0.0))
    monkeypatch.setattr(quay_tables, "_fender", lambda where, table, dolphin, box: Made(table, dolphin, box))
    monkeypatch.setattr(quay_tables, "_rope", lambda table: table)
    monkeypatch.setattr("hakobune.mooring.motion.contacts.berth_of", lambda *given: given)
    monkeypatch.setattr(quay_tables, "replace", lambda made, face: (made, face.tolist()))

    def call(fenders=(), ropes=(), nearer=False):
        wide = SimpleNamespace(**vars(HULL) | {"beam": 44.0})
        ship.box = barge.box = wide if nearer else HULL
        return quay_tables.berth_between(fenders, (), ropes, [ship, barge], [one, other, pier])

    return call


class Made(tuple):
    def __new__(cls, *parts):
        return super().__new__(cls, parts)


def test_a_fender_of_another_hull_is_given_in_its_coordinates_and_met_in_those_of_the_first(between):
    """At (10, 20.5) of the barge, which heads astern at (5, 41): at (−5, 20.5) of the scene, and of the ship"""
    made, ropes, center, hulls, ends = between([FENDER])
    ((table, dolphin, box), face) = made[0]
    assert table.position == pytest.approx((-5.0, 20.5, 1.0)) and face == pytest.approx([-5.0, 20.5, 1.0])
    assert (table.body, table.to, dolphin, box, ropes, center) == ("", "", None, HULL, [], None)
    assert ends == [(0, 1)] and [one.name for one in hulls] == ["ship", "barge"]
    made, *_, ends = between([msgspec.structs.replace(FENDER, body="barge", to="pier", position=(10.0, 50.0, 1.0))])
    (((table, _, _), face),) = made
    assert face == pytest.approx([10.0, 20.0, 1.0]) and table.position == pytest.approx((-5.0, 21.0, 1.0))
    assert ends == [(1, -1)]


def test_a_rope_goes_from_its_body_to_a_bollard_on_another_or_ashore(between):
    class Rope(msgspec.Struct):
        name: str
        body: str
        to: str
        fairlead: tuple
        bollard: tuple

    rope = Rope("R", "barge", "ship", (-45.0, 20.0, 6.0), (40.0, 20.0, 5.0))
    _, (made, ashore), _, _, ends = between((), [rope, msgspec.structs.replace(rope, to="")])
    assert made.fairlead == pytest.approx((50.0, 21.0, 6.0)) and made.bollard == pytest.approx((40.0, 20.0, 5.0))
    assert ends == [(1, 0), (1, -1)] and ashore.bollard == (40.0, 20.0, 5.0)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"body": "pier"}, "body is 'pier'; allowed: a body that moves, ship, barge"),
        ({"to": "ship"}, "to = 'ship'; allowed: the name of another body, barge, pier; or leave the key out"),
        ({"to": "quay"}, "to = 'quay'; allowed: the name of another body"),
        ({"position": (10.0, 21.5, 1.0)}, "lies inside both ship and barge, at -5, 19.5, 1 m in the axes of the scene"),
        ({"position": (10.0, 20.9, 1.0)}, None),
    ],
)
def test_ends_that_are_no_bodies_and_fenders_within_two_hulls_are_refused(monkeypatch, between, change, says):
    if says is None:
        between([msgspec.structs.replace(FENDER, **change)])
        return
    with pytest.raises(StudyError) as refused:
        between([msgspec.structs.replace(FENDER, **change)], nearer=says.startswith("lies"))
    assert says in str(refused.value)


def test_dolphins_carry_one_fender_each():
    def fenders(*on):
        return [SimpleNamespace(on=one) for one in on]

    one, two = (DolphinTable(name=name, stiffness=1.0) for name in "ab")
    assert quay_tables._dolphins(fenders("a", None, "b"), [one, two]) == {"a": one, "b": two}
    for given, dolphins, says in (
        (fenders("a", "a"), [one], "dolphin 'a' carries 2 fenders"), (fenders("a"), [one, two], "'b' carries no"),
        (fenders("c"), [one], "there is no dolphin 'c'; allowed: a"), (fenders("a"), [one, one], "have the same "
        "name; give each a name of its own"),
    ):  # fmt: skip
        with pytest.raises(StudyError, match=says):
            quay_tables._dolphins(given, dolphins)


@pytest.mark.parametrize("y, inside", [(19.9, True), (20.1, False)])
def test_a_bollard_in_the_hull_is_refused(y, inside):
    rope = RopeTable(name="R", fairlead=(30.0, -20.0, 5.0), bollard=(30.0, y, 4.0), breaking_load_kN=800.0,
                     break_strain=0.1)  # fmt: skip
    made = lambda: quay_tables.berth_of_tables([], [], [rope], HULL, np.zeros(3))  # noqa: E731
    if not inside:
        assert len(made().ropes) == 1
        return
    with pytest.raises(StudyError, match=r"rope R: its bollard \(30, 19\.9, 4\) m lies in the hull, 100 by 40 m, z"):
        made()


def test_a_round_hull_has_no_corners_for_bollards():
    disc = SimpleNamespace(**vars(HULL) | {"length": 40.0, "is_round": True})
    assert quay_tables._inside(np.array([14.0, 14.0, 0.0]), disc)
    assert not quay_tables._inside(np.array([14.2, 14.2, 0.0]), disc)


def rope(fairlead, bollard):
    return SimpleNamespace(name="R", fairlead=fairlead, bollard=bollard)


def fender(x, y):
    return SimpleNamespace(name="F", position=(x, y, 1.0))


@pytest.mark.parametrize(("fairlead", "bollard", "told"), [
    ((30.0, 20.0, 5.0), (30.0, -35.0, 4.0), True), ((30.0, 20.0, 5.0), (30.0, 35.0, 4.0), False),
    ((30.0, 20.0, 7.0), (30.0, -35.0, 7.0), False),  # over the deck
    ((49.0, 5.0, 5.0), (55.0, -5.0, 5.0), False), ((49.0, 5.0, 5.0), (50.9, -5.0, 5.0), True),  # before the bow
])  # fmt: skip
def test_a_rope_through_the_hull_to_its_other_side_is_told(fairlead, bollard, told):
    said = list(quay_tables.doubtful_holds([], [rope(fairlead, bollard)], HULL, False))
    assert len(said) == told and all("to a bollard on its other side: R; allowed: none" in line for line in said)


@pytest.mark.parametrize(("fenders", "ropes", "held", "told"), [
    ([fender(0, 20.5)], (), False, True), ([fender(0, 20.5), fender(9, 20.5)], (), False, True), ([], (), False, False),
    ([fender(0, 20.5), fender(0, -20.5)], (), False, False), ([fender(0, 20.5)], (), True, False),
    ([fender(0, 20.5)], [rope((0, 20, 5), (0, 40, 5))], False, False),
])  # fmt: skip
def test_fenders_of_one_side_alone_hold_nothing(fenders, ropes, held, told):
    said = list(quay_tables.doubtful_holds(fenders, ropes, HULL, held))
    assert len(said) == told
    assert all(f"{len(fenders)} of {len(fenders)} push to one side" in line for line in said)
