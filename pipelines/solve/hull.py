"""From a scene to what the solver takes: panels, lid, hydrostatics, inertia, and remarks on them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from bem.contour.raised_bed import effect_of_bed
from bem.contour.short_waves import MOST_UNRESOLVED, MOST_WAVES, too_many, unresolved, waves_along
from bem.database.file import Header
from bem.database.schema import NEEDS_MOTION
from bem.kochin import angles
from bem.methods.panel_setup import Setup
from bem.methods.shape_setup import ShapeSetup
from bem.panels.irregular_frequencies import lid_needed_from
from bem.waves import wavenumber
from meshing.files import read_mesh
from meshing.hydrostatics import hydrostatics, inertia_matrix
from meshing.lid import lid
from meshing.mirror import folded
from meshing.panels import PanelMesh
from meshing.quality import findings
from meshing.shapes import box, buoy

from ..scene.identity import MESH_FILE, content, fixed_part, scene_hash
from ..scene.methods import METHODS, bed_for_contour, highest_resolved, names_given
from ..scene.products import expand
from ..scene.scene import SceneError
from ..scene.text import to_toml
from ..scene.viscous_table import viscous_of
from .large import shared_band
from .panel_counts import coarse_counts, fine_counts, meshed, sizes

MOST_PANELS = 20_000
FOR_SHOW = 500  # panels where none is computed with
DENSITIES = 900.0, 1300.0  # kg/m³ of water, from fresh and warm to the Dead Sea
FEWEST_ANGLES = 120  # every 3°, where Kochin functions are stored; short waves need more


@dataclass(frozen=True, eq=False)
class Hull:
    """Panels of a scene's body, and remarks for the reader, one line each."""

    mesh: PanelMesh
    lid: PanelMesh | None
    remarks: tuple[str, ...] = ()


def shortest_wave(scene, omegas):
    """m, of the highest frequency"""
    return 2 * math.pi / float(wavenumber(np.max(omegas), scene.water.depth, scene.water.gravity))


def make_hull(scene, omegas):
    """Panels and lid of the scene's body.

    omegas : (n,) rad/s, for the length of the shortest wave
    Raises SceneError if the frequencies ask for more panels than can be solved, or the mesh cannot be used.
    """
    wave = shortest_wave(scene, omegas)
    if not panels_matter(scene):
        _check_waves_along(scene, omegas)
        return Hull(_meshed(scene.body, FOR_SHOW), None)
    if scene.body.shape == "mesh":
        mesh = folded(read_mesh(scene.body.file))
    elif scene.panels is not None:
        mesh = _meshed(scene.body, scene.panels)
    else:
        mesh = _fine_enough(scene, wave)
    _usable(scene, mesh, None, wave)  # a lid needs a waterline that closes
    return Hull(mesh, make_lid(scene, mesh, wave))


def _check_waves_along(scene, omegas):
    """Resolved, waves take patience and, from 400 on, memory; unresolved they have limits of their own."""
    sizes = tuple(scene.dimensions.values())
    for omega in np.sort(omegas)[::-1]:
        wave = shortest_wave(scene, [omega])
        k = 2 * math.pi / wave
        if too_many(sizes, k) and not (scene.chosen_method == "contour" and unresolved(sizes, k)):
            across = waves_along(sizes, k) * wave
            longer = k * MOST_UNRESOLVED / waves_along(sizes, k)
            some = scene.chosen_method == "contour" and longer < k and unresolved(sizes, 0.999 * longer)
            most = MOST_UNRESOLVED if some else MOST_WAVES[scene.body.shape]
            which = "shortest" if omega == np.max(omegas) else f"{omega:.4g} rad/s"
            raise SceneError(
                f"the {which} wave is {wave:.3g} m against a body {across:g} m across; allowed: at least "
                f"{across / most:.3g} m; leave out the highest frequencies"
            )


def panels_matter(scene):
    """Whether anything wanted is computed with panels; if not, they are there to be looked at."""
    return METHODS[scene.chosen_method].panels or "pressure" in scene.names()


def make_lid(scene, mesh, wave):
    """Lid of a third as many panels as the hull, or fewer with edges of a fifth of the shortest wave.

    Coarser ones let go of short waves: series box at a quarter of the wave, excitation 0.4 % off, at a third 1.4 %.
    """
    if not scene.lid:
        return None
    waterplane = -mesh.copies * mesh.area_vectors[:, 2].sum()
    if waterplane <= 0:
        return lid(mesh)
    wide = min(wave / 5, math.sqrt(waterplane / mesh.copies) / 2)
    return lid(mesh, max(wide, math.sqrt(3 * waterplane / mesh.total)))


