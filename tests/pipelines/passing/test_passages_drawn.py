"""The picture and the table of a passage, places that are looked at first, and what ships may not have."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing.shapes import box
from hakobune.mooring.passing.passage import Passage, Track
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.passing import command, result
from hakobune.pipelines.passing.study import check_apart, make_study, read_study

BOX = {"shape": "box", "length": 60.0, "beam": 12.0, "draft": 4.0}


def study(**more):
    track = {"distance": 40.0, "speed": 2.0}
    return {"water": {"depth": 10.0}, "moored": BOX, "passing": BOX, "track": track} | more


def passage(opposite=False):
    changing = np.array([[1e3, 2e3, 0.0, 0.0, 0.0, 4e4], [-3e3, 8e3, 5.0, 6.0, 7.0, 0.0], [2e3, 1e3, 0, 0, 0, -5e4]])
    return Passage(Track(40.0, 2.0, opposite), np.array([-20.0, 0.0, 20.0]), changing, 0.5 * changing)


def test_forces_are_drawn_over_the_place_of_the_other_ship_in_kilonewtons(pictures, tmp_path):
    """Surge and sway above, yaw below, each of both parts together"""
    command._draw(SimpleNamespace(detail=passage()), tmp_path / "p.png")
    above, below = pictures[0].axes
    surge, sway = above.lines
    assert surge.get_xydata() == pytest.approx(np.array([[-20, 1.5], [0, -4.5], [20, 3.0]]))
    assert sway.get_ydata() == pytest.approx([3.0, 12.0, 1.5])
    assert below.lines[0].get_xydata() == pytest.approx(np.array([[-20, 60.0], [0, 0], [20, -75.0]]))
    assert [text.get_text() for text in above.get_legend().get_texts()] == ["surge", "sway"]
    assert [text.get_text() for text in below.get_legend().get_texts()] == ["yaw"]
    assert (above.get_ylabel(), below.get_ylabel()) == ("force, kN", "moment, kN m")
    assert below.get_xlabel() == "passing ship ahead of the moored one by, m" and above.get_xlabel() == ""
    assert above.get_title() == "force on a moored ship during a passage"
    assert pictures[0].get_size_inches().tolist() == [8.0, 6.0]
    styles = [line.get_linestyle() for line in (surge, sway, below.lines[0])]
    assert styles == ["-", "--", "-"] and below.lines[0].get_color() == "k"
    assert all(axes.xaxis.get_gridlines()[0].get_visible() for axes in (above, below))


@pytest.mark.parametrize(
    ("opposite", "first"), [(False, "2.5,1500,3000,0,0,0,60000"), (True, "2.5,3000,1500,0,0,0,-75000")]
)
def test_the_table_has_the_forces_in_the_order_of_their_times(tmp_path, opposite, first):
    """40 m at 2 m/s take 20 s, an eighth more at either end from zero; a ship from ahead passes the other way"""
    command._table(SimpleNamespace(detail=passage(opposite)), tmp_path / "f.csv")
    lines = (tmp_path / "f.csv").read_text().splitlines()
    assert lines[0] == "t,Fx,Fy,Fz,Mx,My,Mz" and lines[3] == first
    assert lines[4] == "12.5,-4500,12000,7.5,9,10.5,0" and lines[5].startswith("22.5,") and len(lines) == 8
    assert lines[1] == "0,0,0,0,0,0,0" and lines[7] == "25,0,0,0,0,0,0"


@pytest.mark.parametrize(("given", "says"), [
    ({"plot": "p.doc"}, "p.doc"), ({"forces": "f.txt"}, "f.txt"),
    ({"output": "study.toml"}, "study.toml"), ({"output": "none/r.h5"}, "none"), ({"forces": "none/f.csv"}, "none"),
])  # fmt: skip
def test_places_of_results_are_looked_at_before_ships_are_computed(tmp_path, monkeypatch, given, says):
    def computed(*_):
        raise AssertionError("computed before the places were looked at")

    monkeypatch.setattr(result, "passing", computed)
    (tmp_path / "study.toml").write_text("")
    with pytest.raises(ValueError, match=says):
        command.passing(tmp_path / "study.toml", **{key: tmp_path / name for key, name in given.items()})


def test_what_was_asked_for_is_written_and_named_in_order(tmp_path, monkeypatch, capsys):
    kept = []
    found = SimpleNamespace(detail=SimpleNamespace(in_time="rows"), write=lambda path: kept.append(("result", path)))
    monkeypatch.setattr(result, "passing", lambda path: found)
    monkeypatch.setattr(command, "_table", lambda made, path: kept.append((made.detail.in_time, path)))
    monkeypatch.setattr(command, "_draw", lambda made, path: kept.append((made.detail, path)))
    monkeypatch.setattr("hakobune.pipelines.results.tables.printed", lambda made: 1 if made is found else 9)
    places = {key: tmp_path / name for key, name in (("forces", "f.csv"), ("output", "r.h5"), ("plot", "p.png"))}
    assert command.passing(tmp_path / "study.toml", **places) == 1
    assert kept == [("rows", places["forces"]), ("result", places["output"]), (found.detail, places["plot"])]
    assert capsys.readouterr().out.split() == [str(path) for path in places.values()]
    assert command.passing(tmp_path / "study.toml") == 1 and len(kept) == 3 and capsys.readouterr().out == ""


@pytest.mark.parametrize("name", ["moored", "passing"])
@pytest.mark.parametrize(("key", "value"), [
    ("mass", 1e6), ("name", "x"), ("fixed", True), ("center_of_gravity", [0.0, 0.0, 1.0]),
    ("gyration", [1.0, 1.0, 1.0]), ("GM", 1.0), ("place", [1.0, 0.0, 0.0]),
])  # fmt: skip
def test_a_passage_needs_hulls_alone(name, key, value):
    with pytest.raises(StudyError, match=rf"{name}\.{key} is given; a passage needs the hull only"):
        make_study(study(**{name: BOX | {key: value}}))


def test_files_of_both_hulls_lie_beside_the_study(tmp_path):
    text = "[water]\ndepth = 10.0\n[track]\ndistance = 40.0\nspeed = 2.0\n"
    for name in ("moored", "passing"):
        text += f'[{name}]\nshape = "mesh"\nfile = "{name}.msh"\n'
        (tmp_path / f"{name}.msh").write_text("")
    (tmp_path / "study.toml").write_text(text)
    found, told = read_study(tmp_path / "study.toml")
    assert found.moored.file == str(tmp_path / "moored.msh") and found.passing.file == str(tmp_path / "passing.msh")
    assert told == text


def test_only_the_moored_ship_has_a_rotation_center():
    assert make_study(study(moored=BOX | {"rotation_center": [1.0, 0.0, 0.0]})).moored.rotation_center is not None
    with pytest.raises(StudyError, match=r"passing\.rotation_center is given; only the moored ship has one"):
        make_study(study(passing=BOX | {"rotation_center": [1.0, 0.0, 0.0]}))


@pytest.mark.parametrize(("distance", "wall", "gap"), [
    (12.1, None, 0.1), (-40.0, None, 28.0), (12.0, None, None), (40.0, -6.1, 28.0), (40.0, -6.0, None),
    (40.0, 46.1, 28.0), (40.0, 46.0, None), (40.0, 20.0, None), (-40.0, -46.1, 28.0), (-40.0, 6.1, 28.0),
])  # fmt: skip
def test_ships_and_walls_stand_apart_by_half_of_both_beams(distance, wall, gap):
    """Beams of 12 m each: more than 12 m between centre lines, walls beyond 6 m of either"""
    made = make_study(study(track={"distance": distance, "speed": 2.0}, wall=wall))
    if gap is None:
        with pytest.raises(StudyError, match="allowed"):
            check_apart(made, [12.0, 12.0])
    else:
        assert check_apart(made, [12.0, 12.0]) == pytest.approx(gap)


def test_hulls_of_files_are_taken_to_their_middle_up_to_four_times_the_panels(monkeypatch):
    """Drawn 5 m ahead and 3 m to starboard; as deep as the water it is refused"""
    drawn = box(60.0, 12.0, 4.0, panels=24).whole().moved(dx=5.0, dy=-3.0)
    monkeypatch.setattr(result, "read_mesh", lambda path: drawn)
    own = SimpleNamespace(shape="mesh", file="hull.msh")

    def made(panels, depth):
        return result._hull(SimpleNamespace(moored=own, panels=panels, water=SimpleNamespace(depth=depth)), "moored")

    hull, middle = made(len(drawn), 10.0)
    assert middle == pytest.approx([5.0, -3.0, 0.0])
    assert hull.points.min(axis=0) == pytest.approx([-30.0, -6.0, -4.0]) and hull.points[:, 0].max() == pytest.approx(
        30
    )
    quarter = -(-len(drawn) // 4)
    made(quarter, 4.01)
    with pytest.raises(
        StudyError, match=rf"has {len(drawn)} panels; allowed: up to {4 * (quarter - 1)}, which is 4 times"
    ):
        made(quarter - 1, 10.0)
    with pytest.raises(StudyError, match="has a draft of 4 m in water of 4 m; allowed: less"):
        made(len(drawn), 4.0)
