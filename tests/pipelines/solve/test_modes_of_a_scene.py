"""A scene of a body that bends, from its tables to its database and what studies take from it."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import DatabaseError, open_database
from hakobune.bem.flexible.beams import Beam
from hakobune.bem.formats.values import values_of
from hakobune.bem.motions import response as motions
from hakobune.bem.stored_laws import broken_laws
from hakobune.meshing.shapes import box
from hakobune.mooring.response.points import Point, Station, transfer_functions
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.bending import modes as bending
from hakobune.pipelines.solve.bending.modes import _rigid
from hakobune.pipelines.solve.run import solve
from hakobune.pipelines.view.deflection import axis_rise, deflections

RHO, G = 1025.0, 9.80665
HULL = {"shape": "box", "length": 24.0, "beam": 6.0, "draft": 1.2, "gyration": [1.9, 7.0, 7.2],
        "center_of_gravity": [0.0, 0.0, 0.3]}  # fmt: skip
BENDING = {"kind": "vertical bending", "count": 2, "EI": 4e7, "damping": 0.02, "axis_height": -0.2}
TORSION = {"kind": "torsion", "count": 1, "GJ": 5e7}


def tables(*modes, body=HULL, **more):
    waves = {"omegas": [1.0, 1.6], "headings_deg": [0.0, 50.0]}
    given = {"water": {"depth": 9.0}, "bodies": [body], "waves": waves, "panels": 120}
    return given | ({"modes": list(modes)} if modes else {}) | more


@pytest.fixture(scope="module")
def barge(tmp_path_factory):
    path = tmp_path_factory.mktemp("bends") / "barge.h5"
    assert solve(make_scene(tables(BENDING, TORSION)), path).exit_status == 0
    return path


def test_shapes_are_motions_like_the_six(barge):
    db = open_database(barge)
    names = ["vertical_bending_1", "vertical_bending_2", "torsion_1"]
    assert list(db["radiating_dof"][6:]) == names == list(db["influenced_dof"][6:])
    assert db["added_mass"].shape == (2, 9, 9) and db["rao"].shape == (2, 2, 9)
    assert db.mesh.symmetry == "xy"  # every shape is even or odd in both
    assert not broken_laws(db, 0.02)  # reciprocity, energy of all waves, motions by their equation, drift
    assert max(db.checks()["Haskind"]) < 0.02
    assert db.bodies_reader.words[6:] == ("vertical bending 1", "vertical bending 2", "torsion 1")


def test_structure_by_hand(barge):
    """mL/4, EI β⁴L/4 and 2ζ√(km) of bending, GJ (π/L)² L/2 of torsion; ρgBL/4 of the waterplane, pressure, weight"""
    db, mass, beta = open_database(barge), RHO * 6 * 1.2, 4.730041 / 24
    K, M, D = db.structural_stiffness, db.inertia_matrix, db.structural_damping
    assert K[6, 6] == pytest.approx(4e7 * beta**4 * 6, rel=1e-5)
    assert K[8, 8] == pytest.approx(5e7 * (np.pi / 24) ** 2 * 12)
    turned = 12.370 / 24  # ∫ (w′)² dx of the first shape
    line = 0.5**2 * mass * turned  # about an axis 0.5 m off
    assert M[6, 6] == pytest.approx(mass * 6 + line, rel=1e-3)
    assert D[6, 6] == pytest.approx(2 * 0.02 * np.sqrt(K[6, 6] * mass * 6), rel=1e-5)
    C = db.hydrostatic_stiffness
    end = 4 * db.modes[0].shape.along(12.0, 1)
    by_hand = RHO * G * 6 * 24 / 4 + mass * G * (-0.4 * (end - turned) - 0.5 * turned)  # z_B − z₀, z_G − z₀
    assert C[6, 6] == pytest.approx(by_hand, rel=1e-3) and np.abs(C - C.T).max() < 1e-6 * C[4, 4]
    assert C[2, 2] == pytest.approx(RHO * G * 144)


def test_a_turn_leaves_its_centre_and_moves_the_rest_by_the_right_hand():
    """Pitch about (1, 0, −2): 3 m ahead sink by 3 m per radian, 2 m up go ahead by 2 m"""
    points = np.array([[1.0, 5.0, -2.0], [4.0, 0.0, -2.0], [1.0, 0.0, 0.0]])
    assert _rigid(4, np.array([1.0, 0.0, -2.0]))(points).tolist() == [[0, 0, 0], [0, 0, -3], [2, 0, 0]]
    assert _rigid(1, np.zeros(3))(points).tolist() == [[0, 1, 0]] * 3


def test_a_body_that_cannot_bend_is_rigid(barge, tmp_path):
    """The same flow with another rigidity needs no solving, and its motions are those of the six alone"""
    path = tmp_path / "stiff.h5"
    path.write_bytes(barge.read_bytes())
    stiff = tables({**BENDING, "EI": 1e18}, {**TORSION, "GJ": 1e18})
    outcome = solve(make_scene(stiff), path)
    assert "computed again, from the stored" in " ".join(outcome.remarks)
    db, six = open_database(path), slice(0, 6)
    A, B, F = db["added_mass"], db["radiation_damping"], db["excitation_force"]
    for i, omega in enumerate(db.omega):
        rigid = motions(omega, A[i, six, six], B[i, six, six], F[i, :, six], db.inertia_matrix[six, six],
                        db.hydrostatic_stiffness[six, six])  # fmt: skip
        assert np.abs(db["rao"][i, :, six] - rigid).max() < 1e-6 * np.abs(rigid).max()


def test_a_shape_from_a_file_is_that_of_the_beam(barge, tmp_path):
    beam = Beam("vertical bending", 1, -12.0, 12.0, -0.2, 1.0, 1.0)
    x, y, z = (a.ravel() for a in np.meshgrid(np.linspace(-12, 12, 33), [-3, 0, 3], [-1.2, 0.3], indexing="ij"))
    points = np.stack([x, y, z], axis=1)
    mass = np.full((len(x), 1), RHO * 24 * 6 * 1.2 / len(x))
    rows = np.hstack([points, beam.displacement(points), mass])
    np.savetxt(tmp_path / "mode.csv", rows, delimiter=",", header="x,y,z,ux,uy,uz,mass")
    file = {"kind": "file", "name": "first", "file": str(tmp_path / "mode.csv"), "stiffness": 7e5}
    outcome = solve(make_scene(tables(file)), tmp_path / "file.h5")
    (said,) = re.findall(r"first: its shape on the hull is uncertain by ([\d.]+) %", " ".join(outcome.remarks))
    db, known = open_database(tmp_path / "file.h5"), open_database(barge)
    assert db["added_mass"][0, 6, 6] == pytest.approx(known["added_mass"][0, 6, 6], rel=5e-3)
    assert db["added_mass"][0, 2, 6] == pytest.approx(known["added_mass"][0, 2, 6], rel=1e-2)
    shape, hull = db.modes[0].shape, db.mesh.whole().centroids
    assert shape.displacement(points) == pytest.approx(beam.displacement(points), abs=1e-12)
    off = np.linalg.norm(shape.displacement(hull) - beam.displacement(hull), axis=1).max()
    assert off < float(said) / 100 < 10 * off
    (tmp_path / "mode.csv").write_text("\n".join(" ".join(map(str, row)) for row in rows * [1, 1, 1, 2, 2, 2, 1]))
    with pytest.raises(SceneError, match="file has changed"):
        solve(make_scene(tables(file)), tmp_path / "file.h5")


def test_deflection_and_moment_at_stations_by_hand(barge):
    db = open_database(barge)
    body, X = db.bodies_reader.floating(), db["rao"]
    places = Station("mid", 0.0), Point("bow", (12.0, 0.0, -0.2))
    found = transfer_functions(body, db.omega, db.wave_direction, places, water=False)
    at = {name: found.value[..., i] for i, name in enumerate(found.names)}
    first, second = (mode.shape for mode in db.modes[:2])
    moment = X[..., 6] * 4e7 * first.along(0.0, 2) + X[..., 7] * 4e7 * second.along(0.0, 2)
    assert at["mid vertical bending moment"] == pytest.approx(moment)
    assert at["mid torsional moment"] == pytest.approx(X[..., 8] * 5e7 * np.pi / 24, rel=1e-9)
    bow = X[..., 2] - 12 * X[..., 4] + X[..., 6] + X[..., 7]  # shapes move the forward end by 1
    assert at["bow displacement z"] == pytest.approx(bow)
    assert axis_rise(db, 0, np.array([12.0]))[..., 0] == pytest.approx(bow)


def test_a_picture_shows_every_beam(barge, tmp_path):
    assert len(deflections(open_database(barge), tmp_path / "bending.png").axes) == 1


def test_two_bodies_of_which_the_turned_one_bends(tmp_path):
    """Turned by 90° about z the far body's own numbers stay what they are alone to what the other one scatters"""
    other = {"name": "pier", "shape": "box", "length": 4.0, "beam": 4.0, "draft": 1.0, "place": [0, 60, 0],
             "fixed": True}  # fmt: skip
    given = tables({**BENDING, "body": "barge"})
    given["bodies"] = [{**HULL, "name": "barge", "place": [5, 0, 90]}, other]
    given["waves"], given["panels"] = {"omegas": [1.1]}, 200
    assert solve(make_scene(given), tmp_path / "two.h5").exit_status == 0
    db = open_database(tmp_path / "two.h5")
    assert list(db["radiating_dof"][6:]) == ["barge__vertical_bending_1", "barge__vertical_bending_2"]
    assert db["added_mass"].shape == (1, 14, 8) and db["body_drift_force"].shape == (1, 1, 2, 3)
    assert not broken_laws(db, 0.03)
    assert abs(axis_rise(db, 0, np.zeros(1))).max() > 0


