"""Remarks on a scene before a run, one line each: doubtful numbers, and omitted results."""

from hakobune.bem.database.schema import NEEDS_MOTION

from ..common.quantities import DENSITIES, in_radians
from ..scene.methods import names_given
from ..scene.products import expand
from ..scene.tables import listed
from .arrangement import own_hulls_of_modes
from .bending.modes import mode_remarks
from .header import each_body
from .hull import panels_matter
from .weight import weight_remarks

GRAVITIES = 9.7, 9.9  # m/s² on the earth
FEET = 31.8, 32.5  # the same in ft/s²


def remarks(scene, hull, body):
    """Remarks on mesh and lid, on water, mass and stability, and on omitted motions.

    hull : `pipelines.solve.hull.MeshedHull`; body : as from `pipelines.solve.header.body_properties`
    """
    lid = _lid_remarks(hull.lid, scene.shortest_wave) if panels_matter(scene) else ()
    return (
        *hull.findings,
        *lid,
        *_density_remarks(scene.water.density),
        *_gravity_remarks(scene.water.gravity),
        *_weight_remarks(scene, hull.mesh, body),
        *in_radians("waves.headings_deg", listed("waves.headings_deg", scene.waves.headings_deg)),
        *_motion_remarks(scene),
        *mode_remarks(scene, own_hulls_of_modes(scene, hull.mesh)),
    )


def _weight_remarks(scene, mesh, body):
    for name, *one in each_body(scene, mesh, body):
        yield from (f"{name}: {said}" if name else said for said in weight_remarks(*one))


def _density_remarks(density):
    low, high = DENSITIES
    if not low <= density <= high:
        yield (
            f"density {density:g} kg/m³ is not a density of water, {low:g} to {high:g} kg/m³; check its unit "
            "(--density)"
        )


def _gravity_remarks(gravity):
    low, high = GRAVITIES
    if not low <= gravity <= high:
        feet = ": this is the value in ft/s²" if FEET[0] <= gravity <= FEET[1] else ""
        yield f"gravity {gravity:g} m/s² is not gravity on the earth, {low:g} to {high:g} m/s²{feet}; check its unit"


def _motion_remarks(scene):
    """Results that known inertia would add"""
    if scene.motions_known or scene.held:
        return
    wanted = names_given(scene, expand(scene.want, motions_known=True), ())
    lacking = [name for name in NEEDS_MOTION if name in wanted]
    if lacking:
        words = "are left out: they need" if len(lacking) > 1 else "is left out: it needs"
        yield f"{' and '.join(lacking)} {words} the radii of gyration (--gyration)"


def _lid_remarks(lid, wave):
    """The lid of a database is not changed when it is extended to shorter waves."""
    largest = 0.0 if lid is None else lid.sizes.max()
    if largest > wave / 3:
        yield (
            f"lid panels up to {largest:.3g} m are coarse for the shortest wave, {wave:.3g} m; recommended: ≤ "
            f"{wave / 3:.3g} m (a third); --fresh makes new panels"
        )
