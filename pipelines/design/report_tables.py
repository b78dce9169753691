"""Tables of a report as CSV: load cases, criteria, results of fenders, anchors and waves, with their origin."""

import csv
import io

import numpy as np

from hakobune.meshing.seals import write_sealed
from hakobune.mooring.criteria import verdict as of

from .fatigue import QUANTITY as FATIGUE
from .kinds.needs import ANCHOR, EXCURSION, SCOPE
from .running import excursion, worst_of

H5 = {of.PRETENSION: "tension.at_rest", of.HOLDING: "anchor.largest_horizontal"}
KEPT = {of.PRETENSION: "pretension", of.HOLDING: "horizontal", of.PARTIAL: "mean, values.largest", SCOPE: "length"}
OF_PROJECT = {"service life": "project.service_life", "return period": "project.service_life, project.probability"}
WORDS = {True: "met", False: "not met", None: "not judged"}
CASE_HEAD = (
    "case", "state", "level", "incidence_deg", "lost", "motion_factor", "x_m", "y_m", "yaw_deg", "excursion_m",
    "largest_tension_N",
    "line", "of_breaking_load", "horizontal_at_anchor_N", "uplift_at_anchor_N", "fault",
)  # fmt: skip
HEAD = (
    "rule", "edition", "quantity", "sense", "limit", "unit", "state", "lines", "analysis", "value", "utilisation",
    "met", "case", "item", "missing", "source", "status",
)  # fmt: skip


PART_HEAD = "case", "quantity", "of", "value"


def write_tables(name, verdict, folder):
    """Write cases.csv, criteria.csv and, if not empty, parts.csv; returns their names."""
    tables = {
        "cases.csv": (f"load cases of {name}", CASE_HEAD, [case_row(one) for one in verdict.ran]),
        "criteria.csv": (f"criteria of {name}", HEAD, _criterion_rows(verdict)),
    }
    parts = list(part_rows(verdict))
    if parts:
        tables["parts.csv"] = (f"fenders, anchors and waves in the load cases of {name}", PART_HEAD, parts)
    for file, (title, head, rows) in tables.items():
        _write_table(folder / file, title, head, rows)
    return tuple(tables)


def part_rows(verdict):
    """Return rows (case, quantity, part, value)"""
    for one in verdict.ran:
        for quantity, values in one.numbers.parts.items() if one.numbers else ():
            for item, value in values.items():
                yield one.case.name, quantity, item, float(value)


def case_row(one):
    """Values of CASE_HEAD"""
    case, r = one.case, one.numbers
    head = case.name, case.state, case.level, case.incidence, case.lost, case.factor
    if r is None:
        return (*head, *[""] * 9, one.fault)
    x, y, turn = farthest(r)[1]
    if not r.names:
        return (*head, x, y, np.degrees(turn), excursion(one), *[""] * 5, "")
    worst = r.names.index(worst_of(one))
    share = one.largest[worst] / r.breaking[worst]
    return (
        *head,
        x,
        y,
        np.degrees(turn),
        excursion(one),
        one.largest[worst],
        r.names[worst],
        share if np.isfinite(r.breaking[worst]) else np.nan,
        *one.at_anchors.max(axis=1),
        "",
    )


def farthest(numbers):
    """Name of the body that steady loads move farthest ("" for a single body), and its position (3,), m, m, rad"""
    places = np.reshape(numbers.place, (-1, 3))
    number = int(np.hypot(*places[:, :2].T).argmax())
    return numbers.bodies[number] if numbers.bodies else "", places[number]


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


def origin(read, ran, criterion):
    """Origin of a criterion's value in a load case (Ran): path of a file, or None for a value given in the project;
    and its key there
    """
    quantity, path = criterion.quantity, ran.path
    if quantity == ANCHOR:
        return (
            (path, "anchor") if ran.runs is None else (beside_of(path, "_runs_extremes"), "values.horizontal, uplift")
        )
    if quantity in OF_PROJECT:
        return None, OF_PROJECT[quantity]
    if any(one.quantity == quantity for one in read.project.values):
        return None, "values"
    if ran.case.apart:
        return path, f"values.parts.{quantity}"
    tension = quantity in of.OF_TENSIONS
    beside = {name: beside_of(path, name) for name in ("_numbers", "_runs_numbers", "_runs_extremes")}
    if not read.kind.MOVED:
        return beside["_numbers"], _kept(quantity, tension)
    if ran.runs is None:
        moved = "line.length" if quantity == SCOPE else "motion.amplitude"
        return path, H5.get(quantity, "tension.largest" if tension else moved)
    at_berth = beside["_runs_numbers"].is_file()
    if quantity in (of.PRETENSION, SCOPE) and not at_berth:
        return path, "tension.at_rest" if quantity == of.PRETENSION else "line.length"
    if quantity in (of.PRETENSION, SCOPE) or quantity in ran.numbers.parts:
        return beside["_runs_numbers"], _kept(quantity, tension)
    if quantity == EXCURSION:
        return beside["_runs_extremes"], "values.excursion"
    if quantity == FATIGUE:
        return beside["_runs_extremes"], "values.cycles"
    moved = "values.ranges" if criterion.statistic == "peak to peak" else "values.motions"
    return beside["_runs_extremes"], _kept(quantity, True) if tension else moved


def beside_of(path, name):
    """Path of the JSON file `name` of a load case, beside the path of its result"""
    return path.with_name(f"{path.stem}{name}.json")


def _kept(quantity, tension):
    return f"values.{KEPT.get(quantity, 'largest' if tension else f'parts.{quantity}')}"
