"""Clock, units, codes and calms of records of years: each by what it is defined as."""

import math
from pathlib import Path

import numpy as np
import pytest

from hakobune.mooring.downtime import clock, files, hindcast, largest
from hakobune.mooring.environment.tables import TableError


def seconds(text):
    return np.datetime64(text, "s")


# ------------------------------------------------------------------ clock


@pytest.mark.parametrize("texts, zone, wanted", [
    (["2015-01-31T06:00", " 2015-01-31 07:30 "], "UTC", ["2015-01-31T06:00", "2015-01-31T07:30"]),
    (["2015-01-31T06:00Z", "2015-01-31T07:00Z"], "Europe/Berlin", ["2015-01-31T06:00", "2015-01-31T07:00"]),
    (["2015-01-31T06:00+09:00", "2015-02-01T06:00+09:00"], "UTC", ["2015-01-30T21:00", "2015-01-31T21:00"]),
    (["2015-01-31T06:00:00-0330"], "UTC", ["2015-01-31T09:30"]),
    (["2015-01-31T06:00+0900", "2015-07-31T06:00+0800"], "UTC", ["2015-01-30T21:00", "2015-07-30T22:00"]),
    (["2015-01-31T06:00"], "+09:00", ["2015-01-30T21:00"]), (["2015-01-31T06:00"], "-0130", ["2015-01-31T07:30"]),
    (["1420070400", "1420074000"], "Asia/Tokyo", ["2015-01-01T00:00", "2015-01-01T01:00"]),
    (["1420070400.0", "1420074000.0"], "UTC", ["2015-01-01T00:00", "2015-01-01T01:00"]),
    (["2015-01-31T06:00"], "Asia/Tokyo", ["2015-01-30T21:00"]),
    (["2015-01-31T06:00", "2015-07-31T06:00"], "Europe/Berlin", ["2015-01-31T05:00", "2015-07-31T04:00"]),
])  # fmt: skip
def test_times_are_local_less_what_their_zone_is_ahead(texts, zone, wanted):
    """Tokyo 9 h ahead, Berlin 1 h and 2 h in summer, Newfoundland 3½ h behind; 1 420 070 400 s from 1970 to 2015"""
    assert clock.times(texts, zone, "f.csv").tolist() == [seconds(one).item() for one in wanted]


def test_an_hour_that_comes_twice_is_first_in_summer_time():
    """Berlin, 25 October 2015: clocks go from 3 to 2 at 01:00 UTC; 29 March: from 2 to 3"""
    autumn = [f"2015-10-25T0{hour}:00" for hour in "0122345"]
    found = clock.times(autumn, "Europe/Berlin", "f.csv")
    assert found.tolist() == [seconds("2015-10-24T22:00").item() + np.timedelta64(k, "h").item() for k in range(7)]
    spring = clock.times([f"2015-03-29T0{hour}:00" for hour in "0134"], "Europe/Berlin", "f.csv")
    assert spring.tolist() == [seconds("2015-03-28T23:00").item() + np.timedelta64(k, "h").item() for k in range(4)]
    with pytest.raises(TableError, match="2015-03-29T02:00:00 does not exist in Europe/Berlin, where clocks go forw"):
        clock.times(["2015-03-29T01:00", "2015-03-29T02:00"], "Europe/Berlin", "f.csv")


@pytest.mark.parametrize("texts, zone, says", [
    (["2015-01-31T06:00", "31.01.2015"], "UTC", "time is '31.01.2015'; allowed: ISO 8601"),
    (["2015-01-31T06:00Z", "2015-01-31T07:00"], "UTC", "different time zones, one of them '0'"),
    (["2015-01-31T06:00"], "Atlantis", "zone is 'Atlantis'; allowed: UTC, an offset"),
    (["2015-01-31T06:00"], "+9", "zone is '.9'; allowed: UTC, an offset"),
])  # fmt: skip
def test_times_that_are_none_and_zones_that_are_nowhere_are_told(texts, zone, says):
    with pytest.raises(TableError, match=says):
        clock.times(texts, zone, "f.csv")


