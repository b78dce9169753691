"""Errors and warnings about a mesh: findings, not exceptions, one line for each kind.

Every edge of a closed hull belongs to two panels, which run along the edge in opposite directions. An edge with one
panel lies in the water surface, on a mirror plane, on the sea bed under a body that stands on it, or on a seam, where
panels lie side by side without common corners (`seams`).
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..hydrostatics import waterplane_area
from ..panels import NO_AREA
from .outer import BODY, beside, wet
from .overlap import connected, overlaps
from .seams import rings

WELD = 1e-6  # points closer than this share of the hull's size are one point
AT_SURFACE = 1e-6  # distance from z = 0 below which a point lies in the surface, as a share of the draft
DRAWN = 4e-3  # distance within which a point belongs to the surface or a mirror plane, as a share of its edge
LONGEST_ASPECT = 100.0
LARGEST_WARP = 0.1  # distance of a corner from the panel's mean plane, of the longest edge
PANELS_PER_WAVE = 3  # panels of two by two nodes along a wave: six nodes a wave
OPEN_AREA = 1e-3  # largest area of holes without effect on a solution, over the wetted area: pipes that end on a wall
LID_AREA = 0.1  # relative difference between lid and waterplane


@dataclass(frozen=True)
class Finding:
    """A message on a mesh, in one line: cause, number, limit, remedy.

    severity : "error" for a fault that makes results wrong, "warning" for a fault that makes results inaccurate
    """

    severity: str
    text: str

    def __str__(self):
        return f"{self.severity}: {self.text}"


def findings(mesh, depth=math.inf, shortest_wave=None, lid=None):
    """Findings on a hull mesh, errors first; an empty list without findings.

    mesh : PanelMesh, in the form that the solver uses
    depth : depth of water, m
    shortest_wave : length of the shortest wave to be solved, m, or None
    lid : PanelMesh of the inner free surface, or None
    """
    unreadable = list(_numbers(mesh))
    if unreadable:
        return unreadable
    welded = mesh.merged(WELD)
    edges = _Edges(welded, depth)
    crossing = overlaps(mesh.whole().merged(WELD), depth)
    found = [
        *_position(mesh),
        *_shapes(mesh),
        *_duplicates(welded),
        *_holes(edges, float(mesh.areas.sum())),
        *_crowded(mesh, edges),
        *_orientation(welded, edges, crossing),
        *_overlaps(crossing),
        *_clearance(mesh, depth, edges),
        *_resolution(mesh, shortest_wave),
        *lid_findings(mesh, lid),
    ]
    return sorted(found, key=lambda finding: finding.severity != "error")


class _Edges:
    """Every edge of a mesh once, with its panels and their directions."""

    def __init__(self, mesh, depth):
        a, b = mesh.corners, np.roll(mesh.corners, -1, axis=1)
        panel = np.repeat(np.arange(len(mesh)), 4).reshape(-1, 4)
        real = a != b
        start, end, self.panel = a[real], b[real], panel[real]
        self.start, self.end = start, end
        ends = np.stack([np.minimum(start, end), np.maximum(start, end)], axis=1)
        self.ends, self.number = np.unique(ends, axis=0, return_inverse=True)
        self.number = self.number.reshape(-1)
        self.uses = np.bincount(self.number, minlength=len(self.ends))
        self.balance = np.bincount(
            self.number, np.where(start < end, 1, -1), minlength=len(self.ends)
        )  # 0 where two panels run in opposite directions
        self.points, self.symmetry = mesh.points, mesh.symmetry
        reach = _reach(mesh)
        both = mesh.points[self.ends]  # (e, 2, 3)
        self.at_surface = (np.abs(both[..., 2]) <= AT_SURFACE * max(mesh.draft, 0.0)).all(axis=1)
        self.at_bed = (np.abs(both[..., 2] + depth) <= reach).all(axis=1)
        self.on_plane = np.zeros(len(self.ends), bool)
        for axis in mesh.symmetry:
            self.on_plane |= (np.abs(both[..., "xy".index(axis)]) <= reach).all(axis=1)

    @cached_property
    def free(self):
        """Edges with one panel instead of two; shape (e,)"""
        return (self.uses == 1) & ~(self.at_surface | self.on_plane | self.at_bed)

    @cached_property
    def rings(self):
        """`seams.Rings` of the free edges, in the order of `free_sides`"""
        return rings(self.points, self.start[self.free_sides], self.end[self.free_sides], self.symmetry)

    @cached_property
    def free_sides(self):
        """Numbers of the panel sides that are free edges"""
        return np.flatnonzero(self.free[self.number])

    def middle(self, which):
        """Position of the first of the edges `which`, in words"""
        return _where(self.points[self.ends[np.flatnonzero(which)[0]]].mean(axis=0))

    def half(self, which):
        """Axis, "x" or "y", of the plane x = 0 or y = 0 in which edges lie, or "xy" where each lies in one of them, if
        the whole mesh is on one side of the plane; else None"""
        reach = DRAWN * float(np.median(np.linalg.norm(np.diff(self.points[self.ends], axis=1), axis=2)))
        side = [self.points[:, i].min() >= -reach or self.points[:, i].max() <= reach for i in (0, 1)]
        there = (np.abs(self.points[self.ends[which]][..., :2]) <= reach).all(axis=1)  # (e, 2)
        one = next((axis for i, axis in enumerate("xy") if side[i] and there[:, i].all()), None)
        return one or ("xy" if all(side) and there.any(axis=1).all() else None)

    def level(self, which):
        """End of a message on open edges: the waterline of the drawing, where they are the hull's top or foot"""
        z, ends = self.points[:, 2], np.unique(self.ends[which])
        reach = DRAWN * float(np.median(np.linalg.norm(np.diff(self.points[self.ends], axis=1), axis=2)))
        top, foot = (np.array_equal(np.flatnonzero(np.abs(z - at) <= reach), ends) for at in (z.max(), z.min()))
        if top:
            return (
                f", all of them at its top, z = {z.max():.6g} m: if this is the waterline, move it to z = 0 "
                f"(`hakobune mesh --move 0,0,{-z.max():.6g}`); otherwise close it"
            )
        if foot:
            return (
                f", all of them at its foot, z = {z.min():.6g} m: a wall may end there if this is the sea bed; "
                f"otherwise close it"
            )
        return "; close it"

    @property
    def stands_on_bed(self):
        return bool(np.any(self.at_bed & ~self.on_plane & (self.uses == 1)))

    @property
    def on_bed_length(self):
        """m, length of the edges on the sea bed, without the edges of mirror images"""
        ends = self.points[self.ends[self.at_bed & ~self.on_plane & (self.uses == 1)]]
        return float(np.linalg.norm(np.diff(ends, axis=1), axis=2).sum())


