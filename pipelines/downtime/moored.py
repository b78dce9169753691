"""Downtime of a moored body from simulated states: downtime in every hour, downtime of other moorings, and limiting
seas.
"""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import msgspec
import numpy as np

from hakobune.bem.kernels.progress import progress_callback
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.downtime.hindcast import Hindcast
from hakobune.mooring.downtime.largest import whole_years
from hakobune.mooring.downtime.representative import features

from ..common.bounds import LongWaves
from ..common.quantities import StudyError
from ..executors.choice import executor_of
from ..results.heard import heard
from ..results.quantity import Quantity
from ..results.result import labels, records
from .answers import DIRECTIONS, NORMAL, PERIODS, Verdicts, of_years
from .limits import limits_of
from .passages import record_with_passages
from .tables import AlternativeTable, DowntimeStudy

if TYPE_CHECKING:
    from .simulated import Simulated

STATES, OTHERS = "downtime hours of this record from simulated states", "other moorings and headings"
HEIGHTS, UNSURE = 32, 0.3  # levels of height of a limiting sea, and error in ln of its share from which it is left out
IN_SI = {"deg": ("rad", np.pi / 180), "kN": ("N", 1e3)}
SEED = 1987


class Detail(NamedTuple):
    """study; hindcast; limits; verdicts : `answers.Verdicts`; simulated : `simulated.Simulated`, None if nothing is
    simulated
    """

    study: DowntimeStudy
    hindcast: Hindcast
    limits: list
    verdicts: Verdicts
    simulated: Simulated | None = None


class Found(NamedTuple):
    """detail; quantities, axes : in addition to the quantities and axes of `answers`; findings, notes : lines"""

    detail: Detail
    quantities: dict
    axes: dict
    findings: list
    notes: list


def moored(read, folder, db, states, executor, say):
    """The Found of a DowntimeStudy with [simulation].

    db : database; states : path of the file of states, or None; executor : name of the executor; say : called with
        each line
    """
    for key in ("points", "keel", "lee"):
        if getattr(read, key):
            raise StudyError(
                f"{key} is given with [simulation], but it applies to linear responses only; leave out one of the two"
            )
    workers = executor_of(executor)
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "states.jsonl" if states is None else Path(states)
        try:
            with heard() as caught:
                record, limits, found = _states(read, folder, db, path, workers, say)
                others = list(_others(read, folder, db, path, workers, say))
        finally:
            workers.shutdown(wait=False, cancel_futures=True)
    made = {
        "simulated.hours": Quantity(found.hours, ("operation",), "h", "hours a year in this record", STATES),
        "simulated.interpolant": Quantity(
            NORMAL * found.error, ("operation",), "h", "± interpolation error, 90 %", STATES
        ),
        "simulated.sea": Quantity(NORMAL * found.sea, ("operation",), "h", "± random error of the sea, 90 %", STATES),
    }
    made |= records({
        "state.hour": (found.rows, ("state",), "", "row of the hindcast"),
        "state.used": (found.used, ("state", "seed", "limit"), "", "utilisation of each simulated limit"),
    })  # fmt: skip
    axes = labels("state", np.arange(len(found.rows))) | labels("seed", np.arange(found.used.shape[1]))
    for more, names in (_compared(found, others), _returned(read, record.hindcast, limits, found),
                        _limiting(read, record.hindcast, found)):  # fmt: skip
        made, axes = made | more, axes | names
    failed = [fails(f"hour {record.hindcast.time[row]}: {reason}") for row, reason in found.failed[:5]]
    warned = [*caught, *record.hindcast.said, *found.said, *failed]
    detail = Detail(read, record.hindcast, limits, found.verdicts, found)
    return Found(detail, made, axes, warned, [*_notes(read, record.hindcast, found)])


def _states(read, folder, db, path, workers, say):
    """Record, limits and Simulated of a study"""
    from .one_state import UNITS
    from .simulated import prepared_of, simulated

    record = record_with_passages(read, folder, db.water_depth)
    with progress_callback(LongWaves(say)):
        ready = prepared_of(read.simulation, folder, db)
        limits = limits_of(read, [], {}, {name: UNITS[name] for name in ready.names})
        return record, limits, simulated(read, record, limits, ready, path, workers, say)


def _notes(read, hindcast, found):
    from .simulated import streams_of

    table = read.simulation
    with_it = "".join(f", {stream}" for *_, stream in streams_of(hindcast))
    yield (
        f"simulated: {len(found.rows)} states of {60 * table.duration_hours:g} min with {table.seeds} seeds "
        f"each; a state has the waves{with_it} of its hour, and all other inputs come from {table.study}; weather "
        "windows are those of one random realisation"
    )
    if len(hindcast.waves) > 1:
        yield "limiting seas are defined for one wave system; with several systems they are left out"


def _others(read, folder, db, path, workers, say):
    """Return (name, Simulated) of the alternatives of a study, and of its headings"""
    table, hindcast = read.simulation, read.hindcast
    turned = [AlternativeTable(f"turned {degrees:g}°", table.study, degrees) for degrees in read.turned_deg]
    for one in (*table.alternatives, *turned):
        say(f"{one.name}:")
        heading = msgspec.structs.replace(hindcast, x_axis_compass_deg=hindcast.x_axis_compass_deg + one.turned_deg)
        other = msgspec.structs.replace(
            read, hindcast=heading, simulation=msgspec.structs.replace(table, study=one.study)
        )
        own = path.with_name(f"{path.stem}.{re.sub(r'[^0-9A-Za-z-]+', '_', one.name)}{path.suffix}")
        yield one.name, _states(other, folder, db, own, workers, say)[2]


