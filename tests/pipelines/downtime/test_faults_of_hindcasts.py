"""What records of years have: gaps, local time, codes, calms, ice, units, directions, levels; each in one line."""

import numpy as np
import pytest

from hakobune.mooring.environment.tables import TableError
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime.limits import limits_of
from hakobune.pipelines.downtime.study import make_downtime, record_of

WAVES = {"height": "hs", "peak_period": "tp", "direction_from": "dir"}


def study(columns=None, limits=None, waves=None, **hindcast):
    table = {"file": "h.csv", "x_axis_compass_deg": 90.0, "waves": [WAVES | (waves or {})], "columns": columns or {}}
    limits = limits or [{"quantity": "significant height", "at_most": 2.0}]
    return make_downtime({"hindcast": table | hindcast, "operations": [{"name": "cranes", "limits": limits}]})


def rows(count=48, step=3600, start="2020-03-01T00:00", **columns):
    """Text of a record; columns : {head: a value or one for each row}"""
    columns = {"hs": 1.0, "tp": 8.0, "dir": 270.0} | columns
    times = np.datetime64(start, "s") + step * np.arange(count)
    cells = [np.broadcast_to(np.array(values, dtype=object), count) for values in columns.values()]
    lines = [",".join(("time", *columns))]
    lines += [",".join((str(t), *map(str, row))) for t, row in zip(times, zip(*cells, strict=True), strict=True)]
    return lines


def record(tmp_path, lines, **words):
    (tmp_path / "h.csv").write_text("\n".join(lines) + "\n")
    return record_of(study(**words).hindcast, tmp_path).hindcast


def test_gaps_are_told_and_counted_nowhere(tmp_path):
    lines = rows()
    del lines[11:16]
    found = record(tmp_path, lines)
    assert found.slot[-1] == 47 and len(found.time) == 43
    assert any("5 of 48 steps are missing, in 1 gaps, the longest of 5 h" in line for line in found.said)


def over(tmp_path, first, last, without=()):
    """Lines on the seasons of a record of daily rows from the first to the last month, without some months"""
    days = np.arange(np.datetime64(first, "D"), np.datetime64(last, "M") + 1)
    kept = [day for day in days if int(str(day)[5:7]) not in without]
    lines = ["time,hs,tp,dir", *(f"{day}T00:00,1.0,8.0,270.0" for day in kept)]
    return [line for line in record(tmp_path, lines).said if "give whole years" in line]


def test_a_record_of_some_months_is_told_to_be_no_year(tmp_path):
    assert not over(tmp_path, "2018-01-01", "2019-12")
    assert not over(tmp_path, "2018-03-01", "2021-02")
    (line,) = over(tmp_path, "2018-01-01", "2018-03")
    assert "no rows of April, May, June, July, August, September, October, November, December: hours a year" in line
    (line,) = over(tmp_path, "2018-01-01", "2020-12", without=(1, 2, 12))
    assert "no rows of January, February, December: hours a year" in line
    (line,) = over(tmp_path, "2018-01-01", "2019-03")  # one winter more than summers
    assert "has 2 months of January and 1 of April" in line and "give January too much weight" in line


def test_seasons_are_those_of_rows_with_waves(tmp_path):
    days = np.arange(np.datetime64("2018-01-01", "D"), np.datetime64("2020-01-01"))
    lines = [f"{day}T00:00,{'nan' if str(day)[5:7] == '01' else 1.0},8.0,270.0" for day in days]
    said = record(tmp_path, ["time,hs,tp,dir", *lines]).said
    assert any("the record has no rows of January" in line for line in said)


@pytest.mark.parametrize(
    ("head", "low", "high", "told"),
    [("dir", 0.0, 6.2, True), ("dir", 0.0, 6.4, False), ("dir [rad]", 0.0, 6.2, False), ("dir", 5.0, 5.0, False)],
)
def test_directions_of_one_circle_in_radians_are_told(tmp_path, head, low, high, told):
    angles = np.linspace(low, high, 300)
    lines = rows(300, dir=angles)
    found = record(tmp_path, [f"time,hs,tp,{head}", *lines[1:]])
    said = [line for line in found.said if "radians" in line]
    assert len(said) == told
    assert not told or "dir lies between 0 and 6.2° in all 300 rows" in said[0]


def test_a_missing_column_is_named_beside_those_that_are_there(tmp_path):
    with pytest.raises(TableError, match=r"no column 'hs'; it has time, Hm0 \[m\], tp, dir"):
        record(tmp_path, ["time,Hm0 [m],tp,dir", *rows()[1:]])


