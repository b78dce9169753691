from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.lid import lid, polar_lid, rings_of, waterline
from hakobune.meshing.panels import SYMMETRIES, PanelMesh, joined, structured
from hakobune.meshing.quality import findings
from hakobune.meshing.shapes import box, buoy


def moonpool_box():
    """40 x 20 m opening in a box of 100 x 50 m; the bottom under the opening is left in, no part of the lid."""
    outer, inner = box(100, 50, 10), box(40, 20, 10)
    walls = inner.corners[inner.normals[:, 2] > -0.5]
    return joined([outer, replace(inner, corners=walls[:, ::-1])])


def written_out(mesh, axis):
    """The same hull with the mirror plane `axis` = 0 written out."""
    rest = mesh.symmetry.replace(axis, "")
    return replace(replace(mesh, symmetry=axis).whole(), symmetry=rest)


def total_area(mesh):
    return mesh.copies * mesh.areas.sum()


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_the_lid_of_a_box_is_its_waterplane(symmetry):
    hull = box(100, 50, 10, symmetry=symmetry)
    cover = lid(hull)
    assert total_area(cover) == pytest.approx(5000, rel=1e-12)
    assert np.all(cover.points[:, 2] == 0)
    np.testing.assert_allclose(cover.normals, np.tile([0, 0, 1], (len(cover), 1)), atol=1e-12)
    assert cover.symmetry == symmetry
    assert findings(hull, lid=cover) == []


def test_the_lid_of_a_box_is_a_grid():
    cover = lid(box(100, 50, 10), size=10.0)
    assert len(cover) == 5 * 2  # 50 x 25 m, 2.5 rounds to even
    np.testing.assert_allclose(cover.areas, 10 * 12.5, rtol=1e-12)


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_the_lid_of_a_buoy_lies_within_the_waterline(symmetry):
    hull = buoy(10, 10, symmetry=symmetry)
    cover = lid(hull)
    reach = np.hypot(*hull.points[:, :2].T).max()
    assert np.hypot(*cover.points[:, :2].T).max() <= reach * (1 + 1e-12)
    edge = 2 * cover.sizes.max()  # of the polygon of the lid: an edge lies no more than edge²/8R inside the circle
    assert 0 <= 1 - total_area(cover) / (np.pi * 10**2) + 1e-12 <= 2 * edge**2 / (8 * 10**2)
    assert findings(hull, lid=cover) == []


@pytest.mark.parametrize("symmetry", SYMMETRIES)
@pytest.mark.parametrize("shift", [0.0, 30.0])
def test_a_polar_lid_covers_a_round_waterline(symmetry, shift):
    hull = buoy(10, 10, counts=(6, 3, 4), symmetry=symmetry).moved(dx=shift)  # a plane it leaves is written out
    cover = polar_lid(hull, 3.0)
    assert total_area(cover) == pytest.approx(np.pi * 10**2, rel=1e-12)  # of the whole polygon
    assert len(cover) * cover.copies == 24 * 2
    radii = np.hypot(cover.points[:, 0] - shift, cover.points[:, 1])
    assert len(np.unique(np.round(radii, 6))) == 3  # two rings of up to 6 m
    assert len(polar_lid(hull, 2.0)) * cover.copies == 24 * 2 * 3
    assert findings(hull, lid=cover) == []


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_other_waterlines_have_no_polar_lid(symmetry):
    hull = buoy(10, 10, counts=(6, 3, 4), symmetry=symmetry)
    assert polar_lid(replace(hull, points=hull.points * (2.0, 1.0, 1.0)), 3.0) is None
    assert polar_lid(box(100, 50, 10, symmetry=symmetry), 3.0) is None
    assert polar_lid(hull.moved(dz=-1.0), 3.0) is None
    assert polar_lid(moonpool_box(), 3.0) is None


@pytest.mark.parametrize("make", (lambda: box(100, 50, 10, panels=900), lambda: buoy(10, 10), moonpool_box))
def test_a_lid_has_about_a_third_as_many_panels_as_the_hull(make):
    hull = make()
    assert 0.2 <= len(lid(hull)) / len(hull) <= 0.5


def test_the_lid_leaves_out_a_moonpool():
    quarter = moonpool_box()
    for hull in (quarter, written_out(quarter, "x"), written_out(quarter, "y"), quarter.whole()):
        cover = lid(hull)
        assert total_area(cover) == pytest.approx(100 * 50 - 40 * 20, rel=1e-9)
        inside = np.abs(cover.centroids[:, :2]) < (20, 10)
        assert not inside.all(axis=1).any()


