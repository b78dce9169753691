"""Limits on a moored body: simulated states, added until the hours are known, and probabilities of hours."""

import hashlib
import json
import time
import tomllib
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import read_text
from hakobune.mooring.downtime.interpolant import fitted, where_it_may_change
from hakobune.mooring.downtime.representative import features, most_dissimilar
from hakobune.mooring.motion.simulation import Overload

from ..common.interrupt import ctrl_c
from ..common.progress import duration as spoken
from ..common.quantities import StudyError
from ..executors.choice import in_order_until
from ..moor.study import make_study
from ..simulate.work import Task, prepared
from . import states_file
from .answers import NORMAL, YEAR, Verdicts, judged
from .limits import SIMULATED, used_of
from .one_state import names_of, state
from .study import STREAMS
from .tables import WavesColumns

AFTER = 10.0  # s between lines of progress
QUIET = 0.05  # m, height of a calm hour in a simulation
OVERLOADED = 1.5  # at least, utilisation of a state whose fender or line gives way: beyond every limit
REALISED = 19  # seed of the random course of stopped hours whose windows are counted


class Simulated(NamedTuple):
    """rows : (s,) indices of the simulated hours; hours : (o,) h per year in this record

    used : (s, seeds, l) of the simulated limits, nan of others
    verdicts : `answers.Verdicts`; error, sea : (o,) h per year, standard deviation by the interpolant, and by the sea
    failed : ((row, reason), …); said : lines
    hours_at : (r,) known rows; fits : [Fit]; each : from `_each`, over these
    """

    rows: np.ndarray
    hours: np.ndarray
    used: np.ndarray
    verdicts: Verdicts
    error: np.ndarray
    sea: np.ndarray
    failed: tuple
    said: tuple
    hours_at: np.ndarray
    fits: list
    each: dict


class Prepared(NamedTuple):
    """task : `simulate.work.Task`; raw : tables of its study; names : names of its quantities"""

    task: Task
    raw: dict
    names: list


def prepared_of(table, folder, db):
    """Prepared of the mooring study of a StatesTable.  Raises StudyError."""
    path = folder / table.study
    raw = tomllib.loads(read_text(path, StudyError, largest=8))
    if "simulation" not in raw:
        raise StudyError(f"{table.study} has no [simulation]; allowed: a study that hakobune simulate runs")
    db.require_rigid()
    duration = 3600 * table.duration_hours
    task = Task(make_study(raw), str(db.path), duration, None, str(path.parent))
    body, plan, _ = prepared(task, db)
    moving = plan.settings.dynamic_lines
    task = Task(
        task.study, task.database, duration, body.memory, task.folder, moving if isinstance(moving, tuple) else None
    )
    return Prepared(task, raw, names_of(body))


def simulated(read, record, limits, ready, path, executor, say):
    """The Simulated of a DowntimeStudy with [simulation]: states are run and stored in the file of states.

    ready : Prepared; path : path of the file of states; executor : as in `executors`; say : called with each line
    raises : StudyError; KeyboardInterrupt, finished states are kept
    """
    table, hindcast = read.simulation, record.hindcast
    rows = np.flatnonzero(np.all([np.isfinite(one.height) for one in hindcast.waves], axis=0))
    x, height = _features(hindcast, rows)
    there = states_file.read(path, _identity(table, hindcast, ready))
    exact = np.stack([_weather_used(one, hindcast) for one in limits], axis=1)
    chosen = list(most_dissimilar(x, table.states, np.argmax(height)))
    while True:
        _run(read, record, ready, path, executor, say, there, rows[chosen])
        used = _used(limits, there, rows[chosen], table.seeds)
        sound = np.isfinite(used).any(axis=(1, 2))
        if sound.sum() < 8:
            raise StudyError(f"only {sound.sum()} of {len(chosen)} states could be simulated, and at least 8 are "
                             f"needed: "
                             f"{next(there[r]['failed'] for r in rows[chosen] if 'failed' in there[r])}")  # fmt: skip
        at = np.array(chosen)[sound]
        fits = _fits(read, limits, x, height, at, used[sound], exact[rows])
        worst = max(fits, key=lambda one: one.error / table.tolerance_hours)
        for one in fits:
            say(f"{len(chosen)} states: {one.name} {one.hours:.4g} h a year, interpolation ± "
                f"{NORMAL * one.error:.3g} h, random sea ± {NORMAL * one.sea:.3g} h")  # fmt: skip
        if NORMAL * worst.error <= table.tolerance_hours or len(chosen) >= table.most_states:
            break
        more = where_it_may_change(x, worst.mean, worst.spread, worst.fit.scatter, worst.free,
                                   min(table.batch, table.most_states - len(chosen)), x[chosen])  # fmt: skip
        more = [int(one) for one in more if one not in chosen]
        if not more:
            break
        chosen += more
    each = _each(limits, x, height, at, used[sound])
    verdicts = _verdicts(limits, hindcast, rows, exact, fits, each, read)
    failed = tuple(
        (int(r), f"{there[r]['failed']}; {_counted(there[r])}") for r in rows[chosen] if "failed" in there[r]
    )
    said = tuple(
        f"{one.name}: the interpolation over {len(at)} states is uncertain by ± {NORMAL * one.error:.3g} h a "
        f"year, tolerance {table.tolerance_hours:g} h; raise most_states"
        for one in fits if NORMAL * one.error > table.tolerance_hours
    )  # fmt: skip
    by_name = {one.name: one for one in fits}
    error, sea = (
        np.array([getattr(by_name[one.name], part) if one.name in by_name else 0.0 for one in read.operations])
        for part in ("error", "sea")
    )
    hours = YEAR * verdicts.chance.sum(axis=0) / np.maximum(verdicts.known.sum(axis=0), 1)
    return Simulated(rows[at], hours, used[sound], verdicts, error, sea, failed, said, rows, fits, each)


