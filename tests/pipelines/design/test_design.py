"""A project from its file to its report, on a database of a small scene"""

import re
import tomllib
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tomli_w
from result_views import check_views

import hakobune
from hakobune.meshing.seals import text_damaged
from hakobune.mooring.criteria.rules import Criterion, RuleError, unit_of
from hakobune.mooring.criteria.verdict import OF_TENSIONS, SHARE
from hakobune.pipelines.common.picture import save
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.advice import Advice, Tried, _smallest, advise, after_lines_move
from hakobune.pipelines.design.cases import intact_cases
from hakobune.pipelines.design.fatigue import QUANTITY as FATIGUE
from hakobune.pipelines.design.fatigue import fatigue
from hakobune.pipelines.design.kinds import breakwater, mooring, single_point, stored
from hakobune.pipelines.design.kinds.changes import ways
from hakobune.pipelines.design.kinds.in_time import cycles_of
from hakobune.pipelines.design.kinds.needs import SCOPE
from hakobune.pipelines.design.project import read_project
from hakobune.pipelines.design.report_words import advice_words, warnings
from hakobune.pipelines.design.result import made
from hakobune.pipelines.design.verdict import judged_project
from hakobune.pipelines.executors.choice import Here
from hakobune.pipelines.moor.result import studied
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.simulate.over_runs import OF_LINES
from hakobune.pipelines.solve.run import solve

SCENE = {
    "water": {"depth": 20.0},
    "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.5, 29.4, 32.3]}],
    "waves": {"periods": [5, 6, 7, 8, 10, 12, 15, 20, 30, 60], "headings_deg": [0, 30, 60, 90]},
    "method": "contour",
    "tolerance": 0.02,
}
STUDY = {
    "water": {"depth": 20.0},
    "hull": {"freeboard": 10.0},
    "types": {"chain": {"catalogue": "R3 studlink 76 mm", "bed_friction": 0.6}},
    "spreads": [{"type": "chain", "length": 260.0, "corner_headings_deg": [45], "pretension_tonf": 20.0}],
}
PROJECT = {
    "project": {"name": "box & chain", "study": "study.toml", "database": "box.h5", "service_life": 20.0,
                "probability": 0.82},
    "states": [
        {"name": "storm", "state": "abnormal", "incidence_deg": [60.0], "lines": ["intact", "one lost"],
         "wind": {"speed": 30.0}, "waves": {"height": 1.0, "period": 7.0}},
        {"name": "work", "state": "normal", "incidence_deg": [0.0], "current": {"speed_knots": 1.0}},
    ],
    "rules": [{"rule": "JSCE", "subject": "chain of a multi-point mooring"}, {"rule": "port facility II"}],
    "wear": {"mm_per_year": 0.3},
}  # fmt: skip


