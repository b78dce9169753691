"""What a bench writes: a CSV of every row, and a Markdown page with the tables that are read."""

from __future__ import annotations

import csv
import io
import math

from hakobune.meshing.seals import write_sealed
from hakobune.meshing.whole_files import write_whole

from ...common.outputs import opening
from .cases import CASES, HEADING
from .measure import MORE, PASSES, SECONDS, Row
from .peers.repeated import SETTLE
from .ratios import FREQUENCIES, equal_panels, one_thread_and_two

LEVELS = (0.03, 0.01, 0.003, 0.001, 1e-4, 1e-5)
NOTES = (
    "error: largest of added mass, damping and excitation, relative to the largest value of that coefficient over "
    "the frequencies; coefficients below a hundredth of their kind left out; worst: which",
    "reference: cylinders exact, boxes by the contour method at 1e-7 (panels carried on to infinitely many agree to "
    "2e-4 to 4e-4)",
    f"ms: mean of five frequencies, {SETTLE:g} s after the first, each the least of {PASSES} passes, or as "
    f"many as {MORE:g} s hold, fewer if they take {SECONDS:g}: six radiating modes and one heading of "
    f"{HEADING:g} degrees; cpu: the same in processor time of all threads",
    "first: from the start of the process to the end of the first frequency, with what programs keep on disk there "
    "(cache full) or not (cache empty); body: that first frequency once everything is loaded, with what frequencies "
    f"share; all in: each of {FREQUENCIES} frequencies with its part of that; estimates of errors are made after all",
    "panel: each frequency alone, by its rotation on a cylinder, but where the commands share the work of these few "
    "(box, 944 panels); panel, band: work that frequencies share, with two planes",
    "memory: the most the process has held",
    "panels: on the whole hull; a lid besides, in every program; meshes of other programs are made beforehand",
    "jobs of one thread whose cpu is below 0.9 of their ms are measured again, up to twice: others had the core",
    "load, in the CSV: of the machine in the minute before",
)


def write_csv(path, rows, heading):
    """All rows, `heading` in # lines; an interrupted run leaves the old file"""
    text = io.StringIO()
    text.writelines(f"# {line}\n" for line in (*heading, *NOTES))
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(Row._fields)
    writer.writerows([_cell(value) for value in row] for row in rows)
    write_sealed(path, text.getvalue())


def is_rows(path):
    """Whether a file was made by `write_csv`"""
    return opening(path)[1].startswith(",".join(Row._fields[:3]) + ",")


def write_page(path, rows, heading, picture):
    """The Markdown page"""
    parts = ["# Error against time", "\n".join(f"- {line}" for line in (*heading, *NOTES)), f"![curves]({picture})"]
    parts += ["## ms per frequency until within", _table(*_reached(rows))]
    for title, table in (("Equal panels", equal_panels(rows)), ("One thread and two", one_thread_and_two(rows))):
        parts += [f"## {title}", _table(table[0], map(_rounded, table[1]))] if table[1] else []
    cold = [row for row in rows if row.cache == "empty" and not row.note]
    if cold:
        parts += ["## First frequency with nothing on disk", _table(*_cold(cold, rows))]
    for case in CASES.values():
        mine = [row for row in rows if row.case == case.name and row.cache == "full" and not row.note]
        if mine:
            parts += [f"## {case.title[0].upper()}{case.title[1:]}", _table(*_measured(mine))]
    failed = [f"- {row.case}, {row.program} {row.settings}, {_asked(row)}: {row.note}" for row in rows if row.note]
    parts += ["## Failed", "\n".join(failed)] if failed else []
    write_whole(path, "\n\n".join(parts) + "\n")


def least_ms(rows, level):
    """Smallest ms per frequency among rows within an error; None where no row is"""
    within = [row.warm_ms for row in rows if row.error <= level]
    return min(within, default=None)


def _reached(rows):
    """Header and lines: the best settings of every program, at each level"""
    rows = [row for row in rows if row.cache == "full" and not row.note]
    groups = sorted({(_place(row.case), row.threads, *_program(row), row.case) for row in rows})
    header = ("case", "threads", "program", *(f"{level:.0e}" for level in LEVELS))
    lines = []
    for _, threads, order, name, case in groups:
        mine = [r for r in rows if (r.case, r.threads, _program(r)) == (case, threads, (order, name))]
        lines.append((case, threads, name, *(_ms(least_ms(mine, level)) for level in LEVELS)))
    return header, lines


def _cold(cold, rows):
    header = ("case", "program", "settings", "asked", "first s, cache empty", "cache full", "MB, cache empty")
    lines = []
    for row in cold:
        same = [r for r in rows if r[:4] == row[:4] and r.threads == row.threads and r.cache == "full"]
        warm = f"{same[0].first_s:.2f}" if same else ""
        lines.append((row.case, row.program, row.settings, _asked(row), f"{row.first_s:.1f}", warm,
                      f"{row.memory_mb:.0f}"))  # fmt: skip
    return header, lines


def _measured(rows):
    header = ("program", "settings", "asked", "panels", "threads", "error", "of", "estimate", "ms", "cpu ms",
              "body ms", "first s", "MB")  # fmt: skip
    lines = [
        (
            *(row.program, row.settings, _asked(row), row.panels or "", row.threads),
            *(f"{row.error:.1e}", row.worst, "" if math.isnan(row.estimate) else f"{row.estimate:.1e}"),
            *(_ms(value) for value in (row.warm_ms, row.cpu_ms, row.body_ms)),
            *(f"{row.first_s:.2f}", f"{row.memory_mb:.0f}"),
        )
        for row in sorted(rows, key=lambda r: (r.threads, *_program(r), r.settings))
    ]
    return header, lines


def _program(row):
    """(place, name) of a curve: our two methods stand apart"""
    if row.program == "hakobune":
        return ("contour", "panel", "panel, band").index(row.settings), f"hakobune {row.settings}"
    return 3, row.program


def _place(case):
    return list(CASES).index(case)


def _asked(row):
    return f"{row.fineness:g}"


def _ms(value):
    if value is None or math.isnan(value):
        return ""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def _rounded(line):
    return [_ms(value) if isinstance(value, float) else value for value in line]


def _table(header, lines):
    rows = [header, ["---"] * len(header), *lines]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in rows)


def _cell(value):
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else value
