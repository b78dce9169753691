"""A ship and a barge made fast to each other, one heading the other way, through the file of a simulation."""

from types import SimpleNamespace

import h5py
import msgspec
import numpy as np
import pytest

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.modes import Body
from hakobune.mooring.fenders.gaps import Side, gaps, pairs_of
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.motion.simulation import moored
from hakobune.mooring.studies.conditions import Afloat, ExposedBox
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.quay_tables import QuayFenderTable, berth_between
from hakobune.pipelines.films.of_several import scene_of_several
from hakobune.pipelines.films.stage import carried
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate import pictures
from hakobune.pipelines.simulate.work import Task, prepared

SHIP = {"name": "ship", "shape": "box", "length": 14.0, "beam": 5.0, "draft": 1.5, "place": [0.0, 3.5, 0.0],
        "gyration": [1.6, 4.0, 4.0]}  # fmt: skip
BARGE = {**SHIP, "name": "barge", "length": 10.0, "place": [1.0, -3.5, 180.0]}
NYLON = {"elongation_percent": [0.0, 10.0, 30.0], "tension_kN": [0.0, 20.0, 90.0], "breaking_load_tonf": 12.0}
CHAIN = {"weight_kg_per_m": 20.0, "axial_stiffness_tonf": 5000.0, "breaking_load_tonf": 40.0}
TIE = {"name": "tie", "type": "nylon", "body": "barge", "fairlead": [-4.0, -2.5, 1.0], "to": "ship",
       "bollard": [3.0, -2.5, 1.0], "pretension_tonf": 0.3}  # fmt: skip
LOOSE = {key: value for key, value in TIE.items() if key != "pretension_tonf"}
FENDER = {"name": "F", "body": "barge", "to": "ship", "position": [1.0, -4.5, 0.5], "family": "cell", "height": 1.0,
          "friction": 0.2, "shear": 300.0}  # fmt: skip
ROPE = {"name": "R", "body": "barge", "fairlead": [4.0, -2.5, 1.0], "to": "ship", "bollard": [-5.0, -2.5, 1.0],
        "breaking_load_kN": 100.0, "break_strain": 0.3, "pretension_kN": 3.0}  # fmt: skip
ACROSS = {**ROPE, "bollard": [-1.0, -2.5, 1.0]}
HINGE = {"name": "H", "bodies": ["ship", "barge"], "position": [0.0, -3.5, 1.0], "axis": [1.0, 0.0, 0.0]}
STUDY = {
    "water": {"depth": 12.0}, "hulls": {"ship": {"freeboard": 1.5}, "barge": {"freeboard": 1.5}},
    "types": {"nylon": NYLON, "chain": CHAIN}, "lines": [TIE], "fender": [FENDER], "rope": [ROPE],
    "spreads": [{"body": "ship", "type": "chain", "length": 60.0, "corner_headings_deg": [45], "pretension_tonf": 1.0}],
    "waves": {"height": 0.4, "period": 5.0, "direction_deg": 30.0, "method": "regular_wave"},
    "simulation": {"duration": 30.0, "ramp": 20.0, "memory": "constant", "dynamic_lines": "none",
                   "linear_damping": {"barge sway": 2.0}},
}  # fmt: skip
SHORT = STUDY["simulation"] | {"duration": 10.0, "ramp": 1.0}
TIGHT = {"rope": [ACROSS], "fender": [
    {**FENDER, "position": [3.0, -4.5, 0.5]}, {**FENDER, "name": "G", "position": [-1.0, -4.5, 0.5]}]}  # fmt: skip


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("beside") / "two.h5"
    waves = {"omegas": {"from": 0.8, "to": 2.0, "count": 4}, "headings_deg": list(range(0, 360, 45))}
    hakobune.solve({"water": {"depth": 12.0}, "bodies": [SHIP, BARGE], "waves": waves, "panels": 60}, path)
    return path


