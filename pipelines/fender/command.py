"""`hakobune fender`: the result as tables, and a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

Size = Annotated[float | None, Parameter(allow_leading_hyphen=True)]


def fender(
    *,
    family: Annotated[str | None, Parameter(help="cell, v, h, cone, foam, tyre, pneumatic")] = None,
    table: Annotated[
        str | None, Parameter(help="CSV of the manufacturer with columns strain or deflection_m, reaction_kN, …")
    ] = None,
    height: Annotated[float, Parameter(help="height, m; diameter for a pneumatic fender", allow_leading_hyphen=True)],
    length: Annotated[
        float | None, Parameter(help="length of a v, h or pneumatic fender, m", allow_leading_hyphen=True)
    ] = None,
    rated_reaction: Annotated[float | None, Parameter(help="kN", allow_leading_hyphen=True)] = None,
    pressure: Annotated[
        float | None, Parameter(help="initial pressure of a pneumatic fender, kPa [50]", allow_leading_hyphen=True)
    ] = None,
    overload: Annotated[
        float | None, Parameter(help="stiffness beyond the table, kN/m", allow_leading_hyphen=True)
    ] = None,
    count: Annotated[int, Parameter(help="side by side", allow_leading_hyphen=True)] = 1,
    causes: Annotated[str | None, Parameter(help="causes of variation, such as temperature,velocity [all]")] = None,
    dolphin: Annotated[
        float | None, Parameter(help="stiffness of the dolphin behind the fender, kN/m", allow_leading_hyphen=True)
    ] = None,
    angle: Annotated[
        float, Parameter(help="inclination of the pressing face, degrees", allow_leading_hyphen=True)
    ] = 0.0,
    width: Annotated[
        float | None, Parameter(help="width of the inclined face, m [length]", allow_leading_hyphen=True)
    ] = None,
    strain: Annotated[
        float | None, Parameter(help="deflection over height, such as 0.35", allow_leading_hyphen=True)
    ] = None,
    deflection: Annotated[float | None, Parameter(help="m", allow_leading_hyphen=True)] = None,
    energy: Annotated[float | None, Parameter(help="energy to absorb, kJ", allow_leading_hyphen=True)] = None,
    output: Annotated[Path | None, Parameter(help="result, .h5 or .csv")] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute reaction and energy of a fender over its compression, its unloading, softest and stiffest; lengths in m.

    Under a face inclined by --angle over --width, the deflection is that of the most compressed edge; factors on the
    upright fender are shown beside it. hakobune fender --family cell --height 2 --energy 900 hakobune fender --family
    cell --height 2 --angle 8 --width 2.4 --energy 900 --plot fender.png
    """
    from ..common.fender_tables import FenderTable
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, finish, write_result
    from .result import fender

    given = {"family": family, "table": table, "length": length, "rated_reaction": rated_reaction}
    given |= {"pressure": pressure, "overload": overload, "count": count, "dolphin": dolphin}
    given |= {"angle_deg": angle, "width": width, "causes": causes and causes.split(",")}
    check_picture(plot, PLOTS)
    check_result(output, "fender", [table] if table else ())
    joules = None if energy is None else 1e3 * energy
    result = fender(FenderTable(height=height, **given), strain=strain, deflection=deflection, energy=joules)
    return finish(result, (output, write_result), (plot, _draw))


def _draw(result, path):
    """Reaction and energy over the deflection, between softest and stiffest"""
    import numpy as np
    from matplotlib.figure import Figure

    from ..common.picture import save
    from ..common.units import KN

    pair, bands, at, straight = result.detail
    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axis = figure.add_subplot()
    x = np.linspace(0.0, pair.limit, 400)
    low, high = (one.loading(x) / KN for one in bands)
    axis.fill_between(x, low, high, alpha=0.15, label="softest to stiffest")
    axis.plot(x, pair.loading(x) / KN, label="loading")
    if np.any(pair.unloading(x) < pair.loading(x) * (1 - 1e-9)):
        axis.plot(x, pair.unloading(x) / KN, "--", label="unloading")
    axis.axvline(pair.rated * pair.height, color="grey", linewidth=0.8)
    axis.annotate("rated", (pair.rated * pair.height, 0), rotation=90, va="bottom", ha="right", color="grey")
    right = axis.twinx()
    right.plot(x, pair.energy(x) / KN, color="tab:green", label="energy")
    if straight is not None:
        axis.plot(x, straight.loading(x) / KN, ":", color="tab:blue", label="loading, not inclined")
        right.plot(x, straight.loading.integral(x) / KN, ":", color="tab:green", label="energy, not inclined")
    if at is not None:
        axis.plot([at], [float(pair.loading(at)) / KN], "o", color="black")
        right.plot([at], [float(pair.energy(at)) / KN], "o", color="tab:green")
    axis.set(xlabel="deflection, m", ylabel="reaction, kN", title=pair.name, xlim=(0, None), ylim=(0, None))
    right.set(ylabel="energy, kJ", ylim=(0, None))
    handles = [*axis.get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
    axis.legend(handles=handles, loc="upper left")
    save(figure, path, 110)