def test_studies_of_rigid_bodies_say_so(barge):
    db = open_database(barge)
    for of_six in (lambda: db.reader, lambda: values_of(db), lambda: values_of(db, several=True)):
        with pytest.raises(DatabaseError, match=r"3 motions beyond the six.*without \[\[modes\]\]"):
            of_six()


@pytest.mark.parametrize(
    "modes, more, said",
    [
        ([BENDING], {"method": "contour", "panels": None}, "six rigid motions,"),
        ([BENDING], {"wall": 30.0}, "modes and a wall are given"),
        ([{**BENDING, "kind": "hinge"}], {}, "kind is 'hinge'; allowed: vertical bending"),
        ([{**BENDING, "GJ": 1.0}], {}, "GJ is 1.0; vertical bending has EI"),
        ([{"kind": "torsion"}], {}, "GJ is missing"),
        ([{**BENDING, "EI": -1.0}], {}, "EI is -1; allowed: above 0"),
        ([{**BENDING, "damping": 1.0}], {}, "damping is 1; allowed: 0 to below 1"),
        ([{**BENDING, "damping": -0.1}], {}, "damping is -0.1; allowed: 0 to below 1"),
        ([{**BENDING, "axis_height": math.inf}], {}, "axis_height is inf; allowed: finite"),
        ([{**BENDING, "count": 41}], {}, "count is 41; allowed: 1 to 40"),
        ([{**BENDING, "count": 0}], {}, "count is 0; allowed: 1 to 40"),
        ([{**BENDING, "length": math.inf}], {}, "length is inf; allowed: above 0, finite"),
        ([{"kind": "file", "name": "a__b", "file": "no.csv", "stiffness": 0.0}], {}, "name is 'a__b'; allowed: a word"),
        ([{"kind": "file", "name": "one", "file": "no.csv", "stiffness": -1.0}], {}, "stiffness is -1; allowed"),
        ([BENDING, BENDING], {}, "'vertical_bending_1' twice"),
        ([{**BENDING, "body": "tug"}], {}, "there is one body"),
        ([{"kind": "file", "name": "Heave", "file": "no.csv", "stiffness": 1.0}], {}, "that is not a rigid motion"),
        ([{"kind": "file", "name": "one", "file": "no.csv", "stiffness": 1.0}], {}, "there is no such file"),
    ],
)
def test_what_modes_may_not_say(modes, more, said):
    with pytest.raises(SceneError, match=said.replace("[", r"\[")):
        make_scene({k: v for k, v in tables(*modes, **more).items() if v is not None})


