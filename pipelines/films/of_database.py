"""One period of regular waves as a film: the moving body, and its scattered and radiated waves."""

import math
from typing import NamedTuple

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.studies.waves_around import around_body, frequency, half_width, mapped, remarks

from .gif import HULL, check_film, new_plotter, write_film

FRAMES = 30  # frames per period
POINTS = 81  # points along a side of the surface
STEEPNESS = 1 / 30  # height over length, by default
FREEBOARD = 0.5  # freeboard over draft where it is unknown
MOST = 0.5  # rad, of a turn of the body


class Coloured(NamedTuple):
    """pressure : on the panels of the full hull, (n,) complex, Pa per m; most : largest pressure, Pa per m"""

    pressure: np.ndarray
    most: float


def film_of_database(path, output, period=None, omega=None, heading=180.0, height=None, fixed=False, field=None):
    """Write the film; returns the number of frames.

    height : wave height, crest to trough, m; field : "pressure" colours the panels
    raises : ValueError, with a message of one line
    """
    check_film(output, (path,))
    if field not in (None, "pressure"):
        raise ValueError(f"--field is {field!r}; allowed: pressure")
    if height is not None and not 0 < height < np.inf:
        raise ValueError(f"--height is {height:g} m; allowed: above 0, finite")
    db = open_database(path)
    given = None if height is None else height / 2
    around = around_body(db, frequency(period, omega), math.radians(heading), fixed, given)
    amplitude = _amplitude(around, height)
    coloured = None if field is None else _pressure(db, path, around)
    write_film(output, _frames(db, around, amplitude, coloured), FRAMES)
    return FRAMES, list(remarks(around, db, given))


def _amplitude(around, height):
    """m.  Raises ValueError."""
    amplitude = (2 * np.pi / around.k * STEEPNESS if height is None else height) / 2
    angle = 0.0 if around.motion is None else float(np.abs(around.motion[3:]).max())
    if angle * amplitude > MOST:
        if height is None:
            return MOST / angle
        raise ValueError(
            f"--height is {height:g} m, and in such waves the body turns by {math.degrees(angle * amplitude):.0f}°; "
            f"allowed here: up to {2 * MOST / angle:.2g} m"
        )
    return amplitude


def _pressure(db, path, around):
    """`Coloured` of the stored wave.  Raises ValueError if it is not stored."""
    db.require("pressure")
    turned = (db.wave_direction - around.beta + np.pi) % (2 * np.pi) - np.pi
    i, j = int(np.argmin(np.abs(db.omega - around.omega))), int(np.argmin(np.abs(turned)))
    if abs(db.omega[i] - around.omega) > 1e-6 * around.omega or abs(turned[j]) > 1e-6:
        raise ValueError(
            f"the pressure is stored at {db.omega[i]:.6g} rad/s towards {math.degrees(db.wave_direction[j]):.4g}° and "
            f"for other waves in {path}; give one of these waves, or add yours with the command that made the file"
        )
    if (db.inertia_matrix is None) != (around.motion is None):
        raise ValueError("the stored pressure belongs to a freely floating body; leave out --fixed")
    value = db["pressure"][i, j]
    return Coloured(value, float(np.abs(value).max()))


def _frames(db, around, amplitude, coloured):
    """Pictures, (height, width, 3) each"""
    import pyvista

    whole = db.mesh.whole()
    center = np.asarray(db.reader.rotation_center)
    half = half_width(around, None)
    found = mapped(around, half, POINTS)
    still = np.nan_to_num(found.elevation) * amplitude
    x, y = np.meshgrid(found.x, found.y)
    plotter = new_plotter()
    sea = pyvista.StructuredGrid(*(grid[..., None] for grid in (x, y, np.zeros_like(x))))
    order = np.arange(x.size).reshape(x.shape).ravel(order="F")  # order of points in VTK
    hull = pyvista.PolyData.from_regular_faces(whole.points, whole.corners)
    parts = [hull] + ([_topsides(around, db.mesh.draft)] if around.pierces else [])
    rests = [part.points - center for part in parts]
    colours = {"color": HULL}
    if coloured is not None:
        most = amplitude * coloured.most / 1e3
        hull.cell_data["kPa"] = np.zeros(len(whole.corners))
        colours = {"scalars": "kPa", "clim": (-most, most), "cmap": "RdBu_r"}
    plotter.add_mesh(hull, **colours)
    for part in parts[1:]:
        plotter.add_mesh(part, color=HULL)
    sea["m"] = np.zeros(x.size)
    swing = float(np.abs(still).max())
    opaque, low = (1.0, 0.9) if coloured is None else (0.25, 0.45)
    style = {"cmap": "ocean", "clim": (-1.6 * swing, 1.6 * swing), "show_scalar_bar": False, "smooth_shading": True}
    plotter.add_mesh(sea, scalars="m", opacity=opaque, specular=0.3, **style)
    plotter.camera_position = [(0.7 * half, -1.6 * half, low * half), (*around.middle, 0), (0, 0, 1)]
    size = f"{2 * amplitude:.3g} m high, {2 * np.pi / around.omega:.3g} s, towards {math.degrees(around.beta):.4g} deg"
    label = plotter.add_text("", font_size=9, color="black")
    try:
        for frame in range(FRAMES):
            phase = np.exp(-2j * np.pi * frame / FRAMES)
            moved = np.zeros(6) if around.motion is None else (around.motion * amplitude * phase).real
            R = rotation(*moved[3:])
            for part, rest in zip(parts, rests, strict=True):
                part.points = center + moved[:3] + rest @ R.T
            if coloured is not None:
                hull.cell_data["kPa"] = (coloured.pressure * phase).real * amplitude / 1e3
            height = (still * phase).real.ravel()[order]
            sea.points = np.column_stack([x.ravel()[order], y.ravel()[order], height])
            sea["m"] = height
            label.set_text("upper_left", f"waves {size}: {frame / FRAMES:.2f} of the period")
            plotter.render()
            yield plotter.screenshot(return_img=True)
    finally:
        plotter.close()


def _topsides(around, draft):
    """Sides and deck above the waterline of a hull with unknown topsides"""
    import pyvista

    plan = around.sources.plan + around.middle
    outline = pyvista.PolyData(np.column_stack([plan, np.zeros(len(plan))]), faces=[len(plan), *range(len(plan))])
    return outline.extrude((0, 0, FREEBOARD * draft), capping=True)
