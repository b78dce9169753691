"""`hakobune waves`: the result as tables, and its map as a picture or as points."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def waves(
    database: Annotated[Path, Parameter(help="database of the body, .h5")],
    /,
    *,
    period: Annotated[float | None, Parameter(help="period of the waves, s")] = None,
    omega: Annotated[float | None, Parameter(help="frequency of the waves, rad/s, in place of the period")] = None,
    heading: Annotated[
        float, Parameter(help="direction that the waves travel to, degrees", allow_leading_hyphen=True)
    ] = 180.0,
    fixed: Annotated[bool, Parameter(help="hold the body fixed", negative="")] = False,
    width: Annotated[float | None, Parameter(help="m, of the map")] = None,
    at: Annotated[
        tuple[str, ...], Parameter(help="point x,y in m at which the wave is printed", allow_leading_hyphen=True)
    ] = (),
    output: Annotated[Path | None, Parameter(help="points of the map, .csv, or all results, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="map: .png, .svg or .pdf")] = None,
):
    """Compute the water around a body in regular waves, with the waves that it scatters and radiates.

    hakobune waves box.h5 --period 9 --heading 180 --plot waves.png
    """
    import math

    from hakobune.bem.database.file import check_place

    from ..common.outputs import DATABASE, check_ending
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, finish
    from .result import waves

    if output is not None:
        check_ending(output, (".csv", *DATABASE))
        if output.suffix.lower() in DATABASE:
            check_result(output, "waves", [database])
        check_place(output)
    check_picture(plot, PLOTS)
    spots = [_spot(text) for text in at]
    result = waves(
        database, period=period, omega=omega, heading=math.radians(heading), fixed=fixed, width=width, at=spots
    )
    return finish(result, (output, _write), (plot, _draw))


def _draw(result, path):
    from .picture import draw

    draw(path, result.detail)


def _spot(text):
    """[x, y] m of a text "x,y".  Raises ValueError."""
    import numpy as np

    from ..scene.scene import numbers

    values = numbers("--at", text)
    if not (isinstance(values, list) and len(values) == 2 and np.all(np.isfinite(values))):
        raise ValueError(f"--at is {text!r}; allowed: x,y in m")
    return values


def _write(result, output):
    """The points of the map as CSV, or the whole result"""
    import numpy as np

    from ..common.outputs import DATABASE

    if output.suffix.lower() in DATABASE:
        result.write(output)
    else:
        from hakobune.meshing.whole_files import write_whole

        x, y = (grid.ravel() for grid in np.meshgrid(result.detail.x, result.detail.y))
        value = result["map"].ravel()
        rows = np.column_stack([x, y, value.real, value.imag])[~np.isnan(value)].tolist()
        lines = ["x_m,y_m,elevation_real,elevation_imag", *(",".join(map(repr, row)) for row in rows)]
        write_whole(output, "\n".join(lines).encode() + b"\n")
