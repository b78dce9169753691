"""Fill the database of a scene: what is pending is solved, stored and marked, frequency by frequency."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import msgspec
import numpy as np

from bem.database import append, append_limit, create, extend, open_database, pending, writing
from bem.database.file import check_place, check_replaceable
from bem.database.schema import LIMITS
from bem.kernels.progress import progress_callback

from ..common.interrupt import ctrl_c
from ..common.progress import Preparing, Progress
from ..scene.identity import check_same
from ..scene.methods import FAR_FIELD, check_method, highest_resolved
from ..scene.scene import SceneError
from ..scene.text import to_toml
from .adaptive import filled_band
from .hull import Hull, inspected, kochin_angles, make_header, make_hull, remarks_on_body, setup_of
from .large import announced
from .work import Here, limit_one, solve_one

KOCHIN = {"kochin_radiation", "kochin_diffraction"}


@dataclass(frozen=True)
class Outcome:
    """What a run did: frequencies stored by it, all in the file, and those that failed with their reason.

    jobs : frequencies and limits it had to do
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
        """0 only if everything asked for is there"""
        if self.interrupted:
            return 130
        return 1 if self.failures or self.stored < self.total else 0


def solve(scene, output, *, fresh=False, executor=None, console=None):
    """Make or complete the database of `scene` in the file `output`.

    executor : anything with submit(function, …) → future.result(); None works here
    console : rich console, or None for silence
    Raises ValueError, leaving the file as it was, if scene and file do not go together.
    """
    output, count = Path(output), getattr(executor, "count", 1)
    check_place(output)
    omegas, headings, names = scene.omegas(), scene.headings(), scene.names()
    if output.exists() and not fresh:
        header = open_database(output).header
        check_same(scene, header, output)
        text, scene = to_toml(scene), _by_the_same_method(scene, header, output)
        _check_angles(scene, header, output)
        _check_far_field(scene, output)
        hull = inspected(Hull(header.mesh, header.lid), scene, omegas)
        extend(output, omega=omegas, wave_direction=headings, names=names, scene=text)
        cost = None
        if pending(output).rows:
            cost = announced(setup_of(header, scene), len(pending(output).limits), console, count)
    else:
        check_replaceable(output)
        hull = inspected(make_hull(scene, omegas), scene, omegas)
        header = make_header(scene, hull, omegas)
        cost = announced(setup_of(header, scene), len(set(LIMITS) & set(names)), console, count)
        create(output, header, omegas, headings, names)
    remarks = (*hull.remarks, *remarks_on_body(scene, header.body))
    if console:
        console.print(f"{output}: {hull.mesh!r}", highlight=False, markup=False)
    fill = partial(_fill, output, setup_of(header, scene), header.theta, remarks, executor or Here(), console, cost)
    return fill() if scene.waves.band is None else filled_band(scene, output, fill, console)


def _by_the_same_method(scene, header, output):
    """The scene with the method of its first frequencies, where it leaves the choice.  Raises SceneError."""
    if scene.method != "auto":
        return scene
    same = msgspec.structs.replace(scene, method=header.attributes["method"])
    try:
        check_method(same)
    except ValueError as error:
        raise SceneError(
            f"{output} is by method {same.method} so far, and {str(error).partition(';')[0]}; "
            "give --fresh to replace it or another --output"
        ) from None
    return same


def _check_angles(scene, header, output):
    """The angles of the Kochin functions stay what they are; mean drift has its own at every frequency."""
    db = open_database(output)
    if not KOCHIN & {*db.names, *scene.names()}:
        return
    omegas = np.array([*db.omega, *(row.omega for row in pending(output).rows), *scene.omegas()])
    needed = len(kochin_angles(scene, header.mesh, omegas))
    if needed > len(header.theta):
        raise SceneError(
            f"{output} has Kochin functions at {len(header.theta)} angles, "
            f"ω = {omegas.max():.4g} rad/s needs {needed}; give --fresh to replace it or another --output"
        )


def _check_far_field(scene, output):
    """Frequencies that have no far field cannot go into a file with one.  Raises SceneError."""
    stored = [name for name in FAR_FIELD if name in open_database(output).names]
    if stored and (highest := highest_resolved(scene)):
        raise SceneError(
            f"{output} has {stored[0]}, which frequencies above {highest:.4g} rad/s, with too many waves along the "
            "body, do not have; leave them out or give another --output"
        )


def _fill(output, setup, theta, remarks, executor, console, cost):
    todo = pending(output)
    failures, interrupted = [], False
    before = int(open_database(output).rows.sum())
    say = partial(console.print, highlight=False) if console else lambda text: None
    preparing = Preparing(console, cost) if console and cost and isinstance(executor, Here) else None
    with writing(output) as file, ctrl_c(say) as stop, progress_callback(preparing):
        jobs = [*_rows(file, setup, todo.rows, theta), *_limits(file, setup, todo.limits)]
        progress = Progress(console, len(jobs)) if console else None
        try:
            for job, result in _results(executor, jobs):
                reason = _stored(job, result)
                if reason:
                    failures.append((job.where, reason))
                if progress:
                    progress.step(job.where, result, reason)
                if stop.asked and job is not jobs[-1]:
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            interrupted = True
            executor.shutdown(wait=False, cancel_futures=True)
    rows = open_database(output).rows
    stored, jobs = int(rows.sum()), len(todo.rows) + len(todo.limits)
    return Outcome(output, stored - before, stored, len(rows), jobs, tuple(failures), tuple(remarks), interrupted)


@dataclass(frozen=True)
class Job:
    """What an executor is given and what happens to the result; `where` is ω in rad/s or the name of a limit."""

    where: float | str
    call: tuple
    store: Callable


def _rows(file, setup, rows, theta):
    for row in rows:
        call = (solve_one, setup, row.omega, row.headings, row.want, theta if row.want & KOCHIN else None)
        yield Job(row.omega, call, partial(_store_row, file, row))


def _limits(file, setup, names):
    for name in names:
        yield Job(name, (limit_one, setup, name), partial(append_limit, file, name))


def _store_row(file, row, result):
    missing = sorted(row.want - set(result))
    if missing:
        raise ValueError(f"no {', '.join(missing)} came back")
    kept = {*row.want, "checks", "estimated_error", "wall_time"}
    append(file, row.omega, row.headings, {name: value for name, value in result.items() if name in kept})


def _results(executor, jobs):
    """(job, result or exception) in order; an executor with processes works ahead."""
    futures = (executor.submit(*job.call) for job in jobs)
    if not isinstance(executor, Here):
        futures = list(futures)
    for job, future in zip(jobs, futures, strict=True):
        try:
            yield job, future.result()
        except Exception as error:
            yield job, error


def _stored(job, result):
    """Store a result; returns the reason in one line if there is none or it cannot be stored, else ""."""
    if isinstance(result, Exception):
        return _reason(result)
    try:
        job.store(result)
    except ValueError as error:
        return _reason(error)
    return ""


def _reason(error):
    return f"{type(error).__name__}: {' '.join(str(error).split())}"[:300]
