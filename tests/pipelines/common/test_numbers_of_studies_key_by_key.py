"""Every key of the tables of studies that has a limit is looked at by itself: one wrong number among good ones is
refused by its name, and the good ones are taken."""

import math
import re
import tomllib
from types import SimpleNamespace

import pytest

from hakobune.pipelines.berth import study as berths
from hakobune.pipelines.breakwater import study as breakwaters
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.line_dynamics import moordyn
from hakobune.pipelines.moor import anchors, checked
from hakobune.pipelines.moor.study import HullTable, Study
from hakobune.pipelines.passing import study as passages
from hakobune.pipelines.sections import study as sections
from hakobune.pipelines.single_point import study as single_points


def refused(call, given, changes, says):
    """The change is refused by these words, and without it nothing is"""
    call(SimpleNamespace(**given))
    with pytest.raises(StudyError, match=re.escape(says)):
        call(SimpleNamespace(**given | changes))


SECTION = {"shape": "rectangle", "beam": 10.0, "height": 8.0, "diameter": None, "points": None, "draft": 5.0}
POINTS = SECTION | {"shape": "points", "beam": None, "height": None, "points": [[0, 0], [1, 1, 0.5]]}


@pytest.mark.parametrize("given, changes, says", [
    (SECTION, {"beam": 0.0}, "section.beam is 0"), (SECTION, {"height": -1.0}, "section.height is -1"),
    (SECTION, {"draft": 0.0}, "section.draft is 0"), (SECTION, {"height": None}, "section.height is missing"),
    (SECTION, {"diameter": 3.0}, "section.diameter is given"), (SECTION, {"points": []}, "section.points is given"),
    (SECTION | {"shape": "circle", "beam": None, "height": None, "diameter": 6.0}, {"diameter": math.inf},
     "section.diameter is inf"),
])  # fmt: skip
def test_sizes_of_a_section_of_a_breakwater(given, changes, says):
    refused(breakwaters._check_section, given, changes, says)


def test_every_point_of_a_section_has_two_or_three_numbers():
    shape = next(name for name, needed in breakwaters.SHAPES.items() if "points" in needed)
    given = SECTION | dict.fromkeys(("beam", "height"))
    given |= dict.fromkeys(breakwaters.SHAPES[shape], 4.0) | {"shape": shape, "points": [[0, 0], [1, 1, 0.5], [2, 0]]}
    for place in range(3):
        points = given["points"].copy()
        points[place] = [0]
        refused(breakwaters._check_section, given, {"points": points}, f"section.points[{place}] has 1 numbers")


LINES = {"angle_deg": 90.0, "attachment": 5.0, "length": 20.0, "spacing": 10.0, "allowable_kN": 500.0,
         "axial_stiffness_kN": 1e5, "attachment_height": 0.0, "pretension_kN_per_m": 0.0}  # fmt: skip


@pytest.mark.parametrize("changes, says", [
    *(({key: 0.0}, f"lines.{key} is 0") for key in ("attachment", "length", "spacing", "allowable_kN",
                                                    "axial_stiffness_kN", "angle_deg")),
    ({"angle_deg": 180.0}, "lines.angle_deg is 180; allowed: above 0 and below 180"),
    ({"attachment_height": -0.1}, "lines.attachment_height is -0.1"),
    ({"attachment_height": math.inf}, "lines.attachment_height is inf"),
    ({"pretension_kN_per_m": -1.0}, "lines.pretension_kN_per_m is -1"),
    ({"pretension_kN_per_m": math.inf}, "lines.pretension_kN_per_m is inf"),
])  # fmt: skip
def test_lines_of_a_breakwater(changes, says):
    refused(breakwaters._check_lines, LINES, changes, says)
    breakwaters._check_lines(SimpleNamespace(**LINES | dict.fromkeys(list(LINES)[1:6]) | {"pretension_kN_per_m": None}))


HULL = {"length": 100.0, "beam": 20.0, "draft": 5.0, "freeboard": 4.0, "center": 49.9}


@pytest.mark.parametrize("changes, says", [
    *(({key: 0.0}, f"hull.{key} is 0") for key in ("length", "beam", "draft", "freeboard")),
    ({"draft": 8.0}, "hull.draft is 8 m; allowed: below the depth of 8 m"),
    ({"center": -50.0}, "hull.center is -50 m from midship; allowed: within 50 m"),
    ({"center": 50.0}, "hull.center is 50 m from midship"),
])  # fmt: skip
def test_the_hull_on_a_buoy(changes, says):
    refused(lambda hull: single_points._check_hull(SimpleNamespace(hull=hull), 8.0), HULL, changes, says)
    single_points._check_hull(SimpleNamespace(hull=SimpleNamespace(**HULL | {"freeboard": None})), 8.0)