GIVEN = {"quantity": "gust factor", "value": 1.3, "source": "calculation 7"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("design")
    solve(make_scene(SCENE), folder / "box.h5")
    (folder / "study.toml").write_text(tomli_w.dumps(STUDY))
    (folder / "project.toml").write_text(tomli_w.dumps(PROJECT))
    return folder


@pytest.fixture(scope="module", autouse=True)
def one_plan():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hakobune.pipelines.design.report_pictures.MOST_PLANS", 1)
        yield


@pytest.fixture(autouse=True)
def without_pictures(request, monkeypatch):
    """Where the page is not looked at: its pictures take most of the time"""
    if "first" not in request.fixturenames:
        for name in ("body_pictures", "use_picture"):
            monkeypatch.setattr(f"hakobune.pipelines.design.report.{name}", lambda *given: "")
        monkeypatch.setattr("hakobune.pipelines.design.report.plans", lambda *given: ())


@pytest.fixture(scope="module")
def first(folder):
    return made(read_project(folder / "project.toml"), folder / "out", Here(), None, advice=False)


class Page(HTMLParser):
    """Addresses of a page, and whether every element is closed"""

    def __init__(self, text):
        super().__init__()
        self.open, self.addresses = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.addresses += [value for key, value in attributes if key in ("src", "href")]
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_views_of_a_design_have_the_quantities_of_its_function(folder, first, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "40")
    monkeypatch.setattr("hakobune.pipelines.design.result.made", lambda *_: first)
    project = folder / "project.toml"
    found = hakobune.design(project, folder / "out", advice=False)
    words = ["design", str(project), "--output", str(folder / "out"), "--no-advice"]
    check_views(found, words, tmp_path / "design.h5", capsys)
    assert found["load_case.largest_tension"].tolist() == [one.numbers.largest.max() for one in first[0].ran]


def test_the_intact_case_is_the_mooring_study_itself(folder, first):
    """Lines named by fairlead and anchor lie as the spread that they were laid as"""
    from hakobune.bem.database import open_database

    verdict = first[0]
    (work,) = [one for one in verdict.ran if one.case.state == "work" and one.case.factor == 1]
    study = {**STUDY, "current": {"speed_knots": 1.0, "incidence_deg": 0.0}}
    result, _ = studied(make_study(study), open_database(folder / "box.h5"))
    np.testing.assert_allclose(work.numbers.largest, result.tension, rtol=1e-6)


def test_every_case_of_a_ship_has_the_wind_of_its_file(folder, tmp_path):
    """At 240°, which the file has: F_x = −0.6 q 800, F_y = −0.7 q 1500, M_z = −0.05 q 1500·90, 14 m above the water"""
    from hakobune.bem.database import open_database

    rows = "0,1,0,0\n60,0.5,0.7,0.1\n120,-0.4,0.8,0\n180,-1,0,0\n240,-0.6,-0.7,-0.05\n300,0.5,-0.7,0.1\n360,1,0,0\n"
    sizes = "# area_x = 800\n# area_y = 1500\n# length = 90\n# height = 14\n"
    (tmp_path / "ship.csv").write_text(f"{sizes}angle,CX,CY,CN\n{rows}")
    (tmp_path / "study.toml").write_text(tomli_w.dumps({**STUDY, "wind": {"file": "ship.csv"}}))
    (tmp_path / "project.toml").write_text(
        tomli_w.dumps({**PROJECT, "project": {**PROJECT["project"], "database": str(folder / "box.h5")}})
    )
    read, db = read_project(tmp_path / "project.toml"), open_database(folder / "box.h5")
    storm = next(iter(intact_cases(read, mooring.base(read.study, db), (1.0,))))
    load = studied(make_study(storm.study), db)[0].loads["wind"]
    x, y, turn = np.array([-0.6 * 800, -0.7 * 1500, -0.05 * 1500 * 90]) * 0.5 * 1.226 * 30.0**2
    lever = 14.0 - db.rotation_center[2]
    np.testing.assert_allclose(load, [x, y, 0.0, -lever * y, lever * x, turn], rtol=1e-9)


def test_every_case_asked_for_is_there_and_lost_lines_are_the_most_loaded(first):
    cases = {one.case.name: one for one in first[0].ran}
    assert len(cases) == 2 * (2 + 1)  # factors of motion; whole and without a line, and work
    for name, one in cases.items():
        if one.case.lost:
            whole = cases[name.split(", without")[0]]
            assert one.case.lost == whole.numbers.names[int(np.argmax(whole.numbers.largest))]
            assert one.case.lost not in one.numbers.names and len(one.numbers.names) == 3


def test_a_larger_motion_pulls_more_and_wear_leaves_less(first):
    cases = {one.case.name: one for one in first[0].ran}
    calm, rough = cases["storm, 60 deg"].largest, cases["storm, 60 deg, motions x 1.5"].largest
    assert rough.max() > calm.max()
    (worn,) = [one for one in first[0].judged if one.criterion.quantity.endswith("worn")]
    one = cases[f"{worn.governing.case}, motions x 1.5"]
    left = 70.0**2 * (44 - 0.08 * 70.0) / (76.0**2 * (44 - 0.08 * 76.0))
    share = one.largest / (left * one.numbers.breaking)
    assert worn.governing.value == pytest.approx(share.max(), rel=1e-9)
    assert worn.governing.item == one.numbers.names[int(np.argmax(share))]


def test_what_nothing_is_known_of_is_not_signed(first):
    verdict = first[0]
    unknown = [one.criterion.quantity for one in verdict.judged if one.met is None]
    assert "gust factor" in unknown and verdict.word != "passes"


def test_a_value_from_elsewhere_is_judged_with_its_source_and_the_scope_of_lines_by_their_length(folder, tmp_path):
    """260 m of line in 20 m of water: 2.6 times five depths"""
    rules = [{"rule": "port facility II", "subject": "wind at sea, mean of 10 min"}, {"rule": "port facility"}]
    project = {**PROJECT, "values": [GIVEN], "rules": rules, "states": PROJECT["states"][1:]}
    del project["wear"]
    (folder / "given.toml").write_text(tomli_w.dumps(project))
    verdict, _, _ = made(read_project(folder / "given.toml"), tmp_path / "out", Here(), None, advice=False)
    gusts = [one for one in verdict.judged if one.criterion.quantity == "gust factor"]
    assert [(one.met, one.governing.item, one.governing.value) for one in gusts] == [(True, "calculation 7", 1.3)] * 2
    (scope,) = [one for one in verdict.judged if one.criterion.quantity.startswith("line length")]
    assert scope.governing.value == pytest.approx(2.6) and scope.met


def test_the_page_needs_nothing_else_and_its_tables_are_sealed(folder, first):
    text = (folder / "out" / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    assert page.open == [] and "box &amp; chain" in text
    for address in page.addresses:
        assert address.startswith("data:image/png;base64,") or (folder / "out" / address).is_file()
    for name in ("cases.csv", "criteria.csv"):
        table = (folder / "out" / name).read_text(encoding="utf-8")
        assert not text_damaged(table) and text_damaged(table.replace("storm", "storn", 1))


def test_rule_sets_stand_side_by_side_and_those_that_judge_say_the_same_as_the_verdict(first):
    verdict = first[0]
    own = {one.criterion: one for one in verdict.judged if one.governing is not None}
    chosen = [one for one in verdict.rule_sets if one.chosen]
    assert {one.name for one in chosen} == {"JSCE (1973)", "port facility II (1980)"} and len(verdict.rule_sets) > 5
    assert not any("PIANC" in one.name for one in verdict.rule_sets)  # of ships and cargo, which nobody chose
    for one in chosen:
        if one.criterion in own:
            assert one.use == own[one.criterion].governing
    used = [one.use.utilisation for one in verdict.rule_sets]
    assert used == sorted(used, reverse=True)


def test_a_rule_set_of_ones_own_file_stands_beside_those_of_the_tables_and_what_the_study_has_not_is_left_out(
    folder, first
):
    """A chain mooring, of which rules on hawsers, fenders, wire and fibre say nothing"""
    head = ",".join(Criterion._fields)
    (folder / "own.csv").write_text(
        f"{head}\nport X,2026,{SHARE},at most,1/2,,-,any,any,any,barge,largest,,bylaw 7,read\n"
    )
    rules = [*PROJECT["rules"], {"rule": "port X", "file": "own.csv"}]
    (folder / "own.toml").write_text(tomli_w.dumps({**PROJECT, "rules": rules}))
    ran = first[0].ran
    of_port = next(one for one in judged_project(read_project(folder / "own.toml"), ran).rule_sets if one.chosen
                   and one.name == "port X (2026)")  # fmt: skip
    largest = max((one.largest / one.numbers.breaking).max() for one in ran if one.case.factor == 1)
    assert of_port.use.utilisation == pytest.approx(2 * largest, rel=1e-9)
    subjects = " ".join(one.subject for one in first[0].rule_sets)
    assert not any(word in subjects for word in ("hawser", "fender", "wire", "synthetic", "single-point"))


def test_the_checklist_says_what_the_simplified_method_lacks_and_equipment_numbers_are_those_of_the_box(folder, first):
    """Δ = 1025 · 50000 kg, front 50 × 10 and side 100 × 10 m² above water"""
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert (
        "steady in storm; give wind.gusts" in page
        and "a single regular wave of the significant height is used; give" in page
    )
    number = 51250.0 ** (2 / 3)
    assert f"LR {number + 2.5 * 500 + 0.1 * 1000:.0f}, AB {number + 2 * 500 + 100:.0f}, NV {number + 500:.0f}" in page


def test_fatigue_is_the_sum_of_equal_cycles_over_the_time_of_each_state(folder):
    """Cycles of 1 and 2 MN of 10 s in a chain of 76 mm, 73 mm on the mean of twenty years of 0.3 mm: by hand from
    N = 6e10 s⁻³; 1 % and 10 % of twenty years"""
    project = {**PROJECT, "fatigue": {"curve": "DNV studless chain", "factor": 5.0}, "simulation": {"duration": 600.0}}
    project["states"] = [{**state, "share": share} for state, share in zip(PROJECT["states"], (0.01, 0.1), strict=True)]
    (folder / "tired.toml").write_text(tomli_w.dumps(project))
    read, t = read_project(folder / "tired.toml"), np.arange(0.0, 600.5, 0.5)
    ran = []
    for name, size in (("storm", 2e6), ("work", 1e6)):
        tension = 3e6 + 0.5 * size * np.stack([np.cos(0.2 * np.pi * t), 0 * t], axis=-1)[None]
        case = SimpleNamespace(state=name, lost="", factor=1, name=name)
        numbers = SimpleNamespace(names=("one", "other"), types=(("chain",),) * 2, breaking=np.array([6e6, 6e6]))
        ran.append(SimpleNamespace(case=case, numbers=numbers, runs={"cycles": cycles_of(tension, 0.5)}, fault=""))
    found = fatigue(read, ran)
    seconds, area = 20 * 365.25 * 86400, 2 * np.pi / 4 * 73.0**2
    whole = 59.0 / 60.0 + 1.0 / 60.0  # of 60 cycles the ends count as halves
    by_hand = 5.0 * seconds / 10.0 / 6e10 * whole * sum(w * (s / area) ** 3 for w, s in ((0.01, 2e6), (0.1, 1e6)))
    assert found.governing.value == pytest.approx(by_hand, rel=1e-6) and found.governing.item == "one"
    assert found.met == (by_hand <= 1)
    own = {"factor": 5.0, "exponent": 3.0, "constant": 6e10, "chain": True}  # the same curve as one's own
    (folder / "tired.toml").write_text(tomli_w.dumps({**project, "fatigue": own}))
    same = fatigue(read_project(folder / "tired.toml"), ran)
    assert same.governing.value == pytest.approx(by_hand, rel=1e-6) and "6e+10 s^−3" in same.criterion.source
    ran[0] = SimpleNamespace(case=ran[0].case, numbers=None, runs=None, fault="no rest")
    assert fatigue(read, ran).met is None


def test_a_second_run_solves_nothing_and_gives_the_same_bytes(folder, first, monkeypatch):
    """After a kill in the middle of the cases too: what is missing is made, the rest is taken"""
    out = folder / "out"
    before = {name: (out / name).read_bytes() for name in first[1]}
    lost = sorted((out / "cases").glob("work*.h5"))[0]
    lost.unlink()
    picture = out / "pictures" / "utilisation.png"
    picture.write_bytes(picture.read_bytes()[:-20])
    solved, drawn = [], []
    monkeypatch.setattr(
        "hakobune.pipelines.moor.result.studied", lambda *given: solved.append(given) or studied(*given)
    )
    monkeypatch.setattr("hakobune.pipelines.common.picture.save", lambda *given: drawn.append(given[1]) or save(*given))
    again = made(read_project(folder / "project.toml"), out, Here(), None, advice=False)
    assert len(solved) == 1 and lost.is_file() and drawn == [picture]
    assert {name: (out / name).read_bytes() for name in again[1]} == before


def test_a_picture_by_other_code_is_drawn_anew(tmp_path, monkeypatch):
    drawn = []
    for code in ("old", "old", "new"):
        monkeypatch.setattr(stored, "code", lambda code=code: code)
        stored.picture(tmp_path / "a.png", stored.key_of("study"), lambda path: drawn.append(path.write_bytes(b"png")))
    assert len(drawn) == 2


def test_the_smallest_size_that_passes_is_found_by_running_it(folder, tmp_path):
    study = {**STUDY, "types": {"chain": {"catalogue": "grade 2 40 mm", "bed_friction": 0.6}}}
    (folder / "thin.toml").write_text(tomli_w.dumps(study))
    project = {**PROJECT, "project": {**PROJECT["project"], "study": "thin.toml"}, "rules": PROJECT["rules"][:1]}
    project["states"] = [{**PROJECT["states"][0], "incidence_deg": [0.0], "lines": ["intact"], "wind": {"speed": 50.0}}]
    del project["wear"], project["states"][0]["waves"]  # steady loads alone: a case takes a tenth of the time
    (folder / "thin_project.toml").write_text(tomli_w.dumps(project))
    verdict, _, advice = made(read_project(folder / "thin_project.toml"), tmp_path / "out", Here(), None)
    assert verdict.word == "fails"
    worst = max(one.governing.utilisation for one in verdict.judged if one.governing)
    found = {one.way: one for one in advice.found}
    assert found["size"].passes and all(one.utilisation < worst for one in advice.found)
    size = float(found["size"].words.split()[2])
    for diameter, word in ((size, "passes"), (size - 2, "fails")):  # the whole project again, and the size below
        study["types"]["chain"]["catalogue"] = f"grade 2 {diameter:g} mm"
        (folder / "thin.toml").write_text(tomli_w.dumps(study))
        again, _, _ = made(read_project(folder / "thin_project.toml"), tmp_path / f"{diameter}", Here(), None, False)
        used = max(one.governing.utilisation for one in again.judged if one.governing)
        assert (used <= 1) == (word == "passes")
        if word == "passes":
            assert used == pytest.approx(found["size"].utilisation, rel=1e-9)


@pytest.mark.parametrize("first", range(12))
def test_the_smallest_change_is_found_by_doubling_and_the_one_below_is_run(first):
    """Changes from `first` on pass: that one is found, and the one before it was run; 12 stands for none"""
    run = {}

    def tried(i):
        run[i] = Tried("size", str(i), 0.9 if i >= first else 2.0 - 0.05 * i, i >= first, None)
        return run[i]

    found = _smallest(tried, 11, 2.5)
    if first < 11:
        assert found is run[first] and (first == 0 or first - 1 in run) and len(run) <= 7
    else:
        assert not found.passes and found.words == "10"


def test_a_way_that_leads_nowhere_is_left_and_what_cannot_be_laid_is_passed_over():
    worse = Tried("size", "", 3.0, False, None)
    assert _smallest(lambda i: worse, 8, 2.5) is None
    assert _smallest(lambda i: None, 8, 2.5) is None


def test_changes_are_of_pretension_number_ropes_and_sizes():
    found = ways(STUDY)
    assert [c.study["spreads"][0]["pretension_tonf"] for c in found["less pretension"]] == [16.0, 13.0, 10.0, 8.0]
    assert [c.study["spreads"][0]["corner_headings_deg"] for c in found["number"]][:2] == [[35, 55], [35, 45, 55]]
    assert found["size"][0].words == "R3 studlink 78 mm for chain" and STUDY["types"]["chain"]["catalogue"].endswith(
        "76 mm"
    )
    rope = {"name": "head", "breaking_load_kN": 1000.0, "pretension_kN": 100.0}
    berth = ways({"rope": [rope]})
    assert berth["size"][0].study["rope"][0]["breaking_load_kN"] == pytest.approx(1100.0)
    assert [one["name"] for one in berth["number"][0].study["rope"]] == ["head", "head, second"]
    assert ways({"mooring": {"count": 6}})["number"][0].study["mooring"]["count"] == 7
    assert ways({}) == {}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda p: p["project"].update(scene="box.toml"),
            "project: scene and database are both given; give one of them",
        ),
        (
            lambda p: p["project"].pop("probability"),
            "project: service_life and probability belong together; give both or neither",
        ),
        (lambda p: p.update(levels={"high": 1.0}), "levels need a database for each depth"),
        (lambda p: p["states"][0].update(levels=["high"]), r"states\[0\].levels is 'high'; allowed: mean"),
        (lambda p: p["states"][0].update(state="calm"), "state is 'calm'; allowed: normal, abnormal"),
        (lambda p: p["states"][0]["wind"].update(incidence_deg=3.0), r"directions in states\[0\].incidence_deg"),
        (
            lambda p: p["states"][1].update(name="storm"),
            "the name of another state; give each state its own",
        ),
        (
            lambda p: p["states"][0]["wind"].update(speed_knots=9.0),
            r"states\[0\].wind: speed and speed_knots are given",
        ),
        (lambda p: p["states"][0]["waves"].update(period=-7.0), r"states\[0\].waves.period is -7"),
        (lambda p: p["project"].update(scene=p["project"].pop("database")), "box.h5 cannot be read"),
        (lambda p: p.update(rules=[{"rule": "Lloyd"}]), "rule set 'Lloyd' is unknown; allowed: JSCE"),
        (lambda p: p.update(rules=[{"rule": "API RP 2SK"}]), "have not been checked against the printed rule"),
        (lambda p: p.update(wear={"mm_per_year": -1.0}), "wear.mm_per_year is -1"),
        (lambda p: p.update(fatigue={"curve": "steel"}), "fatigue.curve is 'steel'; allowed: DNV studlink chain"),
        (lambda p: p.update(fatigue={"exponent": 3.0}), "either curve, or exponent and constant"),
        (lambda p: p.update(fatigue={"curve": "DNV polyester"}), r"fatigue needs \[simulation\]"),
        (
            lambda p: p["states"][0].update(share=1.5),
            "states: the shares of the time are .*; allowed: 0 to 1 each, at most 1 in total",
        ),
        (
            lambda p: p.update(values=[{**GIVEN, "quantity": "gust"}]),
            r"values\[0\].quantity is 'gust'; allowed by the chosen criteria",
        ),
        (lambda p: p.update(values=[{**GIVEN, "value": -1.0}]), r"values\[0\].value is -1; allowed: 0 or more"),
        (lambda p: p.update(earthquakes=[{"name": "x", "study": "x.toml"}]), "the study has no fenders"),
        (
            lambda p: p.update(rules=[{"rule": "PIANC", "subject": "oil tanker; loading arms", "confirmed": True}]),
            r"the study has lines \(types\), but no chosen criterion judges them; .* 'tension / breaking load'",
        ),
        (
            lambda p: p["rules"].pop(),
            r"\[wear\] is given, but no chosen criterion limits 'tension / .* load, worn'; .* \(port facility II\)",
        ),
        (lambda p: p.update(anchors={"holding_kN": 1e4}), r"\[anchors\] is given, .* 'holding capacity"),
        (
            lambda p: p.update(limits=[{"quantity": "swai", "at_most": 5.0, "source": "owner"}]),
            r"limits\[0\].quantity is 'swai'; allowed: .*; sway; .* by \[\[values\]\]",
        ),
        (
            lambda p: p.update(limits=[{"quantity": "surge", "at_most": 5.0, "unit": "ft", "source": "owner"}]),
            r"limits\[0\]: unit of surge is 'ft'; allowed: m",
        ),
        (
            lambda p: p.update(limits=[{"quantity": SHARE, "at_most": 60.0, "unit": "%", "source": "owner"}]),
            "unit of tension / breaking load is '%'; allowed: -",
        ),
        (lambda p: p.update(ice=1), "ice is unknown; allowed: project"),
    ],
)
def test_a_wrong_project_is_told_in_one_line(folder, change, message):
    project = tomllib.loads(tomli_w.dumps(PROJECT))
    change(project)
    (folder / "wrong.toml").write_text(tomli_w.dumps(project))
    with pytest.raises(ValueError, match=message) as fault:
        read_project(folder / "wrong.toml")
    assert "\n" not in str(fault.value)


