"""The contents of a database: one table of names, axes, units and types, used by writing, reading and plots.

A quantity that Capytaine also has bears Capytaine's name.  Every dataset has its axes as HDF5 dimension scales.
"""

import numpy as np

from .. import DOFS, POWER
from ..drift import OF_EACH
from ..modes import moving, names_of

FORMAT = "hakobune database"
SCHEMA_VERSION = 1
DRIFT_DOFS = ("Surge", "Sway", "Yaw")

_SQUARE = ("influenced_dof", "radiating_dof")
_FORCE = ("omega", "wave_direction", "influenced_dof")
_DRIFT = ("omega", "wave_direction", "drift_dof")
# axes of the drift of each of several bodies, about its own point
_BODY_DRIFT = ("omega", "wave_direction", "body", "drift_dof")

# name: (axes, unit, type); where a unit has two parts the second is that of rotations and moments
COORDINATES = {
    "omega": (("omega",), "rad/s", float),
    "wave_direction": (("wave_direction",), "rad", float),
    "influenced_dof": (("influenced_dof",), "", str),
    "radiating_dof": (("radiating_dof",), "", str),
    "drift_dof": (("drift_dof",), "", str),
    "theta": (("theta",), "rad", float),
    "panel": (("panel",), "", int),  # panel number in the whole hull, as in mesh.whole()
    "xyz": (("xyz",), "", str),
}
OF_SEVERAL = {"body": (("body",), "", str)}  # coordinate of scenes of several bodies, which have a row each in `BODY`
DERIVED = {
    "period": (("omega",), "s", float),
    "wavenumber": (("omega",), "rad/m", float),
    "wave_direction_deg": (("wave_direction",), "degree", float),
}
QUANTITIES = {
    "added_mass": (("omega", *_SQUARE), "kg, kg m, kg m2", float),
    "radiation_damping": (("omega", *_SQUARE), "kg/s, kg m/s, kg m2/s", float),
    "Froude_Krylov_force": (_FORCE, "N/m, N m/m", complex),
    "diffraction_force": (_FORCE, "N/m, N m/m", complex),
    "excitation_force": (_FORCE, "N/m, N m/m", complex),
    "kochin_radiation": (("omega", "radiating_dof", "theta"), "m/m, m/rad", complex),
    "kochin_diffraction": (("omega", "wave_direction", "theta"), "m/m", complex),
    "rao": (("omega", "wave_direction", "radiating_dof"), "m/m, rad/m", complex),
    "drift_force_fixed": (_DRIFT, "N/m2, N m/m2", float),
    "drift_force": (_DRIFT, "N/m2, N m/m2", float),
    **dict.fromkeys(OF_EACH, (_BODY_DRIFT, "N/m2, N m/m2", float)),
    POWER: (("omega", "wave_direction"), "W/m2", float),  # power absorbed by damping lids, waves of 1 m amplitude
    "pressure": (("omega", "wave_direction", "panel"), "Pa/m", complex),
    "added_mass_zero": (_SQUARE, "kg, kg m, kg m2", float),
    "added_mass_infinity": (_SQUARE, "kg, kg m, kg m2", float),
}
BODY = {
    "center_of_mass": (("xyz",), "m", float),
    "mass": ((), "kg", float),
    "inertia_matrix": (_SQUARE, "kg, kg m, kg m2", float),
    "hydrostatic_stiffness": (_SQUARE, "N/m, N, N m", float),
    "structural_stiffness": (_SQUARE, "N/m, N, N m", float),  # this and the next: flexible bodies only
    "structural_damping": (_SQUARE, "kg/s, kg m/s, kg m2/s", float),
    "displaced_volume": ((), "m3", float),
    "wetted_area": ((), "m2", float),
    "center_of_buoyancy": (("xyz",), "m", float),
    "waterplane_area": ((), "m2", float),
    "transverse_metacentric_height": ((), "m", float),
    "longitudinal_metacentric_height": ((), "m", float),
}
ESTIMATES = (  # quantities with an estimated error, stored in /estimated_error
    "added_mass", "radiation_damping", "excitation_force", "rao", "drift_force_fixed", "drift_force"
)  # fmt: skip
ERROR = np.float32  # type of stored errors; files of earlier versions use float64
CHECKS = ("reciprocity", "Haskind", "energy", "residual", "estimated_error")

# axes along which the numbers of a quantity are stored piece by piece: (), ("omega",) or ("omega", "wave_direction")
CELL_AXES = {
    name: tuple([axis for axis in axes if axis in ("omega", "wave_direction")])
    for name, (axes, _, _) in QUANTITIES.items()
}
BESIDE = "bodies_beside"  # attribute of an import: number of bodies in the water beside it, which are fixed
LIMITS = tuple([name for name, axes in CELL_AXES.items() if not axes])
NEEDS_MOTION = ("rao", "drift_force", "body_drift_force")
ONLY_BY_NAME = ("pressure",)  # large, and wanted for few frequencies
LABELS = {"influenced_dof": DOFS, "radiating_dof": DOFS, "drift_dof": DRIFT_DOFS, "xyz": ("x", "y", "z")}


def labels(bodies, modes=()):
    """{axis: names} of a file of `bem.modes.Body` of several bodies (none for a single body) and of
    `bem.modes.Mode`s"""
    names = names_of(bodies, modes)
    moved = tuple(names[d] for d in moving(bodies, modes))
    each = {"body": tuple(body.name for body in bodies)} if bodies else {}
    return LABELS | {"influenced_dof": names, "radiating_dof": moved} | each
