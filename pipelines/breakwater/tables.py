"""A floating breakwater as typed TOML, per metre of its length; `pipelines/scenes/breakwater_rectangle.toml` is one."""

from __future__ import annotations

import msgspec

from hakobune.mooring.studies.breakwater.breakwater import THEORIES

from ..common.quantities import Table
from ..common.weather.seas import SpectrumTable
from ..site.link import SiteLink


class WaterTable(Table):
    """Water of the place

    depth : m, at mean level
    tide : m, above and below it
    """

    depth: float
    tide: float = 0.0
    density: float = 1025.0
    gravity: float = 9.80665


class SectionTable(Table):
    """Section of the breakwater

    shape : rectangle, circle or outline
    draft : m, on its lines, at mean level
    beam : m, of a rectangle
    height : m, of a rectangle
    diameter : m, of a circle
    points : m, [y, z] or [y, z, bulge of the edge to the next], … of an outline, ending where they began
    """

    shape: str
    draft: float
    beam: float | None = None
    height: float | None = None
    diameter: float | None = None
    points: list[list[float]] | None = None


class BodyTable(Table):
    """Weight of the section, not for a fixed one

    center_of_gravity : m, above the lowest point
    gyration : m, radius in roll
    mass_t_per_m : of breakwater; or free_draft, or lines.pretension_kN_per_m
    free_draft : m, without lines
    """

    center_of_gravity: float
    gyration: float
    mass_t_per_m: float | None = None
    free_draft: float | None = None


class LinesTable(Table):
    """Pairs of taut lines

    angle_deg : with the bed; above 90 they cross
    attachment : m, half the distance of their upper ends
    attachment_height : m, above the lowest point of the body
    length : m, by default to the bed
    spacing : m, of breakwater between pairs
    pretension_kN_per_m : of breakwater, in place of the weight of the body
    allowable_kN : of one line
    axial_stiffness_kN : of one line, for holding "elastic"
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
    """Evenly spaced numbers, both ends included"""

    first: float
    last: float
    count: int


class WavesTable(Table):
    """Regular waves

    height : m, crest to trough
    periods : s, a list or a span
    obliquity_deg : of their way with the normal
    """

    height: float
    periods: list[float] | SpanTable
    obliquity_deg: float = 0.0


class SeaTable(SpectrumTable):
    """An irregular sea; one period of it

    obliquity_deg : of the mean direction with the normal
    duration_hours : of the largest tension
    """

    spectrum: str = "bretschneider"
    obliquity_deg: float = 0.0
    duration_hours: float = 3.0

    @property
    def is_normal(self):
        """Whether all of it comes along the normal"""
        return self.spreading is None and self.obliquity_deg == 0


class SinkerTable(Table):
    """A block on the bed under each line

    friction : coefficient on the bed
    width : m
    unit_weight_kN_per_m3 : in air
    weight_kN_per_m : submerged, of what is there, if it is known
    lifted : whether the line's upward pull is carried too
    """

    friction: float
    width: float
    unit_weight_kN_per_m3: float
    weight_kN_per_m: float | None = None
    lifted: bool = False


class CommonSinkerTable(Table):
    """One block on the bed under both lines

    friction : coefficient on the bed
    width : m
    unit_weight_kN_per_m3 : in air
    weight_kN_per_m : submerged, of what is there, if it is known
    """

    friction: float
    width: float
    unit_weight_kN_per_m3: float
    weight_kN_per_m: float | None = None


class PileTable(Table):
    """Piles as anchors

    diameter : m
    length : m, in the ground
    cohesion_kPa : undrained, of the ground
    safety : factor asked for
    spacing : m, between piles, if it is known
    """

    diameter: float
    length: float
    cohesion_kPa: float
    safety: float = 3.0
    spacing: float | None = None


class HoldingTable(Table):
    """Anchors of a known capacity

    capacity_kN : of an anchor along its line
    spacing : m, between anchors
    safety : factor asked for
    """

    capacity_kN: float
    spacing: float
    safety: float = 2.0


class AnchorsTable(Table):
    """What holds the lines on the bed; any of them"""

    sinker: SinkerTable | None = None
    common_sinker: CommonSinkerTable | None = None
    pile: PileTable | None = None
    holding: HoldingTable | None = None


class MapTable(Table):
    """Waves around units of finite length, of a database of one, its length along x

    period : s, of regular waves of the study's obliquity; without, the sea is taken
    units : in a row
    gap : m, between them
    x, y : m, from and to, along the row and to leeward, about the middle
    points : of the map along each
    """

    period: float | None = None
    units: int = 1
    gap: float = 0.0
    x: tuple[float, float] | None = None
    y: tuple[float, float] | None = None
    points: int = 61


class LossTable(Table):
    """Head that the flow under the keel loses, in potential flow; of moving bodies with its tensions for rectangles

    coefficient : C of C U²/2g
    """

    coefficient: float


class OptimisationTable(Table):
    """The least wave behind for every tension, over ranges [from, to]

    draft : m
    width : m, beam or diameter
    angle_deg : of the lines
    samples : designs that are tried first, a power of two from 4 to 4096
    limits : how many tensions, under which the wave behind is lowered, 1 to 100
    behind : m, or K_T without a sea, that is wanted
    """

    draft: tuple[float, float] | None = None
    width: tuple[float, float] | None = None
    angle_deg: tuple[float, float] | None = None
    samples: int = 64
    limits: int = 6
    behind: float | None = None


class DesignTable(Table):
    """The curve that tensions and anchors are sized for

    holding : one of holdings, by default the last
    theory : "potential flow" or "long waves"
    """

    holding: str | None = None
    theory: str = THEORIES[0]


class BreakwaterStudy(Table):
    """A taut-moored floating breakwater, per metre of its length

    name : for results and pictures
    holdings : that are compared: fixed, free, taut, elastic
    theories : that are compared: "potential flow", "long waves"
    measured : CSV of tank tests beside the study, drawn in the pictures
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