def test_two_hulls_are_simulated_stored_and_told(database, tmp_path, capsys):
    run = tmp_path / "run.h5"
    made = hakobune.simulate({**STUDY, **TIGHT}, database, run)
    assert made.labels["record"].values[[0, 6]].tolist() == ["ship surge", "barge surge"]
    assert made.labels["gap"].values.tolist() == ["ship barge"] and made["gap.smallest"][0] < made["gap.mean"][0] < 2.2
    assert made.labels["line"].values.tolist()[-2:] == ["tie", "R"] and made["deflection.largest"][0] > 0.005
    with h5py.File(run) as file:
        names = file["dof"].asstr()[()]
        assert names[[0, 11]].tolist() == ["ship__Surge", "barge__Yaw"] and file["slow_dof"].shape == (6,)
        assert file["fairlead"][-2] == pytest.approx([5.0, -1.0, 1.0]) and file["anchor"][-2] == pytest.approx(
            [3, 1, 1]
        )
        assert abs(file.attrs["place_at_rest"][11]) < 0.1
        assert np.abs(file["motion"][0, :, 6:].astype(float)).max() < 2.0
    film = ["animate", str(run), "--output", str(tmp_path / "film.gif"), "--length", "2"]
    assert main(film) == 0 and "film.gif: 3 frames" in capsys.readouterr().out


def test_records_have_the_fender_that_is_pressed_most(database, tmp_path, monkeypatch):
    run, drawn = tmp_path / "run.h5", []
    hakobune.simulate(STUDY | TIGHT | {"simulation": SHORT}, database, run)
    monkeypatch.setattr(pictures, "save", lambda figure, path, density: drawn.append(figure.axes))
    with h5py.File(run) as file:
        pictures.draw_one(file, "records", tmp_path / "run.png", 1)
        pressed, names = file["deflection"][0].astype(float), file["fender"].asstr()[()]
    most, (*_, line, last) = int(np.argmax(pressed.max(axis=0))), drawn[0]
    assert last.get_ylabel() == f"deflection, m\n{names[most]}" and line.get_ylabel().startswith("tension, kN")
    assert last.lines[0].get_ydata() == pytest.approx(pressed[:, most]) and pressed.max() > 1e-3


def test_a_film_has_the_hulls_and_the_ropes_between_them_where_the_run_has_them(database, tmp_path):
    """The barge heads the other way: a metre ahead along its own axis is a metre astern in the scene"""
    hakobune.simulate({**STUDY, **TIGHT, "simulation": SHORT}, database, tmp_path / "run.h5")
    with h5py.File(tmp_path / "run.h5") as file:
        scene = scene_of_several(file)
    ship, barge = scene.stage.hulls
    faces = [SimpleNamespace(points=[fender.face]) for fender in scene.stage.fenders]
    for (_, own, carrier), fender in zip(carried(scene.stage, faces), TIGHT["fender"], strict=True):
        assert carrier == 0 and own[0] == pytest.approx(np.subtract(fender["position"], ship.center))  # on the ship
    assert carried(scene.stage._replace(carriers=()), faces) == []  # on a quay
    assert ship.box == pytest.approx((-7, 7, -2.5, 2.5, -1.5, 1.5)) and barge.box[:2] == pytest.approx((-5, 5))
    motion = np.zeros((2, 12))
    motion[1, 6:8], motion[1, 11] = [1.0, 0.5], np.pi / 2
    still, moved = scene.poses(motion)
    assert still[:, [0, 1, 5]] == pytest.approx(np.array([[0, 3.5, 0], [1, -3.5, np.pi]]))
    assert moved[0] == pytest.approx(still[0]) and moved[1, [0, 1, 5]] == pytest.approx([0.0, -4.0, 1.5 * np.pi])
    start, end = scene.threads(motion[1])[-40:][[0, -1]]  # the rope: from the barge to the ship, which stands still
    assert end == pytest.approx([-1.0, 1.0, 1.0])
    assert start == pytest.approx(
        [0.0 - 2.5, -4.0 - 4.0, 1.0]
    )  # 4 m along x and −2.5 m along y of a hull that heads to −y


def test_a_barge_that_ropes_leave_slack_is_told_of(database, tmp_path):
    """Pushed off by 0.2 m of fender, away from where hawser and rope are straight"""
    study = {**STUDY, "fender": [{**FENDER, "position": [1.0, -4.7, 0.5]}], "simulation": SHORT}
    words = "barge surge is not held at rest"
    assert words in "".join(hakobune.simulate(study, database, tmp_path / "run.h5").findings)
    assert words not in "".join(hakobune.simulate({**study, **TIGHT}, database, tmp_path / "tight.h5").findings)


