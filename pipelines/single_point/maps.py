"""Growth of slewing over one or two numbers of a study: the criterion at every value, and its picture.

A key is the path of a number in the study, such as "hawser.length". "hull.length_over_beam" keeps the waterplane's area
and draft, and the relative place of the attachment along the hull.
"""

import copy
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.mooring.single_point.equilibria import equilibria, preferred

from ..common.bounds import Pace
from ..common.picture import save
from ..common.quantities import StudyError
from .study import make
from .tables import make_study

MOST = 10_000
SLENDERNESS = "hull.length_over_beam"


class Map(NamedTuple):
    """x : (m,), y : (k,) values of the keys; y is one nan for a map over one key; growth : (k, m) 1/s; period : (k, m)
    s; heading : (k, m) °

    failed : number of places without equilibrium or load, with the first reason
    """

    keys: tuple
    x: np.ndarray
    y: np.ndarray
    growth: np.ndarray
    period: np.ndarray
    heading: np.ndarray
    failed: int
    reason: str


def check_maps(raw, study):
    """Raise StudyError for an impossible map; raw : nested dictionaries of the study"""
    for i in range(len(study.maps)):
        _axes(raw, study, i)


def _axes(raw, study, number):
    """Keys of a map, and values of each"""
    table = study.maps[number]
    axes = [table.x] if table.y is None else [table.x, table.y]
    values = [_values(f"maps[{number}]", axis) for axis in axes]
    for axis, value in zip(axes, values, strict=True):
        with_value(raw, axis.key, float(value[0]))
    x, y = values[0], np.full(1, np.nan) if len(values) == 1 else values[1]
    if len(x) * len(y) > MOST:
        raise StudyError(f"maps[{number}] has {len(x) * len(y)} points; allowed: at most {MOST}")
    return tuple(axis.key for axis in axes), x, y


def computed(raw, number, db):
    """Map number `number` of a study given as nested dictionaries.  Raises StudyError."""
    keys, x, y = _axes(raw, make_study(raw), number)
    shape, failed, reason = (len(y), len(x)), 0, ""
    growth, period, heading = (np.full(shape, np.nan) for _ in range(3))
    pace = Pace(f"a map of {len(x) * len(y)} points takes", len(x) * len(y), "give a smaller count")
    for i, j in np.ndindex(shape):
        changed = with_value(raw, keys[0], float(x[j]))
        if len(keys) == 2:
            changed = with_value(changed, keys[1], float(y[i]))
        try:
            best = preferred(equilibria(make(make_study(changed), db).point))
            growth[i, j], period[i, j] = best.slewing.growth, best.slewing.period
            heading[i, j] = np.degrees(best.heading)
        except ValueError as error:
            failed, reason = failed + 1, reason or " ".join(str(error).split())
        pace.step()
    if failed == growth.size:
        raise StudyError(f"maps[{number}]: no point could be computed: {reason}")
    return Map(keys, x, y, growth, period, heading, failed, reason)


def with_value(raw, key, value):
    """The nested dictionaries with a given number at a key. Raises StudyError."""
    out = copy.deepcopy(raw)
    if key == SLENDERNESS:
        return _slender(out, value)
    *path, name = key.split(".")
    table = out
    for part in path:
        table = table.get(part) if isinstance(table, dict) else None
    old = table.get(name) if isinstance(table, dict) else None
    if isinstance(old, bool) or not isinstance(old, int | float):
        raise StudyError(f"maps: {key!r} is not the path of a number in this study; give one such as 'hawser.length'")
    table[name] = type(old)(round(value)) if isinstance(old, int) and value == round(value) else float(value)
    return out


def _slender(raw, ratio):
    hull = raw["hull"]
    area, before = hull["length"] * hull["beam"], hull["length"]
    if not ratio > 0:
        raise StudyError(f"{SLENDERNESS} is {ratio:g}; allowed: above 0")
    hull["length"], hull["beam"] = math.sqrt(area * ratio), math.sqrt(area / ratio)
    raw["attachment"]["x"] = raw["attachment"]["x"] * hull["length"] / before
    return raw


def _values(where, axis):
    if not (2 <= axis.count <= MOST and math.isfinite(axis.from_) and math.isfinite(axis.to) and axis.from_ < axis.to):
        given = f"{axis.key} from {axis.from_:g} to {axis.to:g}, {axis.count} of them"
        raise StudyError(f"{where}: {given}; allowed: rising, 2 to {MOST}")
    return np.linspace(axis.from_, axis.to, axis.count)


def draw(found: Map, path: Path):
    """Growth over one number as a curve, over two as colours with the boundary of slewing"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 6), layout="constrained")
    axes = figure.add_subplot()
    per_hour = 3600 * found.growth
    if len(found.keys) == 1:
        axes.plot(found.x, per_hour[0], "k.-")
        axes.axhline(0, color="0.6", lw=0.8)
        axes.set_ylabel("growth of the slowest motion, 1/h (slewing above 0)")
    else:
        size = np.nanmax(np.abs(per_hour))
        drawn = axes.pcolormesh(found.x, found.y, per_hour, cmap="RdBu_r", vmin=-size, vmax=size, shading="nearest")
        figure.colorbar(drawn, ax=axes, label="growth of the slowest motion, 1/h (red: slewing)")
        if np.nanmin(found.growth) < 0 < np.nanmax(found.growth) and not np.isnan(found.growth).any():
            axes.contour(found.x, found.y, found.growth, [0.0], colors="k")
        axes.set_ylabel(_named(found.keys[1]))
    axes.set(xlabel=_named(found.keys[0]), title="slewing")
    save(figure, path, 150)


def _named(key):
    """A key with its unit"""
    from ..keys.reference import unit_of

    unit = unit_of("single-point", key)
    return f"{key}, {unit}" if unit else key
