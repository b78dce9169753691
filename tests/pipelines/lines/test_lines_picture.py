"""What the picture of `hakobune lines` is drawn from: shapes through joints and bodies, own beds, room in the plan."""

import numpy as np
import pytest

from hakobune.mooring.lines.multi_segment.bed import Bed
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, CompositeLine
from hakobune.mooring.lines.system.shapes import beds_of_lines, line_shapes, loads_on_lines


def buoyed(ends, bed=None):
    """A line with a buoy of 5 kN net lift between its segments, in one plane"""
    parts = Segment(200.0, 900.0, 5e8), Segment(140.0, 900.0, 5e8)
    parts, at = (parts, 200.0) if ends == "AF" else (parts[::-1], 140.0)
    points = Anchor("A", (0.0, 0.0, -100.0)), Anchor("F", (280.0, 0.0, 0.0))
    line = CompositeLine("buoyed", parts, *ends, (PointLoad(at, -1.2e5),), bed=bed)
    return rest(System(100.0, (line,), points))


@pytest.mark.parametrize("ends", ["AF", "FA"])
def test_the_shape_of_a_line_passes_its_bodies(ends):
    state = buoyed(ends)
    (shape,), buoy = line_shapes(state), loads_on_lines(state)[0]
    assert len(shape) == 80 and np.abs(shape - buoy).max(axis=1).min() < 1e-9
    assert np.allclose(shape[[0, -1]], state.points[state.system.arrays.ends[0]], atol=1e-6)


def test_the_own_bed_of_a_line_reaches_from_its_anchor_to_its_other_end():
    bed = Bed(np.array([[0.0, 0.0], [100.0, -5.0], [200.0, -15.0]]), 0.5)
    (drawn,) = beds_of_lines(buoyed("AF", bed))
    assert np.allclose(drawn, [[0, 0, -100], [100, 0, -105], [200, 0, -115], [280, 0, -123]])


def test_the_plan_of_lines_in_one_plane_has_room_across_it(tmp_path, monkeypatch):
    from hakobune.pipelines.lines import pictures

    drawn = []
    monkeypatch.setattr(pictures, "save", lambda figure, path, dpi: drawn.append(figure))
    pictures.draw_system(buoyed("AF"), tmp_path / "plan.png")
    plan = drawn[0].axes[0]
    assert np.ptp(plan.get_ylim()) >= 0.25 * np.ptp(plan.get_xlim())
