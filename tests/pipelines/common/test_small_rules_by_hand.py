"""Small rules of the house, each by hand and on both sides: names of columns, units of print, values given twice,
what a method cannot, flags in SI, bodies beside each other."""

import math
import re
import warnings
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError, water_depth
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.fender import result as fender
from hakobune.pipelines.line_dynamics import result as line_dynamics
from hakobune.pipelines.lines import flags
from hakobune.pipelines.moor import study as moor
from hakobune.pipelines.printing.console import _distinct
from hakobune.pipelines.results.heard import heard
from hakobune.pipelines.results.quantity import read_in
from hakobune.pipelines.scene import checks, methods
from hakobune.pipelines.scene.scene import SceneError


@pytest.mark.parametrize(("names", "made"), [
    (["a", "b"], ["a", "b"]), (["bow", "at", "stern", "at"], ["bow", "bow at", "stern", "stern at"]),
    (["at", "bow", "at"], ["at", "bow", "bow at"]), (["", "x", "x"], ["", "x", "x x"]), (["at", "at"], ["at", "at at"]),
])  # fmt: skip
def test_columns_of_one_name_have_that_of_the_column_before_in_front_but_for_the_first(names, made):
    assert _distinct(names) == made


@pytest.mark.parametrize(
    ("unit", "values", "share", "read"),
    [
        ("N", [1000.0], False, ("kN", 1e3)),
        ("N", [-1000.0, 1.0], False, ("kN", 1e3)),
        ("N", [999.0, -999.0], False, ("N", 1.0)),
        ("N", [-2000.0], False, ("kN", 1e3)),
        ("N", [0.0], False, ("kN", 1e3)),
        ("N", [np.nan, 5.0], False, ("N", 1.0)),
        ("N", [np.inf], False, ("kN", 1e3)),
        ("rad", [0.001], False, ("°", math.pi / 180)),
        ("m", [5.0], False, ("m", 1.0)),
        ("", [0.5], True, ("%", 0.01)),
        ("N s2/m2", [5000.0], False, ("kN s²/m²", 1e3)),
        ("kg/m3", [1.0], False, ("kg/m³", 1.0)),
        ("N s2/m2", [5.0], False, ("N s²/m²", 1.0)),
    ],
)
def test_thousands_of_a_unit_are_read_in_the_larger_one(unit, values, share, read):
    assert read_in(unit, np.array(values), share) == read


def test_warnings_of_a_study_are_kept_once_each_however_often_they_come_and_also_at_a_fault():
    def warn():
        warnings.warn("again", stacklevel=1)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the caller
        with heard() as said:
            warn()
            warn()
            warnings.warn("else", stacklevel=1)
        assert said == ["again", "else"]
        with pytest.raises(KeyError), heard() as said:
            warn()
            raise KeyError
        assert said == ["again"]


@pytest.mark.parametrize(
    ("given", "turn", "says"),
    [
        ([0.5, 0.6], None, None),
        ([0.5, 0.5], None, "waves.omega has 0.5 twice; allowed: each value once"),
        ([0.0, 90.0, 359.0], 360.0, None),
        ([0.0, 90.0, 360.0], 360.0, "waves.omega has 0 twice, once as 360; allowed"),
        ([-90.0, 45.0, 270.0], 360.0, "waves.omega has -90 twice, once as 270"),
        ([10.0, 45.0, 370.0], 360.0, "waves.omega has 10 twice, once as 370"),
        ([10.0, 45.0, 45.0], 360.0, "has 45 twice; allowed"),
    ],
)
def test_two_values_that_are_one_are_told_as_they_were_given(given, turn, says):
    values = sorted(given)
    if says is None:
        checks._check_apart("waves.omega", given, values, turn)
    else:
        with pytest.raises(SceneError) as error:
            checks._check_apart("waves.omega", given, values, turn)
        assert says in str(error.value) and str(error.value).endswith(f"{checks.CLOSEST:g} apart")


