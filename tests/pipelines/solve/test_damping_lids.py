"""Damping lids of a scene: where they may lie, what a database says of them, and gaps that have none."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.stored_laws import broken_laws
from hakobune.meshing.shapes import box
from hakobune.meshing.surface.patches import moonpools
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.gaps.damping_lids import damping_lids_of
from hakobune.pipelines.solve.gaps.resonant_water import peak, resonant_water
from hakobune.pipelines.solve.hull import make_hull
from hakobune.pipelines.solve.result import solve

SIDE = {"shape": "box", "length": 12.0, "beam": 5.0, "draft": 1.5, "gyration": [1.6, 3.6, 3.6]}
GAP = [[-6, -0.5], [6, -0.5], [6, 0.5], [-6, 0.5]]


def tables(corners=GAP, damping=0.05, omegas=(1.8,), **more):
    bodies = [{**SIDE, "name": "a", "place": [0, 3, 0]}, {**SIDE, "name": "b", "place": [0, -3, 0]}]
    lids = [] if corners is None else [{"damping": damping, "corners": corners}]
    waves = {"omegas": list(omegas), "headings_deg": [90.0]}
    return {"water": {"depth": 9.0}, "bodies": bodies, "waves": waves, "panels": 200, "damping_lids": lids, **more}


def test_a_database_with_a_lid_keeps_its_laws_and_says_what_the_lid_takes(tmp_path):
    db = solve(tables(), tmp_path / "gap.h5")
    assert not broken_laws(db, 0.01)
    assert db.has_damping_lids and db.mesh.symmetry == "x"
    assert db["damping_lid_power"].shape == (1, 1) and db["damping_lid_power"][0, 0] > 0


def test_a_lid_off_the_middle_leaves_the_planes_that_it_has():
    """Bodies side by side share the plane x = 0 alone, and a lid on a part of their gap not that one"""
    hull = make_hull(make_scene(tables([[-6, -0.5], [2, -0.5], [2, 0.5], [-6, 0.5]])))
    assert hull.mesh.symmetry == "" and make_hull(make_scene(tables())).mesh.symmetry == "x"


@pytest.mark.parametrize(("change", "said"), [
    ({"corners": [[-6, -0.5], [6, -0.5], [6, 1.5], [-6, 0.5]]}, r"damping_lids\[0\] covers a hull at x = "),
    ({"corners": [[-6, -0.5], [6, -0.5], [0, -0.2], [-6, 0.5]]}, r"damping_lids\[0\]\.corners is not a convex polygon"),
    ({"corners": [[0, 0], [1, 0]]}, r"damping_lids\[0\]\.corners is not a convex polygon"),
    ({"damping": 0.0}, r"damping_lids\[0\]\.damping is 0\.0"),
    ({"wall": 9.0, "bodies": [{**SIDE}]}, "damping_lids and a wall are given"),
    ({"method": "contour", "bodies": [{**SIDE}], "panels": None}, "does not support damping lids"),
    ({"corners": None, "want": ["damping_lid_power"]}, "a scene with damping_lids;"),
])  # fmt: skip
def test_what_a_scene_may_not_say(change, said):
    with pytest.raises(SceneError, match=said):
        make_hull(make_scene(tables(**change)))


def test_a_lid_without_corners_needs_a_moonpool():
    scene = make_scene({**tables(), "damping_lids": [{"damping": 0.05}]})
    with pytest.raises(SceneError, match="no body has a moonpool"):
        damping_lids_of(scene, box(12, 5, 1.5, panels=40))


def test_a_moonpool_is_found_and_named(tmp_path):
    """4 × 3 m in a draft of 2 m: ω² = g/(2 + 0.41 √12), T = 3.71 s by Fukuda's formula of deep water"""
    (tmp_path / "barge.toml").write_text(MOONPOOL)
    body = {"shape": "mesh", "file": str(tmp_path / "barge.toml")}
    alone = tables(None, omegas=(1.2, 2.0), bodies=[body], panels=None)
    said = [line for line in make_hull(make_scene(alone)).findings if "resonates" in line]
    assert len(said) == 1 and said[0].startswith("the water of the moonpool of 12 m² resonates near T = ")
    assert float(said[0].partition("T = ")[2].split()[0]) == pytest.approx(3.71, rel=0.02)
    assert "too large, with the hull held 11 times the wave; give [[damping_lids]]" in said[0]
    lidded = make_scene({**alone, "damping_lids": [{"damping": 0.05}]})
    hull = make_hull(lidded)
    assert not [line for line in hull.findings if "resonates" in line]
    (lid,) = damping_lids_of(lidded, hull.mesh)
    assert np.ptp(lid.corners, axis=0) == pytest.approx([4, 3]) and hull.mesh.symmetry == "xy"


