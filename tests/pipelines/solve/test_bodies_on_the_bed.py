"""Scenes with bodies on the bed, fixed: a pile alone, a barge before a caisson, a mesh without a bottom; refusals."""

import numpy as np
import pytest
from scipy.special import h1vp

from hakobune.bem.database import open_database
from hakobune.bem.waves import wavenumber
from hakobune.meshing.files import write_mesh
from hakobune.meshing.shapes import box
from hakobune.pipelines.checking import check
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.hull import make_hull
from hakobune.pipelines.solve.plan import planned
from hakobune.pipelines.solve.run import solve
from hakobune.pipelines.waves.result import waves

DEPTH, OMEGA, RADIUS = 9.0, 1.0, 3.0
PILE = {"shape": "buoy", "radius": RADIUS, "draft": DEPTH, "fixed": True}
BARGE = {"name": "barge", "length": 12.0, "beam": 5.0, "draft": 1.5, "place": [0.0, 6.5, 0.0],
         "gyration": [1.6, 3.6, 3.6]}  # fmt: skip
CAISSON = {"name": "caisson", "length": 10.0, "beam": 6.0, "draft": DEPTH, "place": [0.0, -1.0, 0.0], "fixed": True}


def scene(*bodies, **more):
    waves = {"omegas": [OMEGA], "headings_deg": [0.0, 70.0]}
    return make_scene({"water": {"depth": DEPTH}, "bodies": list(bodies), "waves": waves, **more})


def console():
    from rich.console import Console

    return Console(quiet=True)


@pytest.mark.parametrize(("more", "tolerance"), [({"method": "contour"}, 1e-9), ({"panels": 200}, 2e-3)])
def test_a_pile_alone_has_the_force_of_maccamy_and_fuchs(tmp_path, more, tolerance):
    """and what needs motions is left out, unless named"""
    path = tmp_path / "pile.h5"
    assert solve(scene(PILE, **more), path).exit_status == 0
    db, k = open_database(path), float(wavenumber(OMEGA, DEPTH))
    X = db["excitation_force"][0, 0]
    exact = 4 * 1025 * 9.80665 * np.tanh(k * DEPTH) / (k**2 * h1vp(1, k * RADIUS))
    assert abs(X[0] / exact - 1) < tolerance and abs(X[2]) < 1e-6 * abs(exact)
    assert "added_mass" not in db.names and "rao" not in db.names and "drift_force_fixed" in db.names
    assert db.displaced_volume == pytest.approx(np.pi * RADIUS**2 * DEPTH)
    assert db.waterplane_area == pytest.approx(np.pi * RADIUS**2)
    assert check(path, console()) == 0
    around = waves(path, omega=OMEGA, heading=0.0)  # of a fixed body, without asking
    assert around["body"] == "held" and 1.0 < around["place.height"][0] < 2.0
    with pytest.raises(SceneError, match="want has rao, but no body moves"):
        scene(PILE, want=["rao"])


def test_a_barge_before_a_caisson_by_panels_is_that_of_contours(tmp_path):
    """Forces, motions and the drift of each, whose sum is the far field's; panels on the wall of the caisson alone"""
    paths = [tmp_path / name for name in ("panels.h5", "contour.h5")]
    for path, more in zip(paths, ({"panels": 500}, {"method": "contour"}), strict=True):
        assert solve(scene(BARGE, CAISSON, **more), path).exit_status == 0
    one, two = map(open_database, paths)
    for name in ("added_mass", "excitation_force", "rao", "drift_force"):
        assert np.abs(one[name] - two[name]).max() < 5e-3 * np.abs(two[name]).max(), name
    assert not np.any(one["excitation_force"][..., 8])  # heave on the bed
    each, far = one["body_drift_force"][..., :2].sum(axis=2), one["drift_force"][..., :2]
    assert np.abs(each - far).max() < 2e-2 * np.abs(far).max()
    assert one.displaced_volume == pytest.approx([90.0, 540.0]) and two.displaced_volume == pytest.approx([90.0, 540.0])
    assert one.center_of_buoyancy[1] == pytest.approx([0.0, -1.0, -4.5])
    wall = one.mesh.of_body(1)
    assert np.abs(wall.normals[:, 2]).max() < 1e-12 and wall.volume == pytest.approx(540.0)


def test_all_bodies_of_a_scene_may_be_fixed(tmp_path):
    path = tmp_path / "piles.h5"
    piles = [{**PILE, "name": name, "place": [x, 0.0, 0.0]} for name, x in (("west", -5.0), ("east", 5.0))]
    assert solve(scene(*piles, method="contour"), path).exit_status == 0
    db = open_database(path)
    X = db["excitation_force"][0, 1]
    assert len(db["radiating_dof"]) == 0 and X.shape == (12,)
    assert check(path, console()) == 0


def test_a_mesh_without_a_bottom_stands_on_the_bed_if_it_is_fixed(tmp_path):
    hull = box(10.0, 6.0, DEPTH, bottom=False, panels=160)
    write_mesh(hull, tmp_path / "walls.gdf")
    table = {"shape": "mesh", "file": str(tmp_path / "walls.gdf")}
    plan = planned(scene({**table, "fixed": True}))
    assert plan.header.body["displaced_volume"] == pytest.approx(540.0)
    assert any("the hull stands on the sea bed" in said for said in plan.remarks)
    assert plan.header.lid.copies * plan.header.lid.areas.sum() == pytest.approx(60.0)
    with pytest.raises(SceneError, match="stands on the bed, z = -9 m, without a bottom, and cannot float; give fixed"):
        planned(scene(table))


def test_what_stands_in_a_caisson_is_refused():
    inside = {**PILE, "radius": 1.0, "name": "pile", "place": [0.0, -1.0, 0.0]}
    with pytest.raises(SceneError, match="caisson and pile overlap"):
        make_hull(scene(CAISSON, inside, panels=300))


def test_a_ship_does_not_stand_on_the_bed():
    with pytest.raises(SceneError, match=r"draft is 9.0 m in water 9.0 m deep; allowed: below the depth$"):
        scene({"shape": "ship", "length": 60.0, "beam": 12.0, "draft": DEPTH, "block": 0.8, "fixed": True})
