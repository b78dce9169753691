"""`hakobune waves`: the result as tables, and its map as a picture or as points."""

from __future__ import annotations

import math

import numpy as np

from ..common.outputs import DATABASE, check_ending
from ..common.picture import PLOTS, check_picture
from ..results.tables import printed
from .result import waves as found


def waves(database, period, omega, heading, fixed, width, at, output, plot):
    """Print the waves around a database's body; draw them to `plot`, and write points of the map to `output`.

    heading : degrees; at : texts x,y m; returns the exit status; raises ValueError, one line
    """
    if output is not None:
        from hakobune.bem.database.file import check_place

        from ..results.output import check_result

        check_ending(output, (".csv", *DATABASE))
        if output.suffix.lower() in DATABASE:
            check_result(output, "waves", [database])
        check_place(output)
    if plot is not None:
        check_picture(plot, PLOTS)
    spots = [_spot(text) for text in at]
    result = found(
        database, period=period, omega=omega, heading=math.radians(heading), fixed=fixed, width=width, at=spots
    )
    if output is not None:
        _write(output, result)
    if plot is not None:
        from .picture import draw

        draw(plot, result.detail)
    status = printed(result)
    for path in (path for path in (output, plot) if path is not None):
        print(path)
    return status


def _spot(text):
    from ..scene.scene import numbers

    values = numbers("--at", text)
    if not (isinstance(values, list) and len(values) == 2 and np.all(np.isfinite(values))):
        raise ValueError(f"--at is {text!r}; allowed: x,y in m")
    return values


def _write(output, result):
    if output.suffix.lower() in DATABASE:
        result.write(output)
    else:
        from hakobune.meshing.whole_files import write_whole

        x, y = (grid.ravel() for grid in np.meshgrid(result.detail.x, result.detail.y))
        value = result["map"].ravel()
        rows = np.column_stack([x, y, value.real, value.imag])[~np.isnan(value)].tolist()
        lines = ["x_m,y_m,elevation_real,elevation_imag", *(",".join(map(repr, row)) for row in rows)]
        write_whole(output, "\n".join(lines).encode() + b"\n")
