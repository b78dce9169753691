"""What joins at a berth: dolphins and the fenders they carry, bodies of one database, ends of links."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.common import quay_tables
from hakobune.pipelines.common.quantities import StudyError


def dolphins(*names):
    return [SimpleNamespace(name=name) for name in names]


def fenders(*on):
    return [SimpleNamespace(on=name) for name in on]


def test_every_dolphin_carries_one_fender_and_every_fender_on_one_finds_it():
    given = dolphins("A", "B")
    assert quay_tables._dolphins(fenders("B", None, "A"), given) == {"A": given[0], "B": given[1]}
    assert quay_tables._dolphins(fenders(None), []) == {}


@pytest.mark.parametrize(("on", "names", "says"), [
    (("A", "A"), ("A",), "dolphin 'A' carries 2 fenders; allowed: one"),
    (("A", "B", "B"), ("A", "B"), "dolphin 'B' carries 2 fenders"),
    (("A", "C"), ("A", "B"), "there is no dolphin 'C'; allowed: A, B"),
    (("C",), (), "there is no dolphin 'C'; allowed: none is given"),
    (("A",), ("A", "B"), "dolphin 'B' carries no fender"),
    (("A",), ("A", "A"), r"two \[\[dolphin\]\] have the same name"),
])  # fmt: skip
def test_dolphins_and_fenders_that_do_not_match_are_refused_the_second_as_the_first(on, names, says):
    with pytest.raises(StudyError, match=says):
        quay_tables._dolphins(fenders(*on), dolphins(*names))


@pytest.mark.parametrize(("fender", "rope", "says"), [
    (("", "b"), ("", ""), "fender f: body 'b' is given"), (("a", ""), ("", ""), "fender f: body 'a' is given"),
    (("", ""), ("", "b"), "rope r: body 'b' is given"), (("", ""), ("a", "b"), "rope r: body 'a' is given"),
])  # fmt: skip
def test_parts_of_one_body_name_no_body_at_either_end(fender, rope, says):
    one, other = (SimpleNamespace(name=name, body=ends[0], to=ends[1]) for name, ends in (("f", fender), ("r", rope)))
    with pytest.raises(StudyError, match=says):
        quay_tables.berth_of_tables([one], [], [other], None, (0.0, 0.0, 0.0))


@pytest.mark.parametrize(("point", "inside"), [
    ((0.0, 0.0, 0.0), True), ((19.9, 4.9, 2.9), True), ((-19.9, -4.9, -5.9), True), ((20.1, 0.0, 0.0), False),
    ((0.0, -5.1, 0.0), False), ((0.0, 0.0, 3.1), False), ((0.0, 0.0, -6.1), False), ((-20.1, 0.0, 0.0), False),
])  # fmt: skip
def test_a_point_lies_in_the_box_of_a_hull_of_half_its_length_and_beam(point, inside):
    hull = SimpleNamespace(length=40.0, beam=10.0, draft=6.0, freeboard=3.0, is_round=False)
    assert quay_tables._inside(point, hull) is inside


@pytest.mark.parametrize(("body", "to", "says"), [
    ("quay", "", "body is 'quay'; allowed: a body that moves, a, b"),
    ("a", "a", "to = 'a'; allowed: the name of another body, b, quay"),
    ("a", "c", "to = 'c'; allowed: the name of another body, b, quay"),
])  # fmt: skip
def test_ends_are_a_body_that_moves_and_another_or_none(body, to, says):
    bodies = {"a": "A", "b": "B", "quay": "Q"}
    with pytest.raises(StudyError, match=says):
        quay_tables._ends("rope r", SimpleNamespace(body=body, to=to), ["a", "b"], bodies)


def test_ends_are_those_of_the_names():
    bodies = {"a": "A", "b": "B", "quay": "Q"}
    ends = [("a", "b", ("A", "B")), ("b", "quay", ("B", "Q")), ("a", "", ("A", None))]
    for body, to, wanted in ends:
        assert quay_tables._ends("x", SimpleNamespace(body=body, to=to), ["a", "b"], bodies) == wanted


def database(*fixed):
    """Bodies a, b and quay, of which those named are fixed; of none, one body alone"""
    return SimpleNamespace(bodies=[SimpleNamespace(name=name, fixed=name in fixed) for name in ("a", "b", "quay")])


@pytest.mark.parametrize(("bodies", "given"), [
    (("a", "c"), "'c'"), (("a", "a"), "'a' and 'a'"), (("quay", "space"), "'quay' and 'space'"), (("c", "d"), "'c'"),
])  # fmt: skip
def test_a_hinge_joins_two_bodies_of_which_one_moves(bodies, given):
    hinge = quay_tables.HingeTable("pin", bodies, (0.0, 0.0, 0.0))
    says = rf"hinges\[0\]\.bodies has {given}; allowed: two different names of a, b, quay, space"
    with pytest.raises(StudyError, match=says):
        hinge.link("hinges[0]", database("quay"))


@pytest.mark.parametrize(("names", "twice"), [(("p", "q"), None), (("p", "q", "q"), "q"), (("p", "q", "p"), "p")])
def test_hinges_have_names_of_their_own(monkeypatch, names, twice):
    joined = []
    body = SimpleNamespace(linked=lambda links: joined.append(links) or "linked")

    def hinge(name):
        return SimpleNamespace(link=lambda where, db: SimpleNamespace(name=name, where=where))

    hinges = [hinge(name) for name in names]
    if twice is not None:
        with pytest.raises(StudyError, match=rf"two hinges are called '{twice}'"):
            quay_tables.linked(body, hinges, None)
        return
    assert quay_tables.linked(body, hinges, None) == "linked" and quay_tables.linked(body, [], None) is body
    assert [one.where for one in joined[0]] == ["hinges[0]", "hinges[1]"]
