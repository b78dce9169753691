"""A picture of curves in panels, as the reports print them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..common.picture import save

STYLE = {"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"}


class Curve(NamedTuple):
    """label; x, y : (n,); style : of matplotlib's `plot`"""

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

    panels : [Panel], row by row, `columns` in a row; size : inches of a panel
    shared : one legend of all panels above them, else each its own
    """
    import matplotlib
    from matplotlib.figure import Figure

    rows = -(-len(panels) // columns)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(size[0] * columns, size[1] * rows + 0.6), layout="constrained")
        grid = figure.subplots(rows, columns, squeeze=False)
        for axis, panel in zip(grid.flat, panels, strict=False):
            _fill(axis, panel)
            if not shared and axis.get_legend_handles_labels()[0]:
                axis.legend(fontsize=7)
        for axis in grid.flat[len(panels) :]:
            axis.set_axis_off()
        shown = [axis.get_legend_handles_labels() for axis in grid.flat]
        named = {words: line for lines, texts in shown for line, words in zip(lines, texts, strict=True)}
        if shared and named:
            figure.legend(named.values(), named, ncols=8, loc="outside lower center", frameon=False)
        figure.suptitle(title, x=0.01, ha="left")
        save(figure, path, 110)
    return path


def _fill(axis, panel):
    for curve in panel.curves:
        axis.plot(
            curve.x, curve.y, label=curve.label or None, **{"linewidth": 1.2, "markersize": 4, **(curve.style or {})}
        )
    for level in panel.levels:
        axis.axhline(level, color="0.5", linewidth=0.9, linestyle=":")
    axis.set(title=panel.title, **(panel.axes or {}))
    axis.grid(True, color="0.9", linewidth=0.6)