def test_a_shape_that_strains_nothing_is_named(tmp_path):
    points = np.random.default_rng(1).uniform(-10, 10, (20, 3))
    rows = np.hstack([points, np.cross([0.0, 1.0, 0.0], points)])
    np.savetxt(tmp_path / "pitch.txt", rows)
    file = {"kind": "file", "name": "turn", "file": str(tmp_path / "pitch.txt"), "stiffness": 0.0, "mass": 1.0}
    with pytest.raises(SceneError, match="turn does not deform the body"):
        solve(make_scene(tables(file)), tmp_path / "x.h5")


SAGS = [{**HULL, "name": "fore", "place": [14.0, 0.0, 0.0]}, {**HULL, "name": "aft", "place": [-14.0, 1.0, 180.0]}]


def rows_of(shape, masses=None):
    """A file's rows: points on and above both hulls, in coordinates of the scene"""
    x, y, z = (a.ravel() for a in np.meshgrid(np.linspace(-26, 26, 52), [-4, 0, 4], [-1.2, 0.3], indexing="ij"))
    points = np.stack([x, y, z], axis=1)
    rows = np.hstack([points, shape(points)])
    return rows if masses is None else np.hstack([rows, np.full((len(x), 1), masses / len(x))])


def sag(points):
    """Both ends of 52 m up, the middle down"""
    x = points[:, 0]
    return np.stack([0 * x, 0 * x, x**2 / 600 - 0.4], axis=1)


