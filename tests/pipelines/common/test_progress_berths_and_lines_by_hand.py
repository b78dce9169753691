"""Progress as it is printed, what is told of a berth, lines of a file, pairs of waves: of parts set by hand."""

import io
import json
import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from hakobune.pipelines.common import progress
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor import lines_file
from hakobune.pipelines.qtf import problem as of_pairs
from hakobune.pipelines.results.frames import as_dataframe
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels
from hakobune.pipelines.simulate import berth


@pytest.fixture
def clock(monkeypatch):
    now = SimpleNamespace(seconds=100.0)
    monkeypatch.setattr(progress, "time", SimpleNamespace(perf_counter=lambda: now.seconds))
    now.console = Console(file=io.StringIO(), width=200)
    now.lines = lambda: now.console.file.getvalue().splitlines()
    return now


def test_frequencies_are_told_with_what_is_left_by_the_pace_of_those_before(clock):
    """40 s for two, of which 10 s are done once for all: 15 s each, three are left"""
    told = progress.Progress(clock.console, 12)
    clock.seconds += 40.0
    told.done = 1
    found = {
        "wall_time": {"reduction": 7.0, "rankine": 3.0, "solve": 2.5},
        "checks": {"energy": 1e-3, "other": math.nan},
    }
    told.step(0.5, found, "")
    assert clock.lines() == [" 2/12  ω  0.5000 rad/s  T   12.57 s      12.50 s  2 min 30 s left  energy 1e-03"]
    told.step("added_mass_zero", {"wall_time": {"reduction": 1.0}}, "")
    assert clock.lines()[1] == f" 3/12  {'added_mass_zero':30}  {'1.00 s':>9}  {'1 min 30 s':>8} left"
    told.step(1.0, ValueError("no"), "ValueError: no")
    assert clock.lines()[2].endswith(f"{'failed':>9}  {'1 min 00 s':>8} left  ValueError: no")
    assert told.once == 10.0


def test_a_preparation_is_told_every_ten_seconds_until_it_is_whole(clock):
    """Stages of 60 and 40 s. Half of the first is done in 30 s where 30 s were guessed: 70 s are left"""
    cost = SimpleNamespace(stages={"near": (10, 6.0), "far": (4, 10.0)}, seconds=100.0)
    told = progress.Preparing(clock.console, cost)
    clock.seconds += 9.9
    told("near", 2)
    assert clock.lines() == []
    clock.seconds += 20.1
    told("near", 3)
    assert clock.lines() == ["preparing:  30 %  1 min 10 s left"] and told.share == pytest.approx(0.3)
    clock.seconds += 30.0
    told("far", 1)  # near is whole by now; 60 s for 70: pace (60 + 10)/(70 + 10)
    assert clock.lines()[1] == "preparing:  70 %      26 s left"
    clock.seconds += 30.0
    told("far", 99)
    assert len(clock.lines()) == 2 and told.share == 1.0


@pytest.mark.parametrize(("seconds", "text"), [
    (59.4, "59 s"), (59.6, "1 min 00 s"), (200, "3 min 20 s"), (3600, "1 h 00 min"), (7500, "2 h 05 min"),
    (3 * 86400 - 1, "71 h 59 min"), (3 * 86400, "3 days"), (365 * 86400, "1 years"), (40 * 365.25 * 86400, "40 years"),
])  # fmt: skip
def test_durations_are_in_the_unit_that_suits_them(seconds, text):
    assert progress.duration(seconds) == text


@pytest.mark.parametrize(
    ("harbour", "told"), [([100.0], 1), ([83.4], 1), ([83.2], 0), ([125.2], 0), ([124.9, 100.0], 2), ([], 0)]
)
def test_periods_within_a_fifth_of_the_harbour_s_resonate(harbour, told):
    """Of surge 100 s; sway is not known"""
    file = SimpleNamespace(attrs={"harbour_period": harbour, "natural_period": [100.0, np.nan, np.nan]})
    said = list(berth.findings_on_periods(file))
    assert len(said) == told and all(
        line.startswith("the natural period of surge at the berth, 100 s, is near") for line in said
    )
    assert not told or "until the two periods are 20 % apart" in said[0]


