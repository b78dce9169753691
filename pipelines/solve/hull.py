"""Panels on the bodies of a scene and on their lid, a coarser mesh of hull and lid, and findings on the meshes."""

import math
import tomllib
from dataclasses import dataclass
from functools import partial

from hakobune.bem.contour.short_waves import MOST_WAVES, too_many, waves_along
from hakobune.bem.waves import wavenumber
from hakobune.meshing.files import read_mesh
from hakobune.meshing.hydrostatics import stands, waterplane_area
from hakobune.meshing.lid import lid
from hakobune.meshing.mirror import folded
from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.quality import findings, lid_findings
from hakobune.meshing.shapes import TooFewPanels

from ..common.typed import typed
from ..scene.checks import stands_on_bed
from ..scene.methods import METHODS
from ..scene.scene import Scene, SceneError
from .arrangement import arranged, check_apart, own_hulls, own_hulls_of_modes
from .bending.modes import with_planes_of_modes
from .gaps.damping_lids import damping_lids_of, with_planes_of
from .gaps.resonant_water import resonant_water
from .large import shared_band
from .panel_counts import FEWEST, coarse_counts, fine_counts, finer_counts, meshed
from .panel_counts import sizes as lengths_of

MOST_PANELS = 20_000
MOST_GIVEN = 100_000  # panels of a mesh file, or by --panels
FOR_SHOW = 500  # panels of a mesh that is only drawn
PER_WAVE = 4.7  # panels along the shortest wave; with fewer, extrapolation without finer meshes is too inaccurate
MOST_REFINED = 5000  # panels of a mesh for single frequencies, whose full equations take up to 2 GB


@dataclass(frozen=True, eq=False)
class MeshedHull:
    """Panels of a scene's bodies and of their lid (or None), and the findings of their check, one line each."""

    mesh: PanelMesh
    lid: PanelMesh | None
    findings: tuple[str, ...] = ()


def make_hull(scene):
    """Panels and lid of the scene's body or bodies.

    Raises SceneError if the frequencies need more panels than can be solved, or the mesh is unusable.
    """
    if not panels_matter(scene):
        _check_waves_along(scene)
        return _for_show(scene)
    hulls = [_hull(scene, body) for body in scene.bodies]
    _check_count(scene, sum(hull.total for hull in hulls))
    mesh = _in_place(scene, hulls)
    found = _usable(scene, mesh)  # a lid needs a closed waterline
    made = make_lid(scene, mesh)
    return MeshedHull(mesh, made, (*found, *_without_errors(scene, lid_findings(mesh, made))))


def _for_show(scene):
    """Panels for drawing only, for bodies that lie apart"""
    hulls = [_meshed(scene, body, FOR_SHOW) for body in scene.bodies]
    if not scene.several:
        return MeshedHull(hulls[0], None)
    mesh = arranged(scene, hulls)
    return MeshedHull(mesh, None, check_apart(scene, mesh, panels_matter=False))


def _hull(scene, body):
    """Panels of one body in its own coordinates"""
    if body.shape == "mesh":
        mesh = read_mesh(body.file)
        if mesh.total > MOST_GIVEN:
            raise SceneError(f"{body.file} has {mesh.total} panels; allowed: up to {MOST_GIVEN}")
        if not body.fixed and stands(mesh, scene.water.depth):
            raise SceneError(
                f"{body.file} stands on the bed, z = {-scene.water.depth:g} m, without a bottom, and cannot float; "
                "give fixed = true under [[bodies]]"
            )
        return folded(mesh)
    if scene.panels is None:
        return _fine_enough(scene, body)
    try:
        return _meshed(scene, body, round(scene.panels * _share(scene, body)))
    except TooFewPanels:
        raise SceneError(f"panels is {scene.panels}; allowed: {_least_panels(scene)} to 100000") from None


def _least_panels(scene):
    """Smallest number that leaves each body as many as its shape needs"""
    fewest = []
    for body in scene.bodies:
        try:
            _meshed(scene, body, 0)
        except TooFewPanels as error:
            fewest.append(math.ceil((error.least - 0.5 + 1e-9) / _share(scene, body)))
    return max(fewest)


