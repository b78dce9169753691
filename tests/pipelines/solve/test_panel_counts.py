"""Panels for a tolerance, and the coarse mesh beside them."""

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.checks import ERROR_ORDER
from hakobune.bem.methods.panel_problem import prepare
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.shapes import box
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.hull import MOST_REFINED, coarse_hull, finer_hull, make_hull
from hakobune.pipelines.solve.panel_counts import (
    coarse_counts,
    counts_of,
    fine_counts,
    finer_counts,
    meshed,
    panels_for,
)
from hakobune.pipelines.solve.plan import planned

BODIES = {
    "series box": {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0},
    "barge": {"shape": "box", "length": 400.0, "beam": 40.0, "draft": 2.0},
    "across": {"shape": "box", "length": 30.0, "beam": 90.0, "draft": 16.0},
    "buoy": {"shape": "buoy", "radius": 10.0, "draft": 10.0},
    "pile": {"shape": "buoy", "radius": 3.0, "draft": 20.0},
}


def scene_of(body, **more):
    raw = {"water": {"depth": 30.0}, "bodies": [body], "waves": {"omegas": [0.3]}, "method": "panel", **more}
    return make_scene(raw)


@pytest.fixture(params=BODIES)
def body(request):
    return scene_of(BODIES[request.param]).body


def test_panels_grow_as_the_order_of_the_error_asks(body):
    assert panels_for(body, 0.001) / panels_for(body, 0.01) == pytest.approx(10 ** (1 / ERROR_ORDER), rel=0.01)
    assert 250 <= panels_for(body, 0.01) <= 385


def test_boxes_longer_than_those_that_were_measured_take_as_many_panels_as_the_longest_of_them():
    counts = [
        panels_for(scene_of({"shape": "box", "length": 20.0 * ratio, "beam": 20.0, "draft": 8.7}).body, 0.01)
        for ratio in (2, 5, 7, 20, 100)
    ]
    assert counts[0] < counts[1] < counts[2] == counts[3] == counts[4]


def test_a_long_box_that_rolls_without_moving_much_water_keeps_the_tolerance_in_roll():
    size, depth, omega = (350.0, 50.0, 21.2), 37.5, 0.032
    body = dict(zip(("length", "beam", "draft"), size, strict=True))
    waves = {"omegas": [omega]}
    scene = scene_of({"shape": "box", **body}, water={"depth": depth}, tolerance=0.01, waves=waves)
    panels = planned(scene).problem
    exact = ShapeProblem(method="contour", shape="box", sizes=size, depth=depth, tolerance=1e-5)
    runs = (prepare(problem).run(omega, [0.0], ("added_mass",), None, DOFS[3:4]) for problem in (panels, exact))
    found, true = (run.result()["added_mass"][3, 3] for run in runs)
    assert abs(found / true - 1) <= scene.accuracy


def test_counts_are_read_back_from_the_mesh(body):
    counts = fine_counts(body, 0.01, np.inf)
    mesh = meshed(body, counts)
    assert counts_of(body, mesh) == counts
    assert min(counts) >= 3


def test_counts_of_a_ship_are_read_back_from_its_mesh():
    ship = scene_of({"shape": "ship", "length": 300.0, "beam": 50.0, "draft": 18.0, "block": 0.83}).body
    assert counts_of(ship, meshed(ship, (20, 5, 6))) == (20, 5, 6)
    assert coarse_counts(ship, meshed(ship, (20, 5, 6))) == (14, 4, 4)
    for counts in ((2, 3, 2), (2, 2, 3)):  # 2 · (2 + 2) of 2 · (3 + 2) panels are the 80 % that are still coarser
        assert coarse_counts(ship, meshed(ship, counts)) == (2, 2, 2)
    assert coarse_counts(ship, meshed(ship, (2, 2, 2))) is None


def test_no_edge_is_longer_than_waves_allow(body):
    longest = body.draft / 3
    mesh = meshed(body, fine_counts(body, 0.05, longest))
    corners = mesh.points[mesh.corners]
    edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    assert edges.max() <= longest * 1.05  # of a buoy the corners stand out a little


