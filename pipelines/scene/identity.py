"""The part of a scene that must not change while its database grows, and the differences between two such parts.

The parsed scenes are compared, not their texts: a key added to the program later has its default in an older file.
A mesh file is identified by its content, wherever it lies: by a stored hash, or in older files by its panels.
"""

import hashlib
import re
import tomllib
from pathlib import Path

import msgspec
import numpy as np

from ..common.typed import typed
from .scene import Scene, SceneError

MESH_FILE = "mesh_file"  # attribute of a database: `content` of the mesh file
FILE = re.compile(r"(bodies|modes)\[\d+\]\.file")
FREE = re.compile(  # keys of the free body only
    r"bodies\[\d+\]\.(mass|center_of_gravity|GM|gyration|viscous)|viscous\."
    r"|modes\[\d+\]\.(EI|GJ|mass|stiffness|damping|mass_per_length|inertia_per_length)$"
)
SAME = 1e-6  # rounding of points in mesh files, over the size of the hull


def contents(scene):
    """`content` of the mesh files of a scene, then of the mesh files of its shapes, joined by "; "; None without mesh
    files"""
    tables = (*scene.bodies, *(scene.modes or ()))
    return "; ".join(content(table.file) for table in tables if table.file is not None) or None


def content(path):
    """A hash of the bytes of a file, as text"""
    return "sha256 " + hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]


def fixed_part(scene, mesh_file=None):
    """{key: value} of everything that must not change while a database grows.

    mesh_file : `content` of the mesh file, of several joined by "; ", None for their present content
    """
    raw = msgspec.to_builtins(scene)
    raw = {key: value for key, value in raw.items() if key not in ("waves", "want")}
    raw["tolerance"] = scene.accuracy if scene.panels is None else None  # beside panels it is a limit of checks alone
    contents = iter((mesh_file or "").split("; "))
    for body in raw["bodies"]:
        del body["trimmed"]  # no number depends on it
        if not body["fixed"]:
            del body["fixed"]  # older files do not have this key
        if body["file"] is not None:
            body["file"] = next(contents, "") or content(body["file"])
    for mode in raw["modes"] or ():
        if mode["file"] is not None:
            mode["file"] = next(contents, "") or content(mode["file"])
    return {key: repr(value) for key, value in _flat(raw).items() if value is not None}


def scene_hash(fixed):
    """Hash of `fixed_part`."""
    return hashlib.sha256(repr(sorted(fixed.items())).encode()).hexdigest()


def difference(old, new):
    """One phrase on the first keys in which two fixed parts differ, "" if they are equal."""
    keys = [key for key in {**old, **new} if old.get(key) != new.get(key)]
    shown = [_phrase(key, old.get(key, "not given"), new.get(key, "not given")) for key in keys[:2]]
    return "; ".join(shown) + (f" and {len(keys) - 2} more" if len(keys) > 2 else "")


def check_same(scene, header, output):
    """Differences only in mass, gyration, centre of gravity and viscous damping, in a phrase; "" without any.

    Raises SceneError, which names the difference, if the database `output` with this header is of another scene, or
    would lose its motions.
    """
    fixed = fixed_part(scene)
    if scene_hash(fixed) == header.scene_hash:
        return ""
    try:
        stored = typed(tomllib.loads(header.scene), Scene, SceneError)
    except ValueError as error:
        raise SceneError(
            f"{output} belongs to a scene that cannot be read: {error}; give --fresh to replace it or another --output"
        ) from None
    then = fixed_part(stored, _stored_content(scene, header))
    what = difference(then, fixed)
    if difference(*map(_flow, (then, fixed))) or (stored.motions_known and not scene.motions_known):
        raise SceneError(f"{output} belongs to another scene: {what}; give --fresh to replace it or another --output")
    return what


def _flow(fixed):
    """Part of a fixed part that the flow about the body depends on"""
    return {key: value for key, value in fixed.items() if not FREE.match(key)}


def _stored_content(scene, header):
    """`content` of the mesh file of a database; "unknown" if it is not stored and the panels have changed"""
    from hakobune.meshing.files import read_mesh

    if MESH_FILE in header.attributes or scene.several or scene.body.file is None:
        return header.attributes.get(MESH_FILE, "unknown")
    return content(scene.body.file) if _same_hull(read_mesh(scene.body.file), header.mesh) else "unknown"


def _same_hull(one, other):
    """Whether two meshes have the same panels, in any order, and written out or mirrored"""
    from scipy.spatial import KDTree

    (one, other), reach = (one.whole(), other.whole()), SAME * np.ptp(one.points, axis=0).max()
    if len(one) != len(other):
        return False
    apart, nearest = KDTree(one.centroids).query(other.centroids)
    turned = np.linalg.norm(one.area_vectors[nearest] - other.area_vectors, axis=1)
    return bool(apart.max() <= reach and np.all(turned <= SAME * other.areas.max()))


def _phrase(key, old, new):
    if FILE.fullmatch(key) and "not given" not in (old, new):
        return "the mesh file has changed"
    return f"{key} was {old}, is {new}"


def _flat(value, path=""):
    """{key: number, text …} of nested dictionaries and lists, as in bodies[0].length"""
    ends = [f"[{i}]" for i in range(len(value))] if isinstance(value, list) else [f".{key}" for key in value]
    found = {}
    for end, part in zip(ends, value if isinstance(value, list) else value.values(), strict=True):
        key = (path + end).removeprefix(".")
        found |= _flat(part, key) if isinstance(part, dict | list) else {key: part}
    return found
