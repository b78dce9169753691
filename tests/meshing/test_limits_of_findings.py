"""Every limit of a finding, from both sides of it."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.hydrostatics import hydrostatics
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import PanelMesh, joined, structured
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.findings import _reach
from hakobune.meshing.quality.overlap import overlaps
from hakobune.meshing.shapes import box


def said(words, mesh, **more):
    """Lines that have some words"""
    return [str(one) for one in findings(mesh, **{"depth": 1000.0} | more) if words in one.text]


def enlarged(size, mesh, **lengths):
    """A hull with all that belongs to it so many times as large: limits are shares of its own lengths"""
    made = {"depth": 1000.0} | lengths | {"mesh": mesh}
    return {
        name: replace(part, points=size * part.points) if isinstance(part, PanelMesh) else size * part
        for name, part in made.items() if part is not None
    }  # fmt: skip


def both(words, sound, broken, severity="warning"):
    for size in (0.01, 300.0, 1.0):
        assert said(words, **enlarged(size, **sound)) == []
        (line,) = said(words, **enlarged(size, **broken))
        assert line.startswith(severity)
    return line


def plain(length, beam, draft, counts=(1, 1, 1)):
    return box(length, beam, draft, counts=counts, grading=False)


def test_panels_a_hundred_times_as_long_as_wide():
    line = both("aspect ratio", {"mesh": plain(196, 2, 1)}, {"mesh": plain(208, 2, 1)})
    assert line.endswith(
        "2 of 3 panels with an aspect ratio up to 104, good: ≤ 100; divide the long side into more panels"
    )


def test_corners_a_tenth_of_the_longest_edge_off_the_plane():
    """A square whose corners are e above and below by turns: e / √(1 + 4e²)"""

    def skew(share):
        e = share / np.sqrt(1 - 4 * share**2)
        return PanelMesh([(0, 0, e - 9), (1, 0, -e - 9), (1, 1, e - 9), (0, 1, -e - 9)], [[3, 2, 1, 0]])

    line = both("not flat", {"mesh": skew(0.095)}, {"mesh": skew(0.105)})
    assert "1 of 1 panels not flat, corners off the plane by up to 10.5 % of the longest edge, good: ≤ 10 %" in line


def test_three_panels_a_wave():
    hull = plain(100, 50, 10, (10, 5, 5))  # edges of 5 m at most
    line = both("coarse", {"mesh": hull, "shortest_wave": 15.0}, {"mesh": hull, "shortest_wave": 14.7})
    assert "125 of 125 panels up to 5 m long, coarse for the wave length 14.7 m; good: ≤ 4.9 m" in line
    hull = plain(100, 50, 10, (20, 5, 5))  # 100 of the sides are 2.5 m
    (line,) = said("coarse", hull, shortest_wave=14.7)
    assert "125 of 225 panels up to 5 m long, coarse" in line


def test_bottom_panels_as_long_as_the_water_under_them_is_deep():
    hull = plain(100, 50, 10, (10, 5, 5))
    line = both("on the bottom", {"mesh": hull, "depth": 15.1}, {"mesh": hull, "depth": 14.9})
    assert "50 of 125 panels on the bottom longer than the depth of water under them: up to 5 m over 4.9 m" in line
    more = int(line.split("about ")[1].split()[0])  # (5/4.9)² of four quarters, and a twentieth: 5 m become 4.8 m
    assert more == 550 and 5.0 * np.sqrt(500 / more) < 4.9


def test_a_side_that_slopes_by_thirty_degrees_is_bottom():
    def side(down):
        """20 m long from z = −4 to 0, its normal `down` below the horizontal, as a sine"""
        rise = np.array([0.0, down, np.sqrt(1 - down**2)]) * 4 / np.sqrt(1 - down**2)
        low, high = np.array([[-10.0, 1, -4], [10, 1, -4]]), np.array([[-10.0, 1, -4], [10, 1, -4]]) + rise
        return replace(structured(np.stack([low, high], axis=1)).flipped(), symmetry="y")

    assert side(0.52).normals[0, 2] == pytest.approx(-0.52)
    both("on the bottom", {"mesh": side(0.48), "depth": 5.0}, {"mesh": side(0.52), "depth": 5.0})


def framed(length, width):
    """A box of 300 m² with a hole of length x width in a bottom panel of 2.5 m, which is a frame of four"""
    hull = box(10, 10, 5, counts=(2, 2, 2), grading=False, symmetry="")
    hole = int(np.argmin(hull.centroids[:, 2] * 100 + np.abs(hull.centroids[:, :2]).sum(axis=1)))
    rim = hull.corners[hole]
    assert hull.normals[hole, 2] == -1
    middle = hull.vertices[hole].mean(axis=0)
    inner = middle + (hull.vertices[hole] - middle) / 1.25 * (0.5 * length, 0.5 * width, 0)
    n = len(hull.points) + np.arange(4)
    frame = [[rim[i], rim[i - 3], n[i - 3], n[i]] for i in range(4)]
    rest = np.delete(hull.corners, hole, axis=0)
    return PanelMesh(np.vstack([hull.points, inner]), np.vstack([rest, frame]))


def test_a_hole_of_a_thousandth_of_the_wetted_area():
    """a² / (300 − a²) = 0.00095 and 0.00105"""
    side = [np.sqrt(300 * part / (1 + part)) for part in (0.00095, 0.00105)]
    small, large = (said("the hull is open", framed(a, a)) for a in side)
    assert small[0].startswith("warning: the hull is open along 4 edges, ") and "limit 0.1 %" in small[0]
    assert f"{4 * side[0]:.4g} m in all" in small[0] and f": {side[0] ** 2:.3g} m² of " in small[0]
    assert large[0].startswith("error: the hull is open along 4 edges, ") and large[0].endswith("; close it")


def test_a_slit_of_a_tenth_of_its_edges_is_a_seam():
    """A rectangle of sides a and ra leaves 2|area|/length = 2r/(1 + r)² of its mean edge: 0.0907 and 0.107"""
    a = 2.4
    (seam,), (hole,) = (findings(framed(a, r * a), depth=1000.0) for r in (0.05, 0.06))
    assert seam.severity == "warning" and "without sharing corners along 4 edges" in seam.text
    width = 2 * 0.05 * a**2 / (2 * 1.05 * a)
    assert f"{1.05 * a:.4g} m in all, up to {width:.2g} m apart" in seam.text
    assert hole.severity == "error" and "open along 4 edges" in hole.text


@pytest.mark.parametrize("beam", [(45.5, 44.8), (54.5, 55.2)])
def test_a_lid_a_tenth_smaller_or_larger_than_the_waterplane(beam):
    hull = plain(100, 50, 10)
    sound, broken = (lid(plain(100, b, 10), size=25.0) for b in beam)
    both("the lid covers", {"mesh": hull, "lid": sound}, {"mesh": hull, "lid": broken})


def test_volumes_a_hundredth_apart():
    """A loose wall of area a at x = 20 adds 20 a to the volume by x, and nothing to the others"""

    def with_wall(part):
        wide = part * 480 / 20 / 2
        wall = PanelMesh([(20, 0, -2), (20, wide, -2), (20, wide, 0), (20, 0, 0)], [[0, 1, 2, 3]])
        return joined([box(20, 8, 3, panels=60, symmetry=""), wall])

    still = hydrostatics(with_wall(0.0095))
    assert still.volume_difference == pytest.approx(0.0095) and still.volume == pytest.approx(480)
    np.testing.assert_allclose(still.volumes, (480 * 1.0095, 480, 480))
    with pytest.raises(ValueError, match=r"by x, y, z are 485.04, 480, 480 m³, 1.05 % apart; allowed: 1 %"):
        hydrostatics(with_wall(0.0105))


def test_rims_half_an_edge_apart_close_each_other():
    """Two rims of 12 sides, turned by half of one: corners are √(D² + (R − R cos 15°)²) from the other's sides"""
    edge, sagitta = 20 * np.sin(np.pi / 12), 10 * (1 - np.cos(np.pi / 12))

    def tube(share):
        apart = np.sqrt((share * edge) ** 2 - sagitta**2)
        angle = np.arange(13) * np.pi / 6
        rim = np.stack([10 * np.cos(angle), 10 * np.sin(angle), 0 * angle], axis=1)
        c, s = np.cos(np.pi / 12), np.sin(np.pi / 12)
        turned = rim @ [[c, s, 0], [-s, c, 0], [0, 0, 1]]
        wall = structured(np.stack([rim - [0, 0, 4], rim], axis=1))
        bottom = structured(np.stack([0 * rim - [0, 0, 4 + apart], turned - [0, 0, 4 + apart]], axis=1))
        wall = wall if wall.normals[0] @ wall.centroids[0] > 0 else wall.flipped()
        return joined([wall, bottom if bottom.normals[0, 2] < 0 else bottom.flipped()]).merged(1e-9)

    assert said("without sharing corners along 24 edges", tube(0.48))
    assert not said("is open", tube(0.48)) and said("is open along 24 edges", tube(0.52))