def scene(shapes=("box",), **more):
    given = {"bodies": [SimpleNamespace(shape=shape) for shape in shapes], "water": SimpleNamespace(depth=20.0),
             "damping_lids": (), "modes": (), "wall": None}  # fmt: skip
    return SimpleNamespace(**given | more)


@pytest.mark.parametrize(
    ("method", "made", "says"),
    [
        ("panel", scene(), []),
        ("panel", scene(damping_lids=(1,)), []),
        ("contour", scene(damping_lids=(1,)), ["does not support damping lids"]),
        ("contour", scene(), []),
        ("strip", scene(("box", "box")), ["supports one body only"]),
        ("transfer", scene(), ["is for several bodies"]),
        ("contour", scene(("mesh",)), ["cannot represent a body of shape 'mesh'"]),
        ("contour", scene(water=SimpleNamespace(depth=math.inf)), ["needs a finite water depth"]),
        ("contour", scene(modes=(1,)), ["supports only the six rigid motions, not [[modes]]"]),
        ("panel", scene(modes=(1,)), []),
        ("panel", scene(wall=5.0), []),
        ("strip", scene(wall=5.0), ["does not support a wall"]),
    ],
)
def test_a_method_is_offered_what_it_can_represent(monkeypatch, method, made, says):
    monkeypatch.setattr(methods, "_relative_gap", lambda scene: 1.0)
    one = methods.METHODS[method]
    assert methods._obstacles(made, one) == says


def test_too_much_water_under_the_keel_is_told_with_how_much(monkeypatch):
    one = next(m for m in methods.METHODS.values() if math.isfinite(m.highest_gap))
    for more, told in ((0.99, False), (1.01, True)):
        monkeypatch.setattr(methods, "_relative_gap", lambda scene, more=more: more * one.highest_gap)
        found = methods._obstacles(scene(), one)
        assert bool(found) is told
        assert not told or found == [
            f"allows water under the keel up to {one.highest_gap:g} times the draft or half width, "
            f"and here it is {1.01 * one.highest_gap:.3g} times"
        ]


def test_flags_of_a_system_are_in_newtons_and_radians(monkeypatch):
    from hakobune.pipelines.lines import lines_command, pictures

    asked = []
    monkeypatch.setattr(lines_command, "lines_command", lambda *given, **more: asked.append((given, more)) or 3)
    assert (
        flags.lines(Path("s.toml"), body="b", force="1,-2", offset="5", direction="0,180", broken=True, depth=20.0) == 3
    )
    ((given, more),) = asked
    assert given == (Path("s.toml"), 20.0, None, None, None) and more["force"] == [1e3, -2e3]
    assert more["directions"] == pytest.approx([0, math.pi]) and (more["body"], more["offset"], more["broken"]) == (
        "b",
        "5",
        True,
    )
    flags.lines(Path("s.toml"))
    assert asked[1][1]["force"] is None and asked[1][1]["directions"] == pytest.approx([0, math.pi / 2])
    for text in ("a", "1,,2", "inf"):
        with pytest.raises(ValueError, match=rf"--force is '{text}'; allowed: finite numbers a,b,c"):
            flags.lines(Path("s.toml"), force=text)
    drawn = []
    monkeypatch.setattr(pictures, "draw_result", lambda *given: drawn.append(given) or "done")
    assert flags.lines(Path("s.h5"), plot=Path("p.png")) == 0 and drawn == [(Path("s.h5"), Path("p.png"))]
    for flag in ("body", "force", "offset", "direction", "depth", "characteristic", "database", "output", "moordyn"):
        with pytest.raises(
            ValueError, match=f"--{flag} is for a system of lines and s.HDF5 is a result; allowed with a result: --plot"
        ):
            flags.lines(Path("s.HDF5"), **{flag: "x"})
    with pytest.raises(ValueError, match="--broken is for a system"):
        flags.lines(Path("s.h5"), broken=True)


