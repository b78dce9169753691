"""`hakobune passing` through the file that users write."""

import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune import pipelines
from hakobune.meshing.files import write_mesh
from hakobune.meshing.shapes import box
from hakobune.mooring.motion.given_forces import read_force
from hakobune.pipelines.cli import main
from hakobune.pipelines.passing import result
from hakobune.pipelines.passing.study import size
from hakobune.pipelines.scene.tables import BodyTable

SCENE = tomllib.loads((Path(pipelines.__file__).parent / "scenes" / "passing_tanker.toml").read_text(encoding="utf-8"))
BOX = {"shape": "box", "length": 60.0, "beam": 12.0, "draft": 4.0}


def boxes(**more):
    """Two boxes 40 m apart in 10 m, by panels"""
    track = {"distance": 40.0, "speed": 2.0, "lengths": 1.0}
    return {"panels": 24, "water": {"depth": 10.0}, "moored": BOX, "passing": BOX, "track": track} | more


def test_forces_of_tests_in_tanks_are_those_of_the_worked_example():
    """389.3 kN, 1274.4 kN, 40 010 kN m of Kriebel (2005), for sections of 0.98 beam times draft; those of the hull's
    own bilge are 0.9905 and 0.9878 of it (1 − (1 − π/4) 2r²/(B T), r a quarter of the draft)"""
    found = hakobune.passing(SCENE | {"panels": 300, "method": "kriebel", "peaks": [0.299, 1.064, 0.204]})
    of_section = [
        1 - (1 - np.pi / 4) * 2 * (0.25 * draft) ** 2 / (beam * draft) for beam, draft in ((39.0, 15.3), (25.8, 6.8))
    ]
    wanted = np.array([389294.43, 1274400.94, 40010302.24]) * np.prod(of_section) / 0.98**2
    assert np.abs(found["largest.force"]) == pytest.approx(wanted, rel=0.01)  # panels round the bilge off
    assert found.status == 0


