"""Tables of a design project as typed TOML; `project` reads and checks them."""

import msgspec

from ..common.quantities import Table
from ..common.weather.seas import WavesTable
from ..common.weather.streams import CurrentTable, WindTable
from ..moor.tables import SimulationTable

MEAN = "mean"  # the level of the study's own water


class ProjectTable(Table):
    """The design and its service life

    name : title of the report
    study : file beside this one: a mooring study, with or without a berth (fenders, ropes), a single point or a
        breakwater
    scene : file of the body's scene, solved at every water level; or give database
    database : file of the solved body; or give scene; optional for a single point and a breakwater
    site : file of site values (weather, levels, service life) written by `hakobune site`
    service_life : years, service life of the mooring
    probability : probability that the extreme value is not exceeded during the service life
    note : note printed in the report
    author : author of the report
    client : client of the report
    revision : revision of the report, as "B"
    date : date of the report, as "31 March 2026"
    other_rules : whether the report also lists the verdicts of rule sets that the project does not name
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
    """A state of weather with its directions, water levels and lines

    name : name of the state in results
    state : class of the state in the rules: normal or abnormal
    incidence_deg : wave directions; each offset in wind_off_deg and current_off_deg is added for wind and current
    wind_off_deg : offsets of the wind direction from the wave direction
    current_off_deg : offsets of the current direction from the wave direction
    levels : names of water levels; "mean" is the water level of the study
    lines : conditions of the lines, "intact" or "one lost"; a rope of a berth counts as a line
    lost : which line is lost: the "worst" of the intact case, or "each" in turn
    weather : name of a state of the site, which supplies the wind, current and waves that are not given here
    share : fraction of the service life with this weather, for fatigue; divided equally among directions and levels
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
    """A rule set, and the part of the rule set that applies

    rule : name of the rule set
    subject : part of the rule set that applies; by default the whole rule set
    file : file of your own rules, in place of the tables of hakobune
    confirmed : whether criteria not checked against the printed rules are used; needed where the rule set has such
        criteria
    """

    rule: str
    subject: str | None = None
    file: str | None = None
    confirmed: bool | None = None


class LimitTable(Table):
    """Your own limit, in addition to the rule sets

    quantity : name of the quantity as in rule sets: "surge", "fender strain, total", "transmitted wave height", …
    at_most : upper limit, in the unit of the quantity; or give at_least
    at_least : lower limit, in the unit of the quantity; or give at_most
    unit : unit of the limit, only to check it: a unit other than the unit of the quantity is refused
    state : states that the limit applies to: normal, abnormal or any
    lines : conditions of the lines that the limit applies to: intact, one lost or any
    subject : for tensions "hawser", by default all lines but hawsers; for motions the name of a body, by default
        all bodies
    statistic : limited statistic: largest, or for motions amplitude or peak to peak. Largest and amplitude of a
        motion are measured from its mean; peak to peak is the largest value less the smallest value of a run
    source : origin of the limit, as "the owner"
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
    """A value computed elsewhere, for a criterion on a quantity that no load case computes

    quantity : name of the quantity as in rule sets: "bending stress / yield stress", "gust factor", …
    value : the value, in the unit of the criterion
    source : origin of the value, such as a calculation
    state : states that the value applies to: normal, abnormal or any
    lines : conditions of the lines that the value applies to: intact, one lost or any
    """

    quantity: str
    value: float
    source: str
    state: str = "any"
    lines: str = "any"


class EarthquakeCase(Table):
    """An earthquake at the dolphins of a berth, as a load case of the abnormal state

    name : name of the case in results
    study : file of a `hakobune earthquake` study beside this one; if it has no [body], the body of the database is
        used
    """

    name: str
    study: str


class WearTable(Table):
    """Loss of chain diameter by wear and corrosion

    mm_per_year : yearly loss of diameter
    years : years, duration of the wear; by default the service life
    """

    mm_per_year: float
    years: float | None = None


class AnchorsTable(Table):
    """Holding capacity of the anchors

    holding_kN : holding capacity of an anchor
    lines : kN, {name of a line = holding capacity of its anchor}, for anchors with different capacities
    """

    holding_kN: float
    lines: dict[str, float] = msgspec.field(default_factory=dict)


class FatigueTable(Table):
    """Fatigue of the lines from their tensions in time

    curve : name of a curve of cycles to failure, such as "DNV studless chain"; or give exponent and constant of N = a
        s^−m
    exponent : exponent m of your own curve
    constant : constant a of your own curve
    basis : range s of your own curve: "stress", in MPa over the nominal area, for a chain the area of both legs; or
        "share", the tension range over the breaking load, for a chain over the breaking load of an ORQ chain of its
        size
    chain : whether your own curve is for chain
    factor : factor on the damage over the service life, at least 1
    """

    curve: str | None = None
    exponent: float | None = None
    constant: float | None = None
    basis: str = "stress"
    chain: bool = False
    factor: float = 3.0


class Project(Table):
    """A site, its states of weather and the rules that judge a mooring there

    levels : m, {name = height above the water level of the study}
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
        """Whether the project requests water levels although it gives a database, which has only one depth"""
        return self.project.database is not None and bool(self.levels)

    def level(self, name):
        """Height of a named water level above the water level of the study, m"""
        return 0.0 if name == MEAN else self.levels[name]