@pytest.mark.parametrize("moved, says", [
    ({}, None),
    ({"2015-10-25T03:00": "2015-10-25T02:00"}, "1 hours are repeated, first 2015-10-25T02:00:00, all in spring or aut"),
    ({"2015-10-25T03:00": "2015-10-25T00:00"}, "does not increase after 2015-10-25T02:00:00, at 1 places"),
])  # fmt: skip
def test_hours_that_repeat_are_those_of_summer_time_where_they_go_back_by_no_more_than_one(moved, says):
    hours = [f"2015-10-25T0{hour}:00" for hour in range(6)]
    time = np.array([moved.get(one, one) for one in hours], "datetime64[s]")
    if says is None:
        clock.check_rising(time, "f.csv")
    else:
        with pytest.raises(TableError, match=says):
            clock.check_rising(time, "f.csv")
    if says and "repeated" in says:
        july = time - np.timedelta64(100, "D")
        with pytest.raises(TableError, match="does not increase after 2015-07-17T02:00:00"):
            clock.check_rising(july, "f.csv")


# ------------------------------------------------------------------ units, cells, tables


@pytest.mark.parametrize("kind, unit, size", [
    ("height", "m", 1), ("height", "CM", 0.01), ("level", "mm", 0.001), ("height", " ft ", 0.3048),
    ("level", "feet", 0.3048), ("height", "meters", 1), ("period", "s", 1), ("period", "sec", 1), ("period", "min", 60),
    ("period", "seconds", 1), ("direction", "deg", math.pi / 180), ("direction", "degT", math.pi / 180),
    ("direction", "Degree_true", math.pi / 180), ("direction", "rad", 1), ("speed", "m/s", 1), ("speed", "m s-1", 1),
    ("speed", "m s**-1", 1), ("speed", "m.s^{-1}", 1), ("component", "knots", 1852 / 3600),
    ("speed", "kn", 1852 / 3600), ("speed", "kt", 1852 / 3600), ("speed", "km/h", 1 / 3.6), ("share", "%", 0.01),
    ("share", "1", 1), ("share", "-", 1), ("share", "(0 - 1)", 1), ("height", None, 1),
    ("direction", None, math.pi / 180), ("force", "kN", 1), ("force", None, 1),
])  # fmt: skip
def test_units_are_sizes_in_si(kind, unit, size):
    """A nautical mile is 1852 m, a foot 0.3048 m; kinds without units of their own are taken as they are"""
    assert files._size(Path("f.csv"), "c", unit, kind) == pytest.approx(size, rel=1e-12)


@pytest.mark.parametrize("cells, comma, wanted", [
    (["1.5", " 2 ", "", "nan"], False, [1.5, 2.0, np.nan, np.nan]), (["1,5", "2", " "], True, [1.5, 2.0, np.nan]),
    (["1e-3"], True, [1e-3]),
])  # fmt: skip
def test_an_empty_cell_is_not_known_and_commas_may_be_decimal_points(cells, comma, wanted):
    np.testing.assert_array_equal(files._numbers(Path("f.csv"), "hs", cells, comma), wanted)


def test_a_cell_that_is_no_number_is_told_with_its_row():
    """The head is row 1"""
    with pytest.raises(TableError, match=r"f.csv, row 4: hs is '1,5'; allowed: a number, or an empty cell"):
        files._numbers(Path("f.csv"), "hs", ["1", "", "1,5", "x"], False)


def read(tmp_path, text, wanted, **more):
    path = tmp_path / "f.csv"
    path.write_text(text)
    return files.read_columns(path, "time", "UTC", wanted, **more)


