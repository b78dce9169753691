"""`hakobune.qtf`: forces of wave pairs, in the database of their body, and the size of each part."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hakobune.bem.database import DatabaseError, open_database
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.stored import GROUPS, Held, read_forces

from ..results.given import File, database_of
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .problem import METHODS
from .question import Question, waves_and_sums_of, waves_of
from .report import MODES, diagonal_gap, failures, levels, notes, parts_of_sums

if TYPE_CHECKING:
    from hakobune.bem.database import Database

LEVELS = ("body", "full", "auto")
SMALL = 1e-6  # forces below this fraction of the largest (moments per metre) count as zero by symmetry
ARM = 100.0  # m, divisor of moments for the comparison with forces


def qtf(
    database: File | Database,
    *,
    omega: Sequence[float] | None = None,
    headings: Sequence[float] | None = None,
    highest: float | None = None,
    sums: bool = False,
    fixed: bool = False,
    moored: File | None = None,
    level: str | None = None,
    method: str = "auto",
    fresh: bool = False,
) -> Result:
    """Forces of wave pairs at the difference or the sum of their frequencies, on the body of a database.

    database : path, or an open database; the forces are stored in it, and stored forces are not solved again
    omega : (n,) rad/s at even steps in the stored band; headings : (m,) rad; highest : highest difference or sum,
        rad/s
    fixed : whether the body is fixed; moored : path of a mooring study whose lines hold the floating body
    level : "body", "full" (with the forcing of the free surface), or "auto" for differences; by default "body", for
        sums "full"
    method : "panel", "contour" or "auto"; fresh : whether to solve stored forces again
    returns : Result, in SI; its `detail` is the `bem.second_order.stored.StoredForces`
    raises : ValueError, with a message of one line
    """
    db = database_of(database)
    level, allowed = level or ("full" if sums and not db.bodies else "body"), LEVELS[:2] if sums else LEVELS
    if level not in allowed:
        raise ValueError(f"--level is {level!r}; allowed: {', '.join(allowed)}")
    if method not in METHODS:
        raise ValueError(f"--method is {method!r}; allowed: {', '.join(METHODS)}")
    if fixed and moored is not None:
        raise ValueError("--fixed and --moored are both given; give one of them")
    if db.bodies and (level == "full" or moored is not None):
        given = "--moored" if moored is not None else "--level full"
        raise ValueError(f"{given} is given for {len(db.bodies)} bodies, but this flag is for one body; leave it out")
    chosen = any(value is not None for value in (omega, headings, highest))
    held = Held(not fixed, "" if moored is None else str(moored))
    waves = (waves_and_sums_of if sums else waves_of)(db, omega, headings, highest)
    question = Question(*waves, held, level, method, chosen, SUM if sums else DIFFERENCE)
    return result_of(_answer(db, question, moored, fresh), db)


def _answer(db, question, moored, fresh):
    """`StoredForces` of a question, solved if not stored; moored : its mooring study, or None"""
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
    """Stiffness of the lines of a mooring study about the rotation centre, where they hold the body in its steady
    loads; shape (6, 6)"""
    from hakobune.mooring.studies.multi_point import multi_point

    from ..moor.study import read_study

    read, _ = read_study(study)
    hull = read.without_berth("qtf --moored").hull_of(db.sizes)
    system = read.system(hull, db.rotation_center, db.density, db.gravity)
    return multi_point(db, system, hull, read.conditions(), read.allowable).equilibrium.stiffness


def result_of(stored, db):
    """Result of `StoredForces` of an open database: root mean square of the force after adding each part in turn"""
    forces, sums = stored.forces, stored.forces.kind is SUM
    rows = list(_rows(stored, sums))
    parts = list(rows[0][3]) if rows else []
    title = f"force of wave pairs at frequency {forces.kind.name}s, root mean square, with each part that is added"
    units = tuple("N m/m2" if name.endswith(("roll", "pitch", "yaw")) else "N/m2" for _, name, _, _ in rows)
    made = {
        f"force.{_key(part)}": Quantity([row[3][part] for row in rows], ("force",), units, part, title)
        for part in parts
    }
    words = [f"{np.degrees(beta):.4g}° {name}, {frequency:.4g} rad/s" for beta, name, frequency, _ in rows]
    gap = None if sums else diagonal_gap(forces)
    for name, value, word in (
        ("drift_apart", gap, "difference between drift by pressure and by far field"),
        ("surface_share", stored.share, "free-surface forcing over the whole force"),
    ):
        if value is not None:
            made[name] = Quantity(float(value), (), "", word, "checks", share=True)
    return Result("qtf", made, labels("force", words), tuple(failures(stored, db)), tuple(notes(stored)),
                  provenance=provenance(database=db), detail=stored)  # fmt: skip


def _key(part):
    return part.removeprefix("+ ").lower().replace(" ", "_").replace("_+_", "_and_")


def _rows(stored, sums):
    """Return rows (heading, rad; motion; frequency, rad/s; {part: root mean square}) of equal headings"""
    forces, most = stored.forces, 4 if sums else 5
    motions = [(mode, name) for mode, name in enumerate(stored.words) if sums or mode % 6 in MODES]
    straight = [mode for mode in range(len(stored.names)) if mode % 6 < (3 if sums else 2)]
    chosen = sorted({*np.linspace(0, len(forces.frequency) - 1, most).astype(int)})
    for h, beta in enumerate(forces.headings):
        whole = np.nanmax(np.abs(forces.total[:, :, h, h][..., straight]))
        for mode, name in motions:
            found = parts_of_sums(forces, mode, h) if sums else levels(forces, mode, h)
            if np.nanmax(np.abs(found["+ body"])) < SMALL * whole * (1.0 if mode % 6 < 3 else ARM):
                continue
            for m in chosen:
                yield (
                    beta,
                    name,
                    forces.frequency[m],
                    {part: float(np.sqrt(np.nanmean(np.abs(value[m]) ** 2))) for part, value in found.items()},
                )
