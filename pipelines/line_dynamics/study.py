"""One mooring line and the motion of its fairlead, as typed TOML.

Keys are in m, s, kg and degrees; a key with another unit ends in that unit.
Segments, and the bodies between them, count from the anchor up. z is
measured from still water, and under the anchor the bed lies `water.depth` below still water.
Every fault is one line that names
key, value and allowed values.
"""

from pathlib import Path

import msgspec

from ..common.line_tables import AttachedTable, MaterialTable, SegmentTable
from ..common.quantities import StudyError, Table
from ..common.typed import read_toml, typed
from ..common.weather import water
from ..common.weather.seas import SeaTable, seas_at


class WaterTable(water.WaterTable):
    """Water at the anchor

    depth : m, water depth at the anchor; inf for a line that touches no bed
    """


class BedTable(Table):
    """An elastic sea bed under the line, flat, sloping or uneven

    friction : coefficient of friction between line and bed
    points : m, points [x, z], … of the bed, x from the anchor along the line; in place of a slope
    slope_deg : slope of the bed, positive upwards along uphill_deg
    uphill_deg : direction in which the bed rises, 0 → +x; with points, the direction of increasing x, by default
        towards the mean position of the fairlead
    stiffness_kPa_per_m : stiffness of the bed for each metre of line, divided by the line's diameter
    damping_kPa_s_per_m : damping of the bed for each metre of line, divided by the line's diameter
    """

    friction: float = 0.0
    points: list[tuple[float, float]] = msgspec.field(default_factory=list)
    slope_deg: float = 0.0
    uphill_deg: float | None = None
    stiffness_kPa_per_m: float = 300.0
    damping_kPa_s_per_m: float = 30.0


class DynamicTypeTable(MaterialTable):
    """Material of a line in motion

    elongation_percent : %, elongations from 0 on of a rope with nonlinear stiffness, with straight lines between the
        points
    tension : tension of a rope with nonlinear stiffness at each elongation, from 0 on
    """

    elongation_percent: list[float] | None = None
    tension_tonf: list[float] | None = None
    tension_kN: list[float] | None = None


class HarmonicTable(Table):
    """A harmonic motion of the fairlead

    amplitude : m, amplitudes along x, y, z
    period : s, period of the motion
    phase_deg : phase lags along x, y, z behind the time origin
    """

    amplitude: tuple[float, float, float]
    period: float
    phase_deg: tuple[float, float, float] = (0.0, 0.0, 0.0)


class FairleadTable(Table):
    """Motion of the fairlead: a mean position with harmonic motions, or a table of positions

    position : m, x, y, z of the mean position
    table : CSV file beside this one with the columns t,x,y,z in s and m
    ramp : s, time in which the motion grows from rest; by default the longest period, for a table 0
    """

    position: tuple[float, float, float] | None = None
    motions: list[HarmonicTable] = msgspec.field(default_factory=list)
    table: str | None = None
    ramp: float | None = None


class CurrentTable(Table):
    """A current over the depth

    speed : m/s, speed at the surface; or give speed_knots
    exponent : exponent α of the profile U(z) = U₀ (1 + z/h)^α
    z : m, z of the given speeds, ascending from the bed; in place of an exponent
    speeds : m/s, speed at each z
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

    phase_deg : phase lag at the origin
    """

    phase_deg: float = 0.0


class LineSeaTable(SeaTable):
    """An irregular sea, in place of a regular wave

    seed : random seed of phases and frequencies; the same seed gives the same sea
    components : number of wave components
    """

    seed: int = 1
    components: int = 100


class MoorDynTable(Table):
    """A line of a MoorDyn file, in place of water, types, segments, bodies and anchor

    file : MoorDyn file beside this one
    line : number of the line in that file; any of the numbers where free points join several lines
    depth : m, water depth; needed where the file has none
    """

    file: str
    line: str | int
    depth: float | None = None


class LineDynamicsStudy(Table):
    """One mooring line and the motion of its fairlead

    anchor : m, x, y, z of the anchor in space
    name : name of the line in results and pictures
    duration : s, duration of the simulation; by default the duration of a table, or twelve times the longest period;
        needed with a sea
    tolerance : allowed error of every tension in a step, relative to the largest tension
    surface : whether parts above still water have their weight in air and no water loads; by default only for a MoorDyn
        file
    measure_from : s, time from which statistics are computed; by default the end of the ramp
    frames : number of stored pictures of the line; by default about 20 for each cycle
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
    """The LineDynamicsStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_toml(path, "a study", StudyError)
    return make_line_dynamics(seas_at(raw, Path(path).parent)[0]), text


def make_line_dynamics(raw):
    """The LineDynamicsStudy of nested dictionaries read from TOML.  Raises StudyError."""
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
        raise StudyError("there are no segments; give at least one [[segments]], from the anchor upwards")
    return study
