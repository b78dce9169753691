"""Plan of hulls made fast to each other, coloured by utilisation. One part shows all lines; beside it the hulls are
shown close up, with the names of hawsers and ropes above them and of fenders below.
"""

import numpy as np

from hakobune.mooring.studies.conditions import afloat

from ...printing.number import fixed
from .berth_plan import ROW, in_rows, write_rows
from .needs import OF_ALLOWABLE

CLOSE = 0.15  # free around the hulls of the close view, share of their extent
SIZE, HIGH = (15.0, 7.5), 6.0  # inches of the picture, and of either view at most
WIDE = 6.0  # inches of either view


def draw_between(made, db, numbers, path):
    """Write the plan of a Study with the bodies of a database and the `Numbers` of a load case"""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    from ...common.picture import save

    boxes = made.hulls_of(db)
    hulls, fenders = afloat(db, boxes), made.berth_of(db, boxes).fenders
    used, strain = numbers.largest / numbers.breaking, numbers.parts.get(OF_ALLOWABLE, {})
    top = max([1.0, *used[np.isfinite(used)], *filter(np.isfinite, strain.values())])
    colours = ScalarMappable(Normalize(0, min(top, 2.0)), "turbo")
    pairs = [outlines(*pair) for pair in zip(hulls, np.reshape(numbers.place, (-1, 3)), strict=True)]
    figure = Figure(figsize=SIZE, layout="constrained")
    far, near = figure.subplots(1, 2)
    for axes in (far, near):
        for anchor, fairlead, share in zip(numbers.anchor, numbers.fairlead, used, strict=True):
            axes.plot(*zip(anchor[:2], fairlead[:2], strict=True), color=colours.to_rgba(min(share, 2.0)), lw=2)
        for one in fenders:
            axes.plot(*one.face[:2], "s", ms=6, color=colours.to_rgba(min(strain.get(one.name, 0.0), 2.0)), mec="k")
        for i, (at_rest, moved) in enumerate(pairs):
            axes.plot(*at_rest.T, color="0.6", ls="--", label="" if i or axes is near else "as drawn")
            axes.plot(*moved.T, color="k", label="" if i or axes is near else "mean place")
        axes.set(xlabel="x, m", ylabel="y, m", aspect="equal")
    middle = np.concatenate([at_rest for at_rest, _ in pairs])
    inside = _close(middle, numbers.anchor[:, :2])
    words = [f"{name} {100 * share:.0f} %" for name, share in zip(numbers.names, used, strict=True)]
    _write_far(far, words, numbers, ~inside)
    told = [(f"{one.name} {100 * strain.get(one.name, 0.0):.0f} %", one.face[:2]) for one in fenders]
    ropes = [(words[i], numbers.anchor[i, :2]) for i in np.flatnonzero(inside)]
    _close_up(near, middle, ropes, told)
    for hull in hulls:
        near.annotate(hull.name, hull.place, fontsize=9, ha="center", va="center")
    far.set_title("\n".join(map(_words_of, hulls, np.reshape(numbers.place, (-1, 3)))), fontsize=8)
    near.set_title("hawsers and ropes above, fenders below", fontsize=8)
    figure.colorbar(colours, ax=(far, near), shrink=0.8, label="tension / breaking load,\nstrain / allowable strain")
    figure.legend(loc="outside lower center", ncols=2, fontsize=8)
    save(figure, path, 130)


def outlines(hull, place):
    """Outlines (5, 2) m in space of the box of an `Afloat`, at rest and at its mean position.

    The mean position (3,) is that of the rotation centre, along the axes at rest.
    """
    corners = 0.5 * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]]) * [hull.box.length, hull.box.beam]
    center, turn, (c, s) = hull.rotation_center[:2], hull.axes[:2, :2], (np.cos(place[2]), np.sin(place[2]))
    moved = center + place[:2] + (corners - center) @ np.array([[c, s], [-s, c]])
    return corners @ turn.T + hull.place, moved @ turn.T + hull.place


def _close(outline, points):
    """(n,) whether points (n, 2) m lie between the hulls or near them"""
    low, high = outline.min(axis=0), outline.max(axis=0)
    free = CLOSE * (high - low).max()
    return ((points > low - free) & (points < high + free)).all(axis=1)


def _write_far(axes, words, numbers, chosen):
    """Names of lines beside their anchors, where `chosen` (n,)"""
    for i in np.flatnonzero(chosen):
        anchor, fairlead = numbers.anchor[i, :2], numbers.fairlead[i, :2]
        axes.plot(*anchor, "k^", ms=4)
        at = anchor + 0.12 * (fairlead - anchor)
        axes.annotate(words[i], at, fontsize=7, ha="center", va="center",
                      bbox={"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.8})  # fmt: skip


def _close_up(axes, outline, above, below):
    """Limits of the close view, and names [(text, (2,) m)] in rows above and below the hulls"""
    (left, low), (right, high) = outline.min(axis=0), outline.max(axis=0)
    free = CLOSE * max(right - left, high - low)
    scale = min(WIDE / (right - left + 2 * free), HIGH / (high - low + 2 * free))  # inches a metre
    rows = [in_rows(names, scale) for names in (above, below)]
    top, bottom = (free + ROW * len(one) / scale for one in rows)
    for one, edge, inward in ((rows[0], high + top, -1), (rows[1], low - bottom, 1)):
        write_rows(axes, one, edge + inward * 0.12 / scale, inward * ROW / scale)
    axes.set(xlim=(left - free, right + free), ylim=(low - bottom, high + top))


def _words_of(hull, place):
    return "{}: mean place {} m, {} m, yaw {}°".format(hull.name, *map(fixed, (*place[:2], np.degrees(place[2]))))
