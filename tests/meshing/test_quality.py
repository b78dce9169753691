from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.lid import lid
from hakobune.meshing.panels import SYMMETRIES, joined, structured
from hakobune.meshing.quality import findings
from hakobune.meshing.shapes import box, buoy

HULL = box(100, 50, 10, counts=(10, 5, 5))


def edited(change):
    corners = HULL.corners.copy()
    return replace(HULL, corners=change(corners))


def turn_one(corners):
    corners[0] = corners[0, ::-1]
    return corners


def collapse_one(corners):
    corners[0] = corners[0, [0, 1, 1, 0]]
    return corners


def with_point(k, xyz):
    points = HULL.points.copy()
    points[k] = xyz
    return replace(HULL, points=points)


def inner_wall():
    """The box with a bulkhead from the bottom's edge x = const upward."""
    x = np.unique(HULL.points[:, 0])[3]
    on_line = HULL.points[np.isclose(HULL.points[:, 0], x) & (HULL.points[:, 2] == -10)]
    line = on_line[np.argsort(on_line[:, 1])]
    return joined([HULL, replace(structured(np.stack([line, line + [0, 0, 3]])), symmetry="xy")])


BROKEN = {
    "no panels": (lambda: edited(lambda c: c[:0]), {}, "error", "no panels"),
    "nan": (lambda: with_point(5, (np.nan, 0, 0)), {}, "error", "not a finite number"),
    "infinite": (lambda: with_point(5, (np.inf, 0, 0)), {}, "error", "not a finite number"),
    "dry": (lambda: HULL.moved(dz=1), {}, "error", "30 of 125 panels above the water, up to z = 1 m"),
    "lid in the hull": (lambda: joined([HULL, lid(HULL)]), {}, "error", "45 of 170 panels in the water surface"),
    "no area": (lambda: edited(collapse_one), {}, "error", "1 of 125 panels without area"),
    "hole": (lambda: edited(lambda c: c[1:]), {}, "error", "open along 2 edges"),
    "missing end": (lambda: edited(lambda c: c[HULL.normals[:, 0] < 0.5]), {}, "error", "open along"),
    "bulkhead": (inner_wall, {}, "error", "more than two panels"),
    "inward": (HULL.flipped, {}, "error", "125 of 125 panels point into the body (volume -50000 m³)"),
    "mixed": (lambda: edited(turn_one), {}, "error", "normals change side"),
    "across": (
        lambda: replace(HULL, points=HULL.points - [1, 0, 0]),
        {},
        "error",
        "mirror plane x = 0, down to x = -1",
    ),
    "twice": (lambda: edited(lambda c: np.vstack([c, c[:2]])), {}, "error", "2 of 127 panels present twice"),
    "long": (lambda: box(1000, 10, 1, counts=(1, 8, 8)), {}, "warning", "aspect ratio"),
    "warped": (lambda: with_point(0, HULL.points[0] + [0, 0, -5]), {}, "warning", "not flat"),
    "coarse": (lambda: HULL, {"shortest_wave": 20.0}, "warning", "coarse for the wave length 20 m; good: ≤ 6.67 m"),
    "aground": (lambda: HULL, {"depth": 8.0}, "error", "leaves -2 m of water"),
    "touching": (lambda: HULL, {"depth": 10.0}, "error", "leaves 0 m of water"),
    "narrow gap": (lambda: HULL, {"depth": 11.0}, "warning", "up to 7.82 m over 1 m"),
    "wall above the bed": (lambda: buoy(10, 20, bottom=False), {"depth": 21.0}, "error", "open along"),
    "low lid": (lambda: HULL, {"lid": lid(HULL).moved(dz=-1)}, "error", "lid is 1 m off"),
    "lid down": (lambda: HULL, {"lid": lid(HULL).flipped()}, "error", "point down"),
    "small lid": (lambda: HULL, {"lid": lid(box(100, 40, 10))}, "warning", "covers 4000 m² of a waterplane of 5000"),
    "whole lid": (lambda: HULL, {"lid": lid(HULL).whole()}, "error", "the lid has the symmetry ''"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_broken_is_found(name):
    make, more, severity, words = BROKEN[name]
    found = findings(make(), **{"depth": 50.0} | more)
    assert any(f.severity == severity and words in f.text for f in found), [str(f) for f in found]
    assert all("\n" not in f.text for f in found)


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_a_wall_that_stands_on_the_bed_is_closed_and_said(symmetry):
    hull = buoy(10, 20, bottom=False, symmetry=symmetry)
    (found,) = findings(hull, depth=20.0)
    rim = hull.whole().points
    sides, radius = np.count_nonzero(rim[:, 2] < -19.99), np.hypot(*rim[0, :2])
    assert found.severity == "warning"
    assert f"z = -20 m, along {2 * radius * sides * np.sin(np.pi / sides):.4g} m" in found.text


def test_a_rim_below_the_water_and_a_foot_above_the_bed_are_told():
    hull = buoy(10, 20, panels=60)
    (text,) = [found.text for found in findings(hull.moved(0, 0, -0.5)) if found.severity == "error"]
    assert "all of them at its top, z = -0.5 m: if this is the waterline" in text
    assert "--move 0,0,0.5" in text
    wall = buoy(10, 20, bottom=False)
    (text,) = [found.text for found in findings(wall, depth=25.0) if found.severity == "error"]
    assert "all of them at its foot, z = -20 m" in text


@pytest.mark.parametrize("axis", "xy")
def test_a_half_that_nothing_mirrors_is_told(axis):
    half = replace(buoy(10, 10, panels=60, symmetry=axis), symmetry="")
    errors = [found.text for found in findings(half) if found.severity == "error"]
    assert len(errors) == 1
    assert f"in {axis} = 0: it is one half of a hull;" in errors[0]
    assert f"--mirror {axis}" in errors[0]


def test_one_inward_hull_beside_an_outward_one_is_found():
    one = box(100, 10, 10, panels=200, symmetry="")
    pair = joined([one.moved(dy=20), one.moved(dy=-20).flipped()])
    (found,) = findings(pair)
    assert f"{len(one)} of {2 * len(one)} panels point into the body" in found.text


def test_errors_come_before_warnings():
    found = findings(edited(lambda c: c[1:]), depth=50.0, shortest_wave=10.0)
    assert [f.severity for f in found] == ["error", "warning"]


def test_points_that_are_not_welded_make_no_hole():
    loose = replace(HULL, points=HULL.vertices.reshape(-1, 3), corners=np.arange(4 * len(HULL)).reshape(-1, 4))
    assert findings(loose, depth=50.0) == []


def test_a_wall_on_the_bed_looks_inwards_where_all_of_what_stands_there_does():
    """Outside and pool of a ring together: the pool alone has the other sign and is right"""
    wall = buoy(10, 20, bottom=False, symmetry="")
    ring = joined([wall, buoy(5, 20, bottom=False, symmetry="").flipped()])
    for hull in (wall, ring):
        inwards = [found.text for found in findings(hull.flipped(), depth=20.0) if "point into the body" in found.text]
        assert len(inwards) == 1 and f"the normals of {len(hull)} of {len(hull)} panels" in inwards[0]
        assert not any("point into the body" in found.text for found in findings(hull, depth=20.0))


@pytest.mark.parametrize("name", [name for name in BROKEN if name not in ("nan", "infinite")])
def test_what_is_found_is_the_same_of_a_hull_of_any_size(name):
    """By kind, in order; numbers are those of its lengths"""
    make, more, *_ = BROKEN[name]
    kinds = []
    for size in (1.0, 400.0, 0.003):
        lengths = {key: replace(part, points=size * part.points) if hasattr(part, "points") else size * part
                   for key, part in ({"depth": 50.0} | more).items()}  # fmt: skip
        hull = make()
        found = findings(replace(hull, points=size * hull.points), **lengths)
        kinds.append([(one.severity, "".join(c for c in one.text.split(";")[0] if c.isalpha())[:12]) for one in found])
    assert kinds[0] == kinds[1] == kinds[2]
