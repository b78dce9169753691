"""The netCDF file of Capytaine (documentation, "Outputs"): in SI, exp(−iωt) and headings as here.

Complex numbers have a last axis `complex` of re, im, as in files of `capytaine.export_dataset`. Datasets have the
names that Capytaine uses. Modes are labelled, so their order does not matter.  Mean drift is
`far_field_mean_drift_force`; in files written here, its values for pairs of different headings are NaN. In files of
several bodies the modes are called `barge__Surge`. These modes are along the axes of the scene and about the
reference point of each body, and quantities of one body have an axis `body`. netCDF 3 files, which Capytaine writes
without netCDF4, are read too.
"""

from pathlib import Path

import h5py
import numpy as np

from hakobune.meshing.whole_files import write_whole

from .. import DOFS
from ..database.schema import BODY, DRIFT_DOFS, QUANTITIES, labels
from ..waves import wavenumber
from .values import FormatError, Values, body_of

TAKEN = ("added_mass", "radiation_damping", "Froude_Krylov_force", "diffraction_force", "excitation_force")
MATRICES = ("inertia_matrix", "hydrostatic_stiffness")
VECTORS = {"center_of_mass": "center_of_mass", "center_of_buoyancy": "center_of_buoyancy"}
SCALARS = {"disp_volume": "displaced_volume", "disp_mass": "mass", "waterplane_area": "waterplane_area"}
PAIR, DRIFT = ("wave_direction_k", "wave_direction_l"), [f"drift_force_{dof.lower()}" for dof in DRIFT_DOFS]
WATER = {"g": "gravity", "rho": "density", "water_depth": "water_depth"}


def write(values, place):
    """Write NAME.nc.  Returns its path."""
    values.need("added_mass", "radiation_damping")
    place = Path(place)
    with h5py.File(place, "w", driver="core", backing_store=False) as file:
        _axes(file, values)
        for name in TAKEN:
            if values.get(name) is not None:
                axes, unit, kind = QUANTITIES[name]
                _put(file, name, axes, unit, values.get(name), kind is complex)
        for name in MATRICES:
            if values.get(name) is not None:
                _put(file, name, BODY[name][0], BODY[name][1], values.get(name))
        each = ("body",) * bool(values.bodies)
        for name in VECTORS:
            if values.get(name) is not None:
                _put(file, name, (*each, "xyz"), "m", values.get(name))
        centers = [body.rotation_center for body in values.bodies] or values.rotation_center
        _put(file, "rotation_center", (*each, "xyz"), "m", centers)
        for name, own in SCALARS.items():
            if values.get(own) is not None:
                _put(file, name, each, BODY[own][1], values.get(own))
        for name, own in WATER.items():
            _put(file, name, (), "", float(getattr(values, own)))
        _put(file, "forward_speed", (), "m/s", 0.0)
        file.create_dataset("body_name", data=values.name)
        if values.get("drift_force") is not None:
            _drift(file, values)
        file.attrs["coordinates"] = " ".join((*WATER, "forward_speed", "body_name", "period", "freq", "wavenumber"))
        file.attrs["title"] = "hydrodynamic coefficients by hakobune"
        file.flush()
        image = file.id.get_file_image()
    write_whole(place, b"", image)
    return [place]


def _axes(file, values):
    omega = values.omega
    axes = {"omega": omega, "wave_direction": values.wave_direction}
    axes |= {axis: names for axis, names in labels(values.bodies).items() if axis != "drift_dof"}
    axes["complex"] = ("re", "im")
    for name, data in axes.items():
        texts = not isinstance(data, np.ndarray)
        made = file.create_dataset(name, data=np.array(data, dtype=h5py.string_dtype() if texts else float))
        made.make_scale(name)
    file["omega"].attrs["units"], file["wave_direction"].attrs["units"] = "rad/s", "rad"
    _put(file, "period", ("omega",), "s", 2 * np.pi / omega)
    _put(file, "freq", ("omega",), "Hz", omega / (2 * np.pi))
    _put(file, "wavenumber", ("omega",), "rad/m", wavenumber(omega, values.water_depth, values.gravity))


