"""The flags of `hakobune waves`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def waves(
    database: Annotated[Path, Parameter(help="database of the body, .h5")],
    /,
    *,
    period: Annotated[float | None, Parameter(help="s, of the waves")] = None,
    omega: Annotated[float | None, Parameter(help="rad/s, in place of the period")] = None,
    heading: Annotated[float, Parameter(help="degrees, direction they travel to", allow_leading_hyphen=True)] = 180.0,
    fixed: Annotated[bool, Parameter(help="the body is held", negative="")] = False,
    width: Annotated[float | None, Parameter(help="m, of the map")] = None,
    at: Annotated[
        tuple[str, ...], Parameter(help="m, x,y of a point at which the wave is printed", allow_leading_hyphen=True)
    ] = (),
    output: Annotated[Path | None, Parameter(help="points of the map, .csv, or all results, .h5")] = None,
    plot: Annotated[Path | None, Parameter(help="map: .png, .svg or .pdf")] = None,
):
    """Compute the water around a body in regular waves, with the waves that it scatters and radiates.

    hakobune waves box.h5 --period 9 --heading 180 --plot waves.png
    """
    from .command import waves

    return waves(database, period, omega, heading, fixed, width, at, output, plot)