SHAPES = {"beam": 20.0, "draft": 5.0, "mass": 1e3, "gyration": 4.0, "y": 0.0, "center_of_gravity": -1.0}


@pytest.mark.parametrize("changes, says", [
    *(({key: 0.0}, f"sections[1].{key} is 0") for key in ("beam", "draft", "mass", "gyration")),
    ({"draft": 12.0}, "sections[1].draft is 12 m in water 12 m deep; allowed: below the depth"),
    ({"y": math.nan}, "sections[1].y is nan; allowed: finite, m"),
    ({"center_of_gravity": math.inf}, "sections[1].center_of_gravity is inf; allowed: finite, m"),
])  # fmt: skip
def test_sections_side_by_side(changes, says):
    refused(lambda one: sections._check_section("sections[1]", one, 12.0), SHAPES, changes, says)
    sections._check_section("sections[1]", SimpleNamespace(**SHAPES | {"mass": None, "gyration": None}), 12.0)


HINGE = {"sections": ("a", "b"), "kind": sorted(sections.KINDS)[0], "position": (0.0, 0.0)}


@pytest.mark.parametrize("changes, says", [
    ({"sections": ("a", "z")}, "hinges[0].sections has 'z'; allowed: a, b, c"),
    ({"sections": ("z", "b")}, "hinges[0].sections has 'z'"), ({"sections": ("b", "b")}, "hinges[0] joins b to itself"),
    ({"kind": "glue"}, "hinges[0].kind is 'glue'; allowed: "),
    ({"position": (0.0, math.nan)}, "hinges[0].position is [0.0, nan]; allowed: finite, m"),
    ({"position": (math.inf, 0.0)}, "hinges[0].position is [inf, 0.0]"),
])  # fmt: skip
def test_hinges_of_sections(changes, says):
    refused(lambda one: sections._check_hinge("hinges[0]", one, ["a", "b", "c"]), HINGE, changes, says)


PASSING = {"depth": 10.0, "density": 1025.0}


def water_of(**changes):
    ship = {"shape": "box", "length": 60.0, "beam": 12.0, "draft": 4.0}
    tables = {"water": PASSING, "moored": ship, "passing": ship, "track": {"distance": 40.0, "speed": 2.0}}
    return passages.make_study(tables | changes)


@pytest.mark.parametrize("changes, says", [
    ({"water": {"depth": 0.0}}, "water.depth is 0 m; allowed: above 0, or inf"),
    ({"water": {"depth": 10.0, "density": 0.0}}, "water.density is 0"),
    ({"method": "guess"}, "method is 'guess'; allowed: "),
    ({"panels": passages.PANELS[0] - 1}, f"panels is {passages.PANELS[0] - 1}; allowed: {passages.PANELS[0]} to"),
    ({"panels": passages.PANELS[1] + 1}, f"panels is {passages.PANELS[1] + 1}; allowed: {passages.PANELS[0]} to"),
    *(({"track": {"distance": 40.0, "speed": 2.0, "lengths": value}}, f"track.lengths is {value:g}; allowed: 0.5 to 20")
      for value in (0.49, 20.1)),
    ({"method": "wang", "wall": 30.0}, "wall is given with method = 'wang'; it applies to 'panels' only"),
    ({"method": "panels", "quay": True}, "quay is given with method = 'panels'; it applies to 'kriebel' only"),
    ({"method": "panels", "peaks": [50.0, 50.0, 50.0]}, "peaks is given with method = 'panels'"),
    ({"method": "kriebel", "water": {"depth": math.inf}}, 'method = "kriebel" is based on tests in shallow water'),
    ({"wall": math.inf, "method": "panels"}, "wall is inf m; allowed: finite; leave it out for open water"),
])  # fmt: skip
def test_passages(changes, says):
    for lengths in (0.5, 20.0):
        water_of(track={"distance": 40.0, "speed": 2.0, "lengths": lengths})
    for panels in passages.PANELS:
        water_of(panels=panels)
    with pytest.raises(StudyError, match=re.escape(says)):
        water_of(**changes)


SHIP = {"rotation_center": None, "center_of_gravity": (0.0, 0.0, 0.0), "trimmed": False, "fixed": False}
SHIP |= dict.fromkeys(("mass", "GM", "gyration", "name", "place", "viscous"))


