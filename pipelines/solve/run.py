"""Fill the database of a scene: pending frequencies are solved, stored and marked one by one."""

import os
import time
from collections.abc import Callable
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from hakobune.bem import ESTIMATE, INTERPOLATED
from hakobune.bem.database import (
    DatabaseError,
    Storing,
    append,
    append_limit,
    create,
    extend,
    open_database,
    pending,
    row_values,
    writing,
)
from hakobune.bem.database.file import check_place, check_replaceable
from hakobune.bem.database.schema import LIMITS
from hakobune.bem.free_body import free_body, needed
from hakobune.bem.kernels.progress import progress_callback

from ..common.interrupt import ctrl_c
from ..common.outputs import DATABASE, check_ending
from ..common.progress import Preparing, Progress, times
from ..executors.choice import Here, in_order
from ..printing.timing import KERNELS, phase, share, spent
from .adaptive import filled_band
from .large import Telling, announced
from .plan import KOCHIN, planned, resumed
from .work import limit_one, solve_one

FOLLOWS = {"rao", "drift_force"}  # quantities computed from coefficients and Kochin functions
EVERY = 0.5  # s: results within this time are stored together, and can be lost by a kill


@dataclass(frozen=True)
class Outcome:
    """Outcome of a run: frequencies that the run stored, all frequencies in the file, and failed frequencies with their
    reason.

    jobs : number of frequencies and limits of the run
    interrupted : by Ctrl-C, also during the last of them: later steps are then omitted too
    """

    path: Path
    solved: int
    stored: int
    total: int
    jobs: int
    failures: tuple[tuple[float | str, str], ...]
    remarks: tuple[str, ...]
    interrupted: bool = False

    @property
    def exit_status(self):
        """0 only if everything requested is stored"""
        if self.interrupted and self.stored < self.total:
            return 130
        return 1 if self.failures or self.stored < self.total else 0


def solve(scene, output, *, fresh=False, executor=None, console=None):
    """Make or complete the database of `scene` in the file `output`.

    executor : anything with submit(function, …) → future.result(); None works here
    console : rich console, or None for silence
    Raises ValueError, without a change of the file, if scene and file do not match.
    """
    output, executor = Path(output), executor or Here()
    check_place(output)
    with ExitStack() as stack:
        if output.exists() and not fresh:
            file = stack.enter_context(writing(output))
            plan = resumed(scene, file)
            asked = {"omega": plan.omegas, "wave_direction": plan.headings, "names": plan.names}
            file = _wider(stack, file, **asked, header=plan.header, anew=plan.anew)
            _store_free_body(file, plan)
            todo = pending(file)
            cost = _announced(plan, len(todo.limits), executor, console) if todo.rows else None
        else:
            check_replaceable(output)
            check_ending(output, DATABASE)
            plan = planned(scene)
            cost = _announced(plan, len(set(LIMITS) & set(plan.names)), executor, console)
            _check_still_free(output, fresh)
            with phase("store"):
                create(output, plan.header, plan.omegas, plan.headings, plan.names)
                file = stack.enter_context(writing(output))
        if console:
            console.print(f"{output}: {plan.header.mesh!r}", highlight=False, markup=False)
        fill = partial(_fill, plan, executor, console, cost)
        if plan.scene.waves.band is None:
            return fill(file)
        return filled_band(plan.scene, file, fill, partial(_wider, stack), console)


def _check_still_free(output, fresh):
    """Raise DatabaseError where another run has made the file since this one looked"""
    if output.exists() and not fresh:
        raise DatabaseError(
            f"{output} was made by another run just now; run the same command again, which continues from the "
            "stored results, or give another --output"
        )
    check_replaceable(output)


def _check_in_place(file):
    """Raise DatabaseError where the open file is no longer the one under its name"""
    path = Path(file.filename)
    own = os.fstat(file.id.get_vfd_handle())
    if not (path.exists() and os.path.samestat(own, path.stat())):
        raise DatabaseError(
            f"{path} was removed or replaced during this run by another run with the same file, so the results of "
            "this run are lost; run the command again with another --output"
        )


def _wider(stack, file, **more):
    """The open file, or its replacement of the same name, with more frequencies, headings and names"""
    path = Path(file.filename)
    if not extend(file, **more):
        return file
    file.close()
    return stack.enter_context(writing(path))


