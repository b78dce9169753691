"""The report of a project: one page that needs nothing else, and its tables as CSV.

Nothing of it depends on when or where it is made: the same inputs give the same report.
"""

from __future__ import annotations

import csv
import io
from importlib.resources import files

import numpy as np

from meshing.seals import write_sealed
from meshing.whole_files import write_whole

from ..common.picture import data_address
from .checklist import checklist
from .equipment import equipment
from .project import MEAN, versions
from .verdict import FAILS, OPEN, PASSES

CSS = {PASSES: "passes", FAILS: "fails", OPEN: "open"}
WORDS = {True: "met", False: "not met", None: "not judged"}
MARK = {True: "passes", False: "fails", None: "open"}
MOST_PLANS = 4
SIMPLIFIED = (
    "The largest motions are those of the free body, lines follow them by statics (SR179 report, 1982, 5.1.1), slow "
    "drift is not in the method. Where a natural period lies near the waves, give the project [simulation]."
)
IN_TIME = (
    "Tensions and motions are those of simulations in time with lines in their static form; findings above are of the "
    "simplified method, which was run beside them."
)
SOURCES = "Tensions are lines/maximum_tension of its file, offsets equilibrium, motions motion_amplitude."
IN_TIME_SOURCES = (
    "Tensions and motions are the extremes in the file of its runs, NAME_runs.h5; offset, yaw and forces at the anchor "
    "in this table are of the simplified method, in NAME.h5."
)


def write_report(read, verdict, advice, paths, folder):
    """Write report.html, cases.csv and criteria.csv into a folder; returns their names.

    verdict : of `judged_project`; advice : of `advise`, or None; paths : {level: database}
    """
    from jinja2 import Environment, StrictUndefined

    template = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    page = environment.from_string(template).render(**_context(read, verdict, advice, paths, folder))
    write_whole(folder / "report.html", page)
    _write_table(folder / "cases.csv", f"load cases of {read.project.project.name}", CASE_HEAD, _case_rows(verdict))
    _write_table(folder / "criteria.csv", f"criteria of {read.project.project.name}", HEAD, _criterion_rows(verdict))
    return "report.html", "cases.csv", "criteria.csv"


CASE_HEAD = (
    "case", "state", "level", "incidence_deg", "lost", "motion_factor", "x_m", "y_m", "yaw_deg", "largest_tension_N",
    "line", "of_breaking_load", "horizontal_at_anchor_N", "uplift_at_anchor_N", "fault",
)  # fmt: skip
HEAD = (
    "rule", "edition", "quantity", "sense", "limit", "unit", "state", "lines", "analysis", "value", "utilisation",
    "met", "case", "item", "missing", "source", "status",
)  # fmt: skip


def summary(verdict):
    """What governs, in a line after "the mooring passes" """
    worst = _worst(verdict)
    if verdict.word == OPEN:
        unknown = sum(one.met is None for one in verdict.judged)
        failed = sum(one.result is None for one in verdict.ran)
        return f": {unknown} criteria are not judged, {failed} load cases could not be run"
    if worst is None:
        return ""
    use, criterion = worst.governing, worst.criterion
    return (
        f": {100 * use.utilisation:.0f} % of {criterion.name}, {criterion.quantity} {criterion.sense} "
        f"{criterion.limit:.4g}, is used by {use.item} in “{use.case}”"
    )


def advice_words(advice):
    """What to change, in a sentence; "" without advice"""
    if advice is None:
        return ""
    names = ", ".join(f"{kind} for {name}" for name, kind in advice.changed.items())
    used = f"{100 * advice.utilisation:.0f} % of the criterion that governs"
    if advice.passes:
        return f"The smallest change of size that passes, run in the cases that govern: {names}; it uses {used}."
    return f"No larger size of those tried passes; the best is {names}, which uses {used}. Take more lines."


def _worst(verdict):
    found = [one for one in verdict.judged if one.governing is not None]
    return max(found, key=lambda one: one.governing.utilisation, default=None)


