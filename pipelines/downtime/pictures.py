"""Pictures of downtime: months, years, the rose of directions, windows, waiting, and limiting seas."""

import numpy as np

from ..common.picture import save

COLOURS = "C0", "C1", "C2", "C3", "C4", "C5"
MOST = len(COLOURS)  # operations of a picture


def draw(result, path):
    """Draw all panels on one sheet, with the limiting sea of the first operation that has one"""
    figure = _figure((15, 8.4))
    spots = [figure.add_subplot(2, 3, place, polar=place in (3, 6)) for place in range(1, 7)]
    for panel, axes in zip((months, years, rose, persistence, waits), spots, strict=False):
        panel(result, axes)
    first = limited(result)
    if first:
        limiting(result, first[0], spots[5])
    else:
        spots[5].remove()
    spots[0].legend(fontsize="small")
    save(figure, path, 100)


def one_panel(panel, result, path, polar=False):
    """A single panel, as on the page"""
    figure = _figure((6.4, 5.0) if polar else (7.6, 3.6))
    axes = figure.add_subplot(polar=polar)
    panel(result, axes)
    if not polar:
        axes.legend(fontsize="small")
    save(figure, path, 100)


def _figure(size):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _operations(result):
    return list(enumerate(result.labels["operation"].values.tolist()))[:MOST]


def months(result, axes):
    """Share of each month with its interval"""
    _bars(result, axes, 100 * result["month.share"], 100 * result["month.low"], 100 * result["month.high"])
    between = ", with the 90 % interval between years" * bool(np.isfinite(result["month.low"]).any())
    axes.set(ylabel="downtime, %", title=f"by month{between}")
    axes.set_xticks(range(12), result.labels["month"].values)


def waits(result, axes):
    """Mean waiting time by month of arrival"""
    _bars(result, axes, result["wait.mean"], result["wait.low"], result["wait.high"])
    axes.set(ylabel="mean wait, h", title="waiting time for the window that each operation needs")
    axes.set_xticks(range(12), result.labels["month"].values)


def _bars(result, axes, value, low, high):
    operations = _operations(result)
    width = 0.8 / len(operations)
    for o, name in operations:
        place = np.arange(12) + (o - 0.5 * (len(operations) - 1)) * width
        axes.bar(place, value[:, o], width, color=COLOURS[o], alpha=0.75, label=name)
        if np.any(np.isfinite(low[:, o])):
            ends = [value[:, o] - low[:, o], high[:, o] - value[:, o]]
            axes.errorbar(place, value[:, o], ends, fmt="none", ecolor="0.25", elinewidth=0.9, capsize=2)
    axes.set_ylim(0, None)
    axes.grid(alpha=0.3, axis="y")


def years(result, axes):
    """Share of each year"""
    for o, name in _operations(result):
        axes.plot(result.labels["year"].values, 100 * result["year.share"][:, o], ".-", color=COLOURS[o], label=name)
        axes.axhline(100 * result["downtime.share"][o], color=COLOURS[o], lw=0.8, ls="--")
    axes.set(ylabel="downtime, %", title="by year", ylim=(0, None))
    axes.xaxis.get_major_locator().set_params(integer=True)
    axes.grid(alpha=0.3)


def rose(result, axes):
    """Hours per year by direction of the waves, over the share of time with that direction"""
    _compass(axes)
    operations, count = _operations(result), len(result.labels["sector"].values)
    at, width = np.arange(count) * 2 * np.pi / count, 1.6 * np.pi / count / len(operations)
    for o, name in operations:
        place = at + (o - 0.5 * (len(operations) - 1)) * width
        axes.bar(place, result["sector.hours"][:, o], width, color=COLOURS[o], alpha=0.75, label=name)
    axes.set_title("hours a year, by the direction that waves come from", fontsize="medium")


def persistence(result, axes):
    """Share of the time inside windows of at least the given number of hours"""
    for o, name in _operations(result):
        hours = result.labels["window"].values
        axes.plot(hours, 100 * result["window.share"][:, o], "o-", ms=4, color=COLOURS[o], label=name)
    axes.set(xlabel="window length, at least, h", ylabel="of the time, %", title="weather windows", xlim=(0, None))
    axes.grid(alpha=0.3)


def limited(result):
    """Indices of the operations with a limiting sea"""
    if "limiting.height" not in result:
        return []
    return [o for o, _ in _operations(result) if np.any(np.isfinite(result["limiting.height"][..., o]))]


def limiting(result, number, axes):
    """Significant height at which an operation stops, over period (radius) and direction that waves come from"""
    from matplotlib.ticker import MaxNLocator

    height = result["limiting.height"][..., number]
    period, angle = result.labels["period"].values, np.radians(result.labels["comes_from"].values)
    levels = MaxNLocator(9).tick_values(0.0, 2 * np.nanquantile(height, 0.25) + 1e-9)
    angle, height = np.append(angle, angle[0] + 2 * np.pi), np.concatenate([height, height[:, :1]], axis=1)
    _compass(axes)
    filled = axes.contourf(angle, period, np.ma.masked_invalid(height), levels, cmap="RdYlGn", extend="max")
    axes.set_ylim(0, period[-1])
    axes.figure.colorbar(filled, ax=axes, shrink=0.75, label="significant height, m")
    name = result.labels["operation"].values[number]
    axes.set_title(
        f"{name}: limiting sea\nradius: period, s; angle: the direction that waves come from\n"
        "white: not reached, or unknown",
        fontsize="medium",
    )


def _compass(axes):
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_thetagrids(range(0, 360, 45), ("N", "NE", "E", "SE", "S", "SW", "W", "NW"))
    axes.tick_params(labelsize=8)
