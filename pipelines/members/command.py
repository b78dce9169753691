"""`hakobune members`: the result as tables, and a picture of the forces over the wave."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def members(
    study: Annotated[Path, Parameter(help="members, water, wave, current, wind (TOML)")],
    /,
    *,
    output: Annotated[Path | None, Parameter(help="result, .h5 or .csv")] = None,
    plot: Annotated[Path | None, Parameter(help="forces over the wave: .png, .svg or .pdf")] = None,
):
    """Compute water and wind loads on slender members, piles and frames over a regular wave.

    It uses Morison's formula and includes marine growth.  hakobune members members_dolphin.toml --plot forces.png
    """
    from ..common.picture import PLOTS, check_picture
    from ..results.output import check_result, finish, write_result
    from .result import members

    check_picture(plot, PLOTS)
    check_result(output, "members", [study])
    return finish(members(study), (output, write_result), (plot, _draw))


def _draw(result, path):
    """Force over the phase of each member in the water and of all together"""
    import numpy as np
    from matplotlib.figure import Figure

    from ..common.picture import save
    from ..common.units import KN
    from .result import ALL, IN_WATER

    colours = {IN_WATER: "grey", ALL: "black"}
    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axis = figure.add_subplot()
    degrees, size = np.degrees(result.labels["phase"].values), np.linalg.norm(result["course.force"], axis=2) / KN
    for k, name in enumerate(result.labels["member"].values):
        if name in colours:
            axis.plot(degrees, size[:, k], colours[name], linewidth=2, label=name)
        elif not name.endswith(", wind"):
            style = ("-", (0, (4, 4)))[k % 2]  # piles side by side have the same force: dashes show both
            axis.plot(degrees, size[:, k], linestyle=style, label=name)
    axis.set(xlabel="phase, °; 0: crest at the origin", ylabel="force, kN", xlim=(0, 360), ylim=(0, None))
    axis.set_xticks(range(0, 361, 45))
    axis.grid(alpha=0.3)
    axis.legend()
    save(figure, path, 110)
