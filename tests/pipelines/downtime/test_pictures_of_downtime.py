"""What pictures and the page of a downtime study show, of a Result whose numbers are set by hand."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from hakobune.pipelines.downtime import pictures, report
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels

NAN = np.nan
MONTHS = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"]
COLOURS = ["#1f77b4", "#ff7f0e"]


def result(**more):
    """Cranes and arms; the interval of the arms is not known"""
    share = np.stack([np.linspace(0.01, 0.12, 12), np.linspace(0.2, 0.31, 12)], axis=1)
    unknown = np.array([1.0, NAN])
    of = {
        "month.share": (share, ("month", "operation")), "month.low": (0.5 * share * unknown, ("month", "operation")),
        "month.high": (3 * share * unknown, ("month", "operation")),
        "wait.mean": (100 * share, ("month", "operation")), "wait.low": (90 * share, ("month", "operation")),
        "wait.high": (130 * share, ("month", "operation")),
        "year.share": ([[0.1, 0.2], [0.3, 0.6]], ("year", "operation")), "downtime.share": ([0.2, 0.4], ("operation",)),
        "sector.hours": ([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]], ("sector", "operation")),
        "window.share": ([[0.9, 0.8], [0.7, 0.5]], ("window", "operation")),
        "downtime.hours": ([1753.2, 0.0], ("operation",)), "downtime.hours_low": ([1700.0, NAN], ("operation",)),
        "downtime.hours_high": ([1800.0, NAN], ("operation",)), "cause.hours": ([300.0, 1500.0, 9000.0], ("limit",)),
    }  # fmt: skip
    axes = labels("operation", ["cranes", "arms"]) | labels("month", MONTHS) | labels("year", [2001, 2002])
    axes |= labels("sector", ["N", "E", "S", "W"]) | labels("window", [6.0, 12.0])
    axes |= labels("limit", ["cranes: roll ≤ 2 deg", "cranes: wind ≤ 20 m/s", "arms: sway ≤ 1 m"])
    detail = SimpleNamespace(limits=[SimpleNamespace(operation=i) for i in (0, 0, 1)],
                             study=SimpleNamespace(hindcast=SimpleNamespace(file="bay <1>.csv")))  # fmt: skip
    made = Result("downtime", {name: Quantity(np.array(v), a) for name, (v, a) in of.items()}, axes, detail=detail)
    return replace(made, quantities=made.quantities | more)


def limited(values):
    """The result with seas of two periods from four directions, that stop the arms alone"""
    height = np.full((2, 4, 2), NAN)
    height[..., 1] = values
    found = result()
    return replace(
        found,
        quantities=found.quantities | {"limiting.height": Quantity(height, ("period", "comes_from", "operation"), "m")},
        labels=found.labels | labels("period", [5.0, 9.0], "s") | labels("comes_from", [0.0, 90.0, 180.0, 270.0]),
    )


def axes_of(panel, found, polar=False):
    axes = Figure().add_subplot(polar=polar)
    panel(found, axes)
    return axes


@pytest.mark.parametrize(("panel", "size", "low", "high", "label"), [
    (pictures.months, 100.0, 0.5, 3.0, "downtime, %"), (pictures.waits, 100.0, 0.9, 1.3, "mean wait, h"),
])  # fmt: skip
def test_bars_of_a_month_stand_beside_each_other_about_its_mark_with_their_interval(panel, size, low, high, label):
    """Two of 0.4 in 0.8 of a month, the first to the left; an interval that is not known is not drawn"""
    axes = axes_of(panel, result())
    bars = [one for one in axes.containers if one.get_label() in ("cranes", "arms")]
    assert [one.get_label() for one in bars] == ["cranes", "arms"] and axes.get_ylabel() == label
    for o, (bar, start) in enumerate(zip(bars, (0.01, 0.2), strict=True)):
        assert [one.get_height() for one in bar] == pytest.approx(size * (start + 0.01 * np.arange(12)))
        assert [one.get_x() for one in bar] == pytest.approx(np.arange(12) - 0.4 + 0.4 * o)
        assert [one.get_width() for one in bar] == pytest.approx([0.4] * 12)
        assert to_hex(bar[0].get_facecolor()) == COLOURS[o]
    errors = [one for one in axes.containers if one not in bars]
    assert len(errors) == (1 if panel is pictures.months else 2)
    ends = np.array(errors[0].lines[2][0].get_segments())
    assert ends[:, :, 0] == pytest.approx(np.repeat(np.arange(12)[:, None] - 0.2, 2, axis=1))
    share = size * (0.01 + 0.01 * np.arange(12))
    assert ends[:, :, 1] == pytest.approx(np.stack([low * share, high * share], axis=1))
    assert [one.get_text() for one in axes.get_xticklabels()] == MONTHS and axes.get_ylim()[0] == 0


def test_years_are_drawn_in_per_cent_with_their_mean():
    axes = axes_of(pictures.years, result())
    one, mean, other, second = axes.lines
    assert one.get_xydata().tolist() == [[2001, 10], [2002, 30]] and other.get_ydata().tolist() == [20, 60]
    assert list(mean.get_ydata()) == [20, 20] and list(second.get_ydata()) == [40, 40]
    assert (one.get_label(), other.get_label()) == ("cranes", "arms") and axes.get_ylim()[0] == 0


def test_windows_are_drawn_over_their_length_in_per_cent_of_the_time():
    axes = axes_of(pictures.persistence, result())
    one, other = axes.lines
    assert one.get_xydata().tolist() == [[6, 90], [12, 70]] and other.get_xydata().tolist() == [[6, 80], [12, 50]]
    assert (one.get_label(), other.get_label()) == ("cranes", "arms") and axes.get_xlim()[0] == 0


def test_a_rose_has_north_on_top_and_goes_round_clockwise():
    """Four sectors of 90°, of which the bars of two operations take 0.8: 36° each, the first anticlockwise"""
    axes = axes_of(pictures.rose, result(), True)
    assert axes.get_theta_direction() == -1 and axes.get_theta_offset() == pytest.approx(np.pi / 2)
    assert len(axes.containers) == 2
    for o, bar in enumerate(axes.containers):
        assert [one.get_height() for one in bar] == [1.0 + o, 3.0 + o, 5.0 + o, 7.0 + o]
        middle = [np.degrees(one.get_x() + 0.5 * one.get_width()) for one in bar]
        assert middle == pytest.approx(90 * np.arange(4) + (-18 if o == 0 else 18))
        assert np.degrees(bar[0].get_width()) == pytest.approx(36) and bar.get_label() == ("cranes", "arms")[o]
    assert [one.get_text() for one in axes.get_xticklabels()] == ["N", "NE", "E", "SE", "S", "SW", "W", "NW"]


def test_operations_with_a_limiting_sea_are_those_that_have_a_height_somewhere():
    assert pictures.limited(result()) == [] and pictures.limited(limited(NAN)) == []
    assert pictures.limited(limited([[NAN, NAN, NAN, 2.0], [NAN] * 4])) == [1]


def test_a_limiting_sea_is_closed_round_the_compass_and_coloured_to_twice_its_lower_quartile(monkeypatch):
    """Heights 2 to 7 m: the lower quartile is 2, so that colours end at 4 or the next round number above"""
    drawn = []
    axes = Figure().add_subplot(polar=True)
    contourf = axes.contourf
    monkeypatch.setattr(axes, "contourf", lambda *given, **words: drawn.append(given) or contourf(*given, **words))
    pictures.limiting(limited([[2.0, 2.0, 2.0, 3.0], [2.0, 5.0, 6.0, 7.0]]), 1, axes)
    ((angle, period, height, levels),) = drawn
    assert np.degrees(angle) == pytest.approx([0, 90, 180, 270, 360]) and period.tolist() == [5.0, 9.0]
    assert height.tolist() == [[2, 2, 2, 3, 2], [2, 5, 6, 7, 2]]
    assert levels[0] == 0 and 4 <= levels[-1] < 5 and 6 <= len(levels) <= 11
    assert axes.get_ylim() == (0, 9.0) and axes.get_title().startswith("arms: limiting sea")
    assert axes.figure.axes[1].get_ylabel() == "significant height, m"


def test_colours_of_a_limiting_sea_count_each_direction_once(monkeypatch):
    """A quarter of the heights are 1 m, the others 4: the lower quartile is 3.25 m"""
    axes = Figure().add_subplot(polar=True)
    levels, contourf = [], axes.contourf
    monkeypatch.setattr(axes, "contourf", lambda *given, **more: levels.extend(given[3]) or contourf(*given, **more))
    pictures.limiting(limited([[1.0, 4.0, 4.0, 4.0]] * 2), 1, axes)
    assert 6.5 <= levels[-1] < 7.6


@pytest.mark.parametrize(("found", "last"), [(result(), "weather"), (limited(2.0), "limiting")])
def test_a_sheet_has_five_panels_and_the_limiting_sea_where_there_is_one(monkeypatch, found, last):
    kept = []
    monkeypatch.setattr(pictures, "save", lambda figure, path, dpi: kept.append((figure, path)))
    pictures.draw(found, "sheet.png")
    ((figure, path),) = kept
    titles = [re.sub(r"\n.*", "", one.get_title(), flags=re.DOTALL) for one in figure.axes if one.get_title()]
    wanted = ["by month, with the 90 % interval between years", "by year",
              "hours a year, by the direction that waves come from", "weather windows",
              "waiting time for the window that each operation needs"]  # fmt: skip
    assert titles == wanted + ["arms: limiting sea"] * (last == "limiting") and path == "sheet.png"
    assert [one.get_text() for one in figure.axes[0].get_legend().get_texts()] == ["cranes", "arms"]
    assert [one.name == "polar" for one in figure.axes[:5]] == [False, False, True, False, False]


@pytest.mark.parametrize(("panel", "polar"), [(pictures.years, False), (pictures.rose, True)])
def test_a_panel_of_the_page_stands_alone_with_its_legend(monkeypatch, panel, polar):
    kept = []
    monkeypatch.setattr(pictures, "save", lambda figure, path, dpi: kept.append(figure))
    pictures.one_panel(panel, result(), "one.png", polar)
    (axes,) = kept[0].axes
    assert (axes.name == "polar") is polar and (axes.get_legend() is None) is polar


def test_the_page_tells_hours_share_interval_and_the_cause_that_stops_most():
    """1753.2 h of a year of 8766; the limits of another operation are no cause"""
    cranes, arms = (report._verdict(result(), number) for number in range(2))
    text = "is down 1753 h a year, 20 % of the time, 90 % interval 1700 to 1800 h; the main cause is wind ≤ 20 m/s with"
    assert cranes == {"name": "cranes", "text": f"{text} 1500 h."}
    assert arms == {"name": "arms", "text": "is down 0 h a year, 40 % of the time."}


def test_the_page_has_a_picture_of_every_panel_and_of_each_limiting_sea(monkeypatch):
    drawn = []
    monkeypatch.setattr(report, "data_address", lambda draw: draw("p.png"))
    monkeypatch.setattr(pictures, "one_panel", lambda panel, found, path, polar: drawn.append((panel, polar)))
    words = [one["words"] for one in report._pictures(limited(2.0))]
    assert words == ["downtime by month", "downtime by year", "rose of downtime", "weather windows", "waiting times",
                     "limiting sea of arms"]  # fmt: skip
    assert [polar for _, polar in drawn] == [False, False, True, False, False, True]
    assert [one for one, _ in drawn[:5]] == [pictures.months, pictures.years, pictures.rose, pictures.persistence,
                                             pictures.waits]  # fmt: skip
    found, asked = limited(2.0), []
    found.quantities["limiting.height"].values[0, 0, 0] = 1.0
    monkeypatch.setattr(pictures, "limiting", lambda found, number, axes: asked.append(number))
    both = list(report._pictures(found))[5:]
    assert [one["words"] for one in both] == ["limiting sea of cranes", "limiting sea of arms"]
    for panel, _ in drawn[-2:]:
        panel(result(), None)
    assert asked == [0, 1]


def test_a_page_is_known_by_its_mark_and_has_its_text_and_the_name_of_its_record(monkeypatch, tmp_path):
    monkeypatch.setattr(report, "data_address", lambda draw: "data:none")
    path = tmp_path / "page.html"
    path.write_text(report.page_of(result(), "[hindcast]\nfile = 'bay'"), encoding="utf-8")
    assert report.written_by_downtime(path) and "is down 1753 h a year" in path.read_text(encoding="utf-8")
    assert "[hindcast]" in path.read_text(encoding="utf-8") and "bay <1>" not in path.read_text(encoding="utf-8")
    path.write_text("<html>")
    assert not report.written_by_downtime(path)


@pytest.mark.parametrize("count", [1, 3, 7])
def test_bars_of_any_number_of_operations_lie_about_their_month_and_six_are_drawn(count):
    """One is 0.8 broad on its mark; of seven six have a colour"""
    names = [f"work {i}" for i in range(count)]
    value = np.ones((12, count))
    axes = Figure().add_subplot()
    made = SimpleNamespace(labels={"operation": SimpleNamespace(values=np.array(names))})
    pictures._bars(made, axes, value, NAN * value, NAN * value)
    drawn = min(count, 6)
    assert [bar.get_label() for bar in axes.containers] == names[:drawn]
    assert axes.containers[0][3].get_x() == pytest.approx(3 - 0.4)
    last = axes.containers[-1][3]
    assert last.get_x() + last.get_width() == pytest.approx(3 + 0.4) and last.get_width() == pytest.approx(0.8 / drawn)