def _context(read, verdict, advice, paths, folder):
    from bem.database import open_database

    own, db = read.project.project, open_database(paths[MEAN])
    links = {one.case.name: _link(one, folder) for one in verdict.ran}
    return {
        "name": own.name,
        "note": own.note,
        "word": verdict.word,
        "word_class": CSS[verdict.word],
        "summary": summary(verdict),
        "advice": advice_words(advice),
        "levels": [
            {
                "name": name,
                "depth": f"{read.study['water']['depth'] + read.project.level(name):g}",
                "link": _relative(path, folder),
            }
            for name, path in paths.items()
        ],
        "return_period": _return_words(own, verdict),
        "states": [_state_row(state) for state in read.project.states],
        "body": _body_words(db),
        "checks": _checks(paths),
        "lines": _line_rows(verdict),
        "criteria": [_criterion(one, links) for one in verdict.judged],
        "cases": [_case(one, links) for one in verdict.ran],
        "rule_sets": [_rule_set(one) for one in verdict.rule_sets],
        "checklist": [
            (one.text, WORDS[one.met] if one.met is not None else "does not apply", MARK[one.met], one.how)
            for one in checklist(read)
        ],
        "equipment": [(society, f"{number:.0f}") for society, number in _equipment(read, db)],
        "plans": _plans(verdict, paths),
        "pictures": {"body": _body_picture(db), "use": _use_picture(verdict)},
        "warnings": _warnings(verdict),
        "method": IN_TIME if read.project.simulation else SIMPLIFIED,
        "sources": IN_TIME_SOURCES if read.project.simulation else SOURCES,
        "inputs": {"project": read.text, "study": read.study_text, "scene": _scene_text(read)},
        "versions": ", ".join(f"{name} {version}" for name, version in versions().items()),
    }


def _link(one, folder):
    return _relative(one.path, folder)


def _relative(path, folder):
    import os

    return os.path.relpath(path, folder).replace(os.sep, "/")


def _return_words(own, verdict):
    if verdict.return_period is None:
        return ""
    return (
        f"A value that is not exceeded in {own.service_life:g} years with probability {own.probability:g} has a return "
        f"period of {verdict.return_period:.0f} years."
    )


def _state_row(state):
    def stream(table):
        if table is None:
            return "none"
        return f"{table.speed:g} m/s" if table.speed is not None else f"{table.speed_knots:g} knots"

    waves = "none" if state.waves is None else f"{state.waves.height:g} m, {state.waves.period:g} s"
    angles = ", ".join(f"{angle:g}" for angle in state.incidence_deg)
    for name, offs in (("wind", state.wind_off_deg), ("current", state.current_off_deg)):
        if offs != [0.0]:
            angles += f"; {name} off by {', '.join(f'{off:g}' for off in offs)}"
    lines = "intact and one lost" if "one lost" in state.lines else "intact"
    levels = ", ".join(state.levels)
    return state.name, state.state, stream(state.wind), stream(state.current), waves, angles, levels, lines


def _body_words(db):
    sizes = ", ".join(f"{name} {value:g} m" for name, value in db.dimensions.items())
    return f"{sizes or 'a body from a mesh file'}; {len(db.omega)} frequencies, {len(db.wave_direction)} headings."


def _checks(paths):
    """What the checks of the databases say, a line each"""
    from bem.database import open_database

    from ..solve.report import checked

    for level, path in paths.items():
        for one in checked(open_database(path)):
            if not one.passed:
                text = f"{level}: {one.name} is {one.largest:.2g} at ω {one.omega:.3g} rad/s; limit {one.limit:g}"
                yield {"css": "fails", "text": text}
    text = "Checked: reciprocity, Haskind, energy, residual, estimated errors; limits as stored."
    yield {"css": "source", "text": text}


def _line_rows(verdict):
    one = next((one for one in verdict.ran if one.result is not None), None)
    if one is None:
        return []
    rows = []
    for i, table in enumerate(one.case.study["lines"]):
        kinds = [table["type"]] if "type" in table else [part["type"] for part in table["segments"]]
        numbers = one.result
        broken = numbers["breaking_load"][i]
        rows.append(
            (
                table["name"],
                f"{numbers['length'][i]:.4g}",
                ", ".join(kinds),
                ", ".join(f"{x:.4g}" for x in table["fairlead"]),
                ", ".join(f"{x:.5g}" for x in table["anchor"]),
                f"{numbers['pretension'][i] / 1e3:.4g}",
                f"{broken / 1e3:.5g}" if np.isfinite(broken) else "not given",
            )
        )
    return rows


def _criterion(one, links):
    c, use = one.criterion, one.governing
    factors = f"{c.limit:.4g}" if c.second is None else f"{c.limit:.4g}, {c.second:.4g}"
    for_ = ", ".join(
        word
        for word, skip in ((c.state, "any"), (f"lines {c.lines}", "lines any"), (c.statistic, ""), (c.subject, ""))
        if word != skip
    )
    unverified = "" if c.status == "read" else f" ({c.status})"
    found = {
        "words": f"{c.name}: {c.quantity} {c.sense} {factors}{'' if c.unit in ('', '-') else ' ' + c.unit}; {for_}",
        "source": f"{c.source}{unverified}",
        "limit": factors,
        "verdict": WORDS[one.met],
        "css": MARK[one.met],
        "missing": one.missing,
        "value": "",
        "used": "",
        "link": "",
        "case": "",
        "item": "",
    }
    if use is not None:
        found |= {
            "value": f"{use.value:.4g}",
            "used": f"{100 * use.utilisation:.0f} %",
            "case": use.case,
            "item": use.item,
        }
        found["link"] = links.get(_with_factor(use.case, c.motion_factor), links[use.case])
    return found


