"""Whether a database is unchanged since it was written: its schema, and checksums of every number.

The mark of a stored cell is the CRC-32 of its bytes, 0 where nothing is stored, so that data and checksum become
valid in one step (`storing.append`). Checks and wall time of a frequency have one CRC-32 for the row. The seal of the
file (`results`) covers the rest: structure, attributes, coordinates, body, mesh. Files older than checksums have
marks of one byte and no seal; only their schema is checked.
"""

import tomllib
import zlib

import h5py
import numpy as np

from .schema import BODY, CELL_AXES, CHECKS, COORDINATES, DERIVED, ESTIMATES, LIMITS, OF_SEVERAL, QUANTITIES

ROWS = "row_checksum"
MARK = np.uint32
LATER = ("rao", "drift_force_fixed", "drift_force")  # estimated errors of these may be missing in files with checksums
REMEDY = "'hakobune check FILE --repair' marks it as unsolved, and the command that made the file solves it again"


class DatabaseError(ValueError):
    """The file cannot be used for the request; the message gives the reason and a remedy."""


class DamagedError(DatabaseError):
    """The file is a database whose contents have changed since it was written."""


class VersionError(DatabaseError):
    """The file has another version of the schema; no damage is known."""


def crc(*parts):
    """CRC-32 of several arrays in order; never 0, which marks an empty cell"""
    value = 0
    for part in parts:
        value = zlib.crc32(np.ascontiguousarray(part).tobytes(), value)
    return value or 1


def has_checksums(file):
    """Whether a file was made with checksums"""
    return ROWS in file


def _read(file, name):
    """A whole dataset, by the low-level interface of h5py: the high-level one takes five times as long, 0.1 ms.

    Raises DatabaseError for a dataset of damaged size: HDF5 would read for hours.
    """
    dataset = h5py.h5d.open(file.id, name.encode())
    if dataset.get_space().get_simple_extent_npoints() * dataset.get_type().get_size() > file.id.get_filesize():
        raise DatabaseError(
            f"{file.filename} is damaged: {name} is larger than the file; copy it again, or solve it again with --fresh"
        )
    data = np.empty(dataset.shape, dataset.dtype)
    dataset.read(h5py.h5s.ALL, h5py.h5s.ALL, data)
    return data


def check_schema(file):
    """Raise DatabaseError unless a file has the required datasets, axes, types and finite coordinates."""
    for problem in _schema_problems(file):
        raise DamagedError(f"{file.filename} is damaged: {problem}; copy it again, or solve it again with --fresh")


def _schema_problems(file):
    for name in (*COORDINATES, *DERIVED, "solved", "wall_time", "stored", "checks", "mesh"):
        if name not in file:
            yield f"{name} is missing"
            return
    try:
        several = [axis for axis in OF_SEVERAL if axis in file]
        coordinates = {axis: _read(file, axis) for axis in (*COORDINATES, *several)}
        lengths = {axis: len(values) for axis, values in coordinates.items()}
    except (TypeError, KeyError):
        yield "a coordinate is not a one-dimensional array"
        return
    yield from _wrong_coordinates(file, coordinates)
    yield from _wrong_scene(file)
    there, errors = set(file), set(file.get("estimated_error", ()))
    stored = set(file["stored"])
    names = [name for name in QUANTITIES if name in there or name in stored]
    for name in names:
        axes, _, kind = QUANTITIES[name]
        yield from _wrong_dataset(file, name, [lengths[axis] for axis in axes], "c" if kind is complex else "f")
        yield from _wrong_dataset(file, f"stored/{name}", [lengths[axis] for axis in CELL_AXES[name]], "u")
        if name in ESTIMATES and (name in errors or (has_checksums(file) and name not in LATER)):
            yield from _wrong_dataset(file, f"estimated_error/{name}", [lengths[axis] for axis in axes], "f")
    for name in CHECKS:
        yield from _wrong_dataset(file, f"checks/{name}", [lengths["omega"]], "f")
    yield from _wrong_dataset(file, "solved", [lengths["omega"]], "u")
    yield from _wrong_dataset(file, "wall_time", [lengths["omega"]], "S")


def _wrong_scene(file):
    """Fault in the scene of a file without a seal, whose text is not covered by a checksum"""
    try:
        tomllib.loads(str(file.attrs.get("scene", "")))
    except tomllib.TOMLDecodeError as error:
        yield f"the text of its scene cannot be read: {error}"


def _wrong_dataset(file, name, shape, kind):
    try:
        found = h5py.h5d.open(file.id, name.encode())
    except (KeyError, TypeError, ValueError):
        yield f"{name} is missing"
        return
    if list(found.shape) != list(shape):
        yield f"{name} has shape {found.shape}; allowed: {tuple(shape)}"
    elif found.dtype.kind != kind:
        yield f"{name} is of type {found.dtype}"


