"""A picture of curves in panels, as the reports print them."""

from typing import NamedTuple

import numpy as np

from ..common.picture import save

STYLE = {"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"}


class Curve(NamedTuple):
    """label; x, y : (n,); style : style of matplotlib's `plot`"""

    label: str
    x: np.ndarray
    y: np.ndarray
    style: dict | None = None


class Panel(NamedTuple):
    """title; curves : [Curve]; levels : where lines lie across; axes : words of matplotlib's `Axes.set`"""

    title: str
    curves: list
    levels: tuple = ()
    axes: dict | None = None


def draw(path, title, panels, columns, size=(3.6, 3.0), shared=True):
    """Write a picture; returns its path

    panels : [Panel], row by row, `columns` in a row; size : inches of a panel; shared : True for one legend above all
    panels, False for a legend in each
    """
    import matplotlib
    from matplotlib.figure import Figure

    rows = -(-len(panels) // columns)
    with matplotlib.rc_context(STYLE):
        width, height = size[0] * columns, size[1] * rows + 0.9
        figure = Figure(figsize=(width, height))
        grid = figure.subplots(rows, columns, squeeze=False, gridspec_kw=_margins(rows, columns, width, height))
        for axis, panel in zip(grid.flat, panels, strict=False):
            _fill(axis, panel)
            if not shared and axis.get_legend_handles_labels()[0]:
                axis.legend(fontsize=7)
        for axis in grid.flat[len(panels) :]:
            axis.set_axis_off()
        shown = [axis.get_legend_handles_labels() for axis in grid.flat]
        named = {words: line for lines, texts in shown for line, words in zip(lines, texts, strict=True)}
        if shared and named:
            figure.legend(named.values(), named, ncols=8, loc="lower center", frameon=False)
        figure.text(0.1 / width, 1 - 0.1 / height, title, ha="left", va="top", fontsize=11)
        save(figure, path, 110)
    return path


def _margins(rows, columns, width, height):
    """Inches around and between panels; matplotlib's own search for them takes longer than all the drawing"""
    side, bottom, top, across, up = 0.65, 0.85, 0.6, 0.6, 0.75
    between = {"wspace": across / ((width - side - 0.15 - across * (columns - 1)) / columns)}
    between |= {"hspace": up / ((height - bottom - top - up * (rows - 1)) / rows)}
    return {
        "left": side / width,
        "right": 1 - 0.15 / width,
        "bottom": bottom / height,
        "top": 1 - top / height,
        **between,
    }


def _fill(axis, panel):
    if not panel.curves:
        axis.set_axis_off()
    for curve in panel.curves:
        axis.plot(
            curve.x, curve.y, label=curve.label or None, **{"linewidth": 1.2, "markersize": 4, **(curve.style or {})}
        )
    for level in panel.levels:
        axis.axhline(level, color="0.5", linewidth=0.9, linestyle=":")
    axis.set(title=panel.title, **(panel.axes or {}))
    if "xticks" in (panel.axes or {}):  # on a logarithmic axis plain numbers, and none between
        axis.set_xticks(panel.axes["xticks"], [f"{x:g}" for x in panel.axes["xticks"]])
        axis.minorticks_off()
    axis.grid(True, color="0.9", linewidth=0.6)
