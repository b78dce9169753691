"""Tables of a breakwater on the terminal."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.failing import fails

from ..printing.verdict import tell
from .build import KN
from .results import design

ROWS = 12  # periods that are printed


def show(console, study, found, written):
    """Print Results, warnings, what fails and the names of the files written; returns the exit status."""
    console.print(study.name, highlight=False, soft_wrap=True)
    for table in _tables(study, found):
        console.print(table)
    for line in _lines(study, found):
        console.print(line, highlight=False, soft_wrap=True)
    status = tell([*found.warned, *failures(study, found)], console)
    if written:
        console.print(f"written: {', '.join(map(str, written))}", highlight=False, soft_wrap=True)
    return status


def failures(study, found):
    """What fails: lines that go slack, pretensions that cannot be, anchors that are too small, no design good enough"""
    held, sea = found.pretension, found.sea
    if held is not None:
        yield from _of_pretension(held)
    if held is not None and held.given is not None and sea is not None and (sea.least or 0.0) > held.given:
        yield fails(
            f"the pretension of {held.given / KN:.4g} kN/m is less than the {sea.least / KN:.4g} kN/m that keep lines "
            "taut in the sea; give more"
        )
    for one in found.anchors:
        if one.utilisation is not None and one.utilisation > 1:
            yield fails(
                f"anchor, {one.name}: {one.needed:.4g} {one.unit} are needed, {one.provided:.4g} provided, "
                f"{100 * one.utilisation:.4g} % used; give a larger one"
            )
    wanted = None if study.optimisation is None or found.front is None else study.optimisation.behind
    if wanted is not None and not np.any(found.front.behind <= wanted):
        yield fails(
            f"no design leaves {wanted:g} or less behind; the best leaves {found.front.behind.min():.4g}; give "
            "wider or deeper ones"
        )


def _of_pretension(held):
    if held.slack:
        where = ", ".join(f"{end} at {level} water" for level, end in held.slack)
        yield fails(
            f"lines go slack: {where}; the linear tensions do not hold there, taut again they snap: give more "
            f"pretension than {held.used / KN:.4g} kN/m"
        )
    if held.most is not None and held.most < held.least:
        yield fails(
            f"no pretension is both enough, {held.least / KN:.4g} kN/m, and allowed, {held.most / KN:.4g} kN/m; give "
            "stronger lines, another angle or section"
        )
    elif held.most is not None and held.most < held.used:
        yield fails(
            f"the pretension of {held.used / KN:.4g} kN/m is above the {held.most / KN:.4g} kN/m within the allowable "
            "tension; give less, or stronger lines"
        )


def _tables(study, found):
    picked = np.unique(np.linspace(0, len(found.period) - 1, min(ROWS, len(found.period))).round().astype(int))
    rows = [
        [f"{found.period[i]:.4g}", *(f"{abs(c.response.transmission[i]):.3f}" for c in found.curves)] for i in picked
    ]
    yield _table("transmission K_T", ["period, s", *(curve.name for curve in found.curves)], rows)
    held = [curve for curve in found.curves if np.isfinite(curve.response.front).all()]
    if held:
        pulls = [[abs(P) / KN for P in (c.response.front, c.response.back)] for c in held]
        rows = [[f"{found.period[i]:.4g}", *(f"{F[i]:.4g}, {B[i]:.4g}" for F, B in pulls)] for i in picked]
        title = "tension amplitudes front, back: kN/m per m of wave amplitude"
        yield _table(title, ["period, s", *(curve.name for curve in held)], rows)
    if found.tides is not None and found.pretension is not None:
        rows = [
            [
                one.level,
                f"{one.rise:+g}",
                f"{one.change / KN:+.4g}",
                *_at(one.front, one.front_at),
                *_at(one.back, one.back_at),
            ]
            for one in found.tides
        ]
        columns = ["level", "m", "ΔP₀, kN/m", "front, kN/m", "at, s", "back, kN/m", "at, s"]
        yield _table(f"greatest amplitudes in waves of {study.waves.height:g} m", columns, rows)
    if found.anchors:
        rows = [
            [one.name, f"{one.needed:.4g} {one.unit}", one.note, _or(one.provided, ".4g"), _or(one.utilisation, ".0%")]
            for one in found.anchors
        ]
        yield _table("anchors", ["", "needed", "size", "provided", "used"], rows)

    if found.front is not None:
        yield _front_table(study, found.front)


def _front_table(study, front):
    picked = np.unique(np.linspace(0, len(front.tension) - 1, min(ROWS, len(front.tension))).round().astype(int))
    words = {"draft": "draft, m", "width": "width, m", "angle_deg": "lines, °"}
    behind = "K_T, greatest" if study.sea is None else "4√m₀ behind, m"
    columns = ["greatest tension, kN/m", behind, *(words[name] for name in front.names)]
    rows = [
        [f"{front.tension[i] / KN:.4g}", f"{front.behind[i]:.4g}", *(f"{x:.4g}" for x in front.designs[i])]
        for i in picked
    ]
    return _table(f"best of {front.trials} designs", columns, rows)


def _wanted(study, front):
    """The design with the least tension that leaves no more behind than is wanted"""
    wanted = study.optimisation.behind
    enough = [] if wanted is None else np.flatnonzero(front.behind <= wanted)
    if len(enough):
        i = enough[0]
        sizes = ", ".join(f"{name} {x:.4g}" for name, x in zip(front.names, front.designs[i], strict=True))
        yield f"{wanted:g} or less behind takes at least {front.tension[i] / KN:.4g} kN/m: {sizes}"


def _lines(study, found):
    if found.front is not None:
        yield from _wanted(study, found.front)
    if found.sea is not None:
        yield f"sea of H1/3 {found.sea.cells.height:.4g} m; behind the breakwater 4√m₀ is"
        for name, height in found.sea.heights.items():
            yield f"  {height:.4g} m ({height / found.sea.cells.height:.3f}), {name}"
        if found.sea.greatest is not None:
            spread = ", ".join(
                f"{end} {P / KN:.4g}" for end, P in zip(("front", "back"), found.sea.greatest, strict=True)
            )
            yield f"  greatest tension amplitude of {found.sea.waves:.0f} waves, kN/m: {spread}"
            share = max(found.sea.slack)
            slack = f"a line is slack in {share:.2g} of the cycles" if share > 1e-6 else "no line goes slack"
            yield f"  {slack}, with {found.pretension.used / KN:.4g} kN/m at the worst level"
    if found.lee is not None:
        units = f"{len(found.lee.units)} unit{'s' * (len(found.lee.units) > 1)} of {2 * found.lee.half[0]:.4g} m"
        yield f"behind {units} in {found.lee.waves}, K over their breadth, height over that of the waves that come:"
        yield "  " + ", ".join(f"{K:.3f} at {y:.4g} m" for y, K in found.lee.behind)
        if found.lee.tension is not None:
            most = zip(("front", "back"), found.lee.tension, strict=True)
            said = ", ".join(f"{end} {P.max() / KN:.4g} at x = {found.lee.lines[P.argmax()]:.4g} m" for end, P in most)
            yield f"  tensions of a unit alone, kN/m for each metre of wave amplitude, the largest along it: {said}"
    if found.pretension is not None:
        yield from _pretension_lines(study, found.pretension)
    if found.snapping is not None:
        level, period, snap = found.snapping
        front, back = (
            f"{most / KN:.4g} kN/m (mean of the cycles {P / KN:.4g}), slack {share:.2g}"
            for most, P, share in zip(snap.largest, snap.peaks, snap.slack, strict=True)
        )
        yield f"in time, {period:.4g} s at {level} water: front snaps to {front} of the time; back to {back}"


def _pretension_lines(study, held):
    holding, theory = design(study)
    if held.most is None:
        most = ""
    elif held.most < 0:
        most = f"; none is within the allowable tension, which waves and tide alone exceed by {-held.most / KN:.4g}"
    else:
        most = f", at most {held.most / KN:.4g} within the allowable tension"
    yield f"pretension P₀, kN/m: at least {held.least / KN:.4g} to keep lines taut{most} ({holding}, {theory})"
    kind = "that is used" if held.given is None else "of the body"
    front, back = (one / KN for one in held.greatest)
    yield f"with {held.used / KN:.4g} kN/m {kind} the greatest tensions are {front:.4g} front, {back:.4g} back"


def _at(value, period):
    return f"{value / KN:.4g}", f"{period:.4g}"


def _or(value, form):
    return "–" if value is None else format(value, form)


def _table(title, columns, rows):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for i, column in enumerate(columns):
        table.add_column(column, justify="right" if i else "left")
    for row in rows:
        table.add_row(*row)
    return table
