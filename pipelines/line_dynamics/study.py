"""One mooring line and the motion of its fairlead, as typed TOML.

In m, s, kg and degrees, other units in the key.  Segments, and the bodies between them, count from the anchor up;
z is measured from still water, and the bed lies `water.depth` below it under the anchor.  Every fault is one line
that names key, value and what is allowed.
"""

from __future__ import annotations

from pathlib import Path

import msgspec

from ..common.line_tables import AttachedTable, MaterialTable, SegmentTable
from ..common.quantities import StudyError, Table
from ..common.typed import read_toml, typed
from ..common.weather import water
from ..common.weather.seas import SeaTable, seas_at


class WaterTable(water.WaterTable):
    """Water at the anchor

    depth : m, under the anchor, inf for a line that touches no bed
    """


class BedTable(Table):
    """An elastic bed, a plane or hills and valleys under the line

    friction : coefficient
    points : m, [x, z], … from its anchor along the line, in place of a slope
    slope_deg : upwards
    uphill_deg : where to, 0 → +x; of points the way they go, by default to the fairlead's mean position
    stiffness_kPa_per_m : times diameter
    damping_kPa_s_per_m : times diameter
    """

    friction: float = 0.0
    points: list[tuple[float, float]] = msgspec.field(default_factory=list)
    slope_deg: float = 0.0
    uphill_deg: float | None = None
    stiffness_kPa_per_m: float = 300.0
    damping_kPa_s_per_m: float = 30.0


class DynamicTypeTable(MaterialTable):
    """What a line that moves is made of

    mass_kg_per_m : in air
    diameter : m, of the displaced volume
    drag_normal : coefficient on D; not given: the catalogue's, and 1.2 without one
    drag_tangential : coefficient on πD; not given: the catalogue's, and 0.1 without one
    added_normal : coefficient of added mass across the line; not given: the catalogue's, and 1 without one
    added_tangential : coefficient of added mass along the line; not given: the catalogue's, and 0 without one
    damping_ratio : structural damping over that which is critical for one element, or a fortieth of its segment
    bending_stiffness : EI, between hinged ends
    elongation_percent : % of its length, from 0 on, of a rope whose stiffness is no number; straight between the points
    tension : of such a rope, at each elongation, from 0 on
    """

    mass_kg_per_m: float | None = None
    diameter: float | None = None
    drag_normal: float | None = None
    drag_tangential: float | None = None
    added_normal: float | None = None
    added_tangential: float | None = None
    damping_ratio: float = 1.0
    bending_stiffness_kN_m2: float = 0.0
    elongation_percent: list[float] | None = None
    tension_tonf: list[float] | None = None
    tension_kN: list[float] | None = None


class HarmonicTable(Table):
    """A harmonic motion of the fairlead

    amplitude : m, along x, y, z
    period : s
    phase_deg : lag of each behind the time origin
    """

    amplitude: tuple[float, float, float]
    period: float
    phase_deg: tuple[float, float, float] = (0.0, 0.0, 0.0)


class FairleadTable(Table):
    """Either a position with harmonic motions about it, or a table of positions

    position : m, x, y, z of its mean
    table : CSV of t,x,y,z in s and m, beside this file
    ramp : s, in which the motion fades in from rest; by default the longest period, and none for a table
    """

    position: tuple[float, float, float] | None = None
    motions: list[HarmonicTable] = msgspec.field(default_factory=list)
    table: str | None = None
    ramp: float | None = None


class CurrentTable(Table):
    """A current over the depth

    speed : m/s, at the surface; or speed_knots
    exponent : α of U(z) = U₀ (1 + z/h)^α
    z : m, rising from the bed, in place of an exponent
    speeds : m/s, at each z
    """

    speed: float | None = None
    speed_knots: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    exponent: float = 0.0
    z: list[float] | None = None
    speeds: list[float] | None = None


class WaveTable(water.WaveTable):
    """A regular wave

    phase_deg : lag at the origin
    """

    phase_deg: float = 0.0


class LineSeaTable(SeaTable):
    """An irregular sea, in place of a wave

    seed : of its phases and frequencies; the same seed gives the same sea
    components : regular waves that it is made of
    """

    seed: int = 1
    components: int = 100


class MoorDynTable(Table):
    """A line of a MoorDyn file, in place of water, types, segments, bodies and anchor

    file : beside this one
    line : its number there, as 1; any of those joined by free points
    depth : m, for a file that does not say it
    """

    file: str
    line: str | int
    depth: float | None = None


class LineDynamicsStudy(Table):
    """One mooring line and the motion of its fairlead

    anchor : m, x, y, z in space
    name : for results and pictures
    duration : s, by default to the end of a table or twelve of the longest period; to be given with a sea
    tolerance : error of a step in any tension, of the largest
    surface : whether parts above still water weigh as in air and feel no water; by default only of a MoorDyn file
    measure_from : s, where the figures begin, by default at the end of the ramp
    frames : pictures of the line that are stored, by default about 20 for each cycle
    """

    fairlead: FairleadTable
    water: WaterTable | None = None
    types: dict[str, DynamicTypeTable] = msgspec.field(default_factory=dict)
    segments: list[SegmentTable] = msgspec.field(default_factory=list)
    anchor: tuple[float, float, float] | None = None
    moordyn: MoorDynTable | None = None
    name: str = "line"
    bodies: list[AttachedTable] = msgspec.field(default_factory=list)
    bed: BedTable | None = None
    current: CurrentTable | None = None
    wave: WaveTable | None = None
    sea: LineSeaTable | None = None
    duration: float | None = None
    tolerance: float = 1e-3
    surface: bool | None = None
    measure_from: float | None = None
    frames: int | None = None


def read_line_dynamics(path):
    """The LineDynamicsStudy of a TOML file and its text.  Raises StudyError."""
    raw, text = read_toml(path, "a study", StudyError)
    return make_line_dynamics(seas_at(raw, Path(path).parent)[0]), text


def make_line_dynamics(raw):
    """The LineDynamicsStudy of nested dictionaries as TOML gives them.  Raises StudyError."""
    study = typed(raw, LineDynamicsStudy, StudyError)
    if study.wave is not None and study.sea is not None:
        raise StudyError("wave and sea are both given; give one of them")
    given = {key: getattr(study, key) for key in ("water", "types", "segments", "anchor")}
    if study.moordyn is not None:
        twice = [key for key, value in (given | {"bodies": study.bodies}).items() if value]
        if twice:
            raise StudyError(f"moordyn and {', '.join(twice)} are both given; give one of them")
        return study
    for key in ("water", "types", "anchor"):
        if not given[key]:
            raise StudyError(f"{key} is missing; give water, types, segments and anchor, or moordyn")
    if not study.water.depth > 0:
        raise StudyError(f"water.depth is {study.water.depth:g}; allowed: above 0, inf for a line without a bed")
    if not study.segments:
        raise StudyError("segments is empty; give at least one [[segments]], from the anchor upwards")
    return study