@pytest.mark.parametrize("whole", [True, False])
def test_ends_of_a_moving_line_use_their_own_breaking_load(monkeypatch, whole):
    """Fairlead 3e5 of 1e6 N, anchor 2e5 of 5e5 N; of a cycle half of the two cycles"""
    end = {"slack": ("s", "slack", lambda of: of.slack), "tension": ("N", "tension", lambda of: of.tension)}
    monkeypatch.setattr(line_dynamics, "END", end)
    found = SimpleNamespace(
        fairlead=SimpleNamespace(slack=4.0, tension=1.0),
        anchor=SimpleNamespace(slack=2.0, tension=3.0),
        cycles=2 if whole else None,
        begin=10.0,
        end=30.0,
    )
    strength = SimpleNamespace(breaking=np.array([5e5, 9e9, 1e6]), weakest=5e5 if whole else np.inf)
    run = SimpleNamespace(found=found, strength=strength, result=SimpleNamespace(
        tension_fairlead=np.array([1e5, 3e5]), tension_anchor=np.array([2e5, 1e5])))  # fmt: skip
    made = line_dynamics._ends(run, "title")
    assert made["slack"].values.tolist() == [4, 2] and made["tension"].values.tolist() == [1, 3]
    assert ("slack.in_cycle" in made) is whole and (not whole or made["slack.in_cycle"].values.tolist() == [2, 1])
    assert made["tension.used"].values == pytest.approx([0.3, 0.4]) and made["tension.used"].share
    assert made["tension.used"].table == ("title" if whole else "") and made["breaking_load"].values.tolist() == [
        1e6,
        5e5,
    ]
    window = {
        name: (made[f"window.{name}"].values.item(), made[f"window.{name}"].unit) for name in ("begin", "end", "cycles")
    }
    assert window == {"begin": (10, "s"), "end": (30, "s"), "cycles": (2 if whole else 0, "")}


@pytest.mark.parametrize(("cycles", "title"), [(4, "work per cycle"), (None, "work in 20 s"), (0, "work in 20 s")])
def test_the_work_of_a_moving_line_is_told_a_cycle_or_in_its_window(monkeypatch, cycles, title):
    monkeypatch.setattr(line_dynamics, "LOSSES", ("drag", "friction"))
    found = SimpleNamespace(
        cycles=cycles,
        begin=10.0,
        end=30.0,
        work=100.0,
        losses={"drag": 60.0, "friction": 20.0},
        stored=8.0,
        of_forces=99.0,
        share_of_work=lambda value: value / 100.0,
        exchanged=7.0,
    )
    made = line_dynamics._work(found)
    values = np.array([100, 60, 20, 8, 99.0])
    assert made["work.energy"].values.tolist() == values.tolist() and made["work.energy"].table == (
        "" if cycles else title
    )
    assert made["work.per_cycle"].values == pytest.approx(values / (cycles or 1))
    assert made["work.per_cycle"].table == (title if cycles else "") and made["work.share"].table == title
    assert made["work.share"].values == pytest.approx(values / 100) and made["work.share"].share
    assert made["work.exchanged"].values == 7.0


