"""Plan of a moored body: hull and lines at rest and under steady forces, lines coloured by utilisation."""

import numpy as np

from hakobune.bem.bodies.one_of_several import body_named
from hakobune.mooring.lines.system.shapes import joints_of_lines, loads_on_lines
from hakobune.mooring.studies.multi_point import line_ends

from ..common.picture import draw_streams, save
from ..printing.number import fixed

LABEL = 0.3  # place of a label on a line from its anchor, where lines are far apart
SHORT = 0.1  # length of a short line over the plan
AT_SURFACE = 1e-3  # fraction of the draft
UNKNOWN = "0.45"  # grey: a line without a given breaking load


def draw_plan(result, db, path, used=None):
    """Write the plan of a MultiPoint result on a database as a picture.

    used : (n,) largest tension over breaking load of the lines, nan if unknown; by default of the result
    """
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 7), layout="constrained")
    axes = figure.add_subplot()
    used = result.utilisation if used is None else used
    colours = ScalarMappable(Normalize(0, max(1.0, used[np.isfinite(used)].max(initial=0.0))), "turbo")
    anchors, at_rest = line_ends(result.rest)
    extent = np.ptp(np.concatenate([anchors, at_rest])[:, :2], axis=0).max()
    names = result.equilibrium.system.line_names
    rows = zip(names, anchors, at_rest, line_ends(result.equilibrium)[1], used, strict=True)
    for name, anchor, rest, now, share in rows:
        axes.plot([anchor[0], rest[0]], [anchor[1], rest[1]], color="0.75", lw=1, ls="--")
        axes.plot([anchor[0], now[0]], [anchor[1], now[1]], color=_colour(colours, share), lw=2.5)
        axes.plot(*anchor[:2], "k^", ms=5)
        short = np.hypot(*(now - anchor)[:2]) < SHORT * extent  # its name would hide it
        axes.annotate(
            f"{name}\n{_words(share)}",
            anchor[:2] + LABEL * (now[:2] - anchor[:2]),
            (30 * short, 0),
            textcoords="offset points",
            fontsize=8,
            ha="left" if short else "center",
            va="center",
            bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
        )
    hung = loads_on_lines(result.equilibrium)
    axes.plot(hung[:, 0], hung[:, 1], "o", color="0.2", ms=5)
    joints = joints_of_lines(result.equilibrium)
    axes.plot(joints[:, 0], joints[:, 1], "|", color="0.2", ms=7)
    for i, (at_rest, moved) in enumerate(_outlines(result, db)):
        axes.plot(at_rest[:, 0], at_rest[:, 1], color="0.6", ls="--", label="" if i else "at rest")
        axes.plot(moved[:, 0], moved[:, 1], color="k", label="" if i else "under steady forces")
        if len(result.hulls) > 1:
            axes.annotate(result.hulls[i].name, moved[:-1, :2].mean(axis=0), fontsize=8, ha="center", va="center")
    w = result.conditions
    streams = {"wind": w.wind, "current": w.current, "waves": w.waves}
    draw_streams(axes, {name: one.direction for name, one in streams.items() if one})
    figure.colorbar(colours, ax=axes, label="largest tension / breaking load", shrink=0.8)
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal", title=_title(result))
    figure.legend(loc="outside lower center", ncols=5, fontsize=8)
    save(figure, path, 150)


def _outlines(result, db):
    """Outline (k, 3) m of every hull at rest, and under the steady forces"""
    then, now = result.rest.pose, result.equilibrium.pose
    for i, one in enumerate(result.hulls):
        at_rest = _outline(one, db) @ one.axes.T + (*one.place, 0.0)
        yield at_rest, now.place[i] + (at_rest - then.place[i]) @ then.turn[i] @ now.turn[i].T


def _outline(one, db):
    """Closed outline of an `Afloat` in its own coordinates, m; shape (k, 3): around its waterline; without panels, or
    for a submerged hull, its box"""
    if db.mesh is not None and len(db.mesh):
        from scipy.spatial import ConvexHull

        points = (body_named(db, one.name).mesh if db.bodies else db.mesh).whole().points
        top = points[points[:, 2] > -AT_SURFACE * one.box.draft]
        if len(top) > 2:
            own = (top - (*one.place, 0.0)) @ one.axes
            around = own[ConvexHull(own[:, :2]).vertices] * [1.0, 1.0, 0.0]
            return around[[*range(len(around)), 0]]
    corners = 0.5 * np.array([[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0], [1, 1, 0]], float)
    return corners * [one.box.length, one.box.beam, 0.0]


def _colour(colours, share):
    """Colour for a share of the breaking load; grey, which is outside the scale, without one"""
    return UNKNOWN if np.isnan(share) else colours.to_rgba(min(share, colours.norm.vmax))


def _words(share):
    return "unknown" if np.isnan(share) else "beyond reach" if np.isinf(share) else f"{100 * share:.0f} %"


def _title(result):
    if len(result.displacement) > 3:
        return "dashed: at rest"
    x, y, turn = map(fixed, (*result.displacement[:2], np.degrees(result.displacement[2])))
    return f"offset {x} m, {y} m, yaw {turn}°; dashed: at rest"