def test_a_shape_of_two_bodies_is_the_sum_of_what_each_does(tmp_path):
    np.savetxt(tmp_path / "sag.csv", rows_of(sag, 2 * RHO * 24 * 6 * 1.2), delimiter=",")
    whole = {"kind": "file", "name": "sag", "file": str(tmp_path / "sag.csv"), "stiffness": 1e6}
    given = tables(whole, bodies=SAGS, waves={"omegas": [1.6], "headings_deg": [20.0]}, panels=160)
    assert solve(make_scene(given), tmp_path / "both.h5").exit_status == 0
    db = open_database(tmp_path / "both.h5")
    assert list(db["radiating_dof"][12:]) == ["sag"] and db["added_mass"].shape == (1, 13, 13)
    A, M, C = db["added_mass"][0], db.inertia_matrix, db.hydrostatic_stiffness
    assert A[12, :12] == pytest.approx(A[:12, 12], abs=0.02 * np.abs(A[12, 12]))
    assert max(db.checks()["Haskind"]) < 0.02 and max(db.checks()["energy"]) < 0.02
    mean = np.mean((np.linspace(-26, 26, 52)) ** 2 / 600 - 0.4)
    assert M[2, 12] + M[8, 12] == pytest.approx(2 * RHO * 24 * 6 * 1.2 * mean, rel=1e-3)  # of all masses
    assert M[2, 12] == pytest.approx(M[8, 12], rel=0.03) and M[4, 12] == pytest.approx(M[10, 12], rel=0.05)
    over = [np.mean((x0 + np.linspace(-12, 12, 2001)) ** 2 / 600 - 0.4) for x0 in (14.0, -14.0)]
    assert [C[12, 2], C[12, 8]] == pytest.approx([RHO * G * 144 * one for one in over], abs=5e-4 * RHO * G * 144)
    point = transfer_functions(db.bodies_reader.floating(), db.omega, db.wave_direction,
                               (Point("end", (12.0, 0.0, 0.3), body="aft"),), water=False)  # fmt: skip
    at = {name: point.value[0, 0, i] for i, name in enumerate(point.names)}
    X, (up,) = db["rao"][0, 0], sag(np.array([[-26.0, 1.0, 0.3]]))
    rise = X[8] - 12 * X[10] + X[12] * up[2]
    assert at["end displacement z"] == pytest.approx(rise, rel=1e-3)


