"""A picture of a sweep: quantities over the first key, a line for each value of the other keys."""

import numpy as np

from ..common.picture import save
from ..results.quantity import read_in

MOST = 12  # quantities, and lines in each


def draw(result, path):
    """Draw the printed quantities of a sweep.  Raises ValueError if the first key has no numbers."""
    from matplotlib.figure import Figure

    keys = [name for name in result.quantities if name.startswith("keys.")]
    first, others = result.quantities[keys[0]], keys[1:]
    if not first.numeric:
        raise ValueError(f"{keys[0]} has no numeric values for the horizontal axis; put a numeric key first")
    shown = [n for n, one in result.quantities.items() if one.table and n not in keys and one.axes == ("case",)][:MOST]
    columns = min(2, len(shown)) or 1
    rows = -(-len(shown) // columns) or 1
    figure = Figure(figsize=(5.5 * columns, 3.4 * rows), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    groups = _groups(result, others)
    for axis, name in zip(axes, shown, strict=False):
        one = result.quantities[name]
        unit, size = read_in(one.units()[0], np.abs(one.values), one.share)
        for words, chosen in list(groups.items())[:MOST]:
            order = chosen[np.argsort(first.values[chosen])]
            axis.plot(first.values[order], one.values[order] / size, ".-", label=words)
        axis.set(xlabel=keys[0].removeprefix("keys."), ylabel=f"{one.description}, {unit}" if unit else one.description)
        axis.grid(alpha=0.3)
    for axis in axes[len(shown) :]:
        axis.remove()
    if others and shown:
        axes[0].legend(fontsize="small")
    save(figure, path, 110)


def _groups(result, others):
    """{words of the other keys: indices of the cases}"""
    found = {}
    for case in range(len(result["status"])):
        words = ", ".join(f"{name.removeprefix('keys.')} {result[name][case]}" for name in others)
        found.setdefault(words, []).append(case)
    return {words: np.array(cases) for words, cases in found.items()}
