"""Plan and profile of a system of lines at rest, offset curves, and frames of a dynamic line."""

import numpy as np

from hakobune.mooring.lines.system.shapes import beds_of_lines, line_shapes, loads_on_lines

from ..common.picture import save
from ..common.units import KN

MOST_NAMED = 40  # lines of a plan, beyond which their names would hide it
LEAST_ROOM = 0.25  # shorter side of a plan, over its longer side
KINDS = ("line", "lines", "line-dynamics")  # kinds of results that have a picture


def draw_system(state, path, curves=(), losses=None):
    """Plan and profile, lines coloured by tension; below the plan and profile offset curves, and tensions with one line
    broken."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    rows = 1 + bool(curves or losses)
    figure = Figure(figsize=(13, 6.0 * rows), layout="constrained")
    grid = figure.subplots(rows, 2, squeeze=False)
    colours = ScalarMappable(Normalize(0, state.tension.max() / KN), "viridis_r")
    shapes = line_shapes(state)
    for axes, (i, j), labels in ((grid[0, 0], (0, 1), "xy"), (grid[0, 1], (0, 2), "xz")):
        for shape, tension in zip(shapes, state.tension, strict=True):
            axes.plot(shape[:, i], shape[:, j], color=colours.to_rgba(tension / KN), lw=2)
        _draw_points(axes, state, i, j)
        axes.set(xlabel=f"{labels[0]}, m", ylabel=f"{labels[1]}, m")
    grid[0, 0].set(aspect="equal", title="plan")
    _name_lines(grid[0, 0], state.system.line_names, shapes)
    _widen(grid[0, 0])
    _draw_beds(grid[0, 1], state)
    grid[0, 1].axhline(0.0, color="C0", lw=1, zorder=0)
    grid[0, 1].set_title("profile, heights stretched")
    figure.colorbar(colours, ax=grid[0], label="tension, kN", shrink=0.8)
    if rows > 1:
        _draw_curves(grid[1, 0], curves)
        _draw_losses(grid[1, 1], state, losses or {})
    save(figure, path, 120)


def _name_lines(axes, names, shapes):
    """The name of every line at its middle in a plan, of no more than MOST_NAMED"""
    for name, shape in zip(names, shapes, strict=True) if len(shapes) <= MOST_NAMED else ():
        box = {"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.7}
        axes.annotate(name, shape[len(shape) // 2, :2], fontsize=8, ha="center", va="center", bbox=box)


def _widen(axes):
    """Give a plan of lines in one plane room across it"""
    limits = np.array([axes.get_xlim(), axes.get_ylim()])
    half, middle = 0.5 * np.ptp(limits, axis=1), limits.mean(axis=1)
    half = np.maximum(half, LEAST_ROOM * half.max())
    axes.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))


def _draw_beds(axes, state):
    """The bed of the system for lines without their own, and each line's own bed"""
    own = beds_of_lines(state)
    if len(own) < len(state.system.lines):
        axes.axhline(-state.system.depth, color="0.5", lw=4, zorder=0)
    for i, bed in enumerate(own):
        label = "" if i else "own bed of a line"
        axes.plot(bed[:, 0], bed[:, 2], color="C5", lw=2.5, alpha=0.6, zorder=0, label=label)
    if own:
        axes.legend(frameon=False, fontsize=8)


def _draw_points(axes, state, i, j):
    from hakobune.mooring.lines.system.parts import Anchor, Fairlead

    marks = {Anchor: ("^", "k"), Fairlead: ("s", "0.3")}
    for point, place in zip(state.system.points, state.points, strict=True):
        mark, colour = marks.get(type(point), ("o", "C3"))
        axes.plot(place[i], place[j], mark, color=colour, ms=5)
    hung = loads_on_lines(state)
    axes.plot(hung[:, i], hung[:, j], "o", color="C3", ms=5)


def _draw_curves(axes, curves):
    if not curves:
        axes.set_axis_off()
        return
    for curve in curves:
        label = f"{np.degrees(curve.direction):g}°"
        (drawn,) = axes.plot(curve.offset, curve.restoring / KN, label=f"restoring {label}")
        axes.plot(
            curve.offset,
            curve.tension.max(axis=1) / KN,
            "--",
            color=drawn.get_color(),
            label=f"largest tension {label}",
        )
    axes.set(xlabel="offset, m", ylabel="kN", title=f"{curves[0].body} held at an offset")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, fontsize=8)


