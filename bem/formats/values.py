"""What a file of another program can hold of a database: the solved frequencies, in the conventions of `bem`."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..database.schema import BODY, LIMITS, QUANTITIES

CARRIED = tuple(name for name in QUANTITIES if not name.startswith("kochin") and name != "pressure")
EVEN = 1e-6  # relative to the step, of numbers that are one step apart


class FormatError(ValueError):
    """A file of another program cannot be written or read; one line says what, where and the way out."""


@dataclass(frozen=True, eq=False)
class Values:
    """omega : (n,) rad/s, rising; wave_direction : (m,) rad, rising; water_depth : m, may be inf

    quantities : {name of `schema.QUANTITIES`: array}, axes as there; body : {name of `schema.BODY`: value}
    rotation_center : (3,) m; mesh : PanelMesh, or None; name : of the body
    """

    omega: np.ndarray
    wave_direction: np.ndarray
    water_depth: float
    density: float
    gravity: float
    quantities: dict
    body: dict = field(default_factory=dict)
    rotation_center: np.ndarray = field(default_factory=lambda: np.zeros(3))
    mesh: object = None
    name: str = "body"

    def get(self, name):
        """A quantity or a value of the body; None where it is not there"""
        return self.quantities.get(name, self.body.get(name))

    def need(self, *names):
        """The quantities.  Raises FormatError naming those that are not there."""
        missing = [name for name in names if self.get(name) is None]
        if missing:
            raise FormatError(f"{', '.join(missing)} is not in the database; allowed: one with it, by --only")
        return [self.get(name) for name in names]


def values_of(db):
    """The Values of an opened database.  Raises DatabaseError where nothing is solved yet."""
    names = [name for name in CARRIED if name in db.names and (name not in LIMITS or db.complete)]
    header = db.header
    return Values(
        np.asarray(db.omega),
        np.asarray(db.wave_direction),
        header.water_depth,
        header.density,
        header.gravity,
        {name: db[name] for name in names},
        {name: header.body[name] for name in BODY if header.body.get(name) is not None},
        np.asarray(header.rotation_center, float),
        header.mesh,
        db.path.stem,
    )


def evenly(what, numbers, unit, way_out):
    """(first, last, count) of numbers one step apart.  Raises FormatError: some files know no others."""
    steps = np.diff(numbers)
    if len(steps) and not np.all(np.abs(steps - steps.mean()) <= EVEN * steps.mean()):
        raise FormatError(
            f"{what} are {steps.min():.4g} to {steps.max():.4g} {unit} apart; allowed in this format: evenly spaced, "
            f"{way_out}"
        )
    return float(numbers[0]), float(numbers[-1]), len(numbers)


def table_of(path, columns, separator=None):
    """(k, columns) numbers of a text file; lines that do not begin with a number are passed over.  Raises FormatError.

    columns : allowed numbers in a line; shorter lines are filled up with NaN
    """
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise FormatError(f"{path}: {error.strerror}") from None
    rows = []
    for number, line in enumerate(text.splitlines(), 1):
        words = line.replace("D+", "E+").replace("D-", "E-").split(separator)
        try:
            row = [float(word) for word in words]
        except ValueError:
            if not rows:
                continue  # a heading
            raise FormatError(f"{path}, line {number}: {line.strip()!r} is not numbers") from None
        if row and len(row) not in columns:
            raise FormatError(
                f"{path}, line {number} has {len(row)} numbers; allowed: {' or '.join(map(str, columns))}"
            )
        if row:
            rows.append(row + [np.nan] * (max(columns) - len(row)))
    if not rows:
        raise FormatError(f"{path} has no numbers")
    return np.array(rows)


def gridded(path, coordinates, values):
    """Rising coordinates and values on their grid.  Raises FormatError where a place is empty or filled twice.

    coordinates : list of (k,); values : (k, …); returns : list of (n_i,), array (n_0, n_1, …, …)
    """
    axes, places = zip(*(np.unique(axis, return_inverse=True) for axis in coordinates), strict=True)
    shape = tuple(map(len, axes))
    counts = np.zeros(shape, int)
    np.add.at(counts, places, 1)
    if not np.all(counts == 1):
        where = np.argwhere(counts != 1)[0]
        said = ", ".join(f"{axis[i]:.6g}" for axis, i in zip(axes, where, strict=True))
        raise FormatError(f"{path}: {counts[tuple(where)]} values for {said}; allowed: one for each, of a full table")
    grid = np.zeros(shape + values.shape[1:], values.dtype)
    grid[places] = values
    return list(axes), grid