def _put(file, name, axes, unit, data, split=False):
    data = np.asarray(data)
    data = np.stack([data.real, data.imag], axis=-1) if split else data
    made = file.create_dataset(name, data=np.asarray(data, float))
    for place, axis in enumerate((*axes, "complex") if split else axes):
        made.dims[place].attach_scale(file[axis])
    if unit:
        made.attrs["units"] = unit


def _drift(file, values):
    """Mean drift of pairs of headings, as in Capytaine; unknown for two different headings"""
    m = np.arange(len(values.wave_direction))
    for axis in PAIR:
        file.create_dataset(axis, data=values.wave_direction).make_scale(axis)
    for i, name in enumerate(DRIFT):
        data = np.full((len(values.omega), len(m), len(m)), np.nan)
        data[:, m, m] = values.get("drift_force")[..., i]
        _put(file, name, ("omega", *PAIR), "N/m2", data)


def read(place, known=None):
    """The Values of one body of NAME.nc; known : {"body": number of the body, from 1} if the file has several bodies
    Raises FormatError."""
    try:
        with _opened(Path(place)) as file:
            return _read(file, Path(place).stem, known)
    except OSError as error:
        raise FormatError(f"{place} cannot be opened: {str(error).splitlines()[0]}") from None
    except KeyError as error:
        raise FormatError(f"{place} is no file of Capytaine: {error.args[0]}") from None


def coupled(place, known, count):
    """{quantity: array} of added mass and damping of `count` bodies together, (f, 6 count, 6 count)

    known : as in `read`.  Raises FormatError.
    """
    with _opened(Path(place)) as file:
        places = {}
        for body in range(count):
            axes = _axes_of_body(file, dict(known or {}) | {"body": body + 1})[0]
            for axis in ("radiating_dof", "influenced_dof"):
                places[axis] = [*places.get(axis, []), *axes[axis]]
        return {name: _ordered(file, name, QUANTITIES[name][0], places) for name in TAKEN[:2]}


def _opened(place):
    """An h5py.File; for a netCDF 3 file one in memory with the same datasets and axes"""
    with open(place, "rb") as begin:
        if begin.read(3) != b"CDF":
            return h5py.File(place)
    from scipy.io import netcdf_file

    file = h5py.File(place.name, "w", driver="core", backing_store=False)
    with netcdf_file(place, mmap=False) as old:
        texts = {name for name, held in old.variables.items() if held.data.dtype.kind == "S"}
        for name, held in old.variables.items():
            data = held.data
            if name in texts:
                data = np.array([b"".join(row) for row in np.atleast_2d(data)], dtype=h5py.string_dtype())
            file.create_dataset(name, data=data.astype(data.dtype.newbyteorder("=")) if name not in texts else data)
        for axis in {axis for held in old.variables.values() for axis in held.dimensions}:
            if axis not in file:
                file.create_dataset(axis, data=np.arange(old.dimensions[axis] or 0))
            file[axis].make_scale(axis)
        for name, held in old.variables.items():
            if name not in texts and name not in held.dimensions:
                for place, axis in enumerate(held.dimensions):
                    file[name].dims[place].attach_scale(file[axis])
    return file


def _read(file, name, known):
    axes, which, count = _axes_of_body(file, known)
    quantities, body = _quantities(file, axes, count), _body(file, axes, which, count)
    g, rho, depth = (float(np.ravel(file[key][()])[0]) for key in WATER)
    centers = np.reshape(file["rotation_center"][()], (-1, 3)) if "rotation_center" in file else np.zeros((1, 3))
    about = centers[min(which, len(centers) - 1)]
    omega, beta = np.ravel(axes["omega"]), np.ravel(axes["wave_direction"])
    return Values(omega, beta, depth, rho, g, quantities, body, about, name=name, others=count - 1)


