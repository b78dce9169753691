"""A site from its measurements to the study that stands in it"""

import tomllib
from html.parser import HTMLParser
from pathlib import Path

import pytest
import tomli_w

from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.return_period import return_period
from hakobune.pipelines import cli
from hakobune.pipelines.berth.study import read_berth
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.project import read_project
from hakobune.pipelines.moor.study import read_study
from hakobune.pipelines.response.study import read_response_study
from hakobune.pipelines.single_point.reading import read_study as read_single_point
from hakobune.pipelines.site.result import site
from hakobune.pipelines.site.study import SiteStudy, read_site, site_values

BAY = Path(cli.__file__).parent / "scenes" / "site_bay.toml"
WAVE = "tsunami = 0.5\ntsunami_period = 900.0"
SINGLE = BAY.with_name("single_point_A.toml")
STUDY = {
    "site": {"file": "bay.toml", "state": "extreme", "level": "high"},
    "hull": {"freeboard": 5.0},
    "wind": {"incidence_deg": 0.0},
    "current": {"incidence_deg": 0.0},
    "waves": {"incidence_deg": 0.0},
}


@pytest.fixture
def bay(tmp_path, capsys):
    assert cli.main(["site", str(BAY), "--output", str(tmp_path / "bay.toml")]) == 0
    capsys.readouterr()
    return tmp_path


def test_a_site_is_kept_as_quantities_of_the_values_that_studies_read(bay):
    values, found = tomllib.loads((bay / "bay.toml").read_text()), site(BAY)
    assert found["return_period"] == values["site"]["return_period"]
    for state, tables in values["states"].items():
        for table, numbers in tables.items():
            assert all(found[f"{state}.{table}.{key}"] == value for key, value in numbers.items())
    assert {name: found[f"level[{name}].height"] for name in values["levels"]} == values["levels"]
    assert (
        found["seismic"] == values["earthquake"]["coefficient"] and found.quantity("extreme.wind.speed").unit == "m/s"
    )


def values_of(**tables):
    raw = {"site": {"name": "x", "depth": 10.0, "service_life": 20.0, "probability": 0.5}, **tables}
    import msgspec

    return site_values(msgspec.convert(raw, SiteStudy), Path())


def study(folder, **changes):
    path = folder / "study.toml"
    path.write_text(tomli_w.dumps({key: value for key, value in (STUDY | changes).items() if value is not None}))
    return path


def test_return_periods_are_those_of_the_report():
    assert float(return_period(20, 0.5)) == pytest.approx(29.36, abs=5e-3)
    assert float(return_period(50, 0.36787944)) == pytest.approx(50.5, abs=5e-2)


def test_the_same_site_gives_the_same_bytes_and_a_page_that_needs_nothing(bay):
    first = (bay / "bay.toml").read_bytes(), (bay / "bay.html").read_bytes()
    assert cli.main(["site", str(BAY), "--output", str(bay / "bay.toml")]) == 0
    assert first == ((bay / "bay.toml").read_bytes(), (bay / "bay.html").read_bytes())
    sources = []

    class Page(HTMLParser):
        def handle_starttag(self, tag, attrs):
            sources.extend(value for key, value in attrs if key in ("src", "href"))

    Page().feed(first[1].decode())
    assert len(sources) == 2 and all(source.startswith("data:image/png") for source in sources)


def test_levels_are_tide_and_surge_and_tsunami_and_the_wind_drives_a_hundredth_of_itself():
    levels = {"spring_high": 1.0, "spring_low": -0.9, "surge": 0.8, "tsunami": 0.5}
    values = values_of(wind={"speed": 30.0}, current={"speed": 0.6, "wind_driven": True}, levels=levels)
    assert values.levels == pytest.approx({"high": 1.8, "low": -0.9, "tsunami high": 1.5, "tsunami low": -1.4})
    assert values.states["extreme"]["wind"]["speed"] == pytest.approx(30.0)
    assert values.states["extreme"]["current"]["speed"] == pytest.approx(0.9)


