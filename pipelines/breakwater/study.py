"""A taut-moored floating breakwater as typed TOML, per metre of its length.

```toml
name = "Circular breakwater of 10 m"

[water]
depth = 10.0                    # m, at mean level
tide = 0.5                      # m above and below it

[section]
shape = "rectangle"             # beam, height; or circle: diameter; or outline: points [[y, z], [y, z, bulge], …]
beam = 10.0
height = 6.7
draft = 5.0                     # on its lines, at mean level

[body]                          # not for a fixed one
free_draft = 3.5                # or mass_t_per_m, or lines.pretension_kN_per_m
center_of_gravity = 1.25        # m above the lowest point
gyration = 3.7                  # m

[lines]
angle_deg = 45.0                # with the bed; above 90 they cross
attachment = 5.0                # m, half the distance of their upper ends
spacing = 5.0                   # m of breakwater between pairs
allowable_kN = 2000.0           # of one line
axial_stiffness_kN = 5e4        # of one line, for holding "elastic"

[waves]
height = 3.0                    # m, crest to trough
periods = { from = 3.5, to = 12.0, count = 60 }

[sea]                           # optional
height = 2.0
significant_period = 7.0
spreading = "cosine:4"          # optional, and obliquity_deg, of the mean direction with the normal: for rectangles

[loss]                          # optional, of the flow under the keel, in potential flow
coefficient = 1.5

[optimisation]                  # optional: the least wave behind for every tension
draft = [4.0, 6.0]              # and width, angle_deg; behind = 0.8, m or K_T, that is wanted

[map]                           # optional, with --database: waves around units of finite length
units = 3
gap = 12.0                      # m

[anchors]                       # optional: sinker, common_sinker, pile, holding
sinker = { friction = 0.3, width = 10.0, unit_weight_kN_per_m3 = 67.2 }
```

Every fault is one line that names key, value and what is allowed.
"""

from __future__ import annotations

import msgspec
import numpy as np

from ..common.bounds import check_count
from ..common.quantities import StudyError, Table, positive, water_depth
from ..common.typed import read_toml, typed

THEORIES = ("potential flow", "long waves")
SHAPES = {"rectangle": ("beam", "height"), "circle": ("diameter",), "outline": ("points",)}
MOST_PERIODS = 1000
SHORTEST, LONGEST = 0.05, 1000.0  # s
LARGEST_LOSS = 1e4
MOST_OBLIQUE = 85  # degrees
MOST_UNITS = 30


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


class SeaTable(Table):
    """An irregular sea; one period of it

    height : m, significant
    obliquity_deg : of the mean direction with the normal
    spreading : over directions: cosine:N, half_cosine:S, mitsuyasu:SMAX, wrapped_normal:DEGREES
    duration_hours : of the largest tension
    """

    height: float
    spectrum: str = "bretschneider"
    mean_period: float | None = None
    zero_crossing_period: float | None = None
    energy_period: float | None = None
    peak_period: float | None = None
    significant_period: float | None = None
    gamma: float | None = None
    obliquity_deg: float = 0.0
    spreading: str | None = None
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
    design: DesignTable = msgspec.field(default_factory=DesignTable)
    loss: LossTable | None = None
    map: MapTable | None = None
    optimisation: OptimisationTable | None = None
    measured: str | None = None


def read_breakwater(path):
    """The BreakwaterStudy of a TOML file and its text.  Raises StudyError."""
    raw, text = read_toml(path, "a study of a breakwater", StudyError)
    return make_breakwater(raw), text


def make_breakwater(raw):
    """The BreakwaterStudy of nested dictionaries as TOML gives them.  Raises StudyError."""
    study = typed(raw, BreakwaterStudy, StudyError)
    _check_water(study.water)
    _check_section(study.section)
    _check_names(study)
    if study.lines is not None:
        _check_lines(study.lines)
    positive("waves.height", study.waves.height)
    _check_directions(study)
    if study.loss is not None and not 0 <= study.loss.coefficient <= LARGEST_LOSS:
        raise StudyError(f"loss.coefficient is {study.loss.coefficient:g}; allowed: 0 to {LARGEST_LOSS:g}")
    periods(study)
    _check_needs(study)
    if study.optimisation is not None:
        _check_optimisation(study)
    if study.map is not None:
        _check_map(study)
    return study