@pytest.mark.parametrize("mark, number", [(",", "1.5"), (";", "1,5"), ("\t", "1.5")])
def test_cells_lie_between_commas_semicolons_or_tabs(mark, number, tmp_path):
    rows = [["# of a buoy"], ["valid_time", "hs [cm]", "other"], ["2015-01-01T00:00", number, "x"],
            ["2015-01-01T01:00", "", "y"]]  # fmt: skip
    found, columns, said = read(tmp_path, "\n".join(mark.join(row) for row in rows), {"hs": "height"})
    assert [str(one) for one in found] == ["2015-01-01T00:00:00", "2015-01-01T01:00:00"] and said == []
    np.testing.assert_allclose(columns["hs"], [0.015, np.nan])


def test_columns_without_units_are_told_where_their_kind_has_one(tmp_path):
    text = "time,hs,tp [s],n\n2015-01-01,2,3,4\n"
    _, columns, said = read(tmp_path, text, {"hs": "height", "tp": "period", "n": "count"})
    assert [float(columns[name][0]) for name in ("hs", "tp", "n")] == [2.0, 3.0, 4.0]
    assert said == ["hs in f.csv have no units; m, s, degrees and m/s are assumed"]


@pytest.mark.parametrize("text, says", [
    ("", "has no rows; give a header and a row"), ("# a\n\n", "has no rows; give a header and a row"),
    ("time,hs\n", "has a header and no rows"), ("time,hs\n2015-01-01,1,2\n", "row 2: 3 cells; allowed: 2, as in"),
    ("time,hs,hs\n2015-01-01,1,2\n", "has 2 columns 'hs'; it has time, hs, hs"),
    ("time,tp [s]\n2015-01-01,1\n", r"has no column 'hs'; it has time, tp \[s\]"),
    ("% a b\n% c d\n2015 1\n", "has no line of column names and no line of .units."),
])  # fmt: skip
def test_files_that_are_no_tables_are_told(text, says, tmp_path):
    with pytest.raises(TableError, match=says):
        read(tmp_path, text, {"hs": "height"})


def test_a_table_of_ndbc_has_its_time_in_five_columns(tmp_path):
    text = "#YY  MM DD hh mm WDIR WVHT\n#yr  mo dy hr mn degT ft\n2015 01 02 03 30 90 2.0\n2015 01 02 04 30 MM 3.0\n"
    found, columns, _ = read(tmp_path, text, {"WVHT": "height", "WDIR": "direction"})
    assert [str(one) for one in found] == ["2015-01-02T03:30:00", "2015-01-02T04:30:00"]
    np.testing.assert_allclose(columns["WVHT"], [0.6096, 0.9144])
    np.testing.assert_allclose(columns["WDIR"], [math.pi / 2, np.nan])


# ------------------------------------------------------------------ codes, calms, steps


@pytest.mark.parametrize("code", [-9.0, -99.0, -999.0, -9999.0, -99.9, -99.99, 99.0, 99.9, 99.99, 999.0, 999.9, 9999.0,
                                  -32767.0, -32768.0])  # fmt: skip
def test_codes_of_missing_values_are_known_in_the_unit_of_the_file(code):
    """Of directions in degrees, where they are beyond two turns; one that nothing has is refused"""
    said = []
    found = hindcast._cleaned("height of waves", [1.0, code, 2.0, code], "height", "f.csv", said)
    np.testing.assert_array_equal(found, [1.0, np.nan, 2.0, np.nan])
    assert said == [f"2 values of height of waves are taken as codes for missing data, such as {code:g}"]
    if not -360 <= code <= 720:
        found = hindcast._cleaned("d", [1.0, math.radians(code)], "direction", "f.csv", [])
        np.testing.assert_array_equal(found, [1.0, np.nan])
    with pytest.raises(TableError, match=r"f.csv: w is .* in 1 rows; allowed: 0 to 30 in SI"):
        hindcast._cleaned("w", [1.0, 1.02 * code if abs(code) > 50 else -8.9], "height", "f.csv", [])


