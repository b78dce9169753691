"""Distances of hulls beside each other, walls, panels for waves and what a run is: by hand, on few panels."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing.quality import Finding
from hakobune.meshing.shapes import box
from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.solve import arrangement, hull, run

SQUARE = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]])


@pytest.mark.parametrize(("point", "distance"), [
    ((1, 1, 3), 3), ((1.9, 0.1, -2), 2), ((3, 1, 0), 1), ((-1, 1, 0), 1), ((1, -2, 0), 2), ((1, 5, 0), 3),
    ((5, 6, 0), 5), ((-3, -4, 0), 5), ((5, 1, 4), 5), ((3, 3, 0), math.sqrt(2)), ((2, 3, 1), math.sqrt(2)),
    ((1, 1, 0), 0),
])  # fmt: skip
def test_the_distance_from_a_panel_is_to_its_plane_above_it_and_to_its_sides_elsewhere(point, distance):
    normal = np.array([[[0.0, 0.0, 1.0]]])
    found = arrangement._distance(np.array([[point]], float), SQUARE[None, None], normal)
    assert found.shape == (1, 1) and found[0, 0] == pytest.approx(distance)


def test_a_triangle_has_one_side_without_length():
    corners = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 2, 0]])[None, None]
    normal = np.array([[[0.0, 0.0, 1.0]]])
    for point, distance in (((0.5, 0.5, 2), 2), ((2, 2, 0), math.sqrt(2)), ((-1, 3, 0), math.sqrt(2)), ((1, -3, 4), 5)):
        assert arrangement._distance(np.array([[point]], float), corners, normal)[0, 0] == pytest.approx(distance)


ONE = box(20.0, 10.0, 5.0, panels=200).whole()


def beside(dx=0.0, dy=0.0, of=ONE):
    return of.moved(dx=dx, dy=dy)


@pytest.mark.parametrize(
    ("dx", "dy", "gap"), [(0, 12, 2), (0, -12, 2), (23, 0, 3), (-23, 0, 3), (23, 14, 5), (0, 10, 0)]
)
def test_the_gap_of_two_boxes_is_that_of_their_sides_or_edges(dx, dy, gap):
    least, size = arrangement._gap(ONE, beside(dx, dy))
    assert least == pytest.approx(gap, abs=1e-9) and 0 < size <= ONE.sizes.max() + 1e-9


@pytest.mark.parametrize(
    ("dx", "dy", "far"),
    [
        (0, 10 + 4.9, False),
        (0, 10 + 5.3, True),
        (0, -10 - 5.3, True),
        (20 + 4.9, 0, False),
        (20 + 5.3, 0, True),
        (0, 0, False),
        (20 + 3.6, 10 + 3.6, True),
        (20 + 3.3, 10 + 3.3, False),
    ],
)
def test_hulls_are_far_from_each_other_beyond_drafts_and_panels(monkeypatch, dx, dy, far):
    """A draft of 5 m, once its depth told; panels of less"""
    monkeypatch.setattr(arrangement, "NARROW", 1.0)
    assert ONE.sizes.max() < 5
    assert arrangement._far(ONE, beside(dx, dy)) == far
    monkeypatch.setattr(arrangement, "NARROW", 0.0)
    assert arrangement._far(ONE, beside(0, 10 + 1.01 * ONE.sizes.max()))
    assert not arrangement._far(ONE, beside(0, 10 + 0.99 * ONE.sizes.max()))


@pytest.mark.parametrize(("small", "big"), [(True, False), (False, True)])
def test_far_counts_the_deeper_and_the_coarser_of_two(monkeypatch, small, big):
    monkeypatch.setattr(arrangement, "NARROW", 1.0)
    shallow = box(20.0, 10.0, 1.0, panels=200).whole()
    pair = (ONE, beside(0, 14.0, shallow)) if small else (shallow, beside(0, 14.0, ONE))
    assert not arrangement._far(*pair) and shallow.sizes.max() < 4
    assert arrangement._far(shallow, beside(0, 14.0, shallow))


def test_a_hull_in_another_one_overlaps_it():
    inner = box(2.0, 2.0, 1.0, panels=24).whole()
    assert arrangement._overlap(inner, ONE) and not arrangement._overlap(ONE, inner)
    assert arrangement._overlap(beside(5, 3), ONE) and not arrangement._overlap(beside(0, 12), ONE)
    assert not arrangement._overlap(beside(21, 0), ONE)


class Scene(SimpleNamespace):
    several = True


def scene(*names, wall=None, depth=30.0):
    bodies = [SimpleNamespace(name=name, shape="box", place=(0.0, 0.0, 0.0)) for name in names]
    return Scene(bodies=bodies, wall=wall, water=SimpleNamespace(depth=depth))


class Many:
    """Hulls as bodies of one mesh"""

    def __init__(self, *hulls):
        self.hulls, self.bodies = hulls, len(hulls)

    def of_body(self, i):
        return self.hulls[i]

    def whole(self):
        return SimpleNamespace(points=np.concatenate([one.points for one in self.hulls]))


def test_bodies_apart_are_told_of_gaps_that_their_panels_do_not_resolve(monkeypatch):
    gaps = []
    monkeypatch.setattr(arrangement, "resonant_water", lambda scene, mesh, found: gaps.append(found) or ("water",))
    three, size = scene("a", "b", "c"), ONE.sizes.max()
    far = beside(0, 200.0)
    said, water = arrangement.check_apart(three, Many(ONE, far, beside(0, 200.0 + 10 + 0.2 * size)))
    assert said.startswith(f"b and c are {0.2 * size:.3g} m apart, but their panels are up to ") and water == "water"
    assert said.endswith(" m long; recommended: at most twice the gap; give more panels")
    ((name, gap, draft, across, wall),) = gaps[0]
    assert (name, draft, wall) == ("b and c", 5.0, False)
    assert (gap, across) == pytest.approx((0.2 * size, 20 + 0.2 * size))
    assert arrangement.check_apart(three, Many(ONE, far, beside(0, 210.0 + 0.2 * size)), panels_matter=False) == (
        "water",
    )
    assert arrangement.check_apart(scene("a", "b"), Many(ONE, beside(0, 10 + 0.6 * size))) == ("water",)


def test_a_body_that_stands_on_the_bed_is_a_wall_of_the_gap_and_two_have_none(monkeypatch):
    gaps = []
    monkeypatch.setattr(arrangement, "resonant_water", lambda scene, mesh, found: gaps.append(found) or ())
    pier = box(30.0, 40.0, 20.0, panels=600, bottom=False).whole().moved(dy=27.0)
    ship = box(20.0, 10.0, 5.0, panels=200).whole()
    arrangement.check_apart(scene("ship", "pier", depth=20.0), Many(ship, pier))
    ((name, gap, draft, across, wall),) = gaps[0]
    assert (name, draft, wall) == ("ship and pier", 5.0, True) and (gap, across) == pytest.approx((2.0, 10.0))
    arrangement.check_apart(scene("one", "two", depth=20.0), Many(pier, pier.moved(dx=31.0)))
    assert gaps[1] == []


@pytest.mark.parametrize(("move", "says"), [
    ((0, 5.0), "a and b overlap; allowed: water between them; move one of them with its key place"),
    ((0, 10.0), "a and b touch; allowed: water between them (change place), or one mesh of both"),
])  # fmt: skip
def test_bodies_that_overlap_or_touch_are_refused(move, says):
    with pytest.raises(SceneError) as error:
        arrangement.check_apart(scene("a", "b"), Many(ONE, beside(*move)))
    assert str(error.value) == says


@pytest.mark.parametrize(
    ("wall", "second", "told"),
    [
        (8.0, -30.0, None),
        (8.0, 30.0, "b extends from y = 25 to 35 m, and the wall is at y = 8 m; allowed: all bodies on"),
        (-8.0, 30.0, None),
        (4.0, -30.0, "a extends from y = -5 to 5 m, and the wall is at y = 4 m"),
        (5.0, -30.0, "a extends"),
        (None, 30.0, None),
    ],
)
def test_all_bodies_are_on_one_side_of_a_wall(wall, second, told):
    try:
        arrangement._check_wall(scene("a", "b", wall=wall), Many(ONE, beside(0, second)))
    except SceneError as error:
        assert told and str(error).startswith(told)
    else:
        assert told is None


def same(mesh):
    """Whether the points of a mesh are those of the box, in any order"""
    order = [sorted(map(tuple, (one.points + 0.0).round(9))) for one in (mesh, ONE)]
    return np.allclose(*order, rtol=0, atol=1e-9)


def test_hulls_come_back_from_their_places_as_they_were():
    place = (30.0, -7.0, 90.0)
    there = arrangement._at_place(ONE, place)
    low, high = there.points.min(axis=0), there.points.max(axis=0)
    assert (low, high) == (pytest.approx([25, -17, -5]), pytest.approx([35, 3, 0]))
    assert same(arrangement._at_origin(there, place))
    tilted = arrangement._at_place(ONE, (1.0, 2.0, 30.0))
    bow = np.abs(ONE.points - [10, 0, 0]).sum(axis=1).argmin()
    x, y, z = ONE.points[bow]
    wanted = (1 + x * math.sqrt(0.75) - y / 2, 2 + x / 2 + y * math.sqrt(0.75), z)
    assert np.linalg.norm(tilted.points - wanted, axis=1).min() < 1e-12
    assert same(arrangement._at_origin(tilted, (1.0, 2.0, 30.0)))


def test_bodies_share_the_mirror_planes_that_all_have(monkeypatch):
    quarter = box(20.0, 10.0, 5.0, panels=200)
    two = SimpleNamespace(bodies=[SimpleNamespace(place=(-30.0, 0.0, 0.0)), SimpleNamespace(place=(30.0, 0.0, 0.0))])
    made = arrangement.arranged(two, [quarter, quarter])
    assert made.symmetry == "y" and made.bodies == 2
    hulls = arrangement.own_hulls(two, made)
    assert [one.symmetry for one in hulls] == ["xy", "xy"] and hulls[1].whole().points[:, 0].max() == pytest.approx(10)
    two.bodies[1].place = (30.0, 5.0, 0.0)
    assert arrangement.arranged(two, [quarter, quarter]).symmetry == ""
    monkeypatch.setattr(arrangement, "own_hulls", lambda scene, mesh: "hulls")
    modes = [Scene(modes=of, several=several) for of, several in (((), True), ((1,), True), ((1,), False))]
    assert [arrangement.own_hulls_of_modes(one, "mesh") for one in modes] == [(), "hulls", ["mesh"]]


def outcome(**more):
    given = {"path": "a", "solved": 0, "stored": 3, "total": 3, "jobs": 0, "failures": (), "remarks": ()}
    return run.Outcome(**given | more)


@pytest.mark.parametrize(("more", "status"), [
    ({}, 0), ({"stored": 2}, 1), ({"failures": ((0.5, "no"),)}, 1), ({"interrupted": True}, 0),
    ({"interrupted": True, "stored": 2}, 130), ({"interrupted": True, "failures": ((0.5, "no"),)}, 1)])  # fmt: skip
def test_a_run_ends_with_0_where_all_is_stored_and_with_130_where_it_was_interrupted(more, status):
    assert outcome(**more).exit_status == status


def test_a_result_without_a_wanted_quantity_is_a_failure_and_the_rest_is_not_stored():
    kept = []
    row = SimpleNamespace(omega=0.5, headings=[0.0], want={"rao", "added_mass"})
    storing = SimpleNamespace(add=lambda *given: kept.append(given))
    found = {"rao": 1, "added_mass": 2, "kochin": 3, "checks": 4, "estimated_error": 5, "wall_time": 6}
    run._store_row(storing, row, found)
    assert kept == [(0.5, [0.0], {name: value for name, value in found.items() if name != "kochin"})]
    job = run.Job(0.5, (), lambda result: run._store_row(storing, row, result))
    assert run._stored(job, found) == "" and run._stored(job, {"kochin": 1}) == (
        "ValueError: the method returned no added_mass, rao")  # fmt: skip
    assert run._stored(job, FloatingPointError("it\n  diverges")) == "FloatingPointError: it diverges"
    assert len(run._reason(ValueError("x" * 400))) == 300 and len(kept) == 2


def test_jobs_are_frequencies_with_their_directions_and_limits(monkeypatch):
    plan = SimpleNamespace(problem="problem", header=SimpleNamespace(theta="theta"))
    monkeypatch.setattr(run, "KOCHIN", {"kochin_radiation"})
    rows = [
        SimpleNamespace(omega=w, headings=[w], want=want) for w, want in ((0.5, {"rao"}), (0.6, {"kochin_radiation"}))
    ]
    one, two = run._rows("storing", plan, rows)
    assert one.where == 0.5 and one.call == (run.solve_one, "problem", 0.5, [0.5], {"rao"}, None)
    assert two.call[-1] == "theta" and two.store.args == ("storing", rows[1])
    (limit,) = run._limits("file", plan, ["zero"])
    assert (limit.where, limit.call, limit.store.args) == ("zero", (run.limit_one, "problem", "zero"), ("file", "zero"))


def test_the_time_of_an_estimate_is_its_share_without_the_loading_of_kernels(monkeypatch):
    shared = []
    monkeypatch.setattr(run, "share", lambda *given: shared.append(given))
    monkeypatch.setattr(run, "spent", lambda name: 5.0)
    monkeypatch.setattr(run, "times", lambda result: result)
    assert run._share_estimate({"solve": 6.0, run.ESTIMATE: 3.0, run.INTERPOLATED: 1.0}, 3.0) == 5.0
    assert shared == [("solve", "estimate", pytest.approx(4 * (1 - 2 / 10)))]
    run._share_estimate({"solve": 1.0, run.ESTIMATE: 0.5}, 0.0)
    assert shared[1][2] == 0.0
    run._share_estimate({"solve": 1.0}, 0.0)
    assert len(shared) == 2


@pytest.mark.parametrize(("stored", "want", "kept"), [
    ("flow", {"rao"}, True), ("flow", {"rao", "drift_force"}, True), ("flow", {"rao", "added_mass"}, False),
    (None, {"rao"}, False), ("diverges", {"rao"}, False)])  # fmt: skip
def test_motions_follow_from_what_is_stored_without_a_solution(monkeypatch, stored, want, kept):
    def free_body(problem, omega, headings, theta, flow):
        if flow == "diverges":
            raise FloatingPointError
        assert (problem, omega, headings, theta) == ("problem", 0.5, [1.0], "theta")
        return {"rao": 1, "drift_force": 2, "other": 3}

    appended, row = [], SimpleNamespace(omega=0.5, headings=[1.0], want=want)
    monkeypatch.setattr(run, "pending", lambda file: SimpleNamespace(rows=[row]))
    monkeypatch.setattr(run, "needed", lambda want: sorted(want))
    monkeypatch.setattr(run, "row_values", lambda file, omega, headings, names: stored)
    monkeypatch.setattr(run, "free_body", free_body)
    monkeypatch.setattr(run, "append", lambda *given: appended.append(given))
    run._store_free_body("file", SimpleNamespace(problem="problem", header=SimpleNamespace(theta="theta")))
    values = {"rao": 1, "drift_force": 2}
    assert appended == ([("file", 0.5, [1.0], {name: values[name] for name in want})] if kept else [])


def of_hull(shape="box", file="", **more):
    sizes = {"length": 20.0, "beam": 10.0, "draft": 5.0} if shape == "box" else {"radius": 3.0, "draft": 5.0}
    return SimpleNamespace(shape=shape, file=file, name=shape, **sizes, **more)


@pytest.mark.parametrize(("bottom", "areas"), [(True, (500.0, math.pi * 39)), (False, (300.0, math.pi * 30))])
def test_panels_are_shared_by_the_wetted_area(monkeypatch, bottom, areas):
    """Sides of 60 m times 5 m and a bottom of 200 m²; a cylinder of 2πrd and πr²"""
    monkeypatch.setattr(hull, "stands_on_bed", lambda scene, body: not bottom)
    bodies = [of_hull(), of_hull("buoy")]
    two = Scene(bodies=bodies)
    assert [hull._wetted_area(two, body) for body in bodies] == pytest.approx(areas)
    assert hull._share(two, bodies[1]) == pytest.approx(areas[1] / sum(areas))
    two.several = False
    assert hull._share(two, bodies[1]) == 1.0


@pytest.mark.parametrize(
    ("several", "panels", "total", "refused"),
    [(True, None, 20_001, True), (True, None, 20_000, False), (False, None, 20_001, False), (True, 9, 20_001, False)],
)
def test_several_bodies_need_at_most_20000_panels_together(several, panels, total, refused):
    two = Scene(bodies=[1, 2], several=several, panels=panels, accuracy=0.01)
    if refused:
        with pytest.raises(
            SceneError, match=r"tolerance 0\.01 needs 20001 panels on 2 bodies; allowed: 20000; leave out"
        ):
            hull._check_count(two, total)
    else:
        hull._check_count(two, total)


def test_errors_of_a_mesh_are_refused_and_the_rest_is_told():
    one = SimpleNamespace(several=False, body=of_hull(file="ship.gdf"))
    bad, good = Finding("error", "open hull"), Finding("warning", "long panels")
    assert hull._without_errors(one, iter([good])) == ("long panels",)
    with pytest.raises(SceneError, match=r"^ship\.gdf: open hull$"):
        hull._without_errors(one, [good, bad])
    with pytest.raises(SceneError, match=r"^mesh of several bodies: open hull \(and 2 more\)$"):
        hull._without_errors(Scene(), [bad, good, bad, bad])
    one.body.file = ""
    assert hull._name(one) == "mesh"


@pytest.mark.parametrize(("longest", "refused"), [(9.99, False), (10.01, True)])
def test_panels_are_no_longer_than_the_shortest_wave(monkeypatch, longest, refused):
    mesh = SimpleNamespace(sizes=np.array([1.0, longest]))
    one = SimpleNamespace(several=False, body=of_hull(), shortest_wave=10.0, water=SimpleNamespace(depth=20.0))
    monkeypatch.setattr(hull, "findings", lambda mesh, depth, wave: [Finding("warning", f"{depth:g} {wave:g}")])
    monkeypatch.setattr(hull, "resonant_water", lambda scene, mesh: ("slow water",))
    monkeypatch.setattr(hull, "check_apart", lambda scene, mesh: ("close",))
    if refused:
        with pytest.raises(
            SceneError, match=r"^mesh: panels up to 10 m are too long for the shortest wave, 10 m; allowed"
        ):
            hull._usable(one, mesh)
    else:
        assert hull._usable(one, mesh) == ("slow water", "20 10")
        one.several = True
        assert hull._usable(one, mesh) == ("close", "20 10")


def test_a_lid_has_a_third_of_the_panels_or_edges_of_a_fifth_of_the_wave(monkeypatch):
    """1/5 of 10 m beside √(3 · 200/100) = 2.45 m of the hull's panels, and half the side of the waterplane"""
    monkeypatch.setattr(hull, "lid", lambda mesh, *edge: edge)
    monkeypatch.setattr(hull, "waterplane_area", lambda mesh: mesh.area)
    quarter = SimpleNamespace(area=200.0, total=100, bodies=1, copies=4, of_body=lambda i: quarter)
    one = SimpleNamespace(lid=True, shortest_wave=10.0)
    assert hull.make_lid(one, quarter) == pytest.approx((math.sqrt(6),))
    quarter.total = 600
    assert hull.make_lid(one, quarter) == pytest.approx((2.0,))
    one.shortest_wave = 100.0
    assert hull.make_lid(one, quarter) == pytest.approx((math.sqrt(50) / 2,))
    quarter.area = 0.0
    assert hull.make_lid(one, quarter) == ()
    one.lid = False
    assert hull.make_lid(one, quarter) is None
    parts = [SimpleNamespace(area=area) for area in (0.0, 80.0, 60.0)]
    assert hull._smallest_waterplane(SimpleNamespace(bodies=3, copies=1, of_body=lambda i: parts[i])) == 15.0
    cover = SimpleNamespace(areas=np.array([3.0, 5.0]))
    few, many = SimpleNamespace(total=50), SimpleNamespace(total=200)
    assert (
        hull.lid_in_proportion(cover, many, few) == pytest.approx((4.0,)) and hull.lid_in_proportion(None, 1, 2) is None
    )


