"""Checks of a scene's tables [[modes]], and the file of a shape."""

import math
from pathlib import Path

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.flexible.beams import BENDING, KINDS
from hakobune.bem.flexible.tables import FEWEST

from .tables import SceneError

MOST = 40  # shapes of a beam
OF_KIND = {
    **dict.fromkeys(BENDING, ("EI", "length", "mass_per_length")),
    "torsion": ("GJ", "length", "inertia_per_length"),
    "file": ("file", "name", "stiffness", "mass"),
}
NEEDED = {**dict.fromkeys(BENDING, ("EI",)), "torsion": ("GJ",), "file": ("file", "name", "stiffness")}
OPTIONAL = tuple(dict.fromkeys(key for keys in OF_KIND.values() for key in keys))


def check_modes(scene):
    """Raise SceneError for a fault in [[modes]] of a `scene.Scene`"""
    if not scene.modes:
        return
    if scene.wall is not None:
        raise SceneError("modes and a wall are given; give only one of them")
    if any(body.GM is not None for body in scene.bodies):
        raise SceneError(
            "modes and the GM of a body are given; give z of center_of_gravity instead of GM, since the shapes need "
            "the position of the masses"
        )
    for number, mode in enumerate(scene.modes):
        _check(f"modes[{number}]", mode, scene)
    names = [(mode.body or "", name) for mode in scene.modes for name in names_of(mode)]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise SceneError(
            f"[[modes]] has {twice[1]!r} twice; allowed: each kind of beam once per body, and each name once"
        )
    for body in range(len(scene.bodies)):
        if len({mode.kind == "file" for mode in scene.modes if body in owners(scene, mode)}) > 1:
            raise SceneError("the modes of one body come from a beam and from files; allowed: only one of the two")


def names_of(mode):
    """Names of the shapes of a `tables.ModeTable`, without the body's name"""
    if mode.kind == "file":
        return [mode.name]
    return [f"{mode.kind.replace(' ', '_')}_{n}" for n in range(1, mode.count + 1)]


def owner(scene, mode):
    """Number of the body of a `tables.ModeTable`; for a shape of several bodies the first moving body"""
    return owners(scene, mode)[0]


def owners(scene, mode):
    """Numbers of the bodies of a `tables.ModeTable`: by default all moving bodies"""
    if not scene.several:
        return [0]
    if mode.body is None:
        return [i for i, body in enumerate(scene.bodies) if not body.fixed]
    return [[body.name for body in scene.bodies].index(mode.body)]


def between(scene, mode):
    """Whether a `tables.ModeTable` applies to several bodies together"""
    return scene.several and mode.body is None


def _check(key, mode, scene):
    if mode.kind not in OF_KIND:
        raise SceneError(f"{key}.kind is {mode.kind!r}; allowed: {', '.join(OF_KIND)}")
    for name in OPTIONAL:
        value, own = getattr(mode, name), OF_KIND[mode.kind]
        if value is None and name in NEEDED[mode.kind]:
            raise SceneError(f"{key}.{name} is missing; {mode.kind} has {', '.join(own)}")
        if value is not None and name not in own:
            raise SceneError(f"{key}.{name} is {value!r}; {mode.kind} has {', '.join(own)}")
        if isinstance(value, float) and not (0 < value < math.inf or (name == "stiffness" and value == 0)):
            raise SceneError(f"{key}.{name} is {value:g}; allowed: above 0, finite")
    _check_body(key, mode, scene)
    if not 0 <= mode.damping < 1:
        raise SceneError(f"{key}.damping is {mode.damping:g}; allowed: 0 to below 1, of critical")
    if not math.isfinite(mode.axis_height):
        raise SceneError(f"{key}.axis_height is {mode.axis_height:g}; allowed: finite, m")
    if mode.kind in KINDS and not 1 <= mode.count <= MOST:
        raise SceneError(f"{key}.count is {mode.count}; allowed: 1 to {MOST}")
    if mode.kind == "file":
        if not mode.name.isidentifier() or "__" in mode.name or mode.name.lower() in map(str.lower, DOFS):
            raise SceneError(
                f"{key}.name is {mode.name!r}; allowed: a word of letters, digits and _ that is not a rigid motion"
            )
        points_of(key, mode.file)


def _check_body(key, mode, scene):
    known = [body.name for body in scene.bodies]
    if not scene.several and mode.body not in (None, known[0]):
        raise SceneError(f"{key}.body is {mode.body!r}, but there is one body; leave it out")
    if between(scene, mode):
        if mode.kind != "file":
            raise SceneError(
                f"{key}.body is missing; allowed: {', '.join(map(str, known))}; a shape of all bodies together needs "
                f"a file"
            )
        return
    if scene.several and mode.body not in known:
        raise SceneError(f"{key}.body is {mode.body!r}; allowed: {', '.join(map(str, known))}")
    if scene.bodies[owner(scene, mode)].fixed:
        raise SceneError(f"{key}.body is {mode.body!r}, which is fixed; allowed: a body that moves")


def points_of(key, file):
    """Numbers in the file of a shape; shape (n, 6 or 7): x, y, z, ux, uy, uz and mass; lines of words are skipped"""
    if not Path(file).is_file():
        raise SceneError(f"{key}.file is {file!r}; there is no such file")
    rows = []
    for number, line in enumerate(Path(file).read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        words = line.partition("#")[0].replace(",", " ").replace(";", " ").split()
        try:
            row = [float(word) for word in words]
        except ValueError:
            if rows:
                raise SceneError(f"{file}, line {number}: {line.strip()[:40]!r} is not a row of numbers") from None
            continue
        if row:
            rows.append(row)
    lengths = {len(row) for row in rows}
    if lengths not in ({6}, {7}):
        raise SceneError(f"{file} has rows of {sorted(lengths)} numbers; allowed: 6 or 7, x y z ux uy uz and mass")
    found = np.array(rows)
    if len(found) < 2 * FEWEST or not np.all(np.isfinite(found)):
        raise SceneError(f"{file} has {len(found)} points; allowed: {2 * FEWEST} or more, all finite")
    if len(np.unique(found[:, :3], axis=0)) < len(found):
        raise SceneError(f"{file} has a point twice; allowed: each once")
    if not np.any(found[:, 3:6]):
        raise SceneError(f"all displacements in {file} are 0; allowed: a shape that moves")
    if found.shape[1] == 7 and (np.any(found[:, 6] < 0) or not np.any(found[:, 6])):
        raise SceneError(f"{file} has negative masses, or all masses are 0; allowed: 0 or more, kg, and one above 0")
    return found
