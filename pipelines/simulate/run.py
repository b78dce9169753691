"""A simulation into its file: missing seeds are run one by one, and each seed is stored when its run is finished."""

import hashlib
import json
import os
import time
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.hinges import told_of
from hakobune.bem.kernels.progress import progress_callback
from hakobune.mooring.lines.catalogue import fibre_lines
from hakobune.mooring.motion.extremes import median_extreme
from hakobune.mooring.motion.statistics import over_runs

from ..common.bounds import LongWaves
from ..common.interrupt import ctrl_c
from ..common.outputs import DATABASE, check_output
from ..common.progress import duration as words_of
from ..common.typed import differing
from ..executors.choice import Here, in_order_until
from ..moor.study import Study, make_study, read_study
from ..results.given import given
from .berth import check_windows
from .beside import differ, of_berth, simplified
from .file import (
    STATISTICS,
    SUMMARY,
    Header,
    create,
    first_what_is_left_out,
    is_run,
    opened,
    put,
    put_summary,
    summary_is_of_today,
    summary_is_whole,
    told,
    whole_rows,
)
from .stations import told_of_stations, units_of_shapes
from .study import force_files, moving_lines, plan_of
from .work import Task, lost_at, on_bed, prepared, quantities_of, sample_times, simulate_seed

IDENTITY = "3"  # first word of an identity; it changes when a default of a study changes the results of runs
# keys of [simulation] that set the number of runs only
ASKED = ("seeds", "keep_series", "duration", "duration_hours")
OF_MOVING_LINES = ("dynamic_lines", "dynamic_elements")
SPREADS = ("sigma", "slow", "wave")
PLAIN = {"highlight": False, "markup": False, "soft_wrap": True}
AFTER = 10.0  # s between lines of a long run


class Input(NamedTuple):
    """study : `moor.study.Study`; text : its TOML; folder : folder of the files that the study names; path : path of
    the file of
    the study, or None"""

    study: Study
    text: str
    folder: str = "."
    path: Path | None = None


def input_of(study):
    """The `Input` from a path, a dictionary or a `Study`.  Raises StudyError."""
    path = Path(study) if isinstance(study, str | os.PathLike) else None
    return Input(
        *given(study, Study, read_study, make_study), "." if path is None else str(path.resolve().parent), path
    )


@dataclass(frozen=True)
class Outcome:
    """made : number of seeds run now; there : number of complete rows; total : number of seeds of the study; failures :
    (seed, reason)

    interrupted : by Ctrl-C, even in the last seed: later steps are not wanted either
    """

    made: int
    there: int
    total: int
    failures: tuple
    interrupted: bool


def simulate(asked, database, output, console, executor, seeds=None, duration=None, fresh=False, windows=None):
    """Complete the file of a simulation; returns its Outcome.

    asked : Input of the study; database : open; console : for the progress, None for none
    seeds : number of seeds instead of the study's; duration : s, instead of the study's; fresh : replace existing runs
    windows : s, length of windows of a record, which must then be stored
    raises : ValueError, with a message of one line, before anything is written
    """
    output, db, folder, (study, text) = Path(output), database, asked.folder, asked[:2]
    files = force_files(study, folder)
    inputs = (db.path, *files)
    check_output(output, "a simulation", is_run, DATABASE, (*filter(None, (asked.path,)), *inputs))
    reader = db.bodies_reader
    plan = plan_of(study, reader.omega, seeds, duration, folder, reader.words, units_of_shapes(db))
    if windows is not None:
        check_windows(windows, plan, db.bodies)
    identity = _identity(study, inputs, plan.settings.duration)
    task = Task(study, str(db.path), plan.settings.duration, None, str(folder))
    shorter = None if fresh else _shorter(output, study, inputs, plan, identity)
    if shorter is not None:
        plan, fresh = _with_seeds_there(output, plan), True
        if console:
            console.print(_made_again(shorter, plan.settings.duration), highlight=False, soft_wrap=True)
    todo = _missing(output, identity, plan, fresh)
    if todo or not summary_is_of_today(output):
        remarks = tuple(study.remarks(study.hulls_of(db), db))  # refuses before anything is made
        moving, before = (None, ()) if fresh else _of_lines(output)
        with progress_callback(LongWaves(partial(console.print, **PLAIN)) if console else None):
            body, ready, warned = prepared(replace(task, moving=moving), db)
        task = replace(task, memory=body.memory, moving=ready.settings.dynamic_lines)  # for all processes
        ready = replace(ready, told=first_what_is_left_out((*before, *ready.told)))
        beside = simplified(study, db)
        kept = (*remarks, *plan.findings, *warned, *body.findings, *beside.findings)
        _say_before(console, ready, len(todo), executor)
        for line in remarks if console else ():
            console.print(f"warning: {line}", style="yellow", highlight=False, soft_wrap=True, markup=False)
        header = _header(task, text, db, body, identity, ready, beside, kept)
        _make_room(output, header, plan, fresh)
    with opened(output, "r+") as file:
        outcome = _fill(file, task, plan, console, executor)
        if outcome.made or (outcome.there and not summary_is_whole(file)):
            put_summary(file, summary(file))
    return outcome