def test_a_table_of_force_lies_beside_the_project_and_is_looked_at_before_a_case_is_run(folder, monkeypatch):
    """Two passages: one is over before the run ends, the other never ends"""
    monkeypatch.chdir(folder)
    force = {"file": "passage.csv", "at": 500.0}
    project = {**PROJECT, "simulation": {"duration": 600.0, "force": [force]}}
    Path("forced.toml").write_text(tomli_w.dumps(project))
    with pytest.raises(ValueError, match=r"passage\.csv"):
        read_project("forced.toml")
    rows = ["t,Fx,Fy,Fz,Mx,My,Mz", "0,0,0,0,0,0,0", "1,5,0,0,0,0,0"]
    Path("passage.csv").write_text("\n".join(rows))
    with pytest.raises(ValueError, match=r"passage\.csv: a force is given from 500 to 501 s"):
        read_project("forced.toml")
    Path("passage.csv").write_text("\n".join([*rows, "2,0,0,0,0,0,0"]))
    assert read_project("forced.toml").raw["simulation"]["force"][0]["file"] == str(Path.cwd() / "passage.csv")


def test_quantities_that_one_kind_of_study_knows_have_their_units():
    """Whatever a load case may find is refused in another unit"""
    berth, slewing = {"fender": [{"name": "one"}]}, {"slewing": {}}
    found = (*mooring.finds(berth), *single_point.finds(slewing), *breakwater.finds({}), SCOPE, FATIGUE, *OF_TENSIONS)
    assert len(found) == 31 and [name for name in found if found.count(name) > 1] == ["excursion"] * 2
    for quantity in found:
        with pytest.raises(RuleError, match=r"'furlong'; allowed: (m|deg|-)$"):
            unit_of("limit", quantity, "furlong")