def test_each_of_two_crossing_hulls_tells_how_many_of_its_panels_lie_in_the_other():
    """Panels of 1 m of boxes of 4 x 4 m, 2 and 3 m deep, the second shifted by 2.1 and 1.1 m

    Of the first: 2 x 3 of the bottom, 3 x 2 of the end x = 2 and 2 x 2 of the side y = 2.  Of the second, whose bottom
    is below the first: 3 x 2 of the end x = 0.1 and 2 x 2 of the side y = −0.9.
    """
    one, other = plain(4, 4, 2, (2, 2, 2)).whole(), plain(4, 4, 3, (2, 2, 3)).whole().moved(dx=2.1, dy=1.1)
    first, second = overlaps(joined([one, other]).merged())
    assert first[:2] == (16, 48) and second[:2] == (10, 64)
    assert first[2][0] > 0 and first[2][1] > -1 and -1 <= second[2][1] < 2


def place_of(point):
    return "x = {:.4g}, y = {:.4g}, z = {:.4g} m".format(*point)


def test_every_finding_says_where_its_first_panel_or_edge_is():
    """A box of panels of 5 x 5 x 2 m: the middle of the panel or of the edge"""
    hull = plain(100, 50, 10, (10, 5, 5))

    def edited(change):
        corners = hull.corners.copy()
        return replace(hull, corners=change(corners))

    def collapsed(corners):
        corners[7] = corners[7, [0, 1, 1, 0]]
        return corners

    twice = edited(lambda c: np.vstack([c, c[[31, 4]]]))
    middle = hull.vertices.mean(axis=1)
    (line,) = said("present twice", twice)
    assert line == (
        f"error: 2 of 127 panels present twice, the first near {place_of(middle[31])}; remove the copies "
        "(`hakobune mesh --outer`)"
    )
    (line,) = said("without area", edited(collapsed))
    edge = hull.points[hull.corners[7, :2]].mean(axis=0)
    assert f"1 of 125 panels without area, the first is panel 7 near {place_of(edge)}" in line
    holed = replace(hull, corners=np.delete(hull.corners, 20, axis=0))
    (line,) = said("the hull is open", holed)
    numbers = [
        float(word) for word in line.split("near x = ")[1].replace(", y = ", " ").replace(", z = ", " ").split()[:3]
    ]
    sides = 0.5 * (hull.vertices[20] + np.roll(hull.vertices[20], -1, axis=0))
    assert np.abs(sides - numbers).sum(axis=1).min() < 1e-3
    turned = hull.corners.copy()
    turned[20] = turned[20, ::-1]
    (line,) = said("normals change side", replace(hull, corners=turned))
    numbers = [
        float(word) for word in line.split("near x = ")[1].replace(", y = ", " ").replace(", z = ", " ").split()[:3]
    ]
    assert np.abs(sides - numbers).sum(axis=1).min() < 1e-3
    bad = hull.points.copy()
    bad[hull.corners[3, 0]] = np.nan
    hit = int(np.flatnonzero((hull.corners == hull.corners[3, 0]).any(axis=1))[0])
    (line,) = said("not a finite number", replace(hull, points=bad))
    assert f"the first is panel {hit}; correct the file" in line


