"""Picture of a breakwater: transmission and tensions over period with measurements, the section, the sea behind."""

import numpy as np

from hakobune.mooring.studies.breakwater.breakwater import KN
from hakobune.mooring.studies.breakwater.curves import response
from hakobune.mooring.studies.breakwater.natural import around

from ..common.picture import save

COLORS = {"fixed": "k", "free": "C2", "taut": "C0", "elastic": "C1"}


def draw(path, study, breakwater, found, measured):
    """Write the picture of Results; study : BreakwaterStudy; measured : columns of `measured`, or None"""
    import matplotlib
    from matplotlib.figure import Figure

    period = around(breakwater.waves.period, found.natural)
    curves = [
        one._replace(response=response(breakwater, one.holding, one.theory, 0.0, 2 * np.pi / period))
        for one in found.curves
    ]
    with matplotlib.rc_context({"font.size": 9, "svg.fonttype": "none"}):
        wide = found.front is not None
        figure = Figure(figsize=(16 if wide else 11, 8), layout="constrained")
        grid = figure.subplots(2, 3 if wide else 2)
        _transmission(grid[0, 0], curves, period, measured)
        _tensions(grid[0, 1], curves, period, measured)
        _sea(grid[1, 0], found.sea)
        _section(grid[1, 1], breakwater)
        if wide:
            _front(grid[:, 2], study, found.front)
        for axis in (*grid[0], grid[1, 0], *grid[1, 2:]):
            axis.grid(True, color="0.9", linewidth=0.6)
            axis.spines[["top", "right"]].set_visible(False)
        figure.suptitle(study.name, x=0.01, ha="left", fontsize=11)
        save(figure, path, 130)


def _style(curve):
    return {"color": COLORS[curve.holding], "linestyle": "-" if curve.name == curve.holding else "--", "linewidth": 1.3}


def _transmission(axis, curves, period, measured):
    for curve in curves:
        axis.plot(period, abs(curve.response.transmission), label=curve.name, **_style(curve))
    if measured is not None:
        axis.plot(measured["period_s"], measured["transmission"], "o", color="C3", markersize=4, label="measured")
    axis.set(xlim=period[[0, -1]] if len(period) > 1 else None, ylim=(0, 1.05))
    axis.set(xlabel="period  s", ylabel="K_T")
    axis.set_title("transmission", loc="left", fontsize=9)
    axis.legend(frameon=False, fontsize=8)


def _tensions(axis, curves, period, measured):
    held = [curve for curve in curves if np.isfinite(curve.response.front).all()]
    if not held:
        _motions(axis, [curve for curve in curves if curve.response.heave.any()], period)
        return
    for curve in held:
        axis.plot(period, abs(curve.response.front) / KN, label=curve.name, **_style(curve))
        axis.plot(period, abs(curve.response.back) / KN, alpha=0.45, **_style(curve))
    for name, marker in (("front", "o"), ("back", "s")):
        if measured is not None and f"{name}_kN_per_m2" in measured:
            pulls = measured[f"{name}_kN_per_m2"]
            axis.plot(measured["period_s"], pulls, marker, color="C3", markersize=4, label=f"measured, {name}")
    axis.set(xlabel="period  s", ylabel="kN/m per m of amplitude")
    axis.set_title("tension amplitude (back line paler)", loc="left", fontsize=9)
    axis.legend(frameon=False, fontsize=8, ncols=2, loc="upper right")
    axis.set_ylim(0, 1.35 * axis.get_ylim()[1])


def _motions(axis, moving, period):
    """Heave and sway of what floats without lines"""
    if not moving:
        axis.set_axis_off()
        return
    for curve in moving:
        axis.plot(period, abs(curve.response.heave), label=f"{curve.name}, heave", **_style(curve))
        axis.plot(period, abs(curve.response.sway), label=f"{curve.name}, sway", alpha=0.45, **_style(curve))
    axis.set(xlabel="period  s", ylabel="m per m of amplitude", ylim=(0, None))
    axis.set_title("motions", loc="left", fontsize=9)
    axis.legend(frameon=False, fontsize=8)


def _sea(axis, sea):
    if sea is None:
        axis.set_axis_off()
        return
    density = sea.cells.energy / sea.cells.width
    axis.plot(sea.cells.omega, density, color="0.4", linewidth=1.6, label=f"in front, {sea.cells.height:.3g} m")
    for name, K in sea.transmission.items():
        kind = name.partition(",")[0]
        style = {"color": COLORS[kind], "linestyle": "--" if "," in name else "-"}
        axis.plot(sea.cells.omega, K**2 * density, linewidth=1.1, label=f"{name}, {sea.heights[name]:.3g} m", **style)
    axis.set(xlabel="ω  rad/s", ylabel="S(ω)  m² s/rad", ylim=(0, None))
    axis.set_xlim(0, sea.cells.omega[np.searchsorted(np.cumsum(sea.cells.energy), 0.99 * sea.cells.energy.sum())])
    axis.set_title("sea in front and behind", loc="left", fontsize=9)
    axis.legend(frameon=False, fontsize=8)


def _section(axis, breakwater):
    outline, depth = breakwater.outline, breakwater.depth(0.0)
    points = np.concatenate([edge.at(np.linspace(0, 1, 60)) for edge in outline.edges])
    points = points - 1j * (outline.bottom + breakwater.draft(0.0))
    axis.fill(points.real, points.imag, color="0.8", edgecolor="k", linewidth=1)
    wide = 2.0 * max(abs(points.real).max(), depth / 2)
    lines = breakwater.lines
    if lines is not None:
        top = -breakwater.draft(0.0) + lines.attachment_height
        way = breakwater.line * np.exp(-1j * breakwater.angle)
        for side in (1, -1):
            axis.plot(
                [side * lines.attachment, side * (lines.attachment + way.real)], [top, top + way.imag], color="C0"
            )
        wide = max(wide, 1.2 * (lines.attachment + abs(way.real)))
    for rise in {rise for _, rise in breakwater.levels}:
        axis.axhline(rise, color="C0", linewidth=1.2 if rise == 0 else 0.6, zorder=0)
    axis.axhspan(-depth * 1.1, -depth, color="0.6", linewidth=0)
    axis.set(xlim=(-wide, wide), ylim=(-1.1 * depth, None), aspect="equal", xlabel="y  m, to leeward", ylabel="z  m")


def _front(axes, study, front):
    """Best designs: the transmitted wave over tension, and their values, each range from 0 to 1"""
    axes[0].plot(front.tension / KN, front.behind, "o-", color="C4", markersize=4)
    if study.optimisation.behind is not None:
        axes[0].axhline(study.optimisation.behind, color="C3", linewidth=0.8, label="wanted")
        axes[0].legend(frameon=False, fontsize=8)
    axes[0].set(xlabel="greatest tension  kN/m", ylabel="K_T, greatest" if study.sea is None else "4√m₀ behind  m")
    axes[0].set_title(f"best of {front.trials} designs", loc="left", fontsize=9)
    for name, values in zip(front.names, front.designs.T, strict=True):
        low, high = getattr(study.optimisation, name)
        label = f"{name}, {low:g} to {high:g}"
        axes[1].plot(front.tension / KN, (values - low) / (high - low), "o-", markersize=3, linewidth=1, label=label)
    axes[1].set(xlabel="greatest tension  kN/m", ylabel="part of the range", ylim=(-0.02, 1.25))
    axes[1].legend(frameon=False, fontsize=8, loc="upper left")