def test_a_limit_without_a_unit_is_in_that_of_its_quantity(folder):
    project = {**PROJECT, "limits": [{"quantity": "yaw", "at_most": 2.0, "source": "owner"}]}
    (folder / "units.toml").write_text(tomli_w.dumps(project))
    assert read_project(folder / "units.toml").criteria[-1].unit == "deg"


@pytest.mark.parametrize(
    ("apart", "quantity", "words"),
    [
        (True, "fender strain, total", "No change of lines was tried.*“quake”"),
        (False, "return period", "No change of lines affects .*, return period at least 1"),
        (False, "gust factor", "No change of lines affects .*, gust factor at least 1"),
        (
            False,
            SHARE,
            "No change was tried: the study has no catalogue size, rope, pretension or number of "
            "lines that could change.",
        ),
    ],
)
def test_it_is_said_why_no_change_was_tried(apart, quantity, words):
    """A study without sizes, ropes, pretensions and numbers of lines"""
    case = SimpleNamespace(name="quake", apart=apart)
    criterion = SimpleNamespace(quantity=quantity, name="rule", sense="at least", limit=1.0)
    use = SimpleNamespace(case="quake", utilisation=1.2)
    judged = SimpleNamespace(uses=[use], governing=use, criterion=criterion, met=False)
    project = SimpleNamespace(values=[SimpleNamespace(quantity="gust factor")])
    read = SimpleNamespace(study={"section": {}, "lines": {"angle_deg": 44.0}}, project=project)
    advice = advise(read, [judged], {"quake": case}, {"return period": 50.0}, {}, None, None)
    (line,) = advice_words(advice, SimpleNamespace(word="fails"))
    assert re.search(words, line)