def _check_directions(study):
    for key in ("waves", "sea"):
        table = getattr(study, key)
        if table is not None and not -MOST_OBLIQUE <= table.obliquity_deg <= MOST_OBLIQUE:
            raise StudyError(
                f"{key}.obliquity_deg is {table.obliquity_deg:g}; allowed: {-MOST_OBLIQUE} to {MOST_OBLIQUE}"
            )
    if study.loss is not None and (study.waves.obliquity_deg or (study.sea is not None and not study.sea.is_normal)):
        raise StudyError("loss is given with waves at an angle; allowed: with waves along the normal")


def periods(study):
    """(n,) s, ascending.  Raises StudyError."""
    given = study.waves.periods
    if isinstance(given, SpanTable):
        check_count("waves.periods", given.count, 2, MOST_PERIODS, StudyError)
        given = np.linspace(given.first, given.last, given.count).tolist()
    check_count("waves.periods", len(given), 1, MOST_PERIODS, StudyError)
    wrong = [T for T in given if not SHORTEST <= T <= LONGEST]
    if wrong:
        raise StudyError(f"waves.periods has {wrong[0]:g} s; allowed: {SHORTEST:g} to {LONGEST:g}")
    return np.unique(given)


def _check_water(water):
    water_depth("water.depth", water.depth)
    for key in ("density", "gravity"):
        positive(f"water.{key}", getattr(water, key))
    if not 0 <= water.tide < water.depth:
        raise StudyError(f"water.tide is {water.tide:g} m; allowed: 0 to below the depth of {water.depth:g} m")


def _check_section(section):
    if section.shape not in SHAPES:
        raise StudyError(f"section.shape is {section.shape!r}; allowed: {', '.join(SHAPES)}")
    needed = SHAPES[section.shape]
    for key in ("beam", "height", "diameter", "points"):
        value = getattr(section, key)
        if key in needed and value is None:
            raise StudyError(f"section.{key} is missing; shape {section.shape} needs {' and '.join(needed)}")
        if key not in needed and value is not None:
            raise StudyError(f"section.{key} is given; shape {section.shape} has {' and '.join(needed)}")
        if value is not None and key != "points":
            positive(f"section.{key}", value)
    for place, point in enumerate(section.points or []):
        if len(point) not in (2, 3):
            raise StudyError(f"section.points[{place}] has {len(point)} numbers; allowed: y, z, or y, z and bulge")
    positive("section.draft", section.draft)


def _check_names(study):
    from mooring.breakwater.holdings import HOLDINGS

    asked = [("holdings", study.holdings, HOLDINGS), ("theories", study.theories, THEORIES)]
    for key, values, known in asked:
        check_count(key, len(values), 1, len(known), StudyError)
        wrong = [value for value in values if value not in known]
        if wrong or len(set(values)) < len(values):
            raise StudyError(f"{key} has {(wrong or values)[0]!r}; allowed: each of {', '.join(known)}, once")
    if study.design.holding is not None and study.design.holding not in study.holdings:
        raise StudyError(f"design.holding is {study.design.holding!r}; allowed: {', '.join(study.holdings)}")
    if study.design.theory not in THEORIES:
        raise StudyError(f"design.theory is {study.design.theory!r}; allowed: {', '.join(THEORIES)}")


def _check_lines(lines):
    if not 0 < lines.angle_deg < 180:
        raise StudyError(f"lines.angle_deg is {lines.angle_deg:g}; allowed: above 0 and below 180")
    for key in ("attachment", "length", "spacing", "allowable_kN", "axial_stiffness_kN"):
        value = getattr(lines, key)
        if value is not None:
            positive(f"lines.{key}", value)
    if not 0 <= lines.attachment_height < np.inf:
        raise StudyError(f"lines.attachment_height is {lines.attachment_height:g}; allowed: 0 or more, finite")
    if lines.pretension_kN_per_m is not None and not 0 <= lines.pretension_kN_per_m < np.inf:
        raise StudyError(f"lines.pretension_kN_per_m is {lines.pretension_kN_per_m:g}; allowed: 0 or more, finite")