def test_a_moonpool_over_a_low_gap_is_slower_and_beside_a_wall_known_by_the_formula_alone(tmp_path):
    """0.4 m under the keel: the water below moves sideways with it, and its period is half as long again"""
    (tmp_path / "barge.toml").write_text(MOONPOOL)
    low = {**tables(None, bodies=[{"shape": "mesh", "file": str(tmp_path / "barge.toml")}], panels=None)}
    low |= {"water": {"depth": 2.4}}

    def period(omegas, **more):
        found = make_hull(make_scene(low | {"waves": {"omegas": omegas, "headings_deg": [0.0]}} | more)).findings
        return [float(text.partition("T = ")[2].split()[0]) for text in found if "moonpool" in text]

    assert period([0.9, 1.2]) == [pytest.approx(5.7, abs=0.2)] and period([1.5, 2.0]) == []
    assert period([1.5, 2.0], wall=9.0) == [pytest.approx(3.71, abs=0.01)]


def test_the_moonpool_of_one_of_several_bodies_is_named_with_its_body(tmp_path):
    (tmp_path / "barge.toml").write_text(MOONPOOL)
    hull = {"shape": "mesh", "file": str(tmp_path / "barge.toml"), "name": "hull", "place": [0, 0, 0]}
    both = tables(None, omegas=(1.2, 2.0), bodies=[hull, {**SIDE, "name": "b", "place": [0, 20, 0]}], panels=None)
    (said,) = [text for text in make_hull(make_scene(both)).findings if "moonpool" in text]
    assert said.startswith("the water of the moonpool of 12 m² in hull resonates near T = 3.7")
    assert "with the hull held alone 11 times the wave" in said


def test_a_waterline_that_does_not_close_is_left_to_the_findings_of_the_mesh():
    """Of the panels of a box on one side alone nothing is said of moonpools, and nothing is raised"""
    whole = box(12, 5, 1.5, panels=200).whole()
    open_hull = replace(whole, corners=whole.corners[whole.centroids[:, 1] > 0])
    with pytest.raises(ValueError, match="waterline"):
        moonpools(open_hull)
    assert resonant_water(make_scene(tables(None)), open_hull) == ()


@pytest.mark.parametrize(("omegas", "named"), [((1.0, 2.5), True), ((0.3, 0.9), False)])
def test_a_gap_without_a_lid_is_named_where_its_resonance_is_among_the_waves(omegas, named):
    """b = 1, d = 1.5, B = 11 m: 3.19 s by ω² = g/(1.5 + (1.5 + ln 5.5)/π) of deep water, 3.31 s by two sections"""
    said = [line for line in make_hull(make_scene(tables(None, omegas=omegas))).findings if "resonates" in line]
    assert bool(said) == named
    assert not named or said[0].startswith("the water between a and b, 1 m wide, resonates near T = 3.31 s")


MOONPOOL = """
size = 1.0
symmetry = "xy"
[[parts]]
shape = "box"
center = [0, 0, 0]
size = [12, 8, 4]
[[parts]]
shape = "box"
center = [0, 0, 0]
size = [4, 3, 8]
cut = true
"""


def test_the_gap_of_saitoh_is_named_with_its_period_and_rise():
    """Two sections of 0.5 × 0.252 m, 0.05 m apart in 0.5 m of water: kh 1.571 and 18.0 times the wave without losses"""
    omega, rise = peak(0.05, 0.252, 0.5, 0.5, 5.6, 9.81)
    kh = 1.571
    assert omega == pytest.approx(np.sqrt(9.81 * kh / 0.5 * np.tanh(kh)), rel=1e-3)
    assert rise == pytest.approx(18.0, rel=0.01)
    assert peak(0.05, 0.252, 0.5, 0.25, 5.6, 9.81) is None


def test_before_a_caisson_the_gap_counts_twice():
    """with the image of the barge in its wall"""
    raft = {"length": 12.0, "beam": 5.0, "draft": 2.0, "gyration": [1, 3, 3]}
    place = {"name": "raft", "place": [0.0, 3.0, 0.0]}, {"name": "wall", "place": [0.0, -4.5, 0.0]}
    caisson = {"length": 30.0, "beam": 9.0, "draft": 8.0, "fixed": True}
    both = [raft | place[0], caisson | place[1]]
    tables = {"water": {"depth": 8.0}, "bodies": both, "waves": {"omegas": [1.0, 2.5]}, "panels": 300}
    (said,) = [text for text in make_hull(make_scene(tables)).findings if "resonates" in text]
    omega, rise = peak(1.0, 2.0, 5.0, 8.0, 1.8, 9.80665)
    assert said.startswith(f"the water between raft and wall, 0.5 m wide, resonates near T = {2 * np.pi / omega:.3g} s")
    assert f"as long hulls {rise:.2g} times the wave" in said
