"""A minute of a simulation as a film of body, lines, fenders and waves.

The body follows its stored motion, lines hang in their static shape at every frame, the surface is that of the
undisturbed waves of the seed.
"""

from __future__ import annotations

import tomllib
import warnings
from types import SimpleNamespace

import numpy as np

from mooring.lines.system.bodies import rotation

from ..moor.study import make_study
from ..simulate.file import opened, whole_rows
from ..simulate.study import plan_of
from .gif import BED, HULL, SEA, check_count, check_film, new_plotter, write_film

GRID, WIDTH = 50, 1.6  # points and width of the surface, the width in spans of the lines
POINTS = 40  # of a line
FENDER = "#c07020"


def film_of_run(path, output, seed=None, start=None, length=60.0, step=1.0):
    """Write a film of `length` s from `start` s on, one frame every `step` s; returns the number of frames.

    seed : whose record is stored, by default the first
    start : by default half a length before the largest tension, or deflection where there are no lines
    raises : ValueError, one line
    """
    check_film(output, (path,))
    with opened(path) as file:
        row = _row(file, seed)
        time = file["time"][()]
        _check_times(time, start, length, step)
        if start is None:
            start = _height_of_it(file, row, time) - 0.5 * length
        start = min(max(start, time[0]), max(time[-1] - length, time[0]))
        at = np.arange(start, min(start + length, time[-1]) + 1e-9, step)
        motion = np.column_stack([np.interp(at, time, column) for column in file["motion"][row].T])
        scene = _scene(file)
        waves = _waves(file, int(file["seed"][row]))
    write_film(output, _frames(scene, at, motion, waves), len(at))
    return len(at)


def _height_of_it(file, row, time):
    """s of the largest tension; without lines of the largest deflection of a fender"""
    held = file["tension" if len(file["line"]) else "deflection"][row]
    return time[int(np.argmax(held.max(axis=1)))]


def _check_times(time, start, length, step):
    """Raise ValueError unless there are frames enough, from a time of the record on."""
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
    """System, sizes of the hull and rotation centre"""
    study = make_study(tomllib.loads(file.attrs["study"]))
    length, beam, draft, freeboard = file.attrs["hull"]
    hull = study.hull_of({"length": length, "beam": beam, "draft": draft})
    center = file.attrs["rotation_center"]
    system = study.system(hull, center, file.attrs["density"], file.attrs["gravity"])
    box = (-length / 2, length / 2, -beam / 2, beam / 2, -draft, freeboard)
    lines = 0 if system is None else len(system.lines)
    ropes = file["anchor"][lines:], file["fairlead"][lines:] - center
    fenders = study.berth(hull, center).fenders
    places = np.concatenate([file["anchor"][:, :2], [[-length, -beam], [length, beam]]])
    span, depth = np.ptp(places, axis=0).max(), float(file.attrs["water_depth"])
    return SimpleNamespace(
        system=system, ropes=ropes, lines=lines, fenders=fenders, box=box, center=center, span=span, depth=depth
    )  # fmt: skip


def _waves(file, seed):
    """Components of the undisturbed waves of a seed, wavenumbers and the s that their time runs ahead

    None where the database is no longer there, or there are no waves
    """
    from bem.database import open_database
    from bem.waves import wavenumber
    from mooring.motion.simulation import wave_components

    try:
        reader = open_database(file.attrs["database"]).reader
    except ValueError:
        return None
    plan = plan_of(make_study(tomllib.loads(file.attrs["study"])), reader.omega, None, float(file.attrs["duration"]))
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")  # told when the run was made
        parts = wave_components(SimpleNamespace(reader=reader), plan.weather, plan.settings, seed)
    if parts is None:
        return None
    k = wavenumber(parts.omega, float(file.attrs["water_depth"]), float(file.attrs["gravity"]))
    return parts, k, plan.settings.ramp


def surface(waves, x, y):
    """Function of t (s) → elevation (n,) m at x, y (n,) m:  Re Σ a exp{i(k·x + ε − ωt)}

    waves : of `_waves`.  What does not change in time is made once, a hundred times cheaper than records of points.
    """
    parts, k, ahead = waves
    along = np.multiply.outer(x, np.cos(parts.direction)) + np.multiply.outer(y, np.sin(parts.direction))
    still = parts.amplitude * np.exp(1j * (k * along + parts.phase))
    return lambda t: (still @ np.exp(-1j * parts.omega * (t + ahead))).real


def _shapes(scene, motion):
    """(lines × POINTS, 3) m of lines, and of ropes as straight, with the body displaced by `motion` (6,)"""
    from mooring.lines.system.equilibrium import held_at, rest
    from mooring.lines.system.shapes import line_shapes

    bollards, arms = scene.ropes
    ends = scene.center + motion[:3] + arms @ rotation(*motion[3:]).T
    straight = [a + (b - a) * np.linspace(0, 1, POINTS)[:, None] for a, b in zip(bollards, ends, strict=True)]
    if scene.system is None:
        return np.concatenate([np.empty((0, 3)), *straight])
    body = scene.system.bodies[0]
    pose = tuple(float(a + b) for a, b in zip(body.position, motion, strict=True))
    return np.concatenate([*line_shapes(rest(held_at(scene.system, {body.name: pose})), POINTS), *straight])


def _fender(one):
    """A fender as a cylinder from its face outwards, as long and as wide as it is high"""
    import pyvista

    height = one.fender.height
    middle = one.face + 0.5 * height * one.normal
    return pyvista.Cylinder(center=middle, direction=one.normal, radius=0.5 * height, height=height)


def _frames(scene, at, motion, waves):
    """Pictures, (height, width, 3) each"""
    import pyvista

    plotter = new_plotter()
    hull = pyvista.Box(scene.box).triangulate()
    still = hull.points - scene.center
    count = scene.lines + len(scene.ropes[0])
    cells = np.column_stack([np.full(count, POINTS), np.arange(count * POINTS).reshape(count, POINTS)]).ravel()
    lines = pyvista.PolyData(_shapes(scene, motion[0]), lines=cells) if count else None
    side = np.linspace(-0.5, 0.5, GRID) * WIDTH * scene.span
    x, y = (grid.ravel() for grid in np.meshgrid(side, side, indexing="ij"))
    sea = pyvista.StructuredGrid(*(grid.reshape(GRID, GRID, 1) for grid in (x, y, np.zeros_like(x))))
    bed = pyvista.Plane(center=(0, 0, -scene.depth), i_size=WIDTH * scene.span, j_size=WIDTH * scene.span)
    plotter.add_mesh(bed, color=BED)
    plotter.add_mesh(sea, color=SEA, opacity=0.45)
    plotter.add_mesh(hull, color=HULL)
    if lines is not None:
        plotter.add_mesh(lines, color="#202020", line_width=2)
    for one in scene.fenders:
        plotter.add_mesh(_fender(one), color=FENDER)
    plotter.camera_position = [(0.25 * scene.span, -1.0 * scene.span, 0.4 * scene.span), (0, 0, 0), (0, 0, 1)]
    heights = None if waves is None else surface(waves, *sea.points[:, :2].T)
    label = plotter.add_text("", font_size=9, color="black")
    try:
        for t, moved in zip(at, motion, strict=True):
            hull.points = scene.center + moved[:3] + still @ rotation(*moved[3:]).T
            if lines is not None:
                lines.points = _shapes(scene, moved)
            if heights is not None:
                sea.points = np.column_stack([*sea.points[:, :2].T, heights(t)])
            label.set_text("upper_left", f"{t:.1f} s")
            plotter.render()
            yield plotter.screenshot(return_img=True)
    finally:
        plotter.close()