def test_a_fender_that_is_pressed_too_far_is_told_with_its_own_strain(monkeypatch):
    """Of 0.9 m on 1 m the dolphin takes a third, where the knots say so; allowed 55 %"""
    values = {"deflection A": 0.9, "deflection B": 0.5}
    monkeypatch.setattr(berth, "summary_of", lambda file, name: {"largest": values[name]})
    monkeypatch.setattr(berth, "fender_names", lambda file: ["A", "B"])
    knots = [[[0.0, 0.9], [0.0, 0.6]], [[0.0, 1.0], [0.0, 1.0]]]
    file = SimpleNamespace(
        attrs={"fender_strains": json.dumps(knots), "fender_height": [1.0, 1.0], "fender_allowable": [0.55, 0.55]}
    )
    strain, allowable = berth.fender_strains(file)
    assert strain == pytest.approx([0.6, 0.5]) and allowable.tolist() == [0.55, 0.55]
    (said,) = berth.findings_on_fenders(file)
    assert said.startswith("FAILS: A is compressed by 60 % of its height; allowed: 55 %; choose a larger fender")
    assert berth.fender_strains(SimpleNamespace(attrs={})) is None and not list(
        berth.findings_on_fenders(SimpleNamespace(attrs={}))
    )


@pytest.mark.parametrize(
    ("length", "bodies", "keep", "says"),
    [
        (600.0, (), 1, None),
        (3600.0, (), 1, None),
        (3601.0, (), 1, "--windows is 3601 s; allowed: "),
        (0.1, (), 1, "--windows is 0.1 s"),
        (600.0, (1,), 1, "--windows is given, and the database contains several bodies"),
        (600.0, (), 0, "--windows is given, and no record is stored; it needs keep_series of 1 or more"),
    ],
)
def test_windows_lie_in_a_record_that_is_kept(length, bodies, keep, says):
    plan = SimpleNamespace(settings=SimpleNamespace(step=0.5, duration=3600.0), keep_series=keep)
    if says is None:
        berth.check_windows(length, plan, bodies)
    else:
        with pytest.raises(StudyError) as error:
            berth.check_windows(length, plan, bodies)
        assert str(error.value).startswith(says)


@pytest.mark.parametrize(
    "more",
    [{"rope": [1]}, {"lines": [1]}, {"spreads": [1]}, {"record": "r"}, {"sea": None}, {"swell": [1]}, {"file": "f"}],
)
def test_the_design_spectrum_is_for_fenders_alone_in_one_sea(monkeypatch, more):
    study, found = of_berth(monkeypatch)
    assert berth.by_design_spectrum(study, "db", "body", "hull", ["f"]) == (
        "design spectrum method, 3 fenders: static 0.12 m (6 %), σ 0.05 m, largest 0.3 m (15 %); allowed: 10 and 50 %, "
        "up to a significant height of 2.50 m"
    )  # fmt: skip
    assert found == [("body", ["f"], 7.0, study.conditions(), "family 0.5")]
    for name, value in more.items():
        where = {"record": study.simulation, "sea": study.conditions(), "swell": study.waves, "file": study.waves}.get(
            name, study
        )
        setattr(where, name, value)
    assert berth.by_design_spectrum(study, "db", "body", "hull", ["f"]) == ""


def of_berth(monkeypatch):
    asked = []
    strains = SimpleNamespace(static=0.12, static_strain=0.06, sigma=0.05, largest=0.3, strain=0.15)
    made = SimpleNamespace(strains=strains, count=3, limit=2.5)

    def at_quay(body, fenders, across, conditions, family):
        asked.append((body, fenders, across, conditions, family()))
        return made

    monkeypatch.setattr("hakobune.mooring.dolphins.at_quay.at_quay", at_quay)
    monkeypatch.setattr("hakobune.mooring.dolphins.design_spectrum.STATIC", 0.1)
    monkeypatch.setattr("hakobune.mooring.dolphins.design_spectrum.TOTAL", 0.5)
    monkeypatch.setattr(
        "hakobune.mooring.studies.steady_loads.steady_loads", lambda *given: {"wind": [1, 3, 5], "current": [2, 4, 6]}
    )
    monkeypatch.setattr(
        "hakobune.mooring.studies.steady_loads.with_coefficients", lambda conditions, hull, depth: conditions
    )
    monkeypatch.setattr(
        "hakobune.pipelines.common.weather.seas.family_of", lambda where, waves, depth: lambda gamma: f"family {gamma}"
    )
    monkeypatch.setattr("hakobune.pipelines.common.weather.seas.shape_of", lambda waves: {"gamma": 0.5})
    conditions = SimpleNamespace(sea="sea")
    study = SimpleNamespace(
        rope=[],
        lines=[],
        spreads=[],
        simulation=SimpleNamespace(record=None),
        waves=SimpleNamespace(swell=[], file=None),
        water=SimpleNamespace(depth=15.0),
        conditions=lambda: conditions,
    )
    return study, asked


