"""Picture of a fender: reaction and energy over its deflection, between softest and stiffest."""

import numpy as np

from ..common.picture import save
from ..common.units import KN


def draw(made, output):
    """made : `result.Pressed`"""
    from matplotlib.figure import Figure

    pair, bands, at, straight = made
    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axis = figure.add_subplot()
    x = np.linspace(0.0, pair.limit, 400)
    low, high = (one.loading(x) / KN for one in bands)
    axis.fill_between(x, low, high, alpha=0.15, label="softest to stiffest")
    axis.plot(x, pair.loading(x) / KN, label="loading")
    if np.any(pair.unloading(x) < pair.loading(x) * (1 - 1e-9)):
        axis.plot(x, pair.unloading(x) / KN, "--", label="unloading")
    axis.axvline(pair.rated * pair.height, color="grey", linewidth=0.8)
    axis.annotate("rated", (pair.rated * pair.height, 0), rotation=90, va="bottom", ha="right", color="grey")
    right = axis.twinx()
    right.plot(x, pair.energy(x) / KN, color="tab:green", label="energy")
    if straight is not None:
        axis.plot(x, straight.loading(x) / KN, ":", color="tab:blue", label="loading, not inclined")
        right.plot(x, straight.loading.integral(x) / KN, ":", color="tab:green", label="energy, not inclined")
    if at is not None:
        axis.plot([at], [float(pair.loading(at)) / KN], "o", color="black")
        right.plot([at], [float(pair.energy(at)) / KN], "o", color="tab:green")
    axis.set(xlabel="deflection, m", ylabel="reaction, kN", title=pair.name, xlim=(0, None), ylim=(0, None))
    right.set(ylabel="energy, kJ", ylim=(0, None))
    handles = [*axis.get_legend_handles_labels()[0], *right.get_legend_handles_labels()[0]]
    axis.legend(handles=handles, loc="upper left")
    save(figure, output, 110)