def summary(file):
    """Statistics over the whole rows of a file; shape (quantities, len(SUMMARY))"""
    rows = file["statistics"][()][whole_rows(file)]
    out = np.full((rows.shape[1], len(SUMMARY)), np.nan)
    if not len(rows):
        return out
    at = {name: i for i, name in enumerate(STATISTICS)}
    out[:, : len(STATISTICS)] = rows.mean(axis=0)
    for name in SPREADS:
        out[:, at[name]] = over_runs(rows[:, :, at[name]])
    out[:, at["largest"]], out[:, at["smallest"]] = rows[:, :, at["largest"]].max(0), rows[:, :, at["smallest"]].min(0)
    for q, row in enumerate(rows.transpose(1, 2, 0)):
        upper, lower = median_extreme(row[at["largest"]]), median_extreme(-row[at["smallest"]])
        lower = lower._replace(median=-lower.median, low=-lower.high, high=-lower.low)
        out[q, len(STATISTICS) :] = [*upper, *lower]
    return out


def _identity(study, files, duration):
    """Hash of all inputs of the results except the seeds, preceded by the mark of its version"""
    words = differing(study)
    words.pop("harbour", None)  # the harbour only affects the evaluation of results
    simulation = words.get("simulation", {})
    for name in (*ASKED, *OF_MOVING_LINES):
        simulation.pop(name, None)
    if study.simulation and (study.spreads or study.lines) and moving_lines(study.simulation):
        simulation |= {name: getattr(study.simulation, name) for name in OF_MOVING_LINES}
    digest = hashlib.sha256(json.dumps([words, duration], sort_keys=True).encode())
    for path in files:
        digest.update(hashlib.sha256(Path(path).read_bytes()).digest())
    return f"{IDENTITY} {digest.hexdigest()}"


def _missing(output, identity, plan, fresh):
    """Requested seeds without a complete row.  Raises DatabaseError for the file of another study."""
    if fresh or not output.exists():
        return list(plan.seeds)
    with opened(output) as file:
        known = file.attrs["identity"]
        if not known.startswith(f"{IDENTITY} "):
            raise DatabaseError(
                f"{output} was made by an earlier version, whose runs are not continued; give another name, or --fresh "
                "to run them again"
            )
        if known != identity:
            raise DatabaseError(
                f"{output} belongs to another study or database, or has longer runs; give another name, or --fresh to "
                "replace it"
            )
        there = set(file["seed"][()][whole_rows(file)].tolist())
    return [seed for seed in plan.seeds if seed not in there]


def _shorter(output, study, files, plan, identity):
    """s, duration of the runs in a file of the same study and database if shorter than requested; else None"""
    if not output.exists():
        return None
    with opened(output) as file:
        known, there = file.attrs["identity"], float(file.attrs["duration"])
    same = known != identity and known == _identity(study, files, there)
    return there if same and there < plan.settings.duration else None


def _with_seeds_there(output, plan):
    """The Plan with the seeds of a file first, so that none of them is lost"""
    with opened(output) as file:
        there = file["seed"][()].tolist()
        kept = max(plan.keep_series, len(file["kept_seed"]))
    return replace(plan, seeds=(*there, *(seed for seed in plan.seeds if seed not in there)), keep_series=kept)