def coarse_hull(scene, mesh):
    """(mesh, lid) with about half as many panels, against which the error is estimated.

    None for mesh files, and where the mesh itself is so coarse that half of it would tell nothing.
    """
    counts = None if scene.body.shape == "mesh" else coarse_counts(scene.body, mesh)
    if counts is None:
        return None
    coarse = meshed(scene.body, counts)
    return coarse, make_lid(scene, coarse, shortest_wave(scene, scene.omegas()))


def inspected(hull, scene, omegas):
    """The hull with the remarks of the mesh check.  Raises SceneError if one of them is an error."""
    wave = shortest_wave(scene, omegas)
    if not panels_matter(scene):
        _check_waves_along(scene, omegas)
        return replace(hull, remarks=(*_bed_remarks(scene), *_short_remarks(scene), *_size_remarks(scene, hull.mesh)))
    found = _usable(scene, hull.mesh, hull.lid, wave)
    remarks = (*(f.text for f in found), *_lid_remarks(hull.lid, wave), *_size_remarks(scene, hull.mesh))
    return Hull(hull.mesh, hull.lid, remarks)


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


def kochin_angles(scene, mesh, omegas):
    """(t,) rad, equally spaced, enough to resolve the Kochin functions at the highest frequency"""
    radius = float(np.linalg.norm(mesh.points[:, :2], axis=1).max())
    # where waves are not resolved there are no Kochin functions
    count = 0 if highest_resolved(scene) else len(angles(2 * np.pi / shortest_wave(scene, omegas), radius))
    return np.linspace(0, 2 * np.pi, max(FEWEST_ANGLES, count), endpoint=False)


def make_header(scene, hull, omegas):
    """The database header of a scene; omegas : (n,) rad/s"""
    return Header(
        mesh=hull.mesh,
        lid=hull.lid,
        water_depth=scene.water.depth,
        density=scene.water.density,
        gravity=scene.water.gravity,
        rotation_center=np.array(scene.rotation_center),
        theta=kochin_angles(scene, hull.mesh, omegas),
        body=body_properties(scene, hull.mesh),
        dimensions=scene.dimensions,
        scene=to_toml(scene),
        scene_hash=scene_hash(fixed_part(scene)),
        attributes={
            "tolerance": scene.accuracy,
            "method": scene.chosen_method,
            **_raised(scene),
            **({MESH_FILE: content(scene.body.file)} if scene.body.shape == "mesh" else {}),
        },
    )


def setup_of(header, scene):
    """What the solver takes, from the header of a database and the scene."""
    body = {
        "depth": header.water_depth,
        "density": header.density,
        "gravity": header.gravity,
        "rotation_center": tuple(float(x) for x in header.rotation_center),
        "inertia_matrix": header.body.get("inertia_matrix"),
        "hydrostatic_stiffness": header.body.get("hydrostatic_stiffness"),
        "viscous": viscous_of(scene),
    }
    method = scene.chosen_method
    if METHODS[method].panels:
        return _panel_setup(header, scene, body)
    lengths = tuple(scene.dimensions.values())
    bed = _bed_of(scene)
    panels = None if bed is None else _limit_setup(scene, body)
    if "pressure" in scene.names():
        panels = _panel_setup(header, scene, body)
    return ShapeSetup(
        method=method, shape=scene.body.shape, sizes=lengths, tolerance=scene.accuracy, panels=panels, bed=bed, **body
    )


def _limit_setup(scene, body):
    """Panels for the limits of the frequency: without waves the tolerance alone tells how many"""
    return Setup(meshed(scene.body, fine_counts(scene.body, scene.accuracy, math.inf)), **body)


def _panel_setup(header, scene, body):
    coarse, draftless = coarse_hull(scene, header.mesh), scene.chosen_method == "pressure"
    lid = header.lid or make_lid(scene, header.mesh, shortest_wave(scene, scene.omegas()))
    if np.max(scene.omegas()) ** 2 / scene.water.gravity <= lid_needed_from(header.mesh):
        lid, coarse = None, coarse and (coarse[0], None)
    band = None if draftless else shared_band(scene, header.mesh, lid)
    return Setup(header.mesh, lid, coarse, wall=scene.wall, zero_draft=draftless, band=band, **body)


def remarks_on_body(scene, body):
    """Remarks on water, mass and stability, and on motions that are wanted and left out, one line each.

    body : as from `body_properties`
    """
    remarks = [*_density_remarks(scene.water.density)]
    displaced = scene.water.density * body["displaced_volume"]
    if abs(body["mass"] / displaced - 1) > 0.01:
        remarks.append(
            f"mass {body['mass']:.6g} kg is not the displaced {displaced:.6g} kg; "
            "allowed where lines or moorings carry the difference"
        )
    for name in ("transverse", "longitudinal"):
        height = body[f"{name}_metacentric_height"]
        if height <= 0:
            remarks.append(f"{name} metacentric height {height:.4g} m is not positive: the body capsizes")
    return [*remarks, *_motion_remarks(scene)]


