"""The vessel type of OrcaFlex as its text data file, NAME.yml (OrcaFlex help, "Text data files", "Vessel types").

    units of UnitsSystem in General: SI (t, kN, m), US (kip, kip, ft), or User with LengthUnits, MassUnits and
    ForceUnits; hakobune writes SI: rad/s; forces in kN, kN m, motions in m, ° for each metre of wave amplitude;
    phases in degrees of lag behind the crest, as here;
    surge forward, sway to port, heave up, and rotations right-handed about them: roll starboard down, pitch bow down,
    yaw bow to port; directions that the waves travel to

    K = C + m g (z_G − z_R) in roll and pitch: the stiffness of buoyancy alone about the reference origin R, since
    OrcaFlex applies the weight at the centre of mass separately.

Matrices are written symmetric, as OrcaFlex requires: (A + Aᵀ)/2.  A model also contains the water depth and density.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.meshing.whole_files import write_whole

from ..database.schema import DOFS, LIMITS
from ..waves import wavenumber
from .values import FormatError, Values, body_of, gridded
from .yaml_text import YamlFault, parse

RESPONSES = ", ".join(f"RAO{dof}Amp, RAO{dof}Phase" for dof in DOFS)
RAO_COLUMNS = f"RAOPeriodOrFrequency, {RESPONSES}"
AXES = ("X", "Y", "Z", "Rx", "Ry", "Rz")
MASS_COLUMNS = ", ".join(f"AddedMassMatrix{axis}" for axis in AXES)
DAMPING_COLUMNS = ", ".join(f"Damping{axis}" for axis in AXES)
INERTIA_COLUMNS = ", ".join(f"MomentOfInertiaTensor{axis}" for axis in "XYZ")
STIFFNESS_COLUMNS = "HydrostaticStiffnessz, HydrostaticStiffnessRx, HydrostaticStiffnessRy"
CONVENTIONS = {
    "RAOResponseUnits": "degrees",
    "RAOWaveUnit": "amplitude",
    "WavesReferredToBy": "frequency (rad/s)",
    "RAOPhaseConvention": "lags",
    "RAOPhaseUnitsConvention": "degrees",
    "RAOPhaseRelativeToConvention": "crest",
    "SurgePositive": "forward",
    "SwayPositive": "port",
    "HeavePositive": "up",
    "RollPositiveStarboard": "down",
    "PitchPositiveBow": "down",
    "YawPositiveBow": "port",
    "Symmetry": "None",
}
RESPONSES_OF = {
    "LoadRAOs": ("excitation_force", np.full(6, 1e3)),
    "DisplacementRAOs": ("rao", np.array([1.0] * 3 + [np.pi / 180] * 3)),
}
LENGTHS = {"m": 1.0, "km": 1e3, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}
MASSES = {"te": 1e3, "t": 1e3, "kg": 1.0, "kip": 453.59237, "kips": 453.59237, "klb": 453.59237, "lb": 0.45359237,
          "slug": 14.593903}  # fmt: skip
FORCES = {"kN": 1e3, "N": 1.0, "MN": 1e6, "te": 9806.65, "tef": 9806.65, "kgf": 9.80665, "kip": 4448.2216152605,
          "kips": 4448.2216152605, "klbf": 4448.2216152605, "lbf": 4.4482216152605}  # fmt: skip
SYSTEMS = {"SI": ("m", "te", "kN"), "US": ("ft", "kips", "kips")}
ROTATIONS = np.array([0, 0, 0, 1, 1, 1])
LAG_OF_ORIGIN = {"crest": 0.0, "trough": np.pi, "zero down-crossing": np.pi / 2, "zero up-crossing": 1.5 * np.pi}
TO_OMEGA = {
    "frequency (rad/s)": lambda x: x,
    "frequency (Hz)": lambda x: 2 * np.pi * x,
    "period (s)": lambda x: np.where(np.asarray(x) == 0, np.inf, 2 * np.pi / np.where(np.asarray(x) == 0, 1.0, x)),
}
SAME_FREQUENCY = 1e-6  # relative
DEEP = 1e5  # m, written for infinite depth, which the file cannot represent, and read as infinite
CENTRE = ("CentreOfMass", "CentreOfGravity")  # key of the centre of mass in OrcaFlex 11, and in earlier versions
WHAT = ("Length", "Mass", "Force")
HEAVE_ROLL_PITCH = np.ix_((2, 3, 4), (2, 3, 4))


def write(values, place):
    """Write NAME.yml, a model with one vessel.  Returns its path.  Raises FormatError if data are missing."""
    values.need("added_mass", "radiation_damping", "excitation_force")
    place = Path(place)
    name, depth = _quoted(values.name), float(min(values.water_depth, DEEP))
    lines = [
        "%YAML 1.1", "# Type: Model", "---", "General:", "  UnitsSystem: SI", "Environment:",
        f"  Density: {float(values.density) / 1e3!r}", f"  WaterDepth: {depth!r}",
        "VesselTypes:", f"  - Name: {name}", "    Length: ~",
        *(f"    {key}: {value}" for key, value in CONVENTIONS.items()),
        "    Draughts:", "      - Name: Draught1", *("        " + line for line in _draught(values)),
        "Vessels:", f"  - Name: {_quoted(values.name + ' 1')}", f"    VesselType: {name}", "    Draught: Draught1",
        "    PrimaryMotion: Calculated (6 DOF)",
    ]  # fmt: skip
    write_whole(place, b"", ("\n".join(lines) + "\n").encode())
    return [place]


def _quoted(text):
    return "'" + text.replace("'", "''") + "'"


def _row(numbers):
    return "[" + ", ".join(repr(float(x)) for x in numbers) + "]"


def _draught(values):
    mass, inertia, volume = (values.get(name) for name in ("mass", "inertia_matrix", "displaced_volume"))
    if mass is not None and inertia is not None:
        yield f"Mass: {float(mass) / 1e3!r}"
        yield f"{INERTIA_COLUMNS}:"
        yield from ("  - " + _row(row) for row in _about_center(values)[3:, 3:] / 1e3)
        yield f"CentreOfMass: {_row(values.get('center_of_mass'))}"
    about = _row(values.rotation_center)
    for group, (quantity, unit) in RESPONSES_OF.items():
        if values.get(quantity) is not None:
            yield from (f"{group}:", f"  RAOOrigin: {about}", "  PhaseOrigin: [0, 0, 0]", "  RAOs:")
            yield from ("    " + line for line in _responses(values, values.get(quantity) / unit))
    yield "AMDMethod: Frequency dependent"
    yield f"ReferenceOrigin: {about}"
    yield f"ReferenceOriginDatumPosition: {about}"
    if volume is not None:
        yield f"DisplacedVolume: {float(volume)!r}"
    if values.get("center_of_buoyancy") is not None:
        yield f"CentreOfBuoyancy: {_row(values.get('center_of_buoyancy'))}"
    if values.get("hydrostatic_stiffness") is not None:
        yield f"{STIFFNESS_COLUMNS}:"
        stiffness = values.get("hydrostatic_stiffness") + _weight(values)
        yield from ("  - " + _row(row) for row in stiffness[HEAVE_ROLL_PITCH] / 1e3)
    yield "FrequencyDependentAddedMassAndDamping:"
    yield from ("  " + line for line in _matrices(values))


def _about_center(values):
    """Inertia (6, 6) about the centre of mass, as in OrcaFlex; the database has it about the rotation centre"""
    inertia, mass = np.array(values.get("inertia_matrix"), float), float(values.get("mass"))
    return inertia - _steiner(mass, values.get("center_of_mass") - values.rotation_center)


def _steiner(mass, arm):
    """Moments of inertia of a mass at `arm`, m; shape (6, 6); only the rotations are filled"""
    moved = np.zeros((6, 6))
    moved[3:, 3:] = mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return moved


def _weight(values):
    """Reduction of roll and pitch stiffness by the weight, m g (z_G − z_R), N m/rad; shape (6, 6)"""
    moment = np.zeros((6, 6))
    if values.get("center_of_mass") is not None and values.get("mass") is not None:
        arm = values.get("center_of_mass")[2] - values.rotation_center[2]
        moment[3, 3] = moment[4, 4] = float(values.get("mass")) * values.gravity * arm
    return moment


def _responses(values, X):
    for m, direction in enumerate(np.degrees(values.wave_direction)):
        yield f"- RAODirection: {float(direction)!r}"
        yield f"  {RAO_COLUMNS}:"
        for omega, x in zip(values.omega, X[:, m], strict=True):
            yield "    - " + _row([omega, *np.column_stack([np.abs(x), np.degrees(np.angle(x))]).ravel()])


def _matrices(values):
    A, B = values.get("added_mass"), values.get("radiation_damping")
    rows = [(repr(float(omega)), A[n], B[n]) for n, omega in enumerate(values.omega)]
    limit = values.get("added_mass_infinity")
    if limit is not None and np.all(np.isfinite(limit)):
        rows.insert(0, ("Infinity", limit, np.zeros((6, 6))))
    for at, mass, damping in rows:
        yield f"- AMDPeriodOrFrequency: {at}"
        for columns, matrix in ((MASS_COLUMNS, mass), (DAMPING_COLUMNS, damping)):
            yield f"  {columns}:"
            yield from ("    - " + _row(row) for row in (matrix + matrix.T) / 2e3)


def read(place, known):
    """The Values of the first draught of a vessel type of NAME.yml.  Raises FormatError.

    known : {"gravity": m/s²}, and "body", number of the vessel type from 1, if there are several vessel types
    """
    place = Path(place)
    try:
        model = parse(place.read_text(encoding="utf-8-sig"))
        return _read(model, place, known)
    except YamlFault as error:
        raise FormatError(f"{place}, line {error.line}: {error}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FormatError(f"{place} cannot be read: {getattr(error, 'strerror', None) or error}") from None
    except KeyError as error:
        raise FormatError(f"{place} has no {error.args[0]}; allowed: a model of OrcaFlex with a vessel type") from None
    except (TypeError, IndexError, ValueError) as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(f"{place} is no model of OrcaFlex: {error}") from None


class Units(NamedTuple):
    """The model's units of length, mass and force, in m, kg and N"""

    length: float
    mass: float
    force: float


