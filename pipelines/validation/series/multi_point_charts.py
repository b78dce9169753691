"""Design charts of the multi-point series: tension over sea, depth, period and number of lines, by both methods."""

from __future__ import annotations

import numpy as np

from ...common.picture import save
from .multi_point_cases import BASES, KINDS, STRENGTH

OVER = {"height": "significant height, m", "depth": "depth, m", "period": "mean period, s", "lines": "lines"}
WITH = {"height": ("wind",)}  # what changes together
ALLOWED = 0.4  # of the breaking load
SLOW = (("quick", "quick rule", "^"), ("spectrum", "spectrum", "s"))


def draw(results, folder):
    """Tension of each floater, and slow motion by two estimates against the simulation; their paths"""
    paths = []
    for floater in sorted({one.case.floater for one in results}):
        own = [one for one in results if one.case.floater == floater]
        series = {column: _groups(own, column) for column in OVER}
        shown = [column for column, groups in series.items() if groups]
        if shown:
            paths.append(folder / f"multi_point_{floater}.png")
            _tensions(shown, series, floater, paths[-1])
    if any(np.isfinite(one.slow).any() for one in results):
        paths.append(folder / "multi_point_slow.png")
        _slow(results, paths[-1])
    return paths


def _groups(results, column):
    """{kind: Results along a column, from the base} of kinds with at least two"""
    base, found = BASES[results[0].case.floater], {}
    for kind in KINDS:
        wanted = base._replace(kind=kind)
        same = [one for one in results if _agrees(one.case, wanted, column)]
        if len(same) > 1:
            found[kind] = sorted(same, key=lambda one: getattr(one.case, column))
    return found


def _agrees(case, base, column):
    free = {"name", column, *WITH.get(column, ())}
    return all(getattr(case, key) == getattr(base, key) for key in case._fields if key not in free)


def _tensions(shown, series, floater, path):
    from matplotlib.ticker import LogLocator, ScalarFormatter

    figure, axes = _figure(len(shown))
    for ax, column in zip(axes, shown, strict=True):
        for kind, along in series[column].items():
            x, colour = [getattr(one.case, column) for one in along], f"C{KINDS.index(kind)}"
            ax.plot(x, [one.simulated for one in along], "o-", color=colour, label=f"{kind}, simulated")
            ax.plot(x, [one.regular for one in along], "s--", color=colour, mfc="none", label=f"{kind}, simplified")
        for load, words in ((STRENGTH, "breaking load"), (ALLOWED * STRENGTH, f"{ALLOWED:g} of it")):
            ax.axhline(load, color="0.5", lw=0.9, ls=":")
            ax.annotate(words, (1.0, load), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=7)
        ax.set(xlabel=OVER[column], ylabel="largest tension of a line, tonf", yscale="log")
        ax.set_xticks(sorted({getattr(one.case, column) for along in series[column].values() for one in along}))
        ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.yaxis.set_major_formatter(ScalarFormatter())
        ax.minorticks_off()
        ax.grid(alpha=0.3)
    axes[0].legend(fontsize=7)
    base = BASES[floater]
    figure.suptitle(
        f"Floater {floater}; else {base.depth:g} m of water, {base.lines} lines, Hs {base.height:g} m, wind "
        f"{base.wind:g} m/s, {base.period:g} s; all from 60° off the bow"
    )
    save(figure, path, 120)


def _slow(results, path):
    figure, axes = _figure(2)
    for ax, mode, name in zip(axes, (0, 1), ("surge", "sway"), strict=True):
        for key, words, marker in SLOW:
            pairs = np.array([(one.slow[mode], getattr(one, key)[mode]) for one in results])
            ax.loglog(*pairs.T, marker, mfc="none", label=words)
        ends = np.array([np.nanmin([ax.get_xlim(), ax.get_ylim()]), np.nanmax([ax.get_xlim(), ax.get_ylim()])])
        ax.plot(ends, ends, "k", lw=0.8)
        ax.fill_between(ends, ends / 1.5, 1.5 * ends, color="0.92", zorder=0)
        ax.set(xlabel=f"σ of slow {name}, simulated, m", ylabel="by the estimates, m (grey: within 1.5)")
        ax.legend(fontsize=8)
    save(figure, path, 120)


def _figure(count):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    rows = 2 if count > 3 else 1
    columns = -(-count // rows)
    figure = Figure(figsize=(5.6 * columns, 4.8 * rows), layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(rows, columns, squeeze=False, sharey=True).ravel()[:count]