def _made_again(shorter, longer):
    return (
        f"runs of {shorter:g} s are stored and {longer:g} s are requested: every seed is run again, since the waves "
        "and gusts of a longer run have closer frequencies, so as not to repeat; a shorter run is not its beginning"
    )


def _of_lines(output):
    """Names of the moving lines in an existing file, for further seeds, and its findings on them"""
    if not output.exists():
        return None, ()
    with opened(output) as file:
        names = file.attrs.get("moving_lines")
        return None if names is None else tuple(filter(None, names.split("\n"))), told(file)


def _say_before(console, plan, seeds, executor):
    """Print the chosen methods, the neglected effects, and the expected time of the seeds by a trial"""
    if console is None:
        return
    length, lines, moves = plan.settings.ramp + plan.settings.duration, list(plan.told), plan.settings.dynamic_lines
    static, moving = (length * pace for pace in plan.pace)
    one = moving if moves else static
    if np.isfinite(one):
        rounds = -(-seeds // getattr(executor, "count", 1))
        saved = f' (dynamic_lines = "none": {words_of(static)})' if moves and np.isfinite(static) else ""
        lines.append(f"one seed takes about {words_of(one)}{saved}, and all {seeds} seeds {words_of(rounds * one)}")
    for line in lines:
        console.print(line, highlight=False, markup=False, soft_wrap=True)


def _header(task, text, db, body, identity, plan, beside, findings):
    """`Header` of the file of a study; task : with its memory; plan : prepared; beside : of the simplified method"""
    from hakobune.mooring.motion.line_loads import body_lines, ends_at_rest

    system, berth, reader = body.system, body.berth, body.reader
    lines, load = ((), ()) if system is None else (system.line_names, system.breaking_load)
    names = (*lines, *(one.name for one in berth.ropes))
    fenders, loads = tuple(one.name for one in berth.fenders), told_of_stations(reader, plan.stations)
    held = ends_at_rest(body_lines(system), reader.axes_at_rest)
    others = [one.bollard for one in berth.ropes], [one.fairlead for one in berth.ropes]
    ends = [
        np.array([*of_lines, *of_ropes], float).reshape(-1, 3) for of_lines, of_ropes in zip(held, others, strict=True)
    ]
    attributes = _attributes(task, db, body, plan, lines) | beside.attributes()
    attributes["findings_of_all"] = "\n".join(dict.fromkeys(findings))
    return Header(
        identity,
        text,
        names,
        np.array([*load, *(one.breaking_load for one in berth.ropes)], float),
        *ends,
        sample_times(plan.settings),
        *quantities_of(names, fenders, reader.words, plan.sides, reader.links, plan.shapes, loads),
        attributes,
        fenders,
        reader.names,
        tuple(name for name, _, _ in told_of(reader.links)),
        tuple(name for name, _ in loads),
    )


def _attributes(task, db, body, plan, lines):
    """What readers of the file need to know of body, water and study, without the findings"""
    study, hulls, at_rest = task.study, task.study.hulls_of(db), body.reader.axes_at_rest
    hull = max(hulls.values(), key=lambda one: one.length) if db.bodies else hulls
    found = {
        "database": task.database, "duration": plan.settings.duration, "split_frequency": plan.split,
        "mean_period": np.nan if plan.mean_period is None else plan.mean_period, "allowable": study.allowable,
        "rotation_center": at_rest[:, :3] if db.bodies else np.asarray(db.rotation_center, float),
        "density": db.density, "gravity": db.gravity, "water_depth": db.water_depth,
        "hull": [hull.length, hull.beam, hull.draft, hull.freeboard], "memory_states": body.memory.states,
        "lost_at": lost_at(plan.settings),
        "place_at_rest": body.start, "told": "\n".join(plan.told), "seeds_differ": differ(study),
    }  # fmt: skip
    if isinstance(plan.settings.dynamic_lines, tuple):
        found["moving_lines"] = "\n".join(plan.settings.dynamic_lines)
    if fibre := () if body.system is None else tuple(fibre_lines(body.system)):
        found["fibre_lines"] = "\n".join(fibre)
    if body.system is not None:
        found["on_bed_at_rest"] = [*on_bed(body, body.start), *(np.nan for _ in body.berth.ropes)]
    weakest = {} if body.system is None else _weakest_segments(body.system)
    if weakest:
        found["weakest_segments"] = json.dumps(weakest)
    if study.anchors:
        found["anchors"] = json.dumps([*study.anchors_on(lines), *(None for _ in body.berth.ropes)])
    if db.bodies:
        found["heading"] = at_rest[:, 5]
    return found | (of_berth(study, db, body) if body.berth.names else {})


def _weakest_segments(system):
    """{line: (name, breaking load in N)} of the segment with the least breaking load of each line of several"""
    lines = [
        line for line in system.lines if len(getattr(line, "segments", ())) > 1 and np.isfinite(line.breaking_load)
    ]
    weakest = {line.name: min(line.segments, key=lambda one: one.breaking_load) for line in lines}
    return {name: (one.name, one.breaking_load) for name, one in weakest.items()}


def _make_room(output, header, plan, fresh):
    """A new file, or a wider one for additional seeds"""
    if fresh or not output.exists():
        create(output, header, plan.seeds, plan.keep_series)
        return
    with opened(output) as old:
        there = old["seed"][()].tolist()
        more = [seed for seed in plan.seeds if seed not in there]
        if more or not summary_is_of_today(output):
            create(output, header, [*there, *more], max(plan.keep_series, len(old["kept_seed"])), old)


def _fill(file, task, plan, console, executor):
    whole = whole_rows(file)
    asked = np.isin(file["seed"][()], plan.seeds)
    rows = [int(row) for row in np.flatnonzero(asked & ~whole)]
    failures, made = [], 0
    with ctrl_c() as stop:
        progress = _Progress(console, len(rows), plan, stop)
        try:
            for place, result in in_order_until(stop, executor, _calls(executor, task, file, rows, progress)):
                seed = int(file["seed"][rows[place]])
                if isinstance(result, Exception):
                    failures.append((seed, " ".join(str(result).split())[:300]))
                else:
                    put(file, rows[place], result)
                    made += 1
                progress.step(seed, result)
        except KeyboardInterrupt:  # from an interrupted seed
            stop.asked = True
    if stop.asked:
        executor.shutdown(wait=False, cancel_futures=True)
    there = int((whole_rows(file) & asked).sum())
    return Outcome(made, there, int(asked.sum()), tuple(failures), stop.asked)


def _calls(executor, task, file, rows, progress):
    kept, seeds = len(file["kept_seed"]), file["seed"][()]
    inside = (progress.inside,) if isinstance(executor, Here) else ()
    return ((simulate_seed, task, int(seeds[row]), row < kept, *inside) for row in rows)


class _Progress:
    """One line per seed, and progress within one: simulated seconds per second, remaining time"""

    def __init__(self, console, total, plan, stop):
        self.console, self.total, self.stop, self.done = console, total, stop, 0
        self.length = plan.settings.duration + plan.settings.ramp
        self.started = self.told = time.perf_counter()

    def inside(self, share):
        """Called during a run with the finished share; raises KeyboardInterrupt after a request to stop"""
        if self.stop.asked:
            raise KeyboardInterrupt
        if time.perf_counter() - self.told > AFTER and 0 < share < 1:
            self._say(f"{100 * share:3.0f} % of a seed", self.done + share)

    def step(self, seed, result):
        self.done += 1
        self._say(f"seed {seed}" + (" failed" if isinstance(result, Exception) else ""), self.done)

    def _say(self, what, done):
        self.told = time.perf_counter()
        passed = max(self.told - self.started, 1e-9)
        left = words_of(passed / done * (self.total - done))
        line = f"{self.done:{len(str(self.total))}}/{self.total}  {what:18}  {done * self.length / passed:9.0f} s/s"
        if self.console:
            self.console.print(f"{line}  {left:>10} left", highlight=False, markup=False, soft_wrap=True)
