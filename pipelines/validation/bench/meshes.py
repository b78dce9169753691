"""Panels for other programs: uniform or graded, one part of the hull with its lid, or a wedge of a cylinder."""

import math

import numpy as np

from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

LID = 0.5  # panels of the lid for one of the hull: with a third the box in 20 m is up to 8 % farther off


def part(case, panels, graded, symmetry):
    """{"hull", "lid", "symmetry", "panels"} of at most `panels` on the whole hull

    symmetry : "xy" or "y", the mirror planes; "rotation": a wedge, with "copies"
    """
    if symmetry == "rotation":
        return _wedge(case, panels, graded)
    make = {"box": box, "buoy": buoy}[case.shape]
    counts = {} if graded else {"counts": _uniform(case, panels)}
    mesh = make(*case.sizes.values(), panels=panels, grading=graded, symmetry=symmetry, **counts)
    waterplane = -mesh.copies * mesh.area_vectors[:, 2].sum()
    inner = lid(mesh, math.sqrt(waterplane / (LID * mesh.total)))
    return {"hull": _lists(mesh), "lid": _lists(inner), "symmetry": symmetry, "panels": mesh.total}


def _lists(mesh):
    return {"vertices": mesh.points.tolist(), "faces": mesh.corners.tolist()}


def _uniform(case, panels):
    """Counts of panels as square as possible"""
    draft = case.sizes["draft"]
    if case.shape == "box":
        extents = (case.sizes["length"] / 2, case.sizes["beam"] / 2, draft)
        return _fitted(extents, lambda n: 4 * (n[0] * n[1] + (n[0] + n[1]) * n[2]), panels)
    radius = case.sizes["radius"]
    return _fitted((math.pi / 2 * radius, radius, draft), lambda n: 4 * n[0] * (n[1] + n[2]), panels)


def _fitted(extents, total, panels):
    """Counts in proportion to `extents`, as many as `panels` allow"""
    size = max(extents)
    counts = [1] * len(extents)
    while total(finer := [max(1, round(extent / size)) for extent in extents]) <= panels:
        counts, size = finer, 0.99 * size
    return tuple(counts)


def _wedge(case, panels, graded):
    """One of `copies` wedges about the x axis: the bottom from its centre, the wall, and the lid"""
    radius, draft = case.sizes["radius"], case.sizes["draft"]
    extents = (2 * math.pi * radius, radius, draft)
    _, n_bottom, n_wall = _fitted(extents, lambda n: n[0] * (n[1] + n[2]), panels)
    around = panels // (n_bottom + n_wall)  # rounding all three left 848 of 960
    step = 2 * math.pi / around
    rim = radius * math.sqrt(step / math.sin(step))  # polygon of equal area
    i, k = np.arange(n_bottom + 1) / n_bottom, np.arange(n_wall + 1) / n_wall
    out = rim * (np.sin(np.pi / 2 * i) if graded else i)
    up = -draft * (np.cos(np.pi / 2 * k) ** 2 if graded else 1 - k)
    profile = [*((r, -draft) for r in out), *((rim, z) for z in up[1:])]
    n_lid = max(1, n_bottom // 2)
    inner = [(rim * (1 - j / n_lid), 0.0) for j in range(n_lid + 1)]
    return {
        "hull": _swept(profile, step),
        "lid": _swept(inner, step),
        "symmetry": "rotation",
        "copies": around,
        "panels": around * (n_bottom + n_wall),
    }


def _swept(profile, step):
    """A strip of panels between the profile (r, z) rotated by −step/2 and by step/2, normals to its right"""
    angles = (-step / 2, step / 2)
    vertices = [(r * math.cos(a), r * math.sin(a), z) for a in angles for r, z in profile]
    n = len(profile)
    faces = [(i, i + n, i + n + 1, i + 1) for i in range(n - 1)]
    return {"vertices": vertices, "faces": faces}
