"""A downtime study from its file: checked tables, the hindcast in the body's axes, and the shapes of the spectra."""

import itertools
import math
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.mooring.downtime.every_hour import Shape
from hakobune.mooring.downtime.files import read_columns
from hakobune.mooring.downtime.hindcast import Hindcast, made
from hakobune.mooring.downtime.planes import Planes, read_planes
from hakobune.mooring.environment.periods import KINDS
from hakobune.mooring.environment.spectra import FAMILIES, LARGEST_GAMMA
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.seas.families import PEAKED

from ..common.quantities import StudyError, positive
from ..common.typed import read_toml, typed
from ..common.weather.seas import spreading
from .tables import DowntimeStudy

COLUMN_KINDS = {
    "wind speed": "speed", "wind from": "direction", "current speed": "speed", "current to": "direction",
    "wind east": "component", "wind north": "component", "current east": "component", "current north": "component",
    "level": "level", "ice": "share",
}  # fmt: skip
MOST_STATES, MOST_SEEDS = 10_000, 1000
MOST_WINDOWS, MOST_TURNS = 12, 36
MANY = 240  # rows, whose directions seldom all lie within 2π degrees
STREAMS = (("wind", "from"), ("current", "to"))
NETCDF = (".nc", ".nc4", ".cdf", ".netcdf")
# spectrum of limiting seas for hours given as two-dimensional spectra
OF_PLANES = Shape("jonswap", "energy_period", None, CosinePower(4.0))


class Record(NamedTuple):
    """hindcast : `mooring.downtime.hindcast.Hindcast`; shapes : `every_hour.Shape` of each wave system

    planes : `mooring.downtime.planes.Planes`, None for a hindcast with systems of waves
    """

    hindcast: Hindcast
    shapes: tuple[Shape, ...]
    planes: Planes | None = None


