"""Design charts of the single-point series, and its statements of applicability beside what is computed."""

from __future__ import annotations

import numpy as np

from ...common.picture import save
from .single_point_cases import FLOATERS

CHARTS = (  # over a column, of cases that agree in the others, and how these are named
    (
        "depth_m",
        "depth, m",
        ("height_m", "mean_period_s", "pretension_ton", "lines", "current_kn", "system", "current_deg"),
        "H {0:g} m, {1:g} s, T0 {2:g} t, {3:g} lines, {5}",
    ),
    (
        "wind_m_s",
        "wind, m/s",
        ("depth_m", "lines", "current_kn", "pretension_ton", "system", "current_deg", "mean_period_s"),
        "{0:g} m, {1:g} lines, {2:g} kn, T0 {3:g} t",
    ),
    (
        "current_deg",
        "current from, °",
        ("depth_m", "lines", "system", "wind_m_s", "pretension_ton", "current_kn", "mean_period_s"),
        "{0:g} m, {1:g} lines, {2}",
    ),
)


def draw(results, folder):
    """Charts of tension over depth, weather and direction of the current, and computed beside printed; their paths"""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    paths = []
    for floater in sorted({one.case.floater for one in results}):
        own = [one for one in results if one.case.floater == floater]
        figure = Figure(figsize=(12, 9), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(2, 2)
        for ax, (column, label, keys, words) in zip(axes.flat, CHARTS, strict=False):
            _over(ax, own, column, label, keys, words)
        _beside(axes[1, 1], own)
        for ax in axes.flat[:3]:
            ax.axhline(0.4 * FLOATERS[floater].breaking, color="0.6", lw=0.8, ls=":")
            ax.set(ylabel="line tension, tonf (full: significant, dashed: static)", yscale="log")
        figure.suptitle(f"Floater {floater}; crosses: printed; dotted: 0.4 of the breaking load")
        path = folder / f"single_point_{floater}.png"
        save(figure, path, 120)
        paths.append(path)
    return paths


def _over(axes, results, column, label, keys, words):
    """Static and significant tension of groups of cases that differ in one column and agree in `keys`"""
    groups = {}
    for one in results:
        groups.setdefault(tuple(_of(one.case, key) for key in keys), []).append(one)
    shown = 0
    for key, members in groups.items():
        x = np.array([_of(one.case, column) for one in members])
        if len(np.unique(x)) < 2:
            continue
        order, colour = np.argsort(x), f"C{shown % 10}"
        shown += 1
        for name, style in (("static_ton", "--"), ("significant_ton", "-")):
            y = np.array([getattr(one, name) for one in members])
            printed = np.array([one.case.printed[name] or np.nan for one in members])
            axes.plot(x[order], y[order], style, color=colour, label=words.format(*key) if style == "-" else None)
            axes.plot(x, printed, "x", color=colour, ms=5)
    axes.set_xlabel(label)
    if shown:
        axes.legend(fontsize=7)


def _of(case, key):
    """Number or word of a case by its column"""
    return case.values[key] if key in case.values else getattr(case, key)


def _beside(axes, results):
    """Computed tension against printed"""
    for name, marker in (("static_ton", "o"), ("significant_ton", "^")):
        pairs = np.array([(one.case.printed[name] or np.nan, getattr(one, name)) for one in results])
        axes.loglog(*pairs.T, marker, mfc="none", label=name.replace("_ton", ""))
    ends = np.array(axes.get_xlim())
    axes.plot(ends, ends, "k", lw=0.8)
    axes.fill_between(ends, 0.8 * ends, 1.25 * ends, color="0.9", zorder=0)
    axes.set(xlabel="printed, tonf", ylabel="computed, tonf (grey: ±25 %)")
    axes.legend()


def statements(results):
    """Lines on the report's statements of section 3.6.5, each with what is computed; none without its cases"""
    named = {one.case.name: one for one in results}
    for text, cases, value in STATEMENTS:
        if all(name in named for name in cases):
            yield f"report: {text}; computed: {value(*(named[name] for name in cases))}"


def trends(results):
    """Lines on significant over static tension of a contact buoy head-on, six lines, computed beside printed

    Where lines are nearly taut, decimetres of surge decide: by how many the two are apart is told with each.
    """
    found = {}
    for one in results:
        v, printed = one.case.values, one.case.printed
        if one.case.system == "contact" and v["lines"] == 6 and v["current_kn"] == 1.5 and np.isfinite(one.apart_m):
            key = one.case.floater, v["height_m"], v["mean_period_s"], v["depth_m"]
            ratios = one.significant_ton / one.static_ton, printed["significant_ton"] / printed["static_ton"]
            found.setdefault(key, []).append((*ratios, one.apart_m))
    for (floater, height, period, depth), rows in found.items():
        ours, printed, away = np.array(rows).T
        yield (
            f"{floater}, H {height:g} m, {period:g} s, {depth:g} m: significant over static {_ends(ours, 2)}, printed "
            f"{_ends(printed, 2)}; apart by {_ends(away, 2)} m of surge"
        )
    away = np.abs([one.apart_m for one in results if np.isfinite(one.apart_m)])
    if len(away) > 1:
        yield (
            f"significant tensions of {len(away)} cases head-on and those printed are apart by {np.median(away):.2f} m "
            f"of surge at the median, {np.quantile(away, 0.9):.2f} m in nine of ten: lines nearly taut make much of it"
        )


def _ends(values, digits):
    """Smallest and largest as text, once where they are the same"""
    low, high = (f"{v:.{digits}f}" for v in (values.min(), values.max()))
    return low if low == high else f"{low} to {high}"


def _t(one):
    return "beyond reach" if np.isnan(one.significant_ton) else f"{one.significant_ton:.0f} t"


def _ratio(one):
    return "–" if np.isnan(one.significant_ton) else f"{one.significant_ton / one.static_ton:.2f}"


STATEMENTS = (
    (
        "tension of A rises sharply below 15 m",
        ("A12", "A14", "A16"),
        lambda a, b, c: f"{_t(c)} at 20 m, {_t(b)} at 14 m, {_t(a)} at 12 m",
    ),
    (
        "A at 14 m and 1.5 kn stands 35, 40, 45 m/s on 6, 12, 18 lines (breaking load 785 t)",
        ("A20", "A33", "A35"),
        lambda a, b, c: f"{_t(a)}, {_t(b)}, {_t(c)} there",
    ),
    (
        "and at 3 kn 32 m/s on 12, 38 m/s on 18 lines",
        ("A38", "A41"),
        lambda a, b: f"{_t(a)} at 35 m/s on 12, {_t(b)} at 40 m/s on 18",
    ),
    (
        "an oblique current of 30 to 60° adds 40 % to the static tension of a contact buoy at most",
        ("A53", "A54", "A55"),
        lambda a, b, c: f"{100 * (max(b.static_ton, c.static_ton) / a.static_ton - 1):.0f} %",
    ),
    (
        "dynamic tension of B at 40 m and more is 1.4 times the static or less",
        ("B26", "B27", "B28"),
        lambda *three: ", ".join(_ratio(one) for one in three),
    ),
    (
        "tension of B rises sharply below 35 m",
        ("B24", "B26", "B28"),
        lambda a, b, c: f"{_t(c)} at 100 m, {_t(b)} at 40 m, {_t(a)} at 24 m",
    ),
    (
        "the worst of B is about 740 t, half of its breaking load",
        ("B25", "B52"),
        lambda a, b: f"{_t(b)} on 12 lines at 40 m, {_t(a)} on six at 24 m",
    ),
)
