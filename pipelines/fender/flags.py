"""The flags of `hakobune fender`.  Heavy imports happen inside."""

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
    height: Annotated[
        float, Parameter(help="m, height; of a pneumatic fender its diameter", allow_leading_hyphen=True)
    ],
    length: Annotated[float | None, Parameter(help="m, of v, h, pneumatic", allow_leading_hyphen=True)] = None,
    rated_reaction: Annotated[float | None, Parameter(help="kN", allow_leading_hyphen=True)] = None,
    pressure: Annotated[
        float | None, Parameter(help="kPa, initial pressure of a pneumatic fender [50]", allow_leading_hyphen=True)
    ] = None,
    overload: Annotated[float | None, Parameter(help="kN/m beyond the table", allow_leading_hyphen=True)] = None,
    count: Annotated[int, Parameter(help="side by side", allow_leading_hyphen=True)] = 1,
    causes: Annotated[str | None, Parameter(help="causes of variation, such as temperature,velocity [all]")] = None,
    dolphin: Annotated[
        float | None, Parameter(help="kN/m, stiffness of the dolphin behind it", allow_leading_hyphen=True)
    ] = None,
    angle: Annotated[
        float, Parameter(help="degrees, inclination of the pressing face", allow_leading_hyphen=True)
    ] = 0.0,
    width: Annotated[
        float | None, Parameter(help="m, width of the inclined face [length]", allow_leading_hyphen=True)
    ] = None,
    strain: Annotated[
        float | None, Parameter(help="deflection over height, such as 0.35", allow_leading_hyphen=True)
    ] = None,
    deflection: Annotated[float | None, Parameter(help="m", allow_leading_hyphen=True)] = None,
    energy: Annotated[float | None, Parameter(help="kJ, energy to absorb", allow_leading_hyphen=True)] = None,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Compute reaction and energy of a fender over its compression, its unloading, softest and stiffest; lengths in m.

    Under a face inclined by --angle over --width, the deflection is that of the most compressed edge; factors on the
    upright fender are shown beside it. hakobune fender --family cell --height 2 --energy 900 hakobune fender --family
    cell --height 2 --angle 8 --width 2.4 --energy 900 --plot fender.png
    """
    from ..common.fender_tables import FenderTable
    from .command import fender

    given = {"family": family, "table": table, "length": length, "rated_reaction": rated_reaction}
    given |= {"pressure": pressure, "overload": overload, "count": count, "dolphin": dolphin}
    given |= {"angle_deg": angle, "width": width, "causes": causes and causes.split(",")}
    return fender(FenderTable(height=height, **given), strain, deflection, energy, plot)
