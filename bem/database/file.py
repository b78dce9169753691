"""The HDF5 file of a database: it has its full size from the start, and it has its name only when complete."""

import contextlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.seals import damage, kind_filled_in
from hakobune.meshing.whole_files import NotWritten, write_whole

from .. import __doc__ as CONVENTION
from .. import __version__
from ..flexible.beams import Beam
from ..flexible.tables import Table
from ..modes import Body, Mode
from ..waves import wavenumber
from .integrity import MARK, ROWS, DamagedError, DatabaseError, check_schema
from .results import check_database_version, check_seal, seal_of, what_is
from .schema import (
    BODY,
    CELL_AXES,
    CHECKS,
    COORDINATES,
    DERIVED,
    ERROR,
    ESTIMATES,
    FORMAT,
    OF_SEVERAL,
    QUANTITIES,
    SCHEMA_VERSION,
    labels,
)

TABLE = ("points", "displacements", "masses")  # datasets of a mode shape given at points
BLOCK = 4096  # bytes of the seal before a file that is filled in later
LATER = (*QUANTITIES, "stored", "estimated_error", "checks", "wall_time", "solved", ROWS)
REMEDY = "copy it again, or solve it again with --fresh"


@dataclass(frozen=True, eq=False)
class Header:
    """Values known before the first frequency is solved.

    mesh, lid : PanelMesh, or None for no lid
    water_depth : m (may be inf); density : kg/m³; gravity : m/s²; rotation_center : (3,) m
    body : known values of the body, {name in `schema.BODY`: value}
    theta : (t,) rad, directions of the Kochin functions
    dimensions : sizes of the body, m, under their names in the scene
    scene : text of the scene; scene_hash : hash of the part of this text that must not change while the file grows
    attributes : further root attributes
    bodies : `bem.modes.Body` of each of several bodies (`values` then have one row per body); empty for one body
    modes : `bem.modes.Mode` of each shape beyond the rigid motions
    """

    mesh: PanelMesh
    lid: PanelMesh | None
    water_depth: float
    density: float
    gravity: float
    rotation_center: np.ndarray
    theta: np.ndarray
    body: dict = field(default_factory=dict)
    dimensions: dict = field(default_factory=dict)
    scene: str = ""
    scene_hash: str = ""
    attributes: dict = field(default_factory=dict)
    bodies: tuple = ()
    modes: tuple = ()


