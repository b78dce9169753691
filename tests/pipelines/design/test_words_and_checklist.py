"""What a design says of its states, lines, criteria and advice, and its checklist, of numbers that are made up."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.rules import Criterion
from hakobune.mooring.criteria.verdict import Judged, Use
from hakobune.pipelines.common.weather.seas import WavesTable
from hakobune.pipelines.common.weather.streams import CurrentTable, WindTable
from hakobune.pipelines.design import report_words
from hakobune.pipelines.design.advice import Tried, _smallest
from hakobune.pipelines.design.checklist import checklist
from hakobune.pipelines.design.tables import EarthquakeCase, StateTable


def state(name="storm", waves=None, wind=None, current=None, **more):
    table = {"name": name, "state": "abnormal", "incidence_deg": [0.0, 45.0], "waves": waves, "wind": wind}
    return StateTable(**table, current=current, **more)


def read(states, study=None, qtf=None, earthquakes=(), folder=None):
    simulation = None if qtf is None else SimpleNamespace(qtf=qtf)
    project = SimpleNamespace(states=states, simulation=simulation, earthquakes=earthquakes)
    return SimpleNamespace(project=project, study=study or {}, kind=SimpleNamespace(MOVED=True), folder=folder)


def asked(which, **more):
    return next(one for one in checklist(read(**more)) if one.text.startswith(which))


SHORT, LONG = WavesTable(height=3.0, period=9.0, spreading="cosine:4"), WavesTable(height=3.0, period=9.0)
GUSTY, STEADY = WindTable(speed=30.0, gusts="davenport"), WindTable(speed=30.0)


LONG_CRESTED = "long-crested waves in swell; give waves.spreading"


@pytest.mark.parametrize("states, qtf, met, how", [
    ([state()], "body", None, "there are no waves"),
    ([state(waves=SHORT)], None, False, "a single regular wave of the significant height is used; give [simulation]"),
    ([state(waves=SHORT), state("swell", waves=LONG)], "body", False, LONG_CRESTED),
    ([state(waves=SHORT)], "body", True, "waves.spreading of every state"),
])  # fmt: skip
def test_waves_have_directions_in_time(states, qtf, met, how):
    found = asked("waves of random phase", states=states, qtf=qtf)
    assert (found.met, found.how) == (met, how)


LONG_CRESTED = "long-crested waves in swell; give waves.spreading"


@pytest.mark.parametrize("states, qtf, met, how", [
    ([state(waves=SHORT)], "body", None, "there is no wind"),
    ([state(wind=GUSTY), state("calm", wind=STEADY)], "body", False, "steady in calm; give wind.gusts"),
    ([state(wind=GUSTY)], None, False, "steady in the simplified method"),
    ([state(wind=GUSTY)], "body", True, "wind.gusts of every state"),
])  # fmt: skip
def test_wind_has_gusts_in_time(states, qtf, met, how):
    found = asked("the wind varies as a random process", states=states, qtf=qtf)
    assert (found.met, found.how) == (met, how)


def test_drift_and_bound_waves_are_those_of_the_simulation():
    for qtf, drift, bound in ((None, False, False), ("newman", True, False), ("body", True, True)):
        assert asked("slowly varying drift for the water depth", states=[state()], qtf=qtf).met is drift
        assert asked("long bound waves", states=[state()], qtf=qtf).met is bound
    said = asked("long bound waves", states=[state()], qtf="newman").how
    assert said == 'simulation.qtf is "newman"; give "bound-wave" or "body" where second-order forces matter'


NEWMAN, BOUND = (f'left out: the force (qtf = "auto" uses {one}): why' for one in ("newman at kh = 3.5", "bound-wave"))


@pytest.mark.parametrize("findings, met, says", [
    ([BOUND], True, 'simulation.qtf is "auto", which used bound-wave'),
    ([NEWMAN], False, 'simulation.qtf is "auto", which used newman; section 7 has the reason'),
    ([""], False, 'simulation.qtf is "auto", which used newman; section 7 has the reason'),
    ([BOUND, NEWMAN], False, "used bound-wave, newman (newman in 1 of 2 cases); section 7 has the reason"),
])  # fmt: skip
def test_of_automatic_pairs_those_that_were_used_are_told(findings, met, says):
    case = SimpleNamespace(apart=False)
    ran = [SimpleNamespace(case=case, numbers=SimpleNamespace(warnings=(text, "another"))) for text in findings]
    rows = {one.text: one for one in checklist(read([state()], qtf="auto"), [*ran, SimpleNamespace(numbers=None)])}
    bound, drift = rows["long bound waves in shallow water"], rows["slowly varying drift for the water depth"]
    assert bound.met is met and bound.how.endswith(says)
    assert drift.met and ("forces of wave pairs beside it" in drift.how) is met


def test_lines_of_a_simulation_may_move_and_those_of_the_simplified_method_do_not():
    for qtf, moves in ((None, False), ("auto", True)):
        assert ("a motion of its own" in asked("lines with", states=[state()], qtf=qtf).how) is moves


def test_fenders_and_earthquakes_are_asked_for_where_there_are_fenders(tmp_path):
    (tmp_path / "timed.toml").write_text("[record]\nfile = 'a.csv'\n")
    (tmp_path / "rule.toml").write_text("coefficient = 0.2\n")
    timed, rule = (EarthquakeCase(name=name, study=f"{name}.toml") for name in ("timed", "rule"))
    fenders = {"fender": [{}]}
    assert (
        asked("fenders with", states=[state()]).met is None
        and asked("fenders with", states=[state()], study=fenders).met
    )
    for study, given, met, how in (
        ({}, (), None, "lines leave the hull with long natural periods"),
        (fenders, (), None, "no earthquake is a load case; give [[earthquakes]] where the site has them"),
        (fenders, (rule,), False, "earthquake rule has no time record; give [record] in its study"),
        (fenders, (rule, timed), True, "records of timed"),
    ):
        found = asked("earthquakes as", states=[state()], study=study, earthquakes=given, folder=tmp_path)
        assert (found.met, found.how) == (met, how)


def test_what_is_not_moved_by_the_project_has_no_checklist():
    assert checklist(SimpleNamespace(kind=SimpleNamespace(MOVED=False))) == []


def test_a_state_is_told_with_its_streams_waves_angles_levels_and_lines():
    swell = {"height": 1.0, "peak_period": 14.0, "incidence_deg": 10.0}
    waves = WavesTable(height=3.5, significant_period=9.5, swell=[])
    one = state(
        waves=waves, wind=WindTable(speed=32.0), current=CurrentTable(speed_knots=2.5), wind_off_deg=[0.0, 30.0],
        levels=["mean", "high"], lines=["intact", "one lost"],
    )  # fmt: skip
    assert report_words.state_row(one) == (
        "storm", "abnormal", "32 m/s", "2.5 knots", "3.5 m, 9.5 s (significant period)",
        "0, 45; wind off by 0, 30", "mean, high", "intact and one lost",
    )  # fmt: skip
    from hakobune.pipelines.common.weather.seas import SeaTable

    both = WavesTable(height=3.0, period=9.0, swell=[SeaTable(**swell)])
    bare = report_words.state_row(state(waves=both, current_off_deg=[15.0]))
    assert bare[2:] == (
        "none",
        "none",
        "3 m, 9 s (mean period) and 1 m, 14 s (peak period)",
        "0, 45; current off by 15",
        "mean",
        "intact",
    )
    assert report_words.state_row(state())[4] == "none"


@pytest.mark.parametrize(
    "used, told", [(0.5, "50 %"), (0.996, "100 %"), (1.0, "100 %"), (1.004, "100.4 %"), (1.37, "137 %")]
)
def test_a_share_beyond_its_limit_is_never_told_as_a_round_hundred(used, told):
    assert report_words.percent(used) == told


@pytest.mark.parametrize("duration, hours, seeds, told", [
    (5400.0, None, 3, "Each case is simulated 3 times, for 1.5 h each."),
    (1800.0, None, 1, "Each case is simulated once, for 0.5 h."),
    (None, 3.0, [4, 7], "Each case is simulated 2 times, for 3 h each."),
])  # fmt: skip
def test_how_long_cases_are_run_is_told_in_hours(duration, hours, seeds, told):
    own = SimpleNamespace(duration=duration, duration_hours=hours, seeds=seeds)
    assert report_words.time_words(SimpleNamespace(project=SimpleNamespace(simulation=own))) == told
    assert report_words.time_words(SimpleNamespace(project=SimpleNamespace(simulation=None))) == ""


def test_a_return_period_is_told_with_life_and_probability():
    """1/(1 − 0.8^(1/20)) = 90 years"""
    own = SimpleNamespace(service_life=20.0, probability=0.8)
    period = 1 / (1 - 0.8 ** (1 / 20))
    said = report_words.return_words(own, SimpleNamespace(return_period=period))
    assert said == ("A value that is not exceeded in 20 years with probability 0.8 has a return period of 90 years.")


def made(quantity="tension / breaking load", limit=0.5, sense="at most", **more):
    words = {"rule": "own", "edition": "", "second": None, "unit": "-", "state": "any", "lines": "any", "method": "any"}
    words |= {"subject": "", "statistic": "largest", "factor": 1.0, "source": "the owner", "status": "read"} | more
    return Criterion(words["rule"], words["edition"], quantity, sense, limit, words["second"], words["unit"],
                     words["state"], words["lines"], words["method"], words["subject"], words["statistic"],
                     words["factor"], words["source"], words["status"])  # fmt: skip


def test_a_criterion_has_its_value_its_use_and_what_is_left():
    """0.4 of 0.5 is 80 %, and 20 % are left; 0.6 is 120 %, and −20 %"""
    for value, used, margin, met in ((0.4, "80 %", "+20 %", True), (0.6, "120 %", "-20 %", False)):
        one = Judged(made(), (Use("storm 0", "line 3", value, value / 0.5),))
        found = report_words.criterion(one, lambda case, c: (f"{case}.h5", c.quantity))
        assert (found["value"], found["used"], found["margin"]) == (f"{value:.4g}", used, margin)
        assert found["by"] == "storm 0, line 3" and found["limit"] == "0.5" and found["link"] == "storm 0.h5"
        assert one.met is met and found["css"] == ("passes" if met else "fails")
        assert "tension / breaking load at most 0.5" in found["words"]
    open_one = report_words.criterion(Judged(made(status="cited"), (), "no case has it"), None)
    assert open_one["source"] == "the owner (cited)" and open_one["missing"] == "no case has it"
    assert open_one["css"] == "open" and open_one["value"] == ""


def test_the_worst_criterion_stands_in_the_summary():
    judged = [Judged(made(limit=limit), (Use("storm 0", "line 3", 0.3, 0.3 / limit),)) for limit in (0.6, 0.4, 0.5)]
    verdict = SimpleNamespace(broken=[], word="passes", judged=judged, ran=[])
    said = report_words.summary(verdict)
    assert said.startswith(": 75 % of ") and said.endswith("at most 0.4, is used by line 3 in “storm 0”")
    verdict = SimpleNamespace(broken=["FAILS: line 1 parts", "FAILS: line 2"], word="fails", judged=judged, ran=[])
    assert report_words.summary(verdict) == ": line 1 parts, and 1 more"


def test_findings_of_cases_that_differ_in_numbers_are_told_once_with_the_largest():
    def ran(name, *texts):
        return SimpleNamespace(case=SimpleNamespace(name=name), numbers=SimpleNamespace(warnings=texts, names=()))

    verdict = SimpleNamespace(
        ran=[ran("a", "uplift of 12 kN"), ran("b", "uplift of 30 kN", "slack"), ran("c", "slack")]
    )
    found = {one["text"]: one["cases"] for one in report_words.warnings(verdict)}
    assert found == {
        "uplift of 30 kN": "b; likewise, each with its own numbers, in 1 more case",
        "slack": "b; likewise, in 1 more case",
    }


def told_of(name, *texts, names=("fore 1", "fore 10"), fault=""):
    numbers = None if fault else SimpleNamespace(warnings=texts, names=names)
    return SimpleNamespace(case=SimpleNamespace(name=name), numbers=numbers, fault=fault)


def test_findings_of_different_lines_are_one_and_those_of_the_simplified_method_stand_aside():
    """What the runs say too is not repeated"""
    ran = [
        told_of("a", "fore 1 pulls 40 kN", "the drift is a guess", "simplified method: the drift is a guess"),
        told_of("b", "fore 10 pulls 90 kN", "simplified method: 2 of 8 lines lift"),
    ]
    found = list(report_words.warnings(SimpleNamespace(ran=ran)))
    assert [(one["text"], one["aside"]) for one in found] == [
        ("fore 10 pulls 90 kN", False), ("the drift is a guess", False), ("2 of 8 lines lift", True),
    ]  # fmt: skip


@pytest.mark.parametrize(("texts", "said"), [
    (("solve 0.3 to 5.94 rad/s as well", "solve to 5 rad/s (1.26 s) too"), "solve from 0.3 to 5.94 rad/s."),
    (("solve to 5 rad/s (1.26 s) too", "solve to 5.55 rad/s (1.13 s) too"), "solve to 5.55 rad/s."),
    (("solve from 0.2 rad/s too", "solve 0.3 to 1.73 rad/s as well"), "solve from 0.2 to 1.73 rad/s."),
    (("add frequencies near 3 rad/s",), ""),
])  # fmt: skip
def test_one_band_serves_all_cases_those_that_could_not_run_too(texts, said):
    first, *rest = texts
    for ran in ([told_of("a", *texts)], [told_of("a", first), *(told_of("b", fault=text) for text in rest)]):
        words = report_words.band(SimpleNamespace(ran=ran))
        assert words.endswith(said) and bool(words) is bool(said)


@pytest.mark.parametrize(("used", "said"), [(1.001, "-0.1 %"), (0.999, "+0.1 %"), (1.0, "+0 %"), (0.4, "+60 %"),
                                            (1.37, "-37 %"), (1.00004, "-0.004 %")])  # fmt: skip
def test_a_margin_is_zero_at_the_limit_alone(used, said):
    assert report_words._margin(used) == said


def test_a_line_is_told_in_metres_and_kilonewtons():
    numbers = SimpleNamespace(
        names=("fore",), length=np.array([260.0]), types=(("chain", "wire"),),
        fairlead=[np.array([50.04, -25.0, -0.02])],
        anchor=[np.array([300.0, -200.0, -20.0])], pretension=np.array([392.3e3]), breaking=np.array([4.884e6]),
    )  # fmt: skip
    case = SimpleNamespace(factor=1)
    ran = [SimpleNamespace(numbers=numbers, largest=[load], case=case) for load in (1e6, 2.442e6)]
    verdict = SimpleNamespace(ran=[SimpleNamespace(numbers=None), *ran])
    study = {"types": {"chain": {"catalogue": "R3 studless 76 mm"}, "wire": {}}}
    (row,) = report_words.line_rows(SimpleNamespace(study=study), verdict)
    assert row == (
        "fore", "260", "chain: R3 studless 76 mm, wire", "50, -25, -0.02", "300, -200, -20", "392.3", "4884",
        "2442", "50 %",
    )  # fmt: skip
    (row,) = report_words.line_rows(SimpleNamespace(study=study | {"allowable": 0.4}), verdict)
    assert row[-1] == "50 %, 125 % of WLL 1954 kN"
    numbers.breaking = np.array([np.inf])
    assert next(report_words.line_rows(SimpleNamespace(study=study), verdict))[-3:] == ("not given", "2442", "")


@pytest.mark.parametrize("passes_from, count", [(1, 1), (1, 9), (2, 9), (5, 9), (9, 9), (7, 8)])
def test_the_smallest_change_that_passes_is_found_and_the_one_below_was_run(passes_from, count):
    """By doubling steps and then between the last that failed and the first that passed: few runs"""
    runs = []

    def run(i):
        runs.append(i + 1)
        return Tried("size", f"{i + 1}", 2.0 - 0.1 * (i + 1), i + 1 >= passes_from, None)

    best = _smallest(run, count, 2.0)
    assert best.words == str(passes_from) and (passes_from == 1 or passes_from - 1 in runs)
    assert len(set(runs)) <= 6


def test_where_no_change_passes_the_best_is_told_and_a_way_that_leads_nowhere_is_left():
    uses = [1.5, 1.3, 1.4, 1.35]
    best = _smallest(lambda i: Tried("size", f"{i}", uses[i], False, None), 4, 2.0)
    assert best.utilisation == 1.3
    assert _smallest(lambda i: Tried("size", f"{i}", 2.0 + i, False, None), 4, 2.0) is None


def test_advice_is_told_with_what_passes_first_and_what_was_run_in_vain():
    criterion = made(rule="JSCE")
    enough, best = (
        Tried("size", "chain of 84 mm", 0.93, True, criterion),
        Tried("number", "8 lines", 1.07, False, criterion),
    )
    advice = SimpleNamespace(tried=("size", "number", "pretension"), found=(best, enough), beyond="")
    said = report_words.advice_words(advice, SimpleNamespace(word=report_words.FAILS))
    assert said[0].startswith("Passes in the governing cases: chain of 84 mm, which uses 93 % of JSCE")
    assert said[1].startswith("Not enough alone: 8 lines, the best change of its kind, still uses 107 % of JSCE")
    assert said[2] == "Tried without success, since the largest utilisation does not fall: pretension."
    vain = SimpleNamespace(tried=("size", "number"), found=(), beyond="")
    (said,) = report_words.advice_words(vain, SimpleNamespace(word=report_words.FAILS))
    assert said.startswith("Tried in the governing cases: larger sizes, more lines. None lowers")
    assert report_words.advice_words(advice, SimpleNamespace(word="passes")) == ()
    assert not re.search("None", " ".join(report_words.advice_words(advice, SimpleNamespace(word=report_words.FAILS))))
