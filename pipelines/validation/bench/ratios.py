"""Ratios of what a bench measured: programs at equal panels and equal symmetry, one thread and two."""

from __future__ import annotations

import math

FREQUENCIES = 40  # over which the preparation of a band is shared out
EQUAL = 0.8, 1.07  # panels of the other program over ours that count as equal: rather to its advantage
LEAST = 900  # panels
PEER = "capytaine"
# and with which symmetry of the other program: panels take the rotation of a cylinder where frequencies share nothing
OURS = {"panel, band": ("2 planes", "rotation"), "panel": ("rotation",)}


def equal_panels(rows):
    """(header, lines): panels beside the other program's fastest settings, planes and rotation apart.

    rows : of `measure.Row`; ms, MB.  "all in" is a frequency of `FREQUENCIES` with its share of the preparation.
    """
    header = ("case", "threads", "settings", "panels", "ms", "all in", "MB", f"{PEER}: symmetry", "panels", "ms", "MB",
              "times")  # fmt: skip
    lines = []
    for ours in (row for row in _warm(rows) if row.settings in OURS and row.panels >= LEAST):
        for symmetry in OURS[ours.settings]:
            theirs = min(_equal(rows, ours, symmetry), key=lambda row: row.warm_ms, default=None)
            if theirs is not None:
                mine = ours.case, ours.threads, ours.settings, ours.panels, ours.warm_ms, _all_in(ours), ours.memory_mb
                other = symmetry, theirs.panels, theirs.warm_ms, theirs.memory_mb
                lines.append((*mine, *other, theirs.warm_ms / ours.warm_ms))
    return header, lines


def one_thread_and_two(rows):
    """(header, lines): ms of one thread over those of two, of our own settings from `LEAST` panels on

    rows : of `measure.Row`
    """
    lines = []
    for two in (row for row in _warm(rows) if row.program == "hakobune" and row.threads == 2):
        one = next((row for row in _warm(rows) if row[:4] == two[:4] and row.threads == 1), None)
        if one and (two.panels is None or two.panels >= LEAST):
            times = one.warm_ms / two.warm_ms
            lines.append((two.case, two.settings, f"{two.fineness:g}", one.warm_ms, two.warm_ms, times))
    return ("case", "settings", "asked", "one thread, ms", "two", "times"), lines


def _warm(rows):
    return [row for row in rows if row.cache == "full" and not row.note]


def _equal(rows, ours, symmetry):
    return [
        row
        for row in _warm(rows)
        if (row.case, row.program, row.threads) == (ours.case, PEER, ours.threads)
        and symmetry in row.settings
        and EQUAL[0] <= row.panels / ours.panels <= EQUAL[1]
    ]


def _all_in(row):
    """ms; the first frequency comes with the preparation, and with the start of the process if that is all we have"""
    first = 1e3 * row.first_s if math.isnan(row.body_ms) else row.body_ms
    return (first + (FREQUENCIES - 1) * row.warm_ms) / FREQUENCIES
