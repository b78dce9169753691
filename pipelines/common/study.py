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

from .typed import read_toml, typed

KNOT = 1852 / 3600  # m/s
TONF = 9806.65  # N
KGF = 9.80665  # N


class StudyError(ValueError):
    """A study cannot be used; one line names the key, its value and what is allowed."""


class _Table(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    pass


class WaterTable(_Table):
    """depth : m"""

    depth: float


class HullTable(_Table):
    """freeboard : m, depth of the hull less draft; the rest is taken from the database where it is known"""

    freeboard: float
    length: float | None = None
    beam: float | None = None
    draft: float | None = None


class Coefficients(_Table):
    """Drag coefficients of a box for angles from 0 to 90° between stream and x axis; lever over length"""

    angles_deg: list[float]
    x: list[float]
    y: list[float]
    lever: list[float] | None = None


class StreamTable(_Table):
    """speed : m/s, or speed_knots; direction_deg travelled to, or incidence_deg"""

    speed: float | None = None
    speed_knots: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    coefficients: Coefficients | None = None


class WavesTable(_Table):
    """height : m, significant; period : s, mean; direction_deg travelled to, or incidence_deg"""

    height: float
    period: float
    direction_deg: float | None = None
    incidence_deg: float | None = None


class LineType(_Table):
    """Submerged weight, axial stiffness EA and breaking load, each in one of its units; EA left out: inextensible

    catalogue : a name such as "R3 studless 76 mm", for what is not given
    """

    catalogue: str | None = None
    weight_kg_per_m: float | None = None
    weight_N_per_m: float | None = None
    axial_stiffness_tonf: float | None = None
    axial_stiffness_kN: float | None = None
    breaking_load_tonf: float | None = None
    breaking_load_kN: float | None = None
    bed_friction: float = 0.0


class Spread(_Table):
    """Lines from the four corners of the hull; headings_deg from the x axis, for the corner at +x, +y"""

    type: str
    length: float
    corner_headings_deg: list[float]
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    fairlead_z: float = 0.0


class OneLine(_Table):
    """A line to an anchor at (x, y), or along heading_deg to where it carries the pretension; m"""

    name: str
    type: str
    length: float
    fairlead: tuple[float, float, float]
    anchor: tuple[float, float] | None = None
    heading_deg: float | None = None
    pretension_tonf: float | None = None
    pretension_kN: float | None = None


class Study(_Table):
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
            wind = Wind(_speed("wind", wind), _direction("wind", wind), **extra)
        if current:
            table = None if current.coefficients is None else _coefficients("current", current)
            current = Current(_speed("current", current), _direction("current", current), table)
        if waves:
            waves = Waves(
                _positive("waves.height", waves.height),
                _positive("waves.period", waves.period),
                _direction("waves", waves),
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
            sizes[key] = _positive(f"hull.{key}", stored if own is None else own)
        return Hull(**sizes, freeboard=_positive("hull.freeboard", self.hull.freeboard))

    def layout(self, hull):
        """Layout of all spreads and lines around a Hull"""
        if not self.spreads and not self.lines:
            raise StudyError("the study has no lines; allowed: at least one [[spreads]] or [[lines]]")
        depth = _positive("water.depth", self.water.depth)
        lines = []
        for i, spread in enumerate(self.spreads):
            where = f"spreads[{i}]"
            made = corner_spread(
                hull.length,
                hull.beam,
                _corner_headings(where, spread.corner_headings_deg),
                depth,
                _positive(f"{where}.length", spread.length),
                pretension=_force(where, spread, "pretension", required=True),
                z=spread.fairlead_z,
                **self._properties(where, spread.type),
            )
            prefix = f"spread {i + 1} " if len(self.spreads) > 1 else ""
            lines += [replace(line, name=prefix + line.name) for line in made.lines]
        lines += [self._line(f"lines[{i}]", line, depth) for i, line in enumerate(self.lines)]
        return Layout(lines)

    def _line(self, where, line, depth):
        length = _positive(f"{where}.length", line.length)
        properties = self._properties(where, line.type)
        pretension = _force(where, line, "pretension")
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


def line_properties(where, kind, density=1025.0):
    """weight, axial_stiffness, bed_friction and breaking_load of a LineType, in SI; density : kg/m³ of the water"""
    from mooring.lines.catalogue import line_type

    try:
        known = None if kind.catalogue is None else line_type(kind.catalogue, density)
    except ValueError as error:
        raise StudyError(f"{where}.catalogue: {error}") from None
    weight = _one(where, kind, {"weight_kg_per_m": KGF, "weight_N_per_m": 1.0}, required=known is None)
    if not (kind.bed_friction >= 0 and math.isfinite(kind.bed_friction)):
        raise StudyError(f"{where}.bed_friction is {kind.bed_friction:g}; allowed: at least 0")
    return {
        "weight": weight or known.weight,
        "axial_stiffness": _force(where, kind, "axial_stiffness") or (known.axial_stiffness if known else math.inf),
        "bed_friction": kind.bed_friction,
        "breaking_load": _force(where, kind, "breaking_load") or (known.breaking_load if known else math.inf),
    }


def read_study(path):
    """The Study of a TOML file and its text.  Raises StudyError."""
    raw, text = read_toml(path, "a study", StudyError)
    return make_study(raw), text


def make_study(raw):
    """The Study of nested dictionaries as TOML gives them.  Raises StudyError."""
    study = typed(raw, Study, StudyError)
    if not 0 < study.allowable <= 1:
        raise StudyError(f"allowable is {study.allowable:g}; allowed: above 0, at most 1")
    _positive("water.depth", study.water.depth)
    return study


def _positive(key, value):
    if not 0 < value < math.inf:
        raise StudyError(f"{key} is {value:g}; allowed: above 0, finite")
    return value


def _one(where, table, units, required=False):
    """The value of the one key of `units` {key: factor} that is given, in SI; None if none is and none has to be."""
    given = [key for key in units if getattr(table, key) is not None]
    if len(given) > 1 or (required and not given):
        state = " and ".join(given) + " are given" if given else "nothing is given"
        raise StudyError(f"{where}: {state}; allowed: one of {', '.join(units)}")
    return _positive(f"{where}.{given[0]}", getattr(table, given[0])) * units[given[0]] if given else None


def _force(where, table, name, required=False):
    return _one(where, table, {f"{name}_tonf": TONF, f"{name}_kN": 1e3}, required)


def _speed(where, table):
    return _one(where, table, {"speed": 1.0, "speed_knots": KNOT}, required=True)


def _direction(where, table):
    """rad travelled to"""
    to, incidence = table.direction_deg, table.incidence_deg
    if (to is None) == (incidence is None):
        state = "neither is given" if to is None else "both are given"
        raise StudyError(f"{where}: {state}; allowed: one of direction_deg, incidence_deg")
    degrees = incidence + 180.0 if to is None else to
    if not -360 <= degrees <= 720:
        key = "incidence_deg" if to is None else "direction_deg"
        raise StudyError(f"{where}.{key} is {getattr(table, key):g}; allowed: −360 to 360")
    return math.radians(degrees % 360.0)


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
