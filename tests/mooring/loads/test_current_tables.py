"""The current tables of the SR179 report (1982): every printed value, the crest, what lies between, what is a guess."""

import warnings
from contextlib import nullcontext
from importlib.resources import files
from itertools import pairwise

import numpy as np
import pytest
from kinks import assert_slope_is_continuous

from hakobune.meshing.text_files import packaged_rows
from hakobune.mooring.loads.box_current import ANGLES, _crest, box_table, current_force
from hakobune.mooring.loads.crest import CrestSurface, Point

TANK = {1.2: 1.4, 2.0: 1.8}
DRAFT = 10.0


def digitised(name):
    return packaged_rows("hakobune.mooring.loads", name)


def numbers(row, *keys):
    return [float(row[key]) for key in keys]


def table(slender, wide, relative):
    return box_table(slender * wide * DRAFT, wide * DRAFT, DRAFT, relative * DRAFT)


def column(table, name):
    return table.x if name == "C_x" else table.y


def surface(name):
    return lambda b, h: column(table(2.0, b, h), name)[0 if name == "C_x" else -1]


def crests(name):
    rows = [r for r in digitised("current_depths") if r["coefficient"] == name and r["crest"] == "1"]
    return sorted(numbers(r, "depth_over_draft", "beam_over_draft", "value") for r in rows)


def test_every_printed_value_is_returned():
    for row in digitised("current_angles"):
        sizes = numbers(row, "length_over_beam", "beam_over_draft", "depth_over_draft")
        printed = numbers(row, "0", "15", "30", "45", "60", "75", "90")
        assert np.allclose(column(table(*sizes), row["coefficient"]), printed, rtol=0, atol=1e-12), row


def test_every_printed_value_of_the_depth_series_is_returned():
    rows = digitised("current_depths")
    assert len(rows) == 59
    for row in rows:
        b, h, value = numbers(row, "beam_over_draft", "depth_over_draft", "value")
        assert np.isclose(surface(row["coefficient"])(b, h), value, rtol=0, atol=1e-12), row


def test_tables_agree_where_two_of_them_print_the_same():
    """0° of table 2.2.3.2 with 2.2.3.3, 90° of 2.2.3.5 with 2.2.3.6: 12 common cells each."""
    keys = ("beam_over_draft", "depth_over_draft")
    series = {(r["coefficient"], *numbers(r, *keys)): r["value"] for r in digitised("current_depths")}
    common = 0
    for r in digitised("current_angles"):
        if r["length_over_beam"] == "2":
            assert float(r["0" if r["coefficient"] == "C_x" else "90"]) == float(
                series[r["coefficient"], *numbers(r, *keys)]
            )
            common += 1
    assert common == 24


@pytest.mark.parametrize("name", ["C_x", "C_y"])
def test_crest_between_depths_is_as_high_as_its_neighbours(name):
    """Straight lines between the columns H/d = 1.2 and 1.4 of C_x would cut it from 1.85 to 1.69."""
    f, b = _crest(name), np.linspace(10.0, 20.0, 150)
    for (h0, _, v0), (h1, _, v1) in pairwise(crests(name)):
        h = 2 / (1 / h0 + 1 / h1)
        highest = max(f(x, h) for x in b)
        assert min(v0, v1) - 5e-3 <= highest <= max(v0, v1) + 5e-3, (h, highest)  # half the last printed digit


@pytest.mark.parametrize("name", ["C_x", "C_y"])
def test_going_to_shallow_water_the_coefficient_has_one_crest(name):
    f = _crest(name)
    for b in np.arange(9.0, 20.1, 1.0):
        along = np.array([f(b, 1 / x) for x in np.linspace(1 / 9, 1 / 1.2, 60)])
        highest = int(np.argmax(along))
        # half the last printed digit; next to the crest of C_y at b = 12 its height varies by as much
        assert np.all(np.diff(along[: highest + 1]) > -5e-3) and np.all(np.diff(along[highest:]) < 5e-3), b


@pytest.mark.parametrize("name", ["C_x", "C_y"])
def test_slopes_over_both_axes_are_continuous_also_across_the_crest(name):
    f = _crest(name)
    for h, r, _ in crests(name)[1:-1]:
        at = 1.07 * h
        crest = float(f._edge(1 / at))
        assert_slope_is_continuous(lambda b, at=at: f(b, at), np.array([8.0, 10.0, crest, 15.0, 17.3]), 1e-2)
        assert_slope_is_continuous(lambda b, at=h: f(b, at), np.array([8.0, 10.0, r, 17.3]), 1e-2)
        for at in (r, 10.0, 0.97 * r):
            nodes = [1 / h, 1 / 1.4, 1 / 1.6, 1 / 2.0, 1 / 3.0, 1 / (1.8 * at)]
            assert_slope_is_continuous(lambda x, at=at: f(at, 1 / x), np.array(nodes), 1e-3)