def check_place(path):
    """Raise DatabaseError if no file can be made at `path`; this is called before the computation."""
    path = Path(path)
    if path.is_dir():
        raise DatabaseError(f"{path} is a folder")
    if not path.parent.is_dir():
        raise DatabaseError(f"{path} cannot be written: the folder {path.parent} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise DatabaseError(f"{path} cannot be written: no permission in {path.parent}")


def check_replaceable(path):
    """Raise DatabaseError if the file under this name is in use, or is not a database of any version."""
    if not Path(path).exists():
        return
    if Path(path).is_file() and kind_filled_in(path) == FORMAT and damage(path):
        return  # HDF5 may read without end in a damaged file
    try:
        if h5py.is_hdf5(path):  # opening an empty file would turn it into an HDF5 file
            with h5py.File(path, "r+") as file:
                if file.attrs.get("format") == FORMAT:
                    return
    except OSError as error:
        if "unable to lock" in str(error):
            raise DatabaseError(f"{path} cannot be replaced: {_reason(error)}") from None
    raise DatabaseError(f"{path} is not a hakobune database, so it is not replaced; give another name")


@contextlib.contextmanager
def beside(path, later=()):
    """A new file, renamed to `path` when complete and sealed (`results`), and deleted if it is not completed.

    later : names of datasets and groups whose numbers are filled in later, which the seal excludes
    raises : `meshing.whole_files.NotWritten` if the file cannot be written to the disk; the old file is then unchanged

    HDF5 builds the file in memory, because HDF5 crashes with a segmentation fault on a full disk.
    """
    path = Path(path)
    check_place(path)
    name, memory = path.with_name(path.name + ".partial"), {"driver": "core", "backing_store": False}
    with h5py.File(name, "w", userblock_size=BLOCK if later else 0, **memory) as file:
        yield file
        file.flush()
        image = file.id.get_file_image()
        seal = seal_of(file, image, later)
        if later and len(seal) != BLOCK:
            raise AssertionError(f"the seal of {path} needs {len(seal)} bytes, {BLOCK} are there")
    write_whole(path, seal, image)


@contextlib.contextmanager
def opened(path, mode="r", checked=False) -> Iterator[Any]:  # h5py has no types
    """The open HDF5 file, from a path or an open file.

    checked : whether seal or schema have been checked already

    Raises DatabaseError if the file is not a database of this schema version.
    """
    if isinstance(path, h5py.File):
        yield path
        return
    path = Path(path)
    if not path.is_file():
        raise DatabaseError(f"{path} does not exist" if not path.exists() else f"{path} is not a file")
    if not checked:
        try:
            check_seal(path, REMEDY)
        except DamagedError:
            check_database_version(path)
            raise
    try:
        foreign = not h5py.is_hdf5(path)
        file = None if foreign else h5py.File(path, mode)
    except OSError as error:
        kind = DatabaseError if error.errno or "unable to lock" in str(error) else DamagedError  # HDF5 has no number
        raise kind(f"{path} cannot be opened: {_reason(error)}") from None
    if foreign:
        raise DatabaseError(f"{path} is not an HDF5 file; a database made by 'hakobune solve' is needed")
    with file:
        if file.attrs.get("format") != FORMAT:
            raise DatabaseError(
                f"{path} is {what_is(file)}, not a hakobune database; one made by 'hakobune solve' is needed"
            )
        check_database_version(path, int(file.attrs.get("schema_version", 0)))
        with damage_named(path):
            if not (checked or file.userblock_size):  # a sealed file cannot have changed
                check_schema(file)
            yield file


@contextlib.contextmanager
def unlocked(path, mode="r"):
    """The open HDF5 file.  Raises DatabaseError if the file cannot be opened, for example while another process
    writes it."""
    try:
        file = h5py.File(path, mode)
    except OSError as error:
        raise DatabaseError(f"{path} cannot be opened: {_reason(error)}") from None
    with file:
        yield file


@contextlib.contextmanager
def damage_named(path):
    """Context that turns HDF5's errors about an unreadable file into a DatabaseError of one line"""
    try:
        yield
    except (OSError, KeyError, RuntimeError) as error:
        said = str(error.args[0]) if error.args else ""
        if "ynchronously" not in said and not (isinstance(error, RuntimeError) and said.endswith(")")):
            raise  # errors of HDF5 have the cause in brackets; this error does not
        if "write" in said:
            cause = os.strerror(error.errno) if getattr(error, "errno", None) else said
            raise NotWritten(f"{path} cannot be written: {cause}; the data stored before is kept") from None
        raise DamagedError(f"{path} is damaged: {said.splitlines()[0]}; {REMEDY}") from None


def _reason(error):
    if error.errno in (11, 35) or "unable to lock" in str(error):
        return "another process has opened it; wait until it ends, or give another file"
    if "truncated file" in str(error):
        return "the file is truncated; copy it again, or give another name"
    return os.strerror(error.errno) if error.errno else str(error).splitlines()[0]


def lay_out(file, header, omega, wave_direction, names):
    """Write all values known before the computation to a new file, and NaN for every number still to be computed."""
    file.attrs.update(_attributes(header))
    _lay_out_coordinates(file, header, omega, wave_direction)
    _lay_out_quantities(file, [name for name in QUANTITIES if name in names])
    for name in [name for name in BODY if header.body.get(name) is not None]:
        axes, unit, _ = BODY[name]
        each = ("body",) if header.bodies and "influenced_dof" not in axes else ()
        _dataset(file, name, each + axes, unit, np.asarray(header.body[name], float))
    for name in CHECKS:
        _dataset(file, f"checks/{name}", ("omega",), "", np.full(len(omega), np.nan))
    _dataset(file, "wall_time", ("omega",), "s, per step", np.array([steps_text({})] * len(omega), "S480"))
    _dataset(file, "solved", ("omega",), "", np.zeros(len(omega), np.uint8))
    _dataset(file, ROWS, ("omega",), "", np.zeros(len(omega), MARK))
    for name, mesh in (("mesh", header.mesh), ("mesh/lid", header.lid)):
        if mesh is not None:
            _write_mesh(file, name, mesh)
    for i, mode in enumerate(header.modes):
        if isinstance(mode.shape, Table):
            for name in (name for name in TABLE if getattr(mode.shape, name) is not None):
                file.create_dataset(f"shapes/{i}/{name}", data=getattr(mode.shape, name))


def _lay_out_coordinates(file, header, omega, wave_direction):
    """The axes, and what follows from them: periods, wavenumbers, degrees"""
    values = {
        "omega": omega,
        "wave_direction": wave_direction,
        "theta": header.theta,
        "panel": np.arange(header.mesh.total),
        **labels(header.bodies, header.modes),
    }
    for axis, (_, unit, kind) in {**COORDINATES, **(OF_SEVERAL if header.bodies else {})}.items():
        data = np.array(values[axis], dtype=h5py.string_dtype() if kind is str else kind)
        dataset = file.create_dataset(axis, data=data)
        dataset.make_scale(axis)
        if unit:
            dataset.attrs["units"] = unit
    k = wavenumber(omega, header.water_depth, header.gravity)
    derived = (2 * np.pi / omega, k, np.degrees(wave_direction))
    for (name, (axes, unit, _)), value in zip(DERIVED.items(), derived, strict=True):
        _dataset(file, name, axes, unit, value)


def _lay_out_quantities(file, names):
    """NaN for each number, no mark of a stored cell, NaN for each estimated error"""
    for name in names:
        axes, unit, kind = QUANTITIES[name]
        nothing = np.full([len(file[axis]) for axis in axes], np.nan, kind)
        _dataset(file, name, axes, unit, nothing)
        cells = CELL_AXES[name]
        _dataset(file, f"stored/{name}", cells, "", np.zeros([len(file[axis]) for axis in cells], MARK))
        if name in ESTIMATES:
            _dataset(file, f"estimated_error/{name}", axes, unit, np.full(nothing.shape, np.nan, ERROR))


def _attributes(header):
    return {
        "format": FORMAT,
        "schema_version": SCHEMA_VERSION,
        "software_version": __version__,
        "convention": CONVENTION,
        "water_depth": float(header.water_depth),
        "density": float(header.density),
        "gravity": float(header.gravity),
        "rotation_center": np.asarray(header.rotation_center, float),
        "dimensions": json.dumps(header.dimensions),
        "scene": header.scene,
        "scene_hash": header.scene_hash,
        **({"bodies": json.dumps([body._asdict() for body in header.bodies])} if header.bodies else {}),
        **({"modes": json.dumps([_of_mode(mode) for mode in header.modes])} if header.modes else {}),
        **header.attributes,
    }


def _dataset(file, name, axes, unit, data):
    dataset = file.create_dataset(name, data=data)
    for place, axis in enumerate(axes):
        dataset.dims[place].attach_scale(file[axis])
    if unit:
        dataset.attrs["units"] = unit


def _write_mesh(file, name, mesh):
    group = file.require_group(name)
    group.attrs["symmetry"], group.attrs["name"] = mesh.symmetry, mesh.name
    sizes = {"point": len(mesh.points), "coordinate": 3, "panel": len(mesh.corners), "corner": 4}
    for axis, size in sizes.items():
        group.create_dataset(axis, data=np.arange(size)).make_scale(axis)
    numbers = (("body", ("panel",), ""),) if mesh.body is not None else ()
    for data, axes, unit in (("points", ("point", "coordinate"), "m"), ("corners", ("panel", "corner"), ""), *numbers):
        _dataset(group, data, axes, unit, getattr(mesh, data))


def _read_mesh(group):
    body = group["body"][()] if "body" in group else None
    corners, attributes = group["corners"][()], group.attrs
    return PanelMesh(group["points"][()], corners, attributes["symmetry"], attributes.get("name", ""), body)


def read_header(file, attributes=None):
    """The `Header` with which a file was made.  Raises DatabaseError if part of the header is missing.

    attributes : {name: value} of the file, if already read
    """
    try:
        return _header(file, dict(file.attrs) if attributes is None else attributes)
    except KeyError as error:
        raise DamagedError(f"{file.filename} is damaged: {error.args[0]}") from None


def _header(file, attributes):
    known, there = {*_attributes(_EMPTY), "bodies", "modes"}, set(file)
    return Header(
        mesh=_read_mesh(file["mesh"]),
        lid=_read_mesh(file["mesh/lid"]) if "lid" in file["mesh"] else None,
        water_depth=float(attributes["water_depth"]),
        density=float(attributes["density"]),
        gravity=float(attributes["gravity"]),
        rotation_center=np.asarray(attributes["rotation_center"]),
        theta=file["theta"][()],
        body={name: file[name][()] for name in BODY if name in there},
        bodies=tuple(_body(one) for one in json.loads(attributes.get("bodies", "[]"))),
        modes=tuple(_mode(file, i, one) for i, one in enumerate(json.loads(attributes.get("modes", "[]")))),
        dimensions=json.loads(attributes["dimensions"]),
        scene=attributes["scene"],
        scene_hash=attributes["scene_hash"],
        attributes={key: value for key, value in attributes.items() if key not in known},
    )


def _body(given):
    return Body(**{key: tuple(value) if isinstance(value, list) else value for key, value in given.items()})


def _of_mode(mode):
    return mode._asdict() | {"shape": mode.shape._asdict() if isinstance(mode.shape, Beam) else None}


def _mode(file, number, given):
    if given["shape"]:
        shape = Beam(**given["shape"])
    else:
        group = file[f"shapes/{number}"]
        shape = Table(**{name: group[name][()] for name in TABLE if name in group})
    return Mode(**given | {"shape": shape, "place": tuple(given["place"]), "on": tuple(given.get("on", ()))})


_EMPTY = Header(PanelMesh(np.zeros((0, 3)), np.zeros((0, 4))), None, np.inf, 0, 0, np.zeros(3), np.zeros(0))


def steps_text(seconds):
    """{step: s} as at most 480 bytes of JSON, the allocated room; a longer list is summarised."""
    text = json.dumps(seconds)
    return (text if len(text) <= 480 else json.dumps({"total": sum(seconds.values())})).encode()
