"""A downtime study as typed TOML: a hindcast, a body, and the limits of operations.

[hindcast]
file = "hindcast.csv"            # CSV or netCDF file beside the study
x_axis_compass_deg = 60.0        # compass heading of the bow
[[hindcast.waves]]               # a system of waves; more of them for wind sea and swell
height = "hs"                    # names of columns
peak_period = "tp"
direction_from = "dir"
spreading = "cosine:4"
[hindcast.columns]
"wind speed" = "wind"

[body]                           # tables of a response study, with [[points]] and [keel]
damping_ratio = { roll = 0.02 }

[[operations]]
name = "cranes"
window_hours = 12
limits = [{ quantity = "roll", at_most = 1.0 }, { quantity = "wind speed", at_most = 15.0 }]
"""

import msgspec

from ..common.quantities import Table
from ..response.study import BodyTable, KeelTable, PointTable

PASSING = {"passing surge": "kN", "passing sway": "kN", "passing yaw": "kN m"}


class WavesColumns(Table):
    """Columns of one wave system (one height, one period, one direction), and its spectrum

    height : name of the column of the significant height, m
    mean_period : name of the column of the mean period T₀₁, s; or give another of the periods
    zero_crossing_period : name of the column of the zero-crossing period T₀₂, s
    energy_period : name of the column of the energy period T₋₁₀, s
    peak_period : name of the column of the peak period, s
    significant_period : name of the column of the significant period T₁/₃, s
    direction_from : name of the column of the compass direction that waves come from, degrees; or give direction_to
    direction_to : name of the column of the compass direction that waves travel to, degrees; or give direction_from
    """

    height: str
    mean_period: str | None = None
    zero_crossing_period: str | None = None
    energy_period: str | None = None
    peak_period: str | None = None
    significant_period: str | None = None
    direction_from: str | None = None
    direction_to: str | None = None
    spectrum: str = "jonswap"
    gamma: float | None = None
    spreading: str | None = None


class HindcastTable(Table):
    """A weather record of several years

    file : CSV, netCDF, NDBC or SWAN table beside the study; a pattern such as "era5_*.nc" joins several files
    waves : columns of the wave systems; not given for a netCDF file with a spectrum for each hour
    time : name of the column of times, ISO 8601
    location : number of the place, counted from 1, in a netCDF file of several places; the count runs fastest along
        the last axis
    zone : time zone of all times that are written without one: UTC, +09:00 or a name such as Europe/Berlin
    x_axis_compass_deg : compass heading of the body's x axis
    level_at_rest : m, value in the column "level" that corresponds to the water level of the database
    columns : {quantity = column}, for "wind speed", "wind from", "current speed", "current to", or for the
        components "wind east", "wind north", "current east", "current north"; also for level, ice and any other
        quantity with a limit
    """

    file: str
    x_axis_compass_deg: float
    waves: list[WavesColumns] = msgspec.field(default_factory=list)
    time: str = "time"
    zone: str = "UTC"
    location: int | None = None
    level_at_rest: float | None = None
    columns: dict[str, str] = msgspec.field(default_factory=dict)


class LimitTable(Table):
    """A limit on an operation

    quantity : a motion such as "roll"; the "significant height"; or a column of the hindcast. With [simulation]
        motions are those of the moored body, and "tension / breaking load", "fender deflection" and "fender
        reaction" are allowed. Without [simulation] responses of a point are allowed: "bow acceleration z", "air gap
        NAME" or "under-keel clearance"
    at_most : upper limit, in m, degrees, m/s², or the unit of the hindcast's column; or give at_least
    at_least : lower limit in the same units, for an air gap, an under-keel clearance or a column; or give at_most
    statistic : statistic of a motion: "largest", the mean of the largest amplitude in an hour; "significant"; or "peak
        to peak"
    """

    quantity: str
    at_most: float | None = None
    at_least: float | None = None
    statistic: str = "largest"


class OperationTable(Table):
    """A kind of operation and its limits

    name : name of the operation in results
    rule : name of a rule set whose limits apply in addition, as "PIANC"
    subject : part of the rule set that applies, as "freighter, coaster; quay cranes"
    window_hours : h, time that the operation needs without interruption
    allowed_hours : allowed downtime, h per year; the study fails above this downtime
    """

    name: str
    limits: list[LimitTable] = msgspec.field(default_factory=list)
    rule: str | None = None
    subject: str | None = None
    window_hours: float = 6.0
    allowed_hours: float | None = None


class LeeTable(Table):
    """The lee of a floating breakwater in place of a body, for limits on "wave height behind"

    study : file of a breakwater study beside this one, whose transmission applies to waves from all directions
    holding : name of a holding of the breakwater study; by default the holding of its [design], or its last holding
    """

    study: str
    holding: str | None = None


class PassagesTable(Table):
    """Passing ships, for limits on "passing surge" (kN), "passing sway" (kN) and "passing yaw" (kN m) in each hour

    file : list of passages beside this one, with a row for each
    study : file of a study of a passing ship, whose distance and speed are replaced by those of each passage
    time : name of the column of the time of the passage
    distance : name of the column of the distance between the centre lines, m
    speed : name of the column of the ship's speed through the water, m/s
    """

    file: str
    study: str
    time: str = "time"
    distance: str = "distance"
    speed: str = "speed"


class AlternativeTable(Table):
    """Another mooring of the same body, for comparison

    name : name of the alternative in results
    study : file of a mooring study beside this one, with different fenders, lines or pretensions
    turned_deg : clockwise rotation of the body with its mooring
    """

    name: str
    study: str
    turned_deg: float = 0.0


class StatesTable(Table):
    """Selected sea states in which the moored body is simulated; results of all other hours are interpolated

    study : file of a mooring study beside this one; each hour of the hindcast replaces its waves, and its wind if
        the hindcast has wind
    states : number of states at the start, 8 or more, selected by maximum dissimilarity
    most_states : largest number of states
    batch : number of states added at a time, among hours whose verdict may still change
    seeds : number of simulations of each state, 2 or more
    duration_hours : duration of a simulation
    tolerance_hours : tolerated error of the interpolation in the downtime of each operation, h per year
    alternatives : other moorings; each is simulated in its own selected states, which are stored in its own file
    """

    study: str
    states: int = 50
    most_states: int = 200
    batch: int = 10
    seeds: int = 3
    duration_hours: float = 1.0
    tolerance_hours: float = 20.0
    alternatives: list[AlternativeTable] = msgspec.field(default_factory=list)


class DowntimeStudy(Table):
    """Downtime at a berth from years of weather

    windows_hours : lengths of the weather windows that are counted
    return_years : years, return period of the extreme responses
    turned_deg : degrees, clockwise rotations of the body that are compared with the berth as it is
    """

    hindcast: HindcastTable
    operations: list[OperationTable]
    body: BodyTable = msgspec.field(default_factory=BodyTable)
    points: list[PointTable] = msgspec.field(default_factory=list)
    keel: KeelTable | None = None
    lee: LeeTable | None = None
    passages: PassagesTable | None = None
    simulation: StatesTable | None = None
    windows_hours: list[float] = msgspec.field(default_factory=lambda: [3.0, 6.0, 12.0, 24.0, 48.0])
    return_years: float = 50.0
    turned_deg: list[float] = msgspec.field(default_factory=list)
