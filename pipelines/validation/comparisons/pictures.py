"""Pictures of comparisons: grids of curves over ξ_B or L/B."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem import DOFS

from ...common.picture import save
from ...view.plots import heading_colors
from .report_units import PAIRS, QUIET, Results, lag

SPAN, SHOWN = 1e2, 1e4  # ratio of positive values from which on an axis is logarithmic, and the most it shows
NAMES = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
MOTION_UNITS = ("x_a/ζ_a", "y_a/ζ_a", "z_a/ζ_a", "φ_a/kζ_a", "θ_a/kζ_a", "ψ_a/kζ_a")
FORCE_UNITS = tuple(f"F{i}" for i in range(1, 7))
XI = "ξ_B = ω²B/2g"
FEW = 20  # frequencies up to which each is marked


class Curve(NamedTuple):
    """A case in a picture; style : of matplotlib's `plot`"""

    results: Results
    label: str
    style: dict


def curves(shown, checks=(), strips=()):
    """`Curve` of cases: `shown` in colours from dark to light, `checks` as points, `strips` dashed.

    each : (results, label)
    """
    colored = zip(shown, heading_colors(len(shown)), strict=True)
    return [
        *(Curve(r, label, {"color": color}) for (r, label), color in colored),
        *(Curve(r, label, {"color": "C3", "marker": "x", "linestyle": ""}) for r, label in checks),
        *(Curve(r, label, {"color": "0.2", "linestyle": (0, (4, 2))}) for r, label in strips),
    ]


def coefficient_picture(path, lines, letter, title):
    """Ten coefficients A or B over ξ_B"""
    with _figure(path, 2, 5, (15, 6.2), title) as (figure, grid):
        for axis, pair in zip(grid.flat, PAIRS, strict=True):
            values = [line.results.coefficient(letter + pair) for line in lines]
            largest = max(np.abs(value).max() for value in values)
            for line, value in zip(lines, values, strict=True):
                if np.abs(value).max() > QUIET * largest:
                    _plot(axis, line.results.xi, value, line)
            first, second = (NAMES[int(digit) - 1] for digit in pair)
            axis.set_title(f"{letter}{pair}  {first if first == second else f'{first} by {second}'}")
            _scale(axis)
        _labels(grid, XI)
        _legend(figure, lines)
    return path


def wave_picture(path, lines, kind, shown, title, rows):
    """Forces or motions over ξ_B: a row for each heading, a column for each mode.

    kind : forces or motions; shown : amplitude, logarithm (of the amplitude) or phase
    rows : {χ degrees: what stands at the left of its row}
    """
    with _figure(path, len(rows), 6, (17, 0.8 + 2.2 * len(rows)), title) as (figure, grid):
        for axes, (chi, words) in zip(grid, rows.items(), strict=True):
            for d, axis in enumerate(axes):
                _wave_panel(axis, lines, kind, shown, chi, d)
            box = axes[0].get_position()
            figure.text(0.12 / figure.get_figwidth(), (box.y0 + box.y1) / 2, words, rotation=90, va="center")
        units = FORCE_UNITS if kind == "forces" else MOTION_UNITS
        for axis, dof, unit in zip(grid[0], DOFS, units, strict=True):
            axis.set_title(f"{dof}, ε in degrees" if shown == "phase" else f"{dof}, {unit}")
        _labels(grid, XI)
        _legend(figure, lines)
    return path


def _wave_panel(axis, lines, kind, shown, chi, mode):
    for line in lines:
        r, heading = line.results, line.results.heading(chi)
        if r.driven(kind)[heading, mode]:
            values = getattr(r, kind)[:, heading, mode]
            _plot(axis, r.xi, _unbroken(lag(values)) if shown == "phase" else np.abs(values), line)
    if not axis.lines:
        axis.set_axis_off()
        axis.text(0.5, 0.5, "zero by symmetry", transform=axis.transAxes, ha="center", color="0.5")
    elif shown == "phase":
        axis.set(ylim=(-190, 190), yticks=(-180, -90, 0, 90, 180))
    else:
        _scale(axis, shown == "logarithm")


