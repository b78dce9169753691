"""Lines that nobody would hang, judged by quadrature and balances of forces: what is answered is an equilibrium."""

from collections import Counter

import numpy as np
import pytest
from bench.adversarial_lines import random_line, verdict
from exact.static_line import faults

from mooring.lines.multi_segment.at_rest.solve import come_to_rest
from mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine


def test_no_adversarial_line_is_wrong_and_none_is_refused_that_its_bed_holds():
    words = Counter(verdict(11, number)[0] for number in range(300))
    assert words["wrong"] == words["refused"] == 0, words
    assert words["answered"] > 200, words


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


def test_slack_lines_with_buoys_on_steep_slopes_come_to_rest_without_friction_and_are_told_with_it():
    """Sinkers on a slope that falls from the anchor, and a leg below a buoy on one that rises from it, slide."""
    assert all(verdict(1101, number)[0] == "answered" for number in (193, 14847, 20761, 22742, 29330))
    assert verdict(1101, 647)[0] == "slides"  # friction 0.4: what is left over is a heap at the anchor


def test_a_sinker_in_a_hollow_and_a_heap_above_a_buoy_are_in_equilibrium():
    """The line slides into a hollow and has no tension there: to its sinker, or above a buoy further on."""
    assert all(verdict(1101, number)[0] == "answered" for number in (27293, 30437, 59958))


def test_lines_that_no_traversal_finds_come_to_rest():
    """Two heaps of which one drains into the other, folds past the fairlead's foot, buoys that stand over a heap."""
    numbers = (671, 1422, 1913, 4707, 7898, 13800, 26213, 32847, 34004, 38742)
    words = {number: verdict(1101, number)[0] for number in numbers}
    assert set(words.values()) == {"answered"}, words


def test_contacts_shorter_than_the_links_of_a_chain_are_found_where_it_is_made_finer():
    """A buoy at the crest of a ridge, spans and heaps of a thousandth of the line, a sinker where a span lands."""
    cases = ((31, 1708), (31, 96999), (31, 220439), (31, 449724), (32, 130930), (32, 416154))
    words = {case: verdict(*case)[0] for case in cases}
    assert set(words.values()) == {"answered"}, words


def test_a_load_at_a_vertex_is_not_joined_to_the_line_by_a_span_of_no_length():
    """Such a span, and the load on either side of it, would be counted twice: 1e-8 of the line beside a buoy."""
    cases = ((31, 473387), (31, 63185), (52, 80779))
    words = {case: verdict(*case)[0] for case in cases}
    assert set(words.values()) == {"answered"}, words
    for case in cases:
        line, x, z = random_line(np.random.default_rng(case))
        lengths = line.solve(x, z).pieces[:, 2] / line.length
        assert not np.any((lengths > 1e-14) & (lengths < 1e-7)), (case, lengths)


def test_a_sinker_is_held_down_in_a_hollow_by_buoys_that_stand_plumb_beside_it():
    words = {case: verdict(*case)[0] for case in ((31, 100529), (32, 124765), (32, 443879))}
    assert set(words.values()) == {"answered"}, words


def test_a_line_without_a_bed_hangs_plumb_in_a_bight_below_its_fairlead():
    """Fairlead over the anchor: with a sinker lowest, with a stretch of 40 %, with two buoys under water."""
    words = {case: verdict(*case)[0] for case in ((31, 12738), (31, 160770), (32, 357520))}
    assert set(words.values()) == {"answered"}, words


def test_what_is_heaped_at_the_anchor_does_not_hang_below_the_bed():
    """Between a buoy over the anchor and the anchor, five times the depth of line lies in a heap."""
    assert verdict(31, 193226)[0] == "answered"


def test_a_line_at_rest_has_the_stiffness_of_its_forces():
    """Central differences over 1e-5 of the length, whose own error is of second order."""
    line, x, z = random_line(np.random.default_rng([1101, 671]))
    row, step = come_to_rest(line, x, z, line._bears_out)[0], 1e-5 * line.length
    for column, (dx, dz) in enumerate(((step, 0.0), (0.0, step))):
        ahead, behind = (come_to_rest(line, x + way * dx, z + way * dz, line._bears_out)[0] for way in (1, -1))
        slope = (ahead[:2] - behind[:2]) / (2 * step)
        assert np.allclose(slope, row[[5 + column, 7 + column]], rtol=1e-4)


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
