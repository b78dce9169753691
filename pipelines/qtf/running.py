"""Wave pairs solved and stored for some force frequencies at a time: the next run continues from the stored
frequencies."""

import sys
import time
import warnings
from dataclasses import replace

import numpy as np

from hakobune.bem.database import DatabaseError, writing
from hakobune.bem.database.file import check_place
from hakobune.bem.second_order.kinds import DIFFERENCE
from hakobune.bem.second_order.quadratic_forces import (
    BLOCK,
    QuadraticForces,
    QuadraticRun,
    frequencies_of,
    share_of,
    surface_share,
)
from hakobune.bem.second_order.stored import StoredForces, read_forces, write_forces

from ..common.progress import duration
from ..results.heard import heard
from .foretelling import foretell
from .problem import bodies

EVERY = 5.0  # s, between writings
QUIET = 30.0  # s, between lines in a log
LONG = 300.0  # s left, above which what takes less time is named
LESS = "; fewer frequencies (--omega) or a smaller --difference take less"


def solve(db, question, fresh):
    """Store the forces of a `Question` in the file of an opened database; unless `fresh`, stored forces of the same
    waves are kept.

    raises : ValueError for inputs that `quadratic_forces` and `bodies` refuse and for a floating body without inertia;
        DatabaseError and OSError, before the computation, if the file cannot be written
    """
    if question.held.floats and db.inertia_matrix is None:
        raise ValueError(
            f"{db.path} has no inertia, which a floating body needs; its solve command with --gyration "
            f"kxx,kyy,kzz adds it; 'hakobune qtf {db.path} --fixed' computes the body held fixed"
        )
    check_place(db.path)
    with writing(db.path):
        pass
    try:
        with heard() as caught:
            _solve(db, question, fresh)
    finally:
        for line in caught:
            print(line, file=sys.stderr)


def _solve(db, question, fresh):
    body = bodies(db, question.method, float(question.omega[-1]), question.highest)
    stored = None if fresh else _of_same_waves(db, question, body)
    foretell((body.fine, body.rough), question)
    estimated = question.kind is DIFFERENCE and question.level != "full" and not db.bodies
    share = _share(body.fine, question, stored) if estimated else None
    full = question.adds_surface(share)
    known = _begun(stored, question, full)
    told = _Told(2 if body.rough else 1)
    given = *question.waves, question.held.moving
    fine = QuadraticRun(body.fine, *given, told.of(0), full, kind=question.kind)
    swayed = fine.motions if question.held.floats and body.method == "panel" else None
    rough = body.rough and QuadraticRun(body.rough, *given, told.of(1), full, swayed, question.kind)
    forces, coarser = ([], []) if known is None else ([known.forces], [known.coarser])
    written = time.monotonic()
    *blocks, last = fine.blocks(sum(len(part.frequency) for part in forces)) or [None]
    for block in (*blocks, last):
        if block is not None:
            forces = [QuadraticForces.joined([*forces, fine.solve(block)])]
            coarser = [np.concatenate([*coarser, rough.solve(block).total])] if rough else [None]
        if block is last or time.monotonic() - written > EVERY:
            asked = None if block is last else question.highest
            share = share if forces[0].surface is None else share_of(forces[0])
            errors = rough and body.errors(forces[0], coarser[0], _first(rough.by_motions, len(forces[0].frequency)))
            names = tuple(body.fine.dofs)
            stored = StoredForces(forces[0], question.held, body.method, share, errors, coarser[0], asked, names)
            write_forces(db.path, stored)
            written = time.monotonic()


def _share(problem, question, stored):
    """`surface_share`, from an interrupted run if known, None with a warning if the surface around the body is not
    supported"""
    if stored is not None and stored.asked == question.highest and stored.forces.surface is None:
        return stored.share
    try:
        return surface_share(problem, *question.waves, question.held.moving)
    except ValueError as error:
        if "surface" not in str(error):
            raise
        warnings.warn(str(error), stacklevel=2)
        return None


def _first(values, count):
    return None if values is None else values[:count]


def _of_same_waves(db, question, body):
    """`StoredForces` of the same waves and body by the same method, or None"""
    try:
        stored = read_forces(db, question.kind)
    except DatabaseError:
        return None
    same = (
        np.array_equal(stored.forces.omega, question.omega)
        and np.array_equal(stored.forces.headings, question.headings)
        and stored.held.same_as(question.held)
        and stored.method == body.method
        and (stored.coarser is not None) == (body.rough is not None)
    )
    return stored if same else None


def _begun(stored, question, full):
    """`StoredForces` with the first frequencies of a question, a multiple of BLOCK, for a run to continue; or None"""
    if stored is None or (stored.forces.surface is not None) != full:
        return None
    forces, coarser = stored.forces, stored.coarser
    asked = frequencies_of(question.omega, question.highest, forces.kind)
    count = min(len(forces.frequency), len(asked)) // BLOCK * BLOCK
    if not count:
        return None
    return replace(stored, forces=forces.first(count), coarser=None if coarser is None else coarser[:count])


class _Told:
    """Progress of several runs over the same frequencies and pairs, one terminal line for each part, or in a log a line
    every QUIET s"""

    def __init__(self, runs):
        self.runs, self.part, self.done, self.before, self.since, self.told = runs, None, {}, 0, 0.0, 0.0

    def of(self, run):
        """Callback of one run"""

        def report(part, done, of):
            self.done[part, run] = done
            self._print(part, sum(self.done.get((part, n), 0) for n in range(self.runs)), of * self.runs)

        return report

    def _print(self, part, done, of):
        now, screen = time.monotonic(), sys.stderr.isatty()
        if part != self.part:  # the pace is measured for this run's part
            self.part, self.before, self.since, self.told = part, done, now, now
        if not screen and now - self.told < QUIET:
            return
        self.told, left = now, ""
        if self.before < done < of:
            seconds = (now - self.since) / (done - self.before) * (of - done)
            left = f", {duration(seconds)} left" + (LESS if seconds > LONG else "")
        start, end = ("\r\033[K", "\n" if done == of else "") if screen else ("", "\n")
        print(f"{start}{done}/{of} {part}{left}", end=end, file=sys.stderr, flush=True)
