"""Every check of a project on either side of its limit, of tables made for it: nothing is read, solved or computed."""

import copy
import math
from types import SimpleNamespace

import pytest

from hakobune.mooring.criteria.verdict import HAWSER, HOLDING, WORN
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.design import project_checks
from hakobune.pipelines.design.kinds.needs import SCOPE
from hakobune.pipelines.design.project_checks import check_criteria, check_tables, check_worn
from hakobune.pipelines.design.tables import Project

CHAIN = {"chain": {"catalogue": "R3 studless 76 mm"}}
OTHER = {"name": "calm", "state": "abnormal", "incidence_deg": [0.0], "wind": {"speed": 1.0}}
STATES = [{"name": "storm", "state": "normal", "incidence_deg": [0.0], "wind": {"speed": 20.0}}]
FATIGUE = {"fatigue": {"curve": "DNV studless chain"}, "simulation": {"duration": 600.0}}


def kind(database="optional", finds=("surge",), needs=()):
    return SimpleNamespace(
        DATABASE=database, NAME="breakwater", check=lambda project, study: None, finds=lambda study: finds,
        needs=lambda study: needs,
    )  # fmt: skip


def project(path="", value=None, **more):
    """The smallest project, with another value at a path such as "states.0.name"; NONE leaves the key out"""
    raw = {
        "project": {"name": "a berth", "study": "s.toml"},
        "states": copy.deepcopy(STATES),
        "rules": [{"rule": "API"}],
    }
    raw |= copy.deepcopy(more)
    place = raw
    *heads, last = path.split(".")
    for head in heads:
        place = place[int(head)] if head.isdigit() else place.setdefault(head, {})
    if path:
        place[last] = value
    return typed(raw, Project, StudyError)


def said(call, *given):
    try:
        call(*given)
    except StudyError as error:
        return str(error)
    return None


def of_tables(made, study=None, of=None):
    return said(check_tables, made, study or {"water": {"depth": 30.0}, "types": CHAIN}, of or kind())


def holds(told, says):
    assert told is says if says is None else told is not None and says in told, told


@pytest.mark.parametrize(
    ("scene", "database", "needed", "says"),
    [
        ("a.toml", "b.h5", "optional", "project: scene and database are both given; give one of them"),
        (None, None, "needed", "project: neither scene nor database is given; give one of them"),
        (None, None, "optional", None), (None, None, "none", None),
        ("a.toml", None, "needed", None), (None, "b.h5", "needed", None), (None, "b.h5", "optional", None),
        ("a.toml", None, "none", "project.scene is given, but a breakwater defines its own section; leave it out"),
        (None, "b.h5", "none", "project.database is given, but a breakwater defines its own section"),
    ],
)  # fmt: skip
def test_a_body_is_given_once_and_only_where_it_is_needed(scene, database, needed, says):
    made = project(project={"name": "", "study": "", "scene": scene, "database": database})
    holds(of_tables(made, of=kind(needed)), says)