def test_every_hull_of_a_catamaran_has_its_lid():
    one = box(100, 10, 10, panels=200, symmetry="")
    hull = joined([one.moved(dy=20), one.moved(dy=-20)])
    assert total_area(lid(hull)) == pytest.approx(2 * 100 * 10, rel=1e-12)
    half = replace(one.moved(dy=20), symmetry="y")
    assert total_area(lid(half)) == pytest.approx(2 * 100 * 10, rel=1e-12)


def test_a_submerged_body_has_no_lid():
    assert lid(box(10, 5, 2).moved(dz=-1)) is None


def test_the_waterline_runs_with_the_body_on_its_left():
    (line,) = waterline(box(100, 50, 10, symmetry=""))
    np.testing.assert_array_equal(line[0], line[-1])
    x, y = line[:-1, 0], line[:-1, 1]
    enclosed = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    assert enclosed == pytest.approx(5000)


def test_the_lid_of_a_hull_with_sloping_sides_ends_at_its_waterline():
    u, v = np.linspace(0, np.pi / 2, 9)[:, None], np.linspace(0, 2 * np.pi, 33)[None, :]
    grid = np.broadcast_arrays(np.cos(u) * np.cos(v), np.cos(u) * np.sin(v), -np.sin(u))
    mesh = structured(np.stack(grid, axis=-1))
    hemisphere = mesh if mesh.volume > 0 else mesh.flipped()
    cover = lid(hemisphere, size=0.15)
    assert np.hypot(*cover.points[:, :2].T).max() == pytest.approx(1, rel=1e-12)
    sides_16, sides_32 = (n / 2 * np.sin(2 * np.pi / n) for n in (16, 32))
    assert sides_16 <= cover.areas.sum() <= sides_32 * (1 + 1e-12)


@pytest.mark.parametrize(
    ("hull", "words"),
    [
        (lambda: box(10, 5, 2).flipped(), "does not close"),
        (lambda: box(10, 5, 2, symmetry="").flipped(), "encloses -50"),
        (lambda: replace(box(10, 5, 2), symmetry="x"), "free end"),
        (lambda: joined([box(10, 5, 2, symmetry=""), box(10, 5, 2, symmetry="").moved(dx=10)]), "forks"),
    ],
)
def test_a_waterline_that_cannot_be_covered_is_named(hull, words):
    with pytest.raises(ValueError, match=words):
        lid(hull())


def test_a_lid_needs_a_size():
    with pytest.raises(ValueError, match="size is 0"):
        lid(box(10, 5, 2), size=0)


def ring_hull(outer, inner, draft=5.0, sides=48):
    """Walls between two closed curves of the angle, without a bottom: what a lid sees of a hull with a moonpool"""
    angle = np.arange(sides + 1) * 2 * np.pi / sides
    rims = [np.stack([r(angle)[0], r(angle)[1], 0 * angle], axis=1) for r in (outer, inner)]
    walls = [structured(np.stack([rim - [0, 0, draft], rim], axis=1)) for rim in rims]
    walls = [walls[0], walls[1].flipped()]
    walls = walls if walls[0].normals[0] @ rims[0][0] > 0 else [wall.flipped() for wall in walls]
    return joined(walls).merged(1e-9)


def curve(radius, bulge=0.0, waves=0, x=0.0, y=0.0):
    def at(angle):
        r = radius + bulge * np.cos(waves * angle)
        return x + r * np.cos(angle), y + r * np.sin(angle)

    return at


