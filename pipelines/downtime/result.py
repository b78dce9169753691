"""`hakobune.downtime`: unusable hours at a berth, weather windows, limiting seas, return values."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.downtime.every_hour import Response, moments_of_hours, response_of
from hakobune.mooring.downtime.hindcast import WaveHours
from hakobune.mooring.downtime.largest import drawn_of_years, largest_of_hours
from hakobune.mooring.downtime.planes import moments_of_planes
from hakobune.mooring.downtime.years import FEWEST
from hakobune.mooring.response.findings import MISSED
from hakobune.mooring.response.points import transfer_functions
from hakobune.mooring.response.seas import MOST_OUTSIDE

from ..common.quantities import StudyError
from ..response.places import places_of
from ..response.study import ResponseStudy
from ..results.given import File, Tables, database_of, given
from ..results.heard import heard
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels, records
from .answers import DIRECTIONS, PERIODS, YEAR, answers, judged, of_years
from .lee import lee
from .limits import Hours, limits_of, used_of, value_of
from .moored import Detail, Found, moored
from .passages import record_with_passages
from .study import Record, make_downtime, read_downtime
from .tables import DowntimeStudy

if TYPE_CHECKING:
    from hakobune.bem.database import Database

KIND = "downtime"
WAVES = "waves"  # a response of 1, whose m0 is the part of the waves within the stored frequencies
TURNED = "the body turned clockwise"
OF_PLANES = "limiting seas have a JONSWAP spectrum with cos⁴ spreading; the period is the energy period"
LINEAR = (
    "largest: the mean largest amplitude in an hour, in linear waves about the mean place, of a freely floating body "
    "without lines, fenders or slow drift"
)


def downtime(
    study: File | Tables | DowntimeStudy,
    database: File | Database | None = None,
    *,
    states: File | None = None,
    executor: str = "local",
    say: Callable[[str], None] | None = None,
) -> Result:
    """Hours of downtime, weather windows, limiting seas and return values of a body from a record of several years.

    study : path of a downtime study, its tables as a dictionary, or a `DowntimeStudy`, with files relative to it
    database : path of the body's database, or an open one; None with [lee]
    states : path of the file of simulated states, continued where it stopped; None to store no states
    executor : executor of the simulations, as in the command; say : function that is called with each line of progress
    returns : Result, in SI; its `detail` is a Detail
    raises : ValueError, with a message of one line; KeyboardInterrupt, after which finished states are kept
    """
    read, text = given(study, DowntimeStudy, read_downtime, make_downtime)
    folder = Path(study).parent if isinstance(study, str | os.PathLike) else Path()
    if (database is None) != (read.lee is not None):
        state = "is given with [lee], which has no body" if read.lee else "of the body is missing"
        raise StudyError(f"the database {state}; give either a database or [lee]")
    db = None if database is None else database_of(database)
    if read.simulation is None:
        found = _linear(read, folder, db)
    else:
        found = moored(read, folder, db, states, executor, say or (lambda line: None))
    hindcast, limits, verdicts = found.detail.hindcast, found.detail.limits, found.detail.verdicts
    made, axes = answers(read, hindcast, limits, verdicts)
    made, axes = made | found.quantities, axes | found.axes
    used = verdicts.used.astype(np.float32)
    made |= records({"hour.used": (used, ("hour", "limit"), "", "utilisation of each limit")})
    axes |= labels("hour", hindcast.time.astype("datetime64[s]").astype(np.int64), "seconds since 1970-01-01")
    needed = {axis for one in made.values() for axis in one.axes}
    told = tuple(dict.fromkeys([*found.findings, *_too_long(read, made)]))
    axes = {axis: one for axis, one in axes.items() if axis in needed}
    notes = (*_notes(hindcast), *found.notes)
    return Result(KIND, made, axes, told, notes, (), provenance(text, db), found.detail)


def _linear(read, folder, db):
    """Results of linear responses for every hour"""
    with heard() as caught:
        record = record_with_passages(read, folder, None if db is None else db.water_depth)
        limits, response, notes = lee(read, folder) if read.lee else _of_body(read, db)
        response = _with_waves(response)
    hours = hours_of(response, record)
    verdicts = judged(used_of(limits, hours, record.hindcast), limits, len(read.operations))
    made, axes = {}, {}
    for found, more in (
        _returned(read, record.hindcast, hours),
        _limiting(read, record, response, limits),
        _turned(read, record, response, limits),
    ):
        made, axes = made | found, axes | more
    warned = [*caught, *record.hindcast.said, *(_viscous(read, db) if db else ()), *_outside(response, record, hours)]
    if record.planes is not None and "limiting.height" in made:
        notes = [*notes, OF_PLANES]
    return Found(Detail(read, record.hindcast, limits, verdicts), made, axes, warned, notes)


def _of_body(read, db):
    """Limits, Response and notes of a freely floating body"""
    of_body = ResponseStudy(body=read.body, points=read.points, keel=read.keel)
    body, points = of_body.restrained(db.reader.floating()), places_of(of_body, db)
    first = transfer_functions(body, body.omega[:1], body.headings[:1], points)
    limits = limits_of(read, points, dict(zip(first.names, first.units, strict=True)))
    wanted = tuple(dict.fromkeys(name for one in limits for name in one.names))
    return limits, response_of(body, points, wanted), [LINEAR]


def _too_long(read, made):
    """Operations with more downtime than allowed"""
    for number, one in enumerate(read.operations):
        hours = made["downtime.hours"].values[number]
        if one.allowed_hours is not None and hours > one.allowed_hours:
            yield fails(
                f"{one.name} is down {hours:.4g} h a year, limit {one.allowed_hours:g} h; try another heading "
                "(turned_deg), wider limits or another mooring"
            )


def _with_waves(response):
    one = np.ones((*response.power.shape[:2], 1))
    return Response((*response.names, WAVES), (*response.units, "m"), response.omega,
                    np.concatenate([response.power, one], axis=2))  # fmt: skip


def hours_of(response, record):
    """`limits.Hours` of a Record, whose wave systems are added up, or which has `planes` in place of wave systems"""
    hindcast, planes = record.hindcast, record.planes
    if planes is None:
        each = [moments_of_hours(response, shape, waves)
                for shape, waves in zip(record.shapes, hindcast.waves, strict=True)]  # fmt: skip
        m0, m2 = np.sum(each, axis=0)
    else:
        m0, m2 = moments_of_planes(response, planes.omega, planes.angle, planes.density())
    return Hours(response.names, response.units, m0, m2, min(hindcast.step, 3600.0))


def _viscous(read, db):
    if read.body.viscous is not None:
        raise StudyError("body.viscous is linearised in one sea; give damping_ratio for a record over years")
    if db.has_viscous_motions:
        lacking = "motions near resonance are too large; give body.damping_ratio"
        yield (
            "the viscous damping of the database's scene is not included, since it differs from hour to hour: "
            + ("body.damping_ratio takes its place" if read.body.damping_ratio else lacking)
        )


def _outside(response, record, hours):
    """Part of the waves beyond the stored frequencies.  Raises StudyError if that is most of them, most of the time."""
    whole = sum(waves.height**2 / 16 for waves in record.hindcast.waves)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = 1 - hours.m0[:, -1] / whole
    share = share[whole > 0]
    missed = np.nanmean(share > MISSED) if len(share) else 0.0
    if missed > 0:
        low, high = (2 * np.pi / response.omega[i] for i in (-1, 0))
        text = (
            f"in {100 * missed:.3g} % of the rows with waves, more than {100 * MISSED:g} % of the energy lies outside "
            f"the stored {low:.3g} to {high:.3g} s, at most {100 * np.nanmax(share):.0f} %; add periods to the scene "
            "and solve again"
        )
        if np.nanmedian(share) > MOST_OUTSIDE:
            raise StudyError(
                f"{text}; allowed: at most {100 * MOST_OUTSIDE:g} % of the energy outside, in at least half of the "
                f"rows; check that periods are in s"
            )
        yield text


def _notes(hindcast):
    years = len(hindcast.time) * hindcast.hours / YEAR
    yield (
        f"record: {len(hindcast.time)} rows of {hindcast.hours:g} h, {years:.3g} years, {hindcast.time[0]} to "
        f"{hindcast.time[-1]} UTC; years and months are in UTC; intervals come from the variation between years"
    )
    if len(np.unique(hindcast.year)) < FEWEST:
        yield f"no intervals are given for fewer than {FEWEST} years"


def _returned(read, hindcast, hours):
    """Yearly maxima and return values of the responses"""
    some = [i for i, name in enumerate(hours.names) if name != WAVES]
    if not some:
        return {}, {}
    years, maxima = drawn_of_years(hours.m0[:, some], hours.m2[:, some], hindcast.year, hindcast.step)
    units = tuple(hours.units[i] for i in some)
    return of_years([hours.names[i] for i in some], units, years, maxima.T, read.return_years)


def _limiting(read, record, response, limits):
    """Significant height at which an operation stops, for each period and direction: by the limits on the body alone"""
    own = [one for one in limits if one.kind != "weather"]
    period = np.concatenate([waves.period[waves.height > 0] for waves in record.hindcast.waves])
    if not own or not len(period):
        return {}, {}
    low, high = np.quantile(period, (0.001, 0.999))
    period = np.linspace(float(low), float(high), PERIODS)
    beta = np.mod(np.radians(read.hindcast.x_axis_compass_deg - DIRECTIONS - 180.0), 2 * np.pi)
    grid = np.repeat(period, len(beta)), np.tile(beta, len(period))
    at_one = replace(record.hindcast, waves=(WaveHours(np.ones(len(grid[0])), *grid),), columns={})
    hours = hours_of(response, Record(at_one, record.shapes[:1]))
    height = np.full((len(grid[0]), len(read.operations)), np.inf)
    for one in own:
        height[:, one.operation] = np.minimum(height[:, one.operation], _height(one, hours, at_one))
    height = np.where(np.isinf(height), np.nan, height).reshape(len(period), len(beta), -1)
    made = records({"limiting.height": (height, ("period", "comes_from", "operation"), "m", "significant height")})
    return made, labels("period", period, "s") | labels("comes_from", DIRECTIONS, "deg")


def _height(limit, hours, at_one):
    """Height at which a limit on the body is reached; shape (g,): all responses are proportional to the height, m"""
    if limit.kind == "response":
        room, moved = limit.criterion.limit, value_of(limit, hours, at_one)[:, None]
    else:
        columns = [hours.names.index(name) for name in limit.names]
        room = np.maximum(np.array(limit.rest) - limit.criterion.limit, 0.0)
        moved = largest_of_hours(hours.m0[:, columns], hours.m2[:, columns], hours.duration)
    return np.divide(room, moved, out=np.full_like(moved, np.inf), where=moved > 0).min(axis=1)


def _turned(read, record, response, limits):
    """Downtime with the body turned in plan, all else equal"""
    if not read.turned_deg:
        return {}, {}
    rows = []
    for degrees in read.turned_deg:
        waves = tuple(
            one._replace(direction=np.mod(one.direction + np.radians(degrees), 2 * np.pi))
            for one in record.hindcast.waves
        )
        hindcast = replace(record.hindcast, waves=waves)
        planes = record.planes and record.planes._replace(angle=record.planes.angle + np.radians(degrees))
        used = used_of(limits, hours_of(response, Record(hindcast, record.shapes, planes)), hindcast)
        one = judged(used, limits, len(read.operations))
        rows.append(one.down.sum(axis=0) / np.maximum(one.known.sum(axis=0), 1))
    made = {"turned.hours": Quantity(YEAR * np.array(rows), ("turned", "operation"), "h", "hours a year", TURNED)}
    return made, labels("turned", np.array(read.turned_deg), "deg")
