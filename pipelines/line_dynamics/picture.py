"""A run of a dynamic line as a picture: the history of its tensions, and a strip of its shapes in the last cycle."""

import numpy as np

from ..common.picture import save
from ..common.units import KN
from ..lines.pictures import line_plane

SHAPES = 8


def draw_run(path, name, line, course, result, found, strength):
    """Draw to a file.

    line : DynamicLine; course : Course; result : Result; found : Figures; strength : Strength
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 9.5), layout="constrained")
    grid = figure.add_gridspec(3, SHAPES // 2, height_ratios=(1.6, 1, 1))
    _history(figure.add_subplot(grid[0, :]), name, result, found, strength)
    _strip(figure, grid, line, course, result)
    save(figure, path, 120)


def _history(axes, name, result, found, strength):
    axes.plot(result.time, result.tension_fairlead / KN, lw=1.2, label="fairlead")
    axes.plot(result.time, result.tension_anchor / KN, lw=1.0, label="anchor")
    top = max(result.tension_fairlead.max(), result.tension_anchor.max())
    if np.isfinite(found.fairlead.quasi_static):
        axes.axhline(
            found.fairlead.quasi_static / KN, color="C0", ls="--", lw=1, label="fairlead, largest quasi-static"
        )
    top = max(top, *_breaking_loads(axes, strength, 1.5 * top)) or KN  # KN for a line without tension
    axes.axvspan(found.begin, found.end, color="0.92", zorder=0, label="evaluated time")
    axes.plot([found.fairlead.time], [found.fairlead.largest / KN], "o", color="C0", ms=5)
    axes.set(xlabel="t, s", ylabel="tension, kN", xlim=(result.time[0], result.time[-1]), ylim=(0, 1.12 * top / KN))
    axes.set_title(name, loc="left")
    axes.grid(alpha=0.3)
    # text above the axes, since the grey span would hide it
    axes.legend(frameon=False, fontsize=8, ncols=6, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)


def _breaking_loads(axes, strength, below):
    """Draw the breaking loads, N, of the segments at both ends that are lower than `below`; yields each, and 0."""
    yield 0.0
    ends = {"fairlead": strength.breaking[-1], "anchor": strength.breaking[0]}
    same = len(set(ends.values())) == 1
    for (end, load), style in zip(ends.items(), ("-", ":"), strict=True):
        if load < below and not (same and end == "anchor"):
            axes.axhline(load / KN, color="C3", lw=1.5, ls=style, label="breaking load" + ("" if same else f", {end}"))
            yield load


def _strip(figure, grid, line, course, result):
    chosen = frames_of_last_cycle(result.frame_time, course.cycle)
    plane = line_plane(result.frames)
    ends = plane[result.frame_time >= result.frame_time[chosen[0]]][:, -1]
    left, right = moving_part(plane)
    first = None
    for place, i in enumerate(chosen):
        axes = figure.add_subplot(grid[1 + place // (SHAPES // 2), place % (SHAPES // 2)], sharex=first, sharey=first)
        first = first or axes
        _bed(axes, line, result.frames[0], left, right)
        axes.plot(*plane[0].T, color="0.75", lw=1)
        axes.plot(*ends.T, color="C1", lw=0.8)
        axes.plot(*plane[i].T, ".-", color="C0", ms=3, lw=1.3)
        axes.plot(*plane[i, -1], "o", color="C1", ms=5)
        for joint in np.cumsum([segment.elements for segment in line.segments])[:-1]:
            axes.plot(*plane[i, joint], "s", color="C3", ms=4)
        axes.set_title(f"{result.frame_time[i]:.2f} s", fontsize=9)
        axes.set(xlabel="along the line at rest, m", ylabel="z, m", xlim=(left, right))
        axes.label_outer()


def frames_of_last_cycle(time, cycle):
    """Indices of eight frames, evenly over the last cycle, or over everything if the motion is not periodic."""
    begin = time[0] if cycle is None else max(time[0], time[-1] - cycle)
    wanted = np.linspace(begin, time[-1], SHAPES, endpoint=cycle is None)
    return np.unique(np.abs(time[:, None] - wanted).argmin(axis=0))


def moving_part(plane):
    """Range (m) in which the line moves, with a margin; plane : (f, k, 2) m"""
    away = np.linalg.norm(plane - plane[0], axis=2).max(axis=0)
    moving = plane[:, away >= 0.05 * away.max(), 0]
    left, right = moving.min(), moving.max()
    margin = 0.1 * (right - left) + 1e-3
    return left - margin, right + margin


def _bed(axes, line, start, left, right):
    """The intersection of the bed with the plane of the picture."""
    if line.bed is None:
        return
    away = start[-1, :2] - start[0, :2]
    size = np.linalg.norm(away)
    heading = away / size if size > 0 else np.array([1.0, 0.0])
    from hakobune.mooring.lines.dynamics.lumped.system import above_bed

    x = np.linspace(left, right, 401)
    under = np.column_stack([line.anchor[:2] + x[:, None] * heading, np.zeros_like(x)])
    for _ in range(10):  # along the normal, which is vertical except for the slope
        under[:, 2] -= above_bed(line.system, under)
    axes.plot(x, under[:, 2], color="0.5", lw=3, zorder=0)
