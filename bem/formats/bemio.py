"""The HDF5 file of BEMIO, which WEC-Sim and HydroChrono read.

The file has a group of dimensionless quantities for each body, the time factor exp(+iωt) and rising frequencies. Rows
are motions of the body, columns are motions of all N bodies.

    added_mass/all A/ρ (6, 6N, n);  radiation_damping/all B/ρω (6, 6N, n);  excitation re, im, mag, phase X/ρg (6, m, n)
    linear_restoring_stiffness C/ρg;  mean_drift/momentum_conservation/val F/ρg (6, m, n), of heave, roll, pitch zero

    impulse response of radiation  K/ρ = 2/π ∫ B̄ ω cos ωt dω,  of excitation  1/π ∫ (re cos ωt − im sin ωt) dω,

Forces, motions and coefficients are about the centre of gravity, the origin of bodies in WEC-Sim.  Impulse responses
are computed by the trapezoidal rule between the lowest and the highest stored frequency, with linear interpolation of
B̄ and X. WEC-Sim can start from these impulse responses, but the band of frequencies limits their accuracy.
The layout is described in the WEC-Sim documentation, "BEMIO", and in the function writeBEMIOH5 of WEC-Sim.
"""

from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np

from hakobune.meshing.whole_files import write_whole

from ..database.schema import DOFS, DRIFT_DOFS
from .values import FormatError, Values, about, body_of, of_each

FORCES = {
    "excitation": "excitation_force",
    "excitation/scattering": "diffraction_force",
    "excitation/froude-krylov": "Froude_Krylov_force",
}
RADIATION = "added_mass", "radiation_damping"
DRIFT = "mean_drift/momentum_conservation/val"
TIMES, POINTS = 100.0, 1001  # s and samples of impulse responses


def write(values, place):
    """Write NAME.h5.  Returns its path.

    raises : FormatError if the centre of mass, to which all quantities refer, is missing, and for a fixed body, because
        the file must contain motions
    """
    fixed = [body.name for body in values.bodies if body.fixed]
    if fixed:
        raise FormatError(
            f"{', '.join(fixed)} is fixed, but this format is for bodies that all move; give --to capytaine"
        )
    (center,) = values.need("center_of_mass")
    values = about(values, center)
    place = Path(place)
    with h5py.File(place, "w", driver="core", backing_store=False) as file:
        _simulation(file, values)
        for number, one in enumerate(of_each(values)):
            A, B = one.need("added_mass", "radiation_damping")
            body = file.create_group(f"body{number + 1}")
            _properties(body.create_group("properties"), one, number)
            hydro = body.create_group("hydro_coeffs")
            _radiation(hydro, one, A / one.density, B / (one.density * one.omega[:, None, None]))
            _excitation(hydro, one)
            _rest(hydro, one)
        file.flush()
        image = file.id.get_file_image()
    write_whole(place, b"", image)
    return [place]


def _put(group, name, data, unit, what):
    made = group.create_dataset(name, data=np.atleast_2d(np.asarray(data, float)))
    made.attrs["description"], made.attrs["units"] = what, unit


def _column(numbers):
    return np.asarray(numbers, float)[:, None]


def _simulation(file, values):
    file.create_dataset("bem_data/code", data=np.bytes_("hakobune"))  # text of fixed length, as BEMIO writes it
    group = file.create_group("simulation_parameters")
    _put(group, "scaled", 0, "", "")
    _put(group, "g", values.gravity, "m/s^2", "Gravitational acceleration")
    _put(group, "rho", values.density, "kg/m^3", "Water density")
    _put(group, "T", _column(2 * np.pi / values.omega), "s", "Wave periods")
    _put(group, "w", _column(values.omega), "rad/s", "Wave frequencies")
    _put(group, "wave_dir", _column(np.degrees(values.wave_direction)), "deg", "Wave direction")
    if np.isfinite(values.water_depth):
        _put(group, "water_depth", values.water_depth, "m", "Water depth")
    else:
        group.create_dataset("water_depth", data=np.bytes_("infinite"))