def read_downtime(path):
    """The DowntimeStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_toml(path, "a downtime study", StudyError)
    return make_downtime(raw), text


def make_downtime(raw):
    """The DowntimeStudy of nested dictionaries.  Raises StudyError."""
    study = typed(raw, DowntimeStudy, StudyError)
    if not study.operations:
        raise StudyError("there are no [[operations]]; give at least one, with limits or a rule")
    twice = [name for name, count in Counter(one.name for one in study.operations).items() if count > 1]
    if twice:
        raise StudyError(f"two operations are called {twice[0]!r}; give each a name of its own")
    if not study.hindcast.waves and Path(study.hindcast.file).suffix.lower() not in NETCDF:
        raise StudyError("hindcast.waves is empty; give at least one wave system, or a netCDF file of spectra")
    if not 1 <= len(study.windows_hours) <= MOST_WINDOWS or len(study.turned_deg) > MOST_TURNS:
        raise StudyError(f"windows_hours has {len(study.windows_hours)} numbers, allowed: 1 to {MOST_WINDOWS}; "
                         f"turned_deg has {len(study.turned_deg)}, allowed: 0 to {MOST_TURNS}")  # fmt: skip
    for i, hours in enumerate(study.windows_hours):
        positive(f"windows_hours[{i}]", hours)
    for i, one in enumerate(study.operations):
        positive(f"operations[{i}].window_hours", one.window_hours)
        if one.allowed_hours is not None:
            positive(f"operations[{i}].allowed_hours", one.allowed_hours)
    if study.simulation is not None:
        _check_states(study.simulation)
    if not 1 < study.return_years < math.inf:
        raise StudyError(f"return_years is {study.return_years:g}; allowed: above 1, finite")
    for key, degrees in (("hindcast.x_axis_compass_deg", study.hindcast.x_axis_compass_deg),
                         *(("turned_deg", one) for one in study.turned_deg)):  # fmt: skip
        if not -360 <= degrees <= 360:
            raise StudyError(f"{key} is {degrees:g}; allowed: −360 to 360")
    return study


def _check_states(table):
    wrong = [
        f"simulation.{key} is {getattr(table, key)}; allowed: {least} to {most}"
        for key, least, most in (("states", 8, MOST_STATES), ("most_states", table.states, MOST_STATES),
                                 ("batch", 1, 1000), ("seeds", 2, MOST_SEEDS))
        if not least <= getattr(table, key) <= most
    ]  # fmt: skip
    if wrong:
        raise StudyError("; ".join(wrong))
    positive("simulation.duration_hours", table.duration_hours)
    positive("simulation.tolerance_hours", table.tolerance_hours)


def files_of(table, folder):
    """Paths of the files of a HindcastTable.  Raises StudyError for a pattern that matches none."""
    if not set(table.file) & set("*?["):
        return [Path(folder) / table.file]
    found = sorted(Path(folder).glob(table.file))
    if not found:
        raise StudyError(f"hindcast.file is {table.file!r}, and {folder} contains no such file; give one or more")
    return found


def record_of(table, folder, depth=None):
    """The Record of a HindcastTable with files in `folder`; depth : m.  Raises StudyError or TableError."""
    systems = [_system(f"hindcast.waves[{i}]", one, depth) for i, one in enumerate(table.waves)]
    if "level" in table.columns and table.level_at_rest is None:
        raise StudyError(
            "hindcast.columns has a water level, but level_at_rest is missing; give the value of that column, m, at "
            "which the water has the depth of the database"
        )
    wanted = {}
    for one, (_, kind, angle, _) in zip(table.waves, systems, strict=True):
        wanted |= {one.height: "height", getattr(one, kind): "period", angle: "direction"}
    wanted |= {column: COLUMN_KINDS.get(name, name) for name, column in table.columns.items()}
    paths = files_of(table, folder)
    path = paths[0]
    parts = [read_columns(one, table.time, table.zone, wanted, table.location) for one in paths]
    time, said = np.concatenate([part[0] for part in parts]), dict.fromkeys(itertools.chain(*(p[2] for p in parts)))
    found = {name: np.concatenate([part[1][name] for part in parts]) for name in wanted}
    x_axis, waves, planes = math.radians(table.x_axis_compass_deg), [], None
    if not systems:
        time, planes, own = read_planes(paths, table.location, x_axis)
        systems, waves = [(OF_PLANES, None, None, False)], [own]
    for one, (_, kind, angle, comes_from) in zip(table.waves, systems, strict=False):
        _check_direction(path.name, angle, found[angle])
        said |= dict.fromkeys(_radians(path.name, angle, found[angle]))
        towards = x_axis - found[angle] - (np.pi if comes_from else 0.0)
        waves.append((found[one.height], found[getattr(one, kind)], np.mod(towards, 2 * np.pi)))
    columns = {name: (found[column], COLUMN_KINDS.get(name, "")) for name, column in table.columns.items()}
    hindcast = made(time, waves, columns, table.file)
    _streams(hindcast.columns)
    if "level" in hindcast.columns:
        hindcast.columns["level"] = hindcast.columns["level"] - table.level_at_rest
    return Record(
        Hindcast(hindcast.time, hindcast.step, hindcast.waves, hindcast.columns, (*said, *hindcast.said)),
        tuple(shape for shape, *_ in systems),
        planes,
    )


def known_columns(columns):
    """Names of the quantities in the columns of a HindcastTable, on which operations may have limits"""
    made = [name for stream, ends in STREAMS if f"{stream} east" in columns
            for name in (f"{stream} speed", f"{stream} {ends}")]  # fmt: skip
    return [*columns, *made]


def _streams(columns):
    """Speed and direction, rad of the compass, of winds and currents given by components; in place"""
    for stream, ends in STREAMS:
        two = f"{stream} east", f"{stream} north"
        there = [name for name in two if name in columns]
        if len(there) == 1:
            raise StudyError(f"hindcast.columns has {there[0]!r} only; give both {two[0]!r} and {two[1]!r}")
        if there:
            east, north = (columns[name] for name in two)
            columns[f"{stream} speed"] = np.hypot(east, north)
            columns[f"{stream} {ends}"] = np.mod(np.arctan2(east, north) + np.pi * (ends == "from"), 2 * np.pi)


def _check_direction(where, name, angle):
    """Replace codes of missing values by nan, in place.  Raises StudyError for other angles beyond a full circle."""
    degrees = np.degrees(angle)
    code = np.isclose(np.abs(degrees), 999, atol=0.5) | np.isclose(np.abs(degrees), 9999, atol=0.5) | (degrees == -99)
    angle[code] = np.nan
    beyond = np.abs(degrees[~code]) > 361
    if beyond.any():
        worst = degrees[~code][beyond][0]
        raise StudyError(f"{where}: {name} is {worst:g}°; allowed: −360 to 360, or -99, 999, -999 for missing data")


def _radians(where, name, angle):
    """A line on directions that seem to be in radians, read as degrees: they fill no more than 2π degrees"""
    degrees = np.degrees(angle[np.isfinite(angle)])
    if len(degrees) >= MANY and np.abs(degrees).max() <= 2 * np.pi and np.ptp(degrees) > 1:
        yield (
            f"{where}: {name} lies between {degrees.min():.3g} and {degrees.max():.3g}° in all {len(degrees)} rows; if "
            f'these are radians, name them in the header, such as "{name} [rad]"'
        )


class _Peak:
    """Spreading after Mitsuyasu, before the peak of each hour is known"""

    peak_omega = 1.0


def _system(where, table, depth):
    """Shape, kind of period, column of the direction and whether it is a direction that waves come from"""
    kinds = [kind for kind in KINDS if getattr(table, kind) is not None]
    if len(kinds) != 1:
        state = " and ".join(kinds) + " are given" if kinds else "no period is given"
        raise StudyError(f"{where}: {state}; give one of {', '.join(KINDS)}")
    if (table.direction_from is None) == (table.direction_to is None):
        state = "neither is given" if table.direction_from is None else "both are given"
        raise StudyError(f"{where}: {state}; give one of direction_from, direction_to")
    if table.spectrum not in (*FAMILIES, "tma"):
        raise StudyError(
            f"{where}.spectrum is {table.spectrum!r}; allowed: {', '.join(FAMILIES)}, tma; for two peaks give wind sea "
            "and swell as two [[hindcast.waves]]"
        )
    if table.gamma is not None and (table.spectrum not in PEAKED or not 1 <= table.gamma <= LARGEST_GAMMA):
        raise StudyError(
            f"{where}.gamma is {table.gamma:g} for {table.spectrum}; allowed: 1 to 10, for jonswap and tma"
        )
    if table.spectrum == "tma" and (depth is None or not np.isfinite(depth) or kinds[0] == "significant_period"):
        raise StudyError(f"{where}.spectrum is 'tma', which needs a finite water depth and a period other than "
                         "significant_period; give these, or jonswap")  # fmt: skip
    try:
        spread = spreading(table.spreading, _Peak)
    except ValueError as error:
        raise StudyError(str(error).replace("--spreading", f"{where}.spreading")) from None
    shape = Shape(table.spectrum, kinds[0], table.gamma, spread, depth)
    return shape, kinds[0], table.direction_from or table.direction_to, table.direction_from is not None
