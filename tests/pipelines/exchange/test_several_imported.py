"""All bodies of a set of WAMIT in one database: couplings, points, weights and the turns of round ones, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.formats.values import Values
from hakobune.meshing.files import write_mesh
from hakobune.meshing.shapes import box
from hakobune.pipelines.cli import main
from hakobune.pipelines.exchange.several import AROUND, _all_around, _round, _together

POT = """two
0.
1 1
-1
5.
1
0.
2
a.gdf
0. 0. -1. 0.
1 1 1 1 1 1
b.gdf
9. 0. -2. 0.
1 1 1 1 1 1
"""


@pytest.fixture
def place(tmp_path):
    """NAME.1 of two boxes, whose heaves are coupled; hulls are in the axes of each, at XBODY"""
    hulls = box(4.0, 4.0, 2.0, panels=60).whole(), box(6.0, 4.0, 3.0, panels=60).whole()
    for name, hull, up in zip("ab", hulls, (1.0, 2.0), strict=True):
        write_mesh(hull.moved(dz=up), tmp_path / f"{name}.gdf")
    head, ulen, planes, count, *rest = (tmp_path / "a.gdf").read_text().splitlines()
    lid = ["-2 -2 1", "2 -2 1", "2 2 1", "-2 2 1"]  # against irregular frequencies: no part of the hull
    (tmp_path / "a.gdf").write_text("\n".join([head, ulen, planes, str(int(count.split()[0]) + 1), *rest, *lid]))
    diagonal = "".join(f" 5.0 {i} {i} 2.0 0.1\n" for i in range(1, 13))
    (tmp_path / "two.1").write_text(diagonal + " 5.0 3 9 0.5 0.02\n 5.0 9 3 0.5 0.02\n")
    (tmp_path / "two.3").write_text("".join(f" 5.0 0.0 {i} 1.0 0.0 {i}.0 0.0\n" for i in range(1, 13)))
    (tmp_path / "two.pot").write_text(POT)
    return tmp_path / "two.1"


def imported(place, *more):
    words = ["import", str(place), "--from", "wamit", "--density", "1000", "--gravity", "10", *more]
    return main([*words, "--output", str(place.with_suffix(".h5"))])


def test_each_body_of_a_set_is_held_to_its_laws(place, capsys):
    weight = "--bodies", "a,b", "--gyration", "1,1,1;2,2,2", "--center-of-gravity", "0,0,0;9,0,0"
    assert imported(place, *weight) == 0
    assert (
        "b: the files are not compared with our own solution: there are other bodies beside it"
        in capsys.readouterr().err.replace("\n", " ")
    )
    one_way = " 5.0 7 11 1.5 0.0\n 5.0 11 7 -1.5 0.0\n"
    place.write_text(place.read_text() + one_way)
    assert imported(place, *weight, "--fresh") == 1
    said = " ".join(capsys.readouterr().err.split())
    assert "FAILS: b: reciprocity: A_15 and A_51" in said and "FAILS: a:" not in said


def test_bodies_of_a_set_move_together(place):
    assert imported(place, "--bodies", "a,b", "--gyration", "1,1,1;2,2,2", "--center-of-gravity", "0,0,0;9,0,0") == 0
    db = open_database(place.with_suffix(".h5"))
    w = 2 * np.pi / 5
    assert [body.name for body in db.bodies] == ["a", "b"] and db.bodies[1].rotation_center == (9.0, 0.0, -2.0)
    assert db["added_mass"][0, 2, [2, 8]] == pytest.approx([2000.0, 500.0])
    assert db["radiation_damping"][0, 8, 2] == pytest.approx(20 * w)
    assert db["excitation_force"][0, 0] == pytest.approx(1e4 * np.arange(1.0, 13))
    assert db["wave_direction"][:].tolist() == [0.0]  # boxes are not round
    assert db["mass"][:] == pytest.approx([32e3, 72e3])
    apart = "--gyration", "1,1,1;2,2,2", "--center-of-gravity", "0,0,0;9,0,0", "--uncoupled", "--fresh"
    assert imported(place, "--bodies", "a,b", *apart) == 0
    alone = open_database(place.with_suffix(".h5"))["added_mass"][0]
    assert alone[2, [2, 8]] == pytest.approx([2000.0, 0.0]) and alone[8, [2, 8]] == pytest.approx([0.0, 2000.0])
    assert np.diag(db["inertia_matrix"])[[3, 9]] == pytest.approx([32e3 * (1 + 1), 72e3 * (4 + 4)])  # about XBODY
    assert db["hydrostatic_stiffness"][2, 2] == pytest.approx(1e4 * 16)
    assert db["hydrostatic_stiffness"][8, 8] == pytest.approx(1e4 * 24) and not db["hydrostatic_stiffness"][2, 8]


@pytest.mark.parametrize(
    ("more", "line"),
    [
        (("--bodies", "a"), "has 2 bodies, and --bodies names 1; name all of them"),
        (("--bodies", "a,a"), "give each body a different name"),
        (("--bodies", "a,b", "--gyration", "1,1,1"), "three numbers for each of a, b, separated by ;"),
        (("--uncoupled",), "--uncoupled is given without --bodies"),
        (
            ("--bodies", "a,b", "--body", "1"),
            "several bodies are read exactly as the files describe them; leave these flags out",
        ),
    ],
)
def test_faults_are_one_line(place, more, line, capsys):
    assert imported(place, *more) == 2
    assert line in " ".join(capsys.readouterr().err.split())


def test_round_bodies_have_the_forces_of_one_heading_at_all_others():
    """Surge and pitch of waves along x become sway and −roll of waves along y; heave stays"""
    X = np.array([[[3.0, 0, 2.0, 0, 5.0, 0, 7.0, 0, 1.0, 0, 4.0, 0]]])
    given = {"excitation_force": X, "added_mass": np.zeros((1, 12, 12))}
    found = _all_around(Values(np.ones(1), np.zeros(1), np.inf, 1000.0, 9.8, given)).quantities["excitation_force"]
    assert found.shape == (1, len(AROUND), 12) and found[0, 0] == pytest.approx(X[0, 0])
    assert found[0, 3] == pytest.approx([0, 3, 2, -5, 0, 0, 0, 7, 1, -4, 0, 0], abs=1e-12)
    hull = SimpleNamespace(is_round=True, points=np.zeros((4, 3)))
    beside = SimpleNamespace(is_round=True, points=np.ones((4, 3)))
    assert _round([hull, hull]) and not _round([hull, beside])


def test_values_of_bodies_are_joined_one_after_another_and_what_one_lacks_is_left_out():
    """Forces side by side, inertia and stiffness in blocks, masses and centres as rows; the radiation is that of all"""
    rng = np.random.default_rng(3)
    each = [rng.normal(size=(2, 3, 6)) for _ in range(4)]
    inertia = [np.diag(np.arange(1.0, 7.0)), np.full((6, 6), 2.0)]
    parts = []
    for i in range(2):
        forces = {"excitation_force": each[i], "diffraction_force": each[2 + i]}
        body = {"mass": 10.0 + i, "center_of_mass": np.array([i, 0.0, 1.0]), "inertia_matrix": inertia[i]}
        parts.append(Values(np.ones(2), np.zeros(3), 20.0, 1000.0, 9.8, forces, body))
    parts[1].quantities.pop("diffraction_force")
    radiation = {"added_mass": np.full((2, 12, 12), 7.0)}
    made = _together(parts, radiation)
    assert (
        set(made.quantities) == {"added_mass", "excitation_force"}
        and made.quantities["added_mass"] is radiation["added_mass"]
    )
    assert np.array_equal(made.quantities["excitation_force"], np.concatenate(each[:2], axis=-1))
    assert made.body["mass"].tolist() == [10.0, 11.0] and made.body["center_of_mass"].tolist() == [[0, 0, 1], [1, 0, 1]]
    whole = made.body["inertia_matrix"]
    assert np.array_equal(whole[:6, :6], inertia[0]) and np.array_equal(whole[6:, 6:], inertia[1])
    assert not whole[:6, 6:].any() and not whole[6:, :6].any()
    parts[0].body.pop("mass")
    assert "mass" not in _together(parts, radiation).body