@pytest.mark.parametrize(
    ("path", "value", "says"),
    [
        ("project.service_life", 0.0, "project.service_life is 0"),
        ("project.service_life", 1e-3, None),
        ("project.probability", 0.0, "project.probability is 0; allowed: above 0, below 1"),
        ("project.probability", 1.0, "project.probability is 1; allowed: above 0, below 1"),
        ("project.probability", 0.01, None),
        ("project.probability", 0.99, None),
        ("levels.low", math.inf, "levels.low is inf m; allowed: finite"),
        ("levels.low", -3.0, None),
        ("anchors", {"holding_kN": 0.0}, "anchors.holding_kN is 0"),
        ("anchors", {"holding_kN": 0.1}, None),
        ("anchors", {"holding_kN": 1.0, "lines": {"a": 1.0, "bow": -1.0}}, "anchors.lines.bow is -1"),
        ("states", [], "the project has no states; give at least one [[states]]"),
        ("states", [STATES[0], OTHER], None),
        (
            "states",
            [STATES[0], OTHER, {**OTHER, "name": "calm"}],
            "states[1].name is 'calm', the name of another state",
        ),
        ("rules", [], "the project has no rules; give at least one [[rules]] or [[limits]]"),
        ("states.0.state", "calm", "states[0].state is 'calm'; allowed: normal, abnormal"),
        ("states.0.state", "abnormal", None),
        ("states.0.lost", "all", "states[0].lost is 'all'; allowed: worst, each"),
        ("states.0.lost", "each", None),
        ("states.0.lines", [], "states[0].lines is empty; allowed: intact, one lost"),
        ("states.0.lines", ["intact", "two lost"], "states[0].lines is 'two lost'; allowed: intact, one lost"),
        ("states.0.lines", ["one lost"], None),
        ("states.0.levels", [], "states[0].levels is empty; allowed: mean"),
        ("states.0.levels", ["mean", "low"], "states[0].levels is 'low'; allowed: mean"),
        *(
            (f"states.0.{key}", value, says and f"states[0].{key} is {value}; allowed: a list of one or more angles")
            for key in ("incidence_deg", "wind_off_deg", "current_off_deg")
            for value, says in (([], 1), ([360.0], None), ([-360.0], None), ([0.0, 360.1], 1), ([-360.1, 0.0], 1))
        ),
        ("states.0.wind", None, "states[0] has neither wind, current nor waves; allowed: at least one"),
        (
            "states.0.wind",
            {"speed": 20.0, "direction_deg": 0.0},
            "states[0].wind.direction_deg is given; give directions in states[0].incidence_deg only",
        ),
        ("states.0.current", {"speed": 1.0, "incidence_deg": 0.0}, "states[0].current.incidence_deg is given"),
        (
            "states.0.waves",
            {"height": 2.0, "period": 8.0, "direction_deg": 0.0},
            "states[0].waves.direction_deg is given",
        ),
        ("states.0.waves", {"height": 2.0, "period": 8.0}, None),
        ("states.0.current", {"speed": 1.0}, None),
        ("states.0.waves", {"height": -2.0, "period": 8.0}, "states[0].waves.height is -2"),
        (
            "states.0.waves",
            {
                "height": 2.0,
                "period": 8.0,
                "swell": [
                    {"height": 1.0, "peak_period": 12.0, "direction_deg": 0.0},
                    {"height": -1.0, "peak_period": 12.0, "direction_deg": 0.0},
                ],
            },
            "states[0].waves.swell[1].height is -1",
        ),
        ("states.0.wind", {"speed": -20.0}, "states[0].wind.speed is -20"),
        ("states.0.wind", {"speed": 20.0, "ship": "boat"}, "states[0].wind.ship is 'boat'; allowed: "),
        (
            "states.0.current",
            {"speed": 1.0, "file": "c.csv"},
            "states[0].current.file is given in a study that was not",
        ),
    ],
)
def test_numbers_and_states_of_a_project(path, value, says):
    holds(of_tables(project(path, value)), says)


def test_a_level_of_the_project_may_be_asked_for_and_limits_alone_are_rules():
    assert of_tables(project("states.0.levels", ["low", "mean"], levels={"low": -1.0})) is None
    assert of_tables(project(rules=[], limits=[{"quantity": "surge", "source": "owner", "at_most": 1.0}])) is None


def test_the_kind_of_study_checks_its_own():
    def refuse(project, study):
        raise StudyError(f"{project.project.name} {study['water']}")

    of = kind()
    of.check = refuse
    assert of_tables(project(), of=of) == "a berth {'depth': 30.0}"


@pytest.mark.parametrize(
    ("wear", "life", "types", "says"),
    [
        ({"mm_per_year": -0.1}, 20.0, CHAIN, "wear.mm_per_year is -0.1; allowed: at least 0"),
        ({"mm_per_year": 0.0}, 20.0, CHAIN, None),
        ({"mm_per_year": 0.4}, None, CHAIN, "wear: the number of years is missing; give wear.years or"),
        ({"mm_per_year": 0.4, "years": 5.0}, None, CHAIN, None),
        ({"mm_per_year": 0.4, "years": 0.0}, 20.0, CHAIN, "wear.years is 0"),
        ({"mm_per_year": 0.4}, 20.0, CHAIN | {"other": {"catalogue": "x", "corrosion_mm": 1.0}},
         "[wear] and types.other.corrosion_mm are both given; give one of them"),
        ({"mm_per_year": 0.4}, 20.0, CHAIN | {"rope": {"weight": 1.0}},
         "wear of type 'rope' needs a diameter; name a size of the catalogue"),
    ],
)  # fmt: skip
def test_wear_needs_years_and_diameters(wear, life, types, says):
    made = project(project={"name": "", "study": "", "service_life": life}, wear=wear)
    holds(of_tables(made, {"water": {"depth": 30.0}, "types": types}), says)


BOTH = "fatigue: give either curve, or exponent and constant of N = constant · s^−exponent"
OWN = {"exponent": 3.0, "constant": 1e11}