def test_a_slit_and_a_hole_in_one_hull_are_told_apart_with_their_own_lengths_and_areas():
    """A slit of 2 x 0.1 m in one panel of the bottom and a hole of 1.5 x 1 m in another"""
    hull, parts, points = box(10, 10, 5, counts=(2, 2, 2), grading=False, symmetry=""), [], []
    chosen = np.flatnonzero(hull.normals[:, 2] < -0.5)[[0, 3]]
    for panel, sides in zip(chosen, ((2.0, 0.1), (1.5, 1.0)), strict=True):
        rim, middle = hull.corners[panel], hull.vertices[panel].mean(axis=0)
        n = len(hull.points) + 4 * len(points) + np.arange(4)
        points.append(middle + (hull.vertices[panel] - middle) / 1.25 * (0.5 * sides[0], 0.5 * sides[1], 0))
        parts += [[rim[i], rim[i - 3], n[i - 3], n[i]] for i in range(4)]
    rest = np.delete(hull.corners, chosen, axis=0)
    made = PanelMesh(np.vstack([hull.points, *points]), np.vstack([rest, parts]))
    (slit,), (hole,) = said("without sharing corners", made), said("the hull is open", made)
    assert "along 4 edges, 2.1 m in all, up to 0.095 m apart" in slit  # half of 4.2 m; 0.4 m² over 4.2 m
    assert hole.startswith("error: the hull is open along 4 edges, 5 m in all, the first near")


