"""Bodies of revolution among several: round for wind, current and drag, and held by lines on their rim."""

import math
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.modes import Body
from hakobune.meshing.panels import PanelMesh
from hakobune.mooring.lines.system.moored_body import corner_legs
from hakobune.mooring.lines.system.parts import LineType, UniformLine
from hakobune.pipelines.moor.study import box_of, make_study

SIDES = 24
STUDY = """
[water]
depth = 30.0
[hulls.a]
freeboard = 4.0
"""


def prism(count, radius, turn=0.0, squeeze=1.0, draft=5.0):
    """Wetted points and corners of an upright prism of `count` sides, a point under its middle"""
    angle = turn + 2 * np.pi / count * np.arange(count)
    rim = radius * np.stack([np.cos(angle), squeeze * np.sin(angle)], axis=1)
    top, keel = (np.column_stack([rim, np.full(count, z)]) for z in (0.0, -draft))
    i, j = np.arange(count), np.roll(np.arange(count), -1)
    sides = np.stack([i, count + i, count + j, j], axis=1)
    bottom = np.stack([count + i, 2 * count + 0 * i, 2 * count + 0 * i, count + j], axis=1)
    return np.vstack([top, keel, [[0.0, 0.0, -draft]]]), np.vstack([sides, bottom])


def several(*hulls):
    """As much of a database of several bodies as their sizes need; hulls : (prism, place, heading in °)"""
    points, corners, of, bodies, first = [], [], [], [], 0
    for number, ((own, panels), place, heading) in enumerate(hulls):
        body = Body("ab"[number], (*place, 0.0), math.radians(heading), False, place)
        points.append(own @ body.axes.T + (*place, 0.0))
        corners.append(panels + first)
        of += [number] * len(panels)
        bodies.append(body)
        first += len(own)
    mesh = PanelMesh(np.vstack(points), np.vstack(corners), body=np.array(of))
    return SimpleNamespace(bodies=bodies, mesh=mesh, path=Path("both.h5"), modes=())


@pytest.mark.parametrize("count, is_round", [(SIDES, True), (12, True), (8, False), (4, False)])
def test_a_body_of_revolution_among_several_is_round(count, is_round):
    """Twelve sides and more, as for one body; a body elsewhere, turned, beside another one"""
    db = several((prism(count, 6.0), (40.0, -7.0), 10.0), (prism(4, 8.0, np.pi / 4), (0.0, 0.0), 0.0))
    size = box_of(db, db.bodies[0])
    assert size.get("radius", 0.0) == pytest.approx(6.0 if is_round else 0.0)
    assert size["draft"] == pytest.approx(5.0) and "radius" not in box_of(db, db.bodies[1])
    hull = make_study(tomllib.loads(STUDY)).hulls_of(db)["a"]
    assert hull.is_round is is_round and hull.beam == pytest.approx(12.0)


def test_an_oval_one_is_not():
    db = several((prism(SIDES, 6.0, squeeze=0.99), (0.0, 0.0), 0.0))
    assert "radius" not in box_of(db, db.bodies[0])


@pytest.mark.parametrize("is_round", [True, False])
def test_a_spread_leaves_the_rim_of_a_round_hull_and_the_corners_of_a_box(is_round):
    line = UniformLine("line", LineType("chain", 1000.0, 1e9), 160.0, "anchor", "fairlead")
    for leg in corner_legs(line, 12.0, 12.0, np.radians([30.0]), 20.0, 1e5, 1.0, is_round):
        out, way = np.abs(leg.fairlead[:2]), np.subtract(leg.anchor, leg.fairlead)[:2]
        wanted = 6.0 * np.array([math.cos(math.pi / 6), 0.5]) if is_round else [6.0, 6.0]
        assert out == pytest.approx(wanted, rel=1e-12) and leg.fairlead[2] == 1.0
        assert np.abs(way[1] / way[0]) == pytest.approx(math.tan(math.pi / 6), rel=1e-9)
