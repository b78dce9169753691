"""The contour of a site in its page, its file and its picture, of a joint law that is set by hand."""

import tomllib

import numpy as np
import pytest

from hakobune.mooring.environment.current_profile import power_law
from hakobune.mooring.environment.scatter import Scatter
from hakobune.mooring.site.contours import JointLaw
from hakobune.mooring.site.extremes import Extreme, ExtremeFit
from hakobune.pipelines.site import report
from hakobune.pipelines.site.states import Climate
from hakobune.pipelines.site.study import (
    EarthquakeTable,
    PlaceTable,
    SiteCurrentTable,
    SiteStudy,
    SiteValues,
    SiteWindTable,
)

LAW = JointLaw((0.5, 1.25, 1.5), (1.0, 0.4, 0.75), (0.05, 0.2, 0.6), "zero_crossing_period", 4.5)
HEIGHT, PERIOD = np.array([1.234567, 4.0, 6.0]), np.array([4.0, 8.765432, 10.0])


def values(years=50.0, climate=True):
    share = np.array([[0.49, 0.0, 0.25], [0.0, 0.26, 0.0]])
    scatter = Scatter(np.array([1.0, 2.0]), np.array([5.0, 7.0, 9.0]), share, "zero_crossing_period")
    own = Climate(scatter, LAW, HEIGHT, PERIOD, (6.0, 10.0), 3.0) if climate else None
    wind = Extreme(30.0, 28.0, 33.0, None)
    states = {"extreme": {"wind": {"speed": 30.0}}}
    return SiteValues(
        years, 0.7, wind, 30.0, None, own, power_law(1.0, 0.0, 16.0, 0.2), {"high": 1.2}, states, 0.18, ()
    )


def test_the_picture_has_the_seas_the_contours_of_one_and_ten_years_and_the_highest(pictures, tmp_path):
    """A sea of a quarter of the time is half as large as one of all; periods across, heights up"""
    report.draw_contour(tmp_path / "p.png", values())
    (axes,) = pictures[0].axes
    (seas,) = axes.collections
    assert seas.get_offsets().tolist() == [[5.0, 1.0], [9.0, 1.0], [7.0, 2.0]]
    assert seas.get_sizes() == pytest.approx(600 * np.sqrt([0.49, 0.25, 0.26]))
    one, ten, fifty, top = axes.lines
    for line, years in ((one, 1.0), (ten, 10.0)):
        height, period = LAW.contour(years, 3.0)
        assert line.get_xydata() == pytest.approx(np.stack([period, height], axis=1))
    assert fifty.get_xydata() == pytest.approx(np.stack([PERIOD, HEIGHT], axis=1))
    assert top.get_xydata().tolist() == [[10.0, 6.0]]
    words = [text.get_text() for text in axes.get_legend().get_texts()]
    assert words == ["seas of the table", "1 year", "10 years", "50 years", "highest"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("zero crossing period, s", "significant height, m")
    assert axes.get_ylim()[0] == 0


def test_a_return_period_of_ten_years_has_its_contour_once(pictures, tmp_path):
    report.draw_contour(tmp_path / "p.png", values(10.0))
    assert [line.get_label() for line in pictures[0].axes[0].lines] == ["1 year", "10 years", "highest"]


def test_the_page_tells_the_law_by_its_numbers(monkeypatch):
    monkeypatch.setattr(report, "data_address", lambda draw: "drawn")
    told = report._climate(values())
    assert told == {
        "picture": "drawn", "height": "γ 0.5 m, α 1.25 m, β 1.5", "mean": "1 + 0.4 H^0.75",
        "spread": "0.05 + 0.2 exp(−0.6 H)", "kind": "zero crossing period", "top": "6 m, 10 s",
    }  # fmt: skip
    assert report._climate(values(climate=False)) is None


def study(**more):
    place = PlaceTable("bay", 16.0, 25.0, probability=0.7)
    return SiteStudy(site=place, **more)


def test_profiles_of_the_page_are_at_the_heights_and_depths_that_are_asked_for():
    """Current of 1 m/s as (1 + z/h)^0.2: at half the depth 2^−0.2; wind at 10 m as it is"""
    asked = study(
        wind=SiteWindTable(speed=30.0, heights=[10.0, 40.0], exponent=0.5),
        current=SiteCurrentTable(1.0, depths=[0.0, 8.0]),
    )
    assert [(z, float(v)) for z, v in report._profile(asked, values())] == [("10", 30.0), ("40", 60.0)]
    current = [(z, float(v)) for z, v in report._current(asked, values())]
    assert current == [("0", pytest.approx(1.0, abs=0.01)), ("8", pytest.approx(2**-0.2, abs=0.01))]
    assert report._profile(study(), values()) == []
    assert report._current(study(), values()._replace(profile=None)) == []


def test_the_file_of_a_site_has_what_studies_read_and_its_contour_with_five_digits():
    asked = study(earthquake=EarthquakeTable("C", {"regional": 0.15}))
    text = report.values_text(asked, values())
    assert text.startswith(report.HEAD)
    found = tomllib.loads(text)
    assert found["site"] == {"name": "bay", "service_life": 25.0, "probability": 0.7, "return_period": 50.0}
    assert found["water"] == {"depth": 16.0} and found["levels"] == {"high": 1.2}
    assert found["states"] == {"extreme": {"wind": {"speed": 30.0}}}
    contour = found["contour"]
    assert (contour["return_period"], contour["period_kind"]) == (50.0, "zero_crossing_period")
    assert contour["height"] == [1.2346, 4.0, 6.0] and contour["period"] == [4.0, 8.7654, 10.0]
    assert found["earthquake"] == {"rule": "C", "coefficient": 0.18}
    less = tomllib.loads(report.values_text(study(), values(climate=False)._replace(seismic=None)))
    assert "contour" not in less and "earthquake" not in less


def test_the_paper_has_the_interval_of_the_return_value_at_its_period(pictures, tmp_path):
    """Gumbel: −ln(−ln(1 − 1/50)) = 3.9019; from 28 to 33 about 30"""
    fit = ExtremeFit("gumbel", 21.0, 2.0, 0.0, np.array([20.0, 24.0, 22.0]))
    report.draw_paper(tmp_path / "p.png", "wind, m/s", Extreme(30.0, 28.0, 33.0, fit), 50.0)
    (axes,) = pictures[0].axes
    x, y = axes.lines[1].get_data()
    assert y == pytest.approx(21 + 2 * x) and axes.lines[0].get_ydata().tolist() == [20.0, 22.0, 24.0]
    (bar,) = axes.containers
    assert bar.lines[0].get_xydata() == pytest.approx(np.array([[3.9019387, 30.0]]))
    (ends,) = bar.lines[2][0].get_segments()
    assert ends == pytest.approx(np.array([[3.9019387, 28.0], [3.9019387, 33.0]]))
    words = [text.get_text() for text in axes.get_legend().get_texts()]
    assert words == ["yearly maxima", "gumbel", "50 years"]
    assert axes.lines[1].get_xdata()[-1] == pytest.approx(-np.log(-np.log(1 - 1 / 200)))
    shown = [label.get_text() for label in axes.get_xticklabels()]
    assert shown == ["1.1", "2", "5", "10", "20", "50", "100", "200"]
    report.draw_paper(tmp_path / "p.png", "wind, m/s", Extreme(30.0, 28.0, 33.0, fit), 400.0)
    assert pictures[1].axes[0].get_xticklabels()[-1].get_text() == "500"
