"""`hakobune.waves`: wave elevation around a body in regular waves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from hakobune.mooring.criteria.failing import failing
from hakobune.mooring.studies.waves_around import around_body, frequency, half_width, mapped, remarks, sides

from ..common.bounds import told
from ..results.given import File, database_of
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels

if TYPE_CHECKING:
    from hakobune.bem.database import Database

POINTS = 161  # points along a side of the map
A_POINT = 4e-6  # s, with 60 sources
HEIGHT = "height over incident wave height"


def waves(
    database: File | Database,
    *,
    period: float | None = None,
    omega: float | None = None,
    heading: float = math.pi,
    fixed: bool = False,
    width: float | None = None,
    at: Sequence[Sequence[float]] = (),
) -> Result:
    """Wave elevation around the body of a database in regular waves, or around several bodies.

    database : path of the database, or an open one; period : s, or omega : rad/s; heading : direction of travel, rad
    fixed : whether the body is fixed; width : width of the map, m; at : additional places [(x, y)], m
    returns : Result, in SI; its `detail` is a `mooring.studies.waves_around.Map`
    raises : ValueError, with a message of one line
    """
    wanted = np.asarray(at, float).reshape(-1, 2) if len(at) else np.zeros((0, 2))
    if not np.all(np.isfinite(wanted)):
        raise ValueError("`at` has a point that is not finite; allowed: x,y in m")
    db = database_of(database)
    around = around_body(db, frequency(period, omega), heading, fixed)
    half = half_width(around, width)
    told(f"{POINTS**2} points take", POINTS**2 * len(around.sources.points) / 60 * A_POINT)
    found = mapped(around, half, POINTS)
    said = list(remarks(around, db))
    places = _places(found, wanted)
    inside = [name for name, (_, _, value) in places.items() if np.isnan(value)]
    where = "in a body or between bodies" if db.bodies else "in the body"
    notes = [line for line in said if line not in failing(said)] + [f"{name} is {where}" for name in inside]
    return Result(
        "waves", {**_waves(around), **_heights(places), **_map(around, found, db.bodies_reader)},
        labels("place", list(places)) | labels("y", found.y, "m") | labels("x", found.x, "m")
        | labels("motion", db.bodies_reader.words),
        tuple(failing(said)), tuple(notes), provenance=provenance("", db), detail=found,
    )  # fmt: skip


def _waves(around):
    return quantities("waves", {
        "wave.period": (2 * np.pi / around.omega, "s", "period"),
        "wave.omega": (around.omega, "rad/s", "frequency"),
        "wave.length": (2 * np.pi / around.k, "m", "length"),
        "wave.heading": (around.beta, "rad", "heading"),
        "body": ("held" if around.motion is None else "floating", "", "body"),
    })  # fmt: skip


def _places(found, wanted):
    """{name: (x, y, complex elevation)} of the highest and lowest of the map, of both sides, and of those wanted"""
    around, height, places = found.around, np.abs(found.elevation), {}
    for name, pick in (("highest", np.nanargmax), ("lowest", np.nanargmin)):
        row, column = np.unravel_index(pick(height), height.shape)
        places[name] = found.x[column], found.y[row], found.elevation[row, column]
    others = sides(around) | {f"{x:g}, {y:g} m": np.array([x, y]) for x, y in wanted}
    values = around.elevation(np.array(list(others.values())))
    return places | {name: (*place, value) for (name, place), value in zip(others.items(), values, strict=True)}


def _heights(places):
    x, y, value = map(np.array, zip(*places.values(), strict=True))
    return quantities(HEIGHT, {
        "place.height": (np.abs(value), "", "height"),
        "place.phase": (np.angle(value), "rad", "phase"),
        "place.x": (x, "m", "x"),
        "place.y": (y, "m", "y"),
    }, "place")  # fmt: skip


def _map(around, found, body):
    motion = np.full(len(body.words), np.nan + 0j) if around.motion is None else around.motion
    units = tuple("rad/m" if turns else "m/m" for turns in body.turning)
    return (
        quantities("", {"far_field.missed": (around.missed, "%", "share of the far field that the sources miss")})
        | quantities("", {"body.motion": (motion, units, "motion of the body")}, "motion")
        | quantities("", {"map": (found.elevation, "m/m", "elevation")}, "y", "x", record=True)
    )