def test_panels_tell_the_same_in_file_picture_and_table(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("study.toml").write_text(tomli_w.dumps(boxes()), encoding="utf-8")
    words = ["passing", "study.toml", "--forces", "forces.csv", "--output", "passing.h5", "--plot", "passing.png"]
    assert main(words) == 0
    found, table = hakobune.read("passing.h5"), read_force("forces.csv")
    own, extra = found["course.force"].T, (len(table.times) - len(found["course.force"].T)) // 2
    assert table.force[extra:-extra] == pytest.approx(own, rel=1e-9, abs=1e-6)
    assert not table.force[[0, -1]].any()
    assert table.force[:, 1].max() == pytest.approx(found["largest.highest"][1], rel=1e-9)
    assert found["largest.stagger"][1] == pytest.approx(0.0, abs=1e-6)  # equal ships: sway is largest abeam
    assert Path("passing.png").stat().st_size > 5000


def test_a_wall_behind_the_moored_ship_is_an_image():
    """Flow along the wall is faster, flow towards it is held up: more surge, less sway"""
    open_water, quay = (hakobune.passing(boxes(**more)) for more in ({}, {"wall": -8.0}))
    assert abs(quay["largest.force"][1]) < 0.7 * abs(open_water["largest.force"][1])
    assert abs(quay["largest.force"][0]) > abs(open_water["largest.force"][0])


def test_a_hull_of_a_file_beside_the_study_is_that_of_its_shape_wherever_it_is_drawn(tmp_path, monkeypatch):
    """Drawn 5 m ahead of its origin, its moments are about a place 5 m astern of its middle"""
    hull = box(60.0, 12.0, 4.0, panels=24).whole().moved(dx=5.0)
    write_mesh(hull, tmp_path / "hull.msh")
    (tmp_path / "study.toml").write_text(
        tomli_w.dumps(boxes(method="wang", moored={"shape": "mesh", "file": "hull.msh"})), encoding="utf-8"
    )
    monkeypatch.chdir("/")
    found = hakobune.passing(tmp_path / "study.toml")
    wanted = hakobune.passing(boxes(method="wang", moored=BOX | {"rotation_center": [-5.0, 0.0, 0.0]}))
    assert found["course.force"] == pytest.approx(wanted["course.force"], rel=1e-9, abs=1e-6)
    middle = hakobune.passing(boxes(method="wang"))
    sway, yaw = middle["course.force"][[1, 5]]
    assert found["course.force"][5] == pytest.approx(yaw + 5.0 * sway, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"track": {"distance": 11.0, "speed": 2.0}}, "1 m less than half of both beams"),
        ({"track": {"distance": 40.0, "speed": 10.0}}, "faster than long waves there, 9.9 m/s"),
        ({"track": {"distance": 40.0, "speed": 50.0}}, "track.speed is 50 m/s"),
        ({"wall": 20.0}, "wall is at y = 20 m"),
        ({"wall": -5.0}, "wall is at y = -5 m"),
        ({"method": "wang", "wall": -8.0}, "wall is given with method = 'wang'"),
        ({"quay": True}, "quay is given with method = 'panels'"),
        ({"method": "slender"}, "allowed: panels, wang, kriebel"),
        ({"method": "kriebel", "water": {"depth": float("inf")}}, "in shallow water"),
        ({"moored": BOX | {"draft": 10.0}}, "moored.draft is 10.0 m in water 10.0 m deep"),
        ({"passing": {"shape": "box", "length": 60.0, "beam": 12.0}}, "passing.draft is missing"),
        ({"panels": 4}, "panels is 4; allowed: 12 to 2000"),
        ({"moored": BOX | {"mass": 1e6}}, "moored.mass is given; a passage needs the hull only"),
        ({"passing": BOX | {"place": [0.0, 40.0, 0.0]}}, "passing.place is given"),
        ({"passing": BOX | {"fixed": True}}, "passing.fixed is given; a passage needs the hull only: leave it out"),
        ({"moored": BOX | {"fixed": True}}, "moored.fixed is given; a passage needs the hull only"),
        ({"moored": BOX | {"trimmed": True}}, "moored.trimmed is given; a passage needs the hull only"),
        ({"moored": BOX | {"center_of_gravity": [0.0, 0.0, 1.0]}}, "moored.center_of_gravity is given; a passage"),
        ({"passing": BOX | {"GM": 1.0}}, "passing.GM is given"),
        ({"passing": BOX | {"gyration": [5.0, 15.0, 15.0]}}, "passing.gyration is given"),
        ({"moored": BOX | {"name": "a"}}, "moored.name is given"),
        (
            {"passing": BOX | {"rotation_center": [0.0, 0.0, 1.0]}},
            "passing.rotation_center is given; only the moored ship has one",
        ),
    ],
)
def test_faults_are_one_line(change, line):
    with pytest.raises(ValueError, match=r"^[^\n]*$") as caught:
        hakobune.passing(boxes(**change))
    assert line in str(caught.value)


@pytest.mark.parametrize(("speed", "told", "status"), [(3.9, "", 0), (4.5, "1.12 times", 0), (8.0, "1.70 times", 1)])
def test_speed_near_that_of_waves_is_told_and_fails(speed, told, status):
    """1/√(1 − Fₕ²) in 10 m, where waves make 9.903 m/s: 1.088, 1.123 and 1.697; limits 1.1 and 1.5"""
    found = hakobune.passing(boxes(method="wang", track={"distance": 40.0, "speed": speed}))
    assert found.status == status
    assert (told in " ".join(found.findings)) if told else not any("Froude" in line for line in found.findings)


@pytest.mark.parametrize(("speed", "told", "status"), [(5.8, "", 0), (7.0, "1.15 times", 0), (13.0, "2.69 times", 1)])
def test_tests_in_tanks_are_no_estimate_near_the_speed_of_long_waves_either(speed, told, status):
    """1/√(1 − Fₕ²) in 20 m, where long waves make 14.005 m/s: 1.099, 1.155 and 2.688; limits 1.1 and 1.5"""
    found = hakobune.passing(SCENE | {"method": "kriebel", "track": {"distance": 110.0, "speed": speed}})
    assert found.status == status
    lines = [line for line in found.findings if "Froude" in line]
    assert (told in lines[0] and "the formula of the tests" in lines[0]) if told else not lines


