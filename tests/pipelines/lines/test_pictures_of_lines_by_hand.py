"""Pictures of lines by hand: colours of tensions, marks of points, curves, losses, frames and films."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from hakobune.mooring.lines.multi_segment.bed import Bed
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, CompositeLine
from hakobune.mooring.lines.system.shapes import line_shapes
from hakobune.pipelines.lines import pictures


@pytest.fixture(scope="module")
def two():
    """Two lines from points in the water to anchors, of which the second is drawn tighter and has a bed of its own"""
    parts = (Segment(150.0, 900.0, 5e8), Segment(150.0, 900.0, 5e8))
    bed = Bed(np.array([[0.0, 0.0], [300.0, -20.0]]), 0.0)
    points = Anchor("A", (0.0, 0.0, -100.0)), Anchor("F", (260.0, 0.0, 0.0)), Anchor("G", (0.0, 282.0, 0.0))
    slack = CompositeLine("slack", parts, "A", "F")
    taut = CompositeLine("taut", parts, "A", "G", (PointLoad(150.0, -2e4),), bed=bed)
    return rest(System(100.0, (slack, taut), points))


def axes():
    return Figure().add_subplot()


def kept(monkeypatch):
    found = []
    monkeypatch.setattr(pictures, "save", lambda figure, path, dpi: found.append((figure, path)))
    return found


def curve(direction=np.pi / 2, size=1.0):
    tension = size * np.array([[1e5, 2e5], [4e5, 3e5]])
    return SimpleNamespace(direction=direction, offset=np.array([0.0, 5.0]), restoring=size * np.array([0.0, 5e5]),
                           tension=tension, body="ship")  # fmt: skip


def test_a_plan_is_in_x_and_y_and_a_profile_in_x_and_z_with_lines_in_one_scale_of_tension(two, monkeypatch):
    found = kept(monkeypatch)
    pictures.draw_system(two, "p.png")
    ((figure, path),) = found
    plan, profile, bar = figure.axes
    assert path == "p.png" and (plan.get_xlabel(), plan.get_ylabel()) == ("x, m", "y, m")
    assert (profile.get_xlabel(), profile.get_ylabel(), plan.get_title()) == ("x, m", "z, m", "plan")
    shapes = line_shapes(two)
    for axis, (i, j) in ((plan, (0, 1)), (profile, (0, 2))):
        for line, shape in zip(axis.lines, shapes, strict=False):
            assert line.get_xydata() == pytest.approx(shape[:, [i, j]])
    assert bar.get_ylabel() == "tension, kN" and bar.get_ylim() == pytest.approx((0.0, two.tension.max() / 1e3))
    assert two.tension[1] > 1.1 * two.tension[0]
    dark, light = (sum(line.get_color()[:3]) for line in (plan.lines[1], plan.lines[0]))
    assert dark < light  # the largest tension is darkest
    assert [text.get_text() for text in plan.texts] == ["slack", "taut"]
    middle = [text.xy for text in plan.texts]
    assert np.array(middle) == pytest.approx(np.array([shape[len(shape) // 2, :2] for shape in shapes]))
    flat = [tuple(line.get_ydata()) for line in profile.lines if len(line.get_ydata()) == 2]
    assert (-100.0, -100.0) in flat and (0.0, 0.0) in flat  # the bed and the surface


def test_points_are_marked_by_what_they_are_and_loads_on_lines_too(two):
    axis = axes()
    pictures._draw_points(axis, two, 0, 2)
    *points, hung = axis.lines
    assert [line.get_marker() for line in points] == ["^"] * 3 and hung.get_marker() == "o"
    assert np.array([line.get_xydata()[0] for line in points]) == pytest.approx(two.points[:, [0, 2]])
    assert len(hung.get_xydata()) == 1


def test_a_bed_of_its_own_is_drawn_beside_that_of_the_system_where_a_line_lies_on_it(two):
    axis = axes()
    pictures._draw_beds(axis, two)
    flat, own = axis.lines
    assert list(flat.get_ydata()) == [-100.0, -100.0] and own.get_ydata()[0] == pytest.approx(-100.0)
    assert own.get_ydata()[-1] == pytest.approx(-100.0 - 282.0 * 20 / 300, rel=1e-6)
    assert [text.get_text() for text in axis.get_legend().get_texts()] == ["own bed of a line"]


@pytest.mark.parametrize(("count", "named"), [(40, 40), (41, 0)])
def test_up_to_forty_lines_are_named(count, named):
    axis, shapes = axes(), [np.full((3, 3), float(i)) for i in range(count)]
    pictures._name_lines(axis, [f"line {i}" for i in range(count)], shapes)
    assert len(axis.texts) == named


@pytest.mark.parametrize(("x", "y", "wanted"), [
    ((0.0, 100.0), (4.0, 6.0), ((0.0, 100.0), (-7.5, 17.5))), ((1.0, 3.0), (0.0, 80.0), ((-8.0, 12.0), (0.0, 80.0))),
    ((0.0, 100.0), (0.0, 50.0), ((0.0, 100.0), (0.0, 50.0))),
])  # fmt: skip
def test_the_shorter_side_of_a_plan_is_a_quarter_of_the_longer_at_least(x, y, wanted):
    axis = axes()
    axis.set(xlim=x, ylim=y)
    pictures._widen(axis)
    assert (axis.get_xlim(), axis.get_ylim()) == (pytest.approx(wanted[0]), pytest.approx(wanted[1]))


def test_curves_are_in_kilonewtons_with_the_largest_tension_of_all_lines_in_their_colour():
    axis = axes()
    pictures._draw_curves(axis, [curve(), curve(0.0, 2.0)])
    one, largest, other, further = axis.lines
    assert one.get_xydata() == pytest.approx(np.array([[0.0, 0.0], [5.0, 500.0]]))
    assert largest.get_ydata() == pytest.approx([200.0, 400.0]) and further.get_ydata() == pytest.approx([400.0, 800.0])
    assert one.get_color() == largest.get_color() != other.get_color() and largest.get_linestyle() == "--"
    assert [line.get_label() for line in axis.lines] == ["restoring 90°", "largest tension 90°", "restoring 0°",
                                                         "largest tension 0°"]  # fmt: skip
    assert axis.get_title() == "ship held at an offset" and axis.get_xlabel() == "offset, m"


def test_losses_are_bars_of_the_largest_tension_left_below_that_of_all_lines():
    axis = axes()
    state = SimpleNamespace(tension=np.array([3e5, 4e5]))
    losses = {"a": SimpleNamespace(tension=np.array([5e5, 6e5])), "b": SimpleNamespace(tension=np.array([8e5, 7e5]))}
    pictures._draw_losses(axis, state, losses)
    assert [bar.get_width() for bar in axis.patches] == pytest.approx([400.0, 600.0, 800.0])
    assert [text.get_text() for text in axis.get_yticklabels()] == ["intact", "a", "b"]
    low, high = axis.get_ylim()
    assert low > high and axis.get_xlabel() == "largest tension, kN"  # intact on top


@pytest.mark.parametrize(("curves", "losses", "seen"), [((), None, None), ("one", None, (True, False)),
                                                        ((), "one", (False, True))])  # fmt: skip
def test_a_second_row_is_there_for_curves_or_losses(two, monkeypatch, curves, losses, seen):
    found = kept(monkeypatch)
    pictures.draw_system(two, "p.png", [curve()] if curves else (), {"slack": two} if losses else None)
    drawn = [axis for axis in found[0][0].axes if axis.get_ylabel() != "tension, kN"]
    assert len(drawn) == (2 if seen is None else 4)
    assert seen is None or tuple(axis.axison for axis in drawn[2:]) == seen


# ------------------------------------------------------------------ frames


def nodes(count):
    """A line from (1, 2) 10 m along (0.6, 0.8), whose middle rises by a metre a frame"""
    line = np.array([[1.0, 2.0, -5.0], [4.0, 6.0, -4.0], [7.0, 10.0, 0.0]])
    made = np.repeat(line[None], count, axis=0)
    made[:, 1, 2] += np.arange(count)
    return made


def test_the_plane_of_a_line_goes_through_its_ends_at_the_start():
    plane = pictures.line_plane(nodes(2))
    assert plane[0] == pytest.approx(np.array([[0.0, -5.0], [5.0, -4.0], [10.0, 0.0]]))
    assert plane[1, 1] == pytest.approx([5.0, -3.0])
    upright = nodes(1)
    upright[..., :2] = 3.0
    upright[0, 1, 0] = 4.0
    assert pictures.line_plane(upright)[0, :, 0].tolist() == [0.0, 1.0, 0.0]


@pytest.mark.parametrize(("frames", "times", "grid"), [
    (30, [0, 3, 5, 8, 11, 13, 16, 18, 21, 24, 26, 29], (3, 4)), (5, [0, 1, 2, 3, 4], (2, 4)),
    (2, [0, 1], (1, 2)),
])  # fmt: skip
def test_a_strip_has_twelve_frames_at_most_from_the_first_to_the_last(monkeypatch, tmp_path, frames, times, grid):
    found = kept(monkeypatch)
    pictures.draw_frames(0.5 * np.arange(frames), nodes(frames), tmp_path / "p.png")
    ((figure, _),) = found
    drawn = [axis for axis in figure.axes if axis.axison]
    assert [axis.get_title() for axis in drawn] == [f"{0.5 * i:.2f} s" for i in times]
    assert figure.axes[0].get_subplotspec().get_gridspec().get_geometry() == grid
    assert (figure.get_supxlabel(), figure.get_supylabel()) == ("along the line's plane at the start, m", "z, m")
    for axis, i in zip(drawn, times, strict=True):
        first, now = axis.lines
        assert first.get_xydata()[1] == pytest.approx([5.0, -4.0])
        assert now.get_xydata()[1] == pytest.approx([5.0, i - 4.0])


def film_of(monkeypatch, time, count):
    made = {}

    class Film:
        def __init__(self, figure, show, frames, interval):
            made.update(figure=figure, show=show, frames=frames, interval=interval)

        def save(self, path, writer):
            made.update(path=path, writer=writer)

    monkeypatch.setattr("matplotlib.animation.FuncAnimation", Film)
    monkeypatch.setattr("matplotlib.animation.PillowWriter", lambda fps: fps)
    pictures._film(time, pictures.line_plane(nodes(count)), "f.gif")
    return made


@pytest.mark.parametrize(("count", "step", "every", "pause", "rate"), [
    (4, 0.1, 1, 100.0, 10.0), (401, 0.1, 2, 200.0, 5.0), (4, 0.01, 1, 10.0, 25.0), (4, 5.0, 1, 5000.0, 1.0),
    (1, 1.0, 1, 100.0, 10.0),
])  # fmt: skip
def test_a_film_lasts_as_long_as_the_run_with_two_hundred_frames_or_so(monkeypatch, count, step, every, pause, rate):
    """Not faster than 25 frames a second nor slower than one"""
    made = film_of(monkeypatch, step * np.arange(count), count)
    assert list(made["frames"]) == list(range(0, count, every)) and made["interval"] == pytest.approx(pause)
    assert made["writer"] == pytest.approx(rate) and made["path"] == "f.gif"


def test_a_frame_of_a_film_has_its_line_and_time_in_a_window_of_all(monkeypatch):
    made = film_of(monkeypatch, 0.5 * np.arange(4), 4)
    (axis,) = made["figure"].axes
    (drawn,) = made["show"](2)
    assert drawn.get_xydata()[1] == pytest.approx([5.0, -2.0]) and axis.get_title() == "1.00 s"
    assert axis.get_xlim() == pytest.approx((-0.5, 10.5)) and axis.get_ylim() == pytest.approx((-5.25, 0.25))


def test_a_result_is_drawn_beside_its_file_where_no_other_place_is_given(monkeypatch, tmp_path):
    drawn, kinds = [], []
    labels = {"frame": SimpleNamespace(values="times")}
    found = type("Found", (dict,), {"labels": labels})({"line.place": "nodes"})
    monkeypatch.setattr("hakobune.pipelines.results.file.read", lambda file, kind: kinds.append(kind) or found)
    monkeypatch.setattr("hakobune.pipelines.results.writing.kind_of", lambda file: "moor")
    monkeypatch.setattr(pictures, "draw_frames", lambda *given: drawn.append(given))
    assert pictures.draw_result(tmp_path / "a.h5", None) == tmp_path / "a_frames.png"
    assert pictures.draw_result(tmp_path / "a.h5", tmp_path / "b.gif") == tmp_path / "b.gif"
    assert drawn == [("times", "nodes", tmp_path / "a_frames.png"), ("times", "nodes", tmp_path / "b.gif")]
    assert kinds == ["line-dynamics"] * 2
    with pytest.raises(ValueError, match=r"c\.doc"):
        pictures.draw_result(tmp_path / "a.h5", tmp_path / "c.doc")
    del found["line.place"]
    with pytest.raises(ValueError, match="has no frames; allowed: a result of hakobune line-dynamics"):
        pictures.draw_result(tmp_path / "a.h5", None)
