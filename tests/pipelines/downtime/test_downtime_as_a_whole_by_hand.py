"""Parts of a result of downtime together: what each gets, which axes, lines and notes of theirs are in it, in order."""

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.failing import fails
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import result
from hakobune.pipelines.downtime.moored import Detail, Found
from hakobune.pipelines.results.quantity import Quantity

HOURS = np.array(["2001-01-01T00:00", "2001-01-01T01:00", "2001-01-01T02:00"], "datetime64[m]")
USED = np.array([[0.5, 1.5], [0.25, 0.75], [1.25, 0.125]])


def of(values, *axes):
    return Quantity(np.asarray(values, float), axes, "", "")


def made_up(monkeypatch, simulation=None, lee=None, allowed=7.0):
    """The function on stand-ins; returns what each was given"""
    asked = {}
    operations = [SimpleNamespace(name=name, allowed_hours=allowed) for name in ("cranes", "arms")]
    read = SimpleNamespace(simulation=simulation, lee=lee, operations=operations)
    hindcast = SimpleNamespace(time=HOURS)
    verdicts = SimpleNamespace(used=USED)
    part = {"limiting.height": of([1.0, 2.0], "period"), "downtime.hours": of([1.0, 2.0], "operation")}
    found = Found(
        Detail(read, hindcast, ["a", "b"], verdicts), part, result.labels("period", [5.0, 6.0]), ["told", "told"], ["n"]
    )

    def answers(*given):
        asked["answers"] = given
        own = {"downtime.hours": of([8.0, 6.0], "operation"), "downtime.share": of([0.1, 0.2], "operation")}
        axes = result.labels("operation", ["cranes", "arms"]) | result.labels("limit", ["a", "b"])
        return own, axes | result.labels("month", np.arange(12))

    def linear(*given):
        asked["linear"] = given
        return found

    def moored(*given):
        asked["moored"] = given
        return found

    def provenance(*given):
        asked["provenance"] = given
        return {"study": "text"}

    monkeypatch.setattr(result, "given", lambda *words: asked.update(given=words) or (read, "text"))
    monkeypatch.setattr(result, "database_of", lambda database: ("opened", database))
    for name, stands in (("_linear", linear), ("moored", moored), ("answers", answers), ("provenance", provenance)):
        monkeypatch.setattr(result, name, stands)
    monkeypatch.setattr(result, "_notes", lambda one: iter(("first", "second")) if one is hindcast else None)
    return asked, read, found


def test_a_result_has_the_answers_of_its_verdicts_the_hours_and_the_lines_of_all_parts(monkeypatch):
    asked, read, found = made_up(monkeypatch)
    made = result.downtime("/studies/quay/d.toml", "base.h5")
    assert asked["linear"] == (read, Path("/studies/quay"), ("opened", "base.h5"))
    assert asked["answers"] == (read, found.detail.hindcast, ["a", "b"], found.detail.verdicts)
    assert asked["provenance"] == ("text", ("opened", "base.h5")) and "moored" not in asked
    assert made["downtime.hours"].tolist() == [1.0, 2.0]  # parts of their own way take the place of the answers
    assert made["downtime.share"].tolist() == [0.1, 0.2] and made["limiting.height"].tolist() == [1.0, 2.0]
    assert made["hour.used"].tolist() == USED.tolist() and made["hour.used"].dtype == np.float32
    assert made.quantities["hour.used"].axes == ("hour", "limit") and made.quantities["hour.used"].record
    start = 978307200  # s from 1970 to 2001: 11 323 days
    assert made.labels["hour"].values.tolist() == [start, start + 3600, start + 7200]
    assert made.labels["hour"].unit == "seconds since 1970-01-01"
    assert sorted(made.labels) == ["hour", "limit", "operation", "period"]  # nothing goes by month
    assert made.findings == ("told",) and made.notes == ("first", "second", "n") and made.first == ()
    assert (made.kind, made.provenance, made.detail) == ("downtime", {"study": "text"}, found.detail)
    assert asked["given"][0] == "/studies/quay/d.toml"