def _density_remarks(density):
    low, high = DENSITIES
    if not low <= density <= high:
        yield f"density {density:g} kg/m³ is not that of water, {low:g} to {high:g} kg/m³; check its unit (--density)"


def _motion_remarks(scene):
    """What would be there if the inertia were known"""
    if scene.motions_known:
        return
    wanted = names_given(scene, expand(scene.want, motions_known=True), ())
    lacking = [name for name in NEEDS_MOTION if name in wanted]
    if lacking:
        words = "are left out: they need" if len(lacking) > 1 else "is left out: it needs"
        yield f"{' and '.join(lacking)} {words} the radii of gyration (--gyration)"


def _size_remarks(scene, mesh):
    """No body has mass farther from its middle than it is long."""
    if scene.body.gyration is None:
        return
    largest = float(np.ptp(mesh.whole().vertices.reshape(-1, 3), axis=0).max())
    longest = max(scene.body.gyration)
    if longest > largest:
        yield (
            f"radius of gyration {longest:g} m is larger than the largest dimension of the wetted body, "
            f"{largest:.4g} m; check its unit (--gyration)"
        )


def _lid_remarks(lid, wave):
    """The lid of a database that is extended to shorter waves stays what it was."""
    largest = 0.0 if lid is None else lid.sizes.max()
    if largest > wave / 3:
        yield (
            f"lid panels up to {largest:.3g} m are coarse for the shortest wave {wave:.3g} m; "
            f"good: ≤ {wave / 3:.3g} m (a third); --fresh makes them anew"
        )


def _bed_of(scene):
    """m, of the bed that is raised for the contour method; None where none is"""
    return bed_for_contour(scene) if scene.chosen_method == "contour" else None


def _raised(scene):
    """{"raised_bed": m} where it is above the bed that there is"""
    bed = _bed_of(scene)
    return {"raised_bed": bed} if bed is not None and bed < scene.water.depth else {}


def _bed_remarks(scene):
    for bed in _raised(scene).values():
        effect = effect_of_bed(scene.body.shape, tuple(scene.dimensions.values()), bed)
        yield (
            f"waves too short to feel a bed at {bed:.4g} m: the contour method works over one, whose effect, at most "
            f"{100 * effect:.2g} %, is in the estimated errors; added mass at the limits is by panels"
        )


def _short_remarks(scene):
    highest = highest_resolved(scene)
    if highest:
        yield (
            f"above {highest:.4g} rad/s more than {MOST_WAVES[scene.body.shape]} waves along the body are answered as "
            "far shorter than its walls, within the estimated errors; kochin and drift are left out"
        )


def _meshed(body, panels):
    return (box if body.shape == "box" else buoy)(*sizes(body), panels=panels)


def _fine_enough(scene, wave):
    """A mesh of the panels the tolerance asks for, or more so that no edge is longer than two sevenths of the wave."""
    least = _wetted_area(scene.body) / (wave / 3.5) ** 2  # no panel is larger than the square of its edge
    mesh = None if least > MOST_PANELS else meshed(scene.body, fine_counts(scene.body, scene.accuracy, wave / 3.5))
    if mesh is None or mesh.total > MOST_PANELS:
        raise SceneError(
            f"tolerance {scene.accuracy:g} and the shortest wave {wave:.3g} m ask for "
            f"{least if mesh is None else mesh.total:.0f} panels; "
            f"allowed: {MOST_PANELS}; leave out the highest frequencies or give panels (--panels)"
        )
    return mesh


def _wetted_area(body):
    if body.shape == "box":
        return body.length * body.beam + 2 * (body.length + body.beam) * body.draft
    return math.pi * body.radius * (body.radius + 2 * body.draft)


def _usable(scene, mesh, lid, wave):
    """The findings of the mesh check.  Raises SceneError if one is an error, or panels are longer than the wave."""
    found, name = findings(mesh, scene.water.depth, wave, lid), scene.body.file or "mesh"
    errors = [f.text for f in found if f.severity == "error"]
    if errors:
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        raise SceneError(f"{name}: {errors[0]}{more}")
    if mesh.sizes.max() > wave:  # of two nodes along an edge, fewer than two a wave: nothing is left of it
        raise SceneError(
            f"{name}: panels up to {mesh.sizes.max():.3g} m cannot carry the shortest wave, {wave:.3g} m; "
            "allowed: at most its length; ask for more panels or leave out the highest frequencies"
        )
    return found