def _axes_of_body(file, known):
    """{axis: its values, or the places of our motions}, the index of the body, and the number of bodies"""
    axes = {axis: file[axis][()] for axis in ("omega", "wave_direction") if axis in file}
    axes.setdefault("wave_direction", np.zeros(0))
    for axis in ("radiating_dof", "influenced_dof"):
        modes = [text.decode() if isinstance(text, bytes) else str(text) for text in np.ravel(file[axis][()])]
        parts = [mode.rpartition("__") for mode in modes]  # body__motion of several bodies
        bodies = list(dict.fromkeys(body for body, _, _ in parts))
        which = body_of(file.filename, len(bodies), known)
        ends = {motion.capitalize(): i for i, (body, _, motion) in enumerate(parts) if body == bodies[which]}
        if not set(ends) <= set(DOFS):
            raise FormatError(f"{file.filename} has the modes {', '.join(modes)}; allowed: {', '.join(DOFS)}")
        axes[axis] = [ends.get(dof) for dof in DOFS]
    return axes, which, len(bodies)


def _quantities(file, axes, count):
    found = {name: _ordered(file, name, QUANTITIES[name][0], axes) for name in TAKEN if name in file}
    if set(DRIFT) <= set(file) and count == 1:
        m = np.arange(len(np.ravel(axes["wave_direction"])))
        parts = [_ordered(file, name, ("omega", *PAIR), axes)[:, m, m] for name in DRIFT]
        found["drift_force"] = np.stack(parts, axis=-1)
    if "excitation_force" not in found and {"diffraction_force", "Froude_Krylov_force"} <= set(found):
        found["excitation_force"] = found["diffraction_force"] + found["Froude_Krylov_force"]
    return found


def _body(file, axes, which, count):
    """Constants of a body, those of several only where each has its own"""
    found = {
        own: _ordered(file, own, BODY[own][0], axes) for own in MATRICES if own in file and not _is_upper(file, own)
    }
    if _is_upper(file, "hydrostatic_stiffness"):
        found["hydrostatic_stiffness"] = _from_upper(file["hydrostatic_stiffness"][()].reshape(-1, 6)[which])
    for names, size in ((VECTORS, 3), (SCALARS, 1)):
        for name, own in names.items():
            if name in file and file[name].size == size * count:
                row = file[name][()].reshape(count, size)[which]
                found[own] = row if size == 3 else float(row[0])
    return found


def _is_upper(file, name):
    """Whether a matrix is stored as S33 S34 S35 S44 S45 S55, as by programs with Capytaine 1"""
    return name in file and "hydrostatic_S" in [_axis_name(file[name], place) for place in range(file[name].ndim)]


def _from_upper(numbers):
    """Stiffness (6, 6) from the upper half of its part of heave, roll and pitch"""
    C, (i, j) = np.zeros((6, 6)), np.triu_indices(3)
    C[2 + i, 2 + j] = C[2 + j, 2 + i] = numbers
    return C


def _ordered(file, name, axes, places):
    """Values of a dataset on our axes in our order, from any stored order"""
    dataset = file[name]
    stored = [_axis_name(dataset, place) for place in range(dataset.ndim)]
    data = dataset[()]
    if dataset.dtype.names:  # h5py reads a compound of r, i as complex, netCDF4 as two fields
        data = data[dataset.dtype.names[0]] + 1j * data[dataset.dtype.names[1]]
    if "complex" in stored:
        data = np.moveaxis(data, stored.index("complex"), -1)
        data = data[..., 0] + 1j * data[..., 1]
        stored.remove("complex")
    if sorted(stored) != sorted(axes):
        raise FormatError(f"{file.filename}: {name} has the axes {', '.join(stored)}; allowed: {', '.join(axes)}")
    data = data.transpose([stored.index(axis) for axis in axes])
    for place, axis in enumerate(axes):
        if axis.endswith("_dof"):
            rows = [
                np.zeros_like(np.take(data, 0, place)) if at is None else np.take(data, at, place)
                for at in places[axis]
            ]
            data = np.stack(rows, place)
    return data


def _axis_name(dataset, place):
    scales = dataset.dims[place].values()
    if not scales:
        raise FormatError(f"{dataset.file.filename}: {dataset.name} has an axis without a name")
    return scales[0].name.rsplit("/", 1)[-1]