def test_a_single_point_takes_its_water_and_weather_from_a_site_too(bay):
    raw = tomllib.loads(SINGLE.read_text(encoding="utf-8"))
    raw |= {"site": {"file": "bay.toml", "state": "operating", "level": "high"}, "wind": {"incidence_deg": 0.0}}
    raw |= {"current": {"incidence_deg": 0.0}, "waves": {"incidence_deg": 0.0}}
    del raw["water"]
    (bay / "single.toml").write_text(tomli_w.dumps(raw))
    study, laid, _ = read_single_point(bay / "single.toml")
    assert (study.water.depth, study.wind.speed, study.waves.period) == (pytest.approx(21.8), 12.0, 5.0)
    assert "site" not in laid


def scene_at(folder, name, site, leave_out=(), **changes):
    """Path of a scene that stands at the bay, without some of its tables"""
    raw = tomllib.loads(BAY.with_name(name).read_text(encoding="utf-8"))
    raw = {key: value for key, value in raw.items() if key not in leave_out}
    (folder / name).write_text(tomli_w.dumps({**raw, "site": {"file": "bay.toml", **site}, **changes}))
    return folder / name


def test_a_breakwater_a_berthing_and_an_earthquake_take_what_they_know_of_a_site(bay):
    from hakobune.pipelines.breakwater.study import read_breakwater
    from hakobune.pipelines.earthquake.study import quake_of
    from hakobune.pipelines.earthquake.study import read_study as read_earthquake

    site = {"state": "operating", "level": "high"}
    made, text = read_breakwater(scene_at(bay, "breakwater_circle.toml", site, ["water", "sea"], water={"tide": 0.5}))
    assert made.water.depth == pytest.approx(21.8) and made.water.tide == 0.5
    assert (made.sea.height, made.sea.mean_period) == (0.6, 5.0) and "mean_period = 5.0" in text
    assert read_berth(scene_at(bay, "berth_tanker.toml", {"level": "high"}, ["depth"]))[0].depth == pytest.approx(21.8)
    site = tomllib.loads((bay / "bay.toml").read_text(encoding="utf-8"))
    quake = quake_of(read_earthquake(scene_at(bay, "earthquake_box.toml", {}, ["rule", "record"]))[0], bay)
    assert quake.coefficient == site["earthquake"]["coefficient"]


@pytest.mark.parametrize(
    ("name", "reader", "site", "leave_out", "words"),
    [
        (
            "berth_tanker.toml",
            "berth",
            {"state": "extreme"},
            ["depth"],
            "site.state is 'extreme', but a berthing does not use the weather of a site",
        ),
        ("berth_tanker.toml", "berth", {}, [], "depth is given by the study and by its site"),
        (
            "earthquake_box.toml",
            "earthquake",
            {"level": "high"},
            [],
            "site.level is 'high', but an earthquake study does not use the water level of a site",
        ),
        ("earthquake_box.toml", "earthquake", {}, [], "rule and coefficient are both given; give one of them"),
    ],
)
def test_what_such_a_study_does_not_take_of_a_site_is_one_line(bay, name, reader, site, leave_out, words):
    from hakobune.pipelines.earthquake.study import read_study as read_earthquake

    with pytest.raises(StudyError, match=words) as fault:
        {"berth": read_berth, "earthquake": read_earthquake}[reader](scene_at(bay, name, site, leave_out))
    assert "\n" not in str(fault.value)


def test_a_climate_gives_the_extreme_state_its_waves_and_the_page_their_contour(bay):
    """The highest sea of the contour, its peak period as a mean period; the long wave of a tsunami has a√(g/h)"""
    text = BAY.read_text(encoding="utf-8")
    waves = text[text.index("[waves]") : text.index("[current]")]
    scatter = (BAY.parent / "response_climate.csv").as_posix()
    text = text.replace(waves, f'[climate]\nscatter = "{scatter}"\n').replace("tsunami = 0.5", WAVE)
    (bay / "open.toml").write_text(text.replace("wind_driven = true", "draft = 10.0\ndepths = [0.0, 10.0]"))
    assert cli.main(["site", str(bay / "open.toml"), "--output", str(bay / "values.toml")]) == 0
    values = tomllib.loads((bay / "values.toml").read_text())
    state, contour = values["states"]["extreme"], values["contour"]
    assert state["waves"]["height"] == pytest.approx(max(contour["height"]), rel=1e-4)
    top = contour["period"][contour["height"].index(max(contour["height"]))]
    assert top / state["waves"]["period"] == pytest.approx(issc(1.0, peak_period=1.0).T01 ** -1, rel=1e-4)
    assert values["states"]["tsunami"]["current"]["speed"] == pytest.approx(0.5 * (9.80665 / 20.0) ** 0.5)
    assert 0.55 < state["current"]["speed"] < 0.6  # the mean pressure over half the depth, by a seventh power
    page = (bay / "values.html").read_text(encoding="utf-8")
    assert page.count("data:image/png") == 2 and "Current over depth" in page and "extrapolation" in page


