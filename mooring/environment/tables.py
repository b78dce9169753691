"""Columns of a table of numbers (read by `logger_files`): units of columns, and times at equal steps."""

import re

import numpy as np


class TableError(ValueError):
    """A file cannot be read as a table; the message names the file, the place and the allowed values."""


COARSEST, ROUNDED = 0.25, 0.6  # last digit of times over a step; what rounding leaves, over the last digit, with room
UNITS = {  # size of units, in m and s
    "length": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "dm": 0.1, "km": 1e3, "ft": 0.3048, "in": 0.0254, "feet": 0.3048},
    "time": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "hr": 3600.0, "hours": 3600.0, "seconds": 1.0},
}


def unit_of(path, name, kind):
    """Size in m or s of the unit at the end of a column name, "eta (mm)", "Time [ms]", "eta_cm"; 1 without a unit

    kind : "length" or "time".  Raises TableError for an unknown unit in brackets.
    """
    known = UNITS[kind]
    bracket = re.search(r"[(\[]\s*([^)\]]*?)\s*[)\]]\s*$", name)
    if bracket and bracket[1]:
        if bracket[1] not in known:
            raise TableError(f"{path}: column {name!r} has the unit {bracket[1]!r}; allowed: {', '.join(known)}")
        return known[bracket[1]]
    ending = re.search(r"[_ ,/]\s*([A-Za-z]+)\s*$", name)
    return known.get(ending[1], 1.0) if ending else 1.0


def column_of(path, names, wanted):
    """Index of a named column. Raises TableError."""
    if names is None:
        raise TableError(f"column is {wanted!r}, but {path} has no column names; leave column out")
    if wanted not in names:
        raise TableError(f"{path} has no column {wanted!r}; allowed: {', '.join(names)}")
    return names.index(wanted)


def without_rounding(time):
    """Evenly spaced times (n,) s if the given times differ from them only by rounding; otherwise the given times

    For example, 0, 0.8, 1.6, 2.4, 3.3, … are steps of 0.814 s. One unit of the last digit must be at most a quarter
    of a step, so that no lost row is taken for rounding.
    """
    n = np.arange(len(time))
    if len(time) < 3 or not np.all(np.isfinite(time)) or np.ptp(np.diff(time)) <= 1e-9 * np.abs(time).max():
        return time
    step, start = np.polyfit(n, time, 1)
    digits = (10.0**-k for k in range(7))
    last = next((d for d in digits if np.all(np.abs(time / d - np.round(time / d)) < 1e-6)), 0.0)
    even = start + step * n
    return even if last <= COARSEST * step and np.abs(time - even).max() <= ROUNDED * last else time


def check_even(path, time, off, lines):
    """Raises TableError if a step of the times (n,) of a table differs from the median step by more than the
    fraction `off`;
    lines : (n,) line numbers in the file
    """
    steps = np.diff(time)
    if len(steps) and not np.all(np.abs(steps - np.median(steps)) <= off * np.median(steps)):
        raise fault_of_steps(path, time, off, lines)


def fault_of_steps(path, time, off, lines):
    """`TableError` for uneven steps between the times (n,) of a table; the message gives the line and a remedy

    lines : (n,) line numbers in the file
    """
    steps = np.diff(time)
    usual = float(np.median(steps))
    falling, wrong = np.flatnonzero(steps <= 0), np.flatnonzero(np.abs(steps - usual) > off * abs(usual))
    i = int(falling[0]) if len(falling) else int(wrong[0]) if len(wrong) else int(np.argmax(np.abs(steps - usual)))
    where, a, b = f"{path}: line {lines[i + 1]}", time[i], time[i + 1]
    if len(falling):
        moved = f"stays at {a:g} s" if a == b else f"goes back from {a:.8g} to {b:.8g} s"
        return TableError(
            f"{where}: the time {moved}; allowed: increasing times at equal steps; sort the rows and remove duplicates"
        )
    told = f"{where}: the time goes from {a:.8g} to {b:.8g} s, and the step elsewhere is {usual:.6g} s"
    lost = [max(0, round(step / usual) - 1) for step in steps[wrong]]
    whole = np.abs(steps[wrong] - usual * (1 + np.array(lost))) <= max(off, 0.05) * usual
    if len(wrong) and np.all(whole) and min(lost) > 0:
        more = f", the first of {len(wrong)} gaps" if len(wrong) > 1 else ""
        count = f"{lost[0]} row is" if lost[0] == 1 else f"{lost[0]} rows are"
        return TableError(f"{told}: {count} missing{more}; allowed: equal steps; fill the gap, or cut the record there")
    return TableError(
        f"{told}, from {steps.min():.4g} to {steps.max():.4g} s in the file; allowed: equal steps; interpolate "
        f"to equal steps"
    )
