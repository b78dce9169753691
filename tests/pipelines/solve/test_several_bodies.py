"""A scene of several bodies from its tables to its database, and what it may not say."""

import tomllib

import h5py
import numpy as np
import pytest

from hakobune.bem.bodies.one_of_several import body_named, each_body
from hakobune.bem.database import DatabaseError, open_database
from hakobune.bem.formats import capytaine, wamit
from hakobune.bem.formats.values import values_of
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.modes import Body
from hakobune.bem.viscous_table import viscous_of_text
from hakobune.meshing.files import read_mesh
from hakobune.meshing.shapes import box
from hakobune.pipelines.checking import check
from hakobune.pipelines.common.typed import to_toml
from hakobune.pipelines.exchange.command import export
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.scene.viscous_table import viscous_of
from hakobune.pipelines.solve.arrangement import _gap, arranged, own_hulls
from hakobune.pipelines.solve.hull import coarse_hull, finer_hull, make_hull
from hakobune.pipelines.solve.plan import planned
from hakobune.pipelines.solve.run import solve
from hakobune.pipelines.sweep.solved import solved

BARGE = {"name": "barge", "shape": "box", "length": 12.0, "beam": 5.0, "draft": 1.5, "place": [0.0, 4.0, 0.0],
         "gyration": [1.6, 3.6, 3.6], "center_of_gravity": [0, 0, 0.2], "rotation_center": [0.0, 0.0, 0.2]}  # fmt: skip
PIER = {"name": "pier", "shape": "box", "length": 6.0, "beam": 2.0, "draft": 4.0, "place": [1.0, -4.0, 90.0],
        "fixed": True}  # fmt: skip


def tables(*bodies, **more):
    waves = {"omegas": [1.0, 1.4], "headings_deg": [0.0, 60.0]}
    whole = {"water": {"depth": 9.0}, "bodies": list(bodies or (BARGE, PIER)), "waves": waves, "panels": 120, **more}
    return {key: value for key, value in whole.items() if value is not None}


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("several") / "quay.h5"
    outcome = solve(make_scene(tables()), path)
    assert outcome.exit_status == 0
    return path