def _numbers(mesh):
    if not len(mesh):
        yield Finding("error", "the mesh has no panels")
        return
    bad = ~np.isfinite(mesh.vertices).all(axis=(1, 2))
    if bad.any():
        yield Finding(
            "error",
            f"{_count(bad)} with a corner that is not a finite number, the first is panel "
            f"{np.flatnonzero(bad)[0]}; correct the file",
        )


def _position(mesh):
    dry = mesh.vertices[..., 2].max(axis=1) > AT_SURFACE * max(mesh.draft, 0.0)
    if dry.any():
        top = mesh.vertices[..., 2].max()
        yield Finding(
            "error",
            f"{_count(dry)} above the water, up to z = {top:.4g} m; allowed: z ≤ 0; "
            "cut the hull there (`hakobune mesh --clip`) or move it down (`--move`)",
        )
    flat = np.abs(mesh.vertices[..., 2]).max(axis=1) <= AT_SURFACE * max(mesh.draft, 0.0)
    lids = flat & (mesh.area_vectors[:, 2] > 0)
    if lids.any():
        yield Finding(
            "error",
            f"{_count(lids)} in the water surface, facing up: they are dry; remove them; a lid is a separate mesh",
        )
    for axis in mesh.symmetry:
        side = mesh.vertices[..., "xy".index(axis)]
        across = side.min(axis=1) < -_reach(mesh)
        if across.any():
            yield Finding(
                "error",
                f"{_count(across)} across the mirror plane {axis} = 0, down to {axis} = {side.min():.4g} m; "
                f"allowed: {axis} ≥ 0; give one side only, or no symmetry",
            )


def _shapes(mesh):
    empty = mesh.areas <= NO_AREA * mesh.sizes**2
    if empty.any():
        yield Finding(
            "error",
            f"{_count(empty)} without area, the first is panel {np.flatnonzero(empty)[0]} near "
            f"{_where(mesh.vertices[empty][0].mean(axis=0))}; remove them",
        )
    sound = ~empty
    aspect = np.zeros(len(mesh))
    aspect[sound] = mesh.sizes[sound] ** 2 / mesh.areas[sound]
    long = aspect > LONGEST_ASPECT
    if long.any():
        yield Finding(
            "warning",
            f"{_count(long)} with an aspect ratio up to {aspect.max():.3g}, good: ≤ {LONGEST_ASPECT:g}; "
            "divide the long side into more panels",
        )
    warp = np.linalg.norm(mesh.vertices - mesh.flat_vertices, axis=2).max(axis=1)
    twisted = sound & (warp > LARGEST_WARP * mesh.sizes)
    if twisted.any():
        worst = (warp[sound] / mesh.sizes[sound]).max()
        yield Finding(
            "warning",
            f"{_count(twisted)} not flat, corners off the plane by up to {100 * worst:.3g} % of the longest edge, "
            f"good: ≤ {100 * LARGEST_WARP:g} %; use smaller panels or triangles",
        )


