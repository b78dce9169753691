"""Pairs of waves solved and stored some differences at a time: what a run has written, the next one goes on from."""

from __future__ import annotations

import sys
import time
import warnings

import numpy as np

ENOUGH = 0.05  # of the force: what "auto" leaves out
EVERY = 5.0  # s, between writings


def adds_surface(level, share):
    """Whether a level takes the forcing of the surface, which is that share of the force or unknown"""
    return level == "full" or (level == "auto" and share is not None and share > ENOUGH)


def solve(db, waves, moving, level, method, holder, fresh):
    """Put the forces of pairs into the file of an opened database; what is stored of the same waves is kept.

    waves : frequencies (n,) rad/s, headings (m,) rad and largest difference rad/s; moving : as of `difference_forces`
    level, method : of the command; holder : what holds the body, by name; fresh : whether nothing is kept
    raises : ValueError for what `difference_forces` and `bodies` refuse, OSError where the file cannot be written
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            _solve(db, waves, moving, level, method, holder, fresh)
        finally:
            for line in dict.fromkeys(str(w.message) for w in caught):
                print(line, file=sys.stderr)


def _solve(db, waves, moving, level, method, holder, fresh):
    from bem.second_order.difference_forces import DifferenceRun, share_of, surface_share
    from bem.second_order.stored import write_forces

    from .problem import bodies

    body, share = bodies(db, method, float(waves[0][-1])), None
    if level != "full":
        try:
            share = surface_share(body.fine, *waves, moving)
        except ValueError as error:
            if "surface" not in str(error):
                raise
            warnings.warn(str(error), stacklevel=2)
    full, lines = adds_surface(level, share), moving if np.ndim(moving) else None
    known = None if fresh else _known(db, waves, body, full, moving, holder)
    problems = [problem for problem in (body.fine, body.rough) if problem is not None]
    told = _Told(len(problems))
    runs = [DifferenceRun(p, *waves, moving, told.of(n), full) for n, p in enumerate(problems)]
    done, written = 0, time.monotonic()
    if known is not None:
        done = len(known[0].difference)
        for run, forces in zip(runs, known, strict=True):
            run.take(forces)
    blocks = runs[0].blocks(done)
    for block in blocks:
        for run in runs:
            run.solve(block)
        last = block is blocks[-1]
        if not last and time.monotonic() - written < EVERY:
            continue
        fine, *rough = (run.forces(block[-1] + 1) for run in runs)
        write_forces(
            db.path,
            fine,
            moving is not False,
            share_of(fine) if full else share,
            holder,
            body.errors(fine, rough[0]) if rough else None,
            body.method,
            rough=rough[0].total if rough else None,
            asked=None if last else float(waves[2]),
            lines=lines,
        )
        written = time.monotonic()


def _known(db, waves, body, full, moving, holder):
    """[`DifferenceForces`] of each resolution, fewer differences of the same waves as they are stored, or None"""
    from bem.database import DatabaseError
    from bem.second_order.difference_forces import BLOCK, DifferenceForces, steps_to
    from bem.second_order.stored import read_forces, stored_lines, stored_method, stored_mooring, stored_rough

    try:
        forces, floats = read_forces(db)
    except DatabaseError:
        return None
    omega, headings, highest = waves
    lines = moving if np.ndim(moving) else np.zeros((6, 6))
    count = min(len(forces.difference), steps_to(highest, omega) + 1) // BLOCK * BLOCK
    rough = stored_rough(db)
    same = (
        np.array_equal(forces.omega, omega)
        and np.array_equal(forces.headings, headings)
        and floats == (moving is not False)
        and stored_mooring(db) == holder
        and np.array_equal(stored_lines(db), lines)
        and stored_method(db) == body.method
        and (forces.surface is not None) == full
        and (rough is not None) == (body.rough is not None)
    )
    if not same or not count:
        return None
    kept = [forces.first(count)]
    if rough is not None:  # of whose parts the sum alone is known
        zero = np.where(np.isnan(rough[:count]), rough[:count], 0.0)
        kept.append(
            DifferenceForces(omega, kept[0].difference, headings, rough[:count], zero, zero, zero if full else None)
        )
    return kept


class _Told:
    """Progress of several runs of as many solutions each, in one line of a terminal"""

    def __init__(self, count):
        self.count, self.done = count, [0] * count

    def of(self, n):
        """Callback of one of them"""

        def report(done, of):
            self.done[n] = done
            if sys.stderr.isatty():
                end = "\n" if sum(self.done) == of * self.count else ""
                print(f"\r{sum(self.done)}/{of * self.count} frequencies", end=end, file=sys.stderr, flush=True)

        return report
