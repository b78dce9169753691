"""Plan of a body at a single point: its position, the lines of its buoy, wind, current and waves."""

import numpy as np

from hakobune.mooring.single_point.equilibria import bow, preferred

from ..common.picture import draw_streams, save
from ..common.quantities import direction
from ..common.units import KN
from ..common.weather.seas import sea_with_swell
from ..printing.number import fixed

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