def _draw_losses(axes, state, losses):
    if not losses:
        axes.set_axis_off()
        return
    names = ["intact", *losses]
    largest = [state.tension.max(), *(left.tension.max() for left in losses.values())]
    axes.barh(names, np.array(largest) / KN, color=["0.6", *["C1"] * len(losses)])
    axes.invert_yaxis()
    axes.set(xlabel="largest tension, kN", title="after the loss of one line")


def draw_frames(time, nodes, path):
    """A strip of up to twelve frames of a line (.png, .svg, .pdf), or all frames as a film (.gif).

    time : (f,) s; nodes : (f, k, 3) m
    """
    from matplotlib.figure import Figure

    plane = line_plane(nodes)
    if path.suffix.lower() == ".gif":
        return _film(time, plane, path)
    chosen = np.unique(np.linspace(0, len(time) - 1, min(12, len(time))).round().astype(int))
    columns = min(4, len(chosen))
    rows = -(-len(chosen) // columns)
    figure = Figure(figsize=(3.4 * columns, 2.6 * rows), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for axes, i in zip(grid.flat, chosen, strict=False):
        axes.plot(*plane[0].T, color="0.8", lw=1)
        axes.plot(*plane[i].T, "o-", color="C0", ms=2, lw=1.2)
        axes.set_title(f"{time[i]:.2f} s", fontsize=9)
    for axes in list(grid.flat)[len(chosen) :]:
        axes.set_axis_off()
    figure.supxlabel("along the line's plane at the start, m")
    figure.supylabel("z, m")
    save(figure, path, 120)
    return None


def line_plane(nodes):
    """Places along the horizontal line through both ends at the start, and z, m; shape (f, k, 2)"""
    along = nodes[0, -1, :2] - nodes[0, 0, :2]
    size = np.linalg.norm(along)
    along = along / size if size > 0 else np.array([1.0, 0.0])
    return np.stack([(nodes[..., :2] - nodes[0, 0, :2]) @ along, nodes[..., 2]], axis=-1)


def _film(time, plane, path):
    from matplotlib.animation import FuncAnimation, PillowWriter
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 4), layout="constrained")
    axes = figure.subplots()
    (drawn,) = axes.plot(*plane[0].T, "o-", color="C0", ms=2)
    margin = 0.05 * np.ptp(plane.reshape(-1, 2), axis=0) + 1e-9
    low, high = plane.reshape(-1, 2).min(axis=0) - margin, plane.reshape(-1, 2).max(axis=0) + margin
    axes.set(
        xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel="along the line's plane at the start, m", ylabel="z, m"
    )
    title = axes.set_title("")

    def show(i):
        drawn.set_data(*plane[i].T)
        title.set_text(f"{time[i]:.2f} s")
        return (drawn,)

    every = max(1, len(time) // 200)
    pause = 1e3 * float(np.mean(np.diff(time[::every]))) if len(time) > every else 100.0
    film = FuncAnimation(figure, show, frames=range(0, len(time), every), interval=pause)
    film.save(path, writer=PillowWriter(fps=min(25.0, max(1.0, 1e3 / pause))))


def draw_result(file, picture):
    """Frames of a result of line-dynamics as a strip or a film; returns the picture's path.  Raises ValueError.

    picture : Path; None for NAME_frames.png beside the file, where a picture of the run keeps NAME.png
    """
    from ..common.picture import PLOTS, check_picture
    from ..results.file import read
    from ..results.writing import kind_of

    if picture is None:
        picture = file.with_name(f"{file.stem}_frames.png")
    check_picture(picture, (*PLOTS, ".gif"))
    result = read(file, kind_of(file) if kind_of(file) in KINDS else "line-dynamics")
    if "line.place" not in result:
        raise ValueError(f"{file} has no frames; allowed: a result of hakobune line-dynamics")
    draw_frames(result.labels["frame"].values, result["line.place"], picture)
    return picture