@pytest.mark.parametrize(
    ("outer", "inner"),
    [
        (curve(10), curve(5, x=2)),
        (curve(10, 1, 3), curve(5, 1, 3)),
        (curve(10), curve(6, 0.8, 4)),
        (curve(10), curve(8, x=0.7)),
    ],
    ids=["beside the middle", "wavy", "wavy pool", "narrow"],
)
@pytest.mark.parametrize("size", [6.0, 3.0])
def test_a_lid_lies_inside_its_ring_and_outside_its_pool_however_long_its_edges(outer, inner, size):
    """Corners and middles of its sides are between the two curves, but for a tenth of the width; so is its area."""
    cover = lid(ring_hull(outer, inner), size)
    corners = cover.vertices
    places = np.concatenate([corners, 0.5 * (corners + np.roll(corners, -1, axis=1))], axis=1).reshape(-1, 3)
    fine = np.linspace(0, 2 * np.pi, 2001)
    sides = [np.stack(one(fine), axis=1) for one in (outer, inner)]
    gap = min(np.linalg.norm(sides[0][::20, None] - sides[1][None, ::20], axis=2).min(axis=1))
    for rim, sign in zip(sides, (1, -1), strict=True):
        away = np.linalg.norm(places[:, None, :2] - rim[None, ::10], axis=2)
        nearest = rim[::10][away.argmin(axis=1)]
        centre = rim.mean(axis=0)
        out = sign * (np.linalg.norm(places[:, :2] - centre, axis=1) - np.linalg.norm(nearest - centre, axis=1))
        assert out.max() < 0.25 * gap + 0.15
    exact = sum(s * 0.5 * np.sum(r[:-1, 0] * np.diff(r[:, 1]) - r[:-1, 1] * np.diff(r[:, 0]))
                for s, r in zip((1, -1), sides, strict=True))  # fmt: skip
    assert total_area(cover) == pytest.approx(exact, rel=0.05)


@pytest.mark.parametrize("sides, kept", [(15, False), (16, True)])
def test_chords_leave_a_ring_by_a_tenth_of_the_width_of_its_lid(sides, kept):
    """R (1 − cos π/n) of R 10 m around a pool of 8 m: 0.219 m of n = 15 is more than 0.2 m, 0.192 m of 16 is not"""
    from hakobune.meshing.lid import _true

    angle = np.arange(480) * np.pi / 240
    outer, inner = (r * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) for r in (10.0, 8.0))
    plan = _true(outer, [inner[::-1]], 2 * np.pi * 10 / sides)
    assert (len(plan) == sides) == kept and len(plan) >= sides


def test_a_disc_is_as_wide_as_a_quarter_of_what_lies_across_it():
    """A quarter of it; its own corners count from 1.5 chords along the rim on: x / sin x = 1.5 of half the angle"""
    from scipy.optimize import brentq

    from hakobune.meshing.lid import _width

    angle = np.arange(720) * np.pi / 360
    ring = 10 * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    half = brentq(lambda x: x / np.sin(x) - 1.5, 0.5, 3)
    np.testing.assert_allclose(_width(ring, []), 0.25 * 20 * np.sin(half), rtol=1e-3)
    np.testing.assert_allclose(_width(ring, [ring * 0.9, ring * 0.5]), 1.0, rtol=1e-3)  # the nearer of two pools


def test_a_lid_has_the_size_asked_for_and_by_default_a_third_of_the_panels():
    """40 x 20 m: 8 x 4 panels of 5 m; of a hull of 96 panels 32 of √(800/32) = 5 m"""
    hull = box(40, 20, 5, counts=(4, 2, 2), symmetry="")
    assert len(hull) == 80
    np.testing.assert_allclose(lid(hull, 5.0).areas, 25.0)
    hull = box(40, 20, 5, counts=(3, 3, 2), symmetry="")
    assert len(hull) == 84  # 28 wanted, √(800/28) = 5.35 m: 7 x 4
    assert len(lid(hull)) == 28


def test_filled_polygons_are_quadrilaterals_but_for_a_few_triangles():
    cover = lid(ring_hull(curve(10), curve(5)), 1.0)
    triangles = np.sum(cover.corners[:, 2] == cover.corners[:, 3])
    assert triangles < 0.15 * len(cover)
    wanted = total_area(cover)
    assert len(cover) <= 1.2 * wanted * 1.5 and len(cover) > 0.5 * wanted


@pytest.mark.parametrize("turn", [0.0, 0.3, 2.0, 4.0])
def test_boxes_that_touch_in_a_corner_have_a_lid_each(turn):
    """10 x 5 m and 6 x 3 m: each waterline has its body on its left, whichever way both are turned"""
    one, other = box(10, 5, 2, counts=(3, 2, 1), symmetry=""), box(6, 3, 2, counts=(2, 1, 1), symmetry="")
    both = joined([one, other.moved(dx=8, dy=4)]).rotated(turn)
    assert sorted(area for _, area in rings_of(both)) == pytest.approx([18.0, 50.0])
    assert lid(both, 1.0).areas.sum() == pytest.approx(68.0)