def test_a_loose_barge_rests_at_one_place_to_the_last_digit(database):
    """Whatever lies in memory: by MINPACK of scipy 1.17 half of such tries differ"""
    body, _, _ = prepared(Task(make_study(STUDY), str(database), None, None))
    reader, waste = body.reader, []
    places = []
    for length in range(10):
        waste.append([bytes(137 * length + 1) for _ in range(20)])
        again = moored(reader, body.system, berth=body.berth, memory=body.memory, waves=body.waves)
        places.append(again.start.tobytes())
    assert len(set(places)) == 1


def test_moor_finds_the_rest_between_fenders_ropes_and_hinges(database):
    """The barge hangs on the ship alone: hawser and rope, 45° off its side, press it on the fender; a hinge holds what
    waves push it with"""
    made = hakobune.moor({**STUDY, "rope": [ACROSS]}, database)
    fender, rope = made["contact.force_at_rest"]
    assert fender == pytest.approx(np.sqrt(0.5) * (rope + made["tension.at_rest"][-1]), rel=0.03)
    assert rope == pytest.approx(made["tension.at_rest"][-1], rel=0.05) and rope > 1e3
    made = hakobune.moor({**STUDY, "lines": [], "fender": [], "rope": [], "hinges": [HINGE]}, database)
    barge, held = made.labels["load"].values.tolist().index("barge sum"), made["hinge.steady"]
    pushed = made["load.Fx"][barge] + 1j * made["load.Fy"][barge]
    along = rotation(*made.detail[0].equilibrium.position[0, 3:]) @ held[:3]  # the ship heels under its chains
    assert along[0] + 1j * along[1] == pytest.approx(-pushed, rel=1e-4)
    rest, hydro = made.detail[0].rest.position, open_database(database).bodies_reader
    floated = hydro.stiffness[6:, 6:] @ (rest - hydro.axes_at_rest)[1]  # chains of the ship pull the barge down too
    assert made["hinge.at_rest"][2] == pytest.approx(floated[2], rel=1e-3) and abs(floated[2]) > 100
    assert abs(held[3]) < 1e-6 * abs(held[4])
    assert len(made["period.at_rest"]) == 7


def test_a_hinge_whose_damper_gives_no_way_moves_in_moor_as_a_rigid_link(database):
    alone = {**STUDY, "lines": [], "fender": [], "rope": []}
    kinds = {"damping": 1e9}, {"kind": "rigid"}, {}
    damped, rigid, free = (hakobune.moor({**alone, "hinges": [HINGE | kind]}, database) for kind in kinds)
    roll = [made["motion.amplitude"][[3, 9]] for made in (damped, rigid, free)]
    assert roll[0] == pytest.approx(roll[1], rel=1e-4) and np.abs(roll[2] / roll[1] - 1).max() > 0.05


def test_what_hinges_hold_is_told_stored_and_drawn(database, tmp_path, monkeypatch):
    """By moor too: the largest is the steady force and the amplitude in the regular wave, which chains hardly change"""
    run, study = tmp_path / "run.h5", {**STUDY, "lines": [], "fender": [], "rope": [], "hinges": [HINGE]}
    made, held = hakobune.simulate(study, database, run), hakobune.moor(study, database)
    waves = np.abs(held["hinge.largest"]) - np.abs(held["hinge.steady"])
    assert waves[[0, 2, 4, 5]] == pytest.approx(np.sqrt(2) * made["hinge.sigma"][[0, 2, 4, 5]], rel=0.06)
    assert made.labels["hinge"].values.tolist()[:4] == ["H force x", "H force y", "H force z", "H moment x"]
    assert made["hinge.largest"][2] > 100 and abs(made["hinge.largest"][3]) < 1e-6 * made["hinge.largest"][4]
    drawn = []
    monkeypatch.setattr(pictures, "save", lambda figure, path, density: drawn.append(figure))
    with h5py.File(run) as file:
        assert pictures.draw(file, run)[-1] == "run_hinges.png"
        motion, held = file["motion"][0].astype(float), file["links"][0].astype(float)
        roll, pitch = motion[:, [3, 9]], motion[:, [4, 10]]
        # z of the hinge, of both, 1 m ahead of the middle of the barge
        at = motion[:, [2, 8]] - [0, 1] * np.sin(pitch) + (np.cos(roll) - 3.5 * np.sin(roll)) * np.cos(pitch)
        assert np.abs(np.diff(at, axis=1)).max() < 1e-4 and np.abs(roll.sum(axis=1)).max() > 1e-4
        assert held[:, 6] == pytest.approx(-roll.sum(axis=1), abs=2e-6)  # its travel, of a barge that heads astern
        assert held.shape == (len(motion), 7) and held[:, 2].max() == pytest.approx(made["hinge.largest"][2], rel=1e-6)
    axes = drawn[-1].axes
    assert [one.get_ylabel() for one in (axes[2], axes[3], axes[6])] == ["force z, kN", "moment x, kN m", "travel, °"]
    assert axes[2].lines[0].get_ydata().max() == pytest.approx(1e-3 * made["hinge.largest"][2], rel=1e-6)


