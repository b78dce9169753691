"""Whether the weight of a body is possible for its hull.

    M = m g (x_G − x_B),    tan θ = M / C        trim and heel at rest, C the hydrostatic stiffness
    kᵢ² ≤ kⱼ² + kₖ²                               radii of gyration, since ∫(y² + z²) ≤ ∫(x² + y²) + ∫(x² + z²)

The body is solved in the position of its mesh.  If a hull of length L trims by 2°, its draft at one end grows by
L/57, which is a sixth of the draft for a barge. The mesh is then not that of the floating body.
"""

import numpy as np

from ..scene.scene import SceneError

TILT = 2.0  # largest angle at rest, degrees
TOLD = 0.1  # angle above which a line is printed, degrees
GYRATION = 1.25  # factor on the largest possible radius; printed radii of tank models exceed it by 8 %
ROUNDED = 1.01  # factor on the same that rounding explains


def check_weight(scene, mesh, body):
    """Raise SceneError for a centre of gravity or radii of gyration that are impossible for the hull.

    body : as from `pipelines.solve.header.body_properties`
    """
    _check_place(mesh, body)
    _check_gyration(scene.body.gyration)
    if not (scene.motions_known or any(scene.body.center_of_gravity) or scene.body.GM is not None):
        return  # no weight was given, and no motion depends on it
    for name, axis, arm, moment, angle in _tilts(scene, body):
        if angle > TILT and not scene.body.trimmed:
            raise SceneError(
                f"center_of_gravity is {arm:.4g} m off the centre of buoyancy in {axis}: this is a {name} "
                f"moment of {moment:.4g} N m and {angle:.3g}° of static {name}, limit {TILT:g}°; check the "
                "origin of its coordinates (--center-of-gravity), or give --trimmed (trimmed = true under "
                "[[bodies]]) if the body is held in its drawn trim"
            )


def weight_remarks(scene, mesh, body):
    """Lines on mass, stability, trim and radii of gyration"""
    displaced = scene.water.density * body["displaced_volume"]
    if abs(body["mass"] / displaced - 1) > 0.01:
        yield (
            f"the mass is {body['mass']:.6g} kg, but the body displaces {displaced:.6g} kg; allowed if lines or "
            "moorings carry the difference"
        )
    for name in ("transverse", "longitudinal"):
        height = body[f"{name}_metacentric_height"]
        if height <= 0:
            free = "; rao and drift_force are of the free body: use the motions of a study whose lines hold it upright"
            yield (
                f"{name} metacentric height {height:.4g} m is not positive: the body capsizes"
                + free * scene.motions_known
            )
    for name, axis, arm, moment, angle in _tilts(scene, body):
        if angle > TOLD:
            yield (
                f"the centre of gravity is {arm:.4g} m off the centre of buoyancy in {axis}: this is a {name} "
                f"moment of {moment:.4g} N m and {angle:.3g}° of static {name}; the body is solved in the "
                "position of its mesh"
            )
    yield from _gyration_remarks(scene.body.gyration, mesh)


def _gyration_remarks(gyration, mesh):
    """No body has mass farther from its middle than its length."""
    if gyration is None:
        return
    largest, longest = _extent(mesh), max(gyration)
    if longest > largest:
        yield (
            f"radius of gyration {longest:g} m is larger than the largest dimension of the wetted body, "
            f"{largest:.4g} m; check its unit (--gyration)"
        )
    limit = _largest_radius(gyration)
    if longest > ROUNDED * limit:
        yield (
            f"radius of gyration {longest:g} m is larger than the {limit:.4g} m that the other two radii allow "
            "for any body, k² ≤ k₂² + k₃²; check all three (--gyration)"
        )


def _check_place(mesh, body):
    points, place = mesh.whole().vertices.reshape(-1, 3), np.asarray(body["center_of_mass"], float)
    low, high, reach = points.min(axis=0), points.max(axis=0), _extent(mesh)
    out = np.maximum(low - place, place - high)
    if out.max() > reach:
        i = int(np.argmax(out))
        raise SceneError(
            f"center_of_gravity has {'xyz'[i]} = {place[i]:g} m, {out[i]:.4g} m outside the wetted hull "
            f"({low[i]:.4g} to {high[i]:.4g} m); allowed: up to its largest dimension, {reach:.4g} m; check its unit "
            "(--center-of-gravity)"
        )


def _check_gyration(gyration):
    if gyration is not None and max(gyration) > GYRATION * _largest_radius(gyration):
        raise SceneError(
            f"gyration has {max(gyration):g} m, but the other two radii allow at most "
            f"{_largest_radius(gyration):.4g} m, k² ≤ k₂² + k₃²; check all three (--gyration)"
        )


def _largest_radius(gyration):
    """m, largest third radius for the two smaller radii"""
    return float(np.hypot(*sorted(gyration)[:2]))


def _tilts(scene, body):
    """Return (name, axis, arm in m, moment in N m, angle in degrees) of trim and heel; none for a body that capsizes"""
    lever = np.asarray(body["center_of_mass"], float)[:2] - np.asarray(body["center_of_buoyancy"], float)[:2]
    moments = np.abs(body["mass"] * scene.water.gravity * lever)
    for i, (name, axis, dof) in enumerate((("trim", "x", 4), ("heel", "y", 3))):
        restoring = body["hydrostatic_stiffness"][dof, dof]
        if restoring > 0:
            yield name, axis, lever[i], moments[i], float(np.degrees(np.arctan2(moments[i], restoring)))


def _extent(mesh):
    """m, largest dimension of the wetted hull"""
    return float(np.ptp(mesh.whole().vertices.reshape(-1, 3), axis=0).max())
