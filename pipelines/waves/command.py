"""`hakobune waves`: how high the water stands around a body in regular waves."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.bounds import told
from ..printing.verdict import tell

POINTS = 161  # of a side of the map
SPANS, LENGTHS = 1.5, 1.5  # half the map's width, in lengths of the body or wave lengths, whichever is more
MISSED = 0.02  # share of the far field that the sources may miss without a word
A_POINT = 4e-6  # s, with 60 sources


class Map(NamedTuple):
    """x, y (n,) m; elevation (n, n) complex, m per m, by y and x, nan in the body; around : `WavesAround`"""

    x: np.ndarray
    y: np.ndarray
    elevation: np.ndarray
    around: object


def waves(database, period, omega, heading, fixed, width, at, output):
    """Tell, and draw to `output` or write its points, the waves around a database's body; 0.  Raises ValueError."""
    from hakobune.bem.database import open_database

    from ..common.outputs import check_ending
    from ..common.picture import PLOTS
    from ..printing.console import new_console

    if output is not None:
        from hakobune.bem.database.file import check_place

        check_ending(output, (*PLOTS, ".csv"))
        check_place(output)
    spots = [_spot(text) for text in at]
    db = open_database(database)
    around = around_body(db, frequency(period, omega), math.radians(heading), fixed)
    half = half_width(around, width)
    told(f"{POINTS**2} points take", POINTS**2 * len(around.sources.points) / 60 * A_POINT)
    found = mapped(around, half, POINTS)
    if output is not None:
        _write(output, found, db.mesh.name)
    console = new_console()
    console.print(_summary(found))
    if spots:
        console.print(_told(around, spots))
    status = tell(remarks(around, db), console, "note: ")
    if output is not None:
        print(output)
    return status


def frequency(period, omega):
    """rad/s of the one that is given.  Raises ValueError."""
    if (period is None) == (omega is None):
        raise ValueError("give --period in s or --omega in rad/s, one of the two")
    value = omega if period is None else period
    if not (0 < value < np.inf):
        raise ValueError(f"--{'omega' if period is None else 'period'} is {value:g}; allowed: above 0, finite")
    return omega if period is None else 2 * np.pi / period


def around_body(db, omega, beta, fixed, amplitude=None):
    """`WavesAround` of a database's body.  Raises ValueError for waves that it does not have, in words of the user.

    amplitude : m, of the waves that its viscous damping is of, None for those of its scene
    """
    from hakobune.bem.database.between_frequencies import KOCHIN
    from hakobune.bem.wave_field.around import waves_around

    if not math.isfinite(beta):
        raise ValueError("--heading is not a number; allowed: degrees")
    db.require(*KOCHIN)
    reader = db.reader
    if amplitude is not None and reader.viscous is not None:
        from hakobune.mooring.response.viscous import in_regular_waves

        reader, _ = in_regular_waves(reader, omega, amplitude, beta)
    return waves_around(reader, omega, beta, fixed)


def half_width(around, width):
    """m, of a map of the width asked for, or one that shows body and waves.  Raises ValueError."""
    span = float(np.ptp(around.sources.plan, axis=0).max())
    if width is None:
        return max(SPANS * span, LENGTHS * 2 * np.pi / around.k)
    if not span < width < 1e3 * span:
        raise ValueError(f"--width is {width:g} m; allowed: from the body's {span:g} m to a thousand times that")
    return width / 2


def mapped(around, half, points):
    """`Map` of a square about the body's middle"""
    side = np.linspace(-half, half, points)
    x, y = side + around.middle[0], side + around.middle[1]
    elevation = around.elevation(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))
    return Map(x, y, elevation.reshape(points, points), around)


def remarks(around, db, amplitude=None):
    """One line each on what the waves leave out or hang on; amplitude : as of `around_body`"""
    if around.motion is not None and db.reader.viscous is not None:
        height = 2 * (db.reader.viscous.wave_amplitude if amplitude is None else amplitude)
        yield f"the body's motion has its viscous damping in waves of {height:.3g} m"
    if around.missed > MISSED:
        yield fails(
            f"the sources in the hull miss {around.missed:.1%} of its far field; allowed: {MISSED:.0%}; take the waves "
            "near it with care, or lower ones"
        )
    if around.pierces:
        yield "waves that decay within a depth or a wave length of the hull are left out; it may be higher there"


def _spot(text):
    from ..scene.scene import numbers

    values = numbers("--at", text)
    if not (isinstance(values, list) and len(values) == 2 and np.all(np.isfinite(values))):
        raise ValueError(f"--at is {text!r}; allowed: x,y in m")
    return values


def _summary(found):
    from rich.table import Table

    around, height = found.around, np.abs(found.elevation)
    state = "held" if around.motion is None else "floating"
    wave = f"{2 * np.pi / around.omega:.4g} s ({around.omega:.4g} rad/s), {2 * np.pi / around.k:.4g} m long"
    table = Table(title=f"waves of {wave}, towards {math.degrees(around.beta):.4g}°, body {state}")
    for name in ("", "height over that of the waves that come", "x m", "y m"):
        table.add_column(name, justify="left" if not name else "right")
    for name, pick in (("highest", np.nanargmax), ("lowest", np.nanargmin)):
        row, column = np.unravel_index(pick(height), height.shape)
        table.add_row(name, f"{height[row, column]:.3f}", f"{found.x[column]:.1f}", f"{found.y[row]:.1f}")
    for name, (x, y) in _sides(around).items():
        table.add_row(name, f"{abs(around.elevation([(x, y)])[0]):.3f}", f"{x + 0.0:.1f}", f"{y + 0.0:.1f}")
    return table


def _sides(around):
    """Places half a length of the body before and behind it, and to its sides as the waves go"""
    way = np.array([math.cos(around.beta), math.sin(around.beta)])
    plan = around.sources.plan
    reach = 0.5 * float(np.ptp(plan, axis=0).max())
    out = {}
    for name, along in {"before it": -way, "behind it": way}.items():
        out[name] = np.round(around.middle + along * (float(np.max(plan @ along)) + reach), 6)
    return out


def _told(around, spots):
    from rich.table import Table

    table = Table(title="at the points asked for")
    for name in ("x m", "y m", "height over that of the waves that come", "phase °"):
        table.add_column(name, justify="right")
    for (x, y), value in zip(spots, around.elevation(spots), strict=True):
        inside = np.isnan(value)
        shown = ("in the body", "") if inside else (f"{abs(value):.3f}", f"{math.degrees(np.angle(value)):.1f}")
        table.add_row(f"{x:g}", f"{y:g}", *shown)
    return table


def _write(output, found, name):
    if output.suffix.lower() != ".csv":
        from .picture import draw

        draw(output, name, found)
        return
    from hakobune.meshing.whole_files import write_whole

    x, y = (grid.ravel() for grid in np.meshgrid(found.x, found.y))
    value = found.elevation.ravel()
    rows = np.column_stack([x, y, value.real, value.imag])[~np.isnan(value)]
    lines = ["x_m,y_m,elevation_real,elevation_imag", *(",".join(f"{part:.7g}" for part in row) for row in rows)]
    write_whole(output, "\n".join(lines).encode() + b"\n")
