"""A minute of a simulation as a film of bodies, lines, fenders and waves.

Bodies follow their stored motion, lines hang in their static shape at every frame, and the surface shows the
undisturbed waves of the seed.
"""

import tomllib
import warnings
from functools import partial
from types import SimpleNamespace

import numpy as np

from hakobune.bem import DOFS
from hakobune.mooring.lines.system.bodies import rotation

from ..moor.study import make_study
from ..results.heard import heard
from ..simulate.file import bodies_of, database_path, opened, whole_rows
from ..simulate.study import plan_of
from .gif import check_count, check_film, write_film
from .stage import POINTS, Hull, Scene, Stage, frames, moved, straight


def film_of_run(path, output, seed=None, start=None, length=60.0, step=1.0):
    """Write a film of `length` s from `start` s on, one frame every `step` s; returns the number of frames.

    seed : a seed with a stored record, by default the first
    start : by default half a length before the largest tension, or the largest deflection without lines
    raises : ValueError, with a message of one line
    """
    check_film(output, (path,))
    with opened(path) as file:
        if any(name.rpartition("__")[2] not in DOFS for name in file["dof"].asstr()[()]):
            raise ValueError(f"{path} is a run of a body that bends; allowed: a run of a rigid body")
        row = _row(file, seed)
        time = file["time"][()]
        check_times(time, start, length, step)
        if start is None:
            start = _height_of_it(file, row, time) - 0.5 * length
        start = min(max(start, time[0]), max(time[-1] - length, time[0]))
        at = np.arange(start, min(start + length, time[-1]) + 1e-9, step)
        motion = np.column_stack([np.interp(at, time, column) for column in file["motion"][row].T])
        if bodies_of(file):
            from .of_several import scene_of_several

            scene = scene_of_several(file)
        else:
            scene = _scene(file)
        waves = _waves(file, int(file["seed"][row]))
    heights = None if waves is None else partial(surface, waves)
    threads = (lambda i: scene.threads(motion[i])) if scene.held else None
    write_film(output, frames(scene.stage, at, scene.poses(motion), threads, heights), len(at))
    return len(at)


def _height_of_it(file, row, time):
    """s of the largest tension; without lines of the largest deflection of a fender"""
    held = file["tension" if len(file["line"]) else "deflection"][row]
    return time[int(np.argmax(held.max(axis=1)))]


def check_times(time, start, length, step):
    """Raise ValueError for too few frames, or a start outside the record."""
    if start is not None and not time[0] <= start <= time[-1]:
        raise ValueError(f"--start is {start:g} s; allowed: {time[0]:g} to {time[-1]:g} s")
    for flag, value in (("length", length), ("step", step)):
        if not 0 < value < np.inf:
            raise ValueError(f"--{flag} is {value:g} s; allowed: above 0, finite")
    check_count(int(min(length, time[-1] - time[0]) / step + 1e-9) + 1)


def _row(file, seed):
    kept = np.flatnonzero(whole_rows(file)[: len(file["kept_seed"])])
    seeds = file["seed"][()][kept].tolist()
    if not seeds:
        raise ValueError(f"{file.filename} has no record of a run; simulate with keep_series above 0")
    if seed is not None and seed not in seeds:
        shown = ", ".join(map(str, seeds[:10])) + (" …" if len(seeds) > 10 else "")
        raise ValueError(f"there is no record of seed {seed}; allowed: {shown}")
    return int(kept[0 if seed is None else seeds.index(seed)])


def _scene(file):
    """`Scene` of one body"""
    study = make_study(tomllib.loads(file.attrs["study"]))
    length, beam, draft, freeboard = file.attrs["hull"]
    hull = study.hull_of({"length": length, "beam": beam, "draft": draft})
    center = file.attrs["rotation_center"]
    system = study.system(hull, center, file.attrs["density"], file.attrs["gravity"], in_time=True)
    box = (-length / 2, length / 2, -beam / 2, beam / 2, -draft, freeboard)
    lines = 0 if system is None else len(system.lines)
    ropes = file["anchor"][lines:], file["fairlead"][lines:] - center
    fenders = study.berth(hull, center).fenders
    places = np.concatenate([file["anchor"][:, :2], [[-length, -beam], [length, beam]]])
    span, depth = np.ptp(places, axis=0).max(), float(file.attrs["water_depth"])
    stage = Stage((Hull(box, center),), span, depth, fenders)
    held = bool(lines + len(ropes[0]))
    return Scene(stage, partial(moved, center), held, partial(_shapes, system, ropes, center))


def _waves(file, seed):
    """Components of the undisturbed waves of a seed, wavenumbers and the time offset of their phases, s

    None without waves, or if the database is no longer there, which a warning says
    """
    from hakobune.bem.database import open_database
    from hakobune.bem.waves import wavenumber
    from hakobune.mooring.motion.simulation import wave_components

    try:
        reader = open_database(database_path(file)).bodies_reader
    except ValueError as error:
        warnings.warn(f"the surface is drawn flat, since waves need the database of the run: {error}", stacklevel=2)
        return None
    study, duration = make_study(tomllib.loads(file.attrs["study"])), float(file.attrs["duration"])
    plan = plan_of(study, reader.omega, None, duration, words=reader.words)
    with heard():  # these warnings were printed during the run
        parts = wave_components(SimpleNamespace(reader=reader), plan.weather, plan.settings, seed)
    if parts is None:
        return None
    k = wavenumber(parts.omega, float(file.attrs["water_depth"]), float(file.attrs["gravity"]))
    return parts, k, plan.settings.ramp


def surface(waves, x, y):
    """Function of t (s) → elevation (n,) m at x, y (n,) m:  Re Σ a exp{i(k·x + ε − ωt)}

    waves : from `_waves`.  Constant factors are computed once, a hundred times faster than records of points.
    """
    parts, k, ahead = waves
    along = np.multiply.outer(x, np.cos(parts.direction)) + np.multiply.outer(y, np.sin(parts.direction))
    still = parts.amplitude * np.exp(1j * (k * along + parts.phase))
    return lambda t: (still @ np.exp(-1j * parts.omega * (t + ahead))).real


def _shapes(system, ropes, center, motion):
    """Points of lines, and of ropes as straight, with the body displaced by `motion` (6,), m; shape (lines × POINTS,
    3)"""
    from hakobune.mooring.lines.system.equilibrium import held_at, rest
    from hakobune.mooring.lines.system.shapes import line_shapes

    bollards, arms = ropes
    ends = center + motion[:3] + arms @ rotation(*motion[3:]).T
    if system is None:
        return straight(bollards, ends)
    body = system.bodies[0]
    pose = tuple(float(a + b) for a, b in zip(body.position, motion, strict=True))
    hanging = line_shapes(rest(held_at(system, {body.name: pose})), POINTS)
    return np.concatenate([*hanging, straight(bollards, ends)])
