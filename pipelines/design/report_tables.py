"""Tables of a report as CSV: load cases, criteria, and what of fenders, anchors and waves they find."""

from __future__ import annotations

import csv
import io

import numpy as np

from hakobune.meshing.seals import write_sealed

from .running import worst_of

WORDS = {True: "met", False: "not met", None: "not judged"}
CASE_HEAD = (
    "case", "state", "level", "incidence_deg", "lost", "motion_factor", "x_m", "y_m", "yaw_deg", "largest_tension_N",
    "line", "of_breaking_load", "horizontal_at_anchor_N", "uplift_at_anchor_N", "fault",
)  # fmt: skip
HEAD = (
    "rule", "edition", "quantity", "sense", "limit", "unit", "state", "lines", "analysis", "value", "utilisation",
    "met", "case", "item", "missing", "source", "status",
)  # fmt: skip


PART_HEAD = "case", "quantity", "of", "value"


def write_tables(name, verdict, folder):
    """Write cases.csv, criteria.csv and, where there are such, parts.csv; returns their names."""
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
    """(case, quantity, of what, value)"""
    for one in verdict.ran:
        for quantity, values in one.numbers.parts.items() if one.numbers else ():
            for item, value in values.items():
                yield one.case.name, quantity, item, float(value)


def case_row(one):
    """Values of CASE_HEAD"""
    case, r = one.case, one.numbers
    head = case.name, case.state, case.level, case.incidence, case.lost, case.factor
    if r is None:
        return (*head, *[""] * 8, one.fault)
    x, y, turn = r.place
    if not r.names:
        return (*head, x, y, np.degrees(turn), *[""] * 5, "")
    worst = r.names.index(worst_of(one))
    share = one.largest[worst] / r.breaking[worst]
    return (
        *head,
        x,
        y,
        np.degrees(turn),
        one.largest[worst],
        r.names[worst],
        share if np.isfinite(r.breaking[worst]) else np.nan,
        *one.at_anchors.max(axis=1),
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
