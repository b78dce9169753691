"""The picture of one line, read back: its shape over the bed or below the surface, and its tension over the span."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.lines import line_command


@pytest.fixture
def drawn(monkeypatch, pictures, tmp_path):
    def call(height=20.0, floats=False, shape=((0.0, 0.0), (40.0, 5.0), (100.0, 20.0))):
        one = SimpleNamespace(
            shape=lambda span, count: np.array(shape) if (span, count) == (100.0, 400) else None, slope=0.1,
            floats=floats, depth=30.0, height=height, type=SimpleNamespace(name="R3"), state=lambda found: "hangs",
        )  # fmt: skip
        found = SimpleNamespace(tension_fairlead=5e5)
        curve = SimpleNamespace(horizontal_fairlead=np.array([1e5, 4e5]), tension_fairlead=np.array([2e5, 6e5]))
        made = np.array([90.0, 110.0]), curve
        monkeypatch.setattr(
            line_command, "tension_curve", lambda line, span: made if (line, span) == (one, 100.0) else 0
        )
        line_command.draw(SimpleNamespace(detail=(one, 100.0, found)), tmp_path / "l.png")
        return pictures[-1]

    return call


def test_a_line_is_drawn_from_its_anchor_over_the_bed_with_its_tension_beside(drawn):
    """The bed slopes by 0.1 rad and reaches 2 % beyond the span; N are kN"""
    figure = drawn()
    left, right = figure.axes
    assert figure.get_size_inches().tolist() == [12.0, 4.6]
    shape, bed, anchor, fairlead = left.lines
    assert shape.get_xydata().tolist() == [[0, 0], [40, 5], [100, 20]] and shape.get_linewidth() == 2
    assert bed.get_xydata() == pytest.approx(np.array([[0, 0], [102, 102 * np.tan(0.1)]]))
    assert (bed.get_color(), bed.get_linewidth(), bed.get_zorder()) == ("0.5", 4, 0)
    assert (anchor.get_xydata().tolist(), anchor.get_marker()) == ([[0, 0]], "^")
    assert (fairlead.get_xydata().tolist(), fairlead.get_marker()) == ([[100, 20]], "o")
    assert (left.get_xlabel(), left.get_ylabel()) == ("x from the anchor, m", "height, m")
    assert left.get_title() == "R3: hangs" and left.get_aspect() == 1.0
    along, whole, here = right.lines
    assert along.get_xydata().tolist() == [[90, 100], [110, 400]]
    assert whole.get_xydata().tolist() == [[90, 200], [110, 600]] and here.get_xydata().tolist() == [[100, 500]]
    names = [text.get_text() for text in right.get_legend().get_texts()]
    assert names == ["horizontal at the fairlead", "tension at the fairlead"]
    assert (right.get_xlabel(), right.get_ylabel(), right.get_title()) == ("span, m", "kN", "tension and offset")
    assert right.get_ylim()[0] == 0 and right.xaxis.get_gridlines()[0].get_visible()


@pytest.mark.parametrize("height, aspect", [(10.1, 1.0), (9.9, "auto")])
def test_a_line_higher_than_a_tenth_of_its_span_is_drawn_to_scale(drawn, height, aspect):
    assert drawn(height).axes[0].get_aspect() == aspect


def test_a_line_that_floats_hangs_from_the_surface_and_may_reach_behind_both_ends(drawn):
    left = drawn(floats=True, shape=((-7.0, 1.0), (0.0, 0.0), (130.0, 20.0))).axes[0]
    _, bed, surface, _, _ = left.lines
    assert bed.get_xdata().tolist() == [-7.0, 130.0]
    assert surface.get_xydata().tolist() == [[-7.0, 30.0], [130.0, 30.0]] and surface.get_linewidth() == 0.8
