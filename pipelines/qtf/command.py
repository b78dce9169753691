"""`hakobune qtf`: forces of wave pairs on a database's body at the difference or the sum of their frequencies."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def qtf(
    database: Annotated[Path, Parameter(help="database of a body; a floating body needs its inertia")],
    /,
    *,
    omega: Annotated[str | None, Parameter(help="frequencies at even steps, rad/s, start:stop:count")] = None,
    heading: Annotated[str | None, Parameter(help="headings to which waves travel, degrees; all pairs of them")] = None,
    difference: Annotated[float | None, Parameter(help="largest difference, rad/s", allow_leading_hyphen=True)] = None,
    sums: Annotated[
        bool, Parameter(name="--sum", negative=(), help="forces at the sum of frequencies instead of the difference")
    ] = False,
    highest: Annotated[float | None, Parameter(help="largest sum, rad/s", allow_leading_hyphen=True)] = None,
    fixed: Annotated[bool, Parameter(negative=(), help="the body is fixed instead of floating")] = False,
    moored: Annotated[Path | None, Parameter(help="mooring study whose lines hold the floating body")] = None,
    level: Annotated[
        str | None, Parameter(help="body, full (with the free-surface forcing) or auto [body; full with --sum]")
    ] = None,
    method: Annotated[str, Parameter(help="panel, contour (vertical cylinders) or auto")] = "auto",
    fresh: Annotated[bool, Parameter(negative=(), help="compute again what is stored")] = False,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute slow forces of pairs of waves (QTF) and store them in the database.

    These forces include the products of first-order quantities, bound long waves and the moving hull. --level full adds
    the forcing of the surface around the body; otherwise its size is estimated.  Response studies and simulations
    use them by qtf = "body" or "full".  Differences are stored one by one, from the smallest on: an interrupted run
    continues, and a larger --difference adds to what is stored.  The body is solved on its panels, a vertical cylinder
    by the contour method.

    --sum computes forces at the sum of frequencies (ringing, springing), up to the highest sum whose waves the panels
    resolve, with the forcing of the surface.
    """
    import numpy as np

    from hakobune.bem.database import open_database

    from ..common.picture import PLOTS, check_picture
    from ..results.output import finish
    from .question import listed
    from .result import qtf as found

    check_picture(plot, PLOTS)
    if (difference if sums else highest) is not None:
        wrong, right = ("--difference", "without") if sums else ("--highest", "with")
        raise ValueError(f"{wrong} is given; it can be used {right} --sum only")
    db = open_database(database)
    result = found(
        db, omega=None if omega is None else listed("--omega", omega), highest=highest if sums else difference,
        headings=None if heading is None else np.radians(listed("--heading", heading)), sums=sums, fixed=fixed,
        moored=moored, level=level, method=method, fresh=fresh,
    )  # fmt: skip

    def drawn(result, path):
        from .plot import draw

        draw(result.detail, db, path)

    return finish(result, (plot, drawn))