def test_units_in_the_head_are_taken_and_unknown_ones_refused(tmp_path):
    lines = ["time,hs [cm],tp [s],dir [deg],w (knots)", *rows(w=10.0)[1:]]
    found = record(tmp_path, lines, columns={"wind speed": "w"})
    np.testing.assert_allclose([found.height[0], found.columns["wind speed"][0]], [0.01, 5.14444], rtol=1e-5)
    assert not any("have no unit" in line for line in found.said)
    with pytest.raises(TableError, match=r"hs has the unit 'fathom'; allowed: m, cm"):
        record(tmp_path, ["time,hs [fathom],tp,dir", *rows()[1:]])
    assert any("hs, tp, dir in h.csv have no unit" in line for line in record(tmp_path, rows()).said)


NDBC = """\
#YY  MM DD hh mm WDIR WSPD  WVHT   DPD MWD  TIDE
#yr  mo dy hr mn degT m/s     m   sec deg    ft
"""
SWAN = """\
%
% Run:one  Table:tab  SWAN version:41.31
%
%  Time    Hsig   TPsmoo   Dir   X-Windv  Y-Windv
%  [ ]   [m]    [sec]   [degr]   [m/s]   [m/s]
%
"""


def test_tables_of_buoys_and_of_swan_have_times_names_and_units_of_their_own(tmp_path):
    """NDBC: MM and 99.00 are missing; a wind of (3, −4) m/s is one of 5 m/s from 323.1301°"""
    hours = [f"2019 08 01 {h:02} 00 231 1.6 {'MM' if h == 1 else '99.00' if h == 2 else 1.5} 8.0 270 2.0"
             for h in range(24)]  # fmt: skip
    waves = {"height": "WVHT", "peak_period": "DPD", "direction_from": "MWD"}
    found = record(tmp_path, [NDBC + hours[0], *hours[1:]], waves=waves, columns={"level": "TIDE"}, level_at_rest=0.0)
    newest_first = record(tmp_path, [NDBC + hours[-1], *hours[-2::-1]], waves=waves)
    assert str(newest_first.time[1]) == "2019-08-01T01:00:00"
    assert str(found.time[1]) == "2019-08-01T01:00:00" and found.columns["level"][0] == pytest.approx(0.6096)
    assert np.isnan(found.height[1:3]).all() and found.height[0] == 1.5
    hours = [f"20161011.{h:02}0000 1.5 8.0 270.0 3.0 -4.0" for h in range(24)]
    waves = {"height": "Hsig", "peak_period": "TPsmoo", "direction_from": "Dir"}
    columns = {"wind east": "X-Windv", "wind north": "Y-Windv"}
    found = record(tmp_path, [SWAN + hours[0], *hours[1:]], waves=waves, columns=columns)
    assert str(found.time[2]) == "2016-10-11T02:00:00" and found.columns["wind speed"][0] == 5.0
    assert np.degrees(found.columns["wind from"][0]) == pytest.approx(323.1301, abs=1e-4)
    with pytest.raises(StudyError, match="has 'wind east' only; give both 'wind east' and 'wind north'"):
        record(tmp_path, [SWAN + hours[0], *hours[1:]], waves=waves, columns={"wind east": "X-Windv"})


def test_waves_that_come_every_third_row_are_a_record_of_these_rows(tmp_path):
    """As of a buoy whose wind is there every ten minutes; times are seconds since 1970"""
    height = ["", *(1.0 if i % 3 == 1 else "" for i in range(1, 90))]
    lines = rows(90, 600, hs=height, w=np.arange(90))
    seconds = ["time,hs,tp,dir,w", *(f"{1_583_020_800 + 600 * i},{line.partition(',')[2]}"
                                     for i, line in enumerate(lines[1:]))]  # fmt: skip
    for one in (lines, seconds):
        found = record(tmp_path, one, columns={"wind speed": "w"})
        assert found.hours == 0.5 and np.isfinite(found.height).all() and len(found.time) == 30
        assert str(found.time[0]) == "2020-03-01T00:10:00" and found.columns["wind speed"][:2].tolist() == [1.0, 4.0]
        assert any("waves come every 0.5 h; the 60 rows in between are not used" in line for line in found.said)


