"""Check of the body data in another program's file against the hull.

    C₃₃ = ρ g A_w,    V,    m = ρ V        of the hull in its water; a length in a wrong unit changes C₃₃, V and m

If mass, centre of mass and radii of gyration, which the file lacks, are given, motions are computed as for a solved
body: from the inertia about the rotation centre and the stiffness of the hull with its weight.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix

from .. import DOFS
from ..motions import response
from .values import FormatError

SAME_VOLUME = 0.02  # largest relative difference of the volumes of results and hull
SAME_STIFFNESS = 0.05  # largest relative difference of C₃₃; a waterline of few panels loses some per cent of its area
FAR_MASS = 3.0  # mass over the displaced mass, or its inverse, that no lines can hold
SAME_MOTIONS = 0.05  # largest difference of motions over the largest of each
UNFELT, TINY = 1e-3, 1e-12  # share of the largest of three motions; m/m, rad/m
NEEDED = ("added_mass", "radiation_damping", "excitation_force")


class Weight(NamedTuple):
    """mass : mass, kg; None: the displaced mass
    center : centre of mass, m, (3,); None: the centre in the file, or 0 if the file has none
    gyration : radii of gyration, m, (3,); None if not given
    """

    mass: float | None = None
    center: tuple | None = None
    gyration: tuple | None = None

    @property
    def given(self):
        return any(part is not None for part in self)


def on_hull(values, mesh, weight=Weight()):  # noqa: B008 - a frozen value
    """Values whose body has the geometry of a hull (PanelMesh in its water), and messages on the changes.

    weight : `Weight` that replaces the values of the file
    Raises FormatError if file and hull contradict each other.
    """
    body, remarks = dict(values.body), []
    if weight.center is not None:
        body["center_of_mass"] = np.array(weight.center, float)
    if weight.given:
        body.setdefault("center_of_mass", np.zeros(3))
    if weight.mass is not None:
        body["mass"] = float(weight.mass)
    still = _still(values, mesh, body)
    _check(values, still)
    remarks += _without_stiffness(body, values, still)
    geometry = {
        "displaced_volume": still.volume,
        "wetted_area": still.wetted_area,
        "center_of_buoyancy": still.center_of_buoyancy,
        "waterplane_area": still.waterplane_area,
    }
    body = geometry | body
    remarks += _about_mass(values, still, body)
    if weight.given:
        remarks += _with_weight(body, values, still, weight)
    if "hydrostatic_stiffness" not in body:
        body["hydrostatic_stiffness"] = still.stiffness
        remarks.append("hydrostatic stiffness is that of the hull, with the weight at its centre of mass")
    values = replace(values, body=body)
    if weight.given:
        remarks += _about_motions(values)
    return _with_motions(values), remarks


def _still(values, mesh, body):
    water = {"density": values.density, "gravity": values.gravity, "rotation_center": values.rotation_center}
    return hydrostatics(mesh, center_of_mass=body.get("center_of_mass", np.zeros(3)), mass=body.get("mass"), **water)


def _check(values, still):
    """Raise FormatError if the files are for another hull, water or unit"""
    volume, C = values.body.get("displaced_volume"), values.body.get("hydrostatic_stiffness")
    if volume is not None and abs(volume / still.volume - 1) > SAME_VOLUME:
        raise FormatError(
            f"the mesh displaces {still.volume:.4g} m³, but the results are for a body of {volume:.4g} m³; "
            f"allowed: within {100 * SAME_VOLUME:g} %; give the mesh that the results were computed with"
        )
    expected = values.density * values.gravity * still.waterplane_area
    if C is None or not C[2, 2] > 0 or not expected > 0 or abs(C[2, 2] / expected - 1) <= SAME_STIFFNESS:
        return
    ratio = C[2, 2] / expected
    raise FormatError(
        f"heave stiffness in the files is {C[2, 2]:.5g} N/m, {ratio:.3g} times ρ g times the waterplane of the "
        f"hull, {expected:.5g} N/m; allowed: within {100 * SAME_STIFFNESS:g} %; either the length that makes the "
        f"files dimensionless is {ratio**-0.5:.4g} times as large (--length-unit), or --mesh, --density or "
        "--gravity differ from those of the files"
    )


def _without_stiffness(body, values, still):
    """A message where files have no stiffness in heave, but the hull has one: it is left out of a body"""
    C, expected = body.get("hydrostatic_stiffness"), values.density * values.gravity * still.waterplane_area
    if C is None or C[2, 2] > 0 or not expected > UNFELT * values.density * values.gravity * still.wetted_area:
        return []
    del body["hydrostatic_stiffness"]
    return [
        f"heave stiffness in the files is {C[2, 2]:.5g} N/m, but that of the hull is {expected:.5g} N/m: the "
        "stiffness of the files is not used"
    ]


def _with_weight(body, values, still, weight):
    """Put mass, inertia and the stiffness with the weight into a body; messages on assumptions.  Raises ValueError."""
    body["mass"] = still.mass
    if weight.gyration is not None:
        center = body["center_of_mass"]
        body["inertia_matrix"] = inertia_matrix(still.mass, center, weight.gyration, values.rotation_center)
    old, body["hydrostatic_stiffness"] = values.body.get("hydrostatic_stiffness"), still.stiffness
    if old is None:
        return []
    return [
        f"hydrostatic stiffness: {_about_weight(old, still, values)}; the value of the hull with its weight at "
        f"the centre of mass is stored"
    ]


def _about_mass(values, still, body):
    """A message on a mass that differs from the displaced mass.  Raises FormatError for a mass in another unit."""
    displaced = values.density * still.volume
    ratio = body.get("mass", displaced) / displaced
    if not 1 / FAR_MASS < ratio < FAR_MASS:
        raise FormatError(
            f"mass is {body['mass']:.6g} kg, the hull displaces {displaced:.6g} kg; allowed: {1 / FAR_MASS:.2g} to "
            f"{FAR_MASS:g} times the displaced mass; check the unit of the mass (--mass, kg), the hull and the density"
        )
    if abs(ratio - 1) > 0.01:
        yield (
            f"mass {body['mass']:.6g} kg is not the displaced mass of {displaced:.6g} kg; allowed if lines carry "
            "the difference"
        )


def _about_weight(C, still, values):
    """States in words whether a hydrostatic stiffness includes the weight, by its roll and pitch"""
    arm = still.mass * values.gravity * (still.center_of_mass[2] - values.rotation_center[2])
    off = [abs(C[i, i] - still.stiffness[i, i]) for i in (3, 4)]
    bare = [abs(C[i, i] - still.stiffness[i, i] - arm) for i in (3, 4)]
    size = 0.02 * max(abs(still.stiffness[3, 3]), abs(still.stiffness[4, 4]))
    if max(off) <= size:
        return "the value in the files includes the weight"
    if max(bare) <= size:
        return "the value in the files does not include the weight"
    return "the value in the files fits neither with this weight nor without weight"


def _with_motions(values):
    """Values with the motions of the free body, if all their inputs are present and the files do not have them"""
    rao = None if "rao" in values.quantities else _motions(values)
    return values if rao is None else replace(values, quantities=values.quantities | {"rao": rao})


def _about_motions(values):
    """A message on motions in the files that are not those of the mass, centre and radii of the body"""
    own = values.quantities.get("rao")
    made = None if own is None else _motions(values)
    if made is None:
        return
    size = np.abs(made).max(axis=(0, 1)).reshape(2, 3)  # of a motion that headings do not excite: a share of the others
    size = np.maximum(size, np.maximum(UNFELT * size.max(axis=1, keepdims=True), TINY)).ravel()
    off = np.abs(own - made).max(axis=(0, 1)) / size
    worst = int(off.argmax())
    if off[worst] > SAME_MOTIONS:
        yield (
            f"the motions in the files are stored; they differ by up to {100 * off[worst]:.3g} % of the "
            f"largest {DOFS[worst].lower()} from motions with this mass, centre of gravity and radii of "
            "gyration, without viscous damping. If the motions in the files include viscous damping, keep "
            "them. If the files are for another body, 'hakobune body' with the same flags replaces these "
            "motions and leaves out the drift computed from them"
        )


def _motions(values):
    """Motions of the free body (n, m, 6), None if an input is missing"""
    M, C = (values.body.get(name) for name in ("inertia_matrix", "hydrostatic_stiffness"))
    terms = [values.quantities.get(name) for name in NEEDED]
    if M is None or any(term is None for term in terms):
        return None
    rows = zip(values.omega, *terms, strict=True)
    return np.array([response(omega, A, B, X, M, C) for omega, A, B, X in rows])
