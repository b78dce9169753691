"""Tables of a mooring study in TOML, with their keys, units and defaults (`study.Study` joins them)."""

import msgspec

from ..common.line_tables import LineTable
from ..common.quantities import Table
from ..common.quay_tables import StationTable
from ..common.weather.seas import SeaTable
from ..common.weather.streams import SuperstructureTable


class HullTable(SuperstructureTable, kw_only=True):
    """The hull in wind and current

    freeboard : m, height of the deck above still water; needed with wind
    length : m, length of the hull; by default that of the database
    beam : m, beam of the hull; by default that of the database
    draft : m, draft of the hull; by default that of the database
    """

    freeboard: float | None = None
    length: float | None = None
    beam: float | None = None
    draft: float | None = None


class Spread(LineTable, kw_only=True):
    """Lines from the four corners of the hull

    corner_headings_deg : angles from the x axis, 0 to 90, of the lines at the corner +x, +y; lines at other corners
        are mirrored
    pretension : horizontal tension at rest
    fairlead_z : m, height of the fairleads above still water
    body : name of the body whose corners are used, where there are several
    """

    corner_headings_deg: list[float]
    pretension_tonf: float | None = None
    pretension_kN: float | None = None
    fairlead_z: float = 0.0
    body: str = ""


class OneLine(LineTable, kw_only=True):
    """A line from a fairlead to an anchor, a bollard or another body, or along a heading up to its pretension

    name : name of the line in results and messages
    fairlead : m, x, y, z on the body at rest
    anchor : m, x, y on the bed
    bollard : m, x, y, z of a fixed bollard in place of an anchor; a hawser to a bollard needs a length or a pretension
    heading_deg : direction from the fairlead to the anchor, 0 → +x
    pretension : horizontal tension at rest
    body : name of the body in whose coordinates the fairlead is given, where there are several bodies
    to : name of another body to which the line leads; the bollard is then given in that body's coordinates
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
    """A line that breaks during the simulation

    line : name of the line in results
    time : s, time of the break, from the end of the ramp
    """

    line: str
    time: float


class GivenForceTable(Table):
    """A force on the body from a file

    file : CSV file beside the study with the columns t (s from the end of the ramp), Fx, Fy, Fz (N), Mx, My, Mz (N m)
    body : name of the body that the force acts on, where there are several
    at : s, time in the run at which the table's t is 0; a table that begins and ends with zeros may be shorter than
        the run
    """

    file: str
    body: str = ""
    at: float = 0.0


class RecordTable(Table):
    """A measured wave record at the body's place, in place of [waves]; every seed has the same waves

    file : CSV file beside the study with the columns time_s and elevation_m, equally spaced in time, at least as long
        as ramp and duration
    shortest : s, shortest wave period that is kept; by default the period of the highest stored frequency
    """

    file: str
    direction_deg: float | None = None
    incidence_deg: float | None = None
    shortest: float | None = None


class SimulationTable(Table):
    """Settings of a simulation in time

    duration : s, duration of the statistics, after the ramp
    duration_hours : duration of the statistics, in hours
    ramp : s, time before the duration of the statistics, in which every load grows from 0
    step : s, sampling interval of the records
    tolerance : error of the motions, relative to their standard deviations
    seeds : number of seeds, which then count from 1, or a list of seeds
    keep_series : number of seeds whose records are stored
    components : number of wave components of each sea; by default chosen by duration and bandwidth
    slow_drift : method of the slow drift force: "newman", "half-waves" of the SR179 report, "mean" or "none"
    wave_drift_damping : whether slow velocities change the drift force (wave drift damping)
    qtf : method of the slow force of wave pairs: "newman", "bound-wave", "body" or "full", as in a response study;
        or "auto", which uses the forces stored in the database where Newman's approximation is not accurate enough
    motions : names of the free motions, by default all; other motions are held at rest and need no hydrodynamics
    memory : method of the radiation force: "states", or "constant" for added mass and damping at one frequency
    constant_period : s, period of that frequency; by default the mean period of the waves
    dynamic_lines : lines simulated with inertia, drag and their own motion: "auto" (all lines, if a trial run shows
        the need), "all", "none", or a list of names. All other lines have their static shape. The types of dynamic
        lines and of their segments need mass and diameter, as those of the catalogue have
    dynamic_elements : number of elements of each dynamic line
    dynamic_water : water motion around dynamic lines: "still" for none, or "sea" for waves and current
    estimate_error : whether a second run at a tenth of the tolerance estimates the error; if the two differ by more
        than a third of the tolerance, a third run at a hundredth follows
    damping_ratio : {motion = share of critical damping}, in addition to radiation, as in a response study
    linear_damping : kN s/m, {motion = B₁}, kN m s for rotations, as `hakobune damping` computes it
    quadratic_damping : kN s²/m², {motion = B₂}, kN m s² for rotations, as `hakobune damping` computes it
    spring : kN/m, {motion = K}, kN m for rotations, about the position at rest in calm water: a test rig, a power
        take-off
    offset : m, {motion = x}, degrees for rotations, initial displacement from rest; with a ramp of 0 a free decay
    velocity : m/s, {motion = v}, degrees/s for rotations, initial velocity
    stations : sections of a flexible beam, as in a response study; by default the middle of each beam
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
    stations: list[StationTable] = msgspec.field(default_factory=list)


class HarbourTable(Table):
    """Natural periods of the harbour of a berth

    periods : s, natural periods of the harbour; a natural period of the moored body near one of these is reported
    """

    periods: list[float]


class QuayTable(Table):
    """A vertical quay along x that reflects all waves, for simulate

    y : m, y of the quay's face with the body at rest, like the y of fenders
    method : "far-field", for a database of open water, which neglects the decaying waves between hull and quay; or
        "panels", for a database solved with --wall at y; by default the method that fits the database
    """

    y: float
    method: str | None = None