@pytest.mark.parametrize("off, told", [(0.0039, True), (0.0041, False)])
def test_a_half_is_known_by_edges_within_four_thousandths_of_a_plane(off, told):
    """Panels of 2 by 2 m along y = 0, drawn off it by a share of that"""
    half = replace(box(8.0, 8.0, 4.0, counts=(2, 2, 2), grading=False, symmetry="y"), symmetry="")
    points = half.points.copy()
    points[np.flatnonzero((points[:, 1] == 0) & (points[:, 2] < 0))[0], 1] = 2.0 * off
    assert bool(said("all of them in y = 0: it is one half of a hull;", replace(half, points=points))) is told


def test_a_panel_has_an_area_above_a_thousand_millionth_of_the_square_of_its_longest_edge():
    """A triangle on 100 m, 50 h m²: limit 1e-5 m²"""

    def sliver(h):
        points = np.array([[0, 0, -1], [100, 0, -1], [50, h, -1]])
        return {"mesh": PanelMesh(points, np.array([[0, 1, 2, 2]]))}

    assert _reach(sliver(1.0)["mesh"]) == pytest.approx(1e-4)  # m, within which corners of 100 m of hull are one
    line = both("without area", sliver(2.1e-7), sliver(1.9e-7), "error")
    assert "1 of 1 panels without area" in line


@pytest.mark.parametrize("more, most", [(0, 3), (1, 4), (2, 5)])
def test_edges_of_inner_walls_are_counted_with_the_most_panels_that_meet_in_one(more, most):
    """A bulkhead across a box meets an edge of each side; further walls from there all meet one of the two"""
    hull = plain(4, 2, 1).whole()
    foot, top = (0.0, -1.0, -1.0), (0.0, -1.0, 0.0)
    walls = [PanelMesh([foot, (0.0, 1.0, -1.0), (0.0, 1.0, 0.0), top], [[0, 1, 2, 3]])]
    for n in range(more):
        walls.append(PanelMesh([foot, (0.5 + n, -0.5, -1.0), (0.5 + n, -0.5, 0.0), top], [[0, 1, 2, 3]]))
    (line,) = said("more than two panels", joined([hull, *walls]))
    assert f"2 edges with more than two panels (up to {most}), the first near" in line and "remove inner" in line


def test_a_panel_that_faces_up_lies_in_the_surface_with_all_of_its_corners_a_millionth_of_the_draft_deep_at_most():
    """A hull of 5 m; one corner at 6 or 4 µm, the others in the surface"""

    def under(deep):
        plate = PanelMesh([[1, 1, 0], [2, 1, 0], [2, 2, 0], [1, 2, -deep]], [[0, 1, 2, 3]])
        return {"mesh": joined([plain(20.0, 10.0, 5.0).whole(), plate])}

    line = both("in the water surface", under(6e-6), under(4e-6), "error")
    assert "1 of " in line and "facing up: they are dry; remove them" in line