def point(position, mass=0.0, volume=0.0, body="ship"):
    return SimpleNamespace(
        position=np.array(position, float), mass=mass, volume=volume, drag_area=0.5, added_mass=0.75, body=body
    )


def test_a_chain_of_lines_is_a_table_of_segments_with_what_hangs_between_them(monkeypatch):
    """From the anchor up: a point of 100 kg and 0.02 m³ weighs 9.8 · (100 − 1000 · 0.02) N; the next has neither"""
    types = {"t1": {"bed_friction": 0.3}, "t2": {"bed_friction": 0.7}}
    monkeypatch.setattr(
        lines_file, "_parts", lambda line, along, types: [{"type": line.type, "length": line.length, "along": along}]
    )
    monkeypatch.setattr(lines_file, "_in_space", lambda fairlead, bodies: ["space", fairlead.body])
    points = {
        "a": point((100.0, 50.0, -30.0)),
        "b": point((60, 30, -20), 100.0, 0.02),
        "c": point((30, 10, -5)),
        "f": point((5, 0, 2)),
    }
    line = [SimpleNamespace(name=n, a=a, b=b, type=t, length=length) for n, a, b, t, length in (
        (1, "a", "b", "t1", 50.0), (2, "c", "b", "t2", 40.0), (3, "c", "f", "t1", 30.0))]  # fmt: skip
    chain = [(line[0], True), (line[1], False), (line[2], True)]
    made = lines_file._table(chain, points, "bodies", 30.0, (1000.0, 9.8), types)
    assert made == {
        "name": "1 2 3",
        "fairlead": ["space", "ship"],
        "anchor": [100.0, 50.0],
        "bed": {"friction": 0.7},
        "segments": [
            {"type": "t1", "length": 50.0, "along": True},
            {"type": "t2", "length": 40.0, "along": False},
            {"type": "t1", "length": 30.0, "along": True},
        ],
        "bodies": [
            {
                "after_segment": 1,
                "mass": 100.0,
                "volume": 0.02,
                "weight_N": pytest.approx(784.0),
                "drag_area": 0.5,
                "added_mass": 0.75,
            }
        ],
    }
    one = lines_file._table(chain[:1], points | {"b": point((5, 0, 2))}, "bodies", 30.0, (1000.0, 9.8), types)
    assert one == {"name": "1", "fairlead": ["space", "ship"], "anchor": [100.0, 50.0], "type": "t1", "length": 50.0}
    high = lines_file._table(chain[:1], points, "bodies", 40.0, (1000.0, 9.8), types)
    assert high["bollard"] == [100.0, 50.0, -30.0] and "anchor" not in high


def test_a_fairlead_is_where_its_body_rests():
    """90° to the left at (10, 20, 0): 3 m ahead are 3 m along y"""
    body = SimpleNamespace(position=np.array([10.0, 20.0, 0.0, 0.0, 0.0, math.pi / 2]))
    assert lines_file._in_space(point((3.0, 1.0, 2.0)), {"ship": body}) == pytest.approx([9.0, 23.0, 2.0])