def test_a_roof_whose_ridge_is_in_the_surface_has_no_waterline_there():
    """A wedge of 8 x 2 m, its ridge along y = 0 in the surface, beside a box: the ridge is no end of the waterplane"""
    points = [[0, -1, -1], [8, -1, -1], [8, 1, -1], [0, 1, -1], [0, 0, 0], [8, 0, 0]]
    panels = [[0, 3, 2, 1], [0, 1, 5, 4], [2, 3, 4, 5], [3, 0, 4, 4], [1, 2, 5, 5]]
    roof = PanelMesh(points, panels)
    assert roof.volume == pytest.approx(8.0) and waterline(roof) == []
    hull = joined([roof, box(4, 4, 2, counts=(1, 1, 1), symmetry="").moved(dx=20)])
    assert lid(hull).areas.sum() == pytest.approx(16.0)


def test_walls_that_lie_on_each_other_fork_the_waterline():
    one = box(10, 5, 2, counts=(1, 1, 1), symmetry="")
    with pytest.raises(ValueError, match=r"the waterline forks at x = 5, y = (0|-?2.5) m"):
        lid(joined([one, one.moved(dx=10)]))


def test_a_plan_keeps_its_corners_and_divides_what_is_between_them_evenly():
    """A half disc of 10 m, its arc from the middle on: 31.4 m in three parts of its own, the straight side in one"""
    from hakobune.meshing.lid import _simplified

    angle = np.arange(181) * np.pi / 180
    arc = 10 * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    ring = np.concatenate([arc[90:], arc[:90]])
    plan = _simplified(ring, 10.0)
    expected = 10 * np.array([[np.cos(a), np.sin(a), 0] for a in np.pi / 3 * np.arange(4)])
    assert len(plan) == 4 and {tuple(p) for p in plan.round(6)} == {tuple(p) for p in expected.round(6)}


def test_a_ring_lies_in_another_where_its_first_point_does():
    """An L by its two rectangles, and a triangle by the signs of three cross products, at random points"""
    from hakobune.meshing.lid import _inside

    L = np.array([[0, 0], [4, 0], [4, 1], [1.5, 1], [1.5, 3], [0, 3.0]])
    triangle = np.array([[-1, 0.2], [3, -1], [2, 2.5]])
    x = np.random.default_rng(3).uniform(-2, 5, (400, 2))
    in_L = np.all((x > 0) & (x < (4, 1)), axis=1) | np.all((x > 0) & (x < (1.5, 3)), axis=1)
    side = np.roll(triangle, -1, axis=0) - triangle
    in_triangle = np.all(
        side[:, 0] * (x[:, None] - triangle)[..., 1] > side[:, 1] * (x[:, None] - triangle)[..., 0], axis=1
    )
    for ring, expected in ((L, in_L), (L[::-1], in_L), (triangle, in_triangle)):
        assert [_inside(point[None], ring) for point in x] == expected.tolist()


def test_a_plan_keeps_corners_that_turn_either_way():
    """An L, of which one corner turns inwards, with edges far shorter than what is asked for"""
    from hakobune.meshing.lid import _simplified

    plan = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]])
    middles = (plan + np.roll(plan, -1, axis=0)) / 2
    ring = np.stack([plan, middles], axis=1).reshape(-1, 2)
    assert {tuple(point) for point in _simplified(ring, 100.0)} == {tuple(point) for point in plan}


def test_a_ring_of_equal_sides_is_regular_on_a_circle_alone():
    """A square has its centre; a rhombus, and a square with a corner on a side more, have none"""
    from hakobune.meshing.lid import _regular

    square = np.array([[4.0, 1, 0], [2, 3, 0], [0, 1, 0], [2, -1, 0]])
    ring, pole = _regular(square)
    assert pole == pytest.approx([2.0, 1.0, 0.0]) and len(ring) == 5
    rhombus = np.array([[4.0, 1, 0], [2, 2, 0], [0, 1, 0], [2, 0, 0]])
    assert _regular(rhombus) == (None, None)
    assert _regular(np.insert(square, 1, [[3.0, 2.0, 0.0]], axis=0)) == (None, None)


def test_a_place_where_two_edges_of_a_waterline_arrive_is_told():
    """A panel of a side that looks the other way: its edge runs against those beside it"""
    hull = box(10, 5, 2, counts=(1, 1, 1), symmetry="")
    for number in range(len(hull)):
        side = hull.vertices[number]
        if np.ptp(side[:, 2]) == 0:
            continue
        corners = hull.corners.copy()
        corners[number] = corners[number][::-1]
        with pytest.raises(ValueError, match=r"lid: the waterline forks at x = -?[05], y = -?(0|2\.5) m; see the mesh"):
            waterline(replace(hull, corners=corners))
