"""The database of one scene: an HDF5 file that is filled row by row and survives a kill at any instant.

Every quantity is a full grid over frequencies and headings, allocated and set to NaN when the file is made. An append
therefore changes numbers in place and never the structure of the file.
The group /stored has one mark per frequency (and heading). Data are written first, then flushed, then marked. A new
file is made under another name and renamed when complete;
`widening` replaces a file by a new file.
"""

from __future__ import annotations

import contextlib
import json
import os
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from hakobune.meshing.whole_files import keep_room

from .. import INTERPOLATED
from .file import LATER, DatabaseError, Header, beside, lay_out, opened, read_header
from .integrity import check_cells, check_rows
from .schema import BESIDE, BODY, CELL_AXES, CHECKS, COORDINATES, DERIVED, ESTIMATES, LIMITS, NEEDS_MOTION, QUANTITIES

if TYPE_CHECKING:
    from hakobune.meshing.panels import PanelMesh

    from .reader import Reader

SAME = 1e-9  # relative in omega, rad in heading: less than a user's smallest step, more than rounding


@dataclass(frozen=True)
class Row:
    """Missing quantities of one frequency: `want` names, at `headings` (rad)."""

    omega: float
    headings: tuple[float, ...]
    want: frozenset[str]


@dataclass(frozen=True)
class Pending:
    """All numbers that a file still lacks: names of limits, and a `Row` for each frequency."""

    limits: tuple[str, ...]
    rows: tuple[Row, ...]


def create(path, header, omega, wave_direction, names):
    """Make the file of a scene with every number still NaN; an existing file of that name is replaced.

    omega : (n,) rad/s; wave_direction : (m,) rad; names : keys of `schema.QUANTITIES`
    Raises DatabaseError if the path cannot be written.
    """
    omega, wave_direction = np.unique(np.asarray(omega, float)), np.unique(np.asarray(wave_direction, float))
    with beside(path, LATER) as file:
        lay_out(file, header, omega, wave_direction, names)


@contextlib.contextmanager
def writing(path):
    """The open file of a database, for `append`; only one process at a time may open it."""
    if not isinstance(path, h5py.File):
        keep_room(path)
    with opened(path, "r+") as file:
        for name in [name for name in QUANTITIES if name in file]:
            check_cells(file, name)
        check_rows(file, np.ones(len(file["omega"]), bool))
        mark_whole_rows(file)
        yield file


def estimate_of(name):
    """Name of the dataset of estimated errors of a quantity"""
    return f"estimated_error/{name}"


def row_values(file, omega, headings, names):
    """Stored values of one frequency, {name: array in the shape that `append` needs}; None if one of the values is
    missing"""
    (i,) = places_on(file, [omega], "omega")
    columns, found = places_on(file, headings, "wave_direction"), {}
    for name in names:
        if name not in file:
            return None
        chosen = columns if "wave_direction" in CELL_AXES[name] else ...
        if not np.all(file["stored"][name][i][chosen]):
            return None
        found[name] = file[name][i][chosen]
    return found


def pending(path):
    """`Pending` rows and limits of a file, given as a path or open."""
    with opened(path) as file:
        names = [name for name in QUANTITIES if name in file]
        limits = tuple(name for name in names if name in LIMITS and not file["stored"][name][()])
        marks = {name: file["stored"][name][()] != 0 for name in names if name not in LIMITS}
        headings = file["wave_direction"][()]
        rows = [_lacking(float(w), headings, marks, i) for i, w in enumerate(file["omega"][()])]
    return Pending(limits, tuple(row for row in rows if row.want))


def open_database(path: str | os.PathLike[str] | h5py.File) -> Database:
    """Read access to a database.  Raises DatabaseError if `path` is not one of this version.

    path : path of the file, which is opened again for every reading; or the open file from `writing`
    """
    with opened(path) as file:
        attributes, there = dict(file.attrs), set(file)
        header = read_header(file, attributes)
        names = tuple([name for name in QUANTITIES if name in there])
        marks = [file["stored"][name][()] for name in names]
        rows = np.ones(len(file["omega"]), bool)
        for mark in [mark for mark in marks if mark.ndim]:
            rows &= (mark != 0).reshape(len(rows), -1).all(axis=1)
        return Database(
            Path(file.filename),
            header,
            names,
            rows,
            file["omega"][()][rows],
            file["wave_direction"][()],
            attributes,
            path if isinstance(path, h5py.File) else None,
        )


