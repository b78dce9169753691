"""Which cause is taken and when none is, on sets that are their own difference from our solution, a number."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.formats.judging import believed, causes
from hakobune.bem.formats.judging.causes import Cause
from hakobune.bem.formats.values import FormatError


class Set(float):
    """A set that differs by so much; of deep water unless it says otherwise"""

    water_depth = np.inf


class Shallow(Set):
    water_depth = 12.0


def leaves(number, text="", way=""):
    return Cause(text or f"leaves {number}", lambda values: Set(number), way)


@pytest.fixture(autouse=True)
def without_depths(monkeypatch):
    monkeypatch.setattr(causes, "_of_depth", lambda values, own: (None, np.inf))


@pytest.fixture
def taken(monkeypatch):
    """taken(set, causes, own) : `Finding`; of an own solution that is a number that is the difference"""
    monkeypatch.setattr(causes, "gaps", lambda values, own: {"small": 0.0, "force": own if own else float(values)})
    asked = []

    def call(values, given, own=None):
        def each(values, own):
            for one in given:
                asked.append(one.text)
                yield one

        asked.clear()
        monkeypatch.setattr(causes, "_causes", each)
        return causes._finding(values, own)

    call.asked = asked
    return call


def test_a_difference_up_to_a_tenth_is_none(taken):
    assert taken(Set(0.1), []) is None and taken(Set(0.101), []).gap == 0.101


@pytest.mark.parametrize("gap, left, named, nearest", [
    (0.3, 0.149, True, ""), (0.3, 0.151, False, ""),  # half of it
    (1.0, 0.249, True, ""), (1.0, 0.251, False, "leaves 0.251"),  # two and a half times what agrees
])  # fmt: skip
def test_a_cause_leaves_half_of_a_difference_and_a_quarter_at_most(taken, gap, left, named, nearest):
    found = taken(Set(gap), [leaves(left)])
    assert (found.cause is not None) is named and found.nearest == nearest and found.left == left
    assert (found.gap, found.quantity) == (gap, "force")


def test_a_later_cause_has_to_leave_less_than_four_fifths(taken):
    for second, text in ((0.161, "leaves 0.2"), (0.159, "leaves 0.159")):
        assert taken(Set(1.0), [leaves(0.2), leaves(second)]).cause.text == text
    assert taken(Set(1.0), [leaves(1.5), leaves(0.9)]).left == 0.9


def test_what_leaves_less_than_a_fiftieth_is_the_last_tried(taken):
    taken(Set(1.0), [leaves(0.021), leaves(0.001)])
    assert taken.asked == ["leaves 0.021", "leaves 0.001"]
    taken(Set(1.0), [leaves(0.019), leaves(0.001)])
    assert taken.asked == ["leaves 0.019"]


def test_deep_water_is_tried_where_nothing_agrees_and_the_set_is_of_shallow(taken):
    for deep, left, text in (
        (0.159, 0.159, "the set is for deep water, not for a depth of 12 m"),
        (0.161, 0.2, "leaves 0.2"),
    ):
        own = SimpleNamespace(in_water=lambda depth, deep=deep: deep * (1.0 if np.isinf(depth) else 9.0))
        causes.gaps, plain = (lambda v, o: {"force": o if isinstance(o, float) else float(v)}), causes.gaps
        found = taken(Shallow(1.0), [leaves(0.2)], own)
        assert (found.left, found.cause.text) == (left, text)
        assert found.cause.way_out == ("--depth inf" if left == deep else "")
        assert taken(Set(1.0), [leaves(0.2)], own).cause.text == "leaves 0.2"
        assert taken(Shallow(1.0), [leaves(0.09)], own).cause.text == "leaves 0.09"
        causes.gaps = plain


def found_in(gap, left=np.inf, cause=None):
    return causes.Finding(gap, "force", cause, left)


@pytest.mark.parametrize("first, sharp, gap", [
    (found_in(1.9), found_in(1.0), 1.0), (found_in(1.9), found_in(1.95), 1.9), (found_in(2.1), found_in(1.0), 2.1),
    (found_in(1.9), None, None), (None, found_in(5.0), None),
])  # fmt: skip
def test_a_difference_up_to_twice_the_size_may_be_of_panels(monkeypatch, first, sharp, gap):
    """It is looked at with four nodes a panel, whose difference counts where it is less"""
    monkeypatch.setattr(causes, "_finding", lambda values, own: first if own.nodes == 1 else sharp)
    monkeypatch.setattr(causes, "_two", lambda values, own: (None, np.inf))
    own = SimpleNamespace(nodes=1, sharper=lambda: SimpleNamespace(nodes=4))
    found = causes.finding(None, own)
    assert found is None if gap is None else found.gap == gap


@pytest.mark.parametrize("one, left, two, taken", [
    (None, np.inf, 0.099, True), (None, np.inf, 0.101, False),  # they agree
    ("a", 0.2, 0.059, True), ("a", 0.2, 0.061, False),  # three tenths of what one cause leaves
    ("a", 0.099, 0.001, False),  # one is enough
])  # fmt: skip
def test_two_causes_agree_and_leave_less_than_three_tenths_of_one(monkeypatch, one, left, two, taken):
    first = found_in(5.0, left, one and leaves(left))
    monkeypatch.setattr(causes, "_finding", lambda values, own: first)
    monkeypatch.setattr(causes, "_two", lambda values, own: ("both", two))
    found = causes.finding(None, None)
    assert (found.cause == "both") is taken and found.left == (two if taken else left)


def test_two_causes_have_to_halve_the_difference(monkeypatch):
    monkeypatch.setattr(causes, "_two", lambda values, own: ("both", 0.09))
    for gap, taken in ((0.181, True), (0.179, False)):
        monkeypatch.setattr(causes, "_finding", lambda values, own, gap=gap: found_in(gap))
        own = SimpleNamespace(sharper=lambda: None)
        assert (causes.finding(None, own).cause == "both") is taken


def pair(monkeypatch, units, directions=(), points=(), water=()):
    """`_two` of groups of causes that leave a share, or what a function makes, of what there is"""
    monkeypatch.setattr(causes, "gaps", lambda values, own: {"force": float(values), "other": 0.0})

    def group(shares):
        return lambda values, own: [
            Cause(f"{share}", lambda v, share=share: Set(share(v) if callable(share) else v * share), way)
            for share, way in shares
        ]

    for name, given in (("units", units), ("directions", directions), ("points", points), ("water", water)):
        monkeypatch.setattr(causes, f"_about_{name}", group(given))
    return causes._two(Set(1.0), None)


def test_the_first_of_two_causes_helps_by_a_fifth_unless_it_is_a_unit(monkeypatch):
    """A unit may only help with a point; both ways out are told where both have one"""

    def after_it(v):
        return 0.05 * v if v < 0.95 else v

    cause, left = pair(monkeypatch, [(0.9, "--a")], points=[(after_it, "--b")])
    assert left == pytest.approx(0.045) and cause.text.startswith("two causes: 0.9; and then ")
    assert cause.way_out == "--a and --b" and float(cause.correct(Set(0.8))) == pytest.approx(0.036)
    for ways in (("", "--b"), ("--a", "")):
        assert pair(monkeypatch, [(0.9, ways[0])], points=[(after_it, ways[1])])[0].way_out == ""
    assert pair(monkeypatch, [], directions=[(0.9, "")], points=[(after_it, "")])[0] is None
    cause, left = pair(monkeypatch, [], directions=[(0.81, "")], points=[(0.85, "")])
    assert cause is None and left == np.inf
    cause, left = pair(monkeypatch, [], directions=[(0.79, "")], points=[(0.85, "")])
    assert cause.text == "two causes: 0.79; and then 0.79"  # 0.62; another has to be clearly less
    cause, left = pair(monkeypatch, [], directions=[(0.5, "")], water=[(0.3, "")])
    assert cause.text == "two causes: 0.3; and then 0.5" and left == pytest.approx(0.15)


@pytest.mark.parametrize("nearest, end", [
    ("forces are halved", "and no pair of such changes does; the best guess, forces are halved, leaves 12.3 %"),
    ("", "and no pair of such changes does"),
])  # fmt: skip
def test_what_nothing_explains_is_told_with_the_best_guess_before_other_doubts(monkeypatch, nearest, end):
    found = causes.Finding(0.4567, "added_mass", None, 0.1234, nearest)
    monkeypatch.setattr(believed.laws, "doubts", lambda values: (["a doubt"], ["a law"]))
    for name, value in (("own_of", "own"), ("sample", "some"), ("finding", found)):
        monkeypatch.setattr(believed, name, lambda *given, value=value: value)
    values, told, doubts = believed.believed("values", ())
    assert (values, told, doubts[1:]) == ("values", [], ["a doubt"])
    assert doubts[0] == (
        "added mass differs from our own solution of the hull by 45.7 %, allowed: 10 %; no change of unit, point, "
        "sign, heading or depth explains it, " + end
    )


@pytest.mark.parametrize("way_out, end", [("", None), ("--depth as in that solution (about 25)", "(about 25)")])
@pytest.mark.parametrize("correct", [False, True])
def test_a_number_that_is_no_convention_never_corrects_a_set(monkeypatch, correct, way_out, end):
    """A factor of 0.76 is told as a guess, and the set stored as it is; a depth is refused with its flag"""
    cause = Cause("damping are 0.7635 times as large", lambda one: "wrong", way_out, fitted=True)
    found = causes.Finding(0.3, "radiation_damping", cause, 0.02)
    monkeypatch.setattr(believed.laws, "doubts", lambda values: ([], []))
    for name, value in (("own_of", "own"), ("sample", "some"), ("finding", found)):
        monkeypatch.setattr(believed, name, lambda *given, value=value: value)
    if end:
        with pytest.raises(FormatError) as error:
            believed.believed("values", (), correct)
        assert str(error.value).endswith(end) and "--correct" not in str(error.value)
        return
    values, told, doubts = believed.believed("values", (), correct)
    assert (values, told) == ("values", [])
    assert "the best guess, damping are 0.7635 times as large, which is no unit and no convention" in doubts[0]


@pytest.mark.parametrize("panels, others, why", [
    (2500, 0, "no frequency belongs to a long wave"),
    (2501, 0, "the hull has 2501 panels, and this check solves at most 2500"),
    (2501, 1, "there are other bodies beside it"),
])  # fmt: skip
def test_why_a_set_is_not_compared_is_told(monkeypatch, panels, others, why):
    monkeypatch.setattr(believed.laws, "doubts", lambda values: (["a doubt"], ["one", "two"]))
    monkeypatch.setattr(believed, "own_of", lambda values, mesh: None)
    values = SimpleNamespace(others=others)
    assert believed.believed(values, range(panels)) == (
        values, [f"the files are not compared with our own solution: {why}; laws tested: one, two"], ["a doubt"]
    )  # fmt: skip


@pytest.mark.parametrize("way_out, way", [
    ("--about 0,0,1", "give --about 0,0,1, or import with --correct to store the set so corrected"),
    ("", "import with --correct to store the set so corrected"),
])  # fmt: skip
def test_a_recognised_error_is_refused_with_its_way_out(monkeypatch, way_out, way):
    found = causes.Finding(0.5, "radiation_damping", Cause("a cause", lambda one: "right", way_out), 0.0, "")
    monkeypatch.setattr(believed.laws, "doubts", lambda values: ([], []))
    for name, value in (("own_of", "own"), ("sample", "some"), ("finding", found), ("corrected", "right")):
        monkeypatch.setattr(believed, name, lambda *given, value=value: value)
    with pytest.raises(FormatError) as refused:
        believed.believed("values", ())
    assert str(refused.value) == (
        f"radiation damping differs from our own solution of the hull by 50 %, allowed: 10 %: a cause; {way}"
    )
    assert believed.believed("values", (), correct=True) == (
        "right", ["the files are corrected: a cause; their motions and drift are left out"], []
    )  # fmt: skip