def _units(general, place):
    """Units of the section General.  Raises FormatError for an unknown unit."""
    system = general.get("UnitsSystem", "SI")
    names = SYSTEMS.get(system)
    if system == "User":
        names = (general.get(f"{what}Units", own) for what, own in zip(WHAT, SYSTEMS["SI"], strict=True))
        names = tuple("N" if name is False else name for name in names)  # N without quotes is "no" in YAML 1.1
    if names is None:
        raise FormatError(f"{place}: UnitsSystem is {system!r}; allowed: SI, US or User")
    for what, name, known in zip(WHAT, names, (LENGTHS, MASSES, FORCES), strict=True):
        if name not in known:
            raise FormatError(f"{place}: {what}Units is {name!r}; allowed: {', '.join(known)}")
    return Units(LENGTHS[names[0]], MASSES[names[1]], FORCES[names[2]])


def _read(model, place, known):
    vessel = model["VesselTypes"][body_of(place, len(model["VesselTypes"]), known)]
    water, units = model["Environment"], _units(model.get("General") or {}, place)
    _check_signs(vessel, place)
    depth = units.length * float(water["WaterDepth"])
    depth = np.inf if depth >= DEEP else depth
    to_omega = TO_OMEGA[vessel["WavesReferredToBy"]]
    draught = vessel["Draughts"][0]
    about = units.length * np.array(draught["ReferenceOrigin"], float)
    quantities = _read_matrices(draught, to_omega, units)
    order = quantities.pop("omega")
    headings = np.zeros(0)
    for group, (quantity, _) in RESPONSES_OF.items():
        if draught.get(group, {}).get("RAOs"):
            found, headings, X = _read_responses(draught[group], vessel, place, to_omega)
            kept = [int(np.argmin(np.abs(order - w))) for w in found]
            kept = [i if abs(order[i] / w - 1) < SAME_FREQUENCY else None for i, w in zip(kept, found, strict=True)]
            common = [i for i in kept if i is not None]
            if len(common) < min(len(order), len(found)) / 2:
                raise FormatError(
                    f"{place}: {group} does not have the frequencies of the added mass; allowed: the same frequencies"
                )
            X = X[[i is not None for i in kept]]
            order = order[common]
            quantities = {name: data if name in LIMITS else data[common] for name, data in quantities.items()}
            k = wavenumber(order, depth, known["gravity"])
            X = X * _crest(draught[group], units.length * k, headings)
            origin = units.length * np.array(draught[group]["RAOOrigin"], float)
            if np.any(np.abs(origin - about) > 1e-9):
                raise FormatError(f"{place}: RAOOrigin of {group} is not ReferenceOrigin; allowed: one point for both")
            quantities[quantity] = X * _response_unit(group, vessel, units)
    density = units.mass / units.length**3 * float(water["Density"])
    body = _read_body(draught, about, known["gravity"], units)
    return Values(
        order, headings, depth, density, known["gravity"], quantities, body, about,
        name=str(vessel["Name"]), others=len(model["VesselTypes"]) - 1,
    )  # fmt: skip


