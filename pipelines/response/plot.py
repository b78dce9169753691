"""Pictures of a response: spectra in a sea state, or long-term exceedance in a climate."""

import numpy as np

from hakobune.mooring.response.long_term import YEAR

from ..common.picture import save
from ..common.units import KN
from .findings import sea_in_words

COLUMNS = 3
RAD = {"rad": ("°", 180 / np.pi)}


def draw(result, path):
    """Write the picture of a SeaState or a Climate to `path`; returns the matplotlib figure."""
    import matplotlib
    from matplotlib.figure import Figure

    climate = hasattr(result, "probability")
    panels = [*_panels(result)] if climate else ["waves", *_panels(result), *(["drift"] if result.slow else [])]
    rows = -(-len(panels) // COLUMNS)
    with matplotlib.rc_context({"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"}):
        figure = Figure(figsize=(13, 0.8 + 2.6 * rows), layout="constrained")
        grid = figure.subplots(rows, COLUMNS, squeeze=False)
        for axis, panel in zip(grid.flat, panels, strict=False):
            (_long_term if climate else _spectrum)(axis, result, panel)
            axis.grid(True, color="0.9", linewidth=0.6)
            axis.spines[["top", "right"]].set_visible(False)
        for axis in grid.flat[len(panels) :]:
            axis.set_axis_off()
        title = f"exceedance in {len(result.height)} sea states" if climate else f"spectra: {sea_in_words(result)}"
        figure.suptitle(title, x=0.01, ha="left", fontsize=11)
        save(figure, path, 130)
    return figure


def _panels(result):
    """Names and indices of responses that share a panel: each motion separately, a point's by kind"""
    excited = result.excited if hasattr(result, "excited") else result.sigma > 0
    panels = {}
    for i in np.flatnonzero(excited):
        name = result.names[i]
        panels.setdefault(name[:-2] if name[-2:] in (" x", " y", " z") else name, []).append(i)
    return list(panels.items())


def _spectrum(axis, result, panel):
    if panel == "waves":
        density = result.sea.spectrum.density(result.omega)
        axis.plot(result.omega, density, color="k")
        axis.set(title="waves", ylabel="m² s/rad", xlabel="ω  rad/s")
    elif panel == "drift":
        for i, name in enumerate(("surge", "sway")):
            axis.plot(result.slow.difference, result.slow.spectrum[:, i] / KN**2, color=f"C{i}", label=name)
        axis.set(title="slow drift force", ylabel="kN² s/rad", xlabel="difference of frequencies  rad/s")
        axis.legend(frameon=False)
    else:
        name, places = panel
        unit, factor = RAD.get(result.units[places[0]], (result.units[places[0]], 1.0))
        for i, label in zip(places, _labels(result, places), strict=True):
            axis.plot(result.omega, result.spectrum[:, i] * factor**2, color=_color(label), label=label)
        square = f"({unit})²" if "/" in unit else f"{unit}²"
        axis.set(title=name, ylabel=f"{square} s/rad", xlabel="ω  rad/s")
        if len(places) > 1:
            axis.legend(frameon=False)
    axis.set_xlim(left=0)
    axis.set_ylim(bottom=0)


def _long_term(axis, result, panel):
    name, places = panel
    unit, factor = RAD.get(result.units[places[0]], (result.units[places[0]], 1.0))
    for i, label in zip(places, _labels(result, places), strict=True):
        term = result.long_term(result.names[i])
        x = np.linspace(0.0, term.level(1000 * YEAR), 200)
        axis.semilogy(x * factor, term.crossing_rate(x) * YEAR, color=_color(label), label=label)
    for years in (1, 50):
        axis.axhline(1 / years, color="0.5", linewidth=0.6, linestyle=":")
    axis.set(title=name, xlabel=unit, ylabel="times a year", ylim=(1e-3, None))
    axis.set_xlim(left=0)
    if len(places) > 1:
        axis.legend(frameon=False)


def _labels(result, places):
    """Axes of responses that share a panel; None for one alone"""
    return [result.names[i][-1] if len(places) > 1 else None for i in places]


def _color(label):
    return f"C{'xyz'.find(label or 'x')}"
