"""A floating breakwater as typed TOML, per metre of its length; `pipelines/scenes/breakwater_rectangle.toml` is one."""

import msgspec

from hakobune.mooring.studies.breakwater.breakwater import THEORIES

from ..common.quantities import Table
from ..common.weather.seas import SpectrumTable
from ..site.link import SiteLink


class WaterTable(Table):
    """Water at the breakwater

    depth : m, water depth at mean level
    tide : m, amplitude of the tide above and below mean level
    """

    depth: float
    tide: float = 0.0
    density: float = 1025.0
    gravity: float = 9.80665


class SectionTable(Table):
    """Cross-section of the breakwater

    shape : shape of the section: rectangle, circle or outline
    draft : m, draft on the lines at mean level
    beam : m, width of a rectangle along the waves
    height : m, height of a rectangle from bottom to deck
    diameter : m, diameter of a circle
    points : m, corners [y, z] of an outline, or [y, z, bulge of the edge to the next corner]; the last corner
        repeats the first
    """

    shape: str
    draft: float
    beam: float | None = None
    height: float | None = None
    diameter: float | None = None
    points: list[list[float]] | None = None


class BodyTable(Table):
    """Mass of the section; not needed for a fixed breakwater

    center_of_gravity : m, height of the centre of gravity above the lowest point
    gyration : m, radius of gyration in roll
    mass_t_per_m : mass for each metre of breakwater; or give free_draft or lines.pretension_kN_per_m
    free_draft : m, draft without lines, from which the mass follows
    """

    center_of_gravity: float
    gyration: float
    mass_t_per_m: float | None = None
    free_draft: float | None = None


class LinesTable(Table):
    """Pairs of taut lines

    angle_deg : angle between line and bed; lines with an angle above 90 cross
    attachment : m, half the distance between the upper ends of a pair
    attachment_height : m, height of the upper ends above the lowest point of the body
    length : m, length of a line; by default the distance to the bed
    spacing : m, length of breakwater for each pair
    pretension_kN_per_m : pretension for each metre of breakwater, in place of the body's mass
    allowable_kN : allowable tension of one line
    axial_stiffness_kN : axial stiffness EA of one line, for the holding "elastic"
    """

    angle_deg: float
    attachment: float
    attachment_height: float = 0.0
    length: float | None = None
    spacing: float = 1.0
    pretension_kN_per_m: float | None = None
    allowable_kN: float | None = None
    axial_stiffness_kN: float | None = None


class SpanTable(Table, rename={"first": "from", "last": "to"}):
    """A range of evenly spaced numbers, both ends included"""

    first: float
    last: float
    count: int


class WavesTable(Table):
    """Regular waves

    height : m, wave height, crest to trough
    periods : s, wave periods, a list or a range
    obliquity_deg : angle between the wave direction and the normal of the breakwater
    """

    height: float
    periods: list[float] | SpanTable
    obliquity_deg: float = 0.0


class SeaTable(SpectrumTable):
    """An irregular sea, given by its height and one of the periods

    obliquity_deg : angle between the mean wave direction and the normal of the breakwater
    duration_hours : duration of the sea whose largest tension is computed
    """

    spectrum: str = "bretschneider"
    obliquity_deg: float = 0.0
    duration_hours: float = 3.0

    @property
    def is_normal(self):
        """Whether the whole sea comes along the normal of the breakwater"""
        return self.spreading is None and self.obliquity_deg == 0


class CommonSinkerTable(Table):
    """One block on the bed under both lines

    friction : coefficient of friction between block and bed
    width : m, width of the block
    unit_weight_kN_per_m3 : unit weight of the block in air
    weight_kN_per_m : submerged weight of an existing block for each metre of breakwater, to be checked
    """

    friction: float
    width: float
    unit_weight_kN_per_m3: float
    weight_kN_per_m: float | None = None


class SinkerTable(CommonSinkerTable):
    """A block on the bed under each line

    lifted : whether the block must also carry the upward pull of the line
    """

    lifted: bool = False


class PileTable(Table):
    """Piles as anchors

    diameter : m, diameter of a pile
    length : m, length of a pile in the ground
    cohesion_kPa : undrained shear strength of the ground
    safety : required factor of safety
    spacing : m, distance between existing piles, to be checked
    """

    diameter: float
    length: float
    cohesion_kPa: float
    safety: float = 3.0
    spacing: float | None = None


class HoldingTable(Table):
    """Anchors of known holding capacity

    capacity_kN : holding capacity of an anchor along its line
    spacing : m, distance between anchors
    safety : required factor of safety
    """

    capacity_kN: float
    spacing: float
    safety: float = 2.0


class AnchorsTable(Table):
    """Anchors that are sized or checked for the lines; any number of kinds"""

    sinker: SinkerTable | None = None
    common_sinker: CommonSinkerTable | None = None
    pile: PileTable | None = None
    holding: HoldingTable | None = None


class MapTable(Table):
    """Wave heights around units of finite length, from the database of one unit with its length along x

    period : s, period of regular waves with the study's obliquity; by default the map is that of the sea
    units : number of units in a row
    gap : m, gap between two units
    x : m, first and last x of the map, along the row, from its middle
    y : m, first and last y of the map, to leeward, from the middle of the row
    points : number of map points along each axis
    """

    period: float | None = None
    units: int = 1
    gap: float = 0.0
    x: tuple[float, float] | None = None
    y: tuple[float, float] | None = None
    points: int = 61


class LossTable(Table):
    """Head loss of the flow under the keel, in potential flow; a moving section and its tensions need a rectangle

    coefficient : coefficient C of the head loss C U²/2g
    """

    coefficient: float


class OptimisationTable(Table):
    """Search over ranges [from, to] for the designs with the lowest wave behind the breakwater at each tension

    draft : m, range of the draft
    width : m, range of the beam of a rectangle or the diameter of a circle
    angle_deg : range of the angle between line and bed
    samples : number of designs tried first, a power of two from 4 to 4096
    limits : number of tension limits, 1 to 100; the wave behind the breakwater is minimised for each limit
    behind : target for the wave height behind the breakwater, m; without a sea, for the transmission coefficient K_T
    """

    draft: tuple[float, float] | None = None
    width: tuple[float, float] | None = None
    angle_deg: tuple[float, float] | None = None
    samples: int = 64
    limits: int = 6
    behind: float | None = None


class DesignTable(Table):
    """The computed curve used to size tensions and anchors

    holding : one of the holdings of the study; by default the last
    theory : theory of that curve: "potential flow" or "long waves"
    """

    holding: str | None = None
    theory: str = THEORIES[0]


class BreakwaterStudy(Table):
    """A taut-moored floating breakwater, per metre of its length

    name : name of the breakwater in results and pictures
    holdings : ways to hold the breakwater that are compared: fixed, free, taut, elastic
    theories : theories that are compared: "potential flow", "long waves"
    measured : CSV file of tank tests beside the study, drawn in the pictures
    """

    water: WaterTable
    section: SectionTable
    waves: WavesTable
    name: str = "breakwater"
    body: BodyTable | None = None
    lines: LinesTable | None = None
    sea: SeaTable | None = None
    anchors: AnchorsTable = msgspec.field(default_factory=AnchorsTable)
    holdings: list[str] = msgspec.field(default_factory=lambda: ["fixed"])
    theories: list[str] = msgspec.field(default_factory=lambda: [THEORIES[0]])
    site: SiteLink | None = None
    design: DesignTable = msgspec.field(default_factory=DesignTable)
    loss: LossTable | None = None
    map: MapTable | None = None
    optimisation: OptimisationTable | None = None
    measured: str | None = None