def test_operations_that_stop_too_long_are_told_after_the_lines_of_their_parts(monkeypatch):
    """One hour where none is allowed, and two"""
    made_up(monkeypatch, allowed=1.5)
    (first, line) = result.downtime(Path("d.toml"), "base.h5").findings
    assert first == "told" and line == fails(
        "arms is down 2 h a year, limit 1.5 h; try another heading (turned_deg), wider limits or another mooring"
    )


def test_a_study_with_simulation_is_one_of_states_kept_where_they_are_asked_for(monkeypatch):
    asked, read, _ = made_up(monkeypatch, simulation="table")
    result.downtime({"tables": 1}, "base.h5", states="s.jsonl", executor="processes:2", say="say")
    assert asked["moored"] == (read, Path(), ("opened", "base.h5"), "s.jsonl", "processes:2", "say")
    assert "linear" not in asked
    result.downtime({"tables": 1}, "base.h5")
    assert asked["moored"][3:5] == (None, "local") and asked["moored"][5]("progress") is None


@pytest.mark.parametrize("lee, database, says", [
    ("lee", "base.h5", "the database is given with [lee], which has no body; give either a database or [lee]"),
    (None, None, "the database of the body is missing; give either a database or [lee]"),
])  # fmt: skip
def test_a_body_has_a_database_and_water_behind_a_breakwater_has_none(monkeypatch, lee, database, says):
    made_up(monkeypatch, lee=lee)
    with pytest.raises(StudyError) as refused:
        result.downtime("d.toml", database)
    assert str(refused.value) == says
    asked, _, _ = made_up(monkeypatch, lee=lee)
    result.downtime("d.toml", None if lee else "base.h5")
    assert asked["linear"][2] == (None if lee else ("opened", "base.h5"))


@dataclass(frozen=True)
class Weather:
    said: tuple = ("gaps",)
    waves: tuple = ()
    columns: dict = field(default_factory=dict)


@pytest.mark.parametrize("planes, limiting, lee", [
    ("planes", True, None), ("planes", False, None), (None, True, None), (None, True, "lee"),
])  # fmt: skip
def test_hours_of_linear_responses_are_judged_and_told_in_the_order_of_their_parts(monkeypatch, planes, limiting, lee):
    read = SimpleNamespace(lee=lee, operations=["cranes", "arms"])
    record = SimpleNamespace(hindcast=Weather(), planes=planes)
    db = None if lee else SimpleNamespace(water_depth=18.0)
    asked = []

    def recorded(*given):
        asked.append(given)
        import warnings

        warnings.warn("warned", stacklevel=2)
        return record

    monkeypatch.setattr(result, "record_with_passages", recorded)
    monkeypatch.setattr(result, "_of_body", lambda *of: ("limits", ("of body", *of), ["note"]))
    monkeypatch.setattr(result, "lee", lambda *of: ("limits", ("behind", *of), ["note"]))
    monkeypatch.setattr(result, "_with_waves", lambda response: ("waves", response))
    monkeypatch.setattr(result, "hours_of", lambda response, one: ("hours", response, one is record))
    monkeypatch.setattr(result, "used_of", lambda limits, hours, one: (limits, hours, one is record.hindcast))
    monkeypatch.setattr(result, "judged", lambda used, limits, count: ("judged", used, limits, count))
    response = ("waves", ("behind", read, "folder") if lee else ("of body", read, db))
    hours = ("hours", response, True)

    def part(name, wanted):
        def of(*given):
            assert given == wanted
            return ({name: 1}, {f"axis of {name}": 2}) if limiting or name != "limiting.height" else ({}, {})

        return of

    monkeypatch.setattr(result, "_returned", part("returned", (read, record.hindcast, hours)))
    monkeypatch.setattr(result, "_limiting", part("limiting.height", (read, record, response, "limits")))
    monkeypatch.setattr(result, "_turned", part("turned", (read, record, response, "limits")))
    monkeypatch.setattr(result, "_viscous", lambda *of: [f"viscous {of == (read, db)}"])
    monkeypatch.setattr(result, "_outside", lambda *of: [f"outside {of == (response, record, hours)}"])
    found = result._linear(read, "folder", db)
    assert asked == [(read, "folder", None if lee else 18.0)]
    assert found.detail == Detail(
        read, record.hindcast, "limits", ("judged", ("limits", hours, True), "limits", 2), None
    )
    names = ["returned", *["limiting.height"] * limiting, "turned"]
    assert list(found.quantities) == names and list(found.axes) == [f"axis of {name}" for name in names]
    assert found.findings == ["warned", "gaps", *([] if lee else ["viscous True"]), "outside True"]
    assert found.notes == ["note", *[result.OF_PLANES] * bool(planes and limiting)]


