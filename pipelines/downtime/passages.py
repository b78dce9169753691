"""Passing ships, from a list of their times, distances and speeds: the largest forces on the moored ship in each hour.

Under a rigid surface forces are proportional to the square of the speed. A few distances are therefore computed once,
with log-linear interpolation between them.
"""

import msgspec
import numpy as np

from hakobune.mooring.downtime.files import read_columns

from ..common.quantities import StudyError
from ..passing.result import passing
from ..passing.study import read_study
from .study import record_of
from .tables import PASSING

DISTANCES = 8


def record_with_passages(read, folder, depth):
    """The `study.Record` of a DowntimeStudy, with columns of the passages of ships where the study has any.  Raises
    StudyError."""
    record, table = record_of(read.hindcast, folder, depth), read.passages
    if table is None:
        return record
    study, _ = read_study(folder / table.study)
    if study.track.current:
        raise StudyError(
            f"passages.study has track.current = {study.track.current:g}; allowed: 0, since speeds are through "
            f"the water"
        )
    wanted = {table.distance: "level", table.speed: "speed"}
    moments, found, _ = read_columns(folder / table.file, table.time, read.hindcast.zone, wanted)
    distance, speed = found[table.distance], found[table.speed]
    if not (np.all(distance > 0) and np.all(speed > 0)):
        raise StudyError(f"{table.file}: a distance or a speed is missing or 0; allowed: above 0, m and m/s")
    force = _forces(study, distance) * ((speed / study.track.speed) ** 2)[:, None]
    hindcast = record.hindcast
    slot = np.floor((moments - hindcast.time[0]).astype(float) / hindcast.step).astype(int)
    row = np.searchsorted(hindcast.slot, slot)
    there = (row < len(hindcast.slot)) & (hindcast.slot[np.minimum(row, len(hindcast.slot) - 1)] == slot)
    largest = np.zeros((len(hindcast.time), len(PASSING)))
    np.maximum.at(largest, row[there], force[there])
    said = f"{there.sum()} of {len(there)} passages in {table.file} fall within the hours of the record"
    columns = hindcast.columns | dict(zip(PASSING, largest.T / 1e3, strict=True))
    return record._replace(hindcast=type(hindcast)(hindcast.time, hindcast.step, hindcast.waves, columns,
                                                   (*hindcast.said, said)))  # fmt: skip


def _forces(study, distance):
    """Largest surge, sway and yaw forces, N, N, N m, at the speed of a PassingStudy, at distances (p,), m; shape (p,
    3)"""
    chosen = np.unique(distance)
    if len(chosen) > DISTANCES:
        chosen = np.geomspace(chosen[0], chosen[-1], DISTANCES)
    side = np.sign(study.track.distance)
    each = []
    for one in chosen:
        track = msgspec.structs.replace(study.track, distance=float(side * one))
        each.append(np.abs(passing(msgspec.structs.replace(study, track=track))["largest.force"]))
    lines = np.log(np.maximum(each, 1e-9)).T
    return np.exp([np.interp(np.log(distance), np.log(chosen), line) for line in lines]).T