def test_the_gap_is_that_of_rectangles():
    """4 × 2 m at the origin, 2 × 2 m whose corner is 1 m off along x and 1 m along y, then turned by 45° and inside"""
    sides = (Side("a", np.array([2.0, 1.0]), np.zeros(2), -1, np.zeros(3)),
             Side("b", np.array([1.0, 1.0]), np.array([0.5, 0.0]), 0, np.array([4.5, 3.0, 0.0])))  # fmt: skip
    poses = np.zeros((3, 1, 6))
    poses[1, 0, [0, 1, 5]] = 0.5, -3.0, np.pi / 4
    poses[2, 0, :2] = -3.2, -3.0
    corner = 5.0 - 0.5 / np.sqrt(2) - np.sqrt(2)  # x of the corner that is nearest; its centre lies at y = −0.35
    assert gaps(sides, poses)[:, 0] == pytest.approx([np.sqrt(2), corner - 2.0, -2.0])


def test_hulls_that_another_keeps_apart_have_no_gap():
    """Of three pontoons in a row the ends have none; past a narrower one in the middle they could meet, and do"""
    row = [Side(name, np.array([7.5, 4.0]), np.zeros(2), i, np.array([16.0 * i, 0, 0])) for i, name in enumerate("abc")]
    assert [one.name + other.name for one, other in pairs_of(row)] == ["ab", "bc"]
    row[1] = row[1]._replace(half=np.array([7.5, 3.9]))
    assert [one.name + other.name for one, other in pairs_of(row)] == ["ab", "ac", "bc"]


FAULTS = {
    "to itself": ({"lines": [{**TIE, "to": "barge"}]}, "lines[0].to is 'barge'; allowed: the name of another body"),
    "a chain between": (
        {"lines": [{**LOOSE, "type": "chain", "length": 9.0}]}, "hangs between ship and barge; a simulation allows",
    ),
    "inside both": (
        {"fender": [{**FENDER, "position": [1.0, -2.4, 0.5]}], "simulation": STUDY["simulation"] | {
            "offset": {"barge sway": -2.5}}}, "overlap by",
    ),
    "of no body": ({"fender": [{**FENDER, "body": ""}]}, "fender[0] (F): body is ''; allowed: a body that moves, ship"),
    "to none": ({"rope": [{**ROPE, "to": "tug"}]}, "rope R: to = 'tug'; allowed: the name of another body, ship"),
    "a motion of none": ({"simulation": STUDY["simulation"] | {"spring": {"sway": 1.0}}}, "allowed: ship surge"),
    "hinged to itself": ({"hinges": [{**HINGE, "bodies": ["ship", "ship"]}]}, "bodies has 'ship' and 'ship'; allowed"),
    "hinged to none": ({"hinges": [{**HINGE, "bodies": ["ship", "tug"]}]}, "'tug'; allowed: two different names of"),
    "hinged twice": ({"hinges": [HINGE, {**HINGE, "name": "G"}]}, "some constraints repeat others"),
    "motions held": (
        {"hinges": [HINGE], "simulation": STUDY["simulation"] | {"motions": ["ship heave"]}},
        "simulation.motions fixes motions that hinges may need; with hinges, name all motions, or leave out the key",
    ),
    "two of a name": ({"hinges": [HINGE, {**HINGE, "kind": "ball"}]}, "two hinges are called 'H'"),
    "torn": (
        {"hinges": [HINGE], "types": STUDY["types"] | {"chain": {**CHAIN, "weight_kg_per_m": 700.0}},
         "hulls": {"ship": {"freeboard": 0.1}, "barge": {"freeboard": 1.5}}},
        "hinges move ship down by 0.474 m at rest, limit 0.1 m",
    ),
    "a fairlead off its hull": (
        {"lines": [{**TIE, "fairlead": [-14.0, -2.5, 1.0]}]},
        "line tie: its fairlead (-14, -2.5, 1) m is 9 m off the hull of 10 by 5 m, z -1.5 to 1.5 m; allowed: up to 1 m",
    ),
    "a bollard under water": ({"lines": [{**TIE, "bollard": [3.0, -2.5, -20.0]}]}, "is 18.5 m off the hull of 14 by"),
    "a hinge far off": (
        {"hinges": [{**HINGE, "position": [40.0, -3.5, 1.0]}]},
        "hinge H is 33.02 m off the hull of ship; allowed: up to 14 m",
    ),
    "tensions in N": (
        {"types": STUDY["types"] | {"nylon": {**NYLON, "tension_kN": [0.0, 2e4, 9e4]}}},
        "types.nylon: its table ends at 9e+04 kN, 765 times its breaking load of 117.7 kN; allowed: up to 10 times",
    ),
    "a pressure in Pa": (
        {"fender": [{**FENDER, "family": "pneumatic", "length": 2.0, "pressure": 5e4}]},
        "its pressure is 50000 kPa; allowed: up to 500 kPa",
    ),
    "a quay": ({"quay": {"y": 9.0}}, "[quay] is given, but the database contains several bodies"),
}  # fmt: skip