@pytest.mark.parametrize("tolerance", [0.02, 0.01, 0.003])
def test_the_coarse_mesh_has_about_half_the_panels_in_the_same_proportion(body, tolerance):
    fine = fine_counts(body, tolerance, np.inf)
    mesh = meshed(body, fine)
    coarse = coarse_counts(body, mesh)
    assert 0.35 <= meshed(body, coarse).total / mesh.total <= 0.7
    assert all(2 <= c < n for c, n in zip(coarse, fine, strict=True))


def test_the_finer_mesh_has_about_twice_the_panels_in_the_same_proportion(body):
    fine = fine_counts(body, 0.01, np.inf)
    mesh = meshed(body, fine)
    finer = finer_counts(body, mesh)
    assert 1.7 <= meshed(body, finer).total / mesh.total <= 2.4
    assert all(c > n for c, n in zip(finer, fine, strict=True))


def test_finer_meshes_end_where_full_equations_get_large():
    scene = scene_of(BODIES["series box"])
    hull = make_hull(scene)
    finer, mesh, lid, totals = finer_hull(scene), hull.mesh, hull.lid, []
    while (found := finer(mesh, lid)) is not None:
        mesh, lid = found
        assert lid is not None
        totals.append(mesh.total)
    assert len(totals) == 3 and MOST_REFINED / 2.4 < totals[-1] <= MOST_REFINED


def test_a_mesh_too_coarse_to_be_halved_has_no_estimate():
    few = scene_of(BODIES["series box"], panels=48)
    assert coarse_hull(few, make_hull(few).mesh, None) is None
    more = scene_of(BODIES["series box"], panels=104)
    hull = make_hull(more)
    mesh, lid = coarse_hull(more, hull.mesh, hull.lid)
    assert mesh.total < 104 and lid is not None


def test_lids_have_panels_in_proportion_to_those_of_their_hulls():
    """Whatever the waves ask of the lid of the mesh itself: what both lids have alike would show no error"""
    scene = scene_of(BODIES["series box"], tolerance=0.002, waves={"omegas": [1.5]})
    hull, finer = make_hull(scene), finer_hull(scene)
    for mesh, lid in (coarse_hull(scene, hull.mesh, hull.lid), finer(hull.mesh, hull.lid)):
        assert len(lid) / len(hull.lid) == pytest.approx(mesh.total / hull.mesh.total, rel=0.25)
    assert coarse_hull(scene, hull.mesh, None)[1] is None and finer(hull.mesh, None)[1] is None


def test_the_counts_of_an_asked_number_of_panels_are_those_of_its_mesh():
    scene = scene_of(BODIES["series box"], panels=300)
    mesh = make_hull(scene).mesh
    same = box(100.0, 50.0, 10.0, counts=counts_of(scene.body, mesh))
    np.testing.assert_allclose(np.sort(same.points, axis=0), np.sort(mesh.points, axis=0), atol=1e-6)


@pytest.mark.parametrize("breadth, ratio", [(20.0, 1.0), (20.0, 4.0), (60.0, 4.0), (20.0, 9.0), (5.0, 6.0)])
def test_panels_of_a_box_grow_with_its_length_most_where_it_is_2_3_times_as_broad_as_deep(breadth, ratio):
    """290 + 50 (L/B − 2)/(1 + {5 log₁₀(B/2.3 d)}²), L/B from 2 to 7, for one per cent; whichever side is the longer"""
    d = 20.0 / 2.3
    wanted = 290 + 50 * (min(max(ratio, 2), 7) - 2) / (1 + (5 * np.log10(breadth / (2.3 * d))) ** 2)
    for sides in ((breadth, ratio * breadth), (ratio * breadth, breadth)):
        body = scene_of({"shape": "box", "length": sides[0], "beam": sides[1], "draft": d}).body
        assert panels_for(body, 0.01) == np.ceil(round(wanted, 9))
