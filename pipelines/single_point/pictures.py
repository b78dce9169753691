"""Pictures of a body at a single point: the plan of its rest with wind, current and waves, and a run in time."""

import numpy as np

from hakobune.mooring.single_point.equilibria import bow, preferred
from hakobune.mooring.single_point.history import watch_circle

from ..common.picture import draw_streams, save
from ..common.quantities import direction
from ..common.units import KN
from ..common.weather.seas import sea_with_swell
from ..printing.number import fixed

STILL = 1e-4  # variation over the largest value of a record, or over 1, that counts as rounding
NAMED = 0.15  # place of a name on a line, from its anchor


def draw_plan(study, point, found, path):
    """Write the plan of all Equilibrium of a study as a picture, with the lines of the preferred Equilibrium."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 8), layout="constrained")
    axes = figure.add_subplot()
    best = preferred(found)
    draw_lines(axes, best.lines)
    for one in found:
        stable, chosen = one.slewing.stable, one is best
        colour = "k" if chosen else "tab:green" if stable else "0.6"
        draw_hull(axes, study, point, one.place, one.heading, color=colour, ls="-" if stable else "--",
                  lw=1.8 if chosen else 1.0, label=f"{bow(one):.1f}°, "
                  f"{'stable' if stable else 'not stable'}")  # fmt: skip
        for end in ends_in_space(point, one.place, one.heading):
            axes.plot(*np.stack([end, one.buoy]).T, color=colour, lw=0.8)
    _draw_streams(axes, study)
    s = best.slewing
    state = "stable" if s.stable else "slews" if np.isfinite(s.period) else "turns away"
    period = f", period {s.period:.0f} s" if np.isfinite(s.period) else ""
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal", title=f"{state}{period}, pull {fixed(best.pull / KN, 0)} kN")
    figure.legend(loc="outside lower center", ncols=4, fontsize=8)
    save(figure, path, 150)


def draw_run(study, run, path):
    """Write heading, tensions, plan and the track of the buoy of a run as a picture."""
    from matplotlib.figure import Figure

    r = run.record
    figure = Figure(figsize=(14, 8), layout="constrained")
    grid = figure.add_gridspec(6, 2, width_ratios=[3, 2])
    heading, hawser, lines = (figure.add_subplot(grid[2 * i : 2 * i + 2, 0]) for i in range(3))
    heading.plot(r.time, np.degrees(r.heading + r.wave[:, 5]), lw=0.8)
    heading.axhline(np.degrees(run.steady.heading), color="0.6", lw=0.8, label="of rest")
    heading.legend(fontsize=8)
    heading.set_ylabel("heading, °")
    hawser.plot(r.time, r.hawser / KN, lw=0.8)
    hawser.set_ylabel("hawser, kN" if run.steady.point.lengths[0] else "pull on buoy, kN")
    worst = int(np.argmax(r.lines.max(axis=0)))
    lines.plot(r.time, r.lines[:, worst] / KN, lw=0.8, color="tab:red")
    for axes in (heading, hawser, lines):  # a constant record is drawn as a level line
        low, high = axes.dataLim.intervaly
        least = STILL * max(1.0, abs(low), abs(high))
        if high - low < least:
            axes.set_ylim((low + high) / 2 - least, (low + high) / 2 + least)
    lines.set(ylabel=f"{run.steady.point.system.line_names[worst]}, kN", xlabel="time, s")
    _draw_swing(figure.add_subplot(grid[:4, 1]), study, run)
    _draw_track(figure.add_subplot(grid[4:, 1]), run)
    save(figure, path, 150)


def _draw_swing(axes, study, run):
    """The lines with their anchors, and the hull at its begin and at both ends of its swing"""
    r, point = run.record, run.steady.point
    draw_lines(axes, run.steady.lines)
    shown = dict.fromkeys((0, int(np.argmin(r.heading)), int(np.argmax(r.heading))))
    for at, colour in zip(shown, ("0.6", "tab:blue", "tab:orange"), strict=False):
        draw_hull(axes, study, point, r.place[at], r.heading[at], color=colour, lw=1.2,
                  label=f"hull at {r.time[at]:.0f} s, {np.degrees(r.heading[at]):.1f}°")  # fmt: skip
        for end in ends_in_space(point, r.place[at], r.heading[at]):
            axes.plot(*np.stack([end, r.buoy[at]]).T, color=colour, lw=0.8)
    axes.plot(*r.place.T, "k", lw=0.6, label="track of the centre of mass")
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal", title="hull at its begin and at both ends of its swing")
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _draw_track(axes, run):
    """The track of the buoy about its place without the hull"""
    r, (x, y) = run.record, run.steady.point.origin
    reach, turn = watch_circle(r.buoy, (x, y)), np.linspace(0, 2 * np.pi, 181)
    axes.plot(*r.buoy.T, lw=0.5)
    axes.plot(x + reach * np.cos(turn), y + reach * np.sin(turn), color="0.6", lw=0.8)
    axes.plot(x, y, "+", color="tab:red", ms=8)
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal",
             title=f"buoy: {reach:.3g} m at most from + (without the hull)")  # fmt: skip


def draw_lines(axes, lines):
    """Lines of a SystemEquilibrium of the buoy with their names, and the buoy"""
    anchors, tops = lines.points[lines.system.arrays.ends].swapaxes(0, 1)
    for name, a, b in zip(lines.system.line_names, anchors, tops, strict=True):
        axes.plot([a[0], b[0]], [a[1], b[1]], color="0.75", lw=1.2, zorder=0)
        axes.plot(*a[:2], "^", color="0.5", ms=5, zorder=0)
        axes.annotate(
            name, a[:2] + NAMED * (b[:2] - a[:2]), fontsize=8, ha="center", va="center", color="0.3",
            bbox={"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.8}, zorder=3,
        )  # fmt: skip
    axes.plot(*lines.position[0, :2], "o", color="tab:red", ms=6, label="buoy")


def draw_hull(axes, study, point, place, heading, **style):
    """Outline of the hull, and its middle line from midship to the bow"""
    h = study.hull
    L, B = 0.5 * h.length, 0.5 * h.beam
    outline = np.array([[L, B], [-L, B], [-L, -B], [L, -B], [L, B], [L, 0], [0, 0]])
    x, y = np.array([np.cos(heading), np.sin(heading)]), np.array([-np.sin(heading), np.cos(heading)])
    center = np.array([study.attachment.x, study.attachment.y]) - point.ends.mean(axis=0)
    outline = place + (outline - center) @ np.stack([x, y])
    axes.plot(*outline.T, **style)


def ends_in_space(point, place, heading):
    """Attachments of the hawsers to the hull, m; shape (k, 2)"""
    return place + point.ends @ np.array([[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]])


def _draw_streams(axes, study):
    """Arrows of the directions that wind, current and waves travel to, left of the plan"""
    towards = {}
    for name in ("wind", "current", "waves"):
        table = getattr(study, name)
        if table is not None:
            whole = name == "waves" and (table.file is not None or table.swell)
            sea = sea_with_swell(name, table, study.water.depth) if whole else None
            towards[name] = direction(name, table) if sea is None else sea.direction
    draw_streams(axes, towards)
