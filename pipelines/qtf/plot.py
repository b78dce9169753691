"""Picture of forces of pairs: level lines over both frequencies, Newman's rule on top of the level lines, sizes by
level or part."""

import numpy as np

from hakobune.bem.second_order.kinds import SUM

from ..common.picture import save
from .report import levels, newman, parts_of_sums


def draw(stored, db, path):
    """Write the picture of the heading with the largest force to `path`; returns the matplotlib figure"""
    import matplotlib
    from matplotlib.figure import Figure

    forces, floats, words = stored.forces, stored.held.floats, stored.words
    if forces.kind is SUM:
        return _draw_sums(forces, db, floats, words, path)
    diagonal = np.arange(len(forces.headings))
    size = np.nanmax(np.abs(forces.total[:, :, diagonal, diagonal]), axis=(0, 1))  # (m, 6), of several bodies (m, 6N)
    size[:, np.arange(size.shape[1]) % 6 > 1] = 0.0
    h, mode = (int(one) for one in np.unravel_index(np.argmax(size), size.shape))
    total = forces.total[:, :, h, h, mode]
    with matplotlib.rc_context({"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"}):
        figure = Figure(figsize=(13, 4.2), layout="constrained")
        axes = figure.subplots(1, 3)
        low, Ω = np.meshgrid(forces.omega, forces.frequency)
        _levels(figure, axes[0], low, low + Ω, np.abs(total) / 1e3, f"|T| of {words[mode]}, kN/m²")
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.log10(np.abs(newman(forces, mode, h)) / np.abs(total))
        _levels(figure, axes[1], low, low + Ω, np.clip(ratio, -2, 0.5), "log10 of Newman's approximation over it")
        _over_difference(axes[2], forces, h, mode)
        of = f"{words[mode]}, {np.degrees(forces.headings[h]):.4g}°, {_where(db, floats)}"
        figure.suptitle(f"slow force of pairs of waves, {of}", x=0.01, ha="left", fontsize=11)
        save(figure, path, 130)
    return figure


def _draw_sums(forces, db, floats, words, path):
    """The largest force and the largest moment at sums of frequencies"""
    import matplotlib
    from matplotlib.figure import Figure

    diagonal = np.arange(len(forces.headings))
    size = np.nanmax(np.abs(forces.total[:, :, diagonal, diagonal]), axis=(0, 1))  # (m, 6), of several bodies (m, 6N)
    turns = np.arange(size.shape[1]) % 6 > 2
    with matplotlib.rc_context({"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"}):
        figure = Figure(figsize=(10, 7.6), layout="constrained")
        axes = figure.subplots(2, 2)
        for row, (first, unit, told) in zip(axes, ((0, 1e3, "kN/m²"), (3, 1e6, "MN m/m²")), strict=True):
            h, mode = np.unravel_index(np.argmax(np.where(turns == (first > 0), size, 0.0)), size.shape)
            low, Ω = np.meshgrid(forces.omega, forces.frequency)
            total = np.abs(forces.total[:, :, h, h, mode]) / unit
            name = f"{words[mode]}, {np.degrees(forces.headings[h]):.4g}°"
            _levels(figure, row[0], low, Ω - low, total, f"|T| of {name}, {told}")
            for part, value in parts_of_sums(forces, mode, h).items():
                row[1].plot(forces.frequency, np.sqrt(np.nanmean(np.abs(value) ** 2, axis=1)) / unit, label=part)
            row[1].set(title=f"{name}: root mean square over pairs, {told}", xlabel="sum of frequencies  rad/s")
            row[1].set_ylim(bottom=0)
            row[1].grid(True, color="0.9", linewidth=0.6)
            row[1].legend(frameon=False)
        title = f"force of pairs of waves at the sum of their frequencies, {_where(db, floats)}"
        figure.suptitle(title, x=0.01, ha="left", fontsize=11)
        save(figure, path, 130)
    return figure


def _where(db, floats):
    depth = f"water {db.water_depth:g} m" if np.isfinite(db.water_depth) else "deep water"
    return f"{'floating' if floats else 'fixed'}, {depth}"


def _levels(figure, axis, one, two, value, title):
    known = np.isfinite(value)
    drawn = axis.tricontourf(one[known], two[known], value[known], levels=14, cmap="viridis")
    figure.colorbar(drawn, ax=axis)
    axis.plot([one.min(), one.max()], [one.min(), one.max()], color="k", linewidth=0.6)
    axis.set(title=title, xlabel="ω₂  rad/s", ylabel="ω₁  rad/s")


def _over_difference(axis, forces, h, mode):
    for name, value in levels(forces, mode, h).items():
        axis.plot(forces.frequency, np.sqrt(np.nanmean(np.abs(value) ** 2, axis=1)) / 1e3, label=name)
    axis.set(title="root mean square over frequencies, kN/m²", xlabel="difference of frequencies  rad/s")
    axis.set_ylim(bottom=0)
    axis.grid(True, color="0.9", linewidth=0.6)
    axis.legend(frameon=False)
