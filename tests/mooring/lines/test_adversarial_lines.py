"""Lines that nobody would hang, judged by quadrature and balances of forces: what is answered is an equilibrium."""

from collections import Counter

import numpy as np
import pytest
from bench.adversarial_lines import verdict
from exact.static_line import faults

from mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine


def test_no_adversarial_line_is_wrong_and_none_is_refused_that_its_bed_holds():
    words = Counter(verdict(11, number)[0] for number in range(300))
    assert words["wrong"] == words["refused"] == 0, words
    assert words["answered"] > 200, words


def test_a_line_with_a_gap_or_that_ends_beside_its_anchor_is_no_answer():
    """Equations that hold, of contacts that are not there: a way on the bed cut short, past the anchor or a vertex."""
    assert all(verdict(3, number)[0] != "wrong" for number in (592, 2428, 3799, 4980, 7751))


def test_friction_holds_with_a_part_where_all_of_it_has_no_equilibrium():
    """Uniform lines over ridges: with all of the friction the span behind a ridge jumps from one facet to another."""
    assert all(verdict(1101, number)[0] == "answered" for number in (7801, 10727, 13581, 15160, 38880))


def test_what_a_slack_line_with_buoys_leaves_on_a_steep_slope_is_a_heap_at_its_anchor_and_told():
    """Sinkers on a slope that falls from the anchor, and a leg below a buoy on one that rises from it, do not pull."""
    assert all(verdict(1101, number)[0] == "slides" for number in (193, 647, 14847, 20761, 22742, 29330))


def test_a_sinker_in_a_hollow_and_a_heap_above_a_buoy_are_in_equilibrium():
    """The line slides into a hollow and has no tension there: to its sinker, or above a buoy further on."""
    assert all(verdict(1101, number)[0] == "answered" for number in (27293, 30437, 59958))


def test_the_residual_sees_a_wrong_tension_a_broken_line_and_a_buoy_above_the_sea():
    line = StaticLine([Segment(120.0, 10.0, 1e6)], [PointLoad(85.0, -900.0)], surface=30.0)
    found = line.solve(104.0, 29.0)
    assert not faults(found)
    for column, word in ((5, "broken"), (4, "place of the fairlead"), (2, "length")):
        pieces = found.pieces.copy()
        pieces[0, column] *= 1.001
        object.__setattr__(found, "pieces", pieces)
        assert word in faults(found), (word, faults(found))
    free = StaticLine(line.segments, line.loads, surface=40.0).solve(104.0, 29.0)
    object.__setattr__(free, "line", line)
    assert "buoy" in faults(free)


@pytest.mark.parametrize(
    ("line", "x", "z"),
    [
        # what a buoy lifts stands over the heap at the anchor
        (StaticLine([Segment(100.0, 10.0, 1e6)], [PointLoad(20.0, -200.0)]), 30.0, 20.0),
        (StaticLine([Segment(100.0, 10.0)], [PointLoad(20.0, -5000.0)], surface=25.0), 30.0, 20.0),
        (StaticLine([Segment(50.0, 10.0, 1e5), Segment(50.0, 30.0)], bed=None), 0.0, 60.0),
        (StaticLine([Segment(50.0, 10.0, 1e5), Segment(50.0, 90.0)], [PointLoad(60.0, 400.0)], None), 40.0, 30.0),
        (
            StaticLine([Segment(50.0, 10.0), Segment(50.0, 30.0)], [PointLoad(60.0, -90.0)], Bed.sloping(0, 0.5)),
            0.0,
            9.0,
        ),
    ],
)
def test_slack_plumb_and_hanging_lines_of_parts_are_in_equilibrium(line, x, z):
    found = line.solve(x, z)
    assert not faults(found)
    total = line.weight + sum(load.weight for load in line.loads)
    if line.bed is None:
        assert np.isclose(found.vertical_fairlead - found.vertical_anchor, total, rtol=1e-9)