def _share(scene, body):
    """Share of the panels of a scene on one of its bodies, by the wetted area"""
    whole = sum(_wetted_area(scene, one) for one in scene.bodies)
    return _wetted_area(scene, body) / whole if scene.several else 1.0


def _check_count(scene, total):
    if scene.several and scene.panels is None and total > MOST_PANELS:
        raise SceneError(
            f"tolerance {scene.accuracy:g} needs {total} panels on {len(scene.bodies)} bodies; allowed: "
            f"{MOST_PANELS}; leave out the highest frequencies or give panels (--panels)"
        )


def stored_hull(scene, header):
    """The hull of a database, for the frequencies of a scene.  Raises SceneError if it is unusable for these."""
    if not panels_matter(scene):
        _check_waves_along(scene)
        return MeshedHull(header.mesh, header.lid)
    on_lid = _without_errors(scene, lid_findings(header.mesh, header.lid))
    return MeshedHull(header.mesh, header.lid, (*_usable(scene, header.mesh), *on_lid))


def _check_waves_along(scene):
    """Number of waves along a body that methods without panels resolve: more take much time and memory"""
    water = scene.water
    k = float(wavenumber(scene.omegas()[-1], water.depth, water.gravity))
    for body in scene.bodies:
        sizes = lengths_of(body)
        if too_many(sizes, k):
            wave = 2 * math.pi / k
            across = waves_along(sizes, k) * wave
            raise SceneError(
                f"the shortest wave is {wave:.3g} m long and the body {across:g} m across; allowed: waves of at least "
                f"{across / MOST_WAVES[body.shape]:.3g} m; leave out the highest frequencies"
            )


def panels_matter(scene):
    """Whether any wanted result is computed with panels; if not, they are only drawn."""
    return METHODS[scene.solved_by].panels or "pressure" in scene.names()


def make_lid(scene, mesh):
    """Lid with a third of the hull's number of panels, or with fewer where edges of a fifth of the shortest wave are
    longer.

    A coarser lid does not resolve short waves. For the series box the excitation has an error of 0.4 % with edges of a
    quarter of the wave, and of 1.4 % with a third.
    """
    if not scene.lid:
        return None
    waterplane = waterplane_area(mesh)
    if waterplane <= 0:
        return lid(mesh)
    wide = min(scene.shortest_wave / 5, math.sqrt(_smallest_waterplane(mesh)) / 2)
    return lid(mesh, max(wide, math.sqrt(3 * waterplane / mesh.total)))


def _smallest_waterplane(mesh):
    """m², of the meshed part of the hull, or for several bodies of a quarter of the smallest"""
    planes = (waterplane_area(mesh.of_body(i)) for i in range(mesh.bodies))
    return min(plane / (4 if mesh.bodies > 1 else mesh.copies) for plane in planes if plane > 0)


def lid_in_proportion(cover, mesh, other):
    """The lid of another mesh of a hull, with as many lid panels per hull panel as `cover` has; None for None

    With an unchanged lid, the lid's error would be common to both meshes and would not show: of an error of 1.2 % in
    the damping of the series box in its shortest waves, 0.9 % were not detected.
    """
    return None if cover is None else lid(other, math.sqrt(cover.areas.mean() * mesh.total / other.total))


def coarse_hull(scene, mesh, cover, fewest=FEWEST):
    """Return (mesh, lid) with about half as many panels, for the error estimate.

    None for mesh files, and where the mesh itself is so coarse that half of it gives no information.
    cover : the lid of the mesh, or None; fewest : least number of panels in a direction
    """
    coarse = _remeshed(scene, mesh, partial(coarse_counts, fewest=fewest))
    return None if coarse is None else (coarse, lid_in_proportion(cover, mesh, coarse))


def _remeshed(scene, mesh, counts):
    """The mesh of a scene with the counts from counts(body, mesh of the body); None if these are None"""
    if any(body.shape == "mesh" for body in scene.bodies):
        return None
    hulls = own_hulls(scene, mesh) if scene.several else [mesh]
    found = [counts(body, hull) for body, hull in zip(scene.bodies, hulls, strict=True)]
    if any(one is None for one in found):
        return None
    made = [meshed(*one, bottom=not stands_on_bed(scene, one[0])) for one in zip(scene.bodies, found, strict=True)]
    return _in_place(scene, made)