def test_fewer_than_ten_maxima_are_said_with_the_interval():
    values = values_of(wind={"maxima": [20, 22, 25, 21, 28, 23, 24]})
    assert "7 yearly maxima" in values.findings[0] and f"{values.wind.high:.4g}" in values.findings[0]


def test_a_year_without_a_value_is_not_a_maximum():
    with pytest.raises(StudyError, match="wind: a yearly maximum is -999; allowed: above 0"):
        values_of(wind={"maxima": [20.0, 22.0, 25.0, -999.0, 21.0]})


def test_a_study_takes_water_and_weather_from_its_site_and_its_text_holds_them(bay):
    values = tomllib.loads((bay / "bay.toml").read_text())
    read, text = read_study(study(bay))
    assert read.water.depth == pytest.approx(21.8)
    assert read.wind.speed == values["states"]["extreme"]["wind"]["speed"]
    assert (read.waves.height, read.waves.period) == tuple(values["states"]["extreme"]["waves"].values())
    assert tomllib.loads(text)["wind"]["speed"] == read.wind.speed
    still = {"hull": None, "wind": None, "current": None, "waves": None, "sea": {"incidence_deg": 0.0}}
    with pytest.raises(
        StudyError, match="level is 'high', but a response study does not use the water level of a site; leave it out"
    ):
        read_response_study(study(bay, **still))
    path = study(bay, site={"file": "bay.toml", "state": "extreme"}, **still)
    assert read_response_study(path)[0].sea.mean_period == 7.0


def test_a_project_takes_weather_levels_and_service_life_from_its_site(bay):
    chains = {"type": "chain", "length": 260.0, "corner_headings_deg": [45], "pretension_tonf": 20.0}
    lines = {"types": {"chain": {"catalogue": "R3 studlink 76 mm"}}, "spreads": [chains]}
    study(bay, site=None, wind=None, current=None, waves=None, water={"depth": 20.0}, **lines)
    state = {"state": "abnormal", "incidence_deg": [0.0], "levels": ["mean", "high"]}
    project = {
        "project": {"name": "x", "study": "study.toml", "scene": "box.toml", "site": "bay.toml"},
        "states": [{"name": "storm", "weather": "extreme", **state}],
        "rules": [{"rule": "JSCE", "subject": "chain of a multi-point mooring"}],
    }
    (bay / "project.toml").write_text(tomli_w.dumps(project))
    (bay / "box.toml").write_text(BAY.with_name("series_box_20m.toml").read_text(encoding="utf-8"))
    read = read_project(bay / "project.toml")
    assert read.project.levels == {"high": pytest.approx(1.8)}
    assert read.raw["states"][0]["waves"]["period"] == 7.0
    assert read.project.project.service_life == 20.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"wind": {"speed": 20.0, "incidence_deg": 0.0}}, "wind.speed is given by the study and by its site"),
        ({"wind": None}, "wind of the site's state 'extreme' has no direction"),
        ({"site": {"file": "bay.toml", "state": "typhoon"}}, "site.state is 'typhoon'; allowed: extreme, operating"),
        ({"site": {"file": "bay.toml", "level": "ebb"}}, "site.level is 'ebb'; allowed: high"),
        ({"site": {"file": "bay.toml", "leave_out": ["ice"]}}, "allowed: wind, current, waves"),
    ],
)
def test_what_a_site_cannot_give_is_one_line(bay, changes, words):
    with pytest.raises(StudyError, match=words):
        read_study(study(bay, **changes))


def test_a_site_without_a_source_is_one_line():
    with pytest.raises(StudyError, match="wind: nothing is given"):
        values_of(wind={})
    with pytest.raises(StudyError, match="no wind, current or waves"):
        values_of()
    assert read_site(BAY)[0].site.depth == 20.0