@pytest.mark.parametrize("key, value", [
    ("mass", 1.0), ("GM", 1.0), ("gyration", (1.0, 2.0, 3.0)), ("name", "ship"), ("place", (0, 0, 0)),
    ("viscous", "table"), ("center_of_gravity", (0.0, 0.0, -1.0)), ("trimmed", True), ("fixed", True),
])  # fmt: skip
def test_ships_that_pass_have_a_hull_alone(key, value, monkeypatch):
    monkeypatch.setattr(passages, "check_body", lambda name, body, depth: None)
    says = f"moored.{key} is given; a passage needs the hull only: leave it out"
    refused(lambda ship: passages._check_ship("moored", ship, 10.0), SHIP, {key: value}, says)
    turned = {"rotation_center": (1.0, 0.0, 0.0)}
    passages._check_ship("moored", SimpleNamespace(**SHIP | turned), 10.0)
    with pytest.raises(StudyError, match=r"passing.rotation_center is given; only the moored ship has one"):
        passages._check_ship("passing", SimpleNamespace(**SHIP | turned), 10.0)


SIZES = {"length": 100.0, "beam": 20.0, "draft": 5.0}


@pytest.mark.parametrize("key", SIZES)
def test_sizes_of_a_moored_hull_are_those_of_the_study_or_of_its_database(key):
    """A millionth of difference is none"""
    study = SimpleNamespace(hull=None, wind=None)
    box = Study.hull_of(study, SIZES)
    assert (box.length, box.beam, box.draft, box.freeboard, box.is_round) == (100.0, 20.0, 5.0, 5.0, False)
    box = Study.hull_of(study, {}, HullTable(**SIZES, freeboard=3.0))
    assert (box.length, box.beam, box.draft, box.freeboard) == (100.0, 20.0, 5.0, 3.0)
    study.hull = HullTable(**{key: SIZES[key] * (1 + 0.9e-6)})
    assert getattr(Study.hull_of(study, SIZES), key) == getattr(study.hull, key)
    study.hull = HullTable(**{key: SIZES[key] * (1 + 1.1e-6)})
    with pytest.raises(StudyError, match=rf"hull.{key} is .* m, but the database is for {SIZES[key]:g} m; change it"):
        Study.hull_of(study, SIZES)
    study.hull = None
    with pytest.raises(StudyError, match=rf"hull.{key} is missing, also in the database; give it in m, above 0"):
        Study.hull_of(study, {name: size for name, size in SIZES.items() if name != key})
    with pytest.raises(StudyError, match=rf"hull.{key} is 0"):
        Study.hull_of(study, {}, HullTable(**SIZES | {key: 0.0}))


def test_a_round_hull_is_as_long_and_wide_as_twice_its_radius_and_wind_needs_a_freeboard():
    study = SimpleNamespace(hull=None, wind=None)
    box = Study.hull_of(study, {"radius": 12.0, "draft": 5.0})
    assert (box.length, box.beam, box.draft, box.is_round) == (24.0, 24.0, 5.0, True)
    study.wind = "wind"
    with pytest.raises(StudyError, match=r"hull.freeboard is missing, and the wind acts on it; give the freeboard"):
        Study.hull_of(study, SIZES)
    assert Study.hull_of(study, SIZES, HullTable(freeboard=2.0)).freeboard == 2.0
    with pytest.raises(StudyError, match=r"hull.freeboard is 0"):
        Study.hull_of(study, SIZES, HullTable(freeboard=0.0))


ALL = frozenset((*checked.RADIATION, "excitation_force", "drift_force", *checked.KOCHIN, *checked.DRIFT))


@pytest.mark.parametrize("stored, waves, lacks", [
    (ALL, True, None), (ALL - {checked.DRIFT[1]}, True, None), (ALL - set(checked.KOCHIN), True, None),
    (ALL - {checked.DRIFT[1], checked.KOCHIN[0]}, True, checked.DRIFT[1]),
    (ALL - {checked.DRIFT[1], checked.KOCHIN[0]}, False, None),
    (ALL - {"excitation_force"}, False, "excitation_force"),
    (ALL - {checked.RADIATION[0]}, False, checked.RADIATION[0]),
    (ALL - {checked.RADIATION[-1]}, False, checked.RADIATION[-1]),
])  # fmt: skip
def test_a_moored_body_is_solved_for_its_motions_and_in_waves_for_their_drift(stored, waves, lacks):
    body = SimpleNamespace(name="b", has_inertia=True, stored=stored, bodies=())
    if lacks is None:
        checked.check_stored(body, waves)
    else:
        with pytest.raises(StudyError, match=rf"b: the key want of its scene does not list {lacks}; list radiation"):
            checked.check_stored(body, waves)
    body.has_inertia = False
    with pytest.raises(StudyError, match="b: the radii of gyration are missing; give gyration"):
        checked.check_stored(body, waves)


@pytest.mark.parametrize("stored, good", [(ALL | {checked.OF_EACH}, True), (ALL, False)])
def test_several_bodies_have_a_drift_of_each(stored, good):
    body = SimpleNamespace(name="b", has_inertia=True, stored=stored, bodies=("ship", "barge"))
    checked.check_stored(body, False)
    if good:
        checked.check_stored(body, True)
        return
    with pytest.raises(StudyError, match=f"does not list {checked.OF_EACH};"):
        checked.check_stored(body, True)


