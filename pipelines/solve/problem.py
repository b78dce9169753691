"""The problem of a scene that `bem` solves: `PanelProblem` or `ShapeProblem` of `bem.methods`."""

from dataclasses import replace

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.modes import moving, names_of
from hakobune.bem.panels.irregular_frequencies import lid_needed_from

from ..scene.methods import METHODS
from ..scene.places import bodies_of
from ..scene.viscous_table import viscous_of
from .arrangement import own_hulls_of_modes
from .bending.modes import modes_of
from .gaps.damping_lids import damping_lids_of
from .hull import coarse_hull, finer_hull, make_lid
from .large import shared_band
from .panel_counts import sizes


def problem_of(header, scene):
    """`PanelProblem` or `ShapeProblem` from the header of a database and the scene."""
    body = {
        "depth": header.water_depth,
        "density": header.density,
        "gravity": header.gravity,
        "rotation_center": tuple(float(x) for x in header.rotation_center),
        "inertia_matrix": header.body.get("inertia_matrix"),
        "hydrostatic_stiffness": header.body.get("hydrostatic_stiffness"),
        "bodies": bodies_of(scene),
        "viscous": viscous_of(scene),
        "tolerance": scene.accuracy,
    }
    method = scene.solved_by
    if scene.modes:
        body |= _with_modes(header, scene, body)
    if METHODS[method].panels:
        return _panel_problem(header, scene, body)
    panels = _panel_problem(header, scene, body) if "pressure" in scene.names() else None
    omegas = scene.omegas() if scene.waves.band is None else ()
    shapes = [(one.shape, sizes(one)) for one in scene.bodies]
    known = {"shapes": tuple(shapes)} if scene.several else dict(zip(("shape", "sizes"), shapes[0], strict=True))
    return ShapeProblem(method=method, panels=panels, omegas=omegas, **known, **body)


def _with_modes(header, scene, body):
    """Arguments of a problem that shapes change"""
    modes = modes_of(scene, own_hulls_of_modes(scene, header.mesh))
    names = names_of(body["bodies"], modes)
    moved = tuple(names[d] for d in moving(body["bodies"], modes))
    return {
        "modes": modes,
        "hydrostatic_stiffness": header.body["hydrostatic_stiffness"] + header.body["structural_stiffness"],
        "structural_damping": header.body["structural_damping"],
        "viscous": body["viscous"] and replace(body["viscous"], names=moved),
    }


def _panel_problem(header, scene, body):
    lid, draftless = header.lid or make_lid(scene, header.mesh), scene.solved_by == "pressure"
    if scene.omegas()[-1] ** 2 / scene.water.gravity <= lid_needed_from(header.mesh):
        lid = None
    coarse = coarse_hull(scene, header.mesh, lid)
    damping_lids = damping_lids_of(scene, header.mesh)
    band = None if draftless or damping_lids else shared_band(scene, header.mesh, lid)
    finer = finer_hull(scene)
    return PanelProblem(
        header.mesh, lid, coarse, finer, wall=scene.wall, zero_draft=draftless, damping_lids=damping_lids, band=band,
        **body,
    )  # fmt: skip
