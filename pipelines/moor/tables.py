"""Tables of a mooring study as TOML has them, with their keys, units and defaults (`study.Study` joins them)."""

from __future__ import annotations

import msgspec

from ..common.line_tables import LineTable
from ..common.quantities import Table
from ..common.weather.seas import SeaTable
from ..common.weather.streams import SuperstructureTable


class HullTable(SuperstructureTable, kw_only=True):
    """The hull in wind and current

    freeboard : m, height of the deck above still water; needed with wind
    length : m, by default that of the database
    beam : m, by default that of the database
    draft : m, by default that of the database
    """

    freeboard: float | None = None
    length: float | None = None
    beam: float | None = None
    draft: float | None = None


class Spread(LineTable, kw_only=True):
    """Lines from the four corners of the hull

    corner_headings_deg : angles from the x axis, 0 to 90, of the lines at the corner +x, +y; the others are mirrored
    pretension : horizontal, at rest
    fairlead_z : m, above still water
    body : name of one of several bodies, whose corners they are
    """

    corner_headings_deg: list[float]
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    fairlead_z: float = 0.0
    body: str = ""


class OneLine(LineTable, kw_only=True):
    """A line to an anchor, along a heading to where it carries the pretension, to a bollard, or to another body

    name : for results and messages
    fairlead : m, x, y, z on the body at rest
    anchor : m, x, y on the bed
    bollard : m, x, y, z, still, in place of an anchor; a hawser to it has a length or a pretension
    heading_deg : from the fairlead to the anchor, 0 → +x
    pretension : horizontal, at rest
    body : name of one of several bodies, in whose coordinates the fairlead is
    to : name of another of them, in whose coordinates the bollard is
    """

    name: str
    fairlead: tuple[float, float, float]
    anchor: tuple[float, float] | None = None
    bollard: tuple[float, float, float] | None = None
    heading_deg: float | None = None
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    body: str = ""
    to: str = ""


class LostTable(Table):
    """A line that breaks

    line : its name in results
    time : s, from the end of the ramp
    """

    line: str
    time: float


class GivenForceTable(Table):
    """A given force on the body

    file : CSV beside the study, of t (s from the end of the ramp), Fx, Fy, Fz (N), Mx, My, Mz (N m) on the body
    body : name of the one it acts on, of several
    """

    file: str
    body: str = ""


class RecordTable(Table):
    """A measured record of the waves at the body's place, in place of [waves]; every seed has the same waves

    file : CSV beside the study, of time_s and elevation_m, equally spaced, as long as ramp and duration
    shortest : s, period below which waves are left out, by default that of the highest stored frequency
    """

    file: str
    direction_deg: float | None = None
    incidence_deg: float | None = None
    shortest: float | None = None


class SimulationTable(Table):
    """A run in time, for simulate

    duration : s, duration of the statistics
    duration_hours : the same in hours
    ramp : s, time before the duration, in which every load grows from 0
    step : s, between samples
    tolerance : error of the motions, relative to their standard deviations
    seeds : number of seeds, from 1 on, or a list of them
    keep_series : number of seeds whose records are stored
    components : wave components of each sea, by default chosen by duration and bandwidth
    slow_drift : "newman", "half-waves" of the SR179 report, "mean" or "none"
    wave_drift_damping : whether slow velocities change the drift (wave drift damping)
    qtf : slow force of pairs of waves: "auto" for what the database has of it where Newman's rule is not enough,
        "newman", "bound-wave", "body" or "full", as in a response study
    motions : names of the motions that are free, by default all; the others are held at rest and need no
        hydrodynamics
    memory : "states", or "constant" for added mass and damping at one frequency
    constant_period : s, period of that frequency; by default the mean period of the waves
    dynamic_lines : which lines have inertia, drag and a motion of their own: "auto" for all where a trial asks for it,
        "all", "none", or names; the others hang in their static shape.  They are uniform, of a catalogue type
    dynamic_elements : of each of these
    dynamic_water : what moves the water around these: "still" for nothing, or "sea" for waves and current
    estimate_error : whether a second run to a tenth of the tolerance says how far the first is off, and a third to a
        hundredth where the second differs by more than a third of the tolerance
    damping_ratio : {motion = share of critical}, beyond waves, as in a response study
    linear_damping : kN s/m, {motion = B₁}, kN m s of rotations, as `hakobune damping` finds it
    quadratic_damping : kN s²/m², {motion = B₂}, kN m s² of rotations, as `hakobune damping` finds it
    spring : kN/m, {motion = K}, kN m of rotations, about the place at rest in calm water: a test rig, a power take-off
    offset : m, {motion = x}, degrees of rotations, from its place at rest at the start; with a ramp of 0 a free decay
    velocity : m/s, {motion = v}, degrees/s of rotations, at the start
    """

    duration: float | None = None
    duration_hours: float | None = None
    ramp: float = 200.0
    step: float = 0.5
    tolerance: float = 1e-3
    seeds: int | list[int] = 1
    keep_series: int = 20
    components: int | None = None
    slow_drift: str = "newman"
    wave_drift_damping: bool = True
    qtf: str = "auto"
    motions: list[str] = msgspec.field(default_factory=list)
    memory: str = "states"
    constant_period: float | None = None
    dynamic_lines: str | list[str] = "auto"
    dynamic_elements: int = 20
    dynamic_water: str = "still"
    estimate_error: bool = False
    damping_ratio: dict[str, float] = msgspec.field(default_factory=dict)
    linear_damping: dict[str, float] = msgspec.field(default_factory=dict)
    quadratic_damping: dict[str, float] = msgspec.field(default_factory=dict)
    spring: dict[str, float] = msgspec.field(default_factory=dict)
    offset: dict[str, float] = msgspec.field(default_factory=dict)
    velocity: dict[str, float] = msgspec.field(default_factory=dict)
    lines_lost: list[LostTable] = msgspec.field(default_factory=list)
    force: list[GivenForceTable] = msgspec.field(default_factory=list)
    sea: list[SeaTable] = msgspec.field(default_factory=list)
    record: RecordTable | None = None


class HarbourTable(Table):
    """The harbour of a berth

    periods : s, natural periods of the harbour; natural periods of the moored body near them are named
    """

    periods: list[float]


class QuayTable(Table):
    """A vertical quay along x that reflects all waves, for simulate

    y : m, y of its face with the body at rest, as y of fenders
    method : "far-field" makes it of a database of open water, with all but the waves that decay between hull and quay;
        "panels" takes a database that was solved with --wall at y.  By default whichever fits the database
    """

    y: float
    method: str | None = None
