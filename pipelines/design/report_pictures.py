"""Pictures of a report as addresses of data: plans of the cases that govern, the body's curves, what is used."""

from __future__ import annotations

from ..common.picture import data_address

MOST_PLANS = 4


def plans(read, verdict, paths):
    """{"name", "data"} of the cases that govern, the worst first"""
    by_name = {one.case.name: one for one in verdict.ran}
    judged = sorted((one for one in verdict.judged if one.governing), key=lambda one: -one.governing.utilisation)
    for name in list(dict.fromkeys(one.governing.case for one in judged))[:MOST_PLANS]:
        one = by_name[name]
        known = one.case.study, paths[one.case.level], one.numbers
        yield {"name": name, "data": data_address(lambda path, known=known: read.kind.draw(*known, path))}


def body_picture(db):
    """Coefficients, forces and responses of a database"""
    from ..view.plots import plot

    return data_address(lambda path: plot(db, path))


def use_picture(verdict):
    """What is used of each criterion, as bars"""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from ..common.picture import save

    judged = [one for one in verdict.judged if one.governing]

    def draw(path):
        figure = Figure(figsize=(9, 0.8 + 0.34 * len(judged)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
        used = [100 * min(one.governing.utilisation, 3.0) for one in judged]
        names = [_short(one.criterion) for one in judged]
        colours = ["#b03030" if one.met is False else "#3f7f4f" for one in judged]
        axes.barh(range(len(judged)), used, color=colours)
        axes.axvline(100, color="k", lw=1)
        for i, (one, width) in enumerate(zip(judged, used, strict=True)):
            axes.annotate(f" {100 * one.governing.utilisation:.0f} %", (width, i), va="center", fontsize=8)
        axes.set_yticks(range(len(judged)), names, fontsize=8)
        axes.invert_yaxis()
        axes.set(xlabel="utilisation of the criterion, %", xlim=(0, max(115.0, 1.12 * max(used, default=0.0))))
        save(figure, path, 130)

    return data_address(draw)


def _short(c):
    parts = [c.rule, c.quantity]
    parts += [c.state] if c.state != "any" else []
    parts += [c.lines] if c.lines != "any" else []
    return ", ".join(parts)
