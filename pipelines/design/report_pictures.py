"""Pictures of a report as data addresses: plans of the governing cases, curves of the body, utilisations.

The pictures are stored in `pictures/` beside the report.
"""

import json
from pathlib import Path

import tomli_w

from .cases import file_name
from .kinds.stored import key_of, picture, plain
from .report_words import percent

MOST_PLANS = 4
ON_WHITE = {"boxstyle": "square,pad=0.05", "fc": "white", "ec": "none"}  # a number next to the line of 100 %


def plans(read, verdict, paths, folder):
    """[{"name", "data"}] of plans of the governing cases, the worst first"""
    for one in _governing(verdict)[:MOST_PLANS]:
        known = one.case.study, paths[one.case.level], one.numbers._replace(largest=one.largest)
        base = None if known[1] is None else Path(known[1])
        key = key_of(tomli_w.dumps(one.case.study), base, json.dumps(plain(known[2])))
        place = folder / "pictures" / f"{file_name(one.case)}.png"
        yield {
            "name": one.case.name,
            "data": picture(place, key, lambda path, known=known: read.kind.draw(*known, path)),
        }


def _governing(verdict):
    """[Ran] of the cases that govern a criterion, the worst first"""
    by_name = {one.case.name: one for one in verdict.ran}
    judged = sorted((one for one in verdict.judged if one.governing), key=lambda one: -one.governing.utilisation)
    names = dict.fromkeys(one.governing.case for one in judged)
    return [by_name[name] for name in names if not by_name[name].case.apart]


def records(verdict, folder):
    """{"name", "data"} of the first governing case in time, of each of several bodies: its records and watch circle"""
    from h5py import File

    from ..simulate.pictures import draw_one

    for one in [one for one in _governing(verdict) if one.runs is not None][:1]:
        stem = one.path.stem.removesuffix("_runs")
        runs = one.path.with_name(f"{stem}_runs.h5")
        for i, body in enumerate(one.numbers.bodies or [""]):
            for name in ("records", "offsets"):

                def draw(path, name=name, runs=runs, i=i):
                    with File(runs, "r") as file:
                        draw_one(file, name, path, i)

                place = folder / "pictures" / f"{stem}_{name}{f'_{i + 1}' if i else ''}.png"
                words = ", ".join(filter(None, (one.case.name, body, name)))
                yield {"name": words, "data": picture(place, key_of(name, runs), draw)}


def body_pictures(database, folder):
    """[{"name", "data"}] coefficients, forces and responses of a database, of each of several bodies"""
    from hakobune.bem.bodies.one_of_several import each_body
    from hakobune.bem.database import open_database

    from ..view.plots import ON_PAPER, plot

    key, db, found = key_of(Path(database)), open_database(database), []
    for i, one in enumerate(each_body(db)):
        name = one.name if db.bodies else ""
        place = folder / "pictures" / ("body.png" if i == 0 else f"body_{i + 1}.png")
        found.append({"name": name, "data": picture(place, key, lambda path, one=one: plot(one, path, ON_PAPER))})
    return found


def use_picture(verdict, folder):
    """Utilisation of each criterion, as bars"""
    judged = [one for one in verdict.judged if one.governing]
    names = [_short(one.criterion) for one in judged]
    names = [
        f"{name}, {one.criterion.subject}" if names.count(name) > 1 and one.criterion.subject else name
        for name, one in zip(names, judged, strict=True)
    ]
    shown = [(name, one.met, one.governing.utilisation) for name, one in zip(names, judged, strict=True)]

    def draw(path):
        from matplotlib.figure import Figure

        from ..common.picture import save

        figure = Figure(figsize=(9, 0.8 + 0.34 * len(judged)), layout="constrained")
        axes = figure.add_subplot()
        used = [100 * min(one.governing.utilisation, 3.0) for one in judged]
        names = [name for name, _, _ in shown]
        colours = ["#b03030" if met is False else "#3f7f4f" for _, met, _ in shown]
        axes.barh(range(len(judged)), used, color=colours)
        axes.axvline(100, color="k", lw=1)
        for i, (one, width) in enumerate(zip(judged, used, strict=True)):
            axes.annotate(f" {percent(one.governing.utilisation)}", (width, i), va="center", fontsize=8, bbox=ON_WHITE)
        axes.set_yticks(range(len(judged)), names, fontsize=8)
        axes.invert_yaxis()
        axes.set(xlabel="utilisation of the criterion, %", xlim=(0, max(115.0, 1.12 * max(used, default=0.0))))
        save(figure, path, 130)

    return picture(folder / "pictures" / "utilisation.png", key_of(json.dumps(shown)), draw)


def _short(c):
    parts = [c.rule, c.quantity]
    parts += [c.state] if c.state != "any" else []
    parts += [c.lines] if c.lines != "any" else []
    return ", ".join(parts)