def test_a_short_track_is_told():
    found = hakobune.passing(boxes(method="wang", track={"distance": 40.0, "speed": 2.0, "lengths": 0.5}))
    assert any("remains at the ends of the track" in line for line in found.findings)


def test_the_largest_of_a_passage_is_the_farther_from_nothing_and_told_where_the_other_ship_is():
    """Surge falls to −30 kN 20 m ahead, sway rises to 50 kN abeam, yaw falls to −70 kN m astern"""
    force = np.zeros((3, 6))
    force[:, 0], force[:, 1], force[:, 5] = [20e3, 10e3, -30e3], [-40e3, 50e3, 0.0], [-70e3, 60e3, 0.0]
    steady = np.zeros((3, 6))
    steady[1, :2], steady[2, 0] = [-3e3, 5e3], 1e3
    found = SimpleNamespace(force=force, steady=steady, stagger=np.array([-20.0, 0.0, 20.0]))
    made = {name: one.values.tolist() for name, one in result._largest(found).items()}
    assert made == {
        "largest.force": [-30e3, 50e3, -70e3], "largest.stagger": [20.0, 0.0, -20.0],
        "largest.lowest": [-30e3, -40e3, -70e3], "largest.highest": [20e3, 50e3, 60e3],
        "largest.steady": [0.1, 0.1, 0.0],
    }  # fmt: skip
    assert result._largest(found)["largest.force"].units() == ("N", "N", "N m")
    none = SimpleNamespace(force=0 * force, steady=steady, stagger=found.stagger)
    assert result._largest(none)["largest.steady"].values.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(("opposite", "way"), [(False, [-20.0, 0.0, 20.0]), (True, [20.0, 0.0, -20.0])])
def test_a_course_is_told_in_the_order_of_its_times(opposite, way):
    table = SimpleNamespace(force=np.arange(18.0).reshape(3, 6))
    found = SimpleNamespace(in_time=table, track=SimpleNamespace(opposite=opposite), stagger=[-20.0, 0.0, 20.0])
    found.stagger = np.array(found.stagger)
    made = result._course(found)
    assert made["course.stagger"].values.tolist() == way and made["course.force"].values[1].tolist() == [1, 7, 13]


@pytest.mark.parametrize(("draft", "told"), [(4.99, False), (5.01, True)])
def test_a_ship_that_blocks_half_of_the_depth_is_told_to_slender_ships(draft, told):
    study = SimpleNamespace(method="wang", water=SimpleNamespace(depth=10.0),
                            moored=SimpleNamespace(shape="box", draft=draft))  # fmt: skip
    track = SimpleNamespace(froude=lambda depth: 0.1)
    said = list(result._findings(study, track, SimpleNamespace(left=0.0), None, None))
    assert len(said) == told and all("blocks 50 % of the depth" in line for line in said)


def test_sizes_of_a_ship_are_those_given_or_those_of_its_hull():
    """A buoy is as long and as broad as its diameter; a hull of a file wherever it is drawn"""
    hull = box(60.0, 12.0, 4.0, panels=24).whole().moved(dx=5.0, dy=-3.0)
    sizes = {"length": 50.0, "beam": 10.0, "draft": 3.0}
    for body, wanted in ((BodyTable(shape="buoy", radius=7.0, draft=3.0), (14.0, 14.0, 3.0)),
                         (BodyTable(shape="box", **sizes), (50.0, 10.0, 3.0)),
                         (BodyTable(shape="ship", **sizes), (50.0, 10.0, 3.0)),
                         (BodyTable(shape="mesh", file="hull.msh"), (60.0, 12.0, 4.0))):  # fmt: skip
        assert size(body, hull) == pytest.approx(wanted)
