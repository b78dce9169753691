"""Picture of a sea: its spectrum, with the estimate from a record, and the record."""

import numpy as np

from ..common.picture import save
from .result import curve

SHOWN = 600.0  # s of the record that are drawn large enough to be read


def draw(found, path):
    """Write the picture of Findings to `path`; returns the matplotlib figure."""
    import matplotlib
    from matplotlib.figure import Figure

    rows = 1 if found.record is None else 3
    with matplotlib.rc_context({"font.size": 9, "svg.fonttype": "none"}):
        figure = Figure(figsize=(10, 5 if rows == 1 else 9), layout="constrained")
        grid = figure.subplots(rows, 1, squeeze=False, height_ratios=[3, 1, 1][:rows])[:, 0]
        _draw_spectrum(grid[0], found)
        if found.record is not None:
            _draw_record(grid[1], found.record, len(found.record.elevation))
            _draw_record(grid[2], found.record, int(SHOWN / found.record.step))
            grid[1].set_title(f"record and its first {min(SHOWN, found.record.time[-1]):g} s", loc="left", fontsize=9)
        for axis in grid:
            axis.grid(True, color="0.9", linewidth=0.6)
            axis.spines[["top", "right"]].set_visible(False)
        figure.suptitle(found.title, x=0.01, ha="left", fontsize=11)
        save(figure, path, 130)
    return figure


def _draw_spectrum(axis, found):
    spectrum, estimate = found.spectrum, found.estimate
    if estimate is not None:
        low, high = estimate.confidence(0.95)
        axis.fill_between(estimate.omega, low, high, color="C0", alpha=0.2, linewidth=0, label="95 % confidence")
        label = f"estimate, {estimate.degrees_of_freedom:.0f} degrees of freedom"
        axis.plot(estimate.omega, estimate.density, color="C0", linewidth=0.9, label=label)
    if not found.analysed:
        axis.plot(*curve(spectrum), color="k", linewidth=1.4, label=spectrum.name)
    for symbol, color in (("Tp", "C3"), ("T01", "C2"), ("T02", "C1")):
        period = getattr(spectrum, symbol)
        axis.axvline(2 * np.pi / period, color=color, linewidth=0.8, linestyle=":", label=f"{symbol} {period:.4g} s")
    axis.set(xlim=(0, spectrum.quantile(0.995)), ylim=(0, None), xlabel="ω  rad/s", ylabel="S(ω)  m² s/rad")
    axis.set_title(f"4√m₀ = {spectrum.significant_height:.4g} m", loc="left", fontsize=9)
    axis.legend(frameon=False)


def _draw_record(axis, record, count):
    axis.plot(record.time[:count], record.elevation[:count], color="C0", linewidth=0.6)
    axis.axhline(0, color="0.6", linewidth=0.6)
    axis.set(xlim=(record.time[0], record.time[:count][-1]), xlabel="t  s", ylabel="η  m")
