"""Which flags, hulls and numbers `hakobune import` takes, each on both sides of its limit."""

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.schema import DOFS
from hakobune.bem.formats.afloat import Weight
from hakobune.bem.formats.values import FormatError
from hakobune.bem.kernels.progress import OWN
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.panels.band import cost
from hakobune.bem.stored_laws import OF_MOTIONS
from hakobune.meshing.shapes import box
from hakobune.pipelines.cli import main
from hakobune.pipelines.exchange import importing
from hakobune.pipelines.solve import checking

IMPORTED = {"imported": "wamit: a.1"}
SILENT = ("water_depth", "density", "gravity", "length_unit")
KNOWN = {"water_depth": 20.0, "density": 1025.0, "gravity": 9.8, "length_unit": None}


def check(folder, silent=SILENT, name="out.h5", fresh=False, place="in.1", **known):
    return importing.check_import(SimpleNamespace(silent=silent), KNOWN | known, folder / name, fresh, folder / place)


@pytest.mark.parametrize("known, says", [
    ({}, None), ({"water_depth": None}, None), ({"water_depth": 0.0}, "water_depth is 0; allowed"),
    ({"water_depth": np.inf}, None), ({"density": 0.0}, "density is 0; allowed"),
    ({"gravity": -9.8}, "gravity is -9.8"),
    ({"length_unit": 1e-3}, None), ({"length_unit": 0.0}, "--length-unit is 0 m; allowed: above 0"),
    ({"length_unit": np.inf}, "--length-unit is inf m"), ({"length_unit": -1.0}, "--length-unit is -1 m"),
])  # fmt: skip
def test_what_files_do_not_say_is_to_be_given(tmp_path, known, says):
    if says is None:
        check(tmp_path, **known)
        return
    with pytest.raises(ValueError, match=re.escape(says)):
        check(tmp_path, **known)


def test_what_files_say_is_not_asked_and_their_unit_not_given(tmp_path):
    check(tmp_path, silent=(), water_depth=None, density=0.0)
    with pytest.raises(
        ValueError, match="--length-unit is given, but these files define their units; it is for --from wamit only"
    ):
        check(tmp_path, silent=(), length_unit=1.0)


def test_a_file_that_is_there_is_replaced_by_fresh_alone_and_never_the_source(tmp_path):
    (tmp_path / "out.h5").write_text("")
    check(tmp_path, fresh=True)
    with pytest.raises(
        ValueError,
        match=r"out.h5 exists already; give --fresh to replace it, or another name "
        r"by --output",
    ):
        check(tmp_path)
    with pytest.raises(ValueError, match="exists already"):
        check(tmp_path, fresh=True, place="out.h5")


def values(sway=1.0, inertia=None):
    added = np.zeros((2, 6, 6))
    added[1] = np.diag([1, sway, 1, 1, 1, 1])
    held = {"added_mass": added, "inertia_matrix": inertia}
    return SimpleNamespace(get=held.__getitem__, others=0, left_out=())


def test_motions_without_added_mass_and_missing_inertia_are_told():
    assert list(importing._remarks(Path("a.1"), (), values(inertia=np.eye(6)))) == []
    (said,) = importing._remarks(Path("a.1"), (), values(0.0, np.eye(6)))
    assert said == f"the files do not contain {DOFS[1]}: its added mass is stored as 0"
    (said,) = importing._remarks(Path("a.1"), (), values())
    assert said.startswith(
        "the database has no inertia_matrix, so that no motions can be computed; give it by `hakobune body` "
        "with --gyration"
    )
    told = list(importing._remarks(Path("a.1"), ("ULEN 1 m of a.gdf", "ULEN 2 m of a.gdf"), values(inertia=np.eye(6))))
    assert told == ["ULEN 2 m of a.gdf is taken"]
    assert importing._sizes(values(-3.0)) == pytest.approx([1, 3, 1, 1, 1, 1])


def test_frequencies_with_a_number_that_is_not_finite_are_left_out_everywhere():
    from dataclasses import dataclass

    @dataclass
    class Values:
        omega: np.ndarray
        quantities: dict

    a, b = np.arange(6.0).reshape(3, 2), np.arange(3.0)
    made = Values(np.array([0.1, 0.2, 0.3]), {"a": a, "b": b})
    assert importing._finite(made) == (made, {})
    a[1, 1], b[2] = np.nan, np.inf
    kept, left = importing._finite(made)
    assert list(kept.omega) == [0.1] and left == {"a": "0.2", "b": "0.3"}
    assert kept.quantities["a"].tolist() == [[0, 1]] and kept.quantities["b"].tolist() == [0]
    a[0, 0] = np.inf
    with pytest.raises(FormatError, match="every frequency has numbers that are not finite, in a, b"):
        importing._finite(made)