def _check_needs(study):
    body, lines = study.body, study.lines
    for holding in study.holdings:
        if holding != "fixed" and body is None:
            raise StudyError(f"body is missing; holding {holding} needs center_of_gravity, gyration and the weight")
        if holding in ("taut", "elastic") and lines is None:
            raise StudyError(f"lines is missing; holding {holding} needs angle_deg and attachment")
        if holding == "elastic" and lines.axial_stiffness_kN is None:
            raise StudyError("lines.axial_stiffness_kN is missing; holding elastic needs it")
        if holding not in ("fixed", "taut") and study.theories == ["long waves"]:
            raise StudyError(f"holdings has {holding!r}; theory long waves has fixed and taut only")
    if body is None:
        return
    positive("body.gyration", body.gyration)
    if not np.isfinite(body.center_of_gravity):
        raise StudyError(f"body.center_of_gravity is {body.center_of_gravity:g}; allowed: finite")
    weights = {
        "body.mass_t_per_m": body.mass_t_per_m,
        "body.free_draft": body.free_draft,
        "lines.pretension_kN_per_m": None if lines is None else lines.pretension_kN_per_m,
    }
    given = [key for key, value in weights.items() if value is not None]
    if len(given) != 1:
        state = "nothing is given" if not given else " and ".join(given) + " are given"
        raise StudyError(f"the body's weight: {state}; allowed: one of {', '.join(weights)}")
    if not given[0].startswith("lines"):
        positive(given[0], weights[given[0]])


def _check_map(study):
    asked = study.map
    if asked.period is None and study.sea is None:
        raise StudyError("map has no waves; allowed: map.period, or [sea]")
    if asked.period is not None:
        positive("map.period", asked.period)
    check_count("map.units", asked.units, 1, MOST_UNITS, StudyError)
    check_count("map.points", asked.points, 2, 401, StudyError)
    if not (0 < asked.gap < np.inf if asked.units > 1 else asked.gap == 0):
        state = "above 0 between units" if asked.units > 1 else "0 with one unit"
        raise StudyError(f"map.gap is {asked.gap:g} m; allowed: {state}")
    for key in ("x", "y"):
        ends = getattr(asked, key)
        if ends is not None and not -np.inf < ends[0] < ends[1] < np.inf:
            raise StudyError(f"map.{key} is from {ends[0]:g} to {ends[1]:g} m; allowed: rising, finite")
    if study.loss is not None:
        raise StudyError("map is given with loss; the waves of a database lose none; leave one of them out")


def _check_optimisation(study):
    asked = study.optimisation
    if study.lines is None or study.lines.length is not None:
        raise StudyError("optimisation needs [lines] to the bed, without a length")
    if study.section.shape == "outline":
        raise StudyError("optimisation needs a rectangle or a circle; section.shape is 'outline'")
    ranges = {key: getattr(asked, key) for key in ("draft", "width", "angle_deg") if getattr(asked, key) is not None}
    if not ranges:
        raise StudyError("optimisation has no range; allowed: draft, width, angle_deg, each [from, to]")
    for key, (first, last) in ranges.items():
        if not 0 < first < last < np.inf:
            raise StudyError(f"optimisation.{key} is from {first:g} to {last:g}; allowed: above 0, rising")
    if not 4 <= asked.samples <= 4096 or asked.samples & (asked.samples - 1):
        raise StudyError(f"optimisation.samples is {asked.samples}; allowed: a power of two from 4 to 4096")
    if not 1 <= asked.limits <= 100:
        raise StudyError(f"optimisation.limits is {asked.limits}; allowed: 1 to 100")