def test_all_coefficients_of_a_table_have_continuous_slopes_over_depth_and_draft():
    nodes = np.array([1 / 1.4, 1 / 1.6, 1 / 2.0, 1 / 3.0])
    for i in (2, 4):
        assert_slope_is_continuous(lambda x, i=i: table(2.0, 12.0, 1 / x).x[i], nodes)
        assert_slope_is_continuous(lambda b, i=i: table(2.0, b, 1.9).y[i], np.array([10.0, 12.0, 15.0, 18.0]), 1e-2)


def test_a_ridge_made_up_is_found_back():
    """Crest of height 2 on b = 10 h, falling off with the distance from it as a parabola in b."""
    heights = (1.2, 1.4, 1.6)
    points = [Point(b, h, 2.0 - 0.01 * (b - 10 * h) ** 2, b == 10 * h) for h in heights for b in np.arange(5.0, 21.0)]
    points += [Point(b, 1.8 * b, 0.5, False) for b in (5.0, 20.0)]
    made = CrestSurface([*points, Point(20.0, 2.0, 2.0, True)], 1.8)
    for h in (1.25, 1.3, 1.5):
        assert np.isclose(made(10 * h, h), 2.0, atol=5e-3)
        for b in (8.0, 11.0, 17.0):
            assert np.isclose(made(b, h), 2.0 - 0.01 * (b - 10 * h) ** 2, atol=0.05)


def test_a_deeper_sea_is_as_deep_as_the_tank():
    for slender, wide in ((2.0, 12.0), (1.2, 10.0), (1.2, 13.0)):
        tank = table(slender, wide, TANK[slender] * wide)
        for relative in (2 * TANK[slender] * wide, np.inf):
            deep = table(slender, wide, relative)
            assert np.allclose([deep.x, deep.y], [tank.x, tank.y], atol=1e-12)


def test_between_tested_slendernesses_values_lie_between_and_are_called_a_guess():
    low, high = (table(s, 10.0, 30.0) for s in (1.2, 2.0))
    middle = table(1.6, 10.0, 30.0)
    assert np.allclose(middle.x, (low.x + high.x) / 2) and np.allclose(middle.y, (low.y + high.y) / 2)
    assert any("L/B = 1.6 lies between" in note for note in middle.notes)
    assert any("moment for L/B = 1.6 is a guess (lever 0.054 L" in note for note in middle.notes)


def test_moment_vanishes_towards_a_square_and_is_the_printed_law_at_two():
    assert np.allclose(table(2.0, 10.0, 20.0).lever, 0.09 * np.abs(np.sin(2 * ANGLES)) ** 1.2, atol=1e-12)
    levers = [table(s, 10.0, 20.0).lever[3] for s in (1.2, 1.5, 1.8, 2.0)]
    assert np.allclose(np.diff(levers) / np.diff([1.2, 1.5, 1.8, 2.0]), 0.09)  # on to 0 at L/B = 1


@pytest.mark.parametrize(
    ("sizes", "value"),
    [((2.0, 15.0, 1.6), "0.32"), ((2.0, 13.0, 1.7), "0.32"), ((2.0, 12.0, 5.0), "0.25"), ((1.2, 10.0, 1.15), "1.67")],
)
def test_printed_values_out_of_line_are_named_where_they_are_used(sizes, value):
    beside = {"0.32": "0.00 at 0°, 1.20 at 30°", "0.25": "0.13 at 15°, 0.55 at 45°", "1.67": "1.61 at 75°"}[value]
    assert any(f"C_y = {value}" in note and f"neighbours ({beside})" in note for note in table(*sizes).notes)
    b, h = (s * DRAFT for s in sizes[1:])
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        current_force(1.0, 0.3, sizes[0] * b, b, DRAFT, depth=h)
    assert any(f"C_y = {value}" in str(warning.message) for warning in told)


def test_sound_values_come_without_notes():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        current_force(1.0, 0.3, 200.0, 100.0, 10.0, depth=14.0)
        current_force(1.0, 0.3, 200.0, 100.0, 20.0, depth=26.0)


