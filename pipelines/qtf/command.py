"""`hakobune qtf`: forces of pairs of waves of a database's body at the difference or the sum of their frequencies."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def qtf(
    database: Annotated[Path, Parameter(help="database of a body, with its inertia if it floats")],
    /,
    *,
    omega: Annotated[str | None, Parameter(help="rad/s at even steps, start:stop:count, in the stored band")] = None,
    heading: Annotated[
        str | None, Parameter(help="degrees, directions the waves travel to; all pairs are computed")
    ] = None,
    difference: Annotated[float | None, Parameter(help="rad/s, the largest", allow_leading_hyphen=True)] = None,
    sums: Annotated[
        bool, Parameter(name="--sum", negative=(), help="forces at the sums of frequencies instead of the differences")
    ] = False,
    highest: Annotated[float | None, Parameter(help="rad/s, the largest sum", allow_leading_hyphen=True)] = None,
    fixed: Annotated[bool, Parameter(negative=(), help="for the body held fixed, instead of floating")] = False,
    moored: Annotated[Path | None, Parameter(help="mooring study whose lines hold the floating body")] = None,
    level: Annotated[
        str | None, Parameter(help="body, full (with the surface's forcing) or auto; body, of sums full")
    ] = None,
    method: Annotated[str, Parameter(help="panel, contour (vertical cylinders) or auto")] = "auto",
    fresh: Annotated[bool, Parameter(negative=(), help="compute again, even if stored")] = False,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Slow forces of pairs of waves: squares of the first order, bound long waves, the moving hull and, with
    --level full, the forcing of the surface around it, whose size is estimated where it is left out.

    They go into the database as differences are done, from the smallest on, for qtf = "body" or "full" of response
    studies and simulations.  A run that was ended goes on from them when it is given again, and a larger --difference
    adds to them.  The body is solved on its panels, a vertical cylinder by the contour method.  What is stored there
    already is told and drawn again.

    With --sum the forces that ring and spring are solved, up to the highest sum whose waves the panels carry, with the
    forcing of the surface, which is a large part of them.
    """
    import numpy as np

    from hakobune.bem.database import open_database

    from ..common.picture import PLOTS, check_picture
    from ..results.tables import printed
    from .question import listed
    from .result import qtf as found

    check_picture(plot, PLOTS)
    if (difference if sums else highest) is not None:
        wrong, right = ("--difference", "without") if sums else ("--highest", "with")
        raise ValueError(f"{wrong} is given; it is for use {right} --sum")
    db = open_database(database)
    result = found(
        db, omega=None if omega is None else listed("--omega", omega), highest=highest if sums else difference,
        headings=None if heading is None else np.radians(listed("--heading", heading)), sums=sums, fixed=fixed,
        moored=moored, level=level, method=method, fresh=fresh,
    )  # fmt: skip
    if plot is not None:
        from .plot import draw

        draw(result.detail.forces, db, result.detail.held.floats, plot)
    status = printed(result)
    if plot is not None:
        print(plot)
    return status