def _rule_set(one):
    c, use = one.criterion, one.use
    limit = f"{c.quantity} {c.sense} {c.limit:.4g}"
    unread = f"{one.unread} of them not read in the book" if one.unread else ""
    return {
        "cells": (one.name, one.subject, "judges" if one.chosen else "", f"{one.judged} of {one.known}", limit),
        "used": f"{100 * use.utilisation:.0f} %",
        "css": MARK[use.utilisation <= 1],
        "by": f"{use.item}, {use.case}",
        "unread": unread,
    }


def _equipment(read, db):
    freeboard = read.study.get("hull", {}).get("freeboard")
    return equipment(db.dimensions, freeboard, db.density * db.mesh.whole().volume)


def _with_factor(name, factor):
    """Name of the load case with `factor` times the motions, where it is a case of its own"""
    return name if factor == 1 else f"{name}, motions x {factor:g}"


def _case(one, links):
    row = dict(zip(CASE_HEAD, _case_row(one), strict=True))
    cells = []
    if one.result is not None:
        share = row["of_breaking_load"]
        cells = [
            f"{np.hypot(row['x_m'], row['y_m']):.2f}",
            f"{row['yaw_deg']:.2f}",
            f"{row['largest_tension_N'] / 1e3:.4g}",
            row["line"],
            "unknown" if np.isnan(share) else f"{100 * share:.0f} %",
            f"{row['horizontal_at_anchor_N'] / 1e3:.4g}",
            f"{max(row['uplift_at_anchor_N'], 0.0) / 1e3:.4g}",
        ]
    return {"name": one.case.name, "link": links[one.case.name], "fault": one.fault, "cells": cells}


def _case_rows(verdict):
    return [_case_row(one) for one in verdict.ran]


def _case_row(one):
    case, r = one.case, one.result
    head = case.name, case.state, case.level, case.incidence, case.lost, case.factor
    if r is None:
        return (*head, *[""] * 8, one.fault)
    worst = int(np.argmax(one.largest))
    x, y, turn = r["equilibrium"]
    share = one.largest[worst] / r["breaking_load"][worst]
    return (
        *head,
        x,
        y,
        np.degrees(turn),
        one.largest[worst],
        r["names"][worst],
        share if np.isfinite(r["breaking_load"][worst]) else np.nan,
        r["maximum_horizontal_anchor_force"].max(),
        r["maximum_vertical_anchor_force"].max(),
        "",
    )


def _criterion_rows(verdict):
    for one in verdict.judged:
        c, use = one.criterion, one.governing
        found = (use.value, use.utilisation) if use else ("", "")
        where = (use.case, use.item) if use else ("", "")
        yield (
            c.rule, c.edition, c.quantity, c.sense, c.limit, c.unit, c.state, c.lines, c.analysis, *found,
            WORDS[one.met], *where, one.missing, c.source, c.status,
        )  # fmt: skip


def _write_table(path, title, head, rows):
    text = io.StringIO()
    text.write(f"# {title}\n")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(head)
    table.writerows([[f"{cell:.10g}" if isinstance(cell, float) else cell for cell in row] for row in rows])
    write_sealed(path, text.getvalue())


def _warnings(verdict):
    """Findings of the cases, each once, with the cases that have it"""
    found = {}
    for one in verdict.ran:
        for text in one.result["warnings"] if one.result else ():
            found.setdefault(text, []).append(one.case.name)
    for text, names in found.items():
        more = f" and {len(names) - 1} more" if len(names) > 1 else ""
        yield {"text": text, "cases": f"{names[0]}{more}"}


def _scene_text(read):
    scene = read.project.project.scene
    return "" if scene is None else (read.folder / scene).read_text(encoding="utf-8")


def _plans(verdict, paths):
    """Plans of the cases that govern, the worst first"""
    from bem.database import open_database

    from ..moor.command import studied
    from ..moor.plan_picture import draw_plan
    from ..moor.study import make_study

    by_name = {one.case.name: one for one in verdict.ran}
    judged = sorted((one for one in verdict.judged if one.governing), key=lambda one: -one.governing.utilisation)
    for name in list(dict.fromkeys(one.governing.case for one in judged))[:MOST_PLANS]:
        case = by_name[name].case
        result, hull = studied(make_study(case.study), open_database(paths[case.level]))
        yield {"name": name, "data": data_address(lambda path, r=result, h=hull: draw_plan(r, h, path))}


def _body_picture(db):
    from ..view.plots import plot

    return data_address(lambda path: plot(db, path))


def _use_picture(verdict):
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