def _counted(row):
    """How a state that failed enters the hours"""
    if row.get("overload"):
        return "counted as beyond all limits, so that the hours of every cause include those like it"
    return "left out, its hour follows from other states"


def _features(hindcast, rows):
    """Features of rows, and their height (r,) m, calms as very low seas; shape (r, d)"""
    return features(*columns_of(hindcast, rows)), np.maximum(hindcast.height[rows], QUIET)


def columns_of(hindcast, rows):
    """Numbers [(r,), …] and angles [(r,), …] from which features are computed: height, period and direction of each
    wave system, and speed and direction of wind and current if both are known
    """
    numbers, angles = [], []
    for one in hindcast.waves:
        calm = ~(one.height[rows] > 0)
        numbers += [np.where(calm, QUIET, one.height[rows]), np.where(calm, np.nanmedian(one.period), one.period[rows])]
        angles.append(one.direction[rows])
    for speed, angle, _ in streams_of(hindcast):
        numbers.append(np.nan_to_num(hindcast.columns[speed][rows]))
        angles.append(np.nan_to_num(hindcast.columns[angle][rows]))
    return numbers, angles


def streams_of(hindcast):
    """[(column of the speed, of the direction, name in a mooring study)] of streams with complete columns"""
    known = ((f"{stream} speed", f"{stream} {ends}", stream) for stream, ends in STREAMS)
    return [one for one in known if set(one[:2]) <= set(hindcast.columns)]


def _identity(table, hindcast, ready):
    """Hash of the inputs of states"""
    digest = hashlib.sha256(json.dumps([ready.raw, table.seeds, table.duration_hours], sort_keys=True).encode())
    for values in (*(part for one in hindcast.waves for part in one),
                   *(hindcast.columns.get(name) for name in ("wind speed", "wind from")),
                   *(hindcast.columns[name] for one in streams_of(hindcast) if one[2] == "current"
                     for name in one[:2])):  # fmt: skip
        digest.update(b"" if values is None else np.ascontiguousarray(values).tobytes())
    with open(ready.task.database, "rb") as file:
        digest.update(hashlib.file_digest(file, "sha256").digest())
    return digest.hexdigest()


def _weather(read, record, row):
    """{"waves": table, "wind": table, "current": table} of a row, of a mooring study"""
    seas, hindcast, planes, x_axis = [], record.hindcast, record.planes, read.hindcast.x_axis_compass_deg
    tables = read.hindcast.waves or [WavesColumns("", spreading="cosine:4")]
    for shape, columns, one in zip(record.shapes, tables, hindcast.waves, strict=True):
        calm = not one.height[row] > 0
        sea = {
            "height": QUIET if calm else float(one.height[row]), "spectrum": shape.family,
            shape.kind: float(np.nanmedian(one.period) if calm else one.period[row]),
            "direction_deg": float(np.degrees(one.direction[row])),
        }  # fmt: skip
        more = {"gamma": shape.gamma, "spreading": columns.spreading}
        seas.append(sea | {key: value for key, value in more.items() if value is not None})
    found = {"waves": seas[0] | ({"swell": seas[1:]} if len(seas) > 1 else {})}
    if planes is not None and hindcast.waves[0].height[row] > 0:
        found["waves"] = {"file": str(planes.path(row).resolve()), "time": str(hindcast.time[row])[:16],
                          "location": planes.location or 1, "x_axis_compass_deg": x_axis}  # fmt: skip
    for name, angle, stream in streams_of(hindcast):
        speed, way = (float(np.nan_to_num(hindcast.columns[one][row])) for one in (name, angle))
        towards = x_axis - np.degrees(way) - (180.0 if stream == "wind" else 0.0)
        found[stream] = {"speed": speed, "direction_deg": float(np.mod(towards, 360.0))}
    return found


