"""States of a site: each has some weather, and each comes from its own tables, which are replaced here."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.site import study


def made(monkeypatch, extreme, operating, tsunami=None, **own):
    asked = []
    for name, value in {
        "extreme_state": extreme,
        "operating_state": operating,
        "tsunami_state": {"current": 1},
        "levels_of": {"high": 2.0},
        "profile_of": "profile",
        "climate_of": "climate",
        "seismic_coefficient": 0.2,
        "_extreme": SimpleNamespace(value=30.0),
        "speed_10": 28.0,
    }.items():
        monkeypatch.setattr(
            study, name, lambda *given, value=value, name=name, **more: asked.append((name, given, more)) or value
        )
    given = {"depth": 20.0, "probability": 0.4, "return_period": None, "service_life": 50.0, "confidence": 0.9} | own
    wind = SimpleNamespace(averaging_s=60.0, height=15.0, exponent=0.14)
    site = SimpleNamespace(
        site=SimpleNamespace(**given), wind=wind, waves="waves", climate="table", operating=operating and "operating",
        earthquake=SimpleNamespace(rule="rule", factors={"a": 1}), levels=SimpleNamespace(tsunami_period=tsunami),
    )  # fmt: skip
    if operating == {}:
        site.operating = "operating"
    return study.site_values(site, "folder"), {name: (given, more) for name, given, more in asked}


def test_values_of_a_site_go_where_they_belong(monkeypatch):
    """A life of 50 years that is not exceeded with 0.4: T = 1/(1 − 0.4^(1/50))"""
    found, asked = made(monkeypatch, {"wind": 1}, {"waves": {"height": 2}}, 900.0)
    years = 1 / (1 - 0.4 ** (1 / 50))
    assert found.years == pytest.approx(years, rel=1e-9) and found.probability == pytest.approx(0.4, rel=1e-9)
    assert found.states == {"extreme": {"wind": 1}, "operating": {"waves": {"height": 2}}, "tsunami": {"current": 1}}
    assert (found.wind_10, found.seismic, found.climate, found.profile, found.levels) == (
        28.0,
        0.2,
        "climate",
        "profile",
        {"high": 2.0},
    )
    assert asked["speed_10"] == ((30.0, 60.0, 15.0, 0.14), {}) and asked["seismic_coefficient"] == (("rule",), {"a": 1})
    assert asked["climate_of"][0][:3] == ("table", pytest.approx(years), "folder")
    assert asked["extreme_state"][0][1:] == (28.0, found.waves, "climate", "profile")
    assert "tsunami" not in made(monkeypatch, {"wind": 1}, None)[0].states
    assert "operating" not in made(monkeypatch, {"wind": 1}, None)[0].states
    assert made(monkeypatch, {"wind": 1}, None, probability=None, return_period=475.0)[0].years == 475.0


@pytest.mark.parametrize(("extreme", "operating", "says"), [
    ({}, {"wind": 1}, "the extreme state has no wind, current or waves; allowed: at least one"),
    ({"wind": 1}, {}, "the operating state has no wind, current or waves; allowed: at least one"),
])  # fmt: skip
def test_a_state_without_weather_is_named(monkeypatch, extreme, operating, says):
    with pytest.raises(StudyError) as error:
        made(monkeypatch, extreme, operating)
    assert str(error.value) == says


@pytest.mark.parametrize("own", [{"return_period": 100.0}, {"probability": None}])
def test_a_site_has_a_probability_or_a_return_period(monkeypatch, own):
    with pytest.raises(StudyError, match="site: give one of probability and return_period"):
        made(monkeypatch, {"wind": 1}, None, **own)
