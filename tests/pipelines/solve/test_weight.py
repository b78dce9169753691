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
    assert all(f"trim moment of {moment:.4g} N m and {angle:.3g}° of static trim" in line for line in said)


def test_a_metacentric_height_places_the_centre_of_gravity():
    """KM of a box is T/2 + B²/12T: with GM of 3 m the centre of gravity is B²/12T − T/2 − 3 above still water"""
    raw = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "GM": 3.0, "gyration": [15.0, 29.0, 32.0]}
    scene = make_scene({"water": {"depth": 20.0}, "bodies": [raw], "waves": {"omegas": [0.5]}})
    found = make_header(scene, MeshedHull(MESH, None)).body
    above = 50.0**2 / 120 - 5.0 - 3.0
    assert found["center_of_mass"] == pytest.approx([0, 0, above]) and found["transverse_metacentric_height"] == (
        pytest.approx(3.0)
    )
    assert found["inertia_matrix"][0, 4] == pytest.approx(1025 * 50_000 * above)
    with pytest.raises(SceneError, match="GM is given together with z of center_of_gravity"):
        told(GM=3.0, center_of_gravity=[0.0, 0.0, 1.0])


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
        ([0.674, 1.12, 1.408], ["that the other two radii allow"]),  # of a model in a tank, as printed
        ([150.0, 140.0, 15.0], ["largest dimension of the wetted body, 100 m", "that the other two radii allow"]),
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


def made_up(mass=1025.0 * 50_000, heights=(1.0, 1.0), place=(0.0, 0.0, 0.0)):
    """Properties of a body whose trim and heel have 4 and 2 GN m of stiffness"""
    stiffness = np.diag([0, 0, 0, 2e9, 4e9, 0.0])
    return {"mass": mass, "displaced_volume": 50_000.0, "center_of_mass": place, "center_of_buoyancy": (0.0, 0.0, -5.0),
            "transverse_metacentric_height": heights[0], "longitudinal_metacentric_height": heights[1],
            "hydrostatic_stiffness": stiffness}  # fmt: skip


def remarks(**given):
    scene = make_scene({"water": {"depth": 20.0}, "waves": {"omegas": [0.5]},
                        "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}]})  # fmt: skip
    return list(weight_remarks(scene, MESH, made_up(**given)))


@pytest.mark.parametrize(("factor", "told"), [(0.989, True), (0.991, False), (1.009, False), (1.011, True)])
def test_mass_that_is_off_by_a_hundredth_is_told(factor, told):
    said = remarks(mass=factor * 1025 * 50_000)
    mass = f"the mass is {factor * 1025 * 50_000:.6g} kg, but the body displaces 5.125e+07 kg; allowed if lines"
    assert [line.startswith(mass) for line in said] == [True] * told


@pytest.mark.parametrize("which", [0, 1])
def test_metacentric_heights_that_are_not_positive_are_told(which):
    names, heights = ("transverse", "longitudinal"), [1.0, 1.0]
    for height, told in ((1e-3, False), (0.0, True), (-0.5, True)):
        heights[which] = height
        said = remarks(heights=tuple(heights))
        text = f"{names[which]} metacentric height {height:.4g} m is not positive: the body capsizes"
        assert said == [text] * told


@pytest.mark.parametrize("gyration", [{}, {"gyration": [3.0, 8.0, 8.0]}])
def test_motions_of_a_body_that_capsizes_are_told_to_be_of_the_free_one(gyration):
    """GM of a box of 30 × 10 × 5 m with its weight at z: B²/12T − T/2 − z"""
    raw = {"shape": "box", "length": 30.0, "beam": 10.0, "draft": 5.0, "center_of_gravity": [0.0, 0.0, 0.5], **gyration}
    scene = make_scene({"water": {"depth": 20.0}, "bodies": [raw], "waves": {"omegas": [0.5]}})
    mesh = box(30, 10, 5, panels=40)
    said = [line for line in weight_remarks(scene, mesh, make_header(scene, MeshedHull(mesh, None)).body)]
    height = 10.0**2 / 60 - 2.5 - 0.5
    assert said[0].startswith(f"transverse metacentric height {height:.4g} m is not positive: the body capsizes")
    assert ("rao and drift_force are of the free body" in said[0]) == bool(gyration)


@pytest.mark.parametrize(("axis", "name", "stiffness"), [(0, "trim", 4e9), (1, "heel", 2e9)])
def test_trim_and_heel_follow_from_moment_and_stiffness(axis, name, stiffness):
    """tan θ = m g x / C, told above 0.1°"""
    for angle in (0.099, 0.101):
        place = np.zeros(3)
        place[axis] = stiffness * np.tan(np.radians(angle)) / (1025 * 50_000 * 9.80665)
        said = remarks(place=place)
        assert len(said) == (angle > 0.1)
        moment = stiffness * np.tan(np.radians(angle))
        assert all(f"{place[axis]:.4g} m off" in line and f"{moment:.4g} N m and 0.101° of static {name}" in line
                   for line in said)  # fmt: skip


@pytest.mark.parametrize(("longest", "told", "refused"), [
    (5.04, False, False), (5.06, True, False), (6.24, True, False), (6.26, True, True),
])  # fmt: skip
def test_the_third_radius_of_gyration_is_at_most_what_the_others_allow(longest, told, refused):
    """√(3² + 4²) = 5: a hundredth above it is told, a quarter refused"""
    if refused:
        with pytest.raises(SceneError, match=f"gyration has {longest} m, but the other two radii allow at most 5 m"):
            told_of(longest)
        return
    said = [line for line in told_of(longest) if "gyration" in line]
    assert len(said) == told and all("larger than the 5 m that the other two radii allow" in line for line in said)


def told_of(longest):
    return told(gyration=[3.0, 4.0, longest])


@pytest.mark.parametrize(("z", "good"), [(99.0, True), (101.0, False), (-109.0, True), (-111.0, False)])
def test_a_centre_of_gravity_may_lie_as_far_off_as_the_body_is_long(z, good):
    """Its wetted hull from −10 to 0 m, 100 m long"""
    if good:
        told(center_of_gravity=[0.0, 0.0, z])
        return
    out = z if z > 0 else -10 - z
    with pytest.raises(SceneError, match=rf"has z = {z:g} m, {out:g} m outside the wetted hull \(-10 to 0 m\)"):
        told(center_of_gravity=[0.0, 0.0, z])