def test_files_of_several_places_and_years_and_of_a_spectrum_each_hour(tmp_path):
    """efth of 1 m²/Hz/rad within a tent of 0.1 Hz and 90° towards east: m₀ = 0.1 · π/2"""
    import xarray

    towards = {"standard_name": "sea_surface_wave_to_direction", "units": "degree"}
    axes = "valid_time", "place", "frequency", "direction"
    for year in (2020, 2021):
        density = np.zeros((24, 2, 3, 4))
        density[:, 1, 1, 1] = 1.0
        density[3] = np.nan
        xarray.Dataset(
            {"efth": (axes, density, {"units": "m2 s rad-1"}), "wnd": (axes[:2], np.full((24, 2), year / 1000.0))},
            {"valid_time": np.datetime64(f"{year}-01-01T00", "ns") + np.timedelta64(1, "h") * np.arange(24),
             "frequency": [0.1, 0.2, 0.3], "direction": ("direction", [0.0, 90.0, 180.0, 270.0], towards)},
        ).to_netcdf(tmp_path / f"w{year}.nc", engine="h5netcdf")  # fmt: skip
    table = {"file": "w*.nc", "x_axis_compass_deg": 90.0, "columns": {"wind speed": "wnd"}, "location": 2}
    limits = [{"name": "cranes", "limits": [{"quantity": "significant height", "at_most": 2.0}]}]
    found = record_of(make_downtime({"hindcast": table, "operations": limits}).hindcast, tmp_path)
    one = found.hindcast
    assert len(one.time) == 48 and one.columns["wind speed"][[0, 47]].tolist() == [2.02, 2.021]
    assert one.height[0] == pytest.approx(4 * np.sqrt(0.05 * np.pi), rel=1e-6) and np.isnan(one.height[[3, 27]]).all()
    assert one.main.period[0] == pytest.approx(5.0, rel=0.05)
    assert np.exp(1j * one.main.direction[0]) == pytest.approx(1.0)
    assert found.planes.path(23).name == "w2020.nc" and found.planes.path(24).name == "w2021.nc"
    for words in (
        "w2020.nc has 2 places|w2020.nc: wnd has the axes valid_time 24, place 2, but only valid_time is expected",
        "w2019",
    ):
        with pytest.raises(ValueError, match=words):
            record_of(make_downtime({"hindcast": table | ({"file": "w2019*.nc"} if words == "w2019" else {
                "location": None}), "operations": limits}).hindcast, tmp_path)  # fmt: skip


def test_heights_in_another_unit_are_refused_with_the_way_out(tmp_path):
    with pytest.raises(TableError, match=r"height of waves is 120 in 48 rows; allowed: 0 to 30 .* \"hs \[cm\]\""):
        record(tmp_path, rows(hs=120.0))


def test_codes_and_empty_places_are_unknown_hours(tmp_path):
    found = record(tmp_path, rows(hs=[-999, "", *[1.0] * 46], dir=[270, 270, 999, *[270.0] * 45]))
    assert np.isnan(found.height[:3]).all() and np.isfinite(found.height[3:]).all()
    assert any("codes for missing data, such as -999" in line for line in found.said)
    assert any("6.25 % of the rows have no waves" in line for line in found.said)


def test_calms_need_no_period_and_no_direction(tmp_path):
    found = record(tmp_path, rows(hs=[0.0, *[1.0] * 47], tp=["", *[8.0] * 47], dir=["", *[270.0] * 47]))
    assert found.height[0] == 0 and any("1 rows are calm," in line for line in found.said)


def test_hours_under_ice_have_no_waves(tmp_path):
    lines = rows(hs=["", "", *[1.0] * 46], ice=[0.9, 0.0, *[0.0] * 46])
    found = record(tmp_path, lines, columns={"ice": "ice"})
    assert found.height[0] == 0 and np.isnan(found.height[1])
    assert any("1 rows have ice and no waves; they count as calm" in line for line in found.said)


def test_directions_from_and_to_are_half_a_turn_apart_in_axes_of_the_body(tmp_path):
    """The bow heads east: waves from the west travel along +x, waves from the north towards −y, clockwise seen"""
    found = record(tmp_path, rows(dir=[270.0, 0.0, *[90.0] * 46]))
    np.testing.assert_allclose(np.exp(1j * found.main.direction[:3]), [1, np.exp(-0.5j * np.pi), -1], atol=1e-12)
    to = record(tmp_path, rows(dir=90.0), waves={"direction_from": None, "direction_to": "dir"})
    np.testing.assert_allclose(np.exp(1j * to.main.direction[0]), 1, atol=1e-12)
    with pytest.raises(StudyError, match="neither is given; give one of direction_from, direction_to"):
        record(tmp_path, rows(), waves={"direction_from": None})


def test_a_level_needs_to_know_what_it_is_above(tmp_path):
    lines = rows(wl=1.5)
    with pytest.raises(
        StudyError,
        match=r"hindcast\.columns has a water level, but level_at_rest is missing; give the value of that",
    ):
        record(tmp_path, lines, columns={"level": "wl"})
    found = record(tmp_path, lines, columns={"level": "wl"}, level_at_rest=1.2)
    assert found.columns["level"][0] == pytest.approx(0.3)


def local(zone_steps):
    """A head and rows at local times"""
    return ["time,hs,tp,dir", *(f"{t},1,8,270" for t in zone_steps)]


AUTUMN = [f"2020-10-24T{h:02}:00" for h in range(24)] + [f"2020-10-25T{h:02}:00" for h in (0, 1, 2, 2, 3, 4)]