def test_quantities_on_one_axis_are_columns_of_a_frame():
    made = Result(
        "k",
        {
            "a": Quantity([1.0, 2.0], ("line",), "N", "a", "t"),
            "b": Quantity([3, 4], ("line",), "", "b", "t"),
            "c": Quantity(5.0, (), "m", "c", ""),
            "d": Quantity(np.zeros((2, 2)), ("line", "xy")),
        },
        labels("line", ["bow", "stern"]) | labels("xy", ["x", "y"]),
    )
    frame = as_dataframe(made, "b", "a")
    assert (
        list(frame.columns) == ["b", "a"] and frame["a"].tolist() == [1, 2] and frame.index.tolist() == ["bow", "stern"]
    )
    assert frame.index.name == "line" and list(as_dataframe(made).columns) == ["a", "b"]
    assert as_dataframe(made, "c")["c"].tolist() == [5.0]
    for names in (("a", "c"), ("d",), ("a", "d")):
        with pytest.raises(
            ValueError, match=f"{', '.join(names)} do not share a single axis; allowed: quantities that all"
        ):
            as_dataframe(made, *names)


@dataclass(frozen=True)
class Panels:
    mesh: object
    lid: object = None
    damping_lids: object = None


@pytest.mark.parametrize(
    ("method", "fits", "coarse", "kind"),
    [
        ("auto", True, True, "contour"),
        ("panel", True, True, "panel"),
        ("auto", False, True, "panel"),
        ("auto", False, False, "panel"),
        ("contour", True, True, "contour"),
    ],
)
def test_pairs_of_waves_are_of_the_cylinder_or_of_panels_with_a_coarser_mesh(monkeypatch, method, fits, coarse, kind):
    """Twice as many panels as the coarser mesh has"""
    asked = []
    fine, rough = (SimpleNamespace(total=n) for n in (200, 100))
    monkeypatch.setattr("hakobune.mooring.response.bound_wave_drift.problem_of", lambda db: Panels(fine))
    monkeypatch.setattr("hakobune.bem.second_order.quadratic_forces.panel_errors", lambda *given: ("panels", *given))
    monkeypatch.setattr("hakobune.bem.second_order.quadratic_forces.resolution_errors", lambda *given: ("two", *given))
    monkeypatch.setattr(
        "hakobune.pipelines.solve.hull.coarse_hull_of",
        lambda *given: asked.append(given) or ((rough, "lid") if coarse else None),
    )
    monkeypatch.setattr(of_pairs, "_with_lid", lambda problem, highest: asked.append(highest) or problem)
    monkeypatch.setattr(of_pairs, "_damping_lids", lambda db: "lids")
    monkeypatch.setattr(of_pairs, "_fits_contour", lambda db, highest: fits)
    monkeypatch.setattr(
        of_pairs, "_cylinder", lambda db, panels, tolerance: ("cylinder", panels.damping_lids, tolerance)
    )
    db = SimpleNamespace(path="b.h5", header="header")
    made = of_pairs.bodies(db, method, 1.0, 1.5)
    assert made.method == kind and asked[0] == 1.5
    if kind == "contour":
        assert (made.fine, made.rough) == tuple(("cylinder", "lids", one) for one in of_pairs.TOLERANCES)
        assert made.errors(1, 2, 3) == ("two", 1, 2)
    else:
        assert made.fine == Panels(fine, None, "lids") and made.rough == (
            Panels(rough, "lid", "lids") if coarse else None
        )
        assert made.errors(1, 2, 3) == ("panels", 1, 2, 2.0 if coarse else 1.0, 3) and asked[1] == (
            "header",
            of_pairs.FEWEST,
            None,
        )
    of_pairs.bodies(db, "panel", 2.0, 1.5)
    assert 2.0 in asked


def test_the_contour_method_is_refused_for_another_body(monkeypatch):
    monkeypatch.setattr("hakobune.mooring.response.bound_wave_drift.problem_of", lambda db: Panels("mesh"))
    monkeypatch.setattr(of_pairs, "_with_lid", lambda problem, highest: problem)
    monkeypatch.setattr(of_pairs, "_damping_lids", lambda db: ())
    monkeypatch.setattr(of_pairs, "_fits_contour", lambda db, highest: False)
    with pytest.raises(
        ValueError, match=r"--method contour is given for b\.h5; the method needs a vertical cylinder in finite"
    ):
        of_pairs.bodies(SimpleNamespace(path="b.h5"), "contour", 1.0, 1.5)