PILE = {"kind": "pile", "holding_kN": 800.0, "girth": 3.0, "length": 10.0, "cohesion_kPa": 20.0, "uplift_kN": None}


@pytest.mark.parametrize("changes, says", [
    ({"holding_kN": None}, "a.holding_kN is missing; give the horizontal capacity of the pile, kN"),
    *(({key: None}, "a: give either uplift_kN, or girth, length and cohesion_kPa of the pile")
      for key in ("girth", "length", "cohesion_kPa")),
    ({"uplift_kN": 5.0}, "a: give either uplift_kN, or girth"),
    ({"uplift_kN": 5.0, "girth": None, "length": None}, "a: give either uplift_kN, or girth"),
])  # fmt: skip
def test_a_pile_holds_by_its_skin_or_by_what_is_given(changes, says):
    """3 · 10 m² of 20 kPa are 600 kN"""
    made = anchors._pile("a", SimpleNamespace(**PILE), 2.0)
    assert (made.kind, made.holding, made.uplift, made.safety) == ("pile", 8e5, 6e5, 2.0)
    given = SimpleNamespace(**PILE | dict.fromkeys(("girth", "length", "cohesion_kPa")) | {"uplift_kN": 5.0})
    assert anchors._pile("a", given, 1.0).uplift == 5e3
    refused(lambda table: anchors._pile("a", table, 2.0), PILE, changes, says)


KIND = {"name": "chain", "axial_stiffness": 5e8, "mass": 110.0, "diameter": 0.13, "weight": 940.0, "breaking_load": 9e6}


@pytest.mark.parametrize("changes, says", [
    *(({key: value}, f"f.txt: {words} of line type chain is {value:g}; allowed: finite, above 0")
      for key, words in (("axial_stiffness", "axial stiffness EA"), ("mass", "mass"), ("diameter", "diameter"))
      for value in (-1.0, 0.0, math.inf)),
    ({"weight": 0.0}, "f.txt: the weight of line type chain in water is 0 N/m; allowed: above 0"),
])  # fmt: skip
def test_types_of_a_moordyn_file_that_moves(changes, says):
    own = SimpleNamespace(damping=-0.8, drag_normal=1.3, drag_tangential=0.2, added_mass_normal=1.0,
                          added_mass_tangential=0.5, bending_stiffness=2e3)  # fmt: skip

    def made(kind):
        kind.dynamics = own
        return moordyn._type(SimpleNamespace(type=kind, length=200.0, elements=20), "f.txt")

    refused(made, KIND, changes, says)
    found = made(SimpleNamespace(**KIND))
    assert (found.weight_N_per_m, found.axial_stiffness_kN, found.breaking_load_kN) == (940.0, 5e5, 9e3)
    assert (found.mass_kg_per_m, found.diameter, found.damping_ratio) == (110.0, 0.13, 0.8)
    assert (found.drag_normal, found.drag_tangential, found.added_normal, found.added_tangential) == (1.3, 0.2, 1, 0.5)
    assert found.bending_stiffness_kN_m2 == 2.0
    assert made(SimpleNamespace(**KIND | {"breaking_load": math.inf})).breaking_load_kN is None
    own.damping = 2e5  # N s of an element of 10 m: over 10 √(EA m)
    assert made(SimpleNamespace(**KIND)).damping_ratio == pytest.approx(2e5 / (10 * math.sqrt(5e8 * 110)))


BERTHING = tomllib.loads((SCENES / "berth_tanker.toml").read_text(encoding="utf-8"))
HALF = 0.5 * BERTHING["ship"]["length"]


@pytest.mark.parametrize("table, key, value, says", [
    (None, "depth", 0.0, "depth is 0; allowed: above 0"), (None, "depth", math.inf, "depth is inf; allowed: above 0"),
    ("ship", "center", HALF, f"ship.center is {HALF:g}; allowed: within half the length, {HALF:g} m"),
    ("ship", "center", -HALF, f"ship.center is {-HALF:g}"), ("approach", "abnormal", 0.99, "approach.abnormal is 0.99"),
    ("approach", "abnormal", 10.1, "approach.abnormal is 10.1; allowed: 1 to 10"),
])  # fmt: skip
def test_berthings(table, key, value, says):
    def approach(key, value):
        change = {key: value} if table is None else {table: BERTHING[table] | {key: value}}
        return berths.approach_of(typed(BERTHING | change, berths.BerthStudy, StudyError))

    approach(*{"depth": ("depth", 30.0), "center": ("center", 0.1 * HALF), "abnormal": ("abnormal", 10.0)}[key])
    with pytest.raises(StudyError, match=re.escape(says)):
        approach(key, value)
