"""A mooring study: water, hull, lines and the weather they have to stand, as typed TOML.

Quantities carry their unit in the key where it is not SI: `speed_knots`, `pretension_tonf`.  Wind, current and
waves have either `direction_deg`, travelled to, 0 → +x, or `incidence_deg`, the angle χ of the reports, 0 from
ahead: direction = incidence + 180°.  Every fault is one line that names key, value and what is allowed.
"""

from __future__ import annotations

import math
from dataclasses import replace

import msgspec
import numpy as np

from mooring.layout import Layout, Line, corner_spread, pretensioned
from mooring.loads.box_drag import drag_table
from mooring.studies.conditions import Conditions, Current, Hull, Waves, Wind

from ..common.line_types import LineType, line_properties
from ..common.quantities import StudyError, Table, direction, force, positive, speed
from ..common.typed import read_toml, typed


class WaterTable(Table):
    """depth : m"""

    depth: float


class HullTable(Table):
    """freeboard : m, depth of the hull less draft; the rest is taken from the database where it is known"""

    freeboard: float
    length: float | None = None
    beam: float | None = None
    draft: float | None = None


class Coefficients(Table):
    """Drag coefficients of a box for angles from 0 to 90° between stream and x axis; lever over length"""

    angles_deg: list[float]
    x: list[float]
    y: list[float]
    lever: list[float] | None = None


class StreamTable(Table):
    """speed : m/s, or speed_knots; direction_deg travelled to, or incidence_deg"""

    speed: float | None = None
    speed_knots: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    coefficients: Coefficients | None = None


class WavesTable(Table):
    """height : m, significant; period : s, mean; direction_deg travelled to, or incidence_deg"""

    height: float
    period: float
    direction_deg: float | None = None
    incidence_deg: float | None = None


class Spread(Table):
    """Lines from the four corners of the hull; headings_deg from the x axis, for the corner at +x, +y"""

    type: str
    length: float
    corner_headings_deg: list[float]
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    fairlead_z: float = 0.0


class OneLine(Table):
    """A line to an anchor at (x, y), or along heading_deg to where it carries the pretension; m"""

    name: str
    type: str
    length: float
    fairlead: tuple[float, float, float]
    anchor: tuple[float, float] | None = None
    heading_deg: float | None = None
    pretension_tonf: float | None = None
    pretension_kN: float | None = None


class Study(Table):
    """allowable : fraction of the breaking load a line may carry"""

    water: WaterTable
    hull: HullTable
    types: dict[str, LineType]
    spreads: list[Spread] = msgspec.field(default_factory=list)
    lines: list[OneLine] = msgspec.field(default_factory=list)
    wind: StreamTable | None = None
    current: StreamTable | None = None
    waves: WavesTable | None = None
    allowable: float = 0.4

    def conditions(self):
        """Conditions in SI units"""
        wind, current, waves = self.wind, self.current, self.waves
        if wind:
            extra = {} if wind.coefficients is None else {"table": _coefficients("wind", wind)}
            wind = Wind(speed("wind", wind), direction("wind", wind), **extra)
        if current:
            table = None if current.coefficients is None else _coefficients("current", current)
            current = Current(speed("current", current), direction("current", current), table)
        if waves:
            waves = Waves(
                positive("waves.height", waves.height),
                positive("waves.period", waves.period),
                direction("waves", waves),
            )
        return Conditions(wind, current, waves)

    def hull_of(self, dimensions):
        """Hull with sizes of the study, or of a database (`dimensions`, m); a contradiction is an error."""
        sizes = {}
        for key in ("length", "beam", "draft"):
            own, stored = getattr(self.hull, key), dimensions.get(key)
            if own is None and stored is None:
                raise StudyError(f"hull.{key} is not given and the database does not know it; allowed: m, above 0")
            if own is not None and stored is not None and not math.isclose(own, stored, rel_tol=1e-6):
                raise StudyError(f"hull.{key} is {own:g} m, the database is for {stored:g} m")
            sizes[key] = positive(f"hull.{key}", stored if own is None else own)
        return Hull(**sizes, freeboard=positive("hull.freeboard", self.hull.freeboard))

    def layout(self, hull):
        """Layout of all spreads and lines around a Hull"""
        if not self.spreads and not self.lines:
            raise StudyError("the study has no lines; allowed: at least one [[spreads]] or [[lines]]")
        depth = positive("water.depth", self.water.depth)
        lines = []
        for i, spread in enumerate(self.spreads):
            where = f"spreads[{i}]"
            made = corner_spread(
                hull.length,
                hull.beam,
                _corner_headings(where, spread.corner_headings_deg),
                depth,
                positive(f"{where}.length", spread.length),
                pretension=force(where, spread, "pretension", required=True),
                z=spread.fairlead_z,
                **self._properties(where, spread.type),
            )
            prefix = f"spread {i + 1} " if len(self.spreads) > 1 else ""
            lines += [replace(line, name=prefix + line.name) for line in made.lines]
        lines += [self._line(f"lines[{i}]", line, depth) for i, line in enumerate(self.lines)]
        return Layout(lines)

    def _line(self, where, line, depth):
        length = positive(f"{where}.length", line.length)
        properties = self._properties(where, line.type)
        pretension = force(where, line, "pretension")
        if line.anchor is not None and line.heading_deg is None and pretension is None:
            return Line(line.name, (*line.anchor, -depth), line.fairlead, length, **properties)
        if line.anchor is None and line.heading_deg is not None and pretension is not None:
            heading = math.radians(line.heading_deg)
            return pretensioned(line.name, line.fairlead, heading, depth, length, pretension=pretension, **properties)
        raise StudyError(f"{where} ({line.name}): allowed: either anchor, or heading_deg with a pretension")

    def _properties(self, where, name):
        if name not in self.types:
            raise StudyError(f"{where}.type is {name!r}; allowed: {', '.join(self.types)}")
        return line_properties(f"types.{name}", self.types[name])


def read_study(path):
    """The Study of a TOML file and its text.  Raises StudyError."""
    raw, text = read_toml(path, "a study", StudyError)
    return make_study(raw), text


def make_study(raw):
    """The Study of nested dictionaries as TOML gives them.  Raises StudyError."""
    study = typed(raw, Study, StudyError)
    if not 0 < study.allowable <= 1:
        raise StudyError(f"allowable is {study.allowable:g}; allowed: above 0, at most 1")
    positive("water.depth", study.water.depth)
    return study


def _corner_headings(where, degrees):
    wrong = [value for value in degrees if not 0 <= value <= 90]
    if wrong or not degrees:
        shown = f"{wrong[0]:g}" if wrong else "empty"
        raise StudyError(f"{where}.corner_headings_deg is {shown}; allowed: 0 to 90, at least one")
    return np.radians(degrees)


def _coefficients(where, table):
    c = table.coefficients
    try:
        return drag_table(np.radians(c.angles_deg), c.x, c.y, c.lever)
    except ValueError as error:
        raise StudyError(f"{where}.coefficients: {error}") from None
