"""Storing of frequencies in a database: the data are written, then flushed, then marked as stored.

HDF5 takes 0.1 to 0.2 ms for a write, and a frequency needs about forty writes. Consecutive frequencies are therefore
stored together, each quantity in one write.  A kill loses only results that `store` has not yet written.
"""

import json
from typing import NamedTuple

import numpy as np

from .file import DatabaseError, steps_text
from .integrity import MARK, ROWS, checks_crc, crc, has_checksums
from .rows import estimate_of, mark_whole_rows, places_on
from .schema import CELL_AXES, CHECKS, LIMITS, NEEDS_MOTION, QUANTITIES


class Solved(NamedTuple):
    """One frequency ready to be stored.

    place : index of the row; columns : indices of the headings; values : {name: array}
    errors : estimated errors, {name: array}; checks : {name: largest violation}; seconds : {step: wall time, s}
    """

    place: int
    columns: list
    values: dict
    errors: dict
    checks: dict
    seconds: dict


class Storing:
    """Results of solved frequencies that wait to be stored in the open file of `rows.writing`."""

    def __init__(self, file):
        self.file, self.waiting, self.opened = file, [], Opened(file)
        there, estimated = set(file), set(file.get("estimated_error", ()))
        self.shapes = {name: file[name].shape for name in QUANTITIES if name in there and name not in LIMITS}
        self.errors = {name: file[estimate_of(name)].dtype for name in self.shapes if name in estimated}
        self.axes = {axis: file[axis][()] for axis in ("omega", "wave_direction")}
        self.headings = {}

    def add(self, omega, headings, result):
        """Add the results of one frequency, which `store` stores.

        omega : rad/s; headings : (m,) rad, the order of the heading axis in `result`
        result : dictionary from `solve_frequency`: {name: array}, with "checks", "estimated_error" and "wall_time"
        Raises DatabaseError, and adds nothing, if a value has the wrong shape or is not finite.
        """
        (i,) = places_on(self.axes, [omega], "omega")
        key = tuple(headings)
        if key not in self.headings:
            self.headings[key] = places_on(self.axes, headings, "wave_direction")
        columns = self.headings[key]
        values, errors, given = {}, {}, result.get("estimated_error", {})
        for name in (name for name in self.shapes if name in result):
            by_heading = "wave_direction" in CELL_AXES[name]
            shape = ((len(columns),) if by_heading else ()) + self.shapes[name][2 if by_heading else 1 :]
            values[name] = checked(name, result[name], shape, f"omega = {omega:.6g} rad/s")
            if name in self.errors:
                kind = self.errors[name]
                error = np.asarray(given.get(name, np.full(shape, np.nan)), float)
                errors[name] = np.minimum(error, np.finfo(kind).max).astype(kind)
        self.waiting.append(Solved(i, columns, values, errors, result.get("checks", {}), result.get("wall_time", {})))

    def store(self):
        """Store and mark all added results, each frequency once"""
        rows, self.waiting = sorted(self.waiting, key=lambda row: row.place), []
        if rows:
            _append(self.file, self.opened, rows)


class Opened(dict):
    """{name: dataset} of a file, each looked up once: h5py takes 0.05 ms to find one, as long as to write to it"""

    def __init__(self, file):
        super().__init__()
        self.file = file

    def __missing__(self, name):
        self[name] = self.file[name]
        return self[name]


def append(file, omega, headings, result):
    """Store the results of one frequency, then mark it; arguments and errors as in `Storing.add`.

    file : from `rows.writing`
    """
    storing = Storing(file)
    storing.add(omega, headings, result)
    storing.store()


def _append(file, opened, rows):
    """Store `Solved` frequencies in ascending order, then mark them; opened : `Opened` of the file"""
    sealed = has_checksums(file)
    names = [name for name in QUANTITIES if any(name in row.values for row in rows)]
    marks = {}
    for name in names:
        having = [row for row in rows if name in row.values]
        put(opened[name], name, [(row, row.values[name]) for row in having])
        if name in having[0].errors:
            put(opened[estimate_of(name)], name, [(row, row.errors[name]) for row in having])
        marks[name] = [(row, _mark(row, name, sealed)) for row in having]
    _append_checks(opened, rows, sealed)
    # motions before quantities derived from them: a run killed between the two would else recompute those from stored
    # motions, without their estimated errors
    free = [name for name in names if name in NEEDS_MOTION]
    for group in (free, [name for name in names if name not in NEEDS_MOTION]):
        file.flush()
        for name in group:
            put(opened[f"stored/{name}"], name, marks[name])
    mark_whole_rows(opened)
    file.flush()


def _mark(row, name, sealed):
    """Marks of the cells of a row: checksums, or 1 in a file without them"""
    parts = [row.values[name], *([row.errors[name]] if name in row.errors else [])]
    if len(CELL_AXES[name]) > 1:
        return np.array([crc(*cell) if sealed else 1 for cell in zip(*parts, strict=True)], MARK)
    return np.array(crc(*parts) if sealed else 1, MARK)


def _append_checks(opened, rows, sealed):
    """The largest violation of each check of a frequency, and its summed wall times"""
    low, high = rows[0].place, rows[-1].place + 1  # rows between these are rewritten as they were read
    checks = {name: opened[f"checks/{name}"][low:high] for name in CHECKS}
    texts = opened["wall_time"][low:high]
    sums = opened[ROWS][low:high] if sealed else None
    for row in rows:
        i = row.place - low
        for name in (name for name in CHECKS if name in row.checks):
            checks[name][i] = np.fmax(checks[name][i], row.checks[name])
        seconds = dict(json.loads(texts[i]))
        for step, value in row.seconds.items():
            seconds[step] = round(seconds.get(step, 0.0) + float(value), 6)
        texts[i] = steps_text(seconds)
        if sums is not None:
            sums[i] = checks_crc({name: values[i] for name, values in checks.items()}, bytes(texts[i]))
    for name, values in checks.items():
        opened[f"checks/{name}"][low:high] = values
    opened["wall_time"][low:high] = texts
    if sums is not None:
        opened[ROWS][low:high] = sums


def put(dataset, name, rows):
    """Write (row, value) pairs of a quantity, in ascending order of rows; consecutive rows need one write"""
    every = list(range(dataset.shape[1])) if len(CELL_AXES[name]) > 1 else None
    if every is not None and any(row.columns != every for row, _ in rows):
        for row, value in rows:
            for column, part in zip(row.columns, value, strict=True):
                dataset[row.place, column] = part
        return
    places = np.array([row.place for row, _ in rows])
    for run in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(places) > 1) + 1):
        first = places[run[0]]
        dataset[first : first + len(run)] = np.stack([rows[i][1] for i in run])


def append_limit(file, name, value):
    """Store an added-mass limit (6, 6); entries may be infinite, none NaN."""
    value = checked(name, value, file[name].shape, "the limit", infinite=True)
    file[name][...] = value
    file.flush()
    file["stored"][name][...] = crc(value) if has_checksums(file) else 1
    file.flush()


def checked(name, value, shape, where, infinite=False):
    """A value as an array of its quantity's type.  Raises DatabaseError unless it has that shape and is finite."""
    kind = QUANTITIES[name][2]
    if kind is float and np.iscomplexobj(value):
        raise DatabaseError(f"{name} at {where} is complex, its type is real")
    value = np.asarray(value, kind)
    if value.shape != shape:
        raise DatabaseError(f"{name} at {where} has shape {value.shape}; allowed: {shape}")
    if np.isnan(value).any() or not (infinite or np.isfinite(value).all()):
        raise DatabaseError(f"{name} at {where} is not finite")
    return value