def test_a_fender_inside_both_hulls_is_refused():
    """Boxes of 14 × 5 m, 4 m apart, that the hulls of ships which narrow at the waterline leave clear"""
    bodies = [Body(name, (0.0, y, 0.0), 0.0, False, (0.0, y)) for name, y in (("ship", 2.0), ("barge", -2.0))]
    box = ExposedBox(14.0, 5.0, 1.5, 1.5)
    hulls = [Afloat(one.name, box, one.own_center, np.array(one.place), 0.0, 1025.0) for one in bodies]
    table = QuayFenderTable(**{**FENDER, "position": (1.0, -2.0, 0.5)})
    with pytest.raises(StudyError, match=r"fender\[0\] \(F\) lies inside both barge and ship, at 1, 0, 0.5 m"):
        berth_between([table], [], [], hulls, bodies)
    berth_between([msgspec.structs.replace(table, position=(1.0, -2.6, 0.5))], [], [], hulls, bodies)
    with pytest.raises(StudyError, match=r"fender\[0\] \(F\) is at the side of barge away from ship, behind its hull"):
        berth_between([msgspec.structs.replace(table, position=(1.0, -4.6, 0.5))], [], [], hulls, bodies)


def test_a_hawser_that_is_slack_all_the_time_and_one_through_a_hull_are_told(database, tmp_path):
    long = {**LOOSE, "name": "long", "length": 40.0}
    through = {**LOOSE, "name": "through", "length": 7.4, "bollard": [3.0, 2.5, -1.0]}
    study = STUDY | {"lines": [TIE, long, through], "simulation": SHORT}
    found = hakobune.simulate(study, database, tmp_path / "run.h5").findings
    assert any(one.startswith("lines without tension in all runs: ") and "long; check" in one for one in found)
    told = next(one for one in found if one.startswith("these lines pass through the hull on the straight path"))
    assert "through" in told and "tie" not in told


@pytest.mark.parametrize("name", FAULTS)
def test_what_cannot_be_is_refused_in_a_line(database, tmp_path, name):
    change, words = FAULTS[name]
    with pytest.raises(ValueError) as error:
        hakobune.simulate(STUDY | change, database, tmp_path / "run.h5")
    assert words in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(("change", "words"), [
    ({"lines": [], "fender": [], "rope": []}, "barge has 0 lines, fenders, ropes and hinges; allowed: at least 1"),
    (FAULTS["torn"][0] | {"waves": None}, FAULTS["torn"][1]),
], ids=["apart", "torn"])  # fmt: skip
def test_moor_refuses_what_nothing_holds_and_what_hinges_drown(database, change, words):
    given = {key: value for key, value in (STUDY | change).items() if key != "simulation" and value is not None}
    with pytest.raises(ValueError) as error:
        hakobune.moor(given, database)
    assert words in str(error.value) and "\n" not in str(error.value)


def test_a_berth_of_one_body_takes_no_names(tmp_path):
    study = make_study({"water": {"depth": 12.0}, "fender": [FENDER]})
    with pytest.raises(StudyError, match="fender F: body 'barge' is given, but the database contains one body; "):
        study.berth(None, np.zeros(3))
