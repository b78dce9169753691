"""Points of a response study: named points, pairs of points on two bodies, and points of the bottom."""

import math
from collections import Counter

from hakobune.bem.bodies.one_of_several import each_body
from hakobune.mooring.response.points import KeelPoint, Pair, Point, corners_of_bottom

from ..common.quantities import StudyError, positive


def places_of(study, db):
    """Points and pairs of a ResponseStudy, followed by the points of the bottom; db : database"""
    named = [point.name for point in (*study.points, *study.relative, *study.hinges)]
    twice = [name for name, count in Counter(named).items() if count > 1]
    if twice:
        raise StudyError(f"two points are called {twice[0]!r}; give each its own name")
    for i, point in enumerate(study.points):
        if not all(map(math.isfinite, point.position)):
            raise StudyError(f"points[{i}].position is {list(point.position)}; allowed: finite, m")
        if point.clearance is not None:
            positive(f"points[{i}].clearance", point.clearance)
        _check_body_of(f"points[{i}]", point, db.bodies)
    points = [Point(point.name, point.position, point.clearance, point.body) for point in study.points]
    pairs = [_pair(f"relative[{i}]", one, points, db) for i, one in enumerate(study.relative)]
    stations = [one for i, table in enumerate(study.stations) for one in table.stations(f"stations[{i}]", db)]
    return points + pairs + stations + (keel_points(study.keel, db) if study.keel else [])


def keel_points(table, db):
    """`KeelPoint`s of a KeelTable.  Raises StudyError if there is no water under one of the points at rest."""
    if not math.isfinite(db.water_depth):
        raise StudyError("[keel] is given, but the water of the database has no bed; solve it in finite depth")
    for key in ("tide", "extra_draft"):
        if not math.isfinite(getattr(table, key)):
            raise StudyError(f"keel.{key} is {getattr(table, key)}; allowed: finite, m")
    if db.bodies and table.points is not None:
        raise StudyError("keel.points is given with several bodies; leave it out, the corners of each bottom are used")
    found = [("", point) for point in table.points or ()]
    if table.points is None:
        found = [(name, point) for name, points in _bottoms(db) for point in points]
    points = []
    for name, (x, y, z) in found:
        gap = db.water_depth + table.tide + z - table.extra_draft
        if not gap > 0:
            raise StudyError(
                f"under ({x:g}, {y:g}, {z:g}) there is {gap:.3g} m of water at rest, with depth {db.water_depth:g} m, "
                f"tide {table.tide:g} m and extra draft {table.extra_draft:g} m; allowed: above 0 m"
            )
        title = f"{name} keel x {x:.4g} y {y:.4g}".strip()
        points.append(KeelPoint(title, (float(x), float(y), float(z)), gap, name))
    return points


def _bottoms(db):
    """Return (name, corners (n, 3), m, of the bottom in its own coordinates) of every moving body"""
    if not db.bodies:
        yield "", corners_of_bottom(db.mesh.whole().points)
    for body, one in zip(db.bodies, each_body(db), strict=False):
        if not body.fixed:
            yield body.name, (corners_of_bottom(one.mesh.whole().points) - (*body.place, 0.0)) @ body.axes


def _check_body_of(where, point, bodies):
    """Raise StudyError for a point of no or an unknown body, and for a clearance beside other hulls"""
    known = [body.name for body in bodies]
    if point.body not in (known or [""]):
        allowed = f"one of {', '.join(known)}" if known else "left out, since the database has one body"
        raise StudyError(f"{where}.body is {point.body!r}; allowed: {allowed}")
    if known and point.clearance is not None:
        raise StudyError(
            f"{where}.clearance is given, but the elevation between hulls is not known; leave it out, or give one body"
        )


def _pair(where, table, points, db):
    """`mooring.response.points.Pair` of a RelativeTable"""
    if not db.bodies:
        raise StudyError(f"{where} is given, but the database has only one body; leave the table out")
    found = {point.name: point for point in points}
    unknown = [name for name in table.points if name not in found]
    if unknown:
        raise StudyError(f"{where}.points has {unknown[0]!r}; allowed: names of [[points]]: {', '.join(found)}")
    ends = tuple(found[name] for name in table.points)
    if ends[0].body == ends[1].body:
        raise StudyError(
            f"{where}.points are both on {ends[0].body} and do not move relative to each other; allowed: points on "
            "two bodies"
        )
    return Pair(table.name, ends)
