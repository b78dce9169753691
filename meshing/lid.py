"""Panels on the water surface inside a floating body (a lid), which remove irregular frequencies.

The boundary integral equation of the outer flow has irregular frequencies, the eigenfrequencies of sloshing inside the
hull.  Additional unknowns on the inner free surface remove these frequencies. Their exact density is zero, so the lid
may be coarse and need not share points with the hull.
"""

import math
from collections import defaultdict
from dataclasses import replace
from itertools import pairwise

import numpy as np

from .gmsh_session import filled, graded_patches
from .panels import PanelMesh, joined, structured

OPPOSITE = 0.999  # least cosine between the normal of a wall and the reversed one of a wall that lies on it
STRAIGHT = 1e-6  # sine of the turn below which two waterline edges form one line
OFF = 0.1  # largest distance of a chord from its ring, over the width of the lid
AT_SURFACE = 1e-6  # distance from z = 0 below which a point lies in the waterline, as a share of the draft


def lid(mesh, size=None):
    """Panels of the inner free surface of a hull, normals up, with the mirror planes of the hull.

    mesh : PanelMesh
    size : wanted edge length of panels, m; None: a third as many panels as the hull has
    returns : PanelMesh in z = 0, or None if nothing of the hull reaches the water surface

    Every closed waterline that runs counter-clockwise receives a lid. A clockwise waterline bounds a moonpool, whose
    water is outside the hull.  Raises ValueError if the waterline is open or touches itself.
    """
    loops = waterline(mesh)
    if not loops:
        return None
    rings = _closed(loops, mesh)
    areas = [_area(ring) for ring in rings]
    if sum(areas) <= 0:
        raise ValueError(
            f"lid: the waterline encloses {sum(areas):.4g} m²; its normals point inward, or it is not closed"
        )
    if size is None:
        size = math.sqrt(sum(areas) / max(1.0, len(mesh) / 3))
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"lid: size is {size} m; allowed: a positive length")
    outer = [ring for ring, area in zip(rings, areas, strict=True) if area > 0]
    holes = [ring for ring, area in zip(rings, areas, strict=True) if area < 0]
    pieces = [_filled(ring, [h for h in holes if _inside(h, ring)], size, mesh.symmetry) for ring in outer]
    whole = joined(pieces)
    return PanelMesh(whole.points, whole.corners, mesh.symmetry, f"lid of {mesh.name}".strip())


def polar_lid(mesh, size):
    """An axisymmetric `lid`, polar about the hull's axis: edges are up to `size` m along the rim, up to twice `size`
    radially.

    returns : PanelMesh with the mirror planes of the hull, or None if the waterline is not one regular polygon
    raises : ValueError as `lid`

    The edges along the rim determine the accuracy.  For a cylinder with 0.2 m of water under the keel, in waves three
    panel sizes long, the error of the excitation is 0.4 %. A lid that is not axisymmetric gives the same error; half
    the edges along the rim and twice as many across give 0.6 %.
    """
    rings = _closed(waterline(mesh), mesh)
    rim, pole = _regular(rings[0]) if len(rings) == 1 else (None, None)
    if rim is None:
        return None
    along = np.arange(parts := math.ceil(np.linalg.norm(rim[1] - rim[0]) / size))[:, None] / parts
    rim = np.concatenate([*(a + along * (b - a) for a, b in pairwise(rim)), rim[-1:]])
    inwards = np.linspace(1, 0, math.ceil(np.linalg.norm(rim[0] - pole) / (2 * size)) + 1)[None, :, None]
    cover = structured(pole + inwards * (rim - pole)[:, None])
    return replace(cover, symmetry=mesh.symmetry, name=f"lid of {mesh.name}".strip())


def rings_of(mesh):
    """[(ring, m, (k, 3), and area inside it, m²)] of the waterlines of a hull; the area of a moonpool is negative

    Raises ValueError as `lid` does.
    """
    return [(ring, _area(ring)) for ring in _closed(waterline(mesh), mesh)]


