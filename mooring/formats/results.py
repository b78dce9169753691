"""Results in HDF5 under the names MoorDyn's users know: one dataset per channel beside `Time`, each with its unit.

    FairTen1, AnchTen1    tension at end b (fairlead) and end a (anchor) of line 1, N
    Point3PX … Point3PZ   place of point 3, m
    Body1PX … Body1PZ, Body1Roll, Body1Pitch, Body1Yaw   m and degrees
    L1N0PX …              node 0 of line 1, from end a, where nodes are stored
Numbers count from 1 in the order of the file; the group `names` says which line, point and body they are.
"""

from __future__ import annotations

import contextlib
from pathlib import Path

import numpy as np

from .fault import FormatError

SCHEMA = "hakobune channels 1"


def channels_of_rest(state):
    """{channel: (value, unit)} of a SystemEquilibrium."""
    made = {}
    for i, (fair, anchor) in enumerate(zip(state.lines.tension_b, state.lines.tension_a, strict=True), 1):
        made[f"FairTen{i}"], made[f"AnchTen{i}"] = (fair, "N"), (anchor, "N")
    for i, place in enumerate(state.points, 1):
        made |= {f"Point{i}P{axis}": (value, "m") for axis, value in zip("XYZ", place, strict=True)}
    for i, position in enumerate(state.position, 1):
        made |= {f"Body{i}P{axis}": (value, "m") for axis, value in zip("XYZ", position[:3], strict=True)}
        turns = zip(("Roll", "Pitch", "Yaw"), np.degrees(position[3:]), strict=True)
        made |= {f"Body{i}{axis}": (value, "deg") for axis, value in turns}
    return made


def channels_of_line(result, line=1):
    """{channel: (values, unit)} of a `mooring.lines.dynamics.simulation.Result`, without its frames."""
    fair, anchor = np.linalg.norm(result.force_fairlead, axis=1), np.linalg.norm(result.force_anchor, axis=1)
    return {f"FairTen{line}": (fair, "N"), f"AnchTen{line}": (anchor, "N")}


def write_channels(path, time, channels, names=None, frames=None, attributes=None):
    """Write channels to an HDF5 file, replacing a file of the same kind.

    time : (n,) s; channels : {name: ((n,) or one value, unit)}; names : {"lines": […], "points": […], "bodies": […]}
    frames : (frame time (f,), nodes (f, k, 3) m) of line 1; attributes : {name: value} of the file
    raises : FormatError for channels of another length, or a file of another kind in the way
    """
    import h5py

    from hakobune.bem.database.file import beside, check_place

    path, time = Path(path), np.atleast_1d(np.asarray(time, float))
    check_place(path)
    if path.exists() and not is_channels(path):
        raise FormatError(f"{path} is not a file of channels and is not replaced; give another name")
    with beside(path) as file:
        file.attrs.update({**(attributes or {}), "schema": SCHEMA})
        _put(file, "Time", time, "s")
        for name, (value, unit) in channels.items():
            value = np.atleast_1d(np.asarray(value, float))
            if value.shape != time.shape:
                raise FormatError(f"channel {name} has {value.size} values; allowed: {time.size}, one for each time")
            _put(file, name, value, unit)
        for kind, list_of in (names or {}).items():
            file.create_dataset(f"names/{kind}", data=list(list_of), dtype=h5py.string_dtype())
        if frames is not None:
            _put(file, "frames/Time", frames[0], "s")
            _put(file, "frames/Line1", frames[1], "m")


def _put(file, name, value, unit):
    file.create_dataset(name, data=np.asarray(value, float)).attrs["units"] = unit


def is_channels(path):
    """Whether a file holds channels written here.  Raises ValueError for one that is damaged."""
    from hakobune.bem.database.results import has_schema

    return has_schema(path, SCHEMA)


def read_channels(path):
    """{channel: (n,) values} of a file, `Time` among them.  Raises FormatError, also for a file that is damaged."""
    import h5py

    with _opened(path) as file:
        return {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}


def read_frames(path):
    """(f,) s and (f, k, 3) m of a file of channels.  Raises FormatError where it has none, or is damaged."""
    with _opened(path) as file:
        if "frames" not in file:
            raise FormatError(f"{path} holds no frames; store them with the run")
        return file["frames/Time"][()], file["frames/Line1"][()]


@contextlib.contextmanager
def _opened(path):
    from hakobune.bem.database.integrity import DatabaseError
    from hakobune.bem.database.results import opened_result

    try:
        with opened_result(path, SCHEMA) as file:
            yield file
    except DatabaseError as error:
        raise FormatError(str(error)) from None