def _compared(found, others):
    """Hours of alternatives, and the gain of each"""
    if not others:
        return {}, {}
    hours = np.array([one.hours for _, one in others])
    either = [NORMAL * np.hypot(one.error, found.error) for _, one in others]
    axes = ("alternative", "operation")
    made = {
        "alternative.hours": Quantity(hours, axes, "h", "hours a year,", OTHERS),
        "alternative.gain": Quantity(found.hours - hours, axes, "h", "gained,", OTHERS),
        "alternative.error": Quantity(either, axes, "h", "± interpolation error, 90 %,", OTHERS),
    }
    return made, labels("alternative", [name for name, _ in others])


def _returned(read, hindcast, limits, found):
    """Yearly maxima and return values of what the limits are on, each hour's largest drawn of its law"""
    from scipy.special import ndtri

    chosen = [i for i in found.each if limits[i].criterion.sense == "at most"]
    years = whole_years(np.isfinite(hindcast.height), hindcast.year, hindcast.step)
    if not chosen or not len(years):
        return {}, {}
    rng, runs = np.random.default_rng(SEED), max(1.0, hindcast.hours / read.simulation.duration_hours)
    year, maxima, names, units = hindcast.year[found.hours_at], [], [], []
    for i in chosen:
        fit, mean, spread = found.each[i]
        share = rng.uniform(size=len(mean)) ** (1 / runs)
        largest = limits[i].criterion.limit * np.exp(mean + np.hypot(fit.scatter, spread) * ndtri(share))
        unit, size = IN_SI.get(limits[i].criterion.unit, (limits[i].criterion.unit, 1.0))
        maxima.append([size * largest[year == one].max() for one in years])
        names.append(re.sub(r" [≤≥].*", "", limits[i].label))
        units.append(unit)
    return of_years(names, tuple(units), years, np.array(maxima), read.return_years)


def _limiting(read, hindcast, found):
    """Significant height at which an operation stops in half of the seas of a period and a direction.

    By the interpolant, with the wind of hours of that height, from the direction of the waves; none far from states.
    """
    from .simulated import QUIET, columns_of, streams_of

    rows = found.hours_at[hindcast.waves[0].height[found.hours_at] > 0]
    if len(hindcast.waves) > 1 or not len(rows):
        return {}, {}
    numbers, angles = columns_of(hindcast, rows)
    period = np.linspace(*np.quantile(numbers[1], (0.001, 0.999)), PERIODS)
    height = np.geomspace(max(2 * QUIET, numbers[0].min()), numbers[0].max(), HEIGHTS)
    beta = np.mod(np.radians(read.hindcast.x_axis_compass_deg - DIRECTIONS - 180.0), 2 * np.pi)
    H, T, n = (one.ravel() for one in np.meshgrid(height, period, np.arange(len(beta)), indexing="ij"))
    grid_numbers, grid_angles = [H, T], [beta[n]]
    for k, (*_, stream) in enumerate(streams_of(hindcast)):
        line = np.polyfit(numbers[0], numbers[2 + k], 1)
        grid_numbers.append(np.clip(np.polyval(line, H), 0.0, numbers[2 + k].max()))
        way = np.angle(np.exp(1j * angles[1 + k]).mean())
        grid_angles.append(np.radians(DIRECTIONS)[n] if stream == "wind" else np.full(len(H), way))
    every, turns = columns_of(hindcast, found.hours_at)
    x = features([np.append(a, b) for a, b in zip(every, grid_numbers, strict=True)],
                 [np.append(a, b) for a, b in zip(turns, grid_angles, strict=True)])[len(found.hours_at):]  # fmt: skip
    limit = np.full((len(period), len(beta), len(read.operations)), np.nan)
    by_name = {one.name: one.fit for one in found.fits}
    for o, operation in enumerate(read.operations):
        if operation.name in by_name:
            mean, error = by_name[operation.name].predict(x, H)
            shape = len(height), len(period), len(beta)
            limit[..., o] = crossed(height, np.where(error < UNSURE, mean, np.nan).reshape(shape))
    made = records({"limiting.height": (limit, ("period", "comes_from", "operation"), "m", "significant height")})
    return made, labels("period", period, "s") | labels("comes_from", DIRECTIONS, "deg")


def crossed(height, used):
    """Heights, m, at which ln of the utilisation (h, p, b) crosses 0, linear in ln of height (h,); nan without a
    crossing; shape (p, b)
    """
    below, above = used[:-1], used[1:]
    passes = (below <= 0) & (above > 0)
    first = np.argmax(passes, axis=0)[None]
    a, b = (np.take_along_axis(one, first, axis=0)[0] for one in (below, above))
    step = np.log(height[1:] / height[:-1])[first[0]]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(passes.any(axis=0), height[:-1][first[0]] * np.exp(-a / (b - a) * step), np.nan)
