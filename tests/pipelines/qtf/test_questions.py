"""When stored forces of pairs are what is asked for: each condition on both its sides."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.qtf.question import Question, waves_of


def held(floats=True, name=""):
    return SimpleNamespace(floats=floats, name=name)


ASKED = {
    "omega": 0.1 * np.arange(4, 13), "headings": np.array([0.0, np.pi / 2]), "highest": 0.3, "held": held(),
    "level": "body", "method": "auto", "waves_given": True,
}  # fmt: skip


def stored(low=3, high=13, every=1, headings=(0.0, 0.5 * np.pi, np.pi), most=0.35, **more):
    """At steps of 0.1 rad/s from low to high tenths, or at every second of them, differences up to `most`"""
    forces = SimpleNamespace(
        omega=0.1 * np.arange(low, high + 1, every), headings=np.array(headings), surface=None,
        frequency=np.array([0.0, most]),
    )  # fmt: skip
    return SimpleNamespace(**{"asked": None, "share": None, "held": held(), "method": "panel", "forces": forces} | more)


@pytest.mark.parametrize(
    "change, answered",
    [
        ({}, True),
        ({"low": 4, "high": 12}, True),
        ({"low": 5}, False),  # longer waves are asked for
        ({"high": 11}, False),  # shorter ones
        ({"every": 2}, False),  # steps half as wide
        ({"headings": (0.0, np.pi)}, False),
        ({"headings": (0.0, 0.5 * np.pi - 2 * np.pi)}, True),  # a turn is none
        ({"most": 0.25}, True),  # the last step before the largest difference
        ({"most": 0.19}, False),
        ({"held": held(floats=False)}, False),
        ({"asked": 0.3}, False),  # a run that was ended
    ],
)
def test_stored_forces_answer_a_question_that_lies_within_them(change, answered):
    assert Question(**ASKED).answered_by(stored(**change)) is answered


def test_without_waves_of_ones_own_any_that_are_stored_do_and_a_method_or_a_mooring_is_held_to():
    free = Question(**ASKED | {"waves_given": False})
    assert free.answered_by(stored(low=6, high=9))
    assert not Question(**ASKED | {"method": "contour"}).answered_by(stored())
    assert Question(**ASKED | {"method": "panel"}).answered_by(stored())
    moored = Question(**ASKED | {"held": held(name="moor.toml")})
    assert not moored.answered_by(stored()) and moored.answered_by(stored(held=held(name="moor.toml")))


@pytest.mark.parametrize("difference, allowed", [(0.1, True), (0.09, False)])
def test_the_largest_difference_is_one_step_of_the_frequencies_or_more(difference, allowed):
    db = SimpleNamespace(omega=np.array([0.3, 1.2]), wave_direction=np.array([0.0]), path="a.h5")
    if allowed:
        assert waves_of(db, [0.4, 0.5, 0.6], None, difference)[2] == pytest.approx(difference)
    else:
        with pytest.raises(ValueError, match=r"--difference is 0.09; allowed: 0.1 rad/s \(the frequency step"):
            waves_of(db, [0.4, 0.5, 0.6], None, difference)