def ratio_picture(path, xi, length_beam, ratios, title):
    """Three-dimensional over two-dimensional coefficients over L/B.

    xi : (n,); length_beam : (l,); ratios : {name: (l, n)} in the order of the report's figures
    """
    with _figure(path, 3, 3, (13, 9.5), title) as (figure, grid):
        colors = heading_colors(len(xi))
        for axis, (name, values) in zip(grid.flat, ratios.items(), strict=True):
            for j, color in enumerate(colors):
                axis.plot(length_beam, values[:, j], ".-", color=color, linewidth=1.1, label=f"{xi[j]:g}")
            axis.axhline(1, color="0.4", linewidth=0.8)
            axis.set_title(name)
            axis.set_xscale("log", base=2)
            axis.set_xticks(length_beam, [f"{ratio:g}" for ratio in length_beam])
            axis.set_ylim(0, min(2.5, 1.05 * max(1.2, np.nanmax(values))))
        _labels(grid, "L/B")
        named = grid[0, 0].get_lines()[: len(xi) : -(-len(xi) // 10)]
        figure.legend(handles=named, title="ξ_B", ncols=len(named), loc="upper right", frameon=False)
    return path


def drift_picture(path, models, title, components):
    """Mean drift over ξ_B: a row for each model.

    models : {name: [Curve]}; components : [(place, χ degrees, title)]
    """
    with _figure(path, len(models), len(components), (14, 0.8 + 2.6 * len(models)), title) as (figure, grid):
        for axes, (name, lines) in zip(grid, models.items(), strict=True):
            for axis, (part, chi, words) in zip(axes, components, strict=True):
                for line in lines:
                    _plot(axis, line.results.xi, line.results.drift[:, line.results.heading(chi), part], line)
                axis.axhline(0, color="0.6", linewidth=0.6)
                axis.set_title(f"{name}, {words}")
        _labels(grid, XI)
        _legend(figure, next(iter(models.values())))
    return path


def roll_picture(path, models, title):
    """Roll in beam waves of several heights: a panel for each model, `models` as in `drift_picture`"""
    with _figure(path, 1, len(models), (11, 4.2), title) as (_, grid):
        for axis, (name, lines) in zip(grid.flat, models.items(), strict=True):
            for line in lines:
                values = line.results.motions[:, line.results.heading(90), 3]
                _plot(axis, line.results.xi, np.abs(values), line)
            axis.set_title(name)
            axis.set_ylabel("φ_a/kζ_a")
            axis.set_ylim(bottom=0)
            axis.legend(frameon=False)
        _labels(grid, XI)
    return path


def _places(rows, columns, width, height):
    """Margins in inches around and between axes; matplotlib's own search for them takes as long as all the drawing"""
    left, right, bottom, top, between, above = 0.75, 0.15, 0.5, 0.7, 0.5, 0.5
    across = (width - left - right - between * (columns - 1)) / columns
    up = (height - bottom - top - above * (rows - 1)) / rows
    edges = {"left": left / width, "right": 1 - right / width, "bottom": bottom / height, "top": 1 - top / height}
    return {**edges, "wspace": between / across, "hspace": above / up}


class _figure:
    """A grid of axes that is saved at the end"""

    def __init__(self, path, rows, columns, size, title):
        import matplotlib
        from matplotlib.figure import Figure

        self.path = path
        self.style = matplotlib.rc_context({"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"})
        self.style.__enter__()
        self.figure = Figure(figsize=size)
        self.grid = self.figure.subplots(rows, columns, squeeze=False, gridspec_kw=_places(rows, columns, *size))
        self.figure.text(0.12 / size[0], 1 - 0.1 / size[1], title, ha="left", va="top", fontsize=11)

    def __enter__(self):
        return self.figure, self.grid

    def __exit__(self, kind, *rest):
        try:
            if kind is None:
                for axis in self.grid.flat:
                    axis.grid(True, color="0.9", linewidth=0.6)
                    axis.spines[["top", "right"]].set_visible(False)
                save(self.figure, self.path, 110)
        finally:
            self.style.__exit__(None, None, None)


def _plot(axis, x, y, line):
    few = {"marker": "."} if len(x) <= FEW else {}
    axis.plot(x, y, label=line.label, **{"linewidth": 1.2, "markersize": 4, **few, **line.style})


def _scale(axis, logarithm=None):
    """Logarithmic if asked for, or if nobody says and the values span decades; else from zero if they are positive"""
    values = np.concatenate([line.get_ydata() for line in axis.lines])
    if logarithm or (logarithm is None and values.min() > 0 and values.max() > SPAN * values.min()):
        axis.set_yscale("log")
        axis.set_ylim(bottom=max(axis.get_ylim()[0], values.max() / SHOWN))
    elif values.min() >= 0:
        axis.set_ylim(bottom=0)


def _unbroken(degrees):
    """Without the vertical strokes where a phase passes 180°"""
    degrees = degrees.copy()
    degrees[1:][np.abs(np.diff(degrees)) > 180] = np.nan
    return degrees


def _labels(grid, words):
    for axis in grid[-1]:
        axis.set_xlabel(words)


def _legend(figure, lines):
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], label=line.label, **line.style) for line in lines]
    figure.legend(handles=handles, ncols=len(handles), loc="upper right", frameon=False)
