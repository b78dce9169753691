"""The body for wave pairs, at two resolutions for the error estimate: on its panels or by the contour method."""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

FEWEST = 1  # panels in a direction of the coarser mesh: errors common to both meshes do not show
METHODS = ("auto", "contour", "panel")
# tolerances of the contour method: of stored results, and of the run that estimates their error
TOLERANCES = 1e-5, 1e-4


@dataclass(frozen=True, eq=False)
class Bodies:
    """method : name; fine, rough : problems of `quadratic_forces`; rough is None without a second resolution

    errors : function of three arguments: the forces at `fine`, the whole force at `rough`, and the change of the
        squares at `rough` by the motions at `fine` (None for a fixed body)
    """

    method: str
    fine: Any
    rough: Any
    errors: Callable


def bodies(db, method, highest, of_force):
    """`Bodies` of an opened database for waves up to `highest` rad/s; `auto` selects contour for vertical cylinders

    of_force : highest frequency of the force, at which the body radiates, rad/s

    raises : ValueError for the contour method on another body
    """
    from hakobune.bem.second_order.quadratic_forces import panel_errors, resolution_errors
    from hakobune.mooring.response.bound_wave_drift import problem_of

    from ..solve.hull import coarse_hull_of

    panels = replace(_with_lid(problem_of(db), max(highest, of_force)), damping_lids=_damping_lids(db))
    fits = _fits_contour(db, highest)
    if method == "contour" and not fits:
        raise ValueError(
            f"--method contour is given for {db.path}; the method needs a vertical cylinder in finite depth, and "
            f"waves that it resolves"
        )
    if method != "panel" and fits:
        fine, rough = (_cylinder(db, panels, tolerance) for tolerance in TOLERANCES)
        return Bodies("contour", fine, rough, lambda forces, coarser, _: resolution_errors(forces, coarser))
    coarse, rough, refinement = coarse_hull_of(db.header, FEWEST, panels.lid), None, 1.0
    if coarse is not None:
        mesh, lid = coarse
        rough, refinement = replace(panels, mesh=mesh, lid=lid), panels.mesh.total / mesh.total

    def errors(forces, coarser, by_motions):
        return panel_errors(forces, coarser, refinement, by_motions)

    return Bodies("panel", panels, rough, errors)


def _damping_lids(db):
    """`DampingLid`s of the scene of a database"""
    from ..scene.scene import make_scene
    from ..solve.gaps.damping_lids import damping_lids_of

    scene = tomllib.loads(db.header.scene)
    return damping_lids_of(make_scene(scene), db.mesh) if "damping_lids" in scene else ()


def _with_lid(problem, highest):
    """The problem with a lid, if waves up to `highest` rad/s need one that the database lacks"""
    from hakobune.bem.panels.irregular_frequencies import lid_needed_from
    from hakobune.meshing.lid import lid

    needs = problem.lid is None and highest**2 / problem.gravity > lid_needed_from(problem.mesh)
    return replace(problem, lid=lid(problem.mesh)) if needs else problem


def _fits_contour(db, highest):
    from hakobune.bem.contour.short_waves import too_many
    from hakobune.bem.waves import wavenumber

    from ..scene.methods import METHODS as SOLVERS

    if db.bodies or not db.is_round or "radius" not in db.dimensions or not db.water_depth < float("inf"):
        return False
    radius, draft = db.dimensions["radius"], db.dimensions["draft"]
    k = float(wavenumber(highest, db.water_depth, db.gravity))
    gap = (db.water_depth - draft) / min(radius, draft)
    return 0 < gap <= SOLVERS["contour"].highest_gap and not too_many((radius, draft), k)


def _cylinder(db, panels, tolerance):
    from hakobune.bem.methods.shape_problem import ShapeProblem

    shared = "depth density gravity rotation_center inertia_matrix hydrostatic_stiffness viscous"
    return ShapeProblem(
        method="contour",
        shape="buoy",
        sizes=(db.dimensions["radius"], db.dimensions["draft"]),
        tolerance=tolerance,
        **{name: getattr(panels, name) for name in shared.split()},
    )