def test_findings_that_differ_in_numbers_alone_are_told_once_by_the_largest():
    ran = []
    for part, name in ((2.0, "a"), (9.5, "b"), (3.0, "c")):
        numbers = SimpleNamespace(warnings=(f"{part} % is lost", "warm"), names=())
        ran.append(SimpleNamespace(case=SimpleNamespace(name=name), numbers=numbers))
    found = list(warnings(SimpleNamespace(ran=ran)))
    assert [one["text"] for one in found] == ["9.5 % is lost", "warm"]
    cases = [one["cases"] for one in found]
    assert cases == ["b; likewise, each with its own numbers, in 2 more cases", "a; likewise, in 2 more cases"]


def test_ways_that_were_tried_in_vain_are_named():
    (line,) = advice_words(Advice(("size", "more pretension"), (), ""), SimpleNamespace(word="fails"))
    assert "larger sizes, more pretension. None lowers" in line
    size = Tried("size", "80 mm", 0.9, True, SimpleNamespace(rule="JSRA", quantity="tension"))
    found, vain = advice_words(Advice(("size", "more pretension"), (size,), ""), SimpleNamespace(word="fails"))
    assert "80 mm" in found and "without success" in vain and "more pretension" in vain and "sizes" not in vain


def test_a_case_that_cannot_be_run_is_named_and_not_dropped(folder, tmp_path, monkeypatch):
    def refused(study, *others):
        if study["waves"]["incidence_deg"] == 60.0:
            raise StudyError("the lines do not reach")
        return real(study, *others)

    real = mooring.run
    monkeypatch.setattr(mooring, "run", refused)
    project = {**PROJECT, "states": [{**PROJECT["states"][0], "incidence_deg": [0.0, 60.0], "lines": ["intact"]}]}
    (folder / "refused.toml").write_text(tomli_w.dumps(project))
    verdict, _, _ = made(read_project(folder / "refused.toml"), tmp_path / "out", Here(), None, advice=False)
    assert [one.fault for one in verdict.ran if one.numbers is None] == ["the lines do not reach"] * 2
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert page.count("could not be run: the lines do not reach") == 2 and verdict.word != "passes"