def test_summer_time_in_a_record_that_says_utc_is_found_out(tmp_path):
    with pytest.raises(
        TableError,
        match=r"1 hours are repeated, first .*local time with summer time; give "
        r"hindcast.zone",
    ):
        record(tmp_path, local(AUTUMN))


def test_local_time_with_summer_time_is_turned_into_utc(tmp_path):
    found = record(tmp_path, local(AUTUMN), zone="Europe/Berlin")
    assert str(found.time[0]) == "2020-10-23T22:00:00" and set(np.diff(found.time).astype(int)) == {3600}
    spring = [f"2020-03-28T{h:02}:00" for h in range(24)] + [f"2020-03-29T{h:02}:00" for h in (0, 1, 3, 4)]
    assert set(np.diff(record(tmp_path, local(spring), zone="Europe/Berlin").time).astype(int)) == {3600}
    with pytest.raises(TableError, match="2020-03-29T02:00:00 does not exist in Europe/Berlin"):
        record(tmp_path, local([*spring[:26], "2020-03-29T02:00", *spring[26:]]), zone="Europe/Berlin")


@pytest.mark.parametrize(("zone", "ending", "first"), [
    ("+09:00", "", "2020-02-29T15:00:00"),
    ("UTC", "Z", "2020-03-01T00:00:00"),
    ("UTC", "+02:00", "2020-02-29T22:00:00"),
])  # fmt: skip
def test_offsets_of_the_zone_or_of_each_time(tmp_path, zone, ending, first):
    times = np.datetime64("2020-03-01T00:00", "m") + 60 * np.arange(30)
    assert str(record(tmp_path, local(f"{t}{ending}" for t in times), zone=zone).time[0]) == first


@pytest.mark.parametrize(("lines", "words"), [
    (local(["01/02/2020 00:00"] * 30), "time is '01/02/2020 00:00'; allowed: ISO 8601"),
    (local(["2020-01-01T00:00"] * 30), "time does not increase after 2020-01-01T00:00:00, at 29 places; "
    "allowed: increasing, without repetition"),
    (rows()[:10], "has 9 rows; allowed: at least 24"),
    ([*rows(), "2020-03-03T00:30:00,1,8,270"], "step after 2020-03-02T23:00:00 is 1.5 h and the other steps are 1 h"),
    ([*rows(), "2020-03-03T00:00:00,1,8"], "row 50: 3 cells; allowed: 4"),
    (rows(hs="low"), "row 2: hs is 'low'; allowed: a number"),
    (rows(dir=400.0), "dir is 400°; allowed: −360 to 360"),
])  # fmt: skip
def test_records_that_are_none_are_refused_in_a_line(tmp_path, lines, words):
    with pytest.raises(ValueError, match=words.replace("(", r"\(")) as refused:
        record(tmp_path, lines)
    assert "\n" not in str(refused.value)


RESPONSES = {"roll": "rad", "heave": "m"}


@pytest.mark.parametrize(("limit", "words"), [
    ({"quantity": "rol", "at_most": 1.0}, "no result gives 'rol'; allowed: significant height, roll, heave"),
    ({"quantity": "wind speed", "at_most": 1.0}, "'wind speed', which requires a column in hindcast.columns"),
    ({"quantity": "under-keel clearance", "at_least": 1.0}, "which requires .keel. and a finite depth"),
    ({"quantity": "roll", "at_least": 1.0}, "roll is limited from above; give at_most"),
    ({"quantity": "roll"}, "neither is given; give one of at_most, at_least"),
    ({"quantity": "roll", "at_most": 0.0}, "at_most is 0; allowed: above 0"),
    ({"quantity": "roll", "at_most": 1.0, "statistic": "mean"}, "statistic is 'mean'; allowed: largest"),
    ({"quantity": "significant height", "at_most": 1.0, "statistic": "significant"}, "has no statistic"),
])  # fmt: skip
def test_limits_that_nothing_computes_are_refused(limit, words):
    with pytest.raises(StudyError, match=words):
        limits_of(study(limits=[limit]), [], RESPONSES)


def test_a_rule_set_gives_its_limits_and_asks_which_ships_it_is_about():
    raw = {"name": "cranes", "rule": "PIANC"}
    table = {"file": "h.csv", "x_axis_compass_deg": 0.0, "waves": [WAVES]}
    with pytest.raises(StudyError, match=r"subject is missing; allowed for PIANC: fishing vessel; elevator crane"):
        limits_of(make_downtime({"hindcast": table, "operations": [raw]}), [], RESPONSES)
    raw |= {"subject": "freighter, coaster; quay cranes"}
    six = dict.fromkeys(("surge", "sway", "heave"), "m") | dict.fromkeys(("roll", "pitch", "yaw"), "rad")
    found = limits_of(make_downtime({"hindcast": table, "operations": [raw]}), [], six)
    assert "cranes: surge, peak to peak ≤ 1 m" in [one.label for one in found]