def test_a_hinge_is_no_shape_and_a_beam_not_of_two_bodies(tmp_path):
    np.savetxt(tmp_path / "hinge.csv", rows_of(lambda p: np.stack([0 * p[:, 0], 0 * p[:, 0], p[:, 0]], axis=1)))
    rigid = {"kind": "file", "name": "turn", "file": str(tmp_path / "hinge.csv"), "stiffness": 1e6, "mass": 1e3}
    given = tables(rigid, bodies=SAGS, waves={"omegas": [1.6]}, panels=160)
    with pytest.raises(
        SceneError, match=r"modes\[0\].body is missing; allowed: fore, aft; a shape of all bodies together needs a file"
    ):
        make_scene(tables(BENDING, bodies=SAGS, waves={"omegas": [1.6]}))
    given["modes"][0]["file"] = str(tmp_path / "whole.csv")
    turn = rows_of(lambda p: np.stack([p[:, 2], 0 * p[:, 0], -p[:, 0]], axis=1))
    np.savetxt(tmp_path / "whole.csv", turn)
    with pytest.raises(SceneError, match=r"turn does not deform the body: .* join bodies by \[\[hinges\]\] of a study"):
        solve(make_scene(given), tmp_path / "none.h5")


def test_a_shape_that_strains_one_of_its_bodies_is_a_shape(monkeypatch):
    """Whichever of the bodies that is; a rigid motion of each of them is none, and is not looked at without motions"""
    hulls = [box(10.0, 4.0, 2.0, panels=40), box(8.0, 4.0, 2.0, panels=40)]
    monkeypatch.setattr(bending, "_body", lambda scene, number: number)
    monkeypatch.setattr(bending, "_center", lambda scene, number: np.array([0.0, 0.0, -1.0]))
    turned = lambda p: np.stack([0 * p[:, 0], 0.2 - 0.1 * p[:, 2], 0.1 * p[:, 1]], axis=1)  # noqa: E731
    bent = lambda p: np.stack([0 * p[:, 0], 0 * p[:, 0], p[:, 0] ** 2], axis=1)  # noqa: E731

    def check(*shapes, known=True, on=(0, 1)):
        mode = SimpleNamespace(name="m", moves=range(len(shapes)), on=on, in_body=lambda body, p: shapes[body](p))
        bending._check_strained(SimpleNamespace(motions_known=known), [mode], hulls)

    def both(*each):
        made = [
            SimpleNamespace(name=name, moves=(0,), on=(), in_body=lambda body, p, one=one: one(p)) for name, one in each
        ]
        bending._check_strained(SimpleNamespace(motions_known=True), made, hulls)

    check(bent, turned)
    check(turned, bent)
    both(("first", bent), ("second", bent))
    with pytest.raises(SceneError, match=r"^second does not deform the body"):
        both(("first", bent), ("second", turned))
    check(turned, turned, known=False)
    rigid, out = "m does not deform the body: it is a rigid motion, which", "already; leave it out"
    with pytest.raises(
        SceneError, match=rf"^{rigid} each body has {out}, or join bodies by \[\[hinges\]\] of a study$"
    ):
        check(turned, turned)
    with pytest.raises(SceneError, match=f"^{rigid} the body has {out}$"):
        check(turned, on=())