def panelled(ring, size, symmetry):
    """Panels with edges of about `size` m inside a closed polygon (k, 3) m in z = 0, counter-clockwise"""
    return _filled(ring, [], size, symmetry)


def waterline(mesh):
    """Intersection of the hull with the water surface: a list of (k, 3) m polylines with the body on their left.

    Closed polylines end with their first point, open ones on mirror planes; only the meshed part of the hull is
    covered.  Waterlines that touch in a point remain separate, each with the body on its left.  Raises ValueError
    where several edges meet at a point and the numbers of arriving and leaving edges differ.
    """
    welded = mesh.merged()
    points, edges = welded.points, _surface_edges(welded)
    leaving, arriving = defaultdict(list), defaultdict(list)
    for edge, (a, b) in enumerate(edges):
        leaving[a].append(edge)
        arriving[b].append(edge)
    after, starts, both = {}, [], set(edges)
    for point in {**leaving, **arriving}:
        here, there = arriving[point], leaving[point]
        doubled = any(edges[edge][::-1] in both for edge in there)
        if doubled or (max(len(here), len(there)) > 1 and len(here) != len(there)):
            raise ValueError(f"lid: the waterline forks at {_where(points[point])}; see the mesh findings")
        after |= _left(points, edges, here, there)
        starts += there if not here else []
    left, loops = set(range(len(edges))), []
    while left:
        chain = [starts.pop() if starts else min(left)]
        left.discard(chain[0])
        while (follows := after.get(chain[-1])) in left:
            chain.append(follows)
            left.discard(follows)
        loops.append(points[[edges[chain[0]][0], *(edges[edge][1] for edge in chain)]] * (1, 1, 0))
    return loops


def _left(points, edges, here, there):
    """{edge that arrives at a point: edge that leaves it with the same part of the body on its left}"""
    if len(here) < 2:
        return dict(zip(here, there, strict=False))
    back = [points[edges[edge][0]] - points[edges[edge][1]] for edge in here]
    on = [points[edges[edge][1]] - points[edges[edge][0]] for edge in there]
    turn = [[(np.arctan2(*u[1::-1]) - np.arctan2(*v[1::-1])) % (2 * np.pi) for v in on] for u in back]
    return {edge: there[int(np.argmin(row))] for edge, row in zip(here, turn, strict=True)}


def _surface_edges(mesh):
    """[(a, b)] point numbers of panel edges in z = 0, against the direction of the panel: the body is on the left

    An edge that two panels share, the ridge of a roof that ends in the surface, bounds no waterplane; one of two walls
    that lie on each other remains in both directions.
    """
    flat = np.abs(mesh.points[:, 2]) <= AT_SURFACE * max(mesh.draft, 0.0)
    a = mesh.corners
    b = np.roll(a, -1, axis=1)
    ours = flat[a] & flat[b] & (a != b)
    in_surface = flat[a].all(axis=1)  # a deck panel; its edges are no part of the waterline
    ours[in_surface] = False
    panel = np.nonzero(ours)[0]
    found = {(int(e), int(s)): n for s, e, n in zip(a[ours], b[ours], panel, strict=True)}
    if len(found) < len(panel):  # an edge that two panels run along in the same direction
        return [(int(e), int(s)) for s, e in zip(a[ours], b[ours], strict=True)]
    normals = mesh.normals
    ridges = {
        (e, s) for (e, s), n in found.items() if (s, e) in found and normals[n] @ normals[found[s, e]] > -OPPOSITE
    }
    return [edge for edge in found if edge not in ridges]