@pytest.mark.parametrize("kind, low, high", [
    ("height", 0.0, 30.0), ("period", 0.0, 40.0), ("direction", -2 * math.pi, 4 * math.pi), ("speed", 0.0, 100.0),
    ("component", -100.0, 100.0), ("level", -25.0, 25.0), ("share", 0.0, 1.0),
])  # fmt: skip
def test_values_are_taken_up_to_what_the_sea_has(kind, low, high):
    """No wave is higher than 30 m or longer than 40 s, no wind faster than 100 m/s"""
    assert hindcast._cleaned("c", [low, high], kind, "f", []).tolist() == [low, high]
    for beyond in (low - 0.03, high * 1.003 + 0.002):
        with pytest.raises(TableError, match=f"f: c is {beyond:.6g} in 1 rows".replace("+", ".")):
            hindcast._cleaned("c", [0.5 * high, beyond], kind, "f", [])


def test_the_value_furthest_off_is_named_with_how_often_it_occurs():
    for values, worst, rows in (([40.0, 1.0, 40.0, -7.0], 40, 2), ([31.0, 1.0, -70.0], -70, 1)):
        with pytest.raises(TableError, match=f"c is {worst} in {rows} rows"):
            hindcast._cleaned("c", values, "height", "f", [])


def hours(height, period=8.0, direction=1.0):
    return hindcast.WaveHours(*(np.array(np.broadcast_to(part, len(height)), float) for part in
                                (height, period, direction)))  # fmt: skip


def test_calms_and_hours_of_ice_have_no_period_and_waves_without_one_are_not_known():
    """Below 5 mm a calm; nan with ice too; of 5 mm or more without a period or direction not known"""
    height = [0.0049, 0.005, np.nan, np.nan, 2.0, 2.0, 2.0]
    waves = hours(height, [np.nan, 8, np.nan, 8, 0.0, 8.0, 9.0], [np.nan, 1, np.nan, 1, 1, np.nan, 1])
    said = []
    (one,) = hindcast._calms([waves], np.array([0.0, 0.5, 0.2, 0.0, 0.0, np.nan, 0.9]), said)
    np.testing.assert_array_equal(one.height, [0.0, 0.005, 0.0, np.nan, np.nan, np.nan, 2.0])
    np.testing.assert_array_equal(one.period, [np.nan, 8, np.nan, np.nan, np.nan, np.nan, 9])
    np.testing.assert_array_equal(one.direction, [0.0, 1, 0, 0, 0, 0, 1])
    assert said == ["1 rows have ice and no waves; they count as calm", "1 rows are calm, with waves below 0.005 m"]
    (other,) = hindcast._calms([waves], None, [])
    assert np.isnan(other.height[2])


def made(time, height=None, columns=None):
    height = np.full(len(time), 1.0) if height is None else height
    return hindcast.made(time, [(height, np.full(len(time), 8.0), np.zeros(len(time)))], columns or {}, "f.csv")


SEASONS = (
    "the record has no rows of February, March, April, May, June, July, August, September, October, November: hours a "
    "year and all shares represent the other months only; give whole years"
)
TIME = np.datetime64("2015-12-31T12:00", "s") + np.timedelta64(1, "h") * np.arange(30)


def test_a_record_knows_its_step_years_months_and_gaps():
    found = made(np.delete(TIME, [3, 4, 20]), columns={"wind": (np.arange(27.0), "speed")})
    assert found.step == 3600.0 and found.hours == 1.0 and found.slot.tolist() == [*range(3), *range(5, 20),
                                                                                   *range(21, 30)]  # fmt: skip
    assert found.year.tolist() == [2015] * 10 + [2016] * 17 and found.month.tolist() == [12] * 10 + [1] * 17
    assert found.said == ("3 of 30 steps are missing, in 2 gaps, the longest of 2 h after 2015-12-31T14:00:00: they "
                          "are excluded from all shares, and weather windows end there", SEASONS)  # fmt: skip
    assert repr(found) == "<Hindcast 27 rows of 1 h, 2015-12-31T12:00:00 to 2016-01-01T17:00:00>"


def test_a_record_may_begin_with_its_newest_row():
    height = np.linspace(1.0, 2.0, 30)
    found = made(TIME[::-1], height[::-1], {"wind": (np.arange(30.0)[::-1], "speed")})
    assert np.array_equal(found.time, TIME) and np.array_equal(found.height, height)
    assert np.array_equal(found.columns["wind"], np.arange(30.0))


