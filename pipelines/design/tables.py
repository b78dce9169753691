"""Tables of a design project as typed TOML; `project` reads and checks them."""

from __future__ import annotations

import msgspec

from ..common.quantities import Table
from ..common.weather.seas import WavesTable
from ..common.weather.streams import CurrentTable, WindTable
from ..moor.tables import SimulationTable

MEAN = "mean"  # the level of the study's own water


class ProjectTable(Table):
    """What is designed, and for how long

    name : title of the report
    study : beside this file: a mooring study, one of a berth (with fenders or ropes), a single point or a breakwater
    scene : file of the body's scene, solved at every level; or give database
    database : file of the solved body; or give scene; a single point and a breakwater need none
    site : file of values of a site, by hakobune site, for weather, levels and service life
    service_life : years
    probability : that the value of an extreme state is not exceeded in them
    note : of the report
    author : of the report
    client : whom it is for
    revision : of the report, as "B"
    date : of the report, as "31 March 2026"
    other_rules : whether the report says what rule sets that were not asked for say to the same cases
    """

    name: str
    study: str
    scene: str | None = None
    database: str | None = None
    site: str | None = None
    service_life: float | None = None
    probability: float | None = None
    note: str = ""
    author: str = ""
    client: str = ""
    revision: str = ""
    date: str = ""
    other_rules: bool = False


class StateTable(Table):
    """A state of weather, its directions, water levels and lines

    name : for results
    state : normal or abnormal, as the rules have it
    incidence_deg : of waves; wind and current come from there too, and from as many degrees off as are listed
    wind_off_deg : of the wind from the waves
    current_off_deg : of the current from the waves
    levels : names of water levels, "mean" for the study's own
    lines : "intact", "one lost"; a rope of a berth counts as a line
    lost : the "worst" line of the intact case, or "each"
    weather : name of a state of the site, for wind, current and waves that are not given here
    share : of the service life with this weather, for fatigue
    """

    name: str
    state: str
    incidence_deg: list[float]
    wind_off_deg: list[float] = msgspec.field(default_factory=lambda: [0.0])
    current_off_deg: list[float] = msgspec.field(default_factory=lambda: [0.0])
    levels: list[str] = msgspec.field(default_factory=lambda: [MEAN])
    lines: list[str] = msgspec.field(default_factory=lambda: ["intact"])
    lost: str = "worst"
    weather: str | None = None
    share: float = 0.0
    wind: WindTable | None = None
    current: CurrentTable | None = None
    waves: WavesTable | None = None


class RuleTable(Table):
    """A rule set and what of it applies

    rule : its name
    subject : what of it applies, by default all
    file : of rules of one's own in place of the tables
    confirmed : whether criteria that nobody has checked in the book are judged; has to be said where there are any
    """

    rule: str
    subject: str | None = None
    file: str | None = None
    confirmed: bool | None = None


class LimitTable(Table):
    """A limit of one's own, beside rule sets

    quantity : as rule sets name it: "surge", "fender strain, total", "transmitted wave height", …
    at_most : in the unit of the quantity; or at_least
    at_least : likewise
    unit : that of the quantity, which it is if left out; another is refused
    state : normal, abnormal or any
    lines : intact, one lost or any
    subject : "hawser" for tensions of hawsers; without, of all other lines
    statistic : largest, or of motions amplitude or peak to peak
    source : who asks for it
    """

    quantity: str
    source: str
    at_most: float | None = None
    at_least: float | None = None
    unit: str = ""
    state: str = "any"
    lines: str = "any"
    subject: str = ""
    statistic: str = "largest"


class ValueTable(Table):
    """A value that no load case finds, from elsewhere, for a criterion that asks for it

    quantity : as rule sets name it: "bending stress / yield stress", "gust factor", …
    value : in the unit of the criterion
    source : where it is from, such as a calculation
    state : that it is of: normal, abnormal or any
    lines : intact, one lost or any
    """

    quantity: str
    value: float
    source: str
    state: str = "any"
    lines: str = "any"


class EarthquakeCase(Table):
    """An earthquake at the dolphins of a berth, as a load case of the abnormal state

    name : for results
    study : beside this file, of hakobune earthquake; without [body] it has that of the database
    """

    name: str
    study: str


class WearTable(Table):
    """What chain loses of its diameter

    mm_per_year : of diameter
    years : by default the service life
    """

    mm_per_year: float
    years: float | None = None


class AnchorsTable(Table):
    """Holding capacity of the anchors

    holding_kN : of an anchor
    lines : kN, {name of a line = capacity of its anchor}, where it is another
    """

    holding_kN: float
    lines: dict[str, float] = msgspec.field(default_factory=dict)


class FatigueTable(Table):
    """Fatigue of the lines by their tensions in time

    curve : name of a curve of cycles to failure, such as "DNV studless chain"; or give one's own, N = a s^−m
    exponent : m of one's own
    constant : a of one's own
    basis : of its s: "stress", MPa over the nominal area, of both legs of a chain; "share", the tension range over the
        breaking load, of a chain over that of grade ORQ of its size
    chain : whether one's own is of chain
    factor : by which the damage over the service life is multiplied, at least 1
    """

    curve: str | None = None
    exponent: float | None = None
    constant: float | None = None
    basis: str = "stress"
    chain: bool = False
    factor: float = 3.0


class Project(Table):
    """A site, its states of weather and the rules that judge them

    levels : m, {name = above the water of the study}
    """

    project: ProjectTable
    states: list[StateTable]
    rules: list[RuleTable] = msgspec.field(default_factory=list)
    limits: list[LimitTable] = msgspec.field(default_factory=list)
    values: list[ValueTable] = msgspec.field(default_factory=list)
    earthquakes: list[EarthquakeCase] = msgspec.field(default_factory=list)
    levels: dict[str, float] = msgspec.field(default_factory=dict)
    wear: WearTable | None = None
    anchors: AnchorsTable | None = None
    fatigue: FatigueTable | None = None
    simulation: SimulationTable | None = None

    @property
    def database_with_levels(self):
        """Whether levels are asked for beside the database of one depth"""
        return self.project.database is not None and bool(self.levels)

    def level(self, name):
        """m above the water of the study"""
        return 0.0 if name == MEAN else self.levels[name]
