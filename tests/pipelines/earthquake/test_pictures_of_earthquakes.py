"""The picture of an earthquake, read back: the normalised reaction of every stiffness, and the course of a record."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common import picture
from hakobune.pipelines.earthquake import command
from hakobune.pipelines.results.quantity import Quantity


class Stored(dict):
    """Values of a result by name, with labels and a detail"""

    def __init__(self, values, labels, detail):
        super().__init__(values)
        self.labels = {axis: Quantity(np.asarray(one), (axis,), "", "") for axis, one in labels.items()}
        self.detail = detail


@pytest.fixture
def drawn(monkeypatch):
    kept = []
    monkeypatch.setattr(picture, "save", lambda *given: kept.append(given))

    def call(course):
        detail = SimpleNamespace(normalised=lambda T, k: k * T**2)
        labels = {"stiffness": ["first slope", "1 m"], "time": [0.0, 1.0, 2.0]}
        command._draw(Stored({"stiffness.value": np.array([3e6, 2e6])} | course, labels, detail), "q.png")
        ((figure, path, dpi),) = kept
        assert (path, dpi) == ("q.png", 110)
        return figure

    return call


def words(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_the_reaction_of_each_stiffness_is_drawn_over_the_period_from_a_tenth_of_a_second_to_fifty(drawn):
    figure = drawn({})
    assert figure.get_size_inches().tolist() == [8.0, 4.5]
    (axes,) = figure.axes
    first, second, seismic = axes.lines
    T = first.get_xdata()
    assert len(T) == 400 and T[[0, -1]] == pytest.approx([0.1, 50.0])
    assert T[1:] / T[:-1] == pytest.approx(np.full(399, 500 ** (1 / 399)))  # even in the logarithm
    assert second.get_xdata().tolist() == T.tolist()
    assert first.get_ydata() == pytest.approx(3e6 * T**2) and second.get_ydata() == pytest.approx(2e6 * T**2)
    assert list(seismic.get_ydata()) == [1.0, 1.0] and (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert (seismic.get_color(), seismic.get_linestyle(), seismic.get_linewidth()) == ("grey", ":", 0.8)
    assert words(axes) == ["first slope", "1 m", "seismic coefficient"]
    assert axes.get_legend().get_title().get_text() == "stiffness of the dolphins at"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("period of the ground, s", "reaction/(ω² y M)")
    assert all(one.get_visible() and one.get_alpha() == 0.3 for one in (axes.xaxis.get_gridlines()))


def test_a_record_has_ground_and_body_in_metres_and_the_reaction_in_kilonewtons(drawn):
    course = {"course.ground": [0.0, 0.1, 0.0], "course.body": [0.0, 0.05, 0.02]}
    course = {name: np.array(one) for name, one in course.items()} | {"course.reaction": np.array([0.0, 5e5, -2e5])}
    figure = drawn(course)
    assert figure.get_size_inches().tolist() == [8.0, 9.0] and len(figure.axes) == 3
    _, moved, pushed = figure.axes
    ground, body = moved.lines
    assert ground.get_xdata().tolist() == body.get_xdata().tolist() == [0, 1, 2] and words(moved) == ["ground", "body"]
    assert (ground.get_ydata().tolist(), body.get_ydata().tolist()) == ([0.0, 0.1, 0.0], [0.0, 0.05, 0.02])
    (reaction,) = pushed.lines
    assert reaction.get_xdata().tolist() == [0, 1, 2] and reaction.get_ydata().tolist() == [0.0, 500.0, -200.0]
    assert moved.get_ylabel() == "displacement, m"
    assert (pushed.get_ylabel(), pushed.get_xlabel()) == ("reaction on the dolphins, kN", "time, s")
