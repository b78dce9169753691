"""Picture of the waves around a body: their height, and their elevation at one moment."""

import math

import numpy as np

from ..common.picture import save

LEVELS = 0.1


def draw(path, found):
    """Write the two maps of a `Map`."""
    import matplotlib
    from matplotlib.figure import Figure

    around = found.around
    height, moment = np.abs(found.elevation), found.elevation.real
    top = max(1.1, math.ceil(np.nanmax(height) / LEVELS) * LEVELS)
    with matplotlib.rc_context({"font.size": 9, "svg.fonttype": "none"}):
        figure = Figure(figsize=(12, 5.6), layout="constrained")
        left, right = figure.subplots(1, 2, sharey=True)
        filled = left.contourf(found.x, found.y, height, np.arange(0, top + LEVELS / 2, LEVELS), cmap="viridis")
        figure.colorbar(filled, ax=left, label="height over incident wave height", shrink=0.8)
        swing = math.ceil(np.nanmax(np.abs(moment)) / LEVELS) * LEVELS
        levels = np.linspace(-swing, swing, 41)
        filled = right.contourf(found.x, found.y, moment, levels, cmap="RdBu_r")
        figure.colorbar(filled, ax=right, label="elevation, m for a wave of 1 m amplitude", shrink=0.8)
        for axis, title in ((left, "height"), (right, "with the crest of the incident wave at the origin")):
            axis.add_patch(matplotlib.patches.Polygon(around.sources.plan + around.middle, color="#404040"))
            axis.set(aspect="equal", xlabel="x  m")
            axis.set_title(title, loc="left", fontsize=9)
            _arrow(axis, around, found)
        left.set_ylabel("y  m")
        state = "held" if around.motion is None else "floating freely"
        figure.suptitle(
            f"body {state}: waves of {2 * np.pi / around.omega:.3g} s, {2 * np.pi / around.k:.3g} m long, "
            f"towards {math.degrees(around.beta):.4g}°",
            x=0.01,
            ha="left",
            fontsize=11,
        )
        save(figure, path, 130)


def _arrow(axis, around, found):
    """The direction of the incident waves"""
    way = np.array([math.cos(around.beta), math.sin(around.beta)])
    half = (found.x[-1] - found.x[0]) / 2
    tip = around.middle - 0.72 * half * way
    axis.annotate(
        "", xy=tip, xytext=tip - 0.22 * half * way, arrowprops={"arrowstyle": "-|>", "lw": 2, "color": "black"}
    )