def _wrong_coordinates(file, coordinates):
    for name, least in (("omega", 0.0), ("wave_direction", -np.inf), ("theta", -np.inf)):
        values = coordinates[name]
        if values.ndim != 1 or values.dtype.kind != "f" or not np.all(np.isfinite(values)):
            yield f"{name} is not a one-dimensional array of finite numbers"
        elif np.any(np.diff(values) <= 0) or np.any(values <= least):
            yield f"{name} does not increase" + (" from above 0" if least == 0 else "")
    for name in ("density", "gravity", "water_depth"):
        value = file.attrs.get(name, np.nan)
        if not (np.ndim(value) == 0 and value > 0 and (np.isfinite(value) or name == "water_depth")):
            yield f"{name} is {value}"
    center = np.asarray(file.attrs.get("rotation_center", np.nan), float)
    if center.shape != (3,) or not np.all(np.isfinite(center)):
        yield f"rotation_center is {center}"
    there = set(file)
    for name in BODY:
        if name in there and not np.all(np.isfinite(_read(file, name))):
            yield f"{name} is not finite"


def damaged_cells(file, name, values=None):
    """Marked cells of a quantity whose values differ from their checksum: a bool array over `schema.CELL_AXES`.

    values : the whole dataset, if already read
    """
    marks = file["stored"][name][()]
    values = file[name][()] if values is None else values
    if marks.dtype != MARK:
        finite = ~np.isnan(values) if name in LIMITS else np.isfinite(values)
        return (marks != 0) & ~finite.reshape(*marks.shape, -1).all(axis=-1)
    estimate = f"estimated_error/{name}"
    errors = file[estimate][()] if estimate in file else None
    out = np.zeros(marks.shape, bool)
    for cell in np.argwhere(marks):
        cell = tuple(cell)
        out[cell] = marks[cell] != crc(values[cell], *(() if errors is None else (errors[cell],)))
    return out


def damaged_rows(file):
    """Whether the checks or the wall time of each solved frequency differ from their checksum; shape (n,)"""
    solved = file["solved"][()]
    if ROWS not in file or not solved.any():
        return np.zeros(len(solved), bool)
    stored, found = file[ROWS][()], row_crcs(file)
    return np.array([bool(solved[i]) and stored[i] != found[i] for i in range(len(solved))], bool)


def check_rows(file, rows):
    """Raise DatabaseError if checks or wall times of the frequencies `rows` (n,) bool are damaged."""
    damaged = damaged_rows(file) & rows
    if damaged.any():
        raise DamagedError(f"{file.filename} is damaged: the checks{_where(file, damaged)}; {REMEDY}")


def remark(file, name):
    """Write checksums for the cells of a quantity that are marked as stored."""
    marks, estimate = file["stored"][name], f"estimated_error/{name}"
    values = [file[path][()] for path in (name, estimate) if path in file]
    for cell in map(tuple, np.argwhere(marks[()])):
        marks[cell] = crc(*(value[cell] for value in values))


def row_crcs(file):
    """CRC-32 of the stored checks and wall time of each frequency, a list"""
    checks = np.stack([file["checks"][name][()] for name in CHECKS], axis=1).astype(float)
    texts = [np.frombuffer(bytes(text), np.uint8) for text in file["wall_time"][()]]
    return list(map(crc, checks, texts))


def checks_crc(checks, wall_time):
    """CRC-32 of {name: value} of `schema.CHECKS` and of wall times as text in bytes"""
    return crc(np.array([checks[name] for name in CHECKS], float), np.frombuffer(wall_time, np.uint8))


def check_cells(file, name, values=None, rows=None):
    """Raise DatabaseError, naming the first frequencies, if stored cells of a quantity are damaged.

    rows : (n,) bool, the frequencies that are checked; None for all
    """
    damaged = damaged_cells(file, name, values)
    if damaged.ndim and rows is not None:
        damaged = damaged & rows.reshape(-1, *[1] * (damaged.ndim - 1))
    if damaged.any():
        raise DamagedError(f"{file.filename} is damaged: {name}{_where(file, damaged)}; {REMEDY}")


def _where(file, damaged):
    if not damaged.ndim:
        return " has changed since it was stored"
    rows = damaged.reshape(len(damaged), -1).any(axis=1)
    omega = file["omega"][()][rows]
    return (
        f" at ω = {omega[0]:.4g} rad/s"
        + (f" and {len(omega) - 1} others" if len(omega) > 1 else "")
        + (" has changed since it was stored")
    )


def repair(file):
    """Mark damaged cells of an open file as not stored and set their numbers to NaN.  Returns {name: number of cells}.

    raises : DatabaseError for damage that marks cannot mend
    """
    check_schema(file)
    found = {}
    again = damaged_rows(file)
    for name in (name for name in QUANTITIES if name in file):
        damaged = damaged_cells(file, name)
        if damaged.ndim:
            damaged = damaged | (again.reshape(-1, *[1] * (damaged.ndim - 1)) & (file["stored"][name][()] != 0))
        for cell in np.argwhere(damaged):
            file["stored"][name][tuple(cell)] = 0
            file[name][tuple(cell)] = np.nan
            if f"estimated_error/{name}" in file:
                file[f"estimated_error/{name}"][tuple(cell)] = np.nan
        if damaged.any():
            found[name] = int(damaged.sum())
    for i in np.flatnonzero(again):
        file["solved"][i] = 0
        for name in CHECKS:
            file["checks"][name][i] = np.nan
        file["wall_time"][i] = b"{}"
    return found