def test_tables_travel_with_the_package():
    names = {file.name for file in files("hakobune.mooring.loads").joinpath("tables").iterdir()}
    assert {"current_angles.csv", "current_depths.csv", "turning_derivatives.csv"} <= names


@pytest.mark.parametrize(
    ("name", "low", "high", "sizes"),
    [
        ("L/B", 1.0, 12.0, lambda ratio: (10.0 * ratio, 10.0, 2.0, 10.0)),
        ("B/d", 2.0, 60.0, lambda ratio: (20.0, 10.0, 10.0 / ratio, 20.0 / ratio)),
        ("H/d", 1.02, np.inf, lambda ratio: (20.0, 10.0, 1.0, ratio)),
    ],
)
def test_tests_are_led_on_to_the_end_of_their_reach_and_no_farther(name, low, high, sizes):
    box_table(*sizes(low))
    with pytest.raises(ValueError, match=f"^{name} = .*{low:g}") if name != "L/B" else nullcontext():
        box_table(*sizes(0.99 * low))  # a box that is broader than long is turned
    if high < np.inf:
        box_table(*sizes(high))
        with pytest.raises(ValueError, match=f"^{name} = .*{low:g} to {high:g}"):
            box_table(*sizes(1.01 * high))


@pytest.mark.parametrize("name, at, sizes", [
    ("L/B", 2.0, lambda ratio: (100.0 * ratio, 100.0, 10.0, 14.0)),
    ("B/d", 20.0, lambda ratio: (400.0, 200.0, 200.0 / ratio, 280.0 / ratio)),
])  # fmt: skip
def test_a_proportion_within_a_fortieth_of_a_tested_one_is_that(name, at, sizes):
    """Tests end at L/B = 2 and B/d = 20: 2.4 % more is taken as those without a word, 2.6 % more is told"""
    for share, told in ((1.024, False), (1.026, True)):
        notes = " ".join(box_table(*sizes(share * at)).notes)
        assert (f"{name} = {share * at:.4g} is outside the tests; the value for {at:g} is used" in notes) is told
        if name == "L/B":
            assert (f"current moment for L/B = {share * at:.4g} is a guess" in notes) is told


@pytest.mark.parametrize("ratio, between", [(1.2 * 1.024, False), (1.2 * 1.026, True), (2 * 0.974, True),
                                            (2 * 0.976, False)])  # fmt: skip
def test_between_tested_slendernesses_begins_a_fortieth_off_either(ratio, between):
    notes = " ".join(box_table(100.0 * ratio, 100.0, 10.0, 15.0).notes)
    assert ("lies between the tested 1.2 and 2; it is interpolated linearly" in notes) is between


@pytest.mark.parametrize("wide, told", [(10 * 0.974, True), (10 * 0.976, False), (10 * 1.024, False), (10.26, True)])
def test_a_broad_box_was_tested_at_a_tenth_of_its_beam_in_draft(wide, told):
    """L/B = 1.2 in shallow water, B/d = 10 alone"""
    notes = " ".join(box_table(120.0, 100.0, 100.0 / wide, 200.0 / wide).notes)
    assert (f"B/d = {wide:.4g} was not tested with L/B = 1.2; the trend of L/B = 2 is used" in notes) is told


def test_a_column_without_a_crest_ends_flat_and_one_with_a_crest_is_flat_there_alone():
    """Slopes over b at the ends of the columns h = 2 and h = 4, whose crest is inside"""
    points = [Point(b, h, v, c) for b, h, v, c in (
        (2.0, 2.0, 1.0, False), (6.0, 2.0, 2.0, False), (10.0, 2.0, 2.6, False),
        (2.0, 4.0, 1.0, False), (6.0, 4.0, 3.0, True), (10.0, 4.0, 2.0, False),
        (2.0, 20.0, 0.5, False), (10.0, 100.0, 0.9, False),
    )]  # fmt: skip
    curves = CrestSurface(points, 10.0)._curves
    slope = lambda h, b: (curves[h](b + 1e-6) - curves[h](b - 1e-6)) / 2e-6  # noqa: E731
    assert sorted(map(str, curves)) == ["2.0", "4.0", "deep"]
    assert slope(2.0, 10.0 - 1e-6) == pytest.approx(0.0, abs=1e-4) and slope("deep", 10 - 1e-6) == pytest.approx(
        0, abs=1e-4
    )
    assert slope(4.0, 6.0) == pytest.approx(0.0, abs=1e-4) and slope(4.0, 10.0 - 1e-6) < -0.1
    assert slope(2.0, 6.0) > 0.05
