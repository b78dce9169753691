"""Where the weight of a body may be: refused where no body of its hull has it, told where the body would turn."""

import numpy as np
import pytest

from hakobune.meshing.shapes import box
from hakobune.pipelines.cli import main
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.header import make_header
from hakobune.pipelines.solve.hull import MeshedHull
from hakobune.pipelines.solve.weight import check_weight, weight_remarks

MESH = box(100, 50, 10, panels=60)
GM_LONGITUDINAL = 100.0**2 / 120 - 5.0  # L²/12T − T/2, centre of gravity in the waterline


def told(**body):
    """Remarks on a box of 100 × 50 × 10 m.  Raises SceneError."""
    raw = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, **body}
    scene = make_scene({"water": {"depth": 20.0}, "bodies": [raw], "waves": {"omegas": [0.5]}})
    properties = make_header(scene, MeshedHull(MESH, None)).body
    check_weight(scene, MESH, properties)
    return list(weight_remarks(scene, MESH, properties))


@pytest.mark.parametrize(("place", "count"), [(0.0, 0), (0.1, 0), (1.0, 1), (2.5, 1)])
def test_a_centre_of_gravity_off_the_centre_of_buoyancy_is_told_with_its_moment_and_angle(place, count):
    said = [line for line in told(center_of_gravity=[place, 0.0, 0.0]) if "trim" in line]
    angle, moment = np.degrees(np.arctan(place / GM_LONGITUDINAL)), 1025 * 50_000 * 9.80665 * place
    assert len(said) == count
    assert all(f"trim moment of {moment:.4g} N m, {angle:.3g}° of static trim" in line for line in said)


@pytest.mark.parametrize("place", [[15.0, 0.0, 0.0], [-15.0, 0.0, 0.0], [0.0, 2.0, 0.0], [50.0, 0.0, 5.0]])
def test_coordinates_from_the_stern_are_refused_unless_the_body_is_held(place):
    with pytest.raises(SceneError, match=r"off the centre of buoyancy in [xy]: .* limit 2°; .*--trimmed"):
        told(center_of_gravity=place)
    assert any("static" in line for line in told(center_of_gravity=place, trimmed=True))


def test_a_hull_beside_its_origin_is_refused_only_where_something_is_said_of_its_weight():
    for known in ({}, {"gyration": [15.0, 29.0, 32.0]}):
        scene = make_scene(
            {"water": {"depth": 20.0}, "waves": {"omegas": [0.5]},
             "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, **known}]}
        )  # fmt: skip
        beside = MESH.moved(20.0)
        properties = make_header(scene, MeshedHull(beside, None)).body
        if known:
            with pytest.raises(SceneError, match="-20 m off the centre of buoyancy"):
                check_weight(scene, beside, properties)
        else:
            check_weight(scene, beside, properties)


@pytest.mark.parametrize(("place", "axis"), [([1e6, 0.0, 0.0], "x"), ([0.0, 0.0, 1e6], "z"), ([0.0, 0.0, -400.0], "z")])
@pytest.mark.parametrize("trimmed", [False, True])
def test_a_centre_of_gravity_far_from_the_hull_is_refused(place, axis, trimmed):
    with pytest.raises(SceneError, match=f"center_of_gravity has {axis} = .* outside the wetted hull"):
        told(center_of_gravity=place, trimmed=trimmed)


@pytest.mark.parametrize("gyration", [[100.0, 1.0, 1.0], [15.0, 29.0, 100.0], [1e5, 1.0, 1.0]])
def test_radii_of_gyration_that_no_body_has_are_refused(gyration):
    with pytest.raises(SceneError, match=r"gyration has .* k² ≤ k₂² \+ k₃²"):
        told(gyration=gyration)


@pytest.mark.parametrize(
    ("gyration", "words"),
    [
        ([15.0, 29.0, 32.0], []),
        ([3.0, 4.0, 5.0], []),  # a flat plate
        ([0.674, 1.12, 1.408], ["that the other two allow"]),  # of a model in a tank, as printed
        ([150.0, 140.0, 15.0], ["largest dimension of the wetted body, 100 m", "that the other two allow"]),
    ],
)
def test_radii_of_gyration_that_are_doubtful_are_remarked(gyration, words):
    said = [line for line in told(gyration=gyration) if "gyration" in line]
    assert len(said) == len(words) and all(word in line for word, line in zip(words, said, strict=True))


def test_a_scene_refused_for_its_weight_leaves_no_file_and_a_held_one_solves(tmp_path, capsys):
    path = tmp_path / "box.h5"
    flags = "box --length 40 --beam 20 --draft 5 --depth 20 --omega 0.8 --only added_mass --panels 40"
    command = [*flags.split(), "--output", str(path), "--center-of-gravity", "15,0,0"]
    assert main(command) == 2 and not path.exists()
    assert "static trim" in capsys.readouterr().err
    assert main([*command, "--trimmed"]) == 0
    before = path.read_bytes()
    assert main(command) == 2 and path.read_bytes() == before
