"""All decisions before a frequency is solved, from a scene and from the header of its database."""

from dataclasses import dataclass, replace

import msgspec
import numpy as np

from hakobune.bem.database import open_database, pending
from hakobune.bem.database.file import Header
from hakobune.bem.database.schema import NEEDS_MOTION
from hakobune.bem.problem import Problem
from hakobune.bem.waves import wavenumber

from ..common.typed import to_toml
from ..printing.timing import phase
from ..scene.identity import check_same, fixed_part, scene_hash
from ..scene.methods import check_method
from ..scene.scene import Scene, SceneError
from .arrangement import own_hulls_of_modes
from .bending.modes import modes_of
from .header import body_properties, each_body, kochin_angles, make_header, named
from .hull import make_hull, stored_hull
from .large import check_database
from .problem import problem_of
from .remarks import remarks
from .weight import check_weight

KOCHIN = {"kochin_radiation", "kochin_diffraction"}


@dataclass(frozen=True, eq=False)
class Plan:
    """Content and means of a run.

    scene : scene with the method that solves it (`scene.solved_by`)
    omegas : (n,) rad/s and headings : (m,) rad, ascending; names : names of the database, wanted
    header : header of the database, with the mesh, the lid, the body at rest and the scene as text
    problem : `bem.methods` problem to be solved; remarks : for the reader, one line each
    anew : names of the database to be recomputed after a change of mass, gyration, centre of gravity or viscous
        damping
    """

    scene: Scene
    omegas: np.ndarray
    headings: np.ndarray
    names: tuple[str, ...]
    header: Header
    problem: Problem
    remarks: tuple[str, ...]
    anew: tuple[str, ...] = ()


def planned(scene):
    """`Plan` of a scene for a new database.  Raises SceneError if it cannot be solved."""
    with phase("mesh"):
        hull = make_hull(scene)
    return _plan(scene, hull, make_header(scene, hull))


def resumed(scene, file):
    """`Plan` of a scene for a database, given by its path or open, which is not changed.

    Raises SceneError if they do not match, or the scene cannot be solved.
    """
    db = open_database(file)
    moved = check_same(scene, db.header, db.path)
    header = replace(db.header, scene=to_toml(scene))
    if moved:
        fixed = scene_hash(fixed_part(scene))
        header = replace(
            header,
            body=body_properties(scene, db.mesh),
            modes=modes_of(scene, own_hulls_of_modes(scene, db.mesh)),
            scene_hash=fixed,
        )
    scene = _by_the_same_method(scene, header, db.path)
    header = _with_angles(scene, db, pending(file), header)
    plan = _plan(scene, stored_hull(scene, header), header)
    anew = tuple(name for name in (*NEEDS_MOTION, "pressure") if moved and name in db.names)
    told = (
        (
            f"{moved}: {', '.join(anew)} are computed again, from the stored coefficients and Kochin functions if "
            "there are any",
        )
        if anew
        else ()
    )
    return replace(plan, anew=anew, remarks=(*plan.remarks, *told))


def _plan(scene, hull, header):
    for name, *one in each_body(scene, hull.mesh, header.body):
        with named(name):
            check_weight(*one)
    asked = scene.omegas(), scene.headings(), scene.names()
    check_database(header, len(asked[0]), len(asked[1]), asked[2])
    return Plan(scene, *asked, header, problem_of(header, scene), remarks(scene, hull, header.body))


def _by_the_same_method(scene, header, output):
    """The scene with the method of its first frequencies, if it leaves the choice.  Raises SceneError."""
    if scene.method != "auto":
        return scene
    same = msgspec.structs.replace(scene, method=header.attributes["method"])
    try:
        check_method(same)
    except ValueError as error:
        raise SceneError(
            f"{output} has been solved by method {same.method} so far, but {str(error).partition(';')[0]}; give "
            f"--fresh to replace it or another --output"
        ) from None
    return same


def _with_angles(scene, db, lacking, header):
    """The header with as many angles of the Kochin functions as the shortest waves need; mean drift has its own"""
    if not KOCHIN & {*db.names, *scene.names()}:
        return header
    highest = max([*db.omega, *(row.omega for row in lacking.rows), *scene.omegas()])
    needed = kochin_angles(
        scene, db.mesh, 2 * np.pi / float(wavenumber(highest, scene.water.depth, scene.water.gravity))
    )
    return replace(header, theta=needed) if len(needed) > len(header.theta) else header
