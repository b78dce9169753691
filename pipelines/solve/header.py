"""The header of a new database: mesh, hydrostatics and inertia of the body, angles of its Kochin functions."""

from contextlib import contextmanager

import numpy as np

from hakobune.bem.database.file import Header
from hakobune.bem.kochin import angles
from hakobune.bem.modes import moving
from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix

from ..common.typed import to_toml
from ..scene.identity import MESH_FILE, contents, fixed_part, scene_hash
from ..scene.places import bodies_of, in_scene
from ..scene.scene import SceneError
from .arrangement import own_hulls, own_hulls_of_modes
from .bending.modes import modes_of, with_modes

FEWEST_ANGLES = 120  # every 3°, for stored Kochin functions; short waves need more


def make_header(scene, hull):
    """The database header of a scene and its `pipelines.solve.hull.MeshedHull`"""
    return Header(
        mesh=hull.mesh,
        lid=hull.lid,
        water_depth=scene.water.depth,
        density=scene.water.density,
        gravity=scene.water.gravity,
        rotation_center=np.array(scene.rotation_center),
        theta=kochin_angles(scene, hull.mesh, scene.shortest_wave),
        body=body_properties(scene, hull.mesh),
        bodies=bodies_of(scene),
        modes=modes_of(scene, own_hulls_of_modes(scene, hull.mesh)),
        dimensions=scene.dimensions,
        scene=to_toml(scene),
        scene_hash=scene_hash(fixed_part(scene)),
        attributes=_attributes(scene),
    )


def body_properties(scene, mesh):
    """{name of `bem.database.schema.BODY`: value} of the body; no inertia matrix without radii of gyration.

    With several bodies there is one row for each body, and matrices (6N, moving) are about the point of each body in
    its own axes. Each shape adds a row and a column after those of all bodies.
    """
    known = _of_several(scene, mesh) if scene.several else _of_one(scene, mesh)
    return with_modes(known, scene, own_hulls_of_modes(scene, mesh))


def each_body(scene, mesh, body):
    """Return (name, scene, mesh, body properties) of every moving body, with several bodies each in its own coordinates

    body : `body_properties` of the scene
    """
    if not scene.several:
        if not scene.held:
            yield "", scene, mesh, body
        return
    for i, hull in enumerate(own_hulls(scene, mesh)):
        if not scene.bodies[i].fixed:
            alone = scene.alone(i)
            yield scene.bodies[i].name, alone, hull, _of_one(alone, hull)


@contextmanager
def named(name):
    """Context in which a SceneError names its body"""
    try:
        yield
    except SceneError as error:
        raise SceneError(f"{name}: {error}" if name else str(error)) from None


def _of_several(scene, mesh):
    alone = [_of_one(scene.alone(i), hull) for i, hull in enumerate(own_hulls(scene, mesh))]
    matrices, own = ("hydrostatic_stiffness", "inertia_matrix"), moving(bodies_of(scene))
    known = {name: np.array([one[name] for one in alone]) for name in alone[0] if name not in matrices}
    for name in ("center_of_mass", "center_of_buoyancy"):
        known[name] = np.array([in_scene(*both) for both in zip(scene.bodies, known[name], strict=True)])
    for name in matrices if scene.motions_known else matrices[:1]:
        parts = [one.get(name, np.zeros((6, 6))) for one in alone]
        whole = np.zeros((6 * len(parts), 6 * len(parts)))
        for i, part in enumerate(parts):
            whole[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] = part
        known[name] = whole[:, own]
    return known


def _of_one(scene, mesh):
    body, water = scene.body, scene.water
    given = {"density": water.density, "gravity": water.gravity, "mass": body.mass}
    given |= {"rotation_center": scene.rotation_center, "depth": water.depth}
    center = body.center_of_gravity
    if body.GM is not None:
        center = (*center[:2], hydrostatics(mesh, center, **given).transverse_metacentric_height - body.GM)
    still = hydrostatics(mesh, center, **given)
    mass = water.density * still.volume if body.mass is None else body.mass
    known = {
        "center_of_mass": np.array(center),
        "mass": mass,
        "hydrostatic_stiffness": still.stiffness,
        "displaced_volume": still.volume,
        "wetted_area": still.wetted_area,
        "center_of_buoyancy": still.center_of_buoyancy,
        "waterplane_area": still.waterplane_area,
        "transverse_metacentric_height": still.transverse_metacentric_height,
        "longitudinal_metacentric_height": still.longitudinal_metacentric_height,
    }
    if scene.motions_known:
        known["inertia_matrix"] = inertia_matrix(mass, center, body.gyration, scene.rotation_center)
    return known


def kochin_angles(scene, mesh, wave):
    """Angles, equally spaced, enough to resolve the Kochin functions in waves of `wave` m, rad; shape (t,)"""
    radius = float(np.linalg.norm(mesh.points[:, :2], axis=1).max())
    return np.linspace(0, 2 * np.pi, max(FEWEST_ANGLES, len(angles(2 * np.pi / wave, radius))), endpoint=False)


def _attributes(scene):
    made = {"tolerance": scene.accuracy, "method": scene.solved_by}
    if scene.held:
        made["held"] = True  # no body moves
    files = contents(scene)
    if files is not None:
        made[MESH_FILE] = files
    return made