@pytest.mark.parametrize(
    ("table", "says"),
    [
        ({"curve": "DNV studless chain"}, None), (OWN, None), ({}, BOTH), ({"exponent": 3.0}, BOTH),
        ({"constant": 1e11}, BOTH), ({"curve": "DNV studless chain", "exponent": 3.0}, BOTH),
        ({"curve": "DNV studless chain", **OWN}, BOTH), ({"curve": "steel"}, "fatigue.curve is 'steel'; allowed: "),
        (OWN | {"exponent": -1.0}, "fatigue.exponent is -1"), (OWN | {"constant": -1.0}, "fatigue.constant is -1"),
        (OWN | {"basis": "strain"}, "fatigue.basis is 'strain'; allowed: "), (OWN | {"basis": "share"}, None),
        (OWN | {"factor": 0.99}, "fatigue.factor is 0.99; allowed: at least 1"), (OWN | {"factor": 1.0}, None),
    ],
)  # fmt: skip
def test_a_curve_of_fatigue_is_named_or_given_whole(table, says):
    life = {"name": "", "study": "", "service_life": 20.0}
    made = project("states.0.share", 0.5, project=life, fatigue=table, simulation={"duration": 600.0})
    holds(of_tables(made), says)


@pytest.mark.parametrize(
    ("shares", "life", "simulation", "types", "says"),
    [
        ([0.5, 0.5], 20.0, True, CHAIN, None), ([0.0, 0.1], 20.0, True, CHAIN, None),
        ([0.6, 0.5], 20.0, True, CHAIN, "the shares of the time are [0.6, 0.5]; allowed: 0 to 1 each, at most 1 in"),
        ([-0.1, 0.5], 20.0, True, CHAIN, "the shares of the time are [-0.1, 0.5]"),
        ([0.0, 0.0], 20.0, True, CHAIN, "fatigue needs [simulation], project.service_life and a share of the time"),
        ([0.5, 0.5], None, True, CHAIN, "fatigue needs [simulation]"),
        ([0.5, 0.5], 20.0, False, CHAIN, "fatigue needs [simulation]"),
        ([0.5, 0.5], 20.0, True, CHAIN | {"rope": {}}, "fatigue of type 'rope' needs a diameter; name a size"),
        ([0.5, 0.5], 20.0, True, None, "fatigue of type 'ropes' needs a diameter"),
    ],
)  # fmt: skip
def test_fatigue_needs_runs_a_life_shares_of_the_time_and_diameters(shares, life, simulation, types, says):
    states = [{**STATES[0], "share": shares[0]}, {**OTHER, "share": shares[1]}]
    more = {"simulation": {"duration": 600.0}} if simulation else {}
    made = project(project={"name": "", "study": "", "service_life": life}, states=states,
                   fatigue={"curve": "DNV studless chain"}, **more)  # fmt: skip
    study = {"water": {"depth": 30.0}} | ({} if types is None else {"types": types})
    holds(of_tables(made, study), says)
    only = project(states=states, **more)  # shares are looked at without fatigue too
    holds(of_tables(only, study), says if says and says.startswith("the shares") else None)


def test_wear_that_leaves_too_little_names_its_type():
    check_worn({"thick": (0.076, 0.010)})
    told = said(check_worn, {"thick": (0.076, 0.010), "thin": (0.076, 0.070)})
    assert told.startswith("wear of type 'thin': ") and len(told) > 30


def criterion(quantity):
    return SimpleNamespace(quantity=quantity)


LIMIT = {"quantity": "surge", "source": "owner", "at_most": 1.0}
VALUE = {"quantity": "gust factor", "value": 1.0, "source": "a tunnel"}