@dataclass(frozen=True, eq=False)
class Database:
    """The solved part of a file, frequencies ascending.

    names : quantities of the file; rows : whether each frequency of the file is solved, (all,)
    omega : solved frequencies, rad/s, (n,); wave_direction : headings, rad, (m,); attributes : attributes of the file
    file : file open for reading; if it is None or closed, every reading opens `path`
    """

    path: Path
    header: Header
    names: tuple[str, ...]
    rows: np.ndarray
    omega: np.ndarray
    wave_direction: np.ndarray
    attributes: dict
    file: h5py.File | None = None

    def __repr__(self) -> str:
        return (
            f"<Database {self.path.name}: {len(self.omega)} of {len(self.rows)} frequencies, "
            f"{len(self.wave_direction)} headings, {', '.join(self.names)}>"
        )

    def __getattr__(self, name: str) -> Any:
        if name in BODY:
            return self.header.body.get(name)
        raise AttributeError(f"a database contains no {name!r}")

    def __contains__(self, name: object) -> bool:
        """Whether a quantity is stored at every solved frequency"""
        return isinstance(name, str) and self.holds(name)

    def __getitem__(self, name: str) -> np.ndarray:
        """Solved rows of a quantity, axes as in `schema.QUANTITIES`; also period, wavenumber, theta."""
        if name in QUANTITIES:
            self.require(name)
        with self.opened() as file:
            if name not in file:
                known = ", ".join(n for n in (*COORDINATES, *DERIVED, *self.names))
                raise DatabaseError(f"{self.path} contains no {name!r}; it contains: {known}")
            value = file[name].asstr()[()] if h5py.check_string_dtype(file[name].dtype) else file[name][()]
            if name in QUANTITIES:
                check_cells(file, name, value, self.rows)
            return value[self.rows] if _first_axis(name) == "omega" else value

    def require(self, *names: str) -> None:
        """Raise DatabaseError if one of the quantities is missing; the message names the option to add to the
        command."""
        for name in names:
            if name not in QUANTITIES:
                raise DatabaseError(f"{name!r} is not a quantity of a database; allowed: {', '.join(QUANTITIES)}")
        missing = [name for name in names if name not in self.names]
        if missing:
            raise DatabaseError(f"{self.path} contains no {', '.join(missing)}; {self._remedy(missing)}")
        if not self.rows.any() and any(name not in LIMITS for name in names):
            raise DatabaseError(f"{self.path} has no solved frequency yet; repeat the command that made it to continue")
        unsolved = [name for name in names if name in LIMITS and not self._stored(name)]
        if unsolved:
            raise DatabaseError(f"{self.path} lacks {', '.join(unsolved)}; repeat the command that made it to continue")

    def require_one_body(self) -> None:
        """Raise DatabaseError for a database of several bodies, with their names, or of a flexible body."""
        if self.bodies:
            names = ", ".join(body.name for body in self.bodies)
            raise DatabaseError(
                f"{self.path} contains {len(self.bodies)} bodies, {names}; allowed here: one body, solved alone; "
                "hakobune moor, response and simulate take several"
            )
        self.require_rigid()

    def require_rigid(self) -> None:
        """Raise DatabaseError for a database of flexible bodies, whose motions rigid studies do not support."""
        if self.modes:
            raise DatabaseError(
                f"{self.path} is for a body with {len(self.modes)} motions beyond the six, {self.modes[0].name} …; "
                "allowed here: the six rigid motions; solve its scene without [[modes]]"
            )

    @cached_property
    def asked(self) -> np.ndarray:
        """Requested frequencies of the file, rad/s; shape (all,)"""
        with self.opened() as file:
            return file["omega"][()]

    @cached_property
    def has_viscous_motions(self) -> bool:
        """Whether stored motions and drift of the free body include viscous damping, which depends on wave height"""
        return "viscous" in self._scene

    @property
    def has_damping_lids(self) -> bool:
        """Whether lids on the water absorb energy: the damping then exceeds the damping by radiated waves"""
        return bool(self._scene.get("damping_lids"))

    @property
    def wall(self) -> float | None:
        """m, y of the vertical wall along x beside the body, or None"""
        return self._scene.get("wall")

    @cached_property
    def _scene(self) -> dict[str, Any]:
        import tomllib

        with contextlib.suppress(tomllib.TOMLDecodeError):  # a scene converted from another program has no tables
            return tomllib.loads(self.header.scene)
        return {}

    @property
    def bodies(self) -> tuple:
        """`bem.modes.Body` of each of several bodies, empty for a single body"""
        return self.header.bodies

    @property
    def modes(self) -> tuple:
        """`bem.modes.Mode` of each shape beyond the rigid motions"""
        return self.header.modes

    @property
    def stiffness(self) -> np.ndarray | None:
        """Stiffness of water, weight and structure; shape (n, moving)"""
        return _sum(self.hydrostatic_stiffness, self.structural_stiffness)

    @cached_property
    def reader(self) -> Reader:
        """`bem.database.reader.Reader`: the bodies in any wave, with estimated errors, from the stored rows

        raises : DatabaseError for a database of several bodies or of a flexible one, which studies of one rigid body
            do not support
        """
        self.require_one_body()
        return self.bodies_reader

    @cached_property
    def bodies_reader(self) -> Reader:
        """`reader`, also for several bodies and for flexible bodies"""
        from .reader import reader

        self.require()
        return reader(self)

    def at(self, omega: Any, name: str, headings: Any = None) -> tuple[np.ndarray, np.ndarray]:
        """Value (q, …) of a quantity, in its stored unit, and estimated error (q, …) at omega (q,) rad/s and headings
        (p,) rad; headings : None for the stored headings

        raises : `bem.database.between_frequencies.BetweenError`, a ValueError, outside the stored range and for unknown
            values
        """
        return self.reader.at(omega, name, headings)

    def holds(self, name: str) -> bool:
        """Whether the limit called `name` is stored, or the quantity called `name` is part of the file"""
        return name in self.names and (name not in LIMITS or self._stored(name))

    def checks(self) -> dict[str, np.ndarray]:
        """{name: (n,)} of `schema.CHECKS` for the solved frequencies; NaN where a check did not apply."""
        with self.opened() as file:
            check_rows(file, self.rows)
            return {name: file["checks"][name][()][self.rows] for name in CHECKS}

    def estimated_errors(self) -> dict[str, np.ndarray]:
        """{name: (n, …)} of the stored `schema.ESTIMATES`: absolute errors, each in the unit and on the axes of its
        quantity.

        NaN where the method gives no estimate, and in files of versions without estimates.
        """
        names = [name for name in ESTIMATES if name in self.names]
        with self.opened() as file:
            for name in names:
                check_cells(file, name, None, self.rows)
            return {
                name: file[estimate_of(name)][()][self.rows].astype(float)
                if estimate_of(name) in file
                else np.full((self.rows.sum(), *file[name].shape[1:]), np.nan)
                for name in names
            }

    def wall_times(self) -> list[dict[str, float]]:
        """A dictionary {step: s} of the wall times of each solved frequency."""
        with self.opened() as file:
            check_rows(file, self.rows)
            return [json.loads(text) for text in file["wall_time"][()][self.rows]]

    def interpolated_estimates(self) -> np.ndarray:
        """Whether the estimated errors of a solved frequency come from neighbouring frequencies; shape (n,)"""
        return np.array([INTERPOLATED in steps for steps in self.wall_times()], bool)

    @property
    def complete(self) -> bool:
        """Whether all requested frequencies and limits of the file are solved."""
        return bool(self.rows.all()) and all(self._stored(name) for name in self.names if name in LIMITS)

    @property
    def water_depth(self) -> float:
        """m, inf for deep water"""
        return self.header.water_depth

    @property
    def density(self) -> float:
        """kg/m³"""
        return self.header.density

    @property
    def gravity(self) -> float:
        """m/s²"""
        return self.header.gravity

    @property
    def rotation_center(self) -> np.ndarray:
        """Rotation centre, m; shape (3,)"""
        return self.header.rotation_center

    @property
    def dimensions(self) -> dict[str, float]:
        """{name in the scene: size of the body, m}; empty for a body from a mesh file"""
        return dict(self.header.dimensions)

    @property
    def sizes(self) -> dict[str, float]:
        """Dimensions, m. A hull that is neither box nor ship has the dimensions of the box about the origin that
        encloses it; a round hull also has its radius"""
        if self.is_round:
            points = np.zeros((1, 3)) if self.mesh is None else self.mesh.whole().points
            found = {"radius": float(np.hypot(*points[:, :2].T).max()), "draft": float(-points[:, 2].min())}
            found |= self.dimensions
            return {"length": 2 * found["radius"], "beam": 2 * found["radius"]} | found
        if self.mesh is None or not len(self.mesh) or "length" in self.dimensions:
            return self.dimensions
        points = self.mesh.whole().points
        length, beam = 2 * np.abs(points[:, :2]).max(axis=0)
        return {"length": float(length), "beam": float(beam), "draft": float(-points[:, 2].min())} | self.dimensions

    @property
    def is_round(self) -> bool:
        """Whether the hull is a body of revolution about the vertical through the origin, and neither a wall nor
        fixed bodies of an import stand beside it"""
        return (
            self.wall is None
            and not self.header.attributes.get(BESIDE)
            and (set(self.dimensions) == {"radius", "draft"} or (self.mesh is not None and self.mesh.is_round))
        )

    @property
    def symmetry(self) -> str:
        """Planes of symmetry of hull and water, "", "x", "y" or "xy": a wall destroys the symmetry in the plane
        parallel to the wall; fixed bodies of an import beside the hull destroy every symmetry"""
        if self.header.attributes.get(BESIDE):
            return ""
        return self.mesh.symmetry if self.wall is None else self.mesh.symmetry.replace("y", "")

    @property
    def mesh(self) -> PanelMesh:
        """PanelMesh with which the results were computed"""
        return self.header.mesh

    @property
    def lid(self) -> PanelMesh | None:
        """PanelMesh of the interior free surface, or None"""
        return self.header.lid

    def opened(self) -> AbstractContextManager[Any]:
        """Context of the open HDF5 file"""
        return opened(self.file or self.path, checked=True)  # a closed file is false

    def _stored(self, name: str) -> bool:
        with self.opened() as file:
            return bool(file["stored"][name][()])

    def _remedy(self, missing):
        motion = [name for name in missing if name in NEEDS_MOTION]
        if motion and self.inertia_matrix is None:
            return "motions need the inertia of the body: give --gyration kxx,kyy,kzz (scene: gyration)"
        return f"repeat the command that made the database, with --only {','.join(missing)}"