def _closed(loops, mesh):
    """Closed polygons (k, 3) of the waterplane; open waterlines are continued along the mirror planes.

    With the meshed half or quarter plane on the left, the place along its edge is x − y: down the y axis, then
    out the x axis.  A waterline that ends there is continued to the next that starts.
    """
    rings = [loop[:-1] for loop in loops if np.array_equal(loop[0], loop[-1])]
    arcs = [_on_planes(loop, mesh) for loop in loops if not np.array_equal(loop[0], loop[-1])]
    starts, ends = ([arc[i, 0] - arc[i, 1] for arc in arcs] for i in (0, -1))
    following = {}
    for k, end in enumerate(ends):
        ahead = [j for j, start in enumerate(starts) if start > end and j not in following.values()]
        if not ahead:
            raise ValueError(
                f"lid: the waterline that ends at {_where(arcs[k][-1])} does not close; normals may be inward"
            )
        following[k] = min(ahead, key=lambda j: starts[j])
    while following:
        k, ring = next(iter(following)), []
        while k in following:
            ring.append(arcs[k])
            after = following.pop(k)
            if ends[k] < 0 < starts[after]:
                ring.append(np.zeros((1, 3)))  # round the corner of the quarter plane
            k = after
        rings.append(np.concatenate(ring))
    return rings


def _on_planes(arc, mesh):
    """An open waterline with its ends put exactly on the mirror planes.  Raises ValueError if one is free."""
    arc, reach = arc.copy(), 1e-6 * np.ptp(mesh.points, axis=0).max()
    for end in (arc[0], arc[-1]):
        axes = ["xy".index(axis) for axis in mesh.symmetry if abs(end["xy".index(axis)]) <= reach]
        if not axes:
            raise ValueError(f"lid: the waterline has a free end at {_where(end)}; see the mesh findings")
        end[axes] = 0.0
    return arc


def _simplified(ring, size):
    """The polygon without collinear points, and on curved stretches with edges no shorter than about `size`."""
    before, after = np.roll(ring, 1, axis=0) - ring, np.roll(ring, -1, axis=0) - ring
    sine = _cross(after, before) / (np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1))
    forward = np.einsum("ij,ij->i", before, after) < 0
    ring = ring[~(forward & (np.abs(sine) < STRAIGHT))]
    inward, outward = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
    turn = np.arctan2(_cross(inward, outward), np.einsum("ij,ij->i", inward, outward))
    kept = np.abs(turn) > np.pi / 4  # a corner of the plan
    start = int(np.argmax(np.abs(turn)))
    ring, kept = np.roll(ring, -start, axis=0), np.roll(kept, -start)
    length = np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1)
    place = np.concatenate([[0.0], np.cumsum(length)])
    kept[0] = True
    corners = np.append(np.flatnonzero(kept), len(ring))
    chosen = [_spaced(place, first, last, size) for first, last in pairwise(corners)]
    chosen = np.concatenate(chosen)
    return ring[chosen] if len(chosen) > 2 else ring


def _spaced(place, first, last, size):
    """Numbers from `first` to before `last` whose places on the polygon are about `size` apart"""
    wanted = max(1, round((place[last] - place[first]) / size))
    marks = np.linspace(place[first], place[last], wanted + 1)[:-1]
    near = first + np.abs(place[first:last, None] - marks).argmin(axis=0)
    return np.unique(near)


def _true(ring, others, size):
    """`_simplified` with edges short enough to deviate from the ring by at most `OFF` of the lid's width there

    others : rings that bound the same lid.  A long chord cuts across a bay, a moonpool or a narrow ring.
    """
    width, side = _width(ring, others), np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1)
    plan = _simplified(ring, size)
    while size > side.min() and len(plan) < len(ring) and np.any(_distance(ring, plan) > OFF * width):
        size *= 0.7
        plan = _simplified(ring, size)
    return plan


def _width(ring, others):
    """Distance across the lid from each corner of a ring, m; shape (k,): to other rings, or a quarter of the distance
    to the ring itself

    Chords of equal deviation reduce the area of a disc by a share four times as large as that of a narrow ring.
    """
    side = np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1)
    place = np.cumsum(side) - side
    along = np.abs(place[:, None] - place)
    along = np.minimum(along, side.sum() - along)
    apart = np.linalg.norm(ring[:, None] - ring, axis=2)
    own = 0.25 * np.where(along > 1.5 * apart, apart, np.inf).min(axis=1)
    return np.min([own, *(_distance(ring, other) for other in others)], axis=0)