def test_the_softest_and_stiffest_of_a_fender_have_curves_of_their_own():
    """Linear fenders of 2 m to 1 m: 10, 8 and 13 kN/m"""

    def linear(k):
        return SimpleNamespace(
            loading=lambda x: k * np.asarray(x),
            own=lambda x: x,
            energy=lambda x: 0.5 * k * np.asarray(x) ** 2,
            returned=lambda x: 0.25 * k * x**2,
            limit=1.0,
            height=2.0,
        )

    def area(x):
        return 2e3 * np.asarray(x) ** 2

    straight = SimpleNamespace(
        loading=type("Curve", (), {"__call__": lambda self, x: 2e4 * np.asarray(x), "integral": staticmethod(area)})()
    )
    fender_of, original = [linear(8e3), linear(13e3)], fender.on_dolphin
    fender.on_dolphin = lambda pair: False
    try:
        made = fender._curve(SimpleNamespace(pair=linear(1e4), bands=fender_of, straight=straight))
        alone = fender._curve(SimpleNamespace(pair=linear(1e4), bands=fender_of, straight=None))
    finally:
        fender.on_dolphin = original
    x = np.linspace(0, 1, 11)
    wanted = {"strain": x / 2, "reaction": 1e4 * x, "energy": 5e3 * x**2, "returned": 2.5e3 * x**2, "softest": 8e3 * x,
              "stiffest": 13e3 * x}  # fmt: skip
    for name, values in wanted.items():
        assert made[f"curve.{name}"].values == pytest.approx(values) and made[f"curve.{name}"].axes == ("deflection",)
    assert [made[f"curve.{n}"].unit for n in wanted] == ["", "N", "J", "J", "N", "N"] and made["curve.strain"].share
    assert made["curve.softest"].description == "reaction of the softest" and made["curve.softest"].table == ""
    assert made["curve.reaction_share"].values[1:] == pytest.approx([0.5] * 10)
    assert made["curve.energy_share"].values[1:] == pytest.approx([2.5] * 10) and "curve.energy_share" not in alone


def body(name, place, fixed=False, heading=0.0):
    return SimpleNamespace(
        name=name, rotation_center=(*place, 1.0), heading=heading, fixed=fixed, own_center=(7.0, 8.0, 9.0)
    )


def test_sides_of_bodies_have_half_their_size_and_the_number_of_those_that_move(monkeypatch):
    boxes = {"a": (100.0, 20.0), "pier": (50.0, 10.0), "b": (60.0, 12.0)}
    monkeypatch.setattr(moor, "box_of", lambda db, one: dict(zip(("length", "beam"), boxes[one.name], strict=True)))
    db = SimpleNamespace(
        bodies=[body("a", (1.0, 2.0)), body("pier", (3.0, 4.0), True), body("b", (5.0, 6.0), heading=0.5)]
    )
    made = moor.sides_of(db)
    assert [one.name for one in made] == ["a", "pier", "b"] and [one.moves for one in made] == [0, -1, 1]
    assert [one.half.tolist() for one in made] == [[50, 10], [25, 5], [30, 6]]
    assert [one.place.tolist() for one in made] == [[1, 2, 0], [3, 4, 0], [5, 6, 0.5]]
    assert moor.sides_of(SimpleNamespace(bodies=())) == ()


class Hull:
    def __init__(self, by):
        self.by = by

    def in_scene(self, point):
        return np.add(point, self.by)


@pytest.mark.parametrize(
    ("to", "bollard", "says"),
    [
        (None, None, None),
        ("b", (1.0, 1.0, 1.0), None),
        ("b", None, "lines[0].bollard is missing; give x, y, z on b, m, where the"),
        ("a", (1.0, 1.0, 1.0), "lines[0].to is 'a'; allowed: the name of another body, b"),
        ("c", (1.0, 1.0, 1.0), "lines[0].to is 'c'; allowed: the name of another"),
    ],
)
def test_a_line_from_body_to_body_has_both_ends_in_space(monkeypatch, to, bollard, says):
    monkeypatch.setattr(moor.msgspec.structs, "replace", lambda line, **changed: changed)
    bodies = {"a": Hull((10.0, 0.0, 0.0)), "b": Hull((0.0, 20.0, 0.0))}
    line = SimpleNamespace(body="a", to=to, fairlead=(1.0, 2.0, 3.0), bollard=bollard)
    if says:
        with pytest.raises(StudyError) as error:
            moor._in_space("lines[0]", line, bodies["a"], bodies)
        assert str(error.value).startswith(says)
        return
    made = moor._in_space("lines[0]", line, bodies["a"], bodies)
    assert made == {"fairlead": (11, 2, 3)} | ({"bollard": (1, 21, 1)} if to else {})
    assert moor._in_space("lines[0]", line, None, bodies) is line


