"""Panel files of others, found under a folder: is each read, and is what was read the hull that it is meant to be.

    python tests/bench/public_meshes.py FOLDER

A hull drawn whole is cut at the surface; one that is told to be a half is mirrored, a wall that is told to end on a
bed is given one, and one above z = 0 is moved down by half of its height, since the message asks for its draft.  Right
is one without an error among its findings, whose volumes by x, y and z agree within 2 % and whose lid has the area of
its waterplane within 5 %; the rest is refused, with the reason.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

import numpy as np

from hakobune.meshing.files import READABLE, read_mesh
from hakobune.meshing.lid import lid
from hakobune.meshing.mirror import folded
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.outer import outer
from hakobune.meshing.quality.outward import outward

VOLUMES, LID = 0.02, 0.05
PANELS = {".obj": rb"(?m)^f\s", ".toml": rb"\[\[parts\]\]", ".vtk": b"CELL_TYPES|POLYGONS",
          ".vtp": rb"NumberOfPolys=\"\s*[1-9]"}  # fmt: skip
HALF, FOOT = re.compile(r"--mirror ([xy]+)`"), re.compile(r"all of them at its foot, z = (-[\d.]+) m")
LARGEST = 6000  # panels that are looked at whole


def of_meshes(folder):
    """Files under a folder that hold panels by their ending; of those with a common one, by what is in them"""
    for path in sorted(folder.rglob("*")):
        ending = path.suffix.lower()
        listed = ending not in (".dat", ".hst", ".mar") or (path.is_file() and _lists_points(path))
        if not path.is_file() or ending not in READABLE or not listed:
            continue
        if ending not in PANELS or re.search(PANELS[ending], path.read_bytes()):
            yield path


def judged(path):
    """("right", "refused" or "wrong", why) of a file of panels"""
    try:
        mesh, done = read_mesh(path), ""
        if mesh.points[:, 2].min() >= 0 and np.ptp(mesh.points[:, 2]) > 0:
            bottom, top = mesh.points[:, 2].min(), mesh.points[:, 2].max()
            mesh, done = mesh.moved(0, 0, -0.5 * (bottom + top)), ", --move as told"
        if mesh.points[:, 2].max() > 0:
            mesh = mesh.clipped()
    except ValueError as error:
        return "refused", str(error).replace(str(path), path.name)
    if mesh.total > LARGEST:
        return "right", f"{mesh.total} panels, only read{done}"
    mesh, depth, told = folded(mesh), np.inf, ""
    while errors := [one.text for one in findings(mesh, depth) if one.severity == "error"]:
        half, foot = HALF.search(errors[0]), FOOT.search(errors[0])
        if half and half[1] not in mesh.symmetry:
            for axis in half[1]:
                mesh = mesh.mirrored(axis)
            done += f", --mirror {half[1]} as told"
        elif "hakobune mesh --flip" in " ".join(errors) and "--flip" not in done:
            mesh, done = outward(mesh), done + ", --flip as told"
        elif "hakobune mesh --outer" in " ".join(errors) and "--outer" not in done:
            told = next(text for text in errors if "--outer" in text)
            mesh, done = outer(mesh), done + ", --outer as told"
        elif foot and depth == np.inf:
            depth, done = -float(foot[1]), f", depth {-float(foot[1]):g} m as told"
        else:
            return "refused", told or errors[0]
    hull = mesh.whole()
    x, y, z = volumes(hull.vertices)
    if np.isinf(depth) and max(x, y, z) - min(x, y, z) > VOLUMES * abs(z):
        return "wrong", f"volumes {x:.5g}, {y:.5g}, {z:.5g} m³"
    below = np.any(hull.vertices[..., 2] < 0, axis=1)  # not the piston of a chamber, which is in the surface
    waterplane = -hull.area_vectors[below, 2].sum()
    if waterplane > 1e-6 * hull.areas.sum() and mesh.draft > 0:
        try:
            made = lid(mesh)
        except ValueError as error:
            return "refused", told or str(error)
        covered = 0.0 if made is None else made.whole().areas.sum()
        if abs(covered / waterplane - 1) > LID:
            return "wrong", f"a lid of {covered:.5g} m² on a waterplane of {waterplane:.5g} m²"
    return "right", f"{mesh.total} panels, {z:.6g} m³{done}"


def volumes(vertices):
    """(3,) m³, ∬x n_x dS, ∬y n_y dS and ∬z n_z dS over panels (n, 4, 3), each cut into two triangles"""
    a, b, c = (np.concatenate([vertices[:, i], vertices[:, j]]) for i, j in ((0, 0), (1, 2), (2, 3)))
    return np.sum((a + b + c) / 3 * 0.5 * np.cross(b - a, c - a), axis=0)


def _lists_points(path):
    with path.open(errors="replace") as file:
        lines = [line for line, _ in zip(file, range(4000), strict=False)]
    words = lines[0].split() if lines else []
    text = "".join(lines)
    if path.suffix.lower() == ".hst":
        return "COORDINATES" in text
    point = lines[1].split() if len(lines) > 1 else []
    pair = len(words) == 2 and words[1] in "01" and point[:1] == ["1"] and len(point) == 4  # of Nemoh
    return pair or "QPPL" in text or "*RETURN" in text


def main(folder):
    count = Counter()
    for path in of_meshes(folder):
        verdict, why = judged(path)
        count[verdict] += 1
        print(f"{verdict:8} {path.relative_to(folder)}: {why[:160]}")
    print(dict(count))


if __name__ == "__main__":
    np.seterr(all="ignore")
    main(Path(sys.argv[1]))