def _properties(group, values, number):
    group.create_dataset("name", data=np.bytes_(values.name.encode()))
    first = 6 * number + 1
    for name, value in (("body_number", number + 1), ("dof", 6), ("dof_start", first), ("dof_end", first + 5)):
        _put(group, name, value, "", "")
    cb, cg, volume = values.need("center_of_buoyancy", "center_of_mass", "displaced_volume")
    _put(group, "cb", _column(cb), "m", "Center of buoyancy")
    _put(group, "cg", _column(cg), "m", "Center of gravity")
    _put(group, "disp_vol", float(volume), "m^3", "Displaced volume")


def _radiation(hydro, values, A, B):
    at_infinity = values.get("added_mass_infinity")
    at_infinity = A[-1] if at_infinity is None else at_infinity / values.density
    if not np.all(np.isfinite(at_infinity)):
        raise FormatError(
            "added_mass_infinity is not finite, but this format needs finite values; solve the body with finite limits"
        )
    _put(hydro, "added_mass/inf_freq", at_infinity, "kg", "Infinite frequency added mass (normalized by rho)")
    _put(hydro, "added_mass/all", A.transpose(1, 2, 0), "kg", "Added mass (normalized by rho)")
    _put(hydro, "radiation_damping/all", B.transpose(1, 2, 0), "N-s/m", "Radiation damping (normalized by rho*w)")
    t, w = np.linspace(0.0, TIMES, POINTS), np.linspace(values.omega[0], values.omega[-1], POINTS)
    step = trapezoid(w)
    wave = (2 / np.pi) * np.cos(np.outer(w, t)) * (w * step)[:, None]
    K = linear(w, values.omega, B.reshape(len(B), -1)).T @ wave
    group = hydro.create_group("radiation_damping/impulse_response_fun")
    _put(group, "K", K.reshape(*B.shape[1:], -1), "", "Impulse response function")
    _put(group, "t", _column(t), "s", "Time vector for the impulse resonse function")
    _put(group, "w", _column(w), "rad/s", "Interpolated frequencies used to compute the impulse response function")


def _excitation(hydro, values):
    for name, quantity in FORCES.items():
        X = values.get(quantity)
        if X is None:
            if quantity == "excitation_force":
                values.need(quantity)
            continue
        X = np.conj(X).transpose(2, 1, 0) / (values.density * values.gravity)
        for part, data, unit in (("re", X.real, "N"), ("im", X.imag, "N"), ("mag", abs(X), "N")):
            _put(hydro, f"{name}/{part}", data, unit, f"{quantity} (normalized by rho*g)")
        _put(hydro, f"{name}/phase", np.angle(X), "rad", f"Phase angle of {quantity}")
    X = np.conj(values.get("excitation_force")) / (values.density * values.gravity)
    t, w = np.linspace(-TIMES, TIMES, 2 * POINTS - 1), np.linspace(values.omega[0], values.omega[-1], POINTS)
    fine, step = linear(w, values.omega, X.reshape(len(X), -1)), trapezoid(w)[:, None] / np.pi
    angle = np.outer(w, t)
    K = fine.real.T @ (np.cos(angle) * step) - fine.imag.T @ (np.sin(angle) * step)
    group = hydro.create_group("excitation/impulse_response_fun")
    _put(group, "f", K.reshape(len(values.wave_direction), 6, -1).swapaxes(0, 1), "", "Impulse response function")
    _put(group, "t", _column(t), "s", "Time vector for the impulse resonse function")
    _put(group, "w", _column(w), "rad/s", "Interpolated frequencies used to compute the impulse response function")


def _rest(hydro, values):
    rho_g = values.density * values.gravity
    (C,) = values.need("hydrostatic_stiffness")
    _put(hydro, "linear_restoring_stiffness", C / rho_g, "N/m", "Hydrostatic stiffness matrix (normalized by rho*g)")
    drift = values.get("drift_force")
    if drift is not None:
        whole = np.zeros((6, *drift.shape[1::-1]))
        whole[[DOFS.index(name) for name in DRIFT_DOFS]] = drift.transpose(2, 1, 0) / rho_g
        _put(hydro, DRIFT, whole, "", "Value of mean drift force (momentum conservation)")


def trapezoid(w):
    """Weights of the trapezoidal rule at rising frequencies w"""
    return 0.5 * (np.diff(w, prepend=w[0]) + np.diff(w, append=w[-1]))


