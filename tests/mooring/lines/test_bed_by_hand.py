"""The section of a gridded bed under a line, its heights and slopes, by hand."""

import numpy as np
import pytest
from plain import plain

from hakobune.mooring.lines.multi_segment.bed import Bed
from hakobune.mooring.lines.multi_segment.line import Segment, StaticLine

X, Y = np.array([0.0, 100.0, 200.0]), np.array([0.0, 30.0, 60.0, 120.0])


def section(anchor, fairlead, height=lambda x, y: 0.1 * x - 0.2 * y, friction=0.0):
    return Bed.under(X, Y, height(X[:, None], Y[None, :]), anchor, fairlead, friction)


def test_a_section_bends_where_the_line_crosses_lines_of_the_grid():
    """3-4-5 from (30, 10): y = 30, 60 and 120, the edge, at 20, 50 and 110 times 5/4; x = 100 at 70·5/3"""
    bed = section((30.0, 10.0), (90.0, 90.0), friction=0.4)
    crossings = [0.0, 20 * 5 / 4, 50 * 5 / 4, 100.0, 70 * 5 / 3, 110 * 5 / 4]
    assert bed.friction == 0.4
    assert bed.points[:, 0] == pytest.approx(crossings)
    assert bed.points[:, 1] == pytest.approx(bed.points[:, 0] * (0.1 * 3 / 5 - 0.2 * 4 / 5))


@pytest.mark.parametrize("back", [False, True])
def test_a_section_along_a_line_of_the_grid_crosses_the_others_alone(back):
    ends = ((20.0, 30.0), (180.0, 30.0))
    bed = section(*(ends[::-1] if back else ends), lambda x, y: np.abs(x - 100.0) + 0 * y)
    assert bed.points[:, 0] == pytest.approx([0.0, 80.0, 160.0, 180.0])
    assert bed.points[:, 1] == pytest.approx([0.0, -80.0, 0.0, 20.0])


def test_between_its_points_a_grid_is_bilinear():
    """z = xy is bilinear and is met at every vertex; from the anchor at (50, 15)"""
    bed = section((50.0, 15.0), (150.0, 45.0), lambda x, y: x * y)
    way = np.array([100.0, 30.0]) / np.hypot(100.0, 30.0)
    at = np.array([50.0, 15.0]) + bed.points[:, :1] * way
    assert bed.points[:, 1] == pytest.approx(at[:, 0] * at[:, 1] - 50 * 15)
    assert len(bed.points) == 4  # both lines x = 100 and y = 30 at the middle, both ends, the edge at (200, 60)


def test_a_line_without_direction_and_ends_off_the_grid_are_refused():
    with pytest.raises(
        ValueError, match="above the anchor, so the section of the bed has no direction; move one of them"
    ):
        section((50.0, 10.0), (50.0, 10.0))
    section((0.0, 0.0), (200.0, 120.0))
    with pytest.raises(ValueError, match=r"fairlead at \(200\.1, 120\) m lies outside"):
        section((0.0, 0.0), (200.1, 120.0))
    with pytest.raises(ValueError, match=r"anchor at \(10, -0\.1\) m lies outside"):
        section((10.0, -0.1), (50.0, 120.0))
    with pytest.raises(ValueError, match="x and y rising"):
        Bed.under(X[::-1], Y, np.zeros((3, 4)), (10.0, 10.0), (50.0, 50.0))
    with pytest.raises(ValueError, match=r"shape \(4, 3\); allowed: \(3, 4\)"):
        Bed.under(X, Y, np.zeros((4, 3)), (10.0, 10.0), (50.0, 50.0))


def test_heights_above_a_bed_before_on_and_beyond_its_vertices():
    """Facets of slopes 0.1, −0.2 and 0.5, the first and the last without end"""
    bed = Bed(np.array([[5.0, 7.0], [105.0, 17.0], [155.0, 7.0], [175.0, 17.0]]))
    assert bed.points[0] == pytest.approx([0.0, 0.0])
    assert bed.slopes == pytest.approx([0.1, -0.2, 0.5])
    x = np.array([-20.0, 50.0, 125.0, 160.0, 190.0])
    ground = np.array([-2.0, 5.0, 5.0, 5.0, 20.0])
    assert bed.depth_below(x, np.full(5, 4.0)) == pytest.approx(4.0 - ground)
    assert bed.first_facet == pytest.approx(100.0)
    assert Bed.sloping(0.3).first_facet == np.inf
    assert Bed.sloping(0.3).depth_below(10.0, 5.0) == pytest.approx(5 - 10 * np.tan(0.3))


@pytest.mark.parametrize(("slope", "friction", "slides"), [(-0.49, 0.5, False), (-0.51, 0.5, True), (0.6, 0.5, False)])
def test_a_line_slides_away_from_its_anchor_where_the_bed_falls_more_steeply_than_its_friction(slope, friction, slides):
    assert Bed(np.array([[0.0, 0.0], [1.0, slope]]), friction).slides_beyond == slides


def test_beds_at_either_side_of_what_is_allowed():
    Bed.sloping(1.49)
    with pytest.raises(ValueError, match="bed slope is"):
        Bed.sloping(1.5)
    with pytest.raises(ValueError, match="bed friction is"):
        Bed.sloping(0.0, -0.1)
    with pytest.raises(ValueError, match="x of the bed points changes by 0 m"):
        Bed(np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 2.0]]))
    with pytest.raises(ValueError, match=r"shape \(1, 2\)"):
        Bed(np.zeros((1, 2)))


def test_a_line_that_may_slide_is_told_the_friction_of_its_steepest_facet():
    """Facets of 0.1, −0.4 and 0.2; a bed that holds the line everywhere has another way out"""
    points = np.array([[0.0, 0.0], [10.0, 1.0], [20.0, -3.0], [30.0, -1.0]])
    rope = [Segment(100.0, 10.0, 1e7)]
    said = StaticLine(rope, [], Bed(points, 0.3))._way_out
    assert said.startswith(": the line may slide on its bed, which has slopes up to 0.4 and friction 0.3; ")
    assert "give a friction of at least 0.4, a shorter line" in said
    assert StaticLine(rope, [], Bed(points, 0.41))._way_out.startswith("; give another length, or move the fairlead")


@pytest.mark.parametrize("count", [0, 10, 14, 19, 20])
def test_what_lies_in_a_heap_is_a_piece_of_its_own_however_many_there_are(count):
    """12 m from 50 m on, without tension, after `count` pieces; where there is no more room nothing is written"""
    on_bed, data = plain("mooring.lines.multi_segment.on_bed"), plain("mooring.lines.multi_segment.line_data")
    line = StaticLine([Segment(100.0, 10.0, 1e7)], [], Bed.sloping(0.0, 0.5))._data
    q, at, rows = np.zeros(data.STATE_ROWS), np.array([0, -1, count]), np.full((20, data.PIECE_COLUMNS), 7.0)
    q[[data.X, data.S]] = 30.0, 50.0
    assert on_bed.leave_heap(line, q, np.zeros((data.DERIVATIVE_ROWS, 0)), at, 12.0, 0.1, -1, rows)
    assert q[data.S] == 38.0 and at.tolist() == [0, -1, min(count + 1, 20)]
    if count < 20:
        assert rows[count, :5].tolist() == [1.0, 50.0, 12.0, 30.0, 0.0]
        assert rows[count, [5, 8, 9]].tolist() == [0.0, on_bed.HEAP, 0.0] and rows[count, 10] == 0.1
    assert np.all(np.delete(rows, [count] if count < 20 else [19], axis=0) == 7.0)
