"""`hakobune damping`: linear and quadratic damping from a record of a forced oscillation or of a free decay."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def damping(
    record: Annotated[
        Path,
        Parameter(
            help="CSV with time_s and motion_m, and force_kN if the motion is forced; or with motion_deg and moment_kNm"
        ),
    ],
    /,
    *,
    mass: Annotated[
        float | None,
        Parameter(
            help="mass with added mass, t (t m² for a rotation); needed for a decay without --database",
            allow_leading_hyphen=True,
        ),
    ] = None,
    database: Annotated[
        Path | None,
        Parameter(
            help="database of the body: it gives the mass, and its wave damping is taken out of the printed keys"
        ),
    ] = None,
    motion: Annotated[str | None, Parameter(help='name of the recorded motion, such as "roll", for --database')] = None,
    output: Annotated[Path | None, Parameter(help="result, .h5 or .csv")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Find linear and quadratic damping of a body from a record: forced oscillation or free decay.

    With force_kN (reaction of the water on a body in sinusoidal motion) it finds B1, B2 and added mass. Without, the
    record is a free decay: a and b of its extinction, and with --mass B1 and B2. B1 contains the damping by waves,
    which a study has from its database: --database and --motion subtract it, of a decay with the other motions free,
    and give the mass. Leave out the first swings after the release, which hold other motions too.
    """
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, finish, write_result
    from .result import damping

    check_picture(plot, PLOTS)
    check_result(output, "damping", [record, *([database] if database else [])])
    result = damping(record, mass=None if mass is None else 1e3 * mass, database=database, motion=motion)
    return finish(result, (output, write_result), (plot, _draw))


def _draw(result, path):
    """The record and the curve fitted to it"""
    from matplotlib.figure import Figure

    from ..common.picture import save

    what, size = ("force", 1e3) if "record.force" in result else ("motion", 1.0)
    unit = ("k" if what == "force" else "") + result.quantity(f"record.{what}").unit
    time = result.labels["time"].values
    figure = Figure(figsize=(9.0, 4.5), layout="constrained")
    axis = figure.add_subplot()
    axis.plot(time, result[f"record.{what}"] / size, ".", markersize=2.5, color="0.5", label="record")
    axis.plot(time, result[f"fitted.{what}"] / size, linewidth=1.0, label="fitted")
    axis.set(xlabel="time, s", ylabel=f"{result.quantity(f'record.{what}').description}, {unit}")
    axis.grid(alpha=0.3)
    axis.legend()
    save(figure, path, 110)
