"""Picture of the waves around the units of a breakwater."""

import numpy as np

from ..common.picture import save


def draw_map(path, name, lee):
    """Write the map of a `Lee`; waves come from the bottom of the picture"""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context({"font.size": 9, "svg.fonttype": "none"}):
        figure = Figure(figsize=(9, 8), layout="constrained")
        axis = figure.subplots()
        top = max(1.0, np.ceil(10 * np.nanmax(lee.ratio)) / 10)
        levels = np.arange(0, top + 0.05, 0.1)
        filled = axis.contourf(lee.x, lee.y, lee.ratio, levels, cmap="viridis")
        drawn = axis.contour(lee.x, lee.y, lee.ratio, levels[::2], colors="w", linewidths=0.6)
        axis.clabel(drawn, fmt="%.1f", fontsize=8)
        for middle in lee.units:
            corner = middle - lee.half
            axis.add_patch(matplotlib.patches.Rectangle(corner, *(2 * lee.half), color="k"))
        figure.colorbar(filled, ax=axis, label="height over incident wave height", shrink=0.8)
        axis.set(aspect="equal", xlabel="x  m, along the row", ylabel="y  m, to leeward")
        axis.set_title(lee.waves, loc="left", fontsize=9)
        figure.suptitle(name, x=0.01, ha="left", fontsize=11)
        save(figure, path, 130)