def _store_free_body(file, plan):
    """Store motions and mean drift of frequencies that lack only these, if all inputs are stored"""
    for row in pending(file).rows:
        flow = row_values(file, row.omega, row.headings, needed(row.want)) if row.want <= FOLLOWS else None
        if flow is not None:
            with suppress(FloatingPointError):  # solved as a frequency, and reported if it fails there too
                made = free_body(plan.problem, row.omega, row.headings, plan.header.theta, flow)
                append(file, row.omega, row.headings, {name: made[name] for name in row.want})


def _announced(plan, limits, executor, console):
    return announced(plan.problem, limits, console, getattr(executor, "count", 1), plan.omegas)


def _fill(plan, executor, console, cost, file):
    todo, before = pending(file), int(open_database(file).rows.sum())
    failures, interrupted, loaded = [], False, spent(KERNELS)
    say = partial(console.print, highlight=False) if console else lambda text: None
    preparing = Preparing(console, cost) if console and cost and isinstance(executor, Here) else None
    telling = Telling(console, preparing) if console else None
    with ctrl_c(say) as stop, progress_callback(telling), _stored_together(file) as storing:
        jobs = [*_rows(storing, plan, todo.rows), *_limits(file, plan, todo.limits)]
        progress = Progress(console, len(jobs)) if console else None
        try:
            for job, result in zip(jobs, in_order(executor, (job.call for job in jobs)), strict=True):
                _check_in_place(file)
                loaded = _share_estimate(result, loaded)
                with phase("store"):
                    reason = _stored(job, result)
                if reason:
                    failures.append((job.where, reason))
                if progress:
                    with phase("report"):
                        progress.step(job.where, result, reason)
                if stop.asked:
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            interrupted = True
            executor.shutdown(wait=False, cancel_futures=True)
    interrupted = interrupted or stop.asked  # also between two frequencies, after the last, or with none to solve
    _check_in_place(file)
    db = open_database(file)
    stored = int(db.rows.sum())
    return Outcome(
        db.path, stored - before, stored, len(db.rows), len(jobs), tuple(failures), plan.remarks, interrupted
    )


def _share_estimate(result, before):
    """Assign the estimate of a result its part of the time, without the loading of kernels for it.

    before : s of kernels loaded before; returns those up to now
    """
    steps, loaded = times(result), spent(KERNELS)
    estimate = sum(steps.get(step, 0.0) for step in (ESTIMATE, INTERPOLATED))
    if estimate:
        share("solve", "estimate", estimate * max(0.0, 1 - (loaded - before) / sum(steps.values())))
    return loaded


@dataclass(frozen=True)
class Job:
    """Input of an executor and use of its result; `where` is ω in rad/s or the name of a limit."""

    where: float | str
    call: tuple
    store: Callable


def _rows(storing, plan, rows):
    for row in rows:
        theta = plan.header.theta if row.want & KOCHIN else None
        call = (solve_one, plan.problem, row.omega, row.headings, row.want, theta)
        yield Job(row.omega, call, partial(_store_row, storing, row))


def _limits(file, plan, names):
    for name in names:
        yield Job(name, (limit_one, plan.problem, name), partial(append_limit, file, name))


class _Together(Storing):
    """Stores at once after a pause of `EVERY`, and results within `EVERY` together"""

    def __init__(self, file):
        super().__init__(file)
        self.last = -EVERY

    def add(self, *row):
        super().add(*row)
        if time.perf_counter() - self.last > EVERY:
            self.store()

    def store(self):
        super().store()
        self.last = time.perf_counter()


@contextmanager
def _stored_together(file):
    """Context of a `_Together` that has stored everything at its end, however it ends"""
    storing = _Together(file)
    try:
        yield storing
    finally:
        with phase("store"):
            storing.store()


def _store_row(storing, row, result):
    missing = sorted(row.want - set(result))
    if missing:
        raise ValueError(f"the method returned no {', '.join(missing)}")
    kept = {*row.want, "checks", "estimated_error", "wall_time"}
    storing.add(row.omega, row.headings, {name: value for name, value in result.items() if name in kept})


def _stored(job, result):
    """Store a result; returns the reason in one line if it is missing or cannot be stored, else "" (nothing)."""
    if isinstance(result, Exception):
        return _reason(result)
    try:
        job.store(result)
    except ValueError as error:
        return _reason(error)
    return ""


def _reason(error):
    return f"{type(error).__name__}: {' '.join(str(error).split())}"[:300]