def _response_unit(group, vessel, units):
    """Unit of each of six loads, N and N m, or motions, m and rad, for each metre of wave amplitude"""
    if group == "LoadRAOs":
        return units.force / units.length * units.length**ROTATIONS
    turn = 1.0 if vessel["RAOResponseUnits"] == "radians" else np.pi / 180
    return np.where(ROTATIONS, turn / units.length, 1.0)


def _check_signs(vessel, place):
    for key, value in CONVENTIONS.items():
        said = vessel.get(key)
        if key.endswith(("Positive", "PositiveStarboard", "PositiveBow")) and said not in (value, None):
            raise FormatError(f"{place}: {key} is {said}; allowed here: {value}")
    if vessel.get("RAOWaveUnit", "amplitude") != "amplitude":
        raise FormatError(f"{place}: RAOWaveUnit is {vessel['RAOWaveUnit']}; allowed here: amplitude")


def _read_matrices(draught, to_omega, units):
    rows = draught["FrequencyDependentAddedMassAndDamping"]
    at = np.array([to_omega(float(row["AMDPeriodOrFrequency"])) for row in rows])
    arms = units.length ** (ROTATIONS + ROTATIONS[:, None])
    A = units.mass * arms * np.array([row[MASS_COLUMNS] for row in rows], float)
    B = units.force / units.length * arms * np.array([row[DAMPING_COLUMNS] for row in rows], float)
    order = np.argsort(at)
    finite = order[np.isfinite(at[order]) & (at[order] > 0)]
    found = {"omega": at[finite], "added_mass": A[finite], "radiation_damping": B[finite]}
    if np.isinf(at).any():
        found["added_mass_infinity"] = A[np.isinf(at)][0]
    if (at == 0).any():
        found["added_mass_zero"] = A[at == 0][0]
    return found