def _duplicates(mesh):
    _, first = np.unique(np.sort(mesh.corners, axis=1), axis=0, return_index=True)
    again = np.ones(len(mesh), bool)
    again[first] = False
    if again.any():
        yield Finding(
            "error",
            f"{_count(again)} present twice, the first near {_where(mesh.centroids[again][0])}; remove the copies "
            "(`hakobune mesh --outer`)",
        )


def _holes(edges, area):
    """area : m², of the mesh"""
    rings, sides = edges.rings, edges.free_sides
    for kind in (~rings.seam, rings.seam):
        if not kind.any():
            continue
        which = np.zeros(len(edges.ends), bool)
        which[edges.number[sides[kind[rings.number]]]] = True
        length, open_area, place = rings.length[kind].sum(), rings.area[kind].sum(), edges.middle(which)
        along = f"along {which.sum()} edges, {length:.4g} m in all, the first near {place}"
        if rings.seam[kind].all():
            yield Finding(
                "warning",
                f"panels meet without sharing corners along {which.sum()} edges, {0.5 * length:.4g} m in all, up to "
                f"{rings.widest:.2g} m apart, the first near {place}: the hull is watertight there, but less "
                "accurate; let panels meet corner to corner where it matters",
            )
        elif open_area <= OPEN_AREA * area:
            yield Finding(
                "warning",
                f"the hull is open {along}: {open_area:.3g} m² of {area:.5g} m², limit {100 * OPEN_AREA:g} %; it "
                "is solved with this opening",
            )
        elif plane := edges.half(which):
            yield Finding(
                "error",
                f"the hull is open {along}, all of them in {' = 0 or '.join(plane)} = 0: it is one "
                f"{'half' if len(plane) == 1 else 'quarter'} of a hull; add its mirror "
                f"image{'s' * (len(plane) - 1)} (`hakobune mesh --mirror {plane}`)",
            )
        else:
            yield Finding("error", f"the hull is open {along}{edges.level(which)}")


def _crowded(mesh, edges):
    """Edges of more than two panels are right where parts touch, if each panel there has water on one side only"""
    crowded = edges.uses > 2
    if not crowded.any():
        return
    panels = np.unique(edges.panel[crowded[edges.number]])
    hull = mesh.whole()
    numbers = beside(hull.closed() if edges.stands_on_bed else hull, panels)
    walls = np.count_nonzero(~wet(numbers) & (numbers.max(axis=0) > BODY))
    folds = np.count_nonzero(~wet(numbers)) - walls
    if walls or folds:
        states = (walls, "have the body on both sides"), (folds, "have water on both sides")
        what = " and ".join(f"{count} {state}" for count, state in states if count)
        yield Finding(
            "error",
            f"{crowded.sum()} edges with more than two panels (up to {edges.uses.max()}), the first near "
            f"{edges.middle(crowded)}: of {len(panels)} panels there {what}; remove inner walls and "
            "folds (`hakobune mesh --outer`)",
        )


def _orientation(mesh, edges, crossing):
    mixed = (edges.uses == 2) & (edges.balance != 0)
    if mixed.any():
        yield Finding(
            "error",
            f"normals change side across {mixed.sum()} edges, the first near {edges.middle(mixed)}; "
            "turn all of them out of the body (`hakobune mesh --flip`)",
        )
        return
    part, volume, closed = _parts(mesh, edges)
    standing = np.zeros(len(volume), bool)
    standing[part[edges.panel[edges.at_bed[edges.number]]]] = True  # the sign of its volume may be that of a moonpool
    inward = (volume < 0) & ~standing & closed
    for inside, of, place in crossing:
        if inside == of:  # a cavity, whose normals point into it, out of the body
            place = np.where([axis in mesh.symmetry for axis in "xyz"], np.abs(place), place)
            inward[part[np.argmin(np.linalg.norm(mesh.centroids - place, axis=1))]] = False
    if standing.any() and volume[standing].sum() < 0:
        inward |= standing
    if inward.any():
        panels = inward[part]
        yield Finding(
            "error",
            f"the normals of {_count(panels)} point into the body (volume {volume[inward].sum():.6g} m³); "
            "reverse them (`hakobune mesh --flip`)",
        )


