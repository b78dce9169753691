"""`hakobune qtf`: forces of pairs of waves of a database's body at the difference or the sum of their frequencies."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

LEVELS = ("body", "full", "auto")


def qtf(
    database: Annotated[Path, Parameter(help="database of a body, with its inertia where it floats")],
    /,
    *,
    omega: Annotated[str | None, Parameter(help="rad/s at even steps, start:stop:count, in the stored band")] = None,
    heading: Annotated[str | None, Parameter(help="degrees the waves travel to; all pairs of them")] = None,
    difference: Annotated[float | None, Parameter(help="rad/s, the largest", allow_leading_hyphen=True)] = None,
    sums: Annotated[bool, Parameter(name="--sum", negative=(), help="at sums of frequencies, not differences")] = False,
    highest: Annotated[float | None, Parameter(help="rad/s, the largest sum", allow_leading_hyphen=True)] = None,
    fixed: Annotated[bool, Parameter(negative=(), help="of the body held, instead of floating")] = False,
    moored: Annotated[Path | None, Parameter(help="mooring study whose lines hold the floating body")] = None,
    level: Annotated[
        str | None, Parameter(help="body, full (with the surface's forcing) or auto; body, of sums full")
    ] = None,
    method: Annotated[str, Parameter(help="panel, contour (vertical cylinders) or auto")] = "auto",
    fresh: Annotated[bool, Parameter(negative=(), help="again, though they are stored")] = False,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Slow forces of pairs of waves: squares of the first order, bound long waves, the moving hull and, with
    --level full, the forcing of the surface around it, whose size is estimated where it is left out.

    They go into the database as differences are done, from the smallest on, for qtf = "body" or "full" of response
    studies and simulations.  A run that was ended goes on from them when it is given again, and a larger --difference
    adds to them.  The body is solved on its panels, a vertical cylinder by the contour method.  What is stored there
    already is told and drawn again.

    With --sum the forces that ring and spring are solved, up to the highest sum whose waves the panels carry, with the
    forcing of the surface, which is a large part of them.
    """
    from hakobune.bem.database import open_database
    from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
    from hakobune.bem.second_order.stored import Held

    from ..common.picture import PLOTS, check_picture
    from ..results.tables import printed
    from .problem import METHODS
    from .question import Question, waves_and_sums_of, waves_of
    from .result import result_of

    if plot is not None:
        check_picture(plot, PLOTS)
    level = level or ("full" if sums else "body")
    allowed = LEVELS[:2] if sums else LEVELS
    if level not in allowed:
        raise ValueError(f"--level is {level!r}; allowed: {', '.join(allowed)}")
    if (difference if sums else highest) is not None:
        wrong, right = ("--difference", "without") if sums else ("--highest", "with")
        raise ValueError(f"{wrong} is given; allowed: {right} --sum")
    if method not in METHODS:
        raise ValueError(f"--method is {method!r}; allowed: {', '.join(METHODS)}")
    if fixed and moored is not None:
        raise ValueError("--fixed and --moored are both given; allowed: one of them")
    db = open_database(database)
    given = any(value is not None for value in (omega, heading, difference, highest))
    held = Held(not fixed, "" if moored is None else str(moored))
    waves = waves_and_sums_of(db, omega, heading, highest) if sums else waves_of(db, omega, heading, difference)
    question = Question(*waves, held, level, method, given, SUM if sums else DIFFERENCE)
    stored = _answer(db, question, moored, fresh)
    if plot is not None:
        from .plot import draw

        draw(stored.forces, db, stored.held.floats, plot)
    status = printed(result_of(stored, db))
    if plot is not None:
        print(plot)
    return status


def _answer(db, question, moored, fresh):
    """`StoredForces` of a question, solved where they are not stored; moored : path of its mooring study, or None"""
    from hakobune.bem.database import DatabaseError, open_database
    from hakobune.bem.second_order.stored import GROUPS, read_forces

    from .running import solve

    try:
        stored = None if fresh else read_forces(db, question.kind)
    except DatabaseError:
        stored = None
    if stored is not None:
        question = question.continued(stored)
        if question.answered_by(stored):
            return stored
    if moored is not None:
        question = replace(question, held=replace(question.held, lines=_stiffness(moored, db)))
    solve(db, question, fresh)
    print(f"{db.path}: group {GROUPS[question.kind]}", file=sys.stderr)
    return read_forces(open_database(db.path), question.kind)


def _stiffness(study, db):
    """(6, 6) of the lines of a mooring study about the rotation centre, where they hold the body in its steady loads"""
    from hakobune.mooring.studies.multi_point import multi_point

    from ..moor.study import read_study

    read, _ = read_study(study)
    hull = read.without_berth("qtf --moored").hull_of(db.dimensions)
    system = read.system(hull, db.rotation_center, db.density, db.gravity)
    return multi_point(db, system, hull, read.conditions(), read.allowable).equilibrium.stiffness