@pytest.mark.parametrize(
    ("panels", "shapes", "none"), [(None, ("box",), False), (9, ("box",), True), (None, ("box", "mesh"), True)]
)
def test_meshes_are_refined_where_a_tolerance_holds(panels, shapes, none):
    one = SimpleNamespace(
        panels=panels, bodies=[SimpleNamespace(shape=shape) for shape in shapes], omegas=lambda: "omegas"
    )
    made = hull.finer_hull(one)
    assert (made is None) is none and (none or made.omegas == "omegas")


@pytest.mark.parametrize(("total", "none"), [(5000, False), (5001, True)])
def test_a_finer_mesh_has_at_most_5000_panels(monkeypatch, total, none):
    monkeypatch.setattr(hull, "_remeshed", lambda scene, mesh, counts: SimpleNamespace(total=total))
    monkeypatch.setattr(hull, "lid_in_proportion", lambda *given: given)
    found = hull.FinerHull("scene")("mesh", "cover")
    assert (found is None) is none and (none or found == (found[0], ("cover", "mesh", found[0])))


@pytest.mark.parametrize(
    ("method", "names", "matter"), [("panel", [], True), ("contour", [], False), ("contour", ["pressure"], True)]
)
def test_panels_matter_where_a_method_or_a_result_uses_them(method, names, matter):
    assert hull.panels_matter(SimpleNamespace(solved_by=method, names=lambda: names)) is matter


@pytest.mark.parametrize(("total", "fixed", "standing", "says"), [
    (100_000, False, False, None), (100_001, False, False, "s.gdf has 100001 panels; allowed: up to 100000"),
    (9, True, True, None), (9, False, True, "s.gdf stands on the bed, z = -20 m, without a bottom, and cannot float"),
])  # fmt: skip
def test_a_mesh_file_has_a_bottom_or_is_fixed(monkeypatch, total, fixed, standing, says):
    monkeypatch.setattr(hull, "read_mesh", lambda file: SimpleNamespace(total=total))
    monkeypatch.setattr(hull, "stands", lambda mesh, depth: standing)
    monkeypatch.setattr(hull, "folded", lambda mesh: "folded")
    one = SimpleNamespace(water=SimpleNamespace(depth=20.0))
    body = of_hull("box", fixed=fixed)
    body.shape, body.file = "mesh", "s.gdf"
    if says:
        with pytest.raises(SceneError, match=says.replace(".", r"\.")):
            hull._hull(one, body)
    else:
        assert hull._hull(one, body) == "folded"
