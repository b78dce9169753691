"""The header of a new database: mesh, hydrostatics and inertia of the body, angles of its Kochin functions."""

from __future__ import annotations

import numpy as np

from hakobune.bem.database.file import Header
from hakobune.bem.kochin import angles
from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix

from ..scene.identity import MESH_FILE, content, fixed_part, scene_hash
from ..scene.text import to_toml

FEWEST_ANGLES = 120  # every 3°, where Kochin functions are stored; short waves need more


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
        dimensions=scene.dimensions,
        scene=to_toml(scene),
        scene_hash=scene_hash(fixed_part(scene)),
        attributes=_attributes(scene),
    )


def body_properties(scene, mesh):
    """{name of `bem.database.schema.BODY`: value} of the body; no inertia matrix without radii of gyration."""
    body, water = scene.body, scene.water
    still = hydrostatics(
        mesh,
        center_of_mass=body.center_of_gravity,
        density=water.density,
        gravity=water.gravity,
        mass=body.mass,
        rotation_center=scene.rotation_center,
    )
    mass = water.density * still.volume if body.mass is None else body.mass
    known = {
        "center_of_mass": np.array(body.center_of_gravity),
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
        known["inertia_matrix"] = inertia_matrix(mass, body.center_of_gravity, body.gyration, scene.rotation_center)
    return known


def kochin_angles(scene, mesh, wave):
    """(t,) rad, equally spaced, enough to resolve the Kochin functions in waves of `wave` m"""
    radius = float(np.linalg.norm(mesh.points[:, :2], axis=1).max())
    # where waves are not resolved there are no Kochin functions
    count = 0 if scene.approach.highest_resolved else len(angles(2 * np.pi / wave, radius))
    return np.linspace(0, 2 * np.pi, max(FEWEST_ANGLES, count), endpoint=False)


def _attributes(scene):
    made = {"tolerance": scene.accuracy, "method": scene.approach.method}
    if scene.raised_bed is not None:
        made["raised_bed"] = scene.raised_bed
    if scene.body.shape == "mesh":
        made[MESH_FILE] = content(scene.body.file)
    return made
