"""`hakobune members`: the result as tables, and a picture of the forces over the wave."""

import numpy as np

from ..common.picture import PLOTS, check_picture, save
from ..common.units import KN
from ..results.tables import printed
from .result import ALL, IN_WATER
from .result import members as found

COLOUR = {IN_WATER: "grey", ALL: "black"}


def members(path, plot):
    """Print a study of members, draw it to `plot`; returns the exit status.  Raises ValueError, one line."""
    check_picture(plot, PLOTS)
    result = found(path)
    if plot is not None:
        _draw(result, plot)
    status = printed(result)
    if plot is not None:
        print(plot)
    return status


def _draw(result, path):
    """Force over the phase of each member in the water and of all together"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axis = figure.add_subplot()
    degrees, size = np.degrees(result.labels["phase"].values), np.linalg.norm(result["course.force"], axis=2) / KN
    for k, name in enumerate(result.labels["member"].values):
        if name in COLOUR:
            axis.plot(degrees, size[:, k], COLOUR[name], linewidth=2, label=name)
        elif not name.endswith(", wind"):
            style = ("-", (0, (4, 4)))[k % 2]  # piles side by side have the same force: dashes show both
            axis.plot(degrees, size[:, k], linestyle=style, label=name)
    axis.set(xlabel="phase, °; 0: crest at the origin", ylabel="force, kN", xlim=(0, 360), ylim=(0, None))
    axis.set_xticks(range(0, 361, 45))
    axis.grid(alpha=0.3)
    axis.legend()
    save(figure, path, 110)
