"""A row of a file of rules is read whole: each of its words is one that is known, and no text is empty."""

import pytest

from hakobune.mooring.criteria.rules import RuleError, _criterion, _number

ROW = {
    "rule": "owner", "edition": "2026", "quantity": "tension / breaking load", "sense": "at most", "limit": "1/2",
    "second": "", "unit": "-", "state": "normal", "lines": "intact", "analysis": "dynamic", "subject": "chain",
    "statistic": "largest", "motion_factor": "", "source": "letter", "status": "read",
}  # fmt: skip


def test_a_sound_row_is_a_criterion_with_its_fraction():
    one = _criterion("a.csv, criterion 1", ROW)
    assert (one.limit, one.second, one.motion_factor, one.unit) == (0.5, None, 1.0, "-")
    more = _criterion("a.csv, criterion 1", ROW | {"second": "0.7", "motion_factor": "1.5"})
    assert (more.second, more.motion_factor) == (0.7, 1.5)


@pytest.mark.parametrize("key, allowed", [
    ("sense", "at least, at most"), ("state", "normal, abnormal, any"), ("lines", "intact, one lost, transient, any"),
    ("analysis", "quasi-static, dynamic, any"), ("status", "read, secondary, unverified"),
])  # fmt: skip
def test_every_word_of_a_row_is_one_of_those_that_are_known(key, allowed):
    for word in allowed.split(", "):
        assert getattr(_criterion("here", ROW | {key: word}), key) == word
    with pytest.raises(RuleError) as refused:
        _criterion("a.csv, criterion 2", ROW | {key: "often"})
    assert str(refused.value) == f"a.csv, criterion 2: {key} is 'often'; allowed: {allowed}"


@pytest.mark.parametrize("key", ["rule", "quantity", "source"])
def test_no_text_of_a_row_that_it_needs_is_empty(key):
    for empty in ("", "  ", None):
        with pytest.raises(RuleError, match=f"here: {key} is empty; give a text"):
            _criterion("here", ROW | {key: empty})


@pytest.mark.parametrize("key", ["limit", "second", "motion_factor"])
@pytest.mark.parametrize("text", ["x", "0", "-1", "1/0", "inf"])
def test_numbers_of_a_row_are_above_nothing(key, text):
    with pytest.raises(RuleError, match=f"here: {key} is "):
        _criterion("here", ROW | {key: text})


def test_a_number_that_is_not_there_is_refused_as_one_that_is_none():
    assert [_number("here", "limit", text) for text in ("2.5", "1/3", "3/1.5")] == pytest.approx([2.5, 1 / 3, 2.0])
    for text in (None, "", "/", "1/0", "-2", "inf", "1/inf", "a"):
        with pytest.raises(RuleError, match=f"here: limit is {text!r}; allowed: a number above 0, or a fraction"):
            _number("here", "limit", text)
