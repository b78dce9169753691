"""A run of a body at a single point as a film: the slewing hull, hawsers, and the buoy on its lines.

Lines have their static shape under the buoy, which is drawn at the height in the study. The surface is flat, since the
file contains neither the height of the buoy over time nor the waves.
"""

import tomllib

import numpy as np

from hakobune.mooring.lines.system.bodies import rotation

from ..results.file import read
from ..single_point.study import system_of
from ..single_point.tables import make_study
from .gif import check_film, write_film
from .of_run import check_times
from .stage import POINTS, Hull, Stage, frames, moved

FRAMES = 150  # frames of a film without a given step


def film_of_single_point(path, output, start=None, length=None, step=None):
    """Write the film, by default of the whole run in FRAMES frames; returns their number.  Raises ValueError."""
    check_film(output, (path,))
    found = read(path, "single-point")
    if "run.place" not in found:
        raise ValueError(f"{path} has no run in time; give [slewing] in its study")
    time = found.labels["time"].values
    length = float(time[-1] - time[0]) if length is None else length
    step = length / FRAMES if step is None else step
    check_times(time, start, length, step)
    start = float(time[0]) if start is None else start
    at = np.arange(start, min(start + length, time[-1]) + 1e-9, step)
    names = ("place", "heading_in_time", "wave_motion", "buoy")
    place, heading, wave, buoy = (_at(found[f"run.{name}"], time, at) for name in names)
    study = make_study(tomllib.loads(found.provenance["study"]))
    motion = wave.copy()
    motion[:, :2] += place
    motion[:, 5] += heading
    buoys = np.column_stack([buoy, np.full(len(at), study.buoy.z)])
    system, _ = system_of(study, float(found["water.depth"]), float(found["water.density"]))
    stage = _stage(found, _lines(system, buoys[0]))
    ends = np.column_stack([found["hawser.end"], np.full(len(found["hawser.end"]), study.attachment.z)])

    def threads(i):
        made_fast = motion[i, :3] + ends @ rotation(*motion[i, 3:]).T
        hawsers = [buoys[i] + (end - buoys[i]) * np.linspace(0, 1, POINTS)[:, None] for end in made_fast]
        return np.concatenate([*_lines(system, buoys[i]), *hawsers])

    write_film(output, frames(stage, at, moved(np.zeros(3), motion), threads, buoys=buoys), len(at))
    return len(at)


def _at(values, time, at):
    """Values of a record (t, …) at times (n,); shape (n, …)"""
    flat = values.reshape(len(time), -1)
    return np.column_stack([np.interp(at, time, column) for column in flat.T]).reshape(len(at), *values.shape[1:])


def _stage(found, lines):
    length, beam, draft, freeboard = found["hull.size"]
    x, y = found["hull.middle"]
    box = (x - length / 2, x + length / 2, y - beam / 2, y + beam / 2, -draft, freeboard)
    places = np.concatenate([*lines, [[-1.5 * length] * 3, [1.5 * length] * 3]])[:, :2]
    return Stage((Hull(box, np.zeros(3)),), float(np.ptp(places, axis=0).max()), float(found["water.depth"]))


def _lines(system, buoy):
    from hakobune.mooring.lines.system.equilibrium import held_at, rest
    from hakobune.mooring.lines.system.shapes import line_shapes

    pose = (*map(float, buoy), 0.0, 0.0, 0.0)
    return line_shapes(rest(held_at(system, {"buoy": pose})), POINTS)