def _sum(first, second):
    return first if first is None or second is None else first + second


def mark_whole_rows(file):
    """Mark the frequencies that have all their quantities; file : open file, or a mapping {name: dataset} of the
    file"""
    whole = np.ones(len(file["omega"]), bool)
    for mark in [file[f"stored/{name}"][()] for name in file["stored"] if name not in LIMITS]:
        whole &= (mark != 0).reshape(len(whole), -1).all(axis=1)
    if not np.array_equal(file["solved"][()], whole):
        file["solved"][...] = whole


def _lacking(omega, headings, marks, i):
    want, columns = set(), np.zeros(len(headings), bool)
    for name, mark in marks.items():
        if not mark[i].all():
            want.add(name)
            if mark.ndim == 2:
                columns |= ~mark[i]
    return Row(omega, tuple(headings[columns].tolist()), frozenset(want))


def _first_axis(name):
    axes = {**COORDINATES, **DERIVED, **QUANTITIES, **BODY}.get(name, ((),))[0]
    return axes[0] if axes else None


def same_omega(a, b):
    """Whether two frequencies, rad/s, are equal but for rounding"""
    return abs(a - b) <= SAME * abs(b)


def same_heading(a, b):
    """Whether two headings, rad, are equal but for rounding"""
    return abs((a - b + np.pi) % (2 * np.pi) - np.pi) <= SAME


def places_on(file, values, axis):
    """Indices at which an axis of the file has the given `values`.  Raises DatabaseError if the axis lacks one of
    them."""
    same = same_omega if axis == "omega" else same_heading
    known = file[axis][()]
    places = []
    for value in values:
        at = np.flatnonzero(same(known, value))
        if not len(at):
            raise DatabaseError(f"{axis} = {value:.9g} is not one of the file's {len(known)} values")
        places.append(int(at[0]))
    return places