@pytest.mark.parametrize(("count", "factor", "times"), [(1, 1.0, 1.0), (3, 1.0, 3.0), (2, 1.5, 3.0)])
def test_fenders_side_by_side_are_named_by_their_number_and_push_as_many_times(count, factor, times):
    from hakobune.pipelines.common import fender_tables

    made = fender_tables.fender_of(fender_tables.FenderTable(family="cell", height=2.0, count=count, factor=factor))
    one = fender_tables.fender_of(fender_tables.FenderTable(family="cell", height=2.0))
    assert made.rated_reaction == pytest.approx(times * one.rated_reaction)
    assert made.name == (f"{count} × {one.name}" if count > 1 else one.name)


def test_numbers_that_are_not_known_are_told_of_their_motion_and_frequency(monkeypatch):
    """Two motions of three frequencies: of surge the second is unknown in one of its columns, of heave none"""
    from hakobune.pipelines.common import gaps

    values = np.zeros((3, 2, 2))
    values[1, 1, 0] = np.nan
    monkeypatch.setattr(
        gaps, "QUANTITIES", {"a": (("omega", "influenced_dof", "radiating_dof"),), "b": (("omega", "theta"),)}
    )

    class Stored(dict):
        names, path, asked, rows = ("a", "b"), "b.h5", None, np.array([True])

    db = Stored(a=values, b=np.array([[1.0, np.inf], [1.0, 2.0], [np.nan, 2.0]]), radiating_dof=["Surge", "Heave"])
    assert {name: one.tolist() for name, one in gaps._unknown(db, "a").items()} == {"Surge": [1]}
    assert {name: one.tolist() for name, one in gaps._unknown(db, "b").items()} == {"": [0, 2]}
    values[2, 0, 1] = np.inf
    assert {name: one.tolist() for name, one in gaps._unknown(db, "a").items()} == {"Surge": [1], "Heave": [2]}
    assert gaps._unknown(Stored(a=np.zeros((3, 2, 2))), "a") == {}


def test_water_may_be_deeper_than_the_deepest_trench_by_a_tenth_but_not_more():
    """10 935 m of the Challenger Deep and 12 000 m"""
    for depth in (1e-3, 10_935.0, 12_000.0):
        assert water_depth("depth", depth) == depth
    for depth in (0.0, 12_001.0, math.nan):
        with pytest.raises(StudyError, match=r"depth is .*; allowed: above 0, at most 12000, the deepest sea"):
            water_depth("depth", depth)


class Row(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    length: float


class Rows(msgspec.Struct, forbid_unknown_fields=True):
    row: Row
    row_too: Row = Row(1.0)
    other: Row | None = None
    rows: list[Row] | None = None


@pytest.mark.parametrize(("more", "said"), [
    ({"other": [{"width": 1.0}]}, ""), ({"other": [1.0]}, ""), ({"row_too": [1.0]}, ""),
    ({"rows": [{"length": 1.0}, {"width": 2.0}]}, "; also unknown: rows[1].width"),
])  # fmt: skip
def test_a_list_in_place_of_a_table_is_no_further_unknown_key(more, said):
    """The unknown key is told, and those of lists where lists belong"""
    with pytest.raises(
        StudyError, match=re.escape("row.lenght is unknown, length may be meant; allowed: length")
    ) as no:
        typed({"row": {"length": 1.0, "lenght": 2.0}, **more}, Rows, StudyError)
    assert str(no.value).endswith(f"(hakobune keys explains them){said}")


def test_a_misprint_in_tables_that_may_be_left_out_is_named():
    with pytest.raises(StudyError, match=r"rows\[1\]\.lenght is unknown, length may be meant; allowed: length"):
        typed({"row": {"length": 1.0}, "rows": [{"length": 1.0}, {"length": 2.0, "lenght": 2.0}]}, Rows, StudyError)
    with pytest.raises(StudyError, match=r"^other\.lenght is unknown, length may be meant; allowed: length"):
        typed({"row": {"length": 1.0}, "other": {"lenght": 2.0}, "rows": None}, Rows, StudyError)