def _in_place(scene, hulls):
    """One mesh of the hulls of a scene's bodies"""
    mesh = arranged(scene, hulls) if scene.several else hulls[0]
    mesh = with_planes_of(mesh, damping_lids_of(scene, mesh))
    return with_planes_of_modes(scene, mesh, own_hulls_of_modes(scene, mesh))


def coarse_hull_of(header, fewest, cover):
    """`coarse_hull` of the scene in a database header, for its mesh with a lid; None without a scene"""
    if not header.scene:
        return None
    return coarse_hull(typed(tomllib.loads(header.scene), Scene, SceneError), header.mesh, cover, fewest)


@dataclass(frozen=True)
class FinerHull:
    """Meshes for the frequencies of a scene whose estimated error exceeds the tolerance.

    Called with a mesh and its lid it returns both with about twice as many panels, or None above `MOST_REFINED`.
    """

    scene: Scene

    @property
    def omegas(self):
        """Frequencies of the scene, ascending, rad/s; shape (n,)"""
        return self.scene.omegas()

    def band(self, mesh, lid, omegas):
        """`large.shared_band` of some of the frequencies"""
        return shared_band(self.scene, mesh, lid, omegas)

    def __call__(self, mesh, cover):
        finer = _remeshed(self.scene, mesh, finer_counts)
        return None if finer.total > MOST_REFINED else (finer, lid_in_proportion(cover, mesh, finer))


def finer_hull(scene):
    """`FinerHull`; None for mesh files and a requested number of panels, for which no tolerance applies"""
    given = scene.panels is not None or any(body.shape == "mesh" for body in scene.bodies)
    return None if given else FinerHull(scene)


def _meshed(scene, body, panels):
    return meshed(body, None, not stands_on_bed(scene, body), panels=panels)


def _fine_enough(scene, body):
    """A mesh of a body with the panels for the tolerance, or more so that there are `PER_WAVE` along every wave."""
    wave, bottom = scene.shortest_wave, not stands_on_bed(scene, body)
    least = _wetted_area(scene, body) / (wave / PER_WAVE) ** 2  # no panel is larger than the square of its edge
    many = least > MOST_PANELS
    mesh = None if many else meshed(body, fine_counts(body, scene.accuracy, wave / PER_WAVE, bottom), bottom)
    if mesh is None or mesh.total > MOST_PANELS:
        raise SceneError(
            f"tolerance {scene.accuracy:g} and the shortest wave, {wave:.3g} m, require "
            f"{least if mesh is None else mesh.total:.0f} panels; "
            f"allowed: {MOST_PANELS}; leave out the highest frequencies or give panels (--panels)"
        )
    return mesh


def _wetted_area(scene, body):
    bottom = not stands_on_bed(scene, body)
    if body.shape != "buoy":
        return body.length * body.beam * bottom + 2 * (body.length + body.beam) * body.draft
    return math.pi * body.radius * (body.radius * bottom + 2 * body.draft)


def _usable(scene, mesh):
    """Findings of the check of a mesh.  Raises SceneError for an error, or panels longer than the wave."""
    wave = scene.shortest_wave
    apart = check_apart(scene, mesh) if scene.several else resonant_water(scene, mesh)
    found = (*apart, *_without_errors(scene, findings(mesh, scene.water.depth, wave)))
    if mesh.sizes.max() > wave:  # two nodes along an edge, fewer than two a wave: the wave is not resolved
        raise SceneError(
            f"{_name(scene)}: panels up to {mesh.sizes.max():.3g} m are too long for the shortest wave, {wave:.3g} m; "
            "allowed: at most its length; give more panels or leave out the highest frequencies"
        )
    return found


def _without_errors(scene, found):
    """Texts of findings.  Raises SceneError if one of them is an error."""
    found = list(found)
    errors = [f.text for f in found if f.severity == "error"]
    if errors:
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        raise SceneError(f"{_name(scene)}: {errors[0]}{more}")
    return tuple(f.text for f in found)


def _name(scene):
    return "mesh of several bodies" if scene.several else scene.body.file or "mesh"