def _run(read, record, ready, path, executor, say, there, rows):
    """Run the missing rows, and store each"""
    todo, seeds = [int(row) for row in rows if int(row) not in there], read.simulation.seeds
    calls = (
        (state, ready.task, ready.raw, _weather(read, record, row), [row * seeds + k for k in range(seeds)])
        for row in todo
    )
    started = last = time.perf_counter()
    with ctrl_c() as stop:
        try:
            for place, result in in_order_until(stop, executor, calls):
                row = {"hour": todo[place]}
                if isinstance(result, Exception):
                    row["failed"] = " ".join(str(result).split())[:300] or type(result).__name__
                    row["overload"] = isinstance(result, Overload)
                else:
                    row["seeds"] = result
                states_file.append(path, row)
                there[todo[place]] = row
                done, now = place + 1, time.perf_counter()
                if now - last >= AFTER or done % 10 == 0 or done == len(todo):
                    last, left = now, (now - started) / done * (len(todo) - done)
                    say(f"{done} of {len(todo)} states" + (f", {spoken(left)} left" if done < len(todo) else ""))
        except KeyboardInterrupt:  # from an interrupted state
            stop.asked = True
    if stop.asked:
        stored = sum(int(row) in there for row in rows)
        raise KeyboardInterrupt(
            f"interrupted; {stored} of {len(rows)} states are stored in {path}, and the same command continues with "
            "the others"
        )


def _used(limits, there, rows, seeds):
    """Utilisation of simulated limits; shape (s, seeds, l); nan for others and for states without a result

    A state whose fender or line gives way is beyond every limit, as far as the worst of the others and OVERLOADED.
    """
    out = np.full((len(rows), seeds, len(limits)), np.nan)
    for s, row in enumerate(rows):
        for k, values in enumerate(there[row].get("seeds", ())):
            for i, one in enumerate(limits):
                if one.kind == SIMULATED:
                    value = values[one.criterion.quantity]
                    statistic = {"amplitude": "largest", "": "largest"}.get(
                        one.criterion.statistic, one.criterion.statistic
                    )
                    value = value[statistic] if isinstance(value, dict) else value
                    out[s, k, i] = one.criterion.utilisation(value)
    moored = [i for i, one in enumerate(limits) if one.kind == SIMULATED]
    over = [s for s, row in enumerate(rows) if there[row].get("overload")]
    for i in moored if over else ():
        out[over, :, i] = np.nanmax(np.append(out[..., i], OVERLOADED))
    return out


def _weather_used(limit, hindcast):
    return np.full(len(hindcast.time), np.nan) if limit.kind == SIMULATED else used_of([limit], None, hindcast)[:, 0]


class Fit(NamedTuple):
    """The interpolant of the utilisation of all simulated limits of an operation, and its values in all hours"""

    name: str
    fit: object
    mean: np.ndarray
    spread: np.ndarray
    free: np.ndarray
    hours: float
    error: float
    sea: float


def _fits(read, limits, x, height, at, used, exact):
    """[Fit] of each operation that has simulated limits"""
    found = []
    for number, operation in enumerate(read.operations):
        own = [i for i, one in enumerate(limits) if one.operation == number]
        moored = [i for i in own if limits[i].kind == SIMULATED]
        if not moored:
            continue
        fit = fitted(x[at], height[at], used[..., moored].max(axis=2))
        mean, spread = fit.predict(x, height)
        free = ~(exact[:, own] > 1).any(axis=1)
        error, sea = fit.spread_of_sum(x, height, mean, spread, free)
        hours = YEAR / len(x)
        total = hours * float(np.where(free, fit.chance(mean, spread), 1.0).sum())
        found.append(Fit(operation.name, fit, mean, spread, free, total, hours * error, hours * sea))
    return found


def _each(limits, x, height, at, used):
    """{index of a simulated limit: (Interpolant of its own utilisation, μ (r,), s (r,))}"""
    found = {}
    for i, one in enumerate(limits):
        if one.kind == SIMULATED:
            fit = fitted(x[at], height[at], used[..., i])
            found[i] = (fit, *fit.predict(x, height))
    return found


def _verdicts(limits, hindcast, rows, exact, fits, each, read):
    """Verdicts of all hours: certain ones by the weather, probabilities by the interpolants"""
    count, by_name = len(hindcast.time), {one.name: one for one in fits}
    shown, beyond = exact.copy(), (exact > 1).astype(float)
    for i, (fit, mean, spread) in each.items():
        shown[rows, i], beyond[rows, i] = np.exp(mean), fit.chance(mean, spread)
    sure = judged(np.where(np.isnan(exact) & np.array([one.kind == SIMULATED for one in limits]), 0.0, exact), limits,
                  len(read.operations))  # fmt: skip
    known, chance, error = sure.known.copy(), sure.chance.copy(), np.zeros(len(read.operations))
    for number, operation in enumerate(read.operations):
        one = by_name.get(operation.name)
        if one is not None:
            of_sea = np.full(count, np.nan)
            of_sea[rows] = one.fit.chance(one.mean, one.spread)
            known[:, number] &= np.isfinite(of_sea)
            chance[:, number] = np.where(sure.down[:, number], 1.0, np.nan_to_num(of_sea))
            error[number] = np.hypot(one.error, one.sea) / YEAR
    down = np.random.default_rng(REALISED).uniform(size=chance.shape) < chance
    return Verdicts(known, down & known, chance, shown, beyond, error)