def test_a_misspelt_quantity_of_ones_own_rules_is_refused_and_one_of_the_tables_is_not(folder):
    head = ",".join(Criterion._fields)
    row = "port Y,2026,{},at most,1.0,,m,any,any,any,any,largest,,the owner,read"
    project = {**PROJECT, "rules": [*PROJECT["rules"], {"rule": "port Y", "file": "misspelt.csv"}]}
    (folder / "misspelt.toml").write_text(tomli_w.dumps(project))
    (folder / "misspelt.csv").write_text(f"{head}\n{row.format('surge at the gangway')}\n")
    with pytest.raises(
        ValueError, match=r"rules\[\d\], misspelt.csv: no load case computes the quantity 'surge at the gangway'"
    ):
        read_project(folder / "misspelt.toml")
    (folder / "misspelt.csv").write_text(f"{head}\n{row.format('gust factor').replace(',m,', ',-,')}\n")
    assert read_project(folder / "misspelt.toml").criteria[-1].quantity == "gust factor"


def test_advice_on_lines_in_their_static_shape_begins_with_letting_them_move():
    """No larger size is advised for a snap without that word; nothing is said where lines move or nothing is advised"""
    left = f'{OF_LINES} of the lines (dynamic_lines = "none"), give dynamic_lines = "auto"'
    static, moving = (SimpleNamespace(numbers=SimpleNamespace(warnings=one)) for one in (("a", left), ("a",)))
    failed, advice = SimpleNamespace(numbers=None), Advice(("size",), (), "Beyond.")
    told = after_lines_move(advice, [failed, static]).beyond
    assert told.startswith("This advice was computed with static lines") and left in told and told.endswith("Beyond.")
    assert after_lines_move(advice, [failed, moving]) == advice
    assert after_lines_move(Advice((), (), ""), [static]).beyond == ""