def _read_responses(group, vessel, place, to_omega):
    """Frequencies (n,), directions (m,) rad, values (n, m, 6) with phases that lag the crest at PhaseOrigin"""
    directions, rows = [], []
    for heading in group["RAOs"]:
        table = np.array(heading[RAO_COLUMNS], float)
        directions += [np.radians(float(heading["RAODirection"]))] * len(table)
        rows.append(table)
    table = np.concatenate(rows)
    turn = 1.0 if vessel["RAOPhaseUnitsConvention"] == "radians" else np.pi / 180
    lag = turn * table[:, 2::2] * (-1.0 if vessel["RAOPhaseConvention"] == "leads" else 1.0)
    X = table[:, 1::2] * np.exp(1j * (lag + LAG_OF_ORIGIN[vessel["RAOPhaseRelativeToConvention"]]))
    (omega, headings), X = gridded(place, [to_omega(table[:, 0]), np.array(directions)], X)
    return omega, headings, X


def _crest(group, k, headings):
    """Factor exp(ik·P), shape (n, m, 1): it moves a crest at PhaseOrigin P, by default RAOOrigin, to the origin of the
    axes"""
    pairs = zip(group["PhaseOrigin"], group["RAOOrigin"], strict=True)
    x, y, _ = (float(own if own is not None else other) for own, other in pairs)
    return np.exp(1j * k[:, None] * (x * np.cos(headings) + y * np.sin(headings)))[..., None]


def _read_body(draught, about, gravity, units):
    body = {}
    if draught.get("DisplacedVolume") is not None:  # ~ if it follows from the mass
        body["displaced_volume"] = units.length**3 * float(draught["DisplacedVolume"])
    if None not in (draught.get("CentreOfBuoyancy") or [None]):
        body["center_of_buoyancy"] = units.length * np.array(draught["CentreOfBuoyancy"], float)
    mass = units.mass * float(draught["Mass"]) if "Mass" in draught else None
    if mass is not None and INERTIA_COLUMNS in draught:
        center = units.length * np.array(draught[next((key for key in CENTRE if key in draught), CENTRE[0])], float)
        inertia, tensor = np.zeros((6, 6)), np.array(draught[INERTIA_COLUMNS], float)
        inertia[:3, :3], inertia[3:, 3:] = mass * np.eye(3), units.mass * units.length**2 * tensor
        arm = center - about
        cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
        inertia[3:, :3], inertia[:3, 3:] = mass * cross, mass * cross.T
        body |= {"mass": mass, "center_of_mass": center, "inertia_matrix": inertia + _steiner(mass, arm)}
    if STIFFNESS_COLUMNS in draught:
        stiffness, arms = np.zeros((6, 6)), units.length ** (ROTATIONS + ROTATIONS[:, None])
        table = np.array(draught[STIFFNESS_COLUMNS], float)
        stiffness[HEAVE_ROLL_PITCH] = units.force / units.length * arms[HEAVE_ROLL_PITCH] * table
        arm = body["center_of_mass"][2] - about[2] if "mass" in body else 0.0
        stiffness[3, 3] -= (mass or 0.0) * gravity * arm
        stiffness[4, 4] -= (mass or 0.0) * gravity * arm
        body["hydrostatic_stiffness"] = stiffness
    return body