@pytest.mark.parametrize("change, says", [
    (lambda t: t[:23], "f.csv has 23 rows; allowed: at least 24"),
    (lambda t: t + np.timedelta64(1800, "s") * (np.arange(30) > 4), "the step after 2015-12-31T16:00:00 is 1.5 h"),
])  # fmt: skip
def test_a_record_has_a_day_of_rows_at_equal_steps(change, says):
    assert len(made(TIME[:24]).time) == 24
    with pytest.raises(TableError, match=says):
        made(change(TIME))


def test_waves_that_come_every_third_hour_leave_the_rows_between():
    height = np.full(75, np.nan)
    height[1::3] = 1.5
    time = TIME[0] + np.timedelta64(1, "h") * np.arange(75)
    found = made(time, height, {"wind": (np.arange(75.0), "speed")})
    assert found.step == 3 * 3600.0 and np.array_equal(found.time, time[1::3])
    assert found.columns["wind"].tolist() == [*range(1, 75, 3)] and found.height.tolist() == [1.5] * 25
    assert found.said == ("waves come every 3 h; the 50 rows in between are not used", SEASONS)


def test_heights_of_systems_add_as_squares_and_the_main_one_is_the_higher_in_its_hour():
    one, two = hours([3.0, 1.0, np.nan], 8.0, 0.1), hours([4.0, 0.5, 2.0], 12.0, 0.2)
    found = hindcast.Hindcast(TIME[:3], 3600.0, (one, two))
    np.testing.assert_allclose(found.height, [5.0, math.sqrt(1.25), np.nan])
    main = found.main
    assert (main.height.tolist(), main.period.tolist(), main.direction.tolist()) == (
        [4.0, 1.0, 2.0], [12.0, 8.0, 12.0], [0.2, 0.1, 0.2])  # fmt: skip


def test_a_share_of_rows_without_waves_is_told():
    height = np.full(30, 1.0)
    height[[4, 9, 11]] = np.nan
    assert made(TIME, height).said == ("10 % of the rows have no waves; they are excluded from all shares", SEASONS)


# ------------------------------------------------------------------ largest of years


def test_the_largest_of_hours_alike_is_drawn_of_the_law_of_rayleigh():
    """N hours of m₀ and of ν crossings a second: exp(−N ν h exp(−x²/2m₀)) = p; none without a motion"""
    m0, m2 = np.array([4.0, 4.0, 0.0]), np.array([4.0 * 0.25, 4.0 * 0.25, 0.0])
    count = 2 * 3600 * 0.5 / (2 * math.pi)
    for share in (0.05, 0.5, 0.95):
        wanted = math.sqrt(2 * 4.0 * math.log(count / -math.log(share)))
        assert largest._drawn(m0, m2, 3600.0, share) == pytest.approx(wanted, rel=1e-9)
    assert largest._drawn(np.zeros(3), np.zeros(3), 3600.0, 0.5) == 0.0
    few = 1e-4  # s, in which hardly any wave comes
    assert largest._drawn(m0, m2, few, 0.5) == 0.0
    far = np.array([4.0, (1.999 * largest.LOW / 2) ** 2 * 4.0]), np.array([1.0, 1.0])
    assert largest._drawn(*far, 3600.0, 0.5) == pytest.approx(largest._drawn(m0[:1], m2[:1], 3600.0, 0.5), rel=1e-12)


@pytest.mark.parametrize("part, kept", [(0.899, [2001]), (0.9001, [2001, 2002])])
def test_a_year_counts_with_nine_tenths_of_its_hours(part, kept):
    hours = 8766  # of a year of 365¼ days
    year = np.repeat([2001, 2002], hours)
    known = np.ones(2 * hours, bool)
    known[hours + int(part * hours) :] = False
    assert largest.whole_years(known, year, 3600.0).tolist() == kept
