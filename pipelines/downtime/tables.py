"""A downtime study as typed TOML: a hindcast, a body, and what operations can bear.

[hindcast]
file = "hindcast.csv"            # beside the study; netCDF too
x_axis_compass_deg = 60.0        # what the bow heads
[[hindcast.waves]]               # a system of waves; more of them for wind sea and swell
height = "hs"                    # names of columns
peak_period = "tp"
direction_from = "dir"
spreading = "cosine:4"
[hindcast.columns]
"wind speed" = "wind"

[body]                           # as in a response study, with [[points]] and [keel]
damping_ratio = { roll = 0.02 }

[[operations]]
name = "cranes"
window_hours = 12
limits = [{ quantity = "roll", at_most = 1.0 }, { quantity = "wind speed", at_most = 15.0 }]
"""

from __future__ import annotations

import msgspec

from ..common.quantities import Table
from ..response.study import BodyTable, KeelTable, PointTable

PASSING = {"passing surge": "kN", "passing sway": "kN", "passing yaw": "kN m"}


class WavesColumns(Table):
    """Columns of a system of waves: a height, one period, a direction; and the shape that its spectrum has

    height : column, m, significant
    mean_period : column, s; or one of zero_crossing_period, energy_period, peak_period, significant_period
    direction_from : column, degrees of the compass that waves come from; or direction_to
    direction_to : column, degrees of the compass that waves travel to
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
    """A record of years of weather

    file : CSV, netCDF, NDBC or a table of SWAN beside the study; "era5_*.nc" for several, one after the other
    waves : systems of waves in columns; none where the file has a spectrum of each hour (netCDF)
    time : column, ISO 8601
    location : number of the place, from 1, in netCDF of several, the last of its axes fastest
    zone : of times without an offset: UTC, +09:00 or a name such as Europe/Berlin
    x_axis_compass_deg : what the x axis of the body heads
    level_at_rest : m, what the column level has at the water level of the database
    columns : {quantity = column}: "wind speed", "wind from", "current speed", "current to", or "wind east", "wind
        north", "current east", "current north" in place of these, level, ice, and any other that a limit is on
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
    """What an operation can bear

    quantity : a motion as "roll"; with [simulation] that of the moored body, also "tension / breaking load", "fender
        deflection" and "fender reaction"; without, a response of a point as "bow acceleration z", "air gap NAME" or
        "under-keel clearance"; or of the hindcast "significant height" or a column
    at_most : m, degrees, m/s2, or the unit of a column
    at_least : likewise, of what is left: an air gap, water under the keel
    statistic : of a motion: largest, the mean largest amplitude of an hour; significant; peak to peak
    """

    quantity: str
    at_most: float | None = None
    at_least: float | None = None
    statistic: str = "largest"


class OperationTable(Table):
    """A kind of operation, and its limits

    name : for results
    rule : rule set of `mooring/criteria/tables` whose limits are taken too, as "PIANC"
    subject : of the rule set, as "freighter, coaster; quay cranes"
    window_hours : h, that it needs without a break
    allowed_hours : h a year, above which the study fails
    """

    name: str
    limits: list[LimitTable] = msgspec.field(default_factory=list)
    rule: str | None = None
    subject: str | None = None
    window_hours: float = 6.0
    allowed_hours: float | None = None


class LeeTable(Table):
    """The lee of a floating breakwater, in place of a body: limits on "wave height behind"

    study : breakwater study beside this one, whose transmission is taken of waves from all directions
    holding : one of its holdings, by default that of its [design], or the last
    """

    study: str
    holding: str | None = None


class PassagesTable(Table):
    """Ships that pass: limits on "passing surge", "passing sway" (kN) and "passing yaw" (kN m), the most of each hour

    file : list beside this one, a row for each passage
    study : study of a passing ship, whose distance and speed are those of each passage
    time, distance, speed : its columns; m between the centre lines, and m/s
    """

    file: str
    study: str
    time: str = "time"
    distance: str = "distance"
    speed: str = "speed"


class AlternativeTable(Table):
    """Another mooring of the same body, to compare

    name : for results
    study : mooring study beside this one: the next fender, line or pretension
    turned_deg : clockwise, by which the body with its mooring lies otherwise
    """

    name: str
    study: str
    turned_deg: float = 0.0


class StatesTable(Table):
    """Limits on a moored body, simulated in states that stand for all hours

    study : mooring study beside this one; its waves are those of each hour, and its wind where the hindcast has one
    states : how many to begin with, by maximum dissimilarity
    most_states : beyond which none is added
    batch : states that are added at once where verdicts may change
    seeds : of each state
    duration_hours : h, of a run
    tolerance_hours : h a year, of the hours of each operation, for the interpolant alone
    alternatives : each simulated in states of its own, whose files stand beside that of the states
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
    """Hours at a berth that operations cannot use

    windows_hours : h, lengths of windows that are counted
    return_years : of the largest responses
    turned_deg : degrees clockwise by which the body lies otherwise, to compare
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