def linear(w, omega, values):
    """Values (n, q), interpolated linearly at omega; shape (k, q)"""
    parts = [np.interp(w, omega, column) for column in (values.real.T if np.iscomplexobj(values) else values.T)]
    if not np.iscomplexobj(values):
        return np.array(parts).T
    return np.array(parts).T + 1j * np.array([np.interp(w, omega, column) for column in values.imag.T]).T


def read(place, known=None):
    """The Values of one body of NAME.h5; known : {"body": number of the body, from 1} if the file has several bodies
    Raises FormatError."""
    with _opened(place) as file:
        return _read(file, Path(place).stem, body_of(place, _bodies(file) or 1, known))


def coupled(place, known, count):
    """{quantity: array} of added mass, damping and limits of `count` bodies together, (…, 6 count, 6 count)

    known : as in `read`, has no effect; raises FormatError
    """
    with _opened(place) as file:
        rho, omega = (np.ravel(file[f"simulation_parameters/{name}"][()]) for name in ("rho", "w"))
        each = [file[f"body{i + 1}/hydro_coeffs"] for i in range(count)]
        A, B = (np.concatenate([one[f"{name}/all"][:6] for one in each]).transpose(2, 0, 1) for name in RADIATION)
        found = {"added_mass": rho * A, "radiation_damping": rho * omega[:, None, None] * B}
        if all("added_mass/inf_freq" in one for one in each):
            found["added_mass_infinity"] = rho * np.concatenate([one["added_mass/inf_freq"][:6] for one in each])
        return found


def _bodies(file):
    """How many a file has"""
    return sum(name.startswith("body") for name in file)


@contextmanager
def _opened(place):
    """The file, whose lacks are told as FormatError"""
    try:
        with h5py.File(place) as file:
            yield file
    except OSError as error:
        raise FormatError(f"{place} cannot be opened: {str(error).splitlines()[0]}") from None
    except KeyError as error:
        raise FormatError(f"{place} is no file of BEMIO: {error.args[0]}") from None


def _read(file, name, which):
    water, body = file["simulation_parameters"], file[f"body{which + 1}"]
    others = _bodies(file) - 1
    if np.ravel(water["scaled"][()])[0]:
        raise FormatError(f"{file.filename} is scaled; allowed: numbers normalised as WAMIT does, scaled = 0")
    rho, g = (float(np.ravel(water[key][()])[0]) for key in ("rho", "g"))
    deep = h5py.check_string_dtype(water["water_depth"].dtype) is not None or water["water_depth"].dtype.kind == "S"
    depth = np.inf if deep else float(np.ravel(water["water_depth"][()])[0])
    omega, degrees = np.ravel(water["w"][()]), np.ravel(water["wave_dir"][()])
    hydro, quantities, columns = body["hydro_coeffs"], {}, slice(6 * which, 6 * which + 6)
    quantities["added_mass"] = rho * hydro["added_mass/all"][:6, columns].transpose(2, 0, 1)
    quantities["radiation_damping"] = (
        rho * omega[:, None, None] * hydro["radiation_damping/all"][:6, columns].transpose(2, 0, 1)
    )
    if "added_mass/inf_freq" in hydro:
        quantities["added_mass_infinity"] = rho * hydro["added_mass/inf_freq"][:6, columns]
    for path, quantity in FORCES.items():
        if f"{path}/re" in hydro:
            X = hydro[f"{path}/re"][()] - 1j * hydro[f"{path}/im"][()]
            if np.all(np.isfinite(X)):
                quantities[quantity] = rho * g * X.transpose(2, 1, 0)
    if DRIFT in hydro:
        chosen = [DOFS.index(dof) for dof in DRIFT_DOFS]
        quantities["drift_force"] = rho * g * hydro[DRIFT][()][chosen].transpose(2, 1, 0)
    own = body["properties"]
    known = {
        "center_of_buoyancy": np.ravel(own["cb"][()]),
        "center_of_mass": np.ravel(own["cg"][()]),
        "displaced_volume": float(np.ravel(own["disp_vol"][()])[0]),
    }
    if hydro["linear_restoring_stiffness"].size:  # empty if the source program gave none
        known["hydrostatic_stiffness"] = rho * g * hydro["linear_restoring_stiffness"][()]
    return Values(omega, np.radians(degrees), depth, rho, g, quantities, known, known["center_of_mass"], name=name,
                  others=others)  # fmt: skip