@pytest.mark.parametrize(
    ("more", "asked", "needs", "says"),
    [
        ({"limits": [LIMIT]}, ["surge"], (), None),
        ({"limits": [LIMIT, {**LIMIT, "quantity": "sway"}]}, [], (), "limits[1].quantity is 'sway'; allowed: "),
        ({"limits": [{**LIMIT, "quantity": SCOPE}]}, [], (), None),
        ({"limits": [{**LIMIT, "quantity": "service life"}]}, [], (), None),
        ({"limits": [{**LIMIT, "quantity": "gust factor"}], "values": [VALUE]}, ["gust factor"], (), None),
        (
            {"limits": [{**LIMIT, "subject": "hawser"}]},
            [],
            (),
            f"limits[0].subject is {HAWSER!r}, but the study has no hawser; leave the subject out",
        ),
        ({"limits": [{**LIMIT, "subject": "hawser"}]}, [], [(True, True)], None),
        ({"limits": [{**LIMIT, "subject": "hawser"}]}, [], [(False, True)], "but the study has no hawser"),
        ({"limits": [{**LIMIT, "subject": "hawser"}]}, [], [(False, True), (True, True)], None),
        (
            {},
            [],
            [(False, True), (False, False)],
            "the study has lines, but no chosen criterion judges them; give a rule set that does, or [[limits]] of 'a'",
        ),
        ({}, [], [(True, False)], "or [[limits]] of 'a' with subject = \"hawser\""),
        (
            {},
            [],
            [(True, False), (False, False)],
            "[[limits]] of 'a' with subject = \"hawser\" and 'a'",
        ),
        ({"wear": {"mm_per_year": 0.1}}, [WORN], (), None),
        ({"wear": {"mm_per_year": 0.1}}, [HOLDING], (), f"[wear] is given, but no chosen criterion limits {WORN!r};"),
        ({"anchors": {"holding_kN": 1.0}}, [HOLDING], (), None),
        (
            {"anchors": {"holding_kN": 1.0}},
            [WORN],
            (),
            "a rule set that does (UFC 4-159-03) or [[limits]], or leave out [anchors]",
        ),
        ({"values": [VALUE]}, ["gust factor"], (), None),
        (
            {"values": [VALUE]},
            [],
            (),
            "values[0].quantity is 'gust factor'; allowed by the chosen criteria: none is asked",
        ),
        (
            {"values": [VALUE, {**VALUE, "quantity": "roll"}]},
            ["gust factor", "roll", "b"],
            (),
            "values[1].quantity is 'roll'; allowed by the chosen criteria: gust factor; b",
        ),
        ({"values": [{**VALUE, "state": "calm"}]}, ["gust factor"], (), "values[0].state is 'calm'; allowed: "),
        ({"values": [{**VALUE, "lines": "none"}]}, ["gust factor"], (), "values[0].lines is 'none'; allowed: "),
        (
            {"values": [{**VALUE, "value": -0.1}]},
            ["gust factor"],
            (),
            "values[0].value is -0.1; allowed: 0 or more, finite",
        ),
        ({"values": [{**VALUE, "value": 0.0}]}, ["gust factor"], (), None),
        ({"values": [{**VALUE, "value": math.inf}]}, ["gust factor"], (), "values[0].value is inf; allowed: 0 or more"),
    ],
)
def test_limits_needs_and_values_of_a_project(more, asked, needs, says, tmp_path):
    """needs : (of a hawser, judged) of each"""
    wanted = [
        SimpleNamespace(
            hawser=hawser, judged=lambda criteria, judged=judged: judged, what="lines", quantities=("a", "b")
        )
        for hawser, judged in needs
    ]
    made = project(**more)
    told = said(
        check_criteria, made, {"water": {"depth": 30.0}}, kind(needs=wanted), list(map(criterion, asked)), tmp_path
    )
    holds(told, says)


def test_quantities_of_a_rule_file_of_ones_own_are_computed_or_given(tmp_path, monkeypatch):
    """Those of the rules of the house too; the second table is the one at fault"""
    read = []
    monkeypatch.setattr(project_checks, "read_rules", lambda *path: read.append(path) or [criterion("yaw gust")])
    of = {"mine": [criterion("surge"), criterion("yaw gust")], "his": [criterion("tension"), criterion("misprint")]}
    monkeypatch.setattr(project_checks, "of_rule", lambda rules, rule, subject: of[rule][: None if subject else 9])
    first, second = {"rule": "mine", "file": "m.csv"}, {"rule": "his", "file": "h.csv"}
    monkeypatch.setattr(project_checks, "OF_TENSIONS", ("tension",))
    project_checks._check_own_rules(project(rules=[first, {"rule": "API"}]), ("surge",), tmp_path)
    assert read == [(), (tmp_path / "m.csv",)]
    told = said(project_checks._check_own_rules, project(rules=[first, second]), ("surge",), tmp_path)
    assert told.startswith("rules[1], h.csv: no load case computes the quantity 'misprint'; allowed: tension; surge; ")
    assert told.endswith("; or add this quantity by [[values]]")
    values = [{**VALUE, "quantity": "misprint"}]
    project_checks._check_own_rules(project(rules=[first, second], values=values), ("surge",), tmp_path)


def test_earthquakes_need_fenders_and_names_of_their_own(tmp_path, monkeypatch):
    from hakobune.pipelines.design.kinds import earthquake

    read = []
    monkeypatch.setattr(earthquake, "check_study", read.append)
    two = [{"name": "L1", "study": "a.toml"}, {"name": "L2", "study": "b.toml"}]
    check = project_checks._check_earthquakes
    check(project(earthquakes=two), {"fender": [1]}, tmp_path)
    assert read == [tmp_path / "a.toml", tmp_path / "b.toml"]
    told = said(check, project(earthquakes=two), {}, tmp_path)
    assert told.startswith(
        "earthquakes are given, but the study has no fenders; a hull on lines alone has long natural"
    )
    same = [*two, {"name": "L2", "study": "c.toml"}]
    told = said(check, project(earthquakes=same), {"fender": [1]}, tmp_path)
    assert told.startswith("earthquakes[1].name is 'L2', the name of another earthquake; give each earthquake its own")
    check(project(), {}, tmp_path)
    holds(said(check_criteria, project(earthquakes=two), {}, kind(), [], tmp_path), "earthquakes are given, but")
