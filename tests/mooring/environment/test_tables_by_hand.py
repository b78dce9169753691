"""Times of tables that a file has rounded, and steps that are uneven, on either side of each limit."""

import numpy as np
import pytest

from hakobune.mooring.environment.tables import TableError, check_even, column_of, without_rounding


@pytest.mark.parametrize("step, start, digits", [(0.814, 0.0, 1), (0.814, 3.3, 2), (12.3456, 100.0, 0), (0.05, 1.0, 3)])
def test_times_that_a_file_has_rounded_are_those_before(step, start, digits):
    """A straight line through 200 times of that step is as near as rounding leaves it"""
    exact = start + step * np.arange(200)
    found = without_rounding(np.round(exact, digits))
    assert np.ptp(np.diff(found)) < 1e-10 and found == pytest.approx(exact, abs=0.06 * 10.0**-digits)


def test_times_that_are_even_too_few_or_none_stay_as_they_are():
    for time in (
        0.25 * np.arange(9.0),
        np.array([0.0, 0.7]),
        np.array([0.0, 0.8, np.nan, 2.4]),
        3 + 1e9 * np.arange(4.0),
    ):
        assert without_rounding(time) is time


@pytest.mark.parametrize(
    "step, last, evened",
    [
        (0.41, 0.1, True),
        (0.39, 0.1, False),
        (41.0, 10.0, False),
        (15.4, 0.5, False),
        (4.1, 1.0, True),
        (3.9, 1.0, False),
    ],
)
def test_a_last_digit_is_a_quarter_of_a_step_at_most_and_rounding_half_of_it(step, last, evened):
    """Times in halves have no last digit that would leave as much; none is above a second"""
    exact = step * np.arange(50)
    time = last * np.round((exact + 0.01 * step) / last)
    assert (without_rounding(time) is time) != evened


@pytest.mark.parametrize("off", [0.0, 0.1, -0.1])
def test_a_time_further_from_its_place_than_rounding_leaves_it_is_kept(off):
    time = np.round(0.73 * np.arange(400), 1)
    time[200] += off
    assert (without_rounding(time) is time) == (off != 0.0)


def test_steps_that_are_uneven_beyond_their_tolerance_are_refused():
    time, lines = np.array([0.0, 1.0, 2.0, 3.09, 4.09]), np.arange(2, 7)
    check_even("x.csv", time, 0.1, lines)
    with pytest.raises(TableError, match=r"x\.csv: line 5: "):
        check_even("x.csv", time, 0.08, lines)
    with pytest.raises(TableError):
        check_even("x.csv", np.array([0.0, 1.0, 2.0, 2.91, 3.91]), 0.08, lines)
    check_even("x.csv", np.array([5.0]), 0.0, lines[:1])


def test_a_column_is_found_by_its_name():
    assert column_of("x", ["t", "eta"], "eta") == 1
    with pytest.raises(TableError, match=r"x has no column 'z'; allowed: t, eta"):
        column_of("x", ["t", "eta"], "z")
    with pytest.raises(TableError, match="has no column names"):
        column_of("x", None, "eta")