@pytest.mark.parametrize("several", [False, True])
def test_flags_arrive_as_what_they_are(several, monkeypatch):
    """Mass, centre of gravity, radii, point and unit each in its place; of several bodies one after another"""
    asked = []
    monkeypatch.setattr(importing, "import_", lambda *given: asked.append(given) or 0)
    monkeypatch.setattr("hakobune.pipelines.exchange.several.import_several", lambda *given: asked.append(given) or 0)
    words = "--depth 20 --density 1010 --gravity 9.7 --length-unit 2 --frequencies 0.2:1.5 --fresh --output o.h5"
    known = {"water_depth": 20.0, "density": 1010.0, "gravity": 9.7, "length_unit": 2.0, "frequencies": (0.2, 1.5)}
    if several:
        words += " --bodies a,b --gyration 1,2,3;4,5,6 --center-of-gravity -7,8,9;0,1,2 --mesh a.gdf,b.gdf --uncoupled"
        rest = (
            "wamit",
            ["a", "b"],
            [Path("a.gdf"), Path("b.gdf")],
            known | {"rotation_center": None, "body": None},
            [Weight(None, (-7, 8, 9), (1, 2, 3)), Weight(None, (0, 1, 2), (4, 5, 6))],
            Path("o.h5"),
            True,
            True,
        )
    else:
        words += " --mass 5e3 --gyration 1,2,3 --center-of-gravity -4,5,6 --about 7,8,9 --body 2 --mesh a.gdf --correct"
        rest = (
            "wamit",
            Path("a.gdf"),
            known | {"rotation_center": (7, 8, 9), "body": 2},
            Weight(5e3, (-4, 5, 6), (1, 2, 3)),
            Path("o.h5"),
            True,
            True,
        )
    assert main(["import", "x.1", "--from", "wamit", *words.split()]) == 0
    assert asked == [(Path("x.1"), *rest)]


def test_a_weight_arrives_as_what_it_is(monkeypatch):
    asked = []
    monkeypatch.setattr("hakobune.pipelines.exchange.weighing.weigh", lambda *given: asked.append(given) or 0)
    words = "--mass 5e3 --gyration 1,2,3 --center-of-gravity -4,5,6 --frequencies :2 --output o.h5"
    assert main(["body", "x.h5", *words.split()]) == 0
    assert asked == [(Path("x.h5"), Weight(5e3, (-4, 5, 6), (1, 2, 3)), (0.0, 2.0), Path("o.h5"))]


@pytest.mark.parametrize(
    ("attributes", "law", "way"),
    [
        ({}, "reciprocity", "solve it again with --fresh"),
        (IMPORTED, "reciprocity", "leave out such frequencies by 'hakobune body a.h5 --frequencies FROM:TO'"),
        (IMPORTED, OF_MOTIONS, "'hakobune body a.h5 --gyration KXX,KYY,KZZ' computes the motions of its mass"),
    ],
)
def test_numbers_of_others_that_break_a_law_have_their_own_way_out(attributes, law, way, monkeypatch):
    monkeypatch.setattr(checking, "broken_laws", lambda db, tolerance: [(law, 0.2, 2.8, 0.01)])
    db = SimpleNamespace(omega=[2.8], names=(), attributes=attributes, path=Path("runs/a.h5"))
    (found,) = checking._broken(db)
    assert found.text == (f"stored numbers: {law} is broken by 0.2 at ω = 2.8 rad/s; allowed: 0.01; {way}")


def test_a_hull_that_cannot_be_read_beside_results_may_be_given_otherwise(tmp_path):
    beside = tmp_path / "a.gdf"
    beside.write_text("h\n1 9.81\n0 0\n6 -11\n")
    module = SimpleNamespace(hull_of=lambda place, known: beside)
    with pytest.raises(
        ValueError, match=r"higher-order file of kind -11; .*; or give another mesh of this hull by --mesh$"
    ):
        importing.hull_of(tmp_path / "a.1", None, module, None, {})
    with pytest.raises(ValueError, match=r"or B-splines \(IGDEF 1\)$"):
        importing.hull_of(tmp_path / "a.1", None, module, beside, {})
    beside.unlink()
    with pytest.raises(ValueError, match=r"does not exist\), where FILE is a file of panels, or a .toml"):
        importing.hull_of(tmp_path / "a.1", None, module, None, {})


@pytest.mark.parametrize(("seconds", "least", "told"), [(42.0, 100, True), (9.9, 100, False), (42.0, 10_000, False)])
def test_a_long_solution_to_compare_with_is_told_with_its_time(seconds, least, told, monkeypatch, capsys):
    """Above ten seconds, and where there are nodes enough that asking is worth it"""
    hull = box(100, 50, 10, panels=500)
    prepared = PanelProblem(hull, depth=20.0).prepared()
    monkeypatch.setattr(cost, "seconds_alone", lambda *_: seconds)
    monkeypatch.setattr(importing, "NODES_WORTH_ASKING", least)
    importing._told_of_own(OWN, (prepared, 0.5))
    importing._told_of_own("waves", 7)
    wanted = f"own solution of {hull.total} panels, 4 nodes on each at 0.5 rad/s, to compare with: about 42 s"
    said = capsys.readouterr().err
    assert wanted in said if told else not said
