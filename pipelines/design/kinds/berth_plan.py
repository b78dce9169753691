"""Plan of a berth: the hull between its fenders and ropes, coloured by utilisation.

Names are in rows so that they do not overlap: names of ropes beyond the bollards of their side, names of fenders inside
the hull.
"""

import numpy as np

from ...printing.number import fixed
from .needs import OF_ALLOWABLE

LETTER, ROW = 0.06, 0.15  # inches: width of a letter of a name, height of a row of names
WIDTH, MARGIN = 8.6, 0.1  # inches of the plan along x, and share of its length that is free at either end
SIDES = (1, -1)


def draw_berth(made, db, numbers, path):
    """Draw the plan of a berth: the lines of a Study, the body of a database, and the `Numbers` of a load case"""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    from ...common.picture import draw_streams, save

    hull = made.hull_of(db.sizes)
    fenders = made.berth(hull, db.rotation_center).fenders
    used, strain = numbers.largest / numbers.breaking, numbers.parts.get(OF_ALLOWABLE, {})
    top = max([1.0, *used[np.isfinite(used)], *filter(np.isfinite, strain.values())])
    colours = ScalarMappable(Normalize(0, min(top, 2.0)), "turbo")
    corners = 0.5 * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]]) * [hull.length, hull.beam]
    ends = np.vstack([corners, numbers.anchor[:, :2]])
    (left, low), (right, high) = ends.min(axis=0), ends.max(axis=0)
    scale = WIDTH / ((1 + 2 * MARGIN) * (right - left))  # inches a metre
    words = [f"{name} {100 * share:.0f} %" for name, share in zip(numbers.names, used, strict=True)]
    above, below = _by_side(words, numbers.anchor[:, :2], numbers.anchor[:, 1], scale)
    high, low = (end + side * (0.2 + ROW * len(rows)) / scale for end, side, rows in
                 ((high, 1, above), (low, -1, below)))  # fmt: skip
    figure = Figure(figsize=(11, scale * (high - low) + 1.5), layout="constrained")
    axes = figure.add_subplot()
    for anchor, fairlead, share in zip(numbers.anchor, numbers.fairlead, used, strict=True):
        axes.plot(*zip(anchor[:2], fairlead[:2], strict=True), color=colours.to_rgba(min(share, 2.0)), lw=2)
        axes.plot(*anchor[:2], "k^", ms=4)
    for rows, edge, inward in ((above, high, -1), (below, low, 1)):
        write_rows(axes, rows, edge + inward * 0.12 / scale, inward * ROW / scale)
    _draw_fenders(axes, fenders, strain, colours, hull, scale)
    axes.plot(*corners.T, color="0.6", ls="--", label="as drawn")
    x, y, turn = numbers.place
    turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    axes.plot(*(corners @ turned.T + [x, y]).T, color="k", label="mean place")
    axes.annotate("bow", (0.5 * hull.length, 0.0), xytext=(-8, 0), textcoords="offset points", ha="right", va="center",
                  fontsize=8)  # fmt: skip
    figure.colorbar(colours, ax=axes, shrink=0.8, label="tension / breaking load,\nstrain / allowable strain")
    at = "mean place {} m, {} m, yaw {}°".format(*map(fixed, (x, y, np.degrees(turn))))
    free = MARGIN * (right - left)
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal", title=at, xlim=(left - free, right + free), ylim=(low, high))
    conditions = made.conditions()
    streams = {"wind": conditions.wind, "current": conditions.current, "waves": conditions.waves}
    draw_streams(axes, {name: one.direction for name, one in streams.items() if one})
    figure.legend(loc="outside lower center", ncols=2, fontsize=8)
    save(figure, path, 150)


def _draw_fenders(axes, fenders, strain, colours, hull, scale):
    """Fenders with their names; names of fenders at the ends of the hull, which push along x, are beside them"""
    told = [f"{one.name} {100 * strain.get(one.name, 0.0):.0f} %" for one in fenders]
    for one in fenders:
        axes.plot(*one.face[:2], "s", ms=9, color=colours.to_rgba(min(strain.get(one.name, 0.0), 2.0)), mec="k")
    across = [(text, one) for text, one in zip(told, fenders, strict=True) if abs(one.normal[1]) > abs(one.normal[0])]
    places = np.array([one.face[:2] for _, one in across]).reshape(-1, 2)
    for side, rows in zip(SIDES, _by_side([text for text, _ in across], places, places[:, 1], scale), strict=True):
        inner = 0.5 * hull.beam - (0.07 + ROW * len(rows)) / scale
        write_rows(axes, rows, side * inner, side * ROW / scale)
    for text, one in zip(told, fenders, strict=True):
        if abs(one.normal[1]) <= abs(one.normal[0]):
            x, y = one.face[:2]
            axes.annotate(text, (x, y), fontsize=7, ha="left" if x < 0 else "right", va="center",
                          xytext=(-12 * np.sign(x), 0), textcoords="offset points")  # fmt: skip


def _by_side(words, places, y, scale):
    """Rows of the names at y ≥ 0, and of those below; scale : inches a metre"""
    pairs = list(zip(words, places, y, strict=True))
    return [in_rows([(text, place) for text, place, at in pairs if (at >= 0) == (side > 0)], scale) for side in SIDES]


def in_rows(words, scale):
    """[[(text, (2,) m)] of each row], from left to right, without overlaps in a row"""
    rows, ends = [], []  # ends : of each row, m along x of the end of its last name
    for text, place in sorted(words, key=lambda one: one[1][0]):
        half = 0.5 * LETTER * len(text) / scale
        row = next((i for i, end in enumerate(ends) if end < place[0] - half), len(rows))
        if row == len(rows):
            rows.append([])
            ends.append(0.0)
        rows[row].append((text, place))
        ends[row] = place[0] + half + LETTER / scale
    return rows


def write_rows(axes, rows, edge, step):
    """Write the names of `in_rows`, each with a line to the named part; the last row is at y = `edge` m, each
    earlier row `step` m on
    """
    for i, row in enumerate(rows):
        for text, (x, y) in row:
            axes.annotate(
                text, (x, y), fontsize=7, ha="center", va="center", xytext=(x, edge + (len(rows) - 1 - i) * step),
                bbox={"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none"},
                arrowprops={"arrowstyle": "-", "lw": 0.4, "color": "0.6", "shrinkA": 0, "shrinkB": 2},
            )  # fmt: skip