def _distance(points, ring):
    """Distance of points (k, 3) from the sides of a polygon, m; shape (k,)"""
    start, side = ring, np.roll(ring, -1, axis=0) - ring
    ahead = points[:, None] - start
    share = np.clip(np.einsum("ijk,jk->ij", ahead, side) / np.einsum("jk,jk->j", side, side), 0, 1)
    return np.linalg.norm(ahead - share[..., None] * side, axis=2).min(axis=1)


def _filled(ring, holes, size, symmetry):
    """Panels of about the area size² inside a ring and outside its holes."""
    plan = _simplified(ring, size)
    if len(plan) == 4 and not holes and _is_rectangle(plan):
        return _grid(plan, size, symmetry)
    wanted = (_area(ring) + sum(_area(hole) for hole in holes)) / size**2
    for _ in range(3):  # gmsh rounds edge numbers up and may make twice as many panels as requested
        rings = [ring, *holes]
        plans = [_true(one, [other for other in rings if other is not one], size) for one in rings]
        made = filled(plans[0], plans[1:], size, symmetry, "lid")
        if len(made) <= 1.2 * wanted:
            break
        size *= math.sqrt(len(made) / wanted)
    return made


def _grid(ring, size, symmetry):
    sides = []
    for k in range(4):
        a, b = ring[k], ring[(k + 1) % 4]
        n = max(1, round(float(np.linalg.norm(ring[k % 2 + 1] - ring[k % 2])) / size))
        sides.append(np.concatenate([a + np.arange(n)[:, None] / n * (b - a), b[None]]))
    return graded_patches([sides], symmetry, "lid")


def _regular(ring):
    """Corners (k, 3) and centre of a regular polygon, also of half or a quarter of one; (None, None) of others"""
    arc = ring[np.hypot(ring[:, 0], ring[:, 1]) > 0]  # the corner of a quarter plane is its centre
    if len(arc) < 4:
        return None, None
    first, second, third = arc[[0, len(arc) // 3, 2 * len(arc) // 3], :2]
    # the centre is as far from the first corner as from the others
    ahead = 2 * np.stack([second - first, third - first])
    if abs(np.linalg.det(ahead)) < STRAIGHT * np.linalg.norm(ahead) ** 2:
        return None, None
    pole = np.append(np.linalg.solve(ahead, [second @ second - first @ first, third @ third - first @ first]), 0.0)
    R = np.linalg.norm(arc - pole, axis=1)
    sides = np.linalg.norm(np.roll(arc, -1, axis=0) - arc, axis=1)
    even = np.abs(sides - sides[0]) <= STRAIGHT * R[0]
    if np.ptp(R) > STRAIGHT * R[0] or not np.all(even[:-1]):
        return None, None
    closed = even[-1] and len(arc) == len(ring)
    return (np.concatenate([arc, arc[:1]]) if closed else arc), pole


def _is_rectangle(ring):
    edges = np.roll(ring, -1, axis=0) - ring
    long = np.linalg.norm(edges, axis=1)
    dots = np.einsum("ij,ij->i", edges, np.roll(edges, -1, axis=0))
    return bool(np.all(np.abs(dots) <= 1e-9 * long * np.roll(long, -1)))


def _area(ring):
    """m², positive for a counter-clockwise ring"""
    return 0.5 * float(_cross(ring, np.roll(ring, -1, axis=0)).sum())


def _inside(ring, other):
    """Whether the first point of a ring is inside another ring, by the number of crossings to the right."""
    x, y = ring[0, :2]
    a, b = other, np.roll(other, -1, axis=0)
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    a, b = a[crosses], b[crosses]
    at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return bool(np.count_nonzero(at > x) % 2)


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _where(point):
    return f"x = {point[0]:.4g}, y = {point[1]:.4g} m"
