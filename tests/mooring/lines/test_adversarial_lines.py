"""Lines that nobody would hang, judged by quadrature and balances of forces: what is answered is an equilibrium."""

import time
from collections import Counter

import numpy as np
import pytest
from bench.adversarial_lines import random_line, verdict
from bench.usual_lines import usual_line
from exact.static_line import faults

from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine


def test_no_adversarial_line_is_wrong_and_hardly_one_is_refused():
    words = Counter(verdict(11, number)[0] for number in range(300))
    assert words["wrong"] == 0 and words["refused"] <= 2, words  # of 0.5 expected
    assert words["answered"] > 200, words


def test_no_line_that_one_does_hang_is_wrong_or_refused():
    words = Counter(verdict(12, number, usual_line)[0] for number in range(300))
    assert words["wrong"] == words["refused"] == words["slides"] == 0, words
    assert words["answered"] > 250, words


def test_a_line_with_a_gap_or_that_ends_beside_its_anchor_is_no_answer():
    """Equations that hold, of contacts that are not there: a way on the bed cut short, past the anchor or a vertex."""
    assert all(verdict(3, number)[0] != "wrong" for number in (592, 2428, 3799, 4980, 7751))


def test_a_line_on_a_slope_has_no_tension_below_a_heap_that_has_none():
    """What slid into a heap at the anchor pulled there, with 1.6 % of the weight on no length."""
    assert verdict(52, 95292)[0] != "wrong"


def test_a_load_just_beside_the_end_of_a_segment_counts_once():
    """Both are within 1e-7 of the length: the judge counted the load at each of them."""
    assert verdict(61, 312360)[0] == "answered"


def test_friction_holds_with_a_part_where_all_of_it_has_no_equilibrium():
    """Uniform lines over ridges: with all of the friction the span behind a ridge jumps from one facet to another."""
    assert all(verdict(1101, number)[0] == "answered" for number in (7801, 10727, 13581, 15160, 38880))


def test_slack_lines_with_buoys_on_steep_slopes_are_told_of():
    """Sinkers on a slope that falls from the anchor, and a leg below a buoy on one that rises from it, slide."""
    assert all(verdict(1101, number)[0] == "slides" for number in (14847, 20761))
    assert verdict(1101, 647)[0] == "slides"  # friction 0.4: what is left over is a heap at the anchor


def test_a_sinker_in_a_hollow_and_a_heap_above_a_buoy_are_in_equilibrium():
    """The line slides into a hollow and has no tension there: to its sinker, or above a buoy further on."""
    assert all(verdict(1101, number)[0] == "answered" for number in (27293, 30437, 59958))


def test_lines_that_no_traversal_finds_are_refused_in_one_line_at_once():
    """Two heaps of which one drains into the other, folds past the fairlead's foot, a buoy at the crest of a ridge."""
    for case in ((1101, 671), (1101, 13800), (1101, 38742), (31, 1708), (31, 100529)):
        line, x, z = random_line(np.random.default_rng(case))
        line.solve(x, max(z, 0.5 * line.length))  # loads the kernels
        start = time.process_time()
        with pytest.raises(LineError, match=r"may slide on its bed.*; give a friction of at least") as caught:
            line.solve(x, z)
        assert time.process_time() - start < 0.1, case
        assert "\n" not in str(caught.value) and f"friction {line.bed.friction:g}" in str(caught.value)


def test_a_sinker_on_a_slope_without_friction_pulls_along_it():
    """Lines in which one hung at a fold or a ridge, and legs without tension, held a sinker or a buoy by nothing."""
    numbers = (2072, 2154, 2564, 8587, 14508, 14702, 15230, 18544, 18698, 19954)
    words = {number: verdict(7001, number)[0] for number in numbers}
    assert "wrong" not in words.values(), words


def test_the_judge_sees_a_sinker_that_its_bed_does_not_hold():
    """Pulled out over a slope of 1 to 10 a sinker of 500 N takes f (sin β + μ cos β) of the tension."""
    segments, sinker, slope = [Segment(100.0, 10.0, 1e7)], [PointLoad(20.0, 500.0)], np.arctan(0.1)
    found = StaticLine(segments, sinker, Bed.sloping(slope, 0.2)).solve(94.4, 24.0)
    assert not faults(found)
    i = int(np.argmin(np.abs(found.pieces[:, 1] - 20.0)))
    above, below = found.pieces[i - 1], found.pieces[i]
    assert above[0] == below[0] == 1
    assert above[5] - above[6] * above[2] - below[5] == pytest.approx(500 * (np.sin(slope) + 0.2 * np.cos(slope)))
    object.__setattr__(found, "line", StaticLine(segments, sinker, Bed.sloping(slope, 0.1)))
    assert faults(found)["out of the cone of friction"] > 1e3


def test_what_is_heaped_at_the_anchor_does_not_hang_below_the_bed():
    """Between a buoy over the anchor and the anchor, five times the depth of line lies in a heap."""
    assert verdict(31, 193226)[0] == "answered"


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