def _parts(mesh, edges):
    """Number of the part of each panel (n,), volumes of the parts with their images in m³, and whether each is closed

    Panels of a part share edges or a seam.  The volume of an open part depends on the position of the origin.
    """
    n, e, sides = len(mesh), len(edges.ends), edges.free_sides
    seam = n + e + edges.rings.joint[edges.rings.number]
    a, b = np.concatenate([edges.panel, edges.panel[sides]]), np.concatenate([n + edges.number, seam])
    part = connected(a, b, n + e + edges.rings.joint.max(initial=-1) + 1)
    _, part = np.unique(part[:n], return_inverse=True)
    share = np.einsum("ni,ni->n", mesh.centroids, mesh.area_vectors) / 3
    closed = np.ones(part.max() + 1, bool)
    closed[part[edges.panel[sides[~edges.rings.seam[edges.rings.number]]]]] = False
    return part, mesh.copies * np.bincount(part, share), closed


def _overlaps(crossing):
    for inside, of, place in crossing:
        way = "join them into one hull, or move them apart"
        if inside == of:
            way += ", or remove the inner one, which no water reaches (`hakobune mesh --outer`)"
        yield Finding(
            "error",
            f"two parts of the hull overlap: {inside} of {of} checked panels of one are inside the other, the "
            f"first at {_where(place)}; {way}",
        )


def _clearance(mesh, depth, edges):
    gap = depth - mesh.draft
    if edges.stands_on_bed and abs(gap) <= _reach(mesh):
        length = mesh.copies * edges.on_bed_length
        yield Finding(
            "warning",
            f"the hull stands on the sea bed, z = {-depth:.6g} m, along {length:.4g} m: there is no water under "
            "it; it is solved as fixed to the bed",
        )
    elif not gap > 0:
        yield Finding(
            "error",
            f"the draft {mesh.draft:.4g} m leaves {gap:.4g} m of water under the keel; allowed: more than 0 in "
            f"{depth:.4g} m of water, or a wall without bottom that ends on the sea bed",
        )
        return
    low = mesh.normals[:, 2] < -0.5
    gaps = depth + mesh.centroids[:, 2]
    wide = low & (mesh.sizes > gaps)
    if wide.any():
        enough = f"{mesh.total * float((mesh.sizes / gaps)[wide].max()) ** 2 * 1.05:.2g}"
        yield Finding(
            "warning",
            f"{_count(wide)} on the bottom longer than the depth of water under them: up to "
            f"{mesh.sizes[wide].max():.3g} m over {gaps[wide].min():.3g} m; motions and mean drift "
            f"change little, but drift by pressure and forces of wave pairs (qtf) need more panels: about "
            f"{float(enough):.0f} on the whole hull are enough",
        )


def _resolution(mesh, shortest_wave):
    if shortest_wave is None:
        return
    limit = shortest_wave / PANELS_PER_WAVE
    coarse = mesh.sizes > limit * (1 + 1e-9)
    if coarse.any():
        yield Finding(
            "warning",
            f"{_count(coarse)} up to {mesh.sizes.max():.3g} m long, coarse for the wave length {shortest_wave:.4g} m; "
            f"good: ≤ {limit:.3g} m (a third); give more panels or leave out the shortest waves",
        )


def lid_findings(mesh, lid):
    """Findings on the lid (PanelMesh or None) of a hull mesh"""
    if lid is None:
        return
    off = np.abs(lid.points[np.unique(lid.corners), 2]).max(initial=0.0)
    if off > AT_SURFACE * max(mesh.draft, 0.0):
        yield Finding("error", f"the lid is {off:.4g} m off the water surface; allowed: z = 0")
    if len(lid) and lid.area_vectors[:, 2].min() < 0:
        yield Finding("error", "the lid has normals that point down; allowed: up")
    if lid.symmetry != mesh.symmetry:
        yield Finding("error", f"the lid has the symmetry {lid.symmetry!r}, the hull {mesh.symmetry!r}")
    inside = waterplane_area(mesh)
    covered = lid.copies * lid.areas.sum()
    if inside > 0 and abs(covered / inside - 1) > LID_AREA:
        yield Finding(
            "warning",
            f"the lid covers {covered:.4g} m² of a waterplane of {inside:.4g} m²; good: within "
            f"{100 * LID_AREA:g} %; make a new one with meshing.lid",
        )


def _reach(mesh):
    """m, distance below which two points are meant to be one"""
    return WELD * float(np.ptp(mesh.vertices.reshape(-1, 3), axis=0).max())


def _count(which):
    n = int(np.count_nonzero(which))
    return f"{n} of {len(which)} panels"


def _where(point):
    return f"x = {point[0]:.4g}, y = {point[1]:.4g}, z = {point[2]:.4g} m"
