"""Whether line ends lie on their hull and anchor, and whether each line reaches from one to the other."""

import numpy as np

from hakobune.bem.hinges import SPACE

from ..lines.system.findings import LONGEST_STRAIN
from ..lines.system.hawser import Hawser
from ..lines.system.parts import Fairlead
from ..response.findings import LINES_NAMED, some

BESIDE = 0.1  # largest distance of a fairlead outside the hull, over the hull length
NEAR = 0.01  # the same, above which a fairlead outside, or a line inside the hull, is reported


def check_places(system, hulls):
    """Raise ValueError for a fairlead off its hull, and for a line that is too short for its ends, whatever its
    material.

    system : at rest; hulls : (`conditions.Afloat`, …)
    """
    for line, anchor, fairlead, hull in _ends(system, hulls):
        out = _outside(fairlead, hull)
        if out > BESIDE * hull.length:
            x, y, z = fairlead
            raise ValueError(
                f"line {line.name}: its fairlead ({x:g}, {y:g}, {z:g}) m is {out:.4g} m off the hull of "
                f"{hull.length:g} by {hull.beam:g} m, z {-hull.draft:g} to {hull.freeboard:g} m; allowed: up to "
                f"{BESIDE * hull.length:.3g} m; coordinates are measured from the middle of the hull"
            )
        away = float(np.linalg.norm(fairlead - anchor))
        if away > (1 + LONGEST_STRAIN) * line.length and not isinstance(line, Hawser):
            raise ValueError(
                f"line {line.name} is {line.length:g} m long, and its anchor is {away:.4g} m from its fairlead: "
                f"the line is stretched by {100 * (away / line.length - 1):.3g} %, limit {100 * LONGEST_STRAIN:g} "
                "%, where any rope parts; give a longer line or a nearer anchor"
            )


def check_links(links, hulls):
    """Raise ValueError for a hinge whose distance from one of its hulls is larger than the length of the longest hull.

    links : `bem.hinges.Link`s, of which those between moving bodies and to space are checked; hulls :
        (`conditions.Afloat`, …)
    """
    known, longest = {one.name: one for one in hulls}, max(one.box.length for one in hulls)
    for link in links:
        first, own = known.get(link.bodies[0]), [known[name] for name in link.bodies if name in known]
        if first is None and link.bodies[0] != SPACE:  # on a fixed body, in its axes
            continue
        place = np.asarray(link.position, float)
        place = place if first is None else first.axes @ place + (*first.place, 0.0)
        for one in own:
            out = _outside(one.own(place), one.box)
            if out > longest:
                raise ValueError(
                    f"hinge {link.name} is {out:.4g} m off the hull of {one.name}; allowed: up to {longest:g} m, the "
                    f"longest hull; position is in the axes of {link.bodies[0]}"
                )


def check_floats(hulls, rises):
    """Raise ValueError if hinges hold a body at rest out of the water or under it.

    hulls : (name, `conditions.ExposedBox`) of each body; rises : height by which each body rises at rest, m
    """
    for (name, box), up in zip(hulls, rises, strict=True):
        if not -box.freeboard < up < box.draft:
            way, limit = ("up", box.draft) if up > 0 else ("down", box.freeboard)
            raise ValueError(
                f"hinges move {name} {way} by {abs(up):.3g} m at rest, limit {limit:.3g} m, its "
                f"{'draft' if up > 0 else 'freeboard'}; check for lines that pull one body under water, or "
                f"leave out the hinge"
            )


def place_findings(system, hulls):
    """Messages on fairleads off their hull, and on lines whose straight way to the other end crosses the hull"""
    beside, through, limit = [], [], f"limit {NEAR * max(one.box.length for one in hulls):.3g} m"
    for line, anchor, fairlead, hull in _ends(system, hulls):
        out, inside = _outside(fairlead, hull), _inside(fairlead, anchor, hull)
        if out > NEAR * hull.length:
            beside.append(f"{line.name} {out:.3g} m")
        if inside > NEAR * hull.length:
            through.append(f"{line.name} {inside:.3g} m")
    if beside:
        yield (f"these fairleads are away from the hull: {some(beside, LINES_NAMED)}; {limit}; check their coordinates")
    if through:
        yield (
            "these lines pass through the hull on the straight path from fairlead to anchor: "
            f"{some(through, LINES_NAMED)}; {limit}; check fairleads and headings"
        )


def off_the_mesh(system, body, mesh):
    """Messages on fairleads of the named body beside or below the box around its wetted hull, a PanelMesh"""
    points = mesh.whole().vertices.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    length = float(np.max(high[:2] - low[:2]))
    high[2] = np.inf  # unbounded: a wetted hull has no freeboard
    own = [point for point in system.points if isinstance(point, Fairlead) and point.body == body]
    away = [np.linalg.norm(np.maximum(np.maximum(low - p.position, p.position - high), 0.0)) for p in own]
    off = [f"{point.name} {out:.3g} m" for point, out in zip(own, away, strict=True) if out > NEAR * length]
    if off:
        limit = f"limit {NEAR * length:.3g} m"
        yield (
            f"these fairleads are away from the hull of the database: {some(off, LINES_NAMED)}; {limit}; check "
            "their coordinates"
        )


def _ends(system, hulls):
    """Return (line, its other end (3,), fairlead (3,), hull) of every line end at a hull, in coordinates of the hull"""
    points, bodies = {point.name: point for point in system.points}, {one.name: one for one in hulls}
    for line in system.lines:
        a, b = points[line.a], points[line.b]
        for end, other in ((b, a), (a, b)):
            if isinstance(end, Fairlead):
                one = bodies[end.body]
                yield line, one.own(_in_space(other, bodies)), one.own(_in_space(end, bodies)), one.box


def _in_space(point, bodies):
    """A point of the hull in space, m; shape (3,)"""
    if not isinstance(point, Fairlead):
        return np.asarray(point.position, float)
    body = bodies[point.body]
    return body.axes @ np.asarray(point.position, float) + body.position[:3]


def _box(hull):
    """Corners of the hull at least and at most x, y, z"""
    half = 0.5 * np.array([hull.length, hull.beam])
    return np.array([*-half, -hull.draft]), np.array([*half, hull.freeboard])


def _outside(point, hull):
    """m, of a point from the hull; 0 within"""
    low, high = _box(hull)
    if hull.is_round:  # its distance from the axis as x
        point = np.array([np.hypot(*point[:2]), 0.0, point[2]])
    return float(np.linalg.norm(np.maximum(np.maximum(low - point, point - high), 0.0)))


def _inside(start, end, hull):
    """m, length inside the hull of the straight line between two points"""
    low, high = _box(hull)
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        into, out = np.sort([(low - start) / way, (high - start) / way], axis=0)
    still = way == 0
    free = (start > low) & (start < high)
    into, out = np.where(still, np.where(free, -np.inf, np.inf), into), np.where(still, np.inf, out)
    if hull.is_round:
        into[:2], out[:2] = _in_circle(start[:2], way[:2], 0.5 * hull.beam)
    share = min(out.min(), 1.0) - max(into.max(), 0.0)
    return float(max(share, 0.0) * np.linalg.norm(way))


def _in_circle(start, way, radius):
    """Shares of a straight line in plan at which it enters and leaves a circle about the origin; inf, inf beside it"""
    square, along, beyond = way @ way, start @ way, start @ start - radius**2
    root = along**2 - square * beyond
    if square == 0 or root <= 0:
        return (-np.inf, np.inf) if square == 0 and beyond < 0 else (np.inf, np.inf)
    return (-along - np.sqrt(root)) / square, (-along + np.sqrt(root)) / square
