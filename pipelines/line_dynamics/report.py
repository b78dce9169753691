"""Tables of a run of a dynamic line: tensions, work, regime, and findings on them."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..common.units import KN
from .figures import LOSSES

STEADY = 0.02  # change of the largest tension between the last two cycles
DYNAMIC = 0.1  # over the largest quasi-static tension, below which inertia and drag are reported as negligible
INSIDE = 0.05  # of the largest tension at the ends, by which one between them is told
BALANCE = 0.01  # of the work that goes in and out: left over by the time steps


def show(console, name, found, course, result, strength, line):
    """Print the tables of a run.  found : Figures; course : Course; result : Result; strength : Strength"""
    cycles = "" if found.cycles is None else f", {found.cycles} cycles of {course.cycle:g} s"
    console.print(f"{name}: {found.begin:g} to {found.end:g} s{cycles}", highlight=False, soft_wrap=True)
    table = _table("tension, kN", "", "fairlead", "anchor")
    ends = (found.fairlead, found.anchor)
    share = np.nan if found.cycles is None else 1 / found.cycles
    rows = [
        ("largest", [_kN(e.largest) for e in ends]),
        ("at t, s", [f"{e.time:.2f}" for e in ends]),
        ("mean", [_kN(e.mean) for e in ends]),
        ("least", [_kN(e.least) for e in ends]),
        ("at rest", [_kN(e.rest) for e in ends]),
        ("largest, quasi-static", [_kN(e.quasi_static) for e in ends]),
        ("largest over quasi-static", [_number(e.over_quasi_static, ".2f") for e in ends]),
        ("slack, s", [_number(e.slack, ".2f") for e in ends]),
    ]
    if found.cycles is not None:
        rows.append(("slack, s in a cycle", [_number(e.slack * share, ".2f") for e in ends]))
    own = strength.breaking[-1], strength.breaking[0]
    if np.isfinite(strength.weakest):
        used = [e.largest / load if np.isfinite(load) else np.nan for e, load in zip(ends, own, strict=True)]
        rows.append(("breaking load used, %", [_number(100 * share, ".1f") for share in used]))
    for title, cells in rows:
        table.add_row(title, *cells)
    console.print(table)
    _show_used(console, strength.most_used(line, result, found.begin, found.end), strength)
    _show_work(console, found, _table)
    for text in (*_regime(found.regime), _steps(result)):
        console.print(text, highlight=False, soft_wrap=True)


def _table(title, *columns):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, column in enumerate(columns):
        table.add_column(column, justify="right" if i else "left")
    return table


def _show_used(console, used, strength):
    """Where a line of several segments is nearest to parting."""
    if used is not None and len(strength.breaking) > 1:
        console.print(
            f"breaking load used along the line: at most {used.share:.1%}{_of_segment(used, strength)}, "
            f"{_kN(used.tension)} of {_kN(used.breaking)} kN at t = {used.time:.2f} s",
            highlight=False,
            soft_wrap=True,
        )


def _of_segment(used, strength):
    return "" if strength.uniform else f" of segment {used.segment + 1} ({strength.names[used.segment]})"


def _show_work(console, found, make_table):
    count = found.cycles or 1
    table = make_table(
        "work per cycle" if found.cycles else f"work in {found.end - found.begin:g} s", "", "kJ", "% of the work"
    )
    rows = [("done on the line", found.work)]
    rows += [(name.replace("_", " "), found.losses[name]) for name in LOSSES]
    rows += [("stored", found.stored), ("as force times velocity", found.of_forces)]
    for name, value in rows:
        table.add_row(name, f"{value / count / KN:.4g}", _number(100 * found.share_of_work(value), ".2f"))
    console.print(table)


def _regime(found):
    if isinstance(found, str):
        return (f"regime: not judged, {found}",)
    words = {1: "quasi-static", 2: "harmonic", 3: "slack and taut", 4: "free fall"}
    bounds = f"{found.harmonic:.3g}, {found.slack:.3g}, {found.fall:.3g}"
    lines = [f"regime: {words[int(found.regime)]}, α = {found.acceleration:.3g} of g; bounds {bounds}"]
    if found.regime <= 2:
        lines.append(f"simplified method of the SR179 report (1982), 3.2.1: largest {found.largest / KN:.1f} kN")
    return lines


def _steps(result):
    return (
        f"{result.steps} steps, {result.rejected} repeated; largest tensions known to {result.mesh_error:.1%} "
        f"of themselves for the elements, {result.step_error:.1%} for the steps"
    )


def _kN(value):
    return _number(value / KN, ".1f")


def _number(value, form):
    return format(value, form) if np.isfinite(value) else "–"


def findings(found, result, strength, line):
    """Findings on the figures, one line each."""
    largest, ends = result.tension_fairlead.max(), max(result.tension_fairlead.max(), result.tension_anchor.max())
    anywhere = max(ends, result.largest_tension.max())
    used = strength.most_used(line, result)
    if used is not None and used.share > 1:
        yield fails(
            f"the tension{_of_segment(used, strength)} is {used.tension / KN:.0f} kN at t = {used.time:.2f} s, "
            f"{100 * used.share:.4g} % of the breaking load {used.breaking / KN:.0f} kN: the line parts; give a "
            "stronger type or a longer line"
        )
    if anywhere > (1 + INSIDE) * ends:
        when = result.time[np.argmax(result.largest_tension)]
        yield f"between its ends the line has {anywhere / KN:.1f} kN at t = {when:.2f} s, more than at either"
    if largest > 1.01 * found.fairlead.largest:
        when = result.time[np.argmax(result.tension_fairlead)]
        yield (
            f"before the figures begin the fairlead had {largest / KN:.1f} kN at t = {when:.2f} s, more than in them; "
            "give a longer ramp"
        )
    if found.change > STEADY:
        yield (
            f"the largest tension changes by {found.change:.1%} between the last two cycles, allowed {STEADY:.0%}: "
            "give a longer duration; a line that snaps may never repeat"
        )
    if abs(found.imbalance) > BALANCE * found.exchanged > 0:
        share = abs(found.imbalance) / found.exchanged
        yield fails(
            f"{share:.1%} of the work that goes in and out is neither lost nor stored, allowed {BALANCE:.0%}; give a "
            "smaller tolerance"
        )
    dynamic = found.fairlead.over_quasi_static - 1
    if not isinstance(found.regime, str) and found.regime.regime == 1 and abs(dynamic) > DYNAMIC:
        yield (
            f"the simplified method calls this line quasi-static, but the run is {dynamic:+.0%} off statics, allowed "
            f"{DYNAMIC:.0%}: believe the run"
        )
    if np.isnan(found.fairlead.quasi_static):
        yield "the line has no static shape at any place of its fairlead; no quasi-static tension is given"