def test_names_axes_and_bodies_of_the_database(database):
    db = open_database(database)
    assert list(db["radiating_dof"]) == [f"barge__{d}" for d in ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")]
    assert len(db["influenced_dof"]) == 12 and db["influenced_dof"][6] == "pier__Surge"
    assert list(db["body"]) == ["barge", "pier"]
    assert db["added_mass"].shape == (2, 12, 6) and db["rao"].shape == (2, 2, 6)
    assert db["added_mass_infinity"].shape == (12, 6) and db["kochin_radiation"].shape[1] == 6
    barge, pier = db.bodies
    assert (
        barge == Body("barge", (0.0, 4.0, 0.2), place=(0.0, 4.0))
        and pier.fixed
        and pier.heading == pytest.approx(np.pi / 2)
    )
    assert db.complete and check(database, _console()) == 0


def test_rest_of_each_by_hand(database):
    """Displaced 12·5·1.5 and 6·2·4 m³, ρgA and ρg∫y²dA, and the coordinates of the scene for places"""
    db = open_database(database)
    assert db.displaced_volume == pytest.approx([90.0, 48.0]) and db.mass == pytest.approx([1025 * 90, 1025 * 48])
    assert db.center_of_buoyancy == pytest.approx(np.array([[0, 4, -0.75], [1, -4, -2.0]]))
    assert db.center_of_mass[0] == pytest.approx([0, 4, 0.2])
    rho_g = 1025 * 9.80665
    C = db.hydrostatic_stiffness
    assert C.shape == (12, 6) and C[2, 2] == pytest.approx(rho_g * 60) and not C[6:].any()
    assert C[3, 3] == pytest.approx(rho_g * (12 * 5**3 / 12 + 90 * (-0.75 - 0.2)))
    assert db.inertia_matrix[4, 4] == pytest.approx(1025 * 90 * 3.6**2)


def test_one_of_several_has_its_own_forces_and_motions(database):
    db = open_database(database)
    barge, pier = each_body(db)
    assert barge["added_mass"].shape == (2, 6, 6) and pier["excitation_force"].shape == (2, 2, 6)
    assert np.array_equal(pier["excitation_force"], db["excitation_force"][..., 6:])
    assert "rao" in barge.names and "rao" not in pier.names
    assert np.array_equal(pier["drift_force"], db["body_drift_force"][:, :, 1]) and "drift_force" in pier.names
    assert pier.mesh.volume == pytest.approx(48.0) and barge.inertia_matrix.shape == (6, 6)
    assert body_named(db, "pier").fixed
    with pytest.raises(DatabaseError, match=r"no body 'ship'; allowed: barge, pier"):
        body_named(db, "ship")


def test_what_takes_one_body_says_so(database):
    for taken in (lambda db: db.reader, values_of):
        with pytest.raises(DatabaseError, match=r"contains 2 bodies, barge, pier; allowed here: one body"):
            taken(open_database(database))


def test_capytaine_has_all_bodies_along_the_axes_of_the_scene(database, tmp_path):
    """The pier heads 90°: its own surge is along y, its own sway against x"""
    db, place = open_database(database), tmp_path / "quay.nc"
    capytaine.write(values_of(db, several=True), place)
    with h5py.File(place) as file:
        assert file["influenced_dof"].asstr()[6] == "pier__Surge" and file["added_mass"].shape == (2, 12, 6)
        F = file["excitation_force"][..., 0] + 1j * file["excitation_force"][..., 1]
        A = file["added_mass"][()]
        assert file["rotation_center"][1].tolist() == [1.0, -4.0, 0.0] and file["disp_mass"].shape == (2,)
    own = db["excitation_force"]
    assert F[..., :6] == pytest.approx(own[..., :6]) and F[..., 8] == pytest.approx(own[..., 8])
    assert F[..., 6] == pytest.approx(-own[..., 7]) and F[..., 7] == pytest.approx(own[..., 6])
    assert A[:, 6] == pytest.approx(-db["added_mass"][:, 7]) and A[:, :6] == pytest.approx(db["added_mass"][:, :6])
    barge = capytaine.read(place, {"body": 1})
    assert barge.quantities["added_mass"] == pytest.approx(db["added_mass"][:, :6])
    assert barge.body["mass"] == pytest.approx(1025 * 90) and barge.rotation_center == pytest.approx([0, 4, 0.2])
    with pytest.raises(ValueError, match="which --to orcaflex cannot write; allowed: --to wamit, nemoh, hams, bemio"):
        export(database, "orcaflex", None, False)


def test_wamit_numbers_the_modes_of_all_bodies_on(database, tmp_path):
    """The pier, which does not move, has modes 7 to 12 of forces alone: 90° turned, its force 7 is −that of its sway"""
    db, place = open_database(database), tmp_path / "quay.1"
    assert export(database, "wamit", place, False) == 0
    water = {"density": 1025.0, "gravity": db.gravity, "water_depth": 9.0, "length_unit": 1.0}
    barge = wamit.read(place, {**water, "body": 1, "rotation_center": (0.0, 4.0, 0.2)})
    assert barge.quantities["added_mass"] == pytest.approx(db["added_mass"][:, :6], rel=1e-5, abs=1.0)
    assert barge.quantities["rao"] == pytest.approx(db["rao"], rel=1e-5, abs=1e-6)
    rows = np.loadtxt(tmp_path / "quay.3")
    there = rows[(rows[:, 2] == 7) & np.isclose(rows[:, 0], 2 * np.pi / 1.4) & np.isclose(rows[:, 1], 60.0)][0]
    exact = np.conj(-db["excitation_force"][1, 1, 7]) / (1025 * db.gravity)
    assert there[5] + 1j * there[6] == pytest.approx(exact, rel=1e-5)
    pier = read_mesh(tmp_path / "quay_pier.gdf")
    assert np.abs(pier.whole().points).max(axis=0) == pytest.approx([1.0, 3.0, 4.0])  # along the axes of the scene


def test_a_sweep_keeps_the_axes_of_several(tmp_path):
    status, _, arrays, axes = solved({**tables(), "want": ["radiation"]}, tmp_path / "scene.toml")
    assert status == 0 and axes["influenced_dof"].values[6] == "pier__Surge"
    assert arrays["added_mass"].axes == ("frequency", "influenced_dof", "radiating_dof")
    assert arrays["mass"].axes == ("body",) and arrays["mass"].values[1] == pytest.approx(1025 * 48)


def test_more_frequencies_and_another_weight(database, tmp_path):
    path = tmp_path / "more.h5"
    path.write_bytes(database.read_bytes())
    wider = tables(waves={"omegas": [1.0, 1.2, 1.4], "headings_deg": [0.0, 60.0]})
    assert solve(make_scene(wider), path).solved == 1
    before = open_database(path)["rao"]
    heavier = tables({**BARGE, "gyration": [1.6, 3.9, 3.9]}, PIER, waves=wider["waves"])
    assert solve(make_scene(heavier), path).solved == 3  # the drift of each body needs the flow on it
    assert not np.allclose(before, open_database(path)["rao"])
    moved = tables({**BARGE, "place": [0.0, 4.5, 0.0]}, PIER, waves=wider["waves"])
    with pytest.raises(SceneError, match=r"another scene: .*bodies\[0\]\.place was \(0\.0, 4\.0, 0\.0\), is"):
        solve(make_scene(moved), path)


def test_the_text_of_a_scene_reads_back():
    scene = make_scene(tables())
    assert make_scene(tomllib.loads(to_toml(scene))) == scene


def test_each_hull_comes_back_from_its_place():
    """A quarter of box and pier, whatever planes the whole has"""
    scene = make_scene(tables())
    hulls = own_hulls(scene, make_hull(scene).mesh)
    assert [hull.symmetry for hull in hulls] == ["xy", "xy"]
    assert np.abs(hulls[1].points).max(axis=0) == pytest.approx([3.0, 1.0, 4.0])
    assert arranged(scene, hulls).volume == pytest.approx(138.0)


@pytest.mark.parametrize(
    ("places", "planes"),
    [([[0, 4, 0], [0, -4, 90]], "x"), ([[9, 0, 180], [-9, 0, 0]], "y"), ([[9, 1, 0], [0, -4, 0]], ""),
     ([[9, 0, 30], [-9, 0, 0]], "")],
)  # fmt: skip
def test_mirror_planes_are_those_of_every_body_in_its_place(places, planes):
    bodies = [{**body, "place": place} for body, place in zip((BARGE, PIER), places, strict=True)]
    assert make_hull(make_scene(tables(*bodies))).mesh.symmetry == planes


def test_coarser_and_finer_meshes_of_all_bodies():
    """About half and twice as many panels, for the estimate and for frequencies that miss the tolerance"""
    scene = make_scene({**tables(tolerance=0.02), "panels": None})
    hull = make_hull(scene)
    coarse, cover = coarse_hull(scene, hull.mesh, hull.lid)
    finer, _ = finer_hull(scene)(hull.mesh, hull.lid)
    assert 0.35 < coarse.total / hull.mesh.total < 0.8 and 1.6 < finer.total / hull.mesh.total < 2.6
    assert coarse.bodies == finer.bodies == 2 and cover.symmetry == coarse.symmetry
    assert coarse.volume == pytest.approx(138.0) and finer.volume == pytest.approx(138.0)


def test_each_body_has_its_own_viscous_damping():
    """By hand: 8/(3π) ω a N₂ of the tug's roll, and nothing else; the text of the scene says the same"""
    tug = {**BARGE, "name": "tug", "place": [0.0, 14.0, 0.0], "viscous": {"roll": {"drag": 2e5}}}
    scene = make_scene(tables(BARGE, PIER, tug, viscous={"wave_height": 1.0}))
    for found in (viscous_of(scene), viscous_of_text(to_toml(scene), {}, 1025.0, 9.81)):
        damping = found.damping(1.5, np.full(12, 0.1))
        assert damping[9, 9] == pytest.approx(8 / (3 * np.pi) * 1.5 * 0.1 * 2e5) and np.count_nonzero(damping) == 1
        assert found.wave_amplitude == 0.5


FAULTS = {
    "no waves for it": (({**BARGE, "viscous": {"roll": {"drag": 1e5}}}, PIER), "give wave_height under [viscous]"),
    "of what is fixed": ((BARGE, {**PIER, "viscous": {"roll": {"drag": 1e5}}}), "pier does not move"),
    "no name": (({**BARGE, "name": None}, PIER), "bodies[0].name is None"),
    "two of a name": ((BARGE, {**PIER, "name": "barge"}), "two bodies named 'barge'"),
    "a name of two words": (({**BARGE, "name": "my barge"}, PIER), "a word of letters"),
    "no place": (({**BARGE, "place": None}, PIER), "bodies[0].place is missing"),
    "a far heading": (({**BARGE, "place": [0, 4, 400]}, PIER), "heading 400"),
    "deeper than the water": ((BARGE, {**PIER, "draft": 9.1}), "bodies[1].draft is 9.1 m in water 9.0 m deep"),
    "afloat on the bed": (({**BARGE, "draft": 9.0}, PIER), "or 9 of a body that stands on the bed, which needs fixed"),
    "place of one body": (
        ({**BARGE, "rotation_center": None},),
        "bodies[0].place is [0.0, 4.0, 0.0], but there is one",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_a_scene_of_several_may_not_say_is_one_line(name):
    bodies, said = FAULTS[name]
    with pytest.raises(SceneError) as error:
        make_scene(tables(*bodies))
    assert said in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("more", "said"),
    [({"method": "strip", "panels": None}, "supports one body only"),
     ({"method": "contour", "panels": None, "damping_lids": [{"damping": 0.05}]}, "does not support damping lids"),
     ({"method": "contour"}, "has no panels"),
     ({"method": "transfer", "panels": None}, "needs circles around the bodies that are 0.18 m apart; the circles "
      "around barge "
      "and pier overlap by 1.6 m; method panel or contour can"),
     ({"method": "transfer", "panels": None, "bodies": [{"shape": "buoy", "radius": 1.0, "draft": 2.0}]},
      "is for several"),
     ({"want": ["body_drift_force"], "wall": 20.0}, "which is not computed beside a wall"),
     ({"want": ["body_drift_force"], "method": "contour", "panels": None}, "which method contour does not compute"),
     ({"rotation_center": [1.0, 0, 0]}, "give it under [[bodies]]"),
     ({"waves": {"xi_B": [0.5]}}, "needs one body with a beam"),
     ({"viscous": {"wave_height": 1.0}}, "no body has a damping law"),
     ({"viscous": {"wave_height": 1.0, "roll": {"drag": 1.0}}}, "give it under [bodies.viscous] of each")],
)  # fmt: skip
def test_what_several_bodies_do_not_have_is_refused(more, said):
    with pytest.raises(SceneError) as error:
        make_scene(tables(**more))
    assert said in str(error.value)


def test_bodies_on_both_sides_of_a_wall_are_named():
    """The barge is from y = 1.5 to 6.5, the pier from −7 to −1, its 6 m along y"""
    with pytest.raises(SceneError, match=r"pier extends from y = -7 to -1 m, and the wall is at y = 0 m; allowed: all"):
        make_hull(make_scene(tables(wall=0.0)))
    with pytest.raises(SceneError, match=r"barge extends from y = 1.5 to 6.5 m, and the wall is at y = 6"):
        make_hull(make_scene(tables(wall=6.0)))


def test_a_scene_beside_a_wall_has_no_far_field(tmp_path):
    path = tmp_path / "wall.h5"
    assert solve(make_scene(tables(wall=-9.0, panels=60)), path).exit_status == 0
    names = open_database(path).names
    assert "excitation_force" in names and not {"drift_force", "body_drift_force", "kochin_radiation"} & set(names)


def test_a_band_of_two_boxes_by_contours_is_within_its_tolerance(tmp_path):
    """Frequencies that the program places; between them at 1.27 rad/s what is solved there"""
    path, raw = tmp_path / "band.h5", tables(method="contour", panels=None, want=["radiation", "diffraction"])
    raw["waves"] = {"band": {"from": 1.1, "to": 1.4}, "headings_deg": [0.0, 60.0]}
    assert solve(make_scene(raw), path).exit_status == 0
    raw["waves"] = {"omegas": [1.27], "headings_deg": [0.0, 60.0]}
    there = planned(make_scene(raw)).problem
    known = solve_frequency(there.prepared(), 1.27, np.radians([0.0, 60.0]), {"added_mass", "excitation_force"})
    reader = open_database(path).bodies_reader
    added, force = (reader.at([1.27], name)[0][0] for name in ("added_mass", "excitation_force"))
    whole = known["added_mass"][:6]
    assert added == pytest.approx(whole, abs=0.01 * np.abs(whole).max())
    assert force == pytest.approx(known["excitation_force"][:, :6], abs=0.01 * np.abs(known["excitation_force"]).max())
    assert len(open_database(path).omega) < 25


@pytest.mark.parametrize(
    ("place", "said"),
    [([0.0, 3.0, 0.0], "barge and other overlap"), ([0.0, -1.0, 0.0], "barge and other touch")],
)
def test_bodies_that_overlap_or_touch_are_named(place, said):
    """Boxes 5 m wide about y = 4 and 3, and about 4 and −1, which share a side"""
    other = {**BARGE, "name": "other", "place": place}
    with pytest.raises(SceneError, match=said):
        make_hull(make_scene(tables(BARGE, other)))


def test_a_gap_narrower_than_its_panels_is_said():
    other = {**BARGE, "name": "other", "place": [0.0, -1.05, 0.0]}
    found = make_hull(make_scene(tables(BARGE, other))).findings
    assert any("barge and other are 0.05 m apart" in line for line in found)


def test_the_distance_of_two_boxes():
    """Sides 3 m apart; corners 3 m and 4 m apart in plan are 5 m"""
    one, other = box(12.0, 5.0, 1.5, panels=60).whole(), box(6.0, 2.0, 4.0, panels=60).whole()
    assert _gap(one, other.moved(dy=6.5))[0] == pytest.approx(3.0)
    assert _gap(one, other.moved(dx=12.0, dy=7.5))[0] == pytest.approx(5.0)


def test_weight_is_judged_body_by_body():
    """A centre of gravity a metre off turns the barge, and says which body it is of"""
    with pytest.raises(SceneError, match=r"^barge: center_of_gravity is 1 m off the centre of buoyancy in x"):
        planned(make_scene(tables({**BARGE, "center_of_gravity": [1.0, 0, 0.2]}, PIER)))
    remarks = planned(make_scene(tables({**BARGE, "mass": 80e3}, PIER))).remarks
    assert any(line.startswith("barge: the mass is 80000 kg, but the body displaces") for line in remarks)
    assert not any(line.startswith("pier: ") for line in remarks)


def _console():
    from rich.console import Console

    return Console(quiet=True)


def test_too_few_panels_are_refused_once_with_the_number_that_works():
    """A box takes 20; of 111 and 76 m² the pier has 0.4064 of the panels, 19.5 of them of 47.98"""
    with pytest.raises(SceneError, match="panels is 12; allowed: 48 to 100000"):
        make_hull(make_scene(tables(panels=12)))
    assert make_hull(make_scene(tables(panels=48))).mesh.total >= 40


BUOYS = [{"name": f"b{i}", "shape": "buoy", "radius": 1.0, "draft": 2.0, "place": [4.0 * i, 1.0 * (i % 2), 0.0]}
         for i in range(10)]  # fmt: skip


def test_ten_bodies_far_from_each_other_are_solved_shape_by_shape(tmp_path):
    """By transfer matrices as the file says, the drift of each among the results"""
    path = tmp_path / "ten.h5"
    bodies = [{**one, "gyration": [1.0, 1.0, 1.0]} for one in BUOYS]
    assert solve(make_scene(tables(*bodies, panels=None)), path).exit_status == 0
    db = open_database(path)
    assert db.attributes["method"] == "transfer" and db["body_drift_force"].shape == (2, 2, 10, 3)
    assert db.complete and check(path, _console()) == 0


def test_two_bodies_are_solved_shape_by_shape_too_unless_their_circles_overlap():
    assert make_scene(tables(*BUOYS[:2], panels=None)).solved_by == "transfer"
    assert make_scene(tables(*BUOYS[:2])).solved_by == "panel"
    assert make_scene(tables(panels=None)).solved_by == "panel"  # 8.06 m from axis to axis, radii 6.5 and 3.16 m


@pytest.mark.parametrize(
    "more", [{"panels": 1000}, {"wall": 20.0}, {"water": {"depth": float("inf")}}, {"method": "panel"}]
)
def test_ten_bodies_that_transfer_matrices_do_not_know_are_solved_on_panels(more):
    assert make_scene(tables(*BUOYS, **({"panels": None} | more))).solved_by == "panel"


def test_ten_bodies_that_are_near_are_solved_on_panels():
    """Circles of 1 m whose axes are 1.9 m apart"""
    near = [{**BUOYS[0], "name": f"b{i}", "place": [4.0 * i - 2.1 * (i == 9), 0.0, 0.0]} for i in range(10)]
    assert make_scene(tables(*near, panels=None)).solved_by == "panel"
