"""What parts of a study may say, by themselves: from both sides of each limit, with what is said beyond."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.spectra import LARGEST_GAMMA
from hakobune.mooring.lines.system.parts import LineType, UniformLine
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.quay_tables import HingeTable
from hakobune.pipelines.common.typed import read_toml
from hakobune.pipelines.common.weather import streams
from hakobune.pipelines.downtime.study import _streams, _system
from hakobune.pipelines.downtime.tables import WavesColumns
from hakobune.pipelines.moor.anchors import AnchorTable, anchors_of
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.response.places import keel_points, places_of
from hakobune.pipelines.results.given import given
from hakobune.pipelines.scene.modes import points_of
from hakobune.pipelines.scene.tables import SceneError
from hakobune.pipelines.sea.flags import SpectrumFlags
from hakobune.pipelines.sea.result import _by_fetch, _flags
from hakobune.pipelines.single_point.running import _buoy_and_rope
from hakobune.pipelines.single_point.study import _headings, _pretension
from hakobune.pipelines.site import link
from hakobune.pipelines.solve.hull import _check_count
from hakobune.pipelines.validation.beside import chosen


def refused(says, call, *args, **words):
    with pytest.raises((StudyError, SceneError, ValueError)) as error:
        call(*args, **words)
    assert says in str(error.value)


def test_a_hinge_has_a_finite_place_and_an_axis():
    db = SimpleNamespace(bodies=[SimpleNamespace(name="a", fixed=False), SimpleNamespace(name="b", fixed=True)])

    def link(**more):
        words = {"name": "h", "bodies": ("a", "b"), "position": (0.0, 0.0, 0.0), "axis": (0.0, 1e-9, 0.0)}
        return HingeTable(**words | more).link("hinges[0]", db)

    assert link(kind="slider", damping=2.0).damping == 2000.0  # kN s/m
    for more in ({"position": (0.0, math.inf, 0.0)}, {"axis": (0.0, 0.0, 0.0)}, {"axis": (0.0, math.nan, 1.0)}):
        refused("; allowed: finite, with an axis other than 0", link, **more)
    refused("hinges[0].kind is 'weld'; allowed: ", link, kind="weld")
    refused("at least one of a body that moves", link, bodies=("a", "a"))
    refused("at least one of a body that moves", link, bodies=("b", "space"))
    refused("hinges[0].damping is -1 for a slider; allowed: 0 or more", link, kind="slider", damping=-1.0)
    refused("hinges[0].damping is 1 for a rigid; allowed: 0 or more for a ", link, kind="rigid", damping=1.0)


def test_lists_in_a_file_may_not_be_nested_for_ever(tmp_path):
    path = tmp_path / "deep.toml"
    path.write_text("a = " + 5 * "[" + 5 * "]")
    assert read_toml(path, "a study", StudyError)[0] == {"a": [[[[[]]]]]}
    path.write_text("a = " + 100000 * "[" + 100000 * "]")
    refused("deep.toml is not a study: its lists are nested too deeply", read_toml, path, "a study", StudyError)


def test_heights_and_areas_of_what_the_wind_meets_are_finite_and_not_below_zero():
    assert streams._height("wind", SimpleNamespace(center_z=-3.0)) == -3.0
    assert streams._height("wind", SimpleNamespace(center_z=None)) is None
    refused("wind.center_z is inf; allowed: m, finite", streams._height, "wind", SimpleNamespace(center_z=math.inf))
    sound = {"superstructure_front": 0.0, "superstructure_side": 10.0, "superstructure_z": 1e-3}
    found = streams.superstructures(SimpleNamespace(**sound))
    assert found == {"front_area": 0.0, "side_area": 10.0, "superstructure_z": 1e-3}
    for key, value, says in (
        ("superstructure_front", -0.1, "hull.superstructure_front is -0.1; allowed: m², at least 0"),
        ("superstructure_side", math.inf, "hull.superstructure_side is inf; allowed: m², at least 0"),
        ("superstructure_z", 0.0, "hull.superstructure_z is 0; allowed: m above still water, above 0"),
    ):
        refused(says, streams.superstructures, SimpleNamespace(**{**sound, key: value}))


@pytest.mark.parametrize("stream", ["wind", "current"])
def test_components_of_a_stream_come_in_pairs(stream):
    """3 and 4 m/s are 5; of a wind the direction is where it comes from, of a current where it goes to"""
    columns = {f"{stream} east": np.array([3.0]), f"{stream} north": np.array([4.0])}
    for name in list(columns):
        refused(f"hindcast.columns has {name!r} only; give both '{stream} east' and '{stream} north'",
                _streams, {name: columns[name]})  # fmt: skip
    _streams(columns)
    ends = "from" if stream == "wind" else "to"
    assert columns[f"{stream} speed"] == pytest.approx([5.0])
    towards = math.atan2(3.0, 4.0)
    assert columns[f"{stream} {ends}"] == pytest.approx([towards + math.pi * (ends == "from")])


def test_a_peak_enhancement_is_of_spectra_that_have_one():
    def system(spectrum, gamma):
        table = WavesColumns(height="h", peak_period="t", direction_from="d", spectrum=spectrum, gamma=gamma)
        return _system("hindcast.waves[0]", table, 20.0)

    assert LARGEST_GAMMA == 10
    for gamma in (1.0, 10.0):
        system("jonswap", gamma)
        system("tma", gamma)
        refused(
            f"hindcast.waves[0].gamma is {gamma:g} for issc; allowed: 1 to 10, for jonswap and tma",
            system,
            "issc",
            gamma,
        )
    for gamma in (0.99, 10.1):
        refused(f"gamma is {gamma:g} for jonswap; allowed: 1 to 10, for jonswap and tma", system, "jonswap", gamma)


def test_a_sea_by_fetch_of_finite_depth_needs_one():
    flags = SpectrumFlags(spectrum="tma", wind_speed=20.0, fetch=50e3)
    deep, shallow = (_by_fetch(flags, {}, depth).moment(0) for depth in (1000.0, 10.0))
    assert 0 < shallow < deep
    for depth in (None, math.inf):
        refused("--spectrum tma needs a finite --depth, m", _by_fetch, flags, {}, depth)


def test_points_and_keels_are_finite_and_under_a_keel_there_is_water():
    db = SimpleNamespace(bodies=(), water_depth=12.0)

    def places(*position):
        point = SimpleNamespace(name="bow", position=position, clearance=None, body="")
        study = SimpleNamespace(points=[point], relative=[], hinges=[], stations=[], keel=None)
        return places_of(study, db)

    assert places(50.0, 0.0, 10.0)[0].position == (50.0, 0.0, 10.0)
    refused("points[0].position is [50.0, inf, 10.0]; allowed: finite, m", places, 50.0, math.inf, 10.0)

    def keel(**more):
        words = {"tide": 0.0, "extra_draft": 0.0, "points": [(1.0, 2.0, -10.0)]}
        return keel_points(SimpleNamespace(**words | more), db)

    (one,) = keel(tide=-0.5, extra_draft=0.2)
    assert one.gap == pytest.approx(12 - 0.5 - 10 - 0.2)
    refused("keel.tide is inf; allowed: finite, m", keel, tide=math.inf)
    refused("keel.extra_draft is nan; allowed: finite, m", keel, extra_draft=math.nan)
    assert keel(tide=-1.99)[0].gap == pytest.approx(0.01)
    refused("under (1, 2, -10) there is 0 m of water at rest, with depth 12 m, tide -2", keel, tide=-2.0)
    db.water_depth = math.inf
    refused("the water of the database has no bed", keel)


def test_a_file_of_a_shape_is_rows_of_points_each_once(tmp_path):
    path = tmp_path / "shape.csv"

    def read(*rows):
        path.write_text("x,y,z,ux,uy,uz # of half the hull\n" + "\n".join(rows) + "\n")
        return points_of("modes[0]", str(path))

    rows = [f"{x},{y},0,0,0,{x * x}" for x in range(-6, 7) for y in (-1, 1)]
    assert read(*rows).shape == (26, 6)
    refused("line 4: 'end of file' is not a row of numbers", read, *rows[:2], "end of file")
    refused("has a point twice; allowed: each once", read, *rows, rows[0])
    refused("points; allowed: ", read, *rows[:4])
    refused("all finite", read, *rows, "9,9,0,0,0,inf")
    refused("rows of [6, 7] numbers", read, *rows, rows[0] + ",1.0")
    refused("are 0; allowed: a shape that moves", read, *[row.rsplit(",", 1)[0] + ",0" for row in rows])
    refused("has negative masses, or all masses are 0; allowed: 0 or more, kg", read, *[row + ",0" for row in rows])
    assert read(*[row + ",0" for row in rows[1:]], rows[0] + ",2.0").shape == (26, 7)


def test_a_full_scheme_needs_the_stiffness_of_the_hawser_in_one_way():
    def rope(**more):
        hawser = dict.fromkeys(("axial_stiffness_kN", "axial_stiffness_tonf", "breaking_load_kN", "breaking_load_tonf",
                                "strain")) | {"exponent": 1.0} | more  # fmt: skip
        buoy = SimpleNamespace(mass=100.0, diameter=10.0, height=5.0, z=-3.0, hawser_z=None)
        return _buoy_and_rope(SimpleNamespace(buoy=buoy, hawser=SimpleNamespace(**hawser)))[1]

    rope(axial_stiffness_kN=1e4)
    rope(breaking_load_kN=5e3, strain=0.3)
    says = 'hawser: slewing.scheme "full" needs axial_stiffness, or breaking_load with its strain'
    for more in ({}, {"breaking_load_kN": 5e3}, {"axial_stiffness_kN": 1e4, "breaking_load_kN": 5e3, "strain": 0.3},
                 {"axial_stiffness_kN": 1e4, "breaking_load_kN": 5e3}):  # fmt: skip
        refused(says, rope, **more)


def test_a_tolerance_asks_several_bodies_for_as_many_panels_as_there_may_be():
    from hakobune.pipelines.solve.hull import MOST_PANELS

    scene = SimpleNamespace(several=True, panels=None, accuracy=0.01, bodies=[1, 2])
    _check_count(scene, MOST_PANELS)
    says = f"tolerance 0.01 needs {MOST_PANELS + 1} panels on 2 bodies; allowed: {MOST_PANELS}"
    refused(says, _check_count, scene, MOST_PANELS + 1)
    for one in ({"several": False}, {"panels": 9}):
        _check_count(SimpleNamespace(**vars(scene) | one), MOST_PANELS + 1)


def test_cases_of_validation_are_named_by_how_they_begin():
    cases = {"box-20m": 1, "box-30m": 2, "ship": 3}
    assert (
        chosen(cases, None) == [1, 2, 3] and chosen(cases, "box") == [1, 2] and chosen(cases, "box-30m, ship") == [2, 3]
    )
    refused("--only names 'bo'; allowed: box-20m, box-30m, ship, or beginnings of names", chosen, cases, "bo")


ROPE = {"elongation_percent": [0.0, 10.0, 30.0], "tension_kN": [0.0, 100.0, 800.0]}
TYPES = {"nylon": ROPE, "chain": {"weight_kg_per_m": 60.0, "axial_stiffness_tonf": 25000.0}}


@pytest.mark.parametrize("more, says", [
    ({"bollard": [60.0, 6.0, 3.0], "length": 29.0}, None),
    ({"bollard": [60.0, 6.0, 3.0], "pretension_tonf": 4.0}, None),
    ({"anchor": [60.0, 6.0], "length": 29.0}, "lines[0] (one) is a hawser; give a bollard, with a length or a"),
    ({"type": "chain", "anchor": [100.0, 6.0], "length": 90.0}, None),
    ({"type": "chain", "heading_deg": 0.0, "pretension_tonf": 4.0, "length": 90.0}, None),
    ({"type": "chain", "length": 90.0}, "give one of anchor, bollard, or heading_deg with a pretension"),
    ({"type": "chain", "heading_deg": 0.0, "length": 90.0}, "give one of anchor, bollard, or heading_deg with a"),
    ({"type": "chain", "anchor": [100.0, 6.0], "heading_deg": 0.0, "length": 90.0}, "give one of anchor, bollard"),
])  # fmt: skip
def test_a_line_ends_at_an_anchor_a_bollard_or_where_its_tension_takes_it(more, says):
    line = {"name": "one", "type": "nylon", "fairlead": [30.0, 6.0, 2.0], **more}
    study = make_study({"water": {"depth": 20.0}, "types": TYPES, "lines": [line]})
    hull = SimpleNamespace(length=60.0, beam=12.0)
    if says:
        refused(says, study._legs, {"": hull}, 1025.0, 9.80665, False)
    else:
        (leg,) = study._legs({"": hull}, 1025.0, 9.80665, False)
        assert leg.fairlead == (30.0, 6.0, 2.0)


def test_a_spread_is_of_lines_that_hang():
    spread = {"length": 160.0, "corner_headings_deg": [20.0, 60.0], "pretension_tonf": 4.0}

    def legs(kind):
        raw = {"water": {"depth": 20.0}, "types": TYPES, "spreads": [{"type": kind, **spread}]}
        return make_study(raw)._legs(
            {"": SimpleNamespace(length=60.0, beam=12.0, is_round=False)}, 1025.0, 9.80665, False
        )

    assert len(legs("chain")) == 8
    refused("spreads[0].type nylon is a hawser; give it as [[lines]] with a bollard", legs, "nylon")


def test_coefficients_of_a_site_are_those_it_has(monkeypatch, tmp_path):
    """The seismic coefficient of a site goes into the study that takes one, and is missed where the site has none"""
    path = tmp_path / "study.toml"
    path.write_text('[site]\nfile = "bay.toml"\n')
    taken = link.Taken((), {}, coefficient=("ground", "coefficient"))
    values = SimpleNamespace(earthquake={"coefficient": 0.12}, states={}, levels={})
    monkeypatch.setattr(link, "site_file", lambda _: values)
    assert link._laid(path, "a study", taken)[0]["ground"]["coefficient"] == 0.12
    values.earthquake = {}
    refused("the file of the site has no seismic coefficient; give [earthquake] in the study of hakobune site",
            link._laid, path, "a study", taken)  # fmt: skip
    path.write_text('[site]\nfile = "bay.toml"\nlevel = "high"\n')
    refused(
        "site.level is 'high', but a study does not use the water level of a site; leave it out",
        link._laid,
        path,
        "a study",
        taken,
    )


def test_anchors_are_of_lines_that_end_at_one_each_in_one_table():
    def anchors(*lines):
        tables = [AnchorTable(kind="sinker", friction=0.5, weight_kN=100.0, lines=list(one)) for one in lines]
        return [one is not None for one in anchors_of(tables, ["A", "B", "C"], bollards=["C"])]

    assert anchors(["A"]) == [True, False, False]
    assert anchors(["A"], []) == [True, True, False]  # the others, but not what ends at a bollard
    refused("anchors[1].lines: 'A' is in two tables; allowed lines: B", anchors, ["A"], ["A"])
    refused("anchors[0].lines: 'C' is on no anchor; allowed lines: A, B", anchors, ["C"])
    refused("anchors[0].lines: 'D' is unknown; allowed lines: A, B", anchors, ["D"])
    refused("anchors[1].lines: 'D' is unknown; allowed lines: none is left", anchors, ["A", "B"], ["D"])
    refused("anchors[0] and anchors[1] have no lines; only one table", anchors, [], [])


def test_a_study_is_a_path_a_dictionary_or_itself():
    class Study:
        pass

    one = Study()
    for read, allowed in (
        (lambda path: (one, "text"), "a path, a dictionary or Study"),
        (None, "a dictionary or Study"),
    ):
        with pytest.raises(TypeError) as error:
            given(3, Study, read, lambda raw: one)
        assert str(error.value) == f"the study is of type int; allowed: {allowed}"
    assert given("a.toml", Study, lambda path: (one, path), None) == (one, "a.toml")
    assert given({"a": 1}, Study, None, lambda raw: raw) == ({"a": 1}, "a = 1\n")


def test_flags_of_a_sea_are_called_by_their_names():
    assert _flags(SpectrumFlags, {"height": 2.0, "gamma": None}).height == 2.0
    refused("sea has no 'hight'; allowed: spectrum, height", _flags, SpectrumFlags, {"hight": 2.0})


@pytest.mark.parametrize("headings, count, says", [
    (None, 6, None), (None, 1, None), (None, 0, "mooring.count is 0; allowed: 1 to "), ([0.0], None, None),
    ([], None, "mooring.headings_deg has 0 values; allowed: 1 to "), ([0.0], 6, "give one of headings_deg, count"),
    (None, None, "mooring: give one of headings_deg, count"),
])  # fmt: skip
def test_lines_of_a_buoy_are_all_round_or_where_they_are_said_to_be(headings, count, says):
    """Six lines from 30° on are 60° apart"""
    table = SimpleNamespace(headings_deg=headings, count=count, first_deg=30.0)
    if says:
        refused(says, _headings, table)
    elif count == 6:
        assert np.degrees(_headings(table)) == pytest.approx([30, 90, 150, 210, 270, 330])


def test_a_pretension_is_along_the_water_or_at_the_top():
    """H = T − w h of an inextensible line that lies on the bed: 500 kN at 30 m of 1 kN/m are 470"""
    line = UniformLine("one", LineType("chain", 1000.0), 200.0, "", "")

    def force(**more):
        keys = dict.fromkeys(f"{name}_{unit}" for name in ("pretension", "top_tension") for unit in ("kN", "tonf"))
        return _pretension(SimpleNamespace(**keys | more), line, 30.0)

    assert force(pretension_kN=470.0) == 470e3 and force(top_tension_kN=500.0) == pytest.approx(470e3)
    says = "mooring: give either pretension (horizontal) or top_tension, in tonf or kN"
    refused(says, force)
    refused(says, force, pretension_kN=470.0, top_tension_kN=500.0)
    refused("mooring.top_tension is ", force, top_tension_kN=29.0)
    line = None  # of segments
    refused(
        "mooring.top_tension applies to a uniform line; give pretension for a line of segments",
        force,
        top_tension_kN=500.0,
    )