def test_the_responses_of_a_body_are_those_that_limits_need_each_once(monkeypatch):
    """First names are known from one frequency and heading; the whole is computed for what limits name"""
    body = SimpleNamespace(omega=np.array([0.3, 0.6, 0.9]), headings=np.array([0.0, 1.0]))
    read = SimpleNamespace(body="b", points=["bow"], keel="k")
    db = SimpleNamespace(reader=SimpleNamespace(floating=lambda: "floating"))

    def study(**tables):
        assert tables == {"body": "b", "points": ["bow"], "keel": "k"}
        return SimpleNamespace(restrained=lambda one: body if one == "floating" else None)

    def functions(of, omega, headings, points):
        assert of is body and omega.tolist() == [0.3] and headings.tolist() == [0.0] and points == "places"
        return SimpleNamespace(names=("heave", "roll"), units=("m", "rad"))

    def limits(*given):
        assert given == (read, "places", {"heave": "m", "roll": "rad"})
        return [SimpleNamespace(names=one) for one in (("roll", "heave"), (), ("heave", "bow"))]

    monkeypatch.setattr(result, "ResponseStudy", study)
    monkeypatch.setattr(result, "places_of", lambda one, base: "places" if base is db else None)
    monkeypatch.setattr(result, "transfer_functions", functions)
    monkeypatch.setattr(result, "limits_of", limits)
    monkeypatch.setattr(result, "response_of", lambda *of: of)
    found, response, notes = result._of_body(read, db)
    assert len(found) == 3 and response == (body, "places", ("roll", "heave", "bow")) and notes == [result.LINEAR]


def test_waves_have_no_yearly_maxima_and_responses_keep_their_units(monkeypatch):
    hours = SimpleNamespace(
        names=("heave", result.WAVES, "roll"), units=("m", "m", "rad"),
        m0=np.array([[1.0, 9.0, 2.0]]), m2=np.array([[3.0, 9.0, 4.0]]),
    )  # fmt: skip
    hindcast = SimpleNamespace(year=np.array([2001]), step=1800.0)

    def drawn(m0, m2, year, step):
        assert (m0.tolist(), m2.tolist(), year.tolist(), step) == ([[1.0, 2.0]], [[3.0, 4.0]], [2001], 1800.0)
        return "years", np.array([[10.0, 20.0], [30.0, 40.0]])  # of two years and two responses

    monkeypatch.setattr(result, "drawn_of_years", drawn)
    monkeypatch.setattr(result, "of_years", lambda *of: of)
    names, units, years, maxima, periods = result._returned(SimpleNamespace(return_years=[50]), hindcast, hours)
    assert (names, units, years, periods) == (["heave", "roll"], ("m", "rad"), "years", [50])
    assert maxima.tolist() == [[10.0, 30.0], [20.0, 40.0]]
    alone = SimpleNamespace(names=(result.WAVES,), units=("m",), m0=None, m2=None)
    assert result._returned(None, None, alone) == ({}, {})


def test_waves_within_the_stored_band_are_a_response_of_one():
    response = result.Response(("heave",), ("m",), np.array([0.5, 1.0]), np.full((2, 3, 1), 0.25))
    made = result._with_waves(response)
    assert made.names == ("heave", result.WAVES) and made.units == ("m", "m") and made.omega.tolist() == [0.5, 1.0]
    assert made.power[..., 0].tolist() == np.full((2, 3), 0.25).tolist()
    assert made.power[..., 1].tolist() == np.ones((2, 3)).tolist()
