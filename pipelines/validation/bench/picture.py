"""Work and precision: error over time per frequency, a panel for each body."""

from __future__ import annotations

from ...common.picture import save
from .cases import CASES

STYLES = {
    ("hakobune", "contour"): ("C3", "o"),
    ("hakobune", "panel"): ("C0", "s"),
    ("hakobune", "panel, band"): ("C1", "D"),
    ("capytaine", "direct, graded, 2 planes"): ("C2", "^"),
    ("capytaine", "direct, graded, rotation"): ("C8", "v"),
    ("capytaine", "direct, uniform, 2 planes"): ("0.35", "<"),
    ("capytaine", "direct, graded, 2 planes, Gauss 2"): ("C9", ">"),
    ("capytaine", "indirect, graded, 2 planes"): ("0.6", "d"),
    ("pyhams", "graded, 1 plane"): ("C4", "P"),
    ("pyhams", "uniform, 1 plane"): ("C6", "X"),
}


def draw(path, rows, note):
    """Draw the rows that have an error to `path`; several threads are dashed and open.  `note` stands below."""
    import matplotlib
    from matplotlib.figure import Figure

    shown = [row for row in rows if row.cache == "full" and not row.note]
    cases = [case for case in CASES.values() if any(row.case == case.name for row in shown)]
    columns = min(3, max(1, len(cases)))
    with matplotlib.rc_context({"font.size": 9, "axes.titlesize": 10, "svg.fonttype": "none"}):
        lines = -(-len(cases) // columns) or 1
        figure = Figure(figsize=(5 * columns, 1.6 + 3.9 * lines), layout="constrained")
        grid = figure.subplots(lines, columns, sharex=True, sharey=True, squeeze=False)
        for axis, case in zip(grid.flat, cases, strict=False):
            _curves(axis, [row for row in shown if row.case == case.name])
            axis.set_title(case.title)
        for axis in list(grid.flat)[len(cases) :]:
            axis.set_axis_off()
        for axis in grid[-1]:
            axis.set_xlabel("ms per frequency")
        for axis in grid[:, 0]:
            axis.set_ylabel("largest relative error")
        _legend(figure, shown, columns)
        figure.suptitle(f"Error against time of one frequency: six modes and one heading.  {note}", x=0.01, ha="left")
        save(figure, path, 110)
    return figure


def _curves(axis, rows):
    for key, (color, marker) in STYLES.items():
        for threads in sorted({row.threads for row in rows}):
            mine = sorted(
                (row for row in rows if (row.program, row.settings) == key and row.threads == threads),
                key=lambda row: row.fineness if row.fineness >= 1 else 1 / row.fineness,
            )
            axis.plot(
                [row.warm_ms for row in mine],
                [row.error for row in mine],
                **_style(color, marker, threads),
            )
    axis.set(xscale="log", yscale="log")
    axis.grid(True, color="0.9", linewidth=0.6)
    axis.spines[["top", "right"]].set_visible(False)


def _style(color, marker, threads):
    single = threads == 1
    return {
        "color": color,
        "marker": marker,
        "markersize": 5,
        "linewidth": 1.3,
        "linestyle": "-" if single else "--",
        "markerfacecolor": color if single else "white",
    }


def _legend(figure, rows, columns):
    from matplotlib.lines import Line2D

    there = {(row.program, row.settings) for row in rows}
    handles = [
        Line2D([], [], label=" ".join(key), **_style(color, marker, 1))
        for key, (color, marker) in STYLES.items()
        if key in there
    ]
    for threads in sorted({row.threads for row in rows} - {1}):
        handles.append(Line2D([], [], label=f"dashed: {threads} threads", **_style("0.2", "o", threads)))
    figure.legend(handles=handles, ncols=min(columns + 1, 4), loc="outside lower center", frameon=False)
